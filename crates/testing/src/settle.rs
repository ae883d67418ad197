//! Decision of a claim: by enclosures at a state, or by a proof on its chart.
//!
//! ```text
//! state ─ chart, residual ─▶ graph ─▶ balls at the state ─▶ refuted, or 0 is enclosed
//!                                └──▶ prime fields ───────▶ proved, refuted, or silent
//! ```

use super::claim::{FieldClaim, FieldProperty, premises};
use super::failure::{AssertionFailure, ChartProof};
use super::notation::{TestState, VectorField};
use super::recorded::RecordedField;

impl<V, S, const N: usize> FieldClaim<'_, V, S, N>
where
    V: VectorField<N>,
    S: FieldProperty<V, N>,
{
    /// Asserts the claim at one state: no enclosure of its residual excludes 0, neither over f64
    /// nor in 256 bits. The state is a point of ℝᴺ or of a level, and stands for its exact numbers.
    ///
    /// There is no tolerance: a residual that fails is not 0.
    pub fn at(&self, state: &impl TestState<N>) -> Result<(), AssertionFailure> {
        self.record(state)?.look(state.coordinates())
    }

    /// Proves the claim on the whole chart, in random prime fields, in the sense of
    /// docs/soundness.md. The state is tested first, and selects the side of each root and modulus.
    ///
    /// Parameters have their given values. For a proof for all values, make them further variables
    /// whose rates are 0.
    pub fn prove(&self, state: &impl TestState<N>) -> Result<ChartProof, AssertionFailure> {
        let recorded = self.record(state)?;
        let coordinates = state.coordinates();
        recorded.look(coordinates)?;
        recorded.check_chart(coordinates)?;
        recorded.prove(coordinates)
    }

    fn record(&self, place: &impl TestState<N>) -> Result<RecordedField, AssertionFailure> {
        RecordedField::new(
            place,
            |x| self.statement.residual(self.field, place, x),
            |x| premises(self.field, place, x),
        )
    }
}
