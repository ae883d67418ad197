//! Integrals in involution among those found, and the theorem of Liouville with them.
//!
//! ```text
//! integrals → the pairs in involution → sets of them → one that is complete, with its proof
//! ```
//!
//! Of integrals like an angular momentum no two are in involution, but each is with the sum of their
//! squares: such sums are tried too.

use serde::Serialize;

use super::definitions::Definition;
use super::hierarchy::HierarchyPlace;
use super::independence::{Entry, IndependentSelection, functions};
use super::question::TestedClaim;
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::Formula;
use liouville::mechanics::System;
use liouville::order::StableOrder;
use liouville::verdict::{ClaimReport, JudgeError, Options, Verdict, judge};

/// Largest number of integrals of which pairs are tried.
const MOST_INTEGRALS: usize = 12;
/// Largest number of sums of squares.
const MOST_SUMS: usize = 4;
/// Largest number of sets for which the theorem is tried.
const MOST_SETS: usize = 6;

/// Proof that the hypotheses of Liouville's theorem hold.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LiouvilleProof {
    /// Names of the integrals in involution, the energy first if it is one of them.
    pub functions: Vec<String>,
    /// Dimension of the tori.
    pub tori: usize,
    /// Bracket: `momenta`, `hamiltonian`, or the name of one in the file.
    pub bracket: String,
    /// Claim that the integrals are in involution, independent and as many as needed.
    pub claim: ClaimReport,
}

/// A function with its name.
#[derive(Clone)]
struct NamedFunction {
    formula: Formula,
    label: String,
}

/// Tries to prove with the selected integrals that the hypotheses of Liouville's theorem hold.
pub fn proof(
    case: &Case,
    options: &Options,
    bindings: &[Definition],
    integrals: &[&TestedClaim],
    selection: &IndependentSelection,
) -> Result<Option<LiouvilleProof>, JudgeError> {
    let entries: Vec<&Entry> = selection.entries.iter().collect();
    let count = entries.len() + usize::from(selection.has_energy);
    let dimension = selection.count.dimension;
    if count == 0 || count > MOST_INTEGRALS || 2 * count < dimension {
        return Ok(None);
    }
    let brackets = brackets(case);
    if brackets.is_empty() {
        return Ok(None);
    }
    let made = functions(case, bindings, selection.has_energy, integrals, &entries);
    let Some((named, formulas)) = made else { return Ok(None) };
    let energy = selection.has_energy.then(|| "energy".to_string());
    let labels = energy.into_iter().chain(entries.iter().map(|entry| entry.label(integrals)));
    let all: Vec<NamedFunction> = formulas
        .into_iter()
        .zip(labels)
        .map(|(formula, label)| NamedFunction { formula, label })
        .collect();
    for bracket in brackets {
        let attempt = Attempt { case: &named, options, bracket, dimension };
        if let Some(found) = attempt.prove(all.clone())? {
            return Ok(Some(found));
        }
    }
    Ok(None)
}

/// Names of the brackets in which a motion may be Hamiltonian; empty for that of the momenta.
fn brackets(case: &Case) -> Vec<String> {
    let model = &case.model;
    let given = model.variables.iter().flat_map(|own| &own.brackets);
    let mut all: Vec<String> = given.map(|own| own.name.clone()).collect();
    if let System::Lagrangian(own) = &model.system
        && own.has_canonical_momenta()
        && model.level.is_empty()
        && all.is_empty()
    {
        all.push(String::new());
    }
    all
}

/// Proofs with one bracket.
struct Attempt<'c> {
    case: &'c Case,
    options: &'c Options,
    bracket: String,
    /// Dimension of the level set.
    dimension: usize,
}

