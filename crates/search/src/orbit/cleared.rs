//! Darboux polynomials of fields that are fractions: those of the field times its denominator.
//!
//! With a polynomial D for which Dv is a polynomial field, f = 0 is invariant under v if and only if f
//! divides Dv(f), where f has no factor in common with D: then v(f) = (K/D) f with a polynomial K.

use liouville::case::Case;
use liouville::formula::{Formula, Type};
use liouville::graph::{Graph, Step};
use liouville::mechanics::System;
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};

use super::super::origin::TheoremOrigin;
use super::super::terms::recorded;
use super::super::{Effort, Excluded, FoundKind, Given, SearchError, SearchReport};
use super::adjoin::{RingPolynomial, polynomial_text};
use super::angle::ConjugatePair;
use super::claims::{self, OrbitStatement};
use super::darboux::DarbouxSearch;
use super::exponents::ExponentSystem;
use super::factor::RatedPolynomial;
use super::known::IndependentIntegrals;
use super::line::RandomLine;
use super::part::{DARBOUX_FAMILY, MOST_DARBOUX_DEGREE};
use super::setting::OrbitSetting;
use super::{blocks, degree_of_field, fractions, monomials, no_others};

/// Largest degree of the denominator.
const MOST_DEGREE: u32 = 12;
/// Largest number of coefficients of a cofactor.
const MOST_COFACTOR: usize = 300;

/// Degrees of fields with whose cofactors those of fractions are compared.
const SHORT: [usize; 2] = [1, 2];

/// A field times its denominator.
struct ClearedField {
    case: Case,
    /// Denominator D.
    denominator: Formula,
    /// Factors of D that vary with the state, as they are written in the field, with their degrees.
    factors: Vec<(Formula, u32)>,
}

/// Searches a field of fractions for Darboux polynomials, and for what follows from them.
pub fn search(
    setting: &OrbitSetting<'_>,
    most_steps: f64,
    known: &mut IndependentIntegrals,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let (case, effort) = (setting.case, setting.effort);
    let Some(cleared) = ClearedField::of(case)? else { return Ok(()) };
    let Ok(polynomial) = OrbitSetting::of(&cleared.case, effort)? else { return Ok(()) };
    let Some(degree) = degree_of_field(&polynomial)? else { return Ok(()) };
    let (mut factors, mut pairs) = (Vec::new(), Vec::new());
    let mut own = SearchReport::default();
    let mut highest = 0;
    // Without the others, the factors of the denominator are left.
    let cofactor = monomials::count(setting.dimension(), degree.saturating_sub(1) as u32);
    let sets = match cofactor <= MOST_COFACTOR {
        true => blocks::closed(&cleared.case)?,
        false => Vec::new(),
    };
    for variables in sets {
        let search = DarbouxSearch { setting: &polynomial, variables: &variables, degree };
        highest = 0;
        while highest < MOST_DARBOUX_DEGREE
            && monomials::steps(variables.len(), highest + 1, degree) <= most_steps
        {
            highest += 1;
            progress(&format!("Darboux polynomials of degree {highest}"));
            search.of_degree(highest, &mut factors, &mut pairs, &mut own)?;
        }
    }
    cleared.tell(setting, &own, report)?;
    let mut rated = Vec::new();
    let curves = factors.iter().map(|own| (&own.formula, own.degree));
    for (formula, degree) in
        curves.chain(cleared.factors.iter().map(|(own, degree)| (own, *degree)))
    {
        if rated.iter().all(|own: &RatedPolynomial| own.formula.text() != formula.text()) {
            rated.extend(RatedPolynomial::of(setting, formula, degree)?);
        }
    }
    let all: Vec<usize> = (0..setting.dimension()).collect();
    ExponentSystem::of(setting, &all, &rated, &[])?.search(known, report)?;
    let pairs: Result<Vec<_>, _> = pairs.iter().map(|pair| pair.along(setting)).collect();
    let pairs: Vec<ConjugatePair> = pairs?.into_iter().flatten().collect();
    let system = ExponentSystem::of(setting, &all, &rated, &pairs)?;
    if !pairs.is_empty() {
        system.search(known, report)?;
    }
    system.search_with_fractions(known, report)?;
    let curves: Vec<Formula> = factors.into_iter().map(|own| own.formula).collect();
    cleared.conclude(&curves, (1..=highest).rev(), (effort, most_steps), setting, report)
}

