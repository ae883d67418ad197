//! Validity of theorems obtained modulo primes: roots and moduli must be on the same branches there
//! as at real states.

use super::ansatz::Hamiltonians;
use super::terms::recorded;
use super::{Effort, FurtherTerm, SearchError, SearchReport};
use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::formula::Formula;
use liouville::graph::{Expr, Graph, Step};
use liouville::proof::Prover;
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
    report.counts.clear();
    report.multipliers.clear();
    report.excluded.clear();
    report.conditions.clear();
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
    let sampler = Sampler::new(case, &LevelSubset::level(&case.model), effort.options.seed)?;
    if sampler.is_numerical() {
        return Ok(true);
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
    let (extents, sources) = (sampler.extents(), sampler.sources());
    let prover = Prover { sources: &sources, extents: &extents, seed: effort.options.seed };
    let outputs = groups.concat();
    Ok(!has_irrational_radicand(&graph, &outputs)
        && prover.is_true_to_branches(&graph, &outputs)?)
}

/// Whether an irrational number stands under a root or a modulus: the root of (1 + √2)² y is (1 + √2) √y,
/// and modulo a prime it may be −(1 + √2) √y at every point.
fn has_irrational_radicand(graph: &Graph, outputs: &[Expr]) -> bool {
    let reached = graph.reached(outputs.iter().copied());
    let mut is_number = vec![false; reached.len()];
    let mut is_irrational = vec![false; reached.len()];
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        let is_root = !step.is_rational();
        let mut arguments = step.arguments().collect::<Vec<_>>().into_iter();
        is_irrational[place] = arguments.any(|argument| is_irrational[argument]);
        if is_root && is_irrational[place] {
            return true;
        }
        is_number[place] = !matches!(step, Step::Input(_))
            && step.arguments().collect::<Vec<_>>().into_iter().all(|k| is_number[k]);
        is_irrational[place] |= is_root && is_number[place];
    }
    false
}
