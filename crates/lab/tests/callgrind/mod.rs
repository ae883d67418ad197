//! Counts of instructions by valgrind's callgrind.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Counts the instructions of each call of some functions, whose names begin with `counted_`, in the test
/// `workload` of this program, in order, with a variable of the environment set; fails with the reason if
/// they cannot be counted.
fn counts(variable: &str, value: &str, functions: &[&str]) -> Result<Vec<u64>, String> {
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    let name = format!("{variable} {value}").replace(' ', "-");
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    // Counts are written, and begin again at 0, where a function ends.
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--toggle-collect=*counted_*"])
        .args(functions.iter().map(|own| format!("--dump-after=*{own}*")))
        .arg(format!("--callgrind-out-file={}", file.display()))
        .arg(own)
        .args(["--exact", "workload", "--test-threads=1"])
        .env(variable, value)
        .output()
        .map_err(|error| format!("no valgrind: {error}"))?;
    let mut found = Vec::new();
    for number in 1.. {
        let dump = file.with_extension(number.to_string());
        let Ok(text) = fs::read_to_string(&dump) else { break };
        let total = text.lines().find_map(|line| line.strip_prefix("totals: "));
        found.extend(total.and_then(|count| count.trim().parse::<u64>().ok()));
        let _ = fs::remove_file(&dump);
    }
    let _ = fs::remove_file(&file);
    match found.is_empty() || found.contains(&0) {
        false => Ok(found),
        true => {
            let told = String::from_utf8_lossy(&output.stderr);
            Err(format!("valgrind counted {found:?}: {told}"))
        }
    }
}

/// Counts for several values of a variable, at the same time on all processors. `None`, with the
/// reason on standard output, where nothing can be counted: on another processor, or without
/// valgrind.
pub fn all_counts(variable: &str, values: &[String], functions: &[&str]) -> Option<Vec<Vec<u64>>> {
    if !cfg!(target_arch = "x86_64") {
        println!("counted on x86-64 only");
        return None;
    }
    let next = AtomicUsize::new(0);
    let work = || {
        let mut found = Vec::new();
        while let Some((place, value)) = {
            let place = next.fetch_add(1, Ordering::Relaxed);
            values.get(place).map(|value| (place, value))
        } {
            found.push((place, counts(variable, value, functions)));
        }
        found
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let mut all: Vec<_> = thread::scope(|scope| {
        let started: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        started.into_iter().flat_map(|one| one.join().expect("no panic")).collect()
    });
    all.sort_by_key(|(place, _)| *place);
    let all: Result<Vec<_>, String> = all.into_iter().map(|(_, counts)| counts).collect();
    match all {
        Ok(all) => Some(all),
        Err(reason) if reason.starts_with("no valgrind") => {
            println!("not counted, {reason}");
            None
        }
        Err(reason) => panic!("{reason}"),
    }
}
