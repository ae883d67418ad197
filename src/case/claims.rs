//! `[[claim]]`: what is claimed, where, and what is expected.

use super::body::formula;
use super::error::{CaseError, Problem};
use super::section::{Section, Text};
use super::{Claim, Expect, TABLE_ROWS};
use crate::claim::{Kind, Place};
use crate::formula::Type;
use crate::mechanics::{Model, Reach};

/// What a claim can state.
const STATEMENTS: [&str; 4] = ["integral", "density", "analytic-density", "position-density"];

/// Reads one claim; `taken` holds the names of those before it.
pub fn read(
    section: &Section<'_>,
    model: &Model,
    taken: &[Claim],
    default_source: &str,
) -> Result<Claim, CaseError> {
    section.allow(
        &[&STATEMENTS[..], &["name", "source", "where", "expect", "cell", "note"]].concat(),
    )?;
    let kind = kind(section, model)?;
    let (place, only_there) = place(section, model)?;
    let claim = Claim {
        name: name(section, &kind, taken)?,
        source: section.text("source")?.map_or(default_source.to_string(), |text| text.value),
        place,
        only_there,
        expect: expect(section)?,
        cell: cell(section)?,
        note: section.text("note")?.map(|text| text.value),
        kind,
    };
    Ok(claim)
}

fn other(text: &Text, message: String, remedy: &str) -> CaseError {
    CaseError::at(text.span.clone(), Problem::Other { message, remedy: remedy.to_string() })
}

fn kind(section: &Section<'_>, model: &Model) -> Result<Kind, CaseError> {
    let scalar = |text: &Text, what: &str| {
        formula(text, &model.vocabulary, what, Some(Type::Scalar), Reach::Phase)
    };
    let exists = |text: &Text, kind: Kind| match text.value.as_str() {
        "exists" => Ok(kind),
        found => Err(other(
            text,
            format!("`{found}` is not what can be claimed here"),
            "write \"exists\", and expect = \"fails\" where it does not",
        )),
    };
    let mut found = Vec::new();
    for key in STATEMENTS {
        if let Some(text) = section.text(key)? {
            found.push((key, text));
        }
    }
    let [(key, text)] = found.as_slice() else {
        let message = format!("a claim makes one statement, and this one {}", found.len());
        let remedy = format!("give one of {}", STATEMENTS.join(", "));
        return Err(CaseError::at(section.span.clone(), Problem::Other { message, remedy }));
    };
    let kind = match *key {
        "integral" => Kind::Integral(scalar(text, "an integral")?),
        "density" => Kind::Density(scalar(text, "a density")?),
        "analytic-density" => exists(text, Kind::AnalyticDensity)?,
        _ => exists(text, Kind::PositionDensity)?,
    };
    match kind.objection(model) {
        None => Ok(kind),
        Some(objection) => Err(other(text, objection, "see docs/writing-a-case.md")),
    }
}

fn name(section: &Section<'_>, kind: &Kind, taken: &[Claim]) -> Result<String, CaseError> {
    if let Some(text) = section.text("name")? {
        if taken.iter().any(|claim| claim.name == text.value) {
            let message = format!("two claims are called `{}`", text.value);
            return Err(other(&text, message, "give each claim a name of its own"));
        }
        return Ok(text.value);
    }
    let base = kind.formula().map_or(kind.name().to_string(), |f| f.text().to_string());
    let free = |name: &String| taken.iter().all(|claim| claim.name != *name);
    let numbered = (2..).map(|number| format!("{base} ({number})"));
    Ok(std::iter::once(base.clone()).chain(numbered).find(free).unwrap_or(base))
}

fn place(section: &Section<'_>, model: &Model) -> Result<(Place, bool), CaseError> {
    let Some(text) = section.text("where")? else { return Ok((Place::level(model), false)) };
    match text.value.trim() {
        "level" => Ok((Place::level(model), false)),
        "level only" => Ok((Place::level(model), true)),
        "everywhere" => Ok((Place::everywhere(model), false)),
        equation => Place::equation(model, equation).map(|place| (place, false)).ok_or_else(|| {
            let equations: Vec<&str> = model.level.iter().map(|e| e.text.as_str()).collect();
            let remedy = format!(
                "write \"level\", \"level only\", \"everywhere\", or one of the level's equations: {}",
                equations.join("; ")
            );
            other(&text, format!("`{equation}` is no place of this case"), &remedy)
        }),
    }
}

fn cell(section: &Section<'_>) -> Result<Option<String>, CaseError> {
    match section.text("cell")? {
        Some(text) if !TABLE_ROWS.contains(&text.value.as_str()) => {
            let remedy = format!("the rows are {}", TABLE_ROWS.join(", "));
            Err(other(&text, format!("`{}` is no row of the paper's tables", text.value), &remedy))
        }
        found => Ok(found.map(|text| text.value)),
    }
}

fn expect(section: &Section<'_>) -> Result<Expect, CaseError> {
    let Some(text) = section.text("expect")? else { return Ok(Expect::Holds) };
    match text.value.as_str() {
        "holds" => Ok(Expect::Holds),
        "fails" => Ok(Expect::Fails),
        "open" => Ok(Expect::Open),
        found => Err(other(
            &text,
            format!("`{found}` cannot be expected"),
            "write \"holds\", \"fails\" or \"open\"",
        )),
    }
}
