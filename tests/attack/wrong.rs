//! Comparison of verdicts with the truth.

use liouville::claim::PlaceName;
use std::borrow::Cow;

use liouville::verdict::{ClaimReport, DensitySign, Independence, Method, Verdict};

use super::claim::{At, Claim};
use super::draw::Made;
use super::oracle::{Survey, evenly, in_cells, may_be_flat, searched, signs, thin_signs, visibly};
use super::random::Stream;
use super::real::Lack;
use super::scene::Scene;
use super::told::Told;
use super::witness::{Shown, shown};

/// A fault of a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Wrong {
    /// Proved, although it fails at a state.
    ProvedFalse,
    /// Proved, although it is defined at no state.
    ProvedVoid,
    /// Refuted, although it holds at all states found.
    RefutedTrue,
    /// Refuted, although it is defined at no state.
    RefutedVoid,
    /// Refuted by a state at which it holds, although it fails elsewhere.
    IdleWitness,
    /// Refuted by a point at which it is undefined or which is not a state, although it fails
    /// elsewhere.
    NoWitness,
    /// Confirmed, although it fails on more than a fiftieth of the range.
    ConfirmedFalse,
    /// Confirmed, although it is defined at no state.
    ConfirmedVoid,
    /// Reported to hold everywhere, although it fails off the level.
    NotEverywhere,
    /// Reported with the wrong sign of a density.
    OtherSign,
    /// Reported wrongly as a new or a constant integral.
    OtherNovelty,
    /// A panic of the program.
    Panicked,
    /// A valid file that was not read.
    Unreadable,
    /// A valid case that was refused.
    Refused,
    /// A fault of the instrument: expressions equal by construction differ.
    Instrument,
}

impl Wrong {
    /// Describes the fault.
    pub fn words(self) -> &'static str {
        match self {
            Wrong::ProvedFalse => "proved, and it fails at a state",
            Wrong::ProvedVoid => "proved, and it has no value anywhere",
            Wrong::RefutedTrue => "refuted, and it holds",
            Wrong::RefutedVoid => "refuted, and it has no value anywhere",
            Wrong::IdleWitness => "refuted by a state at which it holds",
            Wrong::NoWitness => "refuted by a state at which it has no value, or that is none",
            Wrong::ConfirmedFalse => "confirmed, and it fails on a large part of the range",
            Wrong::ConfirmedVoid => "confirmed, and it has no value anywhere",
            Wrong::NotEverywhere => "said to hold everywhere, and it fails off the level",
            Wrong::OtherSign => "a density with a sign that is another",
            Wrong::OtherNovelty => "an integral that is said to be new or constant, and is not",
            Wrong::Panicked => "a panic",
            Wrong::Unreadable => "a file that should be read",
            Wrong::Refused => "a case that is right is refused",
            Wrong::Instrument => "an error of the instrument: true by construction, and it fails",
        }
    }
}

/// The truth about a claim, as far as it was examined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Truth {
    Holds,
    Fails,
    Void,
    Unsure,
}

/// Largest shares of the range on which a confirmed claim may fail by more than the rounding of so
/// many bits: thousands of states are tried in f64, and 32 states in 256 bits.
const CONFIRMED: [(usize, f64); 2] = [(256, 0.25), (64, 0.02)];
/// The same where the states are enclosures in f64.
const CONFIRMED_NEARBY: [(usize, f64); 1] = [(40, 0.02)];

/// Number of states at which a new integral is sought to vary where no cell shows it.
const MANY_STATES: usize = 4000;

/// Number and length of descents to states at which a density has the other sign, to contradict a
/// proof, and to find both signs before a verdict counts as wrong.
const FEW: (usize, usize) = (1, 12);
const MANY: (usize, usize) = (40, 120);

