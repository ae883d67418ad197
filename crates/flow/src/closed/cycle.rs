//! Closed orbits of any system, by shooting: Newton's method with the variational equations in f64,
//! then the residual in double-double, and the multipliers in both.
//!
//! Steps are tangent to the level set. With an orthonormal basis B of the tangent space the
//! unknowns u, dT of a step obey
//!
//! ```text
//! Bᵀ(M - 1)B u + Bᵀv dT = -Bᵀ(φ_T(x) - x)     dE·B u = E₀ - E     ds·B u = -s  or  v·B u = 0
//! ```
//!
//! by least squares; M is the derivative of the flow φ over the period T, E an energy or integrals that
//! are kept, and s the function of the surface, if one is given.

use nalgebra::{DMatrix, DVector};

use crate::closed::cyclic::explained;
use crate::closed::multiplier::{self, CycleKind, Multiplier};
use crate::closed::through::MeasuredNumber;
use crate::closed::turns::turns;
use crate::error::FlowError;
use crate::motion::carry::carried;
use crate::motion::conserved::Conserved;
use crate::motion::recorded::program;
use crate::motion::start::{LevelFunctions, Start, dot, level_basis};
use crate::motion::variational::variational_program;
use crate::taylor::number::SeriesNumber;
use crate::taylor::program::TaylorProgram;
use crate::taylor::stepper::{Accuracy, Stepper};
use liouville::mechanics::Model;
use liouville::number::double_double::DoubleDouble;

/// Iteration limit of Newton's method.
const MOST_ITERATIONS: usize = 40;
/// Longest step of Newton's method, relative to the state.
const LONGEST: f64 = 0.2;
/// Residual, relative to the state, below which double-double takes over.
const CONVERGED: f64 = 1e-10;
/// Residual that supports an orbit, relative to the state and to the square of the least singular
/// value of the equations: by Newton and Kantorovich there is an orbit if the residual times a bound
/// of the second derivatives is below half this square.
pub(crate) const SUPPORTED: f64 = 1e-4;
/// Smallest singular value of a nondegenerate orbit, relative to the largest.
const DEGENERATE: f64 = 1e-11;

/// Functions that fix one closed orbit of a family.
pub(crate) struct Pins {
    /// Level functions of the model, then those that follow.
    pub functions: LevelFunctions,
    /// Energy and integrals that follow.
    pub kept: Vec<Conserved>,
    /// Whether the function of a surface comes last.
    pub has_surface: bool,
}

/// A closed orbit with its multipliers.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// State on the orbit.
    pub start: Start,
    /// Time after which the motion is back.
    pub period: MeasuredNumber,
    /// Number of times that the orbit is run through until then.
    pub turns: u32,
    /// Distance between the state and its image, in double-double.
    pub residual: f64,
    /// Whether the distance is so small that there seems to be an orbit; without that the motion is
    /// nearly closed, unless a proof says more.
    pub is_supported: bool,
    /// Integral of the divergence on the level along the orbit.
    pub volume: MeasuredNumber,
    /// Multipliers besides 1 along the orbit and 1 across the levels of what is kept.
    pub multipliers: Vec<Multiplier>,
    /// Integrals that are held, besides the energy.
    pub integrals: Vec<Conserved>,
    /// Stability, where the errors allow a statement.
    pub kind: Option<CycleKind>,
}

/// Finds the closed orbit near a state, with a period near `time`.
pub(crate) fn cycle(
    model: &Model,
    start: &Start,
    time: f64,
    pins: &Pins,
) -> Result<Cycle, FlowError> {
    let mut search = CycleSearch::new(model, start, time, pins)?;
    search.converge().map_err(|problem| explained(model, start, problem))?;
    let matrix = search.equations()?.0;
    let residual = search.refine(matrix)?;
    let is_supported = search.is_supported(residual)?;
    let (float, pair) = (
        search.derivative::<f64>(Accuracy::FLOAT)?,
        search.derivative::<DoubleDouble>(Accuracy::PAIR)?,
    );
    let (multipliers, kind) = search.multipliers(&float, &pair)?;
    let turns = turns(&search.field, &search.start.state, search.time, residual)?;
    let float_period = search.float_period;
    let is_integral = |own: &&Conserved| matches!(own, Conserved::Integral { .. });
    let integrals = pins.kept.iter().filter(is_integral).cloned().collect();
    Ok(Cycle {
        integrals,
        start: search.start,
        period: MeasuredNumber::twice(float_period, search.time.hi),
        turns,
        residual,
        is_supported,
        volume: MeasuredNumber::twice(float.volume.hi, pair.volume.hi),
        multipliers,
        kind,
    })
}

