//! Statements of claims as boxes.

use liouville::case::PlacedClaim;
use liouville::formula::{Formula, Layout, Symbol, Type};
use liouville::mechanics::Model;

/// Sets the formula of a claim: an integral, a density or a Hamiltonian as it is, both sides of an
/// identity and of a rate; `None` for claims of other kinds.
pub fn statement(model: &Model, claim: &PlacedClaim) -> Option<Layout> {
    let name = |symbol: Symbol| model.vocabulary.entry(symbol).name.clone();
    let set = |formula: &Formula| formula.layout(&name);
    match (claim.kind.name(), claim.kind.formulas().as_slice()) {
        ("integral" | "density" | "hamiltonian", [first, ..]) => Some(set(first)),
        ("identity", [right, left, ..]) => Some(Layout::equation(set(left), set(right))),
        ("rate", [right, left, ..]) => {
            let above = vec![Layout::Word("d"), Layout::Space, set(left)];
            let below = vec![Layout::Word("d"), Layout::name("t", Type::Scalar)];
            let rate = Layout::Fraction(Box::new(Layout::Row(above)), Box::new(Layout::Row(below)));
            Some(Layout::equation(rate, set(right)))
        }
        _ => None,
    }
}
