//! Jumps of functions along lines of states: a function that jumps is not kept by a motion that
//! crosses the jump, whatever its rate is on both sides.
//!
//! A jump is observed in f64, not proved, and is told in a remark.

use super::judging::Judging;
use super::sampler::Sampler;
use super::witness::briefly;
use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape};
use crate::mechanics::{Draw, combinations};
use crate::number::arb::ArbBall;
use crate::number::double_double::{DoubleDouble, DoubleDoubles};
use crate::number::float::Float;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, Domain, UnaryFunction};
use crate::proof::is_square;

/// Number of points into which a line, or a part of it, is divided at a time.
const POINTS: usize = 64;
/// Number of lines through pairs of states.
const LINES: u64 = 16;
/// The same where each point takes long.
const FEW_LINES: u64 = 4;
/// Number of divisions: before the sides of a jump are first compared, and in all.
const EARLY: usize = 3;
const LATE: usize = 6;
/// Largest change of each side between the two, in units of the jump.
const MOST_DRIFT: f64 = 0.1;
/// Largest change of a coordinate between the sides of a jump, in units of its values on the line.
const MOST_MOVED: f64 = 1e-3;
/// Smallest jump in units of the function's values on the line.
const LEAST_JUMP: f64 = 1e-9;
/// Bits with which a jump is computed again.
const PRECISION: u32 = 256;
/// Value of antiderivatives, which do not jump.
const ANTIDERIVATIVE: f64 = 0.5;

impl Judging<'_> {
    /// Finds a state, as text, near which one of these values jumps for some listed values.
    ///
    /// `None` if no jump was met on the lines that were tried.
    pub(super) fn jump(&self, sampler: &Sampler, values: &[Expr]) -> Result<Option<String>, Fault> {
        let Some(digits) = may_jump(self.graph, values) else { return Ok(None) };
        let Some(choices) = combinations(sampler.recipes()) else { return Ok(None) };
        // All choices together take as long as one.
        let lines = (digits.lines() / choices.len().max(1) as u64).max(1);
        for fixed in choices {
            let (graph, groups) = sampler.compose(self.graph, &[values.to_vec()], &fixed)?;
            let groups = groups.concat();
            // What jumps for other values alone may be a constant for these.
            let found = match may_jump(&graph, &groups) {
                Some(_) => {
                    let sought = Sought { digits, lines, of_level: false, fixed: &fixed };
                    self.jump_of(sampler, &graph, &groups, &sought)
                }
                None => None,
            };
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    /// Finds a state near which a value jumps that is a function of the draws.
    fn jump_of(
        &self,
        sampler: &Sampler,
        graph: &Graph,
        values: &[Expr],
        sought: &Sought<'_>,
    ) -> Option<String> {
        let tape = Tape::new(graph, values);
        let mut along = match sought.digits {
            Digits::Single => Along::Single(Evaluator::new(&tape, Float::<POINTS>)),
            Digits::Double => Along::Double(Evaluator::new(&tape, DoubleDoubles)),
        };
        let mut precise = Evaluator::new(&tape, ArbBall::new(PRECISION));
        (0..sought.lines).find_map(|line| {
            let ends = [2 * line, 2 * line + 1].map(|index| sampler.nearest_draws(index));
            let line = Line::between(sampler, ends, (sought.fixed, graph.inputs()));
            let jump = line.jump(&mut along).filter(|jump| line.is_real(&mut precise, jump))?;
            let model = &self.case.model;
            let state = &sampler.made()[model.free_components()..];
            let tape = Tape::new(sampler.graph(), state);
            let mut states = Along::Single(Evaluator::new(&tape, Float::<POINTS>));
            let near = line.state_near(&mut states, &jump)?;
            // At a pole of a chart states go from one end of the level to another, and no motion does.
            let passes = sought.of_level || line.is_continuous(&mut states, &jump);
            passes.then(|| briefly(model, &near))
        })
    }

    /// Returns a warning if states jump along a line on a level whose equations may jump.
    pub(super) fn jump_of_level(&self, sampler: &Sampler) -> Option<String> {
        let digits =
            may_jump(self.graph, &self.common.level).filter(|_| !sampler.is_numerical())?;
        let state = &sampler.made()[self.case.model.free_components()..];
        let any = vec![None; sampler.recipes().len()];
        let sought = Sought { digits, lines: digits.lines(), of_level: true, fixed: &any };
        let place = self.jump_of(sampler, sampler.graph(), state, &sought);
        place.map(|place| {
            format!("near {place} the level jumps: motions across the jump are not covered")
        })
    }
}

/// Where jumps are sought.
struct Sought<'a> {
    digits: Digits,
    /// Number of lines.
    lines: u64,
    /// Whether it is the states that may jump, as functions of the draws.
    of_level: bool,
    /// Listed values, by draw.
    fixed: &'a [Option<Rational>],
}

