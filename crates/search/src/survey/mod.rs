//! Survey of a system's invariants: all known formulas are tried on the geometry, and those that
//! hold are proved.
//!
//! ```text
//! geometry     facts about the body, each a claim that is judged: it is a ball, I₁ = I₂, …
//! family       formulas that make sense under such facts; files of data
//! question     claims of a family about the case, in the names of the case
//! involutions  signed permutations of the axes, as symmetries and reversors
//! sphere       the density, or the criterion, over the sphere of normals
//! hamiltonian  the conformally Hamiltonian form that a density gives
//! unknown      further invariants that the search finds and excludes
//! by_value     the same for single listed values of parameters
//! integrable   integrals in involution, as many as Liouville's theorem needs
//! hierarchy    classification: integral and measure, integral only, measure only, neither
//! ```

mod axis;
mod by_value;
mod data;
mod definitions;
mod description;
mod drawn_states;
mod exchanges;
mod family;
mod fixed_sets;
mod geometry;
mod hamiltonian;
mod hierarchy;
mod independence;
mod integrable;
mod involutions;
mod mirrors;
mod question;
mod shown;
mod sign_changes;
mod signed_permutation;
mod sorted;
mod sphere;
mod system_line;
mod unknown;
mod wireframe;
mod words;

#[cfg(test)]
mod tests;

use serde::Serialize;

use liouville::case::{Case, CaseRemark, Expect};
use liouville::claim::{Claim, NoDensityNear, Statement};
use liouville::formula::Formula;
use liouville::mechanics::{Chart, Draw, NumberLine, System, TIME};
use liouville::number::rational::Rational;
use liouville::verdict::{JudgeError, Options, Verdict, judge};
use liouville_flow::observe::evidence_against_density;

pub use by_value::ValuePlace;
pub use definitions::Definition;
pub use description::Description;
pub use geometry::GeometryFact;
pub use hierarchy::{HierarchyClass, HierarchyPlace, Integrals, MeasureStatus};
pub use independence::IntegralCount;
pub use integrable::LiouvilleProof;
pub use question::{FixedSet, TestedClaim};
pub use shown::Shown;
pub use sphere::SphereMap;
pub use system_line::SystemLine;
pub use unknown::{SearchOutcome, of_search};
pub use wireframe::Wireframe;
pub use words::GivenParameter;

use crate::Halt;
use geometry::Geometry;
use hierarchy::KnownFeatures;
use question::SurveyQuestion;
use sorted::{Sorted, measure};

/// All known invariants of a system, with proofs.
#[derive(Clone, Debug, Serialize)]
pub struct Survey {
    /// Title of the case.
    pub title: String,
    /// Kind of system.
    pub system: String,
    /// Seed of all states, primes and points.
    pub seed: u64,
    /// Description of the system in one sentence.
    pub sentence: String,
    /// Functions, ranges and equations of motion.
    pub description: Description,
    /// Parameters; proofs cover all values of the free ones.
    pub parameters: Vec<GivenParameter>,
    /// Surface of the body with the parameters of the first state, for a picture.
    #[serde(skip)]
    pub wireframe: Option<Wireframe>,
    /// Notes of the case.
    pub notes: Vec<String>,
    /// Facts about the geometry, true and false.
    pub facts: Vec<GeometryFact>,
    /// Place in the hierarchy.
    pub hierarchy: HierarchyPlace,
    /// Its places for single listed values of parameters, if there are lists, of few combinations.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub by_value: Vec<ValuePlace>,
    /// Integrals common to all such systems, and the energy.
    pub general: Vec<TestedClaim>,
    /// Criterion for a density of the configuration.
    pub criterion: Vec<TestedClaim>,
    /// Densities that hold.
    pub densities: Vec<TestedClaim>,
    /// Map of ln ρ, or of the criterion, on the sphere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sphere: Option<SphereMap>,
    /// Integrals other than the general ones, each independent of those before it.
    pub integrals: Vec<TestedClaim>,
    /// Integrals that depend on these and have simple formulas.
    pub dependent: Vec<TestedClaim>,
    /// Invariants that hold for single listed values of parameters.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub for_values: Vec<TestedClaim>,
    /// Rates from which further integrals follow by a linear equation.
    pub rates: Vec<TestedClaim>,
    /// Count for the theorem of Euler and Jacobi.
    pub independence: IntegralCount,
    /// Integrals in involution, if they are as many as the theorem of Liouville needs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub liouville: Option<LiouvilleProof>,
    /// Darboux polynomials, whose zeros are invariant surfaces.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub surfaces: Vec<TestedClaim>,
    /// Functions of constant rate.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub drifts: Vec<TestedClaim>,
    /// Symmetry fields.
    pub fields: Vec<TestedClaim>,
    /// Reversors, with the dimensions of their fixed sets.
    pub reversors: Vec<TestedClaim>,
    /// Maps among which reversors are sought, in words.
    #[serde(skip)]
    pub maps_tried: &'static str,
    /// Discrete symmetries.
    pub symmetries: Vec<TestedClaim>,
    /// Conformally Hamiltonian form, if there is a density in closed form and no rotor.
    pub hamiltonian: Vec<TestedClaim>,
    /// Claims and questions of the case.
    pub claimed: Vec<TestedClaim>,
    /// Known invariants of such systems that fail for this one.
    pub fails: Vec<TestedClaim>,
    /// Claims that could not be decided.
    pub undecided: Vec<TestedClaim>,
    /// Results of the search beyond the families.
    pub search: SearchOutcome,
    /// Physical impossibilities of the states drawn.
    pub warnings: Vec<String>,
    /// Remarks on what the file says.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<String>,
}

