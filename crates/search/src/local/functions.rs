//! Functions of the positions without values modulo a prime, as independent numbers with known derivatives.
//!
//! e^A, the sine and cosine of A, and b^c, where A and b are algebraic functions of the positions and c depends
//! on the parameters alone, are replaced by inputs: e^(A/n), tan A/2n and b^(c/n), for the few A and c of which
//! the others are sums of rational multiples. No polynomial in these is 0 if their exponents are linearly
//! independent over the rational numbers, up to constants and logarithms of algebraic functions: so they may have
//! any values at a point. docs/soundness.md, "Functions of the positions", has the proof.

use num_dual::DualNum;

use super::exponents::{Exponents, Multiples};
use crate::series::TruncatedSeries;
use liouville::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, record};
use liouville::mechanics::Draw;
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};
use liouville::scalar::Scalar;

/// Largest number of functions of a case.
const MOST: usize = 16;

/// The meaning of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputRole {
    /// A parameter with any value.
    Parameter,
    /// A position.
    Position,
    /// A velocity, or a parameter with a list of values.
    Other,
}

/// The roles of inputs that are draws of parameters, positions, and others.
pub fn roles(draws: &[Draw], positions: usize) -> impl Fn(usize) -> InputRole + '_ {
    move |input| match draws.get(input) {
        Some(Draw::Within(_) | Draw::Of(..)) => InputRole::Parameter,
        None if input < draws.len() + positions => InputRole::Position,
        _ => InputRole::Other,
    }
}

/// A kind of functions whose exponents are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FunctionKind {
    /// e^A
    Exponential,
    /// tan A/2
    HalfAngle,
    /// b^c; the place of b
    Power(usize),
}

/// A function in place of which there is an input: its kind, and the place of A or c.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FunctionStep {
    /// Kind, with the base.
    pub kind: FunctionKind,
    /// Place of the exponent or the angle.
    pub argument: usize,
}

impl FunctionStep {
    fn of(step: Step<'_>) -> Option<Self> {
        let (kind, argument) = match step {
            Step::Unary(UnaryFunction::Exp, a) => (FunctionKind::Exponential, a),
            Step::Unary(UnaryFunction::Sin | UnaryFunction::Cos, a) => (FunctionKind::HalfAngle, a),
            Step::Binary(BinaryOperation::Pow, base, a) => (FunctionKind::Power(base), a),
            _ => return None,
        };
        Some(Self { kind, argument })
    }

    /// Places of the values on which the function depends.
    fn values(&self) -> impl Iterator<Item = usize> {
        let base = match self.kind {
            FunctionKind::Power(base) => Some(base),
            FunctionKind::Exponential | FunctionKind::HalfAngle => None,
        };
        base.into_iter().chain([self.argument])
    }
}

/// Values of positions and velocities in which functions are inputs.
pub struct Adjoined {
    /// The recording.
    pub graph: Graph,
    /// Its values.
    pub outputs: Vec<Expr>,
    /// Functions whose inputs come one after another.
    pub functions: Vec<AdjoinedFunction>,
}

/// A function in place of which there is an input, by formulas without it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AdjoinedFunction {
    /// e^A
    Exponential(Expr),
    /// tan A/2
    HalfAngle(Expr),
    /// b^c
    Power(Expr, Expr),
}

/// The functions of a recording, in a form to compute their series.
pub struct FunctionSeries {
    functions: Vec<AdjoinedFunction>,
    /// Computes the arguments of one function after another.
    tape: Tape,
    inputs: usize,
    /// Inputs on which the arguments depend.
    needed: Vec<usize>,
}

impl FunctionSeries {
    /// Prepares the functions of a recording.
    pub fn new(graph: &Graph, functions: Vec<AdjoinedFunction>) -> Self {
        let arguments: Vec<Expr> = functions.iter().flat_map(AdjoinedFunction::arguments).collect();
        let needed = arguments.iter().flat_map(|own| graph.inputs_of(*own)).collect();
        Self { tape: Tape::new(graph, &arguments), inputs: graph.inputs(), needed, functions }
    }

