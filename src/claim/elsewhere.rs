//! Requirements of a claim at a point other than the state: at σ(x), at Φ(x), at a fixed point.

use num_dual::DualNum;
use num_traits::Zero;

use super::{Condition, Need};
use crate::formula::Formula;
use crate::graph::{Expr, edges, literally};
use crate::mechanics::{LevelFunction, Model, Phase};

/// Records the equations of motion and some level equations as written at the image of a state: where they have no
/// value the image is not in phase space, or not on the level.
pub(super) fn system_at(at: &Phase<'_, Expr>, kept: &[bool]) -> Vec<Expr> {
    let mut values = formulas_at(at);
    values.extend(at.hidden_in_motion(&values));
    values.extend(at.open_divisors());
    values.extend(level_at(at, kept));
    values
}

/// Records some level equations as written at a point: where they have no value it is not on the level.
pub fn level_at(at: &Phase<'_, Expr>, kept: &[bool]) -> Vec<Expr> {
    let equations = at.model().level.iter().zip(kept).filter(|(_, kept)| **kept);
    let formulas = equations.filter_map(|(own, _)| match &own.function {
        LevelFunction::Formula(formula) => Some(formula),
        _ => None,
    });
    formulas.flat_map(|formula| written_at(at, formula)).collect()
}

/// Records the same at a point that a claim names. The slope of an energy has no value there where what is
/// under a root is 0, that of √x² at 0; nor have rates where a mass is 0.
pub(super) fn system_at_point(at: &Phase<'_, Expr>) -> Vec<Expr> {
    let formulas = formulas_at(at);
    match at.model().system.has_given_rates() {
        true => formulas,
        // Also what the values of the field show: 1/sin π is no operation any more once sin π is 0.
        false => [inside(formulas), at.motion_as_written()].concat(),
    }
}

fn formulas_at(at: &Phase<'_, Expr>) -> Vec<Expr> {
    let formulas = at.model().equations_of_motion().into_iter();
    formulas.flat_map(|formula| written_at(at, formula)).collect()
}

/// Records a formula as written at a point, with what its value does not show.
pub(super) fn written_at(at: &Phase<'_, Expr>, formula: &Formula) -> Vec<Expr> {
    let mut values = at.evaluate_literally(formula).components();
    values.extend(at.presupposed(formula));
    values
}

/// Records the inverse of a formula as written at a point, by which a claim divides.
pub(super) fn inverse_at(at: &Phase<'_, Expr>, divisor: &Formula) -> Vec<Expr> {
    let values = at.evaluate_literally(divisor).components();
    values.into_iter().map(|value| literally(|| value.recip())).collect()
}

/// Adds what must not be 0 for the values to have derivatives of all orders near the point.
pub(super) fn inside(mut values: Vec<Expr>) -> Vec<Expr> {
    values.extend(edges(&values));
    values
}

/// The condition that formulas taken at two points contain no two different ∫: one of them at one point
/// may have the form of the other at the other, and they differ by a constant.
pub(super) fn one_antiderivative(model: &Model, formulas: &[&Formula]) -> Option<Condition> {
    model.has_several_antiderivatives(formulas).then(|| Condition {
        need: Need::NotZero { value: Expr::zero() },
        otherwise: "it compares different ∫ at two points, and the constant of each is open"
            .to_string(),
        is_essential: true,
    })
}
