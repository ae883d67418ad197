//! Search for symmetry fields that are linear in the state: u = Σ a_ij x_i ∂/∂x_j + Σ b_j ∂/∂x_j
//! with [u,v] = c v.

use num_bigint::BigInt;
use num_traits::Zero;

use super::ask::{holds, judged, quoted};
use super::linear::Functions;
use super::terms::{integers, recorded, written};
use super::{Effort, Found, Report, SearchError};
use liouville::case::Case;
use liouville::claim::Place;
use liouville::formula::Type;
use liouville::graph::Expr;
use liouville::mechanics::calculus::dot;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Largest number of state components for which linear fields are tried.
const MOST: usize = 9;

/// Searches for symmetry fields; proved ones go into the report.
pub fn symmetries(case: &Case, effort: &Effort, report: &mut Report) -> Result<(), SearchError> {
    let model = &case.model;
    let dimension = model.dimension();
    if dimension > MOST || !model.extension.is_empty() {
        return Ok(());
    }
    let kept = Place::level(model).kept;
    // Fields x_i ∂/∂x_j and ∂/∂x_j, as pairs (i, j); followed by c.
    let sources = (0..dimension).map(Some).chain([None]);
    let fields: Vec<(Option<usize>, usize)> =
        sources.flat_map(|i| (0..dimension).map(move |j| (i, j))).collect();
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
    let relations = match Functions::new(case, &graph, &columns, effort.options.seed) {
        Err(SearchError::NoChart) => return Ok(()),
        functions => match functions?.relations() {
            Err(SearchError::NoPoints) => return Ok(()),
            relations => relations?,
        },
    };
    for vector in relations.rational().0 {
        let (shown, body) = spelled(case, &fields, &integers(&vector));
        let reports = judged(case, &[body], effort)?;
        if let Some(found) = reports.into_iter().find(holds) {
            report.found.push(Found::new("symmetry-field", &shown, None, found, model));
        }
    }
    Ok(())
}

fn zero() -> Expr {
    Expr::rational(&Rational::from(0))
}

/// Writes a field for the reader and as the body of a claim; the last multiple is the weight.
fn spelled(
    case: &Case,
    fields: &[(Option<usize>, usize)],
    multiples: &[BigInt],
) -> (String, String) {
    let names = component_names(case);
    let component = |j: usize| -> Option<String> {
        let own = fields.iter().zip(multiples).filter(|(field, _)| field.1 == j);
        let (texts, values): (Vec<&str>, Vec<BigInt>) = own
            .map(|((i, _), value)| (i.map_or("1", |i| names[i].as_str()), value.clone()))
            .unzip();
        Some(written(&values, &texts)).filter(|text| !text.is_empty())
    };
    let mut start = 0;
    let mut entries = Vec::new();
    for variable in &case.model.state {
        let texts: Vec<Option<String>> = (start..start + variable.len()).map(component).collect();
        start += variable.len();
        if texts.iter().all(Option::is_none) {
            continue;
        }
        let texts: Vec<String> =
            texts.into_iter().map(|text| text.unwrap_or_else(|| "0".to_string())).collect();
        let value = match variable.kind {
            Type::Scalar => texts.concat(),
            Type::Matrix(_, columns) => {
                let rows = texts.chunks(columns).map(|row| format!("[{}]", row.join(", ")));
                format!("[{}]", rows.collect::<Vec<String>>().join(", "))
            }
            Type::Vector(_) => format!("[{}]", texts.join(", ")),
        };
        entries.push((variable.name.clone(), value));
    }
    let shown: Vec<String> =
        entries.iter().map(|(name, value)| format!("{name}: {value}")).collect();
    let table: Vec<String> = entries
        .iter()
        .map(|(name, value)| format!("{} = {}", quoted(name), quoted(value)))
        .collect();
    let mut shown = shown.join(", ");
    let mut body = format!("symmetry-field = {{ {} }}", table.join(", "));
    if let Some(weight) = multiples.last().filter(|weight| !weight.is_zero()) {
        shown.push_str(&format!("; [u,v] = {weight} v"));
        body.push_str(&format!("\nweight = \"{weight}\""));
    }
    (shown, body)
}

/// Names the state's components: `ω1`, `x`.
fn component_names(case: &Case) -> Vec<String> {
    let mut names = Vec::new();
    for variable in &case.model.state {
        let name = &variable.name;
        names.extend(variable.kind.indices().iter().map(|index| format!("{name}{index}")));
    }
    names
}
