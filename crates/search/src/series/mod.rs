//! Truncated power series modulo a prime, the number domain in which a tape computes Taylor
//! coefficients.
//!
//! A series in a few variables is kept up to a total degree, its coefficients in graded order. With
//! θ = Σ x_i ∂/∂x_i, powers follow from a θp = q p θa, so that every operation is one pass over the
//! pairs of monomials.

mod functions;

use std::sync::Arc;

use rustc_hash::FxHashMap;

use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, Domain, UnaryFunction};

/// The domain of series in some variables up to some total degree, modulo a prime. A block is one
/// series; an empty block is undefined.
#[derive(Clone, Debug)]
pub struct TruncatedSeries {
    modulus: Modulus,
    monomials: Arc<MonomialTable>,
    /// Number of products that may be added up before their sum is reduced.
    most_products: u64,
    /// The integers up to the degree, and their inverses.
    integers: Vec<u64>,
    inverses: Vec<u64>,
}

/// The monomials up to some degree, and their products.
#[derive(Debug)]
struct MonomialTable {
    /// Exponents of each monomial, by increasing degree.
    exponents: Vec<Vec<u32>>,
    degrees: Vec<u32>,
    /// Number of monomials below each degree.
    below: Vec<usize>,
    /// Places of the products with each variable; those of too high a degree are left out.
    raised: Vec<Vec<u32>>,
    /// Places of the products of each monomial with all others whose degree leaves room.
    products: Vec<Vec<u32>>,
    /// Pairs of monomials whose product each monomial is.
    pairs: Vec<Vec<(u32, u32)>>,
}

impl MonomialTable {
    fn new(variables: usize, degree: u32) -> Self {
        let exponents: Vec<Vec<u32>> =
            (0..=degree).flat_map(|total| exponents(variables, total)).collect();
        let degrees: Vec<u32> = exponents.iter().map(|own| own.iter().sum()).collect();
        let below: Vec<usize> =
            (0..=degree + 1).map(|bound| degrees.partition_point(|own| *own < bound)).collect();
        let place: FxHashMap<&[u32], u32> =
            exponents.iter().enumerate().map(|(k, own)| (own.as_slice(), k as u32)).collect();
        let raised_by = |variable: usize| -> Vec<u32> {
            let of = |own: &Vec<u32>| {
                let mut raised = own.clone();
                raised[variable] += 1;
                place[raised.as_slice()]
            };
            exponents[..below[degree as usize]].iter().map(of).collect()
        };
        let raised: Vec<Vec<u32>> = (0..variables).map(raised_by).collect();
        let mut products: Vec<Vec<u32>> = Vec::with_capacity(exponents.len());
        for (own, total) in exponents.iter().zip(&degrees) {
            let others = below[(degree - total + 1) as usize];
            let product = match own.iter().position(|exponent| *exponent > 0) {
                None => (0..others as u32).collect(),
                // x_v m n from m n, which is known already.
                Some(variable) => {
                    let mut lower = own.clone();
                    lower[variable] -= 1;
                    let known = &products[place[lower.as_slice()] as usize][..others];
                    known.iter().map(|k| raised[variable][*k as usize]).collect()
                }
            };
            products.push(product);
        }
        let mut pairs = vec![Vec::new(); exponents.len()];
        for (i, row) in products.iter().enumerate() {
            for (j, k) in row.iter().enumerate() {
                pairs[*k as usize].push((i as u32, j as u32));
            }
        }
        Self { exponents, degrees, below, raised, products, pairs }
    }
}

/// Lists all exponents of `variables` variables with sum `total`, the greatest first entries first.
pub fn exponents(variables: usize, total: u32) -> Vec<Vec<u32>> {
    let Some(last) = variables.checked_sub(1) else {
        return if total == 0 { vec![Vec::new()] } else { Vec::new() };
    };
    let mut own = vec![0; variables];
    own[0] = total;
    let mut all = vec![own.clone()];
    // One moves on from the last entry before the end that has some, and takes the end along.
    while let Some(place) = own[..last].iter().rposition(|power| *power > 0) {
        let end = std::mem::take(&mut own[last]);
        own[place] -= 1;
        own[place + 1] = end + 1;
        all.push(own.clone());
    }
    all
}

impl TruncatedSeries {
    /// Makes the domain of series up to `degree`.
    pub fn new(modulus: Modulus, variables: usize, degree: u32) -> Self {
        let monomials = Arc::new(MonomialTable::new(variables, degree));
        let integers: Vec<u64> = (0..=u64::from(degree)).map(|n| modulus.integer(n)).collect();
        let inverses = integers.iter().map(|n| modulus.inverse(*n)).collect();
        let most_products = modulus.most_products();
        Self { modulus, monomials, most_products, integers, inverses }
    }

    /// Returns the monomials, by increasing degree.
    pub fn monomials(&self) -> &[Vec<u32>] {
        &self.monomials.exponents
    }

