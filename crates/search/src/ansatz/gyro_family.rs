//! Ansatz of rotors and gyroscopic terms: how they enter the equations of motion, and of which functions
//! they are made.
//!
//! ```text
//! body, flat base      a rotor S
//! Hamilton, Lagrange   a term Σ f_i w_i of H or L in the momenta or velocities w_i
//! field x' = u         forces b u_j in the rate of u_i and −b u_i in that of u_j, for i < j
//! ```
//!
//! The part of the field that a term f g adds, for a generator g and a function f of the positions, is
//! f D(1) + Σ ∂_kf (D(q_k) − q_k D(1)), where D(f) is the part that f g adds.

use super::factors;
use super::forces::{with_gyrostat, with_potential};
use super::gyro_split::{GyroSplit, split};
use super::monomials::AnsatzVariables;
use super::recording::Recording;
use super::system::Column;
use crate::orbit::root_steps;
use crate::terms::{one, read};
use crate::{Effort, SearchError};
use liouville::case::Case;
use liouville::formula::{Formula, FormulaError};
use liouville::graph::Expr;
use liouville::mechanics::calculus::DualPoint;
use liouville::mechanics::{Model, System};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Number of terms added to an integral above which their degrees are lowered.
const UNKNOWNS: usize = 1000;
/// Difference of the degrees of the terms added to an integral and of the coefficients.
const MORE: u32 = 3;
/// Largest number of positions with denominators.
const FEW: usize = 3;

/// Form in which rotors and gyroscopic terms enter the equations of motion.
#[derive(Debug)]
pub enum GyroEntry {
    /// As a rotor of a body.
    Rotor,
    /// As a term of the function that the equations are made of.
    Term,
    /// As forces in the rates of pairs of velocities.
    Pairs(Vec<[usize; 2]>),
}

/// Models with one generator.
#[derive(Debug)]
struct Generator {
    unit: Model,
    /// Models with a position times the generator, for each position; none where the force depends on
    /// values of the coefficient only.
    moved: Vec<Model>,
}

/// Parts of the field that generators add at a point.
pub struct Shift {
    unit: Vec<Expr>,
    /// D(q_k) − q_k D(1) for each position.
    slopes: Vec<Vec<Expr>>,
}

/// Rotors or gyroscopic terms, and the terms that they add to an integral.
#[derive(Debug)]
pub struct GyroFamily {
    /// Components of the state, divided.
    pub variables: AnsatzVariables,
    /// Denominators of the terms added to an integral.
    pub below: Vec<Formula>,
    /// Form in which they enter.
    pub entry: GyroEntry,
    /// Functions that are multiplied by coefficients.
    pub heads: Vec<Formula>,
    generators: Vec<Generator>,
    /// Number of denominators of a coefficient: the first ones.
    over: usize,
    /// Highest degree of a coefficient's numerator.
    pub degree: u32,
    /// Highest degree of the numerators of terms of first order.
    pub gain: u32,
    /// Models with an additional potential q_k, where a potential of second order is allowed.
    pub potentials: Vec<Model>,
    /// Whether a potential acts on what a change of the momenta by a gradient makes.
    pub is_canonical: bool,
}

impl GyroFamily {
    /// Chooses the terms for a case; the text is the reason why there are none.
    pub fn of(case: &Case, effort: &Effort) -> Result<Result<Self, String>, SearchError> {
        if Self::is_own(&case.model) {
            return match split(case, effort)? {
                Ok(split) => Self::of_own_system(case, &split),
                Err(reason) => Ok(Err(reason)),
            };
        }
        let mut own = Vec::new();
        for axis in 0..3 {
            let unit = [0, 1, 2].map(|k| Formula::number(i64::from(k == axis)));
            let axis = Formula::vector(&unit.each_ref())?;
            own.extend(with_gyrostat(&case.model, &axis));
        }
        let variables = AnsatzVariables::of(case).filter(|_| own.len() == 3);
        let below = read(["1", "(γ,B*γ)", "(γ,J⁻¹*γ)"], &case.model.vocabulary);
        Ok(variables.map_or_else(
            || Err("the system admits none, or has one".to_string()),
            |variables| {
                let unit = |unit| Generator { unit, moved: Vec::new() };
                Ok(Self {
                    variables,
                    below,
                    entry: GyroEntry::Rotor,
                    heads: Vec::new(),
                    generators: own.into_iter().map(unit).collect(),
                    over: 1,
                    degree: 0,
                    gain: effort.ansatz.positions,
                    potentials: Vec::new(),
                    is_canonical: false,
                })
            },
        ))
    }

