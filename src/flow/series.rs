//! The Taylor coefficients of a motion at a state, by a program.

use super::number::{BLOCK, Number};
use super::program::{Program, Rule};
use crate::graph::{Work, with_widest_vectors};
use crate::number::Function;
use crate::number::rational::Rational;

/// Bytes of a cache line: order 1 of each row stands on its border.
const LINE: usize = 64;

/// A program over one kind of number with the memory to run it.
///
/// Each row is kept forwards, and those that are the second factor of a product backwards too, with
/// zeros behind order 1: a Cauchy product is then a plain dot product.
pub struct Series<T: Number> {
    order: usize,
    layout: Layout,
    operations: Vec<Operation<T>>,
    /// Groups of products, by operation.
    groups: Vec<Group<T>>,
    products: Vec<Product>,
    linear: Vec<(Weight<T>, usize)>,
    /// Where the rates and the further functions stand.
    rates: Vec<usize>,
    outputs: Vec<usize>,
    /// 1/n
    inverses: Vec<T>,
    /// The inner sum of each operation at the current order, before and after its parts are added.
    partial: Vec<T::Partial>,
    inner: Vec<T>,
    memory: Vec<T>,
}

/// Where rows stand in memory: offsets of order 0.
struct Layout {
    base: usize,
    stride: usize,
    backward_stride: usize,
    /// Where the backward rows begin, and the place of each row among them.
    backward_base: usize,
    backward: Vec<Option<usize>>,
    order: usize,
}

impl Layout {
    fn forward(&self, row: usize) -> usize {
        self.base + row * self.stride
    }

    /// Where order 0 would stand in a backward row; order k stands k places before it.
    fn backward(&self, row: usize) -> Option<usize> {
        let place = self.backward[row]?;
        Some(self.backward_base + place * self.backward_stride + self.order)
    }
}

/// A coefficient, the usual ones by name.
#[derive(Clone, Copy)]
enum Weight<T> {
    One,
    MinusOne,
    Other(T),
}

impl<T: Number> Weight<T> {
    fn new(value: &Rational) -> Self {
        match value.to_integer() {
            Some(1) => Weight::One,
            Some(-1) => Weight::MinusOne,
            _ => Weight::Other(T::rational(value)),
        }
    }

    /// sum + weight · x
    #[inline(always)]
    fn add(self, sum: T, x: T) -> T {
        match self {
            Weight::One => sum + x,
            Weight::MinusOne => sum - x,
            Weight::Other(weight) => sum + weight * x,
        }
    }
}

/// Products with one coefficient: the range of their list.
struct Group<T> {
    weight: Weight<T>,
    factor: T,
    first: u32,
    last: u32,
}

/// Offsets of both factors: order 0 forwards, and the second one backwards.
struct Product {
    a: usize,
    b: usize,
    b_backward: usize,
}

/// An instruction with offsets instead of rows.
struct Operation<T> {
    rule: Bound<T>,
    out: usize,
    out_backward: Option<usize>,
    constant: Option<T>,
    groups: (u32, u32),
    linear: (u32, u32),
    /// What does not change with the order: 1/x₀, or 1/2z₀.
    kept: T,
}

enum Bound<T> {
    Sum,
    Theta(usize),
    Recip(usize),
    Sqrt(usize),
    Exp { x: usize, theta: usize },
    Ln { x: usize },
    Sin { x: usize, theta: usize, cosine: usize },
    Cos { x: usize, theta: usize, sine: usize },
    Atan { x: usize, square: usize },
    Power { x: usize, theta: usize, factor: T, exponent: Rational },
}

