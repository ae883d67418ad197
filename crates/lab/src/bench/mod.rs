//! Run time against error: all methods that form the derivatives of a claim's residual, measured
//! side by side at the same states.
//!
//! | method | computation |
//! |---|---|
//! | tape | the recorded residual, in each number domain |
//! | merged tape | the same residual from fewer operations, by each engine of f64 |
//! | floor | the operations of the engine's steps in registers, none waiting for another |
//! | num-dual by hand | the work items over num-dual's numbers at f64, state by state, written out plainly |
//! | num-dual, closed form | W3 from a formula for the criterion, instead of its definition |
//! | complex step | Im f(x + i h d)/h, h = 10⁻¹⁰⁰, of the undifferentiated quantities on tapes |
//! | central difference | (f(x + h d) - f(x - h d))/2h, h\|d\| = ∛ε \|x\|, of the same tapes |
//!
//! The states are f64 numbers and taken as exact. The error of a method at a state is
//!
//! ```text
//! |computed - reference| / scale
//! ```
//!
//! where the reference is the same residual in a precision beyond every candidate, and the scale is
//! a reference size of the residual ([`liouville::claim::ResidualContext::scale`]): a residual that is zero has
//! no relative error.

mod by_hand;
mod candidate;
mod central;
mod complex_step;
mod engines;
mod items;
mod measure;
mod one_by_one;
mod reference;
mod subject;
mod tapes;
mod underived;

use serde::Serialize;

pub use candidate::Candidate;
pub use items::{BenchItem, PlainCode, work_items};
pub use one_by_one::BlockResidual;
pub use subject::{BenchCandidate, BenchClaim, record_merged, record_residual};

use liouville::graph::Fault;

/// Name of f64 in code compiled for the processor at hand.
pub const NATIVE: &str = "f64, native";

/// Method of differentiation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum DifferentiationMethod {
    /// The recorded residual.
    #[serde(rename = "tape")]
    Tape,
    /// The recorded residual, with nodes of equal value merged.
    #[serde(rename = "merged tape")]
    MergedTape,
    /// Lower bound: the operations of the tape's steps, independent of each other.
    #[serde(rename = "floor")]
    Floor,
    /// The residual written by hand over num-dual's numbers.
    #[serde(rename = "num-dual by hand")]
    NumDualByHand,
    /// The residual from a formula derived with pencil and paper, over num-dual's numbers.
    #[serde(rename = "num-dual, closed form")]
    NumDualClosedForm,
    /// A complex step on underived tapes.
    #[serde(rename = "complex step")]
    ComplexStep,
    /// Central differences on underived tapes.
    #[serde(rename = "central difference")]
    CentralDifference,
}

impl DifferentiationMethod {
    /// All methods, in the order of reports.
    pub const ALL: [DifferentiationMethod; 7] = [
        DifferentiationMethod::Tape,
        DifferentiationMethod::MergedTape,
        DifferentiationMethod::Floor,
        DifferentiationMethod::NumDualByHand,
        DifferentiationMethod::NumDualClosedForm,
        DifferentiationMethod::ComplexStep,
        DifferentiationMethod::CentralDifference,
    ];

    /// Name of the method in reports.
    pub fn name(self) -> &'static str {
        match self {
            DifferentiationMethod::Tape => "tape",
            DifferentiationMethod::MergedTape => "merged tape",
            DifferentiationMethod::Floor => "floor",
            DifferentiationMethod::NumDualByHand => "num-dual by hand",
            DifferentiationMethod::NumDualClosedForm => "num-dual, closed form",
            DifferentiationMethod::ComplexStep => "complex step",
            DifferentiationMethod::CentralDifference => "central difference",
        }
    }
}

/// Options of a measurement.
#[derive(Clone, Copy, Debug)]
pub struct BenchOptions {
    /// Seed of all states.
    pub seed: u64,
    /// Number of blocks of 64 states.
    pub blocks: u64,
    /// Number of rounds in which every candidate runs in turn.
    pub rounds: usize,
    /// Which candidates run.
    pub selection: Selection,
    /// Whether the states are kept, with the results of the quickest engine.
    pub keep_values: bool,
}

/// Candidates of a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Selection {
    /// All methods in all domains, with errors at all states.
    All,
    /// The merged tape on the engines of f64 beside code written by hand, with errors at the first
    /// states only.
    Engines,
}

