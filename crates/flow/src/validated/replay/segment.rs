//! One segment of an orbit: many bits from points, short integers from boxes.

use super::number::{ReplayNumber, Wide, domain};
use super::series::Script;
use super::short::Short;
use super::tails::remainders;
use crate::validated::functions::Functions;
use crate::validated::motion::EnclosedMotion;
use crate::validated::nearby::Nearby;

/// Scripts of the equations of a motion.
pub struct Scripts<'m> {
    pub motion: &'m EnclosedMotion,
    state: Script<'m, Wide>,
    wide: Script<'m, Wide>,
    moved: Script<'m, Short>,
    full: Script<'m, Short>,
    /// Field near the parameters; `None` where it has no series.
    nearby: Option<&'m Nearby>,
    near: Option<Script<'m, Short>>,
}

/// End of a step from a box, with its derivative by the start and by the loose parameters.
pub struct ReplayedPassage {
    pub end: Vec<Wide>,
    /// Derivative, row by row.
    pub derivative: Vec<Vec<Wide>>,
    pub volume: Wide,
}

/// Values of the conserved functions and their gradients.
pub type Values = (Vec<Wide>, Vec<Vec<Wide>>);

impl<'m> Scripts<'m> {
    /// Prepares the plans of a motion for series of these orders, from points and from boxes.
    pub fn new(
        motion: &'m EnclosedMotion,
        nearby: Option<&'m Nearby>,
        points: usize,
        boxes: usize,
    ) -> Self {
        Self {
            motion,
            state: Script::new(&motion.state, points),
            wide: Script::new(&motion.wide, 1),
            moved: Script::new(&motion.wide, boxes),
            full: Script::new(&motion.full, boxes),
            near: nearby.and_then(Nearby::plan).map(|plan| Script::new(plan, boxes)),
            nearby,
        }
    }

    /// Encloses the variables of the loose parameters.
    fn ranges(&self) -> Vec<Wide> {
        vec![Wide::about(0.0, 1.0); self.motion.loose]
    }

    /// State with the loose parameters and zeros, as the wide plan begins.
    fn widened(&self, state: &[Wide]) -> Vec<Wide> {
        let others = self.motion.wide.dimension - self.motion.dimension - self.motion.loose;
        let zeros = std::iter::repeat_n(Wide::zero(), others);
        state.iter().cloned().chain(self.ranges()).chain(zeros).collect()
    }

    /// Encloses the state after the time `h` from a point, all parameters at their centres.
    pub fn end(&self, start: &[Wide], h: &Wide, radius: f64) -> Option<Vec<Wide>> {
        ends(&self.state, start, h, radius)
    }

    /// Encloses the states after the time `h` from a box, for all values of the parameters.
    pub fn passage(&self, start: &[Wide], h: &Wide, radius: f64) -> Option<ReplayedPassage> {
        let (n, loose) = (self.motion.dimension, self.motion.loose);
        let count = n * (n + loose);
        let unit = |i: usize, j: usize| Short::exact(if i == j { 1.0 } else { 0.0 });
        let vectors = (0..n + loose).flat_map(|i| (0..n).map(move |j| unit(i, j)));
        let others = self.motion.full.dimension - n - loose - count;
        let zeros = std::iter::repeat_n(Short::zero(), others);
        let ranges = self.ranges();
        let boxes = start.iter().chain(&ranges).map(Short::of_wide);
        let all: Vec<Short> = boxes.chain(vectors).chain(zeros).collect();
        let found = ends(&self.full, &all, &Short::of_wide(h), radius)?;
        let mut end: Vec<Wide> = found.iter().map(Short::wide).collect();
        let columns = end.split_off(n).split_off(loose);
        let entry = |row: usize, column: usize| columns[column * n + row].clone();
        let derivative =
            (0..n).map(|row| (0..n + loose).map(|column| entry(row, column)).collect()).collect();
        Some(ReplayedPassage { end, derivative, volume: columns[count].clone() })
    }

    /// Encloses the states after the time `h` from a box, without derivatives, for all values of the
    /// parameters.
    pub fn states(&self, start: &[Wide], h: &Wide, radius: f64) -> Option<Vec<Wide>> {
        let all: Vec<Short> = self.widened(start).iter().map(Short::of_wide).collect();
        let found = ends(&self.moved, &all, &Short::of_wide(h), radius)?;
        Some(found[..self.motion.dimension].iter().map(Short::wide).collect())
    }

    /// Whether the field is analytic about the motions from a box over the time `h`, for all
    /// parameters near those of the case.
    pub fn persists(&self, start: &[Wide], h: &Wide, radius: f64) -> bool {
        let Some(nearby) = self.nearby else { return false };
        // without a plan of its own, by the steps of the proof
        let Some(near) = &self.near else { return true };
        let (start, ranges) = (start.iter().map(Short::of_wide), self.ranges());
        let all = nearby.whole(start, ranges.iter().map(Short::of_wide), Short::zero());
        ends(near, &all, &Short::of_wide(h), radius).is_some()
    }

    /// Encloses the field over a box, for all values of the parameters.
    pub fn field(&self, state: &[Wide]) -> Vec<Wide> {
        let series = self.wide.expand(&self.widened(state));
        let rates = &self.motion.wide.rates[..self.motion.dimension];
        rates.iter().map(|row| series.rows[*row][0].clone()).collect()
    }
}

fn ends<X: ReplayNumber>(
    script: &Script<'_, X>,
    start: &[X],
    h: &X,
    radius: f64,
) -> Option<Vec<X>> {
    let series = script.expand(start);
    let rests = remainders(&series, h, radius)?;
    let end = |(row, rest): (usize, &X)| series.polynomial(row, h).plus(&X::within(rest));
    let found: Vec<X> = rests.iter().enumerate().map(end).collect();
    found.iter().all(X::is_known).then_some(found)
}

/// Encloses the conserved functions and their gradients over a box, for all values of the parameters
/// or for those at the centres.
pub fn functions(functions: &Functions, state: &[Wide], is_wide: bool) -> Values {
    let loose = if is_wide { Wide::about(0.0, 1.0) } else { Wide::zero() };
    let state = state.iter().map(Wide::block).collect();
    let (values, gradients) = functions.over(domain(), state, &loose.block());
    let known = |all: Vec<_>| all.into_iter().map(Wide::from_block).collect::<Vec<Wide>>();
    (known(values), gradients.into_iter().map(known).collect())
}
