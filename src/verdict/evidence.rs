//! Verdicts on claims, and the evidence for them.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::restriction::Flaw;
use crate::case::Expect;
use crate::claim::{Assumption, PlaceName};
use crate::proof::Certificate;

/// Verdict on a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// True, by exact reasoning.
    Proved,
    /// Zero within rounding at every state tried.
    Confirmed,
    /// False: at a state the residual's enclosure excludes 0.
    Refuted,
    /// Neither proved nor refuted, for the reason given.
    Undecided,
}

impl Verdict {
    /// Returns the word used in reports.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Proved => "proved",
            Verdict::Confirmed => "confirmed",
            Verdict::Refuted => "refuted",
            Verdict::Undecided => "undecided",
        }
    }

    /// Whether the verdict agrees with an expectation; `is_enough` says whether a claim that is proved or
    /// confirmed holds as the run and the claim ask.
    pub fn agrees(self, expect: Expect, is_enough: bool) -> bool {
        match expect {
            Expect::Open => true,
            Expect::Holds => is_enough && matches!(self, Verdict::Proved | Verdict::Confirmed),
            Expect::Fails => self == Verdict::Refuted,
        }
    }
}

/// A state at which a claim fails, in the form read by `eval`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Witness {
    /// Index of the state under the run's seed; `None` for a state found by search.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub index: Option<u64>,
    /// Values of the drawn parameters, for `--set`.
    pub parameters: BTreeMap<String, String>,
    /// Values of the state variables, for `--state`.
    pub state: String,
    /// Residual at the state.
    pub residual: f64,
    /// Bound on the residual's error; less than its magnitude, unless that is beyond f64.
    pub error_bound: f64,
    /// Residual to a few digits, where f64 cannot distinguish it from 0 or from infinity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub digits: Option<String>,
}

/// Relation of an integral to the integrals common to all cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Independence {
    /// Gradient independent of those of the level functions and the energy.
    Independent,
    /// Function of the level functions and the energy.
    General,
    /// Constant on the level: true, but trivial.
    Constant,
}

/// The sign of a density.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum DensitySign {
    /// Positive at every state tried.
    Positive,
    /// Negative at every state tried: its negative is the density of a measure.
    Negative,
    /// Sign change at fixed parameters, and so zeros or poles: invariant, but not a positive
    /// measure across them.
    Changes,
    /// One sign for some parameters and the other for others: a measure for each of them, up to a
    /// factor −1.
    ChangesWithParameters,
}

/// A proof in prime fields.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Proof {
    /// Number of random primes.
    pub primes: usize,
    /// Number of random points, all primes together, at which the residual is 0.
    pub points: usize,
    /// Number of points drawn, some of them without a value.
    pub draws: u64,
    /// Bound on the degree of the residual's numerator.
    pub degree: f64,
    /// Number of square roots and roots of odd index in it.
    pub roots: usize,
    /// Log₂ of the probability that the residual is nevertheless not an identity.
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

/// Method by which a claim was decided: a rung of the ladder, or a method for claims without
/// residual.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum Method {
    /// No rung has examined the claim.
    #[default]
    #[serde(rename = "")]
    Unsettled,
    /// The residual became a constant, 0 or another, while it was recorded.
    #[serde(rename = "folding")]
    Folding,
    /// Enclosures in f64.
    #[serde(rename = "ball")]
    Ball,
    /// Enclosures in f64 at points found by Newton's method, where the level set has no
    /// parametrisation.
    #[serde(rename = "ball at numerical states")]
    NumericalBall,
    /// An identity tested modulo random primes.
    #[serde(rename = "prime field")]
    PrimeField,
    /// Enclosures in double-double.
    #[serde(rename = "double-double ball")]
    DoubleDoubleBall,
    /// Enclosures in higher precision.
    #[serde(rename = "ball of many bits")]
    PreciseBall,
    /// Numbers from motions.
    #[serde(rename = "motion")]
    Motion,
    /// Enclosures of a closed orbit, in f64.
    #[serde(rename = "enclosed orbit")]
    EnclosedOrbit,
    /// A rank modulo a prime, an upper bound on a number of invariants.
    #[serde(rename = "count")]
    Count,
}

impl Method {
    /// Returns the name used in reports.
    pub fn name(self) -> &'static str {
        match self {
            Method::Unsettled => "",
            Method::Folding => "folding",
            Method::Ball => "ball",
            Method::NumericalBall => "ball at numerical states",
            Method::PrimeField => "prime field",
            Method::DoubleDoubleBall => "double-double ball",
            Method::PreciseBall => "ball of many bits",
            Method::Motion => "motion",
            Method::EnclosedOrbit => "enclosed orbit",
            Method::Count => "count",
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.pad(self.name())
    }
}

