//! The native part of the Python package `liouville`.
//!
//! It hands over text, JSON and bytes; `liouville/*.py` makes objects and arrays of them.

mod answers;
mod case;
mod errors;
mod function;
mod judge;
mod motion;
mod parts;
mod program;
mod start;
mod work;

use std::ffi::OsString;

use pyo3::prelude::*;

/// The module `liouville._liouville`.
#[pymodule]
mod _liouville {
    #[pymodule_export]
    use super::answers::answer;
    #[pymodule_export]
    use super::canonical;
    #[pymodule_export]
    use super::case::Case;
    #[pymodule_export]
    use super::catalogue;
    #[pymodule_export]
    use super::function::{Function, function, parameter_values};
    #[pymodule_export]
    use super::judge::{check, report, search};
    #[pymodule_export]
    use super::motion::{chart, exponents, orbits, section, surface};
    #[pymodule_export]
    use super::parts::{Job, save};
    #[pymodule_export]
    use super::program::program;
    #[pymodule_export]
    use super::run;

    #[pymodule_export]
    const VERSION: &str = liouville_cli::report::VERSION;
}

/// Runs the command with these arguments, and returns its exit code.
#[pyfunction]
fn run(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| liouville_cli::run(arguments))
}

/// Names of the cases inside the package.
#[pyfunction]
fn catalogue() -> Vec<&'static str> {
    let short = |name: &'static str| {
        let name = name.strip_prefix("cases/").unwrap_or(name);
        name.strip_suffix(".toml").unwrap_or(name)
    };
    liouville_catalogue::CATALOGUE.iter().map(|(name, _)| short(name)).collect()
}

/// Canonical form of a name, in which cases know it; `None` if the text is not one.
#[pyfunction]
fn canonical(name: &str) -> Option<String> {
    liouville::formula::canonical_name(name)
}
