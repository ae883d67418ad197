//! Language of formulas, nearly that of the papers.
//!
//! A text such as `|Ĩ*ω × γ|² − 2*m*R*(γ,c)*(Ĩ*ω,ω)` is read in a [`Scope`] that knows its names.
//! The result is a [`Formula`], typed and ready to be evaluated over any [`Scalar`], or a
//! [`FormulaError`] with the place of the error and a correction.
//!
//! Operators, loosest first:
//!
//! | written | meaning |
//! |---|---|
//! | `a + b`, `a − b` | sum, difference |
//! | `a × b`, `a ⊗ b` | cross and outer product; a row of them needs brackets |
//! | `a*b`, `a/b` | product of scalars, matrices and vectors; quotient by a scalar |
//! | `−a`, `√a` | negative, square root |
//! | `a^b`, `a²`, `A⁻¹`, `Aᵀ`, `γ[3]`, `B[1,2]` | power, inverse, transpose, component |
//!
//! `(a,b)` is the dot product, `|a|` the norm or absolute value, `[a,b,c]` a vector and
//! `[[..],[..],[..]]` a matrix by rows. `∂F/∂x` is a partial derivative. `γ3` is a component of `γ`, `I12` an entry and `I1` a
//! diagonal entry of `I`, unless they are names themselves. `E` is the identity matrix.
//!
//! ```
//! use liouville::formula::{Formula, Scope, Symbol, Type, Value};
//!
//! struct Letters;
//!
//! impl Scope for Letters {
//!     fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
//!         (name == "m").then_some((Symbol(0), Type::Scalar))
//!     }
//!     fn names(&self) -> Vec<String> {
//!         vec!["m".to_string()]
//!     }
//! }
//!
//! let formula = Formula::parse("√m/2", &Letters).unwrap();
//! assert_eq!(formula.evaluate(&mut |_| Value::Scalar(9.0)), Value::Scalar(1.5));
//!
//! let error = Formula::parse("2m", &Letters).unwrap_err();
//! assert_eq!((error.span(), error.help()), (1..2, Some("write `2*m`")));
//! ```

mod algebra;
mod arena;
mod assemble;
mod bases;
mod binders;
mod bond;
mod compose;
mod construct;
mod definite_sums;
mod diagnosis;
mod elementary;
mod entries_of;
mod error;
mod evaluate;
mod expanded;
mod factors;
mod functions;
mod homogeneity;
mod kind;
mod layout;
mod lexer;
mod logarithm;
mod mutation;
mod names;
mod negative;
mod operands;
mod parser;
mod partial;
mod poles;
mod powers;
mod reduced;
mod scope;
mod simple_factors;
mod slopes;
mod spelling;
mod substitute;
mod symbols;
mod tables;
mod typing;
mod unary;
mod unknown;
mod value;
mod weights;
mod whole;
mod written_out;

#[cfg(test)]
mod tests;

use num_dual::Dual;

use crate::number::rational::Rational;
use crate::scalar::Scalar;

pub(crate) use algebra::adjugate;
pub(crate) use bases::Exponents;
pub use compose::{FormulaResult, exponent_text};
pub use error::FormulaError;
pub(crate) use error::excerpt;
pub use functions::names as function_names;
pub use kind::{MAX_COMPONENTS, Type};
pub use layout::Layout;
pub use mutation::Mutant;
pub use names::{ascii_name, canonical_name};
pub(crate) use names::{look_alike, names_in, skeleton};
pub use scope::{Scope, Symbol, SymbolOrigin};
pub use spelling::nearest;
pub use value::{MatrixEntries, Value};
pub use weights::{Weight, WeightSystem};

use arena::{Arena, Node, NodeOperation};

/// A formula with its names resolved and its types checked.
#[derive(Clone, Debug)]
pub struct Formula {
    text: String,
    /// Nodes, arguments before their users; the whole formula is the last node.
    arena: Arena,
}

impl Formula {
    /// Reads a formula whose names the scope knows.
    pub fn parse(text: &str, scope: &dyn Scope) -> Result<Formula, FormulaError> {
        let arena = parser::parse(text, scope)?;
        Ok(Formula { text: text.to_string(), arena })
    }

    /// Reads a text as a whole number, in names whose values the scope knows.
    pub(crate) fn whole_number(text: &str, scope: &dyn Scope) -> Result<i64, FormulaError> {
        parser::whole_number(text, scope)
    }

    /// Text as written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Type of the value: scalar, vector or matrix.
    pub fn value_type(&self) -> Type {
        self.root().value_type
    }

    /// Symbols used, each once, in the order of first use.
    pub fn symbols(&self) -> impl Iterator<Item = Symbol> {
        self.arena.symbols.iter().map(|(symbol, _)| *symbol)
    }

    /// Symbols whose values are written into the formula: the whole numbers in its indices, bounds,
    /// sizes and powers of matrices.
    pub fn fixed_symbols(&self) -> &[Symbol] {
        &self.arena.fixed
    }

    /// Constant value of the formula, such as `3/7` or `-0.5`; `None` if it contains anything else.
    pub fn constant(&self) -> Option<Rational> {
        self.arena.constant(self.arena.nodes.len() - 1).cloned()
    }

