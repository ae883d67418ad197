//! Nodes of a closed orbit, as approximate numbers.

use crate::error::FlowError;
use crate::motion::presence::guarded_program;
use crate::motion::start::Start;
use crate::taylor::stepper::{Accuracy, Stepper};
use liouville::mechanics::Model;
use liouville::number::double_double::DoubleDouble;

use super::Obstacle;
use super::motion::ORDER;

/// Nodes of an orbit with the shares of its period between them.
#[derive(Clone, Debug)]
pub struct Nodes {
    pub states: Vec<Vec<f64>>,
    pub shares: Vec<f64>,
    pub period: f64,
}

/// Result of dividing a motion.
enum Divided {
    Whole(Nodes),
    /// It takes more steps than are allowed.
    TooLong,
    /// No step is allowed from this time on.
    Ends(f64),
}

impl Nodes {
    /// Follows a motion for a time; each step is a segment. A larger `kappa` makes shorter ones.
    pub fn along(
        model: &Model,
        start: &Start,
        time: f64,
        kappa: f64,
        most: usize,
    ) -> Result<Option<Self>, FlowError> {
        Self::followed(model, start, time, kappa, most, &|_, step| Some(step)).map(|found| {
            match found {
                Divided::Whole(nodes) => Some(nodes),
                Divided::TooLong | Divided::Ends(_) => None,
            }
        })
    }

    /// The same, with steps no longer than `longest` returns for a state and a step; fails where it
    /// returns none.
    pub fn shortened(
        model: &Model,
        start: &Start,
        time: f64,
        kappa: f64,
        most: usize,
        longest: &dyn Fn(&[f64], f64) -> Option<f64>,
    ) -> Result<Option<Self>, Obstacle> {
        match Self::followed(model, start, time, kappa, most, longest)? {
            Divided::Whole(nodes) => Ok(Some(nodes)),
            Divided::TooLong => Ok(None),
            Divided::Ends(time) => Err(Obstacle::NoStep(time)),
        }
    }

    fn followed(
        model: &Model,
        start: &Start,
        time: f64,
        kappa: f64,
        most: usize,
        longest: &dyn Fn(&[f64], f64) -> Option<f64>,
    ) -> Result<Divided, FlowError> {
        let program = guarded_program(model, &start.parameters)?;
        let mut stepper = Stepper::<f64>::new(&program, Accuracy { order: ORDER, kappa });
        let mut state = start.state.clone();
        state.resize(program.dimension(), DoubleDouble::default());
        stepper.start(0, &state, DoubleDouble::from_f64(time));
        let (mut states, mut shares) = (Vec::new(), Vec::new());
        while !stepper.is_done(0) {
            if states.len() == most {
                return Ok(Divided::TooLong);
            }
            stepper.expand();
            stepper.check(0)?;
            let state = stepper.pairs(0).into_iter().take(start.state.len());
            let state: Vec<f64> = state.map(|x| x.hi).collect();
            let step = stepper.step(0);
            match longest(&state, step) {
                None => return Ok(Divided::Ends(stepper.time(0).hi)),
                Some(shorter) if shorter < step => stepper.shorten(0, shorter / step),
                Some(_) => {}
            }
            states.push(state);
            shares.push(stepper.step(0) / time);
            stepper.advance();
        }
        Ok(Divided::Whole(Self { states, shares, period: time }))
    }

    /// Adds a step to all unknowns.
    pub fn move_by(&mut self, step: &[f64]) {
        let mut step = step.iter();
        for (x, dx) in self.states.iter_mut().flatten().zip(step.by_ref()) {
            *x += dx;
        }
        self.period += step.next().copied().unwrap_or(f64::NAN);
    }
}
