//! Formulas made of others: operators, powers, vectors and calls.
//!
//! The text of the result is written with the brackets that it needs, and its tree is built by the
//! builder of the parser: reading the text in the same names gives the same tree.

use std::fmt;
use std::ops::{Add, Div, Mul, Range, Sub};

use super::Formula;
use super::arena::{Arena, NodeId, NodeOperation};
use super::bond::{Bond, bond, is_signed};
use super::error::{FormulaError, Span};
use super::kind::Type;
use super::scope::{Scope, Symbol};
use super::typing::{Builder, Built, Infix, Operand};
use crate::number::rational::Rational;

/// A formula made of others, or the reason why their types do not fit.
pub type FormulaResult = Result<Formula, FormulaError>;

/// Text and tree of a formula in the making.
#[derive(Default)]
pub(super) struct Draft {
    pub text: String,
    pub arena: Arena,
}

impl Draft {
    pub fn write(&mut self, text: &str) {
        self.text.push_str(text);
    }

    /// Appends a formula, in brackets if asked to.
    pub fn place(&mut self, formula: &Formula, in_brackets: bool) -> Operand {
        let first = self.text.len();
        self.write(if in_brackets { "(" } else { "" });
        let start = self.text.len();
        self.write(formula.written());
        self.write(if in_brackets { ")" } else { "" });
        let mut map = Vec::new();
        let nodes = 0..formula.arena.nodes.len();
        self.graft(formula, nodes, start, &mut map);
        let node = self.arena.nodes.len() - 1;
        let span = first..self.text.len();
        self.arena.nodes[node].span = span.clone();
        self.fix(formula);
        Operand { node, value_type: formula.value_type(), span }
    }

    /// Appends nodes of a formula whose text begins at `start`; `map` has the new places of those
    /// before them.
    fn graft(
        &mut self,
        formula: &Formula,
        nodes: Range<NodeId>,
        start: usize,
        map: &mut Vec<NodeId>,
    ) {
        let leading = formula.leading();
        for node in nodes {
            self.graft_node(formula, node, |place| (place + start).saturating_sub(leading), map);
        }
    }

    /// Appends a node, with the places of its text moved.
    fn graft_node(
        &mut self,
        formula: &Formula,
        node: NodeId,
        moved: impl Fn(usize) -> usize,
        map: &mut Vec<NodeId>,
    ) {
        let node = &formula.arena.nodes[node];
        let span = moved(node.span.start)..moved(node.span.end);
        map.push(match &node.operation {
            NodeOperation::Symbol(slot) => {
                let (symbol, kind) = formula.arena.symbols[*slot];
                let name = || formula.arena.names[*slot].clone();
                self.arena.push_symbol(symbol, kind, span, name)
            }
            other => self.arena.push(other.on(|own| map[own]), node.value_type, span),
        });
    }

    /// Appends all nodes of a formula but one, in whose place another stands, and whose text is cut
    /// off at its beginning.
    pub(super) fn graft_without(
        &mut self,
        formula: &Formula,
        left_out: NodeId,
        other: NodeId,
        cut: usize,
    ) {
        let mut map = Vec::new();
        for node in 0..formula.arena.nodes.len() {
            match node == left_out {
                true => map.push(map[other]),
                false => {
                    self.graft_node(formula, node, |place| place.saturating_sub(cut), &mut map);
                }
            }
        }
        self.fix(formula);
    }

    /// Takes over the symbols whose values are written into a formula.
    fn fix(&mut self, formula: &Formula) {
        for symbol in &formula.arena.fixed {
            if !self.arena.fixed.contains(symbol) {
                self.arena.fixed.push(*symbol);
            }
        }
    }

    /// Builds the last operation.
    pub fn build(self, build: impl FnOnce(&mut Builder<'_>) -> Built) -> FormulaResult {
        let Self { text, arena } = self;
        let mut builder = Builder { arena, text: &text };
        build(&mut builder)?;
        let arena = builder.arena;
        Ok(Formula { text, arena })
    }
}

impl Formula {
    /// Formula of a number.
    ///
    /// ```
    /// use liouville::formula::Formula;
    /// use liouville::number::rational::Rational;
    ///
    /// assert_eq!(Formula::number(Rational::new(-3, 4)).to_string(), "−3/4");
    /// ```
    pub fn number(value: impl Into<Rational>) -> Self {
        let value = value.into();
        let (above, below) = value.parts();
        let text = match below.to_string().as_str() {
            "1" => above.to_string(),
            below => format!("{above}/{below}"),
        };
        let text = text.replacen('-', "−", 1);
        let mut arena = Arena::default();
        arena.push(NodeOperation::Number(value), Type::Scalar, 0..text.len());
        Self { text, arena }
    }

