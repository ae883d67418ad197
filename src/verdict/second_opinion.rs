//! Check of proofs by enclosures at states with many combinations of signs.
//!
//! A proof with roots and moduli is about cells, one for each combination of signs. The states of
//! the first block may all lie in one of them. States in further cells are drawn inside and at the
//! ends of the ranges, and then found by bisection between two states whose signs differ. The
//! residual is enclosed at each of them. An enclosure that excludes 0 contradicts the proof; that
//! is an error of the program, and is reported as one.

use std::collections::VecDeque;

use num_integer::Integer;
use rustc_hash::FxHashSet;

use super::antiderivative_value;
use super::claim_state::{ClaimState, undecide};
use super::evidence::Verdict;
use super::judging::Judging;
use super::ladder::Open;
use super::recorded::RecordedClaim;
use super::sampler::{Sampler, TAPE_LANES};
use super::witness::witness;
use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape};
use crate::mechanics::Draw;
use crate::number::ball::{Ball, Balls};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, Domain, UnaryFunction};
use crate::proof::Group;

/// Largest number of values whose signs are distinguished.
const MOST_SIGNS: usize = 32;
/// Number of blocks of states drawn inside the ranges, and of those drawn at their ends.
const BLOCKS: u64 = 1;
/// Largest number of blocks of states found by bisection.
const MOST_BLOCKS_BETWEEN: usize = 12;
/// Largest number of pairs of states for bisection, followed by that of halvings for each.
const MOST_PAIRS: usize = 32;
const MOST_HALVINGS: u32 = 24;

/// One number for each draw: an f64, and whether it is exact.
type Numbers = Vec<(f64, bool)>;

/// Signs at a state, two bits each; `None` where there is no state.
type Signs = Option<u64>;

/// A contradiction: the drawn numbers, and an enclosure of the residual.
type Contradiction = (Numbers, (f64, f64));

impl Judging<'_> {
    /// Encloses the residuals of proved claims in all cells found; a contradiction leaves the claim
    /// undecided.
    pub(super) fn second_opinion(
        &self,
        sampler: &Sampler,
        open: &mut Open<'_, '_>,
    ) -> Result<(), Fault> {
        let is_proved =
            |status: &ClaimState| status.settled == Some(Verdict::Proved) && status.is_zero;
        if sampler.is_numerical() || !open.iter().any(|(_, status)| is_proved(status)) {
            return Ok(());
        }
        let of_states = signs(sampler.graph(), sampler.made().iter().copied());
        if of_states.is_empty() && !self.graph.steps().any(has_sign) {
            return Ok(());
        }
        for (item, status) in open.iter_mut() {
            if !is_proved(status) || (of_states.is_empty() && !self.has_cells(item)) {
                continue;
            }
            if let Some((numbers, residual)) = self.contradiction(sampler, item)? {
                let exact = |(value, _): &(f64, bool)| Rational::from_f64(*value);
                let numbers: Option<Vec<Rational>> = numbers.iter().map(exact).collect();
                let printed = sampler.printed_from(&numbers.unwrap_or_default(), BITS_PRINTED);
                let found = witness(self.case, None, &printed, residual);
                let parameters: Vec<String> = found
                    .parameters
                    .iter()
                    .map(|(name, value)| format!("{name}={value}"))
                    .collect();
                status.evidence.proof = None;
                undecide(
                    status,
                    format!(
                        "internal error: a proof contradicts the residual {:.3e} ± {:.1e} at {} {}; \
                         please report this file",
                        residual.0,
                        residual.1,
                        parameters.join(" "),
                        found.state
                    ),
                );
            }
        }
        Ok(())
    }

    /// Whether a proof of the claim has more than one cell, as far as its expressions show; the states
    /// may add others.
    fn has_cells(&self, item: &RecordedClaim<'_>) -> bool {
        let outputs = [&item.residual[..], &item.requirement].concat();
        self.graph.has_step(&outputs, has_sign) && !signs(self.graph, outputs).is_empty()
    }

    /// Searches for a state at which the residual is not 0.
    fn contradiction(
        &self,
        sampler: &Sampler,
        item: &RecordedClaim<'_>,
    ) -> Result<Option<Contradiction>, Fault> {
        let required = [&item.requirement[..], &self.common.required_at(sampler.kept())].concat();
        let group = Group { outputs: item.residual.clone(), required, ..Group::default() };
        let open = vec![None; sampler.recipes().len()];
        let (graph, groups) = sampler.compose_groups(self.graph, &[group], &open)?;
        let Some(group) = groups.into_iter().next() else { return Ok(None) };
        let mut states = Vec::new();
        for start in 0..BLOCKS {
            let indices = (1 + start) * TAPE_LANES as u64..(2 + start) * TAPE_LANES as u64;
            states.extend(indices.clone().map(|index| sampler.nearest_draws(index)));
            states.extend(indices.map(|index| sampler.nearest_edge(index)));
        }
        Ok(contradiction_among(&graph, &group, sampler.recipes(), states))
    }
}

