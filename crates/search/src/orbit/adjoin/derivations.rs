//! Derivatives of integrals along symmetry fields, and along the fields P ∂F of other integrals F.
//!
//! If [u,v] = c v, the derivative of an integral along u is one, and so is the bracket of two
//! integrals if the field v keeps the bracket.

use liouville::case::Case;
use liouville::formula::Formula;
use liouville::graph::Expr;
use liouville::mechanics::calculus::DualPoint;
use liouville::mechanics::{System, Variable};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use num_integer::Integer;

use super::super::super::{Effort, SearchError};
use super::parts::read_with;
use super::polynomial::{Monomial, RingPolynomial};
use super::ring::{AdjoinedRing, Atom, Of};
use super::{Extension, is_constant, written};

/// Components of a symmetry field by the variables that have some.
pub type FieldComponents = Vec<(String, Formula)>;

/// The integrals of a case as polynomials, with derivations that take integrals to integrals.
pub struct IntegralAlgebra {
    /// Extended case.
    pub extension: Extension,
    /// Integrals by their places among those given.
    pub integrals: Vec<(usize, RingPolynomial)>,
    /// Rates of all variables along each symmetry field that could be read, by its place.
    symmetries: Vec<(usize, Vec<RingPolynomial>)>,
    /// Tensor of a bracket, where one is known or may be kept.
    tensor: Option<Vec<Vec<RingPolynomial>>>,
    /// Rates of all variables along each component of the state.
    axes: Vec<Vec<RingPolynomial>>,
    /// Number of variables of the ring that the field needs.
    of_field: usize,
}

impl IntegralAlgebra {
    /// Reads known integrals and symmetry fields of a case without a level; `None` where its functions
    /// cannot be adjoined.
    pub fn of(
        case: &Case,
        effort: &Effort,
        known: &[Formula],
        symmetries: &[&FieldComponents],
    ) -> Result<Option<Self>, SearchError> {
        let dimension = case.model.dimension();
        if !case.model.level.is_empty() {
            return Ok(None);
        }
        let further = |jet: &DualPoint<'_, Expr>| -> Vec<Expr> {
            let own = symmetries.iter().flat_map(|own| components(case, jet, own));
            let tensor = match &case.model.system {
                System::Hamiltonian(own) => own.tensor(&jet.phase).concat(),
                _ => Vec::new(),
            };
            own.chain(tensor).collect()
        };
        let Some(mut read) = read_with(case, effort, (known, true), Vec::new(), &further)? else {
            return Ok(None);
        };
        let further = std::mem::take(&mut read.parts.further);
        let (fields, rest) = further.split_at(symmetries.len() * dimension);
        let tensor = match rest.is_empty() {
            false => rest.iter().cloned().collect::<Option<Vec<_>>>(),
            true => of_pairs(&read.parts.moved_by, dimension),
        };
        let tensor = tensor.map(|all| all.chunks(dimension).map(<[_]>::to_vec).collect());
        let of_field = |(place, own): (usize, &[Option<RingPolynomial>])| {
            let own: Vec<RingPolynomial> = own.iter().cloned().collect::<Option<_>>()?;
            Some((place, read.ring.rates(&own)?))
        };
        let symmetries = fields.chunks(dimension).enumerate().filter_map(of_field).collect();
        let axis = |axis: usize| {
            let unit = |k| RingPolynomial::constant(Rational::from(i64::from(k == axis)));
            read.ring.rates(&(0..dimension).map(unit).collect::<Vec<_>>())
        };
        let Some(axes) = (0..dimension).map(axis).collect::<Option<Vec<_>>>() else {
            return Ok(None);
        };
        let ring = &read.ring;
        let short = |(place, own): &(usize, RingPolynomial)| Some((*place, ring.short(own)?));
        let integrals = read.parts.known.iter().filter_map(short).collect();
        let of_field = read.parts.of_field;
        let made = written(case, read, effort.options.seed)?;
        Ok(made.map(|extension| Self { extension, integrals, symmetries, tensor, axes, of_field }))
    }

    /// Places of the symmetry fields.
    pub fn symmetries(&self) -> impl Iterator<Item = usize> {
        self.symmetries.iter().map(|(place, _)| *place)
    }

    /// Derivative along the symmetry field of a place.
    pub fn along(&self, symmetry: usize, own: &RingPolynomial) -> Option<RingPolynomial> {
        let (_, rates) = self.symmetries.iter().find(|(place, _)| *place == symmetry)?;
        self.extension.ring.short(&own.rate(|k| rates.get(k).cloned())?)
    }

    /// Bracket of two functions; `None` if there is none, or it is too long.
    pub fn bracket(&self, own: &RingPolynomial, other: &RingPolynomial) -> Option<RingPolynomial> {
        let tensor = self.tensor.as_ref()?;
        let one = Rational::from(1);
        let slopes = |own: &RingPolynomial| -> Option<Vec<RingPolynomial>> {
            self.axes.iter().map(|axis| own.rate(|k| axis.get(k).cloned())).collect()
        };
        let (own, other) = (slopes(own)?, slopes(other)?);
        let mut sum = RingPolynomial::default();
        for (row, slope) in tensor.iter().zip(&own) {
            let mut turned = RingPolynomial::default();
            for (entry, slope) in row.iter().zip(&other).filter(|(entry, _)| !entry.is_zero()) {
                turned = turned.plus(&entry.times(slope)?, &one)?;
            }
            sum = sum.plus(&slope.times(&turned)?, &one)?;
        }
        self.extension.ring.short(&sum)
    }

    /// Degree in the variables that are no parameters or functions of these.
    pub fn degree(&self, own: &RingPolynomial) -> u32 {
        self.extension.ring.degree(own)
    }

    /// Whether a polynomial contains only functions that the field contains.
    pub fn is_of_field(&self, own: &RingPolynomial) -> bool {
        own.variables().iter().all(|variable| *variable < self.of_field)
    }
}

