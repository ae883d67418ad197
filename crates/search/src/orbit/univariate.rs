//! Polynomials in one variable modulo a prime, coefficients from low to high.

use liouville::number::prime::Modulus;

use super::super::{Halt, SearchError};

/// Removes leading zeros.
fn trimmed(mut f: Vec<u64>) -> Vec<u64> {
    while f.last() == Some(&0) {
        f.pop();
    }
    f
}

/// Degree; `None` for 0.
pub fn degree(f: &[u64]) -> Option<usize> {
    f.iter().rposition(|entry| *entry != 0)
}

/// Finds the polynomial with given values at 0, 1, 2, …
pub fn interpolated(m: &Modulus, values: &[u64], halt: &Halt) -> Result<Vec<u64>, SearchError> {
    let count = values.len();
    let numbers: Vec<u64> = (0..count as u64).map(|k| m.integer(k)).collect();
    let inverses = m.inverses_up_to(count);
    // Newton's divided differences in place.
    let mut slopes = values.to_vec();
    for (level, inverse) in inverses[..count].iter().enumerate().skip(1) {
        halt.check()?;
        for k in (level..count).rev() {
            slopes[k] = m.mul(m.sub(slopes[k], slopes[k - 1]), *inverse);
        }
    }
    let mut f: Vec<u64> = Vec::with_capacity(count);
    for k in (0..count).rev() {
        halt.check()?;
        // f ← f (t − k) + slope
        let mut carried = slopes[k];
        for entry in &mut f {
            carried = m.sub(carried, m.mul(numbers[k], *entry));
            std::mem::swap(entry, &mut carried);
        }
        f.push(carried);
    }
    Ok(trimmed(f))
}

/// Divides by a polynomial that is not 0; returns quotient and remainder.
pub fn divided(m: &Modulus, f: &[u64], by: &[u64]) -> (Vec<u64>, Vec<u64>) {
    let Some(low) = degree(by) else { return (Vec::new(), f.to_vec()) };
    let inverse = if by[low] == m.one() { m.one() } else { m.inverse(by[low]) };
    let mut quotient = vec![0; f.len().saturating_sub(low)];
    // Sums of products, which are reduced when they are needed, or when a further one might not fit.
    let mut rest: Vec<u128> = f.iter().map(|entry| m.widened(*entry)).collect();
    let mut pending = 0;
    for place in (low..rest.len()).rev() {
        let factor = m.mul(m.reduced(rest[place]), inverse);
        if factor == 0 {
            continue;
        }
        quotient[place - low] = factor;
        if pending == m.most_products() {
            rest[..place].iter_mut().for_each(|sum| *sum = m.widened(m.reduced(*sum)));
            pending = 0;
        }
        pending += 1;
        let minus = u128::from(m.sub(0, factor));
        for (sum, entry) in rest[place - low..place].iter_mut().zip(by) {
            *sum = sum.wrapping_add(minus.wrapping_mul(u128::from(*entry)));
        }
    }
    rest.truncate(low);
    let rest = rest.into_iter().map(|sum| m.reduced(sum)).collect();
    (trimmed(quotient), trimmed(rest))
}

/// Greatest common divisor with leading coefficient 1; empty for two zeros.
pub fn gcd(m: &Modulus, f: &[u64], g: &[u64], halt: &Halt) -> Result<Vec<u64>, SearchError> {
    let (mut f, mut g) = (trimmed(f.to_vec()), trimmed(g.to_vec()));
    while !g.is_empty() {
        halt.check()?;
        let rest = divided(m, &f, &g).1;
        (f, g) = (g, rest);
    }
    Ok(monic(m, f))
}

/// Makes the leading coefficient 1.
fn monic(m: &Modulus, mut f: Vec<u64>) -> Vec<u64> {
    if let Some(last) = f.last().copied() {
        let inverse = m.inverse(last);
        f.iter_mut().for_each(|entry| *entry = m.mul(*entry, inverse));
    }
    f
}

