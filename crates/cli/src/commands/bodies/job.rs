//! Tables of bodies as jobs: a row is a unit.

use std::borrow::Cow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use liouville::case::{Case, Expect, Setting};
use liouville::part::Part;
use liouville::verdict::{ClaimReport, JudgeError, Options};
use liouville_search::Halt;
use liouville_search::survey::{self, Survey, TestedClaim};
use rayon::prelude::*;

use super::table::{TableMistake, ValueRow, ValueTable};
use super::{BodiesArgs, RowFormat};
use crate::commands::check::RequestedClaims;
use crate::commands::eval::Opened;
use crate::commands::explore::output::{Ending, Output};
use crate::commands::explore::report::ReportArgs;
use crate::commands::explore::share::Share;
use crate::commands::judging::{VerdictWatch, stated, verdicts};
use crate::commands::out::write;
use crate::commands::progress::Progress;
use crate::commands::threads::pool;
use crate::commands::{CheckArgs, CommandOutput, eval, source};
use crate::parts::{Form, Identity, Job, json_line, json_unit};
use crate::report::bodies::{BodiesReport, Body, Finding, Invariants, RowMistake, StatedClaim};
use crate::report::{CaseDigest, sha256};

/// Question about each body.
#[derive(Clone, Debug)]
enum Question {
    /// Verdicts on claims.
    Claims { wanted: RequestedClaims, motions: bool },
    /// Invariants.
    Invariants,
}

impl Question {
    /// Claims on which there are verdicts, in the order of the case.
    fn claims(&self, case: &Case) -> Vec<StatedClaim> {
        let told = |claim: ClaimReport| StatedClaim {
            name: claim.name,
            kind: claim.kind,
            formula: claim.formula,
            expect: claim.expect.word(),
        };
        match self {
            Self::Claims { wanted, motions } => {
                let all = stated(case, *motions).into_iter();
                all.filter(|claim| wanted.takes_claim(claim, case)).map(told).collect()
            }
            Self::Invariants => {
                let claims = case.claims.iter().map(|own| own.name.as_str());
                let names: Vec<&str> = claims.collect();
                let all = stated(case, false).into_iter();
                let is_asked = |claim: &ClaimReport| {
                    claim.expect != Expect::Fails && names.contains(&claim.name.as_str())
                };
                all.filter(is_asked).map(told).collect()
            }
        }
    }
}

/// A case, with a table of bodies.
#[derive(Debug)]
pub struct BodiesJob {
    question: Question,
    options: Options,
    path: PathBuf,
    set: Vec<String>,
    opened: Opened,
    /// Claims on which there are verdicts, in the order of the case.
    claims: Vec<StatedClaim>,
    bodies: BodiesArgs,
    /// Table, once it has been read: results are merged without it.
    table: OnceLock<SignedTable>,
    share: Share,
    format: RowFormat,
    out: Option<Output>,
}

/// A table, with the digest of its text.
#[derive(Debug)]
struct SignedTable {
    table: ValueTable,
    digest: String,
}

impl BodiesJob {
    /// Job of `check`.
    pub fn of_check(options: &CheckArgs, opened: Opened) -> Result<Self, String> {
        let path = options.paths.first().cloned().unwrap_or_default();
        let format = RowFormat::of_check(options)?;
        let motions = options.motion;
        let question = Question::Claims { wanted: RequestedClaims::of(options), motions };
        let (bodies, share) = (options.bodies.clone(), options.share.clone());
        let claims = question.claims(&opened.case);
        if claims.is_empty() {
            return Err(options.no_claim());
        }
        Ok(Self {
            out: output(options.out.as_deref(), &share, &[Some(&path), bodies.settings.as_ref()])?,
            question,
            options: options.sampling.options(),
            path,
            set: options.settings.clone(),
            opened,
            claims,
            bodies,
            table: OnceLock::new(),
            share,
            format,
        })
    }

    /// Job of `report`.
    pub fn of_report(options: &ReportArgs, opened: Opened) -> Result<Self, String> {
        let (bodies, share) = (options.bodies.clone(), options.share.clone());
        let inputs = [Some(&options.case), bodies.settings.as_ref()];
        Ok(Self {
            out: output(options.out.as_deref(), &share, &inputs)?,
            question: Question::Invariants,
            options: options.sampling.options(),
            path: options.case.clone(),
            set: options.settings.clone(),
            claims: Question::Invariants.claims(&opened.case),
            opened,
            bodies,
            table: OnceLock::new(),
            share,
            format: RowFormat::of_report(options)?,
        })
    }

