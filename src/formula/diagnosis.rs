//! Messages for text that violates the grammar.

use super::error::{FormulaError, Span, excerpt};
use super::kind::Type;
use super::lexer::{Token, TokenKind, superscript_number};
use super::parser::Parser;
use super::scope::resolve;
use super::spelling::split;
use super::typing::Operand;

/// Units that textbooks write behind numbers.
const UNITS: [&str; 24] = [
    "m", "cm", "mm", "km", "s", "ms", "min", "h", "g", "kg", "N", "J", "W", "Hz", "K", "A", "V",
    "C", "T", "Pa", "rad", "deg", "eV", "au",
];

const NO_EQUATION: &str = "a formula is a value, not an equation";

impl Parser<'_> {
    /// The error for an operand that follows `left` with no operator between them.
    pub(super) fn missing_times(&mut self, left: &Operand) -> FormulaError {
        let token = self.token().clone();
        let right = match (self.attempt(), token.kind) {
            (Err(error), TokenKind::Bar) => return self.odd_bar(&token.span, error),
            (right, _) => right.ok(),
        };
        let a = excerpt(self.text(&left.span));
        let b = match (&right, token.kind) {
            (Some(right), _) => excerpt(self.text(&right.span)),
            (None, TokenKind::Name | TokenKind::Number) => excerpt(self.text(&token.span)),
            (None, _) => format!("{}…", self.text(&token.span)),
        };
        if matches!((left.value_type, b.as_str()), (Type::Vector(_), "x" | "X")) {
            let error = FormulaError::new(token.span, "an operator is missing between two vectors");
            return error.with_help(format!("a cross product is written `{a} × …`"));
        }
        if let Some(help) = self.adjacent(left, &token, &b) {
            return FormulaError::new(token.span.clone(), format!("`{b}` cannot stand here"))
                .with_help(help);
        }
        let types = (left.value_type, right.as_ref().map(|right| right.value_type));
        if matches!(types, (Type::Vector(_), Some(Type::Vector(_)))) {
            let error = FormulaError::new(token.span, "an operator is missing between two vectors");
            return error.with_help(format!("write `({a},{b})` or `{a} × {b}`"));
        }
        let known = |piece: &str| resolve(piece, self.scope).is_some();
        let pieces = split(&b, known).filter(|_| right.is_none()).map(|pieces| pieces.join("*"));
        let b = pieces.unwrap_or(b);
        if let Some(help) = self.divided(left, &token.span, &b) {
            return FormulaError::new(token.span, "missing `*`").with_help(help);
        }
        if let Some(help) = self.units(left, &token.span, &b) {
            return FormulaError::new(token.span, "missing `*`").with_help(help);
        }
        FormulaError::new(token.span, "missing `*`").with_help(format!("write `{a}*{b}`"))
    }

    /// Advice where a factor follows a divisor, by which it may be meant to divide as well.
    fn divided(&self, left: &Operand, right: &Span, name: &str) -> Option<String> {
        let text = self.builder.text;
        let before = text[..left.span.start].trim_end().strip_suffix('/')?.trim_end();
        let mut depth = 0usize;
        let start = before.char_indices().rev().find_map(|(at, letter)| {
            match letter {
                ')' | ']' => depth += 1,
                '(' | '[' if depth > 0 => depth -= 1,
                '(' | '[' | ',' | '+' | '-' | '−' | '=' if depth == 0 => {
                    return Some(at + letter.len_utf8());
                }
                _ => {}
            }
            None
        });
        let above = excerpt(before[start.unwrap_or(0)..].trim_start());
        let below = excerpt(self.text(&left.span));
        let whole = format!("`{above}/({below}*{name})`");
        let product = format!("`{above}/{below}*{name}`");
        // A gap before the factor speaks against its being part of the divisor.
        let (first, second) = match left.span.end < right.start {
            true => (product, whole),
            false => (whole, product),
        };
        Some(format!("write {first} or {second}, whichever is meant"))
    }

    /// Advice where units follow a number to the end of the formula.
    fn units(&self, left: &Operand, right: &Span, name: &str) -> Option<String> {
        let number = self.text(&left.span);
        let is_number = number.chars().all(|c| c.is_ascii_digit() || c == '.');
        let rest = self.builder.text[right.start..].trim();
        let is_unit = |word: &str| UNITS.contains(&word);
        let mut words = rest.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty());
        let has_other = rest.contains(|c: char| {
            !c.is_alphanumeric()
                && !matches!(c, '/' | '*' | '·' | '^' | '²' | '³' | '⁻' | '-' | '−' | ' ')
        });
        let is_all =
            is_number && !has_other && words.clone().next().is_some() && words.all(is_unit);
        // The name of a parameter is no unit.
        let is_known = rest == name && resolve(name, self.scope).is_some();
        (is_all && !is_known).then(|| match rest == name {
            true => format!(
                "numbers have no units: write `{number}`, or `{number}*{name}` with a name `{name}`"
            ),
            false => format!("numbers have no units: write `{number}`"),
        })
    }

    /// Advice for a token that follows a value and is no factor of it.
    fn adjacent(&self, left: &Operand, token: &Token, text: &str) -> Option<String> {
        let is_time = || self.builder.text[token.span.start..].replace(' ', "").starts_with("(t)");
        match (token.kind, text) {
            (TokenKind::Name, "mod") => {
                Some("`k mod n` stands in an index, as in `x[i+1 mod n]`".to_string())
            }
            (TokenKind::Name, "dot" | "cross") => {
                let a = excerpt(self.text(&left.span));
                let sign = if text == "dot" { "`(a,b)`" } else { "`a × b`" };
                Some(match left.value_type {
                    Type::Scalar => format!("a product is written `{a}*…`, one of vectors {sign}"),
                    _ => format!("a product of vectors is written {sign}"),
                })
            }
            (TokenKind::Open, _) if is_time() => Some(format!(
                "write `{}`, which is the value at the time t",
                excerpt(self.text(&left.span))
            )),
            (TokenKind::Name, "if" | "where" | "for" | "when") => Some(
                "`if(i = j, a, b)` compares indices; values have `max`, `min`, `sign` and `|x|`"
                    .to_string(),
            ),
            (TokenKind::Number, number) if number.starts_with('.') => {
                let left = self.text(&left.span);
                Some(match left.ends_with(|c: char| c.is_ascii_digit()) {
                    true => "a number has one decimal point".to_string(),
                    false => format!("a component is written `{}[1]`", excerpt(left)),
                })
            }
            _ => None,
        }
    }

    /// The error for a bar in place of an operator, given the error from reading on.
    fn odd_bar(&self, bar: &Span, error: FormulaError) -> FormulaError {
        let (before, after) = (&self.builder.text[..bar.start], &self.builder.text[bar.end..]);
        match self.innermost() {
            _ if after.contains('|') => error,
            // `|(a|`: the end of the bracket is missing, not that of the bar
            Some(bracket) if before.contains('|') => self.unclosed_before(&bracket, bar),
            _ => FormulaError::new(bar.clone(), "this `|` is not matched"),
        }
    }

    /// The error for a token in place of a number, a name or a bracket.
    pub(super) fn missing_operand(&self) -> FormulaError {
        let span = self.token().span.clone();
        let error = match self.peek() {
            TokenKind::End => {
                // point at the operator that is left without its right side
                let end = self.builder.text.trim_end().len();
                let start =
                    self.builder.text[..end].char_indices().next_back().map_or(0, |(at, _)| at);
                let sign = self.builder.text.get(start..end).unwrap_or_default();
                return FormulaError::new(start..end, "the formula breaks off after this")
                    .with_help(format!("write what follows, or remove `{sign}`"));
            }
            _ => {
                let found = self.text(&span);
                let message = format!("a number, a name or a bracket is missing before `{found}`");
                FormulaError::new(span.clone(), message)
            }
        };
        let before = self.builder.text[..span.start].trim_end().chars().next_back();
        match (self.peek(), before) {
            (TokenKind::Times, Some('*')) => error.with_help("a power is written `a^b`"),
            (TokenKind::Plus, None | Some('(' | '[' | ',')) => {
                error.with_help("leave out a leading `+`")
            }
            (
                TokenKind::Plus
                | TokenKind::Minus
                | TokenKind::Times
                | TokenKind::Slash
                | TokenKind::Cross,
                Some(_),
            ) => error.with_help("remove one of the two signs"),
            (
                TokenKind::Times
                | TokenKind::Slash
                | TokenKind::Cross
                | TokenKind::Outer
                | TokenKind::Caret,
                None,
            ) => error.with_help("write what stands before the sign, or remove it"),
            (TokenKind::Comparison, None) if self.text(&span) == "<" => {
                error.with_help("a dot product is written `(a,b)`")
            }
            (TokenKind::Superscript, Some('^')) => {
                let exponent = superscript_number(self.text(&span));
                error.with_help(format!("write `a^{exponent}` or `a{}`", self.text(&span)))
            }
            (TokenKind::Comparison, _) => error.with_help(NO_EQUATION),
            _ => error,
        }
    }

    /// The error for a bracket or bar opened at `open` and not closed here.
    pub(super) fn unclosed(&self, open: &Span) -> FormulaError {
        self.unclosed_before(open, &self.token().span)
    }

    fn unclosed_before(&self, open: &Span, found: &Span) -> FormulaError {
        let (sign, found) = (self.text(open), self.text(found));
        let message = format!("this `{sign}` is not closed");
        let error = FormulaError::new(open.clone(), message);
        if found.is_empty() {
            let partner = match sign {
                "(" => ")",
                "[" => "]",
                _ => sign,
            };
            error.with_help(format!("write `{partner}` where it ends"))
        } else {
            error.with_help(format!("it should close before `{found}`"))
        }
    }

    /// The error for an extra token behind a complete formula.
    pub(super) fn unexpected_end(&self) -> FormulaError {
        let span = self.token().span.clone();
        let found = self.text(&span);
        match self.peek() {
            TokenKind::Close | TokenKind::CloseSquare => {
                FormulaError::new(span, format!("this `{found}` closes nothing"))
                    .with_help("remove it, or open a bracket before it")
            }
            TokenKind::Comparison => self.equation(span),
            TokenKind::Range => FormulaError::new(span, format!("`{found}` has no meaning here"))
                .with_help("a range is written in [parameters] and [state], and in `sum(i, 1..n, …)`; a formula has one value"),
            TokenKind::Comma if self.is_decimal(&span) => {
                let (before, after) = self.digits_around(&span);
                FormulaError::new(span, "a decimal number has a point, not a comma")
                    .with_help(format!("write {before}.{after}"))
            }
            TokenKind::Comma => FormulaError::new(span, "a comma is allowed only inside brackets")
                .with_help("a dot product is written `(a,b)`, a vector `[a,b,c]`, a list of formulas [\"a\", \"b\"]"),
            _ => FormulaError::new(span, format!("`{found}` cannot follow a complete formula")),
        }
    }

    /// The error for a sign of equality or comparison; a name before it, and a constant after it, can be
    /// left out.
    pub(super) fn equation(&self, sign: Span) -> FormulaError {
        let text = self.builder.text;
        let (before, after) = (text[..sign.start].trim(), text[sign.end..].trim());
        let is_name = |text: &str| {
            text.starts_with(char::is_alphabetic)
                && text.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '\''))
        };
        let found = &text[sign.clone()];
        let spare = match (found, after) {
            ("=", "const" | "const." | "constant" | "c" | "C") => Some(format!("= {after}")),
            ("=", _) if is_name(before) => Some(format!("{before} =")),
            _ => None,
        };
        let is_sum = |text: &str| text.contains(['+', '-', '−']);
        let help = match spare {
            Some(spare) => format!("{NO_EQUATION}: leave out `{spare}`"),
            None if found == "=" && !before.is_empty() && !after.is_empty() => {
                let (a, b) = (excerpt(before), excerpt(after));
                let difference = match after {
                    "0" => a.clone(),
                    _ if is_sum(after) => format!("{a} - ({b})"),
                    _ => format!("{a} - {b}"),
                };
                format!(
                    "{NO_EQUATION}: write `{difference}`, or claim the equation by identity = \"{a} = {b}\""
                )
            }
            None if found != "=" => {
                format!("{NO_EQUATION}; values are compared by `max`, `min`, `sign` and `|x|`")
            }
            None => NO_EQUATION.to_string(),
        };
        FormulaError::new(sign, format!("`{found}` has no meaning in a formula")).with_help(help)
    }

    /// Digits before and after a comma.
    fn digits_around(&self, comma: &Span) -> (&str, &str) {
        let (before, after) = (&self.builder.text[..comma.start], &self.builder.text[comma.end..]);
        let is_other = |c: char| !c.is_ascii_digit();
        let whole = before.rsplit(is_other).next().unwrap_or_default();
        (whole, after.split(is_other).next().unwrap_or_default())
    }

    /// Whether a comma stands between digits.
    fn is_decimal(&self, comma: &Span) -> bool {
        let (before, after) = self.digits_around(comma);
        let start = comma.start - before.len();
        let is_part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.');
        let is_alone = !self.builder.text[..start].ends_with(is_part);
        !before.is_empty() && is_alone && !after.is_empty()
    }

    /// The error for `a × b × c`, read up to its second sign.
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
}
