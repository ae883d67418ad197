//! Integrals of lower degree in the velocities than those on which they depend.
//!
//! With the energy E and x'² + z'² the linear integral x'√(1 + y²) adds no independent function, and it
//! says more: the others are polynomials in such ones.

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::Formula;
use liouville::mechanics::{System, VariableRole};
use liouville::order::StableOrder;
use liouville::verdict::{ClaimReport, Verdict};

use super::ask::{independent, judged_alone};
use super::integrals::claimed_by;
use super::local::Coordinates;
use super::products::degree_in;
use super::{Effort, Found, FoundKind, SearchError, SearchReport};

/// Largest number of integrals that are compared.
const MOST_TOLD: usize = 12;
/// Highest degree of an integral that takes the place of another.
const MOST_DEGREE: u32 = 2;

/// Takes an integral that is a function of those told, and of the energy, in place of one of higher degree;
/// one of degree at most 1 is told as a further integral if it is no function of others of this degree.
pub fn prefer(
    case: &Case,
    formula: &Formula,
    found: ClaimReport,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let Some(degrees) = Degrees::of(case, effort) else { return Ok(()) };
    let Some(own) = degrees.of_formula(formula)?.filter(|own| *own <= MOST_DEGREE) else {
        return Ok(());
    };
    let mut told = Vec::new();
    for (place, other) in report.found.iter().enumerate() {
        let is_integral =
            other.kind == FoundKind::Integral || other.kind == FoundKind::FurtherIntegral;
        let function = other.function().filter(|_| is_integral && other.verdict == Verdict::Proved);
        if let Some(function) = function {
            told.push((place, function.clone(), degrees.of_formula(function)?));
        }
    }
    if told.len() > MOST_TOLD || told.iter().any(|(_, other, _)| other.text() == formula.text()) {
        return Ok(());
    }
    let is_first = |place: usize| report.found[place].is_integral();
    let mut higher: Vec<_> = told
        .iter()
        .filter(|(at, _, degree)| is_first(*at) && degree.is_none_or(|degree| degree > own))
        .collect();
    higher.order_by_key(|(_, _, degree)| std::cmp::Reverse(degree.unwrap_or(u32::MAX)));
    for (place, _, _) in higher {
        effort.halt.check()?;
        let others = told.iter().filter(|(at, ..)| is_first(*at) && at != place);
        let others: Vec<Formula> = others.map(|(_, other, _)| other.clone()).collect();
        if independent(case, &others, formula, effort)?.is_some() {
            let known = claimed_by(case, formula, effort, report)?;
            report.found[*place] =
                Found::new(FoundKind::Integral, formula, known, found, &case.model);
            return Ok(());
        }
    }
    let low = told.iter().filter(|(_, _, degree)| degree.is_some_and(|degree| degree <= 1));
    let low: Vec<Formula> = low.map(|(_, other, _)| other.clone()).collect();
    if own > 1 {
        return Ok(());
    }
    let all: Vec<Formula> = low.iter().cloned().chain([formula.clone()]).collect();
    let judged = judged_alone(case, Claim::independent(all), effort)?;
    if judged.is_some_and(|own| own.verdict == Verdict::Proved) {
        let known = claimed_by(case, formula, effort, report)?;
        report.found.push(Found::new(
            FoundKind::FurtherIntegral,
            formula,
            known,
            found,
            &case.model,
        ));
    }
    Ok(())
}

/// Degrees in the velocities of a Lagrangian system.
pub struct Degrees<'c> {
    case: &'c Case,
    coordinates: Coordinates,
    seed: u64,
}

impl<'c> Degrees<'c> {
    /// Splits the state; `None` of another system.
    pub fn of(case: &'c Case, effort: &Effort) -> Option<Self> {
        let System::Lagrangian(lagrangian) = &case.model.system else { return None };
        let seed = effort.options.seed;
        let coordinates = Coordinates::of(case).ok().or_else(|| {
            let roles = lagrangian.roles.iter().zip(&case.model.state);
            let is_position = roles.flat_map(|(role, variable)| {
                let moves = matches!(role, VariableRole::Velocity | VariableRole::Multiplier(_));
                vec![!moves; variable.len()]
            });
            let positions: Vec<usize> =
                is_position.enumerate().filter(|(_, own)| *own).map(|(k, _)| k).collect();
            case.model.extension.is_empty().then(|| Coordinates::divided(case, &positions))
        })?;
        Some(Self { case, coordinates, seed })
    }

    /// Degree of a formula; `None` if it is no polynomial in the velocities.
    pub fn of_formula(&self, formula: &Formula) -> Result<Option<u32>, SearchError> {
        degree_in(self.case, formula, &self.coordinates, self.seed)
    }
}
