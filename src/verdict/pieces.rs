//! Levels that no single solution fills: claims are decided on each of their parts.

use std::rc::Rc;

use super::claim_state::{ClaimState, undecide};
use super::evidence::{DensitySign, Evidence, Independence, Method, Proof, Verdict};
use super::judge::JudgeError;
use super::judging::Judging;
use super::ladder::Open;
use super::recorded::RecordedClaim;
use super::sampler::{PlaceParts, Sampler, TAPE_LANES};
use crate::claim::LevelSubset;
use crate::graph::Fault;
use crate::mechanics::{Chart, Draw, combinations};
use crate::proof::{fewest, sum_log2};

/// Samplers of the parts of a place, for each choice of listed parameter values.
pub type Pieces = Rc<[Vec<Sampler>]>;

impl Judging<'_> {
    /// Returns the parts of a place, if the states of `sampler` may leave out one of them and the place
    /// can be divided.
    pub(super) fn pieces(&self, sampler: &Sampler) -> Result<Option<Pieces>, Fault> {
        let known = self.pieces.borrow().get(sampler.kept()).cloned();
        if let Some(known) = known {
            return Ok(known);
        }
        let found = self.find_pieces(sampler)?;
        self.pieces.borrow_mut().insert(sampler.kept().to_vec(), found.clone());
        Ok(found)
    }

    fn find_pieces(&self, sampler: &Sampler) -> Result<Option<Pieces>, Fault> {
        let case = self.case;
        let is_whole = matches!(case.chart, Chart::Equations)
            && !sampler.is_numerical()
            && sampler.has_states()
            && self.missed_part(sampler)?.is_none();
        if !matches!(case.chart, Chart::Equations) || is_whole {
            return Ok(None);
        }
        if let Some(pieces) = self.solved_pieces(sampler)? {
            return Ok(Some(pieces));
        }
        let place = PlaceParts::of(case, sampler)?;
        let Some(choices) = combinations(&place.draws) else { return Ok(None) };
        let mut pieces = Vec::new();
        for fixed in &choices {
            let Some(parts) = place.divided(fixed)? else { return Ok(None) };
            let recipes = place.recipes(fixed);
            let of_part = |part| sampler.on_part(&self.case.model, part, recipes.clone());
            let mut own: Vec<Sampler> = parts.iter().map(of_part).collect::<Result<_, Fault>>()?;
            let moves = own.iter().map(|own| self.moves(own)).collect::<Result<Vec<_>, Fault>>()?;
            let mut moves = moves.into_iter();
            own.retain(|_| moves.next().unwrap_or(true));
            if !own.is_empty() {
                pieces.push(own);
            }
        }
        Ok((!pieces.is_empty()).then(|| pieces.into()))
    }

    /// Returns samplers of the place, or of the levels into which it falls by the form of its equations, if
    /// each has a solution, in some order, that has states and is known to miss nothing.
    fn solved_pieces(&self, sampler: &Sampler) -> Result<Option<Pieces>, Fault> {
        let branches = sampler.branches(self.case)?;
        let branches = match &branches {
            Some(branches) => branches.iter().map(Some).collect(),
            None => vec![None],
        };
        let mut own: Vec<Sampler> = Vec::new();
        for branch in branches {
            let mut found = None;
            for solved in sampler.solved(self.case, branch)? {
                // What has no states may be what real points of lower dimension are left of.
                if solved.has_states() && self.missed_part(&solved)?.is_none() {
                    found = Some(solved);
                    break;
                }
            }
            let Some(found) = found else { return Ok(None) };
            own.push(found);
        }
        let lists: Vec<Draw> =
            sampler.recipes().iter().take(sampler.parameter_draws()).cloned().collect();
        let Some(choices) = combinations(&lists) else { return Ok(None) };
        let mut pieces = Vec::new();
        for fixed in &choices {
            let of_choice = |own: &Sampler| {
                let rest = own.recipes().len() - fixed.len();
                own.with(&[&fixed[..], &vec![None; rest]].concat())
            };
            let mut of_choice: Vec<Sampler> = own.iter().map(of_choice).collect();
            let moves =
                of_choice.iter().map(|own| self.moves(own)).collect::<Result<Vec<_>, Fault>>()?;
            let mut moves = moves.into_iter();
            of_choice.retain(|_| moves.next().unwrap_or(true));
            if !of_choice.is_empty() {
                pieces.push(of_choice);
            }
        }
        Ok((!pieces.is_empty()).then(|| pieces.into()))
    }

    /// Whether there may be a motion on a part: at the apex of a cone its reactions are 0/0.
    fn moves(&self, sampler: &Sampler) -> Result<bool, Fault> {
        // Where elimination has no value there may be motions nevertheless.
        if !self.common.open_divisors.is_empty() {
            return Ok(true);
        }
        let Some(choices) = combinations(sampler.recipes()) else { return Ok(true) };
        let field = std::slice::from_ref(&self.common.field);
        for fixed in choices {
            let (graph, values) = sampler.compose(self.graph, field, &fixed)?;
            if !values.concat().into_iter().any(|value| graph.is_nowhere_defined(value)) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Returns the samplers whose states fill a place together, one for each of its parts.
    pub(super) fn all_samplers(&self, place: &LevelSubset) -> Result<Vec<Sampler>, Fault> {
        let sampler = Sampler::new(self.case, place, self.options.seed)?;
        Ok(match self.pieces(&sampler)? {
            Some(pieces) => pieces.iter().flatten().cloned().collect(),
            None => vec![sampler],
        })
    }

    /// Decides claims on each part of a place.
    pub(super) fn climb_pieces<'f, 'r: 'f>(
        &self,
        place: &LevelSubset,
        pieces: &Pieces,
        open: Open<'f, 'r>,
    ) -> Result<(), JudgeError> {
        let mut found: Vec<Vec<Vec<ClaimState>>> = Vec::new();
        for choice in pieces.iter() {
            let mut own = Vec::new();
            for sampler in choice {
                let mut states: Vec<ClaimState> =
                    open.iter().map(|_| ClaimState::default()).collect();
                let items = open.iter().zip(&mut states).map(|((item, _), state)| (*item, state));
                let is_asked = |item: &RecordedClaim<'_>| {
                    !(sampler.is_thin() && item.claim.kind.is_of_almost_all())
                };
                let (items, others): (Vec<_>, Vec<_>) = items.partition(|(item, _)| is_asked(item));
                self.climb_on(place, sampler, items)?;
                for (_, status) in others {
                    status.is_void = true;
                    let reason = "the parts of the level that are known are of lower dimension, \
                                  where the claim says nothing";
                    undecide(status, reason.to_string());
                }
                let drawn = sampler.balls(0);
                let is_state = |lane: usize| drawn.iter().all(|block| block.is_defined(lane));
                let (is_thin, has_states) = (sampler.is_thin(), (0..TAPE_LANES).any(is_state));
                for state in &mut states {
                    (state.is_thin, state.has_states) = (is_thin, has_states);
                }
                own.push(states);
            }
            found.push(own);
        }
        if !self.flat.borrow().is_empty() {
            for (sampler, states) in pieces.iter().flatten().zip(found.iter_mut().flatten()) {
                let is_regular = !sampler.is_thin() && self.flat_equations(sampler)?.is_empty();
                states.iter_mut().for_each(|state| state.is_regular = is_regular);
            }
        }
        for (item, status) in open.into_iter().rev() {
            let of_choice = |parts: &mut Vec<Vec<ClaimState>>| {
                parts.iter_mut().filter_map(Vec::pop).collect::<Vec<ClaimState>>()
            };
            let choices: Vec<Vec<ClaimState>> = found.iter_mut().map(of_choice).collect();
            *status = match item.claim.kind.is_negated() {
                true => {
                    let all = choices.into_iter().map(|parts| {
                        on_some(parts.into_iter().filter(|part| !part.is_thin).collect())
                    });
                    let all: Vec<ClaimState> = all.collect();
                    let is_on_a_part = all.iter().any(|state| state.is_on_a_part);
                    let parts = if let [only] = &all[..] { only.parts } else { None };
                    // One choice of listed values for which a value vanishes refutes the claim.
                    let found = first(all, |state| state.settled != Some(Verdict::Refuted));
                    ClaimState { is_on_a_part, parts, ..found }
                }
                false => on_all(choices.into_iter().flatten().collect()),
            };
            if let Some(witness) = &mut status.evidence.witness {
                witness.index = None;
            }
        }
        Ok(())
    }
}

