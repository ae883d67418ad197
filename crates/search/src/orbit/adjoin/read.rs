//! Recorded formulas as polynomials of a ring.

use liouville::graph::{Graph, Step};
use liouville::number::rational::Rational;
use liouville::number::{Function, Operation};

use super::polynomial::Polynomial;
use super::ring::Ring;

/// Steps of a recording as polynomials.
pub struct Reader<'g> {
    graph: &'g Graph,
    values: Vec<Option<Polynomial>>,
}

impl<'g> Reader<'g> {
    /// Starts with nothing read.
    pub fn new(graph: &'g Graph) -> Self {
        Self { graph, values: vec![None; graph.len()] }
    }

    /// The value of a step; `None` if it is not a polynomial in functions that can be adjoined.
    pub fn read(&mut self, place: usize, ring: &mut Ring) -> Option<Polynomial> {
        let reached = self.graph.reached_from(&[place]);
        for own in (0..=place).filter(|own| reached[*own]) {
            if self.values[own].is_none() {
                self.values[own] = Some(self.step(own, ring)?);
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
    fn inverse(&self, place: usize, ring: &mut Ring) -> Option<Polynomial> {
        match self.graph.step(place) {
            Step::Unary(Function::Neg, a) => {
                Some(self.inverse(a, ring)?.times_number(&Rational::from(-1)))
            }
            Step::Binary(Operation::Mul, a, b) => {
                self.inverse(a, ring)?.times(&self.inverse(b, ring)?)
            }
            Step::Power(a, exponent) => ring.power(self.values[a].as_ref()?, &-exponent),
            _ => ring.inverse(self.values[place].as_ref()?),
        }
    }

    fn step(&self, place: usize, ring: &mut Ring) -> Option<Polynomial> {
        let of = |place: usize| self.values[place].as_ref();
        let (one, minus) = (Rational::from(1), Rational::from(-1));
        match self.graph.step(place) {
            Step::Constant(value) => Some(Polynomial::constant(value.clone())),
            Step::Input(input) => Some(Polynomial::variable(input, 1)),
            Step::Unary(function, a) => {
                let a = of(a)?;
                match function {
                    Function::Neg => Some(a.times_number(&minus)),
                    Function::Recip => self.inverse(self.argument(place)?, ring),
                    Function::Sqrt => ring.power(a, &Rational::new(1, 2)),
                    Function::Exp => ring.exponential(a),
                    Function::Ln => ring.logarithm(a),
                    Function::Sin => ring.circular(a).map(|[_, sine]| sine),
                    Function::Cos => ring.circular(a).map(|[cosine, _]| cosine),
                    Function::Atan => ring.arctangent(a),
                    Function::Abs => None,
                }
            }
            Step::Binary(operation, a, b) => {
                let (a, b) = (of(a)?, of(b)?);
                match operation {
                    Operation::Add => a.plus(b, &one),
                    Operation::Sub => a.plus(b, &minus),
                    Operation::Mul => a.times(b),
                    Operation::Pow => ring.general_power(a, b),
                }
            }
            Step::Power(a, exponent) => ring.power(of(a)?, exponent),
        }
    }
}
