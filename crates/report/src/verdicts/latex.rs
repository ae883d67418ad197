//! The table of verdicts as a LaTeX document: its `longtable` can be taken over into a paper.

use super::{COLUMNS, CaseRows, RowStatement, VerdictRow, VerdictTable, joined, one_line};
use crate::typeset::latex::{formula, prose, widest, with_encoding};

/// Widths of the columns in millimetres; together with their gaps they fit a page of 297 mm.
const WIDTHS: [usize; 5] = [48, 26, 100, 20, 44];

/// Widest part of a formula that is set in its column, in letters; others stand under the table.
const WIDEST: usize = 40;

/// Renders a document with the table, and what does not fit into it below.
pub fn render(table: &VerdictTable<'_>) -> String {
    let columns: String = WIDTHS
        .iter()
        .map(|width| format!(">{{\\raggedright\\arraybackslash}}p{{{width}mm}}"))
        .collect();
    let head = COLUMNS.map(|title| format!("\\textit{{{title}}}")).join(" & ");
    let mut out = format!(
        "\\documentclass{{article}}\n\
         \\usepackage{{amsmath,amssymb,array,longtable}}\n\
         \\usepackage[a4paper,landscape,margin=12mm]{{geometry}}\n\
         \\setlength{{\\parindent}}{{0pt}}\n\\setlength{{\\parskip}}{{0.6ex}}\n\
         \\begin{{document}}\n\\raggedright\n\
         % The table, with amsmath, amssymb, array and longtable.\n\
         \\begin{{longtable}}{{{columns}}}\n\\hline\n{head} \\\\ \\hline\n\\endhead\n\\hline\n\\endfoot\n"
    );
    let mut below: Vec<String> = Vec::new();
    for case in &table.cases {
        out.push_str(&heading(case));
        for row in &case.rows {
            out.push_str(&line(row, &mut below));
        }
        for mistake in &case.mistakes {
            out.push_str(&spanned(&format!("not judged: {}", prose(&one_line(mistake)))));
        }
    }
    out.push_str("\\end{longtable}\n");
    for text in below {
        out.push_str(&format!("\n{text}\n"));
    }
    out.push_str(&format!("\n{}\n\\end{{document}}\n", prose(&table.caption)));
    with_encoding(out)
}

/// A line across all columns.
fn spanned(text: &str) -> String {
    // Four gaps of two \tabcolsep, 6 pt each, lie between the columns.
    let width = WIDTHS.iter().sum::<usize>() + 16;
    format!(
        "\\multicolumn{{5}}{{>{{\\raggedright\\arraybackslash}}p{{{width}mm}}}}{{{text}}} \\\\\n"
    )
}

fn heading(case: &CaseRows<'_>) -> String {
    let source = match case.source.is_empty() {
        true => String::new(),
        false => format!(" ({})", prose(&one_line(case.source))),
    };
    spanned(&format!("\\textbf{{{}}}{source}", prose(&one_line(case.title))))
}

fn line(row: &VerdictRow<'_>, below: &mut Vec<String>) -> String {
    let mut name = prose(&one_line(row.name));
    if !row.source.is_empty() {
        let gap = if name.is_empty() { "" } else { " " };
        name.push_str(&format!("{gap}[{}]", prose(&one_line(row.source))));
    }
    // A bracket that begins a line would be read as an option of the line break before it.
    let cells = [
        format!("{{}}{name}"),
        prose(row.kind),
        joined([statement(&row.statement, below), prose(&one_line(row.particulars))]),
        verdict(row),
        prose(&one_line(&row.evidence)),
    ];
    format!("{} \\\\\n", cells.join(" & "))
}

/// Sets a statement; a formula too wide for its column goes below the table.
fn statement(own: &RowStatement<'_>, below: &mut Vec<String>) -> String {
    match own {
        RowStatement::Formula(layout) if widest(layout) > WIDEST => {
            below.push(format!("[{}] ${}$", below.len() + 1, formula(layout)));
            format!("[{}]", below.len())
        }
        RowStatement::Formula(layout) => format!("${}$", formula(layout)),
        RowStatement::Typed(text) => prose(&one_line(text)),
    }
}

fn verdict(row: &VerdictRow<'_>) -> String {
    match row.agrees {
        true => row.verdict.to_string(),
        false => format!("\\textbf{{{}}} (not expected)", row.verdict),
    }
}
