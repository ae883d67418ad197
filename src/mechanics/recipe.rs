//! Construction of free parameter values from random draws.

use std::fmt;

use nalgebra::Matrix3;

use crate::formula::{Type, Value};
use crate::number::rational::Rational;
use crate::proof::Extent;
use crate::scalar::Scalar;

/// An open interval with exact ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Range {
    /// Lower end.
    pub low: Rational,
    /// Upper end, above the lower one.
    pub high: Rational,
}

impl Range {
    /// Makes the interval between two fractions `(numerator, denominator)`.
    pub fn between(low: (i64, i64), high: (i64, i64)) -> Self {
        Self { low: Rational::new(low.0, low.1), high: Rational::new(high.0, high.1) }
    }

    fn halved(&self) -> Self {
        let half = Rational::new(1, 2);
        Self { low: &self.low * &half, high: &self.high * &half }
    }
}

impl fmt::Display for Range {
    /// Prints the ends; those of many digits, such as π, as decimals of f64.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        const MANY: usize = 20;
        let end = |end: &Rational| match end.to_string() {
            long if long.len() > MANY => end.to_f64().0.to_string(),
            short => short,
        };
        write!(out, "{}..{}", end(&self.low), end(&self.high))
    }
}

/// The distribution of one random number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Draw {
    /// A number inside a range.
    Within(Range),
    /// A number of a list.
    OneOf(Vec<Rational>),
    /// A number inside a range that represents a whole line, because no range was declared.
    Of(NumberLine, Range),
    /// A sign, 1 or −1.
    Sign,
}

impl Draw {
    /// Returns the numbers that may be drawn, as one interval.
    pub fn extent(&self) -> Extent {
        match self {
            Draw::Within(range) => Extent::between(&range.low, &range.high),
            Draw::Of(NumberLine::Positive, _) => Extent::POSITIVE,
            Draw::Of(NumberLine::All | NumberLine::Directions, _) => Extent::ALL,
            Draw::OneOf(values) => match (values.iter().min(), values.iter().max()) {
                (Some(least), Some(most)) => Extent::between(least, most),
                _ => Extent::ALL,
            },
            Draw::Sign => Extent::SIGN,
        }
    }

    /// Returns the draw of one listed value, if one is given, or the same draw.
    pub fn fixed(&self, value: Option<&Rational>) -> Self {
        value.map_or_else(|| self.clone(), |value| Draw::OneOf(vec![value.clone()]))
    }

    /// Returns the range or the list as case files write it.
    fn text(&self) -> String {
        match self {
            Draw::Within(range) | Draw::Of(_, range) => range.to_string(),
            Draw::OneOf(values) => {
                let values: Vec<String> = values.iter().map(ToString::to_string).collect();
                format!("one of {}", values.join(", "))
            }
            Draw::Sign => "one of 1, -1".to_string(),
        }
    }

    /// Returns the value of a draw that has no other.
    pub fn only(&self) -> Option<Rational> {
        match self {
            Draw::OneOf(values) => match values.as_slice() {
                [value] => Some(value.clone()),
                _ => None,
            },
            _ => None,
        }
    }
}

/// The set of numbers that a range represents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberLine {
    /// All numbers.
    All,
    /// All numbers, as coordinates of directions or of points of a sphere: since all of them count,
    /// some are drawn outside of the range, which is -a..a, as a²/x for x inside it.
    Directions,
    /// All positive numbers.
    Positive,
}

/// The construction of a parameter's components from draws.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SamplerSpec {
    /// A scalar.
    Scalar(Draw),
    /// A vector of given length with independent components.
    Vector(usize, Draw),
    /// A matrix of given size with independent entries.
    Matrix(usize, usize, Draw),
    /// A symmetric matrix with independent entries on and above the diagonal.
    Symmetric(usize, Draw),
    /// A skew matrix with independent entries above the diagonal.
    Skew(usize, Draw),
    /// A diagonal matrix with independent entries.
    Diagonal(usize, Draw),
    /// A spherical tensor μE.
    Spherical(usize, Draw),
    /// Principal moments that satisfy the triangle inequalities.
    Inertia(Range),
    /// Principal moments that satisfy the triangle inequalities, with I₁ = I₂.
    AxisymmetricInertia(Range),
    /// An inertia tensor in general position: principal moments turned by a rotation.
    FullInertia(Range),
    /// A rotation matrix.
    Rotation,
    /// A scalar, the components of a vector, or the diagonal of a matrix, each within the same
    /// distance of a number.
    Around {
        /// Type of the value.
        kind: Type,
        /// Midpoints of the ranges.
        centres: Vec<Rational>,
        /// Half their length.
        half: Rational,
    },
}

