//! Problems displayed at their place in the user's file, in the manner of rustc.

use std::any::Any;
use std::ops::Range;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::FileFailure;
use liouville::case::{CaseError, Mistake};
use liouville::mechanics::written;
use liouville::verdict::JudgeError;

/// Failures for the mistakes in the file `path` with the text `source`.
pub fn of_case(path: &str, source: &str, error: &CaseError, colour: bool) -> Vec<FileFailure> {
    let told = |mistake: &Mistake| of_mistake(path, source, mistake, colour);
    error.mistakes().iter().map(told).collect()
}

/// Joins failures for display on a terminal.
pub fn rendered(failures: &[FileFailure]) -> String {
    let texts: Vec<&str> = failures.iter().map(|failure| failure.rendered.as_str()).collect();
    texts.join("\n\n")
}

/// Message of a panic.
pub fn panic_message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message")
}

fn of_mistake(path: &str, source: &str, mistake: &Mistake, colour: bool) -> FileFailure {
    at(path, source, mistake.span.clone(), mistake.message(), mistake.help(), colour)
}

/// Failure for an error that prevents judging the case in the file `path` with the text `source`.
pub fn of_judging(path: &str, source: &str, error: &JudgeError, colour: bool) -> FileFailure {
    let place = |text: &str| {
        let written = written(text);
        source.find(written).map(|start| start..start + written.len())
    };
    let span = match error {
        JudgeError::NotInvariant { equation, .. }
        | JudgeError::OffSolution { equation, .. }
        | JudgeError::Dependent(equation)
        | JudgeError::Slopeless(equation, _) => place(equation),
        JudgeError::Quadrature(formula) => place(formula),
        JudgeError::OffLevel { equation, .. } => place("[level.chart]").or_else(|| place(equation)),
        JudgeError::PartialChart { .. } => place("[level.chart]"),
        JudgeError::Unreachable(_) => place("[level]").or_else(|| place("[level.chart]")),
        JudgeError::NotSkew(block) => key(source, &format!("\"{block},{block}\""))
            .or_else(|| key(source, "bracket"))
            .or_else(|| place("bracket")),
        _ => None,
    };
    at(path, source, span, error.to_string(), Some(error.help().to_string()), colour)
}

/// Place of a key, with spaces or without: that of its first letters before a `=`.
fn key(source: &str, key: &str) -> Option<Range<usize>> {
    let is_key = |end: usize| source[end..].trim_start().starts_with('=');
    let found = source.match_indices(key).map(|(start, _)| start..start + key.len());
    let mut found = found.filter(|place| is_key(place.end));
    found.next()
}

/// Failure at a place, or in the file as a whole.
fn at(
    path: &str,
    source: &str,
    span: Option<Range<usize>>,
    message: String,
    help: Option<String>,
    colour: bool,
) -> FileFailure {
    let span = span.filter(|span| source.get(span.clone()).is_some());
    let before = span.as_ref().map(|span| &source[..span.start]);
    let line = before.map(|before| before.matches('\n').count() + 1);
    let column = before.map(|before| before.chars().rev().take_while(|c| *c != '\n').count() + 1);
    let title = Level::ERROR.primary_title(message.as_str());
    let group = match span {
        Some(span) => title.element(
            Snippet::source(source).path(path).annotation(AnnotationKind::Primary.span(span)),
        ),
        None => title.element(Level::NOTE.message(format!("in {path}"))),
    };
    let rendered = render(group, help.as_deref(), colour);
    FileFailure { message, help, line, column, rendered }
}

/// Failure at a place in the text of an option.
pub fn of_option(
    option: &str,
    text: &str,
    span: Range<usize>,
    message: &str,
    help: Option<&str>,
    colour: bool,
) -> FileFailure {
    at(option, text, Some(span), message.to_string(), help.map(str::to_string), colour)
}

/// Failure that concerns a file, or a folder, as a whole.
pub fn of_file(path: &str, message: &str, help: &str, colour: bool) -> FileFailure {
    let title = Level::ERROR.primary_title(message);
    let group = title.element(Level::NOTE.message(format!("in {path}")));
    let rendered = render(group, Some(help), colour);
    let (message, help) = (message.to_string(), Some(help.to_string()));
    FileFailure { message, help, line: None, column: None, rendered }
}

fn render<'a>(group: Group<'a>, help: Option<&'a str>, colour: bool) -> String {
    let group = match help {
        Some(help) => group.element(Level::HELP.message(help)),
        None => group,
    };
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    renderer.decor_style(DecorStyle::Ascii).render(&[group])
}
