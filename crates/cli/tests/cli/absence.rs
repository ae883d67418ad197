//! Claims of absence: what they exclude, what refutes them, and that nothing that is there is ever
//! excluded.

mod constraints;
mod densities;
mod exponentials;
mod functions;
mod known;
mod primes;
mod relations;
mod spheres;
mod twins;
mod wide;

use crate::common::{case, plants};
use assert_cmd::Command;
use liouville::case::Case;
use liouville::verdict::{ClaimReport, Options, Verdict};
use liouville_search::judge;
use serde_json::Value;

/// The reports on the claims of absence of a case.
fn absences(text: &str) -> Vec<ClaimReport> {
    let report = judge(&case(text), &Options::default())
        .unwrap_or_else(|error| panic!("{error} in\n{text}"));
    assert_eq!(report.absences_left, 0, "all are looked at");
    report.claims.into_iter().filter(|claim| claim.kind.starts_with("no-")).collect()
}

fn only(text: &str) -> ClaimReport {
    let mut all = absences(text);
    assert_eq!(all.len(), 1, "one claim of absence in\n{text}");
    all.remove(0)
}

/// Small numbers, the same in every run.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, low: i64, high: i64) -> i64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + ((self.0 >> 33) % (high - low + 1) as u64) as i64
    }

    /// A number that is not 0.
    fn unit(&mut self) -> i64 {
        match self.roll(-3, 3) {
            0 => 1,
            other => other,
        }
    }
}

/// A polynomial in some variables, as monomials with coefficients, and its derivatives as text.
#[derive(Clone)]
struct Polynomial(Vec<(i64, [u32; 3])>);

impl Polynomial {
    fn random(dice: &mut Dice, degree: u32) -> Self {
        let mut terms = Vec::new();
        for total in 1..=degree {
            for _ in 0..2 {
                let a = dice.roll(0, i64::from(total)) as u32;
                let b = dice.roll(0, i64::from(total - a)) as u32;
                terms.push((dice.unit(), [a, b, total - a - b]));
            }
        }
        Self(terms)
    }

    /// A linear form, with x in it.
    fn form(dice: &mut Dice) -> Self {
        let (a, b, c) = (dice.unit(), dice.roll(-3, 3), dice.roll(-3, 3));
        Self(vec![(a, [1, 0, 0]), (b, [0, 1, 0]), (c, [0, 0, 1])])
    }

    fn plus(&self, other: &Self) -> Self {
        Self([self.0.clone(), other.0.clone()].concat())
    }

    fn times(&self, other: &Self) -> Self {
        let each = |(a, e): &(i64, [u32; 3])| {
            let (a, e) = (*a, *e);
            other.0.iter().map(move |(b, f)| (a * b, [0, 1, 2].map(|k| e[k] + f[k])))
        };
        Self(self.0.iter().flat_map(each).collect())
    }

    fn scaled(&self, factor: i64) -> Self {
        Self(self.0.iter().map(|(c, e)| (c * factor, *e)).collect())
    }

    fn text(&self) -> String {
        let power = |name: &str, n: u32| format!("{name}^{n}");
        let term = |(c, [a, b, d]): &(i64, [u32; 3])| {
            format!("({c})*{}*{}*{}", power("x", *a), power("y", *b), power("z", *d))
        };
        let terms: Vec<String> = self.0.iter().filter(|(c, _)| *c != 0).map(term).collect();
        if terms.is_empty() { "0".to_string() } else { terms.join(" + ") }
    }

    fn derivative(&self, variable: usize) -> Self {
        let lowered = |(c, e): &(i64, [u32; 3])| {
            let mut lower = *e;
            lower[variable] = lower[variable].saturating_sub(1);
            (c * i64::from(e[variable]), lower)
        };
        Self(self.0.iter().map(lowered).collect())
    }

    fn gradient(&self) -> [String; 3] {
        [0, 1, 2].map(|k| self.derivative(k).text())
    }
}

fn field(rates: [String; 3], claims: &str) -> String {
    let [x, y, z] = rates;
    format!(
        "title = 't'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nz = '0.5..2'\n[field]\n\"x'\" = '{x}'\n\"y'\" = \
         '{y}'\n\"z'\" = '{z}'\n{claims}"
    )
}

fn cross(a: &[String; 3], b: &[String; 3]) -> [String; 3] {
    [(1, 2), (2, 0), (0, 1)]
        .map(|(i, j)| format!("(({})*({}) − ({})*({}))", a[i], b[j], a[j], b[i]))
}

