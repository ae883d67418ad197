//! Denesting of roots: √(x² + 2x + 1) = |x + 1| and √(x + 1 + 2√x) = |√x + 1|.
//!
//! A radicand is read as a polynomial in the inputs and in the roots and functions that it
//! contains. If it is c b², its root is √c |b|. If it is a + b y with y² = C and a² - b² C = d²,
//! then with u = (a + d)/2
//!
//! ```text
//! √(a + b y) = |√u + b y/(2√u)|
//! ```
//!
//! where d may be a multiple of another root, since the square of the right side is u + b y + b²C/(4u), and b²C/4 = u (a - u). It holds where
//! the left side has a value and u ≠ 0: u and a - u have the sum a and a product that is not
//! negative, so both are negative only where a + b y = -(√-u ± √(u - a))² is.

use crate::graph::{Expr, Graph, Step};
use crate::number::exact::square_root;
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

use super::monomial_roots::inputs_by_roots;
use super::polynomial::{Fraction, MOST_WORK, Polynomial, fraction, fraction_of};

/// A denested root, with variables that stand for values at places.
#[derive(Clone, Debug)]
pub enum DenestedRoot {
    /// √c |p/q|; undefined where c is negative.
    Square(Rational, Fraction),
    /// |√u + b y/(2√u)|/|q|, where y is the root at a place.
    Sum {
        /// Polynomial u.
        first: Polynomial,
        /// Coefficient b.
        factor: Polynomial,
        /// Place of y.
        root: usize,
        /// Denominator q.
        below: Polynomial,
    },
    /// √p/|q|, where p contains no roots.
    Plain {
        /// Radicand p.
        radicand: Polynomial,
        /// Denominator q.
        below: Polynomial,
    },
}

/// A value that is c b² with a number c and a quotient b of polynomials in values at places.
#[derive(Clone, Debug)]
pub struct SquareRoot {
    scale: Rational,
    root: Fraction,
}

impl SquareRoot {
    /// Finds the square that a value is, if it is one.
    pub fn of(graph: &Graph, value: Expr) -> Option<Self> {
        let (scale, root) = product(graph, &[graph.place(value)], &variable)?.square()?;
        Some(Self { scale, root })
    }

    /// Whether the value is nowhere positive.
    pub fn is_negative(&self) -> bool {
        self.scale.is_negative()
    }

    /// Records √c b, one of the two roots of the value where c is not negative, from the values at
    /// places.
    pub fn value(&self, at: impl Fn(usize) -> Option<Expr>) -> Option<Expr> {
        let scale = Expr::rational(&self.scale).apply(UnaryFunction::Sqrt);
        Some(scale * self.root.value(&|variable: u32| at(variable as usize))?)
    }
}

