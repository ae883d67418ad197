//! User-defined fields compared with reference values from 100-digit arithmetic.
//!
//! The reference writes its systems in a language close to ours; the differences are listed in
//! [`translated`], entries without a counterpart in [`SKIPPED`].

use std::collections::BTreeMap;

use crate::common::{Reference, case, claim, exact, rational, report, strings, text};
use liouville::case::Case;
use liouville::verdict::{Enclosed, PointReport};
use serde_json::Value;

const OTHERS: &str = include_str!("../data/others.json");

/// Kinds of candidates without a claim here, with their number and the reason.
const SKIPPED: [(&str, usize, &str); 1] =
    [("no_smooth_measure_witness", 1, "v = 0 ≠ div v there, which is compared at every state")];

/// Translates a formula of the reference: a matrix is written by rows in square brackets.
fn translated(formula: &str) -> String {
    formula
        .replace("mat((", "mat([")
        .replace("), (", "], [")
        .replace("))", if formula.starts_with("mat((") { "])" } else { "))" })
}

/// Returns equations of the level set to which densities refer.
fn level(system: &str) -> &'static str {
    match system {
        "ball_quadric"
        | "ball_revolution_paraboloid"
        | "ball_rotating_sphere"
        | "ball_revolution_paraboloid_trap" => "[level]\nequations = [\"dot(gamma,gamma) = 1\"]\n",
        "suslov_onesided_contact" => "[level]\nequations = [\"dot(w,e) = 0\"]\n",
        _ => "",
    }
}

/// Returns the entries of a JSON object of strings.
fn entries(object: &Value) -> Vec<(&str, &str)> {
    let object = object.as_object().expect("an object");
    object.iter().map(|(name, value)| (name.as_str(), text(value))).collect()
}

/// Returns the state variables: `M1, M2, M3` are the vector M where the field gives its rate.
fn variables(system: &Value) -> Vec<(&str, bool)> {
    let mut names: Vec<(&str, bool)> = Vec::new();
    for component in strings(&system["variables"]) {
        let vector = component.strip_suffix(['1', '2', '3']).filter(|stem| {
            system["vector_field"].get(component).is_none()
                && system["vector_field"].get(stem).is_some()
        });
        let name = (vector.unwrap_or(component), vector.is_some());
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// Returns the parameters in an order in which each uses earlier ones only: plain numbers first.
fn parameters(system: &Value) -> Vec<(&str, &str)> {
    let mut all = entries(&system["parameters"]);
    let depth = |formula: &str| match formula {
        plain if plain.chars().all(|c| c.is_ascii_digit() || "/-.".contains(c)) => 0,
        root if root.contains("sqrt") || root.contains("inv") => 2,
        _ => 1,
    };
    all.sort_by_key(|(_, formula)| depth(formula));
    all
}

fn case_of(system: &Value) -> Case {
    let key = text(&system["key"]);
    let mut lines = format!("title = \"{key}\"\nsystem = \"field\"\ncheck-weights = false\n");
    lines.push_str("[parameters]\n");
    for (name, formula) in parameters(system) {
        lines.push_str(&format!("{name} = \"{formula}\"\n"));
    }
    lines.push_str("[state]\n");
    for (name, vector) in variables(system) {
        let range = if vector { "vector(-2..2)" } else { "-2..2" };
        lines.push_str(&format!("{name} = \"{range}\"\n"));
    }
    lines.push_str("[let]\n");
    for definition in system["definitions"].as_array().expect("definitions") {
        let [name, formula] = strings(definition)[..] else { panic!("a name and a formula") };
        lines.push_str(&format!("{name} = \"{}\"\n", translated(formula)));
    }
    lines.push_str("[field]\n");
    for (name, formula) in entries(&system["vector_field"]) {
        lines.push_str(&format!("\"{name}'\" = \"{}\"\n", translated(formula)));
    }
    lines.push_str(level(key));
    for (number, candidate) in candidates(system).iter().enumerate() {
        for (part, (kind, place, formula)) in claims(candidate).into_iter().enumerate() {
            lines.push_str(&format!(
                "[[claim]]\nname = \"{number}, {part}\"\n{kind} = {formula}\nwhere = \"{place}\"\n"
            ));
        }
    }
    case(&lines)
}

fn candidates(system: &Value) -> &Vec<Value> {
    system["candidates"].as_array().expect("candidates")
}

/// Returns the claims whose values and residuals make up a candidate's residual: kind, place, and
/// the text after the kind in a case file.
fn claims(candidate: &Value) -> Vec<(&'static str, &'static str, String)> {
    let formula = |key: &str| translated(text(&candidate[key]));
    let quoted = |formula: String| format!("\"{formula}\"");
    let everywhere = |formula: String| ("integral", "everywhere", quoted(formula));
    let table = |key: &str| {
        let pairs: Vec<String> = entries(&candidate[key])
            .into_iter()
            .map(|(name, formula)| format!("{name} = \"{}\"", translated(formula)))
            .collect();
        format!("{{ {} }}", pairs.join(", "))
    };
    match text(&candidate["kind"]) {
        "involution" if candidate["sign"] == "1" => vec![("symmetry", "everywhere", table("map"))],
        "involution" => vec![("reversor", "everywhere", table("map"))],
        "symmetry" => {
            let weight = candidate["factor"].as_str().unwrap_or("0");
            let lines = format!("{}\nweight = \"{weight}\"", table("field"));
            vec![("symmetry-field", "everywhere", lines)]
        }
        "integral" => vec![everywhere(formula("expr"))],
        "density" => vec![("density", "everywhere", quoted(formula("expr")))],
        "density_on_level" => vec![("density", "level", quoted(formula("expr")))],
        // A root has no enclosure at 0: the square of a norm replaces the norm.
        "identity" => match formula("expr").strip_prefix("norm") {
            Some(inside) => vec![everywhere(format!("({inside})^2"))],
            None => vec![everywhere(formula("expr"))],
        },
        "derivative" => vec![everywhere(formula("expr")), everywhere(formula("rhs"))],
        "darboux" => {
            let multiple = format!("({})*({})", formula("cofactor"), formula("expr"));
            vec![everywhere(formula("expr")), everywhere(multiple)]
        }
        _ => Vec::new(),
    }
}

/// Encloses a candidate's residual.
fn residual(candidate: &Value, number: usize, found: &PointReport) -> Enclosed {
    let part = |part: usize| claim(found, &format!("{number}, {part}"));
    match text(&candidate["kind"]) {
        "identity" => part(0).0,
        "derivative" | "darboux" => {
            let ((a, ra), (b, rb)) = (part(0).1?, part(1).0?);
            // The difference and the sum of the radii are rounded.
            Some((a - b, (ra + rb + f64::EPSILON * (a - b).abs()) * (1.0 + 4.0 * f64::EPSILON)))
        }
        _ => part(0).1,
    }
}

/// Returns the enclosures of the components of a claim's residual.
fn residuals_of<'r>(found: &'r PointReport, name: &str) -> &'r [Enclosed] {
    let claim = found.claims.iter().find(|(known, _, _)| known == name);
    claim.map_or(&[], |(_, _, residual)| residual)
}

