//! Initial states, given or drawn, moved to the level set to working precision.

use nalgebra::{DMatrix, DVector};
use num_dual::Dual;

use crate::error::FlowError;
use crate::motion::recorded::{Loose, filled, point};
use crate::taylor::level::Level;
use crate::taylor::number::SeriesNumber;
use liouville::case::Case;
use liouville::claim::{Components, LevelSubset};
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::calculus::DualPoint;
use liouville::mechanics::elimination::rejection;
use liouville::mechanics::{Model, Phase};
use liouville::number::double_double::{DoubleDouble, DoubleDoubles};
use liouville::number::rational::Rational;
use liouville::verdict::Sampler;

/// Iteration limit; Newton's method converges in far fewer from a state near the level.
const MAX_STEPS: usize = 60;

/// Checks that the motions of a case are those of its field alone.
pub fn two_sided(case: &Case) -> Result<(), FlowError> {
    match case.one_sided {
        Some(_) => Err(FlowError::OneSided),
        None => Ok(()),
    }
}

/// State on the level set, with its parameters.
#[derive(Clone, Debug)]
pub struct Start {
    /// Components of the free parameters.
    pub parameters: Vec<Rational>,
    /// Components of the state.
    pub state: Vec<DoubleDouble>,
    /// Distance from the state requested.
    pub moved: f64,
}

/// Components of the free parameters at an index of the seed, and the state drawn with them.
pub(crate) fn drawn(
    case: &Case,
    seed: u64,
    index: u64,
) -> Result<(Vec<Rational>, Vec<Rational>), FlowError> {
    let sampler = Sampler::new(case, &LevelSubset::level(&case.model), seed)?;
    let mut values: Vec<Rational> = sampler
        .printed(index, f64::MANTISSA_DIGITS)
        .iter()
        .map(|text| text.parse().map_err(|_| FlowError::NoStart))
        .collect::<Result<_, _>>()?;
    let state = values.split_off(case.model.free_components());
    Ok((values, state))
}

/// Returns the components of the free parameters at an index of the seed.
pub fn fixed_parameters(case: &Case, seed: u64, index: u64) -> Result<Vec<Rational>, FlowError> {
    drawn(case, seed, index).map(|(parameters, _)| parameters)
}

impl Start {
    /// Builds a start from the state given, or from the one drawn at `index`, with the parameters
    /// of that index.
    pub fn new(
        case: &Case,
        state: Option<&[Rational]>,
        seed: u64,
        index: u64,
    ) -> Result<Self, FlowError> {
        let (parameters, drawn) = drawn(case, seed, index)?;
        let state = state.unwrap_or(&drawn).iter().map(DoubleDouble::from_rational).collect();
        Self::near(&case.model, parameters, state)
    }

    /// Builds a start at a point of a claim, with these values of the free parameters.
    pub fn at(
        model: &Model,
        parameters: Vec<Rational>,
        claimed: &Components,
    ) -> Result<Self, FlowError> {
        let (graph, components) =
            record(model.dimension(), |state| claimed.at(&point(model, &parameters, state)))?;
        let tape = Tape::new(&graph, &components);
        let mut evaluator = Evaluator::new(&tape, DoubleDoubles);
        evaluator.run(&vec![DoubleDouble::default(); model.dimension()]);
        let state = evaluator.outputs().copied().collect();
        Self::near(model, parameters, state)
    }

    /// The same parameters with another state.
    pub fn with_state(&self, state: &[f64]) -> Self {
        let state = state.iter().map(|x| DoubleDouble::from_f64(*x)).collect();
        Self { parameters: self.parameters.clone(), state, moved: 0.0 }
    }

    /// Moves a state to the level set along the gradients, by Newton's method.
    pub fn near(
        model: &Model,
        parameters: Vec<Rational>,
        mut state: Vec<DoubleDouble>,
    ) -> Result<Self, FlowError> {
        let moved = LevelFunctions::new(model, &parameters, &[])?.correct(&mut state, &[])?;
        match lies_in_halves(model, &state)? {
            true => Ok(Self { parameters, state, moved }),
            false => Err(FlowError::NoStart),
        }
    }
}

