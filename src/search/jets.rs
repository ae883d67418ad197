//! How many integrals polynomial in the velocities there are, with arbitrary smooth coefficients in
//! the positions: counted from Taylor coefficients at one random point, without any ansatz.
//!
//! F = Σ C_a(q) w^a is an integral when the coefficients of every w^c in L_vF vanish: linear
//! equations of first order for the C_a. Their Taylor coefficients up to order N, modulo a prime,
//! at a random point and for random parameters: the dimension of what is left of the coefficients up
//! to order n bounds the number of integrals of degree n from above. A rank modulo p is never above
//! the rank in characteristic 0, so that an empty answer is a theorem about generic parameters.

use rustc_hash::FxHashMap;

use super::SearchError;
use super::echelon::Echelon;
use super::local::Local;
use super::series::{Series, exponents};
use crate::graph::{Evaluator, Tape};
use crate::mechanics::Draw;
use crate::number::prime::Modulus;
use crate::proof::Chance;

/// Points that are drawn until the field has a Taylor series at one.
const MOST_POINTS: usize = 4096;

/// Velocity exponents with a series each.
type Polynomial = Vec<(Vec<u32>, Vec<u64>)>;

/// Columns and values of a sparse row.
type Entries = Vec<(usize, u64)>;

/// The rates at a point of the velocities, if they have a value.
type Rates<'a> = dyn FnMut(&[u64]) -> Option<Vec<Vec<u64>>> + 'a;

/// The field's Taylor series: polynomials in the velocities with series as coefficients.
struct Expansion {
    series: Series,
    /// For each position: velocity exponents and coefficient of its rate.
    positions: Vec<Polynomial>,
    /// The same for each velocity.
    velocities: Vec<Polynomial>,
}

/// The number of integrals of one degree, as an upper bound for generic parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Count {
    /// The degree in the velocities.
    pub degree: u32,
    /// All degrees up to it together, as a gyrostat or a potential asks for?
    pub mixed: bool,
    /// The dimension.
    pub dimension: usize,
    /// Unknowns and equations.
    pub size: (usize, usize),
}

/// Counts integrals of a degree, of which `least` are known to be there; the order of the Taylor
/// coefficients rises until the count stands still.
pub fn count(
    local: &Local,
    degree: u32,
    mixed: bool,
    least: usize,
    seed: u64,
) -> Result<Count, SearchError> {
    let mut last = None;
    for order in [2 * degree + 2, 2 * degree + 3, 2 * degree + 5, 2 * degree + 7] {
        let found = count_to_order(local, degree, mixed, order, seed)?;
        if found.dimension <= least || last == Some(found.dimension) {
            return Ok(found);
        }
        last = Some(found.dimension);
    }
    Err(SearchError::Unsettled(degree))
}

