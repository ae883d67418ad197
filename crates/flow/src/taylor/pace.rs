//! Time, step and progress of one motion, by which one whose end is out of reach is found.

use crate::error::MOST_STEPS;
use crate::taylor::number::SeriesNumber;
use crate::taylor::runaway::Runaway;
use crate::taylor::watch::Edge;
use liouville::number::double_double::DoubleDouble;

/// Number of steps after which the pace of a motion is looked at.
const STRIDE: u64 = 1 << 18;
/// Number of steps that one of many motions does not take on its way to infinity.
const FEW_STEPS: f64 = 1e7;
/// Ratio of a motion's longest step to the present ones, above which these count as shrinking.
const SHRUNK: f64 = 1e6;
/// The same for ends that are out of any reach.
const SHRUNK_EARLY: f64 = 1e5;
/// Numbers of steps at which the pace is looked at before, for ends that are out of any reach.
const EARLY: [u64; 2] = [1 << 11, 1 << 12];
/// Multiple of [`MOST_STEPS`] that counts as out of any reach.
const HOPELESS: f64 = 1e6;
/// Ratio of the steps at two looks, above which they go on shrinking at the same rate.
const TREND: f64 = 1.5;
/// Number of steps after a look from which on it is seen whether they still shrink.
const LATE: u64 = STRIDE / 4 * 3;
/// Ratio of the mean steps since then and since the look, above which they no longer shrink.
const GOES_ON: f64 = 0.95;
/// Ratio of the longest steps at two looks, below which steps do not grow.
const GROWTH: f64 = 1.1;

/// Time and step of one motion.
#[derive(Clone, Copy)]
pub(crate) struct Lane<One> {
    pub(crate) time: DoubleDouble,
    /// Final time; its sign relative to `time` is the direction.
    pub(crate) until: DoubleDouble,
    /// Time to which the motion goes at last, in parts that end earlier.
    pub(crate) aim: DoubleDouble,
    /// Sizes of the state at the start, and at its largest.
    pub(crate) sizes: [f64; 2],
    /// Unit of time of the present expansion.
    pub(crate) unit: f64,
    /// Whether there is one in some unit, as far as is known.
    pub(crate) has_series: bool,
    /// Step from the present expansion in its unit, and size of the one before.
    pub(crate) step: One,
    pub(crate) former: f64,
    pub(crate) steps: u64,
    pub(crate) pace: Pace,
    /// Whether the final time is a stand-in for none.
    pub(crate) is_open: bool,
    /// Whether the present step is cut for a branch point or for a further function.
    pub(crate) is_cut: bool,
    /// Whether halves of a step no longer change the time, and do not follow the field.
    pub(crate) is_stuck: bool,
    /// Number of halves of the present step for its defect, and whether a number that underflows is the
    /// reason.
    pub(crate) halves: u32,
    pub(crate) is_faint: bool,
    /// Operation without a value from a time after the present state on.
    pub(crate) edge: Option<(Edge, One)>,
    /// Operation without a value at the present state, or next to it.
    pub(crate) lost: Option<Edge>,
    /// Whether the signs of moduli are known to be those of the present branch.
    pub(crate) is_settled: bool,
    /// Sign whose argument is 0 at the present state.
    pub(crate) turned: Option<usize>,
    /// Sign that was turned last, while the signs are not settled again.
    pub(crate) came_to: Option<usize>,
    /// Number of steps in turn that ended where they began.
    pub(crate) stalls: u32,
}

impl<One: SeriesNumber> Lane<One> {
    /// A motion at time 0 that ends at time `until`.
    pub(crate) fn new(until: DoubleDouble) -> Self {
        Self {
            time: DoubleDouble::default(),
            until,
            aim: until,
            is_settled: false,
            turned: None,
            came_to: None,
            stalls: 0,
            sizes: [f64::NAN, 0.0],
            unit: 1.0,
            has_series: true,
            step: One::ZERO,
            former: 0.0,
            steps: 0,
            pace: Pace::default(),
            is_open: false,
            is_cut: false,
            is_stuck: false,
            halves: 0,
            is_faint: false,
            edge: None,
            lost: None,
        }
    }

    /// Keeps the size of the present state.
    pub(crate) fn visit(&mut self, size: f64) {
        if self.sizes[0].is_nan() {
            self.sizes[0] = size;
        }
        self.sizes[1] = self.sizes[1].max(size);
    }

    /// Length of the present step; negative backwards in time.
    pub(crate) fn length(&self) -> f64 {
        self.step.leading() * self.unit
    }

    /// Whether the present step changes the time.
    pub(crate) fn moves(&self) -> bool {
        let time = self.time.hi;
        let step = self.length() * (f64::EPSILON / One::EPSILON);
        time + step != time || time == 0.0
    }

    /// Begins a step: what has no value at once is lost already.
    pub(crate) fn begin(&mut self) {
        let at_once = self.edge.filter(|(_, after)| after.leading() == 0.0);
        self.lost = self.lost.or(at_once.and_then(|(edge, _)| edge.ends()));
    }

