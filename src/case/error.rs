//! Errors in case files, with their places.

use std::ops::Range;

use super::claims::statements_with;
use super::utf8::NotUtf8;
use crate::formula::{FormulaError, Type};
use crate::order::StableOrder;

/// Mistakes of a case file, at least one, in the order of the file.
///
/// A mistake that only follows from another, such as the use of a name whose declaration could not
/// be read, is left out.
///
/// ```
/// use liouville::case::Case;
///
/// let text = "title = 't'\n[state]\nx = '0..1'\n[field]\n\"x'\" = '2x'\n[[claim]]\nintegral = 'y'\n";
/// let error = Case::parse(text, &[]).unwrap_err();
/// let lines: Vec<_> = error.mistakes().iter().map(|mistake| mistake.line).collect();
/// assert_eq!(lines, [Some(5), Some(7)]);
/// assert_eq!(error.mistakes()[0].help().as_deref(), Some("write `2*x`"));
/// ```
#[derive(Debug)]
pub struct CaseError {
    mistakes: Vec<Mistake>,
}

/// A problem of a case file at a place in its text.
#[derive(Debug)]
pub struct Mistake {
    /// Problem found.
    pub problem: Problem,
    /// Byte range of the file that the problem concerns; `None` for the file as a whole.
    pub span: Option<Range<usize>>,
    /// Line on which the range begins, from 1.
    pub line: Option<u32>,
    /// Column in which the range begins, from 1.
    pub column: Option<u32>,
}

/// Problem of a case file.
#[derive(Debug, thiserror::Error)]
pub enum Problem {
    /// The file cannot be read.
    #[error("cannot read the file: {0}")]
    Io(std::io::Error),
    /// The file is not UTF-8.
    #[error("{0}")]
    NotUtf8(NotUtf8),
    /// The path is a folder, a pipe or a device.
    #[error("this is not a regular file")]
    NotAFile,
    /// The file is larger than any case needs.
    #[error("the file has {0} bytes; a case file may have up to {1}")]
    TooLarge(u64, u64),
    /// The file is not valid TOML.
    #[error("{message}")]
    Toml {
        /// Message of the TOML reader.
        message: String,
        /// Suggested correction.
        help: Option<String>,
    },
    /// The file is empty.
    #[error("the file is empty")]
    Empty,
    /// The key has no meaning here.
    #[error("unknown key `{key}` in {section}")]
    UnknownKey {
        /// Key.
        key: String,
        /// Table that contains it.
        section: String,
        /// Nearest known key.
        nearest: Option<&'static str>,
        /// All known keys.
        known: Box<[&'static str]>,
    },
    /// A required key is missing.
    #[error("{section} has no `{key}`")]
    MissingKey {
        /// Key.
        key: &'static str,
        /// Table that lacks it.
        section: String,
        /// Suggested correction.
        remedy: String,
    },
    /// A table lacks one of several alternative keys.
    #[error("{message}")]
    Incomplete {
        /// Table.
        section: String,
        /// Message about the missing keys.
        message: String,
        /// Suggested correction.
        remedy: String,
    },
    /// Names are defined in terms of each other.
    #[error("`{0}` is defined in terms of itself: {1}")]
    Cycle(String, String),
    /// The value has the wrong type.
    #[error("`{key}` should be {expected}")]
    WrongType {
        /// Key.
        key: String,
        /// Description of the expected value.
        expected: String,
        /// Suggested correction.
        remedy: String,
    },
    /// The name is not an identifier, or is taken.
    #[error("`{name}` cannot be a name here: {reason}")]
    BadName {
        /// Name.
        name: String,
        /// Reason for the rejection.
        reason: String,
    },
    /// The formula cannot be read.
    #[error("{}", .0.message())]
    Formula(FormulaError),
    /// The formula has the wrong type.
    #[error("{what} should be a {}, but this is a {}", told(*.expected, *.found), told(*.found, *.expected))]
    WrongKind {
        /// Name of the quantity that the formula defines.
        what: String,
        /// Expected type.
        expected: Type,
        /// Actual type.
        found: Type,
    },
    /// The formula depends on a name that it must not depend on.
    #[error("{what} may depend on {allowed} only, not on `{name}`")]
    Reach {
        /// Name of the quantity that the formula defines.
        what: String,
        /// Names that it may depend on.
        allowed: String,
        /// Name that it depends on.
        name: String,
    },
    /// The name is none of a state variable.
    #[error("`{name}` is not a state variable")]
    NotAVariable {
        /// Name.
        name: String,
        /// Suggested correction.
        remedy: String,
    },
    /// The parameter is not a number, a list or a range.
    #[error("{0}")]
    Parameter(String),
    /// The parts are valid, and contradict each other.
    #[error("{message}")]
    Sense {
        /// Message that describes the problem.
        message: String,
        /// Suggested correction.
        remedy: String,
    },
    /// Any other problem, with its remedy.
    #[error("{message}")]
    Other {
        /// Message that describes the problem.
        message: String,
        /// Suggested correction.
        remedy: String,
    },
}

/// Name of a type, with its size where the sizes differ.
fn told(kind: Type, other: Type) -> String {
    match kind.differs_in_size(other) {
        true => kind.in_full(),
        false => kind.to_string(),
    }
}

impl CaseError {
    /// Collects the mistakes of the file `text`, at least one, and finds their lines and columns.
    pub(super) fn new(mut mistakes: Vec<Mistake>, text: &str) -> Self {
        for mistake in &mut mistakes {
            let before = mistake.span.as_ref().and_then(|span| text.get(..span.start));
            mistake.line = before.map(|before| before.matches('\n').count() as u32 + 1);
            mistake.column = before
                .map(|before| before.chars().rev().take_while(|c| *c != '\n').count() as u32 + 1);
        }
        // mistakes of the file as a whole come first
        mistakes.order_by_key(|mistake| mistake.span.as_ref().map(|span| span.start));
        Self { mistakes }
    }

