//! Bounds on the numerator of a value: its degree and the size of its coefficients in bits.
//!
//! A value is Num · Π q_f^e_f: a polynomial in the inputs times powers of factors. 1/X turns the
//! numerator of X into a further factor, named after the step X, with exponent -1; √X into one with
//! exponent 1/2. A product adds exponents; a sum takes the smallest exponent of each factor and
//! moves the rest into the numerators. With denominators multiplied out at every sum the bound for
//! L_vF₂ of a ball would be 2^19; with factors it is 66.
//!
//! docs/soundness.md, "Degrees".

use rustc_hash::{FxBuildHasher, FxHashMap};

use crate::graph::{Graph, Step};
use crate::number::{BinaryOperation, UnaryFunction};

/// Distribution of an input, from which the values that contain it are bounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InputDistribution {
    /// Any element of the prime field, with equal probability: degree 1.
    Uniform,
    /// 1 or -1.
    Sign,
}

/// Bounds on the numerator of a value, together with its factors.
#[derive(Clone, Copy, Debug)]
pub struct Bound {
    /// Bound on the degree; half-integers where roots are involved.
    pub degree: f64,
    /// Log₂ of a bound on the sum of the absolute coefficients.
    pub height: f64,
    /// Number of the list of factors.
    list: u32,
}

/// Number of the list without factors.
const NONE: u32 = 0;
/// Number of lists for which there is room from the beginning.
const USUAL: usize = 256;

/// Degree and height of a factor.
#[derive(Clone, Copy, Debug)]
struct FactorBound {
    degree: f64,
    height: f64,
}

/// Bounds for all steps of a graph.
pub struct Bounds {
    bounds: Vec<Option<Bound>>,
    factors: Vec<FactorBound>,
    lists: FactorLists,
    /// Degrees and heights of all factors of a list together, by list, once they were asked for.
    weights: Vec<Option<(f64, f64)>>,
    /// Factor that is the numerator of a step, by place.
    numerator_of: FxHashMap<usize, u32>,
}

/// Lists of factors with their exponents, by increasing factor, one behind the other.
struct FactorLists {
    entries: Vec<(u32, f64)>,
    /// Begin and end of each list.
    ranges: Vec<[usize; 2]>,
    /// Lists combined so far, by both and the rule: values of one formula mostly have the same few lists.
    combined: FxHashMap<u64, u32>,
}

/// Rule by which the exponents of two lists are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Combination {
    /// Those of a product: added.
    Sum,
    /// Those of a sum: the smaller one.
    Least,
}

impl Bounds {
    /// Bounds the reached steps; `None` for a step with a function that has no bound.
    pub fn of(graph: &Graph, reached: &[bool], sources: &[InputDistribution]) -> Self {
        let mut all = Self {
            bounds: Vec::with_capacity(reached.len()),
            factors: Vec::new(),
            lists: FactorLists::new(),
            weights: Vec::with_capacity(USUAL),
            numerator_of: FxHashMap::default(),
        };
        for (place, step) in graph.steps().enumerate() {
            let bound = if reached[place] { all.step(step, sources) } else { None };
            all.bounds.push(bound);
        }
        all
    }

    /// Returns the bound of the step at a place.
    pub fn at(&self, place: usize) -> Option<&Bound> {
        self.bounds[place].as_ref()
    }

    /// Bounds degree and height of the numerator of the value at a place, with the factors that have
    /// positive exponents, as b in 1/(a/b), although a value without b is undefined.
    pub fn numerator(&self, place: usize) -> Option<(f64, f64)> {
        let bound = self.at(place)?;
        let above = self.lists.at(bound.list).iter().filter(|(_, exponent)| *exponent > 0.0);
        Some(above.fold((bound.degree, bound.height), |(degree, height), (factor, exponent)| {
            let FactorBound { degree: d, height: h } = self.factors[*factor as usize];
            (degree + exponent * d, height + exponent * h)
        }))
    }

    /// Bounds degree and height of the numerator, and of the denominator, of the value at a place,
    /// with all factors multiplied out.
    pub fn multiplied_out(&self, place: usize) -> Option<(f64, f64)> {
        Some(self.expanded(self.at(place)?))
    }

    fn expanded(&self, bound: &Bound) -> (f64, f64) {
        let factors = self.lists.at(bound.list).iter();
        factors.fold((bound.degree, bound.height), |(degree, height), (f, e)| {
            let FactorBound { degree: d, height: h } = self.factors[*f as usize];
            (degree + e.abs() * d, height + e.abs() * h)
        })
    }

