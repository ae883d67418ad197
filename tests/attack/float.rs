//! Floats of any precision, correctly rounded to the nearest, ties to even; short ones need no
//! allocation.

use std::cmp::Ordering;

/// Number of limbs that are stored in place: 768 bits.
const FEW: usize = 12;
/// Number of limbs of intermediate results that are computed in place.
const SHORT: usize = 32;
/// Number of bits in which intermediate results exceed a result.
const GUARD: usize = 64;

/// A number ±0.m · 2^top with the binary digits m, of which the first is 1; or 0.
#[derive(Clone, Debug)]
pub struct Float {
    top: isize,
    negative: bool,
    /// Number of limbs without those at the end that are 0; none for 0.
    count: usize,
    /// Limbs, the most significant first, if they are few.
    few: [u64; FEW],
    many: Option<Box<[u64]>>,
}

impl PartialEq for Float {
    fn eq(&self, other: &Self) -> bool {
        let same = self.top == other.top && self.negative == other.negative;
        same && self.limbs() == other.limbs()
    }
}

/// Gives a buffer of this length, all 0.
fn buffered<T>(length: usize, act: impl FnOnce(&mut [u64]) -> T) -> T {
    match length {
        0..=16 => act(&mut [0; 16][..length]),
        17..=SHORT => act(&mut [0; SHORT][..length]),
        _ => act(&mut vec![0; length]),
    }
}

/// Number of limbs for so many bits.
fn length(bits: usize) -> usize {
    bits.div_ceil(64)
}

/// Rounds the number 0.`buffer` · 2^top.
fn rounded(negative: bool, mut top: isize, mut buffer: &mut [u64], bits: usize) -> Float {
    let Some(first) = buffer.iter().position(|limb| *limb != 0) else { return Float::ZERO };
    buffer = &mut buffer[first..];
    // What is beyond the digits counts only if it is not 0.
    let most = bits / 64 + 2;
    if buffer.len() > most {
        let (kept, beyond) = buffer.split_at_mut(most);
        kept[most - 1] |= u64::from(beyond.iter().any(|limb| *limb != 0));
        buffer = kept;
    }
    let shift = buffer[0].leading_zeros();
    top -= 64 * first as isize + shift as isize;
    if shift > 0 {
        let last = buffer.len() - 1;
        for k in 0..last {
            buffer[k] = buffer[k] << shift | buffer[k + 1] >> (64 - shift);
        }
        buffer[last] <<= shift;
    }
    if bits < 64 * buffer.len() {
        let (limb, bit) = (bits / 64, bits % 64);
        let half = buffer[limb] >> (63 - bit) & 1 == 1;
        let below = buffer[limb] & ((1 << (63 - bit)) - 1) != 0;
        let is_above = below || buffer[limb + 1..].iter().any(|limb| *limb != 0);
        let (last, place) = ((bits - 1) / 64, 63 - (bits - 1) % 64);
        let is_odd = buffer[last] >> place & 1 == 1;
        buffer = &mut buffer[..=last];
        buffer[last] &= u64::MAX << place;
        if half && (is_above || is_odd) && has_carry(buffer, 1 << place) {
            buffer[0] = 1 << 63;
            top += 1;
        }
    }
    let count = buffer.iter().rposition(|limb| *limb != 0).map_or(0, |last| last + 1);
    let mut few = [0; FEW];
    let many = match count <= FEW {
        true => {
            few[..count].copy_from_slice(&buffer[..count]);
            None
        }
        false => Some(buffer[..count].into()),
    };
    Float { top, negative, count, few, many }
}

/// Adds to the last limb and tells whether there is a carry out of the first.
fn has_carry(limbs: &mut [u64], more: u64) -> bool {
    let mut carry = more;
    for limb in limbs.iter_mut().rev() {
        let (sum, is_over) = limb.overflowing_add(carry);
        *limb = sum;
        if !is_over {
            return false;
        }
        carry = 1;
    }
    true
}

