//! Rules of logarithms and powers.
//!
//! ```text
//! ln X = (ln c + Σ n_j ln X_j)/n,  X^y = c^(y/n) Π X_j^(y n_j/n)  where X^n = c Π X_j^n_j
//! e^E = e^R Π X_j^Y_j                                            where E = R + Σ Y_j ln X_j
//! X^y = e^(y ln X)                                               where y contains logarithms
//! ```
//!
//! The X_j are arguments of logarithms, bases of powers, powers or exponentials, so they are positive
//! wherever all values exist, and the rules hold there. The exponents n_j/n come from linear
//! relations between the logarithmic derivatives dX/X along one direction. Each relation X^n = c Π
//! X_j^n_j, and each sum E, is proved as an identity.

use num_integer::lcm;

use crate::graph::{Expr, Graph, Step};
use crate::number::BinaryOperation::Pow;
use crate::number::UnaryFunction::{Exp, Ln};
use crate::number::{prime::Modulus, rational::Rational};
use crate::scalar::Scalar;

use super::bounds::InputDistribution;
use super::digest::SeedDigest;
use super::elimination::reduce;
use super::lower::Algebraic;
use super::powers::{Logarithm, sum};
use super::reconstruct::reconstruct;
use super::relations::{Defect, MOST_VALUES, SPARE_ROWS, prime_for, rows};
use super::rewrite::Rewrite;
use super::rng::{ProofRng, ProofStream};
use super::trial::{Certificate, both};

/// Largest power n of a relation, and largest exponent in it.
const LARGEST_POWER: i64 = 24;
/// Largest number of exponentials that are split, and of logarithms in one exponent.
const MOST_SPLIT: usize = 16;

/// A search for rules that apply to a computation.
pub struct Rules<'r> {
    /// Graph of the computation.
    pub graph: &'r Graph,
    /// The same graph, lowered.
    pub algebraic: &'r Algebraic<'r>,
    /// Distributions of the inputs.
    pub sources: &'r [InputDistribution],
    /// Digest of the statement to be proved.
    pub digest: SeedDigest,
}

/// Places with the multiples of their logarithms.
type Terms = Vec<(usize, Rational)>;

/// Rewritings with the bound on the probability that one of them is wrong.
type Found = (Vec<Rewrite>, Option<Certificate>);

