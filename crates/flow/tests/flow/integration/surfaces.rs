//! Sections by surfaces that are formulas: moduli, steep functions and high powers, touches, long steps.

use std::f64::consts::PI;

use liouville::case::{Case, Direction};
use liouville_flow::{
    Columns, CrossingSurface, FlowError, Lexicon, SurfaceRequest, surface_section,
};

use super::moduli::field;
use crate::integration::start;

/// Times and directions of the crossings of a surface.
pub(super) fn crossings(
    case: &Case,
    surface: &str,
    begin: &str,
    crossings: usize,
) -> Vec<(f64, bool)> {
    let lexicon = || Lexicon::new(case);
    let surface = CrossingSurface::read(lexicon(), surface).expect("a surface");
    let axes = Columns::read(lexicon(), "x").expect("axes");
    let (direction, skip, backwards) = (Direction::Both, 0, false);
    let request =
        SurfaceRequest { surface: &surface, axes: &axes, direction, crossings, skip, backwards };
    let found = surface_section(case, &request, &[Ok(start(case, begin))], 1, &|_| ());
    let found = found.expect("a section");
    assert_eq!(found[0].crossings.len(), crossings, "{:?}", found[0].problem);
    found[0].crossings.iter().map(|crossing| (crossing.time, crossing.rising)).collect()
}

#[test]
fn sections_take_moduli_steep_functions_and_high_powers() {
    let circle = field(&[("x", "y"), ("y", "-x")]);
    for (surface, x) in [
        ("abs(x) = 1/2", None),
        ("max(x, -1/2) = 1/4", Some(0.25)),
        ("tanh(400*x) = 1/2", Some(3f64.ln() / 800.0)),
        ("tanh(1000*x) = -7/10", Some(-(17f64 / 3.0).ln() / 2000.0)),
        ("exp(-400*x)/(1 + exp(-400*x)) = 1/2", Some(0.0)),
        ("x^41 = 1/1000", Some(10f64.powf(-3.0 / 41.0))),
        ("x^81 = 10^(-10)", Some(10f64.powf(-10.0 / 81.0))),
        ("(1 - y^2)^20 = 10^(-6)", None),
    ] {
        let found = crossings(&circle, surface, "x=1 y=0", 80);
        assert!(found.windows(2).all(|pair| pair[0].1 != pair[1].1), "{surface}: they alternate");
        let Some(x) = x else {
            assert!((found[79].0 - 40.0 * PI).abs() < PI / 2.0, "{surface}: {:?}", found[79]);
            continue;
        };
        for (k, (time, _)) in found.iter().enumerate() {
            let turn = 2.0 * PI * k.div_ceil(2) as f64;
            let expected = if k % 2 == 0 { turn + x.acos() } else { turn - x.acos() };
            assert!((time - expected).abs() < 1e-9, "{surface}: {time}, not {expected}");
        }
    }
}

#[test]
fn moduli_that_turn_often_within_a_step_keep_their_sides() {
    // |sin k sin t| is 1/9 where k sin t = ±asin(1/9) + nπ.
    let circle = field(&[("x", "y"), ("y", "-x")]);
    for k in [17, 23, 29] {
        let mut expected = Vec::new();
        for n in -k..=k {
            for side in [-1.0, 1.0] {
                let y = (f64::from(n) * PI + side * (1f64 / 9.0).asin()) / f64::from(k);
                if y.abs() < 1.0 {
                    expected.extend([y.asin(), PI - y.asin()].map(|t| t.rem_euclid(2.0 * PI)));
                }
            }
        }
        expected.sort_by(f64::total_cmp);
        let surface = format!("abs(sin({k}*y)) = 1/9");
        let found = crossings(&circle, &surface, "x=1 y=0", expected.len());
        for ((time, _), expected) in found.iter().zip(&expected) {
            assert!((time - expected).abs() < 1e-6, "{surface}: {time}, not {expected}");
        }
    }
}

#[test]
fn moduli_that_are_touched_are_not_crossed() {
    let circle = field(&[("x", "y"), ("y", "-x")]);
    let section = |surface: &str, crossings: usize| {
        let lexicon = || Lexicon::new(&circle);
        let surface = CrossingSurface::read(lexicon(), surface).expect("a surface");
        let axes = Columns::read(lexicon(), "x").expect("axes");
        let (direction, skip, backwards) = (Direction::Both, 0, false);
        let request = SurfaceRequest {
            surface: &surface,
            axes: &axes,
            direction,
            crossings,
            skip,
            backwards,
        };
        let begin = [Ok(start(&circle, "x=1 y=1/10"))];
        let found = surface_section(&circle, &request, &begin, 1, &|_| ()).expect("a section");
        found.into_iter().next().expect("one motion")
    };
    // x is 0 every half turn, and y in between.
    for (surface, touched, places) in [
        ("abs(x)*y = 0", true, 0.0),
        ("x*abs(x) = 0", false, 0.5),
        ("x*abs(x)*y*abs(y) = 0", false, 0.0),
    ] {
        let found = section(surface, 5);
        assert_eq!(found.tangencies > 0, touched, "{surface}: {}", found.tangencies);
        let (first, gap) = (0.1f64.atan(), if places == 0.0 && !touched { 0.5 } else { 1.0 });
        for (index, crossing) in found.crossings.iter().enumerate() {
            let expected = first + PI * (places + gap * index as f64);
            assert!((crossing.time - expected).abs() < 1e-7, "{surface}: {}", crossing.time);
        }
    }
    for surface in ["abs(x - 1/3) = 0", "max(x - 1/3, 1/3 - x) = 0", "abs(x)^3 = 0"] {
        let found = section(surface, 2);
        assert!(found.crossings.is_empty() && found.tangencies > 2, "{surface}: {found:?}");
    }
    let found = section("sqrt(abs(x)) = 1/2", 8);
    assert!(found.problem.is_none() && found.crossings.len() == 8, "through x = 0: {found:?}");
    for surface in ["sqrt(x + 1/2) = 2", "atan2(y, x) = 4", "x^21 = 0"] {
        let problem = section(surface, 2).problem;
        assert!(matches!(problem, Some(FlowError::SectionEnds { .. })), "{surface}: {problem:?}");
    }
}

#[test]
fn roots_of_polynomials_far_from_a_start_are_found() {
    let line = field(&[("x", "1"), ("y", "0")]);
    for (surface, begin, roots) in [
        ("x^3 = x", "x=-1000 y=1", &[-1.0, 0.0, 1.0][..]),
        ("x*(x-1)*(x-2)*(x-3) = 0", "x=-1000 y=1", &[0.0, 1.0, 2.0, 3.0]),
        ("x^2 = 4", "x=-100000 y=1", &[-2.0, 2.0]),
    ] {
        let from: f64 =
            begin["x=".len()..].split(' ').next().and_then(|x| x.parse().ok()).expect("x");
        let found = crossings(&line, surface, begin, roots.len());
        for ((time, _), root) in found.iter().zip(roots) {
            assert!((time + from - root).abs() < 1e-6, "{surface}: {found:?}");
        }
        assert_eq!(found.len(), roots.len(), "{surface}");
    }
}
