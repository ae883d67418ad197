//! Description of the system in words.

use serde::Serialize;

use super::geometry::GeometryFact;
use super::system_line::in_words;
use liouville::case::Case;
use liouville::claim::may_have_kinks;
use liouville::mechanics::{ParameterOrigin, System};

/// A parameter of the case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GivenParameter {
    /// Name of the parameter.
    pub name: String,
    /// Value, or the formula for it; `None` for a free parameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
}

/// Describes the system in one sentence, from its kind and the facts.
pub fn sentence(case: &Case, facts: &[GeometryFact]) -> String {
    let has = |id: &str| facts.iter().any(|fact| fact.holds && fact.id == id);
    let about = || {
        let axis = facts.iter().find(|fact| fact.holds && fact.id.starts_with("revolution about"));
        axis.map(|fact| fact.id.trim_start_matches("revolution about ").to_string())
    };
    let with = |rotor: bool, forces: bool| match (rotor, forces) {
        (true, true) => ", with a rotor inside it, in a field of forces",
        (true, false) => ", with a rotor inside it and without forces",
        (false, true) => ", in a field of forces",
        (false, false) => ", without forces",
    };
    match &case.model.system {
        system @ (System::Rubber(_) | System::Spinning(_)) => {
            let is_disk = facts.iter().any(|fact| fact.holds && fact.id.starts_with("disk about "));
            let shape = match (has("ball"), has("central"), has("ellipsoid"), about()) {
                _ if is_disk => "a disk".to_string(),
                (true, true, ..) => "a ball whose mass centre is its centre".to_string(),
                (true, false, ..) => "a ball with displaced mass centre".to_string(),
                (_, _, true, None) => "an ellipsoid about its mass centre".to_string(),
                (_, _, true, Some(axis)) => format!("an ellipsoid of revolution about {axis}"),
                (_, _, _, Some(axis)) => format!("a body of revolution about {axis}"),
                _ => "a body with a general surface".to_string(),
            };
            // Each part of such a surface may be that of a ball.
            let is_smooth = !(has("ball") || has("ellipsoid")) || is_disk;
            let parts = match !is_smooth && may_have_kinks(&case.model) {
                true => ", part by part where its support function is smooth,",
                false => "",
            };
            let curvature = system.body().and_then(|body| body.curvature.as_ref());
            let base = match curvature {
                None => "a plane".to_string(),
                Some(curvature) => format!("a sphere of curvature {}", curvature.text()),
            };
            let forces = system.has_potential() || system.moment().is_some();
            let with = with(system.gyrostat().is_some(), forces);
            let way = match system {
                System::Spinning(_) => "without slipping, free to spin",
                _ => "without slipping or spinning",
            };
            format!("{}{parts} rolls on {base} {way}{with}.", capital(&shape))
        }
        System::FlatBase(body) => format!(
            "A body with a flat base rolls on a sphere without slipping or spinning{}.",
            with(body.gyrostat.is_some(), body.potential.is_some())
        ),
        System::Ball(ball) => {
            let surface =
                match (has("plane"), has("sphere"), has("circular cylinder"), has("quadric")) {
                    (true, ..) => "a plane",
                    (_, true, ..) => "a sphere",
                    (_, _, true, _) => "a circular cylinder",
                    (.., true) => "a surface parallel to a quadric",
                    _ if about().is_some() => "a surface of revolution",
                    _ => "a surface",
                };
            let turns = if ball.rotation.is_some() { " that turns" } else { "" };
            let with = with(false, ball.potential.is_some());
            format!("A homogeneous ball rolls, with spin, on {surface}{turns}{with}.")
        }
        System::Lagrangian(own) if own.constraints.is_empty() => "A Lagrangian system.".to_string(),
        System::Lagrangian(_) => format!("A {} system with a Lagrangian.", case.system),
        System::Hamiltonian(_) => "Hamilton's equations for a given function H.".to_string(),
        System::Field(_) => "A vector field.".to_string(),
        System::Map(_) => "A map.".to_string(),
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    first + letters.as_str()
}

/// Lists the parameters, fixed or free.
pub fn parameters(case: &Case) -> Vec<GivenParameter> {
    let given = case.model.parameters.iter().map(|parameter| GivenParameter {
        name: parameter.name.clone(),
        value: match &parameter.origin {
            ParameterOrigin::Fixed(values) => {
                let values: Vec<String> = values.iter().map(ToString::to_string).collect();
                Some(in_words(parameter.kind, &values))
            }
            ParameterOrigin::Formula(formula) => Some(formula.text().to_string()),
            ParameterOrigin::Free(_) => None,
        },
    });
    // The coefficients of an arbitrary function are many and of no interest individually.
    given.filter(|one| !one.name.contains('[')).collect()
}
