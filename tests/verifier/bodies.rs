//! Theorems on rubber bodies, at random bodies and random states.
//!
//! Borisov, Mamaev, Bizyaev 2013, sections 2 to 4. Every quantity has an enclosure: zeros are
//! enclosed, and enclosures of equal quantities meet.

use crate::common::{assert_meet, case, claim, claim_text, exact, excludes_zero};
use crate::random::{config, inertia, number, numbers, potential, profile, support, vector};
use liouville::case::{Case, Setting};
use liouville::verdict::{Enclosed, Options, PointReport, Verdict, evaluate, judge};
use num_traits::ToPrimitive;
use proptest::prelude::*;

/// Evaluates a case at the state of a seed.
fn at(case: &Case, seed: u64) -> PointReport {
    evaluate(case, None, seed, 0).expect("a case that can be evaluated")
}

/// Writes a case of a rubber body; `k` is the curvature of the support, if it has one.
fn text(k: Option<&str>, parameters: &[(&str, &str)], body: &str) -> String {
    let system = if k.is_some() { "rubber-sphere" } else { "rubber-plane" };
    let mut text =
        format!("title = \"body\"\nsystem = \"{system}\"\ncheck-weights = false\n[parameters]\n");
    let all = parameters.iter().copied().chain(k.map(|k| ("k", k)));
    for (name, value) in all {
        let quoted =
            if value.starts_with('[') { value.to_string() } else { format!("\"{value}\"") };
        text.push_str(&format!("{name} = {quoted}\n"));
    }
    text + "[body]\n" + body + "\n"
}

/// Asserts that an enclosure contains 0 and is narrow against the motion.
fn assert_vanishes(enclosure: Enclosed, report: &PointReport, what: &str) {
    let (mid, radius) = enclosure.unwrap_or_else(|| panic!("{what} is undefined"));
    assert!(mid.abs() <= radius, "{what}: {mid:e} ± {radius:e} excludes 0");
    let speed = report.field.iter().flatten().fold(1.0, |a: f64, (x, _)| a.max(x.abs()));
    assert!(radius <= f64::EPSILON.sqrt() * speed, "{what}: ± {radius:e} could hide anything");
}

/// Encloses x times an exact number.
fn times(x: Enclosed, factor: &num_rational::BigRational) -> Enclosed {
    let factor = factor.to_f64().expect("a finite factor");
    let (mid, radius) = x?;
    let product = mid * factor;
    // Rounding of the factor and of the product, and that of the bound.
    Some((
        product,
        (radius * factor.abs() + 2.0 * f64::EPSILON * product.abs()) * (1.0 + 4.0 * f64::EPSILON),
    ))
}

/// Returns γ₃', by which claims with a spurious factor e^γ₃ fail.
fn height_rate(report: &PointReport) -> Enclosed {
    report.field[5]
}

