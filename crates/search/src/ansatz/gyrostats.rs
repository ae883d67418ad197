//! Rotors and gyroscopic terms under which an integral persists.
//!
//! Let F be an integral of degree 2 in the velocities w, and let a rotor or a term linear in w add A(S)
//! to the field, linear in S. F + F₁ + F₀, with F₁ and F₀ of degree 1 and 0 in w, is an integral with S
//! when
//!
//! ```text
//! (∂F, A(S)) + L_v F₁ = 0       linear in S and F₁
//! (∂F₁, A(S)) + L_v F₀ = 0      linear in the products of S's components and F₀
//! ```
//!
//! For an F of degree 1 the terms F₁ are of degree 0, and there are no others. `gyro_second` has the
//! second equation.

use super::super::ask::is_energy;
use super::super::branches::are_true;
use super::super::products::{Generators, degree_in, told};
use super::super::{Effort, Excluded, SearchError, SearchReport};
use super::coefficients::{PrimitiveVector, Ratio};
use super::gyro_family::{GyroEntry, GyroFamily};
use super::gyro_quotient::representatives;
use super::gyro_second::{GyroDirection, Survivors};
use super::gyro_slots::Part;
use super::size::SystemSize;
use super::system::{Column, LinearSystem};
use super::theorem::{at_most, referred};
use super::{factors, note_unwritten, written};
use crate::hypotheses::stated;
use crate::local::Coordinates;
use crate::origin::{RemarkOrigin, TheoremOrigin};
use liouville::case::Case;
use liouville::formula::{Formula, FormulaError, FormulaResult};
use liouville::mechanics::Draw;
use liouville::order::StableOrder;

/// Largest number of directions that are written out.
const LISTED: usize = 8;
/// Largest number of forces without terms added to the integral that are compared.
const FREE: usize = 64;

/// Finds, for each known integral of degree 1 or 2, the rotors or terms under which it persists.
pub fn gyrostats(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let is_own = GyroFamily::is_own(&case.model);
    let what = if is_own { "gyroscopic terms" } else { "rotors" };
    let family = match GyroFamily::of(case, effort)? {
        Ok(family) => family,
        Err(reason) => {
            report.remark(format!("no search for {what}: {reason}"));
            return Ok(());
        }
    };
    let integrals = if is_own {
        let coordinates = Coordinates::divided(case, &family.variables.positions());
        let mut own = Vec::new();
        for formula in told(case, effort, report)? {
            let degree = degree_in(case, &formula, &coordinates, effort.options.seed)?;
            own.extend(degree.map(|degree| (formula, degree)));
        }
        own
    } else {
        let generators = Generators::all(case, effort, report)?;
        generators.each().map(|(formula, degree)| (formula.clone(), degree)).collect()
    };
    let is_wanted =
        |(formula, degree): &(Formula, u32)| !is_energy(formula) && (1..=2).contains(degree);
    let integrals: Vec<(Formula, u32)> = integrals.into_iter().filter(is_wanted).collect();
    if integrals.is_empty() {
        let what = if is_own { "gyroscopic terms" } else { "a rotor" };
        report.remark(format!("no integral of degree 1 or 2 is known that could survive {what}"));
        return Ok(());
    }
    let terms = match representatives(case, effort, &family) {
        Err(error @ SearchError::NoChart) => {
            report.remark(format!("no search for {what}: {error}"));
            return Ok(());
        }
        other => other?,
    };
    let Some(terms) = terms else {
        report.remark(format!(
            "no search for {what}: formulas with exp, ln, sin, cos or general powers have no values \
             modulo a prime"
        ));
        return Ok(());
    };
    if terms.is_empty() {
        let why = match family.is_canonical {
            true => "each of this form is removed by a change of the momenta by a gradient",
            false => "none of this form acts on the system",
        };
        report.remark(format!("no search for {what}: {why}"));
        return Ok(());
    }
    // A rotor is searched for before theorems with wrong branches are withdrawn.
    let is_list = |draw: &Draw| matches!(draw, Draw::OneOf(values) if values.len() > 1);
    let has_lists = case.model.parameter_draws().iter().any(is_list);
    let has_theorem = !is_own || (are_true(case, effort)? && !has_lists);
    for (integral, degree) in integrals {
        effort.halt.check()?;
        let family = &family;
        let search =
            GyroSearch { case, effort, family, terms: &terms, integral, degree, has_theorem };
        search.search(report, progress)?;
    }
    Ok(())
}

/// The search for the rotors or terms that preserve one integral.
pub struct GyroSearch<'a> {
    /// Case without them.
    pub case: &'a Case,
    /// Limits.
    pub effort: &'a Effort,
    /// Form of the terms.
    pub family: &'a GyroFamily,
    /// Columns of the terms that are tried.
    terms: &'a [Column],
    /// Integral.
    pub integral: Formula,
    /// Degree of the integral in the velocities.
    pub degree: u32,
    /// Whether what is missing modulo a prime is missing at real states.
    has_theorem: bool,
}

