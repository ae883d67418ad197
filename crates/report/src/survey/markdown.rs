//! A document as Markdown; formulas as LaTeX between dollars, evidence folded.

use super::document::{Document, JudgedClaim, SectionBlock, TableCell};
use crate::typeset::latex::formula;
use liouville::formula::Layout;

/// Renders the whole document.
pub fn render(document: &Document) -> String {
    let mut out = format!("# {}\n", escaped(&one_line(&document.title)));
    for section in &document.sections {
        out.push_str(&format!("\n## {}\n\n", section.title));
        for block in &section.blocks {
            out.push_str(&set(block));
        }
    }
    out
}

fn set(block: &SectionBlock) -> String {
    match block {
        SectionBlock::Text(text) => format!("{}\n\n", escaped(&one_line(text))),
        SectionBlock::List(items) => {
            let lines: String = items.iter().map(|item| format!("- {}\n", escaped(item))).collect();
            lines + "\n"
        }
        SectionBlock::Definitions(lines) => {
            let line = |(text, layout): &(String, Option<Layout>)| match layout {
                Some(layout) => format!("- ${}$\n", formula(layout)),
                None => format!("- {}\n", escaped(text)),
            };
            lines.iter().map(line).collect::<String>() + "\n"
        }
        SectionBlock::Folded(what, lines) => folded(what, lines),
        SectionBlock::Entry(entry) => self::entry(entry),
        SectionBlock::Table { head, rows } => {
            let mut out = format!("| {} |\n|{}\n", head.join(" | "), "---|".repeat(head.len()));
            for row in rows {
                let cells: Vec<String> = row.iter().map(cell).collect();
                out.push_str(&format!("| {} |\n", cells.join(" | ")));
            }
            out + "\n"
        }
        SectionBlock::Picture(picture) => {
            format!("*{}* (in the HTML page)\n\n", escaped(&picture.caption))
        }
    }
}

fn folded(what: &str, lines: &[String]) -> String {
    let lines: String = lines.iter().map(|line| format!("- {}\n", escaped(line))).collect();
    format!("<details><summary>{what}</summary>\n\n{lines}\n</details>\n\n")
}

fn cell(cell: &TableCell) -> String {
    match cell {
        TableCell::Text(text) => escaped(text),
        TableCell::Formula(_, Some(layout)) => {
            format!("${}$", formula(layout).replace('|', "\\vert "))
        }
        TableCell::Formula(text, None) => format!("`{}`", text.replace('|', "∣")),
    }
}

fn entry(entry: &JudgedClaim) -> String {
    let mut out = format!("**{} {}** {}", entry.mark.sign(), entry.verdict, escaped(&entry.name));
    if !entry.source.is_empty() {
        out.push_str(&format!(" ({})", escaped(&entry.source)));
    }
    if !entry.remarks.is_empty() {
        out.push_str(&format!(": {}", escaped(&entry.remarks.join("; "))));
    }
    out.push_str("\n\n");
    match (&entry.layout, &entry.statement) {
        (Some(layout), _) => out.push_str(&format!("$${}$$\n\n", formula(layout))),
        (None, Some(text)) => out.push_str(&format!("`{text}`\n\n")),
        _ => {}
    }
    if !entry.definitions.is_empty() {
        let each = entry.definitions.iter().map(|(text, layout)| match layout {
            Some(layout) => format!("${}$", formula(layout)),
            None => format!("`{text}`"),
        });
        out.push_str(&format!("where {}\n\n", each.collect::<Vec<_>>().join(", ")));
    }
    if !entry.evidence.is_empty() {
        out.push_str(&folded("evidence", &entry.evidence));
    }
    out
}

/// Text in one line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Escapes the characters that Markdown would read as markup.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '*' | '_' | '|' | '<' | '>' | '[' | ']' | '\\' | '$' | '`' => out.extend(['\\', c]),
            c => out.push(c),
        }
    }
    out
}
