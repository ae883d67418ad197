//! Rules of a Taylor program with places in memory.

use crate::taylor::code::Place;
use crate::taylor::saturating::Saturating;
use liouville::number::rational::Rational;

/// A rule with rows replaced by their places in memory.
pub(crate) enum PlacedRule<T> {
    Sum,
    Theta,
    Recip(Place),
    Sqrt(Place),
    Exp(Place),
    Ln(Place),
    Sin {
        x: Place,
        cosine: Place,
    },
    Cos {
        x: Place,
        sine: Place,
    },
    Atan {
        x: Place,
        square: Place,
    },
    Power {
        x: Place,
        exponent: Rational,
        factor: T,
    },
    Saturating {
        function: Saturating,
        x: Place,
        slope: Place,
    },
    /// The constant of the operation, which is the sign of x.
    Sign(Place),
    /// 1 where |x| is below half of the number, and 0 elsewhere.
    Near(Place, f64),
    /// 1 where x is not positive, and 0 elsewhere.
    Void(Place),
}

impl<T> PlacedRule<T> {
    /// Whether the operation is a function with values everywhere, or one without, and no sum.
    pub(crate) fn is_function(&self, is_entire: bool) -> bool {
        let has_poles = matches!(
            self,
            PlacedRule::Recip(_)
                | PlacedRule::Sqrt(_)
                | PlacedRule::Ln(_)
                | PlacedRule::Power { .. }
        );
        let is_form = matches!(
            self,
            PlacedRule::Sum
                | PlacedRule::Theta
                | PlacedRule::Sign(_)
                | PlacedRule::Near(..)
                | PlacedRule::Void(_)
        );
        !is_form && has_poles != is_entire
    }

    /// Whether the operation is a sum of products.
    pub(crate) fn is_sum(&self) -> bool {
        matches!(self, PlacedRule::Sum)
    }
}
