//! Requests of the page.

use serde::Deserialize;

/// A request.
#[derive(Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case")]
pub enum Request {
    /// Verdicts on the claims of a case.
    Check(Source),
    /// Invariants that the case does not state.
    Search(Search),
    /// All known invariants, as a page.
    Report(Source),
    /// Names that formulas may use.
    Names(Source),
    /// List of the cases of the catalogue and of those to start from.
    Cases,
    /// Text of a case of the catalogue, or to start from.
    Show {
        /// Path of the case, or the kind of its system.
        name: String,
    },
}

/// Text of a case.
#[derive(Debug, Deserialize)]
pub struct Source {
    /// Name of the file in reports.
    pub path: String,
    /// Text of the file.
    pub text: String,
}

/// A case to be searched, with limits that count steps: a module has no clock.
#[derive(Debug, Deserialize)]
pub struct Search {
    /// The case.
    #[serde(flatten)]
    pub source: Source,
    /// Highest degree in the velocities of integrals to be counted.
    #[serde(default = "degree")]
    pub degree: u32,
    /// Whether the claims of the case are ignored.
    #[serde(default)]
    pub blind: bool,
    /// Steps of a count in thousands of millions, as many as a machine takes in about a second.
    #[serde(default = "seconds")]
    pub seconds: f64,
    /// Most megabytes of a count.
    #[serde(default = "megabytes")]
    pub megabytes: u64,
}

fn degree() -> u32 {
    4
}

fn seconds() -> f64 {
    5.0
}

fn megabytes() -> u64 {
    300
}
