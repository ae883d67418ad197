//! A Taylor program bound to memory, as an expansion runs it.
//!
//! Each row is stored forwards. The second factor of a product is stored times the coefficient of
//! the product, and backwards where numbers are added along the order, with zeros behind order 1: a
//! Cauchy product is then a plain dot product. Which factor is the second does not depend on that. Order n ≥ 1 of an operation is linear in order n of
//! the rows before it,
//!
//! ```text
//! z_n = scale · Σ c x_k y_{n-k} + Σ slope · x_n      (Σ over k from 1 to n - 1)
//! ```
//!
//! and its slopes are the same at all orders: they are computed once, from the values.

use crate::taylor::form::Row;
use crate::taylor::number::SeriesNumber;
pub(crate) use crate::taylor::placed::PlacedRule;
use crate::taylor::program::{RowInstruction, Rule, TaylorProgram};
use liouville::number::rational::Rational;

/// Bytes of a cache line; order 1 of each row is aligned to it.
pub(crate) const LINE: usize = 64;

/// Index of order 0 of a row in memory.
pub(crate) type Place = u32;
/// Range of a list: first index, and one past the last.
pub(crate) type Part = (u32, u32);

/// Returns the entries of a list in a range.
#[inline(always)]
pub(crate) fn part<X>(list: &[X], part: Part) -> &[X] {
    &list[part.0 as usize..part.1 as usize]
}

/// Returns the entries of a list in a range, to be changed.
#[inline(always)]
pub(crate) fn part_mut<X>(list: &mut [X], part: Part) -> &mut [X] {
    &mut list[part.0 as usize..part.1 as usize]
}

/// Splits off the first `count` entries of a list.
#[inline(always)]
pub(crate) fn first<'l, X>(list: &mut &'l [X], count: u32) -> &'l [X] {
    let (first, others) = list.split_at(count as usize);
    *list = others;
    first
}

/// A Taylor program bound to memory.
pub(crate) struct BoundProgram<T> {
    pub(crate) operations: Vec<InitialOperation<T>>,
    /// One entry for each operation.
    pub(crate) finishes: Vec<Finish<T>>,
    /// Number of products of each operation that has any.
    pub(crate) counts: Vec<u32>,
    pub(crate) products: Vec<Product>,
    pub(crate) factors: Vec<SlopeFactor<T>>,
    pub(crate) terms: Vec<SlopeTerm<T>>,
    /// Indices of the terms n x_n, whose slope is the order n.
    pub(crate) thetas: Vec<u32>,
    pub(crate) copies: Vec<Copied<T>>,
    /// Number of copies of the state, which precede those of the operations.
    pub(crate) of_state: usize,
    pub(crate) state: Vec<Component>,
    /// Places of the further functions.
    pub(crate) outputs: Vec<Place>,
}

/// Product x · (c y), or -x · (|c| y).
pub(crate) struct Product {
    pub(crate) x: Place,
    pub(crate) cy: Place,
    pub(crate) negative: bool,
}

/// Contribution of a product c x y to the slopes of x_n and y_n; `x` and `y` are indices of terms.
pub(crate) struct SlopeFactor<T> {
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) weight: T,
}

/// Product slope · x.
pub(crate) struct SlopeTerm<T> {
    pub(crate) x: Place,
    pub(crate) slope: T,
    /// Part of the slope that does not depend on the values.
    pub(crate) fixed: T,
}

/// A further copy of a row, times a weight.
pub(crate) struct Copied<T> {
    pub(crate) place: Place,
    pub(crate) weight: T,
}

/// A component of the state.
pub(crate) struct Component {
    pub(crate) place: Place,
    pub(crate) rate: Place,
    /// Number of copies kept of the component.
    pub(crate) copies: u32,
}

/// Computation of order 0 of a row.
pub(crate) struct InitialOperation<T> {
    pub(crate) rule: PlacedRule<T>,
    pub(crate) constant: T,
    pub(crate) factors: Part,
    pub(crate) terms: Part,
}

/// Computation of the orders above 0 of a row.
pub(crate) struct Finish<T> {
    pub(crate) scale: T,
    pub(crate) order: OrderEffect,
    /// Index of the operation's inner sum; without products, of one that is 0.
    pub(crate) inner: u32,
    /// Number of terms of the operation.
    pub(crate) terms: u32,
    pub(crate) place: Place,
    /// Number of copies kept of the row.
    pub(crate) copies: u32,
}

