//! Evaluation of all quantities of a case at one state, for `eval`.

use super::sampler::Sampler;
use super::{JudgeError, antiderivative_value, overflow};
use crate::case::Case;
use crate::claim::LevelSubset;
use crate::graph::{Evaluator, Expr, Graph, Tape, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::determinant;
use crate::mechanics::{Model, Phase, components};
use crate::number::Domain;
use crate::number::arb::{Approximation, ArbBall};
use crate::number::rational::Rational;
use crate::requirement;

/// A number with a bound on its error, infinite where the number, or one that it is formed of, is too
/// large for f64; `None` where it is undefined.
pub type Enclosed = Option<(f64, f64)>;

/// A name with the components of its value.
pub type NamedValue = (String, Vec<String>);

/// Decimal digits of a number, or [`OVERFLOW`]; `None` where it is undefined.
pub type Digits = Option<String>;

/// Word in place of the digits of a number that is too large, or formed of numbers that are.
pub const OVERFLOW: &str = "overflow";

/// All quantities of a case at one state, as enclosures or as digits.
#[derive(Clone, Debug, PartialEq)]
pub struct PointReport<N = Enclosed> {
    /// Free parameters with their values.
    pub parameters: Vec<NamedValue>,
    /// State variables with their values.
    pub state: Vec<NamedValue>,
    /// Level equations with the difference of their sides.
    pub level: Vec<(String, N)>,
    /// The time derivatives of the state's components; of a map their images.
    pub field: Vec<N>,
    /// det DΦ, for a map; it has no divergence.
    pub determinant: Option<N>,
    /// Divergence Σ ∂v_i/∂x_i over all components.
    pub divergence: N,
    /// Divergence minus the cofactors of the level functions.
    pub level_divergence: N,
    /// Covector χ with div v = (χ,ω), for rolling bodies.
    pub chi: Option<[N; 3]>,
    /// Criterion for a density of the configuration, for systems whose criterion is one number.
    pub criterion: Option<N>,
    /// Conditions C₁ and C₂ for a density of the configuration, for bodies that may spin.
    pub conditions: Option<[N; 2]>,
    /// Energy ½(ω,Ĩω) + U, for bodies.
    pub energy: Option<N>,
    /// Values chosen for antiderivatives, whose constants are free.
    pub antiderivatives: Vec<String>,
    /// Name, value and residual of each claim, by components; a claim without a formula has no
    /// value.
    pub claims: Vec<(String, Vec<N>, Vec<N>)>,
}

/// Precision in bits of enclosures: near misses of 10⁻²⁰ and less are visible.
const POINT_BITS: u32 = 160;
/// Number of bits for a decimal digit, followed by the number of spare bits.
const BITS_PER_DIGIT: f64 = 3.33;
const SPARE_BITS: u32 = 64;
/// Number of attempts, each with twice the precision of the last.
const TRIES: u32 = 5;

/// Evaluates all quantities at `state`, or at state `index` of the seed without one; free
/// parameters have the values of that index.
pub fn evaluate(
    case: &Case,
    state: Option<&[Rational]>,
    seed: u64,
    index: u64,
) -> Result<PointReport, JudgeError> {
    let scene = PointScene::new(case, state, seed, index)?;
    let balls = ArbBall::new(POINT_BITS);
    let values = scene.values(&balls);
    let enclosed = |(place, value): (usize, &Option<Approximation>)| match value {
        Some(value) => Some(value.enclosure()),
        None => scene.is_beyond(place, &balls).then_some((f64::MAX, f64::INFINITY)),
    };
    Ok(scene.report(values.iter().enumerate().map(enclosed).collect()))
}

/// Largest number of digits of [`evaluate_digits`].
pub const MOST_DIGITS: usize = 2000;

/// Evaluates all quantities to `wanted` significant decimal digits, at most [`MOST_DIGITS`], all of them
/// correct.
///
/// A number that the highest precision cannot separate from 0 is written as `0`.
pub fn evaluate_digits(
    case: &Case,
    state: Option<&[Rational]>,
    seed: u64,
    index: u64,
    wanted: usize,
) -> Result<PointReport<Digits>, JudgeError> {
    if wanted > MOST_DIGITS {
        return Err(JudgeError::TooManyDigits { wanted, most: MOST_DIGITS });
    }
    let scene = PointScene::new(case, state, seed, index)?;
    let mut bits = (wanted as f64 * BITS_PER_DIGIT) as u32 + SPARE_BITS;
    let mut found: Vec<Digits> = Vec::new();
    for _ in 0..TRIES {
        let values = scene.values(&ArbBall::new(bits));
        let written = values.iter().map(|value| match value {
            Some(value) => value.decimal(wanted),
            None => None,
        });
        found = written.collect();
        let open =
            values.iter().zip(&found).filter(|(value, digits)| value.is_some() && digits.is_none());
        if open.count() == 0 {
            break;
        }
        bits *= 2;
        for (value, digits) in values.iter().zip(&mut found) {
            let Some(value) = value.as_ref().filter(|_| digits.is_none()) else { continue };
            // The value is 0, or midway between two decimals, as far as the precision shows.
            *digits = match value.excludes_zero() {
                false => Some("0".to_string()),
                true => value.midpoint().decimal(wanted),
            };
        }
    }
    let balls = ArbBall::new(bits);
    for (place, digits) in found.iter_mut().enumerate().filter(|(_, digits)| digits.is_none()) {
        *digits = scene.is_beyond(place, &balls).then(|| OVERFLOW.to_string());
    }
    Ok(scene.report(found))
}

/// A case at a state: the quantities to be computed, and the input numbers.
struct PointScene<'c> {
    case: &'c Case,
    point: Vec<Rational>,
    graph: Graph,
    outputs: Vec<Expr>,
    tape: Tape,
    inputs: usize,
    /// Numbers of outputs of each part of the report, and of values that these outputs require.
    counts: Vec<[usize; 2]>,
}

