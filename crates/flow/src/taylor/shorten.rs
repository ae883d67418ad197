//! Steps that are shortened: before branch points of the field, and where a further function of the
//! state is sought for zeros.

use crate::taylor::defect::inside;
use crate::taylor::event::{Ends, value};
use crate::taylor::number::SeriesNumber;
use crate::taylor::pace::Lane;
use crate::taylor::stepper::Stepper;
use liouville::graph::{Kernel, with_widest_vectors};

/// Largest change of the state over a piece on which events are sought, relative to its size.
const FAR: f64 = 1.0;
/// Number of times that a step is shortened for a further function.
const MOST_CUTS: usize = 40;
/// Part of κ by which a further function may be known less well than the state: sums of products of
/// its components are.
const SLACK: f64 = 0.4;
/// Multiple of the first term left out by which a further function may differ from its polynomial.
const UNKNOWN: f64 = 1e4;
/// Part of its largest term below which a function is looked at from nearer by, number of places within a
/// step where that is looked for, and part of the way there that is taken.
const CANCELLED: f64 = 1.0 / 65536.0;
const LOOKS: u32 = 16;
const NEARER: f64 = 0.9375;
/// Number of times that a step is halved before a branch point.
const MOST_HALVES: usize = 60;

impl<T: SeriesNumber> Stepper<T> {
    /// Takes this share of a motion's step.
    pub fn shorten(&mut self, lane: usize, share: f64) {
        self.lanes[lane].step = self.lanes[lane].step * T::One::float(share);
    }

    /// Shortens steps at whose ends a root or a power would be negative: there the series goes on with
    /// another branch than the field.
    pub(crate) fn keep_branches(&mut self) {
        let steps = T::from_lanes(|lane| self.lanes[lane].step);
        for root in self.series.roots() {
            let ends = value(root, steps).0;
            for (index, lane) in self.lanes.iter_mut().enumerate() {
                if ends.lane(index).leading() < 0.0 {
                    let own: Vec<T::One> = root.iter().map(|x| x.lane(index)).collect();
                    lane.step = before_branch(&own, lane.step);
                    lane.is_cut = true;
                }
            }
        }
    }

    /// Values that decide whether a further function can vanish on the present pieces. Steps after
    /// which its series is not known as well as the state's become shorter.
    pub fn ends(&mut self, output: usize) -> Ends<T> {
        self.ends_of(output, |_| true)
    }

    /// The same in the lanes in which the function has a value that `counts`.
    pub(crate) fn ends_of(&mut self, output: usize, counts: impl Fn(f64) -> bool) -> Ends<T> {
        let counted = |stepper: &Self, index: usize| {
            counts(stepper.series.output(output)[0].lane(index).leading())
        };
        for index in (0..T::LANES).filter(|index| counted(self, *index)).collect::<Vec<_>>() {
            let [still, moving, ..] = self.sizes.norms.map(|norm| norm.lane(index).leading());
            // Where the state is a polynomial of time its step has no other limit.
            let most =
                if still > 0.0 { FAR * still / moving } else { FAR / self.lanes[index].unit };
            let step = &mut self.lanes[index].step;
            if step.leading().abs() > most {
                *step = T::One::float(most.copysign(step.leading()));
            }
        }
        let count = self.series.order();
        let rate = self.kappa - SLACK;
        let mut ends = Ends::NONE;
        for _ in 0..MOST_CUTS {
            with_widest_vectors(EndValues { stepper: self, output, ends: &mut ends });
            let mut is_known = true;
            for index in 0..T::LANES {
                if !counted(self, index) {
                    continue;
                }
                let lane = &mut self.lanes[index];
                let share = ends.known_share(index, count, rate);
                if share < 1.0 {
                    lane.step = lane.step * T::One::float(share);
                    lane.is_cut = true;
                    is_known = false;
                }
            }
            if is_known
                && self.fits(output, &ends, &counted)
                && self.is_clear(output, &ends, &counted)
            {
                break;
            }
        }
        ends
    }

