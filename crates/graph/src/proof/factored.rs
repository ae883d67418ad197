//! Values as products of factors, and as sums of such products.

use crate::graph::{Expr, Graph};
use crate::number::rational::Rational;

use super::collected::{MOST_LETTERS, NamedPolynomial, ReadValue, ShownSign, SimplerForm};
use super::normal::normalised;
use super::paired::pairs;
use super::polynomial::{MOST_WORK, Polynomial};

/// A factor: its text, whether this is a sum, and the power.
type Factor = (String, bool, u32);

/// Writes c Π f^m with f in brackets where it is a sum.
pub(super) fn product(coefficient: String, factors: impl Iterator<Item = Factor>) -> String {
    let mut all: Vec<String> = Vec::new();
    let sign = match coefficient.as_str() {
        "1" => "",
        "-1" => "-",
        _ => {
            all.push(coefficient);
            ""
        }
    };
    all.extend(factors.filter(|(.., power)| *power > 0).map(|(text, is_sum, power)| {
        let base = if is_sum { format!("({text})") } else { text };
        if power == 1 { base } else { format!("{base}^{power}") }
    }));
    match all.is_empty() {
        true => format!("{sign}1"),
        false => format!("{sign}{}", all.join("*")),
    }
}

/// Writes the sum of some values, each as a quotient of products; `names` are those of the inputs.
pub fn factored_sum(
    graph: &Graph,
    terms: &[Expr],
    first: usize,
    names: &[String],
    shown: ShownSign<'_>,
) -> Option<SimplerForm> {
    let normal = normalised(graph, terms);
    let (graph, terms) = match &normal {
        Some((graph, terms)) => (graph, terms.as_slice()),
        None => (graph, terms),
    };
    let mut divides = false;
    let mut texts = Vec::new();
    for term in terms {
        let read = ReadValue::of(graph, *term, first, names)?;
        if read.whole.above.is_zero() {
            continue;
        }
        divides |= read.whole.below.number().is_none();
        let (factor, above) = read.factors_of(&read.whole.above, graph, names, shown)?;
        let (other, below) = read.factors_of(&read.whole.below, graph, names, shown)?;
        let coefficient = (&factor * &other.recip()?).to_string();
        let above = product(coefficient, above.into_iter());
        texts.push(match below.is_empty() {
            true => above,
            false => format!("{above}/({})", product("1".to_string(), below.into_iter())),
        });
    }
    let text = texts.join(" + ").replace(" + -", " - ");
    (!text.is_empty() && text.len() < MOST_LETTERS).then_some(SimplerForm { text, divides })
}

impl ReadValue {
    /// Writes c Π f^m, with pairs of factors that have the same sign in brackets.
    pub(super) fn factored(
        &self,
        graph: &Graph,
        names: &[String],
        shown: ShownSign<'_>,
    ) -> Option<String> {
        let (factor, all) = self.factors_of(&self.whole.above, graph, names, shown)?;
        Some(product(factor.to_string(), all.into_iter()))
    }

    /// Writes Σ a Π f^m with the products a of parameters in the value; `None` if there are fewer than two.
    pub(super) fn by_parameters(
        &self,
        graph: &Graph,
        names: &[String],
        shown: ShownSign<'_>,
    ) -> Option<String> {
        let variables = self.whole.above.variables();
        let is_parameter = |variable: &u32| !self.is_own[*variable as usize];
        let parameters: Vec<u32> = variables.into_iter().filter(is_parameter).collect();
        let all = self.whole.above.collected(&parameters);
        if all.len() < 2 {
            return None;
        }
        let mut texts = Vec::new();
        for (powers, coefficient) in &all {
            let (factor, own) = self.factors_of(coefficient, graph, names, shown)?;
            let named = parameters.iter().zip(powers);
            let powers =
                named.map(|(own, power)| (self.names[*own as usize].clone(), false, *power));
            texts.push(product(factor.to_string(), powers.chain(own)));
        }
        Some(texts.join(" + "))
    }

    /// Divides a polynomial into a number and factors, with pairs that have the same sign together.
    fn factors_of(
        &self,
        polynomial: &Polynomial,
        graph: &Graph,
        names: &[String],
        shown: ShownSign<'_>,
    ) -> Option<(Rational, Vec<Factor>)> {
        let mut rest = polynomial.clone();
        let mut work = MOST_WORK;
        let mut factors = Vec::new();
        for factor in rest.factors() {
            let mut count = 0;
            while let Some(less) = rest.over(&factor, &mut work) {
                (rest, count) = (less, count + 1);
            }
            factors.push((factor, count));
        }
        let mut coefficient = rest.number()?;
        let mut written = Vec::new();
        for pair in pairs(self, graph, names, &factors) {
            let [(first, own), (second, other)] = pair.factors;
            factors[first].1 -= 1;
            factors[second].1 -= 1;
            coefficient = &(&coefficient * &own) * &other;
            written.push((pair.text, false, 1));
        }
        for (factor, count) in factors {
            let is_sum = factor.as_term().is_none_or(|(_, powers)| powers.len() > 1);
            let signs = if is_sum && count % 2 == 1 { &[1, -1][..] } else { &[] };
            let found = signs.iter().find_map(|sign| {
                let own = self.named(&factor.scaled(&Rational::from(*sign)));
                Some((Rational::from(*sign), shown(&own)?))
            });
            match found {
                Some((sign, text)) => {
                    coefficient = &coefficient * &sign;
                    written.push((text, true, count));
                }
                None => written.push((factor.text(&self.names), is_sum, count)),
            }
        }
        Some((coefficient, written))
    }

    /// Names the variables of a polynomial.
    fn named(&self, polynomial: &Polynomial) -> NamedPolynomial<'_> {
        let variables = polynomial.variables();
        let terms = polynomial.terms().map(|(value, powers)| {
            let power = |variable: &u32| {
                powers.iter().find(|(own, _)| own == variable).map_or(0, |(_, power)| *power)
            };
            (value.clone(), variables.iter().map(power).collect())
        });
        NamedPolynomial {
            terms: terms.collect(),
            names: variables.iter().map(|own| self.names[*own as usize].as_str()).collect(),
        }
    }
}
