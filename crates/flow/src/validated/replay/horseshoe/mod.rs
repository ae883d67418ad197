//! Proofs of horseshoes replayed in balls of integers: covering relations of rectangles along a
//! closed orbit and along a homoclinic orbit, both of which begin and end at the first rectangle.

mod cover;
mod data;
mod leg;
mod patch;

pub use data::{CoveringSet, HorseshoeData};

use super::matrix::combined;
use super::number::{ReplayNumber, Wide};
use super::segment::Scripts;
use crate::validated::enclosure::Enclosure;
use crate::validated::functions::Functions;
use crate::validated::horseshoe::{ProvedHorseshoe, entropy, upper};
use crate::validated::motion::EnclosedMotion;
use crate::validated::nearby::Nearby;
use crate::validated::request::moved;
use crate::validated::{Obstacle, Request};
use cover::{ReplayedMap, is_hyperbolic, product};
use data::{about_set, complaint};
use leg::ReplayedLeg;
use liouville::number::UnaryFunction;
use patch::ReplayedPatch;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Number of sets or relations in the works at once.
const AT_ONCE: usize = 128;
/// Share by which the entropy found in f64 is lowered before it is tested.
const LOWERED: f64 = 1e-9;

/// Set with all that its relations need.
struct Covering {
    patch: ReplayedPatch,
    leg: ReplayedLeg,
}

/// Data with the equations that they are to solve.
struct HorseshoeReplay<'r> {
    data: &'r HorseshoeData,
    functions: Functions,
    values: Vec<Wide>,
    scripts: Scripts<'r>,
}

/// Proves the horseshoe of some data again.
///
/// # Errors
/// The data do not belong to the equations, or do not prove that there is a horseshoe.
pub fn replay_horseshoe(
    request: &Request<'_>,
    data: &HorseshoeData,
) -> Result<ProvedHorseshoe, Obstacle> {
    let n = request.model.dimension();
    data.check(n)?;
    let about = |part: &str, problem| complaint(format!("proof.{part}"), problem);
    let functions = Functions::new(&request.laws())?
        .using(&data.functions)
        .ok_or_else(|| about("functions", "are not the conserved functions"))?;
    let kept = functions.len();
    if n != kept + 3 {
        return Err(Obstacle::Dimension(n.saturating_sub(kept)));
    }
    if data.values.len() != kept {
        return Err(about("values", "has not one value for each conserved function"));
    }
    let values = request.values(&functions, &data.values)?.iter().map(Wide::of).collect();
    let motion = EnclosedMotion::new(&request.laws())?;
    let nearby = Nearby::new(&request.laws());
    let [points, boxes] = data.orders;
    let scripts = Scripts::new(&motion, nearby.as_ref(), points, boxes);
    HorseshoeReplay { data, functions, values, scripts }.prove(request)
}

