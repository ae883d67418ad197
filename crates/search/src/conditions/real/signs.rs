//! Signs that a polynomial takes at real points.
//!
//! In one variable by numbers between its roots. In two, f(x, y) without repeated factors: over an
//! interval of x without roots of the resultant of f and ∂f/∂y the real roots y are as many functions of x
//! that are continuous and distinct, so that numbers between them at one x show all signs over the interval.
//! Polynomials of degree two have the signs of a quadratic form.

use liouville::number::rational::Rational;

use super::arithmetic::{self, Terms, degree, degree_in, univariate};
use super::signature::signature;
use super::sturm::{between_roots, value};

/// Largest degree of polynomials in two variables.
const DEGREE: u32 = 8;
/// Points at which signs are looked for have coordinates with these numerators over 1 and 2.
const NEAR: std::ops::RangeInclusive<i64> = -4..=4;
/// Largest number of such points.
const POINTS: usize = 4096;

/// Whether a polynomial takes positive values, and negative ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Signs {
    /// Whether it is positive somewhere.
    pub positive: bool,
    /// Whether it is negative somewhere.
    pub negative: bool,
}

impl Signs {
    fn note(&mut self, value: &Rational) {
        self.negative |= value.is_negative();
        self.positive |= !value.is_negative() && !value.is_zero();
    }

    /// Whether it takes both.
    pub fn are_both(self) -> bool {
        self.positive && self.negative
    }
}

/// Finds the signs of a polynomial that is not constant and has no repeated factors; `None` if they are not
/// known.
pub fn signs(own: &Terms) -> Option<Signs> {
    let count = own.first()?.0.len();
    let used: Vec<usize> = (0..count).filter(|k| arithmetic::contains(own, *k)).collect();
    let seen = seen(own, &used, count);
    if seen.are_both() {
        return Some(seen);
    }
    match used.as_slice() {
        [] => None,
        [place] => Some(on_line(&univariate(own, *place))),
        _ if degree(own) == 2 => Some(of_form(own, &used)),
        [x, y] => in_plane(own, *x, *y),
        _ => even(own),
    }
}

/// Signs at some points.
fn seen(own: &Terms, used: &[usize], count: usize) -> Signs {
    let mut signs = Signs::default();
    let numbers: Vec<Rational> =
        [1, 2].iter().flat_map(|below| NEAR.map(|above| Rational::new(above, *below))).collect();
    let mut places = vec![0; used.len()];
    let mut point = vec![Rational::from(0); count];
    for _ in 0..POINTS {
        used.iter().zip(&places).for_each(|(k, own)| point[*k] = numbers[*own].clone());
        signs.note(&arithmetic::value(own, &point));
        if signs.are_both() {
            break;
        }
        let Some(next) = places.iter().position(|own| *own + 1 < numbers.len()) else { break };
        places[next] += 1;
        places[..next].fill(0);
    }
    signs
}

fn on_line(coefficients: &[Rational]) -> Signs {
    let mut signs = Signs::default();
    between_roots(coefficients).iter().for_each(|x| signs.note(&value(coefficients, x)));
    signs
}

/// Signs of a polynomial of degree two, q(1, x): the points (1, x) are dense in projective space.
fn of_form(own: &Terms, used: &[usize]) -> Signs {
    let zero = || Rational::from(0);
    let mut matrix = vec![vec![zero(); used.len() + 1]; used.len() + 1];
    for (exponents, value) in own {
        let factors = used.iter().enumerate();
        let mut places: Vec<usize> =
            factors.flat_map(|(k, place)| (0..exponents[*place]).map(move |_| k + 1)).collect();
        places.resize(2, 0);
        let half = value * &Rational::new(1, 2);
        let (i, j) = (places[0], places[1]);
        matrix[i][j] = &matrix[i][j] + &half;
        matrix[j][i] = &matrix[j][i] + &half;
    }
    let (positive, negative) = signature(matrix);
    Signs { positive: positive > 0, negative: negative > 0 }
}

