//! Operations on one operand, and the bracketed pair `(a,b)`.

use super::arena::{Function, Operation};
use super::error::{FormulaError, Span};
use super::typing::{Builder, Built, Operand};
use super::value::Type;

impl Builder<'_> {
    /// `(a,b)`.
    pub fn dot(&mut self, a: &Operand, b: &Operand, span: Span) -> Built {
        for factor in [a, b] {
            if factor.value_type != Type::Vector {
                let message =
                    format!("a dot product takes two vectors, this is a {}", factor.value_type);
                return Err(FormulaError::new(factor.span.clone(), message));
            }
        }
        Ok(self.push(Operation::Dot(a.node, b.node), Type::Scalar, span))
    }

    /// `-a`.
    pub fn negate(&mut self, a: &Operand, span: Span) -> Operand {
        let operation = Operation::Negate(a.node);
        let node = if a.value_type == Type::Scalar {
            self.arena.push_folded(operation, &[a.node], span.clone(), |n| Some(-n[0]))
        } else {
            self.arena.push(operation, a.value_type, span.clone())
        };
        self.operand(node, span)
    }

    /// `√a`.
    pub fn root(&mut self, a: &Operand, span: Span) -> Built {
        if a.value_type == Type::Scalar {
            return Ok(self.push(Operation::Function(Function::Sqrt, a.node), Type::Scalar, span));
        }
        let message = format!("a {} has no square root", a.value_type);
        Err(FormulaError::new(a.span.clone(), message))
    }

    /// `|a|`.
    pub fn modulus(&mut self, a: &Operand, span: Span) -> Built {
        Ok(match a.value_type {
            Type::Scalar => {
                self.push(Operation::Function(Function::Modulus, a.node), Type::Scalar, span)
            }
            Type::Vector => {
                let square = self.push(Operation::Dot(a.node, a.node), Type::Scalar, span.clone());
                self.root(&square, span)?
            }
            Type::Matrix => {
                let error = FormulaError::new(span, "bars do not stand around a matrix");
                return Err(error.with_help(format!("write `det({})`", self.written(a))));
            }
        })
    }

    /// `aᵀ`.
    pub fn transpose(&mut self, a: &Operand, span: Span) -> Built {
        if a.value_type == Type::Matrix {
            return Ok(self.push(Operation::Transpose(a.node), Type::Matrix, span));
        }
        let message = format!("only a matrix is transposed, this is a {}", a.value_type);
        let error = FormulaError::new(a.span.clone(), message);
        Err(if a.value_type == Type::Vector {
            error.with_help("write `(a,b)` for aᵀb and `a ⊗ b` for abᵀ")
        } else {
            error
        })
    }

    /// `a[i]` or `a[i,j]`, counted from 0.
    pub fn index(&mut self, a: &Operand, indices: &[usize], brackets: Span) -> Built {
        let span = a.span.start..brackets.end;
        match (a.value_type, indices) {
            (Type::Vector, [i]) => {
                Ok(self.push(Operation::Component(a.node, *i), Type::Scalar, span))
            }
            (Type::Matrix, [i, j]) => {
                Ok(self.push(Operation::Entry(a.node, *i, *j), Type::Scalar, span))
            }
            (Type::Vector, _) => {
                let error = FormulaError::new(brackets, "a vector has one index");
                Err(error.with_help(format!("write `{}[1]`", self.written(a))))
            }
            (Type::Matrix, _) => {
                let error = FormulaError::new(brackets, "a matrix has two indices");
                Err(error.with_help(format!("write `{}[1,2]`", self.written(a))))
            }
            (Type::Scalar, _) => Err(FormulaError::new(brackets, "a scalar has no components")),
        }
    }
}
