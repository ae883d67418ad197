//! Motions at the ends of the range of f64: right, or refused with the reason.

use liouville::number::double_double::DoubleDouble;
use liouville_flow::{FlowError, Precision, orbit};

use crate::{parse, start};

fn end(
    field: [&str; 2],
    begin: &str,
    time: f64,
    precision: Precision,
) -> Result<[f64; 2], FlowError> {
    let [x, y] = field;
    let case = parse(&format!(
        "title = 'a'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = '{x}'\n\"y'\" = '{y}'\n"
    ));
    let found = orbit(&case, start(&case, begin), DoubleDouble::from_f64(time), precision)?;
    Ok([found.end[0].hi, found.end[1].hi])
}

#[test]
fn terms_that_are_lost_do_not_make_steps_longer() {
    for precision in [Precision::Float, Precision::Pair] {
        // y = 1/√(1 + 2t): the coefficients of order 20 are below 10⁻³⁰⁸ from t = 10¹⁵ on
        for time in [1e15, 1e17] {
            let [_, y] = end(["0", "-y^3"], "x=0 y=1", time, precision).expect("it decays");
            assert!((y * (1.0 + 2.0 * time).sqrt() - 1.0).abs() < 1e-12, "{time:e}: {y:e}");
        }
        let slow = end(["y*1e-300", "-x*1e-300"], "x=1 y=0", 1e300, precision);
        assert!(matches!(slow, Err(FlowError::Endless { .. })), "not (1, -1): {slow:?}");
        let free = end(["1", "x"], "x=0 y=0", 1e10, precision);
        assert_eq!(free, Ok([1e10, 5e19]), "a polynomial is followed to its end");
    }
}

#[test]
fn numbers_out_of_range_are_told() {
    for precision in [Precision::Float, Precision::Pair] {
        let tiny = end(["y", "-x"], "x=1e-320 y=1e-320", 10.0, precision);
        assert!(matches!(tiny, Err(FlowError::OutOfRange { is_large: false, .. })), "{tiny:?}");
        let huge = end(["y", "-x^3"], "x=1e100 y=0", 1.0, precision);
        assert!(matches!(huge, Err(FlowError::OutOfRange { is_large: true, .. })), "{huge:?}");
        let [x, _] = end(["y", "-x"], "x=1e-200 y=0", 10.0, precision).expect("within the range");
        assert!((x / 1e-200 - 10f64.cos()).abs() < 1e-13, "{x:e}");
        let decayed = end(["-x", "-y"], "x=1 y=1", 1e3, precision).expect("it decays to nothing");
        assert!(decayed.iter().all(|x| x.abs() < 1e-300), "{decayed:?}");
    }
}
