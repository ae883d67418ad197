//! Limits of values that have none at 0, by their expansions in the parameter.

use crate::graph::{Expanded, Expansion, Side};
use crate::mechanics::{Draw, Model, ParameterOrigin, SamplerSpec};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// What a limit is said to be: B, and with a slope C, so that A = B + εC + O(ε²).
#[derive(Clone, Copy)]
pub struct Stated<T> {
    /// Limit B.
    pub value: T,
    /// Slope C, if it is stated.
    pub slope: Option<T>,
}

/// Returns the sides of 0 on which the declared range of a parameter lies.
pub fn sides(model: &Model, parameter: usize) -> Vec<Side> {
    let zero = Rational::from(0);
    match model.parameters.get(parameter).map(|own| &own.origin) {
        Some(ParameterOrigin::Free(SamplerSpec::Scalar(Draw::Within(range)))) => {
            let above = (range.high > zero).then_some(Side::Above);
            let below = (range.low < zero).then_some(Side::Below);
            above.into_iter().chain(below).collect()
        }
        Some(ParameterOrigin::Free(SamplerSpec::Scalar(Draw::OneOf(values)))) => {
            let above = values.iter().any(|value| *value > zero).then_some(Side::Above);
            let below = values.iter().any(|value| *value < zero).then_some(Side::Below);
            above.into_iter().chain(below).collect()
        }
        _ => vec![Side::Above, Side::Below],
    }
}

/// Expands a value from each side on which it exists, for each choice of signs on which that depends; `None` if it is not known on one, or exists on
/// none.
pub fn expansions<T: Scalar>(
    value: T,
    parameter: T,
    sides: &[Side],
    order: i32,
) -> Option<Vec<(Side, Expansion<T>)>> {
    let mut found = Vec::new();
    for side in sides {
        match value.expanded(parameter, *side, order) {
            Expanded::Terms(all) => found.extend(all.into_iter().map(|own| (*side, own))),
            Expanded::Void => {}
            Expanded::Unknown => return None,
        }
    }
    (!found.is_empty()).then_some(found)
}

/// Returns the values that vanish if the expansion from one side is as stated.
pub fn defects<T: Scalar>(side: Side, expansion: &Expansion<T>, stated: &Stated<T>) -> Vec<T> {
    let at = |order: i64| (Rational::from(order), 0);
    // |ε| = -ε on the lower side.
    let slope = stated.slope.map(|slope| if side == Side::Below { -slope } else { slope });
    let known = [Some((at(0), stated.value)), slope.map(|slope| (at(1), slope))];
    let mut open: Vec<((Rational, i32), T)> = known.into_iter().flatten().collect();
    let last = Rational::from(if slope.is_some() { 2 } else { 0 });
    let mut defects = Vec::new();
    for term in &expansion.terms {
        let own = (term.order.clone(), term.logarithms);
        match open.iter().position(|(order, _)| *order == own) {
            Some(index) => {
                let (_, value) = open.swap_remove(index);
                defects.push(term.coefficient - value);
            }
            // 1/ln ε tends to 0, and ε²/ln ε is O(ε²).
            None if own.0 == last && (own.1 < 0 || (own.1 == 0 && slope.is_some())) => {}
            None => defects.push(term.coefficient),
        }
    }
    defects.extend(open.into_iter().map(|(_, value)| -value));
    let weighted = |defect: T| expansion.weights.iter().fold(defect, |own, weight| own * *weight);
    defects.into_iter().map(weighted).collect()
}
