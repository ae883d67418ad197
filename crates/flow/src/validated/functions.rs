//! Functions that a motion conserves: level functions, the energy, further integrals.

use super::enclosure::Enclosure;
use super::laws::Laws;
use super::motion::Boxed;
use super::sharp;
use crate::error::FlowError;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::calculus::DualPoint;
use liouville::number::Domain;
use liouville::number::ball::Ball;
use liouville::number::double_double_ball::{DoubleDoubleBall, DoubleDoubleBalls};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Functions with their gradients, recorded.
pub struct Functions {
    tape: Tape,
    /// Indices of those that are used.
    used: Vec<usize>,
    count: usize,
    /// Number of level functions, which come first.
    pub of_level: usize,
    /// Dimension of the state, and number of loose parameters.
    dimension: usize,
    loose: usize,
}

/// Sine of the angle below which a gradient counts as dependent on those before it.
const DEPENDENT: f64 = 1e-6;

impl Functions {
    /// Records the level functions of a model, the energy where asked, and integrals, with their
    /// derivatives by the state and by the loose parameters.
    pub fn new(laws: &Laws<'_>) -> Result<Self, FlowError> {
        let Laws { model, energy, integrals, .. } = *laws;
        let (dimension, loose) = (model.dimension(), laws.loose.len());
        let kept = vec![true; model.level.len()];
        let (graph, (values, gradients)) = record(dimension + loose, |inputs| {
            let (state, free) = inputs.split_at(dimension);
            let jet = DualPoint::new(laws.point(state, free));
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
            let still = vec![Expr::rational(&Rational::from(0)); dimension];
            for parameter in 0..loose {
                let moved = laws.lifted(state, free, &still, parameter);
                let level = model.level.iter();
                let mut slopes: Vec<_> =
                    level.map(|equation| moved.level_function(&equation.function)).collect();
                if energy {
                    slopes.extend(model.system.energy(&moved));
                }
                let further = integrals.iter();
                slopes.extend(further.flat_map(|formula| moved.evaluate(formula).components()));
                let all = gradients.iter_mut().zip(&slopes);
                all.for_each(|(gradient, slope)| gradient.push(slope.eps));
            }
            (values, gradients)
        })?;
        let count = values.len();
        let tape = Tape::new(&graph, &[values, gradients.concat()].concat());
        let used = (0..count).collect();
        Ok(Self { tape, used, count, of_level: model.level.len(), dimension, loose })
    }

    /// Uses the functions of these indices alone. `None` unless they are some of all, in order, those
    /// of the level among them.
    pub fn using(mut self, used: &[usize]) -> Option<Self> {
        let is_sorted = used.windows(2).all(|pair| pair[0] < pair[1]);
        let is_known = used.iter().all(|index| *index < self.count);
        self.used = used.to_vec();
        (is_sorted && is_known && self.of_level_in_use() == self.of_level).then_some(self)
    }

    /// Indices of the functions in use.
    pub fn used(&self) -> &[usize] {
        &self.used
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
        let (values, gradients) = self.within(&at, Enclosure::ZERO);
        let mut units: Vec<Vec<f64>> = Vec::new();
        let mut chosen = Vec::new();
        for (index, gradient) in gradients.iter().enumerate() {
            let gradient: Vec<f64> = gradient[..self.dimension].iter().map(|x| x.mid).collect();
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

    /// Encloses the gradients over a box of states and of the loose parameters, by the state and then
    /// by the parameters.
    pub fn gradients(&self, state: &[Enclosure]) -> Vec<Boxed> {
        self.within(state, Enclosure::about(0.0, 1.0)).1
    }

    /// Encloses the gradients by the state alone.
    pub fn slopes(&self, state: &[Enclosure]) -> Vec<Boxed> {
        let mut gradients = self.gradients(state);
        gradients.iter_mut().for_each(|gradient| gradient.truncate(self.dimension));
        gradients
    }

    fn within(&self, state: &[Enclosure], loose: Enclosure) -> (Vec<Enclosure>, Vec<Boxed>) {
        let state = state.iter().map(|x| x.block()).collect();
        let (values, gradients) = self.over(Ball::<1>, state, &loose.block());
        let gradients = gradients.iter().map(|all| all.iter().map(Enclosure::first).collect());
        (values.iter().map(Enclosure::first).collect(), gradients.collect())
    }

    /// Evaluates values and gradients in any arithmetic, with the same number for the variables of
    /// all loose parameters.
    pub fn over<D: Domain>(
        &self,
        domain: D,
        mut state: Vec<D::Block>,
        loose: &D::Block,
    ) -> (Vec<D::Block>, Vec<Vec<D::Block>>) {
        state.extend(std::iter::repeat_n(loose.clone(), self.loose));
        let mut evaluator = Evaluator::new(&self.tape, domain);
        evaluator.run(&state);
        let all: Vec<D::Block> = evaluator.outputs().cloned().collect();
        let (values, gradients) = all.split_at(self.count);
        let width = self.dimension + self.loose;
        let gradient = |index: &usize| gradients[index * width..][..width].to_vec();
        let values = self.used.iter().map(|index| values[*index].clone()).collect();
        (values, self.used.iter().map(gradient).collect())
    }

    /// Encloses the values at a state less other numbers, in double-double.
    pub fn sharp(&self, state: &[f64], less: &[Rational]) -> Vec<Enclosure> {
        let exact = |x: &f64| DoubleDoubleBalls { hi: [*x], lo: [0.0], rad: [0.0] };
        let state = state.iter().map(exact).collect();
        let (values, _) = self.over(DoubleDoubleBall::<1>, state, &exact(&0.0));
        let pairs = values.iter().zip(less);
        pairs.map(|(value, less)| sharp::difference(value, less)).collect()
    }

    /// Orthonormal basis of the directions along which no function changes, at a state.
    pub fn complement(&self, state: &[f64]) -> Vec<Vec<f64>> {
        let at: Boxed = state.iter().map(|x| Enclosure::exact(*x)).collect();
        let mut units: Vec<Vec<f64>> = Vec::new();
        for gradient in self.within(&at, Enclosure::ZERO).1 {
            let gradient: Vec<f64> = gradient[..self.dimension].iter().map(|x| x.mid).collect();
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

/// Unit vector along a vector.
pub fn normalised(x: &[f64]) -> Vec<f64> {
    let length = norm(x);
    x.iter().map(|x| x / length).collect()
}

/// Component orthogonal to unit vectors; two passes are enough against rounding.
pub fn across(vector: &[f64], units: &[Vec<f64>]) -> Vec<f64> {
    let mut rest = vector.to_vec();
    for unit in units.iter().chain(units) {
        let along: f64 = rest.iter().zip(unit).map(|(x, y)| x * y).sum();
        rest.iter_mut().zip(unit).for_each(|(x, y)| *x -= along * y);
    }
    rest
}