impl SamplerSpec {
    /// Returns the values within a distance of a fixed one: a scalar, a vector, or a diagonal
    /// matrix, given by its components.
    pub fn around(kind: Type, components: &[Rational], half: &Rational) -> Option<Self> {
        let centres = match kind {
            Type::Scalar | Type::Vector(_) => components.to_vec(),
            Type::Matrix(rows, columns) => {
                let is_off = |place: usize| place % columns != place / columns;
                let rests = components.iter().enumerate().filter(|(place, _)| is_off(*place));
                if rows != columns || !rests.into_iter().all(|(_, entry)| entry.is_zero()) {
                    return None;
                }
                components.iter().step_by(columns + 1).cloned().collect()
            }
        };
        Some(SamplerSpec::Around { kind, centres, half: half.clone() })
    }

    /// Returns the type of the value.
    pub fn kind(&self) -> Type {
        match self {
            SamplerSpec::Scalar(_) => Type::Scalar,
            SamplerSpec::Vector(length, _) => Type::Vector(*length),
            SamplerSpec::Around { kind, .. } => *kind,
            SamplerSpec::Matrix(rows, columns, _) => Type::Matrix(*rows, *columns),
            SamplerSpec::Symmetric(rows, _)
            | SamplerSpec::Skew(rows, _)
            | SamplerSpec::Diagonal(rows, _)
            | SamplerSpec::Spherical(rows, _) => Type::Matrix(*rows, *rows),
            _ => Type::MATRIX,
        }
    }

    /// Returns the value as case files write it.
    pub fn text(&self) -> String {
        let sized = |word: &str, sizes: &[usize], draw: &Draw| match sizes {
            [3] | [3, 3] => format!("{word}({})", draw.text()),
            sizes => {
                let sizes: Vec<String> = sizes.iter().map(usize::to_string).collect();
                format!("{word}({}, {})", sizes.join(", "), draw.text())
            }
        };
        let ranged = |word: &str, range: &Range| format!("{word}({range})");
        match self {
            SamplerSpec::Scalar(draw) => draw.text(),
            SamplerSpec::Vector(length, draw) => sized("vector", &[*length], draw),
            SamplerSpec::Matrix(rows, columns, draw) => sized("matrix", &[*rows, *columns], draw),
            SamplerSpec::Symmetric(rows, draw) => sized("symmetric", &[*rows], draw),
            SamplerSpec::Skew(rows, draw) => sized("skew", &[*rows], draw),
            SamplerSpec::Diagonal(rows, draw) => sized("diag", &[*rows], draw),
            SamplerSpec::Spherical(rows, draw) => sized("spherical", &[*rows], draw),
            SamplerSpec::Inertia(range) => ranged("inertia", range),
            SamplerSpec::AxisymmetricInertia(range) => ranged("axisymmetric", range),
            SamplerSpec::FullInertia(range) => ranged("full", range),
            SamplerSpec::Rotation => "rotation".to_string(),
            SamplerSpec::Around { centres, half, .. } => {
                let centres: Vec<String> = centres.iter().map(ToString::to_string).collect();
                format!("{} ± {half}", centres.join(", "))
            }
        }
    }