impl ClearedField {
    /// Multiplies a field by its denominator; `None` if it has none, or is not rational.
    fn of(case: &Case) -> Result<Option<Self>, SearchError> {
        let model = &case.model;
        let (graph, rates) = recorded(case, |jet| jet.phase.field().to_vec())?;
        if graph.inputs() > model.free_components() + model.dimension() {
            return Ok(None);
        }
        let places: Vec<usize> = rates.iter().map(|rate| graph.place(*rate)).collect();
        let Some(rates) = fractions_of(&graph, &places) else { return Ok(None) };
        let mut below: Below = Vec::new();
        rates.iter().for_each(|own| below = joined(&below, &own.below));
        let degrees = below.iter().map(|(base, power)| power.saturating_mul(degree(base)));
        let total = degrees.fold(0, u32::saturating_add);
        if total > MOST_DEGREE {
            return Ok(None);
        }
        let names = input_names(case);
        let formula = |own: &RingPolynomial| case.formula(&polynomial_text(own, &names)).ok();
        let cleared: Option<Vec<Formula>> =
            rates.iter().map(|own| formula(&own.over(&below)?)).collect();
        let denominator = product(&below).and_then(|own| formula(&own));
        let first = model.free_components();
        let varies =
            |(base, _): &&(RingPolynomial, u32)| base.variables().iter().any(|k| *k >= first);
        let factors: Option<Vec<(Formula, u32)>> = below
            .iter()
            .filter(varies)
            .map(|(base, _)| Some((formula(base)?, degree(base))))
            .collect();
        let (Some(cleared), Some(denominator), Some(factors)) = (cleared, denominator, factors)
        else {
            return Ok(None);
        };
        if factors.is_empty() {
            return Ok(None);
        }
        let mut rest = cleared.iter().cloned();
        let mut field = Vec::new();
        for variable in &model.state {
            let parts: Vec<Formula> = rest.by_ref().take(variable.len()).collect();
            field.push(match (variable.kind, &parts[..]) {
                (Type::Scalar, [only]) => only.clone(),
                (kind, parts) => kind.filled(parts)?,
            });
        }
        let mut case = case.clone();
        case.claims.clear();
        case.absences.clear();
        case.motions.clear();
        case.model.system = System::Field(field);
        Ok(Some(Self { case, denominator, factors }))
    }

    /// Judges the Darboux polynomials as claims about the field itself.
    fn tell(
        &self,
        setting: &OrbitSetting<'_>,
        own: &SearchReport,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let Some(at) = setting.split(0, 0) else { return Ok(()) };
        let Some(line) = RandomLine::draw(setting, &at, 0) else { return Ok(()) };
        let mut poles = Vec::new();
        for (formula, degree) in &self.factors {
            poles.extend(RatedPolynomial::of(setting, formula, *degree)?);
        }
        for found in &own.found {
            // Where D is 0 the field has a pole, and nothing is invariant.
            let rated = match found.function() {
                Some(function) => RatedPolynomial::of(setting, function, MOST_DARBOUX_DEGREE)?,
                None => None,
            };
            match rated {
                Some(rated) if line.has_more(&rated, &poles)? => {}
                _ => continue,
            }
            let (Some(function), Some(cofactor)) = (found.function(), found.cofactor()) else {
                continue;
            };
            let cofactor = match polynomial_cofactor(setting, function)? {
                Some(cofactor) => cofactor,
                None => (cofactor / &self.denominator)?,
            };
            let rate = (&cofactor * function)?;
            let statement = OrbitStatement::Rate { function: function.clone(), rate };
            let with = Some(Given::Cofactor(cofactor.clone()));
            claims::other(
                setting,
                FoundKind::DarbouxPolynomial,
                function,
                &statement,
                with,
                report,
            )?;
        }
        Ok(())
    }

