//! The table of verdicts as a web page.

use super::{COLUMNS, RowStatement, VerdictRow, VerdictTable, joined};
use crate::typeset::mathml::{escaped, formula};

/// Style of the page.
const STYLE: &str = "body { font: 15px/1.4 serif; margin: 2em } \
                     table { border-collapse: collapse; margin: 0 0 1em } \
                     td, th { border-top: 1px solid #888; padding: .3em .6em; vertical-align: top; text-align: left } \
                     th { font-weight: normal; font-style: italic } \
                     caption { text-align: left; padding: .5em 0 } \
                     .unexpected { background: #f6d5d0 } .vector, .matrix { font-weight: bold }";

/// Renders a page with a table for each case.
pub fn render(table: &VerdictTable<'_>) -> String {
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <title>Verdicts</title>\n<style>{STYLE}</style>\n</head>\n<body>\n"
    );
    for case in &table.cases {
        let source = match case.source.is_empty() {
            true => String::new(),
            false => format!(" ({})", escaped(case.source)),
        };
        let title = escaped(case.title);
        out.push_str(&format!("<table>\n<caption><strong>{title}</strong>{source}</caption>\n"));
        if !case.rows.is_empty() {
            let head = COLUMNS.map(|title| format!("<th>{title}</th>")).concat();
            out.push_str(&format!("<tr>{head}</tr>\n"));
        }
        case.rows.iter().for_each(|row| out.push_str(&line(row)));
        for mistake in &case.mistakes {
            out.push_str(&format!("<tr><td>not judged: {}</td></tr>\n", escaped(mistake)));
        }
        out.push_str("</table>\n");
    }
    out + &format!("<p>{}</p>\n</body>\n</html>\n", escaped(&table.caption))
}

fn line(row: &VerdictRow<'_>) -> String {
    let source = match row.source.is_empty() {
        true => String::new(),
        false => format!(" [{}]", row.source),
    };
    let statement = match &row.statement {
        RowStatement::Formula(layout) => formula(layout, false),
        RowStatement::Typed(text) => escaped(text),
    };
    let statement = joined([statement, escaped(row.particulars)]);
    let class = if row.agrees { "" } else { " class=\"unexpected\"" };
    let words = if row.agrees { "" } else { " (not expected)" };
    format!(
        "<tr{class}><td>{}</td><td>{}</td><td>{statement}</td><td>{}{words}</td><td>{}</td></tr>\n",
        escaped(format!("{}{source}", row.name).trim()),
        row.kind,
        row.verdict,
        escaped(&row.evidence)
    )
}
