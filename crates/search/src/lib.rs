//! Search for invariants that the case does not state: counted, found and proved, or excluded by a
//! theorem.
//!
//! ```text
//! count      number of integrals polynomial in the velocities there are, with any coefficients
//! integrals  relations between L_vT for terms T that the system offers, at random points mod p
//! momenta    those linear in the velocities, with any coefficients; functions of constant rate
//! lower      integrals of lower degree in place of others
//! cyclic     sines and cosines of cyclic angles
//! densities  relations between div v and L_v ln f for factors f; powers of polynomials, counted
//! verdict    each find is judged as a claim like any other
//! orbit      relations between monomials along an orbit mod p: rational integrals of any field
//! closure    brackets of integrals, and their derivatives along symmetry fields
//! absence    claims that there is no other invariant: proved by counts, refuted by a find
//! ```

mod absence;
mod ansatz;
mod ask;
mod branches;
mod budget;
mod complete;
mod conditions;
mod continued;
mod counts;
mod cyclic;
mod densities;
mod echelon;
mod effort;
mod error;
mod expansion;
mod found;
mod halt;
mod hypotheses;
mod integrals;
mod irrational;
mod jet_equations;
mod jets;
mod leading;
mod library;
mod linear;
mod lists;
mod local;
mod lower;
mod lowest;
mod maps;
mod measures;
mod meter;
mod momenta;
mod multipliers;
mod orbit;
mod origin;
mod products;
mod rates;
mod recognised;
mod reduced;
mod repeated;
mod report;
mod room;
mod second_opinion;
mod series;
mod streams;
pub mod survey;
mod symbols;
mod symmetries;
mod tensors;
mod terms;
mod vectors;
mod written;

use liouville::case::Case;

pub use absence::{complete, judge};
pub use ansatz::{Ansatz, Hamiltonians};
pub use conditions::{ConditionTarget, ParameterCondition};
pub use counts::{CountEstimate, CountReport, plan};
pub use effort::{Effort, FurtherTerm};
pub use error::SearchError;
pub use found::{Found, FoundFormula, FoundKind, Given};
pub use halt::Halt;
pub use meter::Meter;
pub use multipliers::MultiplierReport;
pub use orbit::OrbitReport;
pub use origin::{ConditionOrigin, Remark, RemarkOrigin, TheoremOrigin};
pub use report::{Excluded, SearchReport};
pub use second_opinion::SecondOpinion;

