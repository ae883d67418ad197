//! Sums, products, vectors and matrices with an index: `sum(i, 1..n, m[i]*|v[i]|²)`.
//!
//! Such a form is written out as it is read: its body is read once for each value of its indices,
//! which are numbers there. Bounds, conditions and indices are whole numbers that the file fixes.
//!
//! | written | meaning |
//! |---|---|
//! | `sum(i, 1..n, a[i])`, `product(i, 1..n, a[i])` | over all i; of no terms 0 and 1 |
//! | `sum(i, 1..n, j, i+1..n, …)` | over pairs; an index may stand in the bounds of those after it |
//! | `sum(j, 1..n, j ≠ i, …)` | only where all conditions hold |
//! | `vector(i, 1..n, a[i])`, `matrix(i, 1..n, j, 1..n, a[i]*b[j])` | by components, by entries |
//! | `matrix(i, 1..n, v)` | by rows |
//! | `if(i = j, a, b)` | `a` where the condition holds, `b` elsewhere |
//! | `E(n)`, `zero(n)`, `zero(n, m)` | the unit matrix, a vector and a matrix of zeros |
//! | `x[i+1 mod n]` | counted around: 1 follows on n |

use super::arena::NodeOperation;
use super::error::{FormulaError, Span};
use super::kind::Type;
use super::lexer::TokenKind;
use super::names::canonical_name;
use super::parser::{Parsed, Parser};
use super::partial;
use super::typing::Operand;

/// Limit on the tokens read while indexed forms are written out.
const MOST_TOKENS: usize = 1_000_000;

/// Limit on the indices of a form.
const MOST_INDICES: usize = 6;

/// Names of the forms that bind indices, and of the condition.
const FORMS: [&str; 5] = ["sum", "product", "vector", "matrix", "if"];

/// Whether this is the name of a form with indices, or of one that takes whole numbers.
pub(super) fn is_form(name: &str) -> bool {
    FORMS.contains(&name) || name == "zero"
}

/// Names of all such forms.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    FORMS.into_iter().chain(["zero", partial::CALL])
}

/// Syntax of a form, for help.
pub(super) fn usage(name: &str) -> &'static str {
    match name {
        "sum" => "write `sum(i, 1..n, a[i])`",
        "product" => "write `product(i, 1..n, a[i])`",
        "vector" => "write `vector(i, 1..n, a[i])`, or `[a,b,c]` for a list of components",
        "matrix" => {
            "write `matrix(i, 1..n, j, 1..n, a[i]*b[j])`, or `mat(u,v,w)` for a list of rows"
        }
        "if" => "write `if(i = j, a, b)`, with whole numbers i and j",
        _ => "write `zero(4)` for a vector, `zero(4,4)` for a matrix",
    }
}

/// Index of a form with its range.
struct Index {
    name: String,
    /// Position of the token at which the range begins.
    range: usize,
}

/// Head of a form: its indices, its conditions, and the positions of its body's ends.
struct Head {
    indices: Vec<Index>,
    conditions: Vec<usize>,
    body: usize,
    /// Position of the token behind the body.
    end: usize,
}

/// Value of the body for one choice of the indices.
pub(super) struct Term {
    pub operand: Operand,
    /// Whether it is the first for a new value of the first index.
    pub opens_row: bool,
}

impl<'t> Parser<'t> {
    /// Reads one of the forms `name(…)`; the name has been read.
    pub(super) fn form(&mut self, name: &str, span: Span) -> Parsed {
        if self.peek() != TokenKind::Open {
            let error = FormulaError::new(span, format!("`{name}` is written with brackets"));
            return Err(error.with_help(usage(name)));
        }
        match name {
            "if" => self.choice(span),
            "zero" => {
                let (sizes, brackets) = self.sizes()?;
                let span = span.start..brackets.end;
                let kind = match sizes[..] {
                    [n] => Type::Vector(n),
                    [n, m] => Type::Matrix(n, m),
                    _ => return Err(FormulaError::new(span, "`zero` takes one size or two")),
                };
                self.builder.push_sized(NodeOperation::Zero, kind, span)
            }
            _ => self.indexed(name, span),
        }
    }

