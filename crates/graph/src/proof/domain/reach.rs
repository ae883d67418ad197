//! The values that a question about a region needs, laid out for passes over them.

use crate::graph::{Graph, Step};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::alike::sign_above_logarithm;
use crate::proof::extent::Extent;
use crate::proof::fact::SignFact;

use super::Region;
use super::linked::{Link, links};
use super::signed::SignedProduct;
use super::slopes::Slopes;

/// The reached values of a region in order, numbered from 0, with memory for their bounds.
pub struct Reach<'r> {
    pub(super) region: &'r Region<'r>,
    /// Place of each value.
    pub(super) places: Vec<usize>,
    pub(super) steps: Vec<ReachedStep<'r>>,
    /// Products whose signs are known from more than their two factors.
    pub(super) signed: Vec<SignedProduct>,
    /// Facts about values, by number.
    pub(super) facts: Vec<(usize, SignFact)>,
    /// Inputs among the values: number and index.
    pub(super) inputs: Vec<(usize, usize)>,
    /// Facts and values that are asked for whose signs follow from one another.
    pub(super) links: Vec<Link>,
    pub(super) bounds: Vec<Extent>,
    pub(super) changes: Changes,
}

/// Number of changes of bounds, at the last change of each and at the last visit of each step.
#[derive(Default)]
pub(super) struct Changes {
    pub count: u32,
    /// Number of the last change of each bound.
    pub last: Vec<u32>,
    /// Numbers of changes before the last look at a step, forwards and backwards.
    pub forward: Vec<u32>,
    pub backward: Vec<u32>,
}

/// Operation by which a value is bounded; arguments are numbers of values.
#[derive(Clone, Copy)]
pub(super) enum Rule<'r> {
    Constant(Extent),
    Input(usize),
    Unary(UnaryFunction, usize),
    Power(usize, &'r Rational),
    Sum(usize, usize),
    Difference(usize, usize),
    Square(usize),
    Product(usize, usize),
    /// x^y
    Raised(usize, usize),
}

impl Rule<'_> {
    /// Numbers of the arguments; twice the same for a single one.
    #[inline(always)]
    pub fn arguments(self) -> Option<[usize; 2]> {
        match self {
            Rule::Constant(_) | Rule::Input(_) => None,
            Rule::Unary(_, a) | Rule::Power(a, _) | Rule::Square(a) => Some([a, a]),
            Rule::Sum(a, b) | Rule::Difference(a, b) | Rule::Product(a, b) | Rule::Raised(a, b) => {
                Some([a, b])
            }
        }
    }
}

impl Changes {
    /// Begins with bounds that nothing has changed.
    pub fn begin(&mut self, count: usize) {
        self.count = 0;
        for stamps in [&mut self.last, &mut self.forward, &mut self.backward] {
            stamps.clear();
            stamps.resize(count, 0);
        }
    }

    /// Notes that a bound has changed.
    #[inline(always)]
    pub fn note(&mut self, number: usize) {
        self.count += 1;
        self.last[number] = self.count;
    }
}

/// A value with what is known of it from classes.
#[derive(Clone, Copy)]
pub(super) struct ReachedStep<'r> {
    pub rule: Rule<'r>,
    pub is_zero: bool,
    pub is_nonzero: bool,
    /// Index of the sign of a product.
    pub signed: Option<u32>,
    /// The sign of a sum with a logarithm.
    pub sign: Option<bool>,
}

impl<'r> Reach<'r> {
    /// Lays out what the facts and the values at some places need.
    pub fn new(region: &'r Region<'r>, others: &[usize]) -> Self {
        Self::laid_out(region, others, None)
    }

    /// Lays out the same, with signs of products that follow from slopes; `None` if there are none.
    pub fn with_slopes(region: &'r Region<'r>, others: &[usize]) -> Option<Self> {
        let mut slopes = Slopes::new(region.graph, region.inputs);
        let reach = Self::laid_out(region, others, Some(&mut slopes));
        slopes.are_known().then_some(reach)
    }

