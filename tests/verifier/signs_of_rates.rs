//! Rates whose sign shows as that of products of values with the same sign, and of sums of squares of any degree.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

fn verdict(text: &str) -> (Verdict, String) {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report =
        judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    (report.claims[0].verdict, format!("{:?}", report.claims[0].evidence.remark))
}

/// Verdict on z, whose rate is a function of the constants x and y.
fn of_rate(rate: &str, range: &str) -> (Verdict, String) {
    verdict(&format!(
        "title = 't'\ncheck-weights = false\n[state]\nx = '{range}'\ny = '{range}'\nz = '-1..1'\n[field]\n\
         \"x'\" = '0'\n\"y'\" = '0'\n\"z'\" = '{rate}'\n[[claim]]\nlyapunov = 'z'\nexpect = 'open'\n"
    ))
}

#[test]
fn functions_of_a_decreasing_function_decrease() {
    let functions = [
        "sqrt(x^2 + y^2)",
        "ln(x^2 + y^2)",
        "exp(x^2 + y^2)",
        "atan(x^2 + y^2)",
        "(x^2 + y^2)/(1 + x^2 + y^2)",
        "-1/(x^2 + y^2)",
        "x^4 + y^4",
        "x^4 + 2*y^4",
        "x^6 + 3*y^6",
        "-cos(y)",
        "1 - cos(3*y)",
        "exp(y) - y",
        "y*atan(y)",
    ];
    for function in functions {
        let (found, remark) = verdict(&format!(
            "title = 't'\ncheck-weights = false\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\
             \"x'\" = '-x - y'\n\"y'\" = '-y'\n[[claim]]\nlyapunov = '{function}'\nexpect = 'open'\n"
        ));
        assert_eq!(found, Verdict::Proved, "{function}: {remark}");
    }
}

#[test]
fn a_rate_without_a_visible_sign_is_left_undecided() {
    let (found, remark) = verdict(
        "title = 't'\ncheck-weights = false\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\"x'\" = '-x - y'\n\
         \"y'\" = '-y'\n[[claim]]\nlyapunov = 'x*atan(x) + y^2'\nexpect = 'open'\n",
    );
    assert_eq!(found, Verdict::Undecided, "{remark}");
}

#[test]
fn entropy_grows_in_a_reversible_reaction() {
    let text = |rest: &str| {
        format!(
            "title = 't'\ncheck-weights = false\n[parameters]\nk = '1/2..2'\n[state]\na = '0..3'\nb = '0..3'\n\
             [field]\n\"a'\" = 'k*(b - a)'\n\"b'\" = 'k*(a - b)'\n[[claim]]\nlyapunov = 'a*log(a) + b*log(b)'\n{rest}"
        )
    };
    for rest in ["", "equals = '-k*(a - b)*(log(a) - log(b))'\n"] {
        let (found, remark) = verdict(&text(rest));
        assert_eq!(found, Verdict::Proved, "{rest}: {remark}");
    }
    let (found, _) = verdict(&text("equals = '-k*(a - b)*(log(a) - 2*log(b))'\nexpect = 'open'\n"));
    assert_eq!(found, Verdict::Refuted, "another rate");
}

#[test]
fn entropy_grows_in_a_cycle_of_reactions() {
    let text = |sign: &str| {
        format!(
            "title = 't'\ncheck-weights = false\n[parameters]\nk = '1/2..2'\nl = '1/2..2'\n[state]\na = '0..3'\n\
             b = '0..3'\nc = '0..3'\n[field]\n\"a'\" = 'k*(b - a) + l*(c - a)'\n\
             \"b'\" = 'k*(a - b) {sign} k*(c - b)'\n\"c'\" = '-(0 {sign} k*(c - b)) - l*(c - a)'\n[[claim]]\n\
             lyapunov = 'a*log(a) + b*log(b) + c*log(c)'\nexpect = 'open'\n"
        )
    };
    let (found, remark) = verdict(&text("+"));
    assert_eq!(found, Verdict::Proved, "{remark}");
    assert_eq!(verdict(&text("-")).0, Verdict::Refuted, "a reaction that runs backwards");
}