proptest! {
    #![proptest_config(config(100))]

    /// (3.2), (3.4): ρ = √g₁ g₂ for every U and S, F₂ = √g₁ ω₃ for every U(γ₃).
    #[test]
    fn a_body_of_revolution_keeps_its_measure_and_integral(
        p in profile(), moments in numbers(150, 300, 2), m in number(50, 200), u in potential(),
        s in vector(-100, 100), along in numbers(-200, 200, 2), seed in 0u64..1000,
    ) {
        let tensor = format!("diag({0}, {0}, {1})", moments[0], moments[1]);
        let parameters = [("m", m.as_str()), ("I", &tensor), ("S", &s)];
        let body = format!("profile = \"{p}\"\ngyrostat = \"S\"\npotential = \"{u}\"\n");
        let measure = claim_text("ρ", "density", "√g1*g2")
            + &claim_text("wrong ρ", "density", "√g1*g2*exp(γ3)");
        let report = at(&case(&text(None, &parameters, &(body + &measure))), seed);
        assert_vanishes(claim(&report, "ρ").1, &report, "v(ln √g₁ g₂) + div v");
        assert_meet(claim(&report, "wrong ρ").1, height_rate(&report), "the factor e^γ₃");

        let body = format!("profile = \"{p}\"\npotential = \"({})*γ3 + ({})*γ3²\"\n", along[0], along[1]);
        let integral = claim_text("F2", "integral", "√g1*ω3")
            + &claim_text("wrong F2", "integral", "√g1*ω3 + γ3");
        let report = at(&case(&text(None, &parameters, &(body + &integral))), seed);
        assert_vanishes(claim(&report, "F2").1, &report, "(√g₁ ω₃)'");
        assert_meet(claim(&report, "wrong F2").1, height_rate(&report), "the term γ₃");
    }

    /// (3.7): ρ = (μ + m r²)√(μ + m(r,γ)²) for I = μE, whatever the surface.
    #[test]
    fn spherical_inertia_keeps_its_measure_for_every_support_function(
        coefficients in numbers(-20, 20, 16), mu in number(50, 300), m in number(50, 200),
        seed in 0u64..1000,
    ) {
        let parameters = [("m", m.as_str()), ("mu", &mu), ("I", "mu*E")];
        let rho = "(μ + m*r²)*√(μ + m*(r,γ)²)";
        let claims = claim_text("ρ", "density", rho)
            + &claim_text("wrong ρ", "density", &format!("{rho}*exp(γ3)"));
        let text = text(None, &parameters, &format!("support = \"arbitrary\"\n{claims}"));
        let cubic = |i: usize| (0..4 - i).map(move |j| [i, j, 3 - i - j]);
        let square = |i: usize| (0..3 - i).map(move |j| [i, j, 2 - i - j]);
        let exponents = (0..4).flat_map(cubic).chain((0..3).flat_map(square));
        let settings: Vec<Setting> = exponents
            .zip(&coefficients)
            .map(|([i, j, k], value)| {
                Setting { name: format!("h[{i},{j},{k}]"), value: value.clone() }
            })
            .collect();
        let case = Case::parse(&text, &settings).expect("sixteen coefficients of h");
        let report = at(&case, seed);
        prop_assert!(report.parameters.is_empty(), "all coefficients are set: {:?}", report.parameters);
        assert_vanishes(claim(&report, "ρ").1, &report, "v(ln ρ) + div v");
        assert_meet(claim(&report, "wrong ρ").1, height_rate(&report), "the factor e^γ₃");
    }

    /// Section 2: χ and with it div v contain neither U nor S.
    #[test]
    fn neither_a_potential_nor_a_rotor_changes_the_divergence(
        h in support(), tensor in inertia(), m in number(50, 200), u in potential(),
        s in vector(-100, 100), k in number(-15, 40), curved: bool, seed in 0u64..1000,
    ) {
        let k = curved.then_some(k.as_str());
        let parameters = [("m", m.as_str()), ("I", &tensor), ("S", &s)];
        let body = format!("support = \"{h}\"\n");
        let free = at(&case(&text(k, &parameters, &body)), seed);
        let loaded = body + &format!("gyrostat = \"S\"\npotential = \"{u}\"");
        let loaded = at(&case(&text(k, &parameters, &loaded)), seed);
        assert_meet(free.divergence, loaded.divergence, "div v");
        let (a, b) = (free.field[0].expect("defined"), loaded.field[0].expect("defined"));
        prop_assert!((a.0 - b.0).abs() > a.1 + b.1, "the motion itself is another: {a:?}, {b:?}");
    }

    /// Section 2, consequence 2: C(k) = (1 - kR) C(0) for a ball.
    #[test]
    fn the_criterion_of_a_ball_is_that_on_the_plane_times_one_minus_k_r(
        tensor in inertia(), c in vector(-80, 80), radius in number(100, 300),
        m in number(50, 200), k in number(-25, 80), seed in 0u64..1000,
    ) {
        let parameters = [("m", m.as_str()), ("I", &tensor), ("R", &radius), ("c", &c)];
        let shape = "shape = \"ball\"";
        let plane = at(&case(&text(None, &parameters, shape)), seed).criterion.flatten();
        let sphere = at(&case(&text(Some(&k), &parameters, shape)), seed).criterion.flatten();
        prop_assert!(excludes_zero(plane), "a generic ball has no measure: {plane:?}");
        let factor = exact("1") - exact(&k) * exact(&radius);
        assert_meet(sphere, times(plane, &factor), "C on the sphere");
    }

    /// kR = 1: N = const, for any I and c; ρ = det Ĩ (γ,Ĩ⁻¹γ), (4.5).
    #[test]
    fn a_ball_on_an_equal_ball_has_a_measure(
        tensor in inertia(), c in vector(-80, 80), radius in number(100, 300),
        m in number(50, 200), seed in 0u64..1000,
    ) {
        let parameters = [("m", m.as_str()), ("I", &tensor), ("R", &radius), ("c", &c)];
        let rho = claim_text("ρ", "density", "det(Ĩ)*(γ,Ĩ⁻¹*γ)");
        let body = format!("shape = \"ball\"\n{rho}");
        let equal = at(&case(&text(Some("1/R"), &parameters, &body)), seed);
        assert_vanishes(equal.criterion.flatten(), &equal, "C at kR = 1");
        assert_vanishes(claim(&equal, "ρ").1, &equal, "v(ln ρ) + div v at kR = 1");
        let near = at(&case(&text(Some("1000001/1000000/R"), &parameters, &body)), seed);
        prop_assert!(excludes_zero(near.criterion.flatten()), "a millionth off it is not 0");
        prop_assert!(excludes_zero(claim(&near, "ρ").1), "and the density is lost");
    }

    /// Only the values on |γ| = 1 enter: r = -Rγ - c and r = -Rγ/|γ| - c have one criterion.
    #[test]
    fn the_criterion_does_not_depend_on_the_extension_off_the_sphere(
        tensor in inertia(), c in vector(-80, 80), radius in number(100, 300),
        m in number(50, 200), k in number(-25, 80), curved: bool, seed in 0u64..1000,
    ) {
        let k = curved.then_some(k.as_str());
        let parameters = [("m", m.as_str()), ("I", &tensor), ("R", &radius), ("c", &c)];
        let homogeneous = at(&case(&text(k, &parameters, "shape = \"ball\"")), seed);
        let paper = at(&case(&text(k, &parameters, "contact = \"−R*γ − c\"")), seed);
        assert_meet(homogeneous.criterion.flatten(), paper.criterion.flatten(), "C");
        assert_meet(homogeneous.level_divergence, paper.level_divergence, "div v on the level");
        for (a, b) in homogeneous.chi.expect("χ").into_iter().zip(paper.chi.expect("χ")) {
            assert_meet(a, b, "χ");
        }
    }

    /// k → 0: the sphere becomes the plane, with a difference of first order in k.
    #[test]
    fn the_sphere_tends_to_the_plane(
        h in support(), tensor in inertia(), m in number(50, 200), sign: bool,
        seed in 0u64..1000,
    ) {
        let parameters = [("m", m.as_str()), ("I", &tensor)];
        let body = format!("support = \"{h}\"");
        let quantities = |k: Option<&str>| {
            let report = at(&case(&text(k, &parameters, &body)), seed);
            let all = report.field.into_iter().chain([report.divergence, report.criterion.flatten()]);
            all.map(|x| x.expect("defined")).collect::<Vec<_>>()
        };
        let plane = quantities(None);
        let sign = if sign { "" } else { "-" };
        let [once, half] =
            ["1/4096", "1/8192"].map(|k| quantities(Some(&format!("{sign}{k}"))));
        for (i, ((zero, once), half)) in plane.iter().zip(&once).zip(&half).enumerate() {
            let (far, near) = ((once.0 - zero.0).abs(), (half.0 - zero.0).abs());
            let blur = once.1 + half.1 + 2.0 * zero.1;
            // Halved with k, not kept (ratio 1) and not quartered: nearest to 2 among powers of 2.
            let root = std::f64::consts::SQRT_2;
            prop_assert!(
                far + blur >= root * (near - blur) && far - blur <= 2.0 * root * (near + blur),
                "quantity {i}: {far:e} at k, {near:e} at k/2, errors {blur:e}"
            );
            prop_assert!(i != 3 || far > blur, "γ₁' feels the curvature: {far:e}, error {blur:e}");
        }
    }
}

