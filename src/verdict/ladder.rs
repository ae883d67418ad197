//! The ladder of decision methods, from the cheapest to the most certain.
//!
//! ```text
//! folding             the residual became a constant while it was recorded
//! ball                enclosures in f64 at the first states: most false claims end here
//! prime field         true claims end here, proved; a value that is not 0 sends the others up
//! ball                further states, for claims on which the field is silent
//! double-double ball  twice the digits, for small residuals
//! ball of n bits      increasing precision, for residuals that the field knows not to vanish
//! ```

use super::claim_state::{ClaimState, NO_QUADRATURE, are_zero, classify, fold, undecide};
use super::evidence::{Method, Proof, Verdict};
use super::examine::{BlockValues, complete};
use super::field::{Answer, PrimeFieldStates, Query};
use super::judge::{JudgeError, Trust};
use super::judging::Judging;
use super::recorded::{OutputLayout, RecordedClaim, Span};
use super::run::Run;
use super::sampler::{Sampler, TAPE_LANES};
use crate::claim::LevelSubset;
use crate::graph::Expr;
use crate::number::arb::ArbBall;
use crate::number::ball::Ball;
use crate::number::double_double_ball::DoubleDoubleBall;

/// Precisions of the last rung in bits.
pub const LADDER_BITS: [u32; 5] = [256, 512, 1024, 2048, 4096];
/// Number of states at which all values exist, in each of these precisions.
pub const PRECISE_STATES: u64 = 4;
/// Number of such states for a claim on which the fields are silent, and number of operations of the
/// residual up to which they are all tried.
const CONFIRMING_STATES: u64 = 32;
pub const FEW_OPERATIONS: usize = 4096;
/// Number of states tried to find one of them.
const PRECISE_TRIES: u64 = 8;

/// Reason why a claim that fails at a state is not refuted.
const LONE: &str = "it fails at a state around which no state has values of all that is written: such a \
                    state does not count";

