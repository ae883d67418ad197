//! Layout of a formula on paper: boxes made from its tree, for any typesetter.
//!
//! Brackets appear where the tree needs them; factors stand next to each other; quotients are
//! stacked, and set in line within exponents.

mod chains;
mod paper;

use super::Formula;
use super::kind::Type;
use super::scope::Symbol;
use paper::BoxStrength;

/// A box on paper.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Layout {
    /// Digits, without a sign.
    Number(String),
    /// Name: letter, type, index, and number of primes.
    Name {
        /// One letter, perhaps with an accent, or a word.
        letter: String,
        /// Type of the value; vectors and matrices are set bold.
        kind: Type,
        /// Index; empty where there is none.
        index: String,
        /// Number of primes.
        primes: usize,
    },
    /// Name of a function, set upright.
    Word(&'static str),
    /// Sign between or before others.
    Sign(&'static str),
    /// Small space of a product.
    Space,
    /// Boxes in a row.
    Row(Vec<Layout>),
    /// Box between brackets or bars.
    Fenced(&'static str, Box<Layout>, &'static str),
    /// Numerator over denominator.
    Fraction(Box<Layout>, Box<Layout>),
    /// Box under a root sign.
    Root(Box<Layout>),
    /// Base with an exponent.
    Raised(Box<Layout>, Box<Layout>),
    /// Base with an index.
    Lowered(Box<Layout>, Box<Layout>),
    /// Rows of a matrix.
    Matrix(Vec<Vec<Layout>>),
}

impl Layout {
    /// The box of a name.
    pub fn name(text: &str, kind: Type) -> Self {
        let bare = text.trim_end_matches('\'');
        let primes = text.len() - bare.len();
        let (letter, index) = match bare.split_once('_') {
            Some((letter, index)) => (letter, index),
            None => bare.split_at(bare.trim_end_matches(|c: char| c.is_ascii_digit()).len()),
        };
        let (letter, index) = (letter.to_string(), index.to_string());
        Layout::Name { letter, kind, index, primes }
    }

    /// The box of an equation, left = right.
    pub fn equation(left: Layout, right: Layout) -> Self {
        Layout::Row(vec![left, Layout::Sign("="), right])
    }

    /// The box of the rate d f/dt of a function, which is set as a factor.
    pub fn rate(factor: Layout) -> Self {
        let above = Layout::Row(vec![Layout::Word("d"), Layout::Space, factor]);
        let below = Layout::Row(vec![Layout::Word("d"), Layout::name("t", Type::Scalar)]);
        Layout::Fraction(Box::new(above), Box::new(below))
    }

    /// The box of a vector field as a derivation, u ∂/∂x + …, from the variables and their components.
    pub fn derivation<'f>(
        parts: impl IntoIterator<Item = (&'f str, &'f Formula)>,
        names: &dyn Fn(Symbol) -> String,
    ) -> Self {
        let mut row = Vec::new();
        for (name, formula) in parts {
            if formula.text().trim() == "0" {
                continue;
            }
            let (is_negative, factor) = formula.signed_layout(names);
            match (is_negative, row.is_empty()) {
                (true, _) => row.push(Layout::Sign("−")),
                (false, false) => row.push(Layout::Sign("+")),
                (false, true) => {}
            }
            let kind = formula.value_type();
            let is_one = matches!(&factor, Layout::Number(digits) if digits == "1");
            if !is_one {
                let gap = if kind == Type::Scalar { Layout::Space } else { Layout::Sign("·") };
                row.extend([factor, gap]);
            }
            let variable = Box::new(Layout::name(name, kind));
            row.push(Layout::Lowered(Box::new(Layout::Sign("∂")), variable));
        }
        match row.is_empty() {
            true => Layout::Number("0".to_string()),
            false => Layout::Row(row),
        }
    }

    /// The boxes of a list, with commas between them.
    pub fn listed(parts: impl IntoIterator<Item = Layout>) -> Self {
        let mut row = Vec::new();
        for part in parts {
            if !row.is_empty() {
                row.extend([Layout::Sign(","), Layout::Space]);
            }
            row.push(part);
        }
        Layout::Row(row)
    }

    /// The box of a map, left ↦ right.
    pub fn image(left: Layout, right: Layout) -> Self {
        Layout::Row(vec![left, Layout::Sign("↦"), right])
    }

    /// Whether the box is so high that brackets around it have to grow.
    pub fn is_tall(&self) -> bool {
        match self {
            Layout::Fraction(..) | Layout::Matrix(_) => true,
            Layout::Row(parts) => parts.iter().any(Layout::is_tall),
            Layout::Fenced(_, inner, _) | Layout::Root(inner) => inner.is_tall(),
            Layout::Raised(base, _) | Layout::Lowered(base, _) => base.is_tall(),
            Layout::Number(_)
            | Layout::Name { .. }
            | Layout::Word(_)
            | Layout::Sign(_)
            | Layout::Space => false,
        }
    }

    pub(super) fn fenced(self) -> Self {
        Layout::Fenced("(", Box::new(self), ")")
    }

    pub(super) fn raised(self, exponent: Layout) -> Self {
        Layout::Raised(Box::new(self), Box::new(exponent))
    }
}

impl Formula {
    /// Sets the formula, with the given names of its symbols.
    pub fn layout(&self, names: &dyn Fn(Symbol) -> String) -> Layout {
        paper::set(&self.arena, names, BoxStrength::Sum)
    }

    /// Sets the formula as a coefficient, without a minus sign before it; and whether it has one.
    fn signed_layout(&self, names: &dyn Fn(Symbol) -> String) -> (bool, Layout) {
        match paper::without_minus(self.layout(names)) {
            Ok(layout) => (true, layout),
            Err(_) => (false, self.layout_of_product(names)),
        }
    }

    /// Sets the formula before a factor: a sum has brackets.
    pub fn layout_of_product(&self, names: &dyn Fn(Symbol) -> String) -> Layout {
        paper::set(&self.arena, names, BoxStrength::Product)
    }

    /// Sets the formula as a factor: a sum, and a product, have brackets.
    pub fn layout_of_factor(&self, names: &dyn Fn(Symbol) -> String) -> Layout {
        paper::set(&self.arena, names, BoxStrength::Power)
    }
}
