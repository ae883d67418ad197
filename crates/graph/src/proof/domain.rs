//! Signs and bounds of values over the real inputs at which given values exist and have given
//! signs, and emptiness of such sets of inputs.
//!
//! Bounds are propagated from step to step of a graph in intervals, forwards from the inputs and
//! backwards from the facts. Two rules go beyond interval arithmetic:
//!
//! - values that are equal, or opposite, at random points of prime fields (see [`Classes`]) share
//!   their bounds;
//! - the signs of xy and y determine the sign of x, where y is not 0 at one of these points: its
//!   zeros then have no interior, and x has this sign everywhere else, thus everywhere in the
//!   closure.
//!
//! Without the proviso the second rule is wrong: y + |y| is 0 for all y < 0, and x (y + |y|) ≥ 0
//! says nothing about x there.

use std::collections::VecDeque;

use crate::graph::{Expr, Graph, Step};
use crate::number::{Function, Operation};

use super::classes::Classes;
use super::extent::Extent;
use super::rewrite::conditions;

/// Largest number of parts of the box on which one value is bounded.
const MOST_PARTS: usize = 64;
/// Largest number of parts of the box used to show that a value does not vanish.
const MOST_PIECES: usize = 1 << 12;
/// Number of passes over the steps, forwards and backwards.
const PASSES: usize = 3;

/// A sign that a value has wherever the claim is to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fact {
    /// x > 0
    Positive,
    /// x ≥ 0
    NotNegative,
}

/// The real inputs within some extents at which facts hold.
pub struct Region<'r> {
    /// Graph of the computation.
    pub graph: &'r Graph,
    /// Extents of the inputs in order; further inputs are unbounded.
    pub inputs: &'r [Extent],
    /// Places, and the signs of their values.
    pub facts: &'r [(usize, Fact)],
    /// Equal and opposite values.
    pub classes: &'r Classes,
}

/// Largest number of parts of a box that are searched for a point.
const MOST_BOXES: usize = 1 << 12;

/// Searches for a point inside the extents of some inputs at which some values are positive,
/// whatever the others do; `None` if none is found.
pub fn point(graph: &Graph, inputs: &[Extent], positive: &[usize]) -> Option<Vec<f64>> {
    let facts: Vec<(usize, Fact)> = positive.iter().map(|place| (*place, Fact::Positive)).collect();
    let classes = Classes::default();
    let region = Region { graph, inputs, facts: &facts, classes: &classes };
    let reached = region.reached(&[]);
    let used = region.inputs_of(&reached);
    let mut open = VecDeque::from([(region.whole(), 0)]);
    for _ in 0..MOST_BOXES {
        let (part, depth) = open.pop_front()?;
        if region.bounds(&reached, &part).is_none() {
            continue;
        }
        let mut bounds = vec![Extent::ALL; graph.len()];
        region.forward(&reached, &part, &mut bounds);
        if positive.iter().all(|place| bounds[*place].excludes_zero()) {
            return part.iter().map(|extent| extent.inside()).collect();
        }
        open.extend(region.cut(&used, part, depth).into_iter().flatten());
    }
    None
}

/// Whether some values are known to have no common zero inside the extents of the inputs where
/// others are not negative.
pub fn is_nowhere_zero(
    graph: &Graph,
    inputs: &[Extent],
    not_negative: &[Expr],
    values: &[Expr],
) -> bool {
    let classes = Classes::default();
    let fact = |value: &Expr| (graph.place(*value), Fact::NotNegative);
    let facts: Vec<(usize, Fact)> = not_negative.iter().map(fact).collect();
    let region = Region { graph, inputs, facts: &facts, classes: &classes };
    let places: Vec<usize> = values.iter().map(|value| graph.place(*value)).collect();
    let reached = region.reached(&places);
    let used = region.inputs_of(&reached);
    let mut open = vec![region.whole()];
    for _ in 0..MOST_PIECES {
        let Some(mut part) = open.pop() else { return true };
        let Some(bounds) = region.bounds(&reached, &part) else { continue };
        let vanishes =
            |place: &usize| !bounds[*place].excludes_zero() && !bounds[*place].is_empty();
        if !places.iter().all(vanishes) {
            continue;
        }
        // Start from the part of the inputs that the facts allow, the largest piece first.
        for at in &reached {
            if let Step::Input(input) = graph.step(*at) {
                part[input] = part[input].common(bounds[*at]);
            }
        }
        let spread = |input: &&usize| part[**input].spread();
        let widest = used.iter().max_by(|a, b| spread(a).total_cmp(&spread(b)));
        let Some((input, (low, high))) =
            widest.and_then(|input| Some((*input, part[*input].halves()?)))
        else {
            return false;
        };
        let mut upper = part.clone();
        (part[input], upper[input]) = (low, high);
        open.extend([upper, part]);
    }
    open.is_empty()
}

