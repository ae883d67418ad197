//! Conditions of codimension two, which random parameters in a small field meet often enough.
//!
//! A variety of codimension two has about one point in p². Most conditions met in one field may be
//! accidents of that field; so equations are found modulo one prime and confirmed modulo another.

use std::cell::Cell;

use super::hypersurface::Hypersurface;
use super::isolated::SHARE;
use super::real::RealSearch;
use super::residual::{RESIDUAL_LANES, Residual};
use super::variety::{VarietyEquation, monomial, power, simple};
use crate::budget::STEPS;
use crate::echelon::Echelon;
use crate::series::exponents;
use crate::streams::SearchStream;
use crate::{Effort, Halt, SearchError};
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::proof::ProofRng;

/// Primes that are 3 modulo 4: equations are found modulo the first and confirmed modulo the
/// second.
const PRIMES: [u64; 2] = [43, 47];
/// Number of evaluations in each field.
const RUNS: usize = 75_000;
/// Number of states at which a residual must vanish.
const STATES: usize = 12;
/// Number of points that establish a condition.
const REPEATED: usize = 12;
/// Degree of the equations.
const DEGREE: u32 = 2;
/// Number of random subsets of the points that are tried: some points are accidents of the field.
const SUBSETS: usize = 200;
/// Number of points beyond the number of monomials.
const SPARE_POINTS: usize = 8;

/// Finds systems of equations each of which makes the residual vanish; returns them with the number
/// of points met.
pub fn conditions(
    residual: &Residual,
    effort: &Effort,
) -> Result<(Vec<String>, usize), SearchError> {
    let mut rng = SearchStream::SmallPolynomials.under(effort.options.seed);
    let found = points(residual, PRIMES[0], &mut rng, &effort.halt)?;
    let again = points(residual, PRIMES[1], &mut rng, &effort.halt)?;
    let (first, second) = (Modulus::new(PRIMES[0]), Modulus::new(PRIMES[1]));
    let names = residual.names();
    let all: Vec<usize> = (0..names.len()).collect();
    let met = found.len();
    let mut systems: Vec<String> = Vec::new();
    let (mut plain, mut others) = (Vec::new(), Vec::new());
    for (point, of) in found.iter().map(|p| (p, 0)).chain(again.iter().map(|p| (p, 1))) {
        let own = simple(names, point, &all);
        // A zero parameter is met by accident in half of a small field.
        if own.iter().any(|own| own.terms.len() == 1) {
            continue;
        }
        if own.len() >= 2 {
            let texts: Vec<String> = own.into_iter().map(|own| own.text).collect();
            plain.push((texts.join(" and "), of));
        } else if own.is_empty() {
            others.push((point.clone(), of));
        }
    }
    for (text, _) in &plain {
        let times = |field: usize| plain.iter().filter(|(t, f)| t == text && *f == field).count();
        if !systems.contains(text) && times(0) >= REPEATED && times(1) >= REPEATED {
            systems.push(text.clone());
        }
    }
    let in_field = |field: usize| -> Vec<Vec<u64>> {
        others.iter().filter(|(_, of)| *of == field).map(|(point, _)| point.clone()).collect()
    };
    if let Some(found) = system(names, &in_field(0), &in_field(1), first, second, &mut rng) {
        // Sets without real values, and those of which that is not known, are left out.
        let equations: Vec<Hypersurface> =
            found.iter().filter_map(|own| Hypersurface::from_terms(own.terms.clone())).collect();
        let m = rng.prime(&[], &[]);
        let left = Cell::new(SHARE * effort.seconds * STEPS);
        let (variables, halt) = (names.len(), &effort.halt);
        let mut search = RealSearch { variables, m, rng: &mut rng, left: &left, halt };
        if search.zeros(&equations)?.real.contains(&equations) {
            let texts: Vec<String> = found.into_iter().map(|own| own.text).collect();
            systems.push(texts.join(" and "));
        }
    }
    Ok((systems, met))
}