/// Searches for a state at which the outputs of a group are not 0, among given ones and between them.
fn contradiction_among(
    graph: &Graph,
    group: &Group,
    recipes: &[Draw],
    states: Vec<Numbers>,
) -> Option<Contradiction> {
    let all = group.outputs.iter().chain(&group.required).copied();
    let signs = signs(graph, all.clone());
    let facts = group.facts.iter().copied();
    let outputs: Vec<Expr> =
        signs.iter().map(|place| graph.at(*place)).chain(facts).chain(all).collect();
    let tape = Tape::new(graph, &outputs);
    let free = graph.inputs().saturating_sub(recipes.len());
    let is_range = |draw: &Draw| matches!(draw, Draw::Within(_) | Draw::Of(..));
    let mut search = SignSearch {
        evaluator: Evaluator::new(&tape, Ball::<TAPE_LANES>),
        is_range: recipes.iter().map(is_range).collect(),
        further: (0..free).map(|k| Ball::<TAPE_LANES>.constant(&antiderivative_value(k))).collect(),
        signs: signs.len(),
        facts: group.facts.len(),
        residuals: group.outputs.len(),
    };
    search.run(states)
}

/// Precision in bits of a printed state that contradicts a proof.
const BITS_PRINTED: u32 = 53;

/// A search for states with further combinations of signs.
struct SignSearch<'t> {
    evaluator: Evaluator<'t, Ball<TAPE_LANES>>,
    /// Whether each draw is from a range.
    is_range: Vec<bool>,
    /// Values of antiderivatives, which follow the draws.
    further: Vec<Balls<TAPE_LANES>>,
    signs: usize,
    /// Number of values that are not negative at a state.
    facts: usize,
    residuals: usize,
}

