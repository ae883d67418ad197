//! Problems shown at their place in the user's file, in the manner of rustc.

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::Failure;
use crate::case::CaseError;

/// A problem of the file `path` with the text `source`.
pub fn of_case(path: &str, source: &str, error: &CaseError, colour: bool) -> Failure {
    let span = error.span.clone().filter(|span| source.get(span.clone()).is_some());
    let before = span.as_ref().map(|span| &source[..span.start]);
    let line = before.map(|before| before.matches('\n').count() + 1);
    let column = before.map(|before| before.chars().rev().take_while(|c| *c != '\n').count() + 1);
    let (message, help) = (error.message(), error.help());
    let title = Level::ERROR.primary_title(message.as_str());
    let group = match span {
        Some(span) => title.element(
            Snippet::source(source).path(path).annotation(AnnotationKind::Primary.span(span)),
        ),
        None => title.element(Level::NOTE.message(format!("in {path}"))),
    };
    let rendered = render(group, help.as_deref(), colour);
    Failure { message, help, line, column, rendered }
}

/// A problem that concerns a file, or a folder, as a whole.
pub fn of_file(path: &str, message: &str, help: &str, colour: bool) -> Failure {
    let title = Level::ERROR.primary_title(message);
    let group = title.element(Level::NOTE.message(format!("in {path}")));
    let rendered = render(group, Some(help), colour);
    let (message, help) = (message.to_string(), Some(help.to_string()));
    Failure { message, help, line: None, column: None, rendered }
}

fn render<'a>(group: Group<'a>, help: Option<&'a str>, colour: bool) -> String {
    let group = match help {
        Some(help) => group.element(Level::HELP.message(help)),
        None => group,
    };
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    renderer.decor_style(DecorStyle::Ascii).render(&[group])
}
