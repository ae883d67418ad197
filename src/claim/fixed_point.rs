//! Fixed points on the level, of a flow or a map, with the spectrum of the linear part.

use num_dual::Dual;

use super::clock::never_rests;
use super::components::Components;
use super::elsewhere::{inside, system_at};
use super::point::read_point;
use super::statement::Objection;
use super::{ComplexFormula, Reader, Statement, difference};
use crate::formula::{Formula, Type};
use crate::graph::Expr;
use crate::mechanics::Model;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::characteristic_polynomial;
use crate::scalar::Scalar;

/// The claim that the field vanishes at a point, and that its linear part there has given
/// eigenvalues, the others being 0, or a given characteristic polynomial.
#[derive(Clone, Debug)]
pub struct FixedPoint {
    point: Components,
    spectrum: Option<Vec<ComplexFormula>>,
    /// Coefficients of λ^(n-1), …, 1.
    polynomial: Option<Vec<Formula>>,
}

impl Statement for FixedPoint {
    const NAME: &'static str = "fixed-point";
    const COMPANIONS: &'static [&'static str] = &["spectrum", "characteristic-polynomial"];
    const WIDENS: bool = false;
    const OF_MAPS: bool = true;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let model = from.model();
        let point = read_point(from, Self::NAME)?.ok_or_else(|| from.missing(Self::NAME))?;
        let spectrum = from.complex_list("spectrum")?;
        let count = |(_, imaginary): &ComplexFormula| if imaginary.is_some() { 2 } else { 1 };
        let eigenvalues: usize = spectrum.iter().flatten().map(count).sum();
        // Where time is a variable nothing rests, which is the mistake to tell.
        let never_rests = |model: &Model| never_rests(model, Self::NAME).is_some();
        let has_rests = !from.complete_model().is_some_and(never_rests);
        if eigenvalues > model.dimension() && has_rests {
            let message = format!("{eigenvalues} eigenvalues are too many");
            let remedy = "list the nonzero eigenvalues, each with its multiplicity";
            return Err(from.complaint("spectrum", message, remedy));
        }
        let parts = spectrum.iter().flatten().flat_map(|(a, b)| [a].into_iter().chain(b));
        if parts.into_iter().any(|formula| model.has_antiderivative(formula)) {
            let message = "an eigenvalue cannot contain ∫, whose constant is open".to_string();
            return Err(from.complaint("spectrum", message, "write the antiderivative out"));
        }
        Ok(Self { point, spectrum, polynomial: read_polynomial(from, has_rests)? })
    }

    fn remark_on_refutation(&self, model: &Model) -> Option<String> {
        let has_spectrum = self.spectrum.is_some() || self.polynomial.is_some();
        (has_spectrum && !model.level.is_empty()).then(|| {
            "the linear part is that in all of phase space: its eigenvalues across the level belong \
             to the spectrum, as a does for z' = a*z on z = 0"
                .to_string()
        })
    }

    fn objection(&self, model: &Model) -> Option<Objection> {
        never_rests(model, Self::NAME)
    }

    fn written_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        let mut values = self.point.written(&jet.phase);
        let at = jet.phase.with(&[], &self.point.at(&jet.phase));
        let eigenvalues = self.spectrum.iter().flatten();
        let parts = eigenvalues.flat_map(|(real, imaginary)| [real].into_iter().chain(imaginary));
        values.extend(at.literal_values(parts.chain(self.polynomial.iter().flatten())));
        values
    }

    fn presence(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        let written = system_at(&jet.phase.with(&[], &self.point.at(&jet.phase)));
        match self.spectrum.is_some() || self.polynomial.is_some() {
            true => inside(written),
            false => written,
        }
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        let state = self.point.at(&jet.phase);
        let at = jet.phase.with(&[], &state);
        let mut residual = match at.model().system.is_map() {
            true => difference(at.field().to_vec(), state.clone()),
            false => at.field().to_vec(),
        };
        residual.extend(jet.level_at(&at, kept));
        if self.spectrum.is_none() && self.polynomial.is_none() {
            return residual;
        }
        let columns: Vec<Vec<T>> = (0..state.len())
            .map(|j| at.lift_along(j).field().iter().map(|x: &Dual<T>| x.eps).collect())
            .collect();
        let found = characteristic_polynomial(&columns);
        if let Some(spectrum) = &self.spectrum {
            let value = |(real, imaginary): &ComplexFormula| {
                (at.scalar(real), imaginary.as_ref().map(|part| at.scalar(part)))
            };
            let eigenvalues: Vec<(T, Option<T>)> = spectrum.iter().map(value).collect();
            let claimed = coefficients(&eigenvalues, state.len());
            residual.extend(difference(found.clone(), claimed));
        }
        if let Some(polynomial) = &self.polynomial {
            let claimed = polynomial.iter().map(|formula| at.scalar(formula)).collect();
            residual.extend(difference(found, claimed));
        }
        residual
    }
}

/// Reads the coefficients of a characteristic polynomial, if they are given; `is_counted`: there has to
/// be one for each dimension.
fn read_polynomial<R: Reader>(
    from: &R,
    is_counted: bool,
) -> Result<Option<Vec<Formula>>, R::Error> {
    let key = "characteristic-polynomial";
    let model = from.model();
    let Some(polynomial) = from.list(key)? else { return Ok(None) };
    let dimension = model.dimension();
    if polynomial.len() != dimension && is_counted {
        let message = format!(
            "{} coefficients are given, but λ^{dimension} + … needs {dimension}",
            polynomial.len()
        );
        let remedy = "list the coefficients of all lower powers, highest first, zeros included";
        return Err(from.complaint(key, message, remedy));
    }
    if let Some(other) = polynomial.iter().find(|formula| formula.value_type() != Type::Scalar) {
        let message = format!("a coefficient is a {}", other.value_type());
        return Err(from.complaint(key, message, "give scalars"));
    }
    if polynomial.iter().any(|formula| model.has_antiderivative(formula)) {
        let message = "a coefficient cannot contain ∫, whose constant is open".to_string();
        return Err(from.complaint(key, message, "write the antiderivative out"));
    }
    Ok(Some(polynomial))
}

/// Computes the coefficients of λ^(n-1), …, 1 in Π(λ - λ_i) Π((λ - a_i)² + b_i²) λ^(n-k).
fn coefficients<T: Scalar>(eigenvalues: &[(T, Option<T>)], dimension: usize) -> Vec<T> {
    let mut polynomial = vec![T::zero(); dimension + 1];
    polynomial[0] = T::one();
    for (real, imaginary) in eigenvalues {
        // times λ² - sλ + p, or λ - s
        let (sum, product) = match imaginary {
            None => (*real, T::zero()),
            Some(part) => (*real + *real, *real * *real + *part * *part),
        };
        for k in (1..=dimension).rev() {
            let above = polynomial[k - 1];
            polynomial[k] -= above * sum;
            if imaginary.is_some() && k > 1 {
                let higher = polynomial[k - 2];
                polynomial[k] += higher * product;
            }
        }
    }
    polynomial.split_off(1)
}
