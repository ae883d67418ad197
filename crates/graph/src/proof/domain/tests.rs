//! Tests of regions: signs, emptiness and points.

use num_dual::DualNum;

use super::*;
use crate::graph::{Evaluator, Expr, Tape, record};
use crate::number::float::Float;
use crate::number::prime::Modulus;
use crate::number::rational::Rational;
use crate::proof::ProofRng;
use crate::scalar::Scalar;

/// Finds the sign over all inputs between these ends, where some values are not negative.
fn sign_where(
    ends: &[(i64, i64)],
    build: impl FnOnce(&[Expr]) -> (Expr, Vec<Expr>),
) -> Option<bool> {
    let (graph, (value, facts)) = record(ends.len(), build).expect("records");
    let end = |n: i64| Rational::from(n);
    let inputs: Vec<Extent> =
        ends.iter().map(|(low, high)| Extent::between(&end(*low), &end(*high))).collect();
    let facts: Vec<(usize, SignFact)> =
        facts.into_iter().map(|fact| (graph.place(fact), SignFact::NotNegative)).collect();
    let classes = Classes::default();
    let region = Region { graph: &graph, inputs: &inputs, facts: &facts, classes: &classes };
    region.sign(graph.place(value))
}

fn sign_of(ends: &[(i64, i64)], build: impl FnOnce(&[Expr]) -> Expr) -> Option<bool> {
    sign_where(ends, |x| (build(x), Vec::new()))
}

fn number(text: &str) -> Expr {
    Expr::rational(&text.parse().expect("a number"))
}

#[test]
fn a_sign_is_known_over_the_whole_box() {
    assert_eq!(sign_of(&[(1, 2)], |x| x[0]), Some(true));
    assert_eq!(sign_of(&[(-2, -1)], |x| x[0]), Some(false));
    assert_eq!(sign_of(&[(-2, 2)], |x| x[0] - number("1.9999999999")), None, "at the end");
    assert_eq!(sign_of(&[(0, 2)], |x| x[0]), Some(true), "0 goes with either sign");
    assert_eq!(sign_of(&[(1, 2), (3, 4)], |x| x[0] - x[1]), Some(false));
}

#[test]
fn squares_and_roots_are_positive() {
    assert_eq!(sign_of(&[], |_| Expr::input() * number("2")), None, "any number");
    assert_eq!(sign_of(&[(-2, 2)], |x| x[0] * x[0]), Some(true));
    assert_eq!(sign_of(&[(-2, 2)], |x| (x[0] * x[0] + 1.0).recip()), Some(true));
    assert_eq!(sign_of(&[(-2, 2)], |x| x[0].exp() * x[0].sqrt()), Some(true));
    assert_eq!(sign_of(&[(-2, 2)], |x| -x[0].modulus()), Some(false));
    assert_eq!(sign_of(&[(-2, -1)], |x| x[0].sqrt()), None, "there is no such value");
}

#[test]
fn parts_tell_what_the_whole_hides() {
    let parabola = |x: &[Expr]| x[0] * x[0] - x[0] + 1.0;
    assert_eq!(sign_of(&[(-2, 2)], parabola), Some(true), "x² − x + 1 > 0");
    let touching = |x: &[Expr]| x[0] * x[0] - x[0] + number("0.24");
    assert_eq!(sign_of(&[(-2, 2)], touching), None, "x² − x + 0.24 has two zeros");
}

#[test]
fn facts_decide_signs() {
    let quotient = |x: &[Expr]| -(x[0] * x[1].recip());
    let factor = |x: &[Expr]| (x[1], vec![quotient(x)]);
    assert_eq!(sign_where(&[(-2, -1)], |x| (x[0].recip(), Vec::new())), Some(false));
    assert_eq!(sign_where(&[(-2, -1), (-9, 9)], |x| (x[1], Vec::new())), None, "any number");
    assert_eq!(sign_where(&[(-2, -1), (-9, 9)], factor), Some(true), "−x/y > 0 for x < 0");
    let sum = |x: &[Expr]| (x[0] + x[1], vec![x[0] - 1.0, x[1]]);
    assert_eq!(sign_where(&[(-9, 9), (-9, 9)], sum), Some(true), "x ≥ 1, y ≥ 0");
}

