//! Quadratic extensions F_p(i) of prime fields, p = 3 mod 4, in which every element of F_p has a
//! square root.
//!
//! An element is a + bi with i² = -1. Every a in F_p is the square of a^((p+1)/4) or of
//! i (-a)^((p+1)/4); a + bi with b ≠ 0 is a square exactly when its norm a² + b² is one in F_p.
//! With 2^s dividing p + 1 elements of F_p have 2^s-th roots too. Roots of odd index are taken of
//! elements of F_p alone, where they are unique if the index is prime to p - 1.
//!
//! A lane is undefined after 1/0, after √0 (a root without sign), and after the root of an element
//! without one. Functions without a value in a field (exp, ln, |x|, …) must have been replaced
//! before.

use super::prime::{Modulus, UNDEFINED};
use super::rational::Rational;
use super::{BinaryOperation, Domain, UnaryFunction};

/// a + bi in Montgomery form; undefined where the first part is [`UNDEFINED`].
pub type Element = [u64; 2];

/// Marks a lane without a value.
const NONE: Element = [UNDEFINED, UNDEFINED];

/// The domain of quadratic extensions with `N` lanes, one prime field for each lane.
#[derive(Clone, Debug)]
pub struct Quadratic<const N: usize> {
    moduli: [Modulus; N],
}

impl<const N: usize> Quadratic<N> {
    /// Makes the domain whose lanes compute modulo these primes, each 3 mod 4.
    pub fn new(moduli: [Modulus; N]) -> Self {
        Self { moduli }
    }

    /// Whether the value in a lane is a nonzero square; `None` where there is no value.
    pub fn is_square(&self, block: &[Element; N], lane: usize) -> Option<bool> {
        let (m, value) = (&self.moduli[lane], block[lane]);
        match value {
            [UNDEFINED, _] => None,
            [0, 0] => Some(false),
            [_, 0] => Some(true),
            _ => Some(m.is_square(norm(m, value))),
        }
    }

    /// Computes x y in a lane where both have a value.
    pub fn product(&self, lane: usize, x: Element, y: Element) -> Element {
        product(&self.moduli[lane], x, y)
    }

    /// Computes -x in a lane where it has a value.
    pub fn negative(&self, lane: usize, [a, b]: Element) -> Element {
        [self.moduli[lane].sub(0, a), self.moduli[lane].sub(0, b)]
    }

    /// Computes 1/x in a lane, for x ≠ 0.
    pub fn inverse(&self, lane: usize, x: Element) -> Option<Element> {
        integer_power(&self.moduli[lane], x, -1)
    }

    /// Computes all 1/x in a lane by one inversion, for x ≠ 0.
    pub fn inverses(&self, lane: usize, x: &[Element]) -> Vec<Element> {
        let m = &self.moduli[lane];
        let norms: Vec<u64> = x.iter().map(|x| norm(m, *x)).collect();
        let mut inverses = vec![UNDEFINED; x.len()];
        m.inverses(&norms, &mut inverses);
        let conjugate = |([a, b], inverse): (&Element, u64)| match inverse {
            UNDEFINED => NONE,
            _ => [m.mul(*a, inverse), m.mul(m.sub(0, *b), inverse)],
        };
        x.iter().zip(inverses).map(conjugate).collect()
    }

    #[inline(always)]
    fn map(
        &self,
        x: &[Element; N],
        out: &mut [Element; N],
        f: impl Fn(&Modulus, Element) -> Option<Element>,
    ) {
        for lane in 0..N {
            out[lane] = match x[lane] {
                [UNDEFINED, _] => NONE,
                value => f(&self.moduli[lane], value).unwrap_or(NONE),
            };
        }
    }

    #[inline(always)]
    fn zip(
        &self,
        x: &[Element; N],
        y: &[Element; N],
        out: &mut [Element; N],
        f: impl Fn(&Modulus, Element, Element) -> Element,
    ) {
        for lane in 0..N {
            let defined = x[lane][0] != UNDEFINED && y[lane][0] != UNDEFINED;
            // Operating on the mark is harmless and avoids a branch.
            let (a, b) = if defined { (x[lane], y[lane]) } else { ([0; 2], [0; 2]) };
            let value = f(&self.moduli[lane], a, b);
            out[lane] = if defined { value } else { NONE };
        }
    }

