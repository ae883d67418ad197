//! The parameters of a field for which it has more polynomial integrals, up to codimension one.
//!
//! They are the zeros of a polynomial D(θ) without repeated factors. On a line θ₀ + t θ₁ it is known up
//! to a constant ([`ParameterLines`]), on a plane θ₀ + t θ₁ + s θ₂ by interpolation from lines. There it
//! is factored; the factors belong to those of D, since a random plane meets an irreducible
//! hypersurface in an irreducible curve (Bertini). The factors on one line are then followed into
//! further planes until these determine the coefficients of each factor of D.

use std::ops::RangeInclusive;

use liouville::number::prime::{Polynomial, PrimePolynomials};
use liouville::order::StableOrder;

use super::equations::ParametricEquations;
use super::factors::{Bivariate, bivariate_factors, irreducible, lifted};
use super::hypersurface::{Hypersurface, PrimeTerms};
use super::joined::joined;
use super::parameter_line::ParameterLines;
use super::variety::power;
use crate::SearchError;
use crate::echelon::Echelon;
use crate::orbit::monomials;

/// Largest degree of D.
const DEGREE: usize = 24;
/// Largest number of coefficients of a factor.
const COEFFICIENTS: usize = 500;
/// Largest number of planes.
const PLANES: usize = 80;
/// Number of primes, and of lines for each, on which a point of a hypersurface is looked for.
const PRIMES: u64 = 16;
const LINES: usize = 6;

/// Conditions of codimension one.
pub struct SpecialLocus {
    /// Those that are known as equations.
    pub surfaces: Vec<Hypersurface>,
    /// Further ones of which no points are found modulo primes, as those of sums of squares.
    pub pointless: Vec<Hypersurface>,
    /// Degree of all others together, with these.
    pub unexplained: usize,
}

/// A factor of D on planes through one line.
struct Component {
    /// Degree.
    degree: usize,
    /// The factor on each plane, monic in t.
    planes: Vec<Bivariate>,
}

/// The reason why no conditions are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoLocus {
    /// The field has no values for these parameters.
    NoValues,
    /// The equations are not fractions of low degree on a line, or take too long.
    NoFractions,
}

/// Finds the conditions on some draws of the parameters under which there are more integrals, besides
/// `known` ones; the steps taken are subtracted from `left`.
pub fn special(
    equations: &ParametricEquations<'_>,
    draws: &[usize],
    known: &[Hypersurface],
    left: &mut f64,
) -> Result<Result<SpecialLocus, NoLocus>, SearchError> {
    let Some(lines) = ParameterLines::new(equations, draws.to_vec(), 0)? else {
        return Ok(Err(NoLocus::NoValues));
    };
    let mut planes = Planes::new(lines, known);
    let found = found(equations, draws, &mut planes, *left);
    *left -= planes.spent;
    found
}

fn found(
    equations: &ParametricEquations<'_>,
    draws: &[usize],
    planes: &mut Planes<'_, '_, '_>,
    left: f64,
) -> Result<Result<SpecialLocus, NoLocus>, SearchError> {
    let Some(first) = planes.first(left)? else { return Ok(Err(NoLocus::NoFractions)) };
    let (surfaces, pointless) = (Vec::new(), Vec::new());
    let mut found = SpecialLocus { surfaces, pointless, unexplained: first.len() - 1 };
    if first.len() < 2 {
        return Ok(Ok(found));
    }
    let Some(components) = planes.components(&first)? else { return Ok(Ok(found)) };
    let mut images: Vec<PrimeTerms> = Vec::new();
    for own in &components {
        images.extend(planes.coefficients(own)?);
    }
    let modulus = planes.lines.modulus();
    for own in joined(images, &modulus) {
        let is_told = match is_special(equations, draws, &own, 1..=PRIMES)? {
            Some(true) => {
                found.surfaces.push(own.clone());
                true
            }
            // The level or the field is another one there, unless coefficients are short by accident.
            Some(false) => is_special(equations, draws, &own, 0..=0)? == Some(false),
            None => {
                found.pointless.push(own.clone());
                false
            }
        };
        if is_told {
            found.unexplained = found.unexplained.saturating_sub(own.degree());
        }
    }
    found.surfaces.order_by_key(Hypersurface::degree);
    Ok(Ok(found))
}