    /// Bounds degree and height of the numerator of the difference of any two values.
    pub fn of_differences(&self) -> (f64, f64) {
        let all = self.bounds.iter().flatten().map(|bound| self.expanded(bound));
        let largest = all.fold((0f64, 0f64), |(d, h), (e, i)| (d.max(e), h.max(i)));
        (2.0 * largest.0, 2.0 * largest.1 + 1.0)
    }

    fn step(&mut self, step: Step<'_>, sources: &[InputDistribution]) -> Option<Bound> {
        let plain = |degree: f64, height: f64| Bound { degree, height, list: NONE };
        Some(match step {
            Step::Constant(value) => {
                let [above, below] = value.part_bits();
                let mut bound = plain(0.0, above as f64);
                if below > 1 {
                    // A denominator is a factor of degree 0, so that sums share it.
                    let factor = self.factor(FactorBound { degree: 0.0, height: below as f64 });
                    bound.list = self.lists.push([(factor, -1.0)]);
                }
                bound
            }
            Step::Input(input) => match sources.get(input)? {
                InputDistribution::Uniform => plain(1.0, 0.0),
                InputDistribution::Sign => plain(0.0, 0.0),
            },
            Step::Unary(UnaryFunction::Neg | UnaryFunction::Abs, a) => *self.at(a)?,
            Step::Unary(UnaryFunction::Recip, a) => self.power(a, -1.0)?,
            Step::Unary(UnaryFunction::Sqrt, a) => self.power(a, 0.5)?,
            Step::Unary(..) | Step::Binary(BinaryOperation::Pow, ..) => return None,
            Step::Power(a, exponent) => {
                let exponent = exponent.to_f64().0;
                exponent.is_finite().then(|| self.power(a, exponent))??
            }
            Step::Binary(BinaryOperation::Mul, a, b) => {
                let (x, y) = (*self.at(a)?, *self.at(b)?);
                let list = match (x.list, y.list) {
                    (NONE, other) | (other, NONE) => other,
                    (a, b) => self.lists.combine(a, b, Combination::Sum),
                };
                Bound { degree: x.degree + y.degree, height: x.height + y.height, list }
            }
            Step::Binary(BinaryOperation::Add | BinaryOperation::Sub, a, b) => {
                let (x, y) = (*self.at(a)?, *self.at(b)?);
                self.sum(x, y)
            }
        })
    }

    fn sum(&mut self, x: Bound, y: Bound) -> Bound {
        if x.list == y.list {
            let height = added(x.height, y.height);
            return Bound { degree: x.degree.max(y.degree), height, list: x.list };
        }
        let list = self.lists.combine(x.list, y.list, Combination::Least);
        // The excess of a factor in a term over its exponent in the sum goes into the term's
        // numerator.
        let (kept_degree, kept_height) = self.weight(list);
        let mut expanded = |term: Bound| {
            let (degree, height) = self.weight(term.list);
            (term.degree + degree - kept_degree, term.height + height - kept_height)
        };
        let ((d, h), (e, i)) = (expanded(x), expanded(y));
        Bound { degree: d.max(e), height: added(h, i), list }
    }

    /// Adds up degrees and heights of the factors of a list, times their exponents.
    fn weight(&mut self, list: u32) -> (f64, f64) {
        if let Some(Some(known)) = self.weights.get(list as usize) {
            return *known;
        }
        let factors = self.lists.at(list).iter();
        let sum = factors.fold((0.0, 0.0), |(degree, height), (factor, exponent)| {
            let FactorBound { degree: d, height: h } = self.factors[*factor as usize];
            (degree + exponent * d, height + exponent * h)
        });
        if self.weights.len() <= list as usize {
            self.weights.resize(2 * self.lists.ranges.len(), None);
        }
        self.weights[list as usize] = Some(sum);
        sum
    }

    /// Bounds the value of the step at `place` to a power, which may be negative or fractional.
    fn power(&mut self, place: usize, exponent: f64) -> Option<Bound> {
        let base = *self.at(place)?;
        let next = self.factors.len() as u32;
        let name = *self.numerator_of.entry(place).or_insert(next);
        if name == next {
            self.factor(FactorBound { degree: base.degree, height: base.height });
        }
        let own = self.lists.at(base.list);
        let mut factors: Vec<(u32, f64)> = own.iter().map(|(f, e)| (*f, e * exponent)).collect();
        let at = factors.partition_point(|(f, _)| *f < name);
        factors.insert(at, (name, exponent));
        Some(Bound { degree: 0.0, height: 0.0, list: self.lists.push(factors) })
    }

