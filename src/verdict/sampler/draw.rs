//! States and their draws, in any number domain.

use crate::graph::Evaluator;
use crate::number::Domain;
use crate::number::ball::{Ball, Balls};
use crate::number::rational::Rational;

use super::{Sampler, TAPE_LANES};

impl Sampler {
    /// Computes parameters and state for `lanes` states in another domain; states found numerically
    /// are known in f64 only.
    pub fn states<D: Domain + Clone>(&self, domain: &D, lanes: usize, start: u64) -> Vec<D::Block> {
        self.made_in(domain, &self.numbers(lanes, start))
    }

    /// Returns the draws of `lanes` states in a domain.
    pub fn drawn<D: Domain>(&self, domain: &D, lanes: usize, start: u64) -> Vec<D::Block> {
        self.columns(domain, &self.numbers(lanes, start))
    }

    /// Computes parameters and one state from given numbers instead of draws.
    pub fn made_from<D: Domain + Clone>(&self, domain: &D, numbers: &[Rational]) -> Vec<D::Block> {
        self.made_in(domain, &[numbers.to_vec()])
    }

    /// Computes parameters and states from given numbers, one list for each lane, as balls.
    pub fn balls_from(&self, lanes: &[Vec<f64>; TAPE_LANES]) -> Vec<Balls<TAPE_LANES>> {
        let mut evaluator = Evaluator::new(&self.tape, Ball::<TAPE_LANES>);
        let column = |k: usize| Balls::about(|lane| (lanes[lane][k], true));
        evaluator.run(&(0..self.draws.len()).map(column).collect::<Vec<_>>());
        evaluator.outputs().cloned().collect()
    }

    pub(super) fn numbers(&self, lanes: usize, start: u64) -> Vec<Vec<Rational>> {
        let attempts = self.attempts(start, lanes, None);
        let state = |(lane, attempt)| self.draws.attempt(self.seed, start + lane as u64, attempt);
        attempts.into_iter().enumerate().map(state).collect()
    }

    /// Computes states in another domain with few parameter sets: one for every `LANES / sets`
    /// states.
    pub fn states_sharing_parameters<D: Domain + Clone>(
        &self,
        domain: &D,
        start: u64,
        sets: usize,
    ) -> Vec<D::Block> {
        let attempts = self.attempts(start, TAPE_LANES, Some(sets));
        let state = |(lane, attempt)| self.drawn_numbers(start + lane as u64, attempt, Some(sets));
        let numbers: Vec<Vec<Rational>> = attempts.into_iter().enumerate().map(state).collect();
        self.made_in(domain, &numbers)
    }

    /// Computes one of these states in a domain of one lane.
    pub fn state_sharing_parameters<D: Domain + Clone>(
        &self,
        domain: &D,
        index: u64,
        sets: usize,
    ) -> Vec<D::Block> {
        let attempt = self.attempts(index, 1, Some(sets))[0];
        let values = self.drawn_numbers(index, attempt, Some(sets));
        self.made_in(domain, &[values])
    }

    /// Computes states in another domain near the ends of ranges and near 0, with few parameter
    /// sets.
    pub fn states_at_edges<D: Domain + Clone>(
        &self,
        domain: &D,
        start: u64,
        sets: usize,
    ) -> Vec<D::Block> {
        let shared: Vec<Vec<Rational>> =
            (0..sets).map(|set| self.draws.state(self.seed, set as u64)).collect();
        let state = |lane: usize| {
            let mut values = self.draws.edge(self.seed, start + lane as u64);
            let own = &shared[lane * sets / TAPE_LANES];
            values[..self.parameter_draws].clone_from_slice(&own[..self.parameter_draws]);
            values
        };
        self.made_in(domain, &(0..TAPE_LANES).map(state).collect::<Vec<_>>())
    }

    /// Converts the draws of some states to a domain, one block for each draw.
    fn columns<D: Domain>(&self, domain: &D, lanes: &[Vec<Rational>]) -> Vec<D::Block> {
        (0..self.draws.len())
            .map(|k| {
                let column: Vec<Rational> = lanes.iter().map(|lane| lane[k].clone()).collect();
                domain.values(&column)
            })
            .collect()
    }

    /// Computes parameters and states from draws.
    pub(super) fn made_in<D: Domain + Clone>(
        &self,
        domain: &D,
        lanes: &[Vec<Rational>],
    ) -> Vec<D::Block> {
        let mut evaluator = Evaluator::new(&self.tape, domain.clone());
        evaluator.run(&self.columns(domain, lanes));
        evaluator.outputs().cloned().collect()
    }

    /// Returns the draws of a state in f64, and whether each is exact.
    pub fn nearest_draws(&self, index: u64) -> Vec<(f64, bool)> {
        self.draws.nearest(self.seed, index, 0)
    }

    /// Returns the draws of a state near the ends of ranges, in f64.
    pub fn nearest_edge(&self, index: u64) -> Vec<(f64, bool)> {
        self.draws.nearest_edge(self.seed, index)
    }
}
