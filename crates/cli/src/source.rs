//! Sources of cases: files, standard input, and the catalogue inside the program.

use std::path::Path;

use liouville::case::{Case, CaseError, NotUtf8, Setting, utf8};
use liouville_catalogue::inside;

/// Path that stands for standard input.
const STANDARD_INPUT: &str = "-";

/// Whether a path stands for standard input.
pub fn is_standard_input(path: &Path) -> bool {
    path == Path::new(STANDARD_INPUT)
}

/// Reads a case from a file, from standard input (`-`), or from the catalogue inside the program
/// where there is no such file; also returns its text.
pub fn read(path: &Path, settings: &[Setting]) -> (String, Result<Case, CaseError>) {
    if is_standard_input(path) {
        return Case::read_from(std::io::stdin().lock(), settings);
    }
    match inside(path).as_slice() {
        [(_, text)] if !path.exists() => (text.to_string(), Case::parse(text, settings)),
        _ => Case::read(path, settings),
    }
}

/// Reads a file that an option names, with `help` where it cannot be read.
pub fn text(path: &Path, help: &str) -> Result<String, String> {
    let shown = path.display();
    let bytes = std::fs::read(path)
        .map_err(|error| format!("error: cannot read {shown}: {error}\nhelp: {help}"))?;
    utf8(bytes).map_err(|error| format!("error: {shown}: {error}\nhelp: {}", NotUtf8::HELP))
}
