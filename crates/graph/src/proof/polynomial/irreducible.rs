//! Factors over the rational numbers of polynomials in several variables.
//!
//! The polynomial is taken at a point of all variables but one, where it has factors by `whole`. Products
//! of these are lifted; a lifted factor is one if it divides the polynomial.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

use crate::number::rational::Rational;
use crate::order::StableOrder;
use crate::proof::rng::{ProofRng, ProofStream};

use super::lifting::Lifting;
use super::modular::{Coefficients, product};
use super::whole::{irreducible_factors, primitive};
use super::{MOST_WORK, Polynomial};

/// Number of points that are tried, and of those at which factors are compared.
const MOST_POINTS: u64 = 24;
const COMPARED: usize = 3;
/// Largest number of factors at a point.
const MOST_FACTORS: usize = 8;
/// Coordinates of points; the further ones come later.
const COORDINATES: [i64; 8] = [0, 1, -1, 2, 0, -2, 3, 5];
/// Largest degree of a term.
const MOST_DEGREE: u32 = 16;

/// Factors at a point.
struct Start {
    main: u32,
    point: Vec<(u32, i64)>,
    factors: Vec<Coefficients>,
}

impl Polynomial {
    /// Divides a polynomial whose factors contain all of its variables, and that has no repeated ones, into
    /// factors over ℚ; their product is a multiple of it by a number. `None` if a factor may be repeated, or if
    /// the polynomial is too large.
    pub(super) fn divided(&self) -> Option<Vec<Self>> {
        let (mut open, mut found) = (vec![self.whole()?], Vec::new());
        while let Some(own) = open.pop() {
            let start = own.start()?;
            match own.split_from(&start) {
                Some(parts) if open.len() + found.len() < MOST_FACTORS => open.extend(parts),
                _ => found.push(own),
            }
        }
        Some(found)
    }

    /// Returns a multiple with whole coefficients without common divisor.
    fn whole(&self) -> Option<Self> {
        let parts: Vec<(BigInt, BigInt)> = self.terms.values().map(Rational::parts).collect();
        let below = parts.iter().fold(BigInt::one(), |common, (_, below)| common.lcm(below));
        let above = parts.iter().fold(BigInt::zero(), |common, (above, _)| common.gcd(above));
        (!above.is_zero()).then(|| self.scaled(&Rational::from_parts(below, above)))
    }

    fn degree_in(&self, variable: u32) -> u32 {
        let power = |own: &(u32, u32)| if own.0 == variable { own.1 } else { 0 };
        self.terms.keys().flat_map(|monomial| monomial.0.iter().map(power)).max().unwrap_or(0)
    }

    /// Finds a point at which there are no repeated factors, and as few as possible.
    fn start(&self) -> Option<Start> {
        let sum = |own: &super::Monomial| own.0.iter().map(|(_, power)| *power).sum::<u32>();
        if self.terms.keys().map(sum).max()? > MOST_DEGREE {
            return None;
        }
        let variables = self.variables();
        let rate = |variable: &u32| {
            let head = self.by_powers(*variable).pop().map_or(0, |(_, head)| match head.number() {
                Some(_) => 0,
                None => head.size(),
            });
            let degree = self.degree_in(*variable);
            (degree > 1, head, degree)
        };
        let main = variables.iter().copied().min_by_key(rate)?;
        let others: Vec<u32> = variables.into_iter().filter(|own| *own != main).collect();
        // A linear polynomial without a factor that is free of the variable is irreducible.
        if self.degree_in(main) == 1 {
            return Some(Start { main, point: Vec::new(), factors: Vec::new() });
        }
        let mut best: Option<Start> = None;
        let mut count = 0;
        let mut rng = ProofRng::for_trials(ProofStream::Divisors);
        for round in 0..MOST_POINTS {
            let reach = (2 + round / 3).min(COORDINATES.len() as u64);
            let point: Vec<(u32, i64)> = others
                .iter()
                .map(|variable| {
                    let index = if round == 0 { 0 } else { rng.below(reach) };
                    (*variable, COORDINATES[index as usize])
                })
                .collect();
            let factors = self.at(main, &point).and_then(|own| irreducible_factors(&own));
            let Some(factors) = factors else { continue };
            count += 1;
            let is_better = best.as_ref().is_none_or(|best| factors.len() < best.factors.len());
            if is_better {
                best = Some(Start { main, point, factors });
            }
            let is_one = best.as_ref().is_some_and(|best| best.factors.len() == 1);
            if is_one || count == COMPARED || others.is_empty() {
                break;
            }
        }
        best
    }

