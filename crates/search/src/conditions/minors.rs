//! Values of one parameter for which there are more integrals than in general.
//!
//! The equations for the Taylor coefficients of an integral have a minor that is not 0 in general.
//! As a function of one parameter it is a fraction; a value with more integrals makes every such
//! minor vanish, so it is a root of the common divisor of minors at several points. All such values
//! are found, including complex ones; those in the field are confirmed by a count.

use super::polynomial::{Polynomial, PrimePolynomials};
use crate::budget::Budget;
use crate::expansion::{FieldExpansion, Taylor};
use crate::jet_equations::{Equations, RowKey};
use crate::jets::VelocityPolynomials;
use crate::local::Local;
use crate::streams::SearchStream;
use crate::{Effort, Halt, SearchError};
use liouville::case::Case;
use liouville::mechanics::{Draw, ParameterOrigin, SamplerSpec};
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;
use liouville::proof::{ProofRng, reconstruct};

/// Number of points whose minors are compared.
const MINOR_POINTS: usize = 2;
/// Smallest number of values of a minor, followed by the largest.
const LEAST: usize = 64;
const MOST_MINORS: usize = 2048;
/// Number of draws of a point, or of a value, until the field has a series there.
const DRAWS: usize = 64;
/// Number of choices of the other parameters under which a relation must persist.
const ROUNDS: u64 = 2;

/// Lists the parameters drawn from a range: name, and index of the draw.
pub fn scalars(case: &Case) -> Vec<(String, usize)> {
    let mut draw = 0;
    let mut found = Vec::new();
    for parameter in &case.model.parameters {
        let ParameterOrigin::Free(recipe) = &parameter.origin else { continue };
        if matches!(recipe, SamplerSpec::Scalar(Draw::Within(_) | Draw::Of(..))) {
            found.push((parameter.name.clone(), draw));
        }
        draw += recipe.draws().len();
    }
    found
}

/// Finds the relations under which there are more integrals of a degree, for one parameter; the
/// others are random small integers.
pub fn relations(
    case: &Case,
    local: &Local,
    asked: VelocityPolynomials,
    (name, draw): &(String, usize),
    effort: &Effort,
) -> Result<Vec<String>, SearchError> {
    let others = scalars(case);
    let mut rounds = Vec::new();
    for round in 0..ROUNDS {
        let mut search = Minors::new(local, asked, *draw, round, effort);
        let values = search.special_values()?;
        rounds.push((values, search.parameters.clone(), search.modulus));
        if rounds[0].0.is_empty() {
            return Ok(Vec::new());
        }
    }
    let found = spelled(name, *draw, &others, &rounds);
    Ok(if found.is_empty() { vec![unnamed(name, &rounds)] } else { found })
}

/// Values of one parameter, the values of all parameters with which they were found, and the prime.
pub type Round = (Vec<u64>, Vec<u64>, Modulus);

/// Writes special values as numbers, or as relations to one other parameter, that hold in all rounds.
pub fn spelled(
    name: &str,
    draw: usize,
    others: &[(String, usize)],
    rounds: &[Round],
) -> Vec<String> {
    let spelled = |(values, parameters, m): &Round| -> Vec<String> {
        let mut texts = Vec::new();
        for value in values {
            if let Some(rational) = reconstruct(*value, m).filter(is_short) {
                texts.push(format!("{name} = {rational}"));
            }
            let mut add = |image: u64, text: &dyn Fn(String) -> String| {
                if let Some(rational) = reconstruct(image, m).filter(is_simple) {
                    texts.push(text(rational.to_string()));
                }
            };
            for (other, place) in others.iter().filter(|(_, place)| *place != draw && *value != 0) {
                let y = parameters[*place];
                add(m.mul(*value, y), &|rational| format!("{name}*{other} = {rational}"));
                add(m.mul(*value, m.inverse(y)), &|rational| {
                    format!("{name}/{other} = {rational}")
                });
                add(m.sub(*value, y), &|rational| format!("{name} − {other} = {rational}"));
                add(m.add(*value, y), &|rational| format!("{name} + {other} = {rational}"));
            }
        }
        texts
    };
    let Some((first, rest)) = rounds.split_first() else { return Vec::new() };
    let again: Vec<Vec<String>> = rest.iter().map(spelled).collect();
    let mut found: Vec<String> = spelled(first);
    found.retain(|text| again.iter().all(|texts| texts.contains(text)));
    found.dedup();
    found
}

/// Says how many values there are that no relation describes.
pub fn unnamed(name: &str, rounds: &[Round]) -> String {
    let count = rounds.first().map_or(0, |(values, ..)| values.len());
    format!("{count} values of {name}, in no simple relation to one other parameter")
}

