//! Whole numbers that a file fixes: indices, bounds and sizes, and conditions between them.

use super::error::{FormulaError, Span};
use super::lexer::TokenKind;
use super::names::canonical_name;
use super::parser::{Parser, SUM};
use super::typing::Operand;

impl Parser<'_> {
    /// Reads a condition between whole numbers: `i ≠ j`, `1 < i ≤ n`.
    pub(super) fn condition(&mut self) -> Result<bool, FormulaError> {
        let (mut left, start) = self.whole("a side of a condition")?;
        let mut holds = true;
        if self.peek() != TokenKind::Comparison {
            let error = FormulaError::new(start, "a condition is missing here");
            return Err(error.with_help("write `i = j`, `i ≠ j`, `i < j` or the like"));
        }
        while self.peek() == TokenKind::Comparison {
            let sign = self.advance();
            let (right, _) = self.whole("a side of a condition")?;
            holds &= match self.text(&sign) {
                "=" | "==" => left == right,
                "≠" | "!=" => left != right,
                "<" => left < right,
                "≤" | "<=" => left <= right,
                ">" => left > right,
                _ => left >= right,
            };
            left = right;
        }
        Ok(holds)
    }

    /// Reads a whole number that the file fixes: an index, a bound or a size.
    pub(super) fn whole(&mut self, what: &str) -> Result<(i64, Span), FormulaError> {
        let outer = std::mem::replace(&mut self.whole_numbers, true);
        let result = self.whole_inside(what);
        self.whole_numbers = outer;
        result
    }

    fn whole_inside(&mut self, what: &str) -> Result<(i64, Span), FormulaError> {
        let value = self.expression(SUM)?;
        let (number, span) = self.taken(&value, what)?;
        if !self.is_modulo() {
            return Ok((number, span));
        }
        self.advance();
        let modulus = self.expression(SUM)?;
        let (modulus, place) = self.taken(&modulus, what)?;
        if modulus < 1 {
            let message = format!("`mod` counts around a positive number, not {modulus}");
            return Err(FormulaError::new(place, message));
        }
        Ok(((number - 1).rem_euclid(modulus) + 1, span.start..place.end))
    }

    /// Whether the next token is the `mod` of an index.
    pub(super) fn is_modulo(&self) -> bool {
        self.whole_numbers
            && self.peek() == TokenKind::Name
            && self.text(&self.token().span) == "mod"
    }

    fn taken(&mut self, operand: &Operand, what: &str) -> Result<(i64, Span), FormulaError> {
        let value = self.builder.arena.take_constant(operand.node);
        let limit = 1 << 31;
        let whole = value.and_then(|value| value.to_integer()).filter(|n| n.abs() < limit);
        whole.map(|whole| (whole, operand.span.clone())).ok_or_else(|| {
            let message = format!("{what} is a whole number that the file fixes");
            FormulaError::new(operand.span.clone(), message)
                .with_help("use numbers, indices, and parameters such as n = 4")
        })
    }

    /// Value of an index of an enclosing form.
    pub(super) fn bound(&mut self, name: &str) -> Option<i64> {
        if self.bindings.is_empty() {
            return None;
        }
        let canonical = canonical_name(name)?;
        let found = self.bindings.iter().rev().find(|(known, _)| *known == canonical)?.1;
        self.indices_read += 1;
        Some(found)
    }
}
