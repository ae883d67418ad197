//! Expressions recorded for a case before any state is drawn.

use std::ops::Range;

use num_traits::Zero;

use super::physics;
use super::run::Values;
use crate::case::{Expect, PlacedClaim};
use crate::claim::{
    Condition, LevelSubset, Novelty, OfMotions, ResidualContext, level_at, quadrature_defects,
};
use crate::formula::Formula;
use crate::graph::{Expr, literally};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::rejection;
use crate::mechanics::{LevelEquation, LevelFunction, Orientation, System};
use crate::number::Enclosing;

/// A claim with all expressions recorded for it.
pub struct RecordedClaim<'c> {
    pub claim: &'c PlacedClaim,
    pub residual: Vec<Expr>,
    /// Values of the claim's formulas as written, which exist where a state counts.
    pub requirement: Vec<Expr>,
    /// Values without which the claim has no meaning, where a state counts.
    pub presence: Vec<Expr>,
    pub context: ResidualContext,
    pub novelty: Novelty,
    pub conditions: Vec<Condition>,
    pub wider: Vec<Wider>,
}

/// A wider place than the claim's, with the values that vanish if the claim holds there too.
pub struct Wider {
    pub place: LevelSubset,
    pub residual: Vec<Expr>,
    pub defects: Vec<Expr>,
}

impl<'c> RecordedClaim<'c> {
    /// Records the residual of a claim, at its place and in wider ones, and its context.
    ///
    /// `open` are the open divisors of the equations of motion, which claims about motions need.
    pub fn new(claim: &'c PlacedClaim, jet: &DualPoint<'_, Expr>, open: &[Expr]) -> Self {
        let model = jet.phase.model();
        let names_rates = || claim.kind.formulas().into_iter().any(|own| model.has_rates(own));
        let is_of_motions = claim.kind.of_motions() != OfMotions::Nothing || names_rates();
        let open = if is_of_motions { open } else { &[] };
        // Rates as they are solved for have no value where an open divisor is 0, though motions may: what is written
        // with them is no requirement of such a claim, but has to have a value.
        let (with_rates, known): (Vec<&Formula>, Vec<&Formula>) = claim
            .kind
            .formulas()
            .into_iter()
            .partition(|own| !open.is_empty() && model.has_rates(own));
        let presence = claim.kind.presence(jet, &claim.place.kept).into_iter();
        let presence =
            presence.chain(open.iter().copied()).chain(jet.phase.literal_values(with_rates));
        let presence: Vec<Expr> = presence.filter(|value| !value.is_always_defined()).collect();
        // 0 where the value exists, and undefined elsewhere.
        let zeros: Vec<Expr> =
            presence.iter().map(|value| literally(|| *value * Expr::zero())).collect();
        let residual = |place: &LevelSubset| {
            let mut residual = claim.kind.residual(jet, &place.kept);
            residual.extend(&zeros);
            residual
        };
        let wider = match claim.kind.widens() && claim.expect != Expect::Fails {
            true => claim.place.wider(jet.phase.model()),
            false => Vec::new(),
        };
        Self {
            claim,
            residual: residual(&claim.place),
            presence,
            requirement: {
                let mut values = jet.phase.literal_values(known);
                values.extend(claim.kind.further_requirement(jet));
                values
            },
            context: claim.kind.context(jet, &claim.place.kept),
            novelty: match claim.expect {
                Expect::Fails => Novelty::default(),
                _ => claim.kind.novelty(jet, &claim.place.kept),
            },
            conditions: claim.kind.conditions(jet, &claim.place.kept),
            wider: wider
                .into_iter()
                .map(|place| Wider {
                    residual: residual(&place),
                    defects: claim.kind.quadrature_defects(jet, &place.kept),
                    place,
                })
                .collect(),
        }
    }
}

/// Expressions that are needed for every case, whatever it claims.
pub struct SharedTerms {
    pub field: Vec<Expr>,
    /// Formulas of the system as written: without their values there is no state.
    pub requirement: Vec<Expr>,
    /// Values that exist for the listed values for which the equations of motion have one.
    pub motion: Vec<Expr>,
    /// Inverses of what the equations of motion are divided by, where nothing is known of it.
    pub open_divisors: Vec<Expr>,
    /// Formulas of the level functions as written, by equation.
    level_requirement: Vec<Vec<Expr>>,
    /// Level functions, zero on the level.
    pub level: Vec<Expr>,
    /// Functions that are zero on the halves of the level which the file chooses.
    pub halves: Vec<Expr>,
    /// Rates of the level functions along the motion, or their values at the image of a map.
    pub level_rates: Vec<Expr>,
    /// Values of each level equation as written at the image under a map: where it has none the image is off the level.
    pub level_presence: Vec<Vec<Expr>>,
    pub physics: Vec<Expr>,
    /// P + Pᵀ for the bracket of Hamilton's equations, zero where it is skew.
    pub symmetric: Vec<Expr>,
    /// Formulas with an ∫ among the equations of motion and the new variables, each with values
    /// that vanish exactly when its ∫ are functions of their variables.
    pub quadratures: Vec<(String, Vec<Expr>)>,
    /// Gradients of the level functions, where they are the user's.
    pub slopes: Vec<Vec<Expr>>,
    /// For each level function of the user, its gradient minus the projection on those before it.
    pub dependence: Vec<Vec<Expr>>,
}

