//! Declaration of names, level equations and parts of a body.

use super::super::ClaimError;
use super::super::claim_table::stranger;
use super::super::equations::{entries, level_equation};
use super::super::parameters::{NO_NAME, origin_of};
use super::super::shapes::{GivenValue, list, state_draws};
use super::super::value::{FormulaSource, ValueSpec};
use super::{BodyPart, Build, ModelBuilder};
use crate::formula::{Formula, Type, canonical_name};
use crate::mechanics::{Dependence, Meaning, Parameter, ParameterOrigin};

/// Remedy where the sides of an equation are of different types.
const SIDES: &str = "compare scalars, or vectors or matrices of one size";

impl ModelBuilder {
    /// Carries out a step for a canonical name, unless an earlier one failed.
    pub(super) fn attempt(
        mut self,
        name: &str,
        step: impl FnOnce(&mut Self, &str) -> Result<(), ClaimError>,
    ) -> Self {
        if self.error.is_none() {
            let result = match canonical_name(name) {
                Some(canonical) => step(&mut self, &canonical),
                None => Err(ClaimError::new(name, "this is not a name", NO_NAME)),
            };
            self.error = result.err();
        }
        self
    }

    pub(super) fn check_free(&self, name: &str) -> Result<(), ClaimError> {
        match self.vocabulary.find(name) {
            None => Ok(()),
            Some(_) => Err(ClaimError::new(name, "it is taken already", "choose another name")),
        }
    }

    pub(super) fn add_parameter(
        &mut self,
        name: &str,
        value: &ValueSpec,
    ) -> Result<(), ClaimError> {
        self.check_free(name)?;
        let refuse = |message: String| {
            let remedy = "write a number, a range such as \"0.5..2\", or a formula";
            ClaimError::new(name, message, remedy)
        };
        let (kind, origin) = match value.given(&self.vocabulary).map_err(refuse)? {
            GivenValue::Fixed(kind, values) => (kind, ParameterOrigin::Fixed(values)),
            GivenValue::Drawn(recipe) => (recipe.kind(), ParameterOrigin::Free(recipe)),
            GivenValue::List(values) => {
                let (kind, values) = list(values, false);
                (kind, ParameterOrigin::Fixed(values))
            }
            GivenValue::Formula(text) => {
                let source = match value {
                    ValueSpec::Formula(formula) => FormulaSource::Formula(formula.clone()),
                    _ => FormulaSource::Text(text),
                };
                let read = self.read(name, &source, None, Dependence::Parameters)?;
                (read.value_type(), origin_of(read))
            }
        };
        if let ValueSpec::Text(text) = value {
            self.sizes.push(text.clone());
        }
        let whole = match (&origin, kind) {
            (ParameterOrigin::Fixed(values), Type::Scalar) => {
                values.first().and_then(|own| own.to_integer())
            }
            _ => None,
        };
        let meaning = Meaning::Parameter(self.parameters.len());
        self.vocabulary.add(name, meaning, kind, Dependence::Parameters);
        if let Some(whole) = whole {
            self.vocabulary.set_whole(name, whole);
        }
        self.parameters.push(Parameter { name: name.to_string(), kind, origin });
        Ok(())
    }

    pub(super) fn add_variable(&mut self, name: &str, range: &ValueSpec) -> Result<(), ClaimError> {
        self.check_free(name)?;
        let remedy = "write \"-2..2\", \"vector(-1..1)\" or \"matrix(2, 2, -1..1)\"";
        let given = range.given(&self.vocabulary);
        let given = given.map_err(|message| ClaimError::new(name, message, remedy))?;
        let Some((kind, draws)) = state_draws(&given) else {
            let message = "a state variable needs a range from which its values are drawn";
            return Err(ClaimError::new(name, message, remedy));
        };
        if let ValueSpec::Text(text) = range {
            self.sizes.push(text.clone());
        }
        self.state.add(name, kind, draws, &mut self.vocabulary, Dependence::Phase);
        self.rates.push(None);
        Ok(())
    }

    pub(super) fn add_level(
        &mut self,
        left: &FormulaSource,
        right: &FormulaSource,
    ) -> Result<(), ClaimError> {
        if matches!(self.build, Build::Rolling { .. }) {
            let message = "the level set of this system is fixed";
            return Err(ClaimError::new("level", message, "leave the equation out"));
        }
        let left = self.read("the left side", left, None, Dependence::Phase)?;
        let right = self.read("the right side", right, None, Dependence::Phase)?;
        let is_zero = right.constant().is_some_and(|value| value.is_zero());
        let function = match is_zero {
            true => left.clone(),
            false => (left.bracketed() - right.bracketed())
                .map_err(|error| ClaimError::new("level", error.to_string(), SIDES))?,
        };
        let text = format!("{left} = {right}");
        if function.value_type() == Type::Scalar {
            self.level.push(level_equation(text, function, Some((left, right))));
            return Ok(());
        }
        let entries = entries(&text, function, &self.vocabulary)
            .map_err(|error| ClaimError::new("level", error.to_string(), SIDES))?;
        let each = entries.into_iter().map(|(text, entry)| level_equation(text, entry, None));
        self.level.extend(each);
        Ok(())
    }

    pub(super) fn part(mut self, part: BodyPart, source: impl Into<FormulaSource>) -> Self {
        if self.error.is_none() {
            let is_body = matches!(self.build, Build::Rolling { .. });
            let is_new = self.parts.iter().all(|(own, _)| *own != part);
            self.error = match (is_body, is_new) {
                (true, true) => None,
                (false, _) => {
                    let message = "a field has no body";
                    Some(ClaimError::new(
                        "body",
                        message,
                        "begin with Model::rubber_plane() or Model::rolling_plane()",
                    ))
                }
                (true, false) => {
                    let message = format!("the {part:?} is given twice").to_lowercase();
                    Some(ClaimError::new("body", message, "give each part once"))
                }
            };
            self.parts.push((part, source.into()));
        }
        self
    }

    /// Reads a formula in the names declared so far, and checks its type and dependence.
    pub(super) fn read(
        &self,
        what: &str,
        source: &FormulaSource,
        kind: Option<Type>,
        reach: Dependence,
    ) -> Result<Formula, ClaimError> {
        let read = match source {
            FormulaSource::Formula(formula) => {
                let own = self.vocabulary.check_own(formula);
                own.map_err(|name| stranger(what, &name))?;
                Ok(formula.clone())
            }
            FormulaSource::Text(text) => Formula::parse(text, &self.vocabulary),
            FormulaSource::Failed(error) => Err(error.clone()),
        };
        let read = read.map_err(|error| {
            let help = error.help().unwrap_or("declare the names that it uses before");
            ClaimError::new(what, error.message(), help)
        })?;
        if let Some(kind) = kind.filter(|kind| *kind != read.value_type()) {
            let message = format!("`{read}` is a {}", read.value_type());
            return Err(ClaimError::new(what, message, &format!("give a {kind}")));
        }
        match self.vocabulary.reach(&read) {
            Some(entry) if entry.reach > reach => {
                let message = format!("`{}` changes along the motion", entry.name);
                let remedy = match reach {
                    Dependence::Parameters => "use parameters alone",
                    _ => "use γ and parameters",
                };
                Err(ClaimError::new(what, message, remedy))
            }
            _ => Ok(read),
        }
    }
}
