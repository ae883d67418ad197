//! Parameters with a list of values: theorems and conditions for each of them.

use liouville_search::{
    Ansatz, ConditionTarget, Effort, FoundKind, Given, Hamiltonians, Remark, SearchReport, search,
};

use crate::ansatz::{case, effort};

fn searched(text: &str, effort: &Effort) -> SearchReport {
    search(&case(text), effort, &mut |_| {}).expect("it can be searched")
}

fn with_ansatz(degree: u32, positions: u32) -> Effort {
    let ansatz = Ansatz { wanted: true, positions, ..Ansatz::default() };
    Effort { ansatz, ..effort(degree) }
}

/// Theorems of an ansatz by the values that they are for, with the dimension.
fn dimensions(report: &SearchReport) -> Vec<(&str, usize)> {
    let own = report.excluded.iter().filter(|own| own.ansatz.starts_with("polynomials of degree"));
    own.map(|own| (own.theorem.split(", ").next().unwrap_or_default(), own.dimension)).collect()
}

/// Equations of the conditions, by what they are for.
fn conditions(report: &SearchReport) -> Vec<(&str, Vec<&str>)> {
    let own = report.conditions.iter().filter(|own| !own.of.starts_with("the density 1"));
    own.map(|own| (own.of.as_str(), own.equations.iter().map(String::as_str).collect())).collect()
}

#[test]
fn theorems_of_an_ansatz_hold_for_their_values() {
    let rest = "title = 'x'\n[parameters]\na = 'one of 1, 0'\n[state]\nx = '-2..2'\n[field]\n\"x'\" = 'a'\n";
    let report = searched(rest, &with_ansatz(1, 2));
    // Of 1, x and x² all are integrals where a = 0.
    assert_eq!(dimensions(&report), [("For a = 1", 1), ("For a = 0", 3)]);
    let with = |text: &str| {
        let found =
            report.found.iter().find(|own| own.kind == FoundKind::Integral && own.text() == text);
        found.map(|own| own.with.clone())
    };
    assert_eq!(with("x"), Some(vec![Given::Value("a = 0".to_string())]), "{:?}", report.found);
    assert!(report.excluded.iter().all(|own| own.ansatz.contains(", for a = ")));

    let oscillators = "title = 'x'\n[parameters]\na = 'one of 4, 1'\n[state]\nx = '-2..2'\ny = '-2..2'\n\
                       \"x'\" = '-2..2'\n\"y'\" = '-2..2'\n[lagrangian]\nkinetic = \"(x'²+y'²)/2\"\n\
                       potential = 'x²/2+a*y²/2'\n";
    let report = searched(oscillators, &with_ansatz(1, 2));
    assert_eq!(dimensions(&report), [("For a = 4", 1), ("For a = 1", 2)]);

    // What holds for each value is said once.
    let both = rest.replace("one of 1, 0", "one of 1, 2");
    let report = searched(&both, &with_ansatz(1, 2));
    assert_eq!(dimensions(&report), [("For each of the listed values", 1)]);
}

#[test]
fn theorems_on_a_body_agree_with_its_counts() {
    let ball = "title = 'b'\nsystem = 'rubber-sphere'\n[parameters]\nm = 1\nR = 1\nI = [1,2,3]\n\
                k = 'one of 1, -2'\n[body]\nshape = 'ball'\n";
    let report = searched(ball, &with_ansatz(2, 4));
    let counted = report.counts.iter().find(|own| own.degree == 2).expect("a count").dimension;
    // κ = −1 has an integral besides the energy.
    assert_eq!(counted, 2);
    let own = dimensions(&report);
    assert!(own.iter().all(|(value, _)| *value != "For generic values of the free parameters"));
    assert!(own.contains(&("For k = -2", 2)) || own.contains(&("For k = −2", 2)), "{own:?}");
}

