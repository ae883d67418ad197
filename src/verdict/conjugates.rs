//! Signs with which a value may be continued: those of its moduli and square roots, and of the roots by
//! which a level is solved.
//!
//! docs/soundness.md, "Independence on all states".

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::mechanics::Draw;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// Largest number of signs of which all choices are tried.
const MOST_SIGNS: usize = 5;

/// Values with each choice of the signs that may be changed.
pub struct SignChoices {
    /// Graph of the values.
    pub graph: Graph,
    /// The values for each choice.
    pub values: Vec<Vec<Expr>>,
}

/// Lists the places whose signs may be changed, if values are otherwise analytic on one connected complex
/// domain: they are built by arithmetic, exp, sin, cos, by roots, logarithms and powers of affine
/// functions, and by moduli and square roots of such values. `None` for others.
pub fn changing_signs(graph: &Graph, values: &[Expr], inputs: &[Draw]) -> Option<Vec<usize>> {
    let reached = graph.reached(values.iter().copied());
    let mut is_affine = vec![false; reached.len()];
    // Numbers such as π = 4 atan 1 and ln 2 are continued as themselves.
    let mut is_number = vec![false; reached.len()];
    let mut places = Vec::new();
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        is_number[place] = match step {
            Step::Constant(_) => true,
            Step::Input(_) => false,
            Step::Unary(_, a) | Step::Power(a, _) => is_number[a],
            Step::Binary(_, a, b) => is_number[a] && is_number[b],
        };
        if is_number[place] {
            is_affine[place] = true;
            continue;
        }
        let is_constant = |place: usize| is_number[place];
        is_affine[place] = match step {
            Step::Constant(_) => true,
            Step::Input(input) => !matches!(inputs.get(input), Some(Draw::Sign)),
            Step::Unary(UnaryFunction::Neg, a) => is_affine[a],
            Step::Binary(BinaryOperation::Add | BinaryOperation::Sub, a, b) => {
                is_affine[a] && is_affine[b]
            }
            Step::Binary(BinaryOperation::Mul, a, b) => {
                (is_constant(a) && is_affine[b]) || (is_constant(b) && is_affine[a])
            }
            _ => false,
        };
        let changes = match step {
            Step::Input(input) => matches!(inputs.get(input), Some(Draw::Sign)),
            Step::Unary(UnaryFunction::Abs, _) => true,
            Step::Unary(UnaryFunction::Sqrt, a) => !is_affine[a],
            Step::Power(a, exponent) if exponent.to_integer().is_none() && !is_affine[a] => {
                let is_of_root = (exponent * &Rational::from(2)).to_integer().is_some();
                is_of_root.then_some(true)?
            }
            Step::Unary(UnaryFunction::Atan, _) => return None,
            Step::Unary(UnaryFunction::Ln, a) | Step::Binary(BinaryOperation::Pow, a, _)
                if !is_affine[a] =>
            {
                return None;
            }
            _ => false,
        };
        if changes {
            places.push(place);
        }
    }
    Some(places)
}

/// Whether values are restrictions of one analytic function on a connected complex domain.
pub fn is_one_function(graph: &Graph, values: &[Expr], inputs: &[Draw]) -> bool {
    changing_signs(graph, values, inputs).is_some_and(|places| places.is_empty())
}

/// Lists those columns of a matrix, given by rows, whose entries have few signs together that may be
/// changed, those with the fewest first.
pub fn columns_with_few_signs(graph: &Graph, rows: &[Vec<Expr>], inputs: &[Draw]) -> Vec<usize> {
    let width = rows.first().map_or(0, Vec::len);
    let column = |index: usize| rows.iter().map(|row| row[index]).collect::<Vec<Expr>>();
    let signs = |index: usize| Some((changing_signs(graph, &column(index), inputs)?.len(), index));
    let mut found: Vec<(usize, usize)> = (0..width).filter_map(signs).collect();
    found.sort_unstable();
    let (mut chosen, mut places) = (Vec::new(), Vec::new());
    for (_, index) in found {
        let own = changing_signs(graph, &column(index), inputs).unwrap_or_default();
        let new: Vec<usize> = own.into_iter().filter(|place| !places.contains(place)).collect();
        if places.len() + new.len() <= MOST_SIGNS {
            places.extend(new);
            chosen.push(index);
        }
    }
    chosen
}

