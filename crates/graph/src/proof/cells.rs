//! Cells: parts of the real inputs on which the signs of moduli, dependent roots and sign inputs
//! are fixed.
//!
//! A cell is a choice of signs of the arguments X of all |X|, including those that come from roots,
//! √(b²) = |b|. On a cell the computation is rewritten: |X| becomes X, -X or, where X vanishes
//! identically, 0; a root whose radicand is a square up to others becomes √c |b|/Π√A_i; and so on,
//! until only independent roots are left. A cell is omitted if it is known to contain no real
//! inputs of the given extents at which all values exist.
//!
//! docs/soundness.md, "Cells".

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::classes::Classes;
use super::domain::Region;
use super::extent::Extent;
use super::fact::SignFact;
use super::rewrite::{Rewrite, conditions};
use super::trial::{Certificate, MOST_NESTED, TrialResult, both};

/// A part of the real inputs on which some signs are fixed.
pub struct Cell {
    /// Computation of the values, with the consequences of the signs substituted.
    pub graph: Graph,
    /// Values that cannot be computed in a field as they stand: roots, moduli, signs, functions.
    pub values: Vec<Expr>,
    /// Signs of values, by place, that hold wherever the claim is to be proved.
    pub facts: Vec<(usize, SignFact)>,
    /// Indices of the facts that were chosen: positive on this cell, and not on others.
    chosen: Vec<usize>,
    /// Sign inputs with their chosen values.
    pub fixed: Vec<(usize, bool)>,
    /// Bound on the probability that a rewriting is wrong.
    pub certificate: Option<Certificate>,
}

/// A cell with the findings on it.
pub struct Leaf {
    /// The cell.
    pub cell: Cell,
    /// Findings by group; `None` for a group that has no value on the cell.
    pub results: Vec<Option<TrialResult>>,
}

/// A change of a cell.
#[derive(Default)]
pub struct CellChange<'c> {
    /// Replacements of steps.
    pub rewrites: &'c [Rewrite],
    /// A sign input, and whether it is 1.
    pub fixed: Option<(usize, bool)>,
    /// Place of a value, and whether it is positive (otherwise negative).
    pub chosen: Option<(usize, bool)>,
    /// Whether the value is 0 on no open set.
    pub is_strict: bool,
    /// Bound on the probability that the rewritings are wrong.
    pub certificate: Option<Certificate>,
}

impl Cell {
    /// Makes the cell of all real inputs at which the values at some places of a graph exist, given
    /// facts about some of its values.
    pub fn whole(
        graph: &Graph,
        places: &[usize],
        facts: &[(Expr, SignFact)],
    ) -> Result<Self, Fault> {
        let facts: Vec<(usize, SignFact)> =
            facts.iter().map(|(value, fact)| (graph.place(*value), *fact)).collect();
        let all: Vec<usize> = places.iter().copied().chain(facts.iter().map(|f| f.0)).collect();
        let reached = graph.reached_from(&all);
        let layers = layers(graph, &reached);
        let (own, found) = record(graph.inputs(), |inputs| {
            for layer in &layers {
                graph.repeated(layer, inputs);
            }
            let values = graph.repeated(&reached, inputs);
            replayed(&values, places, &facts)
        })?;
        let (values, facts) = found.ok_or(Fault::ForeignValue)?;
        let facts = facts.into_iter().map(|(value, fact)| (own.place(value), fact)).collect();
        let (chosen, fixed, certificate) = (Vec::new(), Vec::new(), None);
        Ok(Self { graph: own, values, facts, chosen, fixed, certificate })
    }

    /// Whether the cell is a proper part of the inputs.
    pub fn is_part(&self) -> bool {
        !self.chosen.is_empty() || !self.fixed.is_empty()
    }

    /// Returns the places of the values that are positive on this cell and not on others.
    pub fn signs(&self) -> impl Iterator<Item = usize> {
        self.chosen.iter().map(|index| self.facts[*index].0)
    }

