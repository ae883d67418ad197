//! Numbers and functions expressed by those that every [`Scalar`] has.

use super::arena::Extreme;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Returns π = 4 atan 1.
pub(super) fn pi<T: Scalar>() -> T {
    T::one().atan() * T::from(4.0)
}

/// Returns acos x = π/2 - asin x.
pub(super) fn arccosine<T: Scalar>(x: T) -> T {
    T::one().atan() * T::from(2.0) - x.arcsine()
}

/// Angle of the point (x, y) between -π and π: 2 atan(y/(x + r)), r² = x² + y².
///
/// Undefined on the ray y = 0, x ≤ 0, where the angle jumps.
pub(super) fn angle<T: Scalar>(y: T, x: T) -> T {
    y.angle_from(x)
}

/// Minimum (a + b - |a - b|)/2 or maximum (a + b + |a - b|)/2.
pub(super) fn extreme<T: Scalar>(which: Extreme, a: T, b: T) -> T {
    let half = T::rational(&Rational::new(1, 2));
    let gap = (a - b).modulus();
    half * match which {
        Extreme::Least => a + b - gap,
        Extreme::Greatest => a + b + gap,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::Dual;

    #[test]
    fn inverse_functions_reach_the_ends_of_their_domains() {
        for x in [-1.0, -0.3, 0.0, 0.9, 1.0] {
            assert!((x.arcsine() - f64::asin(x)).abs() < 1e-15, "asin {x}");
            assert!((arccosine(x) - f64::acos(x)).abs() < 1e-15, "acos {x}");
        }
        let slope = Dual::new(0.6, 1.0).arcsine().eps;
        assert!((slope - 1.25).abs() < 1e-15, "1/√(1 − x²)");
    }

    #[test]
    fn angles_are_those_of_all_quadrants() {
        for (y, x) in [(1.0, 2.0), (-1.0, 2.0), (3.0, -1.0), (-3.0, -1.0), (2.0, 0.0)] {
            assert!((angle(y, x) - f64::atan2(y, x)).abs() < 1e-15, "({x}, {y})");
        }
        assert!(!angle(0.0, -1.0).is_finite(), "none on the negative axis");
        let turning = angle(Dual::new(3.0, 1.0), Dual::new(-1.0, 2.0)).eps;
        assert!((turning + 0.7).abs() < 1e-15, "(x y' − y x')/r²");
    }

    #[test]
    fn extremes_are_those_of_numbers() {
        for (a, b) in [(1.0, 2.0), (2.0, 1.0), (-3.0, -3.0)] {
            assert_eq!(extreme(Extreme::Least, a, b), f64::min(a, b), "min({a}, {b})");
            assert_eq!(extreme(Extreme::Greatest, a, b), f64::max(a, b), "max({a}, {b})");
        }
    }
}
