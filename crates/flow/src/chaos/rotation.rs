//! Rotation numbers of motions on a section: the mean advance of an angle from crossing to crossing.
//!
//! The mean of n advances Δ is weighted by w(t) = e^(−1/(t(1 − t))) at t = k/(n + 1). On a curve where
//! the motion is quasi-periodic it converges faster than any power of n (Das, Saiki, Sander, Yorke
//! 2017). An advance is known up to whole turns: of the possible choices the one is taken for which the
//! map of the angles varies least, since a map of a curve round the centre keeps their order.

use std::f64::consts::TAU;

use liouville::order::StableOrder;

use crate::closed::through::MeasuredNumber;

/// Smallest number of advances of which a mean is taken.
const LEAST: usize = 16;
/// Number of gaps between advances at which the choice of whole turns is tried.
const CUTS: usize = 32;
/// Disorder of neighbouring angles that rounding explains, in turns.
const ROUNDING: f64 = 1e-9;
/// Largest product of the error and the square of a denominator at which a fraction is no accident.
const CHANCE: f64 = 1e-3;
/// Largest number of triples of angles that are compared, and the distance between neighbours on a
/// curve, in the size of the whole and 1/√n.
const MOST_TRIPLES: usize = 1500;
const THIN: f64 = 0.15;
/// Number of times an orbit has to go through all islands of a chain.
const ROUNDS: u64 = 8;

/// Rotation number of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotationNumber {
    /// Turns from one crossing to the next, from 0 up to 1.
    pub turns: MeasuredNumber,
    /// Fraction p/q, in lowest terms, if the error hardly leaves another explanation.
    pub resonance: Option<(u64, u64)>,
}

impl RotationNumber {
    /// Computes the rotation number from the angles of successive crossings, in radians.
    ///
    /// `None` where there is none to be seen: the order of the angles is not kept, as in chaos, and no
    /// fraction stands out; or there are too few crossings.
    pub fn of(angles: &[f64]) -> Option<Self> {
        let angles: Vec<f64> = angles.iter().map(|angle| turned(angle / TAU)).collect();
        let count = angles.len().checked_sub(1).filter(|count| *count >= LEAST)?;
        if angles.iter().any(|angle| !angle.is_finite()) {
            return None;
        }
        let advances: Vec<f64> = angles.windows(2).map(|pair| turned(pair[1] - pair[0])).collect();
        let order = Order::new(&angles[..count]);
        let maps = cuts(&advances).into_iter().map(|cut| lifted(&advances, cut));
        let lifts = maps.min_by(|a, b| order.variation(a).total_cmp(&order.variation(b)))?;
        let half = count / 2;
        let means = [&lifts[..], &lifts[..half], &lifts[count - half..]].map(weighted_mean);
        let apart = |(i, j): (usize, usize)| f64::abs(means[i] - means[j]);
        let error = [(0, 1), (0, 2), (1, 2)].map(apart).into_iter().fold(0.0, f64::max);
        // Each crossing is known to rounding.
        let error = error.max(f64::EPSILON * count as f64);
        let most = (count as u64 / ROUNDS).max(1);
        let resonance = simplest(means[0] - error, means[0] + error, most);
        let resonance = resonance.filter(|(_, q)| error * (*q as f64).powi(2) <= CHANCE);
        if !order.is_kept(&lifts) && !resonance.is_some_and(|own| order.is_of_islands(own)) {
            return (order.is_seen_aside() && is_curve(&angles)).then(|| Self::none(&angles));
        }
        let resonance = resonance.map(|(p, q)| (p % q, q));
        // Just below a whole turn is just below 0.
        let whole = resonance.is_some_and(|(p, _)| p == 0);
        let value = if whole { 0.0 } else { turned(means[0]) };
        Some(Self { turns: MeasuredNumber { value, error }, resonance })
    }

    /// Number of a motion that does not go round the centre.
    fn none(angles: &[f64]) -> Self {
        // What it comes and goes is less than a half turn.
        let error = 0.5 / angles.len() as f64;
        Self { turns: MeasuredNumber { value: 0.0, error }, resonance: Some((0, 1)) }
    }
}

/// The part of a number of turns beyond whole ones.
fn turned(turns: f64) -> f64 {
    let rest = turns - libm::floor(turns);
    if rest >= 1.0 { 0.0 } else { rest }
}

/// Angles in their order round the circle.
struct Order<'a> {
    angles: &'a [f64],
    places: Vec<usize>,
}

impl<'a> Order<'a> {
    fn new(angles: &'a [f64]) -> Self {
        let mut places: Vec<usize> = (0..angles.len()).collect();
        places.order_by(|a, b| angles[*a].total_cmp(&angles[*b]));
        Self { angles, places }
    }

    /// Steps between the images of neighbours, once round the circle.
    fn steps(&self, lifts: &[f64]) -> impl Iterator<Item = f64> {
        let image = |place: usize| self.angles[place] + lifts[place];
        let next = self.places.iter().skip(1).map(move |place| image(*place));
        let first = self.places.first().map(|place| image(*place) + 1.0);
        let all = next.chain(first);
        self.places.iter().zip(all).map(move |(place, next)| next - image(*place))
    }