impl SignSearch<'_> {
    /// Tests some states, and states between those whose signs differ.
    fn run(&mut self, states: Vec<Numbers>) -> Option<Contradiction> {
        let mut signs = Vec::with_capacity(states.len());
        for block in states.chunks(TAPE_LANES) {
            match self.signs_at(block) {
                Ok(found) => signs.extend(found),
                Err(contradiction) => return Some(contradiction),
            }
        }
        let first: Vec<(Numbers, Signs)> = states.into_iter().zip(signs).collect();
        let differ = |pair: &&[(Numbers, Signs)]| pair[0].1 != pair[1].1;
        let pairs = first.windows(2).filter(differ).take(MOST_PAIRS);
        let mut open: VecDeque<_> =
            pairs.map(|pair| (pair[0].clone(), pair[1].clone(), MOST_HALVINGS)).collect();
        for _ in 0..MOST_BLOCKS_BETWEEN {
            let taken: Vec<_> = open.drain(..open.len().min(TAPE_LANES)).collect();
            if taken.is_empty() {
                return None;
            }
            let between: Vec<Numbers> =
                taken.iter().map(|(a, b, _)| self.middle(&a.0, &b.0)).collect();
            let found = match self.signs_at(&between) {
                Ok(signs) => signs,
                Err(contradiction) => return Some(contradiction),
            };
            for (((a, b, left), numbers), signs) in taken.into_iter().zip(between).zip(found) {
                let mid = (numbers, signs);
                if left > 0 && a.1 != signs {
                    open.push_back((a, mid.clone(), left - 1));
                }
                if left > 0 && b.1 != signs {
                    open.push_back((mid, b, left - 1));
                }
            }
        }
        None
    }

    /// Returns the signs at a block of states; fails with a state that contradicts the proof.
    fn signs_at(&mut self, states: &[Numbers]) -> Result<Vec<Signs>, Contradiction> {
        let last = states.len() - 1;
        let width = states[0].len();
        let column = |k: usize| Balls::about(|lane| states[lane.min(last)][k]);
        let mut columns: Vec<Balls<TAPE_LANES>> = (0..width).map(column).collect();
        columns.extend(self.further.iter().cloned());
        self.evaluator.run(&columns);
        let outputs: Vec<&Balls<TAPE_LANES>> = self.evaluator.outputs().collect();
        let (signs, values) = outputs.split_at(self.signs);
        let (facts, values) = values.split_at(self.facts);
        let (residuals, required) = values.split_at(self.residuals);
        let may_hold = |block: &Balls<TAPE_LANES>, lane: usize| {
            block.is_defined(lane) && block.mid[lane] + block.rad[lane] >= 0.0
        };
        let mut found = Vec::with_capacity(states.len());
        for (lane, numbers) in states.iter().enumerate() {
            let may_be_state = required.iter().all(|block| block.is_defined(lane))
                && facts.iter().all(|block| may_hold(block, lane));
            if !may_be_state {
                found.push(None);
                continue;
            }
            let away = residuals.iter().find(|block| block.excludes_zero(lane));
            // At the end of a range it may be unknown whether there is a state.
            let is_state = facts.iter().all(|block| block.mid[lane] >= block.rad[lane]);
            if let Some(away) = away
                && is_state
                && residuals.iter().all(|residual| residual.is_defined(lane))
            {
                return Err((numbers.clone(), (away.mid[lane], away.rad[lane])));
            }
            let code = |block: &Balls<TAPE_LANES>| match block.excludes_zero(lane) {
                true => 1 + u64::from(block.mid[lane] > 0.0),
                false => 0,
            };
            let all = signs.iter().fold(0, |all, block| all << 2 | code(block));
            found.push(Some(all));
        }
        Ok(found)
    }

    /// Returns the midpoint of two states, with the listed values of the first.
    fn middle(&self, a: &Numbers, b: &Numbers) -> Numbers {
        let half = |a: &(f64, bool), b: &(f64, bool), is_range: bool| match is_range {
            true => (a.0 + (b.0 - a.0) / 2.0, true),
            false => *a,
        };
        let pairs = a.iter().zip(b).zip(&self.is_range);
        pairs.map(|((a, b), is_range)| half(a, b, *is_range)).collect()
    }
}

/// Whether a step may have values below it whose signs divide the states into cells.
fn has_sign(step: Step<'_>) -> bool {
    match step {
        Step::Unary(function, _) => matches!(function, UnaryFunction::Abs | UnaryFunction::Sqrt),
        Step::Power(_, exponent) => exponent.to_integer().is_none(),
        _ => false,
    }
}

