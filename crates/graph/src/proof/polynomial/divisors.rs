//! Exact quotients and common divisors of polynomials, and factors that miss a variable.

use crate::number::rational::Rational;

use super::{MOST_TERMS, MOST_WORK, Monomial, Polynomial};

/// Largest number of factors.
const MOST_FACTORS: usize = 16;
/// Largest number of steps of one division.
const MOST_STEPS: usize = 4 * MOST_TERMS;

impl Polynomial {
    /// Divides by a polynomial that divides this one; `None` if it does not, or if they are too large.
    pub fn over(&self, divisor: &Self, work: &mut usize) -> Option<Self> {
        let (head, scale) = divisor.leading()?;
        let inverse = scale.recip()?;
        let (mut rest, mut quotient) = (self.clone(), Self::default());
        // Each step removes the leading term of the rest.
        for _ in 0..MOST_STEPS {
            let Some((monomial, value)) = rest.leading() else { return Some(quotient) };
            let term = Self { terms: [(monomial.over(head)?, value * &inverse)].into() };
            rest = rest.plus(&divisor.times(&term, work)?.negated());
            quotient = quotient.plus(&term);
        }
        None
    }

    /// Makes the leading coefficient 1.
    pub fn monic(&self) -> Option<Self> {
        let (_, value) = self.leading()?;
        Some(self.scaled(&value.recip()?))
    }

    /// Whether the polynomial is 0 wherever a variable is 1, or −1.
    pub fn vanishes_at(&self, variable: u32, is_negative: bool) -> bool {
        let value = if is_negative { -1 } else { 1 };
        let sum =
            self.by_powers(variable).into_iter().fold(Self::default(), |sum, (power, own)| {
                // ±1 to any power
                let factor = if power % 2 == 1 { value } else { 1 };
                sum.plus(&own.scaled(&Rational::from(factor)))
            });
        sum.is_zero()
    }

    /// Returns the coefficients by powers of a variable.
    pub fn by_powers(&self, variable: u32) -> Vec<(u32, Self)> {
        let all = self.collected(&[variable]).into_iter();
        all.map(|(powers, own)| (powers.first().copied().unwrap_or(0), own)).collect()
    }

    /// Returns the greatest common divisor of the coefficients by powers of a variable.
    pub(super) fn content(&self, variable: u32, work: &mut usize) -> Option<Self> {
        let mut content = Self::default();
        for (_, own) in self.by_powers(variable) {
            content = content.common_divisor(&own, work)?;
        }
        Some(content)
    }

    /// Returns the greatest common divisor of two polynomials, with leading coefficient 1; `None` if
    /// they are too large.
    pub fn common_divisor(&self, other: &Self, work: &mut usize) -> Option<Self> {
        let one = Self::constant(&Rational::from(1));
        if self.is_zero() || other.is_zero() {
            let both = self.plus(other);
            return if both.is_zero() { Some(both) } else { both.monic() };
        }
        if self.number().is_some() || other.number().is_some() {
            return Some(one);
        }
        let (own, others) = (self.variables(), other.variables());
        // A divisor of both contains no variable that one of them misses.
        if let Some(variable) = own.iter().find(|variable| !others.contains(variable)) {
            return self.content(*variable, work)?.common_divisor(other, work);
        }
        if let Some(variable) = others.iter().find(|variable| !own.contains(variable)) {
            return other.content(*variable, work)?.common_divisor(self, work);
        }
        let variable = *own.first()?;
        let contents = [self.content(variable, work)?, other.content(variable, work)?];
        let common = contents[0].common_divisor(&contents[1], work)?;
        let mut a = self.over(&contents[0], work)?;
        let mut b = other.over(&contents[1], work)?;
        // Euclid's algorithm for polynomials in the variable without contents.
        while !b.is_zero() {
            let rest = a.remainder(&b, variable, work)?;
            let rest = match rest.is_zero() {
                true => rest,
                false => rest.over(&rest.content(variable, work)?, work)?.monic()?,
            };
            (a, b) = (b, rest);
        }
        match a.variables().contains(&variable) {
            true => common.times(&a, work)?.monic(),
            false => common.monic(),
        }
    }

    /// Returns a remainder of a multiple of this polynomial, of lower degree in a variable than the
    /// divisor.
    fn remainder(&self, divisor: &Self, variable: u32, work: &mut usize) -> Option<Self> {
        let (degree, head) = divisor.by_powers(variable).pop()?;
        let mut rest = self.clone();
        for _ in 0..MOST_STEPS {
            let Some((own, leading)) = rest.by_powers(variable).pop() else { return Some(rest) };
            if own < degree {
                return Some(rest);
            }
            let power = Self::of_term(&Rational::from(1), shifted(variable, own - degree));
            let taken = divisor.times(&leading, work)?.times(&power, work)?;
            rest = rest.times(&head, work)?.plus(&taken.negated());
        }
        None
    }

