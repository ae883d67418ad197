//! Sparse polynomials with rational coefficients.

use std::collections::BTreeMap;

use liouville::number::exact::square_root;
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::order::StableOrder;

/// Largest number of terms; longer polynomials are not made.
const MOST_TERMS: usize = 400;
/// Largest number of bits of a power of a coefficient.
const MOST_BITS: u64 = 1 << 14;

/// Powers of variables, by increasing variables, without powers 0.
pub type Monomial = Vec<(usize, u32)>;

/// A polynomial in numbered variables.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RingPolynomial(BTreeMap<Monomial, Rational>);

impl RingPolynomial {
    /// A constant.
    pub fn constant(value: Rational) -> Self {
        Self::term(Monomial::new(), value)
    }

    /// A power of a variable.
    pub fn variable(variable: usize, power: u32) -> Self {
        let own = if power > 0 { vec![(variable, power)] } else { Monomial::new() };
        Self::term(own, Rational::from(1))
    }

    /// One term.
    pub fn term(monomial: Monomial, value: Rational) -> Self {
        let mut terms = BTreeMap::new();
        if !value.is_zero() {
            terms.insert(monomial, value);
        }
        Self(terms)
    }

    /// Iterates over the terms.
    pub fn terms(&self) -> impl Iterator<Item = (&Monomial, &Rational)> {
        self.0.iter()
    }

    /// Whether this is 0.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The only term; `None` if there are several, or none.
    pub fn single(&self) -> Option<(&Monomial, &Rational)> {
        self.0.iter().next().filter(|_| self.0.len() == 1)
    }

    /// The value of a constant.
    pub fn value(&self) -> Option<Rational> {
        match self.single() {
            Some((own, value)) if own.is_empty() => Some(value.clone()),
            Some(_) => None,
            None => self.is_zero().then(|| Rational::from(0)),
        }
    }

