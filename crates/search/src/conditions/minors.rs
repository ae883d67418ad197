//! Values of one parameter for which there are more integrals than in general.
//!
//! The equations for the Taylor coefficients of an integral have a minor that is not 0 in general.
//! As a function of one parameter it is a fraction; a value with more integrals makes every such
//! minor vanish, so it is a root of the common divisor of minors at several points. All such values
//! are found, including complex ones; those in the field are confirmed by a count.

use std::cell::Cell;

use rustc_hash::FxHashSet;

use super::relation::{Explained, Round, ScalarParameter, equation, explained};
use crate::budget::Budget;
use crate::echelon::Echelon;
use crate::expansion::{FieldExpansion, Taylor};
use crate::jet_equations::{Equations, RowKey};
use crate::jets::VelocityPolynomials;
use crate::local::Local;
use crate::orbit::monomials;
use crate::streams::SearchStream;
use crate::{Effort, Halt, SearchError};
use liouville::case::Case;
use liouville::mechanics::{Draw, ParameterOrigin, SamplerSpec};
use liouville::number::prime::{Modulus, Polynomial, PrimePolynomials};
use liouville::proof::{ProofRng, root_numbers};

/// Number of points whose minors are compared.
const MINOR_POINTS: usize = 2;
/// Smallest number of values of a minor, followed by the largest.
const LEAST: usize = 64;
const MOST_MINORS: usize = 2048;
/// Elementary steps of a multiplication modulo a prime and what belongs to it.
const STEP: f64 = 3.0;
/// Share of the values of a field that depend on the velocities, roughly.
const MOVING: f64 = 0.3;
/// Number of draws of a point, or of a value, until the field has a series there.
const DRAWS: usize = 64;
/// Number of choices of the other parameters under which a relation must persist.
pub const ROUNDS: u64 = 2;
/// Number of small integers from which they are chosen.
const SMALL: u64 = 97;
/// Number of primes that are tried for a single parameter, until all values lie in the field.
const PRIMES: u64 = 8;

/// Smallest number of values of a parameter at which equations are set up.
pub fn least_values(rounds: u64) -> usize {
    rounds as usize * MINOR_POINTS * LEAST
}

/// Lists the scalar parameters drawn from a range.
pub fn scalars(case: &Case) -> Vec<ScalarParameter> {
    let mut draw = 0;
    let mut found = Vec::new();
    for parameter in &case.model.parameters {
        let ParameterOrigin::Free(recipe) = &parameter.origin else { continue };
        if matches!(recipe, SamplerSpec::Scalar(Draw::Within(_) | Draw::Of(..))) {
            found.push(ScalarParameter { name: parameter.name.clone(), draw });
        }
        draw += recipe.draws().len();
    }
    found
}

/// Special values of a parameter.
pub struct SpecialValues {
    /// Numbers, and relations to one other parameter.
    pub explained: Explained,
    /// The equation of further numbers.
    pub equation: Option<String>,
    /// Number of further values, none of which is real.
    pub complex: usize,
    /// Number of roots of minors outside of the prime field, at which nothing is counted.
    pub open: usize,
}

/// Finds the relations under which there are more integrals of a degree, for one parameter; the
/// others are random small integers, chosen a number of times. The steps taken are subtracted from those
/// that are left, and it fails when none are.
pub fn relations(
    case: &Case,
    local: &Local,
    asked: VelocityPolynomials,
    parameter: &ScalarParameter,
    (count, left): (u64, &Cell<f64>),
    effort: &Effort,
) -> Result<SpecialValues, SearchError> {
    let mut rounds: Vec<Round> = Vec::new();
    let mut open = 0;
    let primes = if count > 1 { count } else { PRIMES };
    for round in 0..primes {
        let mut search = Minors::new(local, asked, parameter.draw, round, effort);
        search.left = Some(left);
        let (values, outside) = match search.special_values() {
            // Further primes only add to what one has shown.
            Err(SearchError::Long { .. }) if count == 1 && round > 0 => break,
            other => other?,
        };
        let (parameters, modulus) = (search.parameters.clone(), search.modulus);
        let own = Round { values, parameters, modulus };
        if count > 1 {
            rounds.push(own);
            open = open.max(outside);
        } else if round == 0 || outside < open {
            (rounds, open) = (vec![own], outside);
        }
        if count == 1 && open == 0 {
            break;
        }
    }
    let mut found = SpecialValues {
        explained: explained(parameter, &scalars(case), &rounds),
        equation: None,
        complex: 0,
        open,
    };
    if let ([only], 1..) = (rounds.as_slice(), found.explained.unexplained)
        && let Some(text) = equation(&parameter.name, only, &[only.modulus.one()])
    {
        if text.is_none() {
            found.complex = found.explained.unexplained;
        }
        found.equation = text;
        found.explained.unexplained = 0;
    }
    Ok(found)
}

