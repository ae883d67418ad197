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

/// Lists the places whose signs may be changed, if values are otherwise analytic on one connected complex
/// domain: they are built by arithmetic, exp, sin, cos, by roots, logarithms and powers of affine
/// functions, and by moduli and square roots of such values. `None` for others.
pub fn changing_signs(graph: &Graph, values: &[Expr], inputs: &[Draw]) -> Option<Vec<usize>> {
    let reached = graph.reached(values.iter().copied());
    let mut is_affine = vec![false; reached.len()];
    let mut places = Vec::new();
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        let is_constant = |place: usize| matches!(graph.step(place), Step::Constant(_));
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
) -> Result<Option<(Graph, Vec<Vec<Expr>>)>, Fault> {
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
    Ok(found.map(|found| (made, found)))
}
