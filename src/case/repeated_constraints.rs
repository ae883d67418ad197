//! Constraints of a Lagrangian system with repeated factors: their slopes vanish where they hold, and leave the reactions
//! open.

use super::equations::{level_equation, rate_text};
use super::{holonomic, implied, repeated};
use crate::formula::Formula;
use crate::mechanics::{LevelEquation, LevelFunction, Model, System};

/// A constraint with its equations of the level.
struct Constraint {
    function: Formula,
    level: Vec<LevelEquation>,
}

/// Puts simpler constraints with the same zeros in the place of those in which a factor is repeated, as
/// (x' − y z')² = 0 or (x − y)² = 0, or which are sums of values of one sign; returns a remark on each. Where one becomes several,
/// reactions have no names.
pub fn count_factors_once(model: &mut Model) -> Vec<String> {
    let System::Lagrangian(lagrangian) = &model.system else { return Vec::new() };
    let Some(places) = implied::places_of_constraints(lagrangian, model) else { return Vec::new() };
    if lagrangian.vakonomic {
        return Vec::new();
    }
    let (mut remarks, mut all, mut is_split) = (Vec::new(), Vec::new(), false);
    let mut end = 0;
    for (constraint, (is_rate, place)) in lagrangian.constraints.iter().zip(places) {
        end = place + 1;
        let own = &model.level[place - usize::from(is_rate)..end];
        let found = match &own[0].function {
            LevelFunction::Formula(function) => repeated::simpler(model, function),
            _ => None,
        };
        let counts = found.as_ref().map(|found| found.functions.len());
        let is_open = counts.is_some_and(|count| count == 1 || !implied::uses_reactions(model));
        let simpler = found.filter(|_| is_open).and_then(|found| {
            let (text, remark) = (&own[0].text, found.remark(&own[0].text));
            let made = |(text, function): (String, Formula)| {
                let level = vec![level_equation(text.clone(), function.clone(), None)];
                let roles = &lagrangian.roles;
                // A sum of squares may be one of coordinates and velocities.
                let rate = holonomic::rate_of_simplified(&function, &text, model, roles);
                let Some(rate) = rate else {
                    return (!is_rate).then_some(Constraint { level, function });
                };
                let text = rate_text(&text, &model.vocabulary);
                let own = level_equation(text, rate.clone(), None);
                Some(Constraint { level: [level, vec![own]].concat(), function: rate })
            };
            let all = found.named(text).into_iter().map(made);
            Some((remark, all.collect::<Option<Vec<Constraint>>>()?))
        });
        match simpler {
            Some((remark, made)) => {
                is_split |= made.len() > 1;
                remarks.push(remark);
                all.extend(made);
            }
            None => all.push(Constraint { function: constraint.clone(), level: own.to_vec() }),
        }
    }
    if remarks.is_empty() {
        return remarks;
    }
    let rest = model.level.split_off(end);
    let (functions, level): (Vec<_>, Vec<_>) =
        all.into_iter().map(|own| (own.function, own.level)).unzip();
    model.level = level.into_iter().flatten().chain(rest).collect();
    if let System::Lagrangian(lagrangian) = &mut model.system {
        lagrangian.constraints = functions;
    }
    if is_split {
        model.vocabulary = model.vocabulary.only(|entry| !implied::is_reaction(entry));
    }
    remarks
}
