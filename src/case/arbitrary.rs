//! Arbitrary functions: polynomials with free coefficients, of a degree at which every jet that a
//! residual can contain occurs.
//!
//! Formulas contain derivatives of h, p and F up to the second (∂r, r', ω', γ'), of U up to the
//! first (ω'). A claim differentiates them once; `density-in-variables` twice, in tr(dφ⁻¹ d(L_vφ)):
//!
//! ```text
//! once                    h, p, F: order 3            U: order 2
//! twice                   h, p, F: order 4            U: order 3
//! at x and σ(x)           h, p, F: orders 3 and 2     U: orders 2 and 1
//! ```
//!
//! since dσ·v − v∘σ differentiates σ at x, and nothing at σ(x). Polynomials of degree k + l + 1 take
//! any jets of orders k and l at two points, those of degree k any jet of order k at one.

use super::error::Mistake;
use super::parameters::{Setting, coefficients};
use super::section::CaseTable;
use crate::claim::{Jets, STATEMENTS, jets};
use crate::mechanics::{Parameter, Potential, Range, Shape, Surface, SurfacePolynomial};

/// Source of the arbitrary functions of a case.
#[derive(Clone, Copy)]
pub struct Arbitrary<'a> {
    settings: &'a [Setting],
    /// Jets that the claims need.
    jets: Jets,
}

impl<'a> Arbitrary<'a> {
    /// Determines the jets that the claims of the file need.
    pub fn of(root: &CaseTable<'_>, settings: &'a [Setting]) -> Self {
        let claims = root.tables("claim");
        let is_made = |key: &&&'static str| claims.iter().any(|claim| claim.value(key).is_some());
        let needed = STATEMENTS.iter().filter(is_made).map(|key| jets(key)).max();
        Self { settings, jets: needed.unwrap_or_default() }
    }

    /// An arbitrary smooth surface.
    pub fn support(&self, parameters: &mut Vec<Parameter>) -> Result<Shape, Mistake> {
        let degree = self.degree([3, 4, 6]);
        let polynomial = SurfacePolynomial::on_sphere(degree, parameters.len());
        self.declare("h", &polynomial, parameters)?;
        Ok(Shape::Arbitrary(polynomial))
    }

    /// An arbitrary surface of revolution.
    pub fn profile(&self, parameters: &mut Vec<Parameter>) -> Result<Shape, Mistake> {
        let degree = self.degree([3, 4, 6]);
        let polynomial = SurfacePolynomial::on_interval(degree, parameters.len());
        self.declare("p", &polynomial, parameters)?;
        Ok(Shape::ArbitraryProfile(polynomial))
    }

    /// Arbitrary level surfaces F(r) = const.
    pub fn level(&self, parameters: &mut Vec<Parameter>) -> Result<Surface, Mistake> {
        let degree = self.degree([3, 4, 6]);
        let polynomial = SurfacePolynomial::in_space(degree, parameters.len());
        self.declare("F", &polynomial, parameters)?;
        Ok(Surface::Arbitrary(polynomial))
    }

    /// An arbitrary potential U(γ), or U(γ₃).
    pub fn potential(
        &self,
        axial: bool,
        parameters: &mut Vec<Parameter>,
    ) -> Result<Potential, Mistake> {
        let degree = self.degree([2, 3, 4]);
        let polynomial = match axial {
            true => SurfacePolynomial::on_interval(degree, parameters.len()),
            false => SurfacePolynomial::in_space(degree, parameters.len()),
        };
        self.declare("U", &polynomial, parameters)?;
        Ok(Potential::Arbitrary(polynomial))
    }

    /// Degree for functions that are differentiated once, twice, or at two points.
    fn degree(&self, degrees: [u32; 3]) -> u32 {
        match self.jets {
            Jets::Once => degrees[0],
            Jets::Twice => degrees[1],
            Jets::TwoPoints => degrees[2],
        }
    }

    /// Declares small coefficients: the surface is convex by what `Shape` and `Surface` add.
    fn declare(
        &self,
        prefix: &str,
        polynomial: &SurfacePolynomial,
        parameters: &mut Vec<Parameter>,
    ) -> Result<(), Mistake> {
        let size = if self.jets == Jets::TwoPoints { 10 } else { 5 };
        let small = Range::between((-1, size), (1, size));
        coefficients(prefix, &polynomial.exponents, &small, self.settings, parameters)
    }
}
