//! Separate search of a set of variables, and the theorem about all variables.

use super::super::origin::TheoremOrigin;
use super::super::{Excluded, SearchError, SearchReport};
use super::angle::{ConjugatePair, SquareOfRoot};
use super::darboux::DarbouxSearch as Darboux;
use super::exponents::{ExponentSystem, combine};
use super::factor::RatedPolynomial;
use super::graded::GradedSearch;
use super::known::{IndependentIntegrals, has_all};
use super::rational::RationalSearch;
use super::setting::{ExtendedCase, OrbitSetting};
use super::{
    OrbitReport, RoundLimits, fractions, level_shape, map_integrals, monomials, no_others,
    own_factors, polynomials, relations, unbound, weighted,
};
use liouville::formula::Formula;

/// Largest degree of a Darboux polynomial.
pub const MOST_DARBOUX_DEGREE: u32 = 12;
/// Share of the steps on a line that may be taken on a conic.
const ON_CONICS: f64 = 0.25;
/// Family of the theorem on Darboux polynomials, before the degree.
pub const DARBOUX_FAMILY: &str = "Darboux polynomials of degree up to";
/// Bound above the degrees of the relations.
const MOST_DEGREE: u32 = 64;

/// A set of variables, and how far it has been searched.
pub struct VariableSet {
    variables: Vec<usize>,
    /// Degree of the relations that comes next.
    next: u32,
    /// Degree of the polynomial integrals that are searched class by class next.
    next_graded: u32,
    /// Degree of the Darboux polynomials that comes next.
    next_darboux: u32,
    /// Degree of the field, where it is a polynomial.
    degree: Option<usize>,
    factors: Vec<RatedPolynomial>,
    pairs: Vec<ConjugatePair>,
    /// Number of factors at the last search for exponents.
    combined: Option<usize>,
    /// Numbers of factors and of pairs at the last search with angles.
    with_angles: Option<(usize, usize)>,
    /// The same at the last search with fractions.
    with_fractions: Option<(usize, usize)>,
    /// Number of integrals of which one could not be written: functions of it are no easier to write.
    unwritten: usize,
    /// Whether factors without the relations between the functions have been searched.
    is_unbound: bool,
    /// Relations of each degree that has been searched.
    done: Vec<OrbitReport>,
}

impl VariableSet {
    /// Starts with no degree searched; `degree` is that of the field, where it is a polynomial.
    pub fn new(variables: Vec<usize>, degree: Option<usize>) -> Self {
        Self {
            variables,
            next: 1,
            next_graded: 1,
            next_darboux: 1,
            degree,
            factors: Vec::new(),
            pairs: Vec::new(),
            combined: None,
            with_angles: None,
            with_fractions: None,
            unwritten: 0,
            is_unbound: false,
            done: Vec::new(),
        }
    }

    /// Takes over the factors of sets inside this one.
    pub fn inherit(&mut self, parts: &[VariableSet]) {
        let inside =
            |part: &&VariableSet| part.variables.iter().all(|k| self.variables.contains(k));
        let all: Vec<RatedPolynomial> =
            parts.iter().filter(inside).flat_map(|part| &part.factors).cloned().collect();
        for factor in all {
            if self.factors.iter().all(|own| own.formula.text() != factor.formula.text()) {
                self.factors.push(factor);
            }
        }
        for pair in parts.iter().filter(inside).flat_map(|part| &part.pairs) {
            if !self.pairs.iter().any(|own| own.is_same(pair)) {
                self.pairs.push(pair.clone());
            }
        }
    }

