//! The error probability of Theorem 1 from degrees, heights and roots.

use crate::graph::Expr;

use super::{Certificate, DRAWS, PRIME_POINTS, PRIMES, Roots, TARGET, Trial};

/// Log₂ of the number of primes p = 3 mod 4 between 2^60 and 2^61, rounded down.
const POOL: f64 = 53.0;

impl Trial<'_> {
    /// Computes the bound that zeros at all points would give.
    pub(super) fn certificate(
        &self,
        outputs: &[Expr],
        roots: Roots<'_>,
        draws: u64,
    ) -> Option<Certificate> {
        let algebraic = self.algebraic;
        let (mut degree, mut height) = (0f64, 0f64);
        for output in outputs {
            let bound = self.bounds().at(algebraic.graph.place(*output))?;
            (degree, height) = (degree.max(bound.degree), height.max(bound.height));
        }
        let reached = match algebraic.odd.is_empty() {
            true => Vec::new(),
            false => algebraic.graph.reached(outputs.iter().copied()),
        };
        let odd = algebraic.odd.iter().filter(|(base, _)| reached[algebraic.graph.place(*base)]);
        let mask = algebraic.mask_of(outputs);
        Some(self.bounded(degree, height, odd, mask, roots, draws))
    }

    /// Computes the bound for the difference of any two values that are equal at all points of one
    /// block; `None` if it would not be below the target.
    pub fn of_differences(&self) -> Option<Certificate> {
        let (degree, height) = self.bounds().of_differences();
        let odd = self.algebraic.odd.iter();
        let bound = self.bounded(degree, height, odd, u128::MAX, Roots::default(), DRAWS);
        (bound.error_log2 < TARGET).then_some(bound)
    }

    fn bounded<'o>(
        &self,
        degree: f64,
        height: f64,
        odd: impl Iterator<Item = &'o (Expr, u64)>,
        mask: u128,
        roots: Roots<'_>,
        draws: u64,
    ) -> Certificate {
        let algebraic = self.algebraic;
        let (mut degree, mut count) = (degree, 0);
        for (_, index) in odd {
            degree *= *index as f64;
            count += 1;
        }
        for base in &algebraic.bases {
            let signs = base.links.iter().filter(|(_, sign)| mask & algebraic.bit(*sign) != 0);
            count += signs.count();
        }
        let numbers: u32 = algebraic.numbers.iter().map(|(_, length)| length).sum();
        count += numbers as usize;
        let is_met = |(sign, _): &&(usize, bool)| mask & algebraic.bit(*sign) != 0;
        let loose = roots.fixed.iter().filter(is_met).count();
        // Conjugates over the rationals multiply heights, as do all choices of dependent signs.
        let height = (height.max(1.0) + 1.0) * 2f64.powi((numbers as usize + loose) as i32);
        // Each condition at most halves the pool.
        let chains = algebraic.depth().saturating_sub(2) as usize;
        let conditions = algebraic.odd_indices().len() + algebraic.numbers.len() + chains;
        let pool = POOL - conditions as f64;
        let unlucky_prime = height / 60.0 * (-pool).exp2();
        let unlucky_points = (draws as f64 * degree * (-60f64).exp2()).powi(PRIME_POINTS as i32);
        // Union bound over the outputs: one nonzero output is enough.
        let error_log2 = PRIMES as f64 * (unlucky_prime + unlucky_points).log2();
        Certificate {
            primes: PRIMES,
            points: 0,
            draws: 0,
            degree,
            height,
            roots: count,
            error_log2: if error_log2.is_nan() { 0.0 } else { error_log2 },
        }
    }
}
