//! Single values of the parameters at which a claim holds, or the criterion: those that belong to no condition
//! of codimension one, and the real zeros of an equation that has no real hypersurface.

use std::cell::Cell;

use liouville::case::{Case, PlacedClaim};
use liouville::number::prime::Modulus;
use liouville::proof::ProofRng;

use super::hypersurface::{Hypersurface, PrimeTerms};
use super::ideal::degree;
use super::motion::is_undefined;
use super::points::at_points;
use super::quotient::divided;
use super::real::{RealSearch, Terms};
use super::relation::ScalarParameter;
use super::residual::{RESIDUAL_LANES, Residual};
use super::split::SplitCase;
use super::variety::VarietyEquation;
use super::{isolated, solved};
use crate::budget::STEPS;
use crate::streams::SearchStream;
use crate::{Effort, SearchError};

/// Number of rounds of states at which a residual is looked at.
const ROUNDS: usize = 6;

/// A search for single values.
pub struct ValueSearch<'s> {
    split: SplitCase,
    claim: Option<&'s PlacedClaim>,
    /// Residual of the case written by scalars.
    residual: Option<Residual>,
    effort: &'s Effort,
}

/// Single values.
#[derive(Default)]
pub struct SingledValues {
    /// Equations of each.
    pub equations: Vec<String>,
    /// Those under which the claim is proved.
    proved: Vec<String>,
    /// Number of further sets of which it is not known whether the claim holds there.
    unknown: usize,
    /// Equations without real zeros, or with those listed only.
    thin: Vec<String>,
}

/// Equations of codimension one by their real zeros; those without any are left out.
#[derive(Default)]
pub struct RealSurfaces {
    /// Those with real hypersurfaces.
    pub told: Vec<String>,
    /// Others, of which single values say more if these are known.
    others: Vec<OtherSurface>,
}

/// An equation without a real hypersurface, or of which it is not known whether it has one.
struct OtherSurface {
    text: String,
    is_known: bool,
    /// Whether it is one between the scalars of the case, so that single values are those on it as well.
    is_read: bool,
}

impl RealSurfaces {
    /// Tells the others too unless single values are known; returns words for what is not known.
    pub fn complete(&mut self, has_values: bool) -> String {
        let mut open = Vec::new();
        for own in self.others.drain(..).filter(|own| !(has_values && own.is_read)) {
            open.extend(Some(own.text.clone()).filter(|_| !own.is_known));
            self.told.push(own.text);
        }
        match open.as_slice() {
            [] => String::new(),
            open => {
                let all = open.join(", or with ");
                format!("; it is not known whether there are real values with {all}")
            }
        }
    }
}

impl<'s> ValueSearch<'s> {
    /// Prepares a search.
    pub fn of(
        case: &Case,
        claim: Option<&'s PlacedClaim>,
        effort: &'s Effort,
    ) -> Result<Self, SearchError> {
        let split = SplitCase::of(case);
        let residual = match split.scalars.is_empty() {
            true => None,
            false => Residual::of(&split.case, claim, effort.options.seed)?,
        };
        Ok(Self { split, claim, residual, effort })
    }

    /// Decides which equations between some components of the parameters have real hypersurfaces of zeros.
    pub fn real_surfaces(
        &self,
        names: &[String],
        surfaces: &[VarietyEquation],
        m: Modulus,
    ) -> Result<RealSurfaces, SearchError> {
        let mut all = RealSurfaces::default();
        for own in surfaces {
            let Some(surface) = Hypersurface::from_terms(own.terms.clone()) else { continue };
            if let Some(own) = self.read(names, own)
                && self.holds(&[own])? == Some(false)
            {
                continue;
            }
            let found =
                self.search(names.len(), m, |search| search.zeros(std::slice::from_ref(&surface)))?;
            if found.real.iter().any(|set| *set == [surface.clone()]) {
                all.told.push(own.text.clone());
            } else if !found.real.is_empty() || found.unknown() > 0 {
                let (is_known, is_read) = (found.unknown() == 0, self.read(names, own).is_some());
                all.others.push(OtherSurface { text: own.text.clone(), is_known, is_read });
            }
        }
        Ok(all)
    }

