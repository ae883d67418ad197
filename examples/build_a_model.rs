//! Builds a system and its claims as Rust values, without a case file, and judges them.
//!
//! A charged particle in a uniform magnetic field keeps its energy and the centre of its circle;
//! the wrong centre is refuted. Formulas are made by operators from the names of the system.
//!
//! ```sh
//! cargo run --example build_a_model
//! ```

use std::error::Error;

use liouville::prelude::*;

fn main() -> Result<(), Box<dyn Error>> {
    // x' = v, v' = q B v × e₃ / m in the plane, for all charges, fields and masses in the ranges
    let names = Model::field()
        .title("Particle in a uniform magnetic field")
        .parameter("m", "0.5..2")
        .parameter("q", "0.5..2")
        .parameter("B", "0.5..2")
        .variable("x", "-2..2")
        .variable("y", "-2..2")
        .variable("u", "-2..2")
        .variable("v", "-2..2");
    let [m, q, b] = [names.formula("m")?, names.formula("q")?, names.formula("B")?];
    let x = names.formula("x")?;
    let [u, v] = [names.formula("u")?, names.formula("v")?];
    let turning = (&q * &b / &m)?;
    let case = names
        .rate("x", &u)
        .rate("y", &v)
        .rate("u", &turning * &v)
        .rate("v", -(&turning * &u)?)
        .build()?;

    let energy = (&m * (&u.raised(2)? + &v.raised(2)?)? / &Formula::number(2))?;
    let centre = (&x + (&v / &turning)?)?;
    let wrong = centre.substitute("B", &(-&b))?;
    let claims = [
        Claim::integral(&energy).named("energy"),
        Claim::integral(&centre).named("centre"),
        Claim::integral(&wrong).named("centre with the field reversed").expected(Expect::Fails),
        Claim::density(1).named("phase volume"),
        Claim::independent(vec![energy, centre]),
    ];
    let report = case.judge(&claims, &Options::default())?;
    println!("{}\n", case.title);
    for claim in &report.claims {
        let formula = claim.formula.as_deref().unwrap_or("");
        println!("{:<10} {} {formula}", claim.verdict.word(), claim.name);
    }
    match report.claims.iter().all(|claim| claim.agrees) {
        true => Ok(()),
        false => Err("a claim is against its expectation".into()),
    }
}
