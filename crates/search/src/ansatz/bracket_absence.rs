//! Theorems of absence of a search for brackets, in words.

use super::super::{Excluded, SearchError};
use super::bracket_family::BracketFamily;
use super::scales::{Scale, Scales};
use crate::origin::TheoremOrigin;
use liouville::formula::Formula;

/// Hamiltonians and multipliers for which a family has no solution, by a proof.
pub(super) struct Absence<'f> {
    pub(super) family: &'f BracketFamily,
    pub(super) hamiltonians: Vec<String>,
    pub(super) multipliers: Vec<Scale>,
}

impl<'f> Absence<'f> {
    /// Keeps those that exclude something and are not contained in others.
    pub(super) fn strongest(mut all: Vec<Self>) -> Vec<Self> {
        all.retain(|own| !own.multipliers.is_empty());
        let is_implied: Vec<bool> =
            all.iter().map(|own| all.iter().any(|other| own.is_within(other))).collect();
        let kept = all.into_iter().zip(is_implied).filter(|(_, is_implied)| !is_implied);
        kept.map(|(own, _)| own).collect()
    }

    /// Whether another family excludes all that this one does, with the same Hamiltonians.
    fn is_within(&self, other: &Self) -> bool {
        !std::ptr::eq(self.family, other.family)
            && self.family.is_within(other.family)
            && self.multipliers.iter().all(|own| other.multipliers.contains(own))
    }

    /// Adds the Hamiltonians to those with the same family and multipliers.
    pub(super) fn join(self, all: &mut Vec<Self>) {
        let same = |other: &&mut Self| {
            std::ptr::eq(other.family, self.family) && other.multipliers == self.multipliers
        };
        match all.iter_mut().find(same) {
            Some(other) => other.hamiltonians.extend(self.hamiltonians),
            None => all.push(self),
        }
    }

    /// States the theorem; the level functions are `level`.
    pub(super) fn theorem(
        &self,
        scales: &Scales,
        level: &[Formula],
    ) -> Result<Excluded, SearchError> {
        let degree = self.family.degree;
        let mut weights = Vec::new();
        for weight in &self.family.weights {
            weights.push(weight.formula()?.to_string());
        }
        let coefficients = match weights.join(", ").as_str() {
            "1" => "numbers as coefficients".to_string(),
            weights => format!(
                "coefficients that are sums, with numbers in front that are the same for all parameters, of {weights}"
            ),
        };
        let mut multipliers = Vec::new();
        for own in &self.multipliers {
            multipliers.push(scales.formula(own)?.to_string());
        }
        let hamiltonians = match &self.hamiltonians[..] {
            [only] => format!("H = {only},"),
            all => format!("H one of {},", all.join("; ")),
        };
        let equation = match &multipliers[..] {
            [only] if only == "1" => format!("v = P ∂H, {hamiltonians}"),
            [only] => format!("v = N P ∂H, {hamiltonians} N = {only},"),
            all => format!("v = N P ∂H, {hamiltonians} N one of {},", all.join("; ")),
        };
        let casimirs: Vec<String> = level.iter().map(Formula::to_string).collect();
        let theorem = match &casimirs[..] {
            [] => format!(
                "There is no skew P with {equation} whose entries are polynomials of degree at most {degree} in the state with {coefficients}."
            ),
            all => format!(
                "There is no skew P with {equation} and P ∂F = 0 for F = {}, all on the level, whose entries are there equal to polynomials of degree at most {degree} in the state with {coefficients}.",
                all.join(", ")
            ),
        };
        Ok(Excluded {
            ansatz: format!(
                "brackets P, polynomials of degree at most {degree} in the state, with the Hamiltonian {}",
                self.hamiltonians.join(" or ")
            ),
            dimension: 0,
            known: 0,
            error_log2: None,
            theorem,
            origin: TheoremOrigin::Brackets,
            values: None,
        })
    }
}
