//! Reports on bodies without candidate formulas: the class, the findings, and their presentation.

use std::path::Path;

use assert_cmd::Command;
use liouville::case::Case;
use liouville::verdict::Options;
use liouville_cli::report::survey as written;
use liouville_flow::portrait;
use liouville_search::Halt;
use liouville_search::survey::{
    HierarchyClass, Integrals, MeasureStatus, Survey, TestedClaim, survey,
};
use predicates::str::contains;

/// Writes a body with parameters m and I, and further ones.
fn body(system: &str, parameters: &str, body: &str) -> String {
    format!(
        "title = \"a body\"\nsystem = \"{system}\"\n[parameters]\nm = \"0.5..2\"\n{parameters}\n[body]\n{body}\n"
    )
}

fn surveyed(text: &str) -> Survey {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error:?}\n{text}"));
    survey(&case, &Options::default(), &Halt::default(), &mut |_| {}).expect("a survey")
}

const TRIAXIAL: &str = "I = \"inertia(0.5..5)\"\n";
const SYMMETRIC: &str = "I = \"axisymmetric(0.5..5)\"\n";
const BALL: &str = "R = \"1..3\"\n";
const OFFSET: &str = "R = \"1..3\"\nc = \"vector(-0.5..0.5)\"\n";
const ALONG: &str = "R = \"1..3\"\nc3 = \"0.1..0.5\"\nc = \"[0, 0, c3]\"\n";
const AXES: &str = "B = \"diag(1..4)\"\n";

/// A body with its expected report: class, measure, formulas of integrals.
struct Expected {
    body: String,
    class: HierarchyClass,
    measure: MeasureStatus,
    integrals: &'static [&'static str],
}

fn expect(
    (system, parameters, shape): (&str, String, &str),
    class: HierarchyClass,
    measure: MeasureStatus,
    integrals: &'static [&'static str],
) -> Expected {
    Expected { body: body(system, &parameters, shape), class, measure, integrals }
}

fn check(expected: &Expected) -> Survey {
    let found = surveyed(&expected.body);
    let standing = &found.hierarchy;
    assert_eq!(standing.class, expected.class, "the class of\n{}", expected.body);
    assert_eq!(standing.measure, expected.measure, "the measure of\n{}", expected.body);
    let formulas: Vec<&str> = found.integrals.iter().map(|one| one.formula()).collect();
    assert_eq!(formulas, expected.integrals, "the integrals of\n{}", expected.body);
    found
}

#[test]
fn bodies_on_a_plane_stand_where_the_paper_puts_them() {
    use HierarchyClass::{IntegralAndMeasure, IntegralOnly, MeasureOnly, Neither, NotKnown};
    use MeasureStatus::{ClosedForm, Excluded, ExcludedForConfiguration};
    let plane = |parameters: String, shape| ("rubber-plane", parameters, shape);
    let ball = "shape = \"ball\"";
    let balanced = plane(format!("{TRIAXIAL}{BALL}"), ball);
    check(&expect(balanced, IntegralAndMeasure, ClosedForm, &["|J*ω × γ|²"]));
    let unbalanced = plane(format!("{TRIAXIAL}{OFFSET}"), ball);
    let of_ball = &["|Ĩ*ω × γ|² − 2*m*R*(γ,c)*(Ĩ*ω,ω)"];
    check(&expect(unbalanced, IntegralOnly, Excluded, of_ball));
    let axis = plane(format!("{SYMMETRIC}{ALONG}"), ball);
    let found = check(&expect(axis, IntegralAndMeasure, ClosedForm, &["√g1*ω3"]));
    assert_eq!(found.dependent.len(), 1, "(3.19) is an integral too, and a function of (3.4)");
    let homothetic =
        plane(format!("{AXES}\"μ\" = \"0.5..2\"\nI = \"m*B + μ*E\""), "shape = \"ellipsoid\"");
    check(&expect(homothetic, IntegralAndMeasure, ClosedForm, &["(Ĩ*ω,B⁻¹*ω)"]));
    let any = plane(format!("{TRIAXIAL}{AXES}"), "shape = \"ellipsoid\"");
    check(&expect(any, Neither, Excluded, &[]));
    let spherical = plane("\"μ\" = \"0.5..2\"\nI = \"μ*E\"".into(), "support = \"arbitrary\"");
    let found = check(&expect(spherical, MeasureOnly, ClosedForm, &[]));
    assert_eq!(found.hierarchy.integrals, Integrals::ExcludedToDegree(4), "none to degree 4");
    let arbitrary = plane(TRIAXIAL.into(), "support = \"arbitrary\"");
    check(&expect(arbitrary, Neither, Excluded, &[]));
    let gravity = plane(
        format!("{TRIAXIAL}{OFFSET}a_g = \"1..2\""),
        "shape = \"ball\"\npotential = \"m*a_g*h\"",
    );
    let found = check(&expect(gravity, NotKnown, ExcludedForConfiguration, &[]));
    assert!(found.fails.iter().any(|one| one.formula() == of_ball[0]), "gravity ends F2");
}

