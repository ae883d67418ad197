//! Homogeneity of formulas: weights of nodes, and equality of the weights of added terms.

use super::arena::{Arena, Function, NodeId, Operation};
use super::error::{FormulaError, Span, excerpt};
use super::kind::Type;
use super::weights::{Form, Weight, WeightSystem};
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
    forms: Vec<Option<Form>>,
}

impl Check<'_> {
    /// Weight of a node, from those of its operands.
    fn form(&mut self, node: NodeId) -> Result<Option<Form>, FormulaError> {
        let one = Rational::from(1);
        Ok(match &self.arena.nodes[node].operation {
            Operation::Number(value) => (!value.is_zero()).then(Form::zero),
            Operation::Identity | Operation::Constant(_) => Some(Form::zero()),
            Operation::Symbol(slot) => Some(self.system.symbol(self.arena.symbols[*slot].0)),
            Operation::Add(a, b) | Operation::Subtract(a, b) => self.equal(node, &[*a, *b])?,
            Operation::Vector(all) | Operation::Rows(all) | Operation::Sum(all) => {
                self.equal(node, all)?
            }
            Operation::Product(all) => {
                let factors = all.iter().map(|a| self.forms[*a].as_ref());
                factors.collect::<Option<Vec<&Form>>>().map(|factors| {
                    factors.into_iter().fold(Form::zero(), |sum, form| sum.plus(form, &one))
                })
            }
            Operation::Zero => None,
            Operation::Multiply(a, b)
            | Operation::Scale(a, b)
            | Operation::Apply(a, b)
            | Operation::Compose(a, b)
            | Operation::Dot(a, b)
            | Operation::Cross(a, b)
            | Operation::Outer(a, b)
            | Operation::Antiderivative(a, b) => self.combined(*a, *b, &one),
            Operation::Divide(a, b) => self.combined(*a, *b, &-&one),
            Operation::Solve(a, b) => self.combined(*b, *a, &-&one),
            Operation::Power(a, exponent) => self.times(*a, exponent),
            Operation::PowerOf(a, b) => self.power_of(*a, *b)?,
            Operation::MatrixPower(a, n) => self.times(*a, &Rational::from(i64::from(*n))),
            Operation::Inverse(a) => self.times(*a, &-&one),
            Operation::Adjugate(a) => self.times(*a, &Rational::from(self.rows(*a) - 1)),
            Operation::Determinant(a) => self.times(*a, &Rational::from(self.rows(*a))),
            Operation::Partial { derivative: a, .. }
            | Operation::Negate(a)
            | Operation::Component(a, _)
            | Operation::Row(a, _)
            | Operation::Entry(a, _, _)
            | Operation::Transpose(a)
            | Operation::Trace(a)
            | Operation::Diagonal(a) => self.forms[*a].clone(),
            Operation::Function(function, a) => self.function(*function, *a)?,
            Operation::Extreme(_, all) => self.equal(node, all)?,
            Operation::Angle(y, x) => {
                self.equal(node, &[*y, *x])?;
                Some(Form::zero())
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
    fn equal(&mut self, node: NodeId, terms: &[NodeId]) -> Result<Option<Form>, FormulaError> {
        let mut first: Option<(NodeId, Form)> = None;
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

    fn combined(&self, a: NodeId, b: NodeId, factor: &Rational) -> Option<Form> {
        let (a, b) = (self.forms[a].clone()?, self.forms[b].as_ref()?);
        Some(a.plus(b, factor))
    }

    fn times(&self, a: NodeId, factor: &Rational) -> Option<Form> {
        self.forms[a].as_ref().map(|form| form.times(factor))
    }

    /// Weight of a power whose exponent is not a number: open unless the base is weightless.
    fn power_of(&mut self, base: NodeId, exponent: NodeId) -> Result<Option<Form>, FormulaError> {
        self.weightless(exponent, "an exponent")?;
        let Some(form) = self.forms[base].clone() else {
            return Ok(None);
        };
        let weightless = self.system.reduced(form).known().is_some_and(Rational::is_zero);
        Ok(Some(if weightless { Form::zero() } else { self.system.fresh() }))
    }

    fn function(&mut self, function: Function, a: NodeId) -> Result<Option<Form>, FormulaError> {
        let name = match function {
            Function::Sqrt => return Ok(self.times(a, &Rational::new(1, 2))),
            Function::Modulus => return Ok(self.forms[a].clone()),
            // the logarithm of a density changes by a constant, which no derivative sees
            Function::Ln | Function::Sign => return Ok(Some(Form::zero())),
            Function::Exp => "the argument of exp",
            Function::Sin => "the argument of sin",
            Function::Cos => "the argument of cos",
            Function::Tan => "the argument of tan",
            Function::Asin => "the argument of asin",
            Function::Acos => "the argument of acos",
            Function::Atan => "the argument of atan",
            Function::Sinh => "the argument of sinh",
            Function::Cosh => "the argument of cosh",
            Function::Tanh => "the argument of tanh",
            Function::Asinh => "the argument of asinh",
            Function::Acosh => "the argument of acosh",
            Function::Atanh => "the argument of atanh",
        };
        self.weightless(a, name)?;
        Ok(Some(Form::zero()))
    }

    fn weightless(&mut self, node: NodeId, what: &str) -> Result<(), FormulaError> {
        let Some(form) = self.forms[node].clone() else {
            return Ok(());
        };
        self.system.equate(&form, &Form::zero()).map_err(|weight| {
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
            let weight = weight.as_ref().and_then(Form::known).map(|weight| self.power(weight));
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
        while let Operation::Add(a, b) | Operation::Subtract(a, b) = nodes[node].operation {
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
