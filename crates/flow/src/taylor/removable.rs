//! Quotients that have a limit where their divisors are 0, as u/(1 − e⁻ᵘ), sin u/u, (1 − cos u)/u² and
//! ln(1 + u)/u at u = 0.
//!
//! Near such a place a program has their power series in place of the quotients, which have no digits
//! there. Only quotients with functions count: what is rational as written, like x²/x, has no value where
//! its divisor is 0.

mod proved;
mod series;

use std::collections::BTreeMap;

use crate::taylor::germ::{Affine, Germ, LENGTH, Monomial};
use liouville::graph::{Graph, Step};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};
pub(in crate::taylor) use proved::ProvedSeries;
pub(in crate::taylor) use series::Germs;

/// Number of coefficients of the series that stand for a quotient.
const COUNT: usize = 30;
/// Largest number of steps of a graph that a quotient is made of.
const MOST_STEPS: usize = 256;
/// Largest number of places at which a divisor is looked at.
const MOST_PLACES: usize = 8;
/// Part of the largest term below which terms of a series are left out: below the rounding of
/// double-double.
const LEFT_OUT: f64 = 1e-33;
/// Part of the largest number on the way below which a sum counts as 0, and a fraction whose multiples
/// are far from each other.
const CANCELLED: f64 = 1e-9;
const GOLDEN: f64 = 0.618_033_988_749_895;
/// Number of times that the reach of a series is halved.
const MOST_HALVES: i32 = 12;

/// A quotient with a limit where its divisors are 0.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Removable {
    /// Function v that is 0 there.
    pub(super) variable: Affine,
    /// Factors of the quotient by their places, with their powers.
    pub(super) factors: Vec<(usize, i32)>,
    /// Its series in v up to `reach`, each with the unknowns that it is multiplied by.
    pub(super) series: Vec<(Monomial, Vec<Rational>)>,
    pub(super) reach: f64,
    /// Proved bounds of the series, if there are any.
    pub(super) proved: Option<ProvedSeries>,
}

impl Removable {
    /// Finds a quotient with a limit among the factors of a product.
    pub(super) fn of(germs: &mut Germs<'_>, factors: &[(usize, i32)]) -> Option<Self> {
        let divisors = || factors.iter().filter(|(_, power)| *power < 0);
        let has_dividend = factors.iter().any(|(_, power)| *power > 0);
        if !has_dividend {
            return None;
        }
        divisors().find_map(|(divisor, _)| {
            let places = variables(germs.graph, *divisor)?;
            places.into_iter().find_map(|variable| Self::at(germs, factors, variable))
        })
    }

    /// The quotient of the factors that are 0 where `variable` is, if it has a limit.
    fn at(germs: &mut Germs<'_>, factors: &[(usize, i32)], variable: Affine) -> Option<Self> {
        // What does not vanish has a series of order 0, and is no part of the quotient.
        let vanishing: Vec<(usize, i32)> = factors
            .iter()
            .copied()
            .filter(|own| may_vanish(germs.graph, own.0, &variable))
            .collect();
        let has = |is_dividend: bool| vanishing.iter().any(|own| (own.1 > 0) == is_dividend);
        if !has(true) || !has(false) {
            return None;
        }
        // Coefficients at the end are lost with each factor v of a divisor.
        let (mut dividend, mut zeros, mut lost) = (Germ::of_constant(Rational::from(1)), 0i64, 0);
        let mut own = Vec::new();
        let mut has_function = false;
        for power_is_positive in [true, false] {
            for (place, power) in
                vanishing.iter().filter(|(_, power)| (*power > 0) == power_is_positive)
            {
                let Some((germ, with_function)) = germs.of(*place, &variable) else { continue };
                let order = germ.order();
                if order == 0 || order >= COUNT {
                    continue;
                }
                zeros += order as i64 * i64::from(*power);
                has_function |= with_function;
                own.push((*place, *power));
                if power_is_positive {
                    dividend = dividend.product(&germ.power(power.unsigned_abs())?)?;
                } else {
                    let divisor = germ.plain()?;
                    for _ in 0..power.unsigned_abs() {
                        if dividend.order() < order {
                            return None;
                        }
                        dividend = dividend.divided(divisor, order)?;
                        lost += order;
                    }
                }
            }
        }
        let has_divisor = own.iter().any(|(_, power)| *power < 0);
        if !has_function || !has_divisor || zeros < 0 {
            return None;
        }
        let proved = (lost <= LENGTH - COUNT).then(|| ProvedSeries::of(&dividend)).flatten();
        let series: Vec<(Monomial, Vec<Rational>)> = dividend
            .terms
            .into_iter()
            .map(|(monomial, mut series)| {
                series.first.truncate(COUNT);
                (monomial, series.first)
            })
            .collect();
        let reach = (0..MOST_HALVES).map(|n| libm::ldexp(1.0, -n));
        let reach =
            reach.into_iter().find(|reach| series.iter().all(|(_, own)| ends(own, *reach)))?;
        Some(Self { variable, factors: own, series, reach, proved })
    }

