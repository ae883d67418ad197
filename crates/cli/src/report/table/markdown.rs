//! Tables of the papers as Markdown.

use super::{CellClaim, Filled, Regenerated, StatedCell, letter, target};
use crate::report::typeset::latex::formula;
use liouville_report::inline;

/// Renders a Markdown table: rows as in the paper, verdicts as links.
pub fn render(table: &Regenerated) -> String {
    let mut out = format!("**{}**\n\n| |", inline(&table.title()));
    for column in &table.columns {
        out.push_str(&format!(" {column} |"));
    }
    out.push_str(&format!("\n|{}\n", "---|".repeat(table.columns.len() + 1)));
    for row in &table.rows {
        out.push_str(&format!("| **{}** |", row.label()));
        for cell in &row.cells {
            out.push_str(&format!(" {} |", filled(cell)));
        }
        out.push('\n');
    }
    let definitions = table.definitions.iter().map(stated);
    let notes = table.notes.iter().map(|note| inline(note));
    let theorems = table.theorems.iter().enumerate();
    let theorems = theorems.map(|(k, text)| format!("({}) {}", letter(k), inline(text)));
    for line in definitions.chain(notes).chain(theorems) {
        out.push_str(&format!("\n{line}\n"));
    }
    out
}

fn filled(cell: &Filled) -> String {
    let words = cell.words.iter().map(|text| inline(text));
    let lines: Vec<String> = words.chain(cell.shown().map(stated)).collect();
    if lines.is_empty() { "–".to_string() } else { lines.join("<br>") }
}

fn stated(claim: &CellClaim) -> String {
    let text = match claim.stated() {
        StatedCell::Formula(layout, _) => format!("${}$", formula(layout).replace('|', "\\|")),
        StatedCell::Words(words) => inline(words),
    };
    let letter = claim.letter().map_or(String::new(), |letter| format!(" ({letter})"));
    let (mark, verdict) = (claim.mark(), claim.verdict());
    format!("{mark} [{verdict}](<{}>): {text}{letter}", target(&claim.path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_no_markup() {
        assert_eq!(inline("<b>|x\ny"), "&lt;b&gt;\\|x y");
        assert_eq!(inline("![x](http://x)"), "\\!\\[x\\](http://x)");
    }
}