/// Determines the truth about a claim, and the fault of a verdict on it.
pub fn weighed(
    scene: &Scene,
    made: &Made,
    told: &Told,
    stream: &mut Stream,
) -> (Truth, Option<Wrong>) {
    match told {
        Told::Panicked(_) => return (Truth::Unsure, Some(Wrong::Panicked)),
        // Numbers that divide by zero are refused when read.
        Told::Unreadable(error) if error.contains("divides by zero") => return (Truth::Void, None),
        Told::Unreadable(_) => return (Truth::Unsure, Some(Wrong::Unreadable)),
        // A chart that misses directions of the level is rightly refused.
        Told::Unjudged(_) if !scene.is_filled() => return (Truth::Unsure, None),
        Told::Unjudged(_) | Told::Report(_) => {}
    }
    let claim = &made.claim;
    let filled = scene.is_filled();
    let scene = match made.everywhere {
        true => Cow::Owned(scene.without_level()),
        false => Cow::Borrowed(scene),
    };
    let survey = surveyed(&scene, claim, told, stream);
    let witness = match told {
        Told::Report(report) => {
            report.evidence.witness.as_ref().map(|witness| shown(&scene, claim, witness))
        }
        _ => None,
    };
    let truth = match (truth(&scene, claim, &survey), witness) {
        // One state decides, however thin the set of such states is.
        (_, Some(Shown::At(At::Off(_)))) if claim.is_negated() => Truth::Holds,
        (_, Some(Shown::At(At::Off(_)))) => Truth::Fails,
        (Truth::Void, _) if may_be_flat(&scene, claim) => Truth::Unsure,
        (truth, _) => truth,
    };
    if made.vanishes && survey.off > 0 {
        return (truth, Some(Wrong::Instrument));
    }
    let wrong = match told {
        Told::Report(report) => against(&scene, claim, truth, (report, witness), stream)
            .or_else(|| beside(&scene, claim, report, stream)),
        // The motion stays on the level by construction.
        Told::Unjudged(error) if truth != Truth::Void && filled => {
            let complaints = ["the chart", "not invariant"];
            complaints.iter().any(|words| error.contains(words)).then_some(Wrong::Refused)
        }
        _ => None,
    };
    (truth, wrong)
}

/// Examines a claim as thoroughly as the verdict requires.
fn surveyed(scene: &Scene, claim: &Claim, told: &Told, stream: &mut Stream) -> Survey {
    let says_zero = match told.verdict() {
        Some(Verdict::Proved) => !claim.is_negated(),
        Some(Verdict::Refuted) => claim.is_negated(),
        _ => false,
    };
    if matches!(told.verdict(), None | Some(Verdict::Undecided)) && !claim.is_negated() {
        return evenly(scene, claim, stream, 24);
    }
    let mut survey = searched(scene, claim, stream, if says_zero { 2 } else { 1 });
    let doubtful = match told.verdict() {
        Some(Verdict::Refuted) if !claim.is_negated() => survey.off == 0,
        Some(Verdict::Proved) if claim.is_negated() => survey.off == 0,
        None | Some(Verdict::Undecided) => false,
        _ => survey.off == 0 && survey.zero == 0,
    };
    // A verdict counts as wrong only after a search thorough enough for thin cells.
    let efforts: &[usize] = if doubtful { &[6, 30] } else { &[] };
    for effort in efforts {
        if survey.off == 0 {
            survey = searched(scene, claim, stream, *effort);
        }
    }
    survey
}

/// Finds the fault of a verdict.
fn against(
    scene: &Scene,
    claim: &Claim,
    truth: Truth,
    (report, witness): (&ClaimReport, Option<Shown>),
    stream: &mut Stream,
) -> Option<Wrong> {
    let off_there = matches!(witness, Some(Shown::At(At::Off(_))));
    match (report.verdict, truth) {
        (Verdict::Proved, Truth::Fails) => Some(Wrong::ProvedFalse),
        (Verdict::Proved, Truth::Void) => Some(Wrong::ProvedVoid),
        (Verdict::Refuted, Truth::Void) => Some(Wrong::RefutedVoid),
        (Verdict::Confirmed, Truth::Void) => Some(Wrong::ConfirmedVoid),
        (Verdict::Refuted, truth) if !claim.is_negated() => match witness {
            _ if off_there => None,
            // A limit has no state.
            Some(_) if matches!(claim, Claim::Limit(..)) && truth != Truth::Holds => None,
            Some(Shown::At(At::Zero)) if truth == Truth::Fails => Some(Wrong::IdleWitness),
            Some(Shown::At(At::Zero)) => Some(Wrong::RefutedTrue),
            Some(Shown::NoState | Shown::At(At::Without(Lack::Value))) => Some(Wrong::NoWitness),
            Some(Shown::Open | Shown::At(_)) | None => {
                (truth == Truth::Holds).then_some(Wrong::RefutedTrue)
            }
        },
        (Verdict::Refuted, Truth::Holds) => Some(Wrong::RefutedTrue),
        (Verdict::Confirmed, Truth::Fails) => {
            let is_large = |(bits, share): (usize, f64)| {
                let (valued, off) = visibly(scene, claim, stream, 150, bits);
                off >= 6 && off as f64 > share * valued as f64
            };
            let bounds: &[(usize, f64)] = match report.evidence.method {
                Method::NumericalBall => &CONFIRMED_NEARBY,
                _ => &CONFIRMED,
            };
            bounds.iter().copied().any(is_large).then_some(Wrong::ConfirmedFalse)
        }
        _ => None,
    }
}

