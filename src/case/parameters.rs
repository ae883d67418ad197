//! Parameters: numbers, lists, ranges and formulas.

use toml::Spanned;

use super::error::{CaseError, Problem};
use super::section::{Section, Text};
use super::shapes::{Given, Refusal, TENSORS, given};
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
        let written = match (given(&name, value, vocabulary), section) {
            (Ok(written), _) => written,
            (Err(Refusal::Size(error, start)), Some(section)) => {
                let text = section.as_text(key.get_ref(), value)?;
                let place = start + error.span().start..start + error.span().end;
                return Err(CaseError::at(text.locate(place), Problem::Formula(error)));
            }
            (Err(Refusal::Size(error, _)), None) => {
                return Err(CaseError::at(value.span(), Problem::Formula(error)));
            }
            (Err(Refusal::Message(message)), _) => {
                return Err(CaseError::at(value.span(), Problem::Parameter(message)));
            }
        };
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
