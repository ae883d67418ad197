//! Series of the steps of a graph about places where divisors are 0, each made once.

use std::collections::BTreeMap;

use super::{affine, parts};
use crate::taylor::germ::{Affine, Germ, LENGTH};
use liouville::graph::{Graph, Step};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};

/// Largest number of variables whose series are kept.
const MOST_KEPT: usize = 16;

/// Series of steps in one variable, and whether functions enter them.
type Known = BTreeMap<usize, (Germ, bool)>;

/// Series of the steps of a graph. Products of a field share most of their factors.
pub(in crate::taylor) struct Germs<'g> {
    pub(in crate::taylor) graph: &'g Graph,
    known: Vec<(Affine, Known)>,
}

impl<'g> Germs<'g> {
    pub(in crate::taylor) fn new(graph: &'g Graph) -> Self {
        Self { graph, known: Vec::new() }
    }

    /// Number of series made.
    #[cfg(test)]
    pub(super) fn count(&self) -> usize {
        self.known.iter().map(|(_, own)| own.len()).sum()
    }

    /// Series of a step in v, and whether functions enter it.
    pub(super) fn of(&mut self, place: usize, v: &Affine) -> Option<&(Germ, bool)> {
        let parts = parts(self.graph, place)?;
        let index = match self.known.iter().position(|(own, _)| own == v) {
            Some(index) => index,
            None => {
                if self.known.len() == MOST_KEPT {
                    self.known.remove(0);
                }
                self.known.push((v.clone(), Known::new()));
                self.known.len() - 1
            }
        };
        let all = &mut self.known[index].1;
        if !all.contains_key(&place) {
            let affine = affine(self.graph, &parts);
            for place in parts {
                if all.contains_key(&place) {
                    continue;
                }
                let own = affine.get(&place).and_then(|own| Germ::of_affine(own, v));
                let found = match own {
                    Some(own) => (own, false),
                    None => made(self.graph.step(place), all)
                        .unwrap_or_else(|| (Germ::unknown(place), false)),
                };
                all.insert(place, found);
            }
        }
        all.get(&place)
    }
}

/// Series of a step by those of its arguments.
fn made(step: Step<'_>, all: &Known) -> Option<(Germ, bool)> {
    let sum = |a: usize, b: usize, factor: i64| {
        let ((x, f), (y, g)) = (all.get(&a)?, all.get(&b)?);
        Some((x.clone().plus(y, &Rational::from(factor))?, *f || *g))
    };
    match step {
        Step::Binary(BinaryOperation::Add, a, b) => sum(a, b, 1),
        Step::Binary(BinaryOperation::Sub, a, b) => sum(a, b, -1),
        Step::Binary(BinaryOperation::Mul, a, b) => {
            let ((x, f), (y, g)) = (all.get(&a)?, all.get(&b)?);
            Some((x.product(y)?, *f || *g))
        }
        Step::Unary(UnaryFunction::Neg, a) => {
            let (x, f) = all.get(&a)?;
            let zero = Germ::of_constant(Rational::from(0));
            Some((zero.plus(x, &Rational::from(-1))?, *f))
        }
        Step::Unary(function, a) => {
            let (x, f) = all.get(&a)?;
            Some((x.apply(function)?, *f || function != UnaryFunction::Recip))
        }
        Step::Power(a, exponent) => {
            let (x, f) = all.get(&a)?;
            let whole = u32::try_from(exponent.to_integer()?).ok()?;
            ((whole as usize) < LENGTH).then(|| x.power(whole))?.map(|power| (power, *f))
        }
        _ => None,
    }
}
