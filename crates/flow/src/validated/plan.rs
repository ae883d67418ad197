//! Taylor programs with enclosed coefficients, and the reciprocals that their tails need.

use crate::error::FlowError;
use crate::taylor::form::{BilinearForm, Row};
use crate::taylor::program::{Rule, TaylorProgram};

use super::enclosure::Enclosure;
use liouville::number::rational::Rational;

/// Largest number of terms of a sum, which the allowance for rounding in `tail` covers.
const MOST_TERMS: usize = 1000;

/// Rule of a row, as in the module on programs; `inverse` is a row of reciprocals.
#[derive(Clone, Debug)]
pub enum RowRule {
    /// constant + Σ c x + Σ c x y
    Sum(EnclosedSum),
    /// n x_n, which only rules of other programs read.
    Theta(Row),
    /// 1/x
    Recip(Row),
    /// x^q, with 1/x.
    Power {
        x: Row,
        inverse: Row,
        exponent: PowerExponent,
    },
    Exp(Row),
    /// ln x, with 1/x.
    Ln {
        x: Row,
        inverse: Row,
    },
    Sin {
        x: Row,
        cosine: Row,
    },
    Cos {
        x: Row,
        sine: Row,
    },
    /// atan x, with 1 + x² and its reciprocal.
    Atan {
        x: Row,
        square: Row,
        inverse: Row,
    },
    /// 1 where |x| is below half of the number all over a box, or else 0.
    Near(Row, f64),
    /// `close` where `near` is 1, or else `far`.
    Choice {
        near: Row,
        close: Row,
        far: Row,
    },
    /// A function Σ a_k x^k with Σ |a_k| R^k ≤ `bound`, R the `radius`.
    Bounded {
        x: Row,
        radius: f64,
        bound: f64,
    },
}

/// Exponent of a power.
#[derive(Clone, Debug)]
pub struct PowerExponent {
    /// Whether it is 1/2, and the power a root.
    pub is_root: bool,
    /// The number itself.
    pub exact: Rational,
    /// The number in an enclosure.
    pub value: Enclosure,
}

/// Sum of products with enclosed coefficients.
#[derive(Clone, Debug)]
pub struct EnclosedSum {
    pub constant: Option<Enclosure>,
    pub linear: Vec<(Enclosure, Row)>,
    pub products: Vec<(Enclosure, Row, Row)>,
    /// The same with exact coefficients.
    pub form: BilinearForm,
}

impl EnclosedSum {
    fn of(form: &BilinearForm) -> Self {
        let products = form.products.iter();
        Self {
            constant: form.constant.as_ref().map(Enclosure::of),
            linear: form.linear.iter().map(|(c, x)| (Enclosure::of(c), *x)).collect(),
            products: products.map(|(c, x, y)| (Enclosure::of(c), *x, *y)).collect(),
            form: form.clone(),
        }
    }
}

/// A program to be run over balls. Rows `0..dimension` are the state.
#[derive(Clone, Debug)]
pub struct Plan {
    pub dimension: usize,
    pub rows: usize,
    /// Operations with the rows that they make, arguments first.
    pub operations: Vec<(Row, RowRule)>,
    /// Rows of the rates of the state's components.
    pub rates: Vec<Row>,
}

impl Plan {
    /// Encloses the coefficients of a program whose constants were not rounded.
    pub fn new(program: &TaylorProgram) -> Result<Self, FlowError> {
        let mut plan = Self {
            dimension: program.dimension,
            rows: program.rows,
            operations: Vec::new(),
            rates: program.rates.clone(),
        };
        for instruction in &program.instructions {
            let operation = match &instruction.rule {
                Rule::Sum => {
                    if instruction.form.len() > MOST_TERMS {
                        return Err(FlowError::TooLong);
                    }
                    RowRule::Sum(EnclosedSum::of(&instruction.form))
                }
                Rule::Theta(x) => RowRule::Theta(*x),
                Rule::Recip(x) => RowRule::Recip(*x),
                Rule::Sign(_) | Rule::Void(_) | Rule::Saturating { .. } => {
                    return Err(FlowError::NotAnalytic);
                }
                Rule::Near(x, reach) => RowRule::Near(*x, *reach),
                Rule::Choice([near, close, far]) => {
                    RowRule::Choice { near: *near, close: *close, far: *far }
                }
                Rule::Bounded(x, [radius, bound]) => {
                    RowRule::Bounded { x: *x, radius: *radius, bound: *bound }
                }
                Rule::Sqrt(x) => {
                    let (exact, value) = (Rational::new(1, 2), Enclosure::exact(0.5));
                    let exponent = PowerExponent { is_root: true, exact, value };
                    RowRule::Power { x: *x, inverse: plan.inverse(*x), exponent }
                }
                Rule::Power { x, exponent } => {
                    let (exact, value) = (exponent.clone(), Enclosure::of(exponent));
                    let exponent = PowerExponent { is_root: false, exact, value };
                    RowRule::Power { x: *x, inverse: plan.inverse(*x), exponent }
                }
                Rule::Exp(x) => RowRule::Exp(*x),
                Rule::Ln(x) => RowRule::Ln { x: *x, inverse: plan.inverse(*x) },
                Rule::Sin { x, cosine } => RowRule::Sin { x: *x, cosine: *cosine },
                Rule::Cos { x, sine } => RowRule::Cos { x: *x, sine: *sine },
                Rule::Atan { x, square } => {
                    let inverse = plan.inverse(*square);
                    RowRule::Atan { x: *x, square: *square, inverse }
                }
            };
            plan.operations.push((instruction.out, operation));
        }
        Ok(plan)
    }

    /// Row of 1/x, made once.
    fn inverse(&mut self, x: Row) -> Row {
        let is_own = |(_, operation): &&(Row, RowRule)| matches!(operation, RowRule::Recip(own) if *own == x);
        if let Some((row, _)) = self.operations.iter().find(is_own) {
            return *row;
        }
        let row = self.rows;
        self.rows += 1;
        self.operations.push((row, RowRule::Recip(x)));
        row
    }
}
