//! Construction of a [`Case`] from the text of a file.

use std::collections::BTreeSet;

use toml::de::DeTable;

use super::claims::ClaimContext;
use super::clock::Places;
use super::error::{CaseError, Mistake, Problem};
use super::mistakes::Mistakes;
use super::parameters::{self, Setting};
use super::section::CaseTable;
use super::stated::{ReadClaims, Time};
use super::systems::{ModelParts, Reading};
use super::{
    Case, CaseRemark, Column, TABLE_ROWS, charts, homogeneous, implied, lists, map, one_sided,
    poincare, remarks, repeated_constraints, shadows, simplified, toml_errors, turning, variables,
    velocities, weights,
};
use crate::mechanics::{Chart, Model, Surface, System};

/// The keys of a case file.
const KEYS: [&str; 21] = [
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
    "map",
    "hamiltonian",
    "lagrangian",
    "level",
    "let",
    "variables",
    "poisson",
    "section",
    "one-sided",
    "claim",
];

/// Facts that a file leaves to be inferred from its formulas.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Assumed {
    /// Use of time.
    pub time: Time,
    /// Names of the lists that are diagonal matrices; the others are vectors.
    pub diagonal: BTreeSet<String>,
}

impl Assumed {
    /// Whether the list of this name is a diagonal matrix.
    pub fn is_diagonal(&self, name: &str) -> bool {
        self.diagonal.contains(name)
    }
}

/// Result of one attempt to read a file.
pub struct Attempt {
    case: Option<Case>,
    /// Names of the claims that were read, by their places.
    places: Places,
    /// Whether claims or abbreviations were left out, as they use `t`.
    leaves_out: bool,
    /// Whether a formula outside of claims and abbreviations uses `t`, which is not declared.
    lacks_time: bool,
    /// Whether the system was read without mistakes, so that all claims could be judged.
    pub is_whole: bool,
    /// Mistakes found in the attempt.
    pub mistakes: Vec<Mistake>,
    /// Parameters that are lists of numbers.
    pub lists: Vec<String>,
}

pub fn build(text: &str, settings: &[Setting]) -> Result<Case, CaseError> {
    let (document, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        return Err(CaseError::new(toml_errors::mistakes(text, &errors), text));
    }
    if document.get_ref().is_empty() {
        return Err(CaseError::whole(Problem::Empty));
    }
    let read = |assumed: &Assumed| Attempt::new(text, document.get_ref(), settings, assumed);
    let attempt = lists::settled(&|diagonal| {
        let with = |time: Time| read(&Assumed { time, diagonal: diagonal.clone() });
        let attempt = with(Time::Absent);
        if attempt.lacks_time {
            return with(Time::Present(BTreeSet::new()));
        }
        match attempt.leaves_out {
            true => with(Time::Present(attempt.places.keys().copied().collect())).beside(attempt),
            false => attempt,
        }
    });
    match attempt.case {
        Some(case) if attempt.mistakes.is_empty() => Ok(case),
        _ => Err(CaseError::new(attempt.mistakes, text)),
    }
}

/// Notes taken while a file is read.
#[derive(Default)]
struct Noted {
    lists: Vec<String>,
    places: Places,
    leaves_out: bool,
    is_whole: bool,
}

impl Attempt {
    fn new(text: &str, table: &DeTable<'_>, settings: &[Setting], assumed: &Assumed) -> Self {
        let mistakes = Mistakes::default();
        let mut noted = Noted::default();
        let case = {
            let root = CaseTable::new("the file", table, 0..0, text, &mistakes);
            read(&root, settings, assumed, &mut noted)
        };
        let Noted { lists, places, leaves_out, is_whole } = noted;
        let leaves_out = leaves_out || mistakes.leaves_out();
        let lacks_time = mistakes.lacks_time_since(0);
        let mistakes = mistakes.into_list();
        Self { case, places, leaves_out, lacks_time, is_whole, mistakes, lists }
    }

    /// Attaches the same system without `t`; the mistakes of either stop both.
    fn beside(mut self, other: Self) -> Self {
        match (&mut self.case, other.case) {
            (Some(case), Some(without)) => {
                case.attach_without_time(&self.places, without, &other.places);
                self
            }
            (Some(_), None) => Self { case: None, ..other },
            (None, _) => self,
        }
    }
}

