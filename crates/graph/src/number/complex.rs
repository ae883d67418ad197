//! Complex numbers over f64, for derivatives by a complex step:
//! f'(x)·d = Im f(x + i h d)/h + O(h²).
//!
//! Nothing is subtracted, so h may be small enough for h² to lie below every rounding error. Each
//! function is continued from the real axis to the half-plane next to it, and is undefined where
//! the real one is: √ and ln for Re z < 0, and |z| = z sign(Re z).
//!
//! ```text
//! √z = s + i b/(2s),  s = √((|z| + a)/2)          ln z = ln|z| + i arg z
//! 1/z = (a - i b)/(a² + b²)                       e^z = e^a (cos b + i sin b)
//! atan z = ½ arg(1 - a² - b² + 2i a) + ¼ i ln(1 + 4b/(a² + (1 - b)²))
//! ```

use super::rational::Rational;
use super::{BinaryOperation, Domain, UnaryFunction};

/// The complex domain with `N` lanes. An undefined lane holds NaN.
#[derive(Clone, Copy, Debug, Default)]
pub struct Complex<const N: usize>;

/// `N` complex numbers.
#[derive(Clone, Debug)]
pub struct Complexes<const N: usize> {
    /// Real parts.
    pub re: [f64; N],
    /// Imaginary parts.
    pub im: [f64; N],
}

type Pair = (f64, f64);

const UNDEFINED: Pair = (f64::NAN, f64::NAN);

impl<const N: usize> Domain for Complex<N> {
    type Block = Complexes<N>;

    fn constant(&self, value: &Rational) -> Complexes<N> {
        Complexes { re: [value.to_f64().0; N], im: [0.0; N] }
    }

    fn values(&self, values: &[Rational]) -> Complexes<N> {
        let last = values.len().saturating_sub(1);
        let value = |lane: usize| values.get(lane.min(last)).map_or(f64::NAN, |v| v.to_f64().0);
        Complexes { re: std::array::from_fn(value), im: [0.0; N] }
    }

    #[inline(always)]
    fn unary(&self, function: UnaryFunction, x: &Complexes<N>, out: &mut Complexes<N>) {
        match function {
            UnaryFunction::Neg => map(x, out, |(a, b)| (-a, -b)),
            UnaryFunction::Recip => map(x, out, reciprocal),
            UnaryFunction::Sqrt => map(x, out, square_root),
            UnaryFunction::Abs => map(x, out, |(a, b)| (a.abs(), b * a.signum())),
            UnaryFunction::Exp => map(x, out, exponential),
            UnaryFunction::Ln => map(x, out, logarithm),
            UnaryFunction::Sin => {
                map(x, out, |(a, b)| (libm::sin(a) * libm::cosh(b), libm::cos(a) * libm::sinh(b)))
            }
            UnaryFunction::Cos => {
                map(x, out, |(a, b)| (libm::cos(a) * libm::cosh(b), -libm::sin(a) * libm::sinh(b)))
            }
            UnaryFunction::Atan => map(x, out, arctangent),
        }
    }

    #[inline(always)]
    fn binary(
        &self,
        operation: BinaryOperation,
        x: &Complexes<N>,
        y: &Complexes<N>,
        out: &mut Complexes<N>,
    ) {
        match operation {
            BinaryOperation::Add => zip(x, y, out, |(a, b), (c, d)| (a + c, b + d)),
            BinaryOperation::Sub => zip(x, y, out, |(a, b), (c, d)| (a - c, b - d)),
            BinaryOperation::Mul => zip(x, y, out, product),
            BinaryOperation::Pow => zip(x, y, out, |z, w| exponential(product(w, logarithm(z)))),
        }
    }

    #[inline(always)]
    fn power(&self, x: &Complexes<N>, exponent: &Rational, out: &mut Complexes<N>) {
        match exponent.to_integer() {
            Some(exponent) => map(x, out, |z| integer_power(z, exponent)),
            None => {
                let exponent = exponent.to_f64().0;
                map(x, out, |z| polar_power(z, exponent));
            }
        }
    }
}

#[inline(always)]
fn product((a, b): Pair, (c, d): Pair) -> Pair {
    (a * c - b * d, a * d + b * c)
}

#[inline(always)]
fn reciprocal((a, b): Pair) -> Pair {
    let norm = a * a + b * b;
    (a / norm, -b / norm)
}

#[inline(always)]
fn square_root((a, b): Pair) -> Pair {
    let s = (0.5 * (libm::hypot(a, b) + a)).sqrt();
    let imaginary = if b == 0.0 { 0.0 } else { b / (2.0 * s) };
    if a >= 0.0 { (s, imaginary) } else { UNDEFINED }
}

fn exponential((a, b): Pair) -> Pair {
    let size = libm::exp(a);
    (size * libm::cos(b), size * libm::sin(b))
}

fn logarithm((a, b): Pair) -> Pair {
    if a > 0.0 { (libm::log(libm::hypot(a, b)), libm::atan2(b, a)) } else { UNDEFINED }
}

fn arctangent((a, b): Pair) -> Pair {
    let real = 0.5 * libm::atan2(2.0 * a, (1.0 - a) * (1.0 + a) - b * b);
    // ln_1p keeps a tiny b that 1 + b would lose.
    (real, 0.25 * libm::log1p(4.0 * b / (a * a + (1.0 - b) * (1.0 - b))))
}

