//! Numbers of integrals, degree by degree, and the theorems that follow.

use std::ops::RangeInclusive;

use serde::Serialize;

use super::absence::{has_lists, rank};
use super::budget::STEPS;
use super::complete::{are_all, note_missing};
use super::continued::named;
use super::hypotheses::stated;
use super::jets::{DimensionCount, MotionAtPoint, VelocityPolynomials};
use super::local::{Coordinates, Local};
use super::lowest::lowest;
use super::origin::TheoremOrigin;
use super::products::Generators;
use super::{Effort, Excluded, SearchError, SearchReport};
use liouville::case::Case;
use liouville::formula::Formula;
use liouville::mechanics::{Draw, System};
use liouville::number::rational::Rational;

/// Largest number of combinations of listed values that are counted one by one.
const MOST_LISTED: usize = 64;

/// Number of integrals of one degree.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct CountReport {
    /// Degree in the velocities.
    pub degree: u32,
    /// Whether all degrees up to it are counted together.
    pub mixed: bool,
    /// Whether potential and gyrostat are left out.
    pub free: bool,
    /// Number of independent integrals, an upper bound for generic parameters.
    pub dimension: usize,
    /// Number of products of known integrals among them.
    pub known: usize,
    /// Number of unknowns of the linear system.
    pub unknowns: usize,
    /// Number of equations of the linear system.
    pub equations: usize,
}

/// Estimated size and duration of a count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CountEstimate {
    /// Number of unknowns of the largest system.
    pub unknowns: u64,
    /// Least time to set up all systems, in seconds.
    pub seconds: f64,
}

/// Estimates the cost of counting integrals within the effort; `None` if they cannot be counted.
pub fn plan(case: &Case, effort: &Effort) -> Option<CountEstimate> {
    let coordinates = Coordinates::of(case).ok()?;
    let mixed = case.model.system.energy_is_inhomogeneous();
    let combinations = listed(&case.model.parameter_draws()).len() as f64;
    let sizes = (1..=effort.degree).map(|degree| size(&coordinates, degree, mixed));
    let counted = sizes.map(|(unknowns, seconds)| (unknowns, seconds * combinations));
    let (unknowns, seconds) = counted
        .filter(|(_, seconds)| *seconds <= effort.seconds)
        .fold((0, 0.0), |(most, sum), (unknowns, seconds)| (unknowns.max(most), sum + seconds));
    Some(CountEstimate { unknowns, seconds })
}

/// The degrees that are counted, up to that of the effort.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Degrees {
    /// Every degree by itself.
    Each,
    /// Those that bound the number of integrals up to the last degree: a count of all degrees
    /// together needs none of the lower ones.
    Decisive,
}

/// Counts integrals degree by degree, within the effort; first those of the free motion, since the
/// leading form of an integral is one of them.
pub fn count(
    case: &Case,
    degrees: Degrees,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let mixed = case.model.system.energy_is_inhomogeneous();
    let mut undecided = 1..=effort.degree;
    if let Some(free) = free_motion(case).filter(|_| mixed) {
        let ends_at_excess = degrees == Degrees::Decisive;
        let motion = CountedMotion::of(&free, false, effort)?;
        let motion = CountedMotion { free: true, ends_at_excess, ..motion };
        motion.series(undecided.clone(), effort, report, progress)?;
        let excess = report.counts.iter().find(|count| count.dimension > count.known);
        match excess {
            // Each leading form is a power of the energy: nothing remains to be counted.
            None if !report.counts.is_empty() => return Ok(()),
            None => {}
            Some(excess) => undecided = excess.degree..=effort.degree,
        }
    }
    if mixed && degrees == Degrees::Decisive {
        undecided = effort.degree.max(1)..=effort.degree;
    }
    CountedMotion::of(case, mixed, effort)?.series(undecided, effort, report, progress)
}

/// Makes the same body without potential and gyrostat, if these are known.
pub fn free_motion(case: &Case) -> Option<Case> {
    let system = case.model.system.without_forces()?;
    let mut free = case.clone();
    free.model.system = system;
    Some(free)
}

/// The motion whose integrals are counted.
struct CountedMotion<'c> {
    case: &'c Case,
    /// Whether all degrees up to the given one are counted together.
    mixed: bool,
    /// Whether potential and gyrostat are left out.
    free: bool,
    /// Whether nothing is counted after a degree with more integrals than are known.
    ends_at_excess: bool,
    /// Energy of the motion, a known integral.
    energy: Generators,
}

impl<'c> CountedMotion<'c> {
    fn of(case: &'c Case, mixed: bool, effort: &Effort) -> Result<Self, SearchError> {
        let energy = Generators::energy(case, effort)?;
        Ok(Self { case, mixed, free: false, ends_at_excess: false, energy })
    }

