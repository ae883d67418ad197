//! Values of one parameter for which a field has more polynomial integrals than in general.
//!
//! The rates of the monomials at random states are a matrix whose null vectors are integrals. A value
//! with more of them lowers its rank, so it is a root of every maximal minor; minors of other states
//! and of other columns have no further root in common. What is left of the common divisor without
//! these values is reported.

use std::cell::Cell;

use liouville::case::Case;
use liouville::formula::Formula;
use liouville::number::prime::{Polynomial, PrimePolynomials};
use liouville::number::rational::Rational;
use liouville::proof::ProofRng;
use liouville::verdict::is_filled;

use super::ParameterCondition;
use super::equations::ParametricEquations;
use super::minors::determinant;
use super::parameter_line::ENTRY;
use super::relation::{
    Relation, Round, ScalarParameter, explained, of_irrational, unexplained, unfilled,
    without_factors, written,
};
use super::split::SplitCase;
use crate::ansatz::system::PrimePoint;
use crate::budget::STEPS;
use crate::echelon::Echelon;
use crate::orbit;
use crate::origin::ConditionOrigin;
use crate::streams::SearchStream;
use crate::{Effort, FoundKind, Given, SearchError, SearchReport};

/// Number of minors that are compared, and the largest number if some roots are not explained.
const MINORS: (u64, u64) = (2, 4);
/// Smallest number of values of a minor, followed by the largest.
const VALUES: (usize, usize) = (32, 2048);
/// Number of rows beyond the unknowns.
const SPARE: usize = 8;
/// Number of primes modulo which irrational values are looked for, and of those that are enough with values.
const PRIMES: u64 = 12;
const ENOUGH: usize = 2;
/// First stream of states for minors.
const STREAM: u64 = 1000;

/// Finds the values of single parameters of a field for which there are more polynomial integrals of at
/// most the degree of the search, and the integrals there.
pub fn conditions(
    split: &SplitCase,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let (before, remarks) = (report.conditions.len(), report.remarks.len());
    let last = up_to(split, effort, report, progress)?;
    // A remark names values that are left open.
    let other = if report.remarks.len() > remarks { "no other" } else { "no" };
    if last > 0 && report.conditions.len() == before {
        let names: Vec<&str> = split.scalars.iter().map(|own| own.name.as_str()).collect();
        report.conditions.push(ParameterCondition {
            of: format!("more polynomial integrals of degree at most {last}, by {}", names.join(", or ")),
            equations: Vec::new(),
            grounds: format!(
                "minors of the equations for the coefficients; modulo a prime of 61 bits {other} value \
                 has more{}",
                split.reservation()
            ),
            origin: ConditionOrigin::Polynomials,
        });
    }
    Ok(())
}

