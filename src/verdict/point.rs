//! Everything about a case at one state: what `eval` shows.

use super::sampler::Sampler;
use super::{JudgeError, antiderivative_value};
use crate::case::Case;
use crate::claim::Place;
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
