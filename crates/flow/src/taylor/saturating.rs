//! Functions that tend to constants: tanh u, its slope 1/cosh² u, and 1/(1 + eᵘ); and sinh u,
//! asinh u and atanh u, which have all digits near 0.
//!
//! Formulas have them as quotients and differences of exponential functions, which are too large for f64
//! from u = 355 or 710 on, where the quotients are constant, or cancel near 0, and as logarithms.
//! Programs have rules of their own for them.

use crate::taylor::number::SeriesNumber;
use liouville::graph::{Graph, Step};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};

/// A function that tends to constants, or a hyperbolic function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Saturating {
    /// tanh u
    Tanh,
    /// 1/cosh² u
    Fall,
    /// 1/cosh u
    Bell,
    /// 1/(1 + eᵘ)
    Logistic,
    /// eᵘ/(1 + eᵘ)²
    Hump,
    /// sinh u
    Sinh,
    /// cosh u
    Cosh,
    /// asinh u
    Asinh,
    /// atanh u
    Atanh,
}

/// Size of arguments below which series have more digits than exponential functions.
const NEAR: f64 = 0.3;

impl Saturating {
    /// Values of the function.
    pub(crate) fn at<T: SeriesNumber>(self, u: T) -> T {
        T::from_lanes(|lane| self.at_one(u.lane(lane)))
    }

    fn at_one<One: SeriesNumber<One = One>>(self, u: One) -> One {
        let is_negative = u.leading() < 0.0;
        let size = if is_negative { -u } else { u };
        let falling = |rate: f64| (One::float(-rate) * size).apply(UnaryFunction::Exp);
        match self {
            // The quotient has no digits near 0.
            Saturating::Tanh if One::EPSILON == f64::EPSILON => One::float(libm::tanh(u.leading())),
            Saturating::Tanh if size.leading() < NEAR => {
                let grown = small_growth(u + u);
                grown * (One::float(2.0) + grown).recip()
            }
            Saturating::Tanh => {
                let t = falling(2.0);
                let value = (One::ONE - t) * (One::ONE + t).recip();
                if is_negative { -value } else { value }
            }
            Saturating::Sinh if size.leading() < NEAR => {
                let grown = small_growth(u);
                let half = One::float(0.5) * grown;
                half + half * (One::ONE + grown).recip()
            }
            Saturating::Sinh | Saturating::Cosh => {
                let [up, down] = [u, -u].map(|x| x.apply(UnaryFunction::Exp));
                let down = if self == Saturating::Sinh { -down } else { down };
                One::float(0.5) * (up + down)
            }
            Saturating::Asinh => {
                let first = One::float(libm::asinh(u.leading()));
                if One::EPSILON == f64::EPSILON || !first.leading().is_finite() {
                    return first;
                }
                // A step of Newton's method doubles the digits.
                let gap = Saturating::Sinh.at_one(first) - u;
                first - gap * Saturating::Cosh.at_one(first).recip()
            }
            Saturating::Atanh => {
                let first = One::float(libm::atanh(u.leading()));
                if One::EPSILON == f64::EPSILON || !first.leading().is_finite() {
                    return first;
                }
                let gap = Saturating::Tanh.at_one(first) - u;
                first - gap * (One::ONE - u * u).recip()
            }
            Saturating::Fall => {
                let t = falling(2.0);
                let root = (One::ONE + t).recip();
                One::float(4.0) * t * root * root
            }
            Saturating::Bell => {
                let t = falling(1.0);
                One::float(2.0) * t * (One::ONE + t * t).recip()
            }
            Saturating::Hump => {
                let t = falling(1.0);
                let root = (One::ONE + t).recip();
                t * root * root
            }
            Saturating::Logistic => {
                let t = falling(1.0);
                let value = (One::ONE + t).recip();
                if is_negative { value } else { t * value }
            }
        }
    }

    /// Factor of the slope in terms of the row that programs have for it.
    pub(crate) fn slope(self) -> f64 {
        match self {
            Saturating::Tanh
            | Saturating::Sinh
            | Saturating::Cosh
            | Saturating::Asinh
            | Saturating::Atanh => 1.0,
            Saturating::Fall => -2.0,
            Saturating::Logistic | Saturating::Hump | Saturating::Bell => -1.0,
        }
    }

