//! Search for brackets of a field with a known Hamiltonian: skew P with v = N P ∂H/∂x.
//!
//! The entries of P are those of a family. v = N P ∂H is linear in its unknown numbers, for each of
//! some multipliers N; constants and low degrees come first, so that the reported solution consists
//! of them where possible. On a level set P ∂F = 0 is added for each level function F: then P is a
//! bracket of functions on the level. Jacobi's identity is quadratic: it is tested for this solution
//! and some others, and for their products with functions.

use num_bigint::BigInt;
use num_integer::Integer;

use super::super::ask::{holds, judged, judged_alone, proved_energy};
use super::super::terms::integers;
use super::super::{Effort, Found, FoundKind, Given, SearchError, SearchReport, branches};
use super::bracket_absence::Absence;
use super::bracket_family::BracketFamily;
use super::hamiltonians::{level_functions, written_energy};
use super::scales::{Scale, Scales};
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError, Type};
use liouville::number::rational::Rational;
use liouville::verdict::Verdict;

/// Largest number of state components.
const DIMENSION: usize = 8;
/// Number of solutions of P ∂H = 0 that are added, once with each sign, where Jacobi's identity
/// fails.
const BESIDE: usize = 12;
/// Number of those whose multiples are found by linear equations for products of unknowns.
const COMBINED: usize = 4;
/// Length of a bracket, in characters, that is printed although it is none.
const SHORT: usize = 300;

/// The Hamiltonians for which brackets are searched.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Hamiltonians {
    /// All integrals found or claimed.
    Known,
    /// The given formula.
    Given(String),
}

/// Searches for a bracket for each Hamiltonian.
pub fn brackets(
    case: &Case,
    wanted: &Hamiltonians,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let model = &case.model;
    let is_matrix = model.state.iter().any(|variable| matches!(variable.kind, Type::Matrix(..)));
    if !model.extension.is_empty() || model.dimension() > DIMENSION || is_matrix {
        report.remark(format!(
            "no search for brackets: it takes at most {DIMENSION} variables, none a matrix"
        ));
        return Ok(());
    }
    let known: Vec<Formula> = {
        let claimed = report.claimed.iter().map(|one| &one.formula);
        // A find that the claims imply would be searched twice.
        let found = report.of_case(FoundKind::Integral).filter(|found| found.known.is_none());
        found.filter_map(Found::function).chain(claimed).cloned().collect()
    };
    let functions = match wanted {
        Hamiltonians::Known => {
            written_energy(case, effort)?.into_iter().chain(known.clone()).collect()
        }
        Hamiltonians::Given(text) => {
            vec![super::super::FurtherTerm::from(text.as_str()).read(model)?]
        }
    };
    if functions.is_empty() {
        let reason = match proved_energy(case, effort)? {
            Some(_) => {
                "the only known integral is the energy; write it in the state and the parameters \
                        alone with --poisson=H"
            }
            None => "no integral is known; give a Hamiltonian with --poisson=H",
        };
        report.remark(format!("no search for brackets: {reason}"));
        return Ok(());
    }
    let families = match BracketFamily::all(case, effort) {
        Err(error @ (SearchError::NoChart | SearchError::NoPoints)) => {
            report.remark(format!("no search for brackets: {error}"));
            return Ok(());
        }
        made => made?,
    };
    let logarithmic = BracketFamily::log_canonical(case, effort)?;
    let scales = Scales::of(case, effort, report)?;
    let level = level_functions(case)?;
    let proves = branches::are_true(case, effort)?;
    let mut absences: Vec<Absence<'_>> = Vec::new();
    for hamiltonian in functions {
        effort.halt.check()?;
        let name = hamiltonian.to_string();
        progress(&format!("brackets with the Hamiltonian {name}"));
        let own = HamiltonianSearch { case, effort, hamiltonian, scales: &scales, level: &level };
        let Some(first) = families.first().map(|family| own.within(family)) else { continue };
        // A function that claims about a bracket cannot read, such as `energy`, is not tried as a
        // Hamiltonian.
        if first.with_bracket(&[]).and_then(|asked| first.reads(&asked)).is_err() {
            report.remark(format!(
                "no search for brackets with the Hamiltonian {name}: write it in the state and the parameters alone"
            ));
            continue;
        }
        if let Some(family) = &logarithmic
            && own.within(family).is_found(&known, report)?
        {
            continue;
        }
        for found in own.search(&families, proves, &known, report)? {
            found.join(&mut absences);
        }
    }
    for absence in &absences {
        report.excluded.push(absence.theorem(&scales, &level)?);
    }
    let has_weights = families.len() > 1;
    if has_weights && !absences.is_empty() {
        report.remark(
            "brackets whose coefficients are other functions of the parameters are not sought; give values with --set"
                .to_string(),
        );
    }
    Ok(())
}

