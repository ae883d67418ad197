//! Judges the claims of a case and prints each verdict with its evidence.
//!
//! Volterra's populations have an integral and a density; a sign is wrong in the second claim, and
//! the state at which it fails is printed in exact numbers.
//!
//! ```sh
//! cargo run --example judge_a_case
//! ```

use std::error::Error;

use liouville::case::Case;
use liouville::verdict::{Options, judge};

const CASE: &str = r#"
title  = "Predators and prey"
system = "field"

[parameters]
a = "0.5..2"
b = "0.5..2"

[state]
x = "0.5..3"
y = "0.5..3"

[field]
"x'" = "a*x − x*y"
"y'" = "x*y − b*y"

[[claim]]
integral = "x − b*log(x) + y − a*log(y)"

[[claim]]
integral = "x − b*log(x) − y + a*log(y)"
expect   = "fails"

[[claim]]
density = "1/(x*y)"
"#;

fn main() -> Result<(), Box<dyn Error>> {
    let case = Case::parse(CASE, &[])?;
    let report = judge(&case, &Options::default())?;
    println!("{}\n", case.title);
    for claim in &report.claims {
        let formula = claim.formula.as_deref().unwrap_or(&claim.name);
        println!("{} {formula}: {}", claim.kind, claim.verdict.word());
        let evidence = &claim.evidence;
        for rung in &evidence.climb {
            println!("  {}: {}", rung.rung, rung.found);
        }
        if !evidence.holds.is_empty() {
            let places: Vec<String> = evidence.holds.iter().map(ToString::to_string).collect();
            println!("  holds: {}", places.join(", "));
        }
        if let Some(witness) = &evidence.witness {
            let drawn = witness.parameters.iter().map(|(name, value)| format!("{name} = {value}"));
            println!("  parameters: {}", drawn.collect::<Vec<_>>().join(", "));
            println!("  state: {}", witness.state);
            println!("  residual: {:e} ± {:e}", witness.residual, witness.error_bound);
        }
        println!();
    }
    Ok(())
}
