//! Sums of products with exact coefficients, the operands of a program's instructions.

use liouville::number::rational::Rational;

/// Index of a row of Taylor coefficients.
pub type Row = usize;

/// A form constant + Σ c x + Σ c x y over rows x, y.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BilinearForm {
    pub constant: Option<Rational>,
    pub linear: Vec<(Rational, Row)>,
    pub products: Vec<(Rational, Row, Row)>,
}

impl BilinearForm {
    pub fn of_constant(value: &Rational) -> Self {
        Self { constant: Some(value.clone()), ..Self::default() }
    }

    pub fn of_row(coefficient: Rational, row: Row) -> Self {
        Self { linear: vec![(coefficient, row)], ..Self::default() }
    }

    /// The form c x y, with the rows in increasing order.
    pub fn of_product(coefficient: Rational, a: Row, b: Row) -> Self {
        Self { products: vec![(coefficient, a.min(b), a.max(b))], ..Self::default() }
    }

    /// Returns c and x if the form is c x.
    pub fn as_row(&self) -> Option<(&Rational, Row)> {
        match (&self.constant, self.linear.as_slice(), self.products.as_slice()) {
            (None, [(coefficient, row)], []) => Some((coefficient, *row)),
            _ => None,
        }
    }

    /// Returns the constant if the form has no other terms.
    pub fn as_constant(&self) -> Option<Rational> {
        (self.linear.is_empty() && self.products.is_empty())
            .then(|| self.constant.clone().unwrap_or_else(|| Rational::from(0)))
    }

    pub fn plus(mut self, other: Self) -> Self {
        if let Some(value) = other.constant {
            let sum = self.constant.as_ref().map_or(value.clone(), |own| own + &value);
            self.constant = Some(sum);
        }
        for (coefficient, row) in other.linear {
            match self.linear.iter_mut().find(|(_, own)| *own == row) {
                Some((own, _)) => *own = &*own + &coefficient,
                None => self.linear.push((coefficient, row)),
            }
        }
        for (coefficient, a, b) in other.products {
            match self.products.iter_mut().find(|(_, x, y)| (*x, *y) == (a, b)) {
                Some((own, ..)) => *own = &*own + &coefficient,
                None => self.products.push((coefficient, a, b)),
            }
        }
        self.linear.retain(|(coefficient, _)| !coefficient.is_zero());
        self.products.retain(|(coefficient, ..)| !coefficient.is_zero());
        self
    }

    pub fn times(mut self, factor: &Rational) -> Self {
        self.constant = self.constant.map(|value| &value * factor);
        self.linear.iter_mut().for_each(|(own, _)| *own = &*own * factor);
        self.products.iter_mut().for_each(|(own, ..)| *own = &*own * factor);
        self
    }

    /// Number of terms.
    pub fn len(&self) -> usize {
        usize::from(self.constant.is_some()) + self.linear.len() + self.products.len()
    }
}