/// Numbers that follow a line.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Digits {
    Single,
    /// Twice as many: a square that is written out is lost in f64 where it is small.
    Double,
}

impl Digits {
    /// Number of lines that are followed.
    fn lines(self) -> u64 {
        match self {
            Self::Single => LINES,
            Self::Double => FEW_LINES,
        }
    }
}

/// Values at points of lines.
enum Along<'t> {
    Single(Evaluator<'t, Float<POINTS>>),
    Double(Evaluator<'t, DoubleDoubles>),
}

impl Along<'_> {
    fn values(&mut self, inputs: &[[f64; POINTS]]) -> Vec<[f64; POINTS]> {
        match self {
            Along::Single(run) => {
                run.run(inputs);
                run.outputs().copied().collect()
            }
            Along::Double(run) => {
                let mut all: Vec<[f64; POINTS]> = Vec::new();
                for point in 0..POINTS {
                    let at = inputs.iter().map(|own| DoubleDouble::from_f64(own[point]));
                    run.run(&at.collect::<Vec<_>>());
                    let values: Vec<f64> = run.outputs().map(|value| value.hi).collect();
                    all.resize(values.len(), [f64::NAN; POINTS]);
                    all.iter_mut().zip(values).for_each(|(own, value)| own[point] = value);
                }
                all
            }
        }
    }
}

/// A jump that is met on a line.
struct Jump {
    /// Index of the value that jumps.
    output: usize,
    /// Places on both sides of it.
    sides: [f64; 2],
    /// Change of the value between them.
    size: f64,
}

/// A line of draws, with the parameters of its first end.
struct Line {
    from: Vec<f64>,
    to: Vec<f64>,
}

impl Line {
    fn between(
        sampler: &Sampler,
        ends: [Vec<(f64, bool)>; 2],
        (fixed, inputs): (&[Option<Rational>], usize),
    ) -> Self {
        let [mut from, mut to] = ends.map(|end| end.iter().map(|draw| draw.0).collect::<Vec<_>>());
        for (draw, value) in from.iter_mut().zip(fixed) {
            *draw = value.as_ref().map_or(*draw, |value| value.to_f64().0);
        }
        for (index, recipe) in sampler.recipes().iter().enumerate() {
            let is_shared =
                index < sampler.parameter_draws() || matches!(recipe, Draw::Sign | Draw::OneOf(_));
            if is_shared {
                to[index] = from[index];
            }
        }
        from.resize(inputs.max(from.len()), ANTIDERIVATIVE);
        to.resize(from.len(), ANTIDERIVATIVE);
        Self { from, to }
    }

    /// Values at some places on the line.
    fn values(&self, along: &mut Along<'_>, places: [f64; POINTS]) -> Vec<[f64; POINTS]> {
        let input = |(from, to): (&f64, &f64)| places.map(|place| from + place * (to - from));
        let inputs: Vec<[f64; POINTS]> = self.from.iter().zip(&self.to).map(input).collect();
        along.values(&inputs)
    }

    /// Whether a value changes by half of a jump at least between its places, with many digits: less
    /// of it is rounding.
    fn is_real(&self, precise: &mut Evaluator<'_, ArbBall>, jump: &Jump) -> bool {
        let domain = ArbBall::new(PRECISION);
        let mut at = |place: f64| {
            let input = |(from, to): (&f64, &f64)| {
                Some(domain.values(&[Rational::from_f64(from + place * (to - from))?]))
            };
            let inputs = self.from.iter().zip(&self.to).map(input).collect::<Option<Vec<_>>>()?;
            precise.run(&inputs);
            precise.output(jump.output).as_ref().map(|value| value.enclosure())
        };
        let [Some((a, error_a)), Some((b, error_b))] = jump.sides.map(&mut at) else {
            return false;
        };
        (a - b).abs() - error_a - error_b >= 0.5 * jump.size
    }

    /// State at a jump, or on one side of it where a coordinate has no value between the sides.
    fn state_near(&self, states: &mut Along<'_>, jump: &Jump) -> Option<Vec<f64>> {
        let [low, high] = jump.sides;
        let places = std::array::from_fn(|k| [0.5 * (low + high), low, high][k.min(2)]);
        let near = self.values(states, places);
        let at = (0..POINTS).find(|k| near.iter().all(|x| x[*k].is_finite()))?;
        Some(near.iter().map(|x| x[at]).collect())
    }

    /// Whether states exist on both sides of a jump and hardly differ.
    fn is_continuous(&self, states: &mut Along<'_>, jump: &Jump) -> bool {
        let whole = self.values(states, divided(0.0, 1.0));
        let sides = self.values(states, std::array::from_fn(|k| jump.sides[k.min(1)]));
        sides.iter().zip(&whole).all(|(sides, whole)| {
            let finite = whole.iter().filter(|value| value.is_finite());
            let size = finite.fold(0.0f64, |most, value| most.max(value.abs()));
            (sides[0] - sides[1]).abs() <= MOST_MOVED * size
        })
    }