    /// Number of monomials of a degree below `bound`; they come first.
    pub fn count_below(&self, bound: u32) -> usize {
        let below = &self.monomials.below;
        below[(bound as usize).min(below.len() - 1)]
    }

    /// Returns the places of the products of the monomial at a place with those at the places 0, 1,
    /// …, as long as their degree is within the domain's.
    pub fn products_with(&self, place: usize) -> &[u32] {
        &self.monomials.products[place]
    }

    /// Returns the place of each monomial over x_k; `None` where x_k is not a factor.
    pub fn lowered(&self, k: usize) -> Vec<Option<usize>> {
        let mut lowered = vec![None; self.monomials().len()];
        for (place, raised) in self.monomials.raised[k].iter().enumerate() {
            lowered[*raised as usize] = Some(place);
        }
        lowered
    }

    /// Makes a constant series from a residue.
    pub fn number(&self, value: u64) -> Vec<u64> {
        let mut series = vec![0; self.monomials().len()];
        series[0] = value;
        series
    }

    /// Makes the series value + x_k.
    pub fn variable(&self, k: usize, value: u64) -> Vec<u64> {
        let mut series = self.number(value);
        if let Some(place) = self.monomials.raised[k].first() {
            series[*place as usize] = self.modulus.one();
        }
        series
    }

    /// Differentiates with respect to x_k, without the terms of the highest degree.
    pub fn derivative(&self, k: usize, series: &[u64]) -> Vec<u64> {
        let m = &self.modulus;
        let mut slope = vec![0; series.len()];
        for (place, raised) in self.monomials.raised[k].iter().enumerate() {
            let exponent = self.monomials()[place][k] + 1;
            slope[place] = m.mul(m.integer(u64::from(exponent)), series[*raised as usize]);
        }
        slope
    }

    /// Multiplies by an integer.
    pub fn multiple(&self, factor: u32, series: &[u64]) -> Vec<u64> {
        let factor = self.modulus.integer(u64::from(factor));
        series.iter().map(|x| self.modulus.mul(factor, *x)).collect()
    }

    fn product(&self, x: &[u64], y: &[u64]) -> Vec<u64> {
        let m = &self.modulus;
        let present = |x: &[u64]| x.iter().filter(|entry| **entry != 0).count();
        // Numbers and variables have one coefficient or two.
        let (x, y) = if present(x) <= present(y) { (x, y) } else { (y, x) };
        let mut wide = vec![0u128; x.len()];
        let terms = x.iter().zip(&self.monomials.products).filter(|(x, _)| **x != 0);
        for (count, (x, places)) in (1u64..).zip(terms) {
            for (y, place) in y.iter().zip(places) {
                let product = u128::from(*x).wrapping_mul(u128::from(*y));
                let sum = &mut wide[*place as usize];
                *sum = sum.wrapping_add(product);
            }
            if count.is_multiple_of(self.most_products) {
                wide.iter_mut().for_each(|sum| *sum = m.widened(m.reduced(*sum)));
            }
        }
        wide.into_iter().map(|sum| m.reduced(sum)).collect()
    }

    /// Computes x^q with the given constant term, by a θp = q p θa.
    fn raised(&self, a: &[u64], exponent: u64, first: u64) -> Option<Vec<u64>> {
        let m = &self.modulus;
        if a[0] == 0 {
            return None;
        }
        let inverse = m.inverse(a[0]);
        let MonomialTable { degrees, pairs, .. } = &*self.monomials;
        let slopes: Vec<u64> =
            a.iter().zip(degrees).map(|(a, n)| m.mul(*a, self.integers[*n as usize])).collect();
        let next = m.add(exponent, m.one());
        let mut p = self.number(first);
        for k in 1..p.len() {
            let degree = degrees[k] as usize;
            // The weight q deg i − deg j of a_i p_j is (q + 1) deg i − deg k.
            let (mut by_slopes, mut plain, mut pending) = (0u128, 0u128, 0);
            for (i, j) in pairs[k].iter().map(|(i, j)| (*i as usize, *j as usize)) {
                if i == 0 || a[i] == 0 {
                    continue;
                }
                if pending == self.most_products {
                    by_slopes = m.widened(m.reduced(by_slopes));
                    plain = m.widened(m.reduced(plain));
                    pending = 0;
                }
                pending += 1;
                let other = u128::from(p[j]);
                by_slopes = by_slopes.wrapping_add(u128::from(slopes[i]).wrapping_mul(other));
                plain = plain.wrapping_add(u128::from(a[i]).wrapping_mul(other));
            }
            let all = m.mul(self.integers[degree], m.reduced(plain));
            let sum = m.sub(m.mul(next, m.reduced(by_slopes)), all);
            p[k] = m.mul(m.mul(sum, inverse), self.inverses[degree]);
        }
        Some(p)
    }

    fn power_of(&self, a: &[u64], exponent: &Rational) -> Option<Vec<u64>> {
        use liouville::number::prime::{Prime, UNDEFINED};
        let image = self.modulus.rational(exponent)?;
        let mut first = [0u64];
        // The constant term is raised to the power in the field.
        Prime::new([self.modulus]).power(&[a[0]], exponent, &mut first);
        (first[0] != UNDEFINED).then(|| self.raised(a, image, first[0]))?
    }
}

