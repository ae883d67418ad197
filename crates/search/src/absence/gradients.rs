//! Gradients of integrals on the level, at random points modulo primes.

use num_dual::Dual;

use liouville::case::Case;
use liouville::formula::Formula;
use liouville::graph::{Evaluator, Expr, Tape, record};
use liouville::mechanics::{Draw, Phase};
use liouville::number::prime::{Modulus, Prime, UNDEFINED};
use liouville::number::rational::Rational;
use liouville::proof::{ProofRng, root_numbers, statement_seed};

use super::super::SearchError;
use super::super::local::functions::{adjoined, roles};
use super::super::local::{Coordinates, random};
use super::super::products::DEGREE_PRIMES;
use super::known::has_lists;
use crate::echelon::Echelon;
use crate::streams::SearchStream;

/// Number of points at which gradients are taken.
pub const SCALES: usize = 32;
/// Number of points to try, since roots exist at some only.
const TRIALS: usize = 64;

/// Gradients of some formulas along coordinates of the level, or along the state where there is no level.
pub struct Gradients {
    tape: Tape,
    inputs: usize,
    /// Number of the last inputs that stand for functions of the positions.
    functions: usize,
    draws: Vec<Draw>,
    dimension: usize,
    count: usize,
    rng: ProofRng,
    /// Numbers that are squares modulo primes.
    numbers: Vec<Rational>,
}

/// Points at which gradients are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Points {
    /// One.
    One,
    /// The multiples 1, 2, 3, … of one.
    Multiples,
    /// Equidistant points of a line that misses the origin.
    Line,
}

/// Derivatives of each formula along each coordinate, at several points.
pub type Slopes = Vec<Vec<[u64; SCALES]>>;

impl Gradients {
    /// Records the gradients; `None` on a level without coordinates, and with lists of parameters: what
    /// depends for each value of a list may be independent for the first.
    pub fn of(case: &Case, formulas: &[Formula], seed: u64) -> Result<Option<Self>, SearchError> {
        let (model, draws) = (&case.model, case.model.parameter_draws());
        let coordinates = Coordinates::of(case).ok();
        let has_signs = draws.iter().any(|draw| matches!(draw, Draw::Sign));
        if has_lists(case) || has_signs || coordinates.is_none() && !model.level.is_empty() {
            return Ok(None);
        }
        let dimension = coordinates.as_ref().map_or(model.dimension(), |own| own.count());
        let slopes = |inputs: &[Expr]| {
            let (given, place) = inputs.split_at(draws.len());
            let parameters = match &coordinates {
                Some(coordinates) => coordinates.parameters(model, given),
                None => model.make_parameters(given).0,
            };
            let parameters: Vec<Dual<Expr>> =
                parameters.iter().map(|p| Dual::from_re(*p)).collect();
            let along = |direction: usize| -> Vec<Expr> {
                let mut place: Vec<Dual<Expr>> = place.iter().map(|x| Dual::from_re(*x)).collect();
                place[direction] = place[direction].derivative();
                let state = match &coordinates {
                    Some(coordinates) => coordinates.state(model, &parameters, &place),
                    None => place,
                };
                let phase = Phase::new(model, &parameters, &state);
                formulas.iter().map(|formula| phase.scalar(formula).eps).collect()
            };
            (0..dimension).map(along).collect::<Vec<_>>().concat()
        };
        let inputs = draws.len() + dimension;
        let (graph, slopes) = match &coordinates {
            Some(coordinates) => coordinates.record(inputs, slopes)?,
            None => record(inputs, slopes)?,
        };
        let positions = coordinates.as_ref().map_or(0, |own| own.positions);
        let before = graph.inputs();
        let made = adjoined(&graph, &slopes, before, &roles(&draws, positions))?;
        let (graph, slopes) = made.map_or((graph, slopes), |own| (own.graph, own.outputs));
        let functions = graph.inputs() - before;
        let rng = SearchStream::Gradients.under(statement_seed(seed, &graph, &slopes));
        let (tape, inputs) = (Tape::new(&graph, &slopes), graph.inputs());
        let (count, numbers) = (formulas.len(), root_numbers(&graph));
        Ok(Some(Self { tape, inputs, functions, draws, dimension, count, rng, numbers }))
    }

