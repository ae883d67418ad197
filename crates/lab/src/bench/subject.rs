//! A claim prepared for measurement: its tapes and its states.

use std::time::{Duration, Instant};

use super::candidate::{Block, Candidate, states};
use super::central::Central;
use super::complex_step::ComplexStep;
use super::engines;
use super::one_by_one::OneByOne;
use super::tapes;
use super::underived::{Reason, Underived};
use super::{BenchError, BenchItem, DifferentiationMethod, Selection, StateValue};
use liouville::case::{Case, PlacedClaim};
use liouville::engine::{Backend, Engine};
use liouville::graph::{Evaluator, Expr, Fault, Graph, Points, Tape, record};
use liouville::mechanics::Phase;
use liouville::mechanics::calculus::DualPoint;
use liouville::number::float::Float;
use liouville::proof::InputDistribution;
use liouville::verdict::{Sampler, TAPE_LANES};

/// Number of recordings, of which the shortest time counts as set-up.
const RECORDINGS: usize = 3;

/// A claim under measurement.
pub struct BenchClaim<'i> {
    item: &'i BenchItem,
    /// Claim measured.
    pub claim: &'i PlacedClaim,
    states: Vec<Block>,
    residual: Tape,
    merged: Tape,
    merging: Duration,
    recording: Duration,
    underived: Result<(Underived, Duration), Reason>,
}

/// Candidate with the facts known before it runs.
pub struct BenchCandidate<'s> {
    /// Method of differentiation.
    pub method: DifferentiationMethod,
    /// Name of the arithmetic.
    pub domain: &'static str,
    /// Operations per state, in the arithmetic of the domain, where they are counted.
    pub operations: Option<usize>,
    /// Time to record and lay out the tapes.
    pub set_up: Duration,
    /// Candidate to run.
    pub candidate: Box<dyn Candidate + 's>,
}

impl<'i> BenchClaim<'i> {
    /// Records a claim of an item and draws `blocks` blocks of states.
    pub fn new(
        item: &'i BenchItem,
        claim: &'i PlacedClaim,
        seed: u64,
        blocks: u64,
    ) -> Result<Self, BenchError> {
        let case = &item.case;
        let sampler = Sampler::new(case, &claim.place, seed)?;
        let ((residual, antiderivatives), recording) = timed(|| record_residual(case, claim))?;
        let (merged, merging) = timed(|| record_merged(case, claim))?;
        let states =
            states(&sampler, blocks, antiderivatives).ok_or(BenchError::Unreachable(TAPE_LANES))?;
        let (underived, time) = timed(|| Underived::record(case, claim))?;
        let underived = underived.map(|underived| (underived, time));
        Ok(Self { item, claim, states, residual, merged, merging, recording, underived })
    }

    /// States, block by block.
    pub fn states(&self) -> &[Block] {
        &self.states
    }

    /// Tape of the residual.
    pub fn residual(&self) -> &Tape {
        &self.residual
    }

