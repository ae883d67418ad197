//! One suite for every number domain: field laws, agreement with exact rationals, containment where
//! the domain encloses, undefined results where there are none.

mod common;
#[path = "common/random.rs"]
mod random;

use common::{dyadic, exact, rational};
use liouville::number::ball::{Ball, Balls};
use liouville::number::exact::Exact;
use liouville::number::float::Float;
use liouville::number::mixed::{Mixed, Number};
use liouville::number::precise::{Approximation, Precise};
use liouville::number::prime::{Modulus, Prime, UNDEFINED};
use liouville::number::quadratic::Quadratic;
use liouville::number::rational::Rational;
use liouville::number::twofold::{TwofoldBall, Twofolds};
use liouville::number::{Domain, Function, Operation};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Signed, Zero};

/// Properties of a domain that tests need besides its arithmetic.
trait Tested: Domain {
    /// Whether the block may be the image of the exact number, made from terms of size `scale`.
    fn stands_for(&self, block: &Self::Block, value: &BigRational, scale: &BigRational) -> bool;

    /// Whether two blocks may be the same number, as far as the domain shows; `scale` is the size
    /// of the terms from which they were made.
    fn may_equal(&self, a: &Self::Block, b: &Self::Block, scale: &BigRational) -> bool;

    /// Whether the first lane is defined.
    fn is_defined(&self, block: &Self::Block) -> bool;

    /// Whether the domain is ordered, so that negative numbers have no root.
    const ORDERED: bool = true;
    /// Whether the domain has moduli.
    const MODULI: bool = true;
    /// Whether the domain bounds its error.
    const ENCLOSES: bool = true;
    /// Whether the domain rounds, so that large and small numbers leave its range.
    const ROUNDS: bool = true;
}

fn within(value: &BigRational, mid: &BigRational, rad: &BigRational) -> bool {
    (value - mid).abs() <= *rad
}

fn unit(power: i32) -> BigRational {
    BigRational::from_integer(BigInt::from(2)).pow(power)
}

impl Tested for Float<4> {
    const ENCLOSES: bool = false;

    fn stands_for(&self, block: &[f64; 4], value: &BigRational, scale: &BigRational) -> bool {
        // One operation on correctly rounded arguments; subnormal results lose more.
        within(value, &dyadic(block[0]), &(scale * unit(-50) + unit(-1070)))
    }

    fn may_equal(&self, a: &[f64; 4], b: &[f64; 4], scale: &BigRational) -> bool {
        within(&dyadic(a[0]), &dyadic(b[0]), &(scale * unit(-49) + unit(-1070)))
    }

    fn is_defined(&self, block: &[f64; 4]) -> bool {
        block[0].is_finite()
    }
}

impl Tested for Ball<4> {
    fn stands_for(&self, block: &Balls<4>, value: &BigRational, _: &BigRational) -> bool {
        within(value, &dyadic(block.mid[0]), &dyadic(block.rad[0]))
    }

    fn may_equal(&self, a: &Balls<4>, b: &Balls<4>, _: &BigRational) -> bool {
        let apart = (dyadic(a.mid[0]) - dyadic(b.mid[0])).abs();
        apart <= dyadic(a.rad[0]) + dyadic(b.rad[0])
    }

    fn is_defined(&self, block: &Balls<4>) -> bool {
        block.is_defined(0)
    }
}

fn midpoint(block: &Twofolds<4>) -> BigRational {
    dyadic(block.hi[0]) + dyadic(block.lo[0])
}

impl Tested for TwofoldBall<4> {
    fn stands_for(&self, block: &Twofolds<4>, value: &BigRational, _: &BigRational) -> bool {
        within(value, &midpoint(block), &dyadic(block.rad[0]))
    }

    fn may_equal(&self, a: &Twofolds<4>, b: &Twofolds<4>, _: &BigRational) -> bool {
        (midpoint(a) - midpoint(b)).abs() <= dyadic(a.rad[0]) + dyadic(b.rad[0])
    }