#[test]
fn a_product_says_nothing_of_a_factor_whose_other_may_vanish() {
    let build = |x: &[Expr]| {
        let other = x[1] + x[1].modulus();
        (x[0], vec![x[0] * other.modulus()])
    };
    assert_eq!(sign_where(&[(-2, 2), (-2, 2)], build), None, "y + |y| = 0 for y < 0");
}

#[test]
fn contradictions_are_seen() {
    let (graph, facts) = record(2, |x| [x[0] - x[1], x[1] - x[0] - 1.0]).expect("records");
    let inputs = [Extent::between(&Rational::from(0), &Rational::from(1)); 2];
    let facts = facts.map(|fact| (graph.place(fact), SignFact::Positive));
    let classes = Classes::default();
    let region = Region { graph: &graph, inputs: &inputs, facts: &facts, classes: &classes };
    assert!(region.is_empty(), "x > y and y > x + 1");
    let one = &facts[..1];
    let region = Region { graph: &graph, inputs: &inputs, facts: one, classes: &classes };
    assert!(!region.is_empty(), "x > y alone");
    let inside = point(&graph, &inputs, &[graph.at(facts[0].0)]).expect("a point");
    assert!(inside[0] > inside[1], "{inside:?}");
}

#[test]
fn numbers_beyond_f64_have_no_sign_by_accident() {
    let power = |x: &[Expr]| -(x[0].powi(1_000_000) - 1.0);
    assert_eq!(sign_of(&[(0, 2)], power), None, "1 − x^1000000 has both signs");
    assert_eq!(sign_of(&[(2, 3)], power), Some(false));
}

#[test]
fn common_zeros_contradict_facts_at_sight() {
    // q − p = 0 and |q − p|² = 1 in ℝ³
    let build = |x: &[Expr], length: f64| {
        let differences = [0, 1, 2].map(|k| x[k + 3] - x[k]);
        let square = differences.iter().fold(Expr::from(0.0), |sum, own| sum + *own * *own);
        (differences, [square - length, -(square - length)])
    };
    let inputs = [Extent::between(&Rational::from(-2), &Rational::from(2)); 6];
    let (graph, (values, facts)) = record(6, |x| build(x, 1.0)).expect("records");
    assert!(is_seen_nowhere_zero(&graph, &inputs, &facts, &values, 8), "|q − p| = 1");
    assert!(!is_seen_nowhere_zero(&graph, &inputs, &facts, &values[..2], 8), "the third is ±1");
    let (graph, (values, facts)) = record(6, |x| build(x, 0.0)).expect("records");
    assert!(!is_seen_nowhere_zero(&graph, &inputs, &facts, &values, 8), "q = p");
}

/// Whether intervals show that two values are never positive together, for x and y between −3 and 3.
fn exclude_each_other(build: impl FnOnce(&[Expr]) -> [Expr; 2]) -> bool {
    let (graph, values) = record(2, build).expect("records");
    let inputs = [Extent::between(&Rational::from(-3), &Rational::from(3)); 2];
    let facts = values.map(|value| (graph.place(value), SignFact::Positive));
    let classes = Classes::default();
    Region { graph: &graph, inputs: &inputs, facts: &facts, classes: &classes }.is_empty()
}

