//! Case files, read into a [`Case`]: a model with its names, a chart, and claims.

mod abbreviations;
mod absences;
mod arbitrary;
mod ask;
mod ball;
mod body;
mod build;
mod builder;
mod charts;
mod claim_error;
mod claim_table;
mod claims;
mod clock;
mod complex;
mod ends;
mod entries;
mod equations;
mod error;
mod family;
mod feedback;
mod field;
mod foreign;
mod formulas;
mod frame;
mod halves;
mod hamiltonian;
mod holonomic;
mod homogeneous;
mod implied;
mod kinds;
mod labels;
mod lagrangian;
mod lines;
mod lists;
mod map;
mod mistakes;
mod one_sided;
mod order;
mod parameters;
mod poincare;
mod remarks;
mod repeated;
mod repeated_constraints;
mod section;
mod shadows;
mod shaped;
mod shapes;
mod simplified;
mod state;
mod stated;
mod synonyms;
mod systems;
mod toml_errors;
mod turning;
mod utf8;
mod value;
mod values;
mod variables;
mod velocities;
mod weights;

use std::io::Read;
use std::path::Path;

use crate::claim::absence::Absence;
use crate::claim::motion::MotionKind;
use crate::claim::{ClaimKind, LevelSubset};
use crate::mechanics::{Chart, Draw, Model};

pub use crate::claim::Expect;
pub use builder::ModelBuilder;
pub use claim_error::ClaimError;
pub use claims::{ShapedKey, claim_keys};
pub use clock::TimeParts;
pub use ends::number;
pub use error::{CaseError, Mistake, Problem};
pub use kinds::SYSTEM_NAMES;
pub use labels::{is_labelled, labels, matches};
pub use lines::FixedLine;
pub use one_sided::OneSided;
pub use parameters::Setting;
pub use poincare::{Angle, Direction, SectionPlan};
pub use remarks::CaseRemark;
pub use utf8::{NotUtf8, utf8};
pub use value::{FormulaSource, ValueSpec};

/// Name of the list of papers in a folder of cases, which is not a case itself.
const PAPERS: &str = "papers.toml";

/// Whether a file of a folder is a case: its name ends in `.toml`, and is not `papers.toml`, the
/// list of statements of papers with the claims that state them.
pub fn is_case_file(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "toml")
        && path.file_name().is_some_and(|name| name != PAPERS)
}

/// Limit on the size of a case file, above that of any real one.
const MAX_BYTES: u64 = 4 << 20;

/// A case: a system with its parameters, and the claims about it.
#[derive(Clone, Debug)]
pub struct Case {
    /// Title of the case.
    pub title: String,
    /// Publication that the case is taken from.
    pub source: String,
    /// `rubber-plane`, `rubber-sphere`, `rolling-plane`, `rolling-sphere`, `flat-base`,
    /// `ball-on-surface`, `nonholonomic`, `vakonomic`, `field` or `map`.
    pub system: String,
    /// Equations and names.
    pub model: Model,
    /// Chart that makes states.
    pub chart: Chart,
    /// Draws of the state's components where no chart makes them.
    pub free_draws: Vec<Draw>,
    /// Claims in the order of the file.
    pub claims: Vec<PlacedClaim>,
    /// Claims about motion in the order of the file.
    pub motions: Vec<MotionClaim>,
    /// The claims of absence in the order of the file.
    pub absences: Vec<AbsenceClaim>,
    /// Table and column of the paper that this case belongs to.
    pub column: Option<Column>,
    /// Poincaré section that shows the motion.
    pub section: Option<SectionPlan>,
    /// One-sided constraint on the motion.
    pub one_sided: Option<OneSided>,
    /// Notes of the author on the verdicts.
    pub notes: Vec<String>,
    /// Warnings about statements that may be unintended.
    pub warnings: Vec<String>,
    /// Remarks on what the file may say by mistake, such as parameters without use.
    pub remarks: Vec<CaseRemark>,
    /// The system without `t`, where claims alone use `t`.
    without_time: Option<clock::WithoutTime>,
}

/// A column of one of the paper's tables.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Number of the table.
    pub table: u32,
    /// Number of the column, from 1.
    pub column: u32,
    /// Words of the paper in some rows: row and text.
    pub words: Vec<(String, String)>,
    /// Caption of the table, which one of its columns gives.
    pub caption: Option<String>,
    /// Notes under the table.
    pub notes: Vec<String>,
}

