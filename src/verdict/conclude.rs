//! Conversion of findings to reports.

use super::claim_state::ClaimState;
use super::evidence::{ClaimReport, Verdict};
use super::judge::{Options, Trust};
use super::recorded::RecordedClaim;
use super::restriction::Flaw;
use crate::case::Case;
use crate::claim::{ClaimKind, PlaceName};
use crate::formula::{Formula, Type};
use crate::mechanics::{Meaning, Model};

/// Remark on a value that is shown not to vanish at some states, and may vanish at others.
const ON_A_PART: &str = "shown on a part of the states only: where a modulus, or a root that depends on \
                         others, has another sign, or on another branch of the level, it may fail";

/// Reason why a value that does not vanish for the constants drawn decides nothing.
pub(super) const OPEN_CONSTANT: &str = "it depends on the value of an ∫, whose constant is open, and fails for some constants: write the \
                             antiderivative out";

/// Makes the report on a claim, with its verdict compared with the expectation. With an open constant its
/// residual contains the value of an ∫.
pub fn report(
    case: &Case,
    item: &RecordedClaim<'_>,
    status: ClaimState,
    (options, has_open_constant): (&Options, bool),
) -> ClaimReport {
    let claim = item.claim;
    let mut verdict = status.settled.unwrap_or(Verdict::Undecided);
    let mut evidence = status.evidence;
    if verdict == Verdict::Refuted && has_open_constant {
        verdict = Verdict::Undecided;
        evidence.reason = Some(OPEN_CONSTANT.to_string());
    }
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
        let reason =
            "it holds at all states that were tried, and bounds over the ranges do not show more";
        evidence.reason = Some(format!("{reason}; {}", advice_on_rate(&claim.kind)));
        evidence.holds.clear();
    }
    if matches!(verdict, Verdict::Proved | Verdict::Confirmed)
        && let Some(limit) = claim.kind.limit_of_proof(&case.model)
    {
        verdict = Verdict::Undecided;
        evidence.reason = Some(limit);
        evidence.holds.clear();
    }
    if let (Verdict::Refuted, Some(frame)) = (verdict, frame_in(&case.model, item)) {
        evidence.add_remark(format!(
            "{frame} stands for any 3×3 matrix: what holds for rotations alone is refuted"
        ));
    }
    let holds = matches!(verdict, Verdict::Proved | Verdict::Confirmed);
    if holds {
        for (assumption, words) in claim.kind.assumptions(&case.model) {
            evidence.assume(assumption);
            evidence.add_remark(words);
        }
        if let Some(remark) = claim.kind.remark(&case.model, &claim.place.kept) {
            evidence.add_remark(remark);
        }
        if claim.kind.is_negated() && status.is_on_a_part {
            evidence.add_flaw(Flaw::OnAPart);
            evidence.remark = Some(match evidence.remark {
                Some(remark) => format!("{ON_A_PART}; {remark}"),
                None => ON_A_PART.to_string(),
            });
        }
    }
    if !holds {
        evidence.independence = None;
    }
    if let (Verdict::Refuted, true, Some((shown, all))) =
        (verdict, claim.kind.is_negated(), status.parts)
    {
        let words = "parts of the level, and false on the others";
        evidence.add_remark(format!("true on {shown} of the {all} {words}"));
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
    if holds && matches!(claim.kind, ClaimKind::Density(_)) && place != PlaceName::Everywhere {
        let functions: Vec<&str> = case
            .model
            .level
            .iter()
            .zip(&claim.place.kept)
            .filter(|(_, kept)| **kept)
            .map(|(equation, _)| equation.text.as_str())
            .collect();
        evidence.volume = Some(match status.is_flat {
            false => format!("σ with dx = d({})∧σ", functions.join(")∧d(")),
            true => {
                "dx around the level, whose equations have dependent slopes and so no σ".to_string()
            }
        });
    }
    let elsewhere = evidence.holds.iter().any(|name| *name != place);
    let is_complete = verdict == Verdict::Proved && evidence.assumes.is_empty();
    let enough = options.trust != Trust::Proof || is_complete;
    if holds && !enough {
        evidence.reason = Some(match verdict {
            Verdict::Proved => {
                let assumed: Vec<&str> = evidence.assumes.iter().map(|own| own.words()).collect();
                format!("a proof is required, and this one assumes that {}", assumed.join(" and "))
            }
            _ => {
                let silence = evidence.silence.as_deref().unwrap_or("none was found");
                format!("a proof is required: {silence}")
            }
        });
    }
    let agrees = verdict.agrees(claim.expect, enough && !(claim.only_there && elsewhere));
    if holds && claim.only_there && elsewhere {
        evidence.reason = Some("the claim says that it holds only there".to_string());
    }
    if claim.kind.is_at_images() {
        let of = |place| PlaceName::ImagesOf(Box::new(place));
        evidence.holds = evidence.holds.into_iter().map(of).collect();
    }
    ClaimReport {
        name: claim.name.clone(),
        formula: claim.kind.text(),
        kind: claim.kind.name(),
        source: claim.source.clone(),
        place: place.to_string(),
        expect: claim.expect,
        verdict,
        agrees,
        cell: claim.cell.clone(),
        note: claim.note.clone(),
        evidence,
    }
}

/// Says how a rate is written so that its sign is seen.
pub(super) fn advice_on_rate(kind: &ClaimKind) -> &'static str {
    match kind {
        ClaimKind::Lyapunov(own) if own.has_rate() => {
            "the sign of the formula under `equals` is not seen: write it as a sum of terms that are never positive"
        }
        _ => "write the rate under `equals` as a sum of terms that are never positive",
    }
}

/// Name of the orientation of a body, where a claim contains it.
fn frame_in<'m>(model: &'m Model, item: &RecordedClaim<'_>) -> Option<&'m str> {
    model.system.body()?;
    let is_used = |variable: usize| {
        let of_claim = item.claim.kind.formulas().into_iter();
        let mut all = of_claim
            .flat_map(|own| model.vocabulary.with_abbreviations(own, &model.abbreviations))
            .flat_map(Formula::symbols);
        all.any(|symbol| model.vocabulary.entry(symbol).meaning == Meaning::State(variable))
    };
    let frame = model.state.iter().position(|variable| variable.kind == Type::MATRIX)?;
    is_used(frame).then(|| model.state[frame].name.as_str())
}
