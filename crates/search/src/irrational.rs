//! Roots with irrational numbers under them that no relation binds to others, so that any signs of them
//! are as good as those at real states.
//!
//! Roots r of numbers n, of numbers a made of these, and of functions f make an algebra in which r² = n and
//! so on. If it is a field, the values modulo a prime are images of the real ones, whatever signs the
//! roots have. It is one if no product of some n, some a or some f is a square, for the f even up to a
//! number. A product that is a square has no character −1, and one that is a square up to a number has
//! the same character at all points.

use liouville::graph::{Evaluator, Expr, Graph, Step, Tape};
use liouville::mechanics::Draw;
use liouville::number::UnaryFunction;
use liouville::number::prime::{Modulus, Prime, UNDEFINED};
use liouville::number::rational::Rational;
use liouville::proof::{ProofRng, root_numbers};

use super::streams::SearchStream;

/// Largest number of roots of each kind.
const MOST: usize = 40;
/// Number of characters beyond the number of roots.
const SPARE: usize = 20;
/// Number of points or primes that are tried for each character.
const TRIES: usize = 16;

/// Radicands of some formulas.
#[derive(Default)]
struct Radicands {
    /// Rational numbers.
    rational: Vec<Rational>,
    /// Numbers with roots.
    irrational: Vec<Expr>,
    /// Functions without roots of functions.
    functions: Vec<Expr>,
}

/// Whether no irrational number stands under a root or a modulus. The root of (1 + √2)² y is
/// (1 + √2) √y, and modulo a prime it may be −(1 + √2) √y at every point.
pub fn is_absent(graph: &Graph, outputs: &[Expr]) -> bool {
    let reached = graph.reached(outputs.iter().copied());
    let mut is_number = vec![false; reached.len()];
    let mut is_irrational = vec![false; reached.len()];
    for (place, step) in graph.steps_at(&reached) {
        let is_root = !step.is_rational();
        is_irrational[place] = step.arguments().any(|argument| is_irrational[argument]);
        if is_root && is_irrational[place] {
            return false;
        }
        is_number[place] =
            !matches!(step, Step::Input(_)) && step.arguments().all(|k| is_number[k]);
        is_irrational[place] |= is_root && is_number[place];
    }
    true
}

/// Whether all steps of some formulas are rational but for square roots of which none depends on
/// others. `draws` are those of the inputs.
pub fn is_independent(graph: &Graph, outputs: &[Expr], draws: &[Draw], seed: u64) -> bool {
    let is_single = |draw: &Draw| match draw {
        Draw::Within(_) | Draw::Of(..) => true,
        Draw::OneOf(values) => values.len() == 1,
        Draw::Sign => false,
    };
    let Some(radicands) = Radicands::of(graph, outputs) else { return false };
    let Radicands { rational, irrational, functions, .. } = &radicands;
    let most = rational.len().max(irrational.len()).max(functions.len());
    if most > MOST || !draws.iter().all(is_single) {
        return false;
    }
    let mut rng = SearchStream::Relations.under(seed.wrapping_add(77));
    let numbers = root_numbers(graph);
    rational_are_independent(rational, &mut rng)
        && irrational_are_independent(graph, irrational, &numbers, &mut rng)
        && functions_are_independent(graph, functions, &numbers, draws, &mut rng)
}