impl GyroSearch<'_> {
    fn search(
        &self,
        report: &mut SearchReport,
        progress: &mut dyn FnMut(&str),
    ) -> Result<(), SearchError> {
        let what = format!("{} that preserve {}", self.kind(), self.integral);
        let (system, first) = self.linear()?;
        let size = SystemSize::of(&[(0..system.columns.len()).collect()]);
        progress(&format!("{what}: {size}"));
        if let Some(reason) = size.beyond(self.effort) {
            let text = format!("{what}: not tried; {size}; {reason}");
            report.remark_of(RemarkOrigin::NotTried, text);
            return Ok(());
        }
        let Some(supports) = self.supports(&system, first)? else { return Ok(()) };
        let dimension = supports.len();
        let is_pairs = matches!(self.family.entry, GyroEntry::Pairs(_));
        let has_gain = |own: &Vec<usize>| own.first().is_some_and(|column| *column < first);
        let (free, others): (Vec<_>, Vec<_>) =
            supports.into_iter().partition(|own| is_pairs && !has_gain(own));
        let survivors = Survivors { search: self };
        let free = self.directions(&system, free.iter().take(FREE), first, report)?;
        let others = self.directions(&system, others.iter().take(LISTED), first, report)?;
        let told = survivors.tell_free(&free, report)? + survivors.tell(others, report)?;
        if self.has_theorem {
            report.excluded.push(self.theorem(dimension, told)?);
        }
        Ok(())
    }

    fn kind(&self) -> String {
        match self.family.entry {
            GyroEntry::Rotor => "rotors".to_string(),
            _ => format!("{}s", self.family.word()),
        }
    }

    /// Sets up the equations of first order; the columns of the terms are those from the second value
    /// on.
    fn linear(&self) -> Result<(LinearSystem, usize), SearchError> {
        let family = self.family;
        let over = factors(&family.below)?;
        let mut outcome = Ok(());
        let mut system = LinearSystem::record(self.case, self.effort, |jet, recording| {
            let along = |shift: &[_]| jet.phase.lift(shift).scalar(&self.integral).eps;
            outcome = family.record(&family.shifts(jet), jet, recording, &along);
            recording.derive(jet.along_field(), &family.variables.terms, &over);
        })?;
        outcome?;
        system.columns = family.gains(self.degree - 1);
        let first = system.columns.len();
        system.columns.extend_from_slice(self.terms);
        Ok((system, first))
    }

    /// Columns with a nonzero coefficient, for each direction that is allowed to first order; `None`
    /// without values.
    fn supports(
        &self,
        system: &LinearSystem,
        first: usize,
    ) -> Result<Option<Vec<Vec<usize>>>, SearchError> {
        let Some(at) = system.at(0, 0) else { return Ok(None) };
        let own: Vec<usize> = (0..first).collect();
        let Some(mut columns) = system.distinct(&at, &own)? else { return Ok(None) };
        columns.extend(first..system.columns.len());
        let Some(vectors) = system.null_space(&at, &columns)? else { return Ok(None) };
        let support = |vector: &Vec<u64>| -> Vec<usize> {
            let pairs = columns.iter().zip(vector).filter(|(_, entry)| **entry != 0);
            pairs.map(|(column, _)| *column).collect()
        };
        let mut found: Vec<Vec<usize>> = vectors.iter().map(support).collect();
        found.retain(|own| own.last().is_some_and(|last| *last >= first));
        found.order_by_key(Vec::len);
        Ok(Some(found))
    }

    /// Writes directions; what cannot be written is noted.
    fn directions<'s>(
        &self,
        system: &LinearSystem,
        supports: impl Iterator<Item = &'s Vec<usize>>,
        first: usize,
        report: &mut SearchReport,
    ) -> Result<Vec<GyroDirection>, SearchError> {
        let mut found = Vec::new();
        for support in supports {
            match PrimitiveVector::of(system, support)? {
                Some(coefficients) => {
                    found.push(self.direction(system, support, first, &coefficients)?);
                }
                None => {
                    let what = format!("a {} with {} terms", self.family.word(), support.len());
                    note_unwritten(self.case, &what, report);
                }
            }
        }
        Ok(found)
    }

    /// Writes the direction that a null vector is.
    fn direction(
        &self,
        system: &LinearSystem,
        support: &[usize],
        first: usize,
        coefficients: &PrimitiveVector,
    ) -> Result<GyroDirection, SearchError> {
        let places = |keep: &dyn Fn(usize) -> bool| -> Vec<usize> {
            (0..support.len()).filter(|k| keep(support[*k])).collect()
        };
        let part = |generator: usize| -> Result<Part, FormulaError> {
            let is_own = |column: usize| matches!(&system.columns[column], Column::Product { derivation, .. } if *derivation == generator);
            let own = places(&|column| column >= first && is_own(column));
            let functions = self.functions(system, support, &own)?;
            let sum = coefficients.sum_with_plus(&own, &functions)?;
            Ok(sum.map(|(formula, is_negative)| (is_negative, formula)))
        };
        let parts: Vec<Part> = (0..self.family.count()).map(part).collect::<Result<_, _>>()?;
        let linear = self.sum(system, coefficients, support, &places(&|column| column < first))?;
        Ok(GyroDirection { slots: self.family.slots(&parts)?, parts, linear })
    }

    /// Functions of some columns of a support.
    fn functions(
        &self,
        system: &LinearSystem,
        support: &[usize],
        own: &[usize],
    ) -> Result<Vec<Ratio>, FormulaError> {
        let GyroFamily { variables, below, .. } = self.family;
        own.iter().map(|k| written(variables, below, &system.columns[support[*k]])).collect()
    }

    /// Σ coefficient · function over some columns of a support; `None` where all are 0.
    pub fn sum(
        &self,
        system: &LinearSystem,
        coefficients: &PrimitiveVector,
        support: &[usize],
        own: &[usize],
    ) -> Result<Option<Formula>, FormulaError> {
        coefficients.sum(own, &self.functions(system, support, own)?)
    }

    /// A term as it enters the equations.
    fn term(&self, column: &Column) -> FormulaResult {
        let GyroFamily { variables, below, heads, .. } = self.family;
        let coefficient = written(variables, below, column)?.above;
        match column {
            Column::Product { derivation, .. } => {
                let parts = (0..heads.len())
                    .map(|k| (k == *derivation).then(|| (false, coefficient.clone())))
                    .collect::<Vec<_>>();
                let term = self.family.slots(&parts)?.into_iter().flatten().next();
                Ok(term.unwrap_or_else(|| Formula::number(0)))
            }
            Column::Given(_) => Ok(coefficient),
        }
    }

    fn theorem(&self, dimension: usize, told: usize) -> Result<Excluded, SearchError> {
        let GyroFamily { below, degree, gain, variables, heads, .. } = self.family;
        let names = |terms: &mut dyn Iterator<Item = &Formula>| {
            terms.map(Formula::text).collect::<Vec<_>>().join(", ")
        };
        let (kind, integral) = (self.kind(), &self.integral);
        let over = names(&mut below.iter());
        let positions = names(&mut variables.positions().iter().map(|k| &variables.terms[*k]));
        let then = match (dimension, told) {
            (0, _) => String::new(),
            (n, told) if n == told => ": those listed here".to_string(),
            _ => format!(
                "; {told} of them are listed here, with terms of second order, and nothing is stated about \
                 the others"
            ),
        };
        let aside = match self.terms.len() == self.family.coefficients().len() {
            true => "",
            false => ", up to rotors without effect,",
        };
        let lower = self.degree - 1;
        let gained = match positions.is_empty() {
            true => "constant coefficients".to_string(),
            false if below.len() == 1 => {
                format!("coefficients that are polynomials in {positions} of degree at most {gain}")
            }
            false => format!(
                "coefficients Σ p/d, p polynomials in {positions} of degree at most {gain}, d one of {over}"
            ),
        };
        let (ansatz, theorem) = match self.family.entry {
            GyroEntry::Rotor => (
                format!(
                    "rotors that preserve {integral} with terms of degree at most {gain} in the positions"
                ),
                format!(
                    "{}, to first order in it, \
                     an integral {integral} + F₁ with F₁ of degree {lower} in the velocities and coefficients that are polynomials of degree at most {gain} in the positions over {over}{then}.",
                    at_most(dimension, "direction", "directions", &format!(" of a rotor{aside}"))
                ),
            ),
            GyroEntry::Term => {
                let all = self.terms.iter().map(|column| self.term(column));
                let all = names(&mut all.collect::<Result<Vec<_>, _>>()?.iter());
                (
                    format!("gyroscopic terms that preserve {integral}, combinations of {all}"),
                    format!(
                        "{}, to first order in {}, \
                         an integral {integral} + F₁ with F₁ of degree at most {lower} in {} and {gained}{then}.",
                        at_most(
                            dimension,
                            "nonzero combination",
                            "combinations",
                            &format!(" of the {kind} {all}")
                        ),
                        referred(dimension),
                        names(&mut heads.iter())
                    ),
                )
            }
            GyroEntry::Pairs(_) => {
                let heads = names(&mut heads.iter());
                let form = format!(
                    "B w, w = ({heads}), with B skew and entries Σ p/d, p polynomials in {positions} of degree at most {degree}, d one of {over}"
                );
                (
                    format!("forces {form}"),
                    format!(
                        "{}, to first order in {}, \
                         an integral {integral} + F₁ with F₁ of degree at most {lower} in {heads} and {gained}{then}.",
                        at_most(dimension, "force", "forces", &format!(" {form},")),
                        referred(dimension)
                    ),
                )
            }
        };
        let theorem = stated(&self.case.model, &theorem);
        let (origin, values) = (TheoremOrigin::Forces, None);
        Ok(Excluded { ansatz, dimension, known: told, error_log2: None, theorem, origin, values })
    }
}
