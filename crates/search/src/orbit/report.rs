//! Numbers of relations along an orbit.

use serde::Serialize;

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

impl OrbitReport {
    /// The numbers in words, beginning with a small letter.
    pub fn sentence(&self) -> String {
        let Self { degree, monomials, relations, integrals } = self;
        let who = format!("{monomials} monomials of degree at most {degree}");
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
