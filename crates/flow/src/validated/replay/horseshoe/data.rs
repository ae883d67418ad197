//! Numbers of a proof of a horseshoe, as certificates hold them.

use crate::validated::Obstacle;
use std::collections::BTreeSet;

/// Largest order of a series, and largest number of sets.
const MOST_ORDER: usize = 60;
const MOST_SETS: usize = 40_000;

/// Numbers of a proof of a horseshoe: whatever they are, the replay decides whether they prove one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HorseshoeData {
    /// Orders of the series from points, and of those from boxes.
    pub orders: [usize; 2],
    /// Indices of the conserved functions in use: the level's, the energy, further integrals.
    pub functions: Vec<usize>,
    /// Values of these functions; not read where the case fixes them.
    pub values: Vec<f64>,
    /// Sets, the one at the saddle first.
    pub sets: Vec<CoveringSet>,
    /// Pairs of sets of which the first covers the second.
    pub relations: Vec<[usize; 2]>,
}

/// Rectangle on a surface across the motion, with the leg that leaves it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CoveringSet {
    /// Point o of the plane (n, x - o) = 0.
    pub origin: Vec<f64>,
    /// Vector n.
    pub normal: Vec<f64>,
    /// Rows of L: the coordinates are L (x - o), the unstable one first.
    pub rows: [Vec<f64>; 2],
    /// Approximate state at the middle of the rectangle.
    pub centre: Vec<f64>,
    /// Middle of the rectangle.
    pub middle: [f64; 2],
    /// Half its sides.
    pub half: [f64; 2],
    /// Middle and radius of the window of times in which motions meet the next surface.
    pub time: [f64; 2],
    /// Radius ρ of the norm in which the tails of the leg are bounded.
    pub tail: f64,
}

/// Loops of covering relations that begin and end at the first set.
#[derive(Clone, Debug, PartialEq)]
pub struct Loops {
    /// Sets of the short loop in order; the last covers the first set, and the first of `long`.
    pub short: Vec<usize>,
    /// Sets of the long loop that the short one does not have, in order.
    pub long: Vec<usize>,
    /// First of these sets.
    pub branch: usize,
}

/// Complaint about a part of the data.
pub fn complaint(place: String, problem: &'static str) -> Obstacle {
    Obstacle::Part { place, problem }
}

/// Complaint about a set, or about a part of it.
pub fn about_set(set: usize, part: &str, problem: &'static str) -> Obstacle {
    let dot = if part.is_empty() { "" } else { "." };
    complaint(format!("proof.sets[{set}]{dot}{part}"), problem)
}

impl HorseshoeData {
    /// Checks that numbers are finite and lists as long as they have to be.
    pub fn check(&self, n: usize) -> Result<(), Obstacle> {
        if !self.orders.iter().all(|order| (2..=MOST_ORDER).contains(order)) {
            return Err(complaint("proof.orders".to_string(), "is out of range"));
        }
        if self.sets.is_empty() || self.sets.len() > MOST_SETS {
            return Err(complaint("proof.sets".to_string(), "is empty or too long"));
        }
        if !self.values.iter().all(|x| x.is_finite()) {
            return Err(complaint("proof.values".to_string(), "is not finite"));
        }
        self.sets.iter().enumerate().try_for_each(|(index, set)| {
            let vectors = [
                ("origin", &set.origin),
                ("normal", &set.normal),
                ("rows[0]", &set.rows[0]),
                ("rows[1]", &set.rows[1]),
                ("centre", &set.centre),
            ];
            for (part, vector) in vectors {
                if vector.len() != n || !vector.iter().all(|x| x.is_finite()) {
                    return Err(about_set(index, part, "has not one number for each component"));
                }
            }
            let [time, window] = set.time;
            let is_positive = |x: f64| x.is_finite() && x > 0.0;
            let parts = [
                ("middle", set.middle.iter().all(|x| x.is_finite())),
                ("half", set.half.iter().all(|x| is_positive(*x))),
                ("time", is_positive(window) && time.is_finite() && time > window),
                ("tail", is_positive(set.tail)),
            ];
            match parts.iter().find(|(_, is_good)| !is_good) {
                Some((part, _)) => {
                    Err(about_set(index, part, "is not finite, not positive or too wide"))
                }
                None => Ok(()),
            }
        })
    }

