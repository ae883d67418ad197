//! Bounds of values on a part of a region, forwards from the inputs and backwards from the facts.

use rustc_hash::FxHashMap;

use crate::graph::{Kernel, with_widest_vectors};
use crate::number::UnaryFunction;
use crate::proof::extent::Extent;
use crate::proof::fact::SignFact;

use super::reach::{Reach, Rule};

/// Number of passes over the steps, forwards and backwards.
const PASSES: usize = 3;

/// Intersects a bound with another, and tells whether it has changed.
#[inline(always)]
fn narrow(bound: &mut Extent, other: Extent) -> bool {
    let common = bound.common(other);
    let is_narrower = common != *bound;
    *bound = common;
    is_narrower
}

/// Bounds on a part of a region.
struct Passes<'p, 'r> {
    reach: &'p mut Reach<'r>,
    part: &'p [Extent],
    /// Whether bounds narrow one another in both directions; otherwise they follow from the inputs.
    both: bool,
    is_possible: &'p mut bool,
}

impl Kernel for Passes<'_, '_> {
    #[inline(always)]
    fn run(self) {
        let Self { reach, part, both, is_possible } = self;
        *is_possible = match both {
            true => reach.pass(part).is_some(),
            false => {
                reach.forward(part);
                true
            }
        };
    }
}

