//! Error of a value that a case rejects.

/// The reason why a case rejects a value: a claim, a name or a bracket.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}: {message}: {remedy}")]
pub struct ClaimError {
    /// Claim, name or bracket that is rejected.
    pub what: String,
    /// Description of the reason.
    pub message: String,
    /// Suggested alternative.
    pub remedy: String,
}

impl ClaimError {
    pub(super) fn new(what: &str, message: impl Into<String>, remedy: &str) -> Self {
        let (what, message) = (what.to_string(), message.into());
        Self { what, message, remedy: remedy.to_string() }
    }
}
