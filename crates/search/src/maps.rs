//! Parts of a search that maps do not have.

use super::{Effort, SearchReport};

/// Notes the parts asked for that a search of a map does not have.
pub fn note_fields_only(effort: &Effort, report: &mut SearchReport) {
    let asked = [
        (effort.conditions.is_some(), "--conditions"),
        (effort.poisson.is_some(), "--poisson"),
        (effort.ansatz.wanted, "--ansatz"),
        (effort.ansatz.potentials, "--potentials"),
        (effort.ansatz.gyrostats, "--gyrostats"),
    ];
    for (_, option) in asked.iter().filter(|(is_asked, _)| *is_asked) {
        report.remark(format!("{option} has no effect: it concerns fields, and this is a map"));
    }
}
