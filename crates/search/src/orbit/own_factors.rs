//! Variables that divide their own rates: Darboux polynomials of a field of any degree.
//!
//! x' = x K is read off the recorded field operation by operation: x divides a product if it divides
//! one of its factors, a sum if it divides both of its terms, and a power if it divides its base. The
//! quotient K is written as the field is, without being multiplied out.

use liouville::formula::{Formula, FormulaError, FormulaResult};
use liouville::graph::{Graph, Step};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};

use super::super::terms::{product, recorded};
use super::super::{FoundKind, Given, SearchError, SearchReport};
use super::claims::{self, OrbitStatement};
use super::cleared::{denominators, input_names};
use super::exponents::ExponentSystem;
use super::factor::RatedPolynomial;
use super::known::IndependentIntegrals;
use super::setting::OrbitSetting;
use super::unbound;

/// Kind of these finds.
/// Longest formula of a step, in bytes.
const LONGEST: usize = 2000;

/// Reports the variables that divide their own rates, as far as they are not yet reported, and the
/// densities and integrals that they are factors of.
pub fn search(
    setting: &OrbitSetting<'_>,
    known: &mut IndependentIntegrals,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let (graph, rates) = recorded(setting.case, |jet| jet.phase.field().to_vec())?;
    let inputs = input_names(setting.case).into_iter().map(|name| setting.case.formula(&name));
    let Ok(inputs) = inputs.collect::<Result<Vec<Formula>, _>>() else { return Ok(()) };
    if inputs.len() != graph.inputs() {
        return Ok(());
    }
    let first = inputs.len() - setting.dimension();
    let places: Vec<usize> = rates.iter().map(|rate| graph.place(*rate)).collect();
    let is_known = |report: &SearchReport, name: &Formula| {
        report.has(FoundKind::DarbouxPolynomial, name.text())
    };
    let open: Vec<usize> =
        (0..places.len()).filter(|k| !is_known(report, &setting.terms[*k])).collect();
    let divided: Vec<usize> =
        open.into_iter().filter(|k| divides(&graph, places[*k], first + k)).collect();
    if divided.is_empty() {
        return Ok(());
    }
    let steps = WrittenSteps::of(&graph, &inputs, &places)?;
    let mut is_new = false;
    for k in divided {
        setting.effort.halt.check()?;
        let name = &setting.terms[k];
        let quotient = steps.quotients(places[k], first + k)?.pop().flatten();
        let Some(Quotient::Other(cofactor)) = quotient else { continue };
        let rate = (cofactor.bracketed() * name)?;
        let statement = OrbitStatement::Rate { function: name.clone(), rate };
        let with = Some(Given::Cofactor(cofactor.clone()));
        is_new |=
            claims::other(setting, FoundKind::DarbouxPolynomial, name, &statement, with, report)?;
    }
    if !is_new {
        return Ok(());
    }
    let mut factors = Vec::new();
    for found in report.found.iter().filter(|own| own.kind == FoundKind::DarbouxPolynomial) {
        if let Some(function) = found.function() {
            factors.extend(RatedPolynomial::of(setting, function, 1)?);
        }
    }
    for (denominator, degree) in denominators(setting.case)? {
        factors.extend(RatedPolynomial::of(setting, &denominator, degree)?);
    }
    let all: Vec<usize> = (0..setting.dimension()).collect();
    ExponentSystem::of(setting, &all, &factors, &[])?.search(known, report)
}

/// Adds to the factors of an extended case what [`of_extension`] and [`rates_on_lines`] list.
pub fn extend(
    setting: &OrbitSetting<'_>,
    factors: &mut Vec<RatedPolynomial>,
) -> Result<(), SearchError> {
    for formula in of_extension(setting)?.into_iter().chain(rates_on_lines(setting)?) {
        if factors.iter().all(|own| own.formula.text() != formula.text()) {
            let rated = RatedPolynomial::of(setting, &formula, 1)?;
            factors.extend(rated.filter(|own| unbound::changes(setting, own)));
        }
    }
    Ok(())
}

/// Lists the variables among these that divide their own rates, on the level of the case or not.
pub fn of_level(
    setting: &OrbitSetting<'_>,
    variables: &[usize],
) -> Result<Vec<Formula>, SearchError> {
    let (graph, rates) = recorded(setting.case, |jet| jet.phase.field().to_vec())?;
    let first = setting.case.model.free_components();
    let is_own = |k: &&usize| {
        graph.constant_value(rates[**k]).is_none()
            && divides(&graph, graph.place(rates[**k]), first + **k)
    };
    Ok(variables.iter().filter(is_own).map(|k| setting.terms[*k].clone()).collect())
}

