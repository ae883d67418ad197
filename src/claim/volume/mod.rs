//! Zeros of the density ρ₀ relative to which the criterion is taken: D_T det Ĩ of a body that may
//! spin, D_T (γ, adj Ĩ γ) of one that may not.
//!
//! The criterion yields a density ρ₀ N for ρ₀ ≠ 0 on the whole sphere of γ. Where ρ₀ vanishes the
//! equations of motion have no value, and around such places a closed form need be no differential.

mod curved;

use num_dual::DualNum;
use num_traits::{One, Zero};

use super::assumption::Assumption;
use crate::graph::{Evaluator, Expr, Tape, record};
use crate::mechanics::{
    Draw, DrawSource, Model, NORMAL, ParameterOrigin, Phase, SamplerSpec, System, combinations,
};
use crate::number::Domain;
use crate::number::ball::{Ball, Balls};
use crate::number::rational::Rational;
use crate::proof::{Extent, is_seen_nowhere_zero, sign};
use crate::scalar::Scalar;

/// Number of bodies of the case that are tried, and the seed by which `eval` draws them too.
const BODIES: u64 = 64;
const SEED: u64 = 1;

/// Number of pieces of the ranges in which ρ₀ is enclosed.
const PIECES: usize = 1 << 9;

/// Number of normals of each body that are tried in one run, as lanes, and number of runs.
const NORMALS: usize = 64;
const RUNS: usize = 4;

/// Knowledge of the zeros of ρ₀.
enum Zeros {
    /// There are none.
    None,
    /// There is one, as described.
    Known(String),
    /// The body of this number has an inertia tensor that is not known to be positive definite, so that ρ₀ may vanish.
    Indefinite(u64),
    /// It is not known whether there are any.
    Possible,
}

/// Name of ρ₀.
fn name(model: &Model) -> String {
    let own = match model.system {
        System::Rubber(_) => "(γ, adj(Ĩ)γ)",
        _ => "det Ĩ",
    };
    let is_curved = model.system.body().is_some_and(|body| body.curvature.is_some());
    if is_curved { format!("D_T {own}") } else { own.to_string() }
}

/// Returns the reason why the criterion proves nothing, if it is known that ρ₀ vanishes.
pub(super) fn limit_of_proof(model: &Model) -> Option<String> {
    match zeros(model) {
        Zeros::Known(place) => Some(format!(
            "the criterion is 0, and {} is 0 {place}: the equations of motion have no value there, and \
             the criterion tells of a density only where this is not 0 for all γ",
            name(model)
        )),
        Zeros::Indefinite(body) => Some(format!(
            "the criterion is 0, but it is not known that I is positive definite for the body of state {body}, and \
             that {} is not 0 for some γ, where the equations of motion would have no value",
            name(model)
        )),
        Zeros::None | Zeros::Possible => None,
    }
}

/// Returns the hypothesis of a criterion that ρ₀ vanishes nowhere, if that is not known.
pub(super) fn assumption(model: &Model) -> Option<(Assumption, String)> {
    matches!(zeros(model), Zeros::Possible).then(|| {
        let name = name(model);
        let words =
            format!("it is not known that {name} ≠ 0 for all γ, which the criterion presupposes");
        (Assumption::NonzeroVolume, words)
    })
}

/// Looks for zeros for each choice of listed values.
fn zeros(model: &Model) -> Zeros {
    let draws = model.parameter_draws();
    let Some(choices) = combinations(&draws) else { return Zeros::Possible };
    let mut all = Zeros::None;
    for fixed in choices.into_iter().filter(|fixed| !model.has_no_motion_for(fixed)) {
        let chosen = draws.iter().zip(&fixed).map(|(draw, own)| draw.fixed(own.as_ref()));
        match zeros_for(model, &chosen.collect::<Vec<Draw>>(), &fixed) {
            Zeros::None => {}
            Zeros::Possible => all = Zeros::Possible,
            known => return known,
        }
    }
    all
}

