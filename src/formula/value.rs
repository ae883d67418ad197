//! Values of formulas: scalars, vectors and matrices.

use std::rc::Rc;

use nalgebra::{ArrayStorage, Matrix3, Vector3};

use super::kind::Type;

/// A scalar, vector or matrix over the numbers `T`.
///
/// Vectors of three components and 3×3 matrices always use the variants for ℝ³. Copies of the others
/// share their components, since a formula may name a long vector many times.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<T> {
    /// A number.
    Scalar(T),
    /// A vector of ℝ³.
    Vector(Vector3<T>),
    /// A 3×3 matrix.
    Matrix(Matrix3<T>),
    /// A vector of another length.
    List(Rc<[T]>),
    /// A matrix of another size.
    Table(MatrixEntries<T>),
}

/// Entries of a matrix of any size, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixEntries<T> {
    rows: usize,
    columns: usize,
    entries: Rc<[T]>,
}

impl<T> MatrixEntries<T> {
    /// Builds a matrix of the given size entry by entry.
    pub(super) fn from_fn(
        (rows, columns): (usize, usize),
        mut entry: impl FnMut(usize, usize) -> T,
    ) -> Self {
        let places = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
        let entries = places.map(|(i, j)| entry(i, j)).collect();
        Self { rows, columns, entries }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Entries, row by row.
    pub fn entries(&self) -> &[T] {
        &self.entries
    }
}

impl<T> std::ops::Index<(usize, usize)> for MatrixEntries<T> {
    type Output = T;

    /// Entry in a row and a column, both counted from 0.
    fn index(&self, (row, column): (usize, usize)) -> &T {
        &self.entries[row * self.columns + column]
    }
}

impl<T> Value<T> {
    /// Type of the value.
    pub fn value_type(&self) -> Type {
        match self {
            Value::Scalar(_) => Type::Scalar,
            Value::Vector(_) => Type::VECTOR,
            Value::Matrix(_) => Type::MATRIX,
            Value::List(list) => Type::Vector(list.len()),
            Value::Table(table) => Type::Matrix(table.rows, table.columns),
        }
    }
}

impl<T: Copy> Value<T> {
    /// Number, if this is a scalar.
    pub fn scalar(&self) -> Option<T> {
        if let Value::Scalar(value) = self { Some(*value) } else { None }
    }

    /// Vector, if this is one of ℝ³.
    pub fn vector(&self) -> Option<Vector3<T>> {
        if let Value::Vector(value) = self { Some(*value) } else { None }
    }

    /// Matrix, if this is one of ℝ³.
    pub fn matrix(&self) -> Option<Matrix3<T>> {
        if let Value::Matrix(value) = self { Some(*value) } else { None }
    }

    /// Applies `f` to every component, in the order of [`components`].
    ///
    /// [`components`]: Value::components
    pub fn map<U>(&self, mut f: impl FnMut(T) -> U) -> Value<U> {
        match self {
            Value::Scalar(value) => Value::Scalar(f(*value)),
            Value::Vector(value) => Value::Vector(vector(value.data.0[0].map(f))),
            Value::Matrix(value) => Value::Matrix(matrix(rows(value).map(f))),
            Value::List(list) => Value::List(list.iter().map(|x| f(*x)).collect()),
            Value::Table(MatrixEntries { rows, columns, entries }) => {
                let entries = entries.iter().map(|x| f(*x)).collect();
                Value::Table(MatrixEntries { rows: *rows, columns: *columns, entries })
            }
        }
    }

    /// Components: one for a scalar, those of a vector in order, those of a matrix row by row.
    pub fn components(&self) -> Vec<T> {
        match self {
            Value::Scalar(value) => vec![*value],
            Value::Vector(value) => value.data.0[0].to_vec(),
            Value::Matrix(value) => rows(value).to_vec(),
            Value::List(list) => list.to_vec(),
            Value::Table(table) => table.entries.to_vec(),
        }
    }

    /// Builds a value from its components, the inverse of [`components`](Value::components).
    ///
    /// # Panics
    /// If there are fewer components than [`Type::size`].
    pub fn from_components(ty: Type, components: &[T]) -> Value<T> {
        let at = |i: usize| components[i];
        match ty {
            Type::Scalar => Value::Scalar(at(0)),
            Type::VECTOR => Value::Vector(vector(std::array::from_fn(at))),
            Type::MATRIX => Value::Matrix(matrix(std::array::from_fn(at))),
            Type::Vector(length) => Value::List(components[..length].into()),
            Type::Matrix(rows, columns) => {
                let entries = components[..rows * columns].into();
                Value::Table(MatrixEntries { rows, columns, entries })
            }
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
        let list = Value::from_components(Type::Vector(2), &[4, 5]);
        let table = Value::from_components(Type::Matrix(2, 3), &[1, 2, 3, 4, 5, 6]);
        let vector = Value::Vector(Vector3::new(1, 2, 3));
        for value in [Value::Scalar(4), vector, matrix, list, table] {
            let back = Value::from_components(value.value_type(), &value.components());
            assert_eq!(back, value, "from_components undoes components");
            assert_eq!(value.components().len(), value.value_type().size(), "size counts them");
        }
    }

    #[test]
    fn map_visits_the_components_in_order() {
        let matrix = Value::Matrix(Matrix3::new(1, 2, 3, 4, 5, 6, 7, 8, 9));
        let table = Value::Table(MatrixEntries::from_fn((2, 4), |i, j| (10 * i + j) as i32));
        for value in [matrix, table] {
            let mut seen = Vec::new();
            let doubled = value.map(|x| {
                seen.push(x);
                2 * x
            });
            assert_eq!(seen, value.components(), "the order of components");
            assert_eq!(doubled.components()[1], 2 * seen[1], "entries keep their place");
        }
    }

    #[test]
    fn values_open_only_as_what_they_are() {
        assert_eq!(Value::Scalar(1).vector(), None, "a scalar is no vector");
        assert_eq!(Value::Scalar(1).scalar(), Some(1), "but a scalar");
        let table = MatrixEntries::from_fn((2, 3), |i, j| 10 * i + j);
        assert_eq!((table.rows(), table.columns(), table[(1, 2)]), (2, 3, 12), "its last entry");
    }
}
