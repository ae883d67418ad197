//! The examples of docs/soundness.md.

mod combinations;
mod determined;
mod nested;
mod presence;

use num_dual::DualNum;

use liouville::graph::{Expr, record};
use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;
use liouville::proof::{Extent, Group, GroupOutcome, Prover};
use liouville::scalar::Scalar;

/// Proves over inputs in 1..2, or in -2..-1 for the negative ones.
fn prove(negative: &[bool], build: impl FnOnce(&[Expr]) -> Expr) -> GroupOutcome {
    let (graph, value) = record(negative.len(), build).expect("records");
    let [one, two] = [1, 2].map(Rational::from);
    let extent = |negative: &bool| match negative {
        true => Extent::between(&-&two, &-&one),
        false => Extent::between(&one, &two),
    };
    let extents: Vec<Extent> = negative.iter().map(extent).collect();
    let prover = Prover { sources: &[], extents: &extents, seed: 1 };
    prover.prove(&graph, &[Group::of(vec![value])]).expect("records").remove(0)
}

fn is_proved(outcome: &GroupOutcome) -> bool {
    matches!(outcome, GroupOutcome::Zero(certificate) if certificate.error_log2 < -100.0)
}

fn number(text: &str) -> Expr {
    Expr::rational(&text.parse().expect("a number"))
}

#[test]
fn identities_are_proved_and_others_are_not() {
    let square = |x: &[Expr]| (x[0] + x[1]).powi(2);
    let right = |x: &[Expr]| x[0] * x[0] + x[0] * x[1] * 2.0 + x[1] * x[1];
    let outcome = prove(&[false, false], |x| square(x) - right(x));
    assert!(is_proved(&outcome), "(x + y)² = x² + 2xy + y²: {outcome:?}");
    let near = prove(&[false, false], |x| {
        square(x) - right(x) + x[0] * number("1/1267650600228229401496703205376")
    });
    assert!(near.is_nonzero(), "off by 2^-100 x");
}

#[test]
fn one_fixed_prime_would_be_fooled() {
    let outcome = prove(&[false], |x| x[0] * number("2305843009213693951"));
    assert!(outcome.is_nonzero(), "(2^61 - 1) x is not zero");
}

#[test]
fn degrees_beyond_the_bound_are_not_proved() {
    let outcome = prove(&[false], |x| {
        let mut power = x[0];
        for _ in 0..58 {
            power = power * power;
        }
        (power + 1.0) * (power - 1.0) - power * power + 1.0
    });
    assert!(matches!(&outcome, GroupOutcome::Silent(why) if why.contains("degree")), "{outcome:?}");
}

#[test]
fn independent_roots_are_certified() {
    let outcome = prove(&[false, false], |x| {
        let (a, b) = (x[0].sqrt(), x[1].sqrt());
        (a + b) * (a - b) - x[0] + x[1]
    });
    assert!(is_proved(&outcome), "(√x + √y)(√x - √y) = x - y: {outcome:?}");
    let GroupOutcome::Zero(certificate) = outcome else { unreachable!() };
    assert_eq!(certificate.roots, 2, "two roots");
    let outcome = prove(&[false, false], |x| x[0].sqrt() + x[1].sqrt() - (x[0] + x[1]).sqrt());
    assert!(outcome.is_nonzero(), "√x + √y is not √(x + y)");
}

#[test]
fn roots_of_squares_have_the_sign_of_the_base() {
    let binomial = |x: &[Expr]| {
        let sum = x[0] + x[1];
        (sum * sum).sqrt() - sum
    };
    let outcome = prove(&[false, false], binomial);
    assert!(is_proved(&outcome), "√((x + y)²) = x + y for x, y > 0: {outcome:?}");
    assert!(prove(&[true, true], binomial).is_nonzero(), "and not for x, y < 0");
    let GroupOutcome::NonZero(parts) = prove(&[true, false], binomial) else {
        panic!("x + y has both signs");
    };
    assert_eq!(parts.proper().map(<[_]>::len), Some(1), "it is not zero where x + y < 0");
    let single = |x: &[Expr]| (x[0] * x[0]).sqrt() - x[0];
    assert!(is_proved(&prove(&[false], single)), "√(x²) = x for x > 0");
    assert!(prove(&[true], single).is_nonzero(), "√(x²) = -x for x < 0");
}