/// Looks for zeros: on the axes, and for bodies of the case where bounds do not show that there are none.
fn zeros_for(model: &Model, draws: &[Draw], fixed: &[Option<Rational>]) -> Zeros {
    let Some(body) = model.system.body() else { return Zeros::None };
    let mut extents: Vec<Extent> = draws.iter().map(Draw::extent).collect();
    extents.extend([unit(); 3]);
    let recorded = record(extents.len(), |inputs| {
        let own = fixed.iter().zip(inputs);
        let own = own.map(|(own, input)| own.as_ref().map_or(*input, Expr::rational));
        let inputs: Vec<Expr> = own.chain(inputs[fixed.len()..].iter().copied()).collect();
        let (free, gamma) = model.make_parameters(&inputs);
        let state = |gamma: &[Expr]| {
            let mut state = vec![Expr::one(); model.dimension()];
            let place = 3 * NORMAL;
            state.get_mut(place..place + 3)?.copy_from_slice(gamma);
            Some(state)
        };
        let at = |gamma: &[Expr]| {
            let phase = Phase::new(model, &free, &state(gamma)?);
            model.system.reference_density(&phase.configuration)
        };
        let on_axes = (0..6).map(|number| {
            let side = if number % 2 == 0 { Expr::one() } else { -Expr::one() };
            let mut axis = [Expr::zero(); 3];
            axis[number / 2] = side;
            at(&axis)
        });
        let on_axes = on_axes.collect::<Option<Vec<Expr>>>()?;
        // The point of the sphere with stereographic coordinates u and v.
        let (u, v) = (gamma[0], gamma[1]);
        let square = u * u + v * v;
        let turned = [u * 2.0, v * 2.0, Expr::one() - square].map(|x| x / (square + 1.0));
        let phase = Phase::new(model, &free, &state(gamma)?);
        let (minors, mass) = body.masses(&phase.configuration);
        let sphere = gamma.iter().fold(-Expr::one(), |sum, x| sum + x.powi(2));
        let values = [vec![at(gamma)?, at(&turned)?, mass], minors.to_vec()].concat();
        Some((values, on_axes, [sphere, -sphere]))
    });
    let Ok((graph, Some((values, on_axes, sphere)))) = recorded else { return Zeros::Possible };
    let [density, turned, mass, minors @ ..] = &values[..] else {
        return Zeros::Possible;
    };
    let is_zero = |value: &Expr| graph.constant_value(*value).is_some_and(Rational::is_zero);
    let vanishing: Vec<usize> = (0..6).filter(|number| is_zero(&on_axes[*number])).collect();
    if !vanishing.is_empty() {
        return Zeros::Known(format!("at {}", named(&vanishing)));
    }
    let is_nonzero =
        |value: &Expr| is_seen_nowhere_zero(&graph, &extents, &sphere, &[*value], PIECES);
    let is_positive = |value: &Expr, may_vanish: bool| {
        let known = sign(&graph, &extents, &[], &[], *value);
        known.is_some_and(|known| known.is_positive && (may_vanish || !known.may_vanish))
    };
    // Ĩ = I + m(r²E − r⊗r) is definite where I is, and m is not negative.
    let is_definite =
        has_positive_moments(model) || minors.iter().all(|own| is_positive(own, false));
    let is_curved = body.curvature.is_some();
    let is_regular = || !is_curved || curved::is_nowhere_zero(model, body, draws);
    if is_definite && is_positive(mass, true) && is_regular() || is_nonzero(density) {
        return Zeros::None;
    }
    let tape = Tape::new(&graph, &[*turned]);
    if let Some(body) = (0..BODIES).find(|body| takes_both_signs(&tape, draws, *body)) {
        return Zeros::Known(format!("for some γ of the body of state {body}"));
    }
    let tape = Tape::new(&graph, minors);
    let indefinite = || (0..BODIES).find(|body| !has_positive_values(&tape, draws, *body));
    match (!is_definite).then(indefinite).flatten() {
        Some(body) => Zeros::Indefinite(body),
        None => Zeros::Possible,
    }
}

