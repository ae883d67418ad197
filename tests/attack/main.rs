//! Random claims of known truth, on which no verdict may be wrong.
//!
//! Scenes and claims are grown, rewritten and spoilt by a separate generator; their truth is found
//! by an oracle that shares nothing with the verifier: floats of 640 bits with an independent
//! notion of definedness, at states in every cell of signs that it finds. A wrong verdict is shrunk
//! and printed as a file, with the variables that reproduce it.
//!
//! | variable | |
//! |---|---|
//! | `LIOUVILLE_ATTACK=1000000` | number of cases, instead of 2 600 with some 3 200 claims |
//! | `LIOUVILLE_ATTACK_SEED=7` | seed of the cases |
//! | `LIOUVILLE_ATTACK_FIRST=250000` | index of the first case, to run a seed in pieces |
//! | `LIOUVILLE_ATTACK_ONLY=123,456` | indices of single cases |
//! | `LIOUVILLE_ATTACK_SHOW=10` | number of wrong verdicts shown for each class |

use std::process::ExitCode;

use libtest_mimic::{Arguments, Failed, Trial};

mod branching;
mod claim;
mod derive;
mod draw;
mod expr;
mod float;
mod flow;
mod grow;
mod hint;
mod interval;
mod jet;
mod levels;
mod library;
mod lies;
mod limits;
mod lines;
mod oracle;
mod own;
mod point;
mod print;
#[path = "../common/stream.rs"]
mod random;
mod real;
mod rewrite;
mod run;
mod scene;
mod scout;
mod seek;
mod series;
mod sheets;
mod shrink;
mod spoil;
mod table;
mod told;
mod values;
mod witness;
mod wrong;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    // A panic of the verifier is a finding and does not stop the run.
    std::panic::set_hook(Box::new(|_| {}));
    let trials = vec![
        Trial::test("derivatives are what differences show", own::derivatives),
        Trial::test("values agree in f64 and in 640 bits", own::two_precisions),
        Trial::test("arithmetic is that of the library", library::operations),
        Trial::test("logarithms and exponentials are those of the library", library::functions),
        Trial::test("signs in f64 are those in 160 and in 640 bits", own::hints),
        Trial::test("enclosures hold what is printed", own::enclosures),
        Trial::test("the oracle knows what is known", own::known_truths),
        Trial::test("the oracle notices spoilt verdicts", lies::noticed),
        Trial::test("a case depends on its number alone", own::addresses),
        Trial::test("zeros in towers of roots are within the bound", sheets::random_towers),
        Trial::test("principal roots go beyond the bound", sheets::principal_roots),
        Trial::test("dependent roots are on two components", sheets::dependent_roots),
        Trial::test("no verdict on a random claim is wrong", attack),
    ];
    libtest_mimic::run(&arguments, trials).exit_code()
}

fn attack() -> Result<(), Failed> {
    let plan = run::Plan::of_environment();
    let outcome = run::run(&plan);
    println!("{}", outcome.text);
    match outcome.wrong {
        0 if outcome.is_open_rarely() => Ok(()),
        0 => Err(Failed::from(format!("the oracle leaves {} verdicts open", outcome.open))),
        n => Err(Failed::from(format!("{n} wrong verdicts"))),
    }
}
