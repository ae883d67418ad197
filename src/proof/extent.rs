//! The signs of values over all real inputs of given extents, by interval arithmetic.
//!
//! An [`Extent`] is a closed interval with f64 ends, or infinite ones. Every operation returns one
//! that contains all results: ends are computed in f64 and moved outwards by one step (elementary
//! functions of `libm`, whose error is below one unit in the last place, by two). A product of a
//! value with itself is a square. Where no input gives a result the extent is *empty*.
//!
//! A value that is unknown over the whole box is looked at on parts of it.

use crate::graph::{Graph, Step};
use crate::number::rational::Rational;
use crate::number::{Function, Operation};

/// Parts of the box on which one value is looked at.
const MOST_PARTS: usize = 64;

/// All numbers between two ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    low: f64,
    high: f64,
}

impl Extent {
    /// All real numbers.
    pub const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    /// All numbers that are not negative.
    pub const POSITIVE: Self = Self { low: 0.0, high: f64::INFINITY };
    /// What has no value.
    const EMPTY: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    /// The numbers from `low` to `high`.
    pub fn between(low: &Rational, high: &Rational) -> Self {
        Self { low: Self::at(low).low, high: Self::at(high).high }
    }

    /// One number.
    fn at(value: &Rational) -> Self {
        match value.to_f64() {
            (nearest, true) => Self { low: nearest, high: nearest },
            (nearest, false) => Self::outward(nearest, nearest),
        }
    }

    /// One step beyond two computed ends; no knowledge where one of them is no number.
    fn outward(low: f64, high: f64) -> Self {
        if low.is_nan() || high.is_nan() {
            return Self::ALL;
        }
        Self { low: low.next_down(), high: high.next_up() }
    }

    fn is_empty(self) -> bool {
        self.low > self.high
    }

    /// The sign of all numbers in it, if they have one; 0 goes with either.
    fn sign(self) -> Option<bool> {
        match (self.low >= 0.0, self.high <= 0.0) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }

    fn negated(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }

    fn modulus(self) -> Self {
        match self.sign() {
            Some(true) => self,
            Some(false) => self.negated(),
            None => Self { low: 0.0, high: self.high.max(-self.low) },
        }
    }

    fn plus(self, other: Self) -> Self {
        Self::outward(self.low + other.low, self.high + other.high)
    }

    fn times(self, other: Self) -> Self {
        // 0 · ∞ is 0: the end ∞ is not a number of the interval.
        let product = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let corners = [
            product(self.low, other.low),
            product(self.low, other.high),
            product(self.high, other.low),
            product(self.high, other.high),
        ];
        let low = corners.into_iter().fold(f64::INFINITY, f64::min);
        let high = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let wide = Self::outward(low, high);
        match (self.sign(), other.sign()) {
            (Some(a), Some(b)) => wide.within(a == b),
            _ => wide,
        }
    }

    /// That part of it which has this sign.
    fn within(self, positive: bool) -> Self {
        match positive {
            _ if self.is_empty() => self,
            true => Self { low: self.low.max(0.0), ..self },
            false => Self { high: self.high.min(0.0), ..self },
        }
    }

    fn square(self) -> Self {
        let Self { low, high } = self.modulus();
        Self::outward(low * low, high * high).within(true)
    }

    fn reciprocal(self) -> Self {
        match self.sign() {
            _ if self == (Self { low: 0.0, high: 0.0 }) => Self::EMPTY,
            None => Self::ALL,
            Some(true) => {
                // 1/0 is no end: what has a value there is not 0.
                let high = if self.low == 0.0 { f64::INFINITY } else { 1.0 / self.low };
                Self::outward(1.0 / self.high, high).within(true)
            }
            Some(false) => self.negated().reciprocal().negated(),
        }
    }

    /// An increasing function that is defined above `least`, and positive there if that is said.
    fn rising(self, least: f64, f: impl Fn(f64) -> f64) -> Self {
        if self.high < least {
            return Self::EMPTY;
        }
        let (low, high) = (f(self.low.max(least)), f(self.high));
        let once = Self::outward(low, high);
        Self::outward(once.low, once.high)
    }

