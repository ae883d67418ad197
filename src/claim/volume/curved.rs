//! Knowledge that D_T = (1 + kR₁)(1 + kR₂) vanishes nowhere, R₁ and R₂ being the radii of principal
//! curvature of the body.
//!
//! Intervals alone rarely show it: in D_T as recorded γ occurs dozens of times. Three kinds of bodies
//! are recognised, each by identities that are proved:
//!
//! 1. D_T is the same for all γ, as of a ball: its value at e₁.
//! 2. Bodies of revolution with profile p(z): R₁ = p - zp', R₂ = R₁ + (1 - z²)p''.
//! 3. Ellipsoids, h² = (γ,Qγ) with Q positive: 0 ≤ R ≤ λ_max(Q)/√λ_min(Q), since
//!    (u,Hess h u) = ((u,Qu) - (u,∇h)²)/h for u across γ, with h∇h = Qγ and Cauchy's inequality.

use num_dual::DualNum;
use num_traits::{One, Zero};

use super::{PIECES, unit};
use crate::graph::{Expr, record};
use crate::mechanics::{Draw, Model, NORMAL, Phase, RigidBody, Shape};
use crate::proof::{Extent, Group, Prover, is_seen_nowhere_zero, sign};
use crate::scalar::Scalar;

/// Recorded values of a body's surface.
#[derive(Default)]
struct Surface {
    /// Values that have no common zero in the ranges, if D_T is to vanish nowhere.
    factors: Vec<Expr>,
    /// Identities on the sphere on which the factors rest.
    identities: Vec<Expr>,
    /// Values that have to be positive.
    positive: Vec<Expr>,
}

/// Whether D_T is known to vanish nowhere on the sphere.
pub(super) fn is_nowhere_zero(model: &Model, body: &RigidBody, draws: &[Draw]) -> bool {
    let ways: [fn(&At<'_>) -> Option<Surface>; 3] = [constant, revolved, quadratic];
    ways.iter().any(|way| is_known(model, body, draws, *way))
}

/// Values of a body's surface at chosen normals.
struct At<'a> {
    model: &'a Model,
    body: &'a RigidBody,
    parameters: &'a [Expr],
    /// Two coordinates on the sphere, and one between -1 and 1.
    coordinates: [Expr; 3],
}

/// The point of contact at a normal.
struct Contact {
    support: Expr,
    r: [Expr; 3],
    slope: [[Expr; 3]; 3],
    k: Expr,
}

impl At<'_> {
    fn state(&self, gamma: [Expr; 3]) -> Vec<Expr> {
        let mut state = vec![Expr::one(); self.model.dimension()];
        state.splice(3 * NORMAL..3 * NORMAL + 3, gamma);
        state
    }

    fn contact(&self, gamma: [Expr; 3]) -> Option<Contact> {
        let state = self.state(gamma);
        let phase = Phase::new(self.model, self.parameters, &state);
        let at = &phase.configuration;
        let (r, slope) = self.body.shape.contact(at);
        Some(Contact {
            support: self.body.shape.support(at),
            r: r.into(),
            slope: std::array::from_fn(|i| std::array::from_fn(|j| slope[(i, j)])),
            k: self.body.curvature_at(at)?,
        })
    }

    fn determinant(&self, gamma: [Expr; 3]) -> Expr {
        let state = self.state(gamma);
        self.body.gamma_determinant(&Phase::new(self.model, self.parameters, &state).configuration)
    }

    /// The point of the sphere with stereographic coordinates u and v.
    fn anywhere(&self) -> [Expr; 3] {
        let [u, v, _] = self.coordinates;
        let square = u * u + v * v;
        [u * 2.0, v * 2.0, Expr::one() - square].map(|x| x / (square + 1.0))
    }
}

/// A unit vector along an axis.
fn axis(number: usize) -> [Expr; 3] {
    std::array::from_fn(|i| if i == number { Expr::one() } else { Expr::zero() })
}