#[test]
fn roots_that_depend_on_each_other_are_found() {
    let product = prove(&[false, false], |x| (x[0] * x[1]).sqrt() - x[0].sqrt() * x[1].sqrt());
    assert!(is_proved(&product), "√(xy) = √x √y for x, y > 0: {product:?}");
    let negative = prove(&[true, true], |x| (x[0] * x[1]).sqrt() - (-x[0]).sqrt() * (-x[1]).sqrt());
    assert!(is_proved(&negative), "√(xy) = √(-x) √(-y) for x, y < 0: {negative:?}");
    let scaled = prove(&[false], |x| (x[0] * x[0] * 4.0).sqrt() - x[0] * 2.0);
    assert!(is_proved(&scaled), "√(4x²) = 2x: {scaled:?}");
    let normed = prove(&[false, false], |x| {
        let length = (x[0] * x[0] + x[1] * x[1]).recip();
        let (c, s) = ((x[0] * x[0] - x[1] * x[1]) * length, x[0] * x[1] * length * 2.0);
        (c * c + s * s).sqrt() - 1.0
    });
    assert!(is_proved(&normed), "a point of the circle has length 1: {normed:?}");
}

#[test]
fn constant_roots_exist_modulo_the_primes() {
    let outcome = prove(&[false], |x| {
        let root = number("3").sqrt();
        (x[0] + root) * (x[0] - root) - x[0] * x[0] + 3.0
    });
    assert!(is_proved(&outcome), "(x + √3)(x - √3) = x² - 3: {outcome:?}");
    let outcome = prove(&[false], |x| (number("12/5").sqrt() - number("3/5").sqrt() * 2.0) * x[0]);
    assert!(is_proved(&outcome), "√(12/5) = 2√(3/5): {outcome:?}");
    let outcome = prove(&[false], |x| (number("2").sqrt() - number("1.41421356237")) * x[0]);
    assert!(outcome.is_nonzero(), "√2 is not 1.41421356237");
}

#[test]
fn moduli_are_tried_with_both_signs() {
    let square = prove(&[true], |x| x[0].modulus() * x[0].modulus() - x[0] * x[0]);
    assert!(is_proved(&square), "|x|² = x²: {square:?}");
    let sign = |x: &[Expr]| x[0].modulus() - x[0];
    assert!(is_proved(&prove(&[false], sign)), "|x| = x for x > 0");
    assert!(prove(&[true], sign).is_nonzero(), "but not for x < 0");
}

#[test]
fn roots_of_squares_are_moduli() {
    let both = prove(&[true, false], |x| {
        let sum = x[0] + x[1];
        (sum * sum).sqrt() - sum.modulus()
    });
    assert!(is_proved(&both), "√((x + y)²) = |x + y|, of either sign: {both:?}");
}

#[test]
fn rational_powers_obey_the_power_laws() {
    let power = |x: Expr, n: i64, d: i64| x.power(&Rational::new(n, d));
    let outcome = prove(&[false], |x| power(x[0], 1, 3) * power(x[0], 2, 3) - x[0]);
    assert!(is_proved(&outcome), "x^(1/3) x^(2/3) = x: {outcome:?}");
    let outcome = prove(&[false], |x| power(x[0], 1, 4) * power(x[0], 1, 4) - x[0].sqrt());
    assert!(is_proved(&outcome), "x^(1/4) x^(1/4) = √x: {outcome:?}");
    let outcome = prove(&[false], |x| power(x[0], 1, 3) - power(x[0], 1, 5));
    assert!(outcome.is_nonzero(), "x^(1/3) is not x^(1/5)");
}

#[test]
fn arguments_share_their_symbols() {
    let outcome = prove(&[false], |x| (x[0] * 2.0).exp() - x[0].exp() * x[0].exp());
    assert!(is_proved(&outcome), "exp(2x) = exp(x)²: {outcome:?}");
    let outcome = prove(&[false], |x| (x[0] * 2.0).sin() - x[0].sin() * x[0].cos() * 2.0);
    assert!(is_proved(&outcome), "sin 2φ = 2 sin φ cos φ: {outcome:?}");
    let outcome = prove(&[false, false], |x| {
        (x[0] + x[1]).cos() - x[0].cos() * x[1].cos() + x[0].sin() * x[1].sin()
    });
    assert!(is_proved(&outcome), "the addition theorem: {outcome:?}");
    // δ^(1/(2κ) - 1) and δ^((2κ - 1)/κ) of one base: the second is the first to the power -2.
    let outcome = prove(&[false, false], |x| {
        let (delta, kappa) = (x[0], x[1]);
        let first = delta.power_of((kappa * 2.0).recip() - 1.0);
        first * first * delta.power_of((kappa * 2.0 - 1.0) / kappa) - 1.0
    });
    assert!(is_proved(&outcome), "powers with symbolic exponents: {outcome:?}");
    let outcome = prove(&[false], |x| x[0].sin() - x[0].cos());
    assert!(matches!(outcome, GroupOutcome::Silent(_)), "not zero for symbols, which says nothing");
}

