//! Reduction to algebraic computations: operations that prime fields lack are replaced by new
//! inputs.
//!
//! ```text
//! √X, x^(a/b)  links of a chain √X, √√X, …, each with a sign ε of its own, shared by all powers of
//!              X; a root of odd index for the rest of b
//! √(a/b)       powers of roots of the few integers of which the constants under roots are made;
//!              they exist in the prime field itself, and need no sign
//! |X|          ε X
//! exp, x^y     products of symbols, one for each element of a basis of the arguments
//! sin, cos     points of the circle, the same
//! ln, atan     one symbol each
//! ```
//!
//! Symbols are independent by definition: an expression that vanishes for them vanishes for the
//! functions, but not conversely.

mod exponent;
mod lowering;
mod powers;

use std::ops::Deref;

use rustc_hash::FxHashMap;

use crate::graph::{Expr, Fault, Graph, Step, record_further};
use crate::number::rational::Rational;

use super::bounds::InputDistribution;

/// A radicand of roots of even index.
#[derive(Clone, Debug)]
pub struct Base {
    /// Value of the radicand.
    pub radicand: Expr,
    /// Places of the original graph that have this value under a root.
    pub arguments: Vec<usize>,
    /// First step of the original graph that is a root of it.
    pub first: usize,
    /// The values √X, √√X, …, each with the input that is its sign.
    pub links: Vec<(Expr, usize)>,
}

/// A modulus |X|, with the input that is its sign.
#[derive(Clone, Copy, Debug)]
pub struct ModulusSign {
    /// Place of the step in the original graph.
    pub place: usize,
    /// Argument X.
    pub argument: Expr,
    /// Index of the input that holds the sign.
    pub sign: usize,
}

/// An algebraic graph, lowered from another or algebraic already.
pub struct Algebraic<'g> {
    /// Graph of rational operations.
    pub graph: Held<'g>,
    /// New value of each place of the original graph that was requested and exists.
    pub values: Vec<Option<Expr>>,
    /// Distribution of each input.
    pub sources: Vec<InputDistribution>,
    /// Number of inputs of the original; symbols and signs follow.
    pub original_inputs: usize,
    /// Radicands of roots of even index, each after those it contains.
    pub bases: Vec<Base>,
    /// Moduli, each after those it contains.
    pub moduli: Vec<ModulusSign>,
    /// Radicands of roots of odd index, with the index.
    pub odd: Vec<(Expr, u64)>,
    /// Integers under roots, each with the length of the longest chain √n, √√n, … of its roots.
    pub numbers: Vec<(Rational, u32)>,
    /// Signs that each step of the graph depends on, in bits by [`Algebraic::bit`].
    masks: Vec<u128>,
    /// Index of each sign among all signs, by input.
    bits: FxHashMap<usize, u32>,
}

/// An owned or borrowed graph.
#[allow(clippy::large_enum_variant, reason = "there is one of them, and never a list")]
pub enum Held<'g> {
    /// An owned graph.
    Own(Graph),
    /// A borrowed graph.
    Lent(&'g Graph),
}

impl Deref for Held<'_> {
    type Target = Graph;

    fn deref(&self) -> &Graph {
        match self {
            Held::Own(graph) => graph,
            Held::Lent(graph) => graph,
        }
    }
}

impl<'g> Algebraic<'g> {
    /// Wraps a graph whose values of interest are already rational functions of its inputs.
    pub fn plain(graph: &'g Graph, sources: &[InputDistribution]) -> Self {
        Self {
            graph: Held::Lent(graph),
            values: Vec::new(),
            sources: sources.to_vec(),
            original_inputs: sources.len(),
            bases: Vec::new(),
            moduli: Vec::new(),
            odd: Vec::new(),
            numbers: Vec::new(),
            masks: Vec::new(),
            bits: FxHashMap::default(),
        }
    }

    /// Makes the same graph with further values, which `build` makes from the inputs of the
    /// original and from existing values.
    pub fn with(
        &self,
        build: impl FnOnce(&[Expr], &dyn Fn(Expr) -> Option<Expr>) -> Option<Vec<Expr>>,
    ) -> Result<Option<(Algebraic<'static>, Vec<Expr>)>, Fault> {
        self.with_inputs(|inputs, at| build(&inputs[..self.original_inputs.min(inputs.len())], at))
    }

