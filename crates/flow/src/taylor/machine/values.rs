//! Instructions for order 0 of all rows, and for the slopes that the higher orders share.

use super::call::Packed;
use super::constants::Constants;
use super::emit::{Kept, next_order, row};
use super::encode::{Register, TaylorEncoder, Width};
use crate::taylor::code::{BoundProgram, InitialOperation, Place, PlacedRule, part};

/// Registers for temporary values.
const A: Register = 0;
const B: Register = 1;

/// Emits order 0 of all rows and order 1 of the state, with scales and slopes. `None` where a rule
/// is not an instruction.
pub(super) fn values<T: Packed>(
    code: &BoundProgram<T>,
    constants: &Constants<T>,
    width: Width,
) -> Option<TaylorEncoder> {
    let (to, kept) = (TaylorEncoder::default(), Kept::new());
    let mut values = ValueCode { code, constants, width, to, kept };
    for (index, operation) in code.operations.iter().enumerate() {
        let place = code.finishes[index].place;
        let term = operation.terms.0 as usize;
        match &operation.rule {
            PlacedRule::Sum => {
                values.sum(index, operation, place);
                values.slopes(operation);
            }
            PlacedRule::Theta => {
                values.to.zero(A);
                values.to.store(width, A, row::<T>(place));
            }
            PlacedRule::Recip(x) => values.reciprocal(index, term, *x, place),
            PlacedRule::Sqrt(x) => values.root(index, term, *x, place),
            _ => return None,
        }
    }
    next_order(code, constants, width, &mut values.to, &values.kept);
    values.to.end();
    Some(values.to)
}

struct ValueCode<'c, T> {
    code: &'c BoundProgram<T>,
    constants: &'c Constants<T>,
    width: Width,
    to: TaylorEncoder,
    kept: Kept,
}

impl<T: Packed> ValueCode<'_, T> {
    /// Emits constant + Σ c x + Σ c x y.
    fn sum(&mut self, index: usize, operation: &InitialOperation<T>, place: Place) {
        let sum = self.kept.place_of(place);
        self.to.load(self.width, sum, self.constants.constant(index));
        for index in operation.terms.0..operation.terms.1 {
            let term = &self.code.terms[index as usize];
            if term.fixed.leading() != 0.0 {
                let x = self.row(term.x, A);
                self.to.fused(self.width, sum, x, self.constants.fixed(index as usize));
            }
        }
        for index in operation.factors.0..operation.factors.1 {
            let factor = &self.code.factors[index as usize];
            let [x, y] = [factor.x, factor.y].map(|term| self.code.terms[term as usize].x);
            let x = self.row(x, A);
            self.to.multiply(self.width, B, x, self.constants.factor(index as usize));
            self.to.fused(self.width, sum, B, row::<T>(y));
        }
        self.to.store(self.width, sum, row::<T>(place));
    }

    /// Emits the derivatives of a sum with respect to its rows.
    fn slopes(&mut self, operation: &InitialOperation<T>) {
        let factors = part(&self.code.factors, operation.factors);
        for term in operation.terms.0..operation.terms.1 {
            let Some(slope) = self.constants.varying(term as usize) else { continue };
            self.to.load(self.width, A, self.constants.fixed(term as usize));
            for (index, factor) in (operation.factors.0..).zip(factors) {
                for (own, other) in [(factor.x, factor.y), (factor.y, factor.x)] {
                    if own == term {
                        let other = self.row(self.code.terms[other as usize].x, B);
                        let weight = self.constants.factor(index as usize);
                        self.to.fused(self.width, A, other, weight);
                    }
                }
            }
            self.to.store(self.width, A, slope);
        }
    }

    /// Emits z = 1/x, with scale -z and slope -z².
    fn reciprocal(&mut self, index: usize, term: usize, x: Place, place: Place) {
        let z = self.kept.place_of(place);
        self.to.load(self.width, z, Constants::<T>::ONE);
        self.to.divide(self.width, z, z, row::<T>(x));
        self.to.store(self.width, z, row::<T>(place));
        self.to.multiply(self.width, A, z, Constants::<T>::MINUS_ONE);
        self.to.store(self.width, A, self.constants.scale(index));
        self.to.multiply(self.width, A, A, row::<T>(place));
        self.to.store(self.width, A, self.constants.slope(term));
    }

    /// Emits z = √x, with slope 1/2z and scale -1/2z.
    fn root(&mut self, index: usize, term: usize, x: Place, place: Place) {
        let z = self.kept.place_of(place);
        self.to.square_root(self.width, z, row::<T>(x));
        self.to.store(self.width, z, row::<T>(place));
        self.to.multiply(self.width, A, z, Constants::<T>::TWO);
        self.to.store(self.width, A, self.constants.slope(term));
        self.to.load(self.width, A, Constants::<T>::ONE);
        self.to.divide(self.width, A, A, self.constants.slope(term));
        self.to.store(self.width, A, self.constants.slope(term));
        self.to.multiply(self.width, A, A, Constants::<T>::MINUS_ONE);
        self.to.store(self.width, A, self.constants.scale(index));
    }

    /// Returns a register that holds a row: the one where it is kept, or else this one.
    fn row(&mut self, place: Place, register: Register) -> Register {
        self.kept.find(place).unwrap_or_else(|| {
            self.to.load(self.width, register, row::<T>(place));
            register
        })
    }
}
