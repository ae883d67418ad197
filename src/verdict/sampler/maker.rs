//! Blocks of balls: enclosures of parameters and states.

use crate::graph::Evaluator;
use crate::number::ball::{Ball, Balls};

use super::{Sampler, TAPE_LANES};

impl Sampler {
    /// Computes parameters and state of the states `start..start + LANES`, as balls.
    pub fn balls(&self, start: u64) -> Vec<Balls<TAPE_LANES>> {
        self.maker().balls(start)
    }

    /// Makes a reusable source of many blocks of balls.
    pub(in crate::verdict) fn maker(&self) -> Maker<'_> {
        let blank = Balls::new([f64::NAN; TAPE_LANES], [f64::NAN; TAPE_LANES]);
        Maker {
            sampler: self,
            evaluator: Evaluator::new(&self.tape, Ball::<TAPE_LANES>),
            columns: vec![blank; self.draws.len()],
        }
    }
}

/// A source of blocks of balls with its working memory.
pub struct Maker<'s> {
    sampler: &'s Sampler,
    evaluator: Evaluator<'s, Ball<TAPE_LANES>>,
    /// Draws of the last block.
    columns: Vec<Balls<TAPE_LANES>>,
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
        self.sampler.draws.fill(self.sampler.seed, start, &mut self.columns);
        self.evaluator.run(&self.columns);
        Some(self.evaluator.outputs())
    }

    fn made(&mut self, start: u64, sets: Option<usize>) -> Vec<Balls<TAPE_LANES>> {
        let sampler = self.sampler;
        let attempts = sampler.attempts(start, TAPE_LANES, sets);
        if sets.is_none() && attempts.iter().all(|attempt| *attempt == 0) {
            sampler.draws.fill(sampler.seed, start, &mut self.columns);
        } else {
            let lanes: [Vec<(f64, bool)>; TAPE_LANES] = std::array::from_fn(|lane| {
                sampler.nearest(start + lane as u64, attempts[lane], sets)
            });
            for (k, column) in self.columns.iter_mut().enumerate() {
                *column = Balls::about(|lane| lanes[lane][k]);
            }
        }
        self.evaluator.run(&self.columns);
        let mut values: Vec<Balls<TAPE_LANES>> = self.evaluator.outputs().cloned().collect();
        if let Some(newton) = &self.sampler.newton {
            newton.project(&mut values);
        }
        values
    }
}
