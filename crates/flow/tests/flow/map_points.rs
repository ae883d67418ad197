//! Periodic points of maps: from a start, and all of them in a box.

use liouville::case::Case;
use liouville_flow::{
    CycleKind, MapBox, MapPoint, MapPoints, PointDoubt, fixed_parameters, map_point, map_points,
};

fn map(state: &str, rules: &str) -> Case {
    let text = format!("title = 'x'\nsystem = 'map'\n[state]\n{state}\n[map]\n{rules}\n");
    Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}"))
}

fn henon() -> Case {
    map("x = '-2..2'\ny = '-2..2'", "x = '1 - 1.4*x² + y'\ny = '0.3*x'")
}

fn logistic(r: &str) -> Case {
    map("x = '0..1'", &format!("x = '{r}*x*(1 - x)'"))
}

fn near(case: &Case, start: &[f64], period: usize) -> Result<MapPoint, PointDoubt> {
    let parameters = fixed_parameters(case, 1, 0).expect("parameters");
    map_point(&case.model, &parameters, start, period)
}

fn within(case: &Case, ends: &[[f64; 2]], period: usize) -> MapPoints {
    let parameters = fixed_parameters(case, 1, 0).expect("parameters");
    let of = MapBox { ends: ends.to_vec(), period };
    map_points(&case.model, &parameters, &of).expect("a map")
}

fn is_near(found: &[f64], expected: &[f64]) -> bool {
    found.iter().zip(expected).all(|(x, y)| (x - y).abs() < 1e-12)
}

#[test]
fn henons_cycle_of_two_points_is_proved() {
    let found = near(&henon(), &[0.9, -0.1], 2).expect("a cycle");
    // a²x² − a(1 − b)x + (1 − b)² − a = 0
    let root = (0.98f64 * 0.98 + 4.0 * 1.96 * 0.91).sqrt();
    let [first, second] = [(0.98 + root) / 3.92, (0.98 - root) / 3.92];
    assert!(is_near(&found.cycle[0], &[first, 0.3 * second]), "{found:?}");
    assert!(is_near(&found.cycle[1], &[second, 0.3 * first]), "{found:?}");
    assert!(found.is_least && found.kind == Some(CycleKind::Hyperbolic), "{found:?}");
    // The product is b² and the sum 4a²x₁x₂ + 2b.
    let sum: f64 = found.multipliers.iter().map(|one| one.re).sum();
    assert!((sum - (4.0 * 1.96 * first * second + 0.6)).abs() < 1e-11, "{found:?}");
    let product = found.determinant.expect("a determinant");
    assert!((product.value - 0.09).abs() <= product.error, "{product:?}");
    assert!(found.proof.expect("a proof").iter().all(|radius| *radius < 1e-13));
}

#[test]
fn a_multiple_of_the_least_period_is_seen() {
    let found = near(&henon(), &[0.9, -0.1], 4).expect("a cycle");
    assert!(matches!(found.period, 2 | 4) && found.is_least, "{found:?}");
    let fixed = near(&henon(), &[0.63, 0.19], 6).expect("a point");
    assert!(fixed.period == 1 && fixed.cycle.len() == 1 && fixed.is_least, "{fixed:?}");
}

#[test]
fn all_points_in_a_box_are_counted() {
    // Hénon's map has cycles of 1, 1, 2, 4 points, two of 6 and four of 7, and none of 3 or 5.
    let ends = [[-2.0, 2.0], [-2.0, 2.0]];
    for (period, count) in [(1, 2), (2, 4), (3, 2), (4, 8), (5, 2), (6, 16), (7, 30)] {
        let found = within(&henon(), &ends, period);
        assert!(found.open.is_empty(), "{period}: {:?}", found.open);
        assert_eq!(found.points.len(), count, "{period}");
        assert!(found.points.iter().all(|point| point.proof.is_ok()), "{period}");
    }
    // 0 lies on the border of the box; the cycles of 3 points begin at r = 1 + √8.
    for (r, period, count) in [("4", 5, 32), ("3.83", 3, 8), ("3.82", 3, 2)] {
        let found = within(&logistic(r), &[[0.0, 1.0]], period);
        assert!(found.open.is_empty() && found.points.len() == count, "{r}: {found:?}");
    }
    // Lozi's map and the tent map are smooth but on a line.
    let lozi = map("x = '-2..2'\ny = '-2..2'", "x = '1 - 1.7*|x| + y'\ny = '0.5*x'");
    let tent = map("x = '-1..2'", "x = '1 - |1 - 2*x|*0.95'");
    for (case, ends, count) in [(&lozi, &ends[..], 4), (&tent, &[[-1.0, 2.0]][..], 4)] {
        let found = within(case, ends, 2);
        assert!(found.open.is_empty() && found.points.len() == count, "{found:?}");
    }
    let sinks = within(&logistic("3.83"), &[[0.0, 1.0]], 3).points;
    let sinks = sinks.iter().filter(|point| point.kind == Some(CycleKind::Sink));
    assert_eq!(sinks.count(), 3);
}

