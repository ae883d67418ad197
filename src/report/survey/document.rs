//! A report as sections of blocks, before any format: what is said, once for all formats.

use super::picture::Picture;
use crate::formula::Layout;

/// A whole report.
pub struct Document {
    /// The title of the case.
    pub title: String,
    /// One sentence on the system.
    pub lead: String,
    /// The class, in a few words.
    pub headline: String,
    /// Its parts.
    pub sections: Vec<Section>,
}

/// A part of a report.
pub struct Section {
    /// Its heading.
    pub title: &'static str,
    /// What it says.
    pub blocks: Vec<Block>,
}

/// Something that is said.
pub enum Block {
    /// A paragraph.
    Text(String),
    /// Lines of a list.
    List(Vec<String>),
    /// Lines that are folded away where a format can: what they are, and they.
    Folded(&'static str, Vec<String>),
    /// A claim with its verdict.
    Entry(Box<Entry>),
    /// A table with a heading.
    Table {
        /// The heading.
        head: Vec<&'static str>,
        /// The rows, as long as the heading.
        rows: Vec<Vec<Cell>>,
    },
    /// A picture, for formats that have them.
    Picture(Picture),
}

/// A cell of a table.
pub enum Cell {
    /// Words.
    Text(String),
    /// A formula, as typed and as set.
    Formula(String, Option<Layout>),
}

/// A claim with its verdict.
pub struct Entry {
    /// Does it hold, fail, or is it open?
    pub mark: Mark,
    /// The verdict in a word.
    pub verdict: &'static str,
    /// Its name.
    pub name: String,
    /// What it states, as typed.
    pub statement: Option<String>,
    /// The same as set.
    pub layout: Option<Layout>,
    /// The names it uses: as typed, and as set.
    pub definitions: Vec<(String, Option<Layout>)>,
    /// What the verdict says beside, in a few words.
    pub remarks: Vec<String>,
    /// Where the formula comes from.
    pub source: String,
    /// On what grounds, line by line.
    pub evidence: Vec<String>,
}

/// A verdict at a glance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// It holds.
    Holds,
    /// It fails.
    Fails,
    /// It is not decided.
    Open,
}

impl Mark {
    /// The sign used in all formats.
    pub fn sign(self) -> &'static str {
        match self {
            Mark::Holds => "✓",
            Mark::Fails => "✗",
            Mark::Open => "?",
        }
    }
}

impl Section {
    /// A section, unless it says nothing.
    pub fn new(title: &'static str, blocks: Vec<Block>) -> Option<Self> {
        (!blocks.is_empty()).then_some(Self { title, blocks })
    }
}
