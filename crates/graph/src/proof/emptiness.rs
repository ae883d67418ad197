//! Cells that contain no point.

use crate::graph::Fault;

use super::cells::Cell;
use super::classes::Classes;
use super::domain::Region;
use super::explore::Explorer;
use super::fact::SignFact;
use super::lower::Algebraic;
use super::next::Next;
use super::tower::Tower;
use super::trial::Trial;

impl Explorer<'_> {
    /// The answer for a cell that contains no point, where that is seen.
    pub fn empty(
        &self,
        cell: &Cell,
        algebraic: &Algebraic<'_>,
        trial: &Trial<'_>,
        tower: &Tower,
        known: &[(usize, SignFact)],
    ) -> Result<Option<Next>, Fault> {
        let classes = Classes::of(algebraic, trial, tower, self.digest);
        let inputs = self.prover.extents;
        let region = Region { graph: &cell.graph, inputs, facts: known, classes: &classes };
        if region.is_empty() || region.is_beyond_bounds() {
            return Ok(Some(Next::Empty(classes.certificate)));
        }
        let opposed = self.opposed(cell, algebraic, tower, known)?;
        Ok(opposed.or_else(|| self.opposed_by_factors(cell, known)))
    }
}
