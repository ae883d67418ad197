//! Values of several parameters at which a statement holds that holds on no hypersurface through them.
//!
//! The statement holds where some fractions f(θ) vanish: the residual of a claim at random states, or
//! minors of the equations for the coefficients of integrals. Their numerators are polynomials, known from
//! values modulo a prime. Their greatest common divisor is the condition of codimension one; what is left
//! of them vanishes at the other values ([`ideal`](super::ideal)).

use std::cell::Cell;

use liouville::number::prime::{Modulus, PrimePolynomials};
use liouville::proof::ProofRng;

use super::equations::ParametricEquations;
use super::hypersurface::{Hypersurface, PrimeTerms};
use super::ideal::{self, CommonZeros};
use super::minors::determinant;
use super::quotient::without_common;
use super::real::RealSearch;
use super::residual::Residual;
use super::split::SplitCase;
use super::variety::power;
use crate::budget::STEPS;
use crate::echelon::Echelon;
use crate::orbit::monomials;
use crate::series::exponents;
use crate::streams::SearchStream;
use crate::{Effort, Halt, SearchError};

/// Numbers of values along a line from which degrees are read, one after the other.
const VALUES: [usize; 3] = [12, 32, 72];
/// Largest number of coefficients of a numerator and a denominator.
const COEFFICIENTS: usize = 600;
/// Number of values beyond the coefficients.
const SPARE: usize = 8;
/// Largest number of polynomials.
const POLYNOMIALS: usize = 48;
/// Number of states or minors in a row without a further polynomial after which there is none.
const SILENT: usize = 3;
/// Number of states in a row without values after which the search ends.
const UNDEFINED: usize = 16;
/// First stream of states for minors.
const STREAM: u64 = 9000;
/// Steps of one multiplication modulo a prime and what belongs to it, and for one entry of the equations.
const STEP: f64 = 3.0;

/// Share of the time of a count that these values may take, for a claim or for one degree.
pub const SHARE: f64 = 0.1;

/// Fractions of the parameters, by number, at a point.
type Fractions<'f> = &'f mut dyn FnMut(u64, &[u64]) -> Result<Option<Vec<u64>>, SearchError>;

/// A numerator and a denominator.
type Fraction = [PrimeTerms; 2];

/// Values of the parameters besides those of codimension one.
pub struct IsolatedValues {
    /// Sets of equations that have real solutions.
    pub written: Vec<Vec<Hypersurface>>,
    /// Number of further sets without short coefficients, or of which it is not known whether they have.
    pub unknown: usize,
    /// The polynomial whose zeros are the values of codimension one, and its prime.
    pub common: (PrimeTerms, Modulus),
}

/// Finds the values of the parameters for which a residual vanishes at all states, besides those of
/// codimension one; `None` if the residual is not a fraction of low degree.
pub fn of_claim(
    split: &SplitCase,
    residual: &Residual,
    effort: &Effort,
) -> Result<Option<IsolatedValues>, SearchError> {
    let seed = effort.options.seed;
    let mut rng = SearchStream::Residuals.under(seed.wrapping_add(1));
    let m = residual.prime(&mut rng);
    let mut evaluator = residual.evaluator(m);
    let base = residual.parameters(&m, &mut rng);
    let mut states: Vec<Vec<u64>> = Vec::new();
    let mut states_rng = SearchStream::Residuals.under(seed.wrapping_add(2));
    let mut values = |number: u64, point: &[u64]| {
        while states.len() <= number as usize {
            states.push(residual.state(&m, &mut states_rng));
        }
        let mut parameters = base.clone();
        split.scalars.iter().zip(point).for_each(|(own, value)| parameters[own.draw] = *value);
        let inputs = [parameters.as_slice(), &states[number as usize]].concat();
        let [own, ..] = residual.at(&mut evaluator, &std::array::from_fn(|_| inputs.clone()));
        Ok(own.residual)
    };
    let left = Cell::new(SHARE * effort.seconds * STEPS);
    found(&mut values, split.scalars.len(), (&m, &mut rng), &left, &effort.halt)
}

