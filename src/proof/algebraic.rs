//! A computation made algebraic: what a prime field cannot compute is replaced by new inputs.
//!
//! ```text
//! √X           ε √X with a sign ε of its own; √(a/b) of a rational by roots of primes
//! |X|          ε X
//! x^(a/b)      nested square roots for the even part of b, a power of odd index for the rest
//! exp, x^y     products of symbols, one for each element of a basis of the arguments
//! sin, cos     points of the circle, the same
//! ln, atan     one symbol each
//! ```
//!
//! Symbols are independent of everything by fiat: what vanishes for them vanishes for the
//! functions, but not the other way round.

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::number::rational::Rational;
use crate::number::{Function, Operation};
use crate::scalar::Scalar;

use super::bounds::Source;
use super::symbols::{Form, Symbols};

/// A square root or a modulus, with the input that is its sign.
#[derive(Clone, Copy, Debug)]
pub struct Root {
    /// The step of the original graph, if it is a root or a modulus there.
    pub place: Option<usize>,
    /// What the root is taken of; for |X|, X.
    pub radicand: Expr,
    /// The input that holds the sign.
    pub sign: usize,
    /// Is it |X| rather than √X?
    pub is_modulus: bool,
}

/// An algebraic graph made from another one.
pub struct Algebraic {
    /// The graph.
    pub graph: Graph,
    /// The new value of each place of the original graph that was asked for and could be had.
    pub values: Vec<Option<Expr>>,
    /// What each input is.
    pub sources: Vec<Source>,
    /// How many of the inputs are those of the original; symbols and signs follow.
    pub original_inputs: usize,
    /// Roots and moduli, each after those it contains.
    pub roots: Vec<Root>,
    /// Primes whose roots must exist in a field.
    pub squares: Vec<u64>,
    /// Odd root indices, each with the step it belongs to.
    pub odd: Vec<(Expr, u64)>,
}

/// Prime factors of constants under a root are looked for up to here.
const LARGEST_FACTOR: u64 = 1 << 20;

/// What is made on the way.
struct Lowering<'s> {
    sources: Vec<Source>,
    roots: Vec<Root>,
    squares: Vec<u64>,
    odd: Vec<(Expr, u64)>,
    symbols: &'s Symbols,
    made: Vec<Option<Expr>>,
}

impl Algebraic {
    /// Lowers the reached steps of `graph`, whose inputs are `sources`.
    pub fn of(
        graph: &Graph,
        reached: &[bool],
        sources: &[Source],
        symbols: &Symbols,
    ) -> Result<Self, Fault> {
        let mut lowering = Lowering {
            sources: sources.to_vec(),
            roots: Vec::new(),
            squares: Vec::new(),
            odd: Vec::new(),
            symbols,
            made: vec![None; symbols.count],
        };
        let (graph, values) = record(sources.len(), |inputs| {
            graph.replay(reached, inputs, |place, step, values| {
                lowering.step(graph, place, step, values)
            })
        })?;
        let Lowering { sources: all, roots, squares, odd, .. } = lowering;
        let original_inputs = sources.len();
        Ok(Self { graph, values, sources: all, original_inputs, roots, squares, odd })
    }
}