#[test]
fn signs_of_functions_follow_from_those_of_their_arguments() {
    assert!(exclude_each_other(|x| [x[0], -x[0].sinh()]));
    assert!(!exclude_each_other(|x| [x[0], x[0].sinh()]));
    assert!(exclude_each_other(|x| [-x[0], x[0].tanh() * x[1].exp()]));
    assert!(!exclude_each_other(|x| [-x[0], x[0].tanh() * x[1]]), "for y < 0");
    assert!(exclude_each_other(|x| [x[0] - x[1], x[1].sqrt() - x[0].sqrt()]));
    assert!(!exclude_each_other(|x| [x[0] - x[1], x[1].powi(2) - x[0].powi(2)]), "0 > x > y");
    assert!(!exclude_each_other(|x| [x[0] - x[1], x[0].recip() - x[1].recip()]), "x > 0 > y");
    assert!(exclude_each_other(|x| [x[0] - x[1], x[1].exp() - x[0].exp()]));
    assert!(exclude_each_other(|x| [-x[0], x[0].atan()]));
    assert!(exclude_each_other(|x| [-x[0], x[0].sin()]), "|x| ≤ 3 < π");
    assert!(!exclude_each_other(|x| [-x[0], (x[0] * whole(2)).sin()]), "2x = −4");
    assert!(exclude_each_other(|x| [x[0] - 1.0, -x[0].ln()]));
    assert!(!exclude_each_other(|x| [x[0] - 0.5, -x[0].ln()]), "x = 3/4");
}

fn whole(n: i64) -> Expr {
    Expr::rational(&Rational::from(n))
}

#[test]
fn no_region_with_a_point_is_called_empty() {
    const POINTS: usize = 41;
    let (mut empty, modulus) = (0, Modulus::new((1 << 61) - 1));
    for seed in 0..600 {
        let mut rng = ProofRng::new(seed, 0);
        let mut draw = |n: usize| (rng.element(&modulus) % n as u64) as usize;
        let choices: [usize; 10] = std::array::from_fn(|_| draw(840));
        let build = |x: &[Expr]| {
            let argument = |k: usize| match k % 8 {
                0 | 1 => x[0],
                2 => x[1],
                3 => -x[0],
                4 => x[0] * whole(2),
                5 => x[1] * whole(-3),
                6 => x[0] + x[1],
                _ => whole(1),
            };
            let function = |k: usize, p: Expr| match k % 9 {
                0 => p.exp(),
                1 => p.atan(),
                2 => p.ln(),
                3 => p.sqrt(),
                4 => p.powi(3),
                5 => p.powi(2),
                6 => p.recip(),
                7 => p.sin(),
                _ => p,
            };
            let value = |own: &[usize]| {
                let (p, q) = (argument(own[0]), argument(own[1]));
                let difference = match own[2] % 3 {
                    0 => function(own[3], p),
                    _ => function(own[3], p) - function(own[3], q),
                };
                let scaled = match own[4] % 4 {
                    0 => difference * x[1].exp(),
                    1 => difference * x[1],
                    _ => difference,
                };
                if own[4] % 7 < 3 { scaled } else { -scaled }
            };
            let plain = [argument(choices[0]), argument(choices[1])];
            let first = match choices[2] % 3 {
                0 => plain[0],
                1 => plain[0] - plain[1],
                _ => value(&choices[..5]),
            };
            [if choices[3].is_multiple_of(2) { first } else { -first }, value(&choices[5..])]
        };
        if !exclude_each_other(build) {
            continue;
        }
        empty += 1;
        let (graph, values) = record(2, build).expect("records");
        let tape = Tape::new(&graph, &values);
        let mut evaluator = Evaluator::new(&tape, Float::<1>);
        for point in 0..POINTS * POINTS {
            let at = |k: usize| k as f64 * 6.0 / (POINTS - 1) as f64 - 3.0;
            evaluator.run(&[[at(point % POINTS)], [at(point / POINTS)]]);
            let both: Vec<f64> = evaluator.outputs().map(|block| block[0]).collect();
            let are_positive = both.iter().all(|value| *value > 1e-9);
            assert!(!are_positive, "seed {seed}: {both:?}");
        }
    }
    assert!(empty > 60, "{empty} regions are empty");
}
