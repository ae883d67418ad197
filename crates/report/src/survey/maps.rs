//! Reversors and discrete symmetries as tables.

use super::document::{SectionBlock, TableCell};
use liouville_search::survey::{Survey, TestedClaim};

/// Tables of the maps of a survey.
pub fn maps(survey: &Survey) -> Vec<SectionBlock> {
    let mut found = Vec::new();
    // Maps without a name of their own are named by their images.
    let has_names = |all: &[TestedClaim]| {
        all.iter().any(|one| !one.claim.name.starts_with(&format!("{} ", one.claim.kind)))
    };
    let row = |one: &TestedClaim, is_named: bool, with_set: bool| {
        let map = one.images.iter().map(|image| format!("{} ↦ {}", image.name, image.formula));
        let map = map.collect::<Vec<_>>().join(", ");
        let mut cells = Vec::new();
        if is_named {
            cells.push(TableCell::Text(one.claim.name.clone()));
        }
        cells.push(TableCell::Formula(map, one.shown.statement.clone()));
        cells.push(TableCell::Text(one.claim.verdict.word().to_string()));
        if with_set {
            cells.push(TableCell::Text(match one.fixed_set.map(|set| set.dimension) {
                Some(Some(dimension)) => dimension.to_string(),
                Some(None) => "empty".to_string(),
                None => "–".to_string(),
            }));
        }
        cells
    };
    if survey.reversors.is_empty() {
        found.push(SectionBlock::Text(format!(
            "No reversor was found among {}.",
            survey.maps_tried
        )));
    } else {
        let place = if survey.independence.has_level { " on the level set" } else { "" };
        found.push(SectionBlock::Text(format!(
            "Reversors, with the dimension of their fixed set{place}:"
        )));
        let is_named = has_names(&survey.reversors);
        let head = ["reversor", "map", "verdict", "fixed set"];
        found.push(SectionBlock::Table {
            head: head[usize::from(!is_named)..].to_vec(),
            rows: survey.reversors.iter().map(|one| row(one, is_named, true)).collect(),
        });
    }
    if !survey.symmetries.is_empty() {
        found.push(SectionBlock::Text("Discrete symmetries:".to_string()));
        let is_named = has_names(&survey.symmetries);
        let head = ["symmetry", "map", "verdict"];
        found.push(SectionBlock::Table {
            head: head[usize::from(!is_named)..].to_vec(),
            rows: survey.symmetries.iter().map(|one| row(one, is_named, false)).collect(),
        });
    }
    found
}
