//! Claims of the catalogue, each a separate test: `cargo test -- unbalanced` runs those of the
//! unbalanced balls, `cargo test -- "(3.19)"` those of the equation, `cargo test -- "Table 1, row 4"`
//! those of the row.
//!
//! A claim passes when its verdict is the one its file expects and, if it is refuted, its witness
//! refutes it again. A case is judged once, for the first of its claims that runs.

#[path = "common/files.rs"]
mod files;
#[path = "common/witness.rs"]
mod witness;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::{Arc, OnceLock};

use files::files;
use libtest_mimic::{Arguments, Failed, Trial};
use liouville::case::{Case, labels};
use liouville::verdict::{CaseReport, JudgeError, Options};
use liouville_search::judge;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let mut trials = Vec::new();
    let mut claims = 0;
    for path in files(Path::new("../cases")) {
        let (_, case) = Case::read(&path, &[]);
        let name = path.with_extension("").display().to_string().replace('\\', "/");
        let name = name.trim_start_matches("../");
        match case {
            Err(error) => {
                let problem = error.to_string();
                trials.push(Trial::test(name, move || Err(Failed::from(problem))));
            }
            Ok(case) => {
                let judged = Arc::new(Judged { path, case, report: OnceLock::new() });
                claims += judged.case.claims.len() + judged.case.absences.len();
                for (index, (claim, labels)) in judged.titles().into_iter().enumerate() {
                    let judged = Arc::clone(&judged);
                    let test = move || judged.check(index);
                    trials.push(Trial::test(format!("{name} :: {claim} [{labels}]"), test));
                }
            }
        }
    }
    let enough = move || match claims {
        0..5000 => Err(Failed::from(format!("the catalogue shrank to {claims} claims"))),
        _ => Ok(()),
    };
    trials.push(Trial::test("the catalogue is whole", enough));
    libtest_mimic::run(&arguments, trials).exit_code()
}

/// A case with its report, made on first use.
struct Judged {
    path: PathBuf,
    case: Case,
    report: OnceLock<Result<CaseReport, JudgeError>>,
}

impl Judged {
    /// Names of the claims, each with the equations, theorems and cells of tables that it states.
    fn titles(&self) -> Vec<(String, String)> {
        let case = &self.case;
        let title = |name: &String, source: &str, cell: &Option<String>| {
            (name.clone(), labels(source, case.column.as_ref(), cell.as_deref()).join("; "))
        };
        let claims = case.claims.iter().map(|own| title(&own.name, &own.source, &own.cell));
        let absent = case.absences.iter().map(|own| title(&own.name, &own.source, &own.cell));
        claims.chain(absent).collect()
    }

    fn check(&self, index: usize) -> Result<(), Failed> {
        let report = self.report.get_or_init(|| judge(&self.case, &Options::default()));
        let report = report.as_ref().map_err(|error| Failed::from(error.to_string()))?;
        let claim = &report.claims[index];
        if claim.agrees {
            return witness::check(&self.path, claim).map_err(Failed::from);
        }
        Err(Failed::from(format!(
            "expected: {}, verdict: {}\n{:#?}",
            claim.expect.word(),
            claim.verdict.word(),
            claim.evidence
        )))
    }
}
