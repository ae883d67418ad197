//! Random words of many states side by side.
//!
//! The words of state i are those of ChaCha with eight rounds and stream i, as `ChaCha8Rng` gives
//! them. One state needs few of them, and a generator of its own for each state would make four
//! blocks and throw most away; here each lane of a vector is a state.

#![allow(clippy::needless_range_loop, reason = "loops over lanes become vectors")]

use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;

/// Number of states computed together: as many as a vector of 512 bits has words.
pub(super) const WIDTH: usize = 16;
/// Number of random numbers of 64 bits in a block of words.
pub(super) const NUMBERS: usize = 8;

/// Some words of each state, by word and by state.
type WordRows = [[u32; WIDTH]; 16];

/// Random words of one block, before the last sum.
pub(super) struct Words {
    mixed: WordRows,
    start: WordRows,
}

impl Words {
    /// Joins the words 2K and 2K + 1 to a number.
    #[inline(always)]
    pub(super) fn number<const K: usize>(&self) -> [u64; WIDTH] {
        number::<K>(&self.mixed, &self.start)
    }
}

/// First words of every block, "expand 32-byte k".
const CONSTANTS: [u32; 4] = [0x6170_7865, 0x3320_646e, 0x7962_2d32, 0x6b20_6574];

/// Streams of random words that belong to a seed.
#[derive(Clone, Debug)]
pub struct Streams {
    key: [u32; 8],
}

impl Streams {
    /// Makes the streams of a seed.
    pub fn new(seed: u64) -> Self {
        let bytes = ChaCha8Rng::seed_from_u64(seed).get_seed();
        let word = |k: usize| std::array::from_fn(|byte| bytes[4 * k + byte]);
        Self { key: std::array::from_fn(|k| u32::from_le_bytes(word(k))) }
    }

    /// Computes eight numbers for each of the states from `first` on: those from the place
    /// `8 block` of their streams.
    #[inline(always)]
    pub fn numbers(&self, first: u64, block: u64) -> [[u64; WIDTH]; NUMBERS] {
        let words = self.words(first, block);
        // By name: in a loop over the numbers these, not the lanes, would become vectors.
        [
            words.number::<0>(),
            words.number::<1>(),
            words.number::<2>(),
            words.number::<3>(),
            words.number::<4>(),
            words.number::<5>(),
            words.number::<6>(),
            words.number::<7>(),
        ]
    }

    /// Computes the words of these numbers.
    #[inline(always)]
    pub(super) fn words(&self, first: u64, block: u64) -> Words {
        let mut start: WordRows = [[0; WIDTH]; 16];
        for (word, value) in start.iter_mut().zip(CONSTANTS.iter().chain(&self.key)) {
            *word = [*value; WIDTH];
        }
        start[12] = [block as u32; WIDTH];
        start[13] = [(block >> 32) as u32; WIDTH];
        for lane in 0..WIDTH {
            let stream = first.wrapping_add(lane as u64);
            start[14][lane] = stream as u32;
            start[15][lane] = (stream >> 32) as u32;
        }
        let mut words = start;
        // Written out, so that the words stay in registers.
        for _ in 0..4 {
            quarter::<0, 4, 8, 12>(&mut words);
            quarter::<1, 5, 9, 13>(&mut words);
            quarter::<2, 6, 10, 14>(&mut words);
            quarter::<3, 7, 11, 15>(&mut words);
            quarter::<0, 5, 10, 15>(&mut words);
            quarter::<1, 6, 11, 12>(&mut words);
            quarter::<2, 7, 8, 13>(&mut words);
            quarter::<3, 4, 9, 14>(&mut words);
        }
        Words { mixed: words, start }
    }
}

/// Joins the words 2K and 2K + 1 of a block to a number.
#[inline(always)]
fn number<const K: usize>(words: &WordRows, start: &WordRows) -> [u64; WIDTH] {
    let (low, high) =
        (sum(&words[2 * K], &start[2 * K]), sum(&words[2 * K + 1], &start[2 * K + 1]));
    let mut number = [0; WIDTH];
    for lane in 0..WIDTH {
        number[lane] = u64::from(low[lane]) | u64::from(high[lane]) << 32;
    }
    number
}

#[inline(always)]
fn sum(a: &[u32; WIDTH], b: &[u32; WIDTH]) -> [u32; WIDTH] {
    let mut sum = [0; WIDTH];
    for lane in 0..WIDTH {
        sum[lane] = a[lane].wrapping_add(b[lane]);
    }
    sum
}

/// Mixes four words of each state (Bernstein, ChaCha, 2008).
#[inline(always)]
fn quarter<const A: usize, const B: usize, const C: usize, const D: usize>(words: &mut WordRows) {
    let [mut a, mut b, mut c, mut d] = [words[A], words[B], words[C], words[D]];
    half::<16, 12>(&mut a, &mut b, &mut c, &mut d);
    half::<8, 7>(&mut a, &mut b, &mut c, &mut d);
    [words[A], words[B], words[C], words[D]] = [a, b, c, d];
}

#[inline(always)]
fn half<const FIRST: u32, const SECOND: u32>(
    a: &mut [u32; WIDTH],
    b: &mut [u32; WIDTH],
    c: &mut [u32; WIDTH],
    d: &mut [u32; WIDTH],
) {
    for lane in 0..WIDTH {
        a[lane] = a[lane].wrapping_add(b[lane]);
        d[lane] = (d[lane] ^ a[lane]).rotate_left(FIRST);
        c[lane] = c[lane].wrapping_add(d[lane]);
        b[lane] = (b[lane] ^ c[lane]).rotate_left(SECOND);
    }
}

#[cfg(test)]
mod tests {
    use chacha20::rand_core::Rng;

    use super::*;

    #[test]
    fn the_words_are_those_of_the_generator() {
        for (seed, first) in [(1, 0), (7, 1 << 20), (u64::MAX, (1 << 32) - 5)] {
            let streams = Streams::new(seed);
            for block in 0..3 {
                let found = streams.numbers(first, block);
                for lane in 0..WIDTH {
                    let mut expected = ChaCha8Rng::seed_from_u64(seed);
                    expected.set_stream(first + lane as u64);
                    expected.set_word_pos(16 * u128::from(block));
                    for (k, number) in found.iter().enumerate() {
                        let place = format!("seed {seed}, state {first} + {lane}, number {k}");
                        assert_eq!(number[lane], expected.next_u64(), "{place}");
                    }
                }
            }
        }
    }
}
