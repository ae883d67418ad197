//! Ranks of matrices on all parts of the states: a determinant that is not 0 at one state may still be 0
//! on a cell of signs of moduli and roots, or for one of the listed values.
//!
//! docs/soundness-levels.md, "Ranks on all cells".

use super::conjugates::{SignChoices, columns_with_few_signs, with_all_signs};
use super::coverage::{RANK_BITS, proved_rank};
use super::judging::Judging;
use super::sampler::Sampler;
use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, literally, record};
use crate::mechanics::combinations;
use crate::mechanics::elimination::{characteristic_polynomial, gram, gram_determinant};
use crate::number::UnaryFunction;
use crate::number::arb::{Approximation, ArbBall};
use crate::number::rational::Rational;
use crate::proof::{Group, Prover, Zeros, is_missing, is_nowhere_zero};
use crate::scalar::Scalar;

/// Number of states at which ranks are computed.
const STATES: u64 = 16;

/// Knowledge of the rank of a matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellRank {
    /// It is full but on sets without interior, for all listed values.
    Full,
    /// It is less on a cell that may contain states, for some listed values.
    Drops,
    /// Neither is known.
    Unknown,
}

/// Question about a rank.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RankQuestion {
    /// Whether it is full or drops.
    Known,
    /// Whether it is known to drop: that it is unknown tells as much as that it is full.
    Drops,
}

/// Largest number of operations of a sum of squared minors that is looked at on each cell of signs.
const MOST_OPERATIONS: usize = 1 << 12;
/// Number of roots from which on this number is halved for each one more.
const FEW_ROOTS: usize = 2;

/// A matrix as a function of the draws, with what exists and is not negative at the states.
pub struct DrawnMatrix<'a> {
    /// Graph of all values.
    pub graph: &'a Graph,
    /// Rows of the matrix.
    pub rows: Vec<Vec<Expr>>,
    /// Required rank.
    pub rank: usize,
    /// Values that exist at the states that count.
    pub required: Vec<Expr>,
    /// Values that are not negative at the states.
    pub facts: Vec<Expr>,
}

impl Judging<'_> {
    /// Finds whether a matrix of values has a rank at almost every state, for all listed values.
    pub(super) fn rank_on_cells(
        &self,
        sampler: &Sampler,
        (rows, rank): (&[Vec<Expr>], usize),
        requirement: &[Expr],
        question: RankQuestion,
    ) -> Result<CellRank, Fault> {
        let Some(choices) = combinations(sampler.recipes()) else { return Ok(CellRank::Unknown) };
        if sampler.is_numerical() {
            return Ok(CellRank::Unknown);
        }
        let common = self.common.required_at(sampler.kept());
        let asked = Group {
            outputs: rows.concat(),
            required: [requirement, &common].concat(),
            ..Group::default()
        };
        let width = rows.first().map_or(0, Vec::len).max(1);
        let mut all = CellRank::Full;
        for fixed in choices {
            let (graph, groups) =
                sampler.compose_groups(self.graph, std::slice::from_ref(&asked), &fixed)?;
            let Some(Group { outputs, required, facts, .. }) = groups.into_iter().next() else {
                continue;
            };
            let rows = outputs.chunks(width).map(<[Expr]>::to_vec).collect();
            let matrix = DrawnMatrix { graph: &graph, rows, rank, required, facts };
            match self.rank_of_drawn(&sampler.with(&fixed), &matrix, question)? {
                CellRank::Full => {}
                CellRank::Drops => return Ok(CellRank::Drops),
                CellRank::Unknown => all = CellRank::Unknown,
            }
        }
        Ok(all)
    }

    /// Finds the same of a matrix that is a function of the draws, with all listed values inserted.
    pub(super) fn rank_of_drawn(
        &self,
        sampler: &Sampler,
        matrix: &DrawnMatrix<'_>,
        question: RankQuestion,
    ) -> Result<CellRank, Fault> {
        let DrawnMatrix { graph, required, facts, .. } = matrix;
        let (extents, sources) = (sampler.extents(), sampler.sources());
        if required.iter().any(|value| graph.is_nowhere_defined(*value))
            || is_missing(graph, &extents, required)
            || matrix.has_rank_for_all_signs(sampler)?
        {
            return Ok(CellRank::Full);
        }
        let (made, found) = record(graph.inputs(), |inputs| {
            let reached = graph.reached(matrix.rows.iter().flatten().copied());
            let values = graph.repeated(&reached, inputs);
            let row = |row: &Vec<Expr>| {
                row.iter().map(|value| values[graph.place(*value)]).collect::<Option<Vec<Expr>>>()
            };
            let rows = matrix.rows.iter().map(row).collect::<Option<Vec<Vec<Expr>>>>()?;
            let conditions = graph.reached(required.iter().chain(facts).copied());
            let kept = literally(|| graph.repeated(&conditions, inputs));
            let all = |some: &[Expr]| {
                some.iter().map(|own| kept[graph.place(*own)]).collect::<Option<Vec<Expr>>>()
            };
            let group = Group { required: all(required)?, facts: all(facts)?, ..Group::default() };
            let one = Expr::rational(&Rational::from(1));
            Some((sum_of_squared_minors(rows, matrix.rank), one, group))
        })?;
        let Some((value, one, group)) = found else { return Ok(CellRank::Unknown) };
        // Where roots contain one another each cell takes long.
        let reached = made.reached([value]);
        let is_root = |(step, reached): &(Step<'_>, bool)| {
            *reached && matches!(step, Step::Unary(UnaryFunction::Sqrt, _))
        };
        let roots = made.steps().zip(reached).filter(is_root).count();
        if made.operations(&[value]) > MOST_OPERATIONS >> roots.saturating_sub(FEW_ROOTS) {
            return Ok(CellRank::Unknown);
        }
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        Ok(match prover.zeros(&made, value, one, &group)? {
            Zeros::Thin => CellRank::Full,
            // Bounds on boxes take the longest.
            Zeros::Unknown if question == RankQuestion::Drops => CellRank::Unknown,
            _ if is_nowhere_zero(&made, &extents, &group.facts, &[value]) => CellRank::Full,
            Zeros::OnACell => CellRank::Drops,
            Zeros::Unknown => CellRank::Unknown,
        })
    }
}

