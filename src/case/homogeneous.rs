//! Is a typed support function homogeneous of degree 1? If not, it is meant on the unit sphere.

use crate::graph::{Evaluator, Tape, record};
use crate::mechanics::calculus::{Jet, dot};
use crate::mechanics::{Draw, Draws, Model, NORMAL, Origin, Phase, Range, Shape};
use crate::number::Domain;
use crate::number::ball::Ball;

/// The shape to use in place of `shape`: its extension off the sphere, if it needs one.
///
/// Euler's relation (γ,∇h) = h is evaluated at a few states; a ball that excludes 0 proves that h
/// is not homogeneous, and then |γ| h(γ/|γ|) is the body's support function.
pub fn extension(model: &Model, shape: &Shape) -> Option<Shape> {
    let Shape::Support(formula) = shape else { return None };
    let mut draws = Vec::new();
    let mut recipes = Vec::new();
    for parameter in model.free_parameters() {
        if let Origin::Free(recipe) = &parameter.origin {
            recipes.push(recipe);
            draws.extend(recipe.draws());
        }
    }
    let gamma_at = draws.len();
    draws.extend(vec![Draw::Within(Range::between((1, 5), (3, 2))); 3]);
    let (graph, defect) = record(draws.len(), |inputs| {
        let mut rest = inputs;
        let mut free = Vec::new();
        for recipe in &recipes {
            let (own, others) = rest.split_at(recipe.draws().len());
            rest = others;
            free.extend(recipe.make(own).components());
        }
        let zero = num_traits::Zero::zero();
        let state = [[zero; 3], [inputs[gamma_at], inputs[gamma_at + 1], inputs[gamma_at + 2]]];
        let jet = Jet::new(Phase::new(model, &free, &state.concat()));
        let slope = jet.gradient(|at| at.scalar(formula));
        dot(&slope[3 * NORMAL..], &state[1]) - jet.phase.scalar(formula)
    })
    .ok()?;
    let tape = Tape::new(&graph, &[defect]);
    let mut evaluator = Evaluator::new(&tape, Ball::<1>);
    let numbers = Draws::new(&draws);
    let refuted = (0..4).any(|index| {
        let values = numbers.state(0, index);
        let inputs: Vec<_> = values.into_iter().map(|value| Ball::<1>.values(&[value])).collect();
        evaluator.run(&inputs);
        evaluator.output(0).excludes_zero(0)
    });
    refuted.then(|| Shape::SupportOnSphere(formula.clone()))
}
