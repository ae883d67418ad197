//! Lyapunov exponents, the mean divergence and the alignment index of a motion, and its class.
//!
//! The time after the first tenth is cut into blocks, whose spread gives the standard error: an
//! honest one only where a block is longer than the slow drift between regions.

/// Blocks after the part that is left out.
const BLOCKS: usize = 10;
/// The part of the time that is left out, in blocks' ends.
const SKIPPED: f64 = 0.1;
/// Standard errors by which a mean has to differ from 0.
const ERRORS: f64 = 3.0;
/// Two unit vectors nearer than that, or than it to opposite, are parallel but for rounding.
const PARALLEL: f64 = 1e-8;
/// The logarithm of the largest volume that a bounded motion gains or loses between its ends.
const ENDS: f64 = 10.0;

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
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Character {
    /// No positive exponent: periodic, quasiperiodic, or drawn to such a motion.
    Regular,
    /// A positive exponent, and volume is kept on average.
    ConservativeChaos,
    /// A positive exponent, and a divergence that does not keep one sign.
    DissipativeChaos,
    /// A positive exponent, and volume grows in time: the attractor of the reversed motion.
    StrangeRepeller,
    /// A positive exponent, and volume shrinks in time.
    StrangeAttractor,
}

impl Character {
    /// All of them, from order to the furthest from it.
    pub const ALL: [Self; 5] = [
        Character::Regular,
        Character::ConservativeChaos,
        Character::DissipativeChaos,
        Character::StrangeRepeller,
        Character::StrangeAttractor,
    ];

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

/// How two vectors along the flow come to lie along one line (SALI; Skokos 2001).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alignment {
    /// min(|u + w|, |u - w|) of the two unit vectors at the end.
    pub index: f64,
    /// When they were parallel up to rounding, if they ever were.
    pub since: Option<f64>,
}

/// The largest exponent, the mean divergence and the alignment index along a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponents {
    /// How long the motion was followed.
    pub time: f64,
    /// The largest Lyapunov exponent, in the time of the equations.
    pub largest: Estimate,
    /// The mean of div v along the motion.
    pub divergence: Estimate,
    /// How two vectors along the flow align; `None` where one alone was followed.
    pub alignment: Option<Alignment>,
    /// What it looks like.
    pub character: Character,
}

impl Exponents {
    /// The class of a motion that was followed in both directions of time: chaos is conservative where
    /// volume is kept either way.
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
        let is_chaos = backward.character != Character::Regular;
        match difference.mean < 0.0 && is_chaos && difference.is_settled(self.time) {
            true => StrangeAttractor,
            false if backward.divergence.is_settled(self.time) => DissipativeChaos,
            false => ConservativeChaos,
        }
    }
}

impl Estimate {
    /// Does a mean divergence differ from 0, by its error, and by more than the volume that a motion of
    /// finite length gains or loses at its ends?
    fn is_settled(&self, time: f64) -> bool {
        self.mean.abs() > ERRORS * self.error && self.mean.abs() * time.abs() >= ENDS
    }
}

/// The sums along one motion, from block to block.
pub(super) struct Record {
    time: f64,
    /// The logarithm of how much the vector has grown.
    expanded: f64,
    growth: Vec<f64>,
    volume: Vec<f64>,
    at_last_end: (f64, f64),
    alignment: Option<Alignment>,
    /// Standard errors by which an exponent has to be positive.
    errors: f64,
}

impl Record {
    /// Of a motion that will be followed for this time.
    pub fn new(time: f64) -> Self {
        Self {
            time,
            expanded: 0.0,
            growth: Vec::new(),
            volume: Vec::new(),
            at_last_end: (0.0, 0.0),
            alignment: None,
            errors: ERRORS,
        }
    }

    /// Of a motion that is too short for its blocks to say how far off its exponent is: what grows
    /// faster than a power of the time is chaos.
    pub fn short(time: f64) -> Self {
        Self { errors: 0.0, ..Self::new(time) }
    }

    fn block(&self) -> f64 {
        self.time * (1.0 - SKIPPED) / BLOCKS as f64
    }

    /// When the block at hand ends; `None` after the last one.
    pub fn end(&self) -> Option<f64> {
        let done = self.growth.len();
        (done <= BLOCKS).then(|| self.time * SKIPPED + self.block() * done as f64)
    }

    /// The vector has this length now, and is made a unit vector.
    pub fn grow(&mut self, length: f64) {
        self.expanded += libm::log(length);
    }

    /// The two unit vectors have this index now.
    pub fn align(&mut self, now: f64, index: f64) {
        let before = self.alignment.and_then(|known| known.since);
        let since = match index < PARALLEL {
            true => before.or(Some(now)),
            false => None,
        };
        self.alignment = Some(Alignment { index, since });
    }

    /// A block ends, where ∫ div v is `volume`.
    pub fn finish_block(&mut self, volume: f64) {
        let (expanded, before) = self.at_last_end;
        self.growth.push((self.expanded - expanded) / self.block().abs());
        self.volume.push((volume - before) / self.block());
        self.at_last_end = (self.expanded, volume);
    }

    /// What it comes to.
    pub fn exponents(&self) -> Exponents {
        let (largest, divergence) = (estimate(&self.growth[1..]), estimate(&self.volume[1..]));
        let (time, alignment) = (self.time, self.alignment);
        let character = self.character(largest, divergence);
        Exponents { time, largest, divergence, alignment, character }
    }

    /// An exponent counts as positive when it is so by its error, also in the later half alone, beyond
    /// (ln t)/t, which a regular motion shows, and if vectors came to be as parallel as it lets expect.
    fn character(&self, largest: Estimate, divergence: Estimate) -> Character {
        let time = self.time.abs();
        let regular = libm::log(time.max(std::f64::consts::E)) / time;
        let least = (self.errors * largest.error).max(regular);
        // They align like e^(-λt), where the second exponent is 0.
        let expected = libm::exp(-largest.mean * time / 2.0).max(PARALLEL);
        let is_aligned = self.alignment.is_none_or(|found| found.index <= expected);
        if largest.mean <= least || largest.later <= least || !is_aligned {
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

fn estimate(blocks: &[f64]) -> Estimate {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let all = mean(blocks);
    let spread = blocks.iter().map(|x| (x - all) * (x - all)).sum::<f64>();
    let count = blocks.len() as f64;
    let error = (spread / (count * (count - 1.0))).sqrt();
    Estimate { mean: all, error, later: mean(&blocks[blocks.len() / 2..]) }
}
