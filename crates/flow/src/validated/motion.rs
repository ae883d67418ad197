//! Motions over one Taylor step from many boxes: end states, derivatives, ∫ div v.

use super::coefficients::{BOXES, Block, Coefficients};
use super::enclosure::Enclosure;
use super::laws::Laws;
use super::plan::{Plan, RowRule};
use super::sharp;
use super::tail::{self, End};
use crate::error::FlowError;
use crate::taylor::compile::proved::passed;
use crate::taylor::form::Row;
use crate::taylor::program::TaylorProgram;
use liouville::graph::{Expr, record};
use liouville::mechanics::Phase;
use liouville::mechanics::calculus::DualPoint;
use liouville::number::ball::Balls;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use num_dual::Dual;

/// Order of the series, where it is not chosen.
pub const ORDER: usize = 20;

/// Limit on the halves of a step, and ratio of the radius of its norm to it: above the least one by a
/// shrink, for boxes.
const MOST_HALVES: usize = 2 * BOXES;
const ROOM: f64 = 1.8;

/// Box of states, an enclosure for each component.
pub type Boxed = Vec<Enclosure>;

/// End of a step from a box, with its derivative.
pub struct EnclosedPassage {
    /// End states.
    pub end: Boxed,
    /// Derivative of the end with respect to the start, then to the loose parameters, row by row.
    pub derivative: Vec<Boxed>,
    /// Integral of the divergence on the level.
    pub volume: Enclosure,
    /// Radius ρ of the norm in which the tails are bounded.
    pub radius: f64,
}

/// Equations of a model, for steps that are proved.
pub struct EnclosedMotion {
    pub dimension: usize,
    /// Order of the series.
    pub order: usize,
    /// Number of loose parameters, each a function of a variable between -1 and 1.
    pub loose: usize,
    /// Plan with all parameters at their centres.
    pub state: Plan,
    /// Plan with the loose parameters as further components of the state, and with what was left out
    /// of the field.
    pub wide: Plan,
    /// Plan with the derivative and ∫ div v, with ∫ L_vF of the conserved functions F, and with what
    /// was left out of the field: no step is proved across a point where one of them is not analytic.
    pub full: Plan,
}

impl EnclosedMotion {
    /// Records the field, its derivative along each axis and each loose parameter, the divergence on
    /// the level, and the rates of the conserved functions.
    pub fn new(laws: &Laws<'_>) -> Result<Self, FlowError> {
        let Laws { model, energy, integrals, .. } = *laws;
        let (n, loose) = (model.dimension(), laws.loose.len());
        let centre = Laws { loose: &[], ..*laws };
        let state = plan(&centre, 0, false, |phase, _, _| phase.field().to_vec())?;
        let wide = plan(laws, 0, true, |phase, _, _| phase.field().to_vec())?;
        let sizes = integrals.iter().map(|formula| formula.value_type().size());
        let kept = model.level.len() + usize::from(energy) + sizes.sum::<usize>();
        let full = plan(laws, n * (n + loose) + 1 + kept, true, |phase, inputs, more| {
            let jet = DualPoint::new(phase.with(&[], &phase.state()));
            let mut rates = jet.phase.field().to_vec();
            for (index, vector) in more[..n * (n + loose)].chunks(n).enumerate() {
                rates.extend(match index.checked_sub(n) {
                    None => slopes(&jet.phase.lift(vector)),
                    Some(parameter) => {
                        slopes(&laws.lifted(&phase.state(), inputs, vector, parameter))
                    }
                });
            }
            let level = vec![true; model.level.len()];
            rates.push(jet.divergence() - jet.level_cofactor(&level));
            let functions = model.level.iter().map(|equation| &equation.function);
            rates.extend(functions.map(|f| jet.lie_derivative(|at| at.level_function(f))));
            if energy {
                let zero = Dual::from_re(Expr::rational(&Rational::from(0)));
                let of = |at: &Phase<'_, Dual<Expr>>| model.system.energy(at).unwrap_or(zero);
                rates.push(jet.lie_derivative(of));
            }
            rates.extend(integrals.iter().flat_map(|formula| jet.rates(formula)));
            rates
        })?;
        Ok(Self { dimension: n, order: ORDER, loose, state, wide, full })
    }

    /// Encloses how far the states after steps of `shares` of a period are from `targets`, in
    /// double-double. `None` where a step is not proved.
    pub fn gaps(
        &self,
        starts: &[Vec<f64>],
        shares: &[f64],
        period: f64,
        targets: &[&[f64]],
    ) -> Vec<Option<Boxed>> {
        let boxed: Vec<Boxed> = starts
            .iter()
            .map(|state| state.iter().map(|x| Enclosure::exact(*x)).collect())
            .collect();
        let times = shares.iter().map(|share| Enclosure::exact(*share) * Enclosure::exact(period));
        let rests = steps(&self.state, self.order, &boxed, &times.collect::<Vec<_>>());
        let gaps = sharp::gaps(&self.state, self.order, starts, shares, period, targets);
        let widened = |(gap, end): (Boxed, Option<End>)| {
            let rest = end?.rest;
            let gap = gap.iter().zip(rest).map(|(x, rest)| *x + Enclosure::about(0.0, rest));
            Some(gap.collect())
        };
        gaps.into_iter().zip(rests).map(widened).collect()
    }

