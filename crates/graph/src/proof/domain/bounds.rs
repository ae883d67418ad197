//! Bounds of values on a part of a region, forwards from the inputs and backwards from the facts.

use std::f64::consts::PI;

use rustc_hash::FxHashMap;

use crate::graph::{Kernel, with_widest_vectors};
use crate::number::UnaryFunction;
use crate::proof::extent::Extent;
use crate::proof::fact::SignFact;

use super::reach::{Changes, Reach, ReachedStep, Rule};
use super::signed::SignedProduct;

/// Number of passes over the steps, forwards and backwards.
const PASSES: usize = 3;

/// Intersects a bound with another, and tells whether it has changed.
#[inline(always)]
pub(super) fn narrow(bound: &mut Extent, other: Extent) -> bool {
    let common = bound.common(other);
    let is_narrower = common != *bound;
    *bound = common;
    is_narrower
}

/// Whether an angle is between −π and π.
pub(super) fn is_within_half_turns(angle: Extent) -> bool {
    angle.ends().is_some_and(|[low, high]| -PI <= low && high <= PI)
}

/// Bounds a value from its arguments.
#[inline(always)]
fn of_step(
    step: &ReachedStep<'_>,
    signed: &[SignedProduct],
    bounds: &[Extent],
    part: &[Extent],
) -> Extent {
    let extent = match step.rule {
        Rule::Constant(value) => value,
        Rule::Input(input) => part[input],
        Rule::Unary(_, a) | Rule::Power(a, _) | Rule::Square(a) if bounds[a].is_empty() => {
            Extent::EMPTY
        }
        Rule::Sum(a, b) | Rule::Difference(a, b) | Rule::Product(a, b) | Rule::Raised(a, b)
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
        Rule::Product(a, b) => match step.signed.and_then(|own| signed.get(own as usize)) {
            None => bounds[a].times(bounds[b]),
            Some(own) => own.within(bounds[a].times(bounds[b]), bounds),
        },
        Rule::Raised(a, _) => match bounds[a].within(true).is_empty() {
            true => Extent::EMPTY,
            false => Extent::POSITIVE,
        },
    };
    let extent = step.sign.map_or(extent, |sign| extent.within(sign));
    match step.is_zero {
        true => extent.common(Extent::ZERO),
        false => extent,
    }
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
        self.changes.begin(self.steps.len());
        let mut is_possible = true;
        with_widest_vectors(Passes { reach: self, part, both, is_possible: &mut is_possible });
        is_possible.then_some(&self.bounds[..])
    }

    #[inline(always)]
    fn pass(&mut self, part: &[Extent]) -> Option<()> {
        for pass in 0..PASSES {
            match pass {
                0 => self.forward(part),
                _ => self.forward_again(part),
            }
            let mut is_narrower = false;
            for (number, fact) in &self.facts {
                let bound = &mut self.bounds[*number];
                let within = bound.within(true);
                if within != *bound {
                    is_narrower = true;
                    self.changes.note(*number);
                }
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
            is_narrower |= self.follow_links();
            // Where no bound has changed, a further pass changes none.
            if pass + 1 == PASSES || !(self.backward(pass == 0) || is_narrower) {
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
        let Self { steps, signed, bounds, .. } = self;
        for (number, step) in steps.iter().enumerate() {
            bounds[number] = bounds[number].common(of_step(step, signed, bounds, part));
        }
    }

    /// Bounds again the values whose arguments have changed since, as the others stay what they are.
    #[inline(always)]
    fn forward_again(&mut self, part: &[Extent]) {
        let Self { steps, signed, bounds, changes, .. } = self;
        for (number, step) in steps.iter().enumerate() {
            let Some([a, b]) = step.rule.arguments() else { continue };
            if changes.last[a].max(changes.last[b]) <= changes.forward[number] {
                continue;
            }
            changes.forward[number] = changes.count;
            let extent = of_step(step, signed, bounds, part);
            if narrow(&mut bounds[number], extent) {
                changes.note(number);
            }
        }
    }

    /// Intersects the bounds of equal and opposite values, and tells whether one has changed; `None` if
    /// nothing is left for a value that exists.
    fn share(&mut self) -> Option<bool> {
        let Self { region, places, bounds, changes, .. } = self;
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
        for (number, (bound, place)) in bounds.iter_mut().zip(&*places).enumerate() {
            let Some((name, opposite)) = class(*place) else { continue };
            let (Some(shared), false) = (common.get(&name), bound.is_empty()) else {
                continue;
            };
            if shared.is_empty() {
                return None;
            }
            if narrow(bound, turned(*shared, opposite)) {
                is_narrower = true;
                changes.note(number);
            }
        }
        Some(is_narrower)
    }

    /// Bounds arguments from values, after the first pass from those that have changed since; returns
    /// whether a bound has changed.
    #[inline(always)]
    fn backward(&mut self, is_first: bool) -> bool {
        let mut is_narrower = false;
        for number in (0..self.steps.len()).rev() {
            let Some([a, b]) = self.steps[number].rule.arguments() else { continue };
            let Changes { last, backward, count, .. } = &mut self.changes;
            if !is_first && last[number].max(last[a]).max(last[b]) <= backward[number] {
                continue;
            }
            backward[number] = *count;
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
                    let inverse = exponent.recip().map(|own| value.within(true).power(&own));
                    [Some((a, inverse.unwrap_or(Extent::POSITIVE).within(true))), None]
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
                if narrow(&mut self.bounds[argument], extent) {
                    is_narrower = true;
                    self.changes.note(argument);
                }
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

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::{Expr, Graph, record};
    use crate::number::prime::Modulus;
    use crate::proof::ProofRng;
    use crate::proof::classes::Classes;
    use crate::scalar::Scalar;

    use super::super::Region;

    impl Reach<'_> {
        /// Bounds with every step looked at in every pass.
        fn looked_at_always(&mut self, part: &[Extent]) -> Option<Vec<Extent>> {
            self.bounds.clear();
            self.bounds.resize(self.steps.len(), Extent::ALL);
            self.changes.begin(self.steps.len());
            for pass in 0..PASSES {
                self.forward(part);
                for (number, fact) in &self.facts {
                    self.bounds[*number] = self.bounds[*number].within(true);
                    let bound = self.bounds[*number];
                    let is_above = bound.reaches_above_zero();
                    if bound.is_empty() || *fact == SignFact::Positive && !is_above {
                        return None;
                    }
                }
                self.share()?;
                self.follow_links();
                if pass + 1 < PASSES {
                    self.backward(true);
                }
            }
            Some(self.bounds.clone())
        }
    }

    /// A graph of random operations on three inputs.
    fn random(seed: u64) -> (Graph, Vec<Expr>) {
        let (mut rng, modulus) = (ProofRng::new(seed, 0), Modulus::new((1 << 61) - 1));
        let mut draw = |n: usize| (rng.element(&modulus) % n as u64) as usize;
        record(3, |inputs| {
            let mut values = inputs.to_vec();
            for _ in 0..40 {
                let (a, b) = (values[draw(values.len())], values[draw(values.len())]);
                values.push(match draw(9) {
                    0 | 1 => a + b,
                    2 | 3 => a - b,
                    4 | 5 => a * b,
                    6 => a.recip(),
                    7 => a.sqrt(),
                    _ => a.modulus(),
                });
            }
            values
        })
        .expect("records")
    }

    #[test]
    fn what_nothing_has_changed_need_not_be_looked_at() {
        let (mut possible, mut narrower) = (0, 0);
        for seed in 0..300 {
            let (graph, values) = random(seed);
            let place = |k: usize| graph.place(values[values.len() - k]);
            let facts = [(place(1), SignFact::NotNegative), (place(2), SignFact::Positive)];
            let (inputs, classes) = (&[], &Classes::default());
            let region = Region { graph: &graph, inputs, facts: &facts, classes };
            let mut reach = Reach::new(&region, &[place(3)]);
            let end = |n: i64| crate::number::rational::Rational::from(n);
            let part = [(-1, 2), (1, 3), (-2, 0)].map(|(a, b)| Extent::between(&end(a), &end(b)));
            let all = reach.looked_at_always(&part);
            let own = reach.bounds(&part).map(<[Extent]>::to_vec);
            assert_eq!(own.is_some(), all.is_some(), "seed {seed}");
            if let (Some(own), Some(all)) = (own, all) {
                possible += 1;
                narrower += usize::from(own != reach.bounds_of_inputs(&part));
                assert_eq!(own, all, "seed {seed}");
            }
        }
        assert!(possible > 50 && narrower > 20, "{possible} and {narrower}");
    }
}
