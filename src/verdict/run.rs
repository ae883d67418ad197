//! Evaluation of a tape of residuals over blocks of states in any number domain.

use std::ops::Range;
use std::sync::OnceLock;

use rayon::prelude::*;

use crate::engine::{BallEngine, BallRunner};
use crate::graph::{Evaluator, Expr, Graph, Tape};
use crate::number::ball::{Ball, Balls};
use crate::number::rational::Rational;
use crate::number::{Domain, Enclosing};

use super::antiderivative_value;
use super::pass::{BallParts, Passed, passed, passed_below};
use super::recorded::OutputLayout;
use super::sampler::{Maker, Sampler, TAPE_LANES};

/// Balls over f64, the first domain of the ladder.
pub type Doubles = Ball<TAPE_LANES>;

/// Values of some outputs of a graph at one block of states.
pub struct Values<D: Domain> {
    blocks: Vec<D::Block>,
    /// Values of parameters and states.
    states: Vec<D::Block>,
}

impl<D: Enclosing> Values<D> {
    /// Whether each lane contains a state with all outputs of some ranges defined.
    pub fn existing(&self, ranges: &[Range<usize>]) -> Vec<bool> {
        let outputs = ranges.iter().flat_map(|range| &self.blocks[range.clone()]);
        let mut existing = vec![true; D::LANES];
        for block in self.states.iter().chain(outputs) {
            for (lane, exists) in existing.iter_mut().enumerate() {
                *exists = *exists && D::enclosure(block, lane).is_some();
            }
        }
        existing
    }
}

impl<D: Domain> Values<D> {
    /// Returns output `index`.
    pub fn output(&self, index: usize) -> &D::Block {
        &self.blocks[index]
    }

    /// Returns the outputs of a range.
    pub fn range(&self, range: Range<usize>) -> Vec<&D::Block> {
        self.blocks[range].iter().collect()
    }
}

/// Largest number of blocks whose values are computed together: enough for many threads, few enough
/// to keep.
pub const MOST_KEPT: u64 = 64;
/// Largest number of blocks that are passed together, of which little is kept.
pub const MOST_PASSED: u64 = 4096;

/// Number of blocks in a wave from which on machine code pays.
const MANY: u64 = 1024;

/// Divides blocks into waves of increasing length, so that claims decided early cost little.
pub fn waves(blocks: Range<u64>, most: u64) -> impl Iterator<Item = Range<u64>> {
    let (mut next, mut length) = (blocks.start, 1);
    std::iter::from_fn(move || {
        let wave = next..blocks.end.min(next + length);
        (next, length) = (wave.end, most.min(2 * length));
        (!wave.is_empty()).then_some(wave)
    })
}

/// A tape that evaluates `outputs` of `graph` at blocks of inputs.
pub struct Run {
    tape: Tape,
    antiderivatives: usize,
    /// Machine code of the tape with its sampler, once it was needed; `None` where there is none.
    code: OnceLock<Option<BallEngine>>,
}

impl Run {
    /// Lays out the tape; `inputs` are the parameters and the state, followed by antiderivatives.
    pub fn new(graph: &Graph, outputs: &[Expr], inputs: usize) -> Self {
        let antiderivatives = graph.inputs().saturating_sub(inputs);
        Self { tape: Tape::new(graph, outputs), antiderivatives, code: OnceLock::new() }
    }

    /// Computes the outputs at one block of parameters and states.
    pub fn at<D: Domain + Clone>(&self, domain: &D, states: &[D::Block]) -> Values<D> {
        self.with(&mut Evaluator::new(&self.tape, domain.clone()), domain, states)
    }

