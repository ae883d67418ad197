//! Search for the plan with the fewest operations: which member of each class is computed, and
//! whether with its constant factor.
//!
//! Starting from a plan, one choice after the other is changed, and kept where the [`Tally`] falls.

use super::merge::Member;
use super::tally::Tally;
use super::{Graph, ONE};

/// Number of passes over all choices.
const PASSES: usize = 6;

/// Choice of the member by which each class is computed.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// Place of the member that is computed.
    pub(super) made_by: Vec<Option<usize>>,
    /// Whether that member is computed as it is, instead of a multiple that takes no product.
    pub(super) is_whole: Vec<bool>,
}

impl Graph {
    /// Finds the best plan to compute the values at some places from the reached steps, beginning
    /// with the members in `made_by`; also returns its classes in order. `None` where no plan
    /// computes them all.
    pub(super) fn best_plan(
        &self,
        outputs: &[usize],
        members: &[Member],
        reached: &[bool],
        made_by: &[Option<usize>],
    ) -> Option<(Plan, Vec<usize>)> {
        let mut tally = Tally::new(self, outputs, members, reached)?;
        let mut alternatives = vec![Vec::new(); self.len()];
        for place in (0..self.len()).filter(|place| reached[*place]) {
            let Member { class, factor } = &members[place];
            if !factor.is_zero() && *class != ONE.0 as usize {
                alternatives[*class].push(place);
            }
        }
        let mut best: Option<(u32, Plan, Vec<usize>)> = None;
        for is_whole in [true, false] {
            let is_whole = vec![is_whole; self.len()];
            let first = Plan { made_by: made_by.to_vec(), is_whole };
            let mut improved = first.clone();
            improved.improve(&mut tally, &alternatives);
            for plan in [improved, first] {
                if let Some(cost) = tally.cost_shared(&plan)
                    && best.as_ref().is_none_or(|(least, ..)| cost < *least)
                {
                    best = Some((cost, plan, tally.order().to_vec()));
                }
            }
        }
        best.map(|(_, plan, order)| (plan, order))
    }
}

impl Plan {
    /// Changes the plan as far as single changes lower its cost.
    fn improve(&mut self, tally: &mut Tally<'_>, alternatives: &[Vec<usize>]) {
        let Some(mut cost) = tally.cost(self) else { return };
        for _ in 0..PASSES {
            let before = cost;
            for class in tally.order().to_vec() {
                if tally.has_factor(class) {
                    self.is_whole[class] ^= true;
                    match tally.cost(self) {
                        Some(found) if found < cost => cost = found,
                        _ => self.is_whole[class] ^= true,
                    }
                }
                let mut best = self.made_by[class];
                let others = alternatives[class].iter().filter(|place| Some(**place) != best);
                for place in others.copied().collect::<Vec<usize>>() {
                    self.made_by[class] = Some(place);
                    if let Some(found) = tally.cost(self)
                        && found < cost
                    {
                        (cost, best) = (found, Some(place));
                    }
                }
                self.made_by[class] = best;
            }
            if cost == before {
                break;
            }
        }
    }
}
