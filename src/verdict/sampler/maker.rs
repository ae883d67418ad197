//! Blocks of balls: enclosures of parameters and states.

use crate::engine::{BallEngine, BallRunner};
use crate::graph::{Evaluator, Fault, Tape};
use crate::mechanics::Streams;
use crate::number::ball::{Ball, Balls};
use crate::number::rational::Rational;

use super::{Sampler, TAPE_LANES};

impl Sampler {
    /// Computes parameters and state of the states `start..start + LANES`, as balls.
    pub fn balls(&self, start: u64) -> Vec<Balls<TAPE_LANES>> {
        match start {
            0 => self.first.get_or_init(|| self.maker().balls(0)).clone(),
            _ => self.maker().balls(start),
        }
    }

    /// Makes a reusable source of many blocks of balls.
    pub(in crate::verdict) fn maker(&self) -> Maker<'_> {
        let blank = Balls::new([f64::NAN; TAPE_LANES], [f64::NAN; TAPE_LANES]);
        Maker {
            sampler: self,
            evaluator: Evaluator::new(&self.tape, Ball::<TAPE_LANES>),
            columns: vec![blank; self.draws.len()],
            streams: self.streams(),
        }
    }

    /// Returns the reason why the states may leave out a part of a level without parametrisation, if
    /// one is known.
    pub(in crate::verdict) fn unreached(&self) -> Result<Option<&'static str>, Fault> {
        let Some(numerical) = &self.newton else { return Ok(None) };
        if numerical.has_corners() {
            return Ok(Some(
                "the states are found numerically, and an equation of the level contains |·|, min or \
                 max: parts of the level may be missed; write a case for each sign",
            ));
        }
        if numerical.has_flat_factors() {
            return Ok(Some(
                "the states are found numerically, and an equation of the level has a factor with slope \
                 0 wherever it is 0: its zeros are not found; write a case for each factor",
            ));
        }
        if numerical.factors().has_unmet(self, &self.balls(0))? {
            return Ok(Some(
                "the states are found numerically, and an equation of the level has a factor that is 0 at \
                 none of those found: a part of the level may be missed; write a case for each factor",
            ));
        }
        let mut maker = self.maker();
        let meets_ends =
            |attempt| numerical.meets_ends(maker.tried(0, &[attempt; TAPE_LANES], None));
        Ok((0..NUMERICAL_ATTEMPTS).any(meets_ends).then_some(
            "the states are found numerically, and those at the end of a range, up to rounding, are \
             left out; make the range larger",
        ))
    }
}

/// Number of draws from which a point of a numerical level inside the ranges is looked for.
const NUMERICAL_ATTEMPTS: u32 = 8;

impl Sampler {
    /// Makes machine code for a tape over parameters and state and `further` numbers, from the draws
    /// on, with some outputs to be tested by lower bounds of radii; `None` where a state takes attempts or steps of Newton's method, or there is no such code.
    pub(in crate::verdict) fn engine(
        &self,
        further: &[Rational],
        tape: &Tape,
        tested: &[usize],
    ) -> Option<BallEngine> {
        if self.is_guarded || self.newton.is_some() {
            return None;
        }
        BallEngine::new(&self.draws.extents(), &self.tape, further, tape, tested)
    }

    /// Random numbers of the draws.
    pub(in crate::verdict) fn streams(&self) -> Streams {
        Streams::new(self.seed)
    }

    /// Fills the inputs of such code for the states `start..start + LANES`; returns whether all that
    /// should be exact are.
    pub(in crate::verdict) fn fill(
        &self,
        streams: &Streams,
        start: u64,
        runner: &mut BallRunner,
    ) -> bool {
        self.draws.fill(streams, start, runner.inputs_mut()) || runner.is_exact()
    }
}

/// A source of blocks of balls with its working memory.
pub struct Maker<'s> {
    sampler: &'s Sampler,
    evaluator: Evaluator<'s, Ball<TAPE_LANES>>,
    /// Draws of the last block.
    columns: Vec<Balls<TAPE_LANES>>,
    streams: Streams,
}

impl Maker<'_> {
    /// Computes parameters and state of the states `start..start + LANES`.
    pub fn balls(&mut self, start: u64) -> Vec<Balls<TAPE_LANES>> {
        self.made(start, None)
    }

    /// Computes states with few parameter sets: one set for every `LANES / sets` states.
    pub fn balls_sharing_parameters(&mut self, start: u64, sets: usize) -> Vec<Balls<TAPE_LANES>> {
        self.made(start, Some(sets))
    }

    /// Computes parameters and state of the states `start..start + LANES` where that takes no
    /// attempts and no steps of Newton's method, and returns them without a copy.
    pub fn straight(&mut self, start: u64) -> Option<impl Iterator<Item = &Balls<TAPE_LANES>>> {
        if self.sampler.is_guarded || self.sampler.newton.is_some() {
            return None;
        }
        self.sampler.draws.fill(&self.streams, start, &mut self.columns);
        self.evaluator.run(&self.columns);
        Some(self.evaluator.outputs())
    }

    fn made(&mut self, start: u64, sets: Option<usize>) -> Vec<Balls<TAPE_LANES>> {
        let sampler = self.sampler;
        let attempts = sampler.attempts(start, TAPE_LANES, sets);
        let mut values = self.tried(start, &attempts, sets);
        let Some(numerical) = &sampler.newton else { return values };
        numerical.project(&mut values);
        for attempt in 1..NUMERICAL_ATTEMPTS {
            let is_open = |lane: usize| values.iter().any(|block| !block.mid[lane].is_finite());
            let open: [bool; TAPE_LANES] = std::array::from_fn(is_open);
            if !open.contains(&true) {
                break;
            }
            let mut others = self.tried(start, &[attempt; TAPE_LANES], sets);
            for block in &mut others {
                for lane in (0..TAPE_LANES).filter(|lane| !open[*lane]) {
                    (block.mid[lane], block.rad[lane]) = (f64::NAN, f64::NAN);
                }
            }
            numerical.project(&mut others);
            for (block, other) in values.iter_mut().zip(&others) {
                for lane in (0..TAPE_LANES).filter(|lane| open[*lane]) {
                    (block.mid[lane], block.rad[lane]) = (other.mid[lane], other.rad[lane]);
                }
            }
        }
        values
    }

    /// Computes the values at one attempt for each lane.
    fn tried(
        &mut self,
        start: u64,
        attempts: &[u32],
        sets: Option<usize>,
    ) -> Vec<Balls<TAPE_LANES>> {
        let sampler = self.sampler;
        if attempts.iter().all(|attempt| *attempt == 0) {
            sampler.draws.fill(&self.streams, start, &mut self.columns);
            if let Some(sets) = sets {
                sampler.share_parameters(start, sets, &mut self.columns);
            }
        } else {
            let lanes: [Vec<(f64, bool)>; TAPE_LANES] = std::array::from_fn(|lane| {
                sampler.nearest(start + lane as u64, attempts[lane], sets)
            });
            for (k, column) in self.columns.iter_mut().enumerate() {
                *column = Balls::about(|lane| lanes[lane][k]);
            }
        }
        self.evaluator.run(&self.columns);
        self.evaluator.outputs().cloned().collect()
    }
}
