//! Expectations of claims.

use serde::Serialize;

/// Expectation of a claim by its author.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Expect {
    /// The claim is true.
    #[default]
    Holds,
    /// The claim is false.
    Fails,
    /// The answer is not known; any verdict agrees.
    Open,
}

impl Expect {
    /// Word used in case files and reports.
    pub fn word(self) -> &'static str {
        match self {
            Expect::Holds => "holds",
            Expect::Fails => "fails",
            Expect::Open => "open",
        }
    }
}