    fn is_defined(&self, block: &Twofolds<4>) -> bool {
        block.is_defined(0)
    }
}

fn interval(x: &Approximation) -> (BigRational, BigRational) {
    let (mantissa, exponent, radius) = x.parts();
    let unit = unit(i32::try_from(exponent).expect("a moderate exponent"));
    (
        BigRational::from_integer(mantissa.clone()) * &unit,
        BigRational::from_integer(radius.into()) * &unit,
    )
}

impl Tested for Precise {
    const ROUNDS: bool = false;

    fn stands_for(
        &self,
        block: &Option<Approximation>,
        value: &BigRational,
        _: &BigRational,
    ) -> bool {
        let (mid, rad) = interval(block.as_ref().expect("defined"));
        within(value, &mid, &rad)
    }

    fn may_equal(
        &self,
        a: &Option<Approximation>,
        b: &Option<Approximation>,
        _: &BigRational,
    ) -> bool {
        let (a, ra) = interval(a.as_ref().expect("defined"));
        let (b, rb) = interval(b.as_ref().expect("defined"));
        within(&a, &b, &(ra + rb))
    }

    fn is_defined(&self, block: &Option<Approximation>) -> bool {
        block.is_some()
    }
}

impl Tested for Exact {
    const ROUNDS: bool = false;

    fn stands_for(&self, block: &Option<Rational>, value: &BigRational, _: &BigRational) -> bool {
        *block == Some(rational(value))
    }

    fn may_equal(&self, a: &Option<Rational>, b: &Option<Rational>, _: &BigRational) -> bool {
        a == b
    }

    fn is_defined(&self, block: &Option<Rational>) -> bool {
        block.is_some()
    }
}

impl Tested for Prime<4> {
    const ORDERED: bool = false;
    const ROUNDS: bool = false;

    fn stands_for(&self, block: &[u64; 4], value: &BigRational, _: &BigRational) -> bool {
        // Roots are those that are themselves squares: of either sign.
        let (image, minus) = (self.constant(&rational(value)), self.constant(&rational(&-value)));
        (0..4).all(|lane| block[lane] == image[lane] || block[lane] == minus[lane])
    }

    fn may_equal(&self, a: &[u64; 4], b: &[u64; 4], _: &BigRational) -> bool {
        a == b
    }

    fn is_defined(&self, block: &[u64; 4]) -> bool {
        block.iter().all(|lane| *lane != UNDEFINED)
    }
}

impl Tested for Quadratic<4> {
    const ORDERED: bool = false;
    const MODULI: bool = false;
    const ROUNDS: bool = false;

    fn stands_for(&self, block: &[[u64; 2]; 4], value: &BigRational, _: &BigRational) -> bool {
        let (image, minus) = (self.constant(&rational(value)), self.constant(&rational(&-value)));
        (0..4).all(|lane| block[lane] == image[lane] || block[lane] == minus[lane])
    }

    fn may_equal(&self, a: &[[u64; 2]; 4], b: &[[u64; 2]; 4], _: &BigRational) -> bool {
        a == b
    }

    fn is_defined(&self, block: &[[u64; 2]; 4]) -> bool {
        block.iter().all(|lane| lane[0] != UNDEFINED)
    }
}

impl Tested for Mixed {
    const ROUNDS: bool = false;

    fn stands_for(&self, block: &Number, value: &BigRational, _: &BigRational) -> bool {
        let (mid, rad) = sides(block);
        within(value, &mid, &rad)
    }

    fn may_equal(&self, a: &Number, b: &Number, _: &BigRational) -> bool {
        let ((a, ra), (b, rb)) = (sides(a), sides(b));
        within(&a, &b, &(ra + rb))
    }

    fn is_defined(&self, block: &Number) -> bool {
        matches!(block, Number::Exact(_) | Number::Ball(_))
    }
}

