//! A document as LaTeX, for XeLaTeX or LuaLaTeX.

use super::document::{Document, JudgedClaim, SectionBlock, TableCell};
use crate::typeset::latex::{escaped, formula};

const HEAD: &str = "% XeLaTeX or LuaLaTeX\n\\documentclass[a4paper,11pt]{article}\n\\usepackage{amsmath,amssymb,longtable,fontspec}\n\
\\usepackage[margin=25mm]{geometry}\n\\setmainfont{DejaVu Serif}\n\\setmonofont{DejaVu Sans Mono}\n\\setlength{\\parindent}{0pt}\n\\setlength{\\parskip}{4pt}\n";

/// Renders the whole document.
pub fn render(document: &Document) -> String {
    let mut out = format!(
        "{HEAD}\\title{{{}}}\n\\date{{}}\n\\begin{{document}}\n\\maketitle\n",
        escaped(&document.title)
    );
    for section in &document.sections {
        out.push_str(&format!("\n\\section*{{{}}}\n", section.title));
        for block in &section.blocks {
            out.push_str(&set(block));
        }
    }
    out + "\\end{document}\n"
}

fn set(block: &SectionBlock) -> String {
    match block {
        SectionBlock::Text(text) => format!("{}\n\n", escaped(text)),
        SectionBlock::List(items) => list(items),
        SectionBlock::Definitions(lines) => {
            itemised(lines.iter().map(|(text, layout)| match layout {
                Some(layout) => format!("$ {} $", formula(layout)),
                None => escaped(text),
            }))
        }
        SectionBlock::Folded(_, lines) => small(lines),
        SectionBlock::Entry(entry) => self::entry(entry),
        SectionBlock::Table { head, rows } => {
            let is_formula = |column: usize| {
                rows.iter().any(|row| matches!(row.get(column), Some(TableCell::Formula(..))))
            };
            // Formulas are broken into lines.
            let columns: String =
                (0..head.len()).map(|at| if is_formula(at) { "p{90mm}" } else { "l" }).collect();
            let mut out = format!("\\begin{{longtable}}{{{columns}}}\n");
            out.push_str(&format!("{} \\\\\n\\hline\n", head.join(" & ")));
            for row in rows {
                let cells: Vec<String> = row.iter().map(cell).collect();
                out.push_str(&format!("{} \\\\\n", cells.join(" & ")));
            }
            out + "\\end{longtable}\n"
        }
        // LaTeX does not support SVG; the HTML page has the pictures.
        SectionBlock::Picture(_) => String::new(),
    }
}

fn list(items: &[String]) -> String {
    // A list without an item is an error of LaTeX.
    if items.is_empty() {
        return String::new();
    }
    itemised(items.iter().map(|item| escaped(item)))
}

fn itemised(items: impl Iterator<Item = String>) -> String {
    let lines: String = items.map(|item| format!("\\item {item}\n")).collect();
    format!("\\begin{{itemize}}\n{lines}\\end{{itemize}}\n")
}

fn small(lines: &[String]) -> String {
    format!("{{\\footnotesize\n{}}}\n", list(lines))
}

fn cell(cell: &TableCell) -> String {
    match cell {
        TableCell::Text(text) => escaped(text),
        TableCell::Formula(_, Some(layout)) => format!("${}$", formula(layout)),
        TableCell::Formula(text, None) => format!("\\texttt{{{}}}", escaped(text)),
    }
}

fn entry(entry: &JudgedClaim) -> String {
    let mark = match entry.mark.sign() {
        "✓" => "$\\checkmark$",
        "✗" => "$\\times$",
        other => other,
    };
    let mut out =
        format!("\\par\\medskip {mark} \\textbf{{{}}} {}", entry.verdict, escaped(&entry.name));
    if !entry.source.is_empty() {
        out.push_str(&format!(" ({})", escaped(&entry.source)));
    }
    if !entry.remarks.is_empty() {
        out.push_str(&format!(": {}", escaped(&entry.remarks.join("; "))));
    }
    out.push('\n');
    match (&entry.layout, &entry.statement) {
        (Some(layout), _) => out.push_str(&format!("\\[ {} \\]\n", formula(layout))),
        (None, Some(text)) => {
            // Long ones are broken at their signs.
            out.push_str(&format!("\n{{\\sloppy\\texttt{{{}}}\\par}}\n\n", escaped(text)));
        }
        _ => {}
    }
    if !entry.definitions.is_empty() {
        let each = entry.definitions.iter().map(|(text, layout)| match layout {
            Some(layout) => format!("$ {} $", formula(layout)),
            None => format!("\\texttt{{{}}}", escaped(text)),
        });
        out.push_str(&format!("where {}.\n\n", each.collect::<Vec<_>>().join(", ")));
    }
    if !entry.evidence.is_empty() {
        out.push_str(&small(&entry.evidence));
    }
    out
}
