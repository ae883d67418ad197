//! Cells of the papers' tables in a language for marked text.

use liouville::formula::Layout;

use super::{CellClaim, Filled, StatedCell, target};

/// A language for marked text.
pub(super) trait Markup {
    /// Text in which nothing is markup.
    fn escaped(text: &str) -> String;

    /// A formula.
    fn formula(layout: &Layout) -> String;

    /// A link to a file.
    fn link(words: &str, target: &str) -> String;
}

/// The words and claims of a cell, one a line.
pub(super) fn filled<M: Markup>(cell: &Filled) -> String {
    let words = cell.words.iter().map(|text| M::escaped(text));
    let lines: Vec<String> = words.chain(cell.shown().map(stated::<M>)).collect();
    if lines.is_empty() { "–".to_string() } else { lines.join("<br>") }
}

/// A claim with its verdict.
pub(super) fn stated<M: Markup>(claim: &CellClaim) -> String {
    let text = match claim.stated() {
        StatedCell::Formula(layout, _) => M::formula(layout),
        StatedCell::Words(words) => M::escaped(words),
    };
    let letter = claim.letter().map_or(String::new(), |letter| format!(" ({letter})"));
    let link = M::link(claim.verdict(), &target(&claim.path));
    format!("{} {link}: {text}{letter}", claim.mark())
}
