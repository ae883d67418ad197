//! Real roots of polynomials with rational coefficients.

use liouville::number::rational::Rational;

/// Whether a polynomial, given by its coefficients from low to high degree, has a real root.
///
/// By Sturm's theorem their number is the difference of the numbers of changes of sign at −∞ and ∞ in
/// the chain p, p', −(p mod p'), ….
pub fn has_real_root(coefficients: &[Rational]) -> bool {
    let first = trimmed(coefficients.to_vec());
    let slope = |(k, own): (usize, &Rational)| own * &Rational::from(k as i64);
    let second = trimmed(first.iter().enumerate().skip(1).map(slope).collect());
    let mut chain = vec![first, second];
    while let [.., before, last] = chain.as_slice()
        && !last.is_empty()
    {
        let next = minus_rest(before, last);
        chain.push(next);
    }
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
}
