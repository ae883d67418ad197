//! Relations that special values of a parameter satisfy: to a number, or to one other parameter.

use std::fmt;

use super::real::has_real_root;
use liouville::formula::exponent_text;
use liouville::number::prime::PrimePolynomials;

use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::proof::reconstruct;

/// A parameter drawn from a range: its name, and the index of its draw.
pub struct ScalarParameter {
    /// Canonical name.
    pub name: String,
    /// Index among the draws of the parameters.
    pub draw: usize,
}

/// Special values of one parameter for one choice of the others.
pub struct Round {
    /// The values.
    pub values: Vec<u64>,
    /// Draws of all parameters with which they were found.
    pub parameters: Vec<u64>,
    /// Prime.
    pub modulus: Modulus,
}

/// An equation for one parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Relation {
    /// x = c.
    Value(String, Rational),
    /// x y = c.
    Product(String, String, Rational),
    /// x/y = c.
    Quotient(String, String, Rational),
    /// x − y = c.
    Difference(String, String, Rational),
    /// x + y = c.
    Sum(String, String, Rational),
}

impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Relation::Value(x, c) => write!(f, "{x} = {c}"),
            Relation::Product(x, y, c) => write!(f, "{x}*{y} = {c}"),
            Relation::Quotient(x, y, c) => write!(f, "{x}/{y} = {c}"),
            Relation::Difference(x, y, c) => write!(f, "{x} − {y} = {c}"),
            Relation::Sum(x, y, c) => write!(f, "{x} + {y} = {c}"),
        }
    }
}

/// Relations of special values that hold in all rounds.
pub struct Explained {
    /// The relations, each once.
    pub relations: Vec<Relation>,
    /// Number of values that satisfy none of them, the largest of any round.
    pub unexplained: usize,
}

/// Finds numbers, or relations to one other parameter, that special values satisfy in all rounds.
pub fn explained(
    parameter: &ScalarParameter,
    all: &[ScalarParameter],
    rounds: &[Round],
) -> Explained {
    let by_round: Vec<Vec<Vec<Relation>>> = rounds
        .iter()
        .map(|round| {
            let own = |value: &u64| of_value(parameter, all, *value, round);
            round.values.iter().map(own).collect()
        })
        .collect();
    let holds = |relation: &Relation| {
        by_round.iter().all(|values| values.iter().any(|own| own.contains(relation)))
    };
    let mut relations: Vec<Relation> = Vec::new();
    for relation in by_round.iter().take(1).flatten().flatten() {
        if holds(relation) && !relations.contains(relation) {
            relations.push(relation.clone());
        }
    }
    let is_open = |own: &&Vec<Relation>| !own.iter().any(|relation| relations.contains(relation));
    let open = by_round.iter().map(|values| values.iter().filter(is_open).count());
    Explained { unexplained: open.max().unwrap_or(0), relations }
}

/// Makes the polynomial of the values that are not rational and of the roots of a further factor, by increasing
/// powers, if its coefficients are rational; `None` too if there are none.
pub fn of_irrational(round: &Round, further: &[u64]) -> Option<Vec<Rational>> {
    let Round { values, modulus: m, .. } = round;
    let ring = PrimePolynomials(*m);
    let is_other = |value: &&u64| reconstruct(**value, m).filter(is_short).is_none();
    let factors = values.iter().filter(is_other).map(|value| vec![m.sub(0, *value), m.one()]);
    let product = factors.fold(further.to_vec(), |all, own| ring.product(&all, &own));
    if product.len() < 2 {
        return None;
    }
    let lifted = |image: &u64| reconstruct(*image, m).filter(is_short);
    product.iter().map(lifted).collect()
}

/// Writes the equation of the values that are not rational, and of the roots of a further factor, if
/// its coefficients are; `None` too if there are none. The inner `None` is for values none of which is real.
pub fn equation(name: &str, round: &Round, further: &[u64]) -> Option<Option<String>> {
    of_irrational(round, further).map(|product| written(name, product))
}

/// Divides a polynomial, by increasing powers, by others as often as they divide it.
pub fn without_factors(mut polynomial: Vec<Rational>, factors: &[Vec<Rational>]) -> Vec<Rational> {
    for factor in factors {
        while let Some(quotient) = divided(&polynomial, factor) {
            polynomial = quotient;
        }
    }
    polynomial
}

/// The quotient of two polynomials, if there is no remainder.
fn divided(own: &[Rational], by: &[Rational]) -> Option<Vec<Rational>> {
    let (last, below) = by.split_last()?;
    let inverse = last.recip()?;
    let count = own.len().checked_sub(below.len()).filter(|_| !below.is_empty())?;
    let (mut rest, mut quotient) = (own.to_vec(), vec![Rational::from(0); count]);
    for place in (0..count).rev() {
        let factor = &rest[place + below.len()] * &inverse;
        for (k, entry) in below.iter().enumerate() {
            rest[place + k] = &rest[place + k] - &(&factor * entry);
        }
        quotient[place] = factor;
    }
    rest[..below.len()].iter().all(Rational::is_zero).then_some(quotient)
}

