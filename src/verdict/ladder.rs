//! The ladder: from the cheapest rung to the surest, until each claim is settled.
//!
//! ```text
//! folding             the residual became a constant while it was recorded
//! ball                enclosures in f64 at the first states: most false claims end here
//! prime field         true claims end here, proved; a value that is not 0 sends the others up
//! ball                further states, for claims on which the field is silent
//! double-double ball  twice the digits, for what is off by little
//! ball of n bits      ever more digits, for what the field knows to be no identity
//! ```

use super::bench::Bench;
use super::evidence::{Proof, Verdict, Witness};
use super::field::{Field, TOO_MANY_COMBINATIONS, combinations};
use super::finding::{Finding, NO_QUADRATURE, are_zero, fold, undecide, weigh};
use super::judge::{JudgeError, Trust};
use super::recorded::{Recorded, Span};
use super::run::{Run, Values, waves};
use super::sampler::{LANES, Sampler};
use super::witness::witness;
use crate::claim::Place;
use crate::graph::Expr;
use crate::number::Enclosing;
use crate::number::ball::Ball;
use crate::number::precise::Precise;
use crate::number::twofold::TwofoldBall;
use crate::proof::Outcome;

/// Precisions of the last rung.
const BITS: [u32; 5] = [256, 512, 1024, 2048, 4096];
/// States that are tried with each of them.
const PRECISE_STATES: u64 = 4;

