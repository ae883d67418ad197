//! Values of parameters, ranges of state variables and formulas, as a builder takes them.

use std::ops::Range;

use super::shapes::{Given, Refusal, described};
use crate::formula::{Composed, Formula, FormulaError, Scope, Type};
use crate::mechanics::{Draw, Recipe};
use crate::number::rational::Rational;

/// Value of a parameter, or the range of a state variable.
#[derive(Clone, Debug)]
pub enum Value {
    /// Number.
    Number(Rational),
    /// Components, row by row.
    Components(Type, Vec<Rational>),
    /// Drawn anew for every state; a proof covers all values.
    Drawn(Recipe),
    /// Formula in the parameters before it.
    Formula(Formula),
    /// Text as case files write it: `3/4`, `0.5..2`, `inertia(0.5..5)`, `2*m`.
    Text(String),
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Value::Text(text.to_string())
    }
}

impl From<i64> for Value {
    fn from(number: i64) -> Self {
        Value::Number(Rational::from(number))
    }
}

impl From<Rational> for Value {
    fn from(number: Rational) -> Self {
        Value::Number(number)
    }
}

impl From<Recipe> for Value {
    fn from(recipe: Recipe) -> Self {
        Value::Drawn(recipe)
    }
}

impl From<Formula> for Value {
    fn from(formula: Formula) -> Self {
        Value::Formula(formula)
    }
}

impl From<&Formula> for Value {
    fn from(formula: &Formula) -> Self {
        Value::Formula(formula.clone())
    }
}

impl From<Range<i64>> for Value {
    fn from(range: Range<i64>) -> Self {
        Value::from(Rational::from(range.start)..Rational::from(range.end))
    }
}

impl From<Range<Rational>> for Value {
    fn from(range: Range<Rational>) -> Self {
        let range = crate::mechanics::Range { low: range.start, high: range.end };
        Value::Drawn(Recipe::Scalar(Draw::Within(range)))
    }
}

impl Value {
    /// The value in the form of the file's reader.
    pub(super) fn given(&self, scope: &dyn Scope) -> Result<Given, String> {
        let is_empty = |range: &crate::mechanics::Range| range.low >= range.high;
        match self {
            Value::Number(number) => Ok(Given::Fixed(Type::Scalar, vec![number.clone()])),
            Value::Components(kind, values) if values.len() == kind.size() => {
                Ok(Given::Fixed(*kind, values.clone()))
            }
            Value::Components(kind, values) => {
                Err(format!("{} components do not fill a {kind}", values.len()))
            }
            Value::Drawn(Recipe::Scalar(Draw::Within(range))) if is_empty(range) => {
                Err(format!("the range {}..{} is empty", range.low, range.high))
            }
            Value::Drawn(recipe) => Ok(Given::Drawn(recipe.clone())),
            Value::Formula(formula) => Ok(Given::Formula(formula.to_string())),
            Value::Text(text) => described(text, scope).map_err(|refusal| match refusal {
                Refusal::Message(message) => message,
                Refusal::Size(error, _) => error.to_string(),
            }),
        }
    }
}

/// A formula, or the text of one in the names of the system.
#[derive(Clone, Debug)]
pub enum Source {
    /// Formula.
    Formula(Formula),
    /// Text.
    Text(String),
    /// A formula that could not be made.
    Failed(FormulaError),
}

impl From<&str> for Source {
    fn from(text: &str) -> Self {
        Source::Text(text.to_string())
    }
}

impl From<Formula> for Source {
    fn from(formula: Formula) -> Self {
        Source::Formula(formula)
    }
}

impl From<&Formula> for Source {
    fn from(formula: &Formula) -> Self {
        Source::Formula(formula.clone())
    }
}

impl From<Composed> for Source {
    fn from(composed: Composed) -> Self {
        match composed {
            Ok(formula) => Source::Formula(formula),
            Err(error) => Source::Failed(error),
        }
    }
}
