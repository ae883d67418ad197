//! Identities between two formulas, or between a rate and a formula.

use std::borrow::Cow;

use num_dual::DualNum;

use super::boxes::Boxes;
use super::statement::{OfMotions, open_constant};
use super::{Condition, Need, Reader, ResidualContext, Statement, difference};
use crate::formula::{Formula, Layout, Type};
use crate::graph::{Expr, squares_of_terms};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::dot;
use crate::mechanics::{Dependence, Model};
use crate::scalar::Scalar;

/// The claim A = B.
#[derive(Clone, Debug)]
pub struct Identity {
    left: Formula,
    right: Formula,
}

/// The claim L_vF = G.
#[derive(Clone, Debug)]
pub struct Rate {
    function: Formula,
    rate: Formula,
}

/// L_vF = κF, or F∘Φ = κF, so that F = 0 is invariant; of a vector F with a square matrix κ.
#[derive(Clone, Debug)]
pub struct Relation {
    /// F.
    pub function: Formula,
    /// κ.
    pub cofactor: Formula,
}

impl Statement for Identity {
    const NAME: &'static str = "identity";
    const OF_MAPS: bool = true;
    const OF_MOTIONS: OfMotions = OfMotions::Nothing;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let (left, right) = from.equation(Self::NAME)?;
        match (left.value_type(), right.value_type()) {
            (a, b) if a == b => Ok(Self { left, right }),
            (a, b) => Err(from.unlike(Self::NAME, a, b)),
        }
    }

    fn formulas(&self) -> Vec<&Formula> {
        vec![&self.right, &self.left]
    }

    fn text(&self) -> Option<String> {
        Some(format!("{} = {}", self.left.text().trim(), self.right.text().trim()))
    }

    fn layout(&self, boxes: Boxes<'_>) -> Option<Layout> {
        Some(Layout::equation(boxes.formula(&self.left), boxes.formula(&self.right)))
    }

    fn about(&self, right: Formula) -> Option<Self> {
        Some(Self { right, ..self.clone() })
    }

    fn limit_of_refutation(&self, model: &Model) -> Option<&'static str> {
        open_constant(model, &self.formulas())
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
        let value = |formula| jet.phase.evaluate(formula).components();
        difference(value(&self.left), value(&self.right))
    }

    fn context(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> ResidualContext {
        let value = |formula| jet.phase.evaluate(formula).components();
        size_of_sides(value(&self.left), value(&self.right))
    }
}

impl Statement for Rate {
    const NAME: &'static str = "rate";
    const COMPANIONS: &'static [&'static str] = &["equals"];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let function = from.required(Self::NAME, None)?;
        let rate = from.required("equals", Some(function.value_type()))?;
        Ok(Self { function, rate })
    }

    fn formulas(&self) -> Vec<&Formula> {
        vec![&self.rate, &self.function]
    }

    fn text(&self) -> Option<String> {
        Some(format!("({})' = {}", self.function.text().trim(), self.rate.text().trim()))
    }

    fn layout(&self, boxes: Boxes<'_>) -> Option<Layout> {
        Some(Layout::equation(boxes.rate(&self.function), boxes.formula(&self.rate)))
    }

    fn about(&self, rate: Formula) -> Option<Self> {
        Some(Self { rate, ..self.clone() })
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
        difference(jet.rates(&self.function), jet.phase.evaluate(&self.rate).components())
    }

    fn context(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> ResidualContext {
        let steepness: Expr = jet.gradients(&self.function).iter().map(|g| dot(g, g)).sum();
        let (field, rate) = (jet.phase.field(), jet.phase.evaluate(&self.rate).components());
        ResidualContext {
            scale: Some(steepness * dot(field, field) + dot(&rate, &rate)),
            value: rate,
            ..ResidualContext::default()
        }
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        match jet.phase.model().system.is_map() {
            true => Vec::new(),
            false => {
                vec![Condition::continuous(jet.phase.evaluate(&self.function).components(), "F")]
            }
        }
    }
}