    /// Returns the draws that are needed, in order.
    pub fn draws(&self) -> Vec<Draw> {
        // Moments are sums of two of three positive numbers: I₁ = p₂ + p₃ and so on.
        let halves = |range: &Range, count| vec![Draw::Within(range.halved()); count];
        match self {
            SamplerSpec::Scalar(draw) | SamplerSpec::Spherical(_, draw) => vec![draw.clone()],
            SamplerSpec::Vector(count, draw) | SamplerSpec::Diagonal(count, draw) => {
                vec![draw.clone(); *count]
            }
            SamplerSpec::Matrix(rows, columns, draw) => vec![draw.clone(); rows * columns],
            SamplerSpec::Symmetric(rows, draw) => vec![draw.clone(); rows * (rows + 1) / 2],
            SamplerSpec::Skew(rows, draw) => vec![draw.clone(); rows * (rows - 1) / 2],
            SamplerSpec::Inertia(range) => halves(range, 3),
            SamplerSpec::AxisymmetricInertia(range) => halves(range, 2),
            SamplerSpec::FullInertia(range) => [halves(range, 3), rotation_draws()].concat(),
            SamplerSpec::Rotation => rotation_draws(),
            SamplerSpec::Around { centres, half, .. } => {
                let range = |centre: &Rational| Range { low: centre - half, high: centre + half };
                centres.iter().map(|centre| Draw::Within(range(centre))).collect()
            }
        }
    }

    /// Makes the value from the drawn numbers.
    pub fn make<T: Scalar>(&self, draws: &[T]) -> Value<T> {
        let principal = |p: [T; 3]| diagonal([p[1] + p[2], p[0] + p[2], p[0] + p[1]]);
        match (self, draws) {
            (SamplerSpec::Inertia(_), [x, y, z, ..]) => Value::Matrix(principal([*x, *y, *z])),
            (SamplerSpec::AxisymmetricInertia(_), [x, z, ..]) => {
                Value::Matrix(principal([*x, *x, *z]))
            }
            (SamplerSpec::FullInertia(_), [x, y, z, turn @ ..]) => {
                let turn = rotation(turn);
                Value::Matrix(turn * principal([*x, *y, *z]) * turn.transpose())
            }
            (SamplerSpec::Rotation, turn) => Value::Matrix(rotation(turn)),
            (
                SamplerSpec::Scalar(_) | SamplerSpec::Vector(..) | SamplerSpec::Matrix(..),
                components,
            ) => Value::from_components(self.kind(), components),
            (SamplerSpec::Around { kind: Type::Matrix(rows, _), .. }, entries) => {
                self.by_entries(*rows, |i, j| if i == j { entries[i] } else { T::zero() })
            }
            (SamplerSpec::Around { kind, .. }, components) => {
                Value::from_components(*kind, components)
            }
            (SamplerSpec::Diagonal(rows, _), entries) => {
                self.by_entries(*rows, |i, j| if i == j { entries[i] } else { T::zero() })
            }
            (SamplerSpec::Spherical(rows, _), entries) => {
                self.by_entries(*rows, |i, j| if i == j { entries[0] } else { T::zero() })
            }
            (SamplerSpec::Symmetric(rows, _), entries) => self.by_entries(*rows, |i, j| {
                let (above, below) = (i.min(j), i.max(j));
                // the rows before this one have n, n - 1, … entries
                entries[above * rows - above * above.saturating_sub(1) / 2 + below - above]
            }),
            (SamplerSpec::Skew(rows, _), entries) => self.by_entries(*rows, |i, j| {
                let (above, below) = (i.min(j), i.max(j));
                if i == j {
                    return T::zero();
                }
                let entry = entries[above * (rows - 1) - above * above.saturating_sub(1) / 2
                    + (below - above - 1)];
                if i < j { entry } else { -entry }
            }),
            _ => unreachable!("a recipe is given as many numbers as it asks for"),
        }
    }

    fn by_entries<T: Scalar>(&self, rows: usize, entry: impl Fn(usize, usize) -> T) -> Value<T> {
        let places = (0..rows).flat_map(|i| (0..rows).map(move |j| (i, j)));
        let entries: Vec<T> = places.map(|(i, j)| entry(i, j)).collect();
        Value::from_components(self.kind(), &entries)
    }
}

fn rotation_draws() -> Vec<Draw> {
    vec![Draw::Of(NumberLine::Directions, Range::between((-9, 10), (9, 10))); 3]
}

fn diagonal<T: Scalar>(entries: [T; 3]) -> Matrix3<T> {
    Matrix3::from_diagonal(&entries.into())
}

