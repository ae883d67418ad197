//! Formulas with the zeros of another one, in which each factor stands once: x − y for (x − y)², and
//! sin(u/2) for 1 − cos u. Rules F1 to F7 of docs/soundness-levels.md.

use super::Formula;
use super::arena::{Arena, Constant, ElementaryFunction, NodeId, NodeOperation};
use super::expanded::Reading;
use super::kind::Type;
use super::reduced::Reduced;
use super::scope::Symbol;
use crate::number::rational::Rational;
use crate::proof::{MOST_POLYNOMIAL_WORK, Polynomial};

/// Largest number of factors.
const MOST_FACTORS: usize = 16;

impl Formula {
    /// Returns formulas that are all 0 at exactly those points at which this one is 0, and that have values where it
    /// has: one in which each factor stands once, or several for a sum of squares. `None` if each factor stands
    /// once already, as far as is known. Slopes of squares are independent along the coordinates; `is_fixed` tells
    /// parameters.
    pub(crate) fn with_simple_factors(
        &self,
        is_coordinate: &dyn Fn(Symbol) -> bool,
        is_fixed: &dyn Fn(Symbol) -> bool,
    ) -> Option<Vec<Formula>> {
        let mut arena = self.arena.clone();
        let whole = arena.nodes.len().checked_sub(1)?;
        let product = Product::of(&mut arena, whole)?;
        let simpler = Simpler::of(&arena, &product, is_coordinate, is_fixed)?;
        let of_all = |above: Vec<Factor>| {
            let mut arena = arena.clone();
            let own = above.into_iter().map(|own| simpler.pushed(&mut arena, own, whole));
            let above: Vec<NodeId> = own.collect();
            let above: Vec<NodeId> = above.into_iter().chain(product.roots.clone()).collect();
            let [above, below] = [&above, &product.below].map(|all| {
                all.iter()
                    .copied()
                    .reduce(|a, b| arena.scalar(NodeOperation::Multiply(a, b), whole))
            });
            let last = match (above?, below) {
                (above, None) => above,
                (above, Some(below)) => arena.scalar(NodeOperation::Divide(above, below), whole),
            };
            Some(Formula { text: self.text.clone(), arena: arena.ending_at(last) })
        };
        simpler.equations.iter().cloned().map(of_all).collect()
    }
}

impl Arena {
    /// Appends a scalar that belongs to the text of a node.
    pub(super) fn scalar(&mut self, operation: NodeOperation, of: NodeId) -> NodeId {
        let span = self.nodes[of].span.clone();
        self.push(operation, Type::Scalar, span)
    }
}

/// A formula as a quotient of products.
#[derive(Default)]
struct Product {
    /// Factors that are no products, powers or moduli.
    above: Vec<NodeId>,
    /// Roots, and their powers: √x has no slope where x has one.
    roots: Vec<NodeId>,
    below: Vec<NodeId>,
    /// Whether powers or moduli were left out.
    is_simpler: bool,
}

impl Product {
    fn of(arena: &mut Arena, whole: NodeId) -> Option<Self> {
        let mut found = Self::default();
        let mut open = vec![(whole, Rational::from(1))];
        while let Some((node, exponent)) = open.pop() {
            if open.len() + found.above.len() + found.roots.len() > MOST_FACTORS {
                return None;
            }
            match &arena.nodes[node].operation {
                NodeOperation::Number(value) if value.is_zero() => return None,
                NodeOperation::Number(_) => {}
                NodeOperation::Negate(a) => open.push((*a, exponent)),
                NodeOperation::Function(ElementaryFunction::Modulus, a) => {
                    found.is_simpler = true;
                    open.push((*a, exponent));
                }
                NodeOperation::Multiply(a, b) => {
                    open.extend([(*b, exponent.clone()), (*a, exponent)]);
                }
                NodeOperation::Product(all) => {
                    open.extend(all.iter().rev().map(|own| (*own, exponent.clone())));
                }
                NodeOperation::Divide(a, b) => {
                    found.below.push(*b);
                    open.push((*a, exponent));
                }
                NodeOperation::Power(a, power)
                    if power.to_integer().is_some_and(|power| power > 0) =>
                {
                    open.push((*a, &exponent * power));
                }
                _ if is_root(arena, node) => {
                    let is_power = !exponent.is_one();
                    let power = NodeOperation::Power(node, exponent);
                    found.roots.push(if is_power { arena.scalar(power, whole) } else { node });
                }
                _ => {
                    found.is_simpler |= !exponent.is_one();
                    found.above.push(node);
                }
            }
        }
        Some(found)
    }
}

