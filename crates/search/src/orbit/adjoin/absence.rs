//! The functions that a theorem of absence covers.
//!
//! A minor of the matrix along an orbit is a polynomial in the state and the adjoined functions. That it
//! is not 0 as a function of the state follows if no polynomial relation between these functions has
//! been overlooked: exponentials, sines and cosines need arguments that are linearly independent,
//! roots need radicands that are no squares, also in products.

use liouville::mechanics::{Model, Origin, Recipe};
use liouville::number::exact::square_root;
use liouville::number::prime::Modulus;
use liouville::number::rational::Rational;

use super::super::super::streams::Stream;
use super::polynomial::{Polynomial, combination};
use super::ring::{Atom, Of, Ring};

/// Number of points at which radicands are compared.
const POINTS: u32 = 600;

/// Powers of a variable in the polynomials of a theorem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Powers {
    /// All powers.
    All,
    /// The first power: higher ones are polynomials in other variables.
    First,
    /// None: the variable is a fraction of others.
    None,
}

/// Polynomials in the state and the adjoined functions.
#[derive(Clone, Debug)]
pub struct Class {
    /// Powers of the components of the state and of the functions.
    pub powers: Vec<Powers>,
    /// Whether a square of a root is a polynomial of higher degree than 2.
    pub is_linear: bool,
}

impl Class {
    /// The class of polynomials for a ring; `None` if the functions may have further relations.
    pub fn of(model: &Model, ring: &Ring, seed: u64) -> Option<Self> {
        let plain = |own: &Polynomial| {
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
                Atom::State => Powers::All,
                Atom::Exponential(argument) => {
                    plain(argument)?;
                    arguments[0].push(argument);
                    Powers::All
                }
                Atom::Sine(argument) => {
                    plain(argument)?;
                    arguments[1].push(argument);
                    Powers::First
                }
                Atom::Cosine(_) => Powers::All,
                Atom::Root(base, 2) => {
                    plain(base)?;
                    is_linear |= degree(ring, base) > 2;
                    radicands.push(base);
                    Powers::First
                }
                Atom::Inverse(..) | Atom::ExponentialOf(..) => Powers::None,
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

    /// Whether a monomial belongs to the class.
    pub fn has(&self, monomial: &[u32]) -> bool {
        let allowed = |(power, own): (&u32, &Powers)| match own {
            Powers::All => true,
            Powers::First => *power <= 1,
            Powers::None => *power == 0,
        };
        monomial.iter().zip(&self.powers).all(allowed)
    }
}

/// Radicands of the roots of parameters; `None` if a root of a number may be a number, or depend on
/// another: its sign modulo a prime may then differ from that of the real root.
fn constants(ring: &Ring) -> Option<Vec<&Polynomial>> {
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
    let numbers: Vec<Rational> = all().filter_map(Polynomial::value).collect();
    let is_irrational = |number: &Rational| square_root(number).is_none();
    if numbers.len() > 1 || !numbers.iter().all(is_irrational) {
        return None;
    }
    Some(all().filter(|base| base.value().is_none()).collect())
}

fn is_state(ring: &Ring, variable: usize) -> bool {
    matches!(ring.atoms[variable], Atom::State)
}

/// Degree in the state.
fn degree(ring: &Ring, own: &Polynomial) -> u32 {
    let degree = |monomial: &[(usize, u32)]| -> u32 {
        let own = monomial.iter().filter(|(variable, _)| is_state(ring, *variable));
        own.map(|(_, power)| power).sum()
    };
    own.terms().map(|(monomial, _)| degree(monomial)).max().unwrap_or(0)
}

/// Whether arguments are linearly independent over the rational numbers, up to functions of the
/// parameters.
fn are_independent(ring: &Ring, arguments: &[&Polynomial]) -> bool {
    let mut done: Vec<Polynomial> = Vec::new();
    for argument in arguments {
        let mut varying = Polynomial::default();
        for (own, value) in argument.terms() {
            if own.iter().any(|(variable, _)| is_state(ring, *variable)) {
                let term = Polynomial::term(own.clone(), value.clone());
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
fn has_no_squares(model: &Model, ring: &Ring, radicands: &[&Polynomial], seed: u64) -> bool {
    if radicands.is_empty() {
        return true;
    }
    let is_independent = |origin: &Origin| match origin {
        Origin::Free(recipe) => matches!(recipe, Recipe::Scalar(_) | Recipe::Vector(..)),
        _ => true,
    };
    if !model.parameters.iter().all(|own| is_independent(&own.origin)) {
        return false;
    }
    let m = Stream::Moduli.numbered(seed, 0).prime(&[3, 5], &[2, 3]);
    let mut chance = Stream::OrbitPoints.under(seed);
    let mut seen = vec![[false; 2]; radicands.len()];
    for _ in 0..POINTS {
        let point: Vec<u64> = ring.atoms.iter().map(|_| chance.element(&m)).collect();
        for (radicand, seen) in radicands.iter().zip(&mut seen) {
            let Some(value) = value(&m, radicand, &point).filter(|value| *value != 0) else {
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

/// Value of a polynomial modulo a prime.
fn value(m: &Modulus, own: &Polynomial, point: &[u64]) -> Option<u64> {
    let mut sum = 0;
    for (monomial, factor) in own.terms() {
        let own = monomial.iter().fold(m.rational(factor)?, |product, (variable, power)| {
            m.mul(product, m.power(point[*variable], u64::from(*power)))
        });
        sum = m.add(sum, own);
    }
    Some(sum)
}
