//! `[[claim]]`: what is claimed, where, and what is expected.

use super::body::formula;
use super::error::{CaseError, Problem};
use super::section::{Section, Text};
use super::{Claim, Expect, MotionClaim, SectionPlan, TABLE_ROWS};
use crate::claim::motion::{Beginning, MOTIONS, Motion};
use crate::claim::{Kind, Place, Reader, STATEMENTS};
use crate::formula::{Formula, Type, canonical_name};
use crate::mechanics::{Model, Reach, Vocabulary};

/// The keys of every claim.
const COMMON: [&str; 6] = ["name", "source", "where", "expect", "cell", "note"];

/// The keys of a claim about motion.
const COMMON_OF_MOTIONS: [&str; 4] = ["name", "source", "expect", "note"];

/// Is this a claim about motion?
pub fn is_about_motion(section: &Section<'_>) -> bool {
    MOTIONS.iter().any(|key| section.value(key).is_some())
}

/// Reads one claim; `taken` holds the names of those before it.
pub fn read(
    section: &Section<'_>,
    model: &Model,
    taken: &[String],
    default_source: &str,
) -> Result<Claim, CaseError> {
    let kind = kind(section, model)?;
    let (place, only_there) = place(section, model)?;
    let claim = Claim {
        name: name(section, kind.text().unwrap_or_else(|| kind.name().to_string()), taken)?,
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

/// Reads one claim about motion; `plan` is the section of the case.
pub fn read_motion(
    section: &Section<'_>,
    model: &Model,
    plan: Option<&SectionPlan>,
    taken: &[String],
    default_source: &str,
) -> Result<MotionClaim, CaseError> {
    let mut stated = MOTIONS.iter().chain(STATEMENTS).filter(|key| section.value(key).is_some());
    let (key, second) = (stated.next().copied().unwrap_or_default(), stated.next());
    section.allow(&[MOTIONS, STATEMENTS, &COMMON_OF_MOTIONS, Motion::companions(key)].concat())?;
    let entries = Entries { section, model };
    let kind = match (Motion::read(key, &entries), second) {
        (Some(kind), None) => kind?,
        _ => return Err(one_statement(section, 2)),
    };
    if plan.is_none() && matches!(kind.beginning(), Beginning::Section(_)) {
        return Err(section.complaint(Problem::Other {
            message: "the motion starts on a section, and the case has none".to_string(),
            remedy: "add [section] with g0 and energy, or give state = { … }".to_string(),
        }));
    }
    Ok(MotionClaim {
        name: name(section, kind.text(), taken)?,
        source: section.text("source")?.map_or(default_source.to_string(), |text| text.value),
        expect: expect(section)?,
        note: section.text("note")?.map(|text| text.value),
        kind,
    })
}

fn one_statement(section: &Section<'_>, given: usize) -> CaseError {
    let message = format!("a claim makes one statement, and this one {given}");
    let remedy = format!("give one of {}", [STATEMENTS, MOTIONS].concat().join(", "));
    CaseError::at(section.span.clone(), Problem::Other { message, remedy })
}

fn other(text: &Text, message: String, remedy: &str) -> CaseError {
    CaseError::at(text.span.clone(), Problem::Other { message, remedy: remedy.to_string() })
}

fn kind(section: &Section<'_>, model: &Model) -> Result<Kind, CaseError> {
    let given: Vec<&str> =
        STATEMENTS.iter().copied().filter(|key| section.value(key).is_some()).collect();
    let companions = given.first().map_or(&[][..], |key| Kind::companions(key));
    section.allow(&[STATEMENTS, MOTIONS, &COMMON, companions].concat())?;
    let entries = Entries { section, model };
    let read = match given.as_slice() {
        [key] => Kind::read(key, &entries),
        _ => None,
    };
    let Some(kind) = read else { return Err(one_statement(section, given.len())) };
    let kind = kind?;
    match kind.objection(model) {
        None => Ok(kind),
        Some(objection) => Err(entries.complaint(kind.name(), objection.message, objection.remedy)),
    }
}

/// The entries of a claim in a case file.
struct Entries<'e, 's> {
    section: &'e Section<'s>,
    model: &'e Model,
}

impl Reader for Entries<'_, '_> {
    type Error = CaseError;

    fn model(&self) -> &Model {
        self.model
    }

    fn text(&self, key: &'static str) -> Result<Option<String>, CaseError> {
        Ok(self.section.text(key)?.map(|text| text.value))
    }

    fn texts(&self, key: &'static str) -> Result<Option<Vec<String>>, CaseError> {
        if self.section.value(key).is_none() {
            return Ok(None);
        }
        let texts = self.section.texts(key)?;
        Ok(Some(texts.into_iter().map(|text| text.value).collect()))
    }

    fn formula_in(
        &self,
        key: &'static str,
        kind: Option<Type>,
        scope: &Vocabulary,
    ) -> Result<Option<Formula>, CaseError> {
        let Some(text) = self.section.text(key)? else { return Ok(None) };
        formula(&text, scope, &format!("`{key}`"), kind, Reach::Phase).map(Some)
    }

    fn list(&self, key: &'static str) -> Result<Option<Vec<Formula>>, CaseError> {
        if self.section.value(key).is_none() {
            return Ok(None);
        }
        let texts = self.section.texts(key)?;
        let read =
            |text: &Text| formula(text, &self.model.vocabulary, "an entry", None, Reach::Phase);
        texts.iter().map(read).collect::<Result<_, _>>().map(Some)
    }

    fn equation(&self, key: &'static str) -> Result<(Formula, Formula), CaseError> {
        let text = self.section.text(key)?.ok_or_else(|| self.missing(key))?;
        let Some((left, right)) = text.value.split_once('=') else {
            let message = format!("`{key}` has two sides");
            return Err(other(&text, message, "write \"A = B\""));
        };
        let read = |side: &str, start: usize| {
            Formula::parse(side, &self.model.vocabulary).map_err(|error| {
                let span = error.span();
                let place = text.locate(start + span.start..start + span.end);
                CaseError::at(place, Problem::Formula(error))
            })
        };
        Ok((read(left, 0)?, read(right, left.len() + 1)?))
    }

    fn table_in(
        &self,
        key: &'static str,
        scope: &Vocabulary,
    ) -> Result<Option<Vec<(String, Formula)>>, CaseError> {
        let Some(section) = self.section.section(key)? else { return Ok(None) };
        let mut entries = Vec::new();
        for (key, value) in section.entries() {
            let name = canonical_name(key.get_ref()).unwrap_or_else(|| key.get_ref().to_string());
            let text = section.as_text(key.get_ref(), value)?;
            let read = formula(&text, scope, &format!("`{name}`"), None, Reach::Phase)?;
            entries.push((name, read));
        }
        Ok(Some(entries))
    }

    fn complaint(&self, key: &'static str, message: String, remedy: &str) -> CaseError {
        let span = self.section.value(key).map_or(self.section.span.clone(), |value| value.span());
        CaseError::at(span, Problem::Other { message, remedy: remedy.to_string() })
    }
}

/// The name that is given, or `base`, numbered where it is taken.
fn name(section: &Section<'_>, base: String, taken: &[String]) -> Result<String, CaseError> {
    if let Some(text) = section.text("name")? {
        if taken.contains(&text.value) {
            let message = format!("two claims are called `{}`", text.value);
            return Err(other(&text, message, "give each claim a name of its own"));
        }
        return Ok(text.value);
    }
    let free = |name: &String| !taken.contains(name);
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
