//! Sums, products and values of polynomials with rational coefficients.

use std::collections::BTreeMap;

use liouville::number::rational::Rational;

/// A polynomial: coefficients that are not 0 by exponents.
pub type Terms = Vec<(Vec<u32>, Rational)>;

/// Sum of terms, like ones together.
pub fn collected(all: impl IntoIterator<Item = (Vec<u32>, Rational)>) -> Terms {
    let mut sums: BTreeMap<Vec<u32>, Rational> = BTreeMap::new();
    for (exponents, value) in all {
        let sum = sums.entry(exponents).or_insert_with(|| Rational::from(0));
        *sum = &*sum + &value;
    }
    sums.into_iter().filter(|(_, value)| !value.is_zero()).collect()
}

/// Product of two polynomials.
pub fn product(one: &Terms, other: &Terms) -> Terms {
    collected(one.iter().flat_map(|(a, x)| {
        other.iter().map(move |(b, y)| (a.iter().zip(b).map(|(a, b)| a + b).collect(), x * y))
    }))
}

/// Value at a point.
pub fn value(own: &Terms, point: &[Rational]) -> Rational {
    let term = |(exponents, value): &(Vec<u32>, Rational)| {
        exponents
            .iter()
            .zip(point)
            .fold(value.clone(), |all, (power, x)| (0..*power).fold(all, |all, _| &all * x))
    };
    own.iter().map(term).fold(Rational::from(0), |sum, own| &sum + &own)
}

/// Derivative by a variable.
pub fn derivative(own: &Terms, place: usize) -> Terms {
    let used = own.iter().filter(|(exponents, _)| exponents[place] > 0);
    collected(used.map(|(exponents, value)| {
        let mut lower = exponents.clone();
        lower[place] -= 1;
        (lower, value * &Rational::from(i64::from(exponents[place])))
    }))
}

/// The polynomial with another one in place of a variable.
pub fn substituted(own: &Terms, place: usize, with: &Terms) -> Terms {
    let mut parts: BTreeMap<u32, Terms> = BTreeMap::new();
    for (exponents, value) in own {
        let mut rest = exponents.clone();
        let power = std::mem::take(&mut rest[place]);
        parts.entry(power).or_default().push((rest, value.clone()));
    }
    let mut all = Terms::new();
    for (power, part) in parts {
        all.extend((0..power).fold(part, |part, _| product(&part, with)));
    }
    collected(all)
}

/// Whether a variable occurs.
pub fn contains(own: &Terms, place: usize) -> bool {
    own.iter().any(|(exponents, _)| exponents[place] > 0)
}

/// Total degree.
pub fn degree(own: &Terms) -> u32 {
    own.iter().map(|(exponents, _)| exponents.iter().sum()).max().unwrap_or(0)
}

/// Degree in one variable.
pub fn degree_in(own: &Terms, place: usize) -> u32 {
    own.iter().map(|(exponents, _)| exponents[place]).max().unwrap_or(0)
}

/// Coefficients of the powers of one variable, from low to high, of a polynomial without others.
pub fn univariate(own: &Terms, place: usize) -> Vec<Rational> {
    let mut all = vec![Rational::from(0); degree_in(own, place) as usize + 1];
    for (exponents, value) in own {
        let entry = &mut all[exponents[place] as usize];
        *entry = &*entry + value;
    }
    all
}