    fn factor(&mut self, factor: FactorBound) -> u32 {
        self.factors.push(factor);
        self.factors.len() as u32 - 1
    }
}

/// Computes log₂(2^a + 2^b), rounded up.
fn added(a: f64, b: f64) -> f64 {
    a.max(b) + 1.0
}

impl FactorLists {
    /// Makes the list without factors.
    fn new() -> Self {
        let mut ranges = Vec::with_capacity(USUAL);
        ranges.push([0; 2]);
        let combined = FxHashMap::with_capacity_and_hasher(USUAL, FxBuildHasher);
        Self { entries: Vec::with_capacity(8 * USUAL), ranges, combined }
    }

    /// Returns a list.
    fn at(&self, list: u32) -> &[(u32, f64)] {
        let [start, end] = self.ranges[list as usize];
        &self.entries[start..end]
    }

    /// Adds a list.
    fn push(&mut self, factors: impl IntoIterator<Item = (u32, f64)>) -> u32 {
        let start = self.entries.len();
        self.entries.extend(factors);
        self.finish(start)
    }

    /// Makes the entries from `start` on a list.
    fn finish(&mut self, start: usize) -> u32 {
        if start == self.entries.len() {
            return NONE;
        }
        self.ranges.push([start, self.entries.len()]);
        self.ranges.len() as u32 - 1
    }

    /// Combines exponents factor by factor; an absent factor has exponent 0.
    fn combine(&mut self, x: u32, y: u32, how: Combination) -> u32 {
        // Both ways of combining are symmetric; a graph has fewer than 2^31 lists.
        let key = u64::from(x.min(y)) << 33 | u64::from(x.max(y)) << 1 | how as u64;
        if let Some(list) = self.combined.get(&key) {
            return *list;
        }
        let start = self.entries.len();
        let ([mut i, left], [mut j, right]) = (self.ranges[x as usize], self.ranges[y as usize]);
        while i < left || j < right {
            let name_at =
                |at: usize, end: usize| if at < end { self.entries[at].0 } else { u32::MAX };
            let (a, b) = (name_at(i, left), name_at(j, right));
            let name = a.min(b);
            let (mut e, mut g) = (0.0, 0.0);
            if a == name {
                e = self.entries[i].1;
                i += 1;
            }
            if b == name {
                g = self.entries[j].1;
                j += 1;
            }
            let combined = match how {
                Combination::Sum => e + g,
                Combination::Least => f64::min(e, g),
            };
            if combined != 0.0 {
                self.entries.push((name, combined));
            }
        }
        let list = self.finish(start);
        self.combined.insert(key, list);
        list
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Expr, record};
    use num_dual::DualNum;

    fn degree(inputs: usize, build: impl FnOnce(&[Expr]) -> Expr) -> f64 {
        let (graph, value) = record(inputs, build).expect("records");
        let reached = graph.reached([value]);
        let bounds = Bounds::of(&graph, &reached, &vec![InputDistribution::Uniform; inputs]);
        bounds.at(graph.place(value)).expect("an algebraic value").degree
    }

    #[test]
    fn shared_denominators_are_counted_once() {
        let sum = degree(2, |x| {
            let q = (x[0] * x[0] + x[1]).recip();
            (0..20).fold(x[0] * q, |sum, _| sum * x[1] + x[0] * q)
        });
        assert_eq!(sum, 21.0, "(Σ x y^k) q: no power of q is multiplied out");
        assert_eq!(degree(2, |x| x[0].recip() + x[1].recip()), 1.0, "(x + y)/(xy)");
        assert_eq!(degree(1, |x| (x[0].recip() + 1.0).recip() + x[0]), 2.0, "(x + x + x²)/(1 + x)");
    }

    #[test]
    fn roots_count_half() {
        assert_eq!(degree(2, |x| x[0].sqrt() + x[1]), 1.0, "√x + y");
        assert_eq!(degree(2, |x| (x[0] + x[1] * x[1]).sqrt() * x[0] + x[1]), 2.0, "x √(x + y²)");
    }
}
