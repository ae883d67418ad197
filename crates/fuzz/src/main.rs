//! Mutated formulas and case files, read and judged in this process, and command lines for the
//! program.

mod arguments;
mod mutation;

use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};
use std::{env, fs, io};

use arguments::Lines;
use liouville::case::Case;
use liouville::verdict::Options;
use mutation::{Corpus, Random};

/// Time that a judgement may take.
const PATIENCE: Duration = Duration::from_secs(20);

/// Use that is made of the inputs.
#[derive(Clone, Copy, PartialEq)]
enum Mode {
    Read,
    Judge,
    Arguments,
}

impl Mode {
    /// Time that one input may take before it is kept as a slow one.
    fn slow(self) -> Duration {
        Duration::from_secs(if self == Self::Arguments { 10 } else { 2 })
    }
}

fn main() -> ExitCode {
    let usage = "usage: fuzz [INPUTS or FROM..TO [SEED [judge|arguments]]]";
    match arguments().map(|(inputs, seed, mode)| run(inputs, seed, mode)) {
        Some(Ok(0)) => ExitCode::SUCCESS,
        Some(Ok(_)) => ExitCode::FAILURE,
        Some(Err(error)) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
        None => {
            eprintln!("{usage}");
            ExitCode::from(2)
        }
    }
}

fn arguments() -> Option<(Range<u64>, u64, Mode)> {
    let words: Vec<String> = env::args().skip(1).collect();
    let inputs = match words.first().map(String::as_str) {
        None => 0..1_000_000,
        Some(word) => match word.split_once("..") {
            Some((from, to)) => from.parse().ok()?..to.parse().ok()?,
            None => 0..word.parse().ok()?,
        },
    };
    let seed = words.get(1).map_or(Some(1), |word| word.parse().ok())?;
    let mode = match words.get(2).map(String::as_str) {
        None => Mode::Read,
        Some("judge") => Mode::Judge,
        Some("arguments") => Mode::Arguments,
        Some(_) => return None,
    };
    Some((inputs, seed, mode))
}

fn run(inputs: Range<u64>, seed: u64, mode: Mode) -> io::Result<u64> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let found = root.join("found");
    fs::create_dir_all(&found)?;
    let corpus = Corpus::read(&[root.join("../../cases"), root.join("corpus")])?;
    let lines = match mode {
        Mode::Arguments => Some(Lines::of_program(&found)?),
        Mode::Read | Mode::Judge => None,
    };
    let started = Instant::now();
    let (mut failures, mut valid, mut slowest) = (0, 0u64, Duration::ZERO);
    for index in inputs.clone() {
        let random = &mut Random::new(seed, index);
        let begun;
        let (text, outcome) = match &lines {
            Some(lines) => {
                let line = lines.input(random);
                begun = Instant::now();
                let (outcome, printed) = lines.run(&line)?;
                (format!("{line:?}\n{printed}"), outcome)
            }
            None => {
                let text = corpus.input(random);
                if mode == Mode::Judge {
                    fs::write(found.join("last.toml"), &text)?;
                }
                begun = Instant::now();
                let outcome = if mode == Mode::Judge { judged(&text) } else { read(&text) };
                (text, outcome)
            }
        };
        let took = begun.elapsed();
        slowest = slowest.max(took);
        valid += u64::from(outcome == Outcome::Valid);
        if outcome == Outcome::Failed {
            failures += 1;
            keep(&found, "failed", seed, index, &text)?;
        } else if mode != Mode::Judge && took > mode.slow() {
            failures += 1;
            keep(&found, "slow", seed, index, &text)?;
        }
        let done = index + 1 - inputs.start;
        if let Some(lines) = lines.as_ref().filter(|_| done.is_multiple_of(1000)) {
            lines.tidy()?;
        }
        if done.is_multiple_of(if mode == Mode::Read { 100_000 } else { 1000 }) {
            eprintln!("{done} inputs, {failures} failures");
        }
    }
    println!(
        "{} inputs, {valid} of them valid, {failures} failures; slowest {:.2} s; {:.0} s",
        inputs.end.saturating_sub(inputs.start),
        slowest.as_secs_f64(),
        started.elapsed().as_secs_f64()
    );
    Ok(failures)
}

/// Outcome of one input.
#[derive(Clone, Copy, PartialEq)]
enum Outcome {
    /// A case, read and perhaps judged.
    Valid,
    /// A mistake, with its message.
    Refused,
    /// A panic, or a mistake without a remedy.
    Failed,
}

/// Reads a text; every mistake has to have a message.
fn read(text: &str) -> Outcome {
    let read = || match Case::parse(text, &[]) {
        Ok(_) => Outcome::Valid,
        Err(error) => match error.mistakes().iter().all(|mistake| !mistake.message().is_empty()) {
            true => Outcome::Refused,
            false => Outcome::Failed,
        },
    };
    catch_unwind(AssertUnwindSafe(read)).unwrap_or(Outcome::Failed)
}

/// Reads and judges a text in a thread of its own, which is left behind if it takes too long.
fn judged(text: &str) -> Outcome {
    let (sender, receiver) = channel();
    let text = text.to_string();
    let thread = std::thread::spawn(move || {
        let judge = || match Case::parse(&text, &[]) {
            Err(_) => Outcome::Refused,
            Ok(case) => {
                let options = Options { states: 64, ..Options::default() };
                // whatever the verdicts are, they come without a panic
                _ = liouville_search::judge(&case, &options);
                Outcome::Valid
            }
        };
        let outcome = catch_unwind(AssertUnwindSafe(judge)).unwrap_or(Outcome::Failed);
        // nobody waits any more if this fails
        _ = sender.send(outcome);
    });
    drop(thread);
    receiver.recv_timeout(PATIENCE).unwrap_or(Outcome::Valid)
}

fn keep(folder: &Path, word: &str, seed: u64, index: u64, text: &str) -> io::Result<()> {
    let path: PathBuf = folder.join(format!("{word}-{seed}-{index}.toml"));
    eprintln!("{}", path.display());
    fs::write(path, text)
}
