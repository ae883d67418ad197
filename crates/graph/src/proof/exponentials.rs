//! Exponentials whose exponents are related over the whole numbers, as products of few independent ones: e^(2x) is
//! the square of e^x.

use num_integer::Integer;

use crate::graph::{Expr, Graph, Step};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;
use crate::order::StableOrder;

use super::polynomial::{Fraction, Polynomial, fraction};

/// Largest number of exponentials.
const MOST: usize = 8;

/// A variable of a polynomial that is read from a graph.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Variable {
    /// The value at a place.
    Place(usize),
    /// A product of whole powers of exponentials at places: never 0.
    Exponential(Vec<(usize, i64)>),
}

impl Variable {
    /// Returns the places of u_i, with whole numbers n_i, of which the variable is e^(Σ n_i u_i).
    pub(super) fn exponent(&self, graph: &Graph) -> Option<Vec<(usize, i64)>> {
        let argument = |place: usize| match graph.step(place) {
            Step::Unary(UnaryFunction::Exp, a) => Some(a),
            _ => None,
        };
        match self {
            Self::Place(place) => Some(vec![(argument(*place)?, 1)]),
            Self::Exponential(powers) => {
                powers.iter().map(|(place, power)| Some((argument(*place)?, *power))).collect()
            }
        }
    }

    /// Records the value from the values at places.
    pub(super) fn value(&self, at: &impl Fn(usize) -> Option<Expr>) -> Option<Expr> {
        match self {
            Self::Place(place) => at(*place),
            Self::Exponential(powers) => {
                let mut all = powers.iter().map(|(place, power)| {
                    use crate::scalar::Scalar;
                    Some(at(*place)?.power(&Rational::from(*power)))
                });
                let first = all.next()??;
                all.try_fold(first, |product, own| Some(product * own?))
            }
        }
    }
}

/// Exponentials as products of powers of independent ones.
pub(super) struct Exponentials {
    /// Places of the exponentials.
    places: Vec<usize>,
    /// The independent ones, each with its powers of those at the places.
    basis: Vec<Vec<i64>>,
    /// For each place, the powers of the independent ones.
    powers: Vec<Vec<i64>>,
}

impl Exponentials {
    /// Finds the relations between exponentials at some places, whose exponents are polynomials in the values at
    /// `variables`; `None` if there are none.
    pub(super) fn of(graph: &Graph, variables: &[usize]) -> Option<Self> {
        let mut places = Vec::new();
        let mut exponents: Vec<Polynomial> = Vec::new();
        for place in variables {
            let Step::Unary(UnaryFunction::Exp, argument) = graph.step(*place) else { continue };
            let own = |at: usize, _: Step<'_>| {
                let index = variables.binary_search(&at).ok()?;
                Some(Polynomial::variable(u32::try_from(index).ok()?))
            };
            let read = fraction(graph, argument, &own).and_then(|own| own.polynomial());
            if let Some(read) = read {
                places.push(*place);
                exponents.push(read);
            }
        }
        if !(2..=MOST).contains(&places.len()) {
            return None;
        }
        // Exponents of few terms come first, and are kept.
        let mut order: Vec<usize> = (0..places.len()).collect();
        order.order_by_key(|index| (exponents[*index].size(), *index));
        let places: Vec<usize> = order.iter().map(|index| places[*index]).collect();
        let exponents: Vec<Polynomial> =
            order.iter().map(|index| exponents[*index].clone()).collect();
        let mut rows = whole_rows(&exponents)?;
        let count = rows.len();
        let unit = |k: usize| (0..count).map(|j| i64::from(j == k)).collect::<Vec<i64>>();
        // The rows are `made` times the exponents, and these are `back` times the rows.
        let mut made: Vec<Vec<i64>> = (0..count).map(unit).collect();
        let mut back = made.clone();
        let mut rank = 0;
        for column in 0..rows.first().map_or(0, Vec::len) {
            loop {
                let open = (rank..count).filter(|row| rows[*row][column] != 0);
                let Some(least) = open.min_by_key(|row| rows[*row][column].unsigned_abs()) else {
                    break;
                };
                rows.swap(rank, least);
                made.swap(rank, least);
                back.iter_mut().for_each(|row| row.swap(rank, least));
                let mut is_done = true;
                for row in rank + 1..count {
                    let times = rows[row][column].div_euclid(rows[rank][column]);
                    add(&mut rows, row, rank, -times)?;
                    add(&mut made, row, rank, -times)?;
                    for own in &mut back {
                        own[rank] = own[rank].checked_add(own[row].checked_mul(times)?)?;
                    }
                    is_done &= rows[row][column] == 0;
                }
                if is_done {
                    rank += 1;
                    break;
                }
            }
        }
        if rank == count {
            return None;
        }
        made.truncate(rank);
        back.iter_mut().for_each(|row| row.truncate(rank));
        Some(Self { places, basis: made, powers: back })
    }

    /// Returns the independent ones.
    pub(super) fn variables(&self) -> Vec<Variable> {
        let of = |row: &Vec<i64>| {
            let powers = self.places.iter().copied().zip(row.iter().copied());
            Variable::Exponential(powers.filter(|(_, power)| *power != 0).collect())
        };
        self.basis.iter().map(of).collect()
    }

    /// Returns the exponential at a place as a fraction in variables for the independent ones, numbered from
    /// `first` on.
    pub(super) fn at(&self, place: usize, first: usize) -> Option<Fraction> {
        let powers = &self.powers[self.places.iter().position(|own| *own == place)?];
        let term = |sign: i64| {
            let all = (first..).zip(powers).filter(|(_, power)| **power * sign > 0);
            let all = all.map(|(variable, power)| {
                let power = u32::try_from(power.unsigned_abs()).ok()?;
                Some((u32::try_from(variable).ok()?, power))
            });
            let all = all.collect::<Option<Vec<(u32, u32)>>>()?;
            Some(Polynomial::of_term(&Rational::from(1), all))
        };
        Some(Fraction { above: term(1)?, below: term(-1)? })
    }
}

/// Adds a multiple of a row to another one; `None` beyond the range of the numbers.
fn add(rows: &mut [Vec<i64>], to: usize, from: usize, times: i64) -> Option<()> {
    let own = rows[from].clone();
    for (value, other) in rows[to].iter_mut().zip(own) {
        *value = value.checked_add(other.checked_mul(times)?)?;
    }
    Some(())
}

/// Returns the coefficients of polynomials, all times one number that makes them whole.
fn whole_rows(of: &[Polynomial]) -> Option<Vec<Vec<i64>>> {
    let mut monomials: Vec<Vec<(u32, u32)>> =
        of.iter().flat_map(|own| own.terms().map(|(_, powers)| powers.to_vec())).collect();
    monomials.sort_unstable();
    monomials.dedup();
    let mut common = 1i64;
    for (value, _) in of.iter().flat_map(|own| own.terms()) {
        let below = i64::try_from(value.parts().1).ok()?;
        common = common.checked_mul(below / common.gcd(&below))?;
    }
    let row = |own: &Polynomial| {
        let mut row = vec![0; monomials.len()];
        for (value, powers) in own.terms() {
            let whole = value * &Rational::from(common);
            let place = monomials.binary_search_by(|own| own.as_slice().cmp(powers)).ok()?;
            row[place] = i64::try_from(whole.parts().0).ok()?;
        }
        Some(row)
    };
    of.iter().map(row).collect()
}
