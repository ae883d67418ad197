//! Everything about a case at one state: what `eval` shows.

use super::sampler::Sampler;
use super::{JudgeError, antiderivative_value};
use crate::case::Case;
use crate::claim::Place;
use crate::formula::canonical_name;
use crate::graph::{Evaluator, Expr, Tape, record};
use crate::mechanics::calculus::Jet;
use crate::mechanics::{Model, Phase, components};
use crate::number::Domain;
use crate::number::ball::Ball;
use crate::number::rational::Rational;

/// A number with a bound on its error; `None` where it is undefined.
pub type Enclosed = Option<(f64, f64)>;

/// A name with the components of its value.
pub type Named = (String, Vec<String>);

/// A case at one state.
#[derive(Clone, Debug, PartialEq)]
pub struct PointReport {
    /// The free parameters with the values they had.
    pub parameters: Vec<Named>,
    /// The state.
    pub state: Vec<Named>,
    /// The level equations with the value of left minus right.
    pub level: Vec<(String, Enclosed)>,
    /// The time derivatives of the state's components.
    pub field: Vec<Enclosed>,
    /// Σ ∂v_i/∂x_i in all components.
    pub divergence: Enclosed,
    /// The same less the cofactors of the level functions.
    pub level_divergence: Enclosed,
    /// χ with div v = (χ,ω), for the rubber systems.
    pub chi: Option<[Enclosed; 3]>,
    /// The criterion, for systems that have one.
    pub criterion: Option<Enclosed>,
    /// ½(ω,Ĩω) + U, for bodies.
    pub energy: Option<Enclosed>,
    /// Name, value and residual of each claim.
    pub claims: Vec<(String, Enclosed, Enclosed)>,
}

/// Why a state cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StateError {
    /// Not of the form `name=value`.
    #[error("`{0}` is not of the form name=value, such as ω=[3/7,0,-1/2] or x=0.5")]
    Malformed(String),
    /// A name that is no state variable.
    #[error("`{name}` is no state variable; this system has {known}")]
    Unknown {
        /// The name.
        name: String,
        /// Those that are.
        known: String,
    },
    /// A variable with two values.
    #[error("`{0}` is given twice")]
    Twice(String),
    /// A variable without value.
    #[error("the state has no value for `{0}`")]
    Missing(String),
    /// A list of another length.
    #[error("`{name}` has {expected} components, not {found}")]
    Length {
        /// The variable.
        name: String,
        /// How many it has.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// Not a number.
    #[error("{0}")]
    Number(String),
}

/// Reads `ω=[3/7,0,-1/2] γ=[2/7,3/7,6/7]`.
pub fn read_state(case: &Case, text: &str) -> Result<Vec<Rational>, StateError> {
    let variables = &case.model.state;
    let mut values: Vec<Option<Vec<Rational>>> = vec![None; variables.len()];
    let mut rest = text.trim();
    while !rest.is_empty() {
        let (name, after) =
            rest.split_once('=').ok_or_else(|| StateError::Malformed(rest.to_string()))?;
        let after = after.trim_start();
        let (list, remaining) = match after.strip_prefix('[') {
            Some(inner) => {
                inner.split_once(']').ok_or_else(|| StateError::Malformed(after.to_string()))?
            }
            None => after.split_once(char::is_whitespace).unwrap_or((after, "")),
        };
        rest = remaining.trim_start_matches(|c: char| c.is_whitespace() || c == ',' || c == ';');
        let name = canonical_name(name.trim()).unwrap_or_else(|| name.trim().to_string());
        let index = variables.iter().position(|v| v.name == name).ok_or_else(|| {
            let known: Vec<&str> = variables.iter().map(|v| v.name.as_str()).collect();
            StateError::Unknown { name: name.clone(), known: known.join(", ") }
        })?;
        let numbers: Result<Vec<Rational>, _> = list.split(',').map(|x| x.trim().parse()).collect();
        let numbers = numbers.map_err(|error: crate::number::rational::RationalError| {
            StateError::Number(error.to_string())
        })?;
        let (expected, found) = (variables[index].len(), numbers.len());
        if expected != found {
            return Err(StateError::Length { name, expected, found });
        }
        if values[index].is_some() {
            return Err(StateError::Twice(name));
        }
        values[index] = Some(numbers);
    }
    let mut state = Vec::new();
    for (variable, value) in variables.iter().zip(values) {
        state.extend(value.ok_or_else(|| StateError::Missing(variable.name.clone()))?);
    }
    Ok(state)
}

