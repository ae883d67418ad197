//! Equations of a Lagrangian system as polynomials, and their solution.
//!
//! With M w' = d + aᵀμ, a w' = −e and constraints a w + b = 0 that are solved for as many velocities,
//! w = S u + s, S = (1, −a_D⁻¹a_I): a S = 0, and so u' = adj(G) Sᵀ(d − M c)/det G, G = SᵀM S, where
//! c = (0, −a_D⁻¹e) is the part of w' that the constraints give. There is one denominator, det G,
//! instead of one for each step of an elimination.

use liouville::graph::{Expr, Graph};
use liouville::mechanics::LagrangianEquations;
use liouville::number::rational::Rational;

use super::matrices::Rows;
use super::polynomial::RingPolynomial;
use super::read::StepReader;
use super::reduction::{Reduction, substituted};
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
        let (one, minus) = (Rational::from(1), Rational::from(-1));
        let is_velocity = |own: &RingPolynomial| {
            own.variables().iter().any(|variable| velocities.contains(variable))
        };
        if self.slopes.iter().flatten().any(is_velocity) {
            return None;
        }
        let reduction = Reduction::of(&ring.atoms, false);
        let (dependent, determinant) = self.pivots(velocities.len(), &reduction)?;
        let is_whole = determinant.value().is_some();
        let independent: Vec<usize> =
            (0..velocities.len()).filter(|i| !dependent.contains(i)).collect();
        let columns = |places: &[usize]| -> Rows {
            let row = |row: &Vec<RingPolynomial>| places.iter().map(|i| row[*i].clone()).collect();
            self.slopes.iter().map(row).collect()
        };
        let inverse = ring.inverse(&determinant)?;
        let reduction = Reduction::of(&ring.atoms, false);
        let adjugate = reduction.adjugate(&columns(&dependent))?;
        // −a_D⁻¹ of a vector.
        let given = |side: &[RingPolynomial]| -> Option<Vec<RingPolynomial>> {
            let entry = |row: &Vec<RingPolynomial>| {
                let own = reduction.product(&reduction.dot(row, side)?, &inverse)?;
                Some(own.times_number(&minus))
            };
            adjugate.iter().map(entry).collect()
        };
        let zero = RingPolynomial::default();
        let at_rest: Vec<(usize, RingPolynomial)> =
            velocities.iter().map(|w| (*w, zero.clone())).collect();
        let rest: Option<Vec<_>> =
            self.constraints.iter().map(|own| substituted(own, &at_rest)).collect();
        let shift = given(&rest?)?;
        // By independent velocity, the dependent velocities.
        let images: Option<Rows> = independent
            .iter()
            .map(|i| given(&self.slopes.iter().map(|row| row[*i].clone()).collect::<Vec<_>>()))
            .collect();
        let images = images?;
        let mut replaced = Vec::new();
        for (k, place) in dependent.iter().enumerate() {
            let mut sum = shift[k].clone();
            for (i, image) in independent.iter().zip(&images) {
                let own = RingPolynomial::variable(velocities[*i], 1);
                sum = sum.plus(&image[k].times(&own)?, &one)?;
            }
            replaced.push((velocities[*place], reduction.reduced(&sum)?));
        }
        let on_level = |own: &RingPolynomial| reduction.reduced(&substituted(own, &replaced)?);
        let all = |own: &[RingPolynomial]| -> Option<Vec<RingPolynomial>> {
            own.iter().map(on_level).collect()
        };
        let accelerations = given(&all(&self.carried)?)?;
        let drive = all(&self.drive)?;
        // Columns of S, and M S, M c.
        let spread = |own: Option<usize>, others: &[RingPolynomial]| -> Vec<RingPolynomial> {
            let mut all = vec![zero.clone(); velocities.len()];
            if let Some(i) = own {
                all[i] = RingPolynomial::constant(one.clone());
            }
            dependent.iter().zip(others).for_each(|(place, own)| all[*place] = own.clone());
            all
        };
        let directions: Rows =
            independent.iter().zip(&images).map(|(i, own)| spread(Some(*i), own)).collect();
        // The masses of an L that is not quadratic contain velocities.
        let mass = self.mass.iter().map(|row| all(row)).collect::<Option<Rows>>()?;
        let times_mass = |own: &[RingPolynomial]| -> Option<Vec<RingPolynomial>> {
            mass.iter().map(|row| reduction.dot(row, own)).collect()
        };
        let moved: Option<Rows> = directions.iter().map(|own| times_mass(own)).collect();
        let moved = moved?;
        let gram: Option<Rows> = directions
            .iter()
            .map(|a| moved.iter().map(|b| reduction.dot(a, b)).collect::<Option<Vec<_>>>())
            .collect();
        let gram = gram?;
        let carried = times_mass(&spread(None, &accelerations))?;
        let free: Option<Vec<RingPolynomial>> =
            drive.iter().zip(&carried).map(|(a, b)| a.plus(b, &minus)).collect();
        let free = free?;
        let sides: Option<Vec<_>> =
            directions.iter().map(|own| reduction.dot(own, &free)).collect();
        let solved = Quotients::of(&gram, &sides?, ring)?;
        let mut rates = Vec::new();
        let parameters = ring.atoms.iter().position(|atom| matches!(atom, Atom::State))?;
        for (place, rate) in self.drift.iter().enumerate() {
            match velocities.iter().position(|w| *w == parameters + place) {
                None => rates.push((place, on_level(rate)?)),
                Some(w) => {
                    let Some(own) = independent.iter().position(|i| *i == w) else { continue };
                    rates.push((place, solved.0[own].clone()));
                }
            }
        }
        Some(SolvedMotion { rates, level: all(&self.others)?, is_whole })
    }

    /// Velocities for which the constraints are solved, with the determinant of their slopes: a number if
    /// possible, otherwise that with fewest terms.
    fn pivots(
        &self,
        velocities: usize,
        reduction: &Reduction,
    ) -> Option<(Vec<usize>, RingPolynomial)> {
        let count = self.slopes.len();
        let mut best: Option<(Vec<usize>, RingPolynomial)> = None;
        let mut chosen: Vec<usize> = (0..count).collect();
        loop {
            let rows = self.slopes.iter();
            let square: Rows =
                rows.map(|row| chosen.iter().map(|i| row[*i].clone()).collect()).collect();
            let determinant = reduction.determinant(&square)?;
            if determinant.value().is_some_and(|value| !value.is_zero()) {
                return Some((chosen, determinant));
            }
            let terms = determinant.terms().count();
            if terms > 0 && best.as_ref().is_none_or(|(_, own)| terms < own.terms().count()) {
                best = Some((chosen.clone(), determinant));
            }
            // The next combination, the last places first.
            let Some(place) = (0..count).rev().find(|k| chosen[*k] < velocities - count + k) else {
                return best;
            };
            chosen[place] += 1;
            (place + 1..count).for_each(|k| chosen[k] = chosen[k - 1] + 1);
        }
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
