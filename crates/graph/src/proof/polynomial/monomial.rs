//! Monomials and their order.

use std::collections::BTreeMap;

/// Variables with their exponents, by increasing variable, no exponent 0.
pub type Exponents = Vec<(u32, u32)>;

/// A monomial, ordered lexicographically: x₀ above all powers of x₁, and so on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Monomial(pub Exponents);

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
    /// Multiplies two monomials.
    pub fn times(&self, other: &Self) -> Self {
        let mut exponents: BTreeMap<u32, u32> = self.0.iter().copied().collect();
        for (variable, exponent) in &other.0 {
            *exponents.entry(*variable).or_insert(0) += exponent;
        }
        Self(exponents.into_iter().collect())
    }

    /// Divides by another monomial; `None` if it does not divide this one.
    pub fn over(&self, other: &Self) -> Option<Self> {
        let mut exponents: BTreeMap<u32, u32> = self.0.iter().copied().collect();
        for (variable, exponent) in &other.0 {
            let own = exponents.get_mut(variable)?;
            *own = own.checked_sub(*exponent)?;
        }
        Some(Self(exponents.into_iter().filter(|(_, exponent)| *exponent > 0).collect()))
    }

    /// Returns the largest monomial that divides both.
    pub fn common(&self, other: &Self) -> Self {
        let own = |variable: u32| other.0.iter().find(|(v, _)| *v == variable).map(|(_, e)| *e);
        let least = self.0.iter().filter_map(|(v, e)| Some((*v, *e.min(&own(*v)?))));
        Self(least.collect())
    }

    /// Returns the square root; `None` if an exponent is odd.
    pub fn root(&self) -> Option<Self> {
        let halved = self.0.iter().map(|(variable, exponent)| {
            exponent.is_multiple_of(2).then_some((*variable, exponent / 2))
        });
        halved.collect::<Option<Exponents>>().map(Self)
    }
}
