//! Follows the motion of a case and writes it as CSV: time, state, and the drift of an integral.
//!
//! The top turns about its middle axis and tumbles. The steps of the series are chosen inside; the
//! example asks for a point every half unit of time. The drift since the beginning is an error.
//!
//! ```sh
//! cargo run -p liouville-flow --example orbit_to_csv > top.csv
//! ```

use std::error::Error;

use liouville::case::Case;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;
use liouville_flow::{Precision, Start, orbit, value_at};

const CASE: &str = r#"
title  = "Euler's top"
system = "field"

[state]
p = "-2..2"
q = "-2..2"
r = "-2..2"

[field]
"p'" = "−q*r"
"q'" = "r*p"
"r'" = "−p*q/3"

[[claim]]
integral = "p² + 2*q² + 3*r²"
"#;

const POINTS: u32 = 60;

fn main() -> Result<(), Box<dyn Error>> {
    let case = Case::parse(CASE, &[])?;
    let integral = case.claims[0].kind.formula().ok_or("the claim has a formula")?;
    let state: [Rational; 3] = ["1/1000".parse()?, Rational::from(1), Rational::from(0)];
    let mut start = Start::new(&case, Some(&state), 1, 0)?;
    let value = |start: &Start| {
        value_at(&case.model, integral, &start.parameters, &start.state).map(|value| value[0])
    };
    let first = value(&start)?;
    let step = DoubleDouble::from_f64(0.5);

    println!("t,p,q,r,drift");
    for point in 0..=POINTS {
        let time = f64::from(point) * step.hi;
        let state: Vec<String> = start.state.iter().map(|x| format!("{:.12}", x.hi)).collect();
        println!("{time},{},{:.1e}", state.join(","), (value(&start)? - first).hi);
        start.state = orbit(&case, start.clone(), step, Precision::Float)?.end;
    }
    Ok(())
}