/// Whether a node is a root or a power that has no value beyond the zeros of its base.
fn is_root(arena: &Arena, node: NodeId) -> bool {
    matches!(
        arena.nodes[node].operation,
        NodeOperation::Function(ElementaryFunction::Sqrt, _)
            | NodeOperation::Power(..)
            | NodeOperation::PowerOf(..)
    )
}

/// A factor that stands once.
#[derive(Clone)]
enum Factor {
    Node(NodeId),
    Polynomial(Polynomial),
    /// The sine or cosine of u/2 and some eighths of a turn, the root of 1 ∓ cos u or 1 ∓ sin u.
    Turn {
        function: ElementaryFunction,
        angle: NodeId,
        eighths: i64,
    },
}

/// Factors of equations that are 0 where a product is.
struct Simpler {
    equations: Vec<Vec<Factor>>,
    parts: Vec<NodeId>,
}

impl Simpler {
    fn of(
        arena: &Arena,
        product: &Product,
        is_coordinate: &dyn Fn(Symbol) -> bool,
        is_fixed: &dyn Fn(Symbol) -> bool,
    ) -> Option<Self> {
        let mut reading = Reading::of(arena)?;
        let (mut found, mut seen) = (Vec::new(), Vec::<Polynomial>::new());
        let (mut is_simpler, mut implied) = (product.is_simpler, Vec::<u32>::new());
        for node in &product.above {
            let mut own = reading.polynomial_or_part(*node)?;
            if let Some(reduced) = Reduced::of(arena, &reading, &own) {
                implied.extend(reduced.implied);
                own = reduced.polynomial;
            }
            let factors = own.factors();
            if own.is_zero() || seen.len() + factors.len() > MOST_FACTORS {
                return None;
            }
            let turned = |factor: &Polynomial| half_angle(arena, &reading.parts, factor);
            let is_fresh = factors.iter().all(|factor| !seen.contains(factor));
            let is_once = is_product(&own, &factors);
            let is_root = |factor: &Polynomial| {
                let variable = factor.as_term().and_then(|(_, exponents)| exponents.first());
                variable.is_some_and(|(own, _)| is_root(arena, reading.parts[*own as usize]))
            };
            let is_turned = factors.iter().any(|factor| turned(factor).is_some());
            if factors.iter().any(is_root) || is_fresh && is_once && !is_turned {
                found.push(Factor::Node(*node));
            } else {
                is_simpler = true;
                let new = factors.iter().filter(|factor| !seen.contains(factor));
                found.extend(new.map(|factor| {
                    turned(factor).unwrap_or_else(|| Factor::Polynomial(factor.clone()))
                }));
            }
            for factor in factors {
                if !seen.contains(&factor) {
                    seen.push(factor);
                }
            }
        }
        // What cancels may have had no value.
        let is_kept = |index: u32| {
            implied.contains(&index) || seen.iter().any(|own| own.variables().contains(&index))
        };
        let parts = reading.parts;
        let is_one = |index: u32, is_such: &dyn Fn(Symbol) -> bool| {
            parts.get(index as usize).and_then(|part| symbol(arena, *part)).is_some_and(is_such)
        };
        let is_coordinate = |index: u32| is_one(index, is_coordinate);
        let mut all = 0..u32::try_from(parts.len()).ok()?;
        if !all.all(|index| is_coordinate(index) || is_kept(index)) {
            return None;
        }
        let is_plain = |own: &Polynomial| {
            own.variables().into_iter().all(|own| is_coordinate(own) || is_one(own, is_fixed))
        };
        if let ([only], true) = (&seen[..], product.roots.is_empty())
            && is_plain(only)
            && let Some(squares) = only.independent_squares(is_coordinate)
        {
            let equations = squares.into_iter().map(|own| vec![Factor::Polynomial(own)]);
            return Some(Self { equations: equations.collect(), parts });
        }
        is_simpler.then_some(Self { equations: vec![found], parts })
    }

