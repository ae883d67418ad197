//! Expansion of the rates of positions and velocities as polynomials in the velocities whose
//! coefficients are Taylor series in the positions.

use super::SearchError;
use super::local::Local;
use super::rates::SplitRates;
use super::series::TruncatedSeries;
use liouville::number::prime::Modulus;
use liouville::proof::ProofRng;

/// Exponents of the velocities, each with a coefficient series.
pub type Polynomial = Vec<(Vec<u32>, Vec<u64>)>;

/// A map from velocities to the rates, `None` where these are undefined.
type Rates<'a> = dyn FnMut(&[u64]) -> Option<Vec<Vec<u64>>> + 'a;

/// Taylor series of the field: polynomials in the velocities with series as coefficients.
pub struct FieldExpansion {
    /// Rates of the positions.
    pub positions: Vec<Polynomial>,
    /// Rates of the velocities.
    pub velocities: Vec<Polynomial>,
}

impl FieldExpansion {
    /// Computes div v in these coordinates, to one order less than the rates.
    pub fn divergence(&self, series: &TruncatedSeries) -> Polynomial {
        let along = self.positions.iter().enumerate().flat_map(|(i, rate)| {
            rate.iter().map(move |(power, value)| (power.clone(), series.derivative(i, value)))
        });
        let across = self.velocities.iter().enumerate().flat_map(|(i, rate)| {
            rate.iter().filter(move |(power, _)| power[i] > 0).map(move |(power, value)| {
                let mut lower = power.clone();
                lower[i] -= 1;
                (lower, series.multiple(power[i], value))
            })
        });
        along.chain(across).filter(|(_, value)| value.iter().any(|x| *x != 0)).collect()
    }
}

/// Expansion of the field up to an order, at points of the configuration.
pub struct Taylor<'l> {
    /// Equations of motion in local coordinates.
    pub local: &'l Local,
    /// Prime modulus.
    pub modulus: Modulus,
    /// Order of the expansion.
    pub order: u32,
    /// Domain of the series.
    pub series: TruncatedSeries,
    rates: SplitRates,
}

impl<'l> Taylor<'l> {
    /// Prepares series modulo a prime.
    pub fn new(local: &'l Local, modulus: Modulus, order: u32) -> Self {
        let series = TruncatedSeries::new(modulus, local.coordinates.positions, order);
        let before = local.draws.len() + local.coordinates.positions + local.functions.len();
        let rates = SplitRates::new(&local.graph, &local.rates, before);
        Self { local, modulus, order, series, rates }
    }

    /// Draws random positions, followed by values of functions there.
    pub fn positions(&self, rng: &mut ProofRng) -> Vec<u64> {
        let count = self.local.coordinates.positions + self.local.functions.len();
        (0..count).map(|_| rng.element(&self.modulus)).collect()
    }

    /// Expands the field about a point; `None` where it is undefined.
    pub fn at(
        &mut self,
        parameters: &[u64],
        positions: &[u64],
        rng: &mut ProofRng,
    ) -> Result<Option<FieldExpansion>, SearchError> {
        let (modulus, series) = (self.modulus, &self.series);
        let velocities = self.local.coordinates.velocities;
        let (positions, values) = positions.split_at(self.local.coordinates.positions);
        // The functions that stand for values are not 0 anywhere.
        if values.contains(&0) {
            return Ok(None);
        }
        let mut inputs: Vec<Vec<u64>> = parameters.iter().map(|x| series.number(*x)).collect();
        inputs.extend(positions.iter().enumerate().map(|(k, x)| series.variable(k, *x)));
        let Some(functions) = self.local.functions.at(series, &inputs, values) else {
            return Ok(None);
        };
        inputs.extend(functions);
        let mut rates = self.rates.at(series, &inputs);
        let mut rates_at = |point: &[u64]| -> Option<Vec<Vec<u64>>> {
            let point: Vec<Vec<u64>> = point.iter().map(|w| series.number(*w)).collect();
            let found = rates(&point);
            found.iter().all(|rate| !rate.is_empty()).then_some(found)
        };
        let check: Vec<u64> = (0..velocities).map(|_| rng.element(&modulus)).collect();
        let Some(polynomials) = quadratic(velocities, &modulus, &mut rates_at) else {
            return Ok(None);
        };
        let Some(found) = rates_at(&check) else { return Ok(None) };
        if !agrees(&polynomials, &check, &found, &modulus) {
            return Err(SearchError::NotQuadratic);
        }
        let mut rates = polynomials.into_iter();
        Ok(Some(FieldExpansion {
            positions: rates.by_ref().take(positions.len()).collect(),
            velocities: rates.collect(),
        }))
    }
}

/// Finds polynomials of degree 2 from their values at 0, ±e_i and e_i + e_j.
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

/// Whether the polynomials have the given values at a further point.
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
