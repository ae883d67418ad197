//! Powers with exponents from lists, some of them whole numbers, which take any base.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn verdict(exponents: &str, x: &str, level: &str, claim: &str) -> Verdict {
    let text = format!(
        "title = \"t\"\n[parameters]\na = \"one of {exponents}\"\n[state]\nx = \"{x}\"\ny = \"-2..2\"\n\
         [field]\n\"x'\" = \"x\"\n\"y'\" = \"a*y\"\n{level}\n[[claim]]\n{claim}\nexpect = \"open\"\n"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    report.claims[0].verdict
}

#[test]
fn what_holds_for_positive_bases_alone_is_not_proved() {
    let level = "[level]\nequations = [\"y = x^a\"]";
    let even = "identity = \"x = abs(x)\"";
    for exponents in ["2, 4", "2", "1/2, 4", "-2, 1/3"] {
        let found = verdict(exponents, "-2..2", level, even);
        assert_ne!(found, Verdict::Proved, "x < 0 is on the level for a of {exponents}");
    }
    let odd = "identity = \"x^a*abs(x) = x^(a + 1)\"";
    assert_ne!(verdict("2, 3", "-2..2", "", odd), Verdict::Proved);
    assert_ne!(verdict("2, 3", "-2..2", "", "lyapunov = \"-x^a\""), Verdict::Proved);
}

#[test]
fn positive_bases_and_fractions_lose_nothing() {
    let odd = "identity = \"x^a*abs(x) = x^(a + 1)\"";
    assert_eq!(verdict("2, 3", "1..2", "", odd), Verdict::Proved, "x > 0");
    assert_eq!(verdict("1/3, 4/3", "-2..2", "", odd), Verdict::Proved, "only x > 0 has a power");
    let integral = "integral = \"y/x^a\"";
    assert_eq!(verdict("2, 1/2", "1/2..2", "", integral), Verdict::Proved);
    assert_eq!(verdict("2, 3", "-2..2", "", "identity = \"x^a = 2*x^a\""), Verdict::Refuted);
}

/// Value of a power: of any base if the exponent is whole, of a positive one otherwise.
fn power(base: f64, exponent: f64) -> f64 {
    match exponent.fract() == 0.0 {
        true => base.powi(exponent as i32),
        false if base > 0.0 => base.powf(exponent),
        false => f64::NAN,
    }
}

