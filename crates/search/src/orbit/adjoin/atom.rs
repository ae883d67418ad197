//! Variables of a ring of polynomials: components of parameters and state, and functions of these.

use super::polynomial::RingPolynomial;

/// A variable of the ring.
#[derive(Clone, Debug)]
pub enum Atom {
    /// Component of a parameter.
    Parameter,
    /// Component of the state.
    State,
    /// Function of the parameters alone.
    Constant(Of),
    /// e^u with u independent of other arguments.
    Exponential(RingPolynomial),
    /// e^u as a product of powers of other exponentials, some negative.
    ExponentialOf(RingPolynomial, Vec<(usize, i64)>),
    /// sin u, where the next variable is cos u.
    Sine(RingPolynomial),
    /// cos u, where the variable before is sin u.
    Cosine(RingPolynomial),
    /// b^(1/n), where the next variable is its inverse.
    Root(RingPolynomial, u32),
    /// b^(−1/n), where the variable before is its inverse, if n > 1.
    Inverse(RingPolynomial, u32),
    /// ln b, with 1/b.
    Logarithm(RingPolynomial, RingPolynomial),
    /// atan u, with 1/(1 + u²).
    Arctangent(RingPolynomial, RingPolynomial),
    /// b^e with a constant e, with 1/b.
    Power(RingPolynomial, RingPolynomial, RingPolynomial),
}

/// A function of the parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Of {
    /// 1/b.
    Inverse(RingPolynomial),
    /// √b.
    Root(RingPolynomial),
    /// Another function, of which nothing is known but its name.
    Function(ConstantFunction, RingPolynomial),
}

/// A function of parameters that becomes a parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ConstantFunction {
    /// e^u.
    Exponential,
    /// sin u.
    Sine,
    /// cos u.
    Cosine,
    /// ln u.
    Logarithm,
    /// atan u.
    Arctangent,
    /// u^e.
    Power(RingPolynomial),
}
