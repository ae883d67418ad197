//! Rebuilding of classes of proportional nodes up to constant factors.
//!
//! Of each class a multiple is computed, whichever takes no operation of its own, and its factor is
//! kept on the side: a product has the product of the factors. Only a sum of values with different
//! factors has to multiply one of them, and an output that is not computed as it is.
//!
//! ```text
//! I₁ + m(r₂² + r₃²) = m (r₂² + r₃² + I₁/m)        (m r₁)(m r₂) = m² r₁r₂
//! ```

use super::merge::Member;
use super::plan::Plan;
use super::{Expr, Fault, Graph, ONE, Step, record};
use crate::number::exact::square_root;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// A computed value with the factor by which it is to be multiplied.
#[derive(Clone, Debug)]
struct Scaled {
    value: Expr,
    factor: Rational,
}

/// Argument of a step.
enum Operand {
    Constant(Rational),
    Value(Scaled),
}

impl Scaled {
    /// Makes a value that needs no factor, with a negation taken out.
    fn of(value: Expr) -> Self {
        Self { value, factor: Rational::from(1) }.times(&Rational::from(1))
    }

    /// Multiplies by a constant, with a negation of the value taken out.
    fn times(self, by: &Rational) -> Self {
        let factor = &self.factor * by;
        match self.value.without_negation() {
            Some(value) => Self { value, factor: negated(&factor) },
            None => Self { value: self.value, factor },
        }
    }

    /// Returns the value with its factor.
    fn whole(&self) -> Expr {
        if self.factor == Rational::from(-1) {
            return -self.value;
        }
        Expr::rational(&self.factor) * self.value
    }
}

impl Operand {
    fn whole(&self) -> Expr {
        match self {
            Operand::Constant(value) => Expr::rational(value),
            Operand::Value(scaled) => scaled.whole(),
        }
    }
}

impl Graph {
    /// Rebuilds the outputs in a new graph from the classes in `order`, each computed once as the
    /// plan says; `None` where a value is missing.
    pub(super) fn rebuilt_scaled(
        &self,
        outputs: &[usize],
        members: &[Member],
        plan: &Plan,
        order: &[usize],
    ) -> Result<Option<(Graph, Vec<Expr>)>, Fault> {
        let (graph, values) = record(self.inputs(), |inputs| {
            let mut made: Vec<Option<Scaled>> = vec![None; self.len()];
            for class in order {
                let place = plan.made_by[*class]?;
                let operand = |place: usize| operand(place, members, &made);
                let mut scaled = repeated(&self.step(place), inputs, operand)?;
                if plan.is_whole[*class] {
                    scaled = Scaled::of(scaled.whole());
                }
                made[*class] = Some(scaled.times(&members[place].factor.recip()?));
            }
            let output = |place: &usize| Some(operand(*place, members, &made)?.whole());
            outputs.iter().map(output).collect::<Option<Vec<Expr>>>()
        })?;
        Ok(values.map(|values| (graph, values)))
    }
}

fn negated(factor: &Rational) -> Rational {
    factor * &Rational::from(-1)
}

fn operand(place: usize, members: &[Member], made: &[Option<Scaled>]) -> Option<Operand> {
    let Member { class, factor } = &members[place];
    if *class == ONE.0 as usize {
        return Some(Operand::Constant(factor.clone()));
    }
    Some(Operand::Value(made[*class].clone()?.times(factor)))
}

/// Repeats a step on scaled arguments.
fn repeated(
    step: &Step<'_>,
    inputs: &[Expr],
    operand: impl Fn(usize) -> Option<Operand>,
) -> Option<Scaled> {
    let repeated = || {
        let whole = |place: usize| Some(operand(place)?.whole());
        step.repeat(inputs, whole).map(Scaled::of)
    };
    match *step {
        Step::Unary(function, a) => match (function, operand(a)?) {
            (UnaryFunction::Neg, Operand::Value(x)) => Some(x.times(&Rational::from(-1))),
            (UnaryFunction::Recip, Operand::Value(x)) => {
                Some(Scaled::of(x.value.apply(function)).times(&x.factor.recip()?))
            }
            (UnaryFunction::Sqrt, Operand::Value(x)) => match square_root(&x.factor) {
                Some(root) => Some(Scaled::of(x.value.apply(function)).times(&root)),
                None => repeated(),
            },
            (UnaryFunction::Abs, Operand::Value(x)) => {
                Some(Scaled::of(x.value.apply(function)).times(&x.factor.abs()))
            }
            _ => repeated(),
        },
        Step::Binary(operation, a, b) => match (operation, operand(a)?, operand(b)?) {
            (BinaryOperation::Mul, Operand::Value(x), Operand::Value(y)) => {
                Some(Scaled::of(x.value * y.value).times(&(&x.factor * &y.factor)))
            }
            (BinaryOperation::Mul, Operand::Value(x), Operand::Constant(c))
            | (BinaryOperation::Mul, Operand::Constant(c), Operand::Value(x)) => Some(x.times(&c)),
            (BinaryOperation::Add, x, y) => sum(x, y),
            (BinaryOperation::Sub, x, Operand::Value(y)) => {
                sum(x, Operand::Value(y.times(&Rational::from(-1))))
            }
            (BinaryOperation::Sub, x, Operand::Constant(c)) => {
                sum(x, Operand::Constant(negated(&c)))
            }
            _ => repeated(),
        },
        Step::Constant(_) | Step::Input(_) | Step::Power(..) => repeated(),
    }
}

/// Adds two arguments, as a multiple of the first or of the one that is not constant.
fn sum(x: Operand, y: Operand) -> Option<Scaled> {
    let (x, y) = match (x, y) {
        (Operand::Value(x), Operand::Value(y)) => (x, y),
        (Operand::Value(x), Operand::Constant(c)) | (Operand::Constant(c), Operand::Value(x)) => {
            let shift = Expr::rational(&(&c * &x.factor.recip()?));
            return Some(Scaled::of(x.value + shift).times(&x.factor));
        }
        (Operand::Constant(a), Operand::Constant(b)) => {
            return Some(Scaled::of(Expr::rational(&(&a + &b))));
        }
    };
    let ratio = &y.factor * &x.factor.recip()?;
    let value = if ratio.is_one() {
        x.value + y.value
    } else if ratio == Rational::from(-1) {
        x.value - y.value
    } else {
        x.value + Expr::rational(&ratio) * y.value
    };
    Some(Scaled::of(value).times(&x.factor))
}
