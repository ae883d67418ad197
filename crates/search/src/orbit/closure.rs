//! Integrals that are brackets of others, or their derivatives along symmetry fields.
//!
//! Searches along orbits end where the number of independent integrals is reached: of Laplace's vector
//! they find one component. The others are functions of the integrals, and no polynomials in them.
//! They are told as further integrals, each proved like any other find, if they are of no higher degree
//! than those from which they come, not much longer, and contain no other functions than the field.

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::Formula;
use liouville::order::StableOrder;
use liouville::verdict::Verdict;

use super::super::absence::rank;
use super::super::ask::{judged_alone, surface};
use super::super::integrals::claimed_by;
use super::super::products::Generators;
use super::super::{Effort, Found, FoundKind, Given, SearchError, SearchReport};
use super::adjoin::{self, FieldComponents, IntegralAlgebra, RingPolynomial, polynomial_text};
use super::claims::{self, OrbitStatement};
use super::factor::RatedPolynomial;
use super::found;
use super::known::IndependentIntegrals;
use super::setting::OrbitSetting;

/// Largest number of integrals that are taken together.
const MOST_INTEGRALS: usize = 12;
/// Largest number of further integrals.
const MOST_FURTHER: usize = 12;
/// Largest number of brackets and derivatives that are tried.
const MOST_TRIED: usize = 400;
/// Largest number of terms of one, and of one that is a function of those known.
const MOST_TERMS: [usize; 2] = [80, 40];
/// Largest number of products with which one is compared.
const MOST_PRODUCTS: usize = 300;
/// Number of points at which one must have the rate 0.
const POINTS: u64 = 3;

/// An integral of the algebra.
struct OwnIntegral {
    polynomial: RingPolynomial,
    /// Formula in the extended case.
    formula: Formula,
    /// Degree as a polynomial.
    degree: u32,
    /// Text in the names of the case.
    text: String,
}

impl OwnIntegral {
    /// Degree and number of terms.
    fn size(&self) -> (u32, usize) {
        (self.degree, self.polynomial.terms().count())
    }
}

/// A function that may be an integral.
struct Candidate {
    polynomial: RingPolynomial,
    /// Largest degree and number of terms of one that is a function of those known.
    most: (u32, usize),
    /// Its origin in others, if it is one of theirs.
    origin: Option<Given>,
}

/// Adds brackets of integrals, and derivatives along symmetry fields, to the report.
pub fn close(case: &Case, effort: &Effort, report: &mut SearchReport) -> Result<(), SearchError> {
    let known = found(case, effort, report)?;
    if known.is_empty() || known.len() > MOST_INTEGRALS {
        return Ok(());
    }
    let symmetries: Vec<(String, FieldComponents)> = report
        .of_case(FoundKind::SymmetryField)
        .map(|own| (own.text().to_string(), own.fields.clone()))
        .collect();
    let fields: Vec<&FieldComponents> = symmetries.iter().map(|(_, own)| own).collect();
    let all = [known.as_slice(), &report.dependent].concat();
    let Some(algebra) = IntegralAlgebra::of(case, effort, &all, &fields)? else { return Ok(()) };
    let Ok(setting) = OrbitSetting::extended(case, &algebra.extension, effort)? else {
        return Ok(());
    };
    let independent = IndependentIntegrals::of(&setting, report)?;
    let mut closure = Closure {
        setting: &setting,
        algebra: &algebra,
        known: &known,
        independent,
        all: Vec::new(),
    };
    let mut dependent = Vec::new();
    for (place, polynomial) in &algebra.integrals {
        match known.get(*place) {
            Some(own) => {
                let text = own.text().to_string();
                closure.all.extend(closure.integral(polynomial.clone(), text));
            }
            None => dependent.push(polynomial.clone()),
        }
    }
    // Products of those of low degree are not new.
    closure.all.order_by_key(|own| own.degree);
    let (mut next, mut tried, mut told) = (0, 0, 0);
    while next < closure.all.len() && told < MOST_FURTHER {
        let candidates = closure.candidates(next, &symmetries);
        next += 1;
        for candidate in candidates {
            effort.halt.check()?;
            tried += 1;
            if tried > MOST_TRIED || told == MOST_FURTHER {
                return Ok(());
            }
            told += usize::from(closure.consider(candidate, report)?);
        }
    }
    for polynomial in dependent {
        if told == MOST_FURTHER {
            break;
        }
        effort.halt.check()?;
        let most = (algebra.degree(&polynomial), polynomial.terms().count());
        let candidate = Candidate { polynomial, most, origin: None };
        told += usize::from(closure.consider(candidate, report)?);
    }
    Ok(())
}