impl<'c> PointScene<'c> {
    fn new(
        case: &'c Case,
        state: Option<&[Rational]>,
        seed: u64,
        index: u64,
    ) -> Result<Self, JudgeError> {
        let model = &case.model;
        let level = LevelSubset::level(model);
        let sampler = Sampler::new(case, &level, seed)?;
        let free = model.free_components();
        let drawn = sampler.printed(index, f64::MANTISSA_DIGITS);
        // A given state may exist where the drawn one does not.
        let drawn = &drawn[..if state.is_some() { free } else { drawn.len() }];
        let mut point: Vec<Rational> = drawn
            .iter()
            .map(|text| text.parse().map_err(|_| JudgeError::Unreachable(1)))
            .collect::<Result<_, _>>()?;
        point.extend_from_slice(state.unwrap_or_default());
        let mut counts = Vec::new();
        let (graph, outputs) = record(point.len(), |inputs| {
            let (parameters, state) = inputs.split_at(free);
            let jet = DualPoint::new(Phase::new(model, parameters, state));
            let phase = &jet.phase;
            let of_level = requirement::of_level(phase);
            let of_system = requirement::of_system(phase);
            let levels = model.level.iter().map(|e| phase.level_function(&e.function)).collect();
            let mut groups: Vec<[Vec<Expr>; 2]> = vec![[levels, of_level]];
            let mut add = |values: Vec<Expr>| groups.push([values, of_system.clone()]);
            add(phase.field().to_vec());
            if model.system.is_map() {
                add(Vec::new());
                add(vec![determinant(&jet.derivative())]);
            } else {
                let divergence = jet.divergence();
                add(vec![divergence, divergence - jet.level_cofactor(&level.kept)]);
                add(Vec::new());
            }
            add(model.system.chi(phase).map_or(Vec::new(), Vec::from));
            add(model.system.criterion(phase));
            add(model.system.energy(phase).into_iter().collect());
            for claim in &case.claims {
                let value = claim.kind.formula().map(|f| phase.evaluate(f).components());
                let of_value = requirement::of_formulas(phase, claim.kind.formula());
                groups.push([value.unwrap_or_default(), of_value]);
                let residual = claim.kind.residual(&jet, &claim.place.kept);
                groups.push([residual, requirement::of_claim(&jet, &claim.kind, &of_system)]);
            }
            counts = groups.iter().map(|group| group.each_ref().map(Vec::len)).collect();
            groups.as_flattened().concat()
        })?;
        let tape = Tape::new(&graph, &outputs);
        Ok(Self { case, point, tape, inputs: graph.inputs(), graph, outputs, counts })
    }

