//! Order in which the motions of a grid are followed.

/// Fraction of the golden section, by which the first motions are spread over the grid.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Order of the motions: the first ones are spread over the grid.
pub(super) struct Order {
    count: usize,
    stride: usize,
}

impl Order {
    pub(super) fn of(count: usize) -> Self {
        let first = ((count as f64 * GOLDEN) as usize).max(1);
        let stride = (first..=first + count).find(|stride| common(*stride, count) == 1);
        Self { count, stride: stride.unwrap_or(1) }
    }

    pub(super) fn place(&self, index: usize) -> usize {
        (index as u128 * self.stride as u128 % self.count as u128) as usize
    }
}

/// Greatest common divisor.
fn common(a: usize, b: usize) -> usize {
    if b == 0 { a } else { common(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_motions_have_their_turn() {
        for count in [1, 2, 3, 10, 64, 2500, 4097] {
            let order = Order::of(count);
            let mut places: Vec<usize> = (0..count).map(|index| order.place(index)).collect();
            places.sort_unstable();
            assert!(places.into_iter().eq(0..count), "{count}");
        }
    }
}
