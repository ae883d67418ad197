//! Scope and limits of a search.

use liouville::case::Case;
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

impl Effort {
    /// Returns the same for a case made from another one, with those terms that can be read in its names.
    pub fn in_names_of(&self, case: &Case) -> Self {
        let of_case = |term: &FurtherTerm| {
            let text = match term {
                FurtherTerm::Formula(formula) => formula.text(),
                FurtherTerm::Text(text) => text,
            };
            FurtherTerm::from(text).read(&case.model).ok().map(FurtherTerm::Formula)
        };
        Self { terms: self.terms.iter().filter_map(of_case).collect(), ..self.clone() }
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

/// A term of a sum without a number as its first factor or last divisor: it has a coefficient of its own.
pub fn primitive(term: Formula, model: &Model) -> Formula {
    let is_number = |text: &str| !text.is_empty() && text.chars().all(|c| c.is_ascii_digit());
    let number = |text: &str| text.parse::<i64>().ok().map(Formula::number);
    let text = term.text();
    let parsed = |text: &str| Formula::parse(text, &model.vocabulary).ok();
    let divided = || {
        let (rest, below) = text.rsplit_once('/').filter(|(_, below)| is_number(below))?;
        let rest = parsed(rest)?;
        let same = (&rest / &number(below)?).ok()?;
        (same.text() == text).then_some(rest)
    };
    let multiplied = || {
        let (above, rest) = text.split_once('*').filter(|(above, _)| is_number(above))?;
        let rest = parsed(rest)?;
        let same = (&number(above)? * &rest).ok()?;
        (same.text() == text).then_some(rest)
    };
    match divided().or_else(multiplied) {
        Some(rest) => primitive(rest, model),
        None => term,
    }
}

#[cfg(test)]
mod tests {
    use liouville::case::Case;

    use super::*;

    #[test]
    fn numbers_at_the_ends_of_a_term_are_left_out() {
        let text = "title='x'\n[parameters]\nK='1..2'\n[state]\nx='1..2'\n[field]\n\"x'\"='K*x'\n";
        let case = Case::parse(text, &[]).expect("a case");
        let read = |text: &str| {
            let term = FurtherTerm::from(text).read(&case.model).expect("a term");
            primitive(term, &case.model).text().to_string()
        };
        for (text, expected) in [
            ("K*cos(x)/4", "K*cos(x)"),
            ("2*K*x/6", "K*x"),
            ("x²/2", "x²"),
            ("1 + x/4", "1 + x/4"),
            ("2*x + 1", "2*x + 1"),
            ("K/x", "K/x"),
            ("x^3/K/5", "x^3/K"),
            ("4", "4"),
            ("1/4", "1"),
        ] {
            assert_eq!(read(text), expected, "{text}");
        }
    }
}