    /// A single mistake without a place in the text.
    pub(super) fn whole(problem: Problem) -> Self {
        Self { mistakes: vec![Mistake::whole(problem)] }
    }

    /// The error of a source from which no case can be read.
    pub fn of_source(message: String, remedy: String) -> Self {
        Self::whole(Problem::Other { message, remedy })
    }

    /// All mistakes, in the order of the file.
    pub fn mistakes(&self) -> &[Mistake] {
        &self.mistakes
    }
}

impl Mistake {
    /// A problem at a place.
    pub(super) fn at(span: Range<usize>, problem: Problem) -> Self {
        Self::new(Some(span), problem)
    }

    /// A problem of the file as a whole.
    pub(super) fn whole(problem: Problem) -> Self {
        Self::new(None, problem)
    }

    /// A problem at a place, where that is known.
    pub(super) fn new(span: Option<Range<usize>>, problem: Problem) -> Self {
        Self { problem, span, line: None, column: None }
    }

    /// Unknown name that caused the mistake, if it is of that kind.
    pub(super) fn unknown_name(&self) -> Option<&str> {
        match &self.problem {
            Problem::Formula(error) => error.unknown_name(),
            Problem::NotAVariable { name, .. } => Some(name),
            _ => None,
        }
    }

    /// Message in one line.
    pub fn message(&self) -> String {
        self.problem.to_string()
    }