impl Cycle {
    /// The orbit, or the error of a near return.
    pub fn supported(self) -> Result<Self, FlowError> {
        match self.is_supported {
            true => Ok(self),
            false => Err(FlowError::NearReturn(self.period.value, self.residual)),
        }
    }
}

/// Derivative of the flow over the period, on the level.
struct Derivative {
    /// BᵀMB, column by column.
    columns: Vec<Vec<DoubleDouble>>,
    volume: DoubleDouble,
    end: Vec<DoubleDouble>,
}

struct CycleSearch<'s> {
    model: &'s Model,
    pins: &'s Pins,
    /// Values that the pinned functions are to have.
    wanted: Vec<DoubleDouble>,
    level: LevelFunctions,
    field: TaylorProgram,
    guess: f64,
    start: Start,
    time: DoubleDouble,
    /// Period to which f64 has converged.
    float_period: f64,
}

impl<'s> CycleSearch<'s> {
    fn new(model: &'s Model, start: &Start, time: f64, pins: &'s Pins) -> Result<Self, FlowError> {
        let level = LevelFunctions::new(model, &start.parameters, &[])?;
        let field = program(model, &start.parameters, |_| Vec::new())?;
        let mut wanted = pins.functions.at(&start.state).0;
        let first = level.len();
        wanted[..first].fill(DoubleDouble::default());
        if pins.has_surface
            && let Some(last) = wanted.last_mut()
        {
            *last = DoubleDouble::default();
        }
        let (start, guess, float_period) = (start.clone(), time, time);
        let time = DoubleDouble::from_f64(time);
        Ok(Self { model, pins, wanted, level, field, guess, start, time, float_period })
    }

    fn size(&self) -> f64 {
        norm(self.start.state.iter().map(|x| x.hi)).max(f64::MIN_POSITIVE)
    }

    /// State after the period.
    fn image<T: SeriesNumber<One = T>>(
        &self,
        accuracy: Accuracy,
    ) -> Result<Vec<DoubleDouble>, FlowError> {
        carried::<T>(&self.field, &self.start.state, self.time, accuracy)
    }

    /// Velocity at the start.
    fn velocity(&self) -> Vec<f64> {
        let mut stepper = Stepper::<f64>::new(&self.field, Accuracy::FLOAT);
        stepper.start(0, &self.start.state, self.time);
        stepper.expand();
        stepper.velocity(0)
    }

    fn derivative<T: SeriesNumber<One = T>>(
        &self,
        accuracy: Accuracy,
    ) -> Result<Derivative, FlowError> {
        let dimension = self.model.dimension();
        let basis = level_basis(self.model, &self.start)?;
        let program = variational_program(self.model, &self.start.parameters, basis.len())?;
        let mut begin = self.start.state.clone();
        begin.extend(basis.iter().flatten());
        begin.push(DoubleDouble::default());
        let end = carried::<T>(&program, &begin, self.time, accuracy)?;
        let moved = end[dimension..dimension * (basis.len() + 1)].chunks(dimension);
        let columns = moved.map(|vector| basis.iter().map(|e| dot(e, vector)).collect()).collect();
        let volume = end.last().copied().unwrap_or(DoubleDouble::NAN);
        Ok(Derivative { columns, volume, end: end[..dimension].to_vec() })
    }

