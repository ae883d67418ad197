//! Interface of the kinds of claims.

use super::assumption::Assumption;
use super::boxes::Boxes;
use super::{Condition, Novelty, Reader, ResidualContext, ValueShape};
use crate::formula::{Formula, Layout};
use crate::graph::Expr;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{Model, NewVariables};
use crate::proof::Group;
use crate::scalar::Scalar;

/// The derivatives of its formulas that a claim contains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Jets {
    /// First derivatives at a point.
    #[default]
    Once,
    /// Second derivatives at a point.
    Twice,
    /// First derivatives at a point, and values at its image in the same phase space.
    TwoPoints,
}

/// Statement of a claim on motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfMotions {
    /// Nothing: it is about values at states.
    Nothing,
    /// That a function is constant on each: nothing else, where every motion stays on its level.
    Constancy,
    /// Anything else, such as rates at the states of a level, where motions stay on it.
    Rates,
}

/// The reason why a claim does not apply to a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Objection {
    /// Description of the reason.
    pub message: String,
    /// Suggested alternative.
    pub remedy: &'static str,
}

/// Message for a refutation of an equation whose sides differ by the open constant of an ∫.
const OPEN_CONSTANT: &str = "it contains ∫, whose constant is open: the two sides differ for some constants. Compare their \
                             rates, or write the antiderivative out";

/// Returns what a nonzero difference of formulas does not exclude, if they contain an ∫.
pub(super) fn open_constant(model: &Model, formulas: &[&Formula]) -> Option<&'static str> {
    formulas.iter().any(|formula| model.has_antiderivative(formula)).then_some(OPEN_CONSTANT)
}

impl Objection {
    /// Makes the objection to an ∫ where its value matters.
    pub fn open_constant(what: &str) -> Self {
        let message = format!("{what} cannot contain ∫, whose constant is open");
        Self { message, remedy: "write the antiderivative out" }
    }
}

/// A kind of claim: its syntax, and the scalars that vanish where it holds.
pub trait Statement: Clone {
    /// Key in case files, and name in reports.
    const NAME: &'static str;
    /// Keys that may accompany the statement.
    const COMPANIONS: &'static [&'static str] = &[];
    /// Those of its keys whose values are more than a text, by which editors complete a file.
    const SHAPES: &'static [(&'static str, ValueShape)] = &[];
    /// Whether the claim is that the residual is *not* identically zero.
    const NEGATED: bool = false;
    /// Whether the claim is about a measure, of which states of lower dimension have none.
    const IS_OF_MEASURE: bool = false;
    /// Whether the claim may hold in wider places, and whether that is of interest.
    const WIDENS: bool = true;

    /// Derivatives of the claim's formulas that the residual contains.
    const JETS: Jets = Jets::Once;

    /// Whether the claim is about functions of new variables, and tested at the images of states.
    const AT_IMAGES: bool = false;

    /// Whether the claim is an inequality, which holding at the states tried does not make likely.
    const IS_INEQUALITY: bool = false;

    /// Statement of the claim on motions, which may leave a level.
    const OF_MOTIONS: OfMotions = OfMotions::Rates;

    /// Whether the claim can be about a map instead of a flow.
    const OF_MAPS: bool = false;

    /// Possible reason for a residual that is defined nowhere.
    const UNDEFINED: &'static str = "";

    /// Reads the statement.
    fn read<R: Reader>(from: &R) -> Result<Self, R::Error>;

    /// Computes the scalars that vanish where the claim holds; `kept` are the level equations
    /// imposed.
    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T>;

    /// Returns all formulas in the names of the case; the first is the one that is shown and
    /// mutated, if [`about`](Statement::about) can replace it.
    fn formulas(&self) -> Vec<&Formula> {
        Vec::new()
    }

    /// Returns the statement as text, if it is more than one formula.
    fn text(&self) -> Option<String> {
        None
    }

    /// Sets the whole statement with its particulars, where it can be set.
    fn layout(&self, _: Boxes<'_>) -> Option<Layout> {
        None
    }

    /// Makes the same claim about another formula, if it is about one.
    fn about(&self, _: Formula) -> Option<Self> {
        None
    }

    /// Computes values that vanish exactly when each ∫ in the names of another model is a function
    /// of its variable there.
    fn quadrature_defects_elsewhere(&self, _: &DualPoint<'_, Expr>) -> Vec<Expr> {
        Vec::new()
    }

    /// Computes the values as written of the formulas that are not among
    /// [`formulas`](Statement::formulas): in the names of another model, or of a point.
    fn written_elsewhere(&self, _: &DualPoint<'_, Expr>) -> Vec<Expr> {
        Vec::new()
    }

    /// Computes values, recorded literally, without which the claim has no meaning although all that
    /// is written has a value: at another point, for another parameter, or of a determinant's inverse.
    fn presence(&self, _: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Expr> {
        Vec::new()
    }

    /// Returns the formulas that the residual of a map takes at Φ(x) as well.
    fn at_images_of_maps(&self) -> Vec<&Formula> {
        Vec::new()
    }

    /// Computes auxiliary values, needed at a few states only.
    fn context(&self, _: &DualPoint<'_, Expr>, _: &[bool]) -> ResidualContext {
        ResidualContext::default()
    }

    /// Computes values that decide whether an integral is independent of those common to all cases;
    /// needed for claims that may hold.
    fn novelty(&self, _: &DualPoint<'_, Expr>, _: &[bool]) -> Novelty {
        Novelty::default()
    }

    /// Returns the formulas, of densities, that must not be 0 for the claim to have a meaning.
    fn divisors(&self) -> Vec<&Formula> {
        Vec::new()
    }

    /// Computes the gradients by which an integral or a density is new.
    fn slopes(&self, _: &DualPoint<'_, Expr>) -> Vec<Vec<Expr>> {
        Vec::new()
    }

    /// Returns the conditions that the claim presupposes.
    fn conditions(&self, _: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        Vec::new()
    }

    /// Computes the residual at given values of the new variables, with its requirement, if it
    /// depends on nothing else.
    fn residual_of_values(&self, _: &NewVariables, _: &DualPoint<'_, Expr>) -> Option<Group> {
        None
    }

    /// Returns the reason why the claim does not apply to this model, if any.
    fn objection(&self, _: &Model) -> Option<Objection> {
        None
    }

    /// Returns the parameters that the claim changes.
    fn changes(&self) -> Vec<usize> {
        Vec::new()
    }

    /// Describes what a nonzero residual excludes, where that is less than the whole claim.
    fn limit_of_refutation(&self, _: &Model) -> Option<&'static str> {
        None
    }

    /// Returns the reason why a residual that vanishes does not prove the claim, if so.
    fn limit_of_proof(&self, _: &Model) -> Option<String> {
        None
    }

    /// Returns the hypotheses of a proof that are not known to hold, each with a sentence.
    fn assumptions(&self, _: &Model) -> Vec<(Assumption, String)> {
        Vec::new()
    }

    /// Returns a remark for a claim that holds; `kept` are the level equations imposed.
    fn remark(&self, _: &Model, _: &[bool]) -> Option<String> {
        None
    }

    /// Describes parts of the statement that its text leaves out, such as a cofactor.
    fn particulars(&self) -> Option<String> {
        None
    }

    /// Returns a remark for a claim that is refuted.
    fn remark_on_refutation(&self, _: &Model) -> Option<String> {
        None
    }
}