/// Finds the values of the parameters for which there are more polynomial integrals, besides those of
/// codimension one; the steps taken are subtracted from `left`. `None` if the minors are not fractions
/// of low degree, or that takes too long.
pub fn of_integrals(
    equations: &ParametricEquations<'_>,
    split: &SplitCase,
    left: &Cell<f64>,
) -> Result<Option<IsolatedValues>, SearchError> {
    let Some(base) = equations.system.at(0, 0) else { return Ok(None) };
    let Some(columns) = equations.columns(&base)? else { return Ok(None) };
    let Some(general) = equations.nullity(&base)? else { return Ok(None) };
    let m = base.modulus;
    let Some(rank) = columns.len().checked_sub(general).filter(|rank| *rank > 0) else {
        return Ok(None);
    };
    let effort = equations.effort;
    let mut rng = SearchStream::Minors.under(effort.options.seed.wrapping_add(400));
    let mut mixed: Vec<Vec<Vec<u64>>> = Vec::new();
    let mut mixed_rng = SearchStream::Minors.under(effort.options.seed.wrapping_add(401));
    let (size, all) = (rank as f64, columns.len() as f64);
    let steps = STEP * (size * size * (size / 3.0 + all)) + ENTRY * size * all;
    let mut values = |number: u64, point: &[u64]| {
        effort.halt.check()?;
        left.set(left.get() - steps);
        if left.get() < 0.0 {
            return Err(SearchError::Long { unknowns: rank, seconds: effort.seconds });
        }
        // A minor of random states, and of random combinations of the columns.
        while mixed.len() <= number as usize {
            let mut column = || columns.iter().map(|_| mixed_rng.element(&m)).collect();
            mixed.push((0..rank).map(|_| column()).collect());
        }
        let mut at = base.clone();
        split.scalars.iter().zip(point).for_each(|(own, value)| at.parameters[own.draw] = *value);
        let Some(rows) = equations.system.rows(&at, STREAM + number, &columns, rank) else {
            return Ok(None);
        };
        let sum = |row: &[u64], mixed: &Vec<u64>| {
            row.iter().zip(mixed).fold(0, |sum, (a, x)| m.add(sum, m.mul(*a, *x)))
        };
        let entries = |row: Vec<u64>| -> Vec<u64> {
            mixed[number as usize].iter().map(|own| sum(&row, own)).collect()
        };
        let matrix = rows.into_iter().map(entries).collect();
        Ok(Some(vec![determinant(&m, matrix, &effort.halt)?]))
    };
    match found(&mut values, split.scalars.len(), (&m, &mut rng), left, &effort.halt) {
        Err(SearchError::Long { .. }) => Ok(None),
        other => other,
    }
}

/// Steps for one entry of the equations at one state.
const ENTRY: f64 = super::parameter_line::ENTRY;

/// Finds the common zeros of fractions besides those of codimension one.
fn found(
    values: Fractions<'_>,
    variables: usize,
    (m, rng): (&Modulus, &mut ProofRng),
    left: &Cell<f64>,
    halt: &Halt,
) -> Result<Option<IsolatedValues>, SearchError> {
    let Some(all) = numerators(values, variables, (m, &mut *rng), left)? else { return Ok(None) };
    if all.is_empty() {
        let common = (PrimeTerms::new(), *m);
        return Ok(Some(IsolatedValues { written: Vec::new(), unknown: 0, common }));
    }
    let (above, below): (Vec<PrimeTerms>, Vec<PrimeTerms>) =
        all.into_iter().map(|[above, below]| (above, below)).unzip();
    let Some((rest, common)) = without_common(&above, m, rng) else { return Ok(None) };
    // On the hypersurfaces it holds anyway, and where all denominators are 0 nothing has a value.
    let is_left_out = |own: &[PrimeTerms]| -> Result<bool, SearchError> {
        if ideal::contains(own, &common, variables, m, halt)? {
            return Ok(true);
        }
        for below in &below {
            if !ideal::contains(own, below, variables, m, halt)? {
                return Ok(false);
            }
        }
        Ok(true)
    };
    let zeros = ideal::zeros(&rest, variables, (m, &mut *rng), left, halt)?;
    let Some(CommonZeros { written, unwritten }) = zeros else { return Ok(None) };
    let mut found =
        IsolatedValues { written: Vec::new(), unknown: 0, common: (common.clone(), *m) };
    for own in unwritten {
        found.unknown += usize::from(!is_left_out(&own)?);
    }
    for own in written {
        let images: Option<Vec<PrimeTerms>> = own.iter().map(|own| own.images(m)).collect();
        if is_left_out(&images.unwrap_or_default())? {
            continue;
        }
        let own = RealSearch { variables, m: *m, rng: &mut *rng, left, halt }.zeros(&own)?;
        found.unknown += own.unknown();
        found.written.extend(own.real);
    }
    Ok(Some(found))
}

/// Finds numerators and denominators of fractions, until there are no further numerators; `None` if one
/// is not of low degree, or has no values, or the steps that are left are spent.
fn numerators(
    values: Fractions<'_>,
    variables: usize,
    (m, rng): (&Modulus, &mut ProofRng),
    left: &Cell<f64>,
) -> Result<Option<Vec<Fraction>>, SearchError> {
    let Some(most) = ideal::highest(variables) else { return Ok(None) };
    let all: Vec<Vec<u32>> = (0..=most).flat_map(|total| exponents(variables, total)).collect();
    let mut span = Echelon::new(all.len(), *m);
    let mut found: Vec<Fraction> = Vec::new();
    let (mut silent, mut undefined) = (0, 0);
    for number in 0.. {
        if silent == SILENT || found.len() >= POLYNOMIALS {
            break;
        }
        let Some(degrees) = degrees(values, number, variables, m, rng)? else {
            undefined += 1;
            if undefined == UNDEFINED {
                return Ok(None);
            }
            continue;
        };
        undefined = 0;
        let Some(degrees) = degrees else { return Ok(None) };
        let Some(own) = interpolated(values, number, (&degrees, &all), (m, &mut *rng), left)?
        else {
            return Ok(None);
        };
        silent += 1;
        for own in own {
            let mut row = own[0].clone();
            row.resize(all.len(), 0);
            if span.push(row) {
                silent = 0;
                let terms = |own: Vec<u64>| -> PrimeTerms {
                    let terms = all.iter().cloned().zip(own);
                    terms.filter(|(_, image)| *image != 0).collect()
                };
                found.push(own.map(terms));
            }
        }
    }
    Ok(Some(found))
}

