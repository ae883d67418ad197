//! Operations of an engine's program, with their costs.

use crate::number::UnaryFunction;

/// Cost of a product, with or without a sum. On processors with units of their own for sums these
/// cost less; a division takes as long as several products.
pub(super) const PRODUCT: u32 = 4;
/// Cost of a change of sign.
pub(super) const SIGN: u32 = 1;
const SUM: u32 = 3;
const SLOW: u32 = 20;

/// Emitted operation on earlier ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Operation {
    Input(usize),
    Product(u32, u32),
    /// A product with a constant.
    Scaled(u32, u64),
    /// A sum, or a difference.
    Sum(u32, u32, bool),
    /// A sum with a constant.
    Shifted(u32, u64),
    Function(UnaryFunction, u32),
    /// A power with the exponent at a place.
    Power(u32, usize),
    GeneralPower(u32, u32),
}

impl Operation {
    /// Returns the operations that are read.
    pub(super) fn arguments(self) -> [Option<u32>; 2] {
        match self {
            Operation::Input(_) => [None; 2],
            Operation::Product(a, b) | Operation::Sum(a, b, _) | Operation::GeneralPower(a, b) => {
                [Some(a), Some(b)]
            }
            Operation::Scaled(a, _)
            | Operation::Shifted(a, _)
            | Operation::Function(_, a)
            | Operation::Power(a, _) => [Some(a), None],
        }
    }
    /// Returns the cost, where `is_fused` tells whether an argument is a part of the sum that reads
    /// it.
    pub(super) fn cost(self, is_fused: impl Fn(u32) -> bool) -> u32 {
        match self {
            Operation::Input(_) => 0,
            Operation::Product(..) | Operation::Scaled(..) => PRODUCT,
            Operation::Sum(..) | Operation::Shifted(..) => {
                let is_free = self.arguments().into_iter().flatten().any(is_fused);
                if is_free { 0 } else { SUM }
            }
            Operation::Function(UnaryFunction::Neg | UnaryFunction::Abs, _) => SIGN,
            Operation::Function(..) | Operation::Power(..) | Operation::GeneralPower(..) => SLOW,
        }
    }
}
