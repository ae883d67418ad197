//! Basins and classes in the plane: a limit cycle is one attractor, and no chaos.

use liouville::case::Case;
use liouville::number::rational::Rational;
use liouville_flow::{
    BasinRequest, Basins, Character, Columns, Destiny, Lexicon, StateAxis, basins,
};

use crate::integration::parse;

fn found(case: &Case, [x, y]: [&str; 2], count: usize, time: f64) -> Basins {
    let axis = |text: &str| StateAxis::read(case, text, count).expect("an axis");
    let columns = Columns::read(Lexicon::new(case), "x, y").expect("columns");
    let base = [1, 1].map(Rational::from);
    let request = BasinRequest {
        axes: &[axis(x), axis(y)],
        base: &base,
        fixed: &[],
        columns: &columns,
        time,
        seed: 1,
    };
    basins(case, &request, 2, &|_| ()).expect("basins")
}

#[test]
fn a_limit_cycle_of_the_plane_is_one_attractor() {
    let van_der_pol = |mu: u32| ["y".to_string(), format!("{mu}*(1 - x^2)*y - x")];
    let ring =
        |k: u32| [format!("y - {k}*x*(x^2 + y^2 - 1)"), format!("-x - {k}*y*(x^2 + y^2 - 1)")];
    let stuart_landau =
        ["x - 10*y - x*(x^2 + y^2)".to_string(), "10*x + y - y*(x^2 + y^2)".to_string()];
    let predator =
        ["x*(1 - x/3) - x*y/(1 + x)".to_string(), "-y/4 + 3*x*y/(5*(1 + x))".to_string()];
    let wide = ["x=-3..3", "y=-3..3"];
    for (rates, axes, time) in [
        (van_der_pol(1), wide, 1000.0),
        (van_der_pol(3), wide, 1000.0),
        (ring(1), wide, 1000.0),
        (ring(10), wide, 400.0),
        (ring(10), wide, 1000.0),
        (stuart_landau, ["x=-2..2", "y=-2..2"], 400.0),
        (predator, ["x=0.1..3", "y=0.1..3"], 400.0),
    ] {
        let case = parse(&format!(
            "title = 'a'\n[state]\nx = '-5..5'\ny = '-5..5'\n[field]\n\"x'\" = '{}'\n\"y'\" = '{}'\n",
            rates[0], rates[1]
        ));
        let found = found(&case, axes, 4, time);
        let [one] = &found.attractors[..] else {
            panic!("{rates:?}, {time}: {} attractors", found.attractors.len())
        };
        assert_eq!(one.count, 16, "{rates:?}, {time}: {:?}", found.ends);
        assert!(!one.is_point, "{rates:?}, {time}: no point");
        let class = one.exponents.as_ref().expect("exponents").character;
        assert_eq!(class, Character::Regular, "{rates:?}, {time}");
    }
}

#[test]
fn a_weak_focus_is_no_cycle() {
    for friction in ["y^3", "y*abs(y)/2"] {
        let case = parse(&format!(
            "title = 'a'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-x - {friction}'\n"
        ));
        let found = found(&case, ["x=-2..2", "y=-2..2"], 2, 400.0);
        assert!(found.attractors.is_empty(), "{friction}: {:?}", found.attractors);
        let is_open = |end: &Destiny| *end == Destiny::Unsettled;
        assert!(found.ends.iter().all(is_open), "{friction}: {:?}", found.ends);
    }
}
