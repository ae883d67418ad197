use num_dual::Dual;

use crate::graph::{Evaluator, Expr, Graph, Tape, record};
use crate::number::float::Float;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Values with every kind of node, in three variables and a parameter.
fn values<T: Scalar>(x: &[T]) -> Vec<T> {
    let [x, y, z, k] = [x[0], x[1], x[2], x[3]];
    let third = Rational::new(1, 3);
    let powers = x.power(&third) * y.power_of(z) - k.power_of(x);
    let roots = (x * x + y).sqrt() / (z + k) + (y - x * x * x).modulus();
    let waves = (x * y).sin() * z.cos() + (k * z).atan() - (x.ln() * z.exp()).recip();
    vec![powers * roots, roots - waves * waves, waves / powers, k * k, y]
}

fn at(graph: &Graph, outputs: &[Expr]) -> Vec<f64> {
    let tape = Tape::new(graph, outputs);
    let mut evaluator = Evaluator::new(&tape, Float::<1>);
    evaluator.run(&[[0.7], [1.3], [0.4], [1.9]]);
    evaluator.outputs().map(|block| block[0]).collect()
}

fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "as many derivatives as expected");
    for (found, expected) in found.iter().zip(expected) {
        let scale = expected.abs().max(1.0);
        assert!((found - expected).abs() < 1e-12 * scale, "{found} for {expected}");
    }
}

#[test]
fn sweeps_agree_with_dual_numbers() {
    let direction = [2, -1, 3].map(Rational::from);
    let (graph, (found, expected)) = record(4, |x| {
        let seeded = |seeds: [Expr; 3]| -> Vec<Expr> {
            let lifted: Vec<Dual<Expr>> = (0..4)
                .map(|i| Dual::new(x[i], seeds.get(i).copied().unwrap_or(Expr::from(0.0))))
                .collect();
            values(&lifted).iter().map(|value| value.eps).collect()
        };
        let own = values(x);
        let rows = Expr::gradients_of(&own, &x[..3]).expect("the variables are inputs");
        let mut found = Vec::new();
        for row in &rows {
            let entry = |i: usize| row.iter().find(|(place, _)| *place == i);
            found.extend((0..3).map(|i| entry(i).map_or(Expr::from(0.0), |(_, e)| *e)));
        }
        let along = direction.each_ref().map(Expr::rational);
        found.extend(Expr::derivatives_along(&own, &x[..3], &along).expect("as above"));
        found.extend(Expr::diagonal_of(&own[..3], &x[..3]).expect("as above"));
        let unit = |i: usize| std::array::from_fn(|j| Expr::from(f64::from(u8::from(i == j))));
        let columns: Vec<Vec<Expr>> = (0..3).map(|i| seeded(unit(i))).collect();
        let entries = (0..own.len()).flat_map(|k| columns.iter().map(move |c| c[k]));
        let mut expected: Vec<Expr> = entries.collect();
        expected.extend(seeded(along));
        expected.extend((0..3).map(|i| columns[i][i]));
        (found, expected)
    })
    .expect("records");
    close(&at(&graph, &found), &at(&graph, &expected));
}

#[test]
fn a_gradient_costs_what_its_value_costs() {
    let (graph, ()) = record(500, |x| {
        let energy = x.windows(2).map(|pair| (pair[0] - pair[1]) * (pair[0] - pair[1])).sum();
        let rows = Expr::gradients_of(&[energy], x).expect("the variables are inputs");
        assert_eq!(rows[0].len(), 500, "each variable has a slope");
    })
    .expect("records");
    assert!(graph.len() < 500 * 10, "{} nodes for 500 variables", graph.len());
}

#[test]
fn only_inputs_are_variables() {
    record(2, |x| {
        assert!(Expr::gradients_of(&[x[0]], &[x[0] * x[1]]).is_none(), "a product is none");
        assert!(Expr::gradients_of(&[x[0]], &[x[0], x[0]]).is_none(), "each once");
        let unknown = Expr::antiderivative(x[0], x[1]);
        assert!(Expr::gradients_of(&[unknown], x).is_none(), "it depends on x[1] unseen");
    })
    .expect("records");
}
