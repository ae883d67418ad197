//! Fixed sets of linear maps on a level, and maps that are the same there.
//!
//! The fixed points of an involution σ are the image of P = (1 + σ)/2. From a drawn state Newton's method
//! leads to a point of F(Px) = 0. Where the gradients P∂F have the same rank r there as around it, the fixed
//! points on the level are a manifold, r dimensions less than that of P, by the theorem on constant rank.

use super::involutions::MapCandidate;
use super::question::FixedSet;
use crate::terms::recorded;
use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::graph::{Evaluator, Tape};
use liouville::number::float::Float;
use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::verdict::Sampler;

/// Number of drawn states.
const STATES: u64 = 3;
/// Largest number of steps of Newton's method.
const MOST_STEPS: usize = 60;
/// Part of the largest value that counts as rounding.
const ROUNDING: f64 = 1e-9;

/// Keeps one of the maps that are the same on the level, the shortest, and none that leaves its points in place.
pub fn distinct_on_level(case: &Case, seed: u64, all: Vec<MapCandidate>) -> Vec<MapCandidate> {
    let Some(states) = states(case, seed).filter(|_| !case.model.level.is_empty()) else {
        return all;
    };
    let images = |own: &MapCandidate| -> Option<Vec<Vec<f64>>> {
        let map = LinearMap::of(case, own)?;
        Some(states.iter().map(|state| map.image(state)).collect())
    };
    let places = || states.iter().map(|own| own.1.clone()).collect::<Vec<_>>();
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.order_by_key(|place| (all[*place].images.len(), *place));
    let mut kept: Vec<(usize, Vec<Vec<f64>>)> = Vec::new();
    for place in order {
        let own = images(&all[place]).unwrap_or_default();
        let is_same = |other: &Vec<Vec<f64>>| {
            other.len() == own.len() && other.iter().zip(&own).all(|(a, b)| are_same(a, b))
        };
        let is_repeated = |(other, images): &(usize, Vec<Vec<f64>>)| {
            all[*other].key == all[place].key && is_same(images)
        };
        if own.is_empty() || !is_same(&places()) && !kept.iter().any(is_repeated) {
            kept.push((place, own));
        }
    }
    let kept: Vec<usize> = kept.into_iter().map(|(place, _)| place).collect();
    let own = all.into_iter().enumerate().filter(|(place, _)| kept.contains(place));
    own.map(|(_, own)| own).collect()
}

/// The fixed points of an involution on the level; `None` where none is found, or their ranks differ.
pub fn on_level(case: &Case, own: &MapCandidate, seed: u64) -> Option<FixedSet> {
    let map = LinearMap::of(case, own)?;
    let dimension = map.fixed_space();
    let level = Level::of(case)?;
    let mut found = None;
    for (parameters, state) in states(case, seed)? {
        let start = map.projected(&state);
        let (values, generic) = level.at(&map, &parameters, &start)?;
        let rank = rank(&generic);
        if rank == 0 && values.iter().any(|own| own.abs() > ROUNDING) {
            // The level functions are constants there, and not 0.
            return Some(FixedSet { dimension: None });
        }
        let end = level.solved(&map, &parameters, start)?;
        let (_, there) = level.at(&map, &parameters, &end)?;
        let own = (self::rank(&there) == rank).then(|| dimension - rank)?;
        if found.is_some_and(|other| other != own) {
            return None;
        }
        found = Some(own);
    }
    Some(FixedSet { dimension: Some(found?) })
}

/// A linear map of the state.
struct LinearMap {
    tape: Tape,
    dimension: usize,
    /// Parameters at which images are computed; signs and orders do not depend on them.
    free: usize,
}

impl LinearMap {
    fn of(case: &Case, own: &MapCandidate) -> Option<Self> {
        let (graph, image) = recorded(case, |jet| {
            let state = &case.model.state;
            let values = state.iter().enumerate().map(|(index, variable)| {
                match own.images.iter().find(|(name, _)| *name == variable.name) {
                    Some((_, image)) => jet.phase.evaluate(image),
                    None => jet.phase.configuration.variable(index),
                }
            });
            values.flat_map(|value| value.components()).collect::<Vec<_>>()
        })
        .ok()?;
        let (free, dimension) = (case.model.free_components(), case.model.dimension());
        (image.len() == dimension).then(|| Self {
            tape: Tape::new(&graph, &image),
            dimension,
            free,
        })
    }

    fn image(&self, (parameters, state): &(Vec<f64>, Vec<f64>)) -> Vec<f64> {
        run(&self.tape, parameters, state)
    }

