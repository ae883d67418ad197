//! Series of functions without values modulo a prime, whose value at the point is given.

use super::{MonomialTable, TruncatedSeries};

impl TruncatedSeries {
    /// Computes a^q with a constant exponent and the given constant term; `None` where a is 0 at the point.
    pub fn power_with(&self, a: &[u64], exponent: u64, first: u64) -> Option<Vec<u64>> {
        self.raised(a, exponent, first)
    }

    /// Computes e^a with the given constant term, by θe^a = e^a θa.
    pub fn exponential(&self, a: &[u64], first: u64) -> Vec<u64> {
        let mut p = self.number(first);
        for k in 1..p.len() {
            p[k] = self.next_along(k, a, &p);
        }
        p
    }

    /// Computes tan a/2 with the given constant term, from θ cos a = −sin a θa and θ sin a = cos a θa.
    pub fn half_angle(&self, a: &[u64], first: u64) -> Vec<u64> {
        let m = &self.modulus;
        let square = m.mul(first, first);
        let scale = m.add(m.one(), square);
        if scale == 0 {
            return Vec::new();
        }
        let scale = m.inverse(scale);
        let mut cosine = self.number(m.mul(m.sub(m.one(), square), scale));
        let mut sine = self.number(m.mul(m.add(first, first), scale));
        for k in 1..cosine.len() {
            let (c, s) = (self.next_along(k, a, &sine), self.next_along(k, a, &cosine));
            cosine[k] = m.sub(0, c);
            sine[k] = s;
        }
        cosine[0] = m.add(cosine[0], m.one());
        let minus = m.sub(0, m.one());
        let inverse = self.raised(&cosine, minus, m.inverse(cosine[0]));
        inverse.map_or(Vec::new(), |inverse| self.product(&sine, &inverse))
    }

    /// Coefficient k of the series y with θy = p θa, from those of p of lower degrees.
    fn next_along(&self, k: usize, a: &[u64], p: &[u64]) -> u64 {
        let m = &self.modulus;
        let MonomialTable { degrees, pairs, .. } = &*self.monomials;
        let mut sum = 0;
        for (i, j) in pairs[k].iter().map(|(i, j)| (*i as usize, *j as usize)) {
            if i != 0 && a[i] != 0 {
                let weight = self.integers[degrees[i] as usize];
                sum = m.add(sum, m.mul(weight, m.mul(a[i], p[j])));
            }
        }
        m.mul(sum, self.inverses[degrees[k] as usize])
    }
}

#[cfg(test)]
mod tests {
    use liouville::number::prime::Modulus;
    use liouville::number::{BinaryOperation, Domain};

    use super::*;

    #[test]
    fn functions_have_their_laws() {
        let d = TruncatedSeries::new(Modulus::new(2_305_843_009_213_693_951), 2, 6);
        let m = d.modulus;
        let (x, y) = (d.variable(0, m.integer(9)), d.variable(1, m.integer(5)));
        let mut sum = Vec::new();
        d.binary(BinaryOperation::Add, &x, &y, &mut sum);
        let one = |f: u64| d.number(m.integer(f));
        // e^x e^y = e^(x + y), and e^x has the slope e^x.
        let (a, b) = (d.exponential(&x, m.integer(3)), d.exponential(&y, m.integer(7)));
        assert_eq!(d.product(&a, &b), d.exponential(&sum, m.integer(21)));
        let below = d.count_below(6);
        assert_eq!(d.derivative(0, &a)[..below], a[..below]);
        // tan x/2 + tan y/2 = tan (x + y)/2 (1 − tan x/2 tan y/2), and the slope is (1 + tan²)/2.
        let (s, t) = (d.half_angle(&x, m.integer(3)), d.half_angle(&y, m.integer(7)));
        let value = m.mul(m.integer(10), m.inverse(m.sub(m.one(), m.integer(21))));
        let both = d.half_angle(&sum, value);
        let (mut left, mut right) = (Vec::new(), Vec::new());
        d.binary(BinaryOperation::Add, &s, &t, &mut left);
        d.binary(BinaryOperation::Sub, &one(1), &d.product(&s, &t), &mut right);
        assert_eq!(left, d.product(&both, &right));
        let twice = d.multiple(2, &d.derivative(0, &s));
        d.binary(BinaryOperation::Add, &one(1), &d.product(&s, &s), &mut right);
        assert_eq!(twice[..below], right[..below]);
        // (x^c)' x = c x^c.
        let c = m.integer(1234);
        let power = d.power_with(&x, c, m.integer(11)).expect("x is not 0 here");
        let scaled: Vec<u64> = power.iter().map(|own| m.mul(c, *own)).collect();
        assert_eq!(d.product(&x, &d.derivative(0, &power))[..below], scaled[..below]);
    }
}
