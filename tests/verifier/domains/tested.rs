//! Properties of number domains that the suite asks for: what may stand for an exact number, and
//! what may equal it.

use liouville::number::Domain;
use liouville::number::arb::{Approximation, ArbBall};
use liouville::number::ball::{Ball, Balls};
use liouville::number::double_double_ball::{DoubleDoubleBall, DoubleDoubleBalls};
use liouville::number::exact::Exact;
use liouville::number::float::Float;
use liouville::number::mixed::{Mixed, Number};
use liouville::number::prime::{Prime, UNDEFINED};
use liouville::number::quadratic::Quadratic;
use liouville::number::rational::Rational;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Pow, Signed, Zero};

use crate::common::{dyadic, exact, rational};

/// Properties of a domain that tests need besides its arithmetic.
pub trait Tested: Domain {
    /// Whether the block may be the image of the exact number, made from terms of size `scale`.
    fn stands_for(&self, block: &Self::Block, value: &BigRational, scale: &BigRational) -> bool;

    /// Whether two blocks may be the same number, as far as the domain shows; `scale` is the size
    /// of the terms from which they were made.
    fn may_equal(&self, a: &Self::Block, b: &Self::Block, scale: &BigRational) -> bool;

    /// Whether the first lane is defined.
    fn is_defined(&self, block: &Self::Block) -> bool;

    /// Whether the domain is ordered, so that negative numbers have no root.
    const ORDERED: bool = true;
    /// Whether the domain has moduli.
    const MODULI: bool = true;
    /// Whether the domain bounds its error.
    const ENCLOSES: bool = true;
    /// Whether the domain rounds, so that large and small numbers leave its range.
    const ROUNDS: bool = true;
}

fn within(value: &BigRational, mid: &BigRational, rad: &BigRational) -> bool {
    (value - mid).abs() <= *rad
}

/// Returns 2^power.
pub fn unit(power: i32) -> BigRational {
    BigRational::from_integer(BigInt::from(2)).pow(power)
}

impl Tested for Float<4> {
    const ENCLOSES: bool = false;

    fn stands_for(&self, block: &[f64; 4], value: &BigRational, scale: &BigRational) -> bool {
        // One operation on correctly rounded arguments; subnormal results lose more.
        within(value, &dyadic(block[0]), &(scale * unit(-50) + unit(-1070)))
    }

    fn may_equal(&self, a: &[f64; 4], b: &[f64; 4], scale: &BigRational) -> bool {
        within(&dyadic(a[0]), &dyadic(b[0]), &(scale * unit(-49) + unit(-1070)))
    }

    fn is_defined(&self, block: &[f64; 4]) -> bool {
        block[0].is_finite()
    }
}

impl Tested for Ball<4> {
    fn stands_for(&self, block: &Balls<4>, value: &BigRational, _: &BigRational) -> bool {
        within(value, &dyadic(block.mid[0]), &dyadic(block.rad[0]))
    }

    fn may_equal(&self, a: &Balls<4>, b: &Balls<4>, _: &BigRational) -> bool {
        let apart = (dyadic(a.mid[0]) - dyadic(b.mid[0])).abs();
        apart <= dyadic(a.rad[0]) + dyadic(b.rad[0])
    }

    fn is_defined(&self, block: &Balls<4>) -> bool {
        block.is_defined(0)
    }
}

fn midpoint(block: &DoubleDoubleBalls<4>) -> BigRational {
    dyadic(block.hi[0]) + dyadic(block.lo[0])
}

impl Tested for DoubleDoubleBall<4> {
    fn stands_for(
        &self,
        block: &DoubleDoubleBalls<4>,
        value: &BigRational,
        _: &BigRational,
    ) -> bool {
        within(value, &midpoint(block), &dyadic(block.rad[0]))
    }

    fn may_equal(
        &self,
        a: &DoubleDoubleBalls<4>,
        b: &DoubleDoubleBalls<4>,
        _: &BigRational,
    ) -> bool {
        (midpoint(a) - midpoint(b)).abs() <= dyadic(a.rad[0]) + dyadic(b.rad[0])
    }

    fn is_defined(&self, block: &DoubleDoubleBalls<4>) -> bool {
        block.is_defined(0)
    }
}

