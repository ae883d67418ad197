//! Sources of cases: files, standard input, and the catalogue inside the program.

use std::io::ErrorKind;
use std::path::Path;

use liouville::case::{Case, CaseError, NotUtf8, Setting, utf8};
use liouville::formula::nearest;
use liouville_catalogue::{CATALOGUE, inside};

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
    let refused = |message: String, remedy: String| {
        (String::new(), Err(CaseError::of_source(message, remedy)))
    };
    match inside(path).as_slice() {
        _ if path.is_dir() => refused(
            "this is a folder, and one case is needed".to_string(),
            "give a file of this folder".to_string(),
        ),
        _ if path.exists() => Case::read(path, settings),
        [(_, text)] => (text.to_string(), Case::parse(text, settings)),
        [] => match std::fs::metadata(path) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                refused(format!("cannot read the file: {error}"), no_file(path, ONE_CASE))
            }
            _ => Case::read(path, settings),
        },
        [(first, _), ..] => refused(
            "this is a folder of the catalogue, and one case is needed".to_string(),
            format!("give one case, such as {}", short(first)),
        ),
    }
}

/// Advice where a command takes one case.
const ONE_CASE: &str =
    "give a case file, or a case of `liouville cases list`; `liouville new` writes a file";

/// Advice where there is no file of this name: the case of the catalogue that is meant, or `otherwise`.
pub fn no_file(path: &Path, otherwise: &str) -> String {
    let written = path.to_string_lossy();
    let file = path.with_extension("toml");
    if path.extension().is_none() && file.is_file() {
        return format!("did you mean {}?", file.display());
    }
    let names = CATALOGUE.iter().map(|(name, _)| short(name));
    match nearest(short(&written), names) {
        Some(name) => format!("did you mean `{name}`, a case of the catalogue?"),
        None => otherwise.to_string(),
    }
}

/// Name of a case of the catalogue without `cases/` and `.toml`.
fn short(name: &str) -> &str {
    let name = name.strip_prefix("./").unwrap_or(name);
    let name = name.strip_prefix("cases/").unwrap_or(name);
    name.strip_suffix(".toml").unwrap_or(name)
}

/// Reads a file that an option names, with `help` where it cannot be read.
pub fn text(path: &Path, help: &str) -> Result<String, String> {
    let shown = path.display();
    let bytes = std::fs::read(path)
        .map_err(|error| format!("error: cannot read {shown}: {error}\nhelp: {help}"))?;
    utf8(bytes).map_err(|error| format!("error: {shown}: {error}\nhelp: {}", NotUtf8::HELP))
}
