//! The search through all cells: rewriting, division and testing.

use crate::graph::{Expr, Fault, Graph, Step, literally};
use crate::number::UnaryFunction;

use super::Prover;
use super::angles::angles;
use super::bounds::InputDistribution;
use super::cells::{Cell, CellChange, Leaf, with_signs};
use super::choices::{for_all_choices, unlike};
use super::classes::Classes;
use super::digest::SeedDigest;
use super::domain::Region;
use super::fact::SignFact;
use super::free_symbols::zeros_for_free_symbols;
use super::logarithms::Rules;
use super::lower::Algebraic;
use super::next::{Next, silent};
use super::rewrite::Rewrite;
use super::roots::{RootFinder, RootSearch};
use super::tower::{RootStatus, Tower};
use super::trial::{Certificate, Roots, Trial, TrialResult, both};
use super::vanishing::vanishes_nowhere_openly;
use super::void::{is_lost, may_be_void};

/// Largest number of cells.
const MOST_CELLS: usize = 64;
/// Largest number of successive rewritings of one cell.
const MOST_ROUNDS: usize = 48;
/// Largest number of dependent roots and moduli whose signs are tried in all combinations.
const MOST_CHOICES: usize = 4;

/// The cells on which some groups are tested.
#[derive(Default)]
pub struct Explored {
    /// Cells that may contain real inputs, with the findings on each.
    pub leaves: Vec<Leaf>,
    /// Bound on the probability that a non-empty cell was dropped.
    pub certificate: Option<Certificate>,
}

/// Groups of values of a graph, with the places of their non-rational steps.
pub struct Question<'q> {
    /// Graph of the computation.
    pub graph: &'q Graph,
    /// Values that are tested together.
    pub groups: Vec<&'q [Expr]>,
    /// Places of roots, moduli, signs and functions that the groups need, and of sums whose signs are
    /// facts.
    pub special: &'q [usize],
    /// Values that exist wherever the groups are asked for.
    pub required: &'q [Expr],
}

/// A search through all cells.
pub struct Explorer<'p> {
    /// Values to be tested.
    pub question: &'p Question<'p>,
    /// Extents of the inputs, and the seed.
    pub prover: &'p Prover<'p>,
    /// Distributions of the inputs.
    pub sources: &'p [InputDistribution],
    /// Digest of the statement to be proved.
    pub digest: SeedDigest,
}