impl SharedTerms {
    /// Records these expressions.
    pub fn of(jet: &DualPoint<'_, Expr>) -> Self {
        let phase = &jet.phase;
        let image = phase.model().system.is_map().then(|| jet.image());
        let rate = |index: usize| match &image {
            Some(image) => image.level_function(&phase.model().level[index].function),
            None => {
                jet.lie_derivative(|at| at.level_function(&phase.model().level[index].function))
            }
        };
        let own = matches!(
            phase.model().system,
            System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_)
        );
        let gradients = jet.level_gradients(&vec![own; phase.model().level.len()]);
        Self {
            field: phase.field().to_vec(),
            requirement: phase.literal_values(phase.model().equations_of_motion()),
            motion: phase.existence_of_motion(),
            open_divisors: phase.open_divisors(),
            level_requirement: {
                let formula = |equation: &LevelEquation| match &equation.function {
                    LevelFunction::Formula(formula) => phase.literal_values([formula]),
                    _ => Vec::new(),
                };
                phase.model().level.iter().map(formula).collect()
            },
            level: phase.model().level.iter().map(|e| phase.level_function(&e.function)).collect(),
            halves: {
                let of = |own: &Orientation| phase.level_function(&own.equation.function);
                phase.model().orientations.iter().map(of).collect()
            },
            level_rates: (0..phase.model().level.len()).map(rate).collect(),
            level_presence: {
                let of = |index: usize| {
                    let kept: Vec<bool> =
                        (0..phase.model().level.len()).map(|own| own == index).collect();
                    let written = image.iter().flat_map(|image| level_at(image, &kept));
                    written.filter(|value| !value.is_always_defined()).collect()
                };
                (0..phase.model().level.len()).map(of).collect()
            },
            physics: physics::outputs(phase),
            symmetric: match &phase.model().system {
                System::Hamiltonian(hamiltonian) => hamiltonian.symmetric_part(phase),
                _ => Vec::new(),
            },
            quadratures: {
                let model = phase.model();
                let everywhere = vec![false; model.level.len()];
                let open = model.functions().into_iter().filter(|f| model.has_antiderivative(f));
                let with_defects = |formula: &Formula| {
                    (formula.text().to_string(), quadrature_defects(jet, formula, &everywhere))
                };
                open.map(with_defects).collect()
            },
            dependence: (0..gradients.len())
                .map(|k| rejection(&gradients[k], &gradients[..k]))
                .collect(),
            slopes: gradients,
        }
    }
}

impl SharedTerms {
    /// Returns the level functions of these equations, and their rates.
    pub fn level_at(&self, kept: &[bool]) -> (Vec<Expr>, Vec<Expr>) {
        let of = |all: &[Expr]| {
            let pairs = all.iter().zip(kept).filter(|(_, kept)| **kept);
            pairs.map(|(value, _)| *value).collect()
        };
        (of(&self.level), of(&self.level_rates))
    }

    /// Returns the values that exist at every state at which these equations of the level hold.
    pub fn required_at(&self, kept: &[bool]) -> Vec<Expr> {
        let level = self.level_requirement.iter().zip(kept).filter(|(_, kept)| **kept);
        let level = level.flat_map(|(values, _)| values);
        self.requirement.iter().chain(&self.motion).chain(level).copied().collect()
    }
}

/// The outputs of a tape for some claims.
pub struct OutputLayout {
    /// Values that exist at every state.
    pub common: Range<usize>,
    /// Outputs of each claim.
    pub spans: Vec<Span>,
}

impl OutputLayout {
    /// Outputs that are residuals, claim after claim.
    pub fn residuals(&self) -> impl Iterator<Item = usize> {
        self.spans.iter().flat_map(|span| span.residual.clone())
    }

    /// Whether each lane contains a state with all values that a claim requires.
    pub fn existing<D: Enclosing>(&self, values: &Values<D>, span: &Span) -> Vec<bool> {
        values.existing(&[self.common.clone(), span.requirement.clone()])
    }
}

/// Positions of a claim's outputs in a tape; outputs that are not needed have an empty range.
#[derive(Clone)]
pub struct Span {
    pub residual: Range<usize>,
    pub requirement: Range<usize>,
    pub scale: Range<usize>,
    pub value: Range<usize>,
    pub slope: Range<usize>,
    pub off_level: Range<usize>,
    pub off_general: Range<usize>,
    pub defects: Range<usize>,
}

impl Span {
    /// Appends a claim's outputs, with its context if requested.
    pub fn lay_out(item: &RecordedClaim<'_>, with_context: bool, outputs: &mut Vec<Expr>) -> Self {
        let mut extend = |some: &[Expr]| {
            let start = outputs.len();
            outputs.extend_from_slice(some);
            start..outputs.len()
        };
        let residual = extend(&item.residual);
        let (nothing, unknown) = (ResidualContext::default(), Novelty::default());
        let (context, novelty) = match with_context {
            true => (&item.context, &item.novelty),
            false => (&nothing, &unknown),
        };
        Self {
            residual,
            requirement: extend(&item.requirement),
            scale: extend(context.scale.as_slice()),
            value: extend(&context.value),
            slope: extend(novelty.slope.as_slice()),
            off_level: extend(&novelty.off_level),
            off_general: extend(&novelty.off_general),
            defects: extend(&context.quadrature_defects),
        }
    }
}