    /// Reads the sizes in brackets of a unit matrix `E(n)`; the name has been read.
    pub(super) fn unit_matrix(&mut self, span: Span) -> Parsed {
        let (sizes, brackets) = self.sizes()?;
        let span = span.start..brackets.end;
        match sizes[..] {
            [n] => self.builder.push_sized(NodeOperation::Identity, Type::Matrix(n, n), span),
            _ => Err(FormulaError::new(span, "a unit matrix has one size")
                .with_help("write `E(4)`; `E` alone has 3 rows")),
        }
    }

    fn sizes(&mut self) -> Result<(Vec<usize>, Span), FormulaError> {
        let open = self.advance();
        let mut sizes = Vec::new();
        loop {
            let (size, place) = self.whole("a size")?;
            let size = usize::try_from(size).ok().filter(|size| *size > 0).ok_or_else(|| {
                FormulaError::new(place, format!("a size is positive, this is {size}"))
            })?;
            sizes.push(size);
            match self.peek() {
                TokenKind::Comma => self.advance(),
                TokenKind::Close => break,
                _ => return Err(self.unclosed(&open)),
            };
        }
        Ok((sizes, open.start..self.advance().end))
    }

    /// Reads a form with indices; the name has been read.
    fn indexed(&mut self, name: &str, span: Span) -> Parsed {
        let open = self.token().span.clone();
        let head = self.head(name)?;
        let mut terms: Vec<Term> = Vec::new();
        self.fill(&head, 0, &mut terms, &open)?;
        self.position = head.end;
        if self.peek() != TokenKind::Close {
            return Err(self.unclosed(&open));
        }
        let span = span.start..self.advance().end;
        self.builder.assemble(name, terms, head.indices.len(), span)
    }

    /// Reads the indices and skips the conditions, up to the body.
    fn head(&mut self, name: &str) -> Result<Head, FormulaError> {
        self.advance();
        let mut head = Head { indices: Vec::new(), conditions: Vec::new(), body: 0, end: 0 };
        loop {
            let at_name =
                self.peek() == TokenKind::Name && self.kind_at(1) == Some(TokenKind::Comma);
            if !at_name && head.indices.is_empty() {
                let place = self.token().span.clone();
                let message = "an index and its range are missing here";
                return Err(FormulaError::new(place, message).with_help(usage(name)));
            }
            if !at_name {
                break;
            }
            let place = self.advance();
            let index = canonical_name(self.text(&place)).unwrap_or_default();
            self.advance();
            let range = self.position;
            if !self.passes(TokenKind::Range) {
                let message = format!("the range of `{index}` is missing here");
                let place = self.token().span.clone();
                return Err(FormulaError::new(place, message).with_help(usage(name)));
            }
            if head.indices.len() == MOST_INDICES {
                let message = format!("`{name}` has more than {MOST_INDICES} indices");
                return Err(FormulaError::new(place, message));
            }
            head.indices.push(Index { name: index, range });
            self.next_argument(name)?;
        }
        while self.passes(TokenKind::Comparison) {
            head.conditions.push(self.position);
            self.next_argument(name)?;
        }
        head.body = self.position;
        head.end = self.closing(head.body);
        Ok(head)
    }

    /// Whether a token of this kind occurs in the argument that begins here.
    fn passes(&self, kind: TokenKind) -> bool {
        self.argument(self.position).any(|(_, found)| found == kind)
    }

    /// Tokens of the argument that begins at a token, without those in inner brackets.
    fn argument(&self, from: usize) -> impl Iterator<Item = (usize, TokenKind)> {
        let mut depth = 0usize;
        let ends = move |kind: TokenKind| {
            match kind {
                TokenKind::Open | TokenKind::OpenSquare => depth += 1,
                TokenKind::Close | TokenKind::CloseSquare if depth == 0 => return None,
                TokenKind::Close | TokenKind::CloseSquare => depth -= 1,
                TokenKind::Comma if depth == 0 => return None,
                TokenKind::End => return None,
                _ => {}
            }
            Some(depth)
        };
        let mut ends = ends;
        (from..)
            .map_while(move |place| {
                let kind = self.kind(place)?;
                let depth = ends(kind)?;
                Some((depth, place, kind))
            })
            .filter(|(depth, _, _)| *depth == 0)
            .map(|(_, place, kind)| (place, kind))
    }

