//! The value of a formula: one pass over its nodes.

use super::arena::{Arena, Constant, Function, NodeId, Operation};
use super::scope::Symbol;
use super::value::Value;
use super::{algebra, elementary};
use crate::scalar::Scalar;
use nalgebra::{Matrix3, Vector3};

/// The values of nodes already passed.
struct Values<T>(Vec<Value<T>>);

const TYPED: &str = "operand types are settled when a formula is read";

impl<T: Scalar> Values<T> {
    fn scalar(&self, node: NodeId) -> T {
        self.0[node].scalar().expect(TYPED)
    }

    fn vector(&self, node: NodeId) -> Vector3<T> {
        self.0[node].vector().expect(TYPED)
    }

    fn matrix(&self, node: NodeId) -> Matrix3<T> {
        self.0[node].matrix().expect(TYPED)
    }

    fn zip(&self, a: NodeId, b: NodeId, f: impl Fn(T, T) -> T) -> Value<T> {
        match (self.0[a], self.0[b]) {
            (Value::Vector(a), Value::Vector(b)) => Value::Vector(a.zip_map(&b, f)),
            (Value::Matrix(a), Value::Matrix(b)) => Value::Matrix(a.zip_map(&b, f)),
            _ => Value::Scalar(f(self.scalar(a), self.scalar(b))),
        }
    }
}

/// The value of every node, each computed once and each symbol looked up once.
///
/// # Panics
/// If `lookup` gives a value of another type than the scope declared for the symbol.
pub(super) fn values<T: Scalar>(
    arena: &Arena,
    lookup: &mut dyn FnMut(Symbol) -> Value<T>,
) -> Vec<Value<T>> {
    let symbol_value = |(symbol, declared): &_| {
        let value = lookup(*symbol);
        assert_eq!(value.value_type(), *declared, "{symbol:?} has the type the scope declared");
        value
    };
    let symbols: Vec<Value<T>> = arena.symbols.iter().map(symbol_value).collect();
    let mut values = Values(Vec::with_capacity(arena.nodes.len()));
    for node in &arena.nodes {
        let value = step(&node.operation, &values, &symbols);
        values.0.push(value);
    }
    values.0
}

fn step<T: Scalar>(operation: &Operation, v: &Values<T>, symbols: &[Value<T>]) -> Value<T> {
    use Value::{Matrix, Scalar, Vector};
    match operation {
        Operation::Number(value) => Scalar(T::rational(value)),
        Operation::Constant(Constant::Pi) => Scalar(elementary::pi()),
        Operation::Constant(Constant::Euler) => Scalar(T::one().exp()),
        Operation::Symbol(slot) => symbols[*slot],
        Operation::Identity => Matrix(algebra::identity()),
        Operation::Negate(a) => v.0[*a].map(|x| -x),
        Operation::Add(a, b) => v.zip(*a, *b, |x, y| x + y),
        Operation::Subtract(a, b) => v.zip(*a, *b, |x, y| x - y),
        Operation::Multiply(a, b) => Scalar(v.scalar(*a) * v.scalar(*b)),
        Operation::Scale(a, b) => {
            let factor = v.scalar(*a);
            v.0[*b].map(|x| factor * x)
        }
        Operation::Apply(a, b) => Vector(algebra::apply(&v.matrix(*a), &v.vector(*b))),
        Operation::Compose(a, b) => Matrix(algebra::compose(&v.matrix(*a), &v.matrix(*b))),
        Operation::Divide(a, b) => {
            let divisor = v.scalar(*b);
            v.0[*a].map(|x| x / divisor)
        }
        Operation::Dot(a, b) => Scalar(algebra::dot(&v.vector(*a), &v.vector(*b))),
        Operation::Cross(a, b) => Vector(algebra::cross(&v.vector(*a), &v.vector(*b))),
        Operation::Outer(a, b) => Matrix(algebra::outer(&v.vector(*a), &v.vector(*b))),
        Operation::Power(a, exponent) => {
            let x = v.scalar(*a);
            Scalar(match exponent.to_integer() {
                Some(0) => T::one(),
                Some(1) => x,
                Some(2) => x * x,
                Some(3) => x * x * x,
                _ => x.power(exponent),
            })
        }
        Operation::PowerOf(a, b) => Scalar(v.scalar(*a).power_of(v.scalar(*b))),
        Operation::MatrixPower(a, n) => Matrix(algebra::power(&v.matrix(*a), *n)),
        Operation::Component(a, i) => Scalar(v.vector(*a)[*i]),
        Operation::Entry(a, i, j) => Scalar(v.matrix(*a)[(*i, *j)]),
        Operation::Transpose(a) => Matrix(algebra::transpose(&v.matrix(*a))),
        Operation::Inverse(a) => Matrix(algebra::inverse(&v.matrix(*a))),
        Operation::Adjugate(a) => Matrix(algebra::adjugate(&v.matrix(*a))),
        Operation::Determinant(a) => Scalar(algebra::determinant(&v.matrix(*a))),
        Operation::Trace(a) => Scalar(algebra::trace(&v.matrix(*a))),
        Operation::Solve(a, b) => Vector(algebra::solve(&v.matrix(*a), &v.vector(*b))),
        Operation::Vector(entries) => Vector(Vector3::from(entries.map(|a| v.scalar(a)))),
        Operation::Rows(rows) => {
            let rows = rows.map(|a| v.vector(a));
            Matrix(Matrix3::from_fn(|i, j| rows[i][j]))
        }
        Operation::Diagonal(a) => Matrix(algebra::diagonal(&v.vector(*a))),
        Operation::Function(function, a) => Scalar(apply(*function, v.scalar(*a))),
        Operation::Angle(y, x) => Scalar(elementary::angle(v.scalar(*y), v.scalar(*x))),
        Operation::Extreme(which, all) => {
            let all = all.iter().map(|a| v.scalar(*a));
            Scalar(all.reduce(|a, b| elementary::extreme(*which, a, b)).expect(TYPED))
        }
        Operation::Antiderivative(f, x) => Scalar(T::antiderivative(v.scalar(*f), v.scalar(*x))),
    }
}

fn apply<T: Scalar>(function: Function, x: T) -> T {
    match function {
        Function::Sqrt => x.sqrt(),
        Function::Exp => x.exp(),
        Function::Ln => x.ln(),
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => x.tan(),
        Function::Asin => x.arcsine(),
        Function::Acos => elementary::arccosine(x),
        Function::Atan => x.atan(),
        Function::Sinh => x.sinh(),
        Function::Cosh => x.cosh(),
        Function::Tanh => x.tanh(),
        Function::Asinh => x.asinh(),
        Function::Acosh => x.acosh(),
        Function::Atanh => x.atanh(),
        Function::Modulus => x.modulus(),
        Function::Sign => x / x.modulus(),
    }
}