    /// Number of functions.
    pub fn len(&self) -> usize {
        self.functions.len()
    }

    /// Whether a function depends on an input in other ways than its derivatives show.
    pub fn depend_on(&self, input: usize) -> bool {
        self.needed.contains(&input)
    }

    /// Computes the series of the functions from those of the parameters and positions, and from the values at
    /// the point; `None` where one has none.
    pub fn at(
        &self,
        domain: &TruncatedSeries,
        fixed: &[Vec<u64>],
        values: &[u64],
    ) -> Option<Vec<Vec<u64>>> {
        let mut evaluator = Evaluator::new(&self.tape, domain.clone());
        let mut inputs = fixed.to_vec();
        inputs.resize(self.inputs, domain.number(0));
        evaluator.run(&inputs);
        let mut arguments = evaluator.outputs();
        let each = self.functions.iter().zip(values).map(|(function, value)| {
            let first = arguments.next().filter(|own| !own.is_empty())?;
            let series = match function {
                AdjoinedFunction::Exponential(_) => domain.exponential(first, *value),
                AdjoinedFunction::HalfAngle(_) => domain.half_angle(first, *value),
                AdjoinedFunction::Power(..) => {
                    let exponent = arguments.next().filter(|own| !own.is_empty())?;
                    domain.power_with(first, exponent[0], *value)?
                }
            };
            Some(series).filter(|series| !series.is_empty())
        });
        each.collect()
    }
}

impl AdjoinedFunction {
    /// The values that determine the function.
    pub fn arguments(&self) -> impl Iterator<Item = Expr> {
        let (first, second) = match *self {
            Self::Exponential(a) | Self::HalfAngle(a) => (a, None),
            Self::Power(base, exponent) => (base, Some(exponent)),
        };
        std::iter::once(first).chain(second)
    }
}

/// Replaces the functions that some values need by further inputs from `at` on. `None` if there are none, or
/// if they may depend on each other or on velocities.
pub fn adjoined(
    graph: &Graph,
    outputs: &[Expr],
    at: usize,
    role: &dyn Fn(usize) -> InputRole,
) -> Result<Option<Adjoined>, Fault> {
    let reached = graph.reached(outputs.iter().copied());
    let Some(steps) = function_steps(graph, &reached, role) else { return Ok(None) };
    let Some(exponents) = Exponents::of(graph, &steps, role) else { return Ok(None) };
    let count = exponents.independent().len();
    let (made, (outputs, functions)) = record(graph.inputs() + count, |inputs| {
        let (before, rest) = inputs.split_at(at);
        let (symbols, after) = rest.split_at(count);
        let own = [before, after].concat();
        let values = graph.replay(&reached, &own, |_, step, values| {
            let function = FunctionStep::of(step)?;
            let number = steps.iter().position(|own| *own == function)?;
            written(step, exponents.multiples(number), symbols, values)
        });
        let value = |place: usize| values[place].unwrap_or_else(Expr::undefined);
        let function = |(number, divisor): &(usize, i64)| {
            let FunctionStep { kind, argument } = steps[*number];
            let part = value(argument) * Expr::rational(&Rational::new(1, *divisor));
            match kind {
                FunctionKind::Exponential => AdjoinedFunction::Exponential(part),
                FunctionKind::HalfAngle => AdjoinedFunction::HalfAngle(part),
                FunctionKind::Power(base) => AdjoinedFunction::Power(value(base), part),
            }
        };
        let outputs: Vec<Expr> = outputs.iter().map(|own| value(graph.place(*own))).collect();
        (outputs, exponents.independent().iter().map(function).collect::<Vec<_>>())
    })?;
    Ok(Some(Adjoined { graph: made, outputs, functions }))
}

