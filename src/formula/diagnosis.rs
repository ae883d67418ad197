//! Messages for text that does not follow the grammar.

use super::error::{FormulaError, Span, excerpt};
use super::functions;
use super::lexer::Kind;
use super::parser::Parser;
use super::scope::resolve;
use super::spelling::{nearest, split};
use super::typing::Operand;
use super::value::Type;

impl Parser<'_> {
    /// An operand follows `left` with no operator between them.
    pub(super) fn missing_times(&mut self, left: &Operand) -> FormulaError {
        let token = self.token().clone();
        let right = match (self.attempt(), token.kind) {
            (Err(error), Kind::Bar) => return self.odd_bar(&token.span, error),
            (right, _) => right.ok(),
        };
        let a = excerpt(self.text(&left.span));
        let b = match (&right, token.kind) {
            (Some(right), _) => excerpt(self.text(&right.span)),
            (None, Kind::Name | Kind::Number) => excerpt(self.text(&token.span)),
            (None, _) => format!("{}…", self.text(&token.span)),
        };
        let types = (left.value_type, right.map(|right| right.value_type));
        if types == (Type::Vector, Some(Type::Vector)) {
            let error = FormulaError::new(token.span, "there is no operator between two vectors");
            return error.with_help(format!("write `({a},{b})` or `{a} × {b}`"));
        }
        FormulaError::new(token.span, "missing `*`").with_help(format!("write `{a}*{b}`"))
    }

    /// A bar where an operator should stand, and the error that reading on from it gave.
    fn odd_bar(&self, bar: &Span, error: FormulaError) -> FormulaError {
        let (before, after) = (&self.builder.text[..bar.start], &self.builder.text[bar.end..]);
        match self.innermost() {
            _ if after.contains('|') => error,
            // `|(a|`: the bracket is missing its end, not the bar
            Some(bracket) if before.contains('|') => self.unclosed_before(&bracket, bar),
            _ => FormulaError::new(bar.clone(), "this `|` has no partner"),
        }
    }

    /// Something else stands where a number, a name or a bracket should.
    pub(super) fn missing_operand(&self) -> FormulaError {
        let span = self.token().span.clone();
        let error = match self.peek() {
            Kind::End => {
                // point at the operator that is left without its right side
                let end = self.builder.text.trim_end().len();
                let start =
                    self.builder.text[..end].char_indices().next_back().map_or(0, |(at, _)| at);
                return FormulaError::new(start..end, "the formula breaks off after this");
            }
            _ => {
                let found = self.text(&span);
                let message =
                    format!("a number, a name or a bracket should stand before `{found}`");
                FormulaError::new(span.clone(), message)
            }
        };
        let before = self.builder.text[..span.start].trim_end().chars().next_back();
        match (self.peek(), before) {
            (Kind::Times, Some('*')) => error.with_help("a power is written `a^b`"),
            (Kind::Plus, _) => error.with_help("leave out a leading `+`"),
            _ => error,
        }
    }

    /// The bracket or bar opened at `open` meets something that does not close it.
    pub(super) fn unclosed(&self, open: &Span) -> FormulaError {
        self.unclosed_before(open, &self.token().span)
    }

    fn unclosed_before(&self, open: &Span, found: &Span) -> FormulaError {
        let (sign, found) = (self.text(open), self.text(found));
        let message = format!("this `{sign}` is not closed");
        let error = FormulaError::new(open.clone(), message);
        if found.is_empty() {
            error
        } else {
            error.with_help(format!("it should close before `{found}`"))
        }
    }

    /// A token that nothing before it calls for, behind a complete formula.
    pub(super) fn unexpected_end(&self) -> FormulaError {
        let span = self.token().span.clone();
        let found = self.text(&span);
        match self.peek() {
            Kind::Close | Kind::CloseSquare => {
                FormulaError::new(span, format!("this `{found}` closes nothing"))
            }
            Kind::Comma => FormulaError::new(span, "a comma stands between brackets only")
                .with_help("a dot product is written `(a,b)`, a vector `[a,b,c]`"),
            _ => FormulaError::new(span, format!("`{found}` cannot follow a complete formula")),
        }
    }

    /// `a × b × c`, read up to its second sign.
    pub(super) fn chained_products(&mut self, a: &Operand, b: &Operand) -> FormulaError {
        let first_sign = self.builder.text[a.span.end..b.span.start].trim();
        let sign = self.advance();
        let third = self.attempt();
        let end = third.as_ref().map_or(sign.end, |third| third.span.end);
        let [x, y] = [a, b].map(|operand| excerpt(self.text(&operand.span)));
        let z = third.map_or("…".to_string(), |third| excerpt(self.text(&third.span)));
        let sign = self.text(&sign);
        FormulaError::new(a.span.start..end, "products of vectors in a row need brackets")
            .with_help(format!(
                "write `({x} {first_sign} {y}) {sign} {z}` or `{x} {first_sign} ({y} {sign} {z})`"
            ))
    }

    /// A name nobody knows.
    pub(super) fn unknown_name(&self, name: &str, span: Span) -> FormulaError {
        let called = self.peek() == Kind::Open;
        let known = |piece: &str| resolve(piece, self.scope).is_some();
        if let Some(pieces) = split(name, known) {
            let message = format!("unknown name `{name}`");
            return FormulaError::new(span, message)
                .with_help(format!("write `{}`?", pieces.join("*")));
        }
        let mut names = self.scope.names();
        if called {
            names.extend(functions::names().map(str::to_string));
        }
        let canonical = super::names::canonical_name(name).unwrap_or_default();
        let guess = [name, &canonical]
            .into_iter()
            .find_map(|name| nearest(name, names.iter().map(String::as_str)));
        let kind = if called { "function" } else { "name" };
        let error = FormulaError::new(span, format!("unknown {kind} `{}`", excerpt(name)));
        match guess {
            Some(guess) => error.with_help(format!("did you mean `{guess}`?")),
            None => error,
        }
    }
}
