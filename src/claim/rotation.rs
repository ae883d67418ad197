//! Rests and permanent rotations of a spinning body near which no density exists, found by Newton's
//! method and enclosed.
//!
//! At ω = Ωγ the normal is at rest, and K, the moment about the contact, is orthogonal to γ. Where
//! K = 0 the body turns steadily, with div v = ΩC₁(γ): a density that is continuous near it and
//! positive at it needs C₁(γ) = 0. For Ω = 0 and without a rotor, a positive C¹ density does.

use nalgebra::Vector3;
use num_dual::Dual;

use crate::graph::{Evaluator, Expr, Tape, record};
use crate::level::Newton;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{DrawSource, Model, Phase};
use crate::number::Domain;
use crate::number::ball::{Ball, Balls};
use crate::scalar::Scalar;

/// Number of bodies of the case that are tried, and the seed by which `eval` draws them too.
const BODIES: u64 = 4;
const SEED: u64 = 1;

/// Angular velocities that are tried; 0 is a rest.
const SPEEDS: [f64; 7] = [0.0, 1.0, -1.0, 3.0, -3.0, 8.0, 20.0];

/// Starts of Newton's method, by the stereographic coordinates of γ.
const STARTS: [[f64; 2]; 8] = [
    [0.1, 0.2],
    [-0.6, 0.5],
    [0.7, 0.6],
    [0.4, -0.8],
    [-0.5, -0.7],
    [1.6, -0.9],
    [-1.3, 1.8],
    [2.4, 2.1],
];

/// A motion near which no density exists.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Steady {
    /// Number of the state whose parameters the body has.
    pub body: u64,
    /// Angular velocity Ω about the normal.
    pub speed: f64,
    /// Normal γ, to some digits.
    pub normal: [f64; 3],
    /// Condition C₁ there, with a bound on its error.
    pub along: (f64, f64),
}

/// Where the motion is looked for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Among {
    Rests,
    Rotations,
}

/// The equations K = 0 and what is asked at their solutions.
struct Sought {
    /// Two components of K = 0 for each component of γ that is not 0.
    equations: [Newton; 3],
    /// γ, C₁, div v and the field, as functions of parameters, Ω and the coordinates of γ.
    tape: Tape,
}

/// Returns the point of the sphere with the stereographic coordinates u, v.
fn normal<T: Scalar>([u, v]: [T; 2]) -> Vector3<T> {
    let square = u * u + v * v;
    let (one, two) = (T::one(), T::from(2.0));
    Vector3::new(two * u, two * v, one - square).map(|x| x / (one + square))
}

impl Sought {
    fn new(model: &Model, draws: usize) -> Option<Self> {
        let (graph, outputs) = record(draws + 3, |inputs| {
            let (inputs, place) = inputs.split_at(draws);
            let (free, _) = model.make_parameters(inputs);
            let &[speed, u, v] = place else { return None };
            let gamma = normal([u, v]);
            let along = [[1.0, 0.0], [0.0, 1.0]].map(|[du, dv]| {
                let lifted = [Dual::new(u, Expr::from(du)), Dual::new(v, Expr::from(dv))];
                normal(lifted).map(|x| x.eps)
            });
            let state = |gamma: &Vector3<Expr>| -> Vec<Expr> {
                (gamma * speed).iter().chain(gamma).copied().collect()
            };
            let jet = DualPoint::new(Phase::new(model, &free, &state(&gamma)));
            let moment = model.system.turning_moment(&jet.phase)?;
            let [by_u, by_v] = along.map(|axis| {
                let moved = model.system.turning_moment(&jet.phase.lift(&state(&axis)));
                moved.map(|moment| moment.map(|x| x.eps))
            });
            let criterion = model.system.criterion(&jet.phase).first().copied()?;
            let divergence = jet.divergence() - jet.level_cofactor(&[true]);
            let mut asked: Vec<Expr> = gamma.iter().copied().collect();
            asked.extend([criterion, divergence]);
            asked.extend(jet.phase.field());
            Some((moment, by_u?, by_v?, asked))
        })
        .ok()?;
        let (moment, by_u, by_v, asked) = outputs?;
        let equations = [[1, 2], [2, 0], [0, 1]].map(|[i, j]| {
            let slopes = [by_u[i], by_v[i], by_u[j], by_v[j]];
            Newton::of(&graph, &[moment[i], moment[j]], &slopes, draws + 1)
        });
        Some(Self { equations, tape: Tape::new(&graph, &asked) })
    }

    /// Encloses a solution near the start; returns γ and C₁ if it excludes densities.
    fn at(&self, parameters: &[Balls<1>], start: [f64; 2]) -> Option<([f64; 3], (f64, f64))> {
        let gamma: [f64; 3] = normal(start).into();
        let size = |k: &usize| gamma[*k].abs();
        let largest = [0, 1, 2].into_iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
        let place = self.equations[largest].enclose(parameters, &start)?;
        let mut evaluator = Evaluator::new(&self.tape, Ball::<1>);
        let inputs: Vec<Balls<1>> = parameters.iter().chain(&place).cloned().collect();
        evaluator.run(&inputs);
        let found: Vec<&Balls<1>> = evaluator.outputs().collect();
        let [g1, g2, g3, along, divergence, ..] = found.as_slice() else { return None };
        let is_defined = found.iter().all(|ball| ball.is_defined(0));
        let is_rest = parameters.last().is_some_and(|speed| speed.mid[0] == 0.0);
        let changes = along.excludes_zero(0) && (is_rest || divergence.excludes_zero(0));
        // K is orthogonal to γ: its third component is 0 with the other two.
        let is_steady = found[largest].excludes_zero(0);
        (is_defined && changes && is_steady)
            .then(|| ([g1.mid[0], g2.mid[0], g3.mid[0]], (along.mid[0], along.rad[0])))
    }
}

/// Finds a rest or a permanent rotation, of a body of the case, that excludes densities.
pub(super) fn without_density(model: &Model, among: Among) -> Option<Steady> {
    if !model.system.rest_excludes_densities() || !model.extension.is_empty() {
        return None;
    }
    let draws = model.parameter_draws();
    let sought = Sought::new(model, draws.len())?;
    let numbers = DrawSource::new(&draws);
    let has_rotor = model.system.gyrostat().is_some();
    let is_tried = |speed: &f64| match *speed == 0.0 {
        true => among == Among::Rests && !has_rotor,
        false => among == Among::Rotations,
    };
    (0..BODIES).find_map(|body| {
        let values = numbers.state(SEED, body);
        let free: Vec<Balls<1>> =
            values.iter().map(|x| Ball.values(std::slice::from_ref(x))).collect();
        SPEEDS.into_iter().filter(is_tried).find_map(|speed| {
            let parameters = [&free[..], &[Balls::new([speed], [0.0])]].concat();
            STARTS.into_iter().find_map(|start| {
                let (normal, along) = sought.at(&parameters, start)?;
                Some(Steady { body, speed, normal, along })
            })
        })
    })
}

impl std::fmt::Display for Steady {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [a, b, c] = self.normal;
        match self.speed {
            0.0 => write!(f, "rest")?,
            1.0 => write!(f, "permanent rotation ω = γ")?,
            -1.0 => write!(f, "permanent rotation ω = −γ")?,
            speed => write!(f, "permanent rotation ω = {speed}γ")?,
        }
        let (value, error) = self.along;
        write!(f, " at γ ≈ [{a:.6}, {b:.6}, {c:.6}] of the body of state {}", self.body)?;
        write!(f, ", where C₁ = {value:.3e} ± {error:.1e}")
    }
}