fn count_to_order(
    local: &Local,
    degree: u32,
    mixed: bool,
    order: u32,
    seed: u64,
) -> Result<Count, SearchError> {
    let mut chance = Chance::new(seed, 40);
    let modulus = chance.prime(&[], &[]);
    let expansion = Expansion::of(local, modulus, order, &mut chance)?;
    let m = &modulus;
    let velocities = local.coordinates.velocities;
    let lowest = if mixed { 0 } else { degree };
    let powers: Vec<Vec<u32>> = (lowest..=degree).flat_map(|n| exponents(velocities, n)).collect();
    let monomials = expansion.series.monomials();
    let total = |monomial: &[u32]| monomial.iter().sum::<u32>();
    let place: FxHashMap<&[u32], usize> =
        monomials.iter().enumerate().map(|(k, monomial)| (monomial.as_slice(), k)).collect();
    // Columns from high order to low: what is left free at the end is of low order.
    let mut columns: Vec<(usize, usize)> =
        (0..powers.len()).flat_map(|a| (0..monomials.len()).map(move |k| (a, k))).collect();
    columns.sort_by_key(|(a, k)| (std::cmp::Reverse(total(&monomials[*k])), *a, *k));
    let mut rows: FxHashMap<(Vec<u32>, usize), Entries> = FxHashMap::default();
    for (column, (a, k)) in columns.iter().enumerate() {
        let mut add = |power: Vec<u32>, monomial: &[u32], coefficient: &[u64], factor: u64| {
            for (other, value) in monomials.iter().zip(coefficient) {
                if *value == 0 {
                    continue;
                }
                let sum: Vec<u32> = monomial.iter().zip(other).map(|(x, y)| x + y).collect();
                if total(&sum) < order {
                    let row = rows.entry((power.clone(), place[sum.as_slice()])).or_default();
                    row.push((column, m.mul(factor, *value)));
                }
            }
        };
        let (power, monomial) = (&powers[*a], &monomials[*k]);
        // ∂C/∂q_i q_i'
        for (i, rate) in expansion.positions.iter().enumerate().filter(|(i, _)| monomial[*i] > 0) {
            let mut lower = monomial.clone();
            lower[i] -= 1;
            let factor = m.integer(u64::from(monomial[i]));
            for (w, coefficient) in rate {
                let raised = power.iter().zip(w).map(|(x, y)| x + y).collect();
                add(raised, &lower, coefficient, factor);
            }
        }
        // C ∂w^a/∂w_i w_i'
        for (i, rate) in expansion.velocities.iter().enumerate().filter(|(i, _)| power[*i] > 0) {
            let factor = m.integer(u64::from(power[i]));
            for (w, coefficient) in rate {
                let mut raised: Vec<u32> = power.iter().zip(w).map(|(x, y)| x + y).collect();
                raised[i] -= 1;
                add(raised, monomial, coefficient, factor);
            }
        }
    }
    let mut rows: Vec<_> = rows.into_iter().collect();
    rows.sort_by(|(a, _), (b, _)| a.cmp(b));
    let size = (columns.len(), rows.len());
    let mut echelon = Echelon::new(columns.len(), modulus);
    for (_, entries) in rows {
        let mut row = vec![0; columns.len()];
        for (column, value) in entries {
            row[column] = m.add(row[column], value);
        }
        echelon.push(row);
    }
    let low = |column: usize| total(&monomials[columns[column].1]) <= degree;
    let dimension =
        (0..columns.len()).filter(|column| low(*column) && !echelon.has_pivot(*column)).count();
    Ok(Count { degree, mixed, dimension, size })
}

impl Expansion {
    fn of(
        local: &Local,
        modulus: Modulus,
        order: u32,
        chance: &mut Chance,
    ) -> Result<Self, SearchError> {
        let (positions, velocities) = (local.coordinates.positions, local.coordinates.velocities);
        let series = Series::new(modulus, positions, order);
        let tape = Tape::new(&local.graph, &local.rates);
        let mut evaluator = Evaluator::new(&tape, series.clone());
        for _ in 0..MOST_POINTS {
            let mut inputs: Vec<Vec<u64>> = local
                .draws
                .iter()
                .map(|draw| {
                    let listed = match draw {
                        Draw::OneOf(values) => values.first().and_then(|x| modulus.rational(x)),
                        Draw::Within(_) | Draw::Of(..) => None,
                    };
                    series.number(listed.unwrap_or_else(|| chance.element(&modulus)))
                })
                .collect();
            inputs.extend((0..positions).map(|k| series.variable(k, chance.element(&modulus))));
            let mut rates_at = |point: &[u64]| -> Option<Vec<Vec<u64>>> {
                let mut inputs = inputs.clone();
                inputs.extend(point.iter().map(|w| series.number(*w)));
                evaluator.run(&inputs);
                let found: Vec<Vec<u64>> = evaluator.outputs().cloned().collect();
                found.iter().all(|rate| !rate.is_empty()).then_some(found)
            };
            let check: Vec<u64> = (0..velocities).map(|_| chance.element(&modulus)).collect();
            let Some(polynomials) = quadratic(velocities, &modulus, &mut rates_at) else {
                continue;
            };
            let Some(found) = rates_at(&check) else { continue };
            if !agrees(&polynomials, &check, &found, &modulus) {
                return Err(SearchError::NotQuadratic);
            }
            if !spans(&polynomials[..positions], velocities, modulus) {
                return Err(SearchError::NotSpanned);
            }
            let mut rates = polynomials.into_iter();
            return Ok(Self {
                positions: rates.by_ref().take(positions).collect(),
                velocities: rates.collect(),
                series,
            });
        }
        Err(SearchError::NoSeries)
    }
}

