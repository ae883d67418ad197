//! Errors in formulas, with their place and a remedy.

use std::fmt;
use std::ops::Range;

/// Byte range of the formula's text.
pub(super) type Span = Range<usize>;

/// An error in a formula, ready to be shown below the line it was written on.
///
/// One pointer wide, since every step of reading a formula returns a result with one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormulaError(Box<PlacedFault>);

#[derive(Clone, Debug, PartialEq, Eq)]
struct PlacedFault {
    message: String,
    span: Span,
    help: Option<String>,
    unknown: Option<String>,
    /// Whether an index is too large or too small.
    out_of_range: bool,
    /// Whether the kinds of the operands fit, but their sizes do not.
    of_sizes: bool,
}

impl FormulaError {
    pub(super) fn new(span: Span, message: impl Into<String>) -> Self {
        Self(Box::new(PlacedFault {
            message: message.into(),
            span,
            help: None,
            unknown: None,
            out_of_range: false,
            of_sizes: false,
        }))
    }

    pub(crate) fn with_help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// Marks the error as one about an unknown name.
    pub(super) fn with_unknown(mut self, name: &str) -> Self {
        self.0.unknown = Some(name.to_string());
        self
    }

    /// Marks the error as one about an index that is too large or too small.
    pub(super) fn with_index_out_of_range(mut self) -> Self {
        self.0.out_of_range = true;
        self
    }

    /// Whether the error is an index that is too large or too small.
    pub fn is_out_of_range(&self) -> bool {
        self.0.out_of_range
    }

    /// Marks the error as one about sizes alone.
    pub(super) fn with_sizes(mut self) -> Self {
        self.0.of_sizes = true;
        self
    }

    /// Whether the kinds of the operands fit, but their sizes do not.
    pub fn is_of_sizes(&self) -> bool {
        self.0.of_sizes
    }

    /// Unknown name that caused the error, as written.
    pub fn unknown_name(&self) -> Option<&str> {
        self.0.unknown.as_deref()
    }

    /// Message that describes the error.
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// Place of the error, in bytes of the formula's text.
    pub fn span(&self) -> Range<usize> {
        self.0.span.clone()
    }

    /// Suggested correction, if there is one.
    pub fn help(&self) -> Option<&str> {
        self.0.help.as_deref()
    }
}

impl fmt::Display for FormulaError {
    /// Writes the message and, after a colon, the help.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.0.message)?;
        self.0.help.iter().try_for_each(|help| write!(out, ": {help}"))
    }
}

impl std::error::Error for FormulaError {}

/// Text of a piece of a formula in a message; a long one is cut in the middle.
pub(crate) fn excerpt(text: &str) -> String {
    const LONGEST: usize = 60;
    const END: usize = 25;
    let count = text.chars().count();
    if count <= LONGEST {
        return text.to_string();
    }
    let start: String = text.chars().take(END).collect();
    let end: String = text.chars().skip(count - END).collect();
    format!("{start} … {end}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_prints_its_message_and_help() {
        let bare = FormulaError::new(1..2, "missing `*`");
        assert_eq!(bare.to_string(), "missing `*`", "no help, no colon");
        let helped = bare.with_help("write `2*m`");
        assert_eq!(helped.to_string(), "missing `*`: write `2*m`", "the help follows");
        assert_eq!((helped.span(), helped.help()), (1..2, Some("write `2*m`")), "and is kept");
    }

    #[test]
    fn long_pieces_are_cut() {
        assert_eq!(excerpt("a + b"), "a + b", "short pieces stay whole");
        let cut = excerpt(&"γ + ".repeat(1000));
        assert!(cut.chars().count() < 60 && cut.contains('…'), "long ones are cut: {cut}");
    }
}
