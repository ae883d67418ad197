//! Captions of figures: what was drawn, and with which parameters.

use liouville::case::Case;
use liouville::formula::Type;
use liouville::mechanics::ParameterOrigin;
use liouville::number::rational::Rational;
use liouville_draw::{Text, math, plain};

/// Largest number of components of a parameter that a caption shows.
const MOST_SHOWN: usize = 9;

/// Joins facts with commas.
pub fn listed(facts: impl IntoIterator<Item = Text>) -> Text {
    let mut all = facts.into_iter();
    let first = all.next().unwrap_or_default();
    all.fold(first, |text, fact| text.then(plain(", ")).then(fact))
}

/// Words that stay on one line.
pub fn unbroken(words: &str) -> String {
    words.replace(' ', "\u{a0}")
}

/// A name with its value.
pub fn equation(name: &str, value: &str) -> Text {
    math(name).then(plain(&unbroken(&format!(" = {}", value.replace('-', "−")))))
}

/// Surface of a section, set as an equation; that of a rolling body without one.
pub fn section(surface: Option<&str>) -> Text {
    let Some(surface) = surface else {
        return plain("section\u{a0}")
            .then(math("g"))
            .then(plain("\u{a0}=\u{a0}"))
            .then(math("g_0"));
    };
    let sides: Vec<&str> = surface.split('=').map(str::trim).collect();
    let sides = sides.into_iter().map(|side| math(&unbroken(side)));
    let equation = sides.reduce(|left, right| left.then(plain("\u{a0}=\u{a0}")).then(right));
    plain("section\u{a0}").then(equation.unwrap_or_default())
}

/// State at which motions start: its components but those of some names, or nothing if they are many.
pub fn start(case: &Case, state: &[Rational], without: &[&str]) -> Vec<Text> {
    let shown = case
        .model
        .state_names()
        .into_iter()
        .zip(state)
        .filter(|(name, _)| !without.contains(&name.as_str()));
    let all: Vec<Text> =
        shown.map(|(name, value)| equation(&name, &value.to_f64().0.to_string())).collect();
    if all.len() > MOST_SHOWN { Vec::new() } else { all }
}

/// Parameters of a case that have fixed values, but those of some names.
pub fn parameters(case: &Case, without: &[&str]) -> Vec<Text> {
    let one = |parameter: &liouville::mechanics::Parameter| match &parameter.origin {
        ParameterOrigin::Fixed(values)
            if values.len() <= MOST_SHOWN && !without.contains(&parameter.name.as_str()) =>
        {
            Some(equation(&parameter.name, &value(parameter.kind, values)))
        }
        _ => None,
    };
    case.model.parameters.iter().filter_map(one).collect()
}

/// A number, as a decimal where it is one: 0.0121505856, and 1/3.
fn number(value: &Rational) -> String {
    let text = value.to_f64().0.to_string();
    match text.parse::<Rational>().is_ok_and(|own| own == *value) {
        true => text,
        false => value.to_string(),
    }
}

fn value(kind: Type, values: &[Rational]) -> String {
    let listed = |values: &[&Rational]| {
        let words: Vec<String> = values.iter().map(|value| number(value)).collect();
        format!("({})", words.join(", "))
    };
    let all: Vec<&Rational> = values.iter().collect();
    match kind {
        Type::Scalar => all.first().map_or(String::new(), |value| number(value)),
        Type::Vector(_) => listed(&all),
        Type::Matrix(_, columns) => {
            let is_diagonal = |(place, x): (usize, &&Rational)| {
                place % (columns + 1) == 0 || **x == Rational::from(0)
            };
            if all.iter().enumerate().all(is_diagonal) {
                let entries = all.iter().step_by(columns + 1).copied().collect::<Vec<_>>();
                return format!("diag{}", listed(&entries));
            }
            let rows: Vec<String> = all.chunks(columns.max(1)).map(listed).collect();
            format!("({})", rows.join(", "))
        }
    }
}
