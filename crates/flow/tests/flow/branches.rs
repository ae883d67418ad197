//! Branches of closed orbits against systems whose orbits and bifurcations are known exactly, and
//! symmetric periodic orbits.

mod bodies;
mod conservative;
mod integrals;

use std::f64::consts::PI;

use liouville::case::{Case, Direction, Setting};
use liouville::number::rational::Rational;
use liouville::verdict::read_state;
use liouville_flow::{
    Bifurcation, Branch, BranchEnd, BranchPoint, BranchRequest, BranchSection, Columns, Coordinate,
    CrossingSurface, FlowError, Lexicon, Start, branch, closed_orbit, crossing_time,
};

/// A branch to follow.
struct Wish<'w> {
    surface: &'w str,
    axes: &'w str,
    start: &'w str,
    varied: &'w str,
    range: [&'w str; 2],
}

fn parse(text: &str) -> Case {
    Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn number(text: &str) -> Rational {
    text.parse().expect("a number")
}

fn follow(case: &Case, wish: &Wish<'_>) -> Result<Branch, FlowError> {
    let surface = CrossingSurface::read(Lexicon::new(case), wish.surface).expect("a surface");
    let state = read_state(case, wish.start).expect("a state");
    let start = Start::new(case, Some(&state), 1, 0)?;
    let (start, time) = crossing_time(&start, &surface, Direction::Up, 1)?;
    let varied = Coordinate::of_branch(case, wish.varied).map(|(_, varied)| varied);
    let orbit = closed_orbit(case, &start, time, Some(&surface), &[])?;
    let request = BranchRequest {
        case,
        section: BranchSection::Surface(&surface),
        columns: Some(Columns::read(Lexicon::new(case), wish.axes).expect("columns")),
        varied: varied.expect("it may vary"),
        range: wish.range.map(number),
        fixed: Vec::new(),
        integrals: orbit.integrals,
        start: orbit.start,
        time: orbit.period.value,
        count: 200,
        longest: 0.02,
    };
    branch(&request, &|_| ())
}

fn marked(branch: &Branch) -> Vec<(Bifurcation, &BranchPoint)> {
    let found = branch.points.iter();
    found.filter_map(|point| point.bifurcation.map(|kind| (kind, point))).collect()
}

/// Asserts that a bifurcation lies at a value, within an error that is stated and small.
fn assert_at(point: &BranchPoint, value: f64, error: f64) {
    let stated = point.value_error.expect("a bifurcation has an error");
    let gap = (point.value - value).abs();
    assert!(gap <= stated && stated <= error, "{} ± {stated:e}, not {value}", point.value);
}

/// Asserts that a number is known to a relative error.
fn assert_near(found: f64, known: f64, error: f64) {
    assert!((found - known).abs() <= error * known.abs(), "{found}, not {known}");
}

/// A circle of radius √μ: r' = r(μ - r²), one turn in 2π.
const CIRCLE: &str = r#"
title = "a circle"
[parameters]
"μ" = 1
[state]
x = "-2..2"
y = "-2..2"
[field]
x = "-y + x*(μ - x² - y²)"
y = "x + y*(μ - x² - y²)"
"#;

#[test]
fn a_circle_has_its_radius_its_period_and_its_multiplier() {
    let wish =
        Wish { surface: "y = 0", axes: "x", start: "x=1 y=0", varied: "μ", range: ["-1/2", "2"] };
    let found = follow(&parse(CIRCLE), &wish).expect("a branch");
    assert!(marked(&found).is_empty(), "{:?}", marked(&found));
    assert_eq!(found.ends, [BranchEnd::Rest, BranchEnd::Range], "it begins at μ = 0");
    assert_eq!(found.points.last().expect("points").value, 2.0, "the end of the range itself");
    assert_eq!(found.points[found.start].value, 1.0);
    for point in &found.points {
        assert_near(point.at[0], point.value.sqrt(), 1e-14);
        assert_near(point.period.value, 2.0 * PI, 1e-15);
        // The derivative of r' is -2μ on the circle.
        let known = (-4.0 * PI * point.value).exp();
        let one = point.multipliers[0];
        assert!((one.re - known).abs() <= one.error + 1e-14 * known, "{one:?}, not {known}");
    }
    assert!(found.points[0].value < 0.01, "up to the place where it begins");
}

#[test]
fn folds_of_cycles_are_passed_and_placed() {
    // With r² = R: r' = 0 on μ = R² - R, which turns at R = 1/2, μ = -1/4.
    let text = CIRCLE.replace("μ - x² - y²", "μ + x² + y² - (x² + y²)²").replace("= 1\n", "= 0\n");
    let wish = Wish {
        surface: "y = 0",
        axes: "x² + y²",
        start: "x=1 y=0",
        varied: "μ",
        range: ["-1", "1"],
    };
    let found = follow(&parse(&text), &wish).expect("a branch");
    let [(Bifurcation::Fold, fold)] = marked(&found)[..] else { panic!("{:?}", marked(&found)) };
    assert_at(fold, -0.25, 1e-14);
    assert_near(fold.at[0], 0.5, 1e-7);
    assert_eq!(found.ends, [BranchEnd::Rest, BranchEnd::Range], "back to μ = 0, where r is 0");
    for point in &found.points {
        let square = point.at[0];
        assert!((square * square - square - point.value).abs() < 1e-14, "{point:?}");
        let known = (2.0 * PI * (2.0 * square - 4.0 * square * square)).exp();
        assert_near(point.multipliers[0].re, known, 1e-12);
    }
    assert!(found.points.iter().any(|point| point.at[0] < 0.05), "the branch beyond the fold");
}

/// The circle r = 1 with rates of u = r - 1 and z linear in both; `c`, `s` are the cosine and sine of
/// the angle, which grows by 1.
fn tube(u: &str, z: &str) -> String {
    format!(
        r#"
title = "a tube"
[parameters]
"μ" = "1/10"
[state]
x = "-2..2"
y = "-2..2"
z = "-1..1"
[let]
r = "sqrt(x² + y²)"
c = "x/r"
s = "y/r"
u = "r - 1"
rate = "{u}"
[field]
x = "-y + c*rate"
y = "x + s*rate"
z = "{z}"
"#
    )
}

const TUBE: Wish<'_> = Wish {
    surface: "y = 0",
    axes: "x, z",
    start: "x=1 y=0 z=0",
    varied: "μ",
    range: ["-1/4", "1/4"],
};