    /// Matrix and right side of the equations of a step, and the distance of the image.
    fn equations(&self) -> Result<(DMatrix<f64>, DVector<f64>, f64), FlowError> {
        let derivative = self.derivative::<f64>(Accuracy::FLOAT)?;
        let basis = level_basis(self.model, &self.start)?;
        let count = basis.len();
        let velocity = self.velocity();
        let (values, gradients) = self.pins.functions.at(&self.start.state);
        let first = self.level.len();
        let pinned = values.len() - first + usize::from(!self.pins.has_surface);
        let mut matrix = DMatrix::zeros(count + pinned, count + 1);
        let mut right = DVector::zeros(count + pinned);
        let gap: Vec<DoubleDouble> = differences(&derivative.end, &self.start.state);
        let along = |vector: &[f64], e: &[DoubleDouble]| -> f64 {
            vector.iter().zip(e).map(|(x, e)| x * e.hi).sum()
        };
        for (row, e) in basis.iter().enumerate() {
            for (column, moved) in derivative.columns.iter().enumerate() {
                let unit = if row == column { 1.0 } else { 0.0 };
                matrix[(row, column)] = (moved[row] - DoubleDouble::from_f64(unit)).hi;
            }
            matrix[(row, count)] = along(&velocity, e);
            right[row] = -dot(e, &gap).hi;
        }
        let functions = gradients.iter().zip(&values).zip(&self.wanted).skip(first);
        for (place, ((gradient, value), wanted)) in functions.enumerate() {
            let gradient: Vec<f64> = gradient.iter().map(|x| x.hi).collect();
            let length = norm(gradient.iter().copied()).max(f64::MIN_POSITIVE);
            for (column, e) in basis.iter().enumerate() {
                matrix[(count + place, column)] = along(&gradient, e) / length;
            }
            right[count + place] = (*wanted - *value).hi / length;
        }
        if !self.pins.has_surface {
            let last = count + pinned - 1;
            let length = norm(velocity.iter().copied()).max(f64::MIN_POSITIVE);
            for (column, e) in basis.iter().enumerate() {
                matrix[(last, column)] = along(&velocity, e) / length;
            }
        }
        Ok((matrix, right, norm(gap.iter().map(|x| x.hi))))
    }

    /// Moves the state and the period by a step, and the state back to the level.
    fn step(&mut self, step: &DVector<f64>, factor: f64) -> Result<(), FlowError> {
        let basis = level_basis(self.model, &self.start)?;
        for (e, u) in basis.iter().zip(step.iter()) {
            let u = DoubleDouble::from_f64(u * factor);
            self.start.state.iter_mut().zip(e).for_each(|(x, e)| *x = *x + *e * u);
        }
        self.time = self.time + DoubleDouble::from_f64(step[basis.len()] * factor);
        self.level.correct(&mut self.start.state, &[])?;
        Ok(())
    }

