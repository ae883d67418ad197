//! Entries of claims as values.

use super::Complex;
use crate::formula::Formula;
use crate::number::rational::Rational;

/// Entry of a claim under one of its keys.
#[derive(Clone, Debug)]
pub enum Entry {
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
    Complex(Vec<Complex>),
    /// A word such as `holds`, a name, or the text of a formula, which is read when a case takes the
    /// claim.
    Text(String),
}

impl From<Formula> for Entry {
    fn from(formula: Formula) -> Self {
        Entry::Formula(formula)
    }
}

impl From<&Formula> for Entry {
    fn from(formula: &Formula) -> Self {
        Entry::Formula(formula.clone())
    }
}

impl From<Vec<Formula>> for Entry {
    fn from(formulas: Vec<Formula>) -> Self {
        Entry::List(formulas)
    }
}

impl From<Vec<(String, Formula)>> for Entry {
    fn from(table: Vec<(String, Formula)>) -> Self {
        Entry::Table(table)
    }
}

impl From<i64> for Entry {
    fn from(number: i64) -> Self {
        Entry::Formula(Formula::number(number))
    }
}

impl From<Rational> for Entry {
    fn from(number: Rational) -> Self {
        Entry::Formula(Formula::number(number))
    }
}

impl From<&str> for Entry {
    fn from(text: &str) -> Self {
        Entry::Text(text.to_string())
    }
}
