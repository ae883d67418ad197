//! Running a case's tapes at its places.

use super::evidence::{Sign, Verdict, Witness};
use super::finding::{Finding, Look, fold, undecide, weigh};
use super::judge::{JudgeError, Options};
use super::physics;
use super::point::named;
use super::recorded::{Common, Recorded, Span};
use super::run::{Run, Values};
use super::sampler::{LANES, Sampler};
use crate::case::Case;
use crate::claim::{Kind, Place};
use crate::graph::{Expr, Graph};
use crate::number::ball::Balls;

/// Parameter sets over which the sign of a density is observed.
const PARAMETER_SETS: usize = 4;

/// A case on the bench: its graph and how to run parts of it.
pub struct Bench<'a> {
    pub case: &'a Case,
    pub common: &'a Common,
    pub options: &'a Options,
    pub graph: &'a Graph,
    pub inputs: usize,
}

impl Bench<'_> {
    fn run(&self, outputs: &[Expr]) -> Run {
        Run::new(self.graph, outputs, self.inputs)
    }

    /// Checks that states are on the level, that the field is defined and keeps it; returns
    /// physical warnings.
    pub fn check(&self) -> Result<Vec<String>, JudgeError> {
        let (model, common) = (&self.case.model, self.common);
        self.check_independence()?;
        let level = Place::level(model);
        let sampler = Sampler::new(self.case, &level, self.options.seed)?;
        let states = sampler.balls(0);
        let defined =
            |blocks: &[&Balls<LANES>], lane: usize| blocks.iter().all(|b| b.is_defined(lane));
        let drawn: Vec<&Balls<LANES>> = states.iter().collect();
        if (0..LANES).all(|lane| !defined(&drawn, lane)) {
            let found = LANES as u64;
            return Err(match sampler.is_numerical() {
                true => JudgeError::Unreachable(found),
                false => JudgeError::Overflow(found),
            });
        }
        let outputs =
            [&common.field[..], &common.level, &common.level_rates, &common.physics].concat();
        let values = self.run(&outputs).at(&states);
        let fields = common.field.len();
        let rates = fields + common.level.len();
        let physics = rates + common.level_rates.len();
        let physical = values.range(physics..outputs.len());
        if physics::is_asymmetric(&physical) {
            return Err(JudgeError::AsymmetricInertia);
        }
        for (equation, index) in model.level.iter().zip(fields..rates) {
            let off = values.output(index);
            if let Some(lane) = (0..LANES).find(|lane| off.excludes_zero(*lane)) {
                let (equation, by) = (equation.text.clone(), off.mid[lane]);
                return Err(JudgeError::OffLevel { equation, by });
            }
        }
        if (0..LANES).all(|lane| !defined(&values.range(0..fields), lane)) {
            return Err(JudgeError::Singular(LANES as u64));
        }
        for (equation, index) in model.level.iter().zip(rates..physics) {
            let rate = values.output(index);
            if let Some(lane) = (0..LANES).find(|lane| rate.excludes_zero(*lane)) {
                let (equation, rate) = (equation.text.clone(), rate.mid[lane]);
                return Err(JudgeError::NotInvariant { equation, rate });
            }
        }
        sampler.check_coverage(self.case)?;
        Ok(physics::warnings(&physical))
    }

    /// Checks that no level equation of the user's follows from those before it.
    fn check_independence(&self) -> Result<(), JudgeError> {
        if self.common.dependence.is_empty() {
            return Ok(());
        }
        let everywhere = Place::everywhere(&self.case.model);
        let sampler = Sampler::new(self.case, &everywhere, self.options.seed)?;
        let values = self.run(&self.common.dependence.concat()).at(&sampler.balls(0));
        let width = self.case.model.dimension();
        for (index, equation) in self.case.model.level.iter().enumerate() {
            let left = values.range(index * width..(index + 1) * width);
            if !Look::at(&left, None).excludes_zero() {
                return Err(JudgeError::Dependent(equation.text.clone()));
            }
        }
        Ok(())
    }

    /// The rates of the level functions that a place keeps, where it is a part of the level: a
    /// claim there has a meaning only if the motion stays.
    fn rates_at(&self, place: &Place) -> Vec<Expr> {
        let all = place.kept.iter().all(|kept| *kept);
        let rates = self.common.level_rates.iter().zip(&place.kept);
        rates.filter(|(_, kept)| **kept && !all).map(|(rate, _)| *rate).collect()
    }

    /// Settles the claims made at one place.
    pub fn climb(
        &self,
        place: &Place,
        mut open: Vec<(&Recorded<'_>, &mut Finding)>,
    ) -> Result<(), JudgeError> {
        let sampler = Sampler::new(self.case, place, self.options.seed)?;
        for (item, finding) in &mut open {
            fold(self.graph, item, finding);
            finding.evidence.operations = self.graph.operations(&item.residual);
        }
        let rates = self.rates_at(place);
        if !rates.is_empty() {
            let values = self.run(&rates).at(&sampler.balls(0));
            let kept = self.case.model.level.iter().zip(&place.kept).filter(|(_, kept)| **kept);
            for (index, (equation, _)) in kept.enumerate() {
                let rate = values.output(index);
                if let Some(lane) = (0..LANES).find(|lane| rate.excludes_zero(*lane)) {
                    let (equation, rate) = (equation.text.clone(), rate.mid[lane]);
                    return Err(JudgeError::NotInvariant { equation, rate });
                }
            }
        }
        let mut laid_out: Option<(Run, Vec<Span>)> = None;
        for block in 0..self.blocks() {
            let start = block * LANES as u64;
            let (run, spans) = laid_out.get_or_insert_with(|| {
                self.lay_out(open.iter().map(|(item, _)| *item), block == 0)
            });
            let values = run.at(&sampler.balls(start));
            for ((item, finding), span) in open.iter_mut().zip(spans.iter()) {
                if block == 0 {
                    weigh(item, span, &values, finding);
                }
                if finding.settled.is_none() {
                    self.examine(&sampler, start, span, &values, finding);
                }
            }
            if block == 0 {
                let folded = open.iter_mut().filter(|(_, finding)| finding.holds());
                self.settle_signs(&sampler, folded.map(|(item, finding)| (*item, &mut **finding)));
            }
            let before = open.len();
            open.retain(|(_, finding)| finding.settled.is_none());
            if open.is_empty() {
                break;
            }
            if block == 0 || open.len() < before {
                laid_out = None;
            }
        }
        for (_, finding) in &mut open {
            finding.settled = Some(Verdict::Confirmed);
        }
        self.settle_signs(&sampler, open.into_iter());
        Ok(())
    }

    fn blocks(&self) -> u64 {
        self.options.states.div_ceil(LANES as u64).max(1)
    }

    /// One tape for the claims that are left.
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
    fn examine(
        &self,
        sampler: &Sampler,
        start: u64,
        span: &Span,
        values: &Values,
        finding: &mut Finding,
    ) {
        let evidence = &mut finding.evidence;
        evidence.method = if sampler.is_numerical() { "ball at numerical states" } else { "ball" };
        for lane in 0..LANES {
            let residuals = values.range(span.residual.clone());
            if residuals.iter().any(|ball| !ball.is_defined(lane)) {
                continue;
            }
            evidence.samples += 1;
            for ball in residuals {
                if ball.excludes_zero(lane) {
                    let index = start + lane as u64;
                    let (residual, bound) = (ball.mid[lane], ball.rad[lane]);
                    evidence.witness = Some(self.witness(sampler, index, residual, bound));
                    evidence.max_residual = None;
                    evidence.max_scaled_residual = None;
                    finding.settled = Some(Verdict::Refuted);
                    return;
                }
                let largest =
                    |old: Option<f64>, new: f64| Some(old.map_or(new, |old| old.max(new)));
                evidence.max_residual = largest(evidence.max_residual, ball.mid[lane].abs());
                evidence.max_scaled_residual =
                    largest(evidence.max_scaled_residual, ball.scaled(lane));
            }
        }
    }

    fn witness(&self, sampler: &Sampler, index: u64, residual: f64, error_bound: f64) -> Witness {
        let (parameters, state) = named(&self.case.model, &sampler.printed(index));
        let parameters = parameters.into_iter().map(|(name, value)| (name, listed(&value)));
        let state: Vec<String> =
            state.iter().map(|(name, value)| format!("{name}={}", listed(value))).collect();
        let parameters = parameters.collect();
        Witness { index, parameters, state: state.join(" "), residual, error_bound }
    }

    /// The signs of the densities among claims that hold, over all states for each of a few
    /// parameter sets; a density that is nowhere known to be non-zero is none.
    fn settle_signs<'f, 'r: 'f>(
        &self,
        sampler: &Sampler,
        items: impl Iterator<Item = (&'f Recorded<'r>, &'f mut Finding)>,
    ) {
        let (densities, mut findings): (Vec<Expr>, Vec<&mut Finding>) = items
            .filter(|(item, _)| matches!(item.claim.kind, Kind::Density(_)))
            .filter_map(|(item, finding)| Some((item.context.value?, finding)))
            .unzip();
        if densities.is_empty() {
            return;
        }
        let run = self.run(&densities);
        let mut seen = vec![[[false; 2]; PARAMETER_SETS]; densities.len()];
        for block in 0..self.blocks() {
            let states = sampler.balls_sharing_parameters(block * LANES as u64, PARAMETER_SETS);
            let values = run.at(&states);
            for (index, seen) in seen.iter_mut().enumerate() {
                let ball = values.output(index);
                for lane in (0..LANES).filter(|lane| ball.excludes_zero(*lane)) {
                    let set = lane * PARAMETER_SETS / LANES;
                    seen[set][usize::from(ball.mid[lane] > 0.0)] = true;
                }
            }
        }
        for (finding, seen) in findings.iter_mut().zip(&seen) {
            finding.evidence.sign = sign(seen);
            if finding.evidence.sign.is_none() {
                undecide(finding, "the density is 0 at all states that were tried".to_string());
            }
        }
    }

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
                    asked.push((finding, residual, scale, extend(&wider.defects)));
                }
            }
            if asked.is_empty() {
                continue;
            }
            let sampler = Sampler::new(self.case, place, self.options.seed)?;
            let values = self.run(&outputs).at(&sampler.balls(0));
            if Look::at(&values.range(rates), None).excludes_zero() {
                continue;
            }
            for (finding, residual, scale, defects) in asked {
                let scale = values.range(scale).first().copied();
                let sound = defects.is_empty() || Look::at(&values.range(defects), None).is_zero();
                if sound && Look::at(&values.range(residual), scale).is_zero() {
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

/// One sign from what was seen, negative and positive, at each set of parameters.
fn sign(seen: &[[bool; 2]]) -> Option<Sign> {
    if seen.contains(&[true, true]) {
        return Some(Sign::Changes);
    }
    // Another sign for other parameters is one measure for each of them, up to a factor -1.
    let [negative, positive] = [0, 1].map(|sign| seen.iter().any(|set| set[sign]));
    match (positive, negative) {
        (true, _) => Some(Sign::Positive),
        (false, true) => Some(Sign::Negative),
        (false, false) => None,
    }
}

/// A value as `--set` and `--state` take it: a number, a list, rows of lists.
fn listed(components: &[String]) -> String {
    match components {
        [one] => one.clone(),
        [_, _, _] => format!("[{}]", components.join(",")),
        _ => {
            let rows: Vec<String> = components.chunks(3).map(listed).collect();
            format!("[{}]", rows.join(","))
        }
    }
}
