//! Functions that a motion conserves: level functions, the energy, further integrals.

use super::enclosure::Enclosure;
use super::motion::Boxed;
use super::sharp;
use crate::error::FlowError;
use crate::motion::filled;
use liouville::formula::Formula;
use liouville::graph::{Evaluator, Tape, record};
use liouville::mechanics::calculus::Jet;
use liouville::mechanics::{Model, Phase};
use liouville::number::ball::Ball;
use liouville::number::rational::Rational;
use liouville::number::twofold::{TwofoldBall, Twofolds};

/// Functions with their gradients, recorded.
pub struct Functions {
    tape: Tape,
    /// Indices of those that are used.
    used: Vec<usize>,
    count: usize,
    /// Number of level functions, which come first.
    pub of_level: usize,
}

/// Sine of the angle below which a gradient counts as dependent on those before it.
const DEPENDENT: f64 = 1e-6;

impl Functions {
    /// Records the level functions of a model, the energy where asked, and integrals.
    pub fn new(
        model: &Model,
        parameters: &[Rational],
        energy: bool,
        integrals: &[&Formula],
    ) -> Result<Self, FlowError> {
        let kept = vec![true; model.level.len()];
        let (graph, (values, gradients)) = record(model.dimension(), |state| {
            let jet = Jet::new(Phase::new(model, &filled(parameters, &[], &[]), state));
            let level = model.level.iter();
            let mut values: Vec<_> =
                level.map(|equation| jet.phase.level_function(&equation.function)).collect();
            let mut gradients = jet.level_gradients(&kept);
            if energy && let Some(gradient) = jet.energy_gradient() {
                values.extend(model.system.energy(&jet.phase));
                gradients.push(gradient.clone());
            }
            for formula in integrals {
                values.extend(jet.phase.evaluate(formula).components());
                gradients.extend(jet.gradients(formula));
            }
            (values, gradients)
        })?;
        let count = values.len();
        let tape = Tape::new(&graph, &[values, gradients.concat()].concat());
        let used = (0..count).collect();
        Ok(Self { tape, used, count, of_level: model.level.len() })
    }

    /// Number of functions in use.
    pub fn len(&self) -> usize {
        self.used.len()
    }

    /// Whether the function of this index is in use.
    pub fn uses(&self, index: usize) -> bool {
        self.used.contains(&index)
    }

    /// Number of level functions in use.
    pub fn of_level_in_use(&self) -> usize {
        self.used.iter().filter(|index| **index < self.of_level).count()
    }

    /// Leaves out functions whose gradients depend on those before at a state, and returns the
    /// values of all others there.
    pub fn choose(&mut self, state: &[f64]) -> Vec<f64> {
        let at: Boxed = state.iter().map(|x| Enclosure::exact(*x)).collect();
        let (values, gradients) = self.at(&at);
        let mut units: Vec<Vec<f64>> = Vec::new();
        let mut chosen = Vec::new();
        for (index, gradient) in gradients.iter().enumerate() {
            let gradient: Vec<f64> = gradient.iter().map(|x| x.mid).collect();
            let rest = across(&gradient, &units);
            let (length, size) = (norm(&rest), norm(&gradient));
            if length > DEPENDENT * size {
                units.push(rest.iter().map(|x| x / length).collect());
                chosen.push(index);
            }
        }
        let kept = chosen.iter().map(|index| values[*index].mid).collect();
        self.used = chosen.into_iter().map(|index| self.used[index]).collect();
        kept
    }

    /// Encloses the values and the gradients over a box.
    pub fn at(&self, state: &[Enclosure]) -> (Vec<Enclosure>, Vec<Boxed>) {
        let mut evaluator = Evaluator::new(&self.tape, Ball::<1>);
        evaluator.run(&state.iter().map(|x| x.block()).collect::<Vec<_>>());
        let all: Vec<Enclosure> = evaluator.outputs().map(Enclosure::first).collect();
        let (values, gradients) = all.split_at(self.count);
        let gradient = |index: &usize| gradients[index * state.len()..][..state.len()].to_vec();
        let values = self.used.iter().map(|index| values[*index]).collect();
        (values, self.used.iter().map(gradient).collect())
    }

    /// Encloses the values at a state less other numbers, in double-double.
    pub fn sharp(&self, state: &[f64], less: &[Rational]) -> Vec<Enclosure> {
        let mut evaluator = Evaluator::new(&self.tape, TwofoldBall::<1>);
        let exact = |x: &f64| Twofolds { hi: [*x], lo: [0.0], rad: [0.0] };
        evaluator.run(&state.iter().map(exact).collect::<Vec<_>>());
        let values = self.used.iter().map(|index| evaluator.output(*index));
        values.zip(less).map(|(value, less)| sharp::difference(value, less)).collect()
    }

    /// Orthonormal basis of the directions along which no function changes, at a state.
    pub fn complement(&self, state: &[f64]) -> Vec<Vec<f64>> {
        let at: Boxed = state.iter().map(|x| Enclosure::exact(*x)).collect();
        let mut units: Vec<Vec<f64>> = Vec::new();
        for gradient in self.at(&at).1 {
            let gradient: Vec<f64> = gradient.iter().map(|x| x.mid).collect();
            units.push(normalised(&across(&gradient, &units)));
        }
        while units.len() < state.len() {
            let axis = |k: usize| -> Vec<f64> {
                (0..state.len()).map(|j| if j == k { 1.0 } else { 0.0 }).collect()
            };
            let rests = (0..state.len()).map(|k| across(&axis(k), &units));
            let longest = rests.max_by(|a, b| norm(a).total_cmp(&norm(b)));
            units.extend(longest.map(|rest| normalised(&rest)));
        }
        units.split_off(self.len())
    }
}

/// Length of a vector.
pub fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn normalised(x: &[f64]) -> Vec<f64> {
    let length = norm(x);
    x.iter().map(|x| x / length).collect()
}

/// Component orthogonal to unit vectors; two passes are enough against rounding.
fn across(vector: &[f64], units: &[Vec<f64>]) -> Vec<f64> {
    let mut rest = vector.to_vec();
    for unit in units.iter().chain(units) {
        let along: f64 = rest.iter().zip(unit).map(|(x, y)| x * y).sum();
        rest.iter_mut().zip(unit).for_each(|(x, y)| *x -= along * y);
    }
    rest
}