    /// Newton's method in f64.
    fn converge(&mut self) -> Result<(), FlowError> {
        let lost = FlowError::NoClosedOrbit(self.guess);
        let mut best = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let (matrix, right, distance) = self.equations()?;
            let size = self.size();
            let speed = norm(self.velocity().into_iter());
            if !distance.is_finite() || speed * self.time.hi <= CONVERGED.sqrt() * size {
                return Err(lost);
            }
            let residual = right.norm();
            if residual <= CONVERGED * size && residual >= best / 4.0 {
                self.float_period = self.time.hi;
                return Ok(());
            }
            best = best.min(residual);
            let step = solved(&matrix, &right).ok_or(FlowError::Degenerate(self.guess))?;
            let factor = (LONGEST * size / step.norm()).min(1.0);
            self.step(&step, factor)?;
            if !(self.time.hi > 0.05 * self.guess && self.time.hi < 20.0 * self.guess) {
                return Err(lost);
            }
        }
        Err(lost)
    }

    /// Repeats steps with the residual in double-double until rounding stops them, with new equations
    /// where those of an earlier point bring it no nearer, as near a fold. Returns the distance that
    /// is left.
    fn refine(&mut self, mut matrix: DMatrix<f64>) -> Result<f64, FlowError> {
        let mut best: Option<(f64, Start, DoubleDouble)> = None;
        let mut is_renewed = false;
        loop {
            let gap = differences(&self.image::<DoubleDouble>(Accuracy::PAIR)?, &self.start.state);
            let distance = norm(gap.iter().map(|x| x.hi));
            let last = best.as_ref().map_or(f64::INFINITY, |(distance, ..)| *distance);
            if distance.is_nan() || distance > last / 2.0 {
                let Some((_, start, time)) = best.as_ref().filter(|_| !is_renewed) else { break };
                (self.start, self.time) = (start.clone(), *time);
                (matrix, is_renewed) = (self.equations()?.0, true);
                let gap =
                    differences(&self.image::<DoubleDouble>(Accuracy::PAIR)?, &self.start.state);
                self.correct(&matrix, &gap)?;
                continue;
            }
            (best, is_renewed) = (Some((distance, self.start.clone(), self.time)), false);
            if distance == 0.0 {
                break;
            }
            self.correct(&matrix, &gap)?;
        }
        let (distance, start, time) = best.ok_or(FlowError::NoClosedOrbit(self.guess))?;
        (self.start, self.time) = (start, time);
        Ok(distance)
    }

    /// Takes a step with the distance of the image in double-double.
    fn correct(&mut self, matrix: &DMatrix<f64>, gap: &[DoubleDouble]) -> Result<(), FlowError> {
        let basis = level_basis(self.model, &self.start)?;
        let mut right = DVector::zeros(matrix.nrows());
        basis.iter().enumerate().for_each(|(row, e)| right[row] = -dot(e, gap).hi);
        let (values, gradients) = self.pins.functions.at(&self.start.state);
        let functions = values.iter().zip(&self.wanted).zip(&gradients).skip(self.level.len());
        for (place, ((value, wanted), gradient)) in functions.enumerate() {
            let length = norm(gradient.iter().map(|x| x.hi)).max(f64::MIN_POSITIVE);
            right[basis.len() + place] = (*wanted - *value).hi / length;
        }
        let step = solved(matrix, &right).ok_or(FlowError::Degenerate(self.guess))?;
        self.step(&step, 1.0)
    }

    /// Whether what is left of the distance is so small that there seems to be an orbit, by the
    /// equations at the point where Newton's method ended.
    fn is_supported(&self, residual: f64) -> Result<bool, FlowError> {
        let (mut matrix, ..) = self.equations()?;
        let (size, period) = (self.size(), self.time.hi);
        if let Some(last) = matrix.ncols().checked_sub(1) {
            matrix.column_mut(last).scale_mut(period / size);
        }
        let least = matrix.singular_values().min().min(1.0);
        Ok(residual / size <= SUPPORTED * least * least)
    }

    fn multipliers(
        &self,
        float: &Derivative,
        pair: &Derivative,
    ) -> Result<(Vec<Multiplier>, Option<CycleKind>), FlowError> {
        let basis = level_basis(self.model, &self.start)?;
        let tangent = |vector: &[f64]| -> Vec<f64> {
            let along = |e: &Vec<DoubleDouble>| vector.iter().zip(e).map(|(x, e)| x * e.hi).sum();
            basis.iter().map(along).collect()
        };
        let mut known = vec![tangent(&self.velocity())];
        let gradients = self.pins.functions.at(&self.start.state).1;
        for gradient in gradients.iter().skip(self.level.len()).take(self.pins.kept.len()) {
            let gradient: Vec<f64> = gradient.iter().map(|x| x.hi).collect();
            known.push(tangent(&gradient));
        }
        let matrix = |derivative: &Derivative| {
            DMatrix::from_fn(basis.len(), basis.len(), |row, column| {
                derivative.columns[column][row].hi
            })
        };
        let product = |derivative: &Derivative| {
            let DoubleDouble { hi, lo } = derivative.volume;
            libm::exp(hi) * (1.0 + lo)
        };
        let product = MeasuredNumber::twice(product(float), product(pair));
        if basis.len() == known.len() + 1 {
            return Ok(multiplier::one(product));
        }
        if basis.len() == known.len() + 2 {
            let trace = |derivative: &Derivative| {
                let diagonal = derivative.columns.iter().enumerate().map(|(k, column)| column[k]);
                let trivial = DoubleDouble::from_f64(-(known.len() as f64));
                diagonal.fold(trivial, |sum, x| sum + x).hi
            };
            return Ok(multiplier::two(MeasuredNumber::twice(trace(float), trace(pair)), product));
        }
        Ok(multiplier::all(&matrix(float), &matrix(pair), &known))
    }
}

/// Least-squares solution; `None` where the equations are singular.
fn solved(matrix: &DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>> {
    if matrix.iter().chain(right.iter()).any(|x| !x.is_finite()) {
        return None;
    }
    let parts = matrix.clone().svd(true, true);
    let (least, largest) = (parts.singular_values.min(), parts.singular_values.max());
    if least <= DEGENERATE * largest {
        return None;
    }
    parts.solve(right, 0.0).ok()
}

fn norm(parts: impl Iterator<Item = f64>) -> f64 {
    parts.map(|x| x * x).sum::<f64>().sqrt()
}

fn differences(a: &[DoubleDouble], b: &[DoubleDouble]) -> Vec<DoubleDouble> {
    a.iter().zip(b).map(|(x, y)| *x - *y).collect()
}
