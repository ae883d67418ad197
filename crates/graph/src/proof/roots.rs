//! Dependent roots and their expressions in terms of other roots.

use crate::graph::{Expr, Fault, Graph, Step};
use crate::number::UnaryFunction;
use crate::number::rational::Rational;
use crate::order::StableOrder;
use crate::scalar::Scalar;

use super::digest::SeedDigest;
use super::domain::Region;
use super::lower::Algebraic;
use super::nested::{DenestedRoot, written};
use super::rewrite::{Rewrite, Root};
use super::squares::{RootSamples, Square};
use super::tower::{RootStatus, Tower};
use super::trial::{Certificate, Roots, Trial, TrialResult};

/// Largest number of other radicands of either kind multiplied with a nested radicand.
const MOST_FACTORS: usize = 4;
/// Largest number of roots by which another one is expressed.
const MOST_ROOTS: usize = 16;
/// Largest number of sets of such radicands.
const MOST_SETS: usize = 40;

/// The result of the search for the root of a base.
pub enum RootSearch {
    /// The root is independent of those before it.
    Independent,
    /// The root has another expression, up to the bounded probability.
    Rewrite(Rewrite, Option<Certificate>),
    /// The root and those before it exist together at no real inputs, up to the bounded
    /// probability.
    NeverReal(Option<Certificate>),
    /// The root may depend on others, but no expression was found.
    Unknown,
}

/// A graph with the state of its roots.
pub struct RootFinder<'f> {
    /// Graph of the computation.
    pub graph: &'f Graph,
    /// The same graph, lowered.
    pub algebraic: &'f Algebraic<'f>,
    /// Test of the lowered graph.
    pub trial: &'f Trial<'f>,
    /// Standings of its roots.
    pub tower: &'f Tower,
    /// Real inputs under consideration.
    pub region: &'f Region<'f>,
    /// Digest of the statement to be proved.
    pub digest: SeedDigest,
    /// Values at random points, made on first use.
    pub samples: Option<Option<RootSamples>>,
}

