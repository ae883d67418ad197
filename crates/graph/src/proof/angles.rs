//! Sines and cosines of sums with arctangents.
//!
//! The cosine and the sine of E = R + Σ n_j atan u_j are the parts of the complex number e^(iR) Π z_j^n_j,
//! z_j = (1 + i u_j)/√(1 + u_j²), at all real u_j. Multiples of π/60, as 4/3 atan 1 = π/3, are turned by numbers
//! made of √2, √3, √5 and √(10 − 2√5).

use rustc_hash::FxHashMap;

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

use super::rewrite::Rewrite;

/// Largest multiple of an arctangent that is written out.
const LARGEST_MULTIPLE: i64 = 16;
/// Largest number of terms of a sum that is taken apart.
const MOST_TERMS: usize = 64;

/// An angle as a sum with arctangents.
#[derive(Clone, Debug)]
pub struct Angle {
    /// Places of the u_j with the n_j.
    arctangents: Vec<(usize, i64)>,
    /// Places of the terms of R with their multiples.
    rest: Vec<(usize, Rational)>,
    /// Places of factors of π/4 in the other terms of R, with their multiples.
    turns: Vec<(usize, Rational)>,
    /// Number of sixtieths of π.
    sixtieths: i64,
    /// Whether π occurs in it.
    has_quarter: bool,
}

/// A part of a sum: a place, its multiple, and whether it is a factor of π/4.
type Part = (usize, Rational, bool);

/// Lists the sums with arctangents whose sines and cosines some values need.
pub fn angles(graph: &Graph, values: &[Expr]) -> Vec<Rewrite> {
    let rewrite = |(argument, angle): (usize, Angle)| Rewrite::Angle { argument, angle };
    taken_apart(graph, values).map(rewrite).collect()
}

/// Records values anew, with sines and cosines of sums with arctangents written out.
pub fn without_arctangents(graph: &Graph, values: &[Expr]) -> Result<(Graph, Vec<Expr>), Fault> {
    let sums: FxHashMap<usize, Angle> = taken_apart(graph, values).collect();
    let reached = graph.reached(values.iter().copied());
    record(graph.inputs(), |inputs| {
        let replayed = graph.replay(&reached, inputs, |_, step, replayed| match step {
            Step::Unary(function @ (UnaryFunction::Sin | UnaryFunction::Cos), a) => {
                sums.get(&a)?.value(function == UnaryFunction::Sin, replayed)
            }
            _ => None,
        });
        let value = |value: &Expr| replayed[graph.place(*value)].unwrap_or_else(Expr::undefined);
        values.iter().map(value).collect()
    })
}

/// Lists the arguments of sines and cosines that are sums to be written out. Sixtieths of π are not, where π occurs in
/// other parts, too: cos 2π/9 = 2 cos² π/9 − 1 is a relation between the sums as they are.
fn taken_apart(graph: &Graph, values: &[Expr]) -> impl Iterator<Item = (usize, Angle)> {
    let arguments = arguments(graph, values);
    let taken = |distributes: bool| -> Vec<(usize, Angle)> {
        let all = arguments.iter().copied();
        all.filter_map(|own| Some((own, Angle::of(graph, own, distributes)?))).collect()
    };
    let mut all = taken(true);
    let has_others = all.iter().any(|(_, angle)| angle.has_other_part(graph));
    if has_others {
        all = taken(false);
    }
    let is_broken = !has_others
        && all.iter().any(|(_, own)| own.has_broken_part() || !own.arctangents.is_empty());
    // All are written alike then: 2(x + π/4) is 2x + π/2.
    let is_asked = move |own: &Angle| !own.arctangents.is_empty() || is_broken && own.has_quarter;
    all.into_iter().filter(move |(_, angle)| is_asked(angle))
}

