//! Sums and products of f64 with the sign of their rounding error.

/// Adds a and b; returns the rounded sum and the sign of the error.
#[inline(always)]
pub fn sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    if !sum.is_finite() {
        // Beyond all numbers the error is unknown; an infinite end is exact.
        let is_end = a.is_infinite() || b.is_infinite();
        return (sum, if is_end { 0.0 } else { f64::NAN });
    }
    // Knuth's exact error of a sum.
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// Multiplies a and b; returns the rounded product and the sign of the error. 0 · ∞ is 0, since ∞
/// is not a number of an interval.
#[inline(always)]
pub fn product(a: f64, b: f64) -> (f64, f64) {
    if a == 0.0 || b == 0.0 {
        return (0.0, 0.0);
    }
    let product = a * b;
    if product.is_infinite() && (a.is_infinite() || b.is_infinite()) {
        return (product, 0.0);
    }
    (product, if has_exact_error(product) { a.mul_add(b, -product) } else { f64::NAN })
}

/// Whether the error of a product is known, if it is computed by one rounding: the product is finite
/// and not 0, and the error does not underflow.
#[inline(always)]
pub fn has_exact_error(product: f64) -> bool {
    product.is_finite() && product.abs() > 2.0 * f64::MIN_POSITIVE / f64::EPSILON
}

/// Returns the largest f64 known not to exceed the exact value.
#[inline(always)]
pub fn down((rounded, missing): (f64, f64)) -> f64 {
    if missing >= 0.0 { rounded } else { rounded.next_down() }
}

/// Returns the smallest f64 known not to lie below the exact value.
#[inline(always)]
pub fn up((rounded, missing): (f64, f64)) -> f64 {
    if missing <= 0.0 { rounded } else { rounded.next_up() }
}
