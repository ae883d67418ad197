//! Tables of the papers, filled from verdicts: the formula of each claim in its cell, what is
//! proved absent, the definitions and notes under the table.

mod html;
mod latex;
mod markdown;
mod markup;
mod text;

use std::collections::BTreeMap;

use serde::Serialize;

use super::{Heading, RunReport};
use liouville::case::{DEFINITIONS, Expect, TABLE_ROWS};
use liouville::formula::Layout;
use liouville::verdict::{ClaimReport, Verdict};

/// A table of the paper with a status in each cell.
#[derive(Debug, Serialize)]
pub struct Regenerated {
    table: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    caption: Option<String>,
    columns: Vec<u32>,
    rows: Vec<TableRow>,
    /// Claims that define the letters of the table.
    definitions: Vec<CellClaim>,
    notes: Vec<String>,
    /// Theorems on absence, which cells name by a letter.
    theorems: Vec<String>,
}

#[derive(Debug, Serialize)]
struct TableRow {
    row: &'static str,
    cells: Vec<Filled>,
}

/// A cell: the paper's words, and the claims behind them.
#[derive(Clone, Debug, Default, Serialize)]
struct Filled {
    words: Vec<String>,
    status: Status,
    /// Whether the invariant of the row is proved to exist.
    exists: bool,
    claims: Vec<CellClaim>,
}

/// Status of a cell, by its verdicts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Status {
    /// Words only, without claims.
    #[default]
    Text,
    /// All claims agree with the paper.
    Agrees,
    /// Only claims whose answer is open.
    Open,
    /// Some verdict contradicts the paper.
    Contradicts,
}

#[derive(Clone, Debug, Serialize)]
struct CellClaim {
    path: String,
    name: String,
    kind: &'static str,
    expect: Expect,
    verdict: Verdict,
    agrees: bool,
    /// Formula as typed.
    #[serde(skip_serializing_if = "Option::is_none")]
    formula: Option<String>,
    /// Index of the theorem among those of the table.
    #[serde(skip_serializing_if = "Option::is_none")]
    theorem: Option<usize>,
    /// Formula as boxes.
    #[serde(skip)]
    layout: Option<Layout>,
}

/// Statement of a claim in its cell.
enum StatedCell<'c> {
    /// A formula: as boxes, and as typed.
    Formula(&'c Layout, &'c str),
    /// Words.
    Words(&'c str),
}

/// Collects table `number` from a run over the catalogue.
pub fn regenerate(run: &RunReport, number: u32) -> Regenerated {
    let mut cells: BTreeMap<(&str, u32), Filled> = BTreeMap::new();
    let mut table = Regenerated {
        table: number,
        caption: None,
        columns: Vec::new(),
        rows: Vec::new(),
        definitions: Vec::new(),
        notes: Vec::new(),
        theorems: Vec::new(),
    };
    for outcome in &run.outcomes {
        let Some(column) = outcome.heading.column.as_ref().filter(|c| c.table == number) else {
            continue;
        };
        table.columns.push(column.column);
        table.caption = table.caption.or_else(|| column.caption.clone());
        table.notes.extend(column.notes.iter().cloned());
        for (row, words) in &column.words {
            let cell = cells.entry((row, column.column)).or_default();
            if !cell.words.contains(words) {
                cell.words.push(words.clone());
            }
        }
        for claim in outcome.result.iter().flat_map(|report| &report.claims) {
            let Some(row) = &claim.cell else { continue };
            let filled = CellClaim::of(&outcome.path, &outcome.heading, claim, &mut table.theorems);
            match row == DEFINITIONS {
                true => table.definitions.push(filled),
                false => cells.entry((row, column.column)).or_default().claims.push(filled),
            }
        }
    }
    table.columns.sort_unstable();
    table.columns.dedup();
    for ((row, _), cell) in &mut cells {
        cell.status = status(&cell.claims);
        cell.exists = cell.claims.iter().any(|claim| claim.is_existence(row));
    }
    let row = |row: &'static str| TableRow {
        row,
        cells: table
            .columns
            .iter()
            .map(|column| cells.get(&(row, *column)).cloned().unwrap_or_default())
            .collect(),
    };
    // A row that is empty in all columns belongs to another table.
    let said = |row: &TableRow| row.cells.iter().any(|cell| !cell.is_empty());
    table.rows = TABLE_ROWS.into_iter().map(row).filter(said).collect();
    table
}

fn status(claims: &[CellClaim]) -> Status {
    match claims {
        [] => Status::Text,
        _ if claims.iter().any(|claim| !claim.agrees) => Status::Contradicts,
        _ if claims.iter().all(|claim| claim.expect == Expect::Open) => Status::Open,
        _ => Status::Agrees,
    }
}

impl Regenerated {
    /// Whether the catalogue has no case for this table.
    pub fn is_empty(&self) -> bool {
        self.columns.is_empty()
    }

    /// Renders a Markdown table; each verdict is a link to its case.
    pub fn markdown(&self) -> String {
        markdown::render(self)
    }

    /// Renders a LaTeX document for any LaTeX.
    pub fn latex(&self) -> String {
        latex::render(self)
    }

    /// Renders a web page with formulas in MathML.
    pub fn html(&self) -> String {
        html::render(self)
    }

    /// Renders the table as JSON.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self)
    }

    /// Renders the table as text for a terminal of this width.
    pub fn text(&self, width: u16) -> String {
        text::render(self, width)
    }

    fn title(&self) -> String {
        match &self.caption {
            Some(caption) => format!("Table {}. {caption}", self.table),
            None => format!("Table {}", self.table),
        }
    }
}

