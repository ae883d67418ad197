//! Underived quantities: the quantities of a residual before differentiation, each on a separate
//! tape, as finite differences need them.
//!
//! ```text
//! integral    F and v                 L_vF
//! density     ρ, v and each v_i       L_vρ/ρ + Σ ∂v_i/∂x_i
//! criterion   w                       Σ γ_i (∂_j w_k - ∂_k w_j), (i,j,k) cyclic
//! flat base   ξ                       ∂ξ₂/∂r₁ - ∂ξ₁/∂r₂
//! ```

use liouville::case::{Case, PlacedClaim};
use liouville::claim::{ClaimKind, Density, Integral};
use liouville::formula::Type;
use liouville::graph::{Expr, Fault, Graph, Tape, record};
use liouville::mechanics::{NORMAL, Phase, System};

/// Tapes that differences evaluate at neighbouring points.
pub struct Underived {
    /// Number of inputs before those of the state.
    pub parameters: usize,
    /// Number of inputs of the state.
    pub dimension: usize,
    /// Scalar to differentiate along the field.
    pub along_field: Option<AlongField>,
    /// Scalars to differentiate along axes.
    pub along_axes: Vec<AlongAxis>,
}

/// A scalar to differentiate along the field.
pub struct AlongField {
    /// Tape of the field v.
    pub field: Tape,
    /// Tape of F or ρ.
    pub value: Tape,
    /// Whether the logarithm of the value is differentiated.
    pub logarithmic: bool,
}

/// Scalars to differentiate with respect to one input.
pub struct AlongAxis {
    /// Index of the input.
    pub input: usize,
    /// Tape of the scalars.
    pub values: Tape,
    /// Factor of each derivative.
    pub terms: Vec<Term>,
}

/// Factor of a derivative in the residual.
pub struct Term {
    /// Sign, 1 or -1.
    pub sign: f64,
    /// Input that multiplies the derivative, if any.
    pub factor: Option<usize>,
}

/// Reason why a residual is not formed by differences.
pub type Reason = &'static str;

impl Underived {
    /// Records the quantities that the residual of `claim` differentiates.
    pub fn record(case: &Case, claim: &PlacedClaim) -> Result<Result<Self, Reason>, Fault> {
        let model = &case.model;
        let (parameters, dimension) = (model.free_components(), model.dimension());
        let inputs = parameters + dimension;
        let kept = claim.place.kept.iter().any(|kept| *kept);
        if matches!(claim.kind, ClaimKind::Density(_)) && kept && !model.system.conserves_level() {
            return Ok(Err(
                "the level changes next to itself, and its cofactor takes second derivatives",
            ));
        }
        let is_criterion = matches!(
            claim.kind,
            ClaimKind::AnalyticDensity(_)
                | ClaimKind::SmoothDensity(_)
                | ClaimKind::PositionDensity(_)
        );
        if is_criterion && matches!(model.system, System::Spinning(_)) {
            return Ok(Err("C₁ is not the derivative of one function"));
        }
        let formula = match &claim.kind {
            ClaimKind::Integral(Integral(formula)) | ClaimKind::Density(Density(formula)) => {
                Some(formula)
            }
            ClaimKind::AnalyticDensity(_)
            | ClaimKind::SmoothDensity(_)
            | ClaimKind::PositionDensity(_) => None,
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
            logarithmic: matches!(claim.kind, ClaimKind::Density(_)),
        });
        let along_axes = match &claim.kind {
            ClaimKind::Integral(_) => Vec::new(),
            ClaimKind::Density(_) => divergence(&graph, &field, parameters),
            _ => rotation(&graph, &values, case),
        };
        Ok(Ok(Self { parameters, dimension, along_field, along_axes }))
    }

    /// Operations per state, if the quantities along the field or an axis are computed `points`
    /// times.
    pub fn operations(&self, points: usize) -> usize {
        let field = self.along_field.as_ref();
        let field = field.map_or(0, |f| f.field.operations() + points * f.value.operations());
        let axes: usize = self.along_axes.iter().map(|axis| axis.values.operations()).sum();
        field + points * axes
    }
}

/// Terms of Σ ∂v_i/∂x_i, without the v_i that do not depend on x_i.
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

/// Terms of (γ, rot w) or of the rotation of ξ, axis by axis.
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
