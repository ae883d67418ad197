//! Truncated power series modulo a prime, the number domain in which a tape computes Taylor
//! coefficients.
//!
//! A series in a few variables is kept up to a total degree, its coefficients in graded order. With
//! θ = Σ x_i ∂/∂x_i, powers follow from a θp = q p θa, so that every operation is one pass over the
//! pairs of monomials.

use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, Domain, UnaryFunction};

/// The domain of series in some variables up to some total degree, modulo a prime. A block is one
/// series; an empty block is undefined.
#[derive(Clone, Debug)]
pub struct TruncatedSeries {
    modulus: Modulus,
    /// Exponents of each monomial, by increasing degree.
    monomials: Vec<Vec<u32>>,
    /// Pairs of monomials whose product each monomial is.
    pairs: Vec<Vec<(u32, u32)>>,
    degrees: Vec<u64>,
}

/// Lists all exponents of `variables` variables with sum `total`.
pub fn exponents(variables: usize, total: u32) -> Vec<Vec<u32>> {
    match variables {
        0 => {
            if total == 0 {
                vec![Vec::new()]
            } else {
                Vec::new()
            }
        }
        1 => vec![vec![total]],
        _ => (0..=total)
            .rev()
            .flat_map(|first| {
                exponents(variables - 1, total - first).into_iter().map(move |mut rest| {
                    rest.insert(0, first);
                    rest
                })
            })
            .collect(),
    }
}

impl TruncatedSeries {
    /// Makes the domain of series up to `degree`.
    pub fn new(modulus: Modulus, variables: usize, degree: u32) -> Self {
        let monomials: Vec<Vec<u32>> =
            (0..=degree).flat_map(|total| exponents(variables, total)).collect();
        let place: rustc_hash::FxHashMap<&[u32], u32> =
            monomials.iter().enumerate().map(|(k, m)| (m.as_slice(), k as u32)).collect();
        let mut pairs = vec![Vec::new(); monomials.len()];
        for (i, a) in monomials.iter().enumerate() {
            for (j, b) in monomials.iter().enumerate() {
                let sum: Vec<u32> = a.iter().zip(b).map(|(a, b)| a + b).collect();
                if let Some(k) = place.get(sum.as_slice()) {
                    pairs[*k as usize].push((i as u32, j as u32));
                }
            }
        }
        let degrees = monomials.iter().map(|m| m.iter().map(|e| u64::from(*e)).sum()).collect();
        Self { modulus, monomials, pairs, degrees }
    }

    /// Returns the monomials, by increasing degree.
    pub fn monomials(&self) -> &[Vec<u32>] {
        &self.monomials
    }

    /// Makes a constant series from a residue.
    pub fn number(&self, value: u64) -> Vec<u64> {
        let mut series = vec![0; self.monomials.len()];
        series[0] = value;
        series
    }

    /// Makes the series value + x_k.
    pub fn variable(&self, k: usize, value: u64) -> Vec<u64> {
        let mut series = self.number(value);
        if let Some(place) = self
            .monomials
            .iter()
            .position(|m| m.iter().enumerate().all(|(i, e)| *e == u32::from(i == k)))
        {
            series[place] = self.modulus.one();
        }
        series
    }

    /// Differentiates with respect to x_k, without the terms of the highest degree.
    pub fn derivative(&self, k: usize, series: &[u64]) -> Vec<u64> {
        let m = &self.modulus;
        let place: rustc_hash::FxHashMap<&[u32], usize> =
            self.monomials.iter().enumerate().map(|(j, e)| (e.as_slice(), j)).collect();
        let of = |monomial: &Vec<u32>| {
            let mut raised = monomial.clone();
            raised[k] += 1;
            let from = place.get(raised.as_slice());
            from.map_or(0, |j| m.mul(m.integer(u64::from(raised[k])), series[*j]))
        };
        self.monomials.iter().map(of).collect()
    }

    /// Multiplies by an integer.
    pub fn multiple(&self, factor: u32, series: &[u64]) -> Vec<u64> {
        let factor = self.modulus.integer(u64::from(factor));
        series.iter().map(|x| self.modulus.mul(factor, *x)).collect()
    }

    fn product(&self, x: &[u64], y: &[u64]) -> Vec<u64> {
        let m = &self.modulus;
        let term = |(i, j): &(u32, u32)| m.mul(x[*i as usize], y[*j as usize]);
        self.pairs.iter().map(|pairs| pairs.iter().fold(0, |s, p| m.add(s, term(p)))).collect()
    }

    /// Computes x^q with the given constant term, by a θp = q p θa.
    fn raised(&self, a: &[u64], exponent: u64, first: u64) -> Option<Vec<u64>> {
        let m = &self.modulus;
        if a[0] == 0 {
            return None;
        }
        let inverse = m.inverse(a[0]);
        let mut p = self.number(first);
        for k in 1..p.len() {
            let mut sum = 0;
            for (i, j) in &self.pairs[k] {
                if *i != 0 {
                    let (i, j) = (*i as usize, *j as usize);
                    let weight = m.sub(
                        m.mul(exponent, m.integer(self.degrees[i])),
                        m.integer(self.degrees[j]),
                    );
                    sum = m.add(sum, m.mul(weight, m.mul(a[i], p[j])));
                }
            }
            let degree = m.inverse(m.integer(self.degrees[k]));
            p[k] = m.mul(m.mul(sum, inverse), degree);
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
        for (monomial, coefficient) in d.monomials.iter().zip(&series) {
            let expected = if monomial[1] == 0 { m.one() } else { 0 };
            assert_eq!(*coefficient, expected, "1/(1 - x) = Σ xⁿ");
        }
    }
}
