//! Existence of states at which a residual counts: at a state where a formula is undefined it says
//! nothing, and a part of the states with given signs may be empty.

use super::antiderivative_value;
use super::claim_state::ClaimState;
use super::evidence::{Method, Verdict, Witness};
use super::examine::BlockValues;
use super::field::Where;
use super::judging::Judging;
use super::ladder::{LADDER_BITS, Open, PRECISE_STATES};
use super::recorded::RecordedClaim;
use super::sampler::{Sampler, TAPE_LANES};
use super::witness;
use crate::graph::{Evaluator, Fault, Tape};
use crate::mechanics::Draw;
use crate::number::Enclosing;
use crate::number::arb::ArbBall;
use crate::number::ball::Ball;
use crate::number::mixed::{Mixed, Number};
use crate::number::rational::Rational;
use crate::proof::{Extent, InputRegion};

/// Largest number of choices of signs with which a state is sought.
const MOST_SIGNS: usize = 16;

impl Judging<'_> {
    /// Refutes claims that are not identities in prime fields, once a state is known at which they
    /// count; with a witness if one is found.
    pub(super) fn real_states(
        &self,
        sampler: &Sampler,
        open: &mut Open<'_, '_>,
    ) -> Result<(), Fault> {
        let unsettled = open.iter_mut().filter(|(item, status)| {
            let is_known = status.undefined.is_none() || item.context.quadrature_defects.is_empty();
            status.settled.is_none() && status.is_nonzero() && is_known
        });
        for (item, status) in unsettled {
            for found in std::mem::take(&mut status.nonzero) {
                if self.settle_at(item, sampler, &found, status)? {
                    break;
                }
                status.nonzero.push(found);
            }
        }
        Ok(())
    }

    /// Refutes a claim by a state in one of the parts.
    fn settle_at(
        &self,
        item: &RecordedClaim<'_>,
        sampler: &Sampler,
        found: &Where,
        status: &mut ClaimState,
    ) -> Result<bool, Fault> {
        let chosen = sampler.with(&found.fixed);
        let is_seen = match found.parts.proper() {
            None => self.drawn_state(item, &chosen, None, status),
            Some(parts) => {
                parts.iter().any(|part| self.drawn_state(item, &chosen, Some(part), status))
                    || parts.iter().any(|part| self.state_inside(item, &chosen, part, status))
            }
        };
        let exists = is_seen || self.has_state_around(&chosen, found)?;
        if exists && status.settled.is_none() && !self.find_witness(item, &chosen, status) {
            let kind = item.claim.kind.name();
            let why = match is_seen {
                true => "the residual's enclosures at the states that were tried contain 0",
                false => "that the residual has a value is known from the form of a root alone",
            };
            status.settled = Some(Verdict::Refuted);
            status.evidence.method = Method::PrimeField;
            status.evidence.reason = Some(format!(
                "modulo a prime the residual of this {kind} is not 0, so it is not an identity; no state is \
                 printed: {why}"
            ));
        }
        Ok(exists)
    }

    /// Whether a drawn state lies in a part, with all required values; a witness decides the claim.
    fn drawn_state(
        &self,
        item: &RecordedClaim<'_>,
        sampler: &Sampler,
        part: Option<&InputRegion>,
        status: &mut ClaimState,
    ) -> bool {
        let (run, layout) = self.lay_out(sampler, std::iter::once(item), false);
        let span = &layout.spans[0];
        let member = part.map(Membership::of);
        let mut known = None;
        for block in 0..self.blocks() {
            let start = block * TAPE_LANES as u64;
            let values = run.at(&Ball::<TAPE_LANES>, &sampler.balls(start));
            let mut existing = layout.existing(&values, span);
            if let Some(member) = &member {
                member.restrict(sampler, &Ball::<TAPE_LANES>, start, &mut existing);
            }
            if let Some(lane) = existing.iter().position(|exists| *exists) {
                known = Some(start + lane as u64);
                break;
            }
        }
        let domain = Mixed::new(LADDER_BITS[0]);
        let exists = |index: &u64| {
            let values = run.at(&domain, &sampler.states(&domain, 1, *index));
            let mut existing = layout.existing(&values, span);
            if let Some(member) = &member {
                member.restrict(sampler, &domain, *index, &mut existing);
            }
            existing[0]
        };
        let Some(index) = known.or_else(|| (0..PRECISE_STATES).find(exists)) else { return false };
        status.evidence.method = Method::PreciseBall;
        for bits in LADDER_BITS {
            let domain = ArbBall::new(bits);
            let values = run.at(&domain, &sampler.states(&domain, 1, index));
            let existing = layout.existing(&values, span);
            let seen = BlockValues { values: &values, existing: &existing };
            if self.seek_witness(sampler, index, span.residual.clone(), &seen, bits, status) {
                break;
            }
        }
        true
    }

    /// Whether a state is found in a part by dividing the ranges of the draws; a witness decides
    /// the claim.
    pub(super) fn state_inside(
        &self,
        item: &RecordedClaim<'_>,
        sampler: &Sampler,
        part: &InputRegion,
        status: &mut ClaimState,
    ) -> bool {
        let mut all = signed_extents(sampler, &part.signs).into_iter();
        let Some(point) = all.find_map(|extents| part.point(&extents)) else { return false };
        let numbers: Option<Vec<Rational>> = sampler
            .recipes()
            .iter()
            .zip(&point)
            .map(|(draw, x)| draw.only().or_else(|| Rational::from_f64(*x)))
            .collect();
        let Some(numbers) = numbers else { return false };
        let mut found = AtNumbers::Small;
        for bits in LADDER_BITS {
            found = self.examined_with(bits, item, sampler, &numbers, status);
            if found != AtNumbers::Small {
                break;
            }
        }
        match found {
            AtNumbers::NoState => false,
            AtNumbers::Refuted | AtNumbers::Small => true,
            // As at √0, the state may be alone, and then counts for nothing.
            AtNumbers::Zero => false,
        }
    }

    /// Examines a claim at the state made from given draws; a witness decides it.
    pub(super) fn examined_at(
        &self,
        item: &RecordedClaim<'_>,
        sampler: &Sampler,
        numbers: &[Rational],
        status: &mut ClaimState,
    ) -> AtNumbers {
        self.examined_with(LADDER_BITS[0], item, sampler, numbers, status)
    }

    /// Examines a claim in the same way with other numbers of bits.
    fn examined_with(
        &self,
        bits: u32,
        item: &RecordedClaim<'_>,
        sampler: &Sampler,
        numbers: &[Rational],
        status: &mut ClaimState,
    ) -> AtNumbers {
        let (run, layout) = self.lay_out(sampler, std::iter::once(item), false);
        let (span, domain) = (&layout.spans[0], Mixed::new(bits));
        let values = run.at(&domain, &sampler.made_from(&domain, numbers));
        if !layout.existing(&values, span)[0] {
            return AtNumbers::NoState;
        }
        // What the claim takes at other points may have none.
        if !item.presence.is_empty() && !values.existing(std::slice::from_ref(&span.residual))[0] {
            return AtNumbers::NoState;
        }
        let residuals = values.range(span.residual.clone());
        let away = residuals.iter().find(|value| Mixed::excludes_zero(value, 0));
        if let Some((mid, rad)) = away.and_then(|value| Mixed::enclosure(value, 0)) {
            if self.is_lone_at(item, sampler, numbers, bits) {
                return AtNumbers::NoState;
            }
            let digits = away.and_then(|value| Mixed::beyond_f64(value, 0));
            let printed = sampler.printed_from(numbers, bits);
            let witness = witness::witness(self.case, None, &printed, (mid, rad));
            let found = format!("{mid:.3e} ± {rad:.1e} at a state that was looked for");
            status.evidence.witness = Some(Witness { digits, ..witness });
            status.evidence.method = Method::PreciseBall;
            status.settled = Some(Verdict::Refuted);
            status.rung(Method::PreciseBall, found);
            return AtNumbers::Refuted;
        }
        match residuals.iter().all(|value| matches!(value, Number::Exact(value) if value.is_zero()))
        {
            true => AtNumbers::Zero,
            false => AtNumbers::Small,
        }
    }
}

