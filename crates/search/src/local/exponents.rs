//! Exponents of functions of the positions, as sums of rational multiples of a few.

use super::functions::{FunctionKind, FunctionStep, InputRole};
use crate::echelon::Echelon;
use crate::series::TruncatedSeries;
use crate::streams::SearchStream;
use liouville::graph::{Evaluator, Expr, Graph, Tape};
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::proof::{ProofRng, reconstruct, root_numbers, statement_seed};
use num_integer::Integer;

/// Number of points beyond the number of exponents.
const SPARE: usize = 12;
/// Number of points that are tried for each that is needed.
const TRIALS: usize = 256;
/// Largest multiple of an exponent.
const LARGEST: i64 = 24;

/// Multiples of the independent functions that make up another.
#[derive(Clone, Debug, Default)]
pub struct Multiples {
    /// Numbers of independent functions, with the powers to which they are raised.
    pub of_functions: Vec<(usize, i64)>,
    /// Power of the base, for a power.
    pub of_base: i64,
}

/// Functions of which all others are products of powers.
pub struct Exponents {
    /// Numbers of these functions; each is a power of what is adjoined, with this exponent.
    independent: Vec<(usize, i64)>,
    /// Each function by them.
    multiples: Vec<Multiples>,
}

/// Values at one random point.
struct SamplePoint {
    /// Value of each exponent, and its derivative along a random direction.
    exponents: Vec<[u64; 2]>,
    /// Derivative of the logarithm of each base.
    logarithms: Vec<u64>,
}

impl Exponents {
    /// Compares the exponents of functions; `None` if they depend on each other in another way.
    pub fn of(
        graph: &Graph,
        steps: &[FunctionStep],
        role: &dyn Fn(usize) -> InputRole,
    ) -> Option<Self> {
        let mut found =
            Self { independent: Vec::new(), multiples: vec![Multiples::default(); steps.len()] };
        for of_angles in [false, true] {
            let is_own =
                |number: &usize| (steps[*number].kind == FunctionKind::HalfAngle) == of_angles;
            let own: Vec<usize> = (0..steps.len()).filter(is_own).collect();
            if !own.is_empty() {
                let group = FunctionGroup::of(graph, steps, own);
                group.compare(&|input| role(input) == InputRole::Position, &mut found)?;
            }
        }
        Some(found)
    }

    /// Numbers of the functions that are adjoined, and the number by which each exponent is divided.
    pub fn independent(&self) -> &[(usize, i64)] {
        &self.independent
    }

    /// A function by those that are adjoined.
    pub fn multiples(&self, number: usize) -> &Multiples {
        &self.multiples[number]
    }
}

/// A function as a product of powers of others and of its base.
struct FoundRelation {
    function: usize,
    terms: Vec<(usize, Rational)>,
    of_base: i64,
}

/// Functions that are compared with each other: exponentials and powers, or angles.
struct FunctionGroup<'g> {
    graph: &'g Graph,
    steps: &'g [FunctionStep],
    /// Numbers of the functions.
    own: Vec<usize>,
    /// Places of the bases of powers.
    bases: Vec<usize>,
}

impl<'g> FunctionGroup<'g> {
    fn of(graph: &'g Graph, steps: &'g [FunctionStep], own: Vec<usize>) -> Self {
        let mut bases: Vec<usize> = own
            .iter()
            .filter_map(|number| match steps[*number].kind {
                FunctionKind::Power(base) => Some(base),
                FunctionKind::Exponential | FunctionKind::HalfAngle => None,
            })
            .collect();
        bases.sort_unstable();
        bases.dedup();
        Self { graph, steps, own, bases }
    }

