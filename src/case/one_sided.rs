//! `[one-sided]`: a constraint r(x) ≥ 0, and the motion in contact with it.

use super::body::formula;
use super::error::{CaseError, Problem};
use super::field;
use super::section::Section;
use crate::formula::{Formula, Type};
use crate::mechanics::{Model, Reach, System};

/// A one-sided constraint.
#[derive(Clone, Debug)]
pub struct OneSided {
    /// r(x), not negative along the motion.
    pub function: Formula,
    /// λ, positive while the constraint presses on the body.
    pub reaction: Formula,
    /// The rates of the state in contact.
    pub contact: Vec<Formula>,
}

/// Reads `[one-sided]`.
pub(super) fn read(root: &Section<'_>, model: &Model) -> Result<Option<OneSided>, CaseError> {
    let Some(section) = root.section("one-sided")? else { return Ok(None) };
    if !matches!(model.system, System::Field(_)) {
        return Err(section.complaint(Problem::Other {
            message: "a one-sided constraint belongs to a field of one's own".to_string(),
            remedy: "write the free motion under [field], with system = \"field\"".to_string(),
        }));
    }
    let names = &model.vocabulary;
    let scalar = |key: &'static str, remedy: &str| {
        let text = section.required(key, remedy)?;
        formula(&text, names, &format!("`{key}`"), Some(Type::Scalar), Reach::Phase)
    };
    let function = scalar("function", "add function = \"(ω,e)\", which is not to be negative")?;
    let reaction = scalar("reaction", "add reaction = \"λ\", positive in contact")?;
    let rates = section.section("field")?.ok_or_else(|| {
        section.missing("field", "add a table [one-sided.field] with the rates in contact")
    })?;
    let contact = field::rates(&rates, &model.state, names)?;
    section.finish()?;
    Ok(Some(OneSided { function, reaction, contact }))
}
