//! Tables of the papers for a terminal.

use comfy_table::{Cell, ContentArrangement, Table, presets};

use super::{CellClaim, Filled, Regenerated, StatedCell, letter};

/// Renders the table; one with far more columns than rows is turned.
pub fn render(table: &Regenerated, width: u16) -> String {
    let name = format!("Table {}", table.table);
    let numbers = table.columns.iter().map(u32::to_string);
    let mut lines = vec![std::iter::once(name).chain(numbers).collect::<Vec<String>>()];
    lines.extend(table.rows.iter().map(|row| {
        let cells = row.cells.iter().map(filled);
        std::iter::once(row.label().to_string()).chain(cells).collect()
    }));
    if table.columns.len() > 2 * table.rows.len() {
        let turned = |k: usize| lines.iter().map(|line| line[k].clone()).collect();
        lines = (0..=table.columns.len()).map(turned).collect();
    }
    let mut grid = Table::new();
    grid.load_style(presets::UTF8_FULL).set_content_arrangement(ContentArrangement::Dynamic);
    grid.set_width(width).force_no_tty();
    for (k, line) in lines.into_iter().enumerate() {
        let cells: Vec<Cell> = line.into_iter().map(Cell::new).collect();
        match k {
            0 => grid.set_header(cells),
            _ => grid.add_row(cells),
        };
    }
    let mut out = format!("{}\n{}\n", table.title(), grid.trim_fmt());
    for claim in &table.definitions {
        out.push_str(&format!("{}\n", stated(claim)));
    }
    for note in &table.notes {
        out.push_str(&format!("{note}\n"));
    }
    for (index, theorem) in table.theorems.iter().enumerate() {
        out.push_str(&format!("({}) {theorem}\n", letter(index)));
    }
    out
}

fn filled(cell: &Filled) -> String {
    let lines: Vec<String> = cell.words.iter().cloned().chain(cell.shown().map(stated)).collect();
    if lines.is_empty() { "–".to_string() } else { lines.join("\n") }
}

fn stated(claim: &CellClaim) -> String {
    let text = match claim.stated() {
        StatedCell::Formula(_, typed) => typed,
        StatedCell::Words(words) => words,
    };
    let letter = claim.letter().map_or(String::new(), |letter| format!(" ({letter})"));
    format!("{} {}: {text}{letter}", claim.mark(), claim.verdict())
}