impl Explorer<'_> {
    /// Finds the outcome on all cells into which `cell` is divided.
    pub fn explore(&self, cell: Cell) -> Result<Explored, Fault> {
        let mut explored = Explored::default();
        if self.has_many_moduli() {
            let results = self.on_free_symbols("")?;
            let is_zero =
                |result: &Option<TrialResult>| matches!(result, Some(TrialResult::Zero(_)));
            if results.iter().all(is_zero) {
                explored.leaves.push(Leaf { cell, results });
                return Ok(explored);
            }
        }
        let (mut open, mut seen) = (vec![(cell, 0)], 1);
        let mut beyond: Option<Vec<Option<TrialResult>>> = None;
        while let Some((cell, round)) = open.pop() {
            let next = match (round >= MOST_ROUNDS || seen > MOST_CELLS, &beyond) {
                (false, _) => self.next(&cell)?,
                (true, Some(results)) => Next::Tested(results.clone()),
                (true, None) => {
                    let reason = format!(
                        "its roots and moduli have more than {MOST_CELLS} combinations of signs"
                    );
                    let results = self.on_free_symbols(&reason)?;
                    Next::Tested(beyond.insert(results).clone())
                }
            };
            let mut divided = |change: CellChange<'_>| -> Result<(), Fault> {
                open.push((cell.changed(&change)?, round + 1));
                Ok(())
            };
            match next {
                Next::Empty(certificate) => {
                    explored.certificate = both(explored.certificate, certificate);
                }
                Next::Rewrite(rewrites, certificate) => {
                    divided(CellChange {
                        rewrites: &rewrites,
                        certificate,
                        ..CellChange::default()
                    })?;
                }
                Next::DivideInput(input) => {
                    seen += 1;
                    for positive in [false, true] {
                        let fixed = Some((input, positive));
                        divided(CellChange { fixed, ..CellChange::default() })?;
                    }
                }
                Next::Divide { modulus, argument } => {
                    seen += 1;
                    let is_strict = vanishes_nowhere_openly(&cell.graph, argument, self.sources);
                    for positive in [false, true] {
                        let rewrites =
                            [Rewrite::Signed { place: modulus, positive, is_implied: false }];
                        let chosen = Some((argument, positive));
                        divided(CellChange {
                            rewrites: &rewrites,
                            chosen,
                            is_strict,
                            ..CellChange::default()
                        })?;
                    }
                }
                Next::Tested(results) => explored.leaves.push(Leaf { cell, results }),
            }
        }
        Ok(explored)
    }

    /// Whether the moduli have more combinations of signs than there may be cells, unless the ranges
    /// decide some.
    fn has_many_moduli(&self) -> bool {
        let Question { graph, special, .. } = self.question;
        let is_modulus =
            |place: &&usize| matches!(graph.step(**place), Step::Unary(UnaryFunction::Abs, _));
        1 << special.iter().filter(is_modulus).count().min(31) > MOST_CELLS
    }

    fn next(&self, cell: &Cell) -> Result<Next, Fault> {
        let (graph, known) = (&cell.graph, cell.known());
        let (inputs, classes) = (self.prover.extents, &Classes::default());
        let region = Region { graph, inputs, facts: &known, classes };
        if region.is_empty_at_sight() {
            return Ok(Next::Empty(None));
        }
        let (algebraic, related) =
            self.prover.lower(graph, &cell.values, self.sources, self.digest)?;
        Ok(self.on_lowered(cell, &algebraic, &region, &known)?.given(related))
    }

    /// Tests the groups with free symbols in the place of roots, moduli and functions, too many to be
    /// told apart.
    fn on_free_symbols(&self, reason: &str) -> Result<Vec<Option<TrialResult>>, Fault> {
        let is_thin = |value| self.prover.is_nonzero_on_all_cells(self.question.graph, value);
        let (question, inputs) = (self.question, self.sources.len());
        let zeros = zeros_for_free_symbols(question, &is_thin, inputs, self.digest)?;
        let silent = || TrialResult::Silent(reason.to_string());
        let results =
            zeros.into_iter().map(|zero| Some(zero.map_or_else(silent, TrialResult::Zero)));
        Ok(results.collect())
    }

    /// Finds the next action on a cell from its algebraic computation.
    fn on_lowered(
        &self,
        cell: &Cell,
        algebraic: &Algebraic<'_>,
        region: &Region<'_>,
        known: &[(usize, SignFact)],
    ) -> Result<Next, Fault> {
        let graph = &cell.graph;
        if !algebraic.has_few_signs() {
            return Ok(Next::Tested(self.on_free_symbols("it contains too many roots")?));
        }
        let trial = Trial::new(algebraic, self.digest);
        let tower = Tower::of(graph, algebraic, &trial, self.digest);
        let mut finder = RootFinder {
            graph,
            algebraic,
            trial: &trial,
            tower: &tower,
            region,
            digest: self.digest,
            samples: None,
        };
        let (mut rewrites, mut certificate) = (Vec::new(), None);
        let mut loose: Vec<usize> = Vec::new();
        for index in 0..algebraic.bases.len() {
            match finder.search(index)? {
                RootSearch::Independent => {}
                RootSearch::Rewrite(rewrite, own) => {
                    rewrites.push(rewrite);
                    certificate = both(certificate, own);
                }
                RootSearch::NeverReal(own) => return Ok(Next::Empty(own)),
                RootSearch::Unknown => {
                    loose.extend(algebraic.bases[index].links.iter().map(|(_, sign)| *sign));
                }
            }
        }
        let mut open = Vec::new();
        let evident = self.signs_at_sight(cell, algebraic);
        for modulus in &algebraic.moduli {
            if !tower.is_clean(algebraic, modulus.argument) {
                loose.push(modulus.sign);
                continue;
            }
            let argument = graph.step(modulus.place).arguments().next().unwrap_or(modulus.place);
            match region.sign(argument).or_else(|| region.sign_by_slopes(argument)) {
                Some(positive) => {
                    let is_implied = evident[argument].is_none();
                    let place = modulus.place;
                    rewrites.push(Rewrite::Signed { place, positive, is_implied });
                }
                None => match self.vanishes(&trial, &tower, modulus.argument) {
                    Some(own) => {
                        rewrites.push(Rewrite::Vanishing { place: modulus.place });
                        certificate = both(certificate, Some(own));
                    }
                    None => open.push((modulus.place, argument)),
                },
            }
        }
        if rewrites.is_empty() {
            rewrites = angles(graph, &cell.values);
        }
        if rewrites.is_empty() {
            let found = self.arctangents(cell, known);
            (rewrites, certificate) = (found.0, both(certificate, found.1));
        }
        if rewrites.is_empty() {
            let found = self.arctangent_sums(cell, known);
            (rewrites, certificate) = (found.0, both(certificate, found.1));
        }
        if rewrites.is_empty() {
            let (sources, digest) = (self.sources, self.digest);
            let rules = Rules { graph, algebraic, sources, digest };
            let found = rules.find(&cell.values);
            (rewrites, certificate) = (found.0, both(certificate, found.1));
        }
        if !rewrites.is_empty() {
            return Ok(Next::Rewrite(rewrites, certificate));
        }
        if let Some(next) = self.divide(cell, algebraic, &trial, &tower, open) {
            return Ok(next);
        }
        let tested = self.test(cell, algebraic, &trial, &tower, &loose, known)?;
        let is_zero =
            |result: &Option<TrialResult>| matches!(result, None | Some(TrialResult::Zero(_)));
        Ok(match &tested {
            Next::Tested(results) if !results.iter().all(is_zero) => {
                let sign = self.sign_of(cell, algebraic, &loose);
                let sign = sign.or_else(|| Some(self.free_signs(cell).next()?.1));
                sign.map_or(tested, Next::DivideInput)
            }
            _ => tested,
        })
    }

    /// Returns signs of arguments of moduli that follow from the ranges of the inputs, without facts.
    fn signs_at_sight(&self, cell: &Cell, algebraic: &Algebraic<'_>) -> Vec<Option<bool>> {
        let (graph, inputs, classes) = (&cell.graph, self.prover.extents, &Classes::default());
        let moduli = algebraic.moduli.iter();
        let arguments: Vec<usize> =
            moduli.filter_map(|modulus| graph.step(modulus.place).arguments().next()).collect();
        Region { graph, inputs, facts: &[], classes }.at_sight(&arguments)
    }

    /// Tests whether a value with independent roots alone vanishes identically; returns the
    /// certificate if so.
    fn vanishes(&self, trial: &Trial<'_>, tower: &Tower, value: Expr) -> Option<Certificate> {
        let roots = Roots { nested: tower.nested, fixed: &[] };
        match trial.test(&[&[value]], roots).pop() {
            Some(TrialResult::Zero(certificate)) => Some(certificate),
            _ => None,
        }
    }

    /// Tests all groups, with all choices of unknown signs.
    fn test(
        &self,
        cell: &Cell,
        algebraic: &Algebraic<'_>,
        trial: &Trial<'_>,
        tower: &Tower,
        loose: &[usize],
        known: &[(usize, SignFact)],
    ) -> Result<Next, Fault> {
        let Question { graph, groups, special, .. } = self.question;
        let all_silent = |reason: &str| Ok(Next::Tested(silent(groups.len(), reason)));
        if tower.standings.contains(&RootStatus::Unreached) {
            return all_silent("a root never exists at random points, or is reached too rarely");
        }
        if loose.len() > MOST_CHOICES {
            let reason = format!("{} roots or moduli depend on others", loose.len());
            return Ok(Next::Tested(self.on_free_symbols(&reason)?));
        }
        if cell.values.iter().any(|value| is_lost(cell, algebraic, *value)) {
            return all_silent("a function has no value in a prime field");
        }
        // The outputs themselves, built from their roots and functions as they are on this cell.
        let outputs = groups.concat();
        let reached = graph.reached(outputs.iter().copied());
        let replayed = |inputs: &[Expr], at: &dyn Fn(Expr) -> Option<Expr>| {
            let inputs = with_signs(inputs, cell.fixed.iter().copied());
            let mut made = vec![None; graph.len()];
            for (place, value) in special.iter().zip(&cell.values) {
                made[*place] = Some(at(algebraic.values[cell.graph.place(*value)]?)?);
            }
            let values = graph.repeated_with(&reached, &inputs, |place| made[place]);
            outputs.iter().map(|output| values[graph.place(*output)]).collect::<Option<Vec<Expr>>>()
        };
        let Some((extended, made)) = algebraic.with(replayed)? else {
            return all_silent("a function has no value in a prime field");
        };
        let all = self.by_group(&made);
        let is_never = |made: &[Expr]| made.iter().any(|x| extended.graph.is_nowhere_defined(*x));
        let may_be_void = may_be_void(cell);
        let has_none = |(made, group): (&&[Expr], &&[Expr])| {
            is_never(made)
                || may_be_void && self.has_void_argument(cell, algebraic, trial, tower, group)
        };
        let is_void: Vec<bool> = all.iter().zip(groups).map(has_none).collect();
        let pairs = all.iter().zip(&is_void);
        let asked: Vec<&[Expr]> =
            pairs.filter(|(_, is_void)| !**is_void).map(|(group, _)| *group).collect();
        let found = for_all_choices(&Trial::new(&extended, self.digest), &asked, tower, loose);
        let mut found = found.into_iter().zip(&asked).map(|(result, group)| match result {
            TrialResult::NonZero => unlike(&extended, group, loose),
            TrialResult::Zero(own) => {
                TrialResult::Zero(cell.certificate.map_or(own, |before| own.and(before)))
            }
            result => result,
        });
        let mut results: Vec<Option<TrialResult>> =
            is_void.iter().map(|is_void| if *is_void { None } else { found.next() }).collect();
        let is_open =
            |result: &TrialResult| matches!(result, TrialResult::NonZero | TrialResult::Silent(_));
        if results.iter().flatten().any(is_open) {
            // x/x is recorded as 1, and is undefined on a cell where x is 0.
            let Some((literal, made)) = algebraic.with(|inputs, at| {
                let special =
                    cell.values.iter().map(|value| at(algebraic.values[cell.graph.place(*value)]?));
                let special: Option<Vec<Expr>> = special.collect();
                Some([literally(|| replayed(inputs, at))?, special?].concat())
            })?
            else {
                return all_silent("a function has no value in a prime field");
            };
            let trial = Trial::new(&literal, self.digest);
            let roots = Roots { nested: tower.nested, fixed: &[] };
            let (made, special) = made.split_at(outputs.len());
            for (result, group) in results.iter_mut().zip(self.by_group(made)) {
                if result.as_ref().is_some_and(is_open) && trial.is_void(group, special, roots) {
                    *result = None;
                }
            }
        }
        let is_zero =
            |result: &Option<TrialResult>| matches!(result, None | Some(TrialResult::Zero(_)));
        if cell.is_part() && !results.iter().all(is_zero) {
            // Find out first whether the cell is empty.
            if let Some(empty) = self.empty(cell, algebraic, trial, tower, known)? {
                return Ok(empty);
            }
        }
        Ok(Next::Tested(results))
    }
}

impl Explorer<'_> {
    /// Splits the outputs of all groups, listed one after the other, by group.
    fn by_group<'o>(&self, outputs: &'o [Expr]) -> Vec<&'o [Expr]> {
        let mut rest = outputs;
        let own = |group: &&[Expr]| {
            let (own, others) = rest.split_at(group.len());
            rest = others;
            own
        };
        self.question.groups.iter().map(own).collect()
    }
}
