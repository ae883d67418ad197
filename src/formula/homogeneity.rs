//! Homogeneity of formulas: weights of nodes, and equality of the weights of added terms.

use super::arena::{Arena, ElementaryFunction, NodeId, NodeOperation};
use super::error::{FormulaError, Span, excerpt};
use super::kind::Type;
use super::weights::{LinearWeight, Weight, WeightSystem};
use crate::number::rational::Rational;

/// Checks every node and returns the weight of the last, if it is known by then.
pub(super) fn check(
    arena: &Arena,
    text: &str,
    system: &mut WeightSystem,
) -> Result<Option<Weight>, FormulaError> {
    let mut check = Check { arena, text, system, forms: Vec::with_capacity(arena.nodes.len()) };
    for node in 0..arena.nodes.len() {
        let form = check.form(node)?;
        check.forms.push(form);
    }
    let last = check.forms.pop().flatten();
    Ok(last.and_then(|form| check.system.reduced(form).known().cloned()))
}

struct Check<'a> {
    arena: &'a Arena,
    text: &'a str,
    system: &'a mut WeightSystem,
    /// Weights of the nodes passed; `None` for zero, which fits any weight.
    forms: Vec<Option<LinearWeight>>,
}

impl Check<'_> {
    /// Weight of a node, from those of its operands.
    fn form(&mut self, node: NodeId) -> Result<Option<LinearWeight>, FormulaError> {
        let one = Rational::from(1);
        Ok(match &self.arena.nodes[node].operation {
            NodeOperation::Number(value) => (!value.is_zero()).then(LinearWeight::zero),
            NodeOperation::Identity | NodeOperation::Constant(_) => Some(LinearWeight::zero()),
            NodeOperation::Symbol(slot) => Some(self.system.symbol(self.arena.symbols[*slot].0)),
            NodeOperation::Add(a, b) | NodeOperation::Subtract(a, b) => {
                self.equal(node, &[*a, *b])?
            }
            NodeOperation::Vector(all) | NodeOperation::Rows(all) | NodeOperation::Sum(all) => {
                self.equal(node, all)?
            }
            NodeOperation::Product(all) => {
                let factors = all.iter().map(|a| self.forms[*a].as_ref());
                factors.collect::<Option<Vec<&LinearWeight>>>().map(|factors| {
                    factors.into_iter().fold(LinearWeight::zero(), |sum, form| sum.plus(form, &one))
                })
            }
            NodeOperation::Zero => None,
            NodeOperation::Multiply(a, b)
            | NodeOperation::Scale(a, b)
            | NodeOperation::Apply(a, b)
            | NodeOperation::Compose(a, b)
            | NodeOperation::Dot(a, b)
            | NodeOperation::Cross(a, b)
            | NodeOperation::Outer(a, b)
            | NodeOperation::Antiderivative(a, b) => self.combined(*a, *b, &one),
            NodeOperation::Divide(a, b) => self.combined(*a, *b, &-&one),
            NodeOperation::Solve(a, b) => self.combined(*b, *a, &-&one),
            NodeOperation::Power(a, exponent) => self.times(*a, exponent),
            NodeOperation::PowerOf(a, b) => self.power_of(*a, *b)?,
            NodeOperation::MatrixPower(a, n) => self.times(*a, &Rational::from(i64::from(*n))),
            NodeOperation::Inverse(a) => self.times(*a, &-&one),
            NodeOperation::Adjugate(a) => self.times(*a, &Rational::from(self.rows(*a) - 1)),
            NodeOperation::Determinant(a) => self.times(*a, &Rational::from(self.rows(*a))),
            NodeOperation::Partial { derivative: a, .. }
            | NodeOperation::Negate(a)
            | NodeOperation::Component(a, _)
            | NodeOperation::Row(a, _)
            | NodeOperation::Entry(a, _, _)
            | NodeOperation::Transpose(a)
            | NodeOperation::Trace(a)
            | NodeOperation::Diagonal(a) => self.forms[*a].clone(),
            NodeOperation::Function(function, a) => self.function(*function, *a)?,
            NodeOperation::Extreme(_, all) => self.equal(node, all)?,
            NodeOperation::Angle(y, x) => {
                self.equal(node, &[*y, *x])?;
                Some(LinearWeight::zero())
            }
        })
    }

    /// Number of rows of a matrix, as a factor of weights; 1 for other values.
    fn rows(&self, node: NodeId) -> i64 {
        match self.arena.nodes[node].value_type {
            Type::Matrix(rows, _) => rows as i64,
            _ => 1,
        }
    }

    /// Common weight of terms that have to agree.
    fn equal(
        &mut self,
        node: NodeId,
        terms: &[NodeId],
    ) -> Result<Option<LinearWeight>, FormulaError> {
        let mut first: Option<(NodeId, LinearWeight)> = None;
        for term in terms {
            let Some(form) = self.forms[*term].clone() else {
                continue;
            };
            match &first {
                None => first = Some((*term, form)),
                Some((other, expected)) => {
                    if let Err(difference) = self.system.equate(expected, &form) {
                        return Err(self.unequal(node, *other, *term, &difference));
                    }
                }
            }
        }
        Ok(first.map(|(_, form)| form))
    }

    fn combined(&self, a: NodeId, b: NodeId, factor: &Rational) -> Option<LinearWeight> {
        let (a, b) = (self.forms[a].clone()?, self.forms[b].as_ref()?);
        Some(a.plus(b, factor))
    }

    fn times(&self, a: NodeId, factor: &Rational) -> Option<LinearWeight> {
        self.forms[a].as_ref().map(|form| form.times(factor))
    }

    /// Weight of a power whose exponent is not a number: open unless the base is weightless.
    fn power_of(
        &mut self,
        base: NodeId,
        exponent: NodeId,
    ) -> Result<Option<LinearWeight>, FormulaError> {
        self.weightless(exponent, "an exponent")?;
        let Some(form) = self.forms[base].clone() else {
            return Ok(None);
        };
        let weightless = self.system.reduced(form).known().is_some_and(Rational::is_zero);
        Ok(Some(if weightless { LinearWeight::zero() } else { self.system.fresh() }))
    }

    fn function(
        &mut self,
        function: ElementaryFunction,
        a: NodeId,
    ) -> Result<Option<LinearWeight>, FormulaError> {
        let name = match function {
            ElementaryFunction::Sqrt => return Ok(self.times(a, &Rational::new(1, 2))),
            ElementaryFunction::Modulus => return Ok(self.forms[a].clone()),
            // the logarithm of a density changes by a constant, which no derivative sees
            ElementaryFunction::Ln | ElementaryFunction::Sign => {
                return Ok(Some(LinearWeight::zero()));
            }
            ElementaryFunction::Exp => "the argument of exp",
            ElementaryFunction::Sin => "the argument of sin",
            ElementaryFunction::Cos => "the argument of cos",
            ElementaryFunction::Tan => "the argument of tan",
            ElementaryFunction::Asin => "the argument of asin",
            ElementaryFunction::Acos => "the argument of acos",
            ElementaryFunction::Atan => "the argument of atan",
            ElementaryFunction::Sinh => "the argument of sinh",
            ElementaryFunction::Cosh => "the argument of cosh",
            ElementaryFunction::Tanh => "the argument of tanh",
            ElementaryFunction::Asinh => "the argument of asinh",
            ElementaryFunction::Acosh => "the argument of acosh",
            ElementaryFunction::Atanh => "the argument of atanh",
        };
        self.weightless(a, name)?;
        Ok(Some(LinearWeight::zero()))
    }

    fn weightless(&mut self, node: NodeId, what: &str) -> Result<(), FormulaError> {
        let Some(form) = self.forms[node].clone() else {
            return Ok(());
        };
        self.system.equate(&form, &LinearWeight::zero()).map_err(|weight| {
            let span = self.arena.nodes[node].span.clone();
            let message = format!(
                "{what} must have weight 0: `{}` scales as {}",
                self.written(&span),
                self.power(&weight)
            );
            FormulaError::new(span, message)
        })
    }

    fn unequal(&self, sum: NodeId, a: NodeId, b: NodeId, difference: &Weight) -> FormulaError {
        let (left, right) = (self.first_term(a), self.first_term(b));
        let [a, b] = [left, right].map(|node| {
            let weight = self.forms[node].clone().map(|form| self.system.reduced(form));
            let weight =
                weight.as_ref().and_then(LinearWeight::known).map(|weight| self.power(weight));
            (self.written(&self.arena.nodes[node].span), weight)
        });
        let message = match (a, b) {
            ((a, Some(x)), (b, Some(y))) => {
                format!("terms of unequal weight: `{a}` scales as {x}, `{b}` as {y}")
            }
            ((a, _), (b, _)) => {
                let factor = self.power(difference);
                format!("terms of unequal weight: `{a}` scales as `{b}` times {factor}")
            }
        };
        FormulaError::new(self.arena.nodes[sum].span.clone(), message)
    }

    /// First term with a weight of a sum written without brackets.
    fn first_term(&self, mut node: NodeId) -> NodeId {
        let nodes = &self.arena.nodes;
        while let NodeOperation::Add(a, b) | NodeOperation::Subtract(a, b) = nodes[node].operation {
            // a bracketed sum starts before its first term
            if nodes[node].span.start < nodes[a].span.start {
                break;
            }
            node = if self.forms[a].is_some() { a } else { b };
        }
        node
    }

    fn written(&self, span: &Span) -> String {
        excerpt(&self.text[span.clone()])
    }

    fn power(&self, weight: &Weight) -> String {
        let (dimension, written) = (self.system.dimension(), weight.to_string());
        if written.contains('/') {
            format!("{dimension}^({written})")
        } else {
            format!("{dimension}^{written}")
        }
    }
}
