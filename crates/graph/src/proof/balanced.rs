//! Rates of free energies, −Σ w (f − b)(ln f − ln b) with products f, b and numbers w > 0, as those of chemical reactions
//! in detailed balance.
//!
//! The value is read as Σ M L with monomials M and sums L of logarithms. Two monomials with L_f = −r L_b are one
//! pair; the others are divided into pairs by non-negative least squares (C. L. Lawson, R. J. Hanson, Solving least
//! squares problems, 1974, chapter 23).

use std::collections::BTreeMap;

use crate::graph::{Graph, Step};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;

use super::collected::ReadValue;

/// Largest number of monomials that are divided into pairs by least squares.
const MOST_MONOMIALS: usize = 16;
/// Largest number that is divided into primes.
const MOST_NUMBER: i64 = 1_000_000;
/// Largest denominator of a factor w.
const MOST_BELOW: i64 = 120;

/// A value whose logarithm occurs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Atom {
    Prime(i64),
    Variable(u32),
}

/// A sum of multiples of logarithms.
type Logarithms = BTreeMap<Atom, Rational>;
/// Powers of variables, also below 0.
type Powers = BTreeMap<u32, i64>;

/// A monomial with the sum of logarithms that it multiplies.
#[derive(Clone)]
struct Term {
    powers: Powers,
    own: Logarithms,
}

/// A term −w (r f − b)(ln(r f) − ln b).
struct Pair {
    weight: Rational,
    ratio: Rational,
    above: Powers,
    below: Powers,
}

/// Writes a value as −Σ w (f − b)(ln f − ln b); `None` if it is no sum of monomials times logarithms, or if no such
/// sum is found.
pub(super) fn balanced_sum(read: &ReadValue, graph: &Graph) -> Option<String> {
    let mut open = terms(read, graph)?;
    let (mut found, mut alone) = (Vec::new(), Vec::new());
    while let Some(term) = open.pop() {
        match open.iter().enumerate().find_map(|(at, other)| Some((at, pair(&term, other)?))) {
            Some((at, pair)) => {
                open.remove(at);
                found.push(pair);
            }
            None => alone.push(term),
        }
    }
    // A term that has no partner may be part of several pairs.
    if !alone.is_empty() {
        found.extend(divided(&alone)?);
    }
    let number = found.len();
    let texts: Vec<String> = found.iter().filter_map(|pair| pair.text(&read.names)).collect();
    let whole = texts.join(" ");
    (number > 0 && texts.len() == number).then(|| whole.replacen("- ", "-", 1))
}

/// Reads a value as a sum of monomials times logarithms.
fn terms(read: &ReadValue, graph: &Graph) -> Option<Vec<Term>> {
    let (divisor, common) = read.whole.below.as_term()?;
    let inverse = divisor.recip()?;
    let argument = |variable: u32| match graph.step(*read.places.get(variable as usize)?) {
        Step::Unary(UnaryFunction::Ln, a) => Some(a),
        _ => None,
    };
    let variables = read.whole.above.variables();
    let logarithms: Vec<u32> =
        variables.into_iter().filter(|variable| argument(*variable).is_some()).collect();
    let mut all: BTreeMap<Powers, Logarithms> = BTreeMap::new();
    for (powers, coefficient) in read.whole.above.collected(&logarithms) {
        let at = powers.iter().position(|power| *power == 1)?;
        if powers.iter().sum::<u32>() != 1 {
            return None;
        }
        let atoms = atoms(read, graph, argument(logarithms[at])?)?;
        for (value, monomial) in coefficient.terms() {
            let mut powers: Powers =
                monomial.iter().map(|(own, power)| (*own, i64::from(*power))).collect();
            for (own, power) in common {
                *powers.entry(*own).or_default() -= i64::from(*power);
            }
            powers.retain(|_, power| *power != 0);
            add(all.entry(powers).or_default(), &atoms, &(value * &inverse));
        }
    }
    let terms = all.into_iter().map(|(powers, own)| Term { powers, own });
    Some(terms.filter(|term| !term.own.is_empty()).collect())
}

