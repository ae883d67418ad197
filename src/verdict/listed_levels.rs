//! Levels and powers that depend on listed values: each value is judged as the same number in the file, for which the
//! level may be another one, as x² + y² = p is a point for p = 0, and a power may have more bases, as x² for x < 0.

use std::collections::BTreeSet;

use super::evidence::{ClaimReport, DensitySign, Evidence, Verdict};
use super::field::TOO_MANY_COMBINATIONS;
use super::judge::{JudgeError, Options, judge};
use super::listed_powers::SplitDraws;
use super::voids::Choice;
use crate::case::{Case, Expect, PlacedClaim};
use crate::formula::Formula;
use crate::mechanics::{
    Chart, Draw, LevelFunction, Meaning, Model, ParameterOrigin, SamplerSpec, combinations,
};
use crate::number::rational::Rational;

/// Largest number of combinations that are judged.
const MOST: usize = 16;
const OF_ENTRIES: &str = "the level, or the exponent of a power, depends on a vector or matrix with listed entries: \
                          write a separate case for each of its values";

/// Listed values that matter for a claim.
pub(super) struct ListedUse {
    /// Listed values for which the claim says nothing.
    pub voids: Vec<Choice>,
    /// Draws of listed exponents that have other states as numbers in the file.
    pub split: SplitDraws,
}

/// Judges the claims that hold once more for each combination of the listed values that their levels depend on, and all
/// with such exponents, and keeps the first report by which one does not hold.
pub(super) fn judge_each_listed(
    case: &Case,
    options: &Options,
    reports: &mut [ClaimReport],
    uses: &[ListedUse],
) -> Result<(), JudgeError> {
    for ((claim, report), ListedUse { voids, split }) in case.claims.iter().zip(reports).zip(uses) {
        let Some(split) = split else {
            leave_open(report, TOO_MANY_COMBINATIONS.to_string());
            continue;
        };
        let holds = is_held(report.verdict);
        let may_hold = matches!(report.verdict, Verdict::Refuted | Verdict::Undecided);
        let lists = match holds || !split.is_empty() && may_hold {
            true => lists_of(case, claim, split),
            false => Vec::new(),
        };
        if lists.is_empty() {
            continue;
        }
        let choices = match lists.iter().all(|list| list.is_scalar) {
            true => choices(case, &lists).ok_or(TOO_MANY_COMBINATIONS),
            false => Err(OF_ENTRIES),
        };
        let choices = match choices {
            Ok(choices) => choices,
            Err(reason) => {
                leave_open(report, reason.to_string());
                continue;
            }
        };
        let mut judged_values: Vec<(String, Evidence)> = Vec::new();
        for (index, choice) in choices.into_iter().enumerate() {
            // Nothing is said for these values if nothing is for any values of the other lists.
            let void = voids.iter().filter(|void| agrees(void, &choice)).count();
            if void == choices_of_others(case, &lists) && split.is_empty() {
                continue;
            }
            let values: Values<'_> =
                lists.iter().filter_map(|list| Some((list, choice[list.draw].as_ref()?))).collect();
            let named = named(case, &values);
            match judged(case, options, claim, &values) {
                // What is refuted for positive bases, or has a value for none, may hold for all.
                Ok(one) if is_held(one.verdict) && !holds && index == 0 => {
                    judged_values.push((named, one.evidence.clone()));
                    *report = one;
                }
                Ok(one) if one.verdict == Verdict::Proved || one.verdict == report.verdict => {
                    judged_values.push((named, one.evidence));
                }
                Ok(one) => {
                    judged_values.clear();
                    *report = one;
                    let reason = report.evidence.reason.take().unwrap_or_default();
                    let separator = if reason.is_empty() { "" } else { ": " };
                    report.evidence.reason = Some(format!("for {named}{separator}{reason}"));
                    if let Some(witness) = &mut report.evidence.witness {
                        let name = |own: &Listed| case.model.parameters[own.parameter].name.clone();
                        let own =
                            values.iter().map(|(list, value)| (name(list), value.to_string()));
                        witness.parameters.extend(own);
                    }
                    break;
                }
                Err(error) => {
                    judged_values.clear();
                    leave_open(report, format!("for {named}: {error}"));
                    break;
                }
            }
        }
        if !split.is_empty() {
            restrict(&mut report.evidence, judged_values);
        }
    }
    Ok(())
}

fn is_held(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Proved | Verdict::Confirmed)
}

/// Replaces what restricts a claim for all listed values, read as ranges, by what does for each of them.
fn restrict(evidence: &mut Evidence, of_values: Vec<(String, Evidence)>) {
    let Some((_, first)) = of_values.first() else { return };
    evidence.flaws.clear();
    evidence.assumes.clear();
    evidence.remark = None;
    (evidence.sign, evidence.sign_is_proved) = (first.sign, first.sign_is_proved);
    let is_common = of_values.iter().all(|(_, own)| own.remark == first.remark);
    if is_common {
        evidence.remark.clone_from(&first.remark);
    }
    for (named, own) in of_values {
        evidence.holds.retain(|place| own.holds.contains(place));
        own.flaws.iter().for_each(|flaw| evidence.add_flaw(*flaw));
        own.assumes.iter().for_each(|assumption| evidence.assume(*assumption));
        if let Some(remark) = own.remark.filter(|_| !is_common) {
            evidence.add_remark(format!("for {named}: {remark}"));
        }
        evidence.sign = sign_of_both(evidence.sign, own.sign);
        evidence.sign_is_proved &= own.sign_is_proved && evidence.sign.is_some();
        evidence.sign_may_vanish |= own.sign_may_vanish;
        evidence.sign_is_partial |= own.sign_is_partial;
    }
}

