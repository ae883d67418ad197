//! What differences start from: the quantities of a residual before any of them is differentiated,
//! each on a tape of its own.
//!
//! ```text
//! integral    F and v                 L_vF
//! density     ρ, v and each v_i       L_vρ/ρ + Σ ∂v_i/∂x_i
//! criterion   w                       Σ γ_i (∂_j w_k - ∂_k w_j), (i,j,k) cyclic
//! flat base   ξ                       ∂ξ₂/∂r₁ - ∂ξ₁/∂r₂
//! ```

use crate::case::{Case, Claim};
use crate::claim::{Density, Integral, Kind};
use crate::formula::Type;
use crate::graph::{Expr, Fault, Graph, Tape, record};
use crate::mechanics::{NORMAL, Phase, System};

/// The tapes that differences evaluate at neighbouring points.
pub struct Underived {
    /// How many inputs come before the state's.
    pub parameters: usize,
    /// How many inputs the state has.
    pub dimension: usize,
    /// What is differentiated along the field.
    pub along_field: Option<AlongField>,
    /// What is differentiated along axes.
    pub along_axes: Vec<AlongAxis>,
}

/// A scalar to differentiate along the field.
pub struct AlongField {
    /// v
    pub field: Tape,
    /// F or ρ
    pub value: Tape,
    /// Is the logarithm of the value differentiated?
    pub logarithmic: bool,
}

/// Scalars to differentiate by one input.
pub struct AlongAxis {
    /// The input.
    pub input: usize,
    /// The scalars.
    pub values: Tape,
    /// The factor of each derivative.
    pub terms: Vec<Term>,
}

/// How a derivative enters the residual.
pub struct Term {
    /// 1 or -1
    pub sign: f64,
    /// The input that it is multiplied by, if there is one.
    pub factor: Option<usize>,
}

/// Why a residual is not formed by differences.
pub type Reason = &'static str;

impl Underived {
    /// Records what the residual of `claim` derives.
    pub fn record(case: &Case, claim: &Claim) -> Result<Result<Self, Reason>, Fault> {
        let model = &case.model;
        let (parameters, dimension) = (model.free_components(), model.dimension());
        let inputs = parameters + dimension;
        let kept = claim.place.kept.iter().any(|kept| *kept);
        if matches!(claim.kind, Kind::Density(_)) && kept && !model.system.conserves_level() {
            return Ok(Err(
                "the level changes beside itself: its cofactor takes second derivatives",
            ));
        }
        let formula = match &claim.kind {
            Kind::Integral(Integral(formula)) | Kind::Density(Density(formula)) => Some(formula),
            Kind::AnalyticDensity(_) | Kind::PositionDensity(_) => None,
            _ => return Ok(Err("this kind of claim is not one derivative of one function")),
        };
        if formula.is_some_and(|formula| formula.value_type() != Type::Scalar) {
            return Ok(Err("only derivatives of scalars are timed by other methods"));
        }
        let (graph, quantities) = record(inputs, |inputs| {
            let (parameters, state) = inputs.split_at(parameters);
            let phase = Phase::new(model, parameters, state);
            let covector = || model.system.criterion_covector(&phase);
            match formula {
                Some(formula) => (phase.field().to_vec(), vec![phase.scalar(formula)]),
                None => (Vec::new(), covector().unwrap_or_default()),
            }
        })?;
        if graph.inputs() > inputs {
            return Ok(Err("an ∫ is known by its derivative alone"));
        }
        let (field, values) = quantities;
        let along_field = formula.is_some().then(|| AlongField {
            field: Tape::new(&graph, &field),
            value: Tape::new(&graph, &values),
            logarithmic: matches!(claim.kind, Kind::Density(_)),
        });
        let along_axes = match &claim.kind {
            Kind::Integral(_) => Vec::new(),
            Kind::Density(_) => divergence(&graph, &field, parameters),
            _ => rotation(&graph, &values, case),
        };
        Ok(Ok(Self { parameters, dimension, along_field, along_axes }))
    }

    /// Operations a state, when what is derived along the field or an axis is computed `points`
    /// times.
    pub fn operations(&self, points: usize) -> usize {
        let field = self.along_field.as_ref();
        let field = field.map_or(0, |f| f.field.operations() + points * f.value.operations());
        let axes: usize = self.along_axes.iter().map(|axis| axis.values.operations()).sum();
        field + points * axes
    }
}

/// Σ ∂v_i/∂x_i, without the v_i that do not depend on x_i.
fn divergence(graph: &Graph, field: &[Expr], parameters: usize) -> Vec<AlongAxis> {
    let axis = |(index, rate): (usize, &Expr)| {
        let input = parameters + index;
        graph.depends_on(*rate, input).then(|| AlongAxis {
            input,
            values: Tape::new(graph, &[*rate]),
            terms: vec![Term { sign: 1.0, factor: None }],
        })
    };
    field.iter().enumerate().filter_map(axis).collect()
}

/// (γ, rot w) or the rotation of ξ, axis by axis.
fn rotation(graph: &Graph, covector: &[Expr], case: &Case) -> Vec<AlongAxis> {
    let model = &case.model;
    let before: usize = match model.system {
        System::Rubber(_) => model.state[..NORMAL].iter().map(|variable| variable.len()).sum(),
        // The state is ω₁, ω₂, r₁, r₂.
        _ => model.dimension().saturating_sub(covector.len()),
    };
    let start = model.free_components() + before;
    let axis = |index: usize, parts: &[(usize, f64, Option<usize>)]| AlongAxis {
        input: start + index,
        values: Tape::new(graph, &parts.iter().map(|part| covector[part.0]).collect::<Vec<_>>()),
        terms: parts
            .iter()
            .map(|(_, sign, factor)| Term { sign: *sign, factor: factor.map(|k| start + k) })
            .collect(),
    };
    match covector.len() {
        3 => (0..3)
            .map(|a| {
                let (next, last) = ((a + 1) % 3, (a + 2) % 3);
                axis(a, &[(next, 1.0, Some(last)), (last, -1.0, Some(next))])
            })
            .collect(),
        2 => vec![axis(0, &[(1, 1.0, None)]), axis(1, &[(0, -1.0, None)])],
        _ => Vec::new(),
    }
}
