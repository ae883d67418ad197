//! Slopes of the level equations at the states: where they depend on each other, rates that are 0 do not
//! keep the motion on the level. Rules L1 to L8 of docs/soundness-levels.md.

use super::cell_rank::{CellRank, RankQuestion};
use super::claim_state::{ClaimState, undecide};
use super::evidence::Verdict;
use super::judging::Judging;
use super::recorded::RecordedClaim;
use super::sampler::{Sampler, TAPE_LANES};
use super::witness::briefly;
use crate::claim::{OfMotions, PlaceName};
use crate::graph::{Expr, Fault};
use crate::mechanics::combinations;
use crate::number::rational::Rational;

/// An equation of the level whose slope is not known to be independent of those before it at almost every
/// state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FlatEquation {
    /// Index of the equation.
    pub index: usize,
    /// Whether it is known to depend on them at states; otherwise nothing is known.
    pub is_lost: bool,
    /// A state of the part of the level where that is so, unless the level has one part only.
    pub near: Option<String>,
}

impl Judging<'_> {
    /// Notes the equations of the user whose slope depends on those before it on an open set of states: on a
    /// cell of signs of moduli and roots, for some listed values, or on a part of the level. So does that of
    /// (x − 1)² = 0, whose rate 2(x − 1)x' is 0 at x = 1 whatever x' is.
    pub(super) fn check_slopes(&self, sampler: &Sampler) -> Result<(), Fault> {
        for found in self.flat_equations(sampler)? {
            let mut flat = self.flat.borrow_mut();
            let is_same =
                |own: &FlatEquation| (own.index, own.is_lost) == (found.index, found.is_lost);
            if !flat.iter().any(is_same) {
                let near = sampler.is_part().then(|| self.state_of(sampler)).flatten();
                flat.push(FlatEquation { near, ..found });
            }
        }
        Ok(())
    }

    /// Writes the first state in f64 that is known.
    fn state_of(&self, sampler: &Sampler) -> Option<String> {
        let blocks = sampler.balls(0);
        let is_state = |lane: &usize| blocks.iter().all(|block| block.is_defined(*lane));
        let lane = (0..TAPE_LANES).find(is_state)?;
        let model = &self.case.model;
        let state = blocks[model.free_components()..].iter().map(|block| block.mid[lane]);
        Some(briefly(model, &state.collect::<Vec<f64>>()))
    }

    /// Finds these equations among those that hold at the states of a sampler, at most one for each choice
    /// of listed values.
    pub(super) fn flat_equations(&self, sampler: &Sampler) -> Result<Vec<FlatEquation>, Fault> {
        let slopes = &self.common.slopes;
        let kept: Vec<usize> =
            (0..slopes.len()).filter(|index| sampler.kept().get(*index) == Some(&true)).collect();
        // Nothing is proved of states that are found numerically.
        if kept.is_empty() || sampler.is_numerical() || self.is_at_rest(sampler)? {
            return Ok(Vec::new());
        }
        let choices = combinations(sampler.recipes());
        let mut found = Vec::new();
        for fixed in choices.unwrap_or_else(|| vec![vec![None; sampler.recipes().len()]]) {
            let chosen = sampler.with(&fixed);
            // A part of which no state is known may still have some.
            let rank_of = |count: usize| {
                let rows: Vec<Vec<Expr>> =
                    kept[..count].iter().map(|index| slopes[*index].clone()).collect();
                self.rank_on_cells(&chosen, (&rows, count), &[], RankQuestion::Known)
            };
            if let Some(index) = self.without_slope(sampler, &kept, &fixed)? {
                found.push(FlatEquation { index, is_lost: true, near: None });
                continue;
            }
            if self.are_independent_one_by_one(&chosen, &kept)? {
                continue;
            }
            let whole = rank_of(kept.len())?;
            if whole == CellRank::Full {
                continue;
            }
            // The first of independent equations are independent: the first of those that depend is found by halves.
            let (mut independent, mut dependent) = (0, (kept.len(), whole));
            while dependent.0 - independent > 1 {
                let middle = usize::midpoint(independent, dependent.0);
                match rank_of(middle)? {
                    CellRank::Full => independent = middle,
                    other => dependent = (middle, other),
                }
            }
            if let (Some(index), rank) = (kept.get(independent), dependent.1) {
                let is_lost = rank == CellRank::Drops;
                found.push(FlatEquation { index: *index, is_lost, near: None });
            }
        }
        Ok(found)
    }

    /// Whether the slopes are independent by their zeros: one after another has slopes by variables of which those
    /// left have none, and these are not all 0. So have the links of a chain, from its end.
    ///
    /// A determinant of few rows is faster.
    fn are_independent_one_by_one(&self, sampler: &Sampler, kept: &[usize]) -> Result<bool, Fault> {
        const FEW: usize = 3;
        if kept.len() <= FEW {
            return Ok(false);
        }
        let slopes = &self.common.slopes;
        let is_zero =
            |slope: &Expr| self.graph.constant_value(*slope).is_some_and(Rational::is_zero);
        let mut left = kept.to_vec();
        while !left.is_empty() {
            let own_slopes = |index: &usize| -> Vec<Expr> {
                let is_own = |column: &usize| {
                    left.iter().all(|other| other == index || is_zero(&slopes[*other][*column]))
                };
                let columns = (0..slopes[*index].len()).filter(is_own);
                let own = columns.map(|column| slopes[*index][column]);
                own.filter(|slope| !is_zero(slope)).collect()
            };
            let mut next = None;
            for (place, index) in left.iter().enumerate() {
                let own = own_slopes(index);
                if own.is_empty() {
                    continue;
                }
                if self.rank_on_cells(sampler, (&[own], 1), &[], RankQuestion::Known)?
                    == CellRank::Full
                {
                    next = Some(place);
                    break;
                }
            }
            let Some(place) = next else { return Ok(false) };
            left.remove(place);
        }
        Ok(true)
    }

    /// Finds an equation whose slope has no value at any of the states, as that of |x − 1| = 0.
    fn without_slope(
        &self,
        sampler: &Sampler,
        kept: &[usize],
        fixed: &[Option<Rational>],
    ) -> Result<Option<usize>, Fault> {
        let slopes: Vec<Vec<Expr>> =
            kept.iter().map(|index| self.common.slopes[*index].clone()).collect();
        let (graph, slopes) = sampler.compose(self.graph, &slopes, fixed)?;
        let is_lost = |own: &Vec<Expr>| own.iter().any(|slope| graph.is_nowhere_defined(*slope));
        Ok(kept.iter().zip(&slopes).find(|(_, own)| is_lost(own)).map(|(index, _)| *index))
    }

    /// Leaves claims undecided that rest on the slopes of such equations: all but those that say nothing of
    /// motions, and what holds everywhere.
    pub(super) fn leave_flat_levels(
        &self,
        recorded: &[RecordedClaim<'_>],
        statuses: &mut [ClaimState],
    ) {
        let flat = self.flat.borrow();
        for (item, status) in recorded.iter().zip(statuses) {
            let kept = &item.claim.place.kept;
            let own = || flat.iter().filter(|found| kept[found.index]);
            let Some(found) = own().find(|found| found.is_lost).or_else(|| own().next()) else {
                continue;
            };
            status.is_flat = true;
            let near = found.near.as_ref().map(|near| format!(", as near {near}"));
            let near = near.unwrap_or_default();
            let equation = &self.case.model.level[found.index].text;
            // There a state at which the residual is not 0 belongs to a motion on the level.
            if status.is_regular
                && status.settled == Some(Verdict::Refuted)
                && !item.claim.kind.is_negated()
            {
                if !found.is_lost {
                    continue;
                }
                let own = format!(
                    "refuted on a part of the level where the slopes of its equations are independent; \
                     that of `{equation}` is 0, or depends on others, on another part{near}"
                );
                let reason = match status.evidence.reason.take() {
                    Some(before) => format!("{before}; {own}"),
                    None => own,
                };
                status.evidence.reason = Some(reason);
                continue;
            }
            let evidence = &mut status.evidence;
            let subject = item.claim.kind.of_motions();
            if subject == OfMotions::Nothing
                || status.settled == Some(Verdict::Undecided)
                // A state at which the residual is not 0 refutes, unless no motion belongs to it.
                || (!found.is_lost && status.settled != Some(Verdict::Proved))
                || evidence.holds.contains(&PlaceName::Everywhere)
                || (subject == OfMotions::Constancy && self.is_kept_everywhere(kept))
            {
                continue;
            }
            (evidence.proof, evidence.witness) = (None, None);
            evidence.holds.clear();
            let reason = match found.is_lost {
                true => format!(
                    "the slope of `{equation}` is 0 at states of the level{near}, or depends there on those \
                     of the equations before it, so that it is not known whether the motion stays: write \
                     x = 1 for (x − 1)² = 0, and leave out values of parameters and states for which an \
                     equation is a square"
                ),
                false => format!(
                    "it is not known whether the slope of `{equation}` is 0 on a part of the level, or \
                     depends there on those of the equations before it, so that the motion may leave: \
                     give ranges in which what is in |…| and under roots keeps its sign"
                ),
            };
            undecide(status, reason);
        }
    }

    /// Whether the form of the rates shows that the functions of some equations are constant on every motion, which
    /// then stays on their level, whatever their slopes.
    pub(super) fn is_kept_everywhere(&self, kept: &[bool]) -> bool {
        let rates = self.common.level_rates.iter().zip(kept).filter(|(_, kept)| **kept);
        let is_zero = |rate: &Expr| self.graph.constant_value(*rate).is_some_and(Rational::is_zero);
        !self.case.model.system.is_map() && rates.into_iter().all(|(rate, _)| is_zero(rate))
    }
}
