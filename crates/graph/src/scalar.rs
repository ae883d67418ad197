//! Scalar types of fields, bodies and formulas.
//!
//! [`Scalar`] is num-dual's [`DualNum`] over f64 together with the few operations that a *recorded*
//! or an *exact* scalar needs and num-dual does not offer: constants that are exact rationals,
//! powers with exact exponents, |x|, and functions known only by their derivatives.

use num_dual::{Dual, DualNum};

use crate::graph::{Expanded, Side};
use crate::number::rational::Rational;

/// A function of one number of any type.
pub trait Function {
    /// Computes the value, with all derivatives that the number carries.
    fn at<T: Scalar>(&self, x: T) -> T;
}

/// A `Copy` number over which mechanics and formulas are evaluated: f64, the recording
/// `Expr`, and num-dual's `Dual` of either, nested to any depth.
pub trait Scalar: DualNum<Primitive = f64> + Copy {
    /// Returns the image of an exact constant.
    fn rational(value: &Rational) -> Self;

    /// Makes an undefined value, 1/0: proofs reject it, and it has no enclosure.
    fn undefined() -> Self {
        Self::zero().recip()
    }

    /// Notes that a system of equations is divided by this value, while a recording asks for such values.
    fn note_divisor(self) {}

    /// Applies a function, whose derivative need not exist where the argument does not move: √k has
    /// a value at k = 0, and no slope.
    fn applied(self, function: &impl Function) -> Self {
        function.at(self)
    }

    /// Computes `x^q` for a rational exponent, with derivative `q x^(q-1)`; x > 0 unless q is an
    /// integer.
    fn power(self, exponent: &Rational) -> Self;

    /// Computes `x^y` for x > 0, with derivative `x^y (y' ln x + y x'/x)`.
    fn power_of(self, exponent: Self) -> Self;

    /// Computes `|x|`, with derivative `x x'/|x|`; not differentiable at 0.
    fn modulus(self) -> Self;

    /// Computes `asin x = 2 atan(x/(1 + √(1 - x²)))`, also at ±1, with derivative `x'/√(1 - x²)`.
    fn arcsine(self) -> Self {
        let across = (Self::one() - self * self).sqrt();
        (self / (Self::one() + across)).atan() * Self::from(2.0)
    }

    /// Computes `tanh x`, with derivative `x'(1 - tanh² x)`.
    fn hyperbolic_tangent(self) -> Self {
        self.tanh()
    }

    /// Computes the angle of the point (x, self), `2 atan(y/(x + r))`, with derivative
    /// `(x y' - y x')/r²`.
    ///
    /// Undefined on the ray y = 0, x ≤ 0.
    fn angle_from(self, x: Self) -> Self {
        let r = (x * x + self * self).sqrt();
        (self / (x + r)).atan() * Self::from(2.0)
    }

    /// Makes a function Λ of `variable` with Λ' = `integrand` and an arbitrary constant.
    ///
    /// Only the derivative is used: dΛ = integrand · d variable. The value itself is a free symbol
    /// when recorded, and NaN at f64.
    fn antiderivative(integrand: Self, variable: Self) -> Self;

    /// Runs `build` so that its result is defined exactly where every operation in it is; a
    /// recorded scalar otherwise folds √x·√x to x.
    fn literally<R>(build: impl FnOnce() -> R) -> R {
        build()
    }

    /// Whether the value is 0 by its form, so that a recording has no operation for it.
    fn is_absent(&self) -> bool {
        false
    }

    /// Whether the value is known to be the same number for all inputs.
    fn is_number(&self) -> bool {
        false
    }

    /// Whether the value is known to exist for no inputs.
    fn is_never_defined(&self) -> bool {
        false
    }

    /// Whether a root or a fractional power was taken of what is 0 by its form.
    fn is_on_edge(&self) -> bool {
        false
    }

    /// Expands the value up to and including some order of a variable, an input that tends to 0 from
    /// one side; only recorded values have expansions.
    fn expanded(self, _: Self, _: Side, _: i32) -> Expanded<Self> {
        Expanded::Unknown
    }

    /// Computes the partial derivatives of values that are not 0 by their form, each with the place
    /// of its variable, in one sweep a value.
    ///
    /// `None` where the scalar does not know how its values were made, or the variables are not free
    /// inputs of the recording; dual numbers do it then.
    fn gradients_of(_: &[Self], _: &[Self]) -> Option<Vec<Vec<(usize, Self)>>> {
        None
    }

    /// Computes the derivatives of values along a direction of the variables, in one sweep; `None`
    /// as for [`gradients_of`](Scalar::gradients_of).
    fn derivatives_along(_: &[Self], _: &[Self], _: &[Self]) -> Option<Vec<Self>> {
        None
    }

