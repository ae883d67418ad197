//! Tables of the paper, filled from verdicts.

mod markup;

use std::collections::BTreeMap;

use comfy_table::{Cell, ContentArrangement, Table, presets};
use serde::Serialize;

use super::RunReport;
use liouville::case::{Expect, TABLE_ROWS};
use liouville::verdict::Verdict;

/// A table of the paper with a status in each cell.
#[derive(Debug, Serialize)]
pub struct Regenerated {
    table: u32,
    columns: Vec<u32>,
    rows: Vec<Row>,
}

#[derive(Debug, Serialize)]
struct Row {
    row: &'static str,
    cells: Vec<Filled>,
}

/// A cell: the paper's words, and the claims behind them.
#[derive(Clone, Debug, Default, Serialize)]
struct Filled {
    words: Vec<String>,
    status: Status,
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
}

/// Collects table `number` from a run over the catalogue.
pub fn regenerate(run: &RunReport, number: u32) -> Regenerated {
    let mut cells: BTreeMap<(&str, u32), Filled> = BTreeMap::new();
    let mut columns: Vec<u32> = Vec::new();
    for outcome in &run.outcomes {
        let Some(column) = outcome.heading.column.as_ref().filter(|c| c.table == number) else {
            continue;
        };
        columns.push(column.column);
        for (row, words) in &column.words {
            let cell = cells.entry((row, column.column)).or_default();
            if !cell.words.contains(words) {
                cell.words.push(words.clone());
            }
        }
        for claim in outcome.result.iter().flat_map(|report| &report.claims) {
            let Some(row) = &claim.cell else { continue };
            cells.entry((row, column.column)).or_default().claims.push(CellClaim {
                path: outcome.path.clone(),
                name: claim.name.clone(),
                kind: claim.kind,
                expect: claim.expect,
                verdict: claim.verdict,
                agrees: claim.agrees,
            });
        }
    }
    columns.sort_unstable();
    columns.dedup();
    for cell in cells.values_mut() {
        cell.status = status(&cell.claims);
    }
    let row = |row: &'static str| Row {
        row,
        cells: columns
            .iter()
            .map(|column| cells.get(&(row, *column)).cloned().unwrap_or_default())
            .collect(),
    };
    // A row that is empty in all columns belongs to another table.
    let said = |row: &Row| row.cells.iter().any(|cell| !cell.is_empty());
    let rows = TABLE_ROWS.into_iter().map(row).filter(said).collect();
    Regenerated { table: number, rows, columns }
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
        markup::markdown(self)
    }

    /// Renders a LaTeX table for XeLaTeX or LuaLaTeX with hyperref.
    pub fn latex(&self) -> String {
        markup::latex(self)
    }

    /// Renders the table as JSON.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self)
    }

    /// Renders the table as text for a terminal of this width; one with far more columns than rows
    /// is turned.
    pub fn text(&self, width: u16) -> String {
        let name = format!("Table {}", self.table);
        let mut lines = vec![std::iter::once(name).chain(self.numbers()).collect::<Vec<String>>()];
        lines.extend(self.rows.iter().map(|row| {
            let cells = row.cells.iter().map(Filled::text);
            std::iter::once(row.row.to_string()).chain(cells).collect()
        }));
        if self.columns.len() > 2 * self.rows.len() {
            let turned = |k: usize| lines.iter().map(|line| line[k].clone()).collect();
            lines = (0..=self.columns.len()).map(turned).collect();
        }
        let mut table = Table::new();
        table.load_style(presets::UTF8_FULL).set_content_arrangement(ContentArrangement::Dynamic);
        table.set_width(width).force_no_tty();
        for (k, line) in lines.into_iter().enumerate() {
            let cells: Vec<Cell> = line.into_iter().map(Cell::new).collect();
            match k {
                0 => table.set_header(cells),
                _ => table.add_row(cells),
            };
        }
        format!("{}\n", table.trim_fmt())
    }

    fn numbers(&self) -> impl Iterator<Item = String> {
        self.columns.iter().map(u32::to_string)
    }
}

impl CellClaim {
    /// Sign of the claim: as expected, against it, or open.
    fn mark(&self) -> &'static str {
        match (self.agrees, self.expect) {
            (false, _) => "✗",
            (true, Expect::Open) => "?",
            (true, _) => "✓",
        }
    }
}

impl Filled {
    fn is_empty(&self) -> bool {
        self.words.is_empty() && self.claims.is_empty()
    }

    fn text(&self) -> String {
        let mut lines = self.words.clone();
        for claim in &self.claims {
            lines.push(format!("{} {}: {}", claim.mark(), claim.verdict.word(), claim.name));
        }
        if lines.is_empty() { "–".to_string() } else { lines.join("\n") }
    }
}
