//! Exchanges of the components of a state of the user's own, with signs, as symmetries and reversors.
//!
//! ```text
//! signed permutations → those that fit the field at drawn states → generators → claims
//! ```
//!
//! (σx)ᵢ = sᵢ x_p(i) is a symmetry where v(σx)ᵢ = sᵢ v_p(i)(x), and a reversor, if σ² is the identity, with
//! the opposite sign. What fits in f64 is proved or dropped afterwards. Maps that are products of others
//! are left out.

use std::collections::BTreeSet;

use super::drawn_states::states;
use super::involutions::{MapCandidate, signed};
use super::question::FixedSet;
use super::sign_changes::sign_changes;
use super::signed_permutation::SignedPermutation;
use liouville::case::Case;
use liouville::claim::{Reversor, Statement, Symmetry, clock};
use liouville::formula::{Formula, Type};
use liouville::mechanics::{System, VariableRole};
use liouville::order::StableOrder;

/// Largest number of components of which all signed permutations are tried.
const MOST_COMPONENTS: usize = 6;
/// Largest number of components of which all changes of sign are tried.
const MOST_OF_SIGNS: usize = 12;
/// Largest number of components of which orders are reversed and shifted.
const MOST_IN_ORDER: usize = 48;
/// Largest number of variables whose signs are combined with these.
const MOST_SIGNS: usize = 4;
/// Largest number of maps in a group that is completed.
const MOST_PRODUCTS: usize = 4000;
/// Largest number of maps that are claimed.
const MOST_CLAIMED: usize = 12;

/// A signed permutation of the components, and whether it reverses time.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Exchange {
    places: Vec<usize>,
    signs: Vec<i8>,
    reverses: bool,
}

impl Exchange {
    fn is_permutation(&self) -> bool {
        self.places.iter().enumerate().any(|(i, place)| i != *place)
    }

    fn map(&self) -> SignedPermutation<'_> {
        SignedPermutation { places: &self.places, signs: &self.signs }
    }

    /// The map `self` after `other`.
    fn after(&self, other: &Self) -> Self {
        let places = self.places.iter().map(|place| other.places[*place]).collect();
        let signs =
            self.places.iter().zip(&self.signs).map(|(place, sign)| sign * other.signs[*place]);
        Self { places, signs: signs.collect(), reverses: self.reverses != other.reverses }
    }

    fn image(&self, x: &[f64]) -> Vec<f64> {
        self.places.iter().zip(&self.signs).map(|(p, s)| x[*p] * f64::from(*s)).collect()
    }

    /// Number of components that are moved, and of signs.
    fn size(&self) -> (usize, usize) {
        let moved = self.places.iter().enumerate().filter(|(i, place)| i != *place).count();
        (moved, self.signs.iter().filter(|sign| **sign < 0).count())
    }
}

/// Lists exchanges that fit the field at drawn states, without products of others.
pub fn exchanges(case: &Case, seed: u64) -> Vec<MapCandidate> {
    let model = &case.model;
    if clock(model).is_some() || model.system.is_map() || model.dimension() < 2 {
        return Vec::new();
    }
    let Some(states) = states(case, seed) else { return Vec::new() };
    let fits =
        |own: &Exchange| states.iter().all(|state| state.fits(|x| own.image(x), own.reverses));
    let is_identity = |own: &Exchange| !own.is_permutation() && own.size().1 == 0;
    let all = candidates(case).into_iter().filter(|own| !is_identity(own));
    let mut fitting: Vec<Exchange> = all.filter(fits).collect();
    // Changes of sign alone come first as generators; of few components they are tried elsewhere.
    let has_signs = !sign_changes(case).is_empty();
    fitting.order_by_key(|own| (own.is_permutation(), own.size(), own.reverses));
    let mut group: BTreeSet<Exchange> = BTreeSet::new();
    let (mut generators, mut kept) = (Vec::new(), Vec::new());
    for own in fitting {
        if group.contains(&own) || kept.len() == MOST_CLAIMED {
            continue;
        }
        generators.push(own.clone());
        group = generated(&generators);
        if own.is_permutation() || !has_signs {
            kept.push(own);
        }
    }
    kept.iter().filter_map(|own| candidate(case, own)).collect()
}

/// All products of some maps, as far as they are few.
fn generated(generators: &[Exchange]) -> BTreeSet<Exchange> {
    let mut found: BTreeSet<Exchange> = generators.iter().cloned().collect();
    let mut open: Vec<Exchange> = generators.to_vec();
    while let Some(own) = open.pop() {
        if found.len() > MOST_PRODUCTS {
            break;
        }
        for generator in generators {
            let product = generator.after(&own);
            if found.insert(product.clone()) {
                open.push(product);
            }
        }
    }
    found
}

