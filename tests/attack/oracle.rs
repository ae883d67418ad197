//! The truth about a claim, as far as states show it.

use std::collections::BTreeMap;

use super::claim::{At, Claim};
use super::expr::{Expr, Function, Tree};
use super::hint;
use super::jet::Place;
use super::lines;
use super::point::Point;
use super::random::Stream;
use super::real::{self, LADDER, Lack, with_bits};
use super::scene::Scene;
use super::scout::{self, Sight};
use super::seek;

/// Results at states for a claim.
#[derive(Clone, Debug, Default)]
pub struct Survey {
    /// Number of states at which the residual is 0.
    pub zero: usize,
    /// States at which the residual is 0.
    kept: Vec<Point>,
    /// Number of states at which the residual is not 0.
    pub off: usize,
    /// Number of states at which the residual is not 0, but has no value at states around them.
    pub lone: usize,
    /// Number of states at which the claim is undefined.
    pub lacking: usize,
    /// Number of undecided states.
    pub unsure: usize,
}

/// Number of states at which zeros are tested in more bits.
const SHARPENED: usize = 2;
/// Effort of a search that follows lines, before a verdict counts as wrong.
const THOROUGH: usize = 6;
/// Distances from a state, in shares of the ranges, at which it is asked whether it is alone; with
/// the number of directions.
const AROUND: [f64; 12] =
    [1e-14, 1e-11, 1e-8, 1e-6, 1e-4, 1e-3, 1e-17, 1e-21, 1e-26, 1e-32, 1e-38, 1e-45];
const DIRECTIONS: u64 = 48;

/// Whether a state at which the claim fails has no states around it at which it fails, so that it
/// lies in no open set of states and is not at the edge of one.
fn is_lone(scene: &Scene, claim: &Claim, point: &Point) -> bool {
    let free = scene.free();
    let fails = |(around, index): (f64, u64)| {
        let mut stream = Stream::new(0x10_4e, index);
        let beside = free.iter().fold(point.clone(), |point, place| {
            // Steps of some length: a shorter one is lost in rounding, and ends where it began.
            let share = 2.0 * stream.unit() - 1.0;
            point.beside(*place, around * (share + share.signum()) / 2.0)
        });
        matches!(claim.settled(scene, &|| scene.values(&beside)), Some(At::Off(_)))
    };
    let mut all = AROUND.into_iter().flat_map(|by| (0..DIRECTIONS).map(move |k| (by, k)));
    !free.is_empty() && !all.any(fails)
}

impl Survey {
    fn look(&mut self, scene: &Scene, claim: &Claim, point: &Point) {
        match claim.settled(scene, &|| scene.values(point)) {
            Some(At::Zero) => {
                self.zero += 1;
                self.kept.push(point.clone());
            }
            // √(y√x) has a value at x = 0 for y < 0, too, and at no state nearby.
            Some(At::Off(_)) if is_lone(scene, claim, point) => self.lone += 1,
            Some(At::Off(_)) => self.off += 1,
            Some(At::Without(Lack::Value)) => self.lacking += 1,
            Some(At::Without(Lack::Decision | Lack::Digits)) => self.unsure += 1,
            None => {}
        }
    }

    /// Tests the last states at which the residual is 0 in more bits.
    fn sharpen(&mut self, scene: &Scene, claim: &Claim) {
        for point in std::mem::take(&mut self.kept).iter().rev().take(SHARPENED) {
            let values = || scene.values(point).map(|values| claim.at(scene, &values));
            if let Some(At::Off(_)) = with_bits(LADDER[1], values) {
                let count =
                    if is_lone(scene, claim, point) { &mut self.lone } else { &mut self.off };
                (*count, self.zero) = (*count + 1, self.zero - 1);
            }
        }
    }

