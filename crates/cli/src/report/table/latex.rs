//! Tables of the papers as LaTeX documents, for any LaTeX with amsmath, colortbl and hyperref.

use super::{CellClaim, Filled, Regenerated, StatedCell, letter, one_line, target};
use crate::report::typeset::latex::{formula, prose, widest, with_encoding};

/// Width of a column of the table in millimetres.
const COLUMN: usize = 62;

/// Width of the names of the rows in millimetres.
const NAMES: usize = 28;

/// Widest part of a formula that is set in a cell, in letters; others stand under the table.
const WIDEST: usize = 22;

/// Space between two columns in millimetres.
const GAP: usize = 5;

/// Renders a document with the table on a page of its own size.
pub fn render(table: &Regenerated) -> String {
    let count = table.columns.len();
    let width = NAMES + GAP + count * (COLUMN + GAP) + 20;
    let mut out = format!(
        "\\documentclass{{article}}\n\\usepackage{{amsmath,amssymb,array,colortbl}}\n\
         \\usepackage[papersize={{{width}mm,297mm}},margin=8mm]{{geometry}}\n\
         \\usepackage[hidelinks]{{hyperref}}\n\
         \\setlength{{\\parindent}}{{0pt}}\n\\setlength{{\\parskip}}{{0.6ex}}\n\
         \\setlength{{\\tabcolsep}}{{2.4mm}}\n\\renewcommand{{\\arraystretch}}{{1.3}}\n\
         \\pagestyle{{empty}}\n\\begin{{document}}\n\\raggedright\n\\textbf{{{}}}\n\n\
         \\begin{{tabular}}{{|>{{\\raggedright\\arraybackslash}}p{{{NAMES}mm}}|*{{{count}}}{{>{{\\raggedright\\arraybackslash}}p{{{COLUMN}mm}}|}}}}\n\
         \\hline\n",
        prose(&table.title())
    );
    for column in &table.columns {
        out.push_str(&format!(" & {column}"));
    }
    out.push_str(" \\\\ \\hline\n");
    let mut below: Vec<String> = Vec::new();
    for row in &table.rows {
        out.push_str(&prose(row.label()));
        for (cell, count) in row.merged() {
            let text = filled(cell, &mut below);
            out.push_str(&match count {
                1 => format!("\n & {text}"),
                _ => {
                    let width = count * COLUMN + (count - 1) * GAP;
                    format!(
                        "\n & \\multicolumn{{{count}}}{{>{{\\centering\\arraybackslash}}\
                         p{{{width}mm}}|}}{{{text}}}"
                    )
                }
            });
        }
        out.push_str(" \\\\ \\hline\n");
    }
    out.push_str("\\end{tabular}\n");
    let definitions = table.definitions.iter().map(|claim| stated(claim, None)).chain(below);
    let notes = table.notes.iter().map(|note| prose(note));
    let theorems = table.theorems.iter().enumerate();
    let theorems = theorems.map(|(k, text)| format!("({}) {}", letter(k), prose(text)));
    for line in definitions.chain(notes).chain(theorems) {
        out.push_str(&format!("\n{line}\n"));
    }
    out.push_str("\\end{document}\n");
    with_encoding(out)
}

fn filled(cell: &Filled, below: &mut Vec<String>) -> String {
    let mut lines: Vec<String> = cell.words.iter().map(|text| prose(&one_line(text))).collect();
    for claim in cell.shown() {
        lines.push(stated(claim, Some(&mut *below)));
    }
    let text = if lines.is_empty() { "--".to_string() } else { lines.join(" \\newline ") };
    match cell.exists {
        true => format!("\\cellcolor[gray]{{0.88}} {text}"),
        false => text,
    }
}

/// Sets a claim; a formula too wide for a cell goes below the table, where there is a place for it.
fn stated(claim: &CellClaim, below: Option<&mut Vec<String>>) -> String {
    let text = match (claim.stated(), below) {
        (StatedCell::Formula(layout, _), Some(below)) if widest(layout) > WIDEST => {
            below.push(format!("[{}] ${}$", below.len() + 1, formula(layout)));
            format!("{} [{}]", prose(&one_line(&claim.name)), below.len())
        }
        (StatedCell::Formula(layout, _), _) => format!("${}$", formula(layout)),
        (StatedCell::Words(words), _) => prose(&one_line(words)),
    };
    let mark = match claim.mark() {
        "✓" => "$\\checkmark$",
        "✗" => "$\\times$",
        mark => mark,
    };
    let letter = claim.letter().map_or(String::new(), |letter| format!(" ({letter})"));
    let link = target(&claim.path).replace('%', "\\%").replace('_', "\\_");
    format!("{mark} \\href{{{link}}}{{{}}}: {text}{letter}", claim.verdict())
}