#[test]
fn quarter_turns_are_known() {
    // π/4 = atan 1
    let eighth = || Expr::rational(&Rational::from(1)).apply(UnaryFunction::Atan);
    let outcome = prove(&[false], |x| (eighth() * 4.0 - x[0]).sin() - x[0].sin());
    assert!(is_proved(&outcome), "sin(π − φ) = sin φ: {outcome:?}");
    let outcome = prove(&[false], |x| (x[0] - eighth() * 2.0).cos() - x[0].sin());
    assert!(is_proved(&outcome), "cos(φ − π/2) = sin φ: {outcome:?}");
    let outcome = prove(&[false], |x| ((eighth() * 12.0).cos() + 1.0) * x[0]);
    assert!(is_proved(&outcome), "cos 3π = −1: {outcome:?}");
    for wrong in [2.0, 6.0, 8.0] {
        let outcome = prove(&[false], |x| (eighth() * wrong - x[0]).sin() - x[0].sin());
        assert!(!is_proved(&outcome), "sin({wrong} π/4 − φ) is not sin φ: {outcome:?}");
    }
    let outcome = prove(&[false], |x| eighth().sin() * x[0] - eighth().cos() * x[0]);
    assert!(is_proved(&outcome), "sin π/4 = cos π/4: {outcome:?}");
    let outcome = prove(&[false], |x| (eighth() * 4.0 / 5.0).sin() * x[0] - x[0] / 2.0);
    assert!(matches!(outcome, GroupOutcome::Silent(_)), "sin π/5 is not written out: {outcome:?}");
    let outcome = prove(&[false], |x| {
        let (double, half) = (eighth() * 4.0 + x[0] * 2.0, x[0] - eighth() * 2.0);
        double.sin() - half.sin() * half.cos() * 2.0
    });
    assert!(is_proved(&outcome), "sin(2φ + π) = 2 sin(φ − π/2) cos(φ − π/2): {outcome:?}");
}

#[test]
fn a_value_that_never_exists_is_not_zero() {
    let outcome = prove(&[false], |x| {
        let zero = (x[0] + 1.0).powi(2) - x[0] * x[0] - x[0] * 2.0 - 1.0;
        zero.recip() * x[0]
    });
    assert!(matches!(outcome, GroupOutcome::Silent(_)), "1/0: {outcome:?}");
    let outcome = prove(&[false], |x| {
        let root = (-(x[0] * x[0])).sqrt();
        root - root * x[0] / x[0]
    });
    assert!(matches!(outcome, GroupOutcome::Void), "√(-x²): {outcome:?}");
}

#[test]
fn a_root_is_only_replaced_where_its_factors_are_real() {
    let build = |x: &[Expr]| {
        let [a, b, c] = [x[0] * x[1], x[1] * x[2], x[2] * x[0]].map(|product| product.sqrt());
        let roots = x[0].sqrt() + x[1].sqrt() + x[2].sqrt();
        // Both are true for positive x, and the second is false for negative ones.
        let product = a * b * c - x[0] * x[1] * x[2];
        [vec![product * roots], vec![product]].map(Group::of)
    };
    let (graph, groups) = record(3, build).expect("records");
    let number = |n: i64| Rational::from(n);
    for (low, is_true) in [(0, true), (-1, false)] {
        let extents = [Extent::between(&number(low), &number(1)); 3];
        let prover = Prover { sources: &[], extents: &extents, seed: 1 };
        let outcomes = prover.prove(&graph, &groups).expect("records");
        assert!(is_proved(&outcomes[0]), "√(xy) = √x √y where √x is real: {:?}", outcomes[0]);
        assert_eq!(is_proved(&outcomes[1]), is_true, "from {low} on: {:?}", outcomes[1]);
    }
}

