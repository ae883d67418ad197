//! Actions on a cell, and the errors they rest on.

use super::rewrite::Rewrite;
use super::trial::{Certificate, TrialResult, both};

/// The next action on a cell.
pub enum Next {
    /// Rewrite the cell, at the cost of a certificate.
    Rewrite(Vec<Rewrite>, Option<Certificate>),
    /// Divide the cell by the sign of X, the argument of the modulus at a place.
    Divide {
        /// Place of |X|.
        modulus: usize,
        /// Place of X.
        argument: usize,
    },
    /// Divide the cell by the value of a sign input.
    DivideInput(usize),
    /// Drop the cell: no real inputs lie in it, up to the bounded probability.
    Empty(Option<Certificate>),
    /// Keeps the findings of the test.
    Tested(Vec<Option<TrialResult>>),
}

impl Next {
    /// Adds the error of relations on which the action rests. A division rests on none: it is right
    /// at any value.
    pub fn given(self, related: Option<Certificate>) -> Self {
        let Some(error) = related else { return self };
        let zero = |result| match result {
            TrialResult::Zero(own) => TrialResult::Zero(own.and(error)),
            other => other,
        };
        match self {
            Next::Rewrite(rewrites, own) => Next::Rewrite(rewrites, both(own, related)),
            Next::Empty(own) => Next::Empty(both(own, related)),
            Next::Tested(results) => {
                Next::Tested(results.into_iter().map(|result| result.map(zero)).collect())
            }
            division => division,
        }
    }
}

/// Makes a silent finding for all groups.
pub fn silent(count: usize, reason: &str) -> Vec<Option<TrialResult>> {
    vec![Some(TrialResult::Silent(reason.to_string())); count]
}

/// Combines the findings for two choices of signs.
pub fn for_both(a: TrialResult, b: TrialResult) -> TrialResult {
    match (a, b) {
        (TrialResult::Zero(a), TrialResult::Zero(b)) => TrialResult::Zero(a.and(b)),
        (TrialResult::Silent(reason), _) | (_, TrialResult::Silent(reason)) => {
            TrialResult::Silent(reason)
        }
        _ => TrialResult::NonZero,
    }
}