/// Result of one rung of the ladder.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rung {
    /// The rung.
    pub rung: Method,
    /// Description of the result.
    pub found: String,
}

/// A quantity measured on a motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measurement {
    /// Name of the quantity.
    pub quantity: String,
    /// Measured value.
    pub value: f64,
    /// Estimate of the error, from the computation itself.
    pub error: f64,
    /// Value stated by the claim, as written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stated: Option<String>,
}

/// Evidence for a verdict.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Evidence {
    /// Method that decided the claim.
    pub method: Method,
    /// Proof, if there is one.
    #[serde(flatten)]
    pub proof: Option<Proof>,
    /// Reason why prime fields decide nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub silence: Option<String>,
    /// Number of states at which the residual was computed.
    pub samples: usize,
    /// Largest |residual| where the claim holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_residual: Option<f64>,
    /// Largest |residual| relative to its error bound; at most 1 where the claim holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_scaled_residual: Option<f64>,
    /// Number of operations of the residual for each state.
    pub operations: usize,
    /// Places where the claim was seen to hold, widest first: `everywhere`, an equation, `level`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub holds: Vec<PlaceName>,
    /// Independence, for integrals that hold.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub independence: Option<Independence>,
    /// Sign, for densities that hold.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sign: Option<DensitySign>,
    /// Whether the sign is proved at all states rather than observed at those tried.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub sign_is_proved: bool,
    /// Whether a density of a proved sign is not known to be different from 0 at all states.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub sign_may_vanish: bool,
    /// Whether the sign may be another at states at which it is not known whether the density has a
    /// value, or on a part of the level that was not reached.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub sign_is_partial: bool,
    /// Restrictions that are seen, each with words in `remark`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub flaws: Vec<Flaw>,
    /// Hypotheses of the proof that are neither proved nor seen to fail, each with words in `remark`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub assumes: Vec<Assumption>,
    /// Volume form to which a density on a level set refers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume: Option<String>,
    /// Consequence of a claim that holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remark: Option<String>,
    /// Witness of a refutation, or of the independence of functions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub witness: Option<Witness>,
    /// Measured quantities, for claims about motion.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub measured: Vec<Measurement>,
    /// For claims of absence that hold: the excluded functions, and the parameters for which they
    /// are excluded. For closed orbits: the proved statement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub theorem: Option<String>,
    /// For claims of absence that fail: a proved integral or density that contradicts the claim.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exhibit: Option<String>,
    /// Results of all rungs, in order.
    pub climb: Vec<Rung>,
    /// Reason why a claim is undecided, or restriction of its verdict.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl Evidence {
    /// Whether a restriction is seen.
    pub fn has(&self, flaw: Flaw) -> bool {
        self.flaws.contains(&flaw)
    }

    /// Adds a restriction, once.
    pub(crate) fn add_flaw(&mut self, flaw: Flaw) {
        if !self.has(flaw) {
            self.flaws.push(flaw);
            self.flaws.sort_unstable();
        }
    }

    /// Adds a hypothesis that is not proved, once.
    pub(crate) fn assume(&mut self, assumption: Assumption) {
        if !self.assumes.contains(&assumption) {
            self.assumes.push(assumption);
            self.assumes.sort_unstable();
        }
    }

    /// Adds a remark to those that there are.
    pub fn add_remark(&mut self, remark: String) {
        match &mut self.remark {
            Some(before) => {
                before.push_str("; ");
                before.push_str(&remark);
            }
            None => self.remark = Some(remark),
        }
    }
}

/// Report on a claim.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClaimReport {
    /// Name of the claim in its case.
    pub name: String,
    /// Formula of the claim, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub formula: Option<String>,
    /// Key of the statement in case files: `integral`, `density`, …
    pub kind: &'static str,
    /// Equation number, table or section.
    pub source: String,
    /// Place at which it is claimed.
    #[serde(rename = "where")]
    pub place: String,
    /// Expectation of the file.
    pub expect: Expect,
    /// Verdict on the claim.
    pub verdict: Verdict,
    /// Whether the verdict agrees with the expectation; always for a claim declared open.
    pub agrees: bool,
    /// Table row this claim belongs to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell: Option<String>,
    /// Remark of the author.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// Evidence for the verdict.
    pub evidence: Evidence,
}
