//! Terms x^a/f^m of exponents, with a factor f: exp(h/f^m) has the cofactor v(h/f^m), which is a
//! polynomial in the combinations that are sought.

use super::super::ansatz::system::PrimePoint;
use super::exponents::RateTerm;
use super::factor::RatedPolynomial;
use super::monomials::{self, value};
use super::setting::{OrbitSetting, PrimePhasePoint};

/// Largest power of a factor below.
const POWER: i32 = 3;
/// Largest number of factors.
const FACTORS: usize = 8;
/// Largest number of monomials over one power of one factor.
const MONOMIALS: usize = 30;
/// Largest number of all terms.
const TERMS: usize = 160;

/// A monomial over a power of a factor.
#[derive(Clone, Debug)]
pub struct Quotient {
    /// Monomial in the state.
    pub monomial: Vec<u32>,
    /// Number of the factor.
    pub factor: usize,
    /// Power of the factor.
    pub power: i32,
}

impl Quotient {
    /// Rate at a point where the factor has a value and a rate, and the state these rates.
    pub fn rate(
        &self,
        at: &PrimePoint,
        point: &PrimePhasePoint,
        rates: &dyn Fn(usize) -> u64,
        (own, rate): (u64, u64),
    ) -> Option<u64> {
        let m = at.modulus;
        (own != 0).then_some(())?;
        let inverse = m.inverse(own);
        // (x^a)' − m x^a f'/f, over f^m
        let share = m.mul(m.integer(u64::from(self.power.unsigned_abs())), m.mul(rate, inverse));
        let lost = m.mul(value(&m, &point.state, &self.monomial), share);
        let gained = rate_of_monomial(at, point, rates, &self.monomial);
        Some(m.mul(m.sub(gained, lost), m.power(inverse, u64::from(self.power.unsigned_abs()))))
    }
}

/// Rate of a monomial at a point where the state has these rates.
pub fn rate_of_monomial(
    at: &PrimePoint,
    point: &PrimePhasePoint,
    rates: &dyn Fn(usize) -> u64,
    monomial: &[u32],
) -> u64 {
    let m = at.modulus;
    let occurring: Vec<usize> = (0..monomial.len()).filter(|k| monomial[*k] > 0).collect();
    let slope = |k: &usize| {
        let factor = m.mul(m.integer(u64::from(monomial[*k])), rates(*k));
        occurring.iter().fold(factor, |product, other| {
            let exponent = monomial[*other] - u32::from(other == k);
            m.mul(product, m.power(point.state[*other], u64::from(exponent)))
        })
    };
    occurring.iter().fold(0, |sum, k| m.add(sum, slope(k)))
}

/// Lists the terms for the first factors, low powers first; the degree of h is at most that of f^m.
pub fn terms(
    setting: &OrbitSetting<'_>,
    variables: &[usize],
    factors: &[RatedPolynomial],
) -> Vec<RateTerm> {
    let is_exponential = |own: &RatedPolynomial| {
        setting.origin.is_some_and(|origin| origin.extension.exponent(&own.formula).is_some())
    };
    let chosen: Vec<usize> = (0..factors.len())
        .filter(|place| !is_exponential(&factors[*place]))
        .take(FACTORS)
        .collect();
    let mut all = Vec::new();
    for power in 1..=POWER {
        for factor in &chosen {
            let fits = |degree: &u32| {
                let count = monomials::count(variables.len(), *degree);
                count <= MONOMIALS && all.len() + count <= TERMS
            };
            let highest = power.unsigned_abs() * factors[*factor].degree.max(1);
            let Some(degree) = (0..=highest).rev().find(fits) else { continue };
            let own = monomials::up_to(variables, setting.dimension(), degree);
            let term = |monomial| RateTerm::Quotient(Quotient { monomial, factor: *factor, power });
            all.extend(own.into_iter().map(term));
        }
    }
    all
}
