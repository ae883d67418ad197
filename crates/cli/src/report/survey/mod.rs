//! Reports of surveys: on a terminal, as Markdown, LaTeX and one HTML page.
//!
//! ```text
//! Survey ─ compose ─▶ Document ─▶ terminal, markdown, latex, html
//! ```
//!
//! The content is made once, in `compose`; a format only typesets it.

mod compose;
mod document;
mod entry;
mod html;
mod latex;
mod markdown;
mod motion;
mod picture;
mod terminal;

use liouville_flow::{FlowError, Portrait};
use liouville_search::survey::Survey;

pub use terminal::Style;

/// Renders the survey as JSON.
pub fn json(survey: &Survey) -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(survey)
}

/// Renders the survey for a terminal; `origin` names the program and the case in all formats.
pub fn text(survey: &Survey, origin: &str, style: Style) -> String {
    terminal::render(&compose::document(survey, origin), style)
}

/// Renders the survey as Markdown, with formulas as LaTeX between dollars.
pub fn markdown(survey: &Survey, origin: &str) -> String {
    markdown::render(&compose::document(survey, origin))
}

/// Renders the survey as a LaTeX document, for XeLaTeX or LuaLaTeX.
pub fn latex(survey: &Survey, origin: &str) -> String {
    latex::render(&compose::document(survey, origin))
}

/// Renders the survey as one self-contained HTML page, with a section of the body's motion, or the
/// reason why there is none.
pub fn html(survey: &Survey, origin: &str, motion: Result<&Portrait, &FlowError>) -> String {
    let mut document = compose::document(survey, origin);
    document.insert_motion(motion);
    html::render(&document)
}
