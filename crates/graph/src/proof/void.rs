//! Values that do not exist on a cell, or have no image in a prime field.

use crate::graph::Expr;

use super::cells::Cell;
use super::explore::Explorer;
use super::lower::Algebraic;
use super::symbols::transcendental;
use super::tower::Tower;
use super::trial::{Roots, Trial};

/// Whether a group may have no value on a cell, though it does not show it: a value has none, or is a
/// function of one that may have none.
pub fn may_be_void(cell: &Cell) -> bool {
    let all = vec![true; cell.graph.len()];
    cell.values.iter().any(|value| cell.graph.is_nowhere_defined(*value))
        || transcendental(&cell.graph, &all).next().is_some()
}

impl Explorer<'_> {
    /// Whether a function in a group has an argument that exists nowhere on a cell: the symbol in the
    /// place of the function would hide that.
    pub(super) fn has_void_argument(
        &self,
        cell: &Cell,
        algebraic: &Algebraic<'_>,
        trial: &Trial<'_>,
        tower: &Tower,
        group: &[Expr],
    ) -> bool {
        let (graph, special) = (self.question.graph, self.question.special);
        let reached = graph.reached(group.iter().copied());
        let own: Vec<Expr> = special
            .iter()
            .zip(&cell.values)
            .filter_map(|(place, value)| reached[*place].then_some(*value))
            .collect();
        if own.iter().any(|value| cell.graph.is_nowhere_defined(*value)) {
            return true;
        }
        let reached = cell.graph.reached(own.iter().copied());
        let lowered = |place: usize| algebraic.values[place];
        let arguments: Vec<Expr> = transcendental(&cell.graph, &reached)
            .flat_map(|(_, step)| step.arguments().collect::<Vec<_>>())
            .filter(|place| !cell.graph.is_always_defined(cell.graph.at(*place)))
            .filter_map(lowered)
            .collect();
        let given: Vec<Expr> =
            own.iter().filter_map(|value| lowered(cell.graph.place(*value))).collect();
        let roots = Roots { nested: tower.nested, fixed: &[] };
        !arguments.is_empty() && trial.is_void(&arguments, &given, roots)
    }
}

/// Whether a value has none in a prime field, though it has one on the cell.
pub fn is_lost(cell: &Cell, algebraic: &Algebraic<'_>, value: Expr) -> bool {
    let lowered = algebraic.values[cell.graph.place(value)];
    !cell.graph.is_nowhere_defined(value)
        && lowered.is_none_or(|lowered| algebraic.graph.is_nowhere_defined(lowered))
}