    /// Computes the outputs at some blocks of states as balls, on all threads, in the order of the
    /// blocks; `make` returns the states of a block.
    pub fn at_blocks(
        &self,
        sampler: &Sampler,
        blocks: Range<u64>,
        make: impl Fn(&mut Maker<'_>, u64) -> Vec<Balls<TAPE_LANES>> + Sync,
    ) -> Vec<Values<Doubles>> {
        let memory = || (sampler.maker(), Evaluator::new(&self.tape, Ball::<TAPE_LANES>));
        let one = |(maker, evaluator): &mut (Maker<'_>, Evaluator<'_, Doubles>), block: u64| {
            let states = make(maker, block * TAPE_LANES as u64);
            self.with(evaluator, &Ball::<TAPE_LANES>, &states)
        };
        blocks.into_par_iter().map_init(memory, one).collect()
    }

    /// Passes some blocks of states, on all threads; returns what each block shows of each claim, in
    /// the order of the blocks, or nothing where the states take more than one run of a tape.
    ///
    /// Ratios of midpoints to radii may be left out where they are at most the `known` one of the
    /// claim.
    pub fn pass(
        &self,
        sampler: &Sampler,
        blocks: Range<u64>,
        layout: &OutputLayout,
        known: &[f64],
    ) -> Option<Vec<Vec<Passed>>> {
        let free = self.free(&Ball::<TAPE_LANES>);
        let general = || (sampler.maker(), Evaluator::new(&self.tape, Ball::<TAPE_LANES>));
        let Some(engine) = self.code(sampler, &blocks, layout) else {
            let one = |memory: &mut (Maker<'_>, Evaluator<'_, Doubles>), block: u64| {
                passed_straight(memory, &free, block, layout)
            };
            return blocks.into_par_iter().map_init(general, one).collect();
        };
        let (streams, computed) = (sampler.streams(), engine.computed());
        let limits: Vec<f64> = known.iter().map(|known| Passed::limit(*known)).collect();
        let one = |(runner, tries): &mut (BallRunner, Tries), block: u64| {
            if !sampler.fill(&streams, block * TAPE_LANES as u64, runner) {
                return passed_straight(&mut general(), &free, block, layout);
            }
            if tries.pay() && runner.run_lower() {
                let output = |index: usize| runner.lower(index).map(|[mid, low]| [&mid.0, &low.0]);
                let found = passed_below(output, layout, &limits);
                tries.count(found.is_some());
                if found.is_some() {
                    return found;
                }
            }
            runner.run();
            // Not `map`, which is a call for each output.
            let output = |index: usize| {
                let [mid, rad] = runner.output(index);
                [&mid.0, &rad.0]
            };
            let draws = runner.inexact().map(|[mid, rad]| [&mid.0, &rad.0]);
            let states = draws.chain((0..computed).map(output));
            Some(passed(states, |index| output(computed + index), layout))
        };
        let memory = || (engine.runner(), Tries::default());
        blocks.into_par_iter().map_init(memory, one).collect()
    }

    /// Returns machine code where there are enough blocks for it, and it can be made.
    fn code(
        &self,
        sampler: &Sampler,
        blocks: &Range<u64>,
        layout: &OutputLayout,
    ) -> Option<&BallEngine> {
        if blocks.end - blocks.start < MANY {
            return None;
        }
        let make = || {
            let further: Vec<Rational> =
                (0..self.antiderivatives).map(antiderivative_value).collect();
            let tested: Vec<usize> = layout.residuals().collect();
            sampler.engine(&further, &self.tape, &tested)
        };
        self.code.get_or_init(make).as_ref()
    }

    /// Returns the values of antiderivatives, which are inputs behind the state.
    fn free<D: Domain>(&self, domain: &D) -> Vec<D::Block> {
        (0..self.antiderivatives).map(|k| domain.constant(&antiderivative_value(k))).collect()
    }

    fn with<D: Domain>(
        &self,
        evaluator: &mut Evaluator<'_, D>,
        domain: &D,
        states: &[D::Block],
    ) -> Values<D> {
        let free = self.free(domain);
        evaluator.run(states.iter().chain(&free));
        Values { blocks: evaluator.outputs().cloned().collect(), states: states.to_vec() }
    }
}

/// Numbers of blocks that were tried with lower bounds of radii, and that these were enough for.
#[derive(Debug, Default)]
struct Tries {
    all: u32,
    enough: u32,
}

impl Tries {
    /// Whether a try pays: it takes about half the time that it may save.
    fn pay(&self) -> bool {
        const FIRST: u32 = 16;
        self.all < FIRST || 2 * self.enough > self.all
    }

    fn count(&mut self, is_enough: bool) {
        self.all += 1;
        self.enough += u32::from(is_enough);
    }
}

/// Passes a block of states that takes one run of each tape.
fn passed_straight(
    (maker, evaluator): &mut (Maker<'_>, Evaluator<'_, Doubles>),
    free: &[Balls<TAPE_LANES>],
    block: u64,
    layout: &OutputLayout,
) -> Option<Vec<Passed>> {
    let states: Vec<&Balls<TAPE_LANES>> = maker.straight(block * TAPE_LANES as u64)?.collect();
    evaluator.run(states.iter().copied().chain(free));
    Some(passed(states.into_iter().map(parts), |index| parts(evaluator.output(index)), layout))
}

fn parts(balls: &Balls<TAPE_LANES>) -> BallParts<'_> {
    [&balls.mid, &balls.rad]
}
