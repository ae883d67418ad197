//! What every kind of claim has to say about itself.

use super::{Condition, Context, Novelty, Reader};
use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::calculus::Jet;
use crate::mechanics::{Model, Phase, Variables};
use crate::scalar::Scalar;

/// Which derivatives of the formulas that it is about a claim contains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Jets {
    /// The first, at a point.
    #[default]
    Once,
    /// The second, at a point.
    Twice,
    /// The first at a point, and values at its image in the same phase space.
    TwoPoints,
}

/// Why a claim cannot be made about a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Objection {
    /// What stands against it.
    pub message: String,
    /// What to do instead.
    pub remedy: &'static str,
}

impl Objection {
    /// What stands against an ∫ where its value matters.
    pub fn open_constant(what: &str) -> Self {
        let message = format!("{what} has no ∫ in it: its constant is open");
        Self { message, remedy: "write the antiderivative out" }
    }
}

/// A kind of claim: how it is read, and which scalars vanish where it holds.
pub trait Statement: Clone {
    /// Its key in case files, and its name in reports.
    const NAME: &'static str;
    /// The keys that may stand beside it.
    const COMPANIONS: &'static [&'static str] = &[];
    /// Is the claim that the residual is *not* identically zero?
    const NEGATED: bool = false;
    /// May the claim hold in wider places than its own, and is that worth knowing?
    const WIDENS: bool = true;

    /// Which derivatives of the formulas that it is about the residual contains.
    const JETS: Jets = Jets::Once;

    /// Is it about functions of new variables, and looked at where the states of a place have them?
    const AT_IMAGES: bool = false;

    /// Is it an inequality, which states that are looked at do not make likely?
    const IS_INEQUALITY: bool = false;

    /// Can it be claimed of a map in the place of a flow?
    const OF_MAPS: bool = false;

    /// What it may mean that the residual has no value anywhere.
    const UNDEFINED: &'static str = "";

    /// Reads it.
    fn read<R: Reader>(from: &R) -> Result<Self, R::Error>;

    /// The scalars that vanish where the claim holds; `kept` are the level equations imposed.
    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, kept: &[bool]) -> Vec<T>;

    /// All formulas in the names of the case; the first is the one that is shown and mutated, if
    /// [`about`](Statement::about) can replace it.
    fn formulas(&self) -> Vec<&Formula> {
        Vec::new()
    }

    /// What is stated, where one formula alone does not say it.
    fn text(&self) -> Option<String> {
        None
    }

    /// The same claim about another formula, if it is about one.
    fn about(&self, _: Formula) -> Option<Self> {
        None
    }

    /// What vanishes exactly when each ∫ in the names of another model is a function of its
    /// variable there.
    fn quadrature_defects_elsewhere(&self, _: &Jet<'_, Expr>) -> Vec<Expr> {
        Vec::new()
    }

    /// What is asked beside the residual, on a few states only.
    fn context(&self, _: &Jet<'_, Expr>, _: &[bool]) -> Context {
        Context::default()
    }

    /// Whether an integral is more than a function of what every case conserves: asked of claims
    /// that may hold.
    fn novelty(&self, _: &Jet<'_, Expr>, _: &[bool]) -> Novelty {
        Novelty::default()
    }

    /// The gradients by which an integral or a density is new.
    fn slopes(&self, _: &Jet<'_, Expr>) -> Vec<Vec<Expr>> {
        Vec::new()
    }

    /// What it takes for granted beside the residual.
    fn conditions(&self, _: &Jet<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        Vec::new()
    }

    /// The residual at given values of the new variables, where it depends on nothing else.
    fn residual_of_values(&self, _: &Variables, _: &Phase<'_, Expr>) -> Option<Vec<Expr>> {
        None
    }

    /// Why it cannot be claimed of this model, if it cannot.
    fn objection(&self, _: &Model) -> Option<Objection> {
        None
    }

    /// The parameters that the claim gives other values.
    fn changes(&self) -> Vec<usize> {
        Vec::new()
    }

    /// What a non-zero residual excludes, where that is less than the whole claim.
    fn limit_of_refutation(&self, _: &Model) -> Option<&'static str> {
        None
    }

    /// What to add to a claim that holds.
    fn remark(&self, _: &Model) -> Option<String> {
        None
    }
}
