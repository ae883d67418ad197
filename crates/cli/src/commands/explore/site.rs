//! The command `liouville site`: a page for each case of a folder, and an index.

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::report::{CaseDigest, FileFailure, VERSION, diagnostic, survey as written};
use clap::Args;
use liouville::case::Case;
use liouville::verdict::{JudgeError, Options};
use liouville_report::site::{Page, SiteGroup, SiteOrder, SiteOutcome, index, way_back};
use liouville_search::{Halt, survey};
use rayon::prelude::*;

use super::super::files::{self, Found, plain};
use super::super::limits::{STOPPED, signals};
use super::{CommandOutput, LimitArgs, Progress, SamplingArgs, out, pool, source};

#[derive(Debug, Args)]
pub struct Site {
    /// Case file, folder of them, or a part of the catalogue inside the program
    #[arg(default_value = "cases")]
    pub folder: PathBuf,
    /// Folder to write the pages to; made if it does not exist
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    #[command(flatten)]
    pub limits: LimitArgs,
    #[command(flatten)]
    pub sampling: SamplingArgs,
}

/// A case of the site, and what is known of it.
struct SiteTask {
    path: PathBuf,
    /// File of its page in the folder of the site.
    file: String,
    page: Mutex<Page>,
}

/// The site under way.
struct SiteBuild {
    tasks: Vec<SiteTask>,
    out: PathBuf,
    options: Options,
    /// Whether pages are still written; locked while one is.
    is_open: Mutex<bool>,
}

pub fn run(options: &Site) -> Result<CommandOutput, String> {
    options.limits.check()?;
    std::fs::create_dir_all(&options.out)
        .map_err(|error| format!("error: cannot make {}: {error}", options.out.display()))?;
    let signal = signals()?;
    let work = Arc::new(SiteBuild {
        tasks: tasks(files::collect(std::slice::from_ref(&options.folder)), &options.folder),
        out: options.out.clone(),
        options: options.sampling.options(),
        is_open: Mutex::new(true),
    });
    let pool = pool(options.sampling.threads.unwrap_or(0).min(work.tasks.len().max(1)))?;
    let bar = Arc::new(Progress::of(work.tasks.len() as u64, "cases"));
    let (sender, receiver) = channel();
    let (own, shown) = (Arc::clone(&work), Arc::clone(&bar));
    std::thread::Builder::new()
        .spawn(move || {
            pool.install(|| {
                // cases of a folder take different times: each is a piece of work
                own.tasks.par_iter().with_max_len(1).for_each(|task| {
                    own.report(task);
                    shown.add(1.0);
                });
            });
            // nobody waits any more if this fails
            _ = sender.send(());
        })
        .map_err(|error| format!("error: cannot start a thread: {error}"))?;
    let stop = options.limits.wait(&receiver, &signal).err();
    *locked(&work.is_open) = false;
    bar.finish();
    let pages: Vec<Page> = work.tasks.iter().map(|task| locked(&task.page).clone()).collect();
    for order in SiteOrder::ALL {
        let text = index(&title(&options.folder), &format!("liouville {VERSION}"), &pages, order);
        out::write(&options.out.join(order.file()), "--out", text)?;
    }
    if let Some(stop) = stop {
        anstream::eprintln!("{}", stop.message(None));
    }
    Ok(answer(&options.out, &pages))
}

fn locked<T>(own: &Mutex<T>) -> MutexGuard<'_, T> {
    own.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Counts the pages; the exit code is 2 if a case has none, and 3 if some were not reached.
fn answer(folder: &Path, pages: &[Page]) -> CommandOutput {
    let count = |is_meant: fn(&SiteOutcome) -> bool| {
        pages.iter().filter(|page| is_meant(&page.outcome)).count()
    };
    let failed = count(|outcome| matches!(outcome, SiteOutcome::Failed(_)));
    let unreached = count(|outcome| matches!(outcome, SiteOutcome::Unreached));
    let shown = folder.join(SiteOrder::Hierarchy.file());
    let written = pages.len() - failed - unreached;
    let plural = if written == 1 { "" } else { "s" };
    let mut text = format!("{}\n{written} page{plural}", shown.display());
    for (count, words) in [(failed, "without a report"), (unreached, "not reached")] {
        if count > 0 {
            text.push_str(&format!("; {count} {words}"));
        }
    }
    for page in pages {
        if let SiteOutcome::Failed(failures) = &page.outcome {
            anstream::eprintln!("{}", diagnostic::rendered(failures));
        }
    }
    let code = match (failed, unreached) {
        (0, 0) => 0,
        (_, 0) => 2,
        _ => STOPPED,
    };
    CommandOutput { text: text + "\n", code }
}

