//! Sets to which the motions of a grid keep: what changes its size, and what only seems to.

use liouville::number::rational::Rational;
use liouville_flow::{BasinRequest, Basins, Columns, Lexicon, StateAxis, basins};

use super::parse;

/// Basins of a grid of 2 by 2 motions over the first two components.
fn found(text: &str, half: i64, base: &[i64], columns: &str, time: f64) -> Basins {
    let case = parse(text);
    let axis = |name: &str| StateAxis::read(&case, &format!("{name}=-{half}..{half}"), 2);
    let axes = ["x", "y"].map(|name| axis(name).unwrap_or_else(|_| panic!("an axis {name}")));
    let base: Vec<Rational> = base.iter().map(|x| Rational::from(*x)).collect();
    let columns = Columns::read(Lexicon::new(&case), columns).expect("columns");
    let request =
        BasinRequest { axes: &axes, base: &base, fixed: &[], columns: &columns, time, seed: 1 };
    basins(&case, &request, 1, &|_| ()).expect("basins")
}

#[test]
fn chaos_is_settled_whatever_its_samples_do() {
    let lorenz = "title = 'Lorenz'\n[state]\nx = '-9..9'\ny = '-9..9'\nz = '0..9'\n[field]\n\
        \"x'\" = '10*(y - x)'\n\"y'\" = '28*x - y - x*z'\n\"z'\" = 'x*y - 8/3*z'\n";
    for time in [60.0, 110.0, 150.0] {
        let all = found(lorenz, 20, &[0, 0, 20], "x, y, z", time);
        assert_eq!(all.attractors.len(), 1, "{time}: {:?}", all.ends);
        assert_eq!(all.attractors[0].count, 4, "{time}: {:?}", all.ends);
        assert!(!all.attractors[0].is_point, "{time}");
    }
}

#[test]
fn a_small_cycle_after_a_large_transient_is_no_point() {
    let cycle = "title = 'a cycle'\n[state]\nx = '-2..2'\ny = '-2..2'\n[let]\nR = 'sqrt(x^2+y^2)'\n\
        e = '1/10000'\n[field]\n\"x'\" = '-y - x/100*(R-e)/(R+e)'\n\
        \"y'\" = 'x - y/100*(R-e)/(R+e)'\n";
    // an oscillator with damping, driven weakly by another
    let driven = "title = 'driven'\n[state]\nx = '-2..2'\ny = '-2..2'\nu = '-2..2'\nv = '-2..2'\n\
        [field]\n\"x'\" = 'y'\n\"y'\" = '-2*x - y/50 + u/10000'\n\
        \"u'\" = 'v + u*(1-u^2-v^2)'\n\"v'\" = '-u + v*(1-u^2-v^2)'\n";
    for (text, base) in [(cycle, &[0, 0][..]), (driven, &[0, 0, 1, 0])] {
        for time in [700.0, 900.0] {
            let all = found(text, 2, base, "x, y", time);
            let [set] = &all.attractors[..] else { panic!("{time}: {:?}", all.ends) };
            assert!(set.count == 4 && !set.is_point, "{time}: {set:?}");
            let [low, high] = set.ranges[0];
            assert!(low < -9e-5 && low > -2e-4 && high > 9e-5 && high < 2e-4, "{set:?}");
        }
    }
    let damped = driven.replace(" + u/10000", "");
    let all = found(&damped, 2, &[0, 0, 1, 0], "x, y", 700.0);
    assert!(all.attractors.iter().all(|set| set.is_point), "{:?}", all.attractors);
}

#[test]
fn motions_that_run_away_do_not_make_a_cycle_a_point() {
    // x grows like e^t beyond 1, and falls to 0 below
    let runaway = "title = 'a'\n[state]\nx = '-3..3'\ny = '-3..3'\nu = '-3..3'\n[field]\n\
        \"x'\" = 'x*tanh(x - 1)'\n\"y'\" = 'u'\n\"u'\" = '(1 - y^2)*u - y'\n";
    let all = found(runaway, 5, &[0, 0, 1], "x, y, u", 200.0);
    let [set] = &all.attractors[..] else { panic!("{:?}", all.ends) };
    assert!(set.count == 2 && !set.is_point, "{set:?}: {:?}", all.ends);
    assert!(set.ranges[1][0] < -1.9 && set.ranges[1][1] > 1.9, "{set:?}");
}
