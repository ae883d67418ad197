//! What is known of a claim while the ladder is climbed.

use super::evidence::{Evidence, Independence, Verdict};
use super::recorded::{Recorded, Span};
use super::run::Values;
use super::sampler::LANES;
use crate::graph::Graph;

/// A claim is confirmed by no fewer states of the first block than this.
pub const MIN_STATES: usize = LANES / 4;
/// Bits of the residual's scale that its error bound must leave for a state to count: what is
/// blurred more than this could hide a term.
const RESOLVED_BITS: i32 = 16;
/// What is known of a claim while the ladder is climbed.
#[derive(Default)]
pub struct Finding {
    pub settled: Option<Verdict>,
    pub evidence: Evidence,
}

impl Finding {
    /// Does the claim hold, as far as is known?
    pub fn holds(&self) -> bool {
        matches!(self.settled, Some(Verdict::Confirmed | Verdict::Proved))
    }
}

/// A residual that became a constant settles its claim without a state.
pub fn fold(graph: &Graph, item: &Recorded<'_>, finding: &mut Finding) {
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

/// What the first block tells beside the residual: is it resolved, is the integral more than a
/// general one, are the quadratures functions of their variable?
pub fn weigh(item: &Recorded<'_>, span: &Span, values: &Values, finding: &mut Finding) {
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