    /// Lists the variables.
    pub fn variables(&self) -> Vec<usize> {
        let mut all: Vec<usize> =
            self.0.keys().flat_map(|own| own.iter().map(|(variable, _)| *variable)).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Value modulo a prime; `None` if a coefficient has none.
    pub fn residue(&self, m: &Modulus, point: &[u64]) -> Option<u64> {
        let mut sum = 0;
        for (monomial, factor) in &self.0 {
            let own = monomial.iter().fold(m.rational(factor)?, |product, (variable, power)| {
                m.mul(product, m.power(point[*variable], u64::from(*power)))
            });
            sum = m.add(sum, own);
        }
        Some(sum)
    }

    /// Sum with a multiple of another polynomial.
    pub fn plus(&self, other: &Self, factor: &Rational) -> Option<Self> {
        let mut terms = self.0.clone();
        for (own, value) in &other.0 {
            add(&mut terms, own.clone(), &(value * factor));
        }
        limited(terms)
    }

    /// Multiple by a number.
    pub fn times_number(&self, factor: &Rational) -> Self {
        let scaled = self.0.iter().map(|(own, value)| (own.clone(), value * factor));
        Self(scaled.filter(|(_, value)| !value.is_zero()).collect())
    }

    /// Product; `None` if it is too long.
    pub fn times(&self, other: &Self) -> Option<Self> {
        let mut terms = BTreeMap::new();
        for (a, x) in &self.0 {
            for (b, y) in &other.0 {
                add(&mut terms, product(a, b)?, &(x * y));
            }
            if terms.len() > MOST_TERMS {
                return None;
            }
        }
        limited(terms)
    }

    /// Power; `None` if it is too long.
    ///
    /// That of one term is written at once. The n-th power of two or more has n + 1 terms at least:
    /// along an edge of Newton's polytope it is the power of a polynomial in one variable, with a root
    /// of multiplicity n other than 0. So the number of products is bounded by that of terms.
    pub fn raised(&self, power: u32) -> Option<Self> {
        let one = Self::constant(Rational::from(1));
        if power == 0 || self.is_zero() {
            return Some(if power == 0 { one } else { self.clone() });
        }
        let Some((monomial, value)) = self.single() else {
            let is_short = (power as usize) < MOST_TERMS;
            return is_short.then(|| (0..power).try_fold(one, |made, _| made.times(self)))?;
        };
        let own = monomial.iter().map(|(variable, own)| Some((*variable, own.checked_mul(power)?)));
        Some(Self::term(own.collect::<Option<_>>()?, number_power(value, power)?))
    }

    /// Derivative along a motion in which each variable has a rate.
    pub fn rate(&self, rates: impl Fn(usize) -> Option<Self>) -> Option<Self> {
        let mut sum = Self::default();
        for (own, value) in &self.0 {
            for (place, (variable, power)) in own.iter().enumerate() {
                let mut lower = own.clone();
                match power {
                    1 => drop(lower.remove(place)),
                    _ => lower[place].1 -= 1,
                }
                let slope = Self::term(lower, value * &Rational::from(i64::from(*power)));
                sum = sum.plus(&slope.times(&rates(*variable)?)?, &Rational::from(1))?;
            }
        }
        Some(sum)
    }

    /// The quotient by another polynomial; `None` if it is no polynomial, or too long.
    pub fn over(&self, other: &Self) -> Option<Self> {
        let last = |own: &Self| own.variables().last().copied();
        let width = last(self).max(last(other)).map_or(0, |last| last + 1);
        // By exponents of all variables, so that the order of products is that of the factors.
        let dense = |own: &Self| -> BTreeMap<Vec<u32>, Rational> {
            let term = |(own, value): (&Monomial, &Rational)| {
                let mut all = vec![0; width];
                own.iter().for_each(|(variable, power)| all[*variable] = *power);
                (all, value.clone())
            };
            own.terms().map(term).collect()
        };
        let (mut rest, divisor) = (dense(self), dense(other));
        let (lead, value) = divisor.last_key_value()?;
        let inverse = value.recip()?;
        let mut quotient = BTreeMap::new();
        while let Some((top, number)) = rest.last_key_value() {
            let powers = top.iter().zip(lead).map(|(a, b)| a.checked_sub(*b));
            let powers: Vec<u32> = powers.collect::<Option<_>>()?;
            let factor = number * &inverse;
            for (own, value) in &divisor {
                let place = own.iter().zip(&powers).map(|(a, b)| a + b).collect();
                let entry = rest.entry(place).or_insert_with(|| Rational::from(0));
                *entry = &*entry - &(value * &factor);
            }
            rest.retain(|_, value| !value.is_zero());
            let monomial = powers.iter().enumerate().filter(|(_, power)| **power > 0);
            quotient.insert(monomial.map(|(k, power)| (k, *power)).collect(), factor);
            if rest.len() > MOST_TERMS {
                return None;
            }
        }
        limited(quotient)
    }

    /// The polynomial, up to its sign, of which this is the square; `None` if it is no square, or 0.
    pub fn square_root(&self) -> Option<Self> {
        let half = |(own, value): (&Monomial, &Rational)| {
            let halved = own.iter().map(|(k, power)| (power % 2 == 0).then_some((*k, power / 2)));
            Some((halved.collect::<Option<Monomial>>()?, square_root(value)?))
        };
        let mut parts = self.0.iter().filter_map(half);
        let (first, value) = parts.next()?;
        let twice = (&value * &Rational::from(2)).recip()?;
        let mut made = Self::term(first.clone(), value);
        for (own, _) in parts {
            // The coefficient in the product with the first term has the sign.
            let Some(value) = self.0.get(&product(&first, &own)?) else { continue };
            made = made.plus(&Self::term(own, value * &twice), &Rational::from(1))?;
        }
        (made.times(&made)? == *self).then_some(made)
    }

    /// Splits off the common factor of all terms: value · monomial · rest, where the first
    /// coefficient of the rest is 1 and all terms have no common variable.
    pub fn split(&self) -> Option<(Rational, Monomial, Self)> {
        let (first, value) = self.0.iter().next()?;
        let mut common = first.clone();
        for own in self.0.keys() {
            common = common
                .iter()
                .filter_map(|(variable, power)| {
                    let other = own.iter().find(|(other, _)| other == variable)?.1;
                    Some((*variable, other.min(*power)))
                })
                .collect();
        }
        let inverse = value.recip()?;
        let rest = self.0.iter().map(|(own, value)| (quotient(own, &common), value * &inverse));
        let rest = Self(rest.collect());
        Some((value.clone(), common, rest))
    }
}

fn limited(terms: BTreeMap<Monomial, Rational>) -> Option<RingPolynomial> {
    (terms.len() <= MOST_TERMS).then_some(RingPolynomial(terms))
}

fn add(terms: &mut BTreeMap<Monomial, Rational>, own: Monomial, value: &Rational) {
    let entry = terms.entry(own).or_insert_with(|| Rational::from(0));
    *entry = &*entry + value;
    if entry.is_zero() {
        terms.retain(|_, value| !value.is_zero());
    }
}

/// Product; `None` if an exponent is too large.
fn product(a: &Monomial, b: &Monomial) -> Option<Monomial> {
    let mut all: BTreeMap<usize, u32> = a.iter().copied().collect();
    for (variable, power) in b {
        let own = all.entry(*variable).or_insert(0);
        *own = own.checked_add(*power)?;
    }
    Some(all.into_iter().collect())
}

/// Power of a number; `None` if it is very long.
fn number_power(value: &Rational, power: u32) -> Option<Rational> {
    let (above, below) = value.parts();
    let bits = above.bits().max(below.bits());
    // 1 and −1 have one bit.
    let power = if bits == 1 { 2 - power % 2 } else { power };
    (bits * u64::from(power) <= MOST_BITS)
        .then(|| Rational::from_parts(above.pow(power), below.pow(power)))
}

fn quotient(a: &Monomial, b: &Monomial) -> Monomial {
    let less = |(variable, power): &(usize, u32)| {
        let other = b.iter().find(|(other, _)| other == variable).map_or(0, |(_, power)| *power);
        (*variable, power - other)
    };
    a.iter().map(less).filter(|(_, power)| *power > 0).collect()
}

/// Rational coefficients q with a = Σ q_j b_j.
pub fn combination(a: &RingPolynomial, basis: &[RingPolynomial]) -> Option<Vec<Rational>> {
    // Rows of monomials, columns of the basis, with `a` as the last.
    let all: Vec<&RingPolynomial> = basis.iter().chain([a]).collect();
    let mut monomials: Vec<&Monomial> = all.iter().flat_map(|own| own.0.keys()).collect();
    monomials.order();
    monomials.dedup();
    let entry = |own: &RingPolynomial, monomial: &Monomial| {
        own.0.get(monomial).cloned().unwrap_or_else(|| Rational::from(0))
    };
    let mut rows: Vec<Vec<Rational>> = monomials
        .iter()
        .map(|monomial| all.iter().map(|own| entry(own, monomial)).collect())
        .collect();
    let width = basis.len();
    let mut pivots = Vec::new();
    for column in 0..=width {
        let done = pivots.len();
        let Some(found) = (done..rows.len()).find(|row| !rows[*row][column].is_zero()) else {
            continue;
        };
        if column == width {
            return None;
        }
        rows.swap(done, found);
        let inverse = rows[done][column].recip()?;
        let pivot: Vec<Rational> = rows[done].iter().map(|value| value * &inverse).collect();
        for (_, row) in rows.iter_mut().enumerate().filter(|(place, _)| *place != done) {
            let factor = row[column].clone();
            if !factor.is_zero() {
                row.iter_mut().zip(&pivot).for_each(|(x, own)| *x = &*x - &(&factor * own));
            }
        }
        rows[done] = pivot;
        pivots.push(column);
    }
    let mut found = vec![Rational::from(0); width];
    for (row, column) in pivots.into_iter().enumerate() {
        found[column] = rows[row][width].clone();
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn x(variable: usize) -> RingPolynomial {
        RingPolynomial::variable(variable, 1)
    }

    #[test]
    fn polynomials_are_added_multiplied_and_split() {
        let (one, minus) = (Rational::from(1), Rational::from(-1));
        let sum = x(0).plus(&x(1), &one).expect("short");
        let difference = x(0).plus(&x(1), &minus).expect("short");
        let product = sum.times(&difference).expect("short");
        let squares = RingPolynomial::variable(0, 2).plus(&RingPolynomial::variable(1, 2), &minus);
        assert_eq!(Some(product), squares, "(x + y)(x − y) = x² − y²");
        assert!(sum.plus(&sum, &minus).expect("short").is_zero(), "x − x");
        let own = x(2).times(&difference).expect("short").times_number(&Rational::from(3));
        let (value, monomial, rest) = own.split().expect("not 0");
        assert_eq!((value, monomial, rest), (Rational::from(3), vec![(2, 1)], difference));
        // x' = y, y' = 1: (x y)' = y² + x
        let rate = x(0).times(&x(1)).expect("short").rate(|k| match k {
            0 => Some(x(1)),
            _ => Some(RingPolynomial::constant(Rational::from(1))),
        });
        assert_eq!(rate, RingPolynomial::variable(1, 2).plus(&x(0), &one));
    }

    #[test]
    fn powers_of_high_degree_are_short_or_none() {
        let minus = Rational::from(-1);
        let term = RingPolynomial::term(vec![(0, 2), (3, 1)], minus.clone());
        let raised = term.raised(1_000_000_007).expect("one term");
        let expected = vec![(0, 2_000_000_014), (3, 1_000_000_007)];
        assert_eq!(raised, RingPolynomial::term(expected, minus.clone()));
        assert_eq!(term.raised(4_000_000_000), None, "no exponent of that size");
        assert_eq!(raised.times(&raised).and_then(|own| own.times(&raised)), None);
        assert_eq!(x(0).times_number(&2.into()).raised(1_000_000_007), None, "2^1000000007");
        let sum = x(0).plus(&x(1), &minus).expect("short");
        assert_eq!(sum.raised(1_000_000_007), None, "too many terms");
        assert_eq!(sum.raised(399).map(|own| own.terms().count()), Some(400));
        assert_eq!(sum.raised(0), RingPolynomial::default().raised(0));
        assert!(RingPolynomial::default().raised(1_000_000_007).is_some_and(|own| own.is_zero()));
    }

    #[test]
    fn combinations_are_exact() {
        let (a, b) = (x(0), x(0).plus(&x(1), &Rational::from(2)).expect("short"));
        let found = combination(&x(1), &[a.clone(), b.clone()]);
        assert_eq!(found, Some(vec![Rational::new(-1, 2), Rational::new(1, 2)]));
        assert_eq!(combination(&x(2), &[a, b]), None, "z is independent");
    }

    #[test]
    fn roots_of_squares_are_found() {
        let variable = |k| RingPolynomial::variable(k, 1);
        let minus = Rational::from(-3);
        let sum = variable(0).plus(&variable(1), &minus).expect("few terms");
        let sum = sum.plus(&variable(2).times(&variable(0)).expect("few terms"), &1.into());
        let sum = sum.expect("few terms");
        let square = sum.times(&sum).expect("few terms");
        let root = square.square_root().expect("it is a square");
        assert!(root == sum || root == sum.times_number(&Rational::from(-1)));
        assert_eq!(square.plus(&variable(0), &1.into()).expect("few terms").square_root(), None);
        assert_eq!(square.times_number(&Rational::from(2)).square_root(), None);
        assert_eq!(RingPolynomial::default().square_root(), None);
    }

    #[test]
    fn exact_quotients_are_found() {
        let one = Rational::from(1);
        let sum = x(0).plus(&x(1), &one).expect("short");
        let other = x(0).times(&x(2)).expect("short").plus(&x(1), &Rational::from(-2));
        let other = other.expect("short");
        let product = sum.times(&other).expect("short");
        assert_eq!(product.over(&sum), Some(other.clone()));
        assert_eq!(product.over(&other), Some(sum.clone()));
        let more = product.plus(&x(1), &one).expect("short");
        assert_eq!(more.over(&sum), None, "(x + y)(xz − 2y) + y");
        assert_eq!(sum.over(&RingPolynomial::default()), None, "no division by 0");
    }
}
