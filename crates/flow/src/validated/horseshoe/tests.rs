//! Horseshoes of known systems.

use super::*;

/// Maps that stretch by 3 and squeeze to a fourth, with images off the middle and entries that vary.
fn saddles(count: usize, rad: f64) -> Vec<PlaneMap> {
    let slopes = [[3.0, 0.01], [0.01, 0.25]].map(|row| row.map(|x| Enclosure::about(x, rad)));
    vec![PlaneMap { middle: [1e-3, -1e-3].map(Enclosure::exact), slopes }; count]
}

const LAST: Rectangle = Rectangle { middle: [0.0, 0.0], half: [1.0, 1.0] };

#[test]
fn entropies_of_two_loops() {
    // two loops of one length have ln 2
    let both = entropy([2.0, 2.0]);
    assert!(both <= std::f64::consts::LN_2 / 2.0 && both > 0.3465735, "{both}");
    // x⁷ = x⁶ + 1
    let seven = entropy([1.0, 7.0]);
    assert!((seven - 0.2275).abs() < 1e-4, "{seven}");
}

#[test]
fn fitted_rectangles_cover_one_another() {
    let maps = saddles(6, 1e-3);
    let known = vec![[2.0, 2.0]; 6];
    let halves = fitted(&maps, &known, 0.5, &LAST);
    let margin = chained(&maps, &halves, &LAST).expect("each covers the next");
    assert!(margin.unstable > 1.0 && margin.stable > 1.0, "{margin:?}");
    assert!(halves[0][0] < 1e-2, "{halves:?}: 3⁶ is large");
}

/// Changes of a map, by name.
type Spoilt = (&'static str, fn(&mut PlaneMap));

#[test]
fn one_broken_relation_breaks_the_chain() {
    let maps = saddles(6, 1e-3);
    let halves = fitted(&maps, &[[2.0, 2.0]; 6], 0.5, &LAST);
    let broken: [Spoilt; 6] = [
        ("it stretches less", |map| map.slopes[0][0].mid = 2.99),
        ("it squeezes less than the sizes allow", |map| map.slopes[1][1].mid = 0.9),
        ("the directions are exchanged", |map| map.slopes.swap(0, 1)),
        ("more shear", |map| map.slopes[0][1].rad = 0.2),
        ("its image lies elsewhere", |map| map.middle[0].mid = -0.2),
        ("it is not known", |map| map.slopes[1][0].rad = f64::INFINITY),
    ];
    for (name, spoil) in broken {
        let mut maps = maps.clone();
        spoil(&mut maps[2]);
        assert_eq!(chained(&maps, &halves, &LAST), None, "{name}");
    }
    let mut turned = maps.clone();
    turned[2].slopes[0][0].mid = -3.0;
    assert!(chained(&turned, &halves, &LAST).is_some(), "edges may change sides");
    assert_eq!(chained(&maps, &halves[..5], &LAST), None, "a rectangle is missing");
}