/// Whether values that depend on parameters alone are known to be positive for a body.
fn has_positive_values(tape: &Tape, draws: &[Draw], body: u64) -> bool {
    let values = DrawSource::new(draws).state(SEED, body);
    let mut inputs: Vec<Balls<1>> =
        values.iter().map(|x| Ball::<1>.values(std::slice::from_ref(x))).collect();
    inputs.resize(tape.inputs().max(inputs.len()), Balls::new([f64::NAN], [0.0]));
    let mut evaluator = Evaluator::new(tape, Ball::<1>);
    evaluator.run(&inputs);
    evaluator.outputs().all(|own| own.excludes_zero(0) && own.mid[0] > 0.0)
}

/// Numbers between -1 and 1.
fn unit() -> Extent {
    Extent::between(&Rational::from(-1), &Rational::from(1))
}

/// Names axes by their numbers.
fn named(axes: &[usize]) -> String {
    let one = |number: &usize| {
        let (axis, is_opposite) = (number / 2, number % 2 == 1);
        let has_other = axes.contains(&(number ^ 1));
        match (has_other, is_opposite) {
            (true, true) => None,
            (true, false) => Some(format!("γ = ±e{}", axis + 1)),
            (false, true) => Some(format!("γ = −e{}", axis + 1)),
            (false, false) => Some(format!("γ = e{}", axis + 1)),
        }
    };
    axes.iter().filter_map(one).collect::<Vec<String>>().join(", ")
}

/// Whether the inertia tensor is a parameter whose principal moments are drawn, and positive.
fn has_positive_moments(model: &Model) -> bool {
    let own = model.parameters.iter().find(|parameter| parameter.name == "I");
    let is_given = model.system.body().is_some_and(|body| body.inertia.text().trim() == "I");
    let recipe = own.and_then(|parameter| match &parameter.origin {
        ParameterOrigin::Free(recipe) => Some(recipe),
        _ => None,
    });
    match recipe {
        Some(
            SamplerSpec::Inertia(range)
            | SamplerSpec::AxisymmetricInertia(range)
            | SamplerSpec::FullInertia(range),
        ) => is_given && range.low > Rational::from(0),
        _ => false,
    }
}

/// Whether a value is above 0 for some normals of a body and below 0 for others. It is 0 between them,
/// or has no value.
fn takes_both_signs(tape: &Tape, draws: &[Draw], body: u64) -> bool {
    let domain = Ball::<NORMALS>;
    let values = DrawSource::new(draws).state(SEED, body);
    let drawn: Vec<Balls<NORMALS>> = values.iter().map(|x| domain.constant(x)).collect();
    let exact = |of: &dyn Fn(usize) -> f64| Balls::new(std::array::from_fn(of), [0.0; NORMALS]);
    let mut evaluator = Evaluator::new(tape, domain);
    let (mut is_positive, mut is_negative) = (false, false);
    for run in 0..RUNS {
        let mut inputs = drawn.clone();
        inputs.push(exact(&|lane| stereographic(run * NORMALS + lane)[0]));
        inputs.push(exact(&|lane| stereographic(run * NORMALS + lane)[1]));
        inputs.push(exact(&|_| 0.0));
        inputs.resize(tape.inputs().max(inputs.len()), exact(&|_| f64::NAN));
        evaluator.run(&inputs);
        let found = evaluator.output(0);
        let is_known = |lane: &usize| found.is_defined(*lane) && found.excludes_zero(*lane);
        for lane in (0..NORMALS).filter(is_known) {
            is_positive |= found.mid[lane] > 0.0;
            is_negative |= found.mid[lane] < 0.0;
        }
    }
    is_positive && is_negative
}

/// Stereographic coordinates of a point of a spiral that covers the sphere evenly.
fn stereographic(index: usize) -> [f64; 2] {
    /// Turn from one point to the next, in the golden ratio.
    const TURN: f64 = 2.399963229728653;
    let height = 1.0 - (2 * index + 1) as f64 / (RUNS * NORMALS) as f64;
    let radius = ((1.0 - height) / (1.0 + height)).sqrt();
    let angle = TURN * index as f64;
    [radius * libm::cos(angle), radius * libm::sin(angle)]
}
