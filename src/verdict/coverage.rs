//! Coverage of the level set by a parametrisation, by the rank of its derivative.

use num_dual::Dual;
use num_traits::{One, Zero};

use crate::case::Case;
use crate::claim::LevelSubset;
use crate::graph::{Evaluator, Expr, Fault, Graph, Tape, literally, record};
use crate::mechanics::DrawSource;
use crate::number::Domain;
use crate::number::arb::{Approximation, ArbBall};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Number of states at which the rank is computed, followed by the precision in bits.
const STATES: u64 = 8;
pub const RANK_BITS: u32 = 512;

/// The derivative of a chart at a point.
pub struct Slopes {
    /// Derivatives by the inputs of the chart, a row for each.
    pub rows: Vec<Vec<Expr>>,
    /// The point.
    pub point: Vec<Expr>,
}

/// The derivative of a case's chart with respect to its inputs, by rows, and its value, as functions of the
/// draws; listed values may be inserted.
pub fn slopes(
    case: &Case,
    draws: usize,
    parameter_draws: usize,
    fixed: &[Option<Rational>],
) -> Result<(Graph, Slopes), Fault> {
    let model = &case.model;
    let level = LevelSubset::level(model);
    record(draws, |numbers| {
        let choice = fixed.iter().chain(std::iter::repeat(&None));
        let at = |(number, value): (&Expr, &Option<Rational>)| {
            value.as_ref().map_or(*number, Expr::rational)
        };
        let numbers: Vec<Expr> = numbers.iter().zip(choice).map(at).collect();
        let (parameters, state) = model.make_parameters(&numbers);
        let point = literally(|| case.chart.point(model, &level.kept, &parameters, state));
        let parameters: Vec<Dual<Expr>> = parameters.into_iter().map(Dual::from_re).collect();
        let row = |seeded: usize| {
            let slope = |k| if k == seeded { Expr::one() } else { Expr::zero() };
            let lifted: Vec<Dual<Expr>> =
                state.iter().enumerate().map(|(k, x)| Dual::new(*x, slope(k))).collect();
            let point = case.chart.point(model, &level.kept, &parameters, &lifted);
            point.into_iter().map(|component| component.eps).collect()
        };
        Slopes { rows: (0..draws - parameter_draws).map(row).collect(), point }
    })
}

/// Bounds from below the rank of the chart's derivative with respect to its inputs, by enclosures
/// at some state; `None` if the chart has a value at none of them.
pub fn rank(
    case: &Case,
    draws: &DrawSource,
    parameter_draws: usize,
    seed: u64,
) -> Result<Option<usize>, Fault> {
    let (graph, slopes) = slopes(case, draws.len(), parameter_draws, &[])?;
    let tape = Tape::new(&graph, &slopes.rows.concat());
    let domain = ArbBall::new(RANK_BITS);
    let mut evaluator = Evaluator::new(&tape, domain);
    let rank_at = |index: u64| {
        let point = draws.state(seed, index).into_iter().map(|value| domain.values(&[value]));
        evaluator.run(&point.collect::<Vec<_>>());
        let slopes: Option<Vec<Approximation>> = evaluator.outputs().cloned().collect();
        let width = case.model.dimension().max(1);
        slopes.map(|slopes| proved_rank(slopes.chunks(width).map(<[_]>::to_vec).collect()))
    };
    Ok((0..STATES).filter_map(rank_at).max())
}

/// Number of pivots of an elimination that are known not to be 0.
pub fn proved_rank(mut rows: Vec<Vec<Approximation>>) -> usize {
    let width = rows.first().map_or(0, Vec::len);
    let mut rank = 0;
    let mut columns: Vec<usize> = (0..width).collect();
    while rank < rows.len() {
        // Choose the largest entry known not to be 0.
        let size = |x: &Approximation| if x.excludes_zero() { x.enclosure().0.abs() } else { -1.0 };
        let entries = (rank..rows.len()).flat_map(|i| columns.iter().map(move |j| (i, *j)));
        let best = entries.max_by(|a, b| size(&rows[a.0][a.1]).total_cmp(&size(&rows[b.0][b.1])));
        let Some((row, column)) = best.filter(|(i, j)| rows[*i][*j].excludes_zero()) else { break };
        rows.swap(rank, row);
        columns.retain(|j| *j != column);
        let (above, below) = rows.split_at_mut(rank + 1);
        let pivot = &above[rank];
        let Some(inverse) = pivot[column].recip(RANK_BITS) else { break };
        for row in below {
            let factor = row[column].mul(&inverse, RANK_BITS);
            for j in &columns {
                row[*j] = row[*j].add(&factor.mul(&pivot[*j], RANK_BITS).neg(), RANK_BITS);
            }
        }
        rank += 1;
    }
    rank
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_no_rank() {
        let domain = ArbBall::new(RANK_BITS);
        let third = Rational::new(1, 3);
        let rows = |rows: [[Rational; 2]; 2]| {
            rows.map(|row| row.map(|x| domain.rational(&x)).to_vec()).to_vec()
        };
        let one = Rational::from(1);
        let thirds = rows([[third.clone(), one.clone()], [one.clone(), Rational::from(3)]]);
        assert_eq!(proved_rank(thirds), 1, "the second row is three times the first");
        let regular = rows([[third, one.clone()], [one, Rational::from(4)]]);
        assert_eq!(proved_rank(regular), 2);
    }
}
