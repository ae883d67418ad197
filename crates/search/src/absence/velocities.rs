//! Absence of polynomials in the velocities, with any smooth coefficients in the positions.

use super::super::counts::{self, CountReport, Degrees};
use super::super::local::Coordinates;
use super::super::origin::Remark;
use super::super::products::degree_in;
use super::super::{
    Effort, Found, FoundKind, Halt, SearchError, SearchReport, ansatz, densities, integrals,
    multipliers, orbit,
};
use super::found::{Part, shown};
use super::{AbsenceCase, AbsenceOutcome, Counted, claimed_densities, generated};
use liouville::verdict::Verdict;

/// Share of the time that is left for a search among integrals of degree 1.
const SHARE_OF_FIRST: f64 = 0.25;

/// Judges a claim by Taylor coefficients.
pub fn judge(
    asked: &AbsenceCase<'_>,
    counted: Counted,
    degree: u32,
) -> Result<AbsenceOutcome, SearchError> {
    let coordinates = match asked.coordinates {
        Ok(coordinates) => coordinates,
        Err(error) => return Ok(AbsenceOutcome::Open(error.to_string())),
    };
    match counted {
        Counted::Integrals => no_integral(asked, coordinates, degree),
        Counted::Densities => no_density(asked, coordinates, degree),
    }
}

/// A bound that follows from the counts.
enum Bound {
    /// Each leading form is a power of the energy.
    Leading,
    /// Number of independent integrals up to the degree, constants included.
    Integrals(usize),
}

/// Reads a bound from the counts, if they reach the degree.
fn bound(counts: &[CountReport], degree: u32) -> Option<Bound> {
    let own: Vec<&CountReport> = counts.iter().filter(|count| !count.free).collect();
    match own.iter().find(|count| count.degree == degree) {
        Some(last) if last.mixed => Some(Bound::Integrals(last.dimension)),
        // Each degree separately, and the constants.
        Some(_) => {
            let all = (1..=degree).map(|n| own.iter().find(|count| count.degree == n));
            let dimensions: Option<Vec<usize>> =
                all.map(|count| count.map(|count| count.dimension)).collect();
            dimensions.map(|each| Bound::Integrals(1 + each.iter().sum::<usize>()))
        }
        None => {
            let powers =
                |n| counts.iter().any(|c| c.free && c.degree == n && c.dimension == c.known);
            (own.is_empty() && (1..=degree).all(powers)).then_some(Bound::Leading)
        }
    }
}

fn no_integral(
    asked: &AbsenceCase<'_>,
    coordinates: &Coordinates,
    most: u32,
) -> Result<AbsenceOutcome, SearchError> {
    let case = asked.case;
    let effort = &Effort { degree: most, ..asked.effort.clone() };
    let mut report = SearchReport::default();
    counts::count(case, Degrees::Decisive, effort, &mut report, &mut |_| {})?;
    let class = format!(
        "a polynomial of degree at most {most} in the velocities, with any smooth coefficients on any \
         connected open set of positions"
    );
    let dimension = match bound(&report.counts, most) {
        None => {
            return Ok(AbsenceOutcome::Open(reasons(
                &report,
                "the count does not reach this degree",
            )));
        }
        Some(Bound::Leading) => {
            // If the energy is conserved, subtracting its powers lowers the degree.
            let energy = asked.known.energy();
            return Ok(match energy {
                None => {
                    AbsenceOutcome::Open("the energy is not known to be an integral".to_string())
                }
                Some(energy) => AbsenceOutcome::Excluded {
                    theorem: asked.theorem(&generated(
                        asked,
                        &class,
                        std::slice::from_ref(energy),
                    )?),
                    counted: "leading forms are powers of the energy".to_string(),
                },
            });
        }
        Some(Bound::Integrals(dimension)) => dimension,
    };
    let known = asked.known.of_degree((case, coordinates), most, effort)?;
    if known.dimension > dimension {
        return Ok(AbsenceOutcome::Open(format!(
            "the count is {dimension}, fewer than the {} known integrals",
            known.dimension
        )));
    }
    if known.dimension == dimension {
        return Ok(AbsenceOutcome::Excluded {
            theorem: asked.theorem(&generated(asked, &class, &known.formulas)?),
            counted: super::reports::all_known(dimension),
        });
    }
    let mut exhibit = None;
    if most > 1 {
        // Integrals of degree 1 are found soonest, and one of them contradicts the claim for each degree.
        let halt = effort
            .halt
            .left()
            .map_or_else(|| effort.halt.clone(), |left| Halt::within(left.mul_f64(SHARE_OF_FIRST)));
        let first = Effort { degree: 1, halt, ..effort.clone() };
        let found = exhibited(asked, coordinates, (most, &first), report.clone());
        exhibit = match found {
            Err(SearchError::Stopped) => None,
            other => other?,
        };
    }
    if exhibit.is_none() {
        exhibit = exhibited(asked, coordinates, (most, effort), report)?;
    }
    Ok(exhibit.map(AbsenceOutcome::Exhibited).unwrap_or_else(|| {
        AbsenceOutcome::Bounded(format!(
            "at most {dimension} linearly independent integrals exist, constants included; {} are known, and no \
             other was found in closed form",
            known.dimension
        ))
    }))
}

