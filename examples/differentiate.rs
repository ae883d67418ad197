//! Records a function, differentiates it, and runs the derivative in f64 and in balls.
//!
//! f(x) = x − sin x has the derivative 1 − cos x, which cancels near 0. In f64 it becomes 0 there; a
//! ball shows how little is known, and whether the sign is certain.
//!
//! ```sh
//! cargo run --example differentiate
//! ```

use liouville::graph::{Evaluator, Fault, Tape, record};
use liouville::number::ball::{Ball, Balls};
use liouville::number::float::Float;
use num_dual::{Dual, DualNum};

/// Number of points that are computed side by side.
const LANES: usize = 4;

fn f<T: DualNum<Primitive = f64> + Copy>(x: T) -> T {
    x - x.sin()
}

fn main() -> Result<(), Fault> {
    // One run over recorded numbers gives the graph of the value and of the derivative.
    let (graph, outputs) = record(1, |input| {
        let value = f(Dual::from_re(input[0]).derivative());
        [value.re, value.eps]
    })?;
    let tape = Tape::new(&graph, &outputs[1..]);
    println!("f and f' together: {} operations", graph.operations(&outputs));
    println!("f' alone: {} operations\n", tape.operations());

    let points = [1.0, 1e-3, 1e-6, 1e-8];
    let mut in_f64 = Evaluator::new(&tape, Float::<LANES>);
    in_f64.run(&[points]);
    let mut in_balls = Evaluator::new(&tape, Ball::<LANES>);
    in_balls.run(&[Balls::new(points, [0.0; LANES])]);

    println!("{:>6}  {:>22}  {:>10}  sign", "x", "f'(x) in f64", "error <");
    let balls = in_balls.output(0);
    for (lane, x) in points.iter().enumerate() {
        let sign = if balls.excludes_zero(lane) { "certain" } else { "not known" };
        println!("{x:>6e}  {:>22e}  {:>10.1e}  {sign}", in_f64.output(0)[lane], balls.rad[lane]);
    }
    Ok(())
}
