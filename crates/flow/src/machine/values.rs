//! Instructions for order 0 of all rows, and for the slopes that the higher orders share.

use super::super::code::{Bound, Code, Operation, Place, part};
use super::constants::Constants;
use super::emit::{Kept, next_order};
use super::encode::{Assembler, At, Base, Register, Width};

/// Registers for temporary values.
const A: Register = 0;
const B: Register = 1;

/// Emits order 0 of all rows and order 1 of the state, with scales and slopes. `None` where a rule
/// is not an instruction.
pub(super) fn values(code: &Code<f64>, constants: &Constants) -> Option<Assembler> {
    let mut values = Values { code, constants, to: Assembler::default(), kept: Kept::new() };
    for (index, operation) in code.operations.iter().enumerate() {
        let place = code.finishes[index].place;
        let term = operation.terms.0 as usize;
        match &operation.rule {
            Bound::Sum => {
                values.sum(index, operation, place);
                values.slopes(operation);
            }
            Bound::Theta => {
                values.to.zero(A);
                values.to.store(Width::One, A, At(Base::Rows, place as i32));
            }
            Bound::Recip(x) => values.reciprocal(index, term, *x, place),
            Bound::Sqrt(x) => values.root(index, term, *x, place),
            _ => return None,
        }
    }
    next_order(code, constants, &mut values.to, &values.kept);
    values.to.end();
    Some(values.to)
}

struct Values<'c> {
    code: &'c Code<f64>,
    constants: &'c Constants,
    to: Assembler,
    kept: Kept,
}

impl Values<'_> {
    /// Emits constant + Σ c x + Σ c x y.
    fn sum(&mut self, index: usize, operation: &Operation<f64>, place: Place) {
        let sum = self.kept.place_of(place);
        self.to.load(Width::One, sum, self.constants.constant(index));
        for index in operation.terms.0..operation.terms.1 {
            let term = &self.code.terms[index as usize];
            if term.fixed != 0.0 {
                let x = self.row(term.x, A);
                self.to.fused(Width::One, sum, x, self.constants.fixed(index as usize));
            }
        }
        for index in operation.factors.0..operation.factors.1 {
            let factor = &self.code.factors[index as usize];
            let [x, y] = [factor.x, factor.y].map(|term| self.code.terms[term as usize].x);
            let x = self.row(x, A);
            self.to.multiply(B, x, self.constants.factor(index as usize));
            self.to.fused(Width::One, sum, B, At(Base::Rows, y as i32));
        }
        self.to.store(Width::One, sum, At(Base::Rows, place as i32));
    }

    /// Emits the derivatives of a sum with respect to its rows.
    fn slopes(&mut self, operation: &Operation<f64>) {
        let factors = part(&self.code.factors, operation.factors);
        for term in operation.terms.0..operation.terms.1 {
            self.to.load(Width::One, A, self.constants.fixed(term as usize));
            for (index, factor) in (operation.factors.0..).zip(factors) {
                for (own, other) in [(factor.x, factor.y), (factor.y, factor.x)] {
                    if own == term {
                        let other = self.row(self.code.terms[other as usize].x, B);
                        let weight = self.constants.factor(index as usize);
                        self.to.fused(Width::One, A, other, weight);
                    }
                }
            }
            self.to.store(Width::One, A, self.constants.slope(term as usize));
        }
    }

    /// Emits z = 1/x, with scale -z and slope -z².
    fn reciprocal(&mut self, index: usize, term: usize, x: Place, place: Place) {
        let z = self.kept.place_of(place);
        self.to.load(Width::One, z, Constants::ONE);
        self.to.divide(z, z, At(Base::Rows, x as i32));
        self.to.store(Width::One, z, At(Base::Rows, place as i32));
        self.to.multiply(A, z, Constants::MINUS_ONE);
        self.to.store(Width::One, A, self.constants.scale(index));
        self.to.multiply(A, A, At(Base::Rows, place as i32));
        self.to.store(Width::One, A, self.constants.slope(term));
    }

    /// Emits z = √x, with slope 1/2z and scale -1/2z.
    fn root(&mut self, index: usize, term: usize, x: Place, place: Place) {
        let z = self.kept.place_of(place);
        self.to.square_root(z, At(Base::Rows, x as i32));
        self.to.store(Width::One, z, At(Base::Rows, place as i32));
        self.to.multiply(A, z, Constants::TWO);
        self.to.store(Width::One, A, self.constants.slope(term));
        self.to.load(Width::One, A, Constants::ONE);
        self.to.divide(A, A, self.constants.slope(term));
        self.to.store(Width::One, A, self.constants.slope(term));
        self.to.multiply(A, A, Constants::MINUS_ONE);
        self.to.store(Width::One, A, self.constants.scale(index));
    }

    /// Returns a register that holds a row: the one where it is kept, or else this one.
    fn row(&mut self, row: Place, register: Register) -> Register {
        self.kept.find(row).unwrap_or_else(|| {
            self.to.load(Width::One, register, At(Base::Rows, row as i32));
            register
        })
    }
}
