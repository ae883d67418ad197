//! Reports of surveys: as JSON, Markdown, LaTeX and one HTML page.
//!
//! ```text
//! Survey ─ compose ─▶ Document ─▶ markdown, latex, html, and a terminal
//! ```
//!
//! The content is made once, in `compose`; a format only typesets it.

mod compose;
mod document;
mod entry;
mod html;
mod latex;
mod liouville;
mod maps;
mod markdown;
mod picture;

use liouville_search::survey::Survey;

pub use compose::{document, of_claims};
pub use document::{Document, DocumentSection, JudgedClaim, SectionBlock, TableCell, VerdictMark};
pub use entry::entry;
pub use picture::Picture;

/// Renders the survey as JSON.
pub fn json(survey: &Survey) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(survey)
}

/// Renders the survey as Markdown, with formulas as LaTeX between dollars.
pub fn markdown(survey: &Survey, origin: &str) -> String {
    markdown::render(&document(survey, origin))
}

/// Renders the survey as a LaTeX document, for XeLaTeX or LuaLaTeX.
pub fn latex(survey: &Survey, origin: &str) -> String {
    latex::render(&document(survey, origin))
}

impl Document {
    /// Inserts a section after the description of the system.
    pub fn insert(&mut self, section: DocumentSection) {
        self.sections.insert(self.sections.len().min(2), section);
    }

    /// Renders the document as one self-contained HTML page.
    pub fn html(&self) -> String {
        html::render(self, None)
    }

    /// Renders the document as a page of a site; `index` is the way to the index from there.
    pub fn html_of_site(&self, index: &str) -> String {
        html::render(self, Some(index))
    }
}
