//! Derivatives of the functions of one scalar, and of the angle.

use super::super::arena::{ElementaryFunction, NodeId, NodeOperation};
use super::super::error::FormulaError;
use super::super::kind::Type;
use super::super::typing::Infix;
use super::{Slope, Slopes};
use crate::number::rational::Rational;

type Made = Result<NodeId, FormulaError>;

/// Derivative of `node` = f(a), where a' = `slope`.
pub(super) fn slope(
    own: &mut Slopes<'_, '_>,
    function: ElementaryFunction,
    node: NodeId,
    a: NodeId,
    slope: NodeId,
) -> Made {
    use ElementaryFunction::*;
    let half = Rational::new(-1, 2);
    let factor = match function {
        Sqrt => {
            let two = own.number(2).node;
            let below = own.times(two, node)?;
            return own.infix(Infix::Divide, slope, below);
        }
        Ln => return own.infix(Infix::Divide, slope, a),
        Exp => node,
        Sin => apply(own, Cos, a),
        Cos => {
            let sine = apply(own, Sin, a);
            own.negative(sine)
        }
        Tan => shifted_square(own, 1, Infix::Add, node)?,
        Sinh => apply(own, Cosh, a),
        Cosh => apply(own, Sinh, a),
        Tanh => shifted_square(own, 1, Infix::Subtract, node)?,
        Asin | Acos => {
            let below = shifted_square(own, 1, Infix::Subtract, a)?;
            let factor = own.power(below, &half)?;
            if function == Acos { own.negative(factor) } else { factor }
        }
        Asinh => {
            let below = shifted_square(own, 1, Infix::Add, a)?;
            own.power(below, &half)?
        }
        Acosh => {
            let below = shifted_square(own, -1, Infix::Add, a)?;
            own.power(below, &half)?
        }
        Atan | Atanh => {
            let sign = if function == Atan { Infix::Add } else { Infix::Subtract };
            let below = shifted_square(own, 1, sign, a)?;
            return own.infix(Infix::Divide, slope, below);
        }
        Modulus => own.infix(Infix::Divide, a, node)?,
        Sign => {
            let help = "write the derivative of the branch that you mean";
            return Err(own.refused("`sign` has no derivative where it jumps", help));
        }
    };
    own.times(factor, slope)
}

/// Derivative (x y' − y x')/(x² + y²) of the angle of (x, y).
pub(super) fn angle(own: &mut Slopes<'_, '_>, y: NodeId, x: NodeId) -> Slope {
    let (of_y, of_x) = (own.of(y)?, own.of(x)?);
    let first = of_y.map(|slope| own.times(x, slope)).transpose()?;
    let second = of_x.map(|slope| own.times(y, slope)).transpose()?;
    let above = match (first, second) {
        (None, None) => return Ok(None),
        (Some(first), None) => first,
        (None, Some(second)) => own.negative(second),
        (Some(first), Some(second)) => own.infix(Infix::Subtract, first, second)?,
    };
    let [xx, yy] = [own.times(x, x)?, own.times(y, y)?];
    let below = own.infix(Infix::Add, xx, yy)?;
    own.infix(Infix::Divide, above, below).map(Some)
}

fn apply(own: &mut Slopes<'_, '_>, function: ElementaryFunction, a: NodeId) -> NodeId {
    let span = own.span.clone();
    own.builder.push(NodeOperation::Function(function, a), Type::Scalar, span).node
}

/// The number plus or minus a².
fn shifted_square(own: &mut Slopes<'_, '_>, number: i64, sign: Infix, a: NodeId) -> Made {
    let square = own.times(a, a)?;
    let number = own.number(number).node;
    own.infix(sign, number, square)
}
