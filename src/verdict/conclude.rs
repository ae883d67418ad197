//! Conversion of findings to reports.

use super::claim_state::ClaimState;
use super::evidence::{ClaimReport, Verdict};
use super::judge::{Options, Trust};
use super::recorded::RecordedClaim;
use crate::case::{Case, Expect};
use crate::claim::ClaimKind;
use crate::graph::{Graph, Step};
use crate::number::{BinaryOperation, UnaryFunction};

/// Whether a residual contains a modulus, or the root of a square: it may then be 0
/// on a part of the states, and not on others.
fn is_piecewise(graph: &Graph, item: &RecordedClaim<'_>) -> bool {
    let reached = graph.reached(item.residual.iter().chain(&item.requirement).copied());
    let is_square = |place: usize| match graph.step(place) {
        Step::Binary(BinaryOperation::Mul, a, b) => a == b,
        Step::Power(_, exponent) => {
            let (above, below) = exponent.parts();
            below == 1.into() && !above.bit(0)
        }
        _ => false,
    };
    (0..reached.len()).filter(|place| reached[*place]).any(|place| match graph.step(place) {
        Step::Unary(UnaryFunction::Abs, _) => true,
        Step::Unary(UnaryFunction::Sqrt, a) => is_square(a),
        _ => false,
    })
}

/// Makes the report on a claim, with its verdict compared with the expectation.
pub fn report(
    case: &Case,
    graph: &Graph,
    item: &RecordedClaim<'_>,
    status: ClaimState,
    options: &Options,
) -> ClaimReport {
    let claim = item.claim;
    let mut verdict = status.settled.unwrap_or(Verdict::Undecided);
    let mut evidence = status.evidence;
    if claim.kind.is_negated() {
        // The claim is that the residual does not vanish everywhere: one state proves it.
        verdict = match verdict {
            Verdict::Refuted => Verdict::Proved,
            Verdict::Proved => Verdict::Refuted,
            other => other,
        };
        if verdict == Verdict::Confirmed {
            verdict = Verdict::Undecided;
            evidence.reason = Some(
                "the numbers indicate that it does not hold, but there is no proof".to_string(),
            );
        }
        evidence.holds.clear();
    }
    if claim.kind.is_inequality() && verdict == Verdict::Confirmed {
        verdict = Verdict::Undecided;
        let reason = "it holds at all states that were tried, and bounds over the ranges do not show more: \
                      give the rate by equals, as a formula whose sign is seen";
        evidence.reason = Some(reason.to_string());
        evidence.holds.clear();
    }
    let holds = matches!(verdict, Verdict::Proved | Verdict::Confirmed);
    if holds {
        evidence.remark = evidence.remark.or_else(|| claim.kind.remark(&case.model));
        if claim.kind.is_negated() && is_piecewise(graph, item) {
            let part = "shown on a part of the states only: where a modulus, or the root of a square, is \
                        another function, it may fail";
            evidence.remark = Some(match evidence.remark {
                Some(remark) => format!("{remark}; {part}"),
                None => part.to_string(),
            });
        }
    }
    if !holds {
        evidence.independence = None;
    }
    if verdict == Verdict::Refuted
        && let Some(limit) = claim.kind.limit_of_refutation(&case.model)
    {
        verdict = Verdict::Undecided;
        evidence.reason = Some(limit.to_string());
    }
    if verdict == Verdict::Refuted {
        evidence.remark = evidence.remark.or_else(|| claim.kind.remark_on_refutation(&case.model));
    }
    let place = claim.place.name(&case.model);
    if holds && matches!(claim.kind, ClaimKind::Density(_)) && place != "everywhere" {
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
    let enough = options.trust != Trust::Proof || verdict == Verdict::Proved;
    if holds && !enough {
        let silence = evidence.silence.as_deref().unwrap_or("none was found");
        evidence.reason = Some(format!("a proof is required: {silence}"));
    }
    let agrees = match claim.expect {
        Expect::Open => true,
        Expect::Holds => holds && enough && !(claim.only_there && elsewhere),
        Expect::Fails => verdict == Verdict::Refuted,
    };
    if holds && claim.only_there && elsewhere {
        evidence.reason = Some("the claim says that it holds only there".to_string());
    }
    if claim.kind.is_at_images() {
        for name in &mut evidence.holds {
            let states = match name.as_str() {
                "everywhere" => "all states",
                "level" => "the level",
                equation => equation,
            };
            *name = format!("at the images of {states}");
        }
    }
    ClaimReport {
        name: claim.name.clone(),
        formula: claim.kind.text(),
        kind: claim.kind.name(),
        source: claim.source.clone(),
        place,
        expect: claim.expect,
        verdict,
        agrees,
        cell: claim.cell.clone(),
        note: claim.note.clone(),
        evidence,
    }
}
