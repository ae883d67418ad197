//! Random draws addressed by index: state i depends on the seed and on i alone.
//!
//! The first states are short decimals, for readability; the others have all digits of f64, so that
//! a formula that repeats itself on decimals is not taken for a true one.

mod source;

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

use super::recipe::Draw;
use super::streams::{NUMBERS, Streams, WIDTH};
use crate::engine::{ROW_STATES, RowBlock};
use crate::graph::{Kernel, with_widest_vectors};
use crate::number::ball::Balls;
use crate::number::rational::Rational;
use source::{Manner, NumberSource};

/// Random numbers for states, strictly inside their ranges and never 0.
///
/// The same seed and index give the same numbers on every machine, whatever else is drawn.
#[derive(Clone, Debug)]
pub struct DrawSource {
    sources: Vec<NumberSource>,
}

impl DrawSource {
    /// Prepares one number for each draw.
    pub fn new(draws: &[Draw]) -> Self {
        Self { sources: draws.iter().map(NumberSource::new).collect() }
    }

    /// Number of random numbers for a state.
    pub fn len(&self) -> usize {
        self.sources.len()
    }

    /// Whether nothing is drawn.
    pub fn is_empty(&self) -> bool {
        self.sources.is_empty()
    }

    /// Draws the numbers of state `index`.
    pub fn state(&self, seed: u64, index: u64) -> Vec<Rational> {
        self.attempt(seed, index, 0)
    }

    /// Draws other numbers for state `index`, after attempts that did not lead to a state.
    pub fn attempt(&self, seed: u64, index: u64, attempt: u32) -> Vec<Rational> {
        self.picked(seed, index, attempt, NumberSource::pick)
    }

    /// Draws numbers for a state near the ends of ranges and near 0, where quantities that are
    /// small elsewhere may change sign.
    pub fn edge(&self, seed: u64, index: u64) -> Vec<Rational> {
        self.picked(seed, index, 0, NumberSource::edge)
    }

    /// Returns the f64 nearest to each number of [`DrawSource::edge`], and whether it is exact.
    pub fn nearest_edge(&self, seed: u64, index: u64) -> Vec<(f64, bool)> {
        self.picked(seed, index, 0, NumberSource::nearest_edge)
    }

    /// Returns the f64 nearest to each number, and whether it is exact.
    pub fn nearest(&self, seed: u64, index: u64, attempt: u32) -> Vec<(f64, bool)> {
        self.picked(seed, index, attempt, NumberSource::nearest)
    }

    /// Whether each number is an f64 that is finite, at nearly all states.
    pub fn exact(&self) -> Vec<bool> {
        let is_exact = |source: &NumberSource| match source {
            NumberSource::List(values) => values.iter().all(|value| {
                let (nearest, is_exact) = value.to_f64();
                is_exact && nearest.is_finite()
            }),
            NumberSource::Sign | NumberSource::Range { .. } => true,
        };
        self.sources.iter().map(is_exact).collect()
    }

    /// Encloses the numbers of the states from `start` on, one column of lanes for each number:
    /// those of [`DrawSource::nearest`].
    pub fn fill<C: Column>(&self, streams: &Streams, start: u64, columns: &mut [C]) {
        with_widest_vectors(Fill { sources: &self.sources, streams, start, columns });
    }

    fn picked<T>(
        &self,
        seed: u64,
        index: u64,
        attempt: u32,
        pick: impl Fn(&NumberSource, u64, Manner) -> T,
    ) -> Vec<T> {
        let mut stream = ChaCha8Rng::seed_from_u64(seed);
        stream.set_stream(index);
        if attempt > 0 {
            // A number takes two words; each attempt continues where the last one ended.
            stream.set_word_pos(u128::from(attempt) * 2 * self.sources.len() as u128);
        }
        let manner = Manner::of(index, attempt);
        self.sources.iter().map(|source| pick(source, stream.next_u64(), manner)).collect()
    }
}

/// One number of a block of states, as balls.
pub trait Column {
    /// Number of states.
    const LANES: usize;

    /// Returns midpoints and radii.
    fn parts(&mut self) -> [&mut [f64]; 2];
}

impl<const N: usize> Column for Balls<N> {
    const LANES: usize = N;

    #[inline(always)]
    fn parts(&mut self) -> [&mut [f64]; 2] {
        [&mut self.mid, &mut self.rad]
    }
}

impl Column for [RowBlock; 2] {
    const LANES: usize = ROW_STATES;

    #[inline(always)]
    fn parts(&mut self) -> [&mut [f64]; 2] {
        let [mid, rad] = self;
        [&mut mid.0, &mut rad.0]
    }
}

/// The numbers of a block of states.
struct Fill<'f, C> {
    sources: &'f [NumberSource],
    streams: &'f Streams,
    start: u64,
    columns: &'f mut [C],
}

impl<C: Column> Kernel for Fill<'_, C> {
    #[inline(always)]
    fn run(self) {
        for first in (0..C::LANES).step_by(WIDTH) {
            let index = self.start + first as u64;
            for (block, sources) in self.sources.chunks(NUMBERS).enumerate() {
                let numbers = self.streams.numbers(index, block as u64);
                let columns = self.columns[block * NUMBERS..].iter_mut();
                for ((source, bits), column) in sources.iter().zip(&numbers).zip(columns) {
                    let lanes = first..C::LANES.min(first + WIDTH);
                    let [mid, rad] = column.parts();
                    source.enclose(index, bits, &mut mid[lanes.clone()], &mut rad[lanes]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