impl Default for BenchOptions {
    fn default() -> Self {
        Self { seed: 1, blocks: 4, rounds: 21, selection: Selection::All, keep_values: false }
    }
}

/// Measurements of one claim.
#[derive(Clone, Debug)]
pub struct ClaimMeasurements {
    /// Name of the item: `W1`, or a path.
    pub item: String,
    /// Name of the claim.
    pub claim: String,
    /// Kind of the claim.
    pub kind: &'static str,
    /// Rows, one for each method in each domain.
    pub rows: Vec<MethodMeasurements>,
    /// Methods that cannot be used, with the reasons.
    pub skipped: Vec<(DifferentiationMethod, &'static str)>,
    /// States with the results of the quickest engine, if they were asked for.
    pub values: Vec<StateValue>,
}

/// A state with the result of the quickest engine.
#[derive(Clone, Debug, Serialize)]
pub struct StateValue {
    /// Free parameters and state.
    pub state: Vec<f64>,
    /// Residual.
    pub value: f64,
    /// Scale of the residual.
    pub scale: f64,
}

/// Measurements of one method in one domain.
#[derive(Clone, Debug, Serialize)]
pub struct MethodMeasurements {
    /// Method of differentiation.
    pub method: DifferentiationMethod,
    /// Name of the arithmetic.
    pub domain: &'static str,
    /// Nanoseconds of processor time per state, the median over the rounds.
    pub ns_per_state: f64,
    /// The least over the rounds.
    pub least_ns_per_state: f64,
    /// Operations per state, in the arithmetic of the domain; `None` where nothing is recorded.
    pub operations: Option<usize>,
    /// Microseconds to record and lay out the tapes.
    pub setup_us: f64,
    /// Largest error over scale; `None` where the residual is nowhere defined.
    pub max_error: Option<f64>,
    /// Median error over scale.
    pub median_error: Option<f64>,
    /// Largest error bound over scale, of a domain that encloses.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_bound: Option<f64>,
    /// Number of states at which both the result and the reference are defined.
    pub states: usize,
}

impl ClaimMeasurements {
    /// Row of the merged tape by the quickest engine of this machine.
    pub fn quickest(&self) -> Option<&MethodMeasurements> {
        let engines = ["f64, machine code", "f64, interpreter"];
        engines.iter().find_map(|engine| self.row(DifferentiationMethod::MergedTape, engine))
    }

    /// Time of the quickest engine divided by that of plain num-dual code, compiled by default (`f64`)
    /// or natively ([`NATIVE`]).
    pub fn ratio_to_num_dual(&self, domain: &str) -> Option<f64> {
        let plain = self.row(DifferentiationMethod::NumDualByHand, domain)?;
        Some(self.quickest()?.ns_per_state / plain.ns_per_state)
    }

    /// Finds the row of a method in a domain.
    pub fn row(&self, method: DifferentiationMethod, domain: &str) -> Option<&MethodMeasurements> {
        self.rows.iter().find(|row| row.method == method && row.domain == domain)
    }
}

/// Reason why an item cannot be measured.
#[derive(Clone, Debug, thiserror::Error)]
pub enum BenchError {
    /// A formula needs the magnitude of a recorded value.
    #[error(transparent)]
    Fault(#[from] Fault),
    /// No state could be drawn.
    #[error("none of {0} states could be drawn")]
    Unreachable(usize),
}

impl BenchError {
    /// Advice on how to avoid the error.
    pub fn help(&self) -> &'static str {
        match self {
            BenchError::Fault(_) => "write the formula with operations that hold for every number",
            BenchError::Unreachable(_) => "run `liouville check` to find the mistake in the case",
        }
    }
}

/// Measures every claim of an item; `progress` is told shares of the whole as they are done.
pub fn measure_item(
    item: &BenchItem,
    options: &BenchOptions,
    progress: &dyn Fn(f64),
) -> Result<Vec<ClaimMeasurements>, BenchError> {
    let claims = item.case.claims.len().max(1) as f64;
    let one = |claim| {
        let subject = BenchClaim::new(item, claim, options.seed, options.blocks)?;
        Ok(ClaimMeasurements {
            item: item.name.clone(),
            claim: subject.claim.name.clone(),
            kind: subject.claim.kind.name(),
            rows: measure::measure(&subject, options, &|share| progress(share / claims))?,
            skipped: subject.skipped(),
            values: if options.keep_values { subject.values()? } else { Vec::new() },
        })
    };
    item.case.claims.iter().map(one).collect()
}