pub type Open<'f, 'r> = Vec<(&'f RecordedClaim<'r>, &'f mut ClaimState)>;

impl Judging<'_> {
    /// Decides the claims made at one place.
    pub fn climb<'f, 'r: 'f>(
        &self,
        place: &LevelSubset,
        open: Open<'f, 'r>,
    ) -> Result<(), JudgeError> {
        let sampler = self.sampler_at(place)?;
        match self.pieces(&sampler)? {
            Some(pieces) => self.climb_pieces(place, &pieces, open),
            None => self.climb_on(place, &sampler, open),
        }
    }

    /// Decides claims at the states of a sampler.
    pub(super) fn climb_on<'f, 'r: 'f>(
        &self,
        place: &LevelSubset,
        sampler: &Sampler,
        mut open: Open<'f, 'r>,
    ) -> Result<(), JudgeError> {
        self.check_motion(place, sampler)?;
        let missed = self.missed_part(sampler)?;
        if sampler.has_lists() {
            let (negated, others): (Open<'_, '_>, Open<'_, '_>) =
                open.into_iter().partition(|(item, _)| item.claim.kind.is_negated());
            open = others;
            self.climb_each(place, sampler, missed.as_deref(), negated)?;
        }
        let known = match sampler.is_numerical() {
            true => self.prove_of_parameters(&mut open)?,
            false => Vec::new(),
        };
        self.decide(place, sampler, missed.as_deref(), &mut open)?;
        open.extend(known);
        self.settle_parts(sampler, &mut open)?;
        self.settle_images(sampler, &mut open)?;
        let (mut holding, others): (Open<'_, '_>, Open<'_, '_>) =
            open.into_iter().partition(|(_, status)| status.holds());
        for (item, status) in others.into_iter().filter(|(_, status)| status.is_unseen) {
            self.remark_missing(sampler, (item, status), &[]);
            self.settle_conditions_unseen(sampler, (item, status))?;
        }
        self.settle_novelty(sampler, &mut holding)?;
        self.settle_conditions(sampler, &mut holding)?;
        self.remark_voids(sampler, &mut holding)?;
        self.settle_signs(sampler, holding.into_iter().filter(|(_, status)| status.holds()))?;
        Ok(())
    }

    /// Takes out claims that are equations of parameters alone, as those of a fixed point are, and proved without the
    /// states of a level.
    fn prove_of_parameters<'f, 'r: 'f>(
        &self,
        open: &mut Open<'f, 'r>,
    ) -> Result<Open<'f, 'r>, JudgeError> {
        let parameters = self.case.model.free_components();
        let is_of_parameters =
            |value: &Expr| self.graph.inputs_of(*value).into_iter().all(|input| input < parameters);
        let place = LevelSubset::everywhere(&self.case.model);
        let space = self.sampler_at(&place)?;
        let (mut known, mut others) = (Vec::new(), Vec::new());
        for (item, status) in std::mem::take(open) {
            let asked = item.residual.iter().chain(&item.context.quadrature_defects);
            let mut written = asked.chain(&item.presence).chain(&item.requirement);
            // A claim without a residual says something else.
            let has_residual = !item.residual.is_empty();
            let is_alone = has_residual && !space.is_numerical() && written.all(is_of_parameters);
            if is_alone && !item.claim.kind.is_negated() {
                let mut alone = ClaimState::default();
                self.decide(&place, &space, None, &mut vec![(item, &mut alone)])?;
                if alone.settled == Some(Verdict::Proved) {
                    *status = alone;
                    known.push((item, status));
                    continue;
                }
            }
            others.push((item, status));
        }
        *open = others;
        Ok(known)
    }

    /// Climbs until each claim is decided.
    pub(super) fn decide(
        &self,
        place: &LevelSubset,
        sampler: &Sampler,
        missed: Option<&str>,
        open: &mut Open<'_, '_>,
    ) -> Result<(), JudgeError> {
        for (item, status) in open.iter_mut() {
            fold(self.graph, item, status);
            status.evidence.operations = self.graph.operations(&item.residual);
        }
        self.first_states(sampler, open);
        for (item, status) in open.iter_mut() {
            if self.is_refuted_at_lone(item, sampler, status)? {
                status.settled = None;
                status.evidence.witness = None;
            }
        }
        let settled = open.iter().filter(|(_, status)| status.settled.is_some());
        self.tell(settled.count() as f64);
        if self.options.trust != Trust::Float {
            if sampler.is_numerical() || missed.is_some() {
                self.combine(sampler, open)?;
            }
            self.fields(place, sampler, open)?;
        }
        self.further_states(sampler, open);
        if self.options.trust != Trust::Float && !sampler.is_numerical() {
            self.more_digits(sampler, open);
        }
        if self.options.trust != Trust::Float {
            self.missing_states(sampler, open);
            self.unseen_states(sampler, open)?;
            self.real_states(sampler, open)?;
            if !sampler.is_numerical() {
                self.states_beside_moduli(sampler, open)?;
                self.states_near_ends(sampler, open);
                self.ascend(sampler, open);
                self.combine(sampler, open)?;
            }
        }
        for (item, status) in open.iter_mut() {
            if status.settled.is_none() {
                complete(item, status);
            }
            // A claim that holds at the computed states need not hold on the part they miss.
            if let (Some(reason), true) = (missed, status.holds() && !status.is_combination) {
                status.evidence.proof = None;
                undecide(status, reason.to_string());
            }
        }
        let is_confirmed = |status: &ClaimState| status.settled == Some(Verdict::Confirmed);
        if open.iter().any(|(_, status)| is_confirmed(status))
            && let Some(reason) = sampler.unreached()?
        {
            let confirmed = open.iter_mut().filter(|(_, status)| is_confirmed(status));
            confirmed.for_each(|(_, status)| undecide(status, reason.to_string()));
        }
        for (item, status) in open.iter_mut() {
            if self.is_refuted_at_lone(item, sampler, status)? {
                status.evidence.witness = None;
                undecide(status, LONE.to_string());
            }
        }
        self.second_opinion(sampler, open)?;
        Ok(())
    }

    /// Evaluates balls over f64 at the first block, with the scales that separate rounding from
    /// truth.
    fn first_states(&self, sampler: &Sampler, open: &mut Open<'_, '_>) {
        let (run, layout) = self.lay_out(sampler, open.iter().map(|(item, _)| *item), true);
        let values = run.at(&Ball::<TAPE_LANES>, &sampler.balls(0));
        for ((item, status), span) in open.iter_mut().zip(&layout.spans) {
            let existing = layout.existing(&values, span);
            status.missing = (0..TAPE_LANES).filter(|lane| !existing[*lane]).collect();
            classify(item, span, (&values, &existing), sampler.is_numerical(), status);
            if status.settled.is_none() && status.undefined.is_none() {
                let seen = BlockValues { values: &values, existing: &existing };
                self.check_value(sampler, 0, span, &seen, f64::MANTISSA_DIGITS, status);
            }
        }
    }

    /// Tests residuals in prime fields: those that are zero there are proved.
    fn fields(
        &self,
        place: &LevelSubset,
        sampler: &Sampler,
        open: &mut Open<'_, '_>,
    ) -> Result<(), JudgeError> {
        let mut unsettled: Vec<_> =
            open.iter_mut().filter(|(_, status)| status.settled.is_none()).collect();
        let ground = self.level_query(place, sampler)?;
        let has_ground = !ground.outputs.is_empty();
        if unsettled.is_empty() && !has_ground {
            return Ok(());
        }
        let mut queries = vec![ground];
        queries.extend(unsettled.iter().map(|(item, _)| Query {
            outputs: [&item.residual[..], &item.context.quadrature_defects].concat(),
            requirement: item.requirement.clone(),
            presence: item.presence.clone(),
        }));
        let field = PrimeFieldStates::new(self, sampler);
        let decided = self.decided;
        let tell = |count: usize| decided(count as f64);
        let mut answers = field.test_telling(&queries, &tell)?.into_iter();
        let ground = answers.next();
        if ground.as_ref().is_some_and(Answer::is_nonzero) {
            self.name_the_error(place, sampler)?;
        }
        if has_ground {
            if matches!(ground, Some(Answer::NonZero(_))) {
                self.name_the_error_on_parts(place, sampler)?;
            }
            self.note_kept(place, matches!(ground, Some(Answer::Zero(_))));
        }
        for ((item, status), answer) in unsettled.iter_mut().zip(answers) {
            let defects = &item.context.quadrature_defects;
            if answer.is_nonzero()
                && !are_zero(self.graph, defects)
                && field.test(&[Query::of(defects.clone())])?.iter().any(Answer::is_nonzero)
            {
                status.rung(Method::PrimeField, NO_QUADRATURE.to_string());
                undecide(status, NO_QUADRATURE.to_string());
                continue;
            }
            let answer = match (&ground, answer) {
                (Some(Answer::Zero(ground)), Answer::Zero(own)) => Answer::Zero(ground.and(own)),
                (_, Answer::Zero(_)) => Answer::Silent(
                    "it is not proved that the states lie on the level and stay there".to_string(),
                ),
                (_, answer) => answer,
            };
            match answer {
                Answer::Zero(certificate) => {
                    let proof = Proof::from(certificate);
                    status.rung(Method::PrimeField, proof.to_string());
                    status.evidence.proof = Some(proof);
                    status.is_zero = true;
                    if status.undefined.is_none() {
                        status.evidence.method = Method::PrimeField;
                        status.settled = Some(Verdict::Proved);
                    }
                }
                Answer::NonZero(found) => {
                    status.rung(Method::PrimeField, "not 0, so no identity".to_string());
                    status.nonzero = found;
                }
                Answer::Silent(reason) => {
                    status.rung(Method::PrimeField, format!("silent: {reason}"));
                    status.evidence.silence = Some(reason);
                }
                Answer::Partial => {
                    let reason = format!(
                        "the residual of this {} has no value on a part of the states at which all \
                         that is written has one",
                        item.claim.kind.name()
                    );
                    status.rung(Method::PrimeField, reason.clone());
                    status.partial = Some(reason);
                }
                Answer::Void => {
                    let reason =
                        "there is no state at which all formulas of the claim have a value";
                    status.rung(Method::PrimeField, reason.to_string());
                    status.evidence.silence = Some(reason.to_string());
                    status.is_void = true;
                }
            }
        }
        Ok(())
    }

    /// Evaluates balls in increasing precision, for claims that are still open.
    fn more_digits(&self, sampler: &Sampler, open: &mut Open<'_, '_>) {
        let mut left: Vec<_> =
            open.iter_mut().filter(|(_, status)| status.settled.is_none()).collect();
        if left.is_empty() {
            return;
        }
        let (run, layout) = self.lay_out(sampler, left.iter().map(|(item, _)| *item), true);
        let domain = DoubleDoubleBall::<TAPE_LANES>;
        let values = run.at(&domain, &sampler.states(&domain, TAPE_LANES, 0));
        for ((item, status), span) in left.iter_mut().zip(&layout.spans) {
            let method = Method::DoubleDoubleBall;
            status.evidence.method = method;
            let existing = layout.existing(&values, span);
            classify(item, span, (&values, &existing), false, status);
            if status.undefined.is_some() && self.is_out_of_range(item, sampler) {
                status.undefined = None;
            }
            if status.settled.is_none() && status.undefined.is_none() {
                let seen = BlockValues { values: &values, existing: &existing };
                self.check_value(sampler, 0, span, &seen, 2 * f64::MANTISSA_DIGITS, status);
            }
        }
        let deserves = |status: &ClaimState| {
            status.settled.is_none() && !status.is_zero && status.undefined.is_none()
        };
        for (item, status) in left.iter_mut().filter(|(_, status)| deserves(status)) {
            let (run, layout) = self.lay_out(sampler, std::iter::once(*item), false);
            let span = &layout.spans[0];
            let before = status.evidence.method;
            // Where the fields are silent a refutation may not exist.
            let is_small = status.evidence.operations <= FEW_OPERATIONS;
            let (precisions, states) = match status.is_nonzero() {
                true => (&LADDER_BITS[..], PRECISE_STATES),
                false if is_small => (&LADDER_BITS[..1], CONFIRMING_STATES),
                false => (&LADDER_BITS[..1], PRECISE_STATES),
            };
            for bits in precisions {
                let domain = ArbBall::new(*bits);
                status.evidence.method = Method::PreciseBall;
                let mut count = 0;
                for index in 0..states * PRECISE_TRIES {
                    if status.settled.is_some() || count >= states {
                        break;
                    }
                    let values = run.at(&domain, &sampler.states(&domain, 1, index));
                    let existing = layout.existing(&values, span);
                    count += u64::from(existing[0]);
                    let seen = BlockValues { values: &values, existing: &existing };
                    let residual = span.residual.clone();
                    self.seek_witness(sampler, index, residual, &seen, *bits, status);
                }
            }
            if status.settled.is_none() && !status.is_nonzero() {
                status.evidence.method = before;
            }
        }
    }

    /// Whether formula and residual are defined, but out of the range of f64.
    fn is_out_of_range(&self, item: &RecordedClaim<'_>, sampler: &Sampler) -> bool {
        let mut outputs = self.common.required_at(sampler.kept());
        let parts = [&item.requirement, &item.residual, &item.context.value];
        outputs.extend(parts.into_iter().flatten());
        let (run, domain) = (self.run(&outputs), ArbBall::new(LADDER_BITS[0]));
        let is_defined = |index| {
            let values = run.at(&domain, &sampler.states(&domain, 1, index));
            values.existing(std::slice::from_ref(&(0..outputs.len())))[0]
        };
        item.context.quadrature_defects.is_empty() && (0..PRECISE_STATES).any(is_defined)
    }

    /// Lays out one tape for some claims.
    pub(super) fn lay_out<'r>(
        &self,
        sampler: &Sampler,
        items: impl Iterator<Item = &'r RecordedClaim<'r>>,
        with_context: bool,
    ) -> (Run, OutputLayout) {
        let mut outputs = self.common.required_at(sampler.kept());
        let common = 0..outputs.len();
        let spans = items.map(|item| Span::lay_out(item, with_context, &mut outputs)).collect();
        (self.run(&outputs), OutputLayout { common, spans })
    }
}
