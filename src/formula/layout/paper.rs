//! Boxes of the tree of a formula.

use super::Layout;
use super::chains::Chains;
use crate::formula::arena::{Arena, Constant, ElementaryFunction, Extreme, NodeId, NodeOperation};
use crate::formula::kind::Type;
use crate::formula::scope::Symbol;
use crate::number::rational::Rational;

/// Strength with which a box holds together; one looser than its place requires gets brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum BoxStrength {
    Sum,
    Cross,
    Product,
    Power,
    Whole,
}

impl BoxStrength {
    /// Strength of the right side of a chain of this one.
    pub(super) fn tighter(self) -> Self {
        match self {
            BoxStrength::Sum => BoxStrength::Cross,
            BoxStrength::Cross => BoxStrength::Product,
            _ => BoxStrength::Power,
        }
    }
}

pub(super) type Bonded = (Layout, BoxStrength);

pub(super) struct Paper<'f> {
    pub(super) arena: &'f Arena,
    pub(super) chains: Chains,
    names: &'f dyn Fn(Symbol) -> String,
}

/// Sets the whole formula in a place that requires this bond.
pub(super) fn set(arena: &Arena, names: &dyn Fn(Symbol) -> String, least: BoxStrength) -> Layout {
    let paper = Paper { arena, chains: Chains::new(arena), names };
    paper.at(arena.nodes.len() - 1, least, false)
}

