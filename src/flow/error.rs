//! Why a motion cannot be computed.

use crate::graph::Fault;
use crate::number::Function;

/// Why a motion cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FlowError {
    /// The field contains a function that has no Taylor series.
    #[error("the field contains {0}, which has no Taylor series where it changes its sign")]
    NotAnalytic(&'static str),
    /// The field contains an antiderivative, whose value is not known.
    #[error("the field contains ∫, whose value is not determined")]
    Antiderivative,
    /// The steps become too small, or values are no longer finite.
    #[error("the motion runs into a singularity at t = {time}, near the state {state:?}")]
    Singular {
        /// When.
        time: f64,
        /// Where.
        state: Vec<f64>,
    },
    /// No state on the level set was found.
    #[error("no state on the level set was found near the one that was asked for")]
    NoStart,
    /// The equations cannot be recorded.
    #[error("{0}")]
    Recording(#[from] Fault),
}

impl FlowError {
    /// What to do about it.
    pub fn help(&self) -> &'static str {
        match self {
            FlowError::NotAnalytic(_) => "write the field without it, on one side of its zero",
            FlowError::Antiderivative => "write the function itself instead of ∫(f, x)",
            FlowError::Singular { .. } => "choose another start, or a shorter time",
            FlowError::NoStart => "give a state by --state, or another --seed or --index",
            FlowError::Recording(_) => "use operations that hold for every number",
        }
    }

    /// The complaint about a function without a Taylor rule.
    pub(super) fn of_function(function: Function) -> Self {
        match function {
            Function::Abs => FlowError::NotAnalytic("|x|"),
            _ => FlowError::NotAnalytic("a function"),
        }
    }
}
