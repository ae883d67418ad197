//! From the text of a case file to a [`Case`].

use toml::de::DeTable;

use super::error::{CaseError, Problem};
use super::parameters::{self, Setting};
use super::section::Section;
use super::systems::{self, Parts};
use super::{
    Case, Column, TABLE_ROWS, claims, field, homogeneous, one_sided, poincare, shadows, variables,
    velocities, weights,
};
use crate::mechanics::{Chart, LevelFunction, Model, Surface, System, Vocabulary};

/// The keys of a case file.
const KEYS: [&str; 19] = [
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
    "lagrangian",
    "level",
    "let",
    "variables",
    "poisson",
    "section",
    "one-sided",
    "claim",
];

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
    let (system, mut parts) = systems::read(&root, vocabulary, parameters, settings)?;
    parameters::unknown_setting(settings, &parts.model.parameters)?;
    extend_support(&mut parts);
    let mut warnings: Vec<String> = parts.hidden.iter().map(|n| shadows::warning(n)).collect();
    warnings.extend(velocities::check(&root, &parts.model)?);
    variables::read(&root, &mut parts.model)?;
    no_open_level(&root, &parts.model)?;
    if let Some(level) = root.section("level")? {
        parts.chart = level_chart(&level, &parts, names_of_parameters)?;
    } else if matches!(parts.model.system, System::Lagrangian(_)) && !parts.model.level.is_empty() {
        parts.chart = Chart::Equations;
    }
    warnings.extend(of_chart(&parts));
    let section = poincare::read(&root)?;
    let (mut claims, mut motions, mut names) = (Vec::new(), Vec::new(), Vec::new());
    for stated in root.sections("claim")? {
        if claims::is_about_motion(&stated) {
            let plan = section.as_ref();
            let claim = claims::read_motion(&stated, &parts.model, plan, &names, &source)?;
            names.push(claim.name.clone());
            motions.push(claim);
        } else {
            let claim = claims::read(&stated, &parts.model, &names, &source)?;
            names.push(claim.name.clone());
            claims.push(claim);
        }
    }
    let check = root.boolean("check-weights")?.unwrap_or(true);
    let dimensions = root.section("dimensions")?;
    if check {
        weights::check(&root, &parts.model, dimensions.as_ref(), &claims)?;
    }
    let column = column(&root)?;
    let one_sided = one_sided::read(&root, &parts.model)?;
    let Parts { model, chart, free_draws, .. } = parts;
    Ok(Case {
        title,
        source,
        system,
        model,
        chart,
        free_draws,
        claims,
        motions,
        column,
        section,
        one_sided,
        notes,
        warnings,
    })
}

/// A level set is not fixed by an equation whose constant is open.
fn no_open_level(root: &Section<'_>, model: &Model) -> Result<(), CaseError> {
    for equation in &model.level {
        let LevelFunction::Formula(function) = &equation.function else { continue };
        if model.has_antiderivative(function) {
            let span = root.find(&equation.text).map(|start| start..start + equation.text.len());
            let message = format!("`{}` contains an ∫, whose constant is open", equation.text);
            let remedy = "write the antiderivative out".to_string();
            return Err(CaseError { span, problem: Problem::Other { message, remedy } });
        }
    }
    Ok(())
}

/// Off the unit sphere, a support function that is not homogeneous of degree 1 is extended.
fn extend_support(parts: &mut Parts) {
    let shape = match &parts.model.system {
        System::Rubber(body) => &body.shape,
        System::Ball(ball) => match &ball.surface {
            Surface::Support(shape) => shape,
            Surface::Level(_) => return,
        },
        _ => return,
    };
    let Some(extended) = homogeneous::extension(&parts.model, shape) else { return };
    match &mut parts.model.system {
        System::Rubber(body) => body.shape = extended,
        System::Ball(ball) => ball.surface = Surface::Support(extended),
        _ => {}
    }
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

/// The chart of a level set of the user's own: given, solved for, or none.
fn level_chart(
    section: &Section<'_>,
    parts: &Parts,
    names: Vocabulary,
) -> Result<Chart, CaseError> {
    let own = matches!(parts.model.system, System::Field(_) | System::Lagrangian(_));
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
        None => Chart::Equations,
    };
    section.finish()?;
    Ok(chart)
}

/// Which part of the level set a chart makes, where that may not be all of it.
fn of_chart(parts: &Parts) -> Vec<String> {
    match &parts.chart {
        Chart::Given(_) => {
            vec!["verdicts on the level speak of the image of [level.chart]".to_string()]
        }
        _ => Vec::new(),
    }
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
