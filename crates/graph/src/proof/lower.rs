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

use std::collections::BTreeMap;
use std::ops::Deref;

use rustc_hash::FxHashMap;

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::number::rational::Rational;
use crate::number::{Function, Operation};
use crate::scalar::Scalar;

use super::bounds::Source;
use super::numbers::Numbers;
use super::symbols::{Form, Symbols};

/// Largest length of a chain of nested square roots of one radicand.
const LONGEST_CHAIN: u32 = 24;

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
pub struct Modulus {
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
    pub sources: Vec<Source>,
    /// Number of inputs of the original; symbols and signs follow.
    pub original_inputs: usize,
    /// Radicands of roots of even index, each after those it contains.
    pub bases: Vec<Base>,
    /// Moduli, each after those it contains.
    pub moduli: Vec<Modulus>,
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
    pub fn plain(graph: &'g Graph, sources: &[Source]) -> Self {
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
        let (graph, (values, odd)) = record(self.sources.len(), |inputs| {
            let reached = vec![true; self.graph.len()];
            let values = self.graph.replay(&reached, inputs, |_, _, _| None);
            let at = |expr: Expr| values[self.graph.place(expr)];
            let odd: Option<Vec<(Expr, u64)>> =
                self.odd.iter().map(|(base, index)| Some((at(*base)?, *index))).collect();
            (build(&inputs[..self.original_inputs], &at), odd)
        })?;
        let (Some(values), Some(odd)) = (values, odd) else { return Ok(None) };
        let mut all = Algebraic {
            graph: Held::Own(graph),
            values: Vec::new(),
            sources: self.sources.clone(),
            original_inputs: self.original_inputs,
            bases: self.bases.clone(),
            moduli: Vec::new(),
            odd,
            numbers: self.numbers.clone(),
            masks: Vec::new(),
            bits: self.bits.clone(),
        };
        all.masks = all.masks_of_signs();
        Ok(Some((all, values)))
    }

    /// Lowers the reached steps of `graph`, whose inputs are distributed as `sources`.
    pub fn of(
        graph: &Graph,
        reached: &[bool],
        sources: &[Source],
        symbols: &Symbols,
    ) -> Result<Algebraic<'static>, Fault> {
        Self::made(graph, reached, sources, symbols, false)
    }

    /// Lowers with a symbol for each root of an integer, so that relations with rational
    /// coefficients are distinguished from those that hold for one value of √2 modulo one prime.
    pub fn formal(
        graph: &Graph,
        reached: &[bool],
        sources: &[Source],
        symbols: &Symbols,
    ) -> Result<Algebraic<'static>, Fault> {
        Self::made(graph, reached, sources, symbols, true)
    }

    fn made(
        graph: &Graph,
        reached: &[bool],
        sources: &[Source],
        symbols: &Symbols,
        has_formal_numbers: bool,
    ) -> Result<Algebraic<'static>, Fault> {
        let constants = graph.steps().zip(reached).filter_map(|(step, reached)| match step {
            Step::Unary(Function::Sqrt, a) | Step::Power(a, _) if *reached => Some(a),
            _ => None,
        });
        let numbers = Numbers::of(constants.filter_map(|place| match graph.step(place) {
            Step::Constant(value) => Some(value),
            _ => None,
        }));
        let mut lowering = Lowering {
            sources: sources.to_vec(),
            bases: Vec::new(),
            base_of: FxHashMap::default(),
            link_of: FxHashMap::default(),
            number_roots: BTreeMap::new(),
            has_formal_numbers,
            place: 0,
            moduli: Vec::new(),
            odd: Vec::new(),
            numbers,
            symbols,
            made: vec![None; symbols.count],
        };
        let (graph, values) = record(sources.len(), |inputs| {
            graph.replay(reached, inputs, |place, step, values| {
                lowering.step(graph, place, step, values)
            })
        })?;
        let Lowering { sources: all, bases, moduli, odd, numbers, number_roots, .. } = lowering;
        let integer =
            |(index, roots): (usize, Vec<Expr>)| (numbers.integer(index), roots.len() as u32);
        let numbers = number_roots.into_iter().map(integer).collect();
        let signs = all.iter().enumerate().filter(|(_, source)| **source == Source::Sign);
        let bits = signs.zip(0..).map(|((input, _), bit)| (input, bit)).collect();
        let mut algebraic = Algebraic {
            graph: Held::Own(graph),
            values,
            sources: all,
            original_inputs: sources.len(),
            bases,
            moduli,
            odd,
            numbers,
            masks: Vec::new(),
            bits,
        };
        algebraic.masks = algebraic.masks_of_signs();
        Ok(algebraic)
    }

    fn masks_of_signs(&self) -> Vec<u128> {
        let mut masks: Vec<u128> = Vec::with_capacity(self.graph.len());
        for step in self.graph.steps() {
            let mask = match step {
                Step::Input(input) => self.bit(input),
                step => step.arguments().fold(0, |mask, argument| mask | masks[argument]),
            };
            masks.push(mask);
        }
        masks
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
            Step::Input(input) => {
                reached[place]
                    && input >= self.original_inputs
                    && self.sources[input] != Source::Sign
            }
            _ => false,
        })
    }
}

