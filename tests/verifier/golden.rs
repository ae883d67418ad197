//! Rubber bodies compared with reference values from independent 100-digit arithmetic.
//!
//! The reference lies in the enclosure returned by the library; a value that is 0 to 50 digits is
//! enclosed, and any other is separated from 0.

mod formulas;
mod held_back;
mod spin;

use crate::common::{Reference, case, claim, claim_text, exact, rational, report, strings, text};
use formulas::{BLOB_ON_PLANE, BLOB_ON_SPHERE, formula, lets};
use liouville::number::rational::Rational;
use liouville::verdict::{Digits, Enclosed, PointReport, evaluate_digits};
use num_rational::BigRational;
use serde_json::Value;

const PLANE: &str = include_str!("../data/plane.json");
const SPHERE: &str = include_str!("../data/sphere.json");

/// Claims that only read a named quantity: its name and the key of its reference.
const QUANTITIES: [(&str, &str); 4] = [
    ("λ0", "lambda"),
    ("det(Ĩ)*(γ,Ĩ⁻¹*γ)", "detItilde_gItildeinvg"),
    ("D_T", "det_T_Gamma"),
    ("(γ,adj(E − Γ)*γ)/k²", "invK"),
];

/// Returns the forms of the same body: the reference's extension of r off the sphere and ours.
fn bodies(id: &str, params: &Value) -> Vec<String> {
    let surface = params.get("surface").unwrap_or(params);
    let kind = surface["type"].as_str().or(surface["body"].as_str());
    match (id, kind) {
        ("sph_generic" | "generic_generic", _) => vec![format!("support = \"{BLOB_ON_PLANE}\"")],
        ("blob", _) => vec![format!("support = \"{BLOB_ON_SPHERE}\"")],
        (_, Some("ball")) => {
            vec!["contact = \"−R*γ − c\"".to_string(), "shape = \"ball\"".to_string()]
        }
        (_, Some("ellipsoid")) => vec!["shape = \"ellipsoid\"".to_string()],
        _ => panic!("no body for {id}"),
    }
}

/// Writes `[parameters]` with every number of the reference's parameters.
fn parameters(id: &str, params: &Value) -> String {
    let mut lines = String::from("[parameters]\n");
    let mut put = |name: &str, value: &Value| match value {
        Value::Null => {}
        Value::String(_) if name == "I" => lines.push_str("I = \"m*B + mu*E\"\n"),
        value => lines.push_str(&format!("{name} = {value}\n")),
    };
    let surface = params.get("surface").unwrap_or(params);
    for name in ["R", "c", "B"] {
        put(name, &surface[name]);
    }
    for name in ["m", "k", "z", "mu", "I"] {
        put(name, &params[name]);
    }
    put("S", &params["gyrostat_S"]);
    assert!(lines.contains("m = ") && lines.contains("I = "), "{id} has mass and inertia");
    lines
}

/// Writes the case texts of a reference case, one for each form of the body.
fn case_texts(reference: &Value, candidates: &[(String, String)], system: &str) -> Vec<String> {
    let (id, params) = (text(&reference["id"]), &reference["params"]);
    let head = format!(
        "title = \"{id}\"\nsystem = \"{system}\"\ncheck-weights = false\n{}{}",
        parameters(id, params),
        lets(id)
    );
    let mut extra = String::new();
    if params["gyrostat_S"].is_array() {
        extra.push_str("gyrostat = \"S\"\n");
    }
    match params["U"].as_str() {
        None => {}
        Some("g3^3/3-g3") => extra.push_str("potential = \"γ3^3/3 − γ3\"\n"),
        Some(other) => panic!("no potential for {other}"),
    }
    let mut claims = String::new();
    for (name, kind) in candidates {
        let key = if kind == "measure" { "density" } else { "integral" };
        claims.push_str(&claim_text(name, key, formula(id, name)));
    }
    if system == "flat-base" {
        return vec![format!("{head}\n[body]\n{extra}{claims}")];
    }
    for (name, key) in QUANTITIES {
        let curved_only = matches!(key, "det_T_Gamma" | "invK");
        if system == "rubber-sphere" || !curved_only {
            claims.push_str(&claim_text(name, "integral", name));
        }
    }
    let text = |body: String| format!("{head}\n[body]\n{body}\n{extra}\n{claims}");
    bodies(id, params).into_iter().map(text).collect()
}

