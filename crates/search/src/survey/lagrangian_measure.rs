//! Liouville's measure dq dp of a Lagrangian system, in coordinates and velocities.
//!
//! With A = ∂²L/∂w² and constraints f_k on the coordinates alone, whose rates have the slopes a_k by the
//! velocities, the density on the level of f and f' is
//!
//! ```text
//! det A · det(a A⁻¹ aᵀ)
//! ```
//!
//! In other systems it is tried too: what holds is decided as for any claim.

use super::definitions::{Definition, define};
use super::question::{SurveyQuestion, TestedClaim};
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::mechanics::{Algebra, System};
use liouville::verdict::{JudgeError, Options};

/// Largest number of velocities.
const MOST_VELOCITIES: usize = 6;
/// Names of the matrices.
const MASSES: &str = "masses";
const SLOPES: &str = "slopes";

/// Proves the density, if it is one.
pub fn density(case: &Case, options: &Options) -> Result<Vec<TestedClaim>, JudgeError> {
    let Some((definitions, formula)) = stated(case) else { return Ok(Vec::new()) };
    let claims = vec![Claim::density(formula.as_str()).named("Liouville's measure")];
    let mut question = SurveyQuestion::plain("Lagrangian systems", &definitions, claims);
    question.source = "Liouville: dq dp".to_string();
    let found = question.ask(case, options)?.unwrap_or_default();
    Ok(found.into_iter().filter(TestedClaim::is_proved).collect())
}

/// Matrices of second derivatives, and the density in terms of them.
fn stated(case: &Case) -> Option<(Vec<Definition>, String)> {
    let model = &case.model;
    let System::Lagrangian(own) = &model.system else { return None };
    let velocities = own.velocities(&model.state);
    let is_known = |name: &str| model.vocabulary.find(name).is_some();
    let count = velocities.len();
    if own.vakonomic
        || own.algebra != Algebra::Commuting
        || !(1..=MOST_VELOCITIES).contains(&count)
        || own.constraints.len() >= count
        || is_known(MASSES)
        || is_known(SLOPES)
    {
        return None;
    }
    let names: Vec<String> = velocities.iter().map(|place| model.component_name(*place)).collect();
    let lagrangian = match &own.potential {
        Some(potential) => format!("({}) − ({})", own.kinetic.text(), potential.text()),
        None => own.kinetic.text().to_string(),
    };
    let row = |of: &str| {
        let slopes = names.iter().map(|name| format!("partial({of}, {name})"));
        format!("[{}]", slopes.collect::<Vec<_>>().join(", "))
    };
    let matrix = |rows: Vec<String>| format!("[{}]", rows.join(", "));
    let momenta = names.iter().map(|name| format!("partial({lagrangian}, {name})"));
    let masses = match count {
        1 => format!("partial(partial({lagrangian}, {0}), {0})", names[0]),
        _ => matrix(momenta.map(|momentum| row(&momentum)).collect()),
    };
    let volume = if count == 1 { MASSES.to_string() } else { format!("det({MASSES})") };
    let mut definitions = vec![define(MASSES, &masses)];
    let slopes: Vec<String> = own.constraints.iter().map(|own| row(own.text())).collect();
    let formula = match &slopes[..] {
        [] => volume,
        [one] => {
            definitions.push(define(SLOPES, one));
            format!("{volume}*({SLOPES},{MASSES}⁻¹*{SLOPES})")
        }
        _ => {
            definitions.push(define(SLOPES, &matrix(slopes)));
            format!("{volume}*det({SLOPES}*{MASSES}⁻¹*transpose({SLOPES}))")
        }
    };
    Some((definitions, formula))
}
