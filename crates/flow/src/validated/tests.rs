//! Enclosures of known solutions, with true values in 200 bits.

use liouville::graph::{Expr, record};
use liouville::number::arb::ArbBall;
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, Domain, Enclosing, UnaryFunction};
use liouville::scalar::Scalar;
use num_dual::DualNum;

use super::coefficients::{BOXES, Block, Coefficients};
use super::enclosure::Enclosure;
use super::motion::ORDER;
use super::plan::Plan;
use super::tail::{End, FIRST, states};
use super::{coefficients, sharp};
use crate::taylor::program::TaylorProgram;

type Number = <ArbBall as Domain>::Block;

const PRECISE: fn() -> ArbBall = || ArbBall::new(200);

pub(super) fn plan(dimension: usize, field: impl FnOnce(&[Expr]) -> Vec<Expr>) -> Plan {
    let (graph, rates) = record(dimension, |x| field(x)).expect("recorded");
    Plan::new(&TaylorProgram::exact(&graph, &rates).expect("compiled")).expect("enclosed")
}

fn exact(x: f64) -> Number {
    PRECISE().values(&[Rational::from_f64(x).expect("finite")])
}

fn apply(function: UnaryFunction, x: &Number) -> Number {
    let mut out = x.clone();
    PRECISE().unary(function, x, &mut out);
    out
}

fn combined(operation: BinaryOperation, x: &Number, y: &Number) -> Number {
    let mut out = x.clone();
    PRECISE().binary(operation, x, y, &mut out);
    out
}

fn times(x: &Number, y: &Number) -> Number {
    combined(BinaryOperation::Mul, x, y)
}

fn plus(x: &Number, y: &Number) -> Number {
    combined(BinaryOperation::Add, x, y)
}

fn minus(x: &Number, y: &Number) -> Number {
    combined(BinaryOperation::Sub, x, y)
}

/// Asserts that a number lies in an enclosure that is not wide.
fn assert_inside(found: Enclosure, truth: &Number, what: &str) {
    let off = minus(truth, &exact(found.mid));
    let (mid, rad) = ArbBall::enclosure(&off, 0).expect("a number");
    assert!(mid.abs() + rad <= found.rad, "{what}: off by {mid:e}, radius {:e}", found.rad);
    assert!(found.rad <= 1e-10 * (1.0 + found.mid.abs()), "{what}: wide, {found:?}");
}

