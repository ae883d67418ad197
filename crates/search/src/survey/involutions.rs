//! Symmetries and reversors among the signed permutations of the axes of the frame, and the
//! involutions about vectors of the case.
//!
//! With Q in O(3), Qᵀ = Q⁻¹, an axial vector is mapped to det Q Qω and a polar one to Qγ; a
//! reversor has −det Q Qω, and Q² = E. If Q preserves the body, its inertia, its rotor and the
//! potential, the map is a symmetry (BMB 2013, A.1.2-A.1.13); the prover decides each case.

use super::exchanges::exchanges;
use super::fixed_sets::{distinct_on_level, on_level};
use super::mirrors::Mirror;
use super::question::{FixedSet, SurveyQuestion, TestedClaim};
use super::sign_changes::sign_changes;
use super::signed_permutation::SignedPermutation;
use liouville::case::Case;
use liouville::claim::{Claim, Reversor, Statement, Symmetry};
use liouville::formula::{Formula, FormulaResult};
use liouville::mechanics::{System, Vocabulary};
use liouville::verdict::{JudgeError, Options};

/// A signed permutation: component i is `signs[i]` times component `places[i]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Turn {
    places: [usize; 3],
    signs: [i8; 3],
}

/// A candidate map: its name, its key in a claim, the images by state variable, the dimension of
/// its fixed set.
pub(super) struct MapCandidate {
    pub name: String,
    pub key: &'static str,
    pub images: Vec<(String, Formula)>,
    pub fixed_set: Option<FixedSet>,
}

/// Finds reversors and symmetries and proves them, reversors first; refuted candidates are omitted.
pub fn find(case: &Case, options: &Options) -> Result<Vec<TestedClaim>, JudgeError> {
    let candidates = distinct_on_level(case, options.seed, candidates(case, options.seed));
    let claim = |one: &MapCandidate| Claim::of(one.key, one.images.clone()).named(&one.name);
    let claims = candidates.iter().map(claim).collect();
    let question = SurveyQuestion::plain("maps of the frame", &[], claims);
    let mut found = question.ask(case, options)?.unwrap_or_default();
    for (tested, candidate) in found.iter_mut().zip(&candidates) {
        if !tested.holds() || candidate.key != Reversor::NAME {
            continue;
        }
        // Variables that the case adds, as a frame, are not counted.
        if !case.model.extension.is_empty() {
            continue;
        }
        tested.fixed_set = match (candidate.fixed_set, case.model.level.is_empty()) {
            (None, false) => on_level(case, candidate, options.seed),
            (known, _) => known,
        };
    }
    found.retain(TestedClaim::holds);
    Ok(found)
}

fn candidates(case: &Case, seed: u64) -> Vec<MapCandidate> {
    let turns = || Turn::all().into_iter();
    let variable = |name: &str| case.formula(name);
    let scope = &case.model.vocabulary;
    match &case.model.system {
        system @ (System::Rubber(_) | System::Spinning(_)) => {
            let spins = matches!(system, System::Spinning(_));
            let (Ok(omega), Ok(gamma)) = (variable("ω"), variable("γ")) else {
                return Vec::new();
            };
            let candidate = |map: &FrameMap, axial: i8| {
                let turned = map.image(scope, &omega, axial * map.determinant()).ok()?;
                Some(MapCandidate {
                    name: map.name(axial < 0),
                    key: key(axial),
                    images: vec![
                        ("ω".into(), turned),
                        ("γ".into(), map.image(scope, &gamma, 1).ok()?),
                    ],
                    // |γ| = 1, and (ω,γ) = 0 without spin, on the fixed spaces of both.
                    fixed_set: fixed(axial, map, |along, velocity| match map.determinant() {
                        _ if spins => along.checked_sub(1).map(|d| d + velocity),
                        1 => along.checked_sub(1).map(|d| d + velocity),
                        _ => along.checked_sub(1).map(|d| d + velocity - 1),
                    }),
                })
            };
            both(FrameMap::all(case), candidate)
        }
        System::Ball(ball) => {
            let is_level = ball.surface.is_level();
            let second = if is_level { "r" } else { "γ" };
            let (Ok(momentum), Ok(place)) = (variable("M"), variable(second)) else {
                return Vec::new();
            };
            both(FrameMap::all(case), |map, axial| {
                let turned = map.image(scope, &momentum, axial * map.determinant()).ok()?;
                Some(MapCandidate {
                    name: map.name(axial < 0),
                    key: key(axial),
                    images: vec![
                        ("M".into(), turned),
                        (second.into(), map.image(scope, &place, 1).ok()?),
                    ],
                    fixed_set: fixed(axial, map, |along, velocity| match is_level {
                        true => Some(along + velocity),
                        false => along.checked_sub(1).map(|d| d + velocity),
                    }),
                })
            })
        }
        System::FlatBase(_) => {
            let about_axis = turns().filter(|turn| turn.places[2] == 2 && turn.signs[2] == 1);
            both(about_axis.collect(), |turn: &Turn, axial| {
                let across = |name: &str, sign: i8| -> Option<Vec<(String, Formula)>> {
                    let own = |i: usize| variable(&format!("{name}{}", i + 1)).ok();
                    let image = |i: usize| Some(signed(own(turn.places[i])?, turn.signs[i] * sign));
                    (0..2).map(|i| Some((format!("{name}{}", i + 1), image(i)?))).collect()
                };
                let mut images = across("ω", axial * turn.determinant())?;
                images.extend(across("r", 1)?);
                // Both fixed spaces contain the axis in addition to vectors in the plane.
                let fixed_set = fixed(axial, turn, |along, velocity| {
                    let of_axis = usize::from(axial * turn.determinant() == 1);
                    Some(along - 1 + velocity - of_axis)
                });
                Some(MapCandidate {
                    name: turn.name(axial < 0),
                    key: key(axial),
                    images,
                    fixed_set,
                })
            })
        }
        System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_) => {
            let mut all = sign_changes(case);
            all.extend(exchanges(case, seed));
            all
        }
    }
}

