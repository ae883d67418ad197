//! Poincaré sections of any system: crossings of a surface that a formula gives.

use serde::{Deserialize, Serialize};

use crate::error::FlowError;
use crate::motion::columns::Columns;
use crate::motion::kept::is_proved;
use crate::motion::lexicon::{FormulaMistake, Lexicon};
use crate::motion::orbit::energy_drift;
use crate::motion::recorded::program;
use crate::motion::start::{Start, two_sided};
use crate::section::crossings::{CrossingTask, Met, MotionCrossings};
use crate::taylor::program::TaylorProgram;
use liouville::case::{Case, Direction};
use liouville::formula::{Formula, Type};
use liouville::graph::Expr;
use liouville::mechanics::{Model, Phase};
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use liouville::verdict::Options;

/// Surface f = g in phase space, crossed upwards where f - g grows.
pub struct CrossingSurface {
    lexicon: Lexicon,
    left: Formula,
    right: Option<Formula>,
    text: String,
}

impl CrossingSurface {
    /// Reads `f = g`, or a formula that vanishes on the surface.
    pub fn read(lexicon: Lexicon, text: &str) -> Result<Self, FormulaMistake> {
        let mut sides = text.split('=');
        let (left, right) = (sides.next().unwrap_or_default(), sides.next());
        if sides.next().is_some() {
            let message = "a surface is one equation".to_string();
            return Err(FormulaMistake::new(message, 0..text.len(), "write it with a single `=`"));
        }
        let side = |part: &str, from: usize| -> Result<Formula, FormulaMistake> {
            let read = lexicon.formula(part, from)?;
            match read.value_type() {
                Type::Scalar => Ok(read),
                other => Err(FormulaMistake::new(
                    format!("a surface is given by a scalar, and this is a {other}"),
                    from..from + part.len(),
                    "write one component, such as γ[3] = 0, or a function of it",
                )),
            }
        };
        let (left, right) = match right {
            None => (side(left, 0)?, None),
            Some(right) => (side(left, 0)?, Some(side(right, left.len() + 1)?)),
        };
        if ![Some(&left), right.as_ref()].into_iter().flatten().any(|side| lexicon.varies(side)) {
            return Err(FormulaMistake::new(
                "the surface does not depend on the state".to_string(),
                0..text.len(),
                "use a state variable: `liouville names CASE` lists them",
            ));
        }
        let text = match right {
            None => format!("{} = 0", text.trim()),
            Some(_) => text.trim().to_string(),
        };
        Ok(Self { lexicon, left, right, text })
    }

    /// The same surface for a case that differs in values of parameters alone.
    pub(crate) fn of(&self, case: &Case) -> Self {
        let (left, right) = (self.left.clone(), self.right.clone());
        Self { lexicon: Lexicon::new(case), left, right, text: self.text.clone() }
    }

    /// Equation of the surface.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Names of up to two components of the state that the surface leaves free, as a list.
    pub fn default_axes(&self) -> String {
        let model = self.lexicon.model();
        let sides: Vec<&str> = self.text.split('=').map(str::trim).collect();
        let names = (0..model.dimension()).map(|k| model.component_name(k));
        let (bound, free): (Vec<_>, Vec<_>) =
            names.partition(|name| sides.contains(&name.as_str()));
        let shown = if free.is_empty() { bound } else { free };
        shown.into_iter().take(2).collect::<Vec<_>>().join(", ")
    }

    pub(crate) fn model(&self) -> &Model {
        self.lexicon.model()
    }

    /// Whether f - g is proved to be an integral.
    fn is_kept(&self, case: &Case) -> bool {
        let function = match self.text.split_once('=') {
            Some((left, right)) => format!("({left}) - ({right})"),
            None => self.text.clone(),
        };
        is_proved(case, function.as_str(), &Options::default())
    }

    /// Value of f - g at a point.
    pub(crate) fn value<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        let left = phase.scalar(&self.left);
        match &self.right {
            None => left,
            Some(right) => left - phase.scalar(right),
        }
    }

    /// Rate of f - g along the motion.
    pub(crate) fn rate(&self, phase: &Phase<'_, Expr>) -> Expr {
        let lifted = phase.lift(phase.field());
        self.value(&lifted).eps
    }

    /// Compiles the field with the surface's function.
    pub(crate) fn program(&self, parameters: &[Rational]) -> Result<TaylorProgram, FlowError> {
        program(self.model(), parameters, |phase| vec![self.value(phase)])
    }
}

