//! Arctangents that are sums of others: if Π (1 + i n_j u_j), n_j = ±1, has the argument eπ/4 up to half turns, Σ n_j atan u_j
//! is eπ/4 + mπ, with the whole number m that the ranges leave.
//!
//! docs/soundness.md, "Sums of arctangents".

use crate::graph::{Expr, Step};
use crate::number::UnaryFunction::Atan;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::cells::Cell;
use super::explore::Explorer;
use super::fact::SignFact;
use super::relations::Defect;
use super::rewrite::Rewrite;
use super::trial::{Certificate, both};

/// Largest number of arctangents that are compared with each other.
const MOST_COMPARED: usize = 4;
/// Largest number m of half turns: three arctangents are less than 3π/2, and e at most 2.
const MOST_TURNS: i64 = 2;

/// A sum Σ ± atan u_j + eπ/4.
#[derive(Clone, Debug)]
pub struct ArctangentSum {
    /// Places of the atan u_j, with their signs.
    terms: Vec<(usize, i64)>,
    /// Number e of eighths of a turn.
    eighths: i64,
}

fn number(value: i64) -> Expr {
    Expr::rational(&Rational::from(value))
}

/// Returns some eighths of a turn.
fn turned(eighths: i64) -> Expr {
    number(1).apply(Atan) * number(eighths)
}

impl ArctangentSum {
    /// Records the sum, from the values at places.
    pub fn value(&self, values: &[Option<Expr>]) -> Option<Expr> {
        let mut sum = turned(self.eighths);
        for (place, sign) in &self.terms {
            sum += values[*place]? * number(*sign);
        }
        Some(sum)
    }
}

/// The product Π (1 ± i u_j), by real and imaginary part.
fn product(factors: impl IntoIterator<Item = (Expr, i64)>) -> [Expr; 2] {
    factors.into_iter().fold([number(1), number(0)], |[a, b], (u, sign)| {
        let u = u * number(sign);
        [a - b * u, b + a * u]
    })
}

/// A combination of the parts of a complex number that is 0 if its argument is eπ/4 up to half turns.
fn defect([a, b]: [Expr; 2], eighths: i64) -> Expr {
    match eighths {
        0 => b,
        1 => b - a,
        2 => a,
        _ => b + a,
    }
}

impl Explorer<'_> {
    /// Finds the arctangents of a cell that are sums of one or two others before them.
    pub fn arctangent_sums(
        &self,
        cell: &Cell,
        known: &[(usize, SignFact)],
    ) -> (Vec<Rewrite>, Option<Certificate>) {
        let graph = &cell.graph;
        let reached = graph.reached(cell.values.iter().copied());
        let is_one = |a: usize| matches!(graph.step(a), Step::Constant(own) if own.is_one());
        let all = graph.steps().enumerate().filter(|(place, _)| reached[*place]);
        // Pairs of places, of atan u and of u.
        let all = all.filter_map(|(place, step)| match step {
            Step::Unary(Atan, a) if !is_one(a) => Some([place, a]),
            _ => None,
        });
        let (mut kept, mut rewrites, mut certificate) = (Vec::new(), Vec::new(), None);
        for own in all.take(MOST_COMPARED) {
            match self.sum_of(cell, known, own, &kept) {
                Some((sum, proof)) => {
                    rewrites.push(Rewrite::ArctangentSum { place: own[0], sum });
                    certificate = both(certificate, Some(proof));
                }
                None => kept.push(own),
            }
        }
        (rewrites, certificate)
    }

    /// Writes an arctangent as a sum of one or two others.
    fn sum_of(
        &self,
        cell: &Cell,
        known: &[(usize, SignFact)],
        own: [usize; 2],
        others: &[[usize; 2]],
    ) -> Option<(ArctangentSum, Certificate)> {
        let single = others.iter().map(|other| vec![*other]);
        let pairs = others.iter().enumerate().flat_map(|(index, other)| {
            others[index..].iter().map(move |second| vec![*other, *second])
        });
        single.chain(pairs).find_map(|others| {
            let signs: &[[i64; 2]] = match others.as_slice() {
                [first, second] if first != second => &[[1, 1], [1, -1], [-1, 1], [-1, -1]],
                _ => &[[1, 1], [-1, -1]],
            };
            let tried = signs.iter().flat_map(|signs| (0..4).map(move |eighths| (signs, eighths)));
            tried.into_iter().find_map(|(signs, eighths)| {
                let terms: Vec<([usize; 2], i64)> =
                    others.iter().copied().zip(signs.iter().copied()).collect();
                self.checked_sum(cell, known, own, &terms, eighths)
            })
        })
    }

    /// Proves that an arctangent is Σ ± atan u_j + eπ/4 + mπ for some whole m.
    fn checked_sum(
        &self,
        cell: &Cell,
        known: &[(usize, SignFact)],
        own: [usize; 2],
        terms: &[([usize; 2], i64)],
        eighths: i64,
    ) -> Option<(ArctangentSum, Certificate)> {
        let graph = &cell.graph;
        let test = Defect { graph, sources: self.sources, digest: self.digest, is_related: true };
        let arguments: Vec<usize> =
            std::iter::once(own[1]).chain(terms.iter().map(|(other, _)| other[1])).collect();
        let vanishing = |values: &[Option<Expr>]| {
            let mut factors = vec![(values[own[1]]?, 1)];
            for (other, sign) in terms {
                factors.push((values[other[1]]?, -sign));
            }
            Some(vec![defect(product(factors), eighths)])
        };
        let proof = test.vanishing(&arguments, &vanishing)?;
        let places: Vec<usize> =
            std::iter::once(own[0]).chain(terms.iter().map(|(other, _)| other[0])).collect();
        // The difference is a whole number of half turns; it is m if it is nearer to m than a half turn.
        let turns = (-MOST_TURNS..=MOST_TURNS).find(|turns| {
            [1, -1].into_iter().all(|side| {
                let beyond = |values: &[Option<Expr>]| {
                    let mut difference = values[own[0]]? - turned(eighths + 4 * turns);
                    for (other, sign) in terms {
                        difference -= values[other[0]]? * number(*sign);
                    }
                    let below_half_turn = Expr::rational(&Rational::new(31_415_926, 10_000_000));
                    Some(below_half_turn - difference * number(side))
                };
                cell.sign_of(known, self.prover.extents, &places, beyond) == Some(true)
            })
        })?;
        let terms = terms.iter().map(|(other, sign)| (other[0], *sign)).collect();
        Some((ArctangentSum { terms, eighths: eighths + 4 * turns }, proof))
    }
}
