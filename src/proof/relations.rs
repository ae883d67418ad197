//! Linear relations with rational coefficients between values of a graph.

use crate::graph::{Evaluator, Expr, Graph, Tape, record};
use crate::number::prime::{Modulus, Prime, UNDEFINED};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::algebraic::{Algebraic, Root};
use super::bounds::Source;
use super::chance::Chance;
use super::digest::Digest;
use super::elimination::reduce;
use super::identity::{LANES, Outcome, Trial, points};
use super::standing::{Standing, standing};
use super::symbols::Symbols;

/// More values than this are not related to each other: the effort grows with the cube.
const MOST: usize = 40;
/// Rows beyond the number of columns.
const SPARE: usize = 4;
/// Numerators and denominators of coefficients are looked for up to here.
const LARGEST: i128 = 1 << 20;

/// What must vanish, from the values at some places; nothing if one of them is missing.
type Defects<'a> = dyn Fn(&[Option<Expr>]) -> Option<Vec<Expr>> + 'a;

/// constant + Σ multiples_i e_i over a basis e.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// The part that is a number.
    pub constant: Rational,
    /// The multiples of the basis elements.
    pub multiples: Vec<Rational>,
}

/// Finds relations in a graph; what is transcendental counts as independent.
pub struct Relations<'g> {
    graph: &'g Graph,
    sources: &'g [Source],
    algebraic: Algebraic,
    digest: Digest,
}

impl<'g> Relations<'g> {
    /// Prepares to relate values of `graph`.
    pub fn new(
        graph: &'g Graph,
        sources: &'g [Source],
        algebraic: Algebraic,
        digest: Digest,
    ) -> Self {
        Self { graph, sources, algebraic, digest }
    }

    /// Each place's value through a basis chosen among them, and the number 1 if `with_one`; `None`
    /// when no basis was found and proved.
    pub fn between(&mut self, places: &[usize], with_one: bool) -> Option<Vec<Combination>> {
        if places.is_empty() || places.len() > MOST {
            return None;
        }
        let mut chance = Chance::of(self.digest, 2);
        let modulus = chance.prime(&self.algebraic.odd_indices(), &self.algebraic.squares);
        let columns = places.len() + usize::from(with_one);
        let rows = self.rows(places, with_one, columns + SPARE, &modulus, &mut chance)?;
        let (pivots, rows) = reduce(rows, columns, &modulus);
        let offset = usize::from(with_one);
        let basis: Vec<usize> = pivots.iter().copied().filter(|c| *c >= offset).collect();
        let combinations: Option<Vec<Combination>> = (offset..columns)
            .map(|column| {
                let coefficient = |pivot: usize| match pivots.iter().position(|p| *p == pivot) {
                    _ if pivot == column => Some(Rational::from(1)),
                    Some(row) if !pivots.contains(&column) => {
                        reconstruct(rows[row][column], &modulus)
                    }
                    _ => Some(Rational::from(0)),
                };
                let constant = if with_one { coefficient(0)? } else { Rational::from(0) };
                let multiples: Option<Vec<Rational>> =
                    basis.iter().map(|pivot| coefficient(*pivot)).collect();
                Some(Combination { constant, multiples: multiples? })
            })
            .collect();
        let combinations = combinations?;
        let basis: Vec<usize> = basis.iter().map(|column| places[column - offset]).collect();
        self.verify(places, &basis, &combinations).then_some(combinations)
    }

    /// Are two values reciprocal (`true`), or equal (`false`)? `None` where neither is proved.
    pub fn is_reciprocal(&mut self, a: usize, b: usize) -> Option<bool> {
        let mut chance = Chance::of(self.digest, 6);
        let modulus = chance.prime(&self.algebraic.odd_indices(), &self.algebraic.squares);
        let rows = self.rows(&[a, b], false, 2, &modulus, &mut chance)?;
        let one = modulus.one();
        let equal = rows.iter().all(|row| row[0] == row[1]);
        let reciprocal = rows.iter().all(|row| modulus.mul(row[0], row[1]) == one);
        if !equal && !reciprocal {
            return None;
        }
        let defect = |values: &[Option<Expr>]| -> Option<Vec<Expr>> {
            let (a, b) = (values[a]?, values[b]?);
            Some(vec![if equal { a - b } else { a * b - Expr::rational(&Rational::from(1)) }])
        };
        self.vanish(&[a, b], &defect).then_some(!equal)
    }

