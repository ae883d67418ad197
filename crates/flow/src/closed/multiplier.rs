//! Multipliers of closed orbits with their errors, and what these allow to say of stability.

use nalgebra::{Complex, DMatrix, DVector};

use liouville::order::StableOrder;

use crate::closed::through::MeasuredNumber;

/// Roundings of the largest entry of a derivative that the entries of its part across the flow may have.
const ROUNDINGS: f64 = 16.0;

/// A multiplier of a closed orbit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Multiplier {
    /// Real part.
    pub re: f64,
    /// Imaginary part; exactly 0 for a real multiplier.
    pub im: f64,
    /// Estimate of the error of the multiplier.
    pub error: f64,
    /// Estimate of the error of its modulus.
    pub modulus_error: f64,
}

impl Multiplier {
    /// Modulus |λ|.
    pub fn modulus(&self) -> f64 {
        libm::hypot(self.re, self.im)
    }

    /// Whether the modulus is 1 within its error.
    fn is_unit(&self) -> bool {
        let off = (self.modulus() - 1.0).abs();
        off.is_nan() || off <= self.modulus_error
    }
}

/// Stability of a closed orbit on the level of what is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CycleKind {
    /// All multipliers inside the unit circle.
    Sink,
    /// All multipliers outside the unit circle.
    Source,
    /// Multipliers on both sides of the unit circle, and none on it.
    Hyperbolic,
    /// Pairs of complex multipliers whose moduli are 1 within their errors.
    Elliptic,
}

impl CycleKind {
    /// Name in reports.
    pub fn name(self) -> &'static str {
        match self {
            CycleKind::Sink => "sink",
            CycleKind::Source => "source",
            CycleKind::Hyperbolic => "hyperbolic",
            CycleKind::Elliptic => "elliptic",
        }
    }
}

/// Stability, where the errors of the multipliers leave no other.
fn kind(multipliers: &[Multiplier]) -> Option<CycleKind> {
    let inside = |one: &Multiplier| !one.is_unit() && one.modulus() < 1.0;
    let outside = |one: &Multiplier| !one.is_unit() && one.modulus() > 1.0;
    let (less, more) = (multipliers.iter().any(inside), multipliers.iter().any(outside));
    match multipliers.iter().any(Multiplier::is_unit) {
        _ if multipliers.is_empty() => None,
        false if less && more => Some(CycleKind::Hyperbolic),
        false if less => Some(CycleKind::Sink),
        false => Some(CycleKind::Source),
        true => {
            let turns = |one: &Multiplier| one.is_unit() && one.im.abs() > one.error;
            multipliers.iter().all(turns).then_some(CycleKind::Elliptic)
        }
    }
}

/// The only multiplier, which is the product of all.
pub(crate) fn one(product: MeasuredNumber) -> (Vec<Multiplier>, Option<CycleKind>) {
    let MeasuredNumber { value, error } = product;
    let multipliers = vec![Multiplier { re: value, im: 0.0, error, modulus_error: error }];
    let kind = kind(&multipliers);
    (multipliers, kind)
}

