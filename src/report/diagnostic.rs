//! Problems shown at their place in the user's file, in the manner of rustc.

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::Failure;
use crate::case::{CaseError, Mistake};

/// The mistakes of the file `path` with the text `source`.
pub fn of_case(path: &str, source: &str, error: &CaseError, colour: bool) -> Vec<Failure> {
    let told = |mistake: &Mistake| of_mistake(path, source, mistake, colour);
    error.mistakes().iter().map(told).collect()
}

/// All of them, as they are shown on a terminal.
pub fn rendered(failures: &[Failure]) -> String {
    let texts: Vec<&str> = failures.iter().map(|failure| failure.rendered.as_str()).collect();
    texts.join("\n\n")
}

fn of_mistake(path: &str, source: &str, mistake: &Mistake, colour: bool) -> Failure {
    let span = mistake.span.clone().filter(|span| source.get(span.clone()).is_some());
    let (message, help) = (mistake.message(), mistake.help());
    let title = Level::ERROR.primary_title(message.as_str());
    let group = match span {
        Some(span) => title.element(
            Snippet::source(source).path(path).annotation(AnnotationKind::Primary.span(span)),
        ),
        None => title.element(Level::NOTE.message(format!("in {path}"))),
    };
    let rendered = render(group, help.as_deref(), colour);
    Failure { message, help, line: mistake.line, column: mistake.column, rendered }
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
