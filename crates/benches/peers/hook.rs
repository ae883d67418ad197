//! Figures of peers beside ours, by the scripts in this folder, where Python has heyoka.
//!
//! `LIOUVILLE_PYTHON` names the interpreter (`python3`), `LIOUVILLE_PROGRAM` the program to compare
//! (`target/release/liouville`).

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Runs a script of this folder, which prints its comparison; says what is missing otherwise.
pub fn print(script: &str) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("peers");
    let python = std::env::var("LIOUVILLE_PYTHON").unwrap_or_else(|_| "python3".to_string());
    let program = std::env::var_os("LIOUVILLE_PROGRAM").map_or_else(built, PathBuf::from);
    let mut question = Command::new(&python);
    question.args(["-c", "import heyoka"]).stdout(Stdio::null()).stderr(Stdio::null());
    let missing = if !question.status().is_ok_and(|status| status.success()) {
        format!("`{python}` has no heyoka; install peers/requirements.txt and set LIOUVILLE_PYTHON")
    } else if !program.is_file() {
        format!("no program at {}; run `cargo build --release` first", program.display())
    } else {
        match Command::new(&python).arg(folder.join(script)).arg(&program).status() {
            Ok(status) if status.success() => return,
            Ok(status) => format!("{script} ended with {status}"),
            Err(error) => format!("{script}: {error}"),
        }
    };
    println!("peers not compared: {missing}");
}

/// Place of the program that `cargo build --release` makes.
fn built() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/release/liouville")
}