impl Lowering<'_> {
    fn input(&mut self, source: Source) -> Expr {
        self.sources.push(source);
        Expr::input()
    }

    /// The symbol of this number, made when it is first needed.
    fn symbol(&mut self, number: usize, source: Source) -> Expr {
        if let Some(made) = self.made[number] {
            return made;
        }
        let symbol = self.input(source);
        self.made[number] = Some(symbol);
        symbol
    }

    fn step(
        &mut self,
        graph: &Graph,
        place: usize,
        step: Step<'_>,
        values: &[Option<Expr>],
    ) -> Option<Expr> {
        match step {
            Step::Unary(Function::Sqrt, a) => {
                let radicand = values[a]?;
                match graph.step(a) {
                    Step::Constant(value) => self.constant_root(value, radicand),
                    _ => Some(self.root(Some(place), radicand)),
                }
            }
            Step::Unary(Function::Abs, a) => {
                let radicand = values[a]?;
                let sign = self.sources.len();
                let value = self.input(Source::Sign) * radicand;
                self.roots.push(Root { place: Some(place), radicand, sign, is_modulus: true });
                Some(value)
            }
            Step::Power(a, exponent) if exponent.to_integer().is_none() => {
                self.power(values[a]?, exponent)
            }
            Step::Unary(
                Function::Exp | Function::Ln | Function::Sin | Function::Cos | Function::Atan,
                _,
            )
            | Step::Binary(Operation::Pow, ..) => self.transcendental(place, values),
            _ => None,
        }
    }

    fn root(&mut self, place: Option<usize>, radicand: Expr) -> Expr {
        let sign = self.sources.len();
        let value = self.input(Source::Sign) * radicand.apply(Function::Sqrt);
        self.roots.push(Root { place, radicand, sign, is_modulus: false });
        value
    }

    /// √(a/b) = √(ab)/b, the root of an integer as a product of roots of primes. Left as it is,
    /// and so without value in the fields, where a factor is too large or the number negative.
    fn constant_root(&mut self, value: &Rational, radicand: Expr) -> Option<Expr> {
        let plain = Some(radicand.apply(Function::Sqrt));
        let Some((above, below)) = value.small_parts() else { return plain };
        let Some(mut rest) = above.checked_mul(below).filter(|n| *n > 0) else { return plain };
        let (mut product, mut divisor) = (Rational::new(1, below), 2);
        let mut primes = Vec::new();
        while divisor <= rest {
            if divisor * divisor > rest {
                divisor = rest;
            }
            if divisor as u64 > LARGEST_FACTOR {
                return plain;
            }
            let mut odd = false;
            while rest % divisor == 0 {
                rest /= divisor;
                if odd {
                    product = &product * &Rational::from(divisor);
                }
                odd = !odd;
            }
            if odd {
                primes.push(divisor as u64);
            }
            divisor += 1;
        }
        let mut root = Expr::rational(&product);
        for prime in primes {
            root *= Expr::rational(&Rational::from(prime as i64)).apply(Function::Sqrt);
            if !self.squares.contains(&prime) {
                self.squares.push(prime);
            }
        }
        Some(root)
    }

    /// x^(a/b) by nested square roots and a root of odd index.
    fn power(&mut self, base: Expr, exponent: &Rational) -> Option<Expr> {
        let (above, below) = exponent.parts();
        let (above, mut index) = (i64::try_from(&above).ok()?, u64::try_from(&below).ok()?);
        let mut value = base;
        while index % 2 == 0 {
            value = self.root(None, value);
            index /= 2;
        }
        if index > 1 && !self.odd.contains(&(value, index)) {
            self.odd.push((value, index));
        }
        Some(value.power(&Rational::new(above, i64::try_from(index).ok()?)))
    }

    fn transcendental(&mut self, place: usize, values: &[Option<Expr>]) -> Option<Expr> {
        let symbols = self.symbols;
        match symbols.forms.get(&place)? {
            Form::Opaque(number, source) => Some(self.symbol(*number, *source)),
            Form::Product { base, powers } => {
                let mut product = match base {
                    Some((base, exponent)) if exponent.to_integer().is_some() => {
                        values[*base]?.power(exponent)
                    }
                    Some((base, exponent)) => self.power(values[*base]?, exponent)?,
                    None => Expr::rational(&Rational::from(1)),
                };
                for (number, exponent) in powers {
                    let symbol = self.symbol(*number, Source::Square);
                    product *= symbol.power(&Rational::from(*exponent));
                }
                Some(product)
            }
            Form::Angle { multiples, sine } => {
                let one = Expr::rational(&Rational::from(1));
                // (c + i s)^n of each, multiplied: cos and sin of the sum.
                let (mut cosine_of, mut sine_of) = (one, Expr::rational(&Rational::from(0)));
                for (number, multiple) in multiples {
                    let t = self.symbol(*number, Source::Uniform);
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
