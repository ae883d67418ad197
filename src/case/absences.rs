//! Claims of absence in a case file.

use super::claims::{ClaimContext, cell, expect, name, statements};
use super::entries::Entries;
use super::error::Mistake;
use super::section::CaseTable;
use super::{AbsenceClaim, claims};
use crate::claim::STATEMENTS;
use crate::claim::absence::{ABSENCES, Absence};
use crate::claim::motion::MOTIONS;

/// The keys of a claim of absence.
const COMMON: [&str; 5] = ["name", "source", "expect", "cell", "note"];

/// Whether this is a claim of absence.
pub fn is_about_absence(section: &CaseTable<'_>) -> bool {
    ABSENCES.iter().any(|key| section.value(key).is_some())
}

/// Reads one claim of absence; `taken` holds the names of those before it.
pub fn read(
    section: &CaseTable<'_>,
    context: &ClaimContext<'_>,
    taken: &[String],
) -> Result<AbsenceClaim, Mistake> {
    let all = [ABSENCES, STATEMENTS, MOTIONS].concat();
    let stated: Vec<&str> = all.iter().copied().filter(|key| section.has(key)).collect();
    section.allow(&[all.as_slice(), &COMMON].concat());
    let entries =
        Entries { section, model: context.model, is_whole: context.is_whole, claims: &[] };
    let kind = match stated.as_slice() {
        [key] => Absence::read(key, &entries).unwrap_or_else(|| Err(statements(section, 0)))?,
        _ => return Err(statements(section, stated.len())),
    };
    Ok(AbsenceClaim {
        name: name(section, kind.text(), taken)?,
        source: claims::source(section, context)?,
        expect: expect(section)?,
        cell: cell(section)?,
        note: section.text("note")?.map(|text| text.value),
        kind,
    })
}
