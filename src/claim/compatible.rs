//! Compatible brackets: every combination aP + bQ satisfies Jacobi's identity where P and Q do.

use super::Reader;
use super::ValueShape;
use super::of_bracket::{OfBracket, named_bracket, tensor_slopes};
use crate::mechanics::NewVariables;
use crate::mechanics::calculus::DualPoint;
use crate::scalar::Scalar;

/// The claim Σ_l (P_il ∂_lQ_jk + Q_il ∂_lP_jk + cyclic in i, j, k) = 0, P + Pᵀ = 0 and Q + Qᵀ = 0.
#[derive(Clone, Debug)]
pub struct Compatible {
    /// Indices of the two brackets.
    brackets: [usize; 2],
    text: String,
}

impl OfBracket for Compatible {
    const NAME: &'static str = "compatible";
    const COMPANIONS: &'static [&'static str] = &[];
    const SHAPES: &'static [(&'static str, ValueShape)] = &[(Self::NAME, ValueShape::List)];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let names = from.texts(Self::NAME)?.ok_or_else(|| from.missing(Self::NAME))?;
        let [first, second] = <[String; 2]>::try_from(names).map_err(|names| {
            let message = format!(
                "a claim of compatibility needs two brackets, and {} are given",
                names.len()
            );
            from.complaint(Self::NAME, message, "write compatible = [\"P\", \"Q\"]")
        })?;
        let text = format!("[{first}, {second}] = 0");
        let first = named_bracket(from, Self::NAME, &first)?;
        let second = named_bracket(from, Self::NAME, &second)?;
        Ok(Self { brackets: [first, second], text })
    }

    fn text(&self) -> Option<String> {
        Some(self.text.clone())
    }

    fn at<T: Scalar>(&self, variables: &NewVariables, there: &DualPoint<'_, T>) -> Vec<T> {
        let tensors = self.brackets.map(|bracket| variables.tensor(bracket, &there.phase));
        let slopes = self.brackets.map(|bracket| tensor_slopes(variables, bracket, there));
        let n = there.phase.model().dimension();
        let term = |i: usize, j: usize, k: usize| -> T {
            let along = |l: usize| {
                tensors[0][i][l] * slopes[1][l][j][k] + tensors[1][i][l] * slopes[0][l][j][k]
            };
            (0..n).map(along).sum()
        };
        let mut residual: Vec<T> =
            tensors.iter().flat_map(|tensor| variables.symmetric_part(tensor)).collect();
        for i in 0..n {
            for j in i + 1..n {
                residual.extend((j + 1..n).map(|k| term(i, j, k) + term(j, k, i) + term(k, i, j)));
            }
        }
        residual
    }

    fn brackets(&self) -> Vec<usize> {
        self.brackets.to_vec()
    }
}
