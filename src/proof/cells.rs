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
    /// The computation of the values, with what the signs decide put in.
    pub graph: Graph,
    /// The values that no field computes as they stand: roots, moduli, signs, functions.
    pub values: Vec<Expr>,
    /// What is known of values, by place, wherever there is anything to prove.
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
    /// All real inputs at which the values at some places of a graph exist, facts being known of some
    /// of its values.
    pub fn whole(graph: &Graph, places: &[usize], facts: &[(Expr, Fact)]) -> Result<Self, Fault> {
        let facts: Vec<(usize, Fact)> =
            facts.iter().map(|(value, fact)| (graph.place(*value), *fact)).collect();
        let all: Vec<usize> = places.iter().copied().chain(facts.iter().map(|f| f.0)).collect();
        let reached = graph.reached_from(&all);
        let (own, found) = record(graph.inputs(), |inputs| {
            let values = graph.replay(&reached, inputs, |_, _, _| None);
            replayed(&values, places, &facts)
        })?;
        let (values, facts) = found.ok_or(Fault::ForeignValue)?;
        let facts = facts.into_iter().map(|(value, fact)| (own.place(value), fact)).collect();
        let (chosen, fixed, certificate) = (Vec::new(), Vec::new(), None);
        Ok(Self { graph: own, values, facts, chosen, fixed, certificate })
    }

    /// Whether it is a part of the inputs only.
    pub fn is_part(&self) -> bool {
        !self.chosen.is_empty() || !self.fixed.is_empty()
    }

    /// The places of the values that are positive here, and not on other cells.
    pub fn signs(&self) -> impl Iterator<Item = usize> {
        self.chosen.iter().map(|index| self.facts[*index].0)
    }

    /// The facts, with those of the radicands of all roots in the values.
    pub fn known(&self) -> Vec<(usize, Fact)> {
        let mut known = self.facts.clone();
        let reached = self.graph.reached(self.values.iter().copied());
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
        let places: Vec<usize> = self.values.iter().map(|value| self.graph.place(*value)).collect();
        let mut needed = places.clone();
        needed.extend(facts.iter().map(|(place, _)| *place));
        needed.extend(change.rewrites.iter().flat_map(|rewrite| rewrite.needs()));
        needed.extend(change.chosen.map(|(place, _)| place));
        let reached = self.graph.reached_from(&needed);
        let (graph, found) = record(self.graph.inputs(), |inputs| {
            let inputs = with_signs(inputs, change.fixed);
            let values = self.graph.replay(&reached, &inputs, |place, step, values| {
                let mut rewrites = change.rewrites.iter();
                rewrites.find_map(|rewrite| rewrite.value(&self.graph, place, step, values))
            });
            let (own, mut facts) = replayed(&values, &places, &facts)?;
            if let Some((place, positive)) = change.chosen {
                let value = values[place]?;
                facts.push((if positive { value } else { -value }, Fact::Positive));
            }
            Some((own, facts))
        })?;
        let (values, facts) = found.ok_or(Fault::ForeignValue)?;
        let mut chosen = self.chosen.clone();
        chosen.extend(change.chosen.map(|_| facts.len() - 1));
        let facts = facts.into_iter().map(|(value, fact)| (graph.place(value), fact)).collect();
        let certificate = both(self.certificate, change.certificate);
        let fixed = self.fixed.iter().copied().chain(change.fixed).collect();
        Ok(Self { graph, values, facts, chosen, fixed, certificate })
    }
}

/// Inputs, those that are signs having been chosen.
pub fn with_signs(inputs: &[Expr], signs: impl IntoIterator<Item = (usize, bool)>) -> Vec<Expr> {
    let mut inputs = inputs.to_vec();
    for (input, positive) in signs {
        let sign = if positive { 1 } else { -1 };
        inputs[input] = Expr::rational(&Rational::from(sign));
    }
    inputs
}

/// Values and facts in the recording under way.
type Replayed = (Vec<Expr>, Vec<(Expr, Fact)>);

fn replayed(
    values: &[Option<Expr>],
    places: &[usize],
    facts: &[(usize, Fact)],
) -> Option<Replayed> {
    let own: Option<Vec<Expr>> = places.iter().map(|place| values[*place]).collect();
    let facts: Option<Vec<(Expr, Fact)>> =
        facts.iter().map(|(place, fact)| Some((values[*place]?, *fact))).collect();
    own.zip(facts)
}