/// Values of a symmetry field by the components of the state.
fn components(case: &Case, jet: &DualPoint<'_, Expr>, own: &FieldComponents) -> Vec<Expr> {
    let of = |variable: &Variable| match own.iter().find(|(name, _)| *name == variable.name) {
        Some((_, formula)) => jet.phase.evaluate(formula).components(),
        None => vec![Expr::rational(&Rational::from(0)); variable.len()],
    };
    case.model.state.iter().flat_map(of).collect()
}

/// The bracket {x,u} = 1 of pairs with x' = u; `None` unless they are all components.
fn of_pairs(pairs: &[(usize, usize)], dimension: usize) -> Option<Vec<RingPolynomial>> {
    let mut places: Vec<usize> = pairs.iter().flat_map(|(x, u)| [*x, *u]).collect();
    places.sort_unstable();
    if !places.into_iter().eq(0..dimension) {
        return None;
    }
    let mut all = vec![RingPolynomial::default(); dimension * dimension];
    for (x, u) in pairs {
        all[x * dimension + u] = RingPolynomial::constant(Rational::from(1));
        all[u * dimension + x] = RingPolynomial::constant(Rational::from(-1));
    }
    Some(all)
}

impl AdjoinedRing {
    /// Degree in the variables that are no parameters or functions of these.
    pub fn degree(&self, own: &RingPolynomial) -> u32 {
        let varies = |variable: usize| !is_constant(&self.atoms[variable]);
        let degree = |term: &Monomial| {
            let own = term.iter().filter(|(variable, _)| varies(*variable));
            own.fold(0u32, |sum, (_, power)| sum.saturating_add(*power))
        };
        own.terms().map(|(term, _)| degree(term)).max().unwrap_or(0)
    }

    /// A polynomial by its shortest form that is seen, without a common factor that is a positive number
    /// or a function of the parameters; `None` if it is too long.
    fn short(&self, own: &RingPolynomial) -> Option<RingPolynomial> {
        let mut made = own.clone();
        for place in 0..self.atoms.len() {
            if let Some((first, second)) = self.inverses(place) {
                made = without_products(&made, first, second);
            }
        }
        made = self.reduced(&made)?;
        for place in 0..self.atoms.len() {
            if let Atom::Inverse(base, order) = &self.atoms[place] {
                made = divided(&made, place, *order, base)?;
            }
            if let Atom::Constant(Of::Inverse(base)) = &self.atoms[place] {
                made = divided(&made, place, 1, base)?;
            }
        }
        if made.is_zero() {
            return Some(made);
        }
        let (value, common, rest) = made.split()?;
        let kept: Monomial =
            common.into_iter().filter(|(k, _)| !is_constant(&self.atoms[*k])).collect();
        let made = rest.times(&RingPolynomial::term(kept, Rational::from(1)))?;
        let sign = if value.is_negative() { -1 } else { 1 };
        Some(made.times_number(&(&scale(&made)? * &Rational::from(sign))))
    }