/// Finds the values degree by degree; returns the last degree of which all were sought.
fn up_to(
    split: &SplitCase,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<u32, SearchError> {
    let SplitCase { case, scalars: all, .. } = split;
    let mut told: Vec<String> = Vec::new();
    let mut polynomials: Vec<Vec<Rational>> = Vec::new();
    let mut is_sought = true;
    let left = Cell::new(effort.seconds * STEPS);
    for degree in 1..=effort.degree {
        for (place, parameter) in all.iter().enumerate() {
            let name = &parameter.name;
            progress(&format!("values of {name} with more integrals of degree {degree}"));
            let Some(equations) = ParametricEquations::new(case, degree, effort)? else {
                return Ok(degree - 1);
            };
            let search = OneParameter { equations, draw: parameter.draw, left: &left };
            let rounds = if all.len() > 1 { 2 } else { 1 };
            let found = match search.rounds(rounds) {
                Err(SearchError::Long { seconds, .. }) => {
                    report.remark(format!(
                        "values of {name} with more integrals of degree {degree}, and what comes after, \
                         are not sought: the bound is {seconds} s, see --count-seconds"
                    ));
                    return Ok(degree - 1);
                }
                found => found?,
            };
            let Some(found) = found else {
                report.remark(format!(
                    "values of {name} with more integrals are not sought: the equations are not \
                     fractions of low degree in it"
                ));
                is_sought = false;
                continue;
            };
            let explained = explained(parameter, all, &found.rounds);
            let mut equations: Vec<String> = Vec::new();
            for relation in &explained.relations {
                let text = relation.to_string();
                if told.contains(&text) {
                    continue;
                }
                if let Relation::Value(_, value) = relation {
                    let number = Formula::number(value.clone());
                    if let Some(fixed) = split.with(vec![(place, number)]) {
                        if !is_filled(&fixed.case, &effort.options)? {
                            told.push(text.clone());
                            report.remark(unfilled(&text));
                            continue;
                        }
                        let with = Given::Value(format!("{name} = {value}"));
                        integrals_with(&fixed.case, with, effort, report)?;
                    }
                }
                equations.push(text);
            }
            let first = found.rounds.first().filter(|_| all.len() == 1);
            // On a level that the solution does not fill at a value, what is counted is no function.
            let first = first.filter(|_| case.model.level.is_empty());
            let others = match first {
                Some(own) if search.are_special(own, &found.rest)? => {
                    of_irrational(own, &found.rest).map(|product| {
                        // Those of lower degrees are known.
                        let new = without_factors(product, &polynomials);
                        polynomials.push(new.clone());
                        written(name, new)
                    })
                }
                _ => None,
            };
            let open = match others {
                Some(_) => OpenValues::default(),
                None => OpenValues {
                    unexplained: explained.unexplained,
                    roots: found.rest.len().saturating_sub(1),
                },
            };
            equations.extend(others.flatten().filter(|own| !told.contains(own)));
            if equations.is_empty() && open.count() == 0 {
                continue;
            }
            told.extend(equations.iter().cloned());
            report.conditions.push(ParameterCondition {
                of: format!("more polynomial integrals of degree at most {degree}, by {name}"),
                equations,
                grounds: format!(
                    "minors of the equations for the coefficients; {}{}",
                    open.words(parameter),
                    split.reservation()
                ),
                origin: ConditionOrigin::Polynomials,
            });
        }
    }
    Ok(if is_sought { effort.degree } else { 0 })
}

/// Numbers of values that are not written as relations.
#[derive(Clone, Copy, Default)]
struct OpenValues {
    /// Values in the prime field with more integrals.
    unexplained: usize,
    /// Common roots of some minors that are not in the field.
    roots: usize,
}

impl OpenValues {
    fn count(self) -> usize {
        self.unexplained + self.roots
    }

    /// Says how many values there may be besides those told.
    fn words(self, parameter: &ScalarParameter) -> String {
        let own = match self.unexplained {
            0 => None,
            n => Some(unexplained(n, parameter)),
        };
        let roots = match self.roots {
            0 => None,
            n => Some(format!("up to {n} further values, none of them rational, may have more")),
        };
        match (own, roots) {
            (None, None) => "modulo a prime of 61 bits no other value has more".to_string(),
            (own, roots) => own.into_iter().chain(roots).collect::<Vec<_>>().join("; "),
        }
    }
}

/// Searches a case with a condition on its parameters for integrals besides those in general.
pub fn integrals_with(
    fixed: &Case,
    condition: Given,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let known = report.found.iter().filter(|own| own.is_integral());
    let mut own = SearchReport { found: known.cloned().collect(), ..SearchReport::default() };
    let before = own.found.len();
    match orbit::search(fixed, effort, false, &mut own, &mut |_| {}) {
        Err(SearchError::Stopped) => return Err(SearchError::Stopped),
        Err(error) => {
            report.remark(format!("no integrals are sought with {}: {error}", condition.text()));
        }
        Ok(()) => {}
    }
    for mut found in
        own.found.into_iter().skip(before).filter(|own| own.kind == FoundKind::Integral)
    {
        found.with.push(condition.clone());
        report.found.push(found);
    }
    Ok(())
}

/// Special values of a parameter.
#[derive(Default)]
struct SpecialValues {
    /// Values in the prime field, for each choice of the other parameters.
    rounds: Vec<Round>,
    /// Polynomial of the last round whose roots are not in the field.
    rest: Polynomial,
}

/// Equations for the coefficients of polynomial integrals, as functions of one parameter.
struct OneParameter<'e> {
    equations: ParametricEquations<'e>,
    draw: usize,
    /// Number of elementary steps that may still be taken.
    left: &'e Cell<f64>,
}

