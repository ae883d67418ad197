//! Evaluation of a formula in one pass over its nodes.
//!
//! Values in ℝ³ are computed by the algebra written out for it; vectors and matrices of other sizes
//! by loops over their components.

use nalgebra::{Matrix3, Vector3};

use super::arena::{Arena, Constant, ElementaryFunction, NodeId, NodeOperation};
use super::kind::Type;
use super::scope::Symbol;
use super::value::{MatrixEntries, Value};
use super::{algebra, elementary, tables};
use crate::number::rational::Rational;
use crate::scalar::{Function, Scalar};

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

    fn table(&self, node: NodeId) -> MatrixEntries<T> {
        match &self.0[node] {
            Value::Table(table) => table.clone(),
            Value::Matrix(matrix) => MatrixEntries::from_fn((3, 3), |i, j| matrix[(i, j)]),
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

fn table<T: Scalar>(entries: MatrixEntries<T>) -> Value<T> {
    match (entries.rows(), entries.columns()) {
        (3, 3) => Value::Matrix(Matrix3::from_fn(|i, j| entries[(i, j)])),
        _ => Value::Table(entries),
    }
}

/// Evaluates every node once, looking up each symbol once.
///
/// # Panics
/// If `lookup` returns a value of another type than the scope declared for the symbol.
#[inline(never)]
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
#[inline(never)]
pub(super) fn literal_values<T: Scalar>(
    arena: &Arena,
    lookup: &mut dyn FnMut(Symbol) -> Value<T>,
) -> Vec<Value<T>> {
    literal_values_with(arena, lookup, None)
}

/// Evaluates every node in this way; if powers are asked, it adds 0·ln X to each X^Y whose exponent, a node with this
/// value, asks for it, and 0·f to each ∫f.
#[inline(never)]
pub(super) fn literal_values_with<T: Scalar>(
    arena: &Arena,
    lookup: &mut dyn FnMut(Symbol) -> Value<T>,
    asks: Option<&dyn Fn(NodeId, T) -> bool>,
) -> Vec<Value<T>> {
    let symbols: Vec<Value<T>> = arena.symbols.iter().map(|(symbol, _)| lookup(*symbol)).collect();
    T::literally(|| {
        let mut values = Values(Vec::with_capacity(arena.nodes.len()));
        for node in &arena.nodes {
            let value = even_power(arena, &node.operation, &values)
                .unwrap_or_else(|| step(&node.operation, node.value_type, &values, &symbols));
            let value = match node.operation {
                NodeOperation::Component(a, _)
                | NodeOperation::Entry(a, ..)
                | NodeOperation::Row(a, _)
                    // A variable has all entries, and there may be many.
                    if !matches!(arena.nodes[a].operation, NodeOperation::Symbol(_)) =>
                {
                    with_others(value, &values.0[a])
                }
                NodeOperation::PowerOf(a, b) if asks.is_some_and(|asks| asks(b, values.scalar(b))) => {
                    let zero = T::zero() * values.scalar(a).ln();
                    value.map(|power| power + zero)
                }
                NodeOperation::Antiderivative(integrand, _) if asks.is_some() => {
                    let zero = T::zero() * values.scalar(integrand);
                    value.map(|integral| integral + zero)
                }
                _ => value,
            };
            values.0.push(value);
        }
        values.0
    })
}

/// A part of a list or table, with a value where all entries have one.
fn with_others<T: Scalar>(part: Value<T>, whole: &Value<T>) -> Value<T> {
    let others = whole.components().into_iter().map(|entry| T::zero() * entry);
    match others.reduce(|sum, entry| sum + entry) {
        Some(others) => part.map(|x| x + others),
        None => part,
    }
}

fn steps<T: Scalar>(arena: &Arena, symbols: &[Value<T>]) -> Vec<Value<T>> {
    let mut values = Values(Vec::with_capacity(arena.nodes.len()));
    for node in &arena.nodes {
        let value = even_power(arena, &node.operation, &values)
            .unwrap_or_else(|| step(&node.operation, node.value_type, &values, symbols));
        values.0.push(value);
    }
    values.0
}

/// An even power of a norm or a modulus, which is one of (v,v) or x² and takes no root: |v|² is smooth at v = 0,
/// unlike |v|.
fn even_power<T: Scalar>(
    arena: &Arena,
    operation: &NodeOperation,
    v: &Values<T>,
) -> Option<Value<T>> {
    let NodeOperation::Power(base, exponent) = operation else { return None };
    let half = exponent.to_integer().filter(|exponent| exponent % 2 == 0)? / 2;
    let square = match (&arena.nodes[*base].operation, arena.squared_norm(*base)) {
        (NodeOperation::Function(ElementaryFunction::Modulus, x), _) => v.scalar(*x) * v.scalar(*x),
        (_, Some(square)) => v.scalar(square),
        _ => return None,
    };
    Some(Value::Scalar(match half {
        1 => square,
        _ => square.power(&Rational::from(half)),
    }))
}

fn step<T: Scalar>(
    operation: &NodeOperation,
    kind: Type,
    v: &Values<T>,
    symbols: &[Value<T>],
) -> Value<T> {
    use Value::{Matrix, Scalar, Vector};
    match operation {
        NodeOperation::Number(value) => Scalar(T::rational(value)),
        NodeOperation::Constant(Constant::Pi) => Scalar(elementary::pi()),
        NodeOperation::Constant(Constant::Euler) => Scalar(T::one().exp()),
        NodeOperation::Symbol(slot) => symbols[*slot].clone(),
        NodeOperation::Identity => match kind {
            Type::Matrix(n, _) if n != 3 => table(tables::identity(n)),
            _ => Matrix(algebra::identity()),
        },
        NodeOperation::Zero => Value::from_components(kind, &vec![T::zero(); kind.size()]),
        NodeOperation::Negate(a) => v.0[*a].map(|x| -x),
        NodeOperation::Add(a, b) => v.zip(*a, *b, |x, y| x + y),
        NodeOperation::Subtract(a, b) => v.zip(*a, *b, |x, y| x - y),
        NodeOperation::Multiply(a, b) => Scalar(v.scalar(*a) * v.scalar(*b)),
        NodeOperation::Scale(a, b) => {
            let factor = v.scalar(*a);
            v.0[*b].map(|x| factor * x)
        }
        NodeOperation::Divide(a, b) => {
            let divisor = v.scalar(*b);
            v.0[*a].map(|x| x / divisor)
        }
        NodeOperation::Power(a, exponent) => {
            let x = v.scalar(*a);
            Scalar(match exponent.to_integer() {
                Some(1) => x,
                Some(2) => x * x,
                Some(3) => x * x * x,
                _ => x.power(exponent),
            })
        }
        NodeOperation::PowerOf(a, b) => Scalar(v.scalar(*a).power_of(v.scalar(*b))),
        NodeOperation::Component(a, i) => Scalar(v.component(*a, *i)),
        NodeOperation::Entry(a, i, j) => Scalar(v.entry(*a, *i, *j)),
        NodeOperation::Row(a, i) => list((0..kind.size()).map(|j| v.entry(*a, *i, j)).collect()),
        NodeOperation::Vector(entries) => match entries[..] {
            [x, y, z] => Vector(Vector3::new(v.scalar(x), v.scalar(y), v.scalar(z))),
            _ => list(v.scalars(entries)),
        },
        NodeOperation::Rows(rows) => {
            let entries: Vec<T> = rows.iter().flat_map(|row| v.list(*row)).collect();
            Value::from_components(kind, &entries)
        }
        NodeOperation::Sum(terms) => sum(terms, v),
        NodeOperation::Product(factors) => {
            let product = factors.iter().map(|a| v.scalar(*a)).reduce(|a, b| a * b);
            Scalar(product.unwrap_or_else(T::one))
        }
        NodeOperation::Function(function, a) => Scalar(v.scalar(*a).applied(function)),
        NodeOperation::Angle(y, x) => Scalar(elementary::angle(v.scalar(*y), v.scalar(*x))),
        NodeOperation::Extreme(which, all) => {
            let all = all.iter().map(|a| v.scalar(*a));
            Scalar(all.reduce(|a, b| elementary::extreme(*which, a, b)).expect(TYPED))
        }
        NodeOperation::Antiderivative(f, x) => {
            Scalar(T::antiderivative(v.scalar(*f), v.scalar(*x)))
        }
        NodeOperation::Partial { derivative, of, .. } => {
            // undefined where the function is
            let nothing = v.list(*of).into_iter().map(|x| T::zero() * x).reduce(|a, b| a + b);
            let nothing = nothing.unwrap_or_else(T::zero);
            v.0[*derivative].map(|x| x + nothing)
        }
        _ => in_space(operation, v).unwrap_or_else(|| of_any_size(operation, v)),
    }
}

/// Evaluates an operation of linear algebra if all its operands lie in ℝ³.
fn in_space<T: Scalar>(operation: &NodeOperation, v: &Values<T>) -> Option<Value<T>> {
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
        NodeOperation::Apply(a, b) => Vector(algebra::apply(matrix(a)?, vector(b)?)),
        NodeOperation::Compose(a, b) => Matrix(algebra::compose(matrix(a)?, matrix(b)?)),
        NodeOperation::Dot(a, b) => Scalar(algebra::dot(vector(a)?, vector(b)?)),
        NodeOperation::Cross(a, b) => Vector(algebra::cross(vector(a)?, vector(b)?)),
        NodeOperation::Outer(a, b) => Matrix(algebra::outer(vector(a)?, vector(b)?)),
        NodeOperation::MatrixPower(a, n) => Matrix(algebra::power(matrix(a)?, *n)),
        NodeOperation::Transpose(a) => Matrix(algebra::transpose(matrix(a)?)),
        NodeOperation::Inverse(a) => Matrix(algebra::inverse(matrix(a)?)),
        NodeOperation::Adjugate(a) => Matrix(algebra::adjugate(matrix(a)?)),
        NodeOperation::Determinant(a) => Scalar(algebra::determinant(matrix(a)?)),
        NodeOperation::Trace(a) => Scalar(algebra::trace(matrix(a)?)),
        NodeOperation::Solve(a, b) => Vector(algebra::solve(matrix(a)?, vector(b)?)),
        NodeOperation::Diagonal(a) => Matrix(algebra::diagonal(vector(a)?)),
        _ => return None,
    })
}

