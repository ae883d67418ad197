//! Mutated formulas and case files, read and judged in this process.

mod mutation;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};
use std::{env, fs, io};

use liouville::case::Case;
use liouville::verdict::Options;
use mutation::{Corpus, Random};

/// Time that one input may take before it is kept as a slow one.
const SLOW: Duration = Duration::from_secs(2);

/// Time that a judgement may take.
const PATIENCE: Duration = Duration::from_secs(20);

fn main() -> ExitCode {
    match run() {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}\nusage: fuzz [INPUTS [SEED [judge]]]");
            ExitCode::from(2)
        }
    }
}

fn run() -> io::Result<u64> {
    let mut arguments = env::args().skip(1);
    let mut number = |default: u64| match arguments.next() {
        None => Ok(default),
        Some(text) => text.parse().map_err(io::Error::other),
    };
    let (inputs, seed) = (number(1_000_000)?, number(1)?);
    let judges = env::args().nth(3).is_some_and(|word| word == "judge");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let corpus = Corpus::read(&[root.join("../../cases"), root.join("corpus")])?;
    let found = root.join("found");
    fs::create_dir_all(&found)?;
    let mut random = Random::new(seed);
    let started = Instant::now();
    let (mut failures, mut valid, mut slowest) = (0, 0u64, Duration::ZERO);
    for index in 0..inputs {
        let text = corpus.input(&mut random);
        let begun = Instant::now();
        let outcome = match judges {
            false => read(&text),
            true => {
                fs::write(found.join("last.toml"), &text)?;
                judged(&text)
            }
        };
        let took = begun.elapsed();
        slowest = slowest.max(took);
        match outcome {
            Outcome::Valid => valid += 1,
            Outcome::Refused => {}
            Outcome::Failed => {
                failures += 1;
                keep(&found, "failed", seed, index, &text)?;
            }
        }
        if took > SLOW {
            failures += u64::from(!judges);
            keep(&found, "slow", seed, index, &text)?;
        }
        if index % 100_000 == 99_999 {
            eprintln!("{} inputs, {failures} failures", index + 1);
        }
    }
    println!(
        "{inputs} inputs, {valid} of them valid, {failures} failures; slowest {:.2} s; {:.0} s",
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
