//! Values that determine their arguments.

use num_dual::DualNum;

use crate::random::draws;
use liouville::graph::{Expr, record};
use liouville::number::UnaryFunction;
use liouville::proof::Determination;
use liouville::proof::ProofRng;
use liouville::proof::Prover;

/// Whether the inputs after the first `constants` ones are determined by these values of them.
fn determined(inputs: usize, constants: usize, build: impl FnOnce(&[Expr]) -> Vec<Expr>) -> bool {
    let (graph, question) = record(inputs, |x| Determination {
        wanted: x[constants..].to_vec(),
        constants: x[..constants].to_vec(),
        given: build(x),
        ..Determination::default()
    })
    .expect("records");
    let prover = Prover { sources: &[], extents: &[], seed: 1 };
    prover.is_determined(&graph, &question).expect("within bounds")
}

fn abs(value: Expr) -> Expr {
    value.apply(UnaryFunction::Abs)
}

#[test]
fn maps_with_an_inverse_determine_their_arguments() {
    assert!(determined(3, 1, |x| vec![x[1] + x[0] * x[2], x[2]]), "a shear");
    let kick = |x: &[Expr]| x[2] + x[0] * x[1].sin();
    assert!(determined(3, 1, |x| vec![x[1] + kick(x), kick(x)]), "the standard map");
    let lozi = |x: &[Expr]| x[3] + 1.0 - x[0] * abs(x[2]);
    assert!(determined(4, 2, |x| vec![lozi(x), x[1] * x[2]]), "Lozi's map");
    assert!(determined(1, 0, |x| vec![(x[0] * 2.0 + 1.0) / (x[0] + 3.0)]), "Möbius");
    assert!(determined(1, 0, |x| vec![(x[0].exp() + 2.0).recip()]), "a function of e^x");
    assert!(determined(1, 0, |x| vec![x[0].sqrt() * 3.0]), "a root");
    let turned = |x: &[Expr]| {
        let (c, s) = ((x[0] * x[1]).cos(), (x[0] * x[1]).sin());
        vec![x[3] * c - x[2] * s, x[3] * s + x[2] * c, -x[1]]
    };
    assert!(determined(4, 1, turned), "a turn by an angle that is known");
    let kahan = |x: &[Expr]| {
        let below = Expr::from(1.0) - x[0] * x[0] * x[1] * x[2];
        vec![x[1] * (x[0] * x[2] + 1.0) / below, x[2] * (x[0] * x[1] + 1.0) / below]
    };
    assert!(determined(3, 1, kahan), "Kahan's map of x' = xy, y' = xy");
}

#[test]
fn maps_with_two_states_for_an_image_do_not() {
    assert!(!determined(1, 0, |x| vec![x[0] * x[0]]), "x²");
    assert!(!determined(1, 0, |x| vec![abs(x[0] - 1.0)]), "|x − 1|");
    assert!(!determined(1, 0, |x| vec![x[0] - x[0].recip()]), "x − 1/x");
    assert!(!determined(1, 0, |x| vec![x[0].sin()]), "sin x");
    assert!(!determined(1, 0, |x| vec![x[0] * abs(x[0]) + abs(x[0])]), "x|x| + |x|");
    assert!(!determined(2, 0, |x| vec![x[0] * x[1], x[0] + x[1]]), "xy, x + y");
    assert!(!determined(2, 0, |x| vec![x[0].sin(), x[1] + x[0]]), "sin x, x + y");
    let squares = |x: &[Expr]| x[0].sin() * x[0].sin() + x[0].cos() * x[0].cos() - 1.0;
    assert!(!determined(1, 0, |x| vec![squares(x) * x[0]]), "0 x, told by sines");
    assert!(!determined(2, 1, |x| vec![x[1] - x[1]]), "0");
}

/// Composes random invertible steps, and a fold if there is to be one.
#[test]
fn a_fold_is_never_overlooked() {
    let mut inverted = 0;
    for seed in 0..u64::from(draws(10)) {
        for fold in [None, Some(seed % 4)] {
            let mut rng = ProofRng::new(seed, 77);
            let mut draw = move || u64::from(rng.coin()) + 2 * u64::from(rng.coin());
            let found = determined(3, 1, |x| {
                let (a, mut v) = (x[0], [x[1], x[2]]);
                let at = draw() % 3;
                for step in 0..3 {
                    if step == at {
                        v[0] = match fold {
                            Some(0) => v[0] * v[0],
                            Some(1) => abs(v[0]) + v[0] * v[0] * abs(v[0]),
                            Some(2) => v[0] + v[0].recip(),
                            Some(_) => v[0].cos(),
                            None => v[0],
                        };
                    }
                    let shear = match draw() {
                        0 => a * v[0] * v[0],
                        1 => v[0].sin() * a,
                        2 => v[0].recip(),
                        _ => v[0] * 3.0 - a,
                    };
                    v = [v[1] + shear, v[0]];
                }
                v.to_vec()
            });
            match fold {
                None => inverted += u32::from(found),
                Some(_) => assert!(!found, "seed {seed} has no inverse"),
            }
        }
    }
    let all = draws(10);
    assert!(2 * inverted > all, "{inverted} of {all} inverses are found");
}