    /// Rate k at which what varies of the function falls, as e^(−k|u|); 0 where it grows.
    pub(crate) fn rate(self) -> f64 {
        match self {
            Saturating::Logistic | Saturating::Hump | Saturating::Bell => 1.0,
            Saturating::Tanh | Saturating::Fall => 2.0,
            Saturating::Sinh | Saturating::Cosh | Saturating::Asinh | Saturating::Atanh => 0.0,
        }
    }
}

/// eᵘ − 1 with all digits, |u| up to twice [`NEAR`].
fn small_growth<One: SeriesNumber<One = One>>(u: One) -> One {
    // The 32nd term is below the rounding of double-double.
    (1..32)
        .rev()
        .fold(One::ZERO, |sum, n| u * (One::ONE + sum) * One::rational(&Rational::new(1, n)))
}

/// Exponents of a sum or a difference eᵘ ± e⁻ᵘ at a place, with whether it is a difference.
pub(super) fn hyperbolic(graph: &Graph, place: usize) -> Option<(bool, [usize; 2])> {
    let Step::Binary(operation, a, b) = graph.step(place) else { return None };
    let exponents = [exponent(graph, a)?, exponent(graph, b)?];
    let is_difference = match operation {
        BinaryOperation::Add => false,
        BinaryOperation::Sub => true,
        _ => return None,
    };
    are_opposite(graph, exponents).then_some((is_difference, exponents))
}

/// Argument of asinh u = ln(u + √(u² + 1)) or atanh u = ln((1 + u)/(1 − u))/2 in the logarithm at a place.
pub(crate) fn area(graph: &Graph, place: usize) -> Option<(Saturating, usize)> {
    let Step::Unary(UnaryFunction::Ln, a) = graph.step(place) else { return None };
    let is_one =
        |place: usize| matches!(graph.step(place), Step::Constant(value) if value.is_one());
    let other = |place: usize, one: &dyn Fn(usize) -> bool| match graph.step(place) {
        Step::Binary(BinaryOperation::Add, a, b) if one(b) => Some(a),
        Step::Binary(BinaryOperation::Add, a, b) if one(a) => Some(b),
        _ => None,
    };
    match graph.step(a) {
        Step::Binary(BinaryOperation::Add, ..) => {
            let is_root_of = |u: usize, root: usize| {
                let Step::Unary(UnaryFunction::Sqrt, sum) = graph.step(root) else { return false };
                let square = other(sum, &is_one).map(|square| graph.step(square));
                match square {
                    Some(Step::Binary(BinaryOperation::Mul, x, y)) => (x, y) == (u, u),
                    Some(Step::Power(x, exponent)) => x == u && exponent.to_integer() == Some(2),
                    _ => false,
                }
            };
            let Step::Binary(_, x, y) = graph.step(a) else { return None };
            let found = [(x, y), (y, x)].into_iter().find(|(u, root)| is_root_of(*u, *root));
            found.map(|(u, _)| (Saturating::Asinh, u))
        }
        Step::Binary(BinaryOperation::Mul, x, y) => {
            let of = |above: usize, inverse: usize| {
                let Step::Unary(UnaryFunction::Recip, below) = graph.step(inverse) else {
                    return None;
                };
                let u = other(above, &is_one)?;
                let Step::Binary(BinaryOperation::Sub, one, v) = graph.step(below) else {
                    return None;
                };
                (is_one(one) && u == v).then_some((Saturating::Atanh, u))
            };
            of(x, y).or_else(|| of(y, x))
        }
        _ => None,
    }
}

/// Exponent of a sum 1 + eᵘ at a place.
pub(super) fn logistic(graph: &Graph, place: usize) -> Option<usize> {
    let Step::Binary(BinaryOperation::Add, a, b) = graph.step(place) else { return None };
    let is_one =
        |place: usize| matches!(graph.step(place), Step::Constant(value) if value.is_one());
    match (is_one(a), is_one(b)) {
        (true, _) => exponent(graph, b),
        (_, true) => exponent(graph, a),
        _ => None,
    }
}

