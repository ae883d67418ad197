//! Problems shown at their place in the user's file, in the manner of rustc.

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use crate::case::CaseError;

/// Renders a problem of the file `path` with the text `source`.
pub fn render(path: &str, source: &str, error: &CaseError, colour: bool) -> String {
    let (message, help) = (error.message(), error.help());
    let title = Level::ERROR.primary_title(message.as_str());
    let span = error.span.clone().filter(|span| span.end <= source.len());
    let group = match span {
        Some(span) => title.element(
            Snippet::source(source).path(path).annotation(AnnotationKind::Primary.span(span)),
        ),
        None => title.element(Level::NOTE.message(format!("in {path}"))),
    };
    let group = match &help {
        Some(help) => group.element(Level::HELP.message(help.as_str())),
        None => group,
    };
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    renderer.decor_style(DecorStyle::Ascii).render(&[group])
}

/// Renders a problem that concerns the file as a whole.
pub fn render_plain(path: &str, message: &str, help: &str, colour: bool) -> String {
    let group = Level::ERROR
        .primary_title(message)
        .element(Level::NOTE.message(format!("in {path}")))
        .element(Level::HELP.message(help));
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    renderer.decor_style(DecorStyle::Ascii).render(&[group])
}
