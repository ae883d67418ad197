//! Entries of parameters that are one quantity: J₁₂ and J₂₁ of a symmetric matrix vary together.

use super::model::{Model, Parameter, ParameterOrigin};
use super::recipe::SamplerSpec;
use crate::formula::Type;
use crate::number::rational::Rational;

/// An entry that varies with another, as its negative where the matrix is skew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TiedEntry {
    /// Place of the entry, row by row.
    pub component: usize,
    /// Whether it is the negative of the other.
    pub is_negative: bool,
}

/// Reason why an entry cannot vary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StiffEntry {
    /// It is 0 in all values: on the diagonal of a skew matrix, off that of a spherical tensor.
    Zero,
    /// Nine entries of a rotation are three quantities.
    Rotation,
}

/// Form of a square matrix that its declaration or its values give it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MatrixForm {
    Any,
    Symmetric,
    Skew,
    Spherical,
    /// Symmetric, with I₁ = I₂.
    Axisymmetric,
    Rotation,
}

impl Model {
    /// Returns the other entries of a parameter that are the same quantity as one of them.
    ///
    /// # Errors
    /// Where the entry cannot vary alone, nor together with others.
    pub fn tied(&self, parameter: usize, component: usize) -> Result<Vec<TiedEntry>, StiffEntry> {
        let own = &self.parameters[parameter];
        let Type::Matrix(rows, columns) = own.kind else { return Ok(Vec::new()) };
        let (i, j) = (component / columns, component % columns);
        let opposite = |is_negative| TiedEntry { component: columns * j + i, is_negative };
        let on_diagonal =
            |place: usize| TiedEntry { component: (columns + 1) * place, is_negative: false };
        match form(own) {
            MatrixForm::Any => Ok(Vec::new()),
            MatrixForm::Rotation => Err(StiffEntry::Rotation),
            MatrixForm::Skew if i == j => Err(StiffEntry::Zero),
            MatrixForm::Spherical if i != j => Err(StiffEntry::Zero),
            MatrixForm::Skew => Ok(vec![opposite(true)]),
            MatrixForm::Spherical => Ok((0..rows).filter(|k| *k != i).map(on_diagonal).collect()),
            MatrixForm::Axisymmetric if i == j => {
                Ok([1, 0].get(i).map(|other| on_diagonal(*other)).into_iter().collect())
            }
            MatrixForm::Symmetric | MatrixForm::Axisymmetric if i == j => Ok(Vec::new()),
            MatrixForm::Symmetric | MatrixForm::Axisymmetric => Ok(vec![opposite(false)]),
        }
    }
}

impl SamplerSpec {
    /// Places of two entries that are equal, or opposite, in all values of a declaration, and are
    /// not in these.
    pub fn unlike(&self, values: &[Rational]) -> Option<[(usize, usize); 2]> {
        let Type::Matrix(rows, columns) = self.kind() else { return None };
        let entry = |i: usize, j: usize| values.get(columns * i + j);
        let is_wrong = |i: usize, j: usize| match (declared(self), entry(i, j), entry(j, i)) {
            (MatrixForm::Any | MatrixForm::Rotation, ..) | (_, None, _) | (_, _, None) => false,
            (MatrixForm::Skew, Some(a), Some(b)) => !(a + b).is_zero(),
            (_, Some(a), Some(b)) => a != b,
        };
        let mut pairs = (0..rows).flat_map(|i| (i..columns).map(move |j| (i, j)));
        pairs.find(|(i, j)| is_wrong(*i, *j)).map(|(i, j)| [(i, j), (j, i)])
    }
}

fn form(parameter: &Parameter) -> MatrixForm {
    match (&parameter.origin, parameter.kind) {
        (ParameterOrigin::Free(recipe), _) => declared(recipe),
        (ParameterOrigin::Fixed(values), Type::Matrix(n, columns)) if n == columns => {
            let all = |holds: fn(&Rational, &Rational) -> bool| {
                let mut places = (0..n).flat_map(|i| (0..n).map(move |j| (n * i + j, n * j + i)));
                places.all(|(a, b)| holds(&values[a], &values[b]))
            };
            match () {
                () if all(|a, b| a == b) => MatrixForm::Symmetric,
                () if all(|a, b| (a + b).is_zero()) => MatrixForm::Skew,
                () => MatrixForm::Any,
            }
        }
        _ => MatrixForm::Any,
    }
}

fn declared(recipe: &SamplerSpec) -> MatrixForm {
    match recipe {
        SamplerSpec::Symmetric(..)
        | SamplerSpec::Diagonal(..)
        | SamplerSpec::Inertia(_)
        | SamplerSpec::FullInertia(_) => MatrixForm::Symmetric,
        SamplerSpec::Skew(..) => MatrixForm::Skew,
        SamplerSpec::Spherical(..) => MatrixForm::Spherical,
        SamplerSpec::AxisymmetricInertia(_) => MatrixForm::Axisymmetric,
        SamplerSpec::Rotation => MatrixForm::Rotation,
        SamplerSpec::Scalar(_)
        | SamplerSpec::Vector(..)
        | SamplerSpec::Matrix(..)
        | SamplerSpec::Around { .. } => MatrixForm::Any,
    }
}