impl Rules<'_> {
    /// Finds the rules that simplify what some values need.
    pub fn find(&self, values: &[Expr]) -> Found {
        let reached = self.graph.reached(values.iter().copied());
        let (mut arguments, mut exponents, mut powers) = (Vec::new(), Vec::new(), Vec::new());
        for (place, step) in self.graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
            match step {
                Step::Unary(Ln, a) => arguments.push(a),
                Step::Binary(Pow, a, _) => {
                    arguments.push(a);
                    powers.push(place);
                }
                Step::Unary(Exp, a) => {
                    exponents.push(a);
                    powers.push(place);
                }
                _ => {}
            }
        }
        if arguments.is_empty() {
            return Found::default();
        }
        arguments.sort_unstable();
        arguments.dedup();
        let mut found = self.of_exponents(&exponents);
        if found.0.is_empty() {
            found.0 = self.of_powers(&powers);
        }
        if found.0.is_empty() {
            found = self.of_arguments(&arguments, powers);
        }
        found
    }

    /// Makes exponentials of powers x^y whose exponents contain logarithms: z^(ln w) and
    /// w^(ln z) are then the same.
    fn of_powers(&self, powers: &[usize]) -> Vec<Rewrite> {
        let is_logarithmic = |place: &usize| match self.graph.step(*place) {
            Step::Binary(Pow, _, y) => !self.outer_logarithms(y).is_empty(),
            _ => false,
        };
        let places: Vec<usize> = powers.iter().copied().filter(is_logarithmic).collect();
        if places.is_empty() { Vec::new() } else { vec![Rewrite::Power { places }] }
    }

    /// Splits exponentials of sums with logarithms.
    fn of_exponents(&self, exponents: &[usize]) -> Found {
        let mut found = Found::default();
        for exponent in exponents.iter().take(MOST_SPLIT) {
            let logarithms = self.outer_logarithms(*exponent);
            if logarithms.is_empty() || logarithms.len() > MOST_SPLIT {
                continue;
            }
            let places: Vec<usize> = std::iter::once(*exponent).chain(logarithms.clone()).collect();
            let reached = self.graph.reached_from(&places);
            let all: Vec<usize> = (0..reached.len()).filter(|place| reached[*place]).collect();
            let defect = |values: &[Option<Expr>]| {
                let (rest, factors) = sum(self.graph, *exponent, &logarithms, values)?;
                let mut defect = values[*exponent]? - rest;
                for (place, factor) in logarithms.iter().zip(factors) {
                    defect -= factor * values[*place]?;
                }
                Some(vec![defect])
            };
            if let Some(own) = self.test(false).vanishing(&all, &defect) {
                found.0.push(Rewrite::Exponential { argument: *exponent, logarithms });
                found.1 = both(found.1, Some(own));
            }
        }
        found
    }

    /// Lists the logarithms that a value contains, but not those inside logarithms.
    fn outer_logarithms(&self, place: usize) -> Vec<usize> {
        let mut is_needed = vec![false; place + 1];
        is_needed[place] = true;
        let mut logarithms = Vec::new();
        for at in (0..=place).rev() {
            match self.graph.step(at) {
                _ if !is_needed[at] => {}
                Step::Unary(Ln, _) => logarithms.push(at),
                step => step.arguments().for_each(|argument| is_needed[argument] = true),
            }
        }
        logarithms.reverse();
        logarithms
    }

    /// Expresses arguments of logarithms and powers by products of powers of others, of
    /// exponentials and of `powers` x^y.
    fn of_arguments(&self, arguments: &[usize], powers: Vec<usize>) -> Found {
        let mut found = Found::default();
        let mut candidates = powers;
        for argument in arguments {
            match self.graph.step(*argument) {
                Step::Constant(number) => {
                    let numbers = factors(number).filter(|numbers| !is_prime(numbers));
                    found.0.extend(numbers.map(|numbers| Rewrite::Logarithm {
                        argument: *argument,
                        logarithm: Logarithm { numbers, terms: Vec::new() },
                    }));
                }
                _ if self.algebraic.values[*argument].is_some() => candidates.push(*argument),
                _ => {}
            }
        }
        candidates.sort_unstable();
        candidates.dedup();
        candidates.retain(|place| self.algebraic.values[*place].is_some());
        if candidates.is_empty() || candidates.len() > MOST_VALUES {
            return found;
        }
        for (place, terms) in self.products(&candidates).unwrap_or_default() {
            if !arguments.contains(&place) {
                continue;
            }
            if let Some((logarithm, own)) = self.proved(place, terms) {
                found.0.push(Rewrite::Logarithm { argument: place, logarithm });
                found.1 = both(found.1, own);
            }
        }
        found
    }

    /// Lists values that seem to be products of powers of values before them, up to a number; and
    /// the exponentials and powers x^y among the others.
    fn products(&self, places: &[usize]) -> Option<Vec<(usize, Terms)>> {
        let extended = self.algebraic.with_inputs(|inputs, at| {
            let values: Option<Vec<Expr>> =
                places.iter().map(|place| at(self.algebraic.values[*place]?)).collect();
            let values = values?;
            let is_free =
                |(_, source): &(&Expr, &InputDistribution)| **source != InputDistribution::Sign;
            let all = inputs.iter().zip(&self.algebraic.sources);
            let variables: Vec<Expr> = all.filter(is_free).map(|(input, _)| *input).collect();
            // A direction without a special relation to any formula.
            let direction = (1..=variables.len() as u64).map(|k| {
                let component = k.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 40;
                Expr::rational(&Rational::from(component as i64 + 1))
            });
            let direction: Vec<Expr> = direction.collect();
            let slopes = Expr::derivatives_along(&values, &variables, &direction)?;
            Some(slopes.into_iter().zip(values).map(|(slope, value)| slope / value).collect())
        });
        let (extended, slopes) = extended.ok()??;
        let (modulus, mut rng) = self.field(&extended);
        let count = places.len() + SPARE_ROWS;
        let rows = rows(&extended, &slopes, false, count, &modulus, &mut rng)?;
        let (pivots, rows) = reduce(rows, places.len(), &modulus);
        let mut products = Vec::new();
        for (column, place) in places.iter().enumerate() {
            if pivots.contains(&column) {
                let step = self.graph.step(*place);
                if matches!(step, Step::Unary(Exp, _) | Step::Binary(Pow, ..)) {
                    products.push((*place, vec![(*place, Rational::from(1))]));
                }
                continue;
            }
            let term = |(pivot, row): (&usize, &Vec<u64>)| {
                Some((places[*pivot], reconstruct(row[column], &modulus)?))
            };
            let terms: Option<Vec<(usize, Rational)>> =
                pivots.iter().zip(&rows).map(term).collect();
            if let Some(terms) = terms {
                let terms = terms.into_iter().filter(|(_, multiple)| !multiple.is_zero());
                products.push((*place, terms.collect()));
            }
        }
        Some(products)
    }

    fn test(&self, is_related: bool) -> Defect<'_> {
        Defect { graph: self.graph, sources: self.sources, digest: self.digest, is_related }
    }

    fn field(&self, algebraic: &Algebraic<'_>) -> (Modulus, ProofRng) {
        let mut rng = ProofRng::of(self.digest, ProofStream::Logarithms);
        (prime_for(algebraic, &mut rng), rng)
    }

    /// Proves X^n = c Π X_j^n_j.
    fn proved(&self, place: usize, terms: Terms) -> Option<(Logarithm, Option<Certificate>)> {
        if terms == [(place, Rational::from(1))] {
            return Some((Logarithm { numbers: Vec::new(), terms }, None));
        }
        let mut least = 1i64;
        for (_, multiple) in &terms {
            let (_, below) = multiple.small_parts()?;
            least = lcm(least, below);
        }
        // c may be √2, but not c².
        [least, 2 * least].into_iter().find_map(|n| {
            let power = |multiple: &Rational| (multiple * &Rational::from(n)).to_integer();
            let powers: Option<Vec<(usize, i64)>> =
                terms.iter().map(|(at, multiple)| Some((*at, power(multiple)?))).collect();
            let powers = powers?;
            let is_small = powers.iter().all(|(_, power)| power.abs() <= LARGEST_POWER);
            if n > LARGEST_POWER || !is_small {
                return None;
            }
            let number = self.constant(place, n, &powers)?;
            let numbers = factors(&number)?;
            let places: Vec<usize> =
                std::iter::once(place).chain(powers.iter().map(|(at, _)| *at)).collect();
            let defect = |values: &[Option<Expr>]| {
                let mut product = Expr::rational(&number);
                for (at, power) in &powers {
                    product *= values[*at]?.power(&Rational::from(*power));
                }
                Some(vec![values[place]?.power(&Rational::from(n)) - product])
            };
            let own = self.test(true).vanishing(&places, &defect)?;
            let part = Rational::new(1, n);
            let numbers = numbers.into_iter().map(|(p, e)| (p, &e * &part)).collect();
            Some((Logarithm { numbers, terms: terms.clone() }, Some(own)))
        })
    }

    /// Finds the positive number c with X^n = c Π X_j^n_j at a few points.
    fn constant(&self, place: usize, n: i64, powers: &[(usize, i64)]) -> Option<Rational> {
        let ratio = self.algebraic.with_inputs(|_, at| {
            let value = |place: usize| at(self.algebraic.values[place]?);
            let mut ratio = value(place)?.power(&Rational::from(n));
            for (at, power) in powers {
                ratio *= value(*at)?.power(&Rational::from(-power));
            }
            Some(vec![ratio])
        });
        let (extended, ratio) = ratio.ok()??;
        let (modulus, mut rng) = self.field(&extended);
        let rows = rows(&extended, &ratio, false, 2, &modulus, &mut rng)?;
        let (real, imaginary): (Vec<_>, Vec<_>) =
            rows.chunks(2).map(|point| (point[0][0], point[1][0])).unzip();
        let is_same = real.iter().all(|value| *value == real[0]);
        let number = reconstruct(*real.first()?, &modulus)?;
        let is_number = is_same && imaginary.iter().all(|value| *value == 0);
        (is_number && !number.is_negative() && !number.is_zero()).then_some(number)
    }
}

/// Factors a positive number with small parts into powers of primes; `None` for others.
fn factors(number: &Rational) -> Option<Vec<(i64, Rational)>> {
    let (above, below) = number.small_parts()?;
    if above <= 0 || above.max(below) > 1 << 40 {
        return None;
    }
    let mut factors = Vec::new();
    for (mut rest, sign) in [(above, 1), (below, -1)] {
        let mut divisor = 2;
        while rest > 1 {
            if divisor * divisor > rest {
                divisor = rest;
            }
            let mut exponent = 0;
            while rest % divisor == 0 {
                rest /= divisor;
                exponent += sign;
            }
            if exponent != 0 {
                factors.push((divisor, Rational::from(exponent)));
            }
            divisor += 1;
        }
    }
    Some(factors)
}

/// Whether a factored number is a prime.
fn is_prime(factors: &[(i64, Rational)]) -> bool {
    matches!(factors, [(_, exponent)] if *exponent == Rational::from(1))
}
