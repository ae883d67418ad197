//! Searches of own fields by orbits modulo a prime: rational integrals, Darboux polynomials,
//! densities, and theorems that never exclude what was planted.

mod absence;
mod benchmark;
mod closure;
mod counts;
mod divided;
mod explicit;
mod exponentials;
mod factors;
mod functions;
mod harmonics;
mod irrational;
mod levels;
mod low_degree;
mod maps;
mod parameters;
mod published;
mod rates;
mod separable;
mod threads;
mod written_degrees;

use std::time::{Duration, Instant};

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::verdict::{Options, Verdict};
use liouville_search::{Effort, Excluded, FoundKind, Halt, SearchReport, search};

fn searched(text: &str, effort: &Effort) -> SearchReport {
    let case = Case::parse(text, &[]).expect("a case");
    let mut report = search(&case, effort, &mut |_| {}).expect("it can be searched");
    // Those for volumes have a test of their own.
    report.conditions.retain(|own| !own.of.starts_with("the density 1"));
    let open = report.found.iter().find(|found| found.verdict != Verdict::Proved);
    assert!(open.is_none(), "all is proved: {open:?}");
    report
}

/// A field in x, y, z, or in x and y.
fn field(parameters: &str, rates: &[&str]) -> String {
    let names = ["x", "y", "z"];
    let state: String =
        names.iter().take(rates.len()).map(|name| format!("{name} = '0.5..2'\n")).collect();
    let field: String =
        names.iter().zip(rates).map(|(name, rate)| format!("\"{name}'\" = '{rate}'\n")).collect();
    format!(
        "title = 'x'\nsystem = 'field'\n[parameters]\n{parameters}\n[state]\n{state}[field]\n{field}"
    )
}

/// Highest degree of fractions that a theorem excludes altogether.
fn excluded(report: &SearchReport) -> Option<u32> {
    let own = report.excluded.iter().find(|own| own.theorem.contains("o fraction P/Q"))?;
    own.ansatz.rsplit(' ').next().and_then(|degree| degree.parse().ok())
}

#[test]
fn chaotic_fields_have_no_rational_integral_of_degree_8() {
    let own = "s = '0.5..2'\nr = '0.5..2'\nb = '0.5..2'";
    let fields = [
        ("Lorenz", own, ["s*(y - x)", "r*x - y - x*z", "x*y - b*z"]),
        ("Rössler", own, ["-y - z", "x + s*y", "b + z*(x - r)"]),
        ("Halphen", "", ["y*z - x*(y + z)", "z*x - y*(z + x)", "x*y - z*(x + y)"]),
    ];
    for (name, parameters, rates) in fields {
        let report = searched(&field(parameters, &rates), &Effort::default());
        assert_eq!(excluded(&report), Some(8), "{name}");
        assert_eq!(report.orbits.last().map(|last| last.integrals), Some(0), "{name}");
    }
}

#[test]
fn rational_integrals_are_written_out() {
    let dipole = searched(&field("", &["2*x*y", "y² - x²"]), &Effort::default());
    assert_eq!(dipole.formulas(FoundKind::Integral).count(), 1, "circles through the origin");
    // A Lotka–Volterra field of the ABC type with two integrals.
    let fields = ["x*(y - z)", "y*(z - x)", "z*(x - y)"];
    let volterra = searched(&field("", &fields), &Effort::default());
    assert_eq!(volterra.formulas(FoundKind::Integral).count(), 2, "x + y + z and xyz");
    // May and Leonard, α + β = 2.
    let fields = [
        "x*(1 - x - a*y - (2 - a)*z)",
        "y*(1 - y - a*z - (2 - a)*x)",
        "z*(1 - z - a*x - (2 - a)*y)",
    ];
    let leonard = searched(&field("a = '3/2'", &fields), &Effort::default());
    let found: Vec<&str> = leonard.formulas(FoundKind::Integral).collect();
    assert_eq!(found.len(), 1, "xyz/(x + y + z)³: {found:?}");
    let is_all = |own: &Excluded| own.known == 1 && own.theorem.contains("very integral P/Q");
    assert!(leonard.excluded.iter().any(is_all), "{:?}", leonard.excluded);
    assert_eq!(excluded(&leonard), None, "that there is none below its degree says less");
}