/// Returns midpoint and radius of an approximation.
pub fn interval(x: &Approximation) -> (BigRational, BigRational) {
    let (mantissa, exponent, radius) = x.parts();
    let unit = unit(i32::try_from(exponent).expect("a moderate exponent"));
    (
        BigRational::from_integer(mantissa.clone()) * &unit,
        BigRational::from_integer(radius.into()) * &unit,
    )
}

impl Tested for ArbBall {
    const ROUNDS: bool = false;

    fn stands_for(
        &self,
        block: &Option<Approximation>,
        value: &BigRational,
        _: &BigRational,
    ) -> bool {
        let (mid, rad) = interval(block.as_ref().expect("defined"));
        within(value, &mid, &rad)
    }

    fn may_equal(
        &self,
        a: &Option<Approximation>,
        b: &Option<Approximation>,
        _: &BigRational,
    ) -> bool {
        let (a, ra) = interval(a.as_ref().expect("defined"));
        let (b, rb) = interval(b.as_ref().expect("defined"));
        within(&a, &b, &(ra + rb))
    }

    fn is_defined(&self, block: &Option<Approximation>) -> bool {
        block.is_some()
    }
}

impl Tested for Exact {
    const ROUNDS: bool = false;

    fn stands_for(&self, block: &Option<Rational>, value: &BigRational, _: &BigRational) -> bool {
        *block == Some(rational(value))
    }

    fn may_equal(&self, a: &Option<Rational>, b: &Option<Rational>, _: &BigRational) -> bool {
        a == b
    }

    fn is_defined(&self, block: &Option<Rational>) -> bool {
        block.is_some()
    }
}

impl Tested for Prime<4> {
    const ORDERED: bool = false;
    const ROUNDS: bool = false;

    fn stands_for(&self, block: &[u64; 4], value: &BigRational, _: &BigRational) -> bool {
        // Roots are those that are themselves squares: of either sign.
        let (image, minus) = (self.constant(&rational(value)), self.constant(&rational(&-value)));
        (0..4).all(|lane| block[lane] == image[lane] || block[lane] == minus[lane])
    }

    fn may_equal(&self, a: &[u64; 4], b: &[u64; 4], _: &BigRational) -> bool {
        a == b
    }

    fn is_defined(&self, block: &[u64; 4]) -> bool {
        block.iter().all(|lane| *lane != UNDEFINED)
    }
}

impl Tested for Quadratic<4> {
    const ORDERED: bool = false;
    const MODULI: bool = false;
    const ROUNDS: bool = false;

    fn stands_for(&self, block: &[[u64; 2]; 4], value: &BigRational, _: &BigRational) -> bool {
        let (image, minus) = (self.constant(&rational(value)), self.constant(&rational(&-value)));
        (0..4).all(|lane| block[lane] == image[lane] || block[lane] == minus[lane])
    }

    fn may_equal(&self, a: &[[u64; 2]; 4], b: &[[u64; 2]; 4], _: &BigRational) -> bool {
        a == b
    }

    fn is_defined(&self, block: &[[u64; 2]; 4]) -> bool {
        block.iter().all(|lane| lane[0] != UNDEFINED)
    }
}

impl Tested for Mixed {
    const ROUNDS: bool = false;

    fn stands_for(&self, block: &Number, value: &BigRational, _: &BigRational) -> bool {
        let (mid, rad) = sides(block);
        within(value, &mid, &rad)
    }

    fn may_equal(&self, a: &Number, b: &Number, _: &BigRational) -> bool {
        let ((a, ra), (b, rb)) = (sides(a), sides(b));
        within(&a, &b, &(ra + rb))
    }

    fn is_defined(&self, block: &Number) -> bool {
        matches!(block, Number::Exact(_) | Number::Ball(_))
    }
}

/// Returns midpoint and radius of an exact or enclosed number.
fn sides(number: &Number) -> (BigRational, BigRational) {
    match number {
        Number::Exact(value) => (exact(&value.to_string()), BigRational::zero()),
        Number::Ball(ball) => interval(ball),
        Number::Nothing | Number::Doubtful => panic!("it has no value"),
    }
}
