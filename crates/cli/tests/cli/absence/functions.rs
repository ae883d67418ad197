//! Claims of absence for fields with exponentials, sines and cosines.

use super::{Dice, Polynomial, Verdict, cross, field, only, plants};

/// A function of a linear form of x, y and z: its text and its slopes.
struct Planted {
    text: String,
    slopes: [String; 3],
}

impl Planted {
    /// a f(l) + b with linear a and l, and b of degree 2.
    fn new(dice: &mut Dice, kind: usize) -> Self {
        let (a, l) = (Polynomial::form(dice), Polynomial::form(dice));
        let b = Polynomial::random(dice, 2);
        let own = l.text();
        let (f, slope) = match kind % 5 {
            0 => (format!("exp({own})"), format!("exp({own})")),
            1 => (format!("sin({own})"), format!("cos({own})")),
            2 => (format!("cos({own})"), format!("(−sin({own}))")),
            3 => (format!("exp(−({own}))"), format!("(−exp(−({own})))")),
            _ => {
                let root = format!("√(1 + ({own})²)");
                (format!("(exp({own}) + {root})"), format!("(exp({own}) + ({own})/{root})"))
            }
        };
        let (along, beside) = (l.gradient(), b.gradient());
        let rate = |k: usize| {
            let (da, a) = (a.derivative(k).text(), a.text());
            format!("({da})*{f} + ({a})*{slope}*({}) + {}", along[k], beside[k])
        };
        let text = format!("({})*{f} + {}", a.text(), b.text());
        Self { text, slopes: [0, 1, 2].map(rate) }
    }
}

#[test]
fn planted_integrals_with_functions_are_never_excluded() {
    let mut dice = Dice(5);
    let (mut refuted, mut proved) = (0, 0);
    let claim = |degree: u32| format!("[[claim]]\nno-integral = {{ degree = {degree} }}\n");
    let stated = |own: &str, name| format!("[[claim]]\nname = '{name}'\nintegral = '{own}'\n");
    let all = plants(8);
    for plant in 0..all {
        let (one, b) = (Planted::new(&mut dice, plant), Polynomial::form(&mut dice));
        // Both are integrals of ∇F × ∇G; with none or one of them claimed there is another.
        let rates = cross(&one.slopes, &b.gradient());
        for (known, degree) in
            [(String::new(), 2), (stated(&one.text, "F"), 1), (stated(&b.text(), "G"), 2)]
        {
            let report = only(&field(rates.clone(), &(known + &claim(degree))));
            let what = format!("plant {plant}, degree {degree}: {}", one.text);
            assert_ne!(report.verdict, Verdict::Proved, "{what}\n{:?}", report.evidence);
            refuted += usize::from(report.verdict == Verdict::Refuted);
        }
        // With both of them there is none; of degree 2 e^(−l) is a fraction.
        let both = stated(&one.text, "F") + &stated(&b.text(), "G") + &claim(2);
        let report = only(&field(rates, &both));
        assert_ne!(report.verdict, Verdict::Refuted, "plant {plant}: {:?}", report.evidence);
        proved += usize::from(report.verdict == Verdict::Proved);
    }
    assert!(refuted * 5 >= 3 * all * 3, "{refuted} of {} claims are refuted", 3 * all);
    assert!(proved * 2 >= all, "{proved} of {all} claims are proved");
}

#[test]
fn theorems_with_functions_name_them_and_need_their_hypotheses() {
    let pendulum = |force: &str, claims: &str| {
        format!(
            "title = 't'\n[parameters]\nk = '0.5..2'\n[state]\nx = '-2..2'\np = '-2..2'\n[field]\n\
             \"x'\" = 'p'\n\"p'\" = '{force}'\n{claims}[[claim]]\nno-integral = {{ degree = 3 }}\n"
        )
    };
    let verdict = |force: &str, claims: &str| {
        let report = only(&pendulum(force, claims));
        (report.verdict, report.evidence)
    };
    let energy = "[[claim]]\nname = 'E'\nintegral = 'p² − 2*k*cos(x)'\nexpect = 'open'\n";
    let (found, evidence) = verdict("−k*sin(x)", energy);
    assert_eq!(found, Verdict::Proved, "{evidence:?}");
    let theorem = evidence.theorem.unwrap_or_default();
    for words in ["polynomials in x, p, sin(x), cos(x) of degree at most 3", "function of p² − 2*k"]
    {
        assert!(theorem.contains(words), "{theorem}");
    }
    let (found, evidence) = verdict("−k*sin(x) − p", "");
    assert_eq!(found, Verdict::Proved, "{evidence:?}");
    assert!(evidence.theorem.is_some_and(|text| text.contains("no fraction P/Q")), "it is told");
    // Without its energy, with a function of it, or with a claim that fails, there is another.
    let squared = energy.replace("p² − 2*k*cos(x)", "(p² − 2*k*cos(x))²");
    let wrong = energy.replace("− 2*k", "+ 2*k");
    let (found, evidence) = verdict("−k*sin(x)", "");
    assert_eq!(found, Verdict::Refuted, "{evidence:?}");
    assert!(evidence.exhibit.is_some_and(|text| text.contains("cos(x)")), "it is shown");
    assert_eq!(verdict("−k*sin(x)", &wrong).0, Verdict::Refuted, "the claim is no integral");
    assert_ne!(
        verdict("−k*sin(x)", &squared).0,
        Verdict::Refuted,
        "it is a function of its square"
    );
    // Functions of other kinds, inside of functions, of one sign only, or of parameters alone.
    for force in [
        "−ln(x + 3)",
        "−exp(exp(x))",
        "−exp(√(1 + x²))",
        "−sin(x)*√(x²)",
        "−exp(x)*|p|",
        "−sin(x) − exp(k)*p",
        "−exp(x)*(x + 3)^k",
    ] {
        let (found, evidence) = verdict(force, "");
        assert_eq!(found, Verdict::Undecided, "{force}: {evidence:?}");
        assert!(evidence.reason.is_some(), "with a reason");
    }
    // Dependent arguments are written in each other.
    for force in ["exp(2*x) − exp(−x)", "sin(2*x) + sin(x)", "exp(x + k) − exp(x)"] {
        let (found, evidence) = verdict(force, "");
        assert_ne!(found, Verdict::Proved, "{force} has an energy: {evidence:?}");
    }
}

#[test]
fn branches_that_cannot_be_compared_exclude_nothing() {
    // y' = 0, as √(x²) = x on the ranges; modulo a prime it is −x at half of the points, and with so many other
    // roots few points have values.
    for roots in [0, 1, 5, 8] {
        let names: Vec<String> = (1..=roots).map(|k| format!("a{k}")).collect();
        let parameters: String = names.iter().map(|name| format!("{name} = '1..2'\n")).collect();
        let factors: String = names.iter().map(|name| format!("*sqrt({name})")).collect();
        let text = format!(
            "title = 't'\n[parameters]\n{parameters}[state]\nx = '1..2'\ny = '-1..1'\n[field]\n\"x'\" = '1 + x*y'\n\
             \"y'\" = '(sqrt(x^2) - x)*(3 + x*y + x^3){factors}'\n[[claim]]\nno-integral = {{ degree = 1 }}\n"
        );
        assert_ne!(only(&text).verdict, Verdict::Proved, "{roots} roots");
    }
}
