//! Proofs cell by cell: on each, all moduli, dependent roots and chosen signs are what they are.
//!
//! A cell is a choice of signs of the X of all |X|, those among them that come from roots, √(b²) =
//! |b|. On a cell the computation is rewritten: |X| becomes X, -X or, where X vanishes identically, 0;
//! a root whose radicand is a square up to others becomes √c |b|/Π√A_i; and so on, until only roots
//! are left that are independent. A cell is left out where it is known that no real inputs of the
//! given extents lie in it and have all values.
//!
//! docs/soundness.md, "Cells".

use crate::graph::{Expr, Fault, Graph, record};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::domain::Fact;
use super::rewrite::{Rewrite, conditions};
use super::trial::{Certificate, Finding, both};

/// A part of the real inputs on which signs are chosen.
pub struct Cell {
    /// The computation, with what the signs decide put in.
    pub graph: Graph,
    /// The outputs of each group.
    pub groups: Vec<Vec<Expr>>,
    /// What is known of values, by place, wherever the groups have any.
    pub facts: Vec<(usize, Fact)>,
    /// Which of the facts were chosen: positive here, and not on other cells.
    chosen: Vec<usize>,
    /// Inputs that are signs, as they were chosen.
    pub fixed: Vec<(usize, bool)>,
    /// A bound on the probability that what was put in is wrong.
    pub certificate: Option<Certificate>,
}

/// What was found on a cell.
pub struct Leaf {
    /// The cell.
    pub cell: Cell,
    /// The findings, by group; `None` for one that has no value here.
    pub findings: Vec<Option<Finding>>,
}

/// A change of a cell.
#[derive(Default)]
pub struct Change<'c> {
    /// What takes the place of steps.
    pub rewrites: &'c [Rewrite],
    /// An input that is a sign, and which.
    pub fixed: Option<(usize, bool)>,
    /// The place of a value, and whether it is positive, or negative.
    pub chosen: Option<(usize, bool)>,
    /// A bound on the probability that the rewritings are wrong.
    pub certificate: Option<Certificate>,
}

impl Cell {
    /// All real inputs at which the values of some groups exist, facts being known of some values.
    pub fn whole(
        graph: &Graph,
        groups: &[&[Expr]],
        facts: &[(Expr, Fact)],
    ) -> Result<Self, Fault> {
        let facts: Vec<(usize, Fact)> =
            facts.iter().map(|(value, fact)| (graph.place(*value), *fact)).collect();
        let outputs = groups.concat();
        let reached = reached(graph, &outputs, &facts, &[]);
        let (own, found) = record(graph.inputs(), |inputs| {
            let values = graph.replay(&reached, inputs, |_, _, _| None);
            replayed(graph, &values, groups.iter().copied(), &facts)
        })?;
        let (groups, facts) = found.ok_or(Fault::ForeignValue)?;
        let facts = facts.into_iter().map(|(value, fact)| (own.place(value), fact)).collect();
        let (chosen, fixed, certificate) = (Vec::new(), Vec::new(), None);
        Ok(Self { graph: own, groups, facts, chosen, fixed, certificate })
    }

    /// Whether it is a part of the inputs only.
    pub fn is_part(&self) -> bool {
        !self.chosen.is_empty() || !self.fixed.is_empty()
    }

    /// The places of the values that are positive here, and not on other cells.
    pub fn signs(&self) -> impl Iterator<Item = usize> {
        self.chosen.iter().map(|index| self.facts[*index].0)
    }

    /// All outputs.
    pub fn outputs(&self) -> Vec<Expr> {
        self.groups.concat()
    }

    /// The facts, with those of the radicands of all roots in the outputs.
    pub fn known(&self) -> Vec<(usize, Fact)> {
        let mut known = self.facts.clone();
        let reached = self.graph.reached(self.outputs());
        for condition in conditions(&self.graph, &reached) {
            if !known.contains(&condition) {
                known.push(condition);
            }
        }
        known
    }

    /// The cell, or a part of it, after some rewriting; what is known of the radicands of its roots
    /// stays known when they are gone.
    pub fn changed(&self, change: &Change<'_>) -> Result<Self, Fault> {
        let facts = self.known();
        let mut needed: Vec<usize> =
            change.rewrites.iter().flat_map(|rewrite| rewrite.needs()).collect();
        needed.extend(change.chosen.map(|(place, _)| place));
        let reached = reached(&self.graph, &self.outputs(), &facts, &needed);
        let (graph, found) = record(self.graph.inputs(), |inputs| {
            let mut inputs = inputs.to_vec();
            if let Some((input, positive)) = change.fixed {
                let sign = if positive { 1 } else { -1 };
                inputs[input] = Expr::rational(&Rational::from(sign));
            }
            let values = self.graph.replay(&reached, &inputs, |place, step, values| {
                let mut rewrites = change.rewrites.iter();
                rewrites.find_map(|rewrite| rewrite.value(&self.graph, place, step, values))
            });
            let groups = self.groups.iter().map(Vec::as_slice);
            let (groups, mut facts) = replayed(&self.graph, &values, groups, &facts)?;
            if let Some((place, positive)) = change.chosen {
                let value = values[place]?;
                facts.push((if positive { value } else { -value }, Fact::Positive));
            }
            Some((groups, facts))
        })?;
        let (groups, facts) = found.ok_or(Fault::ForeignValue)?;
        let mut chosen = self.chosen.clone();
        chosen.extend(change.chosen.map(|_| facts.len() - 1));
        let facts = facts.into_iter().map(|(value, fact)| (graph.place(value), fact)).collect();
        let certificate = both(self.certificate, change.certificate);
        let fixed = self.fixed.iter().copied().chain(change.fixed).collect();
        Ok(Self { graph, groups, facts, chosen, fixed, certificate })
    }
}

/// The steps that some outputs, facts and other places need.
fn reached(
    graph: &Graph,
    outputs: &[Expr],
    facts: &[(usize, Fact)],
    others: &[usize],
) -> Vec<bool> {
    let outputs = outputs.iter().map(|output| graph.place(*output));
    let facts = facts.iter().map(|(place, _)| *place);
    let places: Vec<usize> = outputs.chain(facts).chain(others.iter().copied()).collect();
    graph.reached_from(&places)
}

/// The outputs of groups, and facts, in the recording under way.
type Replayed = (Vec<Vec<Expr>>, Vec<(Expr, Fact)>);

fn replayed<'c>(
    graph: &Graph,
    values: &[Option<Expr>],
    groups: impl Iterator<Item = &'c [Expr]>,
    facts: &[(usize, Fact)],
) -> Option<Replayed> {
    let at = |output: &Expr| values[graph.place(*output)];
    let groups: Option<Vec<Vec<Expr>>> = groups.map(|group| group.iter().map(at).collect()).collect();
    let facts: Option<Vec<(Expr, Fact)>> =
        facts.iter().map(|(place, fact)| Some((values[*place]?, *fact))).collect();
    groups.zip(facts)
}