impl Radicands {
    /// Lists them; `None` where there are other functions, roots of other orders, or roots of functions
    /// inside of roots.
    fn of(graph: &Graph, outputs: &[Expr]) -> Option<Self> {
        let reached = graph.reached(outputs.iter().copied());
        let mut is_number = vec![false; reached.len()];
        let mut has_root_of_function = vec![false; reached.len()];
        // Number of roots of numbers inside of each other.
        let mut depth = vec![0usize; reached.len()];
        let mut known: Vec<usize> = Vec::new();
        let mut found = Self::default();
        for (place, step) in graph.steps_at(&reached) {
            is_number[place] =
                !matches!(step, Step::Input(_)) && step.arguments().all(|k| is_number[k]);
            has_root_of_function[place] = step.arguments().any(|k| has_root_of_function[k]);
            depth[place] = step.arguments().map(|k| depth[k]).max().unwrap_or(0);
            if step.is_rational() {
                continue;
            }
            let argument = match step {
                Step::Unary(UnaryFunction::Sqrt, argument) => argument,
                Step::Power(argument, exponent) if exponent.parts().1 == 2.into() => argument,
                _ => return None,
            };
            let is_new = !known.contains(&argument);
            known.push(argument);
            let own = graph.at(argument);
            match (is_number[argument], depth[argument]) {
                (true, 0) => {
                    let value = graph.constant_value(own)?.clone();
                    found.rational.extend(Some(value).filter(|_| is_new));
                }
                (true, 1) => found.irrational.extend(Some(own).filter(|_| is_new)),
                (true, _) => return None,
                (false, _) if has_root_of_function[argument] => return None,
                (false, _) => found.functions.extend(Some(own).filter(|_| is_new)),
            }
            match is_number[place] {
                true => depth[place] += 1,
                false => has_root_of_function[place] = true,
            }
        }
        Some(found)
    }
}

/// Vectors of characters over the field of two elements, one for each radicand.
struct CharacterMatrix(Vec<u128>);

impl CharacterMatrix {
    fn new(count: usize) -> Self {
        Self(vec![0; count])
    }

    /// Adds a column: whether each radicand is a square.
    fn push(&mut self, are_squares: impl Iterator<Item = bool>) {
        for (row, is_square) in self.0.iter_mut().zip(are_squares) {
            *row = *row << 1 | u128::from(!is_square);
        }
    }

    /// Whether no sum of some rows is 0, or, with `offset`, a further row.
    fn is_independent(&self, offset: Option<u128>) -> bool {
        let mut basis: Vec<u128> = Vec::new();
        for row in offset.iter().chain(&self.0) {
            let reduced = basis.iter().fold(*row, |own, other| own.min(own ^ other));
            if reduced == 0 {
                return false;
            }
            basis.push(reduced);
            basis.sort_unstable_by(|a, b| b.cmp(a));
        }
        true
    }
}

/// Whether no product of some numbers is the square of a rational number.
fn rational_are_independent(numbers: &[Rational], rng: &mut ProofRng) -> bool {
    let mut matrix = CharacterMatrix::new(numbers.len());
    for _ in 0..if numbers.is_empty() { 0 } else { numbers.len() + SPARE } {
        let m = rng.prime(&[], &[]);
        let images: Option<Vec<u64>> = numbers.iter().map(|own| m.rational(own)).collect();
        let Some(images) = images.filter(|all| !all.contains(&0)) else { continue };
        matrix.push(images.iter().map(|own| m.is_square(*own)));
    }
    matrix.is_independent(None)
}

/// Values of expressions at one point; `None` where one is 0 or has no value.
fn values(tape: &Tape, m: Modulus, inputs: &[u64]) -> Option<Vec<u64>> {
    let mut evaluator = Evaluator::new(tape, Prime::new([m]));
    let inputs: Vec<[u64; 1]> = inputs.iter().map(|x| [*x]).collect();
    evaluator.run(&inputs);
    let values: Vec<u64> = evaluator.outputs().map(|[value]| *value).collect();
    (!values.contains(&UNDEFINED) && !values.contains(&0)).then_some(values)
}

/// Whether no product of some numbers is a square in the field of the roots of rational ones.
fn irrational_are_independent(
    graph: &Graph,
    radicands: &[Expr],
    numbers: &[Rational],
    rng: &mut ProofRng,
) -> bool {
    if radicands.is_empty() {
        return true;
    }
    let tape = Tape::new(graph, radicands);
    let mut matrix = CharacterMatrix::new(radicands.len());
    let (mut count, wanted) = (0, radicands.len() + SPARE);
    for _ in 0..TRIES * wanted {
        if count == wanted {
            break;
        }
        let m = rng.prime_for(numbers);
        let Some(values) = values(&tape, m, &vec![m.one(); tape.inputs()]) else { continue };
        matrix.push(values.iter().map(|own| m.is_square(*own)));
        count += 1;
    }
    matrix.is_independent(None)
}