/// Rows of the papers' tables, and those of the table of rolling with and without spin; the last
/// are the definitions under a table.
pub const TABLE_ROWS: [&str; 14] = [
    "body",
    "inertia",
    "surface",
    "restriction",
    "measure",
    "integral",
    "structure",
    "gyrostat",
    "generalisation",
    "rubber-plane",
    "rolling-plane",
    "rubber-sphere",
    "rolling-sphere",
    DEFINITIONS,
];

/// Row of the claims that define the letters of a table, under which they are printed.
pub const DEFINITIONS: &str = "definition";

/// A claim of a case: its statement at a place, with its expectation.
#[derive(Clone, Debug)]
pub struct PlacedClaim {
    /// Name, unique in the case.
    pub name: String,
    /// Statement of the claim.
    pub kind: ClaimKind,
    /// Equation number, table or section in the publication.
    pub source: String,
    /// Place where it is claimed.
    pub place: LevelSubset,
    /// Whether it is claimed to fail outside of the place.
    pub only_there: bool,
    /// Whether a report on it is wanted; otherwise it is judged for the sake of others.
    pub is_wanted: bool,
    /// Expectation of the file.
    pub expect: Expect,
    /// Table row this claim belongs to.
    pub cell: Option<String>,
    /// Remark of the author.
    pub note: Option<String>,
}

/// A claim about motion with its expectation.
#[derive(Clone, Debug)]
pub struct MotionClaim {
    /// Name, unique in the case.
    pub name: String,
    /// Statement of the claim.
    pub kind: MotionKind,
    /// Equation number, figure or section in the publication.
    pub source: String,
    /// Expectation of the file.
    pub expect: Expect,
    /// Remark of the author.
    pub note: Option<String>,
}

/// A claim of absence with the expected verdict.
#[derive(Clone, Debug)]
pub struct AbsenceClaim {
    /// Its name; unique in the case.
    pub name: String,
    /// The statement.
    pub kind: Absence,
    /// Equation number, theorem, section.
    pub source: String,
    /// Expected outcome.
    pub expect: Expect,
    /// The row of the paper's table that it fills.
    pub cell: Option<String>,
    /// A remark.
    pub note: Option<String>,
}

impl Case {
    /// Reads a case file; also returns its text.
    pub fn read(path: &Path, settings: &[Setting]) -> (String, Result<Self, CaseError>) {
        let io = |error| CaseError::whole(Problem::Io(error));
        let size = match std::fs::metadata(path) {
            Ok(metadata) if !metadata.is_file() => {
                return (String::new(), Err(CaseError::whole(Problem::NotAFile)));
            }
            Ok(metadata) => metadata.len(),
            Err(error) => return (String::new(), Err(io(error))),
        };
        if size > MAX_BYTES {
            return (String::new(), Err(CaseError::whole(Problem::TooLarge(size, MAX_BYTES))));
        }
        match std::fs::read(path) {
            Ok(bytes) => Self::from_bytes(bytes, settings),
            Err(error) => (String::new(), Err(io(error))),
        }
    }

    /// Reads a case from the bytes of a file; also returns its text.
    fn from_bytes(bytes: Vec<u8>, settings: &[Setting]) -> (String, Result<Self, CaseError>) {
        match utf8(bytes) {
            Ok(text) => {
                let case = Self::parse(&text, settings);
                (text, case)
            }
            Err(error) => {
                let text = error.lossy.clone();
                let mistake = Mistake::at(error.span.clone(), Problem::NotUtf8(error));
                let error = CaseError::new(vec![mistake], &text);
                (text, Err(error))
            }
        }
    }

    /// Reads a case from a stream, such as standard input; also returns its text.
    pub fn read_from(input: impl Read, settings: &[Setting]) -> (String, Result<Self, CaseError>) {
        let mut bytes = Vec::new();
        match input.take(MAX_BYTES + 1).read_to_end(&mut bytes) {
            Ok(size) if size as u64 > MAX_BYTES => {
                let size = Problem::TooLarge(size as u64, MAX_BYTES);
                (String::new(), Err(CaseError::whole(size)))
            }
            Ok(_) => Self::from_bytes(bytes, settings),
            Err(error) => (String::new(), Err(CaseError::whole(Problem::Io(error)))),
        }
    }

    /// Reads the text of a case file.
    ///
    /// The error holds all mistakes that do not follow from each other, each with its place.
    pub fn parse(text: &str, settings: &[Setting]) -> Result<Self, CaseError> {
        build::build(text, settings)
    }

    /// Finds the claim of this name.
    pub fn claim(&self, name: &str) -> Option<&PlacedClaim> {
        self.claims.iter().find(|claim| claim.name == name)
    }
}