    /// Computes ∂yᵢ/∂xᵢ of values y and variables x, in one sweep a value; `None` as for
    /// [`gradients_of`](Scalar::gradients_of).
    fn diagonal_of(_: &[Self], _: &[Self]) -> Option<Vec<Self>> {
        None
    }
}

impl Scalar for f64 {
    fn rational(value: &Rational) -> Self {
        value.to_f64().0
    }

    fn power(self, exponent: &Rational) -> Self {
        match exponent.to_integer().and_then(|n| i32::try_from(n).ok()) {
            Some(n) => self.powi(n),
            None => self.powf(exponent.to_f64().0),
        }
    }

    fn power_of(self, exponent: Self) -> Self {
        self.powf(exponent)
    }

    fn modulus(self) -> Self {
        self.abs()
    }

    fn antiderivative(_: Self, _: Self) -> Self {
        f64::NAN
    }
}

impl<T: Scalar> Scalar for Dual<T> {
    fn rational(value: &Rational) -> Self {
        Dual::from_re(T::rational(value))
    }

    fn note_divisor(self) {
        self.re.note_divisor();
    }

    fn applied(self, function: &impl Function) -> Self {
        match self.eps.is_absent() {
            true => Dual::new(self.re.applied(function), self.eps),
            false => function.at(self),
        }
    }

    fn power(self, exponent: &Rational) -> Self {
        if self.eps.is_absent() {
            return Dual::new(self.re.power(exponent), self.eps);
        }
        let one_less = exponent - &Rational::from(1);
        let slope = T::rational(exponent) * self.re.power(&one_less);
        Dual::new(self.re.power(exponent), self.eps * slope)
    }

    fn power_of(self, exponent: Self) -> Self {
        let value = self.re.power_of(exponent.re);
        // With a number for y there is a slope where x has no logarithm.
        if exponent.is_number() && !self.eps.is_absent() {
            let one_less = self.re.power_of(exponent.re - T::one());
            return Dual::new(value, exponent.re * one_less * self.eps);
        }
        let slope = match (self.eps.is_absent(), exponent.eps.is_absent()) {
            (true, true) => return Dual::new(value, self.eps),
            (true, false) => exponent.eps * self.re.ln(),
            (false, true) => exponent.re * self.eps / self.re,
            (false, false) => exponent.eps * self.re.ln() + exponent.re * self.eps / self.re,
        };
        Dual::new(value, value * slope)
    }

    fn modulus(self) -> Self {
        let value = self.re.modulus();
        // |q − q| is a constant, although |x| has no derivative at 0.
        let slope = if self.eps.is_absent() { self.eps } else { self.eps * self.re / value };
        Dual::new(value, slope)
    }

    fn arcsine(self) -> Self {
        if self.eps.is_absent() {
            return Dual::new(self.re.arcsine(), self.eps);
        }
        let slope = (T::one() - self.re * self.re).sqrt().recip();
        Dual::new(self.re.arcsine(), self.eps * slope)
    }

    fn hyperbolic_tangent(self) -> Self {
        let value = self.re.hyperbolic_tangent();
        Dual::new(value, self.eps * (T::one() - value * value))
    }

    fn angle_from(self, x: Self) -> Self {
        if self.eps.is_absent() && x.eps.is_absent() {
            return Dual::new(self.re.angle_from(x.re), self.eps);
        }
        let square = x.re * x.re + self.re * self.re;
        let slope = (x.re * self.eps - self.re * x.eps) / square;
        Dual::new(self.re.angle_from(x.re), slope)
    }

    fn antiderivative(integrand: Self, variable: Self) -> Self {
        Dual::new(T::antiderivative(integrand.re, variable.re), integrand.re * variable.eps)
    }

    fn literally<R>(build: impl FnOnce() -> R) -> R {
        T::literally(build)
    }

    fn is_absent(&self) -> bool {
        self.re.is_absent() && self.eps.is_absent()
    }

    fn is_number(&self) -> bool {
        self.re.is_number() && self.eps.is_absent()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn power_rules_agree_with_calculus() {
        let x = Dual::new(2.0, 1.0);
        let cube_root = x.power(&Rational::new(1, 3));
        assert!((cube_root.eps - 2f64.powf(-2.0 / 3.0) / 3.0).abs() < 1e-15, "d x^(1/3)");
        let tower = x.power_of(x);
        assert!((tower.eps - 4.0 * (2f64.ln() + 1.0)).abs() < 1e-14, "d x^x = x^x (ln x + 1)");
        let minus = Dual::new(-3.0, 1.0).modulus();
        assert_eq!((minus.re, minus.eps), (3.0, -1.0), "d |x| = sign x");
        let unknown = Dual::<f64>::antiderivative(Dual::new(5.0, 7.0), Dual::new(1.0, 2.0));
        assert_eq!(unknown.eps, 10.0, "dΛ = integrand · dx");
    }
}
