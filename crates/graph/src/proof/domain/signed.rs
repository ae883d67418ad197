//! Signs of products: of factors that occur twice, of pairs with one sign (rules S6 and S11 of docs/soundness.md),
//! and of the others by their bounds.

use crate::graph::{Graph, Step};
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::alike::{Likeness, contains_increasing, likeness};
use crate::proof::extent::Extent;

use super::bounds::is_within_half_turns;
use super::slopes::Slopes;

/// Largest number of factors of a product.
const MOST_FACTORS: usize = 12;

/// A product ± Π pairs Π others, up to factors that are never negative.
pub(super) struct SignedProduct {
    is_positive: bool,
    /// Factors, by pairs with what is known of their signs.
    pairs: Vec<Likeness>,
    /// Numbers of the other factors.
    others: Vec<usize>,
}

impl SignedProduct {
    /// Finds the pairs among the factors of the product of the values at two places; `None` if this
    /// says nothing more than its factors.
    pub fn of(
        graph: &Graph,
        [a, b]: [usize; 2],
        numbers: &[usize],
        mut slopes: Option<&mut Slopes<'_>>,
    ) -> Option<Self> {
        let Factors { mut is_positive, mut odd, mut is_known } = Factors::of(graph, [a, b])?;
        let mut pairs = Vec::new();
        let mut at = 0;
        while at < odd.len() {
            let own = odd[at];
            let found = (at + 1..odd.len()).find_map(|other| {
                let second = odd[other];
                let may_be_alike =
                    contains_increasing(graph, own) || contains_increasing(graph, second);
                let known = may_be_alike.then(|| likeness(graph, own, second)).flatten();
                let known = known.map(|known| known.numbered(numbers));
                let by_slopes = || Some(Likeness::Signed(slopes.as_mut()?.likeness(own, second)?));
                Some((other, known.or_else(by_slopes)?))
            });
            match found {
                Some((other, Likeness::Signed(is_alike))) => {
                    is_positive = is_positive == is_alike;
                    is_known = true;
                    odd.remove(other);
                    odd.remove(at);
                }
                Some((other, known)) => {
                    pairs.push(known);
                    odd.remove(other);
                    odd.remove(at);
                }
                None => at += 1,
            }
        }
        let is_known = is_known || !pairs.is_empty();
        let others = odd.into_iter().map(|place| numbers[place]).collect();
        is_known.then_some(Self { is_positive, pairs, others })
    }

    /// Bounds the product by its sign.
    pub fn within(&self, product: Extent, bounds: &[Extent]) -> Extent {
        let mut is_positive = self.is_positive;
        for pair in &self.pairs {
            match *pair {
                Likeness::Signed(is_alike) => is_positive = is_positive == is_alike,
                Likeness::WithinHalfTurns(angle, is_alike) => {
                    match is_within_half_turns(bounds[angle]) {
                        true => is_positive = is_positive == is_alike,
                        false => return product,
                    }
                }
            }
        }
        for other in &self.others {
            match bounds[*other].sign() {
                Some(sign) => is_positive = is_positive == sign,
                None => return product,
            }
        }
        product.within(is_positive)
    }
}

/// Factors of a product.
struct Factors {
    is_positive: bool,
    /// Factors that occur an odd number of times.
    odd: Vec<usize>,
    /// Whether a factor occurs more than once.
    is_known: bool,
}

impl Factors {
    /// Divides a product as far as it is made of products, reciprocals and numbers; `None` if it has too many factors,
    /// or the factor 0.
    fn of(graph: &Graph, [a, b]: [usize; 2]) -> Option<Self> {
        let mut own = Self { is_positive: true, odd: Vec::new(), is_known: false };
        let (mut open, mut looked) = (vec![b, a], 0);
        while let Some(place) = open.pop() {
            looked += 1;
            if looked > 2 * MOST_FACTORS {
                return None;
            }
            match graph.step(place) {
                Step::Binary(BinaryOperation::Mul, a, b) if a == b => own.is_known = true,
                Step::Binary(BinaryOperation::Mul, a, b) => open.extend([b, a]),
                Step::Unary(UnaryFunction::Recip, a) => open.push(a),
                Step::Unary(UnaryFunction::Neg, a) => {
                    own.is_positive = !own.is_positive;
                    open.push(a);
                }
                Step::Constant(value) if value.is_zero() => return None,
                Step::Constant(value) => own.is_positive ^= value.is_negative(),
                _ => match own.odd.iter().position(|before| *before == place) {
                    Some(before) => {
                        own.odd.remove(before);
                        own.is_known = true;
                    }
                    None => own.odd.push(place),
                },
            }
        }
        (own.odd.len() <= MOST_FACTORS).then_some(own)
    }
}