/// Removes all common factors with `other`.
pub fn without(
    m: &Modulus,
    mut f: Vec<u64>,
    other: &[u64],
    halt: &Halt,
) -> Result<Vec<u64>, SearchError> {
    loop {
        let common = gcd(m, &f, other, halt)?;
        if degree(&common).is_none_or(|own| own == 0) {
            return Ok(f);
        }
        f = divided(m, &f, &common).0;
    }
}

fn product(m: &Modulus, f: &[u64], g: &[u64], by: &[u64]) -> Vec<u64> {
    if f.is_empty() || g.is_empty() {
        return Vec::new();
    }
    let coefficient = |k: usize| {
        // f_j g_(k−j) for all j within both.
        let (first, last) = ((k + 1).saturating_sub(g.len()), k.min(f.len() - 1));
        m.convolved(&f[first..=last], &g[k - last..=k - first])
    };
    let all: Vec<u64> = (0..f.len() + g.len() - 1).map(coefficient).collect();
    divided(m, &all, by).1
}

fn power(
    m: &Modulus,
    base: &[u64],
    exponent: u64,
    by: &[u64],
    halt: &Halt,
) -> Result<Vec<u64>, SearchError> {
    let mut result = vec![m.one()];
    for bit in (0..64 - exponent.leading_zeros()).rev() {
        halt.check()?;
        result = product(m, &result, &result, by);
        if exponent >> bit & 1 == 1 {
            result = product(m, &result, base, by);
        }
    }
    Ok(result)
}

/// Finds the distinct roots in the field of a polynomial that is not 0.
pub fn roots(m: &Modulus, f: &[u64], halt: &Halt) -> Result<Vec<u64>, SearchError> {
    if degree(f).is_none_or(|own| own == 0) {
        return Ok(Vec::new());
    }
    let t = [0, m.one()];
    let f = &monic(m, trimmed(f.to_vec()));
    let mut frobenius = power(m, &t, m.prime(), f, halt)?;
    frobenius.resize(frobenius.len().max(2), 0);
    frobenius[1] = m.sub(frobenius[1], m.one());
    let mut found = Vec::new();
    let mut open = vec![(gcd(m, f, &frobenius, halt)?, 1u64)];
    while let Some((own, shift)) = open.pop() {
        match degree(&own) {
            None | Some(0) => {}
            Some(1) => found.push(m.sub(0, m.mul(own[0], m.inverse(own[1])))),
            // (t + shift)^((p − 1)/2) is 1 at half of the roots.
            Some(_) => {
                let base = [m.integer(shift), m.one()];
                let mut half = power(m, &base, (m.prime() - 1) / 2, &own, halt)?;
                half.resize(half.len().max(1), 0);
                half[0] = m.sub(half[0], m.one());
                let part = gcd(m, &own, &half, halt)?;
                let rest = divided(m, &own, &part).0;
                let is_whole = degree(&part) == degree(&own) || degree(&part) == Some(0);
                match is_whole {
                    true => open.push((own, shift + 1)),
                    false => open.extend([(part, shift + 1), (rest, shift + 1)]),
                }
            }
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_of_products_are_found() {
        let m = Modulus::new(2_305_843_009_213_693_951);
        let n = |x: u64| m.integer(x);
        // (t − 3)²(t − 5)(t − 11)(t² + 1), where −1 is no square
        let value = |t: u64| {
            let factor = |root: u64| m.sub(t, n(root));
            let square = m.add(m.mul(t, t), m.one());
            let twice = m.mul(factor(3), factor(3));
            m.mul(m.mul(twice, factor(5)), m.mul(factor(11), square))
        };
        let values: Vec<u64> = (0..12).map(|t| value(n(t))).collect();
        let halt = Halt::default();
        let f = interpolated(&m, &values, &halt).expect("no halt");
        assert_eq!(degree(&f), Some(6), "as many as factors");
        let found = roots(&m, &f, &halt).expect("no halt");
        let mut found: Vec<u64> = found.into_iter().map(|t| m.to_integer(t)).collect();
        found.sort_unstable();
        assert_eq!(found, [3, 5, 11], "each once");
        let rest = without(&m, f, &[m.sub(0, n(3)), m.one()], &halt).expect("no halt");
        assert_eq!(degree(&rest), Some(4), "the double root is gone");
    }
}
