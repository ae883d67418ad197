//! The grammar: operator precedence over tokens, building typed nodes as it reads.
//!
//! Loosest first: `+ −`; `× ⊗`; `* · /`; prefix `−` and `√`; `^`, superscripts, `ᵀ`, indices.
//! Only brackets, prefixes and exponents nest, and no deeper than [`MAX_DEPTH`].

use super::arena::Arena;
use super::error::{FormulaError, Span};
use super::kind::Type;
use super::lexer::{Token, TokenKind, tokens};
use super::scope::Scope;
use super::typing::{Builder, Infix, Operand};

/// Limit on the nesting of brackets, prefixes and exponents.
const MAX_DEPTH: usize = 200;

/// Binding strengths of the infix operators.
pub(super) const SUM: u8 = 1;
const VECTOR_PRODUCT: u8 = 2;
const PRODUCT: u8 = 3;

/// State of reading one formula.
pub(super) struct Parser<'t> {
    pub(super) builder: Builder<'t>,
    pub(super) scope: &'t dyn Scope,
    tokens: Vec<Token>,
    pub(super) position: usize,
    depth: usize,
    /// Innermost open bracket or bar.
    innermost: Option<Span>,
    /// Whether it is a bar, so that the next bar closes it.
    inside_bars: bool,
    /// Indices of the enclosing forms, with their values.
    pub(super) bindings: Vec<(String, i64)>,
    /// Number of times an index of such a form was read.
    pub(super) indices_read: usize,
    /// Whether names are read as the whole numbers they stand for, as in indices.
    pub(super) whole_numbers: bool,
    /// Number of tokens read while indexed forms are written out.
    pub(super) written_out: usize,
}

pub(super) type Parsed = Result<Operand, FormulaError>;

/// Reads a whole formula; the last node of the arena is its value.
pub(super) fn parse(text: &str, scope: &dyn Scope) -> Result<Arena, FormulaError> {
    let mut parser = Parser::new(text, scope)?;
    parser.expression(SUM)?;
    match parser.peek() {
        TokenKind::End => Ok(parser.builder.arena),
        _ => Err(parser.unexpected_end()),
    }
}

/// Reads a whole number, in names whose values are known.
pub(super) fn whole_number(text: &str, scope: &dyn Scope) -> Result<i64, FormulaError> {
    let mut parser = Parser::new(text, scope)?;
    let (number, _) = parser.whole("this")?;
    match parser.peek() {
        TokenKind::End => Ok(number),
        _ => Err(parser.unexpected_end()),
    }
}

impl<'t> Parser<'t> {
    fn new(text: &'t str, scope: &'t dyn Scope) -> Result<Self, FormulaError> {
        let builder = Builder { arena: Arena::default(), text };
        let tokens = tokens(text)?;
        let parser = Self {
            builder,
            scope,
            tokens,
            position: 0,
            depth: 0,
            innermost: None,
            inside_bars: false,
            bindings: Vec::new(),
            indices_read: 0,
            whole_numbers: false,
            written_out: 0,
        };
        match parser.peek() {
            TokenKind::End => {
                let error = FormulaError::new(0..text.len(), "the formula is empty");
                Err(error.with_help("write a formula, such as `x² + y²`, or a number"))
            }
            _ => Ok(parser),
        }
    }

