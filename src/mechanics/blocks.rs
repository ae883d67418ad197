//! Blocks of square matrices: sets of indices without entries between them.

use super::elimination::determinant;
use crate::scalar::Scalar;

/// Divides the indices of a square matrix into sets without entries between them, by their form.
pub fn blocks<T: Scalar>(a: &[Vec<T>]) -> Vec<Vec<usize>> {
    let mut open: Vec<usize> = (0..a.len()).collect();
    let mut blocks = Vec::new();
    while let Some(first) = open.first().copied() {
        let mut block = vec![first];
        let mut next = 0;
        while let Some(i) = block.get(next).copied() {
            let joined = |j: &usize| !(a[i][*j].is_absent() && a[*j][i].is_absent());
            block.extend(
                open.iter()
                    .copied()
                    .filter(|j| !block.contains(j) && joined(j))
                    .collect::<Vec<_>>(),
            );
            next += 1;
        }
        open.retain(|i| !block.contains(i));
        block.sort_unstable();
        blocks.push(block);
    }
    blocks
}

/// The part of a matrix with the rows and columns of a block.
pub fn part<T: Scalar>(a: &[Vec<T>], block: &[usize]) -> Vec<Vec<T>> {
    block.iter().map(|i| block.iter().map(|j| a[*i][*j]).collect()).collect()
}

/// Computes the determinants of the blocks of a matrix, whose product is its determinant.
pub fn block_determinants<T: Scalar>(a: &[Vec<T>]) -> Vec<T> {
    blocks(a).iter().map(|block| determinant(&part(a, block))).collect()
}
