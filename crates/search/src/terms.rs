//! Sums and products of terms in the names of a case.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, Zero};

use liouville::case::Case;
use liouville::formula::{Formula, FormulaError, FormulaResult, Type};
use liouville::graph::{Expr, Fault, Graph, Step, record};
use liouville::mechanics::calculus::DualPoint;
use liouville::mechanics::{Phase, Vocabulary};
use liouville::number::rational::Rational;

/// Reads the texts that are scalars in these names.
pub fn read<'t>(texts: impl IntoIterator<Item = &'t str>, vocabulary: &Vocabulary) -> Vec<Formula> {
    let scalar = |formula: &Formula| formula.value_type() == Type::Scalar;
    let read = |text| Formula::parse(text, vocabulary).ok().filter(scalar);
    texts.into_iter().filter_map(read).collect()
}

/// Records values at a point of phase space; the inputs are parameters and state.
pub fn recorded<R>(
    case: &Case,
    make: impl FnOnce(&DualPoint<'_, Expr>) -> R,
) -> Result<(Graph, R), Fault> {
    let model = &case.model;
    let inputs = model.free_components() + model.dimension();
    record(inputs, |inputs| make(&point_of(case, inputs)))
}

/// The point whose parameters and state are these inputs; compiled once, not for each closure.
#[inline(never)]
fn point_of<'a>(case: &'a Case, inputs: &'a [Expr]) -> DualPoint<'a, Expr> {
    let (parameters, state) = inputs.split_at(case.model.free_components());
    DualPoint::new(Phase::new(&case.model, parameters, state))
}

/// Steps of a record that depend on the state, whose inputs follow those of the parameters.
pub fn varying(graph: &Graph, parameters: usize) -> Vec<bool> {
    let mut varies = vec![false; graph.len()];
    for (place, step) in graph.steps().enumerate() {
        varies[place] = match step {
            Step::Input(input) => input >= parameters,
            _ => step.arguments().any(|argument| varies[argument]),
        };
    }
    varies
}

/// The number 1 as a formula.
pub fn one() -> Formula {
    Formula::number(1)
}

/// Whether a formula is the number 1.
pub fn is_one(formula: &Formula) -> bool {
    formula.constant().is_some_and(|value| value == Rational::from(1))
}

/// Product of two factors, of which one may be 1.
pub fn product(a: &Formula, b: &Formula) -> FormulaResult {
    match (is_one(a), is_one(b)) {
        (true, _) => Ok(b.clone()),
        (_, true) => Ok(a.clone()),
        _ => a * b,
    }
}

/// Whole number as a formula.
pub fn whole(number: &BigInt) -> Formula {
    Formula::number(Rational::from_parts(number.clone(), BigInt::from(1)))
}

/// Clears denominators: a = multiples / denominator.
fn cleared(coefficients: &[Rational]) -> (Vec<BigInt>, BigInt) {
    let parts: Vec<(BigInt, BigInt)> = coefficients.iter().map(Rational::parts).collect();
    let below = parts.iter().fold(BigInt::from(1), |lcm, (_, below)| lcm.lcm(below));
    (parts.iter().map(|(above, own)| above * (&below / own)).collect(), below)
}

/// Multiples without a common factor, the first that is not 0 positive.
pub fn primitive(coefficients: &[Rational]) -> Vec<BigInt> {
    let (mut multiples, _) = cleared(coefficients);
    let common = multiples.iter().fold(BigInt::ZERO, |gcd, a| gcd.gcd(a));
    if !common.is_zero() {
        multiples.iter_mut().for_each(|a| *a /= &common);
    }
    if multiples.iter().find(|a| !a.is_zero()).is_some_and(Signed::is_negative) {
        multiples.iter_mut().for_each(|a| *a = -a.clone());
    }
    multiples
}

/// Clears denominators and drops them.
pub fn integers(coefficients: &[Rational]) -> Vec<BigInt> {
    cleared(coefficients).0
}

/// A sum that grows term by term, with a sign before each.
#[derive(Default)]
pub struct TermSum(Option<Formula>);

impl TermSum {
    /// Adds a term, or subtracts it.
    pub fn add(&mut self, is_negative: bool, term: &Formula) -> Result<(), FormulaError> {
        let sum = match (self.0.take(), is_negative) {
            (None, false) => term.clone(),
            (None, true) => -term,
            (Some(before), false) => (&before + term)?,
            (Some(before), true) => (&before - term)?,
        };
        self.0 = Some(sum);
        Ok(())
    }

    /// The sum; `None` where nothing was added.
    pub fn total(self) -> Option<Formula> {
        self.0
    }
}

/// Σ a_j T_j, up to a factor.
pub fn sum(coefficients: &[Rational], terms: &[Formula]) -> FormulaResult {
    Ok(combined(&primitive(coefficients), terms)?.unwrap_or_else(|| Formula::number(0)))
}

/// Σ a_j T_j; `None` for an empty sum.
pub fn combined(multiples: &[BigInt], terms: &[Formula]) -> Result<Option<Formula>, FormulaError> {
    let mut sum = TermSum::default();
    for (multiple, term) in multiples.iter().zip(terms).filter(|(a, _)| !a.is_zero()) {
        let magnitude = multiple.abs();
        let own = match (magnitude == 1.into(), is_one(term)) {
            (true, _) => term.clone(),
            (false, true) => whole(&magnitude),
            (false, false) => (whole(&magnitude) * term)?,
        };
        sum.add(multiple.is_negative(), &own)?;
    }
    Ok(sum.total())
}

/// Writes the equation Σ a_j T_j = 0 for a report.
pub fn equation(coefficients: &[Rational], terms: &[&str]) -> String {
    let mut text = String::new();
    for (multiple, term) in primitive(coefficients).iter().zip(terms).filter(|(a, _)| !a.is_zero())
    {
        text.push_str(match (text.is_empty(), multiple.is_negative()) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        });
        let magnitude = multiple.abs();
        text.push_str(&match (magnitude == 1.into(), *term) {
            (true, term) => term.to_string(),
            (false, "1") => magnitude.to_string(),
            (false, term) => format!("{magnitude}*{term}"),
        });
    }
    format!("{text} = 0")
}

