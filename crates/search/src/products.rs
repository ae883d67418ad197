//! Products of known integrals, and their number in each degree in the velocities.

use crate::streams::SearchStream;
use num_dual::Dual;

use super::SearchError;
use super::echelon::Echelon;
use super::local::Coordinates;
use super::local::functions::{adjoined, roles};
use super::symbols::symbolised;
use super::{Effort, FoundKind, SearchReport, ask};
use liouville::case::Case;
use liouville::formula::Formula;
use liouville::graph::{Evaluator, Expr, Step, Tape};
use liouville::mechanics::Phase;
use liouville::number::prime::{Modulus, Prime, UNDEFINED};
use liouville::number::{BinaryOperation, UnaryFunction};
use liouville::proof::{root_numbers, statement_seed};

/// Highest degree that is recognised.
const MOST_DEGREE: usize = 16;
/// Number of points of a line at which slopes are taken.
const SLOPE_POINTS: usize = 2 * MOST_DEGREE + 8;
/// Number of lines to try, since roots exist on some only.
const TRIALS: usize = 64;
/// Number of primes that must agree on a degree: one alone sees a smaller degree with a chance below
/// 2⁻⁵⁰.
pub const DEGREE_PRIMES: u64 = 3;

/// Independent integrals with their degrees in the velocities.
#[derive(Clone, Debug, Default)]
pub struct Generators {
    each: Vec<(Formula, u32)>,
    /// Coordinates of the level, if positions and velocities are known.
    coordinates: Option<Coordinates>,
}

impl Generators {
    /// Integrals of which the degrees are known.
    pub fn of(known: Vec<(Formula, u32)>) -> Self {
        Self { each: known, coordinates: None }
    }

    /// Collects the energy, if it is an integral.
    pub fn energy(case: &Case, effort: &Effort) -> Result<Self, SearchError> {
        let mut generators = Self { each: Vec::new(), coordinates: Coordinates::of(case).ok() };
        if let Some(energy) = ask::proved_energy(case, effort)? {
            generators.add(case, &energy, effort.options.seed)?;
        }
        Ok(generators)
    }

    /// Collects the energy and all integrals found or claimed.
    pub fn all(case: &Case, effort: &Effort, report: &SearchReport) -> Result<Self, SearchError> {
        let mut generators = Self::energy(case, effort)?;
        for formula in told(case, effort, report)? {
            generators.add(case, &formula, effort.options.seed)?;
        }
        Ok(generators)
    }

    /// The same with further integrals that are functions of these; `None` if there are none.
    pub fn with_further(
        &self,
        case: &Case,
        effort: &Effort,
        report: &SearchReport,
    ) -> Result<Option<Self>, SearchError> {
        let mut with = self.clone();
        let own = report.found.iter().filter(|found| found.kind == FoundKind::FurtherIntegral);
        for formula in own.filter_map(|found| found.function()) {
            if self.formulas().all(|known| known.text() != formula.text()) {
                with.add(case, formula, effort.options.seed)?;
            }
        }
        Ok((with.each.len() > self.each.len()).then_some(with))
    }

    /// The same splitting of the state with other integrals.
    pub fn replaced(self, each: Vec<(Formula, u32)>) -> Self {
        Self { each, ..self }
    }

    /// Adds an integral if its degree can be determined: that in the velocities, or in all variables of
    /// a field without a level.
    pub fn add(&mut self, case: &Case, formula: &Formula, seed: u64) -> Result<(), SearchError> {
        let degree = match &self.coordinates {
            Some(coordinates) => degree_in(case, formula, coordinates, seed)?,
            None if case.model.level.is_empty() => degree_in_state(case, formula, seed)?,
            None => None,
        };
        if let Some(degree) = degree.filter(|degree| *degree > 0) {
            self.each.push((formula.clone(), degree));
        }
        Ok(())
    }

