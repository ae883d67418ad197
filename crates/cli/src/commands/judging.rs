//! Judging of many cases: read, judged in parallel, and reported as far as they came.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::Instant;

use crate::report::{FileFailure, FileOutcome, Heading, RunReport, diagnostic};
use liouville::case::{Case, Expect, Setting};
use liouville::verdict::{self, CaseReport, ClaimReport, Evidence, JudgeError, Options, Verdict};
use rayon::prelude::*;

use super::files::{self, Found, coloured, plain};
use super::limits::{LimitArgs, Stop, signals};
use super::progress::Progress;
use super::source;
use super::threads::pool;

/// Change of a case before it is judged.
pub type Prepare = Box<dyn Fn(&mut Case) + Send + Sync>;

/// Cases to judge, and how.
pub struct JudgingJob {
    /// Files and folders.
    pub paths: Vec<PathBuf>,
    /// Values of parameters.
    pub settings: Vec<Setting>,
    /// Change of each case.
    pub prepare: Prepare,
    /// Options of the verdicts.
    pub options: Options,
    /// Whether claims about motion are judged.
    pub motions: bool,
    /// Whether the equations of motion are sized.
    pub sizes: bool,
    /// Whether the formulas of all claims are set, for a table of them.
    pub statements: bool,
    /// Number of threads.
    pub threads: Option<usize>,
    /// Limits of time and memory.
    pub limits: LimitArgs,
}

/// State of a file: its path, and its case until that is judged.
struct Slot {
    path: PathBuf,
    heading: Heading,
    is_read: bool,
    /// The case, until it is judged.
    case: Option<Case>,
    text: String,
    /// All claims, as yet without verdicts.
    stated: Vec<ClaimReport>,
    warnings: Vec<String>,
    remarks: Vec<String>,
    /// Verdicts so far.
    partial: Option<CaseReport>,
    result: Option<Result<CaseReport, Vec<FileFailure>>>,
}

/// Judges every case of the work.
///
/// A file that fails in any way leaves the others as they are. At a limit, and on Ctrl-C, claims
/// without a verdict are undecided.
pub fn judge(work: JudgingJob) -> Result<RunReport, String> {
    let started = Instant::now();
    work.limits.check()?;
    let (limits, seed) = (work.limits, work.options.seed);
    let signal = signals()?;
    let files = files::collect(&work.paths);
    let slots: Arc<Vec<Mutex<Slot>>> = Arc::new(files.into_iter().map(Slot::new).collect());
    let pool = pool(work.threads.unwrap_or(0))?;
    let (sender, receiver) = channel();
    let bar = Arc::new(Progress::of(slots.len() as u64, "files"));
    let (own, shown) = (Arc::clone(&slots), Arc::clone(&bar));
    std::thread::Builder::new()
        .spawn(move || {
            pool.install(|| {
                own.par_iter().for_each(|slot| {
                    read(slot, &work);
                    shown.add(1.0);
                });
                let claims = own.iter().map(|slot| locked(slot).stated.len() as u64).sum();
                shown.begin(claims, "claims");
                own.par_iter().for_each(|slot| decide(slot, &work, &shown));
            });
            // nobody waits any more if this fails
            _ = sender.send(());
        })
        .map_err(|error| format!("error: cannot start a thread: {error}"))?;
    let stop = limits.wait(&receiver, &signal).err();
    bar.finish();
    let outcomes = slots.iter().map(|slot| locked(slot).outcome(stop)).collect();
    Ok(RunReport { seed, outcomes, elapsed: started.elapsed() })
}

/// Locks a slot; what a failed thread left in it stays valid.
fn locked(slot: &Mutex<Slot>) -> MutexGuard<'_, Slot> {
    slot.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

impl Slot {
    fn new(found: Found) -> Mutex<Self> {
        let (path, result) = match found {
            Ok(path) => (path, None),
            Err((path, failure)) => (path, Some(Err(vec![failure]))),
        };
        Mutex::new(Self {
            path,
            heading: Heading::default(),
            is_read: false,
            case: None,
            text: String::new(),
            stated: Vec::new(),
            warnings: Vec::new(),
            remarks: Vec::new(),
            partial: None,
            result,
        })
    }

