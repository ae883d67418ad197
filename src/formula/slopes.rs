//! Rules of calculus: the derivative of every node of a formula along one variable.
//!
//! A derivative is made of nodes like any other formula, and is defined where the rules have a
//! value: (√x)' = x^(−1/2)/2 is undefined at 0, and so is |x|'. Abbreviations are differentiated
//! through, by the chain rule.

use std::collections::{BTreeSet, HashMap};

use super::arena::{Function, NodeId, Operation};
use super::error::{FormulaError, Span};
use super::kind::Type;
use super::scope::{Origin, Scope, Symbol};
use super::typing::{Builder, Infix, Operand};
use super::{Formula, elementary_slopes};
use crate::number::rational::Rational;

/// Limit on the nodes of a derivative.
const MOST_NODES: usize = 200_000;

/// Limit on the abbreviations that are made of one another.
const MOST_NESTED: usize = 100;

/// A node of the derivative; `None` where the derivative is zero.
pub(super) type Slope = Result<Option<NodeId>, FormulaError>;

/// Part of a variable that is varied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Whole,
    /// Component of a vector, from 0.
    Component(usize),
    /// Entry of a matrix, from 0.
    Entry(usize, usize),
}

/// Derivatives of the nodes of a formula in the making.
pub(super) struct Slopes<'b, 't> {
    pub builder: &'b mut Builder<'t>,
    scope: &'b dyn Scope,
    variable: Symbol,
    part: Part,
    /// Text of the whole derivative.
    pub span: Span,
    found: HashMap<NodeId, Option<NodeId>>,
    /// Last nodes of the abbreviations that are written out.
    written_out: HashMap<Symbol, NodeId>,
    dependent: HashMap<Symbol, bool>,
    /// Number of nodes before the derivative.
    before: usize,
    depth: usize,
}

impl<'b, 't> Slopes<'b, 't> {
    pub fn new(
        builder: &'b mut Builder<'t>,
        scope: &'b dyn Scope,
        variable: Symbol,
        span: Span,
    ) -> Self {
        let before = builder.arena.nodes.len();
        Self {
            builder,
            scope,
            variable,
            part: Part::Whole,
            span,
            found: HashMap::new(),
            written_out: HashMap::new(),
            dependent: HashMap::from([(variable, true)]),
            before,
            depth: 0,
        }
    }

    /// Derivative of a node along a part of the variable.
    pub fn along(&mut self, part: Part, node: NodeId) -> Slope {
        self.part = part;
        self.found.clear();
        self.slope(node)
    }

    fn slope(&mut self, root: NodeId) -> Slope {
        let mut nodes = BTreeSet::from([root]);
        let mut open = vec![root];
        while let Some(node) = open.pop() {
            self.builder.arena.nodes[node].operation.on(|operand| {
                if nodes.insert(operand) {
                    open.push(operand);
                }
                operand
            });
        }
        for node in nodes {
            if !self.found.contains_key(&node) && !self.is_variable(node) {
                let slope = self.step(node)?;
                self.found.insert(node, slope);
            }
            if self.builder.arena.nodes.len() > self.before + MOST_NODES {
                let error = FormulaError::new(self.span.clone(), "this derivative is too long");
                return Err(error.with_help(format!("it has more than {MOST_NODES} operations")));
            }
        }
        self.of(root)
    }

    fn is_variable(&self, node: NodeId) -> bool {
        match self.builder.arena.nodes[node].operation {
            Operation::Symbol(slot) => self.builder.arena.symbols[slot].0 == self.variable,
            _ => false,
        }
    }

    /// Derivative of a node that was passed.
    pub fn of(&mut self, node: NodeId) -> Slope {
        if !self.is_variable(node) {
            return Ok(self.found.get(&node).copied().flatten());
        }
        let [zero, one] = [0, 1].map(|number| self.number(number));
        let entry = |is_varied: bool| if is_varied { one.clone() } else { zero.clone() };
        let span = self.span.clone();
        let unit = match (self.builder.arena.nodes[node].value_type, self.part) {
            (Type::Vector(n), Part::Component(i)) => {
                let parts: Vec<Operand> = (0..n).map(|k| entry(k == i)).collect();
                self.builder.vector(&parts, span)?
            }
            (Type::Matrix(rows, columns), Part::Entry(i, j)) => {
                let mut all = Vec::new();
                for row in 0..rows {
                    let parts: Vec<Operand> =
                        (0..columns).map(|column| entry((row, column) == (i, j))).collect();
                    all.push(self.builder.vector(&parts, span.clone())?);
                }
                self.builder.rows(&all, span)?
            }
            _ => one,
        };
        Ok(Some(unit.node))
    }