#[test]
fn planted_integrals_of_fields_are_never_excluded() {
    let mut dice = Dice(1);
    let mut refuted = 0;
    let all = plants(60);
    for plant in 0..all {
        let degree = 1 + (plant % 3) as u32;
        let integral = Polynomial::random(&mut dice, degree);
        let across = [0, 1, 2].map(|_| Polynomial::random(&mut dice, 1 + plant as u32 % 2).text());
        let rates = cross(&integral.gradient(), &across);
        let text = field(rates, &format!("[[claim]]\nno-integral = {{ degree = {degree} }}\n"));
        let report = only(&text);
        assert_ne!(report.verdict, Verdict::Proved, "{} is there:\n{text}", integral.text());
        refuted += usize::from(report.verdict == Verdict::Refuted);
    }
    assert!(refuted * 10 >= all * 9, "{refuted} of {all} plants are exhibited");
}

#[test]
fn planted_integrals_in_curved_coordinates_are_never_excluded() {
    let mut dice = Dice(2);
    let mut refuted = 0;
    let all = plants(20);
    for plant in 0..all {
        // u + a v² and v + b w³ or w + b u v, with linear forms u, v, w: coordinates that are bent.
        let [u, v, w] = [0, 1, 2].map(|_| Polynomial::form(&mut dice));
        let bent = u.plus(&v.times(&v).scaled(dice.unit()));
        let other = match plant % 2 {
            0 => v.plus(&w.times(&w).times(&w).scaled(dice.unit())),
            _ => w.plus(&u.times(&v).scaled(dice.unit())),
        };
        let rates = cross(&bent.gradient(), &other.gradient());
        let claim = |known: &str, degree: u32| {
            format!("{known}[[claim]]\nno-integral = {{ degree = {degree} }}\n")
        };
        let stated =
            |own: &Polynomial| format!("[[claim]]\nname = 'known'\nintegral = '{}'\n", own.text());
        // Both are integrals: with none or one of them claimed there is another.
        let texts = [
            field(rates.clone(), &claim("", 2)),
            field(rates.clone(), &claim(&stated(&bent), 3)),
            field(rates, &claim(&stated(&other), 2)),
        ];
        for text in texts {
            let report = only(&text);
            assert_ne!(report.verdict, Verdict::Proved, "an integral is there:\n{text}");
            refuted += usize::from(report.verdict == Verdict::Refuted);
        }
    }
    assert!(refuted * 10 >= 3 * all * 9, "{refuted} of {} claims are refuted", 3 * all);
}

#[test]
fn planted_integrals_of_lagrangians_are_never_excluded() {
    let mut dice = Dice(3);
    let mut refuted = 0;
    let all = plants(10);
    for plant in 0..all {
        let (m, n) = ([(3, 4, 5), (5, 12, 13), (8, 15, 17)])
            .map(|(a, b, c)| (format!("{a}/{c}"), format!("{b}/{c}")))[plant % 3]
            .clone();
        let (a, b, c) = (dice.unit(), dice.unit(), dice.unit());
        let (x, y) = (dice.roll(-2, 2), dice.roll(-2, 2));
        // Separable in turned coordinates, or central about a point.
        let (potential, degree) = match plant % 2 {
            0 => (format!("({a})*({m}*x + {n}*y)^4 + ({b})*({m}*y − {n}*x)^3 + ({c})*x"), 2),
            _ => (
                format!(
                    "({a})*((x − ({x}))² + (y − ({y}))²) + ({b})*((x − ({x}))² + (y − ({y}))²)²"
                ),
                1,
            ),
        };
        let text = format!(
            "title = 't'\nsystem = 'nonholonomic'\n[state]\nx = '-1..1'\ny = '-1..1'\n\"x'\" = '-1..1'\n\
             \"y'\" = '-1..1'\n[lagrangian]\nkinetic = \"(x'² + y'²)/2\"\npotential = '{potential}'\n\
             [[claim]]\nno-integral = {{ degree = {degree} }}\n"
        );
        let report = only(&text);
        assert_ne!(report.verdict, Verdict::Proved, "an integral is there:\n{text}");
        refuted += usize::from(report.verdict == Verdict::Refuted);
    }
    assert!(refuted * 10 >= all * 7, "{refuted} of {all} plants are exhibited");
}

