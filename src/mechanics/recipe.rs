//! How the value of a free parameter is made from random draws.

use nalgebra::Matrix3;

use super::linear::isotropic;
use crate::formula::{Type, Value};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// An open interval with exact ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Range {
    /// The lower end.
    pub low: Rational,
    /// The upper end, above the lower one.
    pub high: Rational,
}

impl Range {
    /// The interval between two fractions `(numerator, denominator)`.
    pub fn between(low: (i64, i64), high: (i64, i64)) -> Self {
        Self { low: Rational::new(low.0, low.1), high: Rational::new(high.0, high.1) }
    }

    fn halved(&self) -> Self {
        let half = Rational::new(1, 2);
        Self { low: &self.low * &half, high: &self.high * &half }
    }
}

/// One random number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Draw {
    /// From the inside of a range.
    Within(Range),
    /// One of a list.
    OneOf(Vec<Rational>),
    /// From the inside of a range that stands for more: nobody asked for this one.
    Of(Line, Range),
    /// 1 or −1.
    Sign,
}

impl Draw {
    /// The only number there is, if there is no other.
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

/// What a range stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// All numbers.
    All,
    /// All positive numbers.
    Positive,
}

/// How a parameter's components come from draws.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Recipe {
    /// A number.
    Scalar(Draw),
    /// A vector with independent components.
    Vector(Draw),
    /// A matrix with independent entries.
    Matrix(Draw),
    /// A matrix with independent positive entries on the diagonal.
    Diagonal(Draw),
    /// μE
    Spherical(Draw),
    /// Principal moments that keep the triangle inequalities.
    Inertia(Range),
    /// The same with I₁ = I₂.
    AxisymmetricInertia(Range),
    /// An inertia tensor in general position: principal moments turned by a rotation.
    FullInertia(Range),
    /// A rotation matrix.
    Rotation,
}

impl Recipe {
    /// What kind of value is made.
    pub fn kind(&self) -> Type {
        match self {
            Recipe::Scalar(_) => Type::Scalar,
            Recipe::Vector(_) => Type::Vector,
            _ => Type::Matrix,
        }
    }

    /// The random numbers that are needed, in order.
    pub fn draws(&self) -> Vec<Draw> {
        // Moments are sums of two of three positive numbers: I₁ = p₂ + p₃ and so on.
        let halves = |range: &Range, count| vec![Draw::Within(range.halved()); count];
        match self {
            Recipe::Scalar(draw) | Recipe::Spherical(draw) => vec![draw.clone()],
            Recipe::Vector(draw) | Recipe::Diagonal(draw) => vec![draw.clone(); 3],
            Recipe::Matrix(draw) => vec![draw.clone(); 9],
            Recipe::Inertia(range) => halves(range, 3),
            Recipe::AxisymmetricInertia(range) => halves(range, 2),
            Recipe::FullInertia(range) => [halves(range, 3), rotation_draws()].concat(),
            Recipe::Rotation => rotation_draws(),
        }
    }

    /// The value made from those numbers.
    pub fn make<T: Scalar>(&self, draws: &[T]) -> Value<T> {
        let principal = |p: [T; 3]| diagonal([p[1] + p[2], p[0] + p[2], p[0] + p[1]]);
        match (self, draws) {
            (Recipe::Scalar(_), [x, ..]) => Value::Scalar(*x),
            (Recipe::Vector(_), [x, y, z, ..]) => Value::Vector([*x, *y, *z].into()),
            (Recipe::Diagonal(_), [x, y, z, ..]) => Value::Matrix(diagonal([*x, *y, *z])),
            (Recipe::Matrix(_), entries) => Value::from_components(Type::Matrix, entries),
            (Recipe::Spherical(_), [x, ..]) => Value::Matrix(isotropic(*x)),
            (Recipe::Inertia(_), [x, y, z, ..]) => Value::Matrix(principal([*x, *y, *z])),
            (Recipe::AxisymmetricInertia(_), [x, z, ..]) => Value::Matrix(principal([*x, *x, *z])),
            (Recipe::FullInertia(_), [x, y, z, turn @ ..]) => {
                let turn = rotation(turn);
                Value::Matrix(turn * principal([*x, *y, *z]) * turn.transpose())
            }
            (Recipe::Rotation, turn) => Value::Matrix(rotation(turn)),
            _ => unreachable!("a recipe is given as many numbers as it asks for"),
        }
    }
}

fn rotation_draws() -> Vec<Draw> {
    vec![Draw::Of(Line::All, Range::between((-9, 10), (9, 10))); 3]
}

fn diagonal<T: Scalar>(entries: [T; 3]) -> Matrix3<T> {
    Matrix3::from_diagonal(&entries.into())
}

/// The rotation of the quaternion (1, a, b, c), rational in its components.
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
    fn moments_keep_the_triangle_inequalities() {
        let recipe = Recipe::Inertia(Range::between((1, 2), (5, 1)));
        let Value::Matrix(inertia) = recipe.make(&[0.3, 2.4, 1.1]) else { unreachable!() };
        let [x, y, z] = [0, 1, 2].map(|k| inertia[(k, k)]);
        assert!(x < y + z && y < x + z && z < x + y, "a body can have these moments");
    }
}
