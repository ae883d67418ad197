//! Monomials in velocities and positions that are linearly independent on the level.
//!
//! On |γ| = 1, (ω,γ) = 0 the leading monomials of the ideal are γ₃², ω₃γ₃ and ω₃γ₂². The monomials
//! divisible by none of them are a basis: ω₃ does not occur and γ₃ at most once, or ω₃ occurs, γ₃
//! does not, and γ₂ at most once.

use crate::series::exponents;
use crate::terms::one;
use liouville::case::Case;
use liouville::formula::{Formula, FormulaResult};
use liouville::mechanics::{Chart, System, VariableRole};

/// The relations of the level, by which some monomials are redundant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ideal {
    /// No relations.
    None,
    /// γ² = 1 in the last three variables.
    Sphere,
    /// γ² = 1 and (ω,γ) = 0 in six variables.
    Rolling,
}

/// The variables of a polynomial ansatz: the components of the state.
#[derive(Clone, Debug)]
pub struct AnsatzVariables {
    /// Components of the state as formulas.
    pub terms: Vec<Formula>,
    /// Whether each of them is a velocity.
    is_velocity: Vec<bool>,
    ideal: Ideal,
}

impl AnsatzVariables {
    /// Returns the components of a case's state; `None` for a level without known standard
    /// monomials.
    pub fn of(case: &Case) -> Option<Self> {
        let model = &case.model;
        if !model.extension.is_empty() {
            return None;
        }
        let (is_velocity, ideal) = match (&model.system, &case.chart) {
            (System::Rubber(_), Chart::Rolling) => (first(3, 6), Ideal::Rolling),
            (System::Ball(_) | System::Spinning(_), Chart::Sphere) => (first(3, 6), Ideal::Sphere),
            (System::FlatBase(_), _) => (first(2, 4), Ideal::None),
            (System::Lagrangian(lagrangian), _) if model.level.is_empty() => {
                let roles = lagrangian.roles.iter().zip(&model.state);
                let own = roles.flat_map(|(role, variable)| {
                    let moves =
                        matches!(role, VariableRole::Velocity | VariableRole::Multiplier(_));
                    vec![moves; variable.len()]
                });
                (own.collect(), Ideal::None)
            }
            (system, _) if system.is_field() && model.level.is_empty() => {
                (vec![false; model.dimension()], Ideal::None)
            }
            _ => return None,
        };
        Some(Self { ideal, ..Self::divided(case, is_velocity)? })
    }

    /// Returns the components of a case's state with a given division; monomials may depend on each
    /// other on a level.
    pub fn divided(case: &Case, is_velocity: Vec<bool>) -> Option<Self> {
        let terms = case.model.state_formulas().ok()?;
        Some(Self { terms, is_velocity, ideal: Ideal::None })
    }

    /// Places of the positions.
    pub fn positions(&self) -> Vec<usize> {
        (0..self.count()).filter(|k| !self.is_velocity[*k]).collect()
    }

    /// Number of variables.
    pub fn count(&self) -> usize {
        self.terms.len()
    }

    /// Whether some variable is a velocity.
    pub fn have_velocities(&self) -> bool {
        self.is_velocity.contains(&true)
    }

    /// Lists the monomials of a degree in the velocities and of some degrees in the positions, low
    /// degrees in the positions first.
    pub fn monomials(
        &self,
        degree: u32,
        positions: std::ops::RangeInclusive<u32>,
    ) -> Vec<Vec<u32>> {
        let velocities = self.is_velocity.iter().filter(|own| **own).count();
        if velocities == 0 && degree > 0 {
            return Vec::new();
        }
        let moving = match velocities {
            0 => vec![Vec::new()],
            count => exponents(count, degree),
        };
        let mut found = Vec::new();
        for total in positions {
            for place in exponents(self.count() - velocities, total) {
                for motion in &moving {
                    let (mut w, mut q) = (motion.iter(), place.iter());
                    let exponent = |own: &bool| if *own { w.next() } else { q.next() };
                    let all: Vec<u32> =
                        self.is_velocity.iter().filter_map(exponent).copied().collect();
                    if self.is_standard(&all) {
                        found.push(all);
                    }
                }
            }
        }
        found
    }

    fn is_standard(&self, exponents: &[u32]) -> bool {
        match (self.ideal, exponents) {
            (Ideal::Sphere, [.., z]) => *z < 2,
            (Ideal::Rolling, [_, _, 0, _, _, z]) => *z < 2,
            (Ideal::Rolling, [_, _, _, _, y, z]) => *z == 0 && *y < 2,
            _ => true,
        }
    }

    /// Monomial with these exponents.
    pub fn monomial(&self, exponents: &[u32]) -> FormulaResult {
        power_product(&self.terms, exponents)
    }
}

fn first(velocities: usize, all: usize) -> Vec<bool> {
    (0..all).map(|k| k < velocities).collect()
}

/// Product of powers Π x^a; 1 for the empty product.
pub fn power_product(factors: &[Formula], exponents: &[u32]) -> FormulaResult {
    let used = factors.iter().zip(exponents).filter(|(_, exponent)| **exponent > 0);
    let mut product: Option<Formula> = None;
    for (factor, exponent) in used {
        let power = match exponent {
            1 => factor.clone(),
            2 => factor.raised(2)?,
            3 => factor.raised(3)?,
            n => factor.power(&Formula::number(i64::from(*n)))?,
        };
        product = Some(match product {
            None => power,
            Some(before) => (before * &power)?,
        });
    }
    Ok(product.unwrap_or_else(one))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variables(text: &str) -> AnsatzVariables {
        let case = Case::parse(text, &[]).expect("a case");
        AnsatzVariables::of(&case).expect("it has standard monomials")
    }

    #[test]
    fn standard_monomials_are_a_basis_on_the_level() {
        let ball = "title='x'\nsystem='rubber-plane'\n[parameters]\nm=1\nR=1\nI=[1,2,2.5]\n[body]\nshape='ball'\n";
        let variables = variables(ball);
        // Functions on the sphere up to degree e: (e + 1)²; forms linear in ω are pairs of them
        // minus the multiples of γ.
        assert_eq!(variables.monomials(0, 0..=4).len(), 25);
        assert_eq!(variables.monomials(2, 0..=4).len(), 102, "as a table of sizes has it");
        let text = |exponents| variables.monomial(exponents).expect("a product").to_string();
        assert_eq!(text(&[1, 0, 0, 2, 0, 1]), "ω1*γ1²*γ3");
        assert_eq!(text(&[0; 6]), "1");
    }
}