/// Minors as functions of one draw of the parameters.
struct Minors<'l> {
    taylor: Taylor<'l>,
    effort: &'l Effort,
    asked: VelocityPolynomials,
    draw: usize,
    parameters: Vec<u64>,
    modulus: Modulus,
    rng: ProofRng,
    /// Number of elementary steps that may still be taken, if limited.
    left: Option<&'l Cell<f64>>,
}

impl<'l> Minors<'l> {
    fn new(
        local: &'l Local,
        asked: VelocityPolynomials,
        draw: usize,
        round: u64,
        effort: &'l Effort,
    ) -> Self {
        let mut rng = SearchStream::Minors.under(effort.options.seed.wrapping_add(round));
        let modulus = rng.prime_for(&root_numbers(&local.graph));
        // Others in each round: a relation to one of them would persist.
        let small = |rng: &mut ProofRng| {
            2 + SMALL * (round % ROUNDS) + modulus.to_integer(rng.element(&modulus)) % SMALL
        };
        let parameters = local.parameters(&modulus, &mut rng);
        let parameters = parameters
            .into_iter()
            .zip(&local.draws)
            .map(|(listed, draw)| match draw {
                Draw::OneOf(_) => listed,
                Draw::Sign => modulus.one(),
                Draw::Within(_) | Draw::Of(..) => modulus.integer(small(&mut rng)),
            })
            .collect();
        let taylor = Taylor::new(local, modulus, 2 * asked.degree + 2);
        Self { taylor, effort, asked, draw, parameters, modulus, rng, left: None }
    }

    /// Sets up the equations at a value of the parameter; `None` where the field has no series.
    fn equations(
        &mut self,
        value: u64,
        positions: &[u64],
    ) -> Result<Option<Equations>, SearchError> {
        let mut parameters = self.parameters.clone();
        parameters[self.draw] = value;
        self.spend(0, self.expansion_steps())?;
        let expansion = self.taylor.at(&parameters, positions, &mut self.rng)?;
        let (taylor, halt) = (&self.taylor, &self.effort.halt);
        let made = |e: FieldExpansion| Equations::of(&e, taylor, taylor.order, self.asked, 0, halt);
        let made = expansion.map(made).transpose()?;
        if let Some(made) = &made {
            let (unknowns, equations) = made.size();
            self.spend(unknowns, STEP * (unknowns * equations) as f64)?;
        }
        Ok(made)
    }

    /// Number of elementary steps for the series of the field: those of the values that depend on the
    /// velocities are computed for each of the points from which their coefficients are read.
    fn expansion_steps(&self) -> f64 {
        let Local { graph, coordinates, .. } = self.taylor.local;
        let products = monomials::count(2 * coordinates.positions, self.taylor.order);
        let points = (coordinates.velocities + 1) * (coordinates.velocities + 2) / 2;
        STEP * (graph.len() * products) as f64 * (1.0 + MOVING * points as f64)
    }

    /// Fails where more steps are taken than are left.
    fn spend(&self, unknowns: usize, steps: f64) -> Result<(), SearchError> {
        let Some(left) = self.left else { return Ok(()) };
        left.set(left.get() - steps);
        match left.get() < 0.0 {
            true => Err(SearchError::Long { unknowns, seconds: self.effort.seconds }),
            false => Ok(()),
        }
    }

    /// Brings equations into echelon form.
    fn solved(&self, equations: &Equations) -> Result<(Echelon, Vec<RowKey>), SearchError> {
        let solved = equations.solved(&Budget::unlimited(&self.effort.halt))?;
        self.spend(equations.size().0, solved.0.steps() as f64)?;
        Ok(solved)
    }

    /// Finds the values at which there are more integrals, and the number of further roots of minors
    /// outside of the prime field.
    fn special_values(&mut self) -> Result<(Vec<u64>, usize), SearchError> {
        let ring = PrimePolynomials(self.modulus);
        let mut common: Polynomial = Vec::new();
        let mut dimension = usize::MAX;
        for _ in 0..MINOR_POINTS {
            let (numerator, own) = self.minor()?;
            common = ring.common(&common, &numerator);
            dimension = dimension.min(own);
        }
        let candidates = ring.roots(&common);
        let distinct = ring.square_free(&common).len().saturating_sub(1);
        let outside = distinct.saturating_sub(candidates.len());
        let mut found = Vec::new();
        for value in candidates {
            for _ in 0..DRAWS {
                self.effort.halt.check()?;
                let positions = self.taylor.positions(&mut self.rng);
                let own = match self.equations(value, &positions) {
                    Err(error @ (SearchError::Stopped | SearchError::Long { .. })) => {
                        return Err(error);
                    }
                    own => own,
                };
                let Ok(Some(equations)) = own else { continue };
                let own = equations.dimension(&self.solved(&equations)?.0);
                if own.is_none_or(|own| own > dimension) {
                    found.push(value);
                }
                break;
            }
        }
        Ok((found, outside))
    }