/// Returns midpoint and radius of an exact or enclosed number.
fn sides(number: &Number) -> (BigRational, BigRational) {
    match number {
        Number::Exact(value) => (exact(&value.to_string()), BigRational::zero()),
        Number::Ball(ball) => interval(ball),
        Number::Nothing | Number::Doubtful => panic!("it has no value"),
    }
}

/// Numbers at the edges: exact and inexact, large and small, next to each other.
const VALUES: [&str; 22] = [
    "1",
    "-1",
    "2",
    "1/3",
    "-2/7",
    "0.1",
    "1e16",
    "-1e-16",
    "9007199254740993",
    "1e150",
    "-1e-150",
    "0.70710678118654752440084436210485",
    "1.0000000000000002220446049250313",
    "123456789/1000",
    "-0.99999999999999988897769753748434",
    "5e-324",
    "1e-310",
    "1e300",
    "3",
    "-355/113",
    "1267650600228229401496703205377",
    "1/1267650600228229401496703205376",
];

struct Suite<D: Tested> {
    domain: D,
    name: &'static str,
}

impl<D: Tested> Suite<D> {
    fn of(&self, value: &BigRational) -> D::Block {
        self.domain.constant(&rational(value))
    }

    fn unary(&self, f: Function, x: &D::Block) -> D::Block {
        let mut out = x.clone();
        self.domain.unary(f, x, &mut out);
        out
    }

    fn binary(&self, f: Operation, x: &D::Block, y: &D::Block) -> D::Block {
        let mut out = x.clone();
        self.domain.binary(f, x, y, &mut out);
        out
    }

    fn power(&self, x: &D::Block, exponent: (i64, i64)) -> D::Block {
        let mut out = x.clone();
        self.domain.power(x, &Rational::new(exponent.0, exponent.1), &mut out);
        out
    }

    /// Checks that a result in range agrees with the exact one.
    fn check(&self, block: &D::Block, value: &BigRational, what: &str) {
        self.check_scaled(block, value, &value.abs(), what);
    }

    fn check_scaled(&self, block: &D::Block, value: &BigRational, scale: &BigRational, what: &str) {
        let range = unit(-1000)..unit(1000);
        if D::ROUNDS && !value.is_zero() && !range.contains(&value.abs()) {
            // Out of the range of f64: undefined, or still an enclosure.
            assert!(
                !D::ENCLOSES
                    || !self.domain.is_defined(block)
                    || self.domain.stands_for(block, value, scale),
                "{}: {what} out of range",
                self.name
            );
            return;
        }
        assert!(self.domain.is_defined(block), "{}: {what} has a value", self.name);
        assert!(
            self.domain.stands_for(block, value, scale),
            "{}: {what} is another number",
            self.name
        );
    }

    fn run(&self) {
        let mut values: Vec<BigRational> = VALUES.iter().map(|text| exact(text)).collect();
        // Subnormal numbers have no bound on the relative error.
        values.retain(|value| D::ENCLOSES || value.abs() > unit(-1000));
        for a in &values {
            self.one(a);
            for b in &values {
                self.two(a, b);
                for c in values.iter().step_by(5) {
                    self.three(a, b, c);
                }
            }
        }
        self.undefined();
    }

    fn one(&self, a: &BigRational) {
        let x = self.of(a);
        self.check(&x, a, "a constant");
        self.check(&self.unary(Function::Neg, &x), &-a, "-x");
        self.check(&self.unary(Function::Recip, &x), &a.recip(), "1/x");
        if D::MODULI {
            self.check(&self.unary(Function::Abs, &x), &a.abs(), "|x|");
        }
        let square = self.binary(Operation::Mul, &x, &x);
        self.check(&square, &(a * a), "x x");
        let tiny = !D::ROUNDS || (unit(-480)..unit(480)).contains(&a.abs());
        if tiny {
            self.check(&self.unary(Function::Sqrt, &square), &a.abs(), "√(x x)");
        }
        for n in [-3i64, -1, 1, 2, 5] {
            let power = a.pow(n as i32);
            if !D::ROUNDS || (unit(-300)..unit(300)).contains(&a.abs()) && a.is_positive() {
                self.check(&self.power(&x, (n, 1)), &power, "x^n");
            }
        }
        let zero = self.binary(Operation::Sub, &x, &x);
        self.check(&zero, &BigRational::zero(), "x - x");
    }