/// Proves over inputs in -2..2.
fn prove_anywhere(inputs: usize, build: impl FnOnce(&[Expr]) -> Expr) -> GroupOutcome {
    let (graph, value) = record(inputs, build).expect("records");
    let two = Rational::from(2);
    let extents = vec![Extent::between(&-&two, &two); inputs];
    let prover = Prover { sources: &[], extents: &extents, seed: 1 };
    prover.prove(&graph, &[Group::of(vec![value])]).expect("records").remove(0)
}

#[test]
fn a_sign_is_not_taken_from_a_product() {
    let outcome = prove_anywhere(2, |x| {
        let root = (x[0] * (x[1] + x[1].modulus()).modulus()).sqrt();
        x[0].modulus() + root - x[0] - root
    });
    assert!(outcome.is_nonzero(), "for y < 0 the root is 0 for all x: {outcome:?}");
}

#[test]
fn independence_is_that_of_the_true_roots() {
    let sum = |x: &[Expr]| x[0] * x[0] + x[0] * 2.0 + 1.0;
    let outcome =
        prove(&[false, false], |x| (x[1] + sum(x).sqrt()).sqrt() - (x[1] + x[0] + 1.0).sqrt());
    assert!(is_proved(&outcome), "√(y + √(x² + 2x + 1)) = √(y + x + 1): {outcome:?}");
    let outcome = prove(&[false, false], |x| {
        let nested = (x[0] + 1.0 + x[0].sqrt() * 2.0).sqrt();
        (x[1] + nested).sqrt() - (x[1] + x[0].sqrt() + 1.0).sqrt()
    });
    assert!(is_proved(&outcome), "√(x + 1 + 2√x) = √x + 1: {outcome:?}");
    let outcome = prove(&[false], |x| {
        let nested = (number("3") - number("2").sqrt() * 2.0).sqrt();
        (x[0] + nested).sqrt() - (x[0] + number("2").sqrt() - 1.0).sqrt()
    });
    assert!(is_proved(&outcome), "√(3 − 2√2) = √2 − 1: {outcome:?}");
    let outcome = prove(&[false], |x| {
        let nested = (number("5") - number("6").sqrt() * 2.0).sqrt();
        (x[0] + nested).sqrt() - (x[0] + number("3").sqrt() - number("2").sqrt()).sqrt()
    });
    assert!(is_proved(&outcome), "√(5 − 2√6) = √3 − √2: {outcome:?}");
    let wrong = prove(&[false], |x| {
        let nested = (number("5") - number("6").sqrt() * 2.0).sqrt();
        (x[0] + nested).sqrt() - (x[0] + number("2").sqrt() - number("3").sqrt()).sqrt()
    });
    assert!(wrong.is_nonzero(), "and not √2 − √3: {wrong:?}");
}

#[test]
fn what_vanishes_on_a_cell_is_put_in() {
    let outcome = prove_anywhere(1, |x| {
        let sum = x[0] + x[0].modulus();
        (sum * sum + x[0]).sqrt() - (x[0] * x[0] * 4.0 + x[0]).sqrt()
    });
    assert!(is_proved(&outcome), "√((y + |y|)² + y) = √(4y² + y): {outcome:?}");
    let outcome = prove_anywhere(2, |x| {
        let largest = (x[1] + 2.0 + (number("2") - x[1]).modulus()) * 0.5;
        (x[0] * x[0] + largest).sqrt() - (x[0] * x[0] + 2.0).sqrt()
    });
    assert!(is_proved(&outcome), "max(2, z) = 2 for z < 2: {outcome:?}");
}

#[test]
fn powers_of_one_base_share_a_root() {
    let power = |x: Expr, n: i64, d: i64| x.power(&Rational::new(n, d));
    for (a, b, c) in [((1, 4), (3, 4), (1, 1)), ((5, 6), (1, 6), (1, 1)), ((1, 8), (3, 8), (1, 2))]
    {
        let outcome = prove(&[false], |x| {
            power(x[0], a.0, a.1) * power(x[0], b.0, b.1) - power(x[0], c.0, c.1)
        });
        assert!(is_proved(&outcome), "x^{a:?} x^{b:?} = x^{c:?}: {outcome:?}");
    }
    let outcome = prove(&[false, false], |x| {
        power(x[0] * x[1], 1, 4) - power(x[0], 1, 4) * power(x[1], 1, 4)
    });
    assert!(is_proved(&outcome), "(xy)^(1/4) = x^(1/4) y^(1/4): {outcome:?}");
    let outcome = prove(&[false], |x| power(x[0], 1, 4) - power(x[0], 1, 2));
    assert!(outcome.is_nonzero(), "x^(1/4) is not √x: {outcome:?}");
    let outcome = prove(&[false], |x| (x[0].sqrt() * x[0]).sqrt() - power(x[0], 3, 4));
    assert!(is_proved(&outcome), "√(x√x) = x^(3/4): {outcome:?}");
}