impl DrawnMatrix<'_> {
    /// Whether the matrix has its rank at one state for each choice of the signs of its roots and moduli,
    /// and is otherwise one analytic function: the product of the sums of squared minors for all choices
    /// is one, too, and not 0.
    fn has_rank_for_all_signs(&self, sampler: &Sampler) -> Result<bool, Fault> {
        let drawn = sampler.recipes();
        // The rank of fewer columns is never above that of all.
        let columns = columns_with_few_signs(self.graph, &self.rows, drawn);
        if columns.len() < self.rank {
            return Ok(false);
        }
        let of_row = |row: &Vec<Expr>| columns.iter().map(|column| row[*column]).collect();
        let entries = self.rows.iter().map(of_row).collect::<Vec<Vec<Expr>>>().concat();
        let width = columns.len().max(1);
        let is_further = |value: &Expr| {
            self.graph.inputs_of(*value).into_iter().any(|input| input >= drawn.len())
        };
        if entries.iter().any(is_further) {
            return Ok(false);
        }
        let Some(SignChoices { graph, values }) = with_all_signs(self.graph, &entries, drawn)?
        else {
            return Ok(false);
        };
        let domain = ArbBall::new(RANK_BITS);
        let tape = Tape::new(&graph, &values.concat());
        let mut evaluator = Evaluator::new(&tape, domain);
        for index in 0..STATES {
            let mut numbers = sampler.drawn(&domain, 1, index);
            numbers.truncate(graph.inputs());
            evaluator.run(&numbers);
            let values: Vec<Option<Approximation>> = evaluator.outputs().cloned().collect();
            // Without the slopes by a variable at rest, which may have no value, the others have to do.
            let has_value =
                |column: &usize| values.iter().skip(*column).step_by(width).all(Option::is_some);
            let columns: Vec<usize> = (0..width).filter(has_value).collect();
            let has_rank = |values: &[Option<Approximation>]| {
                let of_row = |row: &[Option<Approximation>]| {
                    columns.iter().filter_map(|column| row[*column].clone()).collect()
                };
                proved_rank(values.chunks(width).map(of_row).collect()) >= self.rank
            };
            if values.chunks(entries.len().max(1)).all(has_rank) {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

/// The sum of the squares of all minors of this size, 0 where the rank is less.
fn sum_of_squared_minors(rows: Vec<Vec<Expr>>, rank: usize) -> Expr {
    let columns: Vec<Vec<Expr>> = match rows.first() {
        Some(first) => (0..first.len()).map(|k| rows.iter().map(|row| row[k]).collect()).collect(),
        None => Vec::new(),
    };
    let fewer = if columns.len() < rows.len() { columns } else { rows };
    if fewer.len() == rank {
        return gram_determinant(&fewer);
    }
    let coefficients = characteristic_polynomial(&gram(&fewer));
    let of_rank = rank.checked_sub(1).and_then(|index| coefficients.get(index).copied());
    match of_rank {
        Some(value) => value,
        None => Expr::rational(&Rational::from(i64::from(rank == 0))),
    }
}
