//! Sums of values that are nowhere negative: a (x − y)² + |z| for a > 0 is 0 where x = y and z = 0.
//!
//! docs/soundness-levels.md, "Sums that are nowhere negative", states the rule.

use super::Formula;
use super::arena::{Arena, ElementaryFunction, NodeId, NodeOperation};
use super::entries_of::Entries;
use super::expanded::same;
use super::kind::Type;
use super::scope::Symbol;
use super::simple_factors::symbol;
use crate::proof::KnownSign;

/// Largest number of nodes of a formula that is read.
const MOST_NODES: usize = 600;
/// Largest number of values that are looked at, some of them again.
const MOST_LOOKS: usize = 4000;
/// Largest number of equations in the place of one.
const MOST_EQUATIONS: usize = 16;

/// Products of nodes that are all 0 where a value is: none where it is always, and one without factors where it
/// never is.
type Zeros = Vec<Vec<NodeId>>;

impl Formula {
    /// Returns formulas that are all 0 at exactly the points at which this one is, a sum of values of one sign;
    /// they have values where it has, and it has one where they have. `None` if it is no such sum of several.
    /// `sign` gives the sign of a symbol, and `is_total` tells which have a value everywhere.
    pub(crate) fn as_definite_sum(
        &self,
        sign: &dyn Fn(Symbol) -> Option<KnownSign>,
        is_total: &dyn Fn(Symbol) -> bool,
    ) -> Option<Vec<Formula>> {
        let whole = self.arena.nodes.len().checked_sub(1)?;
        if whole >= MOST_NODES || self.value_type() != Type::Scalar {
            return None;
        }
        let arena = self.arena.clone();
        let mut reading = Definite { same: same(&arena), arena, sign, looks: 0 };
        let zeros = match reading.zeros(whole, false) {
            Some(zeros) => zeros,
            None => reading.zeros(whole, true)?,
        };
        let is_several = (2..=MOST_EQUATIONS).contains(&zeros.len());
        if !is_several || zeros.iter().any(Vec::is_empty) {
            return None;
        }
        let kept = reading.arena.reached(zeros.iter().flatten().copied());
        let written = reading.arena.reached([whole]);
        for node in (0..=whole).filter(|node| written[*node] && !kept[*node]) {
            if !reading.is_total(node, is_total) {
                return None;
            }
        }
        let of = |factors: Vec<NodeId>| {
            let mut arena = reading.arena.clone();
            let last = factors
                .into_iter()
                .reduce(|a, b| arena.scalar(NodeOperation::Multiply(a, b), whole))?;
            Some(Formula { text: self.text.clone(), arena: arena.ending_at(last) })
        };
        zeros.into_iter().map(of).collect()
    }
}

/// The reading of a formula as a sum of values of one sign.
struct Definite<'s> {
    arena: Arena,
    /// The first node with the same value, of each node of the formula.
    same: Vec<NodeId>,
    sign: &'s dyn Fn(Symbol) -> Option<KnownSign>,
    looks: usize,
}

