//! Local coordinates of the level, split into positions and velocities.

use num_dual::Dual;

use super::mechanical::Mechanical;
use super::spheres::projected;
use super::unwound::rational;
use crate::SearchError;
use liouville::case::Case;
use liouville::graph::{Expr, Fault, Graph, record};
use liouville::mechanics::elimination::{dot, solve_positive};
use liouville::mechanics::{Chart, Model, System};
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
    /// Positions and independent velocities of a Lagrangian system.
    Mechanical(Box<Mechanical>),
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
            (System::Lagrangian(lagrangian), _) => {
                let own = Mechanical::of(case, lagrangian)?;
                Ok(Self {
                    positions: own.positions(),
                    velocities: own.velocities(),
                    kind: LocalKind::Mechanical(Box::new(own)),
                })
            }
            (System::Ball(_), _) => Err(SearchError::Unsplit(
                "the function of the surface is an integral of the positions alone, and its products \
                 with others have no end; give the surface by `support`",
            )),
            _ => Err(SearchError::Unsplit("it is not known which variables are velocities")),
        }
    }

    /// Whether a system has velocities that may be known: fields and Hamilton's equations have none.
    pub fn are_expected(system: &System) -> bool {
        !system.is_field()
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

    /// Makes the parameters from values for their draws.
    pub fn parameters<T: Scalar>(&self, model: &Model, given: &[T]) -> Vec<T> {
        let turned: Vec<T> = match &self.kind {
            LocalKind::Mechanical(own) => own.draws(given),
            _ => given.to_vec(),
        };
        model.make_parameters(&turned).0
    }

    /// Whether another number, as tan φ/2, is in place of what is drawn for a parameter.
    pub fn is_turned(&self, draw: usize) -> bool {
        match &self.kind {
            LocalKind::Mechanical(own) => own.is_turned(draw),
            _ => false,
        }
    }

    /// Returns the state at a point of these coordinates.
    pub fn state<T: Scalar>(&self, model: &Model, parameters: &[T], coordinates: &[T]) -> Vec<T> {
        match (&self.kind, coordinates) {
            (LocalKind::Rolling, [u, v, w1, w2]) => {
                let along = |du: T, dv: T| projected(Dual::new(*u, du), Dual::new(*v, dv));
                let (a, b) = (along(T::one(), T::zero()), along(T::zero(), T::one()));
                let omega = (0..3).map(|k| *w1 * a[k].eps + *w2 * b[k].eps);
                omega.chain(projected(*u, *v)).collect()
            }
            (LocalKind::Sphere, [u, v, momentum @ ..]) => {
                momentum.iter().copied().chain(projected(*u, *v)).collect()
            }
            (LocalKind::Components(places), _) => {
                let mut state = vec![T::zero(); places.len()];
                for (place, value) in places.iter().zip(coordinates) {
                    state[*place] = *value;
                }
                state
            }
            (LocalKind::Mechanical(own), _) => own.state(model, parameters, coordinates),
            _ => coordinates.to_vec(),
        }
    }

    /// Computes the rates of the coordinates, at a point, from those of the state.
    pub(super) fn rates(
        &self,
        model: &Model,
        parameters: &[Expr],
        point: &[Expr],
        field: &[Expr],
    ) -> Vec<Expr> {
        match &self.kind {
            LocalKind::Components(places) => places.iter().map(|place| field[*place]).collect(),
            LocalKind::Mechanical(own) => own.rates(parameters, point, field),
            LocalKind::Rolling | LocalKind::Sphere => {
                let parameters: Vec<Dual<Expr>> =
                    parameters.iter().map(|p| Dual::from_re(*p)).collect();
                let column = |j: usize| -> Vec<Expr> {
                    let mut lifted: Vec<Dual<Expr>> =
                        point.iter().map(|x| Dual::from_re(*x)).collect();
                    lifted[j] = lifted[j].derivative();
                    self.state(model, &parameters, &lifted).iter().map(|x| x.eps).collect()
                };
                let columns: Vec<Vec<Expr>> = (0..point.len()).map(column).collect();
                // dχ ċ = v, by the normal equations.
                let gram =
                    columns.iter().map(|a| columns.iter().map(|b| dot(a, b)).collect()).collect();
                solve_positive(gram, columns.iter().map(|a| dot(a, field)).collect())
            }
        }
    }

    /// Number of coordinates.
    pub fn count(&self) -> usize {
        self.positions + self.velocities
    }

    /// Records functions of these coordinates. Those in which angles are points of a circle have no sine and
    /// cosine then, and those in which exponentials are coordinates no exponential.
    pub fn record(
        &self,
        inputs: usize,
        build: impl FnOnce(&[Expr]) -> Vec<Expr>,
    ) -> Result<(Graph, Vec<Expr>), Fault> {
        let (graph, values) = record(inputs, build)?;
        match &self.kind {
            LocalKind::Mechanical(own) if own.is_substituted() => rational(&graph, &values),
            _ => Ok((graph, values)),
        }
    }
}
