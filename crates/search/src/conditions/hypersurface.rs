//! Polynomials in the parameters with rational coefficients, whose zeros are a condition.

use num_bigint::BigInt;

use liouville::formula::{Formula, FormulaError, FormulaResult};
use liouville::number::prime::{Modulus, Polynomial, PrimePolynomials};
use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::proof::reconstruct;

use super::real::Terms;
use super::relation::ScalarParameter;
use super::simple::{SimpleEquation, SimpleEquations};
use super::variety::{monomial, power};
use crate::ansatz::monomials::power_product;
use crate::terms;

/// Largest numerator and denominator of a coefficient, if one of them is 1.
const MOST: i64 = 1 << 20;

/// A polynomial modulo a prime: coefficients by exponents.
pub type PrimeTerms = Vec<(Vec<u32>, u64)>;

/// A condition of codimension one: the zeros of a polynomial in the parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hypersurface {
    /// Coefficients that are not 0 by exponents; those of high degree come first.
    terms: Terms,
}

impl Hypersurface {
    /// Reads rational coefficients off their images; `None` if they are not short, or all are 0.
    pub fn of(images: &PrimeTerms, m: &Modulus) -> Option<Self> {
        let used = images.iter().filter(|(_, image)| *image != 0);
        let mut images: PrimeTerms = used.cloned().collect();
        images.order_by(|(a, _), (b, _)| {
            let degree = |own: &[u32]| own.iter().sum::<u32>();
            degree(b).cmp(&degree(a)).then_with(|| b.cmp(a))
        });
        let scale = m.inverse(images.first()?.1);
        let number = |(exponents, image): &(Vec<u32>, u64)| {
            let value = reconstruct(m.mul(*image, scale), m)?;
            let (above, below) = value.small_parts()?;
            (above.abs() <= MOST && below <= MOST).then(|| (exponents.clone(), value))
        };
        let terms = images.iter().map(number).collect::<Option<Vec<_>>>()?;
        (terms[0].0.iter().sum::<u32>() > 0).then_some(Self { terms })
    }

    /// Makes a polynomial of terms that are each there once; `None` if it is constant.
    pub fn from_terms(mut terms: Terms) -> Option<Self> {
        terms.retain(|(_, value)| !value.is_zero());
        terms.order_by(|(a, _), (b, _)| degree(b).cmp(&degree(a)).then_with(|| b.cmp(a)));
        (degree(&terms.first()?.0) > 0).then_some(Self { terms })
    }

    /// The terms, those of high degree first.
    pub fn terms(&self) -> &Terms {
        &self.terms
    }

    /// Degree of the polynomial.
    pub fn degree(&self) -> usize {
        self.terms.first().map_or(0, |(exponents, _)| exponents.iter().sum::<u32>() as usize)
    }

    /// Restricts the polynomial to a line; `None` if a denominator is 0 modulo the prime.
    pub fn on_line(&self, m: &Modulus, origin: &[u64], slope: &[u64]) -> Option<Polynomial> {
        let images: Vec<u64> =
            self.terms.iter().map(|(_, value)| m.rational(value)).collect::<Option<_>>()?;
        let value = |t: u64| {
            let point = m.along(origin, slope, t);
            let terms = self.terms.iter().zip(&images);
            terms.fold(0, |sum, ((exponents, _), image)| {
                m.add(sum, m.mul(*image, power(&point, exponents, m)))
            })
        };
        let points = (0..=self.degree() as u64).map(|t| m.integer(t)).map(|t| (t, value(t)));
        Some(PrimePolynomials(*m).through(&points.collect::<Vec<_>>()).0)
    }

    /// Images of the coefficients; `None` if a denominator is 0 modulo the prime.
    pub fn images(&self, m: &Modulus) -> Option<PrimeTerms> {
        self.terms.iter().map(|(own, value)| Some((own.clone(), m.rational(value)?))).collect()
    }

    /// Whether a scalar occurs.
    pub fn contains(&self, place: usize) -> bool {
        self.terms.iter().any(|(own, _)| own[place] > 0)
    }