/// Denests the root of the product of the values at some places, if it is a square or has the form
/// of a sum.
///
/// `others` are the places of roots that the value may be expressed by.
pub fn written(graph: &Graph, places: &[usize], others: &[usize]) -> Option<DenestedRoot> {
    let roots = roots_of_inputs(graph, places);
    let by_roots = |place: usize, step: Step<'_>| match step {
        // x is y² if y = √x occurs too.
        Step::Input(_) => match roots.iter().find(|(input, _)| *input == place) {
            Some((_, root)) => {
                let y = Polynomial::variable(*root as u32);
                y.times(&y, &mut { 1 })
            }
            None => Some(Polynomial::variable(place as u32)),
        },
        _ => variable(place, step),
    };
    let product = product(graph, places, &by_roots)?;
    if let Some((scale, root)) = product.square() {
        return Some(DenestedRoot::Square(scale, root));
    }
    let product = self::product(graph, places, &variable)?;
    let (above, below) = (product.over_square()?, product.below);
    let square_of = |root: u32| match graph.step(root as usize) {
        Step::Unary(UnaryFunction::Sqrt, a) => fraction(graph, a, &variable)?.polynomial(),
        _ => None,
    };
    let roots: Vec<(u32, Polynomial)> =
        others.iter().filter_map(|root| Some((*root as u32, square_of(*root as u32)?))).collect();
    let sum = above.variables().into_iter().rev().find_map(|root| {
        let square = square_of(root)?;
        let [even, odd] = above.split(root, &square)?;
        let first = first_of_sum(&even, &odd, &square, &roots)?;
        let (root, below) = (root as usize, below.clone());
        Some(DenestedRoot::Sum { first, factor: odd, root, below })
    });
    let sum = sum.or_else(|| {
        let by_roots = inputs_by_roots(graph, places);
        let given = |at: usize, step: Step<'_>| match step {
            Step::Input(_) => Some(
                by_roots
                    .get(&at)
                    .cloned()
                    .unwrap_or_else(|| Fraction::whole(Polynomial::variable(at as u32))),
            ),
            step => variable(at, step).map(Fraction::whole),
        };
        let factors: Option<Vec<Fraction>> =
            places.iter().map(|place| fraction_of(graph, *place, &given)).collect();
        let (scale, root) = Fraction::product(factors?.iter())?.square()?;
        Some(DenestedRoot::Square(scale, root.without_common_terms()?))
    });
    // (a + b√C)(a − b√C) contains no root.
    sum.or_else(|| {
        let radicand = without_roots(graph, above, square_of)?;
        (places.len() > 1).then_some(DenestedRoot::Plain { radicand, below })
    })
}

/// Replaces all roots, if they occur in even powers only, by their radicands.
fn without_roots(
    graph: &Graph,
    mut polynomial: Polynomial,
    square_of: impl Fn(u32) -> Option<Polynomial>,
) -> Option<Polynomial> {
    let is_root = |variable: &u32| graph.step(*variable as usize).is_root();
    // The last root first: it may contain those before it.
    while let Some(root) = polynomial.variables().into_iter().rev().find(is_root) {
        let [even, odd] = polynomial.split(root, &square_of(root)?)?;
        if !odd.is_zero() {
            return None;
        }
        polynomial = even;
    }
    Some(polynomial)
}

/// Finds u = (a + d)/2 with d² = a² - b² C, u ≠ 0.
fn first_of_sum(
    a: &Polynomial,
    b: &Polynomial,
    square: &Polynomial,
    roots: &[(u32, Polynomial)],
) -> Option<Polynomial> {
    if b.is_zero() {
        return None;
    }
    let mut work = MOST_WORK;
    let product = b.times(b, &mut work)?.times(square, &mut work)?;
    let difference = a.times(a, &mut work)?.plus(&product.scaled(&Rational::from(-1)));
    let root = match difference.is_zero() {
        true => difference,
        false => match root_of(&difference) {
            Some(root) => root,
            None => return roots.iter().find_map(|own| half_with(a, &difference, own, roots)),
        },
    };
    let halves = halves(a, &root);
    // A square needs no further root.
    let order = |u: &Polynomial| (u.square().is_none(), u.size());
    halves.into_iter().filter(|u| !u.is_zero()).min_by_key(order)
}

/// Returns (a + d)/2 and (a − d)/2.
fn halves(a: &Polynomial, d: &Polynomial) -> [Polynomial; 2] {
    [1, -1].map(|sign| a.plus(&d.scaled(&Rational::from(sign))).scaled(&Rational::new(1, 2)))
}

/// Finds u = (a ± d)/2 for the root d of a difference by another one, if √u is a multiple of a
/// further root: otherwise roots would be written by each other.
fn half_with(
    a: &Polynomial,
    difference: &Polynomial,
    own: &(u32, Polynomial),
    roots: &[(u32, Polynomial)],
) -> Option<Polynomial> {
    let halves = halves(a, &root_by(difference, own)?);
    let is_known = |u: &Polynomial| {
        let ratio = |(_, radicand): &(u32, Polynomial)| radicand.term_over(u)?.number();
        roots.iter().filter_map(ratio).any(|ratio| !ratio.is_negative())
    };
    halves.into_iter().find(|u| !u.is_zero() && is_known(u))
}

