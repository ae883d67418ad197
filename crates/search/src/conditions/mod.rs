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
//! beyond    such values for more polynomial integrals of a field
//! solved, real  cases where equations hold; real roots
//! ideal, bounded_ideal, quotient  common zeros of polynomials in the parameters, and common divisors
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
mod coordinates;
mod equations;
mod factors;
mod hypersurface;
mod ideal;
mod isolated;
mod line;
mod locus;
mod minors;
mod parameter_line;
mod pencil;
mod polynomial;
mod quotient;
mod real;
mod relation;
mod residual;
mod several;
mod simple;
mod small;
mod solved;
mod split;
mod values;
mod variety;
mod velocities;

use serde::Serialize;

use super::lists::{self, ListedCase};
use super::{Effort, SearchError, SearchReport};
pub use coordinates::components;
use line::{LineResult, Lines};
use liouville::case::{Case, PlacedClaim};
use residual::Residual;
use split::SplitCase;

/// Highest degree of an equation.
const DEGREE: u32 = 5;
/// Number of lines after which the search for points ends.
const LINES: usize = 4000;
/// Number of lines without any point after which there is no condition of codimension one.
const BARREN: usize = 24;
/// Number of points that establish a simple condition shared by them.
const REPEATED: usize = 2;
/// Largest number of combinations of listed values that are treated one by one.
const MOST_LISTED: usize = 8;
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
            by_values(case, Some(claim), effort, report)
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
        match condition(case, claim, effort)? {
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

/// Finds the conditions for one claim, or for the criterion; `None` if it always holds.
fn condition(
    case: &Case,
    claim: Option<&PlacedClaim>,
    effort: &Effort,
) -> Result<Option<ParameterCondition>, SearchError> {
    let of = claim.map_or(CRITERION, |claim| &claim.name);
    let told = |equations: Vec<String>, grounds: String| {
        Ok(Some(ParameterCondition { of: of.to_string(), equations, grounds }))
    };
    let Some(residual) = Residual::of(case, claim, effort.options.seed)? else { return Ok(None) };
    let Some(mut lines) = Lines::new(&residual, effort)? else {
        let grounds = "the residual is not a fraction of low degree in the parameters";
        return told(Vec::new(), grounds.to_string());
    };
    let names = residual.names();
    let (mut equations, mut points): (Vec<(String, usize)>, Vec<Vec<u64>>) = Default::default();
    let (mut degree, mut seen, mut tried) = (0, 0, 0);
    for line in 0..LINES {
        match lines.next()? {
            LineResult::Always => return Ok(None),
            LineResult::Unknown => {
                return told(
                    Vec::new(),
                    "the residual is not a fraction of low degree in the parameters".to_string(),
                );
            }
            LineResult::Points(found, own) => {
                degree = degree.max(own);
                for point in found {
                    seen += 1;
                    let all: Vec<usize> = (0..point.len()).collect();
                    let own = variety::simple(names, &point, &all);
                    if own.is_empty() {
                        points.push(point);
                    }
                    for text in own {
                        match equations.iter_mut().find(|(known, _)| known == &text) {
                            Some((_, count)) => *count += 1,
                            None => equations.push((text, 1)),
                        }
                    }
                }
            }
        }
        if line == BARREN && degree == 0 {
            if let Some(own) = SeveralEquations::of(case, claim, effort)? {
                let grounds = format!("no condition of codimension one on {BARREN} random lines");
                let grounds = own.grounds(&grounds, "modulo a prime of 61 bits");
                return told(own.equations, grounds);
            }
            let (systems, met) = small::conditions(&residual, effort)?;
            let grounds = format!(
                "no condition of codimension one on {BARREN} random lines; {met} points found by random sampling modulo 43"
            );
            return told(systems, grounds);
        }
        if points.len() >= variety::needed(names.len(), tried + 1) {
            tried += 1;
            if let Some(found) = variety::equations(names, &points, &lines.modulus(), tried) {
                equations.extend(found.into_iter().map(|text| (text, points.len())));
                break;
            }
            if tried == DEGREE {
                break;
            }
        }
        if line > 8 * BARREN && points.is_empty() {
            break;
        }
    }
    equations.retain(|(_, count)| *count >= REPEATED);
    let mut grounds =
        format!("{seen} points on random lines; the condition has degree {degree} along them");
    let mut equations: Vec<String> = equations.into_iter().map(|(text, _)| text).collect();
    if let Some(own) = SeveralEquations::of(case, claim, effort)? {
        grounds = own.grounds(&grounds, "besides it, modulo a prime of 61 bits,");
        equations.extend(own.equations);
    }
    told(equations, grounds)
}

/// Conditions of several equations for one claim, or for the criterion.
struct SeveralEquations {
    equations: Vec<String>,
    /// Those under which the claim is proved.
    proved: Vec<String>,
    /// Number of conditions that are not written.
    unwritten: usize,
}

impl SeveralEquations {
    /// Finds them; `None` if the residual is not a fraction of low degree in the parameters.
    fn of(
        case: &Case,
        claim: Option<&PlacedClaim>,
        effort: &Effort,
    ) -> Result<Option<Self>, SearchError> {
        let split = SplitCase::of(case);
        if split.scalars.is_empty() {
            return Ok(None);
        }
        let Some(found) = isolated::of_claim(&split, claim, effort)? else { return Ok(None) };
        let (mut equations, mut proved) = (Vec::new(), Vec::new());
        for own in &found.written {
            let texts: Vec<String> = own.iter().map(|own| own.equation(&split.scalars)).collect();
            let text = texts.join(" and ");
            if let Some(claim) = claim
                && solved::is_proved(&split, own, claim, effort)?
            {
                proved.push(text.clone());
            }
            equations.push(text);
        }
        Ok(Some(Self { equations, proved, unwritten: found.unwritten }))
    }

    /// Adds to grounds what is found, proved and left out; `scope` says where.
    fn grounds(&self, before: &str, scope: &str) -> String {
        let mut text = format!("{before}; {scope} ");
        text.push_str(&match (self.equations.len(), self.unwritten) {
            (0, 0) => "it holds for no real values of the parameters".to_string(),
            (_, 0) => "it holds for no other real values than those told".to_string(),
            (_, n) => format!(
                "it holds for the values told, and for {n} sets of values whose equations have no short \
                 coefficients"
            ),
        });
        if !self.proved.is_empty() {
            text.push_str(&format!("; proved where {}", self.proved.join(", or where ")));
        }
        text
    }
}
