//! Outcome of a search: finds, theorems of absence, counts and remarks.

use serde::Serialize;

use super::ask::Claimed;
use super::conditions::ParameterCondition;
use super::counts::{self, CountReport};
use super::multipliers::MultiplierReport;
use super::orbit::OrbitReport;
use super::origin::{Remark, RemarkOrigin, TheoremOrigin};
use super::second_opinion::SecondOpinion;
use super::{Effort, Found, FoundKind, SearchError};
use liouville::case::Case;
use liouville::formula::Formula;

/// End of a theorem of absence where a function of the case is arbitrary.
const GENERIC_FUNCTION: &str = " The arbitrary function of the case is a generic one here: for special \
    ones there may be more.";

/// A theorem of absence: a family of candidates, and a bound on its invariants.
#[derive(Clone, Debug, Serialize)]
pub struct Excluded {
    /// Family that was examined.
    pub ansatz: String,
    /// Dimension of the invariants in the family.
    pub dimension: usize,
    /// Number of these that are functions of known invariants.
    pub known: usize,
    /// Log₂ of the error probability; absent if there is no error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_log2: Option<f64>,
    /// Theorem with its hypotheses.
    pub theorem: String,
    /// Source.
    #[serde(skip)]
    pub origin: TheoremOrigin,
    /// Values of parameters for which alone it is stated, in words; `ansatz` ends with them.
    #[serde(skip)]
    pub values: Option<String>,
}

impl Excluded {
    /// Family without the values for which alone the theorem is stated.
    pub(crate) fn family(&self) -> &str {
        let values = self.values.as_ref().map(|values| format!(", for {values}"));
        values.and_then(|values| self.ansatz.strip_suffix(&values)).unwrap_or(&self.ansatz)
    }
}

/// The outcome of a search.
#[derive(Clone, Debug, Default, Serialize)]
pub struct SearchReport {
    /// Numbers of integrals, degree by degree.
    pub counts: Vec<CountReport>,
    /// Numbers of polynomials whose powers are densities.
    pub multipliers: Vec<MultiplierReport>,
    /// Relations along an orbit, degree by degree.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub orbits: Vec<OrbitReport>,
    /// Invariants that were found.
    pub found: Vec<Found>,
    /// Theorems of absence.
    pub excluded: Vec<Excluded>,
    /// Singular values of the matrices of the search for integrals.
    pub opinions: Vec<SecondOpinion>,
    /// Parameter conditions for claims that fail in general.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub conditions: Vec<ParameterCondition>,
    /// Parts that could not be carried out, with reasons.
    pub remarks: Vec<Remark>,
    /// Parts that a stopped search did not reach; empty for a complete search.
    pub unreached: Vec<String>,
    /// Whether integrals that are counted and not known are functions of those known, as these are as many
    /// independent ones as there can be.
    #[serde(skip)]
    pub is_complete: bool,
    /// Parts that could not be carried out as no terms have values modulo a prime, or no system was built.
    #[serde(skip)]
    pub(crate) without_points: Vec<String>,
    /// Polynomial integrals met on the way that are functions of others, and no polynomials in them.
    #[serde(skip)]
    pub(crate) dependent: Vec<Formula>,
    /// Integrals claimed by the case, with which finds are compared.
    #[serde(skip)]
    pub(crate) claimed: Vec<Claimed>,
}

impl SearchReport {
    /// Returns the formulas of one kind found for the case without additional data.
    pub fn formulas(&self, kind: FoundKind) -> impl Iterator<Item = &str> {
        self.of_case(kind).map(Found::text)
    }

    /// Returns the functions of one kind found for the case without additional data.
    pub fn functions(&self, kind: FoundKind) -> impl Iterator<Item = &Formula> {
        self.of_case(kind).filter_map(Found::function)
    }

    pub(crate) fn of_case(&self, kind: FoundKind) -> impl Iterator<Item = &Found> {
        self.found.iter().filter(move |found| found.kind == kind && found.with.is_empty())
    }

    /// Whether it has a find of a kind with this formula.
    pub(crate) fn has(&self, kind: FoundKind, text: &str) -> bool {
        self.found.iter().any(|own| own.kind == kind && own.text() == text)
    }

    pub(crate) fn remark(&mut self, remark: impl Into<Remark>) {
        let remark = remark.into();
        if !self.remarks.contains(&remark) {
            self.remarks.push(remark);
        }
    }

    /// Adds a remark that others depend on.
    pub(crate) fn remark_of(&mut self, origin: RemarkOrigin, text: String) {
        self.remark(Remark { text, origin });
    }

    /// Takes over what a search along orbits of higher degrees has found besides, and its theorems, unless
    /// it was stopped before it came as far as the one before; `unwritten` has the finds before they were
    /// written otherwise.
    pub(crate) fn grow(&mut self, grown: Self, unwritten: &[Found]) {
        let degree = |own: &Self| own.orbits.last().map_or(0, |last| last.degree);
        if degree(&grown) < degree(self) {
            return;
        }
        self.orbits = grown.orbits;
        for found in grown.found {
            if !unwritten.iter().chain(&self.found).any(|own| own.says(&found)) {
                self.found.push(found);
            }
        }
        let is_graded = |own: &Excluded| own.origin.is_graded();
        if grown.excluded.iter().any(is_graded) {
            self.excluded.retain(|own| !is_graded(own));
        }
        for theorem in grown.excluded {
            match self.excluded.iter_mut().find(|own| own.ansatz == theorem.ansatz) {
                Some(own) => *own = theorem,
                None => self.excluded.push(theorem),
            }
        }
    }

    /// Runs a part of a search; a part that is stopped is noted by its name.
    pub(crate) fn stage(
        &mut self,
        name: &str,
        effort: &Effort,
        run: impl FnOnce(&mut Self) -> Result<(), SearchError>,
    ) -> Result<(), SearchError> {
        let outcome = effort.halt.check().and_then(|()| run(self));
        self.note(name, outcome)
    }

    fn note(&mut self, name: &str, outcome: Result<(), SearchError>) -> Result<(), SearchError> {
        match outcome {
            Err(SearchError::Stopped) => {
                self.unreached.push(name.to_string());
                Ok(())
            }
            Err(error @ (SearchError::NoPoints | SearchError::Unbuilt(_))) => {
                self.without_points.push(format!("not searched: {name}: {error}"));
                Ok(())
            }
            other => other,
        }
    }
}

/// Says in theorems of absence that an arbitrary function of the case is a generic one there: they come
/// from one choice of its Taylor coefficients.
pub(crate) fn note_generic_functions(case: &Case, report: &mut SearchReport) {
    if !case.model.system.has_arbitrary_function() {
        return;
    }
    let is_potential_alone =
        counts::free_motion(case).is_some_and(|free| !free.model.system.has_arbitrary_function());
    for own in &mut report.excluded {
        if !(is_potential_alone && own.origin.is_for_every_potential()) {
            own.theorem.push_str(GENERIC_FUNCTION);
        }
    }
}
