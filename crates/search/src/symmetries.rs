//! Search for symmetry fields that are linear in the state: u = Σ a_ij x_i ∂/∂x_j + Σ b_j ∂/∂x_j
//! with [u,v] = c v.
//!
//! On a level such fields may be 0, or the same: of those that are equal there one is kept.

use num_bigint::BigInt;
use num_traits::Zero;

use super::ask::{holds, judged_alone};
use super::linear::{FunctionRelations, SampledFunctions};
use super::terms::{combined, integers, one, recorded, whole};
use super::{Effort, Found, FoundKind, SearchError, SearchReport};
use liouville::case::Case;
use liouville::claim::{Claim, LevelSubset};
use liouville::formula::{Formula, FormulaError};
use liouville::graph::{Expr, Graph};
use liouville::mechanics::elimination::dot;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Largest number of state components for which linear fields are tried.
const MOST_COMPONENTS: usize = 9;
/// Largest number of them for which constant fields are tried.
const MOST_CONSTANT: usize = 24;

/// Searches for symmetry fields; proved ones go into the report.
pub fn symmetries(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let model = &case.model;
    let dimension = model.dimension();
    if dimension > MOST_CONSTANT || !model.extension.is_empty() {
        return Ok(());
    }
    let kept = LevelSubset::level(model).kept;
    // Fields x_i ∂/∂x_j and ∂/∂x_j, as pairs (i, j); followed by c.
    let linear = if dimension > MOST_COMPONENTS { 0 } else { dimension };
    let sources = (0..linear).map(Some).chain([None]);
    let all: Vec<LinearField> = sources.flat_map(|i| (0..dimension).map(move |j| (i, j))).collect();
    let Some(fields) = distinct(case, all, effort)? else { return Ok(()) };
    let (graph, columns) = recorded(case, |jet| {
        let (state, field) = (jet.phase.state().to_vec(), jet.phase.field().to_vec());
        let axes = jet.along_axes().iter();
        let slopes: Vec<Vec<Expr>> =
            axes.map(|beside| beside.field().iter().map(|rate| rate.eps).collect()).collect();
        let normals = jet.level_gradients(&kept);
        let mut columns: Vec<Vec<Expr>> = fields
            .iter()
            .map(|(i, j)| {
                let size = i.map_or(Expr::rational(&Rational::from(1)), |i| state[i]);
                let along = |k: usize| size * slopes[*j][k];
                // (u·∇)v − (v·∇)u
                let commutator = (0..dimension).map(|k| match i {
                    Some(i) if k == *j => along(k) - field[*i],
                    _ => along(k),
                });
                let mut unit = vec![zero(); dimension];
                unit[*j] = size;
                commutator.chain(normals.iter().map(|normal| dot(normal, &unit))).collect()
            })
            .collect();
        let weight = field.iter().map(|rate| -*rate).chain(normals.iter().map(|_| zero()));
        columns.push(weight.collect());
        columns
    })?;
    let Some(relations) = relations(case, &graph, &columns, effort)? else { return Ok(()) };
    for vector in relations.rational()?.0 {
        effort.halt.check()?;
        let (shown, entries, claim) = spelled(case, &fields, &integers(&vector))?;
        // 0 is a multiple of a field that vanishes.
        if entries.is_empty() {
            continue;
        }
        if let Some(found) = judged_alone(case, claim, effort)?.filter(holds) {
            let parts: Vec<&Formula> = entries.iter().map(|(_, value)| value).collect();
            let found = Found::of_several(FoundKind::SymmetryField, shown, &parts, found, model);
            report.found.push(Found { fields: entries, ..found });
        }
    }
    Ok(())
}

/// Relations between columns; `None` if no states are known, or have values.
fn relations(
    case: &Case,
    graph: &Graph,
    columns: &[Vec<Expr>],
    effort: &Effort,
) -> Result<Option<FunctionRelations>, SearchError> {
    match SampledFunctions::with_symbols(case, graph, columns, effort) {
        Err(SearchError::NoChart) => Ok(None),
        functions => match functions?.relations() {
            Err(SearchError::NoPoints) => Ok(None),
            relations => relations.map(Some),
        },
    }
}

/// Keeps the fields that are no combination of others on the level, constant fields first.
fn distinct(
    case: &Case,
    fields: Vec<LinearField>,
    effort: &Effort,
) -> Result<Option<Vec<LinearField>>, SearchError> {
    let model = &case.model;
    if model.level.is_empty() {
        return Ok(Some(fields));
    }
    let (constant, mut ordered): (Vec<LinearField>, Vec<LinearField>) =
        fields.iter().partition(|(source, _)| source.is_none());
    ordered.splice(0..0, constant);
    let (graph, columns) = recorded(case, |jet| {
        let state = jet.phase.state();
        let of = |(i, j): &LinearField| {
            let mut value = vec![zero(); model.dimension()];
            value[*j] = i.map_or(Expr::rational(&Rational::from(1)), |i| state[i]);
            value
        };
        ordered.iter().map(of).collect::<Vec<_>>()
    })?;
    let Some(relations) = relations(case, &graph, &columns, effort)? else { return Ok(None) };
    let kept: Vec<LinearField> = relations.independent().into_iter().map(|k| ordered[k]).collect();
    Ok(Some(fields.into_iter().filter(|own| kept.contains(own)).collect()))
}

fn zero() -> Expr {
    Expr::rational(&Rational::from(0))
}

/// The field x_i ∂/∂x_j, or ∂/∂x_j.
type LinearField = (Option<usize>, usize);

/// Components of a field by variable.
type Components = Vec<(String, Formula)>;

/// Writes a field for the reader, with its components and the claim that it is a symmetry; the last
/// multiple is the weight.
fn spelled(
    case: &Case,
    fields: &[LinearField],
    multiples: &[BigInt],
) -> Result<(String, Components, Claim), SearchError> {
    let names = case.model.state_formulas()?;
    let component = |j: usize| -> Result<Option<Formula>, FormulaError> {
        let own = fields.iter().zip(multiples).filter(|(field, _)| field.1 == j);
        let (terms, values): (Vec<Formula>, Vec<BigInt>) = own
            .map(|((i, _), value)| (i.map_or(one(), |i| names[i].clone()), value.clone()))
            .unzip();
        combined(&values, &terms)
    };
    let mut start = 0;
    let mut entries = Vec::new();
    for variable in &case.model.state {
        let parts: Result<Vec<Option<Formula>>, FormulaError> =
            (start..start + variable.len()).map(component).collect();
        let parts = parts?;
        start += variable.len();
        if parts.iter().all(Option::is_none) {
            continue;
        }
        let parts: Vec<Formula> =
            parts.into_iter().map(|part| part.unwrap_or_else(|| Formula::number(0))).collect();
        entries.push((variable.name.clone(), variable.kind.filled(&parts)?));
    }
    let shown: Vec<String> =
        entries.iter().map(|(name, value)| format!("{name}: {value}")).collect();
    let mut shown = shown.join(", ");
    let mut claim = Claim::symmetry_field(entries.clone());
    if let Some(weight) = multiples.last().filter(|weight| !weight.is_zero()) {
        let one = BigInt::from(1);
        shown.push_str(&match weight {
            own if *own == one => "; [u,v] = v".to_string(),
            own if *own == -one => "; [u,v] = −v".to_string(),
            own => format!("; [u,v] = {own} v"),
        });
        claim = claim.with("weight", whole(weight));
    }
    Ok((shown, entries, claim))
}
