//! Assembly of the values of an indexed form: sums, products, vectors and matrices.

use super::arena::NodeOperation;
use super::binders::{Term, usage};
use super::error::{FormulaError, Span};
use super::kind::Type;
use super::typing::{Builder, Built, Operand};
use crate::number::rational::Rational;

impl Builder<'_> {
    /// Builds the form `name` with `indices` indices from the values of its body.
    pub fn assemble(&mut self, name: &str, terms: Vec<Term>, indices: usize, span: Span) -> Built {
        let opens_row: Vec<bool> = terms.iter().map(|term| term.opens_row).collect();
        let mut parts: Vec<Operand> = terms.into_iter().map(|term| term.operand).collect();
        match name {
            "sum" => self.sum_of(&parts, span),
            "product" => self.product_of(&parts, span),
            _ if parts.is_empty() => {
                Err(FormulaError::new(span, format!("this {name} has no components")))
            }
            "vector" if indices == 1 => {
                self.fill_empty(&mut parts);
                self.vector(&parts, span)
            }
            "matrix" if indices == 1 => {
                self.fill_empty(&mut parts);
                self.rows(&parts, span)
            }
            "matrix" if indices == 2 => {
                let mut rows: Vec<Vec<Operand>> = Vec::new();
                for (part, opens_row) in parts.into_iter().zip(opens_row) {
                    match rows.last_mut().filter(|_| !opens_row) {
                        Some(row) => row.push(part),
                        None => rows.push(vec![part]),
                    }
                }
                let rows = rows.iter().map(|row| self.vector(row, span.clone()));
                let rows = rows.collect::<Result<Vec<Operand>, FormulaError>>()?;
                self.rows(&rows, span)
            }
            _ => {
                let message = format!("a {name} has {indices} indices here, which is too many");
                Err(FormulaError::new(span, message).with_help(usage(name)))
            }
        }
    }

    fn sum_of(&mut self, terms: &[Operand], span: Span) -> Built {
        let is_empty = |term: &&Operand| self.is_empty_sum(term);
        let kept: Vec<&Operand> = terms.iter().filter(|term| !is_empty(term)).collect();
        let Some(first) = kept.first() else {
            return Ok(self.push(NodeOperation::Zero, Type::Scalar, span));
        };
        if let Some(wrong) = kept.iter().find(|term| term.value_type != first.value_type) {
            let (first, own) = (first.value_type.in_full(), wrong.value_type.in_full());
            let message = format!("the terms of a sum are of one kind, not a {first} and a {own}");
            return Err(FormulaError::new(wrong.span.clone(), message));
        }
        let nodes: Vec<usize> = kept.iter().map(|term| term.node).collect();
        if first.value_type != Type::Scalar {
            let operation = NodeOperation::Sum(nodes.into());
            return Ok(self.push(operation, first.value_type, span));
        }
        let fold = |numbers: &[&Rational]| {
            Some(numbers.iter().fold(Rational::from(0), |sum, number| &sum + number))
        };
        Ok(self.push_folded(NodeOperation::Sum(nodes.clone().into()), &nodes, span, fold))
    }

    fn product_of(&mut self, factors: &[Operand], span: Span) -> Built {
        if let Some(wrong) = factors.iter().find(|factor| factor.value_type != Type::Scalar) {
            let message = format!("`product` takes scalars, this is a {}", wrong.value_type);
            return Err(FormulaError::new(wrong.span.clone(), message));
        }
        if factors.is_empty() {
            let one = NodeOperation::Number(Rational::from(1));
            return Ok(self.push(one, Type::Scalar, span));
        }
        let nodes: Vec<usize> = factors.iter().map(|factor| factor.node).collect();
        let fold = |numbers: &[&Rational]| {
            Some(numbers.iter().fold(Rational::from(1), |product, number| &product * number))
        };
        Ok(self.push_folded(NodeOperation::Product(nodes.clone().into()), &nodes, span, fold))
    }
}