    /// Whether a system takes gyroscopic terms, in place of a rotor.
    pub fn is_own(model: &Model) -> bool {
        model.system.is_field() || matches!(model.system, System::Lagrangian(_))
    }

    fn of_own_system(case: &Case, split: &GyroSplit) -> Result<Result<Self, String>, SearchError> {
        let model = &case.model;
        let GyroSplit { positions, velocities, has_functions } = split;
        let is_velocity = (0..model.dimension()).map(|place| !positions.contains(&place));
        let Some(variables) = AnsatzVariables::divided(case, is_velocity.collect()) else {
            return Ok(Err("a component of the state has no name".to_string()));
        };
        let term = |place: &usize| variables.terms[*place].clone();
        let own: Vec<Formula> = positions.iter().map(term).collect();
        let heads: Vec<Formula> = velocities.iter().map(term).collect();
        let mut below = vec![one()];
        if let (true, 2..=FEW) = (*has_functions, own.len()) {
            let mut squares =
                own.iter().map(|term| term.raised(2)).collect::<Result<Vec<_>, _>>()?;
            let last = squares.remove(0);
            let sum = squares.iter().try_fold(last, |sum, own| &sum + own)?;
            below.push(sum.bracketed());
            // A root beside those of the field may depend on them.
            if root_steps(case)? == 0 {
                let root = sum.sqrt()?;
                below.push(root.clone());
                below.push((sum.bracketed() * &root)?);
            }
        }
        let (entry, over) = match model.system {
            System::Field(_) => {
                let count = velocities.len();
                let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j]));
                (GyroEntry::Pairs(pairs.collect()), below.len())
            }
            _ => (GyroEntry::Term, 1),
        };
        let degree = match (has_functions, positions.len()) {
            (false, _) => 0,
            (true, 0..=2) => 3,
            (true, 3) => 2,
            (true, _) => 1,
        };
        let is_canonical = *has_functions && matches!(model.system, System::Hamiltonian(_));
        let mut made = Self {
            variables,
            below,
            entry,
            heads,
            generators: Vec::new(),
            over,
            degree,
            gain: degree.max(1) + MORE,
            potentials: Vec::new(),
            is_canonical,
        };
        let reason = || Ok(Err("the system admits none".to_string()));
        for generator in 0..made.count() {
            let unit = made.with_product(case, generator, &one())?;
            let with_functions = degree > 0 && matches!(made.entry, GyroEntry::Term);
            let moved: &[Formula] = if with_functions { &own } else { &[] };
            let moved = moved.iter().map(|term| made.with_product(case, generator, term));
            let moved = moved.collect::<Result<Option<Vec<Model>>, FormulaError>>()?;
            let (Some(unit), Some(moved)) = (unit, moved) else { return reason() };
            made.generators.push(Generator { unit, moved });
        }
        if degree > 0 && matches!(made.entry, GyroEntry::Term) {
            made.potentials.extend(own.iter().filter_map(|term| with_potential(model, term)));
            if made.potentials.len() != own.len() {
                return reason();
            }
        }
        while made.gain > 1 && made.gains(1).len() > UNKNOWNS {
            made.gain -= 1;
        }
        Ok(Ok(made))
    }

    /// Number of generators.
    pub fn count(&self) -> usize {
        match &self.entry {
            GyroEntry::Rotor => self.generators.len(),
            GyroEntry::Term => self.heads.len(),
            GyroEntry::Pairs(pairs) => pairs.len(),
        }
    }

    fn with_product(
        &self,
        case: &Case,
        generator: usize,
        function: &Formula,
    ) -> Result<Option<Model>, FormulaError> {
        let mut parts = vec![None; self.count()];
        parts[generator] = Some((false, function.clone()));
        Ok(self.with(&case.model, &self.slots(&parts)?))
    }

    fn products(&self, derivation: usize, degree: u32, highest: u32, over: usize) -> Vec<Column> {
        let monomials = self.variables.monomials(degree, 0..=highest);
        (0..over)
            .flat_map(|factor| {
                let own = monomials.iter().cloned();
                own.map(move |exponents| Column::Product { derivation, factor, exponents })
            })
            .collect()
    }

    /// Columns of the terms of first order that are added to an integral whose terms have at most
    /// this degree in the velocities less one, by the direction after the generators'.
    pub fn gains(&self, degree: u32) -> Vec<Column> {
        let lowest = if Self::is_rotor(&self.entry) { degree } else { 0 };
        let all = (lowest..=degree)
            .flat_map(|own| self.products(self.generators.len(), own, self.gain, self.below.len()));
        all.collect()
    }

    /// Columns of the functions of the positions of second order, by direction 0; the constant is the
    /// first.
    pub fn second_gains(&self) -> Vec<Column> {
        let highest = self.gain + if Self::is_rotor(&self.entry) { 0 } else { self.degree };
        self.products(0, 0, highest, self.below.len())
    }

    /// Columns of the potentials of second order, by direction 1, without a constant.
    pub fn second_potentials(&self) -> Vec<Column> {
        let own = self.products(1, 0, 2 * self.degree, 1);
        if self.potentials.is_empty() { Vec::new() } else { own.into_iter().skip(1).collect() }
    }

    fn is_rotor(entry: &GyroEntry) -> bool {
        matches!(entry, GyroEntry::Rotor)
    }

    /// Columns of all coefficients, generator by generator.
    pub fn coefficients(&self) -> Vec<Column> {
        let count = self.generators.len();
        (0..count).flat_map(|own| self.products(own, 0, self.degree, self.over)).collect()
    }

    /// Part of the field that each generator adds.
    pub fn shifts(&self, jet: &DualPoint<'_, Expr>) -> Vec<Shift> {
        let (state, field) = (jet.phase.state(), jet.phase.field());
        let shift = |model: &Model| -> Vec<Expr> {
            let beside = jet.phase.in_model(model, &state);
            beside.field().iter().zip(field).map(|(with, without)| *with - *without).collect()
        };
        let positions = self.variables.positions();
        let of = |own: &Generator| {
            let unit = shift(&own.unit);
            let slope = |(place, model): (&usize, &Model)| {
                let moved = shift(model).into_iter().zip(&unit);
                moved.map(|(moved, unit)| moved - state[*place] * *unit).collect()
            };
            let slopes = positions.iter().zip(&own.moved).map(slope).collect();
            Shift { unit, slopes }
        };
        self.generators.iter().map(of).collect()
    }

    /// Records what products of functions and generators do to a quantity that changes by `along` where
    /// the state moves: one direction for each generator.
    pub fn record(
        &self,
        shifts: &[Shift],
        jet: &DualPoint<'_, Expr>,
        recording: &mut Recording,
        along: &dyn Fn(&[Expr]) -> Expr,
    ) -> Result<(), FormulaError> {
        let over = factors(&self.below[..self.over])?;
        let zero = Expr::rational(&Rational::from(0));
        for shift in shifts {
            let mut direction = vec![zero; jet.phase.state().len()];
            for (place, slope) in self.variables.positions().into_iter().zip(&shift.slopes) {
                direction[place] = along(slope);
            }
            let moved = jet.phase.lift(&direction);
            let growth = along(&shift.unit);
            recording.derive_growing_over(&moved, (&self.variables.terms, &over), growth);
        }
        Ok(())
    }
}