    fn pushed(&self, arena: &mut Arena, factor: Factor, of: NodeId) -> NodeId {
        match factor {
            Factor::Node(node) => node,
            Factor::Polynomial(own) => arena.push_polynomial(&own, &self.parts, of),
            Factor::Turn { function, angle, eighths } => {
                let two = arena.scalar(NodeOperation::Number(Rational::from(2)), of);
                let mut half = arena.scalar(NodeOperation::Divide(angle, two), of);
                if eighths != 0 {
                    let number = NodeOperation::Number(Rational::new(eighths, 4));
                    let number = arena.scalar(number, of);
                    let pi = arena.scalar(NodeOperation::Constant(Constant::Pi), of);
                    let more = arena.scalar(NodeOperation::Multiply(number, pi), of);
                    half = arena.scalar(NodeOperation::Add(half, more), of);
                }
                arena.scalar(NodeOperation::Function(function, half), of)
            }
        }
    }
}

/// Returns the symbol that a node, or the vector of which it is a component, is.
pub(super) fn symbol(arena: &Arena, node: NodeId) -> Option<Symbol> {
    match arena.nodes[node].operation {
        NodeOperation::Symbol(slot) => arena.symbols.get(slot).map(|(symbol, _)| *symbol),
        NodeOperation::Component(of, _) => match arena.nodes[of].operation {
            NodeOperation::Symbol(_) => symbol(arena, of),
            _ => None,
        },
        _ => None,
    }
}

/// Whether a polynomial is the product of some factors, up to a number.
pub(super) fn is_product(whole: &Polynomial, factors: &[Polynomial]) -> bool {
    let mut work = MOST_POLYNOMIAL_WORK;
    let one = Polynomial::constant(&Rational::from(1));
    let product = factors.iter().try_fold(one, |all, own| all.times(own, &mut work));
    product.is_none_or(|own| own.monic() == whole.monic())
}

/// Returns a factor with the zeros of 1 ∓ cos u or 1 ∓ sin u, of which these are squares, or of cosh u − 1.
fn half_angle(arena: &Arena, parts: &[NodeId], factor: &Polynomial) -> Option<Factor> {
    use ElementaryFunction::{Cos, Cosh, Sin};
    let mut terms = factor.terms();
    let (Some(one), Some(two), None) = (terms.next(), terms.next(), terms.next()) else {
        return None;
    };
    let (number, (slope, exponents)) = match (one.1, two.1) {
        ([], _) => (one.0, two),
        (_, []) => (two.0, one),
        _ => return None,
    };
    let [(variable, 1)] = exponents else { return None };
    let ratio = number * &slope.recip()?;
    let is_minus = match ratio.to_integer()? {
        -1 => true,
        1 => false,
        _ => return None,
    };
    let node = *parts.get(*variable as usize)?;
    let NodeOperation::Function(function, angle) = arena.nodes[node].operation else { return None };
    Some(match (function, is_minus) {
        (Cos, true) => Factor::Turn { function: Sin, angle, eighths: 0 },
        (Cos, false) => Factor::Turn { function: Cos, angle, eighths: 0 },
        (Sin, true) => Factor::Turn { function: Sin, angle, eighths: -1 },
        (Sin, false) => Factor::Turn { function: Sin, angle, eighths: 1 },
        (Cosh, true) => Factor::Node(angle),
        _ => return None,
    })
}