/// Computes z^p = |z|^p e^(i p arg z) for Re z > 0.
fn polar_power((a, b): Pair, exponent: f64) -> Pair {
    let size = libm::pow(libm::hypot(a, b), exponent);
    let angle = exponent * libm::atan2(b, a);
    if a > 0.0 { (size * libm::cos(angle), size * libm::sin(angle)) } else { UNDEFINED }
}

/// Computes z^n by squaring, on both sides of 0.
fn integer_power(z: Pair, exponent: i64) -> Pair {
    let mut square = if exponent < 0 { reciprocal(z) } else { z };
    let mut rest = exponent.unsigned_abs();
    let mut result = (1.0, 0.0);
    while rest > 0 {
        if rest % 2 == 1 {
            result = product(result, square);
        }
        square = product(square, square);
        rest /= 2;
    }
    result
}

#[inline(always)]
fn map<const N: usize>(x: &Complexes<N>, out: &mut Complexes<N>, f: impl Fn(Pair) -> Pair) {
    for lane in 0..N {
        (out.re[lane], out.im[lane]) = f((x.re[lane], x.im[lane]));
    }
}

#[inline(always)]
fn zip<const N: usize>(
    x: &Complexes<N>,
    y: &Complexes<N>,
    out: &mut Complexes<N>,
    f: impl Fn(Pair, Pair) -> Pair,
) {
    for lane in 0..N {
        (out.re[lane], out.im[lane]) = f((x.re[lane], x.im[lane]), (y.re[lane], y.im[lane]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: f64 = 1e-100;

    fn at(function: UnaryFunction, a: f64, b: f64) -> Pair {
        let mut out = Complexes { re: [0.0], im: [0.0] };
        Complex::<1>.unary(function, &Complexes { re: [a], im: [b] }, &mut out);
        (out.re[0], out.im[0])
    }

    fn assert_near(found: f64, expected: f64, what: &str) {
        let error = (found - expected).abs() / expected.abs().max(1.0);
        assert!(error < 4.0 * f64::EPSILON, "{what}: {found} against {expected}");
    }

    #[test]
    fn a_tiny_step_gives_the_derivative_to_rounding() {
        let x: f64 = 0.7;
        let derivatives = [
            (UnaryFunction::Neg, x, -1.0),
            (UnaryFunction::Recip, x, -1.0 / (x * x)),
            (UnaryFunction::Sqrt, x, 0.5 / x.sqrt()),
            (UnaryFunction::Abs, -x, -1.0),
            (UnaryFunction::Exp, x, x.exp()),
            (UnaryFunction::Ln, x, 1.0 / x),
            (UnaryFunction::Sin, x, x.cos()),
            (UnaryFunction::Cos, x, -x.sin()),
            (UnaryFunction::Atan, x, 1.0 / (1.0 + x * x)),
            (UnaryFunction::Atan, -3.0, 0.1),
        ];
        for (function, x, slope) in derivatives {
            assert_near(at(function, x, STEP).1 / STEP, slope, &format!("{function:?} at {x}"));
        }
    }

    #[test]
    fn functions_keep_their_identities_off_the_axis() {
        let z = (0.6, 0.3);
        let (s, t) = at(UnaryFunction::Sqrt, z.0, z.1);
        let (re, im) = product((s, t), (s, t));
        assert_near(re, z.0, "Re (√z)²");
        assert_near(im, z.1, "Im (√z)²");
        let (s, t) = at(UnaryFunction::Ln, z.0, z.1);
        let (re, im) = at(UnaryFunction::Exp, s, t);
        assert_near(re, z.0, "Re e^ln z");
        assert_near(im, z.1, "Im e^ln z");
        let (a, b) = at(UnaryFunction::Atan, z.0, z.1);
        let (sine, cosine) = (at(UnaryFunction::Sin, a, b), at(UnaryFunction::Cos, a, b));
        let (re, im) = product(sine, reciprocal(cosine));
        assert_near(re, z.0, "Re tan atan z");
        assert_near(im, z.1, "Im tan atan z");
    }

    #[test]
    fn powers_agree_with_products_and_roots() {
        let z = Complexes { re: [-0.6], im: [0.3] };
        let power = |z: &Complexes<1>, exponent: &Rational| {
            let mut out = z.clone();
            Complex::<1>.power(z, exponent, &mut out);
            (out.re[0], out.im[0])
        };
        let cube = product(product((-0.6, 0.3), (-0.6, 0.3)), (-0.6, 0.3));
        assert_near(power(&z, &Rational::from(3)).0, cube.0, "Re z³ left of the axis");
        let back = product(power(&z, &Rational::from(-3)), cube);
        assert_near(back.0, 1.0, "z⁻³ z³");
        assert!(power(&z, &Rational::new(1, 2)).0.is_nan(), "√ is undefined for Re z < 0");
        let z = Complexes { re: [0.6], im: [0.3] };
        let (root, (s, t)) = (power(&z, &Rational::new(1, 2)), square_root((0.6, 0.3)));
        assert_near(root.0, s, "Re z^½");
        assert_near(root.1, t, "Im z^½");
    }

    #[test]
    fn what_has_no_real_value_has_no_complex_one() {
        for function in [UnaryFunction::Sqrt, UnaryFunction::Ln] {
            assert!(at(function, -1.0, STEP).0.is_nan(), "{function:?} at -1");
        }
        assert_eq!(at(UnaryFunction::Sqrt, 0.0, 0.0), (0.0, 0.0), "√0 = 0 as on the real axis");
    }
}
