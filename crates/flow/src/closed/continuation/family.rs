//! Equations of a family of closed orbits: field, section, what is kept, and their derivatives by
//! the state and by the quantity that varies.
//!
//! The quantity that varies is centre + half·λ, and λ a further row of the state whose rate is 0. A
//! point of the section obeys G(x, λ) = 0: level functions, E - h where an energy or integral E is kept,
//! and the function of the section, in this order.

use nalgebra::{DMatrix, DVector};
use num_dual::Dual;

use super::request::{BranchRequest, BranchSection};
use crate::error::FlowError;
use crate::motion::columns::Columns;
use crate::motion::conserved::Conserved;
use crate::motion::open::OpenModel;
use crate::motion::recorded::{Loose, extended_program, filled};
use crate::motion::start::{complement, values_and_slopes};
use crate::section::andoyer::{applies, coordinates, section_functions};
use crate::taylor::number::SeriesNumber;
use crate::taylor::program::TaylorProgram;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::calculus::DualPoint;
use liouville::mechanics::{Model, Phase};
use liouville::number::double_double::{DoubleDouble, DoubleDoubles};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Iteration limit of the way to the section.
const MOST_STEPS: usize = 40;

/// Point of the section, with λ and the time of return.
#[derive(Clone, Debug)]
pub struct Place {
    pub state: Vec<DoubleDouble>,
    pub lambda: DoubleDouble,
    pub time: DoubleDouble,
}

impl Place {
    /// State and λ in one row.
    pub fn row(&self) -> Vec<DoubleDouble> {
        self.state.iter().copied().chain([self.lambda]).collect()
    }
}

/// Directions at a point of the section.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Orthonormal basis of the section on the level, at the energy.
    pub basis: Vec<Vec<DoubleDouble>>,
    /// Shortest change of the state that keeps G = 0 while λ grows by 1.
    pub drift: Vec<f64>,
}

/// Energy or integral of a family.
#[derive(Clone, Debug)]
pub struct KeptFunction {
    pub function: Conserved,
    /// Value on all orbits; `None` for the quantity that varies.
    pub value: Option<DoubleDouble>,
}

/// Quantities reported at each point.
enum Gauge {
    Andoyer,
    Columns(Tape),
}

/// Family of systems over a range of one quantity.
pub struct Family {
    model: Model,
    /// Midpoint of the range, and half its length.
    range: [Rational; 2],
    flow: TaylorProgram,
    bundle: TaylorProgram,
    /// Values of G, then of its gradients by x and λ.
    functions: Tape,
    field: Tape,
    gauge: Gauge,
    equations: usize,
}

impl Family {
    /// Prepares the family of a request, on which these functions are kept.
    pub fn new(request: &BranchRequest<'_>, kept: &[KeptFunction]) -> Result<Self, FlowError> {
        let base = match request.section {
            BranchSection::Andoyer(_) => &request.case.model,
            BranchSection::Surface(surface) => surface.model(),
        };
        if matches!(request.section, BranchSection::Andoyer(_)) && !applies(base) {
            return Err(FlowError::NoAndoyer);
        }
        let [from, to] = &request.range;
        let indices: Vec<usize> =
            request.varied.parameter().into_iter().map(|(index, _)| index).collect();
        let drawn = &request.start.parameters;
        let OpenModel { model, parameters, places } = OpenModel::new(base, drawn, &indices);
        let varies = request.varied.parameter().map(|(index, component)| {
            Loose::within(base, [index, component], places[index], [from, to])
        });
        let half = Rational::new(1, 2);
        let range = [&(from + to) * &half, &(to - from) * &half];
        let dimension = model.dimension();
        let loose: Vec<Loose> = varies.iter().cloned().collect();
        let gauge = match &request.columns {
            None => Gauge::Andoyer,
            Some(columns) => Gauge::Columns(gauge(columns, drawn, &indices, &loose)?),
        };
        let functions = Functions { model: &model, parameters: &parameters, loose: &loose };
        let (functions, equations) = functions.record(request, kept, &range)?;
        let count = dimension.saturating_sub(equations);
        let rates = |lambda: &Expr, state: &[Expr]| {
            let free = filled(&parameters, &loose, &[*lambda]);
            Phase::new(&model, &free, state).field().to_vec()
        };
        let zero = || Expr::rational(&Rational::from(0));
        let flow = extended_program(&model, &parameters, &loose, 1, |phase, more| {
            let mut all = rates(&more[0], &phase.state());
            all.push(zero());
            (all, Vec::new())
        })?;
        let more = 2 + (count + 1) * dimension;
        let bundle = extended_program(&model, &parameters, &loose, more, |phase, more| {
            let (lambda, state) = (more[0], phase.state());
            let free = filled(&parameters, &loose, &[lambda]);
            let jet = DualPoint::new(Phase::new(&model, &free, &state));
            let mut all = jet.phase.field().to_vec();
            all.push(zero());
            let mut vectors = more[1..=(count + 1) * dimension].chunks(dimension);
            for vector in vectors.by_ref().take(count) {
                all.extend(jet.phase.lift(vector).field().iter().map(|rate| rate.eps));
            }
            for vector in vectors {
                let state: Vec<Dual<Expr>> =
                    state.iter().zip(vector).map(|(x, w)| Dual::new(*x, *w)).collect();
                let lambda = Dual::new(lambda, Expr::rational(&Rational::from(1)));
                let free = filled(&parameters, &loose, &[lambda]);
                let beside = Phase::new(&model, &free, &state);
                all.extend(beside.field().iter().map(|rate| rate.eps));
            }
            let level = vec![true; model.level.len()];
            all.push(jet.divergence() - jet.level_cofactor(&level));
            (all, Vec::new())
        })?;
        let (graph, field) =
            record(dimension + 1, |inputs| rates(&inputs[dimension], &inputs[..dimension]))?;
        let field = Tape::new(&graph, &field);
        Ok(Self { model, range, flow, bundle, functions, field, gauge, equations })
    }

