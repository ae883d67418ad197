//! Interpretation of lists of numbers as vectors or as diagonal matrices, according to their use.
//!
//! Lists are vectors, except those that have to be diagonal matrices for all formulas of the file
//! to have a meaning: as few as possible. If no choice achieves that, a list used in both ways is
//! reported.

use std::collections::BTreeSet;

use super::build::Attempt;
use super::error::{Mistake, Problem};
use crate::formula::FormulaError;
use crate::order::StableOrder;

/// Number of lists above which at most two of them are tried as matrices at once.
const MOST_TRIED: usize = 6;

/// Reads a file with the right choice; `read` reads it with the given lists as matrices.
pub fn settled(read: &dyn Fn(&BTreeSet<String>) -> Attempt) -> Attempt {
    let mut best = read(&BTreeSet::new());
    let mut chosen = BTreeSet::new();
    if of_kind(&best) == 0 {
        return best;
    }
    // tensors of inertia and of shape are likelier than others
    let mut lists = best.lists.clone();
    lists.order_by_key(|name| (name != "I", name != "B"));
    lists.dedup();
    for subset in subsets(&lists) {
        let attempt = read(&subset);
        if rank(&attempt) < rank(&best) {
            (best, chosen) = (attempt, subset);
        }
        if of_kind(&best) == 0 {
            return best;
        }
    }
    for name in &lists {
        let mut other = chosen.clone();
        if !other.remove(name) {
            other.insert(name.clone());
        }
        tell(&mut best, &read(&other), name, chosen.contains(name));
    }
    tell_diagonal(&mut best, &chosen);
    best
}

/// Rank of an attempt, low for a good one: of two with as many mistakes, that is the better in which more
/// was read, and then that in which more mistakes are of sizes alone.
fn rank(attempt: &Attempt) -> (usize, bool, usize) {
    let of_kinds = attempt
        .mistakes
        .iter()
        .filter(|mistake| may_be_of_kind(mistake) && sizes_error(mistake).is_none());
    (of_kind(attempt), !attempt.is_whole, of_kinds.count())
}

/// The error of a mistake that is of sizes alone.
fn sizes_error(mistake: &Mistake) -> Option<&FormulaError> {
    match &mistake.problem {
        Problem::Formula(error) => Some(error).filter(|error| error.is_of_sizes()),
        _ => None,
    }
}

/// Says that a list is read as a diagonal matrix where the size of a matrix does not fit.
fn tell_diagonal(attempt: &mut Attempt, chosen: &BTreeSet<String>) {
    let names: Vec<String> = chosen.iter().map(|name| format!("`{name}`")).collect();
    let words = match names.as_slice() {
        [] => return,
        [name] => format!("the list {name} is read as a diagonal matrix"),
        names => format!("the lists {} are read as diagonal matrices", names.join(", ")),
    };
    for mistake in &mut attempt.mistakes {
        let of_matrix = |error: &&FormulaError| error.message().contains("a matrix of size");
        let Some(error) = sizes_error(mistake).filter(of_matrix) else { continue };
        let help = error.help().map_or(words.clone(), |help| format!("{help}; {words}"));
        mistake.problem = Problem::Formula(error.clone().with_help(help));
    }
}

/// Number of mistakes that a list of the wrong type may cause.
fn of_kind(attempt: &Attempt) -> usize {
    attempt.mistakes.iter().filter(|mistake| may_be_of_kind(mistake)).count()
}

/// Whether the mistake may come from the type of a name.
fn may_be_of_kind(mistake: &Mistake) -> bool {
    match &mistake.problem {
        Problem::Formula(error) => error.unknown_name().is_none(),
        Problem::UnknownKey { .. }
        | Problem::BadName { .. }
        | Problem::WrongType { .. }
        | Problem::Parameter(_)
        | Problem::Sense { .. }
        | Problem::Cycle(..) => false,
        _ => true,
    }
}

/// Whether the mistake is one of types, which are checked wherever a formula is read.
fn is_of_types(mistake: &Mistake) -> bool {
    matches!(mistake.problem, Problem::Formula(_) | Problem::WrongKind { .. })
}

/// Subsets of the lists, small ones first.
fn subsets(lists: &[String]) -> Vec<BTreeSet<String>> {
    if lists.len() > MOST_TRIED {
        let single = lists.iter().map(|name| BTreeSet::from([name.clone()]));
        let pairs = lists.iter().enumerate().flat_map(|(k, a)| {
            lists[k + 1..].iter().map(|b| BTreeSet::from([a.clone(), b.clone()]))
        });
        return single.chain(pairs).chain([lists.iter().cloned().collect()]).collect();
    }
    let mut masks: Vec<u32> = (1..1 << lists.len()).collect();
    masks.order_by_key(|mask| mask.count_ones());
    let chosen = |mask: u32| {
        let inside = lists.iter().enumerate().filter(move |(k, _)| mask >> k & 1 == 1);
        inside.map(|(_, name)| name.clone()).collect()
    };
    masks.into_iter().map(chosen).collect()
}

/// Reports that a list is used in both ways, where the other choice mends one mistake and makes
/// others.
fn tell(best: &mut Attempt, other: &Attempt, name: &str, is_diagonal: bool) {
    let is_in = |mistake: &Mistake, list: &[Mistake]| {
        list.iter().any(|known| known.span == mistake.span && known.message() == mistake.message())
    };
    let is_new = |mistake: &&Mistake| may_be_of_kind(mistake) && !is_in(mistake, &best.mistakes);
    let makes_others = other.mistakes.iter().any(|mistake| is_new(&mistake));
    let (there, here) = match is_diagonal {
        true => ("a diagonal matrix", "a vector"),
        false => ("a vector", "a diagonal matrix"),
    };
    // A sum with a number is wrong for both, and says so in different words.
    let is_wrong_for_both = |mistake: &Mistake| {
        let place = |own: &Mistake| own.span.clone().unwrap_or_default();
        let (from, to) = (place(mistake).start, place(mistake).end);
        let overlaps = |own: &Mistake| place(own).start < to && from < place(own).end;
        other.mistakes.iter().any(|own| may_be_of_kind(own) && overlaps(own))
    };
    // Other mistakes are sought in a complete system only.
    let is_sought = |mistake: &Mistake| other.is_whole || is_of_types(mistake);
    let would_be_mended = |mistake: &&mut Mistake| {
        may_be_of_kind(mistake)
            && is_sought(mistake)
            && !is_in(mistake, &other.mistakes)
            && !is_wrong_for_both(mistake)
    };
    for mistake in best.mistakes.iter_mut().filter(would_be_mended).filter(|_| makes_others) {
        mistake.problem = Problem::Other {
            message: format!(
                "the list `{name}` is {there} in other formulas, and {here} in this one"
            ),
            remedy: format!(
                "declare the one as {name} = \"vec(…)\" and the other, under another name, as \
                 \"diag(…)\""
            ),
        };
    }
}
