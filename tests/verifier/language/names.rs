//! Names: in any order, lists by their use, numbers that do not change.

use liouville::case::Case;
use liouville::verdict::{Options, judge};

use crate::language::{error, settled};

#[test]
fn lists_are_vectors_or_diagonal_matrices_by_their_use() {
    settled(
        r#"
title = "lists"
[parameters]
I = [1, 2, 3]
A = [2, 5, 7]
c = [1, 1, 2]
J = "A*I"
[state]
M = "vector(-2..2)"
[field]
"M'" = "M × A⁻¹*M"
[[claim]]
integral = "(M, A⁻¹*M)"
[[claim]]
identity = "(c,c) + I1*A2 = 11"
[[claim]]
identity = "(J, [1,1,1]) = 33"
"#,
    );
    let both =
        "title = 't'\n[parameters]\nA = [1,2,3]\n[state]\nx = '0..1'\n[field]\n\"x'\" = '1'\n";
    let claims = "[[claim]]\nintegral = 'tr(A)'\n[[claim]]\nintegral = '(A,A)'\n";
    let told = error(&format!("{both}{claims}"));
    assert_eq!(told.len(), 1, "{told:?}");
    let message = "the list `A` is a vector in other formulas, and a diagonal matrix in this one";
    assert_eq!((told[0].0, told[0].1.as_str()), (9, message));
    let late = "title = 't'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nR = 2\nI = [1, 2, 2.5]\n\
                [body]\nshape = 'ball'\n[let]\nX = 'I*ω'\n[[claim]]\nintegral = '(X,γ) + foo'\n[[claim]]\n\
                integral = '(X,X) + bar'\n[[claim]]\nintegral = '(γ,γ) + ω3'\n";
    let told = error(late);
    let lines: Vec<usize> = told.iter().map(|(line, _, _)| *line).collect();
    assert_eq!(lines, [12, 14, 16], "other mistakes do not mislead: {told:?}");
    assert!(told[2].1.contains("unequal weight"), "{told:?}");
    let unequal = error(&late.replace(" + foo", "").replace(" + bar", ""));
    assert!(unequal[0].1.contains("unequal weight"), "{unequal:?}");
    let ball = "title = 't'\nsystem = 'rubber-plane'\n[body]\nshape = 'ball'\n[parameters]\nm = 1\n\
                R = 1\nI = [1, 2, 2]\n";
    let claim = "[[claim]]\nintegral = 'energy'\nwhere = 'on the level'\n";
    let told = error(&format!("{ball}{claim}{claim}"));
    assert_eq!(told.len(), 2, "{told:?}");
    for (_, message, _) in &told {
        assert_eq!(message, "`on the level` is not a place of this case");
    }
    let set = |value: &str| {
        let setting = liouville::case::Setting { name: "I".into(), value: value.into() };
        let text = "title = 't'\nsystem = 'rubber-plane'\n[parameters]\nm = 1\nR = 2\n\
                    I = [1, 2, 2.5]\n[body]\nshape = 'ball'\n[[claim]]\nintegral = 'energy'\n";
        Case::parse(text, &[setting]).map(|case| case.model.parameters[2].kind)
    };
    assert_eq!(set("[3,4,5]").ok(), Some(liouville::formula::Type::MATRIX), "as in the file");
    assert!(set("[3,4]").is_err(), "of its size");
}

#[test]
fn names_stand_in_any_order() {
    settled(
        r#"
title = "order"
[let]
third = "second*v"
second = "first + k"
first = "2*a"
v = "x'*a"
[parameters]
b = "a² + c"
a = "c/2"
n = "2*m + 1"
m = 2
k = "first/a"
c = "1..2"
[state]
x = "vector(n, 0.5..1)"
[field]
"x[i]'" = "i*a*x[i]"
[[claim]]
identity = "third = second*a²*vector(i, 1..n, i*x[i])"
where = "everywhere"
[[claim]]
identity = "b − a² = 2*a + 0*k"
where = "everywhere"
"#,
    );
    settled(
        r#"
title = "abbreviations in a chart"
[parameters]
r = "1..2"
[let]
square = "r²"
[state]
x = "-1..1"
y = "-1..1"
[field]
"x'" = "−y"
"y'" = "x"
[level]
equations = ["x² + y² = square"]
[level.chart]
inputs = { u = "-1..1" }
x = "r*(1 − u²)/(1 + u²)"
y = "2*r*u/(1 + u²) + square − square"
[[claim]]
identity = "x² + y² = square"
"#,
    );
    let cycle = error(
        "title = 't'\n[parameters]\na = 'b + 1'\nb = 'c'\nc = '2*a'\n[state]\nx = '0..1'\n[field]\n\"x'\" = 'a*b*c'\n",
    );
    assert_eq!(cycle.len(), 1, "{cycle:?}");
    assert_eq!(cycle[0].1, "`a` is defined in terms of itself: a → b → c → a");
}