/// State of a lowering.
struct Lowering<'s> {
    sources: Vec<Source>,
    bases: Vec<Base>,
    /// Index of the base of a radicand.
    base_of: FxHashMap<Expr, usize>,
    /// Index of the base of a link, and n where it is a root of index 2^n.
    link_of: FxHashMap<Expr, (usize, u32)>,
    /// Roots √n, √√n, … of the integers of which constants are products.
    number_roots: BTreeMap<usize, Vec<Expr>>,
    /// Whether these roots are symbols.
    has_formal_numbers: bool,
    /// Place of the step under way.
    place: usize,
    moduli: Vec<Modulus>,
    odd: Vec<(Expr, u64)>,
    numbers: Numbers,
    symbols: &'s Symbols,
    made: Vec<Option<Expr>>,
}

impl Lowering<'_> {
    fn input(&mut self, source: Source) -> Expr {
        self.sources.push(source);
        Expr::input()
    }

    /// Returns the symbol with this index, made on first use.
    fn symbol(&mut self, number: usize) -> Expr {
        if let Some(made) = self.made[number] {
            return made;
        }
        let symbol = self.input(Source::Uniform);
        self.made[number] = Some(symbol);
        symbol
    }

    /// Finds the value of a step that is not computed as it stands; undefined if it cannot be
    /// computed in a field.
    fn step(
        &mut self,
        graph: &Graph,
        place: usize,
        step: Step<'_>,
        values: &[Option<Expr>],
    ) -> Option<Expr> {
        self.place = place;
        let made = match step {
            Step::Unary(Function::Sqrt, a) => self.power(graph, a, &Rational::new(1, 2), values),
            Step::Unary(Function::Abs, a) => values[a].map(|argument| {
                let sign = self.sources.len();
                let value = self.input(Source::Sign) * argument;
                self.moduli.push(Modulus { place, argument, sign });
                value
            }),
            Step::Power(a, exponent) if exponent.to_integer().is_none() => {
                self.power(graph, a, exponent, values)
            }
            Step::Unary(
                Function::Exp | Function::Ln | Function::Sin | Function::Cos | Function::Atan,
                _,
            )
            | Step::Binary(Operation::Pow, ..) => self.transcendental(graph, place, values),
            _ => return None,
        };
        Some(made.unwrap_or_else(undefined))
    }

    /// Computes the value at a place to a non-integer power.
    fn power(
        &mut self,
        graph: &Graph,
        place: usize,
        exponent: &Rational,
        values: &[Option<Expr>],
    ) -> Option<Expr> {
        if let Step::Constant(constant) = graph.step(place) {
            let powers = self.numbers.powers(constant)?;
            let mut product = Expr::rational(&Rational::from(1));
            for (number, power) in powers {
                product *= self.number_root(number, &(exponent * &Rational::from(power)))?;
            }
            return Some(product);
        }
        let value = values[place]?;
        if let Some((base, length)) = self.link_of.get(&value).copied() {
            let shorter = Rational::new(1, 1i64.checked_shl(length)?);
            return self.root(base, &(exponent * &shorter));
        }
        let next = self.bases.len();
        let base = *self.base_of.entry(value).or_insert(next);
        if base == next {
            self.bases.push(Base {
                radicand: value,
                arguments: Vec::new(),
                first: self.place,
                links: Vec::new(),
            });
        }
        if !self.bases[base].arguments.contains(&place) {
            self.bases[base].arguments.push(place);
        }
        self.root(base, exponent)
    }

    /// Computes n^q for an integer n, given by its index.
    fn number_root(&mut self, number: usize, exponent: &Rational) -> Option<Expr> {
        let radicand = Expr::rational(&self.numbers.integer(number));
        let Parts { whole, part, length, odd, j } = Parts::of(exponent)?;
        let mut value = radicand.power(&Rational::from(whole));
        if part != 0 {
            value *= self.number_link(number, length).power(&Rational::from(part));
        }
        Some(value * self.odd_root(radicand, odd, j))
    }

    /// Returns the root of index 2^length of an integer.
    fn number_link(&mut self, number: usize, length: u32) -> Expr {
        let mut roots = self.number_roots.remove(&number).unwrap_or_default();
        while roots.len() < length as usize {
            let radicand = Expr::rational(&self.numbers.integer(number));
            let last = roots.last().copied().unwrap_or(radicand);
            roots.push(match self.has_formal_numbers {
                true => self.input(Source::Uniform),
                false => last.apply(Function::Sqrt),
            });
        }
        let value = roots[length as usize - 1];
        self.number_roots.insert(number, roots);
        value
    }

    /// Computes X^(j/m) for odd m.
    fn odd_root(&mut self, radicand: Expr, odd: i64, j: i64) -> Expr {
        if j == 0 {
            return Expr::rational(&Rational::from(1));
        }
        if !self.odd.contains(&(radicand, odd as u64)) {
            self.odd.push((radicand, odd as u64));
        }
        radicand.power(&Rational::new(1, odd)).power(&Rational::from(j))
    }

    /// Computes X^q for a base X: X^n, times a power of a link, times a power of a root of odd
    /// index.
    fn root(&mut self, base: usize, exponent: &Rational) -> Option<Expr> {
        let Parts { whole, part, length, odd, j } = Parts::of(exponent)?;
        let radicand = self.bases[base].radicand;
        let mut value = radicand.power(&Rational::from(whole));
        if part != 0 {
            value *= self.link(base, length).power(&Rational::from(part));
        }
        Some(value * self.odd_root(radicand, odd, j))
    }

    /// Returns the root of index 2^length of a base.
    fn link(&mut self, base: usize, length: u32) -> Expr {
        while self.bases[base].links.len() < length as usize {
            let Base { radicand, links, .. } = &self.bases[base];
            let last = links.last().map_or(*radicand, |(value, _)| *value);
            let sign = self.sources.len();
            let value = self.input(Source::Sign) * last.apply(Function::Sqrt);
            self.bases[base].links.push((value, sign));
            let length = self.bases[base].links.len() as u32;
            self.link_of.insert(value, (base, length));
        }
        self.bases[base].links[length as usize - 1].0
    }

    fn transcendental(
        &mut self,
        graph: &Graph,
        place: usize,
        values: &[Option<Expr>],
    ) -> Option<Expr> {
        let symbols = self.symbols;
        match symbols.forms.get(&place)? {
            Form::Opaque(number) => Some(self.symbol(*number)),
            Form::Product { base, powers } => {
                let mut product = match base {
                    Some((base, exponent)) if exponent.to_integer().is_some() => {
                        values[*base]?.power(exponent)
                    }
                    Some((base, exponent)) => self.power(graph, *base, exponent, values)?,
                    None => Expr::rational(&Rational::from(1)),
                };
                for (number, exponent) in powers {
                    let symbol = self.symbol(*number);
                    product *= symbol.power(&Rational::from(*exponent));
                }
                Some(product)
            }
            Form::Angle { multiples, sine } => {
                let one = Expr::rational(&Rational::from(1));
                // (c + i s)^n of each, multiplied: cosine and sine of the sum.
                let (mut cosine_of, mut sine_of) = (one, Expr::rational(&Rational::from(0)));
                for (number, multiple) in multiples {
                    let t = self.symbol(*number);
                    let length = (one + t * t).apply(Function::Recip);
                    let (c, mut s) = ((one - t * t) * length, (t + t) * length);
                    if *multiple < 0 {
                        s = -s;
                    }
                    for _ in 0..multiple.unsigned_abs() {
                        (cosine_of, sine_of) =
                            (cosine_of * c - sine_of * s, cosine_of * s + sine_of * c);
                    }
                }
                Some(if *sine { sine_of } else { cosine_of })
            }
        }
    }
}