fn of_any_size<T: Scalar>(operation: &NodeOperation, v: &Values<T>) -> Value<T> {
    use Value::Scalar;
    match operation {
        NodeOperation::Apply(a, b) => list(tables::apply(&v.table(*a), &v.list(*b))),
        NodeOperation::Compose(a, b) => table(tables::compose(&v.table(*a), &v.table(*b))),
        NodeOperation::Dot(a, b) => Scalar(tables::dot(&v.list(*a), &v.list(*b))),
        NodeOperation::Outer(a, b) => table(tables::outer(&v.list(*a), &v.list(*b))),
        NodeOperation::MatrixPower(a, n) => table(tables::power(&v.table(*a), *n)),
        NodeOperation::Transpose(a) => table(tables::transpose(&v.table(*a))),
        NodeOperation::Inverse(a) => table(tables::inverse(&v.table(*a))),
        NodeOperation::Adjugate(a) => table(tables::adjugate(&v.table(*a))),
        NodeOperation::Determinant(a) => Scalar(tables::determinant(&v.table(*a))),
        NodeOperation::Trace(a) => Scalar(tables::trace(&v.table(*a))),
        NodeOperation::Solve(a, b) => list(tables::solve(&v.table(*a), &v.list(*b))),
        NodeOperation::Diagonal(a) => table(tables::diagonal(&v.list(*a))),
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

impl Function for ElementaryFunction {
    fn at<T: Scalar>(&self, x: T) -> T {
        match self {
            ElementaryFunction::Sqrt => x.sqrt(),
            ElementaryFunction::Exp => x.exp(),
            ElementaryFunction::Ln => x.ln(),
            ElementaryFunction::Sin => x.sin(),
            ElementaryFunction::Cos => x.cos(),
            ElementaryFunction::Tan => x.tan(),
            ElementaryFunction::Asin => x.arcsine(),
            ElementaryFunction::Acos => elementary::arccosine(x),
            ElementaryFunction::Atan => x.atan(),
            ElementaryFunction::Sinh => x.sinh(),
            ElementaryFunction::Cosh => x.cosh(),
            ElementaryFunction::Tanh => x.hyperbolic_tangent(),
            ElementaryFunction::Asinh => x.asinh(),
            ElementaryFunction::Acosh => x.acosh(),
            ElementaryFunction::Atanh => x.atanh(),
            ElementaryFunction::Modulus => x.modulus(),
            ElementaryFunction::Sign => x / x.modulus(),
        }
    }
}
