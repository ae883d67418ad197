//! Errors as exceptions of the module `liouville.errors`.

use std::ops::Range;

use liouville::case::CaseError;
use liouville::formula::FormulaError;
use liouville::verdict::JudgeError;
use liouville_cli::report::{FileFailure, diagnostic};
use liouville_flow::{AxisMistake, ChoiceError, FlowError, FormulaMistake};
use liouville_search::SearchError;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// Makes an exception of the class with this name.
fn exception<'py>(
    py: Python<'py>,
    class: &str,
    arguments: impl pyo3::call::PyCallArgs<'py>,
) -> PyErr {
    let made = py
        .import("liouville.errors")
        .and_then(|module| module.getattr(class))
        .and_then(|class| class.call1(arguments));
    match made {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}

/// Exception about mistakes in a text, each at its place.
fn of_failures(py: Python<'_>, class: &str, failures: Vec<FileFailure>) -> PyErr {
    let mistakes: Vec<_> = failures
        .into_iter()
        .map(|one| (one.message, one.help, one.line, one.column, one.rendered))
        .collect();
    exception(py, class, (mistakes,))
}

/// Exception about the mistakes of a case.
pub fn of_case(py: Python<'_>, name: &str, text: &str, error: &CaseError) -> PyErr {
    of_failures(py, "CaseError", diagnostic::of_case(name, text, error, false))
}

/// Exception about a case that cannot be judged.
pub fn of_judging(py: Python<'_>, name: &str, text: &str, error: &JudgeError) -> PyErr {
    of_failures(py, "CaseError", vec![diagnostic::of_judging(name, text, error, false)])
}

/// Exception about a formula given as an argument.
fn of_argument(
    py: Python<'_>,
    (argument, text): (&str, &str),
    span: Range<usize>,
    message: &str,
    help: Option<&str>,
) -> PyErr {
    let failure = diagnostic::of_option(argument, text, span, message, help, false);
    of_failures(py, "FormulaError", vec![failure])
}

/// Exception about a formula.
pub fn of_formula(py: Python<'_>, text: &str, error: &FormulaError) -> PyErr {
    of_argument(py, ("formula", text), error.span(), error.message(), error.help())
}

/// Exception about a formula for a motion.
pub fn of_mistake(py: Python<'_>, argument: &str, text: &str, mistake: &FormulaMistake) -> PyErr {
    let (message, help) = (&mistake.message, mistake.help.as_deref());
    of_argument(py, (argument, text), mistake.span.clone(), message, help)
}

/// Exception about an axis of a chart.
pub fn of_axis(py: Python<'_>, argument: &str, text: &str, mistake: &AxisMistake) -> PyErr {
    let (message, help) = (&mistake.message, Some(mistake.help.as_str()));
    of_argument(py, (argument, text), 0..text.len(), message, help)
}

/// Exception about a motion.
pub fn of_flow(py: Python<'_>, error: &FlowError) -> PyErr {
    exception(py, "MotionError", (error.to_string(), in_python(error.help())))
}

/// Exception about a section that is not determined.
pub fn of_choice(py: Python<'_>, error: &ChoiceError) -> PyErr {
    let help = match error {
        ChoiceError::Unknown(what) => {
            let name = if *what == "angle" { "g0" } else { what };
            format!("give {name}=, or add [section] with g0 and energy to the case")
        }
        ChoiceError::NoStart => "give start=(l, L/G)".to_string(),
        ChoiceError::TwoStarts => "leave one of them out".to_string(),
        ChoiceError::Flow(error) => in_python(error.help()),
    };
    exception(py, "MotionError", (error.to_string(), help))
}

/// Exception about a search.
pub fn of_search(py: Python<'_>, error: &SearchError) -> PyErr {
    exception(py, "SearchError", (error.to_string(), in_python(error.help())))
}

/// Exception about a command on motions, by the message that the command prints.
pub fn of_answer(py: Python<'_>, message: &str) -> PyErr {
    let message = message.strip_prefix("error: ").unwrap_or(message);
    let (message, help) = message.rsplit_once("help: ").unwrap_or((message, ""));
    // the marks of a terminal around the message
    let lines = message.lines().filter(|line| !line.trim().is_empty() && line.trim() != "|");
    let lines: Vec<&str> = lines.filter(|line| !line.trim().starts_with("= note: in ")).collect();
    let message = lines.join("\n");
    let message = message.trim_end_matches([' ', '=', '\n']);
    exception(py, "MotionError", (message.to_string(), in_python(help.trim_end())))
}

/// Exception about output that cannot be written.
pub fn of_output(error: &dyn std::error::Error) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

/// Advice with the names of arguments in place of options.
fn in_python(help: &str) -> String {
    help.replace("--section", "surface=")
        .replace("--state", "start=")
        .replace("--from and --to", "range=")
        .replace("--ansatz=4", "ansatz=4")
        .replace("--", "")
}
