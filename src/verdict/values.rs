//! Judgement of claims that are values.

use super::judge::{CaseReport, JudgeError, Options, judge};
use crate::case::{Case, ClaimError};
use crate::claim::Claim;

/// The reason why claims cannot be judged.
#[derive(Debug, thiserror::Error)]
pub enum ClaimsError {
    /// A claim does not fit the case.
    #[error(transparent)]
    Claim(#[from] ClaimError),
    /// The case cannot be judged.
    #[error(transparent)]
    Judge(#[from] JudgeError),
}

impl Case {
    /// Judges these claims about the case instead of the claims that it has.
    ///
    /// # Errors
    /// A claim does not fit the case, or the case cannot be judged.
    pub fn judge(&self, claims: &[Claim], options: &Options) -> Result<CaseReport, ClaimsError> {
        Ok(judge(&self.with_claims(claims)?, options)?)
    }
}
