//! Linearity in the velocities of a Lagrangian system's formulas: its equations hold for rates
//! linear in the quasi-velocities, and a nonlinear constraint needs a rule for its reaction.

use num_traits::{One, Zero};

use super::error::{Mistake, Problem};
use super::section::CaseTable;
use crate::formula::canonical_name;
use crate::graph::{Expr, record};
use crate::mechanics::vanishing::vanishes;
use crate::mechanics::{
    Algebra, Lagrangian, LevelEquation, LevelFunction, Model, Phase, System, VariableRole,
};

/// Rejects a rate that is not linear in the velocities although the equations of motion need it.
/// Returns a warning for each constraint whose reaction is a matter of definition.
pub fn check(root: &CaseTable<'_>, model: &Model) -> Result<Vec<String>, Mistake> {
    let System::Lagrangian(lagrangian) = &model.system else { return Ok(Vec::new()) };
    let nonlinear = Nonlinear::of(lagrangian, model);
    if let Some(component) = nonlinear.rates.first() {
        let name = model.variable_of(*component).map_or("", |(variable, _)| &variable.name);
        let message = format!("the rate of `{name}` is not linear in the velocities");
        let remedy = "the equations of motion hold for x' = Σ wᵢ Xᵢ(x): take other quasi-velocities, \
                      or give all rates in [field] of a system of your own";
        let problem = Problem::Sense { message, remedy: remedy.to_string() };
        return Err(Mistake::new(place_of_rate(root, name), problem));
    }
    if let Some(index) = nonlinear.still.first() {
        let text = text_of(lagrangian, model, *index);
        // The equation before is the one whose rate this is, if the file does not contain it.
        let place = model.level.iter().position(|equation| equation.text == text);
        let before = place.filter(|_| root.find(text).is_none()).and_then(|k| k.checked_sub(1));
        let (text, message, remedy) = match before.map(|k| model.level[k].text.as_str()) {
            Some(given) => (
                given,
                format!("`{given}` is kept by all velocities, and constrains none"),
                "write it under [level], as one of `equations`",
            ),
            None => (
                text,
                "this constraint contains neither a velocity nor a coordinate".to_string(),
                "write one such as x*x' + y*y' = 0, or x² + y² = 1",
            ),
        };
        let span = root.find(text).map(|start| start..start + text.len());
        let problem = Problem::Sense { message, remedy: remedy.to_string() };
        return Err(Mistake::new(span, problem));
    }
    let warning = |index: &usize| {
        format!(
            "the constraint `{}` is not linear in the velocities: its reaction is taken by Chetaev's \
             rule, along its slope by the velocities",
            text_of(lagrangian, model, *index)
        )
    };
    Ok(nonlinear.constraints.iter().map(warning).collect())
}

/// Text of a constraint as the file writes it.
fn text_of<'m>(lagrangian: &Lagrangian, model: &'m Model, index: usize) -> &'m str {
    let own = |equation: &&LevelEquation| match &equation.function {
        LevelFunction::Formula(function) => function.text() == lagrangian.constraints[index].text(),
        _ => false,
    };
    model.level.iter().find(own).map_or("", |equation| equation.text.as_str())
}

/// Formulas that are not linear in the velocities.
#[derive(Default)]
struct Nonlinear {
    /// Components of the state whose rates the equations of motion need to be linear.
    rates: Vec<usize>,
    /// Nonholonomic constraints, by their numbers.
    constraints: Vec<usize>,
    /// Nonholonomic constraints without velocities, by their numbers.
    still: Vec<usize>,
}

impl Nonlinear {
    /// Finds the nonlinear formulas: f is linear in w when no ∂f/∂w_i contains a velocity as it is
    /// recorded.
    fn of(lagrangian: &Lagrangian, model: &Model) -> Self {
        let is_carried = |role: &VariableRole| matches!(role, VariableRole::Carried(_));
        if lagrangian.constraints.is_empty() && !lagrangian.roles.iter().any(is_carried) {
            return Self::default();
        }
        let (parameters, dimension) = (model.free_components(), model.dimension());
        let velocities = lagrangian.velocities(&model.state);
        let recorded = record(parameters + dimension, |inputs| {
            let (parameters, state) = inputs.split_at(parameters);
            let at = Phase::new(model, parameters, state).configuration;
            let slopes = |component: &usize| {
                let mut unit = vec![Expr::zero(); dimension];
                unit[*component] = Expr::one();
                let moved = at.lift_state(&unit);
                let rates: Vec<Expr> = lagrangian.drift(&moved).iter().map(|x| x.eps).collect();
                let constraints = lagrangian.constraints.iter();
                let slope = |f| moved.evaluate(f).components().iter().map(|x| x.eps).sum::<Expr>();
                (rates, constraints.map(slope).collect::<Vec<Expr>>())
            };
            let slopes: Vec<(Vec<Expr>, Vec<Expr>)> = velocities.iter().map(slopes).collect();
            (slopes, lagrangian.lagrangian(&at, lagrangian.vakonomic))
        });
        let Ok((graph, (slopes, function))) = recorded else { return Self::default() };
        let mut is_velocity = vec![false; parameters + dimension];
        velocities.iter().for_each(|velocity| is_velocity[parameters + velocity] = true);
        let is_velocity = |input: &usize| is_velocity.get(*input) == Some(&true);
        let bends = |slope: Expr| graph.inputs_of(slope).iter().any(is_velocity);
        // A variable that is only carried along, and that L does not contain, may have any rate.
        let counts = |component: usize| {
            lagrangian.algebra == Algebra::Frame
                || graph.depends_on(function, parameters + component)
        };
        let rates = (0..dimension)
            .filter(|k| slopes.iter().any(|(rates, _)| bends(rates[*k])) && counts(*k))
            .collect();
        let constraints = (0..lagrangian.constraints.len())
            .filter(|k| !lagrangian.vakonomic && slopes.iter().any(|(_, all)| bends(all[*k])))
            .collect();
        let is_still = |k: &usize| slopes.iter().all(|(_, all)| vanishes(&graph, all[*k]));
        let still = match lagrangian.vakonomic || slopes.is_empty() {
            true => Vec::new(),
            false => (0..lagrangian.constraints.len()).filter(is_still).collect(),
        };
        Self { rates, constraints, still }
    }
}

/// Place in `[field]` of the rate of a variable.
fn place_of_rate(root: &CaseTable<'_>, name: &str) -> Option<std::ops::Range<usize>> {
    let section = root.table("field")?;
    let is_rate = |key: &str| {
        let base = key.split('[').next().unwrap_or(key);
        canonical_name(base).is_some_and(|key| key.strip_suffix('\'').unwrap_or(&key) == name)
    };
    let entry = section.entries().into_iter().find(|(key, _)| is_rate(key.get_ref()));
    entry.map(|(_, value)| value.span())
}