fn state_of(point: &Value) -> Vec<Rational> {
    if let Some(list) = point.get("x_exact") {
        return strings(list).into_iter().map(|x| rational(&exact(x))).collect();
    }
    let Some(list) = point.get("gamma") else {
        return strings(&point["x"]).into_iter().map(|x| rational(&exact(x))).collect();
    };
    let vector = |list: &Value| strings(list).into_iter().map(exact).collect::<Vec<_>>();
    let (g, a) = (vector(list), vector(&point["omega_is_gamma_cross"]));
    let minor = |i: usize, j: usize| &g[i] * &a[j] - &g[j] * &a[i];
    let omega: [BigRational; 3] = [minor(1, 2), minor(2, 0), minor(0, 1)];
    omega.iter().chain(&g).map(rational).collect()
}

/// Compares all reference values at a state; returns their number.
fn compare_state(point: &Value, found: &PointReport, what: &str) -> usize {
    let mut compared = 0;
    let mut check = |reference: &Value, enclosure: Enclosed, name: &str| {
        Reference::read(text(reference)).assert_in(enclosure, &format!("{what}, {name}"));
        compared += 1;
    };
    for (i, reference) in strings(&point["v"]).into_iter().enumerate() {
        check(&Value::from(reference), found.field[i], &format!("v[{i}]"));
    }
    for (key, enclosure) in [
        ("div_v", found.divergence),
        ("div_v", found.level_divergence),
        ("div", found.divergence),
        ("div_level", found.level_divergence),
        ("criterion", found.criterion.flatten()),
        ("curl_xi", found.criterion.flatten()),
        ("E", found.energy.flatten()),
    ] {
        if let Some(reference) = point.get(key) {
            check(reference, enclosure, key);
        }
    }
    if let Some(list) = point.get("chi") {
        let chi = found.chi.expect("a rubber body has χ");
        for (i, reference) in strings(list).into_iter().enumerate() {
            check(&Value::from(reference), chi[i], &format!("χ[{i}]"));
        }
    }
    for (name, key) in QUANTITIES {
        let keys = if key == "lambda" { ["lambda0", "lambda_k"] } else { [key, key] };
        if let Some(reference) = point.get(keys[0]).or(point.get(keys[1])) {
            check(reference, claim(found, name).0, name);
        }
    }
    compared
}

/// Computes χ̂ = γ×χ, the covector with d ln ρ = -χ̂, from the enclosures of χ.
fn chi_hat(found: &PointReport, state: &[Rational]) -> [Enclosed; 3] {
    let chi = found.chi.expect("a rubber body has χ").map(|x| x.expect("χ is defined"));
    let gamma: Vec<f64> = state[3..].iter().map(|x| x.to_f64().0).collect();
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
        let value = gamma[i] * chi[j].0 - gamma[j] * chi[i].0;
        let size = (gamma[i] * chi[j].0).abs() + (gamma[j] * chi[i].0).abs();
        // γ, each product and the difference are rounded: three roundings of at most ε/2 each.
        let radius = gamma[i].abs() * chi[j].1 + gamma[j].abs() * chi[i].1;
        Some((value, (radius + 2.0 * f64::EPSILON * size) * (1.0 + 8.0 * f64::EPSILON)))
    })
}

#[test]
fn the_plane() {
    let data: Value = serde_json::from_str(PLANE).expect("JSON");
    let mut compared = 0;
    for reference in data["cases"].as_array().expect("cases") {
        let first = reference["states"][0]["candidates"].as_object().expect("candidates");
        let named: Vec<_> = first.keys().map(|name| (name.clone(), "integral".into())).collect();
        for source in case_texts(reference, &named, "rubber-plane") {
            let case = case(&source);
            for (i, point) in reference["states"].as_array().expect("states").iter().enumerate() {
                let (what, state) = (format!("{} at {i}", case.title), state_of(point));
                let found = report(&case, &state);
                compared += compare_state(point, &found, &what);
                let hat = chi_hat(&found, &state);
                for (k, reference) in strings(&point["chi_hat_tangential"]).iter().enumerate() {
                    Reference::read(reference).assert_in(hat[k], &format!("{what}, χ̂[{k}]"));
                }
                for (name, _) in &named {
                    let (value, residual) = claim(&found, name);
                    let golden = &point["candidates"][name];
                    let what = format!("{what}, {name}");
                    Reference::read(text(&golden["value"])).assert_in(value, &what);
                    Reference::read(text(&golden["residual"]))
                        .assert_in(residual, &format!("{what}, residual"));
                    compared += 2;
                }
            }
        }
    }
    assert_eq!(compared, 9 * 3 * (6 + 2 + 1 + 3 + 2 + 6), "6 cases, three of them in two forms");
}

