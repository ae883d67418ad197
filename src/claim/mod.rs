//! Claims: scalars that must vanish identically on a level set.
//!
//! Each kind of claim is one file that defines its residual; sampling, the ladder, verdicts and
//! reports are written once for all of them.

pub mod absence;
mod assumption;
mod boxes;
mod bracket;
mod casimir;
mod clock;
mod commutator;
mod compatible;
mod components;
mod condition;
mod context;
mod criterion;
mod density;
mod density_in_variables;
mod divergence;
mod elsewhere;
mod entry;
mod expansion;
mod expect;
mod fixed_point;
mod form;
mod hamiltonian;
mod identity;
mod images;
mod independence;
mod integral;
mod involution;
mod jacobi_identity;
mod kinds;
mod kinks;
mod lax;
mod limit;
mod lyapunov;
pub mod motion;
mod no_density_near;
mod of_bracket;
mod place;
mod point;
mod quadrature;
mod reader;
mod rest;
mod rotation;
mod statement;
mod symmetry_field;
mod transformation;
mod value;
mod volume;

use boxes::Boxes;
pub(crate) use elsewhere::level_at;
use elsewhere::{inverse_at, written_at};

use crate::formula::{Formula, Layout};
use crate::graph::Expr;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{Model, NewVariables};
use crate::proof::Group;
use crate::scalar::Scalar;
use kinds::statements;

pub use assumption::Assumption;
pub use bracket::Bracket;
pub use casimir::Casimir;
pub use clock::clock;
pub use commutator::Commutator;
pub use compatible::Compatible;
pub use components::Components;
pub use condition::{Condition, Need};
pub use context::{Excess, Novelty, ResidualContext};
pub use criterion::{AnalyticDensity, PositionDensity, SmoothDensity};
pub use density::Density;
pub use density_in_variables::DensityInVariables;
pub use divergence::Divergence;
pub use entry::ClaimEntry;
pub use expect::Expect;
pub use fixed_point::FixedPoint;
pub use form::Form;
pub use hamiltonian::Hamiltonian;
pub use identity::{Identity, Rate, Relation};
pub use independence::{Independent, MOST_FUNCTIONS as MOST_COMPARED};
pub use integral::Integral;
pub use involution::Involution;
pub use jacobi_identity::JacobiIdentity;
pub use kinds::ValueShape;
pub use kinks::may_have_kinks;
pub use lax::Lax;
pub use limit::Limit;
pub use lyapunov::Lyapunov;
pub use no_density_near::NoDensityNear;
pub use place::{LevelSubset, PlaceName};
pub use quadrature::quadrature_defects;

pub use reader::{ComplexFormula, Reader};
pub use statement::{Jets, Objection, OfMotions, Statement};
pub use symmetry_field::SymmetryField;
pub use transformation::{Map, Reversor, Symmetry};
pub use value::{Claim, Locus};

