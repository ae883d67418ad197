//! What the grammar bottoms out in: numbers, names, calls, literals and indices.

use super::arena::Operation;
use super::error::{FormulaError, Span};
use super::functions;
use super::lexer::{Kind, fraction, superscript_number};
use super::parser::{Parsed, Parser};
use super::scope::{Meaning, resolve};
use super::typing::Operand;
use super::value::Type;
use crate::number::rational::Rational;

impl Parser<'_> {
    pub(super) fn number(&mut self) -> Parsed {
        let span = self.advance();
        let text = self.text(&span);
        let value: Rational = text
            .chars()
            .next()
            .and_then(fraction)
            .unwrap_or(text)
            .parse()
            .map_err(|error| FormulaError::new(span.clone(), format!("{error}")))?;
        let node = self.builder.arena.push(Operation::Number(value), Type::Scalar, span.clone());
        Ok(self.builder.operand(node, span))
    }

    /// The number a superscript stands for.
    pub(super) fn superscript(&self, span: &Span) -> Result<Rational, FormulaError> {
        superscript_number(self.text(span))
            .parse()
            .map_err(|error| FormulaError::new(span.clone(), format!("{error}")))
    }

    /// A name of the scope, one of its components, the identity, or a call.
    pub(super) fn name(&mut self) -> Parsed {
        let span = self.advance();
        let name = self.text(&span);
        let meaning = resolve(name, self.scope);
        if meaning.is_none() && functions::is_function(name) {
            return self.call(name, span);
        }
        let arena = &mut self.builder.arena;
        let node = match meaning {
            Some(Meaning::Whole(symbol, ty)) => arena.push_symbol(symbol, ty, span.clone()),
            Some(Meaning::Component(symbol, i)) => {
                let vector = arena.push_symbol(symbol, Type::Vector, span.clone());
                arena.push(Operation::Component(vector, i), Type::Scalar, span.clone())
            }
            Some(Meaning::Entry(symbol, i, j)) => {
                let matrix = arena.push_symbol(symbol, Type::Matrix, span.clone());
                arena.push(Operation::Entry(matrix, i, j), Type::Scalar, span.clone())
            }
            Some(Meaning::Constant(constant)) => {
                arena.push(Operation::Constant(constant), Type::Scalar, span.clone())
            }
            Some(Meaning::Identity) => arena.push(Operation::Identity, Type::Matrix, span.clone()),
            Some(Meaning::OutOfRange(base, ty)) => return Err(out_of_range(name, &base, ty, span)),
            None => return Err(self.unknown_name(name, span)),
        };
        Ok(self.builder.operand(node, span))
    }

    fn call(&mut self, name: &str, span: Span) -> Parsed {
        if self.peek() != Kind::Open {
            let error = FormulaError::new(span, format!("`{name}` is a function"));
            return Err(error.with_help(functions::usage(name)));
        }
        let (arguments, brackets) = self.list(Kind::Close)?;
        let span = span.start..brackets.end;
        let node = functions::call(&mut self.builder.arena, name, &arguments, span.clone())?;
        Ok(self.builder.operand(node, span))
    }

    /// `[a,b,c]`, or `[[..],[..],[..]]` by rows.
    pub(super) fn literal(&mut self) -> Parsed {
        let (items, span) = self.list(Kind::CloseSquare)?;
        let [a, b, c] = items.as_slice() else {
            let error =
                FormulaError::new(span, format!("a vector has 3 components, not {}", items.len()));
            return Err(error.with_help("a vector is written `[a,b,c]`, a dot product `(a,b)`"));
        };
        let scalar = |item: &&Operand| item.value_type == Type::Scalar;
        let row = |item: &&Operand| {
            self.text(&item.span).starts_with('[') && item.value_type == Type::Vector
        };
        let nodes = [a.node, b.node, c.node];
        let odd = |item: &&Operand| if row(&a) { !row(item) } else { !scalar(item) };
        if let Some(wrong) = items.iter().find(odd) {
            let message = if row(&a) {
                format!("a row of a matrix is written `[a,b,c]`, this is a {}", wrong.value_type)
            } else {
                format!("a component is a scalar, this is a {}", wrong.value_type)
            };
            let error = FormulaError::new(wrong.span.clone(), message);
            return Err(error.with_help("a matrix with the rows u, v, w is written `mat(u,v,w)`"));
        }
        let (operation, ty) = if row(&a) {
            (Operation::Rows(nodes), Type::Matrix)
        } else {
            (Operation::Vector(nodes), Type::Vector)
        };
        let node = self.builder.arena.push(operation, ty, span.clone());
        Ok(self.builder.operand(node, span))
    }

    /// `[i]` or `[i,j]` behind an operand, as counted from 0; the span covers the brackets.
    pub(super) fn indices(&mut self) -> Result<(Vec<usize>, Span), FormulaError> {
        let open = self.advance();
        let mut indices = Vec::new();
        loop {
            let span = self.token().span.clone();
            if self.peek() == Kind::End {
                return Err(self.unclosed(&open));
            }
            let index = self.text(&span).parse::<usize>().ok().filter(|i| (1..=3).contains(i));
            let Some(index) = index else {
                let error = FormulaError::new(span, "an index is 1, 2 or 3");
                return Err(error.with_help("write `γ[3]` or `B[1,2]`"));
            };
            indices.push(index - 1);
            self.advance();
            match self.peek() {
                Kind::Comma => self.advance(),
                Kind::CloseSquare => break,
                _ => return Err(self.unclosed(&open)),
            };
        }
        Ok((indices, open.start..self.advance().end))
    }
}

fn out_of_range(name: &str, base: &str, ty: Type, span: Span) -> FormulaError {
    let error = FormulaError::new(span, format!("there is no component `{name}`"));
    error.with_help(match ty {
        Type::Matrix => format!("`{base}` has the entries {base}11 to {base}33"),
        _ => format!("`{base}` has the components {base}1, {base}2, {base}3"),
    })
}