    /// Dimension of the state.
    pub fn dimension(&self) -> usize {
        self.model.dimension()
    }

    /// Number of multipliers: the dimension of the section.
    pub fn count(&self) -> usize {
        self.dimension().saturating_sub(self.equations)
    }

    /// Field with λ as a further row.
    pub fn flow(&self) -> &TaylorProgram {
        &self.flow
    }

    /// Field with λ, tangent vectors, that of λ, and ∫ div v.
    pub fn bundle(&self) -> &TaylorProgram {
        &self.bundle
    }

    /// Value of the quantity that varies.
    pub fn value(&self, lambda: DoubleDouble) -> f64 {
        let [centre, half] = self.range.each_ref().map(DoubleDouble::from_rational);
        (centre + half * lambda).hi
    }

    /// Half the length of the range.
    pub fn half(&self) -> f64 {
        self.range[1].to_f64().0
    }

    /// Returns λ at a value.
    pub fn lambda(&self, value: &Rational) -> DoubleDouble {
        let [centre, half] = self.range.each_ref().map(DoubleDouble::from_rational);
        (DoubleDouble::from_rational(value) - centre) * half.recip()
    }

    /// Values of G, and its gradients by the state and λ.
    pub fn functions(&self, row: &[DoubleDouble]) -> (Vec<DoubleDouble>, Vec<Vec<DoubleDouble>>) {
        let mut evaluator = Evaluator::new(&self.functions, DoubleDoubles);
        evaluator.run(row);
        let mut values: Vec<DoubleDouble> = evaluator.outputs().copied().collect();
        let slopes = values.split_off(self.equations);
        (values, slopes.chunks(row.len()).map(<[DoubleDouble]>::to_vec).collect())
    }

    /// Velocity at a state and λ.
    pub fn velocity(&self, row: &[DoubleDouble]) -> Vec<DoubleDouble> {
        let mut evaluator = Evaluator::new(&self.field, DoubleDoubles);
        evaluator.run(row);
        evaluator.outputs().copied().collect()
    }

    /// Reported quantities.
    pub fn gauge(&self, place: &Place) -> Vec<f64> {
        match &self.gauge {
            Gauge::Andoyer => coordinates(&place.state).to_vec(),
            Gauge::Columns(tape) => {
                let mut evaluator = Evaluator::new(tape, DoubleDoubles);
                evaluator.run(&place.row());
                evaluator.outputs().map(|x| x.hi).collect()
            }
        }
    }

