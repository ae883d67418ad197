//! Check of the relations in f64: singular values of the same matrix, with a gap at their number.

use serde::Serialize;

use super::linear::SampledFunctions;

/// Number of states beyond the number of terms.
const SPARE_STATES: usize = 32;

/// Singular values on both sides of the gap expected from the relations modulo a prime.
#[derive(Clone, Debug, Serialize)]
pub struct SecondOpinion {
    /// Denominator of the terms.
    pub denominator: String,
    /// Number of states in f64.
    pub states: usize,
    /// Number of columns of the matrix.
    pub terms: usize,
    /// Number of relations modulo a prime.
    pub relations: usize,
    /// Smallest singular value that should not be 0, relative to the largest one.
    pub smallest: f64,
    /// Largest singular value that should be 0, relative to the largest one; absent without
    /// relations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_zero: Option<f64>,
}

impl SecondOpinion {
    /// Whether the singular values have a gap where it is expected.
    pub fn agrees(&self) -> bool {
        self.largest_zero.is_none_or(|zero| zero < 1e-3 * self.smallest)
    }
}

/// Elementary steps of the singular values of so many terms, which cannot be stopped: 900 terms take
/// 0.8 s, and the time grows with the third power.
pub fn steps(terms: usize) -> f64 {
    (terms as f64).powi(2) * (terms + SPARE_STATES) as f64
}

/// Computes the singular values of the functions, each scaled to length 1 over the states; `None`
/// if they have too few values there.
pub fn second_opinion(
    functions: &SampledFunctions,
    denominator: &str,
    relations: usize,
    seed: u64,
) -> Option<SecondOpinion> {
    let terms = functions.count();
    let rows = functions.floats(terms + SPARE_STATES, seed);
    if rows.len() < terms {
        return None;
    }
    let length = |j: usize| rows.iter().map(|row| row[j] * row[j]).sum::<f64>().sqrt();
    let lengths: Vec<f64> = (0..terms).map(length).collect();
    let entry = |i: usize, j: usize| match lengths[j] {
        0.0 => 0.0,
        length => rows[i][j] / length,
    };
    let values = faer::Mat::from_fn(rows.len(), terms, entry).singular_values().ok()?;
    let largest = values.first().copied().filter(|value| *value > 0.0)?;
    let kept = terms.checked_sub(relations).filter(|kept| *kept > 0)?;
    Some(SecondOpinion {
        denominator: denominator.to_string(),
        states: rows.len(),
        terms,
        relations,
        smallest: values[kept - 1] / largest,
        largest_zero: values.get(kept).map(|value| value / largest),
    })
}
