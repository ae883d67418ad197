//! Merging of proportional nodes into one, computed in the cheapest way that was recorded.
//!
//! Interning finds equal nodes that were made in the same way; merging finds nodes of equal value,
//! however they were made. Shortcuts recorded next to the outputs take part: a short formula for a
//! needed value replaces the long one wherever it holds.

use rustc_hash::FxHashMap;

use super::{Expr, Fault, Graph, ONE, Step, record};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::scalar::Scalar;

/// Number of passes, after which the costs have mostly settled.
const PASSES: usize = 16;
/// Cost of a reciprocal, a root or a function beyond that of an addition.
const SLOW: u32 = 8;

/// A node as a multiple of the first one in its class; all constants are multiples of the node 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// Place of the first node of the class.
    pub class: usize,
    /// Factor by which the first node is multiplied to give this one.
    pub factor: Rational,
}

/// The member of a class to compute.
#[derive(Clone, Copy, Debug)]
pub enum Choice<'r> {
    /// The first member.
    First,
    /// The member that takes the fewest operations, made from the reached steps.
    Cheapest(&'r [bool]),
}

/// A way to compute a class.
#[derive(Clone)]
struct Way {
    /// Place of the member that is computed.
    place: usize,
    /// Number of operations, with slow ones counted more.
    cost: u32,
    /// The classes needed on the way, one bit each.
    needs: Set,
}

