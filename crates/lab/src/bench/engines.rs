//! The merged residual in f64 by each engine, and a lower bound on its time.

use std::time::{Duration, Instant};

use super::DifferentiationMethod;
use super::candidate::{Block, Candidate};
use super::subject::BenchCandidate;
use liouville::engine::{Backend, Engine, Runner};
use liouville::graph::{Expr, Tape, record};
use liouville::number::arb::Approximation;

/// Number of independent sums: more than a processor executes at once, and few enough to have a
/// register each.
const CHAINS: usize = 12;

/// Entries for the engines of this machine, and the floor; `laying_out` is the time to lay out the
/// tape.
pub fn all<'s>(tape: &Tape, states: &'s [Block], laying_out: Duration) -> Vec<BenchCandidate<'s>> {
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
            let candidate = Box::new(EngineRun { runner: engine.runner(), states });
            add(
                DifferentiationMethod::MergedTape,
                domain,
                &engine,
                set_up,
                candidate as Box<dyn Candidate>,
            );
            if let Some(floor) = floor(engine.steps()).filter(|_| engine.is_machine_code()) {
                add(DifferentiationMethod::Floor, "f64", &engine, Duration::ZERO, Box::new(floor));
            }
        }
    }
    entries
}

/// An engine with its states.
struct EngineRun<'s> {
    runner: Runner,
    states: &'s [Block],
}

impl Candidate for EngineRun<'_> {
    fn run(&mut self, block: usize) {
        for (row, input) in self.runner.inputs().iter_mut().zip(&self.states[block]) {
            row.0 = *input;
        }
        self.runner.run();
    }

    fn value(&self, lane: usize) -> Option<Approximation> {
        Approximation::from_f64(self.runner.output(0).0[lane])
    }
}

/// One fused sum for each step of a residual, at the full speed of this machine: only x ← x a + b
/// in registers. A division or a root takes longer than a sum, so this is faster than any engine
/// can be.
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

fn floor(steps: usize) -> Option<Floor> {
    let (graph, ends) = record(CHAINS + 2, |x| {
        let (a, b) = (x[CHAINS] + x[0], x[CHAINS + 1] + x[0]);
        let mut chains: Vec<Expr> = x[..CHAINS].to_vec();
        for step in 0..steps {
            let chain = &mut chains[step % CHAINS];
            *chain = *chain * a + b;
        }
        chains
    })
    .ok()?;
    Some(Floor(Engine::new(&Tape::new(&graph, &ends), Backend::Quickest).runner()))
}