/// Lists the functions that are needed; `None` if there are none, too many, or others.
fn function_steps(
    graph: &Graph,
    reached: &[bool],
    role: &dyn Fn(usize) -> InputRole,
) -> Option<Vec<FunctionStep>> {
    let mut found: Vec<FunctionStep> = Vec::new();
    let mut has_function = vec![false; graph.len()];
    for (place, step) in graph.steps_at(reached) {
        has_function[place] = step.arguments().any(|argument| has_function[argument]);
        if let Step::Unary(UnaryFunction::Ln | UnaryFunction::Atan, _) = step {
            return None;
        }
        let Some(own) = FunctionStep::of(step) else { continue };
        // Functions of functions need a tower of fields.
        if has_function[place] {
            return None;
        }
        has_function[place] = true;
        let roles = |place: usize| graph.inputs_of(graph.at(place)).into_iter().map(role);
        let all: Vec<InputRole> = own.values().flat_map(roles).collect();
        if all.contains(&InputRole::Other) || !all.contains(&InputRole::Position) {
            return None;
        }
        if matches!(own.kind, FunctionKind::Power(_))
            && roles(own.argument).any(|role| role == InputRole::Position)
        {
            return None;
        }
        if !found.contains(&own) {
            found.push(own);
        }
    }
    (1..=MOST).contains(&found.len()).then_some(found)
}

/// Writes a function by symbols for the independent ones.
fn written(
    step: Step<'_>,
    multiples: &Multiples,
    symbols: &[Expr],
    values: &[Option<Expr>],
) -> Option<Expr> {
    let one = Expr::rational(&Rational::from(1));
    let of_function = multiples.of_functions.iter();
    match step {
        Step::Unary(own @ (UnaryFunction::Sin | UnaryFunction::Cos), _) => {
            let zero = Expr::rational(&Rational::from(0));
            let (mut cosine, mut sine) = (one, zero);
            for (number, times) in of_function {
                let t = symbols[*number];
                let scale = (one + t * t).recip();
                let (c, s) = ((one - t * t) * scale, (t + t) * scale);
                let s = if *times < 0 { -s } else { s };
                for _ in 0..times.abs() {
                    (cosine, sine) = (cosine * c - sine * s, sine * c + cosine * s);
                }
            }
            Some(if own == UnaryFunction::Sin { sine } else { cosine })
        }
        Step::Unary(..) => {
            let factors = of_function.map(|(number, times)| power(symbols[*number], *times));
            Some(factors.fold(one, |all, factor| all * factor))
        }
        Step::Binary(_, base, _) => {
            let factors = of_function.map(|(number, times)| power(symbols[*number], *times));
            let whole = power(values[base]?, multiples.of_base);
            Some(factors.fold(whole, |all, factor| all * factor))
        }
        _ => None,
    }
}

