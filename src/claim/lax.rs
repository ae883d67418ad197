//! Lax pairs: L' = [L,A] = LA − AL for square matrices of any size.

use num_traits::{One, Zero};

use super::{Condition, Reader, ResidualContext, Statement, ValueShape, difference};
use crate::formula::{Formula, Type};
use crate::graph::Expr;
use crate::mechanics::Phase;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::dot;
use crate::scalar::Scalar;

/// Largest number of rows for which all powers of L are examined, and number of powers for more.
const FEW_ROWS: usize = 4;
const FEW_POWERS: usize = 2;

/// The claim L_vL = LA − AL.
#[derive(Clone, Debug)]
pub struct Lax {
    matrix: Formula,
    partner: Formula,
}

/// Computes AB, by rows, for matrices of n rows and columns.
fn product<T: Scalar>(a: &[T], b: &[T], n: usize) -> Vec<T> {
    let entry = |i: usize, j: usize| -> T { (0..n).map(|k| a[i * n + k] * b[k * n + j]).sum() };
    (0..n * n).map(|place| entry(place / n, place % n)).collect()
}

impl Lax {
    fn size(&self) -> usize {
        match self.matrix.value_type() {
            Type::Matrix(n, _) => n,
            other => unreachable!("a {} was refused when the claim was read", other.in_full()),
        }
    }

    /// Number of powers of L whose traces are examined.
    fn powers(&self) -> usize {
        if self.size() <= FEW_ROWS { self.size() } else { FEW_POWERS }
    }

    /// Computes tr(Lᵏ⁻¹ ∂L), 1/k of the gradient of tr Lᵏ, for k = 1, 2, …
    fn trace_slopes(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        let n = self.size();
        let matrix = jet.phase.evaluate(&self.matrix).components();
        let gradients = jet.gradients(&self.matrix);
        let axes = gradients.first().map_or(0, Vec::len);
        let mut slopes = Vec::new();
        let unit = |place: usize| if place / n == place % n { Expr::one() } else { Expr::zero() };
        let mut power: Vec<Expr> = (0..n * n).map(unit).collect();
        for _ in 0..self.powers() {
            slopes.extend((0..axes).map(|axis| -> Expr {
                (0..n * n)
                    .map(|place| power[place] * gradients[place % n * n + place / n][axis])
                    .sum()
            }));
            power = product(&power, &matrix, n);
        }
        slopes
    }

    /// Computes LA and AL.
    fn products<T: Scalar>(&self, phase: &Phase<'_, T>) -> (Vec<T>, Vec<T>) {
        let n = self.size();
        let [l, a] = [&self.matrix, &self.partner].map(|f| phase.evaluate(f).components());
        (product(&l, &a, n), product(&a, &l, n))
    }
}

impl Statement for Lax {
    const NAME: &'static str = "lax";
    const SHAPES: &'static [(&'static str, ValueShape)] = &[(Self::NAME, ValueShape::Table)];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let remedy = "write lax = { L = \"…\", A = \"…\" } for L' = L*A − A*L";
        let (mut matrix, mut partner) = (None, None);
        for (name, formula) in from.table(Self::NAME)? {
            match name.as_str() {
                "L" => matrix = Some(formula),
                "A" => partner = Some(formula),
                _ => {
                    let message = format!("a Lax pair consists of L and A, and has no `{name}`");
                    return Err(from.complaint(Self::NAME, message, remedy));
                }
            }
        }
        let (Some(matrix), Some(partner)) = (matrix, partner) else {
            let message = "a Lax pair takes both L and A".to_string();
            return Err(from.complaint(Self::NAME, message, remedy));
        };
        match (matrix.value_type(), partner.value_type()) {
            (Type::Matrix(rows, columns), other)
                if rows == columns && other == Type::Matrix(rows, columns) =>
            {
                Ok(Self { matrix, partner })
            }
            (l, a) => {
                let message = format!("L is a {}, and A a {}", l.in_full(), a.in_full());
                let remedy = "give square matrices of one size";
                Err(from.complaint(Self::NAME, message, remedy))
            }
        }
    }

    fn formulas(&self) -> Vec<&Formula> {
        vec![&self.partner, &self.matrix]
    }

    fn text(&self) -> Option<String> {
        let [l, a] = [&self.matrix, &self.partner].map(|formula| formula.text().trim());
        Some(format!("({l})' = [{l}, {a}]"))
    }

    fn about(&self, partner: Formula) -> Option<Self> {
        Some(Self { partner, ..self.clone() })
    }

    /// Requires an integral among tr L, tr L², …, as far as they are computed.
    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        let slopes = self.trace_slopes(jet);
        let most = self.powers();
        let otherwise = format!("tr Lᵏ is constant for k ≤ {most}: these are no integrals");
        let matrix = jet.phase.evaluate(&self.matrix).components();
        vec![Condition::nonzero(slopes, &otherwise), Condition::continuous(matrix, "L")]
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
        let (first, second) = self.products(&jet.phase);
        difference(jet.rates(&self.matrix), difference(first, second))
    }

    fn context(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> ResidualContext {
        let steepness: Expr = jet.gradients(&self.matrix).iter().map(|g| dot(g, g)).sum();
        let field = jet.phase.field();
        let (first, second) = self.products(&jet.phase);
        let sides = dot(&first, &first) + dot(&second, &second);
        ResidualContext {
            scale: Some(steepness * dot(field, field) + sides),
            value: jet.phase.evaluate(&self.matrix).components(),
            ..ResidualContext::default()
        }
    }
}