/// Finds the places of values whose signs divide the states into cells: arguments of moduli, and
/// factors under roots of even index.
fn signs(graph: &Graph, outputs: impl IntoIterator<Item = Expr>) -> Vec<usize> {
    let reached = graph.reached(outputs);
    let mut found = Vec::new();
    let mut seen = FxHashSet::default();
    let mut add = |place: usize| {
        if seen.insert(place) && !matches!(graph.step(place), Step::Constant(_)) {
            found.push(place);
        }
    };
    for (_, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        match step {
            Step::Unary(UnaryFunction::Abs, argument) => add(argument),
            Step::Unary(UnaryFunction::Sqrt, radicand) => factors(graph, radicand, &mut add),
            Step::Power(radicand, exponent)
                if exponent.to_integer().is_none() && exponent.parts().1.is_even() =>
            {
                factors(graph, radicand, &mut add);
            }
            _ => {}
        }
    }
    found.truncate(MOST_SIGNS);
    found
}

/// Finds the factors of a radicand that may change sign where the radicand does not.
fn factors(graph: &Graph, radicand: usize, add: &mut impl FnMut(usize)) {
    let mut open = vec![radicand];
    while let Some(place) = open.pop() {
        match graph.step(place) {
            Step::Binary(BinaryOperation::Mul, a, b) => open.extend([a, b]),
            Step::Unary(UnaryFunction::Neg | UnaryFunction::Recip, a) | Step::Power(a, _) => {
                open.push(a)
            }
            // the sign of the whole radicand is known
            _ if place == radicand => {}
            _ => add(place),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::record;
    use crate::mechanics::Range;
    use crate::scalar::Scalar;
    use num_dual::DualNum;

    /// Finds the value at a state that contradicts `identity` = 0, with x in a range and y in 1..2.
    fn found(range: [i64; 2], scale: i64, identity: fn(&Expr, &Expr) -> Expr) -> Option<f64> {
        let (graph, residual) =
            record(2, |inputs| identity(&inputs[0], &inputs[1])).expect("records");
        let [low, high] = range.map(|end| Rational::new(end, scale));
        let one = |low: Rational, high: Rational| Draw::Within(Range { low, high });
        let recipes = [one(low, high), one(1.into(), 2.into())];
        let group = Group::of(vec![residual]);
        assert!(!signs(&graph, [residual]).is_empty(), "there are cells");
        let [low, high] = range.map(|end| end as f64 / scale as f64);
        // Evenly inside the ranges, and at the ends of that of x.
        let inside = (0..64).map(|k| (f64::from(k) + 0.5) / 64.0);
        let edges = (0..64).map(|k| f64::from(k % 2));
        let states = inside.chain(edges).enumerate().map(|(k, share)| {
            let y = 1.0 + (k as f64 * 0.618_034).fract();
            vec![(low + share * (high - low), true), (y, true)]
        });
        contradiction_among(&graph, &group, &recipes, states.collect())
            .map(|(_, (residual, _))| residual)
    }

    fn number(numerator: i64, denominator: i64) -> Expr {
        Expr::rational(&Rational::new(numerator, denominator))
    }

    #[test]
    fn cells_at_the_end_of_a_range_are_looked_at() {
        let near = found([-1, 20_000], 10_000, |x, _| x.modulus() - *x);
        assert!(near.is_some_and(|residual| residual > 0.0), "|x| = x");
        let far = found([-1, 2_000_000], 1, |x, y| (*x * *x * *y).sqrt() - *x * y.sqrt());
        assert!(far.is_some(), "√(x² y) = x √y");
    }

    #[test]
    fn thin_cells_between_two_others_are_looked_at() {
        let thin = found([0, 2], 1, |x, _| {
            let [low, high] = [number(7, 5), number(140_001, 100_000)];
            (*x - low).modulus() + (*x - high).modulus()
                - (number(2, 1) * *x - number(280_001, 100_000)).modulus()
        });
        assert!(thin.is_some_and(|residual| residual > 0.0));
    }

    #[test]
    fn true_identities_are_not_contradicted() {
        let square = found([-1, 2], 1, |x, _| x.modulus() * x.modulus() - *x * *x);
        assert_eq!(square, None, "|x|² = x²");
        let root = found([-1, 2], 1, |x, y| (*x * *x * *y).sqrt() - x.modulus() * y.sqrt());
        assert_eq!(root, None, "√(x² y) = |x| √y");
    }
}