/// Tries all known formulas on a case; `progress` is called with a description of the next part, whose
/// share that is done is told by the meter of `halt`.
pub fn survey(
    case: &Case,
    options: &Options,
    halt: &Halt,
    progress: &mut dyn FnMut(&str),
) -> Result<Survey, JudgeError> {
    if case.model.system.is_map() {
        return Err(JudgeError::Discrete);
    }
    by_value::of_each(case, &mut |own, values| {
        let of_one = |part: &str| match values {
            Some(values) => format!("{part}, for {values}"),
            None => part.to_string(),
        };
        of_all_values(own, options, halt, &mut |part| progress(&of_one(part)))
    })
}

/// Surveys what holds for all values of the parameters, listed ones among them.
fn of_all_values(
    case: &Case,
    options: &Options,
    halt: &Halt,
    progress: &mut dyn FnMut(&str),
) -> Result<Survey, JudgeError> {
    progress("claims of the case");
    let own = crate::absence::judge(case, options)?;
    let notes = notes(case, own.motions_left);
    let claimed: Vec<TestedClaim> = own
        .claims
        .into_iter()
        .map(|claim| {
            let is_expected = claim.expect == Expect::Fails && claim.verdict == Verdict::Refuted;
            let mut own = TestedClaim::claimed(case, claim);
            if is_expected {
                let words = own.remark.into_iter().chain(["as the file expects".to_string()]);
                own.remark = Some(words.collect::<Vec<_>>().join("; "));
            }
            own
        })
        .collect();
    progress("the geometry");
    let geometry = Geometry::of(case, options)?;
    let (mut all, implied) = tried(case, options, &geometry, halt, progress)?;
    all.extend(claimed.iter().filter(|one| one.is("integral") || one.is("density")).cloned());
    progress("symmetries and reversors");
    let (reversors, symmetries) = involutions::find(case, options)?
        .into_iter()
        .partition::<Vec<TestedClaim>, _>(|found| found.is("reversor"));
    progress("further integrals");
    let mut search = SearchOutcome::of(case, options, halt, progress);
    let (for_values, found) =
        std::mem::take(&mut search.tested).into_iter().partition(|one| one.values.is_some());
    all.extend::<Vec<TestedClaim>>(found);
    progress("classification");
    let mut sorted = Sorted::of(all);
    let (jumping, counted) =
        std::mem::take(&mut sorted.integrals).into_iter().partition(TestedClaim::jumps);
    sorted.integrals = counted;
    let candidates: Vec<&TestedClaim> = sorted.integrals.iter().collect();
    let independent =
        independence::count(case, options, &geometry.bindings, &candidates, &implied)?;
    let liouville =
        integrable::proof(case, options, &geometry.bindings, &candidates, &independent)?;
    let (mut integrals, mut dependent) = (Vec::new(), Vec::new());
    for (index, tested) in std::mem::take(&mut sorted.integrals).into_iter().enumerate() {
        match (tested.is_general, independent.kept.contains(&index)) {
            (true, _) => sorted.general.push(tested),
            (false, true) => integrals.push(tested),
            (false, false) if tested.is_of_family() => dependent.push(tested),
            // Further integrals of the case or the search are functions of those reported.
            (false, false) => {}
        }
    }
    // The densities of the case and of the search are reported if no family has one.
    let from_family = sorted.densities.iter().any(|one| one.is_measure() && one.is_of_family());
    sorted.densities.retain(|one| !from_family || one.is_of_family());
    sorted.densities.retain(|one| !unknown::is_claimed_density(case, options, &one.claim));
    let measure = match measure(case, &sorted) {
        MeasureStatus::NotKnown if changes_volumes_at_zero(case, options) => {
            MeasureStatus::ExcludedAtRest
        }
        known => known,
    };
    let hamiltonian = match sorted.densities.iter().find(|one| one.is_measure()) {
        Some(density) => hamiltonian::form(case, options, &geometry.bindings, density)?,
        None => Vec::new(),
    };
    let (found, needed) = (independent.count.independent.len(), independent.count.needed);
    let none = integrals.is_empty() && implied.is_empty();
    let standing = match (none, search.excluded_to()) {
        (false, _) if independent.everywhere >= needed => Integrals::Enough,
        (false, _) if found >= needed => Integrals::EnoughOnAPart,
        (false, _) => Integrals::Some,
        (true, Some(degree)) => Integrals::ExcludedToDegree(degree),
        (true, None) => Integrals::NotKnown,
    };
    integrals.extend::<Vec<TestedClaim>>(jumping);
    let sphere = match measure {
        MeasureStatus::ClosedForm | MeasureStatus::ByQuadrature => sphere::density(case, options)?,
        MeasureStatus::Excluded
        | MeasureStatus::ExcludedAtRotation
        | MeasureStatus::ExcludedForConfiguration => sphere::criterion(case, options)?,
        MeasureStatus::ExcludedAtRest
        | MeasureStatus::Singular
        | MeasureStatus::WithTime
        | MeasureStatus::NotKnown => None,
    };
    let model = &case.model;
    let is_autonomous = model.state.iter().all(|variable| variable.name != TIME);
    let dimension = (independent.has_energy && is_autonomous)
        .then(|| model.dimension().checked_sub(model.level.len() + 1))
        .flatten();
    let features = KnownFeatures {
        reversors: reversors.len(),
        has_energy: independent.has_energy,
        dimension,
        has_free: model.free_components() > 0,
    };
    let mut hierarchy = HierarchyPlace::of(measure, standing, features);
    if is_autonomous {
        hierarchy.refine(liouville.as_ref(), independent.everywhere, independent.count.dimension);
    }
    if !matches!(measure, MeasureStatus::ClosedForm | MeasureStatus::ByQuadrature) {
        progress("closed orbits");
        hierarchy.grounds.extend(evidence_against_density(case, options));
    }
    // A report lists the claims that hold itself.
    let remarks = case.remarks.iter().filter(|own| **own != CaseRemark::NoClaims);
    let remarks = remarks.map(ToString::to_string).collect();
    Ok(Survey {
        title: case.title.clone(),
        system: case.system.clone(),
        seed: options.seed,
        sentence: words::sentence(case, &geometry.facts),
        description: Description::of(case),
        parameters: words::parameters(case),
        wireframe: wireframe::of(case, options)?,
        notes,
        facts: geometry.facts,
        hierarchy,
        by_value: Vec::new(),
        general: sorted.general,
        criterion: sorted.criterion,
        densities: sorted.densities,
        sphere,
        integrals,
        dependent,
        for_values,
        rates: sorted.rates,
        independence: independent.count,
        liouville,
        surfaces: sorted.surfaces,
        drifts: sorted.drifts,
        fields: sorted.fields,
        reversors,
        maps_tried: exchanges::tried(case),
        symmetries,
        hamiltonian,
        claimed,
        fails: sorted.fails,
        undecided: sorted.undecided,
        search,
        warnings: own.warnings,
        remarks,
    })
}

