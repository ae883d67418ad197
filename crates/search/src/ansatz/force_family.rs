//! Ansatz of unknown forces: how they enter the equations of motion, and the functions of which they are
//! made.

use super::coefficients::Ratio;
use super::factors;
use super::force_split::positions;
use super::forces::with_potential;
use super::monomials::AnsatzVariables;
use super::recording::Recording;
use super::system::Column;
use crate::local::Coordinates;
use crate::orbit::root_steps;
use crate::terms::{is_one, read};
use crate::{Effort, SearchError};
use liouville::case::Case;
use liouville::formula::{Formula, FormulaError};
use liouville::graph::Expr;
use liouville::mechanics::calculus::DualPoint;
use liouville::mechanics::{Model, Phase, System};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Highest degree of the numerators of forces and potentials.
const FORCE: u32 = 4;
/// Difference of the degrees of the terms added to an integral and of these.
const MORE: u32 = 2;
/// Number of unknowns above which the degrees are lowered.
const UNKNOWNS: usize = 1200;
/// Largest number of positions with denominators of two of them.
const FEW: usize = 3;

/// Form in which unknown forces enter the equations of motion.
#[derive(Debug)]
pub enum ForceEntry {
    /// By a potential: the models have an additional potential xᵢ, for each position in turn.
    Potential(Vec<Model>),
    /// As terms of the rates of some components.
    Rates(Vec<usize>),
}

/// Unknown forces that are sums of p/d with polynomials p of the positions.
#[derive(Debug)]
pub struct ForceFamily {
    /// Components of the state, of which the positions are known.
    pub variables: AnsatzVariables,
    /// Denominators d.
    pub below: Vec<Formula>,
    /// Positions whose squares are the denominators after the first.
    squares: Vec<usize>,
    /// Highest degree of p in a force.
    pub degree: u32,
    /// Highest degree of p in the terms added to an integral.
    pub gain: u32,
    /// Form in which they enter.
    pub entry: ForceEntry,
    /// Name of the positions.
    pub names: String,
}

impl ForceFamily {
    /// Chooses the forces for a case; the text is the reason why there are none.
    pub fn of(case: &Case, effort: &Effort) -> Result<Result<Self, String>, SearchError> {
        match case.model.system {
            System::FlatBase(_)
            | System::Lagrangian(_)
            | System::Hamiltonian(_)
            | System::Field(_) => {
                if !case.model.extension.is_empty() {
                    return Ok(Err("variables were added to the system".to_string()));
                }
                match positions(case, effort)? {
                    Ok(positions) => Ok(Self::of_own_system(case, &positions)?),
                    Err(reason) => Ok(Err(reason)),
                }
            }
            _ => {
                let own = Self::of_body(case);
                let reason = "the system admits none, or has one with free coefficients";
                Ok(own.ok_or_else(|| reason.to_string()))
            }
        }
    }

    fn of_body(case: &Case) -> Option<Self> {
        let vocabulary = &case.model.vocabulary;
        let axes = read(["γ1", "γ2", "γ3"], vocabulary);
        let unit: Vec<Model> = axes
            .iter()
            .map(|component| with_potential(&case.model, component))
            .collect::<Option<_>>()?;
        let below = ["1", "γ1²", "γ2²", "γ3²", "(γ,B*γ)", "(γ,J⁻¹*γ)"];
        (unit.len() == 3).then_some(())?;
        Some(Self {
            variables: AnsatzVariables::of(case)?,
            below: read(below, vocabulary),
            squares: Vec::new(),
            degree: FORCE,
            gain: FORCE + MORE,
            entry: ForceEntry::Potential(unit),
            names: "γ".to_string(),
        })
    }

    fn of_own_system(
        case: &Case,
        positions: &[usize],
    ) -> Result<Result<Self, String>, SearchError> {
        let model = &case.model;
        let is_velocity: Vec<bool> =
            (0..model.dimension()).map(|place| !positions.contains(&place)).collect();
        let Some(variables) = AnsatzVariables::divided(case, is_velocity) else {
            return Ok(Err("a component of the state has no name".to_string()));
        };
        let terms: Vec<&Formula> = positions.iter().map(|place| &variables.terms[*place]).collect();
        let entry = match model.system {
            System::Field(_) => {
                let is_other = |place: &usize| !positions.contains(place);
                ForceEntry::Rates((0..model.dimension()).filter(is_other).collect())
            }
            _ => {
                let unit = terms.iter().map(|term| with_potential(model, term));
                match unit.collect::<Option<Vec<_>>>() {
                    Some(unit) => ForceEntry::Potential(unit),
                    None => return Ok(Err("the system admits none".to_string())),
                }
            }
        };
        let below = denominators(case, &terms)?;
        let names: Vec<&str> = terms.iter().map(|term| term.text()).collect();
        let names = names.join(", ");
        let squares = positions.to_vec();
        let mut own =
            Self { variables, below, squares, degree: FORCE, gain: FORCE + MORE, entry, names };
        while own.degree > 1 && own.gains().len() + own.forces().len() > UNKNOWNS {
            (own.degree, own.gain) = (own.degree - 1, own.gain - 1);
        }
        Ok(Ok(own))
    }

