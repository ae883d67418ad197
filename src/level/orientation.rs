//! Equations that choose one of the two halves of a level on which some vectors are a basis: det Q = 1 where
//! QᵀQ = E. They are no equations of the level, as their slopes vanish along it.

use super::derivatives::EquationDerivatives;
use super::equation::Equation;
use super::frame::Frame;
use crate::graph::{Expr, record};
use crate::mechanics::{Half, Model, Phase};
use crate::proof::{Extent, Group, GroupOutcome, Prover};

/// An equation of a level that says nothing new of a frame, but for its half.
pub struct OfFrame {
    /// Index of the equation in the level.
    pub index: usize,
    /// Half on which it holds; both if there is none.
    pub half: Option<Half>,
}

/// Finds the equations of a level that hold on a half, or on all, of the vectors of a basis whose products other
/// equations fix: det Q = 1, q₁ × q₂ = q₃ or QQᵀ = E beside QᵀQ = E.
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
        for derivatives in &derivatives {
            let index = derivatives.equation.index;
            let contained = super::derivatives::members(derivatives.contained());
            let is_other = !own.contains(&index) && !found.iter().any(|own| own.index == index);
            let is_inside = !contained.is_empty() && contained.iter().all(|k| inside.contains(k));
            if !is_other || !is_inside {
                continue;
            }
            let holds = [true, false].map(|is_positive| holds_on(model, frame, index, is_positive));
            let half = |is_positive| Some(Half { vectors: frame.vectors.clone(), is_positive });
            match holds {
                [true, true] => found.push(OfFrame { index, half: None }),
                [true, false] => found.push(OfFrame { index, half: half(true) }),
                [false, true] => found.push(OfFrame { index, half: half(false) }),
                [false, false] => {}
            }
        }
    }
    found
}

/// Whether an equation is proved to hold for all vectors of a frame on one half.
fn holds_on(model: &Model, frame: &Frame, index: usize, is_positive: bool) -> bool {
    let parameters = model.free_components();
    let inputs = parameters + model.dimension();
    let recorded = record(inputs, |inputs| {
        let (parameters, state) = inputs.split_at(parameters);
        let mut state = state.to_vec();
        frame.make(&mut state, Some(frame.sign_of(is_positive)));
        Phase::new(model, parameters, &state).level_function(&model.level[index].function)
    });
    let Ok((graph, value)) = recorded else { return false };
    let extents = vec![Extent::ALL; inputs];
    let prover = Prover { sources: &[], extents: &extents, seed: 0 };
    let outcome = prover.prove(&graph, &[Group::of(vec![value])]);
    outcome.is_ok_and(|found| found.iter().all(GroupOutcome::is_zero))
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