    /// Approximate ends of steps, with the derivatives of each component by the start.
    pub fn approximate(&self, starts: &[Vec<f64>], h: &[f64]) -> Vec<(Vec<f64>, Vec<Vec<f64>>)> {
        let n = self.dimension;
        let mut coefficients = Coefficients::new(&self.full, self.order);
        let exact = |x: &f64| Enclosure::exact(*x);
        let starts: Vec<Boxed> =
            starts.iter().map(|state| self.whole(state.iter().map(exact).collect())).collect();
        let mut found = Vec::new();
        for (group, h) in starts.chunks(BOXES).zip(h.chunks(BOXES)) {
            coefficients.expand(&blocks(group));
            let h: Vec<Boxed> = h.iter().map(|h| vec![exact(h)]).collect();
            let h = &blocks(&h)[0];
            let end = |row: usize| coefficients.polynomial(row, h).mid;
            let (rows, first) = (0..n, n + self.loose);
            let ends: Vec<_> = rows.map(end).collect();
            let slopes: Vec<_> = (0..n * n).map(|k| end(first + k)).collect();
            found.extend((0..group.len()).map(|lane| {
                let row = |row: usize| (0..n).map(|k| slopes[k * n + row][lane]).collect();
                (ends.iter().map(|end| end[lane]).collect(), (0..n).map(row).collect())
            }));
        }
        found
    }

    /// State with the loose parameters, unit vectors and zeros, as the full plan begins.
    fn whole(&self, state: Boxed) -> Boxed {
        let (n, loose) = (self.dimension, self.loose);
        let count = n * (n + loose);
        let unit = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        let vectors =
            (0..n + loose).flat_map(|i| (0..n).map(move |j| Enclosure::exact(unit(i, j))));
        let others = self.full.dimension - n - loose - count;
        let zeros = std::iter::repeat_n(Enclosure::ZERO, others);
        state.into_iter().chain(self.ranges()).chain(vectors).chain(zeros).collect()
    }

    /// Encloses the states after the steps `h`, with derivatives and ∫ div v.
    pub fn passages(&self, starts: &[Boxed], h: &[Enclosure]) -> Vec<Option<EnclosedPassage>> {
        let (n, loose) = (self.dimension, self.loose);
        let count = n * (n + loose);
        let starts: Vec<Boxed> = starts.iter().map(|state| self.whole(state.clone())).collect();
        let passage = |end: End| {
            let (mut end, radius) = (end.state, end.radius);
            let columns = end.split_off(n).split_off(loose);
            let derivative = (0..n)
                .map(|row| (0..n + loose).map(|column| columns[column * n + row]).collect())
                .collect();
            EnclosedPassage { end, derivative, volume: columns[count], radius }
        };
        steps(&self.full, self.order, &starts, h).into_iter().map(|end| end.map(passage)).collect()
    }

    /// Longest step from a state, up to the one given, that is proved with room for a box about it.
    pub fn longest(&self, state: &[f64], step: f64) -> Option<f64> {
        let start = self.whole(state.iter().map(|x| Enclosure::exact(*x)).collect());
        let starts = vec![start; BOXES];
        // Radii do not depend on steps, but are sought near them.
        (0..MOST_HALVES).step_by(BOXES).find_map(|first| {
            let half = |k: usize| Enclosure::exact(step * 0.5f64.powi((first + k) as i32));
            let tried: Vec<Enclosure> = (0..BOXES).map(half).collect();
            let ends = steps(&self.full, self.order, &starts, &tried);
            let radius = ends.into_iter().flatten().map(|end| end.radius).reduce(f64::max)?;
            Some(step.min(radius / ROOM))
        })
    }

    /// Whether the field is a polynomial in the state and in exponentials, sines and cosines: it has
    /// neither poles nor branches.
    pub fn is_entire(&self) -> bool {
        let is_entire = |(_, rule): &(Row, RowRule)| {
            matches!(
                rule,
                RowRule::Sum(_)
                    | RowRule::Theta(_)
                    | RowRule::Exp(_)
                    | RowRule::Sin { .. }
                    | RowRule::Cos { .. }
            )
        };
        self.wide.operations.iter().all(is_entire)
    }

    /// State with the loose parameters and zeros, as the wide plan begins.
    fn widened(&self, state: &Boxed) -> Boxed {
        let others = self.wide.dimension - self.dimension - self.loose;
        let zeros = std::iter::repeat_n(Enclosure::ZERO, others);
        state.iter().copied().chain(self.ranges()).chain(zeros).collect()
    }