#[test]
fn a_rotor_keeps_or_ends_the_integral() {
    let rotor = "s = \"0.5..2\"\nS = \"[0, 0, s]\"\n";
    let revolution = body(
        "rubber-plane",
        &format!("{SYMMETRIC}{rotor}"),
        "profile = \"arbitrary\"\ngyrostat = \"S\"",
    );
    let found = surveyed(&revolution);
    assert_eq!(found.hierarchy.class, HierarchyClass::IntegralAndMeasure, "a rotor along the axis");
    assert!(found.integrals[0].formula().contains('∫'), "F2 by quadrature");
    assert!(found.hamiltonian.is_empty(), "no conformally Hamiltonian form with a rotor");
    let ellipsoid = body(
        "rubber-plane",
        &format!("{AXES}\"μ\" = \"0.5..2\"\nI = \"m*B + μ*E\"\nS = \"vector(0.5..2)\""),
        "shape = \"ellipsoid\"\ngyrostat = \"S\"",
    );
    let found = surveyed(&ellipsoid);
    assert_eq!(found.hierarchy.class, HierarchyClass::MeasureOnly, "the measure stays");
    assert!(found.fails.iter().any(|one| one.formula() == "(Ĩ*ω,B⁻¹*ω)"), "F2 dies");
    assert!(found.reversors.is_empty(), "no reversor with a rotor in general position");
}

#[test]
fn bodies_on_a_sphere_stand_where_the_paper_puts_them() {
    use HierarchyClass::{IntegralAndMeasure, MeasureOnly, Neither};
    use MeasureStatus::{ByQuadrature, ClosedForm, Excluded};
    let sphere = |parameters: String, shape| ("rubber-sphere", parameters, shape);
    let curved = |curvature: &str| format!("{TRIAXIAL}{BALL}k = \"{curvature}\"\n");
    let ball = "shape = \"ball\"";
    check(&expect(sphere(curved("0.1..0.3"), ball), MeasureOnly, ClosedForm, &[]));
    let enclosing = sphere(curved("-2/R"), ball);
    let kappa = &["((J*ω,J*ω) + det(J)*(ω,J*ω)*(J⁻¹*γ,J⁻¹*γ))/δ"];
    check(&expect(enclosing, IntegralAndMeasure, ClosedForm, kappa));
    let equal = sphere(format!("{TRIAXIAL}{OFFSET}k = \"1/R\"\n"), ball);
    check(&expect(equal, MeasureOnly, ClosedForm, &[]));
    let unbalanced = sphere(format!("{TRIAXIAL}{OFFSET}k = \"0.1..0.3\"\n"), ball);
    check(&expect(unbalanced, Neither, Excluded, &[]));
    let revolution = sphere(format!("{SYMMETRIC}k = \"0.1..0.3\"\n"), "profile = \"arbitrary\"");
    check(&expect(revolution, IntegralAndMeasure, ByQuadrature, &["λ*ω3"]));
}

