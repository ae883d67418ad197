//! All Lyapunov exponents of motions: tangent vectors made orthonormal after each step
//! (Benettin, Galgani, Giorgilli, Strelcyn 1980).

use serde::{Deserialize, Serialize};

use crate::error::FlowError;
use crate::motion::lyapunov::{BLOCKS, ERRORS, Estimate, SKIPPED, estimate};
use crate::motion::start::{LevelFunctions, Start, level_basis};
use crate::motion::variational::variational_program;
use crate::taylor::batch::each;
use crate::taylor::program::TaylorProgram;
use crate::taylor::stepper::{Accuracy, Stepper};
use crate::told::ToldShare;
use liouville::mechanics::Model;
use liouville::number::double_double::DoubleDouble;
use liouville::order::StableOrder;

/// All exponents of a motion on its level, the largest first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spectrum {
    /// Time for which the motion was followed.
    #[serde(with = "crate::record")]
    pub time: f64,
    /// Exponents, one for each dimension of the level.
    pub exponents: Vec<Estimate>,
    /// Mean of div v on the level, which is their sum.
    pub divergence: Estimate,
}

impl Spectrum {
    /// Dimension of Kaplan and Yorke: k + (λ₁ + … + λ_k)/|λ_{k+1}|, k the largest number for which
    /// the sum is not negative beyond its error; `None` where volume does not shrink beyond its error.
    pub fn kaplan_yorke(&self) -> Option<f64> {
        if self.divergence.mean >= 0.0 || !self.divergence.is_settled(self.time) {
            return None;
        }
        let (mut sum, mut error) = (0.0, 0.0);
        for (count, exponent) in self.exponents.iter().enumerate() {
            error = libm::hypot(error, exponent.error);
            if sum + exponent.mean < -ERRORS * error {
                return Some(count as f64 + sum.max(0.0) / exponent.mean.abs());
            }
            sum += exponent.mean;
        }
        None
    }
}