fn is_known(
    model: &Model,
    body: &RigidBody,
    draws: &[Draw],
    way: fn(&At<'_>) -> Option<Surface>,
) -> bool {
    let mut extents: Vec<Extent> = draws.iter().map(Draw::extent).collect();
    extents.extend([Extent::ALL, Extent::ALL, unit()]);
    let recorded = record(extents.len(), |inputs| {
        let (parameters, coordinates) = model.make_parameters(inputs);
        let coordinates = coordinates.first_chunk().copied()?;
        way(&At { model, body, parameters: &parameters, coordinates })
    });
    let Ok((graph, Some(surface))) = recorded else { return false };
    let is_positive = |value: &Expr| {
        sign(&graph, &extents, &[], &[], *value)
            .is_some_and(|known| known.is_positive && !known.may_vanish)
    };
    let is_nonzero = |value: &Expr| is_seen_nowhere_zero(&graph, &extents, &[], &[*value], PIECES);
    if !surface.positive.iter().all(is_positive) || !surface.factors.iter().all(is_nonzero) {
        return false;
    }
    let prover = Prover { sources: &[], extents: &extents, seed: 1 };
    let groups: Vec<Group> = match surface.identities.is_empty() {
        true => Vec::new(),
        false => vec![Group::of(surface.identities)],
    };
    let outcomes = prover.prove(&graph, &groups);
    outcomes.is_ok_and(|outcomes| outcomes.iter().all(|outcome| outcome.is_zero()))
}

/// D_T is the same everywhere.
fn constant(at: &At<'_>) -> Option<Surface> {
    let Contact { slope, k, .. } = at.contact(axis(0))?;
    let entry = |i: usize, j: usize| match i == j {
        true => Expr::one() - k * slope[i][j],
        false => -(k * slope[i][j]),
    };
    let there = entry(1, 1) * entry(2, 2) - entry(1, 2) * entry(2, 1);
    let identities = vec![at.determinant(at.anywhere()) - there];
    Some(Surface { factors: vec![there], identities, ..Surface::default() })
}

/// The body is one of revolution.
fn revolved(at: &At<'_>) -> Option<Surface> {
    if !matches!(at.body.shape, Shape::Profile(_) | Shape::ArbitraryProfile(_)) {
        return None;
    }
    let state = at.state(axis(0));
    let phase = Phase::new(at.model, at.parameters, &state);
    let k = at.body.curvature_at(&phase.configuration)?;
    let z = at.coordinates[2];
    let [p, first, second] = at.body.shape.profile_jet(&phase.configuration, z);
    let across = p - z * first;
    let along = across + (Expr::one() - z * z) * second;
    let factors = [across, along].map(|radius| Expr::one() + k * radius).to_vec();
    Some(Surface { factors, ..Surface::default() })
}

/// The square of the support function is a quadratic form.
fn quadratic(at: &At<'_>) -> Option<Surface> {
    if !matches!(at.body.shape, Shape::Support(_) | Shape::SupportOnSphere(_)) {
        return None;
    }
    let axes = [axis(0), axis(1), axis(2)].map(|axis| at.contact(axis));
    let [Some(first), Some(second), Some(third)] = axes else { return None };
    let axes = [first, second, third];
    // Q = ½ Hess h² = ∇h ⊗ ∇h + h Hess h, with ∇h = -r, and (Hess h)γ = 0.
    let form = |i: usize, j: usize| match i == j {
        true => axes[i].support * axes[i].support,
        false => axes[i].r[i] * axes[i].r[j],
    };
    let gamma = at.anywhere();
    let support = at.contact(gamma)?.support;
    let mut defect = support * support;
    for i in 0..3 {
        for j in 0..3 {
            defect -= form(i, j) * gamma[i] * gamma[j];
        }
    }
    // Gershgorin's bounds of the eigenvalues.
    let others = |i: usize| (0..3).filter(|j| *j != i).map(|j| form(i, j).modulus()).sum::<Expr>();
    let most = [0, 1, 2].map(|i| form(i, i) + others(i));
    let least = [0, 1, 2].map(|i| form(i, i) - others(i));
    let k = axes[0].k;
    let mut positive = vec![axes[0].support];
    positive.extend(least);
    let largest = most.iter().flat_map(|most| least.map(|least| *most / least.sqrt()));
    positive.extend(largest.map(|radius| Expr::one() + k * radius));
    Some(Surface { positive, identities: vec![defect], ..Surface::default() })
}