    /// Returns whole coefficients without common divisor at a point; `None` if the degree is less there.
    fn at(&self, main: u32, point: &[(u32, i64)]) -> Option<Coefficients> {
        let mut all: Coefficients = Vec::new();
        for (monomial, value) in &self.terms {
            let (mut term, below) = value.parts();
            if !below.is_one() {
                return None;
            }
            let mut power = 0;
            for (variable, exponent) in &monomial.0 {
                match point.iter().find(|(own, _)| own == variable) {
                    Some((_, value)) => term *= BigInt::from(*value).pow(*exponent),
                    None => power = *exponent as usize,
                }
            }
            if all.len() <= power {
                all.resize(power + 1, BigInt::zero());
            }
            all[power] += term;
        }
        let has_degree = all.len() == self.degree_in(main) as usize + 1
            && all.last().is_some_and(|head| !head.is_zero());
        has_degree.then(|| primitive(all))
    }

    /// Finds two factors, of which the first is a product of as few of those at the point as possible.
    fn split_from(&self, start: &Start) -> Option<[Self; 2]> {
        let count = start.factors.len();
        if !(2..=MOST_FACTORS).contains(&count) {
            return None;
        }
        let mut lifting = match start.point.is_empty() {
            true => None,
            false => Some(Lifting::of(self, start.main, &start.point)?),
        };
        let mut sets: Vec<u32> = (1..(1 << count) - 1).collect();
        sets.retain(|set| 2 * set.count_ones() as usize <= count);
        sets.order_by_key(|set| set.count_ones());
        for set in sets {
            let of = |is_chosen: bool| {
                let own = start.factors.iter().enumerate();
                let own = own.filter(|(k, _)| (set >> k & 1 == 1) == is_chosen);
                own.fold(vec![BigInt::one()], |all, (_, own)| product(&all, own))
            };
            let factor = match &mut lifting {
                None => univariate(start.main, &of(true)),
                Some(lifting) => lifting.lifted(&of(true), &of(false)),
            };
            let mut work = MOST_WORK;
            let found = factor.and_then(|factor| {
                let content = factor.content(start.main, &mut work)?;
                let factor = factor.over(&content, &mut work)?.whole()?;
                let rest = self.over(&factor, &mut work)?.whole()?;
                Some([factor, rest])
            });
            if found.is_some() {
                return found;
            }
        }
        None
    }
}

