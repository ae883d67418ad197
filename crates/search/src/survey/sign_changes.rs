//! Sign changes of the components of a state of the user's own, as symmetries and reversors.

use super::involutions::{MapCandidate, signed};
use super::question::FixedSet;
use liouville::case::Case;
use liouville::claim::{Reversor, Statement, Symmetry, clock};
use liouville::formula::Formula;
use liouville::formula::{FormulaResult, Type};

/// Largest number of components of a user-defined state for which all sign changes are tried.
const MOST_COMPONENTS: usize = 6;

/// Lists the sign changes of the components of a state without a frame; of whole variables if there
/// are many.
pub fn sign_changes(case: &Case) -> Vec<MapCandidate> {
    let model = &case.model;
    let scope = &model.vocabulary;
    let single = model.dimension() <= MOST_COMPONENTS;
    let parts = |kind: Type| match kind {
        Type::Vector(length) if single => length,
        _ => 1,
    };
    let count: usize = model.state.iter().map(|variable| parts(variable.kind)).sum();
    if count > MOST_COMPONENTS {
        return Vec::new();
    }
    let mut all = Vec::new();
    let before = |index: usize| model.state[..index].iter().map(|own| parts(own.kind)).sum();
    let clock: Option<usize> = clock(model).map(before);
    for key in [Reversor::NAME, Symmetry::NAME] {
        for mask in 1u32..1 << count {
            // A reversor takes time back, where it is a variable, and a symmetry leaves it.
            if clock.is_some_and(|bit| (mask >> bit & 1 == 1) != (key == Reversor::NAME)) {
                continue;
            }
            let (mut images, mut changed, mut bit) = (Vec::new(), Vec::new(), 0);
            let mut fixed = model.dimension();
            for variable in &model.state {
                let name = &variable.name;
                let Ok(own) = case.formula(name) else { return Vec::new() };
                let flips: Vec<bool> =
                    (bit..bit + parts(variable.kind)).map(|b| mask >> b & 1 == 1).collect();
                bit += flips.len();
                if !flips.contains(&true) {
                    continue;
                }
                let whole = !flips.contains(&false);
                fixed -= if whole { variable.len() } else { flips.iter().filter(|f| **f).count() };
                let part = |k: usize| -> FormulaResult {
                    Ok(signed(own.element(k + 1, scope)?, if flips[k] { -1 } else { 1 }))
                };
                let parts: Result<Vec<Formula>, _> = (0..flips.len()).map(part).collect();
                let image = match whole {
                    true => Ok(-&own),
                    false => parts.and_then(|parts| variable.kind.filled(&parts)),
                };
                let Ok(image) = image else { return Vec::new() };
                changed.push(format!("{name} → {image}"));
                images.push((name.clone(), image));
            }
            // On a level the dimension depends on the intersection with the fixed space.
            let known = key == Reversor::NAME && model.level.is_empty();
            let fixed_set = known.then_some(FixedSet { dimension: Some(fixed) });
            all.push(MapCandidate {
                name: format!("{key} {}", changed.join(", ")),
                key,
                images,
                fixed_set,
            });
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reversor_takes_time_back_once() {
        let text = "title = 'x'\n[state]\n\"φ\" = '-3..3'\np = '-2..2'\n[field]\n\"φ'\" = 'p'\n\
                    \"p'\" = 'cos(t)*sin(φ)'\n";
        let all = sign_changes(&Case::parse(text, &[]).expect("a case"));
        let (reversors, symmetries): (Vec<_>, Vec<_>) =
            all.into_iter().partition(|own| own.key == Reversor::NAME);
        let dimension = |own: &MapCandidate| own.fixed_set.and_then(|set| set.dimension);
        let found: Vec<_> =
            reversors.iter().map(|own| (own.name.as_str(), dimension(own))).collect();
        // t = 0 is fixed, too.
        let expected = [
            ("reversor t → −t", Some(2)),
            ("reversor φ → −φ, t → −t", Some(1)),
            ("reversor p → −p, t → −t", Some(1)),
            ("reversor φ → −φ, p → −p, t → −t", Some(0)),
        ];
        assert_eq!(found, expected);
        assert!(symmetries.iter().all(|own| !own.name.contains("t →")), "t' = 1");
        assert_eq!(symmetries.len(), 3);
    }
}
