//! Symbols for transcendental functions, one for each element of a basis of their arguments.
//!
//! A separate symbol for each exp, sin and x^y would lose exp(2x) = exp(x)² and sin 2φ = 2 sin φ
//! cos φ. The arguments are therefore written in a basis over the rationals, and exp(Σ n_i e_i)
//! becomes Π T_i^n_i, sin and cos become polynomials in points of the circle.

use rustc_hash::FxHashMap;

use crate::graph::{Graph, Step};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};

use super::relations::{Combination, RelationSearch};

/// Indices of symbols, each with its integer multiple.
type Multiples = Vec<(usize, i64)>;

/// Largest multiple of a basis element; beyond it an argument gets a symbol to itself.
const LARGEST_MULTIPLE: i64 = 64;

/// The form of a transcendental step in terms of symbols.
#[derive(Clone, Debug, PartialEq)]
pub enum SymbolForm {
    /// A separate symbol.
    Opaque(usize),
    /// base^q · Π T_i^n_i
    Product {
        /// For x^y: the place of x, and the rational part of the exponent.
        base: Option<(usize, Rational)>,
        /// Symbols with their powers.
        powers: Vec<(usize, i64)>,
    },
    /// The sine or cosine of Σ n_i e_i + turns π/2.
    Angle {
        /// Symbols with their multiples.
        multiples: Vec<(usize, i64)>,
        /// Number of quarter turns, from 0 to 3.
        turns: u8,
        /// Whether the function is the sine.
        sine: bool,
    },
}

/// Forms of all transcendental steps of a graph.
#[derive(Clone, Debug, Default)]
pub struct Symbols {
    /// Form by place.
    pub forms: FxHashMap<usize, SymbolForm>,
    /// Number of symbols.
    pub count: usize,
}

impl Symbols {
    /// Gives every transcendental step a separate symbol.
    pub fn opaque(graph: &Graph, reached: &[bool]) -> Self {
        let mut symbols = Self::default();
        for (place, _) in transcendental(graph, reached) {
            symbols.forms.insert(place, SymbolForm::Opaque(symbols.count));
            symbols.count += 1;
        }
        symbols
    }

    /// Number of functions with a symbol of their own.
    pub fn opaque_count(&self) -> usize {
        self.forms.values().filter(|form| matches!(form, SymbolForm::Opaque(_))).count()
    }

