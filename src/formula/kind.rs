//! Types of values: scalars, vectors and matrices of any size.

use std::fmt;

/// Limit on the components of a value.
pub const MAX_COMPONENTS: usize = 1024;

/// Type of the value of a name or a formula; known when the formula is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Type {
    /// A number.
    Scalar,
    /// Vector of this number of components.
    Vector(usize),
    /// Matrix with these numbers of rows and columns.
    Matrix(usize, usize),
}

/// Letters of a name behind which a digit would be misread.
fn ends_a_number(letter: char) -> bool {
    letter.is_ascii_digit() || letter == '\''
}

impl Type {
    /// Vectors of ℝ³.
    pub const VECTOR: Type = Type::Vector(3);
    /// Matrices of size 3×3.
    pub const MATRIX: Type = Type::Matrix(3, 3);

    /// Number of components of a value: 1, 3 and 9 for scalars, vectors and matrices of ℝ³.
    pub fn size(self) -> usize {
        match self {
            Type::Scalar => 1,
            Type::Vector(length) => length,
            Type::Matrix(rows, columns) => rows * columns,
        }
    }

    /// Name of the type with its size, also for those of ℝ³.
    pub fn in_full(self) -> String {
        match self {
            Type::Scalar => "scalar".to_string(),
            Type::Vector(length) => format!("vector of length {length}"),
            Type::Matrix(rows, columns) => format!("matrix of size {rows}×{columns}"),
        }
    }

    /// Whether the types are both vectors, or both matrices, of different sizes.
    pub(crate) fn differs_in_size(self, other: Type) -> bool {
        self != other && std::mem::discriminant(&self) == std::mem::discriminant(&other)
    }

    /// Notation for the component at `place` of a value called `name`: `γ3`, `L[2,12]`.
    pub fn component(self, name: &str, place: usize) -> String {
        match self {
            Type::Scalar => name.to_string(),
            // q11 would be read as the eleventh component of q by a human.
            Type::Vector(_) if place >= 99 || name.ends_with(ends_a_number) => {
                format!("{name}[{}]", place + 1)
            }
            Type::Vector(_) => format!("{name}{}", place + 1),
            Type::Matrix(_, columns) => {
                format!("{name}[{},{}]", place / columns + 1, place % columns + 1)
            }
        }
    }

    /// Notation for a value with these components, between the brackets of lists and rows.
    pub fn listed(self, components: &[String], [open, between, close]: [&str; 3]) -> String {
        let list = |parts: &[String]| format!("{open}{}{close}", parts.join(between));
        match self {
            Type::Scalar => components.concat(),
            Type::Vector(_) => list(components),
            Type::Matrix(_, columns) => {
                let rows: Vec<String> = components.chunks(columns.max(1)).map(list).collect();
                list(&rows)
            }
        }
    }

    /// Notation for a value with these components, as `--set` reads it: a diagonal matrix by its diagonal.
    pub fn as_setting(self, components: &[String]) -> String {
        let is_zero = |text: &str| text.bytes().all(|byte| matches!(byte, b'0' | b'.' | b'-'));
        if let Type::Matrix(rows, columns) = self
            && rows == columns
            && rows > 1
            && components.len() == rows * columns
        {
            let is_diagonal = |place: usize| place.is_multiple_of(rows + 1);
            let others = components.iter().enumerate().filter(|(place, _)| !is_diagonal(*place));
            if others.map(|(_, text)| text).all(|text| is_zero(text)) {
                let diagonal: Vec<String> = components.iter().step_by(rows + 1).cloned().collect();
                return format!("[{}]", diagonal.join(", "));
            }
        }
        self.listed(components, ["[", ", ", "]"])
    }

    /// Indices of the components, from 1: none for a scalar.
    pub fn places(self) -> Vec<Vec<usize>> {
        match self {
            Type::Scalar => vec![Vec::new()],
            Type::Vector(length) => (1..=length).map(|i| vec![i]).collect(),
            Type::Matrix(rows, columns) => {
                (1..=rows).flat_map(|i| (1..=columns).map(move |j| vec![i, j])).collect()
            }
        }
    }

    /// Indices of the components, as they are written: none for a scalar, `[3]`, `[2,1]`.
    pub fn indices(self) -> Vec<String> {
        match self {
            Type::Scalar => vec![String::new()],
            Type::Vector(length) => (1..=length).map(|i| format!("[{i}]")).collect(),
            Type::Matrix(rows, columns) => {
                let pairs = (1..=rows).flat_map(|i| (1..=columns).map(move |j| (i, j)));
                pairs.map(|(i, j)| format!("[{i},{j}]")).collect()
            }
        }
    }
}

impl fmt::Display for Type {
    /// Writes the name of the type, with its size unless that is 3.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Type::VECTOR => out.write_str("vector"),
            Type::MATRIX => out.write_str("matrix"),
            other => out.write_str(&other.in_full()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_have_names_and_components() {
        assert_eq!(Type::MATRIX.to_string(), "matrix", "of ℝ³");
        assert_eq!(Type::Vector(4).to_string(), "vector of length 4", "with its length");
        assert_eq!(Type::Matrix(2, 3).to_string(), "matrix of size 2×3", "rows, columns");
        assert_eq!(Type::Vector(12).component("x", 11), "x12", "the last");
        assert_eq!(Type::Matrix(2, 3).component("A", 4), "A[2,2]", "row by row");
        let numbers: Vec<String> = (1..=4).map(|k| k.to_string()).collect();
        let listed = |kind: Type| kind.listed(&numbers, ["[", ",", "]"]);
        assert_eq!(listed(Type::Matrix(2, 2)), "[[1,2],[3,4]]", "by rows");
        assert_eq!(listed(Type::Vector(4)), "[1,2,3,4]", "a list");
        assert_eq!(Type::Matrix(2, 1).indices(), ["[1,1]", "[2,1]"], "as they are written");
        assert_eq!(Type::Matrix(2, 3).size(), 6, "entries");
    }
}
