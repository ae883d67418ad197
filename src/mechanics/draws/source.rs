//! Sources of single numbers: lists, signs, ranges and directions.

#![allow(clippy::needless_range_loop, reason = "loops over lanes become vectors")]

use num_bigint::BigInt;
use num_integer::Integer;

use super::super::recipe::{Draw, NumberLine, Range};
use super::super::streams::WIDTH;
use crate::engine::InputExtent;
use crate::number::ball::about;
use crate::number::rational::Rational;

/// Number of states with short decimals.
const SHORT: u64 = 64;
/// Number of states whose first attempt takes directions inside the range alone, so that the first
/// witnesses are easy to read.
const INSIDE: u64 = 32;

/// Source of one number.
#[derive(Clone, Debug)]
pub enum NumberSource {
    List(Vec<Rational>),
    /// A sign, 1 or −1.
    Sign,
    Range {
        /// Grid of short decimals.
        grid: Grid,
        /// Ends of the range, rounded inwards.
        ends: [f64; 2],
        /// Square of the upper end, if numbers outside of the range are drawn as well.
        square: Option<Rational>,
        /// The same range, if its numbers can be drawn without looking at each.
        plain: Option<PlainRange>,
    },
}

/// A range of finite width with f64s inside, from which no number outside is drawn.
#[derive(Clone, Copy, Debug)]
pub struct PlainRange {
    ends: [f64; 2],
    /// The least and the greatest f64 inside.
    inner: [f64; 2],
    /// Whether 0 is inside.
    contains_zero: bool,
}

impl PlainRange {
    fn new(ends: [f64; 2]) -> Option<Self> {
        let [low, high] = ends;
        let inner = [low.next_up(), high.next_down()];
        // Ends rounded inwards may have changed places.
        let is_plain = inner[0] <= inner[1] && (high - low).is_finite();
        is_plain.then_some(Self { ends, inner, contains_zero: low < 0.0 && high > 0.0 })
    }

    /// Draws numbers made of these bits, and marks those that must be drawn otherwise: the first bit
    /// of their words becomes 1.
    #[inline(always)]
    pub fn draw(&self, bits: &[u64; WIDTH], to: &mut [f64; WIDTH], outside: &mut [u64; WIDTH]) {
        for lane in 0..WIDTH {
            let value = at_share(self.ends, bits[lane]);
            to[lane] = value;
            outside[lane] |= sign_outside(value, self.inner);
        }
        if self.contains_zero {
            for lane in 0..WIDTH {
                outside[lane] |= sign_at_zero(to[lane]);
            }
        }
    }
}

/// Properties of the numbers of a state that follow from its index.
#[derive(Clone, Copy)]
pub struct Manner {
    /// Whether they are short decimals.
    is_short: bool,
    /// Whether directions may lie outside of their range.
    reaches_out: bool,
}

/// Whether the numbers of a state, and so perhaps of some after it, are short decimals.
#[inline(always)]
pub fn is_short(index: u64) -> bool {
    index < SHORT
}

impl Manner {
    /// Finds these properties for an attempt at a state.
    pub fn of(index: u64, attempt: u32) -> Self {
        Self { is_short: is_short(index), reaches_out: index >= INSIDE || attempt > 0 }
    }
}

/// A grid of equidistant decimals inside a range.
#[derive(Clone, Debug)]
pub enum Grid {
    /// The numbers `low + n step` for n in 1..=count.
    Any { low: Rational, step: Rational, count: u64 },
    /// The same over a common denominator, where all parts are small: `(low + n step)/denominator`.
    Small { low: i64, step: i64, denominator: i64, count: u64 },
}

impl NumberSource {
    /// Returns the range, if its numbers can be drawn without looking at each.
    #[inline(always)]
    pub fn plain(&self) -> Option<&PlainRange> {
        match self {
            NumberSource::Range { plain, .. } => plain.as_ref(),
            _ => None,
        }
    }

