//! Poles of densities: where ρ is infinite and cannot be integrated, ρ dx is no measure.
//!
//! A pole is sought by Newton's method towards the zeros of what ρ divides by, in f64. It is observed,
//! not proved, and is told in a remark.

use super::judging::Judging;
use super::local_form::LocalForm;
use super::sampler::Sampler;
use super::witness::briefly;
use crate::claim::LevelSubset;
use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape};
use crate::mechanics::{Draw, NumberLine, combinations};
use crate::number::float::Float;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::is_seen_nowhere_zero;

/// Number of states from which a pole is sought, side by side.
const STARTS: usize = 64;
/// Number of steps towards it.
const STEPS: usize = 40;
/// Share of Newton's step that is taken, so that a simple zero is not met exactly.
const DAMPED: f64 = 0.9;
/// Step of a difference quotient, in units of the coordinate or of 1/1000.
const DIFFERENCE: f64 = 1e-6;
/// Decrease of a divisor that shows a zero, and increase of ρ that shows a pole.
const LEAST_DECREASE: f64 = 1e-10;
const LEAST_INCREASE: f64 = 1e3;
/// Decrease of a divisor after which the growth of ρ is measured.
const MIDWAY: f64 = 1e-4;
/// Share of an exponent that may be lost by rounding.
const MARGIN: f64 = 0.03;
/// Largest coordinate of a state at a pole, and of its draws, where others are of order 1.
const FARTHEST: f64 = 1e3;
/// Largest number of divisors that are examined.
const MOST_DIVISORS: usize = 8;
/// Number of pieces of the ranges in which a divisor is shown not to vanish.
const PIECES: usize = 64;

/// Values at some states, one row for each input or output.
type Rows = Vec<[f64; STARTS]>;

/// A tape with its working memory.
type Runner<'t> = Evaluator<'t, Float<STARTS>>;

impl Judging<'_> {
    /// Finds a state of the level, as text, near which a density is infinite and the field is not.
    ///
    /// `None` if none was met.
    pub(super) fn pole(
        &self,
        sampler: &Sampler,
        density: Expr,
        field: &[Expr],
    ) -> Result<Option<String>, Fault> {
        let groups = [vec![density], field.to_vec()];
        let Some(choices) = combinations(sampler.recipes()) else { return Ok(None) };
        let model = &self.case.model;
        let level = LevelSubset::level(model);
        let mut on_level = None;
        for (index, fixed) in choices.iter().enumerate() {
            let Some(found) = self.vanishing(sampler, &groups, fixed)? else { continue };
            let place = if sampler.kept() == level.kept.as_slice() {
                self.pole_of(sampler, fixed, &found)
            } else {
                // What is proved in the whole space is asked for on the level.
                let own = on_level.get_or_insert_with(|| {
                    Sampler::new(self.case, &level, self.options.seed)
                        .ok()
                        .filter(|own| !own.is_numerical())
                });
                let Some(own) = own else { return Ok(None) };
                let choices = combinations(own.recipes()).unwrap_or_default();
                let Some(fixed) = choices.get(index) else { return Ok(None) };
                let found = self.vanishing(own, &groups, fixed)?;
                found.and_then(|found| self.pole_of(own, fixed, &found))
            };
            if place.is_some() {
                return Ok(place);
            }
        }
        Ok(None)
    }

    /// Divisors of a density that are not seen to vanish nowhere, as functions of the draws; `None` if
    /// there are none.
    fn vanishing(
        &self,
        sampler: &Sampler,
        [density, field]: &[Vec<Expr>; 2],
        fixed: &[Option<Rational>],
    ) -> Result<Option<Vanishing>, Fault> {
        let (graph, groups) =
            sampler.compose(self.graph, &[density.clone(), field.clone()], fixed)?;
        let Ok([density, field]) = <[Vec<Expr>; 2]>::try_from(groups) else { return Ok(None) };
        let extents = sampler.extents();
        // Where the field divides by the same, it has no value at the zero.
        let of_field = divisors(&graph, &field);
        let may_vanish = |value: &Expr| {
            !of_field.contains(value)
                && !is_seen_nowhere_zero(&graph, &extents, &[], &[*value], PIECES)
        };
        let divisors: Vec<Expr> =
            divisors(&graph, &density).into_iter().filter(may_vanish).collect();
        let is_open = !divisors.is_empty();
        Ok(is_open.then_some(Vanishing { graph, density, field, divisors }))
    }

    fn pole_of(
        &self,
        sampler: &Sampler,
        fixed: &[Option<Rational>],
        found: &Vanishing,
    ) -> Option<String> {
        let Vanishing { graph, density, field, divisors } = found;
        let (density, field) = (Tape::new(graph, density), Tape::new(graph, field));
        let model = &self.case.model;
        let state = Tape::new(sampler.graph(), &sampler.made()[model.free_components()..]);
        let place = divisors.iter().take(MOST_DIVISORS).find_map(|divisor| {
            let divisor = Tape::new(graph, &[*divisor]);
            let (density, field, state) = (&density, &field, &state);
            let search = PoleSearch { sampler, divisor, density, field, state, fixed };
            search.pole(graph.inputs())
        })?;
        Some(briefly(model, &place))
    }
}