    /// Formula of a symbol, written by its name.
    pub fn symbol(name: &str, symbol: Symbol, kind: Type) -> Self {
        let mut arena = Arena::default();
        arena.push_symbol(symbol, kind, 0..name.len(), || name.to_string());
        Self { text: name.to_string(), arena }
    }

    /// Formula of a name of the scope.
    pub fn name(name: &str, scope: &dyn Scope) -> FormulaResult {
        Self::parse(name, scope)
    }

    /// Text without spaces around it.
    pub(super) fn written(&self) -> &str {
        self.text.trim()
    }

    /// Bytes of white space before the text.
    pub(super) fn leading(&self) -> usize {
        self.text.len() - self.text.trim_start().len()
    }

    pub(super) fn bond(&self) -> Bond {
        bond(self.written())
    }

    /// Same formula with brackets around its text.
    #[must_use]
    pub fn bracketed(&self) -> Self {
        let mut draft = Draft::default();
        draft.place(self, true);
        Formula { text: draft.text, arena: draft.arena }
    }

    /// Same formula with brackets around its text unless it binds as tightly as a divisor has to.
    #[must_use]
    pub fn as_factor(&self) -> Self {
        if self.bond() < Bond::Prefix { self.bracketed() } else { self.clone() }
    }

    /// Joins two formulas, each in brackets unless it binds as tightly as is required.
    pub(super) fn joined(&self, infix: Infix, other: &Self) -> FormulaResult {
        let (sign, left, right) = match infix {
            Infix::Add => (" + ", Bond::Sum, Bond::Cross),
            Infix::Subtract => (" − ", Bond::Sum, Bond::Cross),
            Infix::Cross => (" × ", Bond::Product, Bond::Product),
            Infix::Outer => (" ⊗ ", Bond::Product, Bond::Product),
            Infix::Multiply => ("*", Bond::Product, Bond::Prefix),
            Infix::Divide => ("/", Bond::Product, Bond::Prefix),
        };
        let mut draft = Draft::default();
        let a = draft.place(self, self.bond() < left);
        draft.write(sign);
        let b = draft.place(other, other.bond() < right || is_signed(other.written()));
        draft.build(|builder| builder.infix(infix, &a, &b))
    }

    /// Product; a product on the right needs no brackets behind a scalar, since a(bc) = (ab)c.
    fn times(&self, other: &Self) -> FormulaResult {
        let is_row = self.value_type() == Type::Scalar && other.bond() == Bond::Product;
        // a number such as 1/2 is one factor, and m*1/2 has two
        let first = &other.arena.nodes[other.first_factor()];
        let is_fraction = matches!(first.operation, NodeOperation::Number(_))
            && other.text.get(first.span.clone()).is_some_and(|text| bond(text) == Bond::Product);
        let splits = is_fraction && self.constant().is_none();
        if !is_row || splits || is_signed(other.written()) {
            return self.joined(Infix::Multiply, other);
        }
        let mut draft = Draft::default();
        let factor = draft.place(self, self.bond() < Bond::Product);
        draft.write("*");
        draft.led(other, |builder, leaf| builder.infix(Infix::Multiply, &factor, leaf))
    }

    /// Power with a formula as its exponent.
    pub fn power(&self, exponent: &Formula) -> FormulaResult {
        let whole = exponent.constant().and_then(|value| value.to_integer()).map(i32::try_from);
        if let Some(Ok(whole @ 2..100)) = whole {
            return self.raised(whole);
        }
        let mut draft = Draft::default();
        let base = draft.place(self, self.bond() < Bond::Whole);
        draft.write("^");
        let exponent = draft.place(exponent, exponent.bond() < Bond::Whole);
        draft.build(|builder| builder.power(&base, &exponent))
    }

