//! Points of phase space that a claim gives by state variables.

use super::Reader;
use super::components::Components;

/// Reads a table of state variables, each a formula in the parameters.
pub fn read_point<R: Reader>(from: &R, key: &'static str) -> Result<Option<Components>, R::Error> {
    let model = from.model();
    let point = Components::read(from, key, &model.vocabulary.only_parameters())?;
    let mut formulas = point.iter().flat_map(Components::formulas);
    if formulas.any(|formula| model.has_antiderivative(formula)) {
        let message = "a point cannot contain ∫, whose constant is open".to_string();
        return Err(from.complaint(key, message, "write the antiderivative out"));
    }
    drop(formulas);
    Ok(point)
}
