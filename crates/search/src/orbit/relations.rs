//! Numbers of relations along an orbit, and of the algebraic integrals behind them.

use super::super::SearchError;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::monomials::value;
use super::setting::{OrbitRelations, OrbitSetting, PrimePhasePoint, SPARE_ORDERS};
use super::tangents::LocalGradients;

/// Relations of one degree along one orbit.
pub struct RelationStep {
    /// Relations in reduced form.
    pub relations: OrbitRelations,
    /// Number of independent algebraic integrals: that of the relations' gradients along the state and
    /// the level.
    pub integrals: usize,
}

/// Expands one orbit and finds its relations; `None` where it has no series.
pub fn step(
    setting: &OrbitSetting<'_>,
    at: &PrimePoint,
    monomials: &[Vec<u32>],
) -> Result<Option<RelationStep>, SearchError> {
    let Some(relations) = setting.relations(at, 0, monomials)? else { return Ok(None) };
    let point = &relations.point;
    let Some(mut gradients) = setting.tangents.at(at, point) else { return Ok(None) };
    if setting.is_on_level() && !relations.vectors.is_empty() {
        // The gradient of a level function may have no value, or be 0, as that of a square.
        let vanishing = on_level(setting, at, monomials)?;
        count(setting, at, monomials, &vanishing, point, &mut gradients)?;
    }
    let integrals = count(setting, at, monomials, &relations.vectors, point, &mut gradients)?;
    Ok(Some(RelationStep { integrals, relations }))
}

/// Combinations of the monomials that vanish on the level.
fn on_level(
    setting: &OrbitSetting<'_>,
    at: &PrimePoint,
    monomials: &[Vec<u32>],
) -> Result<Vec<Vec<u64>>, SearchError> {
    let m = at.modulus;
    let mut echelon = Echelon::new(monomials.len(), m);
    let mut dependent = 0;
    for number in 0..2 * (monomials.len() + SPARE_ORDERS) as u64 {
        setting.effort.halt.check()?;
        let Some(point) = setting.point(at, number) else { continue };
        let row = monomials.iter().map(|own| value(&m, &point.state, own)).collect();
        dependent = if echelon.push(row) { 0 } else { dependent + 1 };
        if dependent == SPARE_ORDERS {
            break;
        }
    }
    Ok(echelon.null_space())
}

/// Number of polynomials whose gradients at a point are independent of the given ones and of each other.
fn count(
    setting: &OrbitSetting<'_>,
    at: &PrimePoint,
    monomials: &[Vec<u32>],
    vectors: &[Vec<u64>],
    point: &PrimePhasePoint,
    gradients: &mut LocalGradients,
) -> Result<usize, SearchError> {
    let slopes: Vec<Vec<u64>> = monomials.iter().map(|own| gradient(at, own, point)).collect();
    let mut found = 0;
    for vector in vectors {
        setting.effort.halt.check()?;
        let row = combined(at, vector, &slopes, setting.dimension());
        found += usize::from(gradients.push(at, row));
    }
    Ok(found)
}

fn combined(at: &PrimePoint, vector: &[u64], slopes: &[Vec<u64>], dimension: usize) -> Vec<u64> {
    let m = at.modulus;
    let mut row = vec![0; dimension];
    for (factor, slope) in vector.iter().zip(slopes).filter(|(factor, _)| **factor != 0) {
        for (entry, slope) in row.iter_mut().zip(slope) {
            *entry = m.add(*entry, m.mul(*factor, *slope));
        }
    }
    row
}

/// Gradient of a polynomial at a point.
pub fn combined_gradient(
    at: &PrimePoint,
    monomials: &[Vec<u32>],
    vector: &[u64],
    point: &PrimePhasePoint,
) -> Vec<u64> {
    let slopes: Vec<Vec<u64>> = monomials.iter().map(|own| gradient(at, own, point)).collect();
    combined(at, vector, &slopes, point.state.len())
}

/// Gradient of a monomial at a point.
fn gradient(at: &PrimePoint, exponents: &[u32], point: &PrimePhasePoint) -> Vec<u64> {
    let m = at.modulus;
    let along = |variable: usize| {
        if exponents[variable] == 0 {
            return 0;
        }
        let mut lower = exponents.to_vec();
        lower[variable] -= 1;
        m.mul(m.integer(u64::from(exponents[variable])), value(&m, &point.state, &lower))
    };
    (0..exponents.len()).map(along).collect()
}