impl Paper<'_> {
    /// Sets a node; `inline` where fractions would be too high.
    fn set(&self, node: NodeId, inline: bool) -> Bonded {
        let Some(_level) = self.chains.enter() else {
            return (Layout::Sign("…"), BoxStrength::Whole);
        };
        self.abridged(node, inline).unwrap_or_else(|| self.whole(node, inline))
    }

    /// Sets a node with all its operands.
    fn whole(&self, node: NodeId, inline: bool) -> Bonded {
        use NodeOperation::*;
        let whole = |layout| (layout, BoxStrength::Whole);
        match &self.arena.nodes[node].operation {
            Number(value) => number(value, inline),
            Constant(value) => whole(Layout::name(letter(*value), Type::Scalar)),
            Symbol(slot) => whole(self.symbol(*slot)),
            Identity => whole(Layout::name("E", Type::MATRIX)),
            Zero => whole(digits("0")),
            Negate(a) => {
                let positive = self.at(*a, BoxStrength::Product, inline);
                (Layout::Row(vec![Layout::Sign("−"), positive]), BoxStrength::Sum)
            }
            Add(a, b) => self.between(*a, "+", *b, BoxStrength::Sum, inline),
            Subtract(a, b) => self.between(*a, "−", *b, BoxStrength::Sum, inline),
            Cross(a, b) => self.between(*a, "×", *b, BoxStrength::Cross, inline),
            Outer(a, b) => self.between(*a, "⊗", *b, BoxStrength::Cross, inline),
            Multiply(a, b) | Scale(a, b) | Apply(a, b) | Compose(a, b) => {
                self.product(*a, *b, inline)
            }
            Divide(a, b) if inline => self.between(*a, "/", *b, BoxStrength::Product, inline),
            Divide(a, b) => self.fraction(*a, *b),
            Dot(a, b) if a == b => self.raised(*a, digits("2"), inline),
            Dot(a, b) => {
                let parts = vec![self.set(*a, inline).0, Layout::Sign(","), self.set(*b, inline).0];
                whole(Layout::Row(parts).fenced())
            }
            Power(a, exponent) => self.raised(*a, number(exponent, true).0, inline),
            PowerOf(a, b) => self.raised(*a, self.set(*b, true).0, inline),
            MatrixPower(a, n) => self.raised(*a, digits(&n.to_string()), inline),
            Inverse(a) => (self.inverse(*a, inline), BoxStrength::Power),
            Transpose(a) => self.raised(*a, Layout::Word("T"), inline),
            Solve(a, b) => {
                let parts = vec![
                    self.inverse(*a, inline),
                    Layout::Space,
                    self.at(*b, BoxStrength::Product, inline),
                ];
                (Layout::Row(parts), BoxStrength::Product)
            }
            Component(a, i) | Row(a, i) => whole(self.indexed(*a, (i + 1).to_string(), inline)),
            Entry(a, i, j) if i == j => whole(self.indexed(*a, (i + 1).to_string(), inline)),
            Entry(a, i, j) => {
                let comma = if *i.max(j) < 9 { "" } else { "," };
                whole(self.indexed(*a, format!("{}{comma}{}", i + 1, j + 1), inline))
            }
            Adjugate(a) => self.applied("adj", *a, inline),
            Determinant(a) => self.applied("det", *a, inline),
            Trace(a) => self.applied("tr", *a, inline),
            Diagonal(a) => self.applied("diag", *a, inline),
            Sum(terms) => self.chain(terms, Some("+"), BoxStrength::Sum, inline),
            Product(factors) => self.chain(factors, None, BoxStrength::Product, inline),
            Vector(parts) => whole(self.list(parts, inline)),
            Rows(rows) => whole(self.matrix(rows, inline)),
            Function(function, a) => self.function(*function, *a, inline),
            Angle(y, x) => self.called("atan2", &[*y, *x], inline),
            Extreme(which, all) => self.called(which_word(*which), all, inline),
            Partial { of, by, .. } => self.partial(*of, *by, inline),
            Antiderivative(f, x) => {
                let parts = vec![
                    Layout::Sign("∫"),
                    self.at(*f, BoxStrength::Product, inline),
                    Layout::Space,
                    Layout::Word("d"),
                    self.at(*x, BoxStrength::Whole, inline),
                ];
                (Layout::Row(parts), BoxStrength::Product)
            }
        }
    }

    /// Sets a fraction, with a minus of the numerator before it.
    fn fraction(&self, above: NodeId, below: NodeId) -> Bonded {
        let below = Box::new(self.set(below, false).0);
        match without_minus(self.set(above, false).0) {
            Ok(above) => {
                let fraction = Layout::Fraction(Box::new(above), below);
                (Layout::Row(vec![Layout::Sign("−"), fraction]), BoxStrength::Sum)
            }
            Err(above) => (Layout::Fraction(Box::new(above), below), BoxStrength::Power),
        }
    }

    /// Sets a power, or what is written like one.
    fn raised(&self, base: NodeId, exponent: Layout, inline: bool) -> Bonded {
        (self.at(base, BoxStrength::Whole, inline).raised(exponent), BoxStrength::Power)
    }

    /// Sets a partial derivative.
    fn partial(&self, of: NodeId, by: NodeId, inline: bool) -> Bonded {
        let part =
            |node| Layout::Row(vec![Layout::Sign("∂"), self.at(node, BoxStrength::Whole, inline)]);
        let (above, below) = (part(of), part(by));
        match inline {
            true => (Layout::Row(vec![above, Layout::Sign("/"), below]), BoxStrength::Product),
            false => (Layout::Fraction(Box::new(above), Box::new(below)), BoxStrength::Power),
        }
    }

    /// Sets a node in a place that requires this bond.
    pub(super) fn at(&self, node: NodeId, least: BoxStrength, inline: bool) -> Layout {
        match self.set(node, inline) {
            (layout, bond) if bond >= least => layout,
            (layout, _) => layout.fenced(),
        }
    }

    fn symbol(&self, slot: usize) -> Layout {
        let (symbol, kind) = self.arena.symbols[slot];
        Layout::name(&(self.names)(symbol), kind)
    }

    /// Sets `a sign b`; the right side holds together more tightly than the whole.
    fn between(
        &self,
        a: NodeId,
        sign: &'static str,
        b: NodeId,
        bond: BoxStrength,
        inline: bool,
    ) -> Bonded {
        let tighter = bond.tighter();
        // A row of vector products needs brackets.
        let left = if bond == BoxStrength::Cross { tighter } else { bond };
        let parts = vec![self.at(a, left, inline), Layout::Sign(sign), self.at(b, tighter, inline)];
        (Layout::Row(parts), bond)
    }

    fn product(&self, a: NodeId, b: NodeId, inline: bool) -> Bonded {
        let right = self.at(b, BoxStrength::Product, inline);
        let sign = match starts_with_digit(&right) {
            true => Layout::Sign("·"),
            false => Layout::Space,
        };
        // (−a) b is written −a b.
        let (left, bond) = self.set(a, inline);
        match without_minus(left) {
            Ok(left) => {
                let product = Layout::Row(vec![left, sign, right]);
                (Layout::Row(vec![Layout::Sign("−"), product]), BoxStrength::Sum)
            }
            Err(left) => {
                let left = if bond >= BoxStrength::Product { left } else { left.fenced() };
                (Layout::Row(vec![left, sign, right]), BoxStrength::Product)
            }
        }
    }

    fn inverse(&self, a: NodeId, inline: bool) -> Layout {
        let minus_one = Layout::Row(vec![Layout::Sign("−"), digits("1")]);
        self.at(a, BoxStrength::Whole, inline).raised(minus_one)
    }

    /// Sets `det A`, with brackets unless A is one letter, or its power.
    fn applied(&self, word: &'static str, a: NodeId, inline: bool) -> Bonded {
        let argument = self.at(a, BoxStrength::Power, inline);
        (Layout::Row(vec![Layout::Word(word), Layout::Space, argument]), BoxStrength::Power)
    }

    /// Sets a call such as `max(a,b)`.
    fn called(&self, word: &'static str, arguments: &[NodeId], inline: bool) -> Bonded {
        (Layout::Row(vec![Layout::Word(word), self.list(arguments, inline)]), BoxStrength::Power)
    }

    fn indexed(&self, a: NodeId, digits: String, inline: bool) -> Layout {
        if let NodeOperation::Symbol(slot) = self.arena.nodes[a].operation
            && let Layout::Name { letter, index, primes, .. } = self.symbol(slot)
        {
            let index = if index.is_empty() { digits } else { format!("{index},{digits}") };
            return Layout::Name { letter, kind: Type::Scalar, index, primes };
        }
        let base = Box::new(self.at(a, BoxStrength::Whole, inline));
        Layout::Lowered(base, Box::new(Layout::Number(digits)))
    }

    fn list(&self, parts: &[NodeId], inline: bool) -> Layout {
        let mut row = Vec::new();
        for part in shown(parts) {
            if !row.is_empty() {
                row.push(Layout::Sign(","));
            }
            row.push(part.map_or(Layout::Sign("…"), |part| self.set(*part, inline).0));
        }
        Layout::Row(row).fenced()
    }

    fn matrix(&self, rows: &[NodeId], inline: bool) -> Layout {
        let lines: Vec<Option<Vec<Layout>>> =
            shown(rows).into_iter().map(|row| row.map(|row| self.row(*row, inline))).collect();
        let width = lines.iter().flatten().map(Vec::len).max().unwrap_or(1);
        let dots = || vec![Layout::Sign("…"); width];
        Layout::Matrix(lines.into_iter().map(|line| line.unwrap_or_else(dots)).collect())
    }

    fn row(&self, node: NodeId, inline: bool) -> Vec<Layout> {
        match &self.arena.nodes[node].operation {
            NodeOperation::Vector(parts) => shown(parts)
                .into_iter()
                .map(|part| part.map_or(Layout::Sign("…"), |part| self.set(*part, inline).0))
                .collect(),
            _ => vec![self.set(node, inline).0],
        }
    }

    /// Sets terms or factors in a row, leaving out those in the middle of a long one.
    fn chain(
        &self,
        parts: &[NodeId],
        sign: Option<&'static str>,
        bond: BoxStrength,
        inline: bool,
    ) -> Bonded {
        if let [only] = parts {
            return self.set(*only, inline);
        }
        let mut row = Vec::new();
        for part in shown(parts) {
            if !row.is_empty() {
                row.push(sign.map_or(Layout::Space, Layout::Sign));
            }
            let tighter =
                if bond == BoxStrength::Sum { BoxStrength::Cross } else { BoxStrength::Power };
            row.push(part.map_or(Layout::Sign("…"), |part| self.at(*part, tighter, inline)));
        }
        (Layout::Row(row), bond)
    }

    fn function(&self, function: ElementaryFunction, a: NodeId, inline: bool) -> Bonded {
        let bars = |layout| (Layout::Fenced("|", Box::new(layout), "|"), BoxStrength::Whole);
        let word = match function {
            ElementaryFunction::Modulus => return bars(self.set(a, inline).0),
            ElementaryFunction::Sqrt => {
                // |v| is read as √(v,v)
                return match self.arena.nodes[a].operation {
                    NodeOperation::Dot(x, y) if x == y => bars(self.set(x, inline).0),
                    _ => (Layout::Root(Box::new(self.set(a, inline).0)), BoxStrength::Power),
                };
            }
            ElementaryFunction::Exp => "exp",
            ElementaryFunction::Ln => "ln",
            ElementaryFunction::Sin => "sin",
            ElementaryFunction::Cos => "cos",
            ElementaryFunction::Tan => "tan",
            ElementaryFunction::Asin => "arcsin",
            ElementaryFunction::Acos => "arccos",
            ElementaryFunction::Atan => "arctan",
            ElementaryFunction::Sinh => "sinh",
            ElementaryFunction::Cosh => "cosh",
            ElementaryFunction::Tanh => "tanh",
            ElementaryFunction::Asinh => "arsinh",
            ElementaryFunction::Acosh => "arcosh",
            ElementaryFunction::Atanh => "artanh",
            ElementaryFunction::Sign => "sgn",
        };
        let argument = self.set(a, inline).0.fenced();
        (Layout::Row(vec![Layout::Word(word), argument]), BoxStrength::Power)
    }
}