    /// Evaluates the formula, looking up each symbol once.
    ///
    /// # Panics
    /// If `lookup` returns a value of another type than the scope declared for the symbol.
    #[inline(never)]
    pub fn evaluate<T: Scalar>(&self, lookup: &mut dyn FnMut(Symbol) -> Value<T>) -> Value<T> {
        let mut values = evaluate::values(&self.arena, lookup);
        // a formula that was read has at least one node
        values.pop().unwrap_or_else(|| Value::Scalar(T::undefined()))
    }

    /// Evaluates the formula such that a value is defined exactly where all operations as written
    /// are: otherwise a recorded scalar folds √x·√x to x.
    #[inline(never)]
    pub fn evaluate_literally<T: Scalar>(
        &self,
        lookup: &mut dyn FnMut(Symbol) -> Value<T>,
    ) -> Value<T> {
        let mut values = evaluate::literal_values(&self.arena, lookup);
        values.pop().unwrap_or_else(|| Value::Scalar(T::undefined()))
    }

    /// Derivative of `ln|f|` along the direction in the dual parts of the symbols' values.
    ///
    /// Taken factor by factor, so that roots, powers and exponentials of factors drop out.
    /// Undefined if the formula is not a scalar.
    ///
    /// # Panics
    /// As [`evaluate`](Formula::evaluate).
    pub fn logarithmic_derivative<T: Scalar>(
        &self,
        lookup: &mut dyn FnMut(Symbol) -> Value<Dual<T>>,
    ) -> T {
        logarithm::logarithmic_derivative(&self.arena, lookup)
    }

    /// Partial derivatives of `ln|f|` that are not 0, each with the place of its variable, from
    /// those that `gradients` finds for the factors; `None` where it finds none, or where the formula
    /// is not a scalar.
    ///
    /// # Panics
    /// As [`evaluate`](Formula::evaluate).
    pub(crate) fn logarithmic_gradient<T: Scalar>(
        &self,
        lookup: &mut dyn FnMut(Symbol) -> Value<T>,
        gradients: logarithm::Gradients<'_, T>,
    ) -> Option<Vec<(usize, T)>> {
        logarithm::logarithmic_gradient(&self.arena, lookup, gradients)
    }

    /// Returns A and `false` if the whole formula is √A or, as A = (v,v), the norm of a vector; x
    /// and `true` if it is |x|.
    pub fn radicand(&self) -> Option<(Formula, bool)> {
        let (argument, is_modulus) = match self.root().operation {
            NodeOperation::Function(arena::ElementaryFunction::Sqrt, a) => (a, false),
            NodeOperation::Function(arena::ElementaryFunction::Modulus, a) => (a, true),
            _ => return None,
        };
        let arena = self.arena.ending_at(argument);
        Some((Formula { text: self.text.clone(), arena }, is_modulus))
    }

    /// Lists the texts of the vectors and matrices that the formula is made of, the largest first.
    pub(crate) fn parts(&self) -> Vec<&str> {
        let nodes = self.arena.nodes.iter().rev();
        let parts = nodes.filter(|node| node.value_type != Type::Scalar);
        parts.filter_map(|node| self.text.get(node.span.clone())).collect()
    }

    /// Whether the formula contains an `∫`.
    pub fn has_antiderivative(&self) -> bool {
        let integral = |node: &Node| matches!(node.operation, NodeOperation::Antiderivative(..));
        self.arena.nodes.iter().any(integral)
    }

    /// Returns the texts of all `∫`.
    pub(crate) fn antiderivative_texts(&self) -> impl Iterator<Item = &str> {
        let nodes = self.arena.nodes.iter();
        let own = nodes.filter(|node| matches!(node.operation, NodeOperation::Antiderivative(..)));
        own.map(|node| self.text.get(node.span.clone()).unwrap_or(&self.text))
    }

    /// Evaluates integrand and variable of every `∫`, in the order of the text.
    ///
    /// # Panics
    /// As [`evaluate`](Formula::evaluate).
    pub fn antiderivatives<T: Scalar>(
        &self,
        lookup: &mut dyn FnMut(Symbol) -> Value<T>,
    ) -> Vec<(T, T)> {
        let values = evaluate::values(&self.arena, lookup);
        let pair = |node: &Node| match node.operation {
            NodeOperation::Antiderivative(f, x) => Some((values[f].scalar()?, values[x].scalar()?)),
            _ => None,
        };
        self.arena.nodes.iter().filter_map(pair).collect()
    }

    /// Checks that terms of sums, exponents and the like have fitting weights, and infers from them
    /// the weights of symbols that were not set.
    ///
    /// Returns the weight of the formula itself if it is known by then; `None` also for 0, which
    /// fits any weight.
    pub fn check_weights(
        &self,
        weights: &mut WeightSystem,
    ) -> Result<Option<Weight>, FormulaError> {
        homogeneity::check(&self.arena, &self.text, weights)
    }

    fn root(&self) -> &Node {
        // a formula that was read has at least one node
        &self.arena.nodes[self.arena.nodes.len() - 1]
    }
}

/// Whether this is the name of a function, or of a form such as `sum`.
pub(crate) fn is_function(name: &str) -> bool {
    functions::is_function(name) || binders::is_form(name)
}
