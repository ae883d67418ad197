//! Random numbers for states in f64, a row at a time: state i depends on the seed and on i alone.
//!
//! ```text
//! z = m(i φ xor k_j),  φ = ⌊2⁶⁴/golden ratio⌋,  k_j = m(m(seed) + j)
//! two numbers:  low + (n + ½) (high - low)/2³²,  n the upper and the lower half of z
//! ```
//!
//! m is the finalizer of SplitMix64 (Steele, Lea, Flood 2014) with the multipliers of Stafford's
//! variant 13. It is not a cipher, unlike the generator of verdicts, but consists of vector
//! operations: a pair of numbers costs two multiplications.

#![allow(clippy::needless_range_loop, reason = "loops over lanes become vectors")]

use crate::engine::{ROW_STATES, RowBlock};
use crate::graph::{Kernel, with_widest_vectors};
use crate::mechanics::{Draw, NumberLine};
use crate::number::{GOLDEN, scrambled};

/// The factor 2⁻³².
const UNIT: f64 = 1.0 / (1u64 << 32) as f64;

/// Generator of the draws of states.
#[derive(Clone, Debug)]
pub(super) struct Generator {
    /// Keys, one for each pair of draws.
    keys: Vec<u64>,
    sources: Vec<InputSource>,
}

#[derive(Clone, Debug)]
enum InputSource {
    Range {
        first: f64,
        step: f64,
    },
    /// Numbers of a range -a..a, and a²/x for one x of four.
    Directions {
        first: f64,
        step: f64,
        square: f64,
    },
    List(Vec<f64>),
}

impl Generator {
    /// Builds a generator with one number for each draw.
    pub(super) fn new(draws: &[Draw], seed: u64) -> Self {
        let source = |draw: &Draw| match draw {
            Draw::OneOf(values) => InputSource::List(values.iter().map(|x| x.to_f64().0).collect()),
            Draw::Sign => InputSource::List(vec![1.0, -1.0]),
            Draw::Within(range) | Draw::Of(_, range) => {
                let step = (&range.high - &range.low).to_f64().0 * UNIT;
                let first = range.low.to_f64().0 + step / 2.0;
                match draw {
                    Draw::Of(NumberLine::Directions, _) => {
                        let square = (&range.high * &range.high).to_f64().0;
                        InputSource::Directions { first, step, square }
                    }
                    _ => InputSource::Range { first, step },
                }
            }
        };
        let key = |pair: usize| scrambled(scrambled(seed).wrapping_add(pair as u64));
        Self {
            keys: (0..draws.len().div_ceil(2)).map(key).collect(),
            sources: draws.iter().map(source).collect(),
        }
    }

    /// Number of draws of a state.
    pub(super) fn draws(&self) -> usize {
        self.sources.len()
    }

    /// Fills rows, one for each draw, with the draws of the states from `start` on.
    pub(super) fn fill(&self, start: u64, rows: &mut [RowBlock]) {
        with_widest_vectors(Fill { generator: self, start, rows });
    }
}

struct Fill<'f> {
    generator: &'f Generator,
    start: u64,
    rows: &'f mut [RowBlock],
}

