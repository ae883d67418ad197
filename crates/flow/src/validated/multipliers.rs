//! Sum of the multipliers of a closed orbit on its level, enclosed.
//!
//! D_i is the derivative of the flow over segment i, K the space of directions at the first node
//! along which no conserved function changes, and M = D_{m-1} … D_0, which maps K to itself. With
//! Π₀ᵀ e_j = u_j, dF e_j = 0 the trace of M on K is Σ_j (Π₀ᵀ M e_j)_j: the multipliers, and 1 along
//! the orbit. The D_i are not multiplied, which would widen the enclosures; the linear system
//!
//! ```text
//! Π₀ᵀ w_0 = u_j,  dF w_0 = 0,  w_{i+1} - D_i w_i = 0
//! ```
//!
//! is solved instead: for a right side b, an approximate inverse C of its matrix A, and any ẑ,
//! ‖z - ẑ‖ ≤ ‖C(b - Aẑ)‖/(1 - ‖1 - CA‖) in the maximum norm.

use super::enclosure::{Enclosure, raised};
use super::krawczyk::Inverse;
use super::motion::{Boxed, EnclosedPassage};
use super::shooting::{Columns, Frames, Shooting, combined};

/// Encloses the sum of the multipliers, without the 1 along the orbit, given boxes of its nodes and
/// the passages between them. `None` where the system is not proved to be regular.
pub fn sum(
    shooting: &Shooting,
    frames: &Frames,
    boxes: &[Boxed],
    passages: &[EnclosedPassage],
) -> Option<Enclosure> {
    let n = shooting.motion.dimension;
    let across = &frames.across[0];
    let mut columns: Columns = vec![Vec::new(); n * boxes.len()];
    for (row, direction) in across.iter().enumerate() {
        for (component, x) in direction.iter().enumerate() {
            columns[component].push((row, Enclosure::exact(*x)));
        }
    }
    for (row, gradient) in shooting.functions.slopes(boxes.first()?).iter().enumerate() {
        for (component, slope) in gradient.iter().enumerate() {
            columns[component].push((across.len() + row, *slope));
        }
    }
    let (last, others) = passages.split_last()?;
    for (index, passage) in others.iter().enumerate() {
        for row in 0..n {
            let place = n * (index + 1) + row;
            for (component, slope) in passage.derivative[row][..n].iter().enumerate() {
                columns[n * index + component].push((place, -*slope));
            }
            columns[place].push((place, Enclosure::exact(1.0)));
        }
    }
    let size = columns.len();
    let inverse = Inverse::new(&columns, &(0..size).collect::<Vec<_>>())?;
    let defect = inverse.defects(&columns, &vec![1.0; size]).1;
    let room = 1.0 - raised(defect, 1);
    if room.is_nan() || room <= 0.0 {
        return None;
    }
    let mut trace = Enclosure::ZERO;
    for (index, direction) in across.iter().enumerate() {
        let mut side = vec![Enclosure::ZERO; size];
        side[index] = Enclosure::exact(1.0);
        let found = inverse.times(&side);
        for (column, z) in columns.iter().zip(&found) {
            for (row, entry) in column {
                side[*row] = side[*row] - *entry * Enclosure::exact(*z);
            }
        }
        let bounds = inverse.bounds(&side);
        // A maximum would pass over NaN.
        let worst = bounds.iter().fold(0.0, |a, b| if *b <= a { a } else { *b });
        let error = raised(worst / room, 2);
        let vector: Boxed = found[size - n..].iter().map(|z| Enclosure::about(*z, error)).collect();
        let moved: Boxed = last
            .derivative
            .iter()
            .map(|row| {
                let terms = row.iter().zip(&vector);
                terms.fold(Enclosure::ZERO, |sum, (slope, x)| sum + *slope * *x)
            })
            .collect();
        trace = trace + combined(direction, &moved);
    }
    let sum = trace - Enclosure::exact(1.0);
    sum.is_finite().then_some(sum)
}
