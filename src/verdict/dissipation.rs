//! Rates of Lyapunov functions in forms that show their sign: sums of squares, found in numbers or by completing
//! squares, products and collected terms; judged as if the user had given them by `equals`.

use std::collections::BTreeSet;

use super::evidence::{ClaimReport, Verdict};
use super::judge::{JudgeError, Options, Trust, judge};
use super::run::{Doubles, Run};
use super::sampler::{Sampler, TAPE_LANES};
use super::squares_of_rates::{numbers, squares, sums};
use super::sum_of_squares::sum_of_squares;
use crate::case::{Case, PlacedClaim};
use crate::claim::{ClaimKind, Lyapunov};
use crate::formula::{Formula, Type, exponent_text};
use crate::graph::{Expr, Graph, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{
    ParameterOrigin, Phase, SamplerSpec, System, Variable, VariableRole, combinations,
};
use crate::number::ball::Ball;
use crate::number::rational::Rational;
use crate::order::StableOrder;
use crate::proof::{
    NamedPolynomial, SimplerForm, completed_squares, factored_sum, is_nowhere_zero, simpler_forms,
    volterra_sum,
};
use crate::scalar::Scalar;

/// Largest number of rates that are judged for one claim.
pub(super) const MOST_RATES: usize = 6;

/// Length in letters of a form of a rate that is tried before others are sought.
const SHORT: usize = 120;

/// Forms of a rate that are looked for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    /// Short ones by squares alone, which take little time.
    Short,
    All,
}

/// Judges anew each Lyapunov function whose rate has no known sign, with other forms of its rate.
pub(super) fn find_rates(
    case: &Case,
    options: &Options,
    reports: &mut [ClaimReport],
) -> Result<(), JudgeError> {
    for (claim, report) in case.claims.iter().zip(reports) {
        let ClaimKind::Lyapunov(own) = &claim.kind else { continue };
        let is_open = report.verdict == Verdict::Undecided && options.trust != Trust::Float;
        if !is_open || own.has_form() {
            continue;
        }
        let mut tried = BTreeSet::new();
        for stage in [Stage::Short, Stage::All] {
            let forms = rates(case, claim, own, (own.function(), stage), options.seed)?;
            let mut forms = forms.into_iter().filter(|text| tried.insert(text.clone()));
            let proved = forms
                .find_map(|text| proved_by(case, (claim, own), &text, options).transpose())
                .transpose()?;
            if let Some(mut proved) = proved {
                proved.formula.clone_from(&report.formula);
                *report = proved;
                break;
            }
        }
    }
    Ok(())
}

/// Judges a Lyapunov function with a form of its rate; `None` if that is not proved.
fn proved_by(
    case: &Case,
    (claim, own): (&PlacedClaim, &Lyapunov),
    text: &str,
    options: &Options,
) -> Result<Option<ClaimReport>, JudgeError> {
    let Ok(rate) = case.formula(text) else { return Ok(None) };
    let mut alone = case.clone();
    (alone.motions, alone.absences) = (Vec::new(), Vec::new());
    let kind = ClaimKind::Lyapunov(own.with_form(rate));
    alone.claims = vec![PlacedClaim { kind, ..claim.clone() }];
    let judged = judge(&alone, &Options { mutants: false, ..*options })?;
    let proved = judged.claims.into_iter().find(|one| one.verdict == Verdict::Proved);
    Ok(proved.map(|mut proved| {
        proved.evidence.add_remark(format!("its rate is {text}"));
        proved
    }))
}

