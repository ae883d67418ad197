//! One expansion: the coefficients of all rows, order by order, in two phases each.
//!
//! The inner sums of all products need lower orders only, and are made first, as dot products; then
//! each row is finished in turn, from the same order of the rows before it.

use super::number::{BLOCK, Number};
use super::series::{Bound, Operation, Series, Weight};
use crate::graph::Work;
use crate::number::Function;

/// One expansion.
pub(super) struct Expansion<'s, T: Number>(pub(super) &'s mut Series<T>);

impl<T: Number> Work for Expansion<'_, T> {
    #[inline(always)]
    fn run(self) {
        let series = self.0;
        for n in 0..series.order {
            if n >= 2 {
                series.inner_sums(n);
            }
            series.finish(n);
            series.next_order(n);
        }
    }
}

impl<T: Number> Series<T> {
    /// Σ c x_k y_{n-k} from k = 1 to n - 1 for each operation; lower orders only.
    #[inline(always)]
    fn inner_sums(&mut self, n: usize) {
        // A length that is known when this is compiled makes the loops straight.
        match (n - 1).next_multiple_of(T::WIDTH) {
            8 if T::WIDTH == 8 => self.inner_sums_of(n, 8),
            16 if T::WIDTH == 8 => self.inner_sums_of(n, 16),
            24 if T::WIDTH == 8 => self.inner_sums_of(n, 24),
            length => self.inner_sums_of(n, length),
        }
    }

    #[inline(always)]
    fn inner_sums_of(&mut self, n: usize, length: usize) {
        for (inner, operation) in self.partial.iter_mut().zip(&self.operations) {
            let mut sum = T::nothing();
            for group in &self.groups[operation.groups.0 as usize..operation.groups.1 as usize] {
                let mut part = T::nothing();
                for product in &self.products[group.first as usize..group.last as usize] {
                    let x = &self.memory[product.a + 1..][..length];
                    let y = &self.memory[product.b_backward + 1 - n..][..length];
                    part = T::dot(part, x, y);
                }
                sum = match group.weight {
                    Weight::One => part,
                    _ => T::weigh(sum, group.factor, part),
                };
            }
            *inner = sum;
        }
        let (totals, _) = self.inner.as_chunks_mut::<BLOCK>();
        for (totals, parts) in totals.iter_mut().zip(self.partial.as_chunks::<BLOCK>().0) {
            T::totals(parts, totals);
        }
    }

    /// Order n of every row.
    #[inline(always)]
    fn finish(&mut self, n: usize) {
        for index in 0..self.operations.len() {
            let value = match n {
                0 => self.value(index),
                _ => self.coefficient(index, n),
            };
            let operation = &self.operations[index];
            self.memory[operation.out + n] = value;
            if let Some(place) = operation.out_backward
                && n > 0
            {
                self.memory[place - n] = value;
            }
        }
    }

    /// Order n + 1 of the state.
    #[inline(always)]
    fn next_order(&mut self, n: usize) {
        for row in 0..self.rates.len() {
            let value = self.memory[self.rates[row] + n] * self.inverses[n + 1];
            let place = self.layout.forward(row);
            self.memory[place + n + 1] = value;
            if let Some(place) = self.layout.backward(row) {
                self.memory[place - n - 1] = value;
            }
        }
    }

    /// Order 0 of an operation: the function itself.
    #[inline(always)]
    fn value(&mut self, index: usize) -> T {
        let operation = &mut self.operations[index];
        let memory = &self.memory;
        match &operation.rule {
            Bound::Sum => {
                let mut sum = operation.constant.unwrap_or(T::ZERO);
                for (weight, x) in &self.linear[operation.linear.0 as usize..][..operation.terms()]
                {
                    sum = weight.add(sum, memory[*x]);
                }
                for group in &self.groups[operation.groups.0 as usize..operation.groups.1 as usize]
                {
                    for product in &self.products[group.first as usize..group.last as usize] {
                        sum = group.weight.add(sum, memory[product.a] * memory[product.b]);
                    }
                }
                sum
            }
            Bound::Theta(_) => T::ZERO,
            Bound::Recip(x) => memory[*x].recip(),
            Bound::Sqrt(x) => {
                let root = memory[*x].apply(Function::Sqrt);
                operation.kept = (root + root).recip();
                root
            }
            Bound::Exp { x, .. } => memory[*x].apply(Function::Exp),
            Bound::Ln { x } => {
                operation.kept = memory[*x].recip();
                memory[*x].apply(Function::Ln)
            }
            Bound::Sin { x, .. } => memory[*x].apply(Function::Sin),
            Bound::Cos { x, .. } => memory[*x].apply(Function::Cos),
            Bound::Atan { x, square } => {
                operation.kept = memory[*square].recip();
                memory[*x].apply(Function::Atan)
            }
            Bound::Power { x, exponent, .. } => {
                operation.kept = memory[*x].recip();
                memory[*x].power(exponent)
            }
        }
    }

    /// Order n ≥ 1 of an operation.
    #[inline(always)]
    fn coefficient(&self, index: usize, n: usize) -> T {
        let operation = &self.operations[index];
        let memory = &self.memory;
        // At order 1 there is no inner sum.
        let inner = if n == 1 { T::ZERO } else { self.inner[index] };
        let by_n = self.inverses[n];
        match &operation.rule {
            Bound::Sum => {
                let mut sum = inner;
                for (weight, x) in &self.linear[operation.linear.0 as usize..][..operation.terms()]
                {
                    sum = weight.add(sum, memory[*x + n]);
                }
                for group in &self.groups[operation.groups.0 as usize..operation.groups.1 as usize]
                {
                    let mut outer = T::ZERO;
                    for product in &self.products[group.first as usize..group.last as usize] {
                        outer = outer
                            + (memory[product.a] * memory[product.b + n]
                                + memory[product.a + n] * memory[product.b]);
                    }
                    sum = group.weight.add(sum, outer);
                }
                sum
            }
            Bound::Theta(x) => T::float(n as f64) * memory[*x + n],
            Bound::Recip(x) => {
                let z = memory[operation.out];
                -(inner + memory[*x + n] * z) * z
            }
            Bound::Sqrt(x) => (memory[*x + n] - inner) * operation.kept,
            Bound::Exp { theta, .. } => (inner + memory[*theta + n] * memory[operation.out]) * by_n,
            Bound::Ln { x } | Bound::Atan { x, .. } => {
                (memory[*x + n] - inner * by_n) * operation.kept
            }
            Bound::Sin { theta, cosine: other, .. } => {
                (inner + memory[*theta + n] * memory[*other]) * by_n
            }
            Bound::Cos { theta, sine: other, .. } => {
                -(inner + memory[*theta + n] * memory[*other]) * by_n
            }
            Bound::Power { theta, factor, .. } => {
                let outer = *factor * memory[*theta + n] * memory[operation.out];
                (inner + outer) * by_n * operation.kept
            }
        }
    }
}

impl<T> Operation<T> {
    #[inline(always)]
    fn terms(&self) -> usize {
        (self.linear.1 - self.linear.0) as usize
    }
}
