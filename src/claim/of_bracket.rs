//! Statements about brackets of functions of new variables, and the parts they share.

use num_dual::Dual;

use super::{Condition, Need, Reader, Statement, ValueShape, quadrature_defects};
use crate::formula::{Formula, Type};
use crate::graph::Expr;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{Model, NewVariables, Phase, Poisson};
use crate::proof::Group;
use crate::scalar::Scalar;

/// A statement about brackets at each value of the new variables, whatever the motion.
pub trait OfBracket: Clone {
    /// Key in case files, and name in reports.
    const NAME: &'static str;
    /// Keys that may accompany the statement.
    const COMPANIONS: &'static [&'static str] = &[CHOICE];
    /// Those of its keys whose values are more than a text.
    const SHAPES: &'static [(&'static str, ValueShape)] = &[];

    /// Reads the statement.
    fn read<R: Reader>(from: &R) -> Result<Self, R::Error>;

    /// Returns the statement as text, if it is more than one formula.
    fn text(&self) -> Option<String> {
        None
    }

    /// Computes the scalars that vanish where the statement holds, at a point of the new variables.
    fn at<T: Scalar>(&self, variables: &NewVariables, there: &DualPoint<'_, T>) -> Vec<T>;

    /// Returns the indices of the brackets.
    fn brackets(&self) -> Vec<usize>;

    /// Returns the functions of the new variables.
    fn functions(&self) -> Vec<&Formula> {
        Vec::new()
    }

    /// Returns the function of which the statement says nothing if it is constant.
    fn constant_if(&self) -> Option<&Formula> {
        None
    }
}

impl<S: OfBracket> Statement for S {
    const NAME: &'static str = <S as OfBracket>::NAME;
    const COMPANIONS: &'static [&'static str] = <S as OfBracket>::COMPANIONS;
    const SHAPES: &'static [(&'static str, ValueShape)] = <S as OfBracket>::SHAPES;
    const OF_MAPS: bool = true;
    const AT_IMAGES: bool = true;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        <S as OfBracket>::read(from)
    }

    fn text(&self) -> Option<String> {
        OfBracket::text(self)
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
        let variables = of(jet.phase.model());
        self.at(variables, jet.in_variables(variables))
    }

    fn residual_of_values(
        &self,
        variables: &NewVariables,
        there: &DualPoint<'_, Expr>,
    ) -> Option<Group> {
        let required =
            written(variables, &self.brackets(), self.functions().into_iter(), &there.phase);
        Some(Group { outputs: self.at(variables, there), required, ..Group::default() })
    }

    fn written_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        let variables = of(jet.phase.model());
        let there = &jet.in_variables(variables).phase;
        let mut values = images_as_written(variables, &jet.phase);
        values.extend(written(variables, &self.brackets(), self.functions().into_iter(), there));
        values
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        let mut conditions = vec![they_vary(jet, ON_A_PART, true)];
        conditions.extend(are_not_zero(jet, &self.brackets()));
        if let Some(function) = self.constant_if() {
            let there = jet.in_variables(of(jet.phase.model()));
            conditions.push(Condition::nonzero(slope(there, function), "the function is constant"));
        }
        conditions
    }

    fn quadrature_defects_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        defects(jet, &self.brackets(), self.functions().into_iter())
    }
}

/// Message on a bracket that is tested where the new variables obey a relation.
const ON_A_PART: &str = "the new variables obey a relation, and what is said of their bracket holds \
                         where they do: give as many as vary independently";

/// Returns the variables of the case, or the complaint that there are none.
pub(super) fn variables<'r, R: Reader>(
    from: &'r R,
    key: &'static str,
) -> Result<&'r NewVariables, R::Error> {
    from.model().variables.as_deref().ok_or_else(|| {
        let message =
            format!("`{key}` is a claim about a bracket or new variables, and the case has none");
        let remedy = "add [poisson] for a bracket, [variables] for new variables";
        from.complaint(key, message, remedy)
    })
}

/// Reads a scalar in the new variables.
pub(super) fn scalar_in<R: Reader>(from: &R, key: &'static str) -> Result<Formula, R::Error> {
    let names = &variables(from, key)?.model.vocabulary;
    from.formula_in(key, Some(Type::Scalar), names)?.ok_or_else(|| from.missing(key))
}

/// Key that chooses one of several brackets.
pub(super) const CHOICE: &str = "poisson";

/// Returns the index of the bracket that a claim is about, or the complaint that there is none.
pub(super) fn bracket_of<R: Reader>(from: &R, key: &'static str) -> Result<usize, R::Error> {
    let brackets = &variables(from, key)?.brackets;
    match (from.text(CHOICE)?, brackets.len()) {
        (_, 0) => {
            let message = format!("`{key}` needs a bracket");
            Err(from.complaint(key, message, "add [poisson], e.g. structure = \"e(3)\""))
        }
        (None, 1) => Ok(0),
        (None, _) => {
            let message = format!("the case has the brackets {}", names(brackets));
            let remedy = format!("choose one: poisson = \"{}\"", brackets[0].name);
            Err(from.complaint(key, message, &remedy))
        }
        (Some(name), _) => named_bracket(from, CHOICE, &name),
    }
}