    /// Orders the sets by the relations: from the first set each set covers one other, but for the
    /// last set of the short loop, which covers two, the first set and one on the same surface.
    pub fn loops(&self) -> Result<Loops, Obstacle> {
        let whole = |problem| complaint("proof.relations".to_string(), problem);
        let mut targets: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); self.sets.len()];
        for (index, [from, to]) in self.relations.iter().enumerate() {
            let place = || format!("proof.relations[{index}]");
            if *to >= self.sets.len() {
                return Err(complaint(place(), "names a set that is not there"));
            }
            let targets = targets.get_mut(*from);
            match targets.map(|own| own.insert(*to)) {
                Some(true) => {}
                Some(false) => return Err(complaint(place(), "is stated twice")),
                None => return Err(complaint(place(), "names a set that is not there")),
            }
        }
        let mut seen = vec![false; self.sets.len()];
        // Follows sets that cover one other alone, until the first set or a set that covers more.
        let mut walk = |from: usize| {
            let (mut path, mut at) = (Vec::new(), from);
            loop {
                if std::mem::replace(&mut seen[at], true) {
                    return Err(whole("lead back to a set other than the first"));
                }
                path.push(at);
                match targets[at].first() {
                    Some(0) | None => return Ok(path),
                    Some(next) if targets[at].len() == 1 => at = *next,
                    Some(_) => return Err(whole("branch where no loop ends")),
                }
            }
        };
        let short = walk(0)?;
        let ends = |path: &[usize]| path.last().map_or(Vec::new(), |at| targets_of(&targets[*at]));
        let branch = match ends(&short).as_slice() {
            [0, branch] => *branch,
            _ => return Err(whole("have no two loops through the first set")),
        };
        let long = walk(branch)?;
        if ends(&long) != [0] {
            return Err(whole("have no two loops through the first set"));
        }
        match seen.iter().position(|seen| !seen) {
            Some(set) => Err(about_set(set, "", "is in no loop")),
            None => Ok(Loops { short, long, branch }),
        }
    }
}

fn targets_of(targets: &BTreeSet<usize>) -> Vec<usize> {
    targets.iter().copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn loops(count: usize, relations: &[[usize; 2]]) -> Result<Loops, String> {
        let sets = vec![CoveringSet::default(); count];
        let data = HorseshoeData { sets, relations: relations.to_vec(), ..Default::default() };
        data.loops().map_err(|obstacle| obstacle.to_string())
    }

    #[test]
    fn two_loops_from_the_first_set() {
        let one = loops(2, &[[0, 0], [0, 1], [1, 0]]).expect("Smale's");
        assert_eq!((one.short, one.long), (vec![0], vec![1]));
        let relations = [[2, 3], [0, 1], [1, 0], [1, 2], [3, 4], [4, 0]];
        let found = loops(5, &relations).expect("in any order");
        assert_eq!((found.short, found.long), (vec![0, 1], vec![2, 3, 4]));
        for left_out in 0..relations.len() {
            let mut fewer = relations.to_vec();
            fewer.remove(left_out);
            assert!(loops(5, &fewer).is_err(), "{left_out} is left out");
        }
    }

    #[test]
    fn other_graphs_are_refused() {
        let cases: [(&str, usize, &[[usize; 2]]); 9] = [
            ("one loop", 2, &[[0, 1], [1, 0]]),
            ("no loop", 2, &[[0, 1]]),
            ("nothing", 1, &[]),
            ("a loop without the first set", 3, &[[0, 1], [1, 2], [2, 1], [1, 0]]),
            ("three loops", 3, &[[0, 0], [0, 1], [0, 2], [1, 0], [2, 0]]),
            ("a branch of the second loop", 4, &[[0, 0], [0, 1], [1, 2], [1, 3], [2, 0], [3, 0]]),
            ("a set in no loop", 3, &[[0, 0], [0, 1], [1, 0]]),
            ("twice the same", 2, &[[0, 0], [0, 1], [1, 0], [1, 0]]),
            ("a set that is not there", 2, &[[0, 0], [0, 1], [1, 2], [1, 0]]),
        ];
        for (name, count, relations) in cases {
            assert!(loops(count, relations).is_err(), "{name}");
        }
    }
}