#[test]
fn the_standard_map_has_a_saddle_and_a_centre() {
    let case = map("x = '-4..4'\np = '-1..1'", "x = 'x + p + sin(x)'\np = 'p + sin(x)'");
    let found = within(&case, &[[-1.0, 4.0], [-1.0, 1.0]], 1);
    let kinds: Vec<_> = found.points.iter().map(|point| point.kind).collect();
    assert_eq!(kinds, [Some(CycleKind::Hyperbolic), Some(CycleKind::Elliptic)], "{found:?}");
    let largest = found.points[0].multipliers[0].re;
    assert!((largest - (3.0 + 5f64.sqrt()) / 2.0).abs() < 1e-12, "{largest}");
}

#[test]
fn what_has_no_value_or_is_degenerate_is_not_proved() {
    // 0·√x has no value at the fixed point −1.
    let root = map("x = '-2..2'", "x = '-2 - x + 0*sqrt(x)'");
    assert!(near(&root, &[-0.9], 1).map_or(true, |found| found.proof.is_err()));
    assert!(!within(&root, &[[-2.0, 2.0]], 1).points.iter().any(|point| point.proof.is_ok()));
    // Each state has the period 2.
    let turned = map("x = '-1..1'\ny = '-1..1'", "x = '-x'\ny = '-y'");
    assert_eq!(near(&turned, &[0.5, 0.5], 2).err(), Some(PointDoubt::NotFound(2)));
    let found = within(&turned, &[[-1.0, 1.0]; 2], 2);
    assert!(!found.open.is_empty() && found.points.is_empty(), "{}", found.points.len());
    // |x| has no derivative at its fixed point 0, and 1 is the multiplier of all others.
    let folded = map("x = '-1..1'", "x = '|x|/2'");
    let found = within(&folded, &[[-1.0, 1.0]], 1);
    assert!(!found.open.is_empty(), "{found:?}");
    // A pair of points has met: x² + 1/4 touches x at 1/2.
    let double = within(&map("x = '0..1'", "x = 'x² + 1/4'"), &[[0.0, 1.0]], 1);
    assert!(double.points.is_empty() && !double.open.is_empty(), "{double:?}");
    let none = within(&map("x = '0..1'", "x = 'x² + 0.2501'"), &[[0.0, 1.0]], 1);
    assert!(none.points.is_empty() && none.open.is_empty(), "{none:?}");
}

#[test]
fn cycles_smaller_than_1e_9_are_no_fixed_points() {
    // x' = s − x²/s has the cycle 0, s and the fixed points s(−1 ± √5)/2.
    for s in ["1e-12", "1e-9", "1"] {
        let case = map("x = '-2..2'", &format!("x = '{s} - x²/{s}'"));
        let size: f64 = s.parse().expect("a number");
        let found = within(&case, &[[-2.0 * size, 2.0 * size]], 2);
        let mut periods: Vec<usize> = found.points.iter().map(|point| point.period).collect();
        periods.sort_unstable();
        assert_eq!((periods, found.open.len()), (vec![1, 1, 2, 2], 0), "{s}");
        for point in &found.points {
            let image = size - point.cycle[0][0] * point.cycle[0][0] / size;
            let next = &point.cycle[1 % point.period];
            assert!((image - next[0]).abs() < 1e-12 * size, "{s}: {point:?}");
        }
    }
}