/// Searches a case for integrals, densities and symmetries; a map for integrals and a density.
///
/// `progress` is called with a description of the next part and its size. A search that is stopped
/// reports the results reached so far, and the parts not reached.
pub fn search(
    case: &Case,
    effort: &Effort,
    progress: &mut dyn FnMut(&str),
) -> Result<SearchReport, SearchError> {
    let mut report = SearchReport::default();
    let moving = lists::with_motion(case);
    let case = moving.as_ref().map_or(case, |(own, _)| own);
    if let Some((_, remark)) = &moving {
        report.remark(remark.clone());
    }
    let case = &abbreviated(case)?;
    report.claimed = ask::claimed(case, effort)?;
    if case.model.system.is_map() {
        report.stage("components that the map keeps", effort, |report| {
            maps::kept(case, effort, report)
        })?;
        report.stage("relations along an orbit", effort, |report| {
            let grows = effort.halt.is_timed();
            let mut run = |case: &Case,
                           effort: &Effort,
                           report: &mut SearchReport,
                           progress: &mut dyn FnMut(&str)| {
                orbit::search_map(case, effort, grows, report, progress)
            };
            match grows {
                true => run(case, effort, report, progress),
                false => lists::orbits_by_values(case, effort, report, progress, &mut run),
            }
        })?;
        report.stage("the density 1", effort, |report| maps::volume(case, effort, report))?;
        report.stage("shorter formulas", effort, |report| {
            recognised::rewrite(case, effort, report)?;
            measures::prefer(case, effort, report)?;
            written::shorten(case, effort, report)
        })?;
        maps::note_fields_only(effort, &mut report);
        return Ok(report);
    }
    // Integrals of degree 1 come first: those of degree 2 may be functions of them.
    report.stage("products of factors", effort, |report| {
        progress("factors of densities");
        densities::densities(case, effort, report)
    })?;
    report.stage("integrals among the terms", effort, |report| {
        progress("terms of integrals");
        integrals::integrals(case, effort, report)
    })?;
    report.stage("linear symmetry fields", effort, |report| {
        progress("linear symmetry fields");
        symmetries::symmetries(case, effort, report)
    })?;
    // What takes longest comes last: of a search that is stopped the rest is reported.
    report.stage("the number of integrals", effort, |report| {
        counts::count(case, counts::Degrees::Each, effort, report, progress)
    })?;
    report.stage("a global ansatz", effort, |report| {
        ansatz::search(case, effort, report, progress)
    })?;
    counts::conclude(case, effort, &mut report)?;
    report.stage("densities that depend on the velocities", effort, |report| {
        multipliers::multipliers(case, effort, report, progress)
    })?;
    if let Some(wanted) = &effort.conditions {
        report.stage("conditions on the parameters", effort, |report| {
            conditions::conditions(case, wanted, effort, report, progress)
        })?;
    }
    branches::withdraw(case, effort, &mut report)?;
    // All kinds of finds come before degrees grow until the time is spent.
    let ungrown = report.clone();
    lists::orbits_by_values(
        case,
        effort,
        &mut report,
        progress,
        &mut |case, effort, report, progress| along_orbits(case, effort, false, report, progress),
    )?;
    if effort.conditions == Some(ConditionTarget::Existence) {
        report.stage("conditions for the density 1", effort, |report| {
            conditions::volumes(case, effort, report, progress)
        })?;
    }
    report.stage("forces that integrals survive", effort, |report| {
        ansatz::forces(case, effort, report, progress)
    })?;
    if let Some(wanted) = &effort.poisson {
        report.stage("brackets", effort, |report| {
            lists::by_values(
                case,
                effort,
                report,
                progress,
                &mut |case, effort, report, progress| {
                    ansatz::brackets(case, wanted, effort, report, progress)
                },
            )
        })?;
    }
    if effort.conditions == Some(ConditionTarget::Existence) {
        report.stage("values of parameters", effort, |report| {
            conditions::by_values::conditions(case, effort, report, progress)
        })?;
    }
    let unwritten = report.found.clone();
    report.stage("shorter formulas", effort, |report| {
        recognised::rewrite(case, effort, report)?;
        vectors::gather(case, effort, report)?;
        leading::write_without_minus(case, effort, report)?;
        measures::prefer(case, effort, report)?;
        written::shorten(case, effort, report)?;
        repeated::remove(case, effort, report)
    })?;
    if effort.halt.is_timed() {
        report.stage("relations of higher degree along an orbit", effort, |report| {
            let mut grown = ungrown;
            along_orbits(case, effort, true, &mut grown, progress)?;
            report.grow(grown, &unwritten);
            effort.halt.check()
        })?;
    }
    report::note_generic_functions(case, &mut report);
    if !report.orbits.is_empty() {
        // The search along orbits has these as well.
        report.remarks.retain(|remark| remark.origin != RemarkOrigin::Irrational);
    }
    // Those of single values are written as well.
    let is_of_values = |own: &Found| {
        own.kind == FoundKind::Integral && own.with.iter().any(|own| matches!(own, Given::Value(_)))
    };
    if absence::has_lists(case) && report.found.iter().any(is_of_values) {
        report.remarks.retain(|remark| remark.origin != RemarkOrigin::Lists);
    }
    for remark in std::mem::take(&mut report.without_points) {
        report.remark(remark);
    }
    Ok(report)
}

/// Searches along orbits, and for brackets of what is found.
fn along_orbits(
    case: &Case,
    effort: &Effort,
    grows: bool,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    // Theorems on orbits hold for both signs of each root, and are about fields without moduli.
    let known: Vec<String> = report.formulas(FoundKind::Integral).map(str::to_string).collect();
    report.stage("relations along an orbit", effort, |report| {
        orbit::search(case, effort, grows, report, progress)
    })?;
    report.stage("sines and exponentials of cyclic coordinates", effort, |report| {
        orbit::harmonics(case, effort, report, progress)
    })?;
    report.stage("brackets of integrals", effort, |report| {
        progress("brackets and derivatives of integrals");
        orbit::close(case, effort, report)
    })?;
    report.stage("functions of constant rate", effort, |report| {
        momenta::rates(case, effort, report)?;
        repeated::remove(case, effort, report)
    })?;
    let is_further = |own: &Found| own.kind == FoundKind::FurtherIntegral;
    let is_same = report.formulas(FoundKind::Integral).eq(known.iter().map(String::as_str));
    if !is_same || report.found.iter().any(is_further) {
        counts::conclude(case, effort, report)?;
    }
    if let Some(effort) = cyclic::with_circles(case, effort, report)? {
        report.stage("sines and cosines of cyclic angles", &effort, |report| {
            orbit::search(case, &effort, false, report, progress)?;
            orbit::close(case, &effort, report)?;
            repeated::remove(case, &effort, report)
        })?;
        counts::conclude(case, &effort, report)?;
    }
    Ok(())
}

/// Extends the case by the names that the library's terms use.
fn abbreviated(case: &Case) -> Result<Case, SearchError> {
    let mut named = case.clone();
    named.motions.clear();
    named.absences.clear();
    for (name, text) in library::abbreviations(&case.model) {
        let formula = named.formula(text)?;
        named.define(name, &formula)?;
    }
    Ok(named)
}
