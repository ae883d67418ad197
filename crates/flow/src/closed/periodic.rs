//! Fixed and periodic points of the section map, by Newton's method, with their multipliers.

use std::f64::consts::PI;

use crate::error::FlowError;
use crate::motion::recorded::program;
use crate::motion::start::{Start, fixed_parameters};
use crate::section::andoyer::{SectionChart, applies, coordinates, rate, section_functions};
use crate::taylor::event::{Event, Sides, value};
use crate::taylor::number::SeriesNumber;
use crate::taylor::program::TaylorProgram;
use crate::taylor::stepper::{Accuracy, Stepper};
use liouville::case::{Angle, Case};
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;

/// Iteration limit; Newton's method converges in far fewer from a nearby point.
const MAX_STEPS: usize = 40;
/// Number of steps after which a motion counts as never returning.
const MAX_STEPS_BETWEEN: u64 = 100_000;
/// Half the distance of central differences; a second difference removes errors of order four.
const DISTANCE: f64 = 1e-3;
/// Residual below which only rounding is left.
const RESIDUAL: f64 = 1e-12;

/// A periodic point of the section map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComputedPeriodicPoint {
    /// Position: l and L/G.
    pub at: [f64; 2],
    /// Number of crossings after which it returns.
    pub period: usize,
    /// Time after which it returns.
    pub time: f64,
    /// Distance between the point and its image.
    pub residual: f64,
    /// Derivative of the map there, row by row.
    pub derivative: [[f64; 2]; 2],
    /// Trace of the derivative, the sum of the multipliers.
    pub trace: f64,
    /// Determinant of the derivative, the product of the multipliers: 1 where an area is preserved, and
    /// for symmetric points.
    pub determinant: f64,
}

/// Eigenvalues of the derivative of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Multipliers {
    /// A complex pair r e^(±iφ).
    Complex {
        /// Modulus r.
        modulus: f64,
        /// Argument φ in (0, π).
        argument: f64,
    },
    /// Two real multipliers, the larger modulus first.
    Real(f64, f64),
}

impl ComputedPeriodicPoint {
    /// Roots of λ² - trace λ + determinant.
    pub fn multipliers(&self) -> Multipliers {
        let half = self.trace / 2.0;
        let square = half * half - self.determinant;
        if square < 0.0 {
            let modulus = self.determinant.sqrt();
            return Multipliers::Complex { modulus, argument: libm::acos(half / modulus) };
        }
        let larger = half + square.sqrt().copysign(half);
        Multipliers::Real(larger, self.determinant / larger)
    }

    /// Unit eigenvector of the derivative for a real multiplier.
    pub fn direction(&self, multiplier: f64) -> [f64; 2] {
        let [[a, b], [c, d]] = self.derivative;
        // Orthogonal to a row of the derivative less the multiplier: the longer one is safer.
        let (first, second) = ([b, multiplier - a], [multiplier - d, c]);
        let length = |[x, y]: [f64; 2]| libm::hypot(x, y);
        let vector = if length(first) >= length(second) { first } else { second };
        vector.map(|x| x / length(vector))
    }

    /// Kind of the point, in words.
    pub fn kind(&self) -> &'static str {
        // Beyond the error of the derivative.
        let near_one = |modulus: f64| (modulus - 1.0).abs() < 1e-6;
        match self.multipliers() {
            Multipliers::Complex { modulus, .. } if near_one(modulus) => "elliptic",
            Multipliers::Complex { modulus, .. } if modulus < 1.0 => "sink",
            Multipliers::Complex { .. } => "source",
            Multipliers::Real(a, b) if a.abs() > 1.0 && b.abs() < 1.0 => "hyperbolic",
            Multipliers::Real(a, _) if a.abs() < 1.0 => "sink",
            Multipliers::Real(_, b) if b.abs() > 1.0 => "source",
            Multipliers::Real(..) => "degenerate",
        }
    }
}

/// State of a motion on the section, with the rate of g.
#[derive(Clone, Debug)]
pub(crate) struct End {
    pub state: Vec<DoubleDouble>,
    /// Rate g'.
    pub rate: f64,
}

/// Motion from the section back to it.
pub(crate) struct Passage {
    pub departure: End,
    pub arrival: End,
    pub time: DoubleDouble,
}

/// Map from the section g = g₀ to itself, over crossings in both directions.
pub struct SectionMap<'c> {
    g0: Angle,
    pub(crate) chart: SectionChart<'c>,
    program: TaylorProgram,
}

impl<'c> SectionMap<'c> {
    /// Prepares the section map of a case at an energy.
    pub fn new(
        case: &'c Case,
        g0: &Angle,
        energy: &Rational,
        seed: u64,
    ) -> Result<Self, FlowError> {
        if !applies(&case.model) {
            return Err(FlowError::NoAndoyer);
        }
        let parameters = fixed_parameters(case, seed, 0)?;
        let program =
            program(&case.model, &parameters, |phase| section_functions(phase, g0).to_vec())?;
        let g0 = g0.clone();
        Ok(Self { chart: SectionChart::new(&case.model, &parameters, &g0, energy)?, program, g0 })
    }

    /// Angle of the section.
    pub(crate) fn g0(&self) -> &Angle {
        &self.g0
    }

    /// Returns the image of a point after some crossings, and the time.
    pub fn image(&self, at: [f64; 2], crossings: usize) -> Result<([f64; 2], f64), FlowError> {
        let ends = self.passage(at, crossings)?;
        Ok((coordinates(&ends.arrival.state), ends.time.hi))
    }