    /// Finds the functions of which the others are products, from derivatives by some inputs.
    fn compare(&self, is_variable: &dyn Fn(usize) -> bool, found: &mut Exponents) -> Option<()> {
        let (points, modulus) = self.points(is_variable)?;
        let logarithms = self.bases.len();
        let mut echelon = Echelon::new(logarithms + self.own.len(), modulus);
        for point in &points {
            let exponents = self.own.iter().zip(&point.exponents).map(|(number, own)| {
                match self.base(*number) {
                    // c d ln b, where c is a constant.
                    Some(base) => modulus.mul(own[0], point.logarithms[base]),
                    None => own[1],
                }
            });
            echelon.push(point.logarithms.iter().copied().chain(exponents).collect());
        }
        if (0..logarithms).any(|column| !echelon.has_pivot(column)) {
            return None;
        }
        let is_independent = |k: usize| echelon.has_pivot(logarithms + k);
        let first = found.independent.len();
        let place = |k: usize| first + (0..k).filter(|k| is_independent(*k)).count();
        let mut relations: Vec<FoundRelation> = Vec::new();
        let mut divisors = vec![1i64; self.own.len()];
        for k in (0..self.own.len()).filter(|k| !is_independent(*k)) {
            let vector = echelon.null_vector(logarithms + k);
            let coefficient = |column: usize| -> Option<Rational> {
                reconstruct(modulus.sub(0, vector[column]), &modulus)
            };
            let (mut terms, mut of_base) = (Vec::new(), 0);
            for column in (0..logarithms + k).filter(|column| vector[*column] != 0) {
                let value = coefficient(column)?;
                if column < logarithms {
                    if self.base(self.own[k]) != Some(column) {
                        return None;
                    }
                    of_base = value.to_integer()?;
                } else {
                    let other = column - logarithms;
                    if self.base(self.own[k]) != self.base(self.own[other]) {
                        return None;
                    }
                    let below = i64::try_from(value.parts().1).ok();
                    let below = below.filter(|below| *below <= LARGEST)?;
                    divisors[other] = divisors[other].lcm(&below);
                    if divisors[other] > LARGEST {
                        return None;
                    }
                    terms.push((other, value));
                }
            }
            // Equal up to a constant is not enough.
            let is_equal = |point: &SamplePoint| {
                let each = terms.iter().try_fold(modulus.integer(0), |sum, (other, value)| {
                    Some(modulus.add(
                        sum,
                        modulus.mul(modulus.rational(value)?, point.exponents[*other][0]),
                    ))
                });
                let whole = modulus.rational(&Rational::from(of_base));
                each.zip(whole)
                    .is_some_and(|(sum, whole)| modulus.add(sum, whole) == point.exponents[k][0])
            };
            if !points.iter().all(is_equal) {
                return None;
            }
            relations.push(FoundRelation { function: k, terms, of_base });
        }
        for k in (0..self.own.len()).filter(|k| is_independent(*k)) {
            found.independent.push((self.own[k], divisors[k]));
            let own = Multiples { of_functions: vec![(place(k), divisors[k])], of_base: 0 };
            found.multiples[self.own[k]] = own;
        }
        for FoundRelation { function: k, terms, of_base } in relations {
            let times = |(other, value): (usize, Rational)| {
                let whole = (&value * &Rational::from(divisors[other])).to_integer()?;
                Some((place(other), whole))
            };
            let of_functions: Vec<(usize, i64)> =
                terms.into_iter().map(times).collect::<Option<_>>()?;
            found.multiples[self.own[k]] = Multiples { of_functions, of_base };
        }
        let sizes = found
            .multiples
            .iter()
            .flat_map(|own| own.of_functions.iter().map(|(_, times)| *times).chain([own.of_base]));
        sizes.into_iter().all(|times| times.abs() <= LARGEST).then_some(())
    }

    /// Number of the base of a function, if it is a power.
    fn base(&self, number: usize) -> Option<usize> {
        match self.steps[number].kind {
            FunctionKind::Power(base) => self.bases.iter().position(|own| *own == base),
            FunctionKind::Exponential | FunctionKind::HalfAngle => None,
        }
    }

    /// Draws points at which all exponents and bases have values.
    fn points(&self, is_variable: &dyn Fn(usize) -> bool) -> Option<(Vec<SamplePoint>, Modulus)> {
        let graph = self.graph;
        let exponents = self.own.iter().map(|number| self.steps[*number].argument);
        let outputs: Vec<Expr> =
            exponents.chain(self.bases.iter().copied()).map(|place| graph.at(place)).collect();
        let seed = statement_seed(0, graph, &outputs);
        let mut rng: ProofRng = SearchStream::Exponents.under(seed);
        let modulus = rng.prime_for(&root_numbers(graph));
        let series = TruncatedSeries::new(modulus, 1, 1);
        let tape = Tape::new(graph, &outputs);
        let mut evaluator = Evaluator::new(&tape, series.clone());
        let wanted = outputs.len() + SPARE;
        let mut found = Vec::with_capacity(wanted);
        for _ in 0..wanted * TRIALS {
            if found.len() == wanted {
                break;
            }
            let inputs: Vec<Vec<u64>> = (0..graph.inputs())
                .map(|input| {
                    let value = rng.element(&modulus);
                    let slope = if is_variable(input) { rng.element(&modulus) } else { 0 };
                    vec![value, slope]
                })
                .collect();
            evaluator.run(&inputs);
            let values: Vec<&Vec<u64>> = evaluator.outputs().collect();
            if values.iter().any(|value| value.is_empty()) {
                continue;
            }
            let (exponents, bases) = values.split_at(self.own.len());
            if bases.iter().any(|base| base[0] == 0) {
                continue;
            }
            found.push(SamplePoint {
                exponents: exponents.iter().map(|own| [own[0], own[1]]).collect(),
                logarithms: bases
                    .iter()
                    .map(|own| modulus.mul(own[1], modulus.inverse(own[0])))
                    .collect(),
            });
        }
        (found.len() == wanted).then_some((found, modulus))
    }
}