/// A whole power.
fn power(base: Expr, exponent: i64) -> Expr {
    i32::try_from(exponent).map_or_else(|_| Expr::undefined(), |exponent| base.powi(exponent))
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::mechanics::{NumberLine, Range};

    /// Number of functions that are adjoined to one of x, y and a parameter k; `None` if they are refused.
    fn of(build: impl FnOnce([Expr; 3]) -> Expr) -> Option<usize> {
        let (graph, values) =
            record(3, |inputs| vec![build([inputs[1], inputs[2], inputs[0]])]).expect("recorded");
        let range = Range { low: Rational::from(1), high: Rational::from(2) };
        let draws = [Draw::Of(NumberLine::All, range)];
        let made = adjoined(&graph, &values, 3, &roles(&draws, 2)).expect("recorded");
        made.map(|own| {
            assert_eq!(own.graph.inputs(), 3 + own.functions.len());
            own.functions.len()
        })
    }

    fn number(above: i64, below: i64) -> Expr {
        Expr::rational(&Rational::new(above, below))
    }

    #[test]
    fn functions_are_products_of_few() {
        let two = || number(2, 1);
        assert_eq!(of(|[x, y, _]| x.exp() + y.exp() * (x + y).exp()), Some(2));
        assert_eq!(of(|[x, y, _]| (two() * x * y).exp() + (x * y * number(1, 3)).exp()), Some(1));
        assert_eq!(of(|[x, _, k]| x.exp() + (k * x).exp()), Some(2));
        assert_eq!(of(|[x, _, _]| (two() * x).sin() + x.cos() * x.exp()), Some(2));
        assert_eq!(of(|[x, _, k]| x.powd(k) + x.powd(k + 3.0) + x.powd(k * 2.0)), Some(1));
        assert_eq!(of(|[x, y, k]| x.powd(k) + y.powd(k) + (x + y).powd(-k)), Some(3));
        assert_eq!(of(|[x, y, _]| (x * x + y * y).sqrt().exp() + x.exp()), Some(2));
        // An irrational ratio, a constant between them, dependent bases.
        assert_eq!(of(|[x, _, _]| x.exp() + (two().sqrt() * x).exp()), None);
        assert_eq!(of(|[x, _, _]| x.exp() + (x + 1.0).exp()), None);
        assert_eq!(of(|[x, _, k]| x.powd(k) + (two() * x).powd(k)), None);
        assert_eq!(of(|[x, y, k]| x.powd(k) + y.powd(k) + (x * y).powd(k)), None);
        // Without small common divisors.
        let far = |x: Expr| {
            let parts =
                [1_000_003, 1_000_033, 1_000_037, 1_000_039].map(|n| (x * number(1, n)).exp());
            parts.into_iter().fold(x.exp(), |sum, part| sum + part)
        };
        assert_eq!(of(|[x, _, _]| far(x)), None);
        // Functions of functions, of the parameter alone, and others.
        assert_eq!(of(|[x, _, _]| x.exp().sin()), None);
        assert_eq!(of(|[x, _, k]| x.exp() + k.sin()), None);
        assert_eq!(of(|[x, y, _]| x.powd(y)), None);
        assert_eq!(of(|[x, _, _]| x.ln() + x.exp()), None);
        assert_eq!(of(|[x, y, _]| x * y), None, "there are none");
    }

    #[test]
    fn functions_keep_their_values() {
        // In f64, with the functions put in.
        let build = |[x, y, k]: [Expr; 3]| {
            let angle = x * y;
            vec![
                (angle * number(3, 2)).sin() + angle.cos() * (x * number(-2, 1)).exp(),
                (x * number(1, 2)).exp() * y.powd(k + 2.0) + y.powd(k * number(-1, 2)),
            ]
        };
        let (graph, values) =
            record(3, |inputs| build([inputs[1], inputs[2], inputs[0]])).expect("recorded");
        let range = Range { low: Rational::from(1), high: Rational::from(2) };
        let draws = [Draw::Within(range)];
        let made = adjoined(&graph, &values, 1, &roles(&draws, 2)).expect("recorded");
        let made = made.expect("three functions");
        assert_eq!(made.functions.len(), 3);
        let run = |graph: &Graph, outputs: &[Expr], inputs: &[f64]| -> Vec<f64> {
            let tape = Tape::new(graph, outputs);
            let mut evaluator = Evaluator::new(&tape, liouville::number::float::Float::<1>);
            evaluator.run(&inputs.iter().map(|x| [*x]).collect::<Vec<[f64; 1]>>());
            evaluator.outputs().map(|own| own[0]).collect()
        };
        let point = [1.25, 0.75, 1.5];
        let expected = run(&graph, &values, &point);
        let arguments: Vec<Expr> =
            made.functions.iter().flat_map(AdjoinedFunction::arguments).collect();
        let placed = |symbols: [f64; 3]| [&point[..1], &symbols[..], &point[1..]].concat();
        let arguments = run(&made.graph, &arguments, &placed([0.0; 3]));
        let mut next = arguments.into_iter();
        let mut value = |function: &AdjoinedFunction| {
            let first = next.next().expect("an argument");
            match function {
                AdjoinedFunction::Exponential(_) => first.exp(),
                AdjoinedFunction::HalfAngle(_) => (first / 2.0).tan(),
                AdjoinedFunction::Power(..) => first.powf(next.next().expect("an exponent")),
            }
        };
        let symbols: Vec<f64> = made.functions.iter().map(&mut value).collect();
        let found = run(&made.graph, &made.outputs, &placed([symbols[0], symbols[1], symbols[2]]));
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
        }
    }
}