    /// Position of the token behind the argument that begins at a token.
    fn closing(&self, from: usize) -> usize {
        let mut depth = 0usize;
        let mut place = from;
        loop {
            match self.kind(place) {
                Some(TokenKind::Open | TokenKind::OpenSquare) => depth += 1,
                Some(TokenKind::Close | TokenKind::CloseSquare) if depth > 0 => depth -= 1,
                Some(TokenKind::Close | TokenKind::CloseSquare | TokenKind::End) | None => {
                    return place;
                }
                Some(TokenKind::Comma) if depth == 0 => return place,
                _ => {}
            }
            place += 1;
        }
    }

    /// Skips to the next argument.
    fn next_argument(&mut self, name: &str) -> Result<(), FormulaError> {
        self.position = self.closing(self.position);
        if self.peek() != TokenKind::Comma {
            let place = self.token().span.clone();
            let error = FormulaError::new(place, format!("`{name}` has no body"));
            return Err(error.with_help(usage(name)));
        }
        self.advance();
        Ok(())
    }

    /// Gives the index at `level` and those after it their values, and reads the body for each.
    fn fill(
        &mut self,
        head: &Head,
        level: usize,
        terms: &mut Vec<Term>,
        open: &Span,
    ) -> Result<(), FormulaError> {
        let Some(index) = head.indices.get(level) else {
            self.count(head.body - head.conditions.first().unwrap_or(&head.body), open)?;
            if self.conditions_hold(head)? {
                self.count(head.end - head.body, open)?;
                self.position = head.body;
                let operand = self.enclosed(open, false)?;
                if self.position != head.end {
                    return Err(self.unclosed(open));
                }
                terms.push(Term { operand, opens_row: false });
            }
            return Ok(());
        };
        self.position = index.range;
        let (low, _) = self.whole("a bound")?;
        if self.peek() != TokenKind::Range {
            let place = self.token().span.clone();
            return Err(FormulaError::new(place, "a range is written `1..n`"));
        }
        self.advance();
        let (high, _) = self.whole("a bound")?;
        if self.peek() != TokenKind::Comma {
            return Err(FormulaError::new(self.token().span.clone(), "a range is written `1..n`"));
        }
        self.count(self.position - index.range, open)?;
        for value in low..=high {
            let first = terms.len();
            self.count(1, open)?;
            self.bindings.push((index.name.clone(), value));
            let filled = self.fill(head, level + 1, terms, open);
            self.bindings.pop();
            filled?;
            if let Some(term) = terms.get_mut(first).filter(|_| level == 0) {
                term.opens_row = true;
            }
        }
        Ok(())
    }

    fn conditions_hold(&mut self, head: &Head) -> Result<bool, FormulaError> {
        for place in &head.conditions {
            self.position = *place;
            if !self.condition()? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Reads `if(condition, a, b)`; the name has been read.
    fn choice(&mut self, span: Span) -> Parsed {
        let open = self.advance();
        let holds = self.condition()?;
        if self.peek() != TokenKind::Comma {
            return Err(self.unclosed(&open));
        }
        self.advance();
        let first = self.position;
        self.next_argument("if")?;
        let second = self.position;
        let end = self.closing(second);
        self.count(end - first, &open)?;
        self.position = if holds { first } else { second };
        let chosen = self.enclosed(&open, false)?;
        let behind = if holds { second - 1 } else { end };
        if self.position != behind || self.kind(end) != Some(TokenKind::Close) {
            return Err(self.unclosed(&open));
        }
        self.position = end;
        let span = span.start..self.advance().end;
        Ok(Operand { span, ..chosen })
    }

    /// Counts the tokens read while forms are written out, up to the limit.
    fn count(&mut self, tokens: usize, open: &Span) -> Result<(), FormulaError> {
        self.written_out += tokens.max(1);
        if self.written_out <= MOST_TOKENS {
            return Ok(());
        }
        let error = FormulaError::new(open.clone(), "this has too many terms when expanded");
        Err(error.with_help(format!("at most {MOST_TOKENS} numbers, names and signs are allowed")))
    }
}
