//! Cases where some equations between the parameters hold.

use liouville::case::PlacedClaim;
use liouville::formula::{Formula, FormulaError};
use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::verdict::{Verdict, judge};

use super::hypersurface::Hypersurface;
use super::split::SplitCase;
use crate::{Effort, SearchError};

/// Largest number of cases.
const MOST: usize = 8;

/// Values of some scalars.
#[derive(Clone)]
struct SolvedScalars {
    /// Scalars as formulas of those that are free.
    letters: Vec<Formula>,
    /// Places of the scalars that each is a formula of.
    uses: Vec<Vec<usize>>,
    /// Places of those that have a value.
    solved: Vec<usize>,
}

/// Writes the cases where some equations hold, which are solved one by one: those of degree two in one
/// scalar by both roots, others for a scalar that occurs linearly. `None` if that is not possible.
pub fn with_equations(split: &SplitCase, equations: &[Hypersurface]) -> Option<Vec<SplitCase>> {
    let letters = split.letters().ok()?;
    let uses = (0..letters.len()).map(|place| vec![place]).collect();
    let mut all = vec![SolvedScalars { letters, uses, solved: Vec::new() }];
    let mut left: Vec<&Hypersurface> = equations.iter().collect();
    left.order_by_key(|own| (own.univariate().is_none(), own.degree()));
    for own in left {
        let next: Option<Vec<Vec<SolvedScalars>>> =
            all.into_iter().map(|known| known.with(own).ok().flatten()).collect();
        all = next?.concat();
        if all.len() > MOST {
            return None;
        }
    }
    let written = |own: SolvedScalars| {
        let value = |place: &usize| (*place, own.letters[*place].clone());
        split.with(own.solved.iter().map(value).collect())
    };
    all.into_iter().map(written).collect()
}

impl SolvedScalars {
    /// Solves an equation; `None` if it cannot be solved.
    fn with(&self, own: &Hypersurface) -> Result<Option<Vec<Self>>, FormulaError> {
        let is_open = |place: &usize| !self.solved.contains(place);
        if let Some((place, coefficients)) = own.univariate()
            && let [c, b, a] = coefficients.as_slice()
            && is_open(&place)
        {
            let Some(values) = roots([a, b, c])? else { return Ok(None) };
            let with = |value| self.replaced(place, value, Vec::new());
            return Ok(Some(values.into_iter().map(with).collect()));
        }
        let others = |place: usize| (0..self.letters.len()).filter(move |other| *other != place);
        let uses = |place: usize| -> Vec<usize> {
            let used = others(place).filter(|other| own.contains(*other));
            used.flat_map(|other| self.uses[other].clone()).collect()
        };
        let is_solvable = |place: &usize| {
            is_open(place) && own.is_linear(*place) && !uses(*place).contains(place)
        };
        let Some(place) = (0..self.letters.len()).rev().find(is_solvable) else { return Ok(None) };
        let value = own.solved_for(place, &self.letters)?;
        Ok(Some(vec![self.replaced(place, value, uses(place))]))
    }

    /// Gives a scalar a value; `None` of the values of others contains it.
    fn replaced(&self, place: usize, value: Formula, uses: Vec<usize>) -> Self {
        let mut own = self.clone();
        own.letters[place] = value.bracketed();
        own.uses[place] = uses;
        own.solved.push(place);
        own
    }
}

/// Roots of a x² + b x + c that are real, as formulas; `None` if they are not.
fn roots([a, b, c]: [&Rational; 3]) -> Result<Option<Vec<Formula>>, FormulaError> {
    let discriminant = &(b * b) - &(&(&Rational::from(4) * a) * c);
    let Some(inverse) = (&Rational::from(2) * a).recip().filter(|_| !discriminant.is_negative())
    else {
        return Ok(None);
    };
    let middle = Formula::number(&Rational::from(0) - &(b * &inverse));
    let square = &discriminant * &(&inverse * &inverse);
    let half = Formula::call("sqrt", &[&Formula::number(square)])?;
    Ok(Some(vec![(&middle + &half)?, (&middle - &half)?]))
}

/// Whether a claim is proved where some equations hold.
pub fn is_proved(
    split: &SplitCase,
    equations: &[Hypersurface],
    claim: &PlacedClaim,
    effort: &Effort,
) -> Result<bool, SearchError> {
    let Some(all) = with_equations(split, equations) else { return Ok(false) };
    for fixed in all {
        effort.halt.check()?;
        let mut case = fixed.case;
        case.claims.retain(|own| own.name == claim.name);
        // Where the field has no values nothing is proved.
        let Ok(report) = judge(&case, &effort.options) else { return Ok(false) };
        let proved = |own: &liouville::verdict::ClaimReport| own.verdict == Verdict::Proved;
        if report.claims.is_empty() || !report.claims.iter().all(proved) {
            return Ok(false);
        }
    }
    Ok(true)
}
