//! What can be wrong with a case file, and where.

use std::ops::Range;

use crate::formula::{FormulaError, Type};

/// All that is wrong with a case file: at least one mistake, in the order of the file.
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
    /// What is wrong.
    pub problem: Problem,
    /// The bytes of the file that it concerns; `None` for the file as a whole.
    pub span: Option<Range<usize>>,
    /// The line on which they begin, from 1.
    pub line: Option<u32>,
    /// The column in which they begin, from 1.
    pub column: Option<u32>,
}

/// What is wrong with a case file.
#[derive(Debug, thiserror::Error)]
pub enum Problem {
    /// The file cannot be read.
    #[error("cannot read the file: {0}")]
    Io(std::io::Error),
    /// A folder, a pipe, a device.
    #[error("this is not a regular file")]
    NotAFile,
    /// The file is larger than any case needs.
    #[error("the file has {0} bytes; a case file may have up to {1}")]
    TooLarge(u64, u64),
    /// Not TOML.
    #[error("{message}")]
    Toml {
        /// What the TOML reader says.
        message: String,
        /// What may help.
        help: Option<String>,
    },
    /// Nothing in it.
    #[error("the file is empty")]
    Empty,
    /// A key that means nothing here.
    #[error("unknown key `{key}` in {section}")]
    UnknownKey {
        /// The key.
        key: String,
        /// The table it stands in.
        section: String,
        /// The nearest key that is known.
        nearest: Option<&'static str>,
        /// All that are known.
        known: Box<[&'static str]>,
    },
    /// A key that is needed.
    #[error("{section} has no `{key}`")]
    MissingKey {
        /// The key.
        key: &'static str,
        /// The table it should stand in.
        section: String,
        /// What to write.
        remedy: String,
    },
    /// A table that lacks one of several keys.
    #[error("{message}")]
    Incomplete {
        /// The table.
        section: String,
        /// What it needs.
        message: String,
        /// What to write.
        remedy: String,
    },
    /// Names that are defined by each other.
    #[error("`{0}` is defined by itself: {1}")]
    Cycle(String, String),
    /// A value of another type.
    #[error("`{key}` should be {expected}")]
    WrongType {
        /// The key.
        key: String,
        /// What belongs there.
        expected: String,
    },
    /// Not an identifier, or one that is taken.
    #[error("`{name}` cannot be a name here: {reason}")]
    BadName {
        /// The name.
        name: String,
        /// Why not.
        reason: String,
    },
    /// A formula that cannot be read.
    #[error("{}", .0.message())]
    Formula(FormulaError),
    /// A formula of another kind.
    #[error("{what} should be a {}, but this is a {}", told(*.expected, *.found), told(*.found, *.expected))]
    WrongKind {
        /// What the formula defines.
        what: String,
        /// What it should be.
        expected: Type,
        /// What it is.
        found: Type,
    },
    /// A formula that depends on what it may not depend on.
    #[error("{what} may depend on {allowed} only, not on `{name}`")]
    Reach {
        /// What the formula defines.
        what: String,
        /// What it may depend on.
        allowed: String,
        /// What it depends on.
        name: String,
    },
    /// A parameter that is not a number, a list or a range.
    #[error("{0}")]
    Parameter(String),
    /// All is of the right kind, and makes no sense together.
    #[error("{message}")]
    Sense {
        /// What is wrong.
        message: String,
        /// What to do.
        remedy: String,
    },
    /// Anything else, with its remedy.
    #[error("{message}")]
    Other {
        /// What is wrong.
        message: String,
        /// What to do.
        remedy: String,
    },
}

/// A kind, with its size where that is what differs.
fn told(kind: Type, other: Type) -> String {
    match kind.differs_in_size(other) {
        true => kind.in_full(),
        false => kind.to_string(),
    }
}

impl CaseError {
    /// The mistakes of the file `text`, of which there is at least one.
    pub(super) fn new(mut mistakes: Vec<Mistake>, text: &str) -> Self {
        for mistake in &mut mistakes {
            let before = mistake.span.as_ref().and_then(|span| text.get(..span.start));
            mistake.line = before.map(|before| before.matches('\n').count() as u32 + 1);
            mistake.column = before
                .map(|before| before.chars().rev().take_while(|c| *c != '\n').count() as u32 + 1);
        }
        // what concerns the file as a whole stands first
        mistakes.sort_by_key(|mistake| mistake.span.as_ref().map(|span| span.start));
        Self { mistakes }
    }

    /// A mistake that has no place in the text.
    pub(super) fn whole(problem: Problem) -> Self {
        Self { mistakes: vec![Mistake::whole(problem)] }
    }

    /// All mistakes.
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

    /// The name that is not known, where that is the trouble.
    pub(super) fn unknown_name(&self) -> Option<&str> {
        match &self.problem {
            Problem::Formula(error) => error.unknown_name(),
            _ => None,
        }
    }

    /// What is wrong, in one line.
    pub fn message(&self) -> String {
        self.problem.to_string()
    }

    /// What would be right.
    pub fn help(&self) -> Option<String> {
        match &self.problem {
            Problem::UnknownKey { nearest: Some(nearest), .. } => {
                Some(format!("did you mean `{nearest}`?"))
            }
            Problem::UnknownKey { nearest: None, known, .. } => {
                Some(format!("known here: {}", known.join(", ")))
            }
            Problem::MissingKey { remedy, .. }
            | Problem::Incomplete { remedy, .. }
            | Problem::Sense { remedy, .. }
            | Problem::Other { remedy, .. } => Some(remedy.clone()),
            Problem::Cycle(..) => Some("write one of them out".to_string()),
            Problem::BadName { .. } => Some("give it another name".to_string()),
            Problem::Formula(error) => error.help().map(str::to_string),
            Problem::Toml { help, .. } => help.clone(),
            Problem::Io(_) | Problem::NotAFile => Some(
                "give a case file: TOML in UTF-8; docs/writing-a-case.md shows how".to_string(),
            ),
            Problem::WrongType { key, .. } => {
                Some(format!("docs/writing-a-case.md shows what `{key}` takes"))
            }
            Problem::Reach { name, .. } if name == "r" => {
                Some("the support function h is −(r,γ)".to_string())
            }
            Problem::Empty => Some("docs/writing-a-case.md shows the smallest case".to_string()),
            Problem::Parameter(_) => Some(
                "write a number (1.5, \"3/7\"), a list ([1, 2, 3]), a range (\"0.5..2\"), \
                 vector(-1..1), vector(4, -1..1), matrix(4, 4, -1..1), symmetric(4, -1..1), \
                 skew(4, -1..1), diag(1..4), spherical(1..3), inertia(0.5..5), \
                 axisymmetric(0.5..5), full(0.5..5), rotation, \"one of 1, 2, 3\", or a formula"
                    .to_string(),
            ),
            _ => None,
        }
    }
}

impl std::fmt::Display for Mistake {
    /// Line and column, and what is wrong.
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let (Some(line), Some(column)) = (self.line, self.column) {
            write!(out, "{line}:{column}: ")?;
        }
        self.problem.fmt(out)
    }
}

impl std::error::Error for Mistake {}

impl std::fmt::Display for CaseError {
    /// One line a mistake.
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (index, mistake) in self.mistakes.iter().enumerate() {
            write!(out, "{}{mistake}", if index > 0 { "\n" } else { "" })?;
        }
        Ok(())
    }
}

impl std::error::Error for CaseError {}
