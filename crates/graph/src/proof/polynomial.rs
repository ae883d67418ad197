//! Sparse polynomials with rational coefficients, for square roots of radicands.
//!
//! A graph is read as a quotient of polynomials in its inputs and in further variables (other
//! roots, symbols). Large ones are given up: the aim is to find b in √(x² + 2x + 1) = |x + 1|, not
//! a normal form.

use std::collections::BTreeMap;

use crate::graph::{Expr, Graph, Step};
use crate::number::rational::Rational;
use crate::number::{Function, Operation};
use crate::scalar::Scalar;

/// Largest number of terms of a polynomial.
const MOST_TERMS: usize = 400;
/// Largest number of products of terms in reading one graph.
pub const MOST_WORK: usize = 400_000;
/// Largest size in bits of a coefficient.
const MOST_BITS: u64 = 2048;
/// Largest power that is multiplied out.
const MOST_POWER: i64 = 32;

/// Variables with their exponents, by increasing variable, no exponent 0.
type Exponents = Vec<(u32, u32)>;

/// A monomial, ordered lexicographically: x₀ above all powers of x₁, and so on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Monomial(Exponents);

impl Ord for Monomial {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let mut pairs = self.0.iter().zip(&other.0);
        let differ = pairs.find(|(a, b)| a != b);
        match differ {
            // The lower variable leads; of one variable, the higher power.
            Some(((i, e), (j, f))) => j.cmp(i).then(e.cmp(f)),
            None => self.0.len().cmp(&other.0.len()),
        }
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Monomial {
    fn times(&self, other: &Self) -> Self {
        let mut exponents: BTreeMap<u32, u32> = self.0.iter().copied().collect();
        for (variable, exponent) in &other.0 {
            *exponents.entry(*variable).or_insert(0) += exponent;
        }
        Self(exponents.into_iter().collect())
    }

    fn over(&self, other: &Self) -> Option<Self> {
        let mut exponents: BTreeMap<u32, u32> = self.0.iter().copied().collect();
        for (variable, exponent) in &other.0 {
            let own = exponents.get_mut(variable)?;
            *own = own.checked_sub(*exponent)?;
        }
        Some(Self(exponents.into_iter().filter(|(_, exponent)| *exponent > 0).collect()))
    }

    fn root(&self) -> Option<Self> {
        let halved = self.0.iter().map(|(variable, exponent)| {
            exponent.is_multiple_of(2).then_some((*variable, exponent / 2))
        });
        halved.collect::<Option<Exponents>>().map(Self)
    }
}

/// A polynomial with rational coefficients, none of them 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polynomial {
    terms: BTreeMap<Monomial, Rational>,
}

impl Polynomial {
    /// Makes a constant polynomial.
    pub fn constant(value: &Rational) -> Self {
        let mut polynomial = Self::default();
        polynomial.add_term(Monomial::default(), value);
        polynomial
    }

    /// Makes a variable.
    pub fn variable(number: u32) -> Self {
        Self { terms: [(Monomial(vec![(number, 1)]), Rational::from(1))].into() }
    }

    /// Returns the value of a constant polynomial.
    pub fn number(&self) -> Option<Rational> {
        match self.leading() {
            None => Some(Rational::from(0)),
            Some((monomial, value)) => monomial.0.is_empty().then(|| value.clone()),
        }
    }

    /// Number of terms.
    pub fn size(&self) -> usize {
        self.terms.len()
    }

