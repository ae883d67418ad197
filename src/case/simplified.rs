//! Equations of `[level]` in the form in which they are judged: each counts once, and none follows from others.

use super::error::{Mistake, Problem};
use super::section::CaseTable;
use super::{halves, implied, repeated};
use crate::mechanics::{LevelEquation, LevelFunction, Model};

/// Simplifies the equations of the level, and takes out those that say nothing new; returns remarks.
pub fn simplify(root: &CaseTable<'_>, model: &mut Model) -> Vec<String> {
    root.keep(no_open_level(root, model));
    let section = root.table("level");
    let texts = section.map(|own| own.texts("equations").unwrap_or_default()).unwrap_or_default();
    let texts: Vec<String> = texts.iter().map(|text| text.value.trim().to_string()).collect();
    let is_given = |equation: &LevelEquation| implied::is_one_of(equation, &texts);
    let mut remarks = halves::take_out(model, is_given);
    if !texts.is_empty() {
        remarks.extend(repeated::count_factors_once(model, is_given));
        let left_out = implied::leave_out(model, is_given).map_err(|text| {
            let span = root.find(&text).map(|start| start..start + text.len());
            let message = format!("`{text}` contradicts the equations before it");
            let remedy = "correct one of them: together they have no solution".to_string();
            Mistake::new(span, Problem::Sense { message, remedy })
        });
        remarks.extend(root.keep(left_out).unwrap_or_default());
    }
    remarks
}

/// Rejects a level equation with an ∫: its open constant does not fix a level set.
fn no_open_level(root: &CaseTable<'_>, model: &Model) -> Result<(), Mistake> {
    for equation in &model.level {
        let LevelFunction::Formula(function) = &equation.function else { continue };
        if model.has_antiderivative(function) {
            let span = root.find(&equation.text).map(|start| start..start + equation.text.len());
            let message = format!("`{}` contains an ∫, whose constant is open", equation.text);
            let remedy = "write the antiderivative out".to_string();
            return Err(Mistake::new(span, Problem::Sense { message, remedy }));
        }
    }
    Ok(())
}
