//! Which of the integrals are independent, and whether they are enough for a quadrature.

use serde::Serialize;

use super::question::{Definition, Finding, Question, merged};
use crate::case::Case;
use crate::verdict::{ClaimReport, JudgeError, Options, Verdict};

/// Independent integrals against what Euler and Jacobi's theorem asks for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Count {
    /// The dimension of the level set.
    pub dimension: usize,
    /// How many integrals the theorem needs beside a density.
    pub needed: usize,
    /// Names of independent ones, the energy first where there is one.
    pub independent: Vec<String>,
    /// The claim that they are, if there is more than the energy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub claim: Option<ClaimReport>,
}

/// An integral found among those that are independent of each other and of the energy.
pub struct Independent {
    /// The places of the integrals that are independent.
    pub kept: Vec<usize>,
    /// How many there are.
    pub count: Count,
}

/// Takes integrals in order as long as each is independent of those before it, general ones first;
/// `implied` are names of integrals that exist without a formula.
pub fn count(
    case: &Case,
    options: &Options,
    bindings: &[Definition],
    integrals: &[&Finding],
    implied: &[String],
) -> Result<Independent, JudgeError> {
    let dimension = case.model.dimension() - case.model.level.len();
    let energy = has_energy(case);
    let mut kept: Vec<usize> = Vec::new();
    let mut proof = None;
    for index in 0..integrals.len() {
        let trial: Vec<&Finding> = kept.iter().chain([&index]).map(|k| integrals[*k]).collect();
        let claim = independent(case, options, bindings, energy, &trial)?;
        if let Some(claim) = claim.filter(|claim| claim.verdict == Verdict::Proved) {
            kept.push(index);
            proof = Some(claim);
        }
    }
    let energy = energy.then(|| "energy".to_string());
    let names = kept.iter().map(|k| integrals[*k].claim.name.clone());
    // Those with a formula may be functions of those without one, so they are not counted twice.
    let beside = kept.iter().filter(|k| !integrals[**k].is_general).count();
    let implied = &implied[beside.min(implied.len())..];
    let count = Count {
        dimension,
        needed: dimension.saturating_sub(2),
        independent: energy.into_iter().chain(names).chain(implied.iter().cloned()).collect(),
        claim: proof,
    };
    Ok(Independent { kept, count })
}

/// Is the energy an integral that every family of this system has?
fn has_energy(case: &Case) -> bool {
    let conserved = |case: &Case| match &case.model.system {
        crate::mechanics::System::Ball(ball) => ball.rotation.is_none(),
        crate::mechanics::System::Rubber(body) => body.moment.is_none(),
        system => system.has_energy(),
    };
    conserved(case) && case.model.vocabulary.find("energy").is_some()
}

fn independent(
    case: &Case,
    options: &Options,
    bindings: &[Definition],
    energy: bool,
    findings: &[&Finding],
) -> Result<Option<ClaimReport>, JudgeError> {
    let (definitions, formulas) = merged(bindings, findings);
    let energy = energy.then(|| "energy".to_string());
    let quoted: Vec<String> =
        energy.iter().chain(&formulas).map(|text| format!("\"{text}\"")).collect();
    let body = format!("[[claim]]\nindependent = [{}]\n", quoted.join(", "));
    let found = Question::plain("independence", &definitions, body).ask(case, options)?;
    Ok(found.and_then(|found| found.into_iter().next()).map(|finding| finding.claim))
}