    /// Variation of the map round the circle: 1 if it keeps the order.
    fn variation(&self, lifts: &[f64]) -> f64 {
        self.steps(lifts).map(f64::abs).sum()
    }

    fn is_kept(&self, lifts: &[f64]) -> bool {
        self.steps(lifts).all(|step| step >= -ROUNDING)
    }

    /// Whether the angles lie in q arcs, of which each is mapped to the p-th after it.
    fn is_of_islands(&self, (p, q): (u64, u64)) -> bool {
        let (p, q) = ((p % q) as usize, q as usize);
        let class = |place: &usize| place % q;
        let before = self.places.iter().cycle().skip(self.places.len().saturating_sub(1));
        let begins = before.zip(&self.places).filter(|(one, next)| class(one) != class(next));
        let arcs: Vec<usize> = begins.map(|(_, next)| class(next)).collect();
        if q == 1 {
            return is_curve(self.angles);
        }
        let mut at = vec![None; q];
        arcs.iter().enumerate().for_each(|(place, class)| at[*class] = Some(place));
        arcs.len() == q
            && (0..q).all(|class| match (at[class], at[(class + 1) % q]) {
                (Some(from), Some(to)) => (from + p) % q == to,
                _ => false,
            })
    }

    /// Whether all angles lie within less than a half turn, as those of a convex curve do that does not
    /// enclose the centre.
    fn is_seen_aside(&self) -> bool {
        let ends = |pair: &[usize]| self.angles[pair[1]] - self.angles[pair[0]];
        let inner = self.places.windows(2).map(ends).fold(0.0, f64::max);
        let round = match (self.places.first(), self.places.last()) {
            (Some(first), Some(last)) => self.angles[*first] + 1.0 - self.angles[*last],
            _ => 0.0,
        };
        inner.max(round) > 0.5
    }
}

/// Whether successive angles lie near a curve or a few points, as they do not in chaos: the distance
/// from one triple to the nearest other falls as 1/n on a curve, and as 1/√n or slower on an area.
fn is_curve(angles: &[f64]) -> bool {
    let Some(first) = angles.first() else { return false };
    let near: Vec<f64> = angles.iter().map(|angle| turned(angle - first + 0.5)).collect();
    let stride = near.len() / MOST_TRIPLES + 1;
    let triples: Vec<&[f64]> = near.windows(3).step_by(stride).collect();
    let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>();
    let nearest = |index: usize| {
        let others = triples.iter().enumerate().filter(|(other, _)| *other != index);
        others.map(|(_, other)| apart(triples[index], other)).fold(f64::INFINITY, f64::min)
    };
    let mut squares: Vec<f64> = (0..triples.len()).map(nearest).collect();
    squares.order_by(f64::total_cmp);
    let median = squares.get(squares.len() / 2).map_or(f64::NAN, |square| square.sqrt());
    let extent = |place: usize| {
        let values = triples.iter().map(|own| own[place]);
        let ends = values
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        ends[1] - ends[0]
    };
    let size = (0..3).map(|place| extent(place) * extent(place)).sum::<f64>().sqrt();
    median * (triples.len() as f64).sqrt() <= THIN * size
}

/// Values below which an advance gets another turn: in the middle of the widest gaps between advances.
fn cuts(advances: &[f64]) -> Vec<f64> {
    let mut sorted = advances.to_vec();
    sorted.order_by(f64::total_cmp);
    let first = sorted.first().map(|first| first + 1.0);
    let ends = sorted.iter().skip(1).copied().chain(first);
    let mut gaps: Vec<[f64; 2]> =
        sorted.iter().zip(ends).map(|(from, to)| [to - from, (from + to) / 2.0]).collect();
    gaps.order_by(|a, b| b[0].total_cmp(&a[0]));
    gaps.into_iter().take(CUTS).map(|[_, middle]| turned(middle)).collect()
}

fn lifted(advances: &[f64], cut: f64) -> Vec<f64> {
    advances.iter().map(|own| if *own < cut { own + 1.0 } else { *own }).collect()
}

/// Mean weighted by e^(−1/(t(1 − t))).
fn weighted_mean(values: &[f64]) -> f64 {
    let count = values.len() as f64 + 1.0;
    let weight = |index: usize| {
        let t = (index as f64 + 1.0) / count;
        libm::exp(-1.0 / (t * (1.0 - t)))
    };
    // The deviations from the first value are small for a nearly uniform turn.
    let first = values.first().copied().unwrap_or(f64::NAN);
    let terms = values.iter().enumerate().map(|(index, value)| weight(index) * (value - first));
    let total: f64 = (0..values.len()).map(weight).sum();
    first + terms.sum::<f64>() / total
}

