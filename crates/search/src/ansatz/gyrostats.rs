//! Constant rotors under which an integral persists.
//!
//! Let F be an integral of degree 2 in ω, and A(S) the contribution of a rotor S to ω', linear in
//! S. F + F₁ + F₀, with F₁ and F₀ of degree 1 and 0 in ω, is an integral with S when
//!
//! ```text
//! (∂F/∂ω, A(S)) + L_v F₁ = 0       linear in S and F₁
//! (∂F₁/∂ω, A(S)) + L_v F₀ = 0      linear in the products of S's components and F₀
//! ```
//!
//! For an F of degree 1 the first equation suffices, with F₁ of degree 0.

use super::super::ask::{holds, is_energy, judged_alone};
use super::super::products::Generators;
use super::super::terms::{is_one, read};
use super::super::{Effort, Excluded, Found, SearchError, SearchReport};
use super::coefficients::{PrimitiveVector, Ratio};
use super::forces::{appended, combination, with_constants, with_gyrostat};
use super::monomials::AnsatzVariables;
use super::size::SystemSize;
use super::system::{Column, LinearSystem};
use super::{factors, note_unwritten, written};
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError, FormulaResult};
use liouville::graph::Expr;
use liouville::mechanics::Model;
use liouville::mechanics::calculus::DualPoint;

/// Finds, for each known integral of degree 1 or 2, the rotors under which it persists.
pub fn gyrostats(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let unit: Option<Vec<Model>> =
        (0..3).map(|axis| with_gyrostat(&case.model, &unit_vector(axis).ok()?)).collect();
    let (Some(variables), Some(unit)) = (AnsatzVariables::of(case), unit) else {
        report.remark("no search for rotors: the system admits none, or has one".to_string());
        return Ok(());
    };
    let generators = Generators::all(case, effort, report)?;
    let own: Vec<(Formula, u32)> = generators
        .each()
        .filter(|(formula, degree)| !is_energy(formula) && (1..=2).contains(degree))
        .map(|(formula, degree)| (formula.clone(), degree))
        .collect();
    if own.is_empty() {
        report
            .remark("no integral of degree 1 or 2 is known that could survive a rotor".to_string());
    }
    let below = read(["1", "(γ,B*γ)", "(γ,J⁻¹*γ)"], &case.model.vocabulary);
    for (integral, degree) in own {
        effort.halt.check()?;
        let rotors = Rotors {
            case,
            effort,
            variables: &variables,
            unit: &unit,
            below: &below,
            integral,
            degree,
        };
        rotors.search(report, progress)?;
    }
    Ok(())
}

/// Unit vector along an axis of the frame.
fn unit_vector(axis: usize) -> FormulaResult {
    let [a, b, c] = [0, 1, 2].map(|k| Formula::number(i64::from(k == axis)));
    Formula::vector(&[&a, &b, &c])
}

/// The search for the rotors that preserve one integral.
struct Rotors<'a> {
    case: &'a Case,
    effort: &'a Effort,
    variables: &'a AnsatzVariables,
    /// Models with a unit rotor along each axis.
    unit: &'a [Model],
    below: &'a [Formula],
    integral: Formula,
    /// Degree of the integral in the velocities.
    degree: u32,
}

/// A direction of the rotor, with the terms added to the integral.
#[derive(Clone)]
struct RotorDirection {
    rotor: Formula,
    linear: Formula,
}

