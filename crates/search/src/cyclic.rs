//! Sines and cosines of cyclic angles as further terms.
//!
//! In spherical coordinates the equations contain no function of the longitude, and two of the three components
//! of the angular momentum do; so does Laplace's vector in polar coordinates.

use liouville::case::Case;
use liouville::formula::{Formula, Type};
use liouville::graph::{Expr, Graph};
use liouville::mechanics::{System, Variable, VariableRole};

use super::terms::recorded;
use super::{Effort, FurtherTerm, SearchError, SearchReport};

/// Largest number of further terms.
const MOST_TERMS: usize = 4;
/// Highest degree of the integrals that are counted and not known.
const MOST_DEGREE: u32 = 2;

/// Adds the sines and cosines of cyclic angles to the terms of an effort, where more integrals of low degree are
/// counted than known.
pub fn with_circles(
    case: &Case,
    effort: &Effort,
    report: &SearchReport,
) -> Result<Option<Effort>, SearchError> {
    let mut counts =
        report.counts.iter().filter(|count| count.degree <= MOST_DEGREE && !count.free);
    if !effort.terms.is_empty() || !counts.any(|count| count.dimension > count.known) {
        return Ok(None);
    }
    let (graph, field) = recorded(case, |jet| jet.phase.field().to_vec())?;
    let mut terms = Vec::new();
    for angle in angles(case, &graph, &field) {
        if let Ok(name) = case.formula(&angle) {
            for function in ["cos", "sin"] {
                terms.push(FurtherTerm::Formula(Formula::call(function, &[&name])?));
            }
        }
    }
    let is_given = terms.is_empty() || terms.len() > MOST_TERMS;
    Ok((!is_given).then(|| Effort { terms, ..effort.clone() }))
}

/// Names of coordinates on which no rate depends, and whose motion is felt elsewhere than that of a Cartesian one:
/// their velocity and another position are in one rate.
fn angles(case: &Case, graph: &Graph, field: &[Expr]) -> Vec<String> {
    let first = case.model.free_components();
    let of = |rate: &Expr| -> Vec<usize> {
        graph.inputs_of(*rate).into_iter().filter_map(|input| input.checked_sub(first)).collect()
    };
    let inputs: Vec<Vec<usize>> = field.iter().map(of).collect();
    let scalars = || {
        let starts = case.model.state.iter().scan(0, |start, variable| {
            *start += variable.len();
            Some(*start - variable.len())
        });
        let scalars = case.model.state.iter().zip(starts);
        scalars.filter(|(variable, _)| variable.kind == Type::Scalar)
    };
    let is_cyclic = |place: usize| inputs.iter().all(|own| !own.contains(&place));
    let name = |(variable, _): (&Variable, usize)| variable.name.clone();
    match &case.model.system {
        // Positions that constraints leave cyclic are rarely angles.
        System::Lagrangian(lagrangian) if lagrangian.constraints.is_empty() => {
            let roles = lagrangian.roles.iter().zip(&case.model.state);
            let positions: Vec<bool> = roles
                .flat_map(|(role, variable)| {
                    vec![matches!(role, VariableRole::Coordinate(_)); variable.len()]
                })
                .collect();
            let is_position = |place: usize| positions.get(place) == Some(&true);
            let is_angle = |place: usize| {
                // The rate of a coordinate is its velocity.
                let [velocity] = inputs[place][..] else { return false };
                let is_felt = |own: &Vec<usize>| {
                    own.contains(&velocity) && own.iter().any(|other| is_position(*other))
                };
                is_position(place) && is_cyclic(place) && inputs.iter().any(is_felt)
            };
            scalars().filter(|(_, place)| is_angle(*place)).map(name).collect()
        }
        // l/r² of a Hamiltonian system.
        System::Hamiltonian(_) | System::Field(_) => {
            let is_angle = |place: usize| is_cyclic(place) && inputs[place].len() > 1;
            scalars().filter(|(_, place)| is_angle(*place)).map(name).collect()
        }
        _ => Vec::new(),
    }
}
