//! The unbalanced ball to t = 1000: `orbit` in f64 and in double-double, compared with DOP853 of
//! differential-equations on a handwritten field, and with a floor: the multiply-adds of the Cauchy
//! products alone, as contiguous dot products in the cache; single orbits and sections beside heyoka,
//! where Python has it. Only ratios within one run are significant.

#[path = "peers/hook.rs"]
mod peers;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use differential_equations::prelude::*;
use liouville::case::Case;
use liouville::number::double_double::DoubleDouble;
use liouville::verdict::read_state;
use liouville_flow::{Orbit, Precision, QuantityRole, Start, orbit};
use nalgebra::{Matrix3, Vector3};

const BALL: &str = r#"
title = "unbalanced ball"
system = "rubber-plane"
[parameters]
m = 1.3
R = 3
c = [0.7, -0.4, 1.1]
I = [2.6, 1.2, 1.8]
[body]
shape = "ball"
[[claim]]
name = "F2"
integral = "|Ĩ*ω × γ|² − 2*m*R*(γ,c)*(Ĩ*ω,ω)"
"#;
const START: &str = "ω=[0.5,0.7,-0.5] γ=[1/3,2/3,2/3]";
const TIME: f64 = 1000.0;
/// Number of products of two series in the field of the ball.
const PRODUCTS: u64 = 87;

/// The same equations written by hand, with r = -Rγ - c.
struct Ball;

impl Ball {
    fn inertia(gamma: Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let r = -gamma * 3.0 - Vector3::new(0.7, -0.4, 1.1);
        let own = Matrix3::from_diagonal(&Vector3::new(2.6, 1.2, 1.8));
        (r, own + (Matrix3::identity() * r.dot(&r) - r * r.transpose()) * 1.3)
    }

    fn energy(y: &[f64; 6]) -> f64 {
        let (omega, gamma) = (Vector3::new(y[0], y[1], y[2]), Vector3::new(y[3], y[4], y[5]));
        omega.dot(&(Self::inertia(gamma).1 * omega))
    }
}

impl ODE<f64, [f64; 6]> for Ball {
    fn diff(&self, _: f64, y: &[f64; 6], dydt: &mut [f64; 6]) {
        let (omega, gamma) = (Vector3::new(y[0], y[1], y[2]), Vector3::new(y[3], y[4], y[5]));
        let rate = gamma.cross(&omega);
        let (r, inertia) = Self::inertia(gamma);
        let forces = (inertia * omega).cross(&omega) + r.cross(&omega.cross(&rate)) * (1.3 * 3.0);
        let inverse = inertia.try_inverse().unwrap_or_default();
        let multiplier = -(inverse * gamma).dot(&forces) / (inverse * gamma).dot(&gamma);
        let acceleration = inverse * (forces + gamma * multiplier);
        dydt[..3].copy_from_slice(acceleration.as_slice());
        dydt[3..].copy_from_slice(rate.as_slice());
    }
}

fn by_hand(begin: [f64; 6], tolerance: f64) -> [f64; 6] {
    let method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance).max_steps(10_000_000);
    let problem = IVP::ode(&Ball, 0.0, TIME, begin);
    *problem.method(method).solve().expect("solved").y.last().expect("an end")
}

fn follow(case: &Case, start: &Start, time: f64, precision: Precision) -> Orbit {
    orbit(case, start.clone(), DoubleDouble::from_f64(time), precision).expect("no singularity")
}

fn motion(criterion: &mut Criterion) {
    let case = Case::parse(BALL, &[]).expect("a case");
    let state = read_state(&case, START).expect("a state");
    let start = Start::new(&case, Some(&state), 1, 0).expect("a start on the level");
    let begin: Vec<f64> = start.state.iter().map(|x| x.hi).collect();
    let begin: [f64; 6] = begin.try_into().expect("six components");

    let found = follow(&case, &start, TIME, Precision::Float);
    for followed in found.followed.iter().filter(|followed| followed.role != QuantityRole::Decoy) {
        println!("Taylor, f64: {} drifts by {:.1e}", followed.name, followed.drift);
    }
    for tolerance in [1e-12, 1e-15] {
        let change = Ball::energy(&by_hand(begin, tolerance)) / Ball::energy(&begin) - 1.0;
        println!("DOP853, tolerance {tolerance:e}: the energy drifts by {:.1e}", change.abs());
    }
    // Order n has n - 1 inner and 2 outer multiply-adds.
    let order = found.order as u64;
    let count = found.steps * PRODUCTS * order * (order + 1) / 2;
    println!("{} steps, {count} multiply-adds in Cauchy products", found.steps);

    let mut group = criterion.benchmark_group("unbalanced ball, t = 1000");
    group.bench_function("Taylor, f64", |bench| {
        bench.iter(|| follow(&case, &start, TIME, Precision::Float));
    });
    group.bench_function("Taylor, f64, what it takes to begin", |bench| {
        bench.iter(|| follow(&case, &start, 1e-3, Precision::Float));
    });
    for tolerance in [1e-12, 1e-15] {
        group.bench_function(format!("DOP853 by hand, tolerance {tolerance:e}"), |bench| {
            bench.iter(|| by_hand(black_box(begin), tolerance));
        });
    }
    group.bench_function("floor", |bench| bench.iter(|| multiply_adds(count)));
    group.bench_function("Taylor, double-double, t = 20", |bench| {
        bench.iter(|| follow(&case, &start, 20.0, Precision::Pair));
    });
    group.finish();
    for script in ["orbit.py", "section.py"] {
        peers::print(script);
    }
}

/// Runs `count` multiply-adds on two arrays that stay in the first-level cache.
fn multiply_adds(count: u64) -> f64 {
    let (x, y) = (black_box([0.5f64; 1024]), black_box([0.25f64; 1024]));
    let mut sums = [0.0; 64];
    for _ in 0..count / 1024 {
        for (x, y) in black_box(&x).chunks_exact(64).zip(y.chunks_exact(64)) {
            for k in 0..64 {
                sums[k] += x[k] * y[k];
            }
        }
    }
    sums.iter().sum()
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).without_plots();
    targets = motion
}
criterion_main!(benches);