    /// Computes all 1/x; neighbouring lanes with the same prime share one inversion.
    fn reciprocals(&self, x: &[Element; N], out: &mut [Element; N]) {
        let mut norms = [UNDEFINED; N];
        for lane in 0..N {
            if x[lane][0] != UNDEFINED {
                norms[lane] = norm(&self.moduli[lane], x[lane]);
            }
        }
        let mut inverses = [UNDEFINED; N];
        let mut begin = 0;
        for own in self.moduli.chunk_by(|a, b| a.prime() == b.prime()) {
            let lanes = begin..begin + own.len();
            own[0].inverses(&norms[lanes.clone()], &mut inverses[lanes.clone()]);
            begin = lanes.end;
        }
        for lane in 0..N {
            let (m, [a, b], inverse) = (&self.moduli[lane], x[lane], inverses[lane]);
            out[lane] = match inverse {
                UNDEFINED => NONE,
                _ => [m.mul(a, inverse), m.mul(m.sub(0, b), inverse)],
            };
        }
    }
}

/// Norm a² + b², which is 0 for 0 alone.
#[inline(always)]
fn norm(m: &Modulus, [a, b]: Element) -> u64 {
    m.add(m.mul(a, a), m.mul(b, b))
}

#[inline(always)]
fn product(m: &Modulus, [a, b]: Element, [c, d]: Element) -> Element {
    let (real, imaginary) = (m.mul(a, c), m.mul(b, d));
    // (a + b)(c + d) - ac - bd
    let mixed = m.mul(m.add(a, b), m.add(c, d));
    [m.sub(real, imaginary), m.sub(m.sub(mixed, real), imaginary)]
}

/// Returns a square root of a nonzero element that has one; its sign is arbitrary.
fn root(m: &Modulus, [a, b]: Element) -> Option<Element> {
    if b == 0 {
        return match (a, m.root(a)) {
            (0, _) => None,
            (_, Some(root)) => Some([root, 0]),
            // -1 is not a square, so one of ±a is.
            (_, None) => m.root(m.sub(0, a)).map(|root| [0, root]),
        };
    }
    // (x + yi)² = a + bi: x² = (a ± n)/2 with n² = a² + b², and y = b/2x.
    let n = m.root(norm(m, [a, b]))?;
    let half = m.inverse(m.integer(2));
    let x = [m.add(a, n), m.sub(a, n)].into_iter().find_map(|sum| m.root(m.mul(sum, half)))?;
    let y = m.mul(b, m.inverse(m.add(x, x)));
    Some([x, y])
}

fn integer_power(m: &Modulus, x: Element, exponent: i64) -> Option<Element> {
    let size = exponent.unsigned_abs();
    let mut power = [m.one(), 0];
    for bit in (0..64 - size.leading_zeros()).rev() {
        power = product(m, power, power);
        if size >> bit & 1 == 1 {
            power = product(m, power, x);
        }
    }
    if exponent >= 0 {
        return Some(power);
    }
    let inverse = match norm(m, power) {
        0 => return None,
        norm => m.inverse(norm),
    };
    Some([m.mul(power[0], inverse), m.mul(m.sub(0, power[1]), inverse)])
}

impl<const N: usize> Domain for Quadratic<N> {
    type Block = [Element; N];

    fn constant(&self, value: &Rational) -> [Element; N] {
        let mut block = [NONE; N];
        for lane in 0..N {
            // Neighbours mostly share their prime.
            block[lane] = match lane {
                1.. if self.moduli[lane] == self.moduli[lane - 1] => block[lane - 1],
                _ => self.moduli[lane].rational(value).map_or(NONE, |a| [a, 0]),
            };
        }
        block
    }

    fn values(&self, values: &[Rational]) -> [Element; N] {
        let last = values.len().saturating_sub(1);
        std::array::from_fn(|lane| {
            let value = values.get(lane.min(last));
            value.and_then(|value| self.moduli[lane].rational(value)).map_or(NONE, |a| [a, 0])
        })
    }

    #[inline(always)]
    fn unary(&self, function: UnaryFunction, x: &[Element; N], out: &mut [Element; N]) {
        match function {
            UnaryFunction::Neg => self.map(x, out, |m, [a, b]| Some([m.sub(0, a), m.sub(0, b)])),
            UnaryFunction::Recip => self.reciprocals(x, out),
            UnaryFunction::Sqrt => self.map(x, out, root),
            UnaryFunction::Abs
            | UnaryFunction::Exp
            | UnaryFunction::Ln
            | UnaryFunction::Sin
            | UnaryFunction::Cos
            | UnaryFunction::Atan => *out = [NONE; N],
        }
    }