/// Notes of the case, and one on its claims about motion, which are not judged here.
fn notes(case: &Case, motions_left: usize) -> Vec<String> {
    let left = match motions_left {
        0 => None,
        1 => Some("1 claim about motion is".to_string()),
        more => Some(format!("{more} claims about motion are")),
    };
    let left = left.map(|own| format!("{own} judged by `liouville check --motion` alone"));
    case.notes.iter().cloned().chain(left).collect()
}

/// Whether 0 is proved to be an equilibrium of a field at which no density is continuous and positive.
fn changes_volumes_at_zero(case: &Case, options: &Options) -> bool {
    let is_inside = |draw: &Draw| match draw {
        Draw::Within(range) => {
            let zero = Rational::from(0);
            range.low < zero && zero < range.high
        }
        Draw::Of(NumberLine::All, _) => true,
        _ => false,
    };
    let is_field = matches!(case.model.system, System::Field(_))
        && matches!(case.chart, Chart::Free)
        && case.free_draws.iter().all(is_inside);
    let at_zero = Claim::of(NoDensityNear::NAME, Vec::<(String, Formula)>::new());
    let judged = case.with_claims(&[at_zero]).ok().filter(|_| is_field);
    let judged = judged.and_then(|asked| judge(&asked, options).ok());
    judged.is_some_and(|own| own.claims.iter().all(|own| own.verdict == Verdict::Proved))
}

/// Judges the claims of all families that apply; returns them with the integrals that follow
/// without a formula.
fn tried(
    case: &Case,
    options: &Options,
    geometry: &Geometry,
    halt: &Halt,
    progress: &mut dyn FnMut(&str),
) -> Result<(Vec<TestedClaim>, Vec<String>), JudgeError> {
    let (mut all, mut implied) = (Vec::new(), Vec::new());
    let families = family::all();
    let count = families.len();
    progress("known formulas");
    for (place, family) in families.into_iter().enumerate() {
        halt.meter().set(place, count);
        let axes: Vec<Option<&axis::RevolutionAxis>> = match family.around {
            true => geometry.axes.iter().map(Some).collect(),
            false => vec![None],
        };
        for axis in axes {
            if !family.applies(&case.system, |fact| geometry.has_about(fact, axis)) {
                continue;
            }
            let family = axis.map_or(family.clone(), |axis| family.with(&axis.words()));
            let question = SurveyQuestion::of(&family, &geometry.bindings);
            let found = question.ask(case, options)?.unwrap_or_default();
            if !found.is_empty() && found.iter().all(TestedClaim::holds) {
                implied.extend(family.gives);
            }
            all.extend(found);
        }
    }
    Ok((all, implied))
}
