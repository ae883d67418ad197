//! State of a claim on the ladder.

use std::ops::Range;

use super::evidence::{Evidence, Independence, Method, Rung, Verdict};
use super::field::Where;
use super::recorded::{RecordedClaim, Span};
use super::run::Values;
use super::sampler::TAPE_LANES;
use super::voids::Choice;
use crate::graph::{Expr, Graph};
use crate::number::Enclosing;

/// Smallest share of the states of the first block at which a claim has a meaning that confirms it: one in this many.
const MIN_SHARE: usize = 4;
/// Smallest number of such states.
const LEAST_RESOLVED: usize = 8;
/// Largest share of states that count without a value of the residual: one in this many.
const MOST_LACKING: usize = 16;
/// Number of bits of the residual's scale that must exceed its error bound for a state to count: a
/// larger error could hide a term.
const RESOLVED_BITS: i32 = 16;

/// Message for an ∫ that is undefined.
pub const NO_QUADRATURE: &str = "the integrand of an ∫ is not a function of its variable alone";

/// State of a claim on the ladder.
#[derive(Default)]
pub struct ClaimState {
    pub settled: Option<Verdict>,
    pub evidence: Evidence,
    /// Sets of states on which prime fields show that the residual is not an identity.
    pub nonzero: Vec<Where>,
    /// Whether the residual is zero in prime fields.
    pub is_zero: bool,
    /// Description of a value that is undefined in the precisions used so far.
    pub undefined: Option<String>,
    /// Description of the rounding that blurred the residual.
    pub blurred: Option<String>,
    /// Whether the residual is proved to be a combination of the level functions: 0 at all points of the level,
    /// also at those that no state comes near.
    pub is_combination: bool,
    /// Whether it is known that there is no state at which all formulas of the claim have a value.
    pub is_void: bool,
    /// Whether the residual is known to be zero wherever it has a value, and no state is known at which
    /// the claim has one.
    pub is_unseen: bool,
    /// Whether it is known of all states of the first block that a formula of the claim has no value there.
    pub is_silent: bool,
    /// Whether the slopes of the level's equations depend on each other at states of the place.
    pub is_flat: bool,
    /// Whether the states are a part of full dimension on which these slopes are independent, while on others
    /// they depend on each other.
    pub is_regular: bool,
    /// Whether the states are a part of lower dimension than the place.
    pub is_thin: bool,
    /// Whether the part has states, though perhaps none at which the claim has a value.
    pub has_states: bool,
    /// Message that the residual has no value on a part of the states that count, if so.
    pub partial: Option<String>,
    /// Whether a value that does not vanish is shown not to on a part of the states only.
    pub is_on_a_part: bool,
    /// Number of the parts of the level on which it is shown not to vanish, and of all, if it vanishes on the
    /// others.
    pub parts: Option<(usize, usize)>,
    /// Listed values for which the claim says nothing.
    pub voids: Vec<Choice>,
    /// Lanes of the first block at which f64 finds no state, or no required value.
    pub missing: Vec<usize>,
}

impl ClaimState {
    /// Records the result of a rung.
    pub fn rung(&mut self, rung: Method, found: String) {
        match self.evidence.climb.last_mut() {
            Some(last) if last.rung == rung => last.found = found,
            _ => self.evidence.climb.push(Rung { rung, found }),
        }
    }

    /// Whether a prime field shows that the residual is not an identity.
    pub fn is_nonzero(&self) -> bool {
        !self.nonzero.is_empty()
    }

    /// Whether the claim holds, as far as is known.
    pub fn holds(&self) -> bool {
        matches!(self.settled, Some(Verdict::Confirmed | Verdict::Proved))
    }
}

/// Decides a claim whose residual became a constant, without a state.
pub fn fold(graph: &Graph, item: &RecordedClaim<'_>, status: &mut ClaimState) {
    let constants: Option<Vec<_>> =
        item.residual.iter().map(|expr| graph.constant_value(*expr)).collect();
    if let Some(constants) = constants {
        status.evidence.method = Method::Folding;
        status.rung(Method::Folding, "the residual is a constant".to_string());
        let zero = constants.iter().all(|value| value.is_zero());
        if zero && !are_zero(graph, &item.context.quadrature_defects) {
            // The existence of such integrals is not yet decided.
            return;
        }
        status.settled = Some(if zero { Verdict::Proved } else { Verdict::Refuted });
        if !zero {
            let values: Vec<String> = constants.iter().map(|value| value.to_string()).collect();
            status.evidence.reason = Some(format!("the residual is {}", values.join(", ")));
        }
    }
}

/// Whether all these values were folded to 0.
pub fn are_zero(graph: &Graph, values: &[Expr]) -> bool {
    values.iter().all(|value| graph.constant_value(*value).is_some_and(|value| value.is_zero()))
}