    /// Writes the equation: `A = 2*B`, `k = 6`, `a*b − c² = 0`.
    pub fn equation(&self, parameters: &[ScalarParameter]) -> String {
        let names: Vec<&str> = parameters.iter().map(|own| own.name.as_str()).collect();
        match self.terms.as_slice() {
            [(only, _)] => format!("{} = 0", monomial(&names, only)),
            [(x, a), (y, b)] if degree(x) == 1 && degree(y) <= 1 => {
                let inverse = a.recip().unwrap_or_else(|| Rational::from(0));
                let ratio = &Rational::from(0) - &(b * &inverse);
                let first = monomial(&names, x);
                if degree(y) == 0 {
                    return format!("{first} = {ratio}");
                }
                let second = monomial(&names, y);
                let multiple = |number: Rational, name: &str| match number == Rational::from(1) {
                    true => name.to_string(),
                    false => format!("{number}*{name}"),
                };
                // b = 6 a is better than 6 a = b.
                if let Some(inverse) = ratio.recip().filter(|own| own.to_integer() > Some(1)) {
                    return format!("{second} = {}", multiple(inverse, &first));
                }
                let (above, below) = ratio.parts();
                let one = || 1.into();
                let above = Rational::from_parts(above, one());
                let below = Rational::from_parts(below, one());
                match above.is_negative() {
                    // a + 2 b = 0
                    true => self.sum(&names),
                    false => format!("{} = {}", multiple(below, &first), multiple(above, &second)),
                }
            }
            _ => self.sum(&names),
        }
    }

    fn sum(&self, names: &[&str]) -> String {
        let texts: Vec<String> = self.terms.iter().map(|(own, _)| monomial(names, own)).collect();
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        let numbers: Vec<Rational> = self.terms.iter().map(|(_, value)| value.clone()).collect();
        terms::equation(&numbers, &texts)
    }

    /// Solves for a parameter that occurs linearly: its place, and its value as a formula of the others.
    /// One with a constant factor is preferred, then a late one. `None` if there is none.
    pub fn solved(&self, letters: &[Formula]) -> Result<Option<(usize, Formula)>, FormulaError> {
        let weight = |place: &usize| {
            let factor = self.parts(*place).0;
            (factor.len(), factor.iter().map(|(own, _)| degree(own)).max(), usize::MAX - place)
        };
        let linear = (0..letters.len()).filter(|place| self.is_linear(*place));
        let Some(place) = linear.min_by_key(weight) else { return Ok(None) };
        Ok(Some((place, self.solved_for(place, letters)?)))
    }

    /// Whether a scalar occurs to the first power.
    pub fn is_linear(&self, place: usize) -> bool {
        self.terms.iter().map(|(own, _)| own[place]).max() == Some(1)
    }

    /// Value of a scalar that occurs linearly.
    pub fn solved_for(&self, place: usize, letters: &[Formula]) -> FormulaResult {
        let (factor, rest) = self.parts(place);
        negative_quotient(&rest, &factor, letters)
    }

    /// Factor of a scalar that occurs linearly, and the terms without it.
    fn parts(&self, place: usize) -> (Terms, Terms) {
        let (mut with, without): (Terms, Terms) =
            self.terms.iter().cloned().partition(|(own, _)| own[place] == 1);
        with.iter_mut().for_each(|(own, _)| own[place] = 0);
        (with, without)
    }

    /// The only scalar that occurs, with the coefficients from low to high degree; `None` if there are
    /// several.
    pub fn univariate(&self) -> Option<(usize, Vec<Rational>)> {
        let count = self.terms.first()?.0.len();
        let mut places = (0..count).filter(|place| self.contains(*place));
        let (place, None) = (places.next()?, places.next()) else { return None };
        let mut coefficients = vec![Rational::from(0); self.degree() + 1];
        for (own, value) in &self.terms {
            coefficients[own[place] as usize] = value.clone();
        }
        Some((place, coefficients))
    }

