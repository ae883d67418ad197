//! Lines of the description of a system, as typed and as typeset.

use liouville::case::Case;
use liouville::formula::{Formula, Layout, Symbol, Type};
use liouville::mechanics::{Model, ParameterOrigin};
use liouville::number::rational::Rational;
use serde::{Serialize, Serializer};

/// A line of the description of a system; of a definition also as it is typeset.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemLine {
    /// Text of the line, such as `h = R*|γ|`.
    pub text: String,
    /// The same typeset; `None` for words.
    pub layout: Option<Layout>,
}

impl SystemLine {
    /// Line of words.
    pub fn words(text: impl Into<String>) -> Self {
        Self { text: text.into(), layout: None }
    }

    /// Line that gives the bracket of two variables.
    pub fn bracket([row, column]: [&str; 2], text: &str, value: Layout) -> Self {
        let name = |own: &str| Layout::name(own, Type::Scalar);
        let pair = Layout::Row(vec![name(row), Layout::Sign(","), name(column)]);
        let bracket = Layout::Fenced("{", Box::new(pair), "}");
        let layout = Some(Layout::equation(bracket, value));
        Self { text: format!("{{{row},{column}}} = {text}"), layout }
    }

    /// Line of an equation of the level.
    pub fn level(model: &Model, equation: &str) -> Self {
        let side = |text: &str| {
            let formula = Formula::parse(text, &model.vocabulary).ok()?;
            Some(boxes(model, &formula))
        };
        let sides = equation.split_once('=').filter(|(_, right)| !right.contains('='));
        let layout = sides.and_then(|(left, right)| {
            let equation = Layout::equation(side(left)?, side(right)?);
            Some(Layout::Row(vec![Layout::Word("level:"), Layout::Space, equation]))
        });
        Self { text: format!("level: {equation}"), layout }
    }

    /// Line of a parameter, `name = …` or `name in …`.
    fn parameter(
        name: &str,
        kind: Type,
        relation: &str,
        value: String,
        set: Option<Layout>,
    ) -> Self {
        let sign = if relation == "in" { "∈" } else { "=" };
        let row = |own| Layout::Row(vec![Layout::name(name, kind), Layout::Sign(sign), own]);
        Self { text: format!("{name} {relation} {value}"), layout: set.map(row) }
    }

    /// Line that gives a name, or a function of an argument, a formula.
    pub fn definition(model: &Model, name: &str, formula: &Formula) -> Self {
        let names = |symbol: Symbol| model.vocabulary.entry(symbol).name.clone();
        let (bare, argument) = match name.split_once('(') {
            Some((bare, rest)) => (bare, rest.strip_suffix(')')),
            None => (name, None),
        };
        let kind = formula.value_type();
        let mut left = vec![Layout::name(bare, kind)];
        left.extend(argument.map(|own| {
            let kind = if own == "z" { Type::Scalar } else { Type::VECTOR };
            Layout::Fenced("(", Box::new(Layout::name(own, kind)), ")")
        }));
        let layout = Layout::equation(Layout::Row(left), formula.layout(&names));
        Self { text: format!("{name} = {}", formula.text()), layout: Some(layout) }
    }
}

impl PartialEq<&str> for SystemLine {
    fn eq(&self, other: &&str) -> bool {
        self.text == *other
    }
}

impl Serialize for SystemLine {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text)
    }
}

/// Sets a formula of a model.
pub fn boxes(model: &Model, formula: &Formula) -> Layout {
    formula.layout(&|symbol: Symbol| model.vocabulary.entry(symbol).name.clone())
}

/// Largest number of decimal places that are printed.
const MOST_PLACES: usize = 24;

/// A number as a decimal, if it ends, and otherwise as a fraction.
fn decimal(value: &Rational) -> String {
    let (mut scaled, ten) = (value.abs(), Rational::from(10));
    for places in 0..=MOST_PLACES {
        if let Some(whole) = scaled.to_integer() {
            let digits = format!("{whole:0>width$}", width = places + 1);
            let (before, after) = digits.split_at(digits.len() - places);
            let sign = if value.is_negative() { "-" } else { "" };
            let dot = if places == 0 { "" } else { "." };
            return format!("{sign}{before}{dot}{after}");
        }
        scaled = &scaled * &ten;
    }
    value.to_string()
}

/// A value by its components: a vector as (a, b, c), a matrix as case files write it.
pub fn in_words(kind: Type, components: &[String]) -> String {
    match kind {
        Type::Matrix(..) => kind.as_setting(components),
        _ => kind.listed(components, ["(", ", ", ")"]),
    }
}

/// Parameters with what the case says of each.
pub fn parameters(case: &Case) -> Vec<SystemLine> {
    let own = case.model.parameters.iter().filter(|parameter| !parameter.name.contains('['));
    let digits = |text: &str| match text.strip_prefix(['-', '−']) {
        Some(text) => Layout::Row(vec![Layout::Sign("−"), Layout::Number(text.to_string())]),
        None => Layout::Number(text.to_string()),
    };
    let is_number =
        |text: &str| text.chars().all(|c| c.is_ascii_digit() || matches!(c, '.' | '-' | '/'));
    own.map(|parameter| {
        let (relation, value, set) = match &parameter.origin {
            ParameterOrigin::Fixed(values) => {
                let values: Vec<String> = values.iter().map(decimal).collect();
                let set = match values.as_slice() {
                    [one] => digits(one),
                    all => {
                        let all = Layout::listed(all.iter().map(|own| digits(own)));
                        Layout::Fenced("(", Box::new(all), ")")
                    }
                };
                let is_list = matches!(parameter.kind, Type::Scalar | Type::Vector(_));
                let text = in_words(parameter.kind, &values);
                ("=", text, Some(set).filter(|_| is_list))
            }
            ParameterOrigin::Formula(formula) => {
                ("=", formula.text().to_string(), Some(boxes(&case.model, formula)))
            }
            ParameterOrigin::Free(recipe) => {
                let text = recipe.text().to_string();
                let ends = text.split_once("..").map(|(low, high)| [low.trim(), high.trim()]);
                let set = ends.filter(|ends| ends.iter().all(|end| is_number(end))).map(|ends| {
                    let ends = Layout::listed(ends.map(digits));
                    Layout::Fenced("[", Box::new(ends), "]")
                });
                ("in", text, set)
            }
        };
        SystemLine::parameter(&parameter.name, parameter.kind, relation, value, set)
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_the_decimals_of_the_file() {
        let shown = |text: &str| decimal(&text.parse().expect("a number"));
        for text in ["0.0121505856", "-9.81", "12", "1/3", "-0.05"] {
            assert_eq!(shown(text), text);
        }
        assert_eq!(shown("3/8"), "0.375");
    }
}
