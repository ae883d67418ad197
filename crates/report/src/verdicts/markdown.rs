//! The table of verdicts as Markdown, with formulas between dollars.

use super::{COLUMNS, RowStatement, VerdictRow, VerdictTable, joined, one_line};
use crate::typeset::latex::formula;

/// Renders a heading and a table for each case.
pub fn render(table: &VerdictTable<'_>) -> String {
    let mut out = String::new();
    for case in &table.cases {
        out.push_str(&format!("**{}**", inline(case.title)));
        if !case.source.is_empty() {
            out.push_str(&format!(" ({})", inline(case.source)));
        }
        out.push_str("\n\n");
        if !case.rows.is_empty() {
            out.push_str(&format!(
                "| {} |\n|{}\n",
                COLUMNS.join(" | "),
                "---|".repeat(COLUMNS.len())
            ));
        }
        for row in &case.rows {
            out.push_str(&line(row));
        }
        for mistake in &case.mistakes {
            out.push_str(&format!("not judged: {}\n", inline(mistake)));
        }
        out.push('\n');
    }
    out + &inline(&table.caption) + "\n"
}

fn line(row: &VerdictRow<'_>) -> String {
    let source = match row.source.is_empty() {
        true => String::new(),
        false => format!(" [{}]", row.source),
    };
    let statement = match &row.statement {
        RowStatement::Formula(layout) => format!("${}$", formula(layout).replace('|', "\\|")),
        RowStatement::Typed(text) => inline(text),
    };
    let statement = joined([statement, inline(row.particulars)]);
    let verdict = match row.agrees {
        true => row.verdict.to_string(),
        false => format!("**{}** (not expected)", row.verdict),
    };
    let name = inline(&format!("{}{source}", row.name));
    format!(
        "| {} | {} | {statement} | {verdict} | {} |\n",
        name.trim(),
        row.kind,
        inline(&row.evidence)
    )
}

/// Text in one line of a Markdown table, with what would be markup escaped.
pub fn inline(text: &str) -> String {
    let mut out = String::new();
    for c in one_line(text).chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '!' | '$' => out.extend(['\\', c]),
            c => out.push(c),
        }
    }
    out
}