/// Whether a step is atan 1 = π/4.
fn is_one_eighth(graph: &Graph, step: Step<'_>) -> bool {
    match step {
        Step::Unary(UnaryFunction::Atan, a) => {
            matches!(graph.step(a), Step::Constant(value) if value.is_one())
        }
        _ => false,
    }
}

/// Returns the number by which a product of numbers and π/4 is a multiple of π/4.
fn quarters(graph: &Graph, place: usize) -> Option<Rational> {
    let number = |place: usize| match graph.step(place) {
        Step::Constant(value) => Some(value),
        _ => None,
    };
    match graph.step(place) {
        step if is_one_eighth(graph, step) => Some(Rational::from(1)),
        Step::Unary(UnaryFunction::Neg, a) => Some(-&quarters(graph, a)?),
        Step::Binary(BinaryOperation::Mul, a, b) => match (number(a), number(b)) {
            (Some(own), None) => Some(own * &quarters(graph, b)?),
            (None, Some(own)) => Some(own * &quarters(graph, a)?),
            _ => None,
        },
        _ => None,
    }
}

/// Lists the places of the arguments of sines and cosines that some values need.
pub fn arguments(graph: &Graph, values: &[Expr]) -> Vec<usize> {
    let reached = graph.reached(values.iter().copied());
    let mut found: Vec<usize> = Vec::new();
    for (step, _) in graph.steps().zip(&reached).filter(|(_, reached)| **reached) {
        if let Step::Unary(UnaryFunction::Sin | UnaryFunction::Cos, a) = step
            && !found.contains(&a)
        {
            found.push(a);
        }
    }
    found
}

impl Angle {
    /// Takes a sum apart, also one that is multiplied by π; `None` if it has too many terms.
    fn of(graph: &Graph, place: usize, distributes: bool) -> Option<Self> {
        let mut found = Self {
            arctangents: Vec::new(),
            rest: Vec::new(),
            turns: Vec::new(),
            sixtieths: 0,
            has_quarter: false,
        };
        let mut open: Vec<Part> = vec![(place, Rational::from(1), false)];
        while let Some(part) = open.pop() {
            let terms = found.arctangents.len() + found.rest.len() + found.turns.len();
            if terms + open.len() > MOST_TERMS {
                return None;
            }
            found.include(graph, part, &mut open, distributes);
        }
        Some(found)
    }

    /// Includes a part of a sum, or opens the parts of which it is made.
    fn include(
        &mut self,
        graph: &Graph,
        (at, factor, of_quarter): Part,
        open: &mut Vec<Part>,
        distributes: bool,
    ) {
        let number = |place: usize| match graph.step(place) {
            Step::Constant(value) => Some(value),
            _ => None,
        };
        let step = graph.step(at);
        let own_quarters = match step {
            Step::Constant(value) if of_quarter => Some(&factor * value),
            step if !of_quarter && is_one_eighth(graph, step) => Some(factor.clone()),
            _ => None,
        };
        self.has_quarter |= of_quarter || own_quarters.is_some();
        if own_quarters.is_some_and(|quarters| self.has_included(&quarters)) {
            return;
        }
        match step {
            Step::Binary(BinaryOperation::Add, a, b) => {
                open.extend([(b, factor.clone(), of_quarter), (a, factor, of_quarter)]);
                return;
            }
            Step::Binary(BinaryOperation::Sub, a, b) => {
                open.extend([(b, -&factor, of_quarter), (a, factor, of_quarter)]);
                return;
            }
            Step::Unary(UnaryFunction::Neg, a) => return open.push((a, -&factor, of_quarter)),
            Step::Binary(BinaryOperation::Mul, a, b) => {
                for (a, b) in [(a, b), (b, a)] {
                    if let Some(own) = number(a) {
                        return open.push((b, &factor * own, of_quarter));
                    }
                    if distributes
                        && !of_quarter
                        && let Some(own) = quarters(graph, a)
                    {
                        return open.push((b, &factor * &own, true));
                    }
                }
            }
            Step::Unary(UnaryFunction::Atan, a) if !of_quarter && number(a).is_none() => {
                let multiple = factor.to_integer().filter(|n| n.abs() <= LARGEST_MULTIPLE);
                if let Some(multiple) = multiple {
                    return self.arctangents.push((a, multiple));
                }
            }
            _ => {}
        }
        match of_quarter {
            true => self.turns.push((at, factor)),
            false => self.rest.push((at, factor)),
        }
    }