    fn laid_out(
        region: &'r Region<'r>,
        others: &[usize],
        mut slopes: Option<&mut Slopes<'r>>,
    ) -> Self {
        let graph = region.graph;
        let asked: Vec<usize> =
            region.facts.iter().map(|(place, _)| *place).chain(others.iter().copied()).collect();
        let reached = graph.reached_from(&asked);
        let places: Vec<usize> = (0..reached.len()).filter(|place| reached[*place]).collect();
        let mut numbers = vec![0; places.last().map_or(0, |last| last + 1)];
        places.iter().enumerate().for_each(|(number, place)| numbers[*place] = number);
        let mut signed: Vec<SignedProduct> = Vec::new();
        let step = |place: &usize| ReachedStep {
            rule: rule(graph.step(*place), &numbers),
            is_zero: region.classes.is_zero(*place),
            is_nonzero: region.classes.is_nonzero(*place),
            signed: match graph.step(*place) {
                Step::Binary(BinaryOperation::Mul, a, b) if a != b => {
                    let known = SignedProduct::of(graph, [a, b], &numbers, slopes.as_deref_mut());
                    known.and_then(|known| {
                        signed.push(known);
                        u32::try_from(signed.len() - 1).ok()
                    })
                }
                _ => None,
            },
            sign: match graph.step(*place) {
                Step::Binary(BinaryOperation::Add | BinaryOperation::Sub, a, b)
                    if is_logarithm(graph, a) || is_logarithm(graph, b) =>
                {
                    sign_above_logarithm(graph, *place)
                }
                _ => None,
            },
        };
        let steps: Vec<ReachedStep<'_>> = places.iter().map(step).collect();
        let facts = region.facts.iter().map(|(place, fact)| (numbers[*place], *fact)).collect();
        let input = |(number, step): (usize, &ReachedStep<'_>)| match step.rule {
            Rule::Input(input) => Some((number, input)),
            _ => None,
        };
        let inputs = steps.iter().enumerate().filter_map(input).collect();
        let links = links(graph, &asked, &numbers);
        Self {
            region,
            places,
            steps,
            signed,
            facts,
            inputs,
            links,
            bounds: Vec::new(),
            changes: Changes::default(),
        }
    }

    /// Returns the number of the reached value at a place.
    pub fn number(&self, place: usize) -> usize {
        self.places.binary_search(&place).unwrap_or(0)
    }

    /// Supposes that values, by number, are 0: what is bounded then holds at their common zeros alone.
    pub fn suppose_zero(&mut self, numbers: &[usize]) {
        numbers.iter().for_each(|number| self.steps[*number].is_zero = true);
    }

    /// Lists the places of the reached values in order.
    pub fn places(&self) -> &[usize] {
        &self.places
    }

    /// Lists the reached inputs: number of the value, and index of the input.
    pub fn inputs(&self) -> &[(usize, usize)] {
        &self.inputs
    }
}

/// Whether a value is a multiple of a logarithm.
fn is_logarithm(graph: &Graph, place: usize) -> bool {
    let is_own = |place: usize| matches!(graph.step(place), Step::Unary(UnaryFunction::Ln, _));
    match graph.step(place) {
        Step::Unary(UnaryFunction::Ln, _) => true,
        Step::Unary(UnaryFunction::Neg, a) => is_own(a),
        Step::Binary(BinaryOperation::Mul, a, b) => is_own(a) || is_own(b),
        _ => false,
    }
}

/// Returns the rule for a step, with arguments by number.
fn rule<'r>(step: Step<'r>, numbers: &[usize]) -> Rule<'r> {
    match step {
        Step::Constant(value) => Rule::Constant(Extent::at(value)),
        Step::Input(input) => Rule::Input(input),
        Step::Unary(function, a) => Rule::Unary(function, numbers[a]),
        Step::Power(a, exponent) => Rule::Power(numbers[a], exponent),
        Step::Binary(operation, a, b) => {
            let (a, b) = (numbers[a], numbers[b]);
            match operation {
                BinaryOperation::Add => Rule::Sum(a, b),
                BinaryOperation::Sub => Rule::Difference(a, b),
                BinaryOperation::Mul if a == b => Rule::Square(a),
                BinaryOperation::Mul => Rule::Product(a, b),
                BinaryOperation::Pow => Rule::Raised(a, b),
            }
        }
    }
}
