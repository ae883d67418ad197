//! New variables y = φ(x) with a bracket, in which Hamiltonian forms are written.

use std::cell::OnceCell;

use num_dual::Dual;

use super::calculus::DualPoint;
use super::elimination::trace_of_quotient;
use super::model::{Model, TIME, Variable};
use super::phase::Phase;
use crate::formula::{Formula, Type};
use crate::scalar::Scalar;

/// New variables as functions of the state, and a bracket for them.
#[derive(Clone, Debug)]
pub struct NewVariables {
    /// Model of the new variables' names; its parameters are the case's.
    pub model: Model,
    /// One formula for each new variable, in the names of the case.
    pub images: Vec<Formula>,
    /// Brackets of them, each with its name.
    pub brackets: Vec<Poisson>,
}

/// A bracket of the new variables.
#[derive(Clone, Debug)]
pub struct Poisson {
    /// Name by which claims choose it.
    pub name: String,
    /// Blocks of the tensor, by pairs of variables; 0 where none is given.
    pub blocks: Vec<Vec<Option<BracketBlock>>>,
}

impl Poisson {
    /// Returns the blocks that are formulas.
    pub fn given_blocks(&self) -> impl Iterator<Item = &Formula> {
        self.blocks.iter().flatten().flatten().filter_map(BracketBlock::typed)
    }
}

/// A block of a Poisson tensor.
#[derive(Clone, Debug)]
pub enum BracketBlock {
    /// A given block.
    Given(Formula),
    /// The negative transpose of the block given for the opposite pair.
    Opposite(Formula),
    /// The unit matrix of a canonical pair.
    Unit,
    /// The negative unit matrix, for the opposite of a canonical pair.
    OppositeUnit,
}

impl BracketBlock {
    /// Returns the formula of a given block.
    pub(super) fn typed(&self) -> Option<&Formula> {
        match self {
            BracketBlock::Given(formula) => Some(formula),
            _ => None,
        }
    }
}

impl NewVariables {
    /// Evaluates φ(x), component by component.
    #[inline(never)]
    pub fn image<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        self.images.iter().flat_map(|image| phase.evaluate(image).components()).collect()
    }

    /// Makes the point φ(x), at which formulas in the new variables are evaluated.
    #[inline(never)]
    pub fn point<T: Scalar>(&self, phase: &Phase<'_, T>) -> Phase<'_, T> {
        phase.in_model(&self.model, &self.image(phase))
    }

    /// Computes L_vφ.
    #[inline(never)]
    pub fn rates<T: Scalar>(&self, jet: &DualPoint<'_, T>) -> Vec<T> {
        self.images.iter().flat_map(|image| jet.rates(image)).collect()
    }

    /// Computes P + Pᵀ within the blocks on the diagonal, which vanishes where P is a bracket; the
    /// other blocks are skew by construction.
    #[inline(never)]
    pub fn symmetric_part<T: Scalar>(&self, matrix: &[Vec<T>]) -> Vec<T> {
        symmetric_part(&self.model.state, matrix)
    }

    /// Returns the component that is time, where it has no bracket with any.
    pub fn clock(&self, bracket: usize) -> Option<usize> {
        let state = &self.model.state;
        let index = state.iter().position(|own| own.name == TIME && own.kind == Type::Scalar)?;
        let is_free = self.brackets[bracket].blocks[index].iter().all(Option::is_none);
        is_free.then(|| state[..index].iter().map(Variable::len).sum())
    }

    /// Returns the tensor P of a bracket at a point of the new variables, by rows.
    #[inline(never)]
    pub fn tensor<T: Scalar>(&self, bracket: usize, there: &Phase<'_, T>) -> Vec<Vec<T>> {
        tensor(&self.model.state, &self.brackets[bracket].blocks, there)
    }
}

/// The new variables about a point of phase space, made once for all claims about them.
pub(super) struct VariablesJet<'m, T> {
    point: OnceCell<Box<DualPoint<'m, T>>>,
    along_field: OnceCell<Phase<'m, Dual<T>>>,
    divergence: OnceCell<T>,
}

