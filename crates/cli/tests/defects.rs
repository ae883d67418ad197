//! Small files on which a verifier may fail, each with the correct answers.
//!
//! The files in `tests/defects/` are data: a group is a system with claims about it, each with the
//! verdicts that are allowed. Every claim is a separate test, named by its subject, judged alone
//! (or with its whole group, if the group says `together`) at one seed, or at `seeds` of them.

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
