//! Mutation test of the verifier: true formulas are perturbed, and each mutant must be refuted.
//!
//! A mutant that is proved to hold is *equivalent* if it follows from known invariants: its
//! gradient depends on those of the level, the energy and the integrals that are known to hold (for
//! a density, the gradient of ln ρ'/ρ does, since the quotient of two densities is an integral).
//! Otherwise it is a *discovery*. A mutant that is neither refuted nor proved has survived: a
//! defect of the sampling, or of the claim.

use serde::Serialize;

use super::claim_state::BlockResult;
use super::evidence::ClaimReport;
use super::field::{Answer, PrimeFieldStates, Query};
use super::judge::{JudgeError, Options};
use super::judging::Judging;
use super::recorded::SharedTerms;
use super::run::Doubles;
use super::sampler::{Sampler, TAPE_LANES};
use crate::case::{Case, Expect, PlacedClaim};
use crate::claim::{ClaimKind, LevelSubset};
use crate::formula::Mutant;
use crate::graph::{Expr, record};
use crate::mechanics::Phase;
use crate::mechanics::calculus::DualPoint;
use crate::number::Enclosing;
use crate::number::ball::Ball;
use crate::number::double_double_ball::DoubleDoubleBall;

/// Results of the mutants of a case.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct MutationReport {
    /// Number of mutants refuted, or without any value.
    pub killed: usize,
    /// Number of mutants that are true and follow from known invariants.
    pub equivalent: usize,
    /// Mutants neither refuted nor proved.
    pub survived: Vec<MutantReport>,
    /// Mutants proved, and independent of known invariants.
    pub discovered: Vec<MutantReport>,
}

impl MutationReport {
    /// Combines the mutants of different claims.
    pub(super) fn and(mut self, other: Self) -> Self {
        self.killed += other.killed;
        self.equivalent += other.equivalent;
        self.survived.extend(other.survived);
        self.discovered.extend(other.discovered);
        self
    }
}

/// A mutant for the report.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct MutantReport {
    /// Claim from which it was made.
    pub claim: String,
    /// Formula of the mutant.
    pub formula: String,
    /// Description of the change.
    pub change: String,
}

/// A mutant under judgement.
struct Candidate<'c> {
    claim: &'c PlacedClaim,
    mutant: Mutant,
    residual: Vec<Expr>,
}

/// Mutates every formula of a wanted claim that is expected to hold and does.
pub fn mutate(
    case: &Case,
    reports: &[ClaimReport],
    options: &Options,
) -> Result<MutationReport, JudgeError> {
    let model = &case.model;
    let held: Vec<&PlacedClaim> = case
        .claims
        .iter()
        .zip(reports)
        .filter(|(claim, report)| claim.expect == Expect::Holds && report.agrees)
        .map(|(claim, _)| claim)
        .collect();
    let inputs = model.free_components() + model.dimension();
    let (graph, (candidates, common)) = record(inputs, |inputs| {
        let (parameters, state) = inputs.split_at(model.free_components());
        let jet = DualPoint::new(Phase::new(model, parameters, state));
        let mut candidates = Vec::new();
        for claim in &held {
            let Some(formula) = claim.kind.formula().filter(|_| claim.is_wanted) else { continue };
            for mutant in formula.mutants(&model.vocabulary) {
                let Some(kind) = claim.kind.about(mutant.formula.clone()) else { continue };
                let residual = [
                    kind.residual(&jet, &claim.place.kept),
                    kind.quadrature_defects(&jet, &claim.place.kept),
                ]
                .concat();
                candidates.push(Candidate { claim, mutant, residual });
            }
        }
        (candidates, SharedTerms::of(&jet))
    })?;
    let bench = Judging::new(case, &common, options, &graph, inputs);
    let mut report = MutationReport::default();
    let mut places: Vec<&LevelSubset> = Vec::new();
    for candidate in &candidates {
        if !places.contains(&&candidate.claim.place) {
            places.push(&candidate.claim.place);
        }
    }
    for place in places {
        let here: Vec<&Candidate<'_>> =
            candidates.iter().filter(|candidate| candidate.claim.place == *place).collect();
        let mut alive: Vec<_> = here.into_iter().map(|candidate| (candidate, true)).collect();
        let samplers = bench.all_samplers(place)?;
        let is_single = samplers.len() == 1;
        for sampler in samplers.iter().filter(|sampler| is_single || sampler.has_states()) {
            let (left, proved): (Vec<_>, Vec<bool>) = alive.into_iter().unzip();
            let known: Vec<_> = left.iter().copied().zip(proved).collect();
            let was_proved = |candidate: &&Candidate<'_>| {
                known.iter().any(|(own, proved)| std::ptr::eq(*own, *candidate) && *proved)
            };
            let found = bench.kill(sampler, left, &mut report)?.into_iter();
            alive = found.map(|(own, proved)| (own, proved && was_proved(&own))).collect();
        }
        for (candidate, is_true) in alive {
            match is_true {
                false => report.survived.push(candidate.report()),
                true if depends(case, &held, candidate, options)? => report.equivalent += 1,
                true => report.discovered.push(candidate.report()),
            }
        }
    }
    Ok(report)
}