    /// States that these are all, up to the highest degree for which this is shown.
    fn conclude(
        &self,
        known: &[Formula],
        degrees: impl Iterator<Item = u32>,
        (effort, most_steps): (&Effort, f64),
        setting: &OrbitSetting<'_>,
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let Ok(shown) = no_others::shown(&self.case, effort, known, degrees, most_steps)? else {
            return Ok(());
        };
        let names: Vec<String> = setting.terms.iter().map(ToString::to_string).collect();
        let statement = no_others::statement(&names.join(", "), shown.degree, known);
        let poles = &self.factors;
        let statement = no_others::explained(setting, statement, known, poles, report)?;
        let statement = format!("for the field times {}, {statement}", self.denominator);
        report.excluded.retain(|own| own.origin != TheoremOrigin::Darboux);
        report.excluded.push(Excluded {
            ansatz: format!("{DARBOUX_FAMILY} {}", shown.degree),
            dimension: known.len(),
            known: known.len(),
            error_log2: Some(shown.error_log2),
            theorem: fractions::sentence(setting.case, &statement),
            origin: TheoremOrigin::Darboux,
            values: None,
        });
        Ok(())
    }
}

/// Factors of the denominators of a field of fractions that vary with the state, with their degrees.
pub fn denominators(case: &Case) -> Result<Vec<(Formula, u32)>, SearchError> {
    Ok(ClearedField::of(case)?.map(|own| own.factors).unwrap_or_default())
}

/// Names of the inputs of a recording: components of the free parameters, and of the state.
pub fn input_names(case: &Case) -> Vec<String> {
    [case.model.parameter_names(), case.model.state_names()].concat()
}

/// The cofactor along the field itself, where it is a polynomial of low degree.
fn polynomial_cofactor(
    setting: &OrbitSetting<'_>,
    function: &Formula,
) -> Result<Option<Formula>, SearchError> {
    let all: Vec<usize> = (0..setting.dimension()).collect();
    let Some(rated) = RatedPolynomial::of(setting, function, 1)? else { return Ok(None) };
    for degree in SHORT {
        if let Some(cofactor) = rated.cofactor(setting, &all, degree)? {
            return Ok(Some(cofactor));
        }
    }
    Ok(None)
}

/// A denominator by its factors and their powers.
type Below = Vec<(RingPolynomial, u32)>;

/// A fraction of polynomials.
#[derive(Clone)]
struct Fraction {
    above: RingPolynomial,
    below: Below,
}

impl Fraction {
    fn of(above: RingPolynomial) -> Self {
        Self { above, below: Vec::new() }
    }

    /// The numerator over a multiple of the denominator.
    fn over(&self, below: &Below) -> Option<RingPolynomial> {
        let mut above = self.above.clone();
        for (base, power) in below {
            let own = self.below.iter().find(|(own, _)| own == base).map_or(0, |(_, own)| *own);
            above = above.times(&base.raised(power.checked_sub(own)?)?)?;
        }
        Some(above)
    }

    fn plus(&self, other: &Self, sign: i64) -> Option<Self> {
        let below = joined(&self.below, &other.below);
        let above = self.over(&below)?.plus(&other.over(&below)?, &Rational::from(sign))?;
        Some(Self { above, below })
    }

    fn times(&self, other: &Self) -> Option<Self> {
        let mut below = self.below.clone();
        for (base, power) in &other.below {
            match below.iter_mut().find(|(own, _)| own == base) {
                Some((_, own)) => *own = own.checked_add(*power)?,
                None => below.push((base.clone(), *power)),
            }
        }
        Some(Self { above: self.above.times(&other.above)?, below })
    }