/// Writes the equation of a polynomial, by increasing powers, if it has a real root.
pub fn written(name: &str, product: Vec<Rational>) -> Option<String> {
    if product.len() < 2 || !has_real_root(&product) {
        return None;
    }
    let mut text = String::new();
    for (power, value) in product.into_iter().enumerate().rev().filter(|(_, own)| !own.is_zero()) {
        let (sign, size) = match (value.is_negative(), text.is_empty()) {
            (true, true) => ("−", value.abs()),
            (true, false) => (" − ", value.abs()),
            (false, true) => ("", value),
            (false, false) => (" + ", value),
        };
        let base = match power {
            0 => String::new(),
            1 => name.to_string(),
            n => format!("{name}{}", exponent_text(n as i64)),
        };
        text.push_str(sign);
        text.push_str(&match (size.is_one(), base.is_empty()) {
            (_, true) => size.to_string(),
            (true, false) => base,
            (false, false) => format!("{size}*{base}"),
        });
    }
    Some(format!("{text} = 0"))
}

/// Says how many values no relation describes.
pub fn unexplained(count: usize, parameter: &ScalarParameter) -> String {
    let values = if count == 1 { "value" } else { "values" };
    let name = &parameter.name;
    format!("{count} further {values} of {name}, in no simple relation to one other parameter")
}

/// Says that nothing is known where the solution of the level misses a part of it.
pub fn unfilled(condition: &str) -> String {
    format!(
        "whether there are more integrals where {condition} is not known: the level may fall apart there, and its \
         solution may miss a part"
    )
}

/// Lists the relations of one value.
fn of_value(
    parameter: &ScalarParameter,
    all: &[ScalarParameter],
    value: u64,
    Round { parameters, modulus: m, .. }: &Round,
) -> Vec<Relation> {
    let name = || parameter.name.clone();
    let number = reconstruct(value, m).filter(is_short);
    let mut found: Vec<Relation> =
        number.into_iter().map(|number| Relation::Value(name(), number)).collect();
    for other in all.iter().filter(|other| other.draw != parameter.draw && value != 0) {
        let y = parameters[other.draw];
        let mut add = |image: u64, make: fn(String, String, Rational) -> Relation| {
            let number = reconstruct(image, m).filter(is_simple);
            found.extend(number.map(|number| make(name(), other.name.clone(), number)));
        };
        add(m.mul(value, y), Relation::Product);
        if y != 0 {
            add(m.mul(value, m.inverse(y)), Relation::Quotient);
        }
        // x − y = 0 is x/y = 1.
        if value != y {
            add(m.sub(value, y), Relation::Difference);
        }
        if m.add(value, y) != 0 {
            add(m.add(value, y), Relation::Sum);
        }
    }
    found
}

/// Whether a number is short enough to be no accident modulo a prime of 61 bits.
pub fn is_short(value: &Rational) -> bool {
    value.small_parts().is_some_and(|(n, d)| n.abs() <= 4096 && d <= 4096)
}

/// Whether a number is small enough to be the constant of a relation rather than an accident.
fn is_simple(value: &Rational) -> bool {
    value.small_parts().is_some_and(|(n, d)| n.abs() <= 8 && d <= 8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::proof::ProofRng;

    #[test]
    fn factors_that_are_known_are_left_out() {
        let polynomial = |own: &[i64]| own.iter().map(|n| Rational::from(*n)).collect::<Vec<_>>();
        // (x² − 2)² (x² + 1), twice over.
        let own = polynomial(&[8, 0, 0, 0, -6, 0, 2]);
        let rest = without_factors(own, &[polynomial(&[-2, 0, 1]), polynomial(&[5, 1])]);
        assert_eq!(rest, polynomial(&[2, 0, 2]));
        assert_eq!(written("a", rest), None, "no root is real");
        assert_eq!(written("a", polynomial(&[-2, 0, 1])).as_deref(), Some("a² − 2 = 0"));
        assert_eq!(without_factors(polynomial(&[3]), &[polynomial(&[-2, 0, 1])]), polynomial(&[3]));
    }

    #[test]
    fn values_without_a_relation_are_counted() {
        let mut rng = ProofRng::new(4, 0);
        let m = rng.prime(&[], &[]);
        let scalar = |name: &str, draw| ScalarParameter { name: name.to_string(), draw };
        let all = [scalar("a", 0), scalar("b", 1)];
        let rounds: Vec<Round> = (0..2)
            .map(|_| {
                let b = rng.element(&m);
                // a = 3 b, a = 2/5, and a = b² + 1.
                let own = [m.mul(m.integer(3), b), m.add(m.mul(b, b), m.one())];
                let number = m.rational(&Rational::new(2, 5)).expect("5 is not 0");
                let values = [own.as_slice(), &[number]].concat();
                Round { values, parameters: vec![0, b], modulus: m }
            })
            .collect();
        let found = explained(&all[0], &all, &rounds);
        let texts: Vec<String> = found.relations.iter().map(ToString::to_string).collect();
        assert_eq!(texts, ["a/b = 3", "a = 0.4"]);
        assert_eq!(found.unexplained, 1, "b² + 1 is in no simple relation to b");
        let alone = explained(&all[0], &all[..1], &rounds);
        assert_eq!(alone.unexplained, 2, "nor is 3 b without b");
    }
}
