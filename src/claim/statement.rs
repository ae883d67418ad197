//! What every kind of claim has to say about itself.

use super::{Context, Novelty, Reader};
use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::Model;
use crate::mechanics::calculus::Jet;
use crate::scalar::Scalar;

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

    /// Is it about functions of new variables, and looked at where the states of a place have them?
    const AT_IMAGES: bool = false;

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

    /// The same claim about another formula, if it is about one.
    fn about(&self, _: Formula) -> Option<Self> {
        None
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

    /// Why it cannot be claimed of this model, if it cannot.
    fn objection(&self, _: &Model) -> Option<String> {
        None
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