/// Integrals found so far, with what follows from them.
struct Closure<'s, 'c> {
    setting: &'s OrbitSetting<'c>,
    algebra: &'s IntegralAlgebra,
    /// Integrals known from the start, in the names of the case.
    known: &'s [Formula],
    independent: IndependentIntegrals,
    all: Vec<OwnIntegral>,
}

impl Closure<'_, '_> {
    /// Writes a polynomial in the names of the extended case.
    fn formula(&self, own: &RingPolynomial) -> Option<Formula> {
        let text = polynomial_text(own, self.algebra.extension.names());
        self.setting.case.formula(&text).ok()
    }

    fn integral(&self, polynomial: RingPolynomial, text: String) -> Option<OwnIntegral> {
        let formula = self.formula(&polynomial)?;
        let degree = self.algebra.degree(&polynomial);
        Some(OwnIntegral { polynomial, formula, degree, text })
    }

    /// Derivatives of an integral, and its brackets with those before it.
    fn candidates(&self, place: usize, symmetries: &[(String, FieldComponents)]) -> Vec<Candidate> {
        let own = &self.all[place];
        let along = |symmetry: usize| {
            let polynomial = self.algebra.along(symmetry, &own.polynomial)?;
            let text = format!("{} of {}", symmetries[symmetry].0, own.text);
            let origin = Some(Given::DerivativeAlong(text));
            Some(Candidate { polynomial, most: own.size(), origin })
        };
        let bracket = |other: &OwnIntegral| {
            let polynomial = self.algebra.bracket(&other.polynomial, &own.polynomial)?;
            let origin = Some(Given::Bracket(format!("{{{}, {}}}", other.text, own.text)));
            let (size, of_other) = (own.size(), other.size());
            let most = (size.0.max(of_other.0), size.1.max(of_other.1));
            Some(Candidate { polynomial, most, origin })
        };
        let derived = self.algebra.symmetries().filter_map(along);
        let is_short = |own: &Candidate| own.polynomial.terms().count() <= MOST_TERMS[0];
        let all = self.all[..place].iter().filter_map(bracket).chain(derived);
        let mut all: Vec<Candidate> = all.filter(is_short).collect();
        all.order_by_key(|own| self.algebra.degree(&own.polynomial));
        all
    }

    /// Tells a candidate that is proved to be an integral and is no polynomial in those known; returns
    /// whether it does.
    fn consider(
        &mut self,
        candidate: Candidate,
        report: &mut SearchReport,
    ) -> Result<bool, SearchError> {
        let degree = self.algebra.degree(&candidate.polynomial);
        if degree == 0 {
            return Ok(false);
        }
        let Some(formula) = self.formula(&candidate.polynomial) else { return Ok(false) };
        // A sign, as y/|y|, has two values and no slope.
        if !self.is_integral(&formula)?
            || !self.is_independent(&formula, &self.independent.none())?
            || !self.is_new(&formula, degree)?
        {
            return Ok(false);
        }
        let is_independent = self.is_independent(&formula, &self.independent)?;
        let terms = candidate.polynomial.terms().count();
        let (most_degree, most_terms) = candidate.most;
        let is_component = degree <= most_degree
            && terms <= (2 * most_terms).min(MOST_TERMS[1])
            && (self.algebra.is_of_field(&candidate.polynomial)
                || !self.setting.effort.terms.is_empty());
        if !is_independent && (!is_component || self.is_of_one(&formula)?) {
            return Ok(false);
        }
        let is_told = match is_independent {
            true => claims::integral(self.setting, &formula, report)?,
            false => self.tell(&formula, candidate.origin, report)?,
        };
        if is_told {
            let text = report.found.last().map(|own| own.text().to_string()).unwrap_or_default();
            self.all.extend(self.integral(candidate.polynomial, text));
            if is_independent {
                let all: Vec<usize> = (0..self.setting.dimension()).collect();
                self.independent.add(formula, None, &all);
            }
        }
        Ok(is_told)
    }

