//! Parameters: numbers, lists, ranges and formulas.

use toml::Spanned;
use toml::de::DeValue;

use super::error::{CaseError, Problem};
use super::section::{Section, Text, numbers};
use crate::formula::{Formula, FormulaError, Scope, Type, canonical_name};
use crate::graph;
use crate::mechanics::{Draw, Line, Meaning, Origin, Parameter, Range, Reach, Recipe, Vocabulary};
use crate::number::rational::{Rational, RationalError};

/// A value given on the command line in place of the file's.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The canonical name of a parameter.
    pub name: String,
    /// The constant typed for it.
    pub value: String,
}

/// Names that a list of three numbers gives a diagonal matrix.
const TENSORS: [&str; 2] = ["I", "B"];

/// Reads `[parameters]` and adds them to the vocabulary; settings replace the file's values.
pub fn read(
    section: Option<&Section<'_>>,
    settings: &[Setting],
    vocabulary: &mut Vocabulary,
) -> Result<Vec<Parameter>, CaseError> {
    let mut parameters: Vec<Parameter> = Vec::new();
    let mut formulas = Vec::new();
    let mut kinds = Vec::new();
    for (key, value) in section.map(Section::entries).unwrap_or_default() {
        let name = named(key)?;
        if parameters.iter().any(|known| known.name == name) {
            let reason = "it is declared twice".to_string();
            return Err(CaseError::at(key.span(), Problem::BadName { name, reason }));
        }
        let setting = settings.iter().find(|setting| setting.name == name);
        let written = origin(&name, value)
            .map_err(|message| CaseError::at(value.span(), Problem::Parameter(message)))?;
        kinds.push(written.kind());
        let origin = setting.map_or(written, |setting| set(setting, &name));
        let (kind, origin) = match origin {
            Given::Fixed(kind, values) => (kind, Origin::Fixed(values)),
            Given::Drawn(recipe) => (recipe.kind(), Origin::Free(recipe)),
            Given::Formula(text) => {
                let text = match (setting, section) {
                    (None, Some(section)) => section.as_text(key.get_ref(), value)?,
                    _ => Text::made(text, 0..0),
                };
                formulas.push((parameters.len(), text));
                (Type::Scalar, Origin::Fixed(Vec::new()))
            }
        };
        parameters.push(Parameter { name, kind, origin });
    }
    for (index, parameter) in parameters.iter().enumerate() {
        if formulas.iter().all(|(formula, _)| *formula != index) {
            declare(parameter, index, vocabulary);
        }
    }
    for (index, text) in formulas {
        let formula = Formula::parse(&text.value, vocabulary).map_err(|error| {
            let name = &parameters[index].name;
            match settings.iter().find(|setting| setting.name == *name) {
                Some(setting) => refused(setting, &error),
                None => CaseError::at(text.locate(error.span()), Problem::Formula(error)),
            }
        })?;
        let found = formula.value_type();
        if let Some(setting) = settings.iter().find(|set| set.name == parameters[index].name)
            && let Some(kind) = kinds[index].filter(|kind| *kind != found)
        {
            let problem = format!("`{}` is a {kind}, and this is a {found}", setting.name);
            return Err(set_to(setting, &problem, "give a value of the same kind"));
        }
        parameters[index].kind = found;
        parameters[index].origin = match constant(&formula) {
            Some(values) => Origin::Fixed(values),
            None => Origin::Formula(formula),
        };
        declare(&parameters[index], index, vocabulary);
    }
    Ok(parameters)
}

/// The complaint about a value that was not in the file.
fn refused(setting: &Setting, error: &FormulaError) -> CaseError {
    let constant = "give a constant: 5/4, [1,2,3], [[…],[…],[…]]";
    set_to(setting, error.message(), error.help().unwrap_or(constant))
}

fn set_to(setting: &Setting, problem: &str, remedy: &str) -> CaseError {
    let message = format!("--set {}={}: {problem}", setting.name, setting.value);
    CaseError::whole(Problem::Other { message, remedy: remedy.to_string() })
}