/// A factor with its exponent.
pub type Power = (Formula, Formula);

/// Product of powers, those with negative whole exponents below the line: `(x + y)/(x*z²)`; 1 of none.
pub fn multiplied(powers: &[Power]) -> FormulaResult {
    let (mut above, mut below): (Option<Formula>, Option<Formula>) = (None, None);
    for (base, exponent) in powers {
        let divisor = exponent.constant().filter(Rational::is_negative);
        let (place, own) = match divisor.and_then(|value| (-&value).to_integer()) {
            Some(power) => (&mut below, whole_power(base, power)?),
            None if is_one(exponent) => (&mut above, base.clone()),
            None => (&mut above, base.power(exponent)?),
        };
        *place = Some(match place.take() {
            None => own,
            Some(all) => (&all * &own)?,
        });
    }
    let above = above.unwrap_or_else(one);
    below.map_or(Ok(above.clone()), |below| &above / &below)
}

/// A positive power: `x`, `x²`, `x¹¹`.
fn whole_power(base: &Formula, power: i64) -> FormulaResult {
    match power {
        1 => Ok(base.clone()),
        2 => base.raised(2),
        3 => base.raised(3),
        _ => base.power(&Formula::number(power)),
    }
}

/// Factors of Π f^α with their exponents, where each α is a combination of some.
pub fn powers(
    coefficients: &[Rational],
    factors: &[Formula],
    exponents: &[Formula],
) -> Result<Vec<Power>, FormulaError> {
    let each = coefficients.chunks(exponents.len().max(1));
    let used = factors.iter().zip(each).filter(|(_, own)| !own.iter().all(Rational::is_zero));
    used.map(|(factor, own)| Ok((factor.clone(), exponent(own, exponents)?))).collect()
}

/// Σ a_j e_j as an exponent: `2`, `(1/2)`, `((1 + k*R)/2)`.
pub fn exponent(coefficients: &[Rational], exponents: &[Formula]) -> FormulaResult {
    let (multiples, below) = cleared(coefficients);
    let above = combined(&multiples, exponents)?.unwrap_or_else(|| Formula::number(0));
    let is_number = above.constant().is_some();
    let is_negative = above.constant().is_some_and(|value| value.is_negative());
    match (below == 1.into(), is_number) {
        (true, true) if !is_negative => Ok(above),
        (true, _) => Ok(above.bracketed()),
        (false, true) => Ok((&above / &whole(&below))?.bracketed()),
        (false, false) => Ok((above.bracketed() / &whole(&below))?.bracketed()),
    }
}

/// A number as an exponent: `2`, `(1/2)`, `(−2)`.
pub fn numeric_exponent(value: Rational) -> FormulaResult {
    exponent(&[value], &[one()])
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::formula::{Scope, Symbol};

    struct TermLetters;

    impl Scope for TermLetters {
        fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
            let place = ["a", "b", "c", "k", "R"].iter().position(|known| *known == name)?;
            Some((Symbol(place as u32), Type::Scalar))
        }

        fn names(&self) -> Vec<String> {
            Vec::new()
        }
    }

    #[test]
    fn powers_that_divide_stand_below_the_line() {
        let f = |text: &str| Formula::parse(text, &TermLetters).expect("a formula");
        let product = |own: &[(&str, &str)]| {
            let powers: Vec<Power> = own.iter().map(|(base, power)| (f(base), f(power))).collect();
            multiplied(&powers).expect("scalars").to_string()
        };
        assert_eq!(product(&[]), "1");
        assert_eq!(product(&[("a", "(−1)"), ("b", "(−1)")]), "1/(a*b)");
        assert_eq!(product(&[("a + b", "1"), ("a", "(−2)"), ("c", "−11")]), "(a + b)/(a²*c¹¹)");
        assert_eq!(product(&[("a + b", "−1"), ("a", "(−1/2)")]), "a^(−1/2)/(a + b)");
        assert_eq!(product(&[("a", "k"), ("b", "−k")]), "a^k*b^(−k)", "of an unknown sign");
    }

    #[test]
    fn sums_and_exponents_read_well() {
        let q = |n, d| Rational::new(n, d);
        let f = |text: &str| Formula::parse(text, &TermLetters).expect("a formula");
        let text = |made: FormulaResult| made.expect("scalars").to_string();
        let terms = ["a", "b", "c"].map(f);
        assert_eq!(text(sum(&[q(-1, 2), q(0, 1), q(1, 3)], &terms)), "3*a − 2*c");
        assert_eq!(equation(&[q(-1, 2), q(0, 1), q(1, 3)], &["a", "b", "c"]), "3*a − 2*c = 0");
        let both = ["1", "k*R"].map(f);
        assert_eq!(text(numeric_exponent(q(1, 2))), "(1/2)");
        assert_eq!(text(exponent(&[q(1, 2), q(1, 2)], &both)), "((1 + k*R)/2)");
        assert_eq!(text(numeric_exponent(q(-2, 1))), "(−2)");
        assert_eq!(text(exponent(&[q(3, 1), q(0, 1)], &both)), "3");
        let products = ["a + b", "a*b"].map(f);
        assert_eq!(text(sum(&[q(2, 1), q(-3, 1)], &products)), "2*(a + b) − 3*a*b");
    }
}
