//! The order of lines in [let], [parameters] and [state] has no meaning.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn verdicts(text: &str) -> Vec<Verdict> {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report =
        judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    report.claims.iter().map(|claim| claim.verdict).collect()
}

/// A still system with these tables, and an identity.
fn still(tables: &str, identity: &str) -> String {
    format!(
        "title = 't'\ncheck-weights = false\n{tables}\n[field]\n\"x'\" = '0'\n\"y'\" = '0'\n[[claim]]\n\
         identity = '{identity}'\nexpect = 'open'\n"
    )
}

#[test]
fn names_that_hide_numbers_and_components_are_read_first() {
    let state = "[state]\nx = '1..2'\ny = '1..2'";
    let lets = [
        (["\"π\" = 'x + y'", "u = '2*π'"], "u = 2*x + 2*y"),
        (["e = 'x'", "u = 'e^2'"], "u = x^2"),
        (["\"π\" = '3*x'", "u = 'pi*y'"], "u = 3*x*y"),
    ];
    for (lines, identity) in lets {
        for order in [[0, 1], [1, 0]] {
            let lines = order.map(|k| lines[k]).join("\n");
            let text = still(&format!("{state}\n[let]\n{lines}"), identity);
            assert_eq!(verdicts(&text), [Verdict::Proved], "{text}");
        }
    }
    let parameters = [
        (["r = '2*e'", "e = '1..2'"], "r = 2*e"),
        (["c = 'vector(1..2)'\nu = '2*c1'", "c1 = '3..4'"], "u = 2*c1"),
    ];
    for (lines, identity) in parameters {
        for order in [[0, 1], [1, 0]] {
            let lines = order.map(|k| lines[k]).join("\n");
            let text = still(&format!("[parameters]\n{lines}\n{state}"), identity);
            assert_eq!(verdicts(&text), [Verdict::Proved], "{text}");
        }
    }
    let state = "[state]\nv = 'vector(1..2)'\nx = '1..2'\ny = '1..2'";
    for lines in ["v1 = 'y'\nu = '2*v1'", "u = '2*v1'\nv1 = 'y'"] {
        let text = still(&format!("{state}\n[let]\n{lines}"), "u = 2*y");
        let text = text.replace("\"x'\" = '0'", "\"v'\" = '[0, 0, 0]'\n\"x'\" = '0'");
        assert_eq!(verdicts(&text), [Verdict::Proved], "{text}");
    }
}

#[test]
fn names_that_hide_each_other_are_a_mistake() {
    let text = still("[state]\nx = '1..2'\ny = '1..2'\n[let]\ne = '2*π'\n\"π\" = 'e/2'", "e = 2*π");
    let error = Case::parse(&text, &[]).expect_err("a circle").to_string();
    assert!(error.contains("→"), "{error}");
}

#[test]
fn multipliers_belong_to_constraints_in_the_order_of_their_list() {
    let text = |state: &str, list: &str| {
        format!(
            "title = 't'\nsystem = 'vakonomic'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n\
             \"x'\" = '-2..2'\n\"y'\" = '-2..2'\n\"z'\" = '-2..2'\n{state}\n[lagrangian]\n\
             kinetic = \"(x'^2 + y'^2 + z'^2)/2\"\nconstraints = [\"x' - z*z' = 0\", \"y' - z^2*z' = 0\"]\n\
             multipliers = {list}\n[[claim]]\nintegral = \"x' - a\"\nexpect = 'open'\n[[claim]]\n\
             integral = \"x' - b\"\nexpect = 'open'\n"
        )
    };
    let (first, second) = ("a = '-2..2'\nb = '-2..2'", "b = '-2..2'\na = '-2..2'");
    for state in [first, second] {
        let found = verdicts(&text(state, "['a', 'b']"));
        assert_eq!(found, [Verdict::Proved, Verdict::Refuted], "{state}");
        let found = verdicts(&text(state, "['b', 'a']"));
        assert_eq!(found, [Verdict::Refuted, Verdict::Proved], "{state}");
    }
}
