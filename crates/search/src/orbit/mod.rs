//! Search for any field, and any map, by orbits modulo a prime.
//!
//! ```text
//! taylor       series of orbits, and points of the orbits of maps
//! setting, draws   points, orbits, and the relations between monomials along them
//! relations    number of algebraic integrals; none is a theorem
//! tangents     directions of the state itself, where its functions are variables
//! polynomials  polynomial integrals
//! lattice      exponents that a field does not mix
//! leading      parts of highest degree that no polynomial integral has
//! graded, turned, sparse   polynomial integrals of higher degree, class by class; bases with few terms
//! rational     rational ones, as P and Q of the relations P − c Q
//! line, determinants   points of a line whose orbits satisfy an additional relation
//! conic, level_shape  conics in place of lines, where functions satisfy relations, and on spheres
//! harmonics, harmonic_rows, phase   integrals with sines and exponentials of cyclic coordinates
//! darboux, shared, cofactors  Darboux polynomials: the relations at these points, and of several lines; proofs modulo p
//! separable    integrals in one coordinate, its momentum and known integrals
//! separate     those whose coefficients depend on the parameters, one by one
//! cleared      Darboux polynomials of fields of fractions
//! unbound      Darboux polynomials with functions
//! own_factors, angle  variables that divide their own rates; angles between conjugate factors
//! no_others    theorem that the Darboux polynomials found are all
//! map          search of a map
//! finite_order   maps with Φⁿ = id, and sums over their orbits
//! map_densities, map_integrals  densities and polynomial integrals of maps
//! map_fractions, map_products, map_weighted  densities of maps that are fractions, or products; integrals over these
//! logarithms   integrals of maps by monomials
//! exponents, driven, product_densities  densities, and integrals with powers, logarithms and exponentials, from cofactors
//! quotients    fractions over powers of factors in these exponents
//! squares, magnitude  polynomials in the parameters, and their roots; f or |f| under a logarithm
//! weighted     integrals of fields in the plane that are multiples of a density
//! adjoin       functions of the state as further variables
//! explicit, subfield   all of these for solved Lagrangian systems, for rates without functions
//! rounds, part   all of these in the variables of each part of a field, within growing limits
//! closure      brackets of integrals, and their derivatives along symmetry fields
//! claims       judgement of each find as a claim like any other
//! fractions    for claims of absence: relations that known integrals do not explain
//! ```
//!
//! The degree grows as the number of monomials allows, and further while there is time.

mod adjoin;
mod angle;
mod blocks;
mod claims;
mod cleared;
mod closure;
mod cofactors;
mod conic;
mod darboux;
mod determinants;
mod draws;
mod driven;
mod explicit;
mod exponents;
mod factor;
mod finite_order;
mod fraction;
pub mod fractions;
mod graded;
mod harmonic_rows;
mod harmonics;
mod images;
mod known;
mod lattice;
mod leading;
mod level_shape;
mod limits;
mod line;
mod logarithms;
mod magnitude;
mod map;
mod map_densities;
mod map_fractions;
mod map_integrals;
mod map_products;
mod map_rows;
mod map_weighted;
pub mod monomials;
pub mod no_others;
mod own_factors;
mod part;
mod phase;
mod polynomials;
mod primes;
mod product_densities;
mod products;
mod quotients;
mod rational;
mod relations;
mod remarks;
mod report;
mod rounds;
mod separable;
mod separate;
mod setting;
mod shared;
mod sparse;
mod squares;
mod subfield;
mod tangents;
mod taylor;
mod turned;
mod unbound;
mod weighted;

use liouville::case::Case;
use liouville::formula::Formula;
use liouville::mechanics::System;
use liouville::verdict::Verdict;

pub use self::adjoin::{joined_terms, merged, parsed, root_steps, roots, signed_terms};
pub use self::closure::close;
pub use self::harmonics::search as harmonics;
pub use self::images::coefficients;
use self::known::{IndependentIntegrals, has_told_all};
use self::limits::{EXTENDED, FURTHER, MODEST, RoundLimits};
use self::line::degree_of_field;
pub use self::map::search as search_map;
use self::part::VariableSet;
pub use self::report::OrbitReport;
use self::setting::OrbitSetting;
pub use self::sparse::sparse as with_few_entries;
use super::ask::proved_given;
use super::{Effort, FoundKind, SearchError, SearchReport, branches};

/// Largest number of roots whose signs at all states are compared with those modulo a prime.
const FEW_ROOTS: usize = 4;