/// Returns the first of some states that is as wanted, or the first of all.
fn first(mut states: Vec<ClaimState>, is_wanted: impl Fn(&ClaimState) -> bool) -> ClaimState {
    let index = states.iter().position(is_wanted).unwrap_or(0);
    if states.is_empty() { ClaimState::default() } else { states.swap_remove(index) }
}

/// Combines what is found of a claim that some value does not vanish.
fn on_some(states: Vec<ClaimState>) -> ClaimState {
    let is_shown = |state: &ClaimState| state.settled == Some(Verdict::Refuted);
    let count = states.iter().filter(|state| is_shown(state)).count();
    let (all, is_on_a_part) = (states.len(), states.iter().any(|state| state.is_on_a_part));
    let is_proved = |state: &ClaimState| state.settled == Some(Verdict::Proved);
    let is_known = !is_on_a_part && states.iter().all(|own| is_shown(own) || is_proved(own));
    // One part on which the value vanishes refutes the claim, as any claim has to hold on each.
    let fails = is_known && count < all;
    let mut found = match count {
        0 => first(states, |state| !is_proved(state)),
        _ if fails => first(states, is_proved),
        _ => first(states, is_shown),
    };
    found.is_on_a_part = count > 0 && !fails && (is_on_a_part || count < all);
    found.parts = (is_known && count > 0).then_some((count, all));
    found
}