/// Effect of the order n on an operation.
#[derive(Clone, Copy)]
pub(crate) enum OrderEffect {
    /// No effect.
    Free,
    /// Division of the inner sum by n.
    Divides,
}

/// Placement of rows and their copies in memory.
struct RowLayout {
    base: usize,
    copy_base: usize,
    stride: usize,
    backwards: bool,
    copies: Vec<SecondFactor>,
    /// Number of copies that are stored.
    stored: usize,
}

/// A second factor of products: weight · row.
struct SecondFactor {
    row: Row,
    weight: Rational,
    /// Place of the row times ± the weight.
    place: Place,
    negative: bool,
    is_stored: bool,
}

impl RowLayout {
    fn row(&self, row: Row) -> Place {
        (self.base + row * self.stride) as Place
    }

    fn find(&self, row: Row, weight: &Rational) -> Option<&SecondFactor> {
        self.copies.iter().find(|own| own.row == row && own.weight == *weight)
    }

    /// Makes weight · row a second factor. Rows that run forwards are their own copies, and have
    /// one copy for both signs of a weight.
    fn copy(&mut self, row: Row, weight: &Rational) -> SecondFactor {
        let of_sign = |negative, place| SecondFactor {
            row,
            weight: weight.clone(),
            place,
            negative,
            is_stored: false,
        };
        let opposite = -weight;
        if !self.backwards && (weight.is_one() || opposite.is_one()) {
            return of_sign(opposite.is_one(), self.row(row));
        }
        if !self.backwards
            && let Some(own) = self.find(row, &opposite)
        {
            return of_sign(!own.negative, own.place);
        }
        let place = (self.copy_base + self.stored * self.stride) as Place;
        self.stored += 1;
        SecondFactor { is_stored: true, ..of_sign(false, place) }
    }

    /// Writes c x y as one factor and c times the other, chosen so that few copies are needed.
    fn product(&mut self, weight: &Rational, x: Row, y: Row) -> Product {
        let (x, y) = if self.find(x, weight).is_some() { (y, x) } else { (x, y) };
        if self.find(y, weight).is_none() {
            let copy = self.copy(y, weight);
            self.copies.push(copy);
        }
        let (cy, negative) =
            self.find(y, weight).map_or((0, false), |own| (own.place, own.negative));
        Product { x: self.row(x), cy, negative }
    }
}

impl<T: SeriesNumber> BoundProgram<T> {
    /// Binds a program to memory that begins `aligned` numbers before the border of a cache line;
    /// also returns the length of memory needed.
    pub(crate) fn new(program: &TaylorProgram, order: usize, aligned: usize) -> (Self, usize) {
        let width = T::WIDTH;
        let stride = width + order.next_multiple_of(width);
        let copy_base = aligned + program.rows * stride;
        let backwards = width > 1;
        let (base, copies) = (aligned + width - 1, Vec::new());
        let mut layout = RowLayout { base, copy_base, stride, backwards, copies, stored: 0 };
        let mut products = Vec::new();
        for instruction in &program.instructions {
            let own = instruction.form.products.iter();
            products.extend(own.map(|(weight, x, y)| layout.product(weight, *x, *y)));
        }
        let mut code = Self {
            operations: Vec::new(),
            finishes: Vec::new(),
            counts: Vec::new(),
            products,
            factors: Vec::new(),
            terms: Vec::new(),
            thetas: Vec::new(),
            copies: Vec::new(),
            of_state: 0,
            state: Vec::new(),
            outputs: program.outputs.iter().map(|row| layout.row(*row)).collect(),
        };
        for (row, rate) in program.rates.iter().enumerate() {
            let copies = code.copies_of(&layout, row);
            code.state.push(Component { place: layout.row(row), rate: layout.row(*rate), copies });
        }
        code.of_state = code.copies.len();
        for instruction in &program.instructions {
            code.bind(&layout, instruction);
        }
        // Operations without products share an inner sum that stays 0.
        let none = code.counts.len() as u32;
        for (finish, instruction) in code.finishes.iter_mut().zip(&program.instructions) {
            if instruction.form.products.is_empty() {
                finish.inner = none;
            }
        }
        (code, copy_base + layout.stored * stride)
    }

    fn copies_of(&mut self, layout: &RowLayout, row: Row) -> u32 {
        let before = self.copies.len();
        for own in layout.copies.iter().filter(|own| own.row == row && own.is_stored) {
            self.copies.push(Copied { place: own.place, weight: T::rational(&own.weight) });
        }
        (self.copies.len() - before) as u32
    }

