//! Tests of residues, roots and primality.

use super::*;

const MERSENNE: u64 = (1 << 61) - 1;

#[test]
fn primes_are_told_from_the_rest() {
    let small: Vec<u64> = (0..50).filter(|n| is_prime(*n)).collect();
    assert_eq!(small, [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47]);
    assert!(is_prime(MERSENNE), "2^61 - 1");
    let mut sieve = vec![true; 100_000];
    for n in 2..317 {
        (n * n..sieve.len()).step_by(n).for_each(|multiple| sieve[multiple] = false);
    }
    let wrong = (2..sieve.len()).find(|n| is_prime(*n as u64) != sieve[*n]);
    assert_eq!(wrong, None, "the sieve of Eratosthenes knows better");
    // A strong pseudoprime to the first nine bases, and a Carmichael number.
    assert!(!is_prime(3_825_123_056_546_413_051), "149491 · 747451 · 34233211");
    assert!(!is_prime(2_147_483_647 * 1_073_741_789), "(2^31 - 1)(2^30 - 35)");
    assert!(!is_prime(561), "3 · 11 · 17");
}

#[test]
fn many_inverses_take_one_inversion() {
    let moduli = [3, 5, 7, 11].map(|n| Modulus::new((1u64 << 61) - if n > 5 { 1 } else { 31 }));
    let x = [12, UNDEFINED, 0, 5];
    let mut out = [0; 4];
    Prime::new(moduli).unary(UnaryFunction::Recip, &x, &mut out);
    assert_eq!(out[1..3], [UNDEFINED; 2], "of nothing, and of 0");
    for lane in [0, 3] {
        let product = moduli[lane].mul(x[lane], out[lane]);
        assert_eq!(product, moduli[lane].one(), "x · 1/x in lane {lane}");
    }
}

#[test]
fn residues_compute() {
    let m = Modulus::new(MERSENNE);
    let third = m.rational(&Rational::new(1, 3)).expect("3 is a unit");
    assert_eq!(m.mul(third, m.integer(3)), m.one(), "1/3 · 3");
    assert_eq!(m.to_integer(m.sub(0, m.integer(5))), MERSENNE - 5, "-5");
    assert_eq!(m.rational(&Rational::from(-5)), Some(m.sub(0, m.integer(5))), "-5 again");
    let zero: Rational = MERSENNE.to_string().parse().expect("a number");
    assert_eq!(m.rational(&zero), Some(0), "p is 0");
    assert_eq!(m.rational(&zero.recip().expect("not 0")), None, "1/p is nothing");
    let large: Rational = "123456789012345678901234567890/7".parse().expect("a number");
    let by_hand = 123456789012345678901234567890u128 % u128::from(MERSENNE);
    let image = m.rational(&large).map(|x| m.to_integer(m.mul(x, m.integer(7))));
    assert_eq!(image, Some(by_hand as u64), "large parts are reduced");
}

#[test]
fn roots_are_squares_and_multiply() {
    let m = Modulus::new(MERSENNE);
    let (mut roots, mut none) = (0, 0);
    for n in 1..200u64 {
        let x = m.integer(n * n * n + 7);
        match m.root(x) {
            Some(root) => {
                assert_eq!(m.mul(root, root), x, "√x √x = x");
                assert!(m.is_square(root), "the root is a square itself");
                roots += 1;
            }
            None => {
                assert!(!m.is_square(x), "no square, no root");
                assert!(m.is_square(m.sub(0, x)), "then -x is one, as p = 3 mod 4");
                none += 1;
            }
        }
    }
    assert!(roots > 50 && none > 50, "half of all elements are squares");
    assert_eq!(m.root(0), None, "√0 is refused: it has no sign");
    assert_eq!(m.root(m.integer(3)), None, "3 is no square mod 2^61 - 1");
}

