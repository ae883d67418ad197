//! Symmetric periodic orbits of a section: where images of the line of fixed points of a reversor
//! meet that line again.
//!
//! A reversor R of the section map Φ obeys ΦRΦ = R. A point x with Rx = x comes back after 2k crossings
//! if R keeps Φᵏx too, and after 2k + 1 if R takes Φᵏx to Φᵏ⁺¹x: one equation on a line.

use std::f64::consts::PI;

use crate::closed::cycle::Cycle;
use crate::closed::periodic::{ComputedPeriodicPoint, SectionMap, short};
use crate::error::FlowError;
use crate::section::andoyer::spread;
use crate::section::rolling::{SectionOrbit, SectionRequest, section};
use liouville::case::{Angle, Case, Direction, FixedLine};
use liouville::number::rational::Rational;
use liouville::order::StableOrder;

/// All lines.
const LINES: [FixedLine; 3] = [FixedLine::Equator, FixedLine::Meridian, FixedLine::QuarterMeridian];
/// Number of points at which a reversor is tried, and the distance of images that rounding explains.
const TRIALS: usize = 7;
const ROUNDING: f64 = 1e-8;
/// Values on a line that are 0.
const ZERO: f64 = 1e-12;
/// Iteration limit of the search along a line.
const MOST_STEPS: usize = 80;
/// Distance between points of the section that are the same.
const SAME: f64 = 1e-6;
/// Distance of mirror images that may be one point, before Newton's method.
const CLOSE: f64 = 1e-3;

/// Request for symmetric periodic orbits.
pub struct SymmetricRequest<'r> {
    /// Case of the orbits.
    pub case: &'r Case,
    /// Angle g₀ of the section.
    pub g0: &'r Angle,
    /// Energy of the orbits.
    pub energy: &'r Rational,
    /// Lines that are searched.
    pub lines: &'r [FixedLine],
    /// Longest period, in crossings.
    pub longest: usize,
    /// Number of points tried along each line.
    pub points: usize,
    /// Seed of the free parameters.
    pub seed: u64,
    /// Number of threads.
    pub threads: usize,
}

/// A symmetric periodic orbit.
pub struct SymmetricOrbit {
    /// Its point on the line.
    pub point: ComputedPeriodicPoint,
    /// Closed orbit through it.
    pub cycle: Cycle,
    /// Lines of the reversors that keep the orbit.
    pub lines: Vec<FixedLine>,
}

/// Symmetric periodic orbits of a section.
pub struct SymmetricOrbits {
    /// Orbits, the shortest periods first.
    pub orbits: Vec<SymmetricOrbit>,
    /// Number of places on the lines that Newton's method did not confirm.
    pub unconfirmed: usize,
    /// Number of points of the lines without a motion that comes back so often.
    pub lost: usize,
}

/// Name of a line, as options have it.
pub fn line_name(line: FixedLine) -> &'static str {
    match line {
        FixedLine::Equator => "L=0",
        FixedLine::Meridian => "l=0",
        FixedLine::QuarterMeridian => "l=π/2",
    }
}

/// Image of a point under the reflection that leaves the line in place.
fn mirrored(line: FixedLine, [l, z]: [f64; 2]) -> [f64; 2] {
    match line {
        FixedLine::Equator => [l, -z],
        FixedLine::Meridian => [-l, z],
        FixedLine::QuarterMeridian => [PI - l, z],
    }
}