    fn two(&self, a: &BigRational, b: &BigRational) {
        let (x, y) = (self.of(a), self.of(b));
        let size = a.abs() + b.abs();
        self.check_scaled(&self.binary(Operation::Add, &x, &y), &(a + b), &size, "x + y");
        self.check_scaled(&self.binary(Operation::Sub, &x, &y), &(a - b), &size, "x - y");
        self.check(&self.binary(Operation::Mul, &x, &y), &(a * b), "x y");
        for operation in [Operation::Add, Operation::Mul] {
            let (xy, yx) = (self.binary(operation, &x, &y), self.binary(operation, &y, &x));
            self.equal(&xy, &yx, &BigRational::zero(), "commutes");
        }
        if !D::ENCLOSES && !(unit(-1000)..unit(1000)).contains(&(a / b).abs()) {
            return;
        }
        let quotient = self.binary(Operation::Mul, &x, &self.unary(Function::Recip, &y));
        let back = self.binary(Operation::Mul, &quotient, &y);
        self.equal(&back, &x, &a.abs(), "(x/y) y = x");
    }

    fn three(&self, a: &BigRational, b: &BigRational, c: &BigRational) {
        let (x, y, z) = (self.of(a), self.of(b), self.of(c));
        let op = |f, x: &D::Block, y: &D::Block| self.binary(f, x, y);
        let (add, mul) = (Operation::Add, Operation::Mul);
        let sum = a.abs() + b.abs() + c.abs();
        self.equal(
            &op(add, &op(add, &x, &y), &z),
            &op(add, &x, &op(add, &y, &z)),
            &sum,
            "x + y + z",
        );
        let product = (a * b * c).abs();
        self.equal(
            &op(mul, &op(mul, &x, &y), &z),
            &op(mul, &x, &op(mul, &y, &z)),
            &product,
            "x y z",
        );
        let left = op(mul, &x, &op(add, &y, &z));
        let right = op(add, &op(mul, &x, &y), &op(mul, &x, &z));
        self.equal(&left, &right, &(a.abs() * (b.abs() + c.abs())), "x (y + z)");
    }

    fn equal(&self, a: &D::Block, b: &D::Block, scale: &BigRational, what: &str) {
        // Values that left the range of f64 on either side obey no law.
        if self.domain.is_defined(a) && self.domain.is_defined(b) {
            let out_of_range = D::ROUNDS && !(unit(-900)..unit(900)).contains(scale);
            let same = self.domain.may_equal(a, b, scale);
            assert!(same || (out_of_range && !scale.is_zero()), "{}: {what}", self.name);
        } else {
            assert!(D::ROUNDS, "{}: {what} is defined", self.name);
        }
    }

    fn undefined(&self) {
        let number = |text: &str| self.of(&exact(text));
        let (zero, minus) = (number("0"), number("-2"));
        let none = |block: &D::Block, what: &str| {
            assert!(!self.domain.is_defined(block), "{}: {what} has no value", self.name);
        };
        none(&self.unary(Function::Recip, &zero), "1/0");
        none(&self.unary(Function::Ln, &zero), "ln 0");
        none(&self.power(&zero, (-1, 1)), "0^-1");
        if D::ORDERED {
            none(&self.power(&minus, (1, 3)), "(-2)^(1/3)");
            none(&self.unary(Function::Sqrt, &minus), "√-2");
            none(&self.unary(Function::Ln, &minus), "ln -2");
            self.check(&self.unary(Function::Sqrt, &zero), &BigRational::zero(), "√0");
        }
        let gone = self.unary(Function::Recip, &zero);
        none(&self.binary(Operation::Mul, &gone, &zero), "(1/0) 0");
        none(&self.binary(Operation::Sub, &gone, &gone), "1/0 - 1/0");
        none(&self.unary(Function::Abs, &gone), "|1/0|");
    }
}