fn declare(parameter: &Parameter, index: usize, vocabulary: &mut Vocabulary) {
    let meaning = Meaning::Parameter(index);
    vocabulary.add(&parameter.name, meaning, parameter.kind, Reach::Parameters);
}

/// The name that a key of the user's is.
pub fn named(key: &Spanned<std::borrow::Cow<'_, str>>) -> Result<String, CaseError> {
    canonical_name(key.get_ref()).ok_or_else(|| {
        let reason = "a name is letters, then digits, primes or _".to_string();
        CaseError::at(key.span(), Problem::BadName { name: key.get_ref().to_string(), reason })
    })
}

/// Complains about a setting whose name no parameter has.
pub fn unknown_setting(settings: &[Setting], parameters: &[Parameter]) -> Result<(), CaseError> {
    let known = |name: &str| parameters.iter().any(|parameter| parameter.name == name);
    match settings.iter().find(|setting| !known(&setting.name)) {
        None => Ok(()),
        Some(setting) => {
            let names: Vec<&str> = parameters.iter().map(|p| p.name.as_str()).collect();
            let known =
                if names.is_empty() { "no parameters".to_string() } else { names.join(", ") };
            Err(CaseError::whole(Problem::Other {
                message: format!("there is no parameter `{}` to set", setting.name),
                remedy: format!("this case has {known}"),
            }))
        }
    }
}

/// What a value of `[parameters]` or `[state]` says.
pub enum Given {
    /// Components that are fixed.
    Fixed(Type, Vec<Rational>),
    /// Components drawn anew for every state.
    Drawn(Recipe),
    /// Anything else: to be read as a formula.
    Formula(String),
}

impl Given {
    /// Scalar, vector or matrix, where that is known before formulas are read.
    fn kind(&self) -> Option<Type> {
        match self {
            Given::Fixed(kind, _) => Some(*kind),
            Given::Drawn(recipe) => Some(recipe.kind()),
            Given::Formula(_) => None,
        }
    }
}

fn set(setting: &Setting, name: &str) -> Given {
    let text = setting.value.trim();
    let list = text.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
    if TENSORS.contains(&name)
        && let Some(list) = list.filter(|list| !list.contains('['))
    {
        return Given::Formula(format!("diag({list})"));
    }
    Given::Formula(text.to_string())
}

/// The meaning of a value.
pub fn origin(name: &str, value: &Spanned<DeValue<'_>>) -> Result<Given, String> {
    match value.get_ref() {
        DeValue::Integer(number) => fixed_scalar(&number.to_string()),
        DeValue::Float(number) => fixed_scalar(&number.to_string()),
        DeValue::Array(array) => {
            if let Some(entries) = numbers(array) {
                let values = read_all(&entries)?;
                return match values.len() {
                    3 if TENSORS.contains(&name) => {
                        Ok(Given::Fixed(Type::Matrix, diagonal(values)))
                    }
                    3 => Ok(Given::Fixed(Type::Vector, values)),
                    found => Err(format!("a list needs three numbers, not {found}")),
                };
            }
            let rows: Option<Vec<Vec<String>>> = array
                .iter()
                .map(|row| match row.get_ref() {
                    DeValue::Array(row) => numbers(row).filter(|row| row.len() == 3),
                    _ => None,
                })
                .collect();
            match rows.filter(|rows| rows.len() == 3) {
                Some(rows) => Ok(Given::Fixed(Type::Matrix, read_all(&rows.concat())?)),
                None => Err("a matrix is three rows of three numbers".to_string()),
            }
        }
        DeValue::String(text) => described(text.trim()),
        _ => Err("a parameter is a number, a list, a range or a formula".to_string()),
    }
}

fn fixed_scalar(text: &str) -> Result<Given, String> {
    Ok(Given::Fixed(Type::Scalar, read_all(&[text.to_string()])?))
}

fn read_all(texts: &[String]) -> Result<Vec<Rational>, String> {
    texts
        .iter()
        .map(|text| text.parse().map_err(|error: RationalError| error.to_string()))
        .collect()
}

fn diagonal(values: Vec<Rational>) -> Vec<Rational> {
    let mut entries = vec![Rational::from(0); 9];
    for (k, value) in values.into_iter().enumerate() {
        entries[4 * k] = value;
    }
    entries
}

