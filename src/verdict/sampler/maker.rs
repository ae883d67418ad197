//! Blocks of balls: enclosures of parameters and states.

use crate::graph::Evaluator;
use crate::number::ball::{Ball, Balls};

use super::{LANES, Sampler};

impl Sampler {
    /// Computes parameters and state of the states `start..start + LANES`, as balls.
    pub fn balls(&self, start: u64) -> Vec<Balls<LANES>> {
        self.maker().balls(start)
    }

    /// Makes a reusable source of many blocks of balls.
    pub(in crate::verdict) fn maker(&self) -> Maker<'_> {
        Maker { sampler: self, evaluator: Evaluator::new(&self.tape, Ball::<LANES>) }
    }
}

/// A source of blocks of balls with its working memory.
pub struct Maker<'s> {
    sampler: &'s Sampler,
    evaluator: Evaluator<'s, Ball<LANES>>,
}

impl Maker<'_> {
    /// Computes parameters and state of the states `start..start + LANES`.
    pub fn balls(&mut self, start: u64) -> Vec<Balls<LANES>> {
        self.made(start, None)
    }

    /// Computes states with few parameter sets: one set for every `LANES / sets` states.
    pub fn balls_sharing_parameters(&mut self, start: u64, sets: usize) -> Vec<Balls<LANES>> {
        self.made(start, Some(sets))
    }

    fn made(&mut self, start: u64, sets: Option<usize>) -> Vec<Balls<LANES>> {
        let sampler = self.sampler;
        let attempts = sampler.attempts(start, LANES, sets);
        let lanes: [Vec<(f64, bool)>; LANES] =
            std::array::from_fn(|lane| sampler.nearest(start + lane as u64, attempts[lane], sets));
        let column = |k: usize| Balls::about(|lane| lanes[lane][k]);
        let columns: Vec<Balls<LANES>> = (0..self.sampler.draws.len()).map(column).collect();
        self.evaluator.run(&columns);
        let mut values: Vec<Balls<LANES>> = self.evaluator.outputs().cloned().collect();
        if let Some(newton) = &self.sampler.newton {
            newton.project(&mut values);
        }
        values
    }
}
