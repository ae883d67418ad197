//! Jacobi's identity of a bracket.

use super::Reader;
use super::of_bracket::{OfBracket, bracket_of, tensor_slopes};
use crate::mechanics::NewVariables;
use crate::mechanics::calculus::DualPoint;
use crate::scalar::Scalar;

/// The claim Σ_l (P_il ∂_lP_jk + P_jl ∂_lP_ki + P_kl ∂_lP_ij) = 0 and P + Pᵀ = 0.
#[derive(Clone, Debug)]
pub struct JacobiIdentity {
    /// Index of the bracket.
    bracket: usize,
}

impl OfBracket for JacobiIdentity {
    const NAME: &'static str = "jacobi-identity";

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let bracket = bracket_of(from, Self::NAME)?;
        from.word(Self::NAME, "holds").map(|()| Self { bracket })
    }

    fn at<T: Scalar>(&self, variables: &NewVariables, there: &DualPoint<'_, T>) -> Vec<T> {
        let tensor = variables.tensor(self.bracket, &there.phase);
        let slopes = tensor_slopes(variables, self.bracket, there);
        let mut residual = variables.symmetric_part(&tensor);
        residual.extend(jacobi_defects(&tensor, &slopes));
        residual
    }

    fn brackets(&self) -> Vec<usize> {
        vec![self.bracket]
    }
}

/// Computes Σ_l (P_il ∂_lP_jk + P_jl ∂_lP_ki + P_kl ∂_lP_ij) for i < j < k; the entry l of the slopes is
/// ∂P/∂y_l.
pub(super) fn jacobi_defects<T: Scalar>(tensor: &[Vec<T>], slopes: &[Vec<Vec<T>>]) -> Vec<T> {
    let n = tensor.len();
    let term = |i: usize, j: usize, k: usize| -> T {
        (0..n).map(|l| tensor[i][l] * slopes[l][j][k]).sum()
    };
    let mut defects = Vec::new();
    for i in 0..n {
        for j in i + 1..n {
            defects.extend((j + 1..n).map(|k| term(i, j, k) + term(j, k, i) + term(k, i, j)));
        }
    }
    defects
}