    /// The same polynomial where simple equations hold, in the scalars that remain free; `None` if it
    /// vanishes there.
    pub fn under(&self, equations: &SimpleEquations) -> Option<Self> {
        let mut terms = Terms::new();
        'terms: for (exponents, value) in &self.terms {
            let mut own = vec![0; exponents.len()];
            for (power, first) in exponents.iter().zip(equations.first()) {
                match first {
                    Some(first) => own[*first] += power,
                    None if *power > 0 => continue 'terms,
                    None => {}
                }
            }
            match terms.iter_mut().find(|(known, _)| *known == own) {
                Some((_, sum)) => *sum = &*sum + value,
                None => terms.push((own, value.clone())),
            }
        }
        terms.retain(|(_, value)| !value.is_zero());
        terms.order_by(|(a, _), (b, _)| degree(b).cmp(&degree(a)).then_with(|| b.cmp(a)));
        (!terms.is_empty()).then_some(Self { terms })
    }

    /// The polynomial in some of the scalars, among which are all that occur.
    pub fn among(&self, places: &[usize]) -> Self {
        let own = |exponents: &Vec<u32>| places.iter().map(|place| exponents[*place]).collect();
        Self {
            terms: self
                .terms
                .iter()
                .map(|(own_terms, value)| (own(own_terms), value.clone()))
                .collect(),
        }
    }

    /// The polynomial in some of the scalars as one in all of them.
    pub fn spread(&self, places: &[usize], count: usize) -> Self {
        let spread = |exponents: &Vec<u32>| {
            let mut own = vec![0; count];
            places.iter().zip(exponents).for_each(|(place, power)| own[*place] = *power);
            own
        };
        Self { terms: self.terms.iter().map(|(own, value)| (spread(own), value.clone())).collect() }
    }

    /// The polynomial x or x − y of a simple equation between some number of scalars.
    pub fn from(equation: SimpleEquation, count: usize) -> Self {
        let unit = |place: usize| (0..count).map(|k| u32::from(k == place)).collect();
        let one = Rational::from(1);
        let terms = match equation {
            SimpleEquation::Zero(x) => vec![(unit(x), one)],
            SimpleEquation::Equal(x, y) => {
                let (x, y) = (x.min(y), x.max(y));
                vec![(unit(x), one), (unit(y), Rational::from(-1))]
            }
        };
        Self { terms }
    }

    /// Whether it is a constant multiple of another.
    pub fn is_multiple(&self, other: &Self) -> bool {
        let scaled = |own: &Self| -> Option<Vec<(Vec<u32>, Rational)>> {
            let inverse = own.terms.first()?.1.recip()?;
            Some(own.terms.iter().map(|(a, value)| (a.clone(), value * &inverse)).collect())
        };
        scaled(self) == scaled(other)
    }

    /// The equation as a simple one, if it is x = 0 or x = y.
    pub fn simple(&self) -> Option<SimpleEquation> {
        let place = |own: &[u32]| own.iter().position(|power| *power > 0);
        match self.terms.as_slice() {
            [(x, _)] if degree(x) == 1 => Some(SimpleEquation::Zero(place(x)?)),
            [(x, a), (y, b)] if degree(x) == 1 && degree(y) == 1 && (a + b).is_zero() => {
                Some(SimpleEquation::Equal(place(x)?, place(y)?))
            }
            _ => None,
        }
    }
}

fn degree(exponents: &[u32]) -> u32 {
    exponents.iter().sum()
}

/// −a/b as a formula; 0 if a has no terms.
fn negative_quotient(above: &Terms, below: &Terms, letters: &[Formula]) -> FormulaResult {
    if above.is_empty() {
        return Ok(Formula::number(0));
    }
    let turned = below.first().is_some_and(|(_, value)| value.is_negative());
    let signed = |value: &Rational, turned: bool| if turned { -value } else { value.clone() };
    let numbers: Vec<Rational> = above
        .iter()
        .map(|(_, value)| signed(value, !turned))
        .chain(below.iter().map(|(_, value)| signed(value, turned)))
        .collect();
    // Both have one denominator.
    let numbers = terms::integers(&numbers);
    let (over, under) = numbers.split_at(above.len());
    let made = |numbers: &[BigInt], own: &Terms| {
        let products = own.iter().map(|(exponents, _)| power_product(letters, exponents));
        terms::combined(numbers, &products.collect::<Result<Vec<_>, _>>()?)
    };
    let over = made(over, above)?.unwrap_or_else(|| Formula::number(0));
    let under = made(under, below)?.unwrap_or_else(terms::one);
    if terms::is_one(&under) { Ok(over) } else { over / &under }
}

