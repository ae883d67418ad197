//! Further states, for claims that are still undecided: blocks of states are evaluated, and only a
//! block that seems to refute a claim is examined closely.

use std::ops::Range;

use super::claim_state::ClaimState;
use super::examine::BlockValues;
use super::judging::Judging;
use super::ladder::Open;
use super::pass::{Passed, Total};
use super::recorded::OutputLayout;
use super::run::{MOST_KEPT, MOST_PASSED, Run, waves};
use super::sampler::{Sampler, TAPE_LANES};

impl Judging<'_> {
    /// Evaluates balls over f64 at the other blocks, for claims that the fields did not decide.
    pub(super) fn further_states(&self, sampler: &Sampler, open: &mut Open<'_, '_>) {
        let mut laid_out: Option<(Run, OutputLayout, usize)> = None;
        for blocks in waves(1..self.blocks(), MOST_PASSED) {
            let mut left: Vec<_> = open
                .iter_mut()
                .filter(|(_, status)| {
                    status.settled.is_none() && !status.is_nonzero() && !status.is_zero
                })
                .collect();
            if left.is_empty() {
                return;
            }
            if laid_out.as_ref().is_none_or(|(_, _, count)| *count != left.len()) {
                let (run, layout) =
                    self.lay_out(sampler, left.iter().map(|(item, _)| *item), false);
                laid_out = Some((run, layout, left.len()));
            }
            let Some((run, layout, _)) = &laid_out else { return };
            let mut statuses: Vec<&mut ClaimState> =
                left.iter_mut().map(|(_, status)| &mut **status).collect();
            let share = (blocks.end - blocks.start) as f64 / self.blocks() as f64;
            // These ratios are part of the evidence already.
            let known =
                |status: &&mut ClaimState| status.evidence.max_scaled_residual.unwrap_or(0.0);
            let known: Vec<f64> = statuses.iter().map(known).collect();
            match run.pass(sampler, blocks.clone(), layout, &known) {
                Some(passed) => {
                    let passed = blocks.zip(passed);
                    self.weigh_passed(sampler, (run, layout), passed, &mut statuses);
                }
                None => {
                    for start in blocks.clone().step_by(MOST_KEPT as usize) {
                        let some = start..blocks.end.min(start + MOST_KEPT);
                        self.look_at(sampler, (run, layout), some, &mut statuses);
                    }
                }
            }
            self.tell(share * left.len() as f64);
        }
    }

    /// Adds the results of blocks of states to the evidence; a block that seems to refute a claim is
    /// examined closely.
    fn weigh_passed(
        &self,
        sampler: &Sampler,
        laid_out: (&Run, &OutputLayout),
        passed: impl Iterator<Item = (u64, Vec<Passed>)>,
        statuses: &mut [&mut ClaimState],
    ) {
        let mut totals: Vec<Option<Total>> = statuses.iter().map(|_| None).collect();
        for (block, passed) in passed {
            let is_open = |status: &ClaimState| status.settled.is_none();
            let mut suspect = false;
            for ((status, total), own) in statuses.iter_mut().zip(&mut totals).zip(&passed) {
                if is_open(status) && own.excludes_zero {
                    self.add(sampler, total.take(), status);
                    suspect = true;
                } else if is_open(status) {
                    total.get_or_insert_default().add(own);
                }
            }
            if suspect {
                let mut refuted: Vec<&mut ClaimState> = Vec::new();
                let mut layout =
                    OutputLayout { common: laid_out.1.common.clone(), spans: Vec::new() };
                let all = statuses.iter_mut().zip(&laid_out.1.spans).zip(&passed);
                for ((status, span), _) in all.filter(|(_, own)| own.excludes_zero) {
                    refuted.push(&mut **status);
                    layout.spans.push(span.clone());
                }
                let one = block..block + 1;
                self.look_at(sampler, (laid_out.0, &layout), one, &mut refuted);
            }
        }
        for (status, total) in statuses.iter_mut().zip(totals) {
            self.add(sampler, total, status);
        }
    }

    /// Examines the values of all claims that are open at some blocks.
    fn look_at(
        &self,
        sampler: &Sampler,
        (run, layout): (&Run, &OutputLayout),
        blocks: Range<u64>,
        statuses: &mut [&mut ClaimState],
    ) {
        let values = run.at_blocks(sampler, blocks.clone(), |maker, at| maker.balls(at));
        for (block, values) in blocks.zip(values) {
            let start = block * TAPE_LANES as u64;
            for (status, span) in statuses.iter_mut().zip(&layout.spans) {
                if status.settled.is_none() {
                    let existing = layout.existing(&values, span);
                    let seen = BlockValues { values: &values, existing: &existing };
                    self.check_value(sampler, start, span, &seen, f64::MANTISSA_DIGITS, status);
                }
            }
        }
    }
}
