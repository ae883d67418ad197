//! Products of powers, and their derivatives, at one state modulo a prime.

use super::recording::Derivation;
use super::system::Column;
use liouville::number::prime::Modulus;

/// Powers, rates and logarithmic derivatives of the variables at a state, with the factors.
pub struct VariablePowers<'v> {
    powers: Vec<Vec<u64>>,
    rates: &'v [u64],
    growth: &'v [u64],
    factors: &'v [u64],
    slopes: &'v [u64],
    /// Variables that are 0, as on a level u = 0.
    zeros: Vec<usize>,
}

impl<'v> VariablePowers<'v> {
    /// Reads the variables of a derivation from the values at a state and their growth.
    pub fn of(
        m: &Modulus,
        own: &Derivation,
        values: &'v [u64],
        growth: &'v [u64],
        highest: u32,
    ) -> Self {
        let (x, rest) = values[own.start..].split_at(own.variables);
        let (rates, rest) = rest.split_at(own.variables);
        let (factors, rest) = rest.split_at(own.factors);
        let powers = |x: &u64| {
            std::iter::successors(Some(m.one()), |power| Some(m.mul(*power, *x)))
                .take(highest as usize + 1)
                .collect()
        };
        let powers = x.iter().map(powers).collect();
        let zeros = (0..x.len()).filter(|k| x[*k] == 0).collect();
        Self { powers, rates, growth, factors, slopes: &rest[..own.factors], zeros }
    }

    fn monomial(&self, m: &Modulus, exponents: &[u32]) -> u64 {
        let powers = self.powers.iter().zip(exponents).map(|(row, a)| row[*a as usize]);
        powers.fold(m.one(), |product, power| m.mul(product, power))
    }

    /// Computes the derivative of a column.
    pub fn derivative(&self, m: &Modulus, column: &Column) -> u64 {
        let Column::Product { factor, exponents, .. } = column else { return 0 };
        // At x = 0 the derivative of x y^a is y^a dx, and that of x^a y^b is 0 for a > 1.
        let mut vanishing = self.zeros.iter().filter(|k| exponents[**k] > 0);
        if let Some(k) = vanishing.next() {
            if exponents[*k] > 1 || vanishing.next().is_some() {
                return 0;
            }
            let mut rest = exponents.clone();
            rest[*k] = 0;
            return m.mul(m.mul(self.monomial(m, &rest), self.rates[*k]), self.factors[*factor]);
        }
        let used = self.growth.iter().zip(exponents).filter(|(_, a)| **a > 0);
        let growth = used.fold(0, |sum, (g, a)| m.add(sum, m.mul(*g, m.integer(u64::from(*a)))));
        let slope = m.add(m.mul(self.factors[*factor], growth), self.slopes[*factor]);
        m.mul(self.monomial(m, exponents), slope)
    }

    /// Computes the value of a column.
    pub fn value(&self, m: &Modulus, column: &Column) -> u64 {
        let Column::Product { factor, exponents, .. } = column else { return 0 };
        m.mul(self.monomial(m, exponents), self.factors[*factor])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_exist_where_a_variable_is_0() {
        let m = Modulus::new((1 << 61) - 1);
        let own = Derivation { start: 0, variables: 3, factors: 1 };
        // x = 0, y = 0, z = 5 with the rates 2, 3, 7, and the factor 11 with the rate 13.
        let values: Vec<u64> = [0, 0, 5, 2, 3, 7, 11, 13].map(|n| m.integer(n)).to_vec();
        let growth = [0, 0, m.mul(m.integer(7), m.inverse(m.integer(5)))];
        let at = VariablePowers::of(&m, &own, &values, &growth, 2);
        let derivative = |exponents: [u32; 3]| {
            let exponents = exponents.to_vec();
            let column = Column::Product { derivation: 0, factor: 0, exponents };
            m.to_integer(at.derivative(&m, &column))
        };
        assert_eq!(derivative([1, 0, 1]), 11 * 5 * 2, "W z dx");
        assert_eq!(derivative([0, 1, 2]), 11 * 25 * 3, "W z² dy");
        assert_eq!(derivative([2, 0, 1]), 0, "x² z");
        assert_eq!(derivative([1, 1, 1]), 0, "x y z");
        assert_eq!(derivative([0, 0, 2]), 11 * 10 * 7 + 25 * 13, "W 2z dz + z² dW");
    }
}