#[test]
fn integrals_on_a_level_are_found() {
    // Goryachev and Chaplygin: 4 J₃ = J₁ = J₂ on (M,γ) = 0, J₃ = 1, U = γ₁.
    let text = "title = 'x'\nsystem = 'field'\n[state]\nM = 'vector(-2..2)'\n\"γ\" = 'vector(-1..1)'\n\
                [field]\n\"M'\" = 'M × [M1/4, M2/4, M3] + γ × [1, 0, 0]'\n\"γ'\" = 'γ × [M1/4, M2/4, M3]'\n\
                [level]\nequations = ['(γ,γ) = 1', '(M,γ) = 0']\n";
    let report = searched(text, &Effort::default());
    let found: Vec<&str> = report.formulas(FoundKind::Integral).collect();
    assert_eq!(found.len(), 2, "the energy and M₃(M₁² + M₂²) + … : {found:?}");
}

/// Pseudo-random integers −4..=4.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> i64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as i64 % 9 - 4
    }

    /// A linear form without constant.
    fn form(&mut self) -> [i64; 3] {
        std::array::from_fn(|_| self.next())
    }
}

/// A field without parameters in its variables, in the order given.
fn any_field(rates: &[(&str, &str)]) -> String {
    let state: String = rates
        .iter()
        .enumerate()
        .map(|(place, (name, _))| format!("\"{name}\" = \"0.{place}3..0.{place}9\"\n"))
        .collect();
    let field: String =
        rates.iter().map(|(name, rate)| format!("\"{name}'\" = \"{rate}\"\n")).collect();
    format!("title = 'x'\nsystem = 'field'\n[state]\n{state}[field]\n{field}")
}

