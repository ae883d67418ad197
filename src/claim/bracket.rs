//! Brackets of functions of the new variables: {F,G} = K in the bracket of `[poisson]`.

use super::of_bracket::{CHOICE, OfBracket, bracket_of, turned, variables};
use super::{Reader, ValueShape, difference};
use crate::formula::{Formula, Type};
use crate::mechanics::NewVariables;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::dot;
use crate::scalar::Scalar;

/// The claim (∂F/∂y, P ∂G/∂y) = K and P + Pᵀ = 0; for vectors, for every pair of components.
#[derive(Clone, Debug)]
pub struct Bracket {
    first: Formula,
    second: Formula,
    /// Value K, 0 if `None`.
    value: Option<Formula>,
    /// Index of the bracket.
    bracket: usize,
    /// Name of the bracket, if the claim gives it.
    named: Option<String>,
}

/// Returns the type of {F,G}, if F and G are scalars or vectors.
fn kind_of_bracket(first: Type, second: Type) -> Option<Type> {
    match (first, second) {
        (Type::Scalar, other @ (Type::Scalar | Type::Vector(_)))
        | (other @ Type::Vector(_), Type::Scalar) => Some(other),
        (Type::Vector(rows), Type::Vector(columns)) => Some(Type::Matrix(rows, columns)),
        _ => None,
    }
}

/// Computes the gradients of the components of F with respect to the new variables.
fn slopes<T: Scalar>(there: &DualPoint<'_, T>, function: &Formula) -> Vec<Vec<T>> {
    let columns: Vec<Vec<T>> = there
        .along_axes()
        .iter()
        .map(|moved| moved.evaluate(function).components())
        .map(|moved| moved.into_iter().map(|x| x.eps).collect())
        .collect();
    let count = function.value_type().size();
    (0..count).map(|k| columns.iter().map(|column| column[k]).collect()).collect()
}

impl OfBracket for Bracket {
    const NAME: &'static str = "bracket";
    const COMPANIONS: &'static [&'static str] = &["equals", CHOICE];
    const SHAPES: &'static [(&'static str, ValueShape)] = &[(Self::NAME, ValueShape::List)];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let bracket = bracket_of(from, Self::NAME)?;
        let names = &variables(from, Self::NAME)?.model.vocabulary;
        let given = from.list_in(Self::NAME, names)?.ok_or_else(|| from.missing(Self::NAME))?;
        let [first, second]: [Formula; 2] = given.try_into().map_err(|given: Vec<Formula>| {
            let message = format!("a bracket needs two functions, and {} are given", given.len());
            from.complaint(Self::NAME, message, "write bracket = [\"F\", \"G\"]")
        })?;
        let kinds = (first.value_type(), second.value_type());
        let Some(kind) = kind_of_bracket(kinds.0, kinds.1) else {
            let message = format!("this is the bracket of a {} and a {}", kinds.0, kinds.1);
            let remedy = "give scalars or vectors, e.g. the components of a matrix";
            return Err(from.complaint(Self::NAME, message, remedy));
        };
        let value = from.formula_in("equals", Some(kind), names)?;
        Ok(Self { first, second, value, bracket, named: from.text(CHOICE)? })
    }

    fn text(&self) -> Option<String> {
        let value = self.value.as_ref().map_or("0", |value| value.text().trim());
        let [first, second] = [&self.first, &self.second].map(|f| f.text().trim());
        let of = self.named.as_ref().map(|name| format!(" of {name}")).unwrap_or_default();
        Some(format!("{{{first}, {second}}}{of} = {value}"))
    }

    fn at<T: Scalar>(&self, variables: &NewVariables, there: &DualPoint<'_, T>) -> Vec<T> {
        let tensor = variables.tensor(self.bracket, &there.phase);
        let flows: Vec<Vec<T>> =
            slopes(there, &self.second).iter().map(|slope| turned(&tensor, slope)).collect();
        let found: Vec<T> = slopes(there, &self.first)
            .iter()
            .flat_map(|slope| flows.iter().map(|flow| dot(slope, flow)))
            .collect();
        let mut residual = match &self.value {
            Some(value) => difference(found, there.phase.evaluate(value).components()),
            None => found,
        };
        residual.extend(variables.symmetric_part(&tensor));
        residual
    }

    fn brackets(&self) -> Vec<usize> {
        vec![self.bracket]
    }

    fn functions(&self) -> Vec<&Formula> {
        [&self.first, &self.second].into_iter().chain(&self.value).collect()
    }
}
