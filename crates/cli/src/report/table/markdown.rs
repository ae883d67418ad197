//! Tables of the papers as Markdown.

use liouville::formula::Layout;

use super::markup::{Markup, filled, stated};
use super::{Regenerated, letter};
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
            out.push_str(&format!(" {} |", filled::<Markdown>(cell)));
        }
        out.push('\n');
    }
    let definitions = table.definitions.iter().map(stated::<Markdown>);
    let notes = table.notes.iter().map(|note| inline(note));
    let theorems = table.theorems.iter().enumerate();
    let theorems = theorems.map(|(k, text)| format!("({}) {}", letter(k), inline(text)));
    for line in definitions.chain(notes).chain(theorems) {
        out.push_str(&format!("\n{line}\n"));
    }
    out
}

/// The language of Markdown.
struct Markdown;

impl Markup for Markdown {
    fn escaped(text: &str) -> String {
        inline(text)
    }

    fn formula(layout: &Layout) -> String {
        format!("${}$", formula(layout).replace('|', "\\|"))
    }

    fn link(words: &str, target: &str) -> String {
        format!("[{words}](<{target}>)")
    }
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