fn key(axial: i8) -> &'static str {
    if axial < 0 { Reversor::NAME } else { Symmetry::NAME }
}

/// A formula, or its negative.
pub(super) fn signed(formula: Formula, sign: i8) -> Formula {
    if sign < 0 { -formula } else { formula }
}

/// Computes the dimension of the fixed set of a reversor from those of the fixed spaces of polar
/// and of axial vectors.
fn fixed(
    axial: i8,
    map: &impl Orthogonal,
    dimension: impl Fn(usize, usize) -> Option<usize>,
) -> Option<FixedSet> {
    (axial < 0).then(|| {
        let velocity = map.fixed_space(axial * map.determinant());
        FixedSet { dimension: dimension(map.fixed_space(1), velocity) }
    })
}

/// Lists reversors (axial −1) of all involutions, then symmetries (axial 1) except the identity.
fn both<M: Orthogonal>(
    maps: Vec<M>,
    candidate: impl Fn(&M, i8) -> Option<MapCandidate>,
) -> Vec<MapCandidate> {
    let involutions = maps.iter().filter(|map| map.is_involution());
    let mut all: Vec<MapCandidate> = involutions.filter_map(|map| candidate(map, -1)).collect();
    let others = maps.iter().filter(|map| !map.is_identity());
    all.extend(others.filter_map(|map| candidate(map, 1)));
    all
}

/// An orthogonal map Q, Qᵀ = Q⁻¹.
trait Orthogonal {
    fn determinant(&self) -> i8;
    fn is_identity(&self) -> bool;
    fn is_involution(&self) -> bool;
    /// Returns the dimension of {x : sign Qx = x}.
    fn fixed_space(&self, sign: i8) -> usize;
}

/// An orthogonal map of a body's frame.
enum FrameMap {
    Turn(Turn),
    Mirror(Mirror),
}

impl FrameMap {
    /// Lists the 48 signed permutations, and reflections about the vectors of the case.
    fn all(case: &Case) -> Vec<Self> {
        let turns = Turn::all().into_iter().map(Self::Turn);
        turns.chain(Mirror::all(case).into_iter().map(Self::Mirror)).collect()
    }

    fn name(&self, reverses: bool) -> String {
        match self {
            Self::Turn(turn) => turn.name(reverses),
            Self::Mirror(mirror) => mirror.name(reverses),
        }
    }

    /// sign·Q x as a formula, x a variable.
    fn image(&self, scope: &Vocabulary, x: &Formula, sign: i8) -> FormulaResult {
        match self {
            Self::Turn(turn) => turn.image(scope, x, sign),
            Self::Mirror(mirror) => mirror.image(x, sign),
        }
    }
}

impl Orthogonal for FrameMap {
    fn determinant(&self) -> i8 {
        match self {
            Self::Turn(turn) => turn.determinant(),
            Self::Mirror(mirror) => mirror.determinant(),
        }
    }

    fn is_identity(&self) -> bool {
        matches!(self, Self::Turn(turn) if turn.is_identity())
    }

