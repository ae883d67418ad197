//! Behaviour of a function near a zero: in how many directions it grows, and how fast.

use nalgebra::DMatrix;

/// Least and largest distance at which a function is compared with its value at the zero.
const NEAREST: f64 = 1e-3;
const FARTHEST: f64 = 0.03;
/// Distance in units of that of the point from the zero.
const AWAY: f64 = 100.0;
/// Step of the difference quotients by which that is estimated.
const DIFFERENCE: f64 = 1e-6;
/// Largest number of coordinates in which second differences are formed.
const MOST_COORDINATES: usize = 16;
/// Smallest second derivative that counts, in units of the largest.
const LEAST_CURVATURE: f64 = 1e-4;

/// Growth of a function away from its zeros.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalForm {
    /// Codimension of the zeros.
    pub codimension: usize,
    /// Exponent p of the growth, |x|^p.
    pub order: f64,
}

impl LocalForm {
    /// Examines a function at a zero by its values at displaced points; `None` if there are too many
    /// coordinates, or if it has no values.
    pub fn of(coordinates: usize, value: &mut dyn FnMut(&[f64]) -> f64) -> Option<Self> {
        if coordinates == 0 || coordinates > MOST_COORDINATES {
            return None;
        }
        let mut at = |steps: &[(usize, f64)]| {
            let mut displaced = vec![0.0; coordinates];
            steps.iter().for_each(|(place, step)| displaced[*place] += step);
            value(&displaced)
        };
        let here = at(&[]);
        let mut quotient =
            |k: usize| (at(&[(k, DIFFERENCE)]) - at(&[(k, -DIFFERENCE)])) / (2.0 * DIFFERENCE);
        let slope = (0..coordinates).map(|k| quotient(k).powi(2)).sum::<f64>().sqrt();
        let away = AWAY * here.abs() / slope;
        // At the zero itself this is 0/0.
        let near = if away > NEAREST { away.min(FARTHEST) } else { NEAREST };
        let sides: Vec<[f64; 2]> =
            (0..coordinates).map(|k| [at(&[(k, near)]), at(&[(k, -near)])]).collect();
        let slope = |[above, below]: &[f64; 2]| ((above - below) / 2.0).abs();
        let bend = |[above, below]: &[f64; 2]| (above + below - 2.0 * here).abs();
        let steepest = sides.iter().map(slope).fold(0.0, f64::max);
        let most_bent = sides.iter().map(bend).fold(0.0, f64::max);
        if !(steepest + most_bent).is_finite() {
            return None;
        }
        // A simple zero: the second differences are smaller by the distance.
        if steepest > 10.0 * most_bent {
            return Some(Self { codimension: 1, order: 1.0 });
        }
        let mut second = DMatrix::zeros(coordinates, coordinates);
        for (a, own) in sides.iter().enumerate() {
            second[(a, a)] = own[0] + own[1] - 2.0 * here;
            for b in 0..a {
                let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
                let [both, first, last, none] =
                    corners.map(|(s, t)| at(&[(a, s * near), (b, t * near)]));
                second[(a, b)] = (both - first - last + none) / 4.0;
                second[(b, a)] = second[(a, b)];
            }
        }
        let curvatures = second.symmetric_eigenvalues();
        let largest = curvatures.amax();
        let codimension =
            curvatures.iter().filter(|one| one.abs() > LEAST_CURVATURE * largest).count();
        let widest =
            (0..coordinates).max_by(|a, b| bend(&sides[*a]).total_cmp(&bend(&sides[*b])))?;
        let half = [at(&[(widest, near / 2.0)]), at(&[(widest, -near / 2.0)])];
        // Analytic functions grow like whole powers.
        let order = (bend(&sides[widest]) / bend(&half)).log2().round();
        (codimension > 0 && order >= 1.0).then_some(Self { codimension, order })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_have_a_codimension_and_an_order() {
        let form = |f: &dyn Fn(&[f64]) -> f64| LocalForm::of(3, &mut |x| f(x));
        let is = |found: Option<LocalForm>, codimension: usize, order: f64| {
            let found = found.expect("there are values");
            assert_eq!(found.codimension, codimension, "{found:?}");
            assert!((found.order - order).abs() < 0.1, "{found:?}");
        };
        is(form(&|x| x[0] + x[1] - 2.0 * x[2] + x[0] * x[1]), 1, 1.0);
        is(form(&|x| (x[0] + x[1]).powi(2)), 1, 2.0);
        is(form(&|x| (x[0] + x[1]).powi(2) + 3.0 * x[2].powi(2)), 2, 2.0);
        is(form(&|x| x[0].powi(2) + x[0] * x[1] + x[1].powi(2) + x[2].powi(2)), 3, 2.0);
        is(form(&|x| (x[0].powi(2) + x[1].powi(2)).powi(2)), 2, 4.0);
        // Near the zero, not at it.
        let quartic = |x: &[f64]| x.iter().map(|x| (x - 2e-3).powi(4)).sum();
        is(form(&quartic), 3, 4.0);
        is(form(&|x| x.iter().map(|x| (x + 3e-5).powi(2)).sum()), 3, 2.0);
        assert_eq!(form(&|_| f64::NAN), None, "no values");
    }
}