impl Domain for TruncatedSeries {
    type Block = Vec<u64>;

    fn constant(&self, value: &Rational) -> Vec<u64> {
        self.modulus.rational(value).map_or(Vec::new(), |value| self.number(value))
    }

    fn values(&self, values: &[Rational]) -> Vec<u64> {
        values.first().map_or(Vec::new(), |value| self.constant(value))
    }

    fn unary(&self, function: UnaryFunction, x: &Vec<u64>, out: &mut Vec<u64>) {
        let m = &self.modulus;
        *out = match function {
            _ if x.is_empty() => Vec::new(),
            UnaryFunction::Neg => x.iter().map(|x| m.sub(0, *x)).collect(),
            UnaryFunction::Recip => {
                let minus = m.sub(0, m.one());
                match x[0] {
                    0 => Vec::new(),
                    first => self.raised(x, minus, m.inverse(first)).unwrap_or_default(),
                }
            }
            UnaryFunction::Sqrt => {
                let half = m.rational(&Rational::new(1, 2)).unwrap_or(0);
                let root = m.root(x[0]);
                root.and_then(|root| self.raised(x, half, root)).unwrap_or_default()
            }
            UnaryFunction::Abs => match m.is_square(x[0]) {
                true => x.clone(),
                false => x.iter().map(|x| m.sub(0, *x)).collect(),
            },
            UnaryFunction::Exp
            | UnaryFunction::Ln
            | UnaryFunction::Sin
            | UnaryFunction::Cos
            | UnaryFunction::Atan => Vec::new(),
        };
    }

    fn binary(&self, operation: BinaryOperation, x: &Vec<u64>, y: &Vec<u64>, out: &mut Vec<u64>) {
        let m = &self.modulus;
        let termwise = |f: &dyn Fn(u64, u64) -> u64| -> Vec<u64> {
            x.iter().zip(y).map(|(x, y)| f(*x, *y)).collect()
        };
        *out = match operation {
            _ if x.is_empty() || y.is_empty() => Vec::new(),
            BinaryOperation::Add => termwise(&|x, y| m.add(x, y)),
            BinaryOperation::Sub => termwise(&|x, y| m.sub(x, y)),
            BinaryOperation::Mul => self.product(x, y),
            BinaryOperation::Pow => Vec::new(),
        };
    }

    fn power(&self, x: &Vec<u64>, exponent: &Rational, out: &mut Vec<u64>) {
        *out = match x.is_empty() {
            true => Vec::new(),
            false => self.power_of(x, exponent).unwrap_or_default(),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn domain() -> TruncatedSeries {
        TruncatedSeries::new(Modulus::new(2_305_843_009_213_693_951), 2, 6)
    }

    #[test]
    fn exponents_are_in_descending_order() {
        let three = [[2, 0, 0], [1, 1, 0], [1, 0, 1], [0, 2, 0], [0, 1, 1], [0, 0, 2]];
        assert_eq!(exponents(3, 2), three);
        assert_eq!(exponents(1, 4), [[4]]);
        assert_eq!(exponents(2, 0), [[0, 0]]);
        assert_eq!(exponents(0, 0), [[0; 0]], "the product of nothing");
        assert_eq!(exponents(0, 1).len(), 0);
        assert_eq!(exponents(5, 6).len(), 210, "C(10, 4)");
    }

    #[test]
    fn operations_invert_each_other() {
        let d = domain();
        let m = d.modulus;
        let mut x = d.variable(0, m.integer(9));
        let y = d.variable(1, m.integer(5));
        x = d.product(&x, &y);
        let (mut inverse, mut root, mut cube) = (Vec::new(), Vec::new(), Vec::new());
        d.unary(UnaryFunction::Recip, &x, &mut inverse);
        assert_eq!(d.product(&x, &inverse), d.number(m.one()), "x (1/x) = 1");
        let square = d.product(&x, &x);
        d.unary(UnaryFunction::Sqrt, &square, &mut root);
        assert_eq!(d.product(&root, &root), square, "√s √s = s");
        d.power(&x, &Rational::from(3), &mut cube);
        assert_eq!(cube, d.product(&square, &x), "x³ = x² x");
    }

    #[test]
    fn the_geometric_series_comes_out() {
        let d = domain();
        let m = d.modulus;
        let mut series = Vec::new();
        let mut one_minus = d.variable(0, m.sub(0, m.one()));
        one_minus.iter_mut().for_each(|x| *x = m.sub(0, *x));
        d.unary(UnaryFunction::Recip, &one_minus, &mut series);
        for (monomial, coefficient) in d.monomials().iter().zip(&series) {
            let expected = if monomial[1] == 0 { m.one() } else { 0 };
            assert_eq!(*coefficient, expected, "1/(1 - x) = Σ xⁿ");
        }
    }
}