/// Lists forms that the rate may have.
fn rates(
    case: &Case,
    claim: &PlacedClaim,
    own: &Lyapunov,
    (function, stage): (&Formula, Stage),
    seed: u64,
) -> Result<Vec<String>, JudgeError> {
    let model = &case.model;
    let free = model.free_components();
    let (names, kept) = names(case);
    let (graph, (growth, factors, terms, quotients)) =
        record(free + model.dimension(), |inputs| {
            let of = |place: &Source| match place {
                Source::Zero => Expr::rational(&Rational::from(0)),
                Source::Input(index) => inputs[*index],
                Source::Opposite(index) => -inputs[*index],
            };
            let parameters: Vec<Expr> = kept.iter().map(of).collect();
            let jet = DualPoint::new(Phase::new(model, &parameters, &inputs[free..]));
            let factors = own.factors(&jet);
            let terms: Vec<Expr> = factors.iter().map(|[slope, rate]| *slope * *rate).collect();
            let quotients: Vec<Expr> = factors.iter().map(|[slope, rate]| *slope / *rate).collect();
            (own.growth(&jet), factors, terms, quotients)
        })?;
    // An ∫ has no name.
    if graph.inputs() > free + model.dimension() {
        return Ok(Vec::new());
    }
    let sampler = Sampler::new(case, &claim.place, seed)?;
    let completed = completed_squares(&graph, growth, free, &names);
    let mut all: Vec<String> = completed.map(|found| found.text).into_iter().collect();
    let simpler = simpler_forms(&graph, growth, free, &names, &written_as_squares);
    let mut forms: Vec<SimplerForm> = simpler.into_iter().collect();
    if stage == Stage::All {
        forms.extend(factored_sum(&graph, &terms, free, &names, &written_as_squares));
        let rates: Vec<String> = rate_names(case);
        forms.extend(weighted_squares(&graph, &quotients, &rates, (free, &names)));
        let slopes: Vec<Expr> = factors.iter().map(|[slope, _]| *slope).collect();
        forms.extend(volterra_sum(&graph, growth, &slopes, free, &names));
    }
    let power = power_of_forces(case, function);
    if let Some(power) = &power {
        let (graph, power) = record(free + model.dimension(), |inputs| {
            let (parameters, state) = inputs.split_at(free);
            Phase::new(model, parameters, state).scalar(power)
        })?;
        forms.extend(simpler_forms(&graph, power, free, &names, &written_as_squares));
    }
    all.extend(forms.into_iter().map(|form| form.text));
    let squares = squares(case, function);
    let numbers = numbers(case);
    let (graph, outputs) = record(free + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(free);
        let jet = DualPoint::new(Phase::new(model, parameters, state));
        let formulas = squares.iter().map(|square| &square.formula).chain(&numbers);
        let mut outputs = vec![own.growth(&jet)];
        outputs.extend(formulas.map(|formula| jet.phase.scalar(formula)));
        outputs
    })?;
    let values = Run::new(&graph, &outputs, free + model.dimension())
        .at::<Doubles>(&Ball::<TAPE_LANES>, &sampler.balls(0));
    let table: Vec<Vec<f64>> = (0..TAPE_LANES)
        .map(|lane| (0..outputs.len()).map(|k| values.output(k).mid[lane]).collect())
        .filter(|row: &Vec<f64>| row.iter().all(|x| x.is_finite()))
        .collect();
    all.extend(sums(&table, &squares, &numbers));
    let mut seen = BTreeSet::new();
    all.retain(|text| seen.insert(text.clone()));
    all.retain(|text| stage == Stage::All || text.len() <= SHORT);
    all.order_by_key(String::len);
    if sampler.has_lists() {
        // Where a divisor is 0 for a listed value nothing would be said of that.
        let mut are_kept = Vec::new();
        for text in &all {
            are_kept.push(divides_by_no_zero(case, &sampler, text)?);
        }
        let mut are_kept = are_kept.into_iter();
        all.retain(|_| are_kept.next().unwrap_or_default());
    }
    all.truncate(MOST_RATES);
    all.extend(power.map(|power| power.text().to_string()));
    Ok(all)
}