/// Returns the index of the bracket of this name.
pub(super) fn named_bracket<R: Reader>(
    from: &R,
    key: &'static str,
    name: &str,
) -> Result<usize, R::Error> {
    let brackets = &variables(from, key)?.brackets;
    brackets.iter().position(|bracket| bracket.name == name.trim()).ok_or_else(|| {
        let message = format!("there is no bracket `{name}`");
        from.complaint(key, message, &format!("there is {}", names(brackets)))
    })
}

fn names(brackets: &[Poisson]) -> String {
    let names: Vec<String> = brackets.iter().map(|one| format!("`{}`", one.name)).collect();
    names.join(", ")
}

/// Returns the variables of a model; claims about them are refused if there are none.
pub(super) fn of(model: &Model) -> &NewVariables {
    match &model.variables {
        Some(variables) => variables,
        None => unreachable!("checked when the claim was read"),
    }
}

/// Computes ∂F/∂y.
pub(super) fn slope<T: Scalar>(there: &DualPoint<'_, T>, function: &Formula) -> Vec<T> {
    there.gradient(|at| at.scalar(function))
}

/// Computes P u.
pub(super) fn turned<T: Scalar>(tensor: &[Vec<T>], u: &[T]) -> Vec<T> {
    tensor.iter().map(|row| row.iter().zip(u).map(|(p, u)| *p * *u).sum()).collect()
}

/// Records functions of the new variables, and brackets, as written.
pub(super) fn written<'f>(
    variables: &'f NewVariables,
    brackets: &[usize],
    functions: impl Iterator<Item = &'f Formula>,
    there: &Phase<'_, Expr>,
) -> Vec<Expr> {
    let brackets = brackets.iter().map(|bracket| &variables.brackets[*bracket]);
    there.literal_values(functions.chain(brackets.flat_map(Poisson::given_blocks)))
}

/// Records the new variables as written.
pub(super) fn images_as_written(variables: &NewVariables, phase: &Phase<'_, Expr>) -> Vec<Expr> {
    phase.literal_values(&variables.images)
}

/// Computes values that vanish exactly when each ∫ in functions of the new variables, and in the
/// bracket, is a function of its variable.
pub(super) fn defects<'f>(
    jet: &DualPoint<'_, Expr>,
    brackets: &[usize],
    functions: impl Iterator<Item = &'f Formula>,
) -> Vec<Expr> {
    let variables = of(jet.phase.model());
    let there = jet.in_variables(variables);
    let of_one = |formula: &Formula| quadrature_defects(there, formula, &[]);
    let brackets = brackets.iter().map(|bracket| &variables.brackets[*bracket]);
    let blocks = brackets.flat_map(Poisson::given_blocks);
    functions.flat_map(of_one).chain(blocks.flat_map(of_one)).collect()
}

/// Requires that the new variables vary independently, so that statements about them hold for all
/// their values.
pub(super) fn they_vary(
    jet: &DualPoint<'_, Expr>,
    otherwise: &str,
    is_essential: bool,
) -> Condition {
    let images = of(jet.phase.model()).images.iter();
    let rows: Vec<Vec<Expr>> = images.flat_map(|image| jet.gradients(image)).collect();
    let need = Need::Rank { rank: rows.len(), rows, fixed: 0 };
    Condition { need, otherwise: otherwise.to_string(), is_essential }
}

/// Requires that brackets are not 0, in which all functions are in involution.
pub(super) fn are_not_zero(jet: &DualPoint<'_, Expr>, brackets: &[usize]) -> Vec<Condition> {
    let variables = of(jet.phase.model());
    let there = jet.in_variables(variables);
    let of_one = |bracket: &usize| {
        let entries = variables.tensor(*bracket, &there.phase).concat();
        Condition::nonzero(entries, "the bracket is 0")
    };
    brackets.iter().map(of_one).collect()
}

/// Computes the derivatives of a tensor: the entry l is ∂P/∂y_l.
pub(super) fn tensor_slopes<T: Scalar>(
    variables: &NewVariables,
    bracket: usize,
    there: &DualPoint<'_, T>,
) -> Vec<Vec<Vec<T>>> {
    let along = |moved: &Phase<'_, Dual<T>>| {
        let moved = variables.tensor(bracket, moved);
        moved.iter().map(|row| row.iter().map(|p| p.eps).collect()).collect()
    };
    there.along_axes().iter().map(along).collect()
}