    /// Follows a motion from the section back to it after some crossings.
    pub(crate) fn passage(&self, at: [f64; 2], crossings: usize) -> Result<Passage, FlowError> {
        let start = self.chart.start(at)?;
        self.passage_from::<f64>(&start, crossings, Accuracy::FLOAT)
    }

    /// Follows a motion from a state back to the section, in any precision.
    pub(crate) fn passage_from<T: SeriesNumber<One = T>>(
        &self,
        start: &Start,
        crossings: usize,
        accuracy: Accuracy,
    ) -> Result<Passage, FlowError> {
        let mut departure = None;
        let mut stepper = Stepper::<T>::new(&self.program, accuracy);
        stepper.start_open(0, &start.state, false);
        let (mut sides, mut met) = (Sides::default(), 0);
        while stepper.steps(0) < MAX_STEPS_BETWEEN * crossings as u64 {
            stepper.expand();
            stepper.check(0)?;
            let piece = stepper.piece(0);
            let (across, along) = (piece.output(0), piece.output(1));
            let end = |after: T| {
                let state = piece.state(after);
                let slope = value(&across, after).1.leading() / piece.unit();
                End { rate: rate(&self.g0, &state, slope), state }
            };
            let departure = departure.get_or_insert_with(|| end(T::ZERO));
            let doubt = || self.program.rounding::<T>(0, &stepper.pairs(0), 0.0);
            for event in sides.events(&across, piece.length(), &doubt) {
                let Event::Crossing { after, .. } = event else { continue };
                if value(&along, after).0.leading() <= 0.0 {
                    continue;
                }
                met += 1;
                if met == crossings {
                    let time = piece.time(after);
                    let departure = departure.clone();
                    return Ok(Passage { departure, arrival: end(after), time });
                }
            }
            stepper.advance();
        }
        Err(FlowError::NeverCrossed { time: stepper.time(0).hi, crossings: met, others: 0 })
    }

    /// Returns Φⁿ(x) - x, the angle taken the short way, and the time.
    fn defect(&self, at: [f64; 2], period: usize) -> Result<([f64; 2], f64), FlowError> {
        let (image, time) = self.image(at, period)?;
        Ok(([short(image[0] - at[0]), image[1] - at[1]], time))
    }

    /// Returns the derivative of Φⁿ, row by row: central differences at two distances,
    /// extrapolated. `scale` shrinks both.
    pub(crate) fn derivative(
        &self,
        at: [f64; 2],
        period: usize,
        scale: f64,
    ) -> Result<[[f64; 2]; 2], FlowError> {
        let difference = |column: usize, distance: f64| {
            let moved = |sign: f64| {
                let mut point = at;
                point[column] += sign * distance;
                self.image(point, period)
            };
            let (ahead, behind) = (moved(1.0)?.0, moved(-1.0)?.0);
            let across = 2.0 * distance;
            Ok::<_, FlowError>([
                short(ahead[0] - behind[0]) / across,
                (ahead[1] - behind[1]) / across,
            ])
        };
        let distance = DISTANCE * scale;
        let column = |column: usize| {
            let wide = difference(column, distance)?;
            let narrow = difference(column, distance / 2.0)?;
            Ok::<_, FlowError>([0, 1].map(|row| (4.0 * narrow[row] - wide[row]) / 3.0))
        };
        let ([a, c], [b, d]) = (column(0)?, column(1)?);
        Ok([[a, b], [c, d]])
    }

    /// Finds the periodic point near `near`.
    pub fn periodic(
        &self,
        near: [f64; 2],
        period: usize,
    ) -> Result<ComputedPeriodicPoint, FlowError> {
        let mut at = near;
        let mut best = f64::INFINITY;
        for _ in 0..MAX_STEPS {
            let ([dl, dz], time) = self.defect(at, period)?;
            let residual = libm::hypot(dl, dz);
            let derivative = self.derivative(at, period, 1.0)?;
            if residual <= RESIDUAL || (residual >= best && residual < 1e3 * RESIDUAL) {
                let [[a, b], [c, d]] = derivative;
                let (trace, determinant) = (a + d, a * d - b * c);
                let at = [(at[0] + 2.0 * PI) % (2.0 * PI), at[1]];
                return Ok(ComputedPeriodicPoint {
                    at,
                    period,
                    time,
                    residual,
                    derivative,
                    trace,
                    determinant,
                });
            }
            best = best.min(residual);
            let step = newton_step(derivative, [dl, dz]);
            at = [at[0] + step[0], at[1] + step[1]];
            if !step[0].is_finite() || step[0].abs() > PI || at[1].abs() >= 1.0 {
                break;
            }
        }
        Err(FlowError::NoPeriodicPoint { l: near[0], z: near[1], period })
    }
}

/// Solves (Φ' - E) step = -defect, with Φ' row by row.
pub(crate) fn newton_step([[a, b], [c, d]]: [[f64; 2]; 2], [dl, dz]: [f64; 2]) -> [f64; 2] {
    let (p, s) = (a - 1.0, d - 1.0);
    let determinant = p * s - b * c;
    [-(s * dl - b * dz) / determinant, -(p * dz - c * dl) / determinant]
}

/// Reduces an angle difference to the interval from -π to π.
pub(crate) fn short(angle: f64) -> f64 {
    angle - 2.0 * PI * (angle / (2.0 * PI)).round()
}
