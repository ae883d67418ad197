//! Lyapunov exponents of orbits of maps: growth of tangent vectors per iterate, and the mean of
//! ln |det DΦ| on the level.

use crate::chaos::spectrum::Spectrum;
use crate::error::FlowError;
use crate::halt::Halt;
use crate::motion::iterates::{IterateError, RecordedMap};
use crate::motion::lyapunov::{BLOCKS, Character, Exponents, Record, SKIPPED, estimate};
use crate::motion::orbit::Precision;
use crate::motion::start::{LevelFunctions, Start, level_basis};
use crate::taylor::batch::each;
use crate::told::ToldShare;
use liouville::case::Case;
use liouville::number::double_double::DoubleDouble;
use liouville::order::StableOrder;

/// Number of vectors that are not made orthogonal; the alignment index takes two.
const LOOSE: usize = 2;
/// Number of iterates between two looks at the share that is done.
const TOLD_EVERY: u64 = 256;

/// Exponents of an orbit of a map, per iterate.
#[derive(Clone, Debug)]
pub struct MapExponents {
    /// Largest exponent, mean of ln |det DΦ|, and class.
    pub largest: Exponents,
    /// All exponents.
    pub spectrum: Spectrum,
}

/// Measures the exponents of a map along orbits of `count` iterates. Calls `progress` with shares of an
/// orbit as they are done.
pub fn map_exponents(
    case: &Case,
    starts: &[Result<Start, FlowError>],
    count: u64,
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Vec<Result<MapExponents, IterateError>> {
    each(starts.len(), threads, &|index| {
        let mut told = ToldShare::default();
        let found = match &starts[index] {
            Ok(start) => along(case, start, count, &mut |share| told.reach(share, progress)),
            Err(problem) => Err(problem.clone().into()),
        };
        told.finish(progress);
        found
    })
}

/// Iterate at which a block ends; the first one is that of the transient.
fn end(block: usize, count: u64) -> u64 {
    let share = SKIPPED + (1.0 - SKIPPED) * block as f64 / BLOCKS as f64;
    (share * count as f64).round() as u64
}

fn along(
    case: &Case,
    start: &Start,
    count: u64,
    reach: &mut dyn FnMut(f64),
) -> Result<MapExponents, IterateError> {
    let model = &case.model;
    let dimension = model.dimension();
    let basis = level_basis(model, start)?;
    if basis.is_empty() {
        return Err(FlowError::NoTangents.into());
    }
    let level = LevelFunctions::new(model, &start.parameters, &[])?;
    // On a line all vectors are parallel.
    let loose = if basis.len() == 1 { 1 } else { LOOSE };
    let map = RecordedMap::with_vectors(model, start, loose + basis.len())?;
    let mut next = map.stepper(Precision::Float);
    let mut row = start.state.clone();
    for index in 0..loose {
        let vector = level.along(&start.state, &[], index);
        row.extend(vector.into_iter().map(DoubleDouble::from_f64));
    }
    row.extend(basis.iter().flatten());
    let mut record = Record::new(count as f64);
    let mut sums = vec![0.0; basis.len()];
    let (mut before, mut blocks) = (sums.clone(), Vec::new());
    let (mut block, mut begin) = (0, 0);
    let halt = Halt::current();
    for index in 1..=count {
        let state = row[..dimension].to_vec();
        row = next(&row).map_err(|fault| map.problem(&fault, index - 1, &state))?;
        record.visit(&row[..dimension]);
        let vectors = &mut row[dimension..];
        let mut lengths = vectors.chunks_mut(dimension).take(loose).map(normalise);
        record.grow(lengths.next().unwrap_or(f64::NAN));
        lengths.for_each(drop);
        if loose == LOOSE {
            let (first, second) = vectors[..LOOSE * dimension].split_at(dimension);
            record.align(index as f64, alignment(first, second));
        }
        let lengths = orthonormal(&mut vectors[loose * dimension..], dimension);
        if lengths.contains(&0.0) {
            return Err(map.degenerate(index - 1, &state));
        }
        sums.iter_mut().zip(lengths).for_each(|(sum, length)| *sum += libm::log(length));
        if index == end(block, count) {
            let length = (index - begin) as f64;
            record.finish_block_of(length, sums.iter().sum());
            if block > 0 {
                let means = sums.iter().zip(&before).map(|(now, then)| (now - then) / length);
                blocks.push(means.collect::<Vec<f64>>());
            }
            before.clone_from(&sums);
            (block, begin) = (block + 1, index);
        }
        if index % TOLD_EVERY == 0 {
            reach(index as f64 / count as f64);
            if halt.is_raised() && index < count {
                return Err(map.stopped(index, &row[..dimension]));
            }
        }
    }
    let mut largest = record.exponents();
    // An orbit that stays, where each step makes volumes larger: images overlap, so the map is not
    // one-to-one, and the determinant says nothing of the volume of an image.
    if largest.character == Character::StrangeRepeller {
        largest.character = Character::Chaos;
    }
    let of = |place: usize| -> Vec<f64> { blocks.iter().map(|means| means[place]).collect() };
    let mut exponents: Vec<_> = (0..basis.len()).map(|place| estimate(&of(place))).collect();
    exponents.order_by(|a, b| b.mean.total_cmp(&a.mean));
    let spectrum = Spectrum { time: count as f64, exponents, divergence: largest.divergence };
    Ok(MapExponents { largest, spectrum })
}

/// Makes a vector a unit vector. Returns its length.
fn normalise(vector: &mut [DoubleDouble]) -> f64 {
    let length = vector.iter().map(|x| x.hi * x.hi).sum::<f64>().sqrt();
    vector.iter_mut().for_each(|x| *x = DoubleDouble::from_f64(x.hi / length));
    length
}

/// min(|u + w|, |u − w|) of two unit vectors.
fn alignment(u: &[DoubleDouble], w: &[DoubleDouble]) -> f64 {
    let apart = |sign: f64| {
        let parts = u.iter().zip(w).map(|(x, y)| x.hi + sign * y.hi);
        parts.map(|x| x * x).sum::<f64>().sqrt()
    };
    apart(1.0).min(apart(-1.0))
}

/// Makes vectors orthonormal, in turn. Returns their lengths across those before.
fn orthonormal(vectors: &mut [DoubleDouble], dimension: usize) -> Vec<f64> {
    let count = vectors.len() / dimension;
    let mut lengths = Vec::new();
    for index in 0..count {
        let (known, rest) = vectors.split_at_mut(index * dimension);
        let own = &mut rest[..dimension];
        // Two passes are enough against rounding.
        for unit in known.chunks(dimension).chain(known.chunks(dimension)) {
            let along: f64 = own.iter().zip(unit).map(|(x, e)| x.hi * e.hi).sum();
            let across = |(x, e): (&mut DoubleDouble, &DoubleDouble)| x.hi -= along * e.hi;
            own.iter_mut().zip(unit).for_each(across);
        }
        lengths.push(normalise(own));
    }
    lengths
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_those_across_the_vectors_before() {
        let mut vectors = [3.0, 4.0, 3.0, 0.0].map(DoubleDouble::from_f64);
        let lengths = orthonormal(&mut vectors, 2);
        assert!((lengths[0] - 5.0).abs() < 1e-15 && (lengths[1] - 2.4).abs() < 1e-15);
        assert!(alignment(&vectors[..2], &vectors[2..]) > 1.0);
    }

    #[test]
    fn blocks_end_at_the_end() {
        for count in [100, 137, 1000] {
            assert_eq!(end(BLOCKS, count), count);
            assert!((0..BLOCKS).all(|block| end(block, count) < end(block + 1, count)));
        }
    }
}