    /// Operand for a node.
    pub fn at(&self, node: NodeId) -> Operand {
        self.builder.operand(node, self.span.clone())
    }

    /// Appends a number.
    pub fn number(&mut self, value: impl Into<Rational>) -> Operand {
        let number = Operation::Number(value.into());
        self.builder.push(number, Type::Scalar, self.span.clone())
    }

    /// Appends zero of a type.
    pub fn zero(&mut self, kind: Type) -> Operand {
        match kind {
            Type::Scalar => self.number(0),
            _ => self.builder.push(Operation::Zero, kind, self.span.clone()),
        }
    }

    /// Appends an operation that needs no check.
    fn push(&mut self, operation: Operation, kind: Type) -> NodeId {
        self.builder.push(operation, kind, self.span.clone()).node
    }

    /// Appends `a operator b`.
    pub fn infix(&mut self, infix: Infix, a: NodeId, b: NodeId) -> Result<NodeId, FormulaError> {
        let (a, b) = (self.at(a), self.at(b));
        Ok(self.builder.infix(infix, &a, &b)?.node)
    }

    pub fn times(&mut self, a: NodeId, b: NodeId) -> Result<NodeId, FormulaError> {
        self.infix(Infix::Multiply, a, b)
    }

    pub fn negative(&mut self, a: NodeId) -> NodeId {
        let a = self.at(a);
        self.builder.negate(&a, self.span.clone()).node
    }

    /// Sum of two derivatives.
    fn sum(&mut self, a: Option<NodeId>, b: Option<NodeId>) -> Slope {
        match (a, b) {
            (Some(a), Some(b)) => self.infix(Infix::Add, a, b).map(Some),
            (one, other) => Ok(one.or(other)),
        }
    }

    /// Power of a scalar with a constant exponent.
    pub fn power(&mut self, a: NodeId, exponent: &Rational) -> Result<NodeId, FormulaError> {
        if exponent.to_integer() == Some(1) {
            return Ok(a);
        }
        let a = self.at(a);
        Ok(self.builder.constant_power(&a, exponent, self.span.clone(), self.span.clone())?.node)
    }

    /// The error for what has no derivative here.
    pub fn refused(&self, what: &str, help: &str) -> FormulaError {
        FormulaError::new(self.span.clone(), what).with_help(help)
    }

