//! Existence of a density by the criterion (γ, rot χ) = 0 and its forms on the sphere, for a flat
//! base, and for a body that may spin (C₁ = 0 and C₂ = 0).
//!
//! If it vanishes on the whole level, a density of the configuration exists, by quadrature, for
//! every potential and gyrostat. Otherwise no density of the configuration exists; and, when the
//! motion is free (ω' quadratic in ω), none that is positive and C¹ near ω = 0, since dividing
//! Liouville's equation by |ω| at ω → 0 leaves the same condition on ρ(γ,0).

use num_traits::One;

use super::rotation::{self, Among};
use super::{Assumption, Objection, Reader, ResidualContext, Statement, kinks, rest, volume};
use crate::graph::{Expr, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{Chart, Meaning, Model, NORMAL, Phase, Variable, VocabularyEntry};
use crate::proof::{Group, GroupOutcome, Prover};
use crate::scalar::Scalar;

/// The claim that a density exists that is positive and analytic near ω = 0.
#[derive(Clone, Debug)]
pub struct AnalyticDensity;

/// The claim that a density exists that is positive and C¹ at all states.
#[derive(Clone, Debug)]
pub struct SmoothDensity;

/// The claim that a density of the configuration alone, ρ(γ) or ρ(r₁,r₂), exists.
#[derive(Clone, Debug)]
pub struct PositionDensity;

/// Implements the parts common to both statements: reading, and the residual.
macro_rules! decided_by_criterion {
    () => {
        const WIDENS: bool = false;

        fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
            from.word(Self::NAME, "exists").map(|()| Self)
        }

        fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
            jet.phase.model().system.criterion(&jet.phase)
        }

        fn context(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> ResidualContext {
            let scale = jet.phase.model().system.criterion_scale(&jet.phase);
            ResidualContext { scale: Some(scale), ..ResidualContext::default() }
        }

        fn limit_of_proof(&self, model: &Model) -> Option<String> {
            volume::limit_of_proof(model)
        }

        fn assumptions(&self, model: &Model) -> Vec<(Assumption, String)> {
            [kinks::assumption(model), volume::assumption(model)].into_iter().flatten().collect()
        }
    };
}

impl Statement for AnalyticDensity {
    const NAME: &'static str = "analytic-density";
    decided_by_criterion!();

    fn objection(&self, model: &Model) -> Option<Objection> {
        objection(model, Self::NAME).or_else(|| objection_to_variables(model, Self::NAME))
    }

    fn limit_of_refutation(&self, model: &Model) -> Option<&'static str> {
        let is_excluded = model.system.is_free() || rest_without_density(model).is_some();
        (!is_excluded).then_some(
            "the criterion is not zero, which excludes every density of the configuration alone; with \
             a potential, a moment or a gyrostat one that depends on ω as well stays open",
        )
    }

    fn remark_on_refutation(&self, model: &Model) -> Option<String> {
        if model.system.is_free() {
            return None;
        }
        rest_without_density(model)
    }
}

impl Statement for SmoothDensity {
    const NAME: &'static str = "smooth-density";
    decided_by_criterion!();

    fn objection(&self, model: &Model) -> Option<Objection> {
        objection(model, Self::NAME).or_else(|| objection_to_variables(model, Self::NAME))
    }

    fn limit_of_refutation(&self, model: &Model) -> Option<&'static str> {
        let is_excluded = model.system.is_free() || place_without_density(model).is_some();
        (!is_excluded).then_some(
            "the criterion is not zero, which excludes every density of the configuration alone; no \
             rest or permanent rotation is known that excludes one that depends on ω as well",
        )
    }

    fn remark_on_refutation(&self, model: &Model) -> Option<String> {
        if model.system.is_free() {
            return None;
        }
        place_without_density(model)
    }
}

/// Describes a rest that excludes positive C¹ densities.
fn rest_without_density(model: &Model) -> Option<String> {
    if let Some(rest) = rest::without_density(model) {
        return Some(format!(
            "this excludes densities that are positive and C¹ near the equilibrium {rest}, where C₁ is not 0"
        ));
    }
    let rest = rotation::without_density(model, Among::Rests)?;
    Some(format!("this excludes densities that are positive and C¹ near the {rest}"))
}