/// Lists the maps to be tried: all signed permutations of few components, and otherwise changes of sign, and
/// the orders within variables reversed or shifted.
fn candidates(case: &Case) -> Vec<Exchange> {
    let model = &case.model;
    let dimension = model.dimension();
    let mut all = Vec::new();
    let mut both = |places: &[usize], signs: Vec<i8>| {
        let own = Exchange { places: places.to_vec(), signs, reverses: false };
        if own.map().is_involution() {
            all.push(Exchange { reverses: true, ..own.clone() });
        }
        all.push(own);
    };
    if dimension <= MOST_COMPONENTS {
        for places in permutations(dimension) {
            for mask in 0u32..1 << dimension {
                let sign = |k: usize| if mask >> k & 1 == 1 { -1 } else { 1 };
                both(&places, (0..dimension).map(sign).collect());
            }
        }
        return all;
    }
    let identity: Vec<usize> = (0..dimension).collect();
    if dimension <= MOST_OF_SIGNS {
        for mask in 1u32..1 << dimension {
            let sign = |k: usize| if mask >> k & 1 == 1 { -1 } else { 1 };
            both(&identity, (0..dimension).map(sign).collect());
        }
    } else if let Some(signs) = velocities_reversed(case) {
        both(&identity, signs);
    }
    let lengths: Vec<usize> = match model.state.iter().all(|own| own.len() == 1) {
        true => vec![dimension],
        false => model.state.iter().map(|own| own.len()).collect(),
    };
    if dimension > MOST_IN_ORDER || lengths.len() > MOST_SIGNS {
        return all;
    }
    for order in [Order::Same, Order::Reversed, Order::Shifted] {
        let (mut places, mut start) = (Vec::new(), 0);
        for length in &lengths {
            let place = |k: usize| match order {
                Order::Same => k,
                Order::Reversed => length - 1 - k,
                Order::Shifted => (k + 1) % length,
            };
            places.extend((0..*length).map(|k| start + place(k)));
            start += length;
        }
        for mask in 0u32..1 << lengths.len() {
            let sign = |k: usize| if mask >> k & 1 == 1 { -1 } else { 1 };
            let signs = lengths.iter().enumerate().flat_map(|(k, own)| vec![sign(k); *own]);
            both(&places, signs.collect());
        }
    }
    all
}

/// Signs of the components where all velocities of a Lagrangian system are reversed.
fn velocities_reversed(case: &Case) -> Option<Vec<i8>> {
    let System::Lagrangian(own) = &case.model.system else { return None };
    let signs = own.roles.iter().zip(&case.model.state).flat_map(|(role, variable)| {
        let is_velocity = matches!(role, VariableRole::Velocity);
        std::iter::repeat_n(if is_velocity { -1 } else { 1 }, variable.len())
    });
    let signs: Vec<i8> = signs.collect();
    (signs.len() == case.model.dimension()).then_some(signs)
}

/// The maps of a state that are tried, in words that go on with "no reversor was found among".
pub fn tried(case: &Case) -> &'static str {
    let model = &case.model;
    match &model.system {
        System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_) => {}
        _ => return "signed permutations of the axes",
    }
    match model.dimension() {
        _ if clock(model).is_some() => "changes of sign",
        0..=MOST_COMPONENTS => "signed permutations of the components",
        dimension if dimension <= MOST_OF_SIGNS => {
            "changes of sign, and components in the opposite order or shifted by one"
        }
        _ => {
            "changes of sign of whole variables, and components in the opposite order or shifted by one"
        }
    }
}

/// Order of the components of a variable in its image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Order {
    Same,
    Reversed,
    Shifted,
}

/// All orders of so many places.
fn permutations(count: usize) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = vec![Vec::new()];
    for next in 0..count {
        let with = |own: &Vec<usize>| {
            (0..=own.len())
                .map(|at| {
                    let mut longer = own.clone();
                    longer.insert(at, next);
                    longer
                })
                .collect::<Vec<_>>()
        };
        all = all.iter().flat_map(with).collect();
    }
    all
}