    fn unary(self, function: Function) -> Self {
        let ball = |size: f64| Self { low: -size, high: size };
        match function {
            Function::Neg => self.negated(),
            Function::Abs => self.modulus(),
            Function::Recip => self.reciprocal(),
            Function::Sqrt => self.rising(0.0, f64::sqrt).within(true),
            Function::Exp => self.rising(f64::NEG_INFINITY, libm::exp).within(true),
            Function::Ln => self.rising(0.0, libm::log),
            Function::Sin | Function::Cos => ball(1.0),
            Function::Atan => ball(2.0),
        }
    }

    fn power(self, exponent: &Rational) -> Self {
        match exponent.to_integer() {
            // Roots and powers of what is positive are positive.
            None if self.high < 0.0 => Self::EMPTY,
            None => Self::POSITIVE,
            Some(n) if n % 2 == 0 => Self::POSITIVE,
            Some(_) => self.sign().map_or(Self::ALL, |positive| Self::ALL.within(positive)),
        }
    }
}

/// Where inputs can be, and which values are known not to be negative because a root of them is taken.
#[derive(Clone, Copy)]
pub struct Setting<'s> {
    /// The inputs in order; those beyond are any numbers.
    pub inputs: &'s [Extent],
    /// Places of values that are positive wherever all is real.
    pub positive: &'s [usize],
}

impl Setting<'_> {
    /// The sign that the value at a place has wherever it has one, but for states at which a
    /// positive value is 0; `None` where that is not known.
    pub fn sign(&self, graph: &Graph, place: usize) -> Option<bool> {
        let mut places = self.positive.to_vec();
        places.push(place);
        let reached = graph.reached_from(&places);
        let used: Vec<usize> = graph
            .steps()
            .zip(graph.reached_from(&[place]))
            .filter_map(|(step, reached)| match step {
                Step::Input(input) if reached => Some(input),
                _ => None,
            })
            .collect();
        let mut known: Option<bool> = None;
        let mut parts = vec![(self.whole(graph), 0)];
        let mut looked = 0;
        while let Some((part, depth)) = parts.pop() {
            looked += 1;
            let Some(extents) = self.extents(graph, &reached, &part) else { continue };
            match (extents[place].sign(), known) {
                _ if extents[place].is_empty() => {}
                (Some(sign), Some(before)) if sign != before => return None,
                (Some(sign), _) => known = Some(sign),
                (None, _) => {
                    if looked + parts.len() + 2 > MOST_PARTS || used.is_empty() {
                        return None;
                    }
                    let input = used[depth % used.len()];
                    let middle = middle(part[input])?;
                    let (mut lower, mut upper) = (part.clone(), part);
                    lower[input].high = middle;
                    upper[input].low = middle;
                    parts.push((upper, depth + 1));
                    parts.push((lower, depth + 1));
                }
            }
        }
        known
    }

    /// At which of the reached places the sign is known at first sight.
    pub fn at_sight(&self, graph: &Graph, reached: &[bool]) -> Vec<bool> {
        let extents = self.extents(graph, reached, &self.whole(graph)).unwrap_or_default();
        let known = |(extent, reached): (&Extent, &bool)| *reached && extent.sign().is_some();
        extents.iter().zip(reached).map(known).collect()
    }

    fn whole(&self, graph: &Graph) -> Vec<Extent> {
        let mut whole = self.inputs.to_vec();
        whole.resize(graph.inputs().max(self.inputs.len()), Extent::ALL);
        whole
    }

    /// What the values can be, by place; `None` where a positive one would be negative.
    fn extents(&self, graph: &Graph, reached: &[bool], inputs: &[Extent]) -> Option<Vec<Extent>> {
        let mut allowed: Vec<Option<bool>> = vec![None; reached.len()];
        let extents = forward(graph, reached, inputs, &allowed);
        if self.positive.is_empty() {
            return Some(extents);
        }
        self.positive.iter().for_each(|place| allowed[*place] = Some(true));
        backward(graph, reached, &extents, &mut allowed);
        let extents = forward(graph, reached, inputs, &allowed);
        self.positive.iter().all(|place| !extents[*place].is_empty()).then_some(extents)
    }
}

