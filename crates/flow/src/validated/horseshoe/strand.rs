//! Strands of legs along a chain, enclosed over rectangles that are large enough.

use super::super::enclosure::Enclosure;
use super::super::functions::norm;
use super::super::replay::CoveringSet;
use super::super::shooting::Shooting;
use super::PathProblem;
use super::chain::{Chain, Directions, Link};
use super::chart::{SurfaceChart, are_joined};
use super::cover::{PlaneMap, Rectangle};
use super::legs::{Crossed, Leg, crossed};
use super::saddle::Saddle;
use super::sets::fitted;

/// Number of times that the rectangles are enlarged, by a factor above what they need.
const ENLARGED: usize = 8;
const GROWTH: f64 = 1.1;
/// Expected error of the image of a node.
const GAP: f64 = 1e-15;
/// Room of the first rectangles against what the linear map needs.
const FIRST: f64 = 1.15;

/// Legs of a chain with rectangles over which they are enclosed.
pub struct Strand<'s> {
    pub charts: Vec<&'s SurfaceChart>,
    pub centres: Vec<&'s [f64]>,
    /// Coordinates of the first centre.
    pub middle: [f64; 2],
    pub times: &'s [f64],
    pub late: Vec<[f64; 2]>,
    pub speeds: Vec<f64>,
    /// Chart after the last leg.
    pub last: &'s SurfaceChart,
}

impl<'s> Strand<'s> {
    fn legs(&self, known: &[[f64; 2]]) -> Vec<Leg<'s>> {
        let next = |k: usize| self.charts.get(k + 1).copied().unwrap_or(self.last);
        let leg = |(k, half): (usize, &[f64; 2])| Leg {
            chart: self.charts[k],
            centre: self.centres[k],
            rectangle: Rectangle {
                middle: if k == 0 { self.middle } else { [0.0, 0.0] },
                half: *half,
            },
            time: self.times[k],
            late: self.late[k],
            speed: self.speeds[k],
            next: next(k),
        };
        known.iter().enumerate().map(leg).collect()
    }

    /// Encloses all maps over rectangles that are large enough for the sizes that fit. The first
    /// rectangle has at least the half sides `first`.
    pub fn enclosed(
        &self,
        shooting: &Shooting,
        guess: Vec<[f64; 2]>,
        first: [f64; 2],
        last: &Rectangle,
    ) -> Result<(Vec<Crossed>, Vec<[f64; 2]>), PathProblem> {
        let mut known = guess;
        known[0] = [known[0][0].max(first[0]), known[0][1].max(first[1])];
        let mut found = crossed(shooting, &self.legs(&known)).map_err(PathProblem::Leg)?;
        for _ in 0..ENLARGED {
            let maps: Vec<PlaneMap> = found.iter().map(|one| one.map).collect();
            let halves = fitted(&maps, &known, first[1], last);
            if !halves.iter().flatten().all(|x| x.is_finite() && *x > 0.0) {
                return Err(PathProblem::Fit);
            }
            let mut enlarged = Vec::new();
            for (place, (known, half)) in known.iter_mut().zip(&halves).enumerate() {
                let before = *known;
                for (known, half) in known.iter_mut().zip(half) {
                    if half > known {
                        *known = GROWTH * half;
                    }
                }
                if *known != before {
                    enlarged.push(place);
                }
            }
            if enlarged.is_empty() {
                return Ok((found, halves));
            }
            // The others are known over their rectangles.
            let legs = self.legs(&known);
            let legs: Vec<Leg<'_>> = enlarged.iter().map(|place| legs[*place]).collect();
            let again = crossed(shooting, &legs).map_err(PathProblem::Leg)?;
            enlarged.into_iter().zip(again).for_each(|(place, own)| found[place] = own);
        }
        Err(PathProblem::Fit)
    }
}

impl Strand<'_> {
    /// Numbers of a proof by enclosed legs, over rectangles with these half sides.
    pub fn sets(&self, found: &[Crossed], halves: &[[f64; 2]]) -> Vec<CoveringSet> {
        let set = |(k, (leg, half)): (usize, (&Crossed, &[f64; 2]))| {
            let chart = self.charts[k];
            CoveringSet {
                origin: chart.origin.clone(),
                normal: chart.normal.clone(),
                rows: chart.rows.clone(),
                centre: self.centres[k].to_vec(),
                middle: if k == 0 { self.middle } else { [0.0, 0.0] },
                half: *half,
                time: [leg.time.mid, leg.time.rad],
                tail: leg.tail,
            }
        };
        found.iter().zip(halves).enumerate().map(set).collect()
    }
}

/// Whether each leg ends at the states from which the next starts; `after` are the last ones.
pub fn are_linked(
    shooting: &Shooting,
    strand: &Strand<'_>,
    found: &[Crossed],
    after: &[Enclosure],
) -> bool {
    let next = |k: usize| match found.get(k + 1) {
        Some(next) => (strand.charts[k + 1], next.states.as_slice()),
        None => (strand.last, after),
    };
    found.iter().enumerate().all(|(k, own)| {
        let (chart, states) = next(k);
        are_joined(shooting, chart, &own.ends, states)
    })
}

/// Changes of the times of links with coordinates along the directions.
pub fn late(links: &[Link], directions: &Directions) -> Vec<[f64; 2]> {
    let along = |link: &Link, e: &[f64; 2]| link.late[0] * e[0] + link.late[1] * e[1];
    let ends = directions.unstable.iter().zip(&directions.stable);
    links.iter().zip(ends).map(|(link, (u, s))| [along(link, u), along(link, s)]).collect()
}

/// Speeds at the nodes.
pub fn speeds(shooting: &Shooting, chain: &Chain) -> Vec<f64> {
    chain.fields(shooting).iter().map(|field| norm(field)).collect()
}

/// Half sides that the maps of a chain are expected to need: stable ones from the first,
/// unstable ones from the last. `bend` is the change of a slope with the sides.
pub fn guessed(directions: &Directions, stable: f64, unstable: f64, bend: f64) -> Vec<[f64; 2]> {
    let squeezed = Saddle::growth(&directions.squeeze);
    let stretched = Saddle::growth(&directions.stretch);
    let whole = stretched[stretched.len() - 1];
    let mut halves: Vec<[f64; 2]> = (0..directions.stretch.len())
        .map(|k| [unstable * stretched[k] / whole, stable * squeezed[k]])
        .collect();
    let (mut above, mut below) = (0.0, 0.0);
    for (half, stretch) in halves.iter_mut().zip(&directions.stretch).rev() {
        above = (above + bend * half[1] * half[1] + GAP) / stretch;
        half[0] += above;
    }
    for (half, squeeze) in halves.iter_mut().zip(&directions.squeeze) {
        half[1] += below;
        below = below * squeeze + bend * half[0] * half[0] + GAP;
    }
    halves.iter().map(|half| half.map(|x| FIRST * x)).collect()
}

/// Largest change of a slope with the sides of the rectangles.
pub fn bend(maps: &[PlaneMap], known: &[[f64; 2]]) -> f64 {
    let of = |(map, half): (&PlaneMap, &[f64; 2])| {
        let [[_, shear], [other, _]] = map.slopes;
        shear.rad.max(other.rad) / (half[0] + half[1])
    };
    maps.iter().zip(known).map(of).fold(0.0, f64::max)
}