#[test]
fn rotors_are_counted_for_the_first_values() {
    let ball = "title = 'b'\nsystem = 'rubber-plane'\n[parameters]\nm = 'one of 1, 2'\nR = 1\nI = [1,2,3]\n\
                [body]\nshape = 'ball'\n";
    let ansatz = Ansatz { gyrostats: true, ..Ansatz::default() };
    let report = searched(ball, &Effort { ansatz, ..effort(2) });
    let own = report.excluded.iter().filter(|own| own.ansatz.starts_with("rotors"));
    let rotors: Vec<&str> = own.map(|own| own.theorem.as_str()).collect();
    assert_eq!(rotors.len(), 1, "{rotors:?}");
    let start =
        "For m = 1, the first of its values, and the given values of the fixed parameters, ";
    assert!(rotors[0].starts_with(start), "{rotors:?}");
}

#[test]
fn brackets_are_excluded_for_their_values() {
    let field = "title = 'x'\n[parameters]\na = 'one of 1, 0'\n[state]\nx = '0.5..2'\ny = '0.5..2'\n[field]\n\
                 \"x'\" = 'y'\n\"y'\" = 'a'\n";
    let poisson = Some(Hamiltonians::Given("y²/2".into()));
    let report = searched(field, &Effort { poisson, ..effort(0) });
    let all = report.excluded.iter().map(|own| own.theorem.as_str());
    let theorems: Vec<&str> = all.filter(|own| own.contains("there is no skew P")).collect();
    assert_eq!(theorems.len(), 1, "{theorems:?}");
    assert!(theorems[0].starts_with("For a = 1, there is no skew P"), "{theorems:?}");
    let bracket =
        report.found.iter().find(|own| own.kind == FoundKind::Bracket).expect("for a = 0");
    assert_eq!(bracket.text(), "{x,y} = 1");
    assert!(bracket.with.contains(&Given::Value("a = 0".to_string())), "{:?}", bracket.with);
}

#[test]
fn conditions_for_a_claim_are_those_of_each_value() {
    let body = "[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'RATE'\n\"y'\" = 'b*x'\n[[claim]]\n\
                name = 'C'\nintegral = 'x²-y²'\n";
    let field = format!("title = 'x'\n[parameters]\na = 'one of 1, 2'\nb = '1..2'\n{body}");
    let wanted = Effort { conditions: Some(ConditionTarget::Claim("C".to_string())), ..effort(0) };
    let report = searched(&field.replace("RATE", "a*y"), &wanted);
    let told = conditions(&report);
    assert_eq!(told, [("C, for a = 1", vec!["1 − b = 0"]), ("C, for a = 2", vec!["2 − b = 0"])]);
    // One that needs no condition for some value says so.
    let report = searched(&field.replace("RATE", "b*y + (a-1)*(b-3)"), &wanted);
    assert_eq!(conditions(&report), [("C, for a = 2", vec!["3 − b = 0"])]);
    let note = "C: no condition is needed for a = 1";
    assert!(report.remarks.iter().any(|own| own.text == note), "{:?}", report.remarks);
    // Of many combinations the first is named.
    let many = field.replace("one of 1, 2", "one of 1, 2, 3, 4, 5, 6, 7, 8, 9");
    let report = searched(&many.replace("RATE", "a*y"), &wanted);
    assert_eq!(conditions(&report), [("C, for a = 1, the first of its values", vec!["1 − b = 0"])]);
}

#[test]
fn conditions_of_a_lagrangian_are_those_of_each_value() {
    let oscillators = "title = 'x'\n[parameters]\na = 'one of 1, 4'\nb = '1..2'\n[state]\nx = '-2..2'\n\
                       y = '-2..2'\n\"x'\" = '-2..2'\n\"y'\" = '-2..2'\n[lagrangian]\n\
                       kinetic = \"(x'²+y'²)/2\"\npotential = 'a*x²+b*y²'\n";
    let wanted = Effort { conditions: Some(ConditionTarget::Existence), ..effort(1) };
    let report = searched(oscillators, &wanted);
    let of =
        |value: &str| format!("more integrals of degree 1, by the value of b, for a = {value}");
    let told = conditions(&report);
    assert_eq!(told[0], (of("1").as_str(), vec!["b = 0", "b = 1"]), "{told:?}");
    assert_eq!(told[1], (of("4").as_str(), vec!["b = 0", "b = 4"]), "{told:?}");
}