    /// Suggested correction.
    pub fn help(&self) -> Option<String> {
        match &self.problem {
            Problem::UnknownKey { nearest: Some(nearest), .. } => {
                Some(format!("did you mean `{nearest}`?"))
            }
            Problem::UnknownKey { key, known, .. } if key == "L" && known.contains(&"kinetic") => {
                Some(
                    "write L = T − U in two parts, kinetic = \"T\" and potential = \"U\", or \
                     kinetic = \"…\" with the whole of L"
                        .to_string(),
                )
            }
            Problem::UnknownKey { nearest: None, known, key, section, .. } => {
                let owners = match section == "[[claim]]" {
                    true => statements_with(key),
                    false => Vec::new(),
                };
                Some(match owners.len() {
                    0 | 5.. => format!("known here: {}", known.join(", ")),
                    _ => format!("write it in a claim with `{}`", owners.join("`, `")),
                })
            }
            Problem::MissingKey { remedy, .. }
            | Problem::Incomplete { remedy, .. }
            | Problem::Sense { remedy, .. }
            | Problem::NotAVariable { remedy, .. }
            | Problem::Other { remedy, .. } => Some(remedy.clone()),
            Problem::Cycle(..) => Some("define one of them without the others".to_string()),
            Problem::BadName { name, .. } => Some(match name.split_once('[') {
                Some((whole, _)) if !whole.is_empty() => format!(
                    "declare the whole vector, as {whole} = \"vector(5, -1..1)\"; its components are \
                     {whole}[1], {whole}[2], …"
                ),
                _ => "give it another name".to_string(),
            }),
            Problem::Formula(error) => error.help().map(str::to_string),
            Problem::Toml { help, .. } => help.clone(),
            Problem::Io(_) | Problem::NotAFile => {
                Some("give a case file: TOML in UTF-8; `liouville new` writes one".to_string())
            }
            Problem::NotUtf8(_) => Some(NotUtf8::HELP.to_string()),
            Problem::WrongType { remedy, .. } => Some(remedy.clone()),
            Problem::WrongKind { expected, found, .. } => Some(of_kind(*expected, *found)),
            Problem::Reach { name, .. } if name == "r" => {
                Some("the support function h is −(r,γ)".to_string())
            }
            Problem::Reach { allowed, .. } => Some(format!("write it by {allowed}")),
            Problem::Empty => Some("`liouville new` writes a case to start from".to_string()),
            Problem::Parameter(_) => Some(
                "write a number (1.5, \"3/7\"), a list ([1, 2, 3]), a range (\"0.5..2\"), \
                 vector(-1..1), vector(4, -1..1), matrix(4, 4, -1..1), symmetric(4, -1..1), \
                 skew(4, -1..1), diag(1..4), spherical(1..3), inertia(0.5..5), \
                 axisymmetric(0.5..5), full(0.5..5), rotation, \"one of 1, 2, 3\", or a formula"
                    .to_string(),
            ),
            Problem::TooLarge(..) => Some("divide the claims among several files".to_string()),
        }
    }
}

/// Advice for a formula of another type than expected.
fn of_kind(expected: Type, found: Type) -> String {
    let advice = match (expected, found) {
        (Type::Scalar, Type::Vector(_)) => {
            "write a scalar: a component `a[1]`, a norm `|a|` or a product `(a,b)`"
        }
        (Type::Scalar, Type::Matrix(..)) => {
            "write a scalar: an entry `A[1,2]`, `tr(A)` or `det(A)`"
        }
        (Type::Vector(_), Type::Scalar) => "write a vector, such as `[0, 0, 1]` or `2*γ`",
        (Type::Vector(_), Type::Matrix(..)) => "write a vector, such as `A*v`",
        (Type::Matrix(..), Type::Scalar) => "write a matrix, such as `2*E` or `diag(1, 2, 3)`",
        (Type::Matrix(..), Type::Vector(_)) => {
            "write a matrix, such as `hat(v)` of a vector v, or `diag(1, 2, 3)`"
        }
        _ => "write it in that size",
    };
    advice.to_string()
}

impl std::fmt::Display for Mistake {
    /// Writes line and column, and the message.
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let (Some(line), Some(column)) = (self.line, self.column) {
            write!(out, "{line}:{column}: ")?;
        }
        self.problem.fmt(out)
    }
}

impl std::error::Error for Mistake {}

impl std::fmt::Display for CaseError {
    /// Writes one line for each mistake.
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (index, mistake) in self.mistakes.iter().enumerate() {
            write!(out, "{}{mistake}", if index > 0 { "\n" } else { "" })?;
        }
        Ok(())
    }
}

impl std::error::Error for CaseError {}
