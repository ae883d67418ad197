//! One suite for every number domain: field laws, agreement with exact rationals, containment where
//! the domain encloses, undefined results where there are none.

mod suite;
mod tested;

use crate::common::{dyadic, exact, rational};
use crate::random::draws;
use liouville::number::arb::{Approximation, ArbBall};
use liouville::number::ball::Ball;
use liouville::number::double_double_ball::{DoubleDoubleBall, DoubleDoubleBalls};
use liouville::number::exact::Exact;
use liouville::number::float::Float;
use liouville::number::mixed::Mixed;
use liouville::number::prime::{Modulus, Prime};
use liouville::number::quadratic::Quadratic;
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, Domain, UnaryFunction};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use suite::Suite;
use tested::{Tested, interval, unit};

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
    Suite { domain: DoubleDoubleBall::<4>, name: "double-double" }.run();
}

#[test]
fn many_bits_pass() {
    for bits in [16, 200] {
        Suite { domain: ArbBall::new(bits), name: "many bits" }.run();
    }
}

#[test]
#[ignore = "slow: as with 200 bits"]
fn a_thousand_bits_pass() {
    Suite { domain: ArbBall::new(1000), name: "a thousand bits" }.run();
}

#[test]
fn rationals_pass() {
    Suite { domain: Exact, name: "rationals" }.run();
}

#[test]
fn rationals_and_balls_pass() {
    Suite { domain: Mixed::new(64), name: "rationals and balls" }.run();
}