    /// Finds an output that has different limits from both sides of a place.
    fn jump(&self, along: &mut Along<'_>) -> Option<Jump> {
        let whole = self.values(along, divided(0.0, 1.0));
        let of_output = |output| self.jump_of(along, output, &whole[output]);
        (0..whole.len()).find_map(of_output)
    }

    fn jump_of(&self, along: &mut Along<'_>, output: usize, whole: &[f64; POINTS]) -> Option<Jump> {
        let size =
            whole.iter().filter(|value| value.is_finite()).fold(0.0f64, |a, b| a.max(b.abs()));
        let (mut places, mut values) = (divided(0.0, 1.0), *whole);
        let mut early = [0.0; 2];
        for division in 0..LATE {
            let step = |k: &usize| (values[k + 1] - values[*k]).abs();
            let steepest = (0..POINTS - 1)
                .filter(|k| step(k).is_finite())
                .max_by(|a, b| step(a).total_cmp(&step(b)))?;
            let sides = [values[steepest], values[steepest + 1]];
            let jump = (sides[1] - sides[0]).abs();
            if jump <= LEAST_JUMP * size {
                return None;
            }
            if division == EARLY {
                early = sides;
            }
            if division + 1 == LATE {
                let drift = |k: usize| (sides[k] - early[k]).abs();
                let is_jump = (0..2).all(|side| drift(side) <= MOST_DRIFT * jump);
                let sides = [places[steepest], places[steepest + 1]];
                return is_jump.then_some(Jump { output, sides, size: jump });
            }
            places = divided(places[steepest], places[steepest + 1]);
            values = self.values(along, places)[output];
        }
        None
    }
}

/// Places from one to another, in equal steps.
fn divided(from: f64, to: f64) -> [f64; POINTS] {
    std::array::from_fn(|k| from + (to - from) * k as f64 / (POINTS - 1) as f64)
}

/// Whether values contain what can jump: a quotient with a modulus, or with the root, logarithm or
/// broken power of a square, or an arctangent or exponential of a quotient. Other quotients jump on sets that no motion meets.
/// Returns the digits that are needed to see it.
fn may_jump(graph: &Graph, values: &[Expr]) -> Option<Digits> {
    let may_be_corner = |step: Step<'_>| match step {
        Step::Unary(function, _) => !matches!(function, UnaryFunction::Neg | UnaryFunction::Recip),
        Step::Power(_, exponent) => exponent.to_integer().is_none(),
        Step::Binary(BinaryOperation::Pow, ..) => true,
        _ => false,
    };
    if !graph.has_step(values, may_be_corner) {
        return None;
    }
    let reached = graph.reached(values.iter().copied());
    let mut is_quotient = vec![false; reached.len()];
    let (mut has_corner, mut has_quotient) = (false, false);
    let mut radicands = Vec::new();
    for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
        let below = step.arguments().any(|argument| is_quotient[argument]);
        is_quotient[place] = below
            || match step {
                Step::Unary(UnaryFunction::Recip, a) => !is_constant(graph, a),
                Step::Power(_, exponent) => exponent.is_negative(),
                Step::Binary(BinaryOperation::Pow, ..) => true,
                _ => false,
            };
        has_quotient |= is_quotient[place];
        has_corner |= match step {
            Step::Unary(UnaryFunction::Abs, _) => true,
            Step::Unary(UnaryFunction::Sqrt | UnaryFunction::Ln, a) => has_square_factor(graph, a),
            Step::Power(a, exponent) => {
                exponent.to_integer().is_none() && has_square_factor(graph, a)
            }
            Step::Binary(BinaryOperation::Pow, a, _) => has_square_factor(graph, a),
            Step::Unary(UnaryFunction::Atan | UnaryFunction::Exp, _) => below,
            _ => false,
        };
        if let Step::Unary(UnaryFunction::Sqrt, a) = step {
            radicands.push(a);
        }
    }
    let is_written_out = |radicand: &usize| is_square(graph, graph.at(*radicand));
    match (has_quotient, has_corner) {
        (false, _) => None,
        (true, true) => Some(Digits::Single),
        (true, false) => radicands.iter().any(is_written_out).then_some(Digits::Double),
    }
}

fn is_constant(graph: &Graph, place: usize) -> bool {
    matches!(graph.step(place), Step::Constant(_))
}

/// Whether a value is written as a product with the square of something.
fn has_square_factor(graph: &Graph, place: usize) -> bool {
    match graph.step(place) {
        Step::Binary(BinaryOperation::Mul, a, b) => {
            a == b || has_square_factor(graph, a) || has_square_factor(graph, b)
        }
        Step::Power(_, exponent) => {
            let (above, below) = exponent.parts();
            below == 1.into() && !above.bit(0)
        }
        _ => false,
    }
}