#[test]
fn floats_pass() {
    Suite { domain: Float::<4>, name: "f64" }.run();
}

#[test]
fn balls_pass() {
    Suite { domain: Ball::<4>, name: "ball" }.run();
}

#[test]
fn double_double_balls_pass() {
    Suite { domain: TwofoldBall::<4>, name: "double-double" }.run();
}

#[test]
fn many_bits_pass() {
    for bits in [16, 64, 200, 1000] {
        Suite { domain: Precise::new(bits), name: "many bits" }.run();
    }
}

#[test]
fn rationals_pass() {
    Suite { domain: Exact, name: "rationals" }.run();
}

#[test]
fn rationals_and_balls_pass() {
    for bits in [64, 1000] {
        Suite { domain: Mixed::new(bits), name: "rationals and balls" }.run();
    }
}

#[test]
fn fields_pass() {
    // p = 3 mod 4, and 2 mod 3 so that cube roots are unique; -2 is no square modulo any of them.
    let primes = [1152921504606848051u64, 2305843009213693967];
    let suitable = |from: u64| {
        (from..).find(|p| {
            let m = Modulus::new(*p | 1);
            *p % 12 == 11
                && liouville::number::prime::is_prime(*p)
                && !m.is_square(m.sub(0, m.integer(2)))
        })
    };
    let [p, q] = primes.map(|from| Modulus::new(suitable(from / 2).expect("primes go on")));
    Suite { domain: Prime::new([p, p, q, q]), name: "prime fields" }.run();
    Suite { domain: Quadratic::new([p, p, q, q]), name: "quadratic extensions" }.run();
}

/// Draws random double-doubles of all sizes, with cancelling partners.
fn pairs(count: usize) -> impl Iterator<Item = (Rational, Rational)> {
    let mut state = 0x9E37_79B9_7F4A_7C15u64;
    let mut next = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state
    };
    (0..count).map(move |index| {
        let mut number = |spread: u64| {
            let mantissa = (u128::from(next()) << 42 | u128::from(next() >> 22)) | 1 << 105;
            let exponent = (next() % (2 * spread + 1)) as i32 - spread as i32 - 105;
            let sign = if next() % 2 == 0 { 1 } else { -1 };
            BigRational::from_integer(BigInt::from(mantissa) * sign) * unit(exponent)
        };
        let a = number(if index % 3 == 0 { 200 } else { 3 });
        let b = match index % 4 {
            0 => -&a * (BigRational::one() + unit(-30 - (index % 70) as i32)),
            1 => &a * (BigRational::one() - unit(-52)),
            _ => number(40),
        };
        (rational(&a), rational(&b))
    })
}

