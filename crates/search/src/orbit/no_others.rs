//! Theorem that all Darboux polynomials up to a degree are known.
//!
//! The zeros of a Darboux polynomial on a random line are common roots of all determinants of the
//! Taylor coefficients of the monomials there (`line`). If, without the zeros of the known
//! polynomials, there are none modulo some random primes, there are no others.
//! docs/soundness.md, "Darboux polynomials".

use liouville::case::Case;
use liouville::formula::{Formula, Type};
use liouville::graph::record;
use liouville::mechanics::{Draw, Phase};
use liouville::proof::{PolynomialBounds, polynomial_bounds, statement_seed};
use liouville::verdict::Options;

use super::super::lists::HAS_LISTS;
use super::super::{Effort, FoundKind, SearchError, SearchReport};
use super::claims::{self, OrbitStatement};
use super::factor::RatedPolynomial;
use super::line::RandomLine;
use super::monomials;
use super::setting::OrbitSetting;

/// Log₂ of the error probability that a theorem may have.
const TARGET: f64 = -100.0;
/// Largest number of primes.
const PRIMES: u64 = 8;
/// Number of lines on which places of other Darboux polynomials are looked for at lower degrees.
const LINES: u64 = 4;
/// Log₂ of the number of primes between 2⁶⁰ and 2⁶¹ from which one is drawn, rounded down.
const POOL: f64 = 50.0;

/// The theorem for a degree.
pub struct NoOthers {
    /// Highest degree of the polynomials.
    pub degree: u32,
    /// Log₂ of its error probability.
    pub error_log2: f64,
    /// Number of monomials.
    pub monomials: usize,
    /// Number of primes.
    pub primes: u64,
}

/// States the theorem, beginning with a small letter.
pub fn statement(names: &str, degree: u32, known: &[Formula]) -> String {
    let class = format!(
        "Darboux polynomial of degree at most {degree} in {names}, with any complex coefficients,"
    );
    match known {
        [] => format!("there is no {class} other than constants"),
        known => {
            let known: Vec<&str> = known.iter().map(Formula::text).collect();
            format!(
                "every {class} is a constant times a product of factors of {}",
                known.join(", ")
            )
        }
    }
}

/// Says of the factors in a statement that are not told as Darboux polynomials what they are: integrals, or
/// factors of the denominator of the field.
pub fn explained(
    setting: &OrbitSetting<'_>,
    statement: String,
    known: &[Formula],
    denominators: &[(Formula, u32)],
    report: &SearchReport,
) -> Result<String, SearchError> {
    let is_told = |own: &Formula| report.has(FoundKind::DarbouxPolynomial, own.text());
    let (mut integrals, mut poles) = (Vec::new(), Vec::new());
    for own in known.iter().filter(|own| !is_told(own)) {
        let statement = OrbitStatement::Integral(own.clone());
        if denominators.iter().any(|(other, _)| other.text() == own.text()) {
            poles.push(own.text());
        } else if claims::proved(setting, &statement)?.is_some() {
            integrals.push(own.text());
        }
    }
    let clause = |all: &[&str], one: &str, several: &str| match all {
        [] => String::new(),
        [only] => format!("; {only} is {one}"),
        all => format!("; {} are {several}", all.join(" and ")),
    };
    let integrals = clause(&integrals, "an integral", "integrals");
    let poles = clause(&poles, "a factor of the denominator", "factors of the denominator");
    Ok(format!("{statement}{integrals}{poles}"))
}

/// Sizes of the field, and of the polynomials that are known.
struct Sizes {
    field: PolynomialBounds,
    known: Vec<PolynomialBounds>,
    /// Number of coordinates of the parameters, and of the state.
    inputs: (usize, usize),
    /// Seed from the formulas, so that none of them can be chosen to suit the primes.
    seed: u64,
}

