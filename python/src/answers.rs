//! Commands about closed orbits, diagrams and rotation numbers, answered in JSON.

use liouville_cli::answers;
use liouville_cli::jobs::Given;
use pyo3::prelude::*;

use super::case::Case;
use super::errors;
use super::work::Work;

/// Carries out a command about motions; returns what it prints with `--json`. `table` is the text
/// of the file of `--starts`.
#[pyfunction]
pub fn answer(
    py: Python<'_>,
    case: &Case,
    settings: Vec<String>,
    arguments: Vec<String>,
    table: Option<String>,
    threads: Option<usize>,
) -> PyResult<String> {
    let (name, text) = (case.name.clone(), case.text.clone());
    let found = Work::on(threads).alone(py, move || {
        let table = table.as_deref();
        let given = Given { name: &name, text: &text, settings: &settings, table };
        answers::motion(&arguments, given)
    })?;
    found.map_err(|message| errors::of_answer(py, &message))
}
