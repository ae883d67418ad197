//! All claims of a case: record once, then climb the ladder until each claim is settled.

use super::bench::Bench;
use super::conclude::report;
use super::evidence::ClaimReport;
use super::finding::Finding;
use super::mutants::{MutationReport, mutate};
use super::recorded::{Common, Recorded};
use super::sampler::LANES;
use crate::case::Case;
use crate::claim::Place;
use crate::graph::{Fault, record};
use crate::mechanics::Phase;
use crate::mechanics::calculus::Jet;

/// How thoroughly to judge.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The seed of all states.
    pub seed: u64,
    /// How many states a claim must survive, in steps of 64.
    pub states: u64,
    /// What is asked of a verdict that a claim holds.
    pub trust: Trust,
    /// Are true formulas to be perturbed, to see whether each mutant is refuted?
    pub mutants: bool,
}

/// What is asked of a verdict that a claim holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trust {
    /// Rounding that is accounted for, at enough states: no proof is tried.
    Float,
    /// A proof where there is one, else as `Float`.
    #[default]
    Best,
    /// A proof: without one the claim does not agree with an expectation that it holds.
    Proof,
}

impl Default for Options {
    fn default() -> Self {
        Self { seed: 1, states: 4 * LANES as u64, trust: Trust::Best, mutants: false }
    }
}

/// A case with the verdicts on its claims.
#[derive(Clone, Debug)]
pub struct CaseReport {
    /// One report a claim, in the order of the file.
    pub claims: Vec<ClaimReport>,
    /// What is physically impossible about the states that were drawn.
    pub warnings: Vec<String>,
    /// What became of mutants, if they were asked for.
    pub mutants: Option<MutationReport>,
    /// How many claims about motion were left alone.
    pub motions_left: usize,
}

/// Why a case cannot be judged.
#[derive(Clone, Debug, thiserror::Error)]
pub enum JudgeError {
    /// A formula asked a recorded value for its magnitude.
    #[error(transparent)]
    Fault(#[from] Fault),
    /// No state could be drawn.
    #[error("no state on the level set was found among {0} starts")]
    Unreachable(u64),
    /// Numbers beyond the range of f64.
    #[error("none of {0} states could be drawn: their numbers are beyond the range of f64")]
    Overflow(u64),
    /// A parametrisation that makes states off the level.
    #[error("the chart is not on the level set: `{equation}` is off by {by}")]
    OffLevel {
        /// The equation that does not hold.
        equation: String,
        /// Left minus right, at a state.
        by: String,
    },
    /// A parametrisation that leaves out directions of the level.
    #[error("the chart covers {found} of the {dimension} dimensions of the level set")]
    PartialChart {
        /// The rank of its derivative.
        found: usize,
        /// The dimension of the level.
        dimension: usize,
    },
    /// Level equations that are not independent.
    #[error("the level equation `{0}` depends on those before it, or on no state variable")]
    Dependent(String),
    /// An ∫ of the equations of motion or of `[variables]` that is none.
    #[error("an ∫ in `{0}` has an integrand of more than its variable")]
    Quadrature(String),
    /// An inertia tensor that is not symmetric.
    #[error("the inertia tensor is not symmetric")]
    AsymmetricInertia,
    /// A bracket of Hamilton's equations that is not skew.
    #[error("the bracket of [hamiltonian] is not skew")]
    NotSkew,
    /// The field is nowhere defined.
    #[error("the equations of motion are undefined at all {0} states that were drawn")]
    Singular(u64),
    /// A report on a map.
    #[error("the case is a map, and reports are made on flows")]
    Discrete,
    /// The level set is left by a map.
    #[error("the level set is not invariant: at the image of a state `{equation}` is off by {by}")]
    NotMapped {
        /// The equation that is left.
        equation: String,
        /// Left minus right, at the image.
        by: String,
    },
    /// The level set is left by the motion.
    #[error("the level set is not invariant: along the motion `{equation}` changes at rate {rate}")]
    NotInvariant {
        /// The equation that is left.
        equation: String,
        /// Its rate at a state.
        rate: String,
    },
}

impl JudgeError {
    /// What to do about it.
    pub fn help(&self) -> &'static str {
        match self {
            JudgeError::Fault(_) => "write the formula with operations that hold for every number",
            JudgeError::Overflow(_) => "look at the ranges of [parameters] and [state]",
            JudgeError::OffLevel { .. } => "correct the formulas of [level.chart]",
            JudgeError::PartialChart { .. } => {
                "a claim would be tested on a part of the level only: give [level.chart] more inputs"
            }
            JudgeError::Dependent(_) => "remove the equation from [level]",
            JudgeError::Quadrature(_) => {
                "∫(f, x) is a function of x with derivative f: f may contain x and the parameters"
            }
            JudgeError::NotSkew => {
                "a block \"M,M\" has to be a skew matrix, as hat(M) is, and \"x,x\" of a scalar is 0"
            }
            JudgeError::AsymmetricInertia => "write a symmetric matrix for the inertia tensor",
            JudgeError::Unreachable(_) => {
                "check the equations of [level], whose slopes may not all vanish on it, or widen the \
                 ranges of [state]"
            }
            JudgeError::Singular(_) => {
                "look for a division by zero, the root of a negative number, or a singular inertia \
                 tensor in [parameters]"
            }
            JudgeError::Discrete => {
                "claim the invariants of a map, and let `liouville check` judge them"
            }
            JudgeError::NotMapped { .. } => {
                "a claim on a level set has a meaning only if the map keeps it: correct the \
                 equation, or the map"
            }
            JudgeError::NotInvariant { .. } => {
                "a claim on a level set has a meaning only if the motion stays on it: correct the \
                 equation, or the field"
            }
        }
    }
}

/// Judges all claims of a case but those about motion, which [`observe`](crate::observe) looks at.
pub fn judge(case: &Case, options: &Options) -> Result<CaseReport, JudgeError> {
    let model = &case.model;
    let inputs = model.free_components() + model.dimension();
    let (graph, (recorded, common)) = record(inputs, |inputs| {
        let (parameters, state) = inputs.split_at(model.free_components());
        let jet = Jet::new(Phase::new(model, parameters, state));
        let recorded: Vec<Recorded<'_>> =
            case.claims.iter().map(|claim| Recorded::new(claim, &jet)).collect();
        (recorded, Common::of(&jet))
    })?;
    let bench = Bench { case, common: &common, options, graph: &graph, inputs };
    let mut findings: Vec<Finding> = recorded.iter().map(|_| Finding::default()).collect();
    let warnings = [case.warnings.clone(), bench.check()?].concat();
    let mut places: Vec<&Place> = Vec::new();
    for claim in &case.claims {
        if !places.contains(&&claim.place) {
            places.push(&claim.place);
        }
    }
    for place in places {
        let at_place =
            recorded.iter().zip(&mut findings).filter(|(item, _)| item.claim.place == *place);
        bench.climb(place, at_place.collect())?;
    }
    bench.widen(&recorded, &mut findings)?;
    let claims: Vec<ClaimReport> = recorded
        .iter()
        .zip(findings)
        .map(|(item, finding)| report(case, item, finding, options))
        .collect();
    let mutants = options.mutants.then(|| mutate(case, &claims, options)).transpose()?;
    Ok(CaseReport { claims, warnings, mutants, motions_left: case.motions.len() })
}