/// A base, and its value at x and y.
type Base = (&'static str, fn(f64, f64) -> f64);

/// An identity of powers of a base with the exponents a and a + 1, and its two sides at a base and an exponent.
type Identity = (&'static str, fn(f64, f64) -> [f64; 2]);

const IDENTITIES: [Identity; 8] = [
    ("(B)^a*abs(B) = (B)^(a + 1)", |b, a| [power(b, a) * b.abs(), power(b, a + 1.0)]),
    ("(B)^a*(B) = (B)^(a + 1)", |b, a| [power(b, a) * b, power(b, a + 1.0)]),
    ("(B)^a = abs(B)^a", |b, a| [power(b, a), power(b.abs(), a)]),
    ("(-(B))^a = (B)^a", |b, a| [power(-b, a), power(b, a)]),
    ("((B)^a)^2 = (B)^(2*a)", |b, a| [power(b, a).powi(2), power(b, 2.0 * a)]),
    ("sqrt((B)^(2*a)) = (B)^a", |b, a| [power(b, 2.0 * a).sqrt(), power(b, a)]),
    ("sqrt((B)^(2*a)) = abs((B)^a)", |b, a| [power(b, 2.0 * a).sqrt(), power(b, a).abs()]),
    ("(B)*(1 + (B)^a) = 0", |b, a| [b * (1.0 + power(b, a)), 0.0]),
];

#[test]
fn what_is_proved_holds_for_each_listed_number_in_the_file() {
    let bases: [Base; 5] = [
        ("x", |x, _| x),
        ("abs(x)", |x, _| x.abs()),
        ("-x", |x, _| -x),
        ("y", |_, y| y),
        ("x + y", |x, y| x + y),
    ];
    let exponents: [(&str, [f64; 2]); 6] = [
        ("2, 4", [2.0, 4.0]),
        ("1, 3", [1.0, 3.0]),
        ("2, 3", [2.0, 3.0]),
        ("1/2, 2", [0.5, 2.0]),
        ("-1, 2", [-1.0, 2.0]),
        ("1/3, 5/2", [1.0 / 3.0, 2.5]),
    ];
    let (mut proved, mut wrong) = (0, 0);
    for (case, (words, listed)) in exponents.into_iter().enumerate() {
        for (turn, (base, value)) in bases.into_iter().enumerate() {
            for (row, (identity, sides)) in IDENTITIES.into_iter().enumerate() {
                // A third of all is enough, with each base, list and identity several times.
                if (case + turn + row) % 3 != 0 {
                    continue;
                }
                let (range, least) =
                    if (turn + row) % 2 == 0 { ("0..2", 0) } else { ("-2..2", -8) };
                let level = if row % 2 == 0 { "" } else { "[level]\nequations = [\"x*y = 0\"]" };
                let claim = format!("identity = \"{}\"", identity.replace('B', base));
                let holds = listed.iter().all(|a| {
                    let grid = (least..=8).flat_map(|i| (-8..=8).map(move |j| (i, j)));
                    let on_level = grid.filter(|(i, j)| level.is_empty() || i * j == 0);
                    on_level.map(|(i, j)| (f64::from(i) / 4.0, f64::from(j) / 4.0)).all(|(x, y)| {
                        let [left, right] = sides(value(x, y), *a);
                        !(left - right).is_finite() || (left - right).abs() < 1e-9
                    })
                });
                let found = verdict(words, range, level, &claim);
                proved += usize::from(found == Verdict::Proved);
                wrong += usize::from(!holds);
                assert!(
                    holds || ![Verdict::Proved, Verdict::Confirmed].contains(&found),
                    "{claim} is {found:?} for a of {words}, x of {range} {level}"
                );
            }
        }
    }
    assert!(proved >= 20 && wrong >= 20, "{proved} proved, {wrong} false");
}

#[test]
fn points_are_asked_where_their_parameters_have_values() {
    // K has a value for a > 0 alone, and there a|a| is a².
    let text = "title = \"t\"\ncheck-weights = false\n[parameters]\na = \"-2..2\"\nc = \"1..2\"\n\
                K = \"a^(c - c + 2)\"\n[state]\nx = \"-2..2\"\n[field]\n\"x'\" = \"x - abs(a)*a\"\n\
                [[claim]]\nfixed-point = { x = \"K\" }\n";
    let case = Case::parse(text, &[]).expect("a case");
    let report = judge(&case, &Options::default()).expect("judged");
    assert_eq!(report.claims[0].verdict, Verdict::Proved, "{:?}", report.claims[0].evidence);
}

/// Verdicts on a = |a| and on an integral that is one for a ≥ 0, beside V in a field.
fn beside(parameters: &str, rate: &str) -> Vec<Verdict> {
    let text = format!(
        "title = \"t\"\ncheck-weights = false\n[parameters]\na = \"-1..1\"\nb = \"0..1\"\n\
         n = \"one of 2, 3\"\n{parameters}[state]\nx = \"-2..2\"\n[field]\n\"x'\" = \"{rate}\"\n\
         [[claim]]\nidentity = \"a = abs(a)\"\n[[claim]]\nintegral = \"(a - abs(a))*x\"\n"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    report.claims.into_iter().map(|claim| claim.verdict).collect()
}

#[test]
fn powers_in_entries_that_are_not_used_ask_for_nothing() {
    for (parameters, rate) in [
        ("V = \"vec(1, a^n)\"\n", "V[1]"),
        ("V = \"vec(1, a^n)\"\nW = \"2*V\"\n", "W[1]"),
        ("Z = \"mat(vec(1, a^n), vec(2, 1))\"\n", "Z[1,1] + Z[2,1]"),
        ("V = \"vec(1, a^b)\"\n", "V[1]"),
        ("[let]\nV = \"[2, a^n]\"\n", "1 + 0*n"),
    ] {
        assert_eq!(beside(parameters, rate), [Verdict::Refuted; 2], "{parameters}{rate}");
    }
    for used in ["V[1]*V[2]", "1 + 0*V[2]", "1 + 0*(V, V)"] {
        assert_eq!(
            beside("V = \"vec(1, a^n)\"\n", used),
            [Verdict::Refuted; 2],
            "{used}: false for a < 0"
        );
        assert_eq!(beside("V = \"vec(1, a^b)\"\n", used), [Verdict::Proved; 2], "{used}");
    }
}

#[test]
fn exponents_that_are_one_number_for_all_listed_values_take_any_base() {
    let vector = "V = \"vec(n, 2)\"\n";
    for exponent in ["n - n", "0*n + 2", "n^0", "cos(0*n)", "V[2]"] {
        let found = beside(vector, &format!("1 + 0*a^({exponent})"));
        assert_eq!(found, [Verdict::Refuted; 2], "{exponent}");
    }
    for exponent in ["n", "2*n", "V[1]", "n + V[2]", "n + 2 - n"] {
        let found = beside(vector, &format!("1 + 0*a^({exponent})"));
        assert_eq!(found, [Verdict::Refuted; 2], "{exponent}: false for a < 0");
    }
    let of_integral = beside(vector, "∫(a^(b - b)*x, x)");
    assert_eq!(of_integral[0], Verdict::Proved, "the integrand has a value for a > 0 alone");
    for exponent in ["b - b", "b", "x - x", "n - n + 1/2 + 0*b"] {
        let found = beside(vector, &format!("1 + 0*a^({exponent})"));
        assert_eq!(found, [Verdict::Proved; 2], "{exponent}: for a > 0 alone");
    }
}

#[test]
fn powers_of_negative_numbers_have_values_for_listed_whole_exponents() {
    let text = "title = 't'\ncheck-weights = false\n[parameters]\nn = 'one of 2, 3'\n[state]\nx = '-2..2'\ny = '0.1..2'\n\
                [field]\n\"x'\" = '1'\n\"y'\" = 'x^n'\n[[claim]]\nidentity = '(-1)^n = 5 - 2*n'\n\
                [[claim]]\nidentity = '(-y)^n = (5 - 2*n)*y^n'\n[[claim]]\nidentity = '(-1)^n = 2*n - 5'\nexpect = 'open'\n";
    let case = Case::parse(text, &[]).expect("a case");
    let report = judge(&case, &Options::default()).expect("judged");
    assert!(report.warnings.is_empty(), "each number has a motion: {:?}", report.warnings);
    let found: Vec<Verdict> = report.claims.iter().map(|claim| claim.verdict).collect();
    assert_eq!(found, [Verdict::Proved, Verdict::Proved, Verdict::Refuted]);
}

#[test]
fn negative_bases_in_the_equations_of_motion_have_whole_powers() {
    let verdicts = |exponents: &str, claim: &str| {
        let text = format!(
            "title = \"t\"\n[parameters]\na = \"one of {exponents}\"\n[state]\nx = \"-2..-1\"\n[field]\n\
             \"x'\" = \"x^a\"\n[[claim]]\n{claim}\n"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        judge(&case, &Options::default()).map(|found| found.claims[0].verdict)
    };
    for exponents in ["1, 2", "2", "-1, 3"] {
        let of = |claim: &str| verdicts(exponents, claim).expect(exponents);
        assert_eq!(of("identity = \"x' = x^a\""), Verdict::Proved, "{exponents}");
        assert_ne!(of("identity = \"x' = 2*x^a\""), Verdict::Proved, "{exponents}");
        assert_ne!(of("integral = \"x\""), Verdict::Proved, "{exponents}");
    }
    assert!(verdicts("1/2, 1/3", "integral = \"x\"").is_err(), "no power has a value");
}

#[test]
fn exponents_are_split_on_parts_of_levels() {
    let verdict = |exponents: &str, level: &str, claim: &str| {
        let text = format!(
            "title = 't'\n[parameters]\nn = 'one of {exponents}'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n\
             [field]\n\"x'\" = '0'\n\"y'\" = '0'\n\"z'\" = '0'\n[level]\nequations = ['{level}']\n\
             [[claim]]\n{claim}\n"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        judge(&case, &Options::default()).expect("a report").claims[0].verdict
    };
    for level in
        ["abs(x) + abs(z) = 1", "max(x, z) = 0", "sin(x)*z = 0", "x + abs(x) = 0", "x*z = 0"]
    {
        for claim in ["y^n = abs(y)^n", "y^(2*n − 1) = abs(y)^(2*n − 1)"] {
            let own = format!("identity = '{claim}'");
            assert_eq!(verdict("1, 3", level, &own), Verdict::Refuted, "{level}: {claim}");
        }
        let even = "identity = 'y^n = abs(y)^n'";
        assert_eq!(verdict("2, 4", level, even), Verdict::Proved, "{level}");
        assert_eq!(verdict("1/2, 4", level, even), Verdict::Proved, "{level}");
    }
}

#[test]
fn claims_about_a_field_with_listed_exponents_of_negative_bases_are_decided() {
    let of = |exponents: &str, claim: &str| {
        let text = format!(
            "title = 't'\n[parameters]\na = 'one of {exponents}'\n[state]\nx = '-2..-1'\ny = '-1..1'\n\
             [field]\n\"x'\" = 'x^a'\n\"y'\" = '0'\n[[claim]]\n{claim}\nexpect = 'open'\n"
        );
        let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let report = judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
        report.claims[0].verdict
    };
    for (claim, expected) in [
        ("integral = 'x'", Verdict::Refuted),
        ("identity = 'y = 2*y'", Verdict::Refuted),
        ("symmetry = { x = '2*x' }", Verdict::Refuted),
        ("fixed-point = { x = '-3/2' }", Verdict::Refuted),
        ("divergence = '0'", Verdict::Refuted),
        ("lyapunov = 'x'", Verdict::Proved),
        ("lyapunov = '-x'", Verdict::Refuted),
        ("density = '1'", Verdict::Refuted),
        ("density = '1/x^a'", Verdict::Proved),
    ] {
        assert_eq!(of("1, 3", claim), expected, "{claim}");
    }
    assert_eq!(of("1, 2", "lyapunov = 'x'"), Verdict::Refuted, "x² > 0");
}
