//! The ladder for all claims of a case: record once, then climb until each claim is settled.
//!
//! 1. *Folding*: a residual that was simplified to a constant while it was recorded is settled.
//! 2. *Balls over f64* at the first block of states, together with what tells rounding from truth;
//! 3. at further blocks, for the claims that are left.

use std::collections::BTreeMap;

use super::evidence::{ClaimReport, Evidence, Independence, Sign, Verdict, Witness};
use super::physics;
use super::run::{Run, Values};
use super::sampler::{LANES, Sampler};
use crate::case::{Case, Claim, Expect};
use crate::claim::{Context, Kind, Place};
use crate::graph::{Expr, Fault, Graph, record};
use crate::mechanics::Phase;
use crate::mechanics::calculus::Jet;
use crate::number::ball::Balls;

/// A claim is confirmed by no fewer states of the first block than this.
const MIN_STATES: usize = LANES / 4;
/// Bits of the residual's scale that its error bound must leave for a state to count: what is
/// blurred more than this could hide a term.
const RESOLVED_BITS: i32 = 16;
/// Parameter sets over which the sign of a density is observed.
const PARAMETER_SETS: usize = 4;

/// How thoroughly to judge.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The seed of all states.
    pub seed: u64,
    /// How many states a claim must survive, in steps of 64.
    pub states: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self { seed: 1, states: 4 * LANES as u64 }
    }
}

/// A case with the verdicts on its claims.
#[derive(Clone, Debug)]
pub struct CaseReport {
    /// One report a claim, in the order of the file.
    pub claims: Vec<ClaimReport>,
    /// What is physically impossible about the states that were drawn.
    pub warnings: Vec<String>,
}

/// Why a case cannot be judged.
#[derive(Clone, Debug, thiserror::Error)]
pub enum JudgeError {
    /// A formula asked a recorded value for its magnitude.
    #[error(transparent)]
    Fault(#[from] Fault),
    /// No state could be drawn.
    #[error("no state on the level set was found among {0} starts")]
    Unreachable(u64),
    /// The field is nowhere defined.
    #[error("the equations of motion are undefined at all {0} states that were drawn")]
    Singular(u64),
    /// The level set is left by the motion.
    #[error(
        "the level set is not invariant: along the motion `{equation}` changes at rate {rate:e}"
    )]
    NotInvariant {
        /// The equation that is left.
        equation: String,
        /// Its rate at a state.
        rate: f64,
    },
}

impl JudgeError {
    /// What to do about it.
    pub fn help(&self) -> &'static str {
        match self {
            JudgeError::Fault(_) => "write the formula with operations that hold for every number",
            JudgeError::Unreachable(_) => {
                "check the equations of [level], or widen the ranges of [state]"
            }
            JudgeError::Singular(_) => {
                "look for a division by zero, the root of a negative number, or a singular inertia \
                 tensor in [parameters]"
            }
            JudgeError::NotInvariant { .. } => {
                "a claim on a level set has a meaning only if the motion stays on it: correct the \
                 equation, or the field"
            }
        }
    }
}

/// A claim with everything recorded about it.
struct Recorded<'c> {
    claim: &'c Claim,
    residual: Vec<Expr>,
    context: Context,
    /// Wider places with the residual there.
    wider: Vec<(Place, Vec<Expr>)>,
}

/// What is known of a claim while the ladder is climbed.
#[derive(Default)]
struct Finding {
    settled: Option<Verdict>,
    evidence: Evidence,
}