impl Attempt<'_> {
    fn prove(&self, mut all: Vec<NamedFunction>) -> Result<Option<LiouvilleProof>, JudgeError> {
        let mut commute = self.pairs(&all)?;
        let sums = sums(&all, &commute);
        if !sums.is_empty() {
            all.extend(sums);
            commute = self.pairs(&all)?;
        }
        for set in sets(&commute, self.dimension).into_iter().take(MOST_SETS) {
            let chosen: Vec<&NamedFunction> = set.iter().map(|place| &all[*place]).collect();
            let Some(claim) = self.theorem(&chosen)? else { continue };
            return Ok(Some(LiouvilleProof {
                functions: chosen.iter().map(|own| own.label.clone()).collect(),
                tori: self.dimension.saturating_sub(chosen.len()),
                bracket: match self.bracket.is_empty() {
                    true => "momenta".to_string(),
                    false => self.bracket.clone(),
                },
                claim,
            }));
        }
        Ok(None)
    }

    /// Claims that functions are in involution in the bracket.
    fn claim(&self, functions: Vec<Formula>) -> Claim {
        let claim = Claim::involution(functions);
        match self.bracket.is_empty() {
            true => claim,
            false => claim.with("poisson", self.bracket.as_str()),
        }
    }

    /// Finds which pairs are proved to be in involution.
    fn pairs(&self, all: &[NamedFunction]) -> Result<Vec<Vec<bool>>, JudgeError> {
        let count = all.len();
        let mut commute = vec![vec![false; count]; count];
        let places: Vec<(usize, usize)> =
            (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j))).collect();
        let pair = |(i, j): &(usize, usize)| {
            self.claim(vec![all[*i].formula.clone(), all[*j].formula.clone()])
        };
        let claims: Vec<Claim> = places.iter().map(pair).collect();
        let Some(asked) = self.case.with_claims(&claims).ok().filter(|_| !claims.is_empty()) else {
            return Ok(commute);
        };
        let judged = judge(&asked, self.options)?.claims;
        for ((i, j), claim) in places.into_iter().zip(judged) {
            commute[i][j] = claim.verdict == Verdict::Proved;
            commute[j][i] = commute[i][j];
        }
        Ok(commute)
    }

    /// Proves that Liouville's theorem applies with these functions.
    fn theorem(&self, chosen: &[&NamedFunction]) -> Result<Option<ClaimReport>, JudgeError> {
        let functions = chosen.iter().map(|own| own.formula.clone()).collect();
        let claim = self.claim(functions).with("theorem", "Liouville").named("in involution");
        let Ok(asked) = self.case.with_claims(&[claim]) else { return Ok(None) };
        let judged = judge(&asked, self.options)?.claims.into_iter().next();
        Ok(judged.filter(|claim| claim.verdict == Verdict::Proved))
    }
}

/// Sums of the squares of three functions no two of which are in involution.
fn sums(all: &[NamedFunction], commute: &[Vec<bool>]) -> Vec<NamedFunction> {
    let count = all.len();
    let triples = (0..count)
        .flat_map(|i| (i + 1..count).flat_map(move |j| (j + 1..count).map(move |k| [i, j, k])));
    let is_apart =
        |[i, j, k]: &[usize; 3]| !commute[*i][*j] && !commute[*i][*k] && !commute[*j][*k];
    let sum = |triple: [usize; 3]| {
        let squares: Option<Vec<Formula>> =
            triple.iter().map(|place| all[*place].formula.bracketed().raised(2).ok()).collect();
        let squares = squares?;
        let formula = ((&squares[0] + &squares[1]).ok()? + &squares[2]).ok()?;
        let labels: Vec<String> = triple.iter().map(|place| squared(&all[*place].label)).collect();
        Some(NamedFunction { formula, label: labels.join(" + ") })
    };
    triples.filter(is_apart).filter_map(sum).take(MOST_SUMS).collect()
}

fn squared(label: &str) -> String {
    let is_name = |c: char| c.is_alphanumeric() || matches!(c, '[' | ']' | ',' | '_');
    match label.chars().all(is_name) {
        true => format!("{label}²"),
        false => format!("({label})²"),
    }
}

