//! Levels that fall apart by the form of their equations: (M,γ)² = a² is (M,γ) = a or (M,γ) = −a.

use crate::graph::{Expr, Graph, Step, literally, record};
use crate::mechanics::{LevelEquation, LevelFunction, Model, Phase};
use crate::number::{BinaryOperation, UnaryFunction};

/// Largest number of levels into which one is divided.
const MOST_BRANCHES: usize = 16;

/// Divides the kept equations of a model into factors and returns the models with one factor in the place of
/// each: the level is the union of theirs. `None` if no equation falls apart, or there are too many.
pub fn branches(model: &Model, kept: &[bool]) -> Option<Vec<Model>> {
    let mut found = vec![model.clone()];
    let mut is_whole = true;
    for index in (0..kept.len()).filter(|index| kept[*index]) {
        let Some(factors) = factors(model, &model.level[index]) else { continue };
        is_whole = false;
        if factors.len() * found.len() > MOST_BRANCHES {
            return None;
        }
        let with = |model: &Model, factor: &LevelFunction| {
            let mut model = model.clone();
            let equation = &mut model.level[index];
            (equation.function, equation.root) = (factor.clone(), None);
            model
        };
        let all =
            found.iter().flat_map(|model| factors.iter().map(move |factor| with(model, factor)));
        found = all.collect();
    }
    (!is_whole).then_some(found)
}

/// Returns the factors of an equation that has a value at every point.
fn factors(model: &Model, equation: &LevelEquation) -> Option<Vec<LevelFunction>> {
    let LevelFunction::Formula(formula) = &equation.function else { return None };
    let factors = formula.factors()?;
    let (graph, value) = record(model.free_components() + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(model.free_components());
        literally(|| Phase::new(model, parameters, state).level_function(&equation.function))
    })
    .ok()?;
    has_value_everywhere(&graph, value)
        .then(|| factors.into_iter().map(LevelFunction::Formula).collect())
}

/// Whether the form of a value that is recorded literally shows that it exists at every point.
fn has_value_everywhere(graph: &Graph, value: Expr) -> bool {
    use UnaryFunction::{Abs, Atan, Cos, Exp, Neg, Sin, Sqrt};
    let reached = graph.reached([value]);
    let mut is_not_negative = vec![false; reached.len()];
    for (place, step) in graph.steps_at(&reached) {
        let exists = match step {
            Step::Constant(_) | Step::Input(_) => true,
            Step::Unary(Sqrt, a) => is_not_negative[a],
            Step::Unary(function, _) => matches!(function, Neg | Abs | Exp | Sin | Cos | Atan),
            Step::Binary(operation, ..) => operation != BinaryOperation::Pow,
            Step::Power(_, exponent) => exponent.to_integer().is_some_and(|exponent| exponent >= 0),
        };
        if !exists {
            return false;
        }
        is_not_negative[place] = match step {
            Step::Constant(value) => !value.is_negative(),
            Step::Unary(function, _) => matches!(function, Sqrt | Abs | Exp),
            Step::Binary(BinaryOperation::Add, a, b) => is_not_negative[a] && is_not_negative[b],
            Step::Binary(BinaryOperation::Mul, a, b) => {
                a == b || is_not_negative[a] && is_not_negative[b]
            }
            Step::Power(_, exponent) => {
                exponent.to_integer().is_some_and(|exponent| exponent % 2 == 0)
            }
            _ => false,
        };
    }
    true
}
