//! Steps in many bits against known solutions: the ends are so accurate that they miss the truth
//! unless what the series leave out is bounded.

use super::number::{ReplayNumber, Wide};
use super::series::Script;
use super::short::Short;
use super::tails::{remainders, settled};
use crate::validated::plan::Plan;
use crate::validated::tests::{Random, plan};
use liouville::graph::Expr;
use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use num_dual::DualNum;

const ORDER: usize = 16;

/// Encloses the end of a step with tails of radius `rho`, in numbers of one kind.
fn end_in<X: ReplayNumber>(plan: &Plan, start: &[f64], h: f64, rho: f64) -> Option<Vec<X>> {
    let script = Script::new(plan, ORDER);
    let start: Vec<X> = start.iter().map(|x| X::exact(*x)).collect();
    let series = script.expand(&start);
    let h = X::exact(h);
    let rests = settled(&series, &h, rho)?;
    let ends = rests.iter().enumerate();
    Some(ends.map(|(row, rest)| series.polynomial(row, &h).plus(&X::within(rest))).collect())
}

/// Ends in balls of many bits, and in those of short integers.
fn end(plan: &Plan, start: &[f64], h: f64, rho: f64) -> Option<[Vec<Wide>; 2]> {
    let many = end_in::<Wide>(plan, start, h, rho);
    let short = end_in::<Short>(plan, start, h, rho);
    assert_eq!(many.is_some(), short.is_some(), "both or none");
    Some([many?, short?.iter().map(Short::wide).collect()])
}

/// Asserts that a number lies in an enclosure that is narrow, and outside of one that is somewhat
/// narrower than the truth allows.
fn assert_inside(found: &Wide, truth: &Wide, what: &str) {
    let gap = found.minus(truth).enclosure();
    assert!(gap.mid.abs() <= gap.rad, "{what}: off by {:e}, radius {:e}", gap.mid, gap.rad);
    assert!(gap.rad <= 1e-9, "{what}: wide, {gap:?}");
}

fn of(function: UnaryFunction) -> impl Fn(&Wide) -> Wide {
    move |x| x.apply(function)
}

#[test]
fn oscillators_are_enclosed() {
    let plan = plan(2, |x| vec![x[1], -x[0]]);
    let mut random = Random(3);
    for _ in 0..50 {
        let [x, y, h] = [(); 3].map(|()| random.between(0.1, 0.5));
        let found = end(&plan, &[x, y], h, 2.0).expect("entire");
        let (cos, sin) =
            (of(UnaryFunction::Cos)(&Wide::exact(h)), of(UnaryFunction::Sin)(&Wide::exact(h)));
        let (x, y) = (Wide::exact(x), Wide::exact(y));
        let truth = x.times(&cos).plus(&y.times(&sin));
        for found in found {
            assert_inside(&found[0], &truth, "position");
            assert_inside(&found[1], &y.times(&cos).minus(&x.times(&sin)), "velocity");
        }
    }
}

#[test]
fn integrals_of_all_functions_are_enclosed() {
    let third = Rational::new(1, 3);
    let plan = plan(10, |y| {
        let x = y[0];
        let one = Expr::rational(&Rational::from(1));
        vec![
            one,
            x.exp(),
            x.ln(),
            x.sin(),
            x.cos(),
            x.atan(),
            x.sqrt(),
            x.power(&third),
            x.recip(),
            (one + x * x).recip(),
        ]
    });
    let mut random = Random(5);
    for trial in 0..50 {
        let (a, h) = (random.between(0.8, 3.0), random.between(0.01, 0.08));
        let begin = Wide::exact(a);
        let stop = begin.plus(&Wide::exact(h));
        let change = |f: &dyn Fn(&Wide) -> Wide| f(&stop).minus(&f(&begin));
        let (one, half) = (Wide::exact(1.0), Wide::exact(0.5));
        let power =
            |x: &Wide, exponent: &Rational| x.power(exponent).times(&Wide::of(exponent).recip());
        let truth = [
            stop.clone(),
            change(&of(UnaryFunction::Exp)),
            change(&|x| x.times(&x.apply(UnaryFunction::Ln)).minus(x)),
            change(&|x| x.apply(UnaryFunction::Cos).neg()),
            change(&of(UnaryFunction::Sin)),
            change(&|x| {
                let rest = half.times(&one.plus(&x.times(x)).apply(UnaryFunction::Ln));
                x.times(&x.apply(UnaryFunction::Atan)).minus(&rest)
            }),
            change(&|x| power(x, &Rational::new(3, 2))),
            change(&|x| power(x, &Rational::new(4, 3))),
            change(&of(UnaryFunction::Ln)),
            change(&of(UnaryFunction::Atan)),
        ];
        let start: Vec<f64> = std::iter::once(a).chain([0.0; 9]).collect();
        let found = end(&plan, &start, h, 0.2).expect("within the radius of convergence");
        for found in found {
            for (row, (found, truth)) in found.iter().zip(&truth).enumerate() {
                assert_inside(found, truth, &format!("trial {trial}, row {row}"));
            }
        }
    }
}

#[test]
fn no_tail_reaches_beyond_a_pole() {
    // x = 1/(1 - t), with the radius of convergence 1.
    let plan = plan(1, |x| vec![x[0] * x[0]]);
    for (h, rho) in [(0.1, 1.0), (0.1, 1.5), (0.1, 100.0), (0.1, 0.1), (0.2, 0.1)] {
        assert!(end(&plan, &[1.0], h, rho).is_none(), "a step of {h} with the radius {rho}");
    }
    let found = end(&plan, &[1.0], 0.1, 0.4).expect("well inside");
    let truth = Wide::exact(1.0).minus(&Wide::exact(0.1)).recip();
    for found in found {
        assert_inside(&found[0], &truth, "the geometric series");
        // The remainder is t^17/(1 - t).
        assert!(found[0].enclosure().rad >= 0.1f64.powi(17), "no bound is below what is left out");
    }
    // A radius that is too large is made smaller, down to the step.
    let script = Script::new(&plan, ORDER);
    let series = script.expand(&[Wide::exact(1.0)]);
    let is_bounded = |h: f64, rho: f64| remainders(&series, &Wide::exact(h), rho).is_some();
    assert!(is_bounded(0.1, 1.5) && is_bounded(0.2, 0.9), "inside");
    assert!(!is_bounded(0.7, 1.5) && !is_bounded(1.5, 3.0) && !is_bounded(0.5, 0.4), "beyond");
}

#[test]
fn undefined_rows_have_no_tail() {
    for build in [
        |x: &[Expr]| vec![x[0].recip()],
        |x: &[Expr]| vec![(x[0] - x[0] * x[0]).sqrt()],
        |x: &[Expr]| vec![x[0].ln()],
    ] {
        assert!(end(&plan(1, build), &[0.0], 1e-3, 1e-2).is_none(), "no value at the start");
    }
}