#[test]
fn relations_along_orbits_are_told_for_each_value() {
    // An oscillator has the integral x² + a y² for all a, and friction b where b is not 0.
    let field = "title = 'x'\n[parameters]\na = '1..2'\nb = 'one of 1, 0'\n[state]\nx = '-2..2'\n\
                 y = '-2..2'\n[field]\n\"x'\" = 'a*y'\n\"y'\" = '-x - b*y³'\n";
    let report = searched(field, &Effort { by_class: false, ..effort(0) });
    let found = report.found.iter().find(|own| own.kind == FoundKind::Integral).expect("for b = 0");
    assert_eq!(found.with, [Given::Value("b = 0".to_string())], "{found:?}");
    let counted = |text: &str| report.remarks.iter().any(|own| own.contains(text));
    assert!(counted("counted for b = 1, the first of its values"), "{:?}", report.remarks);
    let is_told =
        |own: &str| own.starts_with("for b = 0, ") && own.ends_with(": 1 algebraic integral");
    assert!(report.remarks.iter().any(|own| is_told(own)), "{:?}", report.remarks);
    let theorems: Vec<&String> = report.excluded.iter().map(|own| &own.theorem).collect();
    let for_one = |own: &&&String| own.starts_with("For b = 1, and generic values of the free");
    assert!(theorems.iter().filter(for_one).count() > 0, "{theorems:?}");
    let is_false = |own: &&String| {
        own.contains("no fraction P/Q")
            && own.contains("degree at most 8")
            && !own.starts_with("For b = 1,")
    };
    assert!(!theorems.iter().any(is_false), "{theorems:?}");
    // Where all values have as many this is said.
    let report = searched(&field.replace("one of 1, 0", "one of 1, 2"), &effort(0));
    let same = |own: &Remark| own.ends_with("as many for each of the listed values");
    assert!(report.remarks.iter().any(same), "{:?}", report.remarks);
    let each = |own: &str| own.starts_with("For each of the listed values, and generic");
    assert!(report.excluded.iter().any(|own| each(&own.theorem)), "{:?}", report.excluded);
}

#[test]
fn conditions_of_a_field_are_those_of_each_value() {
    let field = "title = 'x'\n[parameters]\nk = 'one of 1, 2'\na = '1..2'\nb = '1..2'\n[state]\n\
                 x = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = '(a - k)*x + b*y'\n\"y'\" = '-x*y'\n";
    let wanted = Effort { conditions: Some(ConditionTarget::Existence), ..effort(1) };
    let report = searched(&field.replace("-x*y", "(a - k)*y"), &wanted);
    let own: Vec<(&str, Vec<&str>)> = conditions(&report);
    let of = |value: &str| {
        format!("more polynomial integrals of degree at most 1, by a, b, for {value}")
    };
    let told = |value: &str| {
        let found = own.iter().find(|(text, _)| *text == of(value));
        found.map(|(_, equations)| equations.clone()).unwrap_or_default()
    };
    assert_eq!(told("k = 1"), ["a = 1"], "{own:?}");
    assert_eq!(told("k = 2"), ["a = 2"], "{own:?}");
    let with = |own: &liouville_search::Found| own.with.clone();
    let finds: Vec<_> = report.found.iter().map(with).collect();
    let value = |number: i64| {
        vec![Given::Condition(format!("a = {number}")), Given::Value(format!("k = {number}"))]
    };
    assert!(finds.contains(&value(1)) && finds.contains(&value(2)), "{finds:?}");
    // What does not depend on the value is told once.
    let report = searched(&field.replace("(a - k)*x + b*y", "a*x + b*y + 0*k"), &wanted);
    let own = conditions(&report);
    assert!(own.iter().all(|(text, _)| text.ends_with("for each of the listed values")), "{own:?}");
    assert!(!own.is_empty());
}