/// Whether a state of the level lies in the halves of it that the file chooses.
fn lies_in_halves(model: &Model, state: &[DoubleDouble]) -> Result<bool, FlowError> {
    if model.orientations.is_empty() {
        return Ok(true);
    }
    let (graph, signs) = record(model.dimension(), |inputs| {
        model.orientations.iter().map(|own| own.half.sign(inputs)).collect::<Vec<Expr>>()
    })?;
    let tape = Tape::new(&graph, &signs);
    let mut evaluator = Evaluator::new(&tape, DoubleDoubles);
    evaluator.run(state);
    Ok(evaluator.outputs().all(|value| value.hi > 0.0))
}

/// Functions of a point over which gradients are recorded.
type Further<'f> = dyn Fn(&Phase<'_, Dual<Expr>>) -> Vec<Dual<Expr>> + 'f;

/// Level functions of a model, possibly further ones, and their gradients.
pub(crate) struct LevelFunctions {
    tape: Tape,
    equations: usize,
}

impl LevelFunctions {
    /// Records the level functions of a model with these parameters, some of them loose.
    pub fn new(model: &Model, parameters: &[Rational], loose: &[Loose]) -> Result<Self, FlowError> {
        let kept = LevelSubset::level(model).kept;
        let (graph, outputs) = record(model.dimension() + loose.len(), |inputs| {
            let (state, more) = inputs.split_at(model.dimension());
            let jet = DualPoint::new(Phase::new(model, &filled(parameters, loose, more), state));
            let level = model.level.iter();
            let mut outputs: Vec<_> =
                level.map(|equation| jet.phase.level_function(&equation.function)).collect();
            outputs.extend(jet.level_gradients(&kept).concat());
            outputs
        })?;
        Ok(Self { tape: Tape::new(&graph, &outputs), equations: model.level.len() })
    }

    /// Records the level functions of a model and further functions that vanish with them.
    pub fn with(
        model: &Model,
        parameters: &[Rational],
        further: &Further<'_>,
    ) -> Result<Self, FlowError> {
        let dimension = model.dimension();
        let mut equations = 0;
        let (graph, outputs) = record(dimension, |state| {
            let phase = point(model, parameters, state);
            let along = |index: usize| {
                let lifted = phase.lift_along(index);
                let level = model.level.iter();
                let mut values: Vec<Dual<Expr>> =
                    level.map(|equation| lifted.level_function(&equation.function)).collect();
                values.extend(further(&lifted));
                values
            };
            let columns: Vec<Vec<Dual<Expr>>> = (0..dimension).map(along).collect();
            equations = columns.first().map_or(0, Vec::len);
            values_and_slopes(&columns)
        })?;
        Ok(Self { tape: Tape::new(&graph, &outputs), equations })
    }

    /// Level of the functions, for motions of a state of this dimension; none without equations.
    pub fn level(self, dimension: usize) -> Option<Level> {
        (self.equations > 0).then(|| Level::new(self.tape, self.equations, dimension))
    }

    /// Number of equations.
    pub fn len(&self) -> usize {
        self.equations
    }

    /// Values of the functions at a state, and their gradients one after another.
    pub fn at(&self, state: &[DoubleDouble]) -> (Vec<DoubleDouble>, Vec<Vec<DoubleDouble>>) {
        let mut evaluator = Evaluator::new(&self.tape, DoubleDoubles);
        evaluator.run(state);
        let mut values: Vec<DoubleDouble> = evaluator.outputs().copied().collect();
        let slopes = values.split_off(self.equations);
        (values, slopes.chunks(state.len().max(1)).map(<[DoubleDouble]>::to_vec).collect())
    }

    /// Evaluates the level functions, then their gradients one by one, at a state.
    fn values(&self, state: &[DoubleDouble], loose: &[DoubleDouble]) -> Vec<f64> {
        let mut evaluator = Evaluator::new(&self.tape, DoubleDoubles);
        evaluator.run(&[state, loose].concat());
        evaluator.outputs().map(|value| value.hi).collect()
    }

    /// Orthonormal basis of the span of the gradients at a state.
    pub fn normals(&self, state: &[DoubleDouble]) -> Vec<Vec<f64>> {
        let mut unit: Vec<Vec<f64>> = Vec::new();
        for gradient in self.at(state).1 {
            let gradient: Vec<f64> = gradient.iter().map(|x| x.hi).collect();
            let rest = rejection(&gradient, &unit);
            let length = rest.iter().map(|x| x * x).sum::<f64>().sqrt();
            if length > 0.0 {
                unit.push(rest.into_iter().map(|x| x / length).collect());
            }
        }
        unit
    }