/// An exponent in the form n + i/2^s + j/m with 0 ≤ i < 2^s and 0 ≤ j < m, m odd.
struct Parts {
    /// Integer part n.
    whole: i64,
    /// Numerator i.
    part: i64,
    /// Exponent s.
    length: u32,
    /// Odd denominator m.
    odd: i64,
    /// Numerator j.
    j: i64,
}

impl Parts {
    fn of(exponent: &Rational) -> Option<Self> {
        let (above, below) = exponent.parts();
        let (above, below) = (i64::try_from(&above).ok()?, i64::try_from(&below).ok()?);
        let length = below.trailing_zeros();
        if length > LONGEST_CHAIN || above.abs() > 1 << 40 {
            return None;
        }
        let (even, odd) = (1i64 << length, below >> length);
        if odd > i64::from(i32::MAX) {
            return None;
        }
        let inverse = num_integer::Integer::extended_gcd(&even, &odd).x.rem_euclid(odd);
        let j = (i128::from(above) * i128::from(inverse)).rem_euclid(i128::from(odd)) as i64;
        let r = (above - j * even) / odd;
        let (whole, part) = (r.div_euclid(even), r.rem_euclid(even));
        Some(Self { whole, part, length, odd, j })
    }
}

/// Makes an undefined value.
fn undefined() -> Expr {
    Expr::rational(&Rational::from(0)).apply(Function::Recip)
}
