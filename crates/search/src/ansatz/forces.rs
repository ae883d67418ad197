//! Variants of a body with another potential or rotor, and with further free constants.

use liouville::case::Case;
use liouville::formula::{Formula, Type};
use liouville::mechanics::{
    Draw, Meaning, Model, Origin, Parameter, Potential, Range, Reach, Recipe, System,
};

/// Adds a term to the potential of a model; `None` if the system takes no potential, or if the text
/// is not a function of the configuration.
pub fn with_potential(model: &Model, further: &str) -> Option<Model> {
    let mut changed = model.clone();
    let body = changed.system.body_mut()?;
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

/// Adds a rotor to a model; `None` if it has one already, or takes none.
pub fn with_gyrostat(model: &Model, rotor: &str) -> Option<Model> {
    let mut changed = model.clone();
    let read = Formula::parse(rotor, &changed.vocabulary).ok()?;
    let own = match &mut changed.system {
        System::FlatBase(body) => &mut body.gyrostat,
        system => &mut system.body_mut()?.gyrostat,
    };
    if own.is_some() {
        return None;
    }
    *own = Some(read);
    Some(changed)
}

/// Adds `count` free numbers to the case and returns their names.
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

/// Writes Σ constant · part.
pub fn combination<'t>(parts: impl Iterator<Item = (&'t String, &'t String)>) -> String {
    let term = |(constant, part): (&String, &String)| match part.starts_with('[') {
        true => format!("{constant}*{part}"),
        false => format!("{constant}*({part})"),
    };
    parts.map(term).collect::<Vec<_>>().join(" + ")
}
