//! Judgement of found formulas as claims about the case.

use super::continued::is_one_function;
use super::{Effort, SearchError};
use liouville::case::{Case, Expect};
use liouville::claim::{Claim, ClaimKind, Integral, MOST_COMPARED};
use liouville::formula::{Formula, FormulaError, FormulaResult, Type};
use liouville::mechanics::{Surface, System};
use liouville::verdict::{ClaimReport, Evidence, Verdict, judge};

/// Judges claims about a case, and returns the reports.
pub fn judged(
    case: &Case,
    claims: &[Claim],
    effort: &Effort,
) -> Result<Vec<ClaimReport>, SearchError> {
    Ok(judge(&case.with_claims(claims)?, &effort.options)?.claims)
}

/// Judges one claim about a case.
pub fn judged_alone(
    case: &Case,
    claim: Claim,
    effort: &Effort,
) -> Result<Option<ClaimReport>, SearchError> {
    Ok(judged(case, &[claim], effort)?.into_iter().next())
}

/// Whether a claim was proved or confirmed.
pub fn holds(report: &ClaimReport) -> bool {
    matches!(report.verdict, Verdict::Proved | Verdict::Confirmed)
}

/// The energy of a case, if it has one.
pub fn energy(case: &Case) -> Option<Formula> {
    Formula::name("energy", &case.model.vocabulary).ok()
}

/// The function whose levels are the surfaces on which a ball rolls, if an equation gives the surface:
/// every such motion keeps it.
pub fn surface(case: &Case) -> Option<Formula> {
    match &case.model.system {
        System::Ball(ball) => match &ball.surface {
            Surface::Level(function) => Some(function.clone()),
            Surface::Arbitrary(_) | Surface::Support(_) => None,
        },
        _ => None,
    }
}

/// Functions that a case has without a search: its energy, and the function of a surface.
pub fn given(case: &Case) -> impl Iterator<Item = Formula> {
    energy(case).into_iter().chain(surface(case))
}

/// Whether a formula is the energy by its name.
pub fn is_energy(formula: &Formula) -> bool {
    formula.text() == "energy"
}

/// The energy, where it is proved to be an integral.
pub fn proved_energy(case: &Case, effort: &Effort) -> Result<Option<Formula>, SearchError> {
    let Some(energy) = energy(case) else { return Ok(None) };
    let report = judged_alone(case, Claim::integral(&energy), effort)?;
    // Theorems rest on it: what is seen in numbers is not enough.
    Ok(report.filter(|report| report.verdict == Verdict::Proved).map(|_| energy))
}

/// The given functions that are proved to be integrals.
pub fn proved_given(case: &Case, effort: &Effort) -> Result<Vec<Formula>, SearchError> {
    let mut all: Vec<Formula> = proved_energy(case, effort)?.into_iter().collect();
    if let Some(surface) = surface(case) {
        let report = judged_alone(case, Claim::integral(&surface), effort)?;
        all.extend(report.filter(|own| own.verdict == Verdict::Proved).map(|_| surface));
    }
    Ok(all)
}

/// Returns the grounds on which a formula is not a function of others, the energy, the function of a
/// surface and the level functions; `None` if it is.
pub fn independent(
    case: &Case,
    known: &[Formula],
    formula: &Formula,
    effort: &Effort,
) -> Result<Option<Evidence>, SearchError> {
    let report = compared(case, known, formula, effort)?;
    let proved = report.filter(|report| report.verdict == Verdict::Proved);
    Ok(proved.map(|report| report.evidence))
}

/// Judges whether a formula, others, the energy, the function of a surface and the level functions are
/// independent; `None` if there are too many.
pub fn compared(
    case: &Case,
    known: &[Formula],
    formula: &Formula,
    effort: &Effort,
) -> Result<Option<ClaimReport>, SearchError> {
    if !are_comparable(case, known) {
        return Ok(None);
    }
    let all = known.iter().cloned().chain(given(case)).chain([formula.clone()]);
    judged_alone(case, Claim::independent(all.collect()), effort)
}

/// Whether another function can be compared with these, the given functions and the level functions.
pub fn are_comparable(case: &Case, known: &[Formula]) -> bool {
    let others = case.model.level.len() + given(case).count();
    known.len() + others < MOST_COMPARED
}

/// A component of an integral that a case claims.
#[derive(Clone, Debug)]
pub struct Claimed {
    /// Name of the claim.
    pub name: String,
    /// Integral, or a component of it.
    pub formula: Formula,
}

/// Lists the integrals that a case claims and that are proved, component by component, without functions
/// of the energy and those that may be constant on a part of the states.
pub fn claimed(case: &Case, effort: &Effort) -> Result<Vec<Claimed>, SearchError> {
    if effort.blind {
        return Ok(Vec::new());
    }
    let mut all = Vec::new();
    for claim in case.claims.iter().filter(|claim| claim.expect == Expect::Holds) {
        if let ClaimKind::Integral(Integral(own)) = &claim.kind {
            let formulas = components(own)?.into_iter();
            all.extend(formulas.map(|formula| Claimed { name: claim.name.clone(), formula }));
        }
    }
    let claims: Vec<Claim> = all.iter().map(|one| Claim::integral(&one.formula)).collect();
    let mut found = Vec::new();
    for (one, report) in all.into_iter().zip(judged(case, &claims, effort)?) {
        // A theorem rests on what is proved.
        if report.verdict == Verdict::Proved
            && is_one_function(case, &one.formula, effort)?
            && independent(case, &[], &one.formula, effort)?.is_some()
        {
            found.push(one);
        }
    }
    Ok(found)
}

/// Splits a formula into its components.
pub fn components(formula: &Formula) -> Result<Vec<Formula>, FormulaError> {
    let whole = formula.bracketed();
    let at = |indices: &[usize]| -> FormulaResult { whole.component(indices) };
    match formula.value_type() {
        Type::Scalar => Ok(vec![formula.clone()]),
        Type::Vector(length) => (1..=length).map(|i| at(&[i])).collect(),
        Type::Matrix(rows, columns) => {
            let pairs = (1..=rows).flat_map(|i| (1..=columns).map(move |j| [i, j]));
            pairs.map(|pair| at(&pair)).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_are_known_by_their_components() {
        let text = "title = 'x'\nsystem = 'nonholonomic'\n[state]\nq = 'vector(1..2)'\n\
                    \"q'\" = 'vector(1..2)'\n[lagrangian]\nkinetic = \"(q',q')/2\"\n\
                    potential = '(q,q)²'\n[[claim]]\nname = 'L'\nintegral = \"q × q'\"\n";
        let case = Case::parse(text, &[]).expect("a case");
        let known = claimed(&case, &Effort::default()).expect("judged");
        let formulas: Vec<&str> = known.iter().map(|one| one.formula.text()).collect();
        assert_eq!(formulas, ["(q × q')[1]", "(q × q')[2]", "(q × q')[3]"]);
        assert!(known.iter().all(|one| one.name == "L"), "all come from one claim");
    }
}
