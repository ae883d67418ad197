//! Power series of formulas about a place where a divisor is 0, with exact coefficients.
//!
//! The variable v is an affine function of the state, such as x or (V + 55)/10. What does not depend on
//! v alone, or has no rational series, is an unknown of its own: a germ is Σ m_j p_j(v), m_j products
//! of unknowns.

use std::collections::BTreeMap;

use crate::taylor::remainder::{self, RADII, Rest, bounds};
use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;

/// Number of coefficients of a series.
pub(super) const LENGTH: usize = 34;
/// Largest order of a product: terms of larger ones are not among the coefficients that stand for a quotient.
const MOST_ORDER: usize = 29;
/// Largest number of products of unknowns.
const MOST_TERMS: usize = 6;
/// Largest number of bits of a coefficient.
const MOST_BITS: u64 = 1 << 13;

/// Unknowns of a product, with their powers.
pub(super) type Monomial = Vec<(usize, u32)>;

fn number(n: usize) -> Rational {
    Rational::from(n as i64)
}

/// constant + Σ c x over steps of a graph.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Affine {
    pub(super) constant: Rational,
    pub(super) terms: BTreeMap<usize, Rational>,
}

impl Affine {
    pub(super) fn of_constant(constant: Rational) -> Self {
        Self { constant, terms: BTreeMap::new() }
    }

    pub(super) fn of_step(place: usize) -> Self {
        Self { constant: number(0), terms: BTreeMap::from([(place, number(1))]) }
    }

    pub(super) fn plus(&self, other: &Self, factor: &Rational) -> Self {
        let mut sum = self.clone();
        sum.constant = &sum.constant + &(&other.constant * factor);
        for (place, weight) in &other.terms {
            let own = sum.terms.entry(*place).or_insert_with(|| number(0));
            *own = &*own + &(weight * factor);
        }
        sum.terms.retain(|_, weight| !weight.is_zero());
        sum
    }

    pub(super) fn times(&self, factor: &Rational) -> Self {
        Self::of_constant(number(0)).plus(self, factor)
    }

    /// The value, if it depends on no step.
    pub(super) fn as_constant(&self) -> Option<&Rational> {
        self.terms.is_empty().then_some(&self.constant)
    }

    /// Returns λ and μ if this is λ v + μ.
    pub(super) fn along(&self, v: &Self) -> Option<[Rational; 2]> {
        let (place, weight) = v.terms.first_key_value()?;
        let factor = match self.terms.get(place) {
            Some(own) => own * &weight.recip()?,
            None => number(0),
        };
        let rest = self.plus(v, &-&factor);
        rest.as_constant().map(|constant| [factor, constant.clone()])
    }

    /// Whether this is 0 where v is.
    pub(super) fn vanishes_with(&self, v: &Self) -> bool {
        self.along(v).is_some_and(|[_, constant]| constant.is_zero())
    }
}

/// A series in v: its first coefficients, and bounds of the norms of what is left out.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Series {
    pub(super) first: Vec<Rational>,
    pub(super) rest: Rest,
}

impl Series {
    fn polynomial(mut first: Vec<Rational>) -> Self {
        first.resize(LENGTH, number(0));
        Self { first, rest: [0.0; RADII] }
    }

    fn parts(&self) -> (&[Rational], &Rest) {
        (&self.first, &self.rest)
    }

    fn product(&self, other: &Self) -> Self {
        Self {
            first: multiplied(&self.first, &other.first),
            rest: remainder::of_product(self.parts(), other.parts()),
        }
    }

    /// The series over v^n, whose first n coefficients are 0.
    fn lowered(&self, n: usize) -> Self {
        let mut first = self.first[n..].to_vec();
        first.resize(LENGTH, number(0));
        let by = |index: usize| libm::pow(remainder::radius(index), n as f64);
        Self { first, rest: bounds(|index| self.rest[index] / by(index)) }
    }

    fn reciprocal(&self) -> Option<Self> {
        let scale = self.first[0].recip()?;
        let mut first: Vec<Rational> = vec![scale.clone()];
        for n in 1..LENGTH {
            let sum = (0..n).fold(number(0), |sum, k| &sum + &(&first[k] * &self.first[n - k]));
            first.push(-&(&sum * &scale));
        }
        let rest = remainder::of_reciprocal(&first, self.parts());
        Some(Self { first, rest })
    }
}