    /// Gradients at random points modulo the next prime; `None` if none has values.
    pub fn next(&mut self, points: Points) -> Option<(Slopes, Modulus)> {
        // At points of a line the values of functions are related.
        if points != Points::One && self.functions > 0 {
            return None;
        }
        let modulus = self.rng.prime_for(&self.numbers);
        let mut evaluator = Evaluator::new(&self.tape, Prime::new([modulus; SCALES]));
        for _ in 0..TRIALS {
            let rng = &mut self.rng;
            let given = random(&self.draws, &modulus, rng).into_iter();
            let mut values: Vec<[u64; SCALES]> = given.map(|x| [x; SCALES]).collect();
            values.extend((0..self.dimension).map(|_| {
                let x = rng.element(&modulus);
                let multiples =
                    std::array::from_fn(|k| modulus.mul(modulus.integer(k as u64 + 1), x));
                match points {
                    Points::One => [x; SCALES],
                    Points::Multiples => multiples,
                    Points::Line => {
                        let start = rng.element(&modulus);
                        multiples.map(|own| modulus.add(start, own))
                    }
                }
            }));
            values.resize(self.inputs - self.functions, [modulus.one(); SCALES]);
            values.extend((0..self.functions).map(|_| [rng.element(&modulus); SCALES]));
            evaluator.run(&values);
            let slopes: Vec<[u64; SCALES]> = evaluator.outputs().copied().collect();
            if slopes.iter().all(|own| !own.contains(&UNDEFINED)) {
                let of = |function: usize| {
                    slopes.iter().skip(function).step_by(self.count.max(1)).copied().collect()
                };
                return Some(((0..self.count).map(of).collect(), modulus));
            }
        }
        None
    }
}

/// Whether a formula is no function of others: its gradient is independent of theirs.
///
/// The rank of all gradients at a point is a lower bound. That of the others at a random point is their
/// rank almost everywhere, but with a probability below 2⁻⁵⁰ for each of the primes, which must agree.
pub fn is_new(
    case: &Case,
    others: &[Formula],
    formula: &Formula,
    seed: u64,
) -> Result<bool, SearchError> {
    let all: Vec<Formula> = others.iter().chain([formula]).cloned().collect();
    let Some(mut gradients) = Gradients::of(case, &all, seed)? else { return Ok(false) };
    let mut ranks = Vec::new();
    for _ in 0..DEGREE_PRIMES {
        let Some((slopes, m)) = gradients.next(Points::One) else { return Ok(false) };
        let mut echelon = Echelon::new(gradients.dimension, m);
        let is_kept: Vec<bool> = slopes
            .iter()
            .map(|own| echelon.push(own.iter().map(|values| values[0]).collect()))
            .collect();
        if is_kept.last() != Some(&true) {
            return Ok(false);
        }
        ranks.push(is_kept.iter().filter(|kept| **kept).count());
    }
    Ok(ranks.windows(2).all(|pair| pair[0] == pair[1]))
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// A turn of x and y with a parameter, and formulas in its names.
    pub struct Turn(pub Case);

    impl Turn {
        /// The parameter as a file gives it.
        pub fn with(parameter: &str) -> Self {
            let text = format!(
                "title = 'a'\n[parameters]\na = '{parameter}'\n[state]\nx = '-1..1'\ny = '-1..1'\n\
                 z = '-1..1'\n[field]\n\"x'\" = 'a*y'\n\"y'\" = '-a*x'\n\"z'\" = '0'\n"
            );
            Self(Case::parse(&text, &[]).expect("a case"))
        }

        /// Reads formulas.
        pub fn read(&self, texts: &[&str]) -> Vec<Formula> {
            let read = |text: &&str| Formula::parse(text, &self.0.model.vocabulary);
            texts.iter().map(|text| read(text).expect("a formula")).collect()
        }
    }

    #[test]
    fn a_function_of_others_is_not_new() {
        let new = |parameter: &str, others: &[&str], own: &str| {
            let turn = Turn::with(parameter);
            let (others, own) = (turn.read(others), turn.read(&[own]));
            is_new(&turn.0, &others, &own[0], 1).expect("an answer")
        };
        let range = "1..2";
        assert!(new(range, &[], "x^2 + y^2"));
        assert!(!new(range, &[], "a"), "a constant");
        let twice = ["x^2 + y^2", "2*(x^2 + y^2)"];
        assert!(new(range, &twice, "z"), "the others may depend on each other");
        assert!(!new(range, &["x^2 + y^2", "z"], "(x^2 + y^2)^2/(1 + a*z)"));
        assert!(!new(range, &["x^2 + y^2 + z", "z"], "x^2 + y^2"));
        assert!(!new(range, &[], "exp(z)"), "no value modulo a prime");
        let by_value = "x^2 + y^2 + (a - 1)*(a - 2)*z";
        assert!(new(range, &["x^2 + y^2"], by_value));
        assert!(!new("one of 1, 2", &["x^2 + y^2"], by_value), "a function at each value");
        assert!(!new("one of 2", &["x^2 + y^2"], by_value), "a function at its only value");
    }
}