    /// Iterates over the formulas.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        self.each.iter().map(|(formula, _)| formula)
    }

    /// Iterates over the formulas with their degrees in the velocities.
    pub fn each(&self) -> impl Iterator<Item = (&Formula, u32)> {
        self.each.iter().map(|(formula, degree)| (formula, *degree))
    }

    /// Lists the products of this degree, or with `mixed` of at most this degree, as exponents of
    /// the formulas.
    pub fn exponents(&self, degree: u32, mixed: bool) -> Vec<Vec<u32>> {
        let mut found: Vec<(u32, Vec<u32>)> = vec![(0, Vec::new())];
        for (_, own) in &self.each {
            let raised = |(total, powers): (u32, Vec<u32>)| {
                (0..=(degree - total) / own).map(move |power| {
                    (total + power * own, powers.iter().copied().chain([power]).collect())
                })
            };
            found = found.into_iter().flat_map(raised).collect();
        }
        let wanted = found.into_iter().filter(|(total, _)| mixed || *total == degree);
        wanted.map(|(_, powers)| powers).collect()
    }

    /// Number of products of this degree; with `mixed`, of at most this degree, including 1.
    pub fn products(&self, degree: u32, mixed: bool) -> usize {
        // Entry d: number of products of degree d of the generators so far.
        let mut ways = vec![0usize; degree as usize + 1];
        ways[0] = 1;
        for (_, own) in &self.each {
            for d in *own as usize..ways.len() {
                ways[d] += ways[d - *own as usize];
            }
        }
        if mixed { ways.iter().sum() } else { ways[degree as usize] }
    }
}

/// Lists the integrals found, and those claimed that are independent of them.
pub fn told(
    case: &Case,
    effort: &Effort,
    report: &SearchReport,
) -> Result<Vec<Formula>, SearchError> {
    let mut told: Vec<Formula> = report.functions(FoundKind::Integral).cloned().collect();
    for ask::Claimed { formula, .. } in &report.claimed {
        if ask::independent(case, &told, formula, effort)?.is_some() {
            told.push(formula.clone());
        }
    }
    Ok(told)
}

/// Finds the degree of a formula in the velocities of some coordinates; `None` if it is not a polynomial in
/// them, or if its slope has no value modulo a prime.
///
/// On a random line w₀ + s u a function F is a polynomial P in s exactly if P' = P (ln F)', which
/// are linear equations for the coefficients of P. The logarithm's slope is a rational function
/// where F has factors that fields lack, such as exponentials of the positions. With exp, ln and the
/// like of the velocities F may be cP with another c on each side of a point where it has no value, as
/// exp(½ ln v²) = |v|: then `None`.
pub fn degree_in(
    case: &Case,
    formula: &Formula,
    coordinates: &Coordinates,
    seed: u64,
) -> Result<Option<u32>, SearchError> {
    on_lines(case, formula, coordinates, seed, Reading::Polynomial)
}

/// Finds the degree of a formula in all variables of a state without a level, as [`degree_in`] does in
/// the velocities.
pub fn degree_in_state(
    case: &Case,
    formula: &Formula,
    seed: u64,
) -> Result<Option<u32>, SearchError> {
    on_lines(case, formula, &Coordinates::all_moving(case), seed, Reading::Polynomial)
}

/// Finds the degree of P in all variables of a state without a level, if a formula is exp P up to a
/// factor.
///
/// P is a polynomial exactly if the slope of the logarithm is one on random lines.
pub fn exponent_degree_in_state(
    case: &Case,
    formula: &Formula,
    seed: u64,
) -> Result<Option<u32>, SearchError> {
    on_lines(case, formula, &Coordinates::all_moving(case), seed, Reading::Exponent)
}

/// Degree that is read from the slopes of a logarithm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Reading {
    /// The degree of a polynomial.
    Polynomial,
    /// The degree of the exponent of an exponential.
    Exponent,
}

impl Reading {
    fn degree(self, slopes: &[u64], m: &Modulus) -> Option<u32> {
        match self {
            Self::Polynomial => polynomial_degree(slopes, m),
            Self::Exponent => exponent_degree(slopes, m),
        }
    }
}