    fn bind(&mut self, layout: &RowLayout, instruction: &RowInstruction) {
        let at = |row: &Row| layout.row(*row);
        let (order, rule) = match &instruction.rule {
            Rule::Sum => (OrderEffect::Free, PlacedRule::Sum),
            Rule::Theta(_) => {
                self.thetas.push(self.terms.len() as u32);
                (OrderEffect::Free, PlacedRule::Theta)
            }
            Rule::Recip(x) => (OrderEffect::Free, PlacedRule::Recip(at(x))),
            Rule::Sqrt(x) => (OrderEffect::Free, PlacedRule::Sqrt(at(x))),
            Rule::Exp(x) => (OrderEffect::Divides, PlacedRule::Exp(at(x))),
            Rule::Ln(x) => (OrderEffect::Divides, PlacedRule::Ln(at(x))),
            Rule::Sin { x, cosine } => {
                (OrderEffect::Divides, PlacedRule::Sin { x: at(x), cosine: at(cosine) })
            }
            Rule::Cos { x, sine } => {
                (OrderEffect::Divides, PlacedRule::Cos { x: at(x), sine: at(sine) })
            }
            Rule::Atan { x, square } => {
                (OrderEffect::Divides, PlacedRule::Atan { x: at(x), square: at(square) })
            }
            Rule::Saturating { function, x, slope } => {
                let (function, x, slope) = (*function, at(x), at(slope));
                (OrderEffect::Divides, PlacedRule::Saturating { function, x, slope })
            }
            Rule::Sign(x) => (OrderEffect::Free, PlacedRule::Sign(at(x))),
            Rule::Void(x) => (OrderEffect::Free, PlacedRule::Void(at(x))),
            Rule::Near(x, reach) => (OrderEffect::Free, PlacedRule::Near(at(x), *reach)),
            // Enclosures alone have these; a number has no value there.
            Rule::Choice(_) | Rule::Bounded(..) => (OrderEffect::Free, PlacedRule::Sum),
            Rule::Power { x, exponent } => {
                let factor = T::rational(exponent);
                (
                    OrderEffect::Divides,
                    PlacedRule::Power { x: at(x), exponent: exponent.clone(), factor },
                )
            }
        };
        let (terms, factors) = match instruction.rule.argument() {
            None => self.bind_sum(layout, instruction),
            Some(x) => {
                self.terms.push(SlopeTerm { x: at(&x), slope: T::ZERO, fixed: T::ONE });
                ((self.terms.len() as u32 - 1, self.terms.len() as u32), (0, 0))
            }
        };
        let inner = self.counts.len() as u32;
        if !instruction.form.products.is_empty() {
            self.counts.push(instruction.form.products.len() as u32);
        }
        let none = match (&rule, &instruction.rule) {
            (PlacedRule::Sign(_), _) => T::ONE,
            (_, Rule::Choice(_) | Rule::Bounded(..)) => T::float(f64::NAN),
            _ => T::ZERO,
        };
        let constant = instruction.form.constant.as_ref().map_or(none, T::rational);
        self.operations.push(InitialOperation { rule, constant, factors, terms });
        let copies = self.copies_of(layout, instruction.out);
        self.finishes.push(Finish {
            scale: T::ONE,
            order,
            inner,
            terms: terms.1 - terms.0,
            place: layout.row(instruction.out),
            copies,
        });
    }

    /// Binds the rows of a sum, those computed last at the end, as they become available last.
    fn bind_sum(&mut self, layout: &RowLayout, instruction: &RowInstruction) -> (Part, Part) {
        let form = &instruction.form;
        let factors = form.products.iter().flat_map(|(_, x, y)| [*x, *y]);
        let mut rows: Vec<Row> = form.linear.iter().map(|(_, row)| *row).chain(factors).collect();
        rows.sort_unstable();
        rows.dedup();
        let (first, first_factor) = (self.terms.len() as u32, self.factors.len() as u32);
        for row in &rows {
            let own = form.linear.iter().find(|(_, x)| x == row);
            let fixed = own.map_or(T::ZERO, |(weight, _)| T::rational(weight));
            self.terms.push(SlopeTerm { x: layout.row(*row), slope: fixed, fixed });
        }
        let term = |row: &Row| first + rows.partition_point(|other| other < row) as u32;
        self.factors.extend(form.products.iter().map(|(weight, x, y)| SlopeFactor {
            x: term(x),
            y: term(y),
            weight: T::rational(weight),
        }));
        ((first, self.terms.len() as u32), (first_factor, self.factors.len() as u32))
    }
}
