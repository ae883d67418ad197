//! Fixed points on the level, of a flow or a map, with the spectrum of the linear part.

use num_dual::Dual;

use super::components::Components;
use super::point::read_point;
use super::{Reader, Statement, difference};
use crate::formula::Formula;
use crate::mechanics::calculus::{Jet, characteristic_polynomial};
use crate::scalar::Scalar;

/// The field vanishes at a point; the linear part has these eigenvalues there, and otherwise 0.
#[derive(Clone, Debug)]
pub struct FixedPoint {
    point: Components,
    spectrum: Option<Vec<Formula>>,
}

impl Statement for FixedPoint {
    const NAME: &'static str = "fixed-point";
    const COMPANIONS: &'static [&'static str] = &["spectrum"];
    const WIDENS: bool = false;
    const OF_MAPS: bool = true;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let model = from.model();
        let point = read_point(from, Self::NAME)?.ok_or_else(|| from.missing(Self::NAME))?;
        let spectrum = from.list("spectrum")?;
        if let Some(eigenvalues) = &spectrum
            && eigenvalues.len() > model.dimension()
        {
            let message = format!("{} eigenvalues are too many", eigenvalues.len());
            let remedy = "list those that are not 0, each as often as it occurs";
            return Err(from.complaint("spectrum", message, remedy));
        }
        if spectrum.iter().flatten().any(|formula| model.has_antiderivative(formula)) {
            let message = "an eigenvalue has no ∫ in it: its constant is open".to_string();
            return Err(from.complaint("spectrum", message, "write the antiderivative out"));
        }
        Ok(Self { point, spectrum })
    }

    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, kept: &[bool]) -> Vec<T> {
        let state = self.point.at(&jet.phase);
        let at = jet.phase.with(&[], &state);
        let mut residual = match at.model().system.is_map() {
            true => difference(at.field().to_vec(), state.clone()),
            false => at.field().to_vec(),
        };
        residual.extend(jet.level_at(&at, kept));
        if let Some(spectrum) = &self.spectrum {
            let dimension = state.len();
            let columns: Vec<Vec<T>> = (0..dimension)
                .map(|j| at.lift_along(j).field().iter().map(|x: &Dual<T>| x.eps).collect())
                .collect();
            let eigenvalues = spectrum.iter().map(|f| at.scalar(f)).collect::<Vec<T>>();
            let claimed = coefficients(&eigenvalues, dimension);
            residual.extend(difference(characteristic_polynomial(&columns), claimed));
        }
        residual
    }
}

/// The coefficients of λ^(n-1), …, 1 in Π(λ - λ_i) λ^(n-k).
fn coefficients<T: Scalar>(eigenvalues: &[T], dimension: usize) -> Vec<T> {
    let mut polynomial = vec![T::zero(); dimension + 1];
    polynomial[0] = T::one();
    for eigenvalue in eigenvalues {
        for k in (1..=dimension).rev() {
            let above = polynomial[k - 1];
            polynomial[k] -= above * *eigenvalue;
        }
    }
    polynomial.split_off(1)
}
