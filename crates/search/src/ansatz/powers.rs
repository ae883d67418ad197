//! Products of powers, and their derivatives, at one state modulo a prime.

use super::recording::Derivation;
use super::system::Column;
use liouville::number::prime::Modulus;

/// A column of which only the variables that occur are listed: there may be thousands.
pub enum SparseColumn {
    /// An output of the recording.
    Given(usize),
    /// A factor times a product of powers.
    Product {
        /// Index of the direction.
        derivation: usize,
        /// Index of the factor.
        factor: usize,
        /// Powers of the variables that occur.
        powers: Vec<VariablePower>,
    },
}

/// A power of a variable.
pub struct VariablePower {
    variable: usize,
    exponent: u32,
    /// The exponent modulo the prime.
    image: u64,
}

impl SparseColumn {
    /// Lists the variables of a column.
    pub fn of(m: &Modulus, column: &Column) -> Self {
        let (derivation, factor, exponents) = match column {
            Column::Given(output) => return SparseColumn::Given(*output),
            Column::Product { derivation, factor, exponents } => (*derivation, *factor, exponents),
        };
        let occurring = exponents.iter().enumerate().filter(|(_, exponent)| **exponent > 0);
        let power = |(variable, exponent): (usize, &u32)| VariablePower {
            variable,
            exponent: *exponent,
            image: m.integer(u64::from(*exponent)),
        };
        SparseColumn::Product { derivation, factor, powers: occurring.map(power).collect() }
    }

    /// Powers of the variables that occur.
    fn powers(&self) -> &[VariablePower] {
        match self {
            SparseColumn::Given(_) => &[],
            SparseColumn::Product { powers, .. } => powers,
        }
    }

    /// Highest exponent.
    pub fn highest(&self) -> u32 {
        self.powers().iter().map(|own| own.exponent).max().unwrap_or(0)
    }
}

/// Powers, rates and logarithmic derivatives of the variables at a state, with the factors.
pub struct VariablePowers<'v> {
    powers: Vec<Vec<u64>>,
    rates: &'v [u64],
    growth: &'v [u64],
    factors: &'v [u64],
    slopes: &'v [u64],
    /// Whether a variable is 0, as on a level u = 0.
    has_zeros: bool,
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
        let has_zeros = x.contains(&0);
        Self { powers, rates, growth, factors, slopes: &rest[..own.factors], has_zeros }
    }

    fn monomial<'p>(&self, m: &Modulus, powers: impl Iterator<Item = &'p VariablePower>) -> u64 {
        let powers = powers.map(|own| self.powers[own.variable][own.exponent as usize]);
        powers.fold(m.one(), |product, power| m.mul(product, power))
    }

    /// Computes the derivative of a column.
    pub fn derivative(&self, m: &Modulus, column: &SparseColumn) -> u64 {
        let SparseColumn::Product { factor, powers, .. } = column else { return 0 };
        // At x = 0 the derivative of x y^a is y^a dx, and that of x^a y^b is 0 for a > 1.
        let is_zero = |own: &&VariablePower| self.powers[own.variable].get(1) == Some(&0);
        let mut vanishing = powers.iter().filter(|own| self.has_zeros && is_zero(own));
        if let Some(zero) = vanishing.next() {
            if zero.exponent > 1 || vanishing.next().is_some() {
                return 0;
            }
            let rest = powers.iter().filter(|own| own.variable != zero.variable);
            let rate = m.mul(self.monomial(m, rest), self.rates[zero.variable]);
            return m.mul(rate, self.factors[*factor]);
        }
        let growth = powers
            .iter()
            .fold(0, |sum, own| m.add(sum, m.mul(self.growth[own.variable], own.image)));
        let slope = m.add(m.mul(self.factors[*factor], growth), self.slopes[*factor]);
        m.mul(self.monomial(m, powers.iter()), slope)
    }

    /// Computes the value of a column.
    pub fn value(&self, m: &Modulus, column: &SparseColumn) -> u64 {
        let SparseColumn::Product { factor, powers, .. } = column else { return 0 };
        m.mul(self.monomial(m, powers.iter()), self.factors[*factor])
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
            m.to_integer(at.derivative(&m, &SparseColumn::of(&m, &column)))
        };
        assert_eq!(derivative([1, 0, 1]), 11 * 5 * 2, "W z dx");
        assert_eq!(derivative([0, 1, 2]), 11 * 25 * 3, "W z² dy");
        assert_eq!(derivative([2, 0, 1]), 0, "x² z");
        assert_eq!(derivative([1, 1, 1]), 0, "x y z");
        assert_eq!(derivative([0, 0, 2]), 11 * 10 * 7 + 25 * 13, "W 2z dz + z² dW");
    }
}
