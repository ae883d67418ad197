//! Separate search of a set of variables, and the theorem about all variables.

use liouville::formula::Formula;

use super::super::{Excluded, Report, SearchError};
use super::darboux::Search as Darboux;
use super::exponents::Exponents;
use super::factor::Factor;
use super::known::Known;
use super::rational::Rational;
use super::setting::Setting;
use super::{Limits, OrbitReport, monomials, polynomials, relations};

/// Largest degree of a Darboux polynomial.
const DARBOUX: u32 = 12;

/// A set of variables, and how far it has been searched.
pub struct Part {
    variables: Vec<usize>,
    /// Degree of the relations that comes next.
    next: u32,
    /// Degree of the Darboux polynomials that comes next.
    next_darboux: u32,
    /// Degree of the field, where it is a polynomial.
    degree: Option<usize>,
    factors: Vec<Factor>,
    /// Number of factors at the last search for exponents.
    combined: Option<usize>,
    /// Relations of each degree that has been searched.
    done: Vec<OrbitReport>,
}

impl Part {
    /// Starts with no degree searched; `degree` is that of the field, where it is a polynomial.
    pub fn new(variables: Vec<usize>, degree: Option<usize>) -> Self {
        Self {
            variables,
            next: 1,
            next_darboux: 1,
            degree,
            factors: Vec::new(),
            combined: None,
            done: Vec::new(),
        }
    }

    /// Takes over the factors of sets inside this one.
    pub fn inherit(&mut self, parts: &[Part]) {
        let inside = |part: &&Part| part.variables.iter().all(|k| self.variables.contains(k));
        let all: Vec<Factor> =
            parts.iter().filter(inside).flat_map(|part| &part.factors).cloned().collect();
        for factor in all {
            if self.factors.iter().all(|own| own.formula.text() != factor.formula.text()) {
                self.factors.push(factor);
            }
        }
    }

    /// Searches all degrees within the limits.
    pub fn round(
        &mut self,
        setting: &Setting<'_>,
        limits: Limits,
        known: &mut Known,
        report: &mut Report,
        progress: &mut dyn FnMut(&str),
    ) -> Result<(), SearchError> {
        let count = self.variables.len();
        while self.next <= limits.degree && monomials::count(count, self.next) <= limits.monomials {
            self.step(setting, known, report, progress)?;
        }
        let Some(degree) = self.degree else { return Ok(()) };
        let variables = &self.variables;
        let search = Darboux { setting, variables, degree };
        while self.next_darboux <= DARBOUX
            && steps(count, self.next_darboux, degree) <= limits.steps
        {
            progress(&format!("Darboux polynomials of degree {}", self.next_darboux));
            search.of_degree(self.next_darboux, &mut self.factors, report)?;
            self.next_darboux += 1;
            self.combined =
                combine(setting, variables, &self.factors, self.combined, known, report)?;
        }
        search.parts(&known.parts, &mut self.factors, report)?;
        self.combined = combine(setting, variables, &self.factors, self.combined, known, report)?;
        Ok(())
    }

    /// Searches one degree.
    fn step(
        &mut self,
        setting: &Setting<'_>,
        known: &mut Known,
        report: &mut Report,
        progress: &mut dyn FnMut(&str),
    ) -> Result<(), SearchError> {
        let degree = self.next;
        let monomials = monomials::up_to(&self.variables, setting.dimension(), degree);
        progress(&format!(
            "relations of degree {degree} along an orbit: {} unknowns",
            monomials.len()
        ));
        setting.effort.halt.check()?;
        let Some(at) = setting.at(0, 0) else { return Err(SearchError::NoSeries) };
        let Some(step) = relations::step(setting, &at, &monomials)? else {
            return Err(SearchError::NoSeries);
        };
        self.next += 1;
        self.done.push(OrbitReport {
            degree,
            monomials: monomials.len(),
            relations: step.relations.vectors.len(),
            integrals: step.integrals,
        });
        let variables = &self.variables;
        if step.integrals > known.within(variables) {
            polynomials::polynomials(setting, variables, degree, known, report)?;
        }
        if step.integrals > known.within(variables) {
            let rational = Rational { setting, variables, monomials: &monomials, degree };
            rational.search(&at, &step.relations, step.integrals, known, report)?;
        }
        Ok(())
    }

    /// Reports the degree reached and the theorem of absence.
    pub fn conclude(&self, setting: &Setting<'_>, report: &mut Report) {
        report.orbits.extend(self.done.iter().cloned());
        let none = self.done.iter().rfind(|own| own.relations == 0);
        let Some(none) = none else { return };
        if setting.is_on_level() || !setting.flow.is_rational || setting.has_lists() {
            return;
        }
        let names: Vec<&str> = setting.terms.iter().map(Formula::text).collect();
        let degree = none.degree;
        let generic = match setting.case.model.free_components() {
            0 => "",
            _ => {
                "For generic values of the free parameters, and the given values of the fixed ones, "
            }
        };
        let statement = format!(
            "{generic}no fraction P/Q of polynomials in {} of degree at most {degree}, with any complex \
             coefficients, is an integral, constants aside; a polynomial of that degree is none either.",
            names.join(", ")
        );
        let mut letters = statement.chars();
        let first = letters.next().map(|letter| letter.to_uppercase().to_string());
        report.excluded.push(Excluded {
            ansatz: format!("fractions of polynomials of degree up to {degree}"),
            dimension: 0,
            known: 0,
            error_log2: None,
            theorem: first.unwrap_or_default() + letters.as_str(),
        });
    }
}

/// Number of steps of the eliminations on a line.
fn steps(variables: usize, degree: u32, field: usize) -> f64 {
    let count = monomials::count(variables, degree) as f64;
    let places = f64::from(degree) * count + field.saturating_sub(1) as f64 * count * count / 2.0;
    places * count * count * (count / 3.0 + 4.0)
}

/// Searches for densities and integrals from cofactors, if there are more of them than at the last
/// time; returns how many there are.
fn combine(
    setting: &Setting<'_>,
    variables: &[usize],
    factors: &[Factor],
    last: Option<usize>,
    known: &mut Known,
    report: &mut Report,
) -> Result<Option<usize>, SearchError> {
    if last != Some(factors.len()) {
        Exponents::of(setting, variables, factors)?.search(known, report)?;
    }
    Ok(Some(factors.len()))
}