    fn step(&mut self, node: NodeId) -> Slope {
        use Operation::*;
        let (operation, kind) = {
            let own = &self.builder.arena.nodes[node];
            (own.operation.clone(), own.value_type)
        };
        match operation {
            Number(_) | Constant(_) | Identity | Zero => Ok(None),
            Symbol(slot) => self.symbol(self.builder.arena.symbols[slot].0),
            Partial { derivative, .. } => self.of(derivative),
            Negate(a) => Ok(self.of(a)?.map(|a| self.negative(a))),
            Add(a, b) => {
                let (a, b) = (self.of(a)?, self.of(b)?);
                self.sum(a, b)
            }
            Subtract(a, b) => match (self.of(a)?, self.of(b)?) {
                (Some(a), Some(b)) => self.infix(Infix::Subtract, a, b).map(Some),
                (a, b) => Ok(a.or_else(|| b.map(|b| self.negative(b)))),
            },
            Multiply(a, b) | Scale(a, b) | Apply(a, b) | Compose(a, b) => {
                self.bilinear(a, b, |own, a, b| own.times(a, b))
            }
            Cross(a, b) => self.bilinear(a, b, |own, a, b| own.infix(Infix::Cross, a, b)),
            Outer(a, b) => self.bilinear(a, b, |own, a, b| own.infix(Infix::Outer, a, b)),
            Dot(a, b) if a == b => {
                let Some(slope) = self.of(a)? else { return Ok(None) };
                let product = self.push(Dot(a, slope), kind);
                let two = self.number(2).node;
                self.times(two, product).map(Some)
            }
            Dot(a, b) => self.bilinear(a, b, |own, a, b| Ok(own.push(Dot(a, b), kind))),
            Divide(a, b) => self.quotient(node, a, b),
            Power(a, exponent) => {
                let Some(slope) = self.of(a)? else { return Ok(None) };
                let lower = self.power(a, &(&exponent - &Rational::from(1)))?;
                let factor = self.number(exponent).node;
                let factor = self.times(factor, lower)?;
                self.times(factor, slope).map(Some)
            }
            PowerOf(a, b) => self.power_of(node, a, b),
            MatrixPower(a, n) => self.matrix_power(a, n),
            Component(a, i) if self.is_variable(a) => Ok(self.unit(Part::Component(i))),
            Entry(a, i, j) if self.is_variable(a) => Ok(self.unit(Part::Entry(i, j))),
            Component(a, _) | Row(a, _) | Entry(a, ..) | Transpose(a) | Trace(a) | Diagonal(a) => {
                Ok(self.of(a)?.map(|slope| self.push(operation.on(|_| slope), kind)))
            }
            Inverse(a) => {
                let Some(slope) = self.of(a)? else { return Ok(None) };
                let right = self.times(slope, node)?;
                let product = self.times(node, right)?;
                Ok(Some(self.negative(product)))
            }
            Determinant(a) => {
                let Some(slope) = self.of(a)? else { return Ok(None) };
                let adjugate = self.push(Adjugate(a), self.at(a).value_type);
                let product = self.times(adjugate, slope)?;
                Ok(Some(self.push(Trace(product), Type::Scalar)))
            }
            Adjugate(a) => self.adjugate(a, kind),
            Solve(a, b) => {
                let (of_a, of_b) = (self.of(a)?, self.of(b)?);
                let pulled = match of_a {
                    Some(slope) => Some(self.times(slope, node)?),
                    None => None,
                };
                let pulled = pulled.map(|pulled| self.negative(pulled));
                let right = self.sum(of_b, pulled)?;
                Ok(right.map(|right| self.push(Solve(a, right), kind)))
            }
            Vector(parts) => self.parts(&parts, |parts| Vector(parts.into()), kind),
            Rows(rows) => self.parts(&rows, |rows| Rows(rows.into()), kind),
            Sum(terms) => {
                let slopes = terms.iter().map(|term| self.of(*term));
                let slopes: Vec<Option<NodeId>> = slopes.collect::<Result<_, _>>()?;
                let slopes: Vec<NodeId> = slopes.into_iter().flatten().collect();
                Ok(match slopes[..] {
                    [] => None,
                    [one] => Some(one),
                    _ => Some(self.push(Sum(slopes.into()), kind)),
                })
            }
            Product(factors) => self.product(&factors),
            Function(function, a) => match self.of(a)? {
                Some(slope) => elementary_slopes::slope(self, function, node, a, slope).map(Some),
                None => Ok(None),
            },
            Angle(y, x) => elementary_slopes::angle(self, y, x),
            Extreme(_, all) => {
                let name = "`min` and `max` have no derivative here";
                self.constant(&all, name, "write the derivative of the branch that you mean")
            }
            Antiderivative(f, x) => {
                let help = "write the integrand, or the function itself in place of `∫(f, x)`";
                self.constant(&[f, x], "an `∫` has no derivative here", help)
            }
        }
    }

    fn unit(&mut self, part: Part) -> Option<NodeId> {
        (part == self.part).then(|| self.number(1).node)
    }

    /// Zero if no operand depends on the variable, else the error.
    fn constant(&mut self, operands: &[NodeId], what: &str, help: &str) -> Slope {
        for operand in operands {
            if self.of(*operand)?.is_some() {
                return Err(self.refused(what, help));
            }
        }
        Ok(None)
    }

    fn bilinear(
        &mut self,
        a: NodeId,
        b: NodeId,
        product: impl Fn(&mut Self, NodeId, NodeId) -> Result<NodeId, FormulaError>,
    ) -> Slope {
        let left = match self.of(a)? {
            Some(slope) => Some(product(self, slope, b)?),
            None => None,
        };
        let right = match self.of(b)? {
            Some(slope) => Some(product(self, a, slope)?),
            None => None,
        };
        self.sum(left, right)
    }