#[cfg(test)]
mod tests {
    use super::super::split::SplitCase;
    use super::*;
    use liouville::case::Case;

    fn named(names: &[&str]) -> Vec<ScalarParameter> {
        let own = names.iter().enumerate();
        own.map(|(draw, name)| ScalarParameter { name: name.to_string(), draw }).collect()
    }

    /// Exponents and coefficients.
    type Given<'t> = &'t [(&'t [u32], (i64, i64))];

    fn surface(terms: Given<'_>) -> Hypersurface {
        let terms = terms.iter().map(|(own, (n, d))| (own.to_vec(), Rational::new(*n, *d)));
        Hypersurface { terms: terms.collect() }
    }

    #[test]
    fn equations_are_written_and_solved() {
        let names = named(&["a", "b"]);
        let written: [(Given<'_>, &str); 5] = [
            (&[(&[1, 0], (1, 1)), (&[0, 1], (-1, 1))], "a = b"),
            (&[(&[1, 0], (1, 1)), (&[0, 1], (-2, 3))], "3*a = 2*b"),
            (&[(&[0, 1], (1, 1)), (&[0, 0], (6, 1))], "b = -6"),
            (&[(&[1, 1], (1, 1)), (&[0, 0], (-4, 1))], "a*b − 4 = 0"),
            (&[(&[2, 0], (1, 1)), (&[0, 2], (-2, 1))], "a² − 2*b² = 0"),
        ];
        for (terms, text) in written {
            assert_eq!(surface(terms).equation(&names), text);
        }
        let case = Case::parse(
            "title = 'a'\n[parameters]\na = '1..2'\nb = '1..2'\n[state]\nx = '-1..1'\n[field]\n\
             \"x'\" = 'a*b*x'\n",
            &[],
        )
        .expect("a case");
        let letters = SplitCase::of(&case).letters().expect("names");
        let solved = |terms| {
            let found = surface(terms).solved(&letters).expect("a formula");
            found.map(|(place, value)| (place, value.to_string()))
        };
        let by = |value: &str| Some((1, value.to_string()));
        assert_eq!(solved(&[(&[1, 0], (1, 1)), (&[0, 1], (-1, 1))]), by("a"));
        assert_eq!(solved(&[(&[1, 1], (1, 1)), (&[0, 0], (-4, 1))]), by("4/a"));
        assert_eq!(solved(&[(&[1, 0], (3, 1)), (&[0, 1], (2, 1))]), by("−3*a/2"));
        assert_eq!(solved(&[(&[2, 0], (1, 1)), (&[0, 1], (2, 3))]), by("−3*a²/2"));
        assert_eq!(solved(&[(&[1, 1], (1, 1))]), by("0"), "a product");
        let squares = surface(&[(&[2, 0], (1, 1)), (&[0, 2], (-2, 1))]);
        assert_eq!(solved(&[(&[2, 0], (1, 1)), (&[0, 2], (-2, 1))]), None, "none is linear");
        let equal = SimpleEquations::none(2).with(SimpleEquation::Equal(0, 1));
        assert_eq!(squares.under(&equal), Some(surface(&[(&[2, 0], (-1, 1))])));
        let difference = surface(&[(&[1, 0], (1, 1)), (&[0, 1], (-1, 1))]);
        assert_eq!(difference.under(&equal), None, "it vanishes where a = b");
        assert_eq!(difference.simple(), Some(SimpleEquation::Equal(0, 1)));
        assert_eq!(squares.simple(), None);
        assert_eq!(squares.spread(&[2, 0], 3).among(&[2, 0]), squares);
    }
}
