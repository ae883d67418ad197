//! Integrals counted degree by degree, and the theorems that follow.

use serde::Serialize;

use super::jets;
use super::local::Local;
use super::products::Generators;
use super::{Effort, Excluded, Report, SearchError};
use crate::case::Case;

/// Elementary steps of an elimination a second, at the least.
const STEPS: f64 = 1e9;

/// The number of integrals of a degree.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct CountReport {
    /// The degree in the velocities.
    pub degree: u32,
    /// All degrees up to it together?
    pub mixed: bool,
    /// Are potential and gyrostat left out?
    pub free: bool,
    /// The number of independent ones, an upper bound for generic parameters.
    pub dimension: usize,
    /// How many of them are products of those that are known.
    pub known: usize,
    /// Unknowns of the linear system.
    pub unknowns: usize,
    /// Its equations.
    pub equations: usize,
}

/// Counts integrals degree by degree, as far as the effort goes; first those of the free motion, as
/// the leading form of an integral is one of them.
pub fn count(
    case: &Case,
    effort: &Effort,
    report: &mut Report,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let inhomogeneous = case.model.system.energy_is_inhomogeneous();
    let bare = case.model.system.without_forces().filter(|_| inhomogeneous);
    let mut undecided = 1..=effort.degree;
    if let Some(system) = bare {
        let mut free = case.clone();
        free.model.system = system;
        let energy = Generators::energy(&free, effort)?;
        series(&free, false, true, 1..=effort.degree, &energy, effort, report, progress)?;
        let excess = report.counts.iter().find(|count| count.dimension > count.known);
        match excess {
            // Each leading form is a power of the energy: nothing is left to count.
            None if !report.counts.is_empty() => return Ok(()),
            None => {}
            Some(excess) => undecided = excess.degree..=effort.degree,
        }
    }
    let energy = Generators::energy(case, effort)?;
    series(case, inhomogeneous, false, undecided, &energy, effort, report, progress)
}

#[expect(clippy::too_many_arguments, reason = "what is counted, of what, and where it goes")]
fn series(
    case: &Case,
    mixed: bool,
    free: bool,
    degrees: std::ops::RangeInclusive<u32>,
    energy: &Generators,
    effort: &Effort,
    report: &mut Report,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let local = match Local::of(case, &[]) {
        Ok(local) => local,
        Err(error @ SearchError::Unsplit(_)) => {
            report.remark(error.to_string());
            return Ok(());
        }
        Err(error) => return Err(error),
    };
    for degree in degrees {
        let (unknowns, seconds) = size(&local, degree, mixed);
        let megabytes = unknowns * unknowns * 8 / 1_000_000;
        progress(&format!(
            "integrals of degree {degree}: {unknowns} unknowns, at most {seconds:.0} s and {megabytes} MB"
        ));
        if seconds > effort.seconds {
            report.remark(format!(
                "degree {degree} was not counted: {unknowns} unknowns may take {seconds:.0} s; raise --seconds"
            ));
            return Ok(());
        }
        let known = energy.products(degree, mixed);
        match jets::count(&local, degree, mixed, known, effort.options.seed) {
            Ok(jets::Count { dimension, size: (unknowns, equations), .. }) => {
                report.counts.push(CountReport {
                    degree,
                    mixed,
                    free,
                    dimension,
                    known,
                    unknowns,
                    equations,
                });
            }
            Err(error) => {
                report.remark(error.to_string());
                return Ok(());
            }
        }
    }
    Ok(())
}

/// Unknowns, and a bound for the seconds.
fn size(local: &Local, degree: u32, mixed: bool) -> (u64, f64) {
    let (positions, velocities) =
        (local.coordinates.positions as u32, local.coordinates.velocities as u32);
    let powers = |degree: u32| binomial(degree + velocities - 1, velocities - 1);
    let powers: u64 = if mixed { (0..=degree).map(powers).sum() } else { powers(degree) };
    let unknowns = powers * binomial(2 * degree + 3 + positions, positions);
    (unknowns, (unknowns as f64).powi(3) / STEPS)
}

fn binomial(n: u32, k: u32) -> u64 {
    (1..=u64::from(k)).fold(1, |product, i| product * (u64::from(n - k) + i) / i)
}

/// States what the counts exclude, now that it is known what there is.
pub fn conclude(case: &Case, effort: &Effort, report: &mut Report) -> Result<(), SearchError> {
    if report.counts.is_empty() {
        return Ok(());
    }
    let all = Generators::all(case, effort, report)?;
    for count in report.counts.iter_mut().filter(|count| !count.free) {
        count.known = all.products(count.degree, count.mixed);
    }
    let free_only = report.counts.iter().all(|count| count.free);
    let complete = |count: &&super::CountReport| count.dimension <= count.known;
    let relevant = report.counts.iter().filter(|count| count.free == free_only);
    let Some(last) = relevant.take_while(complete).last().copied() else { return Ok(()) };
    let degree = last.degree;
    let forces = match (free_only, last.mixed) {
        (true, _) => {
            " Leading forms are integrals of the free motion, so this holds for every gyrostat and every potential."
        }
        (false, true) => " Potential, gyrostat and moments are those of the case.",
        (false, false) => "",
    };
    let names: Vec<&str> = all.names().collect();
    let what = match names.as_slice() {
        [] => format!(
            "there is no integral polynomial in the velocities of degree at most {degree}, constants aside."
        ),
        [only] => format!(
            "every integral polynomial in the velocities of degree at most {degree} is a polynomial in {only}."
        ),
        several => format!(
            "every integral polynomial in the velocities of degree at most {degree} is a polynomial in {}.",
            several.join(" and ")
        ),
    };
    report.excluded.push(Excluded {
        ansatz: format!(
            "polynomials in the velocities of degree up to {degree}, with any smooth coefficients in the positions"
        ),
        dimension: last.dimension,
        known: last.known,
        error_log2: None,
        theorem: format!(
            "For generic values of the free parameters, and the given values of the fixed ones, {what}{forces}"
        ),
    });
    Ok(())
}