/// Do the rates of the positions take all directions? Then Σ w_i X_i C = 0 determines the
/// coefficients of degree n by their n-jets, as for Killing tensors.
fn spans(rates: &[Polynomial], velocities: usize, modulus: Modulus) -> bool {
    let mut echelon = Echelon::new(velocities, modulus);
    rates.iter().all(|rate| {
        let slope = |i: usize| {
            let is_unit = |e: &Vec<u32>| e[i] == 1 && e.iter().sum::<u32>() == 1;
            rate.iter().find(|(exponent, _)| is_unit(exponent)).map_or(0, |(_, series)| series[0])
        };
        echelon.push((0..velocities).map(slope).collect())
    })
}

/// Polynomials of degree 2 from their values at 0, ±e_i and e_i + e_j.
fn quadratic(velocities: usize, m: &Modulus, rates_at: &mut Rates<'_>) -> Option<Vec<Polynomial>> {
    let unit = |entries: &[(usize, u64)]| -> Vec<u64> {
        let mut point = vec![0; velocities];
        entries.iter().for_each(|(i, value)| point[*i] = *value);
        point
    };
    let exponent = |entries: &[usize]| -> Vec<u32> {
        let mut exponent = vec![0; velocities];
        entries.iter().for_each(|i| exponent[*i] += 1);
        exponent
    };
    let (one, half) = (m.one(), m.inverse(m.integer(2)));
    let combine = |a: &[u64], b: &[u64], f: &dyn Fn(u64, u64) -> u64| -> Vec<u64> {
        a.iter().zip(b).map(|(a, b)| f(*a, *b)).collect()
    };
    let at_zero = rates_at(&unit(&[]))?;
    let mut polynomials: Vec<Polynomial> =
        at_zero.iter().map(|constant| vec![(exponent(&[]), constant.clone())]).collect();
    let mut at_unit = Vec::new();
    for i in 0..velocities {
        let (plus, minus) =
            (rates_at(&unit(&[(i, one)]))?, rates_at(&unit(&[(i, m.sub(0, one))]))?);
        for (k, polynomial) in polynomials.iter_mut().enumerate() {
            let linear = combine(&plus[k], &minus[k], &|a, b| m.mul(half, m.sub(a, b)));
            let even = combine(&plus[k], &minus[k], &|a, b| m.mul(half, m.add(a, b)));
            polynomial.push((exponent(&[i]), linear));
            polynomial.push((exponent(&[i, i]), combine(&even, &at_zero[k], &|a, b| m.sub(a, b))));
        }
        at_unit.push(plus);
    }
    for i in 0..velocities {
        for j in i + 1..velocities {
            let both = rates_at(&unit(&[(i, one), (j, one)]))?;
            for (k, polynomial) in polynomials.iter_mut().enumerate() {
                let rest = combine(&both[k], &at_unit[i][k], &|a, b| m.sub(a, b));
                let rest = combine(&rest, &at_unit[j][k], &|a, b| m.sub(a, b));
                polynomial
                    .push((exponent(&[i, j]), combine(&rest, &at_zero[k], &|a, b| m.add(a, b))));
            }
        }
    }
    for polynomial in &mut polynomials {
        polynomial.retain(|(_, coefficient)| coefficient.iter().any(|x| *x != 0));
    }
    Some(polynomials)
}

/// Are these the values of the polynomials at a further point?
fn agrees(polynomials: &[Polynomial], point: &[u64], values: &[Vec<u64>], m: &Modulus) -> bool {
    polynomials.iter().zip(values).all(|(polynomial, value)| {
        let mut sum = vec![0; value.len()];
        for (exponent, coefficient) in polynomial {
            let powers = point.iter().zip(exponent).map(|(w, e)| m.power(*w, u64::from(*e)));
            let factor = powers.fold(m.one(), |a, b| m.mul(a, b));
            for (entry, x) in sum.iter_mut().zip(coefficient) {
                *entry = m.add(*entry, m.mul(factor, *x));
            }
        }
        sum == *value
    })
}
