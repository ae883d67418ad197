//! The bracket of a motion: that of `[hamiltonian]`, one of `[poisson]`, or the canonical one of the
//! momenta of a Lagrangian, each in variables y of its own.

use super::calculus::DualPoint;
use super::elimination::solve_by_minors;
use super::model::Model;
use super::system::System;
use super::variables::NewVariables;
use crate::scalar::Scalar;

/// A bracket of functions of the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionBracket {
    /// The bracket with this index of the case's variables, as many as those of the state.
    OfVariables(usize),
    /// The canonical bracket of coordinates and momenta of the Lagrangian.
    OfMomenta,
}

impl MotionBracket {
    /// Computes gradients with respect to y from those with respect to the state.
    pub fn covectors<T: Scalar>(
        self,
        jet: &DualPoint<'_, T>,
        gradients: Vec<Vec<T>>,
    ) -> Vec<Vec<T>> {
        let model = jet.phase.model();
        match (self, &model.system, model.variables.as_deref()) {
            (MotionBracket::OfMomenta, System::Lagrangian(lagrangian), _) => {
                lagrangian.in_momenta(&jet.phase.configuration, &gradients)
            }
            (MotionBracket::OfVariables(_), _, Some(variables)) => match places(model, variables) {
                Some(places) => {
                    let sorted =
                        |own: &Vec<T>| places.iter().map(|place| own[*place]).collect::<Vec<T>>();
                    gradients.iter().map(sorted).collect()
                }
                // The slopes come by columns ∂y/∂x_k, the rows of (∂y/∂x)ᵀ.
                None => solve_by_minors(&jet.slopes_of_variables(variables), &gradients),
            },
            _ => undefined(gradients),
        }
    }

    /// Computes the tensor P of the bracket in y, by rows.
    pub fn tensor<T: Scalar>(self, jet: &DualPoint<'_, T>) -> Vec<Vec<T>> {
        let model = jet.phase.model();
        match (self, model.variables.as_deref()) {
            (MotionBracket::OfVariables(index), Some(variables)) => {
                variables.tensor(index, &jet.in_variables(variables).phase)
            }
            _ => canonical(model.dimension()),
        }
    }

    /// Turns vectors in y into vectors of the state.
    pub fn vectors<T: Scalar>(self, jet: &DualPoint<'_, T>, vectors: Vec<Vec<T>>) -> Vec<Vec<T>> {
        let model = jet.phase.model();
        match (self, model.variables.as_deref()) {
            (MotionBracket::OfVariables(_), Some(variables)) => match places(model, variables) {
                Some(places) => {
                    let spread = |own: &Vec<T>| {
                        let mut all = vec![T::zero(); model.dimension()];
                        places.iter().zip(own).for_each(|(place, value)| all[*place] = *value);
                        all
                    };
                    vectors.iter().map(spread).collect()
                }
                None => {
                    let columns = jet.slopes_of_variables(variables);
                    let row = |k: usize| columns.iter().map(|column| column[k]).collect();
                    let rows: Vec<Vec<T>> = (0..columns.len()).map(row).collect();
                    solve_by_minors(&rows, &vectors)
                }
            },
            _ => undefined(vectors),
        }
    }
}

/// Places in the state of the variables, if each of them is a variable of the state.
pub fn places(model: &Model, variables: &NewVariables) -> Option<Vec<usize>> {
    let (mut starts, mut next) = (Vec::new(), 0);
    for variable in &model.state {
        starts.push((variable, next));
        next += variable.len();
    }
    let mut places = Vec::new();
    for image in &variables.images {
        let (variable, start) = starts.iter().find(|own| own.0.name == image.text().trim())?;
        places.extend(*start..start + variable.len());
    }
    let mut all = places.clone();
    all.sort_unstable();
    all.iter().copied().eq(0..model.dimension()).then_some(places)
}

/// The tensor of canonical variables, coordinates first.
fn canonical<T: Scalar>(dimension: usize) -> Vec<Vec<T>> {
    let half = dimension / 2;
    let entry = |i: usize, j: usize| match (i + half == j, j + half == i) {
        (true, _) => T::one(),
        (_, true) => -T::one(),
        _ => T::zero(),
    };
    (0..dimension).map(|i| (0..dimension).map(|j| entry(i, j)).collect()).collect()
}

/// Values for a bracket that the model does not have, which is found when a claim is read.
fn undefined<T: Scalar>(vectors: Vec<Vec<T>>) -> Vec<Vec<T>> {
    vectors.into_iter().map(|own| own.into_iter().map(|_| T::undefined()).collect()).collect()
}

/// Number of components of new variables.
pub fn size_of_variables(variables: &NewVariables) -> usize {
    variables.images.iter().map(|image| image.value_type().size()).sum()
}