/// Lists the kinds of claims; each is one [`Statement`], written in one file.
macro_rules! kinds {
    ($($kind:ident),* $(,)?) => {
        statements! {
            /// A claimed statement, by kind.
            ClaimKind,
            /// Keys of the statements that a claim can make.
            STATEMENTS,
            $($kind),*
        }

        /// Evaluates an expression for the statement of any kind.
        macro_rules! of_each {
            ($self:expr, $statement:ident => $result:expr) => {
                match $self { $(ClaimKind::$kind($statement) => $result,)* }
            };
        }

        /// Returns the derivatives that the statement of this key contains.
        pub fn jets(key: &str) -> Jets {
            match key {
                $(_ if key == $kind::NAME => $kind::JETS,)*
                _ => Jets::Once,
            }
        }

        impl ClaimKind {
            /// Whether the claim is that the residual is *not* identically zero.
            pub fn is_negated(&self) -> bool {
                match self { $(ClaimKind::$kind(_) => $kind::NEGATED,)* }
            }

            /// Whether the claim is about almost all states: one that a value does not vanish, or one
            /// about a measure.
            pub fn is_of_almost_all(&self) -> bool {
                match self { $(ClaimKind::$kind(_) => $kind::NEGATED || $kind::IS_OF_MEASURE,)* }
            }

            /// Whether the place of the claim is the image of one in new variables.
            pub fn is_at_images(&self) -> bool {
                match self { $(ClaimKind::$kind(_) => $kind::AT_IMAGES,)* }
            }

            /// Whether the claim is an inequality, which holding at the states tried does not make
            /// likely.
            pub fn is_inequality(&self) -> bool {
                match self { $(ClaimKind::$kind(_) => $kind::IS_INEQUALITY,)* }
            }

            /// Statement of the claim on motions.
            pub fn of_motions(&self) -> OfMotions {
                match self { $(ClaimKind::$kind(_) => $kind::OF_MOTIONS,)* }
            }

            /// Whether the claim can be about a map instead of a flow.
            fn is_of_maps(&self) -> bool {
                match self { $(ClaimKind::$kind(_) => $kind::OF_MAPS,)* }
            }

            /// Suggests a reason for a residual that is defined nowhere.
            pub fn hint_when_undefined(&self) -> &'static str {
                match self { $(ClaimKind::$kind(_) => $kind::UNDEFINED,)* }
            }

            /// Whether the claim may hold in wider places, and whether that is of interest.
            pub fn widens(&self) -> bool {
                match self { $(ClaimKind::$kind(_) => $kind::WIDENS,)* }
            }

            /// Makes the same claim about another formula, if it is about one.
            pub fn about(&self, formula: Formula) -> Option<Self> {
                match self {
                    $(ClaimKind::$kind(statement) => statement.about(formula).map(ClaimKind::$kind),)*
                }
            }
        }
    };
}

kinds! {
    Integral,
    Density,
    Divergence,
    AnalyticDensity,
    SmoothDensity,
    PositionDensity,
    Identity,
    Rate,
    Relation,
    Lax,
    SymmetryField,
    Commutator,
    Symmetry,
    Reversor,
    Map,
    Independent,
    FixedPoint,
    NoDensityNear,
    Lyapunov,
    Form,
    Limit,
    Hamiltonian,
    Casimir,
    Bracket,
    JacobiIdentity,
    Involution,
    Compatible,
    DensityInVariables,
}

impl ClaimKind {
    /// Returns the formula of the claim, if it has one.
    pub fn formula(&self) -> Option<&Formula> {
        self.formulas().into_iter().next()
    }

    /// Returns the statement as typed: the formula, or both sides.
    pub fn text(&self) -> Option<String> {
        let whole = of_each!(self, statement => statement.text());
        whole.or_else(|| self.formula().map(|formula| formula.text().to_string()))
    }

    /// Sets the whole statement; `None` of kinds that are not set.
    pub fn layout(&self, model: &Model) -> Option<Layout> {
        of_each!(self, statement => statement.layout(Boxes(model)))
    }

    /// Returns all formulas in the names of the case.
    pub fn formulas(&self) -> Vec<&Formula> {
        of_each!(self, statement => statement.formulas())
    }

    /// Returns the densities by which the claim divides.
    pub fn divisors(&self) -> Vec<&Formula> {
        of_each!(self, statement => statement.divisors())
    }

    /// Computes the gradients of F, or of ln ρ.
    pub fn slopes(&self, jet: &DualPoint<'_, Expr>) -> Vec<Vec<Expr>> {
        of_each!(self, statement => statement.slopes(jet))
    }

