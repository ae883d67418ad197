//! Where a motion starts: a state that is typed or drawn, put on the level set to working precision.

use nalgebra::{DMatrix, DVector};

use super::error::FlowError;
use super::motion::{Loose, filled};
use super::number::Number;
use crate::case::Case;
use crate::claim::Place;
use crate::graph::{Evaluator, Tape, record};
use crate::mechanics::calculus::{Jet, rejection};
use crate::mechanics::{Model, Phase};
use crate::number::pair::{Pair, Pairs};
use crate::number::rational::Rational;
use crate::verdict::Sampler;

/// Newton's method converges in far fewer; a state that takes more is not near the level.
const MAX_STEPS: usize = 60;

/// A state on the level set, and the parameters it belongs to.
#[derive(Clone, Debug)]
pub struct Start {
    /// The components of the free parameters.
    pub parameters: Vec<Rational>,
    /// The components of the state.
    pub state: Vec<Pair>,
    /// How far the state that was asked for lies from it.
    pub moved: f64,
}

/// The components of the free parameters at an index of the seed, and the state drawn with them.
fn drawn(case: &Case, seed: u64, index: u64) -> Result<(Vec<Rational>, Vec<Rational>), FlowError> {
    let sampler = Sampler::new(case, &Place::level(&case.model), seed)?;
    let mut values: Vec<Rational> = sampler
        .printed(index, f64::MANTISSA_DIGITS)
        .iter()
        .map(|text| text.parse().map_err(|_| FlowError::NoStart))
        .collect::<Result<_, _>>()?;
    let state = values.split_off(case.model.free_components());
    Ok((values, state))
}

/// The components of the free parameters at an index of the seed.
pub(super) fn fixed_parameters(
    case: &Case,
    seed: u64,
    index: u64,
) -> Result<Vec<Rational>, FlowError> {
    drawn(case, seed, index).map(|(parameters, _)| parameters)
}

impl Start {
    /// The state `index` of the seed, or the one that is given, with the parameters of that index.
    pub fn new(
        case: &Case,
        state: Option<&[Rational]>,
        seed: u64,
        index: u64,
    ) -> Result<Self, FlowError> {
        let (parameters, drawn) = drawn(case, seed, index)?;
        let state = state.unwrap_or(&drawn).iter().map(Pair::from_rational).collect();
        Self::near(&case.model, parameters, state)
    }

    /// The state of the level set nearest to this one, by Newton's method across the level.
    pub fn near(
        model: &Model,
        parameters: Vec<Rational>,
        mut state: Vec<Pair>,
    ) -> Result<Self, FlowError> {
        let moved = Level::new(model, &parameters, &[])?.correct(&mut state, &[])?;
        Ok(Self { parameters, state, moved })
    }
}

/// The level functions of a model and their gradients.
pub(super) struct Level {
    tape: Tape,
    equations: usize,
}

impl Level {
    /// Those of a model with these parameters, some of them loose.
    pub fn new(model: &Model, parameters: &[Rational], loose: &[Loose]) -> Result<Self, FlowError> {
        let kept = Place::level(model).kept;
        let (graph, outputs) = record(model.dimension() + loose.len(), |inputs| {
            let (state, more) = inputs.split_at(model.dimension());
            let jet = Jet::new(Phase::new(model, &filled(parameters, loose, more), state));
            let level = model.level.iter();
            let mut outputs: Vec<_> =
                level.map(|equation| jet.phase.level_function(&equation.function)).collect();
            outputs.extend(jet.level_gradients(&kept).concat());
            outputs
        })?;
        Ok(Self { tape: Tape::new(&graph, &outputs), equations: model.level.len() })
    }

    /// The level functions, then their gradients one by one, at a state.
    fn values(&self, state: &[Pair], loose: &[Pair]) -> Vec<f64> {
        let mut evaluator = Evaluator::new(&self.tape, Pairs);
        evaluator.run(&[state, loose].concat());
        evaluator.outputs().map(|value| value.hi).collect()
    }

    /// Moves a state to the level; gives the distance.
    pub fn correct(&self, state: &mut [Pair], loose: &[Pair]) -> Result<f64, FlowError> {
        if self.equations == 0 {
            return Ok(0.0);
        }
        let begin = state.to_vec();
        let norm = |state: &[Pair]| state.iter().map(|x| x.hi * x.hi).sum::<f64>().sqrt();
        let mut last = f64::INFINITY;
        for _ in 0..MAX_STEPS {
            let outputs = self.values(state, loose);
            let (values, slopes) = outputs.split_at(self.equations);
            let jacobian = DMatrix::from_row_slice(self.equations, state.len(), slopes);
            let square = &jacobian * jacobian.transpose();
            let weights = square.lu().solve(&DVector::from_column_slice(values));
            let step = jacobian.transpose() * weights.ok_or(FlowError::NoStart)?;
            let size = step.norm();
            if !size.is_finite() {
                break;
            }
            // Steps shrink until rounding stops them; components near 0 would shrink for ever.
            let rounding = Pair::EPSILON * norm(state);
            if size <= rounding || (size >= last && size < f64::EPSILON * norm(state)) {
                let moved: Vec<Pair> = state.iter().zip(&begin).map(|(x, y)| *x - *y).collect();
                return Ok(norm(&moved));
            }
            last = size;
            for (x, dx) in state.iter_mut().zip(step.iter()) {
                *x = *x - Pair::from_f64(*dx);
            }
        }
        Err(FlowError::NoStart)
    }

    /// A unit vector along the level set at a state, in no special direction; another one for each
    /// index.
    pub fn along(&self, state: &[Pair], loose: &[Pair], index: usize) -> Vec<f64> {
        let outputs = self.values(state, loose);
        let gradients: Vec<Vec<f64>> =
            outputs[self.equations..].chunks(state.len()).map(<[f64]>::to_vec).collect();
        // Irrational directions: multiples of the golden ratio, and of √2.
        let ratio = if index == 0 { 0.618_033_988_75 } else { std::f64::consts::SQRT_2 };
        let any: Vec<f64> = (1..=state.len()).map(|k| (k as f64 * ratio).fract() - 0.37).collect();
        let along = rejection(&any, &gradients);
        let length = along.iter().map(|x| x * x).sum::<f64>().sqrt();
        along.into_iter().map(|x| x / length).collect()
    }
}