/// A density, the field, and the values by which the density divides that may vanish.
struct Vanishing {
    graph: Graph,
    density: Vec<Expr>,
    field: Vec<Expr>,
    divisors: Vec<Expr>,
}

/// Values by which others are divided, or whose powers have negative exponents: of products the factors, of roots,
/// moduli and powers what they are taken of, which vanishes with them and has slopes there.
fn divisors(graph: &Graph, values: &[Expr]) -> Vec<Expr> {
    let reached = graph.reached(values.iter().copied());
    let poles = graph.needs(&reached).filter(|(_, need)| need.is_pole);
    let mut open: Vec<usize> = poles.map(|(place, _)| place).collect();
    open.reverse();
    let mut found: Vec<usize> = Vec::new();
    while let Some(place) = open.pop() {
        match graph.step(place) {
            Step::Unary(UnaryFunction::Sqrt | UnaryFunction::Abs | UnaryFunction::Neg, a)
            | Step::Power(a, _) => open.push(a),
            Step::Binary(BinaryOperation::Mul, a, b) => open.extend([b, a]),
            Step::Constant(_) => {}
            _ if found.contains(&place) => {}
            _ => found.push(place),
        }
    }
    found.into_iter().map(|place| graph.at(place)).collect()
}

/// The way from states to zeros of a divisor.
struct PoleSearch<'s> {
    sampler: &'s Sampler,
    divisor: Tape,
    density: &'s Tape,
    field: &'s Tape,
    state: &'s Tape,
    /// Listed values that are chosen, by draw.
    fixed: &'s [Option<Rational>],
}

