//! Parameters of a case as coordinates: the components that vary, by name.

use crate::terms::read;
use liouville::case::Case;
use liouville::formula::{Formula, Type};
use liouville::mechanics::ParameterOrigin;

/// Lists the components of the drawn parameters, including constant and equal ones.
pub fn components(case: &Case) -> Vec<Formula> {
    let model = &case.model;
    let drawn = model.parameters.iter().filter(|p| matches!(p.origin, ParameterOrigin::Free(_)));
    let names = drawn.flat_map(|parameter| {
        let name = &parameter.name;
        match parameter.kind {
            Type::Scalar => vec![name.clone()],
            Type::Vector(_) | Type::Matrix(..) if parameter.kind.size() > 9 => {
                let indices = parameter.kind.indices().into_iter();
                indices.map(|index| format!("{name}{index}")).collect()
            }
            Type::Vector(length) => (1..=length).map(|i| format!("{name}{i}")).collect(),
            Type::Matrix(rows, columns) => {
                let upper = rows == columns;
                let first = move |i: usize| if upper { i } else { 1 };
                let pairs = (1..=rows).flat_map(|i| (first(i)..=columns).map(move |j| (i, j)));
                let entry = |(i, j)| match name == "I" && i == j {
                    true => format!("I{i}"),
                    false => format!("{name}{i}{j}"),
                };
                pairs.map(entry).collect()
            }
        }
    });
    let names: Vec<String> = names.collect();
    read(names.iter().map(String::as_str), &model.vocabulary)
}