/// Whether each divisor in a formula is known to be nowhere 0, for each choice of listed values.
fn divides_by_no_zero(case: &Case, sampler: &Sampler, text: &str) -> Result<bool, JudgeError> {
    let Ok(rate) = case.formula(text) else { return Ok(false) };
    let below = rate.denominators().into_iter().map(|own| case.formula(&own.text));
    let Ok(below) = below.collect::<Result<Vec<Formula>, _>>() else { return Ok(false) };
    if below.is_empty() {
        return Ok(true);
    }
    let Some(choices) = combinations(sampler.recipes()) else { return Ok(false) };
    let (model, free) = (&case.model, case.model.free_components());
    let (graph, divisors) = record(free + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(free);
        let phase = Phase::new(model, parameters, state);
        below.iter().map(|own| phase.scalar(own)).collect::<Vec<Expr>>()
    })?;
    let extents = sampler.extents();
    for fixed in choices {
        let (graph, own) = sampler.compose(&graph, std::slice::from_ref(&divisors), &fixed)?;
        let is_nonzero = |own: Expr| match graph.constant_value(own) {
            Some(value) => !value.is_zero(),
            None => is_nowhere_zero(&graph, &extents, &[], &[own]),
        };
        if !own.concat().into_iter().all(is_nonzero) {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Writes Σ Qₖ wₖ + (∂(F − E)/∂q, q') for a Lagrangian with generalised forces Q and energy E: the rate of F where
/// F − E depends on coordinates alone, constraints are homogeneous and nothing depends on time. For the energy of a body
/// this is (moment, ω).
fn power_of_forces(case: &Case, function: &Formula) -> Option<Formula> {
    if let (Some(moment), [spin, ..]) = (case.model.system.moment(), &case.model.state[..]) {
        let power = format!("({}, {})", moment.text(), spin.name);
        return (function.text().trim() == "energy").then(|| case.formula(&power).ok()).flatten();
    }
    let System::Lagrangian(own) = &case.model.system else { return None };
    if own.forces.is_empty() {
        return None;
    }
    let force = |(component, force): &(usize, Formula)| {
        format!("({})*{}", force.text(), case.model.component_name(*component))
    };
    let forces = own.forces.iter().map(force);
    let slope = |(variable, role): (&Variable, &VariableRole)| {
        let (name, is_coordinate) = (&variable.name, matches!(role, VariableRole::Coordinate(_)));
        let slope = format!("∂({} - energy)/∂{name}", function.text());
        match variable.kind {
            Type::Scalar => is_coordinate.then(|| format!("({slope})*({name}')")),
            Type::Vector(_) => is_coordinate.then(|| format!("({slope}, {name}')")),
            Type::Matrix(..) => None,
        }
    };
    let slopes = case.model.state.iter().zip(&own.roles).filter_map(slope);
    let is_energy = function.text().trim() == "energy";
    let terms: Vec<String> = forces.chain(slopes.filter(|_| !is_energy)).collect();
    case.formula(&terms.join(" + ")).ok()
}

/// Names the rates of the components of the state.
fn rate_names(case: &Case) -> Vec<String> {
    let of = |(name, index): (&str, String)| match index.is_empty() {
        true => format!("{name}'"),
        false => format!("({name}'){index}"),
    };
    let variables = case.model.state.iter();
    let each = variables.flat_map(|own| {
        own.kind.indices().into_iter().map(|index| of((own.name.as_str(), index.to_string())))
    });
    each.collect()
}

/// Writes Σ (∂F/∂xₖ / xₖ') xₖ'², with the quotients in lowest terms.
fn weighted_squares(
    graph: &Graph,
    quotients: &[Expr],
    rates: &[String],
    (free, names): (usize, &[String]),
) -> Option<SimplerForm> {
    let mut whole = SimplerForm { text: String::new(), divides: false };
    let mut texts = Vec::new();
    for (quotient, rate) in quotients.iter().zip(rates) {
        if graph.is_nowhere_defined(*quotient) || is_zero(graph, *quotient) {
            continue;
        }
        let form = factored_sum(graph, &[*quotient], free, names, &written_as_squares)?;
        whole.divides |= form.divides;
        texts.push(format!("({})*{rate}^2", form.text));
    }
    whole.text = texts.join(" + ");
    (!texts.is_empty()).then_some(whole)
}

fn is_zero(graph: &Graph, value: Expr) -> bool {
    graph.constant_value(value).is_some_and(Rational::is_zero)
}

/// Writes a polynomial as a sum of squares.
fn written_as_squares(own: &NamedPolynomial<'_>) -> Option<String> {
    let monomial = |(value, powers): &(Rational, Vec<u32>)| {
        let named = powers.iter().zip(&own.names).filter(|(power, _)| **power > 0);
        let powers = named.map(|(power, name)| match power {
            1 => (*name).to_string(),
            _ => format!("{name}{}", exponent_text(i64::from(*power))),
        });
        let number = (!value.is_one()).then(|| format!("({value})"));
        let all: Vec<String> = number.into_iter().chain(powers).collect();
        if all.is_empty() { "1".to_string() } else { all.join("*") }
    };
    let square = |(factor, terms): &(Rational, Vec<(Rational, Vec<u32>)>)| {
        let sum: Vec<String> = terms.iter().map(monomial).collect();
        format!("({factor})*({})^2", sum.join(" + "))
    };
    let squares = sum_of_squares(&own.terms)?;
    Some(squares.iter().map(square).collect::<Vec<String>>().join(" + "))
}

/// The input that a component of the parameters is equal to.
enum Source {
    Zero,
    Input(usize),
    Opposite(usize),
}

/// Names the components of the free parameters and of the state; also says which of the former are
/// equal to others.
fn names(case: &Case) -> (Vec<String>, Vec<Source>) {
    let (mut names, mut sources): (Vec<String>, Vec<Source>) = (Vec::new(), Vec::new());
    for parameter in case.model.free_parameters() {
        let first = names.len();
        let own = parameter.kind.indices();
        names.extend(own.iter().map(|index| format!("{}{index}", parameter.name)));
        let ParameterOrigin::Free(spec) = &parameter.origin else {
            sources.extend((0..own.len()).map(|k| Source::Input(first + k)));
            continue;
        };
        let columns = match parameter.kind {
            Type::Matrix(_, columns) => columns,
            _ => 1,
        };
        sources.extend((0..own.len()).map(|k| {
            let (i, j) = (k / columns, k % columns);
            match spec {
                SamplerSpec::Diagonal(..)
                | SamplerSpec::Spherical(..)
                | SamplerSpec::Inertia(_)
                | SamplerSpec::AxisymmetricInertia(_)
                    if i != j =>
                {
                    Source::Zero
                }
                SamplerSpec::Spherical(..) => Source::Input(first),
                SamplerSpec::Skew(..) if i == j => Source::Zero,
                SamplerSpec::Skew(..) if i > j => Source::Opposite(first + j * columns + i),
                SamplerSpec::Symmetric(..) | SamplerSpec::FullInertia(_) if i > j => {
                    Source::Input(first + j * columns + i)
                }
                _ => Source::Input(first + k),
            }
        }));
    }
    for variable in &case.model.state {
        let own = variable.kind.indices();
        names.extend(own.iter().map(|index| format!("{}{index}", variable.name)));
    }
    (names, sources)
}