    /// Moves a state to the level. Returns the distance.
    pub fn correct(
        &self,
        state: &mut [DoubleDouble],
        loose: &[DoubleDouble],
    ) -> Result<f64, FlowError> {
        if self.equations == 0 {
            return Ok(0.0);
        }
        let begin = state.to_vec();
        let norm = |state: &[DoubleDouble]| state.iter().map(|x| x.hi * x.hi).sum::<f64>().sqrt();
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
            let rounding = DoubleDouble::EPSILON * norm(state);
            if size <= rounding || (size >= last && size < f64::EPSILON * norm(state)) {
                let moved: Vec<DoubleDouble> =
                    state.iter().zip(&begin).map(|(x, y)| *x - *y).collect();
                return Ok(norm(&moved));
            }
            last = size;
            for (x, dx) in state.iter_mut().zip(step.iter()) {
                *x = *x - DoubleDouble::from_f64(*dx);
            }
        }
        Err(FlowError::NoStart)
    }

    /// Returns a unit vector tangent to the level set at a state, in no special direction;
    /// different for each index.
    pub fn along(&self, state: &[DoubleDouble], loose: &[DoubleDouble], index: usize) -> Vec<f64> {
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

/// Orthonormal basis of the tangent space of the level set at a start.
pub(crate) fn level_basis(
    model: &Model,
    start: &Start,
) -> Result<Vec<Vec<DoubleDouble>>, FlowError> {
    let level = LevelFunctions::new(model, &start.parameters, &[])?;
    let mut evaluator = Evaluator::new(&level.tape, DoubleDoubles);
    evaluator.run(&start.state);
    let outputs: Vec<DoubleDouble> = evaluator.outputs().copied().collect();
    let dimension = model.dimension();
    Ok(complement(outputs[level.equations..].chunks(dimension), dimension))
}

/// Orthonormal basis across independent vectors, by the Gram–Schmidt method: these first, then the
/// axes, that with the longest remainder next.
pub(crate) fn complement<'v>(
    vectors: impl Iterator<Item = &'v [DoubleDouble]>,
    dimension: usize,
) -> Vec<Vec<DoubleDouble>> {
    let mut unit: Vec<Vec<DoubleDouble>> = Vec::new();
    for vector in vectors {
        unit.push(normalised(across(vector, &unit)));
    }
    let count = unit.len();
    let axis = |k: usize| {
        let mut axis = vec![DoubleDouble::default(); dimension];
        axis[k] = DoubleDouble::from_f64(1.0);
        axis
    };
    while unit.len() < dimension {
        let rests = (0..dimension).map(|k| across(&axis(k), &unit));
        let longest = rests.max_by(|a, b| dot(a, a).hi.total_cmp(&dot(b, b).hi));
        unit.extend(longest.map(normalised));
    }
    unit.split_off(count.min(dimension))
}

/// Values of functions, then their gradients one after another, from their values over dual numbers
/// along each variable.
pub(crate) fn values_and_slopes(columns: &[Vec<Dual<Expr>>]) -> Vec<Expr> {
    let values = columns.first().into_iter().flatten().map(|value| value.re);
    let count = columns.first().map_or(0, Vec::len);
    let slopes = (0..count).flat_map(|row| columns.iter().map(move |column| column[row].eps));
    values.chain(slopes).collect()
}

/// Scalar product.
pub(crate) fn dot(a: &[DoubleDouble], b: &[DoubleDouble]) -> DoubleDouble {
    a.iter().zip(b).fold(DoubleDouble::default(), |sum, (x, y)| sum + *x * *y)
}

fn normalised(vector: Vec<DoubleDouble>) -> Vec<DoubleDouble> {
    let factor = dot(&vector, &vector).sqrt().recip();
    vector.into_iter().map(|x| x * factor).collect()
}

/// Component of a vector orthogonal to unit vectors; two passes are enough against rounding.
fn across(vector: &[DoubleDouble], unit: &[Vec<DoubleDouble>]) -> Vec<DoubleDouble> {
    let mut rest = vector.to_vec();
    for e in unit.iter().chain(unit) {
        let along = dot(&rest, e);
        rest.iter_mut().zip(e).for_each(|(x, e)| *x = *x - along * *e);
    }
    rest
}
