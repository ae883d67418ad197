//! Residuals that contain the value of an ∫, whose constant is open: they vanish for some constant,
//! perhaps, where they do not for those drawn.
//!
//! A residual R = c(x) e^(ks) of the value s, with k a number or a function of the parameters, vanishes for
//! all constants or for none. The form is read off the operations that make it, so that it is certain, or
//! R(s + δ) = R(s) is proved for all δ.

use num_traits::Zero;

use super::judging::Judging;
use super::recorded::RecordedClaim;
use super::sampler::{Sampler, TAPE_LANES};
use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::mechanics::combinations;
use crate::number::ball::Ball;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::{Group, GroupOutcome, Prover};
use crate::scalar::Scalar;

impl Judging<'_> {
    /// Whether a claim whose residual does not vanish may hold for other constants of its ∫.
    pub(super) fn depends_on_constants(&self, item: &RecordedClaim<'_>) -> Result<bool, Fault> {
        if !item.residual.iter().any(|value| self.has_open_constant(*value)) {
            return Ok(false);
        }
        let sampler = self.sampler_at(&item.claim.place)?;
        if sampler.is_numerical() {
            return Ok(true);
        }
        let states = sampler.balls(0);
        for residual in &item.residual {
            let mut is_multiple = true;
            for constant in self.constants_in(*residual) {
                is_multiple = is_multiple
                    && (self.is_multiple(*residual, constant)?
                        || self.is_independent_of(*residual, constant, &sampler)?);
            }
            // Without an ∫ it is as it is, and it has to be one that does not vanish at a state that counts.
            let mut outputs = vec![*residual];
            outputs.extend(item.requirement.iter().chain(&item.presence));
            outputs.extend(self.common.required_at(sampler.kept()));
            let values = self.run(&outputs).at(&Ball::<TAPE_LANES>, &states);
            let counts =
                |lane: usize| (0..outputs.len()).all(|place| values.output(place).is_defined(lane));
            let value = values.output(0);
            if is_multiple && (0..TAPE_LANES).any(|lane| value.excludes_zero(lane) && counts(lane))
            {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether a value depends on the constant of an ∫.
    pub(super) fn has_open_constant(&self, value: Expr) -> bool {
        self.constants_in(value).next().is_some()
    }

    /// Inputs of a value that stand for values of ∫.
    fn constants_in(&self, value: Expr) -> impl Iterator<Item = usize> {
        let inputs = self.inputs;
        self.graph.inputs_of(value).into_iter().filter(move |input| *input >= inputs)
    }

    /// Whether it is proved that a residual is the same for all values of an ∫.
    fn is_independent_of(
        &self,
        residual: Expr,
        constant: usize,
        sampler: &Sampler,
    ) -> Result<bool, Fault> {
        let count = self.graph.inputs();
        let reached = self.graph.reached([residual]);
        let (graph, change) = record(count + 1, |inputs| {
            let mut shifted = inputs[..count].to_vec();
            shifted[constant] += inputs[count];
            let of =
                |inputs: &[Expr]| self.graph.repeated(&reached, inputs)[self.graph.place(residual)];
            Some(of(&shifted)? - of(&inputs[..count])?)
        })?;
        let (Some(change), Some(choices)) = (change, combinations(sampler.recipes())) else {
            return Ok(false);
        };
        let (sources, extents) = (sampler.sources(), sampler.extents());
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        for fixed in choices {
            let (graph, groups) =
                sampler.compose_groups(&graph, &[Group::of(vec![change])], &fixed)?;
            if !prover.prove(&graph, &groups)?.iter().all(GroupOutcome::is_zero) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether a residual is seen to have the form c(x) e^(ks) in the value s of an ∫.
    fn is_multiple(&self, residual: Expr, constant: usize) -> Result<bool, Fault> {
        let (graph, rates) = record(self.graph.inputs(), |inputs| {
            Dependences::of(self.graph, residual, constant, inputs)
                .map(|found| (found.exponents, found.forms.last().and_then(|form| form.rate)))
        })?;
        let Some((exponents, Some(_))) = rates else { return Ok(false) };
        let parameters = self.case.model.free_components();
        let is_parametric =
            |value: &Expr| graph.inputs_of(*value).into_iter().all(|input| input < parameters);
        Ok(exponents.iter().all(is_parametric))
    }
}

/// Dependence of a value on s.
#[derive(Clone, Copy, Default)]
struct Form {
    /// The value itself.
    value: Option<Expr>,
    /// k, where the value is c e^(ks).
    rate: Option<Expr>,
    /// a, where the value is as + b.
    slope: Option<Expr>,
}

impl Form {
    /// Form of a value that does not depend on s.
    fn free(value: Option<Expr>) -> Self {
        Self { value, rate: Some(Expr::zero()), slope: Some(Expr::zero()) }
    }

    /// Whether the value does not depend on s.
    fn is_free(&self) -> bool {
        [self.rate, self.slope].contains(&Some(Expr::zero()))
    }
}

/// Forms of the values that make a residual.
struct Dependences {
    /// Forms of the needed steps, and of none in place of the others, up to the residual.
    forms: Vec<Form>,
    /// Factors k, which have to be functions of the parameters alone.
    exponents: Vec<Expr>,
}

impl Dependences {
    /// Finds the forms in the recording under way; `None` where a value cannot be repeated.
    fn of(graph: &Graph, residual: Expr, constant: usize, inputs: &[Expr]) -> Option<Self> {
        let reached = graph.reached([residual]);
        let mut found = Self { forms: Vec::new(), exponents: Vec::new() };
        for (place, is_needed) in reached.iter().enumerate().take(graph.place(residual) + 1) {
            if !is_needed {
                found.forms.push(Form::default());
                continue;
            }
            let step = graph.step(place);
            let value = Some(step.repeat(inputs, |place| found.forms[place].value)?);
            let form = match step {
                Step::Input(input) if input == constant => {
                    Form { value, rate: None, slope: Some(Expr::rational(&Rational::from(1))) }
                }
                _ if step.arguments().all(|place| found.forms[place].is_free()) => {
                    Form::free(value)
                }
                _ => Form { value, rate: found.rate(&step), slope: found.slope(&step) },
            };
            found.forms.push(form);
        }
        Some(found)
    }

    /// Finds k of a step whose value is c e^(ks).
    fn rate(&mut self, step: &Step<'_>) -> Option<Expr> {
        let form = |place: usize| self.forms[place];
        match *step {
            Step::Constant(_) | Step::Input(_) => None,
            Step::Unary(function, a) => match function {
                UnaryFunction::Neg | UnaryFunction::Abs => form(a).rate,
                UnaryFunction::Recip => form(a).rate.map(|rate| -rate),
                UnaryFunction::Sqrt => {
                    form(a).rate.map(|rate| rate * Expr::rational(&Rational::new(1, 2)))
                }
                UnaryFunction::Exp => {
                    let slope = form(a).slope?;
                    self.exponents.push(slope);
                    Some(slope)
                }
                UnaryFunction::Ln
                | UnaryFunction::Sin
                | UnaryFunction::Cos
                | UnaryFunction::Atan => None,
            },
            Step::Power(a, exponent) => form(a).rate.map(|rate| rate * Expr::rational(exponent)),
            Step::Binary(operation, a, b) => {
                let (left, right) = (form(a), form(b));
                match operation {
                    BinaryOperation::Add | BinaryOperation::Sub => {
                        let sum = self.slope(step);
                        let is_equal = left.rate.is_some() && left.rate == right.rate;
                        let same = left.rate.filter(|_| is_equal);
                        same.or_else(|| sum.filter(|slope| *slope == Expr::zero()))
                    }
                    BinaryOperation::Mul => Some(left.rate? + right.rate?),
                    BinaryOperation::Pow => {
                        let power = right.value.filter(|_| right.is_free())?;
                        let rate = left.rate? * power;
                        self.exponents.push(rate);
                        Some(rate)
                    }
                }
            }
        }
    }

    /// Finds a of a step whose value is as + b.
    fn slope(&self, step: &Step<'_>) -> Option<Expr> {
        let form = |place: usize| self.forms[place];
        match *step {
            Step::Unary(UnaryFunction::Neg, a) => form(a).slope.map(|slope| -slope),
            Step::Binary(operation, a, b) => {
                let (left, right) = (form(a), form(b));
                match operation {
                    BinaryOperation::Add => Some(left.slope? + right.slope?),
                    BinaryOperation::Sub => Some(left.slope? - right.slope?),
                    BinaryOperation::Mul if left.is_free() => Some(left.value? * right.slope?),
                    BinaryOperation::Mul if right.is_free() => Some(left.slope? * right.value?),
                    BinaryOperation::Mul | BinaryOperation::Pow => None,
                }
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a function of x and s is seen to be c(x) e^(ks).
    fn is_multiple(of: impl Fn(Expr, Expr) -> Expr) -> bool {
        let (graph, value) = record(2, |inputs| of(inputs[0], inputs[1])).expect("records");
        let (again, found) = record(2, |inputs| {
            let found = Dependences::of(&graph, value, 1, inputs).expect("is repeated");
            let rate = found.forms.last().and_then(|form| form.rate);
            (rate.is_some(), found.exponents)
        })
        .expect("records");
        found.0 && found.1.iter().all(|value| again.inputs_of(*value).is_empty())
    }

    #[test]
    fn multiples_of_exponentials_are_seen_and_nothing_else() {
        let exp = |x: Expr| x.apply(UnaryFunction::Exp);
        let number = |x: i64| Expr::rational(&Rational::from(x));
        assert!(is_multiple(|x, s| x * exp(s * number(3) + x)), "x e^(3s + x)");
        assert!(is_multiple(|x, s| x * exp(s) + exp(s)), "a sum of two with one k");
        assert!(is_multiple(|x, s| exp(s).apply(UnaryFunction::Sqrt) * x), "a root");
        assert!(is_multiple(|x, s| (s + x) * number(2) - s * number(2)), "s cancels");
        assert!(!is_multiple(|x, s| x * s), "0 for s = 0");
        assert!(!is_multiple(|x, s| x * (s + number(10).power(&Rational::from(20)))), "far away");
        assert!(!is_multiple(|x, s| exp(x * s)), "k depends on the state");
        assert!(!is_multiple(|x, s| exp(s) + x), "two different k");
        assert!(!is_multiple(|_, s| s.apply(UnaryFunction::Sin)), "0 for s = π");
    }
}
