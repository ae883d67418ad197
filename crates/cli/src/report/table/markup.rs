//! Tables of the paper as Markdown and as LaTeX.

use super::{CellClaim, Filled, Regenerated};
use crate::report::typeset::latex::escaped;

/// Renders a Markdown table: rows as in the paper, verdicts as links.
pub fn markdown(table: &Regenerated) -> String {
    let mut out = format!("| Table {} |", table.table);
    for column in &table.columns {
        out.push_str(&format!(" {column} |"));
    }
    out.push_str(&format!("\n|{}\n", "---|".repeat(table.columns.len() + 1)));
    for row in &table.rows {
        out.push_str(&format!("| **{}** |", row.row));
        for cell in &row.cells {
            let claim = |claim: &CellClaim| {
                let (mark, verdict) = (claim.mark(), claim.verdict.word());
                let name = claim.name.replace(['|', '[', ']'], "\u{2223}");
                format!("[{mark} {verdict}: {name}]({})", claim.path)
            };
            out.push_str(&format!(" {} |", joined(cell, |w| w.replace('|', "\\|"), claim, "<br>")));
        }
        out.push('\n');
    }
    out
}

/// Renders a LaTeX table, with one paragraph column for each body.
pub fn latex(table: &Regenerated) -> String {
    let count = table.columns.len();
    let width = 0.86 / count.max(1) as f64;
    let mut out = format!(
        "% XeLaTeX or LuaLaTeX, with hyperref\n\\begin{{tabular}}{{l*{{{count}}}{{p{{{width:.3}\\linewidth}}}}}}\n\
         Table {}",
        table.table
    );
    for column in &table.columns {
        out.push_str(&format!(" & {column}"));
    }
    out.push_str(" \\\\\n\\hline\n");
    for row in &table.rows {
        out.push_str(row.row);
        for cell in &row.cells {
            let claim = |claim: &CellClaim| {
                let text = format!("{}: {}", claim.verdict.word(), claim.name);
                let mark = match claim.mark() {
                    "✓" => "$\\checkmark$",
                    "✗" => "$\\times$",
                    mark => mark,
                };
                format!("{mark} \\href{{run:{}}}{{{}}}", claim.path, escaped(&text))
            };
            out.push_str(&format!(" & {}", joined(cell, escaped, claim, " \\newline ")));
        }
        out.push_str(" \\\\\n");
    }
    out.push_str("\\end{tabular}\n");
    out
}

/// Joins the words of a cell and its claims, or returns a dash.
fn joined(
    cell: &Filled,
    words: impl Fn(&str) -> String,
    claim: impl Fn(&CellClaim) -> String,
    separator: &str,
) -> String {
    let lines: Vec<String> =
        cell.words.iter().map(|w| words(w)).chain(cell.claims.iter().map(claim)).collect();
    if lines.is_empty() { "–".to_string() } else { lines.join(separator) }
}