/// A factor F(p) − F(q), or sin p, and its value.
type Factor = (&'static str, fn(f64, f64) -> f64);

const PLAIN: [Factor; 6] = [
    ("(x - y)", |x, y| x - y),
    ("(y - x)", |x, y| y - x),
    ("x", |x, _| x),
    ("(3*x)", |x, _| 3.0 * x),
    ("(x - 1)", |x, _| x - 1.0),
    ("(x^2 - y)", |x, y| x * x - y),
];

const OTHERS: [Factor; 15] = [
    ("(exp(x) - exp(y))", |x, y| x.exp() - y.exp()),
    ("(exp(x^2) - exp(y))", |x, y| (x * x).exp() - y.exp()),
    ("(exp(x) - 1)", |x, _| x.exp() - 1.0),
    ("(atan(x) - atan(y))", |x, y| x.atan() - y.atan()),
    ("atan(3*x)", |x, _| (3.0 * x).atan()),
    ("(x^3 - y^3)", |x, y| x.powi(3) - y.powi(3)),
    ("(x^2 - y^2)", |x, y| x * x - y * y),
    ("(ln(x) - ln(y))", |x, y| x.ln() - y.ln()),
    ("ln(x)", |x, _| x.ln()),
    ("(sqrt(x) - sqrt(y))", |x, y| x.sqrt() - y.sqrt()),
    ("(1/x - 1/y)", |x, y| 1.0 / x - 1.0 / y),
    ("sin(x)", |x, _| x.sin()),
    ("sin(3*x)", |x, _| (3.0 * x).sin()),
    ("sin(x - y)", |x, y| (x - y).sin()),
    ("(exp(-x) - exp(-y))", |x, y| (-x).exp() - (-y).exp()),
];

#[test]
fn signs_of_products_are_those_of_their_values() {
    let (mut proved, mut false_ones) = (0, 0);
    for (place, (plain, p)) in PLAIN.into_iter().enumerate() {
        for (turn, (other, f)) in OTHERS.into_iter().enumerate() {
            let (sign, factor) = if (place + turn) % 2 == 0 { ("-", -1.0) } else { ("2*", 2.0) };
            let (range, least, most) =
                [("0..2", 0.0, 2.0), ("-4..4", -4.0, 4.0), ("-1..1", -1.0, 1.0)]
                    [(place + 2 * turn) % 3];
            let at = |k: u32| least + (most - least) * f64::from(k) / 60.0;
            let grid = (0..=60).flat_map(|i| (0..=60).map(move |j| (at(i), at(j))));
            let values = grid.map(|(x, y)| factor * p(x, y) * f(x, y));
            let is_true = values.filter(|value| value.is_finite()).all(|value| value < 1e-12);
            let (found, remark) = of_rate(&format!("{sign}{plain}*{other}"), range);
            let words = format!("{sign}{plain}*{other} on {range}: {found:?} {remark}");
            proved += usize::from(found == Verdict::Proved);
            false_ones += usize::from(!is_true);
            match is_true {
                true => assert_ne!(found, Verdict::Refuted, "{words}"),
                false => assert_ne!(found, Verdict::Proved, "{words}"),
            }
        }
    }
    assert!(proved >= 8 && false_ones >= 40, "{proved} proved, {false_ones} false");
}

#[test]
fn quartic_forms_are_proved_where_they_are_sums_of_squares() {
    let proved = [
        "-(x^4 + x^3*y + y^4)",
        "-(x^4 - x^2*y^2/2 + y^4)*exp(x)",
        "-(2*x^2 + y^2)*(x^2 + x*y + y^2)",
    ];
    for rate in proved {
        let (found, remark) = of_rate(rate, "-1..1");
        assert_eq!(found, Verdict::Proved, "{rate}: {remark}");
    }
    for rate in
        ["-(x^4 + 3*x^3*y + y^4)", "x^4 - x^2*y^2/2 + y^4", "-(x^4 - 3*x^2*y^2 + y^4)*exp(x)"]
    {
        assert_eq!(of_rate(rate, "-1..1").0, Verdict::Refuted, "{rate}");
    }
}

#[test]
fn rates_that_are_positive_on_a_thin_part_are_refuted() {
    let (found, _) = verdict(
        "title = 't'\ncheck-weights = false\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\"x'\" = '-x - y'\n\
         \"y'\" = '-y'\n[[claim]]\nlyapunov = '|x| + 999/1000*|y|'\nexpect = 'open'\n",
    );
    assert_eq!(found, Verdict::Refuted, "positive for |x| < |y|/1000 of opposite signs");
    let nearly = ["-x^2 + 2001/1000*x*y - y^2", "-x^4 + 2*x^2*y^2 - y^4 + x^3*y/100000"];
    let clearly = ["-x^2 + 2000/1000*x*y - y^2", "-x^4 + 2*x^2*y^2 - y^4"];
    for rate in nearly {
        assert_eq!(of_rate(rate, "-2..2").0, Verdict::Refuted, "{rate}");
    }
    for rate in clearly {
        assert_eq!(of_rate(rate, "-2..2").0, Verdict::Proved, "{rate}");
    }
}