/// Reads a file; where there are mistakes, the result is invalid.
fn read(
    root: &CaseTable<'_>,
    settings: &[Setting],
    assumed: &Assumed,
    noted: &mut Noted,
) -> Option<Case> {
    let mistakes = root.mistakes();
    if !root.allow(&KEYS) && root.entries().iter().any(|(_, value)| value.get_ref().is_table()) {
        // an unknown table may declare anything
        let known = |key: &str| KEYS.contains(&key);
        let declares = |(key, value): &(&toml::Spanned<std::borrow::Cow<'_, str>>, _)| {
            let value: &&toml::Spanned<toml::de::DeValue<'_>> = value;
            !known(key.get_ref()) && value.get_ref().is_table()
        };
        if root.entries().iter().any(declares) {
            mistakes.blind();
        }
    }
    let title = root.keep(root.required("title", "add title = \"what the case is about\""));
    let source = root.keep(root.text("source")).flatten();
    let source = source.map_or(String::new(), |source| source.value);
    let notes = root.keep(root.texts("note")).unwrap_or_default();

    let mut reading = Reading::new(root, settings, assumed);
    reading.read_parameters();
    noted.lists.append(&mut reading.lists);
    let (system, mut parts) = reading.read()?;
    if let (Some(section), true) = (root.table("hamiltonian"), system != "field") {
        root.mistakes().add(section.complaint(Problem::Other {
            message: "[hamiltonian] gives a vector field".to_string(),
            remedy: "write system = \"field\", or remove [hamiltonian]".to_string(),
        }));
    }
    one_of_field_and_map(root, &system);
    map::no_open_constant(root, &parts.model);
    parameters::unknown_settings(root, settings, &parts.model.parameters);
    let has_variables = variables::read(root, &mut parts.model);
    // the parts below are judged only if everything read so far is complete
    let is_whole = parts.is_whole && has_variables && mistakes.is_empty();
    let (mut warnings, mut remarks) = (Vec::new(), Vec::<CaseRemark>::new());
    if is_whole {
        extend_support(&mut parts.model);
        let counted_once = repeated_constraints::count_factors_once(&mut parts.model);
        remarks.extend(counted_once.into_iter().map(CaseRemark::from));
        let left_out = implied::leave_out_constraints(&mut parts.model);
        remarks.extend(left_out.into_iter().map(CaseRemark::from));
        warnings.extend(root.keep(velocities::check(root, &parts.model)).unwrap_or_default());
        turning::no_moving_surface(root, &parts.model);
        let simplified = simplified::simplify(root, &mut parts.model);
        remarks.extend(simplified.into_iter().map(CaseRemark::from));
    }
    read_chart(root, &mut parts);
    if is_whole && mistakes.is_empty() {
        note_masses(&mut parts);
    }
    let section = poincare::read(root);
    let plan_is_whole = section.is_some() || root.value("section").is_none();
    let context = ClaimContext {
        model: &parts.model,
        is_whole: is_whole && plan_is_whole,
        plan: section.as_ref(),
        source: &source,
    };
    let ReadClaims { claims, motions, absences, places, leaves_out } =
        ReadClaims::new(root, &context, &assumed.time);
    (noted.places, noted.leaves_out) = (places, leaves_out);
    noted.is_whole = is_whole;
    let check = root.keep(root.boolean("check-weights")).flatten().unwrap_or(true);
    let dimensions = root.table("dimensions");
    let column = root.keep(column(root)).flatten();
    let one_sided = one_sided::read(root, &parts.model);
    if check && is_whole {
        weights::check(root, &parts.model, dimensions.as_ref(), &claims);
    }
    if !mistakes.is_empty() {
        return None;
    }
    let hidden = parts.hidden.iter().map(|name| shadows::warning(&parts.model.vocabulary, name));
    let alike = parts.alike.iter().cloned();
    let bare = one_sided
        .as_ref()
        .and_then(|_| one_sided::warning(claims.len() + absences.len(), &motions));
    let warnings =
        hidden.chain(alike).chain(warnings).chain(of_chart(&parts)).chain(bare).collect();
    let ModelParts { model, chart, free_draws, .. } = parts;
    let is_without_claims = claims.is_empty() && motions.is_empty() && absences.is_empty();
    remarks.extend(remarks::remarks(root, &system, &model, &claims, is_without_claims));
    Some(Case {
        title: title?.value,
        source,
        system,
        model,
        chart,
        free_draws,
        claims,
        motions,
        absences,
        column,
        section,
        one_sided,
        notes: notes.into_iter().map(|note| note.value).collect(),
        warnings,
        remarks,
        without_time: None,
    })
}

