//! The recorded residual, run in each number domain.
//!
//! A further domain is one implementation of [`Probe`] and one line in [`all`].

use super::candidate::{Block, Candidate};
use liouville::graph::{Evaluator, Tape};
use liouville::number::Domain;
use liouville::number::arb::{Approximation, ArbBall};
use liouville::number::ball::{Ball, Balls};
use liouville::number::double_double_ball::{DoubleDoubleBall, DoubleDoubleBalls};
use liouville::number::float::Float;
use liouville::number::rational::Rational;
use liouville::verdict::TAPE_LANES;

/// Domain whose results can be read off exactly.
pub trait Probe: Domain {
    /// Number of states of a block.
    const LANES: usize;

    /// Number in a lane (the midpoint, if it is an enclosure).
    fn exact(block: &Self::Block, lane: usize) -> Option<Approximation>;

    /// Radius of the enclosure in a lane, in domains that enclose.
    fn radius(_block: &Self::Block, _lane: usize) -> Option<f64> {
        None
    }
}

impl<const N: usize> Probe for Float<N> {
    const LANES: usize = N;

    fn exact(block: &[f64; N], lane: usize) -> Option<Approximation> {
        Approximation::from_f64(block[lane])
    }
}

impl<const N: usize> Probe for Ball<N> {
    const LANES: usize = N;

    fn exact(block: &Balls<N>, lane: usize) -> Option<Approximation> {
        Approximation::from_f64(block.mid[lane]).filter(|_| block.is_defined(lane))
    }

    fn radius(block: &Balls<N>, lane: usize) -> Option<f64> {
        block.is_defined(lane).then(|| block.rad[lane])
    }
}

impl<const N: usize> Probe for DoubleDoubleBall<N> {
    const LANES: usize = N;

    fn exact(block: &DoubleDoubleBalls<N>, lane: usize) -> Option<Approximation> {
        let midpoint = Approximation::from_double_double(block.hi[lane], block.lo[lane], 0.0);
        midpoint.filter(|_| block.is_defined(lane))
    }

    fn radius(block: &DoubleDoubleBalls<N>, lane: usize) -> Option<f64> {
        block.is_defined(lane).then(|| block.rad[lane])
    }
}

impl Probe for ArbBall {
    const LANES: usize = 1;

    fn exact(block: &Option<Approximation>, _lane: usize) -> Option<Approximation> {
        block.as_ref().map(Approximation::midpoint)
    }

    fn radius(block: &Option<Approximation>, _lane: usize) -> Option<f64> {
        // The distance of the midpoint from itself is 0: the rest is the radius.
        block.as_ref().map(|ball| ball.add(&ball.midpoint().neg(), u32::MAX).enclosure().1)
    }
}

/// Candidate with the name of its domain.
pub type Named<'t> = (&'static str, Box<dyn Candidate + 't>);

/// Candidates for the tape in all domains.
pub fn all<'t>(tape: &'t Tape, states: &[Block]) -> Vec<Named<'t>> {
    vec![
        ("f64", in_f64(tape, states)),
        ("ball, f64", run(tape, Ball::<TAPE_LANES>, states)),
        ("ball, double-double", run(tape, DoubleDoubleBall::<TAPE_LANES>, states)),
        ("ball, 128 bits", run(tape, ArbBall::new(128), states)),
        ("ball, 256 bits", run(tape, ArbBall::new(256), states)),
    ]
}

/// Candidate for a tape in f64.
pub fn in_f64<'t>(tape: &'t Tape, states: &[Block]) -> Box<dyn Candidate + 't> {
    run(tape, Float::<TAPE_LANES>, states)
}

fn run<'t, D: Probe + 't>(tape: &'t Tape, domain: D, states: &[Block]) -> Box<dyn Candidate + 't> {
    Box::new(TapeRun::new(tape, domain, states))
}

/// A tape with its inputs in one domain.
pub struct TapeRun<'t, D: Probe> {
    evaluator: Evaluator<'t, D>,
    /// For each block of states, the blocks of the domain that hold it.
    inputs: Vec<Vec<Vec<D::Block>>>,
    results: Vec<D::Block>,
}

impl<'t, D: Probe> TapeRun<'t, D> {
    /// Converts the states to the domain.
    pub fn new(tape: &'t Tape, domain: D, states: &[Block]) -> Self {
        let part = |block: &Block, start: usize| -> Vec<D::Block> {
            let image = |input: &[f64; TAPE_LANES]| {
                let lanes = input[start..].iter().take(D::LANES);
                // States are finite.
                let zero = || Rational::from(0);
                let values: Vec<Rational> =
                    lanes.map(|x| Rational::from_f64(*x).unwrap_or_else(zero)).collect();
                domain.values(&values)
            };
            block.iter().map(image).collect()
        };
        let inputs = states
            .iter()
            .map(|block| {
                (0..TAPE_LANES).step_by(D::LANES).map(|start| part(block, start)).collect()
            })
            .collect();
        let results =
            (0..TAPE_LANES).step_by(D::LANES).map(|_| domain.constant(&Rational::from(0)));
        let results = results.collect();
        Self { evaluator: Evaluator::new(tape, domain), inputs, results }
    }
}

impl<D: Probe> Candidate for TapeRun<'_, D> {
    fn run(&mut self, block: usize) {
        for (inputs, result) in self.inputs[block].iter().zip(&mut self.results) {
            self.evaluator.run(inputs);
            result.clone_from(self.evaluator.output(0));
        }
    }

    fn value(&self, lane: usize) -> Option<Approximation> {
        D::exact(&self.results[lane / D::LANES], lane % D::LANES)
    }

    fn bound(&self, lane: usize) -> Option<f64> {
        D::radius(&self.results[lane / D::LANES], lane % D::LANES)
    }
}