    /// Candidates that compute the residual.
    pub fn entries(&self, selection: Selection) -> Vec<BenchCandidate<'_>> {
        let mut entries = match selection {
            Selection::All => self.tapes(),
            Selection::Engines => Vec::new(),
        };
        entries.extend(engines::all(&self.merged, &self.states, self.merging));
        let mut at_f64 = |method, domain, operations, set_up, candidate| {
            entries.push(BenchCandidate { method, domain, operations, set_up, candidate });
        };
        let none = Duration::ZERO;
        for code in &self.item.by_hand {
            let candidate = Box::new(OneByOne::new(code.residual, &self.states));
            at_f64(code.method, code.domain, None, none, candidate);
        }
        if let (Ok((underived, time)), Selection::All) = (&self.underived, selection) {
            let candidate = Box::new(ComplexStep::new(underived, &self.states));
            let operations = Some(underived.operations(1));
            at_f64(DifferentiationMethod::ComplexStep, "complex f64", operations, *time, candidate);
            let candidate = Box::new(Central::new(underived, &self.states));
            let operations = Some(underived.operations(2));
            at_f64(DifferentiationMethod::CentralDifference, "f64", operations, *time, candidate);
        }
        entries
    }

    /// Candidates for the recorded tape in all domains, and for the merged one in f64.
    fn tapes(&self) -> Vec<BenchCandidate<'_>> {
        let mut entries: Vec<BenchCandidate<'_>> = tapes::all(&self.residual, &self.states)
            .into_iter()
            .map(|(domain, candidate)| BenchCandidate {
                method: DifferentiationMethod::Tape,
                domain,
                operations: Some(self.residual.operations()),
                set_up: self.recording,
                candidate,
            })
            .collect();
        entries.insert(
            1,
            BenchCandidate {
                method: DifferentiationMethod::MergedTape,
                domain: "f64",
                operations: Some(self.merged.operations()),
                set_up: self.merging,
                candidate: tapes::in_f64(&self.merged, &self.states),
            },
        );
        entries
    }

    /// Methods that are not measured, with the reasons.
    pub fn skipped(&self) -> Vec<(DifferentiationMethod, Reason)> {
        let mut skipped = Vec::new();
        if let Err(reason) = &self.underived {
            skipped.push((DifferentiationMethod::ComplexStep, *reason));
            skipped.push((DifferentiationMethod::CentralDifference, *reason));
        }
        skipped
    }

    /// Results of the quickest engine at all states.
    pub fn values(&self) -> Result<Vec<StateValue>, BenchError> {
        let scales = self.scales(self.states.len())?;
        let mut runner = Engine::new(&self.merged, Backend::Quickest).runner();
        let mut values = Vec::with_capacity(self.states.len() * TAPE_LANES);
        for (block, scales) in self.states.iter().zip(scales) {
            for (row, input) in runner.inputs().iter_mut().zip(block) {
                row.0 = *input;
            }
            runner.run();
            values.extend((0..TAPE_LANES).map(|lane| StateValue {
                state: block.iter().map(|input| input[lane]).collect(),
                value: runner.output(0).0[lane],
                scale: scales[lane],
            }));
        }
        Ok(values)
    }

    /// Scale of the residual at each lane of the first blocks: |∇F||v| of an integral,
    /// |v|(|∇ln ρ| + 1/|x|) of a density, |a| of a criterion.
    pub fn scales(&self, blocks: usize) -> Result<Vec<[f64; TAPE_LANES]>, BenchError> {
        let (graph, scale) = with_jet(&self.item.case, |jet| {
            self.claim.kind.context(jet, &self.claim.place.kept).scale
        })?;
        let tape = Tape::new(&graph, scale.as_slice());
        let mut evaluator = Evaluator::new(&tape, Float::<TAPE_LANES>);
        let square = |block: &Block| {
            evaluator.run(block);
            scale.map_or([f64::NAN; TAPE_LANES], |_| evaluator.output(0).map(f64::sqrt))
        };
        Ok(self.states[..blocks].iter().map(square).collect())
    }
}

/// Records the residual. Returns its tape, and the number of antiderivatives among its inputs.
pub fn record_residual(case: &Case, claim: &PlacedClaim) -> Result<(Tape, usize), Fault> {
    let (graph, residual) = with_jet(case, |jet| claim.kind.residual(jet, &claim.place.kept))?;
    let inputs = case.model.free_components() + case.model.dimension();
    Ok((Tape::new(&graph, &residual), graph.inputs() - inputs))
}

/// Records the residual with fewer operations: nodes of proportional value are merged, and
/// quantities for which the system knows shorter formulas are made by those.
pub fn record_merged(case: &Case, claim: &PlacedClaim) -> Result<Tape, Fault> {
    let (graph, (residual, shortcuts)) = at_point(case, |phase| {
        let jet = DualPoint::short(phase);
        let residual = claim.kind.residual(&jet, &claim.place.kept);
        (residual, jet.phase.model().system.shortcuts(&jet.phase))
    })?;
    // The narrowest part of phase space first: more values are equal there.
    let wider = claim.place.wider(&case.model).into_iter().rev();
    for place in std::iter::once(claim.place.clone()).chain(wider) {
        let sampler = Sampler::new(case, &place, 1)?;
        if sampler.is_numerical() || place.kept.iter().all(|kept| !kept) {
            continue;
        }
        let sources = sampler.sources();
        let signs = sources.iter().map(|source| *source == InputDistribution::Sign).collect();
        let points = Points { graph: sampler.graph(), inputs: sampler.made(), signs };
        if let Some((graph, residual)) = graph.merged_at(&residual, &shortcuts, &points)? {
            return Ok(Tape::new(&graph, &residual));
        }
    }
    let (graph, residual) = graph.merged(&residual, &shortcuts)?;
    Ok(Tape::new(&graph, &residual))
}

fn with_jet<R>(
    case: &Case,
    build: impl FnOnce(&DualPoint<'_, Expr>) -> R,
) -> Result<(Graph, R), Fault> {
    at_point(case, |phase| build(&DualPoint::new(phase)))
}

fn at_point<'c, R>(
    case: &'c Case,
    build: impl FnOnce(Phase<'c, Expr>) -> R,
) -> Result<(Graph, R), Fault> {
    let free = case.model.free_components();
    record(free + case.model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(free);
        build(Phase::new(&case.model, parameters, state))
    })
}

/// Runs a function several times. Returns its result, and the shortest time.
fn timed<R>(mut make: impl FnMut() -> Result<R, Fault>) -> Result<(R, Duration), Fault> {
    let mut once = || {
        let started = Instant::now();
        make().map(|made| (made, started.elapsed()))
    };
    let (mut made, mut least) = once()?;
    for _ in 1..RECORDINGS {
        let (again, time) = once()?;
        made = again;
        least = least.min(time);
    }
    Ok((made, least))
}