#[test]
fn impossible_bodies_of_every_kind_have_a_warning() {
    for (path, setting, words) in [
        ("plane/unbalanced-ball.toml", ("m", "-1"), "the mass is not positive"),
        ("open/flat-base-gyrostat-across.toml", ("m", "-1"), "the mass is not positive"),
        (
            "open/flat-base-gyrostat-across.toml",
            ("I", "[1, 1, 3]"),
            "violate a triangle inequality",
        ),
        ("open/flat-base-gyrostat-across.toml", ("I", "[1, 1, -1]"), "not positive definite"),
    ] {
        let text = std::fs::read_to_string(format!("{}/{path}", crate::CASES)).expect("a case");
        let setting = Setting { name: setting.0.to_string(), value: setting.1.to_string() };
        let case = Case::parse(&text, &[setting]).unwrap_or_else(|error| panic!("{path}: {error}"));
        let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
        let told = report.warnings.join("\n");
        assert!(told.contains(words), "{path}: {told}");
    }
}

#[test]
fn a_support_function_that_is_homogeneous_on_a_part_only_is_taken_on_the_sphere() {
    // On |γ| = 1 it is 1, a ball; off it, it is another on the cap γ3 > c.
    for cap in ["99/100", "-99/100"] {
        let text = format!(
            "title = 'x'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nR = 1\nI = 'diag(1..3)'\n[let]\n\
             d = 'γ3/|γ| - {cap}'\nb = '(d + |d|)²'\n[body]\nsupport = '|γ|*(1 + b*exp(γ1)*((γ,γ) - 1))'\n[[claim]]\n\
             identity = 'r = -γ'\nwhere = '|γ| = 1'\n[[claim]]\nidentity = 'r = -γ*(1 + 2*b*exp(γ1))'\n\
             where = '|γ| = 1'\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        let found = judge(&case, &Options::default()).expect("a report");
        let verdicts: Vec<Verdict> = found.claims.iter().map(|claim| claim.verdict).collect();
        assert_eq!(verdicts, [Verdict::Proved, Verdict::Refuted], "{cap}");
    }
}
