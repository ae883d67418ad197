//! Lyapunov functions of textbooks: free energies, gradient flows with weights, scalar fields, and their wrong twins.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

use Verdict::{Proved, Refuted, Undecided};

/// Verdict on the first claim, with its remark.
fn verdict(text: &str) -> (Verdict, String) {
    let case = Case::parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let report =
        judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    (report.claims[0].verdict, report.claims[0].evidence.remark.clone().unwrap_or_default())
}

/// Asserts the verdict on a function for the states, parameters and field of a file.
#[track_caller]
fn is(expected: Verdict, file: &str, function: &str) -> String {
    let text = format!(
        "title = 't'\ncheck-weights = false\n{file}\n[[claim]]\nlyapunov = '{function}'\nexpect = 'open'\n"
    );
    let (found, remark) = verdict(&text);
    assert_eq!(found, expected, "{function}: {remark}\n{text}");
    remark
}

const TWO: &str =
    "[parameters]\nk = '0.5..2'\nl = '0.5..2'\n[state]\na = '0.1..2'\nb = '0.1..2'\n[field]\n";

#[test]
fn free_energies_of_reactions_fall() {
    let linear = format!("{TWO}a = 'l*b - k*a'\nb = 'k*a - l*b'");
    let remark = is(Proved, &linear, "a*ln(a) + b*ln(b*l/k)");
    assert!(remark.contains("ln(") && remark.len() < 80, "{remark}");
    is(Refuted, &linear, "a*ln(a) + b*ln(b*k/l)");
    // 2A ⇌ B
    let dimer = format!("{TWO}a = '-2*k*a^2 + 2*l*b'\nb = 'k*a^2 - l*b'");
    is(Proved, &dimer, "a*ln(a) - a + b*ln(b*l/k) - b");
    is(Refuted, &dimer, "a*ln(a) - a + b*ln(b*k/l) - b");
    // With numbers, 2a² against 3b.
    let numbers = format!("{TWO}a = '6*b - 4*a^2'\nb = '2*a^2 - 3*b'");
    is(Proved, &numbers, "a*ln(a) - a + b*ln(3*b/2) - b");
    is(Refuted, &numbers, "a*ln(a) - a + b*ln(4*b/2) - b");
    let gas = "[state]\na = '0.1..2'\nb = '0.1..2'\nc = '0.1..2'\n[field]\na = 'c^2 - a*b'\n\
               b = 'c^2 - a*b'\nc = '-(c^2 - a*b)'";
    is(Proved, gas, "a*ln(a) + b*ln(b) + 2*c*ln(c)");
    is(Refuted, gas, "a*ln(a) + b*ln(b) + c*ln(c)");
}

#[test]
fn relative_entropies_of_chains_fall() {
    let chain = |last: &str| {
        format!(
            "[parameters]\nk = 'vector(3, 0.1..2)'\np = 'vector(3, 0.1..2)'\n[state]\nx = 'vector(3, 0.1..2)'\n\
             [let]\nu = 'vector(i, 1..3, x[i]/p[i])'\n[field]\nx = '[k1*(u[2]-u[1])+k3*(u[3]-u[1]), \
             k1*(u[1]-u[2])+k2*(u[3]-u[2]), k2*(u[2]-u[3])+{last}*(u[1]-u[3])]'"
        )
    };
    is(Proved, &chain("k3"), "sum(i,1..3,x[i]*ln(x[i]/p[i]))");
    is(Refuted, &chain("k2"), "sum(i,1..3,x[i]*ln(x[i]/p[i]))");
    // Wegscheider's condition l1 l2 l3 = k1 k2 k3.
    let cycle = |balance: &str| {
        format!(
            "[parameters]\nk = 'vector(3, 0.5..2)'\nl1 = '0.5..2'\nl2 = '0.5..2'\nl3 = '{balance}'\n[state]\n\
             x = '0.1..2'\ny = '0.1..2'\nz = '0.1..2'\n[field]\nx = 'l1*y - k1*x + k3*z - l3*x'\n\
             y = 'k1*x - l1*y + l2*z - k2*y'\nz = 'k2*y - l2*z + l3*x - k3*z'"
        )
    };
    let energy = "x*ln(x) + y*ln(y*l1/k1) + z*ln(z*l1*l2/(k1*k2))";
    is(Proved, &cycle("k1*k2*k3/(l1*l2)"), energy);
    is(Refuted, &cycle("k1*k2*k3*l1/l2"), energy);
}

#[test]
fn flows_on_simplexes_are_gradients() {
    let replicator = |matrix: &str| {
        format!(
            "[parameters]\nA = '{matrix}'\n[state]\nx = 'vector(3, 0.05..1)'\n[field]\n\
             \"x[i]'\" = 'x[i]*((A*x)[i] - (x,A*x))'\n[level]\nequations = ['x1 + x2 + x3 = 1']"
        )
    };
    let remark = is(Proved, &replicator("symmetric(3, -1..1)"), "-(x,A*x)");
    assert!(remark.len() < 120, "{remark}");
    is(Refuted, &replicator("symmetric(3, -1..1)"), "(x,A*x)");
    is(Refuted, &replicator("matrix(3, 3, -1..1)"), "-(x,A*x)");
    let mirror = "[parameters]\nc = 'vector(3, -1..1)'\n[state]\nx = 'vector(3, 0.05..1)'\n[field]\n\
                  \"x[i]'\" = 'x[i]*((c,x) - c[i])'\n[level]\nequations = ['x1 + x2 + x3 = 1']";
    is(Proved, mirror, "(c,x)");
    is(Refuted, mirror, "-(c,x)");
}

