//! Symmetry fields, tangent to the level: [u,v] = (u·∇)v - (v·∇)u vanishes, or is a multiple of v.

use super::boxes::{Boxes, multiple_text};
use super::components::Components;
use super::{Condition, Reader, Statement, ValueShape};
use crate::formula::{Formula, Layout, Type};
use crate::graph::Expr;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::{dot, rejection};
use crate::scalar::Scalar;

/// The claim `[u,v] = c v`, with c = 0 unless a weight is given.
#[derive(Clone, Debug)]
pub struct SymmetryField {
    components: Components,
    weight: Option<Formula>,
}

impl Statement for SymmetryField {
    const NAME: &'static str = "symmetry-field";
    const COMPANIONS: &'static [&'static str] = &["weight"];
    const SHAPES: &'static [(&'static str, ValueShape)] = &[(Self::NAME, ValueShape::Table)];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let components = Components::read(from, Self::NAME, &from.model().vocabulary)?
            .ok_or_else(|| from.missing(Self::NAME))?;
        Ok(Self { components, weight: from.formula("weight", Some(Type::Scalar))? })
    }

    fn text(&self) -> Option<String> {
        Some(self.components.text.clone())
    }

    fn layout(&self, boxes: Boxes<'_>) -> Option<Layout> {
        let bracket = Layout::Row(vec![
            Layout::name("u", Type::VECTOR),
            Layout::Sign(","),
            Layout::name("v", Type::VECTOR),
        ]);
        let bracket = Layout::Fenced("[", Box::new(bracket), "]");
        let weight = self.weight.iter().map(|own| {
            let multiple = boxes.multiple(own, Layout::name("v", Type::VECTOR));
            Layout::equation(bracket.clone(), multiple)
        });
        Some(Layout::listed([boxes.field(&self.components)].into_iter().chain(weight)))
    }

    fn particulars(&self) -> Option<String> {
        Some(format!("[u,v] = {}", multiple_text(self.weight.as_ref()?, "v")))
    }

    fn formulas(&self) -> Vec<&Formula> {
        self.components.formulas().chain(&self.weight).collect()
    }

    /// Requires that u is no multiple of v: every f v with L_vf = 0 commutes with v.
    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        let own = self.components.at(&jet.phase);
        let across = rejection(&own, &[jet.phase.field().to_vec()]);
        let otherwise = "u is 0 or a multiple of the field, as every system has";
        vec![
            Condition::nonzero(across, otherwise),
            Condition::continuous(own, "u"),
            Condition::continuous(jet.phase.field().to_vec(), "the field"),
        ]
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        let moved = jet.along_field();
        let (field, rate): (Vec<T>, Vec<T>) =
            self.components.at(moved).iter().map(|x| (x.re, x.eps)).unzip();
        let weight = self.weight.as_ref().map_or_else(T::zero, |c| jet.phase.scalar(c));
        let beside = jet.phase.lift(&field);
        let commutator = beside.field().iter().zip(rate);
        let mut residual: Vec<T> =
            commutator.map(|(along, rate)| along.eps - rate - weight * along.re).collect();
        // u is tangent to the level.
        residual.extend(jet.level_gradients(kept).iter().map(|gradient| dot(gradient, &field)));
        residual
    }
}
