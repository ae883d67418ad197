//! Roots of squares of functions that occur nowhere else: √(1 − sin²u) = |cos u| and √(1 + sinh²u) = cosh u.

use crate::graph::{Expr, Step};
use crate::number::UnaryFunction::{Cos, Exp, Recip, Sin};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::relations::Defect;
use super::roots::RootFinder;
use super::trial::Certificate;

/// Largest number of angles that are tried.
const MOST_ANGLES: usize = 4;

/// A function of u.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Partner {
    Sine,
    Cosine,
    HyperbolicSine,
    HyperbolicCosine,
}

/// A function of the value at a place, or its reciprocal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartnerValue {
    function: Partner,
    is_inverse: bool,
    /// Place of u.
    pub place: usize,
}

impl PartnerValue {
    /// Records the value.
    pub fn value(self, at: impl Fn(usize) -> Option<Expr>) -> Option<Expr> {
        let u = at(self.place)?;
        let half = Expr::rational(&Rational::new(1, 2));
        let value = match self.function {
            Partner::Sine => u.apply(Sin),
            Partner::Cosine => u.apply(Cos),
            Partner::HyperbolicSine => (u.apply(Exp) - (-u).apply(Exp)) * half,
            Partner::HyperbolicCosine => (u.apply(Exp) + (-u).apply(Exp)) * half,
        };
        Some(if self.is_inverse { value.apply(Recip) } else { value })
    }
}

impl RootFinder<'_> {
    /// Finds a function whose square is the value at a place.
    pub(super) fn square_of_function(&self, place: usize) -> Option<(PartnerValue, Certificate)> {
        let reached = self.graph.reached_from(&[place]);
        let steps = self.graph.steps().enumerate().filter(|(own, _)| reached[*own]);
        let mut all: Vec<(bool, usize)> = Vec::new();
        for (_, step) in steps {
            let own = match step {
                Step::Unary(Sin | Cos, a) => (true, a),
                Step::Unary(Exp, a) => (false, a),
                _ => continue,
            };
            if !all.contains(&own) && all.len() < MOST_ANGLES {
                all.push(own);
            }
        }
        let sources = &self.algebraic.sources[..self.algebraic.original_inputs];
        let test = Defect { graph: self.graph, sources, digest: self.digest, is_related: true };
        let candidates = all.into_iter().flat_map(|(is_turn, place)| {
            let functions = match is_turn {
                true => [Partner::Cosine, Partner::Sine],
                false => [Partner::HyperbolicCosine, Partner::HyperbolicSine],
            };
            let both = move |function| {
                [false, true].map(|is_inverse| PartnerValue { function, is_inverse, place })
            };
            functions.into_iter().flat_map(both)
        });
        candidates.into_iter().find_map(|own| {
            let defect = |values: &[Option<Expr>]| {
                let b = own.value(|place| values.get(place).copied().flatten())?;
                Some(vec![values[place]? - b * b])
            };
            Some((own, test.vanishing(&[place, own.place], &defect)?))
        })
    }
}
