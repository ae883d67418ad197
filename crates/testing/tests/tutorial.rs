//! The property test of docs/tutorial.md, as it stands there.

use liouville_testing::{VectorField, field, quantity, state};
use num_dual::DualNum;
use proptest::prelude::*;

/// Kovalevskaya's top: M, then γ.
fn top<T: DualNum<Primitive = f64> + Copy>(x: [T; 6]) -> [T; 6] {
    let [m1, m2, m3, g1, g2, g3] = x;
    let (w1, w2, w3) = (m1, m2, m3 * 2.0);
    [
        m2 * w3 - m3 * w2,
        m3 * w1 - m1 * w3 + g3,
        m1 * w2 - m2 * w1 - g2,
        g2 * w3 - g3 * w2,
        g3 * w1 - g1 * w3,
        g1 * w2 - g2 * w1,
    ]
}

fn integral<T: DualNum<Primitive = f64> + Copy>([m1, m2, _, g1, g2, _]: [T; 6]) -> T {
    let (a, b) = (m1 * m1 - m2 * m2 - g1 * 2.0, (m1 * m2 - g2) * 2.0);
    a * a + b * b
}

proptest! {
    #[test]
    fn the_integral_is_kept(x in state::<6>(-2.0..2.0)) {
        let top = field!(|x: [_; 6]| top(x));
        top.conserves(&quantity!(|x: [_; 6]| integral(x))).at(&x)?;
    }
}

#[test]
fn the_tutorial_shows_this_code() {
    let tutorial = include_str!("../../../docs/tutorial.md");
    let shown = tutorial.split("```rust\n").nth(1).and_then(|rest| rest.split("```").next());
    let own = include_str!("tutorial.rs");
    assert!(shown.is_some_and(|shown| own.contains(shown)), "the block and this file differ");
}