/// Rates P(x) that depend on x alone, which divide their own: P' = (∂P/∂x) P.
fn rates_on_lines(setting: &OrbitSetting<'_>) -> Result<Vec<Formula>, SearchError> {
    let Some(origin) = setting.origin else { return Ok(Vec::new()) };
    let (graph, rates) = recorded(origin.case, |jet| jet.phase.field().to_vec())?;
    let first = origin.case.model.free_components();
    let is_alone = |k: &usize| {
        let inputs = graph.inputs_of(rates[*k]);
        inputs.iter().filter(|own| **own >= first).eq([&(first + k)])
    };
    let alone: Vec<usize> = (0..rates.len()).filter(is_alone).collect();
    let (graph, rates) = recorded(setting.case, |jet| jet.phase.field().to_vec())?;
    let inputs = input_names(setting.case).into_iter().map(|name| setting.case.formula(&name));
    let Ok(inputs) = inputs.collect::<Result<Vec<Formula>, _>>() else { return Ok(Vec::new()) };
    if alone.is_empty() || inputs.len() != graph.inputs() {
        return Ok(Vec::new());
    }
    let places: Vec<usize> = alone.iter().map(|k| graph.place(rates[*k])).collect();
    let steps = WrittenSteps::of(&graph, &inputs, &places)?;
    let written = places.into_iter().filter_map(|place| steps.all[place].clone());
    Ok(written.map(|own| own.bracketed()).collect())
}

/// Variables of an extended case that divide their own rates, and 1 ± s for the partner s of one on a circle.
fn of_extension(setting: &OrbitSetting<'_>) -> Result<Vec<Formula>, SearchError> {
    let Some(origin) = setting.origin else { return Ok(Vec::new()) };
    let (graph, rates) = recorded(setting.case, |jet| jet.phase.field().to_vec())?;
    let first = setting.case.model.free_components();
    let mut found = Vec::new();
    for (k, name) in setting.terms.iter().enumerate() {
        let place = graph.place(rates[k]);
        let is_constant = graph.constant_value(rates[k]).is_some();
        if is_constant || origin.extension.has_inverse(name) || !divides(&graph, place, first + k) {
            continue;
        }
        found.push(name.clone());
        if let Some(partner) = origin.extension.partner(name) {
            let one = Formula::number(1);
            found.extend([(&one + &partner)?.bracketed(), (&one - &partner)?.bracketed()]);
        }
    }
    Ok(found)
}

/// Whether a step is seen to be a multiple of an input, by its operations.
fn divides(graph: &Graph, place: usize, input: usize) -> bool {
    let reached = graph.reached_from(&[place]);
    let mut all = vec![false; place + 1];
    for own in (0..=place).filter(|own| reached[*own]) {
        all[own] = match graph.step(own) {
            Step::Constant(value) => value.is_zero(),
            Step::Input(own) => own == input,
            Step::Unary(UnaryFunction::Neg, a) => all[a],
            Step::Binary(BinaryOperation::Add | BinaryOperation::Sub, a, b) => all[a] && all[b],
            Step::Binary(BinaryOperation::Mul, a, b) => all[a] || all[b],
            Step::Power(a, exponent) => all[a] && exponent.to_integer() > Some(0),
            Step::Unary(..) | Step::Binary(BinaryOperation::Pow, ..) => false,
        };
    }
    all[place]
}

/// The quotient of a step by an input.
#[derive(Clone)]
enum Quotient {
    Zero,
    Other(Formula),
}

/// Steps of a recording as formulas.
struct WrittenSteps<'g> {
    graph: &'g Graph,
    /// Formulas; `None` where a step contains functions, or is long.
    all: Vec<Option<Formula>>,
    /// Base and exponent of products of one step with itself.
    powers: Vec<(usize, i64)>,
}

impl<'g> WrittenSteps<'g> {
    /// Writes the steps that some are made of.
    fn of(graph: &'g Graph, inputs: &[Formula], places: &[usize]) -> Result<Self, FormulaError> {
        let reached = graph.reached_from(places);
        let powers = (0..graph.len()).map(|place| (place, 1)).collect();
        let mut own = Self { graph, all: vec![None; graph.len()], powers };
        for (place, step) in graph.steps_at(&reached) {
            if let Step::Binary(BinaryOperation::Mul, a, b) = step
                && own.powers[a].0 == own.powers[b].0
            {
                own.powers[place] = (own.powers[a].0, own.powers[a].1 + own.powers[b].1);
            }
            let made = own.made(place, step, inputs)?;
            own.all[place] = made.filter(|own| own.text().len() <= LONGEST);
        }
        Ok(own)
    }