    fn is_involution(&self) -> bool {
        match self {
            Self::Turn(turn) => turn.is_involution(),
            Self::Mirror(_) => true,
        }
    }

    fn fixed_space(&self, sign: i8) -> usize {
        match self {
            Self::Turn(turn) => turn.fixed_space(sign),
            Self::Mirror(mirror) => mirror.fixed_space(sign),
        }
    }
}

impl Turn {
    fn map(&self) -> SignedPermutation<'_> {
        SignedPermutation { places: &self.places, signs: &self.signs }
    }

    /// Lists all 48, those without exchanges first.
    fn all() -> Vec<Self> {
        let orders = [[0, 1, 2], [1, 0, 2], [2, 1, 0], [0, 2, 1], [1, 2, 0], [2, 0, 1]];
        let signs =
            (0..8).map(|mask: i32| [0, 1, 2].map(|k| if mask >> k & 1 == 1 { -1 } else { 1 }));
        let signs: Vec<[i8; 3]> = signs.collect();
        orders
            .into_iter()
            .flat_map(|places| signs.iter().map(move |signs| Self { places, signs: *signs }))
            .collect()
    }

    /// Writes the image of axis i, such as `−2`.
    fn axis(self, i: usize) -> String {
        let minus = if self.signs[i] < 0 { "−" } else { "" };
        format!("{minus}{}", self.places[i] + 1)
    }

    fn image(self, scope: &Vocabulary, x: &Formula, sign: i8) -> FormulaResult {
        let part = |i: usize| -> FormulaResult {
            Ok(signed(x.element(self.places[i] + 1, scope)?, self.signs[i] * sign))
        };
        let [a, b, c] = [part(0)?, part(1)?, part(2)?];
        Formula::vector(&[&a, &b, &c])
    }

    /// Returns the name in BMB 2013, A.1, if it has one.
    fn name(self, reverses: bool) -> String {
        let tilde = if reverses { "\u{303}" } else { "" };
        let minus = self.signs.iter().filter(|sign| **sign < 0).count();
        let odd_one = |sign: i8| self.signs.iter().position(|s| *s == sign).map_or(0, |k| k + 1);
        match (self.places, minus) {
            ([0, 1, 2], 0) => "R(0)".to_string(),
            ([0, 1, 2], 1) => format!("Σ{tilde}({})", odd_one(-1)),
            ([0, 1, 2], 2) => format!("Π{tilde}({})", odd_one(1)),
            ([0, 1, 2], _) => format!("Σ{tilde}(0)"),
            _ => {
                let parts = [0, 1, 2].map(|i| self.axis(i));
                let word = if reverses { Reversor::NAME } else { Symmetry::NAME };
                format!("{word} ({})", parts.join(" "))
            }
        }
    }
}

impl Orthogonal for Turn {
    fn determinant(&self) -> i8 {
        let exchanges = (0..3).flat_map(|i| (i + 1..3).map(move |j| (i, j)));
        let odd = exchanges.filter(|(i, j)| self.places[*i] > self.places[*j]).count() % 2 == 1;
        self.signs.iter().product::<i8>() * if odd { -1 } else { 1 }
    }

    fn is_identity(&self) -> bool {
        *self == Self { places: [0, 1, 2], signs: [1, 1, 1] }
    }

    fn is_involution(&self) -> bool {
        self.map().is_involution()
    }

    fn fixed_space(&self, sign: i8) -> usize {
        self.map().fixed_space(sign)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_as_many_as_in_the_octahedral_group() {
        let all = Turn::all();
        assert_eq!(all.len(), 48, "signed permutations");
        assert_eq!(all.iter().filter(|turn| turn.determinant() == 1).count(), 24, "rotations");
        assert_eq!(all.iter().filter(|turn| turn.is_involution()).count(), 20, "Q² = E");
    }

    #[test]
    fn fixed_spaces_are_those_of_the_paper() {
        let diagonal = |signs| Turn { places: [0, 1, 2], signs };
        assert_eq!(diagonal([1, -1, -1]).fixed_space(1), 1, "Π(1) keeps e₁");
        assert_eq!(diagonal([-1, 1, 1]).fixed_space(1), 2, "Σ(1) keeps a plane");
        let exchange = Turn { places: [1, 0, 2], signs: [1, 1, -1] };
        assert_eq!((exchange.fixed_space(1), exchange.fixed_space(-1)), (1, 2), "a half turn");
        assert_eq!(exchange.name(false), "symmetry (2 1 −3)", "named by what it does");
        assert_eq!(diagonal([-1, -1, -1]).name(true), "Σ\u{303}(0)", "named as in the appendix");
    }
}
