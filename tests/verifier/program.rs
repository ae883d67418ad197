//! A case as a program: its graph, with the names of inputs and functions.

use liouville::case::Case;
use liouville::graph::{Evaluator, Tape};
use liouville::number::float::Float;
use liouville::program::{FunctionSubject, Program};

#[test]
fn inputs_and_functions_are_named() {
    let case = Case::parse(
        "title = 't'\n[parameters]\nk = '1..2'\n[state]\nx = '-2..2'\n\
         omega = 'vector(-1..1)'\n[field]\n\"x'\" = 'k*x'\n\"omega'\" = 'x*ω'\n\
         [[claim]]\nname = 'F'\nintegral = 'ln(x)'\n",
        &[],
    )
    .unwrap_or_else(|error| panic!("{error}"));
    let program = Program::of(&case, |_| true).expect("records");
    let names: Vec<String> = program.components().into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["k", "x", "ω1", "ω2", "ω3"], "in the order of the graph");
    let parts: Vec<FunctionSubject> = program.functions.iter().map(|own| own.part).collect();
    assert_eq!(
        parts,
        [FunctionSubject::Field, FunctionSubject::Value(0), FunctionSubject::Residual(0)],
        "no empty level"
    );
    let tape = Tape::new(&program.graph, &program.functions[0].outputs);
    let mut evaluator = Evaluator::new(&tape, Float::<1>);
    evaluator.run(&[[2.0], [3.0], [1.0], [0.0], [-1.0]]);
    let field: Vec<f64> = evaluator.outputs().map(|block| block[0]).collect();
    assert_eq!(field, [6.0, 3.0, 0.0, -3.0], "k x, x ω");
    let none = Program::of(&case, |_| false).expect("records");
    assert_eq!(none.functions.len(), 1, "the field alone");
}