/// Reads a degree from the slopes of a formula's logarithm at the points 0, 1, 2, … of a random line in
/// the velocities; `None` if the lines disagree, or if there are no values.
fn on_lines(
    case: &Case,
    formula: &Formula,
    coordinates: &Coordinates,
    seed: u64,
    read: Reading,
) -> Result<Option<u32>, SearchError> {
    let model = &case.model;
    let all = model.vocabulary.with_abbreviations(formula, &model.abbreviations);
    let draws = model.parameter_draws();
    let inputs = draws.len() + coordinates.count() + coordinates.velocities + 1;
    let (graph, values) = coordinates.record(inputs, |inputs| {
        let (given, point) = inputs.split_at(draws.len());
        let parameters = coordinates.parameters(model, given);
        let (positions, rest) = point.split_at(coordinates.positions);
        let (start, rest) = rest.split_at(coordinates.velocities);
        let (along, s) = rest.split_at(coordinates.velocities);
        let velocities = start.iter().zip(along).map(|(w, u)| Dual::new(*w + s[0] * *u, *u));
        let positions = positions.iter().map(|q| Dual::from_re(*q));
        let parameters: Vec<Dual<Expr>> = parameters.iter().map(|p| Dual::from_re(*p)).collect();
        let point: Vec<Dual<Expr>> = positions.chain(velocities).collect();
        let state = coordinates.state(model, &parameters, &point);
        let moved = Phase::new(model, &parameters, &state);
        let slope = formula.logarithmic_derivative(&mut |symbol| moved.value(symbol));
        // An ∫ whose variable depends on the velocities has a degree that this test does not see.
        let integrals = all.iter().flat_map(|f| f.antiderivatives(&mut |s| moved.value(s)));
        let value = moved.scalar(formula).re;
        [slope, value].into_iter().chain(integrals.map(|(_, variable)| variable.eps)).collect()
    })?;
    let (slope, own, moving) = (values[0], values[1], &values[2..]);
    use UnaryFunction::{Atan, Cos, Exp, Ln, Sin};
    let is_moving = |a: &usize| {
        let reached = graph.inputs_of(graph.at(*a));
        reached.iter().any(|input| *input >= draws.len() + coordinates.positions)
    };
    let has_function = |step: Step<'_>| match step {
        Step::Unary(Exp | Ln | Sin | Cos | Atan, a) => is_moving(&a),
        Step::Binary(BinaryOperation::Pow, a, b) => is_moving(&a) || is_moving(&b),
        _ => false,
    };
    let own = graph.reached([own]);
    if read == Reading::Polynomial
        && (0..graph.len()).any(|place| own[place] && has_function(graph.step(place)))
    {
        return Ok(None);
    }
    if moving.iter().any(|rate| !graph.constant_value(*rate).is_some_and(|rate| rate.is_zero())) {
        return Ok(None);
    }
    let before = graph.inputs();
    let made = adjoined(&graph, &[slope], before, &roles(&draws, coordinates.positions))?;
    let (graph, slope) = match made {
        Some(own) => (own.graph, own.outputs[0]),
        // As numbers of their own, functions of the positions give a degree that is not too low.
        None => {
            let reached = graph.reached([slope]);
            let is_fixed = |place: usize| match graph.step(place) {
                Step::Unary(UnaryFunction::Sqrt, a) => !is_moving(&a),
                Step::Power(a, exponent) => exponent.to_integer().is_some() || !is_moving(&a),
                step => !has_function(step),
            };
            let is_fixed = (0..graph.len()).filter(|k| reached[*k]).all(is_fixed);
            match is_fixed.then(|| symbolised(&graph, &[vec![slope]])).flatten() {
                Some((graph, outputs)) => (graph, outputs[0][0]),
                None => (graph, slope),
            }
        }
    };
    // No constant of the formula can be chosen to vanish modulo the prime.
    let mut rng = SearchStream::Products.under(statement_seed(seed, &graph, &[slope]));
    let (tape, numbers) = (Tape::new(&graph, &[slope]), root_numbers(&graph));
    let mut degrees = (0..DEGREE_PRIMES).map(|_| {
        let modulus = rng.prime_for(&numbers);
        let mut evaluator = Evaluator::new(&tape, Prime::new([modulus; SLOPE_POINTS]));
        (0..TRIALS).find_map(|_| {
            let mut values: Vec<[u64; SLOPE_POINTS]> =
                (1..inputs).map(|_| [rng.element(&modulus); SLOPE_POINTS]).collect();
            values.push(std::array::from_fn(|s| modulus.integer(s as u64)));
            values.resize(before, [modulus.one(); SLOPE_POINTS]);
            // Functions of the positions are the same along the line.
            values.resize_with(graph.inputs(), || [rng.element(&modulus); SLOPE_POINTS]);
            evaluator.run(&values);
            let slopes = evaluator.output(0);
            (!slopes.contains(&UNDEFINED)).then(|| read.degree(slopes, &modulus))
        })?
    });
    let first = degrees.next().flatten();
    Ok(first.filter(|degree| degrees.all(|other| other == Some(*degree))))
}

