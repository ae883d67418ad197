//! Positions and velocities of a system of the user's own, for terms that are linear in the velocities.
//!
//! ```text
//! Lagrangian    its coordinates, and its velocities
//! Hamiltonian   the first of each canonical pair, and the second; of another bracket the largest set of
//!               variables that commute, if their brackets with the others depend on this set only
//! field         variables with rates x' = u, and these u
//! ```

use super::force_split::{NO_CASIMIRS, added, commuting, has_casimirs, is_canonical, positions};
use super::forces::with_potential;
use crate::streams::SearchStream;
use crate::terms::recorded;
use crate::{Effort, SearchError};
use liouville::case::Case;
use liouville::graph::{Evaluator, Expr, Graph, Tape};
use liouville::mechanics::{Model, System, VariableRole};
use liouville::number::prime::{Prime, UNDEFINED};
use liouville::proof::{root_numbers, statement_seed};

/// Number of states that are compared.
const STATES: usize = 4;
/// Number of random choices that are tried, as roots exist at some only.
const TRIALS: usize = 64;

/// Components of the state by their part in terms that are linear in the velocities.
#[derive(Debug)]
pub struct GyroSplit {
    /// Components that the coefficients of the terms depend on.
    pub positions: Vec<usize>,
    /// Components that the terms are linear in; of a field one for each position, in the same order.
    pub velocities: Vec<usize>,
    /// Whether coefficients are functions of the positions, not only numbers.
    pub has_functions: bool,
}

/// Divides a system of the user's own; the text is the reason why it takes no such terms.
pub fn split(case: &Case, effort: &Effort) -> Result<Result<GyroSplit, String>, SearchError> {
    let model = &case.model;
    if !model.extension.is_empty() {
        return Ok(Err("variables were added to the system".to_string()));
    }
    match &model.system {
        System::Lagrangian(own) => {
            if let Some(reason) = own.roles.iter().find_map(unfit) {
                return Ok(Err(reason.to_string()));
            }
            let velocities = own.velocities(&model.state);
            let found = positions(case, effort)?;
            Ok(found.map(|positions| GyroSplit { positions, velocities, has_functions: true }))
        }
        System::Hamiltonian(own) => {
            if own.clock.is_some() {
                return Ok(Err("time is a variable of the system".to_string()));
            }
            if !has_casimirs(case, effort)? {
                return Ok(Err(NO_CASIMIRS.to_string()));
            }
            let mut positions = match commuting(model, own) {
                Ok(positions) => positions,
                Err(reason) => return Ok(Err(reason.to_string())),
            };
            let has_functions = is_canonical(model, own);
            if !has_functions && !are_closed(case, &positions, effort)? {
                positions.clear();
            }
            let velocities = others(model, &positions);
            Ok(Ok(GyroSplit { positions, velocities, has_functions }))
        }
        System::Field(_) => {
            let positions = match positions(case, effort)? {
                Ok(positions) => positions,
                Err(reason) => return Ok(Err(reason)),
            };
            let reason = "the field is not of the form x' = u, u' = …, with one velocity for each \
                          position; write the equations with [hamiltonian] or [lagrangian]";
            let velocities = match velocities(case, &positions, effort)? {
                Velocities::Unsampled => return Ok(Err(UNSAMPLED.to_string())),
                Velocities::Mixed => None,
                Velocities::Of(all) => Some(all),
            };
            Ok(velocities
                .filter(|own| own.len() == others(model, &positions).len())
                .map(|velocities| GyroSplit { positions, velocities, has_functions: true })
                .ok_or_else(|| reason.to_string()))
        }
        _ => Ok(Err("the system admits none".to_string())),
    }
}

/// Reason why a Lagrangian with a variable of this role takes no such terms.
fn unfit(role: &VariableRole) -> Option<&'static str> {
    match role {
        VariableRole::Time => Some("time is a variable of the system"),
        VariableRole::Multiplier(_) => Some(
            "the system is vakonomic; write it in coordinates without constraints, or as nonholonomic",
        ),
        VariableRole::Coordinate(_) | VariableRole::Carried(_) | VariableRole::Velocity => None,
    }
}

fn others(model: &Model, positions: &[usize]) -> Vec<usize> {
    (0..model.dimension()).filter(|place| !positions.contains(place)).collect()
}

/// Values at states that differ in the velocities only, modulo a prime: one list of inputs and one of
/// outputs; `None` where there are none.
fn compared(
    (graph, outputs): (&Graph, &[Expr]),
    is_shared: impl Fn(usize) -> bool,
    effort: &Effort,
) -> Option<[Vec<[u64; STATES]>; 2]> {
    let mut rng =
        SearchStream::Equations.under(statement_seed(effort.options.seed, graph, outputs));
    let modulus = rng.prime_for(&root_numbers(graph));
    let tape = Tape::new(graph, outputs);
    let mut evaluator = Evaluator::new(&tape, Prime::new([modulus; STATES]));
    for _ in 0..TRIALS {
        let inputs: Vec<[u64; STATES]> = (0..graph.inputs())
            .map(|input| {
                let first = rng.element(&modulus);
                let rest: [u64; STATES] = std::array::from_fn(|_| rng.element(&modulus));
                if is_shared(input) { [first; STATES] } else { rest }
            })
            .collect();
        evaluator.run(&inputs);
        let values: Vec<[u64; STATES]> = evaluator.outputs().copied().collect();
        if !values.iter().flatten().any(|value| *value == UNDEFINED) {
            return Some([inputs, values]);
        }
    }
    None
}

/// Whether the brackets of some variables with all others depend on these variables alone.
fn are_closed(case: &Case, positions: &[usize], effort: &Effort) -> Result<bool, SearchError> {
    let model = &case.model;
    let terms = model.state_formulas()?;
    let changed = positions.iter().map(|k| with_potential(model, &terms[*k]));
    let Some(changed) = changed.collect::<Option<Vec<Model>>>() else { return Ok(false) };
    let (graph, values) = recorded(case, |jet| added(jet, &changed))?;
    let start = model.free_components();
    let is_shared = |input: usize| input < start || positions.contains(&(input - start));
    let found = compared((&graph, &values), is_shared, effort);
    Ok(found.is_some_and(|[_, values]| {
        values.iter().all(|own| own.iter().all(|value| *value == own[0]))
    }))
}

/// Reason why the rates of a field cannot be compared with its variables.
const UNSAMPLED: &str = "formulas with exp, ln, sin, cos or general powers of the state or the parameters \
                         have no values modulo a prime; name what they are of parameters by a parameter, \
                         as w in place of Ω sin φ";

/// Velocities of the positions of a field.
enum Velocities {
    /// The one that is the rate of each position, in order.
    Of(Vec<usize>),
    /// Some rate is no variable.
    Mixed,
    /// The rates have no values modulo a prime.
    Unsampled,
}

/// Finds the velocity that is the rate of each position.
fn velocities(
    case: &Case,
    positions: &[usize],
    effort: &Effort,
) -> Result<Velocities, SearchError> {
    let (graph, field) = recorded(case, |jet| jet.phase.field().to_vec())?;
    let Some([inputs, rates]) = compared((&graph, &field), |_| false, effort) else {
        return Ok(Velocities::Unsampled);
    };
    let start = case.model.free_components();
    let others = others(&case.model, positions);
    let velocity =
        |place: &usize| others.iter().copied().find(|other| inputs[start + other] == rates[*place]);
    let found: Option<Vec<usize>> = positions.iter().map(velocity).collect();
    Ok(found.map_or(Velocities::Mixed, Velocities::Of))
}
