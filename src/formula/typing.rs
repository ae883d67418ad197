//! Types of operators and operands: admitted combinations, and errors for the others.

use super::arena::{Arena, NodeId, NodeOperation};
use super::error::{FormulaError, Span, excerpt};
use super::kind::{MAX_COMPONENTS, Type};
use super::scope::{Scope, Symbol, name_of};
use crate::number::rational::Rational;

/// A parsed piece of the formula: its node, its type and its text.
#[derive(Clone, Debug)]
pub(super) struct Operand {
    pub node: NodeId,
    pub value_type: Type,
    pub span: Span,
}

/// Operator between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Infix {
    Add,
    Subtract,
    Cross,
    Outer,
    Multiply,
    Divide,
}

/// Builder of typed nodes; holds the text for messages.
pub(super) struct Builder<'t> {
    pub arena: Arena,
    pub text: &'t str,
}

/// A piece that has been built, or the error.
pub(super) type Built = Result<Operand, FormulaError>;

impl Builder<'_> {
    /// Operand for a node, with the text it covers.
    pub fn operand(&self, node: NodeId, span: Span) -> Operand {
        Operand { node, value_type: self.arena.nodes[node].value_type, span }
    }

    /// Appends an operation.
    pub fn push(&mut self, operation: NodeOperation, value_type: Type, span: Span) -> Operand {
        let node = self.arena.push(operation, value_type, span.clone());
        Operand { node, value_type, span }
    }

    /// Appends the use of a symbol of the scope, written at the span by its name or a component's.
    pub fn symbol(
        &mut self,
        symbol: Symbol,
        value_type: Type,
        span: Span,
        scope: &dyn Scope,
    ) -> Operand {
        let name = || name_of(&self.text[span.clone()], symbol, scope);
        let node = self.arena.push_symbol(symbol, value_type, span.clone(), name);
        Operand { node, value_type, span }
    }

    /// Appends an operation, or returns an error if its value is too large.
    pub fn push_sized(&mut self, operation: NodeOperation, value_type: Type, span: Span) -> Built {
        let allowed = |n: usize| n <= MAX_COMPONENTS;
        let fits = match value_type {
            Type::Matrix(rows, columns) => allowed(rows) && allowed(columns),
            _ => true,
        };
        if fits && allowed(value_type.size()) {
            return Ok(self.push(operation, value_type, span));
        }
        let message = format!("a {} is too large", value_type.in_full());
        let help = format!("vectors and matrices have at most {MAX_COMPONENTS} components");
        Err(FormulaError::new(span, message).with_help(help))
    }

    /// Appends a scalar operation, or its value if the operands are numbers.
    pub fn push_folded(
        &mut self,
        operation: NodeOperation,
        operands: &[NodeId],
        span: Span,
        fold: impl FnOnce(&[&Rational]) -> Option<Rational>,
    ) -> Operand {
        let node = self.arena.push_folded(operation, operands, span.clone(), fold);
        self.operand(node, span)
    }

    /// Text of a piece, for help.
    pub fn written(&self, operand: &Operand) -> String {
        excerpt(&self.text[operand.span.clone()])
    }

    /// Whether this is an empty sum, which can be added to any type.
    pub fn is_empty_sum(&self, operand: &Operand) -> bool {
        operand.value_type == Type::Scalar
            && self.arena.nodes[operand.node].operation == NodeOperation::Zero
    }

    /// Gives empty sums among some values the type of the others.
    pub fn fill_empty(&mut self, values: &mut [Operand]) {
        let mut kinds = values.iter().map(|value| value.value_type);
        let Some(kind) = kinds.find(|kind| *kind != Type::Scalar) else { return };
        for value in values {
            if self.is_empty_sum(value) {
                *value = self.push(NodeOperation::Zero, kind, value.span.clone());
            }
        }
    }

    /// Builds `a operator b`.
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
        if left != right && self.is_empty_sum(b) {
            // the value of a formula is its last node
            return Ok(self.push(NodeOperation::Sum([a.node].into()), left, span));
        }
        if left != right && self.is_empty_sum(a) {
            let negative = if add { b.clone() } else { self.negate(b, span.clone()) };
            return Ok(Operand { span, ..negative });
        }
        if left != right {
            let told = |kind: Type| match left.differs_in_size(right) {
                true => kind.in_full(),
                false => kind.to_string(),
            };
            let message = if add {
                format!("a {} cannot be added to a {}", told(left), told(right))
            } else {
                format!("a {} cannot be subtracted from a {}", told(right), told(left))
            };
            let error = FormulaError::new(span, message);
            let (scalar, rows) = match (left, right) {
                (Type::Scalar, Type::Matrix(n, m)) if n == m => (a, n),
                (Type::Matrix(n, m), Type::Scalar) if n == m => (b, n),
                _ => return Err(error.with_help(one_kind(left, right))),
            };
            let unit = if rows == 3 { "E".to_string() } else { format!("E({rows})") };
            return Err(error.with_help(format!("write `{}*{unit}`", self.written(scalar))));
        }
        let operation = if add {
            NodeOperation::Add(a.node, b.node)
        } else {
            NodeOperation::Subtract(a.node, b.node)
        };
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
                let operation = NodeOperation::Multiply(x, y);
                let fold = |n: &[&Rational]| Some(n[0] * n[1]);
                self.push_folded(operation, &[x, y], span, fold)
            }
            (Scalar, other) => self.push(NodeOperation::Scale(x, y), other, span),
            (other, Scalar) => self.push(NodeOperation::Scale(y, x), other, span),
            (Matrix(rows, columns), Vector(length)) if columns == length => {
                self.push(NodeOperation::Apply(x, y), Vector(rows), span)
            }
            (Matrix(rows, inner), Matrix(length, columns)) if inner == length => {
                self.push_sized(NodeOperation::Compose(x, y), Matrix(rows, columns), span)?
            }
            (Vector(m), Vector(n)) => {
                let (a, b) = (self.written(a), self.written(b));
                let error = FormulaError::new(span, "`*` does not multiply two vectors");
                if m != n {
                    let help = format!("`{a}` has {m} components, and `{b}` has {n}");
                    return Err(error.with_help(help));
                }
                return Err(error.with_help(format!("write `({a},{b})` or `{a} × {b}`")));
            }
            (Vector(_), Matrix(..)) => {
                let (a, b) = (self.written(a), self.written(b));
                let error = FormulaError::new(span, "a vector cannot stand left of a matrix");
                return Err(error.with_help(format!("write `{b}ᵀ*{a}`")));
            }
            (left @ Matrix(_, columns), right) => {
                let (a, b) = (self.written(a), self.written(b));
                let rows = match right {
                    Vector(length) => format!("{length} components"),
                    Matrix(rows, _) => several(rows, "row"),
                    Scalar => "none".to_string(),
                };
                let (left, right) = (left.in_full(), right.in_full());
                let message = format!("a {left} does not multiply a {right}");
                let help =
                    format!("`{a}` has {}, and `{b}` has {rows}", several(columns, "column"));
                return Err(FormulaError::new(span, message).with_help(help).with_sizes());
            }
        })
    }

    fn quotient(&mut self, a: &Operand, b: &Operand, span: Span) -> Built {
        match b.value_type {
            Type::Scalar => {}
            Type::Vector(_) => {
                let error = FormulaError::new(b.span.clone(), "nothing can be divided by a vector");
                return Err(error.with_help("divide by a scalar such as its norm"));
            }
            Type::Matrix(..) => {
                let (a, b_text) = (self.written(a), self.written(b));
                let help = format!("write `solve({b_text}, {a})` or `inverse({b_text})`");
                let error = FormulaError::new(b.span.clone(), "nothing can be divided by a matrix");
                return Err(error.with_help(help));
            }
        }
        if self.arena.constant(b.node).is_some_and(Rational::is_zero) {
            let error = FormulaError::new(b.span.clone(), "this divides by zero");
            return Err(error.with_help("write a divisor that is not 0"));
        }
        let operation = NodeOperation::Divide(a.node, b.node);
        if a.value_type != Type::Scalar {
            return Ok(self.push(operation, a.value_type, span));
        }
        let fold = |n: &[&Rational]| n[1].recip().map(|inverse| n[0] * &inverse);
        Ok(self.push_folded(operation, &[a.node, b.node], span, fold))
    }

    /// Builds `a × b` or `a ⊗ b`.
    pub fn vector_product(&mut self, infix: Infix, a: &Operand, b: &Operand, span: Span) -> Built {
        let types = (a.value_type, b.value_type);
        if let (Type::Vector(m), Type::Vector(n)) = types {
            if infix == Infix::Outer {
                return self.push_sized(
                    NodeOperation::Outer(a.node, b.node),
                    Type::Matrix(m, n),
                    span,
                );
            }
            if (m, n) == (3, 3) {
                return Ok(self.push(NodeOperation::Cross(a.node, b.node), Type::VECTOR, span));
            }
            let wrong = if m == 3 { b } else { a };
            let message =
                format!("`×` takes vectors of length 3, this is a {}", wrong.value_type.in_full());
            let error = FormulaError::new(wrong.span.clone(), message);
            return Err(match (m, n) {
                (2, 2) => {
                    let entries =
                        |own: &Operand| [1, 2].map(|k| format!("{}[{k}]", self.written(own)));
                    let ([a, b], [c, d]) = (entries(a), entries(b));
                    error.with_help(format!("in the plane write `{a}*{d} - {b}*{c}`"))
                }
                _ => error,
            });
        }
        let sign = if infix == Infix::Outer { "⊗" } else { "×" };
        let message =
            format!("`{sign}` takes two vectors, not a {} and a {}", a.value_type, b.value_type);
        let help = format!("write `{}*{}`", self.written(a), self.written(b));
        let error = FormulaError::new(span, message);
        Err(match types {
            (Type::Vector(_), Type::Matrix(..)) => error,
            _ => error.with_help(help),
        })
    }
}

/// A number with its noun.
fn several(number: usize, noun: &str) -> String {
    match number {
        1 => format!("1 {noun}"),
        _ => format!("{number} {noun}s"),
    }
}

/// Advice for a sum of values of two kinds.
fn one_kind(left: Type, right: Type) -> &'static str {
    match (left, right) {
        (Type::Scalar, Type::Vector(_)) | (Type::Vector(_), Type::Scalar) => {
            "make a scalar of the vector: a component `a[1]`, a norm `|a|` or a product `(a,b)`"
        }
        _ => "write both in one kind and size",
    }
}
