//! Equations of a level set.

use super::elimination::determinant;
use crate::formula::Formula;
use crate::graph::Expr;

/// One equation F = 0 of the level set.
#[derive(Clone, Debug)]
pub struct LevelEquation {
    /// Text of the equation as the user or the paper writes it, such as `(ω,γ) = 0`.
    pub text: String,
    /// Function F, a scalar.
    pub function: LevelFunction,
    /// Sides of the equation if one of them is a root: A = e² is solved in place of √A = e.
    pub root: Option<RootEquation>,
    /// Whether entries of the same equation of the file are left out, as they follow from other equations.
    pub lacks_entries: bool,
}

/// Text between an equation and the place of an entry.
pub const ENTRY: &str = ", entry ";

impl LevelEquation {
    /// Text of the equation in the file.
    pub fn written(&self) -> &str {
        written(&self.text)
    }
}

/// Text of an equation in the file: between vectors, say, if the text given is that of an entry.
pub fn written(text: &str) -> &str {
    text.split_once(ENTRY).map_or(text, |(whole, _)| whole)
}

/// An equation √A = e, or |x| = e.
#[derive(Clone, Debug)]
pub struct RootEquation {
    /// Radicand A, or x.
    pub radicand: Formula,
    /// Whether the equation is |x| = e.
    pub is_modulus: bool,
    /// Other side e, which is not negative on the level.
    pub other_side: Formula,
}

/// An equation that chooses one of two halves of the level, on which it holds: det Q = 1 where QᵀQ = E. It is not one
/// of the equations of the level.
#[derive(Clone, Debug)]
pub struct Orientation {
    /// The equation.
    pub equation: LevelEquation,
    /// Half on which it holds.
    pub half: Half,
}

/// A half of a level: the sign of the determinant of vectors that are a basis on all of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Half {
    /// Components of the state that each vector consists of.
    pub vectors: Vec<Vec<usize>>,
    /// Whether their determinant is positive.
    pub is_positive: bool,
}

impl Half {
    /// Computes a value that is positive on this half, and negative on the other one.
    pub fn sign(&self, state: &[Expr]) -> Expr {
        let row = |vector: &Vec<usize>| vector.iter().map(|k| state[*k]).collect();
        let rows: Vec<Vec<Expr>> = self.vectors.iter().map(row).collect();
        let value = determinant(&rows);
        if self.is_positive { value } else { -value }
    }
}

/// The function whose zeros are the points of a level equation.
#[derive(Clone, Debug)]
pub enum LevelFunction {
    /// Function F0 = (γ,γ) - 1 of a rolling body or a ball.
    UnitNormal,
    /// Function F1 = (ω,γ) of the constraint that prevents spinning.
    NoSpin,
    /// The difference of the two sides of an equation.
    Formula(Formula),
}
