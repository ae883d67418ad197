//! Constants that instructions read in addition to the rows.

use super::super::code::Code;
use super::encode::{At, Base};

/// List of constants: 1/n, 1/(n + 1) and small numbers; a scale and a constant for each operation;
/// a slope, and its fixed part, for each term; the coefficients of factors and of copies.
pub(super) struct Constants {
    pub(super) list: Vec<f64>,
    slopes: usize,
    fixed: usize,
    constants: usize,
    factors: usize,
    weights: usize,
}

/// Index of the first scale.
const SCALES: usize = 5;

impl Constants {
    pub(super) const BY_N: At = At(Base::Constants, 0);
    pub(super) const BY_NEXT: At = At(Base::Constants, 1);
    pub(super) const ONE: At = At(Base::Constants, 2);
    pub(super) const TWO: At = At(Base::Constants, 3);
    pub(super) const MINUS_ONE: At = At(Base::Constants, 4);

    pub(super) fn new(code: &Code<f64>) -> Self {
        let mut list = vec![0.0, 0.0, 1.0, 2.0, -1.0];
        let begin = |list: &mut Vec<f64>, values: &mut dyn Iterator<Item = f64>| {
            let begin = list.len();
            list.extend(values);
            begin
        };
        begin(&mut list, &mut code.finishes.iter().map(|finish| finish.scale));
        Self {
            slopes: begin(&mut list, &mut code.terms.iter().map(|_| 0.0)),
            fixed: begin(&mut list, &mut code.terms.iter().map(|term| term.fixed)),
            constants: begin(&mut list, &mut code.operations.iter().map(|own| own.constant)),
            factors: begin(&mut list, &mut code.factors.iter().map(|factor| factor.weight)),
            weights: begin(&mut list, &mut code.copies.iter().map(|copy| copy.weight)),
            list,
        }
    }

    /// Copies the scales and slopes of an expansion.
    pub(super) fn take(&mut self, code: &Code<f64>) {
        let (scales, slopes) = self.list[SCALES..].split_at_mut(self.slopes - SCALES);
        scales.iter_mut().zip(&code.finishes).for_each(|(own, finish)| *own = finish.scale);
        slopes.iter_mut().zip(&code.terms).for_each(|(own, term)| *own = term.slope);
    }

    /// Copies 1/n and 1/(n + 1).
    pub(super) fn at_order(&mut self, n: usize, inverses: &[f64]) {
        self.list[..2].copy_from_slice(&inverses[n..n + 2]);
    }

    /// Sets the slopes of the terms n x_n.
    pub(super) fn thetas(&mut self, code: &Code<f64>, n: usize) {
        for theta in &code.thetas {
            self.list[self.slopes + *theta as usize] = n as f64;
        }
    }

    pub(super) fn scale(&self, operation: usize) -> At {
        At(Base::Constants, (SCALES + operation) as i32)
    }

    pub(super) fn constant(&self, operation: usize) -> At {
        At(Base::Constants, (self.constants + operation) as i32)
    }

    pub(super) fn slope(&self, term: usize) -> At {
        At(Base::Constants, (self.slopes + term) as i32)
    }

    pub(super) fn fixed(&self, term: usize) -> At {
        At(Base::Constants, (self.fixed + term) as i32)
    }

    pub(super) fn factor(&self, factor: usize) -> At {
        At(Base::Constants, (self.factors + factor) as i32)
    }

    pub(super) fn weight(&self, copy: usize) -> At {
        At(Base::Constants, (self.weights + copy) as i32)
    }
}
