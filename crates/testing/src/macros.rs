//! Macros that make fields, quantities and maps from expressions.

/// Makes a [`VectorField`](crate::VectorField) from an expression that is valid for every
/// scalar.
///
/// Values that the expression uses besides the state and items are listed after it with their
/// types, and cloned:
///
/// ```
/// use liouville_testing::VectorField;
/// use num_dual::DualNum;
///
/// fn euler_top<T: DualNum<Primitive = f64> + Copy>(omega: [T; 3], moments: [f64; 3]) -> [T; 3] {
///     let ([p, q, r], [a, b, c]) = (omega, moments);
///     [q * r * ((b - c) / a), r * p * ((c - a) / b), p * q * ((a - b) / c)]
/// }
///
/// let moments = [1.0, 2.0, 2.5];
/// let top = liouville_testing::field!(|x: [_; 3]| euler_top(x, moments), moments: [f64; 3]);
/// assert_eq!(top.rates([0.0, 2.0, 1.0]), [-1.0, 0.0, 0.0]);
/// ```
#[macro_export]
macro_rules! field {
    (|$x:ident: [_; $n:expr]| $body:expr $(, $name:ident: $kind:ty)* $(,)?) => {{
        struct Field {
            $($name: $kind,)*
        }
        impl $crate::VectorField<{ $n }> for Field {
            fn rates<T: $crate::scalar::Scalar>(&self, $x: [T; $n]) -> [T; $n] {
                $(let $name = ::core::clone::Clone::clone(&self.$name);)*
                $body
            }
        }
        Field { $($name: ::core::clone::Clone::clone(&$name),)* }
    }};
}

/// Makes a [`Quantity`](crate::Quantity) from an expression; see [`field!`](crate::field).
#[macro_export]
macro_rules! quantity {
    (|$x:ident: [_; $n:expr]| $body:expr $(, $name:ident: $kind:ty)* $(,)?) => {{
        struct Quantity {
            $($name: $kind,)*
        }
        impl $crate::Quantity<{ $n }> for Quantity {
            fn value<T: $crate::scalar::Scalar>(&self, $x: [T; $n]) -> T {
                $(let $name = ::core::clone::Clone::clone(&self.$name);)*
                $body
            }
        }
        Quantity { $($name: ::core::clone::Clone::clone(&$name),)* }
    }};
}

/// Makes an [`Involution`](crate::Involution) from an expression; see
/// [`field!`](crate::field).
#[macro_export]
macro_rules! involution {
    (|$x:ident: [_; $n:expr]| $body:expr $(, $name:ident: $kind:ty)* $(,)?) => {{
        struct Involution {
            $($name: $kind,)*
        }
        impl $crate::Involution<{ $n }> for Involution {
            fn image<T: $crate::scalar::Scalar>(&self, $x: [T; $n]) -> [T; $n] {
                $(let $name = ::core::clone::Clone::clone(&self.$name);)*
                $body
            }
        }
        Involution { $($name: ::core::clone::Clone::clone(&$name),)* }
    }};
}