/// A series Σ m_j p_j(v).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Germ {
    pub(super) terms: BTreeMap<Monomial, Series>,
}

impl Germ {
    pub(super) fn of_constant(value: Rational) -> Self {
        Self::of_series(vec![value])
    }

    fn of_series(first: Vec<Rational>) -> Self {
        Self::of(Series::polynomial(first))
    }

    fn of(series: Series) -> Self {
        Self { terms: BTreeMap::from([(Vec::new(), series)]) }
    }

    /// An affine function; a constant is one, too.
    pub(super) fn of_affine(own: &Affine, v: &Affine) -> Option<Self> {
        own.along(v).map(|[factor, constant]| Self::of_series(vec![constant, factor]))
    }

    pub(super) fn unknown(place: usize) -> Self {
        let one = Series::polynomial(vec![number(1)]);
        Self { terms: BTreeMap::from([(vec![(place, 1)], one)]) }
    }

    /// The series, if it has no unknowns.
    pub(super) fn plain(&self) -> Option<&Series> {
        match self.terms.first_key_value() {
            Some((monomial, series)) if self.terms.len() == 1 && monomial.is_empty() => {
                Some(series)
            }
            _ => None,
        }
    }

    /// Number of leading coefficients that are 0 in all terms.
    pub(super) fn order(&self) -> usize {
        let first = |series: &Series| series.first.iter().position(|x| !x.is_zero());
        self.terms.values().map(|series| first(series).unwrap_or(LENGTH)).min().unwrap_or(LENGTH)
    }

    pub(super) fn plus(mut self, other: &Self, factor: &Rational) -> Option<Self> {
        for (monomial, series) in &other.terms {
            let own = self.terms.entry(monomial.clone());
            let own = own.or_insert_with(|| Series::polynomial(Vec::new()));
            let pairs = own.first.iter_mut().zip(&series.first);
            pairs.for_each(|(x, y)| *x = &*x + &(y * factor));
            let size = factor.to_f64().0.abs();
            // What is exact remains so.
            if series.rest != [0.0; RADII] {
                own.rest = bounds(|index| own.rest[index] + size * series.rest[index]);
            }
        }
        if self.terms.len() > 1 {
            let is_zero = |own: &Series| own.first.iter().all(Rational::is_zero);
            let is_exact = |own: &Series| !is_zero(own) || own.rest.iter().all(|rest| *rest == 0.0);
            let is_bounded = self.terms.values().all(is_exact);
            self.terms.retain(|_, series| !is_zero(series));
            if !is_bounded && self.terms.is_empty() {
                return None;
            }
            if !is_bounded {
                // What cancels in all coefficients known is no longer bounded.
                self.terms.values_mut().for_each(|own| own.rest = [f64::INFINITY; RADII]);
            }
        }
        self.bounded()
    }

    /// The product; `None` where one of two terms has an order beyond those that a series shows.
    pub(super) fn product(&self, other: &Self) -> Option<Self> {
        let mut all = Self::of_constant(number(0));
        for (a, x) in &self.terms {
            for (b, y) in &other.terms {
                let mut powers: BTreeMap<usize, u32> = a.iter().copied().collect();
                b.iter().for_each(|(place, power)| *powers.entry(*place).or_default() += power);
                let orders = [x, y].map(|own| own.first.iter().position(|x| !x.is_zero()));
                if let [Some(m), Some(n)] = orders
                    && m + n > MOST_ORDER
                {
                    return None;
                }
                let term = BTreeMap::from([(powers.into_iter().collect(), x.product(y))]);
                all = all.plus(&Self { terms: term }, &number(1))?;
            }
        }
        Some(all)
    }

    pub(super) fn power(&self, exponent: u32) -> Option<Self> {
        let one = Self::of_constant(number(1));
        (0..exponent).try_fold(one, |power, _| power.product(self))
    }

    /// The quotient by a series whose leading coefficients, as many as there are of these, are 0 too.
    pub(super) fn divided(&self, divisor: &Series, zeros: usize) -> Option<Self> {
        let inverse = divisor.lowered(zeros).reciprocal()?;
        let divide = |own: &Series| own.lowered(zeros).product(&inverse);
        let terms = self.terms.iter().map(|(monomial, series)| (monomial.clone(), divide(series)));
        Self { terms: terms.collect() }.bounded()
    }

