use num_dual::DualNum;

use super::encode::Width;
use super::*;
use crate::taylor::batch::MOTION_LANES;
use crate::taylor::lanes::Lanes;
use crate::taylor::program::TaylorProgram;
use crate::taylor::series::Series;
use liouville::graph::{Expr, record};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

const ORDERS: [usize; 3] = [7, 20, 25];

/// Fields that use all rules, and fields whose rules are all instructions.
fn programs() -> Vec<(&'static str, TaylorProgram)> {
    let number = |n: i64, d: i64| Expr::rational(&Rational::new(n, d));
    let algebraic = |x: &[Expr]| {
        let size = (x[0] * x[0] + x[1] * x[1] + number(1, 3)).sqrt();
        let slope = (x[2] * x[2] + number(7, 5)).recip();
        vec![
            x[1] * x[2] * number(-5, 7) + size * x[1] * slope,
            x[2] * x[0] * x[1] - size * number(11, 10) + x[2],
            x[0] * slope + number(1, 10) - x[2] * x[2] * x[2],
        ]
    };
    let wide = |x: &[Expr]| {
        let sums = (0..12).map(|k| {
            let (a, b) = (x[k], x[(k * 5 + 1) % 12]);
            a * b * number(1, k as i64 + 2) - x[(k + 3) % 12] * x[(k + 7) % 12] * a
        });
        sums.collect()
    };
    let transcendental = |x: &[Expr]| {
        vec![
            (x[1] * number(1, 3)).exp().sin() + x[0].powi(3).cos(),
            (x[0] * x[0] + number(2, 1)).ln() * x[2].atan(),
            (x[0] * x[0] + number(3, 2)).powf(1.25) * number(1, 9)
                - x[1] / (x[2] * x[2] + number(1, 1)),
        ]
    };
    let program = |dimension: usize, field: &dyn Fn(&[Expr]) -> Vec<Expr>| {
        let (graph, rates) = record(dimension, |x| field(x)).expect("a field");
        TaylorProgram::compile(&graph, &rates, &rates[..1]).expect("a program")
    };
    vec![
        ("algebraic", program(3, &algebraic)),
        ("wide", program(12, &wide)),
        ("transcendental", program(3, &transcendental)),
    ]
}

fn coefficients(series: &Series<f64>, dimension: usize) -> Vec<u64> {
    let rows = (0..dimension).map(|index| series.component(index));
    rows.chain([series.output(0)]).flatten().map(|x| x.to_bits()).collect()
}

#[test]
fn machine_code_has_the_bits_of_the_interpreter() {
    for (name, program) in programs() {
        for order in ORDERS {
            let mut interpreted = Series::<f64>::new(&program, order);
            let mut compiled = Series::<f64>::new(&program, order);
            let widths = match widest() {
                InstructionSet::Avx512 => &[Width::Four, Width::Eight][..],
                InstructionSet::Avx2 => &[Width::Four],
                InstructionSet::Baseline => &[],
            };
            for width in widths.iter().copied() {
                compiled.machine =
                    TaylorCode::with_width(&compiled.code, order, width).map(Box::new);
                assert!(compiled.machine.is_some(), "{name}: there is machine code");
                for turn in 0..20 {
                    let state: Vec<f64> = (0..program.dimension())
                        .map(|k| f64::from((turn * 37 + k as i32 * 61) % 101 - 50) / 47.0)
                        .collect();
                    interpreted.expansions = 0;
                    interpreted.expand(&state);
                    compiled.expand(&state);
                    let dimension = program.dimension();
                    let found = coefficients(&compiled, dimension);
                    let expected = coefficients(&interpreted, dimension);
                    assert!(f64::from_bits(expected[order]).is_finite(), "{name}: a series");
                    assert_eq!(found, expected, "{name}, order {order}, {width:?}, {state:?}");
                }
            }
        }
    }
}

/// Machine code for lanes, of each width that the processor has; `None` for the interpreter.
fn in_lanes(program: &TaylorProgram, order: usize) -> Vec<Series<Lanes<MOTION_LANES>>> {
    let widths = match widest() {
        InstructionSet::Avx512 => &[None, Some(Width::Four), Some(Width::Eight)][..],
        InstructionSet::Avx2 => &[None, Some(Width::Four)],
        InstructionSet::Baseline => &[None],
    };
    let series = |width: &Option<Width>| {
        let mut series = Series::<Lanes<MOTION_LANES>>::new(program, order);
        if let Some(width) = width {
            series.expansions = u32::MAX;
            series.machine = LaneMachine::with_width(&series.code, order, *width).map(Box::new);
            assert!(series.machine.is_some(), "there is machine code");
        }
        series
    };
    widths.iter().map(series).collect()
}

#[test]
fn lanes_have_the_bits_of_single_motions() {
    for (name, program) in programs() {
        for order in ORDERS {
            let dimension = program.dimension();
            let mut single = Series::<f64>::new(&program, order);
            let mut all = in_lanes(&program, order);
            for turn in 0..20 {
                let at = |lane: usize, k: usize| {
                    f64::from((turn * 37 + k as i32 * 61 + lane as i32 * 17) % 101 - 50) / 47.0
                };
                let states: Vec<Lanes<MOTION_LANES>> = (0..dimension)
                    .map(|k| Lanes(std::array::from_fn(|lane| at(lane, k))))
                    .collect();
                for series in &mut all {
                    if series.machine.is_none() {
                        series.expansions = 0;
                    }
                    series.expand(&states);
                }
                for lane in 0..MOTION_LANES {
                    let state: Vec<f64> = (0..dimension).map(|k| at(lane, k)).collect();
                    single.expand(&state);
                    let expected = coefficients(&single, dimension);
                    assert!(f64::from_bits(expected[order]).is_finite(), "{name}: a series");
                    for series in &all {
                        let rows = (0..dimension).map(|index| series.component(index));
                        let own = rows.chain([series.output(0)]).flatten();
                        let found: Vec<u64> = own.map(|x| x.0[lane].to_bits()).collect();
                        let is_compiled = series.machine.is_some();
                        assert_eq!(found, expected, "{name}, {order}, {lane}, {is_compiled}");
                    }
                }
            }
        }
    }
}

#[test]
fn memory_that_is_too_small_is_refused() {
    let (_, program) = programs().remove(0);
    let series = Series::<f64>::new(&program, 20);
    let Some(mut machine) = TaylorCode::new(&series.code, 20) else { return };
    let run =
        move || machine.run(&series.code, [&series.inverses, &series.advances], &mut [0.0; 40]);
    let refused = std::panic::catch_unwind(std::panic::AssertUnwindSafe(run));
    let refused = refused.expect_err("what it would touch is not there");
    let message = refused.downcast_ref::<String>().expect("a message");
    assert!(message.contains("machine code needs"), "{message}");
}
