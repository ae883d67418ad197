//! A document on a terminal.

use comfy_table::{ContentArrangement, Table, presets};

use liouville_report::survey::{Document, JudgedClaim, SectionBlock, TableCell, VerdictMark};

/// Style of the output.
#[derive(Clone, Copy, Debug)]
pub struct PageStyle {
    /// Whether to show the grounds of each verdict.
    pub verbose: bool,
    /// Whether to use colours.
    pub colour: bool,
    /// Width to lay out for.
    pub width: u16,
}

const GREEN: &str = "\u{1b}[32m";
const RED: &str = "\u{1b}[31m";
const YELLOW: &str = "\u{1b}[33m";
const BOLD: &str = "\u{1b}[1m";
const PLAIN: &str = "\u{1b}[0m";

impl PageStyle {
    fn painted(self, text: &str, colour: &str) -> String {
        if self.colour { format!("{colour}{text}{PLAIN}") } else { text.to_string() }
    }
}

/// Renders the whole document.
pub fn render(document: &Document, style: PageStyle) -> String {
    let mut out = format!("{}\n", style.painted(&document.title, BOLD));
    for section in &document.sections {
        out.push_str(&format!("\n{}\n", style.painted(section.title, BOLD)));
        for block in &section.blocks {
            out.push_str(&set(block, style));
        }
    }
    out
}

fn set(block: &SectionBlock, style: PageStyle) -> String {
    match block {
        SectionBlock::Text(text) => wrapped(text, "  ", "  ", style.width),
        SectionBlock::List(items) => {
            items.iter().map(|item| wrapped(item, "  - ", "    ", style.width)).collect()
        }
        SectionBlock::Definitions(lines) => {
            lines.iter().map(|(text, _)| wrapped(text, "  - ", "    ", style.width)).collect()
        }
        SectionBlock::Folded(..) if !style.verbose => String::new(),
        SectionBlock::Folded(_, lines) => {
            lines.iter().map(|line| wrapped(line, "  | ", "  | ", style.width)).collect()
        }
        SectionBlock::Entry(entry) => self::entry(entry, style),
        SectionBlock::Table { head, rows } => table(head, rows, style),
        SectionBlock::Picture(_) => String::new(),
    }
}

fn entry(entry: &JudgedClaim, style: PageStyle) -> String {
    let colour = match entry.mark {
        VerdictMark::Holds => GREEN,
        VerdictMark::Fails => RED,
        VerdictMark::Open => YELLOW,
    };
    let mark = style.painted(&format!("{} {:<9}", entry.mark.sign(), entry.verdict), colour);
    let mut out = format!("  {mark} {}", entry.name);
    if !entry.source.is_empty() {
        out.push_str(&format!("   [{}]", entry.source));
    }
    out.push('\n');
    let deep = "              ";
    if let Some(statement) = &entry.statement {
        out.push_str(&wrapped(statement, deep, "                ", style.width));
    }
    for (definition, _) in &entry.definitions {
        out.push_str(&wrapped(definition, "                ", "                  ", style.width));
    }
    for remark in &entry.remarks {
        out.push_str(&wrapped(remark, deep, deep, style.width));
    }
    if style.verbose {
        for line in &entry.evidence {
            out.push_str(&wrapped(line, "              | ", "              | ", style.width));
        }
    }
    out
}

fn table(head: &[&str], rows: &[Vec<TableCell>], style: PageStyle) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_width(style.width.saturating_sub(4)).force_no_tty();
    table.set_header(head.to_vec());
    for row in rows {
        let cells = row.iter().map(|cell| match cell {
            TableCell::Text(text) | TableCell::Formula(text, _) => text.clone(),
        });
        table.add_row(cells.collect::<Vec<_>>());
    }
    table.trim_fmt().lines().map(|line| format!("   {line}\n")).collect()
}

/// Wraps a text to the width of the terminal; words stay whole.
fn wrapped(text: &str, first: &str, next: &str, width: u16) -> String {
    let mut out = String::from(first);
    let mut length = first.chars().count();
    let mut is_start = true;
    for word in text.split_whitespace() {
        let size = word.chars().count();
        if !is_start && length + 1 + size > usize::from(width) {
            out.push('\n');
            out.push_str(next);
            length = next.chars().count();
            is_start = true;
        }
        if !is_start {
            out.push(' ');
            length += 1;
        }
        out.push_str(word);
        length += size;
        is_start = false;
    }
    out + "\n"
}
