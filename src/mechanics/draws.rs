//! Random draws addressed by index: state i depends on the seed and on i alone.
//!
//! The first states are short decimals, for readability; the others have all digits of f64, so that
//! a formula that repeats itself on decimals is not taken for a true one.

mod source;

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

use super::recipe::Draw;
use super::streams::{NUMBERS, Streams, WIDTH, Words};
use crate::engine::{InputExtent, ROW_STATES, RowBlock};
use crate::graph::{Kernel, with_widest_vectors};
use crate::number::ball::Balls;
use crate::number::rational::Rational;
use source::{Manner, NumberSource, is_short};

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

    /// Where each number lies as an f64, and whether it is exact, at nearly all states.
    pub fn extents(&self) -> Vec<InputExtent> {
        self.sources.iter().map(NumberSource::extent).collect()
    }

    /// Encloses the numbers of the states from `start` on, one column of lanes for each number:
    /// those of [`DrawSource::nearest`]. Returns whether all of them come from within ranges, and are
    /// exact.
    pub fn fill<C: Column>(&self, streams: &Streams, start: u64, columns: &mut [C]) -> bool {
        let mut is_plain = true;
        let sources = &self.sources;
        with_widest_vectors(Fill { sources, streams, start, columns, is_plain: &mut is_plain });
        is_plain
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
    is_plain: &'f mut bool,
}

impl<C: Column> Kernel for Fill<'_, C> {
    #[inline(always)]
    fn run(self) {
        let Self { sources, streams, start, columns, is_plain } = self;
        *is_plain = sources.iter().all(|source| source.plain().is_some());
        for first in (0..C::LANES).step_by(WIDTH) {
            let index = start + first as u64;
            // Plain numbers first, with one test for all: a test of each would wait for its number.
            let mut outside = [0; WIDTH];
            for (block, sources) in sources.chunks(NUMBERS).enumerate() {
                if sources.iter().all(|source| source.plain().is_none()) {
                    continue;
                }
                let words = streams.words(index, block as u64);
                let columns = &mut columns[block * NUMBERS..];
                let mut to = Plain { sources, words: &words, columns, first, outside };
                // By name: in a loop numbers, not lanes, would become vectors.
                to.draw::<0>();
                to.draw::<1>();
                to.draw::<2>();
                to.draw::<3>();
                to.draw::<4>();
                to.draw::<5>();
                to.draw::<6>();
                to.draw::<7>();
                outside = to.outside;
            }
            let is_open = is_short(index) || has_sign(&outside);
            if !is_open && *is_plain {
                continue;
            }
            *is_plain &= !is_open;
            for (block, sources) in sources.chunks(NUMBERS).enumerate() {
                let numbers = streams.numbers(index, block as u64);
                let columns = columns[block * NUMBERS..].iter_mut();
                for ((source, bits), column) in sources.iter().zip(&numbers).zip(columns) {
                    if is_open || source.plain().is_none() {
                        let lanes = first..C::LANES.min(first + WIDTH);
                        let [mid, rad] = column.parts();
                        source.enclose(index, bits, &mut mid[lanes.clone()], &mut rad[lanes]);
                    }
                }
            }
        }
    }
}

/// Numbers from within ranges, for the states of a vector.
struct Plain<'f, C> {
    sources: &'f [NumberSource],
    words: &'f Words,
    columns: &'f mut [C],
    /// First lane.
    first: usize,
    /// For each state a word whose first bit is 1 if a number is outside of its range.
    outside: [u64; WIDTH],
}

impl<C: Column> Plain<'_, C> {
    /// Draws number K, if its source is plain.
    #[inline(always)]
    fn draw<const K: usize>(&mut self) {
        let (Some(source), Some(column)) = (self.sources.get(K), self.columns.get_mut(K)) else {
            return;
        };
        let Some(plain) = source.plain() else { return };
        let [mid, rad] = column.parts();
        let lanes = self.first..;
        let mid = mid.get_mut(lanes.clone()).and_then(<[f64]>::first_chunk_mut);
        if let (Some(mid), Some(rad)) = (mid, rad.get_mut(lanes).and_then(<[f64]>::first_chunk_mut))
        {
            plain.draw(&self.words.number::<K>(), mid, &mut self.outside);
            *rad = [0.0; WIDTH];
        } else {
            // Fewer states than a vector has.
            self.outside = [u64::MAX; WIDTH];
        }
    }
}

/// Whether the first bit of some word is 1.
#[inline(always)]
fn has_sign(words: &[u64; WIDTH]) -> bool {
    words.iter().fold(0, |any, one| any | one) >> 63 == 1
}

#[cfg(test)]
mod tests;
