//! Angles and hyperbolic angles of conjugate Darboux polynomials.
//!
//! g + √D h and g − √D h are conjugate factors of g² − D h². The half logarithm of their quotient,
//! over √D, is A = atan(√−D h/g)/√−D, or ln |(g + √D h)/(g − √D h)|/(2√D). Its rate
//! (h'g − hg')/(g² − D h²) is a polynomial without roots, as a cofactor is.

use liouville::formula::{Formula, FormulaError};
use liouville::graph::Tape;
use liouville::number::exact::square_root;
use liouville::number::rational::Rational;
use num_bigint::BigInt;
use num_traits::Zero;

use super::super::SearchError;
use super::super::ansatz::coefficients::{Polynomial, Ratio};
use super::super::ansatz::monomials::power_product;
use super::super::ansatz::system::PrimePoint;
use super::super::terms::{combined, is_one, primitive, recorded};
use super::factor::RatedPolynomial;
use super::images::{self, Images, ParametricVector};
use super::setting::{OrbitSetting, PrimePhasePoint, run};
use super::squares::{self, SquareFraction};

/// Number of choices of the parameters tried until √D exists.
const TRIES: u64 = 16;
/// Bound above the numbers whose squares are taken out of a root.
const LARGEST_ROOT: i64 = 1000;

/// Form of an angle: that of a circle for D < 0, hyperbolic for D > 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngleForm {
    /// An arctangent.
    Circular,
    /// A logarithm.
    Hyperbolic,
}

/// The square D of a root.
#[derive(Clone)]
pub struct SquareOfRoot {
    formula: Formula,
    /// −D
    opposite: Formula,
    /// Value, if it is a number.
    number: Option<Rational>,
}

impl SquareOfRoot {
    /// Reads D.
    pub fn of(formula: Formula) -> Self {
        let number = formula.constant();
        let opposite = match &number {
            Some(number) => Formula::number(-number),
            None => -&formula,
        };
        Self { formula, opposite, number }
    }
}

/// A pair of conjugate polynomials g ± √D h.
#[derive(Clone)]
pub struct ConjugatePair {
    even: RatedPolynomial,
    odd: RatedPolynomial,
    /// D
    square: SquareOfRoot,
    tape: Tape,
}

impl ConjugatePair {
    /// Finds g, h and D from the coefficients of the pair, 1 at the last monomial of its support, for
    /// choices of the parameters.
    pub fn of(
        setting: &OrbitSetting<'_>,
        support: &[Vec<u32>],
        degree: u32,
        pair: impl Fn(&PrimePoint) -> Option<[Vec<u64>; 2]>,
    ) -> Result<Option<Self>, SearchError> {
        let Some(count) = support.len().checked_sub(1) else { return Ok(None) };
        let halves = |at: &PrimePoint| {
            let m = at.modulus;
            let [p, q] = pair(at)?;
            let half = m.inverse(m.integer(2));
            let sum = |k: usize| m.mul(half, m.add(p[k], q[k]));
            let difference = |k: usize| m.mul(half, m.sub(p[k], q[k]));
            let own = [(0..count).map(sum).collect(), (0..count).map(difference).collect()];
            Some(own) as Option<[Vec<u64>; 2]>
        };
        // √D exists for half of the choices.
        let mut first = (0..TRIES).filter_map(|index| halves(&setting.split(0, index)?));
        let Some(odd) = first.next().and_then(|[_, odd]| odd.iter().position(|entry| *entry != 0))
        else {
            return Ok(None);
        };
        let make = |at: &PrimePoint| {
            let m = at.modulus;
            let [sums, differences] = halves(at)?;
            let unit = differences[odd];
            (unit != 0).then_some(())?;
            let ratios = differences.iter().map(|own| m.mul(*own, m.inverse(unit)));
            Some(sums.into_iter().chain(ratios).chain([m.mul(unit, unit)]).collect())
        };
        let images = Images { setting, width: 2 * count + 1, is_split: true, make };
        let Some(vector) = images::vector(&images)? else { return Ok(None) };
        let monomials: Vec<Formula> = support
            .iter()
            .map(|own| power_product(&setting.terms, own))
            .collect::<Result<_, FormulaError>>()?;
        let found = match (0..=2 * count).map(|k| vector.entry(k)).collect::<Option<Vec<_>>>() {
            Some(numbers) => of_numbers(&numbers, &monomials)?,
            None => of_functions(&vector, &monomials)?,
        };
        let Some((even, odd, square)) = found else { return Ok(None) };
        Self::rated(setting, [&even, &odd], square, degree)
    }