    fn projected(&self, state: &[f64]) -> Vec<f64> {
        let image = run(&self.tape, &vec![1.0; self.free], state);
        state.iter().zip(image).map(|(x, y)| (x + y) / 2.0).collect()
    }

    /// Dimension of the fixed space, the trace of P.
    fn fixed_space(&self) -> usize {
        let unit = |k: usize| (0..self.dimension).map(|j| f64::from(u8::from(j == k))).collect();
        let own = (0..self.dimension).map(|k| {
            let unit: Vec<f64> = unit(k);
            self.projected(&unit)[k]
        });
        own.sum::<f64>().round() as usize
    }
}

/// Functions of the level with their gradients.
struct Level {
    tape: Tape,
    count: usize,
}

impl Level {
    fn of(case: &Case) -> Option<Self> {
        let kept = LevelSubset::level(&case.model).kept;
        let (graph, (values, slopes)) = recorded(case, |jet| {
            (jet.level_at(&jet.phase, &kept), jet.level_gradients(&kept).concat())
        })
        .ok()?;
        let count = values.len();
        Some(Self { tape: Tape::new(&graph, &[values, slopes].concat()), count })
    }

    /// Values at a fixed point, and the gradients along the fixed space.
    fn at(
        &self,
        map: &LinearMap,
        parameters: &[f64],
        state: &[f64],
    ) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
        let mut values = run(&self.tape, parameters, state);
        let slopes = values.split_off(self.count);
        if values.iter().chain(&slopes).any(|own| !own.is_finite()) {
            return None;
        }
        let rows = slopes.chunks(map.dimension).map(|row| map.projected(row)).collect();
        Some((values, rows))
    }

    /// A fixed point on the level, by steps of least length.
    fn solved(&self, map: &LinearMap, parameters: &[f64], mut state: Vec<f64>) -> Option<Vec<f64>> {
        for _ in 0..MOST_STEPS {
            let (values, rows) = self.at(map, parameters, &state)?;
            let terms = |row: &Vec<f64>| row.iter().zip(&state).map(|(a, b)| (a * b).abs()).sum();
            let size = rows.iter().map(terms).fold(1.0, f64::max);
            if values.iter().all(|own| own.abs() <= ROUNDING * ROUNDING.sqrt() * size) {
                return Some(state);
            }
            for (unit, length, value) in orthonormal(&rows, &values) {
                for (x, slope) in state.iter_mut().zip(unit) {
                    *x -= slope * value / length;
                }
            }
        }
        None
    }
}

/// Gram and Schmidt's directions of rows that are independent, with their lengths and the values that are left.
fn orthonormal(rows: &[Vec<f64>], values: &[f64]) -> Vec<(Vec<f64>, f64, f64)> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let largest = rows.iter().map(|row| dot(row, row)).fold(0.0, f64::max).sqrt();
    let mut all: Vec<(Vec<f64>, f64, f64)> = Vec::new();
    for (row, value) in rows.iter().zip(values) {
        let (mut rest, mut value) = (row.clone(), *value);
        for (unit, length, own) in &all {
            let along = dot(&rest, unit);
            rest.iter_mut().zip(unit).for_each(|(x, y)| *x -= along * y);
            value -= along * own / length;
        }
        let length = dot(&rest, &rest).sqrt();
        if length > ROUNDING.sqrt() * largest {
            rest.iter_mut().for_each(|x| *x /= length);
            all.push((rest, length, value));
        }
    }
    all
}

fn rank(rows: &[Vec<f64>]) -> usize {
    orthonormal(rows, &vec![0.0; rows.len()]).len()
}

fn run(tape: &Tape, parameters: &[f64], state: &[f64]) -> Vec<f64> {
    let mut evaluator = Evaluator::new(tape, Float::<1>);
    evaluator.run(&parameters.iter().chain(state).map(|x| [*x]).collect::<Vec<_>>());
    evaluator.outputs().map(|value| value[0]).collect()
}

fn are_same(a: &[f64], b: &[f64]) -> bool {
    let size = a.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= ROUNDING * size)
}

/// Drawn states on the level, each with its parameters.
fn states(case: &Case, seed: u64) -> Option<Vec<(Vec<f64>, Vec<f64>)>> {
    let model = &case.model;
    let sampler = Sampler::new(case, &LevelSubset::level(model), seed).ok()?;
    let one = |index: u64| {
        let values = sampler.printed(index, f64::MANTISSA_DIGITS);
        let values = values.iter().map(|text| Some(text.parse::<Rational>().ok()?.to_f64().0));
        let mut parameters = values.collect::<Option<Vec<f64>>>()?;
        let state = parameters.split_off(model.free_components());
        Some((parameters, state))
    };
    (0..STATES).map(one).collect()
}
