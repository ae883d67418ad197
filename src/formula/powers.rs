//! Powers: exponents admitted for scalars, vectors and matrices.

use super::arena::{Constant, ElementaryFunction, MAX_CONSTANT_BITS, NodeId, NodeOperation};
use super::error::{FormulaError, Span};
use super::kind::Type;
use super::typing::{Builder, Built, Operand};
use crate::number::rational::Rational;

/// Highest power of a matrix.
const MAX_MATRIX_POWER: i64 = 100;

impl Builder<'_> {
    /// Builds `base^exponent`.
    pub fn power(&mut self, base: &Operand, exponent: &Operand) -> Built {
        let span = base.span.start..exponent.span.end;
        if exponent.value_type != Type::Scalar {
            let message = format!("an exponent is a scalar, this is a {}", exponent.value_type);
            let error = FormulaError::new(exponent.span.clone(), message);
            return Err(error.with_help("write a component, `a[1]`, or the norm, `|a|`"));
        }
        match self.arena.take_constant(exponent.node) {
            Some(value) => self.constant_power(base, &value, exponent.span.clone(), span),
            None if self.is_euler(base) => Ok(self.exponential(exponent.node, span)),
            None if base.value_type == Type::Scalar => {
                Ok(self.push(NodeOperation::PowerOf(base.node, exponent.node), Type::Scalar, span))
            }
            None => {
                let message = format!("a {} is raised to whole numbers only", base.value_type);
                Err(FormulaError::new(exponent.span.clone(), message))
            }
        }
    }

    /// Builds `base^value` for a number written at `exponent`.
    pub fn constant_power(
        &mut self,
        base: &Operand,
        value: &Rational,
        exponent: Span,
        span: Span,
    ) -> Built {
        if self.is_euler(base) {
            let number = NodeOperation::Number(value.clone());
            let exponent = self.push(number, Type::Scalar, exponent);
            return Ok(self.exponential(exponent.node, span));
        }
        let whole = value.to_integer();
        match (base.value_type, whole) {
            (Type::Scalar, _) => self.scalar_power(base, value, span),
            (Type::Vector(_), Some(2)) => {
                Ok(self.push(NodeOperation::Dot(base.node, base.node), Type::Scalar, span))
            }
            (Type::Vector(_), _) => {
                let error = FormulaError::new(exponent, "a vector has no power except its square");
                Err(error
                    .with_help(format!("write a power of the norm, `|{}|`", self.written(base))))
            }
            (Type::Matrix(rows, columns), _) if rows != columns => {
                let message = format!("a {} has no powers", base.value_type.in_full());
                Err(FormulaError::new(base.span.clone(), message))
            }
            (Type::Matrix(..), Some(-1)) => self.inverse(base, span),
            (Type::Matrix(..), Some(n @ 1..=MAX_MATRIX_POWER)) => {
                let operation = NodeOperation::MatrixPower(base.node, n.unsigned_abs() as u32);
                Ok(self.push(operation, base.value_type, span))
            }
            (Type::Matrix(..), _) => {
                let message = format!("a matrix has the powers -1 and 1 to {MAX_MATRIX_POWER}");
                Err(FormulaError::new(exponent, message))
            }
        }
    }

    fn is_euler(&self, base: &Operand) -> bool {
        self.arena.nodes[base.node].operation == NodeOperation::Constant(Constant::Euler)
    }

    /// Builds e^x as exp(x), for any x.
    fn exponential(&mut self, exponent: NodeId, span: Span) -> Operand {
        self.push(NodeOperation::Function(ElementaryFunction::Exp, exponent), Type::Scalar, span)
    }

    fn scalar_power(&mut self, base: &Operand, value: &Rational, span: Span) -> Built {
        let zero = self.arena.constant(base.node).is_some_and(Rational::is_zero);
        if zero && value.is_negative() {
            let error = FormulaError::new(span, "this divides by zero");
            return Err(error.with_help("write a divisor that is not 0"));
        }
        let fold = |n: &[&Rational]| {
            let exponent = i32::try_from(value.to_integer()?).ok()?;
            // the size is checked before the power is taken
            let bits = n[0].bits().checked_mul(u64::from(exponent.unsigned_abs()))?;
            (bits <= MAX_CONSTANT_BITS).then(|| n[0].powi(exponent)).flatten()
        };
        let operation = NodeOperation::Power(base.node, value.clone());
        Ok(self.push_folded(operation, &[base.node], span, fold))
    }
}
