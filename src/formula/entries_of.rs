//! Entries of vectors and matrices as formulas of the entries of what these are made of.

use super::arena::{Arena, NodeId, NodeOperation};
use super::kind::Type;
use crate::number::rational::Rational;

/// Largest number of entries that are made.
const MOST_ENTRIES: usize = 1000;

/// Entries that are appended to an arena.
pub(super) struct Entries<'a> {
    arena: &'a mut Arena,
    /// Node to whose text they belong.
    of: NodeId,
    made: usize,
}

impl<'a> Entries<'a> {
    /// Begins with a vector or a matrix.
    pub fn of(arena: &'a mut Arena, of: NodeId) -> Self {
        Self { arena, of, made: 0 }
    }

    fn push(&mut self, operation: NodeOperation) -> NodeId {
        self.arena.scalar(operation, self.of)
    }

    fn number(&mut self, value: i64) -> NodeId {
        self.push(NodeOperation::Number(Rational::from(value)))
    }

    /// Appends the entry of a node at a place, counted from 1; `None` if it has too many parts.
    pub fn entry(&mut self, node: NodeId, place: &[usize]) -> Option<NodeId> {
        use NodeOperation::{Add, Multiply, Negate, Subtract};
        self.made += 1;
        if self.made > MOST_ENTRIES {
            return None;
        }
        let operation = self.arena.nodes[node].operation.clone();
        let own = match (operation, place) {
            (NodeOperation::Zero, _) => return Some(self.number(0)),
            (NodeOperation::Identity, [i, j]) => return Some(self.number(i64::from(i == j))),
            (NodeOperation::Vector(parts), [i]) => return parts.get(i.checked_sub(1)?).copied(),
            (NodeOperation::Rows(parts), [i, j]) => {
                return self.entry(*parts.get(i.checked_sub(1)?)?, &[*j]);
            }
            (NodeOperation::Transpose(a), [i, j]) => return self.entry(a, &[*j, *i]),
            (Add(a, b), _) => Add(self.entry(a, place)?, self.entry(b, place)?),
            (Subtract(a, b), _) => Subtract(self.entry(a, place)?, self.entry(b, place)?),
            (Negate(a), _) => Negate(self.entry(a, place)?),
            (NodeOperation::Scale(scalar, a), _) => Multiply(scalar, self.entry(a, place)?),
            (NodeOperation::Cross(a, b), [i]) => {
                let (next, last) = (i % 3 + 1, (i + 1) % 3 + 1);
                let mut product = |one: usize, other: usize| {
                    let (a, b) = (self.entry(a, &[one])?, self.entry(b, &[other])?);
                    Some(self.push(Multiply(a, b)))
                };
                Subtract(product(next, last)?, product(last, next)?)
            }
            (NodeOperation::Compose(a, b), [i, j]) => {
                let Type::Matrix(_, inner) = self.arena.nodes[a].value_type else { return None };
                let mut sum = None;
                for k in 1..=inner {
                    let (one, other) = (self.entry(a, &[*i, k])?, self.entry(b, &[k, *j])?);
                    let product = self.push(Multiply(one, other));
                    sum = Some(match sum {
                        None => product,
                        Some(sum) => self.push(Add(sum, product)),
                    });
                }
                return sum;
            }
            (_, [i]) => NodeOperation::Component(node, i.checked_sub(1)?),
            (_, [i, j]) => NodeOperation::Entry(node, i.checked_sub(1)?, j.checked_sub(1)?),
            _ => return None,
        };
        Some(self.push(own))
    }
}
