//! Signed permutations of components.

/// A signed permutation: component i is `signs[i]` times component `places[i]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct SignedPermutation<'a> {
    pub places: &'a [usize],
    pub signs: &'a [i8],
}

impl SignedPermutation<'_> {
    /// Whether the square is the identity.
    pub fn is_involution(self) -> bool {
        let back = |(i, place): (usize, &usize)| {
            self.places[*place] == i && self.signs[i] * self.signs[*place] == 1
        };
        self.places.iter().enumerate().all(back)
    }

    /// Dimension of {x : sign σx = x}: one for each cycle whose signs multiply to 1.
    pub fn fixed_space(self, sign: i8) -> usize {
        let mut seen = vec![false; self.places.len()];
        let mut dimension = 0;
        for start in 0..self.places.len() {
            let (mut at, mut product) = (start, 1);
            while !std::mem::replace(&mut seen[at], true) {
                product *= sign * self.signs[at];
                at = self.places[at];
                if at == start {
                    dimension += usize::from(product == 1);
                }
            }
        }
        dimension
    }
}