/// Degrees of the numerator and the denominator of each fraction; `None` if one is not of low degree.
type Degrees = Option<Vec<(u32, u32)>>;

/// Reads degrees off the values on a random line; the outer `None` is for fractions without values.
fn degrees(
    values: Fractions<'_>,
    number: u64,
    variables: usize,
    m: &Modulus,
    rng: &mut ProofRng,
) -> Result<Option<Degrees>, SearchError> {
    let ring = PrimePolynomials(*m);
    let (origin, slope): (Vec<u64>, Vec<u64>) =
        (0..variables).map(|_| (rng.element(m), rng.element(m))).unzip();
    let mut seen: Vec<(u64, Vec<u64>)> = Vec::new();
    let mut next = 0;
    for count in VALUES {
        while seen.len() < count {
            if next >= UNDEFINED as u64 + 2 * seen.len() as u64 {
                return Ok(None);
            }
            let t = m.integer(next);
            let point: Vec<u64> =
                origin.iter().zip(&slope).map(|(a, b)| m.add(*a, m.mul(t, *b))).collect();
            seen.extend(values(number, &point)?.map(|own| (t, own)));
            next += 1;
        }
        let height = seen.first().map_or(0, |(_, own)| own.len());
        let own = (0..height).map(|k| {
            let values: Vec<(u64, u64)> = seen.iter().map(|(t, own)| (*t, own[k])).collect();
            let (above, below) = ring.fraction(&values)?;
            let degree = |own: &[u64]| own.len().saturating_sub(1) as u32;
            Some((degree(&above), degree(&below)))
        });
        let own: Degrees = own.collect();
        if own.is_some() {
            return Ok(Some(own));
        }
    }
    Ok(Some(None))
}

/// Finds the coefficients of the numerators and denominators of fractions with these degrees by the first
/// monomials of a list; `None` if there are too many, or too few values.
fn interpolated(
    values: Fractions<'_>,
    number: u64,
    (degrees, all): (&[(u32, u32)], &[Vec<u32>]),
    (m, rng): (&Modulus, &mut ProofRng),
    left: &Cell<f64>,
) -> Result<Option<Vec<[Vec<u64>; 2]>>, SearchError> {
    let variables = all.first().map_or(0, Vec::len);
    let size = |degree: u32| monomials::count(variables, degree);
    let widths = degrees.iter().map(|(above, below)| size(*above) + size(*below));
    let wanted = widths.max().unwrap_or(0);
    let is_large = |(above, below): &(u32, u32)| size(*above).max(size(*below)) > all.len();
    let size_of = |(above, below): &(u32, u32)| (size(*above) + size(*below)) as f64;
    let steps: f64 = degrees.iter().map(|own| size_of(own).powi(3) / 3.0).sum();
    left.set(left.get() - steps);
    if wanted > COEFFICIENTS || degrees.iter().any(is_large) || left.get() < 0.0 {
        return Ok(None);
    }
    let mut echelons: Vec<Echelon> = degrees
        .iter()
        .map(|(above, below)| Echelon::new(size(*above) + size(*below), *m))
        .collect();
    let mut count = 0;
    for _ in 0..2 * (wanted + SPARE) {
        if count == wanted + SPARE {
            break;
        }
        let point: Vec<u64> = (0..variables).map(|_| rng.element(m)).collect();
        let Some(seen) = values(number, &point)? else { continue };
        count += 1;
        let powers: Vec<u64> = all.iter().map(|own| power(&point, own, m)).collect();
        for ((echelon, (above, below)), value) in echelons.iter_mut().zip(degrees).zip(seen) {
            let lower = powers[..size(*below)].iter().map(|own| m.sub(0, m.mul(*own, value)));
            echelon.push(powers[..size(*above)].iter().copied().chain(lower).collect());
        }
    }
    if count < wanted + SPARE {
        return Ok(None);
    }
    let vector = |(echelon, (above, _)): (&Echelon, &(u32, u32))| -> Option<[Vec<u64>; 2]> {
        let mut vectors = echelon.null_space();
        let mut vector = vectors.pop().filter(|_| vectors.is_empty())?;
        let below = vector.split_off(size(*above));
        Some([vector, below])
    };
    Ok(echelons.iter().zip(degrees).map(vector).collect())
}
