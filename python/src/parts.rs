//! Jobs in parts: the files that `--part` writes, and what is merged from them.

use std::path::PathBuf;
use std::sync::Arc;

use liouville::part::Part;
use liouville_cli::jobs::{AnyJob, Given, SectionUnit};
use liouville_cli::parts::{Identity, Job as _, PartFile, Set, check};
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;

use super::case::Case;
use super::motion::{Chart, Crossings, of_chart, of_section, of_surface};
use super::work::Work;

/// A job that may be computed in parts, by the arguments of its command.
#[pyclass(frozen, module = "liouville._liouville")]
pub struct Job {
    inner: Arc<AnyJob>,
    identity: Identity,
}

/// Error about a job, without the marks of the terminal.
fn wrong(message: String) -> PyErr {
    let message = message.strip_prefix("error: ").unwrap_or(&message);
    PyValueError::new_err(message.replace("\nhelp: ", "\n"))
}

fn part(index: u64, count: u64) -> PyResult<Part> {
    Part::new(index, count).ok_or_else(|| PyValueError::new_err("there is no such part"))
}

/// Puts the texts of parts together.
fn set(texts: Vec<String>) -> PyResult<Set> {
    let named = texts.into_iter().zip(1..);
    let files: Vec<PartFile> =
        named.map(|(text, number)| PartFile { name: format!("part {number}"), text }).collect();
    Set::new(&files, "FOLDER").map_err(wrong)
}

#[pymethods]
impl Job {
    /// Reads a job about a case. `table` is the text of the file of `--starts` or `--settings`.
    #[new]
    fn new(
        py: Python<'_>,
        case: &Case,
        settings: Vec<String>,
        arguments: Vec<String>,
        table: Option<String>,
    ) -> PyResult<Self> {
        let (name, text) = (case.name.clone(), case.text.clone());
        let read = move || {
            let table = table.as_deref();
            let given = Given { name: &name, text: &text, settings: &settings, table };
            let job = AnyJob::read(&arguments, given, None)?;
            job.identity().map(|identity| (job, identity))
        };
        let (inner, identity) = Work::on(Some(1)).alone(py, read)?.map_err(wrong)?;
        Ok(Self { inner: Arc::new(inner), identity })
    }

    #[getter]
    fn key(&self) -> String {
        self.identity.key()
    }

    #[getter]
    fn units(&self) -> u64 {
        self.identity.units
    }

    /// Name of the file of a part.
    fn file_name(&self, index: u64, count: u64) -> PyResult<String> {
        Ok(self.identity.file_name(part(index, count)?, self.inner.form().ending()))
    }

    /// Whether a text is that of a part of this job, and whole.
    fn is_part(&self, index: u64, count: u64, text: &str) -> PyResult<bool> {
        Ok(check(text, &self.identity, part(index, count)?, &self.inner.form()).is_ok())
    }

    /// Computes a part; returns the text of its file.
    fn part(
        &self,
        py: Python<'_>,
        index: u64,
        count: u64,
        threads: Option<usize>,
    ) -> PyResult<String> {
        let (part, inner) = (part(index, count)?, Arc::clone(&self.inner));
        let work = Work::on(threads);
        let threads = work.threads();
        let file = work.alone(py, move || inner.file(part, threads))?;
        file.map(|file| file.text).map_err(wrong)
    }

    /// Report of all parts, as the command prints it.
    fn report(&self, py: Python<'_>, texts: Vec<String>) -> PyResult<String> {
        let (set, inner) = (set(texts)?, Arc::clone(&self.inner));
        let answer = Work::on(None).alone(py, move || inner.report(&set))?;
        answer.map(|answer| answer.text).map_err(wrong)
    }

    /// Cells of a chart from all of its parts.
    fn chart<'py>(&self, py: Python<'py>, texts: Vec<String>) -> PyResult<Chart<'py>> {
        let AnyJob::Chart(job) = self.inner.as_ref() else {
            return Err(PyTypeError::new_err("this job is no chart"));
        };
        let cells = job.units(&set(texts)?).map_err(wrong)?;
        Ok(of_chart(py, job.names().clone(), &job.request().axes, &cells))
    }

    /// Crossings of a section from all of its parts.
    fn section<'py>(&self, py: Python<'py>, texts: Vec<String>) -> PyResult<Crossings<'py>> {
        let AnyJob::Section(job) = self.inner.as_ref() else {
            return Err(PyTypeError::new_err("this job is no section"));
        };
        let units = job.units(&set(texts)?).map_err(wrong)?;
        let (mut own, mut others) = (Vec::new(), Vec::new());
        for unit in units {
            match unit {
                SectionUnit::Andoyer { orbit, .. } => own.push(orbit),
                SectionUnit::Surface { orbit, .. } => others.push(orbit),
            }
        }
        Ok(match job.axes().map_err(wrong)? {
            Some(titles) => of_surface(py, titles, &others),
            None => of_section(py, &own),
        })
    }

    /// Exponents from all parts, as `exponents --json` prints them.
    fn exponents(&self, texts: Vec<String>) -> PyResult<String> {
        let AnyJob::Exponents(job) = self.inner.as_ref() else {
            return Err(PyTypeError::new_err("this job measures no exponents"));
        };
        let units = job.units(&set(texts)?).map_err(wrong)?;
        job.written(units).map(|(_, json)| json).map_err(wrong)
    }
}

/// Writes the file of a part whole or not at all.
#[pyfunction]
pub fn save(py: Python<'_>, folder: PathBuf, name: String, text: String) -> PyResult<()> {
    let file = PartFile { name, text };
    py.detach(|| liouville_cli::parts::save(&folder, &file)).map_err(|error| {
        PyRuntimeError::new_err(format!("cannot write to {}: {error}", folder.display()))
    })
}
