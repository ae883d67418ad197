//! Symmetric and skew matrices of the state, which are made of the entries above the diagonal.

use super::error::Problem;
use super::field::Names;
use crate::formula::{Formula, Scope, SymbolOrigin, Type, Value};
use crate::graph::{Expr, record};
use crate::mechanics::{MatrixShape, Meaning, ParameterOrigin, Variable, components as size};
use crate::proof::{Group, Prover};
use crate::scalar::Scalar;

/// Returns the variable as the file declares it.
pub fn written(variable: &Variable) -> Variable {
    match &variable.shape {
        Some(shape) => Variable {
            name: shape.name.clone(),
            kind: Type::Matrix(shape.rows, shape.rows),
            shape: None,
        },
        None => variable.clone(),
    }
}

/// Splits the rate of a matrix, given by formulas whose components make it up, into those of the
/// components, if it is proved to be a matrix of the same shape.
pub fn components(
    shape: &MatrixShape,
    whole: Vec<Formula>,
    names: Names<'_>,
) -> Result<Vec<Formula>, Problem> {
    let mut entries: Vec<Formula> = Vec::new();
    for formula in whole {
        if formula.value_type() == Type::Scalar {
            entries.push(formula);
            continue;
        }
        let bracketed = formula.bracketed();
        for place in formula.value_type().places() {
            entries.push(bracketed.component(&place).map_err(Problem::Formula)?);
        }
    }
    if !has_shape(shape, &entries, names) {
        let (word, sign, name) = match shape.is_skew {
            true => ("skew", "−", &shape.name),
            false => ("symmetric", "+", &shape.name),
        };
        return Err(Problem::Other {
            message: format!("the rate of the {word} matrix `{name}` is not known to be {word}"),
            remedy: format!("write (A {sign} Aᵀ)/2 for it, or declare `{name}` as a matrix(…)"),
        });
    }
    let rows = shape.rows;
    Ok(shape.places().map(|(i, j)| entries[i * rows + j].clone()).collect())
}

/// Whether entries are proved to be those of a matrix of this shape, as functions of independent
/// names.
fn has_shape(shape: &MatrixShape, entries: &[Formula], names: Names<'_>) -> bool {
    let rows = shape.rows;
    let kinds = names.vocabulary.iter().map(|(_, entry)| size(entry.kind));
    let recorded = record(kinds.sum(), |inputs| {
        let value = |entry: &Formula| valued(entry, names, inputs).components().first().copied();
        let values: Option<Vec<Expr>> = entries.iter().map(value).collect();
        let values = values.filter(|values| values.len() == rows * rows)?;
        let at = |i: usize, j: usize| values[i * rows + j];
        let both = (0..rows).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let defect = |(i, j): (usize, usize)| match shape.is_skew {
            true => at(i, j) + at(j, i),
            false => at(i, j) - at(j, i),
        };
        Some(both.map(defect).collect::<Vec<Expr>>())
    });
    let Ok((graph, Some(defects))) = recorded else { return false };
    let prover = Prover { sources: &[], extents: &[], seed: 1 };
    let outcomes = prover.prove(&graph, &[Group::of(defects)]);
    outcomes.is_ok_and(|outcomes| outcomes.iter().all(|outcome| outcome.is_zero()))
}

/// Evaluates a formula with inputs for the draws of parameters, and for the components of names
/// that are not defined by others.
fn valued(formula: &Formula, names: Names<'_>, inputs: &[Expr]) -> Value<Expr> {
    let Names { vocabulary, parameters } = names;
    formula.evaluate_literally(&mut |symbol| {
        let entry = vocabulary.entry(symbol);
        if let SymbolOrigin::Defined(definition) = vocabulary.origin(symbol) {
            return valued(definition, names, inputs);
        }
        let before = vocabulary.iter().take_while(|(other, _)| *other != symbol);
        let first: usize = before.map(|(_, entry)| size(entry.kind)).sum();
        let own = &inputs[first..first + size(entry.kind)];
        let parameter = match entry.meaning {
            Meaning::Parameter(index) => parameters.get(index),
            _ => None,
        };
        match parameter.map(|parameter| &parameter.origin) {
            Some(ParameterOrigin::Formula(definition)) => valued(definition, names, inputs),
            Some(ParameterOrigin::Fixed(values)) => {
                let values: Vec<Expr> = values.iter().map(Expr::rational).collect();
                Value::from_components(entry.kind, &values)
            }
            // A rotation needs fewer draws than it has components.
            Some(ParameterOrigin::Free(recipe)) if recipe.draws().len() <= own.len() => {
                recipe.make(&own[..recipe.draws().len()])
            }
            _ => Value::from_components(entry.kind, own),
        }
    })
}