    /// Places on which the quotient depends.
    pub(super) fn arguments(&self) -> impl Iterator<Item = usize> {
        let unknowns =
            self.series.iter().flat_map(|(monomial, _)| monomial.iter().map(|own| own.0));
        let factors = self.factors.iter().map(|(place, _)| *place);
        self.variable.terms.keys().copied().chain(unknowns).chain(factors)
    }
}

/// Whether the last terms of a series are below rounding up to a distance.
fn ends(series: &[Rational], reach: f64) -> bool {
    let size = |n: usize| series[n].to_f64().0.abs() * libm::pow(reach, n as f64);
    let largest = (0..COUNT).map(size).fold(0.0, f64::max);
    (COUNT - 3..COUNT).all(|n| size(n) <= LEFT_OUT * largest)
}

/// Steps that a step is made of, in order; `None` if they are many.
fn parts(graph: &Graph, place: usize) -> Option<Vec<usize>> {
    let (mut found, mut rest) = (std::collections::BTreeSet::new(), vec![place]);
    while let Some(next) = rest.pop() {
        if found.insert(next) {
            rest.extend(graph.step(next).arguments());
        }
        if found.len() > MOST_STEPS {
            return None;
        }
    }
    Some(found.into_iter().collect())
}

/// Steps as affine functions of others.
pub(super) fn affine(graph: &Graph, parts: &[usize]) -> BTreeMap<usize, Affine> {
    let mut all: BTreeMap<usize, Affine> = BTreeMap::new();
    for place in parts {
        let at = |a: usize| all.get(&a).cloned().unwrap_or_else(|| Affine::of_step(a));
        let minus = Rational::from(-1);
        let own = match graph.step(*place) {
            Step::Constant(value) => Some(Affine::of_constant(value.clone())),
            Step::Unary(UnaryFunction::Neg, a) => Some(at(a).times(&minus)),
            Step::Binary(BinaryOperation::Add, a, b) => {
                Some(at(a).plus(&at(b), &Rational::from(1)))
            }
            Step::Binary(BinaryOperation::Sub, a, b) => Some(at(a).plus(&at(b), &minus)),
            Step::Binary(BinaryOperation::Mul, a, b) => {
                let (x, y) = (at(a), at(b));
                let factor = |constant: &Affine, other: &Affine| {
                    constant.as_constant().map(|factor| other.times(factor))
                };
                factor(&x, &y).or_else(|| factor(&y, &x))
            }
            Step::Unary(UnaryFunction::Recip, a) => {
                let value = at(a);
                value.as_constant().and_then(Rational::recip).map(Affine::of_constant)
            }
            _ => None,
        };
        all.insert(*place, own.unwrap_or_else(|| Affine::of_step(*place)));
    }
    all
}