/// Measures the spectra of motions with the same parameters, each for a time, negative for
/// backwards. Calls `progress` with shares of a motion as they are done.
pub fn spectra(
    model: &Model,
    starts: &[Result<Start, FlowError>],
    time: f64,
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<Result<Spectrum, FlowError>>, FlowError> {
    let Some(first) = starts.iter().flatten().next() else {
        return Ok(starts
            .iter()
            .map(|start| Err(start.as_ref().err().cloned().unwrap_or(FlowError::NoStart)))
            .collect());
    };
    let equations = LevelFunctions::new(model, &first.parameters, &[])?.len();
    let count = model.dimension().saturating_sub(equations);
    if count == 0 {
        return Err(FlowError::NoTangents);
    }
    let program = variational_program(model, &first.parameters, count)?;
    Ok(each(starts.len(), threads, &|index| {
        let found = starts[index].as_ref().map_err(Clone::clone);
        let mut told = ToldShare::default();
        let mut reach = |share| told.reach(share, progress);
        let found = found.and_then(|start| spectrum(&program, model, start, time, &mut reach));
        told.finish(progress);
        found
    }))
}

/// Sums along a motion.
struct Sums {
    /// Logarithms of the growth of the volumes' factors, since the last block.
    growth: Vec<f64>,
    /// ∫ div v at the end of the last block.
    volume: f64,
    blocks: Vec<Vec<f64>>,
    volumes: Vec<f64>,
}

fn spectrum(
    program: &TaylorProgram,
    model: &Model,
    start: &Start,
    time: f64,
    reach: &mut dyn FnMut(f64),
) -> Result<Spectrum, FlowError> {
    let dimension = model.dimension();
    let basis = level_basis(model, start)?;
    let count = basis.len();
    let mut begin = start.state.clone();
    begin.extend(basis.into_iter().flatten());
    begin.push(DoubleDouble::default());
    let block = time * (1.0 - SKIPPED) / BLOCKS as f64;
    let mut sums =
        Sums { growth: vec![0.0; count], volume: 0.0, blocks: Vec::new(), volumes: Vec::new() };
    let level = LevelFunctions::new(model, &start.parameters, &[])?;
    let mut stepper = Stepper::<f64>::new(program, Accuracy::FLOAT);
    stepper.start(0, &begin, DoubleDouble::from_f64(time * SKIPPED));
    stepper.aim(0, time);
    loop {
        stepper.expand();
        stepper.check(0)?;
        stepper.advance();
        let mut all = stepper.pairs(0);
        // Off the level vectors may grow otherwise than on it.
        let normals = level.normals(&all[..dimension]);
        let vectors = &mut all[dimension..dimension * (count + 1)];
        let lengths = orthonormalised(vectors, dimension, normals);
        for (sum, length) in sums.growth.iter_mut().zip(lengths) {
            *sum += libm::log(length);
        }
        let volume = all.last().map_or(f64::NAN, |volume| volume.hi);
        stepper.place(0, &all);
        reach(stepper.time(0).hi / time);
        if !stepper.is_done(0) {
            continue;
        }
        let growth = std::mem::replace(&mut sums.growth, vec![0.0; count]);
        sums.blocks.push(growth.into_iter().map(|growth| growth / block.abs()).collect());
        sums.volumes.push((volume - sums.volume) / block);
        sums.volume = volume;
        let done = sums.blocks.len();
        if done > BLOCKS {
            break;
        }
        stepper.extend(0, DoubleDouble::from_f64(time * SKIPPED + block * done as f64));
    }
    // The first block is the transient.
    let blocks = &sums.blocks[1..];
    let of = |index: usize| estimate(&blocks.iter().map(|block| block[index]).collect::<Vec<_>>());
    let mut exponents: Vec<Estimate> = (0..count).map(of).collect();
    exponents.order_by(|a, b| b.mean.total_cmp(&a.mean));
    Ok(Spectrum { time, exponents, divergence: estimate(&sums.volumes[1..]) })
}

/// Makes vectors orthonormal one after another, across unit vectors. Returns their lengths across
/// those before.
fn orthonormalised(
    vectors: &mut [DoubleDouble],
    dimension: usize,
    mut unit: Vec<Vec<f64>>,
) -> Vec<f64> {
    let mut lengths = Vec::new();
    for vector in vectors.chunks_mut(dimension) {
        let mut rest: Vec<f64> = vector.iter().map(|x| x.hi).collect();
        // Twice is enough against rounding.
        for e in unit.iter().chain(&unit) {
            let along: f64 = rest.iter().zip(e).map(|(x, e)| x * e).sum();
            rest.iter_mut().zip(e).for_each(|(x, e)| *x -= along * e);
        }
        let length = rest.iter().map(|x| x * x).sum::<f64>().sqrt();
        rest.iter_mut().for_each(|x| *x /= length);
        vector.iter_mut().zip(&rest).for_each(|(x, rest)| *x = DoubleDouble::from_f64(*rest));
        lengths.push(length);
        unit.push(rest);
    }
    lengths
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spectrum(exponents: &[(f64, f64)], divergence: (f64, f64)) -> Spectrum {
        let of = |(mean, error): (f64, f64)| Estimate { mean, error, later: mean };
        let exponents = exponents.iter().copied().map(of).collect();
        Spectrum { time: 1000.0, exponents, divergence: of(divergence) }
    }

    #[test]
    fn a_dimension_needs_volume_that_shrinks_beyond_its_error() {
        let kept = [(0.152, 0.038), (0.007, 0.021), (-0.011, 0.027), (-0.151, 0.035)];
        assert_eq!(spectrum(&kept, (-0.003, 0.021)).kaplan_yorke(), None);
        // A density e^f lets the volume change at the ends only.
        assert_eq!(spectrum(&kept, (-0.005, 0.001)).kaplan_yorke(), None);
        let lorenz = [(0.9, 0.01), (-1e-5, 1e-3), (-14.5, 0.01)];
        let dimension = spectrum(&lorenz, (-13.6, 1e-6)).kaplan_yorke().expect("volume shrinks");
        assert!((dimension - 2.062).abs() < 1e-3, "{dimension}");
        let cycle = [(-1e-5, 1e-3), (-2.0, 0.01)];
        assert_eq!(spectrum(&cycle, (-2.0, 0.01)).kaplan_yorke(), Some(1.0), "0 within its error");
    }
}