    /// Finds the sign of a further value, made from those at some places, by intervals, where 0 counts as either sign.
    pub fn sign_of(
        &self,
        known: &[(usize, SignFact)],
        inputs: &[Extent],
        places: &[usize],
        value: impl FnOnce(&[Option<Expr>]) -> Option<Expr>,
    ) -> Option<bool> {
        let own: Vec<usize> = known.iter().map(|(place, _)| *place).collect();
        let reached = self.graph.reached_from(&[&own, places].concat());
        let (graph, made) = record(self.graph.inputs(), |x| {
            let values = self.graph.repeated(&reached, x);
            let facts = own.iter().map(|place| values[*place]).collect::<Option<Vec<Expr>>>()?;
            Some((value(&values)?, facts))
        })
        .ok()?;
        let (value, values) = made?;
        let facts: Vec<(usize, SignFact)> = values
            .into_iter()
            .zip(known)
            .map(|(own, (_, fact))| (graph.place(own), *fact))
            .collect();
        let classes = &Classes::default();
        Region { graph: &graph, inputs, facts: &facts, classes }.sign(graph.place(value))
    }

    /// Returns the facts, together with those about the radicands of all roots in the values.
    pub fn known(&self) -> Vec<(usize, SignFact)> {
        let mut known = self.facts.clone();
        let reached = self.graph.reached(self.values.iter().copied());
        for condition in conditions(&self.graph, &reached) {
            if !known.contains(&condition) {
                known.push(condition);
            }
        }
        known
    }

    /// Makes the cell, or a part of it, after a change; facts about the radicands of its roots are
    /// kept when the roots are gone.
    pub fn changed(&self, change: &CellChange<'_>) -> Result<Self, Fault> {
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
            for rewrite in change.rewrites {
                if let Some((place, positive)) = rewrite.implied(&self.graph)
                    && let Some(value) = values[place]
                {
                    facts.push((if positive { value } else { -value }, SignFact::NotNegative));
                }
            }
            if let Some((place, positive)) = change.chosen {
                let value = values[place]?;
                let fact =
                    if change.is_strict { SignFact::Positive } else { SignFact::NotNegative };
                facts.push((if positive { value } else { -value }, fact));
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

/// Lists the values under at most 0, 1, … nested roots, if some root follows one that is nested more
/// deeply, or a value made of functions does, as cos x for √(1 − sin²x); otherwise nothing. A root can be rewritten by
/// what is before it only.
fn layers(graph: &Graph, reached: &[bool]) -> Vec<Vec<bool>> {
    let mut depths = vec![0; graph.len()];
    let mut has_function = vec![false; graph.len()];
    let (mut deepest, mut is_ordered) = (0, true);
    for place in (0..graph.len()).filter(|place| reached[*place]) {
        let step = graph.step(place);
        let below = step.arguments().map(|argument| depths[argument]).max().unwrap_or(0);
        let is_root = step.is_root();
        // √√x belongs to x, like √x.
        let is_first = step.arguments().all(|argument| !graph.step(argument).is_root());
        depths[place] = below + usize::from(is_root && is_first);
        let is_function = matches!(
            step,
            Step::Unary(UnaryFunction::Exp | UnaryFunction::Sin | UnaryFunction::Cos, _)
        );
        has_function[place] =
            is_function || step.arguments().any(|argument| has_function[argument]);
        is_ordered &= !is_root && !has_function[place] || depths[place] >= deepest;
        deepest = deepest.max(depths[place]);
    }
    if is_ordered {
        return Vec::new();
    }
    let within = |most: usize| {
        let is_within = |place: usize| reached[place] && depths[place] <= most;
        (0..graph.len()).map(is_within).collect()
    };
    (0..deepest.min(MOST_NESTED as usize)).map(within).collect()
}

/// Replaces sign inputs by their chosen values.
pub fn with_signs(inputs: &[Expr], signs: impl IntoIterator<Item = (usize, bool)>) -> Vec<Expr> {
    let mut inputs = inputs.to_vec();
    for (input, positive) in signs {
        let sign = if positive { 1 } else { -1 };
        inputs[input] = Expr::rational(&Rational::from(sign));
    }
    inputs
}

/// Replayed values and facts in the recording under way.
type Replayed = (Vec<Expr>, Vec<(Expr, SignFact)>);

fn replayed(
    values: &[Option<Expr>],
    places: &[usize],
    facts: &[(usize, SignFact)],
) -> Option<Replayed> {
    let own: Option<Vec<Expr>> = places.iter().map(|place| values[*place]).collect();
    let facts: Option<Vec<(Expr, SignFact)>> =
        facts.iter().map(|(place, fact)| Some((values[*place]?, *fact))).collect();
    own.zip(facts)
}
