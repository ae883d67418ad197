//! Rates of functions Σ c (x − x* ln x) of Volterra as −Σ w (u − 1 − ln u), where u is 1 at the rest x*.
//!
//! If Σ a m is a rate with monomials m, and the rate and its slopes are 0 at x*, then Σ a m* ln(m/m*) = 0, since it is
//! linear in ln x. So the rate is Σ a m* (u − 1 − ln u) with u = m/m*.

use crate::graph::{Expr, Graph};
use crate::number::rational::Rational;

use super::collected::{ReadValue, SimplerForm, reduced};
use super::polynomial::{Fraction, Polynomial};

/// Largest number of monomials.
const MOST_MONOMIALS: usize = 12;

/// Writes a rate in this form from the slopes of the function along the inputs from `first` on; `names` are those of the
/// inputs.
pub fn volterra_sum(
    graph: &Graph,
    value: Expr,
    slopes: &[Expr],
    first: usize,
    names: &[String],
) -> Option<SimplerForm> {
    let read = ReadValue::of_inputs(graph, value, first, names)?;
    let (above, below) = (&read.whole.above, &read.whole.below);
    let own: Vec<u32> = (first..names.len()).filter_map(|k| u32::try_from(k).ok()).collect();
    let rests: Vec<Option<Fraction>> = (slopes.iter().zip(&own))
        .map(|(slope, variable)| {
            let slope = ReadValue::of_inputs(graph, *slope, first, names)?;
            rest(&slope.whole.above, *variable, &own)
        })
        .collect();
    let divisors = below.collected(&own);
    let (common, divisor) = divisors.iter().next().filter(|_| divisors.len() == 1)?;
    let terms = above.collected(&own);
    if terms.len() > MOST_MONOMIALS {
        return None;
    }
    let mut texts = Vec::new();
    for (powers, coefficient) in &terms {
        let exponents: Vec<i64> =
            powers.iter().zip(common).map(|(a, b)| i64::from(*a) - i64::from(*b)).collect();
        if exponents.iter().all(|own| *own == 0) {
            continue;
        }
        let mut factor = vec![Fraction { above: coefficient.clone(), below: divisor.clone() }];
        let mut share = Vec::new();
        for ((exponent, variable), rest) in exponents.iter().zip(&own).zip(&rests) {
            if *exponent == 0 {
                continue;
            }
            let variable = Fraction::whole(Polynomial::variable(*variable));
            for _ in 0..exponent.abs() {
                let rest = rest.as_ref()?;
                factor.push(if *exponent > 0 { rest.clone() } else { turned(rest) });
                let own = [variable.clone(), turned(rest)];
                share.extend(if *exponent > 0 { own } else { own.map(|own| turned(&own)) });
            }
        }
        let factor = reduced(Fraction::product(factor.iter())?)?;
        let share = reduced(Fraction::product(share.iter())?)?;
        let (factor, share) = (text(&factor, names), text(&share, names));
        texts.push(format!("{factor}*({share} - 1 - ln({share}))"));
    }
    let text = texts.join(" + ");
    (!texts.is_empty()).then_some(SimplerForm { text, divides: true })
}

/// The value of a variable at which a polynomial is 0 that is linear in it and contains no other of those.
fn rest(polynomial: &Polynomial, variable: u32, own: &[u32]) -> Option<Fraction> {
    let mut parts = [Polynomial::default(), Polynomial::default()];
    for (powers, coefficient) in polynomial.collected(own) {
        let is_other = |(power, other): (&u32, &u32)| *power > 0 && *other != variable;
        if powers.iter().zip(own).any(is_other) {
            return None;
        }
        let power = usize::try_from(powers.iter().sum::<u32>()).ok()?;
        *parts.get_mut(power)? = coefficient;
    }
    let [constant, slope] = parts;
    let is_zero = slope.is_zero() || constant.is_zero();
    (!is_zero).then(|| Fraction { above: constant.scaled(&Rational::from(-1)), below: slope })
}

fn turned(own: &Fraction) -> Fraction {
    Fraction { above: own.below.clone(), below: own.above.clone() }
}

fn text(own: &Fraction, names: &[String]) -> String {
    let above = format!("({})", own.above.text(names));
    match own.below.number().is_some_and(|number| number.is_one()) {
        true => above,
        false => format!("{above}/({})", own.below.text(names)),
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::record;

    #[test]
    fn a_rest_gives_the_form() {
        // F = x − a ln x with x' = a² − x²: the rate is (1 − a/x)(a² − x²).
        let names = ["a", "x"].map(String::from);
        let (graph, (value, slope)) = record(2, |v| {
            let slope = (v[0] / v[1]).recip().recip() * -1.0 + 1.0;
            (slope * (v[0] * v[0] - v[1] * v[1]), slope)
        })
        .expect("records");
        let found = volterra_sum(&graph, value, &[slope], 1, &names).expect("a rest at a");
        assert_eq!(found.text.matches("ln(").count(), 3, "x, 1/x and x²: {}", found.text);
        let (graph, value) = record(2, |v| v[1] - v[0] * v[1] * v[1]).expect("records");
        assert!(volterra_sum(&graph, value, &[value], 1, &names).is_none(), "no linear slope");
    }
}
