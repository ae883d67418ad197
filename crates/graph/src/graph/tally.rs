//! Count of the operations that a plan takes.
//!
//! The cost is that of the program of an engine, where a product that only a sum reads is fused
//! with it. Factors are compared modulo a prime.

use rustc_hash::FxHashMap;

use super::emitted::{Operation, PRODUCT, SIGN};
use super::merge::Member;
use super::plan::Plan;
use super::{Graph, ONE, Step};
use crate::number::prime::Modulus;
use crate::number::{BinaryOperation, UnaryFunction};

/// Prime field of the factors, 2⁶¹ - 1.
const PRIME: u64 = (1 << 61) - 1;
/// A multiple of a class; of the class of 1, a constant.
#[derive(Clone, Copy, Debug, Default)]
struct Multiple {
    class: usize,
    factor: u64,
}

/// An emitted operation, and the factor by which it is to be multiplied.
#[derive(Clone, Copy, Debug)]
struct Made {
    operation: u32,
    factor: u64,
}

/// Value of a class or of a step.
#[derive(Clone, Copy, Debug)]
enum Term {
    Constant(u64),
    Made(Made),
}

/// A count with its working memory.
#[derive(Debug)]
pub(super) struct Tally<'g> {
    graph: &'g Graph,
    modulus: Modulus,
    one: u64,
    minus_one: u64,
    outputs: Vec<Multiple>,
    /// Each place as a multiple of its class, and the inverse of the factor.
    places: Vec<(Multiple, u64)>,
    operations: Vec<Operation>,
    reads: Vec<u32>,
    is_output: Vec<bool>,
    /// Operations by what they compute: multiples, and all others where these are shared too.
    emitted: FxHashMap<Operation, u32>,
    shares_all: bool,
    inverses: FxHashMap<u64, u64>,
    made: Vec<Option<Term>>,
    has_factor: Vec<bool>,
    order: Vec<usize>,
    /// State of each class on the way: on the path in round `round`, or done in it.
    visited: Vec<(u32, bool)>,
    round: u32,
    open: Vec<usize>,
}

impl<'g> Tally<'g> {
    /// Prepares to count what the values at some places take. `None` where a factor is not in the
    /// field.
    pub(super) fn new(
        graph: &'g Graph,
        outputs: &[usize],
        members: &[Member],
        reached: &[bool],
    ) -> Option<Self> {
        let modulus = Modulus::new(PRIME);
        let (one, count) = (modulus.one(), graph.len());
        let mut tally = Self {
            graph,
            modulus,
            one,
            minus_one: modulus.sub(0, one),
            outputs: Vec::new(),
            places: Vec::with_capacity(count),
            operations: Vec::new(),
            reads: Vec::new(),
            is_output: Vec::new(),
            emitted: FxHashMap::default(),
            shares_all: false,
            inverses: FxHashMap::default(),
            made: vec![None; count],
            has_factor: vec![false; count],
            order: Vec::new(),
            visited: vec![(0, false); count],
            round: 0,
            open: Vec::new(),
        };
        for (member, reached) in members.iter().zip(reached) {
            let is_used = *reached || member.class == ONE.0 as usize;
            let factor = if is_used { modulus.rational(&member.factor)? } else { 0 };
            let inverse = if factor == 0 { 0 } else { tally.inverse(factor) };
            tally.places.push((Multiple { class: member.class, factor }, inverse));
        }
        tally.outputs = outputs.iter().map(|place| tally.places[*place].0).collect();
        Some(tally)
    }

    /// Classes of the plan counted last, arguments first.
    pub(super) fn order(&self) -> &[usize] {
        &self.order
    }

    /// Whether a class of the plan counted last may be computed with or without a factor.
    pub(super) fn has_factor(&self, class: usize) -> bool {
        self.has_factor[class]
    }

    /// Counts the cost of a plan, with equal operations of different classes counted once; `None`
    /// where an output folds to a constant besides.
    pub(super) fn cost_shared(&mut self, plan: &Plan) -> Option<u32> {
        self.shares_all = true;
        let cost = self.cost(plan);
        self.shares_all = false;
        cost
    }

