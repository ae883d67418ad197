//! Terms in the names of a case, and the notation of their sums and products.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, Zero};

use liouville::case::Case;
use liouville::formula::{Formula, Type};
use liouville::graph::{Expr, Fault, Graph, record};
use liouville::mechanics::calculus::Jet;
use liouville::mechanics::{Phase, Vocabulary};
use liouville::number::rational::Rational;

/// A scalar in the names of a case.
#[derive(Clone, Debug)]
pub struct Term {
    /// Text of the term.
    pub text: String,
    /// Parsed formula.
    pub formula: Formula,
}

/// Parses the texts that are scalars in these names.
pub fn read(texts: Vec<String>, vocabulary: &Vocabulary) -> Vec<Term> {
    let scalar = |formula: &Formula| formula.value_type() == Type::Scalar;
    texts
        .into_iter()
        .filter_map(|text| {
            let formula = Formula::parse(&text, vocabulary).ok().filter(scalar)?;
            Some(Term { text, formula })
        })
        .collect()
}

/// Records values at a point of phase space; the inputs are parameters and state.
pub fn recorded<R>(
    case: &Case,
    make: impl FnOnce(&Jet<'_, Expr>) -> R,
) -> Result<(Graph, R), Fault> {
    let model = &case.model;
    let inputs = model.free_components() + model.dimension();
    record(inputs, |inputs| {
        let (parameters, state) = inputs.split_at(model.free_components());
        make(&Jet::new(Phase::new(model, parameters, state)))
    })
}

/// Clears denominators: a = multiples / denominator.
fn cleared(coefficients: &[Rational]) -> (Vec<BigInt>, BigInt) {
    let parts: Vec<(BigInt, BigInt)> = coefficients.iter().map(Rational::parts).collect();
    let below = parts.iter().fold(BigInt::from(1), |lcm, (_, below)| lcm.lcm(below));
    (parts.iter().map(|(above, own)| above * (&below / own)).collect(), below)
}

/// Writes Σ a_j T_j, up to a factor.
pub fn sum(coefficients: &[Rational], terms: &[&str]) -> String {
    let (mut multiples, _) = cleared(coefficients);
    let common = multiples.iter().fold(BigInt::ZERO, |gcd, a| gcd.gcd(a));
    if !common.is_zero() {
        multiples.iter_mut().for_each(|a| *a /= &common);
    }
    if multiples.iter().find(|a| !a.is_zero()).is_some_and(Signed::is_negative) {
        multiples.iter_mut().for_each(|a| *a = -a.clone());
    }
    written(&multiples, terms)
}

/// Clears denominators and drops them.
pub fn integers(coefficients: &[Rational]) -> Vec<BigInt> {
    cleared(coefficients).0
}

/// Writes Σ a_j T_j; an empty text for an empty sum.
pub fn written(multiples: &[BigInt], terms: &[&str]) -> String {
    let mut text = String::new();
    for (multiple, term) in multiples.iter().zip(terms).filter(|(a, _)| !a.is_zero()) {
        let sign = match (text.is_empty(), multiple.is_negative()) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        };
        let magnitude = multiple.abs();
        text.push_str(sign);
        text.push_str(&match (magnitude == 1.into(), *term) {
            (true, term) => term.to_string(),
            (false, "1") => magnitude.to_string(),
            (false, term) => format!("{magnitude}*{term}"),
        });
    }
    text
}

/// Writes the factors of Π f^α, where each α is a combination of the exponents.
pub fn powers(coefficients: &[Rational], factors: &[Term], exponents: &[&str]) -> Vec<String> {
    let each = coefficients.chunks(exponents.len().max(1));
    let used = factors.iter().zip(each).filter(|(_, own)| !own.iter().all(Rational::is_zero));
    used.map(|(factor, own)| match exponent(own, exponents).as_str() {
        "1" => factor.text.clone(),
        exponent => format!("{}^{exponent}", factor.text),
    })
    .collect()
}

/// Writes Σ a_j e_j as an exponent: `2`, `(1/2)`, `((1 + k*R)/2)`.
pub fn exponent(coefficients: &[Rational], exponents: &[&str]) -> String {
    let (multiples, below) = cleared(coefficients);
    let above = written(&multiples, exponents);
    let is_number = multiples.iter().zip(exponents).all(|(a, e)| a.is_zero() || *e == "1");
    match (below == 1.into(), is_number) {
        (true, true) if above.starts_with('−') => format!("({above})"),
        (true, true) => above,
        (true, false) => format!("({above})"),
        (false, true) => format!("({above}/{below})"),
        (false, false) => format!("(({above})/{below})"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_exponents_read_well() {
        let q = |n, d| Rational::new(n, d);
        assert_eq!(sum(&[q(-1, 2), q(0, 1), q(1, 3)], &["a", "b", "c"]), "3*a − 2*c");
        assert_eq!(exponent(&[q(1, 2)], &["1"]), "(1/2)");
        assert_eq!(exponent(&[q(1, 2), q(1, 2)], &["1", "k*R"]), "((1 + k*R)/2)");
        assert_eq!(exponent(&[q(-2, 1)], &["1"]), "(−2)");
        assert_eq!(exponent(&[q(3, 1), q(0, 1)], &["1", "k*R"]), "3");
    }
}
