//! Several vectors of a row in one straight line, each some way behind the one before it.
//!
//! A residual begins with a chain of operations that wait for each other (a root, a division), and
//! ends with another; a processor looks ahead by fewer operations than one residual has. While one
//! vector is at its end, the next is at its beginning.

use super::super::program::{ProgramStep, StepProgram, Value};

/// Number of steps in one straight line: the code stays in a first-level cache of 32 KB.
const MOST_STEPS: usize = 4096;

/// A program for several vectors of a row.
#[derive(Debug)]
pub(super) struct Interleaved {
    /// Number of vectors.
    pub(super) copies: usize,
    /// Steps with the vector of each; steps and their arguments are numbered over all vectors.
    pub(super) steps: Vec<(usize, ProgramStep)>,
    /// Outputs of each vector.
    pub(super) outputs: Vec<Vec<Value>>,
}

impl Interleaved {
    /// Interleaves as many of `vectors` as fit, each half a program behind the one before it.
    pub(super) fn new(program: &StepProgram, vectors: usize) -> Self {
        let count = program.steps.len();
        let fits = |copies: &usize| vectors.is_multiple_of(*copies) && copies * count <= MOST_STEPS;
        let copies = (1..=vectors).rev().find(fits).unwrap_or(1);
        let mut order: Vec<(usize, usize, usize)> = (0..copies)
            .flat_map(|copy| {
                (0..count).map(move |step| (copy * count.div_ceil(2) + step, copy, step))
            })
            .collect();
        order.sort_unstable();
        let mut place = vec![vec![0; count]; copies];
        for (index, (_, copy, step)) in order.iter().enumerate() {
            place[*copy][*step] = index as u32;
        }
        let renamed = |copy: usize, value: Value| match value {
            Value::Step(step) => Value::Step(place[copy][step as usize]),
            other => other,
        };
        let steps = order.iter().map(|(_, copy, step)| {
            (*copy, program.steps[*step].with_arguments(|value| renamed(*copy, value)))
        });
        let outputs = (0..copies)
            .map(|copy| program.outputs.iter().map(|output| renamed(copy, *output)).collect());
        Self { copies, steps: steps.collect(), outputs: outputs.collect() }
    }

    /// Steps that read each result, in order; a step that reads it twice occurs twice.
    pub(super) fn reads(&self) -> Vec<Vec<u32>> {
        let mut reads = vec![Vec::new(); self.steps.len()];
        for (index, (_, step)) in self.steps.iter().enumerate() {
            for argument in step.arguments() {
                if let Value::Step(step) = argument {
                    reads[step as usize].push(index as u32);
                }
            }
        }
        reads
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Tape, record};

    #[test]
    fn vectors_follow_each_other_half_a_program_behind() {
        let (graph, value) =
            record(1, |x| (x[0] * x[0] + x[0]) * (x[0] * x[0] - x[0])).expect("records");
        let program = StepProgram::new(&Tape::new(&graph, &[value]));
        let count = program.steps.len();
        let found = Interleaved::new(&program, 8);
        assert_eq!((found.copies, found.steps.len()), (8, 8 * count), "all of a row");
        for copy in 0..8 {
            let own: Vec<usize> =
                (0..8 * count).filter(|index| found.steps[*index].0 == copy).collect();
            assert_eq!(own.len(), count, "each vector has all steps");
            assert_eq!(found.outputs[copy], [Value::Step(own[count - 1] as u32)], "in their order");
        }
        assert!(found.reads().iter().enumerate().all(|(place, reads)| {
            reads.iter().all(|read| {
                *read as usize > place && found.steps[*read as usize].0 == found.steps[place].0
            })
        }));
    }

    #[test]
    fn long_programs_are_not_interleaved() {
        let (graph, value) =
            record(1, |x| (0..5000).fold(x[0], |sum, _| sum * sum + x[0])).expect("records");
        let program = StepProgram::new(&Tape::new(&graph, &[value]));
        assert_eq!(Interleaved::new(&program, 8).copies, 1, "{} steps", program.steps.len());
    }
}