/// Writes the equation of the values that are not rational, and of the roots of a further factor, if
/// its coefficients are; `None` too if there are none.
pub fn equation(name: &str, values: &[u64], further: &[u64], m: &Modulus) -> Option<String> {
    let ring = PrimePolynomials(*m);
    let is_other = |value: &&u64| reconstruct(**value, m).filter(is_short).is_none();
    let factors = values.iter().filter(is_other).map(|value| vec![m.sub(0, *value), m.one()]);
    let product = factors.fold(further.to_vec(), |all, own| ring.product(&all, &own));
    if product.len() < 2 {
        return None;
    }
    let mut text = String::new();
    for (power, image) in product.iter().enumerate().rev().filter(|(_, image)| **image != 0) {
        let value = reconstruct(*image, m).filter(is_short)?;
        let (sign, size) = match (value.is_negative(), text.is_empty()) {
            (true, true) => ("−", value.abs()),
            (true, false) => (" − ", value.abs()),
            (false, true) => ("", value),
            (false, false) => (" + ", value),
        };
        let base = match power {
            0 => String::new(),
            1 => name.to_string(),
            2 => format!("{name}²"),
            3 => format!("{name}³"),
            n => format!("{name}^{n}"),
        };
        text.push_str(sign);
        text.push_str(&match (size.is_one(), base.is_empty()) {
            (_, true) => size.to_string(),
            (true, false) => base,
            (false, false) => format!("{size}*{base}"),
        });
    }
    Some(format!("{text} = 0"))
}

/// Whether a number is short enough to be no accident modulo a prime of 61 bits.
fn is_short(value: &Rational) -> bool {
    value.small_parts().is_some_and(|(n, d)| n.abs() <= 4096 && d <= 4096)
}

/// Whether a number is small enough to be the constant of a relation rather than an accident.
fn is_simple(value: &Rational) -> bool {
    value.small_parts().is_some_and(|(n, d)| n.abs() <= 8 && d <= 8)
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
}

impl<'l> Minors<'l> {
    fn new(
        local: &'l Local,
        asked: VelocityPolynomials,
        draw: usize,
        round: u64,
        effort: &'l Effort,
    ) -> Self {
        let mut rng = SearchStream::Minors.under(effort.options.seed + round);
        let modulus = rng.prime(&[], &[]);
        let small = |rng: &mut ProofRng| 2 + modulus.to_integer(rng.element(&modulus)) % 97;
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
        Self { taylor, effort, asked, draw, parameters, modulus, rng }
    }

    /// Sets up the equations at a value of the parameter; `None` where the field has no series.
    fn equations(
        &mut self,
        value: u64,
        positions: &[u64],
    ) -> Result<Option<Equations>, SearchError> {
        let mut parameters = self.parameters.clone();
        parameters[self.draw] = value;
        let expansion = self.taylor.at(&parameters, positions, &mut self.rng)?;
        let (taylor, halt) = (&self.taylor, &self.effort.halt);
        let made = |e: FieldExpansion| Equations::of(&e, taylor, taylor.order, self.asked, 0, halt);
        expansion.map(made).transpose()
    }

    /// Finds the values at which there are more integrals.
    fn special_values(&mut self) -> Result<Vec<u64>, SearchError> {
        let ring = PrimePolynomials(self.modulus);
        let mut common: Polynomial = Vec::new();
        let mut dimension = usize::MAX;
        for _ in 0..MINOR_POINTS {
            let (numerator, own) = self.minor()?;
            common = ring.common(&common, &numerator);
            dimension = dimension.min(own);
        }
        let candidates = ring.roots(&common, &mut self.rng);
        let mut found = Vec::new();
        for value in candidates {
            for _ in 0..DRAWS {
                self.effort.halt.check()?;
                let positions = self.taylor.positions(&mut self.rng);
                let own = match self.equations(value, &positions) {
                    Err(error @ SearchError::Stopped) => return Err(error),
                    own => own,
                };
                let Ok(Some(equations)) = own else { continue };
                if equations.dimension(&equations.solved(&Budget::unlimited(&self.effort.halt))?.0)
                    > dimension
                {
                    found.push(value);
                }
                break;
            }
        }
        Ok(found)
    }

    /// Finds the numerator of a maximal minor at a random point, and the number of integrals in
    /// general.
    fn minor(&mut self) -> Result<(Polynomial, usize), SearchError> {
        let ring = PrimePolynomials(self.modulus);
        for _ in 0..DRAWS {
            let positions = self.taylor.positions(&mut self.rng);
            let value = self.rng.element(&self.modulus);
            let Some(equations) = self.equations(value, &positions)? else { continue };
            let (echelon, rows) = equations.solved(&Budget::unlimited(&self.effort.halt))?;
            let dimension = equations.dimension(&echelon);
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

    /// Computes the determinant of some rows and columns.
    fn determinant(
        &self,
        equations: &Equations,
        rows: &[RowKey],
        columns: &[usize],
    ) -> Result<u64, SearchError> {
        let matrix: Vec<Vec<u64>> = equations
            .rows()
            .filter(|(key, _)| rows.contains(key))
            .map(|(_, row)| columns.iter().map(|column| row[*column]).collect())
            .collect();
        if matrix.len() < columns.len() {
            return Ok(0);
        }
        determinant(&self.modulus, matrix, &self.effort.halt)
    }
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