impl Definite<'_> {
    /// Finds where a value is 0 that is nowhere negative, or nowhere positive; `None` if it is not known to be so.
    fn zeros(&mut self, node: NodeId, is_negative: bool) -> Option<Zeros> {
        use NodeOperation::{
            Add, Constant, Divide, Dot, Function, Multiply, Negate, Number, Power, Product,
            Subtract, Sum, Trace, Zero,
        };
        self.looks += 1;
        if self.looks > MOST_LOOKS || node >= self.same.len() {
            return None;
        }
        let never = || Some(vec![Vec::new()]);
        let found = match self.arena.nodes[node].operation.clone() {
            Number(value) if value.is_zero() => Some(Vec::new()),
            Number(value) => return (value.is_negative() == is_negative).then(never)?,
            Zero => Some(Vec::new()),
            Negate(a) => return self.zeros(a, !is_negative),
            Add(a, b) => return self.both(&[(a, is_negative), (b, is_negative)]),
            Subtract(a, b) => return self.both(&[(a, is_negative), (b, !is_negative)]),
            Sum(all) => {
                let all: Vec<(NodeId, bool)> = all.iter().map(|own| (*own, is_negative)).collect();
                return self.both(&all);
            }
            Multiply(..) | Product(_) => return self.product(node, is_negative),
            Divide(a, b) => {
                let is_above = self.zeros(b, false) == never();
                let is_below = !is_above && self.zeros(b, true) == never();
                return match is_above || is_below {
                    true => self.zeros(a, is_negative != is_below),
                    false => None,
                };
            }
            Power(a, exponent) if exponent.to_integer().is_some_and(|n| n > 0 && n % 2 == 1) => {
                return self.zeros(a, is_negative);
            }
            _ if is_negative => return self.of_symbol(node, is_negative),
            Constant(_) => never(),
            Power(a, exponent) if exponent.to_integer().is_some_and(|n| n > 0) => {
                Some(self.of_either_sign(a))
            }
            Power(a, exponent) if exponent.to_integer().is_none() && !exponent.is_negative() => {
                Some(self.zeros(a, false).unwrap_or_else(|| vec![vec![node]]))
            }
            Function(ElementaryFunction::Sqrt, a) => {
                Some(self.zeros(a, false).unwrap_or_else(|| vec![vec![node]]))
            }
            Function(ElementaryFunction::Modulus, a) => Some(self.of_either_sign(a)),
            Function(ElementaryFunction::Exp | ElementaryFunction::Cosh, _) => never(),
            Dot(a, b) if self.same[a] == self.same[b] => self.entries(a),
            Trace(of) => self.trace(of),
            _ => self.of_symbol(node, is_negative),
        };
        found.filter(|found| found.len() <= MOST_EQUATIONS)
    }

    /// Finds where several values are all 0.
    fn both(&mut self, all: &[(NodeId, bool)]) -> Option<Zeros> {
        let mut found = Zeros::new();
        for (node, is_negative) in all {
            found.extend(self.zeros(*node, *is_negative)?);
        }
        // Where one of them is never 0, the sum is not.
        if found.iter().any(Vec::is_empty) {
            found = vec![Vec::new()];
        }
        (found.len() <= MOST_EQUATIONS).then_some(found)
    }

    /// Finds where a value is 0 whose square or modulus is looked at.
    fn of_either_sign(&mut self, node: NodeId) -> Zeros {
        let found = self.zeros(node, false).or_else(|| self.zeros(node, true));
        found.unwrap_or_else(|| vec![vec![node]])
    }

    /// Finds where a product is 0: factors that stand twice are squares, and the others have signs.
    fn product(&mut self, node: NodeId, is_negative: bool) -> Option<Zeros> {
        let mut factors: Vec<(NodeId, usize)> = Vec::new();
        let (mut open, mut is_below) = (vec![node], false);
        while let Some(own) = open.pop() {
            match &self.arena.nodes[own].operation {
                NodeOperation::Multiply(a, b) => open.extend([*b, *a]),
                NodeOperation::Product(all) => open.extend(all.iter().rev()),
                NodeOperation::Negate(a) => {
                    is_below = !is_below;
                    open.push(*a);
                }
                _ => {
                    match factors.iter_mut().find(|(other, _)| self.same[*other] == self.same[own])
                    {
                        Some((_, count)) => *count += 1,
                        None => factors.push((own, 1)),
                    }
                }
            }
            if factors.len() > MOST_EQUATIONS {
                return None;
            }
        }
        let mut found: Zeros = vec![Vec::new()];
        for (own, count) in factors {
            let zeros = match count % 2 == 0 {
                true => self.of_either_sign(own),
                false => match self.zeros(own, false) {
                    Some(zeros) => zeros,
                    None => {
                        is_below = !is_below;
                        self.zeros(own, true)?
                    }
                },
            };
            // A product is 0 where one factor is: where all products of what is 0 for each are.
            let pairs = found.iter().flat_map(|one| {
                zeros.iter().map(move |other| [one.as_slice(), other.as_slice()].concat())
            });
            found = pairs.collect();
            if found.len() > MOST_EQUATIONS {
                return None;
            }
        }
        (is_below == is_negative).then_some(found)
    }

    fn of_symbol(&self, node: NodeId, is_negative: bool) -> Option<Zeros> {
        let known = (self.sign)(symbol(&self.arena, node)?)?;
        (known.is_positive != is_negative).then(|| match known.may_vanish {
            true => vec![vec![node]],
            false => vec![Vec::new()],
        })
    }

    /// Finds where tr(AᵀA) is 0, or tr(SS) of a symmetric matrix S.
    fn trace(&mut self, of: NodeId) -> Option<Zeros> {
        let NodeOperation::Compose(a, b) = self.arena.nodes[of].operation else { return None };
        let is_transpose = |one: NodeId, other: NodeId| match self.arena.nodes[one].operation {
            NodeOperation::Transpose(of) => self.same[of] == self.same[other],
            _ => false,
        };
        let is_square = is_transpose(a, b)
            || is_transpose(b, a)
            || self.same[a] == self.same[b] && self.is_symmetric(a);
        if is_square { self.entries(b) } else { None }
    }

    /// Whether the form of a matrix shows that it is symmetric.
    fn is_symmetric(&self, node: NodeId) -> bool {
        match self.arena.nodes[node].operation {
            NodeOperation::Identity | NodeOperation::Zero | NodeOperation::Diagonal(_) => true,
            NodeOperation::Add(a, b) | NodeOperation::Subtract(a, b) => {
                self.is_symmetric(a) && self.is_symmetric(b)
            }
            NodeOperation::Negate(a) | NodeOperation::Scale(_, a) | NodeOperation::Transpose(a) => {
                self.is_symmetric(a)
            }
            NodeOperation::Compose(a, b) => {
                let is_transpose = |one: NodeId, other: NodeId| matches!(self.arena.nodes[one].operation, NodeOperation::Transpose(of) if self.same[of] == self.same[other]);
                is_transpose(a, b) || is_transpose(b, a)
            }
            _ => false,
        }
    }

    /// Finds where all entries of a vector or a matrix are 0.
    fn entries(&mut self, node: NodeId) -> Option<Zeros> {
        let places = self.arena.nodes[node].value_type.places();
        if places.len() > MOST_EQUATIONS {
            return None;
        }
        let mut made = Entries::of(&mut self.arena, node);
        places.iter().map(|place| Some(vec![made.entry(node, place)?])).collect()
    }

    /// Whether an operation has a value wherever its arguments have one.
    fn is_total(&mut self, node: NodeId, is_total: &dyn Fn(Symbol) -> bool) -> bool {
        use ElementaryFunction::{Asinh, Atan, Cos, Cosh, Exp, Modulus, Sin, Sinh, Sqrt, Tanh};
        match self.arena.nodes[node].operation.clone() {
            NodeOperation::Symbol(slot) => {
                self.arena.symbols.get(slot).is_some_and(|(symbol, _)| is_total(*symbol))
            }
            NodeOperation::Function(function, a) => match function {
                Sqrt => self.zeros(a, false).is_some(),
                _ => matches!(
                    function,
                    Atan | Asinh | Cos | Cosh | Exp | Modulus | Sin | Sinh | Tanh
                ),
            },
            NodeOperation::Power(a, exponent) => match exponent.to_integer() {
                Some(whole) => whole >= 0,
                None => !exponent.is_negative() && self.zeros(a, false).is_some(),
            },
            NodeOperation::Divide(_, b) => {
                let never = Some(vec![Vec::new()]);
                self.zeros(b, false) == never || self.zeros(b, true) == never
            }
            NodeOperation::PowerOf(..)
            | NodeOperation::Inverse(_)
            | NodeOperation::Solve(..)
            | NodeOperation::Angle(..)
            | NodeOperation::Antiderivative(..)
            | NodeOperation::Partial { .. } => false,
            _ => true,
        }
    }
}
