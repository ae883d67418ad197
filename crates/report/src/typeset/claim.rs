//! Statements of claims as boxes.

use liouville::case::PlacedClaim;
use liouville::formula::{Layout, Symbol};
use liouville::mechanics::Model;

/// Sets the statement of a claim with its particulars; an integral, a density or a Hamiltonian as it
/// is; `None` for claims of other kinds.
pub fn statement(model: &Model, claim: &PlacedClaim) -> Option<Layout> {
    let name = |symbol: Symbol| model.vocabulary.entry(symbol).name.clone();
    let alone = || match (claim.kind.name(), claim.kind.formulas().as_slice()) {
        ("integral" | "density" | "hamiltonian", [first, ..]) => Some(first.layout(&name)),
        _ => None,
    };
    claim.kind.layout(model).or_else(alone)
}
