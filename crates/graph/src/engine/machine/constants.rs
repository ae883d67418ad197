//! Constants of machine code, and those that have a register of their own.

use super::super::program::{ProgramStep, StepProgram, Value};
use crate::assembler::Width;
use crate::number::UnaryFunction;
use crate::order::StableOrder;

/// Constants that instructions need in addition to those of the program.
const EXTRA: [f64; 3] = [1.0, -0.0, f64::from_bits(!(1 << 63))];
/// Number of registers of AVX-512 that constants may have; AVX2 has none to spare.
const MOST_KEPT: usize = 4;
/// A constant has a register where one step of so many reads it.
const ONE_IN: usize = 20;

/// Constants by number: those of the program, then those of instructions.
#[derive(Debug)]
pub(super) struct Constants {
    pub(super) values: Vec<f64>,
    own: u32,
    /// Numbers of the constants with a register.
    pub(super) kept: Vec<u32>,
}

impl Constants {
    /// Lists the constants of a program.
    pub(super) fn new(program: &StepProgram, width: Width) -> Self {
        let own = program.constants.len() as u32;
        let mut constants =
            Self { values: [&program.constants[..], &EXTRA].concat(), own, kept: Vec::new() };
        if width != Width::Eight {
            return constants;
        }
        let mut reads = vec![0; constants.values.len()];
        for step in &program.steps {
            let extra = match *step {
                ProgramStep::Unary(function, _) => constants.of(function),
                _ => None,
            };
            for argument in step.arguments().chain(extra) {
                if let Value::Constant(constant) = argument {
                    reads[constant as usize] += 1;
                }
            }
        }
        let mut often: Vec<u32> = (0..reads.len() as u32)
            .filter(|constant| {
                reads[*constant as usize] * ONE_IN >= program.steps.len().max(ONE_IN)
            })
            .collect();
        often.order_by_key(|constant| std::cmp::Reverse(reads[*constant as usize]));
        often.truncate(MOST_KEPT);
        constants.kept = often;
        constants
    }

    /// Returns the constant that the instruction for a function needs: 1 over it, a sign to change,
    /// all but the sign to keep.
    pub(super) fn of(&self, function: UnaryFunction) -> Option<Value> {
        let number = match function {
            UnaryFunction::Recip => 0,
            UnaryFunction::Neg => 1,
            UnaryFunction::Abs => 2,
            _ => return None,
        };
        Some(Value::Constant(self.own + number))
    }
}
