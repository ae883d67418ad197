//! Signatures of symmetric matrices of rational numbers.

use liouville::number::rational::Rational;

/// Numbers of positive and of negative squares of a quadratic form (Sylvester's law of inertia).
pub fn signature(mut own: Vec<Vec<Rational>>) -> (usize, usize) {
    let (mut positive, mut negative) = (0, 0);
    let mut left: Vec<usize> = (0..own.len()).collect();
    while !left.is_empty() {
        let diagonal = left.iter().position(|k| !own[*k][*k].is_zero());
        let place = match diagonal {
            Some(place) => place,
            None => {
                let pairs = || left.iter().flat_map(|i| left.iter().map(move |j| (*i, *j)));
                let Some((i, j)) = pairs().find(|(i, j)| !own[*i][*j].is_zero()) else { break };
                // x_i x_j is a difference of squares of x_i ± x_j.
                let other = own[j].clone();
                own[i].iter_mut().zip(&other).for_each(|(x, y)| *x = &*x + y);
                for row in &mut own {
                    row[i] = &row[i] + &row[j];
                }
                continue;
            }
        };
        let pivot = left.remove(place);
        let (row, value) = (own[pivot].clone(), own[pivot][pivot].clone());
        match value.is_negative() {
            true => negative += 1,
            false => positive += 1,
        }
        let Some(inverse) = value.recip() else { break };
        for i in &left {
            let factor = &row[*i] * &inverse;
            if factor.is_zero() {
                continue;
            }
            for j in &left {
                own[*i][*j] = &own[*i][*j] - &(&factor * &row[*j]);
            }
        }
    }
    (positive, negative)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_are_counted_by_sign() {
        let of = |rows: &[&[i64]]| {
            let row = |own: &&[i64]| own.iter().map(|x| Rational::from(*x)).collect();
            signature(rows.iter().map(row).collect())
        };
        assert_eq!(of(&[&[2, 1], &[1, 2]]), (2, 0));
        assert_eq!(of(&[&[1, 2], &[2, 4]]), (1, 0), "a square");
        assert_eq!(of(&[&[0, 1], &[1, 0]]), (1, 1), "2 x y");
        assert_eq!(of(&[&[0, 1, 1], &[1, 0, 1], &[1, 1, 0]]), (1, 2));
        assert_eq!(of(&[&[0, 0], &[0, -3]]), (0, 1));
        assert_eq!(of(&[]), (0, 0));
    }
}
