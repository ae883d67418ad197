//! Validity of theorems obtained modulo primes: roots and moduli must be on the same branches there
//! as at real states.

use super::ansatz::Hamiltonians;
use super::local::unwound;
use super::origin::ConditionOrigin;
use super::terms::recorded;
use super::{Effort, FurtherTerm, SearchError, SearchReport, irrational};
use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::formula::Formula;
use liouville::proof::{Extent, Prover};
use liouville::verdict::Sampler;

/// Withdraws all theorems so far if the formulas of a case contain moduli, or roots that depend on
/// each other: modulo a prime these have another sign at half of all points.
pub fn withdraw(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let counts = report.counts.len() + report.multipliers.len();
    if counts + report.excluded.len() + report.conditions.len() == 0 || are_true(case, effort)? {
        return Ok(());
    }
    if counts > 0 && are_counts_true(case, effort)? {
        // Sines and cosines took values of their own elsewhere.
        let before = report.excluded.len() + report.conditions.len();
        report.excluded.retain(|own| own.origin.is_count());
        report.conditions.retain(|own| own.origin == ConditionOrigin::Counts);
        if report.excluded.len() + report.conditions.len() < before {
            report.remark(
                "nothing is excluded but by counts: the formulas contain sines, cosines or exponentials"
                    .to_string(),
            );
        }
        return Ok(());
    }
    let has_no_values = counts + report.excluded.len() == 0 && are_counts_true(case, effort)?;
    report.counts.clear();
    report.multipliers.clear();
    report.excluded.clear();
    report.conditions.clear();
    if has_no_values {
        report.remark(
            "no condition is stated: the formulas contain sines, cosines, exponentials or powers, which have \
             no values modulo a prime"
                .to_string(),
        );
        return Ok(());
    }
    report.remark(
        "nothing is counted or excluded: the formulas contain a modulus, a root that depends on \
         others or has an irrational number under it, or a function such as atan; write a modulus or \
         a root as what it is on the given ranges, as x for |x| or √(x²) where x > 0"
            .to_string(),
    );
    Ok(())
}

/// Whether all formulas that enter theorems agree modulo primes with their values at real states.
pub fn are_true(case: &Case, effort: &Effort) -> Result<bool, SearchError> {
    are_true_in(case, effort, false)
}

/// Whether they do in the coordinates of a count, in which angles are points of a circle.
pub fn are_counts_true(case: &Case, effort: &Effort) -> Result<bool, SearchError> {
    are_true_in(case, effort, true)
}

fn are_true_in(case: &Case, effort: &Effort, of_count: bool) -> Result<bool, SearchError> {
    let sampler = Sampler::new(case, &LevelSubset::level(&case.model), effort.options.seed)?;
    // Which signs of roots lead to states is not known there.
    if sampler.is_numerical() {
        return Ok(false);
    }
    let given = match &effort.poisson {
        Some(Hamiltonians::Given(text)) => Formula::parse(text, &case.model.vocabulary).ok(),
        Some(Hamiltonians::Known) | None => None,
    };
    let terms = effort.terms.iter().filter_map(|term| match term {
        FurtherTerm::Formula(formula) => Some(formula.clone()),
        FurtherTerm::Text(text) => Formula::parse(text, &case.model.vocabulary).ok(),
    });
    let typed: Vec<Formula> = terms.chain(given).collect();
    let (graph, outputs) = recorded(case, |jet| {
        let mut outputs = jet.phase.field().to_vec();
        for formula in &typed {
            outputs.extend(jet.phase.evaluate(formula).components());
        }
        outputs
    })?;
    let fixed = vec![None; sampler.recipes().len()];
    let (graph, groups) = sampler.compose(&graph, &[outputs], &fixed)?;
    let (mut extents, sources) = (sampler.extents(), sampler.sources());
    let mut outputs = groups.concat();
    let mut graph = graph;
    let parameters = case.model.parameter_draws().len();
    if of_count && let Some(own) = unwound::of(&graph, &outputs, (sampler.recipes(), parameters))? {
        (graph, outputs) = (own.graph, own.outputs);
        own.replaced.into_iter().for_each(|input| extents[input] = Extent::ALL);
    }
    let prover = Prover { sources: &sources, extents: &extents, seed: effort.options.seed };
    match irrational::is_absent(&graph, &outputs) {
        true => Ok(prover.is_true_to_branches(&graph, &outputs)?),
        false => {
            let seed = effort.options.seed;
            Ok(irrational::is_independent(&graph, &outputs, sampler.recipes(), seed))
        }
    }
}
