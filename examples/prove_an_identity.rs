//! Proves identities by computation in random prime fields.
//!
//! The left sides minus the right sides are recorded as a graph. The prover shows that a value is
//! zero, with a bound on the probability of an error; or that it is not; or it says why it knows
//! neither.
//!
//! ```sh
//! cargo run --example prove_an_identity
//! ```

use liouville::graph::{Expr, Fault, record};
use liouville::number::rational::Rational;
use liouville::proof::{Extent, Group, GroupOutcome, Prover};
use num_dual::DualNum;

/// Proves that a function of four variables, all between 1 and 2, is zero.
fn prove(statement: &str, build: impl FnOnce(&[Expr]) -> Expr) -> Result<(), Fault> {
    let (graph, difference) = record(4, build)?;
    let extents = vec![Extent::between(&Rational::from(1), &Rational::from(2)); 4];
    let prover = Prover { sources: &[], extents: &extents, seed: 1 };
    println!("{statement}");
    for outcome in prover.prove(&graph, &[Group::of(vec![difference])])? {
        match outcome {
            GroupOutcome::Zero(found) => println!(
                "  proved: 0 at {} points of {} prime fields, degree ≤ {}, error < 2^{:.0}",
                found.points, found.primes, found.degree, found.error_log2
            ),
            GroupOutcome::NonZero(_) => println!("  false: a value in a prime field is not 0"),
            GroupOutcome::Silent(reason) => println!("  not known: {reason}"),
            GroupOutcome::Partial => {
                println!("  the difference has no value on a part of the inputs")
            }
            GroupOutcome::Void => println!("  the difference has no value at all"),
        }
    }
    Ok(())
}

fn main() -> Result<(), Fault> {
    prove("(a² + b²)(c² + d²) = (ac − bd)² + (ad + bc)²", |x| {
        let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
        let right = (a * c - b * d).powi(2) + (a * d + b * c).powi(2);
        (a * a + b * b) * (c * c + d * d) - right
    })?;
    prove("(a² + b²)(c² + d²) = (ac + bd)² + (ad + bc)²", |x| {
        let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
        let right = (a * c + b * d).powi(2) + (a * d + b * c).powi(2);
        (a * a + b * b) * (c * c + d * d) - right
    })?;
    prove("√(a + b + 2√(ab)) = √a + √b", |x| {
        let [a, b] = [x[0], x[1]];
        ((a * b).sqrt() * 2.0 + a + b).sqrt() - a.sqrt() - b.sqrt()
    })?;
    prove("sin 2a = 2 sin a cos a", |x| {
        let a = x[0];
        (a * 2.0).sin() - a.sin() * a.cos() * 2.0
    })?;
    prove("ln ab = ln a + ln b", |x| {
        let [a, b] = [x[0], x[1]];
        (a * b).ln() - a.ln() - b.ln()
    })
}
