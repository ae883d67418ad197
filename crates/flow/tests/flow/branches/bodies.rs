//! Branches and symmetric orbits of rolling bodies, against points found one by one.

use std::f64::consts::PI;
use std::path::Path;

use liouville::case::{Case, FixedLine};
use liouville::number::rational::Rational;
use liouville_flow::{
    Bifurcation, Branch, BranchRequest, BranchSection, Coordinate, Fixed, FlowError, SectionMap,
    SymmetricOrbits, SymmetricRequest, branch, symmetric_orbits,
};

use crate::branches::{marked, number};

fn figure(name: &str) -> Case {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/figures"));
    let case = Case::read(&path.join(name).with_extension("toml"), &[]).1;
    case.unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn follow(case: &Case, near: [f64; 2], varied: &str, range: [&str; 2]) -> Branch {
    let plan = case.section.as_ref().expect("a section");
    let map = SectionMap::new(case, &plan.g0, &plan.energy, 1).expect("a map");
    let (_, cycle) = map.cycle(near, 1).expect("a periodic point");
    let request = BranchRequest {
        case,
        section: BranchSection::Andoyer(&plan.g0),
        columns: None,
        varied: Coordinate::of_branch(case, varied).expect("it may vary").1,
        range: range.map(number),
        fixed: vec![Fixed::energy(plan.energy.clone())],
        integrals: Vec::new(),
        time: cycle.period.value,
        start: cycle.start,
        count: 60,
        longest: 0.05,
    };
    branch(&request, &|_| ()).expect("a branch")
}

#[test]
#[ignore = "slow: a long branch; shorter ones are followed in branches.rs"]
fn a_branch_over_the_energy_goes_through_the_points_at_single_energies() {
    let case = figure("fig-5");
    let plan = case.section.as_ref().expect("a section");
    let found = follow(&case, [PI / 2.0, 0.366], "energy", ["97", "107.5"]);
    assert!(found.keeps_area, "the case has a density");
    assert!(found.points.len() > 10);
    // Pairs that collide at 1, at the same energies for the mirror images in L = 0, where it turns.
    let marks = marked(&found);
    for (kind, point) in &marks {
        assert_eq!(*kind, Bifurcation::BranchPoint, "{point:?}");
        assert!((point.trace.value - 2.0).abs() < 1e-6, "{point:?}");
        let known = [98.76599, 99.264364, 106.369674].iter().map(|x| (x - point.value).abs());
        assert!(known.fold(1.0, f64::min) < 2e-6 && point.value_error < Some(2e-6), "{point:?}");
    }
    assert!(marks.iter().any(|(_, point)| point.at[1].abs() < 1e-6), "it turns at L = 0");
    let ordinary = found.points.iter().filter(|point| point.bifurcation.is_none());
    for point in ordinary.step_by(6) {
        let energy = Rational::from_f64(point.value).expect("a number");
        let map = SectionMap::new(&case, &plan.g0, &energy, 1).expect("a map");
        let single = map.closed([point.at[0], point.at[1]], 1).expect("a periodic point");
        let single = single.point();
        assert!((single.at[0] - point.at[0]).abs() < 1e-12, "{point:?} and {single:?}");
        assert!((single.at[1] - point.at[1]).abs() < 1e-12, "{point:?} and {single:?}");
        assert!((single.time / point.period.value - 1.0).abs() < 1e-13);
        assert!((single.trace - point.trace.value).abs() < 1e-10, "{point:?} and {single:?}");
    }
}

fn symmetric(name: &str, lines: &[FixedLine], points: usize) -> Result<SymmetricOrbits, FlowError> {
    let case = figure(name);
    let plan = case.section.as_ref().expect("a section");
    symmetric_orbits(&SymmetricRequest {
        case: &case,
        g0: &plan.g0,
        energy: &plan.energy,
        lines,
        longest: 1,
        points,
        seed: 1,
        threads: 2,
    })
}

#[test]
#[ignore = "slow: liouville-cli lists the same orbits, from fewer points"]
fn symmetric_points_of_an_ellipsoid_are_those_of_its_symmetries() {
    let lines = [FixedLine::Equator, FixedLine::Meridian, FixedLine::QuarterMeridian];
    let found = symmetric("fig-A2", &lines, 200).expect("the ellipsoid has these reversors");
    assert_eq!((found.unconfirmed, found.lost), (0, 0));
    // Rolling about an axis in a plane of symmetry: (l, L/G) at the middle of each arc.
    for (l, multiplier) in
        [(0.0, None), (PI, None), (PI / 2.0, Some(2.451_348)), (1.5 * PI, Some(2.451_348))]
    {
        let near = |at: [f64; 2]| libm::hypot(libm::sin((at[0] - l) / 2.0), at[1]) < 1e-9;
        let orbit = found.orbits.iter().find(|orbit| near(orbit.point.at)).expect("there");
        assert_eq!(orbit.point.period, 1);
        assert!(orbit.lines.len() > 1, "it lies where two lines meet: {:?}", orbit.lines);
        let first = orbit.cycle.multipliers[0];
        match multiplier {
            // Figure A.2 claims these numbers.
            Some(larger) => assert!((first.re - larger).abs() < 1e-6, "{first:?}"),
            None => assert!((libm::atan2(first.im, first.re) - 1.99316).abs() < 1e-5, "{first:?}"),
        }
    }
    for orbit in &found.orbits {
        let product = orbit.cycle.volume;
        assert!(product.value.abs() <= 10.0 * product.error, "1 at symmetric points: {product:?}");
    }
}

#[test]
fn a_line_of_no_reversor_is_refused() {
    let found = symmetric("fig-A6", &[FixedLine::Equator], 10);
    assert!(matches!(found.err(), Some(FlowError::NoReversor { line: "L=0", .. })));
    assert!(symmetric("fig-A6", &[FixedLine::Meridian], 3).is_ok(), "this one it has");
}
