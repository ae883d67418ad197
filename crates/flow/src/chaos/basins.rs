//! Basins of attraction: the set to which each motion of a grid of starts keeps at late times.

use crate::chaos::attractors::{Change, MOST_SETS, Tail};
use crate::chaos::late::{Late, LateMotions, LateSamples};
use crate::chaos::order::Order;
use crate::chaos::shadow::{ShadowStart, Shadowed};
use crate::error::FlowError;
use crate::motion::columns::Columns;
use crate::motion::conserved::Fixed;
use crate::motion::lyapunov::{Estimate, Exponents};
use crate::motion::start::{Start, fixed_parameters, two_sided};
use crate::section::axis::{AxisMistake, range};
use crate::section::launch::Launches;
use liouville::case::Case;
use liouville::formula::canonical_name;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;
use liouville::order::StableOrder;

/// Number of motions whose samples are kept at once.
const WAVE: usize = 4096;
/// Smallest width, as a share of the values and of the largest one.
const NARROW: f64 = 1e-3;
/// Multiples of the time for which a motion is followed further if its size may change.
const LONGER: [f64; 2] = [2.0, 4.0];
/// Logarithm of the contraction over the time from which on a motion tends to a point.
const CONTRACTION: f64 = 3.0;

/// Component of the state that varies over a grid.
#[derive(Clone, Debug)]
pub struct StateAxis {
    /// Name of the component.
    pub name: String,
    /// Its index in the state.
    pub component: usize,
    /// Lower end.
    pub from: Rational,
    /// Upper end.
    pub to: Rational,
    /// Number of points; the first and the last are half a step inside.
    pub count: usize,
}

impl StateAxis {
    /// Reads an axis `NAME=a..b` of `count` points.
    pub fn read(case: &Case, text: &str, count: usize) -> Result<Self, AxisMistake> {
        let (name, from, to) = range(text)?;
        let name = canonical_name(name).unwrap_or_else(|| name.to_string());
        let known: Vec<String> =
            (0..case.model.dimension()).map(|k| case.model.component_name(k)).collect();
        let component = known.iter().position(|known| *known == name).ok_or_else(|| {
            let message = format!("`{name}` is not a component of the state");
            AxisMistake { message, help: format!("vary two of {}", known.join(", ")) }
        })?;
        Ok(Self { name, component, from, to, count })
    }

    /// Value at a point of the axis.
    pub fn value(&self, index: usize) -> Rational {
        let share = Rational::new(2 * index as i64 + 1, 2 * self.count as i64);
        &self.from + &(&(&self.to - &self.from) * &share)
    }
}

/// Request for the basins of a grid of starts.
pub struct BasinRequest<'r> {
    /// Components that vary, across and upwards.
    pub axes: &'r [StateAxis; 2],
    /// State that gives the other components; starts are moved to the level.
    pub base: &'r [Rational],
    /// Functions whose values all starts share; by default each start has those of its state.
    pub fixed: &'r [Fixed],
    /// Values by which sets are told apart.
    pub columns: &'r Columns,
    /// Time for which each motion is followed; the later half counts.
    pub time: f64,
    /// Seed of the free parameters.
    pub seed: u64,
}

/// End of a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Destiny {
    /// It keeps to the set with this index.
    Set(usize),
    /// It keeps to a set beyond the largest number of them.
    Further,
    /// It does not return to where it was: it drifts, leaves, or needs more time.
    Unsettled,
    /// It has no start, or ended early.
    Ended(FlowError),
}

/// Set to which motions keep.
#[derive(Clone, Debug)]
pub struct Attractor {
    /// Number of motions that keep to it.
    pub count: usize,
    /// Smallest and largest value of each column on its first motion.
    pub ranges: Vec<[f64; 2]>,
    /// Values of the columns at the end of its first motion.
    pub last: Vec<f64>,
    /// Whether it is a single point, or its first motion tends to one.
    pub is_point: bool,
    /// State of its first motion at the end.
    pub state: Vec<f64>,
    /// Exponents of its first motion, from its end on.
    pub exponents: Result<Exponents, FlowError>,
}

/// Basins of a grid of starts. Of a computation that is stopped from outside it has the sets of the motions
/// that were followed to their ends, not yet compared at later times.
#[derive(Clone, Debug)]
pub struct Basins {
    /// End of each motion, row by row from the least value of the second axis.
    pub ends: Vec<Destiny>,
    /// Sets, the one with the most motions first.
    pub attractors: Vec<Attractor>,
}

