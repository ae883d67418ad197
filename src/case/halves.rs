//! Equations that choose a half of the level, as det Q = 1 beside QᵀQ = E, and those that follow from such a frame.

use super::implied::{is_reaction, places_of_constraints, uses_reactions};
use crate::level::{OfFrame, of_frames};
use crate::mechanics::{LevelEquation, Model, Orientation, System};
use crate::order::StableOrder;

/// Takes equations out of the level that hold on a half, or on all, of an orthonormal basis which other equations
/// fix, and keeps the halves; returns a remark on each that is left out. Of a Lagrangian's these are constraints on
/// the coordinates, and those that `is_given` accepts.
pub fn take_out(model: &mut Model, is_given: impl Fn(&LevelEquation) -> bool) -> Vec<String> {
    // A map may take one half to the other.
    if model.system.is_map() || model.level.len() < 2 {
        return Vec::new();
    }
    let places = match &model.system {
        System::Lagrangian(own) if !own.vakonomic && !uses_reactions(model) => {
            places_of_constraints(own, model)
        }
        System::Lagrangian(_) => None,
        _ => Some(Vec::new()),
    };
    let is_known = places.is_some();
    let places = places.unwrap_or_default();
    let constraint = |index: usize| {
        places.iter().position(|(is_rate, place)| *is_rate && place.checked_sub(1) == Some(index))
    };
    let mut found = of_frames(model);
    found.retain(|own| {
        let is_free = || !places.iter().any(|(_, place)| *place == own.index);
        let is_own = || is_known && is_free() || is_given(&model.level[own.index]);
        constraint(own.index).is_some() || is_own()
    });
    found.order_by_key(|own| own.index);
    let mut remarks = Vec::new();
    for OfFrame { index, half } in found.into_iter().rev() {
        let own = constraint(index);
        let equation = model.leave_out(index);
        if let (Some(constraint), System::Lagrangian(lagrangian)) = (own, &mut model.system) {
            // The next equation is its rate.
            lagrangian.constraints.remove(constraint);
            model.leave_out(index);
            model.vocabulary = model.vocabulary.only(|entry| !is_reaction(entry));
        }
        match half {
            Some(half) => model.orientations.push(Orientation { equation, half }),
            None => remarks.push(format!(
                "`{}` follows from the other equations of the level, and is left out",
                equation.text
            )),
        }
    }
    remarks.reverse();
    remarks
}