    /// Encloses the states after the steps `h`, without derivatives, for all values of the loose
    /// parameters. `None` where a step is not proved, or does not lead forwards.
    pub fn ends(&self, starts: &[Boxed], h: &[Enclosure]) -> Vec<Option<Boxed>> {
        let starts: Vec<Boxed> = starts.iter().map(|state| self.widened(state)).collect();
        let found = steps(&self.wide, self.order, &starts, h).into_iter();
        let state = |(end, h): (Option<End>, &Enclosure)| {
            let mut state = end.filter(|_| h.mid >= 0.0)?.state;
            state.truncate(self.dimension);
            Some(state)
        };
        found.zip(h).map(state).collect()
    }

    /// Encloses the field at states, for all values of the loose parameters.
    pub fn field(&self, states: &[Boxed]) -> Vec<Boxed> {
        let mut coefficients = Coefficients::new(&self.wide, 1);
        let mut fields = Vec::new();
        let states: Vec<Boxed> = states.iter().map(|state| self.widened(state)).collect();
        for group in states.chunks(BOXES) {
            coefficients.values(&blocks(group));
            for lane in 0..group.len() {
                let rates = self.wide.rates[..self.dimension].iter();
                fields.push(rates.map(|row| of_lane(&coefficients.get(*row, 0), lane)).collect());
            }
        }
        fields
    }

    /// Encloses the variables of the loose parameters.
    fn ranges(&self) -> impl Iterator<Item = Enclosure> + use<> {
        std::iter::repeat_n(Enclosure::about(0.0, 1.0), self.loose)
    }
}

/// Derivative parts of the field.
fn slopes(phase: &Phase<'_, Dual<Expr>>) -> Vec<Expr> {
    phase.field().iter().map(|rate| rate.eps).collect()
}

/// Compiles rates over the state, the loose parameters and `more` further variables, all constants
/// enclosed. `build` receives a point, the loose parameters and the variables, and returns the rates
/// of the state and of the variables. `with_all` adds variables whose rates are the operations that
/// were left out of the field.
fn plan(
    laws: &Laws<'_>,
    more: usize,
    with_all: bool,
    build: impl FnOnce(&Phase<'_, Expr>, &[Expr], &[Expr]) -> Vec<Expr>,
) -> Result<Plan, FlowError> {
    let (dimension, loose) = (laws.model.dimension(), laws.loose.len());
    let (graph, (mut rates, written)) = record(dimension + loose + more, |inputs| {
        let (state, rest) = inputs.split_at(dimension);
        let (free, more) = rest.split_at(loose);
        let phase = laws.point(state, free);
        let mut rates = build(&phase, free, more);
        let rest = rates.split_off(dimension.min(rates.len()));
        rates.extend(free.iter().map(|_| Expr::rational(&Rational::from(0))));
        rates.extend(rest);
        (rates, if with_all { laws.as_written(&phase) } else { Vec::new() })
    })?;
    let left_out = graph.left_out(&rates, &written);
    rates.extend(left_out);
    let passed = passed(&graph, &rates, &written);
    rates.extend(passed);
    if graph.inputs() > dimension + loose + more {
        return Err(FlowError::Antiderivative);
    }
    Plan::new(&TaylorProgram::exact(&graph, &rates)?)
}

/// Encloses the ends of steps, for all states of boxes and all times of `h`.
pub(super) fn steps(
    plan: &Plan,
    order: usize,
    starts: &[Boxed],
    h: &[Enclosure],
) -> Vec<Option<End>> {
    let mut coefficients = Coefficients::new(plan, order);
    let (mut ends, mut hope) = (Vec::new(), tail::FIRST);
    for (group, h) in starts.chunks(BOXES).zip(h.chunks(BOXES)) {
        coefficients.expand(&blocks(group));
        let h: Vec<Boxed> = h.iter().map(|h| vec![*h]).collect();
        let found = tail::states(&coefficients, &blocks(&h)[0], &mut hope);
        ends.extend(found.into_iter().take(group.len()));
    }
    ends
}

/// Puts states into lanes; the last is repeated.
fn blocks(states: &[Boxed]) -> Vec<Block> {
    let width = states.first().map_or(0, Vec::len);
    let at = |lane: usize, row: usize| states[lane.min(states.len() - 1)][row];
    let block = |row: usize| {
        let lanes: [Enclosure; BOXES] = std::array::from_fn(|lane| at(lane, row));
        Balls::new(lanes.map(|x| x.mid), lanes.map(|x| x.rad))
    };
    (0..width).map(block).collect()
}

fn of_lane(block: &Block, lane: usize) -> Enclosure {
    Enclosure { mid: block.mid[lane], rad: block.rad[lane] }
}
