//! Taylor programs: rules that give the coefficients of order n from those of lower orders.
//!
//! With x = Σ x_k τ^k and θx = Σ k x_k τ^k, each instruction makes one row from others by the rule
//! (Σ from k = 1 to n - 1, n ≥ 1; order 0 is the function itself)
//!
//! ```text
//! z = Σ c x y   z_n = Σ c (x_0 y_n + x_n y_0 + Σ x_k y_{n-k})
//! z = 1/x       z_n = -z_0 (x_n z_0 + Σ x_k z_{n-k})
//! z = √x        z_n = (x_n - Σ z_k z_{n-k})/(2 z_0)
//! z = eˣ        n z_n = θx_n z_0 + Σ θx_k z_{n-k}
//! z = ln x      n x_0 z_n = n x_n - Σ θz_k x_{n-k}
//! z = sin x     n z_n = θx_n y_0 + Σ θx_k y_{n-k}, y = cos x; the same with -sin for cos
//! z = atan x    n y_0 z_n = n x_n - Σ θz_k y_{n-k}, y = 1 + x²
//! z = tanh x    n z_n = θx_n w_0 + Σ θx_k w_{n-k}, w = 1/cosh² x; the same with -2 z w for w
//! z = 1/(1+eˣ)  n z_n = -θx_n v_0 - Σ θx_k v_{n-k}, v = eˣ z²; the same with v - 2 v z for v
//! z = sign x    z_n = 0; |x| = z x
//! z = near x    z_n = 0; the same for void x
//! z = x^q       n x_0 z_n = q θx_n z_0 + Σ (q θx_k z_{n-k} - θz_k x_{n-k})
//! ```
//!
//! The inner sums need lower orders only, whatever the instruction: all are made first.

use std::sync::Arc;

use crate::taylor::form::{BilinearForm, Row};
use crate::taylor::level::Level;
use crate::taylor::saturating::Saturating;
use crate::taylor::watch::Presence;
use liouville::number::rational::Rational;

/// Last stage of an instruction, given the inner sum Σ c x_k y_{n-k} of its products.
#[derive(Clone, Debug)]
pub enum Rule {
    /// constant + Σ c x + Σ c x y
    Sum,
    /// n x_n
    Theta(Row),
    Recip(Row),
    Sqrt(Row),
    Exp(Row),
    Ln(Row),
    Sin {
        x: Row,
        cosine: Row,
    },
    Cos {
        x: Row,
        sine: Row,
    },
    Atan {
        x: Row,
        square: Row,
    },
    Power {
        x: Row,
        exponent: Rational,
    },
    /// A function that tends to constants, with the row of its slope up to a factor.
    Saturating {
        function: Saturating,
        x: Row,
        slope: Row,
    },
    /// ±1, the sign of x, over a step on which x is not 0.
    Sign(Row),
    /// 1 where |x| is below half of the number, and 0 elsewhere.
    Near(Row, f64),
    /// 1 where x is not positive, and 0 elsewhere.
    Void(Row),
    /// The second row where the first is 1, and the third where it is 0; in exact programs alone.
    Choice([Row; 3]),
    /// A function Σ a_k x^k of which it is known that Σ |a_k| R^k ≤ c, with R and c; in exact programs
    /// alone.
    Bounded(Row, [f64; 2]),
}

impl Rule {
    /// Row that the rule is a function of; `None` for a sum, which has several.
    pub(crate) fn argument(&self) -> Option<Row> {
        match self {
            Rule::Sum | Rule::Choice(_) => None,
            Rule::Bounded(x, _)
            | Rule::Theta(x)
            | Rule::Recip(x)
            | Rule::Sqrt(x)
            | Rule::Exp(x)
            | Rule::Ln(x)
            | Rule::Sign(x)
            | Rule::Void(x)
            | Rule::Near(x, _) => Some(*x),
            Rule::Sin { x, .. }
            | Rule::Cos { x, .. }
            | Rule::Atan { x, .. }
            | Rule::Saturating { x, .. }
            | Rule::Power { x, .. } => Some(*x),
        }
    }
}

/// Computation of one row.
#[derive(Clone, Debug)]
pub struct RowInstruction {
    pub rule: Rule,
    pub out: Row,
    /// Terms of a sum; for the other rules, the products of the inner sum.
    pub form: BilinearForm,
}

/// Field and further functions of the state, as instructions over rows of coefficients.
///
/// Rows `0..dimension` are the state; each instruction makes one further row.
#[derive(Clone, Debug)]
pub struct TaylorProgram {
    pub(crate) dimension: usize,
    pub(crate) rows: usize,
    pub(crate) instructions: Vec<RowInstruction>,
    /// Rows of the rates of the state's components.
    pub(crate) rates: Vec<Row>,
    /// Rows of the further functions.
    pub(crate) outputs: Vec<Row>,
    /// Whether the field jumps where a sign changes, as far as its form shows.
    pub(crate) jumps: bool,
    /// Level to which motions are kept, if the field alone does not.
    pub(crate) level: Option<Arc<Level>>,
    /// Values that a motion has to have, if they are known.
    pub(crate) presence: Option<Arc<Presence>>,
}

impl TaylorProgram {
    /// Number of components of the state.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The same field without further functions, and without the rows that only these need.
    pub(crate) fn without_outputs(&self) -> Self {
        let mut makers = vec![None; self.rows];
        for (index, instruction) in self.instructions.iter().enumerate() {
            makers[instruction.out] = Some(index);
        }
        let mut needed = vec![false; self.instructions.len()];
        let mut open = self.rates.clone();
        while let Some(row) = open.pop() {
            let Some(index) = makers[row].filter(|index| !needed[*index]) else { continue };
            needed[index] = true;
            let RowInstruction { rule, form, .. } = &self.instructions[index];
            open.extend(rule.argument());
            open.extend(form.linear.iter().map(|(_, x)| *x));
            open.extend(form.products.iter().flat_map(|(_, x, y)| [*x, *y]));
        }
        let kept = self.instructions.iter().zip(needed).filter(|(_, needed)| *needed);
        Self {
            instructions: kept.map(|(instruction, _)| instruction.clone()).collect(),
            outputs: Vec::new(),
            presence: None,
            ..self.clone()
        }
    }

    /// Largest degree of the sums of products, in the state and in what is no sum of products.
    pub(crate) fn degree(&self) -> usize {
        let mut degrees = vec![1usize; self.rows];
        for instruction in self.instructions.iter().filter(|own| matches!(own.rule, Rule::Sum)) {
            let form = &instruction.form;
            let linear = form.linear.iter().map(|(_, x)| degrees[*x]);
            let products = form.products.iter();
            let products = products.map(|(_, x, y)| degrees[*x].saturating_add(degrees[*y]));
            degrees[instruction.out] = linear.chain(products).max().unwrap_or(0);
        }
        degrees.into_iter().max().unwrap_or(0)
    }
}
