//! Kinks of a body's surface, which the criterion for a density takes for smooth, and of maps.

use num_dual::DualNum;
use num_traits::One;

use super::assumption::Assumption;
use crate::graph::{Expr, Graph, Step, record};
use crate::mechanics::{Draw, Model, NORMAL, Phase};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;
use crate::proof::{Extent, is_nowhere_zero};

/// Returns the hypothesis of a criterion on a body whose radii of curvature are not known to be smooth functions
/// of γ.
pub(super) fn assumption(model: &Model) -> Option<(Assumption, String)> {
    may_have_kinks(model).then(|| {
        let words = "it is not known that the surface is smooth for all γ: the density is positive and smooth \
                     where the support function is";
        (Assumption::SmoothSurface, words.to_string())
    })
}

/// Returns the remark for a map with a modulus.
pub(super) fn of_map(graph: &Graph, image: &[Expr]) -> Option<String> {
    let is_modulus = |step: Step<'_>| step.is_modulus();
    graph.has_step(image, is_modulus).then(|| {
        "the map has kinks where what is in |…| is 0, and may take states on both sides to one"
            .to_string()
    })
}

/// Whether the radii of curvature of the body of a model are not known to be smooth functions of γ.
pub fn may_have_kinks(model: &Model) -> bool {
    is_smooth(model) == Some(false)
}

/// Whether the radii are seen to be smooth; `None` without a body.
fn is_smooth(model: &Model) -> Option<bool> {
    let body = model.system.body()?;
    let mut extents: Vec<Extent> = model.parameter_draws().iter().map(Draw::extent).collect();
    let unit = Extent::between(&Rational::from(-1), &Rational::from(1));
    extents.extend([unit; 3]);
    let recorded = record(extents.len(), |inputs| {
        let (free, gamma) = model.make_parameters(inputs);
        let mut state = vec![Expr::one(); model.dimension()];
        let place = 3 * NORMAL;
        state.get_mut(place..place + 3)?.copy_from_slice(gamma);
        let phase = Phase::new(model, &free, &state);
        let (sum, product) = body.radii(&phase.configuration);
        let square = gamma.iter().fold(-Expr::one(), |sum, x| sum + x.powi(2));
        Some(([sum, product], [square, -square]))
    });
    let (graph, (radii, sphere)) = match recorded {
        Ok((graph, Some(found))) => (graph, found),
        _ => return None,
    };
    let is_nonzero = |value: &Expr| is_nowhere_zero(&graph, &extents, &sphere, &[*value]);
    Some(corners(&graph, &radii).iter().all(is_nonzero))
}

/// Lists the values whose zeros are poles or corners of others.
fn corners(graph: &Graph, values: &[Expr]) -> Vec<Expr> {
    let reached = graph.reached(values.iter().copied());
    let steps = graph.steps().zip(&reached).filter(|(_, reached)| **reached);
    let modulus = |(step, _): (Step<'_>, &bool)| match step {
        Step::Unary(UnaryFunction::Abs, a) => Some(a),
        _ => None,
    };
    let found = graph.needs(&reached).map(|(place, _)| place).chain(steps.filter_map(modulus));
    found.filter(|a| !matches!(graph.step(*a), Step::Constant(_))).map(|a| graph.at(a)).collect()
}
