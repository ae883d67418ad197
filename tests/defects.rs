//! Small files on which a verifier can go wrong, each with the answers that are right.
//!
//! The files in `tests/defects/` are data: a group is a system with claims about it, and beside each
//! claim stand the verdicts that may be given. Every claim is a test of its own, named by what it shows,
//! judged alone (or with its whole group, if the group says `together`) at several seeds.

use std::process::ExitCode;

use libtest_mimic::{Arguments, Failed, Trial};

#[path = "defects/file.rs"]
mod file;
#[path = "defects/judged.rs"]
mod judged;
#[path = "defects/program.rs"]
mod program;
#[path = "defects/right.rs"]
mod right;
#[path = "defects/searched.rs"]
mod searched;

use file::{Entry, entries};

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let mut trials = Vec::new();
    for entry in entries("tests/defects") {
        match entry {
            Entry::Group(group) => trials.extend(judged::trials(group)),
            Entry::Search(asked) => trials.push(searched::trial(asked)),
            Entry::Complaint(complaint) => trials.push(program::complaint(complaint)),
            Entry::Mutation(mutation) => trials.push(judged::mutation(mutation)),
        }
    }
    let count = trials.len();
    let whole = move || match count {
        0..230 => Err(Failed::from(format!("only {count} tests were read"))),
        _ => Ok(()),
    };
    trials.push(Trial::test("the collection is whole", whole));
    libtest_mimic::run(&arguments, trials).exit_code()
}
