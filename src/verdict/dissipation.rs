//! Rates of Lyapunov functions in forms that show their sign: sums of squares, found in numbers or by completing
//! squares, products and collected terms; judged as if the user had given them by `equals`.

use std::collections::BTreeSet;

use super::evidence::{ClaimReport, Verdict};
use super::judge::{JudgeError, Options, Trust, judge};
use super::run::{Doubles, Run};
use super::sampler::{Sampler, TAPE_LANES};
use super::sum_of_squares::sum_of_squares;
use crate::case::{Case, PlacedClaim};
use crate::claim::{ClaimKind, Lyapunov};
use crate::formula::{Formula, Type, exponent_text};
use crate::graph::{Expr, Graph, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{ParameterOrigin, Phase, SamplerSpec};
use crate::number::ball::Ball;
use crate::number::rational::Rational;
use crate::proof::{
    NamedPolynomial, SimplerForm, completed_squares, factored_sum, simpler_forms, volterra_sum,
};
use crate::scalar::Scalar;

/// Largest number of squares that are tried.
const MOST_SQUARES: usize = 32;
/// Largest number of rates that are judged for one claim.
const MOST_RATES: usize = 6;

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
        for text in rates(case, claim, own, own.function(), options.seed)? {
            let Ok(rate) = case.formula(&text) else { continue };
            let mut alone = case.clone();
            (alone.motions, alone.absences) = (Vec::new(), Vec::new());
            let kind = ClaimKind::Lyapunov(own.with_form(rate));
            alone.claims = vec![PlacedClaim { kind, ..claim.clone() }];
            let judged = judge(&alone, &Options { mutants: false, ..*options })?;
            let proved = judged.claims.into_iter().find(|one| one.verdict == Verdict::Proved);
            if let Some(mut proved) = proved {
                proved.formula.clone_from(&report.formula);
                proved.evidence.add_remark(format!("its rate is {text}"));
                *report = proved;
                break;
            }
        }
    }
    Ok(())
}

