//! Lyapunov exponents, mean divergence and alignment index of a motion, and its class.
//!
//! The time after the first tenth is cut into blocks, whose spread gives the standard error. The
//! error is reliable only where a block is longer than the slow drift between regions.

use crate::motion::extent::Extent;
use crate::motion::trend::GrowthTrend;
use liouville::number::double_double::DoubleDouble;
use serde::{Deserialize, Serialize};

/// Number of blocks after the transient.
pub(crate) const BLOCKS: usize = 10;
/// Fraction of the time left out as transient.
pub(crate) const SKIPPED: f64 = 0.1;
/// Smallest deviation of a mean from 0 that counts, in standard errors.
pub(crate) const ERRORS: f64 = 3.0;
/// Distance below which two unit vectors count as parallel or antiparallel.
const PARALLEL: f64 = 1e-8;
/// Logarithm of the largest volume that a bounded motion gains or loses between its ends.
pub(crate) const ENDS: f64 = 10.0;

/// A mean with its standard error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Mean over all blocks.
    #[serde(with = "crate::record")]
    pub mean: f64,
    /// Standard error of the mean, from the spread of the blocks.
    #[serde(with = "crate::record")]
    pub error: f64,
    /// Mean over the later half of the blocks.
    #[serde(with = "crate::record")]
    pub later: f64,
}

/// Apparent kind of motion; the estimates next to it show how sure that is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Character {
    /// No positive exponent: periodic, quasiperiodic, or attracted to such a motion.
    Regular,
    /// A positive exponent at a point at which the motion rests.
    UnstableRest,
    /// A positive exponent of a motion that goes farther and farther away.
    Escape,
    /// A positive exponent of a map that takes several states to one.
    Chaos,
    /// A positive exponent; volume is preserved on average.
    ConservativeChaos,
    /// A positive exponent; the divergence changes sign.
    DissipativeChaos,
    /// A positive exponent; volume grows in time: the attractor of the reversed motion.
    StrangeRepeller,
    /// A positive exponent; volume shrinks in time.
    StrangeAttractor,
}

impl Character {
    /// All classes of motions in time, in order of distance from regular motion.
    pub const ALL: [Self; 7] = [
        Character::Regular,
        Character::UnstableRest,
        Character::Escape,
        Character::ConservativeChaos,
        Character::DissipativeChaos,
        Character::StrangeRepeller,
        Character::StrangeAttractor,
    ];

    /// Name of the class in reports.
    pub fn name(self) -> &'static str {
        match self {
            Character::Regular => "regular",
            Character::UnstableRest => "unstable rest",
            Character::Escape => "escape",
            Character::Chaos => "chaos",
            Character::ConservativeChaos => "conservative chaos",
            Character::DissipativeChaos => "dissipative chaos",
            Character::StrangeAttractor => "strange attractor",
            Character::StrangeRepeller => "strange repeller",
        }
    }

    /// Whether the motion is chaotic.
    fn is_chaos(self) -> bool {
        !matches!(self, Character::Regular | Character::UnstableRest | Character::Escape)
    }
}

/// Alignment of two tangent vectors carried along the flow (SALI; Skokos 2001).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Alignment {
    /// min(|u + w|, |u - w|) of the two unit vectors at the end.
    #[serde(with = "crate::record")]
    pub index: f64,
    /// Time since which they have been parallel up to rounding, if they are.
    #[serde(with = "crate::record")]
    pub since: Option<f64>,
}

/// Largest exponent, mean divergence and alignment index of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Exponents {
    /// Time for which the motion was followed.
    #[serde(with = "crate::record")]
    pub time: f64,
    /// Largest Lyapunov exponent, in the time of the equations.
    pub largest: Estimate,
    /// Mean of div v along the motion.
    pub divergence: Estimate,
    /// Alignment of two tangent vectors; `None` where only one was followed.
    pub alignment: Option<Alignment>,
    /// Apparent kind of motion.
    pub character: Character,
    /// Growth block by block, on which claims are judged; it is not written.
    #[serde(skip)]
    pub(crate) trend: GrowthTrend,
}

impl Exponents {
    /// Exponents of a motion that were written, without their blocks.
    pub fn written(
        time: f64,
        [largest, divergence]: [Estimate; 2],
        alignment: Option<Alignment>,
        character: Character,
    ) -> Self {
        let trend = GrowthTrend::default();
        Self { time, largest, divergence, alignment, character, trend }
    }

    /// Class of a motion that was followed in both directions of time: chaos is conservative where
    /// volume is preserved either way.
    pub fn class(&self, backward: &Exponents) -> Character {
        use Character::{ConservativeChaos, DissipativeChaos, StrangeAttractor};
        if self.character != ConservativeChaos {
            return self.character;
        }
        // Volume that shrinks forwards and backwards, as between a repeller and its attractor.
        let difference = Estimate {
            mean: self.divergence.mean - backward.divergence.mean,
            error: libm::hypot(self.divergence.error, backward.divergence.error),
            later: self.divergence.later - backward.divergence.later,
        };
        let is_chaos = backward.character.is_chaos();
        match difference.mean < 0.0 && is_chaos && difference.is_settled(self.time) {
            true => StrangeAttractor,
            false if backward.divergence.is_settled(self.time) => DissipativeChaos,
            false => ConservativeChaos,
        }
    }
}

