//! Operations that a system's formulas contain, and that its recorded field does without.
//!
//! 0·ln x is recorded as 0, and √x·√x as x; as written they have values for x > 0 alone. A proof about
//! a motion includes the operations that were left out, so that it ends where one has no value.

use crate::error::FlowError;
use crate::motion::recorded::{point, program};
use crate::taylor::program::TaylorProgram;
use liouville::graph::{Expr, record};
use liouville::mechanics::{Model, Phase};
use liouville::number::rational::Rational;

/// Formulas of the system and of its parameters, recorded as written; those that have a value
/// everywhere are left out.
pub fn as_written(phase: &Phase<'_, Expr>) -> Vec<Expr> {
    phase.literal_values(phase.model().equations_of_motion())
}

/// Compiles a model's field with the operations that were left out of it as rates of further
/// components, so that steps are as short as they need.
pub fn guarded_program(model: &Model, parameters: &[Rational]) -> Result<TaylorProgram, FlowError> {
    let field = program(model, parameters, |_| Vec::new())?;
    let (graph, (mut rates, written)) = record(model.dimension(), |state| {
        let phase = point(model, parameters, state);
        (phase.field().to_vec(), as_written(&phase))
    })?;
    let left_out = graph.left_out(&rates, &written);
    if left_out.is_empty() {
        return Ok(field);
    }
    rates.extend(left_out);
    TaylorProgram::compile(&graph, &rates, &[])
}
