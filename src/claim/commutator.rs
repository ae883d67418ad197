//! Commutators of vector fields: [u,w] = (u·∇)w − (w·∇)u = z, component by component.

use super::boxes::Boxes;
use super::components::Components;
use super::{
    Condition, Reader, ResidualContext, Statement, ValueShape, difference, quadrature_defects,
};
use crate::formula::{Formula, Layout};
use crate::graph::Expr;
use crate::mechanics::Phase;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::dot;
use crate::scalar::Scalar;

/// The claim `[u,w] = z`.
#[derive(Clone, Debug)]
pub struct Commutator {
    of: Components,
    with: Components,
    /// Value z, 0 if `None`.
    value: Option<Components>,
}

/// Keys of u and of w.
const FIELDS: [&str; 2] = ["of", "with"];

impl Commutator {
    /// Computes Dw·u and Du·w.
    fn parts<T: Scalar>(&self, phase: &Phase<'_, T>) -> (Vec<T>, Vec<T>) {
        let rate = |field: &Components, along: &Components| -> Vec<T> {
            let moved = phase.lift(&along.at(phase));
            field.at(&moved).into_iter().map(|x| x.eps).collect()
        };
        (rate(&self.with, &self.of), rate(&self.of, &self.with))
    }

    fn claimed<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<Vec<T>> {
        self.value.as_ref().map(|value| value.at(phase))
    }
}

impl Statement for Commutator {
    const NAME: &'static str = "commutator";
    const COMPANIONS: &'static [&'static str] = &["equals"];
    const SHAPES: &'static [(&'static str, ValueShape)] =
        &[(Self::NAME, ValueShape::Table), ("equals", ValueShape::Table)];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let names = &from.model().vocabulary;
        let [of, with] = FIELDS.map(|key| -> Result<Components, R::Error> {
            Components::read_inside(from, (Self::NAME, key), &FIELDS, names)?.ok_or_else(|| {
                let message = format!("the commutator has no field `{key}`");
                let remedy = "write commutator = { of = { x = \"…\" }, with = { x = \"…\" } }";
                from.complaint(Self::NAME, message, remedy)
            })
        });
        Ok(Self { of: of?, with: with?, value: Components::read(from, "equals", names)? })
    }

    fn formulas(&self) -> Vec<&Formula> {
        [&self.of, &self.with]
            .into_iter()
            .chain(&self.value)
            .flat_map(Components::formulas)
            .collect()
    }

    fn layout(&self, boxes: Boxes<'_>) -> Option<Layout> {
        let [of, with] = [&self.of, &self.with].map(|own| boxes.field(own));
        let pair = Layout::listed([of, with]);
        let bracket = Layout::Fenced("[", Box::new(pair), "]");
        let zero = || Layout::Number("0".to_string());
        let value = self.value.as_ref().map_or_else(zero, |own| boxes.field(own));
        Some(Layout::equation(bracket, value))
    }

    fn text(&self) -> Option<String> {
        let value = self.value.as_ref().map_or("0".to_string(), |z| format!("({})", z.text));
        Some(format!("[({}), ({})] = {value}", self.of.text, self.with.text))
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
        let (first, second) = self.parts(&jet.phase);
        let found = difference(first, second);
        match self.claimed(&jet.phase) {
            Some(claimed) => difference(found, claimed),
            None => found,
        }
    }

    fn context(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> ResidualContext {
        let (first, second) = self.parts(&jet.phase);
        let claimed = self.claimed(&jet.phase).unwrap_or_default();
        let scale = dot(&first, &first) + dot(&second, &second) + dot(&claimed, &claimed);
        ResidualContext { scale: Some(scale), value: claimed, ..ResidualContext::default() }
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        let of_one =
            |field: &Components| Condition::nonzero(field.at(&jet.phase), "one of the fields is 0");
        let both = [self.of.at(&jet.phase), self.with.at(&jet.phase)].concat();
        vec![of_one(&self.of), of_one(&self.with), Condition::continuous(both, "one of the fields")]
    }

    /// Computes the defects of each ∫ off the level too, which the fields may leave.
    fn quadrature_defects_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        self.formulas().into_iter().flat_map(|f| quadrature_defects(jet, f, &[])).collect()
    }
}