/// Numbers in (0, 1), always the same.
pub(super) struct Random(pub(super) u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

fn blocks(lanes: &[Vec<Enclosure>]) -> Vec<Block> {
    let block = |row: usize| {
        let of = |lane: usize| lanes[lane][row];
        Block::new(std::array::from_fn(|l| of(l).mid), std::array::from_fn(|l| of(l).rad))
    };
    (0..lanes[0].len()).map(block).collect()
}

fn step(plan: &Plan, starts: &[Vec<Enclosure>], h: &[Enclosure]) -> [Option<End>; BOXES] {
    let mut coefficients = Coefficients::new(plan, ORDER);
    coefficients.expand(&blocks(starts));
    let h: Vec<Vec<Enclosure>> = h.iter().map(|h| vec![*h]).collect();
    states(&coefficients, &blocks(&h)[0], &mut FIRST.clone())
}

/// Number of groups of lanes that a test tries, `LIOUVILLE_STEP_GROUPS`: by default all tests together
/// try more than 10⁴ steps.
fn groups() -> usize {
    let wanted = std::env::var("LIOUVILLE_STEP_GROUPS").ok().and_then(|text| text.parse().ok());
    wanted.unwrap_or(325)
}

/// Tries steps of a system; `make` returns a start, a time, and the true end.
fn try_all(plan: &Plan, make: impl Fn(&mut Random) -> (Vec<Enclosure>, Enclosure, Vec<Number>)) {
    let mut random = Random(7);
    for trial in 0..groups() {
        let (mut starts, mut h, mut truths) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..BOXES {
            let (start, time, truth) = make(&mut random);
            starts.push(start);
            h.push(time);
            truths.push(truth);
        }
        for (lane, (end, truth)) in step(plan, &starts, &h).iter().zip(&truths).enumerate() {
            let end = end.as_ref().unwrap_or_else(|| panic!("{trial}, {lane}: no tail"));
            for (row, (x, truth)) in end.state.iter().zip(truth).enumerate() {
                assert_inside(*x, truth, &format!("trial {trial}, lane {lane}, row {row}"));
            }
        }
    }
}

/// Box around a point, with the point itself off its midpoint.
fn off(random: &mut Random, x: f64) -> Enclosure {
    let rad = 1e-12 * random.next();
    let mid = x + rad * random.between(-0.9, 0.9);
    // The midpoint is rounded.
    Enclosure::about(mid, rad + 2.0 * f64::EPSILON * x.abs())
}

#[test]
fn exponentials_are_enclosed() {
    let plan = plan(1, |x| vec![x[0]]);
    try_all(&plan, |random| {
        let (x, h) = (random.between(-3.0, 3.0), random.between(1e-6, 0.4));
        let start = if random.next() < 0.5 { Enclosure::exact(x) } else { off(random, x) };
        let truth = times(&exact(x), &apply(UnaryFunction::Exp, &exact(h)));
        (vec![start], Enclosure::exact(h), vec![truth])
    });
}

#[test]
fn oscillators_and_their_derivatives_are_enclosed() {
    let plan = plan(4, |x| vec![x[1], -x[0], x[3], -x[2]]);
    try_all(&plan, |random| {
        let [x, y, h] = [random.between(-2.0, 2.0), random.between(-2.0, 2.0), random.next() * 0.4];
        let (cos, sin) =
            (apply(UnaryFunction::Cos, &exact(h)), apply(UnaryFunction::Sin, &exact(h)));
        let moved = |x: f64, y: f64| {
            let (x, y) = (exact(x), exact(y));
            let forth = plus(&times(&x, &cos), &times(&y, &sin));
            [forth, minus(&times(&y, &cos), &times(&x, &sin))]
        };
        let starts = vec![off(random, x), off(random, y), Enclosure::exact(1.0), Enclosure::ZERO];
        let h = Enclosure::about(h, 1e-15);
        (starts, h, [moved(x, y), moved(1.0, 0.0)].concat())
    });
}

#[test]
fn kepler_orbits_are_enclosed() {
    let plan = plan(4, |x| {
        let square = x[0] * x[0] + x[1] * x[1];
        let cube = square * square.sqrt();
        vec![x[2], x[3], -x[0] / cube, -x[1] / cube]
    });
    // Pericentre at 1 - e with e = (s² - 1)/(s² + 1), where the velocity is s.
    try_all(&plan, |random| {
        let (s, anomaly) = (random.between(1.0, 1.6), random.between(1e-4, 0.08));
        let (one, two, s2) = (exact(1.0), exact(2.0), times(&exact(s), &exact(s)));
        let below = apply(UnaryFunction::Recip, &plus(&s2, &one));
        let e = times(&minus(&s2, &one), &below);
        let (cos, sin) = (
            apply(UnaryFunction::Cos, &exact(anomaly)),
            apply(UnaryFunction::Sin, &exact(anomaly)),
        );
        let minor = times(&times(&two, &exact(s)), &below);
        let time = minus(&exact(anomaly), &times(&e, &sin));
        let rate = apply(UnaryFunction::Recip, &minus(&one, &times(&e, &cos)));
        let truth = vec![
            minus(&cos, &e),
            times(&minor, &sin),
            apply(UnaryFunction::Neg, &times(&sin, &rate)),
            times(&times(&minor, &cos), &rate),
        ];
        let of = |x: &Number| {
            let (mid, rad) = ArbBall::enclosure(x, 0).expect("a number");
            Enclosure::about(mid, rad)
        };
        let start = vec![of(&times(&two, &below)), Enclosure::ZERO, Enclosure::ZERO];
        ([start, vec![Enclosure::exact(s)]].concat(), of(&time), truth)
    });
}

#[test]
fn integrals_of_all_functions_are_enclosed() {
    let third = Rational::new(1, 3);
    let plan = plan(10, |y| {
        let x = y[0];
        let power = x.power(&third);
        let one = Expr::rational(&Rational::from(1));
        vec![
            one,
            x.exp(),
            x.ln(),
            x.sin(),
            x.cos(),
            x.atan(),
            x.sqrt(),
            power,
            x.recip(),
            (one + x * x).recip(),
        ]
    });
    try_all(&plan, |random| {
        let (a, h) = (random.between(0.6, 3.0), random.between(1e-5, 0.05));
        let b = plus(&exact(a), &exact(h));
        let change = |f: &dyn Fn(&Number) -> Number| minus(&f(&b), &f(&exact(a)));
        let of = |function| move |x: &Number| apply(function, x);
        let ln = of(UnaryFunction::Ln);
        let power = |x: &Number, exponent: &Rational| {
            let mut out = x.clone();
            PRECISE().power(x, exponent, &mut out);
            times(&out, &PRECISE().constant(&exponent.recip().expect("not 0")))
        };
        let one = exact(1.0);
        let truth = vec![
            b.clone(),
            change(&of(UnaryFunction::Exp)),
            change(&|x| minus(&times(x, &ln(x)), x)),
            change(&|x| apply(UnaryFunction::Neg, &apply(UnaryFunction::Cos, x))),
            change(&of(UnaryFunction::Sin)),
            change(&|x| {
                let rest = times(&exact(0.5), &ln(&plus(&one, &times(x, x))));
                minus(&times(x, &apply(UnaryFunction::Atan, x)), &rest)
            }),
            change(&|x| power(x, &Rational::new(3, 2))),
            change(&|x| power(x, &Rational::new(4, 3))),
            change(&ln),
            change(&of(UnaryFunction::Atan)),
        ];
        let start = [vec![Enclosure::exact(a)], vec![Enclosure::ZERO; 9]].concat();
        (start, Enclosure::exact(h), truth)
    });
}

#[test]
fn no_tail_reaches_beyond_a_pole() {
    // x = 1/(1 - t), with the radius of convergence 1.
    let plan = plan(1, |x| vec![x[0] * x[0]]);
    let start = vec![vec![Enclosure::exact(1.0)]; BOXES];
    let at = |h: f64| step(&plan, &start, &[Enclosure::exact(h); BOXES]).into_iter().next();
    for h in [0.7, 0.99, 1.0, 1.5, 100.0] {
        assert!(at(h).flatten().is_none(), "a step of {h} needs a radius above it");
    }
    for h in [0.01, 0.1, 0.25] {
        let end = at(h).flatten().expect("well inside");
        let truth = apply(UnaryFunction::Recip, &minus(&exact(1.0), &exact(h)));
        let off = minus(&truth, &exact(end.state[0].mid));
        let (mid, rad) = ArbBall::enclosure(&off, 0).expect("a number");
        assert!(mid.abs() + rad <= end.state[0].rad, "{h}: {:?}", end.state);
        // The remainder is t^21/(1 - t).
        assert!(end.rest[0] >= h.powi(21), "{h}: no bound is below what is left out");
    }
}

#[test]
fn undefined_rows_have_no_tail() {
    // 1/x over a box that contains 0, multiplied by 0 or not; √x below 0.
    let start = vec![vec![Enclosure::about(0.0, 1e-3)]; BOXES];
    let h = [Enclosure::exact(1e-3); BOXES];
    let is_open = |plan: &Plan| step(plan, &start, &h).iter().all(Option::is_none);
    assert!(is_open(&plan(1, |x| vec![x[0].recip()])), "a pole in the box");
    assert!(is_open(&plan(1, |x| vec![x[0].sqrt()])), "a branch in the box");
    assert!(is_open(&plan(1, |x| vec![x[0].ln()])), "a logarithm of 0");
    let unknown = vec![vec![Enclosure::about(1.0, f64::NAN)]; BOXES];
    let constant = plan(1, |x| vec![x[0]]);
    assert!(step(&constant, &unknown, &h).iter().all(Option::is_none), "nothing known");
}

#[test]
fn residuals_in_twice_the_digits_hold() {
    let plan = plan(2, |x| vec![x[1], -x[0]]);
    let mut random = Random(11);
    for _ in 0..300 {
        let [x, y, share] = [(); 3].map(|()| random.between(0.1, 0.3));
        let target = [random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
        let period = 0.7;
        let rests = {
            let mut coefficients = Coefficients::new(&plan, ORDER);
            let start = vec![vec![Enclosure::exact(x), Enclosure::exact(y)]; BOXES];
            coefficients.expand(&blocks(&start));
            let h = Enclosure::exact(share) * Enclosure::exact(period);
            states(&coefficients, &coefficients::constant(h), &mut FIRST.clone())
        };
        let rest = &rests[0].as_ref().expect("an entire function").rest;
        let starts = [vec![x, y]];
        let gap = sharp::gaps(&plan, ORDER, &starts, &[share], period, &[&target]);
        let h = times(&exact(share), &exact(period));
        let (cos, sin) = (apply(UnaryFunction::Cos, &h), apply(UnaryFunction::Sin, &h));
        let (x, y) = (exact(x), exact(y));
        let truth =
            [plus(&times(&x, &cos), &times(&y, &sin)), minus(&times(&y, &cos), &times(&x, &sin))];
        for (row, truth) in truth.iter().enumerate() {
            let truth = minus(truth, &exact(target[row]));
            let found = gap[0][row] + Enclosure::about(0.0, rest[row]);
            assert_inside(found, &truth, "a gap");
        }
    }
}
