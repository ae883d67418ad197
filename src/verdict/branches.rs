//! Completeness of solved level sets: where a divisor vanishes together with the remaining terms,
//! the solution misses a part of the level.
//!
//! For example, x (y² + z² − 1) = 0 is solved by x = 0 where y² + z² ≠ 1, and the cylinder is
//! another part.

use std::cell::LazyCell;

use super::cell_rank::{CellRank, DrawnMatrix, RankQuestion};
use super::coverage::{self, Slopes};
use super::judging::Judging;
use super::pivot_space::PivotSpace;
use super::sampler::Sampler;
use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, record};
use crate::level::Solution;
use crate::mechanics::{Chart, Draw, combinations};
use crate::number::Enclosing;
use crate::number::mixed::{Mixed, Number};
use crate::number::rational::Rational;
use crate::proof::{Group, Prover, are_coprime, are_polynomials, is_single_valued};
use crate::scalar::Scalar;

/// Number of states at which a divisor is tried.
const STATES: u64 = 16;

/// Values of the listed numbers and of the signs of roots, by draw.
type Choice = Vec<Option<Rational>>;

/// Knowledge of the states of a place, or of a branch of it, from one solution.
pub struct Missed {
    branch: Option<usize>,
    solution: Solution,
    /// Reason why they may miss a part, if they may.
    reason: Option<String>,
}

/// Lists all choices of listed numbers and signs; `None` if there are too many.
fn choices(recipes: &[Draw]) -> Option<Vec<Choice>> {
    let listed = |draw: &Draw| match draw {
        Draw::Sign => Draw::OneOf(vec![Rational::from(-1), Rational::from(1)]),
        draw => draw.clone(),
    };
    combinations(&recipes.iter().map(listed).collect::<Vec<Draw>>())
}

/// Records values anew with some inputs fixed; no values if one of them has none.
fn fixed(
    graph: &Graph,
    values: &[Expr],
    choice: &[Option<Rational>],
) -> Result<(Graph, Vec<Expr>), Fault> {
    let reached = graph.reached(values.iter().copied());
    let (graph, made) = record(graph.inputs(), |inputs| {
        let mut inputs = inputs.to_vec();
        for (input, value) in inputs.iter_mut().zip(choice) {
            if let Some(value) = value {
                *input = Expr::rational(value);
            }
        }
        let made = graph.repeated(&reached, &inputs);
        values.iter().map(|value| made[graph.place(*value)]).collect::<Option<Vec<Expr>>>()
    })?;
    Ok((graph, made.unwrap_or_default()))
}

