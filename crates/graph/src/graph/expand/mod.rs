//! Expansions of recorded values as one of their inputs tends to 0, within their own recording.
//!
//! The input is ±δ^q with δ > 0. Each operation between a value and the input is done on expansions
//! in powers of δ and of ln δ, times an exponential of 1/δ, whose coefficients are recorded values. docs/soundness.md, "Limits".

mod scaled;
mod series;

use num_dual::DualNum;
use rustc_hash::FxHashMap;

use super::{Expr, Graph, Node, NodeId, with_graph};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

use scaled::Scaled;
use series::{Arithmetic, Failure, Series};

/// Numbers q, tried one after the other: roots of the input are powers of δ.
const ROOTS: [i32; 3] = [1, 2, 4];
/// Numbers of orders of the input that are kept, tried one after the other.
const ORDERS: [i32; 2] = [4, 10];
/// Largest number of signs that are supposed together.
const MOST_SIGNS: usize = 3;
/// Largest number of operations that are expanded.
const MOST_STEPS: usize = 2000;

/// The side from which an input tends to 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From above.
    Above,
    /// From below.
    Below,
}

/// Terms of an expansion up to some order.
#[derive(Clone, Debug)]
pub struct Expansion<T> {
    /// Coefficients of the powers of the input's size and of its logarithm.
    pub terms: Vec<Term<T>>,
    /// Values that exist where the expanded value does for small inputs.
    pub guards: Vec<T>,
    /// Values of which one is 0 where the expansion does not hold: |c| + c, if it supposes that c is positive.
    pub weights: Vec<T>,
}

/// A term c |ε|^a (ln |ε|)^b of an expansion.
#[derive(Clone, Debug)]
pub struct Term<T> {
    /// Exponent a.
    pub order: Rational,
    /// Exponent b.
    pub logarithms: i32,
    /// Coefficient c.
    pub coefficient: T,
}

/// Result of an expansion.
#[derive(Clone, Debug)]
pub enum Expanded<T> {
    /// All terms up to the order asked for, for each choice of the signs on which they depend.
    Terms(Vec<Expansion<T>>),
    /// No value for small inputs.
    Void,
    /// No expansion.
    Unknown,
}

/// A step with its places, copied from the recording under way.
#[derive(Clone, Debug)]
enum Copied {
    Variable,
    Unary(UnaryFunction, usize),
    Binary(BinaryOperation, usize, usize),
    Power(usize, Rational),
}

/// Steps that depend on the variable, in order, by place.
struct Dependent {
    session: u32,
    steps: Vec<(usize, Copied)>,
}

impl Graph {
    /// Copies the steps between a value and an input; `None` if it is no input, if there are too
    /// many, or if one of them is an antiderivative, which may depend on the input unseen.
    fn between(&self, value: NodeId, variable: NodeId) -> Option<Dependent> {
        if !matches!(self.nodes[variable.0 as usize], Node::Input(_)) {
            return None;
        }
        let reached = self.reached_from(&[value.0 as usize]);
        let mut depends = vec![false; value.0 as usize + 1];
        let mut steps = Vec::new();
        for place in (0..=value.0 as usize).filter(|place| reached[*place]) {
            let of = |a: NodeId| a.0 as usize;
            let (arguments, step) = match self.nodes[place] {
                Node::Input(_) if place == of(variable) => (true, Copied::Variable),
                Node::Input(index) if self.antiderivatives.values().any(|own| *own == index) => {
                    return None;
                }
                Node::Constant(_) | Node::Input(_) => continue,
                Node::Unary(function, a) => (depends[of(a)], Copied::Unary(function, of(a))),
                Node::Binary(operation, a, b) => {
                    (depends[of(a)] || depends[of(b)], Copied::Binary(operation, of(a), of(b)))
                }
                Node::Power(a, exponent) => {
                    let exponent = self.constants[exponent as usize].clone();
                    (depends[of(a)], Copied::Power(of(a), exponent))
                }
            };
            if arguments {
                depends[place] = true;
                steps.push((place, step));
            }
        }
        (steps.len() <= MOST_STEPS).then_some(Dependent { session: self.session, steps })
    }
}

/// Expands a recorded value up to and including the order `order` of the input, as the input tends
/// to 0 from one side.
pub fn expansion(value: Expr, variable: Expr, side: Side, order: i32) -> Expanded<Expr> {
    let dependent = with_graph(|graph| {
        let own = |expr: Expr| (expr.session() == graph.session).then(|| expr.id()).flatten();
        let (value, variable) = (own(value)?, own(variable)?);
        Some((value, graph.between(value, variable)?))
    });
    let Some((value, dependent)) = dependent else { return Expanded::Unknown };
    dependent.by_signs(value, (side, order), &[])
}

