//! Tests for all choices of the signs of roots that depend on others.

use crate::graph::Expr;

use super::lower::Algebraic;
use super::next::for_both;
use super::tower::Tower;
use super::trial::{Roots, Trial, TrialResult};

/// Tests groups for all choices of the signs of dependent roots.
pub fn for_all_choices(
    trial: &Trial<'_>,
    groups: &[&[Expr]],
    tower: &Tower,
    loose: &[usize],
) -> Vec<TrialResult> {
    let of_choice = |choice: u32| {
        let signs = loose.iter().enumerate();
        let fixed: Vec<(usize, bool)> = signs.map(|(k, s)| (*s, choice >> k & 1 == 0)).collect();
        let roots = Roots { nested: tower.nested + loose.len() as u32, fixed: &fixed };
        trial.test(groups, roots)
    };
    let both = |found: Vec<TrialResult>, one: Vec<TrialResult>| {
        found.into_iter().zip(one).map(|(a, b)| for_both(a, b)).collect()
    };
    (1u32..1 << loose.len()).map(of_choice).fold(of_choice(0), both)
}

/// Result for a group that does not vanish, where its roots or functions may depend on others.
pub fn unlike(extended: &Algebraic<'_>, group: &[Expr], loose: &[usize]) -> TrialResult {
    let reason = match () {
        () if !loose.is_empty() => "it does not vanish for all choices of signs of dependent roots",
        () if extended.has_symbols(group) => {
            "it does not vanish for independent symbols in the place of transcendental functions"
        }
        () => return TrialResult::NonZero,
    };
    TrialResult::Silent(reason.to_string())
}