    /// (a/b)' = (a' − (a/b) b')/b.
    fn quotient(&mut self, node: NodeId, a: NodeId, b: NodeId) -> Slope {
        let above = match self.of(b)? {
            Some(slope) => {
                let pulled = self.times(node, slope)?;
                let pulled = self.negative(pulled);
                let slope = self.of(a)?;
                self.sum(slope, Some(pulled))?
            }
            None => self.of(a)?,
        };
        above.map(|above| self.infix(Infix::Divide, above, b)).transpose()
    }

    /// (aᵇ)' = b a^(b−1) a' + aᵇ ln(a) b'.
    fn power_of(&mut self, node: NodeId, a: NodeId, b: NodeId) -> Slope {
        let of_base = match self.of(a)? {
            Some(slope) => {
                let one = self.number(1).node;
                let lower = self.infix(Infix::Subtract, b, one)?;
                let power = self.push(Operation::PowerOf(a, lower), Type::Scalar);
                let factor = self.times(b, power)?;
                Some(self.times(factor, slope)?)
            }
            None => None,
        };
        let of_exponent = match self.of(b)? {
            Some(slope) => {
                let logarithm = self.push(Operation::Function(Function::Ln, a), Type::Scalar);
                let factor = self.times(node, logarithm)?;
                Some(self.times(factor, slope)?)
            }
            None => None,
        };
        self.sum(of_base, of_exponent)
    }

    /// (Aⁿ)' = Σ Aᵏ A' Aⁿ⁻¹⁻ᵏ.
    fn matrix_power(&mut self, a: NodeId, n: u32) -> Slope {
        let Some(slope) = self.of(a)? else { return Ok(None) };
        let kind = self.at(a).value_type;
        let mut total = None;
        for before in 0..n {
            let mut term = slope;
            for (power, is_left) in [(before, true), (n - 1 - before, false)] {
                if power > 0 {
                    let factor = self.push(Operation::MatrixPower(a, power), kind);
                    let (left, right) = if is_left { (factor, term) } else { (term, factor) };
                    term = self.times(left, right)?;
                }
            }
            total = self.sum(total, Some(term))?;
        }
        Ok(total)
    }

    /// The derivative of adj A = A² − (tr A) A + ½((tr A)² − tr A²) E in three dimensions, and of
    /// (tr A) E − A in two.
    fn adjugate(&mut self, a: NodeId, kind: Type) -> Slope {
        let Some(slope) = self.of(a)? else { return Ok(None) };
        let Type::Matrix(rows @ 1..=3, _) = kind else {
            let what = "the adjugate of more than three rows has no derivative here";
            return Err(self.refused(what, "write `det(A)*A⁻¹`"));
        };
        if rows == 1 {
            return Ok(None);
        }
        let unit = self.push(Operation::Identity, kind);
        let trace = |own: &mut Self, node| own.push(Operation::Trace(node), Type::Scalar);
        let trace_of_slope = trace(self, slope);
        if rows == 2 {
            let unit = self.times(trace_of_slope, unit)?;
            return self.infix(Infix::Subtract, unit, slope).map(Some);
        }
        let trace_of_a = trace(self, a);
        let [left, right] = [(a, slope), (slope, a)].map(|(a, b)| self.times(a, b));
        let squares = self.infix(Infix::Add, left?, right?)?;
        let first = self.times(trace_of_slope, a)?;
        let second = self.times(trace_of_a, slope)?;
        let product = self.times(a, slope)?;
        let of_product = trace(self, product);
        let both = self.times(trace_of_a, trace_of_slope)?;
        let factor = self.infix(Infix::Subtract, both, of_product)?;
        let last = self.times(factor, unit)?;
        let mut total = self.infix(Infix::Subtract, squares, first)?;
        total = self.infix(Infix::Subtract, total, second)?;
        self.infix(Infix::Add, total, last).map(Some)
    }

