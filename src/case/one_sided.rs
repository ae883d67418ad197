//! The table `[one-sided]`: a constraint r(x) ≥ 0, and the motion in contact with it.

use super::MotionClaim;
use super::error::Problem;
use super::field;
use super::formulas::formula;
use super::section::CaseTable;
use crate::claim::motion::MotionKind;
use crate::formula::{Formula, Type};
use crate::mechanics::{Dependence, Model, System};

/// A one-sided constraint.
#[derive(Clone, Debug)]
pub struct OneSided {
    /// Function r(x), not negative along the motion.
    pub function: Formula,
    /// Reaction λ, positive while the constraint presses on the body.
    pub reaction: Formula,
    /// Rates of the state in contact.
    pub contact: Vec<Formula>,
}

/// Warning where claims of a case are about its field and not about motions under a constraint.
pub(super) fn warning(claims: usize, motions: &[MotionClaim]) -> Option<String> {
    let keeps = |claim: &MotionClaim| {
        matches!(claim.kind, MotionKind::Contacts(_) | MotionKind::LimitOfMotion(_))
    };
    let is_about_field = claims > 0 || !motions.iter().all(keeps);
    is_about_field.then(|| {
        "verdicts speak of the field without [one-sided], other than of contacts and limit-of-motion"
            .to_string()
    })
}

/// Reads `[one-sided]`; `None` where it is absent, or has a mistake.
pub(super) fn read(root: &CaseTable<'_>, model: &Model) -> Option<OneSided> {
    let section = root.table("one-sided")?;
    if !matches!(model.system, System::Field(_)) {
        root.mistakes().add(section.complaint(Problem::Other {
            message: "a one-sided constraint needs a vector field given in the file".to_string(),
            remedy: "write the free motion under [field], with system = \"field\"".to_string(),
        }));
        return None;
    }
    let names = &model.vocabulary;
    let scalar = |key: &'static str, remedy: &str| {
        let text = section.required(key, remedy)?;
        formula(&text, names, &format!("`{key}`"), Some(Type::Scalar), Dependence::Phase)
    };
    let remedy = "add function = \"(ω,e)\", which must not be negative";
    let function = section.keep(scalar("function", remedy));
    let remedy = "add reaction = \"λ\", positive in contact";
    let reaction = section.keep(scalar("reaction", remedy));
    let rates = section.keep(section.section("field").and_then(|field| {
        let remedy = "add a table [one-sided.field] with the rates in contact";
        field.ok_or_else(|| section.missing("field", remedy))
    }));
    let contact = rates.and_then(|rates| {
        let names = field::Names { vocabulary: names, parameters: &model.parameters };
        field::rates(&rates, &model.state, names)
    });
    section.finish();
    Some(OneSided { function: function?, reaction: reaction?, contact: contact? })
}
