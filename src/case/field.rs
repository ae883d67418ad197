//! `[state]`, `[field]`, `[level]`: a system of the user's own.

use super::body::formula;
use super::error::{CaseError, Problem};
use super::section::{Section, Text};
use super::shapes::{Refusal, given, state_draws};
use crate::formula::{Formula, Type, canonical_name};
use crate::mechanics::{
    Chart, Draw, GivenChart, LevelEquation, LevelFunction, Meaning, Model, Reach, Variable,
    Vocabulary,
};

/// State variables with the draws of their components.
pub struct State {
    /// The variables in order.
    pub variables: Vec<Variable>,
    /// One draw a component.
    pub draws: Vec<Draw>,
}

/// Reads a table of names and ranges; `reach` is what it means to depend on them.
pub fn state(
    section: &Section<'_>,
    vocabulary: &mut Vocabulary,
    reach: Reach,
) -> Result<State, CaseError> {
    let mut state = State { variables: Vec::new(), draws: Vec::new() };
    add_state(section, vocabulary, reach, &mut state)?;
    Ok(state)
}

/// Reads further state variables.
pub fn add_state(
    section: &Section<'_>,
    vocabulary: &mut Vocabulary,
    reach: Reach,
    state: &mut State,
) -> Result<(), CaseError> {
    for (key, value) in section.entries() {
        let bad = |name: &str, reason: &str| {
            let (name, reason) = (name.to_string(), reason.to_string());
            CaseError::at(key.span(), Problem::BadName { name, reason })
        };
        let name = canonical_name(key.get_ref())
            .ok_or_else(|| bad(key.get_ref(), "a name is letters, then digits, primes or _"))?;
        if vocabulary.find(&name).is_some() {
            return Err(bad(&name, "it is taken already"));
        }
        let remedy = "write \"-2..2\", \"vector(-1..1)\" or \"matrix(-1..1)\"";
        let wrong = |message: String| {
            CaseError::at(value.span(), Problem::Other { message, remedy: remedy.to_string() })
        };
        let given = given(&name, value, vocabulary).map_err(|refusal| match refusal {
            Refusal::Message(message) => wrong(message),
            Refusal::Size(error, _) => CaseError::at(value.span(), Problem::Formula(error)),
        })?;
        let (kind, draws) = state_draws(&given).ok_or_else(|| {
            wrong(format!("`{name}` needs the range that its states are drawn from"))
        })?;
        vocabulary.add(&name, Meaning::State(state.variables.len()), kind, reach);
        state.variables.push(Variable { name, kind });
        state.draws.extend(draws);
    }
    Ok(())
}

/// Reads the rates: one formula a state variable, under its name with or without a prime.
pub fn rates(
    section: &Section<'_>,
    variables: &[Variable],
    vocabulary: &Vocabulary,
) -> Result<Vec<Formula>, CaseError> {
    let mut rates: Vec<Option<Formula>> = vec![None; variables.len()];
    for (key, value) in section.entries() {
        let name = canonical_name(key.get_ref()).unwrap_or_default();
        let plain = name.strip_suffix('\'').unwrap_or(&name);
        let Some(index) = variables.iter().position(|variable| variable.name == plain) else {
            let message = format!("`{}` is the rate of no state variable", key.get_ref());
            let names: Vec<&str> = variables.iter().map(|v| v.name.as_str()).collect();
            let remedy = format!("[state] has {}; write \"x'\" = \"…\"", names.join(", "));
            return Err(CaseError::at(key.span(), Problem::Other { message, remedy }));
        };
        if rates[index].is_some() {
            let reason = format!("the rate of `{plain}` is given twice");
            let name = key.get_ref().to_string();
            return Err(CaseError::at(key.span(), Problem::BadName { name, reason }));
        }
        let text = section.as_text(key.get_ref(), value)?;
        let what = format!("the rate of {plain}");
        let kind = Some(variables[index].kind);
        rates[index] = Some(formula(&text, vocabulary, &what, kind, Reach::Phase)?);
    }
    let missing = rates.iter().position(Option::is_none).map(|index| &variables[index].name);
    match missing {
        None => Ok(rates.into_iter().flatten().collect()),
        Some(name) => Err(CaseError::at(
            section.span.clone(),
            Problem::Other {
                message: format!("[field] has no rate for `{name}`"),
                remedy: format!("add \"{name}'\" = \"…\""),
            },
        )),
    }
}

