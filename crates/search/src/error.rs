//! Reasons why a search, or a part of it, ends without a result.

use liouville::case::ClaimError;
use liouville::formula::FormulaError;
use liouville::graph::Fault;
use liouville::verdict::JudgeError;

/// The reason why a search is impossible.
#[derive(Debug, thiserror::Error)]
pub enum SearchError {
    /// Positions and velocities cannot be separated, or the field has no series in them.
    #[error("integrals cannot be counted: {0}")]
    Unsplit(&'static str),
    /// The rates are not polynomials of degree 2 in the velocities.
    #[error("integrals cannot be counted: the rates are not quadratic in the velocities")]
    NotQuadratic,
    /// The equations for the coefficients do not determine all of some order.
    #[error(
        "integrals cannot be counted: there may be infinitely many, or derivatives of a higher order \
         are needed to bound their number"
    )]
    Unbounded,
    /// The field has functions that prime fields lack, or is defined nowhere.
    #[error(
        "no Taylor series of the field modulo a prime was found: it contains exp, ln, sin, cos or x^y, \
         or many roots, which few points have all"
    )]
    NoSeries,
    /// A minor is not a fraction of low degree in a parameter.
    #[error("the equations are not fractions of low degree in the parameter")]
    NoFraction,
    /// A term given by the user cannot be read.
    #[error("the term `{0}` cannot be read: {1}")]
    NoTerm(String, String),
    /// The case has no claim of this name.
    #[error("the case has no claim `{0}`")]
    NoClaim(String),
    /// The count did not become stable.
    #[error("the count of integrals of degree {0} did not stabilise: there may be infinitely many")]
    Unsettled(u32),
    /// The elimination takes more steps than the effort allows.
    #[error("{unknowns} unknowns take more than {seconds} s; raise --count-seconds")]
    Long {
        /// Number of unknowns.
        unknowns: usize,
        /// Limit that was reached.
        seconds: f64,
    },
    /// The series of orbits take more steps than the effort allows.
    #[error("series of orbits take more than {seconds} s; raise --count-seconds")]
    Series {
        /// Limit that was reached.
        seconds: f64,
    },
    /// The elimination takes more memory than the effort allows.
    #[error("{unknowns} unknowns take more than {megabytes} MB; raise --count-megabytes")]
    Large {
        /// Number of unknowns.
        unknowns: usize,
        /// Limit that was reached.
        megabytes: u64,
    },
    /// The time limit was reached, or the search was stopped. Not an error; recorded in the report.
    #[error("the search was stopped")]
    Stopped,
    /// States cannot be parametrised in a prime field.
    #[error("the level set has no parametrisation")]
    NoChart,
    /// No point at which all terms have a value was found.
    #[error(
        "no point modulo a prime was found at which all terms have values: they contain exp, ln, sin, \
         cos or x^y, or many roots, which few points have all"
    )]
    NoPoints,
    /// Recording failed.
    #[error(transparent)]
    Fault(#[from] Fault),
    /// The candidate is not a valid claim for this case.
    #[error("the candidate is not a valid claim for this case: {0}")]
    Unfit(#[from] ClaimError),
    /// A field or map of the search itself cannot be built.
    #[error("a system of the search cannot be built: {0}")]
    Unbuilt(ClaimError),
    /// A formula cannot be made of others.
    #[error("the formula of a candidate cannot be written: {0}")]
    Unwritten(#[from] FormulaError),
    /// Judging failed.
    #[error(transparent)]
    Judge(#[from] JudgeError),
}

impl SearchError {
    /// Whether the error concerns counts only, and not the rest of a search.
    pub(crate) fn is_of_count(&self) -> bool {
        use SearchError::{
            Large, Long, NoSeries, NotQuadratic, Series, Unbounded, Unsettled, Unsplit,
        };
        let is_costly = matches!(self, Long { .. } | Large { .. } | Series { .. });
        is_costly || matches!(self, NoSeries | NotQuadratic | Unbounded | Unsettled(_) | Unsplit(_))
    }

    /// Suggests a remedy.
    pub fn help(&self) -> &'static str {
        match self {
            SearchError::Judge(error) => error.help(),
            SearchError::NoChart => "give [level.chart], or level equations that can be solved",
            SearchError::NoClaim(_) => "name a claim as `liouville check` prints it",
            SearchError::Unsettled(_) => "ask for a lower --degree",
            SearchError::NoTerm(..) => {
                "write a scalar; `liouville names` lists the names of a case"
            }
            SearchError::NoSeries | SearchError::NoPoints => {
                "make such functions state variables, as in s' = c*φ', c' = −s*φ' for the sine and \
                 the cosine of φ, and r' = (x*x' + y*y')/r for r = √(x² + y²)"
            }
            SearchError::Unsplit(_) | SearchError::NotQuadratic | SearchError::Unbounded => {
                "search with --ansatz=4, which needs no velocities"
            }
            _ => "`liouville check` judges what you claim by hand",
        }
    }
}
