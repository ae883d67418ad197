//! Equations of motion in local coordinates of the level, split into positions and velocities.

mod coordinates;
mod exponentials;
mod exponents;
pub mod functions;
mod mechanical;
mod spheres;
pub mod unwound;

pub use coordinates::Coordinates;
use functions::{FunctionSeries, adjoined, roles};

use super::SearchError;
use liouville::case::Case;
use liouville::graph::{Expr, Graph};
use liouville::mechanics::{Draw, Phase};
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::proof::ProofRng;
use liouville::scalar::Scalar;

/// Rates of the coordinates as a graph; its inputs are the draws of the parameters, followed by the
/// positions, functions of these without values modulo a prime, and the velocities.
pub struct Local {
    /// Positions and velocities.
    pub coordinates: Coordinates,
    /// The recorded rates.
    pub graph: Graph,
    /// One rate for each coordinate.
    pub rates: Vec<Expr>,
    /// Functions of the positions.
    pub functions: FunctionSeries,
    /// Draws from which the parameters are made.
    pub draws: Vec<Draw>,
}

impl Local {
    /// Records the rates of a case.
    pub fn of(case: &Case) -> Result<Self, SearchError> {
        Self::with(case, Coordinates::of(case)?, &[])
    }

    /// Records the rates of a case in its coordinates; `fixed` holds a value for each fixed draw.
    pub fn with(
        case: &Case,
        coordinates: Coordinates,
        fixed: &[Option<Rational>],
    ) -> Result<Self, SearchError> {
        let model = &case.model;
        let draws = model.parameter_draws();
        let count = draws.len();
        let (graph, rates) = coordinates.record(count + coordinates.count(), |inputs| {
            let (given, point) = inputs.split_at(count);
            let given: Vec<Expr> = given
                .iter()
                .enumerate()
                .map(|(k, draw)| match fixed.get(k) {
                    Some(Some(value)) => Expr::rational(value),
                    _ => *draw,
                })
                .collect();
            let parameters = coordinates.parameters(model, &given);
            let state = coordinates.state(model, &parameters, point);
            let field = Phase::new(model, &parameters, &state).field().to_vec();
            coordinates.rates(model, &parameters, point, &field)
        })?;
        // An ∫ is a function of the positions with an unknown series: its value is a free input.
        if graph.inputs() > count + coordinates.count() {
            return Err(SearchError::Unsplit("the field contains ∫"));
        }
        let before = count + coordinates.positions;
        let (graph, rates, functions) =
            match adjoined(&graph, &rates, before, &roles(&draws, coordinates.positions))? {
                Some(own) => (own.graph, own.outputs, own.functions),
                None => (graph, rates, Vec::new()),
            };
        let functions = FunctionSeries::new(&graph, functions);
        Ok(Self { coordinates, graph, rates, functions, draws })
    }
}

impl Local {
    /// Draws the parameters at random; of a list the first value is taken.
    pub fn parameters(&self, modulus: &Modulus, rng: &mut ProofRng) -> Vec<u64> {
        random(&self.draws, modulus, rng)
    }
}

/// Draws random values of parameters; of a list the first value is taken.
pub fn random(draws: &[Draw], modulus: &Modulus, rng: &mut ProofRng) -> Vec<u64> {
    let value = |draw: &Draw| match draw {
        Draw::OneOf(values) => values.first().and_then(|x| modulus.rational(x)).unwrap_or(0),
        Draw::Sign => modulus.one(),
        Draw::Within(_) | Draw::Of(..) => rng.element(modulus),
    };
    draws.iter().map(value).collect()
}

/// Draws 1 or -1.
pub fn sign(m: &Modulus, rng: &mut ProofRng) -> u64 {
    if rng.coin() { m.one() } else { m.sub(0, m.one()) }
}