/// Evaluates everything at `state`, or at state `index` of the seed where it is not given; free
/// parameters have the values of that index.
pub fn evaluate(
    case: &Case,
    state: Option<&[Rational]>,
    seed: u64,
    index: u64,
) -> Result<PointReport, JudgeError> {
    let model = &case.model;
    let level = Place::level(model);
    let sampler = Sampler::new(case, &level, seed)?;
    let free = model.free_components();
    let drawn = sampler.printed(index);
    let mut point: Vec<Rational> = drawn
        .iter()
        .map(|text| text.parse().map_err(|_| JudgeError::Unreachable(1)))
        .collect::<Result<_, _>>()?;
    if let Some(state) = state {
        point.truncate(free);
        point.extend_from_slice(state);
    }
    let mut counts = Vec::new();
    let (graph, outputs) = record(point.len(), |inputs| {
        let (parameters, state) = inputs.split_at(free);
        let jet = Jet::new(Phase::new(model, parameters, state));
        let phase = &jet.phase;
        let mut groups: Vec<Vec<Expr>> = vec![
            model.level.iter().map(|e| phase.level_function(&e.function)).collect(),
            phase.field().to_vec(),
        ];
        let divergence = jet.divergence();
        groups.push(vec![divergence, divergence - jet.level_cofactor(&level.kept)]);
        groups.push(model.system.chi(phase).map_or(Vec::new(), Vec::from));
        groups.push(model.system.criterion(phase).into_iter().collect());
        groups.push(model.system.energy(phase).into_iter().collect());
        for claim in &case.claims {
            groups.push(claim.kind.formula().map(|f| phase.scalar(f)).into_iter().collect());
            groups.push(claim.kind.residual(&jet, &claim.place.kept));
        }
        counts = groups.iter().map(Vec::len).collect();
        groups.concat()
    })?;
    let tape = Tape::new(&graph, &outputs);
    let domain = Ball::<1>;
    let mut evaluator = Evaluator::new(&tape, domain);
    let antiderivatives = (0..graph.inputs() - point.len()).map(antiderivative_value);
    let inputs: Vec<_> =
        point.iter().cloned().chain(antiderivatives).map(|x| domain.values(&[x])).collect();
    evaluator.run(&inputs);
    let mut values =
        evaluator.outputs().map(|ball| (ball.is_defined(0)).then(|| (ball.mid[0], ball.rad[0])));
    let mut groups =
        counts.iter().map(|count| values.by_ref().take(*count).collect::<Vec<Enclosed>>());
    let mut next = || groups.next().unwrap_or_default();
    let level = model.level.iter().map(|e| e.text.clone()).zip(next()).collect();
    let field = next();
    let divergences = next();
    let chi = next();
    let (criterion, energy) = (next().first().copied(), next().first().copied());
    let claims = case
        .claims
        .iter()
        .map(|claim| {
            let value = next().first().copied().flatten();
            (claim.name.clone(), value, next().first().copied().flatten())
        })
        .collect();
    let shown: Vec<String> = point.iter().map(|value| value.to_string()).collect();
    let (parameters, state) = named(model, &shown);
    Ok(PointReport {
        parameters,
        state,
        level,
        field,
        divergence: divergences.first().copied().flatten(),
        level_divergence: divergences.get(1).copied().flatten(),
        chi: <[Enclosed; 3]>::try_from(chi).ok(),
        criterion,
        energy,
        claims,
    })
}

/// Values in the order of a tape's inputs, by the names of parameters and of state variables.
pub(super) fn named(model: &Model, values: &[String]) -> (Vec<Named>, Vec<Named>) {
    let mut rest = values;
    let mut take = |name: &str, count: usize| {
        let (own, others) = rest.split_at(count);
        rest = others;
        (name.to_string(), own.to_vec())
    };
    let parameters = model.free_parameters().map(|p| take(&p.name, components(p.kind))).collect();
    let state = model.state.iter().map(|variable| take(&variable.name, variable.len())).collect();
    (parameters, state)
}