    #[inline(always)]
    fn binary(
        &self,
        operation: BinaryOperation,
        x: &[Element; N],
        y: &[Element; N],
        out: &mut [Element; N],
    ) {
        match operation {
            BinaryOperation::Add => {
                self.zip(x, y, out, |m, [a, b], [c, d]| [m.add(a, c), m.add(b, d)]);
            }
            BinaryOperation::Sub => {
                self.zip(x, y, out, |m, [a, b], [c, d]| [m.sub(a, c), m.sub(b, d)]);
            }
            BinaryOperation::Mul => self.zip(x, y, out, product),
            BinaryOperation::Pow => *out = [NONE; N],
        }
    }

    fn power(&self, x: &[Element; N], exponent: &Rational, out: &mut [Element; N]) {
        match exponent.to_integer() {
            Some(n) => self.map(x, out, |m, x| integer_power(m, x, n)),
            None => self.map(x, out, |m, [a, b]| {
                let power = if b == 0 { m.odd_power(a, exponent) } else { None };
                power.map(|value| [value, 0])
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::prime::is_prime;
    use super::*;

    fn modulus(residue: u64, of: u64) -> Modulus {
        let prime = (1u64 << 60..).find(|p| p % of == residue && is_prime(*p));
        Modulus::new(prime.expect("there is one"))
    }

    #[test]
    fn elements_of_the_prime_field_have_roots_of_index_two_and_four() {
        let m = modulus(3, 8);
        let mut outside = 0;
        for n in 1..200u64 {
            let x = [m.integer(n * n * n + 7), 0];
            let square = root(&m, x).expect("every element is a square here");
            assert_eq!(product(&m, square, square), x, "√x √x = x");
            outside += usize::from(square[1] != 0);
            let fourth = root(&m, square).expect("and so is its root");
            assert_eq!(product(&m, fourth, fourth), square, "√√x √√x = √x");
            let negative = [m.sub(0, square[0]), m.sub(0, square[1])];
            assert!(root(&m, negative).is_some(), "with either sign");
        }
        assert!(outside > 50, "half of the roots are not in the prime field: {outside}");
        assert_eq!(root(&m, [0, 0]), None, "√0 has no sign");
    }

    #[test]
    fn eighth_roots_exist_where_eight_divides_p_plus_one() {
        let m = modulus(7, 8);
        for n in 2..100u64 {
            let mut x = [m.integer(n), 0];
            for _ in 0..3 {
                x = root(&m, x).expect("a root");
            }
        }
    }

    #[test]
    fn other_elements_are_squares_where_their_norm_is_one() {
        let m = modulus(3, 4);
        let (mut some, mut none) = (0, 0);
        for n in 1..200u64 {
            let x = [m.integer(n), m.integer(n * n + 3)];
            match root(&m, x) {
                Some(root) => {
                    assert_eq!(product(&m, root, root), x, "√x √x = x");
                    some += 1;
                }
                None => {
                    assert!(!m.is_square(norm(&m, x)), "its norm is no square");
                    none += 1;
                }
            }
        }
        assert!(some > 50 && none > 50, "half of them: {some} and {none}");
    }

    #[test]
    fn a_field_computes() {
        let m = modulus(3, 4);
        let domain = Quadratic::new([m; 4]);
        let x = [[m.integer(3), m.integer(5)], [0, 0], NONE, [0, m.integer(7)]];
        let mut inverse = [NONE; 4];
        domain.unary(UnaryFunction::Recip, &x, &mut inverse);
        assert_eq!(inverse[1..3], [NONE; 2], "of 0, and of nothing");
        let mut one = [NONE; 4];
        domain.binary(BinaryOperation::Mul, &x, &inverse, &mut one);
        assert_eq!([one[0], one[3]], [[m.one(), 0]; 2], "x · 1/x");
        let mut cube = [NONE; 4];
        domain.power(&x, &Rational::from(-3), &mut cube);
        let by_hand = product(&m, inverse[0], product(&m, inverse[0], inverse[0]));
        assert_eq!(cube[0], by_hand, "x^-3");
        domain.power(&x, &Rational::new(1, 3), &mut cube);
        assert_eq!(cube[0], NONE, "odd roots are those of the prime field");
    }
}
