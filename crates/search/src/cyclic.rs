//! Sines and cosines of cyclic angles as further terms.
//!
//! In spherical coordinates the equations contain no function of the longitude, and two of the three components
//! of the angular momentum do.

use liouville::case::Case;
use liouville::formula::{Formula, Type};
use liouville::graph::Step;
use liouville::mechanics::{System, VariableRole};
use liouville::number::UnaryFunction;

use super::terms::recorded;
use super::{Effort, FurtherTerm, SearchError, SearchReport};

/// Largest number of further terms.
const MOST_TERMS: usize = 4;

/// Adds the sines and cosines of cyclic coordinates to the terms of an effort, where others of degree 1 are counted
/// than known and the equations contain a sine or cosine of another coordinate.
pub fn with_circles(
    case: &Case,
    effort: &Effort,
    report: &SearchReport,
) -> Result<Option<Effort>, SearchError> {
    let System::Lagrangian(lagrangian) = &case.model.system else { return Ok(None) };
    // Positions that constraints leave cyclic are rarely angles.
    if !lagrangian.constraints.is_empty() {
        return Ok(None);
    }
    let first = report.counts.iter().find(|count| count.degree == 1 && !count.free);
    if first.is_none_or(|count| count.dimension <= count.known) {
        return Ok(None);
    }
    let (graph, field) = recorded(case, |jet| jet.phase.field().to_vec())?;
    let reached = graph.reached(field.iter().copied());
    let is_circular = |place: usize| {
        matches!(graph.step(place), Step::Unary(UnaryFunction::Sin | UnaryFunction::Cos, _))
    };
    if !(0..graph.len()).any(|place| reached[place] && is_circular(place)) {
        return Ok(None);
    }
    let inputs = case.model.free_components();
    let (mut terms, mut start) = (Vec::new(), 0);
    for (role, variable) in lagrangian.roles.iter().zip(&case.model.state) {
        let is_cyclic = matches!(role, VariableRole::Coordinate(_))
            && variable.kind == Type::Scalar
            && field.iter().all(|rate| !graph.depends_on(*rate, inputs + start));
        if is_cyclic && let Ok(name) = case.formula(&variable.name) {
            for function in ["cos", "sin"] {
                terms.push(FurtherTerm::Formula(Formula::call(function, &[&name])?));
            }
        }
        start += variable.len();
    }
    let is_given = terms.is_empty() || terms.len() > MOST_TERMS || !effort.terms.is_empty();
    Ok((!is_given).then(|| Effort { terms, ..effort.clone() }))
}
