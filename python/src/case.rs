//! Cases as Python objects.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use liouville::case::{CaseError, Setting};
use liouville::formula::canonical_name;
use liouville::mechanics::ParameterOrigin;
use liouville_cli::report::CaseDigest;
use liouville_cli::source;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::errors;
use super::work::Work;

/// A case with its text.
#[pyclass(frozen, module = "liouville._liouville")]
pub struct Case {
    /// Case as it was read.
    pub inner: Arc<liouville::case::Case>,
    /// Name of its file, for messages.
    pub name: String,
    /// Text of its file.
    pub text: String,
}

/// Values of parameters by name.
type Settings = Vec<(String, String)>;

#[pymethods]
impl Case {
    /// Reads the text of a case.
    #[new]
    fn new(py: Python<'_>, text: String, name: String, settings: Settings) -> PyResult<Self> {
        Self::read(py, name, settings, move |settings| {
            let case = liouville::case::Case::parse(&text, settings);
            (text, case)
        })
    }

    /// Reads the file of a case, or a case of the catalogue where there is no such file.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf, settings: Settings) -> PyResult<Self> {
        let name = path.display().to_string();
        Self::read(py, name, settings, move |settings| source::read(Path::new(&path), settings))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    #[getter]
    fn title(&self) -> &str {
        &self.inner.title
    }

    #[getter]
    fn source(&self) -> &str {
        &self.inner.source
    }

    #[getter]
    fn system(&self) -> &str {
        &self.inner.system
    }

    #[getter]
    fn digest(&self) -> String {
        CaseDigest::of(&self.text).to_string()
    }

    /// Warnings and remarks of the reader.
    #[getter]
    fn remarks(&self) -> Vec<String> {
        let remarks = self.inner.remarks.iter().map(ToString::to_string);
        self.inner.warnings.iter().cloned().chain(remarks).collect()
    }

    /// Names of the state's components.
    #[getter]
    fn state(&self) -> Vec<String> {
        let model = &self.inner.model;
        (0..model.dimension()).map(|place| model.component_name(place)).collect()
    }

    /// Names of the parameters, each with its origin: `fixed`, `drawn` or `computed`.
    #[getter]
    fn parameters(&self) -> Vec<(String, &'static str)> {
        let origin = |origin: &ParameterOrigin| match origin {
            ParameterOrigin::Fixed(_) => "fixed",
            ParameterOrigin::Free(_) => "drawn",
            ParameterOrigin::Formula(_) => "computed",
        };
        let parameters = self.inner.model.parameters.iter();
        parameters.map(|own| (own.name.clone(), origin(&own.origin))).collect()
    }

    /// Names of all claims, with their kinds and formulas.
    #[getter]
    fn claims(&self) -> Vec<(String, &'static str, Option<String>)> {
        let case = &self.inner;
        let claims = case.claims.iter();
        let claims = claims.map(|own| (own.name.clone(), own.kind.name(), own.kind.text()));
        let absences = case.absences.iter().map(|own| (own.name.clone(), own.kind.name(), None));
        let motions = case.motions.iter().map(|own| (own.name.clone(), own.kind.name(), None));
        claims.chain(absences).chain(motions).collect()
    }
}

impl Case {
    fn read(
        py: Python<'_>,
        name: String,
        settings: Settings,
        read: impl FnOnce(&[Setting]) -> (String, Result<liouville::case::Case, CaseError>)
        + Send
        + 'static,
    ) -> PyResult<Self> {
        let settings = canonical(settings)?;
        let (text, case) = Work::on(Some(1)).alone(py, move || read(&settings))?;
        match case {
            Ok(case) => Ok(Self { inner: Arc::new(case), name, text }),
            Err(error) => Err(errors::of_case(py, &name, &text, &error)),
        }
    }
}

/// Settings with canonical names, each once.
fn canonical(settings: Settings) -> PyResult<Vec<Setting>> {
    let mut all: Vec<Setting> = Vec::new();
    for (name, value) in settings {
        let name = canonical_name(&name).unwrap_or(name);
        if all.iter().any(|other| other.name == name) {
            return Err(PyValueError::new_err(format!("`{name}` is given two values")));
        }
        all.push(Setting { name, value });
    }
    Ok(all)
}
