//! From the text of a case file to a [`Case`].

use toml::de::DeTable;

use super::body::{self, formula};
use super::error::{CaseError, Problem};
use super::field::{self, State};
use super::parameters::{self, Setting};
use super::section::{Section, Text};
use super::{Case, Claim, Column, TABLE_ROWS, claims, homogeneous, solvable, weights};
use crate::formula::{Type, canonical_name};
use crate::mechanics::{
    Chart, Draw, LevelEquation, LevelFunction, Meaning, Model, Quantity, Range, Reach, System,
    Variable, Vocabulary, of_flat_base, of_rubber,
};

/// The keys of a case file.
const KEYS: [&str; 14] = [
    "title",
    "source",
    "note",
    "system",
    "check-weights",
    "table",
    "parameters",
    "dimensions",
    "body",
    "state",
    "field",
    "level",
    "let",
    "claim",
];

const SYSTEMS: &str = "rubber-plane, rubber-sphere, flat-base or field";

pub fn build(text: &str, settings: &[Setting]) -> Result<Case, CaseError> {
    let document = DeTable::parse(text).map_err(|error| not_toml(text, &error))?;
    if document.get_ref().is_empty() {
        return Err(CaseError::whole(Problem::Empty));
    }
    let root = Section::new("the file", document.get_ref(), 0..0, text);
    root.allow(&KEYS)?;
    let title = root.required("title", "add title = \"what the case is about\"")?.value;
    let source = root.text("source")?.map_or(String::new(), |source| source.value);
    let notes = root.texts("note")?.into_iter().map(|note| note.value).collect();

    let mut vocabulary = Vocabulary::default();
    let given = root.section("parameters")?;
    let parameters = parameters::read(given.as_ref(), settings, &mut vocabulary)?;
    let names_of_parameters = vocabulary.clone();
    let (system, mut parts) = parts(&root, &mut vocabulary, parameters, settings)?;
    parameters::unknown_setting(settings, &parts.model.parameters)?;
    if let System::Rubber(body) = &parts.model.system
        && let Some(shape) = homogeneous::extension(&parts.model, &body.shape)
    {
        let mut body = body.clone();
        body.shape = shape;
        parts.model.system = System::Rubber(body);
    }
    if let Some(level) = root.section("level")? {
        parts.chart = level_chart(&level, &parts, names_of_parameters)?;
    }
    let mut claims: Vec<Claim> = Vec::new();
    for section in root.sections("claim")? {
        claims.push(claims::read(&section, &parts.model, &claims, &source)?);
    }
    let check = root.boolean("check-weights")?.unwrap_or(true);
    let dimensions = root.section("dimensions")?;
    if check {
        weights::check(&root, &parts.model, dimensions.as_ref(), &claims)?;
    }
    let column = column(&root)?;
    let Parts { model, chart, free_draws } = parts;
    Ok(Case { title, source, system, model, chart, free_draws, claims, column, notes })
}

fn not_toml(text: &str, error: &toml::de::Error) -> CaseError {
    let span = error.span();
    let at = span.as_ref().and_then(|span| text.get(span.start..)).and_then(|s| s.chars().next());
    let help = at.filter(|c| c.is_alphabetic() && !c.is_ascii()).map(|_| {
        "a key that is not ASCII is quoted: \"μ\" = …; or write the letter's name: mu = …"
            .to_string()
    });
    CaseError { span, problem: Problem::Toml { message: error.message().to_string(), help } }
}

/// A model with the way its states are made.
struct Parts {
    model: Model,
    chart: Chart,
    free_draws: Vec<Draw>,
}

/// Reads what the kind of system asks for.
fn parts(
    root: &Section<'_>,
    vocabulary: &mut Vocabulary,
    mut parameters: Vec<crate::mechanics::Parameter>,
    settings: &[Setting],
) -> Result<(String, Parts), CaseError> {
    let own_field = root.section("field")?;
    let own_state = root.section("state")?;
    let text = match (root.text("system")?, &own_field) {
        (Some(text), _) => text,
        (None, Some(_)) => Text::made("field".to_string(), 0..0),
        (None, None) => {
            let remedy = format!("add system = \"…\" with {SYSTEMS}");
            return Err(root.missing("system", &remedy));
        }
    };
    let nothing = DeTable::new();
    let body = || root.section("body").map(|found| found.unwrap_or(root.empty("[body]", &nothing)));
    let mut level = Vec::new();
    let (system, state, chart) = match text.value.as_str() {
        "rubber-plane" | "rubber-sphere" => {
            let (section, curved) = (body()?, text.value == "rubber-sphere");
            let features = body::features(&section, curved, vocabulary);
            let state = fixed_state(&[("ω", Type::Vector), ("γ", Type::Vector)], &[]);
            declare(root, vocabulary, &state, of_rubber(features), &text)?;
            let lets = abbreviations(root, vocabulary)?;
            let system = body::rubber(&section, curved, settings, vocabulary, &mut parameters)?;
            section.finish()?;
            level = rolling_level();
            ((system, lets), state, Chart::Rolling)
        }
        "flat-base" => {
            let section = body()?;
            let near = Draw::Within(Range::between((-3, 2), (3, 2)));
            let names = ["ω1", "ω2", "r1", "r2"].map(|name| (name, Type::Scalar));
            let state = fixed_state(&names, &[near.clone(), near.clone(), near.clone(), near]);
            declare(root, vocabulary, &state, of_flat_base(), &text)?;
            let lets = abbreviations(root, vocabulary)?;
            let system = body::flat_base(&section, vocabulary)?;
            section.finish()?;
            ((system, lets), state, Chart::Free)
        }
        "field" => {
            let section = own_field.as_ref().ok_or_else(|| {
                root.missing("field", "add a table [field] with \"x'\" = \"…\" for each variable")
            })?;
            let ranges = own_state.as_ref().ok_or_else(|| {
                root.missing("state", "add a table [state] with x = \"-2..2\" for each variable")
            })?;
            let state = field::state(ranges, vocabulary)?;
            let lets = abbreviations(root, vocabulary)?;
            let rates = field::rates(section, &state.variables, vocabulary)?;
            if let Some(section) = root.section("level")? {
                level = field::equations(&section, vocabulary)?;
            }
            ((System::Field(rates), lets), state, Chart::Free)
        }
        found => {
            let (message, remedy) = (format!("`{found}` is no system"), format!("write {SYSTEMS}"));
            return Err(CaseError::at(text.span, Problem::Other { message, remedy }));
        }
    };
    let (system, abbreviations) = system;
    let model = Model {
        system,
        vocabulary: vocabulary.clone(),
        parameters,
        state: state.variables,
        abbreviations,
        level,
    };
    Ok((text.value, Parts { model, chart, free_draws: state.draws }))
}

