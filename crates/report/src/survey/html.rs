//! A document as one self-contained HTML page: formulas as MathML, pictures as SVG, evidence
//! folded, light or dark as the reader's system.

use super::document::{Document, JudgedClaim, SectionBlock, TableCell, VerdictMark};
use crate::typeset::mathml::{escaped, formula};

const STYLE: &str = include_str!("page.css");

/// Renders the whole page, with a link to the index of its site if there is one.
pub fn render(document: &Document, index: Option<&str>) -> String {
    let title = escaped(&document.title);
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<header>\n<h1>{title}</h1>\n\
         <p class=\"lead\">{}</p>\n<p class=\"class\">{}</p>\n</header>\n<nav><ul>\n",
        escaped(&document.lead),
        escaped(&document.headline)
    );
    if let Some(index) = index {
        out.push_str(&format!("<li><a href=\"{}\">all cases</a></li>\n", escaped(index)));
    }
    for (number, section) in document.sections.iter().enumerate() {
        out.push_str(&format!("<li><a href=\"#s{number}\">{}</a></li>\n", escaped(section.title)));
    }
    out.push_str("</ul></nav>\n");
    for (number, section) in document.sections.iter().enumerate() {
        let title = escaped(section.title);
        out.push_str(&format!("<section id=\"s{number}\">\n<h2>{title}</h2>\n"));
        out.extend(section.blocks.iter().map(set));
        out.push_str("</section>\n");
    }
    out + "</main>\n</body>\n</html>\n"
}

fn set(block: &SectionBlock) -> String {
    match block {
        SectionBlock::Text(text) => format!("<p>{}</p>\n", escaped(text)),
        SectionBlock::List(items) => list(items),
        SectionBlock::Definitions(lines) => {
            itemised(lines.iter().map(|(text, layout)| match layout {
                Some(layout) => format!("<span class=\"scroll\">{}</span>", formula(layout, false)),
                None => escaped(text),
            }))
        }
        SectionBlock::Folded(what, lines) => folded(what, lines),
        SectionBlock::Entry(entry) => self::entry(entry),
        SectionBlock::Table { head, rows } => table(head, rows),
        SectionBlock::Picture(picture) => format!(
            "<figure>{}<figcaption>{}</figcaption></figure>\n",
            picture.svg,
            escaped(&picture.caption)
        ),
    }
}

fn list(items: &[String]) -> String {
    itemised(items.iter().map(|item| escaped(item)))
}

fn itemised(items: impl Iterator<Item = String>) -> String {
    let lines: String = items.map(|item| format!("<li>{item}</li>\n")).collect();
    format!("<ul>\n{lines}</ul>\n")
}

fn folded(what: &str, lines: &[String]) -> String {
    format!("<details><summary>{}</summary>\n{}</details>\n", escaped(what), list(lines))
}

fn table(head: &[&str], rows: &[Vec<TableCell>]) -> String {
    let cell = |cell: &TableCell| match cell {
        TableCell::Text(text) => format!("<td>{}</td>", escaped(text)),
        TableCell::Formula(_, Some(layout)) => format!("<td>{}</td>", formula(layout, false)),
        TableCell::Formula(text, None) => format!("<td><code>{}</code></td>", escaped(text)),
    };
    let line =
        |row: &Vec<TableCell>| format!("<tr>{}</tr>\n", row.iter().map(cell).collect::<String>());
    let head: String = head.iter().map(|word| format!("<th>{}</th>", escaped(word))).collect();
    let body: String = rows.iter().map(line).collect();
    format!(
        "<div class=\"scroll\"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n</table></div>\n"
    )
}

fn entry(entry: &JudgedClaim) -> String {
    let class = match entry.mark {
        VerdictMark::Holds => "holds",
        VerdictMark::Fails => "fails",
        VerdictMark::Open => "open",
    };
    let mut out = format!(
        "<article class=\"{class}\">\n<h3><span class=\"verdict\">{} {}</span> {}",
        entry.mark.sign(),
        entry.verdict,
        escaped(&entry.name)
    );
    if !entry.source.is_empty() {
        out.push_str(&format!(" <cite>{}</cite>", escaped(&entry.source)));
    }
    out.push_str("</h3>\n");
    match (&entry.layout, &entry.statement) {
        (Some(layout), _) => {
            out.push_str(&format!("<div class=\"scroll\">{}</div>\n", formula(layout, true)));
        }
        (None, Some(text)) => out.push_str(&format!("<p><code>{}</code></p>\n", escaped(text))),
        _ => {}
    }
    if !entry.definitions.is_empty() {
        let each = entry.definitions.iter().map(|(text, layout)| match layout {
            Some(layout) => format!("<li>{}</li>", formula(layout, false)),
            None => format!("<li><code>{}</code></li>", escaped(text)),
        });
        let each: String = each.collect();
        out.push_str(&format!("<ul class=\"where\">{each}</ul>\n"));
    }
    if !entry.remarks.is_empty() {
        out.push_str(&format!("<p class=\"remark\">{}</p>\n", escaped(&entry.remarks.join("; "))));
    }
    let typed = entry.statement.iter().chain(entry.definitions.iter().map(|(text, _)| text));
    let typed: Vec<String> = typed.map(|text| format!("as typed: {text}")).collect();
    if !entry.evidence.is_empty() || !typed.is_empty() {
        out.push_str(&folded("evidence", &[entry.evidence.as_slice(), &typed].concat()));
    }
    out + "</article>\n"
}