#[test]
fn flat_bases_surfaces_and_fields_stand_too() {
    use HierarchyClass::{IntegralAndMeasure, MeasureOnly, Neither};
    use MeasureStatus::{ClosedForm, Excluded};
    let flat = |inertia: &str, z: &str| {
        ("flat-base", format!("{inertia}k = \"0.3..2\"\nz = \"{z}\"\n"), "height = \"z\"")
    };
    check(&expect(flat(TRIAXIAL, "-0.8..-0.2"), Neither, Excluded, &[]));
    let through = &["(Ĩ*ω,Ĩ*ω) − m*(r1² + r2²)*(Ĩ*ω,ω)"];
    check(&expect(flat(TRIAXIAL, "0"), IntegralAndMeasure, ClosedForm, through));
    let symmetric = &["(r1*ω1 + r2*ω2)*exp(−ε)"];
    check(&expect(flat(SYMMETRIC, "-0.8..-0.2"), IntegralAndMeasure, ClosedForm, symmetric));
    let ball = "R = \"0.2..0.4\"\n\"μ\" = \"0.5..2\"\n";
    let surface = |more: &str, shape| ("ball-on-surface", format!("{ball}{more}"), shape);
    let quadric = surface("B = \"diag(1..4)\"\n", "support = \"√(γ,B*γ)\"");
    let found =
        check(&expect(quadric, IntegralAndMeasure, ClosedForm, &["(γ × M,B⁻¹*(γ × M))/(γ,B*γ)"]));
    assert_eq!(found.hierarchy.integrals, Integrals::Some, "one short of Euler and Jacobi");
    let level = surface("q = \"vector(0.5..2)\"\n", "surface = \"q1*r1^4 + q2*r2^4 + q3*r3^4\"");
    check(&expect(level, MeasureOnly, ClosedForm, &[]));
    let top = "title = \"Euler's top\"\n[parameters]\nI = \"inertia(0.5..5)\"\n[state]\nM = \"vector(-2..2)\"\n\
               [field]\n\"M'\" = \"M × inverse(I)*M\"\n[[claim]]\nintegral = \"(M,M)\"\n";
    let found = surveyed(top);
    assert_eq!(found.hierarchy.class, IntegralAndMeasure, "the case's own integral counts");
    let reversal = found.reversors.iter().find(|one| one.images.len() == 1);
    assert!(reversal.is_some(), "M ↦ −M reverses time");
}

#[test]
fn reversors_have_the_fixed_sets_of_the_appendix() {
    let found =
        surveyed(&body("rubber-plane", &format!("{TRIAXIAL}{AXES}"), "shape = \"ellipsoid\""));
    let sets: Vec<Option<usize>> = found
        .reversors
        .iter()
        .map(|one| one.fixed_set.expect("of a map of the frame").dimension)
        .collect();
    assert_eq!(sets.len(), 8, "R(0), and seven compositions with it");
    assert_eq!(sets.iter().filter(|set| **set == Some(2)).count(), 7, "dimension 2");
    assert_eq!(sets.iter().filter(|set| set.is_none()).count(), 1, "of the inversion it is empty");
    assert_eq!(found.symmetries.len(), 7, "Π(i), Σ(i), Σ(0)");
}

#[test]
fn reversors_have_fixed_sets_on_levels_and_differ_there() {
    let own = |constraint: &str, state: &[&str], kinetic: &str| {
        let ranges: String = state.iter().map(|name| format!("\"{name}\" = '-2..2'\n")).collect();
        let found = surveyed(&format!(
            "title = 'knife'\nsystem = 'nonholonomic'\n[state]\n{ranges}[lagrangian]\n\
             kinetic = \"{kinetic}\"\nconstraints = [\"{constraint}\"]\n"
        ));
        let dimension = |one: &TestedClaim| one.fixed_set.and_then(|set| set.dimension);
        let maps: Vec<(usize, Option<usize>)> =
            found.reversors.iter().map(|one| (one.images.len(), dimension(one))).collect();
        (maps, found.symmetries.len())
    };
    let state = ["x", "y", "f", "x'", "y'", "f'"];
    let (maps, _) = own("y'*cos(f) = x'*sin(f)", &state, "(x'^2 + y'^2 + f'^2)/2");
    // The velocities turned round leave x, y and f, in which the constraint says nothing.
    assert!(maps.contains(&(3, Some(3))), "{maps:?}");
    // y, f and x' turned round leave y' cos 0 = 0 of x, y', f'.
    assert!(maps.contains(&(3, Some(2))), "{maps:?}");
    assert!(maps.iter().all(|(_, dimension)| dimension.is_some()), "{maps:?}");
    // On y' = 0 a change of its sign is the identity.
    let (maps, symmetries) = own("y' = 0", &["x", "y", "x'", "y'"], "(x'^2 + y'^2)/2");
    assert_eq!(maps.len(), 4, "signs of x or y with x' or not: {maps:?}");
    assert_eq!(symmetries, 3, "x with x', y, and both");
}

#[test]
fn a_rest_at_which_volumes_change_excludes_densities_near_it() {
    // Lorenz' field, and one like it that preserves volumes.
    let field = |y: &str, z: &str| {
        surveyed(&format!(
            "title = 'l'\n[state]\nx = '-1..1'\ny = '-1..1'\nz = '-1..1'\n[field]\n\
             x = '2*(y − x)'\ny = '{y} − x*z'\nz = '{z} + x*y'\n"
        ))
    };
    let falling = field("3*x − y", "−z/3").hierarchy.measure;
    assert_eq!(falling, MeasureStatus::ExcludedAtRest);
    assert_ne!(field("3*x + y", "z").hierarchy.measure, MeasureStatus::ExcludedAtRest);
}

