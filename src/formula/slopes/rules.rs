//! Rules for the operations of a formula.

use super::super::arena::{ElementaryFunction, NodeId, NodeOperation};
use super::super::error::FormulaError;
use super::super::kind::Type;
use super::super::typing::Infix;
use super::{Slope, Slopes, VariedPart, elementary};
use crate::number::rational::Rational;

impl Slopes<'_, '_> {
    pub(super) fn step(&mut self, node: NodeId) -> Slope {
        use NodeOperation::*;
        let (operation, kind) = {
            let own = &self.builder.arena.nodes[node];
            (own.operation.clone(), own.value_type)
        };
        match operation {
            Number(_) | Constant(_) | Identity | Zero => Ok(None),
            Symbol(slot) => self.symbol(self.builder.arena.symbols[slot].0),
            Partial { derivative, .. } => self.of(derivative),
            Negate(a) => Ok(self.of(a)?.map(|a| self.negative(a))),
            Add(a, b) => {
                let (a, b) = (self.of(a)?, self.of(b)?);
                self.sum(a, b)
            }
            Subtract(a, b) => match (self.of(a)?, self.of(b)?) {
                (Some(a), Some(b)) => self.infix(Infix::Subtract, a, b).map(Some),
                (a, b) => Ok(a.or_else(|| b.map(|b| self.negative(b)))),
            },
            Multiply(a, b) | Scale(a, b) | Apply(a, b) | Compose(a, b) => {
                self.bilinear(a, b, |own, a, b| own.times(a, b))
            }
            Cross(a, b) => self.bilinear(a, b, |own, a, b| own.infix(Infix::Cross, a, b)),
            Outer(a, b) => self.bilinear(a, b, |own, a, b| own.infix(Infix::Outer, a, b)),
            Dot(a, b) if a == b => {
                let Some(slope) = self.of(a)? else { return Ok(None) };
                let product = self.push(Dot(a, slope), kind);
                let two = self.number(2).node;
                self.times(two, product).map(Some)
            }
            Dot(a, b) => self.bilinear(a, b, |own, a, b| Ok(own.push(Dot(a, b), kind))),
            Divide(a, b) => self.quotient(node, a, b),
            Power(a, exponent) => {
                let (a, exponent) = self.without_norm(a, exponent);
                let Some(slope) = self.of(a)? else { return Ok(None) };
                let lower = self.power(a, &(&exponent - &Rational::from(1)))?;
                let factor = self.number(exponent).node;
                let factor = self.times(factor, lower)?;
                self.times(factor, slope).map(Some)
            }
            PowerOf(a, b) => self.power_of(node, a, b),
            MatrixPower(a, n) => self.matrix_power(a, n),
            Component(a, i) if self.is_variable(a) => Ok(self.unit(VariedPart::Component(i))),
            Entry(a, i, j) if self.is_variable(a) => Ok(self.unit(VariedPart::Entry(i, j))),
            Component(a, _) | Row(a, _) | Entry(a, ..) | Transpose(a) | Trace(a) | Diagonal(a) => {
                Ok(self.of(a)?.map(|slope| self.push(operation.on(|_| slope), kind)))
            }
            Inverse(a) => self.inverse(node, a),
            Determinant(a) => self.determinant(a),
            Adjugate(a) => self.adjugate(a, kind),
            Solve(a, b) => self.solution(node, a, b),
            Vector(parts) => self.parts(&parts, |parts| Vector(parts.into()), kind),
            Rows(rows) => self.parts(&rows, |rows| Rows(rows.into()), kind),
            Sum(terms) => {
                let slopes = terms.iter().map(|term| self.of(*term));
                let slopes: Vec<Option<NodeId>> = slopes.collect::<Result<_, _>>()?;
                let slopes: Vec<NodeId> = slopes.into_iter().flatten().collect();
                Ok(match slopes[..] {
                    [] => None,
                    [one] => Some(one),
                    _ => Some(self.push(Sum(slopes.into()), kind)),
                })
            }
            Product(factors) => self.product(&factors),
            Function(function, a) => match self.of(a)? {
                Some(slope) => elementary::slope(self, function, node, a, slope).map(Some),
                None => Ok(None),
            },
            Angle(y, x) => elementary::angle(self, y, x),
            Extreme(_, all) => {
                let name = "`min` and `max` have no derivative here";
                self.constant(&all, name, "write the derivative of the branch that you mean")
            }
            Antiderivative(f, x) => {
                let help = "write the integrand, or the function itself in place of `∫(f, x)`";
                self.constant(&[f, x], "an `∫` has no derivative here", help)
            }
        }
    }

