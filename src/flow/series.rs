//! The Taylor coefficients of a motion at a state, by a program.

use super::expand::Expansion;
use super::number::{BLOCK, Number};
use super::program::{Program, Rule};
use crate::graph::with_widest_vectors;
use crate::number::rational::Rational;

/// Bytes of a cache line: order 1 of each row stands on its border.
const LINE: usize = 64;

/// A program over one kind of number with the memory to run it.
///
/// Each row is kept forwards, and those that are the second factor of a product backwards too, with
/// zeros behind order 1: a Cauchy product is then a plain dot product.
pub struct Series<T: Number> {
    pub(super) order: usize,
    pub(super) layout: Layout,
    pub(super) operations: Vec<Operation<T>>,
    /// Groups of products, by operation.
    pub(super) groups: Vec<Group<T>>,
    pub(super) products: Vec<Product>,
    pub(super) linear: Vec<(Weight<T>, usize)>,
    /// Where the rates and the further functions stand.
    pub(super) rates: Vec<usize>,
    pub(super) outputs: Vec<usize>,
    /// 1/n
    pub(super) inverses: Vec<T>,
    /// The inner sum of each operation at the current order, before and after its parts are added.
    pub(super) partial: Vec<T::Partial>,
    pub(super) inner: Vec<T>,
    pub(super) memory: Vec<T>,
}

/// Where rows stand in memory: offsets of order 0.
pub(super) struct Layout {
    base: usize,
    stride: usize,
    backward_stride: usize,
    /// Where the backward rows begin, and the place of each row among them.
    backward_base: usize,
    backward: Vec<Option<usize>>,
    order: usize,
}

impl Layout {
    pub(super) fn forward(&self, row: usize) -> usize {
        self.base + row * self.stride
    }

    /// Where order 0 would stand in a backward row; order k stands k places before it.
    pub(super) fn backward(&self, row: usize) -> Option<usize> {
        let place = self.backward[row]?;
        Some(self.backward_base + place * self.backward_stride + self.order)
    }
}

/// A coefficient, the usual ones by name.
#[derive(Clone, Copy)]
pub(super) enum Weight<T> {
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
    pub(super) fn add(self, sum: T, x: T) -> T {
        match self {
            Weight::One => sum + x,
            Weight::MinusOne => sum - x,
            Weight::Other(weight) => sum + weight * x,
        }
    }
}

/// Products with one coefficient: the range of their list.
pub(super) struct Group<T> {
    pub(super) weight: Weight<T>,
    pub(super) factor: T,
    pub(super) first: u32,
    pub(super) last: u32,
}

/// Offsets of both factors: order 0 forwards, and the second one backwards.
pub(super) struct Product {
    pub(super) a: usize,
    pub(super) b: usize,
    pub(super) b_backward: usize,
}

/// An instruction with offsets instead of rows.
pub(super) struct Operation<T> {
    pub(super) rule: Bound<T>,
    pub(super) out: usize,
    pub(super) out_backward: Option<usize>,
    pub(super) constant: Option<T>,
    pub(super) groups: (u32, u32),
    pub(super) linear: (u32, u32),
    /// What does not change with the order: 1/x₀, or 1/2z₀.
    pub(super) kept: T,
}

pub(super) enum Bound<T> {
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
