//! Maps of finite order, Φⁿ = id: each sum Σ f∘Φᵏ over k = 0, …, n − 1 is an integral.

use num_integer::Integer;

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError};
use liouville::mechanics::{Meaning, System};
use liouville::verdict::Verdict;

use super::super::ask::judged;
use super::super::{FoundKind, SearchError, SearchReport};
use super::setting::OrbitSetting;
use super::{claims, map_weighted};

/// Largest order that is looked for.
const MOST_ORDER: usize = 12;
/// Number of points that must return, each with parameters of its own.
const POINTS: u64 = 3;
/// Longest formula of an iterate, in bytes.
const LONGEST: usize = 20_000;
/// Longest formula of a sum that is reported.
const LONGEST_SUM: usize = 1000;
/// Largest number of functions whose sums are tried.
const MOST_SUMS: usize = 60;

/// Notes the order of a map that has one, proved or observed, and reports sums over its orbits that are
/// independent integrals.
pub fn finite_order(
    setting: &OrbitSetting<'_>,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let Some(order) = observed(setting)? else { return Ok(()) };
    let iterates = iterates(setting.case, order).unwrap_or_default();
    let is_proved = returns(setting, order, &iterates)?;
    // Integrals over a density are shorter than sums over orbits.
    map_weighted::search(setting, setting.dimension(), report)?;
    let what = match order {
        1 => "the map is the identity".to_string(),
        _ => format!("the map has order {order}: Φ^{order} = id"),
    };
    if !is_proved {
        report.remark(format!("{what} at random points modulo a prime; this is not proved"));
        return Ok(());
    }
    report.remark(format!("{what}, proved; the sum of any function over an orbit is an integral"));
    sums(setting, &iterates[..order], report)
}

/// Smallest n with Φⁿ = id at some points modulo a prime, for all listed values of the parameters.
fn observed(setting: &OrbitSetting<'_>) -> Result<Option<usize>, SearchError> {
    let mut order = None;
    for number in 0..POINTS {
        let Some(at) = setting.at(0, number) else { return Ok(None) };
        let Some(all) = setting.with_listed(&at) else { return Ok(None) };
        let mut own = 1;
        for at in all {
            setting.effort.halt.check()?;
            let Some((_, orbit)) = setting.orbit(&at, number, MOST_ORDER + 1)? else {
                return Ok(None);
            };
            let is_back = |n: &usize| orbit.iter().all(|own| own.get(*n) == own.first());
            let Some(one) = (1..=MOST_ORDER).find(is_back) else { return Ok(None) };
            own = own.lcm(&one);
        }
        if own > MOST_ORDER || (number > 0 && Some(own) != order) {
            return Ok(None);
        }
        order = Some(own);
    }
    Ok(order)
}

/// The iterates Φ⁰, …, Φⁿ, variable by variable; `None` if they cannot be written, or are long.
fn iterates(case: &Case, order: usize) -> Option<Vec<Vec<Formula>>> {
    let System::Map(images) = &case.model.system else { return None };
    let places = Places::of(case)?;
    let mut all = vec![places.variables.clone()];
    for _ in 0..order {
        let last = all.last()?;
        let next: Option<Vec<Formula>> =
            images.iter().map(|image| places.at(image, last)).collect();
        all.push(next?);
    }
    Some(all)
}

/// The state's variables, with other names that stand for them while formulas are put in their place.
struct Places {
    case: Case,
    variables: Vec<Formula>,
    others: Vec<Formula>,
}

impl Places {
    fn of(case: &Case) -> Option<Self> {
        let mut named = case.clone();
        let (mut variables, mut others) = (Vec::new(), Vec::new());
        for (k, own) in case.model.state_variables().into_iter().enumerate() {
            let name = format!("otherplace{k}");
            named.define(&name, &own).ok()?;
            others.push(named.formula(&name).ok()?);
            variables.push(own);
        }
        Some(Self { case: case.clone(), variables, others })
    }

    /// Writes f at a point; `None` if f has abbreviations, or if the result is long.
    fn at(&self, f: &Formula, point: &[Formula]) -> Option<Formula> {
        let vocabulary = &self.case.model.vocabulary;
        let is_plain =
            |symbol| !matches!(vocabulary.entry(symbol).meaning, Meaning::Abbreviation(_));
        let put = || -> Result<Formula, FormulaError> {
            let mut made = f.clone();
            for (own, other) in self.variables.iter().zip(&self.others) {
                made = made.substitute(own.text(), other)?;
            }
            for (other, value) in self.others.iter().zip(point) {
                made = made.substitute(other.text(), value)?;
            }
            Ok(made)
        };
        if !f.symbols().all(is_plain) {
            return None;
        }
        let made = put().ok().filter(|made| made.text().len() <= LONGEST)?;
        self.case.formula(made.text()).ok()
    }
}

/// Whether the last iterate is proved to be the identity.
fn returns(
    setting: &OrbitSetting<'_>,
    order: usize,
    iterates: &[Vec<Formula>],
) -> Result<bool, SearchError> {
    let (Some(first), Some(last)) = (iterates.first(), iterates.get(order)) else {
        return Ok(false);
    };
    let claims: Vec<Claim> =
        last.iter().zip(first).map(|(there, here)| Claim::identity(there, here)).collect();
    let reports = judged(setting.case, &claims, setting.effort)?;
    Ok(reports.iter().all(|report| report.verdict == Verdict::Proved))
}

/// Reports the sums of components of the state, their products and cubes, over an orbit.
fn sums(
    setting: &OrbitSetting<'_>,
    iterates: &[Vec<Formula>],
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    let case = setting.case;
    let Some(places) = Places::of(case) else { return Ok(()) };
    let most = case.model.dimension().saturating_sub(case.model.level.len());
    let components = &setting.terms;
    let mut functions = components.clone();
    for (k, own) in components.iter().enumerate() {
        functions.push(own.raised(2)?);
        for other in &components[k + 1..] {
            functions.push((own * other)?);
        }
    }
    for own in components {
        functions.push(own.raised(3)?);
    }
    for function in functions.iter().take(MOST_SUMS) {
        setting.effort.halt.check()?;
        if report.functions(FoundKind::Integral).count() >= most {
            break;
        }
        let own: Option<Vec<Formula>> =
            iterates.iter().map(|point| places.at(function, point)).collect();
        let Some(own) = own else { continue };
        let length: usize = own.iter().map(|term| term.text().len()).sum();
        let Some((first, others)) = own.split_first().filter(|_| length <= LONGEST_SUM) else {
            continue;
        };
        let sum = others.iter().try_fold(first.clone(), |sum, next| &sum + next)?;
        claims::integral(setting, &sum, report)?;
    }
    Ok(())
}