/// The search for brackets with one Hamiltonian.
pub(super) struct HamiltonianSearch<'a> {
    case: &'a Case,
    pub(super) effort: &'a Effort,
    pub(super) hamiltonian: Formula,
    pub(super) scales: &'a Scales,
    /// Level functions.
    pub(super) level: &'a [Formula],
}

/// The same within one family.
pub(super) struct BracketSearch<'a> {
    pub(super) case: &'a Case,
    pub(super) family: &'a BracketFamily,
    pub(super) of: &'a HamiltonianSearch<'a>,
}

impl<'a> HamiltonianSearch<'a> {
    fn within(&'a self, family: &'a BracketFamily) -> BracketSearch<'a> {
        BracketSearch { case: self.case, family, of: self }
    }

    /// Tries the multipliers in turn, each in all families, until a bracket is found.
    fn search<'f>(
        &self,
        families: &'f [BracketFamily],
        proves: bool,
        known: &[Formula],
        report: &mut SearchReport,
    ) -> Result<Vec<Absence<'f>>, SearchError> {
        let name = &self.hamiltonian;
        let (mut seconds, mut unsolved) = (0.0, None);
        let absence = |family| {
            let hamiltonians = vec![name.to_string()];
            Absence { family, hamiltonians, multipliers: Vec::new() }
        };
        let mut absences: Vec<Absence<'_>> = families.iter().map(absence).collect();
        'all: for multiplier in self.scales.multipliers() {
            for absence in &mut absences {
                self.effort.halt.check()?;
                let own = self.within(absence.family);
                seconds += own.family.seconds();
                if seconds > self.effort.seconds && !multiplier.is_one() {
                    report.remark(format!(
                        "brackets with {name}: not all multipliers of time are tried; the bound is {} s, see --count-seconds",
                        self.effort.seconds
                    ));
                    break 'all;
                }
                let found = match own.solved(&multiplier) {
                    Err(error @ (SearchError::NoChart | SearchError::NoPoints)) => {
                        if multiplier.is_one() {
                            report.remark(format!("no search for brackets with {name}: {error}"));
                        }
                        continue;
                    }
                    found => found?,
                };
                match &found.solution {
                    Some(solution) => {
                        match own.judge(solution, &found.beside, &multiplier, known, report)? {
                            None => return Ok(Vec::new()),
                            Some(reason) => unsolved = unsolved.or(Some(reason)),
                        }
                    }
                    None if found.irrational > 0 => report.remark(format!(
                        "brackets with {name}: their coefficients are not small rational numbers"
                    )),
                    None if proves && own.are_proved(&found.beside)? => {
                        absence.multipliers.push(multiplier.clone());
                    }
                    None => report.remark(format!(
                        "no bracket was found with {name}; its absence is not proved"
                    )),
                }
            }
        }
        // One solution that is no bracket stands for all.
        unsolved.into_iter().for_each(|reason| report.remark(reason));
        Ok(Absence::strongest(absences))
    }
}