#[test]
fn roots_of_constants_factor_out() {
    let outcome =
        prove(&[false], |x| (x[0] * number("1/5")).sqrt() - x[0].sqrt() / number("5").sqrt());
    assert!(is_proved(&outcome), "√(x/5) = √x/√5: {outcome:?}");
    let large = "100000000000000000000000000000000000133";
    let outcome =
        prove(&[false], |x| (x[0] * number(large)).sqrt() - x[0].sqrt() * number(large).sqrt());
    assert!(is_proved(&outcome), "no constant has to be factored: {outcome:?}");
}

#[test]
fn many_roots_are_one_proof() {
    // Σ √(x_i + y)² over 30 roots, and one with another sign.
    let all = |flipped: bool| {
        prove(&[false; 31], |x| {
            let roots: Vec<Expr> = x[..30].iter().map(|x_i| (*x_i + x[30]).sqrt()).collect();
            let sum: Expr = roots.iter().copied().sum();
            let products: Expr = roots.iter().map(|root| sum * *root).sum();
            let last = if flipped { roots[17] } else { Expr::rational(&Rational::from(0)) };
            products - sum * sum + last
        })
    };
    assert!(is_proved(&all(false)), "(Σ √)² = Σ √ Σ √: {:?}", all(false));
    assert!(all(true).is_nonzero(), "and with a root more it is not");
}

#[test]
fn products_of_nested_roots_are_found() {
    let outcome = prove(&[false, false], |x| {
        // y + 9 exceeds √x, so that all values are real.
        let (y, root) = (x[1] + 9.0, x[0].sqrt());
        (y + root).sqrt() * (y - root).sqrt() - (y * y - x[0]).sqrt()
    });
    assert!(is_proved(&outcome), "√(y + √x) √(y − √x) = √(y² − x): {outcome:?}");
}

#[test]
fn radicands_that_are_even_in_a_root_are_compared() {
    // y²/x - a² with a = (x + y + 1)^64, which is too large to be expanded.
    let root = |x: &[Expr]| {
        let a = (0..6).fold(x[0] + x[1] + 1.0, |a, _| a * a);
        (x[1] / x[0].sqrt(), a)
    };
    let first = |x: &[Expr]| ((root(x).0 + root(x).1) * (root(x).0 - root(x).1)).sqrt();
    let second = |x: &[Expr]| {
        let (b, a) = root(x);
        ((b * x[1] - a * x[1]) * (a + b) / x[1]).sqrt()
    };
    let outcome = prove_anywhere(2, |x| first(x) - second(x));
    assert!(is_proved(&outcome), "both are √(y²/x - a²): {outcome:?}");
    let outcome = prove_anywhere(2, |x| first(x) - second(x) * x[1]);
    assert!(outcome.is_nonzero(), "{outcome:?}");
    // -s² is a square over F_p(i), and so is its root's product with s.
    let outcome = prove_anywhere(2, |x| {
        let (b, a) = root(x);
        let s = (a + b) * (b - a);
        (-(s * s)).sqrt() - s
    });
    assert!(!is_proved(&outcome) && !outcome.is_nonzero(), "√(-s²) has no value: {outcome:?}");
}

#[test]
fn nothing_holds_where_nothing_is_real() {
    let outcome = prove(&[false, false], |x| {
        let root = (-(x[0] * x[0]) - x[1] * x[1]).sqrt();
        root - x[0]
    });
    assert!(matches!(outcome, GroupOutcome::Void), "−x² − y² has no root: {outcome:?}");
    let outcome = prove(&[false], |x| number("-3").sqrt() * x[0]);
    assert!(
        matches!(outcome, GroupOutcome::Void | GroupOutcome::Silent(_)),
        "nor has −3: {outcome:?}"
    );
}
