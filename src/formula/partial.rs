//! Partial derivatives: `∂F/∂x`, or `partial(F, x)`.
//!
//! | F | x | value |
//! |---|---|---|
//! | scalar | scalar, vector, matrix | of the type of x: the gradient |
//! | vector, matrix | scalar | of the type of F |
//! | vector of m | vector of n | m × n, the entry i, j being ∂Fᵢ/∂xⱼ |
//!
//! x is a state variable or a component of one. State variables are independent of one another and
//! of the parameters, on a level set too; abbreviations in F are differentiated through.

use super::arena::NodeOperation;
use super::error::{FormulaError, Span, excerpt};
use super::kind::Type;
use super::lexer::TokenKind;
use super::parser::{Parsed, Parser};
use super::scope::{Symbol, SymbolOrigin, resolve};
use super::slopes::{Slopes, VariedPart};
use super::typing::{Built, Operand};

/// The sign of a derivative.
const SIGN: char = '∂';

/// Name of the derivative as a call.
pub(super) const CALL: &str = "partial";

const USAGE: &str = "write `∂F/∂x`, `∂(a + b)/∂x` or `partial(a + b, x)`";

impl Parser<'_> {
    /// Reads a derivative, if the name that has been read begins one.
    pub(super) fn derivative(&mut self, name: &str, span: &Span) -> Option<Parsed> {
        if name == CALL && self.peek() == TokenKind::Open {
            return Some(self.derivative_call(span.clone()));
        }
        name.starts_with(SIGN).then(|| self.derivative_fraction(span.clone()))
    }

    /// Reads `∂F/∂x`; the sign and the name behind it have been read.
    fn derivative_fraction(&mut self, span: Span) -> Parsed {
        let own = span.start + SIGN.len_utf8()..span.end;
        let of = match own.is_empty() {
            true if matches!(self.peek(), TokenKind::Open | TokenKind::Bar) => self.primary()?,
            true => return Err(unfinished(span)),
            false => self.component_of(own)?,
        };
        if self.peek() != TokenKind::Slash {
            return Err(unfinished(span.start..of.span.end));
        }
        self.advance();
        let place = self.token().span.clone();
        if self.peek() != TokenKind::Name || !self.text(&place).starts_with(SIGN) {
            return Err(unfinished(span.start..place.end));
        }
        self.advance();
        let own = place.start + SIGN.len_utf8()..place.end;
        if own.is_empty() {
            return Err(unfinished(span.start..place.end));
        }
        let by = self.component_of(own)?;
        let span = span.start..by.span.end;
        self.differentiated(&of, &by, span)
    }

    /// Reads `partial(F, x)`; the name has been read.
    fn derivative_call(&mut self, span: Span) -> Parsed {
        let (items, brackets) = self.list(TokenKind::Close)?;
        let span = span.start..brackets.end;
        match items.as_slice() {
            [of, by] => self.differentiated(of, by, span),
            _ => Err(unfinished(span)),
        }
    }

    /// Reads a name at a place that has been passed, with the indices behind it.
    fn component_of(&mut self, place: Span) -> Parsed {
        let name = self.text(&place);
        if resolve(name, self.scope).is_none() {
            return Err(self.unknown_name(name, place));
        }
        let whole = self.name_at(place)?;
        if self.peek() != TokenKind::OpenSquare {
            return Ok(whole);
        }
        let (indices, brackets) = self.indices()?;
        self.builder.index(&whole, &indices, brackets)
    }

    fn differentiated(&mut self, of: &Operand, by: &Operand, span: Span) -> Built {
        if self.whole_numbers {
            return Err(FormulaError::new(span, "a derivative is not a whole number"));
        }
        let (variable, parts) = self.varied(by)?;
        let kind = match (of.value_type, by.value_type) {
            (kind, Type::Scalar) | (Type::Scalar, kind) => kind,
            (Type::Vector(m), Type::Vector(n)) => Type::Matrix(m, n),
            (of, by) => {
                let message = format!("a {of} is not differentiated by a {by}");
                let help = "differentiate by a component, such as `∂A/∂x[1]`";
                return Err(FormulaError::new(span, message).with_help(help));
            }
        };
        let scope = self.scope;
        let mut slopes = Slopes::new(&mut self.builder, scope, variable, span.clone());
        let mut values = Vec::new();
        for part in parts {
            let slope = slopes.along(part, of.node)?;
            values.push(match slope {
                Some(node) => slopes.at(node),
                None => slopes.zero(of.value_type),
            });
        }
        let builder = &mut self.builder;
        let derivative = match (of.value_type, by.value_type, values) {
            (Type::Scalar, Type::Vector(_), values) => builder.vector(&values, span.clone())?,
            (Type::Scalar, Type::Matrix(_, columns), values) => {
                let rows = values.chunks(columns).map(|row| builder.vector(row, span.clone()));
                let rows = rows.collect::<Result<Vec<Operand>, _>>()?;
                builder.rows(&rows, span.clone())?
            }
            (Type::Vector(_), Type::Vector(_), values) => {
                let columns = builder.rows(&values, span.clone())?;
                builder.transpose(&columns, span.clone())?
            }
            (_, _, mut values) => match values.pop() {
                Some(value) => value,
                None => return Err(unfinished(span)),
            },
        };
        let (derivative, of, by) = (derivative.node, of.node, by.node);
        Ok(builder.push(NodeOperation::Partial { derivative, of, by }, kind, span))
    }

    /// The variable, and its parts in their order.
    fn varied(&self, by: &Operand) -> Result<(Symbol, Vec<VariedPart>), FormulaError> {
        let arena = &self.builder.arena;
        let slot = |node: usize| match arena.nodes[node].operation {
            NodeOperation::Symbol(slot) => Some(slot),
            _ => None,
        };
        let (slot, part) = match arena.nodes[by.node].operation {
            NodeOperation::Component(a, i) => (slot(a), VariedPart::Component(i)),
            NodeOperation::Entry(a, i, j) => (slot(a), VariedPart::Entry(i, j)),
            _ => (slot(by.node), VariedPart::Whole),
        };
        let symbol = slot.map(|slot| arena.symbols[slot].0);
        let is_variable =
            |symbol: &Symbol| matches!(self.scope.origin(*symbol), SymbolOrigin::Variable);
        let Some(symbol) = symbol.filter(is_variable) else {
            let text = excerpt(self.text(&by.span));
            let message = format!("`{text}` is not a state variable");
            let help = "derivatives are taken by a state variable or a component of one";
            return Err(FormulaError::new(by.span.clone(), message).with_help(help));
        };
        let parts = match (by.value_type, part) {
            (Type::Vector(n), _) => (0..n).map(VariedPart::Component).collect(),
            (Type::Matrix(rows, columns), _) => {
                let entry = |k: usize| VariedPart::Entry(k / columns, k % columns);
                (0..rows * columns).map(entry).collect()
            }
            (Type::Scalar, part) => vec![part],
        };
        Ok((symbol, parts))
    }
}

/// The error for a derivative that lacks a part.
fn unfinished(span: Span) -> FormulaError {
    FormulaError::new(span, "this derivative is not complete").with_help(USAGE)
}