    /// Includes a multiple of π/4 if it is one of π/60; a whole turn has 120 of these.
    fn has_included(&mut self, quarters: &Rational) -> bool {
        let sixtieths = (quarters * &Rational::from(15)).to_integer();
        if let Some(own) = sixtieths {
            self.sixtieths = (self.sixtieths + own % 120) % 120;
        }
        sixtieths.is_some()
    }

    /// Whether π occurs in parts that are no sixtieths of it.
    fn has_other_part(&self, graph: &Graph) -> bool {
        let is_number =
            |(place, _): &(usize, Rational)| matches!(graph.step(*place), Step::Constant(_));
        let rest = self.rest.iter().chain(&self.turns);
        let rest: Vec<Expr> = rest.map(|(place, _)| graph.at(*place)).collect();
        self.turns.iter().any(is_number) || graph.has_step(&rest, |step| is_one_eighth(graph, step))
    }

    /// Whether it contains a broken part of a quarter turn.
    fn has_broken_part(&self) -> bool {
        self.sixtieths % 30 != 0
    }

    /// Records the sine or the cosine, from the values at places.
    pub fn value(&self, sine: bool, values: &[Option<Expr>]) -> Option<Expr> {
        let one = Expr::rational(&Rational::from(1));
        let mut point = [one, Expr::rational(&Rational::from(0))];
        if !self.rest.is_empty() || !self.turns.is_empty() {
            let mut angle = Expr::rational(&Rational::from(0));
            for (place, factor) in &self.rest {
                angle += values[*place]? * Expr::rational(factor);
            }
            let quarter = one.apply(UnaryFunction::Atan);
            for (place, factor) in &self.turns {
                angle += values[*place]? * (quarter * Expr::rational(factor));
            }
            point = [angle.apply(UnaryFunction::Cos), angle.apply(UnaryFunction::Sin)];
        }
        for (place, multiple) in &self.arctangents {
            let u = values[*place]?;
            let u = if *multiple < 0 { -u } else { u };
            let below = one + u * u;
            // z², which has no root.
            let double = [(one - u * u) / below, (u + u) / below];
            for _ in 0..multiple.abs() / 2 {
                point = turned(point, double);
            }
            if multiple % 2 != 0 {
                let root = below.apply(UnaryFunction::Sqrt);
                point = turned(point, [one / root, u / root]);
            }
        }
        Some(turned(point, sixtieths_of_pi(self.sixtieths))[usize::from(sine)])
    }
}

/// Turns a point of the circle by the angle of another.
fn turned([a, b]: [Expr; 2], [c, s]: [Expr; 2]) -> [Expr; 2] {
    [a * c - b * s, a * s + b * c]
}

/// Records the cosine and the sine of some sixtieths of π.
fn sixtieths_of_pi(count: i64) -> [Expr; 2] {
    // count = 5 twelfths + 12 fifths, as 5·5 = 1 mod 12.
    let twelfths = (5 * count).rem_euclid(12);
    match (count - 5 * twelfths) / 12 {
        0 => twelfths_of_pi(twelfths),
        fifths => turned(twelfths_of_pi(twelfths), fifths_of_pi(fifths)),
    }
}