/// Where to cut.
fn middle(extent: Extent) -> Option<f64> {
    let Extent { low, high } = extent;
    let middle = match (low.is_finite(), high.is_finite()) {
        (true, true) => low + (high - low) / 2.0,
        (true, false) => 2.0 * low.max(0.0) + 1.0,
        (false, true) => 2.0 * high.min(0.0) - 1.0,
        (false, false) => 0.0,
    };
    (low < middle && middle < high).then_some(middle)
}

/// What the values can be, from the inputs on, those of an allowed sign having no other.
fn forward(
    graph: &Graph,
    reached: &[bool],
    inputs: &[Extent],
    allowed: &[Option<bool>],
) -> Vec<Extent> {
    let mut extents: Vec<Extent> = Vec::with_capacity(reached.len());
    for (place, step) in graph.steps().enumerate() {
        let of = |step: Step<'_>| {
            if step.arguments().any(|argument| extents[argument].is_empty()) {
                return Extent::EMPTY;
            }
            match step {
                Step::Constant(value) => Extent::at(value),
                Step::Input(input) => inputs[input],
                Step::Unary(function, a) => extents[a].unary(function),
                Step::Power(a, exponent) => extents[a].power(exponent),
                Step::Binary(Operation::Add, a, b) => extents[a].plus(extents[b]),
                Step::Binary(Operation::Sub, a, b) => extents[a].plus(extents[b].negated()),
                Step::Binary(Operation::Mul, a, b) if a == b => extents[a].square(),
                Step::Binary(Operation::Mul, a, b) => extents[a].times(extents[b]),
                Step::Binary(Operation::Pow, a, _) if extents[a].high < 0.0 => Extent::EMPTY,
                Step::Binary(Operation::Pow, ..) => Extent::POSITIVE,
            }
        };
        let extent = if reached[place] { of(step) } else { Extent::ALL };
        extents.push(allowed[place].map_or(extent, |positive| extent.within(positive)));
    }
    extents
}

/// Signs of arguments from signs of results: of -x, 1/x, and xy where the sign of one is known.
fn backward(graph: &Graph, reached: &[bool], extents: &[Extent], allowed: &mut [Option<bool>]) {
    for (place, step) in graph.steps().enumerate().rev() {
        let (Some(sign), true) = (allowed[place], reached[place]) else { continue };
        let of = |place: usize| allowed[place].or(extents[place].sign());
        let told = match step {
            Step::Unary(Function::Neg, a) => [Some((a, !sign)), None],
            Step::Unary(Function::Recip, a) => [Some((a, sign)), None],
            Step::Binary(Operation::Mul, a, b) if a != b => {
                [of(b).map(|other| (a, sign == other)), of(a).map(|other| (b, sign == other))]
            }
            _ => [None, None],
        };
        for (argument, sign) in told.into_iter().flatten() {
            allowed[argument].get_or_insert(sign);
        }
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::{Expr, record};
    use crate::scalar::Scalar;

    /// The sign over all inputs between these ends.
    fn sign_of(ends: &[(i64, i64)], build: impl FnOnce(&[Expr]) -> Expr) -> Option<bool> {
        let (graph, value) = record(ends.len(), build).expect("records");
        let end = |n: i64| Rational::from(n);
        let inputs: Vec<Extent> =
            ends.iter().map(|(low, high)| Extent::between(&end(*low), &end(*high))).collect();
        Setting { inputs: &inputs, positive: &[] }.sign(&graph, graph.place(value))
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
    fn what_is_under_a_root_is_positive() {
        let (graph, [radicand, factor]) =
            record(2, |x| [-(x[0] * x[1].recip()), x[1]]).expect("records");
        let inputs = [Extent::between(&Rational::from(-2), &Rational::from(-1))];
        let positive = [graph.place(radicand)];
        let sign =
            |positive| Setting { inputs: &inputs, positive }.sign(&graph, graph.place(factor));
        assert_eq!(sign(&[]), None, "any number");
        assert_eq!(sign(&positive), Some(true), "−x/y > 0 for x < 0");
    }

    #[test]
    fn numbers_beyond_f64_have_no_sign_by_accident() {
        let power = |x: &[Expr]| -(x[0].powi(1_000_000) - 1.0);
        assert_eq!(sign_of(&[(0, 2)], power), None, "1 − x^1000000 has both signs");
        assert_eq!(sign_of(&[(2, 3)], power), Some(false));
    }
}
