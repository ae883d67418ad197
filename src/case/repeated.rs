//! Equations of a level with repeated factors, which have the zeros of simpler ones.

use crate::formula::Symbol;
use crate::mechanics::{ENTRY, LevelEquation, LevelFunction, Meaning, Model};

/// Puts simpler equations with the same zeros in the place of those in which a factor is repeated, as (x − y)² = 0, or
/// which are sums of squares; returns a remark on each. Those that `is_given` does not accept stay.
pub fn count_factors_once(
    model: &mut Model,
    is_given: impl Fn(&LevelEquation) -> bool,
) -> Vec<String> {
    let (mut remarks, mut level) = (Vec::new(), Vec::new());
    let is_coordinate =
        |own: Symbol| matches!(model.vocabulary.entry(own).meaning, Meaning::State(_));
    let is_fixed =
        |own: Symbol| matches!(model.vocabulary.entry(own).meaning, Meaning::Parameter(_));
    let simpler = |equation: &LevelEquation| match &equation.function {
        LevelFunction::Formula(function) if is_given(equation) => {
            function.with_simple_factors(&is_coordinate, &is_fixed)
        }
        _ => None,
    };
    for equation in &model.level {
        let Some(found) = simpler(equation) else {
            level.push(equation.clone());
            continue;
        };
        let text = &equation.text;
        let is_alone = found.len() == 1;
        remarks.push(match is_alone {
            true => format!(
                "each factor of `{text}` counts once: the zeros are the same, and slopes and densities are \
                 those of the simple factors"
            ),
            false => format!("`{text}` is a sum of squares, and says that each of them is 0"),
        });
        for (index, function) in (1..).zip(found) {
            let text = if is_alone { text.clone() } else { format!("{text}{ENTRY}{index}") };
            let function = LevelFunction::Formula(function);
            level.push(LevelEquation { text, function, root: None });
        }
    }
    model.level = level;
    remarks
}
