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
                format!("[{mark} {verdict}: {}](<{}>)", inline(&claim.name), target(&claim.path))
            };
            out.push_str(&format!(" {} |", joined(cell, inline, claim, "<br>")));
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
                format!(
                    "{mark} \\href{{{}}}{{{}}}",
                    target(&claim.path).replace('%', "\\%"),
                    escaped(&text)
                )
            };
            let words = |text: &str| escaped(&one_line(text));
            out.push_str(&format!(" & {}", joined(cell, words, claim, " \\newline ")));
        }
        out.push_str(" \\\\\n");
    }
    out.push_str("\\end{tabular}\n");
    out
}

/// Text in one line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Text in one line of a Markdown table, with what would be markup escaped.
fn inline(text: &str) -> String {
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

/// Path as the target of a link: all but plain characters are percent-encoded.
fn target(path: &str) -> String {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || b"/.-_".contains(&byte);
    path.bytes()
        .map(|byte| match is_plain(byte) {
            true => char::from(byte).to_string(),
            false => format!("%{byte:02X}"),
        })
        .collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_and_paths_are_no_markup() {
        assert_eq!(inline("<b>|x\ny"), "&lt;b&gt;\\|x y");
        assert_eq!(inline("![x](http://x)"), "\\!\\[x\\](http://x)");
        assert_eq!(target("a}\\input{evil}%.toml"), "a%7D%5Cinput%7Bevil%7D%25.toml");
        assert_eq!(target("cases/plane/ball.toml"), "cases/plane/ball.toml");
    }
}
