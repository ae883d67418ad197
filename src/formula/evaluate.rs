//! Evaluation of a formula in one pass over its nodes.
//!
//! Values in ℝ³ are computed by the algebra written out for it; vectors and matrices of other sizes
//! by loops over their components.

use nalgebra::{Matrix3, Vector3};

use super::arena::{Arena, Constant, Function, NodeId, Operation};
use super::kind::Type;
use super::scope::Symbol;
use super::value::{Table, Value};
use super::{algebra, elementary, tables};
use crate::scalar::Scalar;

/// Values of the nodes already passed.
struct Values<T>(Vec<Value<T>>);

const TYPED: &str = "operand types are settled when a formula is read";

impl<T: Scalar> Values<T> {
    fn scalar(&self, node: NodeId) -> T {
        match &self.0[node] {
            Value::Scalar(value) => *value,
            _ => unreachable!("{TYPED}"),
        }
    }

    fn scalars(&self, nodes: &[NodeId]) -> Vec<T> {
        nodes.iter().map(|node| self.scalar(*node)).collect()
    }

    fn list(&self, node: NodeId) -> Vec<T> {
        self.0[node].components()
    }

    fn table(&self, node: NodeId) -> Table<T> {
        match &self.0[node] {
            Value::Table(table) => table.clone(),
            Value::Matrix(matrix) => Table::from_fn((3, 3), |i, j| matrix[(i, j)]),
            _ => unreachable!("{TYPED}"),
        }
    }

    fn entry(&self, node: NodeId, i: usize, j: usize) -> T {
        match &self.0[node] {
            Value::Table(table) => table[(i, j)],
            Value::Matrix(matrix) => matrix[(i, j)],
            _ => unreachable!("{TYPED}"),
        }
    }

    fn component(&self, node: NodeId, i: usize) -> T {
        match &self.0[node] {
            Value::List(list) => list[i],
            Value::Vector(vector) => vector[i],
            _ => unreachable!("{TYPED}"),
        }
    }

    fn zip(&self, a: NodeId, b: NodeId, f: impl Fn(T, T) -> T) -> Value<T> {
        let (a, b) = (&self.0[a], &self.0[b]);
        match (a, b) {
            (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(f(*a, *b)),
            (Value::Vector(a), Value::Vector(b)) => Value::Vector(a.zip_map(b, f)),
            (Value::Matrix(a), Value::Matrix(b)) => Value::Matrix(a.zip_map(b, f)),
            _ => {
                let mut others = b.components().into_iter();
                a.map(|x| f(x, others.next().expect(TYPED)))
            }
        }
    }
}

fn list<T: Scalar>(components: Vec<T>) -> Value<T> {
    match components[..] {
        [x, y, z] => Value::Vector(Vector3::new(x, y, z)),
        _ => Value::List(components.into()),
    }
}

fn table<T: Scalar>(entries: Table<T>) -> Value<T> {
    match (entries.rows(), entries.columns()) {
        (3, 3) => Value::Matrix(Matrix3::from_fn(|i, j| entries[(i, j)])),
        _ => Value::Table(entries),
    }
}

/// Evaluates every node once, looking up each symbol once.
///
/// # Panics
/// If `lookup` returns a value of another type than the scope declared for the symbol.
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
    steps(arena, &symbols)
}

/// Evaluates every node such that a value is defined exactly where all operations as written are.
pub(super) fn literal_values<T: Scalar>(
    arena: &Arena,
    lookup: &mut dyn FnMut(Symbol) -> Value<T>,
) -> Vec<Value<T>> {
    let symbols: Vec<Value<T>> = arena.symbols.iter().map(|(symbol, _)| lookup(*symbol)).collect();
    T::literally(|| steps(arena, &symbols))
}

fn steps<T: Scalar>(arena: &Arena, symbols: &[Value<T>]) -> Vec<Value<T>> {
    let mut values = Values(Vec::with_capacity(arena.nodes.len()));
    for node in &arena.nodes {
        let value = step(&node.operation, node.value_type, &values, symbols);
        values.0.push(value);
    }
    values.0
}

