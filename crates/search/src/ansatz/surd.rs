//! Sums a + b √n + c √m + … over whole numbers from their images modulo a prime, or a product of primes.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// Number of exchanges after which a basis is given up.
const ROUNDS: usize = 20_000;

/// Whole numbers a₀, a₁, …, d with d > 0 and d c = a₀ + Σ a_k r_k modulo M, all far below the root of M of
/// the order of their number; they are unique up to a factor where they exist.
pub fn surd(residue: &BigInt, roots: &[BigInt], modulus: &BigInt) -> Option<Vec<BigInt>> {
    let width = roots.len() + 2;
    // A vector of this length is there by chance once in 2¹², or less often.
    let bound = modulus.nth_root(width as u32) >> 4u32;
    if bound.is_zero() {
        return None;
    }
    // The lattice of all (a₀, a₁, …, d) with a₀ + Σ a_k r_k − d c = 0 modulo M.
    let row = |first: BigInt, place: usize| {
        let mut own = vec![BigInt::ZERO; width];
        own[0] = first;
        if place > 0 {
            own[place] = BigInt::one();
        }
        own
    };
    let mut basis = vec![row(modulus.clone(), 0)];
    basis.extend(roots.iter().enumerate().map(|(k, root)| row(-root, k + 1)));
    basis.push(row(residue.clone(), width - 1));
    let basis = reduced(basis)?;
    let shortest = basis.into_iter().min_by_key(|own| product(own, own))?;
    let is_short = shortest.iter().all(|entry| entry.abs() <= bound);
    let last = &shortest[width - 1];
    let sign = if last.is_negative() { -1 } else { 1 };
    (is_short && !last.is_zero()).then(|| shortest.iter().map(|entry| entry * sign).collect())
}

fn product(a: &[BigInt], b: &[BigInt]) -> BigInt {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Reduces a basis by the algorithm of Lenstra, Lenstra and Lovász, with whole numbers alone (Cohen, A
/// Course in Computational Algebraic Number Theory, 2.6.7).
fn reduced(mut basis: Vec<Vec<BigInt>>) -> Option<Vec<Vec<BigInt>>> {
    let count = basis.len();
    // Determinants of the first vectors' products, from that of none on.
    let mut minors = vec![BigInt::one(); count + 1];
    let mut slopes = vec![vec![BigInt::ZERO; count]; count];
    for k in 0..count {
        for j in 0..=k {
            let mut own = product(&basis[k], &basis[j]);
            for i in 0..j {
                own = (&minors[i + 1] * own - &slopes[k][i] * &slopes[j][i]) / &minors[i];
            }
            match j == k {
                true => minors[k + 1] = own,
                false => slopes[k][j] = own,
            }
        }
        if minors[k + 1].is_zero() {
            return None;
        }
    }
    let (mut k, mut rounds) = (1, 0);
    while k < count {
        shorten(&mut basis, &minors, &mut slopes, k, k - 1);
        let slope = slopes[k][k - 1].clone();
        let new = &minors[k + 1] * &minors[k - 1] + &slope * &slope;
        if 4 * &new < 3 * &minors[k] * &minors[k] {
            rounds += 1;
            if rounds > ROUNDS {
                return None;
            }
            basis.swap(k, k - 1);
            let (before, after) = slopes.split_at_mut(k);
            before[k - 1][..k - 1].swap_with_slice(&mut after[0][..k - 1]);
            let minor = new / &minors[k];
            for own in &mut slopes[k + 1..] {
                let last = own[k].clone();
                own[k] = (&minors[k + 1] * &own[k - 1] - &slope * &last) / &minors[k];
                own[k - 1] = (&minor * last + &slope * &own[k]) / &minors[k + 1];
            }
            minors[k] = minor;
            k = (k - 1).max(1);
        } else {
            for j in (0..k - 1).rev() {
                shorten(&mut basis, &minors, &mut slopes, k, j);
            }
            k += 1;
        }
    }
    Some(basis)
}

/// Subtracts the multiple of an earlier vector that leaves least of its direction.
fn shorten(
    basis: &mut [Vec<BigInt>],
    minors: &[BigInt],
    slopes: &mut [Vec<BigInt>],
    k: usize,
    j: usize,
) {
    let twice: BigInt = 2 * &slopes[k][j] + &minors[j + 1];
    let multiple = twice.div_floor(&(2 * &minors[j + 1]));
    if multiple.is_zero() {
        return;
    }
    let (before, after) = basis.split_at_mut(k);
    after[0].iter_mut().zip(&before[j]).for_each(|(x, own)| *x -= &multiple * own);
    let (before, after) = slopes.split_at_mut(k);
    after[0][j] -= &multiple * &minors[j + 1];
    after[0].iter_mut().zip(&before[j]).take(j).for_each(|(x, own)| *x -= &multiple * own);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surds_come_from_their_images() {
        // p = 7 mod 8: 2 is a square.
        let p: BigInt = (BigInt::one() << 61u32) - 1u32;
        let root = BigInt::from(2).modpow(&((&p + 1u32) / 4u32), &p);
        assert_eq!((&root * &root).mod_floor(&p), BigInt::from(2));
        for (a, b, d) in [(1, 1, 1), (3, -7, 5), (0, 1, 2), (-1200, 911, 640), (5, 0, 3)] {
            let inverse = BigInt::from(d).modinv(&p).expect("prime");
            let image: BigInt = (BigInt::from(a) + BigInt::from(b) * &root) * inverse;
            let image = image.mod_floor(&p);
            let expected = [a, b, d].map(BigInt::from).to_vec();
            assert_eq!(
                surd(&image, std::slice::from_ref(&root), &p),
                Some(expected),
                "{a} + {b} √2"
            );
        }
        let none = BigInt::from(1_234_567_890_123_456_789u64);
        assert_eq!(surd(&none, &[root], &p), None, "a random number is none");
    }
    #[test]
    fn sums_of_several_roots_come_from_their_images() {
        // p = 23 mod 24: 2 and 3 are squares, and p² is the modulus of two images that agree.
        let p: BigInt = (BigInt::one() << 61u32) - 9u32;
        let p = (0..).map(|k| &p - 24u32 * k).find(|own| {
            let is_square = |n: u32| {
                let root = BigInt::from(n).modpow(&((own + 1u32) / 4u32), own);
                (&root * &root).mod_floor(own) == BigInt::from(n)
            };
            own.mod_floor(&BigInt::from(4)) == BigInt::from(3) && is_square(2) && is_square(3)
        });
        let p = p.expect("one of them");
        let root = |n: u32| BigInt::from(n).modpow(&((&p + 1u32) / 4u32), &p);
        let roots = [root(2), root(3), (root(2) * root(3)).mod_floor(&p)];
        for own in [[1, 1, 1, 1, 1], [0, 3, -2, 5, 7], [-4, 0, 0, 1, 6], [9, -11, 0, 0, 1]] {
            let own = own.map(BigInt::from);
            let inverse = own[4].modinv(&p).expect("prime");
            let sum = &own[0] + &own[1] * &roots[0] + &own[2] * &roots[1] + &own[3] * &roots[2];
            let image = (sum * inverse).mod_floor(&p);
            assert_eq!(surd(&image, &roots, &p), Some(own.to_vec()));
        }
        let none = BigInt::from(1_234_567_890_123_456_789u64);
        assert_eq!(surd(&none, &roots, &p), None, "a random number is none");
    }
}
