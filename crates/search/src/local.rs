//! Equations of motion in local coordinates of the level, split into positions and velocities.

use num_dual::{Dual, DualNum};

use super::SearchError;
use liouville::case::Case;
use liouville::graph::{Expr, Graph, record};
use liouville::mechanics::elimination::{dot, solve_positive};
use liouville::mechanics::{Chart, Draw, Phase, System, VariableRole};
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::proof::ProofRng;
use liouville::scalar::Scalar;

/// Local coordinates of the level, positions followed by velocities.
#[derive(Clone, Debug)]
pub struct Coordinates {
    kind: LocalKind,
    /// Number of positions.
    pub positions: usize,
    /// Number of velocities.
    pub velocities: usize,
}

#[derive(Clone, Debug)]
enum LocalKind {
    /// Coordinates (u,v) of γ by stereographic projection, with ω = w₁γ_u + w₂γ_v.
    Rolling,
    /// Stereographic projection of γ, with M or ω free.
    Sphere,
    /// Components of the state: positions, then velocities.
    Components(Vec<usize>),
}

impl Coordinates {
    /// Finds coordinates of the level of a case, if positions and velocities are known.
    pub fn of(case: &Case) -> Result<Self, SearchError> {
        let model = &case.model;
        if !model.extension.is_empty() {
            return Err(SearchError::Unsplit("variables were added to the system"));
        }
        let split = |positions: Vec<usize>, velocities: Vec<usize>| Self {
            positions: positions.len(),
            velocities: velocities.len(),
            kind: LocalKind::Components([positions, velocities].concat()),
        };
        match (&model.system, &case.chart) {
            (System::Rubber(_), Chart::Rolling) => {
                Ok(Self { kind: LocalKind::Rolling, positions: 2, velocities: 2 })
            }
            (System::Ball(_) | System::Spinning(_), Chart::Sphere) => {
                Ok(Self { kind: LocalKind::Sphere, positions: 2, velocities: 3 })
            }
            (System::FlatBase(_), _) => Ok(split(vec![2, 3], vec![0, 1])),
            (System::Lagrangian(lagrangian), _) if model.level.is_empty() => {
                let (mut positions, mut velocities, mut start) = (Vec::new(), Vec::new(), 0);
                for (role, variable) in lagrangian.roles.iter().zip(&model.state) {
                    let own = start..start + variable.len();
                    match role {
                        VariableRole::Coordinate(_)
                        | VariableRole::Carried(_)
                        | VariableRole::Time => positions.extend(own),
                        VariableRole::Velocity | VariableRole::Multiplier => velocities.extend(own),
                    }
                    start += variable.len();
                }
                Ok(split(positions, velocities))
            }
            _ => Err(SearchError::Unsplit("it is not known which variables are velocities")),
        }
    }

    /// Components of the state as given positions, and all others as velocities.
    pub fn divided(case: &Case, positions: &[usize]) -> Self {
        let others = (0..case.model.dimension()).filter(|k| !positions.contains(k));
        let kind = LocalKind::Components(positions.iter().copied().chain(others).collect());
        let velocities = case.model.dimension() - positions.len();
        Self { kind, positions: positions.len(), velocities }
    }

    /// All components of the state as velocities, for a case without a level.
    pub fn all_moving(case: &Case) -> Self {
        let velocities = case.model.dimension();
        let kind = LocalKind::Components((0..velocities).collect());
        Self { kind, positions: 0, velocities }
    }

    /// Returns the state at a point of these coordinates.
    pub fn state<T: Scalar>(&self, coordinates: &[T]) -> Vec<T> {
        let (one, two) = (T::one(), T::from(2.0));
        let normal = |u: T, v: T| {
            let scale = (one + u * u + v * v).recip();
            [two * u * scale, two * v * scale, (one - u * u - v * v) * scale]
        };
        match (&self.kind, coordinates) {
            (LocalKind::Rolling, [u, v, w1, w2]) => {
                let along = |du: T, dv: T| {
                    let (u, v) = (Dual::new(*u, du), Dual::new(*v, dv));
                    let (one, two) = (Dual::from_re(one), Dual::from_re(two));
                    let scale = (one + u * u + v * v).recip();
                    [two * u * scale, two * v * scale, (one - u * u - v * v) * scale]
                };
                let (a, b) = (along(one, T::zero()), along(T::zero(), one));
                let omega = (0..3).map(|k| *w1 * a[k].eps + *w2 * b[k].eps);
                omega.chain(normal(*u, *v)).collect()
            }
            (LocalKind::Sphere, [u, v, momentum @ ..]) => {
                momentum.iter().copied().chain(normal(*u, *v)).collect()
            }
            (LocalKind::Components(places), _) => {
                let mut state = vec![T::zero(); places.len()];
                for (place, value) in places.iter().zip(coordinates) {
                    state[*place] = *value;
                }
                state
            }
            _ => coordinates.to_vec(),
        }
    }

    /// Number of coordinates.
    pub fn count(&self) -> usize {
        self.positions + self.velocities
    }
}

/// Rates of the coordinates as a graph; its inputs are the draws of the parameters, followed by the
/// coordinates.
pub struct Local {
    /// Positions and velocities.
    pub coordinates: Coordinates,
    /// The recorded rates.
    pub graph: Graph,
    /// One rate for each coordinate.
    pub rates: Vec<Expr>,
    /// Draws from which the parameters are made.
    pub draws: Vec<Draw>,
}

impl Local {
    /// Records the rates of a case; `fixed` holds a value for each fixed draw.
    pub fn of(case: &Case, fixed: &[Option<Rational>]) -> Result<Self, SearchError> {
        let coordinates = Coordinates::of(case)?;
        let model = &case.model;
        let draws = model.parameter_draws();
        let count = draws.len();
        let (graph, rates) = record(count + coordinates.count(), |inputs| {
            let (given, point) = inputs.split_at(count);
            let given: Vec<Expr> = given
                .iter()
                .enumerate()
                .map(|(k, draw)| match fixed.get(k) {
                    Some(Some(value)) => Expr::rational(value),
                    _ => *draw,
                })
                .collect();
            let (parameters, _) = model.make_parameters(&given);
            let state = coordinates.state(point);
            let field = Phase::new(model, &parameters, &state).field().to_vec();
            let columns: Vec<Vec<Expr>> = (0..point.len())
                .map(|j| {
                    let unit = |k| if k == j { Expr::rational(&Rational::from(1)) } else { zero() };
                    let lifted: Vec<Dual<Expr>> =
                        point.iter().enumerate().map(|(k, x)| Dual::new(*x, unit(k))).collect();
                    coordinates.state(&lifted).iter().map(|x| x.eps).collect()
                })
                .collect();
            // dχ ċ = v, by the normal equations.
            let gram =
                columns.iter().map(|a| columns.iter().map(|b| dot(a, b)).collect()).collect();
            solve_positive(gram, columns.iter().map(|a| dot(a, &field)).collect())
        })?;
        // An ∫ is a function of the positions with an unknown series: its value is a free input.
        if graph.inputs() > count + coordinates.count() {
            return Err(SearchError::Unsplit("the field contains ∫"));
        }
        Ok(Self { coordinates, graph, rates, draws })
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

fn zero() -> Expr {
    Expr::rational(&Rational::from(0))
}
