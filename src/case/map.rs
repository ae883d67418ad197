//! `[map]`: the image of each state variable.

use super::error::Problem;
use super::field;
use super::order::Stage;
use super::section::CaseTable;
use super::systems::Reading;
use crate::mechanics::{Chart, Dependence, Model, System};

/// Reads a map of the user's own; nothing if it is wrong.
pub(super) fn system(reading: &mut Reading<'_, '_>) -> Option<(System, Chart)> {
    reading
        .own_state(Dependence::Phase, "add a table [state] with x = \"-2..2\" for each variable");
    let root = reading.root;
    let section = root.table("map");
    if section.is_none() && root.value("map").is_none() {
        let remedy = "add a table [map] with x = \"…\", the image of each variable";
        root.mistakes().add(root.missing("map", remedy));
    }
    reading.settle(Stage::State);
    let (variables, names) = (&reading.state.variables, reading.names());
    let images = section.and_then(|section| field::images(&section, variables, names));
    let level = reading.read_level();
    reading.level = level?;
    Some((System::Map(images?), Chart::Free))
}

/// Notes an ∫ in the images of a map: values there matter, and its constant is open.
pub(super) fn no_open_constant(root: &CaseTable<'_>, model: &Model) {
    let System::Map(images) = &model.system else { return };
    let is_open = images.iter().any(|image| model.has_antiderivative(image));
    if let (true, Some(section)) = (is_open, root.table("map")) {
        root.mistakes().add(section.complaint(Problem::Other {
            message: "an image cannot contain ∫, whose constant is open".to_string(),
            remedy: "write the antiderivative out".to_string(),
        }));
    }
}
