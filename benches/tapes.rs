//! What a state costs: a recorded tape in f64 and in balls, and the way there.
//!
//! The work items: W1 L_vF₂ of the unbalanced ball on a plane, W2 Liouville's equation for the
//! ellipsoid with I = mB + μE, W3 the criterion of a general ellipsoid. Times are per 64 states;
//! only ratios within one run mean anything.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use liouville::case::Case;
use liouville::claim::Place;
use liouville::graph::{Evaluator, Tape, record};
use liouville::mechanics::Phase;
use liouville::mechanics::calculus::Jet;
use liouville::number::ball::Ball;
use liouville::number::float::Float;
use liouville::verdict::{LANES, Options, Sampler, judge};
use nalgebra::{Matrix3, Vector3};
use num_dual::{Dual64, DualNum};

struct Item {
    name: &'static str,
    text: &'static str,
}

const ITEMS: [Item; 3] = [
    Item {
        name: "W1",
        text: "title = 'W1'\nsystem = 'rubber-plane'\n[parameters]\nm = 1.3\nR = 3\nc = [0.7, -0.4, 1.1]\n\
               I = [2.6, 1.2, 1.8]\n[body]\nshape = 'ball'\n[[claim]]\n\
               integral = '|Ĩ*ω × γ|² − 2*m*R*(γ,c)*(Ĩ*ω,ω)'\n",
    },
    Item {
        name: "W2",
        text: "title = 'W2'\nsystem = 'rubber-plane'\n[parameters]\nm = 1.3\nmu = 2\nB = [1, 2, 3.5]\n\
               I = 'm*B + mu*E'\n[body]\nshape = 'ellipsoid'\n[[claim]]\n\
               density = '(γ,adj(Ĩ)*γ)'\n",
    },
    Item {
        name: "W3",
        text: "title = 'W3'\nsystem = 'rubber-plane'\n[parameters]\nm = 1.3\nB = [1, 2, 3.5]\n\
               I = [2.6, 1.2, 1.8]\n[body]\nshape = 'ellipsoid'\n[[claim]]\n\
               analytic-density = 'exists'\nexpect = 'fails'\n",
    },
];

fn tapes(criterion: &mut Criterion) {
    for item in &ITEMS {
        let case = Case::parse(item.text, &[]).expect("the work item is a case");
        let level = Place::level(&case.model);
        let record_residual = || {
            record(case.model.dimension(), |state| {
                let jet = Jet::new(Phase::new(&case.model, &[], state));
                case.claims[0].kind.residual(&jet, &level.kept)
            })
            .expect("records")
        };
        let (graph, residual) = record_residual();
        let tape = Tape::new(&graph, &residual);
        let sampler = Sampler::new(&case, &level, 1).expect("samples");
        let balls = sampler.balls(0);
        let floats: Vec<[f64; LANES]> = balls.iter().map(|block| block.mid).collect();
        let mut group = criterion.benchmark_group(item.name);
        println!("{}: {} operations a state", item.name, tape.operations());
        group.bench_function("tape, f64", |bench| {
            let mut evaluator = Evaluator::new(&tape, Float::<LANES>);
            bench.iter(|| evaluator.run(black_box(&floats)));
        });
        group.bench_function("tape, balls", |bench| {
            let mut evaluator = Evaluator::new(&tape, Ball::<LANES>);
            bench.iter(|| evaluator.run(black_box(&balls)));
        });
        group.bench_function("the same definitions at f64, one state at a time", |bench| {
            bench.iter(|| {
                (0..LANES).map(|lane| direct(&case, black_box(&floats), lane)).sum::<f64>()
            });
        });
        if item.name == "W1" {
            group.bench_function("num-dual, plain code, one state at a time", |bench| {
                bench.iter(|| {
                    (0..LANES).map(|lane| plain_w1(black_box(&floats), lane)).sum::<f64>()
                });
            });
        }
        group.bench_function("record and lay out", |bench| {
            bench.iter(|| {
                let (graph, residual) = record_residual();
                Tape::new(&graph, &residual).operations()
            });
        });
        group.bench_function("judge, 256 states", |bench| {
            bench.iter(|| judge(&case, &Options::default()).expect("judged"));
        });
        group.finish();
    }
}

/// The same residual by the same definitions, over num-dual's numbers at f64.
fn direct(case: &Case, floats: &[[f64; LANES]], lane: usize) -> f64 {
    let state: Vec<f64> = floats.iter().map(|block| block[lane]).collect();
    let jet = Jet::new(Phase::new(&case.model, &[], &state));
    match &case.claims[0].kind {
        liouville::claim::Kind::Integral(formula) => jet.lie_derivative(|at| at.scalar(formula)),
        liouville::claim::Kind::Density(formula) => {
            let moved = jet.along_field();
            let along = formula.logarithmic_derivative(&mut |symbol| moved.value(symbol));
            along + jet.divergence()
        }
        _ => case.model.system.criterion(&jet.phase).unwrap_or(f64::NAN),
    }
}

/// W1 as one would write it by hand with num-dual: v at f64, then F₂ at `Dual64` along v.
fn plain_w1(floats: &[[f64; LANES]], lane: usize) -> f64 {
    let x: [f64; 6] = std::array::from_fn(|k| floats[k][lane]);
    let (omega, gamma) = (Vector3::new(x[0], x[1], x[2]), Vector3::new(x[3], x[4], x[5]));
    let rate = gamma.cross(&omega);
    let (mass, radius) = (1.3, 3.0);
    let (r, slide) = (contact(&gamma, radius), rate * -radius);
    let inertia = inertia_at(&r, mass);
    let torque = (inertia * omega).cross(&omega) - r.cross(&omega.cross(&slide)) * mass;
    let Some(inverse) = inertia.try_inverse() else { return f64::NAN };
    let along = inverse * gamma;
    let acceleration = inverse * (torque - gamma * (torque.dot(&along) / gamma.dot(&along)));
    let lift = |x: &Vector3<f64>, dx: &Vector3<f64>| x.zip_map(dx, Dual64::new);
    second_integral(&lift(&omega, &acceleration), &lift(&gamma, &rate), radius, mass).eps
}

fn contact<T: DualNum<Primitive = f64> + Copy>(gamma: &Vector3<T>, radius: f64) -> Vector3<T> {
    let centre = Vector3::new(0.7, -0.4, 1.1).map(T::from);
    -(gamma.map(|x| x * radius) + centre)
}

fn inertia_at<T: DualNum<Primitive = f64> + Copy>(r: &Vector3<T>, mass: f64) -> Matrix3<T> {
    let central = Vector3::new(2.6, 1.2, 1.8).map(T::from);
    let steiner = Matrix3::from_diagonal_element(r.dot(r)) - r * r.transpose();
    Matrix3::from_diagonal(&central) + steiner.map(|x| x * mass)
}

/// |Ĩω × γ|² − 2mR(γ,c)(Ĩω,ω)
fn second_integral<T: DualNum<Primitive = f64> + Copy>(
    omega: &Vector3<T>,
    gamma: &Vector3<T>,
    radius: f64,
    mass: f64,
) -> T {
    let momentum = inertia_at(&contact(gamma, radius), mass) * omega;
    let turned = momentum.cross(gamma);
    let centre = Vector3::new(0.7, -0.4, 1.1).map(T::from);
    turned.dot(&turned) - gamma.dot(&centre) * momentum.dot(omega) * (2.0 * mass * radius)
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).without_plots();
    targets = tapes
}
criterion_main!(benches);
