//! Bounds of values on a part of a region, forwards from the inputs and backwards from the facts.

use rustc_hash::FxHashMap;

use crate::graph::Step;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::extent::Extent;
use crate::proof::fact::SignFact;

use super::Region;

/// Number of passes over the steps, forwards and backwards.
const PASSES: usize = 3;

/// Intersects a bound with another, and tells whether it has changed.
fn narrow(bound: &mut Extent, other: Extent) -> bool {
    let common = bound.common(other);
    let is_narrower = common != *bound;
    *bound = common;
    is_narrower
}

impl Region<'_> {
    /// Bounds the reached values, by place; `None` where a fact cannot hold.
    pub(super) fn bounds(&self, reached: &[usize], part: &[Extent]) -> Option<Vec<Extent>> {
        let mut bounds = vec![Extent::ALL; self.graph.len()];
        for pass in 0..PASSES {
            self.forward(reached, part, &mut bounds);
            let mut is_narrower = false;
            for (place, fact) in self.facts {
                let bound = &mut bounds[*place];
                let within = bound.within(true);
                is_narrower |= within != *bound;
                *bound = within;
                let holds = match fact {
                    SignFact::Positive => bound.reaches_above_zero(),
                    SignFact::NotNegative => !bound.is_empty(),
                };
                if !holds {
                    return None;
                }
            }
            is_narrower |= self.share(reached, &mut bounds)?;
            // Where no bound has changed, a further pass changes none.
            if pass + 1 == PASSES || !(self.backward(reached, &mut bounds) || is_narrower) {
                break;
            }
        }
        let is_contradicted = |(place, fact): &(usize, SignFact)| match fact {
            SignFact::Positive => !bounds[*place].reaches_above_zero(),
            SignFact::NotNegative => bounds[*place].is_empty(),
        };
        (!self.facts.iter().any(is_contradicted)).then_some(bounds)
    }

    /// Bounds values from their arguments.
    pub(super) fn forward(&self, reached: &[usize], part: &[Extent], bounds: &mut [Extent]) {
        for place in reached {
            let step = self.graph.step(*place);
            let is_empty = step.arguments().any(|argument| bounds[argument].is_empty());
            let extent = match step {
                _ if is_empty => Extent::EMPTY,
                Step::Constant(value) => Extent::at(value),
                Step::Input(input) => part[input],
                Step::Unary(function, a) => bounds[a].unary(function),
                Step::Power(a, exponent) => bounds[a].power(exponent),
                Step::Binary(BinaryOperation::Add, a, b) => bounds[a].plus(bounds[b]),
                Step::Binary(BinaryOperation::Sub, a, b) => bounds[a].plus(bounds[b].negated()),
                Step::Binary(BinaryOperation::Mul, a, b) if a == b => bounds[a].square(),
                Step::Binary(BinaryOperation::Mul, a, b) => bounds[a].times(bounds[b]),
                Step::Binary(BinaryOperation::Pow, a, _) => match bounds[a].within(true).is_empty()
                {
                    true => Extent::EMPTY,
                    false => Extent::POSITIVE,
                },
            };
            let extent = match self.classes.is_zero(*place) {
                true => extent.common(Extent::ZERO),
                false => extent,
            };
            bounds[*place] = bounds[*place].common(extent);
        }
    }

    /// Intersects the bounds of equal and opposite values, and tells whether one has changed; `None` if
    /// nothing is left for a value that exists.
    fn share(&self, reached: &[usize], bounds: &mut [Extent]) -> Option<bool> {
        if self.classes.of.is_empty() {
            return Some(false);
        }
        let mut is_narrower = false;
        let mut common: FxHashMap<u32, Extent> = FxHashMap::default();
        let class = |place: usize| self.classes.of.get(place).copied().flatten();
        let turned = |extent: Extent, opposite: bool| match opposite {
            true => extent.negated(),
            false => extent,
        };
        for place in reached {
            let Some((name, opposite)) = class(*place) else { continue };
            let own = turned(bounds[*place], opposite);
            // A value that exists nowhere says nothing about values equal to it elsewhere.
            if own.is_empty() {
                continue;
            }
            common.entry(name).and_modify(|extent| *extent = extent.common(own)).or_insert(own);
        }
        for place in reached {
            let Some((name, opposite)) = class(*place) else { continue };
            let (Some(shared), false) = (common.get(&name), bounds[*place].is_empty()) else {
                continue;
            };
            if shared.is_empty() {
                return None;
            }
            is_narrower |= narrow(&mut bounds[*place], turned(*shared, opposite));
        }
        Some(is_narrower)
    }

    /// Bounds arguments from values; returns whether a bound has changed.
    fn backward(&self, reached: &[usize], bounds: &mut [Extent]) -> bool {
        let mut is_narrower = false;
        for place in reached.iter().rev() {
            let value = bounds[*place];
            if value.is_empty() {
                continue;
            }
            let step = self.graph.step(*place);
            let found = match step {
                Step::Unary(UnaryFunction::Neg, a) => [Some((a, value.negated())), None],
                Step::Unary(UnaryFunction::Recip, a) => [Some((a, value.reciprocal())), None],
                Step::Unary(UnaryFunction::Sqrt, a) => {
                    [Some((a, value.within(true).square())), None]
                }
                Step::Unary(UnaryFunction::Abs, a) => {
                    let size = value.within(true);
                    [Some((a, size.hull_with_opposite())), None]
                }
                Step::Unary(UnaryFunction::Ln, a) => [Some((a, Extent::POSITIVE)), None],
                Step::Power(a, exponent) if exponent.to_integer().is_none() => {
                    [Some((a, Extent::POSITIVE)), None]
                }
                Step::Binary(BinaryOperation::Pow, a, _) => [Some((a, Extent::POSITIVE)), None],
                Step::Binary(BinaryOperation::Add, a, b) if a != b => {
                    let (x, y) = (bounds[a], bounds[b]);
                    [Some((a, value.plus(y.negated()))), Some((b, value.plus(x.negated())))]
                }
                Step::Binary(BinaryOperation::Sub, a, b) if a != b => {
                    let (x, y) = (bounds[a], bounds[b]);
                    [Some((a, value.plus(y))), Some((b, x.plus(value.negated())))]
                }
                Step::Binary(BinaryOperation::Mul, a, b) if a == b => {
                    [Some((a, value.roots())), None]
                }
                Step::Binary(BinaryOperation::Mul, a, b) => {
                    [self.factor(value, bounds[b], b, a), self.factor(value, bounds[a], a, b)]
                }
                _ => [None, None],
            };
            for (argument, extent) in found.into_iter().flatten() {
                is_narrower |= narrow(&mut bounds[argument], extent);
            }
        }
        is_narrower
    }

    /// Bounds one factor of a product from the product and the other factor.
    fn factor(
        &self,
        product: Extent,
        other: Extent,
        place_of_other: usize,
        factor: usize,
    ) -> Option<(usize, Extent)> {
        if other.is_empty() {
            return None;
        }
        if other.excludes_zero() {
            return Some((factor, product.times(other.reciprocal())));
        }
        let (a, b) = (product.sign()?, other.sign()?);
        self.classes.is_nonzero(place_of_other).then(|| (factor, Extent::ALL.within(a == b)))
    }
}
