//! Motions that come to zeros of roots: the series knows nothing of the other branch.

use liouville::number::double_double::DoubleDouble;
use liouville_flow::{FlowError, Precision, orbit};

use crate::integration::{parse, start};

#[test]
fn motions_end_where_a_root_vanishes() {
    let cases = [
        // x = (1 − t/2)²
        ("x = '0..2'\n[field]\n\"x'\" = '-sqrt(x)'\n", "x=1", 2.0),
        // |t − 1|
        ("x = '-2..2'\ny = '0..1'\n[field]\n\"x'\" = '1'\n\"y'\" = 'sqrt(x^2)'\n", "x=-1 y=0", 1.0),
        // friction of a constant size stops it
        (
            "x = 'vector(2, -1..1)'\nv = 'vector(2, -1..1)'\n[field]\n\"x'\" = 'v'\n\"v'\" = '-v/|v|'\n",
            "x=[0,0] v=[3/5,4/5]",
            1.0,
        ),
        // (1 − 2t/3)^(3/2)
        ("x = '0..2'\n[field]\n\"x'\" = '-x^(1/3)'\n", "x=1", 1.5),
    ];
    for (system, state, end) in cases {
        let case = parse(&format!("title = 'a'\n[state]\n{system}"));
        for precision in [Precision::Float, Precision::Pair] {
            let begin = || start(&case, state);
            let found = orbit(&case, begin(), DoubleDouble::from_f64(2.0 * end), precision);
            match found {
                Err(FlowError::Singular { time, .. }) => {
                    assert!((time - end).abs() < 1e-7, "{system}: {time}, not {end}");
                }
                other => panic!("{system} goes on: {:?}", other.map(|orbit| orbit.steps)),
            }
            let before = orbit(&case, begin(), DoubleDouble::from_f64(0.9 * end), precision);
            assert!(before.is_ok(), "{system} goes up to there");
        }
    }
}

#[test]
fn roots_that_stay_positive_stop_nothing() {
    let case = parse(
        "title = 'a'\n[state]\nx = 'vector(2, -1..1)'\nv = 'vector(2, -1..1)'\n[field]\n\"x'\" = 'v'\n\
         \"v'\" = '-x/|x|^3'\n",
    );
    // Kepler's ellipse of period 2π, nearly a line
    let time = DoubleDouble::from_f64(2.0 * std::f64::consts::PI);
    let begin = start(&case, "x=[2,0] v=[0,0]");
    let found = orbit(&case, begin, time, Precision::Float);
    assert!(matches!(found, Err(FlowError::Singular { .. })), "it falls into the centre");
    let begin = start(&case, "x=[19/10,0] v=[0,0.2294157338705618]");
    let found = orbit(&case, begin, time, Precision::Float).expect("it passes the centre");
    let gap = |k: usize, x: f64| (found.end[k].hi - x).abs();
    assert!(gap(0, 1.9) < 1e-10 && gap(1, 0.0) < 1e-10, "{:?}", found.end);
}