/// A string: a number, a range with its shape, a list of alternatives, or a formula.
fn described(text: &str) -> Result<Given, String> {
    if let Ok(number) = text.parse::<Rational>() {
        return Ok(Given::Fixed(Type::Scalar, vec![number]));
    }
    if text == "rotation" {
        return Ok(Given::Drawn(Recipe::Rotation));
    }
    if let Some(list) = text.strip_prefix("one of ") {
        let values: Vec<String> = list.split(',').map(|item| item.trim().to_string()).collect();
        return Ok(Given::Drawn(Recipe::Scalar(Draw::OneOf(read_all(&values)?))));
    }
    let (shape, inner) = match text.split_once('(') {
        Some((shape, rest)) if text.ends_with(')') => (shape.trim(), &rest[..rest.len() - 1]),
        _ => ("", text),
    };
    let Some((low, high)) = inner.split_once("..") else {
        return Ok(Given::Formula(text.to_string()));
    };
    let range = range(low, high)?;
    let draw = || Draw::Within(range.clone());
    let recipe = match shape {
        "" => Recipe::Scalar(draw()),
        "vector" => Recipe::Vector(draw()),
        "matrix" => Recipe::Matrix(draw()),
        "diag" => Recipe::Diagonal(draw()),
        "spherical" => Recipe::Spherical(draw()),
        "inertia" => Recipe::Inertia(range),
        "axisymmetric" => Recipe::AxisymmetricInertia(range),
        "full" => Recipe::FullInertia(range),
        other => return Err(format!("`{other}(a..b)` is no kind of parameter")),
    };
    Ok(Given::Drawn(recipe))
}

fn range(low: &str, high: &str) -> Result<Range, String> {
    let read = |text: &str| text.parse::<Rational>().map_err(|error| error.to_string());
    let range = Range { low: read(low)?, high: read(high)? };
    let (width, _) = (&range.high - &range.low).to_f64();
    match range.low < range.high {
        false => Err(format!("the range {}..{} is empty", range.low, range.high)),
        true if width.is_normal() => Ok(range),
        true => Err("this range is beyond the numbers that f64 can hold".to_string()),
    }
}

/// The components of a formula without names, exactly.
pub fn constant(formula: &Formula) -> Option<Vec<Rational>> {
    if formula.symbols().next().is_some() {
        return None;
    }
    let (graph, values) = graph::record(0, |_| {
        formula.evaluate::<graph::Expr>(&mut |_| unreachable!("it has no symbols")).components()
    })
    .ok()?;
    values.into_iter().map(|value| graph.constant_value(value).cloned()).collect()
}

/// A range for each component of a state variable.
pub fn state_draws(given: &Given) -> Option<(Type, Vec<Draw>)> {
    match given {
        Given::Drawn(recipe @ (Recipe::Scalar(_) | Recipe::Vector(_) | Recipe::Matrix(_))) => {
            Some((recipe.kind(), recipe.draws()))
        }
        _ => None,
    }
}

/// Free parameters that hold the coefficients of an arbitrary function.
pub fn coefficients(
    prefix: &str,
    exponents: &[[u32; 3]],
    range: &Range,
    settings: &[Setting],
    parameters: &mut Vec<Parameter>,
) -> Result<(), CaseError> {
    for [i, j, k] in exponents {
        let name = format!("{prefix}[{i},{j},{k}]");
        let origin = match settings.iter().find(|setting| setting.name == name) {
            None => Origin::Free(Recipe::Scalar(Draw::Of(Line::All, range.clone()))),
            Some(setting) => match setting.value.trim().parse() {
                Ok(value) => Origin::Fixed(vec![value]),
                Err(error) => {
                    let error: RationalError = error;
                    return Err(set_to(setting, &error.to_string(), "give a number"));
                }
            },
        };
        parameters.push(Parameter { name, kind: Type::Scalar, origin });
    }
    Ok(())
}

/// Is this name declared as a parameter of this kind?
pub fn has(vocabulary: &Vocabulary, name: &str, kind: Type) -> bool {
    vocabulary.lookup(name).is_some_and(|(_, found)| found == kind)
}
