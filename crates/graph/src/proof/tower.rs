//! Independence of the roots of a computation, each over those before it.
//!
//! A root of X is independent where X is not a square in the field that the roots before it
//! generate over F_p(i)(z). For radicands without roots, characters decide this: at a point z each
//! of them is a square in F_p or is not, which makes a vector over the field of two elements for
//! each; if these vectors, together with that of -1, are linearly independent, no product of the
//! radicands is a square up to sign. A vector that depends on others names the product that may be
//! a square. For radicands that contain roots, see [`Refusals`].
//!
//! docs/soundness.md, "Roots".

use rustc_hash::FxHashSet;

use crate::graph::{Expr, Graph, Step};
use crate::number::{BinaryOperation, UnaryFunction};

use super::characters::{Character, Characters, MOST_FIRST, Space};
use super::digest::SeedDigest;
use super::lower::Algebraic;
use super::refusals::Refusals;
use super::trial::{MOST_NESTED, Trial};

/// Status of the root of a base.
#[derive(Clone, Debug, PartialEq)]
pub enum RootStatus {
    /// Radicand known not to be a square in the field of the roots before it, modulo each of the
    /// primes.
    Independent,
    /// Radicand equal to 0 at all points.
    Zero,
    /// Radicand whose product with those of these bases seems to be a square, up to a number.
    Dependent(Vec<usize>),
    /// Radicand with a root as a factor.
    Split,
    /// Radicand that contains roots not known to be independent.
    Deferred,
    /// Radicand without a value at almost all points.
    Unreached,
}

/// Standings of all bases of an algebraic graph.
pub struct Tower {
    /// Standings by base.
    pub standings: Vec<RootStatus>,
    /// Signs of the independent roots, as bits.
    pub independent: u128,
    /// Number of independent roots whose radicand contains others.
    pub nested: u32,
}

impl Tower {
    /// Examines the bases of `algebraic`, which was lowered from `graph`.
    pub fn of(
        graph: &Graph,
        algebraic: &Algebraic<'_>,
        trial: &Trial<'_>,
        digest: SeedDigest,
    ) -> Self {
        let bases = &algebraic.bases;
        let mut tower =
            Self { standings: vec![RootStatus::Deferred; bases.len()], independent: 0, nested: 0 };
        tower.first_layer(algebraic, trial, digest);
        tower.nested_layers(graph, algebraic, trial, digest);
        tower
    }

    /// Whether a value contains independent roots only.
    pub fn is_clean(&self, algebraic: &Algebraic<'_>, value: Expr) -> bool {
        algebraic.mask(value) & !self.independent == 0
    }

    /// Whether a value is the square root of an independent base.
    pub fn is_independent_root(&self, algebraic: &Algebraic<'_>, value: Expr) -> bool {
        algebraic.bases.iter().zip(&self.standings).any(|(base, standing)| {
            *standing == RootStatus::Independent
                && base.links.first().is_some_and(|(link, _)| *link == value)
        })
    }

    fn admit(&mut self, algebraic: &Algebraic<'_>, base: usize) {
        for (_, sign) in &algebraic.bases[base].links {
            self.independent |= algebraic.bit(*sign);
        }
    }

    /// Examines radicands without roots.
    fn first_layer(&mut self, algebraic: &Algebraic<'_>, trial: &Trial<'_>, digest: SeedDigest) {
        let bases = algebraic.bases.iter().enumerate();
        let first: Vec<usize> = bases
            .filter(|(_, base)| algebraic.mask(base.radicand) == 0)
            .map(|(index, _)| index)
            .collect();
        if first.is_empty() || first.len() > MOST_FIRST {
            return;
        }
        let radicands: Vec<Expr> =
            first.iter().map(|index| algebraic.bases[*index].radicand).collect();
        let characters = Characters::of(algebraic, trial, &radicands, digest);
        let mut spaces: Vec<Space> =
            characters.counts.iter().map(|count| Space::of_minus_one(*count)).collect();
        for (own, index) in first.iter().enumerate() {
            let standing = match characters.of_radicand(own) {
                Character::Zero => RootStatus::Zero,
                Character::Unreached => RootStatus::Unreached,
                Character::Residues(residues) => {
                    let mut extended = spaces.clone();
                    let relations: Vec<Option<u128>> = extended
                        .iter_mut()
                        .zip(residues)
                        .map(|(space, vector)| space.insert(*vector, own))
                        .collect();
                    match relations.into_iter().flatten().next() {
                        None => {
                            spaces = extended;
                            RootStatus::Independent
                        }
                        Some(relation) => {
                            let among = (0..own).filter(|k| relation >> k & 1 == 1);
                            RootStatus::Dependent(among.map(|k| first[k]).collect())
                        }
                    }
                }
            };
            if standing == RootStatus::Independent {
                self.admit(algebraic, *index);
            }
            self.standings[*index] = standing;
        }
    }

    /// Examines radicands that contain roots, in their order.
    fn nested_layers(
        &mut self,
        graph: &Graph,
        algebraic: &Algebraic<'_>,
        trial: &Trial<'_>,
        digest: SeedDigest,
    ) {
        let is_nested = |index: &usize| algebraic.mask(algebraic.bases[*index].radicand) != 0;
        let mut open = Vec::new();
        // A root of a root is a factor; other nested roots are examined once all else is clean.
        for index in (0..algebraic.bases.len()).filter(is_nested) {
            let base = &algebraic.bases[index];
            if !self.may_become_clean(algebraic, base.radicand, &open) {
                continue;
            }
            let has_factor = base.arguments.iter().any(|place| has_root_as_factor(graph, *place));
            if has_factor && self.is_clean(algebraic, base.radicand) {
                self.standings[index] = RootStatus::Split;
            } else {
                open.push(index);
            }
        }
        open.truncate(MOST_NESTED as usize);
        if open.is_empty() {
            return;
        }
        let first: Vec<usize> = (0..self.standings.len())
            .filter(|index| self.standings[*index] == RootStatus::Independent)
            .collect();
        let refusals = Refusals::of(algebraic, trial, &first, &open, digest);
        for (own, index) in open.iter().enumerate() {
            if !self.is_clean(algebraic, algebraic.bases[*index].radicand) {
                continue;
            }
            self.standings[*index] = refusals.standing(own);
            if self.standings[*index] == RootStatus::Independent {
                self.admit(algebraic, *index);
                self.nested += 1;
            }
        }
    }

    /// Whether a value contains independent roots and open nested ones only.
    fn may_become_clean(&self, algebraic: &Algebraic<'_>, value: Expr, open: &[usize]) -> bool {
        let signs = open.iter().flat_map(|index| &algebraic.bases[*index].links);
        let open = signs.fold(0, |mask, (_, sign)| mask | algebraic.bit(*sign));
        algebraic.mask(value) & !(self.independent | open) == 0
    }
}

/// Whether the value at a place is a product with a root among its factors.
fn has_root_as_factor(graph: &Graph, place: usize) -> bool {
    let (mut open, mut seen) = (vec![place], FxHashSet::default());
    while let Some(place) = open.pop() {
        if !seen.insert(place) {
            continue;
        }
        match graph.step(place) {
            Step::Unary(UnaryFunction::Sqrt, _) => return true,
            Step::Power(a, exponent) => match exponent.to_integer() {
                None => return true,
                Some(_) => open.push(a),
            },
            Step::Unary(UnaryFunction::Neg | UnaryFunction::Recip, a) => open.push(a),
            Step::Binary(BinaryOperation::Mul, a, b) => open.extend([a, b]),
            _ => {}
        }
    }
    false
}