/// Lists forms that the rate may have.
fn rates(
    case: &Case,
    claim: &PlacedClaim,
    own: &Lyapunov,
    function: &Formula,
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
    // A denominator may be 0 for a listed value, and then nothing would be said of that.
    let may_divide = !sampler.has_lists();
    let completed = completed_squares(&graph, growth, free, &names);
    let mut all: Vec<String> = completed
        .filter(|found| may_divide || !found.divides)
        .map(|found| found.text)
        .into_iter()
        .collect();
    let simpler = simpler_forms(&graph, growth, free, &names, &written_as_squares);
    let by_terms = factored_sum(&graph, &terms, free, &names, &written_as_squares);
    let rates: Vec<String> = rate_names(case);
    let by_rates = weighted_squares(&graph, &quotients, &rates, (free, &names));
    let slopes: Vec<Expr> = factors.iter().map(|[slope, _]| *slope).collect();
    let by_rest = volterra_sum(&graph, growth, &slopes, free, &names);
    let forms = simpler.into_iter().chain(by_terms).chain(by_rates).chain(by_rest);
    all.extend(forms.filter(|form| may_divide || !form.divides).map(|form| form.text));
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
    all.extend(sums(&table, &squares, &numbers, may_divide));
    let mut seen = BTreeSet::new();
    all.retain(|text| seen.insert(text.clone()));
    all.sort_by_key(String::len);
    all.truncate(MOST_RATES);
    Ok(all)
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

/// Source of a square.
#[derive(Clone, Copy, PartialEq, Eq)]
enum SquareKind {
    /// Rate of a variable.
    Rate,
    /// Slope of F along a variable.
    Slope,
    /// Part of a formula of the file.
    Part,
    /// Rate of a variable, over the variable.
    Relative,
}

/// The square of a vector or scalar, of which the rate may consist.
struct Square {
    formula: Formula,
    kind: SquareKind,
}

/// Lists squares of vectors and scalars.
fn squares(case: &Case, function: &Formula) -> Vec<Square> {
    let model = &case.model;
    let mut texts: Vec<(String, SquareKind)> = Vec::new();
    for variable in &model.state {
        let name = &variable.name;
        texts.push((format!("{name}'"), SquareKind::Rate));
        texts.push((format!("∂({})/∂{name}", function.text()), SquareKind::Slope));
    }
    let formulas = model.dynamics().into_iter().chain(&model.abbreviations).chain([function]);
    let parts = formulas.flat_map(Formula::parts);
    texts.extend(parts.map(|text| (text.trim().to_string(), SquareKind::Part)));
    let mut seen = BTreeSet::new();
    texts.retain(|(text, _)| seen.insert(text.clone()));
    let square = |(text, kind): (String, SquareKind)| {
        let square = square_of(&case.formula(&text).ok()?);
        Some(Square { formula: case.formula(&square).ok()?, kind })
    };
    let relative = model.state.iter().filter_map(|variable| {
        let text = relative_square(&variable.name, variable.kind)?;
        Some(Square { formula: case.formula(&text).ok()?, kind: SquareKind::Relative })
    });
    relative.chain(texts.into_iter().filter_map(square)).take(MOST_SQUARES).collect()
}

/// Writes the sum of the squares of the components.
fn square_of(vector: &Formula) -> String {
    let text = vector.text();
    match vector.value_type() {
        Type::Matrix(..) => format!("tr(({text})ᵀ*({text}))"),
        _ => format!("({text})^2"),
    }
}

/// Writes Σ xᵢ'²/xᵢ.
fn relative_square(name: &str, kind: Type) -> Option<String> {
    match kind {
        Type::Scalar => Some(format!("{name}'^2/{name}")),
        Type::Vector(size) => {
            let terms = (1..=size).map(|k| format!("({name}')[{k}]^2/{name}[{k}]"));
            Some(terms.collect::<Vec<String>>().join(" + ")).map(|sum| format!("({sum})"))
        }
        Type::Matrix(..) => None,
    }
}

/// Lists the scalars among the free parameters, as formulas.
fn numbers(case: &Case) -> Vec<Formula> {
    let scalars = case.model.free_parameters().filter(|own| own.kind == Type::Scalar);
    scalars.filter_map(|own| case.formula(&own.name).ok()).collect()
}

/// Lists sums of squares, with numbers as negative factors, that the rate is equal to, up to a
/// parameter as a further factor: of one square or two, of all rates, and of all slopes.
fn sums(
    table: &[Vec<f64>],
    squares: &[Square],
    numbers: &[Formula],
    may_divide: bool,
) -> Vec<String> {
    let of_kind =
        |kind: SquareKind| (0..squares.len()).filter(|k| squares[*k].kind == kind).collect();
    let single = (0..squares.len()).map(|k| vec![k]);
    let pairs = (0..squares.len()).flat_map(|i| (0..i).map(move |j| vec![j, i]));
    let whole = [SquareKind::Rate, SquareKind::Slope, SquareKind::Relative].map(of_kind);
    let choices: Vec<Vec<usize>> = single.chain(whole).chain(pairs).collect();
    let mut factors: Vec<(String, Vec<f64>)> = vec![(String::new(), vec![1.0; table.len()])];
    for (p, number) in numbers.iter().enumerate() {
        let column = squares.len() + 1 + p;
        let name = number.text();
        factors.push((format!("{name}*"), table.iter().map(|row| row[column]).collect()));
        if may_divide {
            let inverses = table.iter().map(|row| 1.0 / row[column]).collect();
            factors.push((format!("1/{name}*"), inverses));
        }
    }
    let mut all = Vec::new();
    for (factor, values) in &factors {
        let target: Vec<f64> =
            table.iter().zip(values).map(|(row, value)| row[0] / value).collect();
        let written = |chosen: &Vec<usize>| {
            let multiples = fitted(table, &target, chosen)?;
            let term = |(k, multiple): (&usize, &f64)| match multiple.abs() < 1e-9 {
                true => Some(String::new()),
                false => {
                    let multiple = near(*multiple).filter(|multiple| multiple.is_negative())?;
                    Some(format!("({multiple})*{factor}{}", squares[*k].formula.text()))
                }
            };
            let terms: Vec<String> =
                chosen.iter().zip(&multiples).map(term).collect::<Option<_>>()?;
            let terms: Vec<String> = terms.into_iter().filter(|term| !term.is_empty()).collect();
            (terms.len() == chosen.len()).then(|| terms.join(" + "))
        };
        all.extend(choices.iter().filter_map(written).take(MOST_RATES));
    }
    all
}

/// Finds a fraction with a small denominator next to a number.
fn near(number: f64) -> Option<Rational> {
    const LARGEST: i64 = 120;
    (1..=LARGEST).find_map(|below| {
        let above = (number * below as f64).round();
        let is_near = (above / below as f64 - number).abs() < 1e-9 * number.abs().max(1.0);
        (is_near && above.abs() < 1e9).then(|| Rational::new(above as i64, below))
    })
}

/// Finds factors with which a column of values is a sum of some columns of squares, at all rows.
fn fitted(table: &[Vec<f64>], target: &[f64], chosen: &[usize]) -> Option<Vec<f64>> {
    let count = chosen.len();
    if count == 0 || table.len() < 2 * count {
        return None;
    }
    let equation = |(row, value): (&Vec<f64>, &f64)| -> Vec<f64> {
        chosen.iter().map(|k| row[k + 1]).chain([*value]).collect()
    };
    let mut rows: Vec<Vec<f64>> = table.iter().zip(target).take(count).map(equation).collect();
    for column in 0..count {
        let largest =
            |a: &usize, b: &usize| rows[*a][column].abs().total_cmp(&rows[*b][column].abs());
        let best = (column..count).max_by(largest)?;
        rows.swap(column, best);
        let pivot = rows[column].clone();
        if pivot[column].abs() < 1e-12 {
            return None;
        }
        for row in rows.iter_mut().enumerate().filter(|(at, _)| *at != column).map(|(_, row)| row) {
            let factor = row[column] / pivot[column];
            row.iter_mut().zip(&pivot).for_each(|(x, y)| *x -= factor * y);
        }
    }
    let factors: Vec<f64> = (0..count).map(|k| rows[k][count] / rows[k][k]).collect();
    let fits = |(row, value): (&Vec<f64>, &f64)| {
        let terms = chosen.iter().zip(&factors).map(|(k, factor)| factor * row[k + 1]);
        let size: f64 = terms.clone().map(f64::abs).sum::<f64>() + value.abs();
        (terms.sum::<f64>() - value).abs() <= 1e-9 * size
    };
    table.iter().zip(target).all(fits).then_some(factors)
}