    fn made(
        &self,
        place: usize,
        step: Step<'_>,
        inputs: &[Formula],
    ) -> Result<Option<Formula>, FormulaError> {
        let of = |place: usize| self.all[place].as_ref();
        let raised = |place: usize, exponent: &Rational| {
            of(place).map(|base| power(base, exponent)).transpose()
        };
        match step {
            Step::Constant(value) => Ok(Some(Formula::number(value.clone()))),
            Step::Input(input) => Ok(Some(inputs[input].clone())),
            Step::Unary(UnaryFunction::Neg, a) => Ok(of(a).map(|a| -a)),
            Step::Unary(UnaryFunction::Recip, a) => {
                of(a).map(|a| &Formula::number(1) / a).transpose()
            }
            Step::Unary(UnaryFunction::Sqrt, a) => raised(a, &Rational::new(1, 2)),
            Step::Power(a, exponent) => raised(a, exponent),
            Step::Binary(..) if self.powers[place].0 != place => {
                let (base, exponent) = self.powers[place];
                raised(base, &Rational::from(exponent))
            }
            Step::Binary(operation, a, b) => match (of(a), of(b)) {
                (Some(a), Some(b)) => joined(operation, a, b).transpose(),
                _ => Ok(None),
            },
            Step::Unary(..) => Ok(None),
        }
    }

    /// Divides all steps up to one by an input, where they are seen to be divisible and can be written.
    fn quotients(&self, place: usize, input: usize) -> Result<Vec<Option<Quotient>>, FormulaError> {
        let reached = self.graph.reached_from(&[place]);
        let mut all: Vec<Option<Quotient>> = vec![None; place + 1];
        for own in (0..=place).filter(|own| reached[*own]) {
            let made = match self.graph.step(own) {
                Step::Constant(value) if value.is_zero() => Some(Quotient::Zero),
                Step::Input(own) if own == input => Some(Quotient::Other(Formula::number(1))),
                Step::Unary(UnaryFunction::Neg, a) => all[a].as_ref().map(Quotient::negative),
                Step::Power(a, exponent) => self.of_power(&all, a, exponent.to_integer())?,
                Step::Binary(..) if self.powers[own].0 != own => {
                    let (base, exponent) = self.powers[own];
                    self.of_power(&all, base, Some(exponent))?
                }
                Step::Binary(operation, a, b) => match (operation, &all[a], &all[b]) {
                    (BinaryOperation::Mul, Some(own), _) => self.times(own, b)?,
                    (BinaryOperation::Mul, None, Some(own)) => self.times(own, a)?,
                    (BinaryOperation::Add, Some(Quotient::Zero), Some(own)) => Some(own.clone()),
                    (BinaryOperation::Sub, Some(Quotient::Zero), Some(own)) => Some(own.negative()),
                    (_, Some(own), Some(Quotient::Zero)) => Some(own.clone()),
                    (_, Some(Quotient::Other(a)), Some(Quotient::Other(b))) => {
                        joined(operation, a, b).transpose()?.map(Quotient::Other)
                    }
                    _ => None,
                },
                Step::Constant(_) | Step::Input(_) | Step::Unary(..) => None,
            };
            all[own] = made.filter(|own| match own {
                Quotient::Zero => true,
                Quotient::Other(own) => own.text().len() <= LONGEST,
            });
        }
        Ok(all)
    }

    fn times(&self, own: &Quotient, place: usize) -> Result<Option<Quotient>, FormulaError> {
        match (own, &self.all[place]) {
            (Quotient::Zero, _) => Ok(Some(Quotient::Zero)),
            (Quotient::Other(own), Some(other)) => Ok(Some(Quotient::Other(product(own, other)?))),
            (Quotient::Other(_), None) => Ok(None),
        }
    }

    fn of_power(
        &self,
        all: &[Option<Quotient>],
        base: usize,
        exponent: Option<i64>,
    ) -> Result<Option<Quotient>, FormulaError> {
        match (&all[base], exponent, &self.all[base]) {
            (Some(Quotient::Zero), Some(1..), _) => Ok(Some(Quotient::Zero)),
            (Some(Quotient::Other(own)), Some(whole @ 1..), Some(base)) => {
                let rest = power(base, &Rational::from(whole - 1))?;
                Ok(Some(Quotient::Other(product(own, &rest)?)))
            }
            _ => Ok(None),
        }
    }
}

impl Quotient {
    fn negative(&self) -> Self {
        match self {
            Quotient::Zero => Quotient::Zero,
            Quotient::Other(own) => Quotient::Other(-own),
        }
    }
}

/// Writes an operation; `None` for one that is not rational.
fn joined(operation: BinaryOperation, a: &Formula, b: &Formula) -> Option<FormulaResult> {
    match operation {
        BinaryOperation::Add => Some(a + b),
        BinaryOperation::Sub => Some(a - b),
        BinaryOperation::Mul => Some(product(a, b)),
        BinaryOperation::Pow => None,
    }
}

fn power(base: &Formula, exponent: &Rational) -> FormulaResult {
    match exponent.to_integer() {
        Some(0) => Ok(Formula::number(1)),
        Some(1) => Ok(base.clone()),
        Some(own @ 2..=3) => base.raised(own as i32),
        _ => base.power(&Formula::number(exponent.clone())),
    }
}
