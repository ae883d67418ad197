//! Nodes that are multiples of each other are one node, made in the cheapest way that was recorded.
//!
//! Interning finds equal nodes that were made in the same way; here nodes of equal value are found,
//! however they were made. What was recorded beside the outputs takes part: a short formula for a
//! value that is needed replaces the long one wherever it holds.

use rustc_hash::FxHashMap;

use super::{Expr, Fault, Graph, ONE, Step, record};
use crate::number::Function;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Larger graphs stay as they are: what each class needs is kept as a set.
const MOST_NODES: usize = 1 << 13;
/// Passes in which the costs mostly settle.
const PASSES: usize = 16;
/// What a reciprocal, a root or a function costs beyond an addition.
const SLOW: u32 = 8;

/// A node as a multiple of the first one in its class; all constants are multiples of the node 1.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Member {
    /// The place of the first one.
    pub class: usize,
    /// What that is to be multiplied by.
    pub factor: Rational,
}

/// How a class is made.
#[derive(Clone)]
struct Way {
    /// The member that is computed.
    place: usize,
    /// Operations, slow ones counted more.
    cost: u32,
    /// The classes that are needed on the way, one bit each.
    needs: Box<[u64]>,
}

impl Graph {
    /// The class of each node from its values, `None` where it has none or is to be left alone.
    ///
    /// `direction` is what proportional values have in common, and `factor` tells by how much the
    /// second is multiplied to give the first, if that is a number of reasonable size.
    pub(crate) fn members<V, D: std::hash::Hash + Eq>(
        &self,
        values: &[Option<V>],
        direction: impl Fn(&V) -> Option<D>,
        factor: impl Fn(&V, &V) -> Option<Rational>,
    ) -> Vec<Member> {
        let one = ONE.0 as usize;
        let mut first: FxHashMap<D, usize> = FxHashMap::default();
        if let Some(direction) = values[one].as_ref().and_then(&direction) {
            first.insert(direction, one);
        }
        let member = |place: usize| {
            if let Step::Constant(value) = self.step(place) {
                return Some(Member { class: one, factor: value.clone() });
            }
            let own = values[place].as_ref()?;
            let class = *first.entry(direction(own)?).or_insert(place);
            let factor = factor(own, values[class].as_ref()?)?;
            Some(Member { class, factor })
        };
        let stranger = |place: usize| Member { class: place, factor: Rational::from(1) };
        let places = 0..self.len();
        let mut member = member;
        places.map(|place| member(place).unwrap_or_else(|| stranger(place))).collect()
    }

    /// The outputs, each class made once and in its cheapest way, in a graph of their own.
    pub(crate) fn rebuilt(
        &self,
        outputs: &[Expr],
        members: &[Member],
    ) -> Result<(Graph, Vec<Expr>), Fault> {
        let ways = if self.len() <= MOST_NODES { self.ways(members) } else { Vec::new() };
        let places: Vec<usize> = outputs.iter().map(|output| self.place(*output)).collect();
        let (graph, rebuilt) = record(self.inputs(), |inputs| {
            let order = self.order(&places, members, &ways)?;
            let mut made: Vec<Option<Expr>> = vec![None; self.len()];
            let value = |place: usize, made: &[Option<Expr>]| {
                let Member { class, factor } = &members[place];
                let unit = members[ways[*class].as_ref()?.place].factor.recip()?;
                Some(Expr::rational(&(factor * &unit)) * made[*class]?)
            };
            for class in order {
                let step = self.step(ways[class].as_ref()?.place);
                made[class] = Some(step.repeat(inputs, |place| value(place, &made))?);
            }
            places.iter().map(|place| value(*place, &made)).collect::<Option<Vec<Expr>>>()
        })?;
        match rebuilt {
            Some(rebuilt) => Ok((graph, rebuilt)),
            None => self.copied(outputs),
        }
    }

    /// The outputs as they are, in a graph of their own.
    pub(super) fn copied(&self, outputs: &[Expr]) -> Result<(Graph, Vec<Expr>), Fault> {
        let reached = self.reached(outputs.iter().copied());
        record(self.inputs(), |inputs| {
            let values = self.replay(&reached, inputs, |_, _, _| None);
            outputs.iter().map(|output| values[self.place(*output)].unwrap_or(*output)).collect()
        })
    }

    /// The cheapest way to make each class.
    fn ways(&self, members: &[Member]) -> Vec<Option<Way>> {
        let words = self.len().div_ceil(64);
        let mut slow = vec![0u64; words];
        let mut ways: Vec<Option<Way>> = vec![None; self.len()];
        for _ in 0..PASSES {
            let mut settled = true;
            for (place, step) in self.steps().enumerate() {
                let Member { class, factor } = &members[place];
                let mut needs = vec![0u64; words].into_boxed_slice();
                let all = step.arguments().all(|argument| {
                    let way = ways[members[argument].class].as_ref();
                    way.inspect(|way| needs.iter_mut().zip(&way.needs).for_each(|(a, b)| *a |= b))
                        .is_some()
                });
                let (word, bit) = (*class / 64, 1u64 << (*class % 64));
                if !all || needs[word] & bit != 0 || factor.is_zero() {
                    continue;
                }
                if !matches!(step, Step::Constant(_) | Step::Input(_)) {
                    needs[word] |= bit;
                }
                let own = if step.is_slow() { bit } else { 0 };
                let others = slow[word] & !bit;
                let count = |word: &u64| word.count_ones();
                let few = |(a, b): (&u64, &u64)| SLOW * (a & b).count_ones();
                let cost = needs.iter().map(count).sum::<u32>()
                    + needs.iter().zip(&slow).map(few).sum::<u32>();
                // The class's own operation is the one of this step.
                let cost = cost - SLOW * (slow[word] & bit).count_ones() + SLOW * own.count_ones();
                let better = ways[*class].as_ref().is_none_or(|way| {
                    cost < way.cost || (way.place == place && way.needs != needs)
                });
                if better {
                    settled = false;
                    slow[word] = others | own;
                    ways[*class] = Some(Way { place, cost, needs });
                }
            }
            if settled {
                break;
            }
        }
        ways
    }

    /// The classes that some places need, arguments first; `None` if one needs itself.
    fn order(
        &self,
        places: &[usize],
        members: &[Member],
        ways: &[Option<Way>],
    ) -> Option<Vec<usize>> {
        let mut order = Vec::new();
        // Not seen, on the way, done.
        let mut state = vec![0u8; self.len()];
        let mut open: Vec<usize> = places.iter().map(|place| members[*place].class).collect();
        while let Some(class) = open.last().copied() {
            if state[class] > 0 {
                open.pop();
                if state[class] == 1 {
                    state[class] = 2;
                    order.push(class);
                }
                continue;
            }
            state[class] = 1;
            for argument in self.step(ways.get(class)?.as_ref()?.place).arguments() {
                let needed = members[argument].class;
                match state[needed] {
                    0 => open.push(needed),
                    1 => return None,
                    _ => {}
                }
            }
        }
        Some(order)
    }
}

impl Step<'_> {
    fn is_slow(&self) -> bool {
        matches!(self, Step::Power(..))
            || matches!(self, Step::Unary(function, _) if !matches!(function, Function::Neg | Function::Abs))
    }
}