/// Follows a motion from each point of the grid, and finds the sets to which they keep. Calls
/// `progress` after each motion.
pub fn basins(
    case: &Case,
    request: &BasinRequest<'_>,
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Basins, FlowError> {
    two_sided(case)?;
    let [across, up] = request.axes;
    let count = across.count * up.count;
    let order = Order::of(count);
    let launches = Launches { case, fixed: request.fixed, pad: None, seed: request.seed, index: 0 };
    let state = |place: usize| {
        let mut state = request.base.to_vec();
        for (axis, index) in [(across, place % across.count), (up, place / across.count)] {
            state[axis.component] = axis.value(index);
        }
        state
    };
    let parameters = fixed_parameters(case, request.seed, 0)?;
    let motions = LateMotions::new(case, request.columns, &parameters)?;
    let mut found = Found::new(count);
    for wave in (0..count).step_by(WAVE) {
        let places: Vec<usize> =
            (wave..count.min(wave + WAVE)).map(|index| order.place(index)).collect();
        let starts = launches.starts(places.iter().map(|place| state(*place)).collect())?;
        let tails = motions.follow(&starts, request.time, threads, progress);
        found.add(&places, tails);
    }
    if let Some(problem) = found.common_problem() {
        return Err(problem);
    }
    let later = motions.follow(&found.later(&parameters), request.time, threads, &|_| {});
    let is_stopped =
        |later: &[Late]| later.iter().any(|late| matches!(late, Err(FlowError::Stopped)));
    if !is_stopped(&later) {
        found.join(later);
        for longer in LONGER {
            let doubtful = found.doubtful();
            let starts = found.later(&parameters);
            let starts: Vec<_> = doubtful.iter().map(|index| starts[*index].clone()).collect();
            let later = motions.follow(&starts, longer * request.time, threads, &|_| {});
            if is_stopped(&later) {
                break;
            }
            found.confirm(&doubtful, later);
        }
    }
    let shadowed = Shadowed::new(&case.model, &parameters, &[])?;
    let exponents = shadowed.follow(&found.begins(), request.time, threads, &|_| {});
    Ok(found.told(exponents))
}

/// First motion of a set.
struct First {
    tail: Tail,
    rows: Vec<Vec<f64>>,
    end: Vec<DoubleDouble>,
    /// Samples before.
    past: Vec<Tail>,
    /// Change of its size up to the end, as far as it is known.
    change: Change,
}

/// Ends found so far.
struct Found {
    ends: Vec<Destiny>,
    sets: Vec<First>,
    widths: Vec<f64>,
}

impl Found {
    fn new(count: usize) -> Self {
        Self { ends: vec![Destiny::Unsettled; count], sets: Vec::new(), widths: Vec::new() }
    }

    /// Problem of the first motion, if none was followed to its end.
    fn common_problem(&self) -> Option<FlowError> {
        let problem = |end: &Destiny| match end {
            Destiny::Ended(problem) => Some(problem.clone()),
            _ => None,
        };
        let are_lost = self.ends.iter().all(|end| problem(end).is_some());
        self.ends.first().filter(|_| are_lost).and_then(problem)
    }

    fn add(&mut self, places: &[usize], tails: Vec<Late>) {
        if self.widths.is_empty() {
            let rows = |own: &LateSamples| match keeps_to_itself(own) {
                true => own.rows.clone(),
                false => Vec::new(),
            };
            let kept: Vec<Vec<f64>> = tails.iter().flatten().flat_map(rows).collect();
            let starts = tails.iter().flatten().map(|own| &own.first);
            self.widths = widths(starts.chain(&kept));
        }
        for (place, late) in places.iter().zip(tails) {
            self.ends[*place] = match late {
                Ok(late) => self.place(late),
                Err(problem) => Destiny::Ended(problem),
            };
        }
    }

    /// Finds the set of a motion, which may be a new one.
    fn place(&mut self, LateSamples { rows, ways, end, .. }: LateSamples) -> Destiny {
        let tail = Tail::new(&rows, &ways, &self.widths);
        if !tail.is_settled() {
            return Destiny::Unsettled;
        }
        match self.sets.iter().position(|known| known.tail.is_with(&tail)) {
            Some(place) => Destiny::Set(place),
            None if self.sets.len() < MOST_SETS => {
                let (past, change) = (Vec::new(), Change::Steady);
                self.sets.push(First { tail, rows, end, past, change });
                Destiny::Set(self.sets.len() - 1)
            }
            None => Destiny::Further,
        }
    }

    /// Starts of the first motion of each set, from its end on.
    fn later(&self, parameters: &[Rational]) -> Vec<Result<Start, FlowError>> {
        let start = |first: &First| {
            Ok(Start { parameters: parameters.to_vec(), state: first.end.clone(), moved: 0.0 })
        };
        self.sets.iter().map(start).collect()
    }

    /// Joins sets whose first motions come together later; a set that its first motion leaves is none.
    fn join(&mut self, later: Vec<Late>) {
        let firsts = std::mem::take(&mut self.sets);
        let mut home = Vec::new();
        for (first, late) in firsts.iter().zip(later) {
            let after = late.map(|LateSamples { rows, ways, end, .. }| {
                let tail = Tail::new(&rows, &ways, &self.widths);
                let change = Tail::change(&[&first.tail, &tail]);
                First { tail, rows, end, past: vec![first.tail.clone()], change }
            });
            let stays = |after: &First| after.tail.is_settled() && after.tail.is_with(&first.tail);
            let Some(after) = after.ok().filter(stays) else {
                home.push(Destiny::Unsettled);
                continue;
            };
            let known = self.sets.iter().position(|known| known.tail.is_with(&after.tail));
            home.push(Destiny::Set(known.unwrap_or(self.sets.len())));
            if known.is_none() {
                self.sets.push(after);
            }
        }
        for end in &mut self.ends {
            if let Destiny::Set(index) = *end {
                *end = home[index].clone();
            }
        }
    }

    /// Sets whose size may change, or whose first motion seems to come to rest.
    fn doubtful(&self) -> Vec<usize> {
        let is_doubtful = |first: &First| {
            first.change != Change::Steady || first.tail.rests() && !first.tail.is_point()
        };
        let all = self.sets.iter().enumerate().filter(|(_, first)| is_doubtful(first));
        all.map(|(index, _)| index).collect()
    }

    /// Looks at sets again, from samples of their first motions at still later times.
    fn confirm(&mut self, sets: &[usize], later: Vec<Late>) {
        for (index, late) in sets.iter().zip(later) {
            let Ok(LateSamples { rows, ways, end, .. }) = late else { continue };
            let first = &mut self.sets[*index];
            let tail = Tail::new(&rows, &ways, &self.widths);
            first.past.push(std::mem::replace(&mut first.tail, tail));
            let all: Vec<&Tail> = first.past.iter().chain([&first.tail]).collect();
            first.change = Tail::change(&all);
            (first.rows, first.end) = (rows, end);
        }
    }

    fn begins(&self) -> Vec<Result<ShadowStart, FlowError>> {
        let begin = |first: &First| Ok(ShadowStart { state: first.end.clone(), loose: Vec::new() });
        self.sets.iter().map(begin).collect()
    }

    /// Brings the sets into the order of their sizes. One whose size goes on changing, and that does not
    /// tend to a point, is none.
    fn told(mut self, exponents: Vec<Result<Exponents, FlowError>>) -> Basins {
        let is_point = |first: &First, exponents: &Result<Exponents, FlowError>| {
            first.tail.is_point()
                || first.tail.rests()
                || first.change == Change::Vanishes
                || first.tail.closes_in() && exponents.as_ref().is_ok_and(contracts)
        };
        let pairs = self.sets.iter().zip(&exponents);
        let are_points: Vec<bool> = pairs.map(|(first, own)| is_point(first, own)).collect();
        let goes = |index: usize| self.sets[index].change == Change::Goes && !are_points[index];
        for end in &mut self.ends {
            if matches!(*end, Destiny::Set(index) if goes(index)) {
                *end = Destiny::Unsettled;
            }
        }
        let mut counts = vec![0; self.sets.len()];
        for end in &self.ends {
            if let Destiny::Set(index) = end {
                counts[*index] += 1;
            }
        }
        let mut order: Vec<usize> = (0..counts.len()).filter(|index| counts[*index] > 0).collect();
        order.order_by_key(|index| std::cmp::Reverse(counts[*index]));
        let attractor = |index: &usize| {
            let (first, exponents) = (&self.sets[*index], exponents[*index].clone());
            Attractor {
                count: counts[*index],
                ranges: ranges(&first.rows),
                last: first.rows.last().cloned().unwrap_or_default(),
                is_point: are_points[*index],
                state: first.end.iter().map(|x| x.hi).collect(),
                exponents,
            }
        };
        let attractors = order.iter().map(attractor).collect();
        let renamed = |end: &Destiny| match end {
            Destiny::Set(index) => {
                Destiny::Set(order.iter().position(|own| own == index).unwrap_or(*index))
            }
            other => other.clone(),
        };
        Basins { ends: self.ends.iter().map(renamed).collect(), attractors }
    }
}

/// Whether neighbours come together, as around a point, and not along a cycle: on that they keep their
/// distance on average.
fn contracts(found: &Exponents) -> bool {
    let Estimate { mean, error, later } = found.largest;
    let least = CONTRACTION / found.time.abs();
    mean < -3.0 * error - least && later < -least
}

/// Whether a motion is settled in its own widths. Those of one that runs away would make everything
/// else a point.
fn keeps_to_itself(own: &LateSamples) -> bool {
    let own_widths = widths(own.rows.iter().chain([&own.first]));
    Tail::new(&own.rows, &own.ways, &own_widths).is_settled()
}

/// Smallest and largest value of each component.
fn ranges<'r>(rows: impl IntoIterator<Item = &'r Vec<f64>>) -> Vec<[f64; 2]> {
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    for row in rows {
        ranges.resize(row.len(), [f64::INFINITY, f64::NEG_INFINITY]);
        for (range, x) in ranges.iter_mut().zip(row) {
            *range = [range[0].min(*x), range[1].max(*x)];
        }
    }
    ranges
}

/// Widths of the components, at least a small share of the largest; sizes where there are none.
fn widths<'r>(rows: impl Iterator<Item = &'r Vec<f64>>) -> Vec<f64> {
    let ranges = ranges(rows);
    let size = |range: &[f64; 2]| range[0].abs().max(range[1].abs());
    let width = |range: &[f64; 2]| (range[1] - range[0]).max(NARROW * size(range));
    let widest = ranges.iter().map(width).fold(0.0, f64::max);
    let floor = if widest > 0.0 { NARROW * widest } else { 1.0 };
    ranges.iter().map(|range| width(range).max(floor)).collect()
}