    /// Searches all degrees within the limits.
    pub fn round(
        &mut self,
        setting: &OrbitSetting<'_>,
        limits: RoundLimits,
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
        progress: &mut dyn FnMut(&str),
    ) -> Result<(), SearchError> {
        let count = self.variables.len();
        self.relations(setting, limits, known, report, progress)?;
        self.graded(setting, limits, known, report, progress)?;
        if !setting.effort.by_factors {
            return Ok(());
        }
        let variables = &self.variables;
        let Some(degree) = self.degree else {
            // The whole state on a level: factors are given by the functions there.
            if let Some(origin) = setting.origin.filter(|_| count == setting.dimension()) {
                for formula in &origin.extension.factors {
                    let has = |own: &RatedPolynomial| own.formula.text() == formula.text();
                    if !self.factors.iter().any(has) {
                        self.factors.extend(RatedPolynomial::of(setting, formula, 1)?);
                    }
                }
                // A field on a line has no integral, and a function of constant rate.
                let is_line = origin.case.model.dimension() == 1;
                if !self.is_unbound && (is_line || !is_complete(setting, known)) {
                    self.is_unbound = true;
                    unbound::search(setting, limits, &mut self.factors, report, progress)?;
                }
                // After the others: a density without velocities comes first, and they have the exponent 1.
                own_factors::extend(setting, &mut self.factors)?;
                self.combined =
                    combine(setting, variables, &self.factors, self.combined, known, report)?;
                for [even, odd, square] in &origin.extension.circles {
                    let square = SquareOfRoot::of(square.clone());
                    let pair = ConjugatePair::rated(setting, [even, odd], square, 1)?;
                    let is_new =
                        |pair: &ConjugatePair| !self.pairs.iter().any(|own| own.is_same(pair));
                    self.pairs.extend(pair.filter(is_new));
                }
                self.with_angles(setting, known, report)?;
                self.with_fractions(setting, known, report)?;
            }
            return Ok(());
        };
        let search = Darboux { setting, variables, degree };
        if setting.shape.is_some() && self.next_darboux == 1 {
            // A variable that the level writes in others is a factor, too.
            for name in own_factors::of_level(setting, variables)? {
                search.tell(&name, 1, &mut self.factors, report)?;
            }
            self.pairs.extend(level_shape::pairs(setting, variables)?);
        }
        let share = if setting.conic.is_some() { ON_CONICS } else { 1.0 };
        while self.next_darboux <= MOST_DARBOUX_DEGREE
            && monomials::steps(count, self.next_darboux, degree) <= share * limits.steps
        {
            progress(&format!("Darboux polynomials of degree {}", self.next_darboux));
            search.of_degree(self.next_darboux, &mut self.factors, &mut self.pairs, report)?;
            self.next_darboux += 1;
            self.combined =
                combine(setting, variables, &self.factors, self.combined, known, report)?;
        }
        search.parts(known, &mut self.factors, report)?;
        self.combined = combine(setting, variables, &self.factors, self.combined, known, report)?;
        self.with_angles(setting, known, report)?;
        self.with_fractions(setting, known, report)
    }

    /// Searches for integrals by relations up to a degree.
    pub fn relations(
        &mut self,
        setting: &OrbitSetting<'_>,
        limits: RoundLimits,
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
        progress: &mut dyn FnMut(&str),
    ) -> Result<(), SearchError> {
        while self.next <= limits.degree && !is_complete(setting, known) {
            let all = self.monomials(setting);
            if all.len() > limits.monomials {
                break;
            }
            self.step(setting, &all, known, report, progress)?;
        }
        Ok(())
    }

    /// Searches for what has fractions over powers of factors in exponents, and at last for multiples
    /// of a density.
    fn with_fractions(
        &mut self,
        setting: &OrbitSetting<'_>,
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let counts = (self.factors.len(), self.pairs.len());
        if self.with_fractions != Some(counts) {
            let system = ExponentSystem::of(setting, &self.variables, &self.factors, &self.pairs)?;
            system.search_with_fractions(known, report)?;
            if self.with_fractions.is_none() && self.variables.len() == setting.dimension() {
                let (variables, pairs) = (&self.variables, &self.pairs);
                let system = ExponentSystem::of(setting, variables, &self.factors, pairs)?;
                system.search_rates(known, report)?;
            }
            self.with_fractions = Some(counts);
            if self.variables.len() == setting.dimension() {
                weighted::search(setting, report)?;
            }
        }
        Ok(())
    }

    /// Searches for integrals with angles; these jump by π, so what can be written without them is.
    fn with_angles(
        &mut self,
        setting: &OrbitSetting<'_>,
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let counts = (self.factors.len(), self.pairs.len());
        if !self.pairs.is_empty() && self.with_angles != Some(counts) {
            let system = ExponentSystem::of(setting, &self.variables, &self.factors, &self.pairs)?;
            system.search(known, report)?;
            self.with_angles = Some(counts);
        }
        Ok(())
    }

    /// Searches polynomial integrals of higher degree, class by class.
    fn graded(
        &mut self,
        setting: &OrbitSetting<'_>,
        limits: RoundLimits,
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
        progress: &mut dyn FnMut(&str),
    ) -> Result<(), SearchError> {
        let mut left = limits.graded;
        self.next_graded = self.next_graded.max(self.next);
        let is_over = self.next_graded > limits.degree || is_complete(setting, known);
        if is_over || !setting.effort.by_class {
            return Ok(());
        }
        let Some(search) = GradedSearch::of(setting)? else { return Ok(()) };
        while self.next_graded <= limits.degree && !is_complete(setting, known) {
            let degree = self.next_graded;
            progress(&format!("polynomial integrals of degree {degree}, class by class"));
            let counted = self.done.last().map_or(0, |own| own.integrals);
            let done = search.of_degree(&self.variables, degree, left, counted, known, report)?;
            let Some(steps) = done else { break };
            left -= steps;
            self.next_graded += 1;
        }
        Ok(())
    }

    /// Monomials of the relations that come next; none if there are very many.
    fn monomials(&self, setting: &OrbitSetting<'_>) -> Vec<Vec<u32>> {
        setting.standard(monomials::up_to(&self.variables, setting.dimension(), self.next))
    }