    /// Counts the cost of a plan; `None` where a class needs itself or an output is a constant.
    pub(super) fn cost(&mut self, plan: &Plan) -> Option<u32> {
        self.operations.clear();
        self.reads.clear();
        self.emitted.clear();
        self.arrange(plan)?;
        for index in 0..self.order.len() {
            let class = self.order[index];
            self.made[class] = Some(self.make(plan, class)?);
        }
        let mut cost = 0;
        self.is_output.clear();
        self.is_output.resize(self.operations.len(), false);
        for output in self.outputs.iter().filter(|output| output.class != ONE.0 as usize) {
            let Some(Term::Made(made)) = self.made[output.class] else { return None };
            self.is_output[made.operation as usize] = true;
            cost += match self.sign(self.modulus.mul(made.factor, output.factor)) {
                Some(true) => 0,
                Some(false) => SIGN,
                None => PRODUCT,
            };
        }
        let is_fused = |argument: u32| {
            let argument = argument as usize;
            matches!(self.operations[argument], Operation::Product(..) | Operation::Scaled(..))
                && self.reads[argument] == 1
                && !self.is_output[argument]
        };
        let all = self.operations.iter().map(|operation| operation.cost(is_fused));
        Some(cost + all.sum::<u32>())
    }

    /// Lists the classes that the outputs need, arguments first; `None` if one needs itself.
    fn arrange(&mut self, plan: &Plan) -> Option<()> {
        self.order.clear();
        self.round += 1;
        self.visited[ONE.0 as usize] = (self.round, true);
        self.open.clear();
        self.open.extend(self.outputs.iter().map(|output| output.class));
        while let Some(class) = self.open.last().copied() {
            let (round, is_done) = self.visited[class];
            if round == self.round {
                self.open.pop();
                if !is_done {
                    self.visited[class].1 = true;
                    self.order.push(class);
                }
                continue;
            }
            self.visited[class] = (self.round, false);
            for argument in self.graph.step(plan.made_by[class]?).arguments() {
                let needed = self.places[argument].0.class;
                match self.visited[needed] {
                    (round, is_done) if round == self.round => {
                        if !is_done {
                            return None;
                        }
                    }
                    _ => self.open.push(needed),
                }
            }
        }
        Some(())
    }

    /// Emits the operations of a class.
    fn make(&mut self, plan: &Plan, class: usize) -> Option<Term> {
        let place = plan.made_by[class]?;
        let inverse = self.places[place].1;
        let term = self.step(&self.graph.step(place))?;
        let has_factor = matches!(term, Term::Made(made) if self.sign(made.factor).is_none());
        self.has_factor[class] = has_factor;
        Some(match term {
            Term::Made(made) if plan.is_whole[class] && has_factor => {
                Term::Made(Made { operation: self.scaled(made), factor: inverse })
            }
            term => self.times(term, inverse),
        })
    }

    fn step(&mut self, step: &Step<'_>) -> Option<Term> {
        let emitted = match *step {
            Step::Constant(_) => return None,
            Step::Input(input) => self.emit(Operation::Input(input)),
            Step::Unary(UnaryFunction::Neg, a) => {
                return Some(self.times(self.value(a), self.minus_one));
            }
            Step::Unary(function, a) => {
                // A function of a constant is not folded: nor is it here.
                let Term::Made(x) = self.value(a) else { return None };
                match function {
                    UnaryFunction::Recip => {
                        let factor = self.inverse(x.factor);
                        Made { factor, ..self.emit(Operation::Function(function, x.operation)) }
                    }
                    UnaryFunction::Abs => {
                        let made = self.emit(Operation::Function(function, x.operation));
                        Made { factor: x.factor, ..made }
                    }
                    _ => {
                        let whole = self.scaled(x);
                        self.emit(Operation::Function(function, whole))
                    }
                }
            }
            Step::Power(a, _) => {
                let Term::Made(x) = self.value(a) else { return None };
                let whole = self.scaled(x);
                self.emit(Operation::Power(whole, a))
            }
            Step::Binary(operation, a, b) => match (operation, self.value(a), self.value(b)) {
                (BinaryOperation::Mul, Term::Made(x), Term::Made(y)) => {
                    let factor = self.product(x.factor, y.factor);
                    let (a, b) = (x.operation, y.operation);
                    Made { factor, ..self.emit(Operation::Product(a.min(b), a.max(b))) }
                }
                (BinaryOperation::Mul, term, Term::Constant(c))
                | (BinaryOperation::Mul, Term::Constant(c), term) => {
                    return Some(self.times(term, c));
                }
                (BinaryOperation::Add, x, y) => return Some(self.sum(x, y)),
                (BinaryOperation::Sub, x, y) => {
                    return Some(self.sum(x, self.times(y, self.minus_one)));
                }
                (BinaryOperation::Pow, Term::Made(x), Term::Made(y)) => {
                    let (x, y) = (self.scaled(x), self.scaled(y));
                    self.emit(Operation::GeneralPower(x, y))
                }
                (BinaryOperation::Pow, ..) => return None,
            },
        };
        Some(Term::Made(emitted))
    }