fn fixed_state(variables: &[(&str, Type)], draws: &[Draw]) -> State {
    let variable = |(name, kind): &(&str, Type)| Variable { name: name.to_string(), kind: *kind };
    State { variables: variables.iter().map(variable).collect(), draws: draws.to_vec() }
}

fn rolling_level() -> Vec<LevelEquation> {
    vec![
        LevelEquation { text: "|γ| = 1".to_string(), function: LevelFunction::UnitNormal },
        LevelEquation { text: "(ω,γ) = 0".to_string(), function: LevelFunction::NoSpin },
    ]
}

/// Adds the state and the system's quantities; a parameter may hide a quantity, not a variable.
fn declare(
    root: &Section<'_>,
    vocabulary: &mut Vocabulary,
    state: &State,
    quantities: Vec<(&'static str, Quantity, Type, Reach)>,
    system: &Text,
) -> Result<(), CaseError> {
    let given = root.section("parameters")?;
    let place = |name: &str| {
        let entries = given.as_ref().map(Section::entries).unwrap_or_default();
        let named = |(key, _): &(&toml::Spanned<std::borrow::Cow<'_, str>>, _)| {
            canonical_name(key.get_ref()).as_deref() == Some(name)
        };
        entries.iter().find(|entry| named(entry)).map(|(key, _)| key.span())
    };
    for (index, variable) in state.variables.iter().enumerate() {
        if vocabulary.find(&variable.name).is_some() {
            let reason = format!("it is a state variable of {}", system.value);
            let problem = Problem::BadName { name: variable.name.clone(), reason };
            return Err(CaseError { problem, span: place(&variable.name) });
        }
        let reach = if variable.name == "γ" { Reach::Configuration } else { Reach::Phase };
        vocabulary.add(&variable.name, Meaning::State(index), variable.kind, reach);
    }
    for (name, quantity, kind, reach) in quantities {
        if vocabulary.find(name).is_none() {
            vocabulary.add(name, Meaning::Quantity(quantity), kind, reach);
        }
    }
    Ok(())
}

/// Reads `[let]`: each abbreviation may use those before it.
fn abbreviations(
    root: &Section<'_>,
    vocabulary: &mut Vocabulary,
) -> Result<Vec<crate::formula::Formula>, CaseError> {
    let mut formulas = Vec::new();
    let Some(section) = root.section("let")? else { return Ok(formulas) };
    for (key, value) in section.entries() {
        let bad = |reason: &str| {
            let (name, reason) = (key.get_ref().to_string(), reason.to_string());
            CaseError::at(key.span(), Problem::BadName { name, reason })
        };
        let name = canonical_name(key.get_ref())
            .ok_or_else(|| bad("a name is letters, then digits, primes or _"))?;
        if let Some(entry) = vocabulary.find(&name)
            && !matches!(entry.meaning, Meaning::Quantity(_))
        {
            return Err(bad("it is taken already"));
        }
        let text = section.as_text(key.get_ref(), value)?;
        let read = formula(&text, vocabulary, &name, None, Reach::Phase)?;
        let reach = vocabulary.reach(&read).map_or(Reach::Parameters, |entry| entry.reach);
        vocabulary.add(&name, Meaning::Abbreviation(formulas.len()), read.value_type(), reach);
        formulas.push(read);
    }
    Ok(formulas)
}

/// The chart of a level set of the user's own: given, solved for, or none.
fn level_chart(
    section: &Section<'_>,
    parts: &Parts,
    names: Vocabulary,
) -> Result<Chart, CaseError> {
    let own = matches!(parts.model.system, System::Field(_));
    if !own {
        return Err(CaseError::at(
            section.span.clone(),
            Problem::Other {
                message: "the level set of this system is known".to_string(),
                remedy: "remove [level]".to_string(),
            },
        ));
    }
    section.value("equations");
    let chart = match section.section("chart")? {
        Some(chart) => field::chart(&chart, &parts.model, names)?,
        None => match solvable::steps(&parts.model) {
            Some(steps) => Chart::Solved(steps),
            None => Chart::Numerical,
        },
    };
    section.finish()?;
    Ok(chart)
}

fn column(root: &Section<'_>) -> Result<Option<Column>, CaseError> {
    let Some(section) = root.section("table")? else { return Ok(None) };
    let remedy = "write table = { number = 1, column = 2 }";
    let table = section.integer("number")?.ok_or_else(|| section.missing("number", remedy))?;
    let column = section.integer("column")?.ok_or_else(|| section.missing("column", remedy))?;
    let mut words = Vec::new();
    for row in TABLE_ROWS {
        if let Some(text) = section.text(row)? {
            words.push((row.to_string(), text.value));
        }
    }
    section.finish()?;
    Ok(Some(Column { table, column, words }))
}