    fn raised(&self, power: u32) -> Option<Self> {
        if power == 0 {
            return Some(Self::of(number(1)));
        }
        let below =
            self.below.iter().map(|(base, own)| Some((base.clone(), own.checked_mul(power)?)));
        Some(Self { above: self.above.raised(power)?, below: below.collect::<Option<_>>()? })
    }
}

fn number(value: i64) -> RingPolynomial {
    RingPolynomial::constant(Rational::from(value))
}

/// Least common multiple of two denominators.
fn joined(a: &Below, b: &Below) -> Below {
    let mut all = a.clone();
    for (base, power) in b {
        match all.iter_mut().find(|(own, _)| own == base) {
            Some((_, own)) => *own = (*own).max(*power),
            None => all.push((base.clone(), *power)),
        }
    }
    all
}

fn product(below: &Below) -> Option<RingPolynomial> {
    below.iter().try_fold(number(1), |made, (base, power)| made.times(&base.raised(*power)?))
}

fn degree(own: &RingPolynomial) -> u32 {
    let of = |powers: &[(usize, u32)]| {
        powers.iter().fold(0, |sum: u32, (_, power)| sum.saturating_add(*power))
    };
    own.terms().map(|(a, _)| of(a)).max().unwrap_or(0)
}

/// Reads steps of a recording as fractions; `None` if one is none.
fn fractions_of(graph: &Graph, places: &[usize]) -> Option<Vec<Fraction>> {
    let reached = graph.reached_from(places);
    let mut values: Vec<Option<Fraction>> = vec![None; graph.len()];
    for (place, step) in graph.steps_at(&reached) {
        let of = |place: usize| values[place].as_ref();
        let made = match step {
            Step::Constant(value) => Fraction::of(RingPolynomial::constant(value.clone())),
            Step::Input(input) => Fraction::of(RingPolynomial::variable(input, 1)),
            Step::Unary(UnaryFunction::Neg, a) => of(a)?.times(&Fraction::of(number(-1)))?,
            Step::Unary(UnaryFunction::Recip, a) => inverse(graph, &values, a)?,
            Step::Unary(..) => return None,
            Step::Binary(operation, a, b) => match operation {
                BinaryOperation::Add => of(a)?.plus(of(b)?, 1)?,
                BinaryOperation::Sub => of(a)?.plus(of(b)?, -1)?,
                BinaryOperation::Mul => of(a)?.times(of(b)?)?,
                BinaryOperation::Pow => return None,
            },
            Step::Power(a, exponent) => {
                let power = exponent.to_integer()?;
                let base = if power < 0 { inverse(graph, &values, a)? } else { of(a)?.clone() };
                base.raised(u32::try_from(power.unsigned_abs()).ok()?)?
            }
        };
        values[place] = Some(made);
    }
    places.iter().map(|place| values[*place].clone()).collect()
}

/// The inverse of a step, factor by factor: a product that is written out has lost its factors.
fn inverse(graph: &Graph, values: &[Option<Fraction>], place: usize) -> Option<Fraction> {
    match graph.step(place) {
        Step::Unary(UnaryFunction::Neg, a) => {
            inverse(graph, values, a)?.times(&Fraction::of(number(-1)))
        }
        Step::Binary(BinaryOperation::Mul, a, b) => {
            inverse(graph, values, a)?.times(&inverse(graph, values, b)?)
        }
        Step::Power(a, exponent) if !exponent.is_negative() => {
            inverse(graph, values, a)?.raised(u32::try_from(exponent.to_integer()?).ok()?)
        }
        _ => {
            let own = values[place].as_ref()?;
            let (value, monomial, rest) = own.above.split()?;
            let above = product(&own.below)?.times_number(&value.recip()?);
            let mut below: Below = monomial
                .into_iter()
                .map(|(variable, power)| (RingPolynomial::variable(variable, 1), power))
                .collect();
            if rest.value().is_none() {
                below.push((rest, 1));
            }
            Some(Fraction { above, below })
        }
    }
}
