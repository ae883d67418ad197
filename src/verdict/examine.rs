//! Evaluation of one residual by the enclosures of a block of states.

use super::claim_state::{ClaimState, undecide};
use super::conclude::advice_on_rate;
use super::evidence::{Method, Verdict, Witness};
use super::judging::Judging;
use super::pass::Total;
use super::recorded::{RecordedClaim, Span};
use super::run::Values;
use super::sampler::Sampler;
use super::witness::witness;
use crate::number::Enclosing;

/// Values of a block, with the lanes that contain states.
pub struct BlockValues<'v, D: Enclosing> {
    /// Values of the outputs.
    pub values: &'v Values<D>,
    /// Whether each lane counts.
    pub existing: &'v [bool],
}

impl Judging<'_> {
    /// Refutes by a state whose enclosure excludes zero, if any; otherwise adds the block to the
    /// evidence.
    pub(super) fn check_value<D: Enclosing>(
        &self,
        sampler: &Sampler,
        start: u64,
        span: &Span,
        seen: &BlockValues<'_, D>,
        bits: u32,
        status: &mut ClaimState,
    ) {
        settle_method(sampler, status);
        if self.seek_witness(sampler, start, span.residual.clone(), seen, bits, status) {
            return;
        }
        let residuals = seen.values.range(span.residual.clone());
        let (mut states, mut lacking) = (0, 0);
        let (mut largest, mut scaled) = (0f64, 0f64);
        for lane in (0..D::LANES).filter(|lane| seen.existing[*lane]) {
            let enclosures = || residuals.iter().map(|block| D::enclosure(block, lane));
            if enclosures().any(|enclosure| enclosure.is_none()) {
                lacking += 1;
                continue;
            }
            states += 1;
            for (mid, rad) in enclosures().flatten() {
                largest = largest.max(mid.abs());
                scaled = scaled.max(if mid == 0.0 { 0.0 } else { mid.abs() / rad });
            }
        }
        // A part of a level that is not divided may have few of the states.
        if lacking > 0 && sampler.is_numerical() {
            let of = lacking + states;
            status.blurred.get_or_insert_with(|| {
                format!(
                    "the residual has no value at {lacking} of {of} states at which all that is written has one"
                )
            });
        }
        let evidence = &mut status.evidence;
        if start > 0 || evidence.samples == 0 {
            evidence.samples += states;
        }
        // Higher precision replaces earlier results, further states add to them.
        let before = |old: Option<f64>| if start > 0 { old.unwrap_or(0.0) } else { 0.0 };
        evidence.max_residual = Some(before(evidence.max_residual).max(largest));
        evidence.max_scaled_residual = Some(before(evidence.max_scaled_residual).max(scaled));
        let method = evidence.method;
        status.rung(method, enclosed(states, largest));
    }

    /// Adds to the evidence what further blocks of states show together, as [`Self::check_value`] does
    /// with one after another.
    pub(super) fn add(&self, sampler: &Sampler, total: Option<Total>, status: &mut ClaimState) {
        let Some(Total { all, last }) = total else { return };
        settle_method(sampler, status);
        let evidence = &mut status.evidence;
        evidence.samples += all.states;
        let larger = |old: Option<f64>, new: f64| Some(old.unwrap_or(0.0).max(new));
        evidence.max_residual = larger(evidence.max_residual, all.largest);
        evidence.max_scaled_residual = larger(evidence.max_scaled_residual, all.scaled);
        let method = evidence.method;
        status.rung(method, enclosed(last.states, last.largest));
    }

    /// Refutes a claim by the first state whose enclosure excludes zero, if any.
    pub(super) fn seek_witness<D: Enclosing>(
        &self,
        sampler: &Sampler,
        start: u64,
        residual: std::ops::Range<usize>,
        seen: &BlockValues<'_, D>,
        bits: u32,
        status: &mut ClaimState,
    ) -> bool {
        let residuals = seen.values.range(residual);
        for lane in (0..D::LANES).filter(|lane| seen.existing[*lane]) {
            if residuals.iter().any(|block| D::enclosure(block, lane).is_none()) {
                continue;
            }
            let away = residuals.iter().find(|block| D::excludes_zero(block, lane));
            let digits = away.and_then(|block| D::beyond_f64(block, lane));
            if let Some((mid, rad)) = away.and_then(|block| D::enclosure(block, lane)) {
                let index = start + lane as u64;
                let evidence = &mut status.evidence;
                evidence.samples = evidence.samples.max(lane + 1);
                let found = match &digits {
                    Some(digits) => format!("{digits} at state {index}"),
                    None => format!("{mid:.3e} ± {rad:.1e} at state {index}"),
                };
                let printed = sampler.printed(index, bits);
                let witness = witness(self.case, Some(index), &printed, (mid, rad));
                evidence.witness = Some(Witness { digits, ..witness });
                evidence.max_residual = None;
                evidence.max_scaled_residual = None;
                status.settled = Some(Verdict::Refuted);
                let method = status.evidence.method;
                status.rung(method, found);
                return true;
            }
        }
        false
    }
}

/// Notes that balls are used, where nothing else was.
fn settle_method(sampler: &Sampler, status: &mut ClaimState) {
    if status.evidence.method == Method::Unsettled {
        let numerical = sampler.is_numerical();
        status.evidence.method = if numerical { Method::NumericalBall } else { Method::Ball };
    }
}

/// Says what a block that refutes nothing shows.
fn enclosed(states: usize, largest: f64) -> String {
    format!("0 enclosed at {states} states, at most {largest:.1e}")
}

/// Decides a claim that no state refuted.
pub fn complete(item: &RecordedClaim<'_>, status: &mut ClaimState) {
    let kind = item.claim.kind.name();
    if let Some(reason) = status.undefined.take() {
        status.evidence.proof = None;
        status.is_unseen = status.is_zero;
        undecide(status, reason);
    } else if status.is_zero {
        status.settled = Some(Verdict::Proved);
        status.evidence.method = Method::PrimeField;
    } else if status.is_nonzero() && item.claim.kind.is_inequality() {
        let reason = "no state is known at which the rate is positive, and it is not proved that there is none";
        undecide(status, format!("{reason}; {}", advice_on_rate(&item.claim.kind)));
    } else if status.is_nonzero() {
        undecide(
            status,
            format!(
                "modulo a prime the residual of this {kind} is not 0, but no state is known at which \
                 that matters"
            ),
        );
    } else if let Some(reason) = status.partial.take().or(status.blurred.take()) {
        undecide(status, reason);
    } else {
        status.settled = Some(Verdict::Confirmed);
    }
}
