//! Findings of a survey sorted by subject, and what is known of a density.

use super::hierarchy::MeasureStatus;
use super::question::TestedClaim;
use crate::FoundKind;
use liouville::case::Case;
use liouville::order::StableOrder;
use liouville::verdict::Verdict;

/// Findings sorted by subject.
#[derive(Default)]
pub struct Sorted {
    /// Integrals of all such systems.
    pub general: Vec<TestedClaim>,
    /// Further integrals.
    pub integrals: Vec<TestedClaim>,
    /// Criteria for a density.
    pub criterion: Vec<TestedClaim>,
    /// Densities.
    pub densities: Vec<TestedClaim>,
    /// Rates.
    pub rates: Vec<TestedClaim>,
    /// Symmetry fields.
    pub fields: Vec<TestedClaim>,
    /// Darboux polynomials, whose zeros are invariant surfaces.
    pub surfaces: Vec<TestedClaim>,
    /// Functions of constant rate.
    pub drifts: Vec<TestedClaim>,
    /// Refuted claims.
    pub fails: Vec<TestedClaim>,
    /// Claims without a proof.
    pub undecided: Vec<TestedClaim>,
}

impl Sorted {
    /// Sorts findings; what is repeated is left out.
    pub fn of(all: Vec<TestedClaim>) -> Self {
        let mut sorted = Self::default();
        let mut told: Vec<(&'static str, String)> = Vec::new();
        for tested in all {
            let statement = (tested.claim.kind, tested.formula().to_string());
            if told.contains(&statement) && tested.definitions.is_empty() {
                continue;
            }
            told.push(statement);
            let place = match tested.claim.kind {
                "position-density" | "analytic-density" | "smooth-density" => &mut sorted.criterion,
                // Questions of the case are reported with the case's claims.
                _ if !tested.is_of_family() && !tested.holds() => continue,
                "integral" if !tested.is_of_family() && !tested.is_new_integral() => continue,
                _ if tested.fails() => &mut sorted.fails,
                // What is only confirmed does not count.
                _ if !tested.is_proved() => &mut sorted.undecided,
                "density" => &mut sorted.densities,
                "integral" if tested.is_new_integral() => &mut sorted.integrals,
                "integral" => &mut sorted.general,
                "symmetry-field" => &mut sorted.fields,
                "rate" => &mut sorted.rates,
                kind if kind == FoundKind::DarbouxPolynomial.name() => &mut sorted.surfaces,
                kind if kind == FoundKind::ConstantRate.name() => &mut sorted.drifts,
                _ => continue,
            };
            place.push(tested);
        }
        // A smooth density is of interest where an analytic one is not decided.
        let is_open = |one: &TestedClaim| one.claim.verdict == Verdict::Undecided;
        let is_decided = |one: &TestedClaim| one.is("analytic-density") && !is_open(one);
        if sorted.criterion.iter().any(is_decided) {
            sorted.criterion.retain(|one| !one.is("smooth-density"));
        }
        // Simple formulas first, and those of the case after those of the families.
        sorted.integrals.order_by_key(|one| {
            let length = one.formula().chars().count();
            (!one.is_general, !one.is_of_family(), one.is_quadrature(), length)
        });
        sorted.densities.order_by_key(|one| (!one.is_of_family(), one.is_quadrature()));
        sorted
    }
}

/// Determines the state of knowledge about a density of constant sign.
pub fn measure(case: &Case, sorted: &Sorted) -> MeasureStatus {
    let verdict = |kind: &str| {
        let claim = sorted.criterion.iter().find(|one| one.is(kind));
        claim.map_or(Verdict::Undecided, |one| one.claim.verdict)
    };
    let is_of_state = |one: &&TestedClaim| !one.uses_time(case);
    let mut measures = sorted.densities.iter().filter(|one| one.is_measure()).filter(is_of_state);
    if measures.any(|one| !one.is_quadrature()) {
        return MeasureStatus::ClosedForm;
    }
    match (verdict("position-density"), verdict("analytic-density")) {
        (Verdict::Proved, _) => MeasureStatus::ByQuadrature,
        (_, Verdict::Refuted) => MeasureStatus::Excluded,
        _ if verdict("smooth-density") == Verdict::Refuted => MeasureStatus::ExcludedAtRotation,
        (Verdict::Refuted, _) => MeasureStatus::ExcludedForConfiguration,
        _ if sorted.densities.iter().filter(is_of_state).any(TestedClaim::is_measure) => {
            MeasureStatus::ByQuadrature
        }
        _ if sorted.densities.iter().any(TestedClaim::is_measure) => MeasureStatus::WithTime,
        _ if !sorted.densities.is_empty() => MeasureStatus::Singular,
        _ => MeasureStatus::NotKnown,
    }
}
