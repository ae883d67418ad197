//! Can the level equations be solved one after the other, each for a variable it is linear in?

use num_traits::{One, Zero};

use crate::graph::{Expr, record};
use crate::mechanics::{Chart, Model, Phase, Step};
use num_dual::Dual;

/// Each further equation multiplies the work by three.
const MAX_EQUATIONS: usize = 6;

/// The order of solving, or `None` where some equation is linear in no variable that is left.
pub fn steps(model: &Model) -> Option<Vec<Step>> {
    if model.level.len() > MAX_EQUATIONS {
        return None;
    }
    let mut steps: Vec<Step> = Vec::new();
    for equation in 0..model.level.len() {
        let component = (0..model.dimension())
            .filter(|component| steps.iter().all(|step| step.component != *component))
            .find(|component| is_linear(model, &steps, equation, *component))?;
        steps.push(Step { equation, component });
    }
    Some(steps)
}

/// Is ∂F/∂x_j free of x_j, and not 0, once the earlier equations are solved?
fn is_linear(model: &Model, earlier: &[Step], equation: usize, component: usize) -> bool {
    let parameters = model.free_components();
    let recorded = record(parameters + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(parameters);
        let lift = |x: &Expr| Dual::from_re(*x);
        let parameters: Vec<Dual<Expr>> = parameters.iter().map(lift).collect();
        let mut state: Vec<Dual<Expr>> = state.iter().map(lift).collect();
        state[component].eps = Expr::one();
        let kept = vec![true; model.level.len()];
        let chart = Chart::Solved(earlier.to_vec());
        let completed = chart.point(model, &kept, &parameters, &state);
        let phase = Phase::new(model, &parameters, &completed);
        phase.level_function(&model.level[equation].function).eps
    });
    match recorded {
        Ok((graph, slope)) => {
            let vanishes = graph.constant_value(slope).is_some_and(|value| value.is_zero());
            !vanishes && slope != Expr::zero() && !graph.depends_on(slope, parameters + component)
        }
        Err(_) => false,
    }
}
