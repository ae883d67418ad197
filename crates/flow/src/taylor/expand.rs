//! Expansion of a motion: the coefficients of all rows, order by order, in two phases each.
//!
//! The inner sums of all products need lower orders only, and are made first, as dot products; then
//! each row is finished in turn, from the same order of the rows before it. Where there are many
//! expansions, machine code does the same.

use crate::taylor::code::{
    BoundProgram, Copied, OrderEffect, Place, PlacedRule, first, part, part_mut,
};
use crate::taylor::number::{BLOCK, SeriesNumber};
use crate::taylor::series::Series;
use liouville::graph::Kernel;

/// Work of one expansion.
pub(crate) struct Expansion<'s, T: SeriesNumber>(pub(crate) &'s mut Series<T>);

impl<T: SeriesNumber> Kernel for Expansion<'_, T> {
    #[inline(always)]
    fn run(self) {
        let series = self.0;
        if T::by_machine(series) {
            return;
        }
        series.begin();
        series.inner.fill(T::ZERO);
        for n in 1..series.order {
            if n >= 2 {
                series.inner_sums(n);
            }
            series.finish(n);
            series.next_order(n);
        }
    }
}

impl<T: SeriesNumber> Series<T> {
    /// Computes order 0 of all rows and order 1 of the state, with the slopes.
    #[inline(always)]
    pub(crate) fn begin(&mut self) {
        self.code.values(&mut self.memory);
        self.code.slopes(&self.memory);
        self.next_order(0);
    }

    /// Computes Σ c x_k y_{n-k} from k = 1 to n - 1 for each operation, from lower orders only.
    #[inline(always)]
    fn inner_sums(&mut self, n: usize) {
        // A length known at compile time lets the loops be unrolled.
        match (n - 1).next_multiple_of(T::WIDTH) {
            8 if T::WIDTH == 8 => self.inner_sums_of(n, 8),
            16 if T::WIDTH == 8 => self.inner_sums_of(n, 16),
            24 if T::WIDTH == 8 => self.inner_sums_of(n, 24),
            length => self.inner_sums_of(n, length),
        }
    }

    #[inline(always)]
    fn inner_sums_of(&mut self, n: usize, length: usize) {
        let forwards = &self.memory[1..];
        let last = if T::WIDTH > 1 { n - 1 } else { 1 };
        let backwards = &self.memory[T::copied(self.orders, last)..];
        let mut rest = self.code.products.as_slice();
        for (count, partial) in self.code.counts.iter().zip(&mut self.partial) {
            let mut sum = T::nothing();
            for product in first(&mut rest, *count) {
                let x = &forwards[product.x as usize..][..length];
                let y = &backwards[product.cy as usize..][..length];
                sum = T::dot(sum, x, y, product.negative);
            }
            *partial = sum;
        }
        let (totals, _) = self.inner.as_chunks_mut::<BLOCK>();
        for (totals, parts) in totals.iter_mut().zip(self.partial.as_chunks::<BLOCK>().0) {
            T::totals(parts, totals);
        }
    }

    /// Computes order n ≥ 1 of every row.
    #[inline(always)]
    fn finish(&mut self, n: usize) {
        for theta in &self.code.thetas {
            self.code.terms[*theta as usize].slope = T::float(n as f64);
        }
        let mut terms = self.code.terms.as_slice();
        let mut copies = &self.code.copies[self.code.of_state..];
        let mut rows = Rows { memory: &mut self.memory, n, copied: T::copied(self.orders, n) };
        let by_n = self.inverses[n];
        for finish in &self.code.finishes {
            let mut value = finish.scale * self.inner[finish.inner as usize];
            if let OrderEffect::Divides = finish.order {
                value = value * by_n;
            }
            for term in first(&mut terms, finish.terms) {
                value = value.fused(term.slope, rows.at(term.x));
            }
            rows.put(finish.place, first(&mut copies, finish.copies), value.settled());
        }
    }

    /// Computes order n + 1 of the state.
    #[inline(always)]
    fn next_order(&mut self, n: usize) {
        let by_next = self.advances[n + 1];
        let mut copies = self.code.copies.as_slice();
        let copied = T::copied(self.orders, n + 1);
        for component in &self.code.state {
            let value = self.memory[component.rate as usize + n] * by_next;
            let mut rows = Rows { memory: &mut self.memory, n: n + 1, copied };
            rows.put(component.place, first(&mut copies, component.copies), value);
        }
    }
}

/// View of all rows at one order.
struct Rows<'m, T> {
    memory: &'m mut [T],
    n: usize,
    /// Distance of the order from the place of a copy.
    copied: usize,
}

impl<T: SeriesNumber> Rows<'_, T> {
    // Places are below the length of the memory, and so is n: their sum does not overflow.
    #[inline(always)]
    fn at(&self, place: Place) -> T {
        self.memory[(place as usize).wrapping_add(self.n)]
    }

    #[inline(always)]
    fn put(&mut self, place: Place, copies: &[Copied<T>], value: T) {
        self.memory[(place as usize).wrapping_add(self.n)] = value;
        for copy in copies {
            self.memory[(copy.place as usize).wrapping_add(self.copied)] = copy.weight * value;
        }
    }
}

impl<T: SeriesNumber> BoundProgram<T> {
    /// Computes the slopes and scales, which are the same at all orders.
    #[inline(always)]
    fn slopes(&mut self, memory: &[T]) {
        let at = |x: &Place| memory[*x as usize];
        for (operation, finish) in self.operations.iter().zip(&mut self.finishes) {
            let z = at(&finish.place);
            let (scale, slope) = match &operation.rule {
                PlacedRule::Sum => {
                    for term in part_mut(&mut self.terms, operation.terms) {
                        term.slope = term.fixed;
                    }
                    for factor in part(&self.factors, operation.factors) {
                        let (x, y) = (factor.x as usize, factor.y as usize);
                        let values = [x, y].map(|k| at(&self.terms[k].x));
                        for (term, other) in [(x, values[1]), (y, values[0])] {
                            let slope = &mut self.terms[term].slope;
                            *slope = slope.fused(factor.weight, other);
                        }
                    }
                    for term in part_mut(&mut self.terms, operation.terms) {
                        term.slope = term.slope.settled();
                    }
                    continue;
                }
                PlacedRule::Theta => (T::ZERO, T::ONE),
                PlacedRule::Recip(_) => (-z, -(z * z)),
                PlacedRule::Sqrt(_) => {
                    let half = (z + z).recip();
                    (-half, half)
                }
                PlacedRule::Exp(_) => (T::ONE, z),
                PlacedRule::Ln(x) => (-at(x).recip(), at(x).recip()),
                PlacedRule::Sin { cosine, .. } => (T::ONE, at(cosine)),
                PlacedRule::Cos { sine, .. } => (-T::ONE, -at(sine)),
                PlacedRule::Atan { square, .. } => (-at(square).recip(), at(square).recip()),
                PlacedRule::Saturating { function, slope, .. } => {
                    let factor = T::float(function.slope());
                    (factor, factor * at(slope))
                }
                PlacedRule::Sign(_) | PlacedRule::Near(..) | PlacedRule::Void(_) => {
                    (T::ZERO, T::ZERO)
                }
                PlacedRule::Power { x, factor, .. } => (at(x).recip(), *factor * z * at(x).recip()),
            };
            finish.scale = scale;
            self.terms[operation.terms.0 as usize].slope = slope;
        }
    }
}