impl Kernel for Fill<'_> {
    #[inline(always)]
    fn run(self) {
        let Generator { keys, sources } = self.generator;
        let draws = sources.chunks(2).zip(self.rows.chunks_mut(2));
        for (key, (sources, rows)) in keys.iter().zip(draws) {
            let mut bits = [0; ROW_STATES];
            for lane in 0..ROW_STATES {
                let counter = self.start.wrapping_add(lane as u64);
                bits[lane] = scrambled(counter.wrapping_mul(GOLDEN) ^ key);
            }
            for (half, (source, row)) in sources.iter().zip(rows).enumerate() {
                let number = |bits: u64| (bits >> (32 * half)) as u32;
                match source {
                    InputSource::Range { first, step } => {
                        for lane in 0..ROW_STATES {
                            row.0[lane] = first + step * f64::from(number(bits[lane]));
                        }
                    }
                    InputSource::Directions { first, step, square } => {
                        for lane in 0..ROW_STATES {
                            let number = number(bits[lane]);
                            let inside = first + step * f64::from(number);
                            row.0[lane] = if number % 4 == 0 { square / inside } else { inside };
                        }
                    }
                    InputSource::List(values) => {
                        for lane in 0..ROW_STATES {
                            let scaled = u64::from(number(bits[lane])) * values.len() as u64;
                            let index = scaled >> 32;
                            row.0[lane] = values.get(index as usize).copied().unwrap_or(f64::NAN);
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::Range;
    use crate::number::rational::Rational;

    fn rows(generator: &Generator, start: u64) -> Vec<RowBlock> {
        let mut rows = vec![RowBlock([0.0; ROW_STATES]); generator.sources.len()];
        generator.fill(start, &mut rows);
        rows
    }

    fn three() -> Vec<Draw> {
        let range = Range::between((-1, 2), (3, 2));
        let list = [1, 2, 5].map(Rational::from).to_vec();
        vec![Draw::Within(range.clone()), Draw::OneOf(list), Draw::Within(range)]
    }

    #[test]
    fn a_state_depends_on_seed_and_index_alone() {
        let generator = Generator::new(&three(), 7);
        let (early, late) = (rows(&generator, 0), rows(&generator, 10));
        for k in 0..3 {
            assert_eq!(early[k].0[10..], late[k].0[..ROW_STATES - 10], "draw {k}");
        }
        let fewer = Generator::new(&three()[..1], 7);
        assert_eq!(rows(&fewer, 0)[0], early[0], "further draws change nothing");
        assert_ne!(rows(&Generator::new(&three(), 8), 0)[0], early[0], "another seed");
        assert_ne!(early[0], early[2], "each draw has numbers of its own");
        let [first, second] = [early[0].0[0], early[0].0[1]];
        assert_eq!([first, second], FROZEN, "a change here changes every state ever reported");
    }

    const FROZEN: [f64; 2] = [0.17986399843357503, -0.4393711464945227];

    #[test]
    fn every_instruction_set_draws_the_same() {
        let generator = Generator::new(&three(), 7);
        let mut plain = vec![RowBlock([0.0; ROW_STATES]); 3];
        Fill { generator: &generator, start: 1 << 40, rows: &mut plain }.run();
        assert_eq!(rows(&generator, 1 << 40), plain, "vectors change no bit");
    }

    #[test]
    fn draws_are_uniform_and_independent() {
        // Cells of two draws: counts of 64 000 states differ from 1000 by chance alone, whose
        // χ² with 63 degrees of freedom is above 130 in one of 10⁶ seeds; the seed is fixed.
        let generator = Generator::new(&three(), 1);
        let (mut cells, mut listed) = ([0; 64], [0; 6]);
        for block in 0..1000 {
            let rows = rows(&generator, 64 * block);
            for lane in 0..ROW_STATES {
                let place = |k: usize| {
                    let x = rows[k].0[lane];
                    assert!(-0.5 < x && x < 1.5 && x != 0.0, "{x} is inside");
                    ((x + 0.5) * 4.0) as usize
                };
                cells[place(0) * 8 + place(2)] += 1;
                listed[rows[1].0[lane] as usize] += 1;
            }
        }
        let spread: f64 = cells.iter().map(|n| f64::from(*n - 1000i32).powi(2) / 1000.0).sum();
        assert!(spread < 130.0, "χ² = {spread}");
        let fair = |n: i32| (n - 64_000 / 3).abs() < 600;
        assert!(fair(listed[1]) && fair(listed[2]) && fair(listed[5]), "{listed:?}");
    }

    #[test]
    fn directions_reach_every_part_of_a_circle() {
        let range = Range::between((-8, 5), (8, 5));
        let generator = Generator::new(&[Draw::Of(NumberLine::Directions, range)], 1);
        let mut sectors = [0; 24];
        for x in (0..16).flat_map(|block| rows(&generator, 64 * block)[0].0) {
            sectors[((2.0 * x.atan() / std::f64::consts::PI + 1.0) * 12.0) as usize] += 1;
        }
        assert!(sectors.iter().all(|count| *count > 10), "states by sector: {sectors:?}");
    }
}