#[test]
fn a_density_by_quadrature_agrees_with_its_closed_form() {
    let text =
        body("rubber-plane", "I = [1, 2, 3]\nR = 2", "shape = \"ball\"").replace("\"0.5..2\"", "1");
    let map = surveyed(&text).sphere.expect("a map");
    assert!(map.closure.is_some_and(|error| error < 1e-9), "closed paths: {:?}", map.closure);
    // ρ² = (γ,J⁻¹γ), J = I + mR²E
    let inverse = [1.0 / 5.0, 1.0 / 6.0, 1.0 / 7.0];
    for (latitude, row) in map.latitudes.iter().zip(&map.values) {
        for (longitude, value) in map.longitudes.iter().zip(row) {
            let (s, c) = latitude.to_radians().sin_cos();
            let (t, d) = longitude.to_radians().sin_cos();
            let gamma = [c * d, c * t, s];
            let density: f64 = (0..3).map(|k| gamma[k] * gamma[k] * inverse[k]).sum();
            let exact = (density / inverse[0]).ln() / 2.0;
            let value = value.expect("a value");
            // The grid is printed to a hundredth of a degree, the values to six digits.
            let slack = 2e-5 + 1e-5 * exact.abs();
            assert!(
                (value - exact).abs() < slack,
                "{value} for {exact} at {latitude}, {longitude}"
            );
        }
    }
}

/// Asserts that every tag is closed, in order; a tag without content closes itself.
fn assert_well_formed(page: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = page.strip_prefix("<!DOCTYPE html>").expect("a document type");
    while let Some(start) = rest.find('<') {
        let end = start + rest[start..].find('>').expect("a tag ends");
        let tag = &rest[start + 1..end];
        let name = tag.trim_start_matches('/').split([' ', '\n', '/']).next().unwrap_or_default();
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name), "closed as opened, near {}", &rest[..end]);
        } else if !tag.ends_with('/') {
            open.push(name);
        }
        rest = &rest[end + 1..];
    }
    assert!(open.is_empty(), "left open: {open:?}");
}

#[test]
fn every_format_is_sound_and_the_same_each_time() {
    for path in
        ["plane/balanced-ball-brun", "sphere/body-of-revolution-gyrostat", "surface/revolution"]
    {
        let file = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
            .join(format!("cases/{path}.toml"));
        let text = std::fs::read_to_string(&file).expect("a case of the catalogue");
        let (first, again) = (surveyed(&text), surveyed(&text));
        let case = Case::parse(&text, &[]).expect("a case");
        let motion = |threads| portrait(&case, 1, threads);
        let page = written::html(&first, "x", motion(1).as_ref());
        assert_well_formed(&page);
        assert!(!page.contains("<script") && !page.contains(" src="), "nothing from outside");
        assert!(page.contains("<math") && page.contains("<svg"), "formulas and pictures");
        assert_eq!(page, written::html(&again, "x", motion(3).as_ref()), "the page of {path}");
        let has_section = page.contains("Poincaré section g = ");
        assert_eq!(has_section, path.contains("-ball"), "a section, or why there is none: {path}");
        let json = written::json(&first).expect("JSON");
        assert_eq!(json, written::json(&again).expect("JSON"), "the JSON of {path}");
        let latex = written::latex(&first, "x");
        let count = |text: &str| latex.matches(text).count();
        assert_eq!(count("{") - count("\\{"), count("}") - count("\\}"), "braces of {path}");
        assert_eq!(count("\\left("), count("\\right)"), "brackets of {path}");
        assert_eq!(count("\\begin{"), count("\\end{"), "environments of {path}");
        let markdown = written::markdown(&first, "x");
        assert_eq!(
            markdown.matches("<details>").count(),
            markdown.matches("</details>").count(),
            "folds"
        );
    }
}

