//! Search for any field by orbits modulo a prime.
//!
//! ```text
//! taylor       series of the orbit of a random point
//! setting      points, orbits, and the relations between monomials along them
//! relations    number of algebraic integrals; none is a theorem
//! polynomials  polynomial integrals
//! rational     rational ones, as P and Q of the relations P − c Q
//! line         points of a line whose orbits satisfy one relation more
//! darboux      Darboux polynomials: the relations at these points
//! exponents    densities, and integrals with powers, logarithms and exponentials, from cofactors
//! claims       each find is judged as a claim like any other
//! ```
//!
//! The degree grows as the number of monomials allows, and further while there is time.

mod blocks;
mod claims;
mod darboux;
mod exponents;
mod factor;
mod images;
mod known;
mod line;
mod monomials;
mod polynomials;
mod rational;
mod relations;
mod setting;
mod taylor;
mod univariate;

use serde::Serialize;

use liouville::case::Case;
use liouville::mechanics::System;

use self::darboux::Search as Darboux;
use self::exponents::Exponents;
use self::factor::Factor;
use self::known::Known;
use self::line::Line;
use self::rational::Rational;
use self::setting::Setting;
use super::{Effort, Excluded, Report, SearchError};

/// Limits of one round of a search.
#[derive(Clone, Copy)]
struct Limits {
    /// Largest number of monomials of a relation.
    monomials: usize,
    /// Largest degree of a relation.
    degree: u32,
    /// Largest number of steps of an elimination on a line.
    steps: f64,
}

/// Limits without a limit of time.
const MODEST: Limits = Limits { monomials: 300, degree: 8, steps: 4e7 };

/// Limits that follow while there is time.
const FURTHER: [Limits; 4] = [
    Limits { monomials: 500, degree: 16, steps: 2e8 },
    Limits { monomials: 900, degree: 24, steps: 2e9 },
    Limits { monomials: 1700, degree: 24, steps: 2e10 },
    Limits { monomials: 3200, degree: 24, steps: 2e11 },
];

/// Largest degree of a Darboux polynomial.
const DARBOUX: u32 = 12;

/// Relations between monomials of at most a degree along one orbit.
#[derive(Clone, Debug, Serialize)]
pub struct OrbitReport {
    /// Highest degree.
    pub degree: u32,
    /// Number of monomials.
    pub monomials: usize,
    /// Number of relations between them along the orbit of a random point.
    pub relations: usize,
    /// Number of independent algebraic integrals to which they belong.
    pub integrals: usize,
}

/// A set of variables, and how far it has been searched.
struct Part {
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

/// Searches a field for integrals; proved ones go into the report.
pub fn search(
    case: &Case,
    effort: &Effort,
    report: &mut Report,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    if !matches!(case.model.system, System::Field(_) | System::Hamiltonian(_)) {
        return Ok(());
    }
    let setting = match Setting::of(case, effort)? {
        Ok(setting) => setting,
        Err(reason) => {
            report.remark(format!("no relations along orbits: {reason}"));
            return Ok(());
        }
    };
    let mut known = Known::of(&setting, report)?;
    let degree = match setting.is_on_level() || !setting.flow.is_rational {
        true => None,
        false => degree_of_field(&setting)?,
    };
    let part = |variables| Part {
        variables,
        next: 1,
        next_darboux: 1,
        degree,
        factors: Vec::new(),
        combined: None,
        done: Vec::new(),
    };
    let mut parts: Vec<Part> = blocks::closed(case)?.into_iter().map(part).collect();
    let mut run = |limits: Limits, report: &mut Report| -> Result<(), SearchError> {
        for place in 0..parts.len() {
            let (before, rest) = parts.split_at_mut(place);
            let Some(part) = rest.first_mut() else { continue };
            part.inherit(before);
            part.round(&setting, limits, &mut known, report, progress)?;
        }
        Ok(())
    };
    let outcome = run(MODEST, report).and_then(|()| {
        for limits in FURTHER.iter().filter(|_| effort.halt.is_timed()) {
            match run(*limits, report) {
                // The time is spent as asked for.
                Err(SearchError::Stopped) => break,
                other => other?,
            }
        }
        Ok(())
    });
    if let Some(whole) = parts.last() {
        whole.conclude(&setting, report);
    }
    outcome
}

/// Degree of a field in the state; `None` where it is no polynomial of low degree.
fn degree_of_field(setting: &Setting<'_>) -> Result<Option<usize>, SearchError> {
    let Some(at) = setting.at(0, 0) else { return Ok(None) };
    match Line::draw(setting, &at, 0) {
        Some(line) => line.degree(),
        None => Ok(None),
    }
}

impl Part {
    /// Takes over the factors of sets inside this one.
    fn inherit(&mut self, parts: &[Part]) {
        let inside = |part: &&Part| part.variables.iter().all(|k| self.variables.contains(k));
        let all: Vec<Factor> =
            parts.iter().filter(inside).flat_map(|part| &part.factors).cloned().collect();
        for factor in all {
            if self.factors.iter().all(|own| own.formula != factor.formula) {
                self.factors.push(factor);
            }
        }
    }

    /// Searches all degrees within the limits.
    fn round(
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

    /// Reports what was reached, and the theorem of absence.
    fn conclude(&self, setting: &Setting<'_>, report: &mut Report) {
        report.orbits.extend(self.done.iter().cloned());
        let none = self.done.iter().rfind(|own| own.relations == 0);
        let Some(none) = none else { return };
        if setting.is_on_level() || !setting.flow.is_rational || setting.has_lists() {
            return;
        }
        let names: Vec<&str> = setting.terms.iter().map(|term| term.text.as_str()).collect();
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