/// Quantity that the reflection changes in its sign, and that vanishes on the line alone.
fn beside(line: FixedLine, [l, z]: [f64; 2]) -> f64 {
    match line {
        FixedLine::Equator => z,
        FixedLine::Meridian => libm::sin(l),
        FixedLine::QuarterMeridian => libm::cos(l),
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(short(a[0] - b[0]), a[1] - b[1])
}

/// Finds the symmetric periodic orbits that meet the lines.
pub fn symmetric_orbits(request: &SymmetricRequest<'_>) -> Result<SymmetricOrbits, FlowError> {
    let map = SectionMap::new(request.case, request.g0, request.energy, request.seed)?;
    for line in request.lines {
        if let Some((at, by)) = map.refutes(*line)? {
            let ([l, z], line) = (at, line_name(*line));
            return Err(FlowError::NoReversor { line, l, z, by });
        }
    }
    let kept = LINES.iter().map(|line| Ok((*line, map.refutes(*line)?.is_none())));
    let kept: Vec<(FixedLine, bool)> = kept.collect::<Result<_, FlowError>>()?;
    let kept = kept.into_iter().filter(|(_, holds)| *holds).map(|(line, _)| line).collect();
    let mut search = Search {
        map: &map,
        kept,
        found: SymmetricOrbits { orbits: Vec::new(), unconfirmed: 0, lost: 0 },
        known: Vec::new(),
    };
    for line in request.lines {
        let pieces = scanned(request, *line)?;
        search.found.lost += pieces
            .iter()
            .flatten()
            .filter(|orbit| orbit.crossings.len() < images(request.longest))
            .count();
        for period in 1..=request.longest {
            for pair in pieces.iter().flat_map(|piece| piece.windows(2)) {
                search.look(*line, period, [&pair[0], &pair[1]])?;
            }
        }
    }
    let mut found = search.found;
    found.orbits.order_by_key(|orbit| orbit.point.period);
    Ok(found)
}

/// Number of images that a period needs.
fn images(period: usize) -> usize {
    period.div_ceil(2)
}

/// Follows points along the pieces of a line.
fn scanned(
    request: &SymmetricRequest<'_>,
    line: FixedLine,
) -> Result<Vec<Vec<SectionOrbit>>, FlowError> {
    let starts = line.points(request.points);
    let orbits = section(
        request.case,
        &SectionRequest {
            g0: request.g0.clone(),
            energy: request.energy.clone(),
            direction: Direction::Both,
            crossings: images(request.longest),
            skip: 0,
            starts: starts.clone(),
            backwards: false,
            seed: request.seed,
            index: 0,
        },
        request.threads,
        &|_| (),
    )?;
    if let Some(FlowError::Stopped) = orbits.iter().find_map(|orbit| orbit.problem.clone()) {
        return Err(FlowError::Stopped);
    }
    let mut orbits: Vec<SectionOrbit> = orbits;
    if line == FixedLine::Equator {
        // The circle is closed.
        let mut first = orbits.first().cloned();
        if let Some(first) = &mut first {
            first.start[0] += 2.0 * PI;
        }
        orbits.extend(first);
        return Ok(vec![orbits]);
    }
    let second = orbits.split_off(starts.len() / 2);
    Ok(vec![orbits, second])
}

/// Value on a line whose zeros are points of a period, from the images of a point.
fn value(
    line: FixedLine,
    period: usize,
    at: [f64; 2],
    image: impl Fn(usize) -> Option<[f64; 2]>,
) -> Option<f64> {
    let image = |count: usize| if count == 0 { Some(at) } else { image(count) };
    let last = beside(line, image(images(period))?);
    match period.is_multiple_of(2) {
        true => Some(last),
        false => Some(last + beside(line, image(period / 2)?)),
    }
}

struct Search<'s> {
    map: &'s SectionMap<'s>,
    /// Lines whose reversors the section has.
    kept: Vec<FixedLine>,
    found: SymmetricOrbits,
    /// Points of all orbits that were found.
    known: Vec<[f64; 2]>,
}

