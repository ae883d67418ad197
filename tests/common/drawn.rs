//! A case at a random state: parameters and state as numbers.

use std::collections::BTreeMap;

use liouville::case::Case;
use liouville::verdict::{PointReport, evaluate};
use nalgebra::{Matrix3, Vector3};
use num_traits::ToPrimitive;

use super::exact;

/// State `index` of a case with the values of its free parameters there.
pub struct Drawn {
    pub report: PointReport,
    values: BTreeMap<String, Vec<f64>>,
}

impl Drawn {
    pub fn new(case: &Case, index: u64) -> Self {
        let report = evaluate(case, None, 1, index).expect("a case that can be evaluated");
        let number = |text: &String| exact(text).to_f64().expect("a finite number");
        let all = report.parameters.iter().chain(&report.state);
        let values =
            all.map(|(name, list)| (name.clone(), list.iter().map(number).collect())).collect();
        Self { report, values }
    }

    fn values(&self, name: &str) -> &[f64] {
        self.values.get(name).unwrap_or_else(|| panic!("`{name}` was drawn"))
    }

    pub fn has(&self, name: &str) -> bool {
        self.values.contains_key(name)
    }

    pub fn scalar(&self, name: &str) -> f64 {
        self.values(name)[0]
    }

    pub fn vector(&self, name: &str) -> Vector3<f64> {
        Vector3::from_column_slice(self.values(name))
    }

    pub fn matrix(&self, name: &str) -> Matrix3<f64> {
        Matrix3::from_row_slice(self.values(name))
    }

    /// Returns a vector, or 0 if the case has no such parameter.
    pub fn vector_or_zero(&self, name: &str) -> Vector3<f64> {
        if self.has(name) { self.vector(name) } else { Vector3::zeros() }
    }
}