/// Two multipliers from their sum and their product.
pub(crate) fn two(
    sum: MeasuredNumber,
    product: MeasuredNumber,
) -> (Vec<Multiplier>, Option<CycleKind>) {
    let half = sum.value / 2.0;
    let square = half * half - product.value;
    let apart = 2.0 * square.abs().sqrt();
    // From λ² - sλ + p = 0: (2λ - s)dλ = λ ds - dp, and near a double root (dλ)² instead.
    let error = |modulus: f64| {
        let change = modulus * sum.error + product.error;
        let error = (change / apart).min(change.sqrt());
        error + f64::EPSILON * modulus
    };
    let multipliers = if square < 0.0 {
        let modulus = product.value.sqrt();
        let modulus_error = product.error / (2.0 * modulus) + f64::EPSILON * modulus;
        let of = |im: f64| Multiplier { re: half, im, error: error(modulus), modulus_error };
        vec![of(apart / 2.0), of(-apart / 2.0)]
    } else {
        let larger = half + square.sqrt().copysign(half);
        let smaller = if larger == 0.0 { 0.0 } else { product.value / larger };
        let of = |re: f64, error: f64| Multiplier { re, im: 0.0, error, modulus_error: error };
        let first = error(larger.abs());
        // The smaller is a quotient, and known as well as its parts.
        let relative = first / larger.abs() + product.error / product.value.abs();
        let quotient = smaller.abs() * relative + f64::EPSILON * smaller.abs();
        vec![of(larger, first), of(smaller, quotient.min(error(smaller.abs())))]
    };
    // Where the discriminant is not told from 0 the two may be real or complex.
    let discriminant = sum.value * sum.value - 4.0 * product.value;
    let blur = 2.0 * sum.value.abs() * sum.error + 4.0 * product.error;
    if discriminant.abs() <= blur {
        let inside = multipliers.iter().all(|one| one.modulus() + one.error < 1.0);
        let outside = multipliers.iter().all(|one| one.modulus() - one.error > 1.0);
        let seen = match (inside, outside) {
            (true, _) => Some(CycleKind::Sink),
            (_, true) => Some(CycleKind::Source),
            _ => None,
        };
        return (multipliers, seen);
    }
    let kind = kind(&multipliers);
    (multipliers, kind)
}

/// Multipliers of a derivative, computed in f64 and in double-double, across the flow and the levels
/// of the energy: `known` has the velocity first, and the energy's gradient if it is kept.
pub(crate) fn all(
    float: &DMatrix<f64>,
    pair: &DMatrix<f64>,
    known: &[Vec<f64>],
) -> (Vec<Multiplier>, Option<CycleKind>) {
    let across = across(pair.nrows(), known);
    if across.ncols() == 0 || float.iter().chain(pair.iter()).any(|x| !x.is_finite()) {
        return (Vec::new(), None);
    }
    // Entries across the flow are sums in which those of the whole matrix cancel.
    let size = ROUNDINGS * f64::EPSILON * pair.amax();
    let within = |matrix: &DMatrix<f64>| across.transpose() * matrix * &across;
    let (float, pair) = (within(float), within(pair));
    let values = eigenvalues(&pair);
    // Changes of the size of rounding show how well the eigenvalues are determined.
    let changed = |salt: usize| {
        pair.map_with_location(|row, column, x| {
            let sign = if (row * 7 + column * 3 + salt).is_multiple_of(2) { 1.0 } else { -1.0 };
            x + sign * size * (1.0 + ((row + 2 * column + salt) % 3) as f64) / 3.0
        })
    };
    let others = [float, changed(0), changed(1), changed(2)].map(|matrix| eigenvalues(&matrix));
    let nearest = |value: Complex<f64>, others: &[Complex<f64>]| {
        others
            .iter()
            .map(|other| libm::hypot(other.re - value.re, other.im - value.im))
            .fold(f64::INFINITY, f64::min)
    };
    let of = |value: Complex<f64>| {
        let error = others.iter().map(|others| nearest(value, others)).fold(0.0, f64::max);
        let error = error + f64::EPSILON * libm::hypot(value.re, value.im);
        Multiplier { re: value.re, im: value.im, error, modulus_error: error }
    };
    let mut multipliers: Vec<Multiplier> = values.iter().map(|value| of(*value)).collect();
    multipliers.order_by(|a, b| b.modulus().total_cmp(&a.modulus()).then(b.im.total_cmp(&a.im)));
    let kind = kind(&multipliers);
    (multipliers, kind)
}

fn eigenvalues(matrix: &DMatrix<f64>) -> Vec<Complex<f64>> {
    matrix.complex_eigenvalues().iter().copied().collect()
}

