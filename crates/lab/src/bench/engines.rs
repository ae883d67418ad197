//! The merged residual in f64 by each engine, and a lower bound on its time.

use std::time::{Duration, Instant};

use super::DifferentiationMethod;
use super::candidate::{Block, Candidate};
use super::subject::BenchCandidate;
use liouville::engine::{Backend, Engine, RowBlock, Runner, StepCounts};
use liouville::graph::{Expr, Tape, record};
use liouville::number::arb::Approximation;
use num_dual::DualNum;

/// Number of independent sums: more than a processor executes at once, and few enough to have a
/// register each.
const CHAINS: usize = 12;
/// Number in all inputs of a floor.
const START: f64 = 0.3125;

/// Entries for the engines of this machine, and the floor; `laying_out` is the time to lay out the
/// tape.
pub fn all<'s>(tape: &Tape, states: &[Block], laying_out: Duration) -> Vec<BenchCandidate<'s>> {
    let mut entries = Vec::new();
    let mut add = |method, domain, engine: &Engine, set_up, candidate| {
        let operations = Some(engine.steps());
        entries.push(BenchCandidate { method, domain, operations, set_up, candidate });
    };
    let kinds =
        [("f64, interpreter", Backend::Interpreter), ("f64, machine code", Backend::Quickest)];
    for (domain, means) in kinds {
        let started = Instant::now();
        let engine = Engine::new(tape, means);
        let set_up = laying_out + started.elapsed();
        if means == Backend::Interpreter || engine.is_machine_code() {
            let rows = |block: &Block| block.iter().map(|input| RowBlock(*input)).collect();
            let states = states.iter().map(rows).collect();
            let candidate = Box::new(EngineRun { runner: engine.runner(), states });
            add(
                DifferentiationMethod::MergedTape,
                domain,
                &engine,
                set_up,
                candidate as Box<dyn Candidate>,
            );
            if let Some(floor) = floor(engine.counts()).filter(|_| engine.is_machine_code()) {
                add(DifferentiationMethod::Floor, "f64", &engine, Duration::ZERO, Box::new(floor));
            }
        }
    }
    entries
}

/// An engine with its states.
struct EngineRun {
    runner: Runner,
    states: Vec<Vec<RowBlock>>,
}

impl Candidate for EngineRun {
    fn run(&mut self, block: usize) {
        self.runner.run_on(&self.states[block]);
    }

    fn value(&self, lane: usize) -> Option<Approximation> {
        Approximation::from_f64(self.runner.output(0).0[lane])
    }
}

/// The operations of a residual's steps at the full speed of this machine: all in registers, none
/// waiting for another. Whatever computes the residual by these steps takes longer.
struct Floor(Runner);

impl Candidate for Floor {
    fn run(&mut self, _block: usize) {
        self.0.run();
    }

    /// Always `None`: the sums have no meaning.
    fn value(&self, _lane: usize) -> Option<Approximation> {
        None
    }
}

/// Operation of a floor on a number of its own and two that are common to all.
#[derive(Clone, Copy)]
enum Independent {
    Product,
    Sum,
    Division,
    Root,
}

fn floor(counts: StepCounts) -> Option<Floor> {
    let order = mixed(&[
        (Independent::Product, counts.products),
        (Independent::Sum, counts.sums),
        (Independent::Division, counts.divisions),
        (Independent::Root, counts.roots),
    ]);
    let (graph, ends) = record(CHAINS + 2, |x| {
        let (a, b) = (x[CHAINS] + x[0], x[CHAINS + 1] + x[0]);
        let mut chains: Vec<Expr> = x[..CHAINS].to_vec();
        for (step, operation) in order.iter().enumerate() {
            let chain = &mut chains[step % CHAINS];
            *chain = match operation {
                Independent::Product => *chain * a + b,
                Independent::Sum => *chain + b,
                Independent::Division => chain.recip(),
                Independent::Root => chain.sqrt(),
            };
        }
        chains
    })
    .ok()?;
    let mut runner = Engine::new(&Tape::new(&graph, &ends), Backend::Quickest).runner();
    // Numbers that stay near 1 in every chain.
    runner.inputs().iter_mut().for_each(|row| row.0.fill(START));
    Some(Floor(runner))
}

/// Spreads operations evenly over a sequence.
fn mixed(counts: &[(Independent, usize)]) -> Vec<Independent> {
    let places = |(operation, count): &(Independent, usize)| {
        let (operation, count) = (*operation, *count);
        (0..count).map(move |k| ((2 * k + 1) as f64 / (2 * count) as f64, operation))
    };
    let mut all: Vec<(f64, Independent)> = counts.iter().flat_map(places).collect();
    all.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    all.into_iter().map(|(_, operation)| operation).collect()
}
