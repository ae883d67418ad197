//! The functions that a theorem of absence covers.
//!
//! A minor of the matrix along an orbit is a polynomial in the state and the adjoined functions. That it
//! is not 0 as a function of the state follows if no polynomial relation between these functions has
//! been overlooked: exponentials, sines and cosines need arguments that are linearly independent,
//! roots need radicands that are no squares, also in products.

use liouville::mechanics::{Model, ParameterOrigin, SamplerSpec};
use liouville::number::exact::square_root;
use liouville::number::rational::Rational;

use super::super::super::streams::SearchStream;
use super::polynomial::{RingPolynomial, combination};
use super::ring::{AdjoinedRing, Atom, Of};

/// Number of points at which radicands are compared.
const RADICAND_POINTS: u32 = 600;

/// Powers of a variable in the polynomials of a theorem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AllowedPowers {
    /// All powers.
    All,
    /// The first power: higher ones are polynomials in other variables.
    First,
    /// None: the variable is a fraction of others.
    None,
}

/// Polynomials in the state and the adjoined functions.
#[derive(Clone, Debug)]
pub struct AdjoinedPolynomials {
    /// Powers of the components of the state and of the functions.
    pub powers: Vec<AllowedPowers>,
    /// Whether a square of a root is a polynomial of higher degree than 2.
    pub is_linear: bool,
}

impl AdjoinedPolynomials {
    /// The class of polynomials for a ring; `None` if the functions may have further relations.
    pub fn of(model: &Model, ring: &AdjoinedRing, seed: u64) -> Option<Self> {
        let plain = |own: &RingPolynomial| {
            let own = own.variables().into_iter();
            let is_plain = |k: &usize| matches!(ring.atoms[*k], Atom::State | Atom::Parameter);
            own.clone().all(|k| is_plain(&k)).then_some(())
        };
        let mut arguments = [Vec::new(), Vec::new()];
        let mut radicands = constants(ring)?;
        let mut powers = Vec::new();
        let mut is_linear = false;
        for atom in &ring.atoms {
            let own = match atom {
                Atom::Parameter | Atom::Constant(_) => continue,
                Atom::State => AllowedPowers::All,
                Atom::Exponential(argument) => {
                    plain(argument)?;
                    arguments[0].push(argument);
                    AllowedPowers::All
                }
                Atom::Sine(argument) => {
                    plain(argument)?;
                    arguments[1].push(argument);
                    AllowedPowers::First
                }
                Atom::Cosine(_) => AllowedPowers::All,
                Atom::Root(base, 2) => {
                    plain(base)?;
                    is_linear |= degree(ring, base) > 2;
                    radicands.push(base);
                    AllowedPowers::First
                }
                Atom::Inverse(..) | Atom::ExponentialOf(..) => AllowedPowers::None,
                Atom::Root(..) | Atom::Logarithm(..) | Atom::Arctangent(..) | Atom::Power(..) => {
                    return None;
                }
            };
            powers.push(own);
        }
        let independent = arguments.iter().all(|own| are_independent(ring, own));
        let is_true = independent && has_no_squares(model, ring, &radicands, seed);
        is_true.then_some(Self { powers, is_linear })
    }

    /// Variables of the extended state that its polynomials contain.
    pub fn variables(&self) -> Vec<usize> {
        (0..self.powers.len()).filter(|place| self.powers[*place] != AllowedPowers::None).collect()
    }

    /// Whether a monomial belongs to the class.
    pub fn has(&self, monomial: &[u32]) -> bool {
        let allowed = |(power, own): (&u32, &AllowedPowers)| match own {
            AllowedPowers::All => true,
            AllowedPowers::First => *power <= 1,
            AllowedPowers::None => *power == 0,
        };
        monomial.iter().zip(&self.powers).all(allowed)
    }
}

/// Whether a class of polynomials cannot contain a function.
pub fn is_beyond(atom: &Atom) -> bool {
    match atom {
        Atom::Root(base, 2) => base.square_root().is_some(),
        Atom::Root(..) | Atom::Logarithm(..) | Atom::Arctangent(..) | Atom::Power(..) => true,
        _ => false,
    }
}

