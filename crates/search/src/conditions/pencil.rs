//! Determinants of matrices whose entries are polynomials of a low degree in one variable.
//!
//! For C(t) = C₀ + t C₁ + … + t^δ C_δ with an invertible C₀, det C(t) = det C₀ · t^(δr) χ(1/t), where χ
//! is the characteristic polynomial of the companion matrix of w^δ + w^(δ−1) C₀⁻¹C₁ + … + C₀⁻¹C_δ. By
//! Hessenberg's form this takes about as long as ten determinants of numbers.

use liouville::number::prime::{Modulus, Polynomial, PrimePolynomials};

use crate::{Halt, SearchError};

/// A square matrix modulo a prime, row by row.
pub type SquareMatrix = Vec<Vec<u64>>;

/// Finds det (C₀ + t C₁ + …) up to a factor; `None` if C₀ is singular.
pub fn determinant(
    m: &Modulus,
    coefficients: &[SquareMatrix],
    halt: &Halt,
) -> Result<Option<Polynomial>, SearchError> {
    let Some((first, others)) = coefficients.split_first() else { return Ok(None) };
    let Some(quotients) = solved(m, first, others, halt)? else { return Ok(None) };
    let (size, degree) = (first.len(), others.len());
    // Companion: the first rows are −C₀⁻¹C₁, …, −C₀⁻¹C_δ, and below them is the identity, shifted.
    let mut companion = vec![vec![0; size * degree]; size * degree];
    for (block, quotient) in quotients.iter().enumerate() {
        for (i, row) in quotient.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                companion[i][block * size + j] = m.sub(0, *entry);
            }
        }
    }
    for k in size..size * degree {
        companion[k][k - size] = m.one();
    }
    let mut reversed = characteristic(m, companion, halt)?;
    reversed.reverse();
    Ok(Some(PrimePolynomials::trimmed(reversed)))
}

/// Computes C⁻¹ B for some matrices B; `None` if C is singular.
fn solved(
    m: &Modulus,
    matrix: &SquareMatrix,
    others: &[SquareMatrix],
    halt: &Halt,
) -> Result<Option<Vec<SquareMatrix>>, SearchError> {
    let size = matrix.len();
    let mut rows: SquareMatrix = (0..size)
        .map(|i| {
            let further = others.iter().flat_map(|other| other[i].iter());
            matrix[i].iter().chain(further).copied().collect()
        })
        .collect();
    for k in 0..size {
        halt.check()?;
        let Some(pivot) = (k..size).find(|row| rows[*row][k] != 0) else { return Ok(None) };
        rows.swap(pivot, k);
        let inverse = m.inverse(rows[k][k]);
        rows[k][k..].iter_mut().for_each(|entry| *entry = m.mul(*entry, inverse));
        let row = std::mem::take(&mut rows[k]);
        for other in rows.iter_mut().filter(|other| other.get(k).is_some_and(|x| *x != 0)) {
            let factor = other[k];
            subtract(m, &mut other[k..], &row[k..], factor);
        }
        rows[k] = row;
    }
    let block = |number: usize| {
        let start = size * (number + 1);
        rows.iter().map(|row| row[start..start + size].to_vec()).collect()
    };
    Ok(Some((0..others.len()).map(block).collect()))
}

/// Subtracts a multiple of a row.
fn subtract(m: &Modulus, row: &mut [u64], other: &[u64], factor: u64) {
    for (entry, own) in row.iter_mut().zip(other).filter(|(_, own)| **own != 0) {
        *entry = m.sub(*entry, m.mul(factor, *own));
    }
}

/// Finds the characteristic polynomial of a matrix.
fn characteristic(
    m: &Modulus,
    mut h: SquareMatrix,
    halt: &Halt,
) -> Result<Polynomial, SearchError> {
    let size = h.len();
    for k in 1..size.saturating_sub(1) {
        halt.check()?;
        let Some(pivot) = (k..size).find(|row| h[*row][k - 1] != 0) else { continue };
        if pivot != k {
            h.swap(pivot, k);
            h.iter_mut().for_each(|row| row.swap(pivot, k));
        }
        let inverse = m.inverse(h[k][k - 1]);
        let row = h[k].clone();
        let mut factors = vec![0; size];
        for i in k + 1..size {
            if h[i][k - 1] != 0 {
                factors[i] = m.mul(h[i][k - 1], inverse);
                subtract(m, &mut h[i][k - 1..], &row[k - 1..], factors[i]);
            }
        }
        // The same change of basis for the columns.
        for own in &mut h {
            let used = own[k + 1..].iter().zip(&factors[k + 1..]).filter(|(_, f)| **f != 0);
            let sum = used.fold(0, |sum, (x, f)| m.add(sum, m.mul(*x, *f)));
            own[k] = m.add(own[k], sum);
        }
    }
    // p_k = (w − h_kk) p_(k−1) − Σ h_ik h_(i+1,i) … h_(k,k−1) p_(i−1)
    let mut all: Vec<Polynomial> = vec![vec![m.one()]];
    for k in 0..size {
        halt.check()?;
        let last = &all[k];
        let mut next = vec![0; k + 2];
        for (power, c) in last.iter().enumerate() {
            next[power + 1] = m.add(next[power + 1], *c);
        }
        subtract(m, &mut next, last, h[k][k]);
        let mut product = m.one();
        for i in (0..k).rev() {
            product = m.mul(product, h[i + 1][i]);
            if product == 0 {
                break;
            }
            let factor = m.mul(product, h[i][k]);
            if factor != 0 {
                subtract(m, &mut next, &all[i], factor);
            }
        }
        all.push(next);
    }
    Ok(all.pop().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::super::minors;
    use super::*;
    use liouville::proof::ProofRng;

    #[test]
    fn determinants_have_the_values_of_those_of_numbers() {
        let mut rng = ProofRng::new(8, 0);
        let m = rng.prime(&[], &[]);
        let halt = Halt::default();
        let ring = PrimePolynomials(m);
        for (size, degree, rank) in [(1, 1, 1), (5, 1, 5), (6, 1, 2), (4, 3, 4), (7, 2, 3)] {
            let mut matrix = |rank: usize| -> SquareMatrix {
                let row = |i: usize, rng: &mut ProofRng| -> Vec<u64> {
                    (0..size).map(|_| if i < rank { rng.element(&m) } else { 0 }).collect()
                };
                (0..size).map(|i| row(i, &mut rng)).collect()
            };
            let mut all = vec![matrix(size)];
            all.extend((0..degree).map(|_| matrix(rank)));
            let found = determinant(&m, &all, &halt).expect("not stopped").expect("regular");
            assert!(found.len() <= rank * degree + 1, "{found:?}");
            let value = |t: u64| {
                let entry = |i: usize, j: usize| {
                    all.iter().rev().fold(0, |sum, own| m.add(m.mul(sum, t), own[i][j]))
                };
                let rows = (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect();
                minors::determinant(&m, rows, &halt).expect("not stopped")
            };
            // Both are multiples of each other.
            let scale = m.mul(value(0), m.inverse(found[0]));
            for t in 0..20 {
                let t = m.integer(t);
                assert_eq!(value(t), m.mul(scale, ring.evaluate(&found, t)), "at {t}");
            }
        }
        let zero = vec![vec![0; 2]; 2];
        assert_eq!(determinant(&m, &[zero.clone(), zero], &halt).expect("not stopped"), None);
    }
}
