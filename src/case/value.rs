//! Values of parameters, ranges of state variables and formulas, as a builder takes them.

use std::ops::Range;

use super::shapes::{GivenValue, Refusal, described};
use crate::formula::{Formula, FormulaError, FormulaResult, Scope, Type};
use crate::mechanics::{Draw, SamplerSpec};
use crate::number::rational::Rational;

/// ValueSpec of a parameter, or the range of a state variable.
#[derive(Clone, Debug)]
pub enum ValueSpec {
    /// Number.
    Number(Rational),
    /// Components, row by row.
    Components(Type, Vec<Rational>),
    /// Drawn anew for every state; a proof covers all values.
    Drawn(SamplerSpec),
    /// Formula in the parameters before it.
    Formula(Formula),
    /// Text as case files write it: `3/4`, `0.5..2`, `inertia(0.5..5)`, `2*m`.
    Text(String),
}

impl From<&str> for ValueSpec {
    fn from(text: &str) -> Self {
        ValueSpec::Text(text.to_string())
    }
}

impl From<i64> for ValueSpec {
    fn from(number: i64) -> Self {
        ValueSpec::Number(Rational::from(number))
    }
}

impl From<Rational> for ValueSpec {
    fn from(number: Rational) -> Self {
        ValueSpec::Number(number)
    }
}

impl From<SamplerSpec> for ValueSpec {
    fn from(recipe: SamplerSpec) -> Self {
        ValueSpec::Drawn(recipe)
    }
}

impl From<Formula> for ValueSpec {
    fn from(formula: Formula) -> Self {
        ValueSpec::Formula(formula)
    }
}

impl From<&Formula> for ValueSpec {
    fn from(formula: &Formula) -> Self {
        ValueSpec::Formula(formula.clone())
    }
}

impl From<Range<i64>> for ValueSpec {
    fn from(range: Range<i64>) -> Self {
        ValueSpec::from(Rational::from(range.start)..Rational::from(range.end))
    }
}

impl From<Range<Rational>> for ValueSpec {
    fn from(range: Range<Rational>) -> Self {
        let range = crate::mechanics::Range { low: range.start, high: range.end };
        ValueSpec::Drawn(SamplerSpec::Scalar(Draw::Within(range)))
    }
}

impl ValueSpec {
    /// The value in the form of the file's reader.
    pub(super) fn given(&self, scope: &dyn Scope) -> Result<GivenValue, String> {
        let is_empty = |range: &crate::mechanics::Range| range.low >= range.high;
        match self {
            ValueSpec::Number(number) => Ok(GivenValue::Fixed(Type::Scalar, vec![number.clone()])),
            ValueSpec::Components(kind, values) if values.len() == kind.size() => {
                Ok(GivenValue::Fixed(*kind, values.clone()))
            }
            ValueSpec::Components(kind, values) => {
                Err(format!("{} components do not fill a {kind}", values.len()))
            }
            ValueSpec::Drawn(SamplerSpec::Scalar(Draw::Within(range))) if is_empty(range) => {
                Err(format!("the range {}..{} is empty", range.low, range.high))
            }
            ValueSpec::Drawn(recipe) => Ok(GivenValue::Drawn(recipe.clone())),
            ValueSpec::Formula(formula) => Ok(GivenValue::Formula(formula.to_string())),
            ValueSpec::Text(text) => described(text, scope).map_err(|refusal| match refusal {
                Refusal::Message(message) => message,
                Refusal::Form(message, remedy) => format!("{message}: {remedy}"),
                Refusal::Size(error, _) => error.to_string(),
                Refusal::OneValue(value) => Refusal::empty_range(&value, &value),
            }),
        }
    }
}

/// A formula, or the text of one in the names of the system.
#[derive(Clone, Debug)]
pub enum FormulaSource {
    /// Formula.
    Formula(Formula),
    /// Text.
    Text(String),
    /// A formula that could not be made.
    Failed(FormulaError),
}

impl From<&str> for FormulaSource {
    fn from(text: &str) -> Self {
        FormulaSource::Text(text.to_string())
    }
}

impl From<String> for FormulaSource {
    fn from(text: String) -> Self {
        FormulaSource::Text(text)
    }
}

impl From<Formula> for FormulaSource {
    fn from(formula: Formula) -> Self {
        FormulaSource::Formula(formula)
    }
}

impl From<&Formula> for FormulaSource {
    fn from(formula: &Formula) -> Self {
        FormulaSource::Formula(formula.clone())
    }
}

impl From<FormulaResult> for FormulaSource {
    fn from(composed: FormulaResult) -> Self {
        match composed {
            Ok(formula) => FormulaSource::Formula(formula),
            Err(error) => FormulaSource::Failed(error),
        }
    }
}
