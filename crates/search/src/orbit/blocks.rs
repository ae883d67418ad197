//! Closed subsystems: sets of variables whose rates, and whose equations of the level set, depend on
//! the set only. A field is searched subsystem by subsystem first, as fewer monomials allow a higher
//! degree.

use liouville::case::Case;
use liouville::graph::Expr;
use liouville::order::StableOrder;

use super::super::SearchError;
use super::super::terms::recorded;

/// Lists the smallest such sets that contain each variable, and the set of all variables, small ones
/// first.
pub fn closed(case: &Case) -> Result<Vec<Vec<usize>>, SearchError> {
    let model = &case.model;
    let (first, dimension) = (model.free_components(), model.dimension());
    let all: Vec<usize> = (0..dimension).collect();
    let (graph, (rates, equations)) = recorded(case, |jet| {
        let level = model.level.iter().map(|own| jet.phase.level_function(&own.function));
        (jet.phase.field().to_vec(), level.collect::<Vec<_>>())
    })?;
    let is_variable = |input: &usize| (first..first + dimension).contains(input);
    let needs = |rate: &Expr| -> Vec<usize> {
        let inputs = graph.inputs_of(*rate).into_iter().filter(is_variable);
        inputs.map(|input| input - first).collect()
    };
    let mut needed: Vec<Vec<usize>> = rates.iter().map(needs).collect();
    // A relation binds all its variables.
    for bound in equations.iter().map(needs) {
        bound.iter().for_each(|variable| needed[*variable].extend(&bound));
    }
    let mut sets = vec![all.clone()];
    for start in all {
        let mut set = vec![start];
        let mut next = 0;
        while let Some(variable) = set.get(next).copied() {
            next += 1;
            for other in &needed[variable] {
                if !set.contains(other) {
                    set.push(*other);
                }
            }
        }
        set.sort_unstable();
        if !sets.contains(&set) {
            sets.push(set);
        }
    }
    sets.order_by_key(Vec::len);
    Ok(sets)
}
