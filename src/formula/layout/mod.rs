//! How a formula looks on paper: boxes made from its tree, for any typesetter.
//!
//! Brackets are those that the tree needs; products stand side by side, quotients over each other,
//! and in line within exponents.

mod paper;

use super::Formula;
use super::kind::Type;
use super::scope::Symbol;

/// A box on paper.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Layout {
    /// Digits, without a sign.
    Number(String),
    /// A name: letter, what it stands for, index, and how many primes.
    Name {
        /// One letter, perhaps with an accent, or a word.
        letter: String,
        /// Vectors and matrices are set bold.
        kind: Type,
        /// The index; empty where there is none.
        index: String,
        /// Primes.
        primes: usize,
    },
    /// The name of a function, upright.
    Word(&'static str),
    /// A sign between or before others.
    Sign(&'static str),
    /// The small space of a product.
    Space,
    /// Boxes in a row.
    Row(Vec<Layout>),
    /// Between brackets or bars.
    Fenced(&'static str, Box<Layout>, &'static str),
    /// One over the other.
    Fraction(Box<Layout>, Box<Layout>),
    /// Under a root.
    Root(Box<Layout>),
    /// With an exponent.
    Raised(Box<Layout>, Box<Layout>),
    /// With an index.
    Lowered(Box<Layout>, Box<Layout>),
    /// Rows of a matrix.
    Matrix(Vec<Vec<Layout>>),
}

impl Layout {
    /// A name by itself.
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

    /// left = right
    pub fn equation(left: Layout, right: Layout) -> Self {
        Layout::Row(vec![left, Layout::Sign("="), right])
    }

    /// left ↦ right
    pub fn image(left: Layout, right: Layout) -> Self {
        Layout::Row(vec![left, Layout::Sign("↦"), right])
    }

    /// Is it so high that brackets around it have to grow?
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
    /// The formula as it looks on paper, with the names that symbols have.
    pub fn layout(&self, names: &dyn Fn(Symbol) -> String) -> Layout {
        paper::set(&self.arena, names)
    }
}