    /// Two variables whose product is 1, the later of which is this one.
    fn inverses(&self, place: usize) -> Option<(usize, usize)> {
        match &self.atoms[place] {
            Atom::Inverse(_, order) if *order > 1 => Some((place - 1, place)),
            Atom::Inverse(base, _) => match base.single()? {
                (own, value) if value.is_one() && own.len() == 1 && own[0].1 == 1 => {
                    Some((own[0].0, place))
                }
                _ => None,
            },
            Atom::ExponentialOf(_, powers) => match powers.as_slice() {
                [(variable, -1)] => Some((*variable, place)),
                _ => None,
            },
            _ => None,
        }
    }
}

/// Factor by which the coefficients become whole numbers without a common divisor.
pub(super) fn scale(own: &RingPolynomial) -> Option<Rational> {
    let parts = || own.terms().map(|(_, value)| value.parts());
    let below = parts().fold(num_bigint::BigInt::from(1), |lcm, (_, below)| lcm.lcm(&below));
    let above = parts().fold(num_bigint::BigInt::ZERO, |gcd, (above, _)| gcd.gcd(&above));
    (above.bits() > 0).then(|| Rational::from_parts(below, above))
}

/// Power of a variable in a monomial.
fn power(own: &Monomial, variable: usize) -> u32 {
    own.iter().find(|(other, _)| *other == variable).map_or(0, |(_, power)| *power)
}

/// A monomial with another power of a variable.
fn with_power(own: &Monomial, variable: usize, power: u32) -> Monomial {
    let mut all: Monomial = own.iter().copied().filter(|(other, _)| *other != variable).collect();
    if power > 0 {
        all.push((variable, power));
        all.sort_unstable();
    }
    all
}

/// Replaces products of two variables by 1.
fn without_products(own: &RingPolynomial, first: usize, second: usize) -> RingPolynomial {
    let mut made = RingPolynomial::default();
    for (term, value) in own.terms() {
        let (a, b) = (power(term, first), power(term, second));
        let common = a.min(b);
        let term = with_power(&with_power(term, first, a - common), second, b - common);
        let next = RingPolynomial::term(term, value.clone());
        // There are no more terms than before.
        made = made.plus(&next, &Rational::from(1)).unwrap_or(made);
    }
    made
}

/// Divides what stands beside powers of b^(−1/n), if it is a multiple of b.
fn divided(
    own: &RingPolynomial,
    inverse: usize,
    order: u32,
    base: &RingPolynomial,
) -> Option<RingPolynomial> {
    let mut made = own.clone();
    let highest = made.terms().map(|(term, _)| power(term, inverse)).max().unwrap_or(0);
    for raised in (order..=highest).rev() {
        let mut beside = RingPolynomial::default();
        for (term, value) in made.terms().filter(|(term, _)| power(term, inverse) == raised) {
            let term = RingPolynomial::term(with_power(term, inverse, 0), value.clone());
            beside = beside.plus(&term, &Rational::from(1))?;
        }
        if beside.is_zero() {
            continue;
        }
        if let Some(quotient) = beside.over(base) {
            let of_power = |own: &RingPolynomial, power: u32| {
                own.times(&RingPolynomial::variable(inverse, power))
            };
            made = made.plus(&of_power(&beside, raised)?, &Rational::from(-1))?;
            made = made.plus(&of_power(&quotient, raised - order)?, &Rational::from(1))?;
        }
    }
    Some(made)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn x(variable: usize, power: u32) -> RingPolynomial {
        RingPolynomial::variable(variable, power)
    }

    fn sum(a: &RingPolynomial, b: &RingPolynomial) -> RingPolynomial {
        a.plus(b, &Rational::from(1)).expect("short")
    }

    #[test]
    fn relations_between_roots_and_inverses_shorten() {
        // x, y, r = √(x² + y²), w = 1/r.
        let mut ring = AdjoinedRing::new(0, 2, Vec::new());
        let base = sum(&x(0, 2), &x(1, 2));
        ring.power(&base, &Rational::new(-1, 2)).expect("a root");
        let (r, w) = (2, 3);
        let long = sum(&x(0, 2), &x(1, 2)).times(&x(w, 3)).expect("short");
        assert_eq!(ring.short(&long), Some(x(w, 1)), "(x² + y²) w³ = w");
        let product = x(r, 2).times(&x(w, 3)).expect("short");
        assert_eq!(ring.short(&product), Some(x(w, 1)), "r² w³ = w");
        let other = x(0, 2).times(&x(w, 3)).expect("short");
        assert_eq!(ring.short(&other), Some(other.clone()), "x² w³ stays");
        let multiple = x(r, 2).times_number(&Rational::new(-4, 6));
        let negative = base.times_number(&Rational::from(-1));
        assert_eq!(ring.short(&multiple), Some(negative), "up to a positive factor");
    }
}