/// Describes a rest or a permanent rotation that excludes positive C¹ densities.
fn place_without_density(model: &Model) -> Option<String> {
    rest_without_density(model).or_else(|| {
        let found = rotation::without_density(model, Among::Rotations)?;
        Some(format!("this excludes densities that are positive and C¹ near the {found}"))
    })
}

/// Returns the objection to variables that a case adds.
fn objection_to_variables(model: &Model, name: &str) -> Option<Objection> {
    (!model.extension.is_empty()).then(|| Objection {
        message: format!(
            "the criterion that decides `{name}` does not cover variables added by [state] or `frame`"
        ),
        remedy: "state it in a case without them, or state a density instead: density = \"ρ\"",
    })
}

impl Statement for PositionDensity {
    const NAME: &'static str = "position-density";
    decided_by_criterion!();

    fn objection(&self, model: &Model) -> Option<Objection> {
        objection(model, Self::NAME).or_else(|| {
            (!adds_no_divergence(model)).then(|| Objection {
                message: format!(
                    "`{}` is decided by a criterion that leaves out the divergence of the variables \
                     that [state] adds",
                    Self::NAME
                ),
                remedy: "state it in a case without them, or state a density instead: density = \"ρ\"",
            })
        })
    }
}

/// Returns the reason why the criterion does not apply to a model: it is derived for the divergence
/// of a body's motion, and presupposes that forces do not change it and that r is a point of a
/// surface.
fn objection(model: &Model, name: &str) -> Option<Objection> {
    let remedy = "state a density instead: density = \"ρ\"";
    let because = |reason: &str| Some(Objection { message: format!("`{name}` {reason}"), remedy });
    if !model.system.has_criterion() {
        return because(
            "is decided by a criterion that is known for rolling bodies and the flat base only",
        );
    }
    if let Some(moment) = model.system.moment() {
        let uses = model.vocabulary.uses(moment, &model.abbreviations);
        if let Some(entry) = uses.into_iter().find(|entry| !is_of_position(entry)) {
            let on = format!(
                "is decided by a criterion for moments of γ alone, and `moment` depends on `{}`",
                entry.name
            );
            return because(&on);
        }
    }
    if !is_surface(model) {
        return because(
            "is decided by a criterion for bodies, and r is the contact of none: ∂r is not symmetric \
             across γ",
        );
    }
    None
}

/// Whether the name is a function of γ and the parameters.
fn is_of_position(entry: &VocabularyEntry) -> bool {
    match entry.meaning {
        Meaning::Parameter(_) | Meaning::Abbreviation(_) => true,
        Meaning::State(index) => index == NORMAL,
        Meaning::Quantity(quantity) => quantity.is_of_position(),
    }
}

/// Whether ∂r/∂γ is proved to be symmetric across γ on |γ| = 1.
fn is_surface(model: &Model) -> bool {
    let mut draws = model.parameter_draws();
    draws.extend(Chart::Rolling.draws(&[], &[true, true]));
    let recorded = record(draws.len(), |inputs| {
        let (free, state) = model.make_parameters(inputs);
        let mut point = Chart::Rolling.point(model, &[true, true], &free, state);
        point.resize(model.dimension(), Expr::one());
        model.system.contact_twist(&Phase::new(model, &free, &point).configuration)
    });
    match recorded {
        Ok((_, None)) => true,
        Ok((graph, Some(twist))) => {
            let prover = Prover { sources: &[], extents: &[], seed: 1 };
            let outcomes = prover.prove(&graph, &[Group::of(vec![twist])]).unwrap_or_default();
            matches!(outcomes.as_slice(), [GroupOutcome::Zero(_)])
        }
        Err(_) => false,
    }
}

/// Whether the divergence of the variables that [state] adds is recorded as zero.
fn adds_no_divergence(model: &Model) -> bool {
    let added: usize = model.state[model.own_variables()..].iter().map(Variable::len).sum();
    let parameters = model.free_components();
    let recorded = record(parameters + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(parameters);
        let jet = DualPoint::new(Phase::new(model, parameters, state));
        let axes = jet.along_axes().iter().enumerate().skip(model.dimension() - added);
        axes.map(|(index, along)| along.field()[index].eps).sum::<Expr>()
    });
    recorded
        .is_ok_and(|(graph, sum)| graph.constant_value(sum).is_some_and(|value| value.is_zero()))
}
