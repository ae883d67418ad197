//! Judgement of the finds along orbits. All claims of this folder are made here.

use liouville::claim::Claim;
use liouville::formula::Formula;
use liouville::verdict::{ClaimReport, Verdict};

use super::super::ask::judged_alone;
use super::super::integrals::tell;
use super::super::{Found, FoundKind, Given, SearchError, SearchReport};
use super::adjoin;
use super::setting::OrbitSetting;
use liouville::case::Case;

/// A statement about the case.
#[derive(Clone, Debug)]
pub enum OrbitStatement {
    /// L_vF = 0.
    Integral(Formula),
    /// ρ is the density of an invariant measure.
    Density(Formula),
    /// L_vF = G.
    Rate {
        /// Function F.
        function: Formula,
        /// Its rate G.
        rate: Formula,
    },
}

impl OrbitStatement {
    fn claim(&self) -> Claim {
        match self {
            OrbitStatement::Integral(formula) => Claim::integral(formula),
            OrbitStatement::Density(formula) => Claim::density(formula),
            OrbitStatement::Rate { function, rate } => Claim::rate(function, rate),
        }
    }

    fn mapped(&self, map: impl Fn(&Formula) -> Option<Formula>) -> Option<Self> {
        Some(match self {
            OrbitStatement::Integral(formula) => OrbitStatement::Integral(map(formula)?),
            OrbitStatement::Density(formula) => OrbitStatement::Density(map(formula)?),
            OrbitStatement::Rate { function, rate } => {
                OrbitStatement::Rate { function: map(function)?, rate: map(rate)? }
            }
        })
    }
}

/// Case about which finds are claims.
pub fn judged_case<'c>(setting: &OrbitSetting<'c>) -> &'c Case {
    setting.origin.map_or(setting.case, |origin| origin.case)
}

/// Writes a formula in the names of the case that is judged; `None` if it is too long or too deep for
/// the reader of formulas.
pub fn written(setting: &OrbitSetting<'_>, formula: &Formula) -> Option<Formula> {
    match setting.origin {
        None => setting.case.formula(formula.text()).ok().map(|_| formula.clone()),
        Some(origin) => origin.case.formula(&origin.extension.back(formula)).ok(),
    }
}

/// Writes an integral, up to a factor, in the names of the case that is judged.
pub fn written_integral(setting: &OrbitSetting<'_>, formula: &Formula) -> Option<Formula> {
    match setting.origin {
        None => match adjoin::with_signs(formula.text()) {
            Some(text) => setting.case.formula(&text).ok(),
            None => written(setting, formula),
        },
        Some(origin) => origin.case.formula(&origin.extension.back_integral(formula)).ok(),
    }
}

/// Judges a statement; returns the report of one that is proved.
pub fn proved(
    setting: &OrbitSetting<'_>,
    statement: &OrbitStatement,
) -> Result<Option<ClaimReport>, SearchError> {
    let Some(statement) = statement.mapped(|formula| written(setting, formula)) else {
        return Ok(None);
    };
    judged_here(setting, &statement)
}

/// Judges a statement in the names of the case that is judged.
pub fn judged_here(
    setting: &OrbitSetting<'_>,
    statement: &OrbitStatement,
) -> Result<Option<ClaimReport>, SearchError> {
    let report = judged_alone(judged_case(setting), statement.claim(), setting.effort)?;
    Ok(report.filter(|report| report.verdict == Verdict::Proved))
}

/// Adds an integral to the report if it is proved, and independent of those there; returns whether
/// it was added.
pub fn integral(
    setting: &OrbitSetting<'_>,
    formula: &Formula,
    report: &mut SearchReport,
) -> Result<bool, SearchError> {
    let Some(formula) = written_integral(setting, formula) else { return Ok(false) };
    let statement = OrbitStatement::Integral(formula.clone());
    let Some(found) = judged_here(setting, &statement)? else { return Ok(false) };
    let before = report.found.len();
    tell(judged_case(setting), &formula, found, setting.effort, report)?;
    Ok(report.found.len() > before)
}

/// Adds the integral ρP, with a density ρ in the names of the case that is judged, to the report if it
/// is proved; returns whether it was added.
pub fn weighted_integral(
    setting: &OrbitSetting<'_>,
    density: &Formula,
    polynomial: &Formula,
    report: &mut SearchReport,
) -> Result<bool, SearchError> {
    let Some(polynomial) = written(setting, polynomial) else { return Ok(false) };
    let formula = (density * &polynomial.bracketed())?;
    let statement = OrbitStatement::Integral(formula.clone());
    let Some(found) = judged_here(setting, &statement)? else { return Ok(false) };
    let before = report.found.len();
    tell(judged_case(setting), &formula, found, setting.effort, report)?;
    Ok(report.found.len() > before)
}

/// Adds a function of constant rate to the report if it is proved.
pub fn rate(
    setting: &OrbitSetting<'_>,
    function: &Formula,
    rate: &Formula,
    report: &mut SearchReport,
) -> Result<bool, SearchError> {
    let statement = OrbitStatement::Rate { function: function.clone(), rate: rate.clone() };
    let with = Some(Given::Rate(rate.clone()));
    other(setting, FoundKind::ConstantRate, function, &statement, with, report)
}

/// Adds another find to the report if it is proved.
pub fn other(
    setting: &OrbitSetting<'_>,
    kind: FoundKind,
    formula: &Formula,
    statement: &OrbitStatement,
    with: Option<Given>,
    report: &mut SearchReport,
) -> Result<bool, SearchError> {
    let Some(found) = proved(setting, statement)? else { return Ok(false) };
    let Some(formula) = written(setting, formula) else { return Ok(false) };
    let with = with.and_then(|own| own.mapped(|formula| written(setting, formula)));
    let found = Found::new(kind, &formula, None, found, &judged_case(setting).model);
    if report.has(kind, found.text()) {
        return Ok(true);
    }
    report.found.push(Found { with: with.into_iter().collect(), ..found });
    Ok(true)
}
