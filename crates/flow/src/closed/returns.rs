//! Closed orbits of a case: through periodic points of a section, or near states.

use crate::closed::cycle::{Cycle, Pins, cycle};
use crate::closed::periodic::{ComputedPeriodicPoint, SectionMap};
use crate::error::FlowError;
use crate::motion::conserved::Conserved;
use crate::motion::kept::keeps_energy;
use crate::motion::start::{LevelFunctions, Start, two_sided};
use crate::section::andoyer::section_functions;
use crate::section::crossings::CrossingTask;
use crate::section::surface::CrossingSurface;
use crate::taylor::program::TaylorProgram;
use crate::taylor::stepper::{Accuracy, Stepper};
use liouville::case::{Case, Direction};
use liouville::claim::clock;
use liouville::number::double_double::DoubleDouble;
use liouville::scalar::Scalar;
use num_dual::Dual;

impl SectionMap<'_> {
    /// Finds the periodic point near `near`, and the closed orbit through it.
    pub fn cycle(
        &self,
        near: [f64; 2],
        period: usize,
    ) -> Result<(ComputedPeriodicPoint, Cycle), FlowError> {
        let point = self.periodic(near, period)?;
        let start = self.chart.start(point.at)?;
        let model = self.chart.model;
        let functions = LevelFunctions::with(model, &start.parameters, &|phase| {
            let energy = model.system.energy(phase);
            let [section, _] = section_functions(phase, self.g0());
            vec![energy.unwrap_or(Dual::from_re(Scalar::undefined())), section]
        })?;
        let pins = Pins { functions, kept: vec![Conserved::Energy], has_surface: true };
        let found = cycle(model, &start, point.time, &pins)?;
        Ok((point, found))
    }
}

/// Finds the closed orbit of a case near a state, at its energy and with its values of the functions
/// that are `held`, with a period near `time`. With a surface the state that is found lies on it. If the
/// orbit is one of a family, the values of all proved integrals are held.
pub fn closed_orbit(
    case: &Case,
    start: &Start,
    time: f64,
    surface: Option<&CrossingSurface>,
    held: &[Conserved],
) -> Result<Cycle, FlowError> {
    two_sided(case)?;
    if clock(&case.model).is_some() {
        return Err(FlowError::NeverCloses);
    }
    let model = surface.map_or(&case.model, CrossingSurface::model);
    let energy = keeps_energy(case, model, start, time)?.then_some(Conserved::Energy);
    let integrals = held.iter().filter(|own| !matches!(own, Conserved::Energy)).cloned();
    let mut kept: Vec<Conserved> = energy.into_iter().chain(integrals).collect();
    let found = |kept: Vec<Conserved>| {
        let functions = LevelFunctions::with(model, &start.parameters, &|phase| {
            let values = kept.iter().filter_map(|own| own.value(phase));
            values.chain(surface.map(|surface| surface.value(phase))).collect()
        })?;
        cycle(model, start, time, &Pins { functions, kept, has_surface: surface.is_some() })
    };
    match found(kept.clone()) {
        // Along a family Newton's method may also lose its way.
        Err(error @ (FlowError::Degenerate(_) | FlowError::NoClosedOrbit(_))) => {
            let further = Conserved::further(case, model, start, &kept)?;
            if further.is_empty() {
                return Err(error);
            }
            kept.extend(further);
            found(kept)
        }
        found => found,
    }
}

/// Roundings within which a start lies on a surface.
const ROUNDINGS: f64 = 64.0;

/// Follows a motion to a surface, and on until it has crossed it n times more. Returns the state at
/// the first crossing, which may be the start, and the time to the last.
pub fn crossing_time(
    start: &Start,
    surface: &CrossingSurface,
    direction: Direction,
    crossings: usize,
) -> Result<(Start, f64), FlowError> {
    let program = surface.program(&start.parameters)?;
    let is_first = crosses(&program, start, direction);
    let task = CrossingTask {
        program: &program,
        starts: &[Ok(start.clone())],
        direction,
        crossings: crossings + usize::from(!is_first),
        skip: 0,
        backwards: false,
        has_side: false,
    };
    let mut tracks =
        task.run(1, &|| |_: DoubleDouble, state: &[DoubleDouble]| state.to_vec(), &|_| ());
    let track = tracks.pop().ok_or(FlowError::NoStart)?;
    if let (true, Some(last), None) = (is_first, track.crossings.last(), &track.problem) {
        return Ok((start.clone(), last.time));
    }
    let (first, last) = (track.crossings.first(), track.crossings.get(crossings));
    match (first, last, track.problem) {
        (Some(first), Some(last), None) => {
            Ok((Start { state: first.at.clone(), ..start.clone() }, last.time - first.time))
        }
        (_, _, problem) => Err(problem.unwrap_or(FlowError::NoStart)),
    }
}

/// Whether a start lies on a surface, output 0 of the program, and crosses it in a direction.
fn crosses(program: &TaylorProgram, start: &Start, direction: Direction) -> bool {
    let mut stepper = Stepper::<f64>::new(program, Accuracy::FLOAT);
    stepper.start_open(0, &start.state, false);
    stepper.expand();
    let function = stepper.piece(0).output(0);
    let doubt = program.rounding::<f64>(0, &start.state, 0.0);
    let is_on = function[0].abs() <= ROUNDINGS * doubt;
    is_on
        && match direction {
            Direction::Both => function[1] != 0.0,
            Direction::Up => function[1] > 0.0,
            Direction::Down => function[1] < 0.0,
        }
}