    /// Encloses the numbers of the states from `index` on, made of these bits.
    #[inline(always)]
    pub fn enclose(&self, index: u64, bits: &[u64; WIDTH], mid: &mut [f64], rad: &mut [f64]) {
        if let (NumberSource::Range { ends, square: Some(square), .. }, false) =
            (self, is_short(index))
            && let Some(range) = PlainRange::new(*ends)
        {
            // Loops over lanes with bits of words in place of flags become vectors.
            let (mut values, mut outside) = ([0.0; WIDTH], [0u64; WIDTH]);
            range.draw(bits, &mut values, &mut outside);
            let square = square.to_f64().0;
            let mut beyond = [0.0; WIDTH];
            for lane in 0..WIDTH {
                beyond[lane] = square / values[lane];
            }
            for lane in 0..WIDTH {
                let is_outside = is_outside(bits[lane]);
                values[lane] = if is_outside { beyond[lane] } else { values[lane] };
            }
            let has_sign = outside.iter().fold(0, |any, one| any | one) >> 63 == 1;
            if !has_sign {
                match (<&mut [f64; WIDTH]>::try_from(&mut *mid), rad.first_chunk_mut()) {
                    (Ok(mid), Some(rad)) => (*mid, *rad) = (values, [0.0; WIDTH]),
                    _ => {
                        mid.copy_from_slice(&values[..mid.len()]);
                        rad.fill(0.0);
                    }
                }
                return;
            }
        }
        for (lane, (mid, rad)) in mid.iter_mut().zip(rad).enumerate() {
            let manner = Manner::of(index + lane as u64, 0);
            (*mid, *rad) = about(self.nearest(bits[lane], manner));
        }
    }

    /// Prepares the source of a draw.
    pub fn new(draw: &Draw) -> Self {
        match draw {
            Draw::OneOf(values) => NumberSource::List(values.clone()),
            Draw::Sign => NumberSource::Sign,
            Draw::Within(range) | Draw::Of(_, range) => {
                let inwards = |end: &Rational, other: &Rational| {
                    let (nearest, is_exact) = end.to_f64();
                    match (is_exact, end < other) {
                        (true, _) => nearest,
                        (false, true) => nearest.next_up(),
                        (false, false) => nearest.next_down(),
                    }
                };
                let ends = [inwards(&range.low, &range.high), inwards(&range.high, &range.low)];
                let square = matches!(draw, Draw::Of(NumberLine::Directions, _))
                    .then(|| &range.high * &range.high);
                let plain = if square.is_none() { PlainRange::new(ends) } else { None };
                NumberSource::Range { grid: Grid::of(range), ends, square, plain }
            }
        }
    }

    /// Where the midpoints lie if they are exact, and the largest radius of those that are not so by
    /// chance.
    pub fn extent(&self) -> InputExtent {
        match self {
            NumberSource::List(values) => {
                let all = values.iter().map(|value| about(value.to_f64()));
                let none = ([f64::INFINITY, f64::NEG_INFINITY], 0.0);
                let (ends, radius) = all.fold(none, |([low, high], most), (mid, rad)| {
                    ([low.min(mid), high.max(mid)], f64::max(most, rad))
                });
                InputExtent { ends, radius }
            }
            NumberSource::Sign => InputExtent { ends: [-1.0, 1.0], radius: 0.0 },
            // Those outside of the range are as large as you like.
            NumberSource::Range { square: Some(_), .. } => {
                InputExtent { ends: [f64::NEG_INFINITY, f64::INFINITY], radius: 0.0 }
            }
            NumberSource::Range { ends, square: None, .. } => {
                InputExtent { ends: *ends, radius: 0.0 }
            }
        }
    }

    /// Returns the result of `pick` in f64, without making a rational number where parts are small.
    pub fn nearest(&self, bits: u64, manner: Manner) -> (f64, bool) {
        match self {
            NumberSource::Sign => (sign(bits) as f64, true),
            NumberSource::Range { square: Some(_), .. }
                if manner.reaches_out && is_outside(bits) =>
            {
                self.pick(bits, manner).to_f64()
            }
            NumberSource::Range { grid, .. } if manner.is_short => grid.nearest(bits),
            NumberSource::Range { ends, grid, .. } => match between(*ends, bits) {
                Some(value) => (value, true),
                None => grid.nearest(bits),
            },
            NumberSource::List(_) => self.pick(bits, manner).to_f64(),
        }
    }