impl Graph {
    /// Finds the class of each node from its values; `None` where it has none or is to be left
    /// alone.
    ///
    /// `direction` maps proportional values to a common key, and `factor` returns the number by
    /// which the second is multiplied to give the first, if its size is reasonable.
    pub fn members<V, D: std::hash::Hash + Eq>(
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
        let mut member = |place: usize| {
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
        places.map(|place| member(place).unwrap_or_else(|| stranger(place))).collect()
    }

    /// Rebuilds the outputs in a new graph with each class computed once; copies them unchanged
    /// where a class would need itself.
    pub fn rebuilt(
        &self,
        outputs: &[Expr],
        members: &[Member],
        choice: Choice<'_>,
    ) -> Result<(Graph, Vec<Expr>), Fault> {
        let made_by: Vec<Option<usize>> = match choice {
            Choice::First => (0..self.len()).map(Some).collect(),
            Choice::Cheapest(reached) => {
                let ways = self.ways(members, reached).into_iter();
                ways.map(|way| way.map(|way| way.place)).collect()
            }
        };
        let places: Vec<usize> = outputs.iter().map(|output| self.place(*output)).collect();
        if let Choice::Cheapest(reached) = choice {
            let scaled = match self.best_plan(&places, members, reached, &made_by) {
                Some((plan, order)) => self.rebuilt_scaled(&places, members, &plan, &order)?,
                None => None,
            };
            return scaled.map_or_else(|| self.copied(outputs), Ok);
        }
        let (graph, rebuilt) = record(self.inputs(), |inputs| {
            let mut order = self.order(&places, members, &made_by)?;
            if matches!(choice, Choice::First) {
                order.sort_unstable();
            }
            let mut made: Vec<Option<Expr>> = vec![None; self.len()];
            let value = |place: usize, made: &[Option<Expr>]| {
                let Member { class, factor } = &members[place];
                let unit = members[made_by[*class]?].factor.recip()?;
                Some(Expr::rational(&(factor * &unit)) * made[*class]?)
            };
            for class in order {
                let step = self.step(made_by[class]?);
                made[class] = Some(step.repeat(inputs, |place| value(place, &made))?);
            }
            places.iter().map(|place| value(*place, &made)).collect::<Option<Vec<Expr>>>()
        })?;
        match rebuilt {
            Some(rebuilt) => Ok((graph, rebuilt)),
            None => self.copied(outputs),
        }
    }

    /// Copies the outputs unchanged into a new graph.
    pub(super) fn copied(&self, outputs: &[Expr]) -> Result<(Graph, Vec<Expr>), Fault> {
        let reached = self.reached(outputs.iter().copied());
        record(self.inputs(), |inputs| {
            let values = self.repeated(&reached, inputs);
            outputs.iter().map(|output| values[self.place(*output)].unwrap_or(*output)).collect()
        })
    }

    /// Finds the cheapest way to compute each class from the reached steps.
    fn ways(&self, members: &[Member], reached: &[bool]) -> Vec<Option<Way>> {
        // One bit for each class that takes an operation.
        let mut bits: Vec<Option<usize>> = vec![None; self.len()];
        let mut count = 0;
        for (place, step) in self.steps_at(reached) {
            let bit = &mut bits[members[place].class];
            if bit.is_none() && step.is_computed() {
                *bit = Some(count);
                count += 1;
            }
        }
        let mut slow = Set::empty(count);
        let mut ways: Vec<Option<Way>> = vec![None; self.len()];
        for _ in 0..PASSES {
            let mut settled = true;
            for (place, step) in self.steps_at(reached) {
                let Member { class, factor } = &members[place];
                let mut needs = Set::empty(count);
                let known = step.arguments().all(|argument| {
                    let way = ways[members[argument].class].as_ref();
                    way.inspect(|way| needs.add(&way.needs)).is_some()
                });
                if !known || factor.is_zero() || bits[*class].is_some_and(|bit| needs.has(bit)) {
                    continue;
                }
                let mut cost = needs.len() + SLOW * needs.common(&slow);
                if let (Some(bit), true) = (bits[*class], step.is_computed()) {
                    needs.insert(bit);
                    cost += 1 + if step.is_slow() { SLOW } else { 0 };
                }
                let better = ways[*class].as_ref().is_none_or(|way| {
                    cost < way.cost || (way.place == place && way.needs != needs)
                });
                if better {
                    settled = false;
                    if let Some(bit) = bits[*class] {
                        slow.set(bit, step.is_slow());
                    }
                    ways[*class] = Some(Way { place, cost, needs });
                }
            }
            if settled {
                break;
            }
        }
        ways
    }

    /// Lists the classes that some places need, arguments first; `None` if a class needs itself.
    fn order(
        &self,
        places: &[usize],
        members: &[Member],
        made_by: &[Option<usize>],
    ) -> Option<Vec<usize>> {
        let mut order = Vec::new();
        // 0: not visited, 1: on the path, 2: done.
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
            for argument in self.step(made_by[class]?).arguments() {
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
    fn is_computed(&self) -> bool {
        !matches!(self, Step::Constant(_) | Step::Input(_))
    }

    fn is_slow(&self) -> bool {
        match self {
            Step::Power(..) | Step::Binary(BinaryOperation::Pow, ..) => true,
            Step::Unary(function, _) => {
                !matches!(function, UnaryFunction::Neg | UnaryFunction::Abs)
            }
            _ => false,
        }
    }
}

/// A set of small numbers.
#[derive(Clone, PartialEq)]
struct Set(Vec<u64>);

impl Set {
    fn empty(size: usize) -> Self {
        Self(vec![0; size.div_ceil(64)])
    }

    fn has(&self, bit: usize) -> bool {
        self.0[bit / 64] >> (bit % 64) & 1 == 1
    }

    fn set(&mut self, bit: usize, is_in: bool) {
        self.0[bit / 64] &= !(1 << (bit % 64));
        self.0[bit / 64] |= u64::from(is_in) << (bit % 64);
    }

    fn insert(&mut self, bit: usize) {
        self.set(bit, true);
    }

    fn add(&mut self, other: &Self) {
        self.0.iter_mut().zip(&other.0).for_each(|(a, b)| *a |= b);
    }

    fn len(&self) -> u32 {
        self.0.iter().map(|word| word.count_ones()).sum()
    }

    fn common(&self, other: &Self) -> u32 {
        self.0.iter().zip(&other.0).map(|(a, b)| (a & b).count_ones()).sum()
    }
}