/// Whether there are more integrals at a point of a hypersurface modulo one of some primes; `None` if no
/// point was found.
fn is_special(
    equations: &ParametricEquations<'_>,
    draws: &[usize],
    own: &Hypersurface,
    primes: RangeInclusive<u64>,
) -> Result<Option<bool>, SearchError> {
    for prime in primes {
        let Some(mut lines) = ParameterLines::new(equations, draws.to_vec(), prime)? else {
            continue;
        };
        let m = lines.modulus();
        let ring = PrimePolynomials(m);
        for _ in 0..LINES {
            let (origin, slope) = (lines.random(), lines.random());
            let Some(restricted) = own.on_line(&m, &origin, &slope) else { break };
            let Some(t) = ring.roots(&restricted).first().copied() else {
                continue;
            };
            let point = m.along(&origin, &slope, t);
            let general = lines.general;
            return Ok(Some(lines.nullity(&point)?.is_some_and(|own| own > general)));
        }
    }
    Ok(None)
}

/// Planes through one line.
struct Planes<'p, 'l, 'e> {
    lines: ParameterLines<'l, 'e>,
    known: &'p [Hypersurface],
    origin: Vec<u64>,
    slope: Vec<u64>,
    directions: Vec<Vec<u64>>,
    /// Number of lines that may still be examined.
    left: usize,
    /// Number of elementary steps so far, and the largest number.
    spent: f64,
    most: f64,
}

impl<'p, 'l, 'e> Planes<'p, 'l, 'e> {
    fn new(mut lines: ParameterLines<'l, 'e>, known: &'p [Hypersurface]) -> Self {
        let (origin, slope) = (lines.random(), lines.random());
        Self { lines, known, origin, slope, directions: Vec::new(), left: 0, spent: 0.0, most: 0.0 }
    }

    fn ring(&self) -> PrimePolynomials {
        PrimePolynomials(self.lines.modulus())
    }

    /// Finds D on the first line, within a number of steps for all; `None` if the equations are not
    /// fractions of low degree, or take too long.
    fn first(&mut self, steps: f64) -> Result<Option<Polynomial>, SearchError> {
        if self.lines.steps() > steps {
            return Ok(None);
        }
        let origin = self.origin.clone();
        let found = self.special(&origin)?;
        self.most = steps;
        let most = steps / self.lines.steps().max(1.0);
        self.left = (most as usize).saturating_sub(1);
        Ok(found)
    }

    /// Finds D without known factors on a line with the slope of all.
    fn special(&mut self, origin: &[u64]) -> Result<Option<Polynomial>, SearchError> {
        let found = self.lines.special(origin, &self.slope)?;
        self.spent += self.lines.steps();
        let Some(mut found) = found else { return Ok(None) };
        let (m, ring) = (self.lines.modulus(), self.ring());
        for own in self.known {
            let Some(own) = own.on_line(&m, origin, &self.slope) else { return Ok(None) };
            found = ring.divided(&found, &ring.common(&found, &own)).0;
        }
        Ok(Some(ring.monic(&found)))
    }

    /// Finds D on a plane through the first line; `None` if it is not a polynomial there.
    fn plane(
        &mut self,
        first: &Polynomial,
        direction: &[u64],
    ) -> Result<Option<Bivariate>, SearchError> {
        let degree = first.len() - 1;
        if self.left < degree + 1 {
            return Ok(None);
        }
        self.left -= degree + 1;
        let (m, ring) = (self.lines.modulus(), self.ring());
        let mut values = vec![(0, first.clone())];
        // One line more than the degree confirms it.
        for s in 1..=degree as u64 + 1 {
            let s = m.integer(s);
            let origin = m.along(&self.origin, direction, s);
            match self.special(&origin)? {
                Some(own) if own.len() == first.len() => values.push((s, own)),
                _ => return Ok(None),
            }
        }
        let mut plane: Bivariate = vec![vec![0; degree + 1]; degree + 1];
        for power in 0..=degree {
            let points: Vec<(u64, u64)> = values.iter().map(|(s, own)| (*s, own[power])).collect();
            let own = ring.through(&points).0;
            if own.len() > degree - power + 1 {
                return Ok(None);
            }
            own.into_iter().enumerate().for_each(|(k, entry)| plane[k][power] = entry);
        }
        Ok(Some(plane.into_iter().map(PrimePolynomials::trimmed).collect()))
    }