/// Exponent of the exponential function at a place.
pub(super) fn exponent(graph: &Graph, place: usize) -> Option<usize> {
    match graph.step(place) {
        Step::Unary(UnaryFunction::Exp, u) => Some(u),
        _ => None,
    }
}

/// Whether the form of two values shows that their sum is 0.
fn are_opposite(graph: &Graph, [a, b]: [usize; 2]) -> bool {
    let negated = |place: usize| match graph.step(place) {
        Step::Unary(UnaryFunction::Neg, x) => Some(x),
        _ => None,
    };
    match (graph.step(a), graph.step(b)) {
        (Step::Binary(BinaryOperation::Sub, p, q), Step::Binary(BinaryOperation::Sub, r, s)) => {
            (p, q) == (s, r)
        }
        (Step::Constant(p), Step::Constant(q)) => *p == -q,
        _ => negated(a) == Some(b) || negated(b) == Some(a),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::number::double_double::DoubleDouble;

    #[test]
    fn values_are_right_far_out_and_near_0() {
        let (tanh, fall, logistic) = (Saturating::Tanh, Saturating::Fall, Saturating::Logistic);
        assert_eq!([tanh.at(1e4), tanh.at(-1e4), tanh.at(1e-20)], [1.0, -1.0, 1e-20]);
        assert_eq!([fall.at(1e4), fall.at(0.0)], [0.0, 1.0]);
        assert_eq!([logistic.at(1e4), logistic.at(0.0), logistic.at(-1e4)], [0.0, 0.5, 1.0]);
        for u in [-3.0, -0.4, 0.7, 20.0] {
            let square = tanh.at(u) * tanh.at(u);
            assert!((fall.at(u) + square - 1.0).abs() < 1e-15, "1/cosh² = 1 − tanh² at {u}");
            let pair = DoubleDouble::from_f64(u);
            assert!((tanh.at(pair).hi - tanh.at(u)).abs() < 1e-15, "tanh {u}");
            let (sine, area) = (Saturating::Sinh, Saturating::Asinh);
            let back = area.at(sine.at(pair)) - pair;
            assert!(back.hi.abs() < 1e-30 * u.abs(), "asinh sinh {u}");
            if u.abs() < 3.0 {
                let back = Saturating::Atanh.at(tanh.at(pair)) - pair;
                assert!(back.hi.abs() < 1e-30, "atanh tanh {u}");
            }
            assert_eq!(area.at(1e-20 * u), 1e-20 * u);
            for function in [tanh, Saturating::Sinh] {
                let (small, whole) = (DoubleDouble::from_f64(1e-20 * u), DoubleDouble::from_f64(u));
                assert!(
                    (function.at(small).hi / small.hi - 1.0).abs() < 1e-15,
                    "small {function:?}"
                );
                let twice = function.at(whole + whole);
                let own = function.at(whole);
                let square = DoubleDouble::from_f64(1.0) + own * own;
                let doubled = match function {
                    Saturating::Sinh => own * square.sqrt(),
                    _ => own * square.recip(),
                };
                let gap = (twice - doubled - doubled).hi / twice.hi;
                assert!(gap.abs() < 1e-30, "{function:?} at {u} and twice that: {gap:e}");
            }
            let bell = Saturating::Bell.at(u);
            assert!((bell * bell / fall.at(u) - 1.0).abs() < 1e-14, "1/cosh {u}");
            assert!((logistic.at(u) - 1.0 / (1.0 + u.exp())).abs() < 1e-15, "1/(1 + e^{u})");
            let hump = Saturating::Hump.at(u) - logistic.at(u) * logistic.at(-u);
            assert!(hump.abs() < 1e-16, "slope of the logistic function at {u}");
            let ratio = logistic.at(u) / (-u).exp() * (1.0 + (-u).exp());
            assert!((ratio - 1.0).abs() < 1e-14, "small values have all digits, at {u}");
        }
    }
}
