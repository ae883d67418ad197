//! Search for densities ρ = P^(1/α), where P is a polynomial in the velocities with any smooth
//! coefficients.
//!
//! ρ is invariant when L_vP + α div v P = 0. These are the equations for integrals with an
//! additional term of order 0, so that they are of finite type as well, and the same Taylor
//! coefficients count their solutions. Without velocities they are the equations for a density of
//! the configuration. If there is one, ρ₀, all others are ρ₀ times a function of integrals, and no
//! further search is needed. Other coordinates multiply ρ by a function of the positions, which
//! changes no count.

use serde::Serialize;

use super::ask::{holds, judged_alone};
use super::counts::{free_motion, largest, locals};
use super::hypotheses::stated;
use super::integrals::{over_denominators, terms};
use super::jets::{DimensionCount, MotionAtPoint, VelocityPolynomials};
use super::local::Local;
use super::origin::TheoremOrigin;
use super::terms::{multiplied, numeric_exponent};
use super::{Effort, Excluded, Found, FoundKind, SearchError, SearchReport};
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::number::rational::Rational;
use liouville::order::StableOrder;

/// Values of α to try: P^(m/n) is Q^(1/n) with Q = P^m.
pub const WEIGHTS: [i64; 8] = [1, -1, 2, -2, 3, -3, 4, -4];

/// Largest degree of polynomials that are counted.
const MOST_DEGREE: u32 = 4;

/// Number of polynomials whose powers are densities.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct MultiplierReport {
    /// Degree in the velocities.
    pub degree: u32,
    /// Exponent α of P^(1/α); absent without velocities, where it is irrelevant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alpha: Option<i64>,
    /// Whether all degrees up to it are counted together.
    pub mixed: bool,
    /// Whether potential and gyrostat are left out.
    pub free: bool,
    /// Number of independent polynomials, an upper bound for generic parameters.
    pub dimension: usize,
    /// Number of unknowns of the linear system.
    pub unknowns: usize,
    /// Number of equations of the linear system.
    pub equations: usize,
}

/// Counts densities of this form, states which are excluded, and searches for the first that is
/// not; a remark gives the reason if there is no count.
pub fn multipliers(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    progress("densities that depend on the velocities");
    let mixed = case.model.system.energy_is_inhomogeneous();
    let free = free_motion(case).filter(|_| mixed);
    // The leading form of P belongs to the free motion: if that has none, nothing remains to be
    // counted.
    let motions = free.iter().map(|free| (free, false, true)).chain([(case, mixed, false)]);
    for (motion, mixed, is_free) in motions {
        let Some(locals) = locals(motion, report)? else { return Ok(()) };
        let counted = match series(&locals, mixed, is_free, effort) {
            Err(error) if error.is_of_count() => {
                report.remark(error.to_string());
                return Ok(());
            }
            counted => counted?,
        };
        let excess = counted.iter().find(|one| one.dimension > 0).copied();
        report.multipliers.extend(counted);
        match excess {
            None => {
                report.excluded.push(theorem(case, effort, is_free, mixed));
                return Ok(());
            }
            Some(MultiplierReport { alpha: Some(alpha), free: false, .. }) => {
                find(case, alpha, effort, report)?;
            }
            // Densities of the configuration are found as products of factors.
            Some(_) => {}
        }
    }
    Ok(())
}

/// Counts degree by degree, until a count is not 0.
fn series(
    locals: &[Local],
    mixed: bool,
    free: bool,
    effort: &Effort,
) -> Result<Vec<MultiplierReport>, SearchError> {
    let none = Rational::from(1);
    let mut motions: Vec<MotionAtPoint<'_>> = locals.iter().map(MotionAtPoint::new).collect();
    let mut counted = Vec::new();
    let configuration = (0, None, none);
    let others = (1..=effort.degree.min(MOST_DEGREE))
        .flat_map(|degree| WEIGHTS.map(|alpha| (degree, Some(alpha), Rational::from(alpha))));
    for (degree, alpha, weight) in std::iter::once(configuration).chain(others) {
        let asked = VelocityPolynomials { degree, mixed };
        let DimensionCount { dimension, size: (unknowns, equations) } =
            largest(&mut motions, asked, &weight, 0, effort)?;
        counted.push(MultiplierReport {
            degree,
            alpha,
            mixed,
            free,
            dimension,
            unknowns,
            equations,
        });
        if dimension > 0 {
            break;
        }
    }
    Ok(counted)
}

/// Searches for P among the terms that the system offers; proved densities go into the report.
fn find(
    case: &Case,
    alpha: i64,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let terms = terms(case, effort, report)?;
    let mut candidates = over_denominators(case, &terms, &Rational::from(alpha), effort, report)?;
    candidates.order_by_key(|formula| formula.text().chars().count());
    let power = numeric_exponent(Rational::new(alpha.signum(), alpha.abs()))?;
    for polynomial in candidates {
        let formula = multiplied(&[(polynomial, power.clone())])?;
        let judged = judged_alone(case, Claim::density(&formula), effort)?;
        if let Some(found) = judged.filter(holds) {
            report.found.push(Found::new(FoundKind::Density, &formula, None, found, &case.model));
            return Ok(());
        }
    }
    Ok(())
}

fn theorem(case: &Case, effort: &Effort, free: bool, mixed: bool) -> Excluded {
    let degree = effort.degree.min(MOST_DEGREE);
    let forces = match (free, mixed) {
        (true, _) => {
            " Leading forms belong to the free motion, so this holds for every gyrostat and every potential."
        }
        (false, true) => " The potential, the rotor and the moments are those of the case.",
        (false, false) => "",
    };
    let what = match degree {
        0 => "there is no invariant density of the configuration alone".to_string(),
        degree => format!(
            "there is no invariant density P^(1/α) with P polynomial in the velocities of degree at most \
             {degree} and α = ±1, ±2, ±3 or ±4, and none of the configuration alone"
        ),
    };
    Excluded {
        ansatz: format!(
            "densities P^(1/α), P polynomial in the velocities of degree up to {degree}, with any smooth \
             coefficients in the positions"
        ),
        dimension: 0,
        known: 0,
        error_log2: None,
        theorem: stated(&case.model, &format!("{what}.{forces}")),
        origin: TheoremOrigin::DensityCount { free },
        values: None,
    }
}