/// Rates of a field, and integrals of it.
type Known = (&'static [(&'static str, &'static str)], &'static [&'static str]);

#[test]
fn integrals_with_functions_are_found() {
    let fields: [Known; 9] = [
        (&[("x", "p"), ("p", "-2*sin(x)")], &["p² − 4*cos(x)"]),
        // Sines of multiples of an angle that comes later.
        (&[("x", "p"), ("p", "-sin(2*x) - sin(x)")], &["2*cos(x) + 2*cos(x)² − p²"]),
        (&[("x", "p"), ("p", "exp(-2*x) - exp(x)")], &["p² + 2*exp(x) + exp(−2*x)"]),
        (&[("x", "p/sqrt(1 + p²)"), ("p", "-x")], &["2*√(1 + p²) + x²"]),
        (&[("r", "p"), ("p", "12/r^13 - 6/r^7")], &["p² + 2/r¹² − 2/r⁶"]),
        (&[("x", "p"), ("p", "-x/(1 + x²)")], &["p² + ln(1 + x²)"]),
        (
            &[("x", "u"), ("y", "v"), ("u", "-x/(x² + y²)^(3/2)"), ("v", "-y/(x² + y²)^(3/2)")],
            &["x*v − y*u", "u² + v² − 2/√(x² + y²)", "y/√(x² + y²) + x*u*v − y*u²"],
        ),
        (
            &[("q", "a"), ("r", "b"), ("a", "-exp(q - r)"), ("b", "exp(q - r)")],
            &["a + b", "a*b − exp(q − r)"],
        ),
        (
            &[
                ("x", "u"),
                ("y", "v"),
                ("z", "w"),
                ("u", "2/(x - y)^3 + 2/(x - z)^3"),
                ("v", "2/(y - x)^3 + 2/(y - z)^3"),
                ("w", "2/(z - x)^3 + 2/(z - y)^3"),
            ],
            &["u + v + w", "1/(x − y)² + 1/(x − z)² + 1/(y − z)² − u*v − u*w − v*w"],
        ),
    ];
    for (rates, wanted) in fields {
        let effort = Effort { by_factors: false, ..Effort::default() };
        let report = searched(&any_field(rates), &effort);
        let case = Case::parse(&any_field(rates), &[]).expect("a case");
        let found: Vec<&str> = report.formulas(FoundKind::Integral).collect();
        for own in wanted {
            let same = |text: &&&str| {
                let [a, b] = [own, *text].map(|text| case.formula(text).expect("a formula"));
                let same = case.judge(&[Claim::identity(&a, &b)], &Options::default());
                same.is_ok_and(|report| report.claims[0].verdict == Verdict::Proved)
            };
            assert!(found.iter().any(|text| same(&text)), "{own} of {rates:?}: {found:?}");
        }
    }
}

#[test]
fn theorems_name_the_functions() {
    let rates = [("x", "p"), ("p", "-x/√(1 + x²) - p")];
    let damped = searched(&any_field(&rates), &Effort::default());
    assert!(excluded(&damped).is_some_and(|degree| degree >= 4), "{:?}", damped.excluded);
    let theorem = &damped.excluded[0].theorem;
    assert!(theorem.contains("in x, p, √(1 + x²) of degree"), "{theorem}");
    let damped = searched(&any_field(&[("x", "p"), ("p", "-sin(x) - p")]), &Effort::default());
    assert!(excluded(&damped).is_some_and(|degree| degree >= 4), "{:?}", damped.excluded);
    let theorem = &damped.excluded[0].theorem;
    assert!(theorem.contains("in x, p, sin(x), cos(x) of degree"), "{theorem}");
    // Both signs of √k, and the one sign of √2 in the field modulo a prime, will do.
    for root in ["√k", "√2"] {
        let field = format!(
            "title = 'x'\n[parameters]\nk = '0.5..2'\n[state]\nx = '-2..2'\np = '-2..2'\n\
             [field]\n\"x'\" = 'p'\n\"p'\" = '-{root}*sin(x) - p'\n"
        );
        let report = searched(&field, &Effort::default());
        assert!(
            excluded(&report).is_some_and(|degree| degree >= 4),
            "{root}: {:?}",
            report.excluded
        );
    }
    // √8 = 2√2, which need not hold for the roots modulo a prime.
    let rates = [("x", "p"), ("p", "-√2*sin(x) - √8*p")];
    let report = searched(&any_field(&rates), &Effort::default());
    assert_eq!(excluded(&report), None, "{:?}", report.excluded);
    // √((x + p)²) is another function where x + p < 0: nothing is excluded.
    let rates = [("x", "p*√((x + p)²) + 1"), ("p", "-x*√((x + p)²)")];
    let report = searched(&any_field(&rates), &Effort::default());
    assert_eq!(excluded(&report), None, "{:?}", report.excluded);
}

#[test]
fn planted_integrals_with_functions_are_never_excluded() {
    // F = (a f + b)/c with linear a, b, c, and f a function of a linear form l: v ~ (F_y, −F_x).
    let plants = std::env::var("LIOUVILLE_PLANTS").ok().and_then(|text| text.parse().ok());
    let mut numbers = Numbers(23);
    let mut generated = 0;
    for plant in 0..plants.unwrap_or(12) {
        let mut form = || {
            let [x, y, one] = numbers.form();
            ([x, y], format!("(({x})*x + ({y})*y + ({one}))"))
        };
        let ((da, a), (db, b), (dc, c), (dl, l)) = (form(), form(), form(), form());
        let (f, slope) = match plant % 6 {
            0 => (format!("exp{l}"), format!("exp{l}")),
            1 => (format!("sin{l}"), format!("cos{l}")),
            2 => (format!("cos{l}"), format!("(-sin{l})")),
            3 => (format!("√(1 + {l}²)"), format!("({l}/√(1 + {l}²))")),
            4 if plant % 12 == 4 => (format!("|{l}|"), format!("({l}/|{l}|)")),
            4 => (format!("√({l}²)"), format!("({l}/√({l}²))")),
            _ => (format!("(exp{l} + exp(−2*{l}))"), format!("(exp{l} − 2*exp(−2*{l}))")),
        };
        let rate = |k: usize| {
            format!(
                "((({})*{f} + {a}*({})*{slope} + ({}))*{c} − ({a}*{f} + {b})*({}))",
                da[k], dl[k], db[k], dc[k]
            )
        };
        let text = any_field(&[("x", rate(1).as_str()), ("y", format!("-{}", rate(0)).as_str())]);
        let Ok(case) = Case::parse(&text, &[]) else { continue };
        // Higher degrees take most of the time.
        let effort = Effort { by_class: plant % 5 == 0, ..Effort::default() };
        let Ok(report) = search(&case, &effort, &mut |_| {}) else { continue };
        // Degree 3 where e^(−2l) is the square of a variable.
        let limit = if plant % 6 == 5 { 4 } else { 2 };
        let degree = excluded(&report);
        assert!(degree.is_none_or(|degree| degree < limit), "plant {plant}: {text}");
        if report.excluded.iter().any(|own| own.theorem.contains("is a function of")) {
            let planted = case.formula(&format!("({a}*{f} + {b})/{c}")).expect("a formula");
            let all = report.functions(FoundKind::Integral).cloned().chain([planted]).collect();
            let judged = case.judge(&[Claim::independent(all)], &Options::default());
            let verdict = judged.expect("judged").claims[0].verdict;
            assert_ne!(verdict, Verdict::Proved, "plant {plant}: {:?}", report.excluded);
            generated += 1;
        }
    }
    assert!(generated > 0, "some theorem on functions of the planted integrals is stated");
}

#[test]
fn coefficients_contain_any_parameter() {
    // A sleigh: J is a number here, and s occurs nowhere.
    let own = "m = '0.5..2'\nJ = '0.5..2'\na = '0.5..1'\ns = '1..2'";
    let sleigh = searched(&field(own, &["a*y²", "-m*a/(J + m*a²)*x*y"]), &Effort::default());
    let found: Vec<&str> = sleigh.formulas(FoundKind::Integral).collect();
    assert_eq!(found, ["m*x² + (J + m*a²)*y²"]);
    // Brun's body: a common denominator would raise the degree of the third coefficient.
    let brun = "title = 'x'\nsystem = 'field'\n[parameters]\nI = 'inertia(0.5..5)'\ne = '0.3..1'\nc = '0.5..1'\n\
                [state]\nM = 'vector(-2..2)'\nn = 'vector(-1..1)'\n[let]\nw = 'I⁻¹*M'\n\
                [field]\n\"M'\" = 'M × w + e*(n × I*n)'\n\"n'\" = 'n × w'\n\
                [level]\nequations = ['(n,n) = 1', '(M,n) = c']";
    assert_eq!(searched(brun, &Effort::default()).formulas(FoundKind::Integral).count(), 2);
}

#[test]
fn coefficients_contain_the_roots_of_the_field() {
    // ∇F × (y, 1, x) keeps F = x² + s y + z.
    let kept = |s: &str| [format!("({s})*x − 1"), "y − 2*x²".into(), format!("2*x − ({s})*y")];
    let turned = |s: &str| [format!("y + {s}*z"), "−x".into(), format!("−{s}*x")];
    let (k, two) = ("k = '0.5..2'", "k = '0.5..2'\nm = '0.5..2'");
    let fields = [
        ("", turned("√2"), "z − √2*y"),
        ("", kept("√5"), "x² + √5*y + z"),
        ("", kept("(7 − 3*√2)/11"), "x² + (7 − 3*√2)/11*y + z"),
        (k, turned("√k"), "z − √k*y"),
        (k, kept("(k + √2)/3"), "x² + (k + √2)/3*y + z"),
        (two, kept("√(k² + m)"), "x² + √(k² + m)*y + z"),
    ];
    for (parameters, rates, wanted) in fields {
        let rates = rates.each_ref().map(String::as_str);
        let text = field(parameters, &rates);
        let case = Case::parse(&text, &[]).expect("a case");
        let report = searched(&text, &Effort { by_factors: false, ..Effort::default() });
        let wanted = case.formula(wanted).expect("a formula");
        let all = report.functions(FoundKind::Integral).cloned().chain([wanted.clone()]).collect();
        let claims = [Claim::integral(&wanted), Claim::independent(all)];
        let judged = case.judge(&claims, &Options::default()).expect("judged");
        let verdicts: Vec<Verdict> = judged.claims.iter().map(|own| own.verdict).collect();
        assert_eq!(verdicts, [Verdict::Proved, Verdict::Refuted], "{wanted}: {:?}", report.found);
        let remarks = report.remarks.iter().filter(|own| own.contains("coefficients")).count();
        assert_eq!(remarks, 0, "{:?}", report.remarks);
    }
}

#[test]
fn what_cannot_be_written_is_noted_once() {
    // Of so many roots no products are taken; the integral returns in every degree.
    let own = "(√2*√3 + √5 + √7 + √11)";
    let rates = [format!("y + {own}*z"), "−x".to_string(), format!("−{own}*x")];
    let report = searched(&field("", &rates.each_ref().map(String::as_str)), &Effort::default());
    let remarks = report.remarks.iter().filter(|own| own.contains("has coefficients")).count();
    assert_eq!(remarks, 1, "{:?}", report.remarks);
}

#[test]
fn searches_stop_in_time() {
    // Twelve coupled variables: the matrices grow as long as there is time.
    let names: Vec<String> = (1..=9).map(|k| format!("x{k}")).collect();
    let state: String = names.iter().map(|name| format!("{name} = '0.5..2'\n")).collect();
    let rate = |k: usize| {
        let (next, last) = (&names[(k + 1) % 9], &names[(k + 8) % 9]);
        format!("\"{}'\" = '{next}*{last} - {}^2 + {k}'\n", names[k], names[k])
    };
    let rates: String = (0..9).map(rate).collect();
    let text = format!("title = 'x'\nsystem = 'field'\n[state]\n{state}[field]\n{rates}");
    let start = Instant::now();
    let effort = Effort { halt: Halt::within(Duration::from_secs(2)), ..Effort::default() };
    let report = searched(&text, &effort);
    // In the dev profile the last part of an elimination takes longer.
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
    assert!(!report.orbits.is_empty(), "what was reached is told");
    // Volterra's chain: a thousand unknown entries of a bracket, and as many solutions of P ∂H = 0.
    let rate = |k: usize| format!("\"x{k}'\" = 'x{k}*(x{} - x{})'\n", k % 8 + 1, (k + 6) % 8 + 1);
    let rates: String = (1..=8).map(rate).collect();
    let state: String = names[..8].iter().map(|name| format!("{name} = '0.5..2'\n")).collect();
    let text = format!("title = 'x'\nsystem = 'field'\n[state]\n{state}[field]\n{rates}");
    let (start, halt) = (Instant::now(), Halt::within(Duration::from_secs(1)));
    let poisson = Some(liouville_search::Hamiltonians::Known);
    let report = searched(&text, &Effort { poisson, halt, ..Effort::default() });
    assert!(start.elapsed() < Duration::from_secs(4), "{:?}", start.elapsed());
    assert!(report.formulas(FoundKind::Integral).count() > 1, "what was found before is told");
}

#[test]
fn two_integrals_are_told_in_place_of_their_fraction() {
    let text = "title = 't'\n[state]\nx = '-2..2'\ny = '-2..2'\n\"x'\" = '-2..2'\n\"y'\" = '-2..2'\n\
                [lagrangian]\nkinetic = \"(x'² + y'²)/2\"\npotential = '(x² + 4*y²)/2'\n";
    let report = searched(text, &Effort { by_class: false, ..Effort::default() });
    let integrals: Vec<&str> = report.formulas(FoundKind::Integral).collect();
    assert!(integrals.iter().all(|own| !own.contains('/')), "{integrals:?}");
    assert!(integrals.iter().any(|own| own.contains("y*x'²")), "{integrals:?}");
    let counted = report.counts.iter().find(|own| own.degree == 2).expect("counted");
    assert_eq!(counted.known, counted.dimension, "{integrals:?}");
}
