//! Running a case's tapes at its places.

use super::evidence::{Sign, Verdict, Witness};
use super::finding::{Finding, Look, fold, weigh};
use super::judge::{JudgeError, Options};
use super::physics;
use super::point::named;
use super::recorded::{Common, Recorded, Span};
use super::run::{Run, Values};
use super::sampler::{LANES, Sampler};
use crate::case::Case;
use crate::claim::Place;
use crate::graph::{Expr, Graph};
use crate::number::ball::Balls;

/// Parameter sets over which the sign of a density is observed.
const PARAMETER_SETS: usize = 4;

/// A case on the bench: its graph and how to run parts of it.
pub struct Bench<'a> {
    pub case: &'a Case,
    pub options: &'a Options,
    pub graph: &'a Graph,
    pub inputs: usize,
}

impl Bench<'_> {
    fn run(&self, outputs: &[Expr]) -> Run {
        Run::new(self.graph, outputs, self.inputs)
    }

    /// Checks that the field is defined and keeps the level; returns physical warnings.
    pub fn common(&self, common: &Common) -> Result<Vec<String>, JudgeError> {
        let level = Place::level(&self.case.model);
        let sampler = Sampler::new(self.case, &level, self.options.seed)?;
        let states = sampler.balls(0);
        let defined =
            |blocks: &[&Balls<LANES>], lane: usize| blocks.iter().all(|b| b.is_defined(lane));
        let drawn: Vec<&Balls<LANES>> = states.iter().collect();
        if (0..LANES).all(|lane| !defined(&drawn, lane)) {
            return Err(JudgeError::Unreachable(LANES as u64));
        }
        let outputs = [&common.field[..], &common.level_rates, &common.physics].concat();
        let values = self.run(&outputs).at(&states);
        let (fields, rates) = (common.field.len(), common.level_rates.len());
        if (0..LANES).all(|lane| !defined(&values.range(0..fields), lane)) {
            return Err(JudgeError::Singular(LANES as u64));
        }
        for (equation, index) in self.case.model.level.iter().zip(fields..) {
            let rate = values.output(index);
            if let Some(lane) = (0..LANES).find(|lane| rate.excludes_zero(*lane)) {
                let (equation, rate) = (equation.text.clone(), rate.mid[lane]);
                return Err(JudgeError::NotInvariant { equation, rate });
            }
        }
        Ok(physics::warnings(&values.range(fields + rates..outputs.len())))
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
        let blocks = self.options.states.div_ceil(LANES as u64).max(1);
        let mut laid_out: Option<(Run, Vec<Span>)> = None;
        for block in 0..blocks {
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
                for (item, finding) in open.iter_mut().filter(|(_, finding)| finding.holds()) {
                    finding.evidence.sign = self.sign(&sampler, item);
                }
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
        for (item, finding) in open {
            finding.settled = Some(Verdict::Confirmed);
            finding.evidence.sign = self.sign(&sampler, item);
        }
        Ok(())
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

    /// The sign of a density, over many states for each of a few parameter sets.
    fn sign(&self, sampler: &Sampler, item: &Recorded<'_>) -> Option<Sign> {
        let density = item.context.density?;
        let states = sampler.balls_sharing_parameters(PARAMETER_SETS);
        let values = self.run(&[density]).at(&states);
        let ball = values.output(0);
        let lanes_of = |set: usize| {
            let width = LANES / PARAMETER_SETS;
            (set * width..(set + 1) * width).filter(|lane| ball.excludes_zero(*lane))
        };
        let mut signs = Vec::new();
        for set in 0..PARAMETER_SETS {
            let positive = lanes_of(set).filter(|lane| ball.mid[*lane] > 0.0).count();
            match (positive, lanes_of(set).count()) {
                (_, 0) => {}
                (positive, all) if positive == all => signs.push(Sign::Positive),
                (0, _) => signs.push(Sign::Negative),
                _ => return Some(Sign::Changes),
            }
        }
        // Another sign for other parameters is one measure for each of them, up to a factor -1.
        if signs.contains(&Sign::Positive) { Some(Sign::Positive) } else { signs.first().copied() }
    }

    /// Finds out in which wider places the claims hold that hold at their own.
    pub fn widen(
        &self,
        recorded: &[Recorded<'_>],
        findings: &mut [Finding],
    ) -> Result<(), JudgeError> {
        let model = &self.case.model;
        let mut places: Vec<&Place> = Vec::new();
        for place in recorded.iter().flat_map(|item| item.wider.iter().map(|(place, _)| place)) {
            if !places.contains(&place) {
                places.push(place);
            }
        }
        for place in places {
            let mut outputs = Vec::new();
            let mut asked = Vec::new();
            for (item, finding) in recorded.iter().zip(findings.iter_mut()) {
                let residual = item.wider.iter().find(|(wider, _)| wider == place);
                let holds = finding.holds();
                let covered = finding.evidence.holds.iter().any(|name| name == "everywhere");
                if let (Some((_, residual)), true, false) = (residual, holds, covered) {
                    let span = outputs.len()..outputs.len() + residual.len();
                    outputs.extend(residual.iter().chain(&item.context.scale).copied());
                    let scale = item.context.scale.map(|_| span.end);
                    asked.push((finding, span, scale));
                }
            }
            if asked.is_empty() {
                continue;
            }
            let sampler = Sampler::new(self.case, place, self.options.seed)?;
            let values = self.run(&outputs).at(&sampler.balls(0));
            for (finding, span, scale) in asked {
                let scale = scale.map(|index| values.output(index));
                if Look::at(&values.range(span), scale).is_zero() {
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
