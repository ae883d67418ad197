//! Polynomials that are odd powers of others.

use num_bigint::BigInt;

use liouville::number::rational::Rational;

use super::polynomial::{Monomial, RingPolynomial};

/// Powers that are recognised.
const POWERS: [u32; 3] = [3, 5, 7];
/// Largest number of terms of a root.
const MOST_TERMS: usize = 24;

impl RingPolynomial {
    /// The polynomial of which this is an odd power above the first, with the power.
    pub fn odd_root(&self) -> Option<(Self, u32)> {
        POWERS.into_iter().find_map(|power| Some((self.root(power)?, power)))
    }

    fn root(&self, power: u32) -> Option<Self> {
        let width = self.variables().last()? + 1;
        let (first, value) = self.leading(width)?;
        let share = |own: &u32| own.is_multiple_of(power).then_some(own / power);
        let lead: Vec<u32> = first.iter().map(share).collect::<Option<_>>()?;
        let value = number_root(&value, power)?;
        let below: Vec<u32> = lead.iter().map(|own| own * (power - 1)).collect();
        let mut scale = Rational::from(i64::from(power));
        (1..power).for_each(|_| scale = &scale * &value);
        let scale = scale.recip()?;
        let mut made = Self::term(sparse(&lead), value);
        for _ in 0..MOST_TERMS {
            let rest = self.plus(&made.raised(power)?, &Rational::from(-1))?;
            let Some((next, value)) = rest.leading(width) else { return Some(made) };
            let own = next.iter().zip(&below).map(|(a, b)| a.checked_sub(*b));
            let own: Vec<u32> = own.collect::<Option<_>>()?;
            if own >= lead {
                return None;
            }
            made = made.plus(&Self::term(sparse(&own), &value * &scale), &Rational::from(1))?;
        }
        None
    }

    /// The term whose exponents are the last.
    fn leading(&self, width: usize) -> Option<(Vec<u32>, Rational)> {
        let dense = |(own, value): (&Monomial, &Rational)| {
            let mut all = vec![0; width];
            own.iter().for_each(|(variable, power)| all[*variable] = *power);
            (all, value.clone())
        };
        self.terms().map(dense).max_by(|(a, _), (b, _)| a.cmp(b))
    }
}

fn sparse(own: &[u32]) -> Monomial {
    own.iter().enumerate().filter(|(_, power)| **power > 0).map(|(k, power)| (k, *power)).collect()
}

/// Root of odd order of a number.
fn number_root(value: &Rational, order: u32) -> Option<Rational> {
    let (above, below) = value.parts();
    let root = |own: BigInt| {
        let root = own.nth_root(order);
        (root.pow(order) == own).then_some(root)
    };
    Some(Rational::from_parts(root(above)?, root(below)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn odd_powers_are_recognised() {
        let x = |k: usize, power| RingPolynomial::variable(k, power);
        let sum = |a: &RingPolynomial, b: &RingPolynomial, factor: i64| {
            a.plus(b, &Rational::from(factor)).expect("short")
        };
        let base = sum(&sum(&x(0, 2), &x(1, 2), -3), &RingPolynomial::constant(5.into()), 1);
        for power in [3, 5] {
            let raised = base.raised(power).expect("short");
            assert_eq!(raised.odd_root(), Some((base.clone(), power)));
            let turned = raised.times_number(&Rational::from(-1));
            assert_eq!(turned.odd_root(), Some((base.times_number(&(-1).into()), power)));
            assert_eq!(sum(&raised, &x(0, 1), 1).odd_root(), None, "x more");
            assert_eq!(raised.times_number(&Rational::from(2)).odd_root(), None, "2 times it");
        }
        assert_eq!(base.odd_root(), None);
        assert_eq!(RingPolynomial::constant(8.into()).odd_root(), None, "a number stays");
        assert_eq!(RingPolynomial::default().odd_root(), None);
    }
}
