//! A report as sections of blocks, independent of the output format.

use super::picture::Picture;
use liouville::formula::Layout;

/// A whole report.
pub struct Document {
    /// Title of the case.
    pub title: String,
    /// Description of the system in one sentence.
    pub lead: String,
    /// Class of the system, in a few words.
    pub headline: String,
    /// Sections of the report.
    pub sections: Vec<DocumentSection>,
}

/// A section of a report.
pub struct DocumentSection {
    /// Heading of the section.
    pub title: &'static str,
    /// Contents of the section.
    pub blocks: Vec<SectionBlock>,
}

/// A block of a section.
pub enum SectionBlock {
    /// A paragraph.
    Text(String),
    /// Items of a list.
    List(Vec<String>),
    /// Definitions, each as typed and, if it can be, as typeset.
    Definitions(Vec<(String, Option<Layout>)>),
    /// Heading and lines that are folded away where the format allows it.
    Folded(&'static str, Vec<String>),
    /// A claim with its verdict.
    Entry(Box<JudgedClaim>),
    /// A table with a heading.
    Table {
        /// Heading of each column.
        head: Vec<&'static str>,
        /// Rows, as long as the heading.
        rows: Vec<Vec<TableCell>>,
    },
    /// A picture, for formats that support them.
    Picture(Picture),
}

/// A cell of a table.
pub enum TableCell {
    /// Words.
    Text(String),
    /// A formula, as typed and as typeset.
    Formula(String, Option<Layout>),
}

/// A claim with its verdict.
pub struct JudgedClaim {
    /// Mark of the verdict.
    pub mark: VerdictMark,
    /// Verdict in one word.
    pub verdict: &'static str,
    /// Name of the claim.
    pub name: String,
    /// Statement of the claim, as typed.
    pub statement: Option<String>,
    /// Statement of the claim, as typeset.
    pub layout: Option<Layout>,
    /// Definitions of the names used: as typed, and as typeset.
    pub definitions: Vec<(String, Option<Layout>)>,
    /// Additional facts about the verdict, in a few words.
    pub remarks: Vec<String>,
    /// Source of the formula.
    pub source: String,
    /// Grounds of the verdict, line by line.
    pub evidence: Vec<String>,
}

/// Mark of a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VerdictMark {
    /// The claim holds.
    Holds,
    /// The claim fails.
    Fails,
    /// The claim is not decided.
    Open,
}

impl VerdictMark {
    /// Sign of the mark in all formats.
    pub fn sign(self) -> &'static str {
        match self {
            VerdictMark::Holds => "✓",
            VerdictMark::Fails => "✗",
            VerdictMark::Open => "?",
        }
    }
}

impl DocumentSection {
    /// A section, or `None` if it has no contents.
    pub fn new(title: &'static str, blocks: Vec<SectionBlock>) -> Option<Self> {
        (!blocks.is_empty()).then_some(Self { title, blocks })
    }
}