impl Judging<'_> {
    /// Returns the reason why states may miss a part of their place, if they may.
    pub(super) fn missed_part(&self, sampler: &Sampler) -> Result<Option<String>, Fault> {
        let Some(solution) = sampler.solution() else { return self.thin_image(sampler) };
        let branch = sampler.branch().map(|branch| branch.number);
        let is_same = |own: &&Missed| own.branch == branch && own.solution == *solution;
        let known = self.missed.borrow();
        if let Some(known) = known.get(sampler.kept()).and_then(|all| all.iter().find(is_same)) {
            return Ok(known.reason.clone());
        }
        drop(known);
        let reason = self.find_missed_part(sampler, solution)?;
        let (solution, found) = (solution.clone(), reason.clone());
        let mut missed = self.missed.borrow_mut();
        missed.entry(sampler.kept().to_vec()).or_default().push(Missed {
            branch,
            solution,
            reason,
        });
        Ok(found)
    }

    /// Returns the reason why a part of the image of a given chart may have no interior, for some listed
    /// values or signs of moduli: motions may leave it.
    fn thin_image(&self, sampler: &Sampler) -> Result<Option<String>, Fault> {
        let case = self.case;
        let is_charted = matches!(case.chart, Chart::Given(_))
            && !sampler.kept().is_empty()
            && sampler.kept().iter().all(|kept| *kept);
        if !is_charted {
            return Ok(None);
        }
        if let Some(known) = self.thin_image.get() {
            return Ok(known.clone());
        }
        let found = self.find_thin_image(sampler)?;
        Ok(self.thin_image.get_or_init(|| found).clone())
    }

    fn find_thin_image(&self, sampler: &Sampler) -> Result<Option<String>, Fault> {
        let case = self.case;
        let Some(choices) = combinations(sampler.recipes()) else {
            return Ok(Some(
                "there are too many combinations of listed values to know whether each image of [level.chart] has \
                 all dimensions of the level"
                    .to_string(),
            ));
        };
        let rank = case.model.dimension().saturating_sub(case.model.level.len());
        let (draws, parameters) = (sampler.recipes().len(), sampler.parameter_draws());
        for fixed in choices {
            let (graph, Slopes { rows, point }) =
                coverage::slopes(case, draws, parameters, &fixed)?;
            let (required, facts) = (point, Vec::new());
            let matrix = DrawnMatrix { graph: &graph, rows, rank, required, facts };
            let chosen = sampler.with(&fixed);
            let what = match self.rank_of_drawn(&chosen, &matrix, RankQuestion::Known)? {
                CellRank::Full => continue,
                CellRank::Drops => "has fewer dimensions than the level",
                CellRank::Unknown => "is not known to have all dimensions of the level",
            };
            return Ok(Some(format!(
                "a part of the image of [level.chart] {what}, so that the motion may leave it: write the \
                 chart without |…|, or give ranges in which what is in |…| keeps its sign"
            )));
        }
        Ok(None)
    }

    fn find_missed_part(
        &self,
        sampler: &Sampler,
        solution: &Solution,
    ) -> Result<Option<String>, Fault> {
        if sampler.pivots().is_empty() {
            return Ok(None);
        }
        let space = PivotSpace::of(self.case, sampler, solution)?;
        let count = space.pivots.len();
        let mut open: Vec<usize> = (0..count).collect();
        // Each choice of listed values, and of signs of roots, has a level of its own.
        if let Some(choices) = choices(sampler.recipes()) {
            let mut is_complete = true;
            open.clear();
            for index in 0..count {
                let pivot = &sampler.pivots()[index];
                let own = &space.pivots[index];
                let is_thin = self.is_thin(sampler, pivot.divisor, &choices)?;
                let is_number = is_thin && self.is_number(sampler, pivot.divisor)?;
                // Bounds on boxes take the longest: they are asked for where nothing else tells.
                let is_strong = LazyCell::new(|| is_number || space.have_no_zero(&[own.divisor]));
                // Factors do no harm if they have no common factor, as functions on a level of
                // which the steps before miss nothing.
                let is_coprime = || self.has_no_factor(sampler, &space, solution, index, &choices);
                let is_whole = is_number
                    || (is_thin
                        && (self.is_number(sampler, pivot.slope)?
                            || self.is_number(sampler, pivot.whole)?
                            || (is_complete && is_coprime()?)))
                    || *is_strong
                    || (is_thin && space.is_definite(own, self.options.seed)?);
                if !is_whole {
                    open.push(index);
                }
                is_complete = is_complete && (index + 1 == count || *is_strong);
            }
        }
        let texts: Vec<String> = open
            .iter()
            .flat_map(|index| &space.pivots[*index].equations)
            .map(|index| format!("`{}`", self.case.model.level[*index].text))
            .collect();
        Ok((!texts.is_empty()).then(|| {
            format!(
                "the level may fall apart: {} {} solved where what is divided by is not 0, and may \
                 hold elsewhere too; state each part in a case of its own, or give [level.chart]",
                texts.join(" and "),
                if texts.len() == 1 { "is" } else { "are" },
            )
        }))
    }

    /// Whether a divisor is known to vanish on no open set of states, for each choice: z + |z| does
    /// for z < 0, and x − y on a branch of x² = y².
    fn is_thin(&self, sampler: &Sampler, divisor: Expr, choices: &[Choice]) -> Result<bool, Fault> {
        let graph = sampler.graph();
        let reached = graph.reached([divisor]);
        let recipes = sampler.recipes();
        let has_sign = graph.steps().zip(&reached).any(|(step, reached)| match step {
            Step::Input(input) => *reached && matches!(recipes.get(input), Some(Draw::Sign)),
            _ => false,
        });
        let (extents, sources) = (sampler.extents(), sampler.sources());
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        for choice in choices {
            let is_nonzero = match !has_sign && is_single_valued(graph, &[divisor]) {
                true => self.is_nonzero_somewhere(&sampler.with(choice), divisor),
                false => {
                    let (graph, values) = fixed(graph, &[divisor], choice)?;
                    match values[..] {
                        [divisor] => prover.is_nonzero_on_all_cells(&graph, divisor)?,
                        _ => false,
                    }
                }
            };
            if !is_nonzero {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether a value is proved not to be 0 at a state.
    fn is_nonzero_somewhere(&self, sampler: &Sampler, value: Expr) -> bool {
        let domain = Mixed::new(256);
        let tape = Tape::new(sampler.graph(), &[value]);
        let mut evaluator = Evaluator::new(&tape, domain);
        (0..STATES).any(|index| {
            evaluator.run(&sampler.drawn(&domain, 1, index));
            Mixed::excludes_zero(evaluator.output(0), 0)
        })
    }

    /// Whether the slopes and the constant term of a linear equation are known to have no common
    /// factor, as functions of free coordinates, for each choice.
    fn has_no_factor(
        &self,
        sampler: &Sampler,
        space: &PivotSpace,
        solution: &Solution,
        index: usize,
        choices: &[Choice],
    ) -> Result<bool, Fault> {
        let (seed, drawn) = (self.options.seed, &sampler.pivots()[index].entries);
        let own = &space.pivots[index];
        if own.entries.is_empty() {
            return Ok(false);
        }
        let first = sampler.parameter_draws();
        let reached = space.graph.reached(own.entries.iter().copied());
        let made = solution.components();
        let is_made = |(place, reached): (usize, &bool)| match space.graph.step(place) {
            Step::Input(input) if *reached => {
                input.checked_sub(first).is_some_and(|component| made.contains(&component))
            }
            _ => false,
        };
        let has_made = reached.iter().enumerate().any(is_made);
        for choice in choices {
            let (graph, entries) = match has_made {
                false => fixed(&space.graph, &own.entries, &choice[..first])?,
                true => fixed(sampler.graph(), drawn, choice)?,
            };
            let is_known = entries.len() == own.entries.len()
                && (!has_made || are_polynomials(&graph, &entries))
                && are_coprime(&graph, &entries, seed);
            if !is_known {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether a value is the same nonzero number at all states, as |γ|² is on the sphere; by
    /// continuity it is that at all points of the level.
    fn is_number(&self, sampler: &Sampler, value: Expr) -> Result<bool, Fault> {
        let (graph, domain) = (sampler.graph(), Mixed::new(256));
        if let Some(constant) = graph.constant_value(value) {
            return Ok(!constant.is_zero());
        }
        let tape = Tape::new(graph, &[value]);
        let mut evaluator = Evaluator::new(&tape, domain);
        evaluator.run(&sampler.drawn(&domain, 1, 0));
        let guess = match evaluator.output(0) {
            Number::Exact(number) => Some(number.clone()),
            value => Mixed::enclosure(value, 0).and_then(|(mid, _)| simple(mid)),
        };
        let Some(number) = guess.filter(|number| !number.is_zero()) else { return Ok(false) };
        let reached = graph.reached([value]);
        let (graph, difference) = record(graph.inputs(), |inputs| {
            let values = graph.repeated(&reached, inputs);
            Some(values[graph.place(value)]? - Expr::rational(&number))
        })?;
        let Some(difference) = difference else { return Ok(false) };
        let (extents, sources) = (sampler.extents(), sampler.sources());
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        let outcomes = prover.prove(&graph, &[Group::of(vec![difference])])?;
        Ok(outcomes.iter().all(|outcome| outcome.is_zero()))
    }
}

/// Finds the simple fraction closest to a number, if it is nearly one.
fn simple(value: f64) -> Option<Rational> {
    const LARGEST: f64 = 1e4;
    let (mut rest, mut before, mut last) = (value, (0.0, 1.0), (1.0, 0.0));
    loop {
        let whole = rest.floor();
        (before, last) = (last, (whole * last.0 + before.0, whole * last.1 + before.1));
        if last.1 > LARGEST || !last.0.is_finite() {
            return None;
        }
        if (last.0 / last.1 - value).abs() <= 16.0 * f64::EPSILON * value.abs() {
            return (last.0.abs() < 1e9).then(|| Rational::new(last.0 as i64, last.1 as i64));
        }
        rest = 1.0 / (rest - whole);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simple_fractions_are_recognised() {
        let fraction = |n, d| Some(Rational::new(n, d));
        assert_eq!(simple(4.0 + 1e-15), fraction(4, 1));
        assert_eq!(simple(-1.0 / 3.0), fraction(-1, 3));
        assert_eq!(simple(22.0 / 7.0), fraction(22, 7));
        assert_eq!(simple(std::f64::consts::PI), None);
    }
}
