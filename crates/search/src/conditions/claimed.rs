//! Conditions on the parameters under which one claim holds, or the criterion for a density.

use liouville::case::{Case, PlacedClaim};

use super::hypersurface::Hypersurface;
use super::line::{LineResult, Lines};
use super::residual::Residual;
use super::singled::{SingledValues, ValueSearch};
use super::variety::{self, VarietyEquation};
use super::{ParameterCondition, small};
use crate::origin::ConditionOrigin;
use crate::{Effort, SearchError};

/// Highest degree of an equation.
const DEGREE: u32 = 5;
/// Number of lines after which the search for points ends.
const LINES: usize = 4000;
/// Number of lines without any point after which there is no condition of codimension one.
const BARREN: usize = 24;
/// Number of points that establish a simple condition shared by them.
const REPEATED: usize = 2;
/// Reason why nothing is found.
const NO_FRACTION: &str = "the residual is not a fraction of low degree in the parameters";

/// Finds the conditions for one claim, or for the criterion, which is `of`; `None` if it always holds.
pub fn condition(
    case: &Case,
    (claim, of): (Option<&PlacedClaim>, &str),
    effort: &Effort,
) -> Result<Option<ParameterCondition>, SearchError> {
    let told = |equations: Vec<String>, grounds: String| {
        let (of, origin) = (of.to_string(), ConditionOrigin::Claim);
        Ok(Some(ParameterCondition { of, equations, grounds, origin }))
    };
    let Some(residual) = Residual::of(case, claim, effort.options.seed)? else { return Ok(None) };
    let Some(mut lines) = Lines::new(&residual, effort)? else {
        return told(Vec::new(), NO_FRACTION.to_string());
    };
    let Some(met) = MetEquations::on(&mut lines, &residual)? else { return Ok(None) };
    let search = ValueSearch::of(case, claim, effort)?;
    let mut equations = Vec::new();
    let (before, scope) = match met {
        MetEquations::NoFraction => return told(Vec::new(), NO_FRACTION.to_string()),
        MetEquations::None => {
            let before = format!("no condition of codimension one on {BARREN} random lines");
            (before, "modulo a prime of 61 bits")
        }
        MetEquations::Of { ref surfaces, seen, degree } => {
            let own = search.real_surfaces(residual.names(), surfaces, lines.modulus())?;
            let is_empty = own.told.is_empty();
            let before = format!(
                "{seen} points on random lines; the condition has degree {degree} along them{}",
                own.words()
            );
            equations.extend(own.told);
            match is_empty {
                true => (before, "modulo a prime of 61 bits"),
                false => (before, "besides it, modulo a prime of 61 bits,"),
            }
        }
    };
    let surfaces: Option<Vec<Hypersurface>> = match &met {
        MetEquations::Of { surfaces, .. } => {
            surfaces.iter().map(|own| search.read(residual.names(), own)).collect()
        }
        _ => Some(Vec::new()),
    };
    match (search.values(surfaces.as_deref())?, met) {
        (Some(own), _) => {
            let SingledValues { equations: further, .. } = &own;
            let grounds = own.grounds(&before, scope);
            equations.extend(further.iter().cloned());
            told(equations, grounds)
        }
        (None, MetEquations::None) => {
            let (systems, met) = small::conditions(&residual, effort)?;
            told(systems, format!("{before}; {met} points found by random sampling modulo 43"))
        }
        (None, _) => told(equations, before),
    }
}

/// What is met on random lines.
enum MetEquations {
    /// The residual is not a fraction of a degree within reach.
    NoFraction,
    /// No condition of codimension one.
    None,
    /// Equations, the number of points, and the degree of the condition on the lines.
    Of { surfaces: Vec<VarietyEquation>, seen: usize, degree: usize },
}

impl MetEquations {
    /// Finds the equations; `None` if the residual vanishes everywhere.
    fn on(lines: &mut Lines<'_>, residual: &Residual) -> Result<Option<Self>, SearchError> {
        let names = residual.names();
        let all: Vec<usize> = (0..names.len()).collect();
        let mut equations: Vec<(VarietyEquation, usize)> = Vec::new();
        let mut points: Vec<Vec<u64>> = Vec::new();
        let (mut degree, mut seen, mut tried) = (0, 0, 0);
        for line in 0..LINES {
            match lines.next()? {
                LineResult::Always => return Ok(None),
                LineResult::Unknown => return Ok(Some(Self::NoFraction)),
                LineResult::Points(found, own) => {
                    degree = degree.max(own);
                    for point in found {
                        seen += 1;
                        let own = variety::simple(names, &point, &all);
                        if own.is_empty() {
                            points.push(point);
                        }
                        for own in own {
                            match equations.iter_mut().find(|(known, _)| known.text == own.text) {
                                Some((_, count)) => *count += 1,
                                None => equations.push((own, 1)),
                            }
                        }
                    }
                }
            }
            if line == BARREN && degree == 0 {
                return Ok(Some(Self::None));
            }
            if points.len() >= variety::needed(names.len(), tried + 1) {
                tried += 1;
                if let Some(found) = variety::equations(names, &points, &lines.modulus(), tried) {
                    equations.extend(found.into_iter().map(|own| (own, points.len())));
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
        let surfaces = equations.into_iter().map(|(own, _)| own).collect();
        Ok(Some(Self::Of { surfaces, seen, degree }))
    }
}