impl Statement for Relation {
    const NAME: &'static str = "invariant-relation";
    const COMPANIONS: &'static [&'static str] = &["cofactor"];
    const OF_MAPS: bool = true;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let function = from.required(Self::NAME, None)?;
        let (wanted, remedy) = match function.value_type() {
            Type::Scalar => (Type::Scalar, "write a scalar"),
            Type::Vector(count) => {
                (Type::Matrix(count, count), "write a square matrix κ with F' = κ*F")
            }
            other @ Type::Matrix(..) => {
                let message = format!("a {} is no scalar or vector", other.in_full());
                return Err(from.complaint(Self::NAME, message, "write its entries as a vector"));
            }
        };
        let cofactor = from.required("cofactor", None)?;
        match cofactor.value_type() {
            own if own == wanted => Ok(Self { function, cofactor }),
            own => {
                let (own, of) = (own.in_full(), function.value_type().in_full());
                let wanted = wanted.in_full();
                let message = format!("the cofactor of a {of} has to be a {wanted}, not a {own}");
                Err(from.complaint("cofactor", message, remedy))
            }
        }
    }

    fn at_images_of_maps(&self) -> Vec<&Formula> {
        vec![&self.function]
    }

    fn formulas(&self) -> Vec<&Formula> {
        vec![&self.cofactor, &self.function]
    }

    fn text(&self) -> Option<String> {
        Some(format!("{} = 0", self.function.text().trim()))
    }

    fn particulars(&self) -> Option<String> {
        Some(format!("cofactor {}", self.cofactor.text().trim()))
    }

    fn layout(&self, boxes: Boxes<'_>) -> Option<Layout> {
        let zero = Layout::Number("0".to_string());
        let relation = Layout::equation(boxes.formula(&self.function), zero);
        let cofactor = Layout::name("κ", self.cofactor.value_type());
        let cofactor = Layout::equation(cofactor, boxes.formula(&self.cofactor));
        Some(Layout::listed([relation, cofactor]))
    }

    fn about(&self, cofactor: Formula) -> Option<Self> {
        Some(Self { cofactor, ..self.clone() })
    }

    /// Requires that κ has no pole on all of F = 0: x' = 1 = (1/x) x does not preserve x = 0.
    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        let components = jet.phase.evaluate(&self.function).components();
        // A vector is 0 where the sum of its squares is.
        let (function, inverse) = match components[..] {
            [function] if self.function.value_type() == Type::Scalar => {
                (function, Some(jet.phase.scalar(&self.cofactor).recip()))
            }
            _ => (components.iter().map(|own| *own * *own).sum(), None),
        };
        let factor = jet.phase.evaluate_literally(&self.cofactor).components();
        let integrands = jet.phase.presupposed(&self.cofactor).into_iter();
        let integrands =
            integrands.map(|factor| (factor, inverse.is_some().then(|| factor.recip())));
        let condition = |(factor, inverse)| {
            Condition {
            need: Need::ValueOnZeros { function, components: components.clone(), factor, inverse },
            otherwise:
                "it is not known that the cofactor has a value where F = 0: cancel its denominator, \
                 and write roots of what is not negative there"
                    .to_string(),
            is_essential: true,
        }
        };
        let zeros = Condition {
            need: Need::Zeros { function },
            otherwise: "F = 0 contains no state of the declared ranges".to_string(),
            is_essential: false,
        };
        let identical = "F is 0 identically: this says nothing";
        let vacuous = [Condition::nonzero(components.clone(), identical), zeros];
        let factors = factor.into_iter().map(|factor| (factor, inverse)).chain(integrands);
        let mut all: Vec<Condition> = factors.map(condition).chain(vacuous).collect();
        if !jet.phase.model().system.is_map() {
            all.push(Condition::continuous(components, "F"));
        }
        all
    }

    fn remark(&self, model: &Model, _: &[bool]) -> Option<String> {
        let moves = |symbol| model.vocabulary.entry(symbol).reach > Dependence::Parameters;
        let all = model.vocabulary.with_abbreviations(&self.cofactor, &model.abbreviations);
        let below = all.into_iter().flat_map(Formula::denominators);
        let mut texts: Vec<Cow<'_, str>> = below
            .filter(|part| part.symbols.iter().any(|symbol| moves(*symbol)))
            .map(|part| part.text)
            .collect();
        texts.dedup();
        (!texts.is_empty()).then(|| {
            let texts = texts.join("`, `");
            format!("the cofactor divides by `{texts}`: F = 0 is invariant where that is not 0")
        })
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
        let function = jet.phase.evaluate(&self.function).components();
        let cofactor = jet.phase.evaluate(&self.cofactor).components();
        let values = cofactor.chunks(function.len().max(1)).map(|row| dot(row, &function));
        let moved = match jet.phase.model().system.is_map() {
            true => jet.image().evaluate(&self.function).components(),
            false => jet.rates(&self.function),
        };
        difference(moved, values.collect())
    }
}

/// Returns the square of the scale, the sum of |A|², |B|² and the squares of the terms that are added on
/// both sides, and A as the value. Where B is 0, and where both sides cancel, |A|² + |B|² is rounding alone.
fn size_of_sides(left: Vec<Expr>, right: Vec<Expr>) -> ResidualContext {
    let terms = [&left, &right].map(|side| squares_of_terms(side)).concat();
    let terms: Expr = terms.into_iter().sum();
    ResidualContext {
        scale: Some(dot(&left, &left) + dot(&right, &right) + terms),
        value: left,
        ..ResidualContext::default()
    }
}