#[test]
fn a_flip_is_placed() {
    // Normals that turn by half a turn: n = (cos θ/2, sin θ/2) and m across it, with rates μ and -1/5
    // along them. The multipliers are -e^(2πμ) and -e^(-2π/5).
    let (p, q) = ("(μ - 1/5)/2", "(μ + 1/5)/2");
    let text =
        tube(&format!("{p}*u + {q}*(c*u + s*z) - z/2"), &format!("{p}*z + {q}*(s*u - c*z) + u/2"));
    let found = follow(&parse(&text), &TUBE).expect("a branch");
    let [(Bifurcation::Flip, flip)] = marked(&found)[..] else { panic!("{:?}", marked(&found)) };
    assert_at(flip, 0.0, 1e-12);
    for point in &found.points {
        let known = [-(2.0 * PI * point.value).exp(), -(-0.4 * PI).exp()];
        for one in &point.multipliers {
            let gap = known.iter().map(|known| (one.re - known).abs()).fold(1.0, f64::min);
            assert!(gap < 1e-12 && one.im == 0.0, "{one:?} of {known:?}");
        }
    }
}

#[test]
fn a_torus_begins_where_complex_multipliers_cross_the_circle() {
    // Multipliers e^(2π(μ ± 3i/10)).
    let found = follow(&parse(&tube("μ*u - 3/10*z", "μ*z + 3/10*u")), &TUBE).expect("a branch");
    let [(Bifurcation::NeimarkSacker, torus)] = marked(&found)[..] else {
        panic!("{:?}", marked(&found))
    };
    assert_at(torus, 0.0, 1e-13);
    let one = torus.multipliers[0];
    assert_near(libm::atan2(one.im, one.re).abs(), 0.6 * PI, 1e-12);
    assert!(!found.keeps_area, "the product is 1 at one point only");
    // With two real multipliers a product of 1 is no bifurcation.
    let saddle = follow(&parse(&tube("(μ + 1/5)*u", "(μ - 1/5)*z")), &TUBE).expect("a branch");
    let kinds: Vec<Bifurcation> = marked(&saddle).iter().map(|(kind, _)| *kind).collect();
    assert_eq!(kinds, [Bifurcation::BranchPoint; 2], "1 is crossed at μ = ±1/5");
}

