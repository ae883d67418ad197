//! Lyapunov exponents and the mean divergence along a motion.
//!
//! The variational equations u' = (dv)u, their field recorded by num-dual, are followed with the
//! motion, and the divergence is integrated beside them. u is made a unit vector after each step;
//! the sum of the logarithms over the time is the largest exponent. The time after the first tenth
//! is cut into blocks, whose spread gives the standard error: an honest one only where a block is
//! longer than the slow drift between regions.

use super::error::FlowError;
use super::motion::extended_program;
use super::program::Program;
use super::start::{Start, across_level};
use super::stepper::{Accuracy, Stepper};
use crate::mechanics::Model;
use crate::mechanics::calculus::Jet;
use crate::number::pair::Pair;
use crate::number::rational::Rational;

/// Blocks after the part that is left out.
const BLOCKS: usize = 10;
/// Standard errors by which a mean has to differ from 0.
const ERRORS: f64 = 3.0;

/// A mean with its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The mean over all blocks.
    pub mean: f64,
    /// Its standard error, from their spread.
    pub error: f64,
    /// The mean over the later half of the blocks.
    pub later: f64,
}

/// What kind of motion it looks like; the numbers beside it say how sure that is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Character {
    /// No positive exponent: periodic, quasiperiodic, or drawn to such a motion.
    Regular,
    /// A positive exponent, and volume is kept on average.
    ConservativeChaos,
    /// A positive exponent, and a divergence that does not keep one sign.
    DissipativeChaos,
    /// A positive exponent, and volume shrinks in time.
    StrangeAttractor,
    /// A positive exponent, and volume grows in time: the attractor of the reversed motion.
    StrangeRepeller,
}

impl Character {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Character::Regular => "regular",
            Character::ConservativeChaos => "conservative chaos",
            Character::DissipativeChaos => "dissipative chaos",
            Character::StrangeAttractor => "strange attractor",
            Character::StrangeRepeller => "strange repeller",
        }
    }
}

/// The largest exponent and the mean divergence along a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponents {
    /// How long the motion was followed.
    pub time: f64,
    /// The largest Lyapunov exponent, in the time of the equations.
    pub largest: Estimate,
    /// The mean of div v along the motion.
    pub divergence: Estimate,
    /// What it looks like.
    pub character: Character,
}

/// A motion with a vector along the flow and ∫ div v beside it.
pub struct Variational {
    program: Program,
    dimension: usize,
    begin: Vec<Pair>,
}

impl Variational {
    /// The motion from a start, the vector along the level set.
    pub fn new(model: &Model, start: &Start) -> Result<Self, FlowError> {
        let dimension = model.dimension();
        let program = variational_program(model, &start.parameters, 1)?;
        let mut begin = start.state.clone();
        begin.extend(across_level(model, start)?.into_iter().map(Pair::from_f64));
        begin.push(Pair::default());
        Ok(Self { program, dimension, begin })
    }

    /// Follows the motion for a time, negative for backwards.
    pub fn exponents(&self, time: f64) -> Result<Exponents, FlowError> {
        follow(&self.program, self.dimension, &self.begin, time)
    }
}

/// The field with this many vectors along the flow, and div v on the level, behind the state.
pub(super) fn variational_program(
    model: &Model,
    parameters: &[Rational],
    vectors: usize,
) -> Result<Program, FlowError> {
    let dimension = model.dimension();
    extended_program(model, parameters, vectors * dimension + 1, |phase, more| {
        let jet = Jet::new(phase.with(&[], &phase.state()));
        let mut rates = jet.phase.field().to_vec();
        for vector in more[..vectors * dimension].chunks(dimension) {
            rates.extend(jet.phase.lift(vector).field().iter().map(|rate| rate.eps));
        }
        let level = vec![true; model.level.len()];
        rates.push(jet.divergence() - jet.level_cofactor(&level));
        (rates, Vec::new())
    })
}

fn follow(
    program: &Program,
    dimension: usize,
    begin: &[Pair],
    time: f64,
) -> Result<Exponents, FlowError> {
    let mut stepper = Stepper::<f64>::new(program, Accuracy::FLOAT);
    let block = time * 0.9 / BLOCKS as f64;
    let mut ends = vec![time * 0.1];
    ends.extend((1..=BLOCKS).map(|k| time * 0.1 + block * k as f64));
    stepper.start(0, begin, Pair::from_f64(ends[0]));
    let (mut growth, mut volume) = (Vec::new(), Vec::new());
    let mut expanded = 0.0;
    for end in ends {
        stepper.extend(0, Pair::from_f64(end));
        let (before, volume_before) = (expanded, stepper.pairs(0)[2 * dimension].hi);
        while !stepper.is_done(0) {
            stepper.expand();
            stepper.check(0)?;
            stepper.advance();
            let vector = &stepper.pairs(0)[dimension..2 * dimension];
            let length = vector.iter().map(|x| x.hi * x.hi).sum::<f64>().sqrt();
            expanded += libm::log(length);
            stepper.scale(0, dimension..2 * dimension, 1.0 / length);
        }
        growth.push((expanded - before) / block.abs());
        volume.push((stepper.pairs(0)[2 * dimension].hi - volume_before) / block);
    }
    let (largest, divergence) = (estimate(&growth[1..]), estimate(&volume[1..]));
    let character = character(largest, divergence, time);
    Ok(Exponents { time, largest, divergence, character })
}

fn estimate(blocks: &[f64]) -> Estimate {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let all = mean(blocks);
    let spread = blocks.iter().map(|x| (x - all) * (x - all)).sum::<f64>();
    let count = blocks.len() as f64;
    let error = (spread / (count * (count - 1.0))).sqrt();
    Estimate { mean: all, error, later: mean(&blocks[blocks.len() / 2..]) }
}

/// An exponent counts as positive when it is so by its error, also in the later half alone, and
/// beyond (ln t)/t, which a regular motion shows.
fn character(largest: Estimate, divergence: Estimate, time: f64) -> Character {
    let regular = libm::log(time.abs().max(std::f64::consts::E)) / time.abs();
    let least = (ERRORS * largest.error).max(regular);
    if largest.mean <= least || largest.later <= least {
        return Character::Regular;
    }
    let significant = |value: f64| value.abs() > ERRORS * divergence.error;
    // The volume that a motion of finite length gains or loses at its ends.
    let bounded = divergence.mean.abs() * time.abs() < 10.0;
    match significant(divergence.mean) && !bounded {
        false => Character::ConservativeChaos,
        true if divergence.mean * divergence.later <= 0.0 || !significant(divergence.later) => {
            Character::DissipativeChaos
        }
        true if divergence.mean < 0.0 => Character::StrangeAttractor,
        true => Character::StrangeRepeller,
    }
}