impl Estimate {
    /// Whether a mean divergence differs from 0 by more than its error, and by more than the volume
    /// that a motion of finite length gains or loses at its ends.
    pub(crate) fn is_settled(&self, time: f64) -> bool {
        self.mean.abs() > ERRORS * self.error && self.mean.abs() * time.abs() >= ENDS
    }
}

/// Sums along one motion, block by block.
pub(crate) struct Record {
    time: f64,
    /// Logarithm of the growth of the vector so far.
    expanded: f64,
    growth: Vec<f64>,
    volume: Vec<f64>,
    at_last_end: (f64, f64),
    alignment: Option<Alignment>,
    extent: Extent,
    /// Smallest exponent that counts as positive, in standard errors.
    errors: f64,
    /// Whether the motion is on a surface, where there is no chaos.
    is_on_surface: bool,
}

impl Record {
    /// An empty record of a motion that will be followed for this time.
    pub fn new(time: f64) -> Self {
        Self {
            time,
            expanded: 0.0,
            growth: Vec::new(),
            volume: Vec::new(),
            at_last_end: (0.0, 0.0),
            alignment: None,
            extent: Extent::default(),
            errors: ERRORS,
            is_on_surface: false,
        }
    }

    /// An empty record of a motion too short for its blocks to estimate the error of its exponent:
    /// growth faster than a power of the time counts as chaos.
    pub fn short(time: f64) -> Self {
        Self { errors: 0.0, ..Self::new(time) }
    }

    /// The record of a motion on a level of this dimension: flows on surfaces have no entropy (Young
    /// 1977).
    pub fn on_level(self, dimension: usize) -> Self {
        Self { is_on_surface: dimension <= 2, ..self }
    }

    fn block(&self) -> f64 {
        self.time * (1.0 - SKIPPED) / BLOCKS as f64
    }

    /// Time at which the current block ends; `None` after the last one.
    pub fn end(&self) -> Option<f64> {
        let done = self.growth.len();
        (done <= BLOCKS).then(|| self.time * SKIPPED + self.block() * done as f64)
    }

    /// Records the length of the vector, which is then normalised.
    pub fn grow(&mut self, length: f64) {
        self.expanded += libm::log(length);
    }

    /// Records a state on the way.
    pub fn visit(&mut self, state: &[DoubleDouble]) {
        self.extent.visit(self.growth.len(), state);
    }

    /// Records the alignment index of the two unit vectors at a time.
    pub fn align(&mut self, now: f64, index: f64) {
        let before = self.alignment.and_then(|known| known.since);
        let since = match index < PARALLEL {
            true => before.or(Some(now)),
            false => None,
        };
        self.alignment = Some(Alignment { index, since });
    }

    /// Ends a block, at which ∫ div v is `volume`.
    pub fn finish_block(&mut self, volume: f64) {
        self.finish_block_of(self.block(), volume);
    }

    /// The same with a block of this length.
    pub fn finish_block_of(&mut self, length: f64, volume: f64) {
        let (expanded, before) = self.at_last_end;
        self.growth.push((self.expanded - expanded) / length.abs());
        self.volume.push((volume - before) / length);
        self.at_last_end = (self.expanded, volume);
    }

    /// Evaluates the sums.
    pub fn exponents(&self) -> Exponents {
        let (largest, divergence) = (estimate(&self.growth[1..]), estimate(&self.volume[1..]));
        let (time, alignment) = (self.time, self.alignment);
        let character = self.character(largest, divergence);
        let spreads = self.extent.spreads();
        let trend = GrowthTrend::new(&self.growth[1..], spreads.get(1..).unwrap_or_default());
        Exponents { time, largest, divergence, alignment, character, trend }
    }

    /// Classifies the motion. An exponent counts as positive when it exceeds its error, also in the
    /// later half alone, and (ln t)/t, which a regular motion shows, and if the vectors became as
    /// parallel as it predicts.
    fn character(&self, largest: Estimate, divergence: Estimate) -> Character {
        let time = self.time.abs();
        let regular = libm::log(time.max(std::f64::consts::E)) / time;
        let least = (self.errors * largest.error).max(regular);
        // The vectors align like e^(-λt), where the second exponent is 0.
        let expected = libm::exp(-largest.mean * time / 2.0).max(PARALLEL);
        let is_aligned = self.alignment.is_none_or(|found| found.index <= expected);
        if largest.mean <= least || largest.later <= least {
            return Character::Regular;
        }
        // Equal exponents, as at a focus, never align vectors.
        if let Some(without_chaos) = self.extent.character() {
            return without_chaos;
        }
        if self.is_on_surface || !is_aligned {
            return Character::Regular;
        }
        let keeps_sign = divergence.mean * divergence.later > 0.0
            && divergence.later.abs() > ERRORS * divergence.error;
        match divergence.is_settled(time) {
            false => Character::ConservativeChaos,
            true if !keeps_sign => Character::DissipativeChaos,
            true if divergence.mean < 0.0 => Character::StrangeAttractor,
            true => Character::StrangeRepeller,
        }
    }
}

/// Mean of blocks, with its standard error.
pub(crate) fn estimate(blocks: &[f64]) -> Estimate {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let all = mean(blocks);
    let spread = blocks.iter().map(|x| (x - all) * (x - all)).sum::<f64>();
    let count = blocks.len() as f64;
    let error = (spread / (count * (count - 1.0))).sqrt();
    Estimate { mean: all, error, later: mean(&blocks[blocks.len() / 2..]) }
}
