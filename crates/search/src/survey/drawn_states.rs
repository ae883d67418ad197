//! Drawn states with their rates, at which maps are tried before they are claimed.

use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::Phase;
use liouville::number::float::Float;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use liouville::verdict::Sampler;

/// Number of drawn states at which a map is tried.
const STATES: u64 = 3;
/// Part of the largest rate by which rates may differ through rounding.
const ROUNDING: f64 = 1e-9;

/// A drawn state with its rates.
pub struct DrawnState {
    tape: Tape,
    state: Vec<f64>,
    rates: Vec<f64>,
}

impl DrawnState {
    /// Whether v(σx) is σv(x), or its negative, up to rounding.
    pub fn fits(&self, image: impl Fn(&[f64]) -> Vec<f64>, reverses: bool) -> bool {
        let there = rates(&self.tape, &image(&self.state));
        let turned = image(&self.rates);
        let sign = if reverses { -1.0 } else { 1.0 };
        let size = self.rates.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
        // Comparisons with NaN are false.
        there.iter().zip(&turned).all(|(a, b)| (a - sign * b).abs() <= ROUNDING * size)
    }
}

fn rates(tape: &Tape, state: &[f64]) -> Vec<f64> {
    let mut evaluator = Evaluator::new(tape, Float::<1>);
    evaluator.run(&state.iter().map(|x| [*x]).collect::<Vec<_>>());
    evaluator.outputs().map(|value| value[0]).collect()
}

/// Draws states with their parameters.
pub fn states(case: &Case, seed: u64) -> Option<Vec<DrawnState>> {
    let model = &case.model;
    let sampler = Sampler::new(case, &LevelSubset::level(model), seed).ok()?;
    let one = |index: u64| {
        let values = sampler.printed(index, f64::MANTISSA_DIGITS);
        let values = values.iter().map(|text| text.parse::<Rational>().ok());
        let mut parameters = values.collect::<Option<Vec<Rational>>>()?;
        let state = parameters.split_off(model.free_components());
        let (graph, field) = record(model.dimension(), |inputs| {
            let parameters: Vec<_> = parameters.iter().map(Expr::rational).collect();
            Phase::new(model, &parameters, inputs).field().to_vec()
        })
        .ok()?;
        if graph.inputs() > model.dimension() {
            return None;
        }
        let tape = Tape::new(&graph, &field);
        let state: Vec<f64> = state.iter().map(|x| x.to_f64().0).collect();
        let rates = rates(&tape, &state);
        Some(DrawnState { tape, state, rates })
    };
    (0..STATES).map(one).collect()
}