/// The logarithm of a variable or a number.
fn atoms(read: &ReadValue, graph: &Graph, argument: usize) -> Option<Logarithms> {
    if let Step::Constant(value) = graph.step(argument) {
        return of_number(value);
    }
    let variable = read.places.iter().position(|place| *place == argument)?;
    Some(BTreeMap::from([(Atom::Variable(u32::try_from(variable).ok()?), Rational::from(1))]))
}

/// The logarithm of a positive number by those of primes.
fn of_number(value: &Rational) -> Option<Logarithms> {
    let (above, below) = value.small_parts()?;
    let mut all = Logarithms::new();
    for (number, sign) in [(above, 1), (below, -1)] {
        if !(1..MOST_NUMBER).contains(&number) {
            return None;
        }
        let (mut rest, mut prime) = (number, 2);
        while rest > 1 {
            if prime * prime > rest {
                prime = rest;
            }
            while rest % prime == 0 {
                rest /= prime;
                let one = Logarithms::from([(Atom::Prime(prime), Rational::from(1))]);
                add(&mut all, &one, &Rational::from(sign));
            }
            prime += 1;
        }
    }
    Some(all)
}

/// Adds a multiple.
fn add(to: &mut Logarithms, other: &Logarithms, factor: &Rational) {
    for (atom, value) in other {
        let sum = to.entry(*atom).or_insert_with(|| Rational::from(0));
        *sum = &*sum + &(value * factor);
    }
    to.retain(|_, value| !value.is_zero());
}

/// ln f − ln b.
fn difference(above: &Powers, below: &Powers) -> Logarithms {
    let mut all = Logarithms::new();
    for (powers, sign) in [(above, 1), (below, -1)] {
        for (variable, power) in powers {
            let own = Logarithms::from([(Atom::Variable(*variable), Rational::from(*power))]);
            add(&mut all, &own, &Rational::from(sign));
        }
    }
    all
}

/// The factor c with a = c b.
fn share(a: &Logarithms, b: &Logarithms) -> Option<Rational> {
    let (atom, value) = b.iter().next()?;
    let factor = a.get(atom)? * &value.recip()?;
    let mut scaled = Logarithms::new();
    add(&mut scaled, b, &factor);
    (scaled == *a).then_some(factor)
}

/// Whether two terms are a pair by themselves: f L_f + b L_b = −w (r f − b)(ln(r f) − ln b).
fn pair(first: &Term, second: &Term) -> Option<Pair> {
    let ratio = -&share(&first.own, &second.own)?;
    if ratio.is_negative() {
        return None;
    }
    let mut logarithm = difference(&first.powers, &second.powers);
    add(&mut logarithm, &of_number(&ratio)?, &Rational::from(1));
    let weight = share(&second.own, &logarithm)?;
    let (above, below) = (first.powers.clone(), second.powers.clone());
    (!weight.is_negative()).then_some(Pair { weight, ratio, above, below })
}