    /// Title of the case.
    pub fn title(&self) -> &str {
        &self.opened.case.title
    }

    fn is_report(&self) -> bool {
        matches!(self.question, Question::Invariants)
    }

    /// Table, whose columns are parameters of the case. The file is read once.
    fn table(&self) -> Result<&SignedTable, String> {
        if let Some(table) = self.table.get() {
            return Ok(table);
        }
        let path = self.bodies.settings.as_deref().unwrap_or(Path::new("bodies.csv"));
        let shown = path.display();
        let text = match &self.bodies.text {
            Some(text) => Cow::Borrowed(text.as_str()),
            None => Cow::Owned(source::text(
                path,
                "give --settings a CSV file: names of parameters, and a row for each body",
            )?),
        };
        let told =
            |mistake: TableMistake| format!("error: {shown}: {mistake}\nhelp: {}", mistake.help());
        let table = ValueTable::read(&text).map_err(told)?;
        table.check(&self.opened.case, &self.given()?).map_err(told)?;
        Ok(self.table.get_or_init(|| SignedTable { table, digest: sha256(&text) }))
    }

    /// Values of `--set`.
    fn given(&self) -> Result<Vec<Setting>, String> {
        eval::read_settings(&self.set)
    }

    /// Judges the body of a row.
    fn body(&self, place: u64, row: &ValueRow, given: &[Setting], table: &ValueTable) -> Body {
        let found = table.settings(row).map_err(|mistake| vec![mistake]).and_then(|own| {
            let settings = [given, &own].concat();
            let judged = AssertUnwindSafe(|| self.finding(&settings));
            catch_unwind(judged).unwrap_or_else(|_| {
                let help = "this is a fault of the program: please report it with the case";
                Err(vec![RowMistake::new("the program failed on this row", help)])
            })
        });
        Body { row: place + 1, line: row.line, settings: table.named(row), found }
    }

    /// Result for a body with these values.
    fn finding(&self, settings: &[Setting]) -> Result<Finding, Vec<RowMistake>> {
        let mut case = Case::parse(&self.opened.text, settings).map_err(|error| {
            let told = |own: &liouville::case::Mistake| {
                let message = own.message();
                let message = message.strip_prefix("--set ").unwrap_or(&message).to_string();
                RowMistake { message, help: own.help() }
            };
            error.mistakes().iter().map(told).collect::<Vec<RowMistake>>()
        })?;
        let wrong = |error: JudgeError| vec![RowMistake::new(error.to_string(), error.help())];
        match &self.question {
            Question::Claims { wanted, motions } => {
                wanted.prepare(&mut case);
                let report = verdicts(&case, &self.options, *motions, VerdictWatch::NOBODY)
                    .map_err(wrong)?;
                self.judged(&report.claims.iter().collect::<Vec<_>>(), None, report.warnings)
            }
            Question::Invariants => {
                let found = survey::survey(&case, &self.options, &Halt::default(), &mut |_| ())
                    .map_err(wrong)?;
                let claims: Vec<&ClaimReport> =
                    found.claimed.iter().map(|own| &own.claim).collect();
                self.judged(&claims, Some(invariants(&found)), found.warnings.clone())
            }
        }
    }

    /// Verdicts in the order of the claims.
    fn judged(
        &self,
        reports: &[&ClaimReport],
        invariants: Option<Invariants>,
        warnings: Vec<String>,
    ) -> Result<Finding, Vec<RowMistake>> {
        let mut found = Finding { verdicts: Vec::new(), against: Vec::new(), invariants, warnings };
        for (place, claim) in self.claims.iter().enumerate() {
            let Some(report) = reports.iter().find(|report| report.name == claim.name) else {
                let message = format!("`{}` has no verdict with these values", claim.name);
                return Err(vec![RowMistake::new(message, "judge it alone, with --set")]);
            };
            found.verdicts.push(report.verdict);
            if !report.agrees {
                found.against.push(place);
            }
        }
        Ok(found)
    }
}

