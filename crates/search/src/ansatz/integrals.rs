//! Search for integrals that are polynomials in velocities and positions over a denominator of the
//! geometry.

use super::super::ask::{holds, judged_alone};
use super::super::integrals::tell;
use super::super::products::Generators;
use super::super::terms::{is_one, read};
use super::super::{Effort, Excluded, SearchError, SearchReport, library};
use super::characters::SignChanges;
use super::coefficients::{PrimitiveVector, Ratio};
use super::dependent::DependentIntegrals;
use super::monomials::AnsatzVariables;
use super::size::SystemSize;
use super::subspace::complement;
use super::system::{Column, LinearSystem};
use super::theorem::{Outcome, theorem};
use super::{factors, note_unwritten};
use crate::absence::has_lists;
use crate::echelon::nonzero;
use crate::hypotheses::stated;
use crate::origin::{RemarkOrigin, TheoremOrigin};
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError};
use liouville::mechanics::{Model, System as Motion};
use liouville::order::StableOrder;
use liouville::verdict::Verdict;

/// Increment of the degree in the positions.
const STEP: u32 = 4;

/// Searches for integrals of the degrees at which the counts leave some, and where nothing was
/// counted, if asked to.
pub fn integrals(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    if !effort.ansatz.wanted {
        return Ok(());
    }
    let Some(variables) = AnsatzVariables::of(case) else {
        report.remark("no global ansatz: the level has no standard monomials here".to_string());
        return Ok(());
    };
    let mixed = case.model.system.energy_is_inhomogeneous();
    let degrees = if variables.have_velocities() { 1..=effort.degree } else { 0..=0 };
    let mut generators = Generators::all(case, effort, report)?;
    let mut dependent = DependentIntegrals::default();
    for degree in degrees {
        let known = generators.products(degree, mixed);
        let count = report.counts.iter().find(|count| !count.free && count.degree == degree);
        let dimension = count.map(|count| count.dimension);
        if dimension.is_some_and(|dimension| dimension <= known) {
            continue;
        }
        for below in denominators(&case.model)? {
            let mut search = IntegralSearch {
                case,
                effort,
                variables: &variables,
                degree,
                mixed,
                below,
                known: &mut generators,
                dependent: &mut dependent,
            };
            if search.run(dimension, report, progress)? {
                break;
            }
        }
    }
    dependent.note(report);
    Ok(())
}

/// Lists denominators of polynomials, simple ones first: all that a pole of the field allows.
fn denominators(model: &Model) -> Result<Vec<Formula>, FormulaError> {
    let mut found = library::denominators(model);
    let further: &[&str] = match &model.system {
        Motion::Rubber(_) => &["D_T", "det(Ĩ)*(γ,Ĩ⁻¹*γ)"],
        Motion::FlatBase(_) => &["(I1*I2 + m*(I1*r1² + I2*r2²))"],
        _ => &[],
    };
    found.extend(read(further.iter().copied(), &model.vocabulary));
    let squares: Result<Vec<Formula>, FormulaError> =
        found.iter().skip(1).map(|one| one.bracketed().raised(2)).collect();
    found.extend(squares?);
    Ok(found)
}

/// The search in one degree in the velocities, over one denominator.
struct IntegralSearch<'a> {
    case: &'a Case,
    effort: &'a Effort,
    variables: &'a AnsatzVariables,
    degree: u32,
    mixed: bool,
    below: Formula,
    /// Known integrals, including those found so far.
    known: &'a mut Generators,
    dependent: &'a mut DependentIntegrals,
}