/// Writes limbs moved to the right by so many bits; what falls off the end sets the last bit.
fn place(limbs: &[u64], by: usize, buffer: &mut [u64]) {
    let (skip, shift) = (by / 64, by % 64);
    let mut lost = 0;
    for (k, limb) in limbs.iter().enumerate() {
        let mut put = |at: usize, part: u64| match buffer.get_mut(at) {
            Some(there) => *there |= part,
            None => lost |= part,
        };
        put(skip + k, limb >> shift);
        if shift > 0 {
            put(skip + k + 1, limb << (64 - shift));
        }
    }
    if let Some(last) = buffer.last_mut() {
        *last |= u64::from(lost != 0);
    }
}

/// Adds `by` · `limbs` to as many limbs, and returns the carry.
#[inline]
fn add_product(row: &mut [u64], limbs: &[u64], by: u64) -> u64 {
    let count = row.len().min(limbs.len());
    let (row, limbs) = (&mut row[..count], &limbs[..count]);
    let (mut carry, mut k) = (0u64, count);
    while k > 0 {
        k -= 1;
        let product = u128::from(by).wrapping_mul(u128::from(limbs[k]));
        let sum = product.wrapping_add(u128::from(row[k])).wrapping_add(u128::from(carry));
        (row[k], carry) = (sum as u64, (sum >> 64) as u64);
    }
    carry
}

/// Subtracts `by` · `limbs` from a buffer that is one limb longer; tells whether it was too much.
fn is_overdrawn(buffer: &mut [u64], limbs: &[u64], by: u64) -> bool {
    let mut carry: u64 = 0;
    let (first, rest) = buffer.split_first_mut().expect("a longer buffer");
    for (there, limb) in rest.iter_mut().zip(limbs).rev() {
        let product = u128::from(by).wrapping_mul(u128::from(*limb)).wrapping_add(carry.into());
        let (less, is_under) = there.overflowing_sub(product as u64);
        *there = less;
        carry = ((product >> 64) as u64).wrapping_add(is_under.into());
    }
    let (less, is_under) = first.overflowing_sub(carry);
    *first = less;
    is_under
}

impl Float {
    pub const ZERO: Self = Self { top: 0, negative: false, count: 0, few: [0; FEW], many: None };

    #[inline]
    fn limbs(&self) -> &[u64] {
        match &self.many {
            Some(limbs) => limbs,
            None => &self.few[..self.count],
        }
    }

    #[inline]
    pub fn whole(n: i64) -> Self {
        if n == 0 {
            return Self::ZERO;
        }
        let (mut few, shift) = ([0; FEW], n.unsigned_abs().leading_zeros());
        few[0] = n.unsigned_abs() << shift;
        Self { top: 64 - shift as isize, negative: n < 0, count: 1, few, many: None }
    }

    /// Converts a finite f64 exactly.
    pub fn exactly(x: f64) -> Self {
        assert!(x.is_finite(), "{x} is no number");
        let bits = x.to_bits();
        let (power, digits) = ((bits >> 52 & 0x7ff) as isize, bits & ((1 << 52) - 1));
        let (power, digits) = if power == 0 { (1, digits) } else { (power, digits | 1 << 52) };
        rounded(x < 0.0, power - 1075 + 64, &mut [digits], 64)
    }

    /// Makes a number from its digits after the point, the most significant first.
    pub fn of_limbs(negative: bool, top: isize, limbs: &mut [u64], bits: usize) -> Self {
        rounded(negative, top, limbs, bits)
    }

    /// Returns the sign, the place of the leading bit and the digits.
    pub fn parts(&self) -> (bool, isize, &[u64]) {
        (self.negative, self.top, self.limbs())
    }

    #[inline]
    pub fn is_zero(&self) -> bool {
        self.count == 0
    }

    /// Returns -1, 0 or 1.
    #[inline]
    pub fn sign(&self) -> i32 {
        match (self.count, self.negative) {
            (0, _) => 0,
            (_, true) => -1,
            (_, false) => 1,
        }
    }