/// Number of the further limits with functions as variables, before the field is searched without them.
const WITH_FUNCTIONS: usize = 2;

/// Searches a field for integrals; proved ones go into the report. If `further`, the limits grow while
/// there is time.
pub fn search(
    case: &Case,
    effort: &Effort,
    further: bool,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    counted(case, effort, report, |report| along(case, effort, further, report, progress))
}

/// Runs a search along orbits. If a root of the case depends on others, it has the wrong sign at half of
/// the points modulo a prime: then nothing is counted.
fn counted(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    run: impl FnOnce(&mut SearchReport) -> Result<(), SearchError>,
) -> Result<(), SearchError> {
    let before = report.orbits.len();
    let outcome = run(report);
    if report.orbits.len() > before && !has_true_roots(case, effort)? {
        report.orbits.truncate(before);
        report.remark(
            "relations along orbits are not counted: it is not known that the signs of the roots in the \
             formulas do not matter; where there is a modulus or a root that depends on others, write √(4*x) \
             as 2*√x, √(x*y) as √x*√y, √(x²) as x where x > 0"
                .to_string(),
        );
    }
    outcome
}

/// Whether the signs of roots modulo a prime do not matter, or are those at all states.
fn has_true_roots(case: &Case, effort: &Effort) -> Result<bool, SearchError> {
    let roots = adjoin::root_steps(case)?;
    Ok(roots == 0
        || adjoin::has_independent_roots(case, effort, roots)?
        || (roots <= FEW_ROOTS && branches::are_true(case, effort)?))
}

fn along(
    case: &Case,
    effort: &Effort,
    further: bool,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let is_field = case.model.system.is_field();
    if !is_field && !matches!(case.model.system, System::Lagrangian(_) | System::Ball(_)) {
        return Ok(());
    }
    let mut divided = Vec::new();
    let mut is_extended = false;
    let is_done = |report: &SearchReport| has_told_all(case, report);
    let before = report.orbits.len();
    // At last with half of each angle.
    for _ in 0..2 {
        let scope = FunctionScope { divided, before, next: &[] };
        let whole = report.orbits[before..].to_vec();
        let Some(halves) = with_functions(case, effort, scope, report, progress)? else { break };
        // What whole angles show is reported unless their halves show more.
        if integrals(&report.orbits[before..]) <= integrals(&whole) && !whole.is_empty() {
            report.orbits.truncate(before);
            report.orbits.extend(whole);
        }
        is_extended = true;
        divided = halves;
        if is_done(report) || divided.is_empty() {
            break;
        }
    }
    if !is_field && (!is_extended || is_constrained(case)) && !is_done(report) {
        explicit::search(case, effort, further && !is_extended, report, progress)?;
    }
    if !is_field && !is_extended {
        return Ok(());
    }
    if is_extended && !is_done(report) {
        subfield::search(case, effort, further, report, progress)?;
    }
    if is_extended {
        let known = found(case, effort, report)?;
        fractions::conclude(case, effort, &known, true, report)?;
    }
    if is_done(report) && is_extended {
        return Ok(());
    }
    let plain = match is_field {
        true => OrbitSetting::of(case, effort)?,
        false => Err(String::new()),
    };
    match plain {
        Ok(setting) => {
            if is_extended && further {
                let (before, next) = (report.orbits.len(), &FURTHER[..WITH_FUNCTIONS]);
                let scope = FunctionScope { divided: Vec::new(), before, next };
                with_functions(case, effort, scope, report, progress)?;
                let known = found(case, effort, report)?;
                fractions::conclude(case, effort, &known, true, report)?;
            }
            report.orbits.truncate(before);
            along_orbits(&setting, further_limits(further), report, progress)
        }
        Err(reason) if is_field && !is_extended => {
            report.remark(format!("no relations along orbits: {reason}"));
            Ok(())
        }
        Err(_) if is_extended && further => {
            let scope = FunctionScope { divided: Vec::new(), before, next: &FURTHER };
            with_functions(case, effort, scope, report, progress).map(|_| ())
        }
        Err(_) => Ok(()),
    }
}

/// Largest number of algebraic integrals in reports on orbits.
fn integrals(orbits: &[OrbitReport]) -> usize {
    orbits.iter().map(|own| own.integrals).max().unwrap_or(0)
}

/// Whether a case is a Lagrangian system whose velocities are not those of its coordinates.
fn is_constrained(case: &Case) -> bool {
    match &case.model.system {
        System::Lagrangian(own) => !own.constraints.is_empty() || own.has_carried(),
        _ => false,
    }
}