/// Finds the sign of a value at all inputs inside their extents at which some values exist, where 0
/// counts as either sign; `None` if unknown.
pub fn sign(graph: &Graph, inputs: &[Extent], required: &[Expr], value: Expr) -> Option<bool> {
    let facts = conditions(graph, &graph.reached(required.iter().copied()));
    let classes = Classes::default();
    Region { graph, inputs, facts: &facts, classes: &classes }.sign(graph.place(value))
}

impl Region<'_> {
    /// Whether the region is known to be empty.
    pub fn is_empty(&self) -> bool {
        let reached = self.reached(&[]);
        self.is_empty_on(&reached)
    }

    /// Whether the region is shown to be empty by bounds on the whole of it.
    pub fn is_empty_at_sight(&self) -> bool {
        self.bounds(&self.reached(&[]), &self.whole()).is_none()
    }

    fn is_empty_on(&self, reached: &[usize]) -> bool {
        let mut parts = vec![(self.whole(), 0)];
        let mut looked = 0;
        let used = self.inputs_of(reached);
        while let Some((part, depth)) = parts.pop() {
            looked += 1;
            if self.bounds(reached, &part).is_none() {
                continue;
            }
            match self.cut(&used, part, depth) {
                Some(halves) if looked + parts.len() + 2 <= MOST_PARTS => parts.extend(halves),
                _ => return false,
            }
        }
        true
    }

    /// Finds the sign of the value at a place over the region, wherever it exists, where 0 counts
    /// as either sign; `None` if unknown.
    pub fn sign(&self, place: usize) -> Option<bool> {
        let reached = self.reached(&[place]);
        let used = self.inputs_of(&reached);
        let mut known: Option<bool> = None;
        let mut parts = vec![(self.whole(), 0)];
        let mut looked = 0;
        while let Some((part, depth)) = parts.pop() {
            looked += 1;
            let Some(bounds) = self.bounds(&reached, &part) else { continue };
            let extent = bounds[place];
            match (extent.sign(), known) {
                _ if extent.is_empty() => {}
                (Some(sign), Some(before)) if sign != before => return None,
                (Some(sign), _) => known = Some(sign),
                (None, _) => match self.cut(&used, part, depth) {
                    Some(halves) if looked + parts.len() + 2 <= MOST_PARTS => parts.extend(halves),
                    _ => return None,
                },
            }
        }
        known
    }

    /// Marks the places whose sign follows from bounds on the whole region.
    pub fn at_sight(&self, outputs: &[usize]) -> Vec<bool> {
        let reached = self.reached(outputs);
        let mut known = vec![false; self.graph.len()];
        if let Some(bounds) = self.bounds(&reached, &self.whole()) {
            reached.iter().for_each(|place| known[*place] = bounds[*place].sign().is_some());
        }
        known
    }

    /// Lists the places that the facts and some others need, in order.
    fn reached(&self, others: &[usize]) -> Vec<usize> {
        let facts = self.facts.iter().map(|(place, _)| *place);
        let places: Vec<usize> = facts.chain(others.iter().copied()).collect();
        let reached = self.graph.reached_from(&places);
        (0..reached.len()).filter(|place| reached[*place]).collect()
    }

    fn inputs_of(&self, reached: &[usize]) -> Vec<usize> {
        let input = |place: &usize| match self.graph.step(*place) {
            Step::Input(input) => Some(input),
            _ => None,
        };
        reached.iter().filter_map(input).collect()
    }

    fn whole(&self) -> Vec<Extent> {
        let mut whole = self.inputs.to_vec();
        whole.resize(self.graph.inputs().max(self.inputs.len()), Extent::ALL);
        whole
    }

    /// Halves a part along one input after the other.
    fn cut(
        &self,
        used: &[usize],
        part: Vec<Extent>,
        depth: usize,
    ) -> Option<[(Vec<Extent>, usize); 2]> {
        let input = *used.get(depth % used.len().max(1))?;
        let (low, high) = part[input].halves()?;
        let (mut lower, mut upper) = (part.clone(), part);
        (lower[input], upper[input]) = (low, high);
        Some([(upper, depth + 1), (lower, depth + 1)])
    }

    /// Bounds the reached values, by place; `None` where a fact cannot hold.
    fn bounds(&self, reached: &[usize], part: &[Extent]) -> Option<Vec<Extent>> {
        let mut bounds = vec![Extent::ALL; self.graph.len()];
        for pass in 0..PASSES {
            self.forward(reached, part, &mut bounds);
            for (place, fact) in self.facts {
                let bound = &mut bounds[*place];
                *bound = bound.within(true);
                let holds = match fact {
                    Fact::Positive => bound.reaches_above_zero(),
                    Fact::NotNegative => !bound.is_empty(),
                };
                if !holds {
                    return None;
                }
            }
            if !self.share(reached, &mut bounds) {
                return None;
            }
            if pass + 1 < PASSES {
                self.backward(reached, &mut bounds);
            }
        }
        let is_contradicted = |(place, fact): &(usize, Fact)| match fact {
            Fact::Positive => !bounds[*place].reaches_above_zero(),
            Fact::NotNegative => bounds[*place].is_empty(),
        };
        (!self.facts.iter().any(is_contradicted)).then_some(bounds)
    }

    /// Bounds values from their arguments.
    fn forward(&self, reached: &[usize], part: &[Extent], bounds: &mut [Extent]) {
        for place in reached {
            let step = self.graph.step(*place);
            let is_empty = step.arguments().any(|argument| bounds[argument].is_empty());
            let extent = match step {
                _ if is_empty => Extent::EMPTY,
                Step::Constant(value) => Extent::at(value),
                Step::Input(input) => part[input],
                Step::Unary(function, a) => bounds[a].unary(function),
                Step::Power(a, exponent) => bounds[a].power(exponent),
                Step::Binary(Operation::Add, a, b) => bounds[a].plus(bounds[b]),
                Step::Binary(Operation::Sub, a, b) => bounds[a].plus(bounds[b].negated()),
                Step::Binary(Operation::Mul, a, b) if a == b => bounds[a].square(),
                Step::Binary(Operation::Mul, a, b) => bounds[a].times(bounds[b]),
                Step::Binary(Operation::Pow, a, _) => match bounds[a].within(true).is_empty() {
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

    /// Intersects the bounds of equal and opposite values; `false` if nothing is left for a value
    /// that exists.
    fn share(&self, reached: &[usize], bounds: &mut [Extent]) -> bool {
        if self.classes.of.is_empty() {
            return true;
        }
        let mut common: rustc_hash::FxHashMap<u32, Extent> = rustc_hash::FxHashMap::default();
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
                return false;
            }
            bounds[*place] = bounds[*place].common(turned(*shared, opposite));
        }
        true
    }

    /// Bounds arguments from values.
    fn backward(&self, reached: &[usize], bounds: &mut [Extent]) {
        for place in reached.iter().rev() {
            let value = bounds[*place];
            if value.is_empty() {
                continue;
            }
            let step = self.graph.step(*place);
            let found = match step {
                Step::Unary(Function::Neg, a) => [Some((a, value.negated())), None],
                Step::Unary(Function::Recip, a) => [Some((a, value.reciprocal())), None],
                Step::Unary(Function::Sqrt, a) => [Some((a, value.within(true).square())), None],
                Step::Unary(Function::Abs, a) => {
                    let size = value.within(true);
                    [Some((a, size.hull_with_opposite())), None]
                }
                Step::Unary(Function::Ln, a) => [Some((a, Extent::POSITIVE)), None],
                Step::Power(a, exponent) if exponent.to_integer().is_none() => {
                    [Some((a, Extent::POSITIVE)), None]
                }
                Step::Binary(Operation::Pow, a, _) => [Some((a, Extent::POSITIVE)), None],
                Step::Binary(Operation::Add, a, b) if a != b => {
                    let (x, y) = (bounds[a], bounds[b]);
                    [Some((a, value.plus(y.negated()))), Some((b, value.plus(x.negated())))]
                }
                Step::Binary(Operation::Sub, a, b) if a != b => {
                    let (x, y) = (bounds[a], bounds[b]);
                    [Some((a, value.plus(y))), Some((b, x.plus(value.negated())))]
                }
                Step::Binary(Operation::Mul, a, b) if a == b => [Some((a, value.roots())), None],
                Step::Binary(Operation::Mul, a, b) => {
                    [self.factor(value, bounds[b], b, a), self.factor(value, bounds[a], a, b)]
                }
                _ => [None, None],
            };
            for (argument, extent) in found.into_iter().flatten() {
                bounds[argument] = bounds[argument].common(extent);
            }
        }
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

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::record;
    use crate::number::rational::Rational;
    use crate::scalar::Scalar;

    /// Finds the sign over all inputs between these ends, where some values are not negative.
    fn sign_where(
        ends: &[(i64, i64)],
        build: impl FnOnce(&[Expr]) -> (Expr, Vec<Expr>),
    ) -> Option<bool> {
        let (graph, (value, facts)) = record(ends.len(), build).expect("records");
        let end = |n: i64| Rational::from(n);
        let inputs: Vec<Extent> =
            ends.iter().map(|(low, high)| Extent::between(&end(*low), &end(*high))).collect();
        let facts: Vec<(usize, Fact)> =
            facts.into_iter().map(|fact| (graph.place(fact), Fact::NotNegative)).collect();
        let classes = Classes::default();
        let region = Region { graph: &graph, inputs: &inputs, facts: &facts, classes: &classes };
        region.sign(graph.place(value))
    }

    fn sign_of(ends: &[(i64, i64)], build: impl FnOnce(&[Expr]) -> Expr) -> Option<bool> {
        sign_where(ends, |x| (build(x), Vec::new()))
    }

    fn number(text: &str) -> Expr {
        Expr::rational(&text.parse().expect("a number"))
    }

    #[test]
    fn a_sign_is_known_over_the_whole_box() {
        assert_eq!(sign_of(&[(1, 2)], |x| x[0]), Some(true));
        assert_eq!(sign_of(&[(-2, -1)], |x| x[0]), Some(false));
        assert_eq!(sign_of(&[(-2, 2)], |x| x[0] - number("1.9999999999")), None, "at the end");
        assert_eq!(sign_of(&[(0, 2)], |x| x[0]), Some(true), "0 goes with either sign");
        assert_eq!(sign_of(&[(1, 2), (3, 4)], |x| x[0] - x[1]), Some(false));
    }

    #[test]
    fn squares_and_roots_are_positive() {
        assert_eq!(sign_of(&[], |_| Expr::input() * number("2")), None, "any number");
        assert_eq!(sign_of(&[(-2, 2)], |x| x[0] * x[0]), Some(true));
        assert_eq!(sign_of(&[(-2, 2)], |x| (x[0] * x[0] + 1.0).recip()), Some(true));
        assert_eq!(sign_of(&[(-2, 2)], |x| x[0].exp() * x[0].sqrt()), Some(true));
        assert_eq!(sign_of(&[(-2, 2)], |x| -x[0].modulus()), Some(false));
        assert_eq!(sign_of(&[(-2, -1)], |x| x[0].sqrt()), None, "there is no such value");
    }

    #[test]
    fn parts_tell_what_the_whole_hides() {
        let parabola = |x: &[Expr]| x[0] * x[0] - x[0] + 1.0;
        assert_eq!(sign_of(&[(-2, 2)], parabola), Some(true), "x² − x + 1 > 0");
        let touching = |x: &[Expr]| x[0] * x[0] - x[0] + number("0.24");
        assert_eq!(sign_of(&[(-2, 2)], touching), None, "x² − x + 0.24 has two zeros");
    }

    #[test]
    fn facts_decide_signs() {
        let quotient = |x: &[Expr]| -(x[0] * x[1].recip());
        let factor = |x: &[Expr]| (x[1], vec![quotient(x)]);
        assert_eq!(sign_where(&[(-2, -1)], |x| (x[0].recip(), Vec::new())), Some(false));
        assert_eq!(sign_where(&[(-2, -1), (-9, 9)], |x| (x[1], Vec::new())), None, "any number");
        assert_eq!(sign_where(&[(-2, -1), (-9, 9)], factor), Some(true), "−x/y > 0 for x < 0");
        let sum = |x: &[Expr]| (x[0] + x[1], vec![x[0] - 1.0, x[1]]);
        assert_eq!(sign_where(&[(-9, 9), (-9, 9)], sum), Some(true), "x ≥ 1, y ≥ 0");
    }

    #[test]
    fn a_product_says_nothing_of_a_factor_whose_other_may_vanish() {
        let build = |x: &[Expr]| {
            let other = x[1] + x[1].modulus();
            (x[0], vec![x[0] * other.modulus()])
        };
        assert_eq!(sign_where(&[(-2, 2), (-2, 2)], build), None, "y + |y| = 0 for y < 0");
    }

    #[test]
    fn contradictions_are_seen() {
        let (graph, facts) = record(2, |x| [x[0] - x[1], x[1] - x[0] - 1.0]).expect("records");
        let inputs = [Extent::between(&Rational::from(0), &Rational::from(1)); 2];
        let facts = facts.map(|fact| (graph.place(fact), Fact::Positive));
        let classes = Classes::default();
        let region = Region { graph: &graph, inputs: &inputs, facts: &facts, classes: &classes };
        assert!(region.is_empty(), "x > y and y > x + 1");
        let one = &facts[..1];
        let region = Region { graph: &graph, inputs: &inputs, facts: one, classes: &classes };
        assert!(!region.is_empty(), "x > y alone");
        let inside = point(&graph, &inputs, &[facts[0].0]).expect("a point");
        assert!(inside[0] > inside[1], "{inside:?}");
    }

    #[test]
    fn numbers_beyond_f64_have_no_sign_by_accident() {
        let power = |x: &[Expr]| -(x[0].powi(1_000_000) - 1.0);
        assert_eq!(sign_of(&[(0, 2)], power), None, "1 − x^1000000 has both signs");
        assert_eq!(sign_of(&[(2, 3)], power), Some(false));
    }
}
