//! Proofs of algebraic identities by computing in prime fields.
//!
//! In goes a graph, some of its values, and what its inputs are; out comes whether all of them are
//! identically zero, with a bound on the probability of an error, or that one is not, or why nothing
//! can be said. The law is docs/soundness.md; what it says is in these files:
//!
//! | | |
//! |---|---|
//! | `algebraic` | functions that no field has are replaced by signs and symbols |
//! | `symbols`, `relations` | one symbol for each element of a basis of arguments |
//! | `bounds` | degree and height on the graph, denominators kept in factors |
//! | `chance`, `digest` | random primes and points, drawn from the seed and what is to be proved |
//! | `identity` | Theorem 1: the test itself |
//! | `elimination`, `rank` | linear algebra modulo a prime |
//! | `standing` | independent roots certified |
//! | `squares`, `roots` | dependent roots found out and eliminated |
//! | `extent` | signs of values wherever the inputs can be |

mod algebraic;
mod bounds;
mod chance;
mod digest;
mod elimination;
mod extent;
mod identity;
mod rank;
mod relations;
mod roots;
mod squares;
mod standing;
mod symbols;

#[cfg(test)]
mod tests;

pub use bounds::Source;
pub(crate) use chance::Chance;
pub(crate) use elimination::reduce;
pub use extent::Extent;
pub use identity::{Certificate, Outcome};
pub(crate) use relations::reconstruct;

use crate::graph::{Expr, Fault, Graph};

use algebraic::Algebraic;
use digest::Digest;
use identity::Trial;
use relations::Relations;
use roots::{Eliminated, Lowered};
use standing::{Standing, standing};
use symbols::Symbols;

/// Sign choices are tried for at most this many dependent roots.
const MOST_CHOICES: usize = 4;

/// What is to be proved about a graph.
pub struct Prover<'a> {
    /// The inputs of the graph in order; those beyond are uniform.
    pub sources: &'a [Source],
    /// Where the inputs are at real states, in order; those beyond are anywhere.
    pub extents: &'a [Extent],
    /// The seed of primes and points; what is to be proved enters them too.
    pub seed: u64,
}