    /// Whether the claim is undefined at all states tested.
    pub fn is_void(&self) -> bool {
        self.zero == 0 && self.off == 0 && self.lone == 0 && self.unsure == 0
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

/// Number of states drawn evenly at which the claim has a value, and fails by more than the rounding
/// of `bits` bits.
pub fn visibly(
    scene: &Scene,
    claim: &Claim,
    stream: &mut Stream,
    states: usize,
    bits: usize,
) -> (usize, usize) {
    let (mut valued, mut off) = (0, 0);
    for _ in 0..states {
        let point = scene.point(stream, false);
        let at = || scene.values(&point).map(|values| claim.at(scene, &values));
        let found = at();
        if matches!(found, Some(At::Off(_) | At::Zero)) {
            valued += 1;
        }
        if matches!(found, Some(At::Off(_))) {
            off += usize::from(matches!(with_bits(bits, at), Some(At::Off(_))));
        }
    }
    (valued, off)
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
        let (void, valued): (Vec<Survey>, Vec<Survey>) = surveys.partition(Survey::is_void);
        // On a branch at the corner of a modulus its slope is none; |w| − |w| may have one there.
        let is_doubtful = !void.is_empty() && may_be_flat(&scene, claim);
        let mixed = (is_doubtful || valued.iter().any(|survey| survey.off > 0))
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

/// Whether a rate or a slope may exist where those of its formula do not: |X| is 0 along a level on
/// which X vanishes, and has a corner there.
pub fn may_be_flat(scene: &Scene, claim: &Claim) -> bool {
    let is_modulus = |node: &Expr| matches!(node, Expr::Of(Function::Modulus, _));
    let mut trees = claim.trees().into_iter();
    scene.level.is_some()
        && !matches!(claim, Claim::Identity(..))
        && trees.any(|tree| tree.any(&mut |node| is_modulus(node)))
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
    if effort >= THOROUGH {
        for point in lines::between_zeros(scene, &trees(scene, claim), stream, (effort, false)) {
            survey.look(scene, claim, &point);
            if survey.off > 0 {
                return survey;
            }
        }
    }
    if effort > 1 {
        survey.sharpen(scene, claim);
    }
    survey
}

/// Finds points of each cell, cells without undefined values first.
fn cells(scene: &Scene, claim: &Claim, stream: &mut Stream, effort: usize) -> Vec<Vec<Point>> {
    const EACH: usize = 2;
    let trees = trees(scene, claim);
    let sight = |point: &Point| -> Option<Sight> {
        let values = scene.rough_values(point)?;
        Some(scout::sight(trees.iter().copied(), &values))
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
    // Thin cells are searched for.
    let starts = match effort {
        0 | 1 => (0, 0),
        2 => (1, 12),
        _ => (effort, 120),
    };
    for point in seek::thin(scene, &trees, stream, starts) {
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

/// All formulas on which the value of a claim depends.
fn trees<'t>(scene: &'t Scene, claim: &'t Claim) -> Vec<&'t Tree> {
    let level = scene.level.iter().flat_map(|level| &level.equations);
    let field = scene.field.iter().map(|(_, rate)| rate);
    let own = claim.trees().into_iter();
    own.chain(field).chain(scene.formulas()).chain(level.flat_map(|(a, b)| [a, b])).collect()
}

/// Numbers of states at which an expression is certainly positive, certainly negative, and of a sign
/// that is not decided.
#[derive(Clone, Copy, Debug, Default)]
pub struct Signs {
    pub positive: usize,
    pub negative: usize,
    pub undecided: usize,
}

impl Signs {
    fn add(&mut self, other: Self) {
        self.positive += other.positive;
        self.negative += other.negative;
        self.undecided += other.undecided;
    }
}

/// Counts the signs of an expression at random states.
pub fn signs(
    scene: &Scene,
    tree: &Tree,
    stream: &mut Stream,
    states: usize,
    near_ends: bool,
) -> Signs {
    let points = (0..states).map(|_| scene.point(stream, near_ends)).collect::<Vec<_>>();
    signs_at(scene, tree, &points)
}

/// Counts the signs of an expression at states found by descents from so many points; enough if there
/// are both.
pub fn thin_signs(
    scene: &Scene,
    tree: &Tree,
    stream: &mut Stream,
    (starts, steps): (usize, usize),
) -> Signs {
    let mut all = Signs::default();
    for start in 0..starts {
        let from = scene.point(stream, start % 3 == 2);
        let points = seek::of_each_sign(scene, tree, from, steps);
        let found = signs_at(scene, tree, &points);
        all.add(found);
        if all.positive.min(all.negative) > 0 {
            return all;
        }
    }
    if starts >= THOROUGH {
        let found =
            signs_at(scene, tree, &lines::between_zeros(scene, &[tree], stream, (THOROUGH, true)));
        all.add(found);
    }
    all
}

fn signs_at(scene: &Scene, tree: &Tree, points: &[Point]) -> Signs {
    let mut all = Signs::default();
    for point in points {
        match hint::sign(scene, point, tree) {
            Some(1) => {
                all.positive += 1;
                continue;
            }
            Some(_) => {
                all.negative += 1;
                continue;
            }
            None => {}
        }
        let Some(values) = scene.values(point) else { continue };
        let value = (Place { values: &values, along: &[] }).value(tree);
        if scene.lack_elsewhere(&values, &[tree]).is_err() {
            continue;
        }
        match value.and_then(|value| real::sure_sign(&value)) {
            Ok(1) => all.positive += 1,
            Ok(-1) => all.negative += 1,
            Err(Lack::Decision) => all.undecided += 1,
            _ => {}
        }
    }
    all
}
