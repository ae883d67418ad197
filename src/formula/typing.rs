//! Operators meet their operands: which types go together, and what to write when they do not.

use super::arena::{Arena, NodeId, Operation};
use super::error::{FormulaError, Span, excerpt};
use super::value::Type;
use crate::number::rational::Rational;

/// A piece of the formula that has been read: its node, its type and its text.
#[derive(Clone, Debug)]
pub(super) struct Operand {
    pub node: NodeId,
    pub value_type: Type,
    pub span: Span,
}

/// An operator between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Infix {
    Add,
    Subtract,
    Cross,
    Outer,
    Multiply,
    Divide,
}

/// Builds typed nodes; holds the text for messages.
pub(super) struct Builder<'t> {
    pub arena: Arena,
    pub text: &'t str,
}

/// A piece that has been built, or why it cannot be.
pub(super) type Built = Result<Operand, FormulaError>;

impl Builder<'_> {
    /// The operand standing for a node, with the text it covers.
    pub fn operand(&self, node: NodeId, span: Span) -> Operand {
        Operand { node, value_type: self.arena.nodes[node].value_type, span }
    }

    /// Appends an operation.
    pub fn push(&mut self, operation: Operation, value_type: Type, span: Span) -> Operand {
        let node = self.arena.push(operation, value_type, span.clone());
        Operand { node, value_type, span }
    }

    /// Appends a scalar operation, or the number it gives if it acts on numbers.
    pub fn push_folded(
        &mut self,
        operation: Operation,
        operands: &[NodeId],
        span: Span,
        fold: impl FnOnce(&[&Rational]) -> Option<Rational>,
    ) -> Operand {
        let node = self.arena.push_folded(operation, operands, span.clone(), fold);
        self.operand(node, span)
    }

    /// The text of a piece, for help.
    pub fn written(&self, operand: &Operand) -> String {
        excerpt(&self.text[operand.span.clone()])
    }

    /// `a operator b`.
    pub fn infix(&mut self, infix: Infix, a: &Operand, b: &Operand) -> Built {
        let span = a.span.start..b.span.end;
        match infix {
            Infix::Add | Infix::Subtract => self.sum(infix, a, b, span),
            Infix::Multiply => self.product(a, b, span),
            Infix::Divide => self.quotient(a, b, span),
            Infix::Cross | Infix::Outer => self.vector_product(infix, a, b, span),
        }
    }

    fn sum(&mut self, infix: Infix, a: &Operand, b: &Operand, span: Span) -> Built {
        let (left, right, add) = (a.value_type, b.value_type, infix == Infix::Add);
        if left != right {
            let message = if add {
                format!("a {left} cannot be added to a {right}")
            } else {
                format!("a {right} cannot be subtracted from a {left}")
            };
            let error = FormulaError::new(span, message);
            let scalar = match (left, right) {
                (Type::Scalar, Type::Matrix) => a,
                (Type::Matrix, Type::Scalar) => b,
                _ => return Err(error),
            };
            return Err(error.with_help(format!("write `{}*E`", self.written(scalar))));
        }
        let operation =
            if add { Operation::Add(a.node, b.node) } else { Operation::Subtract(a.node, b.node) };
        if left != Type::Scalar {
            return Ok(self.push(operation, left, span));
        }
        let fold = |n: &[&Rational]| Some(if add { n[0] + n[1] } else { n[0] - n[1] });
        Ok(self.push_folded(operation, &[a.node, b.node], span, fold))
    }

    fn product(&mut self, a: &Operand, b: &Operand, span: Span) -> Built {
        use Type::{Matrix, Scalar, Vector};
        let (x, y) = (a.node, b.node);
        Ok(match (a.value_type, b.value_type) {
            (Scalar, Scalar) => {
                let operation = Operation::Multiply(x, y);
                let fold = |n: &[&Rational]| Some(n[0] * n[1]);
                self.push_folded(operation, &[x, y], span, fold)
            }
            (Scalar, other) => self.push(Operation::Scale(x, y), other, span),
            (other, Scalar) => self.push(Operation::Scale(y, x), other, span),
            (Matrix, Vector) => self.push(Operation::Apply(x, y), Vector, span),
            (Matrix, Matrix) => self.push(Operation::Compose(x, y), Matrix, span),
            (Vector, Vector) => {
                let (a, b) = (self.written(a), self.written(b));
                let error = FormulaError::new(span, "`*` does not multiply two vectors");
                return Err(error.with_help(format!("write `({a},{b})` or `{a} × {b}`")));
            }
            (Vector, Matrix) => {
                let (a, b) = (self.written(a), self.written(b));
                let error = FormulaError::new(span, "a vector cannot stand left of a matrix");
                return Err(error.with_help(format!("write `{b}ᵀ*{a}`")));
            }
        })
    }

    fn quotient(&mut self, a: &Operand, b: &Operand, span: Span) -> Built {
        match b.value_type {
            Type::Scalar => {}
            Type::Vector => {
                let error = FormulaError::new(b.span.clone(), "nothing can be divided by a vector");
                return Err(error.with_help("divide by a scalar such as its norm"));
            }
            Type::Matrix => {
                let (a, b_text) = (self.written(a), self.written(b));
                let help = format!("write `solve({b_text}, {a})` or `inverse({b_text})`");
                let error = FormulaError::new(b.span.clone(), "nothing can be divided by a matrix");
                return Err(error.with_help(help));
            }
        }
        if self.arena.constant(b.node).is_some_and(Rational::is_zero) {
            return Err(FormulaError::new(b.span.clone(), "this divides by zero"));
        }
        let operation = Operation::Divide(a.node, b.node);
        if a.value_type != Type::Scalar {
            return Ok(self.push(operation, a.value_type, span));
        }
        let fold = |n: &[&Rational]| n[1].recip().map(|inverse| n[0] * &inverse);
        Ok(self.push_folded(operation, &[a.node, b.node], span, fold))
    }

    fn vector_product(&mut self, infix: Infix, a: &Operand, b: &Operand, span: Span) -> Built {
        let (sign, operation, value_type) = match infix {
            Infix::Cross => ("×", Operation::Cross(a.node, b.node), Type::Vector),
            _ => ("⊗", Operation::Outer(a.node, b.node), Type::Matrix),
        };
        if (a.value_type, b.value_type) == (Type::Vector, Type::Vector) {
            return Ok(self.push(operation, value_type, span));
        }
        let message = format!(
            "`{sign}` stands between two vectors, not a {} and a {}",
            a.value_type, b.value_type
        );
        let help = format!("write `{}*{}`", self.written(a), self.written(b));
        let error = FormulaError::new(span, message);
        Err(if a.value_type == Type::Vector && b.value_type == Type::Matrix {
            error
        } else {
            error.with_help(help)
        })
    }
}
