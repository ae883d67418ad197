//! Sizes that the components of a state have on a motion, and the distance of a shadow measured by them.
//!
//! A shadow is near in all directions if it is near by the size of each component: one component
//! may count metres, and another seconds since a distant day. Growth is measured in the plain norm.

use liouville::number::double_double::DoubleDouble;

/// Factor by which the size of a component is forgotten at each step: a few steps span an
/// oscillation, so that a zero of a component does not count as its size.
const FORGOTTEN: f64 = 0.5;

/// Sizes of the components of a state at the present place, and the vector to a nearby one.
pub struct Reach {
    sizes: Vec<f64>,
    /// Length of the vector that was put last.
    length: f64,
}

impl Reach {
    /// Sizes at a state.
    pub fn new(state: &[DoubleDouble]) -> Self {
        Self { sizes: state.iter().map(|x| x.hi.abs()).collect(), length: 1.0 }
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
    fn scales(&self) -> Vec<f64> {
        let known = || self.sizes.iter().copied().filter(|size| is_size(*size));
        let least = known().reduce(f64::min).unwrap_or(1.0);
        self.sizes.iter().map(|size| if is_size(*size) { *size } else { least }).collect()
    }

    /// Length of a vector by the present sizes.
    pub fn distance(&self, vector: &[f64]) -> f64 {
        let shares = vector.iter().zip(self.scales()).map(|(x, scale)| x / scale);
        length(&shares.collect::<Vec<_>>())
    }

    /// Notes the vector to a nearby state, from which growth is measured.
    pub fn put(&mut self, vector: &[f64]) {
        self.length = length(vector);
    }

    /// Growth of that vector to the present one.
    pub fn growth(&self, vector: &[f64]) -> f64 {
        length(vector) / self.length
    }
}

/// Whether shares of a size are numbers.
fn is_size(size: f64) -> bool {
    size.is_normal()
}

/// Length of a vector, whose squares may underflow.
fn length(vector: &[f64]) -> f64 {
    match vector.iter().fold(0.0, |a: f64, x| a.max(x.abs())) {
        0.0 => 0.0,
        largest => {
            largest * vector.iter().map(|x| (x / largest) * (x / largest)).sum::<f64>().sqrt()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(values: &[f64]) -> Vec<DoubleDouble> {
        values.iter().map(|x| DoubleDouble::from_f64(*x)).collect()
    }

    #[test]
    fn distances_are_shares_of_each_component() {
        let reach = Reach::new(&state(&[1e8, 2.0, 0.0]));
        assert_eq!(reach.scales(), [1e8, 2.0, 2.0], "a component without a size");
        assert!((reach.distance(&[3.0, 4e-6, 0.0]) - 2e-6).abs() < 1e-7, "not 3");
    }

    #[test]
    fn sizes_are_forgotten_and_growth_is_not_measured_by_them() {
        let mut reach = Reach::new(&state(&[1e3, 1.0]));
        reach.put(&[1e-3, 1e-6]);
        for _ in 0..20 {
            reach.visit(&state(&[1.0, 1.0]));
        }
        assert_eq!(reach.scales(), [1.0, 1.0], "the far start is forgotten");
        let growth = reach.growth(&[1e-3, 1e-6]);
        assert!((growth - 1.0).abs() < 1e-12, "a vector that did not change: {growth}");
        assert!((reach.growth(&[1e-200, 0.0]) / 1e-197 - 1.0).abs() < 1e-5, "no underflow");
    }
}