/// Names of the invariants of a body.
fn invariants(found: &Survey) -> Invariants {
    // A find of the search has no name of its own.
    let name = |one: &TestedClaim| match one.claim.name == one.claim.kind.replace('-', " ") {
        true => one.formula().to_string(),
        false => one.claim.name.clone(),
    };
    let names = |own: &[TestedClaim]| own.iter().map(name).collect();
    Invariants {
        class: word(&found.hierarchy.class),
        measure: word(&found.hierarchy.measure),
        integrals: names(&found.integrals),
        densities: names(&found.densities),
        fields: names(&found.fields),
        reversors: names(&found.reversors),
        symmetries: names(&found.symmetries),
    }
}

/// Word that stands for a value in JSON.
fn word(value: &impl serde::Serialize) -> String {
    let value = serde_json::to_value(value).ok();
    value.and_then(|value| value.as_str().map(str::to_string)).unwrap_or_default()
}

/// File of the results, of a whole job.
fn output(
    path: Option<&Path>,
    share: &Share,
    inputs: &[Option<&PathBuf>],
) -> Result<Option<Output>, String> {
    let inputs: Vec<&Path> = inputs.iter().flatten().map(|path| path.as_path()).collect();
    match (path, share.part) {
        (Some(path), None) => Output::new(path, Ending::ROWS, &inputs).map(Some),
        _ => Ok(None),
    }
}

impl Job for BodiesJob {
    type Unit = Body;

    fn identity(&self) -> Result<Identity, String> {
        let SignedTable { table, digest } = self.table()?;
        let Options { states, trust, .. } = self.options;
        let mut settings = self.set.clone();
        settings.sort();
        let question = &self.question;
        let request =
            format!("{question:?} states {states} trust {trust:?} bodies sha256:{digest}");
        Ok(Identity {
            job: if self.is_report() { "report" } else { "check" },
            units: table.rows.len() as u64,
            seed: self.options.seed,
            request,
            arguments: self.share.arguments.clone(),
            name: self.path.display().to_string(),
            settings,
            case: self.opened.text.clone(),
        })
    }

    fn form(&self) -> Form {
        Form::Json
    }

    fn compute(&self, part: Part, threads: usize) -> Result<Vec<Body>, String> {
        let (SignedTable { table, .. }, given) = (self.table()?, self.given()?);
        let range = part.range(table.rows.len() as u64);
        let rows = part.of(&table.rows);
        let pool = pool(threads.min(rows.len().max(1)))?;
        let bar = Progress::of(rows.len() as u64, "bodies");
        let is_stopped = liouville_flow::stop_request();
        let bodies: Option<Vec<Body>> = pool.install(|| {
            let judged = rows.par_iter().enumerate().map(|(k, row)| {
                let place = range.start + k as u64;
                let body = (!is_stopped()).then(|| self.body(place, row, &given, table));
                bar.add(1.0);
                body
            });
            judged.collect()
        });
        bar.finish();
        bodies.ok_or_else(|| "error: stopped before all bodies were judged".to_string())
    }

    fn line(&self, _: u64, unit: &Body) -> Result<String, String> {
        json_line(unit)
    }

    fn unit(&self, line: &str) -> Result<Body, String> {
        json_unit(line)
    }

    fn report(&self, units: Vec<Body>) -> Result<CommandOutput, String> {
        let report = BodiesReport {
            title: self.title(),
            path: &self.path.display().to_string(),
            digest: CaseDigest::of(&self.opened.text),
            seed: self.options.seed,
            claims: &self.claims,
            has_invariants: self.is_report(),
            bodies: &units,
        };
        let written = |format: RowFormat| -> Result<String, String> {
            Ok(match format {
                RowFormat::Text => report.text(),
                RowFormat::Summary => report.summary_line(),
                RowFormat::Csv => report.csv(),
                RowFormat::Json => report.json().map_err(|error| format!("error: {error}"))? + "\n",
                RowFormat::JsonLines => report.json_lines(),
            })
        };
        if let Some(out) = &self.out {
            let format = match out.ending {
                Ending::Csv => RowFormat::Csv,
                Ending::Jsonl => RowFormat::JsonLines,
                _ => RowFormat::Json,
            };
            write(&out.path, "--out", written(format)?)?;
        }
        Ok(CommandOutput { text: written(self.format)?, code: report.exit_code() })
    }
}