    /// Counts degree by degree; a remark gives the reason for an early end.
    fn series(
        &self,
        degrees: RangeInclusive<u32>,
        effort: &Effort,
        report: &mut SearchReport,
        progress: &mut dyn FnMut(&str),
    ) -> Result<(), SearchError> {
        let Some(locals) = locals(self.case, report)? else { return Ok(()) };
        let Some(first) = locals.first() else { return Ok(()) };
        let mut motions: Vec<MotionAtPoint<'_>> = locals.iter().map(MotionAtPoint::new).collect();
        let cost =
            |degree: u32| size(&first.coordinates, degree, self.mixed).1 * locals.len() as f64;
        let last = degrees.clone().take_while(|degree| cost(*degree) <= effort.seconds).last();
        if let Some(degree) = last.filter(|_| !self.ends_at_excess) {
            motions.iter_mut().for_each(|motion| motion.foresee(degree));
        }
        for degree in degrees {
            let (unknowns, seconds) = size(&first.coordinates, degree, self.mixed);
            let seconds = seconds * locals.len() as f64;
            progress(&format!(
                "integrals of degree {degree}: {unknowns} unknowns, at least {seconds:.1} s"
            ));
            if seconds > effort.seconds {
                report.remark(format!(
                    "degree {degree} was not counted: {unknowns} unknowns take {seconds:.0} s and more; raise --count-seconds"
                ));
                return Ok(());
            }
            match self.of_degree(&mut motions, degree, effort) {
                // A bound below the number of known integrals would be a defect of the program:
                // nothing is concluded.
                Ok(count) if count.dimension < count.known => {
                    report.remark(format!(
                        "degree {degree}: fewer integrals are counted than are known"
                    ));
                    return Ok(());
                }
                Ok(count) => {
                    report.counts.push(count);
                    if self.ends_at_excess && count.dimension > count.known {
                        return Ok(());
                    }
                }
                Err(SearchError::Stopped) => {
                    report.unreached.push(format!("integrals of degree {degree} and more"));
                    return Ok(());
                }
                Err(error @ (SearchError::Long { .. } | SearchError::Large { .. })) => {
                    report.remark(format!("degree {degree} was not counted: {error}"));
                    return Ok(());
                }
                Err(error) => {
                    report.remark(error.to_string());
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    fn of_degree(
        &self,
        motions: &mut [MotionAtPoint<'_>],
        degree: u32,
        effort: &Effort,
    ) -> Result<CountReport, SearchError> {
        let known = self.energy.products(degree, self.mixed);
        let asked = VelocityPolynomials { degree, mixed: self.mixed };
        let found = largest(motions, asked, &Rational::from(0), known, effort)?;
        let DimensionCount { dimension, size: (unknowns, equations) } = found;
        let (mixed, free) = (self.mixed, self.free);
        Ok(CountReport { degree, mixed, free, dimension, known, unknowns, equations })
    }
}

/// Records the equations of motion for each combination of listed values; `None`, with a remark, if there are
/// too many combinations or nothing can be counted, and without one for a field, which has no velocities.
pub fn locals(case: &Case, report: &mut SearchReport) -> Result<Option<Vec<Local>>, SearchError> {
    let recorded = || -> Result<Vec<Local>, SearchError> {
        let all = listed(&case.model.parameter_draws());
        if all.is_empty() {
            return Ok(Vec::new());
        }
        let coordinates = Coordinates::of(case)?;
        all.iter().map(|fixed| Local::with(case, coordinates.clone(), fixed)).collect()
    };
    let locals = match recorded() {
        // Nobody expects a count of velocities where there are none.
        Err(SearchError::Unsplit(_)) if !Coordinates::are_expected(&case.model.system) => {
            return Ok(None);
        }
        Err(error @ SearchError::Unsplit(_)) => {
            report.remark(error.to_string());
            return Ok(None);
        }
        recorded => recorded?,
    };
    if locals.is_empty() {
        report.remark(format!("integrals are not counted: the lists have more than {MOST_LISTED} combinations; give values with --set"));
        return Ok(None);
    }
    Ok(Some(locals))
}

/// Returns the largest count over the listed values: a theorem is about all of them.
pub fn largest(
    motions: &mut [MotionAtPoint<'_>],
    asked: VelocityPolynomials,
    weight: &Rational,
    least: usize,
    effort: &Effort,
) -> Result<DimensionCount, SearchError> {
    let counts: Result<Vec<DimensionCount>, SearchError> =
        motions.iter_mut().map(|motion| motion.count(asked, weight, least, effort)).collect();
    counts?.into_iter().max_by_key(|count| count.dimension).ok_or(SearchError::NoSeries)
}

/// Lists the combinations of the values of parameters that have a list, if they are few.
fn listed(draws: &[Draw]) -> Vec<Vec<Option<Rational>>> {
    let mut combinations = vec![Vec::new()];
    for draw in draws {
        let values = match draw {
            Draw::OneOf(values) => values.iter().cloned().map(Some).collect(),
            Draw::Within(_) | Draw::Of(..) | Draw::Sign => vec![None],
        };
        if combinations.len() * values.len() > MOST_LISTED {
            return Vec::new();
        }
        let extended = combinations.iter().flat_map(|known: &Vec<Option<Rational>>| {
            values.iter().map(|value| known.iter().cloned().chain([value.clone()]).collect())
        });
        combinations = extended.collect();
    }
    combinations
}

/// Estimates the number of unknowns, and the least time in seconds to set up their equations: what
/// the elimination takes beyond that depends on how sparse it stays, and is limited while it runs.
pub fn size(coordinates: &Coordinates, degree: u32, mixed: bool) -> (u64, f64) {
    let (positions, velocities) = (coordinates.positions as u32, coordinates.velocities as u32);
    let powers = |degree: u32| binomial(degree + velocities - 1, velocities - 1);
    let powers: u64 =
        if mixed { (0..=degree).map(powers).fold(0, u64::saturating_add) } else { powers(degree) };
    let monomials = binomial(2 * degree + 3 + positions, positions);
    let unknowns = powers.saturating_mul(monomials);
    // All pairs of monomials are listed, and each unknown meets all terms of the rates.
    let steps = (monomials as f64 + unknowns as f64) * monomials as f64;
    (unknowns, steps / STEPS)
}

/// Returns the binomial coefficient, or the largest number below 2⁶⁴ in place of a larger one.
fn binomial(n: u32, k: u32) -> u64 {
    let number = (1..=u128::from(k)).try_fold(1u128, |product, i| {
        product.checked_mul(u128::from(n - k) + i).map(|product| product / i)
    });
    number.and_then(|number| u64::try_from(number).ok()).unwrap_or(u64::MAX)
}

/// States the theorem of absence that follows from the counts and the integrals known so far, in
/// place of an earlier one.
pub fn conclude(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    if report.counts.is_empty() {
        return Ok(());
    }
    let mut all = Generators::all(case, effort, report)?;
    // A rank is that for one of the listed values.
    if !has_lists(case)
        && let Some(low) = lowest(case, effort, report)?
    {
        let own = report.counts.iter().filter(|count| !count.free);
        let of = |of: &Generators| -> usize {
            own.clone().map(|count| of.products(count.degree, count.mixed)).sum()
        };
        if of(&low) > of(&all) {
            all = low;
        }
    }
    let further = match has_lists(case) {
        true => None,
        false => all.with_further(case, effort, report)?,
    };
    for count in report.counts.iter_mut().filter(|count| !count.free) {
        count.known = all.products(count.degree, count.mixed);
        // These satisfy relations.
        if let Some(further) = &further {
            let products = further.exponents(count.degree, count.mixed);
            let formulas: Vec<Formula> = further.formulas().cloned().collect();
            if let Some(rank) = rank(case, &formulas, &products, &[], effort)? {
                count.known = count.known.max(rank);
            }
        }
    }
    let all = further.unwrap_or(all);
    let is_missing = |count: &CountReport| !count.free && count.dimension > count.known;
    report.is_complete = report.counts.iter().any(is_missing) && are_all(case, effort, report)?;
    note_missing(case, effort, report);
    let free_only = report.counts.iter().all(|count| count.free);
    let complete = |count: &&CountReport| count.dimension == count.known;
    let relevant = report.counts.iter().filter(|count| count.free == free_only);
    let Some(last) = relevant.take_while(complete).last().copied() else { return Ok(()) };
    let degree = last.degree;
    let forces = match (free_only, last.mixed) {
        (true, _) => {
            " Leading forms are integrals of the free motion, so this holds for every gyrostat and every potential."
        }
        // Of a body the motion without them is counted as well.
        (false, true) if !matches!(case.model.system, System::Lagrangian(_)) => {
            " The potential, the rotor and the moments are those of the case."
        }
        (false, _) => "",
    };
    let generators = all.each().filter(|(_, own)| *own <= degree);
    let formulas: Vec<&Formula> = generators.map(|(formula, _)| formula).collect();
    let what = match formulas.is_empty() {
        true => format!(
            "there is no integral polynomial in the velocities of degree at most {degree}, other than constants."
        ),
        false => format!(
            "every integral polynomial in the velocities of degree at most {degree} is a polynomial in {}.",
            named(case, formulas, effort)?
        ),
    };
    let stated = Excluded {
        ansatz: format!(
            "polynomials in the velocities of degree up to {degree}, with any smooth coefficients in the \
             positions"
        ),
        dimension: last.dimension,
        known: last.known,
        error_log2: None,
        theorem: stated(&case.model, &format!("{what}{forces}")),
        origin: TheoremOrigin::IntegralCount { free: free_only },
        values: None,
    };
    let is_count = |own: &&mut Excluded| matches!(own.origin, TheoremOrigin::IntegralCount { .. });
    match report.excluded.iter_mut().find(is_count) {
        Some(earlier) => *earlier = stated,
        None => report.excluded.push(stated),
    }
    Ok(())
}