/// A map as a claim: its images by variable, and a name.
fn candidate(case: &Case, own: &Exchange) -> Option<MapCandidate> {
    let model = &case.model;
    if model.state.iter().any(|variable| matches!(variable.kind, Type::Matrix(..))) {
        return None;
    }
    let components = model.state_formulas().ok()?;
    let (mut images, mut changed, mut start) = (Vec::new(), Vec::new(), 0);
    for variable in &model.state {
        let places = start..start + variable.len();
        start += variable.len();
        if places.clone().all(|k| own.places[k] == k && own.signs[k] == 1) {
            continue;
        }
        let part = |k: usize| signed(components[own.places[k]].clone(), own.signs[k]);
        let parts: Vec<Formula> = places.map(part).collect();
        let image = match variable.kind {
            Type::Scalar => parts.into_iter().next()?,
            kind => kind.filled(&parts).ok()?,
        };
        changed.push(format!("{} → {image}", variable.name));
        images.push((variable.name.clone(), image));
    }
    let key = if own.reverses { Reversor::NAME } else { Symmetry::NAME };
    // On a level the dimension depends on the intersection with the fixed space.
    let is_known = own.reverses && model.level.is_empty();
    let fixed_set = is_known.then(|| FixedSet { dimension: Some(own.map().fixed_space(1)) });
    Some(MapCandidate { name: format!("{key} {}", changed.join(", ")), key, images, fixed_set })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<String> {
        let case = Case::parse(text, &[]).expect("a case");
        exchanges(&case, 1).into_iter().map(|own| own.name).collect()
    }

    #[test]
    fn exchanges_of_variables_are_found_without_their_products() {
        let state = "title = 'x'\n[state]\nx = '0.1..2'\ny = '0.1..2'\n[field]\n";
        let found = names(&format!("{state}\"x'\" = 'x*(1 − y)'\n\"y'\" = 'y*(x − 1)'\n"));
        assert_eq!(found, ["reversor x → y, y → x"]);
        let found = names(&format!("{state}\"x'\" = 'x*(1 − y)'\n\"y'\" = 'y*(2*x − 1)'\n"));
        assert!(found.is_empty(), "{found:?}");
        // Rock, paper and scissors: the shift is one of order 3, and an exchange turns time back.
        let cycle = "title = 'x'\n[state]\nx = 'vector(0.1..1)'\n[field]\n\
                     \"x'\" = '[x1*(x2 − x3), x2*(x3 − x1), x3*(x1 − x2)]'\n";
        let found = names(cycle);
        assert_eq!(found.len(), 2, "two generators: {found:?}");
        assert!(found[0].starts_with("reversor"), "{found:?}");
    }

    #[test]
    fn long_chains_are_turned_round() {
        let rates: Vec<String> = (1..=7)
            .map(|k| format!("\"u{k}'\" = 'u{k}*({} − {})'\n", neighbour(k + 1), neighbour(k - 1)))
            .collect();
        let ranges: String = (1..=7).map(|k| format!("u{k} = '0.1..1'\n")).collect();
        let found = names(&format!("title = 'x'\n[state]\n{ranges}[field]\n{}", rates.concat()));
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].starts_with("reversor u1 → −u1, u2 → −u2"), "{found:?}");
        assert!(found[1].starts_with("reversor u1 → u7, u2 → u6"), "{found:?}");
    }

    #[test]
    fn signs_of_more_than_six_scalars_are_changed() {
        let pairs = [("x", "u"), ("y", "v"), ("z", "w"), ("s", "a")];
        let ranges: String =
            pairs.iter().map(|(q, p)| format!("{q} = '0.1..1'\n{p} = '0.1..1'\n")).collect();
        let rates: String = pairs
            .iter()
            .map(|(q, p)| format!("\"{q}'\" = '{p}'\n\"{p}'\" = '−{q} + {q}^2 + x*y*z*s'\n"))
            .collect();
        let found = names(&format!("title = 'x'\n[state]\n{ranges}[field]\n{rates}"));
        assert_eq!(found, ["reversor u → −u, v → −v, w → −w, a → −a"]);
    }

    fn neighbour(k: usize) -> String {
        if (1..=7).contains(&k) { format!("u{k}") } else { "0".to_string() }
    }

    #[test]
    fn fixed_spaces_have_a_dimension_for_each_cycle() {
        let own = |places: &[usize], signs: &[i8]| {
            Exchange { places: places.to_vec(), signs: signs.to_vec(), reverses: true }
                .map()
                .fixed_space(1)
        };
        assert_eq!(own(&[1, 0, 2], &[1, 1, -1]), 1, "x = y, z = 0");
        assert_eq!(own(&[1, 0, 2], &[-1, -1, 1]), 2, "x = −y");
    }
}
