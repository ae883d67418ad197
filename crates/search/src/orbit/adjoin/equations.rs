//! Equations of a Lagrangian system as polynomials, and their solution.
//!
//! With M w' = d + aᵀμ, a w' = −e and constraints a w + b = 0 that are solved for as many velocities,
//! w = S u + s, S = (1, −a_D⁻¹a_I): a S = 0, and so u' = adj(G) Sᵀ(d − M c)/det G, G = SᵀM S, where
//! c = (0, −a_D⁻¹e) is the part of w' that the constraints give. There is one denominator, det G,
//! instead of one for each step of an elimination.

use liouville::graph::{Expr, Graph};
use liouville::mechanics::LagrangianEquations;
use liouville::number::rational::Rational;

use super::constrained::ConstrainedVelocities;
use super::matrices::Rows;
use super::polynomial::RingPolynomial;
use super::read::StepReader;
use super::reduction::Reduction;
use super::ring::{AdjoinedRing, Atom};

/// Equations as polynomials of a ring.
pub struct ReadEquations {
    mass: Rows,
    drive: Vec<RingPolynomial>,
    slopes: Rows,
    carried: Vec<RingPolynomial>,
    /// Rates of the coordinates.
    drift: Vec<RingPolynomial>,
    /// Values of the constraints.
    constraints: Vec<RingPolynomial>,
    /// Other functions that are 0 on the level.
    others: Vec<RingPolynomial>,
}

/// Rates of the remaining components.
pub struct SolvedMotion {
    /// Components of the state that are not given by the constraints, with their rates.
    pub rates: Vec<(usize, RingPolynomial)>,
    /// Functions that are 0 on the level.
    pub level: Vec<RingPolynomial>,
    /// Whether the constraints are solved for at all positions.
    pub is_whole: bool,
}

impl ReadEquations {
    /// Reads the equations, the constraints, and the functions that are 0 on the level.
    pub fn of(
        graph: &Graph,
        equations: &LagrangianEquations<Expr>,
        [constraints, level]: [&Vec<Expr>; 2],
        ring: &mut AdjoinedRing,
    ) -> Option<Self> {
        let mut reader = StepReader::new(graph);
        let mut each = |own: &[Expr]| -> Option<Vec<RingPolynomial>> {
            own.iter().map(|own| reader.read(graph.place(*own), ring)).collect()
        };
        let constraints = each(constraints)?;
        let mut others = each(level)?;
        others.retain(|own| !constraints.contains(own));
        Some(Self {
            mass: equations.terms.mass.iter().map(|row| each(row)).collect::<Option<_>>()?,
            drive: each(&equations.terms.drive)?,
            slopes: equations.terms.slopes.iter().map(|row| each(row)).collect::<Option<_>>()?,
            carried: each(&equations.carried)?,
            drift: each(&equations.drift)?,
            constraints,
            others,
        })
    }

    /// Solves for the rates of positions and independent velocities; `velocities` are their variables.
    pub fn solved(&self, velocities: &[usize], ring: &mut AdjoinedRing) -> Option<SolvedMotion> {
        let constrained =
            ConstrainedVelocities::of(&self.slopes, &self.constraints, velocities, ring)?;
        let accelerations = self.accelerations(&constrained, ring)?;
        let parameters = ring.atoms.iter().position(|atom| matches!(atom, Atom::State))?;
        let mut rates = Vec::new();
        for (place, rate) in self.drift.iter().enumerate() {
            match velocities.iter().position(|w| *w == parameters + place) {
                None => rates.push((place, constrained.on_level(rate)?)),
                Some(w) => {
                    let own = constrained.independent.iter().position(|i| *i == w);
                    rates.extend(own.map(|own| (place, accelerations[own].clone())));
                }
            }
        }
        let level = constrained.all_on_level(&self.others)?;
        Some(SolvedMotion { rates, level, is_whole: constrained.is_whole })
    }

    /// Rates of the independent velocities: G u' = Sᵀ(d − M c).
    fn accelerations(
        &self,
        constrained: &ConstrainedVelocities,
        ring: &mut AdjoinedRing,
    ) -> Option<Vec<RingPolynomial>> {
        let reduction = &constrained.reduction;
        // The masses of an L that is not quadratic contain velocities.
        let mass: Option<Rows> =
            self.mass.iter().map(|row| constrained.all_on_level(row)).collect();
        let mass = mass?;
        let times_mass = |own: &[RingPolynomial]| -> Option<Vec<RingPolynomial>> {
            mass.iter().map(|row| reduction.dot(row, own)).collect()
        };
        let directions = constrained.directions();
        let moved: Option<Rows> = directions.iter().map(|own| times_mass(own)).collect();
        let moved = moved?;
        let gram: Option<Rows> = directions
            .iter()
            .map(|a| moved.iter().map(|b| reduction.dot(a, b)).collect())
            .collect();
        let given = constrained.given(&constrained.all_on_level(&self.carried)?)?;
        let carried = times_mass(&constrained.spread(None, &given))?;
        let drive = constrained.all_on_level(&self.drive)?;
        let minus = Rational::from(-1);
        let free: Option<Vec<RingPolynomial>> =
            drive.iter().zip(&carried).map(|(a, b)| a.plus(b, &minus)).collect();
        let free = free?;
        let sides: Option<Vec<RingPolynomial>> =
            directions.iter().map(|own| reduction.dot(own, &free)).collect();
        Some(Quotients::of(&gram?, &sides?, ring)?.0)
    }
}

/// Solution of linear equations over one denominator.
struct Quotients(Vec<RingPolynomial>);

impl Quotients {
    fn of(rows: &Rows, sides: &[RingPolynomial], ring: &mut AdjoinedRing) -> Option<Self> {
        let reduction = Reduction::of(&ring.atoms, false);
        let adjugate = reduction.adjugate(rows)?;
        let numerators: Option<Vec<RingPolynomial>> =
            adjugate.iter().map(|row| reduction.dot(row, sides)).collect();
        let numerators = numerators?;
        let of_sines = Reduction::of(&ring.atoms, true);
        let determinant = reduction.determinant(rows)?;
        // sin² θ is one factor, 1 − cos² θ are two terms.
        let other = of_sines.reduced(&determinant)?;
        let is_shorter = other.terms().count() < determinant.terms().count();
        let determinant = if is_shorter { other } else { determinant };
        let (value, monomial, rest) = determinant.split()?;
        let inverse = value.recip()?;
        let mut made = Vec::new();
        for own in numerators {
            let own = match is_shorter {
                true => of_sines.reduced(&own)?,
                false => own,
            };
            let Some((_, common, _)) = own.split() else {
                made.push(own);
                continue;
            };
            // What is common above and below.
            let shared: Vec<(usize, u32)> = monomial
                .iter()
                .filter_map(|(variable, power)| {
                    let above = common.iter().find(|(own, _)| own == variable)?.1;
                    Some((*variable, above.min(*power)))
                })
                .collect();
            let shared = RingPolynomial::term(shared, Rational::from(1));
            let mut above = own.over(&shared)?.times_number(&inverse);
            let below = RingPolynomial::term(monomial.clone(), Rational::from(1)).over(&shared)?;
            let below = match above.over(&rest) {
                Some(quotient) => {
                    above = quotient;
                    below
                }
                None => below.times(&rest)?,
            };
            let below = ring.inverse(&below)?;
            made.push(Reduction::of(&ring.atoms, is_shorter).product(&above, &below)?);
        }
        Some(Self(made))
    }
}