    /// Finds the numerator of a maximal minor at a random point, and the number of integrals in
    /// general.
    fn minor(&mut self) -> Result<(Polynomial, usize), SearchError> {
        let ring = PrimePolynomials(self.modulus);
        for _ in 0..DRAWS {
            let positions = self.taylor.positions(&mut self.rng);
            let value = self.rng.element(&self.modulus);
            let Some(equations) = self.equations(value, &positions)? else { continue };
            let (echelon, rows) = self.solved(&equations)?;
            let rows: FxHashSet<RowKey> = rows.into_iter().collect();
            let dimension = equations.dimension(&echelon).ok_or(SearchError::Unbounded)?;
            let (unknowns, count) = equations.size();
            let own = STEP * (unknowns * count) as f64 + echelon.steps() as f64;
            let each = own + self.expansion_steps();
            if self.left.is_some_and(|left| each * LEAST as f64 > left.get()) {
                return Err(SearchError::Long { unknowns, seconds: self.effort.seconds });
            }
            let columns: Vec<usize> =
                (0..echelon.columns()).filter(|column| echelon.has_pivot(*column)).collect();
            let mut values = Vec::new();
            let (mut wanted, mut tries) = (LEAST, 0);
            while wanted <= MOST_MINORS {
                while values.len() < wanted && tries < DRAWS * wanted {
                    tries += 1;
                    self.effort.halt.check()?;
                    let value = self.rng.element(&self.modulus);
                    if let Some(equations) = self.equations(value, &positions)? {
                        values.push((value, self.determinant(&equations, &rows, &columns)?));
                    }
                }
                self.effort.halt.check()?;
                if let Some((numerator, _)) = ring.fraction(&values) {
                    return Ok((numerator, dimension));
                }
                wanted *= 2;
            }
            break;
        }
        Err(SearchError::NoFraction)
    }

    /// Computes the determinant of some rows and columns; the rows are sparse.
    fn determinant(
        &self,
        equations: &Equations,
        rows: &FxHashSet<RowKey>,
        columns: &[usize],
    ) -> Result<u64, SearchError> {
        let m = &self.modulus;
        let mut echelon = Echelon::new(columns.len(), *m);
        let (mut product, mut places) = (m.one(), Vec::with_capacity(columns.len()));
        for (_, row) in equations.rows().filter(|(key, _)| rows.contains(key)) {
            self.effort.halt.check()?;
            let row = columns.iter().map(|column| row[*column]).collect();
            let Some((place, entry)) = echelon.pivot(row) else { break };
            product = m.mul(product, entry);
            places.push(place);
        }
        self.spend(columns.len(), echelon.steps() as f64)?;
        Ok(match (places.len() < columns.len(), is_odd(&places)) {
            (true, _) => 0,
            (false, true) => m.sub(0, product),
            (false, false) => product,
        })
    }
}

/// Whether a permutation of 0, …, n − 1 is odd.
fn is_odd(places: &[usize]) -> bool {
    let mut seen = vec![false; places.iter().max().map_or(0, |last| last + 1)];
    let mut odd = false;
    for start in places {
        let mut next = *start;
        while !seen[next] {
            seen[next] = true;
            match places.get(next) {
                Some(other) if !seen[*other] => {
                    odd = !odd;
                    next = *other;
                }
                _ => break,
            }
        }
    }
    odd
}

/// Computes the determinant of a square matrix.
pub fn determinant(
    m: &Modulus,
    mut matrix: Vec<Vec<u64>>,
    halt: &Halt,
) -> Result<u64, SearchError> {
    let mut determinant = m.one();
    for k in 0..matrix.len() {
        halt.check()?;
        let Some(pivot) = (k..matrix.len()).find(|row| matrix[*row][k] != 0) else {
            return Ok(0);
        };
        if pivot != k {
            matrix.swap(pivot, k);
            determinant = m.sub(0, determinant);
        }
        let (above, below) = matrix.split_at_mut(k + 1);
        let row = &above[k];
        determinant = m.mul(determinant, row[k]);
        let inverse = m.inverse(row[k]);
        for other in below.iter_mut().filter(|other| other[k] != 0) {
            let factor = m.mul(other[k], inverse);
            for (entry, pivot) in other[k..].iter_mut().zip(&row[k..]) {
                *entry = m.sub(*entry, m.mul(factor, *pivot));
            }
        }
    }
    Ok(determinant)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn permutations_have_their_sign() {
        for (places, odd) in [
            (&[][..], false),
            (&[0], false),
            (&[1, 0], true),
            (&[1, 2, 0], false),
            (&[0, 2, 1], true),
            (&[3, 2, 1, 0], false),
            (&[1, 2, 3, 0], true),
        ] {
            assert_eq!(is_odd(places), odd, "{places:?}");
        }
    }
}
