//! Constants that instructions read in addition to the rows.

use std::collections::BTreeMap;

use super::call::Packed;
use super::encode::{At, BaseRegister};
use crate::taylor::code::{BoundProgram, part};

/// List of constants: 1/n, 1/(n + 1) and small numbers; a scale for each operation and a slope for
/// each term; all other constants of the program, once each.
pub(super) struct Constants<T> {
    pub(super) list: Vec<T>,
    slopes: usize,
    /// Whether the slope of a term depends on the values.
    varies: Vec<bool>,
    fixed: Vec<u32>,
    constants: Vec<u32>,
    factors: Vec<u32>,
    weights: Vec<u32>,
}

/// Index of the first scale.
const SCALES: usize = 5;

impl<T: Packed> Constants<T> {
    pub(super) const BY_N: At = at(0, T::LANES);
    pub(super) const BY_NEXT: At = at(1, T::LANES);
    pub(super) const ONE: At = at(2, T::LANES);
    pub(super) const TWO: At = at(3, T::LANES);
    pub(super) const MINUS_ONE: At = at(4, T::LANES);

    pub(super) fn new(code: &BoundProgram<T>) -> Self {
        let mut list: Vec<T> = [0.0, 0.0, 1.0, 2.0, -1.0].map(T::float).to_vec();
        list.extend(code.finishes.iter().map(|finish| finish.scale));
        let slopes = list.len();
        list.extend(code.terms.iter().map(|_| T::ZERO));
        let mut varies = vec![true; code.terms.len()];
        for operation in code.operations.iter().filter(|operation| operation.rule.is_sum()) {
            let factors = part(&code.factors, operation.factors);
            for term in operation.terms.0..operation.terms.1 {
                varies[term as usize] = factors.iter().any(|own| own.x == term || own.y == term);
            }
        }
        let mut places = BTreeMap::new();
        let mut place = |value: &T| {
            *places.entry(value.leading().to_bits()).or_insert_with(|| {
                list.push(*value);
                list.len() as u32 - 1
            })
        };
        let fixed = code.terms.iter().map(|term| place(&term.fixed)).collect();
        let constants = code.operations.iter().map(|own| place(&own.constant)).collect();
        let factors = code.factors.iter().map(|factor| place(&factor.weight)).collect();
        let weights = code.copies.iter().map(|copy| place(&copy.weight)).collect();
        Self { slopes, varies, fixed, constants, factors, weights, list }
    }

    /// Copies the scales and slopes of an expansion.
    pub(super) fn take(&mut self, code: &BoundProgram<T>) {
        let (scales, slopes) = self.list[SCALES..].split_at_mut(self.slopes - SCALES);
        scales.iter_mut().zip(&code.finishes).for_each(|(own, finish)| *own = finish.scale);
        slopes.iter_mut().zip(&code.terms).for_each(|(own, term)| *own = term.slope);
    }

    /// Copies 1/n, and the unit of time over n + 1.
    pub(super) fn at_order(&mut self, n: usize, [inverses, advances]: [&[T]; 2]) {
        self.list[..2].copy_from_slice(&[inverses[n], advances[n + 1]]);
    }

    /// Sets the slopes of the terms n x_n.
    pub(super) fn thetas(&mut self, code: &BoundProgram<T>, n: usize) {
        for theta in &code.thetas {
            self.list[self.slopes + *theta as usize] = T::float(n as f64);
        }
    }

    pub(super) fn scale(&self, operation: usize) -> At {
        at(SCALES + operation, T::LANES)
    }

    pub(super) fn constant(&self, operation: usize) -> At {
        at(self.constants[operation] as usize, T::LANES)
    }

    /// Slope of a term, to be read. It is that of all terms with this constant slope.
    pub(super) fn slope(&self, term: usize) -> At {
        if self.varies[term] { self.own_slope(term) } else { self.fixed(term) }
    }

    /// Slope of a term, to be written, if it depends on the values.
    pub(super) fn varying(&self, term: usize) -> Option<At> {
        self.varies[term].then(|| self.own_slope(term))
    }

    fn own_slope(&self, term: usize) -> At {
        at(self.slopes + term, T::LANES)
    }

    pub(super) fn fixed(&self, term: usize) -> At {
        at(self.fixed[term] as usize, T::LANES)
    }

    pub(super) fn factor(&self, factor: usize) -> At {
        at(self.factors[factor] as usize, T::LANES)
    }

    pub(super) fn weight(&self, copy: usize) -> At {
        at(self.weights[copy] as usize, T::LANES)
    }
}

/// Address of a constant that takes this many f64.
const fn at(index: usize, lanes: usize) -> At {
    At(BaseRegister::Constants, (index * lanes) as i32)
}