    /// Returns the derivative by a variable.
    fn derivative(&self, variable: u32) -> Self {
        let mut sum = Self::default();
        for (power, own) in self.by_powers(variable).into_iter().filter(|(power, _)| *power > 0) {
            let factor = Rational::from(i64::from(power));
            let lower: Vec<(u32, u32)> = shifted(variable, power - 1).collect();
            for (monomial, value) in &own.terms {
                let product = monomial.times(&Monomial(lower.clone()));
                sum.add_term(product, &(value * &factor));
            }
        }
        sum
    }

    /// Returns the product of the different factors; `None` if none is repeated, if a factor does not
    /// contain the variable, or they are too large.
    fn without_repetitions(&self, variable: u32, work: &mut usize) -> Option<Self> {
        // A factor without the variable divides the derivative, repeated or not.
        self.content(variable, work)?.number()?;
        let slope = self.derivative(variable);
        let repeated = self.common_divisor(&slope, work)?;
        // A common divisor of both that contains the variable divides the polynomial twice.
        slope.over(&repeated, work)?;
        if repeated.number().is_some() { None } else { self.over(&repeated, work) }
    }

    /// Divides a polynomial whose factors contain all of its variables, as far as is known.
    fn factors_of_all(self, work: &mut usize) -> Vec<Self> {
        if let Some(found) = self.divided() {
            return found;
        }
        let first = self.variables().first().copied();
        let once = first.and_then(|first| self.without_repetitions(first, work));
        let (once, is_other) = match once {
            Some(once) => (once, true),
            None => (self, false),
        };
        let found = if is_other { once.divided() } else { None };
        found.unwrap_or_else(|| once.linear_factors())
    }

    /// Divides into factors over ℚ that are no numbers, each once. The polynomial is 0 where one of them is.
    /// Several may remain in one where it is too large to be divided.
    pub fn factors(&self) -> Vec<Self> {
        let (mut open, mut factors) = (vec![self.clone()], Vec::new());
        let mut work = MOST_WORK;
        while let Some(own) = open.pop() {
            let parts = match open.len() + factors.len() < MOST_FACTORS {
                true => own.variables().into_iter().find_map(|variable| {
                    let content = own.content(variable, &mut work)?;
                    let rest = own.over(&content, &mut work)?;
                    (content.number().is_none() && rest.number().is_none())
                        .then_some([content, rest])
                }),
                false => None,
            };
            match parts {
                Some(parts) => open.extend(parts),
                None if own.number().is_some() => {}
                None => {
                    for factor in own.factors_of_all(&mut work) {
                        let factor = factor.monic().unwrap_or(factor);
                        if !factors.contains(&factor) {
                            factors.push(factor);
                        }
                    }
                }
            }
        }
        factors
    }
}

/// Returns the power of a variable, as exponents.
fn shifted(variable: u32, exponent: u32) -> impl Iterator<Item = (u32, u32)> {
    (exponent > 0).then_some((variable, exponent)).into_iter()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variable(number: u32) -> Polynomial {
        Polynomial::variable(number)
    }

    fn number(value: i64) -> Polynomial {
        Polynomial::constant(&Rational::from(value))
    }

    fn product(factors: &[&Polynomial]) -> Polynomial {
        let times =
            |all: Polynomial, own: &&Polynomial| all.times(own, &mut { MOST_WORK }).expect("small");
        factors.iter().fold(number(1), times)
    }

    #[test]
    fn repeated_factors_are_taken_once_and_others_are_kept() {
        let (x, z) = (variable(0), variable(1));
        let (a, b) = (x.plus(&z), z.plus(&number(2)));
        let once = |p: &Polynomial, v: u32| p.without_repetitions(v, &mut { MOST_WORK });
        assert_eq!(once(&product(&[&a, &a]), 0), Some(a.clone()));
        // z + 2 is not repeated, and divides the derivative by x.
        assert_eq!(once(&product(&[&a, &a, &b]), 0), None);
        assert_eq!(once(&product(&[&a, &a, &b]), 1), Some(product(&[&a, &b])));
        assert_eq!(once(&product(&[&a, &b]), 1), None);
    }

    #[test]
    fn common_divisors_are_those_that_were_multiplied_in() {
        let (x, y, z) = (variable(0), variable(1), variable(2));
        let square = x.times(&x, &mut { MOST_WORK }).expect("small");
        let a = square.plus(&y).plus(&number(-3));
        let b = product(&[&x, &z]).plus(&y);
        let c = product(&[&y, &z]).plus(&x).plus(&number(5));
        let common = |p: &Polynomial, q: &Polynomial| p.common_divisor(q, &mut { MOST_WORK });
        let monic = |p: &Polynomial| p.monic().expect("not 0");
        assert_eq!(common(&product(&[&a, &b]), &product(&[&a, &c])), Some(monic(&a)));
        assert_eq!(
            common(&product(&[&a, &b, &b]), &product(&[&b, &b, &c])),
            Some(product(&[&b, &b]))
        );
        assert_eq!(common(&product(&[&a, &b]), &c), Some(number(1)));
        assert_eq!(common(&product(&[&a, &y]), &product(&[&y, &z])), Some(y.clone()));
        assert_eq!(product(&[&a, &b]).over(&b, &mut { MOST_WORK }), Some(a.clone()));
        assert_eq!(product(&[&a, &b]).plus(&number(1)).over(&b, &mut { MOST_WORK }), None);
    }
}