/// Functions of the state at whose zeros a divisor may be 0.
fn variables(graph: &Graph, divisor: usize) -> Option<Vec<Affine>> {
    let parts = parts(graph, divisor)?;
    let affine = affine(graph, &parts);
    let one = Affine::of_constant(Rational::from(1));
    let mut found: Vec<Affine> = Vec::new();
    for place in &parts {
        let candidate = match graph.step(*place) {
            Step::Unary(UnaryFunction::Exp | UnaryFunction::Sin | UnaryFunction::Cos, a) => {
                affine.get(&a).cloned()
            }
            Step::Unary(UnaryFunction::Ln, a) => {
                affine.get(&a).map(|own| own.plus(&one, &Rational::from(-1)))
            }
            Step::Input(_) => affine.get(place).cloned(),
            Step::Binary(BinaryOperation::Add | BinaryOperation::Sub, ..) => {
                affine.get(place).cloned()
            }
            _ => None,
        };
        let is_new = |own: &Affine| {
            own.as_constant().is_none() && !found.iter().any(|known| own.vanishes_with(known))
        };
        found.extend(candidate.filter(is_new));
    }
    found.truncate(MOST_PLACES);
    Some(found)
}

/// Whether a step seems to be 0 where v is, whatever the other steps are: numbers stand for these. Its
/// series takes a thousand times as long.
fn may_vanish(graph: &Graph, place: usize, v: &Affine) -> bool {
    let Some(parts) = parts(graph, place) else { return false };
    let affine = affine(graph, &parts);
    let (mut values, mut largest) = (BTreeMap::<usize, f64>::new(), 0.0f64);
    for place in parts {
        let value = match affine.get(&place).and_then(|own| own.along(v)) {
            Some([_, constant]) => constant.to_f64().0,
            None => number_of(graph.step(place), place, &values),
        };
        largest = largest.max(value.abs());
        values.insert(place, value);
    }
    let own = values.get(&place).copied().unwrap_or(f64::NAN);
    // Without a number nothing is known.
    !own.is_finite() || own.abs() <= CANCELLED * largest
}

