//! Numbers of relations along an orbit.

use serde::Serialize;

use super::relations::RelationStep;
use super::setting::OrbitSetting;

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
    /// Variables of the monomials, if functions are among them; those of the state otherwise.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub variables: Vec<String>,
}

impl OrbitReport {
    /// Reports the relations between a number of monomials of at most a degree.
    pub(super) fn of(
        setting: &OrbitSetting<'_>,
        degree: u32,
        monomials: usize,
        step: &RelationStep,
    ) -> Self {
        let variables = setting
            .origin
            .map(|origin| setting.terms.iter().map(|term| origin.extension.back(term)).collect());
        Self {
            degree,
            monomials,
            relations: step.relations.vectors.len(),
            integrals: step.integrals,
            variables: variables.unwrap_or_default(),
        }
    }

    /// The numbers in words, beginning with a small letter.
    pub fn sentence(&self) -> String {
        let Self { degree, monomials, relations, integrals, variables } = self;
        let among = match variables.as_slice() {
            [] => String::new(),
            names => format!(" in {}", names.join(", ")),
        };
        let who = format!("{monomials} monomials of degree at most {degree}{among}");
        if *relations == 0 {
            return format!("no relation between the {who} holds along an orbit");
        }
        let relations = match relations {
            1 => "1 relation".to_string(),
            more => format!("{more} relations"),
        };
        let integrals = match integrals {
            0 => "no algebraic integral".to_string(),
            1 => "1 algebraic integral".to_string(),
            more => format!("{more} independent algebraic integrals"),
        };
        format!("{relations} between the {who} along an orbit: {integrals}")
    }
}