impl Dependent {
    /// Expands for each choice of signs that is needed; those in `supposed` are chosen.
    fn by_signs(
        &self,
        value: NodeId,
        (side, order): (Side, i32),
        supposed: &[(Expr, bool)],
    ) -> Expanded<Expr> {
        let mut last = Failure::Form;
        for root in ROOTS {
            for orders in ORDERS {
                let mut arithmetic = Arithmetic {
                    orders: (orders + order) * root,
                    guards: Vec::new(),
                    supposed: supposed.to_vec(),
                    open: None,
                };
                let found = self.expanded(value, side, root, &mut arithmetic);
                match found.map(|(series, guards)| (series.before(order * root + 1), guards)) {
                    Ok((Some(terms), guards)) => {
                        let terms = terms.into_iter().map(|own| term(own, root)).collect();
                        let weight = |(own, is_positive): &(Expr, bool)| match is_positive {
                            true => own.modulus() + *own,
                            false => own.modulus() - *own,
                        };
                        let weights = supposed.iter().map(weight).collect();
                        return Expanded::Terms(vec![Expansion { terms, guards, weights }]);
                    }
                    Ok((None, _)) => last = Failure::Terms,
                    Err(Failure::Sign) => {
                        return match arithmetic.open {
                            Some(open) => self.split(value, (side, order), supposed, open),
                            None => Expanded::Unknown,
                        };
                    }
                    Err(failure) => last = failure,
                }
                if last != Failure::Terms {
                    break;
                }
            }
            if last != Failure::Root {
                break;
            }
        }
        match last {
            Failure::NoValue => Expanded::Void,
            Failure::Root | Failure::Terms | Failure::Form | Failure::Sign => Expanded::Unknown,
        }
    }

    /// Expands for both signs of a value.
    fn split(
        &self,
        value: NodeId,
        at: (Side, i32),
        supposed: &[(Expr, bool)],
        open: Expr,
    ) -> Expanded<Expr> {
        if supposed.len() >= MOST_SIGNS {
            return Expanded::Unknown;
        }
        let with = |is_positive: bool| {
            self.by_signs(value, at, &[supposed, &[(open, is_positive)]].concat())
        };
        match (with(true), with(false)) {
            (Expanded::Terms(mut all), Expanded::Terms(others)) => {
                all.extend(others);
                Expanded::Terms(all)
            }
            (Expanded::Void, Expanded::Void) => Expanded::Void,
            _ => Expanded::Unknown,
        }
    }
}

/// A term in the size of the input, of which δ is the root.
fn term(((i, logarithms), coefficient): ((i32, i32), Expr), root: i32) -> Term<Expr> {
    // ln δ is the logarithm of the input's size over q.
    let scale = Rational::from(i64::from(root)).powi(-logarithms);
    let scale = scale.unwrap_or_else(|| Rational::from(1));
    Term {
        order: Rational::new(i64::from(i), i64::from(root)),
        logarithms,
        coefficient: coefficient * Expr::rational(&scale),
    }
}

impl Dependent {
    fn expanded(
        &self,
        value: NodeId,
        side: Side,
        root: i32,
        arithmetic: &mut Arithmetic,
    ) -> Result<(Series, Vec<Expr>), Failure> {
        let mut made: FxHashMap<usize, Scaled> = FxHashMap::default();
        let fixed = |place: usize| Expr::of(self.session, NodeId(place as u32));
        let mut guards: Vec<Expr> = Vec::new();
        let mut at = |made: &FxHashMap<usize, Scaled>, place: usize| match made.get(&place) {
            Some(series) => series.clone(),
            None => {
                let value = fixed(place);
                if !value.is_always_defined() && !guards.contains(&value) {
                    guards.push(value);
                }
                Series::constant(value).into()
            }
        };
        for (place, step) in &self.steps {
            let series = match step {
                Copied::Variable => {
                    let sign = if side == Side::Above { 1 } else { -1 };
                    Series::term(Expr::rational(&Rational::from(sign)), (root, 0)).into()
                }
                Copied::Unary(function, a) => arithmetic.unary(*function, &at(&made, *a))?,
                Copied::Power(a, exponent) => arithmetic.power_by(&at(&made, *a), exponent)?,
                Copied::Binary(operation, a, b) => {
                    let (a, b) = (at(&made, *a), at(&made, *b));
                    arithmetic.binary(*operation, &a, &b)?
                }
            };
            made.insert(*place, series);
        }
        let series = at(&made, value.0 as usize);
        let series = arithmetic.decisive(&series)?;
        guards.append(&mut arithmetic.guards);
        // A sign that is supposed is one of a value other than 0.
        for (own, _) in &arithmetic.supposed {
            guards.push(own.recip());
        }
        Ok((series, guards))
    }
}
