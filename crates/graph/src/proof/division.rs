//! Division of cells, by the sign of a modulus or by that of a solved level.

use crate::graph::{Expr, Step};
use crate::number::BinaryOperation;

use super::bounds::InputDistribution;
use super::cells::Cell;
use super::classes::Classes;
use super::domain::Region;
use super::explore::{Explorer, Question};
use super::lower::Algebraic;
use super::next::Next;
use super::rewrite::Rewrite;
use super::tower::Tower;
use super::trial::Trial;

impl Explorer<'_> {
    /// Finds the signs of moduli that are still open, or divides by one of them or by an input.
    pub fn divide(
        &self,
        cell: &Cell,
        algebraic: &Algebraic<'_>,
        trial: &Trial<'_>,
        tower: &Tower,
        open: Vec<(usize, usize)>,
    ) -> Option<Next> {
        if let Some((modulus, argument)) = open.first().copied() {
            let classes = Classes::of(algebraic, trial, tower, self.digest);
            let (known, inputs) = (cell.known(), self.prover.extents);
            let region = Region { graph: &cell.graph, inputs, facts: &known, classes: &classes };
            if cell.is_part() && region.is_empty() {
                return Some(Next::Empty(classes.certificate));
            }
            let signs = open.iter().filter_map(|(place, argument)| {
                let positive = region.sign(*argument)?;
                Some(Rewrite::Signed { place: *place, positive, is_implied: true })
            });
            let rewrites: Vec<Rewrite> = signs.collect();
            if !rewrites.is_empty() {
                return Some(Next::Rewrite(rewrites, classes.certificate));
            }
            return Some(Next::Divide { modulus, argument });
        }
        let Question { graph, groups, special, .. } = self.question;
        let outputs = groups.iter().flat_map(|group| group.iter().copied());
        let reached = graph.reached(outputs);
        let is_root = |place: usize| {
            let own = special.iter().position(|own| *own == place);
            own.and_then(|own| algebraic.values[cell.graph.place(cell.values[own])])
                .is_some_and(|value| tower.is_independent_root(algebraic, value))
        };
        // The sign of an independent root is random already.
        let is_absorbed = |sign: usize| {
            let steps = graph.steps().enumerate().filter(|(place, _)| reached[*place]);
            let mut users =
                steps.filter(|(_, step)| step.arguments().any(|argument| argument == sign));
            users.all(|(_, step)| match step {
                Step::Binary(BinaryOperation::Mul, a, b) => is_root(if a == sign { b } else { a }),
                _ => false,
            })
        };
        let mut signs = self.free_signs(cell);
        signs.find(|(place, _)| !is_absorbed(*place)).map(|(_, input)| Next::DivideInput(input))
    }

    /// Lists the sign inputs that the cell leaves free, by place and index. What is zero for all of
    /// them together is zero for each; what is not may still be zero for the one that counts:
    /// s√A = √A fails for s = −1 alone.
    pub fn free_signs(&self, cell: &Cell) -> impl Iterator<Item = (usize, usize)> {
        let Question { graph, special, .. } = self.question;
        special.iter().filter_map(|place| match graph.step(*place) {
            Step::Input(input) if cell.fixed.iter().all(|(fixed, _)| *fixed != input) => {
                Some((*place, input))
            }
            _ => None,
        })
    }

    /// Finds a sign input, not yet chosen, on which roots or moduli depend that are not known to be
    /// independent: for each of its values they may be.
    pub fn sign_of(
        &self,
        cell: &Cell,
        algebraic: &Algebraic<'_>,
        loose: &[usize],
    ) -> Option<usize> {
        let radicands = algebraic.bases.iter().filter_map(|base| {
            let is_loose = base.links.iter().any(|(_, sign)| loose.contains(sign));
            is_loose.then_some(base.radicand)
        });
        let moduli = algebraic.moduli.iter().filter(|modulus| loose.contains(&modulus.sign));
        let of: Vec<Expr> = radicands.chain(moduli.map(|modulus| modulus.argument)).collect();
        let mask = algebraic.mask_of(&of);
        let is_sign = |input: &usize| {
            self.sources[*input] == InputDistribution::Sign
                && cell.fixed.iter().all(|(fixed, _)| fixed != input)
                && mask & algebraic.bit(*input) != 0
        };
        (0..self.sources.len()).find(is_sign)
    }
}
