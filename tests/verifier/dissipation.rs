//! Lyapunov functions whose rates are sums of squares, and others that nearly are.

use liouville::case::Case;
use liouville::verdict::{CaseReport, Options, Verdict, judge};

fn judged(text: &str) -> CaseReport {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Asserts the verdicts of the claims, in their order, and returns the remark of the first.
#[track_caller]
fn verdicts(text: &str, expected: &[Verdict]) -> String {
    let report = judged(text);
    let found: Vec<Verdict> = report.claims.iter().map(|claim| claim.verdict).collect();
    assert_eq!(found, expected, "{text}");
    report.claims[0].evidence.remark.clone().unwrap_or_default()
}

use Verdict::{Proved, Refuted, Undecided};

/// Writes a flow on the unit sphere of ℝⁿ.
fn on_sphere(size: usize, field: &str, claims: &str) -> String {
    format!(
        "title = 'x'\n[parameters]\nA = 'symmetric({size}, -1..1)'\nD = 'diag({size}, 1..3)'\n[state]\n\
         x = 'vector({size}, -1..1)'\n[level]\nequations = ['(x,x) = 1']\n[field]\n\"x'\" = '{field}'\n\
         {claims}"
    )
}

fn lyapunov(function: &str) -> String {
    format!("[[claim]]\nlyapunov = '{function}'\nexpect = 'open'\n")
}

#[test]
fn gradient_flows_on_spheres_are_seen() {
    [2, 3].into_iter().for_each(is_gradient_flow);
    // Not along the gradient: A² in place of A.
    let other = on_sphere(3, "−A*A*x + (x, A*A*x)*x", &lyapunov("(x, A*x)"));
    verdicts(&other, &[Refuted]);
}

#[test]
#[ignore = "slow: as on spheres of fewer dimensions"]
fn gradient_flows_on_a_large_sphere_are_seen() {
    is_gradient_flow(5);
}

fn is_gradient_flow(size: usize) {
    let both = lyapunov("(x, A*x)") + &lyapunov("−(x, A*x)");
    let remark = verdicts(&on_sphere(size, "−A*x + (x, A*x)*x", &both), &[Proved, Refuted]);
    assert!(remark.contains("(-2)*"), "{remark}");
    verdicts(&on_sphere(size, "A*x − (x, A*x)*x", &both), &[Refuted, Proved]);
}

#[test]
fn double_brackets_are_gradient_flows() {
    let flow = |sign: &str| {
        format!(
            "title = 'x'\n[parameters]\nN = 'diag(3, 1..3)'\n[state]\nL = 'symmetric(3, -1..1)'\n[let]\n\
             B = 'L*N − N*L'\n[field]\n\"L'\" = '{sign}(L*B − B*L)'\n{}{}[[claim]]\n\
             integral = 'tr(L*L*L)'\n",
            lyapunov("−tr(L*N)"),
            lyapunov("tr(L*N)")
        )
    };
    let remark = verdicts(&flow(""), &[Proved, Refuted, Proved]);
    assert!(remark.contains("tr("), "{remark}");
    verdicts(&flow("−"), &[Refuted, Proved, Proved]);
}

/// Writes a linear field in the plane.
fn linear(rates: [&str; 2], function: &str) -> String {
    format!(
        "title = 'x'\n[parameters]\na = '1..2'\nb = '0.5..0.9'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\
         \"x'\" = '{}'\n\"y'\" = '{}'\n{}",
        rates[0],
        rates[1],
        lyapunov(function)
    )
}

#[test]
fn quadratic_forms_are_completed() {
    // −2x² + 2xy − 3y², and with parameters −a x² + 2b xy − y² with b² < a.
    let remark = verdicts(&linear(["−2*x + y", "y*(−3) + x"], "(x² + y²)/2"), &[Proved]);
    assert!(remark.starts_with("its rate is "), "{remark}");
    verdicts(&linear(["−a*x + b*y", "b*x − y"], "(x² + y²)/2"), &[Proved]);
    verdicts(&linear(["−a*x + 3*y", "−y"], "(x² + y²)/2"), &[Refuted]);
    // b² = 0.81 at the end of the range, and b² > 0.8 a: the form has both signs only near there.
    let report = judged(&linear(["−a*x + 2*b*y", "−0.8*y"], "(x² + y²)/2"));
    assert_ne!(report.claims[0].verdict, Proved);
    // Semi-definite: −(x − y)².
    verdicts(&linear(["y − x", "x − y"], "(x² + y²)/2"), &[Proved]);
}

#[test]
fn forms_on_a_level_are_bounded() {
    let on = |function: &str| {
        format!(
            "title = 'x'\n[parameters]\nD = 'diag(3, 1..3)'\n[state]\nX = 'matrix(3, 2, -1..1)'\ns = '-1..1'\n\
             [level]\nequations = ['Xᵀ*X = E(2)']\n[field]\n\"X'\" = '0*X'\n\"s'\" = 'tr(Xᵀ*D*X)'\n{}",
            lyapunov(function)
        )
    };
    verdicts(&on("−s"), &[Proved]);
    verdicts(&on("s"), &[Refuted]);
}

#[test]
fn a_rate_that_is_nearly_a_square_is_not_proved() {
    // The rate is −(x − y)² + x⁴/10⁹ , positive on x = y.
    let text = linear(["y − x + x^3/10^9", "x − y"], "(x² + y²)/2");
    let found = judged(&text).claims[0].verdict;
    assert!(matches!(found, Refuted | Undecided), "{}", found.word());
    // With a factor that a parameter turns: −k|v|² for k of both signs.
    let text = "title = 'x'\n[parameters]\nk = '-1..2'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\
                \"x'\" = '−k*(x − y)'\n\"y'\" = '−k*(y − x)'\n[[claim]]\nlyapunov = '(x − y)²'\n\
                expect = 'open'\n";
    verdicts(text, &[Refuted]);
    verdicts(&text.replace("-1..2", "0.5..2"), &[Proved]);
}

#[test]
fn a_listed_value_without_a_quotient_is_not_passed_over() {
    // −a x² + 2b xy − y² with b² = 10⁻¹² for a = 0, where x is far larger than y.
    let text = |listed: &str| {
        format!(
            "title = 'x'\n[parameters]\na = '{listed}'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\
             \"x'\" = '−a*x + y/10^6'\n\"y'\" = 'x/10^6 − y'\n{}",
            lyapunov("(x² + y²)/2")
        )
    };
    let found = judged(&text("one of 0, 1")).claims[0].verdict;
    assert!(matches!(found, Refuted | Undecided), "{}", found.word());
    verdicts(&text("1"), &[Proved]);
    verdicts(&text("0.5..1"), &[Proved]);
}

#[test]
fn descent_of_a_potential_is_seen() {
    let flow = |sign: &str| {
        format!(
            "title = 'x'\n[parameters]\nk = '0.5..2'\n[state]\nx = '-1..1'\ny = '-1..1'\n[let]\n\
             V = 'x^4 + x*y^3 − x²*y + y²'\n[field]\n\"x'\" = '−k*∂V/∂x'\n\
             \"y'\" = '{sign}k*∂V/∂y'\n{}",
            lyapunov("V")
        )
    };
    verdicts(&flow("−"), &[Proved]);
    verdicts(&flow("2*"), &[Refuted]);
}

#[test]
fn rates_whose_terms_cancel_are_seen() {
    let flow = |range: &str, x: &str, y: &str, function: &str| {
        format!(
            "title = 'x'\n[parameters]\na = '0.5..2'\nb = '0.5..1'\n[state]\nx = '0.2..2'\ny = '{range}'\n\
             [field]\n\"x'\" = '{x}'\n\"y'\" = '{y}'\n{}",
            lyapunov(function)
        )
    };
    for (range, x, y, function, twin) in [
        // −b y² |y|, −a x⁴, −(x − 1)², −a (x − 1)² − b (y − 1)², (b − 1) x − 2b x², −b
        ("-1..1", "y", "−sin(x) − b*y*|y|", "y²/2 − cos(x)", "y²/2 + cos(x)"),
        ("-1..1", "y − a*x^3", "−x", "(x² + y²)/2", "(y² − x²)/2"),
        ("-1..1", "x*(1 − x)", "0", "x − ln(x)", "x + ln(x)"),
        ("0.2..2", "a*x*(1 − x)", "b*y*(1 − y)", "x − ln(x) + y − ln(y)", "x − ln(x) − y + ln(y)"),
        ("0.2..2", "b*x*(1 − x) − x", "b*y*(y − x)", "x", "y"),
        ("0.2..2", "−a*x*y + b", "a*x*y − 2*b", "x + y", "−x − y"),
    ] {
        verdicts(&flow(range, x, y, function), &[Proved]);
        verdicts(&flow(range, x, y, twin), &[Refuted]);
    }
    // Positive for 0 < y < 10⁻⁹ alone.
    let near = flow("-1..1", "−x*y² + x*y/10^9", "0", "x");
    let found = judged(&near).claims[0].verdict;
    assert!(matches!(found, Refuted | Undecided), "{}", found.word());
}

#[test]
fn a_form_without_a_value_at_few_states_shows_nothing_there() {
    // u is negative near one point, where ln u² has a value and ln u has none.
    let squares = "title = 'x'\ncheck-weights = false\n[parameters]\na = '0.1..0.5'\n[state]\nx = '-1..1'\n\
                   y = '-1..1'\nz = '-1..1'\nw = '-1..1'\n[let]\n\
                   u = '1 - 2*exp(-10^8*((x - 3/10)^2 + (y - 7/10)^2 + (z - 4/10)^2))'\n[field]\n\
                   x = '0'\ny = '0'\nz = '0'\nw = '(a - u)*(ln(u^2) - ln(a^2))'\n[[claim]]\nlyapunov = 'w'\n";
    verdicts(squares, &[Undecided]);
    verdicts(&squares.replace("2*exp", "exp"), &[Proved]);
    // Volterra's form x/p − 1 − ln(x/p) needs p > 0.
    let volterra = |p: &str| {
        format!(
            "title = 'x'\ncheck-weights = false\n[parameters]\na = '-1..1'\nb = '-1..1'\nc = '-1..1'\n[let]\n\
             p = '(a-3/10)^2 + (b-7/10)^2 + (c-4/10)^2 {p} 1/10^10'\n[state]\nx = '0.1..2'\n[field]\n\
             x = '-(x-p)/(x*p)'\n[[claim]]\nlyapunov = '(x-p)^2/2'\n"
        )
    };
    verdicts(&volterra("-"), &[Undecided]);
    verdicts(&volterra("+"), &[Proved]);
}

#[test]
fn friction_of_a_lagrangian_takes_its_energy() {
    let arm = |forces: &str, claims: &str| {
        format!(
            "title = 'x'\n[parameters]\na = '4..5'\nb = '0.2..0.5'\nc = '1..2'\nd1 = '0.5..2'\nd2 = '0.5..2'\n\
             k = '0.5..2'\n[state]\nx = '-1..1'\ny = '-1..1'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n[lagrangian]\n\
             kinetic = \"((a+2*b*cos(y))*x'^2 + 2*(c+b*cos(y))*x'*y' + c*y'^2)/2\"\n\
             potential = 'cos(x)'\nforces = {{ {forces} }}\n{claims}"
        )
    };
    let friction = "x = \"-d1*x'\", y = \"-d2*y'\"";
    let remark = verdicts(&arm(friction, &lyapunov("energy")), &[Proved]);
    assert!(remark.contains("its rate is"), "{remark}");
    verdicts(&arm(&friction.replace("-d2", "d2"), &lyapunov("energy")), &[Refuted]);
    // One friction between two joints, whose power is a square: −c(x' − y')².
    let joint = "x = \"-d1*(x' - y')\", y = \"d1*(x' - y')\"";
    verdicts(&arm(joint, &lyapunov("energy")), &[Proved]);
    verdicts(&arm("x = \"-d1*(x' - y')\", y = \"-d1*(x' - y')\"", &lyapunov("energy")), &[Refuted]);
    // A spring in the forces has its energy in F alone.
    let spring = "x = \"-d1*x' - k*x - sin(x)\", y = \"-d2*y' - k*y\"";
    let function = "energy - cos(x) + k*(x^2 + y^2)/2";
    verdicts(&arm(spring, &lyapunov(function)), &[Proved]);
    verdicts(&arm(spring, &lyapunov(&function.replace("- cos", "+ cos"))), &[Refuted]);
}

#[test]
fn squares_have_parameters_of_their_own() {
    let backstepping = |sign: &str| {
        format!(
            "title = 'x'\n[parameters]\na = '0.5..1'\nb = '0.5..1'\n[state]\nx = '-1..1'\ny = '-1..1'\n[let]\n\
             z = 'y + a*x'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-x {sign} b*z - a*y'\n{}",
            lyapunov("x^2/2 + z^2/2")
        )
    };
    // −a x² − b z².
    verdicts(&backstepping("-"), &[Proved]);
    verdicts(&backstepping("+"), &[Refuted]);
}

#[test]
fn times_that_are_not_declared_are_all_times() {
    let driven = |field: &str, claims: &str| {
        format!("title = 'x'\n[state]\nx = '-1..1'\n[field]\n\"x'\" = '{field}'\n{claims}")
    };
    verdicts(&driven("-x*(5 - t^2)", &lyapunov("x^2")), &[Refuted]);
    verdicts(&driven("-x*(5 + t^2)", &lyapunov("x^2")), &[Proved]);
    let identity = "[[claim]]\nidentity = '|t - 3| = 3 - t'\nexpect = 'open'\n";
    verdicts(&driven("-x*t", identity), &[Refuted]);
    let declared = driven("-x*t", identity).replace("[field]", "t = '-2..2'\n[field]");
    verdicts(&declared, &[Proved]);
    // Steep, but with a value everywhere.
    let steep = driven("-tanh(1000*x)", &lyapunov("x^2"));
    assert_eq!(judged(&steep).warnings, Vec::<String>::new());
}