/// Divides terms into pairs with r = 1.
fn divided(terms: &[Term]) -> Option<Vec<Pair>> {
    if terms.len() > MOST_MONOMIALS {
        return None;
    }
    let couples: Vec<(usize, usize)> =
        (0..terms.len()).flat_map(|i| (0..i).map(move |j| (j, i))).collect();
    let mut rows: BTreeMap<(usize, Atom), usize> = BTreeMap::new();
    let mut entries = Vec::new();
    let mut row = |at: (usize, Atom)| {
        let next = rows.len();
        *rows.entry(at).or_insert(next)
    };
    for (column, (i, j)) in couples.iter().enumerate() {
        for (atom, value) in difference(&terms[*i].powers, &terms[*j].powers) {
            let value = value.to_f64().0;
            entries.extend([(row((*i, atom)), column, value), (row((*j, atom)), column, -value)]);
        }
    }
    let mut sums = Vec::new();
    for (i, term) in terms.iter().enumerate() {
        sums.extend(term.own.iter().map(|(atom, value)| (row((i, *atom)), -value.to_f64().0)));
    }
    let mut columns = vec![vec![0.0; rows.len()]; couples.len()];
    entries.into_iter().for_each(|(row, column, value)| columns[column][row] += value);
    let mut target = vec![0.0; rows.len()];
    sums.into_iter().for_each(|(row, value)| target[row] = value);
    let weights = non_negative(&columns, &target)?;
    let mut pairs = Vec::new();
    let mut rest: Vec<Logarithms> = terms.iter().map(|term| term.own.clone()).collect();
    for ((i, j), weight) in couples.into_iter().zip(weights.iter()) {
        let weight = short(*weight)?;
        if weight.is_zero() {
            continue;
        }
        let (above, below) = (terms[i].powers.clone(), terms[j].powers.clone());
        let logarithm = difference(&above, &below);
        add(&mut rest[i], &logarithm, &weight);
        add(&mut rest[j], &logarithm, &-&weight);
        pairs.push(Pair { weight, ratio: Rational::from(1), above, below });
    }
    rest.iter().all(BTreeMap::is_empty).then_some(pairs)
}

/// A fraction next to a number.
fn short(value: f64) -> Option<Rational> {
    (1..=MOST_BELOW).find_map(|below| {
        let above = (value * below as f64).round();
        let is_near = (above / below as f64 - value).abs() < 1e-7 * value.abs().max(1.0);
        (is_near && above.abs() < 1e9).then(|| Rational::new(above as i64, below))
    })
}

/// Finds x ≥ 0 for which the sum of x times columns is nearest to a target.
fn non_negative(columns: &[Vec<f64>], target: &[f64]) -> Option<Vec<f64>> {
    let count = columns.len();
    let mut point = vec![0.0; count];
    let mut is_free = vec![false; count];
    for _ in 0..3 * count {
        let mut rest = target.to_vec();
        for (column, share) in columns.iter().zip(&point) {
            rest.iter_mut().zip(column).for_each(|(x, own)| *x -= share * own);
        }
        let slopes: Vec<f64> = columns.iter().map(|column| inner(column, &rest)).collect();
        let next = (0..count)
            .filter(|k| !is_free[*k] && slopes[*k] > 1e-9)
            .max_by(|a, b| slopes[*a].total_cmp(&slopes[*b]));
        let Some(next) = next else { break };
        is_free[next] = true;
        loop {
            let free: Vec<usize> = (0..count).filter(|k| is_free[*k]).collect();
            let best = nearest(columns, &free, target)?;
            let steps = free.iter().zip(&best).filter(|(_, value)| **value <= 0.0);
            let step = steps.map(|(k, value)| match point[*k] > 0.0 {
                true => point[*k] / (point[*k] - value),
                false => 0.0,
            });
            let step = step.min_by(f64::total_cmp);
            let share = step.unwrap_or(1.0);
            for (k, value) in free.iter().zip(&best) {
                point[*k] += share * (value - point[*k]);
            }
            if step.is_none() {
                break;
            }
            for k in free {
                is_free[k] = point[k] > 1e-12;
                point[k] = if is_free[k] { point[k] } else { 0.0 };
            }
        }
    }
    Some(point)
}

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Solves the normal equations for some columns.
fn nearest(columns: &[Vec<f64>], free: &[usize], target: &[f64]) -> Option<Vec<f64>> {
    let size = free.len();
    let row = |i: &usize| -> Vec<f64> {
        let own = free.iter().map(|j| inner(&columns[*i], &columns[*j]));
        own.chain([inner(&columns[*i], target)]).collect()
    };
    let mut rows: Vec<Vec<f64>> = free.iter().map(row).collect();
    for column in 0..size {
        let largest =
            |a: &usize, b: &usize| rows[*a][column].abs().total_cmp(&rows[*b][column].abs());
        let best = (column..size).max_by(largest)?;
        rows.swap(column, best);
        let pivot = rows[column].clone();
        if pivot[column].abs() < 1e-9 {
            return None;
        }
        for (_, row) in rows.iter_mut().enumerate().filter(|(at, _)| *at != column) {
            let factor = row[column] / pivot[column];
            row.iter_mut().zip(&pivot).for_each(|(x, y)| *x -= factor * y);
        }
    }
    Some((0..size).map(|k| rows[k][size] / rows[k][k]).collect())
}

