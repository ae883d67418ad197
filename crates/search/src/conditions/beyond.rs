//! Conditions of several equations on the parameters of a field that belong to none of codimension one.

use crate::Given;
use std::cell::Cell;

use super::equations::ParametricEquations;
use super::hypersurface::{Hypersurface, PrimeTerms};
use super::locus::SpecialLocus;
use super::motion::is_undefined;
use super::points::at_points;
use super::real::RealSearch;
use super::several::{ConditionSearch, GROUNDS, SEARCH};
use super::simple::SimpleEquations;
use super::singled::{UNKNOWN, written};
use super::split::SplitCase;
use super::values::integrals_with;
use super::{ParameterCondition, ideal, isolated, solved};
use crate::Found;
use crate::SearchError;
use crate::ansatz::system::PrimePoint;
use crate::budget::STEPS;
use crate::origin::ConditionOrigin;
use crate::streams::SearchStream;

impl ConditionSearch<'_> {
    /// Finds conditions of several equations that belong to none of codimension one, and says how far
    /// conditions of several equations are sought; `simple` are words for where they are sought besides.
    pub fn isolated(&mut self, simple: &str) -> Result<(), SearchError> {
        let (mut last, mut unknown) = (0, 0);
        for degree in 1..=self.effort.degree {
            (self.progress)(&format!("conditions of several equations, degree {degree}"));
            let equations = ParametricEquations::new(&self.whole.case, degree, self.effort)?;
            let Some(equations) = equations else { break };
            let own = self.singular.iter().filter(|own| own.0 == degree);
            let singular: Vec<Vec<Hypersurface>> = own.map(|(_, own)| own.clone()).collect();
            let before = self.left.min(isolated::SHARE * self.effort.seconds * STEPS);
            let left = Cell::new(before);
            let own = isolated::of_integrals(&equations, self.whole, &left)?;
            self.left -= before - left.get();
            let is_sought = own.is_some();
            let (written, mut open) = own.map(|own| (own.written, own.unknown)).unwrap_or_default();
            let mut found = Vec::new();
            for own in singular.into_iter().chain(written) {
                if self.is_known(&own)? {
                    continue;
                }
                match is_special(&equations, self.whole, &own)? {
                    Some(true) => found.push(self.tell_isolated(&own)?),
                    Some(false) => {}
                    None => open += 1,
                }
            }
            self.add_isolated(degree, found, open);
            unknown += open;
            if !is_sought {
                break;
            }
            last = degree;
        }
        let others = match unknown {
            0 => "real values of the parameters",
            _ => "real values of the parameters than those reported or counted",
        };
        self.report.remark(match last {
            0 => format!("conditions of several equations are sought {simple}"),
            last => format!(
                "modulo a prime of 61 bits, no other {others} give more integrals of degree at most {last}, \
                 unless a single equation holds that is told or counted; where one holds, and for higher \
                 degrees, conditions of several equations are sought {simple}"
            ),
        });
        Ok(())
    }

    /// Reports conditions of several equations, and how many sets of values may be further ones.
    fn add_isolated(&mut self, degree: u32, found: Vec<String>, open: usize) {
        if found.is_empty() && open == 0 {
            return;
        }
        let of =
            format!("more polynomial integrals of degree at most {degree}, by several equations");
        let open = match open {
            0 => String::new(),
            n => format!("; {n} further sets of values may give more, {UNKNOWN}"),
        };
        match self.report.conditions.iter_mut().find(|own| own.of == of) {
            Some(own) => {
                own.equations.extend(found);
                own.grounds.push_str(&open);
            }
            None => {
                let grounds = format!("{GROUNDS}{}{open}", self.whole.reservation());
                let origin = ConditionOrigin::Polynomials;
                let own = ParameterCondition { of, equations: found, grounds, origin };
                self.report.conditions.push(own);
            }
        }
    }

    /// Takes those equations from a locus that have no real hypersurfaces, and keeps their real zeros; returns
    /// words for those of which that is not known.
    pub fn without_thin(
        &mut self,
        simple: &SimpleEquations,
        degree: u32,
        locus: &mut SpecialLocus,
    ) -> Result<String, SearchError> {
        let (free, count) = (simple.free(), self.whole.scalars.len());
        let bound: Vec<Hypersurface> =
            simple.equations().into_iter().map(|own| Hypersurface::from(own, count)).collect();
        let mut unknown = Vec::new();
        let surfaces = std::mem::take(&mut locus.surfaces).into_iter().map(|own| (own, true));
        let pointless = std::mem::take(&mut locus.pointless).into_iter().map(|own| (own, false));
        for (own, has_points) in surfaces.chain(pointless) {
            let mut rng = SearchStream::Lines.under(self.effort.options.seed.wrapping_add(1));
            let m = rng.prime(&[], &[]);
            let left = Cell::new(self.left.min(isolated::SHARE * self.effort.seconds * STEPS));
            let (variables, halt) = (free.len(), &self.effort.halt);
            let mut search = RealSearch { variables, m, rng: &mut rng, left: &left, halt };
            let found = search.zeros(std::slice::from_ref(&own))?;
            let is_whole = found.real.iter().any(|set| *set == [own.clone()]);
            if !is_whole {
                let spread = |own: &Hypersurface| own.spread(&free, count);
                for set in &found.real {
                    let set = set.iter().map(spread).chain(bound.iter().cloned()).collect();
                    self.singular.push((degree, set));
                }
                if found.unknown() == 0 {
                    locus.unexplained -= match has_points {
                        true => 0,
                        false => own.degree().min(locus.unexplained),
                    };
                    continue;
                }
            }
            if has_points {
                if !is_whole {
                    unknown.push(own.spread(&free, count).equation(&self.whole.scalars));
                }
                locus.surfaces.push(own);
            }
        }
        Ok(match unknown.as_slice() {
            [] => String::new(),
            all => format!(
                "; it is not known whether there are real values with {}",
                all.join(", or with ")
            ),
        })
    }

    /// Whether a condition that is known holds where some equations do.
    fn is_known(&self, own: &[Hypersurface]) -> Result<bool, SearchError> {
        let count = self.whole.scalars.len();
        let m = SearchStream::Lines.under(self.effort.options.seed).prime(&[], &[]);
        let images = |own: &Hypersurface| own.images(&m).unwrap_or_default();
        let generators: Vec<PrimeTerms> = own.iter().map(images).collect();
        let implies = |all: &mut dyn Iterator<Item = PrimeTerms>| -> Result<bool, SearchError> {
            for known in all {
                if !ideal::contains(&generators, &known, count, &m, &self.effort.halt)? {
                    return Ok(false);
                }
            }
            Ok(true)
        };
        for known in &self.isolated {
            if implies(&mut known.iter().map(images))? {
                return Ok(true);
            }
        }
        for known in &self.found {
            let simple = known.simple.equations().into_iter();
            let simple = simple.map(|own| Hypersurface::from(own, count));
            let all = simple.chain(known.further.iter().cloned());
            if implies(&mut all.map(|own| images(&own)))? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Searches for the integrals where equations hold, and writes these.
    fn tell_isolated(&mut self, own: &[Hypersurface]) -> Result<String, SearchError> {
        let text = written(own, &self.whole.scalars);
        let known = |found: &Found| found.with.iter().any(|with| with.text() == text);
        let cases = solved::with_equations(self.whole, own).unwrap_or_default();
        if !self.report.found.iter().any(known) && self.left > 0.0 {
            for fixed in &cases {
                let with = Given::Condition(text.clone());
                integrals_with(&fixed.case, with, self.effort, self.report)?;
                self.left -= SEARCH;
            }
        }
        self.isolated.push(own.to_vec());
        Ok(text)
    }
}

/// Whether there are more integrals modulo further primes where some equations hold; `None` if that is not known.
fn is_special(
    equations: &ParametricEquations<'_>,
    whole: &SplitCase,
    own: &[Hypersurface],
) -> Result<Option<bool>, SearchError> {
    if is_undefined(whole, own, equations.effort.options.seed)? {
        return Ok(Some(false));
    }
    let mut prime = |number: u64| {
        let Some(at) = equations.system.at(number, number) else { return Ok(None) };
        let Some(general) = equations.nullity(&at)? else { return Ok(None) };
        let seed = equations.effort.options.seed.wrapping_add(500 + number);
        let m = at.modulus;
        Ok(Some(((at, general), m, SearchStream::Minors.under(seed))))
    };
    let mut holds = |(at, general): &mut (PrimePoint, usize), point: &[u64]| {
        let values = whole.scalars.iter().zip(point);
        values.for_each(|(scalar, value)| at.parameters[scalar.draw] = *value);
        // Without a state the field has no integrals there.
        Ok(Some(equations.nullity(at)?.is_some_and(|own| own > *general)))
    };
    at_points(own, whole.scalars.len(), &mut prime, &mut holds, &equations.effort.halt)
}