/// Sign of a density for two values of a parameter.
fn sign_of_both(one: Option<DensitySign>, other: Option<DensitySign>) -> Option<DensitySign> {
    let (one, other) = (one?, other?);
    Some(match one == other {
        true => one,
        false if [one, other].contains(&DensitySign::Changes) => DensitySign::Changes,
        false => DensitySign::ChangesWithParameters,
    })
}

/// Judges a claim in the case with these values.
fn judged(
    case: &Case,
    options: &Options,
    claim: &PlacedClaim,
    values: &Values<'_>,
) -> Result<ClaimReport, JudgeError> {
    let mut fixed = case.clone();
    (fixed.motions, fixed.absences) = (Vec::new(), Vec::new());
    fixed.claims = vec![claim.clone()];
    for (list, value) in values {
        fixed.model.parameters[list.parameter].origin =
            ParameterOrigin::Fixed(vec![(*value).clone()]);
    }
    let mut judged = judge(&fixed, &Options { mutants: false, ..*options })?;
    Ok(judged.claims.swap_remove(0))
}

/// Names values as `p = 0 and q = 1`.
fn named(case: &Case, values: &Values<'_>) -> String {
    let one = |(list, value): &(&Listed, &Rational)| {
        format!("{} = {value}", case.model.parameters[list.parameter].name)
    };
    values.iter().map(one).collect::<Vec<String>>().join(" and ")
}

/// Leaves a claim undecided.
fn leave_open(report: &mut ClaimReport, reason: String) {
    report.verdict = Verdict::Undecided;
    report.agrees = report.expect == Expect::Open;
    let evidence = &mut report.evidence;
    (evidence.proof, evidence.independence, evidence.volume) = (None, None, None);
    evidence.holds.clear();
    evidence.reason = Some(reason);
}

/// A parameter with a list of several values.
struct Listed {
    parameter: usize,
    /// First draw of the parameter.
    draw: usize,
    is_scalar: bool,
}

/// A value of each such parameter.
type Values<'l> = Vec<(&'l Listed, &'l Rational)>;

/// Lists the parameters with several values in the equations of a claim's place, or in the chart of it, and those with
/// such draws.
fn lists_of(case: &Case, claim: &PlacedClaim, split: &BTreeSet<usize>) -> Vec<Listed> {
    let (model, kept) = (&case.model, &claim.place.kept);
    let mut equations: Vec<&Formula> = Vec::new();
    for (equation, _) in model.level.iter().zip(kept).filter(|(_, kept)| **kept) {
        if let LevelFunction::Formula(formula) = &equation.function {
            equations.push(formula);
        }
    }
    let mut used = parameters_in(model, &equations);
    if let Chart::Given(chart) = &case.chart
        && kept.iter().all(|kept| *kept)
    {
        used.extend(parameters_in(&chart.model, &chart.formulas.iter().collect::<Vec<_>>()));
    }
    let (mut lists, mut draw) = (Vec::new(), 0);
    for (parameter, own) in model.parameters.iter().enumerate() {
        let ParameterOrigin::Free(spec) = &own.origin else { continue };
        let draws = spec.draws();
        let several = |draw: &Draw| matches!(draw, Draw::OneOf(values) if values.len() > 1);
        let is_split = split.range(draw..draw + draws.len()).next().is_some();
        if draws.iter().any(several) && used.contains(&parameter) || is_split {
            let is_scalar = matches!(spec, SamplerSpec::Scalar(_));
            lists.push(Listed { parameter, draw, is_scalar });
        }
        draw += draws.len();
    }
    lists
}

/// Lists the parameters that some formulas use, directly or through names and other parameters.
fn parameters_in(model: &Model, formulas: &[&Formula]) -> BTreeSet<usize> {
    let all = model.parameter_formulas_of(formulas).into_iter().chain(formulas.iter().copied());
    let written =
        all.flat_map(|own| model.vocabulary.with_abbreviations(own, &model.abbreviations));
    let parameter = |symbol| match model.vocabulary.entry(symbol).meaning {
        Meaning::Parameter(index) => Some(index),
        _ => None,
    };
    written.flat_map(Formula::symbols).filter_map(parameter).collect()
}

/// Lists the choices of these values, by draw; `None` if there are too many.
fn choices(case: &Case, lists: &[Listed]) -> Option<Vec<Choice>> {
    let mut draws = case.model.parameter_draws();
    for (place, draw) in draws.iter_mut().enumerate() {
        if lists.iter().all(|list| list.draw != place) {
            *draw = Draw::Sign;
        }
    }
    combinations(&draws).filter(|all| all.len() <= MOST)
}

/// Whether a choice of all listed values contains these.
fn agrees(all: &Choice, some: &Choice) -> bool {
    some.iter().zip(all).all(|(own, other)| own.is_none() || own == other)
}

/// Number of choices of the listed values of other parameters.
fn choices_of_others(case: &Case, lists: &[Listed]) -> usize {
    let is_other = |(draw, _): &(usize, Draw)| lists.iter().all(|list| list.draw != *draw);
    let several = |(_, own): (usize, Draw)| match own {
        Draw::OneOf(values) => Some(values.len()),
        _ => None,
    };
    let draws = case.model.parameter_draws().into_iter().enumerate();
    draws.filter(is_other).filter_map(several).fold(1, usize::saturating_mul)
}
