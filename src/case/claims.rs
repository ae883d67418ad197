//! The tables `[[claim]]`: statement, place, and expectation.

use super::entries::{Entries, mistake_at, place_of};
use super::error::{Mistake, Problem};
use super::section::CaseTable;
use super::{Expect, MotionClaim, PlacedClaim, SectionPlan, TABLE_ROWS};
use crate::claim::absence::{ABSENCES, Absence};
use crate::claim::motion::{Beginning, MOTIONS, MotionKind};
use crate::claim::{
    Bracket, Casimir, ClaimKind, Compatible, DensityInVariables, Hamiltonian, JacobiIdentity,
    LevelSubset, Reader, STATEMENTS, Statement, ValueShape,
};
use crate::mechanics::Model;

/// Keys common to all claims.
const COMMON: [&str; 6] = ["name", "source", "where", "expect", "cell", "note"];

/// Keys common to all claims about motion.
const COMMON_OF_MOTIONS: [&str; 4] = ["name", "source", "expect", "note"];

/// A key with the shape of its value.
pub type ShapedKey = (&'static str, ValueShape);

/// Keys of a claim: each statement, with its own key and those that may accompany it.
pub fn claim_keys() -> Vec<(&'static str, Vec<ShapedKey>)> {
    let shaped = |statement: &'static str,
                  common: &[&'static str],
                  companions: &[&'static str],
                  shapes: &[ShapedKey]| {
        let keys = [&[statement], common, companions].concat().into_iter();
        let shape = |key| match key {
            "note" => ValueShape::List,
            _ => ValueShape::of(key, shapes),
        };
        (statement, keys.map(|key| (key, shape(key))).collect())
    };
    let stated = STATEMENTS
        .iter()
        .map(|key| shaped(key, &COMMON, ClaimKind::companions(key), ClaimKind::shapes(key)));
    let motions = MOTIONS.iter().map(|key| {
        shaped(key, &COMMON_OF_MOTIONS, MotionKind::companions(key), MotionKind::shapes(key))
    });
    let absences = ABSENCES
        .iter()
        .map(|key| shaped(key, &COMMON, Absence::companions(key), Absence::shapes(key)));
    stated.chain(motions).chain(absences).collect()
}

/// Lists the statements which a key may accompany.
pub fn statements_with(key: &str) -> Vec<&'static str> {
    let all = claim_keys().into_iter();
    all.filter(|(_, keys)| keys.iter().any(|(own, _)| *own == key)).map(|own| own.0).collect()
}

/// Whether this is a claim about motion.
pub fn is_about_motion(section: &CaseTable<'_>) -> bool {
    MOTIONS.iter().any(|key| section.value(key).is_some())
}

/// Whether the claim has no statement because its key is misspelt, which is then reported.
pub fn is_misspelt(section: &CaseTable<'_>) -> bool {
    let states = |key: &&str| section.has(key);
    if STATEMENTS.iter().chain(MOTIONS).chain(ABSENCES).any(states) {
        return false;
    }
    !section.allow(&[STATEMENTS, MOTIONS, ABSENCES, &COMMON].concat())
}

/// Context in which claims are read.
pub struct ClaimContext<'c> {
    /// Model of the case.
    pub model: &'c Model,
    /// Whether the case was read without mistakes.
    pub is_whole: bool,
    /// Section of the case.
    pub plan: Option<&'c SectionPlan>,
    /// Default source of claims.
    pub source: &'c str,
}

/// Statements about brackets.
const OF_BRACKETS: [&str; 6] = [
    Hamiltonian::NAME,
    Casimir::NAME,
    Bracket::NAME,
    JacobiIdentity::NAME,
    Compatible::NAME,
    DensityInVariables::NAME,
];

/// Whether the claim is about a bracket whose table has mistakes, or is yet to be read, in a file with mistakes.
pub fn waits_for_bracket(section: &CaseTable<'_>, context: &ClaimContext<'_>) -> bool {
    let is_of_bracket = || OF_BRACKETS.iter().any(|key| section.value(key).is_some());
    !context.is_whole && context.model.variables.is_none() && is_of_bracket()
}

/// Reads one claim; `taken` holds the names of those before it.
pub fn read(
    section: &CaseTable<'_>,
    context: &ClaimContext<'_>,
    taken: &[String],
) -> Result<PlacedClaim, Mistake> {
    let model = context.model;
    let kind = kind(section, context)?;
    let (place, only_there) = place(section, context)?;
    let base = kind.text().unwrap_or_else(|| kind.name().to_string());
    let claim = PlacedClaim {
        name: name(section, base, taken)?,
        source: source(section, context)?,
        place,
        only_there,
        is_wanted: true,
        expect: expect(section)?,
        cell: cell(section)?,
        note: section.text("note")?.map(|text| text.value),
        kind,
    };
    let formulas = claim.kind.formulas();
    let rigid = |index: &usize| model.is_rigid(*index, &formulas);
    if let Some(index) = claim.kind.changes().into_iter().find(rigid) {
        let name = &model.parameters[index].name;
        return Err(rigid_parameter(section, claim.kind.name(), name));
    }
    match claim.kind.objection(model).filter(|_| context.is_whole) {
        None => Ok(claim),
        Some(objection) => {
            let span = place_of(section, claim.kind.name());
            let (message, remedy) = (objection.message, objection.remedy.to_string());
            Err(Mistake::at(span, Problem::Sense { message, remedy }))
        }
    }
}

/// The mistake of changing a number on which sizes and indices depend.
fn rigid_parameter(section: &CaseTable<'_>, key: &'static str, name: &str) -> Mistake {
    let span = place_of(section, key);
    let message =
        format!("`{name}` is used in a size, an index or a power of a matrix, and cannot change");
    let remedy = "use a different parameter".to_string();
    Mistake::at(span, Problem::Other { message, remedy })
}

/// Reads one claim about motion; `before` holds the claims about the equations before it.
pub fn read_motion(
    section: &CaseTable<'_>,
    context: &ClaimContext<'_>,
    (taken, before): (&[String], &[PlacedClaim]),
) -> Result<MotionClaim, Mistake> {
    let model = context.model;
    // A companion of a claim about motion, such as density = "none", may be a statement elsewhere.
    let motion = MOTIONS.iter().find(|key| section.value(key).is_some()).copied();
    let accompanies =
        |key: &&&str| MotionKind::companions(motion.unwrap_or_default()).contains(*key);
    let mut stated = MOTIONS
        .iter()
        .chain(STATEMENTS)
        .filter(|key| section.value(key).is_some())
        .filter(|key| !accompanies(key));
    let (key, second) = (stated.next().copied().unwrap_or_default(), stated.next());
    section.allow(&[MOTIONS, STATEMENTS, &COMMON_OF_MOTIONS, MotionKind::companions(key)].concat());
    let entries = Entries { section, model, is_whole: context.is_whole, claims: before };
    let kind = match (MotionKind::read(key, &entries), second) {
        (Some(kind), None) => kind?,
        _ => return Err(statements(section, 2)),
    };
    if model.system.is_map() && context.is_whole {
        let message = format!("`{key}` is a claim about a motion in time, and the case is a map");
        let remedy = "claim it of a field, or claim an invariant of the map".to_string();
        let span = place_of(section, key);
        return Err(Mistake::at(span, Problem::Sense { message, remedy }));
    }
    let starts_on_section = matches!(kind.beginning(), Beginning::Section(_));
    if context.plan.is_none() && starts_on_section && context.is_whole {
        return Err(section.complaint(Problem::Sense {
            message: "the motion starts on a section, and the case has none".to_string(),
            remedy: "add [section] with g0 and energy, or give state = { … }".to_string(),
        }));
    }
    Ok(MotionClaim {
        name: name(section, kind.text(), taken)?,
        source: source(section, context)?,
        expect: expect(section)?,
        note: section.text("note")?.map(|text| text.value),
        kind,
    })
}

/// The mistake of a claim with no statement, or several.
pub fn statements(section: &CaseTable<'_>, given: usize) -> Mistake {
    let message = match given {
        0 => "this claim has no statement".to_string(),
        _ => format!("this claim makes {given} statements"),
    };
    let remedy = match given {
        0 => format!(
            "write integral = \"…\", density = \"…\" or another statement; `liouville schema` lists all {}",
            [STATEMENTS, MOTIONS, ABSENCES].concat().len()
        ),
        _ => "write a [[claim]] for each".to_string(),
    };
    Mistake::at(section.span.clone(), Problem::Other { message, remedy })
}

fn kind(section: &CaseTable<'_>, context: &ClaimContext<'_>) -> Result<ClaimKind, Mistake> {
    let given: Vec<&str> =
        STATEMENTS.iter().copied().filter(|key| section.value(key).is_some()).collect();
    let companions = given.first().map_or(&[][..], |key| ClaimKind::companions(key));
    section.allow(&[STATEMENTS, MOTIONS, &COMMON, companions].concat());
    let entries =
        Entries { section, model: context.model, is_whole: context.is_whole, claims: &[] };
    match given.as_slice() {
        ["density"] if section.text("density")?.is_some_and(|text| text.value == "none") => {
            let message = "the absence of a density is claimed near a fixed point".to_string();
            let remedy =
                "write no-density-near = { x = \"…\" }, the point where the divergence is not 0";
            Err(entries.complaint("density", message, remedy))
        }
        ["density"] if section.text("density")?.is_some_and(|text| text.value == "exists") => {
            let message = "a density is given by a formula".to_string();
            let remedy = "write density = \"1\" or the like; or claim analytic-density = \"exists\" \
                          or position-density = \"exists\"";
            Err(entries.complaint("density", message, remedy))
        }
        [key] => ClaimKind::read(key, &entries).unwrap_or_else(|| Err(statements(section, 0))),
        _ => Err(statements(section, given.len())),
    }
}

/// Source of the claim: that of the case unless it names its own.
pub fn source(section: &CaseTable<'_>, context: &ClaimContext<'_>) -> Result<String, Mistake> {
    Ok(section.text("source")?.map_or(context.source.to_string(), |text| text.value))
}

/// Name of a claim: the one given, or `base`, numbered where it is taken.
pub fn name(section: &CaseTable<'_>, base: String, taken: &[String]) -> Result<String, Mistake> {
    if let Some(text) = section.text("name")? {
        if taken.contains(&text.value) {
            let message = format!("two claims are called `{}`", text.value);
            return Err(mistake_at(&text, message, "give each claim a different name"));
        }
        return Ok(text.value);
    }
    let free = |name: &String| !taken.contains(name);
    let numbered = (2..).map(|number| format!("{base} ({number})"));
    Ok(std::iter::once(base.clone()).chain(numbered).find(free).unwrap_or(base))
}

fn place(
    section: &CaseTable<'_>,
    context: &ClaimContext<'_>,
) -> Result<(LevelSubset, bool), Mistake> {
    let model = context.model;
    let Some(text) = section.text("where")? else { return Ok((LevelSubset::level(model), false)) };
    let equation = match text.value.trim() {
        "level" => return Ok((LevelSubset::level(model), false)),
        "level only" => return Ok((LevelSubset::level(model), true)),
        "everywhere" => return Ok((LevelSubset::everywhere(model), false)),
        equation => equation,
    };
    match LevelSubset::equation(model, equation) {
        Some(place) => Ok((place, false)),
        // the level may have the equation, with a mistake in it
        None if !context.is_whole => Ok((LevelSubset::level(model), false)),
        None => {
            let equations: Vec<String> =
                model.level.iter().map(|equation| format!("\"{}\"", equation.text)).collect();
            let remedy = match equations.as_slice() {
                [] => "write \"everywhere\": this case has no level set".to_string(),
                _ => format!(
                    "write \"level\", \"level only\", \"everywhere\", or one of the level's \
                     equations: {}",
                    equations.join(", ")
                ),
            };
            let message = format!("`{equation}` is not a place of this case");
            Err(Mistake::at(text.span.clone(), Problem::Sense { message, remedy }))
        }
    }
}

/// The row of the paper's table that the claim fills.
pub fn cell(section: &CaseTable<'_>) -> Result<Option<String>, Mistake> {
    match section.text("cell")? {
        Some(text) if !TABLE_ROWS.contains(&text.value.as_str()) => {
            let remedy = format!("the rows are {}", TABLE_ROWS.join(", "));
            Err(mistake_at(
                &text,
                format!("`{}` is not a row of the paper's tables", text.value),
                &remedy,
            ))
        }
        found => Ok(found.map(|text| text.value)),
    }
}

/// Expectation that the file states for the claim.
pub fn expect(section: &CaseTable<'_>) -> Result<Expect, Mistake> {
    let Some(text) = section.text("expect")? else { return Ok(Expect::Holds) };
    match text.value.as_str() {
        "holds" => Ok(Expect::Holds),
        "fails" => Ok(Expect::Fails),
        "open" => Ok(Expect::Open),
        found => Err(mistake_at(
            &text,
            format!("`expect` is \"holds\", \"fails\" or \"open\", not \"{found}\""),
            "write what you expect of the claim: holds, fails or open",
        )),
    }
}
