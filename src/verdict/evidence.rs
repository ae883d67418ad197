//! What is known about a claim in the end, and on what grounds.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

use crate::proof::Certificate;

/// The answer to a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// True, by exact reasoning.
    Proved,
    /// Zero to rounding at every state that was tried.
    Confirmed,
    /// False: at a state the residual's enclosure excludes 0.
    Refuted,
    /// Neither, for the reason given.
    Undecided,
}

impl Verdict {
    /// The word used in reports.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Proved => "proved",
            Verdict::Confirmed => "confirmed",
            Verdict::Refuted => "refuted",
            Verdict::Undecided => "undecided",
        }
    }
}

/// A state at which a claim fails, in the form in which `eval` takes it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Witness {
    /// The number of the state under the run's seed; none for one that was looked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub index: Option<u64>,
    /// The values of the parameters that were drawn, for `--set`.
    pub parameters: BTreeMap<String, String>,
    /// The state, for `--state`.
    pub state: String,
    /// The residual there.
    pub residual: f64,
    /// A bound on the residual's error; less than its magnitude, unless that is beyond f64.
    pub error_bound: f64,
    /// The residual to a few digits, where f64 cannot tell it from 0 or from infinity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub digits: Option<String>,
}

/// How an integral relates to what every case conserves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Independence {
    /// Its gradient is independent of those of the level functions and the energy.
    Independent,
    /// It depends on the level functions and the energy.
    General,
    /// It is constant on the level: true, and says nothing.
    Constant,
}

/// The sign of a density.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sign {
    /// Positive at every state tried.
    Positive,
    /// Negative at every state tried: its negative is a measure.
    Negative,
    /// It changes sign at fixed parameters, so it has zeros or poles: invariant, but no positive
    /// measure across them.
    Changes,
}

/// A proof in prime fields.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Proof {
    /// Random primes.
    pub primes: usize,
    /// Random points, all primes together, at which the residual is 0.
    pub points: usize,
    /// Points that were drawn; some have no value.
    pub draws: u64,
    /// A bound on the degree of the residual's numerator.
    pub degree: f64,
    /// Square roots and roots of odd index in it.
    pub roots: usize,
    /// Log₂ of the probability that the residual is no identity all the same.
    pub error_log2: f64,
}

impl From<Certificate> for Proof {
    fn from(found: Certificate) -> Self {
        Self {
            primes: found.primes,
            points: found.points,
            draws: found.draws,
            degree: found.degree.ceil(),
            roots: found.roots,
            error_log2: (found.error_log2 * 10.0).ceil() / 10.0,
        }
    }
}

impl fmt::Display for Proof {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            out,
            "0 at {} points of {} prime fields ({} draws), degree ≤ {}, ",
            self.points, self.primes, self.draws, self.degree
        )?;
        match self.roots {
            0 => {}
            1 => write!(out, "1 root, ")?,
            n => write!(out, "{n} roots, ")?,
        }
        write!(out, "error < 2^{:.0}", self.error_log2)
    }
}

/// What a rung of the ladder found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rung {
    /// `folding`, `ball`, `prime field`, `double-double ball`, `ball of many bits`.
    pub rung: &'static str,
    /// In words.
    pub found: String,
}

/// A number that was measured on a motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measurement {
    /// What it is.
    pub quantity: String,
    /// Its value.
    pub value: f64,
    /// An estimate of its error, from the computation itself.
    pub error: f64,
    /// What the claim states, as it is typed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stated: Option<String>,
}

/// The grounds of a verdict.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Evidence {
    /// The rung that settled it. `folding`: the residual became the constant 0, or another, while it
    /// was recorded. `ball`, `double-double ball`, `ball of many bits`: enclosures in f64, with twice
    /// its digits, with more. `ball at numerical states`: where the level set has no parametrisation.
    /// `prime field`: an identity tested modulo random primes. `motion`: numbers from motions.
    /// `count`: a rank modulo a prime, which bounds how many there are.
    pub method: &'static str,
    /// The proof, where there is one.
    #[serde(flatten)]
    pub proof: Option<Proof>,
    /// Why prime fields have nothing to say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub silence: Option<String>,
    /// States at which the residual was computed.
    pub samples: usize,
    /// The largest |residual| where the claim holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_residual: Option<f64>,
    /// The largest |residual| over its own error bound; at most 1 where the claim holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_scaled_residual: Option<f64>,
    /// Operations of the residual a state.
    pub operations: usize,
    /// The places where it was seen to hold, widest first: `everywhere`, an equation, `level`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub holds: Vec<String>,
    /// For integrals that hold.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub independence: Option<Independence>,
    /// For densities that hold.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sign: Option<Sign>,
    /// Whether that sign is proved at all states, rather than seen at those that were tried.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub sign_is_proved: bool,
    /// What a density on a level set refers to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume: Option<String>,
    /// What else follows where a claim holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remark: Option<String>,
    /// Where a claim is refuted; where functions are independent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub witness: Option<Witness>,
    /// For claims about motion: what was measured.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub measured: Vec<Measurement>,
    /// For claims of absence that hold: what is excluded, for which parameters.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub theorem: Option<String>,
    /// For claims of absence that fail: what there is, proved.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exhibit: Option<String>,
    /// All rungs, in order.
    pub climb: Vec<Rung>,
    /// Why a claim is undecided, or what its verdict leaves open.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// A claim with its verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClaimReport {
    /// The claim's name in its case.
    pub name: String,
    /// The formula, if the claim is about one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub formula: Option<String>,
    /// The statement's key in case files: `integral`, `density`, …
    pub kind: &'static str,
    /// Equation number, table, section.
    pub source: String,
    /// Where it is claimed.
    #[serde(rename = "where")]
    pub place: String,
    /// What the file expects.
    pub expect: &'static str,
    /// The answer.
    pub verdict: Verdict,
    /// Does the answer agree with what is expected? Always, for a claim declared open.
    pub agrees: bool,
    /// The row of the paper's table that this fills.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell: Option<String>,
    /// The author's remark.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// The grounds.
    pub evidence: Evidence,
}
