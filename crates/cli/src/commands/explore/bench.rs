//! The command `liouville measure bench`.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use crate::report::bench::{self, BenchRun};
use crate::report::{FileFailure, diagnostic, diagram, terminal};
use clap::Args;
use liouville::verdict::TAPE_LANES;
use liouville_lab::bench::{
    BenchItem, BenchOptions, ClaimMeasurements, Selection, measure_item, work_items,
};

use super::{CommandOutput, LimitArgs, Progress, colour, files, out, source, width};

#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Case files, or folders of them; by default three work items, W1 to W3
    pub paths: Vec<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Write the work-precision diagram to this file
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Seed of the states
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Number of states at which errors are measured (rounded up to blocks of 64)
    #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u64).range(1..=65536))]
    pub states: u64,
    /// Number of interleaved rounds, of which the median time is taken
    #[arg(long, default_value_t = 21, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub rounds: u32,
    /// Measure only the engines in f64 and code written by hand, with errors at 256 states
    #[arg(long)]
    pub engines: bool,
    /// List the states in the JSON, with the results of the quickest engine
    #[arg(long, requires = "json")]
    pub values: bool,
    #[command(flatten)]
    pub limits: LimitArgs,
}

pub fn run(options: &BenchArgs) -> Result<CommandOutput, String> {
    let amount = BenchOptions {
        seed: options.seed,
        blocks: options.states.div_ceil(TAPE_LANES as u64),
        rounds: options.rounds as usize,
        selection: if options.engines { Selection::Engines } else { Selection::All },
        keep_values: options.values,
    };
    let mut run = BenchRun::new(amount);
    let found = items(options)?;
    if let Some(path) = &options.svg {
        let inputs: Vec<&Path> = found.iter().map(|(path, _)| Path::new(path)).collect();
        out::check(path, "--svg", &inputs)?;
    }
    let bar = Progress::of(found.len() as u64, "cases");
    for (path, item) in found {
        // One thread, one item at a time: candidates do not compete for the machine.
        bar.tell(&path);
        let measured = item.and_then(|item| measured(&item, &amount, &|share| bar.add(share)));
        match measured {
            Ok(measured) => run.measured.extend(measured),
            Err(failures) => {
                run.errors.extend(failures.into_iter().map(|failure| (path.clone(), failure)));
            }
        }
    }
    bar.finish();
    for (_, failure) in &run.errors {
        anstream::eprintln!("{}", failure.rendered);
    }
    if let Some(path) = &options.svg
        && !run.measured.is_empty()
    {
        out::write(path, "--svg", diagram::svg(&run.measured))?;
    }
    let text = if options.json {
        bench::json(&run).map_err(|error| format!("error: {error}"))? + "\n"
    } else {
        let colour = colour(std::io::stdout().is_terminal());
        bench::text(
            &run,
            terminal::Style { detail: terminal::Detail::Claims, colour, width: width() },
        )
    };
    Ok(CommandOutput { text, code: if run.errors.is_empty() { 0 } else { 2 } })
}

type Named = (String, Result<BenchItem, Vec<FileFailure>>);

/// Collects the work items, or the cases under the paths.
fn items(options: &BenchArgs) -> Result<Vec<Named>, String> {
    if options.paths.is_empty() {
        let items = work_items().map_err(|error| format!("error: {error}"))?;
        return Ok(items.into_iter().map(|item| (item.name.clone(), Ok(item))).collect());
    }
    let found = files::collect(&options.paths).into_iter();
    Ok(found
        .map(|file| match file {
            Ok(path) => (path.display().to_string(), item(&path)),
            Err((path, failure)) => (path.display().to_string(), Err(vec![failure])),
        })
        .collect())
}

fn item(path: &Path) -> Result<BenchItem, Vec<FileFailure>> {
    let shown = path.display().to_string();
    let (text, case) = source::read(path, &[]);
    match case {
        Ok(case) if case.model.system.is_map() => {
            let message = "the case is a map, and derivatives are timed along flows";
            Err(vec![files::plain(path, message, "give a case with a field")])
        }
        Ok(case) => Ok(BenchItem::new(shown, case)),
        Err(error) => Err(diagnostic::of_case(&shown, &text, &error, files::coloured())),
    }
}

fn measured(
    item: &BenchItem,
    amount: &BenchOptions,
    progress: &dyn Fn(f64),
) -> Result<Vec<ClaimMeasurements>, Vec<FileFailure>> {
    measure_item(item, amount, progress).map_err(|error| {
        vec![files::plain(Path::new(&item.name), &error.to_string(), error.help())]
    })
}
