//! A case file becomes a [`Case`]: a model with its names, a chart, and claims.

mod abbreviations;
mod arbitrary;
mod ask;
mod ball;
mod body;
mod build;
mod charts;
mod claims;
mod complex;
mod error;
mod family;
mod feedback;
mod field;
mod formulas;
mod hamiltonian;
mod homogeneous;
mod lagrangian;
mod lines;
mod lists;
mod map;
mod mistakes;
mod one_sided;
mod order;
mod parameters;
mod poincare;
mod section;
mod shadows;
mod shapes;
mod state;
mod synonyms;
mod systems;
mod toml_errors;
mod variables;
mod velocities;
mod weights;

use std::path::Path;

use crate::claim::motion::Motion;
use crate::claim::{Kind, Place};
use crate::mechanics::{Chart, Draw, Model};

pub use error::{CaseError, Mistake, Problem};
pub use lines::Line;
pub use one_sided::OneSided;
pub use parameters::Setting;
pub use poincare::{Angle, Direction, SectionPlan};

/// No case needs a larger file.
const MAX_BYTES: u64 = 4 << 20;

/// A case: a system with its parameters, and what is claimed about it.
#[derive(Clone, Debug)]
pub struct Case {
    /// What the case is about.
    pub title: String,
    /// Where it comes from.
    pub source: String,
    /// `rubber-plane`, `rubber-sphere`, `flat-base`, `ball-on-surface`, `nonholonomic`,
    /// `vakonomic`, `field` or `map`.
    pub system: String,
    /// The equations and names.
    pub model: Model,
    /// How states are made.
    pub chart: Chart,
    /// The draws of the state's components where no chart makes them.
    pub free_draws: Vec<Draw>,
    /// The claims in the order of the file.
    pub claims: Vec<Claim>,
    /// The claims about motion in the order of the file.
    pub motions: Vec<MotionClaim>,
    /// The table and column of the paper that this case belongs to.
    pub column: Option<Column>,
    /// The Poincaré section that shows its motion.
    pub section: Option<SectionPlan>,
    /// A one-sided constraint, where the motion has one.
    pub one_sided: Option<OneSided>,
    /// What to know beside the verdicts.
    pub notes: Vec<String>,
    /// What the file may not mean to say.
    pub warnings: Vec<String>,
}

/// A column of one of the paper's tables.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// The table's number.
    pub table: u32,
    /// The column's number, from 1.
    pub column: u32,
    /// The paper's words in some of its rows: row and text.
    pub words: Vec<(String, String)>,
}

/// The rows of the paper's tables.
pub const TABLE_ROWS: [&str; 9] = [
    "body",
    "inertia",
    "surface",
    "restriction",
    "measure",
    "integral",
    "structure",
    "gyrostat",
    "generalisation",
];

/// A claim with what is expected of it.
#[derive(Clone, Debug)]
pub struct Claim {
    /// Its name; unique in the case.
    pub name: String,
    /// What is claimed.
    pub kind: Kind,
    /// Equation number, table, section.
    pub source: String,
    /// Where it is claimed.
    pub place: Place,
    /// Is it claimed to fail wherever the place is left?
    pub only_there: bool,
    /// What the file expects.
    pub expect: Expect,
    /// The row of the paper's table that it fills.
    pub cell: Option<String>,
    /// A remark.
    pub note: Option<String>,
}

/// A claim about motion with what is expected of it.
#[derive(Clone, Debug)]
pub struct MotionClaim {
    /// Its name; unique in the case.
    pub name: String,
    /// What is claimed.
    pub kind: Motion,
    /// Equation number, figure, section.
    pub source: String,
    /// What the file expects.
    pub expect: Expect,
    /// A remark.
    pub note: Option<String>,
}

/// What the author of a case expects of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expect {
    /// It is true.
    Holds,
    /// It is false.
    Fails,
    /// Nobody knows; any verdict agrees.
    Open,
}

impl Expect {
    /// The word used in case files and reports.
    pub fn word(self) -> &'static str {
        match self {
            Expect::Holds => "holds",
            Expect::Fails => "fails",
            Expect::Open => "open",
        }
    }
}

impl Case {
    /// Reads a case file; gives its text too.
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
        match std::fs::read_to_string(path) {
            Ok(text) => {
                let case = Self::parse(&text, settings);
                (text, case)
            }
            Err(error) => (String::new(), Err(io(error))),
        }
    }

    /// Reads the text of a case file.
    ///
    /// The error holds all mistakes that do not follow from each other, each with its place.
    pub fn parse(text: &str, settings: &[Setting]) -> Result<Self, CaseError> {
        build::build(text, settings)
    }

    /// The claim of this name.
    pub fn claim(&self, name: &str) -> Option<&Claim> {
        self.claims.iter().find(|claim| claim.name == name)
    }
}