    /// Whether a further function is nowhere small beside its terms on the present pieces: there its
    /// polynomial about their beginning has few digits, and one from nearer by has more. Shortens
    /// steps up to such places.
    fn is_clear(
        &mut self,
        output: usize,
        ends: &Ends<T>,
        counted: &impl Fn(&Self, usize) -> bool,
    ) -> bool {
        let mut is_clear = true;
        for index in 0..T::LANES {
            let small = CANCELLED * ends.largest(index);
            if ends.is_simple(index) || !counted(self, index) || !self.is_regular(index) {
                continue;
            }
            let terms: Vec<T::One> =
                self.series.output(output).iter().map(|x| x.lane(index)).collect();
            let lane = &mut self.lanes[index];
            if terms[0].leading().abs() <= small || !lane.moves() {
                continue;
            }
            let part = |k: u32| T::One::float(f64::from(k) / f64::from(LOOKS));
            let at = |k: u32| value(&terms, lane.step * part(k)).0.leading().abs();
            if let Some(k) = (1..=LOOKS).find(|k| at(*k) < small) {
                lane.step = lane.step * part(k) * T::One::float(NEARER);
                lane.is_cut = true;
                is_clear = false;
            }
        }
        is_clear
    }

    /// Whether the polynomials of a further function are its values at the ends of the present pieces,
    /// and within them where it can be 0 up to rounding for a while. Halves steps where they are not:
    /// terms beyond the order do not show where a step begins.
    fn fits(
        &mut self,
        output: usize,
        ends: &Ends<T>,
        counted: &impl Fn(&Self, usize) -> bool,
    ) -> bool {
        let has_pulses = self.series.has_pulses();
        let is_within = !has_pulses || self.fits_at((output, ends), counted, inside);
        self.fits_at((output, ends), counted, |_| 1.0) && is_within
    }

    fn fits_at(
        &mut self,
        (output, ends): (usize, &Ends<T>),
        counted: &impl Fn(&Self, usize) -> bool,
        share: impl Fn(&Lane<T::One>) -> f64,
    ) -> bool {
        self.sample(share);
        let count = self.series.order();
        let known = UNKNOWN * libm::exp((SLACK - self.kappa) * count as f64);
        let mut fits = true;
        for index in 0..T::LANES {
            let lane = &self.lanes[index];
            let is_whole = lane.edge.and_then(|(edge, _)| edge.ends()).is_none();
            let is_judged = lane.moves() && self.is_regular(index) && counted(self, index);
            if !is_whole || !is_judged {
                continue;
            }
            let after = self.sampled_time(index);
            let terms: Vec<T::One> =
                self.series.output(output).iter().map(|x| x.lane(index)).collect();
            let own = self.series.probed_output(output).lane(index);
            let gap = (value(&terms, after).0 - own).leading().abs();
            let allowed = known * ends.largest(index);
            if gap <= allowed || gap <= allowed + self.output_error(output, index) {
                continue;
            }
            let lane = &mut self.lanes[index];
            lane.step = lane.step * T::One::float(0.5);
            lane.is_cut = true;
            fits = false;
        }
        fits
    }
}

/// Part of a step on which a function is known by its terms.
pub(crate) fn known_part<One: SeriesNumber<One = One>>(
    terms: &[One],
    step: One,
    kappa: f64,
) -> One {
    let mut step = step;
    for _ in 0..MOST_CUTS {
        let share = Ends::new(terms, step).known_share(0, terms.len(), kappa - SLACK);
        if share >= 1.0 {
            break;
        }
        step = step * One::float(share);
    }
    step
}

/// A part of a step at whose end a function that vanishes within it is not negative yet.
fn before_branch<One: SeriesNumber>(root: &[One], step: One) -> One {
    let halves = (0..MOST_HALVES).scan(step, |step, _| {
        *step = *step * One::float(0.5);
        Some(*step)
    });
    let shorter = halves.take_while(|step| step.leading() != 0.0);
    let mut last = One::ZERO;
    for step in shorter {
        last = step;
        if value(root, step).0.leading() >= 0.0 {
            break;
        }
    }
    last
}

/// Work of evaluating a further function at the ends of the present pieces.
struct EndValues<'s, T: SeriesNumber> {
    stepper: &'s Stepper<T>,
    output: usize,
    ends: &'s mut Ends<T>,
}

impl<T: SeriesNumber> Kernel for EndValues<'_, T> {
    #[inline(always)]
    fn run(self) {
        let Self { stepper, output, ends } = self;
        let length = T::from_lanes(|lane| stepper.lanes[lane].step);
        *ends = Ends::new(stepper.series.output(output), length);
    }
}
