//! Search for homoclinic orbits of a saddle, in f64: motions that leave along the unstable
//! direction and come back on the stable curve.
//!
//! Motions start along one fundamental domain of the unstable curve, on both sides, and their
//! crossings of the saddle's surface near it are recorded. Where the unstable coordinate of a
//! crossing changes its sign from one start to the next there is a homoclinic orbit between them.

#![allow(clippy::needless_range_loop, reason = "lanes index several arrays at once")]

use super::super::Obstacle;
use super::super::shooting::Shooting;
use super::chain::{distance, settle};
use super::saddle::Saddle;
use super::vectors::plus;
use crate::motion::recorded::program;
use crate::motion::start::Start;
use crate::taylor::batch::MOTION_LANES;
use crate::taylor::event::{Event, Sides};
use crate::taylor::lanes::Lanes;
use crate::taylor::program::TaylorProgram;
use crate::taylor::stepper::{Accuracy, Stepper};
use liouville::graph::Expr;
use liouville::mechanics::Model;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::scalar::Scalar;

/// Distance of the first starts against the saddle's state.
const BEGIN: f64 = 1e-3;
/// Looks at motions: the next is taken where the one before finds nothing.
const LOOKS: [Look; 2] =
    [Look { near: 0.05, starts: 200, ways: 0.0 }, Look { near: 0.15, starts: 400, ways: 2.0 }];
/// Number of periods for which motions are followed, without the ways away from the saddle and back.
const PERIODS: f64 = 10.0;
/// Number of homoclinic orbits after which no others are looked for.
const MOST_FOUND: usize = 4;
/// Share of a period by which crossings of neighbouring motions may differ in time.
const ABREAST: f64 = 0.1;
/// Share of a period between two crossings near the saddle beyond which a motion was away.
const AWAY: f64 = 1.5;
/// Number of rounds of refinement, by a factor of `MOTION_LANES` + 1 each.
const ROUNDS: usize = 14;

/// Extent of a search.
#[derive(Clone, Copy, Debug)]
struct Look {
    /// Largest distance of crossings against the saddle's state. Far from the saddle its stable curve
    /// bends, and a zero found there may be none.
    near: f64,
    /// Number of starts on each side.
    starts: usize,
    /// Number of ways between the first starts and this distance that motions have time for.
    ways: f64,
}

/// Crossing of the saddle's surface near the saddle.
#[derive(Clone, Debug)]
struct SaddleCrossing {
    time: f64,
    at: [f64; 2],
    /// Whether the motion was away before.
    returned: bool,
}

/// Homoclinic orbit, approximately.
#[derive(Clone, Copy, Debug)]
pub struct Homoclinic {
    /// Distance of its start along the unstable direction.
    pub start: f64,
    /// Time to its crossing near the saddle.
    pub time: f64,
    /// Distance of that crossing along the stable direction.
    pub end: f64,
}

/// Motions from a saddle's surface.
pub struct Seeker<'s> {
    shooting: &'s Shooting,
    saddle: &'s Saddle,
    program: TaylorProgram,
    /// Size of the saddle's state.
    size: f64,
}

impl<'s> Seeker<'s> {
    /// Compiles the field with the function that vanishes on the surface.
    pub fn new(
        model: &Model,
        start: &Start,
        shooting: &'s Shooting,
        saddle: &'s Saddle,
    ) -> Result<Self, Obstacle> {
        let home = &saddle.home;
        let number = |x: f64| Expr::rational(&Rational::from_f64(x).unwrap_or(Rational::from(0)));
        let program = program(model, &start.parameters, |phase| {
            let state = phase.state();
            let zero = number(0.0);
            let terms = state.iter().zip(&home.normal).zip(&home.origin);
            vec![terms.fold(zero, |sum, ((x, n), o)| sum + number(*n) * (*x - number(*o)))]
        })?;
        let size = home.origin.iter().map(|x| x * x).sum::<f64>().sqrt();
        Ok(Self { shooting, saddle, program, size })
    }

    /// State at a distance along the unstable direction.
    pub fn start(&self, along: f64) -> Vec<f64> {
        let home = &self.saddle.home;
        let mut state = plus(&home.origin, along, &home.axes[0]);
        settle(self.shooting, &mut state);
        state
    }

    /// Finds homoclinic orbits, the shortest first.
    pub fn find(&self) -> Result<Vec<Homoclinic>, Obstacle> {
        for look in LOOKS {
            let (found, come_back) = self.found(look)?;
            // Where most of one side come back, the curves are one, and more motions show no more.
            if !found.is_empty() || come_back {
                return Ok(found);
            }
        }
        Ok(Vec::new())
    }

    /// The same by one look; returns too whether most of the motions of a side come back near the saddle.
    fn found(&self, look: Look) -> Result<(Vec<Homoclinic>, bool), Obstacle> {
        let (begin, count) = (BEGIN * self.size, look.starts);
        let growth = self.saddle.multipliers[0].abs();
        let starts: Vec<f64> = [1.0, -1.0]
            .iter()
            .flat_map(|side| {
                (0..=count).map(move |k| side * begin * libm::pow(growth, k as f64 / count as f64))
            })
            .collect();
        let crossings = self.crossings(&starts, look)?;
        let mut pairs = Vec::new();
        for (index, pair) in crossings.windows(2).enumerate().filter(|(index, _)| *index != count) {
            for crossing in pair[0].iter().filter(|crossing| crossing.returned) {
                let Some(other) = self.partner(crossing, &pair[1]) else { continue };
                if other.at[0] * crossing.at[0] <= 0.0 {
                    pairs.push((index, crossing, other));
                }
            }
        }
        pairs.order_by(|(_, a, _), (_, b, _)| a.time.total_cmp(&b.time));
        let mut all = Vec::new();
        for (index, crossing, other) in pairs {
            if all.len() == MOST_FOUND {
                break;
            }
            let ends = [starts[index], starts[index + 1]];
            all.extend(self.refined(ends, [crossing, other], look)?);
        }
        all.order_by(|a: &Homoclinic, b| a.time.total_cmp(&b.time));
        let back = |side: &[Vec<SaddleCrossing>]| {
            2 * side.iter().filter(|own| own.iter().any(|one| one.returned)).count() > side.len()
        };
        Ok((all, crossings.chunks(count + 1).any(back)))
    }