    /// Computes the outputs of the report; without a value that is required they have none.
    fn values(&self, domain: &ArbBall) -> Vec<Option<Approximation>> {
        let mut all = self.numbers(domain).into_iter();
        let mut found = Vec::new();
        for [outputs, required] in self.counts.iter().copied() {
            let first = found.len();
            found.extend(all.by_ref().take(outputs));
            let missing = all.by_ref().take(required).filter(Option::is_none).count();
            if missing > 0 {
                found[first..].fill(None);
            }
        }
        found
    }

    /// Whether a value of the report that does not exist is too large, with all that it requires.
    fn is_beyond(&self, place: usize, balls: &ArbBall) -> bool {
        let mut rest = place;
        let mut first = 0;
        for [outputs, required] in self.counts.iter().copied() {
            if rest < outputs {
                let inputs: Vec<Rational> = self.inputs();
                let required = first + outputs..first + outputs + required;
                let beyond = |place: usize| {
                    overflow::is_beyond(&self.graph, self.outputs[place], &inputs, balls)
                };
                let values = self.numbers(balls);
                let lacks = |place: &usize| values.get(*place).is_none_or(Option::is_none);
                let mut missing =
                    [first + rest].into_iter().chain(required).filter(lacks).peekable();
                return missing.peek().is_some() && missing.all(beyond);
            }
            (rest, first) = (rest - outputs, first + outputs + required);
        }
        false
    }

    /// Input numbers, those of antiderivatives last.
    fn inputs(&self) -> Vec<Rational> {
        let antiderivatives = (0..self.inputs - self.point.len()).map(antiderivative_value);
        self.point.iter().cloned().chain(antiderivatives).collect()
    }

    /// Computes all outputs, with those that are required.
    fn numbers(&self, domain: &ArbBall) -> Vec<Option<Approximation>> {
        let inputs: Vec<_> = self.inputs().into_iter().map(|x| domain.values(&[x])).collect();
        let mut evaluator = Evaluator::new(&self.tape, *domain);
        evaluator.run(&inputs);
        evaluator.outputs().cloned().collect()
    }

    /// Makes the report from the values of the outputs; missing values of a claim are the default.
    fn report<N: Clone + Default>(&self, values: Vec<N>) -> PointReport<N> {
        let model = &self.case.model;
        let mut values = values.into_iter();
        let mut groups =
            self.counts.iter().map(|[count, _]| values.by_ref().take(*count).collect::<Vec<N>>());
        let mut next = || groups.next().unwrap_or_default();
        let level = model.level.iter().map(|e| e.text.clone()).zip(next()).collect();
        let field = next();
        let (divergences, determinant) = (next(), next().first().cloned());
        let chi = next();
        let (criterion, energy) = (next(), next().first().cloned());
        let claims =
            self.case.claims.iter().map(|claim| (claim.name.clone(), next(), next())).collect();
        let antiderivatives = (0..self.inputs - self.point.len())
            .map(|number| antiderivative_value(number).to_string())
            .collect();
        let shown: Vec<String> = self.point.iter().map(|value| value.to_string()).collect();
        let (parameters, state) = named(model, &shown);
        PointReport {
            parameters,
            state,
            level,
            field,
            determinant,
            divergence: divergences.first().cloned().unwrap_or_default(),
            level_divergence: divergences.get(1).cloned().unwrap_or_default(),
            chi: <[N; 3]>::try_from(chi).ok(),
            criterion: <[N; 1]>::try_from(criterion.clone()).ok().map(|[value]| value),
            conditions: <[N; 2]>::try_from(criterion).ok(),
            energy,
            antiderivatives,
            claims,
        }
    }
}

/// Groups values in the order of a tape's inputs by the names of parameters and of state variables.
pub(crate) fn named(model: &Model, values: &[String]) -> (Vec<NamedValue>, Vec<NamedValue>) {
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
