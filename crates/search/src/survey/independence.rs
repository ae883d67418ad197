//! Independence of integrals, and their number against that needed for a quadrature.

use serde::Serialize;

use super::definitions::{Definition, defined, merged};
use super::question::TestedClaim;
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::Formula;
use liouville::verdict::{ClaimReport, Flaw, JudgeError, Options, Verdict, judge};

/// Number of independent integrals against that needed by the theorem of Euler and Jacobi.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct IntegralCount {
    /// Dimension of the level set, or of the phase space without one.
    pub dimension: usize,
    /// Whether the case has a level set.
    #[serde(skip)]
    pub has_level: bool,
    /// Number of integrals that the theorem needs in addition to a density.
    pub needed: usize,
    /// Names of independent integrals, the energy first if there is one.
    pub independent: Vec<String>,
    /// Claim of their independence, if there are integrals other than the energy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub claim: Option<ClaimReport>,
}

/// Selection of integrals that are independent of each other and of the energy.
pub struct IndependentSelection {
    /// Indices of the independent integrals.
    pub kept: Vec<usize>,
    /// Count of independent integrals.
    pub count: IntegralCount,
    /// Number of integrals, of the count, that are independent at almost all states; the others are shown
    /// to be so on a part of them.
    pub everywhere: usize,
    /// Whether the energy is proved to be one.
    pub has_energy: bool,
}

/// Takes integrals in order if they are independent of those before them, general ones first;
/// `implied` are names of integrals that exist without a formula.
pub fn count(
    case: &Case,
    options: &Options,
    bindings: &[Definition],
    integrals: &[&TestedClaim],
    implied: &[String],
) -> Result<IndependentSelection, JudgeError> {
    let dimension = case.model.dimension() - case.model.level.len();
    let has_energy = has_energy(case, options)?;
    let mut kept: Vec<usize> = Vec::new();
    let (mut proof, mut later) = (None, Vec::new());
    for index in 0..integrals.len() {
        let trial: Vec<&TestedClaim> = kept.iter().chain([&index]).map(|k| integrals[*k]).collect();
        let claim = independent(case, options, bindings, has_energy, &trial)?;
        match claim.filter(|claim| claim.verdict == Verdict::Proved) {
            Some(claim) if claim.evidence.has(Flaw::OnAPart) => later.push(index),
            Some(claim) => {
                kept.push(index);
                proof = Some(claim);
            }
            None => {}
        }
    }
    let everywhere = usize::from(has_energy) + kept.len();
    for index in later {
        let trial: Vec<&TestedClaim> = kept.iter().chain([&index]).map(|k| integrals[*k]).collect();
        let claim = independent(case, options, bindings, has_energy, &trial)?;
        if let Some(claim) = claim.filter(|claim| claim.verdict == Verdict::Proved) {
            kept.push(index);
            proof = Some(claim);
        }
    }
    let on_a_part = usize::from(has_energy) + kept.len() - everywhere;
    let energy = has_energy.then(|| "energy".to_string());
    let names = kept.iter().map(|k| integrals[*k].label());
    // Integrals with a formula may be functions of those without one, so they are not counted
    // twice.
    let beside = kept.iter().filter(|k| !integrals[**k].is_general).count();
    let implied = &implied[beside.min(implied.len())..];
    let count = IntegralCount {
        dimension,
        has_level: !case.model.level.is_empty(),
        needed: dimension.saturating_sub(2),
        independent: energy.into_iter().chain(names).chain(implied.iter().cloned()).collect(),
        claim: proof,
    };
    // Integrals without a formula are counted as before.
    let everywhere = count.independent.len() - on_a_part;
    Ok(IndependentSelection { kept, count, everywhere, has_energy })
}

/// Whether the energy is proved to be conserved, and not to be constant on the level.
fn has_energy(case: &Case, options: &Options) -> Result<bool, JudgeError> {
    if !may_have_energy(case) {
        return Ok(false);
    }
    let energy = case.formula("energy").ok();
    let claims =
        energy.map(|energy| [Claim::integral(energy.clone()), Claim::independent(vec![energy])]);
    let asked = claims.and_then(|claims| case.with_claims(&claims).ok());
    let Some(asked) = asked else { return Ok(false) };
    let report = judge(&asked, options)?;
    Ok(report.claims.iter().all(|claim| claim.verdict == Verdict::Proved))
}

/// Whether systems of this kind conserve the energy.
fn may_have_energy(case: &Case) -> bool {
    let conserved = |case: &Case| match &case.model.system {
        liouville::mechanics::System::Ball(ball) => ball.rotation.is_none(),
        system => system.has_energy() && system.moment().is_none(),
    };
    conserved(case) && case.model.vocabulary.find("energy").is_some()
}

fn independent(
    case: &Case,
    options: &Options,
    bindings: &[Definition],
    energy: bool,
    tested: &[&TestedClaim],
) -> Result<Option<ClaimReport>, JudgeError> {
    let (definitions, formulas) = merged(bindings, tested);
    let Some(named) = defined(case, &definitions) else { return Ok(None) };
    let energy = energy.then_some("energy");
    let texts = energy.into_iter().chain(formulas.iter().map(String::as_str));
    let functions: Option<Vec<Formula>> = texts.map(|text| named.formula(text).ok()).collect();
    let claim = functions.map(Claim::independent);
    let asked = claim.and_then(|claim| named.with_claims(&[claim]).ok());
    match asked {
        Some(asked) => Ok(judge(&asked, options)?.claims.into_iter().next()),
        None => Ok(None),
    }
}
