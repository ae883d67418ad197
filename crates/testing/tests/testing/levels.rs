//! Levels of the user's own: densities on them, and charts that are none.

use liouville::scalar::Scalar;
use liouville_testing::{AssertionFailure, Level, On, VectorField};
use liouville_testing::{field, quantity};

/// The unit circle.
#[derive(Clone, Copy, Debug)]
struct Circle;

impl Level<1, 2> for Circle {
    fn point<T: Scalar>(&self, [u]: [T; 1]) -> [T; 2] {
        let below = (u * u + 1.0).recip();
        [u * 2.0 * below, (-(u * u) + 1.0) * below]
    }

    fn functions<T: Scalar>(&self, [x, y]: [T; 2]) -> Vec<T> {
        vec![x * x + y * y - 1.0]
    }
}

#[test]
fn densities_on_a_level_take_its_cofactor() {
    // x' = y + x(1 - r²), y' = -x + y(1 - r²): a limit cycle, on which div v = -2 = d(L_vF)(n).
    let cycle = field!(|x: [_; 2]| {
        let [x, y] = x;
        let rest = -(x * x + y * y) + 1.0;
        [y + x * rest, -x + y * rest]
    });
    let one = quantity!(|x: [_; 2]| (x[0] - x[0]).exp());
    let on = On { level: Circle, coordinates: [0.375] };
    cycle.has_density(&one).prove(&on).expect("uniform on the circle");
    assert!(cycle.has_density(&one).at(&[0.5, 0.25]).is_err(), "but not in the plane");
    let wrong = quantity!(|x: [_; 2]| x[0] + 2.0);
    assert!(cycle.has_density(&wrong).at(&on).is_err(), "nor is another density invariant");
    let radial = field!(|x: [_; 2]| x);
    let failure = cycle.commutes_with(&radial).at(&on).expect_err("not tangent");
    assert!(failure.is_refutation(), "{failure}");
}

#[test]
fn what_has_no_meaning_is_no_success() {
    let on = On { level: Circle, coordinates: [0.375] };
    let one = quantity!(|x: [_; 2]| (x[0] - x[0]).exp());
    let leaves = field!(|x: [_; 2]| x);
    let failure = leaves.conserves(&one).at(&on).expect_err("it leaves the circle");
    assert!(matches!(failure, AssertionFailure::Premise(_)), "{failure}");
    assert!(failure.to_string().contains("rate of a level function"), "{failure}");

    struct Ellipse;
    impl Level<1, 2> for Ellipse {
        fn point<T: Scalar>(&self, u: [T; 1]) -> [T; 2] {
            let [x, y] = Circle.point(u);
            [x * 2.0, y]
        }
        fn functions<T: Scalar>(&self, x: [T; 2]) -> Vec<T> {
            Circle.functions(x)
        }
    }
    let turns = field!(|x: [_; 2]| [x[1], -x[0]]);
    let off = On { level: Ellipse, coordinates: [0.375] };
    let failure = turns.conserves(&one).at(&off).expect_err("the chart is not on the level");
    assert!(failure.to_string().contains("at the point of the chart"), "{failure}");

    struct Point;
    impl Level<1, 2> for Point {
        fn point<T: Scalar>(&self, _: [T; 1]) -> [T; 2] {
            [T::zero(), T::one()]
        }
        fn functions<T: Scalar>(&self, x: [T; 2]) -> Vec<T> {
            Circle.functions(x)
        }
    }
    let single = On { level: Point, coordinates: [0.375] };
    let failure = turns.conserves(&one).prove(&single).expect_err("one point is no circle");
    assert!(matches!(failure, AssertionFailure::Chart(_)), "{failure}");

    let magnitude = quantity!(|x: [_; 2]| num_traits::Signed::abs(&x[0]));
    let failure = turns.conserves(&magnitude).at(&on).expect_err("no magnitude");
    assert!(matches!(failure, AssertionFailure::Recording(_)), "{failure}");
    let failure = turns.conserves(&one).at(&[f64::NAN, 1.0]).expect_err("no number");
    assert!(matches!(failure, AssertionFailure::Undefined { .. }), "{failure}");
}
