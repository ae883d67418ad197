//! Judgement of all claims of a case: recorded once, then taken up the ladder until each is
//! decided.

use std::sync::{Mutex, PoisonError};

use super::claim_state::{ClaimState, undecide};
use super::conclude::report;
use super::dissipation::find_rates;
use super::evidence::{ClaimReport, Verdict};
use super::judging::Judging;
use super::listed_levels::{ListedUse, judge_each_listed};
use super::mutants::{MutationReport, mutate};
use super::recorded::{RecordedClaim, SharedTerms};
use super::sampler::TAPE_LANES;
use crate::case::{Case, TimeParts};
use crate::claim::LevelSubset;
use crate::graph::{Fault, Graph, record};
use crate::mechanics::Phase;
use crate::mechanics::calculus::DualPoint;

/// Options of a judgement.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Seed of all states.
    pub seed: u64,
    /// Number of states that a claim must survive, in steps of 64.
    pub states: u64,
    /// Required strength of evidence for a claim that holds.
    pub trust: Trust,
    /// Whether true formulas are perturbed, to check that each mutant is refuted.
    pub mutants: bool,
}

/// Required strength of evidence for a claim that holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trust {
    /// Enclosures at enough states; no proof is attempted.
    Float,
    /// A proof if possible, otherwise as `Float`.
    #[default]
    Best,
    /// A proof: without one the claim does not agree with an expectation that it holds.
    Proof,
}

impl Default for Options {
    fn default() -> Self {
        Self { seed: 1, states: 4 * TAPE_LANES as u64, trust: Trust::Best, mutants: false }
    }
}

/// Report on a case: the verdicts on its claims.
#[derive(Clone, Debug)]
pub struct CaseReport {
    /// One report for each claim, in the order of the file.
    pub claims: Vec<ClaimReport>,
    /// Physical impossibilities of the states drawn.
    pub warnings: Vec<String>,
    /// Remarks on what the file may say by mistake.
    pub remarks: Vec<String>,
    /// Results of the mutants, if requested.
    pub mutants: Option<MutationReport>,
    /// Number of claims about motion that were left out.
    pub motions_left: usize,
    /// Number of claims of absence that were left out.
    pub absences_left: usize,
}

/// The reason why a case cannot be judged.
#[derive(Clone, Debug, thiserror::Error)]
pub enum JudgeError {
    /// A formula needed the magnitude of a recorded value.
    #[error(transparent)]
    Fault(#[from] Fault),
    /// No state could be drawn.
    #[error("no state on the level set was found among {0} starts")]
    Unreachable(u64),
    /// More digits of a value are asked for than can be computed.
    #[error("{wanted} digits are too many: at most {most} are computed")]
    TooManyDigits {
        /// Number of digits asked for.
        wanted: usize,
        /// Largest number.
        most: usize,
    },
    /// The numbers of the states are beyond the range of f64.
    #[error("none of {0} states could be drawn: their numbers are beyond the range of f64")]
    Overflow(u64),
    /// The parametrisation leads to points off the level.
    #[error("the chart is not on the level set: `{equation}` is off by {by}")]
    OffLevel {
        /// Equation that is violated.
        equation: String,
        /// Left minus right side, at a state.
        by: String,
    },
    /// The states found for the level are not on it.
    #[error("the states found for the level are not on it: `{equation}` is off by {by}")]
    OffSolution {
        /// Equation that is off.
        equation: String,
        /// Left minus right side, at a state.
        by: String,
    },
    /// The parametrisation misses directions of the level.
    #[error("the chart covers {found} of the {dimension} dimensions of the level set{listed}")]
    PartialChart {
        /// Rank of its derivative.
        found: usize,
        /// Dimension of the level.
        dimension: usize,
        /// Listed values for which it does not, after a comma, if there are several.
        listed: String,
    },
    /// The level equations are not independent.
    #[error(
        "`{0}` follows from the equations before it, contradicts them, chooses one of their parts, or \
         contains no state variable"
    )]
    Dependent(String),
    /// An ∫ of the equations of motion or of `[variables]` is not a function of its variable.
    #[error("an ∫ in `{0}` has an integrand that depends on more than its variable")]
    Quadrature(String),
    /// The inertia tensor is not symmetric.
    #[error("the inertia tensor is not symmetric")]
    AsymmetricInertia,
    /// The bracket of Hamilton's equations is not skew.
    #[error("the bracket of [hamiltonian] is not skew in its block \"{0},{0}\"")]
    NotSkew(String),
    /// The field is defined nowhere.
    #[error("the equations of motion are undefined at all {0} states that were drawn")]
    Singular(u64),
    /// The slopes of a constraint vanish where it holds.
    #[error(
        "the slopes of the constraint `{0}` by the velocities are 0, or have no value, at all {1} states that were \
         drawn: its reaction is not determined"
    )]
    Slopeless(String, u64),
    /// The numbers of the field are beyond the range of f64.
    #[error(
        "the equations of motion are beyond the range of f64 at all {0} states that were drawn"
    )]
    FieldOverflow(u64),
    /// A report on a map.
    #[error("the case is a map, and a report needs a flow")]
    Discrete,
    /// The level set is left by a map.
    #[error("the level set is not invariant: at the image of a state `{equation}` is off by {by}")]
    NotMapped {
        /// Equation that is not invariant.
        equation: String,
        /// Left minus right, at the image.
        by: String,
    },
    /// The motion leaves the level set.
    #[error("the level set is not invariant: the motion leaves `{equation}` at rate {rate}")]
    NotInvariant {
        /// Equation that is not invariant.
        equation: String,
        /// Rate of the equation at a state.
        rate: String,
    },
}

