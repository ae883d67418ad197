//! Evidence against a density: a closed orbit along which volumes change.

use super::closed_orbit::exclusion;
use super::scene::FollowedCase;
use crate::{MeasuredNumber, Multipliers, SectionRequest, section, spread};
use liouville::case::{Case, Direction};
use liouville::verdict::Options;

/// Numbers of motions, and of crossings of each, that are followed to come near attracting points.
const STARTS: usize = 16;
const CROSSINGS: usize = 150;

/// Whether a closed orbit speaks against densities: a density ρ that is smooth and positive there
/// is the same after the period, so that the flow preserves volumes: λ₁ λ₂ = 1.
pub fn speaks_against(product: MeasuredNumber) -> bool {
    (product.value - 1.0).abs() > product.error
}

/// Finds a fixed point of the section map that speaks against every density that is smooth and
/// positive on the level, and describes it: as a theorem where the closed orbit through it is
/// enclosed, and otherwise as evidence. Only for a case with a section and without free parameters.
pub fn evidence_against_density(case: &Case, options: &Options) -> Option<String> {
    let seed = options.seed;
    if case.model.free_components() > 0 {
        return None;
    }
    let plan = case.section.as_ref()?;
    let scene = FollowedCase::new(case, seed);
    let map = scene.map().ok()?;
    let request = SectionRequest {
        g0: plan.g0.clone(),
        energy: plan.energy.clone(),
        direction: Direction::Both,
        crossings: 1,
        skip: CROSSINGS,
        starts: [plan.starts.clone(), spread(STARTS)].concat(),
        backwards: false,
        seed,
        index: 0,
    };
    let orbits = section(case, &request, 1, &|_| ()).ok()?;
    let ends = orbits.iter().filter_map(|orbit| orbit.crossings.last());
    let points = ends.filter_map(|end| map.periodic(end.at, 1).ok());
    // The clearest of them is followed again with twice the digits.
    let off = |product: f64| (product - 1.0).abs();
    let plainest = points.max_by(|a, b| off(a.determinant).total_cmp(&off(b.determinant)))?;
    let orbit = map.closed(plainest.at, 1).ok()?;
    let product = orbit.measure(|point| point.determinant);
    let point = orbit.point();
    let multipliers = match point.multipliers() {
        Multipliers::Complex { modulus, argument } => {
            format!("{modulus:.8} e^(±{argument:.6} i)")
        }
        Multipliers::Real(a, b) => format!("{a:.8} and {b:.8}"),
    };
    if !speaks_against(product) {
        return None;
    }
    let start = map.chart.start(point.at).ok()?;
    let proved = exclusion(case, &start, point.time, Some(&plan.energy), options);
    // A motion that is nearly closed is no evidence.
    proved.or_else(|| {
        let is_supported = orbit.is_supported();
        is_supported.then(|| format!(
            "evidence against any density that is smooth and positive: the closed orbit through \
             (l, L/G) = ({:.8}, {:.8}) of the section g = {} at energy {} has multipliers \
             {multipliers}, product {:.12} ± {:.0e} in place of 1",
            point.at[0], point.at[1], plan.g0, plan.energy, product.value, product.error
        ))
    })
}