/// Finds components of random parameters at which the residual vanishes.
fn points(
    residual: &Residual,
    prime: u64,
    rng: &mut ProofRng,
    halt: &Halt,
) -> Result<Vec<Vec<u64>>, SearchError> {
    let small = Modulus::new(prime);
    let large = rng.prime(&[], &[]);
    let mut evaluator = residual.evaluator(small);
    let reduced =
        |values: Vec<u64>| -> Vec<u64> { values.iter().map(|x| small.integer(*x)).collect() };
    let draw = |rng: &mut ProofRng| reduced(residual.parameters(&large, rng));
    let mut found = Vec::new();
    let mut parameters: [Vec<u64>; RESIDUAL_LANES] = std::array::from_fn(|_| draw(rng));
    let (mut zeros, mut looks) = ([0; RESIDUAL_LANES], [0; RESIDUAL_LANES]);
    for _ in 0..RUNS {
        halt.check()?;
        let points = std::array::from_fn(|lane| {
            let state = reduced(residual.state(&large, rng));
            [parameters[lane].as_slice(), &state].concat()
        });
        for (lane, seen) in residual.at(&mut evaluator, &points).into_iter().enumerate() {
            looks[lane] += 1;
            let is_zero = seen.residual.map(|residual| residual.iter().all(|x| *x == 0));
            zeros[lane] += usize::from(is_zero == Some(true));
            let is_hit = zeros[lane] >= STATES;
            if is_hit {
                found.push(seen.components);
            }
            // The next parameters take the lane as soon as these are decided.
            if is_hit || is_zero == Some(false) || looks[lane] >= 4 * STATES {
                parameters[lane] = draw(rng);
                (zeros[lane], looks[lane]) = (0, 0);
            }
        }
    }
    Ok(found)
}

/// Finds the equations of degree two that most points of both fields satisfy.
fn system(
    names: &[String],
    points: &[Vec<u64>],
    again: &[Vec<u64>],
    first: Modulus,
    second: Modulus,
    rng: &mut ProofRng,
) -> Option<Vec<VarietyEquation>> {
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let monomials: Vec<Vec<u32>> =
        (0..=DEGREE).flat_map(|total| exponents(names.len(), total)).collect();
    let wanted = monomials.len() + SPARE_POINTS;
    if points.len() < wanted + REPEATED {
        return None;
    }
    let row = |point: &Vec<u64>, m: &Modulus| -> Vec<u64> {
        monomials.iter().map(|e| power(point, e, m)).collect()
    };
    let large = rng.prime(&[], &[]);
    for _ in 0..SUBSETS {
        let mut echelon = Echelon::new(monomials.len(), first);
        for _ in 0..wanted {
            let index = large.to_integer(rng.element(&large)) as usize % points.len();
            echelon.push(row(&points[index], &first));
        }
        let equations: Vec<Vec<i64>> =
            echelon.null_space().iter().map(|vector| signed(vector, &first)).collect();
        let most = |points: &[Vec<u64>], m: &Modulus| {
            let on = |point: &&Vec<u64>| {
                let row = row(point, m);
                equations.iter().all(|equation| vanishes(equation, &row, m))
            };
            3 * points.iter().filter(on).count() > 2 * points.len()
        };
        if !equations.is_empty() && most(points, &first) && most(again, &second) {
            let texts: Vec<String> = monomials.iter().map(|e| monomial(&names, e)).collect();
            let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
            let written = |own: &Vec<i64>| {
                let own: Vec<Rational> = own.iter().map(|a| Rational::from(*a)).collect();
                VarietyEquation::of(&own, &monomials, &texts)
            };
            return Some(equations.iter().map(written).collect());
        }
    }
    None
}

/// Returns residues of small absolute value.
fn signed(vector: &[u64], m: &Modulus) -> Vec<i64> {
    let prime = m.prime() as i64;
    let near = |x: &u64| {
        let x = m.to_integer(*x) as i64;
        if 2 * x > prime { x - prime } else { x }
    };
    vector.iter().map(near).collect()
}

fn vanishes(equation: &[i64], row: &[u64], m: &Modulus) -> bool {
    let term = |(a, x): (&i64, &u64)| {
        let size = m.mul(m.integer(a.unsigned_abs()), *x);
        if *a < 0 { m.sub(0, size) } else { size }
    };
    equation.iter().zip(row).map(term).fold(0, |sum, x| m.add(sum, x)) == 0
}
