//! Conditions on the parameters under which one claim holds, or the criterion for a density.

use liouville::case::{Case, PlacedClaim};

use super::hypersurface::Hypersurface;
use super::line::{LineResult, Lines};
use super::residual::Residual;
use super::singled::ValueSearch;
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
/// Restriction of an equation that is found with roots.
const EITHER_SIGN: &str = "; roots have either sign modulo a prime: where they are positive, the claim may hold for a part \
                           of these values alone";
/// Reason why nothing is found.
const NO_FRACTION: &str = "the residual is not a fraction of low degree in the parameters";

/// Finds the conditions for one claim, or for the criterion, which is `of`; `None` if it always holds.
pub fn condition(
    case: &Case,
    (claim, of): (Option<&PlacedClaim>, &str),
    effort: &Effort,
) -> Result<Option<ParameterCondition>, SearchError> {
    let Some(residual) = Residual::of(case, claim, effort.options.seed)? else { return Ok(None) };
    let told = |equations: Vec<String>, mut grounds: String| {
        if !equations.is_empty() && residual.has_roots() {
            grounds.push_str(EITHER_SIGN);
        }
        let (of, origin) = (of.to_string(), ConditionOrigin::Claim);
        Ok(Some(ParameterCondition { of, equations, grounds, origin }))
    };
    let Some(mut lines) = Lines::new(&residual, effort)? else {
        return told(Vec::new(), NO_FRACTION.to_string());
    };
    let Some(met) = MetEquations::on(&mut lines, &residual)? else { return Ok(None) };
    let (surfaces, seen, degree) = match met {
        MetEquations::NoFraction => return told(Vec::new(), NO_FRACTION.to_string()),
        MetEquations::None => (Vec::new(), 0, 0),
        MetEquations::Of { surfaces, seen, degree } => (surfaces, seen, degree),
    };
    let search = ValueSearch::of(case, claim, effort)?;
    let names = residual.names();
    let read: Option<Vec<Hypersurface>> =
        surfaces.iter().map(|own| search.read(names, own)).collect();
    let values = search.values(read.as_deref())?;
    let mut real = search.real_surfaces(names, &surfaces, lines.modulus())?;
    let open = real.complete(values.is_some());
    let mut equations = real.told;
    let before = match degree {
        0 => format!("no condition of codimension one on {BARREN} random lines"),
        _ => format!(
            "{seen} points on random lines; the condition has degree {degree} along them{open}"
        ),
    };
    match values {
        Some(own) => {
            let scope = match equations.is_empty() {
                true => "modulo a prime of 61 bits",
                false => "besides it, modulo a prime of 61 bits,",
            };
            let grounds = own.grounds(&before, scope);
            equations.extend(own.equations);
            told(equations, grounds)
        }
        None if degree == 0 => {
            let (systems, met) = small::conditions(&residual, effort)?;
            told(systems, format!("{before}; {met} points found by random sampling modulo 43"))
        }
        None => told(equations, before),
    }
}

/// Finds on random lines.
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