/// Rejects a table of rates in a map, and a table of images in a field.
fn one_of_field_and_map(root: &CaseTable<'_>, system: &str) {
    let (unread, message, remedy) = match system {
        "map" => (
            "field",
            "a map has images, and no rates",
            "remove [field], or write system = \"field\" and remove [map]",
        ),
        _ => (
            "map",
            "[map] defines a discrete map, and this system is a flow",
            "remove [map], or write system = \"map\" and remove [field]",
        ),
    };
    if let Some(section) = root.table(unread) {
        let (message, remedy) = (message.to_string(), remedy.to_string());
        root.mistakes().add(section.complaint(Problem::Other { message, remedy }));
    }
}

/// Extends a support function that is not homogeneous of degree 1 off the unit sphere.
pub fn extend_support(model: &mut Model) {
    let surface = |system: &System| match system {
        System::Ball(ball) => match &ball.surface {
            Surface::Support(shape) => Some(shape.clone()),
            Surface::Level(_) | Surface::Arbitrary(_) => None,
        },
        _ => system.body().map(|body| body.shape.clone()),
    };
    let Some(shape) = surface(&model.system) else { return };
    let Some(extended) = homogeneous::extension(model, &shape) else { return };
    match &mut model.system {
        System::Ball(ball) => ball.surface = Surface::Support(extended),
        system => {
            if let Some(body) = system.body_mut() {
                body.shape = extended;
            }
        }
    }
}

/// Notes how the accelerations of a Lagrangian are solved for, and for which listed values nothing moves.
fn note_masses(parts: &mut ModelParts) {
    let ModelParts { model, chart, free_draws, .. } = parts;
    let solver = match &model.system {
        System::Lagrangian(own) => Some(own.acceleration_solver(model, chart, free_draws)),
        _ => None,
    };
    if let (System::Lagrangian(own), Some(solver)) = (&mut model.system, solver) {
        own.solver = solver;
    }
    model.undetermined = model.find_undetermined();
}

/// Reads the chart of a user-defined level set: given, solved for, or none.
fn read_chart(root: &CaseTable<'_>, parts: &mut ModelParts) {
    let is_lagrangian = matches!(parts.model.system, System::Lagrangian(_));
    let is_own = parts.model.system.is_given_by_formulas();
    let Some(section) = root.table("level") else {
        if (is_lagrangian || is_own) && !parts.model.level.is_empty() {
            parts.chart = Chart::Equations;
        }
        return;
    };
    if !is_lagrangian && !is_own {
        root.mistakes().add(Mistake::at(
            section.span.clone(),
            Problem::Other {
                message: "the level set of this system is fixed".to_string(),
                remedy: "remove [level]".to_string(),
            },
        ));
        return;
    }
    section.value("equations");
    match root.keep(section.section("chart")).flatten() {
        Some(chart) => {
            if let Some(chart) = charts::chart(&chart, &parts.model, &parts.free_draws) {
                parts.chart = chart;
            }
        }
        None => parts.chart = Chart::Equations,
    }
    section.finish();
}

/// Warnings for a chart that may not cover the whole level set.
fn of_chart(parts: &ModelParts) -> Vec<String> {
    match &parts.chart {
        Chart::Given(_) => {
            vec!["verdicts on the level speak of the image of [level.chart]".to_string()]
        }
        _ => Vec::new(),
    }
}

fn column(root: &CaseTable<'_>) -> Result<Option<Column>, Mistake> {
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
    let caption = section.text("caption")?.map(|text| text.value);
    let notes = section.texts("notes")?.into_iter().map(|text| text.value).collect();
    section.finish();
    Ok(Some(Column { table, column, words, caption, notes }))
}
