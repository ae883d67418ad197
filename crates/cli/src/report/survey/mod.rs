//! Reports of surveys: on a terminal, and with the pictures of the motion.

mod motion;
mod terminal;

use liouville_flow::{FlowError, Portrait};
use liouville_search::survey::Survey;

pub use liouville_report::survey::{Document, document, json, latex, markdown, of_claims};
pub use terminal::PageStyle;

/// Renders the survey for a terminal; `origin` names the program and the case in all formats.
pub fn text(survey: &Survey, origin: &str, style: PageStyle) -> String {
    terminal::render(&document(survey, origin), style)
}

/// Renders the survey as one self-contained HTML page, with a section of the body's motion, or the
/// reason why there is none.
pub fn html(survey: &Survey, origin: &str, motion: Result<&Portrait, &FlowError>) -> String {
    with_motion(survey, origin, motion).html()
}

/// Composes the document of a survey, with a section of the body's motion.
pub fn with_motion(
    survey: &Survey,
    origin: &str,
    motion: Result<&Portrait, &FlowError>,
) -> Document {
    let mut document = document(survey, origin);
    document.insert(motion::section(motion));
    document
}