    /// Goes on by the present step.
    pub(crate) fn advance(&mut self)
    where
        One: SeriesNumber<One = One>,
    {
        let step = self.length();
        self.stalls = if self.moves() { 0 } else { self.stalls + 1 };
        if step != 0.0 {
            self.time = self.time + self.step.pair() * DoubleDouble::from_f64(self.unit);
            self.former = step.abs();
            self.steps += 1;
            let (now, left) = (self.time.hi, (self.aim - self.time).hi);
            self.pace.keep(step, self.steps, now, left);
        }
        let reached =
            self.edge.filter(|(_, after)| self.step.leading().abs() >= after.leading().abs());
        match reached {
            Some((Edge::Sign(sign), _)) => self.turned = Some(sign),
            _ => self.lost = self.lost.or(reached.map(|(edge, _)| edge)),
        }
    }
}

/// Progress of a motion, by which one whose end is out of reach is found.
#[derive(Clone, Copy, Default)]
pub(crate) struct Pace {
    /// Longest step so far, and at the last look.
    longest: f64,
    former: f64,
    /// Time and number of steps at the last look.
    before: f64,
    counted: u64,
    /// Mean step and time at the last looks after 2^k steps, the later one first.
    marks: [Option<(f64, f64)>; 2],
    /// Time at three quarters of the steps between two looks.
    late: f64,
    runaway: Runaway,
    /// Whether the motion is one of many, of which none may take long.
    pub(crate) is_hasty: bool,
    /// Reason why the end is out of reach, if it is.
    pub(crate) lost: Option<Lost>,
}

/// Reason why the end of a motion is out of reach.
#[derive(Clone, Copy)]
pub(crate) enum Lost {
    /// Its steps have shrunk: about so many are left.
    Shrinking(f64),
    /// Its time takes too many steps of its usual size.
    Endless,
}

impl Pace {
    /// Longest step so far.
    pub(crate) fn longest(&self) -> f64 {
        self.longest
    }

    /// Keeps a step; measures the pace after so many of them, with the times that have gone by and
    /// that are left.
    fn keep(&mut self, step: f64, steps: u64, now: f64, left: f64) {
        self.longest = self.longest.max(step.abs());
        if steps % STRIDE == LATE {
            self.late = now;
        }
        let most = if self.is_hasty { FEW_STEPS } else { MOST_STEPS };
        if let Some(rest) = self.runaway.keep(steps, now, left).filter(|rest| *rest > most) {
            self.lost = Some(Lost::Shrinking(rest));
            return;
        }
        let is_early = EARLY.contains(&steps);
        if !is_early && !steps.is_multiple_of(STRIDE) {
            return;
        }
        let mean = (now - self.before).abs() / (steps - self.counted) as f64;
        let most = MOST_STEPS * if is_early { HOPELESS } else { 1.0 };
        if steps.is_power_of_two() {
            self.marks = [Some((mean, now)), self.marks[0]];
        }
        // What has shrunk once need not go on.
        let goes_on = (now - self.late).abs() / ((STRIDE - LATE) as f64) < GOES_ON * mean;
        let growth = if goes_on { self.growth(mean, now, left) } else { 1.0 };
        let rest = left.abs() / mean * growth;
        let shrunk = self.longest / mean;
        let is_shrunk = shrunk > SHRUNK && rest > MOST_STEPS
            || shrunk > SHRUNK_EARLY && rest > MOST_STEPS * HOPELESS;
        // Steps that grow, as on the way to infinity, may still arrive.
        let is_steady = self.former > 0.0 && self.longest < GROWTH * self.former;
        self.lost = match () {
            () if is_shrunk && !is_early => Some(Lost::Shrinking(rest)),
            () if is_steady && left.abs() > mean * most => Some(Lost::Endless),
            () => None,
        };
        (self.former, self.before, self.counted) = (self.longest, now, steps);
    }

    /// Factor by which the rest of the time takes more steps than at their present size, if they go on
    /// shrinking as e^(−kt).
    fn growth(&self, mean: f64, now: f64, left: f64) -> f64 {
        let Some((earlier, time)) = self.marks[1] else { return 1.0 };
        if earlier < TREND * mean {
            return 1.0;
        }
        let exponent = (earlier / mean).ln() * (left / (now - time)).abs();
        exponent.exp_m1() / exponent
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_that_shrink_are_counted_at_the_rate_at_which_they_do() {
        // About e^(10t) steps lead to the time t.
        let followed = |until: f64| {
            let (mut pace, mut now, mut steps) = (Pace::default(), 0.0, 0);
            while pace.lost.is_none() && now < until {
                let step = 0.1 * f64::exp(-10.0 * now);
                now += step;
                steps += 1;
                pace.keep(step, steps, now, until - now);
            }
            (matches!(pace.lost, Some(Lost::Shrinking(_))), steps)
        };
        let (is_lost, steps) = followed(3.0);
        assert!(is_lost && steps < 1 << 22, "{steps} steps of e^30");
        let (is_lost, steps) = followed(1.7);
        assert!(!is_lost && steps > 20_000_000, "{steps} steps of e^17");
    }

    #[test]
    fn steps_that_have_shrunk_and_stay_so_go_on() {
        let (mut pace, mut now, mut steps) = (Pace::default(), 0.0, 0);
        while steps < 5_000_000 {
            let step = if steps < 1000 { 0.1 } else { 0.1 * f64::exp(-3e-5 * steps as f64) };
            let step = step.max(1e-7);
            now += step;
            steps += 1;
            pace.keep(step, steps, now, 200.0);
            assert!(pace.lost.is_none(), "given up after {steps} steps");
        }
    }
}
