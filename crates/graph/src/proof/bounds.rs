//! Bounds on the numerator of a value: its degree and the size of its coefficients in bits.
//!
//! A value is Num · Π q_f^e_f: a polynomial in the inputs times powers of factors. 1/X turns the
//! numerator of X into a further factor, named after the step X, with exponent -1; √X into one with
//! exponent 1/2. A product adds exponents; a sum takes the smallest exponent of each factor and
//! moves the rest into the numerators. With denominators multiplied out at every sum the bound for
//! L_vF₂ of a ball would be 2^19; with factors it is 66.
//!
//! docs/soundness.md, "Degrees".

use std::rc::Rc;

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
#[derive(Clone, Debug)]
pub struct Bound {
    /// Bound on the degree; half-integers where roots are involved.
    pub degree: f64,
    /// Log₂ of a bound on the sum of the absolute coefficients.
    pub height: f64,
    /// Pairs of factor and exponent, by increasing factor.
    factors: Rc<[(u32, f64)]>,
}

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
    /// The factors of a value without any.
    none: Rc<[(u32, f64)]>,
    /// Factor that is the numerator of a step, by place.
    numerator_of: rustc_hash::FxHashMap<usize, u32>,
}

impl Bounds {
    /// Bounds the reached steps; `None` for a step with a function that has no bound.
    pub fn of(graph: &Graph, reached: &[bool], sources: &[InputDistribution]) -> Self {
        let mut all = Self {
            bounds: Vec::with_capacity(reached.len()),
            factors: Vec::new(),
            none: Rc::new([]),
            numerator_of: Default::default(),
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
        let above = bound.factors.iter().filter(|(_, exponent)| *exponent > 0.0);
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
        bound.factors.iter().fold((bound.degree, bound.height), |(degree, height), (f, e)| {
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
        let plain =
            |degree: f64, height: f64| Bound { degree, height, factors: Rc::clone(&self.none) };
        Some(match step {
            Step::Constant(value) => {
                let [above, below] = value.part_bits();
                let mut bound = plain(0.0, above as f64);
                if below > 1 {
                    // A denominator is a factor of degree 0, so that sums share it.
                    let factor = self.factor(FactorBound { degree: 0.0, height: below as f64 });
                    bound.factors = Rc::new([(factor, -1.0)]);
                }
                bound
            }
            Step::Input(input) => match sources.get(input)? {
                InputDistribution::Uniform => plain(1.0, 0.0),
                InputDistribution::Sign => plain(0.0, 0.0),
            },
            Step::Unary(UnaryFunction::Neg | UnaryFunction::Abs, a) => self.at(a)?.clone(),
            Step::Unary(UnaryFunction::Recip, a) => self.power(a, -1.0)?,
            Step::Unary(UnaryFunction::Sqrt, a) => self.power(a, 0.5)?,
            Step::Unary(..) | Step::Binary(BinaryOperation::Pow, ..) => return None,
            Step::Power(a, exponent) => {
                let exponent = exponent.to_f64().0;
                exponent.is_finite().then(|| self.power(a, exponent))??
            }
            Step::Binary(BinaryOperation::Mul, a, b) => {
                let (x, y) = (self.at(a)?, self.at(b)?);
                let (degree, height) = (x.degree + y.degree, x.height + y.height);
                let factors = match (x.factors.is_empty(), y.factors.is_empty()) {
                    (true, _) => Rc::clone(&y.factors),
                    (_, true) => Rc::clone(&x.factors),
                    _ => merged(&x.factors, &y.factors, |e, f| e + f),
                };
                Bound { degree, height, factors }
            }
            Step::Binary(BinaryOperation::Add | BinaryOperation::Sub, a, b) => {
                self.sum(self.at(a)?, self.at(b)?)
            }
        })
    }

    fn sum(&self, x: &Bound, y: &Bound) -> Bound {
        if Rc::ptr_eq(&x.factors, &y.factors) {
            let factors = Rc::clone(&x.factors);
            let height = added(x.height, y.height);
            return Bound { degree: x.degree.max(y.degree), height, factors };
        }
        let factors = merged(&x.factors, &y.factors, f64::min);
        // The excess of a factor in a term over its exponent in the sum goes into the term's
        // numerator.
        let weight = |factors: &[(u32, f64)]| {
            factors.iter().fold((0.0, 0.0), |(degree, height), (factor, exponent)| {
                let FactorBound { degree: d, height: h } = self.factors[*factor as usize];
                (degree + exponent * d, height + exponent * h)
            })
        };
        let (kept_degree, kept_height) = weight(&factors);
        let expanded = |term: &Bound| {
            let (degree, height) = weight(&term.factors);
            (term.degree + degree - kept_degree, term.height + height - kept_height)
        };
        let ((d, h), (e, i)) = (expanded(x), expanded(y));
        Bound { degree: d.max(e), height: added(h, i), factors }
    }

    /// Bounds the value of the step at `place` to a power, which may be negative or fractional.
    fn power(&mut self, place: usize, exponent: f64) -> Option<Bound> {
        let base = self.at(place)?.clone();
        let next = self.factors.len() as u32;
        let name = *self.numerator_of.entry(place).or_insert(next);
        if name == next {
            self.factor(FactorBound { degree: base.degree, height: base.height });
        }
        let mut factors: Vec<(u32, f64)> =
            base.factors.iter().map(|(f, e)| (*f, e * exponent)).collect();
        let at = factors.partition_point(|(f, _)| *f < name);
        factors.insert(at, (name, exponent));
        Some(Bound { degree: 0.0, height: 0.0, factors: factors.into() })
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

/// Combines exponents factor by factor; an absent factor has exponent 0.
fn merged(
    x: &Rc<[(u32, f64)]>,
    y: &Rc<[(u32, f64)]>,
    f: impl Fn(f64, f64) -> f64,
) -> Rc<[(u32, f64)]> {
    let (mut i, mut j) = (0, 0);
    let mut all = Vec::with_capacity(x.len() + y.len());
    while i < x.len() || j < y.len() {
        let (left, right) = (x.get(i), y.get(j));
        let name = match (left, right) {
            (Some((a, _)), Some((b, _))) => *a.min(b),
            (Some((a, _)), None) => *a,
            (None, Some((b, _))) => *b,
            (None, None) => break,
        };
        let exponent = |side: Option<&(u32, f64)>, at: &mut usize| {
            side.filter(|(f, _)| *f == name).map_or(0.0, |(_, e)| {
                *at += 1;
                *e
            })
        };
        let (e, g) = (exponent(left, &mut i), exponent(right, &mut j));
        let combined = f(e, g);
        if combined != 0.0 {
            all.push((name, combined));
        }
    }
    all.into()
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
