//! Factors of a formula that is written out: a² − 3ab + 2b² is (a − b)(a − 2b), where a and b may be (M,γ) and
//! (γ,γ).

use super::arena::{Arena, ElementaryFunction, NodeId, NodeOperation};
use super::kind::Type;
use crate::number::rational::Rational;
use crate::proof::{MOST_POLYNOMIAL_WORK, Polynomial};

/// Largest power that is multiplied out.
const MOST_POWER: i64 = 16;
/// Largest number of nodes of a formula that is read.
const MOST_NODES: usize = 1000;

/// A scalar as a polynomial in parts that are no sums and no products.
pub(super) struct Reading<'a> {
    arena: &'a Arena,
    /// The first node with the same value, of each node.
    same: Vec<NodeId>,
    /// Parts, by variable.
    pub parts: Vec<NodeId>,
    work: usize,
}

impl Arena {
    /// Appends factors of a node, of which one is 0 where it is, and no others; `None` if there is but one.
    pub fn expanded_factors(&mut self, node: NodeId) -> Option<Vec<NodeId>> {
        let mut reading = Reading::of(self)?;
        let whole = reading.polynomial(node)?;
        let parts = reading.parts;
        let factors = whole.factors();
        let is_whole = factors.len() == 1 && factors.first() == whole.monic().as_ref();
        if factors.is_empty() || is_whole {
            return None;
        }
        Some(factors.iter().map(|factor| self.push_polynomial(factor, &parts, node)).collect())
    }

    /// Appends a polynomial in some parts, as it is written out.
    pub(super) fn push_polynomial(
        &mut self,
        polynomial: &Polynomial,
        parts: &[NodeId],
        of: NodeId,
    ) -> NodeId {
        let span = self.nodes[of].span.clone();
        let mut push = |operation| self.push(operation, Type::Scalar, span.clone());
        let mut sum: Option<NodeId> = None;
        for (value, exponents) in polynomial.terms().rev() {
            let mut product = None;
            for (variable, power) in exponents {
                let part = parts[*variable as usize];
                let own = match power {
                    1 => part,
                    power => push(NodeOperation::Power(part, Rational::from(i64::from(*power)))),
                };
                product = Some(match product {
                    None => own,
                    Some(before) => push(NodeOperation::Multiply(before, own)),
                });
            }
            let term = match product {
                Some(product) if value.is_one() => product,
                Some(product) => {
                    let number = push(NodeOperation::Number(value.clone()));
                    push(NodeOperation::Multiply(number, product))
                }
                None => push(NodeOperation::Number(value.clone())),
            };
            sum = Some(match sum {
                None => term,
                Some(before) => push(NodeOperation::Add(before, term)),
            });
        }
        sum.unwrap_or_else(|| push(NodeOperation::Number(Rational::from(0))))
    }
}

/// Returns, for each node, the first one of the same operation on the same values.
pub(super) fn same(arena: &Arena) -> Vec<NodeId> {
    let mut same: Vec<NodeId> = Vec::new();
    let mut known: Vec<(NodeOperation, NodeId)> = Vec::new();
    for (id, node) in arena.nodes.iter().enumerate() {
        let own = node.operation.on(|other| same[other]);
        let is_same = |(operation, first): &&(NodeOperation, NodeId)| {
            *operation == own && arena.nodes[*first].value_type == node.value_type
        };
        let first = known.iter().find(is_same).map(|(_, first)| *first);
        if first.is_none() {
            known.push((own, id));
        }
        same.push(first.unwrap_or(id));
    }
    same
}

impl<'a> Reading<'a> {
    /// Begins the reading of nodes of a formula; `None` if it is large.
    pub fn of(arena: &'a Arena) -> Option<Self> {
        let is_small = arena.nodes.len() <= MOST_NODES;
        is_small.then(|| Self {
            same: same(arena),
            arena,
            parts: Vec::new(),
            work: MOST_POLYNOMIAL_WORK,
        })
    }

    /// Whether two nodes have the same value.
    pub fn is_same(&self, one: NodeId, other: NodeId) -> bool {
        self.same[one] == self.same[other]
    }

    /// Reads a node as a polynomial, or as one part if it is too large.
    pub fn polynomial_or_part(&mut self, node: NodeId) -> Option<Polynomial> {
        let before = self.parts.len();
        let found = self.polynomial(node);
        if found.is_none() {
            self.parts.truncate(before);
        }
        found.or_else(|| self.part(node))
    }