impl Candidate<'_> {
    fn report(&self) -> MutantReport {
        MutantReport {
            claim: self.claim.name.clone(),
            formula: self.mutant.formula.text().to_string(),
            change: self.mutant.change.clone(),
        }
    }
}

impl Judging<'_> {
    /// Refutes mutants; returns the others, and whether they are proved.
    fn kill<'k, 'c>(
        &self,
        sampler: &Sampler,
        candidates: Vec<&'k Candidate<'c>>,
        report: &mut MutationReport,
    ) -> Result<Vec<(&'k Candidate<'c>, bool)>, JudgeError> {
        let total = candidates.len();
        let left = self.not_refuted::<Doubles>(&Ball::<TAPE_LANES>, &sampler.balls(0), candidates);
        let queries: Vec<Query> = left.iter().map(|c| Query::of(c.residual.clone())).collect();
        let answers = PrimeFieldStates::new(self, sampler).test(&queries)?;
        let (mut proved, mut silent, mut killed) = (Vec::new(), Vec::new(), total - left.len());
        for (candidate, answer) in left.into_iter().zip(answers) {
            match answer {
                Answer::Zero(_) => proved.push((candidate, true)),
                Answer::NonZero(_) => killed += 1,
                Answer::Silent(_) | Answer::Void | Answer::Partial => silent.push(candidate),
            }
        }
        let open = silent.len();
        let survived = match sampler.is_numerical() {
            true => silent,
            false => {
                let domain = DoubleDoubleBall::<TAPE_LANES>;
                self.not_refuted(&domain, &sampler.states(&domain, TAPE_LANES, 0), silent)
            }
        };
        killed += open - survived.len();
        report.killed += killed;
        proved.extend(survived.into_iter().map(|candidate| (candidate, false)));
        Ok(proved)
    }

    /// Selects those whose residual is enclosed with 0 at all states of a block, and is defined at
    /// one.
    fn not_refuted<'k, 'c, D: Enclosing + Clone>(
        &self,
        domain: &D,
        states: &[D::Block],
        candidates: Vec<&'k Candidate<'c>>,
    ) -> Vec<&'k Candidate<'c>> {
        let outputs: Vec<Expr> = candidates.iter().flat_map(|c| c.residual.clone()).collect();
        let values = self.run(&outputs).at(domain, states);
        let mut start = 0;
        let mut left = Vec::new();
        for candidate in candidates {
            let residual = values.range(start..start + candidate.residual.len());
            start += candidate.residual.len();
            let result = BlockResult::at::<D>(&residual, None, &values.existing(&[]));
            if result.has_value() && !result.excludes_zero() {
                left.push(candidate);
            }
        }
        left
    }
}

/// Whether a true mutant follows from its original and the other integrals.
fn depends(
    case: &Case,
    held: &[&PlacedClaim],
    candidate: &Candidate<'_>,
    options: &Options,
) -> Result<bool, JudgeError> {
    let (model, claim) = (&case.model, candidate.claim);
    let inputs = model.free_components() + model.dimension();
    let mut known_rows = 0;
    let (graph, (rows, common)) = record(inputs, |inputs| {
        let (parameters, state) = inputs.split_at(model.free_components());
        let jet = DualPoint::new(Phase::new(model, parameters, state));
        // If the level functions are integrals everywhere, all of them are known integrals.
        let all = vec![true; model.level.len()];
        let known = if model.system.conserves_level() { &all } else { &claim.place.kept };
        let mut rows = jet.level_gradients(known);
        rows.extend(jet.energy_gradient().cloned());
        for other in held.iter().filter(|other| matches!(other.kind, ClaimKind::Integral(_))) {
            rows.extend(other.kind.slopes(&jet));
        }
        known_rows = rows.len();
        let own = claim.kind.slopes(&jet);
        let mutant = claim.kind.about(candidate.mutant.formula.clone());
        let new = mutant.map_or(Vec::new(), |mutant| mutant.slopes(&jet));
        match claim.kind {
            ClaimKind::Integral(_) => rows.extend(new),
            _ => rows.extend(own.iter().zip(&new).map(|(own, new)| -> Vec<Expr> {
                own.iter().zip(new).map(|(a, b)| *b - *a).collect()
            })),
        }
        (rows, SharedTerms::of(&jet))
    })?;
    // A mutant that is neither an integral nor a density is equivalent to any other true statement
    // in its place.
    if rows.len() == known_rows {
        return Ok(true);
    }
    let bench = Judging::new(case, &common, options, &graph, inputs);
    let sampler = Sampler::new(case, &claim.place, options.seed)?;
    let ranks = PrimeFieldStates::new(&bench, &sampler).ranks(&rows, &[known_rows, rows.len()])?;
    Ok(ranks.is_some_and(|ranks| ranks[0] == ranks[1]))
}