/// Records the results of the first block other than the residual: whether the formula is defined,
/// the quadratures are functions of their variables, the residual is resolved, and the integral is
/// new.
///
/// On a level that is not divided the residual must have a value at each state that counts: a part of the
/// level may have few of them.
pub fn classify<D: Enclosing>(
    item: &RecordedClaim<'_>,
    span: &Span,
    (values, existing): (&Values<D>, &[bool]),
    is_numerical: bool,
    status: &mut ClaimState,
) {
    let result = |range: &Range<usize>, scale: &Range<usize>| {
        let scale = values.range(scale.clone()).first().copied();
        BlockResult::at::<D>(&values.range(range.clone()), scale, existing)
    };
    let (kind, none) = (item.claim.kind.name(), 0..0);
    status.undefined = None;
    if !values.existing(&[]).contains(&true) {
        status.undefined =
            Some(format!("none of {TAPE_LANES} draws leads to a state of this place"));
    } else if result(&span.value, &none).defined == 0 {
        let hint = item.claim.kind.hint_when_undefined();
        let what = match hint.is_empty() {
            true => format!("the formula of this {kind} has no value at {TAPE_LANES} states"),
            false => {
                format!("what this {kind} is judged by has no value at {TAPE_LANES} states{hint}")
            }
        };
        status.undefined = Some(what);
    }
    if !span.defects.is_empty() {
        let defects = result(&span.defects, &none);
        let reason = NO_QUADRATURE.to_string();
        match (defects.excludes_zero, defects.is_zero()) {
            (true, _) => return undecide(status, reason),
            (_, false) => status.undefined = Some(reason),
            _ => {}
        }
    }
    if !span.off_level.is_empty() {
        let (own, general) =
            (result(&span.off_level, &span.slope), result(&span.off_general, &span.slope));
        status.evidence.independence = match (own.is_zero(), own.excludes_zero) {
            (true, _) => Some(Independence::Constant),
            (_, false) => None,
            _ if span.off_general.is_empty() || general.excludes_zero => {
                Some(Independence::Independent)
            }
            _ => general.is_zero().then_some(Independence::General),
        };
    }
    if status.settled.is_some() {
        if status.undefined.is_some() {
            // Whether there is a state is not yet known.
            status.settled = None;
        }
        return;
    }
    let residual = result(&span.residual, &span.scale);
    if residual.defined == 0 {
        let hint = item.claim.kind.hint_when_undefined();
        let reason =
            format!("the residual is undefined at all {TAPE_LANES} states that were drawn{hint}");
        status.undefined.get_or_insert(reason);
    }
    status.blurred = residual.blur(kind, is_numerical);
}

/// Result of a block of states for a residual.
pub struct BlockResult {
    /// Number of states examined.
    states: usize,
    /// Number of states at which all required values exist.
    existing: usize,
    /// Number of states at which the residual has an enclosure.
    defined: usize,
    /// Number of states at which the enclosure is narrow against the residual's scale.
    resolved: usize,
    /// Whether some enclosure excludes 0.
    excludes_zero: bool,
}

impl BlockResult {
    /// Whether the residual is undefined at all states.
    pub fn is_nowhere_defined(&self) -> bool {
        self.defined == 0
    }

    /// Examines a residual, and the square of its scale, at the lanes that contain a state.
    pub fn at<D: Enclosing>(
        residuals: &[&D::Block],
        scale: Option<&D::Block>,
        existing: &[bool],
    ) -> Self {
        let mut result =
            Self { states: D::LANES, existing: 0, defined: 0, resolved: 0, excludes_zero: false };
        for lane in (0..D::LANES).filter(|lane| existing[*lane]) {
            result.existing += 1;
            let blur = match scale {
                None => f64::INFINITY,
                Some(scale) => {
                    let (mid, rad) = D::enclosure(scale, lane).unwrap_or((0.0, 0.0));
                    2f64.powi(-RESOLVED_BITS) * (mid - rad).max(0.0).sqrt()
                }
            };
            let enclosures = residuals.iter().map(|block| D::enclosure(block, lane));
            let is_narrow = |(_, rad): (f64, f64)| rad <= blur || rad == 0.0;
            let are_narrow = enclosures
                .map(|enclosure| enclosure.map(is_narrow))
                .try_fold(true, |all, is_narrow| Some(all && is_narrow?));
            let Some(are_narrow) = are_narrow else { continue };
            result.defined += 1;
            result.resolved += usize::from(are_narrow);
            result.excludes_zero |= residuals.iter().any(|block| D::excludes_zero(block, lane));
        }
        result
    }

    /// Whether all enclosures contain 0, and enough of them are narrow.
    pub fn is_zero(&self) -> bool {
        !self.excludes_zero && self.is_resolved() && !self.is_partial()
    }

    /// Whether enclosures are narrow at enough of the states at which all required values exist.
    fn is_resolved(&self) -> bool {
        self.resolved >= LEAST_RESOLVED && self.resolved * MIN_SHARE >= self.existing
    }

    /// Whether the residual is undefined at many of the states at which all required values exist.
    fn is_partial(&self) -> bool {
        (self.existing - self.defined) * MOST_LACKING > self.existing
    }

    /// Returns the reason why zeros in these enclosures would not be significant, if there is one: a residual
    /// without a value at some of the states that count, at any of them if all are asked.
    pub fn blur(&self, kind: &str, asks_all: bool) -> Option<String> {
        let lacks = asks_all && self.defined < self.existing;
        if !self.excludes_zero && (self.is_partial() || lacks) {
            return Some(format!(
                "the residual of this {kind} has no value at {} of {} states at which all that is \
                 written has one",
                self.existing - self.defined,
                self.existing
            ));
        }
        if self.excludes_zero || self.is_resolved() {
            return None;
        }
        Some(match self.existing < LEAST_RESOLVED {
            true => format!(
                "all that this {kind} contains has a value at {} of {} states, which are too few",
                self.existing, self.states
            ),
            false => format!(
                "rounding hides the residual of this {kind}: only at {} of {} states is its error \
                 bound 2^{RESOLVED_BITS} times below the terms that are added",
                self.resolved, self.existing
            ),
        })
    }

    /// Whether the residual is defined at some state.
    pub fn has_value(&self) -> bool {
        self.defined > 0
    }

    /// Whether some enclosure excludes 0.
    pub fn excludes_zero(&self) -> bool {
        self.excludes_zero
    }
}

/// Leaves a claim undecided, with a reason.
pub fn undecide(status: &mut ClaimState, reason: String) {
    status.settled = Some(Verdict::Undecided);
    status.evidence.reason = Some(reason);
}
