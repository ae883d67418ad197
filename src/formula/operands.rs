//! Primary operands of the grammar: numbers, names, calls, literals and indices.

use super::arena::NodeOperation;
use super::error::{FormulaError, Span};
use super::kind::Type;
use super::lexer::{TokenKind, fraction, superscript_number};
use super::names::canonical_name;
use super::parser::{Parsed, Parser};
use super::scope::{NameMeaning, resolve};
use super::typing::Operand;
use super::{binders, functions};
use crate::number::rational::{Rational, RationalError};

/// The error for a number that cannot be read.
fn too_long(span: &Span, error: &RationalError) -> FormulaError {
    FormulaError::new(span.clone(), error.to_string())
        .with_help("round it, or write it as a product of powers")
}

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
            .map_err(|error| too_long(&span, &error))?;
        let node =
            self.builder.arena.push(NodeOperation::Number(value), Type::Scalar, span.clone());
        Ok(self.builder.operand(node, span))
    }

    /// Value of a superscript.
    pub(super) fn superscript(&self, span: &Span) -> Result<Rational, FormulaError> {
        superscript_number(self.text(span)).parse().map_err(|error| too_long(span, &error))
    }

    /// Reads a name of the scope, one of its components, the identity, or a call.
    pub(super) fn name(&mut self) -> Parsed {
        let span = self.advance();
        self.name_at(span)
    }

    /// Reads the name at a place that has been passed.
    pub(super) fn name_at(&mut self, span: Span) -> Parsed {
        let name = self.text(&span);
        if let Some(value) = self.bound(name) {
            let number = NodeOperation::Number(Rational::from(value));
            return Ok(self.builder.push(number, Type::Scalar, span));
        }
        let meaning = resolve(name, self.scope);
        if meaning.is_none() && canonical_name(name).is_some_and(|name| self.scope.awaits(&name)) {
            return Err(self.unknown_name(name, span));
        }
        if meaning.is_none() && functions::is_function(name) {
            return self.call(name, span);
        }
        if meaning.is_none() && binders::is_form(name) {
            return self.form(name, span);
        }
        if meaning.is_none()
            && let Some(derivative) = self.derivative(name, &span)
        {
            return derivative;
        }
        if self.whole_numbers && meaning.is_some() {
            return self.known_number(name, span);
        }
        if meaning == Some(NameMeaning::Identity) && self.peek() == TokenKind::Open {
            return self.unit_matrix(span);
        }
        let (builder, scope) = (&mut self.builder, self.scope);
        Ok(match meaning {
            Some(NameMeaning::Whole(symbol, ty)) => builder.symbol(symbol, ty, span, scope),
            Some(NameMeaning::Component(symbol, ty, i)) => {
                let vector = builder.symbol(symbol, ty, span.clone(), scope);
                builder.push(NodeOperation::Component(vector.node, i), Type::Scalar, span)
            }
            Some(NameMeaning::Entry(symbol, ty, i, j)) => {
                let matrix = builder.symbol(symbol, ty, span.clone(), scope);
                builder.push(NodeOperation::Entry(matrix.node, i, j), Type::Scalar, span)
            }
            Some(NameMeaning::Constant(constant)) => {
                builder.push(NodeOperation::Constant(constant), Type::Scalar, span)
            }
            Some(NameMeaning::Identity) => {
                builder.push(NodeOperation::Identity, Type::MATRIX, span)
            }
            Some(NameMeaning::OutOfRange(base, ty)) => {
                return Err(out_of_range(name, &base, ty, span));
            }
            None => return Err(self.unknown_name(name, span)),
        })
    }

    /// Reads a name in an index, a bound or a size.
    fn known_number(&mut self, name: &str, span: Span) -> Parsed {
        let known = |name: &str| Some((self.scope.lookup(name)?.0, self.scope.whole_number(name)?));
        let found = known(name).or_else(|| known(&canonical_name(name)?));
        let Some((symbol, value)) = found else {
            let message = format!("`{name}` is not a whole number that the file fixes");
            let before = self.builder.text[..span.start].trim_end();
            let help = match before.ends_with("if(") {
                true => {
                    "`if(i = j, a, b)` compares indices; values have `max`, `min`, `sign` and `|x|`"
                }
                false => "use numbers, indices, and parameters such as n = 4",
            };
            return Err(FormulaError::new(span, message).with_help(help));
        };
        let fixed = &mut self.builder.arena.fixed;
        if !fixed.contains(&symbol) {
            fixed.push(symbol);
        }
        let number = NodeOperation::Number(Rational::from(value));
        Ok(self.builder.push(number, Type::Scalar, span))
    }

    fn call(&mut self, name: &str, span: Span) -> Parsed {
        if self.peek() != TokenKind::Open {
            let help = match self.peek() {
                TokenKind::Caret if name == "exp" => {
                    self.advance();
                    let exponent = self.attempt().ok();
                    let exponent = exponent.map_or("x", |own| self.text(&own.span));
                    match exponent.starts_with('(') {
                        true => format!("write `exp{exponent}`"),
                        false => format!("write `exp({exponent})`"),
                    }
                }
                TokenKind::Caret | TokenKind::Superscript => {
                    format!("{}; its power is `({name}(x))^2`", functions::usage(name))
                }
                TokenKind::Name | TokenKind::Number if functions::takes_one(name) => {
                    let word = self.token().span.clone();
                    let argument = self.attempt().map_or(word, |own| own.span);
                    format!("write `{name}({})`", self.text(&argument))
                }
                TokenKind::Bar if functions::takes_one(name) => format!("write `{name}(|x|)`"),
                _ => functions::usage(name),
            };
            let error = FormulaError::new(span, format!("`{name}` is a function"));
            return Err(error.with_help(help));
        }
        let (arguments, brackets) = self.list(TokenKind::Close)?;
        let span = span.start..brackets.end;
        functions::call(&mut self.builder, name, &arguments, span)
    }

    /// Reads `[a,b,c]`, or `[[..],[..],[..]]` by rows.
    pub(super) fn literal(&mut self) -> Parsed {
        let (items, span) = self.list(TokenKind::CloseSquare)?;
        let is_row = |item: &Operand| {
            self.text(&item.span).starts_with('[') && matches!(item.value_type, Type::Vector(_))
        };
        if !items.first().is_some_and(is_row) {
            return self.builder.vector(&items, span);
        }
        if let Some(wrong) = items.iter().find(|item| !is_row(item)) {
            let message =
                format!("a row of a matrix is written `[a,b,c]`, this is a {}", wrong.value_type);
            let help = "a matrix with the rows u, v, w is written `mat(u,v,w)`";
            return Err(FormulaError::new(wrong.span.clone(), message).with_help(help));
        }
        self.builder.rows(&items, span)
    }

    /// Reads `[i]` or `[i,j]` behind an operand; the span covers the brackets.
    pub(super) fn indices(&mut self) -> Result<(Vec<(i64, Span)>, Span), FormulaError> {
        let open = self.advance();
        let mut indices = Vec::new();
        loop {
            if self.peek() == TokenKind::End {
                return Err(self.unclosed(&open));
            }
            if matches!(self.peek(), TokenKind::CloseSquare | TokenKind::Comma) {
                let error = FormulaError::new(self.token().span.clone(), "an index is missing");
                return Err(error.with_help("write `γ[3]` or `B[1,2]`"));
            }
            indices.push(self.whole("an index")?);
            match self.peek() {
                TokenKind::Comma => self.advance(),
                TokenKind::CloseSquare => break,
                _ => return Err(self.unclosed(&open)),
            };
        }
        Ok((indices, open.start..self.advance().end))
    }
}

fn out_of_range(name: &str, base: &str, ty: Type, span: Span) -> FormulaError {
    let error = FormulaError::new(span, format!("there is no component `{name}`"));
    error.with_help(match ty {
        Type::Matrix(rows, columns) if rows.max(columns) > 9 => {
            format!("`{base}` has the entries {base}[1,1] to {base}[{rows},{columns}]")
        }
        Type::Matrix(rows, columns) => {
            format!("`{base}` has the entries {base}11 to {base}{rows}{columns}")
        }
        Type::Vector(length @ ..4) => {
            let names: Vec<String> = (1..=length).map(|i| format!("{base}{i}")).collect();
            format!("`{base}` has the components {}", names.join(", "))
        }
        other => format!("`{base}` has the components {base}1 to {base}{}", other.size()),
    })
}