/// Judges all claims of a case.
pub fn judge(case: &Case, options: &Options) -> Result<CaseReport, JudgeError> {
    let model = &case.model;
    let inputs = model.free_components() + model.dimension();
    let (graph, (recorded, common)) = record(inputs, |inputs| {
        let (parameters, state) = inputs.split_at(model.free_components());
        let jet = Jet::new(Phase::new(model, parameters, state));
        let recorded: Vec<Recorded<'_>> =
            case.claims.iter().map(|claim| recorded(claim, &jet)).collect();
        (recorded, Common::of(&jet))
    })?;
    let bench = Bench { case, options, graph: &graph, inputs };
    let mut findings: Vec<Finding> = recorded.iter().map(|_| Finding::default()).collect();
    let mut warnings = bench.common(&common)?;
    let mut places: Vec<&Place> = Vec::new();
    for claim in &case.claims {
        if !places.contains(&&claim.place) {
            places.push(&claim.place);
        }
    }
    for place in places {
        let at_place =
            recorded.iter().zip(&mut findings).filter(|(item, _)| item.claim.place == *place);
        bench.climb(place, at_place.collect())?;
    }
    bench.widen(&recorded, &mut findings)?;
    if matches!(case.chart, crate::mechanics::Chart::Numerical) && !model.level.is_empty() {
        warnings.push(
            "the level set has no parametrisation: states are found numerically, and verdicts on it \
             rest on an estimated distance from it"
                .to_string(),
        );
    }
    let claims =
        recorded.iter().zip(findings).map(|(item, finding)| report(case, item, finding)).collect();
    Ok(CaseReport { claims, warnings })
}

fn recorded<'c>(claim: &'c Claim, jet: &Jet<'_, Expr>) -> Recorded<'c> {
    let residual = |place: &Place| claim.kind.residual(jet, &place.kept);
    let wider = match claim.kind {
        Kind::Integral(_) | Kind::Density(_) if claim.expect != Expect::Fails => {
            claim.place.wider(jet.phase.model())
        }
        _ => Vec::new(),
    };
    Recorded {
        claim,
        residual: residual(&claim.place),
        context: claim.kind.context(jet, &claim.place.kept),
        wider: wider.into_iter().map(|place| (place.clone(), residual(&place))).collect(),
    }
}

/// What is asked of every case, whatever it claims.
struct Common {
    field: Vec<Expr>,
    level_rates: Vec<Expr>,
    physics: Vec<Expr>,
}

impl Common {
    fn of(jet: &Jet<'_, Expr>) -> Self {
        let rate = |function| jet.lie_derivative(|at| at.level_function(function));
        let phase = &jet.phase;
        Self {
            field: phase.field().to_vec(),
            level_rates: phase.model().level.iter().map(|e| rate(&e.function)).collect(),
            physics: physics::outputs(phase),
        }
    }
}

/// A case on the bench: its graph and how to run parts of it.
struct Bench<'a> {
    case: &'a Case,
    options: &'a Options,
    graph: &'a Graph,
    inputs: usize,
}

