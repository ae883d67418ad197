//! Construction of programs over balls.

use rustc_hash::FxHashMap;

use super::super::program::{PairOperation, ProgramStep, Value};
use crate::graph::{Instruction, Tape};
use crate::number::ball::{TINY, UNIT, WIDER, about};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

/// The largest number whose reciprocal overflows, 2⁻¹⁰²⁴.
const OVERFLOWING: f64 = f64::MIN_POSITIVE / 4.0;

/// A ball under construction; the radius of an exact constant is 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct BallValue {
    pub(super) mid: Value,
    pub(super) rad: Option<Value>,
}

/// Numbers from which the steps of a tape make others of their kind.
pub(super) trait TapeSteps {
    /// A number under construction.
    type Number: Copy;

    /// Makes a number that encloses a constant.
    fn enclosed(&mut self, value: &Rational) -> Self::Number;

    /// Adds a function of a number; `None` if there is no such step.
    fn unary(&mut self, function: UnaryFunction, x: Self::Number) -> Option<Self::Number>;

    /// Adds an operation; `None` if there is no such step.
    fn binary(
        &mut self,
        operation: BinaryOperation,
        x: Self::Number,
        y: Self::Number,
    ) -> Option<Self::Number>;

    /// Adds the steps of a tape with these inputs; returns its outputs.
    fn tape(&mut self, tape: &Tape, inputs: Vec<Self::Number>) -> Option<Vec<Self::Number>> {
        let mut held = inputs;
        if held.len() != tape.inputs() {
            return None;
        }
        held.extend(tape.constants().iter().map(|value| self.enclosed(value)));
        for instruction in tape.instructions() {
            let (value, out) = match *instruction {
                Instruction::Unary { function, a, out } => {
                    (self.unary(function, held[a as usize])?, out)
                }
                Instruction::Binary { operation, a, b, out } => {
                    (self.binary(operation, held[a as usize], held[b as usize])?, out)
                }
                Instruction::Power { .. } => return None,
            };
            match held.get_mut(out as usize) {
                Some(place) => *place = value,
                None => held.push(value),
            }
        }
        Some(tape.output_slots().iter().map(|slot| held[*slot as usize]).collect())
    }
}

/// A program under construction; equal steps are one.
#[derive(Default)]
pub(super) struct Builder {
    pub(super) steps: Vec<ProgramStep>,
    known: FxHashMap<ProgramStep, u32>,
    pub(super) constants: Vec<f64>,
    /// Places of constants by their bits.
    places: FxHashMap<u64, u32>,
}

impl TapeSteps for Builder {
    type Number = BallValue;

    fn enclosed(&mut self, value: &Rational) -> BallValue {
        let (mid, rad) = about(value.to_f64());
        let rad = (rad != 0.0).then(|| self.constant(rad));
        BallValue { mid: self.constant(mid), rad }
    }

    fn unary(&mut self, function: UnaryFunction, x: BallValue) -> Option<BallValue> {
        let of = |builder: &mut Self| builder.step(ProgramStep::Unary(function, x.mid));
        match function {
            UnaryFunction::Neg | UnaryFunction::Abs => Some(BallValue { mid: of(self), ..x }),
            UnaryFunction::Recip => {
                let (mid, size) = (of(self), self.size(x.mid));
                let Some(rad) = x.rad else {
                    let rounded = self.rounded(None, mid);
                    // The spread |z| 0/|a| is 0, but it has no value where z is infinite.
                    let least = self.constant(OVERFLOWING);
                    let beyond = self.pair(PairOperation::NotGreater, size, least);
                    return Some(BallValue {
                        mid,
                        rad: Some(self.pair(PairOperation::Or, rounded, beyond)),
                    });
                };
                let room = self.sum(BinaryOperation::Sub, size, rad);
                let (quotient, far) =
                    (self.pair(PairOperation::Quotient, rad, room), self.size(mid));
                let spread = self.product(far, quotient);
                let rounded = self.rounded(Some(spread), mid);
                let zero = self.constant(0.0);
                let beyond = self.pair(PairOperation::NotGreater, room, zero);
                Some(BallValue { mid, rad: Some(self.pair(PairOperation::Or, rounded, beyond)) })
            }
            UnaryFunction::Sqrt => {
                let (mid, zero) = (of(self), self.constant(0.0));
                let Some(rad) = x.rad else {
                    let error = self.unit_times(mid);
                    let widened = self.widened(error);
                    let below = self.pair(PairOperation::NotAtLeast, x.mid, zero);
                    return Some(BallValue {
                        mid,
                        rad: Some(self.pair(PairOperation::Or, widened, below)),
                    });
                };
                let quotient = self.pair(PairOperation::Quotient, rad, mid);
                let is_wide = self.pair(PairOperation::Greater, rad, zero);
                let spread = self.pair(PairOperation::And, quotient, is_wide);
                let error = self.unit_times(mid);
                let sum = self.sum(BinaryOperation::Add, spread, error);
                let widened = self.widened(sum);
                let below = self.pair(PairOperation::NotAtLeast, x.mid, rad);
                Some(BallValue { mid, rad: Some(self.pair(PairOperation::Or, widened, below)) })
            }
            UnaryFunction::Exp
            | UnaryFunction::Ln
            | UnaryFunction::Sin
            | UnaryFunction::Cos
            | UnaryFunction::Atan => None,
        }
    }