fn univariate(variable: u32, of: &[BigInt]) -> Option<Polynomial> {
    let mut sum = Polynomial::default();
    for (power, value) in (0..).zip(of) {
        let exponent = (power > 0).then_some((variable, power));
        let value = Rational::from_parts(value.clone(), BigInt::one());
        sum = sum.plus(&Polynomial::of_term(&value, exponent));
    }
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variables<const N: usize>() -> [Polynomial; N] {
        std::array::from_fn(|k| Polynomial::variable(u32::try_from(k).expect("few")))
    }

    fn number(value: i64) -> Polynomial {
        Polynomial::constant(&Rational::from(value))
    }

    fn product(factors: &[Polynomial]) -> Polynomial {
        let times =
            |all: Polynomial, own: &Polynomial| all.times(own, &mut { MOST_WORK }).expect("small");
        factors.iter().fold(number(1), times)
    }

    fn power(of: &Polynomial, exponent: usize) -> Polynomial {
        product(&vec![of.clone(); exponent])
    }

    /// Number of factors, whose product is the polynomial but for repetitions.
    fn count(of: &Polynomial) -> usize {
        let factors = of.factors();
        let mut rest = of.clone();
        for factor in &factors {
            let mut times = 0;
            while let Some(next) = rest.over(factor, &mut { MOST_WORK }) {
                (rest, times) = (next, times + 1);
            }
            assert!(times > 0, "a factor divides");
        }
        assert!(rest.number().is_some(), "nothing but numbers is left");
        factors.len()
    }

    #[test]
    fn polynomials_written_out_fall_apart() {
        let [x, y, z] = variables();
        let sum = |all: &[Polynomial]| all.iter().fold(number(0), |sum, own| sum.plus(own));
        let cubes = sum(&[power(&x, 3), power(&y, 3), power(&z, 3)]);
        let xyz = product(&[x.clone(), y.clone(), z.clone()]);
        assert_eq!(count(&cubes.plus(&xyz.scaled(&Rational::from(-3)))), 2);
        assert_eq!(count(&cubes), 1, "x³ + y³ + z³");
        let fourth = sum(&[
            power(&x, 4),
            product(&[number(-5), power(&x, 2), power(&y, 2)]),
            product(&[number(4), power(&y, 4)]),
        ]);
        assert_eq!(count(&fourth), 4, "x⁴ − 5x²y² + 4y⁴");
        assert_eq!(count(&power(&x, 3).plus(&power(&y, 3))), 2);
        assert_eq!(count(&power(&x, 2).plus(&power(&y, 2).scaled(&Rational::from(-2)))), 1);
        let sophie = power(&x, 4).plus(&power(&y, 4).scaled(&Rational::from(4)));
        assert_eq!(count(&sophie), 2, "x⁴ + 4y⁴");
        let heads = product(&[
            product(&[y.clone(), power(&x, 2)]).plus(&z),
            product(&[z.clone(), power(&x, 2)]).plus(&y).plus(&number(1)),
        ]);
        assert_eq!(count(&heads), 2, "(yx² + z)(zx² + y + 1)");
        assert_eq!(count(&power(&fourth, 2)), 4, "repeated");
    }

    #[test]
    fn scalar_products_in_a_quadratic_equation_fall_apart() {
        let [a, b, c, d, e, f] = variables();
        let pairs = [[&a, &d], [&b, &e], [&c, &f]];
        let dot = |pairs: [[&Polynomial; 2]; 3]| {
            let one = |[x, y]: [&Polynomial; 2]| product(&[x.clone(), y.clone()]);
            pairs.into_iter().map(one).fold(number(0), |sum, own| sum.plus(&own))
        };
        let (mixed, square) = (dot(pairs), dot([[&d, &d], [&e, &e], [&f, &f]]));
        let minus = |k: i64| mixed.plus(&square.scaled(&Rational::from(-k)));
        assert_eq!(count(&product(&[minus(1), minus(2)])), 2);
        assert_eq!(count(&product(&[minus(1), minus(2)]).plus(&a)), 1);
    }

    #[test]
    fn random_products_of_linear_and_quadratic_factors_fall_apart() {
        let all: [Polynomial; 4] = variables();
        let mut rng = ProofRng::new(11, 0);
        let mut below = move |count: u64| rng.below(count);
        for round in 0..60 {
            let parts = 2 + usize::from(round % 3 == 0);
            let factors: Vec<Polynomial> = (0..parts)
                .map(|part| {
                    let mut sum = number(i64::try_from(below(5)).expect("small") - 2);
                    for _ in 0..3 {
                        let mut term = number(1 + i64::try_from(below(4)).expect("small"));
                        for _ in 0..1 + (part + round) % 2 {
                            term = product(&[term, all[below(4) as usize].clone()]);
                        }
                        sum = sum.plus(&term.scaled(&Rational::from([1, -1][below(2) as usize])));
                    }
                    sum
                })
                .filter(|own| own.number().is_none())
                .collect();
            let mut different: Vec<Polynomial> = Vec::new();
            for factor in factors.iter().filter_map(Polynomial::monic) {
                if !different.contains(&factor) {
                    different.push(factor);
                }
            }
            assert!(count(&product(&factors)) >= different.len(), "round {round}");
        }
    }
}
