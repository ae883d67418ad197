//! Equations that choose one of the two halves of a level on which some vectors are a basis: det Q = 1 where
//! QᵀQ = E. They are no equations of the level, as their slopes vanish along it.

use num_traits::{One, Zero};

use super::derivatives::{EquationDerivatives, members};
use super::equation::Equation;
use super::frame::Frame;
use crate::graph::{Expr, Step, literally, record};
use crate::mechanics::{Half, Model, Phase};
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::{Extent, Group, GroupOutcome, Prover, is_nowhere_zero};

/// An equation of a level that says nothing new of a frame, but for its half.
pub struct OfFrame {
    /// Index of the equation in the level.
    pub index: usize,
    /// Half on which it holds; both if there is none.
    pub half: Option<Half>,
}

/// Finds the equations of a level that hold on a half, or on all, of the vectors of a basis whose products other
/// equations fix: det Q = 1, q₁ × q₂ = q₃ or QQᵀ = E beside QᵀQ = E. All are polynomials, with values everywhere.
pub fn of_frames(model: &Model) -> Vec<OfFrame> {
    let at = |index: usize| EquationDerivatives::at(model, Equation { index, is_squared: false });
    let derivatives: Vec<EquationDerivatives> = (0..model.level.len()).filter_map(at).collect();
    let mut found: Vec<OfFrame> = Vec::new();
    for frame in Frame::all(&derivatives).iter().filter(|frame| frame.is_basis()) {
        let own: Vec<usize> = frame.equations.iter().map(|equation| equation.index).collect();
        if found.iter().any(|other| own.contains(&other.index)) {
            continue;
        }
        let inside = frame.vectors.concat();
        let is_about = |derivatives: &&EquationDerivatives| {
            let index = derivatives.equation.index;
            let contained = members(derivatives.contained());
            let is_other = !own.contains(&index) && !found.iter().any(|own| own.index == index);
            let is_inside = !contained.is_empty() && contained.iter().all(|k| inside.contains(k));
            is_other && is_inside && is_polynomial(model, index)
        };
        let about: Vec<usize> =
            derivatives.iter().filter(is_about).map(|own| own.equation.index).collect();
        let holds = |index: &usize, is_positive| {
            HalfOfFrame { model, frame, is_positive }.satisfies(&[*index])
        };
        let (everywhere, others): (Vec<usize>, Vec<usize>) =
            about.into_iter().partition(|index| holds(index, true) && holds(index, false));
        found.extend(everywhere.into_iter().map(|index| OfFrame { index, half: None }));
        for is_positive in [true, false] {
            let own: Vec<usize> =
                others.iter().copied().filter(|index| holds(index, is_positive)).collect();
            // Not to be 0 identically on the other half is not enough: it must have no zero there.
            let other = HalfOfFrame { model, frame, is_positive: !is_positive };
            if own.is_empty() || !other.excludes(&own) {
                continue;
            }
            let half = Half { vectors: frame.vectors.clone(), is_positive };
            let chosen = own.into_iter().map(|index| OfFrame { index, half: Some(half.clone()) });
            found.extend(chosen);
        }
    }
    found
}

/// Whether an equation of the level, as it is written, is a polynomial.
fn is_polynomial(model: &Model, index: usize) -> bool {
    let parameters = model.free_components();
    let recorded = record(parameters + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(parameters);
        let phase = Phase::new(model, parameters, state);
        literally(|| phase.level_function(&model.level[index].function))
    });
    let Ok((graph, value)) = recorded else { return false };
    let reached = graph.reached([value]);
    let is_number = |place: usize| {
        let own = graph.at(place);
        graph.inputs_of(own).is_empty() && graph.is_always_defined(own)
    };
    graph.steps_at(&reached).all(|(place, step)| match step {
        Step::Constant(_) | Step::Input(_) | Step::Unary(UnaryFunction::Neg, _) => true,
        Step::Unary(..) => is_number(place),
        Step::Binary(operation, ..) => {
            use BinaryOperation::{Add, Mul, Sub};
            matches!(operation, Add | Sub | Mul) || is_number(place)
        }
        Step::Power(_, exponent) => {
            exponent.to_integer().is_some_and(|exponent| exponent >= 0) || is_number(place)
        }
    })
}

/// One half of the vectors of a frame.
#[derive(Clone, Copy)]
struct HalfOfFrame<'f> {
    model: &'f Model,
    frame: &'f Frame,
    is_positive: bool,
}

impl HalfOfFrame<'_> {
    /// Sum of the squares of some equations, from parameters and the draws of the state.
    fn squares(self, equations: &[usize], parameters: &[Expr], state: &[Expr]) -> Expr {
        let mut state = state.to_vec();
        self.frame.make(&mut state, Some(self.frame.sign_of(self.is_positive)));
        let phase = Phase::new(self.model, parameters, &state);
        let value = |index: &usize| phase.level_function(&self.model.level[*index].function);
        equations.iter().map(value).fold(Expr::zero(), |sum, value| sum + value * value)
    }

    /// The same sum at one point of the half.
    fn squares_at_a_point(self, equations: &[usize]) -> Expr {
        let parameters = vec![Expr::one(); self.model.free_components()];
        let state = vec![Expr::zero(); self.model.dimension()];
        self.squares(equations, &parameters, &state)
    }

    /// Whether the sum of the squares of some equations is proved to be 0, or what it is at a point.
    fn is_fixed(self, equations: &[usize], is_zero: bool) -> bool {
        let parameters = self.model.free_components();
        let inputs = parameters + self.model.dimension();
        let recorded = record(inputs, |inputs| {
            let (parameters, state) = inputs.split_at(parameters);
            let sum = self.squares(equations, parameters, state);
            if is_zero { sum } else { sum - self.squares_at_a_point(equations) }
        });
        let Ok((graph, value)) = recorded else { return false };
        let extents = vec![Extent::ALL; inputs];
        let prover = Prover { sources: &[], extents: &extents, seed: 0 };
        let outcome = prover.prove(&graph, &[Group::of(vec![value])]);
        outcome.is_ok_and(|found| found.iter().all(GroupOutcome::is_zero))
    }

    /// Whether all equations are proved to hold.
    fn satisfies(self, equations: &[usize]) -> bool {
        self.is_fixed(equations, true)
    }

    /// Whether some equations have no common zero: the sum of their squares is one positive number.
    fn excludes(self, equations: &[usize]) -> bool {
        let recorded = record(0, |_| self.squares_at_a_point(equations));
        recorded.is_ok_and(|(graph, value)| is_nowhere_zero(&graph, &[], &[], &[value]))
            && self.is_fixed(equations, false)
    }
}

/// Returns values that are positive on the halves of the level that the file chooses, where a frame of the solution
/// does not already lie in them.
pub fn signs(model: &Model, kept: &[bool], state: &[Expr], solved: &[Half]) -> Vec<Expr> {
    if !kept.iter().all(|kept| *kept) {
        return Vec::new();
    }
    let open = model.orientations.iter().filter(|own| !solved.contains(&own.half));
    open.map(|own| own.half.sign(state)).collect()
}
