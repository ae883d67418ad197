//! Tests that every family of invariants is found in some body.

use super::*;

/// Bodies of the catalogue, with at least one for each family.
const BODIES: [&str; 51] = [
    "plane/spherical-inertia-ball",
    "plane/balanced-ball-gravity",
    "plane/balanced-ball",
    "plane/balanced-ball-gyrostat",
    "plane/balanced-ball-brun",
    "plane/unbalanced-ball",
    "plane/revolution",
    "plane/revolution-gyrostat",
    "plane/spherical-inertia",
    "plane/ellipsoid",
    "plane/ellipsoid-mb-mu",
    "plane/spheroid",
    "sphere/balanced-ball",
    "sphere/borisov-mamaev-ball",
    "sphere/borisov-mamaev-ball-potential",
    "sphere/equal-sphere",
    "sphere/symmetric-ball",
    "sphere/symmetric-ball-gyrostat",
    "sphere/body-of-revolution",
    "sphere/body-of-revolution-gyrostat",
    "sphere/disk",
    "sphere/ellipsoid",
    "spin/chaplygin-ball",
    "spin/chaplygin-ball-gyrostat",
    "spin/chaplygin-ball-kozlov",
    "spin/homogeneous-ball",
    "spin/routh-sphere",
    "spin/routh-sphere-gyrostat",
    "spin/revolution",
    "spin/revolution-gyrostat",
    "spin/spherical-inertia",
    "spin/ellipsoid-mb-mu",
    "spin/unbalanced-ball",
    "spin/borisov-fedorov",
    "spin/sphere-balanced-ball-kozlov",
    "spin/sphere-revolution",
    "spin/sphere-routh-sphere",
    "spin/sphere-spherical-inertia",
    "spin/sphere-ellipsoid-mb-mu",
    "spin/sphere-revolution-free",
    "flat-base/base-through-centre",
    "flat-base/symmetric-base",
    "flat-base/symmetric-base-gyrostat",
    "flat-base/symmetric-base-through-centre-gyrostat",
    "surface/sphere",
    "surface/ellipsoid",
    "surface/revolution",
    "surface/rotating-sphere",
    "surface/circular-cylinder",
    "skate/nonholonomic",
    "suslov/vakonomic-top",
];

/// A body that preserves phase volume itself.
const HOMOGENEOUS: &str = "title = \"homogeneous ball\"\nsystem = \"rubber-plane\"\n[parameters]\n\
    m = \"0.5..2\"\nR = \"1..3\"\nI = \"spherical(0.5..3)\"\n[body]\nshape = \"ball\"\n";

#[test]
fn no_family_is_dead() {
    let options = Options::default();
    let mut missing: Vec<String> = Vec::new();
    let mut cases = vec![Case::parse(HOMOGENEOUS, &[]).expect("a case")];
    for name in BODIES {
        let path = format!("{}/cases/{name}.toml", concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
        cases.push(Case::read(path.as_ref(), &[]).1.expect(name));
    }
    let recognised = |case: Case| {
        let geometry = Geometry::of(&case, &options).expect("judged");
        (case, geometry)
    };
    let bodies: Vec<(Case, Geometry)> = cases.into_iter().map(recognised).collect();
    for family in family::all() {
        let mut proved: Vec<String> = Vec::new();
        let mut stated: Vec<String> = Vec::new();
        for (case, geometry) in &bodies {
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
                let found = question.ask(case, &options).expect("judged");
                let found = found
                    .unwrap_or_else(|| panic!("{} can be asked of {}", family.name, case.title));
                // By place, since the name of an axis is part of the name of a claim.
                for (number, tested) in found.iter().enumerate() {
                    let claim = format!("{number}");
                    if tested.claim.verdict == Verdict::Proved && !proved.contains(&claim) {
                        proved.push(claim.clone());
                    }
                    if !stated.contains(&claim) {
                        stated.push(claim);
                    }
                }
            }
        }
        if stated.is_empty() || proved.len() < stated.len() {
            missing.push(format!("{}: {proved:?} of {stated:?}", family.name));
        }
    }
    assert!(missing.is_empty(), "claims that are proved of no body:\n{}", missing.join("\n"));
}

#[test]
fn components_of_vectors_are_integrals_of_their_own() {
    let text = "title = \"x\"\n[state]\nr = \"vector(0.5..2)\"\np = \"vector(-1..1)\"\n\
                [hamiltonian]\nfunction = \"(p,p)/2 - 1/|r|\"\npairs = [[\"r\",\"p\"]]\n\
                [[claim]]\nname = \"L\"\nintegral = \"r × p\"\n\
                [[claim]]\nname = \"A\"\nintegral = \"p × (r × p) - r/|r|\"\n";
    let (case, options) = (Case::parse(text, &[]).expect("a case"), Options::default());
    let claims = liouville::verdict::judge(&case, &options).expect("judged").claims;
    let claimed: Vec<TestedClaim> =
        claims.into_iter().map(|claim| TestedClaim::claimed(&case, claim)).collect();
    let integrals: Vec<&TestedClaim> = claimed.iter().collect();
    let found = independence::count(&case, &options, &[], &integrals, &[]).expect("judged");
    // (L, A) = 0 and A² = 1 + 2 energy L².
    assert_eq!(found.count.independent, ["energy", "L[1]", "L[2]", "L[3]", "A[1]"]);
    assert_eq!((found.kept, found.count.needed), (vec![0, 1], 4));
}