#[test]
fn planted_densities_are_never_excluded() {
    let mut dice = Dice(4);
    let mut refuted = 0;
    let all = plants(40);
    for plant in 0..all {
        let form = Polynomial::random(&mut dice, 1 + plant as u32 % 2);
        let gradient = form.gradient();
        let potential = [0, 1, 2].map(|_| Polynomial::random(&mut dice, 2));
        let curl = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
            let (a, b) = (potential[j].derivative(i).text(), potential[i].derivative(j).text());
            format!("({a} − ({b}))")
        });
        let across = cross(&gradient, &potential.clone().map(|own| own.text()));
        let polynomial = format!("({} + 7)", form.text());
        let rates: [String; 3] = match plant % 3 {
            // e^(-P) curl (e^P A)
            0 => [0, 1, 2].map(|k| format!("{} + {}", curl[k], across[k])),
            // P^(1-s) curl (P^s A), s = 1 and s = 1/2
            1 => [0, 1, 2].map(|k| format!("{polynomial}*{} + {}", curl[k], across[k])),
            _ => [0, 1, 2].map(|k| format!("2*{polynomial}*{} + {}", curl[k], across[k])),
        };
        let text = field(rates, "[[claim]]\nno-density = { degree = 2 }\n");
        let report = only(&text);
        assert_ne!(report.verdict, Verdict::Proved, "a density is there:\n{text}");
        refuted += usize::from(report.verdict == Verdict::Refuted);
    }
    assert!(refuted * 10 >= all * 6, "{refuted} of {all} plants are exhibited");
}

#[test]
fn moduli_and_dependent_roots_are_left_open() {
    let lagrangian = |potential: &str| {
        format!(
            "title = 't'\nsystem = 'nonholonomic'\n[state]\nx = '0.5..2'\ny = '-1..1'\n\"x'\" = '-1..1'\n\
             \"y'\" = '-1..1'\n[lagrangian]\nkinetic = \"(x'² + y'²)/2\"\npotential = '{potential}'\n\
             [[claim]]\nno-integral = {{ degree = 1 }}\n"
        )
    };
    // The force vanishes where x > 0.
    for potential in ["(|x| − x)*x*y²", "(√(x²) − x)*x*y²"] {
        assert_ne!(only(&lagrangian(potential)).verdict, Verdict::Proved, "{potential}");
    }
    assert_eq!(only(&lagrangian("x^3*y + x*y²")).verdict, Verdict::Proved, "a general potential");
    let text =
        field(["z*(|x| − x)".into(), "z*(|x| − x)*x".into(), "z*(|x| − x) + x*z".into()], "")
            + "[[claim]]\nno-integral = { degree = 1 }\n";
    assert_ne!(only(&text).verdict, Verdict::Proved, "x' = y' = 0 where x > 0");
}

#[test]
fn what_cannot_be_counted_has_a_reason() {
    let claim = "[[claim]]\nno-integral = { degree = 2 }\n";
    let with = |rates: [&str; 3]| field(rates.map(str::to_string), claim);
    let open = [
        with(["ln(x)", "y", "z"]),
        with(["k*y*z + 1", "x", "z"])
            .replace("[state]", "[parameters]\nk = 'one of 1, 2, 3, 4, 5, 6, 7, 8, 9'\n[state]"),
        "title='t'\n[state]\nx='-1..1'\ny='-1..1'\n[field]\n\"x'\"='y'\n\"y'\"='−x'\n[level]\n\
         equations=['x² + y² = 1']\n"
            .to_string()
            + claim,
        with(["y", "z", "x"])
            .replace("degree = 2", "degree = 12")
            .replace("z = '0.5..2'", "z = '0.5..2'\nw = 'vector(6, 1..2)'")
            .replace("[field]\n", "[field]\n\"w'\" = 'w'\n"),
        "title='t'\nsystem='rubber-plane'\n[parameters]\nm='0.5..2'\nI='inertia(0.5..5)'\n[body]\n\
         support='arbitrary'\n"
            .to_string()
            + claim,
    ];
    for text in open {
        let report = only(&text);
        assert_eq!(report.verdict, Verdict::Undecided, "{text}\n{:?}", report.evidence);
        assert!(report.evidence.reason.is_some(), "with a reason: {text}");
        assert!(!report.agrees, "it was expected to hold");
    }
}

