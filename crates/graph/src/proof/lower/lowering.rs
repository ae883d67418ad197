//! The lowering of a graph, step by step.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::bounds::InputDistribution;
use crate::proof::numbers::Numbers;
use crate::proof::symbols::{SymbolForm, Symbols};
use crate::scalar::Scalar;

use super::{Algebraic, Base, Held, ModulusSign};

impl Algebraic<'_> {
    /// Lowers the reached steps of `graph`, whose inputs are distributed as `sources`.
    pub fn of(
        graph: &Graph,
        reached: &[bool],
        sources: &[InputDistribution],
        symbols: &Symbols,
    ) -> Result<Algebraic<'static>, Fault> {
        Self::made(graph, reached, sources, symbols, false)
    }

    /// Lowers with either root of each integer, drawn by a sign, and a symbol for each further root, so that relations
    /// with rational coefficients are distinguished from those that hold for one value of √2 modulo one prime.
    pub fn formal(
        graph: &Graph,
        reached: &[bool],
        sources: &[InputDistribution],
        symbols: &Symbols,
    ) -> Result<Algebraic<'static>, Fault> {
        Self::made(graph, reached, sources, symbols, true)
    }

    fn made(
        graph: &Graph,
        reached: &[bool],
        sources: &[InputDistribution],
        symbols: &Symbols,
        has_formal_numbers: bool,
    ) -> Result<Algebraic<'static>, Fault> {
        let constants = graph.steps().zip(reached).filter_map(|(step, reached)| match step {
            Step::Unary(UnaryFunction::Sqrt, a) | Step::Power(a, _) if *reached => Some(a),
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
        let signs =
            all.iter().enumerate().filter(|(_, source)| **source == InputDistribution::Sign);
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
        algebraic.add_masks();
        Ok(algebraic)
    }
}

/// State of a lowering.
pub(super) struct Lowering<'s> {
    pub(super) sources: Vec<InputDistribution>,
    pub(super) bases: Vec<Base>,
    /// Index of the base of a radicand.
    pub(super) base_of: FxHashMap<Expr, usize>,
    /// Index of the base of a link, and n where it is a root of index 2^n.
    pub(super) link_of: FxHashMap<Expr, (usize, u32)>,
    /// Roots √n, √√n, … of the integers of which constants are products.
    pub(super) number_roots: BTreeMap<usize, Vec<Expr>>,
    /// Whether these roots are symbols.
    pub(super) has_formal_numbers: bool,
    /// Place of the step under way.
    pub(super) place: usize,
    moduli: Vec<ModulusSign>,
    pub(super) odd: Vec<(Expr, u64)>,
    pub(super) numbers: Numbers,
    symbols: &'s Symbols,
    made: Vec<Option<Expr>>,
}

impl Lowering<'_> {
    pub(super) fn input(&mut self, source: InputDistribution) -> Expr {
        self.sources.push(source);
        Expr::input()
    }

    /// Returns the symbol with this index, made on first use.
    fn symbol(&mut self, number: usize) -> Expr {
        if let Some(made) = self.made[number] {
            return made;
        }
        let symbol = self.input(InputDistribution::Uniform);
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
            Step::Unary(UnaryFunction::Sqrt, a) => {
                self.power(graph, a, &Rational::new(1, 2), values)
            }
            Step::Unary(UnaryFunction::Abs, a) => values[a].map(|argument| {
                let sign = self.sources.len();
                let value = self.input(InputDistribution::Sign) * argument;
                self.moduli.push(ModulusSign { place, argument, sign });
                value
            }),
            Step::Power(a, exponent) if exponent.to_integer().is_none() => {
                self.power(graph, a, exponent, values)
            }
            Step::Unary(
                UnaryFunction::Exp
                | UnaryFunction::Ln
                | UnaryFunction::Sin
                | UnaryFunction::Cos
                | UnaryFunction::Atan,
                _,
            )
            | Step::Binary(BinaryOperation::Pow, ..) => self.transcendental(graph, place, values),
            _ => return None,
        };
        Some(made.unwrap_or_else(Expr::undefined))
    }

    fn transcendental(
        &mut self,
        graph: &Graph,
        place: usize,
        values: &[Option<Expr>],
    ) -> Option<Expr> {
        let symbols = self.symbols;
        match symbols.forms.get(&place)? {
            SymbolForm::Opaque(number) => Some(self.symbol(*number)),
            SymbolForm::Product { base, powers } => {
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
            SymbolForm::Angle { multiples, turns, sine } => {
                let one = Expr::rational(&Rational::from(1));
                // (c + i s)^n of each, multiplied: cosine and sine of the sum.
                let (mut cosine_of, mut sine_of) = (one, Expr::rational(&Rational::from(0)));
                for (number, multiple) in multiples {
                    let t = self.symbol(*number);
                    let length = (one + t * t).apply(UnaryFunction::Recip);
                    let (c, mut s) = ((one - t * t) * length, (t + t) * length);
                    if *multiple < 0 {
                        s = -s;
                    }
                    for _ in 0..multiple.unsigned_abs() {
                        (cosine_of, sine_of) =
                            (cosine_of * c - sine_of * s, cosine_of * s + sine_of * c);
                    }
                }
                for _ in 0..*turns {
                    (cosine_of, sine_of) = (-sine_of, cosine_of);
                }
                Some(if *sine { sine_of } else { cosine_of })
            }
        }
    }
}
