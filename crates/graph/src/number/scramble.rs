//! Pseudo-random numbers of counters: SplitMix64 (Steele, Lea, Flood 2014).

/// The odd number next to 2⁶⁴ (√5 − 1)/2, whose multiples spread over all 64 bits.
pub const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// Computes a bijection of 64 bits in which every bit depends on all.
#[inline(always)]
pub fn scrambled(z: u64) -> u64 {
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_published_generator() {
        // The first three of seed 1234567.
        let number = |k: u64| scrambled(1_234_567u64.wrapping_add(GOLDEN.wrapping_mul(k)));
        let expected =
            [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
        assert_eq!([1, 2, 3].map(number), expected);
    }
}