impl JudgeError {
    /// Suggests a remedy.
    pub fn help(&self) -> &'static str {
        match self {
            JudgeError::TooManyDigits { .. } => "ask for fewer digits",
            JudgeError::Fault(_) => "write the formula with operations that hold for every number",
            JudgeError::Overflow(_) => "check the ranges of [parameters] and [state]",
            JudgeError::FieldOverflow(_) => {
                "give [parameters] and [state] ranges of smaller numbers, or write formulas that do \
                 not grow as fast"
            }
            JudgeError::OffLevel { .. } => "correct the formulas of [level.chart]",
            JudgeError::OffSolution { .. } => {
                "the program solves this level wrongly: please report the case; [level.chart] gives \
                 other states"
            }
            JudgeError::PartialChart { .. } => {
                "a claim would be tested on a part of the level only: give [level.chart] more inputs"
            }
            JudgeError::Dependent(_) => {
                "leave it out if it follows from the others, and correct it if it contradicts them; a part \
                 is chosen by the ranges of [state], and rotations, though not those of a map, by det(Q) = 1 beside Qᵀ*Q = E"
            }
            JudgeError::Quadrature(_) => {
                "∫(f, x) is a function of x with derivative f: f may contain x and the parameters"
            }
            JudgeError::NotSkew(_) => {
                "a block \"M,M\" has to be a skew matrix, as hat(M) is, and \"x,x\" of a scalar is 0"
            }
            JudgeError::AsymmetricInertia => "write a symmetric matrix for the inertia tensor",
            JudgeError::Unreachable(_) => {
                "check the equations of [level] and the constraints, whose slopes may not all vanish where they \
                 hold, or widen the ranges of [state]"
            }
            JudgeError::Singular(_) => {
                "look for a division by zero, the root of a negative number, a singular inertia \
                 tensor, a kinetic energy that leaves out a velocity, or constraints that follow from each other \
                 where they hold"
            }
            JudgeError::Slopeless(..) => {
                "write an equation with the same zeros and other slopes, as x' = y*z' in the place of \
                 (x' - y*z')^2 = 0"
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

/// Size of what a judgement records before any state is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordedSize {
    /// Number of operations of the residuals of all claims together.
    pub operations: usize,
    /// Number of nodes of the graph.
    pub nodes: usize,
}

/// Records a case as [`judge`] does, and returns the size of the recording.
pub fn recorded_size(case: &Case) -> Result<RecordedSize, Fault> {
    let (graph, (recorded, _)) = recording(case)?;
    let residuals: Vec<_> = recorded.iter().flat_map(|item| item.residual.clone()).collect();
    Ok(RecordedSize { operations: graph.operations(&residuals), nodes: graph.len() })
}

/// Records all claims of a case, and what every case needs.
fn recording(case: &Case) -> Result<(Graph, (Vec<RecordedClaim<'_>>, SharedTerms)), Fault> {
    let model = &case.model;
    record(model.free_components() + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(model.free_components());
        let jet = DualPoint::new(Phase::new(model, parameters, state));
        let open = jet.phase.open_divisors();
        let recorded: Vec<RecordedClaim<'_>> =
            case.claims.iter().map(|claim| RecordedClaim::new(claim, &jet, &open)).collect();
        (recorded, SharedTerms::of(&jet))
    })
}

/// Judges all claims of a case except those about motion and those of absence, which need to follow
/// motions and to count invariants.
pub fn judge(case: &Case, options: &Options) -> Result<CaseReport, JudgeError> {
    judge_telling(case, options, &|_| ())
}

/// Part of a claim that is left to the end of a judgement.
const REST: f64 = 1.0 / 128.0;

/// Judges the same claims, and tells how many more are decided; in all, as many as there are.
pub fn judge_telling(
    case: &Case,
    options: &Options,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<CaseReport, JudgeError> {
    if let Some(parts) = case.time_parts() {
        return judge_time_parts(case, &parts, options, progress);
    }
    // A claim may be decided on several parts of its place, and conditions and wider places follow: the
    // last bit is told at the end.
    let most = case.claims.len() as f64 - REST;
    let told = Mutex::new(0.0);
    let lock = || told.lock().unwrap_or_else(PoisonError::into_inner);
    let decided = |more: f64| {
        let mut told = lock();
        let after = f64::min(*told + more, most).max(*told);
        progress(after - *told);
        *told = after;
    };
    let report = judge_all(case, options, &decided)?;
    progress(case.claims.len() as f64 - *lock());
    Ok(report)
}

/// Judges the claims that use `t`, and the others without it.
fn judge_time_parts(
    case: &Case,
    parts: &TimeParts,
    options: &Options,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<CaseReport, JudgeError> {
    let mut report = judge_telling(&parts.without_time, options, progress)?;
    let other = judge_telling(&parts.with_time, options, progress)?;
    report.claims.extend(other.claims);
    parts.sort(&mut report.claims, |claim| &claim.name);
    for warning in other.warnings {
        if !report.warnings.contains(&warning) {
            report.warnings.push(warning);
        }
    }
    report.remarks = case.remarks.iter().map(ToString::to_string).collect();
    report.mutants = match (report.mutants, other.mutants) {
        (Some(own), Some(other)) => Some(own.and(other)),
        (own, other) => own.or(other),
    };
    report.motions_left += other.motions_left;
    report.absences_left += other.absences_left;
    Ok(report)
}

fn judge_all(
    case: &Case,
    options: &Options,
    decided: &(dyn Fn(f64) + Sync),
) -> Result<CaseReport, JudgeError> {
    let model = &case.model;
    let inputs = model.free_components() + model.dimension();
    let (graph, (recorded, common)) = recording(case)?;
    let bench = Judging::new(case, &common, options, &graph, inputs).telling(decided);
    let mut statuses: Vec<ClaimState> = recorded.iter().map(|_| ClaimState::default()).collect();
    let warnings = [case.warnings.clone(), bench.check()?].concat();
    let mut places: Vec<&LevelSubset> = Vec::new();
    for claim in &case.claims {
        if !places.contains(&&claim.place) {
            places.push(&claim.place);
        }
    }
    let level = LevelSubset::level(model);
    for place in places {
        let is_there = |item: &RecordedClaim<'_>| item.claim.place == *place;
        let there = recorded.iter().zip(&mut statuses).filter(|(item, _)| is_there(item));
        match bench.climb(place, there.collect()) {
            Err(JudgeError::Fault(fault)) => return Err(fault.into()),
            // A claim made elsewhere says nothing of the other claims.
            Err(error) if *place != level => {
                let pairs = recorded.iter().zip(&mut statuses);
                for (_, status) in pairs.filter(|(item, _)| is_there(item)) {
                    *status = ClaimState::default();
                    undecide(status, error.to_string());
                }
            }
            other => other?,
        }
    }
    bench.extend_domain(&recorded, &mut statuses)?;
    bench.leave_flat_levels(&recorded, &mut statuses);
    bench.leave_unkept_levels(&recorded, &mut statuses)?;
    bench.leave_open_quadratures(&recorded, &mut statuses);
    let pairs = recorded.iter().zip(&statuses);
    let lists: Vec<ListedUse> = pairs
        .map(|(item, status)| {
            let (voids, split) = (status.voids.clone(), bench.split_draws_of(item, status)?);
            Ok(ListedUse { voids, split })
        })
        .collect::<Result<_, JudgeError>>()?;
    let mut claims: Vec<ClaimReport> = recorded
        .iter()
        .zip(statuses)
        .map(|(item, status)| {
            let is_refuted = status.settled == Some(Verdict::Refuted);
            let is_open = is_refuted && bench.depends_on_constants(item)?;
            Ok(report(case, item, status, (options, is_open)))
        })
        .collect::<Result<_, JudgeError>>()?;
    judge_each_listed(case, options, &mut claims, &lists)?;
    find_rates(case, options, &mut claims)?;
    let mutants = options.mutants.then(|| mutate(case, &claims, options)).transpose()?;
    let (motions_left, absences_left) = (case.motions.len(), case.absences.len());
    let remarks = case.remarks.iter().map(ToString::to_string).collect();
    Ok(CaseReport { claims, warnings, remarks, mutants, motions_left, absences_left })
}