impl HorseshoeReplay<'_> {
    fn covering(&self, index: usize) -> Result<Covering, Obstacle> {
        let set = &self.data.sets[index];
        let patch = set
            .patch(&self.functions, &self.values)
            .ok_or_else(|| about_set(index, "", "is a rectangle whose points are not enclosed"))?;
        let leg = ReplayedLeg::new(&self.scripts, index, set, &patch)?;
        Ok(Covering { patch, leg })
    }

    /// Proves a covering relation, and encloses its map.
    fn relation(&self, index: usize, all: &[Covering]) -> Result<ReplayedMap, Obstacle> {
        let [from, to] = self.data.relations[index];
        let (own, target) = (&self.data.sets[from], &self.data.sets[to]);
        let refused = |problem| complaint(format!("proof.relations[{index}]"), problem);
        let leg = &all[from].leg;
        let map = leg.map(target).ok_or_else(|| {
            about_set(from, "time", "is no window in which the next surface is met once")
        })?;
        if !target.joins(&self.functions, &leg.end, &all[to].patch.states) {
            return Err(refused("leads to points that are not proved to be those of the set"));
        }
        map.covers(own.half, target.middle, target.half).map_err(refused)?;
        Ok(map)
    }

    /// Whether the field is analytic about a leg for all parameters near those of the case.
    fn persists(&self, index: usize, all: &[Covering]) -> bool {
        let CoveringSet { time: [time, window], tail, .. } = &self.data.sets[index];
        self.scripts.persists(&all[index].patch.states, &Wide::about(*time, *window), *tail)
    }

    /// Checks that two sets have one surface, and no point in common.
    fn are_apart(&self, place: usize, all: &[Covering]) -> Result<(), Obstacle> {
        let (home, own) = (&self.data.sets[0], &self.data.sets[place]);
        for (part, is_equal) in
            [("origin", own.origin == home.origin), ("normal", own.normal == home.normal)]
        {
            if !is_equal {
                return Err(about_set(place, part, "is not that of the first set"));
            }
        }
        let [row, _] = &home.rows;
        let patch = &all[place].patch;
        let centre = own.centre.iter().zip(&home.origin).zip(&patch.middle);
        let off: Vec<Wide> = centre
            .map(|((x, o), shift)| Wide::exact(*x).minus(&Wide::exact(*o)).plus(shift))
            .collect();
        let spread =
            |k: usize| combined(row, &patch.slopes[k]).magnitude().mul(&Wide::exact(own.half[k]));
        let at = combined(row, &off).minus(&Wide::exact(home.middle[0]));
        let reach = Wide::exact(home.half[0]).add(&spread(0)).add(&spread(1));
        match reach.is_below(&at) || reach.is_below(&at.neg()) {
            true => Ok(()),
            false => Err(about_set(place, "middle", "is not apart from the first set")),
        }
    }

    /// Proves all relations, each as soon as its two sets are enclosed; the maps by the indices of
    /// the relations.
    fn relations(
        &self,
        branch: usize,
    ) -> Result<(Vec<Covering>, BTreeMap<usize, ReplayedMap>), Obstacle> {
        let data = self.data;
        let (mut all, mut maps) = (Vec::new(), BTreeMap::new());
        while all.len() < data.sets.len() {
            let known = all.len();
            let last = data.sets.len().min(known + AT_ONCE);
            let new: Vec<usize> = (known..last).collect();
            all.extend(each(&new, |index| self.covering(index))?);
            if new.contains(&branch) {
                self.are_apart(branch, &all)?;
            }
            let is_new = |index: &usize| {
                let [from, to] = data.relations[*index];
                new.contains(&from.max(to))
            };
            let ready: Vec<usize> = (0..data.relations.len()).filter(is_new).collect();
            let found = each(&ready, |index| self.relation(index, &all))?;
            maps.extend(ready.into_iter().zip(found));
        }
        Ok((all, maps))
    }

    fn prove(&self, request: &Request<'_>) -> Result<ProvedHorseshoe, Obstacle> {
        let data = self.data;
        let loops = data.loops()?;
        let (all, maps) = self.relations(loops.branch)?;
        let unit = [[1.0, 0.0], [0.0, 1.0]].map(|row| row.map(Wide::exact));
        let whole = loops.short.iter().enumerate().fold(unit, |whole, (place, from)| {
            let to = loops.short.get(place + 1).copied().unwrap_or(0);
            let index = data.relations.iter().position(|own| own == &[*from, to]);
            index.map_or(whole.clone(), |index| product(&maps[&index].slopes, &whole))
        });
        if !is_hyperbolic(&whole) {
            let problem = "have a short loop that is not proved hyperbolic";
            return Err(complaint("proof.relations".to_string(), problem));
        }
        let time = |sets: &[usize]| {
            sets.iter().fold(Wide::zero(), |sum, set| {
                let [time, window] = data.sets[*set].time;
                sum.plus(&Wide::about(time, window))
            })
        };
        let no_entropy = || complaint("proof.sets".to_string(), "have times without a bound");
        let short = time(&loops.short);
        let long = short.plus(&time(&loops.long));
        let start: Vec<Enclosure> = all[0].patch.states.iter().map(Wide::enclosure).collect();
        let times = [short.enclosure(), long.enclosure()];
        Ok(ProvedHorseshoe {
            moved: moved(&start, &request.state(), data.sets.iter().map(|set| &set.centre)),
            start,
            half: data.sets[0].half,
            times,
            entropy: proved_entropy(times.map(upper)).ok_or_else(no_entropy)?,
            relations: data.relations.len(),
            kept: self.functions.len(),
            persists: (0..all.len()).into_par_iter().all(|index| self.persists(index, &all)),
            trace: None,
            data: data.clone(),
        })
    }
}

/// Runs a job for each of some indices; the first complaint.
fn each<T: Send>(
    indices: &[usize],
    job: impl Fn(usize) -> Result<T, Obstacle> + Sync,
) -> Result<Vec<T>, Obstacle> {
    let found: Vec<Result<T, Obstacle>> = indices.par_iter().map(|index| job(*index)).collect();
    found.into_iter().collect()
}

/// Lower bound of the number h > 0 with e^(-h a) + e^(-h b) = 1, tested in many bits.
fn proved_entropy(times: [f64; 2]) -> Option<f64> {
    let h = entropy(times) * (1.0 - LOWERED);
    let sum = times.iter().fold(Wide::zero(), |sum, time| {
        let exponent = Wide::exact(-h).times(&Wide::exact(*time));
        sum.plus(&exponent.apply(UnaryFunction::Exp))
    });
    (h > 0.0 && Wide::exact(1.0).is_below(&sum)).then_some(h)
}