    /// The pair g ± √D h with its rates; `square` is D.
    pub fn rated(
        setting: &OrbitSetting<'_>,
        [even, odd]: [&Formula; 2],
        square: SquareOfRoot,
        degree: u32,
    ) -> Result<Option<Self>, SearchError> {
        let (graph, value) = recorded(setting.case, |jet| jet.phase.scalar(&square.formula))?;
        let tape = Tape::new(&graph, &[value]);
        let (Some(even), Some(odd)) = (
            RatedPolynomial::of(setting, even, degree)?,
            RatedPolynomial::of(setting, odd, degree)?,
        ) else {
            return Ok(None);
        };
        Ok(Some(Self { even, odd, square, tape }))
    }

    /// The same pair with its rates along another field of these variables.
    pub fn along(&self, setting: &OrbitSetting<'_>) -> Result<Option<Self>, SearchError> {
        let own = [&self.even.formula, &self.odd.formula];
        Self::rated(setting, own, self.square.clone(), self.even.degree)
    }

    /// Whether two pairs are written alike.
    pub fn is_same(&self, other: &Self) -> bool {
        let texts = |own: &Self| [own.even.formula.to_string(), own.odd.formula.to_string()];
        texts(self) == texts(other)
    }

    /// Rate of the angle at a point.
    pub fn rate(&self, at: &PrimePoint, point: &PrimePhasePoint) -> Option<u64> {
        let m = at.modulus;
        let ((g, dg), (h, dh)) = (self.even.at(at, point)?, self.odd.at(at, point)?);
        let inputs = [point.parameters.as_slice(), &point.state].concat();
        let square = run(&self.tape, m, &inputs)?[0];
        let below = m.sub(m.mul(g, g), m.mul(square, m.mul(h, h)));
        let above = m.sub(m.mul(dh, g), m.mul(h, dg));
        (below != 0).then(|| m.mul(above, m.inverse(below)))
    }

    /// The angle as a formula; `None` if √D, or √−D, is not real.
    pub fn formula(&self, form: AngleForm) -> Result<Option<Formula>, FormulaError> {
        let Some(root) = self.root(form)? else { return Ok(None) };
        let (g, h) = (&self.even.formula, &self.odd.formula);
        let odd = if is_one(&root) { h.clone() } else { (&root * h)? };
        let angle = match form {
            AngleForm::Circular => Formula::call("atan", &[&(&odd / g)?])?,
            AngleForm::Hyperbolic => {
                let quotient = ((g + &odd)? / &(g - &odd)?)?;
                let below = (Formula::number(2) * &root)?;
                return (Formula::call("ln", &[&quotient.modulus()?])? / &below).map(Some);
            }
        };
        Ok(Some(if is_one(&root) { angle } else { (angle / &root)? }))
    }

    fn root(&self, form: AngleForm) -> Result<Option<Formula>, FormulaError> {
        let SquareOfRoot { formula, opposite, number } = &self.square;
        let own = match (number, form) {
            (Some(number), _) => {
                let own = if form == AngleForm::Circular { -number } else { number.clone() };
                if own.is_negative() || own.is_zero() {
                    return Ok(None);
                }
                if let Some(root) = square_root(&own) {
                    return Ok(Some(Formula::number(root)));
                }
                Formula::number(own)
            }
            (None, AngleForm::Circular) => opposite.clone(),
            (None, AngleForm::Hyperbolic) => formula.clone(),
        };
        Formula::call("sqrt", &[&own]).map(Some)
    }
}

/// g, h and D.
type Parts = Option<(Formula, Formula, SquareOfRoot)>;