    /// Gives each element of a basis a symbol; `relations` finds linear relations between values of
    /// the graph, proved like any identity.
    pub fn by_basis(graph: &Graph, reached: &[bool], relations: &mut RelationSearch<'_>) -> Self {
        let mut symbols = Self::opaque(graph, reached);
        let steps: Vec<(usize, Step<'_>)> = transcendental(graph, reached).collect();
        let exponentials: Vec<(usize, usize, bool)> = steps
            .iter()
            .filter_map(|(place, step)| match step {
                Step::Unary(UnaryFunction::Exp, a) => Some((*place, *a, false)),
                _ => None,
            })
            .collect();
        symbols.exponentials(None, &exponentials, relations);
        // Equal or reciprocal bases share their symbols: (1/x)^y = x^(-y).
        let mut bases: Vec<Vec<(usize, bool)>> = Vec::new();
        for (_, step) in &steps {
            let Step::Binary(BinaryOperation::Pow, base, _) = step else { continue };
            if bases.iter().flatten().any(|(known, _)| known == base) {
                continue;
            }
            let same = bases
                .iter_mut()
                .find_map(|class| Some((relations.is_reciprocal(class[0].0, *base)?, class)));
            match same {
                Some((inverse, class)) => class.push((*base, inverse)),
                None => bases.push(vec![(*base, false)]),
            }
        }
        for class in bases {
            let powers: Vec<(usize, usize, bool)> = steps
                .iter()
                .filter_map(|(place, step)| match step {
                    Step::Binary(BinaryOperation::Pow, a, b) => {
                        let (_, inverse) = class.iter().find(|(base, _)| base == a)?;
                        Some((*place, *b, *inverse))
                    }
                    _ => None,
                })
                .collect();
            symbols.exponentials(Some(class[0].0), &powers, relations);
        }
        let angles: Vec<(usize, usize, bool)> = steps
            .iter()
            .filter_map(|(place, step)| match step {
                Step::Unary(UnaryFunction::Sin, a) => Some((*place, *a, true)),
                Step::Unary(UnaryFunction::Cos, a) => Some((*place, *a, false)),
                _ => None,
            })
            .collect();
        let eighth = steps.iter().find_map(|(place, step)| match step {
            Step::Unary(UnaryFunction::Atan, a) if is_one(graph, *a) => Some(*place),
            _ => None,
        });
        let is_turned = eighth.is_some_and(|eighth| symbols.turned(eighth, &angles, relations));
        if !is_turned {
            symbols.angles(&angles, relations);
        }
        symbols
    }

    /// Forms exp(e), or x^e for a base x, for several places and exponents e, or -e where so
    /// flagged.
    fn exponentials(
        &mut self,
        base: Option<usize>,
        steps: &[(usize, usize, bool)],
        relations: &mut RelationSearch<'_>,
    ) {
        let arguments: Vec<usize> = steps.iter().map(|(_, argument, _)| *argument).collect();
        // With a base, the exponent 1 is a basis element: x^1 = x.
        let Some(combinations) = relations.between(&arguments, base.is_some()) else { return };
        let Some((first, multiples)) = self.allot(&combinations) else { return };
        for (((place, _, inverse), multiples), combination) in
            steps.iter().zip(multiples).zip(combinations)
        {
            let sign = if *inverse { -1 } else { 1 };
            let powers = multiples.into_iter().map(|(k, n)| (first + k, sign * n)).collect();
            let constant = &combination.constant * &Rational::from(sign);
            let base = base.map(|base| (base, constant));
            self.forms.insert(*place, SymbolForm::Product { base, powers });
        }
    }

    fn angles(&mut self, steps: &[(usize, usize, bool)], relations: &mut RelationSearch<'_>) {
        let arguments: Vec<usize> = steps.iter().map(|(_, argument, _)| *argument).collect();
        let Some(combinations) = relations.between(&arguments, false) else { return };
        let Some((first, multiples)) = self.allot(&combinations) else { return };
        for ((place, _, sine), multiples) in steps.iter().zip(multiples) {
            let multiples = multiples.into_iter().map(|(k, n)| (first + k, n)).collect();
            self.forms.insert(*place, SymbolForm::Angle { multiples, turns: 0, sine: *sine });
        }
    }

    /// Forms sines and cosines of angles that contain whole multiples of π/2, given the place of
    /// π/4 = atan 1; returns whether all multiples are whole.
    fn turned(
        &mut self,
        eighth: usize,
        steps: &[(usize, usize, bool)],
        relations: &mut RelationSearch<'_>,
    ) -> bool {
        // π/4 comes first, and so is an element of the basis.
        let arguments: Vec<usize> =
            std::iter::once(eighth).chain(steps.iter().map(|(_, argument, _)| *argument)).collect();
        let Some(combinations) = relations.between(&arguments, false) else { return false };
        let Some(turns) = combinations[1..].iter().map(quarters).collect::<Option<Vec<u8>>>()
        else {
            return false;
        };
        let rest: Vec<Combination> = combinations[1..]
            .iter()
            .map(|combination| Combination {
                constant: combination.constant.clone(),
                multiples: combination.multiples[1..].to_vec(),
            })
            .collect();
        let Some((first, multiples)) = self.allot(&rest) else { return false };
        for (((place, _, sine), turns), multiples) in steps.iter().zip(turns).zip(multiples) {
            let multiples = multiples.into_iter().map(|(k, n)| (first + k, n)).collect();
            self.forms.insert(*place, SymbolForm::Angle { multiples, turns, sine: *sine });
        }
        true
    }

    /// Allots new symbols to the basis, each for a part of its element small enough for all
    /// multiples to be integers; returns the index of the first, and the multiples of each
    /// combination.
    fn allot(&mut self, combinations: &[Combination]) -> Option<(usize, Vec<Multiples>)> {
        let width = combinations.iter().map(|c| c.multiples.len()).max().unwrap_or(0);
        let mut parts = vec![1i64; width];
        for combination in combinations {
            for (part, multiple) in parts.iter_mut().zip(&combination.multiples) {
                let (_, below) = multiple.small_parts()?;
                *part = num_integer::lcm(*part, below);
            }
        }
        let mut all = Vec::new();
        for combination in combinations {
            let mut multiples = Vec::new();
            for (k, multiple) in combination.multiples.iter().enumerate() {
                let whole = (multiple * &Rational::from(parts[k])).to_integer()?;
                if whole.abs() > LARGEST_MULTIPLE {
                    return None;
                }
                if whole != 0 {
                    multiples.push((k, whole));
                }
            }
            all.push(multiples);
        }
        let first = self.count;
        self.count += width;
        Some((first, all))
    }
}

/// Whether the step at this place is the constant 1.
fn is_one(graph: &Graph, place: usize) -> bool {
    let step = graph.steps().nth(place);
    matches!(step, Some(Step::Constant(value)) if *value == Rational::from(1))
}

/// Number of quarter turns, from 0 to 3, that a combination contains besides the rest, its first
/// element being π/4; `None` if the number is not whole.
fn quarters(combination: &Combination) -> Option<u8> {
    let halves = combination.multiples.first()?.to_integer()?;
    if halves % 2 != 0 {
        return None;
    }
    u8::try_from((halves / 2).rem_euclid(4)).ok()
}

/// Lists the reached transcendental steps with their places, in order.
pub fn transcendental<'g>(
    graph: &'g Graph,
    reached: &'g [bool],
) -> impl Iterator<Item = (usize, Step<'g>)> {
    graph.steps().enumerate().filter(|(place, step)| {
        reached[*place]
            && matches!(
                step,
                Step::Unary(
                    UnaryFunction::Exp
                        | UnaryFunction::Ln
                        | UnaryFunction::Sin
                        | UnaryFunction::Cos
                        | UnaryFunction::Atan,
                    _
                ) | Step::Binary(BinaryOperation::Pow, ..)
            )
    })
}

/// Whether any reached step needs a symbol.
pub fn any(graph: &Graph, reached: &[bool]) -> bool {
    transcendental(graph, reached).next().is_some()
}