/// Returns the rotation of the quaternion (1, a, b, c), rational in its components.
fn rotation<T: Scalar>(quaternion: &[T]) -> Matrix3<T> {
    let (a, b, c) = (quaternion[0], quaternion[1], quaternion[2]);
    let (one, two) = (T::one(), T::from(2.0));
    let length = one + a * a + b * b + c * c;
    Matrix3::new(
        one + a * a - b * b - c * c,
        two * (a * b - c),
        two * (a * c + b),
        two * (a * b + c),
        one - a * a + b * b - c * c,
        two * (b * c - a),
        two * (a * c - b),
        two * (b * c + a),
        one - a * a - b * b + c * c,
    )
    .map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotations_are_rotations() {
        let turn = rotation(&[0.3, -0.7, 0.2]);
        let error = (turn * turn.transpose() - Matrix3::identity()).abs().max();
        assert!(error < 1e-15, "orthogonal");
        let volume = turn.column(0).cross(&turn.column(1)).dot(&turn.column(2));
        assert!((volume - 1.0).abs() < 1e-15, "and proper");
    }

    #[test]
    fn matrices_are_filled_by_their_symmetry() {
        let draw = Draw::Within(Range::between((1, 1), (2, 1)));
        for rows in 1..6 {
            let symmetric = SamplerSpec::Symmetric(rows, draw.clone());
            let skew = SamplerSpec::Skew(rows, draw.clone());
            for (recipe, sign) in [(symmetric, 1.0), (skew, -1.0)] {
                let count = recipe.draws().len();
                let numbers: Vec<f64> = (1..=count).map(|k| k as f64).collect();
                let entries = recipe.make(&numbers).components();
                let at = |i: usize, j: usize| entries[i * rows + j];
                let pairs = (0..rows).flat_map(|i| (0..rows).map(move |j| (i, j)));
                assert!(pairs.clone().all(|(i, j)| at(i, j) == sign * at(j, i)), "{recipe:?}");
                let mut above: Vec<f64> =
                    pairs.filter(|(i, j)| i <= j).map(|(i, j)| at(i, j)).collect();
                above.retain(|x| *x != 0.0);
                assert_eq!(above, numbers, "each number has one place above the diagonal");
            }
        }
        let diagonal = SamplerSpec::Diagonal(4, draw).make(&[1.0, 2.0, 3.0, 4.0]);
        assert_eq!(diagonal.value_type(), Type::Matrix(4, 4), "of its size");
        assert_eq!(diagonal.components()[10], 3.0, "on the diagonal");
    }

    #[test]
    fn values_vary_about_their_centres() {
        let half = Rational::new(1, 10);
        let around = |kind, numbers: &[i64]| {
            let numbers: Vec<Rational> = numbers.iter().map(|n| Rational::new(*n, 1)).collect();
            SamplerSpec::around(kind, &numbers, &half)
        };
        let matrix = around(Type::Matrix(2, 2), &[3, 0, 0, 5]).expect("diagonal");
        let range = |low, high| Draw::Within(Range::between((low, 10), (high, 10)));
        assert_eq!(matrix.draws(), [range(29, 31), range(49, 51)], "the diagonal alone");
        let made = matrix.make(&[3.05, 4.95]).components();
        assert_eq!(made, [3.05, 0.0, 0.0, 4.95], "at its places");
        let vector = around(Type::Vector(2), &[1, 0]).expect("a vector");
        assert_eq!(vector.draws(), [range(9, 11), range(-1, 1)], "zeros vary too");
        assert!(around(Type::Matrix(2, 2), &[3, 1, 0, 5]).is_none(), "not diagonal");
    }

    #[test]
    fn moments_keep_the_triangle_inequalities() {
        let recipe = SamplerSpec::Inertia(Range::between((1, 2), (5, 1)));
        let Value::Matrix(inertia) = recipe.make(&[0.3, 2.4, 1.1]) else { unreachable!() };
        let [x, y, z] = [0, 1, 2].map(|k| inertia[(k, k)]);
        assert!(x < y + z && y < x + z && z < x + y, "a body can have these moments");
    }
}
