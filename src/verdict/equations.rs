//! Size of the recorded equations of motion, and the shares of the parts that a case may leave out.

use crate::case::Case;
use crate::graph::{Fault, record};
use crate::mechanics::{EquationPart, Model, Phase};

/// Size of the recorded equations of motion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EquationsSize {
    /// Number of operations of the rates of all state variables.
    pub operations: usize,
    /// Parts that a system of this kind may have, each with its number of operations: those that
    /// go when the part is left out. `None` where the case has none of it.
    pub parts: Vec<(EquationPart, Option<usize>)>,
}

/// Records the equations of motion of a case, as they are and without each of their parts.
pub fn equations_size(case: &Case) -> Result<EquationsSize, Fault> {
    let operations = field_operations(&case.model)?;
    let mut parts = Vec::new();
    for part in case.model.system.possible_parts() {
        let share = match case.model.system.without(*part) {
            None => None,
            Some(system) => {
                let rest = field_operations(&Model { system, ..case.model.clone() })?;
                Some(operations.saturating_sub(rest))
            }
        };
        parts.push((*part, share));
    }
    Ok(EquationsSize { operations, parts })
}

/// Counts the operations of the field.
fn field_operations(model: &Model) -> Result<usize, Fault> {
    let inputs = model.free_components() + model.dimension();
    let (graph, field) = record(inputs, |inputs| {
        let (parameters, state) = inputs.split_at(model.free_components());
        Phase::new(model, parameters, state).field().to_vec()
    })?;
    Ok(graph.operations(&field))
}