impl Prover<'_> {
    /// For each group of outputs: are all of them identically zero?
    pub fn prove(&self, graph: &Graph, groups: &[Vec<Expr>]) -> Result<Vec<Outcome>, Fault> {
        let sources = self.sources_of(graph);
        let mut outcomes: Vec<Option<Outcome>> = vec![None; groups.len()];
        let mut open: Vec<usize> = (0..groups.len()).collect();
        let digest = Digest::of(self.seed, graph, groups);
        let mut work = Work { digest, replaced: None, groups: groups.to_vec(), certificate: None };
        let mut fresh = true;
        while let Some(first) = open.first().copied() {
            // Once some roots are gone, many groups have none left.
            if std::mem::take(&mut fresh) {
                self.prove_without_roots(work.graph(graph), &work, &mut open, &mut outcomes)?;
                if !open.contains(&first) {
                    continue;
                }
            }
            match self.prove_with_roots(graph, &mut work, first, &open, &sources)? {
                None => fresh = true,
                Some(outcome) => {
                    outcomes[first] = Some(outcome);
                    open.retain(|group| *group != first);
                }
            }
        }
        Ok(outcomes.into_iter().flatten().collect())
    }

    /// Settles the open groups that contain no root.
    fn prove_without_roots(
        &self,
        graph: &Graph,
        work: &Work,
        open: &mut Vec<usize>,
        outcomes: &mut [Option<Outcome>],
    ) -> Result<(), Fault> {
        let all: Vec<Expr> = open.iter().flat_map(|group| work.groups[*group].clone()).collect();
        let algebraic = self.lower(graph, &all, &self.sources_of(graph), work.digest)?;
        let trial = Trial::new(&algebraic, work.digest);
        open.retain(|group| {
            let outputs =
                work.groups[*group].iter().map(|output| algebraic.values[graph.place(*output)]);
            let outcome = match outputs.collect::<Option<Vec<Expr>>>() {
                None => no_value(),
                Some(outputs) if algebraic.roots_of(&outputs).next().is_some() => return true,
                Some(outputs) => judged(&algebraic, &outputs, trial.test(&outputs, &[], &[])),
            };
            outcomes[*group] = Some(work.with_eliminations(outcome));
            false
        });
        Ok(())
    }

    fn sources_of(&self, graph: &Graph) -> Vec<Source> {
        let mut sources = self.sources.to_vec();
        sources.resize(graph.inputs(), Source::Uniform);
        sources
    }

    fn lower(
        &self,
        graph: &Graph,
        outputs: &[Expr],
        sources: &[Source],
        digest: Digest,
    ) -> Result<Algebraic, Fault> {
        let reached = graph.reached(outputs.iter().copied());
        let opaque = Symbols::opaque(graph, &reached);
        let algebraic = Algebraic::of(graph, &reached, sources, &opaque)?;
        if !symbols::any(graph, &reached) {
            return Ok(algebraic);
        }
        let mut relations = Relations::new(graph, sources, algebraic, digest);
        let symbols = Symbols::by_basis(graph, &reached, &mut relations);
        Algebraic::of(graph, &reached, sources, &symbols)
    }

    /// One group by itself, with its roots certified, or tried with all signs. Where some of its
    /// roots can be eliminated, that is done for all open groups, and there is no outcome yet.
    fn prove_with_roots(
        &self,
        original: &Graph,
        work: &mut Work,
        group: usize,
        open: &[usize],
        sources: &[Source],
    ) -> Result<Option<Outcome>, Fault> {
        let graph = work.graph(original);
        let group = &work.groups[group];
        let digest = work.digest;
        let algebraic = self.lower(graph, group, sources, digest)?;
        let outputs = group.iter().map(|output| algebraic.values[graph.place(*output)]);
        let Some(outputs) = outputs.collect::<Option<Vec<Expr>>>() else {
            return Ok(Some(no_value()));
        };
        let trial = Trial::new(&algebraic, digest);
        let roots: Vec<_> = algebraic.roots_of(&outputs).collect();
        let standing = standing(&trial, &algebraic, &roots, digest);
        let roots: Vec<_> = roots.into_iter().zip(standing).collect();
        if roots.iter().any(|(_, s)| *s == Standing::Dependent) {
            let lowered = Lowered { algebraic: &algebraic, trial: &trial, roots: &roots };
            let all: Vec<&[Expr]> = open.iter().map(|group| &*work.groups[*group]).collect();
            let found = roots::eliminate(graph, group, &all, &lowered, self.extents, digest)?;
            if let Some(found) = found {
                work.replace(found, open);
                return Ok(None);
            }
        }
        let outcome = self.decide(&algebraic, &trial, &outputs, &roots);
        Ok(Some(work.with_eliminations(outcome)))
    }

    /// All sign choices of the roots that are left dependent.
    fn decide(
        &self,
        algebraic: &Algebraic,
        trial: &Trial<'_>,
        outputs: &[Expr],
        roots: &[(algebraic::Root, Standing)],
    ) -> Outcome {
        let of = |wanted: Standing| -> Vec<algebraic::Root> {
            roots.iter().filter(|(_, s)| *s == wanted).map(|(root, _)| *root).collect()
        };
        let (independent, choices) = (of(Standing::Independent), of(Standing::Dependent));
        if !of(Standing::Unknown).is_empty() {
            let reason = "a root never exists at random points, or is reached too rarely";
            return Outcome::Silent(reason.to_string());
        }
        if choices.len() > MOST_CHOICES {
            let reason = format!("{} roots or moduli depend on each other", choices.len());
            return Outcome::Silent(reason);
        }
        let mut certificate: Option<Certificate> = None;
        let (mut zero, mut other) = (0, 0);
        let signs: Vec<Vec<(usize, bool)>> = (0u32..1 << choices.len())
            .map(|choice| {
                let sign = |(k, root): (usize, &algebraic::Root)| (root.sign, choice >> k & 1 == 0);
                choices.iter().enumerate().map(sign).collect()
            })
            .collect();
        for signs in &signs {
            match trial.test(outputs, &independent, signs) {
                Outcome::Zero(found) => {
                    zero += 1;
                    certificate = both(certificate, Some(found));
                }
                Outcome::NonZero => other += 1,
                silent => return silent,
            }
        }
        match (certificate, other) {
            (Some(certificate), 0) => Outcome::Zero(certificate),
            _ if trial.is_nonzero_for_all(outputs, &signs) => {
                judged(algebraic, outputs, Outcome::NonZero)
            }
            _ => Outcome::Silent(format!(
                "it vanishes for {zero} of {} choices of signs of dependent roots or moduli",
                zero + other
            )),
        }
    }
}

/// What is left to prove, after some roots have been eliminated.
struct Work {
    /// Of what was to be proved at first.
    digest: Digest,
    /// The graph without them, if there were any.
    replaced: Option<Graph>,
    groups: Vec<Vec<Expr>>,
    /// How sure it is that what replaced the roots are their values.
    certificate: Option<Certificate>,
}

impl Work {
    fn graph<'g>(&'g self, original: &'g Graph) -> &'g Graph {
        self.replaced.as_ref().unwrap_or(original)
    }

    /// Goes on with a graph that has fewer roots, and the outputs of the open groups in it.
    fn replace(&mut self, found: Eliminated, open: &[usize]) {
        let mut outputs = found.outputs.into_iter();
        for group in open {
            let count = self.groups[*group].len();
            self.groups[*group] = outputs.by_ref().take(count).collect();
        }
        self.replaced = Some(found.graph);
        self.certificate = both(self.certificate, found.certificate);
    }

    fn with_eliminations(&self, outcome: Outcome) -> Outcome {
        match (outcome, self.certificate) {
            (Outcome::Zero(last), Some(before)) => Outcome::Zero(last.and(before)),
            (outcome, _) => outcome,
        }
    }
}

fn both(a: Option<Certificate>, b: Option<Certificate>) -> Option<Certificate> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.and(b)),
        (a, b) => a.or(b),
    }
}

/// A value away from zero refutes only where no symbol stands for a function.
fn judged(algebraic: &Algebraic, outputs: &[Expr], outcome: Outcome) -> Outcome {
    match outcome {
        Outcome::NonZero if algebraic.has_symbols(outputs) => Outcome::Silent(
            "it does not vanish for independent symbols in the place of transcendental functions"
                .to_string(),
        ),
        outcome => outcome,
    }
}

fn no_value() -> Outcome {
    Outcome::Silent("a function has no value in a prime field".to_string())
}