impl Pair {
    fn text(&self, names: &[String]) -> Option<String> {
        let written = |factor: Option<&Rational>, powers: &Powers| {
            let power = |(variable, power): (&u32, &i64)| {
                let name = names.get(*variable as usize)?;
                Some(match power.abs() {
                    1 => name.clone(),
                    size => format!("{name}^{size}"),
                })
            };
            let side = |is_above: bool| {
                let own = powers.iter().filter(move |(_, power)| (**power > 0) == is_above);
                own.map(power).collect::<Option<Vec<String>>>()
            };
            let (mut above, below) = (side(true)?, side(false)?);
            let factor = factor.filter(|own| !own.is_one());
            above.splice(0..0, factor.map(|own| format!("({own})")));
            let above = if above.is_empty() { "1".to_string() } else { above.join("*") };
            Some(match below.len() {
                0 => above,
                1 => format!("{above}/{}", below[0]),
                _ => format!("{above}/({})", below.join("*")),
            })
        };
        let (f, b) = (written(Some(&self.ratio), &self.above)?, written(None, &self.below)?);
        let weight = match self.weight.is_one() {
            true => String::new(),
            false => format!("({})*", self.weight),
        };
        Some(format!("- {weight}({f} - {b})*(ln({f}) - ln({b}))"))
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::{Expr, record};
    use crate::proof::normal::normalised;
    use crate::scalar::Scalar;

    /// Writes a value of k, x, y, z, of which the first is a parameter.
    fn balanced(build: impl FnOnce(&[Expr]) -> Expr) -> Option<String> {
        let names = ["k", "x", "y", "z"].map(String::from);
        let (graph, value) = record(4, build).expect("records");
        let (graph, value) = match normalised(&graph, &[value]) {
            Some((graph, mut values)) => (graph, values.pop()?),
            None => (graph, value),
        };
        balanced_sum(&ReadValue::of(&graph, value, 1, &names)?, &graph)
    }

    #[test]
    fn pairs_of_reactions_are_found() {
        let number = |value: i64| Expr::rational(&Rational::from(value));
        let own = balanced(|v| (v[2] - v[1] * v[1]) * ((v[1] * v[1]).ln() - v[2].ln()));
        assert_eq!(own.as_deref(), Some("-(y - x^2)*(ln(y) - ln(x^2))"));
        let own = balanced(|v| (v[2] - v[1] * number(3)) * ((v[1] * number(3)).ln() - v[2].ln()));
        assert!(
            own.as_ref().is_some_and(|text| text.contains("3)*")),
            "a ratio of numbers: {own:?}"
        );
        let cycle = balanced(|v| {
            let of = |a: Expr, b: Expr| (a - b) * (b.ln() - a.ln());
            of(v[1], v[2]) + of(v[2], v[3]) + of(v[3], v[1])
        });
        assert_eq!(cycle.map(|text| text.matches("ln").count()), Some(6), "three pairs");
        assert!(
            balanced(|v| (v[2] - v[1]) * (v[2].ln() - v[1].ln())).is_none(),
            "of the other sign"
        );
        let wrong = balanced(|v| (v[2] - v[1] * v[1]) * (v[1].ln() - v[2].ln()));
        assert!(wrong.is_none(), "x² against ln x");
    }
}