    /// Searches one degree.
    fn step(
        &mut self,
        setting: &OrbitSetting<'_>,
        monomials: &[Vec<u32>],
        known: &mut IndependentIntegrals,
        report: &mut SearchReport,
        progress: &mut dyn FnMut(&str),
    ) -> Result<(), SearchError> {
        let degree = self.next;
        progress(&format!(
            "relations of degree {degree} along an orbit: {} unknowns",
            monomials.len()
        ));
        setting.effort.halt.check()?;
        let Some(at) = setting.at(0, 0) else { return Err(SearchError::NoSeries) };
        let Some(step) = relations::step(setting, &at, monomials)? else {
            return Err(SearchError::NoSeries);
        };
        self.next += 1;
        self.done.push(OrbitReport::of(setting, degree, monomials.len(), &step));
        let variables = &self.variables;
        // Of low degree there may be others that are functions of those known.
        let may_depend = degree <= polynomials::LOW
            && variables.len() == setting.dimension()
            && known.algebraic_within(variables) > 1
            && !setting.flow.is_map;
        let counted = step.integrals;
        let is_open = |known: &IndependentIntegrals| counted > known.algebraic_within(variables);
        // On a level others may be easier to write, as polynomials that are equal there to fractions.
        if counted <= self.unwritten && !may_depend && !setting.is_on_level() {
            return Ok(());
        }
        let mut is_unwritten = false;
        if may_depend || is_open(known) {
            let search = match setting.flow.is_map {
                true => map_integrals::polynomials,
                false => polynomials::polynomials,
            };
            is_unwritten = search(setting, variables, monomials, degree, known, report)?;
        }
        let rational = RationalSearch { setting, variables, monomials, degree };
        if is_open(known) {
            rational.search(&at, &step.relations, counted, known, report)?;
        }
        if is_open(known) && setting.flow.is_map {
            rational.search_in_other_order(&at, counted, known, report)?;
        }
        if is_unwritten && is_open(known) {
            self.unwritten = counted;
        }
        Ok(())
    }

    /// States that the Darboux polynomials found are all up to the highest degree for which this is
    /// shown.
    pub fn conclude_factors(
        &self,
        setting: &OrbitSetting<'_>,
        most_steps: f64,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        if self.degree.is_none() || setting.origin.is_some() || setting.is_on_level() {
            return Ok(());
        }
        let known: Vec<Formula> = self.factors.iter().map(|own| own.formula.clone()).collect();
        let (case, effort) = (setting.case, setting.effort);
        let degrees = (1..self.next_darboux).rev();
        let Ok(shown) = no_others::shown(case, effort, &known, degrees, most_steps)? else {
            return Ok(());
        };
        let names: Vec<String> = setting.terms.iter().map(ToString::to_string).collect();
        let statement = no_others::statement(&names.join(", "), shown.degree, &known);
        let statement = no_others::explained(setting, statement, &known, &[], report)?;
        // The theorem of a shorter search.
        report.excluded.retain(|own| own.origin != TheoremOrigin::Darboux);
        report.excluded.push(Excluded {
            ansatz: format!("{DARBOUX_FAMILY} {}", shown.degree),
            dimension: known.len(),
            known: known.len(),
            error_log2: Some(shown.error_log2),
            theorem: fractions::sentence(case, &statement),
            origin: TheoremOrigin::Darboux,
            values: None,
        });
        Ok(())
    }

    /// Reports the degree reached and the theorem of absence.
    pub fn conclude(
        &self,
        setting: &OrbitSetting<'_>,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        report.orbits.extend(self.done.iter().cloned());
        // With functions as variables the theorem is stated elsewhere, with their formulas.
        let is_plain = setting.origin.is_none() && !setting.is_on_level();
        if !setting.flow.is_rational || setting.has_lists() || !is_plain {
            return Ok(());
        }
        let none = self.done.iter().rfind(|own| own.relations == 0);
        let Some(degree) = none.map(|own| own.degree) else { return Ok(()) };
        let is_partial = setting.flow.is_map && !setting.fills_space()?;
        if is_partial || fractions::is_covered(report, degree) {
            return Ok(());
        }
        let names: Vec<String> = setting.terms.iter().map(ToString::to_string).collect();
        let names = names.join(", ");
        let statement = |degree: u32| {
            let class = format!("polynomials in {names} of degree at most {degree}");
            fractions::sentence(setting.case, &fractions::none_is(&class))
        };
        // The same polynomials may have been excluded up to another degree.
        let is_stated = |own: &Excluded, degrees: std::ops::Range<u32>| {
            degrees.map(statement).any(|other| other == own.theorem)
        };
        if report.excluded.iter().any(|own| is_stated(own, degree..MOST_DEGREE)) {
            return Ok(());
        }
        report.excluded.retain(|own| !is_stated(own, 1..degree));
        report.excluded.push(Excluded {
            ansatz: fractions::family(degree),
            dimension: 0,
            known: 0,
            error_log2: None,
            theorem: statement(degree),
            origin: TheoremOrigin::Orbit,
            values: None,
        });
        Ok(())
    }
}

/// Whether all integrals of an extended case are known: one less than its dimension.
fn is_complete(setting: &OrbitSetting<'_>, known: &IndependentIntegrals) -> bool {
    let is_full = |origin: ExtendedCase<'_>| has_all(origin.case, known.formulas().count());
    setting.origin.is_some_and(is_full)
}
