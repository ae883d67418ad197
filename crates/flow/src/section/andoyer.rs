//! Andoyer-like variables (1.17) of Bizyaev, Borisov, Mamaev (2013), and the sections g = g₀.
//!
//! ```text
//! ω = (√(G² - L²) sin l, √(G² - L²) cos l, L)
//! γ = ((L/G) cos g sin l + sin g cos l, (L/G) cos g cos l - sin g sin l, -√(1 - L²/G²) cos g)
//! ```
//!
//! With s = √(G² - L²): s sin(g - g₀) = cos g₀ (γ×ω)₃ + sin g₀ |ω| γ₃, and
//! s cos(g - g₀) = sin g₀ (γ×ω)₃ - cos g₀ |ω| γ₃. The first vanishes on the section, where the second
//! is positive; both are smooth, and without square roots where g₀ is a multiple of π/2.

use num_dual::DualNum;

use crate::error::FlowError;
use crate::motion::recorded::{Loose, filled};
use crate::motion::start::Start;
use liouville::case::Angle;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::{Model, Phase, System};
use liouville::number::double_double::{DoubleDouble, DoubleDoubles};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Dimension of the state: ω and γ, and nothing else.
const DIMENSION: usize = 6;

/// Whether these variables are defined for the model.
pub fn applies(model: &Model) -> bool {
    matches!(model.system, System::Rubber(_)) && model.dimension() == DIMENSION
}

/// cos and sin of an angle.
fn circular<T: Scalar>(angle: &Angle) -> (T, T) {
    match angle {
        Angle::QuarterTurns(n) => {
            let value = |k: u32| T::rational(&Rational::from([1, 0, -1, 0][k as usize % 4]));
            (value(*n), value(n + 3))
        }
        Angle::Radians(value) => {
            let value = T::rational(value);
            (value.cos(), value.sin())
        }
    }
}

/// Returns s sin(g - g₀) and s cos(g - g₀).
pub fn section_functions<T: Scalar>(phase: &Phase<'_, T>, g0: &Angle) -> [T; 2] {
    let state = phase.state();
    let [w1, w2, w3, y1, y2, y3] = [0, 1, 2, 3, 4, 5].map(|k| state[k]);
    let (cos, sin): (T, T) = circular(g0);
    let across = y1 * w2 - y2 * w1;
    // A quarter turn needs only one of the terms, and then |ω| > 0 is a mere factor.
    let along = match g0 {
        Angle::QuarterTurns(_) => y3,
        Angle::Radians(_) => (w1 * w1 + w2 * w2 + w3 * w3).sqrt() * y3,
    };
    [cos * across + sin * along, sin * across - cos * along]
}

/// Returns g' on the section, from the rate of the section function.
pub fn rate(g0: &Angle, state: &[DoubleDouble], slope: f64) -> f64 {
    let [x, y, z] = [state[0].hi, state[1].hi, state[2].hi];
    let s = libm::hypot(x, y);
    match g0 {
        // The function is s/|ω| sin(g - g₀).
        Angle::QuarterTurns(n) if n % 2 == 1 => slope * libm::hypot(s, z) / s,
        _ => slope / s,
    }
}

/// Returns (l, L/G) of a state, with l in [0, 2π).
pub fn coordinates(state: &[DoubleDouble]) -> [f64; 2] {
    let [x, y, z] = [state[0].hi, state[1].hi, state[2].hi];
    let l = libm::atan2(x, y);
    let turn = 2.0 * std::f64::consts::PI;
    let length = libm::sqrt(x * x + y * y + z * z);
    [if l < 0.0 { (l + turn).min(turn.next_down()) } else { l }, z / length]
}

