//! Straight-line programs of a case: the field, the level equations and the claims over named
//! inputs, for use outside the verifier.

use crate::case::Case;
use crate::formula::{Formula, Type};
use crate::graph::{Expr, Fault, Graph, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{Meaning, ParameterOrigin, Phase, components};
use crate::order::StableOrder;
use crate::requirement;

/// A case recorded as one graph, with names for its inputs and functions for its outputs.
pub struct Program {
    /// All operations.
    pub graph: Graph,
    /// Inputs in the order of the graph: free parameters, state, values of antiderivatives.
    pub inputs: Vec<Input>,
    /// Functions of the inputs.
    pub functions: Vec<NamedFunction>,
    /// Named intermediate values of the functions, component by component.
    pub named: Vec<NamedComponent>,
}

/// A named group of inputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// Canonical name.
    pub name: String,
    /// Type of the value, which gives the number of components and their order.
    pub kind: Type,
    /// Role of the input.
    pub role: InputRole,
}

/// The role of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputRole {
    /// A free parameter.
    Parameter,
    /// A variable of the state.
    State,
    /// The value of an antiderivative at the state, whose constant is free.
    Antiderivative,
}

/// The subject of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FunctionSubject {
    /// Time derivatives of the state's components; of a map, their images.
    Field,
    /// Differences of the sides of the level equations.
    Level,
    /// Value of the formula of a claim, by its index in the case.
    Value(usize),
    /// Numbers that vanish where a claim holds, by its index in the case.
    Residual(usize),
}

/// A function with several values.
pub struct NamedFunction {
    /// Subject of the function.
    pub part: FunctionSubject,
    /// Values, in order.
    pub outputs: Vec<Expr>,
    /// Operations of the formulas as written that the values do without: where one of them has no
    /// value, the function has none.
    pub required: Vec<Expr>,
}

/// A named value of the case.
pub struct NamedComponent {
    /// Canonical name.
    pub name: String,
    /// Type of the value.
    pub kind: Type,
    /// Components, in order.
    pub values: Vec<Expr>,
}

impl Program {
    /// Records the field, the level equations, and the claims of a case that `keep` accepts, by
    /// index. A function without values is left out.
    pub fn of(case: &Case, keep: impl Fn(usize) -> bool) -> Result<Self, Fault> {
        let model = &case.model;
        let free = model.free_components();
        let kept: Vec<usize> = (0..case.claims.len()).filter(|index| keep(*index)).collect();
        let (graph, (mut functions, named)) = record(free + model.dimension(), |inputs| {
            let (parameters, state) = inputs.split_at(free);
            let jet = DualPoint::new(Phase::new(model, parameters, state));
            let phase = &jet.phase;
            let level = model.level.iter().map(|e| phase.level_function(&e.function)).collect();
            let of_system = requirement::of_system(phase);
            let mut functions = vec![
                NamedFunction {
                    part: FunctionSubject::Field,
                    outputs: phase.field().to_vec(),
                    required: of_system.clone(),
                },
                NamedFunction {
                    part: FunctionSubject::Level,
                    outputs: level,
                    required: requirement::of_level(phase),
                },
            ];
            for index in kept.iter().copied() {
                let claim = &case.claims[index];
                let value = claim.kind.formula().map(|f| phase.evaluate(f).components());
                let residual = claim.kind.residual(&jet, &claim.place.kept);
                let of_value = requirement::of_formulas(phase, claim.kind.formula());
                let of_residual = requirement::of_claim(&jet, &claim.kind, &of_system);
                let own = [
                    (FunctionSubject::Value(index), value.unwrap_or_default(), of_value),
                    (FunctionSubject::Residual(index), residual, of_residual),
                ];
                functions.extend(own.map(|(part, outputs, required)| NamedFunction {
                    part,
                    outputs,
                    required,
                }));
            }
            functions.retain(|function| !function.outputs.is_empty());
            let formulas = kept.iter().flat_map(|index| case.claims[*index].kind.formulas());
            (functions, named(phase, formulas))
        })?;
        for function in &mut functions {
            function.required = graph.left_out(&function.outputs, &function.required);
        }
        let mut inputs: Vec<Input> = Vec::new();
        let of_role =
            |role: InputRole| move |name: &str, kind| Input { name: name.to_string(), kind, role };
        let parameter = of_role(InputRole::Parameter);
        inputs.extend(model.free_parameters().map(|own| parameter(&own.name, own.kind)));
        let state = of_role(InputRole::State);
        inputs.extend(model.state.iter().map(|own| state(&own.name, own.kind)));
        let count = free + model.dimension();
        inputs.extend((count..graph.inputs()).map(|index| {
            of_role(InputRole::Antiderivative)(
                &format!("integral_{}", index - count + 1),
                Type::Scalar,
            )
        }));
        Ok(Self { graph, inputs, functions, named })
    }

    /// Names of all input components in the order of the graph, with their roles.
    pub fn components(&self) -> Vec<(String, InputRole)> {
        let of = |input: &Input| {
            let (kind, role) = (input.kind, input.role);
            let name = input.name.clone();
            (0..components(kind)).map(move |place| (kind.component(&name, place), role))
        };
        self.inputs.iter().flat_map(of).collect()
    }
}

/// Records the parameters that are formulas, and the abbreviations and quantities named in some
/// formulas.
fn named<'f>(
    phase: &Phase<'_, Expr>,
    formulas: impl IntoIterator<Item = &'f Formula>,
) -> Vec<NamedComponent> {
    let model = phase.model();
    let mut symbols: Vec<_> = formulas.into_iter().flat_map(Formula::symbols).collect();
    let is_formula = |index: usize| {
        matches!(
            model.parameters.get(index).map(|own| &own.origin),
            Some(ParameterOrigin::Formula(_))
        )
    };
    let of_parameters = model.vocabulary.iter().filter(|(_, entry)| match entry.meaning {
        Meaning::Parameter(index) => is_formula(index),
        _ => false,
    });
    symbols.extend(of_parameters.map(|(symbol, _)| symbol));
    symbols.order();
    symbols.dedup();
    let is_named = |symbol: &crate::formula::Symbol| match model.vocabulary.entry(*symbol).meaning {
        Meaning::Parameter(index) => is_formula(index),
        Meaning::Abbreviation(_) | Meaning::Quantity(_) => true,
        Meaning::State(_) => false,
    };
    symbols
        .into_iter()
        .filter(is_named)
        .map(|symbol| {
            let entry = model.vocabulary.entry(symbol);
            let values = phase.value(symbol).components();
            NamedComponent { name: entry.name.clone(), kind: entry.kind, values }
        })
        .collect()
}