    /// Values at random points modulo one prime, one row a point.
    fn rows(
        &self,
        places: &[usize],
        with_one: bool,
        count: usize,
        modulus: &Modulus,
        chance: &mut Chance,
    ) -> Option<Vec<Vec<u64>>> {
        let outputs: Option<Vec<Expr>> =
            places.iter().map(|place| self.algebraic.values[*place]).collect();
        let tape = Tape::new(&self.algebraic.graph, &outputs?);
        let moduli = [*modulus; LANES];
        let mut evaluator = Evaluator::new(&tape, Prime::new(moduli));
        let mut rows = Vec::new();
        for _ in 0..64 * count {
            evaluator.run(&points(&moduli, &self.algebraic.sources, &[], chance));
            for lane in 0..LANES {
                let row: Vec<u64> = evaluator.outputs().map(|block| block[lane]).collect();
                if row.iter().all(|value| *value != UNDEFINED) {
                    let one = with_one.then(|| modulus.one());
                    rows.push(one.into_iter().chain(row).collect());
                }
            }
            if rows.len() >= count {
                return Some(rows);
            }
        }
        None
    }

    /// Proves that the places' values are the combinations.
    fn verify(&self, places: &[usize], basis: &[usize], combinations: &[Combination]) -> bool {
        self.vanish(places, &|values| {
            places
                .iter()
                .zip(combinations)
                .map(|(place, combination)| {
                    let mut rest = values[*place]? - Expr::rational(&combination.constant);
                    for (element, multiple) in basis.iter().zip(&combination.multiples) {
                        rest -= values[*element]? * Expr::rational(multiple);
                    }
                    Some(rest)
                })
                .collect()
        })
    }

    /// Proves that some functions of the values at these places vanish.
    fn vanish(&self, places: &[usize], defects: &Defects<'_>) -> bool {
        let reached = self.graph.reached_from(places);
        let recorded = record(self.sources.len(), |inputs| {
            defects(&self.graph.replay(&reached, inputs, |_, _, _| None))
        });
        let Ok((graph, Some(defects))) = recorded else { return false };
        let reached = graph.reached(defects.iter().copied());
        let symbols = Symbols::opaque(&graph, &reached);
        let Ok(lowered) = Algebraic::of(&graph, &reached, self.sources, &symbols) else {
            return false;
        };
        let lowered_defects: Option<Vec<Expr>> =
            defects.iter().map(|defect| lowered.values[graph.place(*defect)]).collect();
        let Some(lowered_defects) = lowered_defects else { return false };
        let trial = Trial::new(&lowered, self.digest);
        let roots: Vec<Root> = lowered.roots_of(&lowered_defects).collect();
        let standing = standing(&trial, &lowered, &roots, self.digest);
        standing.iter().all(|standing| *standing == Standing::Independent)
            && matches!(trial.test(&lowered_defects, &roots, &[]), Outcome::Zero(_))
    }
}

/// The fraction of small parts with this image, if there is one; it is then the only one.
pub fn reconstruct(image: u64, modulus: &Modulus) -> Option<Rational> {
    // Half of Euclid's algorithm: r_i = t_i x mod p at every step.
    let (mut previous, mut current) =
        ((i128::from(modulus.prime()), 0i128), (i128::from(modulus.to_integer(image)), 1i128));
    while current.0 > LARGEST {
        let quotient = previous.0 / current.0;
        let next = (previous.0 - quotient * current.0, previous.1 - quotient * current.1);
        (previous, current) = (current, next);
    }
    let (above, below) = current;
    (below != 0 && below.abs() <= LARGEST).then(|| Rational::new(above as i64, below as i64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_are_found_from_their_images() {
        let modulus = Chance::new(3, 0).prime(&[], &[]);
        for (n, d) in [(0, 1), (1, 1), (-1, 2), (22, 7), (-104_729, 1_048_573)] {
            let value = Rational::new(n, d);
            let image = modulus.rational(&value).expect("p does not divide d");
            assert_eq!(reconstruct(image, &modulus), Some(value), "{n}/{d}");
        }
    }
}