    /// Whole power, written above the line: `x²`, `A⁻¹`.
    pub fn raised(&self, exponent: i32) -> FormulaResult {
        let mut draft = Draft::default();
        let base = draft.place(self, self.bond() < Bond::Whole);
        let start = draft.text.len();
        draft.write(&superscript(exponent));
        let end = draft.text.len();
        let value = Rational::from(i64::from(exponent));
        draft.build(|builder| {
            builder.constant_power(&base, &value, start..end, base.span.start..end)
        })
    }

    /// Writes parts between brackets, and builds the operation on them.
    pub(super) fn listed(
        open: &str,
        between: &str,
        parts: &[&Formula],
        close: &str,
        build: impl FnOnce(&mut Builder<'_>, &[Operand], Span) -> Built,
    ) -> FormulaResult {
        let mut draft = Draft::default();
        draft.write(open);
        let mut operands = Vec::new();
        for (k, part) in parts.iter().enumerate() {
            draft.write(if k == 0 { "" } else { between });
            operands.push(draft.place(part, false));
        }
        draft.write(close);
        let span = 0..draft.text.len();
        if operands.is_empty() {
            let error = FormulaError::new(span, "there is nothing between these brackets");
            return Err(error.with_help("write a value between them, or remove them"));
        }
        draft.build(|builder| build(builder, &operands, span))
    }
}

impl Draft {
    /// Appends a product whose first factor is changed by `lead`, which sees what was written
    /// before.
    pub(super) fn led(
        mut self,
        product: &Formula,
        lead: impl FnOnce(&mut Builder<'_>, &Operand) -> Built,
    ) -> FormulaResult {
        let start = self.text.len();
        self.write(product.written());
        let first = product.first_factor();
        let mut map = Vec::new();
        self.graft(product, 0..first + 1, start, &mut map);
        let node = map[first];
        let leaf = Operand {
            node,
            value_type: self.arena.nodes[node].value_type,
            span: self.arena.nodes[node].span.clone(),
        };
        let Self { text, arena } = self;
        let mut builder = Builder { arena, text: &text };
        map[first] = lead(&mut builder, &leaf)?.node;
        let arena = builder.arena;
        let mut draft = Self { text, arena };
        let rest = draft.arena.nodes.len();
        draft.graft(product, first + 1..product.arena.nodes.len(), start, &mut map);
        // the products now begin with what leads them
        for node in &mut draft.arena.nodes[rest..] {
            if node.span.start == start {
                node.span.start = 0;
            }
        }
        draft.fix(product);
        Ok(Formula { text: draft.text, arena: draft.arena })
    }
}

/// A whole exponent behind its base: x², and x^100 where it is long.
pub fn exponent_text(number: i64) -> String {
    match i32::try_from(number) {
        Ok(short) if (0..100).contains(&short) => superscript(short),
        _ => format!("^{number}"),
    }
}

/// Number in superscript digits.
fn superscript(number: i32) -> String {
    let above = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => digit.to_digit(10).and_then(|d| char::from_u32('⁰' as u32 + d)).unwrap_or(digit),
    };
    number.to_string().chars().map(above).collect()
}

impl fmt::Display for Formula {
    /// Writes the text, which reads as the same formula in the same names.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.written())
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident = $make:expr;)*) => {$(
        impl $trait<&Formula> for &Formula {
            type Output = FormulaResult;

            /// Fails where the types of the two formulas do not fit.
            fn $method(self, other: &Formula) -> FormulaResult {
                let make: fn(&Formula, &Formula) -> FormulaResult = $make;
                make(self, other)
            }
        }

        impl $trait<&Formula> for FormulaResult {
            type Output = FormulaResult;

            fn $method(self, other: &Formula) -> FormulaResult {
                self?.$method(other)
            }
        }

        impl $trait<&Formula> for Formula {
            type Output = FormulaResult;

            fn $method(self, other: &Formula) -> FormulaResult {
                (&self).$method(other)
            }
        }

        impl $trait<Formula> for &Formula {
            type Output = FormulaResult;

            fn $method(self, other: Formula) -> FormulaResult {
                self.$method(&other)
            }
        }

        impl $trait<Formula> for Formula {
            type Output = FormulaResult;

            fn $method(self, other: Formula) -> FormulaResult {
                (&self).$method(&other)
            }
        }
    )*};
}

operators! {
    Add add = |a, b| a.joined(Infix::Add, b);
    Sub sub = |a, b| a.joined(Infix::Subtract, b);
    Mul mul = |a, b| a.times(b);
    Div div = |a, b| a.joined(Infix::Divide, b);
}