impl<T> Default for VariablesJet<'_, T> {
    fn default() -> Self {
        let (point, along_field) = (OnceCell::new(), OnceCell::new());
        Self { point, along_field, divergence: OnceCell::new() }
    }
}

impl<'m, T: Scalar> DualPoint<'m, T> {
    /// Returns the point φ(x) of new variables with its own lifts.
    #[inline(never)]
    pub fn in_variables(&self, variables: &'m NewVariables) -> &DualPoint<'m, T> {
        self.image.point.get_or_init(|| Box::new(DualPoint::new(variables.point(&self.phase))))
    }

    /// Returns the point φ(x) of new variables with L_vφ as its derivative part.
    #[inline(never)]
    pub fn in_variables_along_field(&self, variables: &'m NewVariables) -> &Phase<'m, Dual<T>> {
        self.image.along_field.get_or_init(|| variables.point(self.along_field()))
    }

    /// Computes dφ, by columns.
    #[inline(never)]
    pub fn slopes_of_variables(&self, variables: &NewVariables) -> Vec<Vec<T>> {
        let slope =
            |beside: &Phase<'_, Dual<T>>| variables.image(beside).iter().map(|y| y.eps).collect();
        self.along_axes().iter().map(slope).collect()
    }

    /// Computes tr(dφ⁻¹ d(L_vφ)), the divergence of the motion in new variables, as many as the old
    /// ones.
    #[inline(never)]
    pub fn divergence_in_variables(&self, variables: &NewVariables) -> T {
        *self.image.divergence.get_or_init(|| {
            let (mut columns, mut rates) = (Vec::new(), Vec::new());
            for beside in self.along_axes() {
                columns.push(variables.image(beside).iter().map(|y| y.eps).collect::<Vec<T>>());
                let further = variables.image(&beside.lift(beside.field()));
                rates.push(further.iter().map(|y| y.eps.eps).collect::<Vec<T>>());
            }
            trace_of_quotient(&columns, &rates)
        })
    }
}

/// Computes P + Pᵀ within the blocks on the diagonal.
#[inline(never)]
pub(super) fn symmetric_part<T: Scalar>(state: &[Variable], matrix: &[Vec<T>]) -> Vec<T> {
    let mut parts = Vec::new();
    let mut start = 0;
    for variable in state {
        let end = start + variable.len();
        let pairs = (start..end).flat_map(|i| (i..end).map(move |j| (i, j)));
        parts.extend(pairs.map(|(i, j)| matrix[i][j] + matrix[j][i]));
        start = end;
    }
    parts
}

/// Makes the tensor of some blocks at a point in their variables, by rows.
#[inline(never)]
pub(super) fn tensor<T: Scalar>(
    state: &[Variable],
    blocks: &[Vec<Option<BracketBlock>>],
    there: &Phase<'_, T>,
) -> Vec<Vec<T>> {
    let mut rows = Vec::new();
    for (variable, blocks) in state.iter().zip(blocks) {
        let start = rows.len();
        rows.resize(start + variable.len(), Vec::new());
        for (block, across) in blocks.iter().zip(state) {
            let unit = |value: T| -> Vec<T> {
                let places =
                    (0..variable.len()).flat_map(|i| (0..across.len()).map(move |j| (i, j)));
                places.map(|(i, j)| if i == j { value } else { T::zero() }).collect()
            };
            // Entry (i, j) of a block that is given for the opposite pair is at (j, i).
            let (values, strides) = match block {
                None => (vec![T::zero(); variable.len() * across.len()], (across.len(), 1)),
                Some(BracketBlock::Given(p)) => (there.evaluate(p).components(), (across.len(), 1)),
                Some(BracketBlock::Opposite(p)) => {
                    let values = there.evaluate(p).components().into_iter().map(|x| -x);
                    (values.collect(), (1, variable.len()))
                }
                Some(BracketBlock::Unit) => (unit(T::one()), (across.len(), 1)),
                Some(BracketBlock::OppositeUnit) => (unit(-T::one()), (across.len(), 1)),
            };
            for (i, row) in rows[start..].iter_mut().enumerate() {
                row.extend((0..across.len()).map(|j| values[i * strides.0 + j * strides.1]));
            }
        }
    }
    rows
}
