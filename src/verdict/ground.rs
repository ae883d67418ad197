//! Premises of all claims: states lie on the level, and the motion stays there.

use super::field::{PrimeFieldStates, Query};
use super::judge::JudgeError;
use super::judging::Judging;
use super::ladder::{LADDER_BITS, PRECISE_STATES};
use super::sampler::{Sampler, TAPE_LANES};
use crate::claim::LevelSubset;
use crate::graph::{Expr, Fault};
use crate::mechanics::{Chart, combinations};
use crate::number::arb::ArbBall;
use crate::number::ball::{Ball, Balls};
use crate::number::rational::Rational;

impl Judging<'_> {
    /// Checks that the motion stays on a part of the level.
    pub(super) fn check_motion(
        &self,
        place: &LevelSubset,
        sampler: &Sampler,
    ) -> Result<(), JudgeError> {
        let rates = self.rates_at(place);
        // The whole level has been examined before, but not parts of it without drawn states.
        if rates.is_empty() {
            return match sampler.is_part() {
                true => Ok(self.check_slopes(sampler)?),
                false => Ok(()),
            };
        }
        let states = sampler.balls(0);
        let values = self.run(&rates).at(&Ball::<TAPE_LANES>, &states);
        let is_state = values.existing(&[]);
        let kept = self.case.model.level.iter().zip(&place.kept).filter(|(_, kept)| **kept);
        for (index, (equation, _)) in kept.enumerate() {
            let rate = values.output(index);
            let changes = |lane: &usize| is_state[*lane] && rate.excludes_zero(*lane);
            if let Some(lane) = self.first_with_motion(sampler, &states, changes) {
                let (equation, rate) = (equation.text.clone(), format!("{:e}", rate.mid[lane]));
                return Err(JudgeError::NotInvariant { equation, rate });
            }
        }
        Ok(self.check_slopes(sampler)?)
    }

    /// Finds the first state of a block with a property at which the equations of motion, as they are written, have a
    /// value.
    pub(super) fn first_with_motion(
        &self,
        sampler: &Sampler,
        states: &[Balls<TAPE_LANES>],
        has_property: impl Fn(&usize) -> bool,
    ) -> Option<usize> {
        let mut lanes = (0..TAPE_LANES).filter(has_property).peekable();
        lanes.peek()?;
        let written = self.common.required_at(sampler.kept());
        let values = self.run(&written).at(&Ball::<TAPE_LANES>, states);
        let exists = values.existing(std::slice::from_ref(&(0..written.len())));
        lanes.find(|lane| exists[*lane])
    }

    /// Returns the error that names a violated or non-invariant equation, if a premise is known not
    /// to vanish.
    pub(super) fn name_the_error(
        &self,
        place: &LevelSubset,
        sampler: &Sampler,
    ) -> Result<(), JudgeError> {
        let kept = || (0..place.kept.len()).filter(|index| place.kept[*index]);
        let text = |index: usize| self.case.model.level[index].text.clone();
        let single = |values: &[Expr]| {
            kept().map(|index| Query::of(vec![values[index]])).collect::<Vec<_>>()
        };
        let (level, rates) = (single(&self.common.level), single(&self.common.level_rates));
        let field = PrimeFieldStates::new(self, sampler);
        for (index, answer) in kept().zip(field.test(&level)?) {
            if answer.is_nonzero()
                && let Some(by) = self.magnitude(sampler, self.common.level[index], false)
            {
                return Err(self.off_level(text(index), by));
            }
        }
        for (index, answer) in kept().zip(field.test(&rates)?) {
            if answer.is_nonzero()
                && let Some(rate) = self.magnitude(sampler, self.common.level_rates[index], true)
            {
                return Err(JudgeError::NotInvariant { equation: text(index), rate });
            }
        }
        Ok(())
    }

    /// Prints a value that is not identically zero, at a state where it is seen not to vanish. `None` where it
    /// is seen at none of the states of a level that is solved: a field does not know which signs of roots
    /// lead to states. A rate counts where the equations of motion, as they are written, have a value.
    fn magnitude(&self, sampler: &Sampler, value: Expr, is_rate: bool) -> Option<String> {
        let written = match is_rate {
            true => self.common.required_at(sampler.kept()),
            false => Vec::new(),
        };
        let run = self.run(&[&[value][..], &written].concat());
        for bits in LADDER_BITS {
            let domain = ArbBall::new(bits);
            for index in 0..PRECISE_STATES {
                let states = sampler.states(&domain, 1, index);
                // A rate may have a value where a component that it does not contain has none.
                if !states.iter().all(Option::is_some) {
                    continue;
                }
                let values = run.at(&domain, &states);
                if !values.existing(std::slice::from_ref(&(1..written.len() + 1)))[0] {
                    continue;
                }
                if let Some(found) = values.output(0).as_ref().filter(|x| x.excludes_zero()) {
                    return Some(found.rough());
                }
            }
        }
        let bits = LADDER_BITS[LADDER_BITS.len() - 1];
        let is_solved = matches!(self.case.chart, Chart::Equations);
        (!is_solved).then(|| format!("less than {bits} bits resolve"))
    }

    /// Returns the values that must vanish for states to be on the level and to stay there.
    fn level_values(&self, place: &LevelSubset, sampler: &Sampler) -> Result<Vec<Expr>, Fault> {
        let (level, rates) = self.common.level_at(&place.kept);
        let rates = if self.is_at_rest(sampler)? { Vec::new() } else { rates };
        Ok([level, rates].concat())
    }

    /// Returns the question whether these values vanish, and exist where states count.
    pub(super) fn level_query(
        &self,
        place: &LevelSubset,
        sampler: &Sampler,
    ) -> Result<Query, Fault> {
        let kept = self.common.level_presence.iter().zip(&place.kept).filter(|(_, kept)| **kept);
        let presence = kept.flat_map(|(own, _)| own.iter().copied()).collect();
        Ok(Query { outputs: self.level_values(place, sampler)?, presence, ..Query::default() })
    }

    /// Whether the states are a part of lower dimension on which the field folds to 0, as at the vertex of a
    /// cone: a motion that starts there stays.
    pub(super) fn is_at_rest(&self, sampler: &Sampler) -> Result<bool, Fault> {
        if !sampler.is_thin() || self.case.model.system.is_map() {
            return Ok(false);
        }
        let Some(choices) = combinations(sampler.recipes()) else { return Ok(false) };
        let field = std::slice::from_ref(&self.common.field);
        for fixed in choices {
            let (graph, values) = sampler.compose(self.graph, field, &fixed)?;
            let is_zero =
                |value: &Expr| graph.constant_value(*value).is_some_and(Rational::is_zero);
            if !values.concat().iter().all(is_zero) {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
