//! Recorded formulas as polynomials of a ring.

use liouville::graph::{Graph, Step};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};

use super::polynomial::RingPolynomial;
use super::ring::AdjoinedRing;

/// Whether a step is a function whose powers, and products with others, are written as one function, too.
pub fn is_counted(step: Step<'_>) -> bool {
    use UnaryFunction::{Cos, Exp, Sin};
    matches!(step, Step::Unary(Exp | Sin | Cos, _) | Step::Binary(BinaryOperation::Pow, ..))
}

/// Steps of a recording as polynomials.
#[derive(Clone)]
pub struct StepReader<'g> {
    graph: &'g Graph,
    values: Vec<Option<RingPolynomial>>,
}

impl<'g> StepReader<'g> {
    /// Starts with nothing read.
    pub fn new(graph: &'g Graph) -> Self {
        Self { graph, values: vec![None; graph.len()] }
    }

    /// The value of a step; `None` if it is not a polynomial in functions that can be adjoined.
    pub fn read(&mut self, place: usize, ring: &mut AdjoinedRing) -> Option<RingPolynomial> {
        let reached = self.graph.reached_from(&[place]);
        for own in (0..=place).filter(|own| reached[*own]) {
            if self.values[own].is_none() {
                let value = self.step(own, ring)?;
                if is_counted(self.graph.step(own)) && !ring.functions.contains(&value) {
                    ring.functions.push(value.clone());
                }
                self.values[own] = Some(value);
            }
        }
        self.values[place].clone()
    }

    fn argument(&self, place: usize) -> Option<usize> {
        match self.graph.step(place) {
            Step::Unary(_, a) => Some(a),
            _ => None,
        }
    }

    /// The inverse of a step, factor by factor: a product that is written out has lost its factors.
    fn inverse(&self, place: usize, ring: &mut AdjoinedRing) -> Option<RingPolynomial> {
        match self.graph.step(place) {
            Step::Unary(UnaryFunction::Neg, a) => {
                Some(self.inverse(a, ring)?.times_number(&Rational::from(-1)))
            }
            Step::Binary(BinaryOperation::Mul, a, b) => {
                self.inverse(a, ring)?.times(&self.inverse(b, ring)?)
            }
            Step::Power(a, exponent) => ring.power(self.values[a].as_ref()?, &-exponent),
            _ => ring.inverse(self.values[place].as_ref()?),
        }
    }

    fn step(&self, place: usize, ring: &mut AdjoinedRing) -> Option<RingPolynomial> {
        let of = |place: usize| self.values[place].as_ref();
        let (one, minus) = (Rational::from(1), Rational::from(-1));
        match self.graph.step(place) {
            Step::Constant(value) => Some(RingPolynomial::constant(value.clone())),
            Step::Input(input) => Some(RingPolynomial::variable(input, 1)),
            Step::Unary(function, a) => {
                let a = of(a)?;
                match function {
                    UnaryFunction::Neg => Some(a.times_number(&minus)),
                    UnaryFunction::Recip => self.inverse(self.argument(place)?, ring),
                    UnaryFunction::Sqrt => ring.power(a, &Rational::new(1, 2)),
                    UnaryFunction::Exp => ring.exponential(a),
                    UnaryFunction::Ln => ring.logarithm(a),
                    UnaryFunction::Sin => ring.circular(a).map(|[_, sine]| sine),
                    UnaryFunction::Cos => ring.circular(a).map(|[cosine, _]| cosine),
                    UnaryFunction::Atan => ring.arctangent(a),
                    // |u| is a root of u², and is written as a modulus.
                    UnaryFunction::Abs => ring.power(&a.times(a)?, &Rational::new(1, 2)),
                }
            }
            Step::Binary(operation, a, b) => {
                let (a, b) = (of(a)?, of(b)?);
                match operation {
                    BinaryOperation::Add => a.plus(b, &one),
                    BinaryOperation::Sub => a.plus(b, &minus),
                    BinaryOperation::Mul => a.times(b),
                    BinaryOperation::Pow => ring.general_power(a, b),
                }
            }
            Step::Power(a, exponent) => ring.power(of(a)?, exponent),
        }
    }
}
