//! Guards the instruction counts of the work items against regressions, by valgrind's callgrind:
//! the count is the same in every run, however busy the machine is.
//!
//! Valgrind does not support AVX-512, so the code for AVX2 is counted. Without valgrind, or on
//! another processor, nothing is counted, and the test says so.

mod callgrind;

use callgrind::all_counts;
use liouville::engine::{Backend, Engine, RowBlock};
use liouville::graph::Tape;
use liouville_lab::bench::{record_residual, work_items};

/// Parts of the work on a residual: recording and layout; a run at 64 states by the interpreter; a
/// run by machine code, including its generation.
const PARTS: [&str; 3] = ["record", "interpret", "compile"];

/// Functions that do the parts.
const FUNCTIONS: [&str; 3] = ["counted_record", "counted_interpret", "counted_compile"];

/// Counts for W1, W2, W3, in the order of the parts. To be lowered when a change reduces them.
const COUNTS: [[u64; 3]; 3] = [
    [4_580_037, 826_190, 1_135_851],
    [7_513_209, 1_001_116, 1_424_443],
    [5_515_793, 880_119, 1_221_529],
];

/// Percentage by which a count may grow, for a compiler of another version.
const MARGIN: u64 = 10;

const ITEM: &str = "LIOUVILLE_COUNTED_ITEM";

fn tape(index: usize) -> Tape {
    let item = &work_items().expect("the work items are cases")[index];
    record_residual(&item.case, &item.case.claims[0]).expect("records").0
}

#[inline(never)]
fn counted_record(index: usize) -> Tape {
    tape(index)
}

#[inline(never)]
fn counted_interpret(tape: &Tape) -> f64 {
    run(tape, Backend::Interpreter)
}

#[inline(never)]
fn counted_compile(tape: &Tape) -> f64 {
    run(tape, Backend::Quickest)
}

fn run(tape: &Tape, means: Backend) -> f64 {
    let mut runner = Engine::new(tape, means).runner();
    for (k, row) in runner.inputs().iter_mut().enumerate() {
        *row = RowBlock(std::array::from_fn(|lane| 1.0 + (k * 64 + lane) as f64 / 1000.0));
    }
    runner.run();
    runner.output(0).0[0]
}

/// The counted work: run by the test below under valgrind.
#[test]
fn workload() {
    let Some(index) = std::env::var(ITEM).ok().and_then(|index| index.parse().ok()) else { return };
    let tape = counted_record(index);
    assert!(counted_interpret(&tape).is_finite(), "the residual has a value");
    assert!(counted_compile(&tape).is_finite(), "by machine code too");
}

#[test]
#[ignore = "slow: under valgrind; growth.rs counts operations"]
fn the_work_items_take_no_more_instructions_than_before() {
    let items = [0, 1, 2].map(|index| index.to_string());
    let Some(all) = all_counts(ITEM, &items, &FUNCTIONS) else { return };
    for (index, (counts, found)) in COUNTS.iter().zip(all).enumerate() {
        assert_eq!(found.len(), PARTS.len(), "W{}: {found:?}", index + 1);
        for ((part, before), found) in PARTS.iter().zip(counts).zip(found) {
            println!("W{}, {part}: {found} instructions, {before} before", index + 1);
            assert!(
                found * 100 <= before * (100 + MARGIN),
                "W{}, {part}: {found} instructions, {before} before",
                index + 1
            );
        }
    }
}
