//! Ranges of draws, and guards that leave no state out of range.

use std::sync::Arc;

use num_dual::DualNum;

use crate::case::Case;
use crate::graph::{Expr, literally};
use crate::level::Solution;
use crate::mechanics::{Draw, DrawSource, NumberLine, Range};
use crate::number::rational::Rational;
use crate::proof::{Extent, narrowed};
use crate::scalar::Scalar;

use super::Sampler;
use super::attempts::KnownAttempts;

/// Returns the range of a drawn number.
pub fn extent(draw: &Draw) -> Extent {
    match draw {
        // Each value is substituted before anything is proved.
        Draw::OneOf(_) => Extent::ALL,
        other => other.extent(),
    }
}

/// Returns the distances of components determined by a level from the ends of their ranges.
pub fn ranges(case: &Case, solution: &Solution, made: &[Expr]) -> Vec<Expr> {
    let (parameters, state) = made.split_at(case.model.free_components());
    let recipes = case.model.parameter_draws();
    let of_state = solution.components().into_iter().map(|k| (state[k], &case.free_draws[k]));
    let of_parameters = solution.parameters().into_iter().filter_map(|k| {
        let draw = case.model.draw_of_component(k).and_then(|draw| recipes.get(draw))?;
        Some((parameters[k], draw))
    });
    let ends = of_state.chain(of_parameters).filter_map(|(value, draw)| match draw {
        Draw::Within(range) => {
            let [low, high] = [&range.low, &range.high].map(Expr::rational);
            Some([value - low, high - value])
        }
        _ => None,
    });
    ends.flatten().collect()
}

/// Returns the numbers of a range in f64, none of them outside of it; `None` for a whole line.
pub fn inside(draw: &Draw) -> Option<(f64, f64)> {
    let above = |end: &Rational| match end.to_f64() {
        (value, true) => value,
        (value, false) => value.next_up(),
    };
    let below = |end: &Rational| match end.to_f64() {
        (value, true) => value,
        (value, false) => value.next_down(),
    };
    match draw {
        Draw::Within(range) => Some((above(&range.low), below(&range.high))),
        Draw::Of(NumberLine::Positive, _) => Some((f64::MIN_POSITIVE, f64::INFINITY)),
        Draw::Of(NumberLine::All | NumberLine::Directions, _) | Draw::OneOf(_) | Draw::Sign => None,
    }
}

impl Sampler {
    /// Draws from those parts of the ranges alone in which bounds leave room for states.
    pub(super) fn narrowed(mut self) -> Self {
        let Some(extents) = narrowed(&self.graph, &self.extents(), &self.facts) else {
            return self;
        };
        for (draw, extent) in self.recipes.iter_mut().zip(extents) {
            if let (Draw::Within(range), Some(ends)) = (draw, extent.ends())
                && let Some([low, high]) = rounded(ends)
            {
                let (low, high) = (low.max(range.low.clone()), high.min(range.high.clone()));
                if low < high {
                    *range = Range { low, high };
                }
            }
        }
        self.draws = DrawSource::new(&self.recipes);
        self.first = Arc::default();
        self.attempts = KnownAttempts::default();
        self
    }
}

/// Rounds the ends of a range outwards to short binary fractions; `None` if it is very narrow.
fn rounded([low, high]: [f64; 2]) -> Option<[Rational; 2]> {
    const SHARE: f64 = 1.0 / 1024.0;
    const NARROWEST: f64 = 1e-12;
    if high - low < NARROWEST {
        return None;
    }
    // The largest power of two that is not above the share.
    let step = f64::from_bits(((high - low) * SHARE).to_bits() & f64::INFINITY.to_bits());
    let low = Rational::from_f64((low / step).floor() * step)?;
    let high = Rational::from_f64((high / step).ceil() * step)?;
    Some([low, high])
}

/// Makes parameters and state undefined where some values are negative: √x is undefined for x < 0.
pub fn guarded(made: &[Expr], facts: impl Iterator<Item = Expr>) -> Vec<Expr> {
    let mut guarded = made.to_vec();
    literally(|| {
        let zero = Expr::rational(&Rational::from(0));
        for fact in facts {
            if let Some(first) = guarded.last_mut() {
                *first += zero * fact.sqrt();
            }
        }
    });
    guarded
}