/// Signs of a polynomial in two variables.
fn in_plane(own: &Terms, x: usize, y: usize) -> Option<Signs> {
    // The resultant is of lower degree in this order.
    let (x, y) = if degree_in(own, y) <= degree_in(own, x) { (x, y) } else { (y, x) };
    if degree(own) > DEGREE {
        return None;
    }
    let height = degree_in(own, y) as usize;
    let fibre = |at: &Rational| -> Vec<Rational> {
        let mut all = vec![Rational::from(0); height + 1];
        for (exponents, value) in own {
            let entry = &mut all[exponents[y] as usize];
            let power = (0..exponents[x]).fold(value.clone(), |all, _| &all * at);
            *entry = &*entry + &power;
        }
        all
    };
    let most = (2 * height - 1) * degree_in(own, x) as usize;
    let points: Vec<(Rational, Rational)> = (0..=most as i64)
        .map(|at| Rational::from(at - most as i64 / 2))
        .map(|at| (at.clone(), resultant(&fibre(&at))))
        .collect();
    let resultant = through(&points);
    // Otherwise there is a repeated factor.
    resultant.iter().any(|own| !own.is_zero()).then_some(())?;
    let mut signs = Signs::default();
    for at in between_roots(&resultant) {
        let own = fibre(&at);
        between_roots(&own).iter().for_each(|at| signs.note(&value(&own, at)));
    }
    Some(signs)
}

/// Determinant of Sylvester's matrix of a polynomial and its derivative, of formal degrees n and n − 1.
fn resultant(own: &[Rational]) -> Rational {
    let n = own.len() - 1;
    let slope: Vec<Rational> =
        own.iter().enumerate().skip(1).map(|(k, x)| x * &Rational::from(k as i64)).collect();
    let size = 2 * n - 1;
    let row = |entries: &[Rational], shift: usize| {
        let mut all = vec![Rational::from(0); size];
        entries.iter().rev().enumerate().for_each(|(k, x)| all[shift + k] = x.clone());
        all
    };
    let above = (0..n - 1).map(|shift| row(own, shift));
    let below = (0..n).map(|shift| row(&slope, shift));
    determinant(above.chain(below).collect())
}

fn determinant(mut own: Vec<Vec<Rational>>) -> Rational {
    let mut all = Rational::from(1);
    for column in 0..own.len() {
        let Some(place) = (column..own.len()).find(|row| !own[*row][column].is_zero()) else {
            return Rational::from(0);
        };
        if place != column {
            own.swap(place, column);
            all = -&all;
        }
        let pivot = own[column].clone();
        all = &all * &pivot[column];
        let Some(inverse) = pivot[column].recip() else { return Rational::from(0) };
        for row in own.iter_mut().skip(column + 1) {
            let factor = &row[column] * &inverse;
            if !factor.is_zero() {
                for (entry, other) in row.iter_mut().zip(&pivot).skip(column) {
                    *entry = &*entry - &(&factor * other);
                }
            }
        }
    }
    all
}

/// Coefficients of the polynomial through some points, by Newton's differences.
fn through(points: &[(Rational, Rational)]) -> Vec<Rational> {
    let mut differences: Vec<Rational> = points.iter().map(|(_, own)| own.clone()).collect();
    for order in 1..points.len() {
        for k in (order..points.len()).rev() {
            let width = &points[k].0 - &points[k - order].0;
            let Some(inverse) = width.recip() else { return Vec::new() };
            differences[k] = &(&differences[k] - &differences[k - 1]) * &inverse;
        }
    }
    let mut all: Vec<Rational> = Vec::new();
    for (difference, (node, _)) in differences.iter().zip(points).rev() {
        let mut next = vec![Rational::from(0); all.len() + 1];
        for (k, own) in all.iter().enumerate() {
            next[k + 1] = &next[k + 1] + own;
            next[k] = &next[k] - &(own * node);
        }
        next[0] = &next[0] + difference;
        all = next;
    }
    while all.last().is_some_and(Rational::is_zero) {
        all.pop();
    }
    all
}