    /// Computes the scalars that vanish where the claim holds.
    #[inline(never)]
    pub fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        of_each!(self, statement => statement.residual(jet, kept))
    }

    /// Computes values as written, besides those of [`formulas`](Self::formulas), that exist wherever
    /// the claim is to hold.
    pub fn further_requirement(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        let inverses = |divisor| inverse_at(&jet.phase, divisor);
        // Where ρ is 0 on an open part, div(ρv) is 0, and v(ln ρ) is undefined.
        let mut values: Vec<Expr> = self.divisors().into_iter().flat_map(inverses).collect();
        values.extend(of_each!(self, statement => statement.written_elsewhere(jet)));
        // A claim about a map says nothing where F∘Φ has no value.
        let formulas = of_each!(self, statement => statement.at_images_of_maps());
        if jet.phase.model().system.is_map() && !formulas.is_empty() {
            let there = jet.image();
            values.extend(formulas.into_iter().flat_map(|formula| written_at(&there, formula)));
        }
        values.retain(|value| !value.is_always_defined());
        values
    }

    /// Computes values, recorded literally, without which the claim has no meaning.
    pub fn presence(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Vec<Expr> {
        of_each!(self, statement => statement.presence(jet, kept))
    }

    /// Computes auxiliary values, needed at a few states only.
    pub fn context(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> ResidualContext {
        let mut context = of_each!(self, statement => statement.context(jet, kept));
        context.quadrature_defects = self.quadrature_defects(jet, kept);
        context
    }

    /// Computes values that vanish exactly when the integrand of each ∫ is a function of its
    /// variable there: ∇f minus its projection on ∇x and the gradients of the level functions.
    pub fn quadrature_defects(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Vec<Expr> {
        let own = self.formulas().into_iter().flat_map(|f| quadrature_defects(jet, f, kept));
        let elsewhere = of_each!(self, statement => statement.quadrature_defects_elsewhere(jet));
        own.chain(elsewhere).collect()
    }

    /// Computes values that decide whether an integral is independent of those common to all cases.
    pub fn novelty(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Novelty {
        of_each!(self, statement => statement.novelty(jet, kept))
    }

    /// Returns the conditions that the claim presupposes.
    pub fn conditions(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Vec<Condition> {
        of_each!(self, statement => statement.conditions(jet, kept))
    }

    /// Computes the residual at given values of the new variables, with its requirement, if it
    /// depends on nothing else.
    pub fn residual_of_values(
        &self,
        variables: &NewVariables,
        there: &DualPoint<'_, Expr>,
    ) -> Option<Group> {
        of_each!(self, statement => statement.residual_of_values(variables, there))
    }

    /// Returns the reason why this kind of claim does not apply to `model`, if any.
    pub fn objection(&self, model: &Model) -> Option<Objection> {
        if model.system.is_map() && !self.is_of_maps() {
            let message =
                format!("`{}` is a claim about a flow, and the case is a map", self.name());
            let remedy = "of a map, claim integral, density, symmetry, reversor, fixed-point, \
                          no-density-near, lyapunov, form, invariant-relation, identity, independent, limit, \
                          bracket, casimir, jacobi-identity or compatible";
            return Some(Objection { message, remedy });
        }
        // Values at x and at Φ(x) are compared, and the constant of an ∫ is open.
        if model.system.is_map() && self.formulas().iter().any(|f| model.has_antiderivative(f)) {
            return Some(Objection::open_constant("a claim about a map"));
        }
        of_each!(self, statement => statement.objection(model))
    }

    /// Returns the parameters that the claim changes.
    pub fn changes(&self) -> Vec<usize> {
        of_each!(self, statement => statement.changes())
    }

    /// Describes what a nonzero residual excludes, where that is less than the whole claim.
    pub fn limit_of_refutation(&self, model: &Model) -> Option<&'static str> {
        of_each!(self, statement => statement.limit_of_refutation(model))
    }

    /// Returns the reason why a residual that vanishes does not prove the claim, if so.
    pub fn limit_of_proof(&self, model: &Model) -> Option<String> {
        of_each!(self, statement => statement.limit_of_proof(model))
    }

    /// Returns the hypotheses of a proof that are not known to hold, each with a sentence.
    pub fn assumptions(&self, model: &Model) -> Vec<(Assumption, String)> {
        of_each!(self, statement => statement.assumptions(model))
    }

    /// Returns a remark for a claim that holds; `kept` are the level equations imposed.
    pub fn remark(&self, model: &Model, kept: &[bool]) -> Option<String> {
        of_each!(self, statement => statement.remark(model, kept))
    }

    /// Describes parts of the statement that its text leaves out, such as a cofactor.
    pub fn particulars(&self) -> Option<String> {
        of_each!(self, statement => statement.particulars())
    }

    /// Returns a remark for a claim that is refuted.
    pub fn remark_on_refutation(&self, model: &Model) -> Option<String> {
        of_each!(self, statement => statement.remark_on_refutation(model))
    }
}

/// Computes a - b, component by component.
fn difference<T: Scalar>(a: Vec<T>, b: Vec<T>) -> Vec<T> {
    a.into_iter().zip(b).map(|(a, b)| a - b).collect()
}