/// Combines what is found of a claim that holds where it does on all parts.
fn on_all(states: Vec<ClaimState>) -> ClaimState {
    // Parts without states say nothing, as long as there are others.
    let is_void = |state: &ClaimState| state.is_void || state.is_unseen;
    let is_unseen = states.iter().any(|state| state.is_unseen && !state.is_thin);
    let (void, mut states): (Vec<_>, Vec<_>) = states.into_iter().partition(is_void);
    if states.is_empty() {
        return first(void, |_| true);
    }
    // No state of a thin part counts if the claim has no value at the states around it.
    let is_without_value = |state: &ClaimState| !state.is_thin && state.has_states;
    if states.iter().all(|state| state.is_thin) && void.iter().any(is_without_value) {
        return first(void, is_without_value);
    }
    // Where the slopes are independent a refutation says most.
    let is_refuted = |state: &ClaimState| state.settled == Some(Verdict::Refuted);
    if let Some(index) = states.iter().position(|state| is_refuted(state) && state.is_regular) {
        return states.swap_remove(index);
    }
    if states.iter().any(is_refuted) {
        return first(states, is_refuted);
    }
    if !states.iter().all(ClaimState::holds) {
        return first(states, |state| !state.holds());
    }
    let parts = states.len();
    // What is told of signs and independence is told of parts of full dimension.
    for state in states.iter_mut().filter(|state| state.is_thin) {
        (state.evidence.sign, state.evidence.independence) = (None, None);
    }
    let remark = remark_on_all(&states);
    let weakest = states.iter().position(|state| state.settled == Some(Verdict::Confirmed));
    let mut all = states.swap_remove(weakest.unwrap_or(0));
    for state in states {
        all.evidence.include(state.evidence, all.is_thin || state.is_thin);
        all.is_thin &= state.is_thin;
    }
    all.evidence.remark = remark;
    let silent: Vec<&ClaimState> = void.iter().filter(|state| is_without_value(state)).collect();
    if silent.iter().any(|state| state.is_void || state.is_silent) {
        let remark = "nothing is said on a part of the level, where a formula has no value";
        all.evidence.add_remark(remark.to_string());
    } else if let Some(remark) = silent.iter().find_map(|state| state.evidence.remark.as_ref()) {
        all.evidence.add_remark(format!("on a part of the level: {remark}"));
    }
    if is_unseen {
        let evidence = &mut all.evidence;
        let is_open = evidence.sign.is_some_and(|sign| sign != DensitySign::Changes);
        evidence.independence = None;
        evidence.sign_is_proved &= !is_open;
        evidence.sign_is_partial |= is_open;
    }
    if let (Some(last), true) = (all.evidence.climb.last_mut(), parts > 1) {
        last.found = format!("on each of {parts} parts of the level: {}", last.found);
    }
    all
}