/// Displacement in (l, L/G) from one state to a nearby one, to the relative accuracy of f64.
pub fn displacement(from: &[DoubleDouble], to: &[DoubleDouble]) -> [f64; 2] {
    let length = |x: &[DoubleDouble]| (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
    let (a, b) = (length(from).recip(), length(to).recip());
    let along = from[0] * to[0] + from[1] * to[1];
    let turned = to[0] * from[1] - to[1] * from[0];
    [libm::atan2(turned.hi, along.hi), (to[2] * b - from[2] * a).hi]
}

/// States of the section as functions of l, L/G, the energy, and the loose parameters.
pub(crate) struct Sphere {
    tape: Tape,
}

impl Sphere {
    /// Records the states of a model with g = g₀.
    pub fn new(
        model: &Model,
        parameters: &[Rational],
        loose: &[Loose],
        g0: &Angle,
    ) -> Result<Self, FlowError> {
        if !applies(model) {
            return Err(FlowError::NoAndoyer);
        }
        let (graph, outputs) = record(3 + loose.len(), |inputs| {
            let (l, z, energy) = (inputs[0], inputs[1], inputs[2]);
            let parameters = filled(parameters, loose, &inputs[3..]);
            let (cos, sin): (Expr, Expr) = circular(g0);
            let s = (Expr::rational(&Rational::from(1)) - z * z).sqrt();
            let direction = [s * l.sin(), s * l.cos(), z];
            let gamma =
                [z * cos * l.sin() + sin * l.cos(), z * cos * l.cos() - sin * l.sin(), -(s * cos)];
            let energy_at = |omega: [Expr; 3]| {
                let state = [omega, gamma].concat();
                model.system.energy(&Phase::new(model, &parameters, &state))
            };
            let zero = Expr::rational(&Rational::from(0));
            let potential = energy_at([zero; 3]).unwrap_or(zero);
            let kinetic = energy_at(direction).unwrap_or(zero) - potential;
            // E = G² T(e) + U
            let square = (energy - potential) / kinetic;
            let length = square.sqrt();
            let mut outputs = vec![square, potential];
            outputs.extend(direction.map(|x| x * length));
            outputs.extend(gamma);
            outputs
        })?;
        Ok(Self { tape: Tape::new(&graph, &outputs) })
    }

    /// Returns the state over (l, L/G), on the level set up to the rounding of pairs.
    pub fn state(
        &self,
        at: [DoubleDouble; 2],
        energy: DoubleDouble,
        loose: &[DoubleDouble],
    ) -> Result<Vec<DoubleDouble>, FlowError> {
        let [l, z] = at.map(|x| x.hi);
        if !l.is_finite() || z.abs() >= 1.0 || z.is_nan() {
            return Err(FlowError::OffSphere { l, z });
        }
        let mut inputs = vec![at[0], at[1], energy];
        inputs.extend(loose);
        let mut evaluator = Evaluator::new(&self.tape, DoubleDoubles);
        evaluator.run(&inputs);
        let outputs: Vec<DoubleDouble> = evaluator.outputs().copied().collect();
        if outputs[0].hi.is_nan() || outputs[0].hi <= 0.0 {
            return Err(FlowError::BelowPotential {
                l,
                z,
                potential: outputs[1].hi,
                energy: energy.hi,
            });
        }
        Ok(outputs[2..].to_vec())
    }
}

/// States of the section at a given energy.
pub struct SectionChart<'m> {
    /// Model that the states belong to.
    pub model: &'m Model,
    parameters: Vec<Rational>,
    sphere: Sphere,
    energy: DoubleDouble,
}

impl<'m> SectionChart<'m> {
    /// Prepares the states with g = g₀ and this energy.
    pub fn new(
        model: &'m Model,
        parameters: &[Rational],
        g0: &Angle,
        energy: &Rational,
    ) -> Result<Self, FlowError> {
        let sphere = Sphere::new(model, parameters, &[], g0)?;
        let (parameters, energy) = (parameters.to_vec(), DoubleDouble::from_rational(energy));
        Ok(Self { model, parameters, sphere, energy })
    }

    /// Returns the state over (l, L/G).
    pub fn start(&self, at: [f64; 2]) -> Result<Start, FlowError> {
        self.start_at(at.map(DoubleDouble::from_f64))
    }

    /// Returns the state over a point given in double-double.
    pub fn start_at(&self, at: [DoubleDouble; 2]) -> Result<Start, FlowError> {
        let state = self.sphere.state(at, self.energy, &[])?;
        Start::near(self.model, self.parameters.clone(), state)
    }
}

/// Spreads `count` points evenly over the sphere, along a spiral with the golden angle.
pub fn spread(count: usize) -> Vec<[f64; 2]> {
    let turn = 2.0 * std::f64::consts::PI;
    let golden = (3.0 - 5f64.sqrt()) / 2.0;
    (0..count)
        .map(|k| {
            let share = (k as f64 + 0.5) / count as f64;
            [turn * (golden * (k as f64 + 0.5)).fract(), 1.0 - 2.0 * share]
        })
        .collect()
}
