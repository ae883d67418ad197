//! Findings as entries of a report.

use super::document::{JudgedClaim, SectionBlock, VerdictMark};
use crate::evidence::options;
use liouville::claim::PlaceName;
use liouville::verdict::{
    ClaimReport, DensitySign, Evidence, Flaw, Independence, Verdict, Witness,
};
use liouville_search::survey::TestedClaim;

/// Findings as blocks, one after the other.
pub fn blocks(tested: &[TestedClaim]) -> Vec<SectionBlock> {
    tested.iter().map(|one| SectionBlock::Entry(Box::new(entry(one)))).collect()
}

/// Entry of a finding.
pub fn entry(tested: &TestedClaim) -> JudgedClaim {
    let claim = &tested.claim;
    let evidence = &claim.evidence;
    let map =
        |one: &liouville_search::survey::Definition| format!("{} ↦ {}", one.name, one.formula);
    let statement = match (claim.kind, tested.images.as_slice()) {
        ("rate", [rate]) => Some(format!("({})' = {}", rate.name, rate.formula)),
        (_, []) => claim.formula.clone(),
        (_, images) => Some(images.iter().map(map).collect::<Vec<_>>().join(", ")),
    };
    let mut definitions: Vec<(String, Option<liouville::formula::Layout>)> = tested
        .definitions
        .iter()
        .map(|one| (format!("{} = {}", one.name, one.formula), None))
        .collect();
    if definitions.len() == tested.shown.definitions.len() {
        for (definition, layout) in definitions.iter_mut().zip(&tested.shown.definitions) {
            definition.1 = Some(layout.clone());
        }
    }
    // A claim of the file without a name has its formula in place of it.
    let is_unnamed = !tested.is_of_family() && statement.as_ref() == Some(&claim.name);
    let name = match is_unnamed {
        true => claim.kind.replace('-', " "),
        false => claim.name.clone(),
    };
    let is_repeated = statement.as_ref() == Some(&name);
    JudgedClaim {
        mark: mark(claim.verdict),
        verdict: claim.verdict.word(),
        statement: statement.filter(|_| !is_repeated),
        name,
        layout: tested.shown.statement.clone().filter(|_| !is_repeated),
        definitions,
        remarks: remarks(tested),
        source: claim.source.clone(),
        evidence: grounds(evidence),
    }
}

fn mark(verdict: Verdict) -> VerdictMark {
    match verdict {
        Verdict::Proved | Verdict::Confirmed => VerdictMark::Holds,
        Verdict::Refuted => VerdictMark::Fails,
        Verdict::Undecided => VerdictMark::Open,
    }
}

/// Entry of the claim that integrals are independent.
pub fn independence(claim: &ClaimReport) -> SectionBlock {
    // Without a restriction the remark repeats the count.
    let is_partial = claim.evidence.has(Flaw::OnAPart);
    let remarks = claim.evidence.remark.iter().filter(|_| is_partial).cloned().collect();
    of_integrals("they are independent", claim, remarks)
}

/// Entry of the claim that integrals meet the hypotheses of Liouville's theorem.
pub fn involution(claim: &ClaimReport) -> SectionBlock {
    let what = "they are in involution and independent, and their fields span the joint levels";
    of_integrals(what, claim, Vec::new())
}

fn of_integrals(what: &str, claim: &ClaimReport, remarks: Vec<String>) -> SectionBlock {
    SectionBlock::Entry(Box::new(JudgedClaim {
        mark: mark(claim.verdict),
        verdict: claim.verdict.word(),
        name: what.to_string(),
        statement: None,
        layout: None,
        definitions: Vec::new(),
        remarks,
        source: String::new(),
        evidence: grounds(&claim.evidence),
    }))
}

/// Additional facts about the verdict on a finding.
fn remarks(tested: &TestedClaim) -> Vec<String> {
    let evidence = &tested.claim.evidence;
    let mut remarks = Vec::new();
    if tested.holds() {
        remarks.extend(place(&evidence.holds));
        match evidence.sign {
            Some(DensitySign::Changes) => remarks.push(
                "ρ has zeros or poles: it defines a measure on each region between them"
                    .to_string(),
            ),
            Some(DensitySign::ChangesWithParameters) => {
                remarks.push("changes its sign with the parameters: take |ρ|".to_string())
            }
            Some(DensitySign::Negative) => remarks.push("negative: take −ρ".to_string()),
            _ => {}
        }
        if tested.is_quadrature() {
            remarks.push("by quadrature".to_string());
        }
        if evidence.independence == Some(Independence::Constant) {
            remarks.push("constant on the level".to_string());
        }
    }
    remarks.extend(tested.remark.clone());
    remarks.extend(evidence.remark.clone());
    remarks.extend(evidence.theorem.iter().chain(&evidence.exhibit).cloned());
    if tested.claim.verdict == Verdict::Undecided {
        remarks.extend(evidence.reason.clone());
    }
    remarks
}

/// Domain on which a claim holds, in words.
fn place(holds: &[PlaceName]) -> Option<String> {
    Some(match holds.first()? {
        PlaceName::Level => "on the level set".to_string(),
        equations @ PlaceName::Equations(_) => format!("on {equations}"),
        place => place.to_string(),
    })
}

/// Grounds of a verdict, line by line.
pub fn grounds(evidence: &Evidence) -> Vec<String> {
    let mut lines: Vec<String> =
        evidence.climb.iter().map(|rung| format!("{}: {}", rung.rung, rung.found)).collect();
    // A rung of the ladder that proves says the same.
    let proof = evidence.proof.as_ref().map(ToString::to_string);
    let is_told = |proof: &String| evidence.climb.iter().any(|rung| rung.found == *proof);
    lines.extend(proof.filter(|proof| !is_told(proof)).map(|proof| format!("proof: {proof}")));
    lines.extend(evidence.volume.as_ref().map(|volume| format!("volume: {volume}")));
    lines.extend(evidence.witness.as_ref().map(witness));
    lines.extend(evidence.silence.as_ref().map(|silence| format!("no proof: {silence}")));
    lines.extend(evidence.reason.clone());
    lines
}

/// State at which a claim fails, in the notation of `eval`.
pub fn witness(witness: &Witness) -> String {
    let (residual, error) = (witness.residual, witness.error_bound);
    format!("witness: {residual:.3e} ± {error:.1e} at {}", options(witness))
}
