//! Entries of claims as values.

use super::ComplexFormula;
use crate::formula::Formula;
use crate::number::rational::Rational;

/// Entry of a claim under one of its keys.
#[derive(Clone, Debug)]
pub enum ClaimEntry {
    /// A formula.
    Formula(Formula),
    /// Several formulas in order.
    List(Vec<Formula>),
    /// Both sides of an equation.
    Equation(Formula, Formula),
    /// Formulas with the names to which they belong.
    Table(Vec<(String, Formula)>),
    /// Tables by the names of their keys.
    Tables(Vec<(&'static str, Vec<(String, Formula)>)>),
    /// Real numbers and conjugate pairs.
    Complex(Vec<ComplexFormula>),
    /// A word such as `holds`, a name, or the text of a formula, which is read when a case takes the
    /// claim.
    Text(String),
}

impl From<Formula> for ClaimEntry {
    fn from(formula: Formula) -> Self {
        ClaimEntry::Formula(formula)
    }
}

impl From<&Formula> for ClaimEntry {
    fn from(formula: &Formula) -> Self {
        ClaimEntry::Formula(formula.clone())
    }
}

impl From<Vec<Formula>> for ClaimEntry {
    fn from(formulas: Vec<Formula>) -> Self {
        ClaimEntry::List(formulas)
    }
}

impl From<Vec<(String, Formula)>> for ClaimEntry {
    fn from(table: Vec<(String, Formula)>) -> Self {
        ClaimEntry::Table(table)
    }
}

impl From<i64> for ClaimEntry {
    fn from(number: i64) -> Self {
        ClaimEntry::Formula(Formula::number(number))
    }
}

impl From<Rational> for ClaimEntry {
    fn from(number: Rational) -> Self {
        ClaimEntry::Formula(Formula::number(number))
    }
}

impl From<&str> for ClaimEntry {
    fn from(text: &str) -> Self {
        ClaimEntry::Text(text.to_string())
    }
}