    fn tell(
        &self,
        formula: &Formula,
        origin: Option<Given>,
        report: &mut SearchReport,
    ) -> Result<bool, SearchError> {
        let Some(formula) = claims::written_integral(self.setting, formula) else {
            return Ok(false);
        };
        if self.is_of_surface(&formula)? {
            return Ok(false);
        }
        let bare = adjoin::merged(formula.text());
        if report.found.iter().any(|own| adjoin::merged(own.text()) == bare) {
            return Ok(false);
        }
        let statement = OrbitStatement::Integral(formula.clone());
        let Some(found) = claims::judged_here(self.setting, &statement)? else { return Ok(false) };
        let case = claims::judged_case(self.setting);
        let known = claimed_by(case, &formula, self.setting.effort, report)?;
        let found = Found::new(FoundKind::FurtherIntegral, &formula, known, found, &case.model);
        report.found.push(Found { with: origin.into_iter().collect(), ..found });
        Ok(true)
    }

    /// Whether an integral is a function of that whose levels are the surfaces on which a ball rolls.
    fn is_of_surface(&self, formula: &Formula) -> Result<bool, SearchError> {
        let case = claims::judged_case(self.setting);
        let Some(surface) = surface(case) else { return Ok(false) };
        let claim = Claim::independent(vec![surface, formula.clone()]);
        let judged = judged_alone(case, claim, self.setting.effort)?;
        Ok(judged.is_some_and(|own| own.verdict == Verdict::Refuted))
    }

    /// Whether a function does not change at random points modulo a prime.
    fn is_integral(&self, formula: &Formula) -> Result<bool, SearchError> {
        let Some(at) = self.setting.at(0, 0) else { return Ok(false) };
        let Some(rated) = RatedPolynomial::of(self.setting, formula, 1)? else { return Ok(false) };
        let rate = |number| Some(rated.at(&at, &self.setting.point(&at, number)?)?.1);
        Ok((0..POINTS).all(|number| rate(number) == Some(0)))
    }

    /// Whether a function is no combination of products of the known integrals, of at most twice its
    /// degree if these are few.
    fn is_new(&self, formula: &Formula, degree: u32) -> Result<bool, SearchError> {
        let of = |own: &OwnIntegral| (own.formula.clone(), own.degree.max(1));
        let generators = Generators::of(self.all.iter().map(of).collect());
        let is_few = |most: &u32| generators.products(*most, true) <= MOST_PRODUCTS;
        let Some(most) = [2 * degree, degree].into_iter().find(is_few) else { return Ok(false) };
        let products = generators.exponents(most, true);
        let terms: Vec<Formula> = generators.formulas().cloned().collect();
        let (case, effort) = (self.setting.case, self.setting.effort);
        let rank = |further: &[Formula]| rank(case, &terms, &products, further, effort);
        let (Some(before), Some(after)) = (rank(&[])?, rank(std::slice::from_ref(formula))?) else {
            return Ok(false);
        };
        Ok(after > before)
    }

    /// Whether a function is one of a single known integral, as e^(−H) is.
    fn is_of_one(&self, formula: &Formula) -> Result<bool, SearchError> {
        let Some(formula) = claims::written_integral(self.setting, formula) else {
            return Ok(false);
        };
        let case = claims::judged_case(self.setting);
        for known in self.known {
            let claim = Claim::independent(vec![known.clone(), formula.clone()]);
            let judged = judged_alone(case, claim, self.setting.effort)?;
            if judged.is_some_and(|own| own.verdict == Verdict::Refuted) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether the gradient of a function is independent of those of some integrals.
    fn is_independent(
        &self,
        formula: &Formula,
        of: &IndependentIntegrals,
    ) -> Result<bool, SearchError> {
        let Some(at) = self.setting.at(0, 0) else { return Ok(false) };
        let Some((_, before)) = of.gradients(self.setting, &at)? else {
            return Ok(false);
        };
        let mut with = of.clone();
        let all: Vec<usize> = (0..self.setting.dimension()).collect();
        with.add(formula.clone(), None, &all);
        let after = with.gradients(self.setting, &at)?;
        Ok(after.is_some_and(|(_, after)| after.rank() > before.rank()))
    }
}