    /// Whether the polynomial is 0.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    fn add_term(&mut self, monomial: Monomial, coefficient: &Rational) {
        let sum = match self.terms.get(&monomial) {
            Some(own) => own + coefficient,
            None => coefficient.clone(),
        };
        if sum.is_zero() {
            self.terms.remove(&monomial);
        } else {
            self.terms.insert(monomial, sum);
        }
    }

    /// Computes p + q.
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = self.clone();
        other.terms.iter().for_each(|(monomial, value)| sum.add_term(monomial.clone(), value));
        sum
    }

    /// Computes c p.
    pub fn scaled(&self, factor: &Rational) -> Self {
        let scaled = |(monomial, value): (&Monomial, &Rational)| (monomial.clone(), value * factor);
        let terms = self.terms.iter().map(scaled);
        Self { terms: terms.filter(|(_, value)| !value.is_zero()).collect() }
    }

    /// Computes p q; `None` if it is too large.
    pub fn times(&self, other: &Self, work: &mut usize) -> Option<Self> {
        *work = work.checked_sub(self.terms.len() * other.terms.len())?;
        let mut product = Self::default();
        for (a, x) in &self.terms {
            for (b, y) in &other.terms {
                product.add_term(a.times(b), &(x * y));
            }
        }
        product.checked()
    }

    fn checked(self) -> Option<Self> {
        let fits = self.terms.len() <= MOST_TERMS
            && self.terms.values().all(|value| value.bits() <= MOST_BITS);
        fits.then_some(self)
    }

    fn leading(&self) -> Option<(&Monomial, &Rational)> {
        self.terms.last_key_value()
    }

    /// Returns c and a monic b with p = c b².
    pub fn square(&self) -> Option<(Rational, Self)> {
        let (monomial, scale) = self.leading()?;
        let head = monomial.root()?;
        let target = self.scaled(&scale.recip()?);
        let mut root = Self { terms: [(head.clone(), Rational::from(1))].into() };
        let mut rest = target.plus(&root.times(&root, &mut { MOST_WORK })?.negated());
        let half = Rational::new(1, 2);
        // Each step removes the leading term of the rest, with the next term of the root.
        for _ in 0..MOST_TERMS {
            let Some((monomial, value)) = rest.leading() else {
                return Some((scale.clone(), root));
            };
            let next = monomial.over(&head)?;
            if next >= head {
                return None;
            }
            let term = Self { terms: [(next, value * &half)].into() };
            // (b + t)² = b² + (2b + t) t
            let doubled = root.scaled(&Rational::from(2)).plus(&term);
            rest = rest.plus(&doubled.times(&term, &mut { MOST_WORK })?.negated());
            root = root.plus(&term);
        }
        None
    }

    fn negated(&self) -> Self {
        self.scaled(&Rational::from(-1))
    }

    /// Returns p₀ and p₁ with p = p₀ + p₁ y for the variable y, whose square is `square`.
    pub fn split(&self, variable: u32, square: &Self) -> Option<[Self; 2]> {
        let mut parts = [Self::default(), Self::default()];
        let mut work = MOST_WORK;
        for (monomial, value) in &self.terms {
            let exponent = monomial.0.iter().find(|(v, _)| *v == variable).map_or(0, |(_, e)| *e);
            let without = monomial.0.iter().copied().filter(|(v, _)| *v != variable).collect();
            let mut term = Self { terms: [(Monomial(without), value.clone())].into() };
            for _ in 0..exponent / 2 {
                term = term.times(square, &mut work)?;
            }
            let part = &mut parts[exponent as usize % 2];
            *part = part.plus(&term);
        }
        let [even, odd] = parts;
        Some([even.checked()?, odd.checked()?])
    }

    /// Returns the variables that occur.
    pub fn variables(&self) -> Vec<u32> {
        let mut all: Vec<u32> =
            self.terms.keys().flat_map(|monomial| monomial.0.iter().map(|(v, _)| *v)).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Records the value from the values of the variables.
    pub fn value(&self, of: &impl Fn(u32) -> Option<Expr>) -> Option<Expr> {
        let mut sum = Expr::rational(&Rational::from(0));
        for (monomial, coefficient) in self.terms.iter().rev() {
            let mut term = Expr::rational(coefficient);
            for (variable, exponent) in &monomial.0 {
                term *= of(*variable)?.power(&Rational::from(i64::from(*exponent)));
            }
            sum += term;
        }
        Some(sum)
    }
}

/// A quotient p/q of polynomials.
#[derive(Clone, Debug)]
pub struct Fraction {
    /// Numerator p.
    pub above: Polynomial,
    /// Denominator q, not 0.
    pub below: Polynomial,
}

impl Fraction {
    fn whole(above: Polynomial) -> Self {
        Self { above, below: Polynomial::constant(&Rational::from(1)) }
    }

    /// Returns c, and p and q such that the fraction is c (p/q)².
    pub fn square(&self) -> Option<(Rational, Self)> {
        let mut work = MOST_WORK;
        let (scale, root) = self.above.times(&self.below, &mut work)?.square()?;
        Some((scale, Self { above: root, below: self.below.clone() }))
    }

    /// Returns p such that the fraction is p/q².
    pub fn over_square(&self) -> Option<Polynomial> {
        self.above.times(&self.below, &mut { MOST_WORK })
    }

