//! Tapes over balls in machine code: midpoints and radii as steps of one program.
//!
//! The formulas are those of the domain [`Ball`](crate::number::ball::Ball), operation by operation
//! and in the same order, so that every midpoint and radius has the same bits; only terms that are
//! zero because a constant is exact are left out. Nothing is fused.

mod builder;
mod extents;
mod lower;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use super::machine::{MachineProgram, Memory};
use super::program::{StepProgram, Value};
use super::{ROW_STATES, RowBlock};
use crate::graph::{InstructionSet, Tape, widest};
use crate::number::rational::Rational;
use builder::{BallValue, Builder, TapeSteps};

/// Largest number of steps: longer code leaves the second-level cache, and an evaluator that reads
/// its instructions once for all lanes is faster.
const MOST_STEPS: usize = 1 << 14;

/// Knowledge of an input beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InputExtent {
    /// Least and greatest midpoint, infinite where none is known.
    pub ends: [f64; 2],
    /// Largest radius; 0 for an input that is exact, so that its radius is never read.
    pub radius: f64,
}

impl InputExtent {
    fn is_exact(&self) -> bool {
        self.radius == 0.0
    }
}

/// Two tapes over balls, the second on the results of the first, in machine code; clones share it.
#[derive(Clone, Debug)]
pub struct BallEngine(Arc<BallCode>);

#[derive(Debug)]
struct BallCode {
    machine: MachineProgram,
    /// Midpoints with lower bounds of radii, of some outputs of the second tape, where all numbers of
    /// both programs are known to be finite.
    lower: Option<MachineProgram>,
    /// Whether each input is exact.
    exact: Vec<bool>,
    /// Number of outputs of the first tape that are outputs of the code.
    computed: usize,
}

impl BallEngine {
    /// Prepares two tapes over inputs of which it is known where they lie. The inputs of the second
    /// tape are the outputs of the first, followed by `further` numbers; `tested` are those of its
    /// outputs for which [`BallRunner::run_lower`] computes lower bounds of radii. `None` where their
    /// numbers differ, where the processor or the system allows no machine code, or a tape has
    /// functions that are not processor instructions or is too long.
    pub fn new(
        inputs: &[InputExtent],
        first: &Tape,
        further: &[Rational],
        second: &Tape,
        tested: &[usize],
    ) -> Option<Self> {
        Self::with_vectors(inputs, first, further, (second, tested), widest())
    }

    pub(super) fn with_vectors(
        inputs: &[InputExtent],
        first: &Tape,
        further: &[Rational],
        (second, tested): (&Tape, &[usize]),
        vectors: InstructionSet,
    ) -> Option<Self> {
        let exact: Vec<bool> = inputs.iter().map(InputExtent::is_exact).collect();
        let (program, computed) = program(&exact, first, further, second)?;
        let machine = MachineProgram::new(&program, vectors)?;
        let parts = |input: &InputExtent| [input.ends, [0.0, input.radius]];
        let ends: Vec<[f64; 2]> = inputs.iter().flat_map(parts).collect();
        let lower = lower::program(first, further, second, tested).filter(|lower| {
            [&program, lower].iter().all(|program| extents::found(program, &ends).is_some())
        });
        let lower = lower.and_then(|lower| MachineProgram::new(&lower, vectors));
        Some(Self(Arc::new(BallCode { machine, lower, exact, computed })))
    }

    /// Number of outputs of the first tape that are computed, and not inputs or constants.
    pub fn computed(&self) -> usize {
        self.0.computed
    }

    /// Memory to run in, one for each thread.
    pub fn runner(&self) -> BallRunner {
        BallRunner {
            code: Arc::clone(&self.0),
            inputs: vec![[RowBlock([0.0; ROW_STATES]); 2]; self.0.exact.len()],
            memory: self.0.machine.memory(),
            lower: self.0.lower.as_ref().map(MachineProgram::memory),
        }
    }
}

