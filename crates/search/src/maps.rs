//! Components and volume that a map keeps, and parts of a search that maps do not have.

use super::densities::tell_volume;
use super::integrals::tell_if_proved;
use super::terms::recorded;
use super::{Effort, FoundKind, SearchError, SearchReport};
use liouville::case::Case;
use liouville::graph::Step;

/// Tells the components of the state that a map keeps.
pub fn kept(case: &Case, effort: &Effort, report: &mut SearchReport) -> Result<(), SearchError> {
    let model = &case.model;
    let first = model.free_components();
    let (graph, images) = recorded(case, |jet| jet.phase.field().to_vec())?;
    let state = model.state_formulas()?;
    for ((component, image), formula) in images.iter().enumerate().zip(&state) {
        match graph.step(graph.place(*image)) {
            Step::Input(input) if input == first + component => {}
            _ => continue,
        }
        tell_if_proved(case, formula, effort, report)?;
    }
    Ok(())
}

/// Tells the density 1 of a map for which no density was found.
pub fn volume(case: &Case, effort: &Effort, report: &mut SearchReport) -> Result<(), SearchError> {
    let has_density = report.formulas(FoundKind::Density).next().is_some();
    if has_density { Ok(()) } else { tell_volume(case, effort, report) }
}

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