/// Value of a step by those of its arguments; an input has a number of its own.
fn number_of(step: Step<'_>, place: usize, values: &BTreeMap<usize, f64>) -> f64 {
    let at = |a: usize| values.get(&a).copied().unwrap_or(f64::NAN);
    match step {
        Step::Constant(value) => value.to_f64().0,
        Step::Input(_) => 0.5 + (place as f64 * GOLDEN).fract(),
        Step::Binary(BinaryOperation::Add, a, b) => at(a) + at(b),
        Step::Binary(BinaryOperation::Sub, a, b) => at(a) - at(b),
        Step::Binary(BinaryOperation::Mul, a, b) => at(a) * at(b),
        Step::Binary(BinaryOperation::Pow, a, b) => libm::pow(at(a).abs(), at(b)),
        Step::Power(a, exponent) => match exponent.to_integer() {
            Some(whole) => libm::pow(at(a), whole as f64),
            None => libm::pow(at(a).abs(), exponent.to_f64().0),
        },
        Step::Unary(function, a) => match function {
            UnaryFunction::Neg => -at(a),
            UnaryFunction::Recip => at(a).recip(),
            UnaryFunction::Sqrt => libm::sqrt(at(a).abs()),
            UnaryFunction::Abs => at(a).abs(),
            UnaryFunction::Exp => libm::exp(at(a)),
            UnaryFunction::Ln => libm::log(at(a).abs()),
            UnaryFunction::Sin => libm::sin(at(a)),
            UnaryFunction::Cos => libm::cos(at(a)),
            UnaryFunction::Atan => libm::atan(at(a)),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::graph::{Expr, record};
    use liouville::scalar::Scalar;
    use num_dual::DualNum;

    /// Finds y times a quotient of functions of x.
    fn found(build: impl Fn(Expr) -> [Expr; 2]) -> Option<Removable> {
        let (graph, factors) = record(2, |x| build(x[0])).expect("records");
        let [dividend, divisor] = factors.map(|factor| graph.place(factor));
        Removable::of(&mut Germs::new(&graph), &[(dividend, 1), (divisor, -1)])
    }

    /// Value and slope along x at the place.
    fn first(found: Option<Removable>) -> (f64, f64) {
        let found = found.expect("a limit");
        assert!(found.reach >= 1e-2, "{found:?}");
        // The variable may run either way.
        let weight = found.variable.terms.values().next().expect("a variable").to_f64().0;
        (found.series[0].1[0].to_f64().0, found.series[0].1[1].to_f64().0 * weight)
    }

    fn number(a: i64, b: i64) -> Expr {
        Expr::rational(&Rational::new(a, b))
    }

    #[test]
    fn textbook_quotients_have_limits() {
        let rate = |v: Expr| {
            let u = (v + number(55, 1)) * number(1, 10);
            [(v + number(55, 1)) * number(1, 100), number(1, 1) - (-u).exp()]
        };
        // u/(1 − e^(−u))/10 = (1 + u/2 + …)/10, u = (V + 55)/10
        let (value, slope) = first(found(rate));
        assert!((value - 0.1).abs() < 1e-15 && (slope - 0.005).abs() < 1e-15, "{value} {slope}");
        let (value, slope) = first(found(|x| [x.sin(), x]));
        assert!((value, slope) == (1.0, 0.0));
        let (value, slope) = first(found(|x| [number(1, 1) - x.cos(), x * x]));
        assert!((value, slope) == (0.5, 0.0));
        let (value, slope) = first(found(|x| [(x + number(1, 1)).ln(), x]));
        assert!((value, slope) == (1.0, -0.5));
        let (value, slope) = first(found(|x| [x.ln(), x - number(1, 1)]));
        assert!((value, slope) == (1.0, -0.5), "{value} {slope}");
    }

    #[test]
    fn bounds_hold_what_a_series_leaves_out() {
        // u/(e^u − 1) = Σ B_k/k! u^k with the poles ±2πi: |B_k/k!| ≈ 2/(2π)^k for even k
        let own = found(|x| [x, x.exp() - number(1, 1)]).expect("a limit").proved.expect("bounds");
        assert!(own.reach > 1.0 && own.radius < std::f64::consts::TAU, "{own:?}");
        let truth: f64 = (0..200)
            .map(|k| 2.0 * libm::pow(std::f64::consts::TAU, -30.0 - 2.0 * f64::from(k)))
            .enumerate()
            .map(|(k, size)| size * libm::pow(own.radius, 2.0 * k as f64))
            .sum();
        assert!(own.rests[0] >= truth && own.rests[0] < 1e3 * truth, "{truth:e}: {own:?}");
    }

    #[test]
    fn no_series_is_made_where_no_dividend_is_0() {
        let (graph, factors) = record(2, |x| [x[1] + x[0].cos(), x[0].sin()]).expect("records");
        let [dividend, divisor] = factors.map(|factor| graph.place(factor));
        let mut germs = Germs::new(&graph);
        assert!(Removable::of(&mut germs, &[(dividend, 1), (divisor, -1)]).is_none());
        assert_eq!(germs.count(), 0);
    }

    #[test]
    fn poles_and_rational_quotients_have_none() {
        assert!(found(|x| [x.cos(), x]).is_none(), "a pole");
        assert!(found(|x| [x.sin(), x * x]).is_none(), "a pole of sin x/x²");
        assert!(found(|x| [x - number(1, 1_000_000), number(1, 1) - x.exp()]).is_none());
        assert!(found(|x| [x * x, x]).is_none(), "rational as written");
    }

    #[test]
    fn no_term_of_a_high_order_is_lost() {
        let power = |x: Expr, n: usize| (0..n).fold(number(1, 1), |power, _| power * x.sin());
        let with = |n: usize, other: bool| {
            let (graph, factors) = record(2, |x| {
                let factor = if other { x[1] } else { number(1000, 1) };
                [x[0].sin() + factor * power(x[0], n), x[0]]
            })
            .expect("records");
            let [dividend, divisor] = factors.map(|factor| graph.place(factor));
            Removable::of(&mut Germs::new(&graph), &[(dividend, 1), (divisor, -1)])
        };
        for other in [false, true] {
            assert!(with(30, other).is_none(), "{other}");
            // A power of the sine is an unknown of its own there.
            let many = with(40, other).expect("a limit").series;
            assert!(many.iter().any(|(monomial, _)| !monomial.is_empty()), "{other}: {many:?}");
            let reach = with(3, other).expect("a limit").reach;
            assert!(with(29, other).is_none_or(|own| own.reach < reach), "{other}");
        }
    }
}