/// Records values with each choice of the signs that may be changed, one after the other; `None` if
/// they are of another kind, or have many signs.
pub fn with_all_signs(
    graph: &Graph,
    values: &[Expr],
    inputs: &[Draw],
) -> Result<Option<SignChoices>, Fault> {
    let Some(places) = changing_signs(graph, values, inputs) else { return Ok(None) };
    if places.len() > MOST_SIGNS {
        return Ok(None);
    }
    let reached = graph.reached(values.iter().copied());
    let (made, found) = record(graph.inputs(), |own| {
        let with = |choice: usize| {
            let changed = graph.replay(&reached, own, |place, step, before| {
                let index = places.iter().position(|own| *own == place)?;
                let value = match step {
                    Step::Input(_) => Expr::rational(&Rational::from(1)),
                    step => step.repeat(own, |place| before[place])?,
                };
                Some(if choice >> index & 1 == 0 { value } else { -value })
            });
            values.iter().map(|value| changed[graph.place(*value)]).collect::<Option<Vec<Expr>>>()
        };
        (0..1 << places.len()).map(with).collect::<Option<Vec<Vec<Expr>>>>()
    })?;
    Ok(found.map(|values| SignChoices { graph: made, values }))
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::graph::{Evaluator, Tape};
    use crate::number::float::Float;
    use crate::proof::ProofRng;
    use crate::scalar::Scalar;

    /// Points at which values are computed.
    const POINTS: usize = 256;
    /// Size below which a value is taken for 0.
    const TINY: f64 = 1e-12;

    /// A random value of two inputs, made with moduli and roots that may cancel.
    fn value(inputs: &[Expr], draw: &mut dyn FnMut() -> u64) -> Expr {
        let mut made = inputs.to_vec();
        for _ in 0..5 {
            let mut pick = || made[draw() as usize % made.len()];
            let (a, b) = (pick(), pick());
            let new = match draw() % 8 {
                0 => a + b,
                1 => a - b,
                2 => a * b,
                3 => a.modulus() + b,
                4 => a.modulus() - a,
                5 => (a * a + b * b).sqrt(),
                6 => (a * a).sqrt() - b,
                _ => (a + b).cos(),
            };
            made.push(new);
        }
        made[made.len() - 1]
    }

    /// Values at random points; NaN where there is none.
    fn at_points(graph: &Graph, outputs: &[Expr]) -> Vec<[f64; POINTS]> {
        let tape = Tape::new(graph, outputs);
        let mut evaluator = Evaluator::new(&tape, Float::<POINTS>);
        let mut state = 1u64;
        let mut number = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let inputs: Vec<[f64; POINTS]> =
            (0..graph.inputs()).map(|_| std::array::from_fn(|_| number())).collect();
        evaluator.run(&inputs);
        evaluator.outputs().copied().collect()
    }

    #[test]
    fn a_value_that_no_choice_of_signs_makes_0_vanishes_on_no_open_set() {
        let (mut settled, mut open) = (0, 0);
        for seed in 0..600u64 {
            let mut rng = ProofRng::new(seed, 43);
            let mut draw = move || (0..5).fold(0, |n, _| 2 * n + u64::from(rng.coin()));
            let (graph, own) = record(2, |inputs| value(inputs, &mut draw)).expect("records");
            let found = with_all_signs(&graph, &[own], &[]).expect("records");
            let Some(SignChoices { graph: all, values: choices }) = found else { continue };
            let values = at_points(&all, &choices.concat());
            let is_regular = |lane: usize| values.iter().all(|value| value[lane].abs() > TINY);
            let vanishing = at_points(&graph, &[own])[0].iter().filter(|x| x.abs() < TINY).count();
            match (0..POINTS).any(is_regular) {
                true => {
                    assert_eq!(vanishing, 0, "seed {seed} is 0 on a part of its points");
                    settled += 1;
                }
                false => open += usize::from(vanishing > 0),
            }
        }
        assert!(settled > 150 && open > 40, "{settled} are not 0, {open} are 0 on a part");
    }
}