/// Finds the degree of a polynomial whose logarithm has these slopes at 0, 1, 2, …, if there is
/// one.
fn polynomial_degree(slopes: &[u64], m: &Modulus) -> Option<u32> {
    let mut echelon = Echelon::new(MOST_DEGREE + 1, *m);
    for (s, slope) in slopes.iter().enumerate() {
        let s = m.integer(s as u64);
        // P' - P (ln F)', with the coefficients of P from the highest down
        let entry = |power: u64| {
            let slope_of_power = match power {
                0 => 0,
                _ => m.mul(m.integer(power), m.power(s, power - 1)),
            };
            m.sub(slope_of_power, m.mul(*slope, m.power(s, power)))
        };
        echelon.push((0..=MOST_DEGREE as u64).rev().map(entry).collect());
    }
    match &echelon.null_space()[..] {
        [only] => only.iter().rev().rposition(|entry| *entry != 0).map(|degree| degree as u32),
        _ => None,
    }
}

/// Finds the degree of a polynomial that has these slopes at 0, 1, 2, …, if there is one.
fn exponent_degree(slopes: &[u64], m: &Modulus) -> Option<u32> {
    let mut differences = slopes.to_vec();
    for degree in 0..=MOST_DEGREE as u32 {
        if differences.iter().all(|own| *own == 0) {
            return Some(degree);
        }
        differences = differences.windows(2).map(|pair| m.sub(pair[1], pair[0])).collect();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_counted() {
        let one = || Formula::number(1);
        let generators = Generators::of(vec![(one(), 2), (one(), 2), (one(), 1)]);
        // of E, F and G: E², EF, F², EG², FG², G⁴
        assert_eq!(generators.products(4, false), 6);
        assert_eq!(generators.exponents(4, false).len(), 6);
        assert_eq!(generators.exponents(2, true).len(), 5);
        // 1, G, and E, F, G²
        assert_eq!(generators.products(2, true), 5);
    }

    #[test]
    fn degrees_come_from_slopes_of_logarithms() {
        let m = SearchStream::Products.under(1).prime(&[3, 5], &[2, 3]);
        let of = |slope: &dyn Fn(u64) -> u64| {
            let slopes: Vec<u64> =
                (0..SLOPE_POINTS as u64).map(|s| slope(m.integer(s + 5))).collect();
            polynomial_degree(&slopes, &m)
        };
        let over = |a: u64, b: u64| m.mul(a, m.inverse(b));
        let cube = |s: u64| m.add(m.mul(s, m.mul(s, s)), m.integer(5));
        let slope = |s: u64| m.mul(m.integer(3), m.mul(s, s));
        assert_eq!(of(&|s| over(slope(s), cube(s))), Some(3), "s³ + 5");
        assert_eq!(of(&|_| 0), Some(0), "a constant");
        assert_eq!(of(&|s| over(m.integer(2), s)), Some(2), "s²");
        let twice = |s: u64| m.mul(m.integer(2), over(slope(s), cube(s)));
        assert_eq!(of(&twice), Some(6), "(s³ + 5)²");
        assert_eq!(of(&|s| over(m.one(), m.mul(m.integer(2), s))), None, "√s");
        assert_eq!(of(&|s| m.sub(0, over(m.one(), s))), None, "1/s");
        assert_eq!(of(&|s| m.sub(twice(s), over(m.one(), s))), None, "(s³ + 5)²/s");
        assert_eq!(of(&|_| m.one()), None, "exp s");
    }
    #[test]
    fn exponents_come_from_slopes() {
        let m = SearchStream::Products.under(1).prime(&[3, 5], &[2, 3]);
        let of = |slope: &dyn Fn(u64) -> u64| {
            let slopes: Vec<u64> =
                (0..SLOPE_POINTS as u64).map(|s| slope(m.integer(s + 5))).collect();
            exponent_degree(&slopes, &m)
        };
        assert_eq!(of(&|_| 0), Some(0), "a constant");
        assert_eq!(of(&|_| m.one()), Some(1), "s");
        assert_eq!(of(&|s| m.mul(s, m.mul(s, s))), Some(4), "s⁴/4");
        assert_eq!(of(&|s| m.inverse(s)), None, "ln s");
        assert_eq!(of(&|s| m.power(s, 20)), None, "of a high degree");
    }
}
