//! Limits with a rate: A = B + ε C + O(ε²).

use num_dual::Dual;
use num_traits::{One, Zero};

use super::boxes::Boxes;
use super::elsewhere::{inside, one_antiderivative};
use super::expansion::{Stated, defects, expansions, sides};
use super::statement::{OfMotions, open_constant};
use super::{Condition, Reader, ResidualContext, Statement};
use crate::formula::{Formula, Layout, Type, Value};
use crate::graph::{Expansion, Expr, Side};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{LevelFunction, Meaning, Model, ParameterOrigin, Phase};
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

/// The claim that A → B as the parameter goes to 0 inside of its range, with the slope C if one is
/// given. It is read off A at 0, or off its expansion where A has no value there.
#[derive(Clone, Debug)]
pub struct Limit {
    function: Formula,
    value: Formula,
    slope: Option<Formula>,
    parameter: usize,
}

/// Whether a formula contains a parameter, itself or by others that are computed from it.
fn uses(model: &Model, formula: &Formula, parameter: usize) -> bool {
    formula.symbols().any(|symbol| match model.vocabulary.entry(symbol).meaning {
        Meaning::Parameter(index) if index == parameter => true,
        Meaning::Parameter(index) => match &model.parameters[index].origin {
            ParameterOrigin::Formula(own) => uses(model, own, parameter),
            _ => false,
        },
        Meaning::Abbreviation(index) => {
            model.abbreviations.get(index).is_some_and(|own| uses(model, own, parameter))
        }
        Meaning::State(_) | Meaning::Quantity(_) => false,
    })
}