impl PoleSearch<'_> {
    /// Draws of the states from which the search starts, listed ones at the values that are chosen.
    fn starts(&self, inputs: usize) -> Rows {
        let all: Vec<Vec<(f64, bool)>> =
            (0..STARTS as u64).map(|index| self.sampler.nearest_draws(index)).collect();
        let draws = all.first().map_or(0, Vec::len);
        let mut rows: Rows = (0..draws).map(|k| std::array::from_fn(|i| all[i][k].0)).collect();
        for (row, value) in rows.iter_mut().zip(self.fixed) {
            if let Some(value) = value {
                *row = [value.to_f64().0; STARTS];
            }
        }
        rows.resize(inputs.max(draws), [0.5; STARTS]);
        rows
    }

    /// Ranges of the draws of the state, by place.
    fn ranges(&self) -> Vec<(usize, [f64; 2])> {
        let parameters = self.sampler.parameter_draws();
        let places = self.sampler.recipes().iter().enumerate().skip(parameters);
        let range = |(place, draw): (usize, &Draw)| match draw {
            Draw::Within(range) => Some((place, [range.low.to_f64().0, range.high.to_f64().0])),
            Draw::Of(NumberLine::Positive, _) => Some((place, [0.0, f64::MAX])),
            Draw::Of(NumberLine::All | NumberLine::Directions, _) => {
                Some((place, [-f64::MAX, f64::MAX]))
            }
            Draw::OneOf(_) | Draw::Sign => None,
        };
        places.filter_map(range).collect()
    }

    /// State at which the divisor goes to 0 and the density to infinity, so that it cannot be
    /// integrated there.
    fn pole(&self, inputs: usize) -> Option<Vec<f64>> {
        let mut point = self.starts(inputs);
        let ranges = self.ranges();
        let [mut divisor, mut density, mut field, mut state] =
            [&self.divisor, self.density, self.field, self.state].map(runner);
        let before = output(&mut density, &point);
        let speed = lengths(&mut field, &point);
        let first = output(&mut divisor, &point);
        let mut value = first;
        // The divisor and the density on the way, once the divisor is small.
        let mut midway = [None; STARTS];
        for _ in 0..STEPS {
            let slopes: Vec<[f64; STARTS]> =
                ranges.iter().map(|(place, _)| slope(&mut divisor, &mut point, *place)).collect();
            let lengths: [f64; STARTS] =
                std::array::from_fn(|i| slopes.iter().map(|slope| slope[i] * slope[i]).sum());
            let mut is_moved = false;
            for ((place, [low, high]), slope) in ranges.iter().zip(&slopes) {
                for i in 0..STARTS {
                    let step = DAMPED * value[i] * slope[i] / lengths[i];
                    if step.is_finite() && value[i].abs() > LEAST_DECREASE * first[i].abs() {
                        let next = (point[*place][i] - step).clamp(*low, *high);
                        is_moved |= next != point[*place][i];
                        point[*place][i] = next;
                    }
                }
            }
            value = output(&mut divisor, &point);
            let is_midway =
                |i: &usize| midway[*i].is_none() && value[*i].abs() <= MIDWAY * first[*i].abs();
            let reached: Vec<usize> = (0..STARTS).filter(is_midway).collect();
            if !reached.is_empty() {
                let density = output(&mut density, &point);
                reached.into_iter().for_each(|i| midway[i] = Some((value[i], density[i])));
            }
            // Further steps would be from the same points.
            if !is_moved {
                break;
            }
        }
        let after = output(&mut density, &point);
        let (last, states) = (lengths(&mut field, &point), rows(&mut state, &point));
        (0..STARTS).find_map(|i| {
            let vanishes = value[i].abs() <= LEAST_DECREASE * first[i].abs();
            let grows = after[i].abs() >= LEAST_INCREASE * before[i].abs() && before[i] != 0.0;
            // Where the field is infinite its domain ends.
            let has_field = last[i] < LEAST_INCREASE * speed[i].max(1.0);
            let state: Vec<f64> = states.iter().map(|row| row[i]).collect();
            let place: Vec<f64> = point.iter().map(|row| row[i]).collect();
            // Far away in a chart, a point that another one covers looks like a hypersurface.
            let is_near = state.iter().chain(&place).all(|x| x.abs() <= FARTHEST);
            let is_pole = vanishes && grows && has_field && is_near;
            let (before, other) = midway[i].filter(|_| is_pole)?;
            // ρ grows like a power of the divisor, X^(−q).
            let power = -(after[i] / other).abs().ln() / (value[i] / before).abs().ln();
            (!is_integrable(&mut divisor, &place, &ranges, power)).then_some(state)
        })
    }
}

/// Whether the divisor to a negative power can be integrated over the draws about a zero: if X grows
/// like |x|^p in c directions, X^(−q) can for pq < c.
fn is_integrable(
    divisor: &mut Runner<'_>,
    place: &[f64],
    ranges: &[(usize, [f64; 2])],
    power: f64,
) -> bool {
    let mut value = |displaced: &[f64]| {
        let mut point: Rows = place.iter().map(|x| [*x; STARTS]).collect();
        let moved = ranges.iter().zip(displaced);
        moved.for_each(|((place, _), step)| point[*place] = point[*place].map(|x| x + step));
        output(divisor, &point)[0]
    };
    let form = LocalForm::of(ranges.len(), &mut value);
    form.is_some_and(|form| form.order * power < (1.0 - MARGIN) * form.codimension as f64)
}

/// Difference quotient of the divisor by one draw; the point stays what it is.
fn slope(divisor: &mut Runner<'_>, point: &mut Rows, place: usize) -> [f64; STARTS] {
    let here = point[place];
    let steps = here.map(|x| DIFFERENCE * x.abs().max(1e-3));
    let mut at = |sign: f64| {
        point[place] = std::array::from_fn(|i| here[i] + sign * steps[i]);
        output(divisor, point)
    };
    let (above, below) = (at(1.0), at(-1.0));
    point[place] = here;
    std::array::from_fn(|i| (above[i] - below[i]) / (2.0 * steps[i]))
}

fn runner(tape: &Tape) -> Runner<'_> {
    Evaluator::new(tape, Float::<STARTS>)
}

fn rows(runner: &mut Runner<'_>, point: &Rows) -> Rows {
    runner.run(point);
    runner.outputs().copied().collect()
}

fn output(runner: &mut Runner<'_>, point: &Rows) -> [f64; STARTS] {
    runner.run(point);
    runner.outputs().next().copied().unwrap_or([f64::NAN; STARTS])
}

/// Lengths of the vectors that a tape computes.
fn lengths(runner: &mut Runner<'_>, point: &Rows) -> [f64; STARTS] {
    let rows = rows(runner, point);
    std::array::from_fn(|i| rows.iter().map(|row| row[i] * row[i]).sum::<f64>().sqrt())
}