impl Rotors<'_> {
    fn search(
        &self,
        report: &mut SearchReport,
        progress: &mut dyn FnMut(&str),
    ) -> Result<(), SearchError> {
        let what = format!("rotors that preserve {}", self.integral);
        let system = self.linear()?;
        let size = SystemSize::of(&[(0..system.columns.len()).collect()]);
        progress(&format!("{what}: {size}"));
        if let Some(reason) = size.beyond(self.effort) {
            report.remark(format!("{what}: not tried; {size}; {reason}"));
            return Ok(());
        }
        let Some((dimension, directions)) = self.directions(&system, report)? else {
            return Ok(());
        };
        let told = self.tell(&directions, report)?;
        let highest = self.effort.ansatz.positions;
        let then = match (dimension, told) {
            (0, _) => String::new(),
            (n, told) if n == told => ": those listed here".to_string(),
            (_, told) => format!("; the terms of second order leave {told} of them"),
        };
        report.excluded.push(Excluded {
            ansatz: format!("rotors that preserve {} with terms of degree at most {highest} in the positions", self.integral),
            dimension,
            known: told,
            error_log2: None,
            theorem: format!(
                "For generic values of the free parameters, and the given values of the fixed ones, at most {dimension} independent directions of a rotor allow, to first order in it, \
                 an integral {} + F₁ with F₁ of degree {} in the velocities and coefficients that are polynomials of degree at most {highest} in the positions over {}{then}.",
                self.integral,
                self.degree - 1,
                self.below.iter().map(Formula::text).collect::<Vec<_>>().join(", ")
            ),
        });
        Ok(())
    }

    /// Computes (∂F/∂ω, A(e_i)) for each axis.
    fn gains(&self, jet: &DualPoint<'_, Expr>, function: &Formula) -> Vec<Expr> {
        let (state, field) = (jet.phase.state(), jet.phase.field());
        let gain = |model: &Model| {
            let beside = jet.phase.in_model(model, &state);
            let moved = beside.field().iter().zip(field);
            let direction: Vec<Expr> = moved.map(|(with, without)| *with - *without).collect();
            jet.phase.lift(&direction).scalar(function).eps
        };
        self.unit.iter().map(gain).collect()
    }

    fn products(&self, degree: u32, below: &[Formula]) -> impl Iterator<Item = Column> {
        let highest = self.effort.ansatz.positions;
        let monomials = self.variables.monomials(degree, 0..=highest);
        (0..below.len()).flat_map(move |factor| {
            let product = move |exponents| Column::Product { derivation: 0, factor, exponents };
            monomials.clone().into_iter().map(product)
        })
    }

    /// Sets up the equations of first order; the rotor's components are the last columns.
    fn linear(&self) -> Result<LinearSystem, SearchError> {
        let over = factors(self.below)?;
        let mut given = Vec::new();
        let mut system = LinearSystem::record(self.case, self.effort, |jet, recording| {
            recording.derive(jet.along_field(), &self.variables.terms, &over);
            let gains = self.gains(jet, &self.integral);
            given = gains.into_iter().map(|gain| recording.give(gain)).collect();
        })?;
        let rotors = given.into_iter().map(Column::Given);
        system.columns = self.products(self.degree - 1, self.below).chain(rotors).collect();
        Ok(system)
    }

    /// Returns the number of directions to first order, and those whose coefficients are known.
    fn directions(
        &self,
        system: &LinearSystem,
        report: &mut SearchReport,
    ) -> Result<Option<(usize, Vec<RotorDirection>)>, SearchError> {
        let first = system.columns.len() - 3;
        let Some(at) = system.at(0, 0) else { return Ok(None) };
        let own: Vec<usize> = (0..first).collect();
        let Some(mut columns) = system.distinct(&at, &own)? else { return Ok(None) };
        columns.extend(first..first + 3);
        let Some(vectors) = system.null_space(&at, &columns)? else { return Ok(None) };
        let mut found = Vec::new();
        let mut dimension = 0;
        for vector in &vectors {
            let pairs = columns.iter().zip(vector).filter(|(_, entry)| **entry != 0);
            let support: Vec<usize> = pairs.map(|(column, _)| *column).collect();
            if support.last().is_none_or(|last| *last < first) {
                continue;
            }
            dimension += 1;
            let Some(coefficients) = PrimitiveVector::of(system, &support)? else {
                let what = format!("a rotor with {} terms", support.len());
                note_unwritten(self.case, &what, report);
                continue;
            };
            let component = |axis: usize| {
                let place = support.iter().position(|column| *column == first + axis);
                place.map_or(Ok(Formula::number(0)), |place| coefficients.formula(place))
            };
            let own: Vec<usize> = (0..support.len()).filter(|k| support[*k] < first).collect();
            let linear = self.sum(system, &coefficients, &support, &own)?;
            let [a, b, c] = [component(0)?, component(1)?, component(2)?];
            found.push(RotorDirection { rotor: Formula::vector(&[&a, &b, &c])?, linear });
        }
        Ok(Some((dimension, found)))
    }

    /// Σ coefficient · function over some columns of a support.
    fn sum(
        &self,
        system: &LinearSystem,
        coefficients: &PrimitiveVector,
        support: &[usize],
        own: &[usize],
    ) -> FormulaResult {
        let function =
            |k: &usize| written(self.variables, self.below, &system.columns[support[*k]]);
        let functions: Vec<Ratio> =
            own.iter().map(function).collect::<Result<_, FormulaError>>()?;
        Ok(coefficients.sum(own, &functions)?.unwrap_or_else(|| Formula::number(0)))
    }

    /// Finds terms of second order for each product of two directions; `None` where there are none.
    fn quadratic(
        &self,
        directions: &[RotorDirection],
    ) -> Result<Vec<Option<Formula>>, SearchError> {
        if self.degree < 2 {
            return Ok(vec![Some(Formula::number(0)); pairs(directions.len()).len()]);
        }
        let linear: Vec<Formula> = directions.iter().map(|own| own.linear.clone()).collect();
        let units: Vec<Model> = directions
            .iter()
            .filter_map(|own| with_gyrostat(&self.case.model, &own.rotor))
            .collect();
        let along = Rotors { unit: &units, integral: self.integral.clone(), ..*self };
        let over = factors(self.below)?;
        let pairs = pairs(directions.len());
        let mut given = Vec::new();
        let mut system = LinearSystem::record(self.case, self.effort, |jet, recording| {
            recording.derive(jet.along_field(), &self.variables.terms, &over);
            let gains: Vec<Vec<Expr>> = linear.iter().map(|form| along.gains(jet, form)).collect();
            given = pairs
                .iter()
                .map(|(k, l)| match k == l {
                    true => recording.give(gains[*k][*k]),
                    false => recording.give(gains[*k][*l] + gains[*l][*k]),
                })
                .collect();
        })?;
        let products: Vec<Column> = self.products(0, self.below).collect();
        let first = products.len();
        system.columns = products.into_iter().chain(given.into_iter().map(Column::Given)).collect();
        let Some(at) = system.at(0, 0) else { return Ok(vec![None; pairs.len()]) };
        let own: Vec<usize> = (0..first).collect();
        let Some(distinct) = system.distinct(&at, &own)? else {
            return Ok(vec![None; pairs.len()]);
        };
        let solved = |pair: usize| -> Result<Option<Formula>, SearchError> {
            let kept = distinct.iter().copied().filter(|column| *column != own[0]);
            let columns: Vec<usize> = kept.chain([first + pair]).collect();
            let vector = system.null_space(&at, &columns)?.and_then(|mut found| found.pop());
            let Some(vector) = vector else { return Ok(None) };
            let used = columns.iter().zip(&vector).filter(|(_, entry)| **entry != 0);
            let support: Vec<usize> = used.map(|(column, _)| *column).collect();
            if support.last() != Some(&(first + pair)) {
                return Ok(None);
            }
            let Some(coefficients) = PrimitiveVector::of(&system, &support)? else {
                return Ok(None);
            };
            let last = support.len() - 1;
            let own: Vec<usize> = (0..last).collect();
            let sum = self.sum(&system, &coefficients, &support, &own)?;
            let below = coefficients.formula(last)?;
            match is_one(&below) {
                true => Ok(Some(sum)),
                false => Ok(Some((sum.bracketed() / &below.bracketed())?)),
            }
        };
        (0..pairs.len()).map(solved).collect()
    }

    /// Reports the integral with all directions that admit one, each with a free constant; returns
    /// their number.
    fn tell(
        &self,
        directions: &[RotorDirection],
        report: &mut SearchReport,
    ) -> Result<usize, SearchError> {
        let mut kept: Vec<&RotorDirection> = directions.iter().collect();
        while !kept.is_empty() {
            let own: Vec<RotorDirection> = kept.iter().map(|one| (*one).clone()).collect();
            let quadratic = self.quadratic(&own)?;
            let pairs = pairs(own.len());
            // Drop a direction without a term for its square first, then the last one in a pair
            // that fails.
            let missing = pairs.iter().zip(&quadratic).filter(|(_, term)| term.is_none());
            let worst = missing.map(|((k, l), _)| (k == l, *k.max(l))).max();
            if let Some((_, index)) = worst {
                kept.remove(index);
                continue;
            }
            return self.prove(&own, &pairs, &quadratic, report);
        }
        Ok(0)
    }

    fn prove(
        &self,
        own: &[RotorDirection],
        pairs: &[(usize, usize)],
        quadratic: &[Option<Formula>],
        report: &mut SearchReport,
    ) -> Result<usize, SearchError> {
        let (mut extended, names) = with_constants(self.case, "s", own.len())?;
        let rotor = combination(names.iter().zip(own.iter().map(|one| &one.rotor)))?;
        let linear = names.iter().zip(own.iter().map(|one| &one.linear));
        let sum = appended(Some(&self.integral), linear)?;
        let (Some(rotor), Some(mut formula)) = (rotor, sum) else { return Ok(0) };
        let Some(model) = with_gyrostat(&extended.model, &rotor) else { return Ok(0) };
        extended.model = model;
        for ((k, l), term) in pairs.iter().zip(quadratic) {
            let is_zero = |term: &&Formula| term.constant().is_some_and(|value| value.is_zero());
            if let Some(term) = term.as_ref().filter(|term| !is_zero(term)) {
                formula = (formula + &(&names[*k] * &names[*l] * &term.bracketed())?)?;
            }
        }
        let verdict = judged_alone(&extended, Claim::integral(&formula), self.effort)?;
        let Some(verdict) = verdict else { return Ok(0) };
        if !holds(&verdict) {
            report.remark(format!(
                "found, but not proved ({}): {formula} with S = {rotor}",
                verdict.verdict.word()
            ));
            return Ok(0);
        }
        let mut one = Found::new("integral", &formula, None, verdict, &extended.model);
        one.with = vec![("gyrostat", rotor.to_string())];
        report.found.push(one);
        Ok(own.len())
    }
}

fn pairs(count: usize) -> Vec<(usize, usize)> {
    (0..count).flat_map(|k| (k..count).map(move |l| (k, l))).collect()
}
