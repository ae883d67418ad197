//! The truth about a claim, as far as states show it.

use std::collections::BTreeMap;

use super::claim::{At, Claim};
use super::expr::Tree;
use super::jet::Place;
use super::random::Stream;
use super::real::{self, Lack};
use super::scene::{Point, Scene};
use super::scout::{self, Sight};

/// Results at states for a claim.
#[derive(Clone, Debug, Default)]
pub struct Survey {
    /// Number of states at which the residual is 0.
    pub zero: usize,
    /// Number of states at which the residual is not 0, and the first of them.
    pub off: usize,
    pub first: Option<Point>,
    /// Number of states at which the claim is undefined.
    pub lacking: usize,
    /// Number of undecided states.
    pub unsure: usize,
}

impl Survey {
    fn look(&mut self, scene: &Scene, claim: &Claim, point: &Point) {
        let Some(values) = scene.values(point) else { return };
        match claim.at(scene, &values) {
            At::Zero => self.zero += 1,
            At::Off(_) => {
                self.off += 1;
                self.first.get_or_insert_with(|| point.clone());
            }
            At::Without(Lack::Value) => self.lacking += 1,
            At::Without(Lack::Decision) => self.unsure += 1,
        }
    }

    /// Whether the claim is undefined at all states tested.
    pub fn is_void(&self) -> bool {
        self.zero == 0 && self.off == 0 && self.unsure == 0
    }

    /// Share of the states with a value at which the claim fails.
    pub fn share(&self) -> f64 {
        self.off as f64 / (self.off + self.zero).max(1) as f64
    }
}

/// Tests a few states drawn evenly.
pub fn evenly(scene: &Scene, claim: &Claim, stream: &mut Stream, states: usize) -> Survey {
    let mut survey = Survey::default();
    for _ in 0..states {
        let point = scene.point(stream, false);
        survey.look(scene, claim, &point);
    }
    survey
}

/// Tests states in the cells of signs that are found.
///
/// A claim that something does not vanish is made separately for each choice of listed values: the
/// result is the worst among these, without those that leave no state. Different results on the
/// branches of a level leave it open.
pub fn searched(scene: &Scene, claim: &Claim, stream: &mut Stream, effort: usize) -> Survey {
    if !claim.is_negated() {
        return in_cells(scene, claim, stream, effort);
    }
    let mut choices: Vec<Survey> = Vec::new();
    for scene in scene.unlisted() {
        let of_branches = scene.branches().into_iter();
        let surveys = of_branches.map(|branch| in_cells(&branch, claim, stream, effort));
        let valued: Vec<Survey> = surveys.filter(|survey| !survey.is_void()).collect();
        let mixed = valued.iter().any(|survey| survey.off > 0)
            && valued.iter().any(|survey| survey.off == 0);
        match valued.into_iter().next() {
            Some(_) if mixed => choices.push(Survey { unsure: 1, ..Survey::default() }),
            Some(survey) => choices.push(survey),
            None => {}
        }
    }
    choices.sort_by_key(|survey| (survey.off > 0, survey.zero == 0));
    choices.into_iter().next().unwrap_or_default()
}

/// Tests states in the middle of each cell of signs that is found, until one fails or the effort is
/// used up.
pub fn in_cells(scene: &Scene, claim: &Claim, stream: &mut Stream, effort: usize) -> Survey {
    let mut survey = evenly(scene, claim, stream, 8);
    if survey.off > 0 {
        return survey;
    }
    for cell in cells(scene, claim, stream, effort) {
        for point in cell {
            survey.look(scene, claim, &point);
            if survey.off > 0 {
                return survey;
            }
        }
    }
    survey
}

/// Finds points of each cell, cells without undefined values first.
fn cells(scene: &Scene, claim: &Claim, stream: &mut Stream, effort: usize) -> Vec<Vec<Point>> {
    const EACH: usize = 2;
    let sight = |point: &Point| -> Option<Sight> {
        let values = scene.rough_values(point)?;
        Some(scout::sight(claim.trees(), &values))
    };
    let mut cells: BTreeMap<u64, (bool, Vec<Point>)> = BTreeMap::new();
    let mut order: Vec<u64> = Vec::new();
    let mut note = |point: &Point, sight: Sight| {
        let cell = cells.entry(sight.pattern).or_insert_with(|| {
            order.push(sight.pattern);
            (sight.defined, Vec::new())
        });
        if cell.1.len() < EACH {
            cell.1.push(point.clone());
        }
    };
    let mut seen: Vec<(Point, u64)> = Vec::new();
    // A branch of a level may have few states in its ranges.
    for index in 0..600 * effort {
        if index >= 60 * effort && (scene.level.is_none() || seen.len() >= 20 * effort) {
            break;
        }
        let point = scene.point(stream, index % 3 == 2);
        if let Some(found) = sight(&point) {
            note(&point, found);
            seen.push((point, found.pattern));
        }
    }
    // There are further cells between states of different cells.
    for _ in 0..12 * effort {
        if seen.len() < 2 {
            break;
        }
        let (mut a, mut b) = (stream.pick(&seen).clone(), stream.pick(&seen).clone());
        for _ in 0..12 {
            if a.1 == b.1 {
                break;
            }
            let Some(middle) = a.0.between(&b.0) else { break };
            let Some(found) = sight(&middle) else { break };
            note(&middle, found);
            let middle = (middle, found.pattern);
            let keep_low = found.pattern != a.1 && (found.pattern == b.1 || stream.once_in(2));
            if keep_low { b = middle } else { a = middle }
        }
    }
    let mut found: Vec<(bool, Vec<Point>)> =
        order.iter().filter_map(|pattern| cells.remove(pattern)).collect();
    found.sort_by_key(|(defined, _)| !defined);
    // Expressions undefined in f64 may have a value: a few such states are tested too.
    let defined = found.iter().filter(|(defined, _)| *defined).count();
    found.truncate((defined + 10).min(40 * effort));
    found.into_iter().map(|(_, points)| points).collect()
}

/// Number of states at which an expression is positive, and negative.
pub fn signs(
    scene: &Scene,
    tree: &Tree,
    stream: &mut Stream,
    states: usize,
    near_ends: bool,
) -> (usize, usize) {
    let (mut positive, mut negative) = (0, 0);
    for _ in 0..states {
        let point = scene.point(stream, near_ends);
        let Some(values) = scene.values(&point) else { continue };
        match (Place { values: &values, along: &[] }).value(tree).map(|value| real::sign(&value)) {
            Ok(1) => positive += 1,
            Ok(-1) => negative += 1,
            _ => {}
        }
    }
    (positive, negative)
}
