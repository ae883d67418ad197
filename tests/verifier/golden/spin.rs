//! Bodies that roll without slipping and may spin, compared with reference values.

use liouville::number::rational::Rational;
use liouville::verdict::evaluate_digits;
use serde_json::Value;

use crate::common::{Reference, case, claim, claim_text, exact, rational, report, strings, text};

const SPIN: &str = include_str!("../../data/spin.json");

/// Writes a support function or a potential of the reference in the names of a case.
fn formula(reference: &str) -> String {
    let greek = reference.replace("g1", "γ1").replace("g2", "γ2").replace("g3", "γ3");
    greek.replace("**", "^")
}

/// Writes a list of numbers, or of rows, as a value of TOML with exact entries.
fn matrix(name: &str, value: &Value) -> String {
    let rows: Vec<String> = value
        .as_array()
        .expect("a tensor")
        .iter()
        .map(|row| match row {
            Value::Array(_) => format!("[{}]", strings(row).join(", ")),
            entry => text(entry).to_string(),
        })
        .collect();
    let inner = rows.join(", ");
    match value[0].is_array() {
        true => format!("{name} = \"[{inner}]\"\n"),
        false => format!("{name} = \"diag([{inner}])\"\n"),
    }
}

fn case_text(reference: &Value) -> String {
    let params = &reference["params"];
    let (surface, k) = (&params["surface"], text(&params["k"]));
    let system = if k == "0" { "rolling-plane" } else { "rolling-sphere" };
    let mut out = format!(
        "title = \"{}\"\nsystem = \"{system}\"\ncheck-weights = false\n[parameters]\nm = \"{}\"\n",
        text(&reference["id"]),
        text(&params["m"])
    );
    out.push_str(&matrix("I", &params["I"]));
    let rotor = strings(&params["gyrostat_S"]).join(", ");
    out.push_str(&format!("S = \"vec({rotor})\"\n"));
    if k != "0" {
        out.push_str(&format!("k = \"{k}\"\n"));
    }
    let shape = match text(&surface["type"]) {
        "ball" => {
            let centre = strings(&surface["c"]).join(", ");
            out.push_str(&format!("R = \"{}\"\nc = \"vec({centre})\"\n", text(&surface["R"])));
            "shape = \"ball\"".to_string()
        }
        "ellipsoid" => {
            out.push_str(&matrix("B", &surface["B"]));
            "shape = \"ellipsoid\"".to_string()
        }
        _ => format!("support = \"{}\"", formula(text(&surface["h"]))),
    };
    let potential = match text(&params["potential"]) {
        "0" => String::new(),
        weight if weight.starts_with("gravity") => "potential = \"49/5*m*h\"\n".to_string(),
        other => format!("potential = \"{}\"\n", formula(other)),
    };
    out.push_str(&format!("[body]\n{shape}\ngyrostat = \"S\"\n{potential}"));
    for (name, formula) in CANDIDATES {
        out.push_str(&claim_text(name, "integral", formula));
    }
    out + &claim_text("det Ĩ", "integral", "det(Ĩ)")
}

const CANDIDATES: [(&str, &str); 3] = [("E", "energy"), ("F0", "(γ,γ)"), ("F1", "(ω,γ)")];

#[test]
fn bodies_that_spin() {
    let data: Value = serde_json::from_str(SPIN).expect("JSON");
    let mut compared = 0;
    for reference in data["cases"].as_array().expect("cases") {
        let case = case(&case_text(reference));
        let flat = case.system == "rolling-plane";
        for (i, point) in reference["states"].as_array().expect("states").iter().enumerate() {
            let what = format!("{} at {i}", case.title);
            let numbers = strings(&point["x"]);
            let state: Vec<Rational> = numbers.into_iter().map(|x| rational(&exact(x))).collect();
            let found = report(&case, &state);
            let mut check = |reference: &Value, enclosure, name: &str| {
                let golden = Reference::read(text(reference));
                golden.assert_in(enclosure, &format!("{what}, {name}"));
                compared += 1;
            };
            for (k, rate) in point["v"].as_array().expect("v").iter().enumerate() {
                check(rate, found.field[k], &format!("v[{k}]"));
            }
            check(&point["div_v"], found.divergence, "div v");
            check(&point["div_v"], found.level_divergence, "div v on the level");
            if flat {
                let chi = found.chi.expect("χ");
                for (k, reference) in point["chi"].as_array().expect("χ").iter().enumerate() {
                    check(reference, chi[k], &format!("χ[{k}]"));
                }
            }
            let digits = evaluate_digits(&case, Some(&state), 1, 0, 30).expect("evaluated");
            for (k, rate) in point["v"].as_array().expect("v").iter().enumerate() {
                let ours = digits.field[k].as_deref().expect("a rate");
                assert_eq!(exact(ours), exact(text(rate)), "{what}, v[{k}] to thirty digits");
            }
            let [along, across] = found.conditions.expect("C₁ and C₂");
            check(&point["C1"], along, "C₁");
            check(&point["C2"], across, "C₂");
            check(&point["detItilde"], claim(&found, "det Ĩ").0, "det Ĩ");
            for (name, _) in CANDIDATES {
                let (value, residual) = claim(&found, name);
                check(&point["candidates"][name]["value"], value, name);
                check(&point["candidates"][name]["residual"], residual, &format!("{name}'"));
            }
        }
    }
    assert_eq!(compared, 6 * 3 * (6 + 2 + 2 + 1 + 6) + 4 * 3 * 3, "χ is compared on the plane");
}