/// Outcome of a claim at one state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum AtNumbers {
    /// The claim has no value there.
    NoState,
    /// It fails.
    Refuted,
    /// All residuals are 0 exactly.
    Zero,
    /// They enclose 0, or have no value.
    Small,
}

/// Returns the ranges of the draws in a part of the states, with each choice of the signs that the
/// part leaves free. A sign is 1 or -1, and nothing between them leads to a state.
pub(super) fn signed_extents(sampler: &Sampler, signs: &[(usize, bool)]) -> Vec<Vec<Extent>> {
    let mut all = vec![sampler.extents()];
    for (input, draw) in sampler.recipes().iter().enumerate() {
        if !matches!(draw, Draw::Sign) {
            continue;
        }
        let given = signs.iter().find(|(sign, _)| *sign == input).map(|(_, is)| *is);
        let choices: Vec<bool> = given.map_or(vec![true, false], |is| vec![is]);
        let with = |extents: &Vec<Extent>, positive: bool| {
            let mut extents = extents.clone();
            extents[input] = Extent::at(&Rational::from(if positive { 1 } else { -1 }));
            extents
        };
        let own = all.iter().flat_map(|extents| choices.iter().map(move |is| with(extents, *is)));
        all = own.take(MOST_SIGNS).collect();
    }
    all
}

/// The signs that define a part of the states.
struct Membership<'p> {
    part: &'p InputRegion,
    tape: Tape,
}

impl<'p> Membership<'p> {
    fn of(part: &'p InputRegion) -> Self {
        Self { part, tape: Tape::new(&part.graph, &part.positive) }
    }

    /// Keeps the states that are known to lie in the part.
    fn restrict<D: Enclosing + Clone>(
        &self,
        sampler: &Sampler,
        domain: &D,
        start: u64,
        existing: &mut [bool],
    ) {
        let mut inputs = sampler.drawn(domain, D::LANES, start);
        for (input, positive) in &self.part.signs {
            let Some(block) = inputs.get(*input) else { continue };
            for (lane, exists) in existing.iter_mut().enumerate() {
                let sign = D::enclosure(block, lane).map(|(mid, _)| mid > 0.0);
                *exists = *exists && sign == Some(*positive);
            }
        }
        let further = self.part.graph.inputs().saturating_sub(inputs.len());
        inputs.extend((0..further).map(|k| domain.constant(&antiderivative_value(k))));
        let mut evaluator = Evaluator::new(&self.tape, domain.clone());
        evaluator.run(&inputs);
        for block in evaluator.outputs() {
            for (lane, exists) in existing.iter_mut().enumerate() {
                *exists = *exists && D::is_positive(block, lane);
            }
        }
    }
}