/// Sets of functions in involution, as many as may be complete on a level of this dimension: larger
/// sets first, as they take Casimir functions into account, and those of earlier functions before others.
fn sets(commute: &[Vec<bool>], dimension: usize) -> Vec<Vec<usize>> {
    let mut found: Vec<Vec<usize>> = Vec::new();
    let mut open: Vec<Vec<usize>> = (0..commute.len()).map(|place| vec![place]).collect();
    while !open.is_empty() {
        let fits = |set: &&Vec<usize>| 2 * set.len() >= dimension && set.len() < dimension;
        found.extend(open.iter().filter(fits).cloned());
        let longer = |set: &Vec<usize>| {
            let last = set.last().map_or(0, |last| last + 1);
            let more =
                (last..commute.len()).filter(|next| set.iter().all(|own| commute[*own][*next]));
            more.map(|next| [set.as_slice(), &[next]].concat()).collect::<Vec<_>>()
        };
        open = open.iter().flat_map(longer).collect();
    }
    found.order_by_key(|set| std::cmp::Reverse(set.len()));
    found
}

impl HierarchyPlace {
    /// Adds what follows from Liouville's theorem, and from the number of all independent integrals of a
    /// system whose rates do not depend on time, on a level set of some dimension.
    pub fn refine(
        &mut self,
        liouville: Option<&LiouvilleProof>,
        independent: usize,
        dimension: usize,
    ) {
        let are_curves = dimension > 2 && independent + 1 == dimension;
        let Some(proof) = liouville else {
            if are_curves {
                self.typical = vec![ON_CURVES.to_string()];
            }
            return;
        };
        let (count, names) = (proof.functions.len(), proof.functions.join(", "));
        self.grounds.truncate(1);
        self.grounds.push(match count {
            1 => format!(
                "integrable by Liouville's theorem: one degree of freedom, and the integral {names}"
            ),
            _ => format!(
                "integrable by Liouville's theorem: {count} integrals in involution ({names})"
            ),
        });
        let tori = match proof.tori {
            1 => "is a closed orbit".to_string(),
            many => format!("is a torus of dimension {many} with a quasi-periodic motion"),
        };
        let these = match count {
            1 => {
                "the integral on which its gradient and the equations of motion are not 0, and both are smooth,"
            }
            _ => {
                "these integrals on which they are independent, their fields span it, and they and the \
                 equations of motion are smooth,"
            }
        };
        self.typical = vec![format!("a compact connected level of {these} {tori}")];
        if independent > count {
            self.typical.push(match are_curves {
                true => format!(
                    "superintegrable: {independent} independent integrals on a space of dimension \
                     {dimension}; where they are continuous and independent on such a torus, each motion on \
                     it is closed"
                ),
                false => format!(
                    "superintegrable: {independent} independent integrals on a space of dimension \
                     {dimension}; where they are continuous and independent on such a torus, each motion on \
                     it stays on a smaller one of dimension at most {}",
                    dimension.saturating_sub(independent)
                ),
            });
        }
        self.typical.push("no attractors and no chaos on such levels".to_string());
    }
}

const ON_CURVES: &str = "there are enough integrals that their joint levels are curves, where they are \
                         smooth and independent; a compact one without equilibria is a closed orbit";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_of_functions_that_all_commute() {
        // 0 commutes with all, 1 and 2 with 0 alone.
        let commute =
            vec![vec![false, true, true], vec![true, false, false], vec![true, false, false]];
        assert_eq!(sets(&commute, 4), [[0, 1], [0, 2]]);
        assert!(sets(&commute, 6).is_empty(), "three are needed");
        assert_eq!(sets(&commute, 3), [[0, 1], [0, 2]], "and fewer than the dimension");
        assert_eq!(sets(&commute, 2), [[0], [1], [2]], "one degree of freedom");
    }
}