impl RootFinder<'_> {
    /// Searches for an expression of the root of a base. Roots of odd index are unique in the
    /// fields that are used, and need none.
    pub fn search(&mut self, base: usize) -> Result<RootSearch, Fault> {
        let found = self.of_square(base)?;
        Ok(match found {
            RootSearch::Rewrite(Rewrite::Root { .. } | Rewrite::Split { .. }, _)
                if self.algebraic.bases[base].links.is_empty() =>
            {
                RootSearch::Independent
            }
            found => found,
        })
    }

    fn of_square(&mut self, base: usize) -> Result<RootSearch, Fault> {
        let arguments = || self.algebraic.bases[base].arguments.clone();
        match &self.tower.standings[base] {
            RootStatus::Independent => Ok(RootSearch::Independent),
            RootStatus::Split => {
                Ok(RootSearch::Rewrite(Rewrite::Split { arguments: arguments() }, None))
            }
            RootStatus::Zero => {
                let radicand = self.algebraic.bases[base].radicand;
                let roots = Roots { nested: self.tower.nested, fixed: &[] };
                Ok(match self.trial.test(&[&[radicand]], roots).pop() {
                    Some(TrialResult::Zero(certificate)) => {
                        let rewrite = Rewrite::Zero { arguments: arguments() };
                        RootSearch::Rewrite(rewrite, Some(certificate))
                    }
                    _ => RootSearch::Unknown,
                })
            }
            RootStatus::Dependent(others) => self.dependent(base, others.clone()),
            RootStatus::Deferred | RootStatus::Unreached => Ok(RootSearch::Unknown),
        }
    }

    fn dependent(&mut self, base: usize, others: Vec<usize>) -> Result<RootSearch, Fault> {
        let is_nested = self.algebraic.mask(self.algebraic.bases[base].radicand) != 0;
        let groups = if is_nested { self.before_nested(base) } else { vec![others] };
        for others in groups {
            if let Some(found) = self.product(base, &others)? {
                return Ok(found);
            }
        }
        Ok(RootSearch::Unknown)
    }

    /// Lists sets of independent roots before a nested one, small ones first: nested roots, and the
    /// nearest of those without roots inside, as its own may cancel.
    fn before_nested(&self, base: usize) -> Vec<Vec<usize>> {
        let is_nested =
            |index: &usize| self.algebraic.mask(self.algebraic.bases[*index].radicand) != 0;
        let independent: Vec<usize> = (0..base)
            .filter(|index| self.tower.standings[*index] == RootStatus::Independent)
            .collect();
        let nested = independent.iter().copied().filter(is_nested).take(MOST_FACTORS);
        let others = independent.iter().rev().copied().filter(|index| !is_nested(index));
        let candidates: Vec<usize> = nested.chain(others.take(MOST_FACTORS)).collect();
        let mut subsets: Vec<u32> = (0..1 << candidates.len()).collect();
        subsets.order_by_key(|subset| subset.count_ones());
        subsets.truncate(MOST_SETS);
        let chosen = |subset: u32| {
            let members = candidates.iter().enumerate().filter(|(k, _)| subset >> k & 1 == 1);
            members.map(|(_, index)| *index).collect()
        };
        subsets.into_iter().map(chosen).collect()
    }

    /// Searches for an expression of √(A Π A_i).
    ///
    /// √(−b²) exists nowhere if b is known to vanish on no open set, and is 0 where it exists.
    fn product(&mut self, base: usize, others: &[usize]) -> Result<Option<RootSearch>, Fault> {
        let own = &self.algebraic.bases[base];
        let first = |index: &usize| self.algebraic.bases[*index].arguments.first().copied();
        let Some(over) = others.iter().map(first).collect::<Option<Vec<usize>>>() else {
            return Ok(None);
        };
        let rewrite = |root: Root| Rewrite::Root {
            arguments: own.arguments.clone(),
            root,
            over: over.clone(),
        };
        let before = own.first;
        let radicands: Vec<Expr> =
            [base].iter().chain(others).map(|base| self.algebraic.bases[*base].radicand).collect();
        let has_symbols = self.algebraic.has_symbols(&radicands);
        let never_real = |certificate| match (has_symbols, others) {
            (false, _) => Some(RootSearch::NeverReal(certificate)),
            (true, []) => {
                let rewrite = Rewrite::Zero { arguments: own.arguments.clone() };
                Some(RootSearch::Rewrite(rewrite, certificate))
            }
            (true, _) => None,
        };
        let squares = self.samples().map(|samples| samples.squares(base, others, before));
        for (scale, square) in squares.unwrap_or_default() {
            // A modulus, whose sign is known, may be one of those that are not settled.
            let Some(certificate) = self.is_square(base, others, &scale, square)? else { continue };
            return Ok(match scale.is_negative() {
                true => never_real(Some(certificate)),
                false => {
                    let root = rewrite(Root::Found(scale, square));
                    Some(RootSearch::Rewrite(root, Some(certificate)))
                }
            });
        }
        let own = own.arguments.first().copied();
        let places: Vec<usize> = own.into_iter().chain(over.iter().copied()).collect();
        let found = written(self.graph, &places, &self.roots_before(base));
        if matches!(&found, Some(DenestedRoot::Square(scale, _)) if scale.is_negative()) {
            return Ok(never_real(None));
        }
        let found = found.map(|written| RootSearch::Rewrite(rewrite(Root::Written(written)), None));
        Ok(found.or_else(|| {
            let (partner, certificate) =
                self.square_of_function(own.filter(|_| over.is_empty())?)?;
            let root = Root::Found(Rational::from(1), Square::Function(partner));
            Some(RootSearch::Rewrite(rewrite(root), Some(certificate)))
        }))
    }

    /// Lists the steps before the root of a base that are independent roots.
    fn roots_before(&self, base: usize) -> Vec<usize> {
        let (bases, standings) = (&self.algebraic.bases, &self.tower.standings);
        let independent = bases.iter().zip(standings).take(base);
        let independent = independent.filter(|(_, standing)| **standing == RootStatus::Independent);
        let arguments: Vec<usize> =
            independent.flat_map(|(base, _)| base.arguments.iter().copied()).collect();
        let steps = self.graph.steps().enumerate().take(bases[base].first);
        let is_root = |(_, step): &(usize, Step<'_>)| matches!(step, Step::Unary(UnaryFunction::Sqrt, a) if arguments.contains(a));
        steps.filter(is_root).map(|(place, _)| place).take(MOST_ROOTS).collect()
    }

    fn samples(&mut self) -> Option<&RootSamples> {
        if self.samples.is_none() {
            let outputs: Vec<usize> = (0..self.graph.len())
                .filter(|place| self.algebraic.values[*place].is_some())
                .collect();
            let known = self.region.at_sight(&outputs);
            let known: Vec<bool> = known.iter().map(Option::is_some).collect();
            let bases = 0..self.algebraic.bases.len();
            let is_needed = |index: &usize| {
                matches!(
                    self.tower.standings[*index],
                    RootStatus::Independent | RootStatus::Dependent(_)
                )
            };
            let needed: Vec<usize> = bases.filter(is_needed).collect();
            self.samples = Some(RootSamples::of(self.algebraic, &needed, &known, self.digest));
        }
        self.samples.as_ref()?.as_ref()
    }

    /// Proves A Π A_i = c b².
    fn is_square(
        &self,
        base: usize,
        others: &[usize],
        scale: &Rational,
        square: Square,
    ) -> Result<Option<Certificate>, Fault> {
        let bases = &self.algebraic.bases;
        let extended = self.algebraic.with(|_, at| {
            let mut product = at(bases[base].radicand)?;
            for other in others {
                product *= at(bases[*other].radicand)?;
            }
            let b = square.value(|place| at(self.algebraic.values[place]?))?;
            Some(vec![product - b * b * Expr::rational(scale)])
        })?;
        let Some((extended, difference)) = extended else { return Ok(None) };
        if !difference.iter().all(|value| self.tower.is_clean(&extended, *value)) {
            return Ok(None);
        }
        let trial = Trial::new(&extended, self.digest);
        let roots = Roots { nested: self.tower.nested, fixed: &[] };
        Ok(match trial.test(&[&difference], roots).pop() {
            Some(TrialResult::Zero(certificate)) => Some(certificate),
            _ => None,
        })
    }
}
