//! What a formula evaluates to: a scalar, a vector of ℝ³ or a 3×3 matrix.

use std::fmt;

use nalgebra::{ArrayStorage, Matrix3, Vector3};

/// The kind of value a name or a formula stands for; known when the formula is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Type {
    /// A number.
    Scalar,
    /// Three components.
    Vector,
    /// Three rows of three entries.
    Matrix,
}

impl Type {
    /// How many scalars make up a value of this type: 1, 3 or 9.
    pub fn size(self) -> usize {
        match self {
            Type::Scalar => 1,
            Type::Vector => 3,
            Type::Matrix => 9,
        }
    }
}

impl fmt::Display for Type {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Type::Scalar => "scalar",
            Type::Vector => "vector",
            Type::Matrix => "matrix",
        })
    }
}

/// A scalar, vector or matrix over the numbers `T`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<T> {
    /// A number.
    Scalar(T),
    /// A vector of ℝ³.
    Vector(Vector3<T>),
    /// A 3×3 matrix.
    Matrix(Matrix3<T>),
}

impl<T> Value<T> {
    /// Which kind of value this is.
    pub fn value_type(&self) -> Type {
        match self {
            Value::Scalar(_) => Type::Scalar,
            Value::Vector(_) => Type::Vector,
            Value::Matrix(_) => Type::Matrix,
        }
    }

    /// The number, if this is a scalar.
    pub fn scalar(self) -> Option<T> {
        if let Value::Scalar(value) = self { Some(value) } else { None }
    }

    /// The vector, if this is one.
    pub fn vector(self) -> Option<Vector3<T>> {
        if let Value::Vector(value) = self { Some(value) } else { None }
    }

    /// The matrix, if this is one.
    pub fn matrix(self) -> Option<Matrix3<T>> {
        if let Value::Matrix(value) = self { Some(value) } else { None }
    }
}

impl<T: Copy> Value<T> {
    /// The value with `f` applied to every component, in the order of [`components`].
    ///
    /// [`components`]: Value::components
    pub fn map<U>(&self, mut f: impl FnMut(T) -> U) -> Value<U> {
        match self {
            Value::Scalar(value) => Value::Scalar(f(*value)),
            Value::Vector(value) => Value::Vector(vector(value.data.0[0].map(f))),
            Value::Matrix(value) => Value::Matrix(matrix(rows(value).map(f))),
        }
    }

    /// The components: 1 for a scalar, 3 for a vector, 9 for a matrix in row-major order.
    pub fn components(&self) -> Vec<T> {
        match self {
            Value::Scalar(value) => vec![*value],
            Value::Vector(value) => value.data.0[0].to_vec(),
            Value::Matrix(value) => rows(value).to_vec(),
        }
    }

    /// The value with the given components, the inverse of [`components`](Value::components).
    ///
    /// # Panics
    /// If there are fewer components than [`Type::size`] asks for.
    pub fn from_components(ty: Type, components: &[T]) -> Value<T> {
        let at = |i: usize| components[i];
        match ty {
            Type::Scalar => Value::Scalar(at(0)),
            Type::Vector => Value::Vector(vector(std::array::from_fn(at))),
            Type::Matrix => Value::Matrix(matrix(std::array::from_fn(at))),
        }
    }
}

fn vector<T>(components: [T; 3]) -> Vector3<T> {
    Vector3::from_array_storage(ArrayStorage([components]))
}

fn matrix<T>([a, b, c, d, e, f, g, h, i]: [T; 9]) -> Matrix3<T> {
    // nalgebra stores columns, formulas are written in rows
    Matrix3::from_array_storage(ArrayStorage([[a, d, g], [b, e, h], [c, f, i]]))
}

fn rows<T: Copy>(matrix: &Matrix3<T>) -> [T; 9] {
    let columns = &matrix.data.0;
    std::array::from_fn(|i| columns[i % 3][i / 3])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_are_row_major_and_invert() {
        let matrix = Value::Matrix(Matrix3::new(1, 2, 3, 4, 5, 6, 7, 8, 9));
        assert_eq!(matrix.components(), [1, 2, 3, 4, 5, 6, 7, 8, 9], "row by row");
        for value in [Value::Scalar(4), Value::Vector(Vector3::new(1, 2, 3)), matrix] {
            let back = Value::from_components(value.value_type(), &value.components());
            assert_eq!(back, value, "from_components undoes components");
            assert_eq!(value.components().len(), value.value_type().size(), "size counts them");
        }
    }

    #[test]
    fn map_visits_the_components_in_order() {
        let matrix = Value::Matrix(Matrix3::new(1, 2, 3, 4, 5, 6, 7, 8, 9));
        let mut seen = Vec::new();
        let doubled = matrix.map(|x| {
            seen.push(x);
            2 * x
        });
        assert_eq!(seen, matrix.components(), "the order of components");
        assert_eq!(doubled.matrix().map(|m| m[(0, 1)]), Some(4), "entries keep their place");
    }

    #[test]
    fn values_open_only_as_what_they_are() {
        assert_eq!(Value::Scalar(1).vector(), None, "a scalar is no vector");
        assert_eq!(Value::Scalar(1).scalar(), Some(1), "but a scalar");
        assert_eq!(Type::Matrix.to_string(), "matrix", "types have names");
    }
}