    /// Makes the same graph with further values, which `build` makes from all inputs, those of
    /// signs and symbols included, and from existing values.
    pub fn with_inputs(
        &self,
        build: impl FnOnce(&[Expr], &dyn Fn(Expr) -> Option<Expr>) -> Option<Vec<Expr>>,
    ) -> Result<Option<(Algebraic<'static>, Vec<Expr>)>, Fault> {
        let (graph, (values, odd)) = record_further(&self.graph, |inputs, at| {
            let odd = self.odd.iter().map(|(base, index)| (at(*base), *index)).collect();
            (build(inputs, &|value| Some(at(value))), odd)
        })?;
        let Some(values) = values else { return Ok(None) };
        let mut all = Algebraic {
            graph: Held::Own(graph),
            values: Vec::new(),
            sources: self.sources.clone(),
            original_inputs: self.original_inputs,
            bases: self.bases.clone(),
            moduli: Vec::new(),
            odd,
            numbers: self.numbers.clone(),
            masks: self.masks.clone(),
            bits: self.bits.clone(),
        };
        all.add_masks();
        Ok(Some((all, values)))
    }

    /// Finds the signs on which steps depend that have no masks yet.
    fn add_masks(&mut self) {
        let mut masks = std::mem::take(&mut self.masks);
        masks.reserve_exact(self.graph.len() - masks.len());
        for place in masks.len()..self.graph.len() {
            let mask = match self.graph.step(place) {
                Step::Input(input) => self.bit(input),
                step => step.arguments().fold(0, |mask, argument| mask | masks[argument]),
            };
            masks.push(mask);
        }
        self.masks = masks;
    }

    /// Whether the signs fit into the bits of [`Algebraic::mask`].
    pub fn has_few_signs(&self) -> bool {
        self.bits.len() <= u128::BITS as usize
    }

    /// Returns the bit of a sign input; 0 for any other input.
    pub fn bit(&self, input: usize) -> u128 {
        self.bits.get(&input).and_then(|bit| 1u128.checked_shl(*bit)).unwrap_or(0)
    }

    /// Returns the signs that a value depends on.
    pub fn mask(&self, value: Expr) -> u128 {
        self.masks.get(self.graph.place(value)).copied().unwrap_or(0)
    }

    /// Returns the signs that some values depend on.
    pub fn mask_of(&self, values: &[Expr]) -> u128 {
        values.iter().fold(0, |mask, value| mask | self.mask(*value))
    }

    /// Length of the longest chain of roots of even index, integers excepted.
    pub fn depth(&self) -> u32 {
        self.bases.iter().map(|base| base.links.len() as u32).max().unwrap_or(0)
    }

    /// Returns the integers that must be squares in a prime field.
    pub fn squares(&self) -> Vec<Rational> {
        self.numbers.iter().map(|(integer, _)| integer.clone()).collect()
    }

    /// Returns the odd prime factors of the indices of roots, each once.
    pub fn odd_indices(&self) -> Vec<u64> {
        let mut primes = Vec::new();
        for (_, index) in &self.odd {
            let mut rest = *index;
            for divisor in (3..).step_by(2) {
                if divisor * divisor > rest {
                    break;
                }
                while rest % divisor == 0 {
                    rest /= divisor;
                    primes.push(divisor);
                }
            }
            if rest > 1 {
                primes.push(rest);
            }
        }
        primes.sort_unstable();
        primes.dedup();
        primes
    }

    /// Whether these outputs contain a symbol for a transcendental function.
    pub fn has_symbols(&self, outputs: &[Expr]) -> bool {
        let reached = self.graph.reached(outputs.iter().copied());
        self.graph.steps().enumerate().any(|(place, step)| match step {
            Step::Input(input) => reached[place] && self.is_symbol(input),
            _ => false,
        })
    }

    /// Lists, by place of this graph, which values contain such a symbol.
    pub fn symbolic(&self) -> Vec<bool> {
        let mut symbolic: Vec<bool> = Vec::with_capacity(self.graph.len());
        for step in self.graph.steps() {
            let own = match step {
                Step::Input(input) => self.is_symbol(input),
                step => step.arguments().any(|argument| symbolic[argument]),
            };
            symbolic.push(own);
        }
        symbolic
    }

    fn is_symbol(&self, input: usize) -> bool {
        input >= self.original_inputs && self.sources[input] != InputDistribution::Sign
    }
}
