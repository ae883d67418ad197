//! Random claims of known truth: no verdict on them is wrong.
//!
//! Scenes and claims are grown, rewritten and spoilt by a generator of its own; what is true of them is
//! found by an oracle that shares nothing with the verifier: floats of 512 bits with their own notion of
//! what has a value, at states in every cell of signs that it finds. A wrong verdict is made as small as
//! possible and printed as a file, with the variables that repeat it.
//!
//! | variable | |
//! |---|---|
//! | `LIOUVILLE_ATTACK=1000000` | so many cases, in place of 8 200 with 10 000 claims |
//! | `LIOUVILLE_ATTACK_SEED=7` | others |
//! | `LIOUVILLE_ATTACK_ONLY=123` | one of them |
//! | `LIOUVILLE_ATTACK_SHOW=10` | how many wrong verdicts of each class are shown |

use std::process::ExitCode;

use libtest_mimic::{Arguments, Failed, Trial};

#[path = "attack/claim.rs"]
mod claim;
#[path = "attack/derive.rs"]
mod derive;
#[path = "attack/draw.rs"]
mod draw;
#[path = "attack/expr.rs"]
mod expr;
#[path = "attack/flow.rs"]
mod flow;
#[path = "attack/grow.rs"]
mod grow;
#[path = "attack/interval.rs"]
mod interval;
#[path = "attack/jet.rs"]
mod jet;
#[path = "attack/levels.rs"]
mod levels;
#[path = "attack/limits.rs"]
mod limits;
#[path = "attack/oracle.rs"]
mod oracle;
#[path = "attack/print.rs"]
mod print;
#[path = "attack/random.rs"]
mod random;
#[path = "attack/real.rs"]
mod real;
#[path = "attack/rewrite.rs"]
mod rewrite;
#[path = "attack/run.rs"]
mod run;
#[path = "attack/scene.rs"]
mod scene;
#[path = "attack/scout.rs"]
mod scout;
#[path = "attack/shrink.rs"]
mod shrink;
#[path = "attack/spoil.rs"]
mod spoil;
#[path = "attack/table.rs"]
mod table;
#[path = "attack/told.rs"]
mod told;
#[path = "attack/wrong.rs"]
mod wrong;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    // A panic of the verifier is a finding, not the end.
    std::panic::set_hook(Box::new(|_| {}));
    let trials = vec![Trial::test("no verdict on a random claim is wrong", attack)];
    libtest_mimic::run(&arguments, trials).exit_code()
}

fn attack() -> Result<(), Failed> {
    let plan = run::Plan::of_environment();
    let outcome = run::run(&plan);
    println!("{}", outcome.text);
    match outcome.wrong {
        0 => Ok(()),
        n => Err(Failed::from(format!("{n} wrong verdicts"))),
    }
}
