//! Unit vectors among the positions of a Lagrangian system, by stereographic projection.

use num_dual::Dual;
use num_traits::{One, Zero};

use super::mechanical::constraints;
use crate::SearchError;
use crate::streams::SearchStream;
use liouville::formula::Type;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::{Lagrangian, Model, VariableRole};
use liouville::number::prime::{Prime, UNDEFINED};
use liouville::number::rational::Rational;
use liouville::proof::{root_numbers, statement_seed};
use liouville::scalar::Scalar;

/// Number of points at which an equation is looked at.
const POINTS: usize = 8;
/// Number of blocks of points, since roots exist at some only.
const TRIALS: usize = 16;

/// Vectors that an equation of the level makes unit vectors, by their first components; and the other
/// equations, by their numbers.
#[derive(Clone, Debug, Default)]
pub struct UnitVectors {
    vectors: Vec<usize>,
    /// Equations that are no such spheres.
    pub others: Vec<usize>,
}

impl UnitVectors {
    /// Finds them among the vectors that the motion carries along.
    pub fn of(model: &Model, lagrangian: &Lagrangian) -> Result<Self, SearchError> {
        let mut carried = Vec::new();
        let mut start = 0;
        for (role, variable) in lagrangian.roles.iter().zip(&model.state) {
            if matches!(role, VariableRole::Carried(_)) && variable.kind == Type::VECTOR {
                carried.push(start);
            }
            start += variable.len();
        }
        let mut found = Self { vectors: Vec::new(), others: Vec::new() };
        let count = model.level_formulas().count();
        for equation in 0..count {
            let mut own = None;
            for vector in &carried {
                if !found.vectors.contains(vector) && is_sphere(model, equation, *vector)? {
                    own = Some(*vector);
                    break;
                }
            }
            match own {
                Some(vector) => found.vectors.push(vector),
                None => found.others.push(equation),
            }
        }
        Ok(found)
    }

    /// Number of unit vectors.
    pub fn count(&self) -> usize {
        self.vectors.len()
    }

    /// Whether a component belongs to a unit vector.
    pub fn contains(&self, component: usize) -> bool {
        self.vectors.iter().any(|first| (*first..*first + 3).contains(&component))
    }

    /// Whether a component is the third of a unit vector, which is no coordinate.
    pub fn is_last(&self, component: usize) -> bool {
        self.vectors.iter().any(|first| *first + 2 == component)
    }

    /// Makes the vectors of a state whose first two components are the coordinates u and v.
    pub fn lift<T: Scalar>(&self, state: &mut [T]) {
        for first in &self.vectors {
            let made = projected(state[*first], state[*first + 1]);
            state[*first..*first + 3].copy_from_slice(&made);
        }
    }

    /// Rate of the coordinate in place of a component, from those of the state: u = g₁/(1 + g₃) has the rate
    /// (1 + u² + v²)/2 (g₁' − u g₃').
    pub fn rate(&self, component: usize, coordinates: [Expr; 2], field: &[Expr]) -> Option<Expr> {
        let first =
            self.vectors.iter().find(|first| (**first..**first + 2).contains(&component))?;
        let [u, v] = coordinates;
        let own = coordinates[component - first];
        let half = Expr::rational(&Rational::new(1, 2));
        let one = Expr::rational(&Rational::from(1));
        Some(half * (one + u * u + v * v) * (field[component] - own * field[first + 2]))
    }

    /// First component of the unit vector to which a component belongs.
    pub fn first(&self, component: usize) -> Option<usize> {
        self.vectors.iter().copied().find(|first| (*first..*first + 3).contains(&component))
    }
}

/// The unit vector over a point of the plane.
pub(super) fn projected<T: Scalar>(u: T, v: T) -> [T; 3] {
    let (one, two) = (T::one(), T::from(2.0));
    let scale = (one + u * u + v * v).recip();
    [two * u * scale, two * v * scale, (one - u * u - v * v) * scale]
}

/// Whether an equation is that of a unit vector and nothing else: E(γ) = c ((γ,γ) − 1) or c (|γ| − 1) for all γ, with
/// a number c that is not 0, and a slope at unit vectors. ((γ,γ) − 1)((γ,γ) − 4) holds for other vectors, too.
fn is_sphere(model: &Model, equation: usize, vector: usize) -> Result<bool, SearchError> {
    let parameters = model.free_components();
    let (graph, values) = record(parameters + model.dimension(), |inputs| {
        let (given, state) = inputs.split_at(parameters);
        let given: Vec<Dual<Expr>> = given.iter().map(|p| Dual::from_re(*p)).collect();
        let at = |own: [Expr; 3]| {
            let mut state = state.to_vec();
            state[vector..vector + 3].copy_from_slice(&own);
            let mut state: Vec<Dual<Expr>> = state.iter().map(|x| Dual::from_re(*x)).collect();
            state[vector] = state[vector].derivative();
            constraints(model, &given, &state, &[equation]).remove(0)
        };
        let free = [0, 1, 2].map(|k| state[vector + k]);
        let (unit, any) = (at(projected(free[0], free[1])), at(free).re);
        let centre = at([Expr::zero(); 3]).re;
        let square = free.iter().fold(Expr::zero(), |sum, x| sum + *x * *x);
        let by_square = any + centre * (square - Expr::one());
        let by_length = (any - centre) * (any - centre) - centre * centre * square;
        [unit.re, unit.eps, by_square, by_length]
    })?;
    let components: Vec<usize> = (0..3).map(|k| parameters + vector + k).collect();
    let is_own = |value: &Expr| graph.inputs_of(*value).iter().all(|own| components.contains(own));
    if !values.iter().all(is_own) {
        return Ok(false);
    }
    let mut rng = SearchStream::Constraints.under(statement_seed(1, &graph, &values));
    let modulus = rng.prime_for(&root_numbers(&graph));
    let tape = Tape::new(&graph, &values);
    let mut evaluator = Evaluator::new(&tape, Prime::new([modulus; POINTS]));
    for _ in 0..TRIALS {
        let point: Vec<[u64; POINTS]> =
            (0..graph.inputs()).map(|_| std::array::from_fn(|_| rng.element(&modulus))).collect();
        evaluator.run(&point);
        let [value, slope, by_square, by_length] = [0, 1, 2, 3].map(|k| *evaluator.output(k));
        let is_seen = |k: &usize| value[*k] != UNDEFINED && slope[*k] != UNDEFINED;
        let seen: Vec<usize> = (0..POINTS).filter(is_seen).collect();
        let is_zero = |all: &[u64; POINTS]| {
            let mut known = seen.iter().filter(|k| all[**k] != UNDEFINED).peekable();
            known.peek().is_some() && known.all(|k| all[*k] == 0)
        };
        if !seen.is_empty() {
            let has_slope = seen.iter().any(|k| slope[*k] != 0);
            return Ok(is_zero(&value)
                && has_slope
                && (is_zero(&by_square) || is_zero(&by_length)));
        }
    }
    Ok(false)
}