    /// A function of the germ, where its value at v = 0 is rational.
    pub(super) fn apply(&self, function: UnaryFunction) -> Option<Self> {
        let argument = self.plain()?;
        let own = &argument.first;
        let rate = |n: usize| &number(n) * &own[n];
        // n z_n = Σ k u_k f_(n − k)
        let next = |f: &[Rational], n: usize| {
            let sum = (1..=n).fold(number(0), |sum, k| &sum + &(&rate(k) * &f[n - k]));
            &sum * &Rational::new(1, n as i64)
        };
        let is_base = match function {
            UnaryFunction::Ln => own[0].is_one(),
            UnaryFunction::Recip => !own[0].is_zero(),
            UnaryFunction::Exp | UnaryFunction::Sin | UnaryFunction::Cos => own[0].is_zero(),
            _ => false,
        };
        if !is_base {
            return None;
        }
        let found = match function {
            UnaryFunction::Exp => {
                let mut z = vec![number(1)];
                (1..LENGTH).for_each(|n| z.push(next(&z, n)));
                let rest = remainder::of_exponential([&z, &z], argument.parts());
                Series { first: z, rest }
            }
            UnaryFunction::Ln => {
                let inverse = argument.reciprocal()?;
                let mut z = vec![number(0)];
                (1..LENGTH).for_each(|n| z.push(next(&inverse.first, n)));
                let rest = remainder::of_logarithm(&z, inverse.parts(), argument.parts());
                Series { first: z, rest }
            }
            UnaryFunction::Recip => argument.reciprocal()?,
            _ => {
                let (mut sine, mut cosine) = (vec![number(0)], vec![number(1)]);
                for n in 1..LENGTH {
                    let (s, c) = (next(&cosine, n), -&next(&sine, n));
                    sine.push(s);
                    cosine.push(c);
                }
                let rest = remainder::of_exponential([&sine, &cosine], argument.parts());
                let first = if function == UnaryFunction::Sin { sine } else { cosine };
                Series { first, rest }
            }
        };
        Self::of(found).bounded()
    }

    fn bounded(self) -> Option<Self> {
        let is_small = |own: &Series| own.first.iter().all(|x| x.bits() <= MOST_BITS);
        (self.terms.len() <= MOST_TERMS && self.terms.values().all(is_small)).then_some(self)
    }
}

fn multiplied(x: &[Rational], y: &[Rational]) -> Vec<Rational> {
    let at = |n: usize| {
        let pairs = (0..=n).map(|k| (&x[k], &y[n - k]));
        let pairs = pairs.filter(|(a, b)| !a.is_zero() && !b.is_zero());
        pairs.fold(number(0), |sum, (a, b)| &sum + &(a * b))
    };
    (0..LENGTH).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn coefficients(germ: &Germ) -> Vec<Rational> {
        germ.plain().expect("no unknowns").first[..5].to_vec()
    }

    #[test]
    fn quotients_of_functions_have_their_series() {
        let v = Germ::of_series(vec![number(0), number(1)]);
        let minus = v.apply(UnaryFunction::Exp).expect("a series");
        let divisor =
            minus.plus(&Germ::of_constant(number(1)), &Rational::from(-1)).expect("e^v − 1");
        let found = v.divided(divisor.plain().expect("a series"), 1).expect("v/(e^v − 1)");
        let bernoulli = [(1, 1), (-1, 2), (1, 12), (0, 1), (-1, 720)];
        assert_eq!(coefficients(&found), bernoulli.map(|(a, b)| Rational::new(a, b)));
        let sine = v.apply(UnaryFunction::Sin).expect("a series");
        let found = sine.divided(v.plain().expect("v"), 1).expect("sin v/v");
        let expected = [(1, 1), (0, 1), (-1, 6), (0, 1), (1, 120)];
        assert_eq!(coefficients(&found), expected.map(|(a, b)| Rational::new(a, b)));
        let one = v.clone().plus(&Germ::of_constant(number(1)), &number(1)).expect("1 + v");
        let found = one.apply(UnaryFunction::Ln).expect("a series");
        let expected = [(0, 1), (1, 1), (-1, 2), (1, 3), (-1, 4)];
        assert_eq!(coefficients(&found), expected.map(|(a, b)| Rational::new(a, b)));
        assert!(one.apply(UnaryFunction::Exp).is_none(), "e is not rational");
    }
}