/// Number of parts above which a list, a sum or a matrix is abridged.
pub(super) const MOST_SHOWN: usize = 6;

/// Parts to show: all, or the first two and the last, with a gap between.
fn shown(parts: &[NodeId]) -> Vec<Option<&NodeId>> {
    match parts {
        [first, second, .., last] if parts.len() > MOST_SHOWN => {
            vec![Some(first), Some(second), None, Some(last)]
        }
        _ => parts.iter().map(Some).collect(),
    }
}

fn letter(constant: Constant) -> &'static str {
    match constant {
        Constant::Pi => "π",
        Constant::Euler => "e",
    }
}

fn which_word(which: Extreme) -> &'static str {
    match which {
        Extreme::Least => "min",
        Extreme::Greatest => "max",
    }
}

fn digits(text: &str) -> Layout {
    Layout::Number(text.to_string())
}

/// Sets a number, its sign before it, a fraction in line or stacked.
fn number(value: &Rational, inline: bool) -> Bonded {
    let (above, below) = value.parts();
    let (above, below) = (above.magnitude().to_string(), below.to_string());
    let (layout, bond) = match below.as_str() {
        "1" => (digits(&above), BoxStrength::Whole),
        _ if inline => {
            let parts = vec![digits(&above), Layout::Sign("/"), digits(&below)];
            (Layout::Row(parts), BoxStrength::Product)
        }
        _ => (
            Layout::Fraction(Box::new(digits(&above)), Box::new(digits(&below))),
            BoxStrength::Power,
        ),
    };
    match value.is_negative() {
        true => (Layout::Row(vec![Layout::Sign("−"), layout]), BoxStrength::Sum),
        false => (layout, bond),
    }
}

/// Removes a leading minus sign; `Err` with the box itself if there is none.
pub(super) fn without_minus(layout: Layout) -> Result<Layout, Layout> {
    match layout {
        Layout::Row(mut parts) if parts.len() == 2 && parts[0] == Layout::Sign("−") => {
            Ok(parts.swap_remove(1))
        }
        other => Err(other),
    }
}

fn starts_with_digit(layout: &Layout) -> bool {
    match layout {
        Layout::Number(_) => true,
        Layout::Fraction(above, _) => starts_with_digit(above),
        Layout::Raised(base, _) => starts_with_digit(base),
        Layout::Row(parts) => parts.first().is_some_and(starts_with_digit),
        _ => false,
    }
}