    /// Moves a state to G = 0 at its λ.
    pub fn project(&self, place: &mut Place) -> Result<(), FlowError> {
        let size = norm(place.state.iter().map(|x| x.hi)).max(f64::MIN_POSITIVE);
        let mut last = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let (values, gradients) = self.functions(&place.row());
            let values: Vec<f64> = values.iter().map(|x| x.hi).collect();
            let step = shortest(&gradients, &values).ok_or(FlowError::NoStart)?;
            let length = norm(step.iter().copied());
            if !length.is_finite() {
                break;
            }
            if length <= DoubleDouble::EPSILON * size || (length >= last && length < 1e-15 * size) {
                return Ok(());
            }
            last = length;
            for (x, dx) in place.state.iter_mut().zip(&step) {
                *x = *x - DoubleDouble::from_f64(*dx);
            }
        }
        Err(FlowError::NoStart)
    }

    /// Directions at a point of the section.
    pub fn frame(&self, place: &Place) -> Result<Frame, FlowError> {
        let dimension = self.dimension();
        let gradients = self.functions(&place.row()).1;
        let basis = complement(gradients.iter().map(|row| &row[..dimension]), dimension);
        let slopes: Vec<f64> = gradients.iter().map(|row| row[dimension].hi).collect();
        let drift = shortest(&gradients, &slopes).ok_or(FlowError::NoStart)?;
        Ok(Frame { basis, drift: drift.into_iter().map(|x| -x).collect() })
    }
}

/// Shortest step along the gradients by the state under which functions grow by these values.
fn shortest(gradients: &[Vec<DoubleDouble>], values: &[f64]) -> Option<Vec<f64>> {
    let dimension = gradients.first()?.len() - 1;
    let jacobian =
        DMatrix::from_fn(gradients.len(), dimension, |row, column| gradients[row][column].hi);
    let square = &jacobian * jacobian.transpose();
    let weights = square.lu().solve(&DVector::from_column_slice(values))?;
    Some((jacobian.transpose() * weights).iter().copied().collect())
}

/// Norm of a vector.
pub fn norm(parts: impl Iterator<Item = f64>) -> f64 {
    parts.map(|x| x * x).sum::<f64>().sqrt()
}

/// Records columns over the state and λ.
fn gauge(
    columns: &Columns,
    drawn: &[Rational],
    indices: &[usize],
    loose: &[Loose],
) -> Result<Tape, FlowError> {
    let OpenModel { model, parameters, .. } = OpenModel::new(columns.model(), drawn, indices);
    let dimension = model.dimension();
    let (graph, values) = record(dimension + 1, |inputs| {
        let free = filled(&parameters, loose, &inputs[dimension..]);
        columns.values(&Phase::new(&model, &free, &inputs[..dimension]))
    })?;
    Ok(Tape::new(&graph, &values))
}

/// Functions that fix a point of the section.
struct Functions<'f> {
    model: &'f Model,
    parameters: &'f [Rational],
    loose: &'f [Loose],
}

impl Functions<'_> {
    /// Records G and its gradients. Returns the number of functions, too.
    fn record(
        &self,
        request: &BranchRequest<'_>,
        kept: &[KeptFunction],
        [centre, half]: &[Rational; 2],
    ) -> Result<(Tape, usize), FlowError> {
        let dimension = self.model.dimension();
        let mut equations = 0;
        let (graph, outputs) = record(dimension + 1, |inputs| {
            let along = |index: usize| {
                let unit = |k: usize| Expr::rational(&Rational::from(i64::from(k == index)));
                let row: Vec<Dual<Expr>> =
                    inputs.iter().enumerate().map(|(k, x)| Dual::new(*x, unit(k))).collect();
                let free = filled(self.parameters, self.loose, &row[dimension..]);
                let phase = Phase::new(self.model, &free, &row[..dimension]);
                let level = self.model.level.iter();
                let mut all: Vec<Dual<Expr>> =
                    level.map(|equation| phase.level_function(&equation.function)).collect();
                for KeptFunction { function, value } in kept {
                    let wanted = match value {
                        Some(value) => {
                            exact::<Dual<Expr>>(value.hi) + exact::<Dual<Expr>>(value.lo)
                        }
                        None => Dual::rational(centre) + Dual::rational(half) * row[dimension],
                    };
                    all.extend(function.value(&phase).map(|own| own - wanted));
                }
                all.push(match request.section {
                    BranchSection::Andoyer(g0) => section_functions(&phase, g0)[0],
                    BranchSection::Surface(surface) => surface.value(&phase),
                });
                all
            };
            let columns: Vec<Vec<Dual<Expr>>> = (0..=dimension).map(along).collect();
            equations = columns.first().map_or(0, Vec::len);
            values_and_slopes(&columns)
        })?;
        Ok((Tape::new(&graph, &outputs), equations))
    }
}

/// A finite f64 as an exact scalar.
fn exact<T: Scalar>(value: f64) -> T {
    Rational::from_f64(value).map_or_else(T::undefined, |value| T::rational(&value))
}