#[test]
fn only_proved_integrals_count_as_known() {
    let top = |claims: &str| {
        format!(
            "title='t'\n[parameters]\nI='inertia(0.5..5)'\n[state]\nM='vector(-2..2)'\n[field]\n\
             \"M'\"='M × I⁻¹*M'\n{claims}[[claim]]\nno-integral = {{ degree = 2 }}\n"
        )
    };
    let claim = |formula: &str| format!("[[claim]]\nintegral = '{formula}'\nexpect = 'open'\n");
    let (square, energy, wrong) = (claim("(M,M)"), claim("(M,I⁻¹*M)"), claim("(M,I*M)"));
    assert_eq!(only(&top(&(square.clone() + &energy))).verdict, Verdict::Proved, "both");
    assert_eq!(
        only(&top(&(square.clone() + &wrong))).verdict,
        Verdict::Refuted,
        "one is no integral"
    );
    // The square of an integral does not stand for the integral.
    let squared = claim("(M,M)²");
    assert_eq!(
        only(&top(&(squared + &energy))).verdict,
        Verdict::Refuted,
        "(M,M) is no polynomial in it"
    );
    // The same twice is one.
    assert_eq!(
        only(&top(&(square.clone() + &claim("2*(M,M)")))).verdict,
        Verdict::Refuted,
        "twice"
    );
    // Any two that span the same will do, one claim of several components too.
    let vector = claim("[(M,M) + (M,I⁻¹*M), (M,M) − (M,I⁻¹*M)]");
    assert_eq!(only(&top(&vector)).verdict, Verdict::Proved, "components");
}

#[test]
fn theorems_say_for_which_parameters() {
    let lorenz = |sigma: &str| {
        format!(
            "title='t'\n[parameters]\nsigma={sigma}\n[state]\nx='-2..2'\ny='-2..2'\nz='0..4'\n[field]\n\
             \"x'\"='sigma*(y − x)'\n\"y'\"='28*x − y − x*z'\n\"z'\"='x*y − 8/3*z'\n[[claim]]\n\
             no-integral = {{ degree = 3 }}\n"
        )
    };
    let theorem = |text: &str| only(text).evidence.theorem.expect("a theorem");
    assert!(theorem(&lorenz("'1..20'")).contains("proper algebraic set"), "generic");
    assert!(theorem(&lorenz("10")).starts_with("For the given values"), "fixed");
}

#[test]
fn wrong_claims_are_told_at_their_place() {
    let with = |claim: &str| {
        let text = field(["y", "z", "x"].map(str::to_string), &format!("[[claim]]\n{claim}\n"));
        let error = Case::parse(&text, &[]).expect_err("a mistake");
        error.to_string()
    };
    for (claim, message) in [
        ("no-integral = { degree = -1 }", "`-1` is not a degree"),
        ("no-integral = { degree = 0 }", "`0` is not a degree"),
        ("no-integral = { degree = 1000 }", "`1000` is not a degree"),
        ("no-integral = { degree = 99999999999999999999 }", "degree"),
        ("no-integral = { degree = 2.5 }", "`2.5` is not a degree"),
        ("no-integral = { degree = \"two\" }", "`\"two\"` is not a degree"),
        ("no-density = { degree = 5 }", "`5` is not a degree"),
        ("no-integral = 4", "`no-integral` does not state"),
        ("no-integral = \"x\"", "`no-integral` does not state"),
        ("no-integral = {}", "`no-integral` has no `degree`"),
        ("no-integral = { degree = 2, order = 1 }", "order"),
        ("no-integral = { degree = 2 }\nintegral = \"x\"", "2 statements"),
        ("no-integral = { degree = 2 }\nwhere = \"level\"", "where"),
        ("no-integral = { degree = 2 }\nexpect = \"perhaps\"", "expect"),
        ("no-integrals = { degree = 2 }", "no-integral"),
    ] {
        let error = with(claim);
        assert!(error.contains(message), "{claim}: {error}");
    }
}

#[test]
fn all_formats_tell_them() {
    let check = |arguments: &[&str]| {
        let output = Command::cargo_bin("liouville")
            .expect("the program")
            .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
            .arg("check")
            .args(arguments)
            .output()
            .expect("it runs");
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    let top = "cases/classical/absence/euler-top-one-integral.toml";
    let text = check(&[top]);
    assert!(text.contains("integral, proved: (I1*I2 − I2*I3)*M1²"), "the witness is shown: {text}");
    assert!(text.contains("theorem   For all values of the free parameters"), "{text}");
    let verbose = check(&[top, "-v"]);
    assert!(verbose.contains("exhibit   integral, proved"), "{verbose}");
    let json: Value = serde_json::from_str(&check(&[top, "--json"])).expect("JSON");
    let claims = json["cases"][0]["claims"].as_array().expect("claims");
    let of = |name: &str| claims.iter().find(|own| own["name"] == name).expect("the claim");
    let refuted = &of("no further integral of degree ≤ 2")["evidence"];
    assert_eq!(refuted["method"], "count");
    assert!(refuted["exhibit"].as_str().is_some_and(|text| text.contains("M2²")), "{refuted}");
    assert!(of("degree 1")["evidence"]["theorem"].is_string(), "a theorem");
    assert_eq!(json["summary"]["disagreements"], 0);
    assert!(json["summary"].get("absences_left").is_none(), "none is left");
    check(&[top, "--trust", "proof"]);
}