/// Orthonormal basis across vectors, as columns.
fn across(dimension: usize, known: &[Vec<f64>]) -> DMatrix<f64> {
    let mut unit: Vec<DVector<f64>> = Vec::new();
    let rest = |vector: DVector<f64>, unit: &[DVector<f64>]| {
        // Twice is enough against rounding.
        let less = |vector: DVector<f64>, e: &DVector<f64>| {
            let along = e.dot(&vector);
            vector - e * along
        };
        unit.iter().chain(unit).fold(vector, less)
    };
    for vector in known {
        let left = rest(DVector::from_column_slice(vector), &unit);
        let length = left.norm();
        unit.push(if length > 0.0 { left / length } else { left });
    }
    while unit.len() < dimension {
        let axis =
            |k: usize| DVector::from_fn(dimension, |row, _| if row == k { 1.0 } else { 0.0 });
        let rests = (0..dimension).map(|k| rest(axis(k), &unit));
        let longest = rests.max_by(|a, b| a.norm().total_cmp(&b.norm()));
        unit.extend(longest.map(|vector| vector.normalize()));
    }
    DMatrix::from_fn(dimension, dimension - known.len(), |row, column| {
        unit[known.len() + column][row]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(value: f64, error: f64) -> MeasuredNumber {
        MeasuredNumber { value, error }
    }

    #[test]
    fn kinds_are_stated_where_the_errors_allow_it() {
        let kind = |sum, product, error| two(measured(sum, error), measured(product, error)).1;
        assert_eq!(kind(503.5, 1.0, 1e-10), Some(CycleKind::Hyperbolic));
        assert_eq!(kind(1.2, 1.0, 1e-12), Some(CycleKind::Elliptic));
        assert_eq!(kind(1.2, 0.98, 1e-12), Some(CycleKind::Sink));
        assert_eq!(kind(1.2, 0.98, 0.1), Some(CycleKind::Elliptic), "1 is within the error");
        assert_eq!(kind(2.0, 1.0, 1e-12), None, "a double multiplier 1 within the errors");
        assert_eq!(kind(0.5, 0.0625, 1e-12), Some(CycleKind::Sink), "a double one inside");
        assert_eq!(kind(1.5, 0.5, 1e-12), None, "one of them is 1");
    }

    #[test]
    fn errors_grow_where_multipliers_meet() {
        let (apart, _) = two(measured(503.538, 1e-10), measured(1.0, 1e-12));
        assert!(apart[0].error < 2e-10 && apart[1].error < 1e-12, "{apart:?}");
        let (close, _) = two(measured(2.0, 1e-12), measured(1.0, 1e-12));
        assert!(close[0].error > 1e-7, "the root of the error: {close:?}");
    }

    #[test]
    fn errors_are_not_below_the_rounding_of_the_whole_derivative() {
        // Across the velocity only 1e-16 is left of entries of size 1.
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, 0.7, 0.0, 1e-16]);
        let (found, _) = all(&matrix, &matrix, &[vec![1.0, 0.0]]);
        assert!(found[0].error > 1e-16, "{found:?}");
        let (found, kind) = one(measured(2.3e-17, 2e-31));
        assert_eq!((found[0].re, found[0].error, kind), (2.3e-17, 2e-31, Some(CycleKind::Sink)));
    }

    #[test]
    fn multipliers_are_those_across_the_flow() {
        // Velocity along the first axis: eigenvalues 1, 2 and 1/2.
        let matrix = DMatrix::from_row_slice(3, 3, &[1.0, 5.0, 7.0, 0.0, 2.0, 3.0, 0.0, 0.0, 0.5]);
        let (found, kind) = all(&matrix, &matrix, &[vec![2.0, 0.0, 0.0]]);
        let values: Vec<f64> = found.iter().map(|one| one.re).collect();
        assert!((values[0] - 2.0).abs() < 1e-14 && (values[1] - 0.5).abs() < 1e-14, "{found:?}");
        assert_eq!(kind, Some(CycleKind::Hyperbolic));
        assert!(found.iter().all(|one| one.error > 0.0 && one.error < 1e-12), "{found:?}");
    }
}
