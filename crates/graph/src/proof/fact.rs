//! Signs that values have wherever a claim is to hold.

/// A sign that a value has wherever the claim is to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SignFact {
    /// x > 0
    Positive,
    /// x ≥ 0
    NotNegative,
}