impl Statement for Limit {
    const NAME: &'static str = "limit";
    const OF_MAPS: bool = true;
    const OF_MOTIONS: OfMotions = OfMotions::Nothing;
    const COMPANIONS: &'static [&'static str] = &["equals", "parameter", "slope"];
    const UNDEFINED: &'static str = ": it is read off the formula where the parameter is 0, and with a slope off its second derivative, or \
         off an expansion in powers and logarithms of the parameter, and none of these is known";

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
        let own = uses(from.model(), &value, parameter);
        if slope.is_some() && own {
            let message = "B is taken where the parameter is 0, and contains it".to_string();
            let remedy = "with a slope A = B + ε C + O(ε²): move what is linear in ε to the slope";
            return Err(from.complaint("equals", message, remedy));
        }
        let level = from.model().level.iter();
        let mut moving = level.filter_map(|equation| match &equation.function {
            LevelFunction::Formula(own) => Some((own, equation)),
            _ => None,
        });
        let moves = |own: &Formula| {
            let model = from.model();
            let is_of_system = model.has_quantities(own);
            uses(model, own, parameter)
                || is_of_system && model.dynamics().iter().any(|own| uses(model, own, parameter))
        };
        if let Some((_, equation)) = moving.find(|(own, _)| moves(own)) {
            let message = format!(
                "the states themselves depend on the parameter, by the level equation `{}`",
                equation.text
            );
            let remedy =
                "solve the level for a coordinate, and state the limit of a formula of the others";
            return Err(from.complaint("parameter", message, remedy));
        }
        Ok(Self { function, value, slope, parameter })
    }

    fn formulas(&self) -> Vec<&Formula> {
        [&self.value, &self.function].into_iter().chain(&self.slope).collect()
    }

    fn text(&self) -> Option<String> {
        Some(format!("{} → {}", self.function.text().trim(), self.value.text().trim()))
    }

    fn layout(&self, boxes: Boxes<'_>) -> Option<Layout> {
        let (function, value) = (boxes.formula(&self.function), boxes.formula(&self.value));
        Some(Layout::Row(vec![function, Layout::Sign("→"), value]))
    }

    fn about(&self, value: Formula) -> Option<Self> {
        Some(Self { value, ..self.clone() })
    }

    fn limit_of_refutation(&self, model: &Model) -> Option<&'static str> {
        open_constant(model, &self.formulas())
    }

    fn changes(&self) -> Vec<usize> {
        vec![self.parameter]
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        one_antiderivative(jet.phase.model(), &self.formulas()).into_iter().collect()
    }

    /// A as written at 0: with 0/(x + |x| + 0) it has no value for x < 0, where A is 1. Where it has
    /// none anywhere, what its expansion requires.
    fn presence(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Expr> {
        let zero = [(self.parameter, Value::Scalar(Expr::zero()))];
        let at = jet.phase.with(&zero, &jet.phase.state());
        let model = at.model();
        let uses_motion = model.has_quantities(&self.function);
        let functions = if uses_motion { model.dynamics() } else { Vec::new() };
        let mut presence = Vec::new();
        // Where the rates are taken at 0, what the equations of motion divide by there is not 0.
        if model.has_rates(&self.function)
            && self.expanded(&jet.phase, &at, &self.function).iter().any(Option::is_none)
        {
            presence.extend(at.hidden_in_motion(&[]));
            presence.extend(at.open_divisors());
        }
        for formula in functions.into_iter().chain([&self.function]) {
            let expanded = self.expanded(&jet.phase, &at, formula);
            let values = at.evaluate_literally(formula).components();
            let sides: Vec<Side> = expanded.iter().flatten().flatten().map(|own| own.0).collect();
            for (value, expanded) in values.into_iter().zip(expanded) {
                match expanded {
                    Some(sides) => {
                        presence.extend(sides.into_iter().flat_map(|(_, own)| own.guards));
                    }
                    None => presence.extend(inside(vec![value])),
                }
            }
            match sides.is_empty() {
                true => presence.extend(at.presupposed(formula)),
                false => presence.extend(self.presupposed(&jet.phase, formula, &sides)),
            }
        }
        presence
    }

    /// Adds A'' at 0 if a slope is given: ε^(3/2) has a slope there too, and is not O(ε²).
    fn context(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> ResidualContext {
        if self.slope.is_none() {
            return ResidualContext::default();
        }
        let zero = [(self.parameter, Value::Scalar(Expr::zero()))];
        let at = jet.phase.with(&zero, &jet.phase.state());
        let expanded = self.expanded(&jet.phase, &at, &self.function);
        let near = at.lift_parameter(self.parameter, Expr::one());
        let nearer = near.lift_parameter(self.parameter, Dual::from_re(Expr::one()));
        let values = nearer.evaluate(&self.function).components();
        let own = values.iter().zip(expanded).filter(|(_, expanded)| expanded.is_none());
        ResidualContext {
            value: own.map(|(x, _)| x.eps.eps).collect(),
            ..ResidualContext::default()
        }
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
        let zero = [(self.parameter, Value::Scalar(T::zero()))];
        let at = jet.phase.with(&zero, &jet.phase.state());
        let expanded = self.expanded(&jet.phase, &at, &self.function);
        let near = at.lift_parameter(self.parameter, T::one());
        let values = near.evaluate(&self.function).components();
        let limits = at.evaluate(&self.value).components();
        let slopes = self.slope.as_ref().map(|slope| at.evaluate(slope).components());
        let mut residual = Vec::new();
        for (k, ((value, limit), expanded)) in values.iter().zip(limits).zip(expanded).enumerate() {
            let slope = slopes.as_ref().and_then(|slopes| slopes.get(k).copied());
            let Some(sides) = expanded else {
                residual.push(value.re - limit);
                residual.extend(slope.map(|slope| value.eps - slope));
                continue;
            };
            let stated = Stated { value: limit, slope };
            residual.extend(sides.iter().flat_map(|(side, own)| defects(*side, own, &stated)));
        }
        residual
    }
}

/// Expansions of one component by side; `None` where it is taken at 0, or not known.
type BySide<T> = Option<Vec<(Side, Expansion<T>)>>;

impl Limit {
    /// Returns the values that the powers in an expanded formula need for small values of the parameter: ln ε of ε^ε.
    fn presupposed(&self, phase: &Phase<'_, Expr>, formula: &Formula, sides: &[Side]) -> Vec<Expr> {
        let parameter = phase.configuration.parameter(self.parameter).components();
        let needed = |value: Expr| {
            let expanded = parameter.first().and_then(|own| expansions(value, *own, sides, 0));
            let all = expanded.unwrap_or_default();
            let is_missing = |side: &Side| all.iter().all(|(own, _)| own != side);
            match sides.iter().any(is_missing) {
                true => vec![Expr::undefined()],
                false => all.into_iter().flat_map(|(_, own)| own.guards).collect(),
            }
        };
        phase.presupposed(formula).into_iter().flat_map(needed).collect()
    }

    /// Expands the components of a formula that have no value where the parameter is 0.
    fn expanded<T: Scalar>(
        &self,
        phase: &Phase<'_, T>,
        at_zero: &Phase<'_, T>,
        formula: &Formula,
    ) -> Vec<BySide<T>> {
        // ε^ε comes out as 1 at 0, where ln ε has no value.
        let values = at_zero.with_logarithms(formula).components();
        // At the end of its domain A may have a value at 0, and none on any side.
        let is_read_off = |value: &T| !value.is_never_defined() && !value.is_on_edge();
        if values.iter().all(is_read_off) {
            return values.iter().map(|_| None).collect();
        }
        let model = phase.model();
        let parameter = phase.configuration.parameter(self.parameter).components();
        let sides = sides(model, self.parameter);
        let order = if self.slope.is_some() { 2 } else { 0 };
        let written = phase.evaluate_literally(formula).components();
        let one = |(at_zero, written): (&T, T)| match parameter.first() {
            Some(parameter) if !is_read_off(at_zero) => {
                expansions(written, *parameter, &sides, order)
            }
            _ => None,
        };
        values.iter().zip(written).map(one).collect()
    }
}