#[test]
fn networks_descend() {
    let hopfield = |sign: &str| {
        format!(
            "[parameters]\nn = 2\nW = 'symmetric(2, -1..1)'\nb = 'vector(2, -1..1)'\n[state]\n\
             u = 'vector(2, -2..2)'\n[let]\ns = 'vector(i, 1..n, tanh(u[i]))'\n[field]\n\
             \"u[i]'\" = '-u[i] {sign} sum(j, 1..n, W[i,j]*s[j]) + b[i]'"
        )
    };
    let energy = "-(s,W*s)/2 - (b,s) + sum(i,1..n,u[i]*tanh(u[i]) - ln(cosh(u[i])))";
    is(Proved, &hopfield("+"), energy);
    is(Refuted, &hopfield("-"), energy);
    let bodies = "[parameters]\nk = 'vector(3, 0.1..1)'\n[state]\nT = 'vector(3, 0.1..2)'\n[field]\n\
                  T = '[k1*(T2-T1)+k2*(T3-T1), k1*(T1-T2)+k3*(T3-T2), k2*(T1-T3)+k3*(T2-T3)]'";
    is(Proved, bodies, "-sum(i,1..3,ln(T[i]))");
    is(Refuted, bodies, "sum(i,1..3,ln(T[i]))");
    let consensus = "[parameters]\nW = 'symmetric(5, 0..1)'\n[state]\nx = 'vector(5, -1..1)'\n[field]\n\
                     \"x[i]'\" = 'sum(j,1..5,W[i,j]*(x[j]-x[i]))'";
    let remark = is(Proved, consensus, "(x,x)");
    assert!(remark.len() < 400, "a sum of squares of differences: {remark}");
}

/// Verdict on a function of x for x' = −f(x).
fn scalar(rate: &str, function: &str) -> (Verdict, String) {
    verdict(&format!(
        "title = 't'\ncheck-weights = false\n[parameters]\na = '0.5..1'\nb = '0.5..1'\n[state]\nx = '-0.9..0.9'\n\
         [field]\nx = '-({rate})'\n[[claim]]\nlyapunov = '{function}'\nexpect = 'open'\n"
    ))
}

#[test]
fn fields_that_grow_with_their_variable_lead_to_rest() {
    let proved = [
        "exp(a*x) - 1",
        "x + exp(x) - 1",
        "exp(x) - 1 + x^3",
        "x + a*(exp(x/b) - 1)",
        "x + sinh(x)",
        "asinh(x)",
        "x + tanh(a*x)",
        "x + a*ln(1 + x)",
        "(1 + x)^b - 1",
        "a*(exp(x) - exp(-b*x))",
        "x*ln(1 + x^2)",
        "x - sin(x)",
        "2*x - sin(x)",
    ];
    for rate in proved {
        let (found, remark) = scalar(rate, "x^2");
        assert_eq!(found, Proved, "{rate}: {remark}");
    }
    assert_eq!(scalar("3*x + 4*tanh(x)", "ln(cosh(x))").0, Proved);
    // Of the other sign somewhere, or not 0 at 0.
    let wrong = [
        "x - 2*sin(x)",
        "x - sin(x) + 1/1000",
        "exp(a*x) - 1 - x",
        "x^3 - x/100",
        "1/(x - 1/2) + 2",
    ];
    for rate in wrong {
        let (found, remark) = scalar(rate, "x^2");
        assert!(matches!(found, Refuted | Undecided), "{rate}: {remark}");
    }
}

#[test]
fn functions_of_volterra_fall_in_models_of_infections() {
    let infection = |rest: &str| {
        format!(
            "[parameters]\nL = '1..2'\nd = '0.1..0.5'\nb = '1..2'\nh = '0.5..1'\np = '2..3'\nc = '0.5..1'\n\
             [state]\nT = '0.05..2'\nI = '0.05..2'\nv = '0.05..5'\n[let]\nT0 = 'h*c/(b*p)'\n\
             I0 = '{rest}'\nV0 = 'p*I0/c'\n[field]\nT = 'L - d*T - b*T*v'\nI = 'b*T*v - h*I'\nv = 'p*I - c*v'"
        )
    };
    let function = |share: &str| format!("T - T0*ln(T) + I - I0*ln(I) + {share}*(v - V0*ln(v))");
    let remark = is(Proved, &infection("L/h - d*c/(b*p)"), &function("h/p"));
    assert!(remark.contains("1 - ln("), "{remark}");
    is(Refuted, &infection("L/h - d*c/(b*p)"), &function("p/h"));
    is(Refuted, &infection("L/h"), &function("h/p"));
}
