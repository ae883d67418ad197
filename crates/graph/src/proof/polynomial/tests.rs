//! Tests of square roots and parts of polynomials.

use num_dual::DualNum;

use super::*;
use crate::graph::{Step, record};

fn read(build: impl FnOnce(&[Expr]) -> Expr) -> Option<Fraction> {
    let (graph, value) = record(3, build).expect("records");
    fraction(&graph, graph.place(value), &|_, step| match step {
        Step::Input(input) => Some(Polynomial::variable(input as u32)),
        _ => None,
    })
}

/// Whether c b² with the computed b is the fraction itself.
fn squares(build: impl Fn(&[Expr]) -> Expr) -> Option<bool> {
    let (scale, root) = read(&build)?.square()?;
    let (graph, difference) = record(3, |inputs| {
        let b = root.value(&|k| inputs.get(k as usize).copied()).expect("all are given");
        build(inputs) - b * b * Expr::rational(&scale)
    })
    .expect("records");
    let tape = crate::graph::Tape::new(&graph, &[difference]);
    let mut run = crate::graph::Evaluator::new(&tape, crate::number::float::Float::<1>);
    let mut is_zero_at = |x: [f64; 3]| {
        run.run(&x.map(|x| [x]));
        run.output(0)[0].abs() < 1e-9
    };
    Some(is_zero_at([0.3, -0.7, 1.1]) && is_zero_at([2.0, 0.4, -1.3]))
}

#[test]
fn squares_are_found() {
    assert_eq!(squares(|x| x[0] * x[0] + x[0] * 2.0 + 1.0), Some(true), "(x + 1)²");
    let sum = |x: &[Expr]| x[0] * 3.0 - x[1] * x[2] + x[1];
    assert_eq!(squares(|x| sum(x) * sum(x) * 5.0), Some(true), "5 (3x − yz + y)²");
    let quotient = |x: &[Expr]| (x[0] + x[1] + 1.0) / (x[2] * x[2] + 1.0);
    assert_eq!(squares(|x| quotient(x) * quotient(x)), Some(true), "of a quotient");
    assert_eq!(squares(|x| x[0].powi(6) - x[0].powi(3) * 2.0 + 1.0), Some(true), "(x³ − 1)²");
    assert_eq!(squares(|x| x[0] * x[0] + 1.0), None, "x² + 1 is no square");
    assert_eq!(squares(|x| x[0] * x[0] * x[1]), None, "nor is x²y");
    assert_eq!(squares(|x| x[0] * x[0] + x[0] * 2.0 + 2.0), None, "nor x² + 2x + 2");
}

#[test]
fn random_squares_are_found() {
    use crate::proof::rng::ProofRng;
    let modulus = crate::number::prime::Modulus::new((1 << 61) - 1);
    let mut rng = ProofRng::new(7, 0);
    let mut small = |size: u64| (modulus.to_integer(rng.element(&modulus)) % size) as i64;
    for _ in 0..200 {
        let mut root = Polynomial::default();
        for _ in 0..1 + small(5) {
            let monomial = Monomial((0..3).map(|k| (k, small(3) as u32)).collect());
            let nonzero = monomial.0.into_iter().filter(|(_, e)| *e > 0).collect();
            root.add_term(Monomial(nonzero), &Rational::new(small(9) - 4, 1 + small(3)));
        }
        if root.is_zero() {
            continue;
        }
        let square = root.times(&root, &mut { MOST_WORK }).expect("small");
        let scale = Rational::new(1 + small(7), 1 + small(5));
        let (found, base) = square.scaled(&scale).square().expect("a square");
        let again = base.times(&base, &mut { MOST_WORK }).expect("small").scaled(&found);
        assert_eq!(again, square.scaled(&scale), "c b² of {root:?}");
        let off = square.plus(&Polynomial::variable(7));
        assert_eq!(off.square(), None, "and with one term more it is none: {root:?}");
    }
}

#[test]
fn what_is_too_large_is_given_up() {
    let large = read(|x| (x[0] + x[1] + x[2] + 1.0).powi(30));
    assert!(large.is_none(), "5456 terms");
}

#[test]
fn a_root_splits_off() {
    // (y + 1)³ with y² = x: y³ + 3y² + 3y + 1 = (3x + 1) + (x + 3) y
    let y = Polynomial::variable(1).plus(&Polynomial::constant(&Rational::from(1)));
    let mut work = MOST_WORK;
    let cube = y.times(&y, &mut work).and_then(|s| s.times(&y, &mut work)).expect("small");
    let [even, odd] = cube.split(1, &Polynomial::variable(0)).expect("small");
    let x = Polynomial::variable(0);
    let number = |n: i64| Polynomial::constant(&Rational::from(n));
    assert_eq!(even, x.scaled(&Rational::from(3)).plus(&number(1)));
    assert_eq!(odd, x.plus(&number(3)));
}