    /// Returns the fraction as a polynomial, if the denominator is a number.
    pub fn polynomial(&self) -> Option<Polynomial> {
        Some(self.above.scaled(&self.below.number()?.recip()?))
    }

    fn times(&self, other: &Self, work: &mut usize) -> Option<Self> {
        Some(Self {
            above: self.above.times(&other.above, work)?,
            below: self.below.times(&other.below, work)?,
        })
    }

    /// Multiplies fractions.
    pub fn product<'f>(mut factors: impl Iterator<Item = &'f Self>) -> Option<Self> {
        let one = Self::whole(Polynomial::constant(&Rational::from(1)));
        let mut work = MOST_WORK;
        factors.try_fold(one, |product, factor| product.times(factor, &mut work))
    }

    fn sum(&self, other: &Self, sign: i64, work: &mut usize) -> Option<Self> {
        let signed = other.above.scaled(&Rational::from(sign));
        if self.below == other.below {
            return Some(Self {
                above: self.above.plus(&signed).checked()?,
                below: self.below.clone(),
            });
        }
        let left = self.above.times(&other.below, work)?;
        let right = signed.times(&self.below, work)?;
        let below = self.below.times(&other.below, work)?;
        Some(Self { above: left.plus(&right).checked()?, below })
    }

    fn inverse(&self) -> Option<Self> {
        (!self.above.is_zero())
            .then(|| Self { above: self.below.clone(), below: self.above.clone() })
    }

    fn power(&self, exponent: i64, work: &mut usize) -> Option<Self> {
        let base = if exponent < 0 { self.inverse()? } else { self.clone() };
        let mut power = Self::whole(Polynomial::constant(&Rational::from(1)));
        for _ in 0..exponent.unsigned_abs().min(MOST_POWER as u64 + 1) {
            power = power.times(&base, work)?;
        }
        (exponent.abs() <= MOST_POWER).then_some(power)
    }

    /// Records the value from the values of the variables.
    pub fn value(&self, of: &impl Fn(u32) -> Option<Expr>) -> Option<Expr> {
        Some(self.above.value(of)? / self.below.value(of)?)
    }
}