pub type Open<'f, 'r> = Vec<(&'f Recorded<'r>, &'f mut Finding)>;

impl Bench<'_> {
    /// Settles the claims made at one place.
    pub fn climb<'f, 'r: 'f>(
        &self,
        place: &Place,
        mut open: Open<'f, 'r>,
    ) -> Result<(), JudgeError> {
        let sampler = Sampler::new(self.case, place, self.options.seed)?;
        self.check_motion(place, &sampler)?;
        if sampler.has_lists() {
            let (negated, others): (Open<'_, '_>, Open<'_, '_>) =
                open.into_iter().partition(|(item, _)| item.claim.kind.is_negated());
            open = others;
            self.climb_each(place, &sampler, negated)?;
        }
        self.settle(place, &sampler, &mut open)?;
        let mut holding: Open<'_, '_> =
            open.into_iter().filter(|(_, finding)| finding.holds()).collect();
        self.settle_novelty(&sampler, &mut holding)?;
        self.settle_signs(&sampler, holding.into_iter());
        Ok(())
    }

    /// Climbs until each claim is settled.
    fn settle(
        &self,
        place: &Place,
        sampler: &Sampler,
        open: &mut Open<'_, '_>,
    ) -> Result<(), JudgeError> {
        for (item, finding) in open.iter_mut() {
            fold(self.graph, item, finding);
            finding.evidence.operations = self.graph.operations(&item.residual);
        }
        self.first_states(sampler, open);
        if self.options.trust != Trust::Float {
            self.fields(place, sampler, open)?;
        }
        self.further_states(sampler, open);
        if self.options.trust != Trust::Float && !sampler.is_numerical() {
            self.more_digits(sampler, open);
        }
        for (item, finding) in open.iter_mut().filter(|(_, finding)| finding.settled.is_none()) {
            conclude(item, finding);
        }
        Ok(())
    }

    /// Claims that something does *not* vanish, for each choice of listed values by itself: one at
    /// which it does is enough to be wrong.
    fn climb_each(
        &self,
        place: &Place,
        sampler: &Sampler,
        open: Open<'_, '_>,
    ) -> Result<(), JudgeError> {
        let Some(choices) = combinations(sampler.recipes()) else {
            for (_, finding) in open {
                undecide(finding, TOO_MANY_COMBINATIONS.to_string());
            }
            return Ok(());
        };
        for (item, finding) in open {
            for fixed in &choices {
                let mut one = Finding::default();
                let chosen = sampler.with(fixed);
                self.settle(place, &chosen, &mut vec![(item, &mut one)])?;
                let refuted = one.settled == Some(Verdict::Refuted);
                if !refuted || finding.settled.is_none() {
                    *finding = one;
                }
                if !refuted {
                    let listed = chosen.listed(self.case);
                    let reason = finding.evidence.reason.get_or_insert_default();
                    let separator = if reason.is_empty() { "" } else { ": " };
                    *reason = format!("for {listed}{separator}{reason}");
                    break;
                }
            }
        }
        Ok(())
    }

    /// Checks that the motion stays on a part of the level.
    fn check_motion(&self, place: &Place, sampler: &Sampler) -> Result<(), JudgeError> {
        let rates = self.rates_at(place);
        if rates.is_empty() {
            return Ok(());
        }
        let values = self.run(&rates).at(&Ball::<LANES>, &sampler.balls(0));
        let kept = self.case.model.level.iter().zip(&place.kept).filter(|(_, kept)| **kept);
        for (index, (equation, _)) in kept.enumerate() {
            let rate = values.output(index);
            if let Some(lane) = (0..LANES).find(|lane| rate.excludes_zero(*lane)) {
                let (equation, rate) = (equation.text.clone(), format!("{:e}", rate.mid[lane]));
                return Err(JudgeError::NotInvariant { equation, rate });
            }
        }
        Ok(())
    }

    /// Balls over f64 at the first block, with what tells rounding from truth.
    fn first_states(&self, sampler: &Sampler, open: &mut Open<'_, '_>) {
        let (run, spans) = self.lay_out(open.iter().map(|(item, _)| *item), true);
        let values = run.at(&Ball::<LANES>, &sampler.balls(0));
        for ((item, finding), span) in open.iter_mut().zip(&spans) {
            weigh(item, span, &values, finding);
            if finding.settled.is_none() && finding.undefined.is_none() {
                self.examine(sampler, 0, span, &values, f64::MANTISSA_DIGITS, finding);
            }
        }
    }

    /// Prime fields: what is zero there is proved.
    fn fields(
        &self,
        place: &Place,
        sampler: &Sampler,
        open: &mut Open<'_, '_>,
    ) -> Result<(), JudgeError> {
        let mut unsettled: Vec<_> =
            open.iter_mut().filter(|(_, finding)| finding.settled.is_none()).collect();
        let ground = self.ground(place);
        if unsettled.is_empty() && ground.is_empty() {
            return Ok(());
        }
        let mut groups = vec![ground];
        groups.extend(
            unsettled
                .iter()
                .map(|(item, _)| [&item.residual[..], &item.context.quadrature_defects].concat()),
        );
        let field = Field::new(self, sampler);
        let mut outcomes = field.test(&groups)?.into_iter();
        let ground = outcomes.next();
        if ground == Some(Outcome::NonZero) {
            self.name_the_error(place, sampler)?;
        }
        for ((item, finding), outcome) in unsettled.iter_mut().zip(outcomes) {
            let defects = &item.context.quadrature_defects;
            if outcome == Outcome::NonZero
                && !are_zero(self.graph, defects)
                && field.test(std::slice::from_ref(defects))?.contains(&Outcome::NonZero)
            {
                finding.rung("prime field", NO_QUADRATURE.to_string());
                undecide(finding, NO_QUADRATURE.to_string());
                continue;
            }
            let outcome = match (&ground, outcome) {
                (Some(Outcome::Zero(ground)), Outcome::Zero(own)) => Outcome::Zero(ground.and(own)),
                (_, Outcome::Zero(_)) => Outcome::Silent(
                    "it is not proved that states are on the level, and stay".to_string(),
                ),
                (_, outcome) => outcome,
            };
            match outcome {
                Outcome::Zero(certificate) => {
                    let proof = Proof::from(certificate);
                    finding.rung("prime field", proof.to_string());
                    finding.evidence.proof = Some(proof);
                    finding.is_zero = true;
                    if finding.undefined.is_none() {
                        finding.evidence.method = "prime field";
                        finding.settled = Some(Verdict::Proved);
                    }
                }
                Outcome::NonZero => {
                    finding.rung("prime field", "not 0, so no identity".to_string());
                    finding.is_nonzero = true;
                }
                Outcome::Silent(reason) => {
                    finding.rung("prime field", format!("silent: {reason}"));
                    finding.evidence.silence = Some(reason);
                }
            }
        }
        Ok(())
    }

    /// Tells which equation does not hold, or is left, where the ground is known not to be zero.
    fn name_the_error(&self, place: &Place, sampler: &Sampler) -> Result<(), JudgeError> {
        let kept = || (0..place.kept.len()).filter(|index| place.kept[*index]);
        let text = |index: usize| self.case.model.level[index].text.clone();
        let single = |values: &[Expr]| kept().map(|index| vec![values[index]]).collect::<Vec<_>>();
        let (level, rates) = (single(&self.common.level), single(&self.common.level_rates));
        let field = Field::new(self, sampler);
        for (index, outcome) in kept().zip(field.test(&level)?) {
            if outcome == Outcome::NonZero {
                let by = self.magnitude(sampler, self.common.level[index]);
                return Err(JudgeError::OffLevel { equation: text(index), by });
            }
        }
        for (index, outcome) in kept().zip(field.test(&rates)?) {
            if outcome == Outcome::NonZero {
                let rate = self.magnitude(sampler, self.common.level_rates[index]);
                return Err(JudgeError::NotInvariant { equation: text(index), rate });
            }
        }
        Ok(())
    }

    /// A value that is not identically zero, at a state where it is seen not to be.
    fn magnitude(&self, sampler: &Sampler, value: Expr) -> String {
        let run = self.run(&[value]);
        for bits in BITS {
            let domain = Precise::new(bits);
            for index in 0..PRECISE_STATES {
                let values = run.at(&domain, &sampler.states(&domain, 1, index));
                if let Some(found) = values.output(0).as_ref().filter(|x| x.excludes_zero()) {
                    return found.rough();
                }
            }
        }
        format!("less than {} bits tell from 0", BITS[BITS.len() - 1])
    }

    /// What must vanish for states to be on the level and to stay there.
    fn ground(&self, place: &Place) -> Vec<Expr> {
        let kept = |all: &[Expr]| -> Vec<Expr> {
            let pairs = all.iter().zip(&place.kept).filter(|(_, kept)| **kept);
            pairs.map(|(value, _)| *value).collect()
        };
        [kept(&self.common.level), kept(&self.common.level_rates)].concat()
    }

    /// Balls over f64 at the other blocks, for claims that the fields did not settle.
    fn further_states(&self, sampler: &Sampler, open: &mut Open<'_, '_>) {
        let mut laid_out: Option<(Run, Vec<Span>, usize)> = None;
        for blocks in waves(1..self.blocks()) {
            let mut left: Vec<_> = open
                .iter_mut()
                .filter(|(_, finding)| {
                    finding.settled.is_none() && !finding.is_nonzero && !finding.is_zero
                })
                .collect();
            if left.is_empty() {
                return;
            }
            if laid_out.as_ref().is_none_or(|(_, _, count)| *count != left.len()) {
                let (run, spans) = self.lay_out(left.iter().map(|(item, _)| *item), false);
                laid_out = Some((run, spans, left.len()));
            }
            let Some((run, spans, _)) = &laid_out else { return };
            let values = run.at_blocks(sampler, blocks.clone(), |maker, at| maker.balls(at));
            for (block, values) in blocks.zip(values) {
                let start = block * LANES as u64;
                for ((_, finding), span) in left.iter_mut().zip(spans) {
                    if finding.settled.is_none() {
                        self.examine(sampler, start, span, &values, f64::MANTISSA_DIGITS, finding);
                    }
                }
            }
        }
    }

    /// Balls with ever more digits, for claims that are still open.
    fn more_digits(&self, sampler: &Sampler, open: &mut Open<'_, '_>) {
        let mut left: Vec<_> =
            open.iter_mut().filter(|(_, finding)| finding.settled.is_none()).collect();
        if left.is_empty() {
            return;
        }
        let (run, spans) = self.lay_out(left.iter().map(|(item, _)| *item), true);
        let domain = TwofoldBall::<LANES>;
        let values = run.at(&domain, &sampler.states(&domain, LANES, 0));
        for ((item, finding), span) in left.iter_mut().zip(&spans) {
            let method = "double-double ball";
            finding.evidence.method = method;
            weigh(item, span, &values, finding);
            if finding.undefined.is_some() && self.is_out_of_range(item, sampler) {
                finding.undefined = None;
            }
            if finding.settled.is_none() && finding.undefined.is_none() {
                self.examine(sampler, 0, span, &values, 2 * f64::MANTISSA_DIGITS, finding);
            }
        }
        let deserves = |finding: &Finding| {
            finding.settled.is_none() && !finding.is_zero && finding.undefined.is_none()
        };
        for (item, finding) in left.iter_mut().filter(|(_, finding)| deserves(finding)) {
            let run = self.run(&item.residual);
            let all = 0..item.residual.len();
            let before = finding.evidence.method;
            // Where the fields are silent there may be nothing to find.
            let precisions = if finding.is_nonzero { &BITS[..] } else { &BITS[..1] };
            for bits in precisions {
                let domain = Precise::new(*bits);
                finding.evidence.method = "ball of many bits";
                for index in 0..PRECISE_STATES {
                    let values = run.at(&domain, &sampler.states(&domain, 1, index));
                    if finding.settled.is_none() {
                        self.seek_witness(sampler, index, all.clone(), &values, *bits, finding);
                    }
                }
            }
            if finding.settled.is_none() && !finding.is_nonzero {
                finding.evidence.method = before;
            }
        }
    }

    /// Have formula and residual a value that only numbers of 64 bits are too small for?
    fn is_out_of_range(&self, item: &Recorded<'_>, sampler: &Sampler) -> bool {
        let outputs: Vec<Expr> = item.residual.iter().chain(&item.context.value).copied().collect();
        let (run, domain) = (self.run(&outputs), Precise::new(BITS[0]));
        let is_defined = |index| {
            let values = run.at(&domain, &sampler.states(&domain, 1, index));
            values.range(0..outputs.len()).iter().all(|value| value.is_some())
        };
        item.context.quadrature_defects.is_empty() && (0..PRECISE_STATES).any(is_defined)
    }

    /// One tape for some claims.
    fn lay_out<'r>(
        &self,
        items: impl Iterator<Item = &'r Recorded<'r>>,
        with_context: bool,
    ) -> (Run, Vec<Span>) {
        let mut outputs = Vec::new();
        let spans = items.map(|item| Span::lay_out(item, with_context, &mut outputs)).collect();
        (self.run(&outputs), spans)
    }

    /// Looks for a state whose enclosure excludes zero; otherwise takes the block into account.
    fn examine<D: Enclosing>(
        &self,
        sampler: &Sampler,
        start: u64,
        span: &Span,
        values: &Values<D>,
        bits: u32,
        finding: &mut Finding,
    ) {
        if finding.evidence.method.is_empty() {
            let numerical = sampler.is_numerical();
            finding.evidence.method = if numerical { "ball at numerical states" } else { "ball" };
        }
        if self.seek_witness(sampler, start, span.residual.clone(), values, bits, finding) {
            return;
        }
        let residuals = values.range(span.residual.clone());
        let mut states = 0;
        let (mut largest, mut scaled) = (0f64, 0f64);
        for lane in 0..D::LANES {
            let enclosures = || residuals.iter().map(|block| D::enclosure(block, lane));
            if enclosures().any(|enclosure| enclosure.is_none()) {
                continue;
            }
            states += 1;
            for (mid, rad) in enclosures().flatten() {
                largest = largest.max(mid.abs());
                scaled = scaled.max(if mid == 0.0 { 0.0 } else { mid.abs() / rad });
            }
        }
        let evidence = &mut finding.evidence;
        if start > 0 || evidence.samples == 0 {
            evidence.samples += states;
        }
        // More digits replace what fewer digits found, more states add to it.
        let before = |old: Option<f64>| if start > 0 { old.unwrap_or(0.0) } else { 0.0 };
        evidence.max_residual = Some(before(evidence.max_residual).max(largest));
        evidence.max_scaled_residual = Some(before(evidence.max_scaled_residual).max(scaled));
        let method = evidence.method;
        finding.rung(method, format!("0 enclosed at {states} states, at most {largest:.1e}"));
    }

    /// Settles a claim as refuted by the first state whose enclosure excludes zero, if any.
    fn seek_witness<D: Enclosing>(
        &self,
        sampler: &Sampler,
        start: u64,
        residual: std::ops::Range<usize>,
        values: &Values<D>,
        bits: u32,
        finding: &mut Finding,
    ) -> bool {
        let residuals = values.range(residual);
        for lane in 0..D::LANES {
            if residuals.iter().any(|block| D::enclosure(block, lane).is_none()) {
                continue;
            }
            let away = residuals.iter().find(|block| D::excludes_zero(block, lane));
            let digits = away.and_then(|block| D::beyond_f64(block, lane));
            if let Some((mid, rad)) = away.and_then(|block| D::enclosure(block, lane)) {
                let index = start + lane as u64;
                let evidence = &mut finding.evidence;
                evidence.samples = evidence.samples.max(lane + 1);
                let found = match &digits {
                    Some(digits) => format!("{digits} at state {index}"),
                    None => format!("{mid:.3e} ± {rad:.1e} at state {index}"),
                };
                let witness = witness(self.case, sampler, index, bits, (mid, rad));
                evidence.witness = Some(Witness { digits, ..witness });
                evidence.max_residual = None;
                evidence.max_scaled_residual = None;
                finding.settled = Some(Verdict::Refuted);
                let method = finding.evidence.method;
                finding.rung(method, found);
                return true;
            }
        }
        false
    }
}

/// The verdict on a claim that no state refuted.
fn conclude(item: &Recorded<'_>, finding: &mut Finding) {
    let kind = item.claim.kind.name();
    let mut settle = |verdict: Verdict, method: &'static str| {
        finding.settled = Some(verdict);
        if !method.is_empty() {
            finding.evidence.method = method;
        }
    };
    if let Some(reason) = finding.undefined.take() {
        finding.evidence.proof = None;
        undecide(finding, reason);
    } else if finding.is_zero {
        settle(Verdict::Proved, "prime field");
    } else if finding.is_nonzero {
        settle(Verdict::Refuted, "prime field");
        finding.evidence.reason = Some(format!(
            "modulo a prime the residual of this {kind} is not 0, so it is no identity"
        ));
    } else if let Some(reason) = finding.blurred.take() {
        undecide(finding, reason);
    } else {
        settle(Verdict::Confirmed, "");
    }
}
