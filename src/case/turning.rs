//! Surfaces that turn: in the fixed frame they are at rest only if they are of revolution.

use super::error::Problem;
use super::section::CaseTable;
use crate::graph::record;
use crate::mechanics::{Model, Phase, System};
use crate::proof::{Extent, Group, GroupOutcome, Prover};

/// Notes a surface that turns about e₃ in the fixed frame and is not proved to be one of revolution about e₃: F(r) = c
/// would depend on time.
pub fn no_moving_surface(root: &CaseTable<'_>, model: &Model) {
    let System::Ball(ball) = &model.system else { return };
    let parameters = model.free_components();
    let inputs = parameters + model.dimension();
    let recorded = record(inputs, |inputs| {
        let (parameters, state) = inputs.split_at(parameters);
        ball.leaves_itself(&Phase::new(model, parameters, state))
    });
    let Ok((graph, Some(value))) = recorded else { return };
    let extents = vec![Extent::ALL; inputs];
    let prover = Prover { sources: &[], extents: &extents, seed: 0 };
    let outcome = prover.prove(&graph, &[Group::of(vec![value])]);
    if outcome.is_ok_and(|found| found.iter().all(GroupOutcome::is_zero)) {
        return;
    }
    if let Some(section) = root.table("body") {
        root.mistakes().add(section.complaint(Problem::Other {
            message: "a surface that turns about e₃ moves unless it is of revolution about e₃, and this one is not known \
                      to be"
                .to_string(),
            remedy: "add frame = \"rotating\": in that frame any surface is at rest".to_string(),
        }));
    }
}