/// Whether no product of some functions is a square up to a number.
fn functions_are_independent(
    graph: &Graph,
    radicands: &[Expr],
    numbers: &[Rational],
    draws: &[Draw],
    rng: &mut ProofRng,
) -> bool {
    if radicands.is_empty() {
        return true;
    }
    let tape = Tape::new(graph, radicands);
    let wanted = radicands.len() + SPARE;
    // The roots of some numbers do not exist modulo some primes.
    for _ in 0..TRIES {
        let m = rng.prime_for(numbers);
        let mut matrix = CharacterMatrix::new(radicands.len());
        let mut count = 0;
        for _ in 0..TRIES * wanted {
            if count == wanted {
                break;
            }
            let input = |place: usize, rng: &mut ProofRng| match draws.get(place) {
                Some(Draw::OneOf(values)) => values.first().and_then(|own| m.rational(own)),
                _ => Some(rng.element(&m)),
            };
            let inputs: Option<Vec<u64>> =
                (0..tape.inputs()).map(|place| input(place, rng)).collect();
            let Some(values) = inputs.and_then(|own| values(&tape, m, &own)) else { continue };
            matrix.push(values.iter().map(|own| m.is_square(*own)));
            count += 1;
        }
        if count == wanted {
            return matrix.is_independent(Some((1 << count) - 1));
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use liouville::graph::record;

    /// Whether the root of a formula of x and y is independent of other roots in it.
    fn asked(build: impl FnOnce(&[Expr]) -> Vec<Expr>) -> [bool; 2] {
        let (graph, outputs) = record(2, |inputs| build(inputs)).expect("records");
        let independent = (1..=3).map(|seed| is_independent(&graph, &outputs, &[], seed));
        let independent: Vec<bool> = independent.collect();
        assert!(independent.iter().all(|own| *own == independent[0]), "{independent:?}");
        [is_absent(&graph, &outputs), independent[0]]
    }

    fn number(value: i64) -> Expr {
        use liouville::scalar::Scalar;
        Expr::rational(&Rational::from(value))
    }

    #[test]
    fn roots_that_differ_by_a_number_depend_on_each_other() {
        let two = || number(2).sqrt();
        assert_eq!(asked(|v| vec![(two() * v[0]).sqrt()]), [false, true]);
        assert_eq!(asked(|v| vec![(two() * v[0]).sqrt(), v[1].sqrt()]), [false, true]);
        assert_eq!(asked(|v| vec![(two() * v[0]).sqrt(), v[0].sqrt()]), [false, false]);
        let squared = || (number(1) + two()) * (number(1) + two());
        assert!(!asked(|v| vec![(squared() * v[0]).sqrt(), v[0].sqrt()])[1]);
        assert_eq!(
            asked(|v| vec![(two() * v[0]).sqrt(), (v[0] * v[1]).sqrt(), v[1].sqrt()]),
            [false, false],
            "the product is a square up to a number"
        );
        assert_eq!(asked(|v| vec![(v[0] * v[0] * two()).sqrt()]), [false, false]);
        assert!(!asked(|v| vec![((v[0] + two()).sqrt() + v[1]).sqrt()])[1], "nested");
        assert!(!asked(|v| vec![(two() * v[0]).sqrt().exp()])[1], "other functions");
    }

    #[test]
    fn numbers_under_roots_of_numbers_are_no_squares() {
        let two = || number(2).sqrt();
        let nested = |own: i64| (number(own) + two()).sqrt();
        assert_eq!(asked(|v| vec![nested(1) * v[0]]), [false, true]);
        // √(2 + √2) √(2 − √2) = √2.
        let other = || (number(2) - two()).sqrt();
        assert_eq!(asked(|_| vec![nested(2), other()]), [false, false]);
        assert_eq!(asked(|v| vec![nested(2) * v[0], nested(3)]), [false, true]);
        // Inside of a further root nothing is asked.
        assert_eq!(asked(|_| vec![(number(1) + nested(1)).sqrt()]), [false, false]);
    }
}
