//! Sum of the multipliers of a closed orbit, by one linear system for the whole orbit.

use super::matrix::{Columns, combined, inverse, norm, products};
use super::number::{ReplayNumber, Wide};
use super::segment::ReplayedPassage;
use crate::validated::enclosure::Enclosure;

/// Encloses the sum of the multipliers without the 1 along the orbit. `None` where the system is not
/// proved to be regular.
pub fn sum(
    across: &[Vec<f64>],
    gradients: &[Vec<Wide>],
    passages: &[&ReplayedPassage],
) -> Option<Enclosure> {
    let (last, others) = passages.split_last()?;
    let n = last.end.len();
    let mut columns: Columns = vec![Vec::new(); n * passages.len()];
    for (row, direction) in across.iter().enumerate() {
        for (component, x) in direction.iter().enumerate() {
            columns[component].push((row, Wide::exact(*x)));
        }
    }
    for (row, gradient) in gradients.iter().enumerate() {
        for (component, slope) in gradient[..n].iter().enumerate() {
            columns[component].push((across.len() + row, slope.clone()));
        }
    }
    for (index, passage) in others.iter().enumerate() {
        for (row, slopes) in passage.derivative.iter().enumerate() {
            let place = n * (index + 1) + row;
            for (component, slope) in slopes[..n].iter().enumerate() {
                columns[n * index + component].push((place, slope.neg()));
            }
            columns[place].push((place, Wide::exact(1.0)));
        }
    }
    let size = columns.len();
    let inverse = inverse(&columns, &(0..size).collect::<Vec<_>>())?;
    let room = Wide::exact(1.0).minus(&norm(&inverse, &columns));
    if !room.is_positive() {
        return None;
    }
    let mut trace = Wide::exact(-1.0);
    for (index, direction) in across.iter().enumerate() {
        let mut side = vec![Wide::zero(); size];
        side[index] = Wide::exact(1.0);
        let found: Vec<f64> = (0..size).map(|row| inverse.row(row)[index]).collect();
        for (column, z) in columns.iter().zip(&found) {
            for (row, entry) in column {
                side[*row] = side[*row].minus(&entry.times(&Wide::exact(*z)));
            }
        }
        let worst = products(&inverse, &side)
            .iter()
            .fold(Wide::zero(), |largest, bound| largest.larger(bound));
        let error = Wide::within(&worst.mul(&room.recip()));
        let vector: Vec<Wide> =
            found[size - n..].iter().map(|z| Wide::exact(*z).plus(&error)).collect();
        let moved: Vec<Wide> = last
            .derivative
            .iter()
            .map(|row| {
                let terms = row.iter().zip(&vector);
                terms.fold(Wide::zero(), |sum, (slope, x)| sum.plus(&slope.times(x)))
            })
            .collect();
        trace = trace.plus(&combined(direction, &moved));
    }
    Some(trace.enclosure()).filter(|sum| sum.is_finite())
}