/// Finds faults of the statements that accompany a positive verdict.
fn beside(
    scene: &Scene,
    claim: &Claim,
    report: &ClaimReport,
    stream: &mut Stream,
) -> Option<Wrong> {
    let evidence = &report.evidence;
    if claim.is_negated() || !matches!(report.verdict, Verdict::Proved | Verdict::Confirmed) {
        return None;
    }
    let widest = evidence.holds.contains(&PlaceName::Everywhere);
    if widest && scene.level.is_some() && report.verdict == Verdict::Proved {
        let space = scene.without_level();
        if searched(&space, claim, stream, 1).off > 0 {
            return Some(Wrong::NotEverywhere);
        }
    }
    match (claim, evidence.sign, evidence.independence) {
        // The sign is that at fixed parameters, where the density is known to have a value.
        (Claim::Density(density), Some(sign), _)
            if !scene.has_parameter(density) && !evidence.sign_is_partial =>
        {
            let seen = signs(scene, density, stream, 200, false);
            let (positive, negative) = (seen.positive, seen.negative);
            let share = |count: usize| count as f64 / (positive + negative).max(1) as f64;
            let mut thin = |effort| thin_signs(scene, density, stream, effort);
            let wrong = match sign {
                DensitySign::Positive if evidence.sign_is_proved => {
                    negative > 0 || thin(FEW).negative > 0
                }
                DensitySign::Negative if evidence.sign_is_proved => {
                    positive > 0 || thin(FEW).positive > 0
                }
                // The verifier tries 256 states; where few of the states drawn have a value, it
                // has seen few signs.
                DensitySign::Positive => positive + negative > 150 && share(negative) > 0.05,
                DensitySign::Negative => positive + negative > 150 && share(positive) > 0.05,
                // The other sign may be that of states at which the oracle knows no sign.
                DensitySign::Changes | DensitySign::ChangesWithParameters
                    if positive.min(negative) == 0 && seen.undecided == 0 =>
                {
                    let found = thin(MANY);
                    let (above, below) = (found.positive + positive, found.negative + negative);
                    found.undecided == 0 && above.min(below) == 0
                }
                DensitySign::Changes | DensitySign::ChangesWithParameters => false,
            };
            wrong.then_some(Wrong::OtherSign)
        }
        (Claim::Integral(f), _, Some(independence)) => {
            let claim = Claim::Independent(vec![f.clone()]);
            let efforts = [1, 6, 30].into_iter();
            let mut surveys = efforts.map(|effort| in_cells(scene, &claim, stream, effort));
            let mut survey = surveys.next()?;
            // A cell in which it is new may be thin.
            while survey.off == 0 && independence == Independence::Independent {
                let Some(next) = surveys.next() else { break };
                survey = next;
            }
            // √((x − a)²) bends without a modulus that would be seen as the border of a cell.
            if survey.off == 0 && survey.zero > 0 && independence == Independence::Independent {
                survey = evenly(scene, &claim, stream, MANY_STATES);
            }
            let wrong = match independence {
                // On a branch on which |X| has its corner the oracle knows no slope.
                Independence::Independent => {
                    let is_open = survey.lacking > 0 && may_be_flat(scene, &claim);
                    survey.off == 0 && survey.zero > 0 && survey.unsure == 0 && !is_open
                }
                // What accompanies a confirmed integral was seen at the states tried.
                _ if report.verdict == Verdict::Confirmed => {
                    let (valued, off) = visibly(scene, &claim, stream, 150, CONFIRMED[1].0);
                    off >= 6 && off as f64 > CONFIRMED[1].1 * valued as f64
                }
                Independence::Constant | Independence::General => survey.off > 0,
            };
            wrong.then_some(Wrong::OtherNovelty)
        }
        _ => None,
    }
}

fn truth(scene: &Scene, claim: &Claim, survey: &Survey) -> Truth {
    // A level of which no state was found may nevertheless have states.
    let is_seen = survey.lacking > 0 || scene.level.is_none() || scene.is_empty();
    let clear = survey.unsure <= survey.zero / 2;
    match (survey.off > 0, survey.zero > 0) {
        (true, _) if claim.is_negated() => Truth::Holds,
        (true, _) => Truth::Fails,
        (false, true) if !clear => Truth::Unsure,
        (false, true) if claim.is_negated() => Truth::Fails,
        (false, true) => Truth::Holds,
        (false, false) if survey.is_void() && is_seen => Truth::Void,
        (false, false) => Truth::Unsure,
    }
}
