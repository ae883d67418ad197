//! Polynomial conditions on the parameters under which a claim that fails in general holds.
//!
//! ```text
//! line      points on a random line of parameters where the residual vanishes for all states
//! variety   the equations of least degree at the points found on many lines
//! small     conditions of codimension two, by random sampling in small fields
//! velocities  values of single parameters for which there are more integrals polynomial in the
//!           velocities
//! minors    such values, by minors of the equations for Taylor coefficients
//! relation  numbers that such values are, or their relations to one other parameter
//! several   equations between the parameters of a field for which it has more polynomial integrals
//! by_values  such equations for each of listed values
//! values    values of its only parameter
//! isolated  values of several parameters that belong to no condition of codimension one
//! claimed, singled  conditions for one claim: of codimension one, and single values
//! beyond    single values for more polynomial integrals of a field
//! solved, motion, points  cases where equations hold, whether the motion has values there, and points
//!           modulo a prime
//! real      real zeros of equations
//! ideal, bounded_ideal, decomposition, quotient  common zeros of polynomials in the parameters, their
//!           parts, and common divisors
//! ```
//!
//! For fields the minors are those of [`equations`] for the coefficients of a polynomial:
//!
//! ```text
//! split           the free tensors of a case by scalars
//! pencil          determinants of matrices of polynomials in one variable
//! parameter_line  the special values on a line of parameters
//! factors         factors of polynomials in two variables
//! locus           the special parameters of codimension one, factor by factor
//! joined          factors modulo a prime whose products have rational coefficients
//! hypersurface    a factor as an equation with rational coefficients
//! simple          sets of equations x = 0, x = y, for conditions of several equations
//! ```
//!
//! A condition of codimension one meets almost every line (over the closure of the field), so that
//! without a meeting point there is none; equations come from points modulo one prime, and are
//! confirmed at more points than they have coefficients.

mod beyond;
mod bounded_ideal;
pub mod by_values;
mod claimed;
mod coordinates;
mod decomposition;
mod equations;
mod factors;
mod hypersurface;
mod ideal;
mod isolated;
mod joined;
mod line;
mod locus;
mod minors;
mod motion;
mod parameter_line;
mod pencil;
mod points;
mod quotient;
mod real;
mod relation;
mod residual;
mod several;
mod simple;
mod singled;
mod small;
mod solved;
mod split;
mod values;
mod variety;
mod velocities;

use serde::Serialize;

use super::lists::{self, ListedCase};
use super::origin::ConditionOrigin;
use super::terms::one;
use super::{Effort, FoundKind, SearchError, SearchReport};
pub use coordinates::components;
use liouville::case::{Case, PlacedClaim};
use liouville::claim::Claim;
use liouville::mechanics::System;
use liouville::verdict::{Verdict, judge};

/// Largest number of combinations of listed values that are treated one by one.
const MOST_LISTED: usize = 8;
/// Statement that volumes are preserved.
const VOLUMES: &str = "the density 1, div v = 0";
/// Statement of the criterion.
const CRITERION: &str = "a density ρ of the configuration exists";

/// A condition on the parameters under which a statement holds.
#[derive(Clone, Debug, Serialize)]
pub struct ParameterCondition {
    /// Statement that holds.
    pub of: String,
    /// Alternative equations, each sufficient; empty if no condition was found.
    pub equations: Vec<String>,
    /// Method by which it was found, or the reason why there is none.
    pub grounds: String,
    /// Source.
    #[serde(skip)]
    pub origin: ConditionOrigin,
}

/// The statements for which conditions are searched.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ConditionTarget {
    /// Existence of a density of the configuration, and of integrals of degree 1 and 2 in the
    /// velocities.
    Existence,
    /// A claim, by name.
    Claim(String),
}

/// Finds the conditions under which statements hold that fail in general.
pub fn conditions(
    case: &Case,
    wanted: &ConditionTarget,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    match wanted {
        ConditionTarget::Claim(name) => {
            let named = case.claims.iter().find(|claim| &claim.name == name);
            let claim = named.ok_or_else(|| SearchError::NoClaim(name.clone()))?;
            progress(&format!("conditions for {name}"));
            let told = |report: &SearchReport| report.conditions.len() + report.remarks.len();
            let before = told(report);
            by_values(case, Some(claim), effort, report)?;
            if told(report) == before {
                let mut alone = case.clone();
                (alone.motions, alone.absences) = (Vec::new(), Vec::new());
                alone.claims = vec![claim.clone()];
                let judged = judge(&alone, &effort.options)?.claims;
                // For some kinds of claims nothing is asked, and roots have a sign that is not asked.
                report.remark(match judged.iter().all(|own| own.verdict == Verdict::Proved) {
                    true => format!("{name}: no condition is needed"),
                    false => format!("{name}: no condition on the parameters was found"),
                });
            }
            Ok(())
        }
        ConditionTarget::Existence => {
            if case.model.system.has_criterion() {
                progress("conditions for a density of the configuration");
                by_values(case, None, effort, report)?;
            }
            velocities::conditions(case, effort, report, progress)
        }
    }
}

/// Finds the conditions under which a field preserves volumes, where no density is known.
pub fn volumes(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let is_field = matches!(case.model.system, System::Field(_));
    let is_known = report.formulas(FoundKind::Density).next().is_some();
    if !is_field || is_known || case.model.free_components() == 0 {
        return Ok(());
    }
    progress("conditions for the density 1");
    let Ok(asked) = case.with_claims(&[Claim::density(one()).named(VOLUMES)]) else {
        return Ok(());
    };
    let Some(claim) = asked.claims.iter().find(|claim| claim.name == VOLUMES) else {
        return Ok(());
    };
    let before = report.conditions.len();
    by_values(&asked, Some(claim), effort, report)?;
    // That there are none says nothing of other densities.
    let mut place = 0;
    report.conditions.retain(|own| {
        place += 1;
        place <= before || !own.equations.is_empty()
    });
    Ok(())
}

/// Finds the conditions for one claim, or for the criterion, for each combination of listed values.
fn by_values(
    case: &Case,
    claim: Option<&PlacedClaim>,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let mut always = Vec::new();
    let own = lists::each_or_first(case, MOST_LISTED);
    for ListedCase { case, values } in &own {
        let of = claim.map_or(CRITERION, |claim| &claim.name);
        match claimed::condition(case, (claim, of), effort)? {
            Some(mut own) => {
                if !values.is_empty() {
                    own.of = format!("{}, for {values}", own.of);
                }
                report.conditions.push(own);
            }
            None => always.extend(Some(values.as_str()).filter(|values| !values.is_empty())),
        }
    }
    if !always.is_empty() {
        let of = claim.map_or(CRITERION, |claim| &claim.name);
        report.remark(format!("{of}: no condition is needed for {}", always.join(", or ")));
    }
    Ok(())
}