impl Search<'_> {
    /// Looks for a point of a period between two points of a line.
    fn look(
        &mut self,
        line: FixedLine,
        period: usize,
        ends: [&SectionOrbit; 2],
    ) -> Result<(), FlowError> {
        let at_end = |orbit: &SectionOrbit| {
            let image = |count: usize| orbit.crossings.get(count - 1).map(|met| met.at);
            value(line, period, orbit.start, image)
        };
        let [Some(first), Some(last)] = ends.map(at_end) else { return Ok(()) };
        if (first > 0.0) == (last > 0.0) || first.abs().max(last.abs()) < ZERO {
            return Ok(());
        }
        let Some(at) = self.zero(line, period, ends.map(|orbit| orbit.start), [first, last])?
        else {
            return Ok(());
        };
        if self.is_known(at) || !self.is_mirrored(line, period, at)? {
            return Ok(());
        }
        let point = match self.map.periodic(at, period) {
            Ok(point) if distance(point.at, at) < SAME => point,
            Err(FlowError::Stopped) => return Err(FlowError::Stopped),
            _ => {
                self.found.unconfirmed += 1;
                return Ok(());
            }
        };
        let mut points = vec![point.at];
        for count in 1..period {
            let image = self.map.image(point.at, count)?.0;
            if distance(image, point.at) < SAME {
                // Its own period is shorter, and was looked for before.
                return Ok(());
            }
            points.push(image);
        }
        let lines = self.kept.iter().copied().filter(|line| {
            points.iter().any(|other| distance(*other, mirrored(*line, point.at)) < SAME)
        });
        let lines = lines.collect();
        let cycle = self.map.cycle(point.at, period);
        match cycle.and_then(|(point, cycle)| Ok((point, cycle.supported()?))) {
            Ok((point, cycle)) => {
                self.found.orbits.push(SymmetricOrbit { point, cycle, lines });
                self.known.extend(points);
            }
            Err(FlowError::Stopped) => return Err(FlowError::Stopped),
            Err(_) => self.found.unconfirmed += 1,
        }
        Ok(())
    }

    /// Whether the reversor takes Φᵏx to Φᵏ⁺¹x, for the period 2k + 1; one coordinate was solved for.
    fn is_mirrored(&self, line: FixedLine, period: usize, at: [f64; 2]) -> Result<bool, FlowError> {
        if period.is_multiple_of(2) {
            return Ok(true);
        }
        let before = match period / 2 {
            0 => at,
            count => self.map.image(at, count)?.0,
        };
        let behind = self.map.image(at, images(period))?.0;
        Ok(distance(mirrored(line, before), behind) < CLOSE)
    }

    fn is_known(&self, at: [f64; 2]) -> bool {
        self.known.iter().any(|other| distance(*other, at) < SAME)
    }

    /// Zero between two points of a line, by false position with halved ends; `None` where the value
    /// jumps.
    fn zero(
        &self,
        line: FixedLine,
        period: usize,
        [first, last]: [[f64; 2]; 2],
        [mut below, mut above]: [f64; 2],
    ) -> Result<Option<[f64; 2]>, FlowError> {
        let at = |share: f64| [0, 1].map(|k| first[k] + share * (last[k] - first[k]));
        let size = below.abs().max(above.abs());
        let (mut low, mut high, mut side) = (0.0f64, 1.0f64, 0i32);
        let mut best = (f64::INFINITY, 0.0);
        for _ in 0..MOST_STEPS {
            if (high - low).abs() < f64::EPSILON {
                break;
            }
            let mut share: f64 = (low * above - high * below) / (above - below);
            if !(share > low && share < high) || side.abs() > 3 {
                share = (low + high) / 2.0;
                side = 0;
            }
            let image = |count: usize| self.map.image(at(share), count).ok().map(|found| found.0);
            let Some(value) = value(line, period, at(share), image) else { return Ok(None) };
            if value.abs() < best.0 {
                best = (value.abs(), share);
            }
            if value.abs() < 4.0 * f64::EPSILON {
                break;
            }
            if (value > 0.0) == (below > 0.0) {
                (low, below) = (share, value);
                above = if side > 0 { above / 2.0 } else { above };
                side = side.max(0) + 1;
            } else {
                (high, above) = (share, value);
                below = if side < 0 { below / 2.0 } else { below };
                side = side.min(0) - 1;
            }
        }
        Ok((best.0 < 1e-3 * size).then(|| at(best.1)))
    }
}

impl SectionMap<'_> {
    /// A point at which the reflection about a line is no reversor, with the distance of the images.
    fn refutes(&self, line: FixedLine) -> Result<Option<([f64; 2], f64)>, FlowError> {
        let mut tried = 0;
        let mut problem = None;
        for at in spread(TRIALS) {
            let back =
                self.image(at, 1).and_then(|(image, _)| self.image(mirrored(line, image), 1));
            match back {
                Err(FlowError::Stopped) => return Err(FlowError::Stopped),
                Err(error) => problem = Some(error),
                Ok((back, _)) => {
                    tried += 1;
                    let by = distance(back, mirrored(line, at));
                    if by > ROUNDING {
                        return Ok(Some((at, by)));
                    }
                }
            }
        }
        match problem {
            Some(problem) if tried == 0 => Err(problem),
            _ => Ok(None),
        }
    }
}