#[test]
fn double_double_keeps_its_stated_bounds() {
    const LANES: usize = 64;
    let domain = TwofoldBall::<LANES>;
    let u2 = unit(-106);
    let (mut add, mut mul, mut recip, mut root) = (0f64, 0f64, 0f64, 0f64);
    let all: Vec<(Rational, Rational)> = pairs(25_600).collect();
    for block in all.chunks(LANES) {
        let (a, b): (Vec<Rational>, Vec<Rational>) = block.iter().cloned().unzip();
        let (x, y) = (domain.values(&a), domain.values(&b));
        let exact_mid =
            |block: &Twofolds<LANES>, lane: usize| dyadic(block.hi[lane]) + dyadic(block.lo[lane]);
        let run = |f: &dyn Fn(&mut Twofolds<LANES>)| {
            let mut out = x.clone();
            f(&mut out);
            out
        };
        let sum = run(&|out| domain.binary(Operation::Add, &x, &y, out));
        let product = run(&|out| domain.binary(Operation::Mul, &x, &y, out));
        let inverse = run(&|out| domain.unary(Function::Recip, &x, out));
        let size = run(&|out| domain.unary(Function::Abs, &x, out));
        let square_root = run(&|out| domain.unary(Function::Sqrt, &size, out));
        for lane in 0..block.len() {
            let (a, b) = (exact_mid(&x, lane), exact_mid(&y, lane));
            let grade = |worst: &mut f64, block: &Twofolds<LANES>, value: BigRational| {
                let error = (exact_mid(block, lane) - &value).abs();
                if !value.is_zero() {
                    let units = &error / (value.abs() * &u2);
                    *worst = worst.max(num_traits::ToPrimitive::to_f64(&units).unwrap_or(1e300));
                }
            };
            grade(&mut add, &sum, &a + &b);
            grade(&mut mul, &product, &a * &b);
            grade(&mut recip, &inverse, a.recip());
            // (z + e)² = x: e = (x - z²)/2z to first order.
            let z = exact_mid(&square_root, lane);
            let e = (a.abs() - &z * &z) / (&z * BigRational::from_integer(2.into()));
            let units = e.abs() / (&z * &u2);
            root = root.max(num_traits::ToPrimitive::to_f64(&units).unwrap_or(1e300));
        }
    }
    println!("worst errors in u²: + {add:.2}, × {mul:.2}, 1/x {recip:.2}, √ {root:.2}");
    assert!(add <= 3.01 && mul <= 5.01, "sums {add}, products {mul}");
    assert!(recip <= 18.0 && root <= 8.5, "reciprocals {recip}, roots {root}");
}

#[test]
fn double_double_agrees_with_a_kept_library() {
    use qd::Quad;
    for (a, b) in pairs(20_000) {
        let domain = TwofoldBall::<1>;
        let (x, y) = (domain.constant(&a), domain.constant(&b));
        let (p, q) = (Quad(x.hi[0], x.lo[0]), Quad(y.hi[0], y.lo[0]));
        let mut out = x.clone();
        let near = |theirs: Quad, ours: &Twofolds<1>, scale: f64| {
            let apart = ((theirs.0 - ours.hi[0]) + (theirs.1 - ours.lo[0])).abs();
            assert!(apart <= 64.0 * 2f64.powi(-106) * scale, "{a} and {b}: off by {apart:e}");
        };
        domain.binary(Operation::Add, &x, &y, &mut out);
        near(p + q, &out, x.hi[0].abs() + y.hi[0].abs());
        domain.binary(Operation::Mul, &x, &y, &mut out);
        near(p * q, &out, out.hi[0].abs());
        domain.unary(Function::Recip, &y, &mut out);
        near(Quad(1.0, 0.0) / q, &out, out.hi[0].abs());
    }
}

fn decimal(x: &Option<Approximation>, digits: usize) -> String {
    let x = x.as_ref().expect("defined");
    x.decimal(digits).expect("enough bits")
}

#[test]
fn known_constants_come_out() {
    let suite = Suite { domain: Precise::new(240), name: "240 bits" };
    let one = suite.of(&BigRational::one());
    let four = suite.of(&exact("4"));
    let pi = suite.binary(Operation::Mul, &four, &suite.unary(Function::Atan, &one));
    assert_eq!(decimal(&pi, 60), "3.14159265358979323846264338327950288419716939937510582097494");
    let e = suite.unary(Function::Exp, &one);
    assert_eq!(decimal(&e, 60), "2.71828182845904523536028747135266249775724709369995957496697");
    let two = suite.of(&exact("2"));
    let ln2 = suite.unary(Function::Ln, &two);
    assert_eq!(decimal(&ln2, 60), "0.693147180559945309417232121458176568075500134360255254120680");
    let root = suite.unary(Function::Sqrt, &two);
    assert_eq!(decimal(&root, 60), "1.41421356237309504880168872420969807856967187537694807317668");
}

