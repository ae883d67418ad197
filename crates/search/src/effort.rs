//! Scope and limits of a search.

use liouville::formula::{Formula, Type};
use liouville::mechanics::Model;
use liouville::verdict::Options;

use super::{Ansatz, ConditionTarget, Halt, Hamiltonians, SearchError};

/// Scope and limits of a search.
#[derive(Clone, Debug)]
pub struct Effort {
    /// Highest degree in the velocities of integrals to be counted.
    pub degree: u32,
    /// Whether the claims of the case are ignored.
    pub blind: bool,
    /// Terms of integrals in addition to those offered by the system.
    pub terms: Vec<FurtherTerm>,
    /// Search for conditions on the parameters, if any.
    pub conditions: Option<ConditionTarget>,
    /// Time in seconds above which a count is left out.
    pub seconds: f64,
    /// Scope of the polynomial ansatz.
    pub ansatz: Ansatz,
    /// Whether polynomial integrals of higher degrees are searched, class by class.
    pub by_class: bool,
    /// Whether Darboux polynomials, and what follows from them, are searched along orbits.
    pub by_factors: bool,
    /// Hamiltonians for which brackets are searched, if any.
    pub poisson: Option<Hamiltonians>,
    /// Condition for an early end.
    pub halt: Halt,
    /// Options for judging candidates.
    pub options: Options,
}

impl Default for Effort {
    /// Integrals up to degree 4, a minute for each count, and no early end.
    fn default() -> Self {
        Self {
            degree: 4,
            blind: false,
            terms: Vec::new(),
            conditions: None,
            seconds: 60.0,
            ansatz: Ansatz::default(),
            by_class: true,
            by_factors: true,
            poisson: None,
            halt: Halt::default(),
            options: Options::default(),
        }
    }
}

/// A further term that integrals may contain.
#[derive(Clone, Debug)]
pub enum FurtherTerm {
    /// Text in the names of the case.
    Text(String),
    /// Formula of the case.
    Formula(Formula),
}

impl From<&str> for FurtherTerm {
    fn from(text: &str) -> Self {
        FurtherTerm::Text(text.to_string())
    }
}

impl From<String> for FurtherTerm {
    fn from(text: String) -> Self {
        FurtherTerm::Text(text)
    }
}

impl From<Formula> for FurtherTerm {
    fn from(formula: Formula) -> Self {
        FurtherTerm::Formula(formula)
    }
}

impl FurtherTerm {
    /// The term as a scalar of the case.
    pub fn read(&self, model: &Model) -> Result<Formula, SearchError> {
        match self {
            FurtherTerm::Formula(formula) => Ok(formula.clone()),
            FurtherTerm::Text(text) => {
                let unread = |reason: String| SearchError::NoTerm(text.clone(), reason);
                let read = Formula::parse(text, &model.vocabulary);
                let formula = read.map_err(|error| unread(error.to_string()))?;
                match formula.value_type() {
                    Type::Scalar => Ok(formula),
                    _ => Err(unread("it is not a scalar".to_string())),
                }
            }
        }
    }
}