#[test]
fn the_sphere_and_the_flat_base() {
    let data: Value = serde_json::from_str(SPHERE).expect("JSON");
    let (mut compared, mut refuted) = (0, 0);
    for reference in data["cases"].as_array().expect("cases") {
        let candidates = reference["candidates"].as_array().expect("candidates");
        let named: Vec<_> = candidates
            .iter()
            .map(|item| (text(&item["name"]).to_string(), text(&item["type"]).to_string()))
            .collect();
        let flat = reference["kind"] == "flat";
        let system = if flat { "flat-base" } else { "rubber-sphere" };
        for source in case_texts(reference, &named, system) {
            let case = case(&source);
            for (i, point) in reference["states"].as_array().expect("states").iter().enumerate() {
                let what = format!("{} at {i}", case.title);
                let found = report(&case, &state_of(point));
                compared += compare_state(point, &found, &what);
                for item in candidates {
                    let name = text(&item["name"]);
                    let (value, residual) = claim(&found, name);
                    let golden = Reference::read(text(&item["residuals"][i]));
                    golden.assert_in(residual, &format!("{what}, {name}, residual"));
                    Reference::read(text(&item["values"][i]))
                        .assert_in(value, &format!("{what}, {name}"));
                    let false_ = item["verdict"] == "not invariant";
                    assert_eq!(!golden.is_zero(), false_, "{what}: {name} as its verdict says");
                    refuted += usize::from(false_);
                    compared += 2;
                }
            }
        }
    }
    // Two balls in two forms each, an ellipsoid, a general body; 16 numbers for each state and 2
    // for each candidate; the flat base has 4 + 3 numbers for each state.
    let candidates = 2 * 11 + 2 * 8 + 9 + 4 + 5;
    assert_eq!(compared, 3 * (6 * 16 + 7 + 2 * candidates), "nothing was left out");
    assert_eq!(refuted, 3 * (2 * 7 + 2 * 3 + 4 + 1 + 2), "false formulas were told from true ones");
}

/// All thirty digits of the reference agree, in every component of the field and every value and
/// residual of a claim.
#[test]
fn thirty_digits_are_right() {
    let data: Value = serde_json::from_str(PLANE).expect("JSON");
    let mut compared = 0;
    let mut same = |digits: &Digits, reference: &Value, what: &str| {
        let (ours, theirs) = (digits.as_deref().expect("a value"), text(reference));
        assert_eq!(exact(ours), exact(theirs), "{what}: {ours} and {theirs}");
        compared += 1;
    };
    for reference in data["cases"].as_array().expect("cases") {
        let first = reference["states"][0]["candidates"].as_object().expect("candidates");
        let named: Vec<_> = first.keys().map(|name| (name.clone(), "integral".into())).collect();
        for source in case_texts(reference, &named, "rubber-plane") {
            let case = case(&source);
            for (i, point) in reference["states"].as_array().expect("states").iter().enumerate() {
                let (what, state) = (format!("{} at {i}", case.title), state_of(point));
                let found = evaluate_digits(&case, Some(&state), 1, 0, 30).expect("evaluated");
                for (k, rate) in point["v"].as_array().expect("v").iter().enumerate() {
                    same(&found.field[k], rate, &format!("{what}, v[{k}]"));
                }
                same(&found.divergence, &point["div_v"], &format!("{what}, divergence"));
                for (name, value, residual) in &found.claims {
                    if let Some(golden) = point["candidates"].get(name) {
                        same(&value[0], &golden["value"], &format!("{what}, {name}"));
                        same(
                            &residual[0],
                            &golden["residual"],
                            &format!("{what}, {name}, residual"),
                        );
                    }
                }
            }
        }
    }
    assert_eq!(compared, 9 * 3 * (6 + 1 + 6), "field, divergence, three candidates");
}