fn step<T: Scalar>(
    operation: &Operation,
    kind: Type,
    v: &Values<T>,
    symbols: &[Value<T>],
) -> Value<T> {
    use Value::{Matrix, Scalar, Vector};
    match operation {
        Operation::Number(value) => Scalar(T::rational(value)),
        Operation::Constant(Constant::Pi) => Scalar(elementary::pi()),
        Operation::Constant(Constant::Euler) => Scalar(T::one().exp()),
        Operation::Symbol(slot) => symbols[*slot].clone(),
        Operation::Identity => match kind {
            Type::Matrix(n, _) if n != 3 => table(tables::identity(n)),
            _ => Matrix(algebra::identity()),
        },
        Operation::Zero => Value::from_components(kind, &vec![T::zero(); kind.size()]),
        Operation::Negate(a) => v.0[*a].map(|x| -x),
        Operation::Add(a, b) => v.zip(*a, *b, |x, y| x + y),
        Operation::Subtract(a, b) => v.zip(*a, *b, |x, y| x - y),
        Operation::Multiply(a, b) => Scalar(v.scalar(*a) * v.scalar(*b)),
        Operation::Scale(a, b) => {
            let factor = v.scalar(*a);
            v.0[*b].map(|x| factor * x)
        }
        Operation::Divide(a, b) => {
            let divisor = v.scalar(*b);
            v.0[*a].map(|x| x / divisor)
        }
        Operation::Power(a, exponent) => {
            let x = v.scalar(*a);
            Scalar(match exponent.to_integer() {
                Some(1) => x,
                Some(2) => x * x,
                Some(3) => x * x * x,
                _ => x.power(exponent),
            })
        }
        Operation::PowerOf(a, b) => Scalar(v.scalar(*a).power_of(v.scalar(*b))),
        Operation::Component(a, i) => Scalar(v.component(*a, *i)),
        Operation::Entry(a, i, j) => Scalar(v.entry(*a, *i, *j)),
        Operation::Row(a, i) => list((0..kind.size()).map(|j| v.entry(*a, *i, j)).collect()),
        Operation::Vector(entries) => match entries[..] {
            [x, y, z] => Vector(Vector3::new(v.scalar(x), v.scalar(y), v.scalar(z))),
            _ => list(v.scalars(entries)),
        },
        Operation::Rows(rows) => {
            let entries: Vec<T> = rows.iter().flat_map(|row| v.list(*row)).collect();
            Value::from_components(kind, &entries)
        }
        Operation::Sum(terms) => sum(terms, v),
        Operation::Product(factors) => {
            let product = factors.iter().map(|a| v.scalar(*a)).reduce(|a, b| a * b);
            Scalar(product.unwrap_or_else(T::one))
        }
        Operation::Function(function, a) => Scalar(apply(*function, v.scalar(*a))),
        Operation::Angle(y, x) => Scalar(elementary::angle(v.scalar(*y), v.scalar(*x))),
        Operation::Extreme(which, all) => {
            let all = all.iter().map(|a| v.scalar(*a));
            Scalar(all.reduce(|a, b| elementary::extreme(*which, a, b)).expect(TYPED))
        }
        Operation::Antiderivative(f, x) => Scalar(T::antiderivative(v.scalar(*f), v.scalar(*x))),
        Operation::Partial { derivative, of, .. } => {
            // undefined where the function is
            let nothing = v.list(*of).into_iter().map(|x| T::zero() * x).reduce(|a, b| a + b);
            let nothing = nothing.unwrap_or_else(T::zero);
            v.0[*derivative].map(|x| x + nothing)
        }
        _ => in_space(operation, v).unwrap_or_else(|| of_any_size(operation, v)),
    }
}

/// Evaluates an operation of linear algebra if all its operands lie in ℝ³.
fn in_space<T: Scalar>(operation: &Operation, v: &Values<T>) -> Option<Value<T>> {
    use Value::{Matrix, Scalar, Vector};
    let vector = |node: &NodeId| match &v.0[*node] {
        Vector(vector) => Some(vector),
        _ => None,
    };
    let matrix = |node: &NodeId| match &v.0[*node] {
        Matrix(matrix) => Some(matrix),
        _ => None,
    };
    Some(match operation {
        Operation::Apply(a, b) => Vector(algebra::apply(matrix(a)?, vector(b)?)),
        Operation::Compose(a, b) => Matrix(algebra::compose(matrix(a)?, matrix(b)?)),
        Operation::Dot(a, b) => Scalar(algebra::dot(vector(a)?, vector(b)?)),
        Operation::Cross(a, b) => Vector(algebra::cross(vector(a)?, vector(b)?)),
        Operation::Outer(a, b) => Matrix(algebra::outer(vector(a)?, vector(b)?)),
        Operation::MatrixPower(a, n) => Matrix(algebra::power(matrix(a)?, *n)),
        Operation::Transpose(a) => Matrix(algebra::transpose(matrix(a)?)),
        Operation::Inverse(a) => Matrix(algebra::inverse(matrix(a)?)),
        Operation::Adjugate(a) => Matrix(algebra::adjugate(matrix(a)?)),
        Operation::Determinant(a) => Scalar(algebra::determinant(matrix(a)?)),
        Operation::Trace(a) => Scalar(algebra::trace(matrix(a)?)),
        Operation::Solve(a, b) => Vector(algebra::solve(matrix(a)?, vector(b)?)),
        Operation::Diagonal(a) => Matrix(algebra::diagonal(vector(a)?)),
        _ => return None,
    })
}

fn of_any_size<T: Scalar>(operation: &Operation, v: &Values<T>) -> Value<T> {
    use Value::Scalar;
    match operation {
        Operation::Apply(a, b) => list(tables::apply(&v.table(*a), &v.list(*b))),
        Operation::Compose(a, b) => table(tables::compose(&v.table(*a), &v.table(*b))),
        Operation::Dot(a, b) => Scalar(tables::dot(&v.list(*a), &v.list(*b))),
        Operation::Outer(a, b) => table(tables::outer(&v.list(*a), &v.list(*b))),
        Operation::MatrixPower(a, n) => table(tables::power(&v.table(*a), *n)),
        Operation::Transpose(a) => table(tables::transpose(&v.table(*a))),
        Operation::Inverse(a) => table(tables::inverse(&v.table(*a))),
        Operation::Adjugate(a) => table(tables::adjugate(&v.table(*a))),
        Operation::Determinant(a) => Scalar(tables::determinant(&v.table(*a))),
        Operation::Trace(a) => Scalar(tables::trace(&v.table(*a))),
        Operation::Solve(a, b) => list(tables::solve(&v.table(*a), &v.list(*b))),
        Operation::Diagonal(a) => table(tables::diagonal(&v.list(*a))),
        _ => unreachable!("{TYPED}"),
    }
}

/// Sum of values of one type.
fn sum<T: Scalar>(terms: &[NodeId], v: &Values<T>) -> Value<T> {
    let (first, rest) = terms.split_first().expect(TYPED);
    let mut total = v.0[*first].components();
    for term in rest {
        for (sum, x) in total.iter_mut().zip(v.0[*term].components()) {
            *sum += x;
        }
    }
    Value::from_components(v.0[*first].value_type(), &total)
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