impl Sizes {
    /// Bounds the field and the known polynomials; the text is the reason why that is impossible.
    fn of(
        case: &Case,
        known: &[Formula],
        options: &Options,
    ) -> Result<Result<Self, String>, SearchError> {
        let (model, dimension) = (&case.model, case.model.dimension());
        let draws = model.parameter_draws();
        let is_simple = |draw: &Draw| match draw {
            Draw::Within(_) | Draw::Of(..) => true,
            Draw::OneOf(values) => values.len() == 1,
            Draw::Sign => false,
        };
        if !model.system.is_field() || !model.level.is_empty() {
            return Ok(Err("the case is not a field without a level set".to_string()));
        }
        if !draws.iter().all(is_simple) {
            return Ok(Err(HAS_LISTS.to_string()));
        }
        let count = draws.len();
        let (graph, (rates, values)) = record(count + dimension, |inputs| {
            let (parameters, state) = model.make_parameters(inputs);
            let phase = Phase::new(model, &parameters, state);
            let values: Vec<_> = known.iter().map(|formula| phase.scalar(formula)).collect();
            (phase.field().to_vec(), values)
        })?;
        if graph.inputs() > count + dimension {
            return Ok(Err("the field contains ∫".to_string()));
        }
        let Some(field) = polynomial_bounds(&graph, &rates, count) else {
            let reason = "the field is not a polynomial in the state whose coefficients are rational \
                          in the parameters";
            return Ok(Err(reason.to_string()));
        };
        let mut bounds = Vec::new();
        for (formula, value) in known.iter().zip(&values) {
            let Some(own) = polynomial_bounds(&graph, &[*value], count) else {
                return Ok(Err(format!(
                    "`{formula}` is not a polynomial in the state whose coefficients are rational in \
                     the parameters"
                )));
            };
            bounds.push(own);
        }
        let seed = statement_seed(options.seed, &graph, &[rates, values].concat());
        Ok(Ok(Self { field, known: bounds, inputs: (count, dimension), seed }))
    }

    /// Sets the seed that belongs to the formulas.
    fn effort(&self, effort: &Effort) -> Effort {
        let options = Options { seed: self.seed, ..effort.options };
        Effort { options, ..effort.clone() }
    }

    /// Reads the known polynomials.
    fn factors(
        &self,
        setting: &OrbitSetting<'_>,
        known: &[Formula],
    ) -> Result<Vec<RatedPolynomial>, SearchError> {
        let mut factors = Vec::new();
        for (formula, bounds) in known.iter().zip(&self.known) {
            factors.extend(RatedPolynomial::of(setting, formula, bounds.degree as u32)?);
        }
        Ok(factors)
    }

    /// The theorem for a degree, or the reason why it is not shown.
    fn shown_for(
        &self,
        degree: u32,
        setting: &OrbitSetting<'_>,
        factors: &[RatedPolynomial],
        most_steps: f64,
    ) -> Result<Result<NoOthers, String>, SearchError> {
        match self.shown_by_lines(degree, setting, factors, most_steps) {
            Err(error @ SearchError::Series { .. }) => Ok(Err(error.to_string())),
            other => other,
        }
    }

    fn shown_by_lines(
        &self,
        degree: u32,
        setting: &OrbitSetting<'_>,
        factors: &[RatedPolynomial],
        most_steps: f64,
    ) -> Result<Result<NoOthers, String>, SearchError> {
        let none = |reason: &str| Ok(Err(reason.to_string()));
        let (field, dimension) = (self.field.degree as usize, setting.dimension());
        let monomials = monomials::count(dimension, degree);
        let each = self.error_log2(degree, monomials);
        let needed = (TARGET / each).ceil();
        if !(each < 0.0 && needed <= PRIMES as f64) {
            return none("the formulas have too large degrees");
        }
        if needed * monomials::steps(dimension, degree, field) > most_steps {
            return Ok(Err(format!(
                "degree {degree} has {monomials} unknowns: ask for a lower one"
            )));
        }
        let variables: Vec<usize> = (0..dimension).collect();
        // A place with a relation of a lower degree has one of this degree: that is seen sooner.
        for lower in 1..degree {
            let all = monomials::up_to(&variables, dimension, lower);
            if has_others(setting, &all, field, factors)? {
                return Ok(Err(may_be_others(degree)));
            }
        }
        let all = monomials::up_to(&variables, dimension, degree);
        let primes = needed as u64;
        for prime in 0..primes {
            let Some(at) = setting.at(prime, prime) else {
                return none("no orbit has a series modulo a prime");
            };
            let Some(line) = RandomLine::draw(setting, &at, prime) else {
                return none("no orbit has a series modulo a prime");
            };
            let special = line.special(&all, field, factors)?;
            if !special.is_full {
                return Ok(Err(format!(
                    "polynomials of degree {degree} are related along each orbit, as integrals make them"
                )));
            }
            if !special.is_whole || !special.all.is_empty() {
                return Ok(Err(may_be_others(degree)));
            }
        }
        Ok(Ok(NoOthers { degree, error_log2: each * needed, monomials, primes }))
    }