    fn times(&self, term: Term, by: u64) -> Term {
        match term {
            _ if by == 0 => Term::Constant(0),
            Term::Constant(value) => Term::Constant(self.product(value, by)),
            Term::Made(x) => Term::Made(Made { factor: self.product(x.factor, by), ..x }),
        }
    }

    fn sum(&mut self, x: Term, y: Term) -> Term {
        let (x, y) = match (x, y) {
            (Term::Constant(x), Term::Constant(y)) => {
                return Term::Constant(self.modulus.add(x, y));
            }
            (term, Term::Constant(0)) | (Term::Constant(0), term) => return term,
            (Term::Made(x), Term::Constant(c)) | (Term::Constant(c), Term::Made(x)) => {
                let inverse = self.inverse(x.factor);
                let shift = self.product(c, inverse);
                let made = self.emit(Operation::Shifted(x.operation, shift));
                return Term::Made(Made { factor: x.factor, ..made });
            }
            (Term::Made(x), Term::Made(y)) => (x, y),
        };
        if x.operation == y.operation {
            return match self.modulus.add(x.factor, y.factor) {
                0 => Term::Constant(0),
                factor => Term::Made(Made { factor, ..x }),
            };
        }
        let (second, is_sum) = if x.factor == y.factor {
            (y.operation, true)
        } else if x.factor == self.modulus.sub(0, y.factor) {
            (y.operation, false)
        } else {
            let inverse = self.inverse(x.factor);
            let factor = self.product(y.factor, inverse);
            (self.scaled(Made { operation: y.operation, factor }), true)
        };
        let (first, second) = match is_sum {
            true => (x.operation.min(second), x.operation.max(second)),
            false => (x.operation, second),
        };
        let made = self.emit(Operation::Sum(first, second, is_sum));
        Term::Made(Made { factor: x.factor, ..made })
    }

    /// Returns the value at a place, which was made before.
    fn value(&self, place: usize) -> Term {
        let Multiple { class, factor } = self.places[place].0;
        if class == ONE.0 as usize {
            return Term::Constant(factor);
        }
        self.made[class].map_or(Term::Constant(0), |term| self.times(term, factor))
    }

    /// Emits the product with the factor; signs are left to sums.
    fn scaled(&mut self, x: Made) -> u32 {
        match self.sign(x.factor) {
            Some(_) => x.operation,
            None => self.emit(Operation::Scaled(x.operation, x.factor)).operation,
        }
    }

    fn emit(&mut self, operation: Operation) -> Made {
        let next = self.operations.len() as u32;
        let place = if self.shares_all || matches!(operation, Operation::Scaled(..)) {
            *self.emitted.entry(operation).or_insert(next)
        } else {
            next
        };
        if place == next {
            for argument in operation.arguments().into_iter().flatten() {
                self.reads[argument as usize] += 1;
            }
            self.operations.push(operation);
            self.reads.push(0);
        }
        Made { operation: place, factor: self.one }
    }

    fn product(&self, a: u64, b: u64) -> u64 {
        match (a == self.one, b == self.one) {
            (true, _) => b,
            (_, true) => a,
            _ => self.modulus.mul(a, b),
        }
    }

    /// Inverts a factor, of which there are few.
    fn inverse(&mut self, factor: u64) -> u64 {
        if factor == self.one || factor == self.minus_one {
            return factor;
        }
        let modulus = self.modulus;
        *self.inverses.entry(factor).or_insert_with(|| modulus.inverse(factor))
    }

    /// Whether a factor is 1 (`true`) or -1 (`false`).
    fn sign(&self, factor: u64) -> Option<bool> {
        if factor == self.one {
            return Some(true);
        }
        (factor == self.minus_one).then_some(false)
    }
}
