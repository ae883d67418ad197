//! Values that are combinations of others.

use liouville::graph::{Expr, record};
use liouville::number::rational::Rational;
use liouville::proof::combinations;

fn found(build: impl FnOnce(&[Expr]) -> (Expr, Vec<Expr>)) -> Option<Vec<Rational>> {
    let mut count = 0;
    let (graph, all) = record(3, |inputs| {
        let (value, basis) = build(inputs);
        count = basis.len();
        [vec![value], basis].concat()
    })
    .expect("records");
    let all = combinations(&graph, &all[..1], &all[1..=count], 1).expect("within bounds")?;
    all.into_iter().next()
}

#[test]
fn multiples_are_found_and_proved() {
    let half = Rational::new(1, 2);
    let told = found(|x| (x[0] * x[1] * 0.5 - x[2] * 3.0, vec![x[0] * x[1], x[2]]));
    assert_eq!(told, Some(vec![half.clone(), Rational::from(-3)]), "xy/2 − 3z");
    let told = found(|x| (x[0] * x[1] * 0.5, vec![x[0] * x[1], x[1] * x[0] + x[2] * 0.0]));
    assert_eq!(told, Some(vec![half, Rational::from(0)]), "the same twice");
    assert_eq!(found(|x| (x[0] * x[1], vec![x[0], x[1]])), None, "xy");
    assert_eq!(found(|x| (x[0] + 1.0, vec![x[0]])), None, "x + 1");
    let none = found(|x| (x[0] - x[0], Vec::new()));
    assert_eq!(none, Some(Vec::new()), "0 is a sum of nothing");
}