/// Returns the exact numbers of a state in the order of the variables.
fn state_of(system: &Value, state: &Value) -> Vec<liouville::number::rational::Rational> {
    let exactly = &state["exact"];
    variables(system)
        .into_iter()
        .flat_map(|(name, vector)| match vector {
            true => strings(&exactly[name]),
            false => vec![text(&exactly[name])],
        })
        .map(|number| rational(&exact(number)))
        .collect()
}

#[test]
fn typed_fields_agree_with_the_reference() {
    let data: Value = serde_json::from_str(OTHERS).expect("JSON");
    let (mut systems, mut judged, mut residuals, mut refuted) = (0, 0, 0, 0);
    let mut skipped: BTreeMap<&str, usize> = BTreeMap::new();
    for system in data["systems"].as_array().expect("systems") {
        let key = text(&system["key"]);
        let case = case_of(system);
        let states = system["states"].as_array().expect("states");
        let reports: Vec<_> =
            states.iter().map(|state| report(&case, &state_of(system, state))).collect();
        for (i, (state, found)) in states.iter().zip(&reports).enumerate() {
            for (k, rate) in strings(&state["v"]).into_iter().enumerate() {
                Reference::read(rate).assert_in(found.field[k], &format!("{key} at {i}: v[{k}]"));
            }
            Reference::read(text(&state["div_v"]))
                .assert_in(found.divergence, &format!("{key} at {i}: div v"));
        }
        for (number, candidate) in candidates(system).iter().enumerate() {
            if claims(candidate).is_empty() {
                *skipped.entry(text(&candidate["kind"])).or_default() += 1;
                continue;
            }
            judged += 1;
            let used = candidate["states_used"].as_array().expect("states used");
            if matches!(text(&candidate["kind"]), "involution" | "symmetry") {
                let all = candidate["residuals"].as_array().expect("residuals");
                let mut is_zero = true;
                for (i, losses) in used.iter().zip(all) {
                    let found = &reports[i.as_u64().expect("an index") as usize];
                    let own = residuals_of(found, &format!("{number}, 0"));
                    for (k, loss) in strings(losses).into_iter().enumerate() {
                        let what = format!("{key} at {i}: {}, component {k}", candidate["name"]);
                        let loss = Reference::read(loss);
                        loss.assert_in(own[k], &what);
                        is_zero &= loss.is_zero();
                        residuals += 1;
                    }
                }
                assert_eq!(is_zero, candidate["expected"] == "true", "{}", candidate["name"]);
                refuted += usize::from(!is_zero);
                continue;
            }
            let losses = strings(&candidate["residuals"]);
            assert_eq!(used.len(), losses.len(), "a residual for each state that is used");
            for (k, (i, loss)) in used.iter().zip(losses).enumerate() {
                let found = &reports[i.as_u64().expect("an index") as usize];
                let what = format!("{key} at {i}: {}", candidate["name"]);
                if let Some(value) = candidate["values"][k].as_str() {
                    let enclosure = claim(found, &format!("{number}, 0")).0;
                    Reference::read(value).assert_in(enclosure, &what);
                }
                let loss = Reference::read(loss);
                loss.assert_in(residual(candidate, number, found), &format!("{what}, residual"));
                let holds = candidate["expected"] == "true";
                assert_eq!(loss.is_zero(), holds, "{what}: as the reference says");
                residuals += 1;
                refuted += usize::from(!holds);
            }
        }
        systems += 1;
    }
    assert_eq!((systems, judged), (9, 121), "systems and candidates that are covered");
    assert_eq!((residuals, refuted), (620, 135), "residuals compared, and those that are not 0");
    let reasons: BTreeMap<&str, usize> = SKIPPED.iter().map(|(kind, n, _)| (*kind, *n)).collect();
    assert_eq!(skipped, reasons, "nothing is left out without a reason");
}
