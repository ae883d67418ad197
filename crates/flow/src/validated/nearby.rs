//! Fields near the parameters of a case: whether they are analytic about a motion that is proved.
//!
//! At the case's own numbers an operation may have a value that it has for no others near them: x^b is
//! 1 at b = 0, and has no value for x < 0 at b ≠ 0. So the field is recorded with all numbers of the
//! parameters as components of the state, and steps are proved along the motion once more.

use super::enclosure::Enclosure;
use super::laws::Laws;
use super::motion::{Boxed, steps};
use super::plan::Plan;
use super::replay::ProofData;
use crate::error::FlowError;
use crate::taylor::compile::proved::passed;
use crate::taylor::program::TaylorProgram;
use liouville::formula::Value;
use liouville::graph::{Expr, record};
use liouville::mechanics::ParameterOrigin;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Field of a case near its parameters.
pub struct Nearby {
    /// Plan whose components are the state, the loose parameters, the differences of the fixed ones
    /// from their values, and what was left out of the field. `None` where all parameters are loose,
    /// so that the steps of the proof itself hold near them.
    plan: Option<Plan>,
    dimension: usize,
    loose: usize,
}

impl Nearby {
    /// Records the field as written, with all parameters that may vary. `None` where it has no
    /// series.
    pub fn new(laws: &Laws<'_>) -> Option<Self> {
        let (dimension, loose) = (laws.model.dimension(), laws.loose.len());
        Some(Self { plan: plan(laws).ok()?, dimension, loose })
    }

    /// Whether the field is analytic about the motions from boxes over steps, for all values of the
    /// loose parameters and for others near those of the case.
    pub fn is_analytic(&self, order: usize, starts: &[Boxed], h: &[Enclosure]) -> bool {
        let Some(plan) = &self.plan else { return true };
        let ranges = std::iter::repeat_n(Enclosure::about(0.0, 1.0), self.loose);
        let whole =
            |state: &Boxed| self.whole(state.iter().copied(), ranges.clone(), Enclosure::ZERO);
        let starts: Vec<Boxed> = starts.iter().map(whole).collect();
        steps(plan, order, &starts, h).iter().all(Option::is_some)
    }

    /// The same about a closed orbit, from the numbers of its proof.
    pub fn is_analytic_along(&self, data: &ProofData) -> bool {
        let Some((period, radii)) = data.radii.split_last() else { return false };
        let boxed = |(node, radii): (&Vec<f64>, &[f64])| {
            node.iter().zip(radii).map(|(x, rad)| Enclosure::about(*x, *rad)).collect()
        };
        let starts: Vec<Boxed> =
            data.nodes.iter().zip(radii.chunks(self.dimension)).map(boxed).collect();
        let period = Enclosure::about(data.period, *period);
        let h: Vec<Enclosure> =
            data.shares.iter().map(|share| Enclosure::exact(*share) * period).collect();
        self.is_analytic(data.order, &starts, &h)
    }

    /// The plan, unless the steps of the proof itself are enough.
    pub fn plan(&self) -> Option<&Plan> {
        self.plan.as_ref()
    }

    /// State with the loose parameters and zeros, as the plan begins.
    pub fn whole<X: Clone>(
        &self,
        state: impl Iterator<Item = X>,
        ranges: impl Iterator<Item = X>,
        zero: X,
    ) -> Vec<X> {
        let count = self.plan.as_ref().map_or(0, |plan| plan.dimension);
        let others = count.saturating_sub(self.dimension + self.loose);
        state.chain(ranges).chain(std::iter::repeat_n(zero, others)).collect()
    }
}

/// Compiles the field with the fixed parameters as components; `None` where there are none. A number
/// that is a size, or stands in an index, has no others near it.
fn plan(laws: &Laws<'_>) -> Result<Option<Plan>, FlowError> {
    let model = laws.model;
    let fixed = model.parameters.iter().enumerate().filter_map(|(index, parameter)| {
        let ParameterOrigin::Fixed(values) = &parameter.origin else { return None };
        (!model.is_rigid(index, &[])).then_some((index, parameter.kind, values))
    });
    let fixed: Vec<_> = fixed.collect();
    let count: usize = fixed.iter().map(|(_, _, values)| values.len()).sum();
    if count == 0 {
        return Ok(None);
    }
    let (dimension, loose) = (model.dimension(), laws.loose.len());
    let still = loose + count;
    let (graph, (mut rates, written)) = record(dimension + still, |inputs| {
        let (state, free) = inputs.split_at(dimension);
        let (free, mut rest) = free.split_at(loose);
        let changed = fixed.iter().map(|(index, kind, values)| {
            let (own, others) = rest.split_at(values.len());
            rest = others;
            let moved = values.iter().zip(own).map(|(value, x)| Expr::rational(value) + *x);
            (*index, Value::from_components(*kind, &moved.collect::<Vec<Expr>>()))
        });
        let changed: Vec<(usize, Value<Expr>)> = changed.collect();
        let phase = laws.point(state, free).with(&changed, state);
        let mut rates = phase.field().to_vec();
        rates.extend((0..still).map(|_| Expr::rational(&Rational::from(0))));
        (rates, laws.as_written(&phase))
    })?;
    if graph.inputs() > dimension + still {
        return Err(FlowError::Antiderivative);
    }
    let left_out = graph.left_out(&rates, &written);
    rates.extend(left_out);
    let passed = passed(&graph, &rates, &written);
    rates.extend(passed);
    Plan::new(&TaylorProgram::exact(&graph, &rates)?).map(Some)
}