    /// Crossing of another motion at about the same time.
    fn partner<'c>(
        &self,
        crossing: &SaddleCrossing,
        others: &'c [SaddleCrossing],
    ) -> Option<&'c SaddleCrossing> {
        let late = |other: &SaddleCrossing| (other.time - crossing.time).abs();
        let nearest = others.iter().min_by(|a, b| late(a).total_cmp(&late(b)))?;
        (nearest.returned && late(nearest) < ABREAST * self.saddle.period()).then_some(nearest)
    }

    /// Narrows the starts down to the zero of the unstable coordinate.
    fn refined(
        &self,
        ends: [f64; 2],
        crossings: [&SaddleCrossing; 2],
        look: Look,
    ) -> Result<Option<Homoclinic>, Obstacle> {
        let [mut from, mut to] = ends;
        let [mut left, mut right] = crossings.map(Clone::clone);
        for _ in 0..ROUNDS {
            let inner: Vec<f64> = (1..=MOTION_LANES)
                .map(|k| from + (to - from) * k as f64 / (MOTION_LANES + 1) as f64)
                .collect();
            let found = self.crossings(&inner, look)?;
            for (start, crossings) in inner.iter().zip(&found) {
                let Some(crossing) = self.partner(&left, crossings) else { return Ok(None) };
                if (crossing.at[0] > 0.0) == (left.at[0] > 0.0) {
                    (from, left) = (*start, crossing.clone());
                } else {
                    (to, right) = (*start, crossing.clone());
                    break;
                }
            }
        }
        // Where the two motions end far from each other the coordinate jumps.
        let is_continuous = (left.at[0] - right.at[0]).abs() < 1e-4 * look.near * self.size;
        let (start, time, end) = ((from + to) / 2.0, left.time, left.at[1]);
        Ok(is_continuous.then_some(Homoclinic { start, time, end }))
    }

    /// Follows motions from distances along the unstable direction, and returns their crossings
    /// near the saddle.
    fn crossings(&self, starts: &[f64], look: Look) -> Result<Vec<Vec<SaddleCrossing>>, Obstacle> {
        let near = look.near * self.size;
        let way = libm::log(look.near / BEGIN) / libm::log(self.saddle.multipliers[0].abs());
        let until = (PERIODS + look.ways * way) * self.saddle.period();
        let mut stepper = Stepper::<Lanes<MOTION_LANES>>::new(&self.program, Accuracy::FLOAT);
        let mut found = Vec::new();
        for group in starts.chunks(MOTION_LANES) {
            for lane in 0..MOTION_LANES {
                let state = self.start(group[lane.min(group.len() - 1)]);
                let state: Vec<DoubleDouble> =
                    state.into_iter().map(DoubleDouble::from_f64).collect();
                stepper.start(lane, &state, DoubleDouble::from_f64(until));
            }
            let mut sides: Vec<Sides> = vec![Sides::default(); MOTION_LANES];
            let mut tracks: Vec<Vec<SaddleCrossing>> = vec![Vec::new(); MOTION_LANES];
            let mut lost = [false; MOTION_LANES];
            while (0..MOTION_LANES).any(|lane| !lost[lane] && !stepper.is_done(lane)) {
                stepper.expand();
                let ends = stepper.ends(0);
                for lane in 0..MOTION_LANES {
                    if lost[lane] || stepper.is_done(lane) {
                        continue;
                    }
                    match stepper.check(lane) {
                        Ok(()) => {}
                        Err(stopped @ crate::FlowError::Stopped) => return Err(stopped.into()),
                        // A motion that meets a singularity has no further crossings.
                        Err(_) => {
                            lost[lane] = true;
                            continue;
                        }
                    }
                    if !sides[lane].pass(&ends, lane) {
                        self.note(&stepper, (lane, near), &mut sides[lane], &mut tracks[lane]);
                    }
                }
                stepper.advance();
            }
            found.extend(tracks.into_iter().take(group.len()));
        }
        Ok(found)
    }

    /// Records the crossings of a step.
    fn note(
        &self,
        stepper: &Stepper<Lanes<MOTION_LANES>>,
        (lane, near): (usize, f64),
        sides: &mut Sides,
        track: &mut Vec<SaddleCrossing>,
    ) {
        let piece = stepper.piece(lane);
        let doubt = || self.program.rounding::<f64>(0, &stepper.pairs(lane), 0.0);
        for event in sides.events(&piece.output(0), piece.length(), &doubt) {
            let Event::Crossing { after, rising: true } = event else { continue };
            let state: Vec<f64> = piece.state(after).iter().map(|x| x.hi).collect();
            if distance(&state, &self.saddle.home.origin) > near {
                continue;
            }
            let time = piece.begin().hi + after;
            let last = track.last();
            let gap = time - last.map_or(0.0, |last| last.time);
            let returned =
                last.is_some_and(|last| last.returned) || gap > AWAY * self.saddle.period();
            track.push(SaddleCrossing { time, at: self.saddle.home.coordinates(&state), returned });
        }
    }
}