/// Reads `equations = ["(γ,γ) = 1", …]`.
pub fn equations(
    section: &Section<'_>,
    vocabulary: &Vocabulary,
) -> Result<Vec<LevelEquation>, CaseError> {
    let read = equations_in(section, "equations", vocabulary, Reach::Phase)?.into_iter();
    let equation =
        |(text, function)| LevelEquation { text, function: LevelFunction::Formula(function) };
    Ok(read.map(equation).collect())
}

/// Reads a list of equations: the text, and the difference of both sides, which may depend on no
/// more than `reach`.
pub fn equations_in(
    section: &Section<'_>,
    key: &'static str,
    vocabulary: &Vocabulary,
    reach: Reach,
) -> Result<Vec<(String, Formula)>, CaseError> {
    let mut level = Vec::new();
    for text in section.texts(key)? {
        let Some((left, right)) = text.value.split_once('=') else {
            let message = format!("each of `{key}` has two sides");
            let remedy = "write \"(γ,γ) = 1\"".to_string();
            return Err(CaseError::at(text.span, Problem::Other { message, remedy }));
        };
        let read = |side: &str, start: usize| {
            let span = text.locate(start..start + side.len());
            Formula::parse(side, vocabulary).map_err(|error| {
                let inner = error.span();
                let place = text.locate(start + inner.start..start + inner.end);
                CaseError::at(place, Problem::Formula(error))
            })?;
            Ok::<_, CaseError>(span)
        };
        read(left, 0)?;
        read(right, left.len() + 1)?;
        let difference = match right.trim() {
            "0" => left.trim().to_string(),
            _ => format!("({left}) − ({right})"),
        };
        let difference = Text::made(difference, text.span.clone());
        let scalar = Some(Type::Scalar);
        let function = formula(&difference, vocabulary, "each side", scalar, reach)?;
        level.push((text.value.trim().to_string(), function));
    }
    Ok(level)
}

/// Reads `[level.chart]`: inputs with ranges, and a formula for each state variable.
///
/// `names` holds the parameters alone; the chart's formulas see them and the inputs.
pub fn chart(
    section: &Section<'_>,
    model: &Model,
    mut names: Vocabulary,
) -> Result<Chart, CaseError> {
    let inputs = section
        .section("inputs")?
        .ok_or_else(|| section.missing("inputs", "a chart needs inputs = { u = \"-2..2\", … }"))?;
    let State { variables, draws } = state(&inputs, &mut names, Reach::Phase)?;
    let mut formulas: Vec<Option<Formula>> = vec![None; model.state.len()];
    let mut abbreviations = Vec::new();
    for (key, value) in section.entries() {
        if key.get_ref() == "inputs" {
            continue;
        }
        let name = canonical_name(key.get_ref()).unwrap_or_default();
        let Some(index) = model.state.iter().position(|variable| variable.name == name) else {
            let message = format!("`{}` is no state variable", key.get_ref());
            let remedy = "a chart gives a formula for each state variable".to_string();
            return Err(CaseError::at(key.span(), Problem::Other { message, remedy }));
        };
        let text = section.as_text(key.get_ref(), value)?;
        let kind = model.state[index].kind;
        let read = formula(&text, &names, &name, Some(kind), Reach::Phase)?;
        // The formulas that follow may use this variable.
        names.add(&name, Meaning::Abbreviation(abbreviations.len()), kind, Reach::Phase);
        abbreviations.push(read.clone());
        formulas[index] = Some(read);
    }
    // A state variable of an input's name is that input.
    for (formula, own) in formulas.iter_mut().zip(&model.state) {
        let is_input = variables.iter().any(|v| v.name == own.name && v.kind == own.kind);
        if formula.is_none() && is_input {
            *formula = Formula::parse(&own.name, &names).ok();
        }
    }
    if let Some(index) = formulas.iter().position(Option::is_none) {
        let name = &model.state[index].name;
        return Err(CaseError::at(
            section.span.clone(),
            Problem::Other {
                message: format!("the chart has no formula for `{name}`"),
                remedy: format!("add {name} = \"…\" under [level.chart]"),
            },
        ));
    }
    let model = Model {
        vocabulary: names,
        state: variables,
        abbreviations,
        level: Vec::new(),
        extension: Vec::new(),
        variables: None,
        ..model.clone()
    };
    let formulas = formulas.into_iter().flatten().collect();
    Ok(Chart::Given(Box::new(GivenChart { model, draws, formulas })))
}
