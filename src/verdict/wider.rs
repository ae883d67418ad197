//! Where else a claim holds that holds at its own place.
//!
//! A proof goes no further than a proof does: beside `proved` only places stand where the residual is
//! a constant 0, or zero in prime fields. What enclosures show adds places to what is confirmed by
//! them, and never contradicts that a claim holds in one place only.

use super::bench::Bench;
use super::evidence::Verdict;
use super::field::Field;
use super::finding::{Finding, Look};
use super::judge::{JudgeError, Trust};
use super::recorded::Recorded;
use super::run::Doubles;
use super::sampler::{LANES, Sampler};
use crate::claim::Place;
use crate::graph::Expr;
use crate::number::ball::Ball;
use crate::proof::Outcome;

impl Bench<'_> {
    /// Finds out in which wider places the claims hold that hold at their own.
    pub fn widen(
        &self,
        recorded: &[Recorded<'_>],
        findings: &mut [Finding],
    ) -> Result<(), JudgeError> {
        let model = &self.case.model;
        let mut places: Vec<&Place> = Vec::new();
        for place in recorded.iter().flat_map(|item| item.wider.iter().map(|wider| &wider.place)) {
            if !places.contains(&place) {
                places.push(place);
            }
        }
        for place in places {
            let mut outputs = self.rates_at(place);
            let rates = 0..outputs.len();
            let mut extend = |some: &[Expr]| {
                let start = outputs.len();
                outputs.extend_from_slice(some);
                start..outputs.len()
            };
            let mut asked = Vec::new();
            for (item, finding) in recorded.iter().zip(findings.iter_mut()) {
                let wider = item.wider.iter().find(|wider| wider.place == *place);
                let covered = finding.evidence.holds.iter().any(|name| name == "everywhere");
                if let (Some(wider), true, false) = (wider, finding.holds(), covered) {
                    let residual = extend(&wider.residual);
                    let scale = extend(item.context.scale.as_slice());
                    asked.push((item.claim, finding, residual, scale, extend(&wider.defects)));
                }
            }
            if asked.is_empty() {
                continue;
            }
            let sampler = Sampler::new(self.case, place, self.options.seed)?;
            let values = self.run(&outputs).at(&Ball::<LANES>, &sampler.balls(0));
            if Look::at::<Doubles>(&values.range(rates), None).excludes_zero() {
                continue;
            }
            let mut open = Vec::new();
            for (claim, finding, residual, scale, defects) in asked {
                let scale = values.range(scale).first().copied();
                let sound = defects.is_empty()
                    || Look::at::<Doubles>(&values.range(defects.clone()), None).is_zero();
                let look = Look::at::<Doubles>(&values.range(residual.clone()), scale);
                if sound && !look.excludes_zero() {
                    let group = [&outputs[residual], &outputs[defects]].concat();
                    open.push((claim, finding, group, look.is_zero()));
                }
            }
            let groups: Vec<Vec<Expr>> =
                open.iter().map(|(_, _, group, _)| group.clone()).collect();
            let outcomes = match self.options.trust {
                Trust::Float => vec![None; groups.len()],
                _ => Field::new(self, &sampler).test(&groups)?.into_iter().map(Some).collect(),
            };
            for ((claim, finding, group, is_zero), outcome) in open.into_iter().zip(outcomes) {
                let holds = match outcome {
                    Some(Outcome::Zero(_)) => true,
                    Some(Outcome::NonZero) => false,
                    Some(Outcome::Silent(_)) | None => {
                        let constant = |expr: &Expr| self.graph.constant_value(*expr);
                        let folded = group.iter().all(|x| constant(x).is_some_and(|x| x.is_zero()));
                        let confirmed = finding.settled == Some(Verdict::Confirmed);
                        if is_zero && claim.only_there && !folded {
                            let place = place.name(model);
                            let reason = format!("whether it holds {place} too is not known");
                            finding.evidence.reason = Some(reason);
                        }
                        folded || (is_zero && confirmed && !claim.only_there)
                    }
                };
                if holds {
                    finding.evidence.holds.push(place.name(model));
                }
            }
        }
        for (item, finding) in recorded.iter().zip(findings) {
            if finding.holds() && finding.evidence.holds.is_empty() {
                finding.evidence.holds.push(item.claim.place.name(model));
            }
        }
        Ok(())
    }
}