/// Memory in which a [`BallEngine`] runs.
#[derive(Debug)]
pub struct BallRunner {
    code: Arc<BallCode>,
    inputs: Vec<[RowBlock; 2]>,
    memory: Memory,
    lower: Option<Memory>,
}

impl BallRunner {
    /// Midpoints and radii of the inputs that were not said to be exact.
    pub fn inexact(&self) -> impl Iterator<Item = &[RowBlock; 2]> {
        let inputs = self.inputs.iter().zip(&self.code.exact);
        inputs.filter(|(_, is_exact)| !**is_exact).map(|(input, _)| input)
    }

    /// Midpoints and radii of the inputs, to be filled.
    pub fn inputs_mut(&mut self) -> &mut [[RowBlock; 2]] {
        &mut self.inputs
    }

    /// Whether all inputs that were said to be exact are.
    pub fn is_exact(&self) -> bool {
        let exact = self.inputs.iter().zip(&self.code.exact).filter(|(_, is_exact)| **is_exact);
        // Without the sign no bit of 0 is set; sums of floats would wait for one another.
        let bits = |rad: &RowBlock| rad.0.iter().fold(0, |bits, one| bits | one.to_bits() << 1);
        exact.into_iter().all(|([_, rad], _)| bits(rad) == 0)
    }

    /// Computes the outputs. Inputs that were said to be exact must be.
    pub fn run(&mut self) {
        debug_assert!(self.is_exact(), "no radius is left out");
        self.code.machine.run(self.inputs.as_flattened(), &mut self.memory);
    }

    /// Computes midpoints with lower bounds of radii, far quicker than [`BallRunner::run`], where all
    /// balls are known to be finite for inputs within their extents; returns whether they are. Inputs
    /// that were said to be exact must be.
    pub fn run_lower(&mut self) -> bool {
        debug_assert!(self.is_exact(), "no radius is left out");
        let (Some(lower), Some(memory)) = (&self.code.lower, &mut self.lower) else { return false };
        lower.run(self.inputs.as_flattened(), memory);
        true
    }

    /// Midpoint of a tested output, the same as in [`BallRunner::output`] but for the sign of 0, and a number that
    /// the radius there is at least, in units of the roundoff 2⁻⁵³; `None` if it was not computed.
    pub fn lower(&self, index: usize) -> Option<[&RowBlock; 2]> {
        let memory = self.lower.as_ref()?;
        Some([memory.output(2 * index), memory.output(2 * index + 1)])
    }

    /// Midpoints and radii of an output: those that the first tape computes, and then those of the
    /// second.
    pub fn output(&self, index: usize) -> [&RowBlock; 2] {
        [self.memory.output(2 * index), self.memory.output(2 * index + 1)]
    }
}

/// Makes the program of two tapes, with the number of outputs of the first that are computed; `None`
/// for functions that are not instructions.
fn program(
    exact: &[bool],
    first: &Tape,
    further: &[Rational],
    second: &Tape,
) -> Option<(StepProgram, usize)> {
    let mut builder = Builder::default();
    let draws = (0..).zip(exact).map(|(input, is_exact)| BallValue {
        mid: Value::Input(2 * input),
        rad: (!is_exact).then_some(Value::Input(2 * input + 1)),
    });
    let made = builder.tape(first, draws.collect())?;
    let further: Vec<BallValue> = further.iter().map(|value| builder.enclosed(value)).collect();
    let results = builder.tape(second, [&made[..], &further].concat())?;
    let is_computed = |ball: &&BallValue| matches!(ball.mid, Value::Step(_));
    let computed: Vec<BallValue> = made.iter().filter(is_computed).copied().collect();
    let outputs = [&computed[..], &results].concat();
    let zero = builder.constant(0.0);
    let parts = |ball: &BallValue| [ball.mid, ball.rad.unwrap_or(zero)];
    let outputs = outputs.iter().flat_map(parts).collect();
    let Builder { steps, constants, .. } = builder;
    let program = StepProgram { inputs: 2 * first.inputs(), constants, steps, outputs };
    (program.steps.len() <= MOST_STEPS).then_some((program, computed.len()))
}
