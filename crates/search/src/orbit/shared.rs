//! Relations that the special points of several lines share.

use liouville::order::StableOrder;

use super::super::SearchError;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::darboux::{DarbouxSearch, MOST_CANDIDATES};
use super::factor::RatedPolynomial;
use super::line::RandomLine;

/// Number of further lines on which points are looked for that share a relation with those of the first.
const FURTHER_LINES: u64 = 6;

impl DarbouxSearch<'_, '_> {
    /// Relations that points of a line share with points of further lines: f vanishes along the orbits of
    /// all its points, and the relations P − c Q differ. Orbits on f = 0 that have integrals of their own
    /// share more with one another, until there are enough of them. `None` where there are no lines.
    pub fn shared(
        &self,
        at: &PrimePoint,
        all: &[Vec<u32>],
        factors: &[RatedPolynomial],
        first: Vec<Echelon>,
    ) -> Result<Option<Vec<Vec<u64>>>, SearchError> {
        let (mut open, mut found, mut is_shared) = (first, Vec::new(), false);
        for number in 1..=FURTHER_LINES {
            let Some(line) = RandomLine::draw(self.setting, at, number) else { return Ok(None) };
            // Its points may lie in an extension of the field.
            let others = line.special(all, self.degree, factors)?.all;
            if others.is_empty() {
                continue;
            }
            is_shared = true;
            let mut next = Vec::new();
            for (one, two) in open.iter().flat_map(|one| others.iter().map(move |two| (one, two))) {
                self.setting.effort.halt.check()?;
                let mut both = Echelon::new(all.len(), at.modulus);
                for row in one.rows().chain(two.echelon.rows()) {
                    both.push(row);
                }
                match all.len() - both.rank() {
                    0 => {}
                    1 => found.extend(both.null_space()),
                    _ => next.push(both),
                }
            }
            // Those that share most are on one f.
            next.order_by_key(Echelon::rank);
            next.truncate(MOST_CANDIDATES);
            open = next;
            if open.is_empty() {
                break;
            }
        }
        if is_shared {
            found.extend(open.iter().filter_map(|own| own.null_space().into_iter().next()));
        }
        Ok(Some(found))
    }
}
