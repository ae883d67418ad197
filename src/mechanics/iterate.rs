//! Maps of phase space: images of states, derivatives, and factors of volume.

use super::calculus::DualPoint;
use super::elimination::{determinant, transversals};
use super::phase::Phase;
use crate::scalar::Scalar;

impl<'m, T: Scalar> DualPoint<'m, T> {
    /// Returns the point Φ(x).
    #[inline(never)]
    pub fn image(&self) -> Phase<'m, T> {
        self.phase.with(&[], self.phase.field())
    }

    /// Computes the columns of DΦ.
    #[inline(never)]
    pub fn derivative(&self) -> Vec<Vec<T>> {
        let along = self.along_axes().iter();
        along.map(|beside| beside.field().iter().map(|image| image.eps).collect()).collect()
    }

    /// Computes the factor of volumes: det DΦ, or on a level that of σ with dx = dF_1∧…∧dF_k∧σ.
    ///
    /// The latter is the determinant of DΦ along the level with n_j(x) ↦ n_j(Φ(x)) across it, where
    /// dF_i(n_j) = δ_ij: dx takes both times the value of σ on what is left.
    #[inline(never)]
    pub fn expansion(&self, kept: &[bool]) -> T {
        let mut columns = self.derivative();
        let gradients = self.level_gradients(kept);
        let there = DualPoint::new(self.image()).level_gradients(kept);
        let pairs = transversals(&gradients).into_iter().zip(transversals(&there));
        for ((across, across_there), gradient) in pairs.zip(&gradients) {
            let moved = self.phase.lift(&across);
            for (column, slope) in columns.iter_mut().zip(gradient) {
                let off = moved.field().iter().zip(&across_there).map(|(y, n)| y.eps - *n);
                column.iter_mut().zip(off).for_each(|(entry, off)| *entry -= off * *slope);
            }
        }
        determinant(&columns)
    }
}