    /// The outcome as far as it is known; `stop` tells why it is not complete.
    fn outcome(&mut self, stop: Option<Stop>) -> FileOutcome {
        let path = self.path.display().to_string();
        let heading = std::mem::take(&mut self.heading);
        let is_reached = self.is_read || self.result.is_some();
        let (result, unreached) = match (self.result.take(), stop) {
            (Some(result), _) => (result, Vec::new()),
            (None, stop) => self.unfinished(stop.unwrap_or(Stop::Failed)),
        };
        FileOutcome { path, heading, result, unreached, is_reached }
    }

    /// Verdicts so far, and the other claims as undecided, with their names.
    fn unfinished(&mut self, stop: Stop) -> (Result<CaseReport, Vec<FileFailure>>, Vec<String>) {
        if !self.is_read {
            let message = format!("the file was not read: {stop}");
            let help = "give it more time or memory, or judge it alone";
            return (Err(vec![plain(&self.path, &message, help)]), Vec::new());
        }
        let mut report = self.partial.take().unwrap_or_else(|| CaseReport {
            claims: Vec::new(),
            warnings: std::mem::take(&mut self.warnings),
            remarks: std::mem::take(&mut self.remarks),
            mutants: None,
            motions_left: 0,
            absences_left: 0,
        });
        report.motions_left = 0;
        report.absences_left = 0;
        let mut unreached = Vec::new();
        for mut claim in std::mem::take(&mut self.stated) {
            if !report.claims.iter().any(|known| known.name == claim.name) {
                claim.evidence.reason = Some(format!("not reached: {stop}"));
                unreached.push(claim.name.clone());
                report.claims.push(claim);
            }
        }
        (Ok(report), unreached)
    }
}

/// Reads the file of a slot.
fn read(slot: &Mutex<Slot>, work: &JudgingJob) {
    let path = locked(slot).path.clone();
    if locked(slot).result.is_some() {
        return;
    }
    let shown = path.display().to_string();
    let prepared = |mut case: Case| {
        (work.prepare)(&mut case);
        case
    };
    let found = catch_unwind(AssertUnwindSafe(|| {
        let (text, case) = source::read(&path, &work.settings);
        (text, case.map(prepared))
    }));
    let mut slot = locked(slot);
    match found {
        Err(panic) => slot.result = Some(Err(vec![fault(&path, panic.as_ref())])),
        Ok((text, Err(error))) => {
            slot.result = Some(Err(diagnostic::of_case(&shown, &text, &error, coloured())));
        }
        Ok((text, Ok(case))) => {
            let equations = work.sizes.then(|| verdict::equations_size(&case).ok()).flatten();
            let heading = Heading { equations, ..Heading::of(&case, &text) };
            slot.heading = match work.statements {
                true => heading.with_all_statements(&case),
                false => heading,
            };
            slot.is_read = true;
            slot.stated = stated(&case, work.motions);
            slot.warnings = case.warnings.clone();
            slot.remarks = case.remarks.iter().map(ToString::to_string).collect();
            (slot.case, slot.text) = (Some(case), text);
        }
    }
}

/// Judges the case of a slot.
fn decide(slot: &Mutex<Slot>, work: &JudgingJob, bar: &Progress) {
    let (path, text, case) = {
        let mut slot = locked(slot);
        let Some(case) = slot.case.take() else { return };
        (slot.path.clone(), std::mem::take(&mut slot.text), case)
    };
    let keep = |report: &CaseReport| locked(slot).partial = Some(report.clone());
    let progress = |share: f64| bar.add(share);
    let watch = VerdictWatch { keep: &keep, progress: &progress };
    let found =
        catch_unwind(AssertUnwindSafe(|| verdicts(&case, &work.options, work.motions, watch)));
    let shown = path.display().to_string();
    let result = match found {
        Err(panic) => Err(vec![fault(&path, panic.as_ref())]),
        Ok(result) => {
            result.map_err(|error| vec![diagnostic::of_judging(&shown, &text, &error, coloured())])
        }
    };
    locked(slot).result = Some(result);
}