#[test]
fn squares_have_roots_modulo_other_primes_too() {
    for (modulus, rest) in [(8, 5), (16, 9), (840, 1), (1 << 20, 1)] {
        let start = (1u64 << 60) / modulus * modulus + rest;
        let prime =
            (start..).step_by(modulus as usize).find(|p| is_prime(*p)).expect("there is one");
        let m = Modulus::new(prime);
        for n in 1..200 {
            let x = m.integer(n * n * n + 7);
            assert_eq!(m.root(x).is_some(), m.is_square(x), "{n} modulo {prime}");
            if let Some(root) = m.root(x) {
                assert_eq!(m.mul(root, root), x, "{n} modulo {prime}");
            }
        }
        assert_eq!(m.root(0), None, "√0 is refused here too");
        assert!(m.root(m.sub(0, m.one())).is_some(), "√−1 exists");
    }
}

#[test]
fn roots_of_odd_index_need_a_suitable_prime() {
    // 2^61 - 2 is divisible by 3, so cube roots are not unique there.
    let x = Modulus::new(MERSENNE).integer(4);
    assert_eq!(Modulus::new(MERSENNE).odd_power(x, &Rational::new(1, 3)), None);
    let prime = (1u64 << 60..).find(|p| p % 12 == 11 && is_prime(*p)).expect("there is one");
    let m = Modulus::new(prime);
    for n in 1..50 {
        let root = m.odd_power(m.integer(n), &Rational::new(2, 3)).expect("it is not 0");
        assert_eq!(m.power(root, 3), m.integer(n * n), "({n}^(2/3))³ = {n}²");
    }
    let half = m.odd_power(m.integer(4), &Rational::new(1, 2));
    assert_eq!(half, None, "the root of even index has two signs");
}

#[test]
fn sums_of_products_are_reduced_late() {
    for prime in [(1u64 << 61) - 1, 4_611_686_018_427_387_847, 1_000_003] {
        let m = Modulus::new(prime);
        let numbers: Vec<u64> = (1..20u64).map(|k| m.sub(0, m.integer(k * k * 77))).collect();
        for pairs in numbers.windows(8) {
            let (mut late, mut early) = (m.widened(numbers[3]), numbers[3]);
            for pair in pairs.chunks(2) {
                late += u128::from(pair[0]) * u128::from(pair[1]);
                early = m.add(early, m.mul(pair[0], pair[1]));
            }
            assert_eq!(m.reduced(late), early, "modulo {prime}");
        }
        let (greatest, count) = (prime - 1, m.most_products().min(1000));
        assert!(count >= 4, "four products fit for any prime");
        let square = u128::from(greatest) * u128::from(greatest);
        let most = m.widened(greatest) + square * u128::from(count);
        let expected = (0..count).fold(greatest, |sum, _| m.add(sum, m.mul(greatest, greatest)));
        assert_eq!(m.reduced(most), expected, "the largest residues modulo {prime}");
        let longest = (2 * count + 3) as usize;
        for row in [vec![greatest; longest], numbers.clone(), numbers[..1].to_vec(), Vec::new()] {
            let other: Vec<u64> = row.iter().enumerate().map(|(k, x)| x - k as u64 % 5).collect();
            let reversed: Vec<u64> = other.iter().rev().copied().collect();
            let pairs = row.iter().zip(&reversed);
            let expected = pairs.fold(0, |sum, (x, y)| m.add(sum, m.mul(*x, *y)));
            assert_eq!(m.convolved(&row, &other), expected, "{} modulo {prime}", row.len());
            assert_eq!(m.dot(&row, &reversed), expected, "{} modulo {prime}", row.len());
        }
        for (k, inverse) in m.inverses_up_to(500).into_iter().enumerate() {
            assert_eq!(inverse, m.inverse(m.integer(k as u64)), "1/{k} modulo {prime}");
        }
        assert_eq!(m.inverse(0), 0, "modulo {prime}");
        let powers = (0..64).map(|k| (1u64 << k) % prime).filter(|x| *x != 0);
        let extremes = powers.flat_map(|x| [x, prime - x]);
        for x in numbers.into_iter().chain(extremes) {
            assert_eq!(m.mul(x, m.inverse(x)), m.one(), "x/x modulo {prime}");
            assert_eq!(m.inverse(x), m.power(x, prime - 2), "as by Fermat modulo {prime}");
        }
    }
}