/// Request for the crossings of a surface.
pub struct SurfaceRequest<'r> {
    /// Surface that is crossed.
    pub surface: &'r CrossingSurface,
    /// Values recorded at each crossing.
    pub axes: &'r Columns,
    /// Direction of the crossings that count.
    pub direction: Direction,
    /// Number of crossings to collect for each motion.
    pub crossings: usize,
    /// Number of crossings left out at the beginning.
    pub skip: usize,
    /// Whether to follow the motions backwards in time.
    pub backwards: bool,
}

/// Crossing of a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceCrossing {
    /// Values of the axes.
    #[serde(with = "crate::record")]
    pub at: Vec<f64>,
    /// Time of the crossing.
    #[serde(with = "crate::record")]
    pub time: f64,
    /// Whether the surface's function grows with time there.
    pub rising: bool,
}

/// Crossings of one motion.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SurfaceOrbit {
    /// Crossings that count, without those at the beginning.
    pub crossings: Vec<SurfaceCrossing>,
    /// Number of crossings in the other direction.
    pub others: usize,
    /// Number of points where the motion touches the surface without crossing it.
    pub tangencies: usize,
    /// Number of steps taken.
    pub steps: u64,
    /// Relative change of the energy between start and end; `None` for a system without energy, and
    /// where the motion has no end.
    #[serde(with = "crate::record")]
    pub drift: Option<f64>,
    /// Reason why the motion ended early, or did not start.
    pub problem: Option<FlowError>,
}

/// Computes the crossings of a surface: one entry for each start, in their order. All starts have
/// the same parameters. Calls `progress` with shares of a motion.
pub fn surface_section(
    case: &Case,
    request: &SurfaceRequest<'_>,
    starts: &[Result<Start, FlowError>],
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<SurfaceOrbit>, FlowError> {
    two_sided(case)?;
    let Some(first) = starts.iter().flatten().next() else {
        return Err(starts.iter().find_map(|start| start.as_ref().err().cloned()))
            .map_err(|problem: Option<FlowError>| problem.unwrap_or(FlowError::NoStart));
    };
    let program = request.surface.program(&first.parameters)?;
    let gauge = request.axes.recorded(&first.parameters)?;
    let task = CrossingTask {
        program: &program,
        starts,
        direction: request.direction,
        crossings: request.crossings,
        skip: request.skip,
        backwards: request.backwards,
        has_side: false,
    };
    let observe = || {
        let mut row = gauge.rows();
        move |time: DoubleDouble, state: &[DoubleDouble]| -> Vec<f64> {
            row(time, state).into_iter().map(|x| x.hi).collect()
        }
    };
    let mut tracks = task.run(threads, &observe, progress);
    // Rounding makes a motion cross a level of an integral to which it keeps.
    let close: Vec<_> = tracks.iter_mut().filter(|track| track.is_close).collect();
    if !close.is_empty() && request.surface.is_kept(case) {
        for track in close {
            (track.crossings, track.others, track.tangencies) = (Vec::new(), 0, 0);
            track.problem = Some(FlowError::InSurface);
        }
    }
    let orbit = |(track, start): (MotionCrossings<Vec<f64>>, &Result<Start, FlowError>)| {
        let drift = match (start, &track.end) {
            (Ok(start), Some(end)) if case.model.system.has_energy() => {
                Some(energy_drift(&case.model, start, end)?)
            }
            _ => None,
        };
        let crossing =
            |met: Met<Vec<f64>>| SurfaceCrossing { at: met.at, time: met.time, rising: met.rising };
        Ok(SurfaceOrbit {
            crossings: track.crossings.into_iter().map(crossing).collect(),
            others: track.others,
            tangencies: track.tangencies,
            steps: track.steps,
            drift,
            problem: track.problem,
        })
    };
    tracks.into_iter().zip(starts).map(orbit).collect()
}