#[test]
#[ignore = "slow: as with balls of 64 bits"]
fn rationals_and_balls_of_many_bits_pass() {
    Suite { domain: Mixed::new(1000), name: "rationals and balls" }.run();
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
    let domain = DoubleDoubleBall::<LANES>;
    let u2 = unit(-106);
    let (mut add, mut mul, mut recip, mut root) = (0f64, 0f64, 0f64, 0f64);
    let all: Vec<(Rational, Rational)> = pairs(draws(2_000) as usize).collect();
    for block in all.chunks(LANES) {
        let (a, b): (Vec<Rational>, Vec<Rational>) = block.iter().cloned().unzip();
        let (x, y) = (domain.values(&a), domain.values(&b));
        let exact_mid = |block: &DoubleDoubleBalls<LANES>, lane: usize| {
            dyadic(block.hi[lane]) + dyadic(block.lo[lane])
        };
        let run = |f: &dyn Fn(&mut DoubleDoubleBalls<LANES>)| {
            let mut out = x.clone();
            f(&mut out);
            out
        };
        let sum = run(&|out| domain.binary(BinaryOperation::Add, &x, &y, out));
        let product = run(&|out| domain.binary(BinaryOperation::Mul, &x, &y, out));
        let inverse = run(&|out| domain.unary(UnaryFunction::Recip, &x, out));
        let size = run(&|out| domain.unary(UnaryFunction::Abs, &x, out));
        let square_root = run(&|out| domain.unary(UnaryFunction::Sqrt, &size, out));
        for lane in 0..block.len() {
            let (a, b) = (exact_mid(&x, lane), exact_mid(&y, lane));
            let grade = |worst: &mut f64, block: &DoubleDoubleBalls<LANES>, value: BigRational| {
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
    for (a, b) in pairs(draws(4_000) as usize) {
        let domain = DoubleDoubleBall::<1>;
        let (x, y) = (domain.constant(&a), domain.constant(&b));
        let (p, q) = (Quad(x.hi[0], x.lo[0]), Quad(y.hi[0], y.lo[0]));
        let mut out = x.clone();
        let near = |theirs: Quad, ours: &DoubleDoubleBalls<1>, scale: f64| {
            let apart = ((theirs.0 - ours.hi[0]) + (theirs.1 - ours.lo[0])).abs();
            assert!(apart <= 64.0 * 2f64.powi(-106) * scale, "{a} and {b}: off by {apart:e}");
        };
        domain.binary(BinaryOperation::Add, &x, &y, &mut out);
        near(p + q, &out, x.hi[0].abs() + y.hi[0].abs());
        domain.binary(BinaryOperation::Mul, &x, &y, &mut out);
        near(p * q, &out, out.hi[0].abs());
        domain.unary(UnaryFunction::Recip, &y, &mut out);
        near(Quad(1.0, 0.0) / q, &out, out.hi[0].abs());
    }
}

fn decimal(x: &Option<Approximation>, digits: usize) -> String {
    let x = x.as_ref().expect("defined");
    x.decimal(digits).expect("enough bits")
}

#[test]
fn known_constants_come_out() {
    let suite = Suite { domain: ArbBall::new(240), name: "240 bits" };
    let one = suite.of(&BigRational::one());
    let four = suite.of(&exact("4"));
    let pi = suite.binary(BinaryOperation::Mul, &four, &suite.unary(UnaryFunction::Atan, &one));
    assert_eq!(decimal(&pi, 60), "3.14159265358979323846264338327950288419716939937510582097494");
    let e = suite.unary(UnaryFunction::Exp, &one);
    assert_eq!(decimal(&e, 60), "2.71828182845904523536028747135266249775724709369995957496697");
    let two = suite.of(&exact("2"));
    let ln2 = suite.unary(UnaryFunction::Ln, &two);
    assert_eq!(decimal(&ln2, 60), "0.693147180559945309417232121458176568075500134360255254120680");
    let root = suite.unary(UnaryFunction::Sqrt, &two);
    assert_eq!(decimal(&root, 60), "1.41421356237309504880168872420969807856967187537694807317668");
}

#[test]
fn elementary_functions_invert_each_other_at_any_precision() {
    for bits in [40, 100, 256, 1500] {
        let suite = Suite { domain: ArbBall::new(bits), name: "elementary" };
        for text in ["0.3", "-2.75", "1e-9", "13.4", "-0.0001", "0.99", "700", "1", "3/2", "0.74"] {
            let x = suite.of(&exact(text));
            let same = |a: &Option<Approximation>, b: &Option<Approximation>, what: &str| {
                assert!(suite.domain.may_equal(a, b, &BigRational::zero()), "{what} at {text}");
                let (mid, rad) = interval(a.as_ref().expect("defined"));
                let loss = unit(-(bits as i32) + 24) * (mid.abs() + BigRational::one());
                assert!(rad <= loss, "{what} at {text} with {bits} bits is too wide");
            };
            let exp = suite.unary(UnaryFunction::Exp, &x);
            same(&suite.unary(UnaryFunction::Ln, &exp), &x, "ln exp x = x");
            let (s, c) = (suite.unary(UnaryFunction::Sin, &x), suite.unary(UnaryFunction::Cos, &x));
            let square = |x| suite.binary(BinaryOperation::Mul, x, x);
            let length = suite.binary(BinaryOperation::Add, &square(&s), &square(&c));
            same(&length, &suite.of(&BigRational::one()), "sin² + cos² = 1");
            let twice = suite.binary(BinaryOperation::Add, &x, &x);
            let product = suite.binary(BinaryOperation::Mul, &s, &c);
            let doubled = suite.binary(BinaryOperation::Add, &product, &product);
            same(&suite.unary(UnaryFunction::Sin, &twice), &doubled, "sin 2x = 2 sin x cos x");
            let angle = suite.unary(UnaryFunction::Atan, &x);
            let slope = suite.binary(
                BinaryOperation::Mul,
                &suite.unary(UnaryFunction::Sin, &angle),
                &suite.unary(UnaryFunction::Recip, &suite.unary(UnaryFunction::Cos, &angle)),
            );
            same(&slope, &x, "tan atan x = x");
            let cube = suite.power(&exp, (1, 3));
            same(&suite.power(&cube, (3, 1)), &exp, "(x^(1/3))³ = x");
        }
    }
}

#[test]
fn balls_grant_elementary_functions_enough() {
    let (ball, double_double_ball, precise) = (Ball::<1>, DoubleDoubleBall::<1>, ArbBall::new(160));
    let functions = [
        UnaryFunction::Exp,
        UnaryFunction::Ln,
        UnaryFunction::Sin,
        UnaryFunction::Cos,
        UnaryFunction::Atan,
        UnaryFunction::Sqrt,
    ];
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
                UnaryFunction::Ln | UnaryFunction::Sqrt => x.abs() + f64::MIN_POSITIVE,
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
                let mut t = double_double_ball.constant(&value);
                double_double_ball.unary(function, &t.clone(), &mut t);
                let (mid, rad) = interval(&truth);
                let apart = (midpoint_of(&t) - mid).abs();
                assert!(apart <= dyadic(t.rad[0]) + rad, "{function:?} {x:e} in double-double");
                assert!(t.rad[0] <= 1e-29 * (1.0 + t.hi[0].abs()), "{function:?} {x:e} is narrow");
            }
        }
    }
    println!("largest error of an elementary function: {worst:.3} ulp");
}

fn midpoint_of(block: &DoubleDoubleBalls<1>) -> BigRational {
    dyadic(block.hi[0]) + dyadic(block.lo[0])
}