    fn parts(
        &mut self,
        parts: &[NodeId],
        build: impl Fn(Vec<NodeId>) -> Operation,
        kind: Type,
    ) -> Slope {
        let slopes = parts.iter().map(|part| self.of(*part));
        let slopes: Vec<Option<NodeId>> = slopes.collect::<Result<_, _>>()?;
        if slopes.iter().all(Option::is_none) {
            return Ok(None);
        }
        let mut all = Vec::new();
        for (part, slope) in parts.iter().zip(slopes) {
            let kind = self.at(*part).value_type;
            all.push(slope.unwrap_or_else(|| self.zero(kind).node));
        }
        Ok(Some(self.push(build(all), kind)))
    }

    /// Σ fᵢ' Π fₖ over the other factors.
    fn product(&mut self, factors: &[NodeId]) -> Slope {
        let mut total = None;
        for (i, factor) in factors.iter().enumerate() {
            let Some(slope) = self.of(*factor)? else { continue };
            let others = factors.iter().enumerate().filter(|(k, _)| *k != i);
            let mut all: Vec<NodeId> = others.map(|(_, other)| *other).collect();
            all.push(slope);
            let term = self.push(Operation::Product(all.into()), Type::Scalar);
            total = self.sum(total, Some(term))?;
        }
        Ok(total)
    }

    fn symbol(&mut self, symbol: Symbol) -> Slope {
        let scope = self.scope;
        match scope.origin(symbol) {
            Origin::Variable | Origin::Constant => Ok(None),
            Origin::Computed => Err(self.opaque(symbol)),
            Origin::Defined(formula) => {
                if !self.depends(formula, 0)? {
                    return Ok(None);
                }
                let root = match self.written_out.get(&symbol) {
                    Some(root) => *root,
                    None => self.write_out(symbol, formula),
                };
                if self.depth == MOST_NESTED {
                    return Err(self.too_deep());
                }
                self.depth += 1;
                let slope = self.slope(root);
                self.depth -= 1;
                slope
            }
        }
    }

    fn too_deep(&self) -> FormulaError {
        let help = format!("at most {MOST_NESTED} abbreviations may be made of one another");
        self.refused("this derivative is nested too deeply", &help)
    }

    fn opaque(&self, symbol: Symbol) -> FormulaError {
        let symbols = &self.builder.arena.symbols;
        let slot = symbols.iter().position(|(own, _)| *own == symbol);
        let name = slot.map_or("this", |slot| self.builder.arena.names[slot].as_str());
        let what = format!("`{name}` is computed by the system, and has no derivative here");
        self.refused(&what, "write it as a formula of the state variables")
    }

    /// Whether a formula depends on the variable, also through abbreviations.
    fn depends(&mut self, formula: &Formula, depth: usize) -> Result<bool, FormulaError> {
        if depth == MOST_NESTED {
            return Err(self.too_deep());
        }
        let scope = self.scope;
        let mut any = false;
        for symbol in formula.symbols() {
            let known = self.dependent.get(&symbol).copied();
            let depends = match (known, scope.origin(symbol)) {
                (Some(known), _) => known,
                (None, Origin::Defined(inner)) => self.depends(inner, depth + 1)?,
                // refused when it is met
                (None, Origin::Computed) => true,
                (None, Origin::Variable | Origin::Constant) => false,
            };
            self.dependent.insert(symbol, depends);
            any |= depends;
        }
        Ok(any)
    }

    /// Appends the nodes of an abbreviation.
    fn write_out(&mut self, symbol: Symbol, formula: &Formula) -> NodeId {
        let arena = &mut self.builder.arena;
        let mut map: Vec<NodeId> = Vec::new();
        for own in &formula.arena.nodes {
            let span = self.span.clone();
            map.push(match &own.operation {
                Operation::Symbol(slot) => {
                    let (symbol, kind) = formula.arena.symbols[*slot];
                    arena.push_symbol(symbol, kind, span, || formula.arena.names[*slot].clone())
                }
                other => arena.push(other.on(|node| map[node]), own.value_type, span),
            });
        }
        for symbol in &formula.arena.fixed {
            if !arena.fixed.contains(symbol) {
                arena.fixed.push(*symbol);
            }
        }
        let root = arena.nodes.len() - 1;
        self.written_out.insert(symbol, root);
        root
    }
}