impl TableRow {
    /// Name of the row in the papers.
    fn label(&self) -> &'static str {
        match self.row {
            "inertia" => "inertia tensor",
            "surface" => "surface of the body",
            "restriction" => "geometric and dynamical restrictions",
            "integral" => "additional integral",
            "gyrostat" => "integrable addition of a gyrostat",
            "generalisation" => "generalisations and remarks",
            row => row,
        }
    }

    /// Cells as columns wide: neighbours with the same words and no claims are one cell.
    fn merged(&self) -> Vec<(&Filled, usize)> {
        let mut out: Vec<(&Filled, usize)> = Vec::new();
        for cell in &self.cells {
            match out.last_mut() {
                Some((last, count)) if last.heads(cell) => *count += 1,
                _ => out.push((cell, 1)),
            }
        }
        out
    }
}

impl CellClaim {
    fn of(
        path: &str,
        heading: &Heading,
        claim: &ClaimReport,
        theorems: &mut Vec<String>,
    ) -> CellClaim {
        let theorem = claim.evidence.theorem.as_ref().map(|text| {
            theorems.iter().position(|known| known == text).unwrap_or_else(|| {
                theorems.push(text.clone());
                theorems.len() - 1
            })
        });
        CellClaim {
            path: path.to_string(),
            name: claim.name.clone(),
            kind: claim.kind,
            expect: claim.expect,
            verdict: claim.verdict,
            agrees: claim.agrees,
            formula: claim.formula.clone(),
            theorem,
            layout: heading.statements.get(&claim.name).cloned(),
        }
    }

    /// Whether the claim, in a cell of this row, proves that the invariant of the row exists.
    fn is_existence(&self, row: &str) -> bool {
        let kinds: &[&str] = match row {
            "measure" => &["density", "position-density", "analytic-density"],
            "integral" | "gyrostat" | "generalisation" => &["integral"],
            _ => &[],
        };
        self.verdict == Verdict::Proved && kinds.contains(&self.kind)
    }

    /// Sign of the claim: as expected, against it, or open.
    fn mark(&self) -> &'static str {
        match (self.agrees, self.expect) {
            (false, _) => "✗",
            (true, Expect::Open) => "?",
            (true, _) => "✓",
        }
    }

    /// Verdict on what [`stated`](Self::stated) says.
    fn verdict(&self) -> &'static str {
        match self.absent() {
            Some(_) => Verdict::Proved.word(),
            None => self.verdict.word(),
        }
    }

    /// The theorem that a refuted existence is.
    fn absent(&self) -> Option<&'static str> {
        match (self.verdict, self.kind) {
            (Verdict::Refuted, "analytic-density") => {
                Some("no density that is positive and analytic near ω = 0")
            }
            (Verdict::Refuted, "position-density") => Some("no density of the position alone"),
            _ => None,
        }
    }

    /// Statement of the claim: its formula if it has one, what is absent, or its name.
    fn stated(&self) -> StatedCell<'_> {
        match (self.absent(), &self.layout, &self.formula) {
            (Some(words), ..) => StatedCell::Words(words),
            (None, Some(layout), Some(typed)) => StatedCell::Formula(layout, typed),
            _ => StatedCell::Words(&self.name),
        }
    }

    /// Letter of the theorem under the table.
    fn letter(&self) -> Option<String> {
        self.theorem.map(letter)
    }
}

/// Letter of a theorem: a, b, …, z, a1, ….
fn letter(index: usize) -> String {
    let letter = char::from(b'a' + (index % 26) as u8);
    match index / 26 {
        0 => letter.to_string(),
        round => format!("{letter}{round}"),
    }
}

impl Filled {
    fn is_empty(&self) -> bool {
        self.words.is_empty() && self.claims.is_empty()
    }

    /// Claims that the cell shows: the first of those that state the same.
    fn shown(&self) -> impl Iterator<Item = &CellClaim> {
        let same = |a: &CellClaim, b: &CellClaim| {
            a.layout.is_some()
                && a.layout == b.layout
                && a.verdict == b.verdict
                && a.agrees == b.agrees
        };
        self.claims.iter().enumerate().filter_map(move |(index, claim)| {
            let is_new = !self.claims[..index].iter().any(|before| same(before, claim));
            is_new.then_some(claim)
        })
    }

    /// Whether the cell and its neighbour are one: both have words only, the same, and no dash.
    fn heads(&self, next: &Filled) -> bool {
        let only_words =
            |cell: &Filled| cell.claims.is_empty() && cell.words.iter().any(|words| words != "–");
        only_words(self) && only_words(next) && self.words == next.words
    }
}

/// Text in one line.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_no_markup() {
        assert_eq!(target("a}\\input{evil}%.toml"), "a%7D%5Cinput%7Bevil%7D%25.toml");
        assert_eq!(target("cases/plane/ball.toml"), "cases/plane/ball.toml");
        assert_eq!([letter(0), letter(25), letter(26)], ["a", "z", "a1"]);
    }

    #[test]
    fn neighbours_with_the_same_words_are_one_cell() {
        let words = |text: &str| Filled { words: vec![text.to_string()], ..Filled::default() };
        let row =
            TableRow { row: "surface", cells: vec![words("ball"), words("ball"), words("disk")] };
        let widths: Vec<usize> = row.merged().iter().map(|(_, count)| *count).collect();
        assert_eq!(widths, [2, 1]);
        let empty = TableRow { row: "surface", cells: vec![Filled::default(), Filled::default()] };
        assert_eq!(empty.merged().len(), 2, "cells without words stay apart");
    }
}