/// Title of the site: the name of the folder.
fn title(folder: &Path) -> String {
    let name = folder.file_name().map(|name| name.to_string_lossy().into_owned());
    match name.as_deref() {
        None | Some("cases") => "Cases and their invariants".to_string(),
        Some(name) => format!("{name}: cases and their invariants"),
    }
}

/// Tasks for the files, each with a page of its own.
fn tasks(found: Vec<Found>, folder: &Path) -> Vec<SiteTask> {
    let mut taken: BTreeSet<String> =
        SiteOrder::ALL.iter().map(|order| order.file().to_string()).collect();
    let each = found.into_iter().map(|found| {
        let (path, outcome) = match found {
            Ok(path) => (path, SiteOutcome::Unreached),
            Err((path, failure)) => (path, SiteOutcome::Failed(vec![failure])),
        };
        let inside = inside(&path, folder);
        let mut file = inside.strip_suffix(".toml").unwrap_or(&inside).to_string() + ".html";
        // the index has its names, and systems of files may not tell capitals from small letters
        while !taken.insert(file.to_lowercase()) {
            file = format!("{}-case.html", file.trim_end_matches(".html"));
        }
        let page = Page {
            title: inside.clone(),
            path: inside,
            lead: String::new(),
            source: String::new(),
            outcome,
        };
        SiteTask { path, file, page: Mutex::new(page) }
    });
    each.collect()
}

/// Path of a case in its folder, with `/` between the parts.
fn inside(path: &Path, folder: &Path) -> String {
    let own = [folder, Path::new("cases")];
    let rest = own.iter().find_map(|folder| path.strip_prefix(folder).ok());
    let rest = rest.filter(|rest| rest.file_name().is_some());
    let rest = rest.or(path.file_name().map(Path::new)).unwrap_or(path);
    let parts = rest.components().map(|part| part.as_os_str().to_string_lossy().into_owned());
    parts.collect::<Vec<_>>().join("/")
}

impl SiteBuild {
    /// Makes the page of a case; a failure of any kind is its outcome.
    fn report(&self, task: &SiteTask) {
        if !matches!(locked(&task.page).outcome, SiteOutcome::Unreached) || !*locked(&self.is_open)
        {
            return;
        }
        let found = catch_unwind(AssertUnwindSafe(|| self.made(task)));
        let fault = || {
            let help = "this is a fault of the program: please report it with the file";
            Err(vec![plain(&task.path, "the program failed on this file", help)])
        };
        let made = found.unwrap_or_else(|_| fault());
        let is_open = locked(&self.is_open);
        if !*is_open {
            return;
        }
        let path = self.out.join(&task.file);
        let written = made.and_then(|made| {
            let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
            folder
                .map_err(|error| error.to_string())
                .and_then(|()| out::write(&path, "--out", &made.html))
                .map_err(|error| {
                    vec![plain(&task.path, &error, "give --out a folder with room for the pages")]
                })?;
            Ok(made)
        });
        let mut page = locked(&task.page);
        match written {
            Err(failures) => page.outcome = SiteOutcome::Failed(failures),
            Ok(made) => {
                (page.title, page.source, page.lead) = (made.title, made.source, made.lead);
                page.outcome = SiteOutcome::Report(task.file.clone(), made.standing);
            }
        }
    }

    fn made(&self, task: &SiteTask) -> Result<Made, Vec<FileFailure>> {
        let shown = task.path.display().to_string();
        let (text, case) = source::read(&task.path, &[]);
        let case = case.map_err(|error| diagnostic::of_case(&shown, &text, &error, false))?;
        let origin = CaseDigest::of(&text).line();
        let found = self.document(&case, &origin);
        let (document, standing) =
            found.map_err(|error| vec![diagnostic::of_judging(&shown, &text, &error, false)])?;
        Ok(Made {
            title: case.title.clone(),
            source: case.source.clone(),
            lead: if document.lead == case.source { String::new() } else { document.lead.clone() },
            standing,
            html: document.html_of_site(&way_back(&task.file)),
        })
    }

    /// The report on a case; of a map, which has no survey, the verdicts on its claims.
    fn document(
        &self,
        case: &Case,
        origin: &str,
    ) -> Result<(written::Document, SiteGroup), JudgeError> {
        if case.model.system.is_map() {
            let report = liouville_search::judge(case, &self.options)?;
            let document = written::of_claims(case, &report, self.options.seed, origin);
            return Ok((document, SiteGroup::Claims));
        }
        let found = survey::survey(case, &self.options, &Halt::default(), &mut |_| ())?;
        // one thread: the others have cases of their own
        let motion = liouville_flow::portrait(case, self.options.seed, 1);
        let document = written::with_motion(&found, origin, motion.as_ref());
        Ok((document, SiteGroup::Class(found.hierarchy.class)))
    }
}

/// Page of a case, with its row in the index.
struct Made {
    title: String,
    source: String,
    lead: String,
    standing: SiteGroup,
    html: String,
}
