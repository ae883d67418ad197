//! Sizes that the components of a state have on a motion, and lengths of vectors measured by them.
//!
//! A shadow is near in all directions if it is near by the size of each component: one component
//! may count metres, and another seconds since a distant day. Sizes follow the motion. The norm in
//! which growth is measured does not: it would take the change of a size for growth.

use liouville::number::double_double::DoubleDouble;

/// Factor by which the size of a component is forgotten at each step: a few steps span an
/// oscillation, so that a zero of a component does not count as its size.
const FORGOTTEN: f64 = 0.5;

/// Sizes of the components of a state at the present place, and the vector to a nearby one.
pub struct Reach {
    sizes: Vec<f64>,
    /// Sizes in which growth is measured.
    norm: Vec<f64>,
    /// Length in that norm of the vector that was put last.
    length: f64,
}

impl Reach {
    /// Sizes at a state.
    pub fn new(state: &[DoubleDouble]) -> Self {
        let sizes: Vec<f64> = state.iter().map(|x| x.hi.abs()).collect();
        let mut reach = Self { sizes, norm: Vec::new(), length: 1.0 };
        reach.fix_norm();
        reach
    }

    /// Whether no component has a size.
    pub fn is_empty(&self) -> bool {
        self.sizes.iter().all(|size| !is_size(*size))
    }

    /// Records a state on the way.
    pub fn visit(&mut self, state: &[DoubleDouble]) {
        for (size, x) in self.sizes.iter_mut().zip(state) {
            *size = x.hi.abs().max(FORGOTTEN * *size);
        }
    }

    /// Sizes of all components. One that is 0 has the least of the others: it may be driven by any.
    pub fn scales(&self) -> Vec<f64> {
        let known = || self.sizes.iter().copied().filter(|size| is_size(*size));
        let least = known().reduce(f64::min).unwrap_or(1.0);
        self.sizes.iter().map(|size| if is_size(*size) { *size } else { least }).collect()
    }

    /// Measures growth by the present sizes from now on.
    pub fn fix_norm(&mut self) {
        self.norm = self.scales();
    }

    /// Length of a vector by the present sizes.
    pub fn distance(&self, vector: &[f64]) -> f64 {
        length(vector, &self.scales())
    }

    /// Notes the vector to a nearby state, from which growth is measured.
    pub fn put(&mut self, vector: &[f64]) {
        self.length = length(vector, &self.norm);
    }

    /// Growth of that vector to the present one.
    pub fn growth(&self, vector: &[f64]) -> f64 {
        length(vector, &self.norm) / self.length
    }
}

/// Whether shares of a size are numbers.
fn is_size(size: f64) -> bool {
    size.is_normal()
}

/// Length of a vector whose components are divided by these scales.
fn length(vector: &[f64], scales: &[f64]) -> f64 {
    let shares = || vector.iter().zip(scales).map(|(x, scale)| (x / scale).abs());
    match shares().fold(0.0, f64::max) {
        0.0 => 0.0,
        // Squares of small shares underflow.
        largest => largest * shares().map(|x| (x / largest) * (x / largest)).sum::<f64>().sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(values: &[f64]) -> Vec<DoubleDouble> {
        values.iter().map(|x| DoubleDouble::from_f64(*x)).collect()
    }

    #[test]
    fn lengths_are_shares_of_each_component() {
        let reach = Reach::new(&state(&[1e8, 2.0, 0.0]));
        assert_eq!(reach.scales(), [1e8, 2.0, 2.0], "a component without a size");
        assert!((reach.distance(&[3.0, 4e-6, 0.0]) - 2e-6).abs() < 1e-7, "not 3");
    }

    #[test]
    fn sizes_are_forgotten_and_growth_is_measured_in_one_norm() {
        let mut reach = Reach::new(&state(&[1e3, 1.0]));
        reach.put(&[1e-3, 1e-6]);
        for _ in 0..20 {
            reach.visit(&state(&[1.0, 1.0]));
        }
        assert_eq!(reach.scales(), [1.0, 1.0], "the far start is forgotten");
        let growth = reach.growth(&[1e-3, 1e-6]);
        assert!((growth - 1.0).abs() < 1e-12, "a vector that did not change: {growth}");
    }
}