    /// Returns the place of the leading bit, except for 0.
    #[inline]
    pub fn top(&self) -> Option<isize> {
        (self.count > 0).then_some(self.top)
    }

    /// Returns the nearest f64.
    pub fn nearest(&self) -> f64 {
        let Some(top) = self.top() else { return 0.0 };
        let limbs = self.limbs();
        // The last bit stands for all that are left out.
        let digits = limbs[0] | u64::from(limbs.len() > 1);
        let power = top.clamp(-1200, 1200) as i32 - 64;
        let size = digits as f64 * 2f64.powi(power / 2) * 2f64.powi(power - power / 2);
        if self.negative { -size } else { size }
    }

    /// Returns the number in so many bits.
    #[inline]
    pub fn cut(self, bits: usize) -> Self {
        if 64 * self.count <= bits { self } else { self.with_bits(bits) }
    }

    pub fn with_bits(&self, bits: usize) -> Self {
        // One limb more than there are bits is rounded, and what is further down tilts it.
        let most = bits / 64 + 2;
        let limbs = &self.limbs()[..self.count.min(most)];
        buffered(limbs.len(), |buffer| {
            buffer.copy_from_slice(limbs);
            if self.count > most {
                buffer[most - 1] |= 1;
            }
            rounded(self.negative, self.top, buffer, bits)
        })
    }

    pub fn negated(&self) -> Self {
        Self { negative: !self.negative && self.count > 0, ..self.clone() }
    }

    /// Returns the number times a power of two.
    pub fn scaled(&self, by: isize) -> Self {
        Self { top: if self.count > 0 { self.top + by } else { 0 }, ..self.clone() }
    }

    #[inline]
    pub fn plus(&self, other: &Self, bits: usize) -> Self {
        self.signed_sum(other, other.negative, bits)
    }

    pub fn minus(&self, other: &Self, bits: usize) -> Self {
        self.signed_sum(other, !other.negative, bits)
    }

    /// Adds a number with another sign.
    fn signed_sum(&self, other: &Self, negative: bool, bits: usize) -> Self {
        if other.is_zero() {
            return self.with_bits(bits);
        }
        if self.is_zero() {
            return Self { negative, ..other.with_bits(bits) };
        }
        let order = self.top.cmp(&other.top).then_with(|| self.limbs().cmp(other.limbs()));
        let ((large, sign), small) = match order {
            Ordering::Less => ((other, negative), self),
            _ => ((self, self.negative), other),
        };
        let apart = (large.top - small.top) as usize;
        // With two limbs more than there are digits, what is beyond them matters little.
        let most = large.count.max(small.count).max(length(bits)) + 2;
        let reach = large.count.max(small.count + length(apart)).min(most);
        buffered(reach + 1, |buffer| {
            place(small.limbs(), apart, &mut buffer[1..]);
            let mut over = false;
            let rest = &mut buffer[1..];
            match self.negative == negative {
                true => {
                    for (there, limb) in rest[..large.count].iter_mut().zip(large.limbs()).rev() {
                        let (sum, first) = there.overflowing_add(*limb);
                        let (sum, second) = sum.overflowing_add(over.into());
                        (*there, over) = (sum, first | second);
                    }
                    buffer[0] = over.into();
                }
                false => {
                    let (above, below) = rest.split_at_mut(large.count);
                    for there in below.iter_mut().rev() {
                        let (less, first) = 0u64.overflowing_sub(*there);
                        let (less, second) = less.overflowing_sub(over.into());
                        (*there, over) = (less, first | second);
                    }
                    for (there, limb) in above.iter_mut().zip(large.limbs()).rev() {
                        let (less, first) = limb.overflowing_sub(*there);
                        let (less, second) = less.overflowing_sub(over.into());
                        (*there, over) = (less, first | second);
                    }
                }
            }
            rounded(sign, large.top + 64, buffer, bits)
        })
    }