impl<T: Number> Series<T> {
    /// Prepares the program for expansions to this order.
    pub fn new(program: &Program, order: usize) -> Self {
        let (orders, width) = (order.next_multiple_of(T::WIDTH), T::WIDTH);
        let mut backward = vec![None; program.rows];
        let mut count = 0;
        let mut oriented = Vec::new();
        for instruction in &program.instructions {
            let turned = instruction.form.products.iter().map(|(weight, a, b)| {
                let (a, b) = if backward[*a].is_some() { (*b, *a) } else { (*a, *b) };
                if backward[b].is_none() {
                    backward[b] = Some(count);
                    count += 1;
                }
                (weight, a, b)
            });
            oriented.push(turned.collect::<Vec<_>>());
        }
        let (stride, backward_stride) = (width + orders, orders + width);
        let length = program.rows * stride + count * backward_stride;
        let zero = T::ZERO;
        let line = LINE / size_of::<T>().clamp(1, LINE);
        let memory = vec![zero; length + 2 * line];
        // Order 1 is on the border when order 0 is `width` - 1 places behind one.
        let aligned = memory.as_ptr().align_offset(LINE).min(line);
        let layout = Layout {
            base: aligned + width - 1,
            stride,
            backward_stride,
            backward_base: aligned + program.rows * stride,
            backward,
            order: orders,
        };
        let mut series = Self {
            order,
            operations: Vec::new(),
            groups: Vec::new(),
            products: Vec::new(),
            linear: Vec::new(),
            rates: program.rates.iter().map(|row| layout.forward(*row)).collect(),
            outputs: program.outputs.iter().map(|row| layout.forward(*row)).collect(),
            inverses: (0..=order)
                .map(|n| T::rational(&Rational::new(1, n.max(1) as i64)))
                .collect(),
            partial: vec![T::nothing(); program.instructions.len().next_multiple_of(BLOCK)],
            inner: vec![zero; program.instructions.len().next_multiple_of(BLOCK)],
            memory,
            layout,
        };
        for (instruction, products) in program.instructions.iter().zip(oriented) {
            series.lay_out(instruction, products);
        }
        series
    }

    fn lay_out(
        &mut self,
        instruction: &super::program::Instruction,
        mut products: Vec<(&Rational, usize, usize)>,
    ) {
        let layout = &self.layout;
        let first_group = self.groups.len() as u32;
        // Those without a coefficient first: their sum begins the others.
        products.sort_by(|x, y| (!x.0.is_one(), x.0).cmp(&(!y.0.is_one(), y.0)));
        for same in products.chunk_by(|x, y| x.0 == y.0) {
            let first = self.products.len() as u32;
            self.products.extend(same.iter().map(|(_, a, b)| Product {
                a: layout.forward(*a),
                b: layout.forward(*b),
                b_backward: layout.backward(*b).unwrap_or(layout.backward_base),
            }));
            self.groups.push(Group {
                weight: Weight::new(same[0].0),
                factor: T::rational(same[0].0),
                first,
                last: self.products.len() as u32,
            });
        }
        let first_linear = self.linear.len() as u32;
        let form = &instruction.form;
        let terms = form.linear.iter();
        self.linear.extend(terms.map(|(c, row)| (Weight::new(c), layout.forward(*row))));
        let at = |row: &usize| layout.forward(*row);
        let rule = match &instruction.rule {
            Rule::Sum => Bound::Sum,
            Rule::Theta(x) => Bound::Theta(at(x)),
            Rule::Recip(x) => Bound::Recip(at(x)),
            Rule::Sqrt(x) => Bound::Sqrt(at(x)),
            Rule::Exp { x, theta } => Bound::Exp { x: at(x), theta: at(theta) },
            Rule::Ln { x } => Bound::Ln { x: at(x) },
            Rule::Sin { x, theta, cosine } => {
                Bound::Sin { x: at(x), theta: at(theta), cosine: at(cosine) }
            }
            Rule::Cos { x, theta, sine } => {
                Bound::Cos { x: at(x), theta: at(theta), sine: at(sine) }
            }
            Rule::Atan { x, square } => Bound::Atan { x: at(x), square: at(square) },
            Rule::Power { x, theta, exponent } => Bound::Power {
                x: at(x),
                theta: at(theta),
                factor: T::rational(exponent),
                exponent: exponent.clone(),
            },
        };
        self.operations.push(Operation {
            rule,
            out: at(&instruction.out),
            out_backward: layout.backward(instruction.out),
            constant: form.constant.as_ref().map(T::rational),
            groups: (first_group, self.groups.len() as u32),
            linear: (first_linear, self.linear.len() as u32),
            kept: self.inverses[0],
        });
    }

    /// The highest order of the state's coefficients.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Computes all coefficients at `state`.
    pub fn expand(&mut self, state: &[T]) {
        for (row, value) in state.iter().enumerate() {
            let place = self.layout.forward(row);
            self.memory[place] = *value;
        }
        with_widest_vectors(Expansion(self));
    }

    /// The coefficients of a component of the state, orders 0 to `order`.
    #[inline(always)]
    pub fn component(&self, index: usize) -> &[T] {
        let place = self.layout.forward(index);
        &self.memory[place..=place + self.order]
    }

    /// The coefficients of a further function, orders 0 to `order` - 1.
    pub fn output(&self, index: usize) -> &[T] {
        let place = self.outputs[index];
        &self.memory[place..place + self.order]
    }
}

/// One expansion.
struct Expansion<'s, T: Number>(&'s mut Series<T>);

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
