//! Integrands of antiderivatives: each has to be a function of its variable.

use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::rejection;

/// Computes ∇f minus its projection on ∇x and the gradients of the level functions, for each ∫(f,
/// x) in a formula.
pub fn quadrature_defects(
    jet: &DualPoint<'_, Expr>,
    formula: &Formula,
    kept: &[bool],
) -> Vec<Expr> {
    let model = jet.phase.model();
    let mut defects = Vec::new();
    let all = model.vocabulary.with_abbreviations(formula, &model.abbreviations);
    for used in all.into_iter().filter(|f| f.has_antiderivative()) {
        let level = jet.level_gradients(kept);
        let columns: Vec<_> = jet
            .along_axes()
            .iter()
            .map(|moved| used.antiderivatives(&mut |symbol| moved.value(symbol)))
            .collect();
        let count = columns.first().map_or(0, Vec::len);
        defects.extend((0..count).flat_map(|k| {
            let integrand: Vec<Expr> = columns.iter().map(|pairs| pairs[k].0.eps).collect();
            let variable: Vec<Expr> = columns.iter().map(|pairs| pairs[k].1.eps).collect();
            let mut others = level.clone();
            others.push(variable);
            rejection(&integrand, &others)
        }));
    }
    defects
}
