//! Liouville's theorem in reports: systems to which it applies, and twins to which it does not.

use std::fs;
use std::path::PathBuf;

use assert_cmd::Command;
use serde_json::Value;

/// The report on a case as JSON.
fn report(case: &str) -> Value {
    let mut command = Command::cargo_bin("liouville").expect("the binary is built");
    command.current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let output = command.args(["report", case, "--json"]).output().expect("it runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// The report on a text.
fn report_of(name: &str, text: &str) -> Value {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("integrable");
    fs::create_dir_all(&folder).expect("a scratch folder");
    let path = folder.join(format!("{name}.toml"));
    fs::write(&path, text).expect("a scratch file");
    report(path.to_str().expect("a path"))
}

fn lines(found: &Value, key: &str) -> String {
    found["hierarchy"][key].as_array().map_or(String::new(), |own| {
        own.iter().filter_map(Value::as_str).collect::<Vec<_>>().join("\n")
    })
}

#[test]
fn a_lagrangian_top_is_integrable() {
    let found = report("classical/tops/lagrange-angles");
    let proof = &found["liouville"];
    assert_eq!((&proof["tori"], &proof["bracket"]), (&Value::from(3), &Value::from("momenta")));
    assert_eq!(proof["functions"][0], "energy");
    assert_eq!(proof["claim"]["kind"], "involution");
    assert_eq!(found["hierarchy"]["integrals"], "some", "what is counted stays");
    let grounds = lines(&found, "grounds");
    assert!(grounds.contains("Liouville's theorem: 3 integrals in involution"), "{grounds}");
    assert!(!grounds.contains("too few"), "{grounds}");
    let typical = lines(&found, "typical");
    assert!(typical.contains("torus of dimension 3") && !typical.contains("super"), "{typical}");
}

#[test]
fn more_integrals_make_closed_orbits() {
    let found = report("classical/kepler/plane");
    assert_eq!(found["liouville"]["tori"], 2);
    let typical = lines(&found, "typical");
    assert!(typical.contains("superintegrable: 3 independent integrals"), "{typical}");
    assert!(typical.contains("on such a torus, each motion on it is closed"), "{typical}");
    assert!(!typical.contains("two-dimensional tori"), "{typical}");
}

/// A particle in the potential U with its angular momentum L, by components.
fn central(potential: &str) -> String {
    format!(
        "title = 'particle'\n[state]\nq = 'vector(0.5..2)'\np = 'vector(-1..1)'\n[hamiltonian]\n\
         function = '(p,p)/2 + {potential}'\npairs = [['q', 'p']]\n[[claim]]\nname = 'L'\nintegral = 'q × p'\n"
    )
}

#[test]
fn squares_of_momenta_are_in_involution() {
    let found = report_of("central", &central("|q|³"));
    let functions = found["liouville"]["functions"].as_array().expect("a proof");
    let functions: Vec<&str> = functions.iter().filter_map(Value::as_str).collect();
    assert!(functions.contains(&"L[1]² + L[2]² + L[3]²"), "{functions:?}");
    let typical = lines(&found, "typical");
    assert!(typical.contains("4 independent integrals on a space of dimension 6"), "{typical}");
    assert!(typical.contains("of dimension at most 2"), "{typical}");
}

#[test]
fn too_few_integrals_or_another_time_are_not_integrable() {
    // Of the angular momentum a magnet along e₃ leaves one component.
    let text = central("|q|³ + q3").replace("q × p", "(q × p)[3]");
    let found = report_of("field", &text);
    assert!(found["liouville"].is_null(), "{}", found["liouville"]);
    assert!(!lines(&found, "grounds").contains("Liouville"), "two integrals of three");
    // The same orbits as two oscillators, with a time of its own for one: the bracket is not kept.
    let field = "title = 'oscillators'\n[state]\nx = '-1..1'\ny = '-1..1'\np = '-1..1'\nr = '-1..1'\n[field]\n\
                 \"x'\" = 'S*p'\n\"p'\" = '−S*x'\n\"y'\" = 'r'\n\"r'\" = '−y'\n[poisson]\n'x,p' = '1'\n'y,r' = '1'\n\
                 [[claim]]\nintegral = 'x² + p²'\n[[claim]]\nintegral = 'y² + r²'\n";
    let kept = report_of("kept", &field.replace('S', "1"));
    assert_eq!(kept["liouville"]["bracket"], "poisson");
    let broken = report_of("broken", &field.replace('S', "(1 + x²)"));
    assert!(broken["liouville"].is_null(), "{}", broken["liouville"]);
}

#[test]
fn equations_by_component_have_their_names() {
    let text = "title = 'turn'\n[state]\nq = 'vector(2, -1..1)'\n[field]\n\"q[1]'\" = 'q2'\n\"q[2]'\" = '−q1'\n\
                [[claim]]\nname = 'rest'\nfixed-point = {}\nspectrum = ['± i']\n".replace("± i", "± 1*i");
    let found = report_of("turn", &text);
    assert_eq!(found["description"]["equations"][0], "q1' = q2");
    let rest = found["claimed"].as_array().and_then(|own| own.last()).expect("a claim");
    let remark = rest["remark"].as_str().unwrap_or_default();
    assert!(remark.contains("at 0; spectrum"), "{remark}");
}

#[test]
fn variables_that_exchange_are_reversors() {
    let text = "title = 'Lotka and Volterra'\n[parameters]\na = 0.0121505856\n[state]\nx = '0.1..2'\ny = '0.1..2'\n\
                [field]\n\"x'\" = 'a*x*(1 − y)'\n\"y'\" = 'a*y*(x − 1)'\n";
    let found = report_of("exchange", text);
    let reversors = found["reversors"].as_array().expect("a list");
    let exchange = reversors.iter().find(|own| own["name"] == "reversor x → y, y → x");
    let exchange = exchange.unwrap_or_else(|| panic!("{reversors:?}"));
    assert_eq!(
        (&exchange["verdict"], &exchange["fixed_set"]["dimension"]),
        (&"proved".into(), &1.into())
    );
    assert_eq!(found["description"]["parameters"][0], "a = 0.0121505856");
}

#[test]
fn a_rotor_leaves_two_integrals_of_a_body_of_revolution() {
    let found = report("spin/revolution-gyrostat");
    let rates = found["rates"].as_array().expect("a list");
    assert_eq!(rates.len(), 2, "{rates:?}");
    let independent = found["independence"]["independent"].to_string();
    assert!(independent.contains("second linear integral"), "{independent}");
}
