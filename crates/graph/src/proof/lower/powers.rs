//! Powers and roots in a lowering: chains of square roots, roots of integers, roots of odd index.

use crate::graph::{Expr, Graph, Step};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;
use crate::proof::bounds::InputDistribution;
use crate::scalar::Scalar;

use super::Base;
use super::exponent::ExponentParts;
use super::lowering::Lowering;

impl Lowering<'_> {
    /// Computes the value at a place to a non-integer power.
    pub(super) fn power(
        &mut self,
        graph: &Graph,
        place: usize,
        exponent: &Rational,
        values: &[Option<Expr>],
    ) -> Option<Expr> {
        if let Step::Constant(constant) = graph.step(place) {
            let powers = self.numbers.powers(constant)?;
            let mut product = Expr::rational(&Rational::from(1));
            for (number, power) in powers {
                product *= self.number_root(number, &(exponent * &Rational::from(power)))?;
            }
            return Some(product);
        }
        let value = values[place]?;
        if let Some((base, length)) = self.link_of.get(&value).copied() {
            let shorter = Rational::new(1, 1i64.checked_shl(length)?);
            return self.root(base, &(exponent * &shorter));
        }
        let next = self.bases.len();
        let base = *self.base_of.entry(value).or_insert(next);
        if base == next {
            self.bases.push(Base {
                radicand: value,
                arguments: Vec::new(),
                first: self.place,
                links: Vec::new(),
            });
        }
        if !self.bases[base].arguments.contains(&place) {
            self.bases[base].arguments.push(place);
        }
        self.root(base, exponent)
    }

    /// Computes n^q for an integer n, given by its index.
    fn number_root(&mut self, number: usize, exponent: &Rational) -> Option<Expr> {
        let radicand = Expr::rational(&self.numbers.integer(number));
        let ExponentParts { whole, part, length, odd, j } = ExponentParts::of(exponent)?;
        let mut value = radicand.power(&Rational::from(whole));
        if part != 0 {
            value *= self.number_link(number, length).power(&Rational::from(part));
        }
        Some(value * self.odd_root(radicand, odd, j))
    }

    /// Returns the root of index 2^length of an integer.
    fn number_link(&mut self, number: usize, length: u32) -> Expr {
        let mut roots = self.number_roots.remove(&number).unwrap_or_default();
        while roots.len() < length as usize {
            let radicand = Expr::rational(&self.numbers.integer(number));
            let last = roots.last().copied().unwrap_or(radicand);
            roots.push(match (self.has_formal_numbers, roots.is_empty()) {
                // Both roots of an integer are drawn: what holds with rational coefficients does for each.
                (true, true) => {
                    self.input(InputDistribution::Sign) * radicand.apply(UnaryFunction::Sqrt)
                }
                (true, false) => self.input(InputDistribution::Uniform),
                (false, _) => last.apply(UnaryFunction::Sqrt),
            });
        }
        let value = roots[length as usize - 1];
        self.number_roots.insert(number, roots);
        value
    }

    /// Computes X^(j/m) for odd m.
    fn odd_root(&mut self, radicand: Expr, odd: i64, j: i64) -> Expr {
        if j == 0 {
            return Expr::rational(&Rational::from(1));
        }
        if !self.odd.contains(&(radicand, odd as u64)) {
            self.odd.push((radicand, odd as u64));
        }
        radicand.power(&Rational::new(1, odd)).power(&Rational::from(j))
    }

    /// Computes X^q for a base X: X^n, times a power of a link, times a power of a root of odd
    /// index.
    fn root(&mut self, base: usize, exponent: &Rational) -> Option<Expr> {
        let ExponentParts { whole, part, length, odd, j } = ExponentParts::of(exponent)?;
        let radicand = self.bases[base].radicand;
        let mut value = radicand.power(&Rational::from(whole));
        if part != 0 {
            value *= self.link(base, length).power(&Rational::from(part));
        }
        Some(value * self.odd_root(radicand, odd, j))
    }

    /// Returns the root of index 2^length of a base.
    fn link(&mut self, base: usize, length: u32) -> Expr {
        while self.bases[base].links.len() < length as usize {
            let Base { radicand, links, .. } = &self.bases[base];
            let last = links.last().map_or(*radicand, |(value, _)| *value);
            let sign = self.sources.len();
            let value = self.input(InputDistribution::Sign) * last.apply(UnaryFunction::Sqrt);
            self.bases[base].links.push((value, sign));
            let length = self.bases[base].links.len() as u32;
            self.link_of.insert(value, (base, length));
        }
        self.bases[base].links[length as usize - 1].0
    }
}