/// Watch over the verdicts on a case.
#[derive(Clone, Copy)]
pub(super) struct VerdictWatch<'w> {
    /// Takes what was reached so far.
    pub keep: &'w (dyn Fn(&CaseReport) + Sync),
    /// Takes numbers of claims that are decided, also fractions.
    pub progress: &'w (dyn Fn(f64) + Sync),
}

impl VerdictWatch<'_> {
    /// Nobody watches.
    pub const NOBODY: Self = Self { keep: &|_| (), progress: &|_| () };
}

/// Judges the claims of a case in stages, and hands over what each stage reached.
pub(super) fn verdicts(
    case: &Case,
    options: &Options,
    motions: bool,
    VerdictWatch { keep, progress }: VerdictWatch<'_>,
) -> Result<CaseReport, JudgeError> {
    let mut report = verdict::judge_telling(case, options, progress)?;
    if !case.absences.is_empty() {
        keep(&report);
    }
    liouville_search::complete(case, options, &mut report)?;
    progress(case.absences.len() as f64);
    if motions {
        if !case.motions.is_empty() {
            keep(&report);
        }
        liouville_flow::observe::observe_each(case, options, &mut |claim| {
            report.claims.push(claim);
            keep(&report);
            progress(1.0);
        });
        report.motions_left = 0;
    }
    Ok(report)
}

/// Lists the claims of a case without verdicts.
pub(super) fn stated(case: &Case, motions: bool) -> Vec<ClaimReport> {
    let open = |name: &str, kind: &'static str, source: &str, expect: Expect| ClaimReport {
        name: name.to_string(),
        formula: None,
        kind,
        source: source.to_string(),
        place: "level".to_string(),
        expect,
        verdict: Verdict::Undecided,
        agrees: expect == Expect::Open,
        cell: None,
        note: None,
        evidence: Evidence::default(),
    };
    if let Some(parts) = case.time_parts() {
        let mut all = stated(&parts.without_time, motions);
        all.extend(stated(&parts.with_time, motions));
        parts.sort(&mut all, |claim| &claim.name);
        return all;
    }
    let claims = case.claims.iter().map(|own| ClaimReport {
        formula: own.kind.text(),
        place: own.place.name(&case.model).to_string(),
        cell: own.cell.clone(),
        note: own.note.clone(),
        ..open(&own.name, own.kind.name(), &own.source, own.expect)
    });
    let absences =
        case.absences.iter().map(|own| open(&own.name, own.kind.name(), &own.source, own.expect));
    let motions = case
        .motions
        .iter()
        .filter(|_| motions)
        .map(|own| open(&own.name, own.kind.name(), &own.source, own.expect));
    claims.chain(absences).chain(motions).collect()
}

/// Failure of a file on which the program itself failed.
fn fault(path: &Path, panic: &(dyn Any + Send)) -> FileFailure {
    let message = format!("the program failed on this file: {}", diagnostic::panic_message(panic));
    plain(path, &message, "this is a fault of the program: please report it with the file")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_on_one_file_leaves_the_others() {
        let work = JudgingJob {
            paths: vec!["plane/balanced-ball".into(), "plane/disk".into()],
            settings: Vec::new(),
            prepare: Box::new(|case| assert!(!case.title.contains("Disk"), "a fault")),
            options: Options::default(),
            motions: false,
            sizes: false,
            statements: false,
            threads: Some(2),
            limits: LimitArgs::default(),
        };
        let run = judge(work).expect("a report");
        let failed = |outcome: &&FileOutcome| outcome.result.is_err();
        let faults: Vec<&FileOutcome> = run.outcomes.iter().filter(failed).collect();
        assert_eq!((run.outcomes.len(), faults.len()), (2, 1));
        let failures = faults[0].result.as_ref().expect_err("a failure");
        assert!(failures[0].message.contains("the program failed on this file: a fault"));
        assert_eq!(run.exit_code(), 2);
    }
}
