//! States at which all formulas have a value, and at no state around: √(−x²) at 0. They do not count.

use super::claim_state::ClaimState;
use super::evidence::Verdict;
use super::judging::Judging;
use super::ladder::LADDER_BITS;
use super::missing::{around, neighbours};
use super::recorded::{OutputLayout, RecordedClaim};
use super::run::Run;
use super::sampler::{Sampler, TAPE_LANES};
use crate::graph::{Expr, Fault, Step};
use crate::number::Enclosing;
use crate::number::arb::ArbBall;
use crate::number::ball::Ball;
use crate::number::mixed::Mixed;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

impl Judging<'_> {
    /// Whether a claim is refuted at a drawn state that does not count.
    pub(super) fn is_refuted_at_lone(
        &self,
        item: &RecordedClaim<'_>,
        sampler: &Sampler,
        status: &ClaimState,
    ) -> Result<bool, Fault> {
        let index = status.evidence.witness.as_ref().and_then(|witness| witness.index);
        match (status.settled, index) {
            (Some(Verdict::Refuted), Some(index)) => self.is_lone(item, sampler, index),
            _ => Ok(false),
        }
    }

    /// Whether the state of a witness does not count, since the claim has no value at the states around.
    fn is_lone(
        &self,
        item: &RecordedClaim<'_>,
        sampler: &Sampler,
        index: u64,
    ) -> Result<bool, Fault> {
        if sampler.is_numerical() {
            return Ok(false);
        }
        let edges = self.edges_of(item, sampler);
        if edges.is_empty() {
            return Ok(false);
        }
        // Where no radicand is 0 the states around have values as well.
        let lanes = TAPE_LANES as u64;
        let states = sampler.balls(index / lanes * lanes);
        let values = self.run(&edges).at(&Ball::<TAPE_LANES>, &states);
        let lane = (index % lanes) as usize;
        let is_inside = |k: usize| Ball::<TAPE_LANES>::excludes_zero(values.output(k), lane);
        if (0..edges.len()).all(is_inside) {
            return Ok(false);
        }
        let (run, layout) = self.lay_out(sampler, std::iter::once(item), false);
        Ok(!self.has_neighbour(sampler, index, &run, &layout))
    }

    /// Whether a state made from given draws does not count, since the claim has no value at the states around.
    pub(super) fn is_lone_at(
        &self,
        item: &RecordedClaim<'_>,
        sampler: &Sampler,
        numbers: &[Rational],
        bits: u32,
    ) -> bool {
        let edges = self.edges_of(item, sampler);
        if edges.is_empty() {
            return false;
        }
        let domain = Mixed::new(bits);
        let at = |numbers: &[Rational]| sampler.made_from(&domain, numbers);
        let values = self.run(&edges).at(&domain, &at(numbers));
        // Where no radicand is 0 the states around have values as well.
        if (0..edges.len()).all(|k| Mixed::excludes_zero(values.output(k), 0)) {
            return false;
        }
        let (run, layout) = self.lay_out(sampler, std::iter::once(item), false);
        let all = around(sampler, numbers);
        !all.iter().any(|numbers| has_values(sampler, &domain, numbers, (&run, &layout)))
    }

    /// Values that end at 0 what has a value: the arguments of roots, logarithms and broken powers.
    fn edges_of(&self, item: &RecordedClaim<'_>, sampler: &Sampler) -> Vec<Expr> {
        let required = self.common.required_at(sampler.kept());
        let reached = self.graph.reached(item.requirement.iter().chain(&required).copied());
        let edge = |(place, _): (usize, &bool)| match self.graph.step(place) {
            Step::Unary(UnaryFunction::Sqrt | UnaryFunction::Ln, a)
            | Step::Binary(BinaryOperation::Pow, a, _) => Some(self.graph.at(a)),
            Step::Power(a, exponent) if exponent.to_integer().is_none() => Some(self.graph.at(a)),
            _ => None,
        };
        reached.iter().enumerate().filter(|(_, reached)| **reached).filter_map(edge).collect()
    }

    /// Whether all that the first claim of a layout requires has a value at a state near a drawn one.
    pub(super) fn has_neighbour(
        &self,
        sampler: &Sampler,
        index: u64,
        run: &Run,
        layout: &OutputLayout,
    ) -> bool {
        let all = neighbours(sampler, index);
        // Balls take less time than exact numbers, which know more.
        let (balls, exact) = (ArbBall::new(LADDER_BITS[0]), Mixed::new(LADDER_BITS[0]));
        all.iter().any(|numbers| has_values(sampler, &balls, numbers, (run, layout)))
            || all.iter().any(|numbers| has_values(sampler, &exact, numbers, (run, layout)))
    }
}

/// Whether all that the first claim of a layout requires has a value at the state made from some draws.
fn has_values<D: Enclosing + Clone>(
    sampler: &Sampler,
    domain: &D,
    numbers: &[Rational],
    (run, layout): (&Run, &OutputLayout),
) -> bool {
    let values = run.at(domain, &sampler.made_from(domain, numbers));
    layout.existing(&values, &layout.spans[0])[0]
}
