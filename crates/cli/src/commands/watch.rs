//! `check --watch`: judging again whenever a file changes.

use std::io::{IsTerminal, stdout};
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::{Duration, SystemTime};

use super::limits::signals;
use super::{CheckArgs, CommandOutput, check, files, finish, source};
use crate::report::counted;

/// Time between two looks at the files.
const GLANCE: Duration = Duration::from_millis(250);

/// Clears a terminal, and goes to its first line.
const CLEAR: &str = "\x1b[2J\x1b[H";

/// State of the files: their paths, and when and at what size each was written last.
type Snapshot = Vec<(PathBuf, Option<(SystemTime, u64)>)>;

/// Judges, prints, and waits for a change, until Ctrl-C; the answer is empty then.
pub fn run(options: &CheckArgs) -> Result<CommandOutput, String> {
    if options.paths.iter().any(|path| source::is_standard_input(path)) {
        return Err("error: standard input does not change\n\
                    help: write the case to a file, and give its path"
            .to_string());
    }
    let signal = signals()?;
    let once = CheckArgs { watch: false, ..options.clone() };
    loop {
        let seen = snapshot(&options.paths);
        let answer = check::run(&once);
        if stdout().is_terminal() {
            anstream::print!("{CLEAR}");
        }
        let code = finish(answer);
        let watched = counted(seen.len(), "file");
        anstream::eprintln!("\n{watched} watched; press Ctrl-C to stop");
        while snapshot(&options.paths) == seen {
            if signal.load(Ordering::Relaxed) {
                return Ok(CommandOutput { text: String::new(), code });
            }
            std::thread::sleep(GLANCE);
        }
    }
}

fn snapshot(paths: &[PathBuf]) -> Snapshot {
    let found = files::collect(paths).into_iter();
    let path = |file: files::Found| file.unwrap_or_else(|(path, _)| path);
    let state = |path: PathBuf| {
        let written = std::fs::metadata(&path).ok();
        let written = written.and_then(|own| Some((own.modified().ok()?, own.len())));
        (path, written)
    };
    found.map(path).map(state).collect()
}