/// Finds d with d² = p.
fn root_of(polynomial: &Polynomial) -> Option<Polynomial> {
    let (scale, root) = polynomial.square()?;
    Some(root.scaled(&square_root(&scale)?))
}

/// Finds d = q y with d² = p, for a root y with a given square and a term q.
fn root_by(polynomial: &Polynomial, (root, square): &(u32, Polynomial)) -> Option<Polynomial> {
    // p y² = (q y²)²
    let factor = root_of(&polynomial.times(square, &mut { MOST_WORK })?)?.term_over(square)?;
    factor.times(&Polynomial::variable(*root), &mut { MOST_WORK })
}

/// Lists the inputs under a root among the places that some others need, each with one of its
/// roots.
fn roots_of_inputs(graph: &Graph, places: &[usize]) -> Vec<(usize, usize)> {
    let reached = graph.reached_from(places);
    let steps = graph.steps().enumerate().filter(|(place, _)| reached[*place]);
    steps
        .filter_map(|(place, step)| match step {
            Step::Unary(UnaryFunction::Sqrt, a) if matches!(graph.step(a), Step::Input(_)) => {
                Some((a, place))
            }
            _ => None,
        })
        .collect()
}

/// Makes a variable for a step that is not a rational operation.
pub fn variable(place: usize, step: Step<'_>) -> Option<Polynomial> {
    let is_rational = match step {
        Step::Constant(_) | Step::Unary(UnaryFunction::Neg | UnaryFunction::Recip, _) => true,
        Step::Binary(operation, ..) => operation != BinaryOperation::Pow,
        Step::Power(_, exponent) => exponent.to_integer().is_some(),
        Step::Input(_) | Step::Unary(..) => false,
    };
    (!is_rational).then(|| Polynomial::variable(place as u32))
}

fn product(
    graph: &Graph,
    places: &[usize],
    given: &impl Fn(usize, Step<'_>) -> Option<Polynomial>,
) -> Option<Fraction> {
    let factors: Option<Vec<Fraction>> =
        places.iter().map(|place| fraction(graph, *place, given)).collect();
    Fraction::product(factors?.iter())
}

impl DenestedRoot {
    /// Returns the places of its variables.
    pub fn places(&self) -> Vec<usize> {
        let (polynomials, root) = match self {
            DenestedRoot::Square(_, root) => ([&root.above, &root.below, &root.below], None),
            DenestedRoot::Sum { first, factor, root, below } => {
                ([first, factor, below], Some(*root))
            }
            DenestedRoot::Plain { radicand, below } => ([radicand, below, below], None),
        };
        let variables = polynomials.into_iter().flat_map(Polynomial::variables);
        variables.map(|variable| variable as usize).chain(root).collect()
    }

    /// Records the root from the values at places; `None` where it is not real.
    pub fn value(&self, at: impl Fn(usize) -> Option<Expr>) -> Option<Expr> {
        let of = |variable: u32| at(variable as usize);
        match self {
            DenestedRoot::Square(scale, _) if scale.is_negative() => None,
            DenestedRoot::Square(scale, root) => {
                let scale = Expr::rational(scale).apply(UnaryFunction::Sqrt);
                Some(scale * root.value(&of)?.modulus())
            }
            DenestedRoot::Sum { first, factor, root, below } => {
                let u = first.value(&of)?.apply(UnaryFunction::Sqrt);
                let doubled = u + u;
                let sum = u + factor.value(&of)? * at(*root)? / doubled;
                Some(sum.modulus() / below.value(&of)?.modulus())
            }
            DenestedRoot::Plain { radicand, below } => {
                let root = radicand.value(&of)?.apply(UnaryFunction::Sqrt);
                Some(root / below.value(&of)?.modulus())
            }
        }
    }
}