#[test]
fn wrong_input_is_told_with_a_remedy() {
    let run = || Command::new(env!("CARGO_BIN_EXE_liouville"));
    run().args(["report", "nowhere.toml"]).assert().code(2).stderr(contains("cannot read"));
    let folder = std::env::temp_dir().join(format!("liouville-report-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("body.toml");
    std::fs::write(&file, body("rubber-plane", "", "shape = \"ball\"")).expect("a file");
    let path = file.to_str().expect("a path");
    run().args(["report", path]).assert().code(2).stderr(contains("help"));
    std::fs::write(&file, body("rubber-plane", &format!("{TRIAXIAL}{BALL}"), "shape = \"ball\""))
        .expect("a file");
    run().args(["report", path]).assert().code(0).stdout(contains("integral and measure"));
    let out = folder.join("none/report.html");
    let out = out.to_str().expect("a path");
    run()
        .args(["report", path, "--out", out])
        .assert()
        .code(2)
        .stderr(contains("give --out a file"));
    let out = folder.join("report.md");
    run().args(["report", path, "--out", out.to_str().expect("a path")]).assert().code(0);
    let markdown = std::fs::read_to_string(&out).expect("a report");
    assert!(markdown.starts_with("# a body"), "the name of the file sets the format");
    run().args(["report", path, "--json", "--format", "html"]).assert().code(2);
    std::fs::remove_dir_all(&folder).expect("the folder goes");
}

#[test]
fn planes_of_symmetry_may_be_turned() {
    let text = "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = '0.5..2'\nR = '1..3'\n\
                n = 'vector(-0.4..0.4)'\np = 'vector(-0.4..0.4)'\na = '1..2'\nb = '1..2'\n\
                I = 'a*E + b*n⊗n'\nc = 'n × p'\n[body]\nshape = 'ball'\n";
    let case = Case::parse(text, &[]).expect("a case");
    let found =
        survey(&case, &Options::default(), &Halt::default(), &mut |_| {}).expect("a survey");
    let reversor = |name: &str| found.reversors.iter().find(|one| one.claim.name == name);
    let across = reversor("Σ\u{303}(n)").expect("the plane across n holds c");
    assert!(across.holds(), "proved");
    assert_eq!(across.fixed_set.and_then(|set| set.dimension), Some(2));
    assert!(reversor("Π\u{303}(c)").is_some(), "a half turn about c keeps n⊗n and c");
    assert!(reversor("Σ\u{303}(p)").is_none(), "p is no axis of the body");
}

#[test]
fn a_lagrangian_without_constraints_is_a_lagrangian_system() {
    let free = "title = 'x'\n[parameters]\nm = 1\n[state]\na = '-3..3'\n\"a'\" = '-2..2'\n[lagrangian]\n\
                kinetic = \"m*a'²/2\"\npotential = '−cos(a)'\n[[claim]]\nintegral = 'energy'\n";
    for text in [free.to_string(), format!("system = 'nonholonomic'\n{free}")] {
        let found = surveyed(&text);
        assert_eq!(
            (found.system.as_str(), found.sentence.as_str()),
            ("lagrangian", "A Lagrangian system.")
        );
        assert_eq!(found.description.equations, ["Lagrange's equations"]);
    }
    let bound = free
        .replace(
            "[lagrangian]",
            "b = '-3..3'\n\"b'\" = '-2..2'\n[lagrangian]\nconstraints = [\"b' = a*a'\"]",
        )
        .replace("m*a'²/2", "m*a'²/2 + b'²/2");
    let found = surveyed(&format!("system = 'nonholonomic'\n{bound}"));
    assert_eq!(found.system, "nonholonomic");
    assert!(found.description.equations[0].text.contains("reactions"), "{:?}", found.description);
}

#[test]
fn fixed_parameters_are_not_called_generic_and_a_driven_system_has_no_energy() {
    let driven = "title = 'x'\n[state]\n\"φ\" = '-3..3'\np = '-2..2'\n[field]\n\"φ'\" = 'p'\n\
                  \"p'\" = '−(1 − 2*cos(3*t))*sin(φ)'\n";
    let found = surveyed(driven);
    assert_eq!(found.hierarchy.grounds[1], "an integral: not known");
    let two = "title = 'x'\n[parameters]\ng = 9.81\n[state]\na = '-3..3'\nb = '-3..3'\n\"a'\" = '-2..2'\n\
                  \"b'\" = '-2..2'\n[lagrangian]\nkinetic = \"(a'² + b'²)/2\"\n\
                  potential = 'g*(a² + 3*b²)/2 + a²*b + b³/4'\n";
    let found = surveyed(two);
    assert!(
        matches!(found.hierarchy.integrals, Integrals::ExcludedToDegree(_)),
        "{:?}",
        found.hierarchy
    );
    assert!(!found.hierarchy.grounds[1].contains("generic"), "{:?}", found.hierarchy);
    let free = surveyed(&two.replace("g = 9.81", "g = '9..10'"));
    assert!(free.hierarchy.grounds[1].contains("for generic parameters"), "{:?}", free.hierarchy);
}
