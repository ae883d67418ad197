//! Lyapunov functions: L_vF ≤ 0, or F∘Φ ≤ F for a map, at all states of the declared ranges.
//!
//! The inequality x ≤ 0 is the equation x + |x| = 0. It is proved if intervals show that x is positive
//! at no state, and refuted by a state at which x is positive.

use num_dual::DualNum;

use super::boxes::Boxes;
use super::{Condition, Excess, Objection, Reader, ResidualContext, Statement};
use crate::formula::{Formula, Layout, Type};
use crate::graph::Expr;
use crate::mechanics::Model;
use crate::mechanics::calculus::DualPoint;
use crate::scalar::Scalar;

/// The claim that F does not increase; a given rate is compared with the formula.
#[derive(Clone, Debug)]
pub struct Lyapunov {
    function: Formula,
    rate: Option<Formula>,
    /// Form of the rate that shows its sign.
    form: Option<Formula>,
}

impl Lyapunov {
    /// Returns F.
    pub(crate) fn function(&self) -> &Formula {
        &self.function
    }

    /// Whether a rate is given.
    pub(crate) fn has_rate(&self) -> bool {
        self.rate.is_some()
    }

    /// Whether another form of the rate is tried.
    pub(crate) fn has_form(&self) -> bool {
        self.form.is_some()
    }

    /// Returns the same claim with another form of the rate, whose sign is that of the rate.
    pub(crate) fn with_form(&self, form: Formula) -> Self {
        Self { form: Some(form), ..self.clone() }
    }

    /// Computes L_vF, or F∘Φ - F.
    pub(crate) fn growth<T: Scalar>(&self, jet: &DualPoint<'_, T>) -> T {
        match jet.phase.model().system.is_map() {
            true => jet.image().scalar(&self.function) - jet.phase.scalar(&self.function),
            false => jet.lie_derivative(|at| at.scalar(&self.function)),
        }
    }

    /// Computes ∂F/∂xₖ and xₖ', whose products are the terms of L_vF; none for a map.
    pub(crate) fn factors(&self, jet: &DualPoint<'_, Expr>) -> Vec<[Expr; 2]> {
        if jet.phase.model().system.is_map() {
            return Vec::new();
        }
        let slopes = jet.gradients(&self.function).concat();
        slopes.into_iter().zip(jet.phase.field()).map(|(slope, rate)| [slope, *rate]).collect()
    }

    /// Returns the rate, and Σ|∂F/∂xₖ·xₖ'|, or |F∘Φ| + |F|.
    fn excess(&self, jet: &DualPoint<'_, Expr>) -> Excess {
        let phase = &jet.phase;
        let scale = match phase.model().system.is_map() {
            true => {
                let ends = [jet.image().scalar(&self.function), phase.scalar(&self.function)];
                ends.map(Scalar::modulus).into_iter().sum()
            }
            false => self.factors(jet).iter().map(|[slope, rate]| (*slope * *rate).modulus()).sum(),
        };
        let value = self.rate.as_ref().map_or_else(|| self.growth(jet), |rate| phase.scalar(rate));
        Excess { value, scale }
    }
}

impl Statement for Lyapunov {
    const NAME: &'static str = "lyapunov";
    const COMPANIONS: &'static [&'static str] = &["equals"];
    const OF_MAPS: bool = true;
    const IS_INEQUALITY: bool = true;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let function = from.required(Self::NAME, Some(Type::Scalar))?;
        Ok(Self { function, rate: from.formula("equals", Some(Type::Scalar))?, form: None })
    }

    fn at_images_of_maps(&self) -> Vec<&Formula> {
        vec![&self.function]
    }

    fn formulas(&self) -> Vec<&Formula> {
        // States at which another form of the rate has no value count as well.
        [&self.function].into_iter().chain(&self.rate).collect()
    }

    fn presence(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Expr> {
        // A form that is guessed, as one with logarithms, shows nothing where it has no value.
        let forms = jet.phase.literal_values(&self.form);
        [self.growth(jet)].into_iter().chain(forms).collect()
    }

    fn text(&self) -> Option<String> {
        let function = self.function.text().trim();
        Some(match &self.rate {
            Some(rate) => format!("({function})' = {} ≤ 0", rate.text().trim()),
            None => format!("({function})' ≤ 0"),
        })
    }

    fn layout(&self, boxes: Boxes<'_>) -> Option<Layout> {
        if boxes.0.system.is_map() {
            return None;
        }
        let mut row = vec![boxes.rate(&self.function)];
        row.extend(self.rate.iter().flat_map(|own| [Layout::Sign("="), boxes.formula(own)]));
        row.extend([Layout::Sign("≤"), Layout::Number("0".to_string())]);
        Some(Layout::Row(row))
    }

    fn objection(&self, model: &Model) -> Option<Objection> {
        let is_open = self.rate.as_ref().is_some_and(|rate| model.has_antiderivative(rate));
        is_open.then(|| Objection::open_constant("a rate with a sign"))
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        let slopes = jet.gradients(&self.function).concat();
        let constant = Condition::nonzero(
            slopes,
            "the slope of F is 0: F is a constant, or changes at jumps only",
        );
        match jet.phase.model().system.is_map() {
            true => vec![constant],
            false => {
                // arctan F jumps where F comes back from infinity with the other sign.
                let value = jet.phase.scalar(&self.function);
                vec![constant, Condition::continuous(vec![value, value.atan()], "F")]
            }
        }
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, _: &[bool]) -> Vec<T> {
        let growth = self.growth(jet);
        let excess = |x: T| x + x.modulus();
        let forms: Vec<T> =
            self.rate.iter().chain(&self.form).map(|rate| jet.phase.scalar(rate)).collect();
        let shown = forms.last().copied().unwrap_or(growth);
        forms.into_iter().map(|rate| growth - rate).chain([excess(shown)]).collect()
    }

    fn context(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> ResidualContext {
        ResidualContext {
            value: vec![jet.phase.scalar(&self.function)],
            // Of the same rate in another form nothing else is found.
            excess: self.form.is_none().then(|| self.excess(jet)),
            ..ResidualContext::default()
        }
    }
}