    pub(super) fn text(&self, span: &Span) -> &'t str {
        &self.builder.text[span.clone()]
    }

    pub(super) fn token(&self) -> &Token {
        // the End token is never passed
        &self.tokens[self.position.min(self.tokens.len() - 1)]
    }

    pub(super) fn peek(&self) -> TokenKind {
        self.token().kind
    }

    /// Kind of the token at a position.
    pub(super) fn kind(&self, place: usize) -> Option<TokenKind> {
        self.tokens.get(place).map(|token| token.kind)
    }

    /// Kind of the token `offset` places after the current one.
    pub(super) fn kind_at(&self, offset: usize) -> Option<TokenKind> {
        self.kind(self.position + offset)
    }

    pub(super) fn advance(&mut self) -> Span {
        let span = self.token().span.clone();
        self.position += 1;
        span
    }

    /// Reads one level of nesting, opened at `span`.
    fn nested(&mut self, span: &Span, read: impl FnOnce(&mut Self) -> Parsed) -> Parsed {
        if self.depth == MAX_DEPTH {
            let error = FormulaError::new(span.clone(), "this is nested too deeply");
            return Err(error.with_help(format!("at most {MAX_DEPTH} levels are allowed")));
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }

    /// Reads an expression between the bracket or bar opened at `span` and its partner.
    pub(super) fn enclosed(&mut self, span: &Span, bars: bool) -> Parsed {
        let outer_bars = std::mem::replace(&mut self.inside_bars, bars);
        let outer = self.innermost.replace(span.clone());
        let result = self.nested(span, |parser| parser.expression(SUM));
        (self.innermost, self.inside_bars) = (outer, outer_bars);
        result
    }

    /// Reads operands joined by operators that bind at least as tightly as `loosest`.
    pub(super) fn expression(&mut self, loosest: u8) -> Parsed {
        let mut left = self.prefix()?;
        while let Some((infix, level)) = infix(self.peek()).filter(|(_, level)| *level >= loosest) {
            self.advance();
            let right = self.expression(level + 1)?;
            let result = self.builder.infix(infix, &left, &right)?;
            if level == VECTOR_PRODUCT && matches!(self.peek(), TokenKind::Cross | TokenKind::Outer)
            {
                return Err(self.chained_products(&left, &right));
            }
            left = result;
        }
        Ok(left)
    }

    /// Reads `−a`, `√a`, `a^b`.
    fn prefix(&mut self) -> Parsed {
        let kind = self.peek();
        if !matches!(kind, TokenKind::Minus | TokenKind::Root) {
            return self.power();
        }
        let sign = self.advance();
        let operand = self.nested(&sign, Self::prefix)?;
        let span = sign.start..operand.span.end;
        match kind {
            TokenKind::Minus => Ok(self.builder.negate(&operand, span)),
            _ => self.builder.root(&operand, span),
        }
    }

    fn power(&mut self) -> Parsed {
        let base = self.postfix()?;
        if self.peek() != TokenKind::Caret {
            return Ok(base);
        }
        let caret = self.advance();
        let (start, indices) = (self.position, self.indices_read);
        let mut exponent = self.nested(&caret, Self::prefix)?;
        // a power of a scalar keeps the names in it, unless it contains an index
        let is_numbered = base.value_type != Type::Scalar || self.indices_read > indices;
        if self.builder.arena.constant(exponent.node).is_none()
            && is_numbered
            && let Some(number) = self.whole_again(start, &exponent)
        {
            exponent = number;
        }
        self.builder.power(&base, &exponent)
    }

    /// Reads an exponent again as a whole number, by the values of the names in it.
    fn whole_again(&mut self, start: usize, read: &Operand) -> Option<Operand> {
        if read.value_type != Type::Scalar || self.whole_numbers {
            return None;
        }
        let (end, nodes) = (self.position, self.builder.arena.nodes.len());
        let fixed = self.builder.arena.fixed.len();
        self.position = start;
        let outer = std::mem::replace(&mut self.whole_numbers, true);
        let again = self.prefix();
        self.whole_numbers = outer;
        self.position = end;
        let number = again.ok().filter(|again| self.builder.arena.constant(again.node).is_some());
        if number.is_none() {
            self.builder.arena.nodes.truncate(nodes);
            self.builder.arena.fixed.truncate(fixed);
        }
        number
    }

    /// Reads a primary with its superscripts, transposes and indices.
    fn postfix(&mut self) -> Parsed {
        let mut operand = self.primary()?;
        loop {
            operand = match self.peek() {
                TokenKind::Superscript => {
                    let exponent = self.advance();
                    let value = self.superscript(&exponent)?;
                    let span = operand.span.start..exponent.end;
                    self.builder.constant_power(&operand, &value, exponent, span)?
                }
                TokenKind::Transpose => {
                    let span = operand.span.start..self.advance().end;
                    self.builder.transpose(&operand, span)?
                }
                TokenKind::OpenSquare => {
                    let (indices, brackets) = self.indices()?;
                    self.builder.index(&operand, &indices, brackets)?
                }
                _ => break,
            };
        }
        if self.starts_operand() { Err(self.missing_times(&operand)) } else { Ok(operand) }
    }

    /// Reads a number, a name, or what stands in brackets or bars.
    pub(super) fn primary(&mut self) -> Parsed {
        match self.peek() {
            TokenKind::Number => self.number(),
            TokenKind::Name | TokenKind::Integral => self.name(),
            TokenKind::Open => self.group(),
            TokenKind::OpenSquare => self.literal(),
            TokenKind::Bar => self.bars(),
            _ => Err(self.missing_operand()),
        }
    }

    /// Reads `(a)` or `(a,b)`.
    fn group(&mut self) -> Parsed {
        let (items, span) = self.list(TokenKind::Close)?;
        match items.as_slice() {
            [inner] => {
                // the brackets belong to the text of their contents
                self.builder.arena.nodes[inner.node].span = span.clone();
                Ok(Operand { span, ..inner.clone() })
            }
            [a, b] => self.builder.dot(a, b, span),
            _ => {
                let error = FormulaError::new(span, "a dot product takes two vectors");
                Err(error.with_help("a vector is written `[a,b,c]`"))
            }
        }
    }

    /// Reads `|a|`.
    fn bars(&mut self) -> Parsed {
        let open = self.advance();
        let inner = self.enclosed(&open, true)?;
        if self.peek() != TokenKind::Bar {
            return Err(self.unclosed(&open));
        }
        let span = open.start..self.advance().end;
        self.builder.modulus(&inner, span)
    }

    /// Reads expressions between brackets, separated by commas; the span covers the brackets.
    pub(super) fn list(&mut self, close: TokenKind) -> Result<(Vec<Operand>, Span), FormulaError> {
        let open = self.advance();
        if self.peek() == close {
            let span = open.start..self.advance().end;
            let error = FormulaError::new(span, "there is nothing between these brackets");
            return Err(error.with_help("write a value between them, or remove them"));
        }
        let mut items = Vec::new();
        loop {
            items.push(self.enclosed(&open, false)?);
            match self.peek() {
                TokenKind::Comma => self.advance(),
                kind if kind == close => break,
                _ => return Err(self.unclosed(&open)),
            };
        }
        let span = open.start..self.advance().end;
        Ok((items, span))
    }

    /// Whether the next token begins an operand where an operator should stand.
    fn starts_operand(&self) -> bool {
        match self.peek() {
            TokenKind::Name => !self.is_modulo(),
            TokenKind::Number | TokenKind::Integral | TokenKind::Root | TokenKind::Open => true,
            TokenKind::Bar => !self.inside_bars,
            _ => false,
        }
    }

    /// Innermost open bracket, the place of an error where another token should have closed it.
    pub(super) fn innermost(&self) -> Option<Span> {
        self.innermost.clone()
    }

    /// Reads the next operand for use in a message.
    pub(super) fn attempt(&mut self) -> Parsed {
        self.nested(&self.token().span.clone(), Self::prefix)
    }
}

fn infix(kind: TokenKind) -> Option<(Infix, u8)> {
    Some(match kind {
        TokenKind::Plus => (Infix::Add, SUM),
        TokenKind::Minus => (Infix::Subtract, SUM),
        TokenKind::Cross => (Infix::Cross, VECTOR_PRODUCT),
        TokenKind::Outer => (Infix::Outer, VECTOR_PRODUCT),
        TokenKind::Times => (Infix::Multiply, PRODUCT),
        TokenKind::Slash => (Infix::Divide, PRODUCT),
        _ => return None,
    })
}