    fn search<T>(
        &self,
        variables: usize,
        m: Modulus,
        run: impl FnOnce(&mut RealSearch<'_>) -> T,
    ) -> T {
        let left = Cell::new(isolated::SHARE * self.effort.seconds * STEPS);
        let mut rng = SearchStream::Residuals.under(self.effort.options.seed.wrapping_add(3));
        let halt = &self.effort.halt;
        run(&mut RealSearch { variables, m, rng: &mut rng, left: &left, halt })
    }

    /// Reads an equation between components as one between the scalars; `None` if a component is none.
    pub fn read(&self, names: &[String], own: &VarietyEquation) -> Option<Hypersurface> {
        let places: Vec<Option<usize>> = names
            .iter()
            .map(|name| self.split.scalars.iter().position(|scalar| scalar.name == *name))
            .collect();
        let count = self.split.scalars.len();
        let term = |(exponents, value): &(Vec<u32>, _)| {
            let mut spread = vec![0; count];
            for (power, place) in exponents.iter().zip(&places).filter(|(power, _)| **power > 0) {
                spread[(*place)?] = *power;
            }
            Some((spread, Clone::clone(value)))
        };
        let terms: Option<Terms> = own.terms.iter().map(term).collect();
        Hypersurface::from_terms(terms?)
    }

    /// Finds single values besides equations that are known, if all of these are between scalars; `None` if
    /// the residual is not a fraction of low degree in the scalars.
    pub fn values(
        &self,
        surfaces: Option<&[Hypersurface]>,
    ) -> Result<Option<SingledValues>, SearchError> {
        let Some(residual) = &self.residual else { return Ok(None) };
        let Some(found) = isolated::of_claim(&self.split, residual, self.effort)? else {
            return Ok(None);
        };
        let mut all = SingledValues { unknown: found.unknown, ..SingledValues::default() };
        for own in &found.written {
            self.add(own, &mut all)?;
        }
        let Some(surfaces) = surfaces else { return Ok(Some(all)) };
        let (common, m) = found.common;
        let mut rest = common;
        for own in surfaces {
            self.thin(own, true, m, &mut all)?;
            let images: PrimeTerms = own.images(&m).unwrap_or_default();
            while let Some(quotient) =
                Some(&images).filter(|own| degree(own) > 0).and_then(|own| divided(&m, &rest, own))
            {
                rest = quotient;
            }
        }
        if degree(&rest) > 0 {
            match Hypersurface::of(&rest, &m) {
                Some(own) => self.thin(&own, false, m, &mut all)?,
                None => all.unknown += 1,
            }
        }
        Ok(Some(all))
    }

    /// Adds the real zeros of an equation; the equation itself, if it has a real hypersurface, unless that is
    /// listed already.
    fn thin(
        &self,
        own: &Hypersurface,
        is_told: bool,
        m: Modulus,
        all: &mut SingledValues,
    ) -> Result<(), SearchError> {
        let count = self.split.scalars.len();
        let found = self.search(count, m, |search| search.zeros(std::slice::from_ref(own)))?;
        all.unknown += found.unknown();
        let whole = [own.clone()];
        for set in &found.real {
            if !(is_told && *set == whole) {
                self.add(set, all)?;
            }
        }
        if found.unknown() == 0 && !found.real.iter().any(|set| *set == whole) {
            let text = own.equation(&self.split.scalars);
            all.thin.push(match found.real.is_empty() {
                true => format!("{text} has no real zeros"),
                false => format!("{text} has no real zeros but those listed"),
            });
        }
        Ok(())
    }

    /// Adds values where the claim holds.
    fn add(&self, own: &[Hypersurface], all: &mut SingledValues) -> Result<(), SearchError> {
        let holds = self.holds(own)?;
        if holds == Some(false) {
            return Ok(());
        }
        let text = written(own, &self.split.scalars);
        let is_proved = match self.claim {
            Some(claim) => solved::is_proved(&self.split, own, claim, self.effort)?,
            None => false,
        };
        match is_proved || holds == Some(true) {
            true => all.equations.push(text.clone()),
            false => all.unknown += 1,
        }
        all.proved.extend(Some(text).filter(|_| is_proved));
        Ok(())
    }

    /// Whether the residual and the motion have values where some equations hold, and the residual is 0 at all
    /// states that are tried there, modulo primes; `None` if that is not known.
    fn holds(&self, own: &[Hypersurface]) -> Result<Option<bool>, SearchError> {
        let seed = self.effort.options.seed.wrapping_add(100);
        if is_undefined(&self.split, own, seed)? {
            return Ok(Some(false));
        }
        let Some(residual) = &self.residual else { return Ok(None) };
        let scalars = &self.split.scalars;
        let mut prime = |number: u64| {
            let mut rng = SearchStream::Residuals.under(seed.wrapping_add(number));
            let m = residual.prime(&mut rng);
            let own = SearchStream::Residuals.under(seed.wrapping_add(200 + number));
            Ok(Some(((m, own), m, rng)))
        };
        let mut holds = |(m, rng): &mut (Modulus, ProofRng), point: &[u64]| {
            let mut parameters = residual.parameters(m, rng);
            scalars.iter().zip(point).for_each(|(own, value)| parameters[own.draw] = *value);
            Ok(vanishes(residual, &parameters, *m, rng))
        };
        at_points(own, scalars.len(), &mut prime, &mut holds, &self.effort.halt)
    }
}

/// Whether a residual is defined, and 0 at random states; `None` if the motion has no values modulo primes.
fn vanishes(
    residual: &Residual,
    parameters: &[u64],
    m: Modulus,
    rng: &mut ProofRng,
) -> Option<bool> {
    let mut evaluator = residual.evaluator(m);
    let mut zeros = 0;
    for _ in 0..ROUNDS {
        let points: [Vec<u64>; RESIDUAL_LANES] =
            std::array::from_fn(|_| [parameters, &residual.state(&m, rng)].concat());
        for seen in residual.at(&mut evaluator, &points) {
            match seen.residual {
                Some(values) if values.iter().any(|x| *x != 0) => return Some(false),
                Some(_) => zeros += 1,
                None => {}
            }
        }
    }
    match (zeros > 0, residual.has_all_rates()) {
        (false, _) => Some(false),
        (true, true) => Some(true),
        (true, false) => None,
    }
}

/// Writes some equations.
pub fn written(own: &[Hypersurface], scalars: &[ScalarParameter]) -> String {
    let texts: Vec<String> = own.iter().map(|own| own.equation(scalars)).collect();
    texts.join(" and ")
}

impl SingledValues {
    /// Adds to grounds what is found, proved and left out; `scope` says where.
    pub fn grounds(&self, before: &str, scope: &str) -> String {
        let mut text = before.to_string();
        self.thin.iter().for_each(|own| text.push_str(&format!("; {own}")));
        text.push_str(&format!("; {scope} it holds for no "));
        text.push_str(match self.equations.len() {
            0 => "real values of the parameters",
            _ => "real values other than those reported",
        });
        match self.unknown {
            0 => {}
            1 => text.push_str(&format!(", but perhaps for a set of values {UNKNOWN}")),
            n => text.push_str(&format!(", but perhaps for {n} sets of values {UNKNOWN}")),
        }
        if !self.proved.is_empty() {
            text.push_str(&format!("; proved where {}", self.proved.join(", or where ")));
        }
        text
    }
}

/// Reasons why it is not known whether a statement holds for values.
pub const UNKNOWN: &str = "whose equations have no short coefficients, or of which it is not known \
                           whether they are real and the motion has values there";