    /// Draws a number made of random bits.
    pub fn pick(&self, bits: u64, manner: Manner) -> Rational {
        match self {
            NumberSource::List(values) => {
                let index = scale(bits, values.len() as u64) as usize;
                values.get(index).cloned().unwrap_or_else(|| Rational::from(0))
            }
            NumberSource::Sign => Rational::from(sign(bits)),
            NumberSource::Range { grid, ends, square, .. } => {
                let inside = if manner.is_short { None } else { between(*ends, bits) };
                match square.as_ref().filter(|_| manner.reaches_out && is_outside(bits)) {
                    None => inside.and_then(Rational::from_f64).unwrap_or_else(|| grid.pick(bits)),
                    Some(square) => inside
                        .and_then(|inside| Rational::from_f64(square.to_f64().0 / inside))
                        .or_else(|| Some(square * &grid.pick(bits).recip()?))
                        .unwrap_or_else(|| grid.pick(bits)),
                }
            }
        }
    }

    /// Draws a number near one of both ends or 0, or any number, up to a thousandth of the range.
    /// The ends of directions are at infinity.
    pub fn edge(&self, bits: u64, manner: Manner) -> Rational {
        let (near, bits) = self.near(bits);
        near.and_then(Rational::from_f64).unwrap_or_else(|| self.pick(bits, manner))
    }

    /// Returns the f64 nearest to [`NumberSource::edge`], and whether it is exact.
    pub fn nearest_edge(&self, bits: u64, manner: Manner) -> (f64, bool) {
        let (near, bits) = self.near(bits);
        near.map_or_else(|| self.nearest(bits, manner), |near| (near, true))
    }

    /// Draws a number near an end or 0, if one of those is drawn, and the bits that are left.
    fn near(&self, bits: u64) -> (Option<f64>, u64) {
        const NEAR: f64 = 1.0 / 1024.0;
        let (place, bits) = (bits % 4, bits >> 2 << 2);
        let near = match self {
            NumberSource::Range { ends: [low, high], square, .. } => {
                let width = NEAR * (high - low);
                let far = |ends| Some(square.as_ref()?.to_f64().0 / between(ends, bits)?);
                match place {
                    0 if square.is_some() => far([-width, 0.0]),
                    1 if square.is_some() => far([0.0, width]),
                    0 => between([*low, low + width], bits),
                    1 => between([high - width, *high], bits),
                    2 if *low < 0.0 && *high > 0.0 => between([-width, width], bits),
                    _ => None,
                }
            }
            _ => None,
        };
        (near, bits)
    }
}

/// Whether a direction is drawn outside of its range: one of four.
#[inline(always)]
fn is_outside(bits: u64) -> bool {
    bits >> 2 & 3 == 0
}

fn sign(bits: u64) -> i64 {
    if bits >> 63 == 0 { 1 } else { -1 }
}

/// Draws a number strictly between two ends and not 0, if f64 has one.
fn between([low, high]: [f64; 2], bits: u64) -> Option<f64> {
    let value = at_share([low, high], bits);
    (low < value && value < high && value != 0.0).then_some(value)
}

/// A word whose first bit is 0 only if a finite number is one of two or between them: differences of
/// different numbers are not 0, and have the right sign.
#[inline(always)]
pub(super) fn sign_outside(value: f64, [least, greatest]: [f64; 2]) -> u64 {
    (value - least).to_bits() | (greatest - value).to_bits()
}

/// A word whose first bit is 1 only for 0: that of x − 1 is 1 if x is 0.
#[inline(always)]
pub(super) fn sign_at_zero(value: f64) -> u64 {
    (value.to_bits() & (u64::MAX >> 1)).wrapping_sub(1)
}