    fn binary(
        &mut self,
        operation: BinaryOperation,
        x: BallValue,
        y: BallValue,
    ) -> Option<BallValue> {
        let mid = match operation {
            BinaryOperation::Pow => return None,
            _ => self.step(ProgramStep::Binary(operation, x.mid, y.mid)),
        };
        let terms = match operation {
            BinaryOperation::Mul => {
                let (size_x, size_y) = (self.size(x.mid), self.size(y.mid));
                let of_y = y.rad.map(|rad| self.product(size_x, rad));
                let of_x = x.rad.map(|rad| self.product(size_y, rad));
                let both = x.rad.zip(y.rad).map(|(a, b)| self.product(a, b));
                [of_y, of_x, both]
            }
            _ => [x.rad, y.rad, None],
        };
        let spread = terms
            .into_iter()
            .flatten()
            .reduce(|sum, term| self.sum(BinaryOperation::Add, sum, term));
        Some(BallValue { mid, rad: Some(self.rounded(spread, mid)) })
    }
}

impl Builder {
    /// Widens `spread + UNIT |z|`.
    fn rounded(&mut self, spread: Option<Value>, z: Value) -> Value {
        let size = self.size(z);
        let error = self.unit_times(size);
        let sum = spread.map_or(error, |spread| self.sum(BinaryOperation::Add, spread, error));
        self.widened(sum)
    }

    fn widened(&mut self, radius: Value) -> Value {
        let (factor, tiny) = (self.constant(WIDER), self.constant(TINY));
        let product = self.product(radius, factor);
        self.sum(BinaryOperation::Add, product, tiny)
    }

    fn unit_times(&mut self, x: Value) -> Value {
        let unit = self.constant(UNIT);
        self.product(unit, x)
    }

    pub(super) fn size(&mut self, x: Value) -> Value {
        self.step(ProgramStep::Unary(UnaryFunction::Abs, x))
    }

    pub(super) fn product(&mut self, x: Value, y: Value) -> Value {
        self.step(ProgramStep::Binary(BinaryOperation::Mul, x, y))
    }

    pub(super) fn sum(&mut self, operation: BinaryOperation, x: Value, y: Value) -> Value {
        self.step(ProgramStep::Binary(operation, x, y))
    }

    fn pair(&mut self, operation: PairOperation, x: Value, y: Value) -> Value {
        self.step(ProgramStep::Pair(operation, x, y))
    }

    pub(super) fn constant(&mut self, value: f64) -> Value {
        let place = *self.places.entry(value.to_bits()).or_insert_with(|| {
            self.constants.push(value);
            self.constants.len() as u32 - 1
        });
        Value::Constant(place)
    }

    pub(super) fn step(&mut self, step: ProgramStep) -> Value {
        let place = *self.known.entry(step).or_insert_with(|| {
            self.steps.push(step);
            self.steps.len() as u32 - 1
        });
        Value::Step(place)
    }
}
