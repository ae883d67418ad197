//! Limits with a rate: A = B + ε C + O(ε²).

use num_dual::Dual;
use num_traits::{One, Zero};

use super::{Reader, ResidualContext, Statement, difference};
use crate::formula::{Formula, Type, Value};
use crate::graph::Expr;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{Meaning, Model};
use crate::scalar::Scalar;

/// Reads the scalar parameter named by a key.
pub(super) fn scalar_parameter<R: Reader>(from: &R, key: &'static str) -> Result<usize, R::Error> {
    let name = from.text(key)?.ok_or_else(|| from.missing(key))?;
    let entry = from.model().vocabulary.find(name.trim());
    match entry.map(|entry| (entry.meaning, entry.kind)) {
        Some((Meaning::Parameter(index), Type::Scalar)) => Ok(index),
        _ => {
            let message = format!("`{name}` is not a scalar parameter");
            let scalars = from.model().parameters.iter().filter(|own| own.kind == Type::Scalar);
            let names: Vec<&str> = scalars.map(|own| own.name.as_str()).collect();
            let remedy = match names.as_slice() {
                [] => "declare it in [parameters], with a range".to_string(),
                names => format!("name one of {}", names.join(", ")),
            };
            Err(from.complaint(key, message, &remedy))
        }
    }
}

/// The claim that A → B as the parameter goes to 0, with the slope C if one is given. A must be
/// analytic in the parameter near 0, as any formula is that does not divide by it.
#[derive(Clone, Debug)]
pub struct Limit {
    function: Formula,
    value: Formula,
    slope: Option<Formula>,
    parameter: usize,
}

/// Whether a formula contains quantities that the system defines, such as rates.
fn has_quantities(model: &Model, formula: &Formula) -> bool {
    formula.symbols().any(|symbol| match model.vocabulary.entry(symbol).meaning {
        Meaning::Quantity(_) => true,
        Meaning::Abbreviation(index) => {
            model.abbreviations.get(index).is_some_and(|own| has_quantities(model, own))
        }
        Meaning::Parameter(_) | Meaning::State(_) => false,
    })
}

impl Statement for Limit {
    const NAME: &'static str = "limit";
    const OF_MAPS: bool = true;
    const COMPANIONS: &'static [&'static str] = &["equals", "parameter", "slope"];
    const UNDEFINED: &'static str = ": the parameter is set to 0, so the formula must be written without dividing by it, \
         and with a slope have a second derivative there";

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let function = from.required(Self::NAME, None)?;
        let kind = Some(function.value_type());
        let value = from.required("equals", kind)?;
        let slope = from.formula("slope", kind)?;
        let parameter = scalar_parameter(from, "parameter")?;
        if slope.is_some() && from.model().has_antiderivative(&function) {
            let message =
                "the slope of an ∫ by a parameter is open, as its constant is".to_string();
            return Err(from.complaint("slope", message, "write the antiderivative out"));
        }
        Ok(Self { function, value, slope, parameter })
    }

    fn formulas(&self) -> Vec<&Formula> {
        [&self.value, &self.function].into_iter().chain(&self.slope).collect()
    }

    fn text(&self) -> Option<String> {
        Some(format!("{} → {}", self.function.text().trim(), self.value.text().trim()))
    }

    fn about(&self, value: Formula) -> Option<Self> {
        Some(Self { value, ..self.clone() })
    }

    fn changes(&self) -> Vec<usize> {
        vec![self.parameter]
    }

    /// A as written at 0: with 0/(x + |x| + 0) it has no value for x < 0, where A is 1.
    fn presence(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        let zero = [(self.parameter, Value::Scalar(Expr::zero()))];
        let at = jet.phase.with(&zero, &jet.phase.state());
        let model = at.model();
        let uses_motion = has_quantities(model, &self.function);
        let functions = if uses_motion { model.dynamics() } else { Vec::new() };
        let all = functions.into_iter().chain([&self.function]);
        all.flat_map(|formula| at.evaluate_literally(formula).components()).collect()
    }

    /// Adds A'' at 0 if a slope is given: ε^(3/2) has a slope there too, and is not O(ε²).
    fn context(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> ResidualContext {
        if self.slope.is_none() {
            return ResidualContext::default();
        }
        let zero = [(self.parameter, Value::Scalar(Expr::zero()))];
        let at = jet.phase.with(&zero, &jet.phase.state());
        let near = at.lift_parameter(self.parameter, Expr::one());
        let nearer = near.lift_parameter(self.parameter, Dual::from_re(Expr::one()));
        let values = nearer.evaluate(&self.function).components();
        ResidualContext {
            value: values.iter().map(|x| x.eps.eps).collect(),
            ..ResidualContext::default()
        }
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
        let zero = [(self.parameter, Value::Scalar(T::zero()))];
        let at = jet.phase.with(&zero, &jet.phase.state());
        let near = at.lift_parameter(self.parameter, T::one());
        let values = near.evaluate(&self.function).components();
        let limit = values.iter().map(|x| x.re).collect();
        let mut residual = difference(limit, at.evaluate(&self.value).components());
        if let Some(slope) = &self.slope {
            let slopes = values.iter().map(|x| x.eps).collect();
            residual.extend(difference(slopes, at.evaluate(slope).components()));
        }
        residual
    }
}