    /// Log₂ of the probability that one prime and one line hide a Darboux polynomial: that a number
    /// made of the determinant without the factors of known polynomials, its leading coefficient times
    /// its resultants with these, is 0 modulo the prime.
    fn error_log2(&self, degree: u32, count: usize) -> f64 {
        let (n, size) = (f64::from(degree), count as f64);
        let PolynomialBounds { degree: own, total, height } = self.field;
        let dimension = self.inputs.1 as f64;
        let coordinates = self.inputs.0 as f64 + 2.0 * dimension + 1.0;
        // One row: v^k x^a on the line, times a power of the coefficients' denominator.
        let (mut degrees, mut bits) = (0.0, size * size.log2());
        for order in 0..=count {
            let order = order as f64;
            let along = height + (dimension * (n + order * own)).log2();
            degrees += 2.0 * (n + order * total);
            bits += order * along + n + order * total;
        }
        // A factor of a polynomial has larger coefficients (Gelfond).
        bits += coordinates * degrees;
        let sum = |of: fn(&PolynomialBounds) -> f64| self.known.iter().map(of).sum::<f64>();
        let zeros = sum(|own| own.degree);
        let resultant_degree = degrees * (1.0 + zeros + 2.0 * sum(|own| own.total));
        let resultant_bits = bits * (1.0 + zeros)
            + degrees * sum(|own| own.height + own.total)
            + (degrees + zeros) * (degrees + zeros).log2();
        let unlucky_prime = (resultant_bits / 60.0).log2() - POOL;
        let unlucky_line = resultant_degree.log2() - 60.0;
        unlucky_prime.max(unlucky_line) + 1.0
    }
}

/// Reason why nothing is shown where a line has special places besides those of the known polynomials.
fn may_be_others(degree: u32) -> String {
    format!("there may be other Darboux polynomials of degree {degree} or less")
}

/// Whether some orbit that starts on no known polynomial satisfies a relation between these monomials,
/// and others do not.
fn has_others(
    setting: &OrbitSetting<'_>,
    all: &[Vec<u32>],
    field: usize,
    factors: &[RatedPolynomial],
) -> Result<bool, SearchError> {
    for number in 0..LINES {
        let Some(at) = setting.at(number, number) else { return Ok(false) };
        let Some(line) = RandomLine::draw(setting, &at, number) else { return Ok(false) };
        let special = line.special(all, field, factors)?;
        if !special.all.is_empty() || special.is_whole || !special.is_full {
            return Ok(special.is_full && !special.all.is_empty());
        }
        // The places lie in an extension of the field.
    }
    Ok(false)
}

/// Shows that each irreducible Darboux polynomial of at most a degree, with complex coefficients,
/// divides one of the known polynomials, for generic parameters, within a number of steps; the first
/// of the degrees for which that succeeds counts. The text is the reason why it does for none.
pub fn shown(
    case: &Case,
    effort: &Effort,
    known: &[Formula],
    degrees: impl IntoIterator<Item = u32>,
    most_steps: f64,
) -> Result<Result<NoOthers, String>, SearchError> {
    let none = |reason: &str| Ok(Err(reason.to_string()));
    if known.iter().any(|formula| formula.value_type() != Type::Scalar) {
        return none("only scalar invariant relations are compared");
    }
    let sizes = match Sizes::of(case, known, &effort.options)? {
        Ok(sizes) => sizes,
        Err(reason) => return Ok(Err(reason)),
    };
    let effort = sizes.effort(effort);
    let setting = match OrbitSetting::of(case, &effort)? {
        Ok(setting) => setting,
        Err(reason) => return Ok(Err(reason)),
    };
    if !setting.flow.is_rational {
        return none("the field contains roots of the parameters");
    }
    let factors = sizes.factors(&setting, known)?;
    let mut outcome = Err("no degree is asked for".to_string());
    for degree in degrees {
        outcome = sizes.shown_for(degree, &setting, &factors, most_steps)?;
        if outcome.is_ok() {
            break;
        }
    }
    Ok(outcome)
}

/// Whether a function is a polynomial of at most a degree with a factor that no known one has.
pub fn is_other(
    case: &Case,
    effort: &Effort,
    function: &Formula,
    known: &[Formula],
    degree: u32,
) -> Result<bool, SearchError> {
    let all: Vec<Formula> = known.iter().chain([function]).cloned().collect();
    let Ok(sizes) = Sizes::of(case, &all, &effort.options)? else { return Ok(false) };
    if sizes.known.last().is_none_or(|own| own.degree > f64::from(degree)) {
        return Ok(false);
    }
    let effort = sizes.effort(effort);
    let Ok(setting) = OrbitSetting::of(case, &effort)? else { return Ok(false) };
    let factors = sizes.factors(&setting, &all)?;
    let Some(at) = setting.at(0, 0) else { return Ok(false) };
    match (RandomLine::draw(&setting, &at, 0), factors.split_last()) {
        (Some(line), Some((own, others))) => line.has_more(own, others),
        _ => Ok(false),
    }
}