    pub fn times(&self, other: &Self, bits: usize) -> Self {
        let (a, b) = (self.limbs(), other.limbs());
        buffered(a.len() + b.len(), |buffer| {
            for (k, by) in a.iter().enumerate().rev() {
                let row = &mut buffer[k..=k + b.len()];
                row[0] = add_product(&mut row[1..], b, *by);
            }
            rounded(self.negative != other.negative, self.top + other.top, buffer, bits)
        })
    }

    /// Divides by a number that is not 0.
    pub fn over(&self, other: &Self, bits: usize) -> Self {
        let (a, b) = (self.limbs(), other.limbs());
        // The first limb of the quotient is 0 or 1.
        let count = length(bits).max(a.len().saturating_sub(b.len())) + 2;
        let (negative, top) = (self.negative != other.negative, self.top - other.top + 64);
        if let [by] = *b {
            return buffered(count, |buffer| {
                buffer[..a.len()].copy_from_slice(a);
                let mut rest: u64 = 0;
                for limb in buffer.iter_mut() {
                    let there = u128::from(rest) << 64 | u128::from(*limb);
                    *limb = (there / u128::from(by)) as u64;
                    rest = (there % u128::from(by)) as u64;
                }
                buffer[count - 1] |= u64::from(rest != 0);
                rounded(negative, top, buffer, bits)
            });
        }
        buffered(count + b.len(), |rest| {
            rest[1..=a.len()].copy_from_slice(a);
            buffered(count, |buffer| {
                for (k, digit) in buffer.iter_mut().enumerate() {
                    let own = &mut rest[k..=k + b.len()];
                    let mut guess = quotient([own[0], own[1], own[2]], [b[0], b[1]]);
                    if is_overdrawn(own, b, guess) {
                        guess -= 1;
                        let mut over = false;
                        for (there, limb) in own[1..].iter_mut().zip(b).rev() {
                            let (sum, first) = there.overflowing_add(*limb);
                            let (sum, second) = sum.overflowing_add(over.into());
                            (*there, over) = (sum, first | second);
                        }
                        own[0] = own[0].wrapping_add(over.into());
                    }
                    *digit = guess;
                }
                buffer[count - 1] |= u64::from(rest.iter().any(|limb| *limb != 0));
                rounded(negative, top, buffer, bits)
            })
        })
    }

    /// Computes the root of a positive number.
    pub fn root(&self, bits: usize) -> Self {
        let turns = self.top.div_euclid(2) + self.top.rem_euclid(2);
        let own = self.scaled(-2 * turns);
        // Newton's method for 1/√m with m from 1/4 to 1.
        let mut inverse = Self::exactly(own.nearest().sqrt().recip());
        let (wanted, mut right) = (bits.div_ceil(2) + GUARD / 2 + 8, 48);
        while right < wanted {
            right = (2 * right - 2).min(wanted);
            let fine = right + 8;
            let rest = inverse.times(&inverse, fine).times(&own.with_bits(fine), fine);
            let gap = Self::whole(1).minus(&rest, fine).times(&inverse, fine);
            inverse = inverse.plus(&gap.scaled(-1), fine);
        }
        let near = inverse.times(&own, wanted);
        let gap = own.minus(&near.times(&near, 2 * wanted), wanted).times(&inverse, wanted);
        near.plus(&gap.scaled(-1), bits).scaled(turns)
    }
}

/// Estimates a limb of a quotient from three limbs and two; at most 1 too large.
fn quotient([a, b, c]: [u64; 3], [by, next]: [u64; 2]) -> u64 {
    let wide = u128::from(a) << 64 | u128::from(b);
    let by = u128::from(by);
    let mut guess = if u128::from(a) >= by { u64::MAX.into() } else { wide / by };
    let mut rest = wide - guess * by;
    while rest >> 64 == 0 && guess * u128::from(next) > (rest << 64 | u128::from(c)) {
        guess -= 1;
        rest += by;
    }
    guess as u64
}
