//! Table of what a search finds in a folder of case files: `cargo run --release --example discovery
//! [FOLDER] [SECONDS]`. A note `integrals known: N` in a file is compared with the number found.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use liouville::case::Case;
use liouville::verdict::Verdict;
use liouville_search::{Effort, FoundKind, Halt, SearchReport, search};

/// Folder that is searched without arguments.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benchmark/pegasus");

/// Results for one file.
struct Row {
    name: String,
    /// Numbers of integrals, Darboux polynomials and densities that are not constant.
    found: [usize; 3],
    /// Number of functions of constant rate: integrals that depend on time.
    of_time: usize,
    unproved: usize,
    /// Number of known independent integrals, where the file states it.
    known: Option<usize>,
    seconds: f64,
    formulas: Vec<String>,
    failure: Option<String>,
}

fn row(path: &Path, limit: Option<f64>) -> Row {
    let start = Instant::now();
    let outcome = searched(path, limit);
    let seconds = start.elapsed().as_secs_f64();
    let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let (known, report, failure) = match outcome {
        Ok((known, report)) => (known, report, None),
        Err(failure) => (None, SearchReport::default(), Some(failure)),
    };
    let proved = |kind: FoundKind| {
        let own = report.found.iter().filter(|found| found.kind == kind);
        let own = own.filter(|found| found.verdict == Verdict::Proved);
        own.filter(|found| kind != FoundKind::Density || found.text() != "1").count()
    };
    let line = |found: &liouville_search::Found| {
        let with: Vec<String> =
            found.with.iter().map(|own| format!("{} {}", own.name(), own.text())).collect();
        format!("{} {}   {}", found.kind, found.text(), with.join(", "))
    };
    Row {
        name,
        found: [FoundKind::Integral, FoundKind::DarbouxPolynomial, FoundKind::Density].map(proved),
        of_time: proved(FoundKind::ConstantRate),
        known,
        unproved: report.found.iter().filter(|found| found.verdict != Verdict::Proved).count(),
        seconds,
        formulas: report.found.iter().map(line).collect(),
        failure,
    }
}

fn searched(path: &Path, limit: Option<f64>) -> Result<(Option<usize>, SearchReport), String> {
    let case = Case::read(path, &[]).1.map_err(|error| error.to_string())?;
    let halt =
        limit.map_or_else(Halt::default, |limit| Halt::within(Duration::from_secs_f64(limit)));
    let effort = Effort { halt, blind: true, ..Effort::default() };
    let number = |note: &String| note.strip_prefix("integrals known: ")?.parse().ok();
    let known = case.notes.iter().find_map(number);
    let report = search(&case, &effort, &mut |_| {}).map_err(|error| error.to_string())?;
    Ok((known, report))
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().unwrap_or(FOLDER.to_string());
    let limit = arguments.next().and_then(|text| text.parse().ok());
    let Ok(entries) = std::fs::read_dir(&folder) else {
        eprintln!("error: {folder} cannot be read");
        return ExitCode::FAILURE;
    };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|own| own == "toml"));
    paths.sort();
    let start = Instant::now();
    let (next, rows) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let threads = std::thread::available_parallelism().map_or(1, |count| count.get());
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(path) = paths.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let row = row(path, limit);
                    if let Ok(mut rows) = rows.lock() {
                        rows.push(row);
                    }
                }
            });
        }
    });
    let mut rows = rows.into_inner().unwrap_or_default();
    rows.sort_by(|a, b| a.name.cmp(&b.name));
    println!("{:<60} integrals  Darboux  densities  seconds", "system");
    for row in &rows {
        let [integrals, darboux, densities] = row.found;
        let Row { name, seconds, .. } = row;
        println!("{name:<60} {integrals:>9}  {darboux:>7}  {densities:>9}  {seconds:>7.2}");
        row.formulas.iter().for_each(|formula| println!("    {formula}"));
        row.failure.iter().for_each(|failure| println!("    error: {failure}"));
    }
    let with = |k: usize| rows.iter().filter(|row| row.found[k] > 0).count();
    let unproved: usize = rows.iter().map(|row| row.unproved).sum();
    println!(
        "{} systems: integrals in {}, Darboux polynomials in {}, densities that are not constant in {}; not \
         proved: {unproved}; {:.1} s",
        rows.len(),
        with(0),
        with(1),
        with(2),
        start.elapsed().as_secs_f64()
    );
    let known: usize = rows.iter().filter_map(|row| row.known).sum();
    if known > 0 {
        let found = |row: &Row| row.known.map(|known| known.min(row.found[0] + row.of_time));
        let found: usize = rows.iter().filter_map(found).sum();
        let mut times: Vec<f64> = rows.iter().map(|row| row.seconds).collect();
        times.sort_by(f64::total_cmp);
        let median = times.get(times.len() / 2).copied().unwrap_or_default();
        println!("known integrals: {found} of {known} found; median {median:.2} s a system");
    }
    ExitCode::SUCCESS
}