    /// Coordinates in which the degree of an integral in the velocities is read.
    pub fn coordinates(&self, case: &Case) -> Coordinates {
        Coordinates::divided(case, &self.variables.positions())
    }

    /// Number of ways in which a function may act: 1 for a potential.
    pub fn ways(&self) -> usize {
        match &self.entry {
            ForceEntry::Potential(_) => 1,
            ForceEntry::Rates(components) => components.len(),
        }
    }

    fn products(&self, derivation: usize, degree: u32) -> Vec<Column> {
        let monomials = self.variables.monomials(0, 0..=degree);
        let over = |factor: usize| {
            let own = monomials.iter().cloned();
            own.map(move |exponents| Column::Product { derivation, factor, exponents })
        };
        (0..self.below.len()).flat_map(over).collect()
    }

    /// Function of a column; the square of a position under its first power is written as that position.
    pub fn written(&self, factor: usize, exponents: &[u32]) -> Result<Ratio, FormulaError> {
        let place = factor.checked_sub(1).and_then(|k| self.squares.get(k));
        if let Some(place) = place.filter(|place| exponents[**place] == 1) {
            let mut others = exponents.to_vec();
            others[*place] = 0;
            let below = Some(self.variables.terms[*place].clone());
            return Ok(Ratio { above: self.variables.monomial(&others)?, below });
        }
        let below = Some(self.below[factor].clone()).filter(|below| !is_one(below));
        Ok(Ratio { above: self.variables.monomial(exponents)?, below })
    }

    /// Columns of the terms added to an integral; the constant is the first.
    pub fn gains(&self) -> Vec<Column> {
        self.products(self.ways(), self.gain)
    }

    /// Columns of the forces, one way after another; the constant is the first of each.
    pub fn forces(&self) -> Vec<Column> {
        (0..self.ways()).flat_map(|way| self.products(way, self.degree)).collect()
    }

    /// Records what the forces do to an integral F, and derivatives along the motion.
    ///
    /// With Pᵢ = (∂F, A(∇xᵢ)) a potential U adds the derivative of U along P to L_vF, and a force Q the
    /// sum of Qᵢ ∂F/∂wᵢ.
    pub fn record(
        &self,
        integral: &Formula,
        jet: &DualPoint<'_, Expr>,
        recording: &mut Recording,
    ) -> Result<(), FormulaError> {
        let over = factors(&self.below)?;
        let (state, field) = (jet.phase.state(), jet.phase.field());
        let zero = Expr::rational(&Rational::from(0));
        let along = |direction: &[Expr]| jet.phase.lift(direction).scalar(integral).eps;
        match &self.entry {
            ForceEntry::Potential(unit) => {
                let mut direction = vec![zero; state.len()];
                for (place, model) in self.variables.positions().into_iter().zip(unit) {
                    let beside: Phase<'_, _> = jet.phase.in_model(model, &state);
                    let moved = beside.field().iter().zip(field);
                    let own: Vec<_> = moved.map(|(with, without)| *with - *without).collect();
                    direction[place] = along(&own);
                }
                recording.derive(&jet.phase.lift(&direction), &self.variables.terms, &over);
            }
            ForceEntry::Rates(components) => {
                for component in components {
                    let mut direction = vec![zero; state.len()];
                    direction[*component] = Expr::rational(&Rational::from(1));
                    let slope = along(&direction);
                    recording.multiply(&jet.phase, &self.variables.terms, &over, slope);
                }
            }
        }
        recording.derive(jet.along_field(), &self.variables.terms, &over);
        Ok(())
    }
}

/// Denominators of functions of some positions: their squares, the sum of these with its root, and the
/// squares of differences.
fn denominators(case: &Case, terms: &[&Formula]) -> Result<Vec<Formula>, SearchError> {
    let mut found = vec![Formula::number(1)];
    for term in terms {
        found.push(term.raised(2)?);
    }
    let squares: Vec<Formula> = found[1..].to_vec();
    let sum = squares.iter().skip(1).try_fold(squares[0].clone(), |sum, own| sum + own)?;
    if terms.len() > 1 {
        found.push(sum.bracketed());
        // A root beside those of the field may depend on them.
        if root_steps(case)? == 0 {
            found.push(sum.sqrt()?);
        }
    }
    if terms.len() <= FEW {
        for (k, first) in terms.iter().enumerate() {
            for second in &terms[k + 1..] {
                found.push((*first - *second)?.bracketed().raised(2)?);
            }
        }
    }
    Ok(found)
}