impl Bench<'_> {
    fn run(&self, outputs: &[Expr]) -> Run {
        Run::new(self.graph, outputs, self.inputs)
    }

    /// Checks that the field is defined and keeps the level; returns physical warnings.
    fn common(&self, common: &Common) -> Result<Vec<String>, JudgeError> {
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
    fn climb(
        &self,
        place: &Place,
        mut open: Vec<(&Recorded<'_>, &mut Finding)>,
    ) -> Result<(), JudgeError> {
        let sampler = Sampler::new(self.case, place, self.options.seed)?;
        for (item, finding) in &mut open {
            fold(self.graph, item, finding);
        }
        let blocks = self.options.states.div_ceil(LANES as u64).max(1);
        for block in 0..blocks {
            let start = block * LANES as u64;
            let mut outputs = Vec::new();
            let spans: Vec<_> = open
                .iter()
                .map(|(item, _)| Span::lay_out(item, block == 0, &mut outputs))
                .collect();
            let run = self.run(&outputs);
            let values = run.at(&sampler.balls(start));
            for ((item, finding), span) in open.iter_mut().zip(&spans) {
                if block == 0 {
                    finding.evidence.operations = self.run(&item.residual).operations();
                    weigh(item, span, &values, finding);
                }
                if finding.settled.is_none() {
                    self.examine(&sampler, start, span, &values, finding);
                }
            }
            open.retain(|(_, finding)| finding.settled.is_none());
            if open.is_empty() {
                break;
            }
        }
        for (item, finding) in open {
            finding.settled = Some(Verdict::Confirmed);
            finding.evidence.sign = self.sign(&sampler, item);
        }
        Ok(())
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
        let printed = sampler.printed(index);
        let mut rest = printed.as_slice();
        let mut parameters = BTreeMap::new();
        for parameter in self.case.model.free_parameters() {
            let (own, others) = rest.split_at(crate::mechanics::components(parameter.kind));
            rest = others;
            parameters.insert(parameter.name.clone(), listed(own));
        }
        let mut state = Vec::new();
        for variable in &self.case.model.state {
            let (own, others) = rest.split_at(variable.len());
            rest = others;
            state.push(format!("{}={}", variable.name, listed(own)));
        }
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
    fn widen(&self, recorded: &[Recorded<'_>], findings: &mut [Finding]) -> Result<(), JudgeError> {
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
                let holds = matches!(finding.settled, Some(Verdict::Confirmed | Verdict::Proved));
                let covered = finding.evidence.holds.iter().any(|name| name == "everywhere");
                if let (Some((_, residual)), true, false) = (residual, holds, covered) {
                    let span = outputs.len()..outputs.len() + residual.len();
                    outputs.extend(residual.iter().copied());
                    asked.push((finding, span));
                }
            }
            if asked.is_empty() {
                continue;
            }
            let sampler = Sampler::new(self.case, place, self.options.seed)?;
            let values = self.run(&outputs).at(&sampler.balls(0));
            for (finding, span) in asked {
                let balls = values.range(span);
                let defined = |lane: usize| balls.iter().all(|ball| ball.is_defined(lane));
                let lanes: Vec<usize> = (0..LANES).filter(|lane| defined(*lane)).collect();
                let fails = lanes.iter().any(|lane| balls.iter().any(|b| b.excludes_zero(*lane)));
                if !fails && lanes.len() >= MIN_STATES {
                    finding.evidence.holds.push(place.name(model));
                }
            }
        }
        for (item, finding) in recorded.iter().zip(findings) {
            let holds = matches!(finding.settled, Some(Verdict::Confirmed | Verdict::Proved));
            if holds && finding.evidence.holds.is_empty() {
                finding.evidence.holds.push(item.claim.place.name(model));
            }
        }
        Ok(())
    }
}

/// A residual that became a constant settles its claim without a state.
fn fold(graph: &Graph, item: &Recorded<'_>, finding: &mut Finding) {
    let constants: Option<Vec<_>> =
        item.residual.iter().map(|expr| graph.constant_value(*expr)).collect();
    if let Some(constants) = constants {
        finding.evidence.method = "folding";
        let zero = constants.iter().all(|value| value.is_zero());
        finding.settled = Some(if zero { Verdict::Proved } else { Verdict::Refuted });
        if !zero {
            let values: Vec<String> = constants.iter().map(|value| value.to_string()).collect();
            finding.evidence.reason = Some(format!("the residual is {}", values.join(", ")));
        }
    }
}

/// Where a claim's outputs stand in a tape.
struct Span {
    residual: std::ops::Range<usize>,
    scale: Option<usize>,
    off_level: Option<usize>,
    off_general: Option<usize>,
    defects: std::ops::Range<usize>,
}

impl Span {
    fn lay_out(item: &Recorded<'_>, with_context: bool, outputs: &mut Vec<Expr>) -> Self {
        let mut extend = |some: &[Expr]| {
            let start = outputs.len();
            outputs.extend_from_slice(some);
            start..outputs.len()
        };
        let residual = extend(&item.residual);
        let mut one = |some: Option<Expr>| {
            let some = some.filter(|_| with_context)?;
            Some(extend(&[some]).start)
        };
        let context = &item.context;
        let (scale, off_level, off_general) =
            (one(context.scale), one(context.off_level), one(context.off_general));
        let defects = if with_context { &context.quadrature_defects[..] } else { &[] };
        Self { residual, scale, off_level, off_general, defects: extend(defects) }
    }
}

/// What the first block tells beside the residual: is it resolved, is the integral more than a
/// general one, are the quadratures functions of their variable?
fn weigh(item: &Recorded<'_>, span: &Span, values: &Values, finding: &mut Finding) {
    let excluded = |index: usize| (0..LANES).any(|lane| values.output(index).excludes_zero(lane));
    finding.evidence.independence = span.off_level.map(|off_level| {
        let general = span.off_general.map(excluded);
        match (excluded(off_level), general) {
            (false, _) => Independence::Constant,
            (true, Some(false)) => Independence::General,
            (true, _) => Independence::Independent,
        }
    });
    if finding.settled.is_some() {
        return;
    }
    let residuals = values.range(span.residual.clone());
    let defined = |lane: &usize| residuals.iter().all(|ball| ball.is_defined(*lane));
    if (0..LANES).filter(defined).count() == 0 {
        undecide(
            finding,
            format!("the residual is undefined at all {LANES} states that were drawn"),
        );
        return;
    }
    if span.defects.clone().any(excluded) {
        let what = "the integrand of an ∫ is not a function of its variable alone";
        undecide(finding, what.to_string());
        return;
    }
    let refuted = |lane: usize| residuals.iter().any(|ball| ball.excludes_zero(lane));
    if (0..LANES).any(refuted) {
        return;
    }
    let resolved = |lane: &usize| {
        let Some(scale) = span.scale.map(|index| values.output(index)) else { return true };
        let floor = (scale.mid[*lane] - scale.rad[*lane]).max(0.0).sqrt();
        let blur = 2f64.powi(-RESOLVED_BITS) * floor;
        residuals.iter().all(|ball| ball.rad[*lane] <= blur || ball.rad[*lane] == 0.0)
    };
    let clear = (0..LANES).filter(defined).filter(resolved).count();
    if clear < MIN_STATES {
        let kind = item.claim.kind.name();
        undecide(
            finding,
            format!(
                "rounding hides the residual of this {kind}: only at {clear} of {LANES} states is its \
                 error bound 2^{RESOLVED_BITS} times below the terms that are added"
            ),
        );
    }
}

fn undecide(finding: &mut Finding, reason: String) {
    finding.settled = Some(Verdict::Undecided);
    finding.evidence.reason = Some(reason);
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

fn report(case: &Case, item: &Recorded<'_>, finding: Finding) -> ClaimReport {
    let claim = item.claim;
    let mut verdict = finding.settled.unwrap_or(Verdict::Undecided);
    let mut evidence = finding.evidence;
    let holds = matches!(verdict, Verdict::Proved | Verdict::Confirmed);
    if !holds {
        evidence.independence = None;
    }
    if verdict == Verdict::Refuted
        && let Some(limit) = claim.kind.limit_of_refutation(&case.model)
    {
        verdict = Verdict::Undecided;
        evidence.reason = Some(limit.to_string());
    }
    let place = claim.place.name(&case.model);
    if holds && matches!(claim.kind, Kind::Density(_)) && place != "everywhere" {
        let functions: Vec<&str> = case
            .model
            .level
            .iter()
            .zip(&claim.place.kept)
            .filter(|(_, kept)| **kept)
            .map(|(equation, _)| equation.text.as_str())
            .collect();
        evidence.volume = Some(format!("σ with dx = d({})∧σ", functions.join(")∧d(")));
    }
    let elsewhere = evidence.holds.iter().any(|name| *name != place);
    let agrees = match claim.expect {
        Expect::Open => true,
        Expect::Holds => holds && !(claim.only_there && elsewhere),
        Expect::Fails => verdict == Verdict::Refuted,
    };
    if holds && claim.only_there && elsewhere {
        evidence.reason = Some("it was claimed to hold there only".to_string());
    }
    ClaimReport {
        name: claim.name.clone(),
        formula: claim.kind.formula().map(|formula| formula.text().to_string()),
        kind: claim.kind.name(),
        source: claim.source.clone(),
        place,
        expect: claim.expect.word(),
        verdict,
        agrees,
        cell: claim.cell.clone(),
        note: claim.note.clone(),
        evidence,
    }
}