impl BracketSearch<'_> {
    /// Whether a bracket of the family with v = P ∂H is found, and reported.
    fn is_found(&self, known: &[Formula], report: &mut SearchReport) -> Result<bool, SearchError> {
        let multiplier = self.of.scales.one();
        let solution = match self.solved(&multiplier) {
            Err(SearchError::NoChart | SearchError::NoPoints) => None,
            solved => solved?.solution,
        };
        let Some(solution) = solution else { return Ok(false) };
        let entries = self.entries(&integers(&solution))?;
        self.is_bracket(&entries, &multiplier, &multiplier, known, report)
    }

    /// Tests Jacobi's identity, first for the solution, then for its sums and differences with
    /// solutions of P ∂H = 0; for each also for its product with N, and with a function that is found.
    /// Reports a bracket, or returns the reason why none is reported.
    fn judge(
        &self,
        solution: &[Rational],
        beside: &[Vec<Rational>],
        multiplier: &Scale,
        known: &[Formula],
        report: &mut SearchReport,
    ) -> Result<Option<String>, SearchError> {
        let scales = self.of.scales;
        let entries = self.entries(&integers(solution))?;
        if self.is_bracket(&entries, multiplier, multiplier, known, report)? {
            return Ok(None);
        }
        let mut tensors = vec![self.tensor(&entries)];
        for other in beside.iter().take(COMBINED) {
            tensors.push(self.tensor(&self.entries(&integers(other))?));
        }
        if let Some((numbers, scale)) = scales.mended(self.case, &tensors, self.of.effort)? {
            let mut sum = solution.to_vec();
            for (number, other) in numbers.iter().zip(beside) {
                let scaled = integers(other);
                for (entry, other) in sum.iter_mut().zip(scaled) {
                    let other = Rational::from_parts(other, BigInt::from(1));
                    *entry = &*entry - &(number * &other);
                }
            }
            let entries = self.entries(&integers(&sum))?;
            if self.is_bracket(&entries, multiplier, &scale, known, report)? {
                return Ok(None);
            }
        }
        let shifted = beside
            .iter()
            .take(BESIDE)
            .flat_map(|other| [1, -1].map(|sign| shifted(solution, other, sign)));
        let mut tried = 0;
        for multiples in shifted {
            self.of.effort.halt.check()?;
            tried += 1;
            let entries = self.entries(&multiples)?;
            if self.is_bracket(&entries, multiplier, multiplier, known, report)? {
                return Ok(None);
            }
        }
        let name = &self.of.hamiltonian;
        let (equation, factor) = match multiplier.is_one() {
            true => ("v = P ∂H", String::new()),
            false => ("v = N P ∂H", format!(", N = {}", scales.formula(multiplier)?)),
        };
        let shown = self.shown(&entries);
        let own = match shown.chars().count() > SHORT {
            true => "some P".to_string(),
            false => shown,
        };
        let others = match tried {
            0 => String::new(),
            count => format!(
                "; so do {count} others of the {}-dimensional family that were tried",
                beside.len()
            ),
        };
        Ok(Some(format!(
            "{equation} with H = {name}{factor} and {own}, but this P fails Jacobi's identity, or is not proved{others}"
        )))
    }

    /// All entries of a tensor, by rows.
    fn tensor(&self, entries: &[Formula]) -> Vec<Vec<Formula>> {
        let all = 0..self.family.names.len();
        all.clone().map(|i| all.clone().map(|j| self.entry(entries, i, j)).collect()).collect()
    }

    /// Reports the bracket sP with v = N P ∂H if it is proved to be one; `false` if it is not.
    fn is_bracket(
        &self,
        entries: &[Formula],
        multiplier: &Scale,
        scale: &Scale,
        known: &[Formula],
        report: &mut SearchReport,
    ) -> Result<bool, SearchError> {
        let (scales, model) = (self.of.scales, &self.case.model);
        let (name, level) = (&self.of.hamiltonian, self.of.level);
        let entries: Result<Vec<Formula>, FormulaError> =
            entries.iter().map(|entry| scales.scaled(entry, scale)).collect();
        let entries = entries?;
        let time = multiplier.over(scale);
        let time = match time.is_one() {
            true => None,
            false => Some(scales.formula(&time)?),
        };
        let asked = self.with_bracket(&entries)?;
        let mut hamiltonian = Claim::hamiltonian(asked.in_variables(name)?);
        if let Some(time) = &time {
            hamiltonian = hamiltonian.with("multiplier", asked.in_variables(time)?);
        }
        let mut claims = vec![hamiltonian, Claim::jacobi_identity()];
        for function in level {
            claims.push(Claim::casimir(asked.in_variables(function)?));
        }
        let reports = judged(&asked, &claims, self.of.effort)?;
        if !reports.iter().all(holds) {
            return Ok(false);
        }
        let mut with = vec![Given::Hamiltonian(name.clone())];
        with.extend(time.map(Given::Multiplier));
        with.extend(level.iter().cloned().map(Given::Casimir));
        for casimir in known.iter().filter(|other| other.text() != name.text()) {
            if self.is_casimir(&asked, casimir)? {
                with.push(Given::Casimir(casimir.clone()));
            }
        }
        // Use the weakest of the verdicts.
        let weakest = reports.into_iter().min_by_key(|own| own.verdict == Verdict::Proved);
        if let Some(weakest) = weakest {
            let (text, parts) = (self.shown(&entries), entries.iter().collect::<Vec<_>>());
            let mut found = Found::of_several(FoundKind::Bracket, text, &parts, weakest, model);
            found.with = with;
            report.found.push(found);
        }
        Ok(true)
    }

    pub(super) fn is_casimir(&self, asked: &Case, function: &Formula) -> Result<bool, SearchError> {
        // The function may contain names that formulas in the variables of a bracket cannot.
        let Ok(function) = asked.in_variables(function) else { return Ok(false) };
        let report = judged_alone(asked, Claim::casimir(function), self.of.effort)?;
        Ok(report.is_some_and(|own| own.verdict == Verdict::Proved))
    }

    /// Checks that the Hamiltonian and the level functions can be read in the variables of a bracket.
    fn reads(&self, asked: &Case) -> Result<(), SearchError> {
        for function in [&self.of.hamiltonian].into_iter().chain(self.of.level) {
            asked.with_claims(&[Claim::casimir(asked.in_variables(function)?)])?;
        }
        Ok(())
    }
}

/// Multiples of the sum or difference of two vectors.
fn shifted(solution: &[Rational], other: &[Rational], sign: i64) -> Vec<BigInt> {
    let sum = |a: &Rational, b: &Rational| {
        let ((a, below_a), (b, below_b)) = (a.parts(), b.parts());
        (a * &below_b + b * sign * &below_a, below_a * below_b)
    };
    let parts: Vec<(BigInt, BigInt)> = solution.iter().zip(other).map(|(a, b)| sum(a, b)).collect();
    let below = parts.iter().fold(BigInt::from(1), |lcm, (_, own)| lcm.lcm(own));
    parts.iter().map(|(above, own)| above * (&below / own)).collect()
}
