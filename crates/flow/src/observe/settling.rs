//! Sequences that tend to a limit, as far as a few of their members show.

use crate::MeasuredNumber;

/// Least number of members that show a limit if they differ by rounding alone.
pub const FEWEST: usize = 3;
/// Least number that shows one by differences that fall.
const FEWEST_FALLING: usize = 4;
/// Least number at the end of a longer sequence.
const FEWEST_LAST: usize = 5;
/// Largest ratio of differences: that of fourth roots of numbers that fall to a third. Sequences that
/// fall more slowly, as 1/ln ε does, are farther from their limit than a geometric series says.
const SLOWEST: f64 = 0.76;

/// The limit of a sequence whose members have some noise. All differences fall, or the last ones do,
/// of at least five members. The error is the sum of the geometric series that begins with the last
/// difference and has the largest of their ratios.
pub fn settled(members: &[f64], noises: &[f64]) -> Option<MeasuredNumber> {
    let longest = members.len();
    let shorter = (1..longest).take_while(|skipped| longest - skipped >= FEWEST_LAST);
    std::iter::once(0)
        .chain(shorter)
        .find_map(|skipped| limit(&members[skipped..], &noises[skipped..]))
}

/// The limit of a sequence all of whose differences fall.
fn limit(members: &[f64], noises: &[f64]) -> Option<MeasuredNumber> {
    let pairs = members.windows(2).zip(noises.windows(2));
    let differences: Vec<(f64, f64)> =
        pairs.map(|(x, noise)| ((x[1] - x[0]).abs(), noise[0] + noise[1])).collect();
    let is_rounding = |(difference, noise): &(f64, f64)| difference <= noise;
    let fewest = if differences.iter().all(is_rounding) { FEWEST } else { FEWEST_FALLING };
    let (value, last) = (*members.last()?, *differences.last()?);
    if members.len() < fewest {
        return None;
    }
    let mut ratio: f64 = 0.0;
    for pair in differences.windows(2) {
        match (is_rounding(&pair[0]), is_rounding(&pair[1])) {
            (_, true) => {}
            // What rises above the noise again has not settled.
            (true, false) => return None,
            (false, false) => ratio = ratio.max(pair[1].0 / pair[0].0),
        }
    }
    let rest = if is_rounding(&last) { 0.0 } else { last.0 * ratio / (1.0 - ratio) };
    let is_falling = ratio <= SLOWEST && value.is_finite();
    is_falling.then(|| MeasuredNumber { value, error: rest.max(last.1) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values at 1, 1/3, 1/10, …, of a function.
    fn seen(function: impl Fn(f64) -> f64) -> Option<f64> {
        let at = [1.0, 3.0, 10.0, 40.0, 120.0, 400.0, 1600.0].map(|d| function(1.0 / d));
        let found = settled(&at, &[1e-15; 7])?;
        assert!((found.value - function(0.0)).abs() <= found.error, "within the error");
        Some(found.error)
    }

    #[test]
    fn powers_settle_within_their_error() {
        assert!(seen(|x| 2.0 + x).is_some_and(|error| error < 2e-3), "analytic");
        assert!(seen(|x| 2.0 - x * x).is_some_and(|error| error < 1e-5), "of second order");
        assert!(seen(|x| 2.0 + x.sqrt()).is_some_and(|error| error < 0.1), "a root");
        assert!(seen(|_| 2.0).is_some_and(|error| error < 1e-14), "a constant");
    }

    #[test]
    fn what_comes_and_goes_with_the_logarithm_does_not_settle() {
        let waves = |period: f64| {
            move |x: f64| if x > 0.0 { 2.0 + (x.ln() / period).sin() / 10.0 } else { 2.0 }
        };
        for period in [0.3, 1.0, 10f64.ln() / std::f64::consts::TAU] {
            assert_eq!(seen(waves(period)), None, "period {period}");
        }
        assert_eq!(seen(|x| if x > 0.0 { 2.0 + x.ln() } else { 2.0 }), None, "a logarithm");
        let slow = |x: f64| if x > 0.0 { 2.0 + 1.0 / (x.ln() - 1.0) } else { 2.0 };
        assert_eq!(seen(slow), None, "the reciprocal of one");
    }
}