/// Signs of a sum of even powers with coefficients of one sign.
fn even(own: &Terms) -> Option<Signs> {
    let is_even = own.iter().all(|(exponents, _)| exponents.iter().all(|own| own % 2 == 0));
    let negative = own.iter().filter(|(_, value)| value.is_negative()).count();
    match (is_even, negative) {
        (true, 0) => Some(Signs { positive: true, negative: false }),
        (true, all) if all == own.len() => Some(Signs { positive: false, negative: true }),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(terms: &[(&[u32], i64)]) -> Option<Signs> {
        let terms = terms.iter().map(|(own, value)| (own.to_vec(), Rational::from(*value)));
        signs(&terms.collect())
    }

    const BOTH: Option<Signs> = Some(Signs { positive: true, negative: true });
    const POSITIVE: Option<Signs> = Some(Signs { positive: true, negative: false });
    const NEGATIVE: Option<Signs> = Some(Signs { positive: false, negative: true });

    #[test]
    fn signs_are_those_at_all_real_points() {
        // (a − 1)² + (b − 2)² + c
        let circle =
            |last| of(&[(&[2, 0], 1), (&[1, 0], -2), (&[0, 2], 1), (&[0, 1], -4), (&[0, 0], last)]);
        assert_eq!(circle(5), POSITIVE);
        assert_eq!(circle(6), POSITIVE);
        assert_eq!(circle(4), BOTH);
        let scale = 300_i64;
        // (300 a − 100)² + (300 b − 100)² + c: a disc without any of the points that are tried.
        let small = |last: i64| {
            of(&[
                (&[2, 0], scale * scale),
                (&[1, 0], -200 * scale),
                (&[0, 2], scale * scale),
                (&[0, 1], -200 * scale),
                (&[0, 0], 20_000 + last),
            ])
        };
        assert_eq!((small(-1), small(0), small(1)), (BOTH, POSITIVE, POSITIVE));
        // The same with squares in place of a and b, by the resultant.
        let quartic = |last: i64| {
            of(&[
                (&[4, 0], scale * scale),
                (&[2, 0], -200 * scale),
                (&[0, 4], scale * scale),
                (&[0, 2], -200 * scale),
                (&[0, 0], 20_000 + last),
            ])
        };
        assert_eq!((quartic(-1), quartic(0), quartic(1)), (BOTH, POSITIVE, POSITIVE));
        assert_eq!(of(&[(&[2, 0], -1), (&[0, 2], -1), (&[1, 1], 1), (&[0, 0], -1)]), NEGATIVE);
        // Motzkin's polynomial is no sum of squares.
        assert_eq!(of(&[(&[4, 2], 1), (&[2, 4], 1), (&[2, 2], -3), (&[0, 0], 1)]), POSITIVE);
        assert_eq!(of(&[(&[4, 2], 2), (&[2, 4], 1), (&[2, 2], -4), (&[0, 0], 1)]), BOTH);
        // One branch far out: b = 10⁶ + a².
        assert_eq!(of(&[(&[2, 0], 1), (&[0, 1], -1), (&[0, 0], 1_000_000)]), BOTH);
    }

    #[test]
    fn signs_that_are_not_known_are_not_said() {
        assert_eq!(of(&[(&[2, 2, 0], 1), (&[0, 0, 4], 1), (&[0, 0, 0], 1)]), POSITIVE);
        let open: &[(&[u32], i64)] =
            &[(&[4, 0, 0], 1), (&[0, 4, 0], 1), (&[0, 0, 4], 1), (&[1, 1, 1], 1), (&[0, 0, 0], 9)];
        assert_eq!(of(open), None, "in three variables");
        // (a² − a b + b²)²: nothing is concluded from a resultant that vanishes.
        let square: &[(&[u32], i64)] =
            &[(&[4, 0], 1), (&[3, 1], -2), (&[2, 2], 3), (&[1, 3], -2), (&[0, 4], 1)];
        assert_eq!(of(square), None);
    }
}
