//! Real roots of polynomials with rational coefficients.

use liouville::number::rational::Rational;

/// Whether a polynomial, given by its coefficients from low to high degree, has a real root.
///
/// By Sturm's theorem their number is the difference of the numbers of changes of sign at −∞ and ∞ in
/// the chain p, p', −(p mod p'), ….
pub fn has_real_root(coefficients: &[Rational]) -> bool {
    let chain = chain(coefficients);
    let changes = |is_left: bool| {
        let sign = |own: &Vec<Rational>| {
            let lead = own.last()?;
            Some(lead.is_negative() ^ (is_left && own.len().is_multiple_of(2)))
        };
        let signs: Vec<bool> = chain.iter().filter_map(sign).collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    };
    changes(true) > changes(false)
}

/// Numbers between neighbouring real roots, and on both sides of all: one in each interval. The numbers are
/// no roots, and increase.
pub fn between_roots(coefficients: &[Rational]) -> Vec<Rational> {
    let chain = chain(coefficients);
    let Some(inverse) = chain[0].last().and_then(Rational::recip) else { return Vec::new() };
    // By Cauchy all roots are smaller than 1 + max |a_k/a_n|.
    let sizes = chain[0].iter().map(|own| (own * &inverse).abs());
    let bound = &Rational::from(1) + &sizes.max().unwrap_or_else(|| Rational::from(1));
    let left = -&bound;
    let changes = changes_at(&chain, &left);
    let mut found = vec![left.clone()];
    divide(&chain, (left, changes), (bound.clone(), changes_at(&chain, &bound)), &mut found);
    found
}

/// Notes the right ends of intervals with one root each.
fn divide(
    chain: &[Vec<Rational>],
    (left, before): (Rational, usize),
    (right, after): (Rational, usize),
    found: &mut Vec<Rational>,
) {
    match before.saturating_sub(after) {
        0 => {}
        1 => found.push(right),
        _ => {
            let width = &right - &left;
            // Among more numbers than roots one is not a root.
            let inside = (1..=chain[0].len() as i64 + 1)
                .map(|k| &left + &(&width * &Rational::new(k, 2 * k + 1 - k % 2)))
                .find(|own| !value(&chain[0], own).is_zero());
            let Some(middle) = inside else { return };
            let changes = changes_at(chain, &middle);
            divide(chain, (left, before), (middle.clone(), changes), found);
            divide(chain, (middle, changes), (right, after), found);
        }
    }
}

/// Value at a number.
pub fn value(coefficients: &[Rational], x: &Rational) -> Rational {
    coefficients.iter().rev().fold(Rational::from(0), |sum, own| &(&sum * x) + own)
}

fn changes_at(chain: &[Vec<Rational>], x: &Rational) -> usize {
    let values = chain.iter().map(|own| value(own, x)).filter(|own| !own.is_zero());
    let signs: Vec<bool> = values.map(|own| own.is_negative()).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// Sturm's chain p, p', −(p mod p'), …; each but for a positive factor.
fn chain(coefficients: &[Rational]) -> Vec<Vec<Rational>> {
    let first = trimmed(coefficients.to_vec());
    let slope = |(k, own): (usize, &Rational)| own * &Rational::from(k as i64);
    let second = trimmed(first.iter().enumerate().skip(1).map(slope).collect());
    let mut chain = vec![first, second];
    while let [.., before, last] = chain.as_slice()
        && !last.is_empty()
    {
        let mut next = minus_rest(before, last);
        if let Some(scale) = next.last().and_then(|own| own.abs().recip()) {
            next.iter_mut().for_each(|own| *own = &*own * &scale);
        }
        chain.push(next);
    }
    chain
}

/// −(a mod b).
fn minus_rest(a: &[Rational], b: &[Rational]) -> Vec<Rational> {
    let mut rest = a.to_vec();
    let Some(inverse) = b.last().and_then(Rational::recip) else { return Vec::new() };
    while rest.len() >= b.len() {
        let Some(lead) = rest.pop() else { break };
        let factor = &lead * &inverse;
        let start = rest.len() + 1 - b.len();
        for (entry, own) in rest[start..].iter_mut().zip(b) {
            *entry = &*entry - &(&factor * own);
        }
    }
    let zero = Rational::from(0);
    trimmed(rest.iter().map(|own| &zero - own).collect())
}

fn trimmed(mut own: Vec<Rational>) -> Vec<Rational> {
    while own.last().is_some_and(Rational::is_zero) {
        own.pop();
    }
    own
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn real_roots_are_counted() {
        let has = |own: &[i64]| {
            has_real_root(&own.iter().map(|x| Rational::from(*x)).collect::<Vec<_>>())
        };
        assert!(has(&[-2, 0, 1]) && !has(&[2, 0, 1]), "x² ∓ 2");
        assert!(has(&[1, 2, 1]) && has(&[5, 0, 0, 1]), "(x + 1)² and x³ + 5");
        assert!(!has(&[1, -1, 1]) && !has(&[1, 0, 0, 0, 1]), "x² − x + 1 and x⁴ + 1");
        assert!(has(&[-1, 0, 0, 0, 1]) && has(&[0, 1]) && !has(&[3]), "x⁴ − 1, x and 3");
        assert!(!has(&[1, 0, 3, 0, 1]) && has(&[1, 0, -3, 0, 1]), "x⁴ ± 3x² + 1");
    }

    #[test]
    fn numbers_lie_between_real_roots() {
        let count = |own: &[i64]| {
            let own: Vec<Rational> = own.iter().map(|x| Rational::from(*x)).collect();
            let found = between_roots(&own);
            assert!(found.windows(2).all(|pair| pair[0] < pair[1]), "{found:?}");
            assert!(found.iter().all(|x| !value(&own, x).is_zero()), "{found:?}");
            let signs: Vec<bool> = found.iter().map(|x| value(&own, x).is_negative()).collect();
            (found.len(), signs.windows(2).filter(|pair| pair[0] != pair[1]).count())
        };
        assert_eq!(
            count(&[0, -1, 0, 1]),
            (4, 3),
            "x³ − x: the middle of the first interval is a root"
        );
        assert_eq!(count(&[0, 0, -1, 1]), (3, 1), "x³ − x²");
        assert_eq!(count(&[1, 0, 0, 0, 1]), (1, 0), "x⁴ + 1");
        assert_eq!(count(&[7]), (1, 0));
        assert_eq!(count(&[-1, 1000]), (2, 1));
        assert_eq!(count(&[36, 0, -49, 0, 14, 0, -1]), (7, 6), "(1 − x²)(x² − 4)(x² − 9)");
    }
}