#[test]
fn a_branch_point_is_told_from_a_fold() {
    // z' = z(μ - z²): z = 0 crosses μ = z² at μ = 0.
    let text = tube("-u", "z*(μ - z²)");
    let along = follow(&parse(&text), &TUBE).expect("a branch");
    let [(Bifurcation::BranchPoint, point)] = marked(&along)[..] else {
        panic!("{:?}", marked(&along))
    };
    assert_at(point, 0.0, 1e-6);
    assert!(along.points.iter().all(|point| point.at[1] == 0.0), "it stays on its branch");
    // The other branch turns where it crosses.
    let wish = Wish { start: "x=1 y=0 z=0.3162", ..TUBE };
    let across = follow(&parse(&text), &wish).expect("a branch");
    let [(Bifurcation::BranchPoint, point)] = marked(&across)[..] else {
        panic!("{:?}", marked(&across))
    };
    assert_at(point, 0.0, 1e-6);
    assert_eq!(across.ends, [BranchEnd::Range, BranchEnd::Range]);
    for point in &across.points {
        assert!((point.at[1] * point.at[1] - point.value).abs() < 1e-9, "{:?}", point.at);
    }
    assert!(across.points.iter().any(|point| point.at[1] < -0.4), "through the turn");
}

#[test]
fn the_first_doubling_of_roessler_s_cycle_is_found() {
    let case = parse(
        r#"
title = "Rössler"
[parameters]
c = "5/2"
[state]
x = "-10..10"
y = "-10..10"
z = "0..10"
[field]
x = "-y - z"
y = "x + y/5"
z = "1/5 + z*(x - c)"
"#,
    );
    let wish = Wish {
        surface: "-y = 0",
        axes: "x, z",
        start: "x=-3.7023 y=0 z=0.03334",
        varied: "c",
        range: ["2", "3"],
    };
    let found = follow(&case, &wish).expect("a branch");
    let [(Bifurcation::Flip, flip)] = marked(&found)[..] else { panic!("{:?}", marked(&found)) };
    assert_near(flip.value, ROESSLER[0], 2e-12);
    assert_near(flip.period.value, ROESSLER[1], 2e-12);
}

/// Place and period of the doubling by another integrator: Gragg's midpoint rule extrapolated from
/// 2, 4, …, 18 steps, 50 and 90 times a period, with the variational equations; Newton's method closes
/// the orbit, the secant method finds det(M + 1) = 0. Both agree to 2·10⁻¹².
const ROESSLER: [f64; 2] = [2.832_445_027_862_6, 5.769_820_016_506_6];

#[test]
fn what_cannot_be_followed_is_refused() {
    let case = parse(CIRCLE);
    let wish =
        Wish { surface: "y = 0", axes: "x", start: "x=1 y=0", varied: "μ", range: ["2", "3"] };
    let outside = FlowError::OutsideRange { value: 1.0, from: 2.0, to: 3.0 };
    assert_eq!(follow(&case, &wish).err(), Some(outside));
    let energy = Wish { varied: "energy", ..wish };
    assert_eq!(follow(&case, &energy).err(), Some(FlowError::NoEnergy));
    for (name, wrong) in [("q", "there is no `q` to vary"), ("l", "`l` is a coordinate")] {
        let mistake = Coordinate::of_branch(&case, name).expect_err(name);
        assert!(
            mistake.message.starts_with(wrong) && mistake.help.contains("vary μ"),
            "{mistake:?}"
        );
    }
    let ranged = Case::parse(CIRCLE, &[Setting { name: "μ".into(), value: "2".into() }]);
    let ranged = follow(&ranged.expect("a case"), &Wish { start: "x=1.4 y=0", ..wish });
    assert_eq!(ranged.expect("from its own value").points[0].value, 2.0);
}