/// Reads the value at a place as a fraction; `given` provides the values of places that are not
/// expanded, including all inputs.
pub fn fraction(
    graph: &Graph,
    place: usize,
    given: &impl Fn(usize, Step<'_>) -> Option<Polynomial>,
) -> Option<Fraction> {
    let reached = graph.reached_from(&[place]);
    let mut work = MOST_WORK;
    let mut values: Vec<Option<Fraction>> = Vec::with_capacity(place + 1);
    for (at, step) in graph.steps().enumerate().take(place + 1) {
        let value = match reached[at] {
            false => None,
            true => match given(at, step) {
                Some(polynomial) => Some(Fraction::whole(polynomial)),
                None => of_step(step, &values, &mut work),
            },
        };
        values.push(value);
    }
    values.pop().flatten()
}

fn of_step(step: Step<'_>, values: &[Option<Fraction>], work: &mut usize) -> Option<Fraction> {
    let of = |place: usize| values[place].as_ref();
    match step {
        Step::Constant(value) => Some(Fraction::whole(Polynomial::constant(value))),
        Step::Input(_) => None,
        Step::Unary(Function::Neg, a) => {
            let a = of(a)?;
            Some(Fraction { above: a.above.negated(), below: a.below.clone() })
        }
        Step::Unary(Function::Recip, a) => of(a)?.inverse(),
        Step::Unary(..) => None,
        Step::Binary(Operation::Mul, a, b) => of(a)?.times(of(b)?, work),
        Step::Binary(Operation::Add, a, b) => of(a)?.sum(of(b)?, 1, work),
        Step::Binary(Operation::Sub, a, b) => of(a)?.sum(of(b)?, -1, work),
        Step::Binary(Operation::Pow, ..) => None,
        Step::Power(a, exponent) => of(a)?.power(exponent.to_integer()?, work),
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::record;

    fn read(build: impl FnOnce(&[Expr]) -> Expr) -> Option<Fraction> {
        let (graph, value) = record(3, build).expect("records");
        fraction(&graph, graph.place(value), &|_, step| match step {
            Step::Input(input) => Some(Polynomial::variable(input as u32)),
            _ => None,
        })
    }

    /// Whether c b² with the computed b is the fraction itself.
    fn squares(build: impl Fn(&[Expr]) -> Expr) -> Option<bool> {
        let (scale, root) = read(&build)?.square()?;
        let (graph, difference) = record(3, |inputs| {
            let b = root.value(&|k| inputs.get(k as usize).copied()).expect("all are given");
            build(inputs) - b * b * Expr::rational(&scale)
        })
        .expect("records");
        let tape = crate::graph::Tape::new(&graph, &[difference]);
        let mut run = crate::graph::Evaluator::new(&tape, crate::number::float::Float::<1>);
        let mut is_zero_at = |x: [f64; 3]| {
            run.run(&x.map(|x| [x]));
            run.output(0)[0].abs() < 1e-9
        };
        Some(is_zero_at([0.3, -0.7, 1.1]) && is_zero_at([2.0, 0.4, -1.3]))
    }

    #[test]
    fn squares_are_found() {
        assert_eq!(squares(|x| x[0] * x[0] + x[0] * 2.0 + 1.0), Some(true), "(x + 1)²");
        let sum = |x: &[Expr]| x[0] * 3.0 - x[1] * x[2] + x[1];
        assert_eq!(squares(|x| sum(x) * sum(x) * 5.0), Some(true), "5 (3x − yz + y)²");
        let quotient = |x: &[Expr]| (x[0] + x[1] + 1.0) / (x[2] * x[2] + 1.0);
        assert_eq!(squares(|x| quotient(x) * quotient(x)), Some(true), "of a quotient");
        assert_eq!(squares(|x| x[0].powi(6) - x[0].powi(3) * 2.0 + 1.0), Some(true), "(x³ − 1)²");
        assert_eq!(squares(|x| x[0] * x[0] + 1.0), None, "x² + 1 is no square");
        assert_eq!(squares(|x| x[0] * x[0] * x[1]), None, "nor is x²y");
        assert_eq!(squares(|x| x[0] * x[0] + x[0] * 2.0 + 2.0), None, "nor x² + 2x + 2");
    }

    #[test]
    fn random_squares_are_found() {
        use crate::proof::chance::Chance;
        let modulus = crate::number::prime::Modulus::new((1 << 61) - 1);
        let mut chance = Chance::new(7, 0);
        let mut small = |size: u64| (modulus.to_integer(chance.element(&modulus)) % size) as i64;
        for _ in 0..200 {
            let mut root = Polynomial::default();
            for _ in 0..1 + small(5) {
                let monomial = Monomial((0..3).map(|k| (k, small(3) as u32)).collect());
                let nonzero = monomial.0.into_iter().filter(|(_, e)| *e > 0).collect();
                root.add_term(Monomial(nonzero), &Rational::new(small(9) - 4, 1 + small(3)));
            }
            if root.is_zero() {
                continue;
            }
            let square = root.times(&root, &mut { MOST_WORK }).expect("small");
            let scale = Rational::new(1 + small(7), 1 + small(5));
            let (found, base) = square.scaled(&scale).square().expect("a square");
            let again = base.times(&base, &mut { MOST_WORK }).expect("small").scaled(&found);
            assert_eq!(again, square.scaled(&scale), "c b² of {root:?}");
            let off = square.plus(&Polynomial::variable(7));
            assert_eq!(off.square(), None, "and with one term more it is none: {root:?}");
        }
    }

    #[test]
    fn what_is_too_large_is_given_up() {
        let large = read(|x| (x[0] + x[1] + x[2] + 1.0).powi(30));
        assert!(large.is_none(), "5456 terms");
    }

    #[test]
    fn a_root_splits_off() {
        // (y + 1)³ with y² = x: y³ + 3y² + 3y + 1 = (3x + 1) + (x + 3) y
        let y = Polynomial::variable(1).plus(&Polynomial::constant(&Rational::from(1)));
        let mut work = MOST_WORK;
        let cube = y.times(&y, &mut work).and_then(|s| s.times(&y, &mut work)).expect("small");
        let [even, odd] = cube.split(1, &Polynomial::variable(0)).expect("small");
        let x = Polynomial::variable(0);
        let number = |n: i64| Polynomial::constant(&Rational::from(n));
        assert_eq!(even, x.scaled(&Rational::from(3)).plus(&number(1)));
        assert_eq!(odd, x.plus(&number(3)));
    }
}