/// Limits that follow the first ones: none, unless the time of a search is limited.
fn further_limits(further: bool) -> &'static [RoundLimits] {
    if further { &FURTHER } else { &[] }
}

/// Scope of a search with functions of the state as further variables.
struct FunctionScope<'l> {
    /// Arguments that are divided.
    divided: Vec<adjoin::Divided>,
    /// Number of reports on orbits that are kept.
    before: usize,
    /// Limits after the first ones.
    next: &'l [RoundLimits],
}

/// Searches with functions of the state as further variables, within growing limits; returns half of
/// each angle. `None` if there are no functions that can be adjoined.
fn with_functions(
    case: &Case,
    effort: &Effort,
    scope: FunctionScope<'_>,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<Option<Vec<adjoin::Divided>>, SearchError> {
    let known = found(case, effort, report)?;
    let curves = report.found.iter().filter(|own| own.kind == FoundKind::DarbouxPolynomial);
    let curves: Vec<Formula> = curves.filter_map(|own| own.function().cloned()).collect();
    let made = adjoin::extended(case, effort, &known, &curves, scope.divided)?;
    let Some(extension) = made else {
        return Ok(None);
    };
    let Ok(setting) = OrbitSetting::extended(case, &extension, effort)? else { return Ok(None) };
    report.without_points.clear();
    report.orbits.truncate(scope.before);
    along_orbits(&setting, scope.next, report, progress)?;
    Ok(Some(extension.halves()))
}

/// Lists the denominators, radicands and other factors of the functions in a field and in `further`,
/// in the names of the case.
pub fn factors(
    case: &Case,
    effort: &Effort,
    further: &[Formula],
) -> Result<Vec<Formula>, SearchError> {
    if !case.model.system.is_field() {
        return Ok(Vec::new());
    }
    let Some(extension) = adjoin::extended(case, effort, further, &[], Vec::new())? else {
        return Ok(Vec::new());
    };
    let own = extension.factors.iter().map(|factor| case.formula(&extension.back(factor)));
    Ok(own.flatten().collect())
}

/// Lists the given functions and the integrals found so far, as far as they are proved to be integrals.
fn found(case: &Case, effort: &Effort, report: &SearchReport) -> Result<Vec<Formula>, SearchError> {
    let given = proved_given(case, effort)?.into_iter();
    let own = report.of_case(FoundKind::Integral).filter(|found| found.verdict == Verdict::Proved);
    Ok(given.chain(own.filter_map(|found| found.function().cloned())).collect())
}

/// Searches the parts of a field, within growing limits: at last those in `next`.
fn along_orbits(
    setting: &OrbitSetting<'_>,
    next: &[RoundLimits],
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let before = report.orbits.len();
    let mut known = IndependentIntegrals::of(setting, report)?;
    separable::search(setting, &mut known, report)?;
    let has_line = setting.has_lines();
    let degree = if has_line { degree_of_field(setting)? } else { None };
    let part = |variables| VariableSet::new(variables, degree);
    let mut parts: Vec<VariableSet> = blocks::closed(setting.case)?.into_iter().map(part).collect();
    let limits = if setting.origin.is_some() { EXTENDED } else { MODEST };
    let mut outcome =
        rounds::search(setting, &mut parts, (limits, next), &mut known, report, progress);
    let is_plain = setting.origin.is_none() && !setting.is_on_level();
    if has_line && degree.is_none() && is_plain && outcome.is_ok() {
        outcome = cleared::search(setting, limits.steps, &mut known, report, progress)
            .and_then(|()| own_factors::search(setting, &mut known, report));
    }
    if let Some(whole) = parts.last() {
        whole.conclude(setting, report)?;
    }
    let counted = report.orbits.len() > before && setting.has_lists();
    let integrals = report.orbits.last().map_or(0, |own| own.integrals);
    let is_open = counted && integrals > found(setting.case, setting.effort, report)?.len();
    remarks::note(setting, counted, is_open, report);
    match outcome {
        Err(error) if error.is_of_count() => {
            let what = match error {
                SearchError::Series { .. } => "no further Darboux polynomials",
                _ => "no relations along orbits",
            };
            let is_map = setting.case.model.system.is_map();
            report.remark(match error {
                SearchError::NoSeries if is_map => format!(
                    "{what}: no orbit of the map modulo a prime was found: it contains functions, or roots \
                     that few points have all"
                ),
                error => format!("{what}: {error}"),
            });
            Ok(())
        }
        other => other,
    }
}
