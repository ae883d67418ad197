//! The rates of positions and velocities in two parts: what depends on the positions alone, and what
//! follows from that and the velocities.
//!
//! The rates are expanded at one point for many velocities, and most of their operations are the same
//! for all of them.

use liouville::graph::{Evaluator, Expr, Graph, Step, Tape, record};
use liouville::number::Domain;

/// Rates on two tapes.
pub struct SplitRates {
    /// Computes the values that do not depend on the velocities and are needed by others.
    fixed: Tape,
    /// Computes the rates from all inputs, followed by these values.
    moving: Tape,
}

impl SplitRates {
    /// Splits values of a graph whose inputs from `before` on are velocities.
    pub fn new(graph: &Graph, rates: &[Expr], before: usize) -> Self {
        let inputs = graph.inputs();
        let shared = shared(graph, rates, before);
        let places: Vec<usize> = shared.iter().map(|value| graph.place(*value)).collect();
        let reached = graph.reached(rates.iter().copied());
        let recorded = record(inputs + shared.len(), |own| {
            let values = graph.replay(&reached, &own[..inputs], |place, _, _| {
                places.binary_search(&place).ok().map(|number| own[inputs + number])
            });
            rates.iter().map(|rate| values[graph.place(*rate)]).collect::<Option<Vec<Expr>>>()
        });
        match recorded {
            Ok((own, Some(rates))) => {
                let (fixed, moving) = (Tape::new(graph, &shared), Tape::new(&own, &rates));
                Self { fixed, moving }
            }
            // Everything depends on the velocities then.
            _ => {
                let (fixed, moving) = (Tape::new(graph, &[]), Tape::new(graph, rates));
                Self { fixed, moving }
            }
        }
    }

    /// Returns the rates at fixed inputs before the velocities, as a function of these.
    pub fn at<'t, D: Domain + Clone + 't>(
        &'t self,
        domain: &D,
        fixed: &[D::Block],
    ) -> impl FnMut(&[D::Block]) -> Vec<D::Block> + 't
    where
        D::Block: Clone + 't,
    {
        let mut first = Evaluator::new(&self.fixed, domain.clone());
        first.run(fixed);
        let shared: Vec<D::Block> = first.outputs().cloned().collect();
        let mut evaluator = Evaluator::new(&self.moving, domain.clone());
        let fixed = fixed.to_vec();
        move |velocities: &[D::Block]| {
            evaluator.run(fixed.iter().chain(velocities).chain(&shared));
            evaluator.outputs().cloned().collect()
        }
    }
}

/// Lists the operations that do not depend on inputs from `before` on, and that outputs or operations
/// that do depend on them need, in order.
fn shared(graph: &Graph, rates: &[Expr], before: usize) -> Vec<Expr> {
    let reached = graph.reached(rates.iter().copied());
    let mut moves = Vec::with_capacity(graph.len());
    let mut is_shared = vec![false; graph.len()];
    for (place, step) in graph.steps().enumerate() {
        let own = match step {
            Step::Input(input) => input >= before,
            _ => step.arguments().any(|argument| moves[argument]),
        };
        moves.push(own);
        if own && reached[place] {
            step.arguments().for_each(|argument| is_shared[argument] = true);
        }
    }
    rates.iter().for_each(|rate| is_shared[graph.place(*rate)] = true);
    let is_operation =
        |place: usize| !matches!(graph.step(place), Step::Constant(_) | Step::Input(_));
    let places = (0..graph.len()).filter(|place| is_shared[*place] && !moves[*place]);
    places.filter(|place| is_operation(*place)).map(|place| graph.at(place)).collect()
}

#[cfg(test)]
mod tests {
    use liouville::number::prime::{Modulus, Prime};
    use num_dual::DualNum;

    use super::*;

    #[test]
    fn both_parts_together_are_the_whole() {
        // Inputs: a parameter, a position, two velocities.
        let (graph, rates) = record(4, |x| {
            let inverse = (x[0] * x[1] + 2.0).recip();
            let free = x[1] * x[1];
            vec![x[2] * inverse + x[3] * x[3] * free, inverse, x[2], x[0], free * x[0], x[3] + 1.0]
        })
        .expect("records");
        let m = Modulus::new(2_305_843_009_213_693_951);
        let domain = Prime::new([m]);
        let split = SplitRates::new(&graph, &rates, 2);
        assert_eq!(split.fixed.outputs(), 3, "the inverse, the square, and a rate");
        let whole = Tape::new(&graph, &rates);
        let saved = whole.operations() - split.moving.operations();
        assert_eq!(saved, split.fixed.operations(), "nothing is computed twice");
        let mut evaluator = Evaluator::new(&whole, domain.clone());
        let value = |x: u64| [m.integer(x)];
        let mut rates_at = split.at(&domain, &[value(3), value(5)]);
        for (w, z) in [(0, 0), (7, 11), (13, 0)] {
            let inputs = [value(3), value(5), value(w), value(z)];
            evaluator.run(&inputs);
            let expected: Vec<[u64; 1]> = evaluator.outputs().copied().collect();
            assert_eq!(rates_at(&[value(w), value(z)]), expected);
        }
    }
}
