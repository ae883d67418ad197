//! Potentials under which an integral persists, within a linear ansatz.
//!
//! Let F be an integral of degree 2 in ω, and A(∇U) the contribution of a potential U to ω', linear
//! in ∇U. Then F + G(γ) is an integral with U exactly when (∂F/∂ω, A(∇U)) + L_v G = 0: linear in U
//! and G. Both are polynomials over some denominators, without constant terms. With P_i = (∂F/∂ω,
//! A(e_i)) the first term is the derivative of U along γ → γ + tP.

use super::super::ask::{holds, is_energy, judged_alone};
use super::super::products::Generators;
use super::super::terms::read;
use super::super::{Effort, Excluded, Found, SearchError, SearchReport};
use super::coefficients::{PrimitiveVector, Ratio};
use super::forces::{appended, combination, with_constants, with_potential};
use super::monomials::AnsatzVariables;
use super::size::SystemSize;
use super::system::{Column, LinearSystem};
use super::{factors, note_unwritten, written};
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError};
use liouville::graph::Expr;
use liouville::mechanics::{Model, Phase};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Highest degree of a potential's numerators.
const POTENTIAL: u32 = 4;
/// Highest degree of the numerators of the terms added to an integral.
const GAIN: u32 = 6;

/// Finds, for each known integral of degree 1 or 2, the potentials under which it persists.
pub fn potentials(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let axes = read(["γ1", "γ2", "γ3"], &case.model.vocabulary);
    let unit: Option<Vec<Model>> =
        axes.iter().map(|component| with_potential(&case.model, component)).collect();
    let unit = unit.filter(|unit| unit.len() == 3);
    let (Some(variables), Some(unit)) = (AnsatzVariables::of(case), unit) else {
        let reason = "the system admits none, or has one with free coefficients";
        report.remark(format!("no search for potentials: {reason}"));
        return Ok(());
    };
    let generators = Generators::all(case, effort, report)?;
    let own: Vec<Formula> = generators
        .each()
        .filter(|(formula, degree)| !is_energy(formula) && (1..=2).contains(degree))
        .map(|(formula, _)| formula.clone())
        .collect();
    if own.is_empty() {
        report.remark(
            "no integral of degree 1 or 2 is known that could survive a potential".to_string(),
        );
    }
    for integral in own {
        effort.halt.check()?;
        let family = PotentialSearch { case, effort, variables: &variables, unit: &unit, integral };
        family.search(report, progress)?;
    }
    Ok(())
}

/// The search for the potentials that preserve one integral.
struct PotentialSearch<'a> {
    case: &'a Case,
    effort: &'a Effort,
    variables: &'a AnsatzVariables,
    /// Models with an additional potential γ_i.
    unit: &'a [Model],
    integral: Formula,
}