/// Whether all roots of a ring are square roots of functions of the state and the parameters, of which no
/// product is a constant times a square.
pub fn has_independent_roots(model: &Model, ring: &AdjoinedRing, seed: u64) -> bool {
    let Some(mut radicands) = constants(ring) else { return false };
    for atom in &ring.atoms {
        match atom {
            Atom::Root(base, 2) => {
                let is_plain = |k: &usize| matches!(ring.atoms[*k], Atom::State | Atom::Parameter);
                if !base.variables().iter().all(is_plain) {
                    return false;
                }
                radicands.push(base);
            }
            Atom::Root(..) | Atom::Power(..) => return false,
            _ => {}
        }
    }
    has_no_squares(model, ring, &radicands, seed)
}

/// Radicands of the roots of parameters; `None` if a root of a number may be a number, or depend on
/// another: its sign modulo a prime may then differ from that of the real root. `None` with other
/// functions of the parameters too, which have been made parameters.
fn constants(ring: &AdjoinedRing) -> Option<Vec<&RingPolynomial>> {
    // A function of the parameters, as ln 2, is not independent of others because it has no relation.
    if ring.atoms.iter().any(|atom| matches!(atom, Atom::Constant(Of::Function(..)))) {
        return None;
    }
    let all = || {
        ring.atoms.iter().filter_map(|atom| match atom {
            Atom::Constant(Of::Root(base)) => Some(base),
            _ => None,
        })
    };
    let is_plain = |k: &usize| matches!(ring.atoms[*k], Atom::Parameter);
    if !all().all(|base| base.variables().iter().all(is_plain)) {
        return None;
    }
    let numbers: Vec<Rational> = all().filter_map(RingPolynomial::value).collect();
    let is_irrational = |number: &Rational| square_root(number).is_none();
    if numbers.len() > 1 || !numbers.iter().all(is_irrational) {
        return None;
    }
    Some(all().filter(|base| base.value().is_none()).collect())
}

fn is_state(ring: &AdjoinedRing, variable: usize) -> bool {
    matches!(ring.atoms[variable], Atom::State)
}

/// Degree in the state.
fn degree(ring: &AdjoinedRing, own: &RingPolynomial) -> u32 {
    let degree = |monomial: &[(usize, u32)]| -> u32 {
        let own = monomial.iter().filter(|(variable, _)| is_state(ring, *variable));
        own.map(|(_, power)| power).sum()
    };
    own.terms().map(|(monomial, _)| degree(monomial)).max().unwrap_or(0)
}

/// Whether arguments are linearly independent over the rational numbers, up to functions of the
/// parameters.
fn are_independent(ring: &AdjoinedRing, arguments: &[&RingPolynomial]) -> bool {
    let mut done: Vec<RingPolynomial> = Vec::new();
    for argument in arguments {
        let mut varying = RingPolynomial::default();
        for (own, value) in argument.terms() {
            if own.iter().any(|(variable, _)| is_state(ring, *variable)) {
                let term = RingPolynomial::term(own.clone(), value.clone());
                let Some(sum) = varying.plus(&term, &1.into()) else { return false };
                varying = sum;
            }
        }
        if combination(&varying, &done).is_some() {
            return false;
        }
        done.push(varying);
    }
    true
}

/// Whether no product of some radicands is a constant times a square.
///
/// Such a product would have squares as its values modulo p at all points, or at none, where the
/// radicands before are squares.
fn has_no_squares(
    model: &Model,
    ring: &AdjoinedRing,
    radicands: &[&RingPolynomial],
    seed: u64,
) -> bool {
    if radicands.is_empty() {
        return true;
    }
    let is_independent = |origin: &ParameterOrigin| match origin {
        ParameterOrigin::Free(recipe) => {
            matches!(recipe, SamplerSpec::Scalar(_) | SamplerSpec::Vector(..))
        }
        _ => true,
    };
    if !model.parameters.iter().all(|own| is_independent(&own.origin)) {
        return false;
    }
    let m = SearchStream::Moduli.numbered(seed, 0).prime(&[3, 5], &[2, 3]);
    let mut rng = SearchStream::OrbitPoints.under(seed);
    let mut seen = vec![[false; 2]; radicands.len()];
    for _ in 0..RADICAND_POINTS {
        let point: Vec<u64> = ring.atoms.iter().map(|_| rng.element(&m)).collect();
        for (radicand, seen) in radicands.iter().zip(&mut seen) {
            let Some(value) = radicand.residue(&m, &point).filter(|value| *value != 0) else {
                break;
            };
            let is_square = m.root(value).is_some();
            seen[usize::from(is_square)] = true;
            if !is_square {
                break;
            }
        }
    }
    seen.iter().all(|[no, yes]| *no && *yes)
}
