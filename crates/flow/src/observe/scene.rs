//! A case whose motions are followed, with data shared by several claims.

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use crate::{
    Exponents, FlowError, SectionMap, SectionOrbit, SectionRequest, Start, Variational,
    fixed_parameters, section, section_starts, two_sided,
};
use liouville::case::{Case, SectionPlan};
use liouville::claim::Components;
use liouville::claim::motion::{Beginning, Stated};
use liouville::number::rational::Rational;

/// A case with the motions followed so far.
pub struct FollowedCase<'c> {
    pub case: &'c Case,
    pub seed: u64,
    map: OnceLock<SectionMap<'c>>,
    /// Exponents of runs, by start and length.
    exponents: Mutex<Vec<(String, f64, Exponents)>>,
}

/// Coordinates of a stated point.
pub fn coordinates(at: &[Stated; 2]) -> [f64; 2] {
    [at[0].value, at[1].value]
}

impl<'c> FollowedCase<'c> {
    pub fn new(case: &'c Case, seed: u64) -> Self {
        Self { case, seed, map: OnceLock::new(), exponents: Mutex::default() }
    }

    /// Exponents known so far; two threads may find the same ones at once.
    fn known(&self) -> MutexGuard<'_, Vec<(String, f64, Exponents)>> {
        self.exponents.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Section of the case.
    fn plan(&self) -> Result<&'c SectionPlan, FlowError> {
        self.case.section.as_ref().ok_or(FlowError::NoSection)
    }

    /// Section map of the case.
    pub fn map(&self) -> Result<&SectionMap<'c>, FlowError> {
        if let Some(map) = self.map.get() {
            return Ok(map);
        }
        let plan = self.plan()?;
        let map = SectionMap::new(self.case, &plan.g0, &plan.energy, self.seed)?;
        Ok(self.map.get_or_init(|| map))
    }

    /// Free parameters of the case, drawn once.
    pub fn parameters(&self) -> Result<Vec<Rational>, FlowError> {
        fixed_parameters(self.case, self.seed, 0)
    }

    /// State named by a claim, with these free parameters.
    pub fn state(&self, point: &Components, parameters: Vec<Rational>) -> Result<Start, FlowError> {
        Start::at(&self.case.model, parameters, point)
    }

    /// Start of a motion.
    pub fn start(&self, beginning: &Beginning) -> Result<Start, FlowError> {
        match beginning {
            Beginning::State(point) => self.state(point, self.parameters()?),
            Beginning::Section(at) => {
                let plan = self.plan()?;
                let at = [coordinates(at)];
                let starts = section_starts(self.case, &plan.g0, &plan.energy, &at, self.seed)?;
                starts.into_iter().next().unwrap_or(Err(FlowError::NoStart))
            }
        }
    }

    /// Exponent and mean divergence of a run.
    pub fn exponents(&self, beginning: &Beginning, time: f64) -> Result<Exponents, FlowError> {
        let name = beginning.text();
        let is_same = |run: &&(String, f64, Exponents)| run.0 == name && run.1 == time;
        if let Some((.., found)) = self.known().iter().find(is_same) {
            return Ok(*found);
        }
        two_sided(self.case)?;
        let motion = Variational::new(&self.case.model, &self.start(beginning)?)?;
        let found = motion.exponents(time)?;
        self.known().push((name, time, found));
        Ok(found)
    }

    /// Crossings of an orbit, without some at the beginning.
    pub fn crossings(
        &self,
        beginning: &Beginning,
        skip: usize,
        crossings: usize,
    ) -> Result<SectionOrbit, FlowError> {
        let Beginning::Section(at) = beginning else { return Err(FlowError::NoSection) };
        let plan = self.plan()?;
        let request = SectionRequest {
            g0: plan.g0.clone(),
            energy: plan.energy.clone(),
            direction: plan.direction,
            crossings,
            skip,
            starts: vec![coordinates(at)],
            backwards: false,
            seed: self.seed,
            index: 0,
        };
        let mut orbits = section(self.case, &request, 1, &|_| ())?;
        let orbit = orbits.pop().ok_or(FlowError::NoStart)?;
        match orbit.problem {
            Some(problem) => Err(problem),
            None => Ok(orbit),
        }
    }
}