/// Records the cosine and the sine of some fifths of π.
fn fifths_of_pi(count: i64) -> [Expr; 2] {
    let number = |above: i64, below: i64| Expr::rational(&Rational::new(above, below));
    let root = number(5, 1).apply(UnaryFunction::Sqrt);
    // 4 sin π/5; with √(10 + 2√5) = 8 sin 2π/5 it would make two roots that depend on each other.
    let side = (number(10, 1) - root * number(2, 1)).apply(UnaryFunction::Sqrt);
    let first = [(root + number(1, 1)) * number(1, 4), side * number(1, 4)];
    let second =
        [(root - number(1, 1)) * number(1, 4), side * (root + number(1, 1)) * number(1, 8)];
    let [c, s] = match count.rem_euclid(5) {
        0 => [number(1, 1), number(0, 1)],
        1 => first,
        2 => second,
        3 => [-second[0], second[1]],
        _ => [-first[0], first[1]],
    };
    match count.rem_euclid(10) < 5 {
        true => [c, s],
        false => [-c, -s],
    }
}

/// Records the cosine and the sine of some twelfths of π.
fn twelfths_of_pi(count: i64) -> [Expr; 2] {
    let number = |above: i64, below: i64| Expr::rational(&Rational::new(above, below));
    let root = |of: i64| number(of, 1).apply(UnaryFunction::Sqrt);
    let slanted = |side: Expr| root(2) * (root(3) + side) * number(1, 4);
    let [c, s] = match count.rem_euclid(6) {
        0 => [number(1, 1), number(0, 1)],
        1 => [slanted(number(1, 1)), slanted(number(-1, 1))],
        2 => [root(3) * number(1, 2), number(1, 2)],
        3 => [root(2) * number(1, 2), root(2) * number(1, 2)],
        4 => [number(1, 2), root(3) * number(1, 2)],
        _ => [slanted(number(-1, 1)), slanted(number(1, 1))],
    };
    match count.rem_euclid(24) / 6 {
        0 => [c, s],
        1 => [-s, c],
        2 => [-c, -s],
        _ => [s, -c],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Evaluator, Tape};
    use crate::number::float::Float;

    #[test]
    fn sixtieths_of_pi_are_those_of_the_circle() {
        for count in -130..130i64 {
            let (graph, point) = record(0, |_| sixtieths_of_pi(count)).expect("records");
            let tape = Tape::new(&graph, &point);
            let mut evaluator = Evaluator::new(&tape, Float::<1>);
            evaluator.run(&[]);
            let angle = count as f64 * std::f64::consts::PI / 60.0;
            let found: Vec<f64> = evaluator.outputs().map(|value| value[0]).collect();
            assert!((found[0] - angle.cos()).abs() < 1e-13, "cos {count}π/60");
            assert!((found[1] - angle.sin()).abs() < 1e-13, "sin {count}π/60");
        }
    }

    #[test]
    fn sums_with_broken_parts_of_a_quarter_turn_are_written_out() {
        let one = || Expr::rational(&Rational::from(1));
        let angle = |x: Expr, above, below| {
            x + one().apply(UnaryFunction::Atan) * Expr::rational(&Rational::new(above, below))
        };
        // x + π/3, and x + π/2, which has no broken part.
        for (above, below, is_broken) in [(4, 3, true), (2, 1, false), (1, 1, true), (1, 7, false)]
        {
            let (graph, value) = record(1, |x| angle(x[0], above, below).apply(UnaryFunction::Cos))
                .expect("records");
            assert_eq!(angles(&graph, &[value]).len(), usize::from(is_broken), "{above}/{below}");
            let (written, values) = without_arctangents(&graph, &[value]).expect("records");
            let of = |graph: &Graph, value: Expr| {
                let tape = Tape::new(graph, &[value]);
                let mut evaluator = Evaluator::new(&tape, Float::<1>);
                evaluator.run(&[[0.7]]);
                evaluator.output(0)[0]
            };
            let (ours, theirs) = (of(&graph, value), of(&written, values[0]));
            assert!((ours - theirs).abs() < 1e-14, "{above}/{below}: {ours} {theirs}");
        }
    }
}