/// Combines the remarks on all parts; what is remarked of some parts is not true of others.
fn remark_on_all(states: &[ClaimState]) -> Option<String> {
    let of = |state: &ClaimState| state.evidence.remark.clone();
    let mut remarks: Vec<Option<String>> = states.iter().map(of).collect();
    remarks.dedup();
    if let [only] = &mut remarks[..] {
        return only.take();
    }
    let mut told: Vec<String> = Vec::new();
    for remark in remarks.into_iter().flatten() {
        let remark = format!("on a part of the level: {remark}");
        if !told.contains(&remark) {
            told.push(remark);
        }
    }
    (!told.is_empty()).then(|| told.join("; "))
}

impl Evidence {
    /// Includes the evidence that a claim holds on another part of the states; where one part is thin,
    /// signs and independence are those of the other.
    fn include(&mut self, other: Self, is_one_thin: bool) {
        let larger = |a: Option<f64>, b: Option<f64>| match (a, b) {
            (Some(a), Some(b)) => Some(a.max(b)),
            (a, b) => a.or(b),
        };
        self.samples += other.samples;
        self.max_residual = larger(self.max_residual, other.max_residual);
        self.max_scaled_residual = larger(self.max_scaled_residual, other.max_scaled_residual);
        self.proof = match (self.proof.take(), other.proof.clone()) {
            (Some(a), Some(b)) => Some(a.and(&b)),
            (a, b) => a.or(b),
        };
        if self.method == Method::Folding {
            self.method = other.method;
        }
        if is_one_thin {
            self.independence = self.independence.or(other.independence);
            if self.sign.is_none() {
                (self.sign, self.sign_is_proved) = (other.sign, other.sign_is_proved);
            }
        } else {
            self.include_sign(&other);
        }
        self.sign_is_partial |= other.sign_is_partial;
        self.sign_may_vanish |= other.sign_may_vanish;
        other.flaws.iter().for_each(|flaw| self.add_flaw(*flaw));
        other.assumes.iter().for_each(|own| self.assume(*own));
    }

    fn include_sign(&mut self, other: &Self) {
        self.independence = match (self.independence, other.independence) {
            (Some(a), Some(b)) if a == b => Some(a),
            (Some(Independence::Independent), Some(_))
            | (Some(_), Some(Independence::Independent)) => Some(Independence::Independent),
            (Some(_), Some(_)) => Some(Independence::General),
            _ => None,
        };
        let changes = Some(DensitySign::Changes);
        let shows = |sign, is_proved| sign == changes && is_proved;
        let is_shown =
            shows(self.sign, self.sign_is_proved) || shows(other.sign, other.sign_is_proved);
        self.sign = match (self.sign, other.sign) {
            (Some(a), Some(b)) if a == b => Some(a),
            (Some(_), Some(_)) => changes,
            _ => None,
        };
        self.sign_is_proved =
            self.sign.is_some() && (is_shown || (self.sign_is_proved && other.sign_is_proved));
    }
}

impl Proof {
    /// Combines the proofs of two parts of a statement.
    fn and(self, other: &Self) -> Self {
        Self {
            primes: self.primes.max(other.primes),
            points: fewest(self.points, other.points),
            draws: self.draws.max(other.draws),
            degree: self.degree.max(other.degree),
            roots: self.roots.max(other.roots),
            error_log2: sum_log2(self.error_log2, other.error_log2),
        }
    }
}