/// Searches for an integral that contradicts the claim.
fn exhibited(
    asked: &AbsenceCase<'_>,
    coordinates: &Coordinates,
    (most, effort): (u32, &Effort),
    mut report: SearchReport,
) -> Result<Option<String>, SearchError> {
    let case = asked.case;
    let parts: [Part<'_>; 4] = [
        &mut |report| densities::densities(case, effort, report),
        &mut |report| integrals::integrals(case, effort, report),
        &mut |report| orbit::search(case, effort, false, report, &mut |_| {}),
        &mut |report| ansatz::search(case, effort, report, &mut |_| {}),
    ];
    for part in parts {
        part(&mut report)?;
        let exhibit = witness(asked, coordinates, most, &report)?;
        if exhibit.is_some() {
            return Ok(exhibit);
        }
    }
    Ok(None)
}

/// Returns an integral of a report that refutes the claim.
fn witness(
    asked: &AbsenceCase<'_>,
    coordinates: &Coordinates,
    most: u32,
    report: &SearchReport,
) -> Result<Option<String>, SearchError> {
    let own = |found: &&Found| found.is_integral() && found.verdict == Verdict::Proved;
    for found in report.found.iter().filter(own) {
        let Some(function) = found.function() else { continue };
        let low = degree_in(asked.case, function, coordinates, asked.effort.options.seed)?;
        if low.is_some_and(|degree| degree <= most) && asked.is_new(function)? {
            return Ok(Some(shown("integral", found)));
        }
    }
    Ok(None)
}

fn no_density(
    asked: &AbsenceCase<'_>,
    coordinates: &Coordinates,
    most: u32,
) -> Result<AbsenceOutcome, SearchError> {
    let case = asked.case;
    let effort = &Effort { degree: most, ..asked.effort.clone() };
    let mixed = case.model.system.energy_is_inhomogeneous();
    let (unknowns, seconds) = counts::size(coordinates, most, mixed);
    let seconds = seconds * multipliers::WEIGHTS.len() as f64;
    if seconds > effort.seconds {
        return Ok(AbsenceOutcome::Open(format!(
            "degree {most} has {unknowns} unknowns, and takes {seconds:.0} s and more: ask for a lower one"
        )));
    }
    let mut report = SearchReport::default();
    multipliers::multipliers(case, effort, &mut report, &mut |_| {})?;
    if !report.excluded.is_empty() {
        let powers = match most {
            0 => String::new(),
            _ => format!(
                " and none of the form P^(1/α), α = ±1, ±2, ±3, ±4, P a polynomial of degree at most \
                 {most} in the velocities with any smooth coefficients in the positions"
            ),
        };
        let statement = format!("there is no invariant density of the positions alone{powers}");
        return Ok(AbsenceOutcome::Excluded {
            theorem: asked.theorem(&statement),
            counted: "0 are counted".to_string(),
        });
    }
    for found in report.of_case(FoundKind::Density).filter(|found| found.verdict == Verdict::Proved)
    {
        let Some(function) = found.function() else { continue };
        if claimed_densities::is_of_class(asked, function, most)? {
            return Ok(AbsenceOutcome::Exhibited(shown("density", found)));
        }
    }
    Ok(AbsenceOutcome::Open(match report.multipliers.is_empty() {
        true => reasons(&report, "nothing can be counted"),
        false => "the count allows a density, but none was found in closed form".to_string(),
    }))
}

fn reasons(report: &SearchReport, otherwise: &str) -> String {
    // `check` has no such options.
    let remark = |own: &Remark| match own.text.split_once("; raise --") {
        Some((reason, _)) => format!("{reason}: ask for a lower degree"),
        None => own.text.trim_end_matches("; give values with --set").to_string(),
    };
    let unreached = report.unreached.iter().map(|what| format!("not reached: {what}"));
    let all: Vec<String> = report.remarks.iter().map(remark).chain(unreached).collect();
    if all.is_empty() { otherwise.to_string() } else { all.join("; ") }
}