impl PotentialSearch<'_> {
    fn search(
        &self,
        report: &mut SearchReport,
        progress: &mut dyn FnMut(&str),
    ) -> Result<(), SearchError> {
        let vocabulary = &self.case.model.vocabulary;
        let below = ["1", "γ1²", "γ2²", "γ3²", "(γ,B*γ)", "(γ,J⁻¹*γ)"];
        let below = read(below, vocabulary);
        let mut system = self.recorded(&factors(&below)?)?;
        let product = |derivation| {
            move |(factor, exponents): (usize, Vec<u32>)| Column::Product {
                derivation,
                factor,
                exponents,
            }
        };
        let all = |degree: u32| -> Vec<(usize, Vec<u32>)> {
            (0..below.len())
                .flat_map(|factor| {
                    let monomials = self.variables.monomials(0, 0..=degree);
                    monomials.into_iter().map(move |exponents| (factor, exponents))
                })
                .collect()
        };
        // The potential's columns are last, so that its coefficients are the free ones.
        let gains: Vec<Column> = all(GAIN).into_iter().map(product(1)).collect();
        let potentials: Vec<Column> = all(POTENTIAL).into_iter().map(product(0)).collect();
        let first = gains.len();
        system.columns = gains.into_iter().chain(potentials).collect();
        let count = system.columns.len();
        let size = SystemSize::of(&[(0..count).collect()]);
        let what = format!("potentials that preserve {}", self.integral);
        progress(&format!("{what}: {size}"));
        if let Some(reason) = size.beyond(self.effort) {
            report.remark(format!("{what}: not tried; {size}; {reason}"));
            return Ok(());
        }
        let Some(at) = system.at(0, 0) else { return Ok(()) };
        let mut columns = Vec::new();
        for range in [0..first, first..count] {
            let own: Vec<usize> = range.collect();
            let Some(distinct) = system.distinct(&at, &own)? else { return Ok(()) };
            // The constant is the first of the functions; it has no effect.
            columns.extend(distinct.into_iter().filter(|column| *column != own[0]));
        }
        let Some(vectors) = system.null_space(&at, &columns)? else { return Ok(()) };
        let mut found = Vec::new();
        for vector in &vectors {
            let pairs = columns.iter().zip(vector).filter(|(_, entry)| **entry != 0);
            let support: Vec<usize> = pairs.map(|(column, _)| *column).collect();
            if support.last().is_none_or(|last| *last < first) {
                continue;
            }
            let Some(coefficients) = PrimitiveVector::of(&system, &support)? else {
                let what = format!("a potential with {} terms", support.len());
                note_unwritten(self.case, &what, report);
                continue;
            };
            let sum = |potential: bool| {
                let own = |k: &usize| (support[*k] >= first) == potential;
                let own: Vec<usize> = (0..support.len()).filter(own).collect();
                let function =
                    |k: &usize| written(self.variables, &below, &system.columns[support[*k]]);
                let functions: Vec<Ratio> =
                    own.iter().map(function).collect::<Result<_, FormulaError>>()?;
                coefficients.sum(&own, &functions)
            };
            // the support ends with a column of a potential
            let Some(potential) = sum(true)? else { continue };
            found.push((potential, sum(false)?));
        }
        let told = self.tell(&found, report)?;
        let names: Vec<&str> = below.iter().map(Formula::text).collect();
        let names = names.join(", ");
        let dimension = vectors.len();
        report.excluded.push(Excluded {
            ansatz: format!("potentials U = Σ p/d, p a polynomial in γ of degree at most {POTENTIAL}, d one of {names}"),
            dimension,
            known: told,
            error_log2: None,
            theorem: format!(
                "For generic values of the free parameters, and the given values of the fixed ones, at most {dimension} independent potentials of this form, \
                 constants aside, allow an integral {} + G(γ) with G = Σ p/d, p of degree at most {GAIN}{}.",
                self.integral,
                if told == dimension && told > 0 { ": those listed here" } else { "" }
            ),
        });
        Ok(())
    }

    /// Records derivatives along γ → γ + tP with P_i = (∂F/∂ω, A(e_i)), and along the motion.
    fn recorded(&self, over: &[Formula]) -> Result<LinearSystem, SearchError> {
        let Self { case, effort, variables, .. } = self;
        LinearSystem::record(case, effort, |jet, recording| {
            let state = jet.phase.state();
            let field = jet.phase.field();
            let gains = self.unit.iter().map(|model| {
                let beside: Phase<'_, _> = jet.phase.in_model(model, &state);
                let moved = beside.field().iter().zip(field);
                let direction: Vec<_> = moved.map(|(with, without)| *with - *without).collect();
                jet.phase.lift(&direction).scalar(&self.integral).eps
            });
            let gains: Vec<Expr> = gains.collect();
            let velocities = state.len() - gains.len();
            let mut direction = vec![Expr::rational(&Rational::from(0)); velocities];
            direction.extend(gains);
            recording.derive(&jet.phase.lift(&direction), &variables.terms, over);
            recording.derive(jet.along_field(), &variables.terms, over);
        })
    }

    /// Reports all potentials together, each with a free constant, and the integral with all of
    /// them; returns the number proved.
    fn tell(
        &self,
        found: &[(Formula, Option<Formula>)],
        report: &mut SearchReport,
    ) -> Result<usize, SearchError> {
        if found.is_empty() {
            return Ok(0);
        }
        let (mut extended, names) = with_constants(self.case, "ε", found.len())?;
        let potential = combination(names.iter().zip(found.iter().map(|(u, _)| u)))?;
        let gains = names.iter().zip(found).filter_map(|(name, (_, g))| Some((name, g.as_ref()?)));
        let Some(potential) = potential else { return Ok(0) };
        let Some(model) = with_potential(&extended.model, &potential) else { return Ok(0) };
        extended.model = model;
        let formula = appended(Some(&self.integral), gains)?;
        let formula = formula.unwrap_or_else(|| self.integral.clone());
        let verdict = judged_alone(&extended, Claim::integral(&formula), self.effort)?;
        let Some(verdict) = verdict else { return Ok(0) };
        if !holds(&verdict) {
            report.remark(format!(
                "found, but not proved ({}): {formula} with U = {potential}",
                verdict.verdict.word()
            ));
            return Ok(0);
        }
        let mut one = Found::new("integral", &formula, None, verdict, &extended.model);
        one.with = vec![("potential", potential.to_string())];
        report.found.push(one);
        Ok(found.len())
    }
}