    pub(super) fn unit(&mut self, part: VariedPart) -> Option<NodeId> {
        (part == self.part).then(|| self.number(1).node)
    }

    /// Zero if no operand depends on the variable, else the error.
    fn constant(&mut self, operands: &[NodeId], what: &str, help: &str) -> Slope {
        for operand in operands {
            if self.of(*operand)?.is_some() {
                return Err(self.refused(what, help));
            }
        }
        Ok(None)
    }

    fn bilinear(
        &mut self,
        a: NodeId,
        b: NodeId,
        product: impl Fn(&mut Self, NodeId, NodeId) -> Result<NodeId, FormulaError>,
    ) -> Slope {
        let left = match self.of(a)? {
            Some(slope) => Some(product(self, slope, b)?),
            None => None,
        };
        let right = match self.of(b)? {
            Some(slope) => Some(product(self, a, slope)?),
            None => None,
        };
        self.sum(left, right)
    }

    /// Base and exponent of a power without a root: those of (v,v)^(n/2) for |v|ⁿ with even n, and of xⁿ for |x|ⁿ,
    /// which have slopes at 0.
    fn without_norm(&self, base: NodeId, exponent: Rational) -> (NodeId, Rational) {
        if exponent.to_integer().is_none_or(|exponent| exponent % 2 != 0) {
            return (base, exponent);
        }
        let arena = &self.builder.arena;
        match (&arena.nodes[base].operation, arena.squared_norm(base)) {
            (NodeOperation::Function(ElementaryFunction::Modulus, x), _) => (*x, exponent),
            (_, Some(square)) => (square, &exponent * &Rational::new(1, 2)),
            _ => (base, exponent),
        }
    }

    /// (a/b)' = (a' − (a/b) b')/b.
    fn quotient(&mut self, node: NodeId, a: NodeId, b: NodeId) -> Slope {
        let above = match self.of(b)? {
            Some(slope) => {
                let pulled = self.times(node, slope)?;
                let pulled = self.negative(pulled);
                let slope = self.of(a)?;
                self.sum(slope, Some(pulled))?
            }
            None => self.of(a)?,
        };
        above.map(|above| self.infix(Infix::Divide, above, b)).transpose()
    }

    /// (aᵇ)' = b a^(b−1) a' + aᵇ ln(a) b'.
    fn power_of(&mut self, node: NodeId, a: NodeId, b: NodeId) -> Slope {
        let of_base = match self.of(a)? {
            Some(slope) => {
                let one = self.number(1).node;
                let lower = self.infix(Infix::Subtract, b, one)?;
                let power = self.push(NodeOperation::PowerOf(a, lower), Type::Scalar);
                let factor = self.times(b, power)?;
                Some(self.times(factor, slope)?)
            }
            None => None,
        };
        let of_exponent = match self.of(b)? {
            Some(slope) => {
                let logarithm =
                    self.push(NodeOperation::Function(ElementaryFunction::Ln, a), Type::Scalar);
                let factor = self.times(node, logarithm)?;
                Some(self.times(factor, slope)?)
            }
            None => None,
        };
        self.sum(of_base, of_exponent)
    }

    fn parts(
        &mut self,
        parts: &[NodeId],
        build: impl Fn(Vec<NodeId>) -> NodeOperation,
        kind: Type,
    ) -> Slope {
        let slopes = parts.iter().map(|part| self.of(*part));
        let slopes: Vec<Option<NodeId>> = slopes.collect::<Result<_, _>>()?;
        if slopes.iter().all(Option::is_none) {
            return Ok(None);
        }
        let mut all = Vec::new();
        for (part, slope) in parts.iter().zip(slopes) {
            let kind = self.at(*part).value_type;
            all.push(slope.unwrap_or_else(|| self.zero(kind).node));
        }
        Ok(Some(self.push(build(all), kind)))
    }

    /// Σ fᵢ' Π fₖ over the other factors.
    fn product(&mut self, factors: &[NodeId]) -> Slope {
        let mut total = None;
        for (i, factor) in factors.iter().enumerate() {
            let Some(slope) = self.of(*factor)? else { continue };
            let others = factors.iter().enumerate().filter(|(k, _)| *k != i);
            let mut all: Vec<NodeId> = others.map(|(_, other)| *other).collect();
            all.push(slope);
            let term = self.push(NodeOperation::Product(all.into()), Type::Scalar);
            total = self.sum(total, Some(term))?;
        }
        Ok(total)
    }
}