#[test]
fn a_number_that_sizes_are_made_of_does_not_change() {
    let case = |claim: &str| {
        format!(
            "title = 't'\n[parameters]\nn = 3\nk = 2\nS = 'skew(2, -1..1)'\n[let]\nN = 'n − 1'\n[state]\n\
             x = 'vector(n, 0.5..1)'\n[field]\n\"x[i]'\" = 'k*x[i]^k'\n[[claim]]\n{claim}\n"
        )
    };
    let refused = |claim: &str| {
        let told = error(&case(claim));
        assert!(told[0].1.contains("and cannot change"), "{claim}: {told:?}");
    };
    refused("limit = 'n*x[1]'\nequals = '0*x[1]'\nparameter = 'n'");
    refused("limit = 'x[k]'\nequals = 'x[1]'\nparameter = 'k'");
    refused("limit = 'tr(S^k)'\nequals = '2'\nparameter = 'k'");
    refused("symmetry = { x = 'sum(i, 1..N, 1)*x', n = 'n' }");
    settled(&case("limit = 'x[1]^k + k*x[2]'\nequals = '1'\nparameter = 'k'"));
    settled(&case("symmetry = { x = '−x', k = 'k' }\nexpect = 'fails'"));
}

#[test]
fn an_abbreviation_waits_for_rates_by_its_names_alone() {
    settled(
        r#"
title = "waiting"
[parameters]
k2 = "1..2"
[state]
x = "-2..2"
y = "-2..2"
[let]
k = "x'*2"
m2 = "k2*y"
[field]
"x'" = "m2"
"y'" = "−x*k2"
[[claim]]
identity = "k = 2*k2*y"
[[claim]]
integral = "x² + y²"
"#,
    );
    let told =
        error("title = 't'\n[state]\nx = '0..1'\n[let]\nk = \"2*x'\"\n[field]\n\"x'\" = 'k'\n");
    assert_eq!(told[0].1, "`k` contains a rate, which [field] defines");
}

#[test]
fn long_chains_of_names_take_no_deep_stack() {
    const FIELD: &str = "title = 't'\n[state]\nx = '1..2'\n[field]\n\"x'\" = 'x'\n";
    let links: Vec<String> = (0..5000).map(|k| format!("b{} = 'b{k} + x'\n", k + 1)).collect();
    for order in [links.concat(), links.iter().rev().cloned().collect()] {
        let text =
            format!("{FIELD}[[claim]]\nrate = 'b5000'\nequals = 'b5000'\n[let]\nb0 = 'x'\n{order}");
        let judged = std::thread::Builder::new().stack_size(1 << 20).spawn(move || {
            let case = Case::parse(&text, &[]).expect("a case");
            judge(&case, &Options::default()).map(|_| ())
        });
        let judged = judged.expect("a thread").join().expect("no stack overflows");
        assert!(judged.is_ok(), "the chain is judged");
    }
}

#[test]
fn components_of_rates_are_written_as_in_print() {
    settled(
        r#"
title = "rates"
[state]
q = "vector(2, 1..2)"
"q'" = "vector(2, 1..2)"
[lagrangian]
kinetic = "(q',q')/2"
[[claim]]
identity = "[q1', q2'] = q'"
[[claim]]
integral = "q₁'*q2 − q1*q′₂"
"#,
    );
    let told = error(
        "title = 't'\n[state]\nx1 = '0..1'\n[field]\n\"x1'\" = 'x1'\n[[claim]]\nidentity = \"x2' = 0\"\n",
    );
    assert_eq!(told[0].1, "unknown name `x2'`");
}

#[test]
fn names_that_are_declared_later_have_no_other_meaning() {
    // The state `e` is not the number, whatever is read first.
    settled(
        r#"
title = "e"
[parameters]
k = "2*π"
[state]
e = "-1..1"
[let]
u = "2*e"
[field]
"e'" = "k"
[[claim]]
rate = "u"
equals = "4*π"
"#,
    );
    let with = |parameter: &str| {
        format!(
            "title = 'e'\n[parameters]\na = 'vector(1..2)'\nk = '{parameter}'\n[state]\ne = '-1..1'\na1 = '-1..1'\n\
             [let]\nu = '2*e'\n[field]\n\"e'\" = 'k'\n\"a1'\" = 'k'\n[[claim]]\nidentity = 'k = k'\n"
        )
    };
    for parameter in ["u", "2*e", "2*a1"] {
        Case::parse(&with(parameter), &[]).expect_err("it depends on the state");
    }
    Case::parse(&with("2*a2"), &[]).expect("a component of the parameter");
    // An index hides the names of the file.
    settled(
        r#"
title = "indices"
[parameters]
k = "1..2"
[state]
x = "-1..1"
[let]
e = "u + k"
u = "sum(e, 1..3, e*k)"
[field]
"x'" = "u"
[[claim]]
identity = "e = 7*k"
"#,
    );
}
