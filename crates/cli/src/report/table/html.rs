//! Tables of the papers as web pages.

use liouville::formula::Layout;

use super::markup::{Markup, filled, stated};
use super::{Regenerated, letter};
use crate::report::typeset::mathml::{escaped, formula};

/// Style of the page.
const STYLE: &str = "body { font: 15px/1.4 serif; margin: 2em } \
                     table { border-collapse: collapse } \
                     td, th { border: 1px solid #888; padding: .4em .6em; vertical-align: top } \
                     th { text-align: left; font-weight: normal } \
                     .head { text-align: center } .exists { background: #e2e2e2 } \
                     caption { text-align: left; font-weight: bold; padding: .5em 0 } \
                     .vector, .matrix { font-weight: bold }";

/// Renders a page with the table.
pub fn render(table: &Regenerated) -> String {
    let title = escaped(&table.title());
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n\
         <table>\n<caption>{title}</caption>\n<tr><th></th>"
    );
    for column in &table.columns {
        out.push_str(&format!("<th class=\"head\">{column}</th>"));
    }
    out.push_str("</tr>\n");
    for row in &table.rows {
        out.push_str(&format!("<tr><th>{}</th>", escaped(row.label())));
        for (cell, count) in row.merged() {
            let class = match (cell.exists, count) {
                (true, _) => " class=\"exists\"",
                (false, 1) => "",
                (false, _) => " class=\"head\"",
            };
            let span = if count > 1 { format!(" colspan=\"{count}\"") } else { String::new() };
            out.push_str(&format!("\n<td{class}{span}>{}</td>", filled::<Html>(cell)));
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</table>\n");
    let definitions = table.definitions.iter().map(stated::<Html>);
    let notes = table.notes.iter().map(|note| escaped(note));
    let theorems = table.theorems.iter().enumerate();
    let theorems = theorems.map(|(k, text)| format!("({}) {}", letter(k), escaped(text)));
    for line in definitions.chain(notes).chain(theorems) {
        out.push_str(&format!("<p>{line}</p>\n"));
    }
    out.push_str("</body>\n</html>\n");
    out
}

/// The language of web pages.
struct Html;

impl Markup for Html {
    fn escaped(text: &str) -> String {
        escaped(text)
    }

    fn formula(layout: &Layout) -> String {
        formula(layout, false)
    }

    fn link(words: &str, target: &str) -> String {
        format!("<a href=\"{target}\">{words}</a>")
    }
}
