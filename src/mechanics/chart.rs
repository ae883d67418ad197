//! Charts of level sets: exact maps from free numbers to states, in any domain.
//!
//! A chart makes the *point* only. Derivatives are taken in the ambient variables, and the chart's
//! formulas are substituted afterwards: differentiation along the chart would give another
//! quantity.

use nalgebra::Vector3;

use super::model::Model;
use super::phase::Phase;
use super::recipe::{Draw, NumberLine, Range};
use crate::formula::Formula;
use crate::scalar::Scalar;

/// A map from draws to states.
#[derive(Clone, Debug)]
pub enum Chart {
    /// Chart of the rubber systems: γ = s(2u, 2v, 1 - u² - v²)/(1 + u² + v²), ω = γ×a + tγ, where
    /// s = 1 on γ² = 1 and t = 0 on (ω,γ) = 0.
    Rolling,
    /// Chart of a ball on a surface and of a body that may spin: M or ω free, γ as for the rubber
    /// systems.
    Sphere,
    /// Independent components of the state; there is no level set, or it does not apply.
    Free,
    /// A parametrisation given by the user.
    Given(Box<GivenChart>),
    /// Solution of the level's equations.
    Equations,
}

/// A parametrisation given by the user.
#[derive(Clone, Debug)]
pub struct GivenChart {
    /// Model whose state is the chart's inputs and whose parameters are the case's.
    pub model: Model,
    /// Draws of the inputs' components.
    pub draws: Vec<Draw>,
    /// One formula for each state variable.
    pub formulas: Vec<Formula>,
}

impl Chart {
    /// Returns the draws that make a state; `kept[i]` tells whether level equation i is to hold.
    pub fn draws(&self, free: &[Draw], kept: &[bool]) -> Vec<Draw> {
        match self {
            Chart::Rolling | Chart::Sphere => {
                let of =
                    |line, low, high, count| vec![Draw::Of(line, Range::between(low, high)); count];
                let mut draws = of(NumberLine::Directions, (-8, 5), (8, 5), 2);
                draws.extend(of(NumberLine::All, (-2, 1), (2, 1), 3));
                // The length of γ, followed by the spin.
                for (kept, line) in kept.iter().zip([NumberLine::Positive, NumberLine::All]) {
                    draws.extend(of(line, (1, 2), (3, 2), usize::from(!kept)));
                }
                draws.extend(free.iter().cloned());
                draws
            }
            Chart::Given(chart) if kept.iter().all(|kept| *kept) => chart.draws.clone(),
            _ => free.to_vec(),
        }
    }

    /// Makes the state from draws.
    pub fn point<T: Scalar>(
        &self,
        model: &Model,
        kept: &[bool],
        parameters: &[T],
        draws: &[T],
    ) -> Vec<T> {
        let on_level = kept.iter().all(|kept| *kept);
        match self {
            Chart::Rolling | Chart::Sphere => on_sphere(self, kept, draws),
            Chart::Given(chart) if on_level => {
                let phase = Phase::with_parameters_of(&chart.model, model, parameters, draws);
                let value = |f| phase.evaluate_literally(f).components();
                chart.formulas.iter().flat_map(value).collect()
            }
            _ => draws.to_vec(),
        }
    }
}

/// Maps (u, v, a) to (ω, γ) with γ² = 1 and (ω,γ) = 0 by the chart of the rubber systems.
pub fn rolling_point<T: Scalar>(draws: [T; 5]) -> [T; 6] {
    let state = on_sphere(&Chart::Rolling, &[true, true], &draws);
    std::array::from_fn(|k| state[k])
}

fn on_sphere<T: Scalar>(chart: &Chart, kept: &[bool], draws: &[T]) -> Vec<T> {
    let [u, v, a1, a2, a3, others @ ..] = draws else { return draws.to_vec() };
    let mut others = others.iter();
    let mut unless = |kept: bool, default: T| {
        if kept { default } else { others.next().copied().unwrap_or(default) }
    };
    let mut kept = kept.iter().copied();
    let length = unless(kept.next().unwrap_or(true), T::one());
    let spin = unless(kept.next().unwrap_or(true), T::zero());
    let (one, two, square) = (T::one(), T::from(2.0), *u * *u + *v * *v);
    let scale = length / (one + square);
    let gamma = Vector3::new(two * *u, two * *v, one - square).map(|x| x * scale);
    let free = Vector3::new(*a1, *a2, *a3);
    let first = match chart {
        Chart::Sphere => free,
        _ => gamma.cross(&free) + gamma * spin,
    };
    first.iter().chain(gamma.iter()).chain(others).copied().collect()
}