/// Writes a pair with numbers as coefficients, those of g, of h, and D; D becomes a whole number
/// without small square factors.
fn of_numbers(numbers: &[Rational], monomials: &[Formula]) -> Result<Parts, FormulaError> {
    let Some((square, coefficients)) = numbers.split_last() else { return Ok(None) };
    let (even, odd) = coefficients.split_at(coefficients.len() / 2);
    let (above, below) = square.parts();
    // √(n/d) = k √s/d with n d = k² s
    let (root, rest) = without_squares(above * &below);
    let factor = Rational::from_parts(root, below);
    let last = Rational::from(1);
    let odd: Vec<Rational> = odd.iter().map(|own| own * &factor).collect();
    let all: Vec<Rational> = even.iter().chain([&last]).chain(&odd).cloned().collect();
    let multiples = primitive(&all);
    let (even, odd) = multiples.split_at(even.len() + 1);
    let (even, odd) = (combined(even, monomials)?, combined(odd, monomials)?);
    let rest = Rational::from_parts(rest, BigInt::from(1));
    let square = SquareOfRoot::of(Formula::number(rest));
    Ok(even.zip(odd).map(|(even, odd)| (even, odd, square)))
}

/// Writes a pair with coefficients that are functions of the parameters; where D is the square of such a
/// function, up to a number, this number is in its place.
fn of_functions(vector: &ParametricVector, monomials: &[Formula]) -> Result<Parts, FormulaError> {
    let count = monomials.len() - 1;
    let all = &vector.coefficients.polynomials;
    // The common denominator, at the end, belongs to the last monomial.
    let even: Vec<&Polynomial> = all[..count].iter().chain([&all[2 * count + 1]]).collect();
    let odd: Vec<&Polynomial> = all[count..2 * count].iter().collect();
    let [above, below] = squares::reduced(&all[2 * count], &all[2 * count + 1]);
    let Some(SquareFraction { numbers: [n, d], roots: [upper, lower], rest: [p, q] }) =
        squares::square_fraction(&above, &below)
    else {
        return Ok(None);
    };
    // √(n/d) = k √s/d with n d = k² s
    let (root, rest) = without_squares(&n * &d);
    let even = even.into_iter().map(|own| squares::multiple(&squares::times(own, &lower), &d));
    let odd = odd.into_iter().map(|own| squares::multiple(&squares::times(own, &upper), &root));
    let mut made = vector.coefficients.clone();
    made.polynomials =
        squares::without_common(even.chain(odd).collect(), &[upper, lower, q.clone()]);
    let terms: Vec<Ratio> = monomials.iter().cloned().map(Ratio::of).collect();
    let even = made.sum(&(0..=count).collect::<Vec<_>>(), &terms)?;
    let odd = made.sum(&(count + 1..2 * count + 1).collect::<Vec<_>>(), &terms[..count])?;
    let number = Some(Rational::from_parts(rest.clone(), BigInt::from(1)));
    let is_number = squares::is_one(&p) && squares::is_one(&q);
    made.polynomials = vec![squares::multiple(&p, &rest), squares::multiple(&p, &-rest), q];
    let fraction = |place: usize| -> Result<Formula, FormulaError> {
        let (above, below) = (made.formula(place)?, made.formula(2)?);
        if is_one(&below) { Ok(above) } else { above / &below }
    };
    let square = SquareOfRoot {
        formula: fraction(0)?,
        opposite: fraction(1)?,
        number: number.filter(|_| is_number),
    };
    Ok(even.zip(odd).map(|(even, odd)| (even, odd, square)))
}

/// Writes a number as k² s, without small square factors in s.
fn without_squares(number: BigInt) -> (BigInt, BigInt) {
    let (mut root, mut rest) = (BigInt::from(1), number);
    for factor in 2..LARGEST_ROOT {
        let square = BigInt::from(factor * factor);
        while !rest.is_zero() && (&rest % &square).is_zero() {
            rest /= &square;
            root *= factor;
        }
    }
    (root, rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_are_taken_out() {
        let whole = |n: i64| BigInt::from(n);
        assert_eq!(without_squares(whole(-72)), (whole(6), whole(-2)), "−72 = 6² · −2");
        assert_eq!(without_squares(whole(0)), (whole(1), whole(0)));
    }
}
