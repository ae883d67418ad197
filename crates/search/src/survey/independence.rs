//! Independence of integrals, and their number against that needed for a quadrature.

use serde::Serialize;

use super::definitions::{Definition, defined, merged};
use super::question::TestedClaim;
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, Type};
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
    /// Independent integrals with formulas, in order.
    pub entries: Vec<Entry>,
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
    let all: Vec<Entry> =
        (0..integrals.len()).flat_map(|index| entries(case, bindings, integrals, index)).collect();
    let mut chosen: Vec<&Entry> = Vec::new();
    let (mut proof, mut later) = (None, Vec::new());
    let trial = |chosen: &[&Entry], entry: &Entry| {
        let trial: Vec<&Entry> = chosen.iter().copied().chain([entry]).collect();
        let claim = independent(case, options, bindings, has_energy, integrals, &trial)?;
        Ok::<_, JudgeError>(claim.filter(|claim| claim.verdict == Verdict::Proved))
    };
    for entry in &all {
        match trial(&chosen, entry)? {
            Some(claim) if claim.evidence.has(Flaw::OnAPart) => later.push(entry),
            Some(claim) => {
                chosen.push(entry);
                proof = Some(claim);
            }
            None => {}
        }
    }
    let everywhere = usize::from(has_energy) + chosen.len();
    for entry in later {
        if let Some(claim) = trial(&chosen, entry)? {
            chosen.push(entry);
            proof = Some(claim);
        }
    }
    let on_a_part = usize::from(has_energy) + chosen.len() - everywhere;
    let mut kept: Vec<usize> = chosen.iter().map(|entry| entry.index).collect();
    kept.sort_unstable();
    kept.dedup();
    let energy = has_energy.then(|| "energy".to_string());
    let names = chosen.iter().map(|entry| entry.label(integrals));
    // Integrals with a formula may be functions of those without one, so they are not counted
    // twice.
    let beside = chosen.iter().filter(|entry| !integrals[entry.index].is_general).count();
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
    let entries = chosen.into_iter().cloned().collect();
    Ok(IndependentSelection { entries, kept, count, everywhere, has_energy })
}

/// An integral, or one component of an integral that is a vector or a matrix.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Index of the integral.
    pub index: usize,
    /// Place of the component in brackets, as `[1,2]`; empty for a number.
    place: String,
}

impl Entry {
    /// Name of the integral with the place of the component.
    pub fn label(&self, integrals: &[&TestedClaim]) -> String {
        let whole = integrals[self.index].label();
        match self.place.is_empty() || whole.chars().all(char::is_alphanumeric) {
            true => format!("{whole}{}", self.place),
            false => format!("({whole}){}", self.place),
        }
    }
}

/// Lists the components of an integral.
fn entries(
    case: &Case,
    bindings: &[Definition],
    integrals: &[&TestedClaim],
    index: usize,
) -> Vec<Entry> {
    let (definitions, formulas) = merged(bindings, &integrals[index..=index]);
    let named = defined(case, &definitions);
    let formula = named.and_then(|named| named.formula(formulas.first()?).ok());
    let places = match formula.map_or(Type::Scalar, |formula| formula.value_type()) {
        Type::Scalar => vec![String::new()],
        Type::Vector(length) => (1..=length).map(|k| format!("[{k}]")).collect(),
        Type::Matrix(rows, columns) => {
            (1..=rows).flat_map(|i| (1..=columns).map(move |j| format!("[{i},{j}]"))).collect()
        }
    };
    places.into_iter().map(|place| Entry { index, place }).collect()
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

/// Claims that components of integrals are independent of each other and of the energy.
fn independent(
    case: &Case,
    options: &Options,
    bindings: &[Definition],
    energy: bool,
    integrals: &[&TestedClaim],
    entries: &[&Entry],
) -> Result<Option<ClaimReport>, JudgeError> {
    let Some((named, functions)) = functions(case, bindings, energy, integrals, entries) else {
        return Ok(None);
    };
    match named.with_claims(&[Claim::independent(functions)]).ok() {
        Some(asked) => Ok(judge(&asked, options)?.claims.into_iter().next()),
        None => Ok(None),
    }
}

/// Formulas of components of integrals, after the energy if it is one, and the case with their names.
pub fn functions(
    case: &Case,
    bindings: &[Definition],
    energy: bool,
    integrals: &[&TestedClaim],
    entries: &[&Entry],
) -> Option<(Case, Vec<Formula>)> {
    let tested: Vec<&TestedClaim> = entries.iter().map(|entry| integrals[entry.index]).collect();
    let (definitions, formulas) = merged(bindings, &tested);
    let mut named = defined(case, &definitions)?;
    let mut functions: Vec<Formula> = Vec::new();
    functions.extend(energy.then(|| named.formula("energy").ok()).flatten());
    for (number, (entry, text)) in entries.iter().zip(&formulas).enumerate() {
        let mut function = named.formula(text).ok()?;
        if !entry.place.is_empty() {
            let name = format!("integral_{}", number + 1);
            named.define(&name, &function).ok()?;
            function = named.formula(&format!("{name}{}", entry.place)).ok()?;
        }
        functions.push(function);
    }
    Some((named, functions))
}