/// Fraction of the smallest denominator, up to `most`, between two numbers that are not negative.
fn simplest(low: f64, high: f64, most: u64) -> Option<(u64, u64)> {
    (1..=most).find_map(|q| {
        let p = libm::ceil(low * q as f64).max(0.0);
        (p <= high * q as f64).then_some((p as u64, q))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Angles of an orbit of θ ↦ θ + 2πρ, seen through an angle that turns unevenly.
    fn seen(turns: f64, count: usize, uneven: f64) -> Vec<f64> {
        let angle = |k: usize| TAU * turned(turns * k as f64 + 0.1);
        (0..count).map(|k| angle(k) + uneven * libm::sin(angle(k))).collect()
    }

    #[test]
    fn an_uneven_turn_has_the_number_of_the_even_one() {
        let golden = (5f64.sqrt() - 1.0) / 2.0;
        let slow = 0.02 * golden;
        for (exact, uneven) in [(golden, 0.0), (golden, 0.7), (slow, 0.9), (1.0 - slow, 0.8)] {
            let found = RotationNumber::of(&seen(exact, 2000, uneven)).expect("a number");
            let error = (found.turns.value - exact).abs();
            assert!(error <= found.turns.error && error < 1e-8, "{exact} {found:?}");
            assert_eq!(found.resonance, None, "{exact}");
            // Angles counted the other way round.
            let back: Vec<f64> = seen(exact, 2000, uneven).iter().map(|angle| -angle).collect();
            let back = RotationNumber::of(&back).expect("a number");
            assert!((back.turns.value - (1.0 - exact)).abs() < 1e-8, "{exact} {back:?}");
        }
    }

    #[test]
    fn islands_have_a_fraction() {
        // A point that goes round each of three islands as they follow each other.
        let island = |k: usize| {
            let own = TAU * 0.0417 * k as f64;
            TAU * (k % 3) as f64 / 3.0 + 0.4 * libm::sin(own)
        };
        let angles: Vec<f64> = (0..2000).map(island).collect();
        let found = RotationNumber::of(&angles).expect("a number");
        assert_eq!(found.resonance, Some((1, 3)), "{found:?}");
        let twice: Vec<f64> = (0..2000).map(|k| island(2 * k)).collect();
        assert_eq!(RotationNumber::of(&twice).and_then(|own| own.resonance), Some((2, 3)));
        // A cycle of two points near each other still turns once in two crossings.
        let near: Vec<f64> = (0..200).map(|k| 0.3 * (k % 2) as f64).collect();
        assert_eq!(RotationNumber::of(&near).and_then(|own| own.resonance), Some((1, 2)));
        let rest = RotationNumber::of(&[1.25; 100]).expect("a number");
        assert_eq!((rest.resonance, rest.turns.value), (Some((0, 1)), 0.0));
    }

    #[test]
    fn curves_aside_of_the_centre_do_not_turn() {
        // An invariant circle of radius 0.4 about a point at a distance of 1 from the centre
        for turns in [0.6 + 1e-4, 8.0 / 15.0 + 1e-6, 0.618_033_988_749_894_9, 16.0 / 17.0 + 1e-7] {
            let at = |k: usize| {
                let angle = TAU * turns * k as f64;
                libm::atan2(0.4 * libm::sin(angle), 1.0 + 0.4 * libm::cos(angle))
            };
            let angles: Vec<f64> = (0..2000).map(at).collect();
            let found = RotationNumber::of(&angles).expect("a number");
            assert_eq!((found.resonance, found.turns.value), (Some((0, 1)), 0.0), "{turns}");
        }
        // Islands that follow each other in another order than round the circle have no number.
        let mixed =
            |k: usize| TAU * [0.0, 0.2, 0.1, 0.5, 0.7][k % 5] + 0.1 * libm::sin(0.3 * k as f64);
        assert_eq!(RotationNumber::of(&(0..2000).map(mixed).collect::<Vec<f64>>()), None);
    }

    #[test]
    fn disorder_has_no_number() {
        // The standard map at K = 7.3, far from its islands.
        let (mut angle, mut momentum) = (0.5f64, 0.1f64);
        let mut angles = Vec::new();
        for _ in 0..4000 {
            momentum += 7.3 * libm::sin(angle);
            angle += momentum;
            angles.push(angle);
        }
        assert_eq!(RotationNumber::of(&angles), None);
        // The same, wrapped round a torus that is seen from a point beside it.
        let aside = |pair: &[f64]| {
            let wrapped = |x: f64| x - TAU * libm::floor(x / TAU + 0.5);
            libm::atan2(wrapped(pair[1] - pair[0]), wrapped(pair[1]) + 8.0)
        };
        let seen: Vec<f64> = angles.windows(2).map(aside).collect();
        assert_eq!(RotationNumber::of(&seen), None, "chaos within less than a half turn");
        assert_eq!(RotationNumber::of(&[0.1, f64::NAN].repeat(100)), None);
        assert_eq!(RotationNumber::of(&[0.1, 0.2, 0.3]), None, "too few");
    }
}