#[test]
fn elementary_functions_invert_each_other_at_any_precision() {
    for bits in [40, 100, 256, 1500] {
        let suite = Suite { domain: Precise::new(bits), name: "elementary" };
        for text in ["0.3", "-2.75", "1e-9", "13.4", "-0.0001", "0.99", "700", "1", "3/2", "0.74"] {
            let x = suite.of(&exact(text));
            let same = |a: &Option<Approximation>, b: &Option<Approximation>, what: &str| {
                assert!(suite.domain.may_equal(a, b, &BigRational::zero()), "{what} at {text}");
                let (mid, rad) = interval(a.as_ref().expect("defined"));
                let loss = unit(-(bits as i32) + 24) * (mid.abs() + BigRational::one());
                assert!(rad <= loss, "{what} at {text} with {bits} bits is too wide");
            };
            let exp = suite.unary(Function::Exp, &x);
            same(&suite.unary(Function::Ln, &exp), &x, "ln exp x = x");
            let (s, c) = (suite.unary(Function::Sin, &x), suite.unary(Function::Cos, &x));
            let square = |x| suite.binary(Operation::Mul, x, x);
            let length = suite.binary(Operation::Add, &square(&s), &square(&c));
            same(&length, &suite.of(&BigRational::one()), "sin² + cos² = 1");
            let twice = suite.binary(Operation::Add, &x, &x);
            let product = suite.binary(Operation::Mul, &s, &c);
            let doubled = suite.binary(Operation::Add, &product, &product);
            same(&suite.unary(Function::Sin, &twice), &doubled, "sin 2x = 2 sin x cos x");
            let angle = suite.unary(Function::Atan, &x);
            let slope = suite.binary(
                Operation::Mul,
                &suite.unary(Function::Sin, &angle),
                &suite.unary(Function::Recip, &suite.unary(Function::Cos, &angle)),
            );
            same(&slope, &x, "tan atan x = x");
            let cube = suite.power(&exp, (1, 3));
            same(&suite.power(&cube, (3, 1)), &exp, "(x^(1/3))³ = x");
        }
    }
}

#[test]
fn balls_grant_elementary_functions_enough() {
    let (ball, twofold, precise) = (Ball::<1>, TwofoldBall::<1>, Precise::new(160));
    let functions =
        [Function::Exp, Function::Ln, Function::Sin, Function::Cos, Function::Atan, Function::Sqrt];
    let mut state = 88_172_645_463_325_252u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut worst = 0f64;
    for index in 0..20_000 {
        let size = [1.0, 30.0, 0.01, 600.0][index % 4];
        let x = (next() - 0.5) * size;
        for function in functions {
            let x = match function {
                Function::Ln | Function::Sqrt => x.abs() + f64::MIN_POSITIVE,
                _ => x,
            };
            let value = Rational::from_f64(x).expect("finite");
            let mut truth = None;
            precise.unary(function, &precise.constant(&value), &mut truth);
            let truth = truth.expect("defined");
            let mut b = ball.constant(&value);
            ball.unary(function, &b.clone(), &mut b);
            let error = truth.distance(b.mid[0]);
            assert!(error <= b.rad[0], "{function:?} {x:e} is off by {error:e}");
            worst = worst.max(error / (b.mid[0].abs().max(f64::MIN_POSITIVE) * f64::EPSILON));
            if index % 10 == 0 {
                let mut t = twofold.constant(&value);
                twofold.unary(function, &t.clone(), &mut t);
                let (mid, rad) = interval(&truth);
                let apart = (midpoint_of(&t) - mid).abs();
                assert!(apart <= dyadic(t.rad[0]) + rad, "{function:?} {x:e} in double-double");
                assert!(t.rad[0] <= 1e-29 * (1.0 + t.hi[0].abs()), "{function:?} {x:e} is narrow");
            }
        }
    }
    println!("largest error of an elementary function: {worst:.3} ulp");
}

fn midpoint_of(block: &Twofolds<1>) -> BigRational {
    dyadic(block.hi[0]) + dyadic(block.lo[0])
}