impl Reach<'_> {
    /// Bounds the reached values, by number; `None` where a fact cannot hold.
    pub fn bounds(&mut self, part: &[Extent]) -> Option<&[Extent]> {
        self.passed(part, true)
    }

    /// Bounds the reached values from the inputs alone.
    pub fn bounds_of_inputs(&mut self, part: &[Extent]) -> &[Extent] {
        self.passed(part, false).unwrap_or_default()
    }

    fn passed(&mut self, part: &[Extent], both: bool) -> Option<&[Extent]> {
        self.bounds.clear();
        self.bounds.resize(self.steps.len(), Extent::ALL);
        let mut is_possible = true;
        with_widest_vectors(Passes { reach: self, part, both, is_possible: &mut is_possible });
        is_possible.then_some(&self.bounds[..])
    }

    #[inline(always)]
    fn pass(&mut self, part: &[Extent]) -> Option<()> {
        for pass in 0..PASSES {
            self.forward(part);
            let mut is_narrower = false;
            for (number, fact) in &self.facts {
                let bound = &mut self.bounds[*number];
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
            is_narrower |= self.share()?;
            // Where no bound has changed, a further pass changes none.
            if pass + 1 == PASSES || !(self.backward() || is_narrower) {
                break;
            }
        }
        for (number, fact) in &self.facts {
            let is_contradicted = match fact {
                SignFact::Positive => !self.bounds[*number].reaches_above_zero(),
                SignFact::NotNegative => self.bounds[*number].is_empty(),
            };
            if is_contradicted {
                return None;
            }
        }
        Some(())
    }

    /// Bounds values from their arguments.
    #[inline(always)]
    fn forward(&mut self, part: &[Extent]) {
        let bounds = &mut self.bounds[..];
        for (number, step) in self.steps.iter().enumerate() {
            let extent = match step.rule {
                Rule::Constant(value) => value,
                Rule::Input(input) => part[input],
                Rule::Unary(_, a) | Rule::Power(a, _) | Rule::Square(a) if bounds[a].is_empty() => {
                    Extent::EMPTY
                }
                Rule::Sum(a, b)
                | Rule::Difference(a, b)
                | Rule::Product(a, b)
                | Rule::Raised(a, b)
                    if bounds[a].is_empty() || bounds[b].is_empty() =>
                {
                    Extent::EMPTY
                }
                Rule::Unary(UnaryFunction::Neg, a) => bounds[a].negated(),
                Rule::Unary(function, a) => bounds[a].unary(function),
                Rule::Power(a, exponent) => bounds[a].power(exponent),
                Rule::Sum(a, b) => bounds[a].plus(bounds[b]),
                Rule::Difference(a, b) => bounds[a].plus(bounds[b].negated()),
                Rule::Square(a) => bounds[a].square(),
                Rule::Product(a, b) => bounds[a].times(bounds[b]),
                Rule::Raised(a, _) => match bounds[a].within(true).is_empty() {
                    true => Extent::EMPTY,
                    false => Extent::POSITIVE,
                },
            };
            let extent = match step.is_zero {
                true => extent.common(Extent::ZERO),
                false => extent,
            };
            bounds[number] = bounds[number].common(extent);
        }
    }

    /// Intersects the bounds of equal and opposite values, and tells whether one has changed; `None` if
    /// nothing is left for a value that exists.
    fn share(&mut self) -> Option<bool> {
        let Self { region, places, bounds, .. } = self;
        if region.classes.of.is_empty() {
            return Some(false);
        }
        let mut is_narrower = false;
        let mut common: FxHashMap<u32, Extent> = FxHashMap::default();
        let class = |place: usize| region.classes.of.get(place).copied().flatten();
        let turned = |extent: Extent, opposite: bool| match opposite {
            true => extent.negated(),
            false => extent,
        };
        for (bound, place) in bounds.iter().zip(&*places) {
            let Some((name, opposite)) = class(*place) else { continue };
            let own = turned(*bound, opposite);
            // A value that exists nowhere says nothing about values equal to it elsewhere.
            if own.is_empty() {
                continue;
            }
            common.entry(name).and_modify(|extent| *extent = extent.common(own)).or_insert(own);
        }
        for (bound, place) in bounds.iter_mut().zip(&*places) {
            let Some((name, opposite)) = class(*place) else { continue };
            let (Some(shared), false) = (common.get(&name), bound.is_empty()) else {
                continue;
            };
            if shared.is_empty() {
                return None;
            }
            is_narrower |= narrow(bound, turned(*shared, opposite));
        }
        Some(is_narrower)
    }

    /// Bounds arguments from values; returns whether a bound has changed.
    #[inline(always)]
    fn backward(&mut self) -> bool {
        let mut is_narrower = false;
        for number in (0..self.steps.len()).rev() {
            let value = self.bounds[number];
            if value.is_empty() {
                continue;
            }
            let bounds = &self.bounds;
            let found = match self.steps[number].rule {
                Rule::Constant(_) | Rule::Input(_) => continue,
                Rule::Unary(UnaryFunction::Neg, a) => [Some((a, value.negated())), None],
                Rule::Unary(UnaryFunction::Recip, a) => [Some((a, value.reciprocal())), None],
                Rule::Unary(UnaryFunction::Sqrt, a) => {
                    [Some((a, value.within(true).square())), None]
                }
                Rule::Unary(UnaryFunction::Abs, a) => {
                    let size = value.within(true);
                    [Some((a, size.hull_with_opposite())), None]
                }
                Rule::Unary(UnaryFunction::Ln, a) => [Some((a, Extent::POSITIVE)), None],
                Rule::Power(a, exponent) if exponent.to_integer().is_none() => {
                    [Some((a, Extent::POSITIVE)), None]
                }
                Rule::Raised(a, _) => [Some((a, Extent::POSITIVE)), None],
                Rule::Sum(a, b) if a != b => {
                    let (x, y) = (bounds[a], bounds[b]);
                    [Some((a, value.plus(y.negated()))), Some((b, value.plus(x.negated())))]
                }
                Rule::Difference(a, b) if a != b => {
                    let (x, y) = (bounds[a], bounds[b]);
                    [Some((a, value.plus(y))), Some((b, x.plus(value.negated())))]
                }
                Rule::Square(a) => [Some((a, value.roots())), None],
                Rule::Product(a, b) => [self.factor(value, b, a), self.factor(value, a, b)],
                _ => continue,
            };
            for (argument, extent) in found.into_iter().flatten() {
                is_narrower |= narrow(&mut self.bounds[argument], extent);
            }
        }
        is_narrower
    }

    /// Bounds one factor of a product from the product and the other factor.
    #[inline(always)]
    fn factor(&self, product: Extent, other: usize, factor: usize) -> Option<(usize, Extent)> {
        let (bound, is_nonzero) = (self.bounds[other], self.steps[other].is_nonzero);
        if bound.is_empty() {
            return None;
        }
        if bound.excludes_zero() {
            return Some((factor, product.times(bound.reciprocal())));
        }
        let (a, b) = (product.sign()?, bound.sign()?);
        is_nonzero.then(|| (factor, Extent::ALL.within(a == b)))
    }
}