    /// Follows the factors of D into planes until these determine their coefficients; `None` if D is of
    /// too high a degree, or takes too long.
    fn components(&mut self, first: &Polynomial) -> Result<Option<Vec<Component>>, SearchError> {
        let ring = self.ring();
        let dimension = self.lines.dimension();
        if first.len() - 1 > DEGREE {
            return Ok(None);
        }
        let factors = irreducible(&ring, first, &mut self.lines.rng);
        if dimension == 1 {
            let component =
                |own: Polynomial| Component { degree: own.len() - 1, planes: vec![vec![own]] };
            self.directions.push(vec![0]);
            return Ok(Some(factors.into_iter().map(component).collect()));
        }
        let direction = self.lines.random();
        let Some(plane) = self.plane(first, &direction)? else { return Ok(None) };
        let one = vec![self.lines.modulus().one()];
        let product = |places: Vec<usize>| {
            places.iter().fold(one.clone(), |all, place| ring.product(&all, &factors[*place]))
        };
        let starts: Vec<Polynomial> =
            bivariate_factors(&ring, &plane, &factors).into_iter().map(product).collect();
        let mut components: Vec<Component> = starts
            .iter()
            .map(|own| Component { degree: own.len() - 1, planes: Vec::new() })
            .collect();
        let mut next = Some((direction, plane));
        for number in 0..PLANES {
            let Some((direction, plane)) = next.take() else { break };
            self.directions.push(direction);
            let lifted = lifted(&ring, &plane, &starts);
            components.iter_mut().zip(lifted).for_each(|(own, plane)| own.planes.push(plane));
            // The plane of the whole space says everything.
            if dimension == 2 || !self.has_open(&components)? {
                break;
            }
            let direction = match number < dimension {
                true => {
                    let mut unit = vec![0; dimension];
                    unit[number] = self.lines.modulus().one();
                    unit
                }
                false => self.lines.random(),
            };
            next = self.plane(first, &direction)?.map(|plane| (direction, plane));
        }
        Ok(Some(components))
    }

    /// Whether further planes may determine the coefficients of a factor that is not known, within the
    /// number of steps.
    fn has_open(&mut self, components: &[Component]) -> Result<bool, SearchError> {
        let dimension = self.lines.dimension();
        for own in components {
            if own.unknowns(dimension) <= COEFFICIENTS && self.coefficients(own)?.is_none() {
                return Ok(self.spent <= self.most);
            }
        }
        Ok(false)
    }

    /// Finds the coefficients of a factor from its values on planes; `None` if these do not determine
    /// them, or the steps are spent.
    fn coefficients(&mut self, own: &Component) -> Result<Option<PrimeTerms>, SearchError> {
        self.lines.check()?;
        let (m, ring) = (self.lines.modulus(), self.ring());
        let dimension = self.lines.dimension();
        // A factor that is constant along a coordinate does not contain it.
        let is_absent = |place: &usize| {
            self.directions.iter().zip(&own.planes).any(|(direction, plane)| {
                let others = direction.iter().enumerate().filter(|(k, _)| k != place);
                let is_along = direction[*place] != 0 && others.into_iter().all(|(_, x)| *x == 0);
                is_along && plane.iter().skip(1).all(Vec::is_empty)
            })
        };
        let present: Vec<usize> = (0..dimension).filter(|place| !is_absent(place)).collect();
        let unknowns = monomials::count(present.len(), own.degree as u32);
        // The values on a plane are those of a polynomial in two variables.
        let known = own.planes.len() * monomials::count(2, own.degree as u32);
        if unknowns > COEFFICIENTS || known < unknowns || self.spent > self.most {
            return Ok(None);
        }
        let all = monomials::up_to(&present, dimension, own.degree as u32);
        let mut echelon = Echelon::new(all.len() + 1, m);
        for (direction, plane) in self.directions.iter().zip(&own.planes) {
            self.lines.check()?;
            // A polynomial of this degree in two variables is known by its values at these points.
            for (i, j) in (0..=own.degree).flat_map(|i| (0..=own.degree - i).map(move |j| (i, j))) {
                let (t, s) = (m.integer(i as u64 + 1), m.integer(j as u64));
                let point = m.along(&m.along(&self.origin, &self.slope, t), direction, s);
                let rows = plane.iter().rev().map(|own| ring.evaluate(own, t));
                let value = rows.fold(0, |sum, own| m.add(m.mul(sum, s), own));
                let row = all.iter().map(|exponents| power(&point, exponents, &m));
                echelon.push(row.chain([m.sub(0, value)]).collect());
            }
        }
        let points = known as f64;
        self.spent += echelon.steps() as f64 + points * (unknowns * dimension) as f64;
        if unknowns > echelon.rank() {
            return Ok(None);
        }
        let mut vectors = echelon.null_space();
        let Some(mut vector) = vectors.pop().filter(|_| vectors.is_empty()) else {
            return Ok(None);
        };
        if vector.pop() != Some(m.one()) {
            return Ok(None);
        }
        Ok(Some(all.into_iter().zip(vector).filter(|(_, image)| *image != 0).collect()))
    }
}

impl Component {
    /// Largest number of coefficients.
    fn unknowns(&self, dimension: usize) -> usize {
        monomials::count(dimension, self.degree as u32)
    }
}