impl IntegralSearch<'_> {
    /// Searches for integrals of increasing degree in the positions; returns whether all that were
    /// counted are found.
    fn run(
        &mut self,
        dimension: Option<usize>,
        report: &mut SearchReport,
        progress: &mut dyn FnMut(&str),
    ) -> Result<bool, SearchError> {
        let highest = self.effort.ansatz.positions;
        let mut steps: Vec<u32> = (1..).map(|k| k * STEP).take_while(|e| *e < highest).collect();
        steps.push(highest);
        for positions in steps {
            if !self.step(positions, positions == highest, report, progress)? {
                return Ok(true);
            }
            let products = self.known.products(self.degree, self.mixed);
            if dimension.is_some_and(|dimension| products >= dimension) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Solves one ansatz; `false` if it is too large, or has no states.
    fn step(
        &mut self,
        positions: u32,
        is_last: bool,
        report: &mut SearchReport,
        progress: &mut dyn FnMut(&str),
    ) -> Result<bool, SearchError> {
        let Self { case, effort, variables, .. } = *self;
        let seed = effort.options.seed;
        let below = std::slice::from_ref(&self.below);
        let over = factors(below)?;
        let generators = &*self.known;
        let known: Vec<Formula> = generators.formulas().cloned().collect();
        let mut outputs = Vec::new();
        let mut system = LinearSystem::record(case, effort, |jet, recording| {
            recording.derive(jet.along_field(), &variables.terms, &over);
            outputs = known.iter().map(|term| recording.give(jet.phase.scalar(term))).collect();
        })?;
        let lowest = if self.mixed { 0 } else { self.degree };
        let mut exponents: Vec<Vec<u32>> = (lowest..=self.degree)
            .flat_map(|degree| variables.monomials(degree, 0..=positions))
            .collect();
        // The last columns are the free ones: of high degree, so that the others have low degree.
        exponents.order_by_key(|own| own.iter().sum::<u32>());
        let product = |exponents| Column::Product { derivation: 0, factor: 0, exponents };
        system.columns = exponents.into_iter().map(product).collect();
        let blocks = SignChanges::of(case, variables, &over, seed)?.blocks(&system.columns);
        let size = SystemSize::of(&blocks);
        let what = self.words(positions);
        progress(&format!("{what}: {size}"));
        if let Some(reason) = size.beyond(effort) {
            let text = format!("{what}: not tried; {size}; {reason}");
            report.remark_of(RemarkOrigin::NotTried, text);
            return Ok(false);
        }
        let Some(at) = system.at(0, 0) else { return Ok(false) };
        let mut found: Vec<Vec<u64>> = Vec::new();
        for block in &blocks {
            let Some(vectors) = system.null_space(&at, block)? else { return Ok(false) };
            found.extend(vectors.into_iter().map(|vector| {
                let mut full = vec![0; system.columns.len()];
                block.iter().zip(vector).for_each(|(column, entry)| full[*column] = entry);
                full
            }));
        }
        found.order_by_key(|vector| vector.iter().rposition(|entry| *entry != 0));
        let (degree, mixed) = self.exponents(positions);
        let products: Vec<Vec<usize>> = generators
            .exponents(degree, mixed)
            .into_iter()
            .map(|powers| {
                let own = powers.iter().zip(&outputs);
                own.flat_map(|(power, output)| vec![*output; *power as usize]).collect()
            })
            .collect();
        let dimension = found.len();
        let Some(new) = complement(&system, &at, &found, &products)? else { return Ok(false) };
        let mut outcomes = Vec::new();
        for vector in &new {
            effort.halt.check()?;
            outcomes.push(self.tell(&system, vector, report)?);
        }
        if is_last || outcomes.contains(&Outcome::Told) {
            self.exclude(positions, dimension, &outcomes, report);
        }
        Ok(true)
    }

    /// Writes a null vector as a formula and judges it.
    fn tell(
        &mut self,
        system: &LinearSystem,
        vector: &[u64],
        report: &mut SearchReport,
    ) -> Result<Outcome, SearchError> {
        let Self { case, effort, .. } = *self;
        let support = nonzero(vector);
        let Some(coefficients) = PrimitiveVector::of(system, &support)? else {
            let (degree, count, below) = (self.degree, support.len(), &self.below);
            let what = format!("an integral of degree {degree} with {count} terms over {below}");
            note_unwritten(case, &what, report);
            return Ok(Outcome::Open);
        };
        let functions: Result<Vec<Ratio>, FormulaError> =
            support.iter().map(|k| self.monomial(&system.columns[*k])).collect();
        let all: Vec<usize> = (0..support.len()).collect();
        let sum = coefficients.sum(&all, &functions?)?.unwrap_or_else(|| Formula::number(0));
        let formula = match is_one(&self.below) {
            true => sum,
            false => (sum.bracketed() / &self.below.bracketed())?,
        };
        let verdict = judged_alone(case, Claim::integral(&formula), effort)?;
        let Some(verdict) = verdict else { return Ok(Outcome::Open) };
        if !holds(&verdict) {
            // What is found for the first of listed values may fail for others.
            if verdict.verdict != Verdict::Refuted || !has_lists(case) {
                report.remark(format!(
                    "found, but not proved ({}): {formula}",
                    verdict.verdict.word()
                ));
            }
            return Ok(Outcome::Open);
        }
        let all = self.known.formulas().cloned().chain([formula.clone()]).collect();
        let independence = judged_alone(case, Claim::independent(all), effort)?;
        match independence.map(|report| report.verdict) {
            Some(Verdict::Proved) => {
                let before = report.found.len();
                tell(case, &formula, verdict, effort, report)?;
                if report.found.len() == before {
                    return Ok(Outcome::Dependent);
                }
                *self.known = Generators::all(case, effort, report)?;
                Ok(Outcome::Told)
            }
            other => {
                let word = other.map_or("undecided", |verdict| verdict.word());
                self.dependent.add(word, &formula);
                Ok(Outcome::Dependent)
            }
        }
    }

    fn monomial(&self, column: &Column) -> Result<Ratio, FormulaError> {
        match column {
            Column::Product { exponents, .. } => self.variables.monomial(exponents).map(Ratio::of),
            Column::Given(_) => Ok(Ratio::of(Formula::number(1))),
        }
    }

    /// Degree of the products of known integrals that belong to the ansatz, and whether lower degrees do:
    /// that in the velocities, or in all variables if none is known to be one.
    fn exponents(&self, positions: u32) -> (u32, bool) {
        match self.variables.have_velocities() {
            true => (self.degree, self.mixed),
            false => (positions, true),
        }
    }

    fn words(&self, positions: u32) -> String {
        let below = match is_one(&self.below) {
            true => String::new(),
            false => format!(" over {}", self.below),
        };
        if !self.variables.have_velocities() {
            return format!(
                "polynomials of degree at most {positions} in the variables of the state{below}"
            );
        }
        let degree = if self.mixed { "at most " } else { "" };
        format!(
            "polynomials of degree {degree}{} in the velocities and at most {positions} in the positions{below}",
            self.degree
        )
    }

    /// States a theorem: an upper bound on the integrals that the ansatz contains.
    fn exclude(
        &self,
        positions: u32,
        dimension: usize,
        found: &[Outcome],
        report: &mut SearchReport,
    ) {
        let what = self.words(positions);
        let has_constants = matches!(self.exponents(positions), (0, _) | (_, true));
        let open = found.iter().filter(|own| **own == Outcome::Open).count();
        report.excluded.push(Excluded {
            theorem: stated(&self.case.model, &theorem(&what, has_constants, dimension, found)),
            ansatz: what,
            dimension,
            known: dimension - open,
            origin: TheoremOrigin::Ansatz,
            values: None,
            error_log2: None,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Ansatz;

    fn effort(degree: u32, positions: u32) -> Effort {
        Effort {
            degree,
            blind: true,
            ansatz: Ansatz { wanted: true, positions, ..Ansatz::default() },
            ..Effort::default()
        }
    }

    fn searched(text: &str, effort: &Effort) -> SearchReport {
        let case = Case::parse(text, &[]).expect("a case");
        let mut report = SearchReport::default();
        integrals(&case, effort, &mut report, &mut |_| {}).expect("it can be searched");
        report
    }

    #[test]
    fn nothing_is_found_where_there_is_nothing_and_what_is_too_large_is_left_out() {
        let body = "title='x'\nsystem='rubber-plane'\n[parameters]\nm='0.5..2'\nB='diag(1..4)'\n\
                    I='inertia(0.5..5)'\n[body]\nshape='ellipsoid'\n";
        let report = searched(body, &effort(2, 4));
        assert_eq!(report.found.len(), 0, "{:?}", report.found);
        let fits = |one: &&Excluded| {
            one.ansatz.contains("of degree 2 in") && one.ansatz.ends_with("over (γ,B*γ)")
        };
        let excluded = report.excluded.iter().find(fits).expect("the energy fits there");
        assert_eq!((excluded.dimension, excluded.known), (1, 1), "{}", excluded.theorem);
        let ansatz = Ansatz { megabytes: 1, ..effort(2, 40).ansatz };
        let report = searched(body, &Effort { ansatz, ..effort(2, 40) });
        assert!(report.remarks.iter().any(|one| one.contains("the bound is 1 MB")), "it is told");
    }
}
