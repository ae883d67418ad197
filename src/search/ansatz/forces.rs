//! The same body with another potential or rotor, and free constants in front of them.

use crate::case::Case;
use crate::formula::{Formula, Type};
use crate::mechanics::{
    Draw, Meaning, Model, Origin, Parameter, Potential, Range, Reach, Recipe, System,
};

/// A model whose potential is the one that it has and a further term; nothing if it takes none, or if
/// the text is no function of the configuration.
pub fn with_potential(model: &Model, further: &str) -> Option<Model> {
    let mut changed = model.clone();
    let System::Rubber(body) = &mut changed.system else { return None };
    let text = match &body.potential {
        None => further.to_string(),
        Some(Potential::Formula(own)) => format!("{} + {further}", own.text()),
        Some(Potential::Arbitrary(_)) => return None,
    };
    let vocabulary = &changed.vocabulary;
    let read = Formula::parse(&text, vocabulary).ok()?;
    let reach = vocabulary.reach(&read).map_or(Reach::Parameters, |entry| entry.reach);
    if read.value_type() != Type::Scalar || reach > Reach::Configuration {
        return None;
    }
    body.potential = Some(Potential::Formula(read));
    Some(changed)
}

/// A model with a rotor; nothing if it has one, or takes none.
pub fn with_gyrostat(model: &Model, rotor: &str) -> Option<Model> {
    let mut changed = model.clone();
    let read = Formula::parse(rotor, &changed.vocabulary).ok()?;
    let own = match &mut changed.system {
        System::Rubber(body) => &mut body.gyrostat,
        System::FlatBase(body) => &mut body.gyrostat,
        _ => return None,
    };
    if own.is_some() {
        return None;
    }
    *own = Some(read);
    Some(changed)
}

/// The case with so many further free numbers, and their names.
pub fn with_constants(case: &Case, letter: &str, count: usize) -> (Case, Vec<String>) {
    let mut extended = case.clone();
    let model = &mut extended.model;
    let is_free = |name: &String| case.model.vocabulary.find(name).is_none();
    let names: Vec<String> =
        (1..).map(|k| format!("{letter}{k}")).filter(is_free).take(count).collect();
    for name in &names {
        let meaning = Meaning::Parameter(model.parameters.len());
        let range = Range::between((-2, 1), (2, 1));
        model.parameters.push(Parameter {
            name: name.clone(),
            kind: Type::Scalar,
            origin: Origin::Free(Recipe::Scalar(Draw::Within(range))),
        });
        model.vocabulary.add(name, meaning, Type::Scalar, Reach::Parameters);
    }
    (extended, names)
}

/// Σ constant · part.
pub fn combination<'t>(parts: impl Iterator<Item = (&'t String, &'t String)>) -> String {
    let term = |(constant, part): (&String, &String)| match part.starts_with('[') {
        true => format!("{constant}*{part}"),
        false => format!("{constant}*({part})"),
    };
    parts.map(term).collect::<Vec<_>>().join(" + ")
}