/// Computes the number at a random share of the way between two ends.
#[inline(always)]
fn at_share([low, high]: [f64; 2], bits: u64) -> f64 {
    /// The factor 2⁻⁵³.
    const UNIT: f64 = f64::EPSILON / 2.0;
    // 53 bits, and a half so that neither end is attained.
    let share = ((bits >> 11) as f64 + 0.5) * UNIT;
    low + (high - low) * share
}

impl Grid {
    fn of(range: &Range) -> Self {
        let width = &range.high - &range.low;
        let (step, count) = grid(&width);
        let low = range.low.clone();
        if let Some(grid) = small_grid(&low, &step, count) {
            return grid;
        }
        // From an end of many digits, such as −π, the grid begins at the next multiple of its step.
        let short = steps_up(&low, &step).map(|steps| &steps * &step);
        let shortened = short.and_then(|short| small_grid(&short, &step, count - 1));
        shortened.filter(|_| count > 1).unwrap_or(Grid::Any { low, step, count })
    }

    fn nearest(&self, bits: u64) -> (f64, bool) {
        const EXACT: u64 = 1 << f64::MANTISSA_DIGITS;
        if let Grid::Small { low, step, denominator, count } = self {
            let value = numerator(bits, *low, *step, *count);
            if value.unsigned_abs() <= EXACT {
                // Both are f64s, and division rounds correctly; a power of two divides exactly.
                let odd = denominator >> denominator.trailing_zeros();
                return (value as f64 / *denominator as f64, value % odd == 0);
            }
        }
        self.pick(bits).to_f64()
    }

    fn pick(&self, bits: u64) -> Rational {
        match self {
            Grid::Small { low, step, denominator, count } => {
                Rational::new(numerator(bits, *low, *step, *count), *denominator)
            }
            Grid::Any { low, step, count } => {
                let value = low + &(step * &Rational::from(1 + scale(bits, *count) as i64));
                // Some false formulas hold on coordinate planes.
                if value.is_zero() { &value + step } else { value }
            }
        }
    }
}

/// Least whole number of steps that is not below a number.
fn steps_up(number: &Rational, step: &Rational) -> Option<Rational> {
    let (above, below) = (number * &step.recip()?).parts();
    Some(Rational::from_parts(-(-above).div_floor(&below), BigInt::from(1)))
}

/// Returns a number of a grid, times its denominator.
fn numerator(bits: u64, low: i64, step: i64, count: u64) -> i64 {
    let value = low + step * (1 + scale(bits, count) as i64);
    if value == 0 { step } else { value }
}

/// Brings both numbers over one denominator, if a grid of them cannot overflow.
fn small_grid(low: &Rational, step: &Rational, count: u64) -> Option<Grid> {
    const SMALL: i64 = 1 << 31;
    let (_, below) = low.parts();
    let (_, beside) = step.parts();
    let denominator = i64::try_from(&below * &beside).ok().filter(|d| *d < SMALL)?;
    let over = |x: &Rational| (x * &Rational::from(denominator)).to_integer();
    let (low, step) = (over(low)?, over(step)?);
    let room = low.abs() < SMALL && step < SMALL && count < SMALL as u64;
    room.then_some(Grid::Small { low, step, denominator, count })
}

/// Chooses a step of the form 10^k; returns it with the number of points strictly inside `width`,
/// about a thousand.
fn grid(width: &Rational) -> (Rational, u64) {
    let (size, _) = width.to_f64();
    let exponent = (size.log10().floor() as i32).clamp(-400, 400) - 3;
    let step = Rational::from(10).powi(exponent).unwrap_or_else(|| Rational::from(1));
    let (steps, _) = step.recip().map_or((1000.0, true), |inverse| (width * &inverse).to_f64());
    // One point is reserved for the step away from 0.
    (step, (steps.ceil() as u64).saturating_sub(2).max(1))
}

/// Maps 64 random bits to 0..count, by multiplication.
fn scale(bits: u64, count: u64) -> u64 {
    ((u128::from(bits) * u128::from(count)) >> 64) as u64
}