    /// Lists what a sum, product or power is made of; `None` if the node is a part.
    fn arguments(&self, node: NodeId) -> Option<Vec<NodeId>> {
        Some(match &self.arena.nodes[node].operation {
            NodeOperation::Number(_) | NodeOperation::Zero => Vec::new(),
            NodeOperation::Negate(a) => vec![*a],
            NodeOperation::Add(a, b) | NodeOperation::Subtract(a, b) => vec![*a, *b],
            NodeOperation::Multiply(a, b) => vec![*a, *b],
            NodeOperation::Divide(a, b) if self.arena.constant(*b).is_some() => vec![*a],
            NodeOperation::Sum(all) | NodeOperation::Product(all) => all.to_vec(),
            NodeOperation::Power(a, exponent) => {
                let exponent = exponent.to_integer()?;
                if !(0..=MOST_POWER).contains(&exponent) {
                    return None;
                }
                // X⁰ has a value where X has one.
                if exponent == 0 {
                    return Some(vec![*a]);
                }
                // |v|² is (v,v).
                match self.arena.squared_norm(*a).filter(|_| exponent % 2 == 0) {
                    Some(square) => vec![square; usize::try_from(exponent / 2).ok()?],
                    None => vec![*a; usize::try_from(exponent).ok()?],
                }
            }
            _ => return None,
        })
    }

    fn polynomial(&mut self, node: NodeId) -> Option<Polynomial> {
        let mut is_needed = vec![false; node + 1];
        is_needed[node] = true;
        for own in (0..=node).rev() {
            if is_needed[own] {
                self.arguments(own).into_iter().flatten().for_each(|other| is_needed[other] = true);
            }
        }
        let mut values: Vec<Option<Polynomial>> = Vec::new();
        for (own, is_needed) in is_needed.into_iter().enumerate() {
            let value = match (is_needed, self.arguments(own)) {
                (false, _) => None,
                (true, None) => self.part(own),
                (true, Some(all)) => {
                    let of = |other: NodeId| values[other].as_ref();
                    let all = all.into_iter().map(of).collect::<Option<Vec<&Polynomial>>>()?;
                    self.made(own, &all)
                }
            };
            values.push(value);
        }
        values.pop()?
    }

    fn made(&mut self, node: NodeId, of: &[&Polynomial]) -> Option<Polynomial> {
        let one = Rational::from(1);
        let sum = |sign: &Rational| match of {
            [first, rest @ ..] => {
                rest.iter().fold((*first).clone(), |sum, own| sum.plus(&own.scaled(sign)))
            }
            [] => Polynomial::default(),
        };
        match &self.arena.nodes[node].operation {
            NodeOperation::Number(value) => Some(Polynomial::constant(value)),
            NodeOperation::Power(_, exponent) if exponent.is_zero() => {
                Some(Polynomial::constant(&one))
            }
            NodeOperation::Negate(_) => Some(of.first()?.scaled(&-&one)),
            NodeOperation::Zero | NodeOperation::Add(..) | NodeOperation::Sum(_) => Some(sum(&one)),
            NodeOperation::Subtract(..) => Some(sum(&-&one)),
            NodeOperation::Divide(_, b) => {
                Some(of.first()?.scaled(&self.arena.constant(*b)?.recip()?))
            }
            _ => of.iter().try_fold(Polynomial::constant(&one), |product, own| {
                product.times(own, &mut self.work)
            }),
        }
    }

    fn part(&mut self, node: NodeId) -> Option<Polynomial> {
        // e^(2u) is (e^u)².
        if let Some((other, power)) = self.as_power(node) {
            let base = self.part(other)?;
            let one = Polynomial::constant(&Rational::from(1));
            return (0..power).try_fold(one, |all, _| all.times(&base, &mut self.work));
        }
        let first = self.same[node];
        let index = self.parts.iter().position(|own| *own == first).unwrap_or(self.parts.len());
        if index == self.parts.len() {
            self.parts.push(first);
        }
        u32::try_from(index).ok().map(Polynomial::variable)
    }

    /// Returns a node e^u, and n, of a node e^(nu).
    fn as_power(&self, node: NodeId) -> Option<(NodeId, i64)> {
        let exponent = |node: NodeId| match self.arena.nodes[node].operation {
            NodeOperation::Function(ElementaryFunction::Exp, exponent) => Some(exponent),
            _ => None,
        };
        let NodeOperation::Multiply(a, b) = self.arena.nodes[exponent(node)?].operation else {
            return None;
        };
        let times = self.arena.constant(a)?.to_integer()?;
        let is_base = |own: &NodeId| exponent(*own).is_some_and(|u| self.same[u] == self.same[b]);
        let other = (0..self.arena.nodes.len()).find(is_base)?;
        (2..=MOST_POWER).contains(&times).then_some((other, times))
    }
}