impl OneParameter<'_> {
    /// Finds the special values for some choices of the other parameters; `None` if there is no choice of
    /// the parameters, or no fraction.
    fn rounds(&self, count: u64) -> Result<Option<SpecialValues>, SearchError> {
        let mut found = SpecialValues::default();
        for round in 0..count {
            let Some(base) = self.equations.system.at(round, round) else { return Ok(None) };
            let Some((values, rest)) = self.special(&base, round)? else { return Ok(None) };
            let (parameters, modulus) = (base.parameters, base.modulus);
            found.rounds.push(Round { values, parameters, modulus });
            found.rest = rest;
        }
        Ok(Some(found))
    }

    /// Whether the irrational values of a round, and the roots of a further polynomial, have more integrals
    /// modulo other primes: at each of the roots there, for one prime at least.
    ///
    /// Minors with the columns of one choice of the parameters may vanish where others do not.
    fn are_special(&self, own: &Round, rest: &[u64]) -> Result<bool, SearchError> {
        let Some(polynomial) = of_irrational(own, rest) else { return Ok(false) };
        let mut primes = 0;
        for prime in 1..PRIMES {
            let Some(base) = self.equations.system.at(prime, prime) else { continue };
            let m = base.modulus;
            let Some(general) = self.equations.nullity(&base)? else { continue };
            let image: Option<Polynomial> = polynomial.iter().map(|own| m.rational(own)).collect();
            let Some(image) = image else { continue };
            let roots = PrimePolynomials(m).roots(&image);
            for value in &roots {
                self.equations.effort.halt.check()?;
                if self.equations.nullity(&self.with(&base, *value))?.is_none_or(|n| n <= general) {
                    return Ok(false);
                }
            }
            primes += usize::from(!roots.is_empty());
            if primes == ENOUGH {
                break;
            }
        }
        Ok(primes > 0)
    }

    fn with(&self, base: &PrimePoint, value: u64) -> PrimePoint {
        let mut at = base.clone();
        at.parameters[self.draw] = value;
        at
    }

    /// Finds the values with more integrals than in general, and a polynomial with the other roots that
    /// some minors have in common.
    fn special(
        &self,
        base: &PrimePoint,
        round: u64,
    ) -> Result<Option<(Vec<u64>, Polynomial)>, SearchError> {
        let m = &base.modulus;
        let ring = PrimePolynomials(*m);
        let mut rng = SearchStream::Minors
            .under(self.equations.effort.options.seed.wrapping_add(100 + round));
        let Some(general) = self.equations.nullity(base)? else { return Ok(None) };
        let Some(columns) = self.equations.columns(base)? else { return Ok(None) };
        let mut common: Polynomial = Vec::new();
        let (mut found, mut rest) = (Vec::new(), Vec::new());
        for number in 0..MINORS.1 {
            let Some(own) = self.minor(base, number, &columns, &mut rng)? else { return Ok(None) };
            common = ring.square_free(&ring.common(&common, &own));
            if number + 1 < MINORS.0 {
                continue;
            }
            found.clear();
            rest.clone_from(&common);
            for value in ring.roots(&common) {
                self.equations.effort.halt.check()?;
                // Without a state the field has no integrals there either.
                if self.equations.nullity(&self.with(base, value))?.is_some_and(|own| own > general)
                {
                    found.push(value);
                }
                rest = ring.divided(&rest, &[m.sub(0, value), m.one()]).0;
            }
            if rest.len() < 2 {
                break;
            }
        }
        Ok(Some((found, rest)))
    }

    /// Finds the numerator of a maximal minor at other states and with other columns.
    fn minor(
        &self,
        base: &PrimePoint,
        number: u64,
        columns: &[usize],
        rng: &mut ProofRng,
    ) -> Result<Option<Polynomial>, SearchError> {
        let m = base.modulus;
        let ring = PrimePolynomials(m);
        let stream = STREAM + number;
        let mut order = columns.to_vec();
        for k in (1..order.len()).rev() {
            order.swap(k, (m.to_integer(rng.element(&m)) % (k as u64 + 1)) as usize);
        }
        let count = order.len() + SPARE;
        let at = self.with(base, rng.element(&m));
        let Some(rows) = self.equations.system.rows(&at, stream, &order, count) else {
            return Ok(None);
        };
        let mut echelon = Echelon::new(order.len(), m);
        let mut kept = Vec::new();
        for (place, row) in rows.into_iter().enumerate() {
            self.equations.effort.halt.check()?;
            if echelon.push(row) {
                kept.push(place);
            }
        }
        let pivots: Vec<usize> =
            (0..order.len()).filter(|k| echelon.has_pivot(*k)).map(|k| order[k]).collect();
        let (size, states) = (pivots.len() as f64, count as f64);
        let steps = size * size * (size + ENTRY) + ENTRY * size * (states - size);
        let mut values = Vec::new();
        let mut wanted = VALUES.0;
        while wanted <= VALUES.1 {
            while values.len() < wanted {
                self.equations.effort.halt.check()?;
                self.left.set(self.left.get() - steps);
                if self.left.get() < 0.0 {
                    let seconds = self.equations.effort.seconds;
                    return Err(SearchError::Long { unknowns: pivots.len(), seconds });
                }
                let value = rng.element(&m);
                let at = self.with(base, value);
                let Some(rows) = self.equations.system.rows(&at, stream, &pivots, count) else {
                    return Ok(None);
                };
                let matrix = kept.iter().map(|place| rows[*place].clone()).collect();
                values.push((value, determinant(&m, matrix, &self.equations.effort.halt)?));
            }
            if let Some(found) = ring.polynomial(&values) {
                return Ok(Some(found));
            }
            if let Some((numerator, _)) = ring.fraction(&values) {
                return Ok(Some(numerator));
            }
            wanted += wanted.div_ceil(2);
        }
        Ok(None)
    }
}
