//! Vectors of few components in f64.

/// Inner product.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Sum of a vector and a multiple of another.
pub fn plus(a: &[f64], factor: f64, b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| x + factor * y).collect()
}

/// Difference of two vectors.
pub fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    plus(a, -1.0, b)
}

/// Product of a matrix in the plane with a vector.
pub fn moved(matrix: &[[f64; 2]; 2], x: [f64; 2]) -> [f64; 2] {
    matrix.map(|row| row[0] * x[0] + row[1] * x[1])
}

/// Solution of the equation u x₀ + s x₁ = b in the plane.
pub fn split(u: [f64; 2], s: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let area = u[0] * s[1] - u[1] * s[0];
    [(b[0] * s[1] - b[1] * s[0]) / area, (u[0] * b[1] - u[1] * b[0]) / area]
}

/// Unit vector along a vector of the plane, with its length.
pub fn unit(x: [f64; 2]) -> ([f64; 2], f64) {
    let length = libm::hypot(x[0], x[1]);
    (x.map(|x| x / length), length)
}
